"""Processes that answer questions. Each gets a question over a pipe of its own and sends back an answer or an error.

A process ends with the one that started it, at once. No lock is shared, so a process may be ended at any moment.
"""

import gc
import os
import signal
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from itertools import cycle
from multiprocessing import connection, get_context, parent_process, resource_tracker
from threading import Thread
from typing import Any

from ..errors import JkrollError
from ..output.writers import SIGNALS

PATIENCE = 5.0  # seconds for a process to remove what it has begun
CONTEXT = get_context("spawn")  # safe beside threads, and the same on every system
Answer = Callable[[Any], Any]


class LostWorker(JkrollError):
    """Error raised when a process is ended from outside."""

    exit_code = 1


class Worker:
    """A process that answers questions."""

    def __init__(self, answer: Answer) -> None:
        """Start it. `answer`: the function that it calls."""
        self.connection, end = CONTEXT.Pipe()
        self.process = CONTEXT.Process(target=_serve, args=(end, answer), daemon=True)
        self.process.start()
        end.close()

    def answer(self) -> Any:
        """Return the answer to the last question, or raise its error; LostWorker if the process was ended."""
        try:
            answer = self.connection.recv()
        except (EOFError, ConnectionError):
            self.process.join()
            code = self.process.exitcode or 0
            how = f"was ended by signal {-code}" if code < 0 else f"ended with exit code {code}"
            raise LostWorker(f"a worker process {how}; the table it was working on was not written") from None
        if isinstance(answer, Exception):
            raise answer
        return answer

    def end(self) -> None:
        """Wait for the end of the process, which was told to end; kill it if it does not."""
        self.process.join(PATIENCE)
        self.process.kill()
        self.process.join()
        self.connection.close()


def _serve(questions: "connection.Connection[Any, Any]", answer: Answer) -> None:
    _mask("SIG_UNBLOCK", {*SIGNALS} - {signal.SIGINT})
    Thread(target=_end_with_parent, daemon=True).start()
    gc.disable()  # a block leaves no cycles, and to look for them takes a microsecond a row
    with suppress(EOFError, ConnectionError):
        while True:
            questions.send(_outcome(answer, questions.recv()))  # nothing of a block is kept beside the next one
    os._exit(0)  # an orderly shutdown of the interpreter would take longer than most tables


def _outcome(answer: Answer, question: Any) -> Any:
    """Return the answer to a question, or its error."""
    try:
        return answer(question)
    except Exception as error:
        return error


def _end_with_parent() -> None:
    """End this process when the one that started it has ended: nobody waits for its answers."""
    parent = parent_process()
    if parent is not None:
        parent.join()
        os.kill(os.getpid(), signal.SIGTERM)  # which removes a file that was begun


def _mask(how: str, numbers: Iterable[int]) -> None:
    """Block or unblock signals, for processes that are started too: a blocked one waits. Windows has no such thing."""
    if hasattr(signal, "pthread_sigmask"):
        resource_tracker.ensure_running()  # its start unblocks some
        signal.pthread_sigmask(getattr(signal, how), numbers)


def answers(count: int, answer: Answer, questions: Iterable[Any]) -> Iterator[Any]:
    """Iterate over the answers of some processes in the order of the questions.

    No interrupt reaches them: they end with the iteration.
    """
    workers: list[Worker] = []
    at_work: deque[Worker] = deque()
    try:
        _mask("SIG_BLOCK", SIGNALS)  # a process that starts would say that it was struck
        try:
            while len(workers) < count:
                workers.append(Worker(answer))
        finally:
            _mask("SIG_UNBLOCK", SIGNALS)
        for worker, question in zip(cycle(workers), questions, strict=False):
            if len(at_work) == count:
                yield at_work.popleft().answer()
            with suppress(ConnectionError):  # a process that was ended is noticed by its answer
                worker.connection.send(question)
            at_work.append(worker)
        for worker in at_work:
            yield worker.answer()
    finally:
        for worker in workers:
            worker.process.terminate()
        for worker in workers:
            worker.end()
