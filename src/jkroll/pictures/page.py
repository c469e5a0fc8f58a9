"""Draw pictures into SVG, PDF and PNG files, for a journal's page or a dark slide.

Only this module, `fields`, `files` and `labels` import matplotlib; the others import this module where they draw. The
same picture gives the same bytes: a file has no date, its ids depend on the content alone, and the user's own settings
of matplotlib are ignored.
"""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from itertools import chain
from math import ceil
from typing import Any

import matplotlib as mpl  # type: ignore[import-not-found,unused-ignore]
import numpy
from matplotlib import font_manager, ticker  # type: ignore[import-not-found,unused-ignore]
from matplotlib.figure import Figure  # type: ignore[import-not-found,unused-ignore]
from matplotlib.layout_engine import ConstrainedLayoutEngine  # type: ignore[import-not-found,unused-ignore]
from matplotlib.legend_handler import HandlerTuple  # type: ignore[import-not-found,unused-ignore]
from matplotlib.patches import FancyArrowPatch, Patch  # type: ignore[import-not-found,unused-ignore]
from matplotlib.transforms import Bbox, ScaledTranslation  # type: ignore[import-not-found,unused-ignore]

from ..errors import BadRequest
from ..quantities.markup import lines, plain, typeset
from ..text import quoted
from .bands import Band
from .fields import Drawing, Scale, draw_field, mixed
from .files import FONT, About, content_of
from .labels import Labels
from .picture import STYLES, Axis, Curve, Field, Panel, Picture, Style, described, extent, is_flat

LETTER_SIZE = 8.6  # in points, at any width of the page; subscripts are 0.7 times as large, 6 points
_CONTOURS = 12  # largest number of contours
_TICK_DIGITS = 6  # largest number of digits at a tick
_TICK_WIDTHS = {False: 0.45, True: 0.6}  # width of a number and a gap on the lower axis, in inches, by `is_log`
LETTER_WIDTH = 0.42  # mean width of a letter over its size
MARKERS = "os^Dv*"
DASHES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (8, 2)))
_HEADS = ("-", "-|>", "<|-|>")  # by the number of an arrow's heads
_HANDLERS = {Scale: HandlerTuple(ndivide=None, pad=0.0)}  # how a legend draws keys that matplotlib does not know
_BAND_OPACITY = 0.22  # of the best ranges of a curve
_ONE_PANEL, _MORE_PANELS = 85 / 25.4, 180 / 25.4  # default widths in inches: one column of a journal, or two
_NARROWEST = 2.0  # least width of a panel in a row with others, in inches
_ASPECT, _ASPECT_BESIDE = 0.75, 1.0  # height over width: of axes alone in a row, and of several in a row
_HIGHEST = 5  # height of the sheet from which a page is cut, per row of panels, over the page's width
_BESIDE = 0.04  # gap between panels of a row, over their width
_MARGIN = 0.015  # on both sides of a caption, over the width of a page
_GAP = 0.04  # around the parts of a page, in inches


def draw(
    drawn: Picture, file_format: str, inches: float | None, style: str, *, has_caption: bool = True, command: str = ""
) -> bytes:
    """Return a picture as the content of an SVG, PDF or PNG file, with a width in inches or the default width.

    `command`: the command that drew the picture, which the metadata of the file names.
    """
    names = []
    for panel in drawn.panels:
        names += [curve.text for curve in panel.curves]
        names += [mark.text for mark in panel.marks]
    _check_letters([*names, *drawn.caption, *drawn.doubts] if has_caption else names)
    of_panels = "; ".join(filter(None, (panel.title for panel in drawn.panels)))
    title, *rest = map(plain, filter(None, (drawn.title or of_panels, *drawn.caption, *drawn.doubts)))
    about = About(title.removesuffix("."), " ".join(rest), command)
    with settings(STYLES[style]):
        figure = figure_of(drawn, inches, STYLES[style], has_caption=has_caption)
        box = figure.get_tightbbox().padded(_GAP)
        page = Bbox.from_extents(0, box.y0, figure.get_figwidth(), box.y1)
        return content_of(figure, file_format, about, dpi=300, bbox_inches=page)


def _check_letters(texts: Iterable[str]) -> None:
    """Raise BadRequest for a letter that the font lacks, such as one in the name of a user's material."""
    font = font_manager.get_font(font_manager.findfont(FONT))
    for letter in dict.fromkeys("".join(texts)):
        if letter.isalpha() and not font.get_char_index(ord(letter)):
            raise BadRequest(f"-o: the font of pictures has no {quoted(letter)}; name the material with other letters")


def figure_of(drawn: Picture, inches: float | None, style: Style, *, has_caption: bool) -> Figure:
    """Return a picture as a matplotlib figure: a title, rows of axes with legends, and a caption.

    All parts are on a larger sheet, which `draw` cuts to the page.
    """
    count = len(drawn.panels)
    inches = inches or (_ONE_PANEL if count == 1 else _MORE_PANELS)
    columns = min(count, max(1, int(inches / _NARROWEST)))
    rows = ceil(count / columns)
    layout = ConstrainedLayoutEngine(w_pad=_GAP, h_pad=_GAP, wspace=_BESIDE, hspace=0, compress=True)
    figure = Figure(figsize=(inches, _HIGHEST * inches * rows), layout=layout)
    every = [*figure.subplots(rows, columns, squeeze=False).flat]
    for empty in every[count:]:
        empty.remove()
    letters = _letters(inches / columns - 0.4)  # number of letters in a line of a legend
    drawings: list[Drawing] = []
    for panel, axes, letter in zip(drawn.panels, every, "abcdef", strict=False):
        _set_axes(axes, panel, inches / columns, _ASPECT if columns == 1 else _ASPECT_BESIDE)
        title = [f"({letter})"] if count > 1 else []
        if has_caption:
            title.append(panel.title)
        axes.set_title(typeset(" ".join(title)), loc="left" if count > 1 else "center", fontsize=LETTER_SIZE)
        drawings.append(_drawing_on(axes, panel, style, letters))
    corners = _lay_out(figure, every, [drawing.keys for drawing in drawings])
    for panel, axes, drawing, corner in zip(drawn.panels, every, drawings, corners, strict=False):
        further = _label(axes, panel, drawing, style)
        if further:
            _put_legend(axes, [*drawing.keys, *further], corner)
    if has_caption:
        box, height = figure.get_tightbbox(), figure.get_figheight()
        figure.text(0.5, (box.y1 + 2 * _GAP) / height, typeset(drawn.title), ha="center", va="bottom")
        texts = " ".join(drawn.caption), *drawn.doubts
        _put_caption(figure, texts, (box.y0 - 2 * _GAP) / height)
    return figure


def _put_caption(figure: Figure, texts: Sequence[str], top: float) -> None:
    """Write a caption at a height of the figure, in lines that are as long as its width allows."""
    shown = figure.text(_MARGIN, top, "", va="top", linespacing=1.2)
    width = (1 - 2 * _MARGIN) * figure.get_figwidth() * figure.dpi
    for letters in range(_letters(figure.get_figwidth()), 0, -1):
        shown.set_text("\n".join(chain.from_iterable(lines(text, letters) for text in texts)))
        if shown.get_window_extent().width <= width:
            break


def draw_on(axes: Any, panel: Panel, style: Style) -> None:
    """Draw a panel, with its legend inside, on a user's axes; the user's figure keeps its shape and style."""
    inches = axes.get_window_extent().width / axes.figure.dpi
    letters = _letters(inches)
    _set_axes(axes, panel, inches, _ASPECT)
    axes.set_box_aspect(None)
    if panel.is_true_to_scale:
        axes.set_aspect("equal", adjustable="box")  # with "datalim", shared axes are refused
    drawing = _drawing_on(axes, panel, style, letters)
    axes.figure.draw_without_rendering()
    keys = [*drawing.keys, *_label(axes, panel, drawing, style)]
    if keys:
        labels = [_label_of(key) for key in keys]
        axes.legend(keys, labels, handler_map=_HANDLERS, fontsize="small", framealpha=1.0)


def _drawing_on(axes: Any, panel: Panel, style: Style, letters: int) -> Drawing:
    """Draw the lines and areas of a panel; return its legend and the functions for its texts.

    `letters`: the number of letters in a line of the legend.
    """
    if panel.field is not None:
        return draw_field(axes, panel, levels_of(panel.field), style, letters)
    return _draw_curves(axes, panel, style, letters)


def _label(axes: Any, panel: Panel, drawing: Drawing, style: Style) -> list[Any]:
    """Write the texts inside axes, whose position must be final; return further keys for the legend."""
    labels = Labels(axes, style, drawing.ground)
    labels.of_marks(panel.marks)
    return drawing.label(labels)


def _label_of(key: Any) -> str:
    """Return the text of a legend's key, which may be a line on its band, or a scale."""
    return str((key[0] if isinstance(key, tuple) else key).get_label())


def _letters(inches: float) -> int:
    """Return the number of letters in a line of some width."""
    return int(0.97 * inches * 72 / (LETTER_WIDTH * LETTER_SIZE))


def _lay_out(figure: Figure, every: Sequence[Any], keys: Sequence[Sequence[Any]]) -> list[Any]:
    """Put a legend below each of the axes, and freeze the layout, so that labels can be measured.

    Return the positions of the legends' upper left corners.
    """
    figure.draw_without_rendering()
    corners = []
    for axes, handles in zip(every, keys, strict=False):
        inner, outer = axes.get_window_extent(), axes.get_tightbbox()
        right, up = (outer.min - inner.min) / figure.dpi
        corners.append(axes.transAxes + ScaledTranslation(right, up, figure.dpi_scale_trans))
        if handles:
            _put_legend(axes, handles, corners[-1])
    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    return corners


def _put_legend(axes: Any, keys: Sequence[Any], corner: Any) -> None:
    """Put a legend below axes, in place of an earlier one. `corner`: the position of its upper left corner."""
    labels = [_label_of(key) for key in keys]
    place = {"loc": "upper left", "bbox_to_anchor": (0, 0), "bbox_transform": corner}
    legend = axes.legend(keys, labels, handler_map=_HANDLERS, **place)
    for text in legend.get_texts():
        text.set_linespacing(1.0)


@contextmanager
def settings(style: Style) -> Iterator[None]:
    """In this context, use matplotlib's defaults and the settings of these pages in place of the user's settings."""
    ours: dict[Any, Any] = {
        "font.size": LETTER_SIZE, "font.family": FONT, "mathtext.fontset": "stix",
        "axes.linewidth": 0.6, "xtick.major.width": 0.6, "ytick.major.width": 0.6, "hatch.linewidth": 0.35,
        "xtick.direction": "in", "ytick.direction": "in", "hatch.color": style.hatch,
        "xtick.major.pad": 5.0,  # avoids the lowest label of the other axis
        "legend.frameon": False, "legend.fontsize": LETTER_SIZE, "legend.labelspacing": 0.3, "legend.handlelength": 2.4,
        "legend.borderpad": 0.0, "legend.borderaxespad": 0.3, "legend.handleheight": 1.0,
        "svg.hashsalt": "jkroll", "svg.fonttype": "none", "pdf.fonttype": 42,
    }  # fmt: skip
    ours |= dict.fromkeys(("figure.facecolor", "savefig.facecolor", "axes.facecolor"), style.paper)
    ours |= dict.fromkeys(("text.color", "axes.edgecolor", "axes.labelcolor", "xtick.color", "ytick.color"), style.ink)
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(ours)
        yield


# --- Axes -------------------------------------------------------------------------------------------------------------


def _set_axes(axes: Any, panel: Panel, inches: float, aspect: float) -> None:
    """Set the shape of axes, the scale, range, ticks and title of each axis, and the marks on the edges."""
    if panel.is_true_to_scale:
        aspect = (panel.y.high - panel.y.low) / (panel.x.high - panel.x.low)
    axes.set_box_aspect(aspect)
    if not panel.has_axes:
        axes.set(xlim=(panel.x.low, panel.x.high), ylim=(panel.y.low, panel.y.high))
        axes.set_axis_off()
        return
    letters = _letters(0.77 * inches)  # in the title of an axis; tick labels and gaps take the rest of the width
    _set_axis(axes, panel.x, "x", max(2, int(inches / _TICK_WIDTHS[panel.x.is_log])), letters)
    _set_axis(axes, panel.y, "y", 9, int(1.1 * aspect * letters))
    _mark_edge(axes, "x", [(mark.x, mark.text) for mark in panel.marks if mark.y is None])
    _mark_edge(axes, "y", [(mark.y, mark.text) for mark in panel.marks if mark.x is None])


def _set_axis(axes: Any, axis: Axis, which: str, most: int, letters: int) -> None:
    """Set one axis. The title has its unit, unless the axis is logarithmic and each tick has a unit with a prefix."""
    side = getattr(axes, f"{which}axis")
    axes.set(**{f"{which}scale": "log" if axis.is_log else "linear", f"{which}lim": (axis.low, axis.high)})
    if axis.is_log:
        is_long = axis.high > 50 * axis.low
        side.set_major_locator(ticker.LogLocator(subs=(1,) if is_long else (1, 2, 5), numticks=most))
        side.set_minor_formatter(ticker.NullFormatter())
        side.set_major_formatter(lambda value, _: typeset(axis.in_words([value], _TICK_DIGITS)[0][0]))
        _, unit = axis.in_words([], _TICK_DIGITS)
    else:
        end = max(abs(axis.low), abs(axis.high))
        (number,), unit = axis.in_words([end], 15)
        scale = end / float(number)  # the size of the unit
        side.set_major_locator(ticker.MaxNLocator(min(most, 8), steps=[1, 2, 5, 10]))
        side.set_major_formatter(lambda value, _: f"{value / scale:.12g}".replace("-", "−"))
        side.set_minor_locator(ticker.AutoMinorLocator())
    title = described(axis.name, unit).replace(", ", ",\N{NO-BREAK SPACE}")  # no line breaks after a comma
    side.set_label_text("\n".join(lines(title, letters)), linespacing=1.0)


def _mark_edge(axes: Any, which: str, marks: Sequence[tuple[Any, str]]) -> None:
    """Put marks of x on the upper edge of axes, or marks of y on the right edge, as ticks with texts."""
    if not marks:
        return
    side = axes.secondary_xaxis("top") if which == "x" else axes.secondary_yaxis("right")
    look = {"rotation": 60, "rotation_mode": "anchor", "ha": "left"} if which == "x" else {}
    side.set_ticks([value for value, _ in marks], labels=[typeset(text) for _, text in marks], **look)
    side.minorticks_off()
    side.tick_params(direction="inout", length=6)


# --- Levels and curves ------------------------------------------------------------------------------------------------


def levels_of(field: Field) -> list[float]:
    """Return the values of the contours: round values within the range of a field; none if the field is flat."""
    low, high = extent(field.values)
    if is_flat(field.values):
        return []
    ticks: Any = ticker.MaxNLocator(_CONTOURS, steps=[1, 2, 5, 10])
    if field.is_log:
        ticks = ticker.LogLocator(subs=(1, 2, 5) if high < 1e3 * low else (1,), numticks=_CONTOURS)
    return [float(f"{value:.12g}") for value in ticks.tick_values(low, high) if low < value < high]


def _draw_curves(axes: Any, panel: Panel, style: Style, letters: int) -> Drawing:
    """Draw curves that differ in colour and dashes, and arrows; return their legend."""
    handles: dict[str, Any] = {}
    of_lines, of_points = dict[str, int](), dict[str, int]()  # numbers by label: equal labels look the same
    has_bands = any(curve.band is not None for curve in panel.curves)
    for curve in panel.curves:
        label = "\n".join(lines(": ".join(filter(None, (curve.text, curve.key))), letters))
        numbers = of_points if curve.has_points else of_lines
        look = line_of(curve, numbers.setdefault(label, len(numbers)), style)
        (line,) = axes.plot(curve.x, curve.y, label=label, **look)
        if curve.band is None:
            handles[label] = line
        else:
            handles[label] = _draw_band(axes, panel, curve, curve.band, label, style), line
    for arrow in panel.arrows:
        look = {"arrowstyle": _HEADS[arrow.ends], "connectionstyle": f"arc3,rad={arrow.bend}", "mutation_scale": 7}
        line = FancyArrowPatch(arrow.start, arrow.stop, shrinkA=0, shrinkB=0, color=style.ink, linewidth=0.6, **look)
        axes.add_patch(line)
        axes.text(*arrow.text_at, typeset(arrow.text), ha="center", va="center")
    keys = [*handles.values()] if len(handles) > 1 or has_bands else []
    return Drawing(keys, lambda _: [], lambda _: style.paper)


def _draw_band(axes: Any, panel: Panel, curve: Curve, band: Band, label: str, style: Style) -> Any:
    """Draw the band of a curve's best ranges, whose open ends extend to the frame; return its key."""
    look = {"facecolor": line_of(curve, 0, style)["color"], "linewidth": 0, "alpha": _BAND_OPACITY}
    ends = [numpy.clip(end, panel.y.low, panel.y.high) for end in (band.low, band.high)]
    axes.fill_between(curve.x, *ends, zorder=1, **look)
    return Patch(label=label, **look)


def line_of(curve: Curve, number: int, style: Style) -> dict[str, Any]:
    """Return the colour, and the dashes or marker, of a curve with a number, as matplotlib options.

    A curve of one point has a marker, as measured points have.
    """
    colour = style.lines[curve.colour % len(style.lines)]
    if curve.has_points:
        pale, marker = mixed(colour, style.paper, 0.5), MARKERS[number % len(MARKERS)]
        return {"color": pale, "linestyle": "", "marker": marker, "markersize": 3, "markeredgewidth": 0, "zorder": 1.9}
    if len(curve.x) == 1:
        return {"color": colour, "linestyle": "", "marker": MARKERS[number % len(MARKERS)], "markersize": 4}
    turn = number // len(DASHES)  # when all dashes are used, the cycle is shifted, and a colour gets other dashes
    dashes = "--" if curve.is_dashed else DASHES[(number + turn) % len(DASHES)]
    return {"color": colour, "linestyle": dashes, "linewidth": 1.1}
