"""The line of progress of a run on a terminal."""

import sys
from functools import partial
from pathlib import Path

import pytest

from harness import Run, Stream
from jkroll.model.tally import Tally
from jkroll.tables.files import Input
from jkroll.tables.progress import with_progress
from jkroll.tables.run import Converted, progress_of


def test_the_line_shows_the_share_read_and_the_rows(monkeypatch: pytest.MonkeyPatch) -> None:
    Path("grains.csv").write_bytes(b"100\n" * 100)
    file = Input("grains.csv")
    with file.file:
        out = Stream(terminal=True)
        monkeypatch.setattr("sys.stderr", out)
        monkeypatch.setattr("jkroll.tables.progress.WAIT", 0)
        seconds = iter([0.0, 10.0])  # at the beginning, and after a block
        monkeypatch.setattr("jkroll.tables.progress.monotonic", seconds.__next__)
        monkeypatch.setattr(file, "share_read", lambda rows: rows / 200_000)
        every = [Converted(b"", 0, Tally(rows=50_000))] * 2
        blocks = with_progress(every, lambda block: block.tally.rows, partial(progress_of, file))
        assert [next(blocks), next(blocks)]
    line = out.text()
    assert " 25%, 30 s left, " in line
    assert "50,000 rows" in line
    blocks.close()
    assert out.text().removeprefix(line) == f"\r{' ' * (len(line) - 2)}\r"


def test_a_pipe_gets_no_line_of_progress(run: Run) -> None:
    Path("grains.csv").write_text("radius [nm]\n" + "100\n" * 100, encoding="utf-8")
    before = {*sys.modules}
    assumed = "assumed: ξ = 200 pm (--xi), no load (--load)"
    said = "note: doubts in 100 of 100 rows (column doubt): unchecked 100 (a limit needs an input that is not given)"
    assert run("batch grains.csv -o out.csv --jobs 1") == (0, "", f"read: radius [nm]\n{assumed}\n{said}\n")
    assert "rich.progress" not in {*sys.modules} - before
