"""The progress of a run as a bar on a terminal."""

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager

from ..text import say
from .settings import Settings

WAIT = 0.5  # seconds before a bar is shown
Counts = Callable[[], tuple[int, int]]  # how much is done of the total, and the rows so far


@contextmanager
def watched(total: int, counts: Counts, settings: Settings, *, goes_on: bool) -> Iterator[Callable[[], None]]:
    """Yield a function that shows the progress; after an interrupt say where the run stopped. `total`: 0 if unknown."""
    is_shown = sys.stderr.isatty() and not settings.quiet
    began = time.monotonic()
    update: Callable[[], None] | None = None
    with ExitStack() as until_the_end:

        def show() -> None:
            nonlocal update
            if update is None and is_shown and time.monotonic() - began >= WAIT:
                update = until_the_end.enter_context(_bar(total, counts))
            if update is not None:
                update()

        try:
            yield show
        except KeyboardInterrupt:
            until_the_end.close()
            say(f"jkroll: interrupted after {counts()[1]} rows{'; --resume goes on' * goes_on}", sys.stderr)
            raise


@contextmanager
def _bar(total: int, counts: Counts) -> Iterator[Callable[[], None]]:
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    layout = (TextColumn("{task.percentage:3.0f}%"), BarColumn(), TextColumn("{task.fields[rows]:,} rows"))
    with Progress(*layout, TimeRemainingColumn(), console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=total or None, rows=0)

        def update() -> None:
            done, rows = counts()
            bar.update(task, completed=done, rows=rows)

        yield update
