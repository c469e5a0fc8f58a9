"""Convert alternative inputs: a diameter to a radius, a shear modulus to Young's modulus."""

from collections.abc import Collection, Mapping
from typing import Any

from ..errors import BadRequest
from ..quantities.nomenclature import CONVERTED, NOMENCLATURE, of_sphere
from ..quantities.values import is_uncertain, middle

_SHEAR, _MODULI2 = "shear_modulus", ("shear_modulus2", "youngs_modulus2")
_CORRELATED = "correlated error bars"  # the status of a row in a table


def converted(given: Mapping[str, Any], of_solids: Mapping[str, Any], *, own_material2: bool) -> dict[str, Any]:
    """Return the inputs with diameters converted to R = D/2 and shear moduli to E = 2G(1 + ν).

    `of_solids`: the values of the materials, with their uncertainties. `own_material2`: True if sphere 2 has its own
    material; if not, sphere 2 takes the shear modulus and Poisson's ratio of sphere 1 unless others are given. A
    shear modulus without a Poisson's ratio is left unconverted. Raises BadRequest if the uncertainties of two inputs
    would be correlated.
    """
    known = {**of_solids, **given}
    if not own_material2 and "poisson_ratio2" in given and given.keys().isdisjoint(_MODULI2) and _SHEAR in given:
        if is_uncertain(given[_SHEAR]):
            remedy = "give --shear-modulus2, or --shear-modulus without an error bar"
            raise BadRequest(f"the spheres have one uncertain shear modulus, but different E; {remedy}", _CORRELATED)
        given = {**given, "shear_modulus2": given[_SHEAR]}
    factors = {"diameter": 0.5, "diameter2": 0.5}
    for sphere in (1, 2):
        modulus, name_of_ratio = of_sphere(sphere, _SHEAR), of_sphere(sphere, "poisson_ratio")
        if name_of_ratio not in known and not own_material2:
            name_of_ratio = "poisson_ratio"
        ratio = known.get(name_of_ratio)
        if modulus in given and ratio is not None:
            if is_uncertain(ratio) and (name_of_ratio in given or is_uncertain(given[modulus])):
                young, poisson = NOMENCLATURE[CONVERTED[modulus]].option, NOMENCLATURE[name_of_ratio].option
                remedy = f"give {young} with its error bar, or {poisson} without one"
                raise BadRequest(f"E = 2G(1 + ν) is correlated with ν, which is uncertain; {remedy}", _CORRELATED)
            factors[modulus] = 2 * (1 + middle(ratio))
    inputs = {}
    for name, value in given.items():
        if name in factors:
            inputs[CONVERTED[name]] = scaled(value, factors[name])
        else:
            inputs[name] = value
    return inputs


def lacked(missing: frozenset[str], stated: Collection[str]) -> frozenset[str]:
    """Return the missing inputs, with Poisson's ratio in place of E if a shear modulus was given."""
    for modulus in ("shear_modulus", "shear_modulus2"):
        if modulus in stated and CONVERTED[modulus] in missing:
            missing = missing - {CONVERTED[modulus]} | {of_sphere(NOMENCLATURE[modulus].sphere, "poisson_ratio")}
    return missing


def scaled(value: Any, factor: Any) -> Any:
    """Return a value times a factor, with its uncertainty if it has one.

    >>> from jkroll.quantities.values import Measured
    >>> scaled(Measured(2e-7, 4e-9), 0.5)
    Measured(value=1e-07, minus=2e-09, plus=2e-09)
    """
    if not is_uncertain(value):
        return value * factor
    return type(value).of(value.value * factor, **{side: number * factor for side, number in value.sides.items()})
