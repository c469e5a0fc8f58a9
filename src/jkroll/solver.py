"""The Python face of a scene: names and values in, values out."""

from collections.abc import Iterable, Mapping
from typing import Any

from .errors import UnknownQuantity
from .materials import known_materials
from .nomenclature import NOMENCLATURE
from .scene import Scene
from .units import parse_quantity


def solve(
    wanted: str | Iterable[str], /, *, material: str | None = None, material2: str | None = None, **given: Any
) -> Any:
    """Compute quantities of the nomenclature from whatever is known of the scene.

    Parameters
    ----------
    wanted
        A name of the nomenclature, or several.
    material, material2
        Names or aliases of materials; `material2` for sphere 2, which is otherwise like sphere 1. A property given
        by name overrides the material's.
    **given
        Inputs by name: a float or an array in SI units, a text with a unit ("100 nm"), or a pint Quantity. Arrays
        broadcast. `radius2` may be infinite (a plane), and one Young's modulus too (a rigid body).

    Returns
    -------
    The value of a single wanted name, or a dict of name to value. SI numbers: floats, arrays, or pint Quantities if
    any input was one.

    Raises
    ------
    MissingInput, UnknownMaterial, UnknownQuantity, QuantityError, OutOfRange
        What was given is wrong, or not enough.
    NoResult
        The physics has no answer: a tension beyond pull-off, two rigid bodies. Arrays hold nan there instead.

    Source: the equation of each quantity, see `jkroll.NOMENCLATURE`. Valid: as each formula says.

    >>> f"{solve('r_min', radius='100 nm'):.3g}"
    '5e-05'
    >>> {name: round(value, 1) for name, value in solve(["n_grav"], material="quartz", radius=1e-7).items()}
    {'n_grav': 939.4}
    """
    names = [wanted] if isinstance(wanted, str) else list(wanted)
    described, registry = _in_si(given)
    materials = None if material is None and material2 is None else known_materials()
    scene = Scene(
        described,
        materials[material] if materials and material is not None else None,
        materials[material2] if materials and material2 is not None else None,
    )
    results = {name: scene[name] for name in names}
    if registry is not None:
        results = {name: registry.Quantity(value, NOMENCLATURE[name].unit) for name, value in results.items()}
    return results[names[0]] if isinstance(wanted, str) else results


def _in_si(given: Mapping[str, Any]) -> tuple[dict[str, Any], Any]:
    """SI numbers for texts and pint Quantities, and the registry of the latter if there were any."""
    values: dict[str, Any] = {}
    registry = None
    for name, value in given.items():
        if name not in NOMENCLATURE:
            raise UnknownQuantity(name)
        if isinstance(value, str):
            values[name] = parse_quantity(value, name)
        elif hasattr(value, "m_as"):
            registry = value._REGISTRY
            values[name] = value.m_as(NOMENCLATURE[name].unit)
        else:
            values[name] = float(value) if isinstance(value, int) else value
    return values, registry
