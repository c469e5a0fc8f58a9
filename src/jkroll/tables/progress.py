"""The line of progress on a terminal."""

import sys
from collections.abc import Callable, Generator, Iterable
from time import monotonic
from typing import TypeVar

WAIT = 0.5  # seconds before progress is shown
WIDTH = 60  # characters in the line of progress

T = TypeVar("T")


def with_progress(
    items: Iterable[T], size_of: Callable[[T], int], line_of: Callable[[int, float], str]
) -> Generator[T]:
    """Iterate over items, with a line of progress on the terminal that disappears at the end.

    `size_of`: returns the size of an item; `line_of`: returns the line, from the size of all items so far and the
    seconds since the beginning.
    """
    began, done, line = monotonic(), 0, ""
    try:
        for item in items:
            done += size_of(item)
            yield item
            del item  # frees memory before the next item
            taken = monotonic() - began
            if taken > WAIT:
                line = line_of(done, taken)
                sys.stderr.write(f"\r{line:{WIDTH}}\r")
                sys.stderr.flush()
    finally:
        sys.stderr.write(f"\r{'':{WIDTH}}\r" if line else "")
