"""The commands of the shell that ask a scene: what each is named after, what it shows, and an example."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple


class Command(NamedTuple):
    """A command of the shell: the quantities it is named after, all that it shows, and an example."""

    sentence: str
    headline: tuple[str, ...]
    quantities: tuple[str, ...]
    example: str


def _command(sentence: str, headline: tuple[str, ...], beside: tuple[str, ...], example: str) -> Command:
    return Command(sentence, headline, headline + beside, example)


_COMMANDS = {
    "pull-off": _command(
        "The force that pulls two spheres apart.", ("pull_off_force",), ("pull_off_force_dmt",), "quartz 100nm --to nN"
    ),
    "yield-force": _command(
        "The force that starts a sphere rolling.",
        ("yield_force",),
        ("yield_force_ratio", "yield_moment", "yield_angle"),
        "quartz 100nm --load -5nN",
    ),
    "r-min": _command("How sharply a chain of spheres bends without rolling.", ("r_min",), (), "100nm --xi 2angstrom"),
    "n-grav": _command("How long a level chain stands in gravity.", ("n_grav",), (), "quartz 100nm --gravity 1.62m/s2"),
    "frequencies": _command(
        "How the contact vibrates.",
        ("vertical_frequency", "rolling_frequency"),
        ("rolling_frequency_as_printed", "rolling_frequency_no_slip"),
        "quartz 100nm --radius2 plane",
    ),
    "n-roll": _command(
        "How far a sphere rolls over a fixed one after a collision.",
        ("n_roll",),
        ("n_roll_energy_balance",),
        "quartz 1um --speed 10cm/s",
    ),
    "contact": Command(
        "The contact: its radius, approach, stiffness and pressure.",
        ("contact_radius_at_load", "approach_at_load"),
        (
            "contact_radius",
            "approach",
            "load",
            "contact_radius_at_load",
            "approach_at_load",
            "stiffness",
            "hertz_pressure",
            "boussinesq_pressure",
            "well_energy",
            "pull_off_work",
            "pull_off_work_at_dead_load",
            "sticking_energy",
        ),
        "quartz 100nm --load -5nN",
    ),
    "moment": _command(
        "The moment against rolling when the contact lags by ξ.",
        ("yield_moment",),
        (
            "unloaded_moment",
            "half_circles_moment",
            "fixed_approach_moment",
            "rolling_stiffness",
            "mean_rolling_moment",
            "mean_rolling_force",
        ),
        "quartz 100nm --xi 1angstrom",
    ),
}
COMMANDS: Mapping[str, Command] = MappingProxyType(
    _COMMANDS
    | {
        "report": Command(
            "Everything a scene allows, and what the rest needs.",
            tuple(name for command in _COMMANDS.values() for name in command.headline),
            tuple(dict.fromkeys(name for command in _COMMANDS.values() for name in command.quantities)),
            "quartz 100nm",
        )
    }
)
