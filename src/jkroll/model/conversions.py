"""Inputs in place of others: a diameter for a radius, a shear modulus for Young's modulus. They are converted once."""

from collections.abc import Collection, Mapping
from typing import Any

from ..errors import BadRequest
from ..quantities.nomenclature import CONVERTED, NOMENCLATURE, of_sphere
from ..quantities.values import is_uncertain, middle


def converted(given: Mapping[str, Any], of_solids: Mapping[str, Any], *, own_material2: bool) -> dict[str, Any]:
    """Return inputs with R = D/2 in place of diameters and E = 2G(1 + ν) in place of shear moduli.

    `of_solids`: the values of the materials, with their uncertainties; `own_material2`: whether sphere 2 has a material
    of its own. A shear modulus stays where Poisson's ratio is missing. Raises BadRequest for an uncertain Poisson's
    ratio, with which the converted E would be correlated, and where the modulus of sphere 2 is open.
    """
    factors = {"diameter": 0.5, "diameter2": 0.5}
    known = {**of_solids, **given}
    for sphere in (1, 2):
        modulus, name = of_sphere(sphere, "shear_modulus"), of_sphere(sphere, "poisson_ratio")
        if name not in known and not own_material2:
            name = "poisson_ratio"
        if modulus in given and (ratio := known.get(name)) is not None:
            if is_uncertain(ratio) and (name in given or is_uncertain(given[modulus])):
                raise _correlated(modulus, name)
            factors[modulus] = 2 * (1 + middle(ratio))
    moduli = given.keys() & {"shear_modulus", "shear_modulus2", "youngs_modulus2"}
    if moduli == {"shear_modulus"} and "poisson_ratio2" in given and not own_material2:
        remedy = "give --shear-modulus2, or --young2"
        raise BadRequest(f"sphere 2 has a Poisson's ratio of its own, so its modulus is open; {remedy}")
    return {
        CONVERTED[name] if name in factors else name: scaled(value, factors[name]) if name in factors else value
        for name, value in given.items()
    }


def lacked(missing: frozenset[str], stated: Collection[str]) -> frozenset[str]:
    """Return missing inputs, with Poisson's ratio in place of E where a shear modulus lacks it."""
    for modulus in ("shear_modulus", "shear_modulus2"):
        if modulus in stated and CONVERTED[modulus] in missing:
            missing = missing - {CONVERTED[modulus]} | {of_sphere(NOMENCLATURE[modulus].sphere, "poisson_ratio")}
    return missing


def _correlated(modulus: str, ratio: str) -> BadRequest:
    """Return the error of a shear modulus beside an uncertain Poisson's ratio."""
    young, poisson = NOMENCLATURE[CONVERTED[modulus]].option, NOMENCLATURE[ratio].option
    remedy = f"give {young} with its error bar, or {poisson} without one"
    problem = f"{modulus} is converted by E = 2G(1 + ν), and ν is uncertain: the error bars of E and ν are correlated"
    return BadRequest(f"{problem}; {remedy}", "E and ν are correlated")


def scaled(value: Any, factor: Any) -> Any:
    """Return a value times a factor, with its uncertainty if it has one.

    >>> from jkroll.quantities.values import Measured
    >>> scaled(Measured(2e-7, 4e-9), 0.5)
    Measured(value=1e-07, minus=2e-09, plus=2e-09)
    """
    if not is_uncertain(value):
        return value * factor
    return type(value).of(value.value * factor, **{side: number * factor for side, number in value.sides.items()})
