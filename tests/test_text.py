"""Text for a terminal: the width of the terminal, and characters that a stream cannot encode."""

import pytest

from harness import Stream
from jkroll.text import MAX_SIZE, say, terminal_width


@pytest.mark.parametrize(("stated", "size"), [("100", 100), ("1", 1), ("9999999", MAX_SIZE), ("0100", 100)])
def test_a_stated_width_of_the_terminal_is_bounded(monkeypatch: pytest.MonkeyPatch, stated: str, size: int) -> None:
    monkeypatch.setenv("COLUMNS", stated)
    assert terminal_width() == size


@pytest.mark.parametrize("stated", ["", "0", "-5", "1e3", "x", "9" * 5000])
def test_an_invalid_width_is_ignored(monkeypatch: pytest.MonkeyPatch, stated: str) -> None:
    monkeypatch.delenv("COLUMNS")
    own = terminal_width()
    monkeypatch.setenv("COLUMNS", stated)
    assert terminal_width() == own


@pytest.mark.parametrize(
    ("encoding", "written"),
    [
        ("utf-8", "P_c = 3πγR, 50 µm"),
        ("cp1252", "P_c = 3 pi gamma R, 50 µm"),
        ("ascii", "P_c = 3 pi gamma R, 50 um"),
        ("koi8-r", "P_c = 3 pi gamma R, 50 um"),
    ],
)
def test_characters_that_a_stream_cannot_encode_are_written_in_ascii(encoding: str, written: str) -> None:
    out = Stream(encoding=encoding)
    out.reconfigure(errors="jkroll-ascii")
    say("P_c = 3πγR, 50 µm", out)
    assert out.text() == f"{written}\n"
