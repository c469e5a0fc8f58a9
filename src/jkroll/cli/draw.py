"""Runners of `map`, `figure` and `contact --curve -o`: from words and option values to a drawing."""

import io
import sys
from collections.abc import Iterable, Sequence
from math import isnan

from ..errors import BadRequest, MissingExtra
from ..materials.library import known_materials
from ..materials.places import materials_files
from ..output.files import whole_file
from ..pictures.figures import FIGURES, figure
from ..pictures.laws import figure_laws
from ..pictures.maps import Map, rows_of
from ..pictures.panels import Picture
from ..pictures.plot_request import Context, curves_of, fixed_inputs, map_of, mark_at
from ..pictures.profiles import PANELS, PROFILES, curves_of_contact, curves_of_laws
from ..pictures.styles import STYLES
from ..quantities.nomenclature import header
from ..quantities.parsing import parse_value
from ..quantities.units import BadUnit, dimension_of
from ..scene.laws import DEFAULT_LAW
from ..text import quoted, say_wrapped
from .map_request import map_request, marks_of
from .options import Values
from .run import PICTURES, curve_request, ending, format_name, no_picture

ON_SCREEN = (241, 121)  # points of a map that is drawn in cells
IN_FILE = (201, 201)
OF_PAPER = (21, 21)  # its contours are of powers, straight on logarithmic axes: few points draw them exactly
ALONG = 1001  # points of a curve


def _check(values: Values) -> None:
    """Refuse what cannot be drawn, before anything is computed."""
    if values.style not in (None, *STYLES):
        raise BadRequest(f"--style: {quoted(values.style or '')} is not a style; there are paper and dark")
    if values.panel not in (None, *PANELS):
        raise BadRequest(f"--panel: {quoted(values.panel or '')} is not a panel; there are {', '.join(PANELS)}")
    _inches(values.width)
    if values.target is None:
        looks = {
            "--width": values.width,
            "--style": values.style,
            "--no-caption": values.uncaptioned,
        }
        if given := [flag for flag, value in looks.items() if value]:
            raise BadRequest(f"{', '.join(given)}: for a file only; name one with -o")
        return
    if ending(values.target) not in PICTURES:
        raise no_picture("-o", values.target)
    try:
        from ..pictures import page  # noqa: F401
    except ModuleNotFoundError as error:
        raise MissingExtra(error.name or "", "plot") from None


def _inches(width: str | None) -> float | None:
    """Return the width of a page in inches, None if it was not given."""
    if width is None:
        return None
    try:
        metres = parse_value(width, dimension_of("m"))
    except BadUnit as error:
        remedy = error.remedy([dimension_of("m")]) or "expected a width such as 85mm"
        raise BadRequest(f"--width: {quoted(width)} {error}; {remedy}") from None
    if not 0.07 <= metres <= 1:
        raise BadRequest(f"--width: {quoted(width)} is not between 70mm and 1m")
    return metres / 0.0254


def run_map(words: Sequence[str], values: Values) -> int:
    """Draw a quantity over one or two inputs; return the exit code."""
    _check(values)
    request = map_request(words, values)
    drawn: Map | Picture
    if request.y is None:
        drawn, notes = curves_of(request, ALONG)
    else:
        drawn, notes = map_of(request, IN_FILE if values.target else ON_SCREEN, show_progress)
    return _deliver(drawn, notes, values)


def run_figure(words: Sequence[str], values: Values) -> int:
    """Draw a figure of the paper; return the exit code."""
    _check(values)
    names = sorted({*FIGURES, *PROFILES, "laws"})
    if len(words) != 1 or words[0] not in names:
        given = f"{quoted(' '.join(words))} is not a figure with data; " if words else ""
        raise BadRequest(f"{given}there are {', '.join(names)}")
    name = words[0]
    materials = known_materials(*materials_files(values.materials))
    if name in PROFILES:
        if values.mark or values.as_printed:
            raise BadRequest(f"figure {name} takes no {'--mark' if values.mark else '--as-printed'}")
        return _deliver(PROFILES[name](materials), (), values)
    if name == "laws":
        if values.as_printed:
            raise BadRequest("figure laws takes no --as-printed")
        return _deliver(figure_laws(materials, marks_of(values.mark)), (), values)
    size = OF_PAPER if values.target else ON_SCREEN
    drawn = figure(name, materials, size, as_printed=values.as_printed)
    if values.as_printed and drawn.printed is None:
        raise BadRequest(f"figure {name} is as printed; --as-printed is for 6b")
    marks = [mark_at(text, materials, drawn.scene, drawn.x, drawn.y) for text in marks_of(values.mark)]
    return _deliver(drawn._replace(marks=(*drawn.marks, *marks)), (), values)


def run_contact(words: Sequence[str], values: Values) -> int:
    """Draw the curves of a contact; return the exit code."""
    _check(values)
    flag = "-o" if values.target else "--panel"
    if not values.curve:
        raise BadRequest(f"{flag} draws the curve: add --curve")
    if (kind := format_name(values, sys.stdout)) not in ("table", "plain"):
        raise BadRequest(f"{flag} and --{kind} exclude each other")
    request, loads = curve_request(words, values)
    if (count := request.count // len(request.models)) > 1:
        raise BadRequest(f"{count} scenes are more than one picture of a contact")
    scenes = list(request.scenes())
    of_jkr = scenes[0].under(DEFAULT_LAW)
    context = Context("fixed_approach_moment", of_jkr, {"load": 0.0})
    held = fixed_inputs(context.inputs)
    if request.models in ([None], [DEFAULT_LAW]):
        shown = () if values.panel else ("Both branches of the force curve; pressure; moment without load.",)
        return _deliver(curves_of_contact(of_jkr, loads, (*shown, *held), values.panel), context.notes, values)
    drawn, left_out = curves_of_laws(scenes, loads, held, values.panel)
    return _deliver(drawn, (*left_out, *context.notes), values)


def _deliver(drawn: Map | Picture, notes: Iterable[str], values: Values) -> int:
    """Draw into a file and print its caption, or draw on the screen; write the numbers where they are wanted."""
    if values.data is not None:
        _write_data(drawn, values.data)
    if values.target is not None:
        from ..pictures.page import draw

        content = draw(
            drawn,
            ending(values.target),
            _inches(values.width),
            values.style or "paper",
            has_caption=not values.uncaptioned,
        )
        with whole_file(values.target) as stream:
            stream.write(content)
        if values.data != "-" and not values.quiet:
            for text in filter(None, (drawn.title, *drawn.caption)):
                say_wrapped(text, sys.stdout)
    elif values.data != "-":
        from ..pictures.terminal import draw_map, draw_picture

        if isinstance(drawn, Map):
            draw_map(drawn, sys.stdout)
        else:
            draw_picture(drawn, sys.stdout)
    sys.stdout.flush()
    for note in () if values.quiet else notes:
        say_wrapped(f"note: {note}", sys.stderr)
    return 0


def _write_data(drawn: Map | Picture, path: str) -> None:
    """Write the numbers as CSV into a file, or to stdout for "-"."""
    import csv

    if path == "-":
        csv.writer(sys.stdout, lineterminator="\n").writerows(_table(drawn))
        return
    with whole_file(path) as stream, io.TextIOWrapper(stream, encoding="utf-8", newline="") as text:
        csv.writer(text, lineterminator="\n").writerows(_table(drawn))


def _table(drawn: Map | Picture) -> Iterable[Sequence[str | float]]:
    """Iterate over the rows with a header. An empty line separates panels; a cell without a value is empty."""
    if isinstance(drawn, Map):
        yield [header(drawn.x.name), header(drawn.y.name), header(drawn.quantity)]
        for row in rows_of(drawn):
            yield [_cell(value) for value in row]
        return
    for number, panel in enumerate(drawn.panels):
        if number > 0:
            yield []
        yield ["curve", header(panel.x.name), header(panel.y.name)]
        for curve in panel.curves:
            for x, y in zip(curve.x.tolist(), curve.y.tolist(), strict=True):
                yield [curve.text, x, _cell(y)]


def _cell(value: float) -> str | float:
    return "" if isnan(value) else value


def show_progress(part: float) -> None:
    """Show the finished part of a long map on a terminal, and erase it at the end."""
    if sys.stderr.isatty():
        sys.stderr.write(f"\r{100 * part:3.0f} %\r" if part < 1 else "\r     \r")
        sys.stderr.flush()
