"""The writer of records: the same cells in every format, and nothing cut or lost on the way."""

import csv
import io
import json
from collections.abc import Sequence

import pytest

from harness import Stream
from jkroll.output.writers import Cell, Lines, write_records

HEADS = ("name", "value [N]")
RECORDS: Sequence[Sequence[Cell]] = (("iron, γ = 3", 1.2345678901234567e-08), ("[gold]", None))


def written(kind: str, encoding: str = "utf-8") -> str:
    """Return the records in a format, as a program writes them."""
    out = Stream(encoding=encoding)
    out.reconfigure(errors="jkroll-ascii")
    write_records(HEADS, RECORDS, kind, out)
    return out.text()


def test_plain_lines_are_separated_by_tabs() -> None:
    assert written("plain") == "name\tvalue [N]\niron, γ = 3\t1.2345678901234567e-8\n[gold]\t-\n"


@pytest.mark.parametrize(("kind", "line"), [("plain", "\t-"), ("csv", ",")])
def test_an_empty_text_is_no_missing_value(kind: str, line: str) -> None:
    out = Stream(encoding="utf-8")
    write_records(HEADS, [("", None)], kind, out)
    assert out.text().splitlines()[1] == line


@pytest.mark.parametrize(("separator", "row"), [(";", 'x;"no, yes; no"'), (",", 'x,"no, yes; no"')])
def test_a_text_with_the_separator_of_a_table_stands_in_quotes(separator: str, row: str) -> None:
    assert Lines(separator).rows(("name", "status"), [["x"], ["no, yes; no"]]).decode() == f"{row}\n"


def test_csv_reads_back() -> None:
    rows = list(csv.reader(io.StringIO(written("csv"))))
    assert rows == [list(HEADS), ["iron, γ = 3", "1.2345678901234567e-8"], ["[gold]", ""]]


def test_json_has_numbers_and_null() -> None:
    assert json.loads(written("json")) == [dict(zip(HEADS, record, strict=True)) for record in RECORDS]


@pytest.mark.parametrize("columns", [80, 10])
def test_a_table_is_whole_on_any_terminal(columns: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", str(columns))
    text = written("table")
    assert all(cell in text for cell in ("iron, γ = 3", "1.2345678901234567e-8", "[gold]", "—"))


@pytest.mark.parametrize("kind", ["table", "plain", "csv", "json"])
def test_a_stream_that_takes_only_ascii(kind: str) -> None:
    text = written(kind, "ascii")
    assert "gamma = 3" in text or json.loads(text)[0]["name"] == "iron, γ = 3"
