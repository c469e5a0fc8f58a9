"""Draw maps and curves into SVG, PDF and PNG files, for a journal's page or a dark slide.

Only this module and `page_axes` import matplotlib. The same picture gives the same bytes: no date, ids from the
content, and nothing from the user's own matplotlib settings.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from io import BytesIO
from typing import Any, NamedTuple

import matplotlib as mpl  # type: ignore[import-not-found,unused-ignore]
from matplotlib.figure import Figure  # type: ignore[import-not-found,unused-ignore]
from matplotlib.lines import Line2D  # type: ignore[import-not-found,unused-ignore]
from matplotlib.patches import Patch  # type: ignore[import-not-found,unused-ignore]

from .. import __version__
from .maps import Map, Panel, Picture
from .page_axes import draw_map, draw_panel, label_map, label_panel, line_of, thin_out, typeset, typeset_lines
from .styles import LETTER, LOOKS, SIZE, STYLES, Style

_ONE_PANEL, _MORE_PANELS = 120 / 25.4, 180 / 25.4  # default widths in inches
_NARROWEST = 2.0  # width of a panel beside others
_ASPECT, _ASPECT_BESIDE = 0.75, 1.0  # height of axes over their width, alone in a row and beside others
_GAP = 0.05  # between the parts of a page, in inches


class _Block(NamedTuple):
    """Axes and the legend below them."""

    axes: Any
    legend: Any
    aspect: float

    def margins(self) -> tuple[float, float, float, float]:
        """Return the room in inches that texts take to the left, right, bottom and top of the axes."""
        outer, inner = self.axes.get_tightbbox(), self.axes.get_window_extent()
        room = (inner.x0 - outer.x0, outer.x1 - inner.x1, inner.y0 - outer.y0, outer.y1 - inner.y1)
        left, right, bottom, top = (max(0.0, part) / self.axes.figure.dpi + _GAP / 2 for part in room)
        return left, right, bottom, top


def draw(drawn: Map | Picture, kind: str, inches: float | None, style: str, *, has_caption: bool = True) -> bytes:
    """Return a picture as the content of an SVG, PDF or PNG file of a width in inches, or of the default width."""
    with settings(STYLES[style]):
        figure = figure_of(drawn, inches, STYLES[style], has_caption=has_caption)
        buffer = BytesIO()
        figure.savefig(buffer, format=kind, dpi=300, metadata=_metadata(drawn, kind))
    return buffer.getvalue()


def figure_of(drawn: Map | Picture, inches: float | None, style: Style, *, has_caption: bool) -> Figure:
    """Return a picture as matplotlib's figure: title, rows of axes with their legends, caption."""
    panels = 1 if isinstance(drawn, Map) else len(drawn.panels)
    inches = inches or (_ONE_PANEL if panels == 1 else _MORE_PANELS)
    columns = _columns(panels, inches)
    figure = Figure(figsize=(inches, inches))
    if isinstance(drawn, Map):
        blocks = [_map_block(figure, drawn, inches, style)]
    else:
        blocks = _panel_blocks(figure, drawn.panels, inches / columns, columns, style)
    title = figure.text(0.5, 1, typeset(drawn.title) if has_caption else "", ha="center", va="top")
    caption = figure.text(0.015, 0, "", linespacing=1.2, ha="left", va="bottom")
    _fill(caption, " ".join(drawn.caption) if has_caption else "", 0.97 * inches)
    rows = [blocks[start : start + columns] for start in range(0, panels, columns)]
    _arrange(figure, inches, title, rows, caption)
    for block in blocks:
        thin_out(block.axes)
    if isinstance(drawn, Map):
        label_map(blocks[0].axes, drawn, style)
    else:
        for block, panel in zip(blocks, drawn.panels, strict=True):
            label_panel(block.axes, panel, style)
    return figure


def _columns(panels: int, inches: float) -> int:
    """Return the number of columns of panels: few stand in one row or one column, many in rows that fill no more than a page."""
    if panels > 3:
        return 3 if inches / 3 >= _NARROWEST else 2
    return panels if inches / panels >= _NARROWEST else 1


def _map_block(figure: Figure, drawn: Map, inches: float, style: Style) -> _Block:
    """Return the axes and the legend of a map."""
    axes = figure.add_axes((0.1, 0.1, 0.8, 0.8))
    draw_map(axes, drawn, inches, _ASPECT, style)
    return _Block(axes, _legend(figure, _keys_of_map(drawn, style, _letters(inches - 0.4))), _ASPECT)


def _panel_blocks(figure: Figure, panels: Sequence[Panel], inches: float, columns: int, style: Style) -> list[_Block]:
    """Return the axes and the legends of panels. The titles of several have letters."""
    blocks = []
    for panel, letter in zip(panels, "abcdef", strict=False):
        aspect = _ASPECT if columns == 1 else _ASPECT_BESIDE
        if panel.is_true_to_scale:
            aspect = (panel.y.high - panel.y.low) / (panel.x.high - panel.x.low)
        axes = figure.add_axes((0.1, 0.1, 0.8, 0.8), label=letter)
        draw_panel(axes, panel, inches, aspect, style)
        if len(panels) == 1:
            axes.set_title(typeset(panel.title))
        else:
            axes.set_title(f"({letter}) {typeset(panel.title)}", loc="left")
        keys = _keys_of_curves(panel, style, _letters(inches - 0.4)) if len(panel.curves) > 1 else []
        lines = [Patch(label=typeset(text), facecolor="none", edgecolor="none") for text in panel.keys]
        legend = _legend(figure, lines, handlelength=0.0) if lines else _legend(figure, keys)
        blocks.append(_Block(axes, legend, aspect))
    return blocks


def _legend(figure: Figure, keys: Sequence[Any], handlelength: float = 2.4) -> Any:
    """Return a legend, which is placed later; None without keys."""
    if not keys:
        return None
    legend = figure.legend(
        handles=keys, loc="upper left", frameon=False, borderpad=0.0, borderaxespad=0.0, labelspacing=0.3,
        handleheight=1.0, handlelength=handlelength,
    )  # fmt: skip
    for text in legend.get_texts():
        text.set_linespacing(1.0)
    return legend


def _arrange(figure: Figure, inches: float, title: Any, rows: Sequence[Sequence[_Block]], caption: Any) -> None:
    """Set the height of a page and the places of its parts, measured as they are drawn.

    Axes in a row have the same margins, so that they stand on one line.
    """
    figure.draw_without_rendering()
    dpi = figure.dpi
    slot = inches / max(map(len, rows))
    margins = [[max(sides) for sides in zip(*(block.margins() for block in row), strict=True)] for row in rows]
    heights = [
        max((slot - left - right) * block.aspect for block in row)
        for row, (left, right, _, _) in zip(rows, margins, strict=True)
    ]
    legends = [max(_height(block.legend, dpi) for block in row) for row in rows]
    head, foot = _height(title, dpi), _height(caption, dpi)
    total = head + foot + _GAP * (1 + len(rows))
    total += sum(bottom + top for _, _, bottom, top in margins) + sum(heights) + sum(legends)
    figure.set_size_inches(inches, total)
    title.set_y(1 - _GAP / 2 / total)
    caption.set_y(_GAP / 2 / total)
    at = total - head - _GAP
    for row, (left, right, bottom, top), height, legend in zip(rows, margins, heights, legends, strict=True):
        at -= top + height
        for place, block in enumerate(row):
            size = slot - left - right, height
            block.axes.set_position(((place * slot + left) / inches, at / total, size[0] / inches, size[1] / total))
            if block.legend is not None:
                block.legend.set_bbox_to_anchor((place / len(row) + 0.015, (at - bottom) / total))
        at -= bottom + legend + _GAP


def _height(part: Any, dpi: float) -> float:
    """Return the height of a text or legend in inches."""
    return 0.0 if part is None else float(part.get_window_extent().height / dpi)


def _fill(part: Any, text: str, inches: float) -> None:
    """Set a text in lines as long as fit into a width, measured as they are drawn."""
    letters = 5 * _letters(inches) // 4  # more than will fit
    while True:
        part.set_text("\n".join(typeset_lines(text, letters)))
        if part.get_window_extent().width <= inches * part.figure.dpi:
            return
        letters -= 1


def _letters(inches: float) -> int:
    """Return the number of letters of a legend that fit into a width."""
    return int(0.97 * inches * 72 / (LETTER * SIZE))


@contextmanager
def settings(style: Style) -> Iterator[None]:
    """Use matplotlib's own settings, not the user's, with ours on top."""
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(
            {
                "font.size": SIZE,
                "axes.titlesize": SIZE,
                "font.family": "STIXGeneral",
                "mathtext.fontset": "stix",
                "xtick.major.pad": 5.0,  # clear of the lowest label of the other axis
                "axes.linewidth": 0.6,
                "xtick.major.width": 0.6,
                "ytick.major.width": 0.6,
                "hatch.linewidth": 0.35,
                "hatch.color": style.hatch,
                "svg.hashsalt": "jkroll",
                "svg.fonttype": "path",  # looks the same where the font is missing
                "pdf.fonttype": 42,
                "figure.facecolor": style.paper,
                "savefig.facecolor": style.paper,
                "axes.facecolor": style.paper,
                "text.color": style.ink,
                "axes.edgecolor": style.ink,
                "axes.labelcolor": style.ink,
                "xtick.color": style.ink,
                "ytick.color": style.ink,
            }
        )
        yield


def _metadata(drawn: Map | Picture, kind: str) -> dict[str, Any]:
    """Return what the file says of itself, without the time at which it was made."""
    about = " ".join((*drawn.caption, *drawn.remarks))
    who = f"jkroll {__version__}, matplotlib {mpl.__version__}"
    if kind == "pdf":
        return {"Title": drawn.title, "Subject": about, "Creator": who, "CreationDate": None}
    if kind == "svg":
        return {"Title": drawn.title, "Description": about, "Creator": who, "Date": None}
    return {"Title": drawn.title, "Description": about, "Software": who}


def _keys_of_map(drawn: Map, style: Style, letters: int) -> list[Any]:
    """Return a key for each region, for the dashed contours, and for the part without a value."""
    keys: list[Any] = []
    for region in drawn.regions:
        text = "\n".join(typeset_lines(region.text, letters))
        look = LOOKS[region.look] if region.look is not None else None
        if look is None:
            keys.append(Patch(label=text, facecolor="none", edgecolor="none"))
        elif look.is_line:
            keys.append(Line2D([], [], color=style.ink, linewidth=look.line[0], linestyle=look.line[1], label=text))
        elif look.shade:
            keys.append(Patch(label=text, facecolor=style.ink, alpha=look.shade))
        else:
            keys.append(Patch(label=text, facecolor="none", hatch=look.hatch, edgecolor=style.hatch, linewidth=0.4))
    if drawn.printed is not None:
        keys.append(Line2D([], [], color=style.ink, linewidth=0.6, linestyle="dashed", label="as printed"))
    if drawn.has_gaps:
        keys.append(Patch(label="no value", facecolor=style.paper, edgecolor=style.ink, linewidth=0.8))
    return keys


def _keys_of_curves(panel: Panel, style: Style, letters: int) -> list[Any]:
    """Return a key for each curve of a panel."""
    return [
        Line2D([], [], label="\n".join(typeset_lines(curve.text, letters)), **line_of(curve, number, style))
        for number, curve in enumerate(panel.curves)
    ]
