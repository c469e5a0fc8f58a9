"""The progress of a run as a bar on a terminal."""

import sys
import time
from typing import TYPE_CHECKING, Self

if TYPE_CHECKING:
    from rich.progress import Progress

WAIT = 0.5  # seconds before a bar is shown


class Bar:
    """A bar on a terminal, and nothing elsewhere."""

    def __init__(self, total: int, *, quiet: bool) -> None:
        """`total`: how much there is to do; 0 if it is unknown."""
        self._total = total or None
        self._is_shown = sys.stderr.isatty() and not quiet
        self._began = time.monotonic()
        self._progress: Progress | None = None

    def show(self, done: int, rows: int) -> None:
        """Show how much is done of the total, and the rows so far."""
        if not self._is_shown or time.monotonic() - self._began < WAIT:
            return
        if self._progress is None:
            self._progress = _begun(self._total)
        self._progress.update(self._progress.task_ids[0], completed=done, rows=rows)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        """Take the bar away."""
        if self._progress is not None:
            self._progress.stop()


def _begun(total: int | None) -> "Progress":
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    layout = (TextColumn("{task.percentage:3.0f}%"), BarColumn(), TextColumn("{task.fields[rows]:,} rows"))
    progress = Progress(*layout, TimeRemainingColumn(), console=Console(stderr=True), transient=True)
    progress.add_task("", total=total, rows=0)
    progress.start()
    return progress
