"""Writers of columns as lines of text, one for each format.

A column is a list of texts, numbers and None, or an array of numbers; an array with two axes holds several columns. A
single text, or None, is a column with this cell in every row. None and nan are empty cells.
"""

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from math import isnan
from typing import Any, BinaryIO, TextIO, cast

from ..model.estimate import NONE, WORDS
from ..model.limits import codes
from ..model.rows import DOUBT, Columns, Wanted, as_list, has_texts
from ..quantities.formatting import DIGITS, RESULT_DIGITS, Format, in_words, pretty
from ..quantities.nomenclature import INFINITY, header
from ..quantities.values import middle
from ..text import json_text, say, spelled, write_texts

Cell = str | float | None
STRIP = 256  # rows written at once: their text fits into the cache


class Lines:
    """A writer of rows as lines, with a separator between the cells."""

    has_words = True  # infinite inputs are written as words
    digits: int | None = None  # default digits of results; None for all

    def __init__(
        self,
        separator: str,
        gap: str = "",
        *,
        end: str = "\n",
        has_header: bool = True,
        is_plain: bool = False,
        has_commas: bool = False,
    ) -> None:
        """`gap`: the text of an empty cell; `is_plain`: True to leave out quotes, doubts and status.

        `has_commas`: True for decimal commas.
        """
        self.separator, self.gap, self.end = separator.encode(), gap.encode(), end.encode()
        self.has_header, self.is_plain, self.has_commas = has_header, is_plain, has_commas

    def header(self, heads: Sequence[str], before: Sequence[bytes] = ()) -> bytes:
        """Return the line of the headers, if the format has one. `before`: encoded cells that precede them."""
        if not self.has_header:
            return b"".join(before)
        return self.separator.join([*before, *map(self._text, heads)]) + self.end

    def rows(self, heads: Sequence[str], columns: Sequence[Any], before: Sequence[bytes] = ()) -> bytes:
        """Return rows as text. `before`: the encoded beginning of each row."""
        size = len(before) or max(map(length, columns), default=0)
        prefixes = self._prefixes(heads, is_begun=bool(before))
        # An array has one prefix but several headers, so there may be fewer columns than prefixes.
        columns = [
            self._texts(column, prefix, size) for column, prefix in zip(self._divided(columns), prefixes, strict=False)
        ]
        strips = []
        for start in range(0, size, STRIP):
            part = slice(start, start + STRIP)
            cells = [before[part]] if before else []
            cells += [self._cells(column, prefix, part) for column, prefix in zip(columns, prefixes, strict=False)]
            width = len(cells) + 1  # pieces of a row: its cells and its end
            pieces = [self.end] * (width * len(cells[0]))
            for number, column in enumerate(cells):
                pieces[number::width] = column
            strips.append(b"".join(pieces))
        return b"".join(strips)

    @contextmanager
    def sink(self, stream: BinaryIO, header: bytes) -> Iterator[Callable[[bytes], object]]:
        """Write the header, and yield the function that writes rows."""
        stream.write(header)
        yield stream.write

    def _divided(self, columns: Sequence[Any]) -> Sequence[Any]:
        """Return the columns to write one after another; an array with several columns stays whole."""
        return columns

    def _prefixes(self, heads: Sequence[str], *, is_begun: bool) -> list[bytes]:
        """Return the prefix of the cells of each column. `is_begun`: True if rows have a given beginning."""
        prefixes = [self.separator] * len(heads)
        if prefixes and not is_begun:
            prefixes[0] = b""
        return prefixes

    def _texts(self, column: Any, prefix: bytes, size: int) -> Any:
        """Return the cells of a list, or of a single text, with their prefix; an array is returned unchanged."""
        if column is None or isinstance(column, str):
            return [prefix + self._cell(column)] * size
        if isinstance(column, list):
            cells = {value: prefix + self._cell(value) for value in {*column}}
            return [*map(cells.__getitem__, column)]
        return column

    def _cells(self, column: Any, prefix: bytes, part: slice) -> list[bytes]:
        """Return the cells of a part of a column with their prefix; the cells of a row of an array are one text."""
        if isinstance(column, list):
            return column[part]
        rows = numbers_in_lines(column[..., part], self.separator, self.gap)
        if self.has_commas:
            rows = [row.replace(b".", b",") for row in rows]
        return rows if prefix == self.separator else [prefix + row[len(self.separator) :] for row in rows]

    def _cell(self, value: str | float | None) -> bytes:
        if value is None:
            return self.gap
        if not isinstance(value, float):
            return self._text(str(value))
        return self.gap if isnan(value) else self._number(value + 0.0)

    def _number(self, value: float) -> bytes:
        """Return the text of a finite number."""
        return spelled(value).encode()

    def _text(self, text: str) -> bytes:
        """Return a text, in quotes if needed."""
        if not self.is_plain:
            text = in_quotes(text, self.separator.decode())
        return text.encode()


class Objects(Lines):
    """A writer of rows as JSON objects, one on each line."""

    def __init__(self) -> None:
        super().__init__(",", "null", end="}\n", has_header=False)

    def _divided(self, columns: Sequence[Any]) -> Sequence[Any]:
        return divided(columns)

    def _prefixes(self, heads: Sequence[str], *, is_begun: bool) -> list[bytes]:
        """Return the names of the members as prefixes. A given beginning ends with a comma if it has members."""
        first, *others = [self._text(head) + b":" for head in heads]
        if not is_begun:
            first = b"{" + first
        return [first, *(b"," + name for name in others)]

    def _text(self, text: str) -> bytes:
        from json.encoder import encode_basestring

        return encode_basestring(text).encode()


class Markdown(Lines):
    """A writer of rows as a table of GitHub's Markdown, with rounded numbers aligned right."""

    digits = RESULT_DIGITS

    def __init__(self, are_right: Sequence[bool] = (), *, has_commas: bool = False) -> None:
        """`are_right`: True to align a column right, for each of the first columns; for others the header decides."""
        super().__init__(" | ", end=" |\n", has_commas=has_commas)
        self.are_right = are_right

    def header(self, heads: Sequence[str], before: Sequence[bytes] = ()) -> bytes:
        """Return the line of the headers, and the line below, which aligns the columns."""
        others = heads if before else heads[len(self.are_right) :]
        are_right = [*self.are_right, *(not has_texts(head) for head in others)]
        rule = b"".join(b"|---:" if is_right else b"|---" for is_right in are_right)
        line = super().header(heads, before) + rule + b"|\n"
        return line if before else b"| " + line

    def _prefixes(self, heads: Sequence[str], *, is_begun: bool) -> list[bytes]:
        """Return the prefix of the cells of each column."""
        first, *others = super()._prefixes(heads, is_begun=is_begun)
        return [first or b"| ", *others]

    def _number(self, value: float) -> bytes:
        """Return the text of a number; an integer has no decimal point."""
        number = super()._number(value).removesuffix(b".0")
        return number.replace(b".", b",") if self.has_commas else number

    def _text(self, text: str) -> bytes:
        return in_markdown(text).encode()


class Lists:
    """A writer of rows as columns of Python: arrays of numbers, and lists of texts."""

    digits = None
    has_words, is_plain = False, False

    def header(self, heads: Sequence[str]) -> Sequence[str]:
        """Return the headers."""
        return heads

    def rows(self, _: Sequence[str], columns: Sequence[Any], before: Sequence[Any] = ()) -> list[Any]:
        """Return the columns, each with a cell for every row. `before`: one value a row; only their number counts."""
        size = len(before) or max(map(length, columns), default=0)
        lists = []
        for column in divided(columns):
            is_same = column is None or isinstance(column, str)
            lists.append([column] * size if is_same else column)
        return lists


WRITERS = {
    "csv": Lines(","),
    "tsv": Lines("\t"),
    "md": Markdown(),
    "plain": Lines("\t", "-", is_plain=True),
    "bare": Lines("\t", "-", has_header=False, is_plain=True),
    "ndjson": Objects(),
}


def in_quotes(cell: str, separator: str) -> str:
    """Return a cell for a line, in quotes if it has a quote, the separator or a line break."""
    if any(mark in cell for mark in (separator, '"', "\n", "\r")):
        return '"' + cell.replace('"', '""') + '"'
    return cell


def in_markdown(text: str) -> str:
    r"""Return a text as one line that Markdown shows unchanged, even in a cell of a table.

    >>> in_markdown("a|b *c*\nP_c [nN] _d_")
    'a\\|b \\*c\\* P_c [nN] \\_d\\_'
    """
    one_line = re.sub(r"\r\n|\r|\n", " ", text)
    return re.sub(r"[\\|`*<&~$]|\](?=\()|(?<![^\W_])_|_(?![^\W_])", r"\\\g<0>", one_line)


def in_row(cells: Iterable[str]) -> str:
    """Return the beginning of a row of a Markdown table, with texts as cells."""
    return "| " + " | ".join(map(in_markdown, cells))


def numbers_in_lines(columns: Any, separator: bytes, gap: bytes) -> list[bytes]:
    """Return a text for each row: its numbers, with a separator before each, and gaps for nan.

    `columns`: an array with one column or several.
    """
    import numpy
    import orjson

    rows = numpy.atleast_2d(columns).T
    text = orjson.dumps(numpy.ascontiguousarray(rows) + 0.0, option=orjson.OPT_SERIALIZE_NUMPY)
    if gap != b"null" and b"n" in text:
        text = text.replace(b"null", gap)
    text = b"," + text.replace(b"[", b"")  # [[1,2],[3,4]] becomes ,1,2],3,4]], which is split fast at each ]
    if separator != b",":
        text = text.replace(b",", separator)
    return text.split(b"]")[: len(rows)]


def divided(columns: Sequence[Any]) -> list[Any]:
    """Return the columns one by one, including each column of an array with several."""
    single: list[Any] = []
    for column in columns:
        if getattr(column, "ndim", 1) > 1:
            single.extend(column)
        else:
            single.append(column)
    return single


def length(column: Any) -> int:
    """Return the number of rows of a list or an array; 0 for a single text or None, which suits any number."""
    if column is None or isinstance(column, str):
        return 0
    return len(column) if isinstance(column, list) else int(column.shape[-1])


# --- Rows of frames ---------------------------------------------------------------------------------------------------


def written(
    writer: Any, wanted: Wanted, blocks: Iterable[Columns], form: Format, *, doubt: bool = True
) -> Iterator[Any]:
    """Iterate over the header, if the format has one, and the rows of each block.

    `doubt`: True for a column of doubts, if doubts are judged.
    """
    last_keys = () if writer.is_plain else wanted.last_keys(doubt=doubt)
    heads = [*map(header, wanted.inputs), *wanted.heads(form.header), *last_keys]
    of_results = Format(form.units, form.digits or writer.digits)
    yield writer.header(heads)
    for columns in blocks:
        inputs = []
        for name, column in zip(wanted.inputs, columns.inputs.values(), strict=True):
            inputs.append(_input_column(name, column, writer, form))
        yield writer.rows(heads, [*inputs, *result_columns(columns, of_results, last_keys)])


def _input_column(name: str, column: Any, writer: Any, form: Format) -> Any:
    """Return the column of an input without uncertainties, in the words and digits of a writer."""
    if isinstance(column, list):
        column = [*map(middle, column)]
    if writer.has_words and (isinstance(column, list) or (abs(column) == INFINITY).any()):
        column = [in_words(name, value) for value in as_list(column)]
    return _rounded(column, form.digits or DIGITS) if writer.digits else column


def _rounded(column: Any, digits: int) -> list[Cell]:
    """Return a column of numbers and words, the numbers rounded to some significant digits."""
    return [float(f"{cell:.{digits}g}") if isinstance(cell, float) else cell for cell in as_list(column)]


def result_columns(columns: Columns, form: Format, last_keys: Sequence[str]) -> list[Any]:
    """Return the columns of results in a format, then those of codes and reasons."""
    texts = [_codes(columns) if name == DOUBT else columns.status for name in last_keys]
    if columns.few or columns.wanted.best or any(map(form.changes, columns.wanted.names)):
        return [*_formatted(columns, form), *texts]
    return [columns.numbers, *texts]


def _codes(columns: Columns) -> list[str | None]:
    """Return the codes of the doubts of each row as a text; None for a row without doubts."""
    if columns.few:
        return [codes(bits) or None for bits in columns.doubts]
    import numpy

    distinct, positions, _ = columns.distinct_doubts
    texts = numpy.array([codes(bits) or None for bits in distinct.tolist()], dtype=object)
    return cast(list[str | None], texts[positions].tolist())


def _formatted(columns: Columns, form: Format) -> Iterator[Any]:
    """Iterate over the columns of results, in the units and with the digits of a format."""
    for name in columns.wanted.names:
        for key in columns.wanted.keys_of(name):
            column = columns.column(key)
            if has_texts(key):
                column = [WORDS[int(by)] if by > NONE else None for by in as_list(column)]
            elif form.changes(name):
                column = [value if isnan(value) else form.number(name, value) for value in as_list(column)]
            yield column


# --- Records ----------------------------------------------------------------------------------------------------------


def write_records(heads: Sequence[str], records: Iterable[Sequence[Cell]], output: str, out: TextIO) -> None:
    """Write records in a format: "table", "plain", "csv", "md" or "json".

    An empty cell is None, written as "—", "-", nothing or null.
    """
    if output == "json":
        say(json_text([dict(zip(heads, record, strict=True)) for record in records], out), out)
    elif output == "table":
        write_texts(heads, [[*map(_text, record)] for record in records], out)
    else:
        write_columns(heads, [*map(list, zip(*records, strict=True))], output, out)


def write_columns(heads: Sequence[str], columns: Sequence[Any], output: str, out: TextIO) -> None:
    """Write columns as text in a format made of lines."""
    writer = WRITERS[output]
    if writer.digits:
        columns = [_rounded(column, DIGITS) for column in columns]
        writer = Markdown([{*map(type, column)} - {type(None)} == {float} for column in columns])
    text = writer.header(heads)
    if columns:
        text += writer.rows(heads, columns)
    out.write(text.decode())


def _text(cell: Cell) -> str:
    """Return a cell as text for a reader."""
    if cell is None:
        return "—"
    return pretty(spelled(cell) if isinstance(cell, float) else str(cell))
