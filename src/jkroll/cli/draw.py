"""The runners of `map`, `figure` and `contact --curve -o`, and the pictures of other commands as files."""

import sys
from collections.abc import Iterable, Sequence
from typing import Any

import numpy

from ..errors import BadRequest, missing_extra
from ..model.frame import Frame
from ..model.limits import LIMITS
from ..pictures.contact_curves import PANELS, curves_of_contact
from ..pictures.figures import PAPER_MAPS, check_figure, figure_named
from ..pictures.maps import MAX_CURVES, MapRequest, axis_of, check_axes, distinction, picture_of
from ..pictures.picture import STYLES, Picture, evaluate
from ..pictures.picture_as_text import opening, say_texts, write_picture
from ..quantities.laws import DEFAULT_LAW
from ..quantities.markup import plain
from ..quantities.nomenclature import header
from ..quantities.values import QuantityError, parse_quantity
from ..report.questions import quantity_named
from ..text import ending, listed, quoted, say, say_wrapped
from ..write.output_file import text_output, whole_file
from ..write.writers import write_columns
from .call import CHOSEN, PICTURES, Call


def check_picture(call: Call, path: str | None, flag: str = "-o") -> None:
    """Raise an error, before anything is computed, if the picture of a call cannot be drawn.

    `path`: the file given with `flag`; None without a file.
    """
    inches_of(call.width)
    for option, word, known in (("style", call.style, STYLES), ("panel", call.panel, PANELS)):
        if word is not None and word not in known:
            raise BadRequest(f"--{option}: {quoted(word)} is not a {option}; choose one of {listed(known)}")
    if path is None:
        looks = {"--width": call.width, "--style": call.style, "--no-caption": call.uncaptioned}
        given = [option for option, value in looks.items() if value]
        if given:
            verb = "applies" if len(given) == 1 else "apply"
            raise BadRequest(f"{listed(given)} {verb} to files; add {flag} FILE")
        return
    if ending(path) not in PICTURES:
        raise BadRequest(f"{flag}: {quoted(path)} does not end in .svg, .pdf or .png")
    with missing_extra("plot"):
        from ..pictures import page  # noqa: F401


def inches_of(width: str | None) -> float | None:
    """Return the width of a page in inches; None if it was not given."""
    if width is None:
        return None
    try:
        metres = parse_quantity(width, "radius")
    except QuantityError as error:
        raise QuantityError("--width", width, error.mistake, error.remedy or "expected a width such as 85mm") from None
    if not 0.07 <= metres <= 1:
        raise BadRequest(f"--width: {quoted(width)} is not between 70mm and 1m")
    return metres / 0.0254


def run_map(call: Call) -> int:
    """Draw a quantity over one or two inputs; return the exit code."""
    check_picture(call, call.target)
    request = map_request(call)
    drawn, notes = picture_of(request)
    corner: dict[str, Any] = {}  # its sources stand for those of all points
    for axis in (request.x, request.y):
        if axis is not None:
            corner |= axis.inputs(axis.high)
    frames = [frame.replace(**corner) for _, frame in request.frames]
    return _deliver(_with_sources(drawn, [request.quantity], frames, call), notes, call)


def run_figure(call: Call) -> int:
    """Draw a figure of the paper; return the exit code."""
    check_picture(call, call.target)
    name, marks = call.subject, [*filter(None, call.mark.split(","))]
    options = {"--mark": call.mark, "--data": call.data, "--plain": call.plain, "--as-printed": call.as_printed}
    check_figure(name, options)
    declared = PAPER_MAPS.get(name)
    drawn = figure_named(name, call.materials, marks, as_printed=call.as_printed, is_plain=call.plain)
    if declared is None:
        return _deliver(_with_sources(drawn, (), (), call), (), call)
    # A point of the figure; its sources stand for those of all points.
    point = {**declared.given, **declared.x.inputs(declared.x.high), "radius": 1e-7}
    return _deliver(_with_sources(drawn, [declared.quantity], [Frame(point)], call), (), call)


def _with_sources(drawn: Picture, names: Sequence[str], frames: Iterable[Frame], call: Call) -> Picture:
    """Return a picture; with --cite its caption ends with the sources."""
    if not call.cite:
        return drawn
    from ..report.questions import Question
    from ..report.report import Report
    from ..write.sources import citations_in_words

    question = Question(tuple(names), tuple(names))
    answers = [Report(question, frame) for frame in frames]
    return drawn._replace(doubts=(*drawn.doubts, citations_in_words(answers)))


def draw_contact(call: Call) -> int:
    """Draw the curves of a contact; return the exit code."""
    check_picture(call, call.target)
    flag = "-o" if call.target else "--panel"
    if not call.curve:
        raise BadRequest(f"{flag} draws the curve: add --curve")
    _ = call.output  # raises BadRequest if the file name conflicts with the form
    for_numbers = [*(output.name for output in CHOSEN), "quantities", "to", "digits", "no_doubt"]
    for name in for_numbers:
        if name in call.given:
            raise BadRequest(f"{flag} and --{name.replace('_', '-')} exclude each other")
    count = len(call.sweep) // len(call.models)
    if count > 1:
        raise BadRequest(f"a picture shows one contact; {count} were given")
    return _deliver(*curves_of_contact([*call.sweep.frames()], call.loads, call.panel), call)


def _deliver(drawn: Picture, notes: Iterable[str], call: Call) -> int:
    """Draw into a file and print the caption, or draw on the terminal; write data if `--data` is given. Return 0."""
    if call.data is not None:
        _write_data(drawn, call.data)
    if call.target is not None:
        draw_into(call.target, drawn, call)
        if call.data != "-" and not call.quiet:
            say_texts([*opening(drawn), *drawn.doubts, *drawn.remarks], sys.stdout)
    elif call.data != "-":
        write_picture(drawn, sys.stdout)
    sys.stdout.flush()
    if not call.quiet:
        for note in notes:
            say_wrapped(f"note: {note}", sys.stderr)
    return 0


def draw_into(path: str, drawn: Picture, call: Call) -> None:
    """Draw into a file, with the width, style and caption of a call."""
    from ..pictures.page import draw

    style, has_caption = call.style or "paper", not call.uncaptioned
    content = draw(drawn, ending(path), inches_of(call.width), style, has_caption=has_caption, command=call.line)
    with whole_file(path) as stream:
        stream.write(content)


def _write_data(drawn: Picture, path: str) -> None:
    """Write the numbers as CSV into a file, or to stdout for "-", with an empty line between panels."""
    with text_output(path) as out:
        for number, panel in enumerate(drawn.panels):
            if number > 0:
                say("", out)
            heads = (panel.x.header(), panel.y.header())
            field = panel.field
            if field is not None:
                x, y = numpy.meshgrid(panel.x.values(), panel.y.values())
                values = evaluate(field.frame, field.quantity, panel.x, panel.y)
                columns = [numbers.ravel() for numbers in (x, y, values)]
                write_columns((*heads, header(field.quantity)), columns, "csv", out)
                continue
            names: list[str] = []
            for curve in panel.curves:
                names += [plain(curve.text)] * len(curve.x)
            x = numpy.concatenate([curve.x for curve in panel.curves])
            y = numpy.concatenate([curve.y for curve in panel.curves])
            write_columns(("curve", *heads), [names, x, y], "csv", out)


# --- Requests for maps ------------------------------------------------------------------------------------------------


def map_request(call: Call) -> MapRequest:
    """Return the request of a call: a quantity, axes, frames to draw, marks and limits. Raises BadRequest."""
    if not call.subject:
        raise BadRequest("map needs a quantity, such as pull_off_force")
    quantity = quantity_named(call.subject)
    if call.x is None:
        raise BadRequest("map needs an axis: --x radius=1nm:1mm")
    x = axis_of(call.x, "--x")
    y = axis_of(call.y, "--y") if call.y is not None else None
    axes = [x, y] if y is not None else [x]
    check_axes(quantity, axes, call.values, tuple(model or DEFAULT_LAW for model in call.models))
    count = len(call.sweep)
    if len(axes) > 1 and count > 1:
        raise BadRequest(f"a map shows one pair, not {count}")
    if count > MAX_CURVES:
        raise BadRequest(f"{count} pairs are more than the {MAX_CURVES} curves that can be told apart; name fewer")
    several = [name for name, text in call.values.items() if "," in text or ":" in text]
    frames = tuple((distinction(frame, several, call.models), frame) for frame in call.sweep.frames())
    limits = () if call.plain else LIMITS
    marks = [*filter(None, call.mark.split(","))]
    return MapRequest(quantity, x, y, frames, marks, call.materials, limits, has_best=not call.plain)
