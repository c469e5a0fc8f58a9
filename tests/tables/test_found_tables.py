"""Public tables from instruments, simulation codes and lists of materials, in their original form.

Each table is read as its record in found_tables.toml says, or refused with the remedy that the record names.
"""

import re
import shlex
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

import pytest

from harness import Ran, Run
from jkroll.errors import BadTable
from jkroll.materials.library import known_materials
from jkroll.quantities.values import QuantityError, Uncertain
from jkroll.report.questions import BY_DEFAULT
from jkroll.tables.cells import Column
from jkroll.tables.files import DELIMITERS, Delimited
from jkroll.tables.header import check_inputs, stated_meanings, understood
from jkroll.tables.layouts import tabbed
from jkroll.tables.table import Asked
from relative import approx


class Found(NamedTuple):
    """A table; the head of found_tables.toml explains the fields."""

    path: str
    call: str
    table: str
    named: Sequence[str] = ()
    written: Sequence[str] = ()
    reads: Mapping[str, list[Any]] = MappingProxyType({})
    passes: Sequence[str] = ()
    failed: int = 0
    ends: str = ""
    crlf: bool = False

    @property
    def text(self) -> bytes:
        """The content of the table's file."""
        return self.table.replace("\n", "\r\n" if self.crlf else "\n").encode()


RECORDS = tomllib.loads(Path(__file__).with_name("found_tables.toml").read_text(encoding="utf-8"))
TABLES = {source: Found(**record) for source, (record,) in RECORDS.items()}
_COLUMN = re.compile(r"(?<!or )--column ('[^']*'|\"[^\"]*\")")
_OTHER = re.compile(r"write (--(?:delimiter|format) \w+)")


def named(message: str) -> list[str]:
    """Return the choices that a message advises: values of `--column`, and other options with their values."""
    advice, _, passing = message.partition(", or --column")
    chosen = _COLUMN.findall(advice) or _COLUMN.findall(f"--column{passing}")
    return [shlex.split(value)[0] for value in chosen] + _OTHER.findall(message)


def words(choice: str) -> list[str]:
    """Return a choice as words of a command."""
    return choice.split() if choice.startswith("--") else ["--column", choice]


def advised(run: Run, found: Found) -> Iterator[tuple[Ran, list[str]]]:
    """Iterate over runs with the choices advised so far; yield each run and the choices that its message advises."""
    written: Sequence[str] = ()
    while True:
        options = [word for choice in written for word in words(choice)]
        out = "out.tsv" if "--delimiter tab" in written else "out.csv"
        ran = run("batch", Path(found.path).name, *found.call.split(), *options, "-o", out)
        advice = [] if found.ends and found.ends in ran.err else named(ran.err)
        yield ran, advice
        count = len(written) + len(advice)
        if count == len(written) or count > len(found.named):
            return
        written = (found.written or found.named)[:count]


@pytest.mark.parametrize("source", TABLES)
def test_a_found_table_is_read_or_refused_as_its_record_says(
    run: Run, source: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "2000")
    found = TABLES[source]
    Path(Path(found.path).name).write_bytes(found.text)
    *_, (ran, _) = runs = [*advised(run, found)]
    assert [choice for _, advice in runs for choice in advice] == [*found.named]
    assert all(before.code == 2 or "note: " in before.err for before, _ in runs[:-1])
    if found.ends:
        assert (ran.code, found.ends in ran.err) == (2, True)
        return
    assert ran.code == (1 if found.failed else 0)
    assert (f"jkroll: {found.failed} of " in ran.err) == bool(found.failed)
    passing = ran.err.splitlines()[0].partition("passed through: ")[2].replace('"', "")
    said = re.split(", | and ", passing)
    assert {*found.passes} <= {*said}
    assert values(found) == {name: [of_cell(cell) for cell in cells] for name, cells in found.reads.items()}


def of_cell(value: Any) -> Any:
    """Return the expected value of a cell, with a tolerance if it is a number."""
    return approx(value, rel=1e-12) if isinstance(value, float | list) else value


def values(found: Found) -> dict[str, list[Any]]:
    """Return, by name, the cells of each column of materials and the values of each other input, row by row."""
    chosen = found.written or found.named
    options = dict(choice.removeprefix("--").split() for choice in chosen if choice.startswith("--"))
    mark = DELIMITERS[options.get("delimiter", "comma")]
    lines = Delimited(mark)
    stated = stated_meanings(choice for choice in chosen if not choice.startswith("--"))
    lines.read_header(tabbed(found.text) if mark == " " else found.text, stated)
    rows = lines.sample
    header = understood(lines.names, rows, lines.stated)
    materials = {column.name: [row[column.position] for row in rows] for column in header.materials}
    return materials | {column.name: [value(column, row) for row in rows] for column in header.inputs}


def value(column: Column, row: Sequence[str]) -> Any:
    """Return the value of an input in a row, or "" if the row gives no value."""
    text = column.joined(*(row[position] for position in column.positions.values()))
    try:
        found = column.value(text) if text else ""
    except QuantityError:
        return ""
    return [found.low, found.high] if isinstance(found, Uncertain) else found


ASKED = Asked({"radius": "1um", "surface_energy": "25mJ/m2"}, known_materials(), offered=BY_DEFAULT)


def test_many_found_tables_are_read_without_option_column() -> None:
    """The other tables are refused for a separator, for a column or for a missing input."""
    at_once = 0
    for found in TABLES.values():
        with suppress(BadTable):
            lines = Delimited(",")
            lines.read_header(found.text)
            header = understood(lines.names, lines.sample, given=ASKED.inputs, supply_of=ASKED.supply)
            check_inputs(header)
            at_once += 1
    assert at_once >= 16  # in three more, E or ρ of the materials would replace a column without a unit
    assert all(len(found.text) < 1000 for found in TABLES.values())


HEADERS = tomllib.loads(Path(__file__).with_name("found_headers.toml").read_text(encoding="utf-8"))["header"]


def refusal(table: str, columns: Sequence[str]) -> str:
    """Return the reason why a table is refused with these values of `--column`, or "" if it is read."""
    mark = "\t" if "\t" in table else ";" if ";" in table.splitlines()[0] else ","
    lines = Delimited(mark)
    try:
        lines.read_header(table.encode(), stated_meanings(columns))
        understood(lines.names, lines.sample, lines.stated)
    except BadTable as error:
        return str(error)
    return ""


def test_few_tables_are_refused_for_a_column_of_another_quantity() -> None:
    """Option --column gives each column of an input its unit, or passes the column through."""
    problems = {}
    for record in HEADERS:
        passed = [f"{text}=" for text in record["inputs"]]
        problems[f"{record['repository']} {record['path']}"] = refusal(record["table"], passed)
    for source, found in TABLES.items():
        pairs = zip(found.named, found.written or found.named, strict=True)
        columns = [said for text, said in pairs if not text.startswith("--") and not text.endswith("=")]
        if "has no header" not in found.ends:
            problems[source] = refusal(found.table, columns)
    refused = {source: problem for source, problem in problems.items() if problem}
    assert len(HEADERS) > 20
    assert len(refused) <= 0.065 * len(problems), refused  # one of them has moduli of wood along three directions
