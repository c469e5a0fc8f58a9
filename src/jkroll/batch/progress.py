"""How far a run is, as one line on a terminal."""

import os
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TextIO

from ..text import say
from .source import Shared

WIDTH = 24


class Bar:
    """A bar with the rate and the time left."""

    def __init__(self, out: TextIO, shared: Shared, total: int) -> None:
        """`total`: bytes of the input, 0 if it has no end that is known."""
        self.out, self.shared, self.total = out, shared, total
        self.began = time.monotonic()
        self.rows_before, self.read_before = shared["rows"], shared["read"]
        self._shown = False

    def show(self) -> None:
        """Draw it, over what was drawn before."""
        seconds = max(time.monotonic() - self.began, 1e-9)
        rows, read = self.shared["rows"], self.shared["read"]
        rate = (rows - self.rows_before) / seconds
        text = f"{rows:,} rows, {rate:,.0f}/s"
        if self.total:
            part = min(read / self.total, 1.0)
            done = round(part * WIDTH)
            text = f"{part:4.0%} [{'#' * done}{'.' * (WIDTH - done)}] {text}"
            speed = (read - self.read_before) / seconds
            if speed:
                text += f", {_duration((self.total - read) / speed)} left"
        columns = int(os.environ.get("COLUMNS") or 0) or 80
        self.out.write("\r" + text[: columns - 1].ljust(columns - 1))
        self.out.flush()
        self._shown = True

    def clear(self) -> None:
        """Take it away."""
        if self._shown:
            columns = int(os.environ.get("COLUMNS") or 0) or 80
            self.out.write("\r" + " " * (columns - 1) + "\r")
            self.out.flush()


@contextmanager
def watched(shared: Shared, total: int, *, is_quiet: bool, goes_on: bool) -> Iterator[Callable[[], None]]:
    """What shows how far a run is, on a terminal; after an interrupt a line says where `--resume` goes on, if it does."""
    bar = Bar(sys.stderr, shared, total)
    try:
        yield bar.show if sys.stderr.isatty() and not is_quiet else _nothing
    except KeyboardInterrupt:
        bar.clear()
        if goes_on:
            say(f"jkroll: interrupted after {shared['rows']} rows; --resume goes on", sys.stderr)
        raise
    finally:
        bar.clear()


def _nothing() -> None:
    pass


def _duration(seconds: float) -> str:
    """Hours, minutes and seconds.

    >>> _duration(3725.4)
    '1:02:05'
    """
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"
