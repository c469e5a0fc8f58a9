"""The Python face of the inverse problem."""

from collections.abc import Callable, Mapping
from itertools import chain
from math import prod
from typing import Any

from ..errors import NoResult
from ..materials.library import Material, Materials
from ..quantities.errors import QuantityError
from ..quantities.nomenclature import named
from ..quantities.values import is_uncertain
from ..scene.inverse import SIZES, CannotInfer, solution
from ..scene.scene import Scene, check_range
from ..scene.solver import broadcast, in_si, materials_of, uncertain_scene, with_uncertainty
from ..text import MAX_QUOTED
from .inferred import Observed, Sought, observed

_BLOCK = 1 << 13  # values that are inferred at once


def infer(
    wanted: str,
    /,
    *,
    measured: Mapping[str, Any],
    material: str | Material | None = None,
    material2: str | Material | None = None,
    materials: Materials | None = None,
    model: str | None = None,
    **given: Any,
) -> Any:
    """Return the value of an input at which a quantity has its measured value.

    Parameters
    ----------
    wanted
        An input: surface_energy, work_of_adhesion, yield_displacement, adhesion_hysteresis, youngs_modulus, radius or
        load, or the word of its option.
    measured
        One quantity of the nomenclature with its value, which is a number, a list, a text and so on as for `solve`.
    material, material2, materials, model, **given
        The rest of the scene, as `solve` takes it. A value that a material has of the input is not used.

    Returns
    -------
    A float in SI units; an array if a value was one; `Measured` or `Interval` if a given or measured value is uncertain.

    Raises
    ------
    AlreadyGiven, CannotInfer, MissingInput, QuantityError, UnknownMaterial, UnknownQuantity
        An input is wrong, or one is missing.
    NoDependence, NoSolution, SeveralSolutions
        No value gives the measured one, or several do. Arrays hold nan there instead.

    >>> round(infer("gamma", measured={"pull_off_force": "300 nN"}, radius="2 um", radius2="plane"), 6)
    0.015915
    """
    name = named(str(wanted))
    if name not in SIZES:
        raise CannotInfer(str(wanted))
    if not isinstance(measured, Mapping) or len(measured) != 1:
        raise QuantityError(
            "measured",
            str(measured)[:MAX_QUOTED],
            "is not one quantity and its value",
            'write {"pull_off_force": "300 nN"}',
        )
    ((word, value),) = measured.items()
    known, _ = in_si({named(str(word)): value})
    ((quantity, at),) = known.items()
    described, _ = in_si(given)
    for each, value in {quantity: at, **described}.items():
        check_range(each, value.value if is_uncertain(value) else value)
    spheres = materials_of(material, material2, materials)
    if any(map(is_uncertain, (at, *described.values()))):
        return _uncertain(name, quantity, at, uncertain_scene(described, spheres, model))
    if all(isinstance(each, float) for each in (at, *described.values())):
        return solution(name, quantity, at, Scene(described, *spheres, model=model)).value

    def row(inputs: Mapping[str, Any]) -> Observed:
        return observed(quantity, inputs, *spheres, model=model)

    return _each(Sought(name, quantity, doubts=False), {quantity: at, **described}, row)


def _uncertain(name: str, quantity: str, at: Any, scene: Scene) -> Any:
    """Return an inferred value with its uncertainty."""
    from ..scene.uncertainty import inferred_uncertainty

    found = solution(name, quantity, at.value if is_uncertain(at) else at, scene)
    uncertainty, _ = inferred_uncertainty(name, quantity, at, found, scene)
    return with_uncertainty(found.value, uncertainty)


def _each(wanted: Sought, given: Mapping[str, Any], row: Callable[[Mapping[str, Any]], Observed]) -> Any:
    """Return the inferred values for arrays, nan where there is none; `row` makes rows of inputs and the measured value."""
    import numpy

    arrays = {name: value for name, value in given.items() if not isinstance(value, float)}
    shape = broadcast(arrays)
    flat = {name: numpy.broadcast_to(value, shape).ravel() for name, value in arrays.items()}
    found = numpy.full(prod(shape), numpy.nan)
    for start in range(0, len(found), _BLOCK):
        part = slice(start, start + _BLOCK)
        some = {name: values[part] for name, values in flat.items()}
        found[part] = _block(wanted, some, lambda inputs: row({**given, **inputs}))
    return found.reshape(shape)


def _block(wanted: Sought, arrays: Mapping[str, Any], row: Callable[[Mapping[str, Any]], Observed]) -> Any:
    """Return the inferred values of some rows; raise the first error that is no NoResult."""
    from .cells import Numbers
    from .rows import Block, evaluated

    block = Block(
        len(next(iter(arrays.values()))),
        {name: Numbers(values) for name, values in arrays.items()},
        (),
        lambda inputs, _: row(inputs),
        lambda place: row({name: float(values[place]) for name, values in arrays.items()}),
        lambda _: None,
    )
    columns = evaluated(wanted, block)
    for error in chain.from_iterable(reasons.values() for reasons in columns.reasons.values()):
        if not isinstance(error, NoResult):
            raise error
    return columns.column(wanted.name)
