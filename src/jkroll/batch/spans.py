"""Parts of one large table: bytes from one record to another, or groups of rows of a Parquet file."""

from collections.abc import Callable, Iterator
from typing import Any, BinaryIO, NamedTuple

HEAD = 1 << 20  # bytes in which the header is looked for
WINDOW = 1 << 24  # bytes in which the end of a record is looked for
BYTES = 1 << 26  # least size of a span of lines, but for the last
ROWS = 1 << 20  # least size of a span of Parquet, but for the last
PIECE = 1 << 18  # bytes read at a time


class Span(NamedTuple):
    """Part of a table: bytes of lines, with the size of the header before the first line, or groups of rows."""

    start: int
    end: int
    head: int = 0

    def read(self, file: BinaryIO) -> Iterator[bytes]:
        """Iterate over the bytes of this part as a table of its own."""
        for start, end in ((0, self.head), (self.start, self.end)):
            file.seek(start)
            left = end - start
            while left and (piece := file.read(min(PIECE, left))):
                left -= len(piece)
                yield piece


def spans_of_lines(file: BinaryIO, size: int, head: int, cut: Callable[[bytes, bool], int]) -> list[Span]:
    """Return the parts of a table of lines; none for a small one. `head`: size of the header."""
    spans: list[Span] = []
    start = end = head
    if size <= BYTES:
        return spans
    file.seek(end)
    while text := file.read(WINDOW):
        end += cut(text, len(text) < WINDOW) or len(text)
        if end - start >= BYTES:
            spans.append(Span(start, end, head))
            start = end
        file.seek(end)
    return [*spans, Span(start, end, head)] if start < end else spans


def spans_of_groups(metadata: Any) -> list[Span]:
    """Return the parts of a Parquet file: as many groups of rows together as have enough rows."""
    spans: list[Span] = []
    start, rows = 0, 0
    for place in range(metadata.num_row_groups):
        rows += metadata.row_group(place).num_rows
        if rows >= ROWS or place == metadata.num_row_groups - 1:
            spans.append(Span(start, place + 1))
            start, rows = place + 1, 0
    return spans
