"""Draw maps and curves on a pair of matplotlib's axes, and place texts inside them.

Both axes run from 0 to 1, so that contours of powers are straight. Captions and labels are written once, in plain text
("P_c = 3πγR"), and drawn in a terminal as they are. On a page, the words of them that consist of symbols of the
nomenclature are set in italics with subscripts and superscripts.
"""

import re
from collections.abc import Iterator, Sequence
from functools import cache
from itertools import pairwise
from math import hypot
from textwrap import wrap
from typing import Any

from matplotlib.patheffects import withStroke  # type: ignore[import-not-found,unused-ignore]
from matplotlib.transforms import Bbox  # type: ignore[import-not-found,unused-ignore]

from ..quantities.nomenclature import NOMENCLATURE
from ..text import NO_BREAK_SPACE, with_units_joined
from .axes import Axis
from .maps import NEIGHBOURS, Curve, Map, Mark, Panel, Region, shifted
from .styles import DASHES, LETTER, LOOKS, SIZE, Look, Style

# --- Axes -------------------------------------------------------------------------------------------------------------

CONTOURS, PRINTED = "contours", "printed"  # artists that get labels, by their gid


def draw_map(axes: Any, drawn: Map, inches: float, aspect: float, style: Style) -> None:
    """Draw bands, contours, regions and what is marked on the edges; texts inside the map follow in `label_map`."""
    import numpy

    mesh = drawn.mesh()
    scale = numpy.ma.log10 if drawn.is_log else numpy.ma.asarray
    heights = [float(scale(level.value)) for level in drawn.levels()]
    values = scale(numpy.ma.masked_invalid(mesh.values))
    ends = [values.min() - 1, values.max() + 1]
    colours = [style.band(place / max(1, len(heights))) for place in range(len(heights) + 1)]
    axes.contourf(mesh.x, mesh.y, values, levels=[ends[0], *heights, ends[1]], colors=colours)
    edge = None
    if drawn.has_gaps:
        outline = axes.contourf(mesh.x, mesh.y, values, levels=ends, colors="none")
        edge = outline.get_paths()[0]
        _draw_edge(axes, edge, style)
    contours = [(values, CONTOURS, 0.7, "solid")]
    if drawn.printed is not None:
        contours.append((scale(drawn.printed), PRINTED, 0.6, "dashed"))
    if heights:
        for field, gid, width, dashes in contours:
            look = {"colors": style.ink, "linewidths": width, "linestyles": dashes}
            axes.contour(mesh.x, mesh.y, field, levels=heights, **look).set_gid(gid)
    for region in drawn.regions:
        if region.look is not None:
            _draw_region(axes, region, LOOKS[region.look], style, edge)
    for value, _ in drawn.guides:
        axes.axhline(drawn.y.place(value), color=style.ink, linewidth=0.6, linestyle=(0, (1, 2)))
    for mark in (*(Mark(text, None, value) for value, text in drawn.guides), *drawn.marks):
        _draw_tick(axes, drawn.x, drawn.y, mark, style)
    _set_axes(axes, drawn.x, drawn.y, inches, aspect)


def draw_panel(axes: Any, panel: Panel, inches: float, aspect: float, style: Style) -> None:
    """Draw curves, which differ in colour and in their dashes."""
    for number, curve in enumerate(panel.curves):
        axes.plot(panel.x.place(curve.x), panel.y.place(curve.y), **line_of(curve, number, style))
    for mark in panel.points:
        _draw_tick(axes, panel.x, panel.y, mark, style)
    _set_axes(axes, panel.x, panel.y, inches, aspect)


def line_of(curve: Curve, number: int, style: Style) -> dict[str, Any]:
    """Return the look of the curve of a number, as matplotlib takes it."""
    turn = number // len(DASHES)  # after which the colours come again, with other dashes
    dashes = "--" if curve.is_dashed else DASHES[(number + turn) % len(DASHES)]
    return {"color": style.line(curve.colour), "linestyle": dashes, "linewidth": 1.1}


def _draw_edge(axes: Any, outline: Any, style: Style) -> None:
    """Draw the outline of the part with values, except along the frame."""
    import numpy

    for polygon in outline.to_polygons():
        is_on_frame = ((polygon < 1e-9) | (polygon > 1 - 1e-9)).any(axis=1)
        is_edge = ~(is_on_frame[:-1] & is_on_frame[1:])
        breaks = numpy.full(is_edge.sum(), numpy.nan)
        x, y = (numpy.column_stack([part[:-1][is_edge], part[1:][is_edge], breaks]).ravel() for part in polygon.T)
        axes.plot(x, y, color=style.ink, linewidth=0.8, solid_capstyle="round")


def _draw_region(axes: Any, region: Region, look: Look, style: Style, edge: Any) -> None:
    """Draw a region hatched or shaded, with its border, or the border alone; nothing beyond the edge of the map's values."""
    x, y = region.x.place(region.x.values()), region.y.place(region.y.values())
    margin = _grown(region.margin)
    width, dashes = look.line
    parts = [axes.contour(x, y, margin, levels=[0], colors=style.ink, linewidths=width, linestyles=dashes)]
    if not look.is_line:
        fill = (
            {"colors": "none", "hatches": [look.hatch]} if look.hatch else {"colors": [style.ink], "alpha": look.shade}
        )
        parts.append(axes.contourf(x, y, margin, levels=[float(margin.min()) - 1, 0], **fill))
    if edge is not None:
        for part in parts:
            part.set_clip_path(edge, axes.transData)


def _grown(margin: Any) -> Any:
    """Return a margin continued by one point into its gaps, so that a region reaches the edge at which it is cut."""
    import numpy

    grown = numpy.array(margin)
    for step in 2 * NEIGHBOURS:
        grown = numpy.where(numpy.isnan(grown) & shifted(~numpy.isnan(grown), step), shifted(grown, step), grown)
    return numpy.ma.masked_invalid(grown)


def _draw_tick(axes: Any, x: Axis, y: Axis, mark: Mark, style: Style) -> None:
    """Draw a mark that has a place on one axis only: a tick on the upper or the right edge, with its text."""
    if mark.x is not None and mark.y is None:
        at = float(x.place(mark.x)), 1.0
        axes.plot(*at, "|", markersize=6, color=style.ink, clip_on=False)
        look: dict[str, Any] = {"xytext": (0, 4), "rotation": 60, "rotation_mode": "anchor"}
    elif mark.y is not None and mark.x is None:
        at = 1.0, float(y.place(mark.y))
        axes.plot(*at, "_", markersize=6, color=style.ink, clip_on=False)
        look = {"xytext": (5, 0), "va": "center"}
    else:
        return
    axes.annotate(typeset(mark.text), at, textcoords="offset points", **look)


def _set_axes(axes: Any, x: Axis, y: Axis, inches: float, aspect: float) -> None:
    """Set limits, and as many ticks and as long titles as there is room for."""
    across = max(2, int(inches / 0.5))
    for axis, side, most, part in ((x, axes.xaxis, across, 0.8), (y, axes.yaxis, 9, 0.65 * aspect)):
        ticks = axis.ticks(most)
        side.set_ticks([float(axis.place(tick.value)) for tick in ticks], labels=[typeset(tick.text) for tick in ticks])
        side.set_ticks([float(axis.place(value)) for value in axis.small_ticks(most)], minor=True)
        side.set_label_text(
            "\n".join(typeset_lines(axis.label(most), int(part * inches * 72 / (LETTER * SIZE)))), linespacing=1.0
        )
    axes.tick_params(which="both", direction="in", top=False, right=False)
    axes.set(xlim=(0, 1), ylim=(0, 1))


# --- Mathematics ------------------------------------------------------------------------------------------------------

_ATOM = r"[A-Za-zΑ-Ωα-ω](?:_[A-Za-z]+|_[α-ω]|_?\d)?\*?"  # a letter with its subscript: P_c, R1, δ_α, E*
_MORE_ATOMS = ("π", "C", "â", "p", "y")  # occur in texts, but are no quantities
_SUPERSCRIPTS = "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"
_PLAIN_DIGITS = str.maketrans(_SUPERSCRIPTS, "-0123456789")
_OPERATORS = frozenset("=<>+−-")
_UNITS = frozenset("mNJs")  # of one letter
_MARKUP = {
    "log₁₀": r"\mathrm{log}_{10}",
    "â": r"\hat{a}",
    "·": r"{\cdot}",
    "⟨": r"\langle ",
    "⟩": r"\rangle ",
    "−": "-",
    "π": r"\mathrm{π}",
}
_WORD = re.compile(r"(?P<before>[(\[]*)(?P<core>.*?)(?P<after>[.,:;)\]]*)")
_NUMBER = re.compile(rf"[-−]?\d[\d.·e{_SUPERSCRIPTS}-]*")
_FLOAT = re.compile(r"([-−]?[\d.]+)e([-+]\d+)")


def typeset(text: str) -> str:
    r"""Return a text with its symbols in mathtext and with true minus signs.

    >>> typeset("P_c at R1²/ξ = -5 N")
    '$P_{\\mathrm{c}}$ at $R_{1}^{2}/ξ$ = −5 N'
    """
    return " ".join(_typeset_words(text.split(" ")))


def typeset_lines(text: str, width: int) -> list[str]:
    """Return a text as lines of at most `width` characters, typeset.

    Lines are broken before typesetting, because markup is longer than what it shows; none between a number and its
    unit, or its symbol: "P = 0 N" stays together.
    """
    unbroken = re.sub(
        r" (?=−)|(?<=−) | (?=\[)| (?=[=<>] [-−\d])|(?<= [=<>]) (?=[-−\d])", NO_BREAK_SPACE, with_units_joined(text)
    )
    lines = [line.split() for line in wrap(unbroken, width, break_long_words=False, break_on_hyphens=False)]
    words = iter(_typeset_words(text.split()))
    return [" ".join(next(words) for _ in line) for line in lines]


def _typeset_words(words: list[str]) -> list[str]:
    """Return the words with those typeset that are symbols, formulas or numbers."""
    typed = []
    for number, word in enumerate(words):
        before, core, after = _parts(word)
        following = words[number + 1] if number + 1 < len(words) else "["
        is_variable = len(core) == 1 and core.isalpha() and _is_variable(core, words[:number], after, following)
        typed.append(before + _typeset_core(core, is_variable=is_variable) + after)
    return typed


def _parts(word: str) -> tuple[str, str, str]:
    """Return the opening brackets, the middle and the punctuation of a word."""
    match = _WORD.fullmatch(word)
    if match is None:
        return "", word, ""
    before, core, after = match.groups()
    is_open = after.startswith(")") and core.count("(") > core.count(")")
    return (before, core + ")", after[1:]) if is_open else (before, core, after)


def _is_variable(letter: str, previous: list[str], after: str, following: str) -> bool:
    """Return True if a single letter is a variable, not an article or a unit, by the words around it."""
    is_amount = letter in _UNITS and any(_NUMBER.fullmatch(word) for word in previous[-2:])  # "5 m", "5 N m"
    is_unit = is_amount or after.startswith("]") or previous[-1:] == ["/"]
    is_in_formula = following in _OPERATORS or following == "/" or not _OPERATORS.isdisjoint(previous[-1:])
    return is_in_formula or (not is_unit and (bool(after) or following.startswith("[")))


def _typeset_core(core: str, *, is_variable: bool) -> str:
    """Return one word without its punctuation in mathtext if it is mathematics."""
    if number := _FLOAT.fullmatch(core):
        mantissa, exponent = number[1].replace("−", "-"), int(number[2])
        return rf"${mantissa}{{\cdot}}10^{{{exponent}}}$"
    tokens = _token().findall(core)
    is_mathematics = is_variable or core in _symbols() or any(map(_is_mathematics, tokens))
    if "".join(tokens) != core or not is_mathematics:
        plain = re.sub(r"(?<![\w.])-(?=[\d.])", "−", core).replace("$", r"\$")
        return re.sub(rf"[{_SUPERSCRIPTS}]+", lambda found: f"$^{{{found[0].translate(_PLAIN_DIGITS)}}}$", plain)
    return f"${''.join(map(_markup, tokens))}$"


@cache
def _symbols() -> frozenset[str]:
    """Return the symbols of quantities that are longer than a letter."""
    return frozenset(entry.symbol for entry in NOMENCLATURE.values() if not entry.is_word and len(entry.symbol) > 1)


@cache
def _token() -> re.Pattern[str]:
    """Return the pattern of a token of a formula: a power of ten, a number, a known symbol, an exponent or an operator."""
    symbols = {
        atom for entry in NOMENCLATURE.values() if not entry.is_word for atom in re.findall(_ATOM, entry.symbol)
    } | {*_MORE_ATOMS}
    known = "|".join(re.escape(symbol) for symbol in sorted(symbols, key=len, reverse=True))
    return re.compile(
        rf"log₁₀|10[{_SUPERSCRIPTS}]+|\d+(?:\.\d+)?|{known}|[{_SUPERSCRIPTS}]+|\^\([^)]*\)|[-+−/·=<>()⟨⟩√]"
    )


def _is_mathematics(token: str) -> bool:
    """Return True for a token that occurs only in mathematics: a Greek letter, a symbol with a subscript, a power of ten."""
    is_symbol = token[0].isalpha() and (len(token) > 1 or not token.isascii())
    is_power_of_ten = token.startswith("10") and token[-1] in _SUPERSCRIPTS
    return is_symbol or is_power_of_ten or token in ("⟨", "log₁₀")


def _markup(token: str) -> str:
    """Return one token in mathtext."""
    if token in _MARKUP:
        return _MARKUP[token]
    if token.startswith("^("):
        return f"^{{{token[2:-1]}}}"
    if token[-1] in _SUPERSCRIPTS:
        plain = token.rstrip(_SUPERSCRIPTS)
        return f"{plain}^{{{token[len(plain) :].translate(_PLAIN_DIGITS)}}}"
    if not token[0].isalpha():
        return token
    star = "{}^{*}" if token.endswith("*") else ""  # clear of the letter's slant, which would leave a gap
    subscript = token[1:].strip("_*")
    if len(subscript) > 1 or (subscript.isascii() and subscript.isalpha()):
        subscript = rf"\mathrm{{{subscript}}}"
    return token[0] + (f"_{{{subscript}}}" if subscript else "") + star


# --- Texts inside the axes --------------------------------------------------------------------------------------------
# The places of everything else must be final: what is free is measured in pixels.

_STEP = 1.5  # between points of lines that are to be kept free, in points of the page
_APART = 3.0  # the least distance of the texts of ticks, in points of the page
_TICK = 4.0  # points of the page inside the frame that its ticks take
_ASIDE = 20.0  # times as far as it is from its line, a label may be from the middle
# Directions from a point to its text, in the order of preference.
_DIRECTIONS = ((1, 1), (1, -1), (-1, 1), (-1, -1), (1, 0), (-1, 0), (0, 1), (0, -1))
_REACH = (4.0, 8.0, 14.0, 20.0, 30.0, 42.0)  # from a point to its text, in points of the page


def label_map(axes: Any, drawn: Map, style: Style) -> None:
    """Write the texts of contours and of marked points into a drawn map. A contour without room stays without a label."""
    lines = _lines_of(axes)
    boxes = _draw_points(axes, drawn.x, drawn.y, drawn.marks, style)
    _label_points(axes, drawn.x, drawn.y, drawn.marks, lines, boxes, style)  # which have fewer places than contours
    labels = [level.text for level in drawn.levels()]
    for gid, middle in ((CONTOURS, (0.5, 0.5)), (PRINTED, (0.75, 0.5))):
        for contours in (one for one in axes.collections if one.get_gid() == gid):
            _label_contours(axes, contours, labels, middle, lines, boxes, style)


def thin_out(axes: Any) -> None:
    """Leave out every second text of the ticks across, and again, until they do not touch."""
    labels = [label for label in axes.get_xticklabels() if label.get_text()]
    while len(labels) > 2 and any(
        first.get_window_extent().padded(_APART * axes.figure.dpi / 72).overlaps(second.get_window_extent())
        for first, second in pairwise(labels)
    ):
        for label in labels[1::2]:
            label.set_visible(False)
        labels = labels[::2]


def label_panel(axes: Any, panel: Panel, style: Style) -> None:
    """Write the texts of marked points into a drawn panel."""
    lines = _lines_of(axes)
    boxes = _draw_points(axes, panel.x, panel.y, panel.points, style)
    _label_points(axes, panel.x, panel.y, panel.points, lines, boxes, style)


def _draw_points(axes: Any, x: Axis, y: Axis, marks: Sequence[Mark], style: Style) -> list[Any]:
    """Draw a dot at each marked point; return the boxes of the dots."""
    radius = 3 * axes.figure.dpi / 72
    boxes = []
    for _, at in _points(x, y, marks):
        look = {"color": style.ink, "markeredgecolor": style.paper, "markeredgewidth": 0.6}
        axes.plot(*at, "o", zorder=4, markersize=3.5, clip_on=False, **look)  # whole on the edge, too
        boxes.append(_box(axes.transData.transform(at), radius))
    return boxes


def _points(x: Axis, y: Axis, marks: Sequence[Mark]) -> Iterator[tuple[str, tuple[float, float]]]:
    """Iterate over the marks that are points: text and place."""
    for mark in marks:
        if mark.x is not None and mark.y is not None:
            yield mark.text, (float(x.place(mark.x)), float(y.place(mark.y)))


def _label_points(
    axes: Any, x: Axis, y: Axis, marks: Sequence[Mark], lines: Any, boxes: list[Any], style: Style
) -> None:
    """Write the text of each point on the side where it covers least, with a line to the point if it stands far off, or nearer to another."""
    frame, dots = axes.get_window_extent(), [*boxes]
    places = [(right, up, reach) for reach in _REACH for right, up in _DIRECTIONS]
    for number, (label, at) in enumerate(_points(x, y, marks)):
        text = axes.annotate(typeset(label), at, xytext=(0, 0), textcoords="offset points", zorder=5)
        others = [box for box in boxes if box is not dots[number]]
        costs = []
        for place in places:
            _move(text, *place, frame)
            way = _way(axes, at, text) if place[2] > _REACH[1] else []
            crossed = sum(box.overlaps(other) for box in way for other in others)
            costs.append(_cost(text.get_window_extent(), lines, boxes, frame) + 300 * crossed)
        if min(costs) > 0:  # no free place: lines are kept off by a rim
            text.set_path_effects([withStroke(linewidth=2, foreground=style.paper)])
        best = places[costs.index(min(costs))]
        _move(text, *best, frame)
        boxes.append(text.get_window_extent())
        distances = [_distance(boxes[-1], dot) for dot in dots]
        if best[2] > _REACH[1] or min(distances) < distances[number]:
            leader = {"arrowstyle": "-", "linewidth": 0.4, "color": style.ink, "shrinkA": 2, "shrinkB": 2}
            axes.annotate("", at, xytext=text.get_position(), textcoords="offset points", arrowprops=leader)
            boxes += _way(axes, at, text)


def _way(axes: Any, at: tuple[float, float], text: Any) -> list[Any]:
    """Return boxes along the line from a point to its text."""
    point, scale = axes.transData.transform(at), axes.figure.dpi / 72
    ways = ([part * scale * along for along in text.get_position()] for part in (0.25, 0.5, 0.75))
    return [_box(point + way, scale) for way in ways]


def _move(text: Any, right: int, up: int, reach: float, frame: Any) -> None:
    """Put a text beside its point, and to the left or to the right into the frame."""
    shorter = reach * (0.7 if right and up else 1.0)
    text.set(
        position=(right * shorter, up * shorter),
        ha={1: "left", 0: "center", -1: "right"}[right],
        va={1: "bottom", 0: "center", -1: "top"}[up],
    )
    box = text.get_window_extent()
    shift = max(frame.x0 - box.x0, 0) or min(frame.x1 - box.x1, 0)
    x, y = text.get_position()
    text.set_position((x + shift * 72 / text.figure.dpi, y))


def _distance(box: Any, other: Any) -> float:
    """Return how far two boxes are apart."""
    across, up = max(other.x0 - box.x1, box.x0 - other.x1, 0), max(other.y0 - box.y1, box.y0 - other.y1, 0)
    return hypot(across, up)


def _cost(box: Any, lines: Any, boxes: Sequence[Any], frame: Any) -> float:
    """Return how much a box covers: points of lines, other boxes, and the room beyond the frame."""
    covered = _covered(box.padded(1), lines)
    is_outside = box.x0 < frame.x0 or box.x1 > frame.x1 or box.y0 < frame.y0 or box.y1 > frame.y1
    return float(covered + 1000 * sum(box.overlaps(other) for other in boxes) + 10_000 * is_outside)


def _lines_of(axes: Any) -> Any:
    """Return points along all lines that are drawn on the axes, in pixels."""
    import numpy

    paths = [(line.get_path(), line.get_transform()) for line in axes.lines]
    paths += [(path, one.get_transform()) for one in axes.collections for path in one.get_paths() if _has_line(one)]
    step = _STEP * axes.figure.dpi / 72
    parts = [_dense(vertices, step) for path, transform in paths for vertices in _segments(path, transform)]
    return numpy.concatenate([*parts, numpy.empty((0, 2))])


def _has_line(collection: Any) -> bool:
    """Return True if a collection draws lines, not areas alone."""
    return not getattr(collection, "filled", False) or len(collection.get_edgecolor()) == 1


def _segments(path: Any, transform: Any) -> list[Any]:
    """Return the connected lines of a path, in pixels."""
    import numpy

    if not len(path.vertices):
        return []
    vertices = transform.transform(path.vertices)
    starts: Any = [] if path.codes is None else numpy.flatnonzero(path.codes == path.MOVETO)[1:]
    return [part[numpy.isfinite(part).all(axis=1)] for part in numpy.split(vertices, starts)]


def _dense(vertices: Any, step: float) -> Any:
    """Return points along a line at most `step` apart."""
    import numpy

    if len(vertices) < 2:
        return numpy.empty((0, 2))
    lengths = numpy.concatenate([[0.0], numpy.cumsum(numpy.hypot(*numpy.diff(vertices, axis=0).T))])
    places = numpy.linspace(0, lengths[-1], max(2, int(lengths[-1] / step) + 1))
    return numpy.column_stack([numpy.interp(places, lengths, part) for part in vertices.T])


def _label_contours(
    axes: Any,
    contours: Any,
    labels: Sequence[str],
    middle: tuple[float, float],
    lines: Any,
    boxes: list[Any],
    style: Style,
) -> None:
    """Write each label horizontally onto its contour, at the free place nearest to the middle.

    It stands on a patch of paper, so that no hatch runs through it and its minus sign cannot be taken for the contour.
    """
    import numpy

    step = _STEP * axes.figure.dpi / 72
    parts = [
        numpy.concatenate([*(_dense(one, step) for one in _segments(path, contours.get_transform())), lines[:0]])
        for path in contours.get_paths()
    ]
    centre = axes.transData.transform(middle)
    frame, ticks = axes.get_window_extent(), _TICK * axes.figure.dpi / 72
    for number, (label, own) in enumerate(zip(labels, parts, strict=True)):
        text = _on_paper(axes, label, style)
        half = text.get_window_extent().size / 2
        places = [*_places(own, centre, half, frame.padded(-ticks)), *_places(own, centre, half, frame)]
        others = numpy.concatenate([*parts[:number], *parts[number + 1 :], lines[:0]])
        free = (
            place
            for obstacles, allowed in ((lines, own), (others, lines[:0]))  # of no line, or else of no other contour
            for place in places
            if _is_free(_box(place, half), obstacles, allowed, boxes)
        )
        if (place := next(free, None)) is None:
            text.remove()
        else:
            text.set_position(axes.transData.inverted().transform(place))
            boxes.append(_box(place, half))


def _on_paper(axes: Any, label: str, style: Style) -> Any:
    """Return a text on a patch of paper, which is placed later."""
    patch = {"boxstyle": "square,pad=0", "facecolor": style.paper, "linewidth": 0}
    return axes.text(0.5, 0.5, f" {typeset(label)} ", ha="center", va="center", zorder=3, bbox=patch)


def _places(own: Any, centre: Any, half: Any, frame: Any) -> Any:
    """Return the places at which a box on a line is within the frame, those nearest to the centre first.

    Where it must be, for the frame, the line runs through the box beside its middle.
    """
    import numpy

    inside = numpy.clip(own, frame.min + half, frame.max - half)
    on_line = (abs(own - inside) < half).all(axis=1)
    cost = numpy.hypot(*(inside - centre).T) + _ASIDE * numpy.hypot(*(inside - own).T)
    return inside[on_line][numpy.argsort(cost[on_line], kind="stable")]


def _is_free(box: Any, lines: Any, own: Any, boxes: Sequence[Any]) -> bool:
    """Return True if a box covers no text and no line but its own."""
    return not any(box.overlaps(other) for other in boxes) and _covered(box, lines) <= _covered(box, own)


def _covered(box: Any, points: Any) -> int:
    """Return how many points a box covers."""
    return int(((points > box.min) & (points < box.max)).all(axis=1).sum())


def _box(place: Any, half: Any) -> Any:
    """Return the box around a place."""
    return Bbox([place - half, place + half])
