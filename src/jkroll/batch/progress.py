"""The progress of a run as a bar on a terminal."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from ..text import say

Counts = Callable[[], tuple[int, int]]  # how much is done of the total, and the rows so far


@contextmanager
def watched(total: int, counts: Counts, *, is_quiet: bool, goes_on: bool) -> Iterator[Callable[[], None]]:
    """Yield a function that shows the progress; after an interrupt say where the run stopped. `total`: 0 if unknown."""
    try:
        if is_quiet or not sys.stderr.isatty():
            yield _nothing
        else:
            with _bar(total, counts) as show:
                yield show
    except KeyboardInterrupt:
        advice = "; --resume goes on" if goes_on else ""
        say(f"jkroll: interrupted after {counts()[1]} rows{advice}", sys.stderr)
        raise


@contextmanager
def _bar(total: int, counts: Counts) -> Iterator[Callable[[], None]]:
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    layout = (TextColumn("{task.percentage:3.0f}%"), BarColumn(), TextColumn("{task.fields[rows]:,} rows"))
    with Progress(*layout, TimeRemainingColumn(), console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=total or None, rows=0)

        def show() -> None:
            done, rows = counts()
            bar.update(task, completed=done, rows=rows)

        yield show


def _nothing() -> None:
    pass
