"""Open the file of a table: read its header, and iterate over its rows in blocks."""

from collections.abc import Iterator
from itertools import chain
from typing import Any

from ..errors import BadTable, missing_extra
from .files import BOM, Delimited, FileFormat, Input, blocks
from .layouts import as_table, is_dump, with_tabs
from .ndjson import Ndjson
from .table import Asked


def opened(
    file: Input,
    form: FileFormat,
    asked: Asked,
    *,
    target: str = "",
    excel_safe: bool = False,
    as_markdown: bool = False,
) -> tuple[Any, Iterator[Any]]:
    """Return the table in a file, with its header already read, and its blocks of rows. Raises BadTable.

    `target`: the file to be written; `excel_safe`, `as_markdown`: see Delimited.
    """
    if form.name == "parquet":
        with missing_extra("parquet"):
            from .parquet import batches_of
        return batches_of(file, target, asked)
    return _of_lines(file, form, asked, excel_safe=excel_safe, as_markdown=as_markdown)


def _of_lines(
    file: Input, form: FileFormat, asked: Asked, *, excel_safe: bool, as_markdown: bool
) -> tuple[Delimited | Ndjson, Iterator[bytes]]:
    """Return a table made of lines, with its header already read, and its blocks of rows. Raises BadTable.

    `excel_safe`, `as_markdown`: see Delimited.
    """
    is_of_blanks = form.separator == " "
    if form.name == "ndjson":
        table: Delimited | Ndjson = Ndjson()
    else:
        table = Delimited(form.separator, excel_safe=excel_safe, as_markdown=as_markdown)
    stream = blocks(file.pieces(form.compression), table.cut)
    first = next(stream, b"")
    mark = BOM if first.startswith(BOM) else b""
    stream = chain([first.removeprefix(mark)], stream)
    if is_dump(first):
        if not is_of_blanks:
            raise BadTable("this is a dump of LAMMPS, with blanks between its columns; write --delimiter blank")
        stream = as_table(stream, file.path, form.compression)
    if is_of_blanks:
        stream = with_tabs(stream)
    first = next(stream)
    rows = first[table.read_header(first, asked.stated, asked.measured) :]
    if not as_markdown:
        table.header = mark + table.header
    return table, filter(None, chain([rows], stream))
