"""NDJSON: rows that are objects, and lines that are not objects."""

import json
from pathlib import Path

import pytest

from harness import Run
from jkroll.tables import files
from relative import approx


def converted(run: Run, text: str, *options: str) -> list[dict[str, object]]:
    """Return the objects that a batch writes."""
    Path("grains.ndjson").write_text(text, encoding="utf-8")
    ran = run("batch", "grains.ndjson", "-o", "out.ndjson", "--jobs", "1", *options)
    assert ran.code in (0, 1), ran.err
    return [json.loads(line) for line in Path("out.ndjson").read_text(encoding="utf-8").splitlines() if line.strip()]


def test_lines_that_are_not_objects_are_failed_rows(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(files, "CHUNK", 64)
    lines = ['{"radius [nm]": 100}', "[1, 2]", "", '{"radius [nm]": 1', '{"radius [nm]": 100, "load [nN]": 1}', "{}"]
    found = converted(run, "\n".join(lines), "--quantities", "r_min")
    assert [one["status"] for one in found] == [
        None,
        "is not a JSON object",
        "is not a JSON object",
        "has 'load [nN]', which the first line does not have",
        "needs radius",
    ]
    assert [one["r_min [m]"] for one in found] == [4.999999999999999e-05, None, None, None, None]
    assert [one.get("line") for one in found][1:3] == ["[1, 2]", '{"radius [nm]": 1']
    assert found[3]["load [nN]"] == 1


def test_each_line_must_be_one_object(run: Run) -> None:
    """If all lines were read as one JSON array, the middle three would give three objects."""
    lines = ['{"radius [nm]": 1}, {"radius [nm]": 2}', '{"radius [nm]": [{"x": 3}', '{"y": 4}]}', '{"radius [nm]": 5}']
    found = converted(run, "\n".join(['{"radius [nm]": 0.5}', *lines]), "--quantities", "r_min")
    assert [one["status"] for one in found] == [None, *["is not a JSON object"] * 3, None]
    assert [one.get("line") for one in found] == [None, *lines[:3], None]
    assert found[4]["r_min [m]"] == approx(1.25e-7)


def test_a_file_that_is_not_a_table_is_refused(run: Run) -> None:
    for text, message in (("", "the table is empty"), ("[1]\n", "the first line is not a JSON object with members")):
        Path("x.ndjson").write_text(text, encoding="utf-8")
        assert run("batch x.ndjson").err == f"jkroll: {message}\n"


def test_a_deeply_nested_value_spoils_at_most_its_row(run: Run) -> None:
    """The library orjson reads up to 1000 nested brackets, and writes up to 254."""
    deep = "[" * 300 + "]" * 300
    rows = ['{"radius": "100nm"}', f'{{"radius": "100nm", "note": {deep}}}', f'{{"radius": {deep}}}']
    Path("x.ndjson").write_text("\n".join(rows) + "\n", encoding="utf-8")
    assert run("batch x.ndjson --gamma 25mJ/m2 --quantities pull_off_force -o out.ndjson").code == 1
    lines = Path("out.ndjson").read_text(encoding="utf-8").splitlines()
    assert [line.count('"pull_off_force [N]":1.178') for line in lines] == [1, 1, 0]


def test_notes_on_lines_have_a_subject(run: Run) -> None:
    Path("x.ndjson").write_text('{"radius": "1um"}\n[1]\n{"radius": "1um", "radius": "2um"}\n', encoding="utf-8")
    said = run("batch x.ndjson --gamma 25mJ/m2 --quantities pull_off_force -o out.ndjson").err
    assert "note: the line is not a JSON object: row 2\n" in said
    assert "note: the line has 'radius' twice: row 3\n" in said
