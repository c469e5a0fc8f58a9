"""The Python face of a frame: names and values in, values out; of the inverse problem; and of the formulas."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import wraps
from math import isfinite
from typing import Any, overload

from ..errors import BadRequest
from ..materials.library import Material, Materials, known_materials
from ..physics import FORMULAS as PLAIN_FORMULAS
from ..quantities.laws import law_given
from ..quantities.nomenclature import CONVERTED, NOMENCLATURE, UnknownQuantity, named
from ..quantities.values import QuantityError, is_uncertain
from ..text import listed
from .column import broadcast
from .containers import Reader, units_of
from .frame import Frame
from .plan import parameters_of
from .reasons import NO_DOUBLE, Failure, failure_of, reason_for
from .uncertainty import error_bars, no_error_bar

ELEMENTS_AT_ONCE = 1 << 14  # few enough that intermediate results stay in the processor's cache


@overload
def solve(wanted: str, /, **scene: Any) -> Any: ...
@overload
def solve(wanted: Iterable[str], /, **scene: Any) -> dict[str, Any]: ...
def solve(
    wanted: str | Iterable[str],
    /,
    *,
    material: str | Material | None = None,
    material2: str | Material | None = None,
    materials: Materials | None = None,
    model: str | None = None,
    profile: str | None = None,
    **given: Any,
) -> Any:
    """Compute quantities of the nomenclature from whatever is known of the scene.

    Bare numbers: what was assumed, which limits of the model do not hold, and what a material's source says of its
    values is left out, and so is the uncertainty that a shipped material states. `jkroll.answer` has them, for one
    scene.

    Parameters
    ----------
    wanted
        A name of the nomenclature, or several. The word of an option and a symbol are taken for names: "gamma" is
        "surface_energy", "P_c" is "pull_off_force".
    material, material2
        Materials, or their names or aliases; `material2` for sphere 2, which is otherwise like sphere 1. A property
        given by name overrides the material's.
    materials
        Where materials are looked up: `Materials("mine.toml")` for some of your own besides the shipped ones.
    model
        The law of attraction: "jkr" (the paper's, the default), "maugis" or "dmt".
    profile
        The body that presses: "paraboloid" (the default) or, for a rigid sphere on a soft plane by JKR, "sphere".
    **given
        Inputs by name: a float, an array or a list in SI units, a text with a unit ("100 nm"), or a pint Quantity,
        which an array of xarray or dask may hold. Arrays broadcast by position: those of pandas or xarray must have the
        same labels. `radius2` may be infinite (a plane), and one Young's modulus too (a rigid body). Single values may
        be uncertain: `Measured`, `Interval`, "25±5 mJ/m2", "20 to 30 mJ/m2", a pint Measurement, or a number of the
        package `uncertainties` that is independent of the other inputs.

    Returns
    -------
    The value of a single wanted name, or a dict of name to value. SI numbers: floats, arrays, or pint Quantities if any
    input was one. A result has the shape of the arrays on which it depends: that of `yield_force` is a float for many
    radii. If a given value is uncertain, so are the results: `Measured` or `Interval` in SI units.

    Raises
    ------
    MissingInput, UnknownMaterial, UnknownQuantity, QuantityError
        An input is wrong, or one is missing. Sizes range from 1e-30 to 1e30 in SI units.
    NoResult
        The physics has no answer: a tension beyond pull-off, two rigid bodies; or a number on the way to it leaves the
        doubles. Arrays hold nan there instead.

    Source: the equation of each quantity, see `jkroll.NOMENCLATURE`. Valid: as each formula says.

    >>> f"{solve('r_min', radius='100 nm'):.3g}"
    '5e-05'
    >>> {name: round(value, 1) for name, value in solve(["n_grav"], material="quartz", radius=1e-7).items()}
    {'n_grav': 939.4}
    """
    names = [*map(named, words_in(wanted))]
    reader = Reader()
    described = reader.in_si(given)
    frame = Frame(described, *materials_of(material, material2, materials), model=law_given(model, profile))
    results = values_of(frame, names)
    if frame.uncertain:
        results = with_uncertainties(frame, described, results)
    elif reader.registry is not None:
        results = {name: reader.registry.Quantity(value, NOMENCLATURE[name].unit) for name, value in results.items()}
    return results[names[0]] if isinstance(wanted, str) else results


def words_in(wanted: str | Iterable[str]) -> list[str]:
    """Return one word or several as a list; raise UnknownQuantity for what holds no words."""
    try:
        return [wanted] if isinstance(wanted, str) else [*map(str, wanted)]
    except TypeError:  # a single number, in an array too
        raise UnknownQuantity(str(wanted)) from None


def materials_of(
    material: str | Material | None, material2: str | Material | None, materials: Materials | None
) -> tuple[Material | None, Material | None]:
    """Return the materials of the two spheres."""
    if materials is not None and not isinstance(materials, Materials):
        raise QuantityError("materials", str(materials), "is not a Materials object", 'write Materials("mine.toml")')
    return _material("material", material, materials), _material("material2", material2, materials)


def _material(argument: str, material: str | Material | None, materials: Materials | None) -> Material | None:
    """Return the material of a name, or one that may have been made by hand, with its properties in SI units."""
    if isinstance(material, str):
        return (materials or known_materials())[material]
    if material is None:
        return None
    if not (isinstance(material, Material) and isinstance(material.properties, Mapping)):
        raise QuantityError(argument, str(material), "is not the name of one material", 'write "quartz"')
    properties = Reader().in_si(material.properties)
    for name, value in properties.items():
        if not NOMENCLATURE[name].twin or name in CONVERTED:
            raise QuantityError(name, str(value), "is not a property of a material", "give it by its name")
        if not isinstance(value, float):
            raise QuantityError(name, str(value), "is not a single number")
    return material._replace(properties=properties)


def values_of(frame: Frame, names: Sequence[str]) -> dict[str, Any]:
    """Return the values of quantities; raise the error of the first that has none.

    Long lists are computed in blocks, with which intermediate results take no memory.
    """
    shapes = {value.shape for value in frame.arrays.values()}
    is_long_list = shapes == {frame.shape} and len(frame.shape) == 1 and frame.shape[0] > ELEMENTS_AT_ONCE
    if not is_long_list or not isinstance(frame.is_rigid, bool):  # of which a block may have none
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


def refuse_arrays(described: Mapping[str, Any]) -> None:
    """Raise QuantityError for an array, where values have uncertainties or one scene is described."""
    for name, value in described.items():
        if not (isinstance(value, float) or is_uncertain(value)):
            raise QuantityError(name, "an array", "is more than one scene", "solve takes arrays without uncertainty")


def with_uncertainties(frame: Frame, described: Mapping[str, Any], values: Mapping[str, float]) -> dict[str, Any]:
    """Return values of a frame with their error bars; raise a Failure with the reason why one has none."""
    refuse_arrays(described)
    bars = error_bars(frame, values)
    for name, bar in bars.items():
        if bar.place:
            raise no_error_bar(frame, name, bar)
    return {**values, **{name: bar.of(values[name]) for name, bar in bars.items()}}


# --- Formulas ---------------------------------------------------------------------------------------------------------


class OutsideDomain(Failure, ValueError):
    """Error raised where a formula has no value for numbers; of an array such elements are nan."""


def _of_python(formula: Callable[..., Any]) -> Callable[..., Any]:
    """Return a formula that takes numbers and their containers as `solve` does, and gives a Quantity for Quantities."""
    parameters = parameters_of(formula)
    names = frozenset(parameters)

    @wraps(formula)
    def call(*unnamed: Any, **arguments: Any) -> Any:
        if unnamed or arguments.keys() != names:
            raise BadRequest(f"{formula.__name__} takes {listed(parameters)}, each by its name")
        reader = Reader(formula)
        numbers = {name: reader.number(name, value) for name, value in arguments.items()}
        broadcast({name: number for name, number in numbers.items() if not isinstance(number, float)})
        try:
            value = formula(**numbers)
            if isinstance(value, complex):
                raise ValueError("a power of a negative number")
        except (ArithmeticError, ValueError):
            has_words = all(isinstance(number, float) and isfinite(number) for number in numbers.values())
            number = reason_for(formula.__name__, numbers) if has_words else 0
            error = failure_of(number, numbers) if number else Failure(NO_DOUBLE, formula.__name__)
            raise OutsideDomain(error.cause, error.name, error.numbers) from None
        if reader.registry is not None:
            return reader.registry.Quantity(value, units_of(formula)["return"])
        return value

    call.__module__ = "jkroll"  # where pickle finds it
    return call


FORMULAS: Mapping[str, Callable[..., Any]] = {name: _of_python(formula) for name, formula in PLAIN_FORMULAS.items()}
