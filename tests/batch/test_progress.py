"""The progress of a run, on a terminal."""

import sys
from pathlib import Path

import pytest

from harness import Run, Stream
from jkroll.batch.progress import Bar


def test_a_bar_shows_part_and_rows(monkeypatch: pytest.MonkeyPatch) -> None:
    out = Stream(terminal=True)
    monkeypatch.setattr("sys.stderr", out)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr("jkroll.batch.progress.WAIT", 0)
    with Bar(4000, quiet=False) as bar:
        bar.show(1000, 50_000)
    assert " 25%" in out.text()
    assert "50,000 rows" in out.text()


def test_no_bar_in_a_pipe(run: Run) -> None:
    Path("grains.csv").write_text("radius [nm]\n" + "100\n" * 100, encoding="utf-8")
    before = {*sys.modules}
    assumed = "note: assumed ξ = 200 pm (--xi), P = 0 N (--load)"
    said = "note: unchecked in 100 of 100 rows: a limit could not be judged, as it needs an input that is not given"
    assert run("batch grains.csv -o out.csv --jobs 1") == (0, "", f"read: radius [nm]\n{assumed}\n{said}\n")
    assert "rich.progress" not in {*sys.modules} - before
