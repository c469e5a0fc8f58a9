"""The registry of formats and compressions. A format is named by the end of a file's name, or by `--format`."""

import gzip
import os
import zlib
from collections.abc import Callable, Iterator, Mapping
from typing import BinaryIO, NamedTuple

from ..errors import BadTable, missing_extra
from ..text import quoted
from .delimited import DELIMITED, DIALECTS, Dialect
from .ndjson import Ndjson

LINES: Mapping[str, Dialect | Ndjson] = {**DIALECTS, "ndjson": Ndjson()}
KINDS = {"csv": "csv", "tsv": "tsv", "tab": "tsv", "ndjson": "ndjson", "jsonl": "ndjson", "parquet": "parquet"}
COMPRESSIONS = {"gz": "gzip", "gzip": "gzip", "zst": "zstd", "zstd": "zstd"}
CHUNK = 1 << 20  # bytes read at a time
FEED = 1 << 9  # bytes given to zstd at a time: a block of at least 4 bytes holds at most 128 KiB, so 16 MiB come out


class FileFormat(NamedTuple):
    """A format and its compression."""

    kind: str
    compression: str = ""


def format_of_name(path: str) -> FileFormat | None:
    """Return the format that a name such as grains.csv.gz states, or None. Raises BadTable for Parquet that is compressed once more.

    >>> format_of_name("grains.csv.gz"), format_of_name("a/grains")
    (FileFormat(kind='csv', compression='gzip'), None)
    """
    parts = os.path.basename(path).casefold().split(".")
    compression = COMPRESSIONS.get(parts[-1], "")
    kind = KINDS.get(parts[-2 if compression and len(parts) > 1 else -1], "")
    if kind == "parquet" and compression:
        raise BadTable(f"{quoted(path)}: Parquet is compressed in itself; leave out .{parts[-1]}")
    return FileFormat(kind, compression) if kind else None


def stated(text: str) -> FileFormat:
    """Return the format of `--format`."""
    found = format_of_name(text.lstrip("."))
    if found is None:
        raise BadTable(
            f"--format: {quoted(text)} is none of {', '.join(dict.fromkeys(KINDS.values()))}, or, but for the last, these with .gz or .zst"
        )
    return found


def with_delimiter(word: str, found: FileFormat | None) -> FileFormat:
    """Return the format that `--delimiter` asks for, compressed as the name of the file says."""
    if word not in DELIMITED:
        raise BadTable(f"--delimiter: {quoted(word)} is none of {', '.join(filter(str.isalpha, DELIMITED))}")
    return FileFormat(DELIMITED[word].name, found.compression if found else "")


def compressor(compression: str) -> Callable[[bytes], bytes]:
    """Return a function that compresses a block by itself: compressed blocks behind each other are one file to every reader."""
    if compression == "gzip":
        return _gzip
    if compression == "zstd":
        with missing_extra("zstd"):
            from zstandard import ZstdCompressor
        return ZstdCompressor(level=3).compress
    return bytes


def _gzip(text: bytes) -> bytes:
    return gzip.compress(text, 1, mtime=0)


def decompressed(file: BinaryIO, compression: str, path: str) -> Iterator[bytes]:
    """Iterate over the decompressed bytes of a file, at most CHUNK at a time. Raises BadTable for a damaged file."""
    pieces = _from_gzip if compression == "gzip" else _from_zstd
    try:
        for piece in pieces(file):
            for start in range(0, len(piece), CHUNK):
                yield piece[start : start + CHUNK]
    except (EOFError, zlib.error, gzip.BadGzipFile):
        raise BadTable(f"{quoted(path)} is not what its name says, or its end is missing") from None


def _from_gzip(file: BinaryIO) -> Iterator[bytes]:
    with gzip.open(file, "rb") as stream:
        yield from iter(lambda: stream.read(CHUNK), b"")


def _from_zstd(file: BinaryIO) -> Iterator[bytes]:
    with missing_extra("zstd"):
        from zstandard import ZstdDecompressor, ZstdError
    frame, rest = ZstdDecompressor().decompressobj(), b""
    try:
        while rest or (rest := file.read(FEED)):
            if frame.eof:
                frame = ZstdDecompressor().decompressobj()
            yield frame.decompress(rest)
            rest = frame.unused_data if frame.eof else b""
    except ZstdError:
        raise EOFError from None
    if not frame.eof:
        raise EOFError
