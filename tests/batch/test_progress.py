"""How far a run is, on a terminal."""

from pathlib import Path

from harness import Run, Stream
from jkroll.batch.progress import Bar
from jkroll.batch.source import Shared


def test_a_bar_shows_part_rate_and_time_left() -> None:
    shared, out = Shared(), Stream(terminal=True)
    bar = Bar(out, shared, 4000)
    bar.began -= 10
    shared["rows"], shared["read"] = 50_000, 1000
    bar.show()
    line = out.text().removeprefix("\r")
    assert line.startswith(" 25% [######..................] 50,000 rows, ")
    assert line.rstrip().endswith("/s, 0:30 left")
    assert len(line) == 79
    bar.clear()
    assert out.text().endswith("\r" + " " * 79 + "\r")


def test_no_bar_in_a_pipe(run: Run) -> None:
    Path("grains.csv").write_text("radius [nm]\n" + "100\n" * 100, encoding="utf-8")
    assert run("batch grains.csv -o out.csv --jobs 1") == (0, "", "")
