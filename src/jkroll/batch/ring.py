"""Several processes at one stream: each reads a block in its turn, converts it, and writes it in its turn.

So the output is in the order of the input, the same for any number of processes, and no process copies what another
made. A turn is a byte in a pipe. The process that was called only watches, and ends the others when one fails.
"""

import gc
import os
import pickle
import select
import signal
import time
from collections.abc import Callable
from contextlib import suppress
from typing import NoReturn

from .errors import LostWorker
from .lines import Converted
from .output import Blocks, Sink

TICK = 0.2  # seconds between two looks at how far it is
KEPT = 1 << 25  # bytes that a process does not give back
LARGE = 1 << 22  # bytes that it always gives back
_TRIM_THRESHOLD, _MMAP_THRESHOLD = -1, -3  # <malloc.h>
_SET_SIGNAL_OF_PARENTS_DEATH = 1  # <sys/prctl.h>
Watch = Callable[[], None]


def run(
    source: Blocks, convert: Callable[[bytes], Converted], sink: Sink, jobs: int, watch: Watch, large: int = LARGE
) -> None:
    """Convert all blocks of a source into a sink; `watch` is called now and then. `large`: more than a block takes at once."""
    _keep_memory(large)
    gc.collect()
    gc.freeze()
    gc.disable()
    try:
        if jobs == 1 or not hasattr(os, "fork"):
            _alone(source, convert, sink, watch)
        else:
            _Ring(jobs).run(source, convert, sink, watch)
    finally:
        gc.enable()
        gc.unfreeze()


def _keep_memory(large: int) -> None:
    """Have glibc keep the memory that a block gives back, or each block would be faulted in anew: 0.3 pages a row.

    But not what is large: it would lie scattered among what is small, and ever more of it.
    """
    _call_c("mallopt", _TRIM_THRESHOLD, KEPT)
    _call_c("mallopt", _MMAP_THRESHOLD, large)


def _end_with_parent() -> None:
    """Have Linux end this process as soon as its parent is ended, in the middle of a block too."""
    _call_c("prctl", _SET_SIGNAL_OF_PARENTS_DEATH, signal.SIGKILL)


def _call_c(name: str, *arguments: int) -> None:
    """Call a function of the C library, if it has it."""
    with suppress(ImportError, AttributeError, OSError, TypeError):
        import ctypes

        ctypes.CDLL(None)[name](*arguments)


def _alone(source: Blocks, convert: Callable[[bytes], Converted], sink: Sink, watch: Watch) -> None:
    looked = time.monotonic()
    while (text := source.next()) is not None:
        sink.write(text, convert(text))
        if time.monotonic() - looked > TICK:
            looked = time.monotonic()
            watch()


class _Ring:
    """Processes in a circle, with a pipe to each for its turn to read and one for its turn to write."""

    def __init__(self, jobs: int) -> None:
        """`jobs`: how many."""
        self.reading = [os.pipe() for _ in range(jobs)]
        self.writing = [os.pipe() for _ in range(jobs)]
        self.reports = os.pipe()
        self.processes: list[int] = []

    def run(self, source: Blocks, convert: Callable[[bytes], Converted], sink: Sink, watch: Watch) -> None:
        """Start the processes and wait for them."""
        parent = os.getpid()
        try:
            for place in range(len(self.reading)):
                process = os.fork()
                if not process:
                    self._work(place, parent, source, convert, sink)
                self.processes.append(process)
            os.write(self.reading[0][1], b".")
            os.write(self.writing[0][1], b".")
            os.close(self.reports[1])
            self._wait(watch)
        finally:
            for process in self.processes:
                with suppress(ProcessLookupError):
                    os.kill(process, signal.SIGKILL)
                os.waitpid(process, 0)
            for pipe in (*self.reading, *self.writing):
                os.close(pipe[0])
                os.close(pipe[1])
            os.close(self.reports[0])

    def _work(
        self, place: int, parent: int, source: Blocks, convert: Callable[[bytes], Converted], sink: Sink
    ) -> NoReturn:
        """One of the processes: it never returns."""
        try:
            signal.signal(signal.SIGINT, signal.SIG_IGN)
            _end_with_parent()
            os.close(self.reports[0])
            after = (place + 1) % len(self.reading)
            while True:
                _turn(self.reading[place][0], parent)
                text = source.next()
                os.write(self.reading[after][1], b".")
                if text is None:
                    break
                converted = convert(text)
                _turn(self.writing[place][0], parent)
                sink.write(text, converted)
                os.write(self.writing[after][1], b".")
        except BaseException as error:
            os.write(self.reports[1], pickle.dumps(error))
            os._exit(1)
        os._exit(0)

    def _wait(self, watch: Watch) -> None:
        """Until all processes ended well; else raise what one of them raised."""
        while not select.select([self.reports[0]], [], [], TICK)[0]:
            watch()
            self._reap()
        report = b""
        while piece := os.read(self.reports[0], 1 << 16):
            report += piece
            break
        if report:
            error: BaseException = pickle.loads(report)
            raise error
        while self.processes:
            _check(os.waitpid(self.processes.pop(), 0)[1])

    def _reap(self) -> None:
        """Notice a process that was ended from outside."""
        for process in [*self.processes]:
            ended, status = os.waitpid(process, os.WNOHANG)
            if ended:
                self.processes.remove(process)
                _check(status)


def _turn(pipe: int, parent: int) -> None:
    """Wait for a turn. If the parent was killed there is none: another run may be about to go on from here."""
    while not select.select([pipe], [], [], TICK)[0]:
        if os.getppid() != parent:
            os._exit(1)
    os.read(pipe, 1)
    if os.getppid() != parent:
        os._exit(1)


def _check(status: int) -> None:
    if os.WIFSIGNALED(status):
        raise LostWorker(os.WTERMSIG(status))
