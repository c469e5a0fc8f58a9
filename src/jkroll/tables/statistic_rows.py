"""Rows of statistics in a table, such as a mean or a standard deviation below the data."""

import re
from collections.abc import Sequence
from itertools import groupby

from .words import MATERIALS

LABEL_OF = "label of column "  # the name of the cells of a column; the index of the column follows
MEANS = {*"mean average avg median meansd meanstd meanstdev meansem mittelwert moyenne".split()}
SPREADS = {
    *"""sd stdev stddev standarddeviation stdeviation sem stderr stderror standarderror rsd variance
    standardabweichung écarttype ecarttype""".split()
}

# Words that name statistics next to the words above, but otherwise label data.
_COMPANIONS = {*"n count number se std cv var ci iqr min max minimum maximum sum total range error".split()}
_STATISTICS = MEANS | SPREADS | _COMPANIONS
_PERCENTILE = re.compile(r"\d[\d.]*\s*%|q[1-3]")
# The beginning of a cell that may name a mean or a spread.
_MAY_NAME = re.compile(rb"\n[^\na-z0-9]*(?:mean|average|avg|median|mittel|moyenne|rsd|s\W?d|st|s\W?e\W?m|var|cart)")


def is_of_text(name: str) -> bool:
    """Return whether a column of a table holds texts. `name`: the name of its cells."""
    return name in MATERIALS or name.startswith(LABEL_OF)


def statistic(cell: bytes) -> str:
    """Return the statistic that a cell names, in lower case without blanks and marks; "" for any other cell.

    >>> statistic(b"Mean:"), statistic(b"Std. dev. (n=5)"), statistic(b"75%"), statistic(b"grain 5")
    ('mean', 'stddev', 'percentile', '')
    """
    plain = cell.decode(errors="replace").strip().casefold()
    if _PERCENTILE.fullmatch(plain):
        return "percentile"
    bare = re.sub(r"\(.*\)|\[.*\]|^[\d.]+\s*%", "", plain)
    word = re.sub(r"[\s_.:=±+/-]", "", bare)
    return word if word in _STATISTICS else ""


def _may_name(cells: Sequence[bytes]) -> bool:
    """Return whether some cells may name a mean or a spread: a fast test, since few columns have such cells."""
    return _MAY_NAME.search(b"\n" + b"\n".join(cells).lower()) is not None


def are_kinds_of_data(cells: Sequence[bytes]) -> bool:
    """Return whether all filled cells name statistics but no spread: the data themselves are means or extremes."""
    names = {statistic(cell) for cell in cells if cell.strip()} if _may_name(cells) else {""}
    return "" not in names and names.isdisjoint(SPREADS)


def rows_of_statistics(cells: Sequence[bytes], *, alone: bool) -> list[int]:
    """Return the rows of statistics: adjacent rows that name statistics, among them a spread, or a mean and another.

    `alone`: True if a mean is enough. A word that may be a label, such as N, counts only next to a spread or a mean.
    """
    if not _may_name(cells):
        return []
    names, rows = [*map(statistic, cells)], list[int]()
    for is_named, run in groupby(range(len(names)), lambda row: bool(names[row])):
        adjacent = [*run]
        found = {names[row] for row in adjacent}
        if is_named and (found & SPREADS or (found & MEANS and (alone or len(found) > 1))):
            rows += adjacent
    return rows
