"""Convert inputs from Python to SI units: numbers, texts, Quantities, uncertain values, lists and arrays."""

import warnings
from collections.abc import Callable, Mapping
from functools import cache
from importlib import import_module
from inspect import currentframe
from typing import Any, get_type_hints

from ..errors import BadRequest
from ..physics import dimensions
from ..physics.elementary import NUMBER
from ..quantities.nomenclature import NOMENCLATURE, UnknownQuantity, as_input
from ..quantities.numeric import Numeric
from ..quantities.units import BadUnit, dimension_of
from ..quantities.values import Measured, QuantityError, checked, is_uncertain, unit_meant, value_of
from .labels import Axis, aligned, axes_of, have_same_dimensions, have_same_labels, text_of_unit, unit_stated

_TAKEN_BY_FORMULAS = "give a number in SI units, an array of them or a pint Quantity"
_BYTES = bytes, bytearray, memoryview  # numpy would read the last two as integers


@cache
def units_of(formula: Callable[..., Any]) -> Mapping[str, str]:
    """Return the SI units of a formula's parameters and of its result ("return"), from its annotations."""
    hints = get_type_hints(formula, localns=vars(dimensions), include_extras=True)
    return {name: hint.__metadata__[0] for name, hint in hints.items()}


class Reader:
    """A reader of the inputs of one call: it converts them to SI units, and compares their labels and correlations."""

    def __init__(self, formula: Callable[..., Any] | None = None) -> None:
        """`formula`: the formula whose arguments are read, or None for the inputs of a frame."""
        self.quantity: Any = None  # the Quantity class of the last input with a unit
        self._formula = formula
        self._labelled: tuple[str, list[Axis]] | None = None  # the name and the axes of the first input with labels
        self._container: Any = None  # the array of this input
        self._outer: Any = None  # an array with the labels of the results, if the aligned inputs lack some
        self._states_units = False  # True if an input is an array that states its unit
        self._owners: dict[Any, str] = {}  # by variable of the package uncertainties: the input that depends on it

    def aligned(self, *groups: Mapping[str, Any]) -> list[dict[str, Any]]:
        """Return groups of inputs; arrays of pandas or xarray are aligned by their own library."""
        copies = [dict(group) for group in groups]
        labelled = []
        for group in copies:
            labelled += [(group, key) for key, value in group.items() if axes_of(value)]
        if len(labelled) > 1:
            arrays, self._outer = aligned([group[key] for group, key in labelled])
            for (group, key), array in zip(labelled, arrays, strict=True):
                group[key] = array
        return copies

    def in_si(self, given: Mapping[str, Any], name_of: Callable[[str], str] = as_input) -> dict[str, Any]:
        """Return the inputs of a frame in SI units by name. `name_of` returns the quantity for a word."""
        values: dict[str, Any] = {}
        words: dict[str, str] = {}
        for key, value in given.items():
            word = str(key)
            name = name_of(word)
            if name not in NOMENCLATURE:
                raise UnknownQuantity(word)
            if words.setdefault(name, word) != word:
                raise BadRequest(f"{words[name]} and {word} name one quantity; give one of them")
            values[name] = self.number(name, value)
        return values

    def number(self, name: str, value: Any) -> Any:
        """Return an input in SI units: a float, an uncertain value or an array of floats.

        Units of pint and astropy are read, also those inside an array of xarray or dask. If an array has the attribute
        "units" or "unit", its numbers are converted from this unit. A unit of another package raises QuantityError.
        """
        if type(value) is float:  # as most inputs are
            return value
        if isinstance(value, Numeric):
            value = _of_result(name, value)
        if hasattr(value, "m_as"):
            value = self._without_unit(name, value)
        elif hasattr(value, "to_value") and hasattr(value, "unit"):
            value = self._of_astropy(name, value)
        if hasattr(value, "std_dev"):
            value = self._measured(name, value)
        if isinstance(value, str) or is_uncertain(value):
            return self._single(name, value)
        if isinstance(value, list | tuple):
            items = [self.number(name, item) for item in value]
            if any(map(is_uncertain, items)):
                problem = "holds uncertain values, and arrays have no uncertainty"
                raise QuantityError(name, "a list", problem, "give them one by one")
            return self._floats(name, items)
        self.compare_labels(name, value)
        return self._of_array(name, value)

    def _of_array(self, name: str, value: Any) -> Any:
        """Return the floats of a number or a container of numbers, converted to SI units if it states a unit."""
        unit = unit_stated(value)
        if unit is not None and hasattr(value, "attrs"):
            return self._of_stated_unit(name, value, text_of_unit(unit))
        _refuse_unit(name, value)
        if hasattr(value, "dtype") and hasattr(value, "dims"):  # a Dataset of xarray has no dtype, and is refused
            return self.number(name, value.data)
        if hasattr(value, "dtype") and hasattr(value, "__dask_graph__"):
            return self.number(name, value.compute())
        return self._floats(name, value)

    def _single(self, name: str, value: Any) -> Any:
        """Return the SI value of a text or an uncertain value. Raises QuantityError for a formula's argument."""
        if self._formula is not None:
            raise QuantityError(name, str(value), "is not a number", _TAKEN_BY_FORMULAS)
        return value_of(value, name) if isinstance(value, str) else checked(value, name, str(value.value))

    def _without_unit(self, name: str, quantity: Any) -> Any:
        """Return the magnitude of a pint Quantity in SI units, as floats of 64 bits or an uncertain number."""
        registry, unit = quantity._REGISTRY, self._unit_of(name)
        self.quantity = registry.Quantity
        magnitude = quantity.magnitude
        if not hasattr(magnitude, "std_dev"):
            magnitude = self.number(name, magnitude)  # floats of 16 bits cannot hold 1e-7
        try:
            if not quantity.is_compatible_with(unit):
                raise QuantityError(name, str(quantity), "has the wrong dimension", f"give a value in {unit}")
            return registry.Quantity(magnitude, quantity.units).m_as(unit)
        except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:  # raised by pint
            raise QuantityError(name, str(quantity), f"has a unit that cannot be converted: {error}") from None

    def _unit_of(self, name: str) -> str:
        return NOMENCLATURE[name].unit if self._formula is None else units_of(self._formula)[name]

    def _of_astropy(self, name: str, quantity: Any) -> Any:
        """Return the value of a Quantity or a Column of astropy in SI units."""
        self.quantity = import_module("astropy.units").Quantity
        unit = self._unit_of(name)
        try:
            return self.quantity(quantity, dtype=float).to_value(unit)
        except (TypeError, ValueError) as error:  # UnitConversionError is both
            raise QuantityError(name, str(quantity), "has the wrong dimension", f"give a value in {unit}") from error

    def _of_stated_unit(self, name: str, array: Any, text: str) -> Any:
        """Return the SI numbers of an array whose unit is an attribute or belongs to a pint column."""
        wanted = self._unit_of(name)
        try:
            unit = (1, 1, dimension_of("1")) if text == "1" else unit_meant(text, dimension_of(wanted))
        except BadUnit as error:
            raise QuantityError(name, text, str(error), error.remedy([dimension_of(wanted)])) from None
        numerator, denominator, dimension = unit
        if dimension != dimension_of(wanted):
            raise QuantityError(name, text, "has the wrong dimension", f"give a value in {wanted}")
        data = array.data if hasattr(array, "dims") else array
        if hasattr(data, "m_as") or hasattr(data, "to_value"):
            raise QuantityError(
                name, text, "is an attribute of an array whose numbers have a unit", "leave out one of the two units"
            )
        self._states_units = True
        if hasattr(getattr(array, "dtype", None), "units"):  # a column of pint
            data = data.pint.magnitude
        numbers = data.to_numpy() if hasattr(data, "to_numpy") else data
        return self.number(name, numbers) * numerator / denominator

    def _measured(self, name: str, number: Any) -> Measured:
        """Return a number of the package uncertainties as a Measured; raise BadRequest if two inputs are correlated."""
        for variable, part in getattr(number, "error_components", dict)().items():
            owner = self._owners.setdefault(variable, name) if part else name
            if owner != name:
                problem = f"{owner} and {name} are correlated, and inputs must be independent"
                remedy = "write uncertainties.wrap(lambda x: jkroll.solve(...))(x)"
                raise BadRequest(f"{problem}; {remedy}, with x for the value that they share")
        return Measured(number.nominal_value, number.std_dev)

    def compare_labels(self, name: str, value: Any) -> None:
        """Raise BadRequest if arrays of pandas or xarray have different dimensions or labels.

        Elements pair up by position, so different labels would pair the wrong elements.
        """
        axes = axes_of(value)
        if not axes:
            return
        if self._labelled is None:
            self._labelled = name, axes
            self._container = value
        first, others = self._labelled
        remedy = "align them first, or give numpy arrays, which are taken by position"
        if not have_same_dimensions(axes, others):
            raise BadRequest(f"{first} and {name} have different dimensions: {remedy}")
        if not have_same_labels(axes, others):
            raise BadRequest(f"{first} and {name} have different indexes: {remedy}")

    def labelled(self, name: str, values: Any, unit: str) -> Any:
        """Return the values of a quantity with the labels of the inputs, if the shapes match."""
        container = self._container
        if container is None or getattr(values, "shape", None) != getattr(container, "shape", None):
            return values
        if hasattr(container, "dims"):
            array = container.copy(data=values)
        else:
            array = container._constructor(values, **dict(zip(("index", "columns"), container.axes, strict=False)))
            array = array if self._outer is None else array.reindex_like(self._outer)
        array.attrs = {"units": unit} if self._states_units else {}
        if hasattr(array, "name"):
            array.name = name
        return array

    def _floats(self, name: str, value: Any) -> Any:
        """Return a float or an array of floats for a number, a sequence or an array of integers or floats."""
        remedy = "" if self._formula is None else _TAKEN_BY_FORMULAS
        if isinstance(value, NUMBER) and not isinstance(value, bool):
            try:
                return float(value)
            except OverflowError:
                raise QuantityError(name, "an integer", "is too large for a double", remedy) from None
        import numpy

        if numpy.ma.is_masked(value):
            raise QuantityError(name, "a masked array", "has cells without a value", "fill it first")
        try:
            array = numpy.asarray(value)
            if array.dtype.kind in "fiu" and not isinstance(value, _BYTES):
                return array.astype(float, copy=False) if array.ndim else float(array)
        except Exception:  # a container may raise anything
            pass
        raise QuantityError(name, str(value), "is not a number", remedy)


def warn_of_metres(given: Mapping[str, Any]) -> None:
    """Warn about a radius, diameter or reduced radius of a metre or more, given as a number without a unit.

    `given`: the inputs as the caller wrote them; such a number is in SI units.
    """
    for word, value in given.items():
        is_size = as_input(str(word)) in ("radius", "diameter", "reduced_radius")
        if is_size and isinstance(value, NUMBER) and value >= 1.0:
            text = f"{word}={value} is a sphere of {value:g} m: numbers are in SI units"
            text += f'; write {word}="{value} nm" for nanometres'
            warnings.warn(text, stacklevel=_level_of_caller())


def _level_of_caller() -> int:
    """Return the number of stack frames from the function that calls this one to the first caller outside jkroll."""
    level, frame = 1, currentframe()
    package = f"{__name__.partition('.')[0]}."
    while frame is not None and frame.f_globals.get("__name__", "").startswith(package):
        level, frame = level + 1, frame.f_back
    return level - 1


def quantity_of(package: str) -> Any:
    """Return the Quantity class of a package. Raises BadRequest for packages other than pint and astropy."""
    if package == "pint":
        return import_module("pint").get_application_registry().Quantity
    if package == "astropy":
        return import_module("astropy.units").Quantity
    raise BadRequest(f"units: {package!r} is not known; write pint or astropy")


def _of_result(name: str, result: Numeric) -> Any:
    """Return the number of a result of jkroll; raise QuantityError if the input `name` has another unit."""
    unit, wanted = NOMENCLATURE[result.name].unit, NOMENCLATURE[name].unit
    if unit != wanted:
        raise QuantityError(name, str(result), f"is a {result.name}, in {unit}", f"give a value in {wanted}")
    return result.number


def _refuse_unit(name: str, value: Any) -> None:
    """Raise QuantityError for a value with a unit from a package other than pint and astropy."""
    remedy = "give SI numbers, or a Quantity of pint or astropy"
    for holder in (value, getattr(value, "dtype", None)):
        if hasattr(holder, "unit") or hasattr(holder, "units"):
            problem = "has a unit, and only those of pint and astropy are read"
            raise QuantityError(name, str(value), problem, remedy)
