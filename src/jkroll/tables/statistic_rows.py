"""Rows of statistics in a table, such as a mean or a standard deviation below the data.

The name of a new kind of statistics belongs in MEANS, in SPREADS or, if it may also be a label, in _COMPANIONS.
"""

import re
from collections.abc import Sequence

from .reading import without_accents
from .words import MATERIALS

LABEL_OF = "label of column "  # the name of the cells of a column; the index of the column follows

# Names of statistics in lower case, without blanks, marks and accents.
MEANS = {
    *"""mean average avg median meansd meanstd meanstdev meansem mittelwert mittel moyenne mediane media promedio
    mediana gemiddelde medelvarde medel srednia среднее медиана 平均 平均值 平均値 中位数 中央値""".split()
}
SPREADS = {
    *(first + second for first in ("st", "std", "standard") for second in "dev deviation err error".split()),
    *"""sd std stdevs stdevp sem rsd variance uncertainty unsicherheit incertitude stabw stabws stabwn
    standardabweichung standardfehler stichprobenvarianz ecarttype erreurtype desviacionestandar desviaciontipica
    desvest deviazionestandard devst scartotipo desviopadrao standaardafwijking standaarddeviatie standardavvikelse
    odchyleniestandardowe стандартноеотклонение стандартнаяошибка 标准差 標準差 标准偏差 標準偏差 标准误差""".split(),
}
# Words that name statistics next to the words above, but otherwise label data.
_COMPANIONS = {
    *"""n count number s se σ sigma cv var vars varp ci ci95 iqr min max minimum maximum sum total range error mode
    kurtosis skewness percentile quartile quantile 1stqu 3rdqu coefficientvariation confidenceinterval confidencelevel
    modus schiefe wertebereich summe suma anzahl konfidenzniveau konfidenzintervall""".split()
}
_STATISTICS = MEANS | SPREADS | _COMPANIONS
_MOST_WORDS = 3  # maximum number of words in a name of a statistic
_FILLERS = "of the overall grand sample arithmetic value values lower upper de la значение".split()
_PERCENTILE = re.compile(r"\d[\d.]*\s*%|q[1-3]")
_BESIDES = re.compile(r"\(.*\)|\[.*\]|[\d.]+\s*%|%|[=:]\s*[\d.,]*$|\bof\s+\d+$")  # (n-1), 95 %, = 0.7, of 5
# The beginning of a cell that may name a mean or a spread. It ends within a line: otherwise the time of a search would
# grow as the square of the number of lines.
_BEGINNINGS = sorted({name[:3] for name in MEANS | SPREADS})
_MAY_NAME = re.compile(
    rf"\n[^a-z\n]*(?:(?:{'|'.join(_FILLERS)})[^a-z\n]+)*(?:{'|'.join(_BEGINNINGS)}|s\W?d|st\W|s\W?e\W?m)"
)


def is_of_text(name: str) -> bool:
    """Return whether a column of a table holds texts. `name`: the name of its cells."""
    return name in MATERIALS or name.startswith(LABEL_OF)


def statistic(cell: bytes) -> str:
    """Return the statistic that a cell names, in lower case without blanks and marks; "" for any other cell.

    >>> statistic(b"Mean:"), statistic(b"Std. dev. (n=5)"), statistic(b"Std. Error of Mean"), statistic(b"75%")
    ('mean', 'stddev', 'stderror', 'percentile')
    >>> statistic(b"Sample SD = 0.7"), statistic(b"Sample 5"), statistic(b"mean grain")
    ('sd', '', '')
    """
    plain = _plain(cell).strip()
    if _PERCENTILE.fullmatch(plain):
        return "percentile"
    words = [word for word in re.split(r"[\s_.:=±+/-]+", _BESIDES.sub(" ", plain)) if word and word not in _FILLERS]
    first = ""
    while words:
        sizes = range(_MOST_WORDS, 0, -1)  # the longest name first
        size = next((size for size in sizes if "".join(words[:size]) in _STATISTICS), 0)
        if not size:
            return ""
        first = first or "".join(words[:size])
        words = words[size:]
    return first


def _plain(cells: bytes) -> str:
    """Return texts in lower case and without accents."""
    return without_accents(cells.decode(errors="replace").casefold())


def _may_name(cells: Sequence[bytes]) -> bool:
    """Return whether some cells may name a mean or a spread: a fast test, since few columns have such cells."""
    return _MAY_NAME.search("\n" + _plain(b"\n".join(cells))) is not None


def are_kinds_of_data(cells: Sequence[bytes]) -> bool:
    """Return whether all filled cells name statistics but no spread: the data themselves are means or extremes."""
    names = {statistic(cell) for cell in cells if cell.strip()} if _may_name(cells) else {""}
    return "" not in names and names.isdisjoint(SPREADS)


def rows_of_statistics(cells: Sequence[bytes], *, alone: bool) -> list[int]:
    """Return the rows of statistics: adjacent rows that name statistics, among them a spread, or a mean and another.

    `alone`: True if a mean alone is enough. A word that may be a label, such as N, counts only next to a spread or a
    mean.
    """
    if not _may_name(cells):
        return []
    names, rows = [*map(statistic, cells)], list[int]()
    for block in _blocks(names):
        found = {names[row] for row in block} - {""}
        if found & SPREADS or (found & MEANS and (alone or len(found) > 1)):
            rows += block
    return rows


def _blocks(names: Sequence[str]) -> list[list[int]]:
    """Return blocks of rows that name statistics. `names`: the statistic that each row names, or "".

    A single other row within a block belongs to it, unless the row below repeats a statistic of the block: the other
    row is then the data of a new group.
    """
    blocks: list[list[int]] = []
    for row in [row for row, name in enumerate(names) if name]:
        if blocks and _is_in_block(row, blocks[-1], names):
            blocks[-1] += range(blocks[-1][-1] + 1, row + 1)
        else:
            blocks.append([row])
    return blocks


def _is_in_block(row: int, block: Sequence[int], names: Sequence[str]) -> bool:
    """Return whether a row that names a statistic belongs to the block above it."""
    distance = row - block[-1]
    return distance == 1 or (distance == 2 and names[row] not in [names[other] for other in block])
