"""Decimal commas: the decimal mark of a table, and records with decimal points in place of commas."""

import re
from collections import Counter
from collections.abc import Iterable

from ..errors import BadRequest, BadTable
from ..text import quoted
from .statistic_rows import is_of_text
from .table import Records

_NUMERIC = re.compile(r"\s*[-+(]?[\d.,]")  # the beginning of a number, possibly with an uncertainty
_MARKED = re.compile(r"([\d.,]*)([.,])(\d+(?:[eE][-+]?\d+)?)")  # a number with a point or a comma
_UNCLEAR = re.compile(r"[1-9]\d{0,2}[.,]\d{3}")  # a number whose mark may separate thousands
_POINT = re.compile(rb"\.[\d.,]*\d")  # a point in a number
_OF_THOUSANDS = re.compile(rb"(?<![\d.,])[1-9]\d{0,2}\.\d{3}(?![\d.,eE])")
_WITH_COMMA = re.compile(r"[-+]?(?:\d{1,3}(?:\.\d{3})+|\d+),\d+")
_WITH_POINT = re.compile(r"[-+]?\d*\.\d+")


def decimal_mark(columns: Iterable[Iterable[str]], separator: str, *, points_may_group: bool = False) -> str:
    """Return the decimal mark of most numbers in columns; "" if neither mark is in the majority.

    A mark that occurs twice in a number separates thousands or the members of a list; such a number is ignored.
    `points_may_group`: True if a point may separate thousands. Without a majority, raises BadTable for a number such as
    1,200, unless commas separate the columns, and with `points_may_group` for one such as 1.200.

    >>> decimal_mark([["0,125", "1.234,5", "1,234,567", "1,200", "1,2,3"]], ";")
    ','
    """
    marks, unclear = Counter[str](), list[str]()
    for cells in columns:
        for whole, mark, fraction in _MARKED.findall(";".join(filter(_NUMERIC.match, cells))):
            if _UNCLEAR.fullmatch(whole + mark + fraction):
                unclear.append(whole + mark + fraction)
            elif mark not in whole:
                marks[mark] += 1
    if marks[","] != marks["."]:
        return max(marks, key=marks.__getitem__)
    for number in unclear:
        if points_may_group or ("," in number and separator != ","):
            raise BadTable(_two_readings(number))
    return ""


def have_decimal_commas(cells: Iterable[str]) -> bool:
    """Return whether some cells are numbers with a decimal comma, and no cell is a number with a decimal point."""
    numbers = [cell.strip() for cell in cells]
    return any(map(_WITH_COMMA.fullmatch, numbers)) and not any(map(_WITH_POINT.fullmatch, numbers))


def _two_readings(number: str) -> str:
    """Return the error message for a number whose mark may separate thousands."""
    digits = number.replace(",", "").replace(".", "")
    fraction = number.replace(",", ".")
    return f"{quoted(number)} may be {fraction} or {digits}: write {number}0, with one more digit, or {digits}"


def without_unclear(records: Records) -> Records:
    """Return records of unknown decimal mark, with an error for each row in which a point may separate thousands."""
    odd = dict(records.odd)
    for name, column in records.cells.items():
        if is_of_text(name) or b"." not in b"".join(column):
            continue
        for row, cell in enumerate(column):
            number = _OF_THOUSANDS.search(cell)
            if number:
                odd.setdefault(row, BadRequest(_two_readings(number[0].decode())))
    return records._replace(odd=odd)


def with_decimal_points(records: Records) -> Records:
    """Return records with points in place of decimal commas, and an error for each row with a point in a number."""
    points = dict(records.cells)
    odd = dict(records.odd)
    for name, column in records.cells.items():
        if is_of_text(name):
            continue
        for row, cell in enumerate(column):
            if _POINT.search(cell):
                text = quoted(cell.decode("utf-8", "replace"))
                problem = f"{text} has a point: this table has decimal commas, and no thousands separators"
                odd.setdefault(row, BadRequest(problem))
        points[name] = [cell.replace(b",", b".") for cell in column]
    return records._replace(cells=points, odd=odd)
