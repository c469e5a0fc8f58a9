"""The Python face of a scene: names and values in, values out."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from copy import copy
from itertools import product
from typing import Any

from ..errors import NoResult
from ..materials.library import Material, Materials, known_materials
from ..quantities.errors import QuantityError, UnknownQuantity
from ..quantities.nomenclature import INFINITY, NOMENCLATURE
from ..quantities.parsing import parse_quantity
from ..text import MAX_QUOTED
from .errors import ShapeMismatch
from .scene import MAY_BE_ZERO, SMALLEST, Scene, check_range, is_extreme

Place = tuple[slice, ...]  # of a block in an array
BLOCK = 16384  # elements evaluated at once: few enough that what lies between two formulas stays in the cache


def solve(
    wanted: str | Iterable[str],
    /,
    *,
    material: str | Material | None = None,
    material2: str | Material | None = None,
    materials: Materials | None = None,
    **given: Any,
) -> Any:
    """Compute quantities of the nomenclature from whatever is known of the scene.

    Parameters
    ----------
    wanted
        A name of the nomenclature, or several.
    material, material2
        Materials, or their names or aliases; `material2` for sphere 2, which is otherwise like sphere 1. A property given
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
    spheres = (_material(material, materials), _material(material2, materials))
    with _quiet(described.values()):
        if _is_large(described):
            results = _in_blocks(names, described, spheres)
        else:
            scene = Scene(described, *spheres)
            results = {name: _with_nan(name, scene[name]) for name in names}
        results = _with_extremes(results, described, spheres)
    if registry is not None:
        results = {name: registry.Quantity(value, NOMENCLATURE[name].unit) for name, value in results.items()}
    return results[names[0]] if isinstance(wanted, str) else results


def _material(material: str | Material | None, materials: Materials | None) -> Material | None:
    """Return the material of a name; a material, or None, as it is."""
    return (materials or known_materials())[material] if isinstance(material, str) else material


def _with_extremes(
    results: dict[str, Any], given: Mapping[str, Any], spheres: tuple[Material | None, Material | None]
) -> dict[str, Any]:
    """The results, those of elements with very large or small inputs computed as single numbers, which may be any."""
    arrays = {name: value for name, value in given.items() if not isinstance(value, float)}
    if not arrays or not is_extreme(given, given):
        return results
    import numpy

    shape = numpy.broadcast_shapes(*(value.shape for value in arrays.values()))
    everywhere = {name: numpy.broadcast_to(value, shape) for name, value in given.items()}
    results = {name: numpy.array(numpy.broadcast_to(value, shape)) for name, value in results.items()}
    for place in numpy.ndindex(shape):
        scene = {name: float(value[place]) for name, value in everywhere.items()}
        if is_extreme(scene, scene):
            one = Scene(scene, *spheres)
            for name, values in results.items():
                try:
                    values[place] = one[name]
                except NoResult:
                    values[place] = math.nan
    return results


def _is_large(given: Mapping[str, Any]) -> bool:
    """Whether the arrays among the inputs, broadcast, have more elements than a block."""
    arrays = [value for value in given.values() if not isinstance(value, float)]
    if not arrays:
        return False
    import numpy

    try:
        shape = numpy.broadcast_shapes(*(value.shape for value in arrays))
    except ValueError:
        raise ShapeMismatch(
            [(name, value.shape) for name, value in given.items() if not isinstance(value, float)]
        ) from None
    return math.prod(shape) > BLOCK and all(type(value) is numpy.ndarray for value in arrays)


def _in_blocks(
    names: Sequence[str], given: Mapping[str, Any], spheres: tuple[Material | None, Material | None]
) -> dict[str, Any]:
    """The results for large arrays, a block of elements at a time: beyond the results, it takes the memory of one."""
    import numpy

    arrays = {name: value for name, value in given.items() if not isinstance(value, float)}
    for name, value in arrays.items():
        for place in _blocks(value.shape):
            check_range(name, value[place])
    # One element of each array says what is asked, what of it no array enters, and whether a float forbids it.
    scene = Scene({**given, **{name: value[(slice(1),) * value.ndim] for name, value in arrays.items()}}, *spheres)
    results = {name: scene[name] for name in names}
    plan = scene.plan(*names)
    shapes = {name: value.shape for name, value in arrays.items() if name in plan.inputs}
    space = numpy.broadcast_shapes(*shapes.values())
    for step in plan.steps:
        entering = [shapes[name] for _, name in step.arguments if name in shapes]
        if entering:
            shapes[step.name] = numpy.broadcast_shapes(*entering)
    varying = [name for name in results if plan.found[name] in shapes]
    results |= {name: numpy.empty(shapes[plan.found[name]]) for name in varying}
    constant = {name: value for name, value in scene.values.items() if name not in shapes}
    for place in _blocks(space) if varying else ():
        block = copy(scene)
        block.values = {**constant, **{name: _part(arrays[name], place) for name in arrays if name in shapes}}
        for name in varying:
            value = block[name]
            _part(results[name], place)[...] = value if _has_answers(value) else _with_nan(name, value)
    return results


def _blocks(shape: tuple[int, ...]) -> Iterator[Place]:
    """Where the blocks of an array are: whole along its last axes, as far as a block reaches."""
    slices, room = [], BLOCK
    for length in reversed(shape):
        step = max(1, min(length, room))
        slices.append([slice(start, start + step) for start in range(0, length, step)])
        room //= step
    return product(*reversed(slices))


def _part(array: Any, place: Place) -> Any:
    """The part of an array that broadcasts to a block."""
    own = place[len(place) - array.ndim :]
    return array[tuple(where if length > 1 else slice(1) for where, length in zip(own, array.shape, strict=True))]


def _has_answers(values: Any) -> bool:
    """Whether each element is a number that doubles hold with all digits, and not 0: soon seen, and the usual case."""
    size = abs(values)
    return bool(size.min() >= SMALLEST and size.max() < INFINITY)


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
                raise QuantityError(name, str(value), "is of another dimension")
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
        if numpy.ma.isMaskedArray(array):
            raise QuantityError(name, "a masked array", "has cells without a value; fill it first")
        if array.dtype.kind in "fiu":
            return array.astype(float, copy=False) if array.ndim else float(array)
    except (ValueError, OverflowError):
        pass
    raise QuantityError(name, str(value)[:MAX_QUOTED], "is not a number")
