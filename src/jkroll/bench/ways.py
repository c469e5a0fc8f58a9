"""Every way to a headline quantity that somebody might take, for the benchmark to compare.

`default` runs the package's own formulas on whatever it is given. The others are what a reader of the paper would write
down, the textbook's inversions, tables and quadratures.
"""

# ruff: noqa: N803  (the paper's symbols)

from collections.abc import Callable, Mapping
from typing import Any

from ..physics.elementary import cbrt, pi, sqrt
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.wiring import plan
from .forms import (
    Way,
    approach,
    approach_by_cbrt,
    by_newton,
    by_radicals,
    by_root_table,
    by_table,
    by_vieta,
    factor,
    force,
    half_circles,
    inertia,
    library_cbrt,
    linearised,
    log_root,
    margin,
    mass,
    quadrature,
    radius,
    radius_by_cbrt,
    reduced,
    slope,
    stable_factor,
    stable_margin,
)
from .reference import arguments_of, references

QUANTITIES = (
    "pull_off_force", "contact_radius", "approach", "contact_radius_at_load", "approach_at_load", "stiffness",
    "load_factor_at_approach", "yield_moment", "yield_force", "r_min", "n_grav", "vertical_frequency",
    "rolling_frequency", "n_roll",
)  # fmt: skip


def default(quantity: str) -> Callable[[Mapping[str, Any]], Any]:
    """The package's own way from the inputs of a quantity: the formulas that `jkroll.solve` runs."""
    names = arguments_of(references()[quantity])
    found = plan((quantity,), frozenset((*names, "energy_ratio")), own_material2=False)
    steps = [step for step in found.steps if step.name not in names]

    def run(point: Mapping[str, Any]) -> Any:
        values = {"energy_ratio": 1.0, **point}
        for step in steps:
            values[step.name] = step.formula(**{parameter: values[name] for parameter, name in step.arguments})
        return values[found.found[quantity]]

    return run


def with_units(point: Mapping[str, Any]) -> dict[str, Any]:
    """The inputs as pint Quantities, in base units: cube roots of J/m² and Pa have dimensions that round differently."""
    from ..quantities.pint_names import registry

    return {name: registry().Quantity(value, NOMENCLATURE[name].unit).to_base_units() for name, value in point.items()}


# --- All of them ------------------------------------------------------------------------------------------------------

OTHER_WAYS: Mapping[str, Mapping[str, Way]] = {
    "pull_off_force": {
        "R = R1R2/(R1+R2)": force,
        "R = 1/(1/R1+1/R2)": lambda R1, R2, w: 3 / 2 * pi * w / (1 / R1 + 1 / R2),
    },
    "contact_radius": {
        "** (1/3)": radius,
        "numpy.cbrt": radius_by_cbrt,
        "exp(log/3)": lambda R1, R2, w, E: log_root(9 * pi * w / 2 * reduced(R1, R2) ** 2 / E),
    },
    "approach": {
        "a0²/(3R), ** (1/3)": approach,
        "a0²/(3R), numpy.cbrt": approach_by_cbrt,
        "P_c/(E* a0)": lambda R1, R2, w, E: force(R1, R2, w) / (E * radius(R1, R2, w, E)),
    },
    "contact_radius_at_load": {
        "a0 x**(2/3), s = √(1+P/P_c)": lambda R1, R2, w, E, P, P_c: radius(R1, R2, w, E) * factor(P, P_c) ** (2 / 3),
        "a0 x**(2/3), stable s": lambda R1, R2, w, E, P, P_c: radius(R1, R2, w, E) * stable_factor(P, P_c) ** (2 / 3),
        "numpy.cbrt, stable s": lambda R1, R2, w, E, P, P_c: (
            radius_by_cbrt(R1, R2, w, E) * library_cbrt(stable_factor(P, P_c) ** 2)
        ),
    },
    "approach_at_load": {
        "Eq 6 through â, s = √(1+P/P_c)": lambda R1, R2, w, E, P, P_c: (
            approach(R1, R2, w, E) * (3 * factor(P, P_c) ** (4 / 3) - 2 * factor(P, P_c) ** (1 / 3))
        ),
        "Eq 6 through â, stable s": lambda R1, R2, w, E, P, P_c: (
            approach(R1, R2, w, E) * (3 * stable_factor(P, P_c) ** (4 / 3) - 2 * stable_factor(P, P_c) ** (1 / 3))
        ),
        "8+9P/P_c": lambda R1, R2, w, E, P, P_c: (
            approach_by_cbrt(R1, R2, w, E) * library_cbrt(factor(P, P_c)) * (8 + 9 * P / P_c) / (2 * (1 + 3 * margin(P, P_c)))
        ),
        "8(P+P_c)+P": lambda R1, R2, w, E, P, P_c: (
            cbrt(3 / 4 * (pi * pi) * (w / E) * (w / E) * reduced(R1, R2) * stable_factor(P, P_c))
            * ((8 * (P + P_c) + P) / P_c)
            / (2 * (1 + 3 * stable_margin(P, P_c)))
        ),
    },
    "stiffness": {
        "s = √(1+P/P_c)": lambda R1, R2, w, E, P, P_c: (
            6 * E * radius_by_cbrt(R1, R2, w, E) * library_cbrt(factor(P, P_c) ** 2) * margin(P, P_c) / (2 + 3 * margin(P, P_c))
        ),
        "slopes of P(â) and δ(â)": lambda R1, R2, w, E, P, P_c: (
            force(R1, R2, w) / approach(R1, R2, w, E) * slope(factor(P, P_c) ** (2 / 3))
        ),
    },
    "load_factor_at_approach": {
        "Newton on the quartic": by_newton,
        "closed form, radicals": by_radicals,
        "closed form, Vieta": by_vieta,
        "table in δ": by_table,
        "table in √(δ−δ_fold)": by_root_table,
    },
    "yield_moment": {
        "s = √(1+P/P_c)": lambda R1, R2, w, xi, P, P_c: 2 * force(R1, R2, w) * xi * (1 + margin(P, P_c)),
        "(x**(2/3))**1.5": lambda R1, R2, w, xi, P, P_c: (
            4 * force(R1, R2, w) * (stable_factor(P, P_c) ** (2 / 3)) ** 1.5 * xi
        ),
        "half-circles, Eq 19": half_circles,
        "linearised, Eq 24": linearised,
        "Gauss 8 in r": quadrature(8, in_angle=False),
        "Gauss 64 in r": quadrature(64, in_angle=False),
        "Gauss 4 in angle": quadrature(4, in_angle=True),
        "Gauss 8 in angle": quadrature(8, in_angle=True),
        "Gauss 16 in angle": quadrature(16, in_angle=True),
    },
    "yield_force": {
        "M/R1": lambda R1, R2, w, xi, P, P_c: 4 * force(R1, R2, w) * stable_factor(P, P_c) * xi / R1,
        "M/R1, s = √(1+P/P_c)": lambda R1, R2, w, xi, P, P_c: 4 * force(R1, R2, w) * factor(P, P_c) * xi / R1,
    },
    "r_min": {
        "R1R2/ξ": lambda R1, R2, xi: R1 * R2 / xi,
        "R(R1+R2)/ξ": lambda R1, R2, xi: reduced(R1, R2) * (R1 + R2) / xi,
    },
    "n_grav": {
        "Eq 30, s = √(1+P/P_c)": lambda R1, R2, w, rho, xi, g, P, P_c: sqrt(
            9 * (w / 2) * reduced(R1, R2) * xi * factor(P, P_c) / (R1**4 * rho * g)
        ),
        "Eq 30, stable s": lambda R1, R2, w, rho, xi, g, P, P_c: sqrt(
            9 * (w / 2) * reduced(R1, R2) * xi * stable_factor(P, P_c) / (R1**4 * rho * g)
        ),
    },
    "vertical_frequency": {
        "√(k/m)/2π, s = √(1+P/P_c)": lambda R1, R2, w, E, rho, P, P_c: (
            sqrt(
                6 * E * radius(R1, R2, w, E) * factor(P, P_c) ** (2 / 3) * margin(P, P_c) / (2 + 3 * margin(P, P_c))
                / reduced(mass(R1, rho), mass(R2, rho))
            ) / (2 * pi)
        ),
        "√(k/m)/2π, stable s": lambda R1, R2, w, E, rho, P, P_c: (
            sqrt(
                6 * E * radius(R1, R2, w, E) * stable_factor(P, P_c) ** (2 / 3) * stable_margin(P, P_c)
                / (2 + 3 * stable_margin(P, P_c)) / reduced(mass(R1, rho), mass(R2, rho))
            ) / (2 * pi)
        ),
    },
    "rolling_frequency": {
        "I = I1I2/(I1+I2)": lambda R1, R2, w, rho, P, P_c: (
            sqrt(4 * force(R1, R2, w) * factor(P, P_c) * reduced(R1, R2) / reduced(inertia(R1, rho), inertia(R2, rho))) / (2 * pi)
        ),
    },
    "n_roll": {
        "P_cδ0/(14πP_cxξ)": lambda R1, R2, w, E, xi, P, P_c: (
            force(R1, R2, w) * approach(R1, R2, w, E) / (14 * pi * force(R1, R2, w) * factor(P, P_c) * xi)
        ),
        "Eq 49 as printed": lambda R1, R2, w, E, xi, P, P_c: (
            3 / (14 * (9 * pi) ** (1 / 3)) * (w / 2 / E) ** (2 / 3) * reduced(R1, R2) ** (1 / 3) / xi / factor(P, P_c)
        ),
    },
}  # fmt: skip
