"""A table in one file, or from a pipe, into another; columns of rows into a file."""

import os
import sys
from collections.abc import Iterable
from contextlib import closing
from functools import lru_cache, partial
from itertools import chain

from ..answers.questions import EVERYTHING, quantities_named
from ..errors import BadTable, missing_extra
from ..output.records import lines
from ..quantities.formatting import Format
from ..rows.columns import Columns, Wanted
from ..rows.header import is_input, stated_meanings, understood
from ..rows.table import Fill, Inverse, Table, say_gaps, say_reading, table_of
from ..scene.failures import MissingInput
from ..text import ending, quoted, say_wrapped
from .delimited import DELIMITED, Delimited
from .files import SPREADSHEETS, Input, blocks, output_to, unnamed
from .formats import LINES, FileFormat, compressor, format_of_name, stated, with_delimiter
from .lines import BOM, Converted, Tally, said_of
from .ndjson import NdjsonConverter
from .run import Convert, Work, run
from .settings import Job, Part, Settings


def convert_one(part: Part, job: Job) -> Tally:
    """Convert a table of any format."""
    settings = job.settings._replace(target=part.target)
    form = input_format(part.path, settings)
    compression = output_format(settings, form).compression
    if form.kind == "parquet":
        with missing_extra("parquet"):
            from .parquet import convert_parquet
        return convert_parquet(part, job, table_with)
    return _convert_lines(part, form, compression, job)


@lru_cache(maxsize=8)  # the tables of a run have the same options
def _fill(job: Job) -> Fill:
    settings = job.settings
    return Fill.of(job.inputs, job.known, Inverse(settings.infer, settings.measured) if settings.infer else None)


def _is_read(settings: Settings, name: str) -> bool:
    """Return whether a header may be that of an input, or of what options say."""
    return is_input(name, stated_meanings([name], settings.columns, settings.measured))


def table_with(names: tuple[str, ...], rows: list[list[str]], job: Job, preamble: int = 0) -> Table:
    """Return the table with this header that the job asks for; `rows`: the cells of its first rows.

    `preamble`: the number of lines before the header that are passed over.
    """
    settings = job.settings
    fill = _fill(job)
    meanings = stated_meanings(names, settings.columns, settings.measured)
    columns = understood(names, rows, meanings, job.inputs)._replace(preamble=preamble)
    asked = quantities_named(settings.quantities) if settings.quantities else ([], EVERYTHING)
    try:
        table = table_of(
            columns,
            rows,
            fill,
            asked,
            doubt=settings.doubt,
            uncertainty=settings.uncertainty,
            alternatives=settings.alternatives,
        )
    except MissingInput:
        if not settings.quiet:
            say_reading(columns)  # a column may not be understood
        raise
    if not settings.quiet:
        say_reading(columns)
        say_gaps(table, columns, settings.quantities)
        for line in said_of(table)[1:]:
            say_wrapped(line, sys.stderr)
    return table


def _convert_lines(part: Part, form: FileFormat, compression: str, job: Job) -> Tally:
    """Convert a table whose records are lines."""
    settings = job.settings._replace(target=part.target)
    compressor(form.compression)  # a missing library is named before anything is opened
    with closing(Input(part.path)) as given:
        given.check_output(part.target)
        dialect = DELIMITED[settings.delimiter] if settings.delimiter else LINES[form.kind]
        texts = blocks(given.pieces(form.compression), dialect.cut)
        first = next(texts, b"")
        mark = BOM if first.startswith(BOM) else b""
        is_read = partial(_is_read, job.settings)
        body, preamble = dialect.without_preamble(first.removeprefix(mark), is_read)
        first = mark + dialect.prepared(body)
        head, rows = dialect.head(first, is_read)
        table = table_with(head.names, rows, job, preamble)
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


def input_format(path: str, settings: Settings) -> FileFormat:
    """Return the format of the input."""
    if settings.format:
        return stated(settings.format)
    found = format_of_name(path if path != "-" else settings.target)
    if path == "-" and found is not None:
        found = FileFormat(found.kind)  # its output may be compressed
    if settings.delimiter:
        return with_delimiter(settings.delimiter, found)
    if found is not None:
        return found
    if path == "-":
        return FileFormat("csv")
    if os.path.isdir(path):
        raise BadTable(f"{quoted(path)} is a directory; name its tables, as in {quoted(os.path.join(path, '*.csv'))}")
    if ending(path) in SPREADSHEETS:
        raise BadTable(f"{quoted(path)} is a spreadsheet; save it as CSV")
    if ending(path) == "json":
        raise BadTable(f"{quoted(path)}: a JSON text is not read; write an object a line, and --format ndjson")
    raise BadTable(
        f"{quoted(path)}: its name says no format; give --format csv, tsv, ndjson or parquet, or --delimiter blank"
    )


def output_format(settings: Settings, of_input: FileFormat) -> FileFormat:
    """Return the format of the output: that of its name, else that of the input without compression."""
    found = format_of_name(settings.target)
    if found is None:
        return unnamed(settings.target, of_input.kind, quiet=settings.quiet)
    if found.kind != of_input.kind:
        name = os.path.basename(settings.target).partition(".")[0]
        raise BadTable(
            f"-o: the output has the format of the input, {of_input.kind}; write {quoted(f'{name}.{of_input.kind}')}, and convert it with another program"
        )
    return found


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
