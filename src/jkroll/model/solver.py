"""The Python interface: `solve` for the quantities of a scene, and the formulas for numbers and containers."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from functools import wraps
from math import isfinite
from typing import TYPE_CHECKING, Any, overload

from ..errors import BadRequest, NoResult
from ..materials.library import Material, Materials, known_materials
from ..physics import FORMULAS as PLAIN_FORMULAS
from ..quantities.laws import law_given
from ..quantities.nomenclature import CONVERTED, NOMENCLATURE, UnknownQuantity, named
from ..quantities.values import QuantityError, is_uncertain
from ..text import listed
from .column import broadcast
from .containers import Reader, quantity_of, units_of
from .frame import Frame
from .plan import parameters_of
from .reasons import NO_DOUBLE, Failure, failure_of, reason_for
from .uncertainty import error_bars, no_error_bar

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

    Floats = NDArray[float64]

Solids = str | Material | Sequence[str | Material] | None  # one material, or one for each element
Words = str | Sequence[str] | None

ELEMENTS_AT_ONCE = 1 << 14  # intermediate results then fit into the processor's cache


@overload
def solve(  # type: ignore[overload-overlap]  # with one law and one material, floats give a float
    wanted: str,
    /,
    *,
    material: str | Material | None = None,
    material2: str | Material | None = None,
    materials: Materials | None = None,
    model: str | None = None,
    profile: str | None = None,
    units: None = None,
    **given: float,
) -> float: ...
@overload
def solve(
    wanted: str,
    /,
    *,
    material: Solids = None,
    material2: Solids = None,
    materials: Materials | None = None,
    model: Words = None,
    profile: Words = None,
    units: None = None,
    **given: "float | Floats",
) -> "Floats": ...
@overload
def solve(
    wanted: list[str] | tuple[str, ...],
    /,
    *,
    material: str | Material | None = None,
    material2: str | Material | None = None,
    materials: Materials | None = None,
    model: str | None = None,
    profile: str | None = None,
    units: None = None,
    **given: float,
) -> dict[str, float]: ...
@overload
def solve(wanted: str, /, **scene: Any) -> Any: ...
@overload
def solve(wanted: Iterable[str], /, **scene: Any) -> dict[str, Any]: ...
def solve(
    wanted: str | Iterable[str],
    /,
    *,
    material: Solids = None,
    material2: Solids = None,
    materials: Materials | None = None,
    model: Words = None,
    profile: Words = None,
    units: str | None = None,
    **given: Any,
) -> Any:
    """Compute quantities of the nomenclature from the known inputs of a scene.

    Only values are returned, without assumptions, exceeded limits, or notes on a material's source. The uncertainties
    of materials enter only if an input is uncertain, too. `jkroll.answer` has all of these, for one scene.

    Parameters
    ----------
    wanted
        A name of the nomenclature, or several. The name of an option or a symbol will do: "gamma" is
        "surface_energy", "P_c" is "pull_off_force".
    material, material2
        Materials, or their names or aliases; `material2` is for sphere 2, which otherwise is like sphere 1. A property
        given by name overrides the material's. A list or column has a material for each element; `model` and `profile`
        may also be lists.
    materials
        A collection to look materials up: `Materials("mine.toml")` has your own and the shipped ones.
    model
        The law of attraction: "jkr" (the paper's, the default), "maugis" or "dmt".
    profile
        The shape of body 1: "paraboloid" (the default) or "sphere", for a rigid sphere on a soft plane by JKR.
    units
        "pint" or "astropy": results are Quantities of that package. By default, they are Quantities if an input is.
    **given
        Inputs by name: a float, an array or a list in SI units, a text with a unit ("100 nm"), or a Quantity of pint or
        astropy, also inside an array of xarray or dask. Arrays broadcast by position. Arrays of pandas and xarray are
        aligned by their labels, as in arithmetic, and their attribute "units" is read. `radius2` may be infinite (a
        plane), and so may one Young's modulus (a rigid body). Single values may be uncertain: `Measured`, `Interval`,
        "25±5 mJ/m2", "20 to 30 mJ/m2", a pint Measurement, or a number of the package `uncertainties` that is
        independent of the other inputs.

    Returns
    -------
    The value of a single name, or a dict of values by name. Values are floats or arrays in SI units; Quantities if an
    input was a Quantity; a Series of pandas or a DataArray of xarray with the labels of the inputs, if an input was
    such a container. A result has the shape of the arrays that it depends on: for a fixed ξ, `yield_force` is a float
    even for an array of radii, since it does not depend on them. With a list of materials or laws, all results have the
    common shape of all arrays. Results that depend on an uncertain value are uncertain: `Measured` or `Interval` in SI
    units.

    Raises
    ------
    MissingInput, UnknownMaterial, UnknownQuantity, QuantityError, BadRequest
        An input is wrong or missing, or inputs do not go together. Magnitudes must be between 1e-30 and 1e30 in SI
        units.
    NoResult
        The physics has no answer (a tension beyond pull-off, two rigid bodies), or a number exceeds the range of
        doubles. Arrays have nan in such elements instead.

    Source: the equation of each quantity, see `jkroll.NOMENCLATURE`. Valid: see each formula.

    >>> f"{solve('r_min', radius='100 nm'):.3g}"
    '5e-05'
    >>> {name: round(value, 1) for name, value in solve(["n_grav"], material="quartz", radius=1e-7).items()}
    {'n_grav': 939.4}
    """
    names = [*map(named, words_in(wanted))]
    reader = Reader()
    of_words = {"material": material, "material2": material2, "model": model, "profile": profile}
    words, given = reader.aligned(of_words, given)
    described = reader.in_si(given)
    quantity = quantity_of(units) if units is not None else reader.quantity
    lists = {name: word for name, word in words.items() if is_list(word)}
    if lists:
        for name, word in lists.items():
            reader.compare_labels(name, word)
        results = _values_by_word(names, words, materials, described)
    else:
        solids = materials_of(words["material"], words["material2"], materials)
        frame = Frame(described, *solids, model=law_given(words["model"], words["profile"]))
        results = values_of(frame, names)
        if frame.uncertain:
            return _one_or_all(wanted, names, with_uncertainties(frame, described, results))
    if quantity is not None:
        results = {name: quantity(value, NOMENCLATURE[name].unit) for name, value in results.items()}
    else:
        results = {name: reader.labelled(name, value, NOMENCLATURE[name].unit) for name, value in results.items()}
    return _one_or_all(wanted, names, results)


def _one_or_all(wanted: Any, names: Sequence[str], results: dict[str, Any]) -> Any:
    """Return the result of a single wanted name, or all results."""
    return results[names[0]] if isinstance(wanted, str) else results


def is_list(word: Any) -> bool:
    """Return whether an argument is a list or column with a name or material per element, rather than a single one."""
    is_one = isinstance(word, str | bytes | Material | Mapping) or hasattr(word, "m_as")
    return not is_one and hasattr(word, "__getitem__") and getattr(word, "ndim", 1) > 0


def _values_by_word(
    names: Sequence[str], words: Mapping[str, Any], materials: Materials | None, described: Mapping[str, Any]
) -> dict[str, Any]:
    """Return the values of quantities for lists of materials or laws, `words`, which may differ between elements.

    Elements with the same materials and law form one frame.
    """
    import numpy

    refuse_uncertain(described)
    lists = {name: _array_of(name, word) for name, word in words.items() if is_list(word)}
    arrays = {name: numpy.asarray(value) for name, value in described.items() if not isinstance(value, float)}
    shape = broadcast({**lists, **arrays})
    rows = {name: numpy.broadcast_to(array, shape).reshape(-1) for name, array in {**lists, **arrays}.items()}
    groups: dict[tuple[Any, ...], list[int]] = {}
    for row, key in enumerate(zip(*(rows[name].tolist() for name in lists), strict=True)):
        groups.setdefault(key, []).append(row)
    results = {name: numpy.full(shape, numpy.nan) for name in names}
    for key, elements in groups.items():
        of_group = {**words, **dict(zip(lists, key, strict=True))}
        given = {name: rows[name][elements] if name in arrays else value for name, value in described.items()}
        solids = materials_of(of_group["material"], of_group["material2"], materials)
        frame = Frame(given, *solids, model=law_given(of_group["model"], of_group["profile"]))
        for name in names:
            with suppress(NoResult):  # for numbers; arrays have nan already
                results[name].reshape(-1)[elements] = values_of(frame, [name])[name]
    return results


def _array_of(name: str, words: Any) -> Any:
    """Return names or materials as an array of objects; numpy would convert a material, which is a tuple, to a row.

    Raises QuantityError for other objects.
    """
    import numpy

    if isinstance(words, list | tuple) and any(isinstance(word, Material) for word in words):
        array = numpy.empty(len(words), dtype=object)
        for position, word in enumerate(words):
            array[position] = word
    else:
        array = numpy.asarray(words, dtype=object)
    for word in array.reshape(-1).tolist():
        if not isinstance(word, str | Material):
            raise QuantityError(name, str(word), "is not a name", f'write {name}=["…", "…"]')
    return array


def refuse_uncertain(described: Mapping[str, Any]) -> None:
    """Raise QuantityError for an uncertain value, where there are several scenes."""
    for name, value in described.items():
        if is_uncertain(value):
            raise QuantityError(
                name, "an uncertain value", "is allowed for a single scene only", "use jkroll.table for columns"
            )


def words_in(wanted: str | Iterable[str]) -> list[str]:
    """Return one word or several as a list; raise UnknownQuantity for anything else."""
    try:
        return [wanted] if isinstance(wanted, str) else [*map(str, wanted)]
    except TypeError:  # a number, or an array of dimension 0
        raise UnknownQuantity(str(wanted)) from None


def materials_of(
    material: str | Material | None, material2: str | Material | None, materials: Materials | None
) -> tuple[Material | None, Material | None]:
    """Return the materials of the two spheres."""
    if materials is not None and not isinstance(materials, Materials):
        raise QuantityError("materials", str(materials), "is not a Materials object", 'write Materials("mine.toml")')
    return _material("material", material, materials), _material("material2", material2, materials)


def _material(argument: str, material: str | Material | None, materials: Materials | None) -> Material | None:
    """Return a material by name, or one made by hand, with its properties in SI units."""
    if isinstance(material, str):
        return (materials or known_materials())[material]
    if material is None:
        return None
    if not (isinstance(material, Material) and isinstance(material.properties, Mapping)):
        raise QuantityError(argument, str(material), "is not the name of one material", 'write "quartz"')
    properties = Reader().in_si(material.properties)
    for name, value in properties.items():
        if not NOMENCLATURE[name].twin or name in CONVERTED:
            raise QuantityError(name, str(value), "is not a property of a material", f"write solve(…, {name}=…)")
        if not isinstance(value, float):
            raise QuantityError(name, str(value), "is not a single number")
    return material._replace(properties=properties)


def values_of(frame: Frame, names: Sequence[str]) -> dict[str, Any]:
    """Return the values of quantities; raise the error of the first without a value.

    Long lists are computed in blocks.
    """
    shapes = {value.shape for value in frame.arrays.values()}
    is_long_list = shapes == {frame.shape} and len(frame.shape) == 1 and frame.shape[0] > ELEMENTS_AT_ONCE
    if not is_long_list or not isinstance(frame.is_rigid, bool):  # a block may have no rigid pair
        return {name: frame[name] for name in names}
    import numpy

    blocks = []
    for start in range(0, frame.shape[0], ELEMENTS_AT_ONCE):
        block = {name: value[start : start + ELEMENTS_AT_ONCE] for name, value in frame.arrays.items()}
        blocks.append(values_of(frame.replace(**block), names))
    return {
        name: value if isinstance(value, float) else numpy.concatenate([block[name] for block in blocks])
        for name, value in blocks[0].items()
    }


def refuse_arrays(described: Mapping[str, Any], mistake: str, remedy: str) -> None:
    """Raise QuantityError for an array where only a single scene is allowed. `mistake` and `remedy` word the error."""
    for name, value in described.items():
        if not (isinstance(value, float) or is_uncertain(value)):
            raise QuantityError(name, "an array", mistake, remedy)


def with_uncertainties(frame: Frame, described: Mapping[str, Any], values: Mapping[str, float]) -> dict[str, Any]:
    """Return the values of a frame with their uncertainties.

    Raises an error if a quantity has no value at some point within the uncertainties.
    """
    refuse_arrays(described, "cannot be combined with an uncertain input", "use jkroll.table")
    bars = error_bars(frame, values)
    for name, bar in bars.items():
        if bar.open_at:
            raise no_error_bar(frame, name, bar)
    return {**values, **{name: bar.of(values[name]) for name, bar in bars.items()}}


# --- Formulas ---------------------------------------------------------------------------------------------------------


class OutsideDomain(Failure, ValueError):
    """Error raised for numbers at which a formula has no value; in arrays these elements are nan."""


def _of_python(formula: Callable[..., Any]) -> Callable[..., Any]:
    """Return a formula that accepts the same numbers and containers as `solve`; Quantities give a Quantity."""
    parameters = parameters_of(formula)
    names = frozenset(parameters)

    @wraps(formula)
    def call(*unnamed: Any, **arguments: Any) -> Any:
        if unnamed or arguments.keys() != names:
            raise BadRequest(f"{formula.__name__} takes {listed(parameters)}, each by its name")
        reader = Reader(formula)
        (arguments,) = reader.aligned(arguments)
        numbers = {name: reader.number(name, value) for name, value in arguments.items()}
        broadcast({name: number for name, number in numbers.items() if not isinstance(number, float)})
        try:
            value = formula(**numbers)
            if isinstance(value, complex):
                raise ValueError("a power of a negative number")
        except (ArithmeticError, ValueError):
            are_finite = all(isinstance(number, float) and isfinite(number) for number in numbers.values())
            reason = reason_for(formula.__name__, numbers) if are_finite else 0
            error = failure_of(reason, numbers) if reason else Failure(NO_DOUBLE, formula.__name__)
            raise OutsideDomain(error.cause, error.name, error.numbers) from None
        if reader.quantity is not None:
            return reader.quantity(value, units_of(formula)["return"])
        return reader.labelled(formula.__name__, value, units_of(formula)["return"])

    call.__module__ = "jkroll.formulas"  # for pickle
    return call


FORMULAS: Mapping[str, Callable[..., Any]] = {name: _of_python(formula) for name, formula in PLAIN_FORMULAS.items()}
