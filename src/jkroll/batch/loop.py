"""The loop of all tables of lines: blocks of records through a converter into the output, in their order.

This process reads and writes. Where there are many blocks, others convert them; the output is the same for any number of them.
"""

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from itertools import chain, islice
from typing import NamedTuple

from .lines import Converted
from .output import Output
from .progress import watched
from .settings import Settings

ALONE = 64  # blocks that this process converts before it starts others, which takes 0.2 s

Convert = Callable[[bytes], Converted]


class Work(NamedTuple):
    """A table to convert."""

    identity: Mapping[str, str]  # a hash of each part that the output depends on
    read: bytes  # the header as read
    head: Converted  # what it becomes
    blocks: Iterator[bytes]
    make_convert: Callable[[], Convert]  # called in each process
    total: int  # the position at the end, or 0 if it is unknown
    position: Callable[[], int] | None = None  # None: the rows


def run(work: Work, output: Output, settings: Settings) -> None:
    """Write a table, or the rest of it with `--resume`."""
    if not (settings.resume and output.resume(work.identity, work.read, work.blocks)):
        output.begin(work.identity, work.read, work.head)

    def counts() -> tuple[int, int]:
        return work.position() if work.position else output.done.rows, output.done.rows

    with watched(work.total, counts, settings, goes_on=output.goes_on) as show:
        for text, converted in _converted(work, settings.processes):
            output.take(text, converted)
            show()


def _converted(work: Work, jobs: int) -> Iterator[tuple[bytes, Converted]]:
    """Iterate over blocks as read and as converted, in their order."""
    convert = work.make_convert()
    for text in islice(work.blocks, ALONE) if jobs > 1 else work.blocks:
        yield text, convert(text)
    first = next(work.blocks, None)
    if first is not None:
        from .workers import in_order, started  # with multiprocessing, which a small table does not pay for

        with started(jobs, partial(_answering, work.make_convert)) as workers:
            for text, (converted, output) in in_order(workers, chain([first], work.blocks)):
                yield text, converted._replace(output=output)


def _answering(make_convert: Callable[[], Convert]) -> Callable[[bytes], tuple[Converted, bytes]]:
    """Return a converter whose output stands apart from the counts."""
    convert = make_convert()

    def answer(text: bytes) -> tuple[Converted, bytes]:
        converted = convert(text)
        return converted._replace(output=b""), converted.output

    return answer
