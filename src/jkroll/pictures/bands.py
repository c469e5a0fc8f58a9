"""The best ranges of a quantity along a curve or over a map; each range equals that of a single answer."""

from collections.abc import Callable, Iterator
from contextlib import suppress
from math import inf
from typing import Any, NamedTuple

import numpy

from ..errors import JkrollError
from ..model.estimate import NONE, WORDS, Estimate, estimates
from ..model.frame import Frame
from ..model.results import Results
from ..quantities.markup import marked
from ..text import listed

_HAS_WIDTH = 1e-6  # relative width up to which a range counts as a single number
_OVERLAP = 0.02  # largest part of a map in which bands may overlap
_COVERED = 0.6  # largest part of a map that bands may cover: if they cover more, the gaps look like bands
_SEEN = 0.01  # least part of a map, or of the height of an axis, that a band must cover to be seen


class Band(NamedTuple):
    """Best ranges as arrays; an open end is infinite, and nan means no range."""

    low: Any
    high: Any
    by: Any  # the rule of each range, as an index into WORDS

    def rules(self, where: Callable[[Any], str] = lambda _: "") -> str:
        """Return the clause that names the rules in order of appearance, each with its place if it has one.

        `where`: returns the place of a rule, given an array that is True where the rule applies.
        """
        texts = []
        for rule in dict.fromkeys(self.by.ravel().tolist()):
            if rule != NONE:
                place = where(self.by == rule)
                texts.append(f"“{marked(WORDS[rule])}”" + (f" ({place})" if place else ""))
        return f"by the rule{'s' if texts[1:] else ''} {listed(texts)}"

    def key_of_map(self, step: int, law: str) -> str:
        """Return the legend's text for a map by this law in which every `step`-th contour has a band."""
        which = "contours" if step == 1 else "thick contours"
        return f"{which}: {law}; bands: where they may lie (best ranges {self.rules()})"

    def is_seen(self, low: float, high: float, *, is_log: bool) -> bool:
        """Return True if the band is somewhere wide enough to be seen on an axis from `low` to `high`."""
        scale = numpy.log if is_log else numpy.asarray
        bottom, top = (scale(numpy.clip(end, low, high)) for end in (self.low, self.high))
        return bool(numpy.nanmax(top - bottom) > _SEEN * (scale(high) - scale(low)))

    def estimates(self) -> Iterator[Estimate]:
        """Iterate over the ranges as the estimates of single points, in which an open end is nan."""
        low, high = (numpy.where(numpy.isinf(end), numpy.nan, end) for end in (self.low, self.high))
        for point in zip(low.tolist(), high.tolist(), self.by.tolist(), strict=True):
            yield Estimate(*point)


def band_of(points: Frame, quantity: str, shape: tuple[int, ...]) -> Band | None:
    """Return the best ranges at the points of a frame of arrays; None if there are none, or all are single numbers."""
    best: Estimate | None = None
    with suppress(JkrollError):  # raised if some point has no error bars
        best = estimates(Results(points, points.columns([quantity])), [quantity]).get(quantity)
    if best is None:
        return None
    low, high, by = (numpy.broadcast_to(values, shape) for values in best)
    has_none = numpy.isnan(low) & numpy.isnan(high)
    low = numpy.where(has_none, numpy.nan, numpy.where(numpy.isnan(low), -inf, low))
    high = numpy.where(has_none, numpy.nan, numpy.where(numpy.isnan(high), inf, high))
    has_width = high - low > _HAS_WIDTH * abs(numpy.where(numpy.isinf(high), low, high))
    return Band(low, high, by) if has_width.any() else None


def spacing(inside: Any) -> int:
    """Return the smallest n for which the bands of every n-th contour, beginning at index n // 2, stand apart.

    Bands stand apart if they hardly overlap and leave a part of the map free. Without such an n, return the number of
    contours; return 0 if the bands are too narrow to be seen. `inside`: for each contour of a map, an array that is
    positive within its band.
    """
    for step in range(1, len(inside) + 1):
        bands = (inside[step // 2 :: step] > 0).sum(axis=0)
        if (bands > 1).mean() < _OVERLAP and (bands > 0).mean() < _COVERED:
            break
    return step if (bands > 0).mean() > _SEEN else 0
