"""A table whose records are lines, from a file or a pipe into another."""

from contextlib import closing
from functools import partial
from itertools import chain

from ..errors import BadRequest
from ..table.blocks import Tally
from . import loop, source
from .asked import task_of_table
from .delimited import Delimited
from .formats import LINES, compressor
from .lines import Converted, Head
from .ndjson import NdjsonConverter
from .output import is_done
from .settings import Order, input_format, output_format
from .source import Input, Part, Span, blocks


def _make_convert(converter: Delimited | NdjsonConverter, compression: str) -> loop.Convert:
    compress = compressor(compression)

    def convert(text: bytes) -> Converted:
        converted = converter.convert(text)
        return converted._replace(output=compress(converted.output))

    return convert


def convert(part: Part, order: Order) -> Tally:
    """Convert a table of lines, or a part of it."""
    settings = order.settings._replace(target=part.target)
    form = input_format(part.path, settings)
    compression = output_format(settings, form).compression
    compress = compressor(compression)
    compressor(form.compression)  # a missing library is named before anything is opened
    if settings.resume and settings.target == "-":
        raise BadRequest("--resume needs a file to go on with: -o FILE")
    with closing(Input(part.path)) as given:
        given.check_output(settings.target)
        if is_done(settings, given.time):
            return Tally()
        texts = blocks(given.pieces(form.compression, part.span), LINES[form.kind].cut)
        first = next(texts, b"")
        head, rows = LINES[form.kind].head(first) if part.span is None else _beginning(part.path, form.kind)
        task = task_of_table(head.names, rows, order)
        converter = LINES[form.kind].converter(head, task, excel_safe=settings.excel_safe)
        start = compress(converter.head) if converter.head else b""
        work = loop.Work(
            order.identity([given.size, given.time]),
            head.text,
            Converted(start),
            filter(None, chain([first[len(head.text) :]], texts)),
            partial(_make_convert, converter, compression),
            given.size if part.span is None else 0,
            given.position,
        )
        return loop.run(work, settings)


def _beginning(path: str, kind: str) -> tuple[Head, list[list[str]]]:
    """Return the head of a whole table, and the cells of its first rows: all of its parts have the same columns."""
    with closing(Input(path)) as given:
        return LINES[kind].head(next(blocks(given.pieces("", None), LINES[kind].cut), b""))


def spans_of(path: str, kind: str) -> list[Span]:
    """Return the parts of a table of lines; none for a small one."""
    with closing(Input(path)) as given:
        if given.size <= source.SPAN:
            return []
        texts = blocks(given.pieces("", None), LINES[kind].cut)
        first = next(texts, b"")
        size = len(LINES[kind].head(first)[0].text)
        return [*source.spans_of_lines(chain([first[size:]], texts), size)]
