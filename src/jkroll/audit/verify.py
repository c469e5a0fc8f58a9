"""The audit of the paper, computed as it is asked for: a row a claim, as a table, plain lines, CSV or JSON."""

import csv
import sys
from collections.abc import Iterable, Sequence
from typing import Any, TextIO

from ..text import columns, fitting, json_text, say
from . import CLAIMS, Check, Row

DISAGREES = 1
WIDE = 120  # columns that the whole table takes
HEADERS = ("equation", "claim", "printed", "follows", "difference", "verdict", "expected", "reason")


def run_checks(checks: Iterable[Check] = CLAIMS) -> list[Row]:
    """Compute every check, in the paper's order."""
    return [check.row() for check in checks]


def write_verification(out: TextIO, kind: str, checks: Iterable[Check] = CLAIMS) -> int:
    """Compute the audit and write it in the format asked for; return the exit code.

    It is 1 if a verdict is not the expected one; which, a line each says on stderr.
    """
    rows = run_checks(checks)
    _WRITERS[kind](rows, out)
    surprises = [row for row in rows if row.verdict != row.expected]
    for row in surprises:
        say(f"jkroll: Eq {row.equation}, {row.claim}: {row.expected} expected, {row.verdict} computed", sys.stderr)
    return DISAGREES if surprises else 0


def _write_table(rows: Sequence[Row], out: TextIO) -> None:
    from ..output.table import write_rows

    heads = ["Eq", "claim", "printed", "follows", "off by", "verdict", "why"]
    cells = [
        [row.equation, row.claim, f"{row.printed:.3g}", f"{row.follows:.3g}", _off_by(row), _verdict(row), row.reason]
        for row in rows
    ]
    if columns() < WIDE:  # the numbers give way
        kept = (0, 1, 4, 5)
        heads, cells = [heads[place] for place in kept], [[row[place] for place in kept] for row in cells]
    write_rows(heads, cells, out)
    say(_summary(rows), out)


def _off_by(row: Row) -> str:
    return f"{row.difference:.0e}" if 0 < row.difference < 1e-3 else f"{row.difference:.2g}"


def _verdict(row: Row) -> str:
    return row.verdict if row.verdict == row.expected else f"{row.verdict}, not {row.expected}"


def _summary(rows: Sequence[Row]) -> str:
    """How many claims have which verdict, the most frequent first."""
    verdicts = [row.verdict for row in rows]
    counts = sorted(dict.fromkeys(verdicts), key=lambda verdict: -verdicts.count(verdict))
    return f"{len(rows)} claims: " + ", ".join(f"{verdicts.count(verdict)} {verdict}" for verdict in counts)


def _write_plain(rows: Sequence[Row], out: TextIO) -> None:
    say("\t".join(HEADERS), out)
    for row in rows:
        say("\t".join(map(str, row)), out)


def _write_csv(rows: Sequence[Row], out: TextIO) -> None:
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(HEADERS)
    writer.writerows([fitting(str(cell), out) for cell in row] for row in rows)


def _write_json(rows: Sequence[Row], out: TextIO) -> None:
    objects: list[dict[str, Any]] = [row._asdict() for row in rows]
    say(json_text(objects, out), out)


_WRITERS = {"table": _write_table, "plain": _write_plain, "csv": _write_csv, "json": _write_json}
