"""The formats of tables, by the name of a file or as said, and what compresses them."""

import gzip
import os
from collections.abc import Callable, Iterator
from typing import BinaryIO, NamedTuple

from ..errors import MissingExtra
from ..text import quoted
from .errors import BadTable

KINDS = {"csv": "csv", "tsv": "tsv", "tab": "tsv", "ndjson": "ndjson", "jsonl": "ndjson", "parquet": "parquet"}
COMPRESSIONS = {"gz": "gzip", "gzip": "gzip", "zst": "zstd", "zstd": "zstd"}


PIECE = 1 << 17


class Format(NamedTuple):
    """What a table is written as."""

    kind: str
    compression: str = ""


def format_of(path: str) -> Format | None:
    """The format that a name says, as in grains.csv.gz; None if it says none.

    >>> format_of("grains.csv.gz"), format_of("a/grains")
    (Format(kind='csv', compression='gzip'), None)
    """
    parts = os.path.basename(path).casefold().split(".")
    compression = COMPRESSIONS.get(parts[-1], "")
    kind = KINDS.get(parts[-2 if compression and len(parts) > 1 else -1], "")
    return Format(kind, compression) if kind else None


def stated(text: str) -> Format:
    """The format of `--format`."""
    found = format_of(text.lstrip("."))
    if found is None:
        raise BadTable(
            f"--format: {quoted(text)} is none of {', '.join(dict.fromkeys(KINDS.values()))}, or these with .gz or .zst"
        )
    return found


def compressor(compression: str) -> Callable[[bytes], bytes]:
    """What compresses a block by itself: blocks behind each other are one file to every reader, and the same for any `--jobs`."""
    if compression == "gzip":
        return lambda text: gzip.compress(text, 1, mtime=0)
    if compression == "zstd":
        try:
            from zstandard import ZstdCompressor
        except ModuleNotFoundError as error:
            raise MissingExtra(error.name or "", "zstd") from None
        return ZstdCompressor(level=3).compress
    return lambda text: text


def decompressed(file: BinaryIO, compression: str) -> Iterator[bytes]:
    """The bytes that were compressed, piece by piece; EOFError if the end is missing."""
    if compression == "gzip":
        with gzip.open(file, "rb") as stream:
            while piece := stream.read(PIECE):
                yield piece
        return
    try:
        from zstandard import ZstdDecompressor
    except ModuleNotFoundError as error:
        raise MissingExtra(error.name or "", "zstd") from None
    frame, rest = ZstdDecompressor().decompressobj(), b""
    while rest or (rest := file.read(PIECE)):
        if frame.eof:
            frame = ZstdDecompressor().decompressobj()
        yield frame.decompress(rest)
        rest = frame.unused_data
    if not frame.eof:
        raise EOFError
