"""A table whose records are lines, from a file or a pipe into another."""

from contextlib import closing
from functools import partial
from typing import NamedTuple
from zlib import crc32

from ..errors import BadRequest
from ..quantities.nomenclature import header
from . import loop
from .columns import Header, check_first
from .formats import LINES, compressor
from .lines import Converted, Converter, Head
from .output import Output, OutputFile, Written, is_whole, output_to, say_whole
from .progress import watched
from .settings import Order, Tally, input_format, output_format
from .single import Task
from .source import Blocks, Cut, Input
from .spans import HEAD, Span, spans_of_lines
from .task import understood_task


class _Recipe(NamedTuple):
    """The parts of a converter, as they are handed to processes."""

    kind: str
    head: Head
    table: Header
    task: Task
    excel_safe: bool
    compression: str

    def converter(self) -> Converter:
        """Return the converter, without the compression."""
        names = [header(name) for name in self.task.quantities]
        return LINES[self.kind].converter(self.head, self.table, self.task, names, excel_safe=self.excel_safe)


def _make_convert(recipe: _Recipe) -> loop.Convert:
    converter, compress = recipe.converter(), compressor(recipe.compression)

    def convert(text: bytes) -> Converted:
        converted = converter.convert(text)
        return converted._replace(output=compress(converted.output))

    return convert


def convert(path: str, order: Order, span: Span | None = None) -> Tally:
    """Convert a table of lines, or a part of it."""
    settings = order.settings
    form = input_format(path, settings)
    compress = compressor(output_format(settings, form).compression)
    compressor(form.compression)  # a missing library is named before anything is opened
    if settings.resume and settings.target == "-":
        raise BadRequest("--resume needs a file to go on with: -o FILE")
    with closing(Input(path)) as given:
        given.check_output(settings.target)
        if settings.resume and is_whole(settings.target, given.about.st_mtime_ns if given.is_file else 0):
            say_whole(settings.target)
            return Tally(0, 0)
        blocks = Blocks(given.pieces(form.compression, span), cut_of(form.kind))
        head = LINES[form.kind].head(blocks.head())
        blocks.skip(len(head.text))
        table, task = understood_task(head.names, order)
        for column in table.inputs:
            check_first(column, [row[column.place] for row in head.sample])
        recipe = _Recipe(form.kind, head, table, task, settings.excel_safe, output_format(settings, form).compression)
        with closing(output_to(settings.target, strict=settings.strict)) as output:
            if not _goes_on(output, order, given, head, blocks):
                start = recipe.converter().head
                written = output.writer.append(compress(start)) if start else Written(0, 0)
                output.note(crc32(head.text), Converted(b"", 0, 0, head.text.count(b"\n"), None), written)
            total = given.about.st_size if given.is_file and span is None else 0
            with watched(
                total,
                lambda: (given.position(), output.done.rows),
                is_quiet=settings.quiet,
                goes_on=output.goes_on,
            ) as show:
                loop.run(blocks, partial(_make_convert, recipe), output, settings.processes, show)
            given.check_unchanged()
            output.finish()
    return Tally(output.done.rows, output.done.failed, output.done.doubtful)


def _goes_on(output: Output, order: Order, given: Input, head: Head, blocks: Blocks) -> bool:
    """Go on from an interrupted run if `--resume` asks for it and there is one; else begin."""
    if not isinstance(output, OutputFile):
        return False
    identity = order.identity(given.identity)
    if order.settings.resume and output.resume(identity, head.text, blocks):
        return True
    output.begin(identity)
    return False


def cut_of(kind: str) -> Cut:
    """Return the function that finds the end of the last whole record."""
    return lambda text, is_end: LINES[kind].cut(text, is_end=is_end)


def spans_of(path: str, kind: str) -> list[Span]:
    """Return the parts of a table of lines; none for a small one."""
    with closing(Input(path)) as given:
        head = LINES[kind].head(given.file.read(HEAD))
        return spans_of_lines(given.file, given.about.st_size, len(head.text), cut_of(kind))
