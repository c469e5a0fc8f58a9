"""The result of a fit: the known data, the fitted values, their errors, and remarks."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, NamedTuple, Self

from numpy import inf, sqrt

from ..quantities.laws import DEFAULT_LAW, JKR, LAWS, MAUGIS, PARABOLOID
from ..quantities.nomenclature import DEFAULTS
from ..quantities.values import middle
from .branches import RADIUS, LoadRange
from .force_curves import Array

LEAST_TABOR = 5.0  # least Tabor parameter at which JKR gives the best w and E*
HALF_SPACING = "z0/2"  # a variant of Maugis' law: at half the atomic spacing

# The inputs that are elastic constants of the bodies.
BODIES = ("youngs_modulus", "youngs_modulus2", "poisson_ratio", "poisson_ratio2")

# The name of each result, and the quantity of the nomenclature that gives its unit and meaning.
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


class Known(NamedTuple):
    """The known data of an instrument and a contact, with relative standard deviations, and the options of a fit.

    Without a radius the fit gives wR and E*√R. `stiffness` is that of the lever; `given` has the inputs by
    name, some with uncertainties.
    """

    radius: float | None = None
    radius_error: float = 0.0
    stiffness: float = inf
    stiffness_error: float = 0.0
    spacing: float = DEFAULTS["atomic_spacing"]
    law: str = DEFAULT_LAW
    profile: str = PARABOLOID
    branch: str = "both"
    range: LoadRange | None = None
    tilt: bool = False
    given: Mapping[str, Any] = MappingProxyType({})

    @property
    def bodies(self) -> dict[str, float]:
        """The given Young's moduli and Poisson's ratios by name."""
        return {name: float(middle(self.given[name])) for name in BODIES if name in self.given}


def ratio_of_plane(given: Mapping[str, Any]) -> float | None:
    """Return Poisson's ratio of body 2 among inputs: that of body 1 if only one is given, None without any."""
    ratio = given.get("poisson_ratio2", given.get("poisson_ratio"))
    return None if ratio is None else float(middle(ratio))


def is_on_plane(given: Mapping[str, Any]) -> bool:
    """Return whether radii among inputs are those of a sphere on a plane; a reduced radius counts as such."""
    return "reduced_radius" in given or middle(given.get("radius2", given.get("diameter2", 0.0))) == inf


class Errors(NamedTuple):
    """The standard deviations of a result by cause; None for a cause that was not computed."""

    statistical: float | None = None
    calibration: float | None = None
    model: float | None = None

    @property
    def total(self) -> float:
        """The root of the sum of the squares of the computed errors."""
        return float(sqrt(sum(error * error for error in self if error is not None)))

    def plus(self, part: str, moves: Sequence[float]) -> Self:
        """Return the errors with moves of the result added to one part, in quadrature."""
        if not moves:
            return self
        old = getattr(self, part) or 0.0
        return self._replace(**{part: float(sqrt(old * old + sum(move * move for move in moves)))})


def best_law(tabor_parameter: float) -> str:
    """Return the law that gives the best w and E*: Maugis' law if the Tabor parameter is small, otherwise JKR."""
    return JKR if tabor_parameter >= LEAST_TABOR else MAUGIS


def key_of(law: str, variant: str = PARABOLOID) -> str:
    """Return the key of a law in `Fit.by_law`. `variant`: a profile, or HALF_SPACING."""
    return law if variant == PARABOLOID else f"{law}, {variant}"


def law_and_variant(key: str) -> tuple[str, str]:
    """Return the law and the variant of a key in `Fit.by_law`."""
    law, _, variant = key.partition(", ")
    return law, variant or PARABOLOID


@dataclass
class Fit:
    """The fit of a curve, in SI units.

    The keys of `values` and `errors` are the names of `RESULTS`, and `by_law` has the values by each law under the
    keys of `key_of`. `covariance` is the statistical covariance of the results in `names`, in their units. `remarks`
    are sentences by code; `baselines` and `fitted_loads` (least, largest) are by branch. `largest_adhesion` is the
    upper limit of w for a curve without adhesion.
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
    baselines: dict[str, dict[str, float]] = field(default_factory=dict)
    fitted_loads: dict[str, tuple[float, float]] = field(default_factory=dict)
    largest_adhesion: float | None = None

    @property
    def curve(self) -> dict[str, Array]:
        """The points as columns under headers with SI units, as `--curve --csv` writes them."""
        heads = {
            "branch": "branch", "z": "contact_radius_at_load [m]" if self.kind == RADIUS else "z [m]",
            "force": "load [N]", "model": "load_fitted [N]", "residual": "residual [N]",
            "release_rate": f"energy_release_rate [{'J/m' if self.is_scaled else 'J/m^2'}]",
            "contact_radius": f"contact_radius [{'m^0.5' if self.is_scaled else 'm'}]",
        }  # fmt: skip
        return {head: self.points[name] for name, head in heads.items()}

    @property
    def is_scaled(self) -> bool:
        """True if no radius is known, so that w stands for wR, and E* for E*√R."""
        return self.known.radius is None

    @property
    def theory(self) -> str:
        """The short name of the fitted law: Hertz without adhesion."""
        return LAWS[self.known.law].short if self.largest_adhesion is None else "Hertz"

    @property
    def law_that_holds(self) -> str:
        """The law that gives the best w and E*; JKR if the Tabor parameter is not known."""
        return best_law(self.goodness.get("tabor_parameter", inf))

    @property
    def better_law(self) -> str:
        """The law to fit instead; "" if the fitted law holds, as Maugis' does for any Tabor parameter."""
        is_judged = self.known.law != MAUGIS and "tabor_parameter" in self.goodness
        return self.law_that_holds if is_judged and self.law_that_holds != self.known.law else ""

    @property
    def other_modulus(self) -> tuple[str, float] | None:
        """The name and the value of the one unknown Young's modulus; None if it does not follow from E*.

        (1 − ν²)/E = 1/E* − (1 − ν'²)/E', where E' and ν' are those of the known body; a rigid body needs no ν'.
        """
        bodies = self.known.bodies
        for known, sought in (("", "2"), ("2", "")):
            modulus, ratio = bodies.get(f"youngs_modulus{known}"), bodies.get(f"poisson_ratio{sought}")
            if self.is_scaled or modulus is None or ratio is None or f"youngs_modulus{sought}" in bodies:
                continue
            if f"poisson_ratio{known}" not in bodies and modulus < inf:
                continue
            known_ratio = bodies.get(f"poisson_ratio{known}", 0.0)
            compliance = 1 / self.values["contact_modulus"] - (1 - known_ratio**2) / modulus
            if compliance > 0:
                return f"youngs_modulus{sought}", (1 - ratio**2) / compliance
        return None
