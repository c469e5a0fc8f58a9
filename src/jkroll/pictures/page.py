"""Draw pictures into SVG, PDF and PNG files, for a journal's page or a dark slide.

Only this module imports matplotlib, which lays out the page. The same picture gives the same bytes: no date, ids from
the content, and nothing from the user's own matplotlib settings.
"""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from io import BytesIO
from math import ceil
from typing import Any

import matplotlib as mpl  # type: ignore[import-not-found,unused-ignore]
import numpy
from matplotlib import font_manager, ticker  # type: ignore[import-not-found,unused-ignore]
from matplotlib.colors import LinearSegmentedColormap  # type: ignore[import-not-found,unused-ignore]
from matplotlib.figure import Figure  # type: ignore[import-not-found,unused-ignore]
from matplotlib.layout_engine import ConstrainedLayoutEngine  # type: ignore[import-not-found,unused-ignore]
from matplotlib.lines import Line2D  # type: ignore[import-not-found,unused-ignore]
from matplotlib.patches import Patch  # type: ignore[import-not-found,unused-ignore]
from matplotlib.transforms import Bbox, ScaledTranslation  # type: ignore[import-not-found,unused-ignore]

from ..errors import BadRequest
from ..quantities.formatting import WITH_PREFIXES, pretty
from ..quantities.markup import lines, typeset
from ..text import quoted
from .picture import (
    STYLES,
    Axis,
    Curve,
    Field,
    Mark,
    Panel,
    Picture,
    Style,
    described,
    evaluate,
    extent,
    is_flat,
    over,
    quantity_of,
)

LETTER_SIZE = 8.6  # in points, whatever the width of the page: subscripts, 0.7 times as large, have 6
_FONT = "STIXGeneral"
_TICK_DIGITS = 6  # at most
LETTER_WIDTH = 0.42  # width of a letter over its size, on average
MARKERS = "os^Dv*"
DASHES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (8, 2)))
_CONTOURS = 12
FINE = 401  # points a side of a field, between which its lines are straight
_ONE_PANEL, _MORE_PANELS = 120 / 25.4, 180 / 25.4  # default widths in inches
_NARROWEST = 2.0  # width of a panel beside others
_ASPECT, _ASPECT_BESIDE = 0.75, 1.0  # height of axes over their width, alone in a row and beside others
_HIGHEST = 5  # height of the sheet that a page is cut from, over the width of the page, for each row
_UNDATED: dict[str, dict[str, Any]] = {"svg": {"Date": None}, "pdf": {"CreationDate": None}, "png": {}}
FORMATS = (*_UNDATED,)  # of files, by the endings of their names
_GAP = 0.04  # around the parts of a page, in inches


def draw(drawn: Picture, file_format: str, inches: float | None, style: str, *, has_caption: bool = True) -> bytes:
    """Return a picture as the content of an SVG, PDF or PNG file of a width in inches, or of the default width."""
    names = [curve.text for panel in drawn.panels for curve in panel.curves]
    names += [mark.text for panel in drawn.panels for mark in panel.marks]
    _check_letters([*names, *drawn.caption, *drawn.doubts] if has_caption else names)
    with settings(STYLES[style]):
        figure = figure_of(drawn, inches, STYLES[style], has_caption=has_caption)
        buffer = BytesIO()
        box = figure.get_tightbbox().padded(_GAP)
        page = Bbox.from_extents(0, box.y0, figure.get_figwidth(), box.y1)
        figure.savefig(buffer, format=file_format, dpi=300, metadata=_UNDATED[file_format], bbox_inches=page)
    return buffer.getvalue()


def _check_letters(texts: Iterable[str]) -> None:
    """Raise BadRequest for a letter that the font lacks, as the name of a user's material may have."""
    font = font_manager.get_font(font_manager.findfont(_FONT))
    for letter in dict.fromkeys("".join(texts)):
        if letter.isalpha() and not font.get_char_index(ord(letter)):
            raise BadRequest(f"-o: the font of pictures has no {quoted(letter)}; name the material by other letters")


def figure_of(drawn: Picture, inches: float | None, style: Style, *, has_caption: bool) -> Figure:
    """Return a picture as matplotlib's figure: title, rows of axes with their legends, caption; with paper to spare."""
    count = len(drawn.panels)
    inches = inches or (_ONE_PANEL if count == 1 else _MORE_PANELS)
    columns = min(count, max(1, int(inches / _NARROWEST)))
    rows = ceil(count / columns)
    layout = ConstrainedLayoutEngine(w_pad=_GAP, h_pad=_GAP, wspace=0, hspace=0, compress=True)
    figure = Figure(figsize=(inches, _HIGHEST * inches * rows), layout=layout)
    every = [*figure.subplots(rows, columns, squeeze=False).flat]
    for empty in every[count:]:
        empty.remove()
    letters = _letters(inches / columns - 0.4)  # of a line of a legend
    drawings = []
    for panel, axes, letter in zip(drawn.panels, every, "abcdef", strict=False):
        _set_axes(axes, panel, inches / columns, _ASPECT if columns == 1 else _ASPECT_BESIDE)
        title = f"({letter}) {panel.title}" if count > 1 else panel.title
        axes.set_title(typeset(title), loc="left" if count > 1 else "center", fontsize=LETTER_SIZE)
        if panel.field is not None:
            drawings.append(_draw_field(axes, panel, panel.field, style, letters))
        else:
            drawings.append((_draw_curves(axes, panel, style, letters), None))
    _lay_out(figure, every, [keys for keys, _ in drawings])
    if has_caption:
        box, height = figure.get_tightbbox(), figure.get_figheight()
        figure.text(0.5, (box.y1 + 2 * _GAP) / height, typeset(drawn.title), ha="center", va="bottom")
        texts = " ".join(drawn.caption), *drawn.doubts
        caption = "\n".join(line for text in texts for line in lines(text, _letters(inches)))
        figure.text(0.015, (box.y0 - 2 * _GAP) / height, caption, va="top", linespacing=1.2)
    for panel, axes, (_, contours) in zip(drawn.panels, every, drawings, strict=False):
        taken = _label_marks(axes, panel.marks, style)
        if panel.field is not None and contours is not None:
            _label_contours(axes, contours, panel.field.in_words(levels_of(panel.field))[0], taken, style)
    return figure


def draw_on(axes: Any, panel: Panel, style: Style) -> None:
    """Draw a panel on axes of a figure that is not ours, with a legend inside; the shape and the looks are theirs."""
    inches = axes.get_window_extent().width / axes.figure.dpi
    letters = _letters(inches)
    _set_axes(axes, panel, inches, _ASPECT)
    axes.set_box_aspect(None)
    if panel.field is not None:
        keys, contours = _draw_field(axes, panel, panel.field, style, letters)
    else:
        keys, contours = _draw_curves(axes, panel, style, letters), None
    axes.figure.draw_without_rendering()
    taken = _label_marks(axes, panel.marks, style)
    if panel.field is not None and contours is not None:
        _label_contours(axes, contours, panel.field.in_words(levels_of(panel.field))[0], taken, style)
    if keys:
        axes.legend(handles=keys, fontsize="small", framealpha=1.0)


def _letters(inches: float) -> int:
    """Return the number of letters of a line that fit into a width."""
    return int(0.97 * inches * 72 / (LETTER_WIDTH * LETTER_SIZE))


def _lay_out(figure: Figure, every: Sequence[Any], keys: Sequence[Sequence[Any]]) -> None:
    """Put a legend below each of the axes, and give everything its final place, at which labels can be measured."""
    figure.draw_without_rendering()
    for axes, handles in zip(every, keys, strict=False):
        if handles:
            inner, outer = axes.get_window_extent(), axes.get_tightbbox()
            right, up = (outer.min - inner.min) / figure.dpi
            corner = axes.transAxes + ScaledTranslation(right, up, figure.dpi_scale_trans)
            legend = axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(0, 0), bbox_transform=corner)
            for text in legend.get_texts():
                text.set_linespacing(1.0)
    figure.draw_without_rendering()
    figure.set_layout_engine("none")


@contextmanager
def settings(style: Style) -> Iterator[None]:
    """Use matplotlib's own settings, not the user's, with ours on top."""
    ours: dict[Any, Any] = {
        "font.size": LETTER_SIZE, "font.family": _FONT, "mathtext.fontset": "stix",
        "axes.linewidth": 0.6, "xtick.major.width": 0.6, "ytick.major.width": 0.6, "hatch.linewidth": 0.35,
        "xtick.direction": "in", "ytick.direction": "in", "hatch.color": style.hatch,
        "xtick.major.pad": 5.0,  # clear of the lowest label of the other axis
        "legend.frameon": False, "legend.fontsize": LETTER_SIZE, "legend.labelspacing": 0.3, "legend.handlelength": 2.4,
        "legend.borderpad": 0.0, "legend.borderaxespad": 0.3, "legend.handleheight": 1.0,
        "svg.hashsalt": "jkroll", "pdf.fonttype": 42,
    }  # fmt: skip
    ours |= dict.fromkeys(("figure.facecolor", "savefig.facecolor", "axes.facecolor"), style.paper)
    ours |= dict.fromkeys(("text.color", "axes.edgecolor", "axes.labelcolor", "xtick.color", "ytick.color"), style.ink)
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(ours)
        yield


# --- Axes -------------------------------------------------------------------------------------------------------------


def _set_axes(axes: Any, panel: Panel, inches: float, aspect: float) -> None:
    """Set the shape of axes, the scales, ends, ticks and titles of both, and what is marked on their edges."""
    if panel.is_true_to_scale:
        aspect = (panel.y.high - panel.y.low) / (panel.x.high - panel.x.low)
    axes.set_box_aspect(aspect)
    letters = _letters(0.77 * inches)  # of a line of a title
    _set_axis(axes, panel.x, "x", max(2, int(inches / 0.6)), letters)
    _set_axis(axes, panel.y, "y", 9, int(1.1 * aspect * letters))
    _mark_edge(axes, "x", [(mark.x, mark.text) for mark in panel.marks if mark.y is None])
    _mark_edge(axes, "y", [(mark.y, mark.text) for mark in panel.marks if mark.x is None])


def _set_axis(axes: Any, axis: Axis, which: str, most: int, letters: int) -> None:
    """Set one axis. Ticks of a logarithmic one have their units; a linear one has one unit, in its title."""
    side, unit = getattr(axes, f"{which}axis"), quantity_of(axis.name).unit.removeprefix("1")
    axes.set(**{f"{which}scale": "log" if axis.is_log else "linear", f"{which}lim": (axis.low, axis.high)})
    if axis.is_log:
        is_long = axis.high > 50 * axis.low
        side.set_major_locator(ticker.LogLocator(subs=(1,) if is_long else (1, 2, 5), numticks=most))
        side.set_minor_formatter(ticker.NullFormatter())
        if unit in WITH_PREFIXES:
            side.set_major_formatter(lambda value, _: typeset(axis.in_words([value], _TICK_DIGITS)[0][0]))
            unit = ""
    else:
        end = max(abs(axis.low), abs(axis.high))
        (number,), unit = axis.in_words([end], 15)
        scale = end / float(number)
        side.set_major_locator(ticker.MaxNLocator(min(most, 8), steps=[1, 2, 5, 10]))
        side.set_major_formatter(lambda value, _: f"{value / scale:.12g}".replace("-", "−"))
        side.set_minor_locator(ticker.AutoMinorLocator())
    title = described(axis.name, pretty(unit)).replace(", ", ",\N{NO-BREAK SPACE}")  # no line ends behind a comma
    side.set_label_text("\n".join(lines(title, letters)), linespacing=1.0)


def _mark_edge(axes: Any, which: str, marks: Sequence[tuple[Any, str]]) -> None:
    """Put ticks with texts on the upper or the right edge of axes."""
    if not marks:
        return
    side = axes.secondary_xaxis("top") if which == "x" else axes.secondary_yaxis("right")
    look = {"rotation": 60, "rotation_mode": "anchor", "ha": "left"} if which == "x" else {}
    side.set_ticks([value for value, _ in marks], labels=[typeset(text) for _, text in marks], **look)
    side.minorticks_off()
    side.tick_params(direction="inout", length=6)


# --- Fields and curves ------------------------------------------------------------------------------------------------


def _draw_field(axes: Any, panel: Panel, field: Field, style: Style, letters: int) -> tuple[list[Any], Any]:
    """Draw all of a field but the texts inside; return the keys of a legend, and the contours, if there are any."""
    x, y = (axis._replace(size=FINE) for axis in (panel.x, panel.y))
    across, up, here = x.values(), y.values(), over(field.frame, x, y)
    scale = numpy.ma.log10 if field.is_log else numpy.ma.asarray

    def scaled(quantity: str) -> Any:
        return scale(numpy.ma.masked_invalid(evaluate(field.frame, quantity, x, y)))

    values = scaled(field.quantity)
    mask = numpy.ma.getmaskarray(values)
    heights = [float(scale(level)) for level in levels_of(field)]
    colours = LinearSegmentedColormap.from_list("", style.bands)(numpy.linspace(0, 1, len(heights) + 1))
    axes.contourf(across, up, values, levels=[values.min() - 1, *heights, values.max() + 1], colors=colours)
    keys: list[Any] = []
    for region in field.regions:
        excess = numpy.ma.masked_invalid(numpy.where(mask, numpy.nan, region.excess(here)))
        axes.contour(across, up, excess, levels=[0], colors=style.ink, linewidths=0.5, linestyles="dotted")
        end = max(1.0, float(excess.max()) + 1)
        axes.contourf(across, up, excess, levels=[0, end], colors="none", hatches=[region.hatch])
        label = "\n".join(lines(region.text, letters))
        keys.append(Patch(label=label, facecolor="none", hatch=region.hatch, edgecolor=style.hatch, linewidth=0.4))
    contours = None
    if heights:
        look = {"levels": heights, "colors": style.ink}
        contours = axes.contour(across, up, values, linewidths=0.7, linestyles="solid", **look)
        if field.printed:
            axes.contour(across, up, scaled(field.printed), linewidths=0.6, linestyles="dashed", **look)
            keys.append(Line2D([], [], color=style.ink, linewidth=0.6, linestyle="dashed", label="as printed"))
    if mask.any():
        axes.contour(across, up, mask, levels=[0.5], colors=style.ink, linewidths=0.8)
        keys.append(Patch(label="no value", facecolor=style.paper, edgecolor=style.ink, linewidth=0.8))
    return keys, contours


def levels_of(field: Field) -> list[float]:
    """Return the values of the contours: round ones within the extent of a field."""
    low, high = extent(field.values)
    if is_flat(field.values):
        return []
    ticks: Any = ticker.MaxNLocator(_CONTOURS, steps=[1, 2, 5, 10])
    if field.is_log:
        ticks = ticker.LogLocator(subs=(1, 2, 5) if high < 1e3 * low else (1,), numticks=_CONTOURS)
    return [float(f"{value:.12g}") for value in ticks.tick_values(low, high) if low <= value <= high]


def _draw_curves(axes: Any, panel: Panel, style: Style, letters: int) -> list[Any]:
    """Draw curves, which differ in colour and in their dashes; return the keys of a legend."""
    handles: dict[str, Any] = {}
    numbers: dict[str, int] = {}  # curves of one label are drawn alike
    for curve in panel.curves:
        label = "\n".join(lines(curve.text, letters))
        look = line_of(curve, numbers.setdefault(label, len(numbers)), style)
        (handles[label],) = axes.plot(curve.x, curve.y, label=label, **look)
    return [*handles.values()] if len(handles) > 1 else []


def line_of(curve: Curve, number: int, style: Style) -> dict[str, Any]:
    """Return the look of the curve of a number, as matplotlib takes it. A curve of one point is a sign."""
    colour = style.lines[curve.colour % len(style.lines)]
    if len(curve.x) == 1:
        return {"color": colour, "linestyle": "", "marker": MARKERS[number % len(MARKERS)], "markersize": 4}
    turn = number // len(DASHES)  # after which the colours come again, with other dashes
    dashes = "--" if curve.is_dashed else DASHES[(number + turn) % len(DASHES)]
    return {"color": colour, "linestyle": dashes, "linewidth": 1.1}


# --- Texts inside the axes, measured in pixels ------------------------------------------------------------------------

_EDGE = 4.0  # points of the page inside the frame that its ticks take
_ASIDE = 20.0  # times as far as it is from its line, a label may be from the middle
_DOT = 3.0  # half the size of a point, in points of the page
_WAYS = ((0.7, 0.7), (0.7, -0.7), (-0.7, 0.7), (-0.7, -0.7), (1, 0), (-1, 0), (0, 1), (0, -1))  # the best first
_REACH = (7.0, 11.0, 16.0, 22.0, 30.0, 42.0, 56.0)  # from a point to its text, in points of the page


def _label_marks(axes: Any, marks: Sequence[Mark], style: Style) -> list[Any]:
    """Draw marked points with their texts at free places and lines to them; return boxes that keep other texts off."""
    scale = axes.figure.dpi / 72
    frame, drawn = axes.get_window_extent().padded(-_EDGE * scale), _points_of_lines(axes)
    points = [(mark.text, mark.x, mark.y) for mark in marks if mark.x is not None and mark.y is not None]
    taken = [_box(axes.transData.transform(place), _DOT * scale) for _, *place in points]
    steps = numpy.array([[reach * scale * numpy.array(way) for way in _WAYS] for reach in _REACH]).reshape(-1, 2)
    for label, *place in sorted(points, key=lambda point: -point[1]):  # those on the right have the least room
        text, half = _text(axes, typeset(label), zorder=5)
        dot = axes.transData.transform(place)
        middles = (dot + steps + half * numpy.sign(steps)).clip(frame.min + half, frame.max - half)
        boxes = [_box(middle, half) for middle in middles]
        free = [box for box in boxes if not any(map(box.padded(scale).overlaps, taken))] or boxes
        box = next((box for box in free if not box.padded(1).count_contains(drawn)), free[0])
        ends = axes.transData.inverted().transform([dot, dot.clip(box.min, box.max)])
        axes.plot(*ends.T, color=style.ink, linewidth=0.4, zorder=3)
        axes.plot(*place, "o", color=style.ink, markeredgecolor=style.paper, markersize=3.5, clip_on=False, zorder=4)
        _put(text, box, style)
        taken.append(box)
    return [box.padded(3 * scale) for box in taken]


def _label_contours(axes: Any, contours: Any, texts: Sequence[str], taken: list[Any], style: Style) -> None:
    """Write each label horizontally onto its contour, at the free place nearest to the middle.

    It stands on a patch of paper, so that no hatch runs through it and its minus sign cannot be taken for the contour.
    Where it must be, for the frame, the line runs through it beside its middle. A contour without room has no label.
    """
    frame, drawn = axes.get_window_extent(), _points_of_lines(axes)
    paths = [axes.transData.transform(path.vertices) for path in contours.get_paths()]
    for label, path in zip(texts, paths, strict=True):
        text, half = _text(axes, f" {typeset(label)} ", zorder=3)
        inside = path.clip(frame.min + half, frame.max - half)
        is_on_line = (abs(path - inside) < half).all(axis=1)
        cost = numpy.hypot(*(inside - (frame.min + frame.max) / 2).T) + _ASIDE * numpy.hypot(*(inside - path).T)
        boxes = [_box(place, half) for place in inside[is_on_line][cost[is_on_line].argsort(kind="stable")]]
        free = [box for box in boxes if not any(map(box.overlaps, taken))]
        for lines_off in (drawn, numpy.concatenate(paths)):  # all lines, or at least the other contours
            box = next((box for box in free if box.count_contains(lines_off) <= box.count_contains(path)), None)
            if box is not None:
                _put(text, box, style)
                taken.append(box)
                break
        else:
            text.remove()


def _text(axes: Any, label: str, zorder: int) -> tuple[Any, Any]:
    """Return a text that is to be put somewhere by its middle, and half its size."""
    text = axes.text(0.5, 0.5, label, ha="center", va="center", zorder=zorder)
    return text, text.get_window_extent().size / 2


def _put(text: Any, box: Any, style: Style) -> None:
    """Put a text into a box, on a patch of paper."""
    text.set_position(text.axes.transData.inverted().transform((box.min + box.max) / 2))
    text.set_bbox({"boxstyle": "square,pad=0", "linewidth": 0, "facecolor": style.paper})


def _points_of_lines(axes: Any) -> Any:
    """Return points along all lines on axes, in pixels. Those of contours are close to each other as they are."""
    paths = [line.get_transform().transform_path(line.get_path()) for line in axes.lines]
    points = [path.interpolated(200 // max(1, len(path.vertices)) + 1).vertices for path in paths]
    contours = (drawing for drawing in axes.collections if not getattr(drawing, "filled", False))
    points += [axes.transData.transform(path.vertices) for drawing in contours for path in drawing.get_paths()]
    return numpy.concatenate([*points, numpy.empty((0, 2))])


def _box(middle: Any, half: Any) -> Any:
    """Return the box around a place."""
    return Bbox([middle - half, middle + half])
