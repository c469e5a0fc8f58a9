"""The loop of all tables of lines: blocks of records through a converter into the output, in their order.

This process reads the blocks and decides the order in which they are written. Where there are many blocks, others
convert and write them; the output is the same for any number of them.
"""

import os
import sys
from collections.abc import Callable, Iterator
from functools import partial
from itertools import chain, islice
from typing import TYPE_CHECKING, BinaryIO, NamedTuple

from ..errors import BadRow
from ..text import say
from .files import output_to
from .job import Settings
from .lines import Converted, Tally
from .progress import Bar

if TYPE_CHECKING:
    from .workers import Worker

ALONE = 4  # blocks that this process converts before it starts others

Convert = Callable[[bytes], Converted]


class Work(NamedTuple):
    """A table to convert."""

    header_line: bytes  # what the header becomes
    lines_of_header: int  # of the header as read
    blocks: Iterator[bytes]
    make_convert: Callable[[], Convert]  # called in each process
    size: int  # bytes of the input, or 0 if that is unknown
    position: Callable[[], int]  # bytes read so far


def run(work: Work, settings: Settings) -> Tally:
    """Write a table; return the counts of all of it."""
    size, lines, tally = len(work.header_line), work.lines_of_header, Tally()
    with output_to(settings.target) as output, Bar(work.size, quiet=settings.quiet) as bar:
        try:
            _write(output, work.header_line)
            for block, worker in _converted(work, settings.processes, _path(output)):
                _write(output, worker.answer_to(size) if worker else block.output)
                size += block.size or len(block.output)
                lines += block.lines
                tally = tally.plus(block.tally)
                bar.show(work.position(), tally.rows)
        except BadRow as error:
            raise BadRow(lines + 1 + error.line, error.status) from None
        except KeyboardInterrupt:
            say(f"jkroll: interrupted after {tally.rows} rows", sys.stderr)
            raise
    return tally


def _write(output: BinaryIO, text: bytes) -> None:
    rest = memoryview(text)
    while rest:
        rest = rest[os.write(output.fileno(), rest) :]


def _path(output: BinaryIO) -> str:
    """Return the path of a file that processes can write into; an empty text for a stream."""
    return output.name if isinstance(output.name, str) and os.path.isfile(output.name) else ""


def _converted(work: Work, processes: int, path: str) -> "Iterator[tuple[Converted, Worker | None]]":
    """Iterate over converted blocks in their order, each with the process that holds its output, if another one does.

    `path`: of the file into which they go, or an empty text.
    """
    convert = work.make_convert()
    for text in islice(work.blocks, ALONE) if processes > 1 else work.blocks:
        yield convert(text), None
    first = next(work.blocks, None)
    if first is None:
        return
    # They come with multiprocessing, which a small table does not pay for.
    from .workers import answers_in_order, are_ready, started

    blocks = chain([first], work.blocks)
    with started(processes, partial(_answering, work.make_convert, path)) as workers:
        while not are_ready(workers) and (text := next(blocks, b"")):
            yield convert(text), None
        for worker, block in answers_in_order(workers, blocks):
            yield block, worker


def _answering(make_convert: Callable[[], Convert], path: str) -> Callable[[bytes | int], Converted | bytes]:
    """Return what a process does with a block, and then with the place at which the output begins.

    It converts the block; when its turn comes, it writes the output there, or hands it over if there is no file.

    To send a block to another process takes a third as long as to make it.
    """
    convert = make_convert()
    output = b""

    def answer(question: bytes | int) -> Converted | bytes:
        nonlocal output
        if isinstance(question, bytes):
            converted = convert(question)
            output = converted.output
            return converted._replace(output=b"", size=len(output))
        if not path:
            return output
        with open(path, "r+b") as file:
            file.seek(question)
            file.write(output)
        return b""

    return answer
