"""Text for a terminal: the size of the terminal, and what is shown of a user's text."""

import pytest

from harness import Run, Stream
from jkroll.text import MAX_QUOTED, MAX_SIZE, quoted, say, terminal_width


@pytest.mark.parametrize(("stated", "size"), [("100", 100), ("1", 1), ("9999999", MAX_SIZE), ("0100", 100)])
def test_a_stated_width_of_the_terminal_is_bounded(monkeypatch: pytest.MonkeyPatch, stated: str, size: int) -> None:
    monkeypatch.setenv("COLUMNS", stated)
    assert terminal_width() == size


@pytest.mark.parametrize("stated", ["", "0", "-5", "1e3", "x", "9" * 5000])
def test_a_width_that_is_no_number_is_ignored(monkeypatch: pytest.MonkeyPatch, stated: str) -> None:
    monkeypatch.delenv("COLUMNS")
    own = terminal_width()
    monkeypatch.setenv("COLUMNS", stated)
    assert terminal_width() == own


@pytest.mark.parametrize(
    "line", ["report quartz 100nm", "materials", "pull-off --help", "map pull-off quartz --x radius=1nm:1mm"]
)
def test_no_output_grows_with_a_huge_terminal(run: Run, monkeypatch: pytest.MonkeyPatch, line: str) -> None:
    monkeypatch.setenv("COLUMNS", "9999999")
    ran = run(line, terminal=True)
    assert ran.code == 0
    assert max(map(len, ran.out.splitlines())) <= MAX_SIZE


def test_a_quoted_text_is_short_and_printable() -> None:
    text = quoted("\x1b[2J\u202e\n" * 1000)
    assert text.isprintable()
    assert len(text) <= MAX_QUOTED + len("'...'")


@pytest.mark.parametrize(
    ("encoding", "written"),
    [
        ("utf-8", "P_c = 3πγR, 50 µm"),
        ("cp1252", "P_c = 3 pi gamma R, 50 µm"),
        ("ascii", "P_c = 3 pi gamma R, 50 um"),
        ("koi8-r", "P_c = 3 pi gamma R, 50 um"),
    ],
)
def test_a_stream_gets_in_ascii_what_it_cannot_encode(encoding: str, written: str) -> None:
    out = Stream(encoding=encoding)
    out.reconfigure(errors="jkroll-ascii")
    say("P_c = 3πγR, 50 µm", out)
    assert out.text() == f"{written}\n"
