"""Curves as data: panels with axes, curves and points. Nothing is drawn here."""

from collections.abc import Iterable
from math import ceil, floor, log10
from typing import Any, NamedTuple

from .axes import Axis
from .maps import Mark, extent, is_wide

_FIRST, _LAST = -323, 308  # decades of the doubles


class Curve(NamedTuple):
    """A line through points. Curves that belong together share a colour."""

    text: str
    x: Any
    y: Any
    colour: int = 0
    is_dashed: bool = False


class Panel(NamedTuple):
    """Curves over common axes."""

    x: Axis
    y: Axis
    curves: tuple[Curve, ...]
    points: tuple[Mark, ...] = ()
    title: str = ""
    is_true_to_scale: bool = False


class Picture(NamedTuple):
    """Panels beside each other, with a title and a caption."""

    title: str
    panels: tuple[Panel, ...]
    caption: tuple[str, ...]


def axis_around(name: str, values: Iterable[Any], *, is_log: bool | None = None, margin: float = 0.05) -> Axis:
    """Return an axis that holds all finite values, with a margin; logarithmic where they are of different orders."""
    import numpy

    known = numpy.concatenate([numpy.ravel(one) for one in values])
    low, high = extent(known)
    if is_log if is_log is not None else is_wide(known):
        return Axis(name, 10.0 ** max(floor(log10(low) + 0.01), _FIRST), 10.0 ** min(ceil(log10(high) - 0.01), _LAST))
    room = (high - low) * margin if high > low else abs(high) * 0.05 or 1.0
    return Axis(name, low - room, high + room, is_log=False)


def clipped(values: Any, low: float, high: float) -> Any:
    """Return the values between two limits; nan elsewhere."""
    import numpy

    return numpy.where((values >= low) & (values <= high), values, numpy.nan)
