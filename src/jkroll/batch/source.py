"""A stream of bytes as blocks of whole records, cut at the same places whoever reads them."""

import mmap
import os
from collections.abc import Callable

from .errors import BadTable

CHUNK = 1 << 18  # bytes read at a time: enough rows to pay for a call of numpy, few enough to stay in the cache
MAX_RECORD = 1 << 24
COUNTERS = ("kept", "ended", "read", "written", "rows", "failed", "lines")

Cut = Callable[[bytes, bool], int]  # how many bytes of a text are whole records; all of them at the end


class Shared:
    """Counters, and the beginning of a record that a block left over, in memory that processes share."""

    def __init__(self) -> None:
        """All counters at 0."""
        self._memory = mmap.mmap(-1, 8 * len(COUNTERS) + MAX_RECORD + CHUNK)
        self._counters = memoryview(self._memory)[: 8 * len(COUNTERS)].cast("q")

    def __getitem__(self, name: str) -> int:
        return self._counters[COUNTERS.index(name)]

    def __setitem__(self, name: str, value: int) -> None:
        self._counters[COUNTERS.index(name)] = value

    @property
    def kept(self) -> bytes:
        """What was left over."""
        start = 8 * len(COUNTERS)
        return self._memory[start : start + self["kept"]]

    @kept.setter
    def kept(self, text: bytes) -> None:
        start = 8 * len(COUNTERS)
        self._memory[start : start + len(text)] = text
        self["kept"] = len(text)


class Source:
    """Blocks from a file or a pipe. Processes that share it read in turn."""

    def __init__(self, descriptor: int, cut: Cut, shared: Shared) -> None:
        """`cut`: where records end."""
        self.descriptor = descriptor
        self.cut = cut
        self.shared = shared

    def next(self) -> bytes | None:
        """The next block; None at the end."""
        text = self.shared.kept
        while not self.shared["ended"]:
            chunk = self._chunk()
            text += chunk
            if len(chunk) < CHUNK:
                self.shared["ended"] = 1
                break
            size = self.cut(text, False)
            if size:
                self.shared.kept = text[size:]
                return text[:size]
            if len(text) > MAX_RECORD:
                raise BadTable(
                    f"line {self.shared['lines'] + 1} or a later one is longer than {MAX_RECORD >> 20} MiB: this is no table"
                )
        size = min(len(text), self.cut(text[: CHUNK * 2], len(text) <= CHUNK * 2)) or len(text)
        self.shared.kept = text[size:]
        return text[:size] or None

    def _chunk(self) -> bytes:
        """The next bytes, as many as are wanted unless the stream ends."""
        pieces = []
        missing = CHUNK
        while missing and (piece := os.read(self.descriptor, missing)):
            pieces.append(piece)
            missing -= len(piece)
            self.shared["read"] += len(piece)
        return b"".join(pieces)

    def head(self) -> bytes:
        """The first block, to be looked at: it comes again."""
        text = self.next() or b""
        self.shared.kept = text + self.shared.kept
        return text

    def skip(self, size: int) -> None:
        """Leave out the first bytes of what comes."""
        self.shared.kept = self.shared.kept[size:]


def cut_at_line_ends(text: bytes, is_end: bool) -> int:
    """How many bytes of a text are whole lines."""
    return len(text) if is_end else text.rfind(b"\n") + 1
