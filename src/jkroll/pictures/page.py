"""Draw maps and curves into SVG, PDF and PNG files, for a journal's page or a dark slide.

Only this module and `labels` import matplotlib, which lays out the page. The same picture gives the same bytes: no
date, ids from the content, and nothing from the user's own matplotlib settings.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from io import BytesIO
from math import ceil
from typing import Any

import matplotlib as mpl  # type: ignore[import-not-found,unused-ignore]
import numpy
from matplotlib import ticker  # type: ignore[import-not-found,unused-ignore]
from matplotlib.figure import Figure  # type: ignore[import-not-found,unused-ignore]
from matplotlib.layout_engine import ConstrainedLayoutEngine  # type: ignore[import-not-found,unused-ignore]
from matplotlib.lines import Line2D  # type: ignore[import-not-found,unused-ignore]
from matplotlib.patches import Patch  # type: ignore[import-not-found,unused-ignore]
from matplotlib.transforms import ScaledTranslation  # type: ignore[import-not-found,unused-ignore]

from .. import __version__
from ..quantities.formatting import PREFIXABLE, engineering, pretty
from ..quantities.markup import lines, plain, typeset
from .axes import Axis, described, quantity_of
from .labels import label_contours, label_points
from .maps import Curve, Map, Panel, Picture, Region, evaluate, over
from .styles import DASHES, LETTER, LOOKS, SIZE, STYLES, Style

FINE = 401  # points a side of a map, between which its lines are straight
_ONE_PANEL, _MORE_PANELS = 120 / 25.4, 180 / 25.4  # default widths in inches
_NARROWEST = 2.0  # width of a panel beside others
_ASPECT, _ASPECT_BESIDE = 0.75, 1.0  # height of axes over their width, alone in a row and beside others
_GAP = 0.04  # around the parts of a page, in inches


def draw(drawn: Map | Picture, kind: str, inches: float | None, style: str, *, has_caption: bool = True) -> bytes:
    """Return a picture as the content of an SVG, PDF or PNG file of a width in inches, or of the default width."""
    with settings(STYLES[style]):
        figure = figure_of(drawn, inches, STYLES[style], has_caption=has_caption)
        buffer = BytesIO()
        figure.savefig(buffer, format=kind, dpi=300, metadata=_metadata(drawn, kind))
    return buffer.getvalue()


def figure_of(drawn: Map | Picture, inches: float | None, style: Style, *, has_caption: bool) -> Figure:
    """Return a picture as matplotlib's figure: title, rows of axes with their legends, caption."""
    panels: Sequence[Any] = [drawn] if isinstance(drawn, Map) else drawn.panels
    inches = inches or (_ONE_PANEL if len(panels) == 1 else _MORE_PANELS)
    columns = _columns(len(panels), inches)
    rows = ceil(len(panels) / columns)
    layout = ConstrainedLayoutEngine(w_pad=_GAP, h_pad=_GAP, wspace=0, hspace=0)
    figure = Figure(figsize=(inches, 2 * inches * rows), layout=layout)
    every = [*figure.subplots(rows, columns, squeeze=False).flat]
    for empty in every[len(panels) :]:
        empty.remove()
    if has_caption:
        figure.suptitle(typeset(drawn.title), fontsize=SIZE)
        caption = "\n".join(lines(" ".join(drawn.caption), _letters(inches)))
        figure.supxlabel(caption, x=0.015, ha="left", fontsize=SIZE, linespacing=1.2)
    letters = _letters(inches / columns - 0.4)  # of a line of a legend
    drawings = []
    for panel, axes, letter in zip(panels, every, "abcdef", strict=False):
        _set_axes(axes, panel, inches / columns, _ASPECT if columns == 1 else _ASPECT_BESIDE)
        if isinstance(panel, Map):
            drawings.append(_draw_map(axes, panel, style, letters))
        else:
            title = f"({letter}) {panel.title}" if len(panels) > 1 else panel.title
            axes.set_title(typeset(title), loc="left" if len(panels) > 1 else "center", fontsize=SIZE)
            drawings.append(_draw_panel(axes, panel, style, letters))
    _fit(figure, every[: len(panels)], [keys for keys, _ in drawings])
    for panel, axes, (_, contours) in zip(panels, every, drawings, strict=False):
        taken = label_points(axes, panel.marks if isinstance(panel, Map) else panel.points, style)
        for drawing, texts, middle in contours:
            label_contours(axes, drawing, texts, middle, taken, style)
    return figure


def _columns(panels: int, inches: float) -> int:
    """Return the number of columns of panels: few stand in one row or one column, many in rows."""
    if panels > 3:
        return 3 if inches / 3 >= _NARROWEST else 2
    return panels if inches / panels >= _NARROWEST else 1


def _letters(inches: float) -> int:
    """Return the number of letters of a line that fit into a width."""
    return int(0.97 * inches * 72 / (LETTER * SIZE))


def _fit(figure: Figure, every: Sequence[Any], keys: Sequence[Sequence[Any]]) -> None:
    """Put a legend below each of the axes, and set the height of a page to that of its parts."""
    figure.draw_without_rendering()
    dpi = figure.dpi
    heights: dict[int, float] = {}
    for axes, handles in zip(every, keys, strict=True):
        inner, outer = axes.get_window_extent(), axes.get_tightbbox()
        corner = ScaledTranslation((outer.x0 - inner.x0) / dpi, (outer.y0 - inner.y0) / dpi, figure.dpi_scale_trans)
        height = outer.height
        if handles:
            legend = axes.legend(
                handles=handles, loc="upper left", bbox_to_anchor=(0, 0), bbox_transform=axes.transAxes + corner,
                handlelength=2.4,
            )  # fmt: skip
            for text in legend.get_texts():
                text.set_linespacing(1.0)
            height += legend.get_window_extent().height
        row = axes.get_subplotspec().rowspan.start
        heights[row] = max(heights.get(row, 0.0), height)
    texts = (text.get_window_extent().height for text in figure.texts if text.get_text())
    parts = [*heights.values(), *texts]
    figure.set_size_inches(figure.get_figwidth(), sum(parts) / dpi + 2 * _GAP * len(parts))
    for _ in range(2):  # the first time, the layout sets out from the places on the higher page
        figure.draw_without_rendering()
    figure.set_layout_engine("none")  # the places of labels are measured in this layout


@contextmanager
def settings(style: Style) -> Iterator[None]:
    """Use matplotlib's own settings, not the user's, with ours on top."""
    ours: dict[Any, Any] = {
        "font.size": SIZE, "font.family": "STIXGeneral", "mathtext.fontset": "stix",
        "axes.linewidth": 0.6, "xtick.major.width": 0.6, "ytick.major.width": 0.6, "hatch.linewidth": 0.35,
        "xtick.direction": "in", "ytick.direction": "in", "hatch.color": style.hatch,
        "xtick.major.pad": 5.0,  # clear of the lowest label of the other axis
        "legend.frameon": False, "legend.fontsize": SIZE, "legend.labelspacing": 0.3,
        "legend.borderpad": 0.0, "legend.borderaxespad": 0.3, "legend.handleheight": 1.0,
        "svg.hashsalt": "jkroll", "pdf.fonttype": 42,
    }  # fmt: skip
    ours |= dict.fromkeys(("figure.facecolor", "savefig.facecolor", "axes.facecolor"), style.paper)
    ours |= dict.fromkeys(("text.color", "axes.edgecolor", "axes.labelcolor", "xtick.color", "ytick.color"), style.ink)
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(ours)
        yield


def _metadata(drawn: Map | Picture, kind: str) -> dict[str, Any]:
    """Return what the file says of itself, without the time at which it was made."""
    about, who = (
        plain(" ".join((*drawn.caption, *drawn.remarks))),
        f"jkroll {__version__}, matplotlib {mpl.__version__}",
    )
    named: dict[str, dict[str, Any]] = {
        "svg": {"Description": about, "Creator": who, "Date": None},
        "pdf": {"Subject": about, "Creator": who, "CreationDate": None},
        "png": {"Description": about, "Software": who},
    }
    return {"Title": plain(drawn.title), **named[kind]}


# --- Axes -------------------------------------------------------------------------------------------------------------


def _set_axes(axes: Any, panel: Map | Panel, inches: float, aspect: float) -> None:
    """Set the shape of axes, and the scales, ends, ticks and titles of both."""
    if isinstance(panel, Panel) and panel.is_true_to_scale:
        aspect = (panel.y.high - panel.y.low) / (panel.x.high - panel.x.low)
    axes.set_box_aspect(aspect)
    letters = _letters(0.77 * inches)  # of a line of a title
    _set_axis(axes, panel.x, "x", max(2, int(inches / 0.6)), letters)
    _set_axis(axes, panel.y, "y", 9, int(1.1 * aspect * letters))


def _set_axis(axes: Any, axis: Axis, which: str, most: int, letters: int) -> None:
    """Set one axis. Ticks of a logarithmic one have their units; a linear one has one unit, in its title."""
    side, unit = getattr(axes, f"{which}axis"), quantity_of(axis.name).unit.removeprefix("1")
    axes.set(**{f"{which}scale": "log" if axis.is_log else "linear", f"{which}lim": (axis.low, axis.high)})
    if axis.is_log:
        is_long = axis.high > 50 * axis.low
        side.set_major_locator(ticker.LogLocator(subs=(1,) if is_long else (1, 2, 5), numticks=most))
        side.set_minor_formatter(ticker.NullFormatter())
        if unit in PREFIXABLE:
            side.set_major_formatter(ticker.EngFormatter(pretty(unit)))
            unit = ""
    else:
        end = max(abs(axis.low), abs(axis.high))
        number, unit = engineering(end, unit, 15)
        scale = end / float(number)
        side.set_major_locator(ticker.MaxNLocator(min(most, 8), steps=[1, 2, 5, 10]))
        side.set_major_formatter(lambda value, _: f"{value / scale:.12g}".replace("-", "−"))
        side.set_minor_locator(ticker.AutoMinorLocator())
    title = described(axis.name, pretty(unit)).replace(", ", ",\N{NO-BREAK SPACE}")  # no line ends behind a comma
    side.set_label_text("\n".join(lines(title, letters)), linespacing=1.0)


# --- Maps and panels --------------------------------------------------------------------------------------------------

Contours = tuple[Any, Sequence[str], tuple[float, float]]  # with their labels, and the place that these stand near


def _draw_map(axes: Any, drawn: Map, style: Style, letters: int) -> tuple[list[Any], list[Contours]]:
    """Draw all of a map but the texts inside; return the keys of a legend, and contours to label."""
    x, y = (axis._replace(size=FINE) for axis in (drawn.x, drawn.y))
    scale = numpy.ma.log10 if drawn.is_log else numpy.ma.asarray

    def field(quantity: str) -> Any:
        return scale(numpy.ma.masked_invalid(evaluate(drawn.scene, quantity, x, y)))

    values, levels = field(drawn.quantity), drawn.levels()
    mask = numpy.ma.getmaskarray(values)
    heights = [float(scale(level.value)) for level in levels]
    colours = [style.band(place / max(1, len(heights))) for place in range(len(heights) + 1)]
    across, up = x.values(), y.values()
    axes.contourf(across, up, values, levels=[values.min() - 1, *heights, values.max() + 1], colors=colours)
    here = over(drawn.scene, x, y)
    keys = [_draw_region(axes, region, (across, up, mask, here), style, letters) for region in drawn.regions]
    texts = [level.text for level in levels]
    labelled: list[Contours] = []
    if heights:
        look = {"levels": heights, "colors": style.ink}
        contours = axes.contour(across, up, values, linewidths=0.7, linestyles="solid", **look)
        labelled.append((contours, texts, (0.5, 0.5)))
        if drawn.printed:
            contours = axes.contour(across, up, field(drawn.printed), linewidths=0.6, linestyles="dashed", **look)
            labelled.append((contours, texts, (0.75, 0.5)))
            keys.append(Line2D([], [], color=style.ink, linewidth=0.6, linestyle="dashed", label="as printed"))
    if mask.any():
        axes.contour(across, up, mask, levels=[0.5], colors=style.ink, linewidths=0.8)
        keys.append(Patch(label="no value", facecolor=style.paper, edgecolor=style.ink, linewidth=0.8))
    for value, _ in drawn.guides:
        axes.axhline(value, color=style.ink, linewidth=0.6, linestyle=(0, (1, 2)))
    _mark_edge(axes, "x", [(mark.x, mark.text) for mark in drawn.marks if mark.y is None])
    _mark_edge(axes, "y", [*drawn.guides, *((mark.y, mark.text) for mark in drawn.marks if mark.x is None)])
    return keys, labelled


def _draw_region(axes: Any, region: Region, where: tuple[Any, Any, Any, Any], style: Style, letters: int) -> Any:
    """Draw a region with its border, or the border alone, where the map has values; return its key."""
    text = "\n".join(lines(f"{region.text} {region.side}".strip(), letters))
    if region.look is None:
        return Patch(label=text, facecolor="none", edgecolor="none")
    look, (x, y, mask, here) = LOOKS[region.look], where
    excess = numpy.ma.masked_array(numpy.broadcast_to(region.excess(here), mask.shape), mask)
    excess = numpy.ma.masked_invalid(excess)
    width, dashes = look.line
    axes.contour(x, y, excess, levels=[0], colors=style.ink, linewidths=width, linestyles=dashes)
    if look.is_line:
        return Line2D([], [], color=style.ink, linewidth=width, linestyle=dashes, label=text)
    colours = (
        {"colors": [style.ink], "alpha": look.shade} if look.shade else {"colors": "none", "hatches": [look.hatch]}
    )
    axes.contourf(x, y, excess, levels=[0, max(1.0, float(excess.max()) + 1)], **colours)
    if look.shade:
        return Patch(label=text, facecolor=style.ink, alpha=look.shade)
    return Patch(label=text, facecolor="none", hatch=look.hatch, edgecolor=style.hatch, linewidth=0.4)


def _mark_edge(axes: Any, which: str, marks: Sequence[tuple[float | None, str]]) -> None:
    """Put ticks with texts on the upper or the right edge of a map."""
    if not marks:
        return
    side = axes.secondary_xaxis("top") if which == "x" else axes.secondary_yaxis("right")
    look = {"rotation": 60, "rotation_mode": "anchor", "ha": "left"} if which == "x" else {}
    side.set_ticks([value for value, _ in marks], labels=[typeset(text) for _, text in marks], **look)
    side.minorticks_off()
    side.tick_params(direction="inout", length=6)


def _draw_panel(axes: Any, panel: Panel, style: Style, letters: int) -> tuple[list[Any], list[Contours]]:
    """Draw curves, which differ in colour and in their dashes; return the keys of a legend."""
    handles = [
        axes.plot(curve.x, curve.y, label="\n".join(lines(curve.text, letters)), **line_of(curve, number, style))[0]
        for number, curve in enumerate(panel.curves)
    ]
    for mark in panel.points:
        if mark.x is None or mark.y is None:
            _mark_edge(axes, "y" if mark.x is None else "x", [(mark.y if mark.x is None else mark.x, mark.text)])
    texts = [Patch(label=typeset(text), facecolor="none", edgecolor="none") for text in panel.keys]
    return texts or (handles if len(handles) > 1 else []), []


def line_of(curve: Curve, number: int, style: Style) -> dict[str, Any]:
    """Return the look of the curve of a number, as matplotlib takes it."""
    turn = number // len(DASHES)  # after which the colours come again, with other dashes
    dashes = "--" if curve.is_dashed else DASHES[(number + turn) % len(DASHES)]
    return {"color": style.lines[curve.colour % len(style.lines)], "linestyle": dashes, "linewidth": 1.1}
