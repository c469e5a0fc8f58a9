"""The Python face of the inverse problem."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from itertools import chain
from math import prod
from typing import Any, overload

from ..errors import NoResult
from ..materials.library import Material, Materials
from ..quantities.errors import QuantityError
from ..quantities.nomenclature import named
from ..quantities.values import is_uncertain
from ..scene.inverse import AlreadyGiven, Observed, input_named
from ..scene.scene import broadcast, check_range
from ..scene.solver import in_si, materials_of, refuse_arrays, with_uncertainty
from ..scene.unknowns import solved
from .columns import BLOCK
from .inferred import SoughtOne


class InferredValues(dict[str, Any]):
    """The values of two inputs by name, and the condition number of both together."""

    def __init__(self, values: Mapping[str, Any], condition: Any) -> None:
        super().__init__(values)
        self.condition = condition


@overload
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
) -> Any: ...
@overload
def infer(
    wanted: Sequence[str],
    /,
    *,
    measured: Mapping[str, Any],
    material: str | Material | None = None,
    material2: str | Material | None = None,
    materials: Materials | None = None,
    model: str | None = None,
    **given: Any,
) -> InferredValues: ...
def infer(
    wanted: str | Sequence[str],
    /,
    *,
    measured: Mapping[str, Any],
    material: str | Material | None = None,
    material2: str | Material | None = None,
    materials: Materials | None = None,
    model: str | None = None,
    **given: Any,
) -> Any:
    """Return the value of an input at which a quantity has its measured value, or those of two inputs by two quantities.

    Parameters
    ----------
    wanted
        An input: surface_energy, work_of_adhesion, hamaker, yield_displacement, adhesion_hysteresis, youngs_modulus,
        shear_strength, radius or load, or the word of its option. A list of two for both.
    measured
        One quantity of the nomenclature with its value, which is a number, a list, a text and so on as for `solve`. For
        two inputs, two quantities.
    material, material2, materials, model, **given
        The rest of the scene, as `solve` takes it. Values that a material has of the inputs are not used.

    Returns
    -------
    A float in SI units; an array if a value was one; `Measured` or `Interval` if a given or measured value is
    uncertain. For two inputs, a dict of these by name. Its attribute `condition` is the condition number of the
    logarithms of the measured quantities as functions of those of the inputs.

    Raises
    ------
    AlreadyGiven, CannotInfer, MissingInput, QuantityError, UnknownMaterial, UnknownQuantity
        An input is wrong, or one is missing.
    NoDependence, NoSolution, SeveralSolutions; of two inputs Unseparated
        No value gives the measured one, or several do; or the condition number is above 1e8. Arrays hold nan there
        instead.

    >>> round(infer("gamma", measured={"pull_off_force": "300 nN"}, radius="2 um", radius2="plane"), 6)
    0.015915
    >>> measured = {"pull_off_force": "300 nN", "stiffness": "1 kN/m"}
    >>> both = infer(["gamma", "young"], measured=measured, material="quartz", radius="2 um", radius2="plane")
    >>> round(both["surface_energy"], 6), f"{both['youngs_modulus']:.4g}", round(both.condition, 2)
    (0.015915, '3.482e+10', 1.77)
    """
    names = _names(wanted)
    if not isinstance(measured, Mapping) or len(measured) != len(names):
        few = len(names) == 1
        raise QuantityError(
            "measured",
            str(measured),
            "is not one quantity and its value" if few else "is not two quantities and their values",
            'write {"pull_off_force": "300 nN"}'
            if few
            else 'write {"pull_off_force": "300 nN", "stiffness": "1 kN/m"}',
        )
    known, _ = in_si({str(word): value for word, value in measured.items()}, named)
    described, _ = in_si(given)
    for both in known.keys() & described.keys():
        raise AlreadyGiven(both, both)
    for each, value in {**known, **described}.items():
        check_range(each, value.value if is_uncertain(value) else value)
    spheres = materials_of(material, material2, materials)
    inputs = {**described, **known}

    def row(own: Mapping[str, Any]) -> Observed:
        return Observed.of([*known], {**inputs, **own}, *spheres, model=model)

    has_error_bars = any(map(is_uncertain, inputs.values()))
    arrays = {each: value for each, value in inputs.items() if not (isinstance(value, float) or is_uncertain(value))}
    if has_error_bars:
        refuse_arrays(inputs)
    if arrays and len(names) == 1:
        return _each(SoughtOne(names, [*known], doubts=False), arrays, row)
    if arrays:
        return _each_pair(names, arrays, row)
    whole = row({})
    found = solved(names, whole)
    values: Mapping[str, Any] = found.values
    if has_error_bars:
        from ..scene.uncertainty import inferred_uncertainties

        bars, _ = inferred_uncertainties(found.values, whole)
        values = {name: with_uncertainty(name, value, bars.get(name)) for name, value in values.items()}
    return InferredValues(values, found.condition) if len(names) > 1 else values[names[0]]


def _names(wanted: str | Sequence[str]) -> list[str]:
    """Return the names of one input, or of two."""
    words = [*map(str, wanted)] if isinstance(wanted, list | tuple) else [str(wanted)]
    names = [*map(input_named, words)]
    if isinstance(wanted, list | tuple) and len({*names}) != 2:
        remedy = 'write "gamma" or ["gamma", "young"]'
        raise QuantityError("wanted", str(wanted), "cannot be inferred: one input can, or two", remedy)
    return names


def _each_pair(
    names: Sequence[str], arrays: Mapping[str, Any], row: Callable[[Mapping[str, Any]], Observed]
) -> InferredValues:
    """Return the values of two inputs, element by element of arrays; `row` makes a row of some inputs and the others."""
    import numpy

    shape = broadcast(arrays)
    flat = {name: numpy.broadcast_to(value, shape).ravel().tolist() for name, value in arrays.items()}
    columns = numpy.full((len(names) + 1, prod(shape)), numpy.nan)
    for place, own in enumerate(zip(*flat.values(), strict=True)):
        with suppress(NoResult):
            pair = solved(names, row(dict(zip(flat, own, strict=True))))
            columns[:, place] = *pair.values.values(), pair.condition
    *found_values, condition = (column.reshape(shape) for column in columns)
    return InferredValues(dict(zip(names, found_values, strict=True)), condition)


def _each(wanted: SoughtOne, arrays: Mapping[str, Any], row: Callable[[Mapping[str, Any]], Observed]) -> Any:
    """Return the inferred values for arrays, nan where there is none."""
    import numpy

    shape = broadcast(arrays)
    flat = {name: numpy.broadcast_to(value, shape).ravel() for name, value in arrays.items()}
    found = numpy.full(prod(shape), numpy.nan)
    for start in range(0, len(found), BLOCK):
        part = slice(start, start + BLOCK)
        some = {name: values[part] for name, values in flat.items()}
        found[part] = _block(wanted, some, row)
    return found.reshape(shape)


def _block(wanted: SoughtOne, arrays: Mapping[str, Any], row: Callable[[Mapping[str, Any]], Observed]) -> Any:
    """Return the inferred values of some rows; raise the first error that is no NoResult."""
    from .block import Block
    from .cells import Numbers
    from .rows import evaluated

    class Elements(Block):
        """Rows of the elements of arrays."""

        def scene(self, given: Mapping[str, Any], rows: Any) -> Any:
            """Return the row of arrays."""
            del rows
            return row(given)

        def scene_of(self, place: int) -> Any:
            return row({name: float(values[place]) for name, values in arrays.items()})

    numbers = {name: Numbers(values) for name, values in arrays.items()}
    columns = evaluated(wanted, Elements(len(next(iter(arrays.values()))), numbers))
    for error in chain.from_iterable(reasons.values() for reasons in columns.reasons.values()):
        if not isinstance(error, NoResult):
            raise error
    return columns.column(wanted.name)
