"""The loop of all tables of lines: blocks of records through a converter into the output, in their order.

This process reads, and says in which order is written. Where there are many blocks, others convert and write them; the output is the
same for any number of them.
"""

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from itertools import chain, islice
from typing import Any, NamedTuple

from ..table.blocks import Tally
from ..table.errors import BadRow
from .lines import Converted
from .output import Fetch, Step, output_to, step_of
from .progress import Bar
from .settings import Settings

ALONE = 16  # blocks that this process converts before it starts others

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


def run(work: Work, settings: Settings) -> Tally:
    """Write a table, or the rest of it with `--resume`; return the counts of all of it."""
    with output_to(settings) as output, Bar(work.total, quiet=settings.quiet) as bar:
        if not (settings.resume and output.resume(work.identity, work.read, work.blocks)):
            output.begin(work.identity, work.read, work.head)
        try:
            for step, fetch in _converted(work, settings.processes, output.path):
                output.take(step, fetch)
                bar.show(work.position() if work.position else output.done.rows, output.done.rows)
        except BadRow as error:
            raise BadRow(output.done.lines + 1 + error.line, error.status) from None
    return output.tally


def _converted(work: Work, jobs: int, path: str) -> Iterator[tuple[Step, Fetch]]:
    """Iterate over converted blocks in their order. `path`: of the file into which they go, or an empty text."""
    convert = work.make_convert()

    def here(text: bytes) -> tuple[Step, Fetch]:
        converted = convert(text)
        return step_of(text, converted), lambda _: converted.output

    yield from map(here, islice(work.blocks, ALONE) if jobs > 1 else work.blocks)
    first = next(work.blocks, None)
    if first is None:
        return
    from .workers import are_ready, in_order, started  # with multiprocessing, which a small table does not pay for

    blocks = chain([first], work.blocks)
    with started(jobs, partial(_answering, work.make_convert, path)) as workers:
        while not are_ready(workers) and (text := next(blocks, None)) is not None:
            yield here(text)
        for worker, step in in_order(workers, blocks):
            yield step, worker.answer_to


def _answering(make_convert: Callable[[], Convert], path: str) -> Callable[[bytes | int], Any]:
    """Return what a process does: it converts a block, and puts it at a place of the file or hands it over when its turn comes.

    To send a block to another process takes a third as long as to make it.
    """
    convert = make_convert()
    output = b""

    def answer(question: bytes | int) -> Any:
        nonlocal output
        if isinstance(question, bytes):
            converted = convert(question)
            output = converted.output
            return step_of(question, converted)
        if not path:
            return output
        with open(path, "r+b") as file:
            file.seek(question)
            file.write(output)
        return b""

    return answer
