"""The questions that a command asks of a scene: the quantities that it is named after, and all that it shows."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple


class Question(NamedTuple):
    """The quantities of one question."""

    headline: tuple[str, ...]  # those that the command is named after; --bare writes them alone
    quantities: tuple[str, ...]  # all that are shown, in this order


_QUESTIONS = {
    "pull-off": Question(("pull_off_force",), ("pull_off_force", "pull_off_force_dmt", "pull_off_force_lennard_jones")),
    "yield-force": Question(
        ("yield_force",),
        ("yield_force", "yield_force_ratio", "yield_moment", "yield_angle", "yield_displacement"),
    ),
    "r-min": Question(("r_min",), ("r_min",)),
    "n-grav": Question(("n_grav",), ("n_grav",)),
    "frequencies": Question(
        ("vertical_frequency", "rolling_frequency"),
        ("vertical_frequency", "rolling_frequency", "rolling_frequency_as_printed", "rolling_frequency_no_slip"),
    ),
    "n-roll": Question(("n_roll",), ("n_roll", "n_roll_energy_balance")),
    "contact": Question(
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
    ),
    "moment": Question(
        ("yield_moment",),
        (
            "yield_moment",
            "yield_displacement",
            "unloaded_moment",
            "half_circles_moment",
            "fixed_approach_moment",
            "rolling_stiffness",
            "mean_rolling_moment",
            "mean_rolling_force",
        ),
    ),
}
_REPORT = Question(
    tuple(name for question in _QUESTIONS.values() for name in question.headline),
    tuple(dict.fromkeys(name for question in _QUESTIONS.values() for name in question.quantities)),
)
QUESTIONS: Mapping[str, Question] = MappingProxyType({**_QUESTIONS, "report": _REPORT})
