"""What a command answers: its quantities for one scene, with the inputs as understood, reasons and notes."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

from .errors import JkrollError, MissingInput, NoResult
from .formatting import amount
from .nomenclature import INFINITY, NOMENCLATURE, word_for_infinity
from .scene import DEFAULTS, Scene


class Command(NamedTuple):
    """A command of the shell: the quantities it is named after, and those it shows with them."""

    sentence: str
    headline: tuple[str, ...]
    beside: tuple[str, ...]
    example: str

    @property
    def quantities(self) -> tuple[str, ...]:
        """All that it shows."""
        return self.headline + self.beside


_COMMANDS = {
    "pull-off": Command(
        "The force that pulls two spheres apart.", ("pull_off_force",), ("pull_off_force_dmt",), "quartz 100nm --to nN"
    ),
    "yield-force": Command(
        "The force that starts a sphere rolling.",
        ("yield_force",),
        ("yield_force_ratio", "yield_moment", "yield_angle"),
        "quartz 100nm --load -5nN",
    ),
    "r-min": Command("How sharply a chain of spheres bends without rolling.", ("r_min",), (), "100nm --xi 2angstrom"),
    "n-grav": Command("How long a level chain stands in gravity.", ("n_grav",), (), "quartz 100nm --gravity 1.62m/s2"),
    "frequencies": Command(
        "How the contact vibrates.",
        ("vertical_frequency", "rolling_frequency"),
        ("rolling_frequency_as_printed", "rolling_frequency_no_slip"),
        "quartz 100nm --radius2 plane",
    ),
    "n-roll": Command(
        "How far a sphere rolls over a fixed one after a collision.",
        ("n_roll",),
        ("n_roll_energy_balance",),
        "quartz 1um --speed 10cm/s",
    ),
    "contact": Command(
        "The contact: its radius, approach, stiffness and pressure.",
        ("contact_radius", "approach"),
        ("contact_radius_at_load", "approach_at_load", "stiffness", "hertz_pressure", "boussinesq_pressure"),
        "quartz 100nm --load -5nN",
    ),
    "moment": Command(
        "The moment against rolling when the contact lags by ξ.",
        ("yield_moment",),
        ("rolling_stiffness", "mean_rolling_moment", "mean_rolling_force"),
        "quartz 100nm --xi 1angstrom",
    ),
}
COMMANDS: Mapping[str, Command] = MappingProxyType(
    _COMMANDS
    | {
        "report": Command(
            "Everything a scene allows, and what the rest needs.",
            tuple(name for command in _COMMANDS.values() for name in command.headline),
            tuple(name for command in _COMMANDS.values() for name in command.beside),
            "quartz 100nm",
        )
    }
)


class Result(NamedTuple):
    """A quantity in SI units, or the reason why there is none."""

    name: str
    value: float | None
    reason: str = ""


class Answer(NamedTuple):
    """What one scene gave."""

    inputs: Mapping[str, float | str]
    results: tuple[Result, ...]
    notes: tuple[str, ...]
    failure: JkrollError | None  # why there is no result at all

    def value(self, name: str) -> float | None:
        """The value of a result that this answer has, or None."""
        return next((result.value for result in self.results if result.name == name), None)


def answer(command: Command, scene: Scene) -> Answer:
    """Compute what a command shows of a scene, as far as the scene allows."""
    results, errors = [], []
    for name in command.quantities:
        if not _concerns(name, scene):
            continue
        try:
            results.append(Result(name, scene[name]))
        except (MissingInput, NoResult) as error:
            errors.append(error)
            reason = f"needs {error.needs()}" if isinstance(error, MissingInput) else str(error)
            results.append(Result(name, None, reason))
    known = [result.name for result in results if result.value is not None]
    inputs = _echo(scene, known)
    notes = (*_assumptions(scene, inputs, known), *_about_materials(scene), *_about(results))
    return Answer(inputs, tuple(results), notes, None if known else errors[0])


def _concerns(name: str, scene: Scene) -> bool:
    """Whether a quantity that stands beside another has something to say of this scene."""
    if name == "rolling_frequency_as_printed":
        return scene.is_identical
    if name == "rolling_frequency_no_slip":
        return not scene.is_identical
    return True


def _echo(scene: Scene, names: list[str]) -> dict[str, float | str]:
    """The inputs on which the results depend, as they were understood."""
    echoed: dict[str, Any] = {}
    if scene.material is not None:
        echoed["material"] = scene.material.name
    if scene.material2 is not None:
        echoed["material2"] = scene.material2.name
    used = set(scene.inputs_of(*names))
    for name in NOMENCLATURE:
        if name in used:
            echoed[name] = scene.values[name]
        elif name == "radius2" and "radius" in used:
            echoed[name] = scene.values["radius"]
    return {
        name: word_for_infinity(name) or value if value == INFINITY else value
        for name, value in sorted(echoed.items(), key=lambda item: _ORDER[item[0]])
    }


_ORDER = {name: place for place, name in enumerate(NOMENCLATURE)}


def _assumptions(scene: Scene, inputs: Mapping[str, float | str], names: list[str]) -> list[str]:
    """What was taken for granted, and the option that says otherwise."""
    assumed = [
        f"assumed {NOMENCLATURE[name].symbol} = {amount(name, DEFAULTS[name])}, {NOMENCLATURE[name].sentence} ({NOMENCLATURE[name].option})"
        for name in DEFAULTS
        if name in inputs and name not in scene.given
    ]
    steps = {step.name for name in names for step in scene.plan(name).steps}
    if "adhesion_energy" in steps:
        assumed.append("assumed W0 = P_cδ0, the energy typical of adhesion (--energy or --speed)")
    if "work_of_adhesion" in steps and "surface_energy2" in inputs:
        assumed.append("w = 2√(γ1γ2) by the geometric mixing rule; a measured one is better (--work-of-adhesion)")
    return assumed


def _about_materials(scene: Scene) -> list[str]:
    materials = [material for material in (scene.material, scene.material2) if material is not None]
    return list(dict.fromkeys(f"{material.name}: {note}" for material in materials for note in material.notes))


def _about(results: list[Result]) -> list[str]:
    notes = [
        f"{result.name}: {NOMENCLATURE[result.name].note}"
        for result in results
        if result.value is not None and NOMENCLATURE[result.name].note
    ]
    return notes + [f"{result.name}: {result.reason}" for result in results if result.value is None]
