"""Decimal commas: the numbers of a table that tell whether it has them, and cells with points in place of them."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, compress

from ..errors import BadTable
from ..text import quoted

_DECIMAL_POINT = re.compile(rb"\.\d")
_MARKED = re.compile(rb"\d*[.,][\d.,]*\d(?:[eE][+-]?\d+)?")  # a number with a point or a comma
_OTHER_MARK = {b",": b".", b".": b","}
_OF_THOUSANDS = re.compile(rb"[1-9]\d{0,2}(?:[.,]\d{3})*")
_NUMERIC = re.compile(rb"\s*[-+(]?[\d.,]")  # the beginning of numbers, with an error bar or not


def has_decimal_commas(are_read: Sequence[bool], columns: Sequence[Sequence[bytes]], *, by_all: bool) -> bool:
    """Return whether the numbers of a table have decimal commas. Raises BadTable for those that may be of thousands.

    The columns that are read decide; all columns where the marks of these may be either. If they have none, all decide
    if `by_all`, as between semicolons. Where nothing decides, points are decimal.
    """
    read, every = (
        Counter(map(_decimal_mark, chain.from_iterable(map(_marked_numbers, some))))
        for some in (compress(columns, are_read), columns)
    )
    unclear = [mark.decode() for mark in read if len(mark) > 1]
    for marks in (read, every) if unclear or (not read and by_all) else (read,):
        if marks[b","] != marks[b"."]:
            return marks[b","] > marks[b"."]
    if number := next((number for number in unclear if "," in number or by_all), ""):
        either = f"{number.replace(',', '.')} or {re.sub('[,.]', '', number)}"
        remedy = "write decimal points, and no marks of thousands"
        if "," not in number:
            remedy = "leave marks of thousands out, or save the table with commas between its columns"
        raise BadTable(f"{quoted(number)} may be {either}: {remedy}")
    return False


def _marked_numbers(cells: Sequence[bytes]) -> list[bytes]:
    """Return the numbers with a point or a comma of a column of which most cells are numbers."""
    numbers = [*filter(_NUMERIC.match, cells)]
    is_of_numbers = 2 * len(numbers) > sum(1 for cell in cells if cell.strip())
    return [number for cell in numbers for number in _MARKED.findall(cell)] if is_of_numbers else []


def _decimal_mark(number: bytes) -> bytes:
    """Return the decimal mark of a number: itself where its mark may be of thousands, and none of a list.

    >>> [*map(_decimal_mark, (b"0,125", b"1,200e3", b"1.234,5", b"1,234,567", b"1,200", b"1,2,3"))]
    [b',', b',', b',', b'.', b'1,200', b'']
    """
    mantissa, has_exponent, _ = number.lower().partition(b"e")
    mark = mantissa.rstrip(b"0123456789")[-1:]
    whole, _, fraction = mantissa.rpartition(mark)
    if has_exponent or not _OF_THOUSANDS.fullmatch(whole):
        return mark if whole.isdigit() or not whole else b""
    is_repeated = mark in whole
    if len(fraction) != 3:
        return b"" if is_repeated else mark
    if whole.isdigit():
        return number
    return _OTHER_MARK[mark] if is_repeated else mark


def points_among_commas(columns: Iterable[Sequence[bytes]]) -> Iterator[tuple[int, str]]:
    """Iterate over the rows in which a number has a point, decimal or of thousands, and what is wrong with that."""
    for column in columns:
        for row, cell in enumerate(column if b"." in b"".join(column) else ()):
            if _DECIMAL_POINT.search(cell):
                text = quoted(cell.decode("utf-8", "replace"))
                yield (
                    row,
                    f"{text} has a point, and this table has decimal commas: write numbers without marks of thousands",
                )


def with_points(rows: Iterable[Sequence[bytes]]) -> list[list[bytes]]:
    """Return cells with decimal points in place of commas."""
    return [[cell.replace(b",", b".") for cell in row] for row in rows]
