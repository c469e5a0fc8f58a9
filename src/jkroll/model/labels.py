"""Arrays of pandas and xarray: their labels, how their library aligns them, and the units that they state."""

from collections.abc import Sequence
from importlib import import_module
from typing import Any

Axis = tuple[Any, Any]  # the name of a dimension and the labels along it, None where there are none


def axes_of(value: Any) -> list[Axis]:
    """Return the axes of an array of pandas or xarray; none for other containers, and for a single number."""
    if hasattr(value, "dims"):
        indexes = getattr(value, "indexes", {})
        return [(dimension, indexes.get(dimension)) for dimension in value.dims]
    if hasattr(getattr(value, "index", None), "equals"):  # as a method, `index` is that of a sequence
        return [(None, labels) for labels in value.axes]
    return []


def have_same_dimensions(axes: Sequence[Axis], others: Sequence[Axis]) -> bool:
    """Return whether two arrays have the same dimensions in the same order."""
    return [dimension for dimension, _ in axes] == [dimension for dimension, _ in others]


def have_same_labels(axes: Sequence[Axis], others: Sequence[Axis]) -> bool:
    """Return whether two arrays of the same dimensions have the same labels, or none."""
    pairs = ((labels, other) for (_, labels), (_, other) in zip(axes, others, strict=True))
    return all(labels is other or (labels is not None and bool(labels.equals(other))) for labels, other in pairs)


def aligned(arrays: Sequence[Any]) -> tuple[Sequence[Any], Any]:
    """Return arrays as their library aligns them in arithmetic, and an array with the labels of what follows from them.

    The latter is None where these are the labels of the arrays. In pandas a label that one array lacks is left out of
    the others, and has no value in the result. Arrays that the library does not align are returned as they are.
    """
    first, *others = map(axes_of, arrays)
    if all(have_same_dimensions(first, axes) and have_same_labels(first, axes) for axes in others):
        return arrays, None
    try:
        if all(hasattr(array, "reindex_like") and not hasattr(array, "dims") for array in arrays):
            return _aligned_by_pandas(arrays)
        if all(hasattr(array, "dims") and hasattr(array, "coords") for array in arrays):
            xarray = import_module("xarray")
            joined = xarray.align(*arrays, join=xarray.get_options()["arithmetic_join"])
            return [*xarray.broadcast(*joined)], None
    except Exception:  # labels that stand twice, or sizes that differ: a library has many errors for that
        pass
    return arrays, None


def _aligned_by_pandas(arrays: Sequence[Any]) -> tuple[Sequence[Any], Any]:
    """Return arrays at the labels that all of them have, and one with all. Raises ValueError for labels twice."""
    inner = outer = arrays[0]
    for other in arrays[1:]:
        inner, _ = inner.align(other, join="inner")
        outer, _ = outer.align(other, join="outer")
    if not all(labels.is_unique for labels in outer.axes):
        raise ValueError("labels that stand twice")
    return [array.reindex_like(inner) for array in arrays], outer


# --- Units ------------------------------------------------------------------------------------------------------------


def unit_stated(array: Any) -> Any:
    """Return the unit among the attributes of an array, or of its type; None without one."""
    attributes = {str(key).casefold(): value for key, value in dict(getattr(array, "attrs", {})).items()}
    stated = (attributes.get("units"), attributes.get("unit"), getattr(getattr(array, "dtype", None), "units", None))
    return next((unit for unit in stated if unit is not None), None)


def text_of_unit(unit: Any) -> str:
    """Return a unit of a library as a text: of pint and of astropy in symbols, with powers; "1" for none.

    >>> text_of_unit("nm "), text_of_unit("")
    ('nm', '1')
    """
    if hasattr(unit, "dimensionality"):
        return f"{unit:~P}".replace("·", " ") or "1"
    return (str(unit.to_string("unicode")) if hasattr(unit, "to_string") else str(unit).strip()) or "1"
