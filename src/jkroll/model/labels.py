"""Labels and units of arrays of pandas and xarray, and their alignment by their own library."""

from collections.abc import Sequence
from importlib import import_module
from typing import Any

Axis = tuple[Any, Any]  # the name of a dimension and its labels; either may be None


def axes_of(value: Any) -> list[Axis]:
    """Return the axes of an array of pandas or xarray; an empty list for other containers and for single numbers."""
    if hasattr(value, "dims"):
        indexes = getattr(value, "indexes", {})
        return [(dimension, indexes.get(dimension)) for dimension in value.dims]
    if hasattr(getattr(value, "index", None), "equals"):  # in a sequence `index` is a method
        return [(None, labels) for labels in value.axes]
    return []


def have_same_dimensions(axes: Sequence[Axis], others: Sequence[Axis]) -> bool:
    """Return whether two arrays have the same dimensions in the same order."""
    return [dimension for dimension, _ in axes] == [dimension for dimension, _ in others]


def have_same_labels(axes: Sequence[Axis], others: Sequence[Axis]) -> bool:
    """Return whether two arrays of the same dimensions have the same labels, or no labels."""
    for (_, labels), (_, other) in zip(axes, others, strict=True):
        if labels is not other and (labels is None or not labels.equals(other)):
            return False
    return True


def aligned(arrays: Sequence[Any]) -> tuple[Sequence[Any], Any]:
    """Return arrays, aligned by their library as in arithmetic, and an array with the labels of the results.

    The array of labels is None if the aligned arrays have the labels of the results. In pandas, a label missing from
    one array is dropped from the others, and has no value in the result. Arrays that the library cannot align are
    returned unchanged.
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
    except Exception:  # for duplicate labels or different sizes, libraries raise many kinds of errors
        pass
    return arrays, None


def _aligned_by_pandas(arrays: Sequence[Any]) -> tuple[Sequence[Any], Any]:
    """Return arrays at their common labels, and an array with all labels. Raises ValueError for duplicate labels."""
    inner = outer = arrays[0]
    for other in arrays[1:]:
        inner, _ = inner.align(other, join="inner")
        outer, _ = outer.align(other, join="outer")
    if not all(labels.is_unique for labels in outer.axes):
        raise ValueError("duplicate labels")
    return [array.reindex_like(inner) for array in arrays], outer


# --- Units ------------------------------------------------------------------------------------------------------------


def unit_stated(array: Any) -> Any:
    """Return the unit among the attributes of an array, or the unit of its dtype; None without a unit."""
    attributes = {str(key).casefold(): value for key, value in dict(getattr(array, "attrs", {})).items()}
    for key in ("units", "unit"):
        if attributes.get(key) is not None:
            return attributes[key]
    return getattr(getattr(array, "dtype", None), "units", None)


def text_of_unit(unit: Any) -> str:
    """Return a library's unit as a text: symbols with powers for pint and astropy, "1" for no unit.

    >>> text_of_unit("nm "), text_of_unit("")
    ('nm', '1')
    """
    if hasattr(unit, "dimensionality"):
        return f"{unit:~P}".replace("·", " ") or "1"
    if hasattr(unit, "to_string"):
        return str(unit.to_string("unicode")) or "1"
    return str(unit).strip() or "1"
