"""Decimal commas: the numbers of a table that tell whether it has them, and cells with points in place of them."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, compress

from ..errors import BadTable
from ..text import quoted

_NUMERIC = re.compile(rb"\s*[-+(]?[\d.,]")  # the beginning of numbers, with an error bar or not
_MARKED = re.compile(rb"([\d.,]*)([.,])(\d+)([eE][-+]?\d+)?")  # a number with a point or a comma


def has_decimal_commas(are_read: Sequence[bool], columns: Sequence[Sequence[bytes]], *, by_all: bool) -> bool:
    """Return whether the numbers of a table have decimal commas. Raises BadTable for those that may be of thousands.

    The columns that are read decide; all columns where the marks of these may be either. If they have none, all decide
    if `by_all`, as between semicolons. Where nothing decides, points are decimal.
    """
    read, every = (
        Counter(chain.from_iterable(map(_decimal_marks, some))) for some in (compress(columns, are_read), columns)
    )
    unclear = [number.decode() for number in read if len(number) > 1]
    for marks in (read, every) if unclear or (not read and by_all) else (read,):
        if marks[b","] != marks[b"."]:
            return marks[b","] > marks[b"."]
    if number := next((number for number in unclear if "," in number or by_all), ""):
        digits = number.replace(",", "").replace(".", "")
        remedy = "write decimal points, and no marks of thousands"
        if "," not in number:
            remedy = "leave marks of thousands out, or save the table with commas between its columns"
        raise BadTable(f"{quoted(number)} may be {number.replace(',', '.')} or {digits}: {remedy}")
    return False


def _decimal_marks(cells: Sequence[bytes]) -> Iterator[bytes]:
    """Iterate over the decimal marks of the numbers of a column.

    A mark that stands in a number more than once is of thousands or of a list, and is left out. Where a mark may be of
    thousands, the number itself comes in its place.

    >>> [*_decimal_marks((b"0,125", b"1,200e3", b"1.234,5", b"1,234,567", b"1,200", b"1,2,3"))]
    [b',', b',', b',', b'1,200']
    """
    for number in _MARKED.finditer(b";".join(filter(_NUMERIC.match, cells))):
        whole, mark, fraction, power = number.groups()
        may_be_of_thousands = (
            len(fraction) == 3 and whole.isdigit() and len(whole) <= 3 and whole[:1] != b"0" and not power
        )
        if mark not in whole:
            yield number[0] if may_be_of_thousands else mark


def points_among_commas(columns: Iterable[Sequence[bytes]]) -> Iterator[tuple[int, str]]:
    """Iterate over the rows in which a number has a point, decimal or of thousands, and what is wrong with that."""
    for column in columns:
        for row, cell in enumerate(column if b"." in b"".join(column) else ()):
            if any(b"." in number[0] for number in _MARKED.finditer(cell)):
                text = quoted(cell.decode("utf-8", "replace"))
                remedy = "write numbers without marks of thousands"
                yield row, f"{text} has a point, and this table has decimal commas: {remedy}"


def with_points(rows: Iterable[Sequence[bytes]]) -> list[list[bytes]]:
    """Return cells with decimal points in place of commas."""
    return [[cell.replace(b",", b".") for cell in row] for row in rows]
