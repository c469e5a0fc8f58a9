"""`jkroll verify`: the audit of the paper, a row for each claim, as a table, plain lines, CSV or JSON."""

import sys
from collections import Counter
from collections.abc import Sequence
from typing import TextIO

from ..output.records import Cell, write_records
from ..text import say, terminal_width
from .checks import Check, Row
from .moment import cylinder, moment
from .pair import collisions, statics, vibrations

DISAGREES = 1
WIDE = 120  # columns of the whole table
HEADS = ("Eq", "claim", "printed", "follows", "off by", "verdict", "why")
NARROW_HEADS = ("Eq", "claim", "off by", "verdict")


def claims() -> tuple[Check, ...]:
    """Evaluate every claim of the paper, in its order, and what follows in its place."""
    return (*moment(), *statics(), *vibrations(), *collisions(), *cylinder())


def write_verification(out: TextIO, kind: str) -> int:
    """Write the audit in a format and return the exit code: 1 if a verdict is not the expected one.

    Each such verdict is named on stderr.
    """
    rows = [check.row() for check in claims()]
    if kind == "table":
        heads = HEADS if terminal_width() >= WIDE else NARROW_HEADS
        write_records(heads, [[_table_row(row)[head] for head in heads] for row in rows], kind, out)
        say(_summary(rows), out)
    else:
        write_records(Row._fields, rows, kind, out)
    surprises = [row for row in rows if row.verdict != row.expected]
    for row in surprises:
        say(f"jkroll: Eq {row.equation}, {row.claim}: {row.expected} expected, {row.verdict} computed", sys.stderr)
    return DISAGREES if surprises else 0


def _table_row(row: Row) -> dict[str, Cell]:
    return {
        "Eq": row.equation,
        "claim": row.claim,
        "printed": f"{row.printed:.3g}",
        "follows": f"{row.follows:.3g}",
        "off by": f"{row.difference:.0e}" if 0 < row.difference < 1e-3 else f"{row.difference:.2g}",
        "verdict": row.verdict if row.verdict == row.expected else f"{row.verdict}, not {row.expected}",
        "why": row.reason,
    }


def _summary(rows: Sequence[Row]) -> str:
    """Return the number of claims and of each verdict, and what the reasons call the copy."""
    counts = Counter(row.verdict for row in rows).most_common()
    verdicts = ", ".join(f"{count} {verdict}" for verdict, count in counts)
    return f"{len(rows)} claims: {verdicts}\nthe copy: the transcription at hand; the printed paper may differ from it"
