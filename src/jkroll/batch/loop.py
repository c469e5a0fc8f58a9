"""The loop that carries blocks through a converter into the output, in their order, by one process or several.

With several, this process reads. It gives each free process a block, and lets the processes write in the order of the blocks:
the output is the same for any number of them, and no process copies the output of another.
"""

from collections import deque
from collections.abc import Callable, Iterator
from functools import partial
from itertools import islice
from typing import TYPE_CHECKING
from zlib import crc32

from .lines import Converted
from .output import Output, Writer, Written

if TYPE_CHECKING:
    from .workers import Worker

ALONE = 32  # blocks that this process converts before it starts others, which takes 0.2 s

Convert = Callable[[bytes], Converted]
Show = Callable[[], None]


def run(blocks: Iterator[bytes], make: Callable[[], Convert], output: Output, jobs: int, show: Show) -> None:
    """Convert all blocks into the output. `make` returns the function that converts; `show` is called after each block."""
    convert = make()
    for text in islice(blocks, ALONE) if jobs > 1 else blocks:
        converted = convert(text)
        output.check(converted)
        output.note(crc32(text), converted, output.writer.append(converted.output))
        show()
    first = next(blocks, None)
    if first is not None:
        from .workers import started  # with multiprocessing, which a small table does not pay for

        with started(jobs, partial(_ConvertAndWrite, make, output.writer)) as workers:
            _share(first, blocks, workers, output, show)


class _ConvertAndWrite:
    """Answers a block with its counts, and then None, which gives it its turn to write, with what was written."""

    def __init__(self, make: Callable[[], Convert], writer: Writer) -> None:
        self.convert, self.writer = make(), writer
        self.output = b""

    def __call__(self, text: bytes | None) -> Converted | Written:
        if text is None:
            return self.writer.append(self.output)
        converted = self.convert(text)
        self.output = converted.output
        return converted._replace(output=b"")


class _Share:
    """A block that a process has at work."""

    def __init__(self, worker: "Worker", text: bytes) -> None:
        self.worker, self.checksum = worker, crc32(text)
        self.converted: Converted | None = None
        self.has_turn = False
        worker.ask(text)


def _share(first: bytes, blocks: Iterator[bytes], workers: "list[Worker]", output: Output, show: Show) -> None:
    from .workers import answered

    text: bytes | None = first
    free = [*workers]
    shares: deque[_Share] = deque()  # in the order of the blocks
    while True:
        while free and text is not None:
            shares.append(_Share(free.pop(), text))
            text = next(blocks, None)
        if not shares:
            return
        for worker in answered([share.worker for share in shares]):
            share = next(share for share in shares if share.worker is worker)
            if share.converted is None:
                share.converted = worker.answer()
            else:
                output.note(share.checksum, share.converted, worker.answer())
                shares.popleft()
                free.append(worker)
                show()
        if shares and (converted := shares[0].converted) is not None and not shares[0].has_turn:
            output.check(converted)
            shares[0].has_turn = True
            shares[0].worker.ask(None)
