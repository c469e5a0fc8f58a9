"""One large table as several: groups of rows of a Parquet file, or bytes from one record to another."""

import os
from collections.abc import Iterator
from typing import Any, BinaryIO, NamedTuple

from .errors import missing_extra
from .formats import PIECE
from .settings import Settings, input_format
from .source import MAX_RECORD

HEAD = 1 << 20  # bytes that are looked at for a header
BYTES = 1 << 26  # of a span of lines, at least, but for the last
ROWS = 1 << 20  # of a span of Parquet, likewise


class Span(NamedTuple):
    """Part of a table: bytes of lines, with what stands before the first, or groups of rows."""

    start: int
    end: int
    head: int = 0

    def read(self, file: BinaryIO) -> Iterator[bytes]:
        """The bytes of this part, as a table of its own."""
        for start, end in ((0, self.head), (self.start, self.end)):
            file.seek(start)
            left = end - start
            while left and (piece := file.read(min(PIECE, left))):
                left -= len(piece)
                yield piece


def spans_of(path: str, settings: Settings) -> list[Span]:
    """The parts that a table falls into; none for one that is compressed, or small."""
    form = input_format(path, settings)
    if form.compression or not os.path.isfile(path):
        return []
    spans = _of_groups(path) if form.kind == "parquet" else _of_lines(path, form.kind)
    return spans if len(spans) > 1 else []


def _of_groups(path: str) -> list[Span]:
    with missing_extra("parquet"):
        from .parquet import opened_parquet
    with opened_parquet(path) as file:
        return [*groups_together(file.metadata, ROWS, Span(0, file.metadata.num_row_groups))]


def groups_together(metadata: Any, least: int, span: Span) -> Iterator[Span]:
    """The groups of rows of a span, as many together as have so many rows."""
    start, rows = span.start, 0
    for place in range(span.start, span.end):
        rows += metadata.row_group(place).num_rows
        if rows >= least or place == span.end - 1:
            yield Span(start, place + 1)
            start, rows = place + 1, 0


def _of_lines(path: str, kind: str) -> list[Span]:
    from .stream import FORMATS

    form = FORMATS[kind]
    spans: list[Span] = []
    if os.path.getsize(path) <= BYTES:
        return spans
    with open(path, "rb") as file:
        head = start = end = len(form.head(file.read(HEAD)).text)
        file.seek(end)
        while text := file.read(MAX_RECORD):
            end += form.cut(text, is_end=len(text) < MAX_RECORD) or len(text)
            if end - start >= BYTES:
                spans.append(Span(start, end, head))
                start = end
            file.seek(end)
    return [*spans, Span(start, end, head)] if start < end else spans
