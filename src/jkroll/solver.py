"""The Python face of a scene: names and values in, values out."""

import math
from collections.abc import Iterable, Mapping
from contextlib import AbstractContextManager, nullcontext
from typing import Any

from .errors import MAX_QUOTED, MalformedQuantity, UnknownQuantity
from .materials import Materials, known_materials
from .nomenclature import INFINITY, NOMENCLATURE
from .scene import MAY_BE_ZERO, SMALLEST, Scene
from .units import parse_quantity


def solve(
    wanted: str | Iterable[str],
    /,
    *,
    material: str | None = None,
    material2: str | None = None,
    materials: Materials | None = None,
    **given: Any,
) -> Any:
    """Compute quantities of the nomenclature from whatever is known of the scene.

    Parameters
    ----------
    wanted
        A name of the nomenclature, or several.
    material, material2
        Names or aliases of materials; `material2` for sphere 2, which is otherwise like sphere 1. A property given
        by name overrides the material's.
    materials
        Where materials are looked up: `Materials(["mine.toml"])` for some of your own besides the shipped ones.
    **given
        Inputs by name: a float, an array or a list in SI units, a text with a unit ("100 nm"), or a pint Quantity.
        Arrays broadcast. `radius2` may be infinite (a plane), and one Young's modulus too (a rigid body).

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
    if material is not None or material2 is not None:
        materials = materials or known_materials()
    scene = Scene(
        described,
        materials[material] if materials and material is not None else None,
        materials[material2] if materials and material2 is not None else None,
    )
    with _quiet(described.values()):
        results = {name: _with_nan(name, scene[name]) for name in names}
    if registry is not None:
        results = {name: registry.Quantity(value, NOMENCLATURE[name].unit) for name, value in results.items()}
    return results[names[0]] if isinstance(wanted, str) else results


def _with_nan(name: str, value: Any) -> Any:
    """A result; the elements of an array that are no answer become nan."""
    if isinstance(value, float):
        return value
    import numpy

    size = abs(value)
    may_be = (size == 0) if name in MAY_BE_ZERO else False
    return numpy.where((size >= SMALLEST) & (size < INFINITY) | may_be, value, math.nan)


def _quiet(values: Iterable[Any]) -> AbstractContextManager[Any]:
    """No warnings from numpy where an element of an array has no answer and holds nan or inf."""
    if all(isinstance(value, float) for value in values):
        return nullcontext()
    import numpy

    return numpy.errstate(all="ignore")


def _in_si(given: Mapping[str, Any]) -> tuple[dict[str, Any], Any]:
    """SI numbers for texts, lists and pint Quantities, and the registry of the latter if there were any."""
    values: dict[str, Any] = {}
    registry = None
    for name, value in given.items():
        if name not in NOMENCLATURE:
            raise UnknownQuantity(name)
        if hasattr(value, "m_as"):
            registry = value._REGISTRY
            if not value.is_compatible_with(NOMENCLATURE[name].unit):
                raise MalformedQuantity(name, str(value), "is of another dimension")
            value = value.m_as(NOMENCLATURE[name].unit)  # noqa: PLW2901
        values[name] = _number(name, value)
    return values, registry


def _number(name: str, value: Any) -> Any:
    """A float or an array of floats, for a number, a text, or a sequence of either."""
    if isinstance(value, str):
        return parse_quantity(value, name)
    if isinstance(value, float):
        return float(value)
    if isinstance(value, (list, tuple)):
        value = [_number(name, item) for item in value]
    import numpy

    try:
        array = numpy.asanyarray(value)
        if array.dtype.kind in "fiu":
            return array.astype(float) if array.ndim else float(array)
    except (ValueError, OverflowError):
        pass
    raise MalformedQuantity(name, str(value)[:MAX_QUOTED], "is not a number")
