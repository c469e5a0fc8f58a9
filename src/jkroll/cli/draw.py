"""A call of `map`, `figure` or `contact --curve -o`, from what was typed to a terminal or a file."""

import io
import sys
from collections.abc import Iterable, Mapping, Sequence
from math import isnan
from typing import NamedTuple

from ..errors import BadRequest, MissingExtra
from ..materials.library import known_materials
from ..materials.places import materials_files
from ..output.files import whole_file
from ..pictures.figures import FIGURES, figure
from ..pictures.maps import Map, Setting, rows_of
from ..pictures.panels import Picture
from ..pictures.plot_request import Context, curves_of, fixed_inputs, map_of, mark_at
from ..pictures.profiles import PANELS, PROFILES, curves_of_contact
from ..pictures.styles import STYLES
from ..quantities.nomenclature import header
from ..quantities.parsing import parse_value
from ..quantities.units import BadUnit, dimension_of
from ..text import quoted, say
from .map_request import asked, marks_of
from .request import Request
from .run import PICTURES, Output, no_picture

ON_SCREEN = (241, 121)  # points of a map that is drawn in cells
IN_FILE = (201, 201)
OF_PAPER = (21, 21)  # its contours are of powers, straight on logarithmic axes: few points draw them exactly
ALONG = 1001  # points of a curve


class Target(NamedTuple):
    """Where a picture goes, and how it is to look there."""

    file: str | None = None
    width: str | None = None
    style: str | None = None
    uncaptioned: bool = False
    panel: str | None = None
    data: str | None = None

    def check(self) -> None:
        """Refuse what cannot be drawn before anything is computed, and say what is missing."""
        if self.style not in (None, *STYLES):
            raise BadRequest(f"--style: {quoted(self.style or '')} is not a style; there are paper and dark")
        if self.panel not in (None, *PANELS):
            raise BadRequest(f"--panel: {quoted(self.panel or '')} is not a panel; there are {', '.join(PANELS)}")
        self.inches()
        if self.file is None:
            given = [_flag(name) for name in ("width", "style", "panel") if self._asdict()[name]]
            if given or self.uncaptioned:
                raise BadRequest(f"{', '.join(given) or '--no-caption'}: this is of a file; name one with -o")
            return
        if self.file.rpartition(".")[2].lower() not in PICTURES:
            raise no_picture("-o", self.file)
        try:
            from ..pictures import page as drawing  # noqa: F401
        except ModuleNotFoundError as error:
            raise MissingExtra(error.name or "", "plot") from None

    def inches(self) -> float | None:
        """The width of the picture, if it was given."""
        if self.width is None:
            return None
        try:
            metres = parse_value(self.width, dimension_of("m"))
        except BadUnit as error:
            remedy = error.remedy([dimension_of("m")]) or "expected a width such as 85mm"
            raise BadRequest(f"--width: {quoted(self.width)} {error}; {remedy}") from None
        if not 0.07 <= metres <= 1:
            raise BadRequest(f"--width: {quoted(self.width)} is not between 70mm and 1m")
        return metres / 0.0254


def run_map(words: Sequence[str], options: Mapping[str, str], output: Output, target: Target) -> int:
    """Draw a quantity over one or two inputs; return the exit code."""
    target.check()
    wish = asked(words, options, materials_files(output.materials))
    drawn: Map | Picture
    if wish.y is None:
        drawn, notes = curves_of(wish, ALONG)
    else:
        drawn, notes = map_of(wish, IN_FILE if target.file else ON_SCREEN, show_progress)
    return _deliver(drawn, notes, target, is_quiet=output.quiet)


def run_figure(words: Sequence[str], options: Mapping[str, str], output: Output, target: Target) -> int:
    """Draw a figure of the paper; return the exit code."""
    target.check()
    names = sorted({*FIGURES, *PROFILES})
    if len(words) != 1 or words[0] not in names:
        given = f"{quoted(' '.join(words))} is not a figure with data; " if words else ""
        raise BadRequest(f"{given}there are {', '.join(names)}")
    name = words[0]
    materials = known_materials(*materials_files(output.materials))
    if name in PROFILES:
        if options:
            raise BadRequest(f"figure {name} takes no {', '.join(map(_flag, options))}")
        return _deliver(PROFILES[name](materials), (), target, is_quiet=output.quiet)
    size = OF_PAPER if target.file else ON_SCREEN
    drawn = figure(name, materials, size, as_printed="as_printed" in options)
    if "as_printed" in options and drawn.printed is None:
        raise BadRequest(f"figure {name} is as printed; --as-printed is for 6b")
    setting = Setting(FIGURES[name].given)
    marks = [mark_at(text, materials, setting, drawn.x, drawn.y) for text in marks_of(options)]
    return _deliver(drawn._replace(marks=(*drawn.marks, *marks)), (), target, is_quiet=output.quiet)


def _flag(name: str) -> str:
    return f"--{name.replace('_', '-')}"


def run_contact(words: Sequence[str], options: Mapping[str, str], output: Output, target: Target) -> int:
    """Draw the curves of a contact; return the exit code."""
    target.check()
    if not output.curve:
        raise BadRequest("-o draws the curve: add --curve")
    if (kind := output.format_name(sys.stdout)) not in ("table", "plain"):
        raise BadRequest(f"-o and --{kind} exclude each other")
    if {"load", "approach_at_load"} & options.keys():
        raise BadRequest("--curve goes through all loads and approaches; it takes none")
    request = Request(words, options, materials_files(output.materials))
    if request.count > 1:
        raise BadRequest(f"{request.count} scenes are more than one picture of a contact")
    scene = next(request.scenes())
    setting = Setting(scene.stated, scene.material, scene.material2)
    context = Context("fixed_approach_moment", setting, {"load": 0.0})
    shown = () if target.panel else ("Both branches of the force curve; pressure; moment without load.",)
    caption = (*shown, *fixed_inputs(context.inputs))
    return _deliver(curves_of_contact(setting, caption, target.panel), context.notes, target, is_quiet=output.quiet)


def _deliver(drawn: Map | Picture, notes: Iterable[str], target: Target, *, is_quiet: bool) -> int:
    """Draw into the file and say what is in it, or draw on the screen, and write the numbers."""
    if target.data is not None:
        _write_data(drawn, target.data)
    if target.file is not None:
        from ..pictures.page import draw

        content = draw(
            drawn,
            target.file.rpartition(".")[2].lower(),
            target.inches(),
            target.style or "paper",
            has_caption=not target.uncaptioned,
        )
        with whole_file(target.file) as stream:
            stream.write(content)
        if target.data != "-" and not is_quiet:
            for text in filter(None, (drawn.title, *drawn.caption)):
                say(text, sys.stdout)
    elif target.data != "-":
        from ..pictures.terminal import draw_map, draw_picture

        if isinstance(drawn, Map):
            draw_map(drawn, sys.stdout)
        else:
            draw_picture(drawn, sys.stdout)
    sys.stdout.flush()
    for note in () if is_quiet else notes:
        say(f"note: {note}", sys.stderr)
    return 0


def _write_data(drawn: Map | Picture, path: str) -> None:
    """The numbers as CSV, into a file or, for "-", on stdout."""
    import csv

    if path == "-":
        csv.writer(sys.stdout, lineterminator="\n").writerows(_table(drawn))
        return
    with whole_file(path) as stream, io.TextIOWrapper(stream, encoding="utf-8", newline="") as text:
        csv.writer(text, lineterminator="\n").writerows(_table(drawn))


def _table(drawn: Map | Picture) -> Iterable[Sequence[str | float]]:
    """The numbers with a header, those of several panels with an empty line between; a cell without a value is empty."""
    if isinstance(drawn, Map):
        yield [header(drawn.x.name), header(drawn.y.name), header(drawn.quantity)]
        for row in rows_of(drawn):
            yield [_cell(value) for value in row]
        return
    for number, panel in enumerate(drawn.panels):
        yield from [[]] if number else []
        yield ["curve", header(panel.x.name), header(panel.y.name)]
        for curve in panel.curves:
            for x, y in zip(curve.x.tolist(), curve.y.tolist(), strict=True):
                yield [curve.text, x, _cell(y)]


def _cell(value: float) -> str | float:
    return "" if isnan(value) else value


def show_progress(part: float) -> None:
    """How much of a long map is done, on a terminal; nothing is left of it."""
    if sys.stderr.isatty():
        sys.stderr.write(f"\r{100 * part:3.0f} %\r" if part < 1 else "\r     \r")
        sys.stderr.flush()


RUNNERS = {"map": run_map, "figure": run_figure, "contact": run_contact}
