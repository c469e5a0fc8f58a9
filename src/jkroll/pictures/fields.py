"""Draw the field of a quantity over two inputs: contours, best ranges, limits of the model, the part without values.

Lines are found on a fine mesh, to which best ranges are interpolated from a coarser one. A position on a mesh is
counted in steps from its first point, so that it is linear on the page, even along a logarithmic axis. The edge of the
part without values is found by bisection between the points of the mesh.
"""

from collections.abc import Callable, Sequence
from functools import partial
from itertools import cycle, pairwise
from typing import Any, NamedTuple

import numpy
from contourpy import contour_generator  # type: ignore[import-not-found,unused-ignore]
from matplotlib.collections import LineCollection, PathCollection  # type: ignore[import-not-found,unused-ignore]
from matplotlib.colors import (  # type: ignore[import-not-found,unused-ignore]
    LinearSegmentedColormap,
    to_hex,
    to_rgb,
)
from matplotlib.lines import Line2D  # type: ignore[import-not-found,unused-ignore]
from matplotlib.patches import Patch  # type: ignore[import-not-found,unused-ignore]
from matplotlib.path import Path  # type: ignore[import-not-found,unused-ignore]
from matplotlib.patheffects import withTickedStroke  # type: ignore[import-not-found,unused-ignore]

from ..model.frame import Frame
from ..model.solver import values_of
from ..quantities.markup import lines, symbol
from .bands import Band, band_of, spacing
from .labels import Bound, Labels
from .picture import Axis, Panel, Style, evaluate, extended, over

FINE = 401  # points along each side of a field
_THIN, _THICK = 0.7, 1.1  # contours, in points
_TOLERANCE = 0.005  # largest error of a line, in steps of the mesh
_HALVINGS = 24  # bisections that find the edge of the part without values
_DASHES = ((0, (4, 2)), (0, (7, 2, 1.5, 2)), (0, (10, 3)), (0, (5, 1.5, 1, 1.5, 1, 1.5)))  # of lines that bound regions
_ABOUT_TEETH = "the teeth of a line point to where its limit is exceeded"
_LEAST_LABELLED = 2 / 3  # fraction of contours with a text below which the legend has a scale
_PALE = 0.55  # opacity of the paper's colour in a band of best ranges
_CERTAIN, _UNCERTAIN = 201, 41  # points along each side of the coarser mesh, without and with uncertain inputs
_BENT = 0.1  # second difference, over the distance of contours, above which an end of best ranges is not linear
_TOOTH, _APART = 2.5, 6.0  # length and distance of the teeth of a bound, in points
_FARTHEST = 20.0  # least distance from every contour of the number that stands for an infinite end of a best range


# --- Lines on a mesh --------------------------------------------------------------------------------------------------


class Mesh:
    """A mesh of points over both axes of a picture, and lines through a field on it."""

    def __init__(self, x: Axis, y: Axis, size: int = FINE) -> None:
        self.x, self.y = (axis._replace(size=size) for axis in (x, y))
        self.axes = (self.x, self.y)

    def points(self, steps: Any) -> Any:
        """Return points of the picture, given their positions in steps."""
        coordinates = []
        for axis, position in zip(self.axes, numpy.asarray(steps).T, strict=True):
            share = position / (axis.size - 1)
            if axis.is_log:
                coordinates.append(axis.low * (axis.high / axis.low) ** share)
            else:
                coordinates.append(axis.low + (axis.high - axis.low) * share)
        return numpy.stack(coordinates, axis=1)

    def steps(self, points: Any) -> Any:
        """Return the positions of points of the picture in steps; the inverse of `points`."""
        positions = []
        for axis, value in zip(self.axes, numpy.asarray(points).T, strict=True):
            scale = numpy.log if axis.is_log else numpy.asarray
            share = (scale(value) - scale(axis.low)) / (scale(axis.high) - scale(axis.low))
            positions.append((axis.size - 1) * share)
        return numpy.stack(positions, axis=1)

    def lines(self, values: Any, level: float) -> list[Any]:
        """Return the contour lines of values on the mesh at a level, as points of the picture."""
        return [self.points(simplified(line)) for line in _lines(values, level)]

    def area(self, values: Any, low: float, high: float) -> Path:
        """Return the part of the picture in which values on the mesh are between two levels."""
        return self.path(_rings(values, low, high))

    def path(self, rings: Sequence[Any]) -> Path:
        """Return the area within closed lines that are given in steps of the mesh."""
        outlines = [self.points(simplified(ring)) for ring in rings]
        if not outlines:
            return Path(numpy.empty((0, 2)))
        codes = [[Path.MOVETO, *[Path.LINETO] * (len(line) - 2), Path.CLOSEPOLY] for line in outlines]
        return Path(numpy.concatenate(outlines), numpy.concatenate(codes))


def _lines(values: Any, level: float) -> Any:
    """Return the contour lines of values on a mesh at a level, in steps."""
    return contour_generator(z=numpy.ma.masked_invalid(values), line_type="Separate").lines(level)


def _rings(values: Any, low: float, high: float) -> list[Any]:
    """Return the outlines of the areas in which values on a mesh are between two levels, in steps."""
    generator: Any = contour_generator(z=numpy.ma.masked_invalid(values), fill_type="OuterOffset")
    areas, offsets = generator.filled(low, high)
    rings = []
    for area, ends in zip(areas, offsets, strict=True):
        rings += [area[first:last] for first, last in pairwise(ends)]
    return rings


def simplified(points: Any) -> Any:
    """Return a line with fewer points, from which the given points are off by at most the tolerance.

    This is the algorithm of Ramer, Douglas and Peucker.
    """
    kept = numpy.zeros(len(points), dtype=bool)
    kept[[0, -1]] = True
    spans = [(0, len(points) - 1)]
    while spans:
        first, last = spans.pop()
        if last - first < 2:
            continue
        chord, offsets = points[last] - points[first], points[first + 1 : last] - points[first]
        length = numpy.hypot(*chord)
        across = abs(chord[0] * offsets[:, 1] - chord[1] * offsets[:, 0])
        away = across / length if length else numpy.hypot(*offsets.T)
        if away.max() > _TOLERANCE:
            middle = first + 1 + int(away.argmax())
            kept[middle] = True
            spans += [(first, middle), (middle, last)]
    return points[kept]


def on_fine_mesh(values: Any) -> Any:
    """Return values on the fine mesh, interpolated linearly from a coarser one."""
    for _ in range(2):  # along y and, transposed, along x
        positions = numpy.linspace(0, len(values) - 1, FINE)
        before = numpy.floor(positions).astype(int).clip(0, len(values) - 2)
        share = (positions - before)[:, None]
        values = ((1 - share) * values[before] + share * values[before + 1]).T
    return values


def bent_at_contours(values: Any, heights: Sequence[float]) -> Any:
    """Return a mask of the fine mesh: True in cells of a coarser mesh that a contour crosses and where values bend.

    `values`: those on the coarser mesh; `heights`: those of the contours.
    """
    bend = numpy.zeros(values.shape)
    bend[1:-1] = abs(numpy.diff(values, 2, axis=0))
    bend[:, 1:-1] = numpy.maximum(bend[:, 1:-1], abs(numpy.diff(values, 2, axis=1)))
    corners, bends = _corners(values), _corners(bend)
    is_crossed = numpy.zeros(bends.shape[1:], dtype=bool)
    for height in heights:
        is_crossed |= (corners.min(axis=0) <= height) & (height <= corners.max(axis=0))
    is_bent = is_crossed & (bends.max(axis=0) > _BENT * numpy.ptp(heights) / len(heights))
    steps = (FINE - 1) // (len(values) - 1)  # of the fine mesh along each side of a cell
    return numpy.pad(numpy.kron(is_bent, numpy.ones((steps, steps), dtype=bool)), ((0, 1), (0, 1)), mode="edge")


def _corners(values: Any) -> Any:
    """Return the values at the four corners of each cell of a mesh."""
    return numpy.stack([values[:-1, :-1], values[1:, :-1], values[:-1, 1:], values[1:, 1:]])


class Edge:
    """The edge of the part of a picture in which a quantity has no value."""

    def __init__(self, mesh: Mesh, frame: Frame, quantity: str, known: Any) -> None:
        self.mesh, self.frame, self.quantity, self.known = mesh, frame, quantity, known

    def lines(self) -> list[Any]:
        """Return the lines of the edge, as points of the picture."""
        unknown = (~self.known).astype(float)
        return [self.mesh.points(simplified(self._refined(line))) for line in _lines(unknown, 0.5)]

    def area(self) -> Path:
        """Return the part without a value."""
        return self.mesh.path([*map(self._refined, _rings((~self.known).astype(float), 0.5, 2.0))])

    def _refined(self, line: Any) -> Any:
        """Return a line with each point moved onto the edge, from half-way between two points of the mesh."""
        low, high = numpy.floor(line), numpy.ceil(line)
        is_known = self.known[low[:, 1].astype(int), low[:, 0].astype(int)]
        for _ in range(_HALVINGS):
            middle = (low + high) / 2
            is_like_low = (self._has_value(middle) == is_known)[:, None]
            low, high = numpy.where(is_like_low, middle, low), numpy.where(is_like_low, high, middle)
        return (low + high) / 2

    def _has_value(self, steps: Any) -> Any:
        x, y = self.mesh.points(steps).T
        here = self.frame.replace(**self.mesh.x.inputs(x), **self.mesh.y.inputs(y))
        return numpy.isfinite(numpy.broadcast_to(values_of(here, [self.quantity])[self.quantity], x.shape))


# --- The drawing ------------------------------------------------------------------------------------------------------


class Scale(tuple[Patch, ...]):
    """A key of a legend: a strip of colours from low to high values."""

    __slots__ = ()


class Drawing(NamedTuple):
    """The remaining work on axes after the lines and areas of a panel: the legend and the texts."""

    keys: list[Any]  # of the legend
    label: Callable[[Labels], list[Any]]  # writes texts; returns further keys, for contours without one
    ground: Callable[[Any], str]  # returns the colour of the picture in a box in pixels


def draw_field(axes: Any, panel: Panel, levels: Sequence[float], style: Style, letters: int) -> Drawing:
    """Draw the areas and lines of a field; return its legend and the functions for its texts.

    `levels`: the values of its contours; `letters`: the number of letters in a line of the legend.
    """
    drawing = _FieldDrawing(axes, panel, levels, style, letters)
    drawing.draw_regions()
    drawing.draw_contours()
    drawing.draw_edge()
    return Drawing(drawing.keys, drawing.label, drawing.ground)


def _teeth() -> list[Any]:
    """Return the path effects that draw teeth on the left of a line, where a limit is exceeded."""
    solid = {"dash_offset": 0, "dash_list": None}
    return [withTickedStroke(spacing=_APART, angle=90, length=_TOOTH / _APART, dashes=solid)]


def mixed(colour: str, other: str, share: float) -> str:
    """Return a mixture of two colours; `share`: the part of the other colour."""
    red, green, blue = (1 - share) * numpy.array(to_rgb(colour)) + share * numpy.array(to_rgb(other))
    return str(to_hex((red, green, blue)))


class _FieldDrawing:
    """A field on axes, with the keys of the legend and the bounds of regions that were drawn so far."""

    def __init__(self, axes: Any, panel: Panel, levels: Sequence[float], style: Style, letters: int) -> None:
        """Fill the axes with the colours between contours."""
        assert panel.field is not None
        self.axes, self.panel, self.levels, self.style, self.letters = axes, panel, levels, style, letters
        self.mesh, self.field = Mesh(panel.x, panel.y), panel.field
        field = panel.field
        self.heights = [float(self._scaled(level)) for level in self.levels]  # the levels as `_scaled` values
        self.values = self._scaled(evaluate(field.frame, field.quantity, self.mesh.x, self.mesh.y))
        self.known, self.extended = numpy.isfinite(self.values), extended(self.values)
        self.keys: list[Any] = []
        self.bounds: list[Bound] = []
        self.contours: list[list[Any]] = []
        self.is_pale: Any = numpy.zeros(self.values.shape, dtype=bool)  # within a band of best ranges
        axes.set_axisbelow(False)  # ticks stay visible where there is no value
        shares = numpy.linspace(0, 1, len(self.heights) + 1)
        self.colours = [to_hex(colour) for colour in LinearSegmentedColormap.from_list("", style.scale)(shares)]
        ends = [numpy.nanmin(self.extended) - 1, *self.heights, numpy.nanmax(self.extended) + 1]
        for colour, (low, high) in zip(self.colours, pairwise(ends), strict=True):
            self._fill(self.mesh.area(self.extended, low, high), facecolor=colour, zorder=1)

    def draw_regions(self) -> None:
        """Draw the regions beyond limits of the model: hatched, or bounded by a line with a name."""
        here, dashes = over(self.field.frame, self.mesh.x, self.mesh.y), cycle(_DASHES)
        for region in self.field.regions:
            excess = numpy.where(self.known, region.excess(here), numpy.nan)
            wider = extended(excess)
            paths = self.mesh.lines(wider, 0.0)
            if region.hatch:
                self._line(paths, linewidth=0.5, linestyle="dotted")
                hatched: dict[str, Any] = {"facecolor": "none", "hatch": region.hatch, "edgecolor": self.style.hatch}
                area = self.mesh.area(wider, 0.0, max(1.0, float(numpy.nanmax(wider)) + 1))
                self._fill(area, zorder=1.2, **hatched)
                self.keys.append(Patch(label=self._in_lines(region.text), linewidth=0.4, **hatched))
            else:
                look: dict[str, Any] = {"linewidth": 0.7, "linestyle": next(dashes), "path_effects": _teeth()}
                self._line(paths, **look)
                self.keys.append(Line2D([], [], color=self.style.ink, label=self._in_lines(region.text), **look))
                inside = numpy.nan_to_num(excess, nan=-1.0) > 0
                self.bounds.append(Bound(region.name, paths, partial(self._at, inside)))
        if self.bounds:
            self.keys.append(Line2D([], [], linestyle="", label=self._in_lines(_ABOUT_TEETH)))

    def draw_contours(self) -> None:
        """Draw the bands of best ranges, the contours, and the contours as the paper prints them.

        If only some contours have a band, these contours are thick.
        """
        self.contours = [self.mesh.lines(self.extended, height) for height in self.heights]
        step = self._draw_bands() if self.field.has_best and self.levels else 0
        for position, paths in enumerate(self.contours):
            has_band = step > 1 and position % step == step // 2
            self._line(paths, linewidth=_THICK if has_band else _THIN, gid=f"contour-{position}")
        if self.field.printed:
            printed = self._scaled(evaluate(self.field.frame, self.field.printed, self.mesh.x, self.mesh.y))
            look: dict[str, Any] = {"linewidth": 0.6, "linestyle": "dashed"}
            for position, height in enumerate(self.heights):
                self._line(self.mesh.lines(printed, height), gid=f"printed-{position}", **look)
            self.keys.append(Line2D([], [], color=self.style.ink, label="as printed", **look))

    def _draw_bands(self) -> int:
        """Draw bands, and return n if every n-th contour has one; 0 if there are no bands.

        In the band of a contour, the best range includes the value of the contour.
        """
        size = _UNCERTAIN if self.field.frame.uncertainties else _CERTAIN
        coarse = Mesh(self.panel.x, self.panel.y, size)
        best = band_of(over(self.field.frame, coarse.x, coarse.y), self.field.quantity, (size, size))
        if best is None:
            return 0
        far = 2 * float(abs(numpy.array(self.heights)).max()) + _FARTHEST  # stands for an infinite end
        low, high = self._ends(best, far)
        # Each is positive within the band of its contour.
        inside = numpy.array([numpy.minimum(high - height, height - low) for height in self.heights])
        step = spacing(inside)
        if step == 0:
            return 0
        with_band = slice(step // 2, None, step)
        self.is_pale = numpy.any(inside[with_band] > 0, axis=0)
        for within, height in zip(inside[with_band], self.heights[with_band], strict=True):
            self._fill(self.mesh.area(within, 0.0, 3 * far), facecolor=self.style.paper, alpha=_PALE, zorder=1.1)
            for end in (low, high):
                paths = self.mesh.lines(numpy.where(abs(end) < far, end, numpy.nan), height)
                self._line(paths, color=self.style.hatch, linewidth=0.35, zorder=1.1, gid="band")
        text = best.key_of_map(step, self.field.frame.law.short)
        look: dict[str, Any] = {"facecolor": self.style.paper, "edgecolor": self.style.hatch, "linewidth": 0.35}
        line = Line2D([], [], color=self.style.ink, linewidth=_THIN if step == 1 else _THICK)
        self.keys.append((Patch(label=self._in_lines(text), **look), line))
        return step

    def _ends(self, best: Band, far: float) -> list[Any]:
        """Return both ends of best ranges on the fine mesh, clipped at ±far.

        They are interpolated from the coarser mesh, but exact where an end bends at a contour.
        """
        low, high = (extended(self._scaled(end).clip(-far, far)) for end in (best.low, best.high))
        ends = [on_fine_mesh(low), on_fine_mesh(high)]
        is_bent = bent_at_contours(low, self.heights) | bent_at_contours(high, self.heights)
        rows, columns = numpy.nonzero(is_bent)
        x, y = self.mesh.x.values()[columns], self.mesh.y.values()[rows]
        here = self.field.frame.replace(**self.mesh.x.inputs(x), **self.mesh.y.inputs(y))
        exact = band_of(here, self.field.quantity, x.shape) if x.size else None
        if exact is not None:
            for end, values in zip(ends, (exact.low, exact.high), strict=True):
                end[is_bent] = self._scaled(values).clip(-far, far)
        return ends

    def draw_edge(self) -> None:
        """Clear the part without values, and draw its edge."""
        if self.known.all():
            return
        edge = Edge(self.mesh, self.field.frame, self.field.quantity, self.known)
        paths, gaps = edge.lines(), self.field.gaps
        self._fill(edge.area(), facecolor=self.style.paper, zorder=2.1)
        self._line(paths, linewidth=0.8, zorder=2.2, gid="edge")
        label = self._in_lines(f"no value: {'; '.join(gaps)}" if gaps else "no value")
        self.keys.append(Patch(label=label, facecolor=self.style.paper, edgecolor=self.style.ink, linewidth=0.8))
        if len(gaps) == 1:
            self.bounds.append(Bound(gaps[0], paths, partial(self._at, ~self.known)))

    def label(self, labels: Labels) -> list[Any]:
        """Put the texts of contours and of bounds into the axes; return a scale if many contours have no text."""
        texts, _ = self.field.in_words(self.levels)
        count = labels.of_contours(texts, self.contours)
        labels.of_bounds(self.bounds)
        if count >= _LEAST_LABELLED * len(texts):
            return []
        label = self._in_lines(
            f"{symbol(self.field.quantity)} at the contours, in the order of these colours: {', '.join(texts)}"
        )
        return [Scale(Patch(facecolor=colour, linewidth=0, label=label) for colour in self.colours)]

    def ground(self, box: Any) -> str:
        """Return the colour in the middle of a box in pixels; a pale one if bands cover most of the box."""
        middle = (box.min + box.max) / 2
        (value,) = self._at(self.values, [middle])
        if not numpy.isfinite(value):
            return self.style.paper
        colour = self.colours[int(numpy.searchsorted(self.heights, value))]
        is_pale = self._at(self.is_pale, [*box.corners(), middle]).mean() > 0.5
        return mixed(colour, self.style.paper, _PALE) if is_pale else colour

    def _at(self, values: Any, pixels: Any) -> Any:
        """Return values on the mesh at the points nearest to positions in pixels."""
        steps = self.mesh.steps(self.axes.transData.inverted().transform(pixels))
        columns, rows = numpy.rint(steps).astype(int).clip(0, FINE - 1).T
        return values[rows, columns]

    def _scaled(self, values: Any) -> Any:
        """Return values on the scale of the contours: as logarithms if the field is logarithmic."""
        with numpy.errstate(invalid="ignore", divide="ignore"):
            return numpy.log10(values) if self.field.is_log else numpy.asarray(values)

    def _in_lines(self, text: str) -> str:
        return "\n".join(lines(text, self.letters))

    def _fill(self, area: Path, *, zorder: float, **look: Any) -> None:
        if area.codes is not None:
            filled = PathCollection([area], linewidth=0, zorder=zorder, **look)
            self.axes.add_collection(filled, autolim=False)

    def _line(self, paths: Sequence[Any], **look: Any) -> None:
        look = {"color": self.style.ink, "zorder": 2, **look}
        self.axes.add_collection(LineCollection([*paths], **look), autolim=False)
