"""The fit of a measured curve as a value: what was known, what was found, and how far it can be trusted."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from numpy import inf, sqrt

from .fit_branches import Range
from .fit_laws import Array
from .frame import DEFAULTS

STRONG = 5.0  # Tabor parameter above which JKR holds for w and E*

# Results: their names, and the quantity of the nomenclature whose unit and words they have.
RESULTS: Mapping[str, str] = {
    "work_of_adhesion_opening": "work_of_adhesion",
    "work_of_adhesion_closing": "work_of_adhesion",
    "adhesion_hysteresis": "adhesion_hysteresis",
    "hysteresis_fraction": "hysteresis_fraction",
    "contact_modulus": "contact_modulus",
    "contact_point": "approach",
    "pull_off_force_fitted": "pull_off_force",
    "pull_off_force_measured": "pull_off_force",
}
FITTED = ("work_of_adhesion_opening", "work_of_adhesion_closing", "contact_modulus", "contact_point")


class Known(NamedTuple):
    """The data of an instrument and a contact that are known, with relative standard deviations.

    Without a radius the fit gives wR and E*√R. `stiffness` is that of the lever, for a travel alone.
    """

    radius: float | None = None
    radius_error: float = 0.0
    stiffness: float = inf
    stiffness_error: float = 0.0
    spacing: float = DEFAULTS["atomic_spacing"]
    law: str = "jkr"
    profile: str = "paraboloid"
    branch: str = "both"
    range: Range | None = None
    tilt: bool = False


class Errors(NamedTuple):
    """The standard deviations of a result by their causes."""

    statistical: float = 0.0
    calibration: float = 0.0
    model: float = 0.0

    @property
    def total(self) -> float:
        """The root of the sum of squares."""
        return float(sqrt(sum(each * each for each in self)))


@dataclass
class Fit:
    """The fit of a curve, in SI units.

    `values` and `errors` by the names of `RESULTS`; `covariance` is the statistical one of those of `names`, in their
    units. `remarks` are sentences by code. Of a curve without adhesion, `largest_adhesion` is the upper limit of w.
    """

    known: Known
    kind: str
    values: dict[str, float] = field(default_factory=dict)
    errors: dict[str, Errors] = field(default_factory=dict)
    names: tuple[str, ...] = ()
    covariance: Any = None
    by_law: dict[str, dict[str, float]] = field(default_factory=dict)
    remarks: dict[str, str] = field(default_factory=dict)
    goodness: dict[str, float] = field(default_factory=dict)
    points: dict[str, Array] = field(default_factory=dict)
    largest_adhesion: float | None = None

    @property
    def radius(self) -> float:
        """The reduced radius; 1 m where it is not known, so that w stands for wR."""
        return self.known.radius or 1.0

    @property
    def is_scaled(self) -> bool:
        """True where no radius is known: w is wR, E* is E*√R."""
        return self.known.radius is None

    @property
    def law_that_holds(self) -> str:
        """The law by which w and E* are best: Maugis' where the Tabor parameter is small."""
        return "jkr" if self.goodness.get("tabor_parameter", inf) >= STRONG else "maugis"
