"""A table in one file, or from a pipe, into another; columns of rows into a file."""

from collections.abc import Iterable
from contextlib import closing
from functools import partial
from itertools import chain

from ..errors import missing_extra
from ..output.records import lines
from ..quantities.formatting import Format
from ..rows.columns import Columns, Wanted
from .delimited import DELIMITED, Delimited
from .files import (
    LINES,
    FileFormat,
    Input,
    blocks,
    compressor,
    format_of_name,
    input_format,
    output_format,
    output_to,
    unnamed,
)
from .job import Job, said_of
from .lines import BOM, Converted, Tally
from .ndjson import NdjsonConverter
from .run import Convert, Work, run


def convert_one(path: str, job: Job) -> Tally:
    """Convert a table of any format."""
    form = input_format(path, job.settings)
    compression = output_format(job.settings, form).compression
    if form.kind == "parquet":
        with missing_extra("parquet"):
            from .parquet import convert_parquet
        return convert_parquet(path, job)
    return _convert_lines(path, form, compression, job)


def _convert_lines(path: str, form: FileFormat, compression: str, job: Job) -> Tally:
    """Convert a table whose records are lines."""
    settings = job.settings
    compressor(form.compression)  # a missing library is named before anything is opened
    with closing(Input(path)) as given:
        given.check_output(settings.target)
        dialect = DELIMITED[settings.delimiter] if settings.delimiter else LINES[form.kind]
        texts = blocks(given.pieces(form.compression), dialect.cut)
        first = next(texts, b"")
        mark = BOM if first.startswith(BOM) else b""
        body, preamble = dialect.without_preamble(first.removeprefix(mark), job.reads)
        first = mark + dialect.prepared(body)
        head, rows = dialect.head(first, job.reads)
        table = job.table(head.names, rows, preamble)
        converter = dialect.converter(head, table, strict=settings.strict, excel_safe=settings.excel_safe)
        start = compressor(compression)(converter.header_line) if converter.header_line else b""
        tally = run(
            Work(
                header_line=start,
                lines_of_header=preamble + head.text.count(b"\n"),
                blocks=filter(None, chain([first[len(head.text) :]], texts)),
                make_convert=partial(_make_convert, converter, compression),
                size=given.size,
                position=given.position,
            ),
            settings,
        )
        return tally._replace(said=said_of(table))


def _make_convert(converter: Delimited | NdjsonConverter, compression: str) -> Convert:
    compress = compressor(compression)

    def convert(text: bytes) -> Converted:
        converted = converter.convert(text)
        return converted._replace(output=compress(converted.output))

    return convert


def write_columns(
    wanted: Wanted, blocks: Iterable[Columns], units: Format, target: str, *, doubt: bool, quiet: bool
) -> None:
    """Write columns to a file in the format that its name says. Raises BadRequest for one that is not for columns."""
    form = format_of_name(target) or unnamed(target, "csv", quiet=quiet)
    if form.kind == "parquet":
        with missing_extra("parquet"):
            from .parquet import write_columns as write_parquet
        write_parquet(wanted, blocks, units, target, doubt=doubt)
        return
    compress = compressor(form.compression)
    with output_to(target) as stream:
        for text in lines(form.kind, wanted, blocks, units, doubt=doubt):
            stream.write(compress(text))
