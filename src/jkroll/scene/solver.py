"""The Python face of a scene: names and values in, values out; of the inverse problem; and of the formulas."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import wraps
from typing import Any, overload

from ..errors import BadRequest, JkrollError
from ..materials.library import Material, Materials, known_materials
from ..physics import FORMULAS as PLAIN_FORMULAS
from ..physics.elementary import NUMBER
from ..quantities.nomenclature import NOMENCLATURE, UnknownQuantity, as_input, named
from ..quantities.values import Measured, QuantityError, checked, is_uncertain, value_of
from .scene import Scene

ELEMENTS_AT_ONCE = 1 << 14  # few enough that intermediate results stay in the processor's cache
_PLAIN = float, int, str  # types of values that hold no others


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
    **given
        Inputs by name: a float, an array or a list in SI units, a text with a unit ("100 nm"), or a pint Quantity,
        which an array of xarray or dask may hold. Arrays broadcast. `radius2` may be infinite (a plane), and one
        Young's modulus too (a rigid body). Single values may be uncertain: `Measured`, `Interval`, "25±5 mJ/m2", "20 to
        30 mJ/m2", or a pint Measurement.

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
    is_list = isinstance(wanted, Iterable) and not isinstance(wanted, str)
    names = [named(str(name)) for name in (wanted if is_list else [wanted])]
    described, registry = in_si(given)
    scene = Scene(described, *materials_of(material, material2, materials), model=model)
    results = values_of(scene, names)
    if scene.uncertain:
        results = with_uncertainties(scene, described, results)
    elif registry is not None:
        results = {name: registry.Quantity(value, NOMENCLATURE[name].unit) for name, value in results.items()}
    return results if is_list else results[names[0]]


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
    properties, _ = in_si(material.properties)
    for name, value in properties.items():
        if not NOMENCLATURE[name].twin:
            raise QuantityError(name, str(value), "is not a property of a material", "give it by its name")
        if not isinstance(value, float):
            raise QuantityError(name, str(value), "is not a single number")
    return material._replace(properties=properties)


def values_of(scene: Scene, names: Sequence[str]) -> dict[str, Any]:
    """Return the values of quantities; raise the error of the first that has none.

    Long lists are computed in blocks, with which intermediate results take no memory.
    """
    shapes = {value.shape for value in scene.arrays.values()}
    is_long_list = shapes == {scene.shape} and len(scene.shape) == 1 and scene.shape[0] > ELEMENTS_AT_ONCE
    if not is_long_list or not isinstance(scene.is_rigid, bool):  # of which a block may have none
        return {name: scene[name] for name in names}
    import numpy

    blocks = []
    for start in range(0, scene.shape[0], ELEMENTS_AT_ONCE):
        block = {name: value[start : start + ELEMENTS_AT_ONCE] for name, value in scene.arrays.items()}
        blocks.append(values_of(scene.replace(**block), names))
    return {
        name: value if isinstance(value, float) else numpy.concatenate([block[name] for block in blocks])
        for name, value in blocks[0].items()
    }


def refuse_arrays(described: Mapping[str, Any]) -> None:
    """Raise QuantityError for an array, where values have uncertainties or one scene is described."""
    for name, value in described.items():
        if not (isinstance(value, float) or is_uncertain(value)):
            raise QuantityError(name, "an array", "is more than one scene", "solve takes arrays without uncertainty")


def with_uncertainties(scene: Any, described: Mapping[str, Any], values: Mapping[str, float]) -> dict[str, Any]:
    """Return values of a scene or a problem with their error bars; raise a Failure with the reason why one has none."""
    from .uncertainty import measures_of, uncertainties

    refuse_arrays(described)
    measures = measures_of(uncertainties(scene, [*values]))
    for measure in measures.values():
        if isinstance(measure, JkrollError):
            raise measure
    return {**values, **measures}


def in_si(given: Mapping[str, Any], name_of: Callable[[str], str] = as_input) -> tuple[dict[str, Any], Any]:
    """Return SI numbers for texts, lists and pint Quantities, and the registry of the latter if there were any.

    `name_of` returns the quantity that a word stands for.
    """
    values: dict[str, Any] = {}
    words: dict[str, str] = {}
    registries: list[Any] = []
    for word, value in given.items():
        name = name_of(word)
        if name not in NOMENCLATURE:
            raise UnknownQuantity(word)
        if words.setdefault(name, word) != word:
            raise BadRequest(f"{words[name]} and {word} are one quantity; give it once")
        values[name] = _number(name, _content(name, value), registries)
    return values, registries[-1] if registries else None


def _content(name: str, value: Any) -> Any:
    """Return the numbers, texts or pint Quantities that a container holds.

    xarray and dask hold Quantities, and numpy would drop their units. Any other unit raises QuantityError: that of
    astropy or unyt, and one that is a word among the attributes of an array.
    """
    if isinstance(value, _PLAIN) or hasattr(value, "m_as") or hasattr(value, "std_dev") or is_uncertain(value):
        return value
    if isinstance(value, list | tuple):
        return [_content(name, item) for item in value]
    for word in getattr(value, "attrs", ()):
        if str(word).casefold() in ("unit", "units"):
            unit = f"{word} = {value.attrs[word]}"
            raise QuantityError(name, unit, "is an attribute, which is not read; give SI numbers or a pint Quantity")
    if hasattr(value, "unit") or hasattr(value, "units"):
        raise QuantityError(name, str(value), "has a unit, and only those of pint are read; give SI numbers")
    if not hasattr(value, "dtype"):  # what is no array: a set of data of xarray has variables
        return value
    if hasattr(value, "dims"):
        return _content(name, value.data)
    return _content(name, value.compute()) if hasattr(value, "__dask_graph__") else value


def _number(name: str, value: Any, registries: list[Any]) -> Any:
    """Return a float, an uncertain value or an array of floats for a number, text, Quantity, or a sequence of these.

    The registries of Quantities are added to `registries`.
    """
    if hasattr(value, "m_as"):
        registries.append(value._REGISTRY)
        if not value.is_compatible_with(NOMENCLATURE[name].unit):
            raise QuantityError(name, str(value), "is of another dimension")
        value = value.m_as(NOMENCLATURE[name].unit)
    if isinstance(value, str):
        return value_of(value, name)
    if hasattr(value, "std_dev"):
        value = Measured(value.nominal_value, value.std_dev)  # as the package `uncertainties` and pint have them
    if is_uncertain(value):
        return checked(value, name, str(value.value))
    if isinstance(value, list | tuple):
        value = [_number(name, item, registries) for item in value]
        if any(map(is_uncertain, value)):
            problem = "holds uncertain values, and arrays have no uncertainty"
            raise QuantityError(name, "a list", problem, "give them one by one")
    return as_floats(name, value)


def as_floats(name: str, value: Any) -> Any:
    """Return a float or an array of floats for a number, a sequence or an array of any number type."""
    if isinstance(value, NUMBER) and not isinstance(value, bool):
        try:
            return float(value)
        except OverflowError:
            raise QuantityError(name, "an integer", "is too large for a double") from None
    import numpy

    if numpy.ma.isMaskedArray(value):
        raise QuantityError(name, "a masked array", "has cells without a value; fill it first")
    try:
        array = numpy.asarray(value)
        if array.dtype.kind in "fiu":
            return array.astype(float, copy=False) if array.ndim else float(array)
    except (TypeError, ValueError, OverflowError):
        pass
    raise QuantityError(name, str(value), "is not a number")


# --- Formulas ---------------------------------------------------------------------------------------------------------


def _of_numbers(formula: Callable[..., Any]) -> Callable[..., Any]:
    """Return a formula that converts its arguments to floats."""

    @wraps(formula)
    def call(**arguments: Any) -> Any:
        contents = {name: _content(name, value) for name, value in arguments.items()}
        return formula(
            **{name: value if hasattr(value, "m_as") else as_floats(name, value) for name, value in contents.items()}
        )

    return call


FORMULAS: Mapping[str, Callable[..., Any]] = {name: _of_numbers(formula) for name, formula in PLAIN_FORMULAS.items()}
