"""Maps and curves on a pair of axes of matplotlib, both of which run from 0 to 1: contours of powers are straight there."""

from textwrap import wrap
from typing import Any, NamedTuple

from .axes import Axis
from .canvas import LINES, Colour, shade
from .maps import Map, Mark, Region
from .panels import Curve, Panel

LABEL, TICK, SMALL = 8.0, 7.0, 6.0  # sizes of letters in points, whatever the width of the page
_DASHES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)))
SHADE = 0.25
BORDERS: dict[str, dict[str, Any]] = {
    "hatched": {"linewidths": 0.5, "linestyles": "dotted"},
    "shaded": {"linewidths": 0.5, "linestyles": "dotted"},
    "border": {"linewidths": 0.9, "linestyles": "dashdot"},
}
HATCHES = ("xxxx", "////", "\\\\\\\\", "||||")
Place = tuple[float, float]  # as parts of the axes


class Style(NamedTuple):
    """Paper, ink, and how a band's colour is put on the paper: how bright it is, and how much of it the paper takes."""

    paper: str
    ink: str
    brightness: float
    strength: float


STYLES = {"light": Style("#ffffff", "#000000", 1.0, 0.55), "dark": Style("#12151c", "#f2f2f2", 0.55, 0.75)}


def draw_map(axes: Any, drawn: Map, inches: float, style: Style) -> None:
    """Bands, labelled contours, regions and marks. Both axes run from 0 to 1, so that contours of powers are straight."""
    import numpy

    x, y = drawn.x.place(drawn.x.values()), drawn.y.place(drawn.y.values())
    levels = drawn.levels()
    scale = numpy.ma.log10 if drawn.is_log else numpy.ma.asarray
    heights = [float(scale(level.value)) for level in levels]
    values = scale(numpy.ma.masked_invalid(drawn.values))
    if heights:
        bands = [values.min() - 1, *heights, values.max() + 1]
        colours = [_tint(shade(place / max(1, len(heights))), style) for place in range(len(heights) + 1)]
        axes.contourf(x, y, values, levels=bands, colors=colours)
        lines = axes.contour(x, y, values, levels=heights, colors=style.ink, linewidths=0.7, linestyles="solid")
        texts = [level.text for level in levels]
        points = [(mark.x, mark.y) for mark in drawn.marks if mark.x is not None and mark.y is not None]
        taken = [(float(drawn.x.place(at)) + 0.08, float(drawn.y.place(up)) + 0.02) for at, up in points]
        _label(axes, lines, texts, style, (0.5, 0.5), taken)
        if drawn.printed is not None:
            printed = axes.contour(
                x, y, scale(drawn.printed), levels=heights, colors=style.ink, linewidths=0.6, linestyles="dashed"
            )
            _label(axes, printed, texts, style, (0.75, 0.5), taken)
    for place, region in enumerate(drawn.regions):
        if region.kind != "everywhere":
            _draw_region(axes, region, HATCHES[place % len(HATCHES)], style)
    for guide in drawn.guides:
        where = drawn.y.place(guide.y)
        axes.axhline(where, color=style.ink, linewidth=0.6, linestyle=(0, (1, 2)))
        axes.text(0.99, where, guide.text, fontsize=SMALL, ha="right", va="center", bbox=_box(style))
    for mark in drawn.marks:
        _draw_mark(axes, drawn.x, drawn.y, mark, style, _box(style))
    _set_axes(axes, drawn.x, drawn.y, inches)
    axes.set(xlim=(0, 1), ylim=(0, 1))


def _label(axes: Any, lines: Any, texts: list[str], style: Style, middle: Place, taken: list[Place]) -> None:
    """A label on each contour, as near to the middle as there is room between those places that are taken."""
    import numpy

    for path, text in zip(lines.get_paths(), texts, strict=True):
        points = path.vertices[(path.vertices > 0.03).all(axis=1) & (path.vertices < 0.97).all(axis=1)]
        near_first = points[numpy.argsort(numpy.hypot(*(points - middle).T), kind="stable")]
        room = 0.03 * (2 + len(text)), 0.05
        free = [
            point
            for point in near_first.tolist()
            if all(abs(point[0] - x) > room[0] or abs(point[1] - y) > room[1] for x, y in taken)
        ]
        if free:
            taken.append((free[0][0], free[0][1]))
            axes.text(*free[0], text, fontsize=SMALL + 0.5, ha="center", va="center", bbox=_box(style))


def _box(style: Style) -> dict[str, Any]:
    """What keeps lines and hatches off a text."""
    return {"facecolor": style.paper, "alpha": 0.8, "edgecolor": "none", "pad": 0.8}


def _draw_region(axes: Any, region: Region, hatch: str, style: Style) -> None:
    """A region, hatched or shaded, with its border, or the border alone."""
    x, y = region.x.place(region.x.values()), region.y.place(region.y.values())
    if region.kind != "border":
        look = (
            {"colors": [style.ink], "alpha": SHADE}
            if region.kind == "shaded"
            else {"colors": "none", "hatches": [hatch]}
        )
        axes.contourf(x, y, region.margin, levels=[float(region.margin.min()) - 1, 0], **look)
    axes.contour(x, y, region.margin, levels=[0], colors=style.ink, **BORDERS[region.kind])


def _draw_mark(
    axes: Any, x: Axis, y: Axis, mark: Mark, style: Style, box: dict[str, Any] | None, drop: float = 3
) -> None:
    """A point with its text, or a tick on the upper or the right edge."""
    if mark.x is not None and mark.y is not None:
        at = float(x.place(mark.x)), float(y.place(mark.y))
        axes.plot(*at, "o", zorder=4, markersize=3.5, color=style.ink, markeredgecolor=style.paper, markeredgewidth=0.6)
        side = 4 if at[0] < 0.75 else -4
        axes.annotate(
            mark.text, at, xytext=(side, drop), textcoords="offset points", fontsize=SMALL + 0.5,
            ha="left" if side > 0 else "right", color=style.ink, bbox=box,
        )  # fmt: skip
    elif mark.x is not None:
        at = float(x.place(mark.x)), 1.0
        axes.plot(*at, "|", markersize=6, color=style.ink, clip_on=False)
        axes.annotate(
            mark.text,
            at,
            xytext=(0, 4),
            textcoords="offset points",
            fontsize=SMALL,
            rotation=35,
            rotation_mode="anchor",
        )
    elif mark.y is not None:
        at = 1.0, float(y.place(mark.y))
        axes.plot(*at, "_", markersize=6, color=style.ink, clip_on=False)
        axes.annotate(mark.text, at, xytext=(5, 0), textcoords="offset points", fontsize=SMALL, va="center")


def _tint(colour: Colour, style: Style) -> tuple[float, ...]:
    """A colour of a band, as the paper takes it, so that ink can be read on it."""
    paper = [int(style.paper[place : place + 2], 16) for place in (1, 3, 5)]
    return tuple((p + (c * style.brightness - p) * style.strength) / 255 for c, p in zip(colour, paper, strict=True))


def line_of(curve: Curve, number: int) -> dict[str, Any]:
    """How the curve of a number is drawn."""
    colour = tuple(part / 255 for part in LINES[curve.colour % len(LINES)])
    return {"color": colour, "linestyle": "--" if curve.is_dashed else _DASHES[number % len(_DASHES)], "linewidth": 1.0}


def draw_panel(axes: Any, panel: Panel, inches: float, style: Style) -> None:
    """Curves that are told apart by colour and by their dashes, and points."""
    for number, curve in enumerate(panel.curves):
        axes.plot(panel.x.place(curve.x), panel.y.place(curve.y), label=curve.text, **line_of(curve, number))
    for number, mark in enumerate(panel.points):
        _draw_mark(axes, panel.x, panel.y, mark, style, None, drop=-9 if number % 2 else 3)
    _set_axes(axes, panel.x, panel.y, inches)
    axes.set(xlim=(0, 1), ylim=(0, 1))
    if panel.title:
        axes.set_title(panel.title, fontsize=LABEL)
    if panel.is_true_to_scale:
        axes.set_aspect((panel.y.high - panel.y.low) / (panel.x.high - panel.x.low))


def _set_axes(axes: Any, x: Axis, y: Axis, inches: float) -> None:
    """Ticks and labels: as many as there is room for."""
    across = max(2, int(inches / 0.6))
    for axis, side, most in ((x, axes.xaxis, across), (y, axes.yaxis, 9)):
        ticks = axis.ticks(most)
        side.set_ticks([float(axis.place(tick.value)) for tick in ticks], labels=[tick.text for tick in ticks])
        side.set_ticks([float(axis.place(value)) for value in axis.small_ticks()], minor=True)
        side.set_label_text("\n".join(wrap(axis.label(most), int(0.65 * inches * 72 / (0.56 * LABEL)))))
    axes.tick_params(which="both", direction="in", top=False, right=False)
