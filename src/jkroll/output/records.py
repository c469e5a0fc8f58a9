"""Records in columns: a table on a terminal, tab-separated lines, CSV, or JSON objects."""

from collections.abc import Iterable, Sequence
from typing import TextIO

from ..text import fitting, json_text, say

Cell = str | float | None


def write_records(heads: Sequence[str], records: Iterable[Sequence[Cell]], kind: str, out: TextIO) -> None:
    """Write records in a format: "table", "plain", "csv" or "json".

    A cell without a value is None. It is written as "—", "-", an empty cell or null.
    """
    _WRITERS[kind](heads, records, out)


def _write_plain(heads: Sequence[str], records: Iterable[Sequence[Cell]], out: TextIO) -> None:
    say("\t".join(heads), out)
    for record in records:
        say("\t".join("-" if cell is None else str(cell) for cell in record), out)


def _write_csv(heads: Sequence[str], records: Iterable[Sequence[Cell]], out: TextIO) -> None:
    import csv

    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([fitting(head, out) for head in heads])
    for record in records:
        writer.writerow(["" if cell is None else fitting(str(cell), out) for cell in record])


def _write_json(heads: Sequence[str], records: Iterable[Sequence[Cell]], out: TextIO) -> None:
    say(json_text([dict(zip(heads, record, strict=True)) for record in records], out), out)


def _write_table(heads: Sequence[str], records: Iterable[Sequence[Cell]], out: TextIO) -> None:
    from .table import write_rows

    write_rows(heads, [["—" if cell is None else str(cell) for cell in record] for record in records], out)


_WRITERS = {"table": _write_table, "plain": _write_plain, "csv": _write_csv, "json": _write_json}
