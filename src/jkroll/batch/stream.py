"""A table whose records are lines, from a file or a pipe into another."""

from contextlib import closing
from functools import partial
from itertools import chain
from typing import NamedTuple

from ..errors import BadRequest
from . import loop
from .columns import Header, check_first
from .formats import LINES, compressor
from .lines import Converted, Converter, Head
from .output import is_done, output_to
from .settings import Order, Tally, input_format, output_format
from .single import Task
from .source import Input, Span, blocks, spans_of_lines
from .task import understood_task

HEAD = 1 << 20  # bytes in which the header is looked for


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
        names = [*self.task.said, *self.task.headers]
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
    compression = output_format(settings, form).compression
    compress = compressor(compression)
    compressor(form.compression)  # a missing library is named before anything is opened
    if settings.resume and settings.target == "-":
        raise BadRequest("--resume needs a file to go on with: -o FILE")
    with closing(Input(path)) as given:
        given.check_output(settings.target)
        if is_done(settings, given.time):
            return Tally(0, 0)
        sample = _head(given, form.kind).sample if span is not None else []  # all parts have the same columns
        texts = blocks(given.pieces(form.compression, span), LINES[form.kind].cut)
        first = next(texts, b"")
        head = LINES[form.kind].head(first)
        table, task = understood_task(head.names, sample or head.sample, order)
        for column in table.inputs:
            check_first(column, [row[column.place] for row in head.sample])
        recipe = _Recipe(form.kind, head, table, task, settings.excel_safe, compression)
        start = recipe.converter().head
        work = loop.Work(
            order.identity([given.size, given.time]),
            head.text,
            Converted(compress(start) if start else b"", 0, 0, head.text.count(b"\n"), None),
            filter(None, chain([first[len(head.text) :]], texts)),
            partial(_make_convert, recipe),
            given.size if span is None else 0,
            given.position,
        )
        with closing(output_to(settings)) as output:
            loop.run(work, output, settings)
            given.check_unchanged()
            output.finish()
    return output.tally


def spans_of(path: str, kind: str) -> list[Span]:
    """Return the parts of a table of lines; none for a small one."""
    with closing(Input(path)) as given:
        head = _head(given, kind)
        return spans_of_lines(given.file, given.size, len(head.text), LINES[kind].cut)


def _head(given: Input, kind: str) -> Head:
    """Return the beginning of a table."""
    given.file.seek(0)
    return LINES[kind].head(given.file.read(HEAD))
