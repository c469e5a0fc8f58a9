"""Maps and curves drawn into files, for a journal's page or a dark slide. The only module that knows matplotlib.

The same picture gives the same bytes: no date, ids from the content, and nothing from the user's own matplotlib settings.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from textwrap import wrap
from typing import Any

import matplotlib as mpl  # type: ignore[import-not-found,unused-ignore]
from matplotlib.figure import Figure  # type: ignore[import-not-found,unused-ignore]
from matplotlib.layout_engine import ConstrainedLayoutEngine  # type: ignore[import-not-found,unused-ignore]
from matplotlib.lines import Line2D  # type: ignore[import-not-found,unused-ignore]
from matplotlib.patches import Patch  # type: ignore[import-not-found,unused-ignore]

from .. import __version__
from .maps import Map
from .page_axes import HATCHES, LABEL, SHADE, SMALL, STYLES, TICK, Style, draw_map, draw_panel, line_of
from .panels import Picture

_LINE = 1.35  # height of a line of text over the size of its letters
_LETTER = 0.56  # width of a letter over its size, on average
_PANEL = 2.9  # least width of a panel in inches, beside others


def sheet(width: float, height: float, **layout: Any) -> Figure:
    """An empty figure of a size in inches, whose parts make room for each other."""
    return Figure(figsize=(width, height), layout=ConstrainedLayoutEngine(**layout))


def draw(drawn: Map | Picture, kind: str, inches: float, style: str, *, has_caption: bool = True) -> bytes:
    """A picture as the content of an SVG, PDF or PNG file of a width in inches."""
    with _settings(STYLES[style]):
        figure = figure_of(drawn, inches, STYLES[style], has_caption=has_caption)
        buffer = BytesIO()
        figure.savefig(buffer, format=kind, dpi=300, metadata=_metadata(drawn, kind))
    return buffer.getvalue()


def figure_of(drawn: Map | Picture, inches: float, style: Style, *, has_caption: bool) -> Figure:
    """A picture as matplotlib's figure: axes above, then legend and caption."""
    keys = _legend(drawn, style, _letters(inches - 0.4))
    lines = [line for text in (drawn.caption if has_caption else ()) for line in wrap(text, _letters(inches))]
    foot = (len(lines) + sum(1 + key.get_label().count("\n") for key in keys)) * SMALL * _LINE / 72
    foot += 0.1 if lines or keys else 0.02
    if isinstance(drawn, Map):
        height = 0.75 * inches + 0.35 + foot
        rows = columns = 1
    else:
        columns = max(1, min(len(drawn.panels), int(inches / _PANEL)))
        rows = -(-len(drawn.panels) // columns)
        height = rows * (0.75 * inches / columns + 0.35) + foot
    figure = sheet(inches, height, rect=(0.0, foot / height, 1.0, 1 - foot / height))
    if isinstance(drawn, Map):
        draw_map(figure.add_subplot(), drawn, inches, style)
    else:
        for place, panel in enumerate(drawn.panels, 1):
            axes = figure.add_subplot(rows, columns, place)
            draw_panel(axes, panel, inches / columns, style)
            if len(drawn.panels) > 1 and len(panel.curves) > 1:
                axes.legend(fontsize=SMALL, frameon=False, labelcolor=style.ink)
    if drawn.title:
        figure.suptitle(drawn.title, fontsize=LABEL)
    top = foot / height
    if keys:
        figure.legend(
            handles=keys, loc="upper left", bbox_to_anchor=(0.0, top), fontsize=SMALL, frameon=False, borderpad=0.2,
            labelspacing=0.2, handleheight=1.0,
        )  # fmt: skip
    if lines:
        figure.text(
            0.02, 0.03 / height, "\n".join(lines), fontsize=SMALL, linespacing=_LINE - 0.1, va="bottom", ha="left"
        )
    return figure


def _letters(inches: float) -> int:
    """How many letters of a caption a line takes."""
    return int(0.96 * inches * 72 / (_LETTER * SMALL))


@contextmanager
def _settings(style: Style) -> Iterator[None]:
    """Matplotlib's own settings, not the user's, with ours on top."""
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(
            {
                "font.size": LABEL,
                "font.family": "DejaVu Sans",
                "axes.titlesize": LABEL,
                "axes.labelsize": LABEL,
                "xtick.labelsize": TICK,
                "ytick.labelsize": TICK,
                "legend.fontsize": TICK,
                "axes.linewidth": 0.6,
                "hatch.linewidth": 0.35,
                "hatch.color": style.ink,
                "svg.hashsalt": "jkroll",
                "svg.fonttype": "none",
                "pdf.fonttype": 42,
                "figure.facecolor": style.paper,
                "savefig.facecolor": style.paper,
                "axes.facecolor": style.paper,
                **dict.fromkeys(
                    ("text.color", "axes.edgecolor", "axes.labelcolor", "xtick.color", "ytick.color"), style.ink
                ),
            }
        )
        yield


def _metadata(drawn: Map | Picture, kind: str) -> dict[str, Any]:
    """What the file says of itself; never when it was made."""
    about = " ".join(drawn.caption)
    who = f"jkroll {__version__}, matplotlib {mpl.__version__}"
    if kind == "pdf":
        return {"Title": drawn.title, "Subject": about, "Creator": who, "CreationDate": None}
    if kind == "svg":
        return {"Title": drawn.title, "Description": about, "Creator": who, "Date": None}
    return {"Title": drawn.title, "Description": about, "Software": who}


def _legend(drawn: Map | Picture, style: Style, letters: int) -> list[Any]:
    """What stands below the axes: a key for each sign, its text in lines of so many letters."""
    return _keys_of_map(drawn, style, letters) if isinstance(drawn, Map) else _keys_of_curves(drawn, letters)


def _keys_of_map(drawn: Map, style: Style, letters: int) -> list[Any]:
    """A key for each region, for the dashed contours, and for where there is no value."""
    keys: list[Any] = []
    for place, region in enumerate(drawn.regions):
        text = "\n".join(wrap(region.text, letters))
        if region.kind == "border":
            keys.append(Line2D([], [], color=style.ink, linewidth=0.9, linestyle="dashdot", label=text))
            continue
        if region.kind == "everywhere":
            keys.append(Patch(label=text, facecolor="none", edgecolor="none"))
            continue
        is_shaded = region.kind == "shaded"
        fill = {"facecolor": style.ink, "alpha": SHADE} if is_shaded else {"facecolor": "none"}
        hatch = None if is_shaded else HATCHES[place % len(HATCHES)]
        keys.append(Patch(label=text, hatch=hatch, edgecolor=style.ink, linewidth=0.4, **fill))
    if drawn.printed is not None:
        keys.append(Line2D([], [], color=style.ink, linewidth=0.6, linestyle="dashed", label="as printed"))
    if drawn.has_gaps:
        keys.append(Patch(label="blank: no value", facecolor=style.paper, edgecolor=style.ink, linewidth=0.4))
    return keys


def _keys_of_curves(drawn: Picture, letters: int) -> list[Any]:
    """A key for each curve of a single panel; several have theirs inside."""
    if len(drawn.panels) > 1 or len(drawn.panels[0].curves) == 1:
        return []
    return [
        Line2D([], [], label="\n".join(wrap(curve.text, letters)), **line_of(curve, number))
        for number, curve in enumerate(drawn.panels[0].curves)
    ]
