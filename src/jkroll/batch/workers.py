"""Processes that answer questions. Each gets a question over a pipe of its own and sends back an answer or an error.

A process ends when the other end of its pipe is closed, that is, with the process that started it. No lock is shared, so a
process may be ended at any moment.
"""

import copyreg
import gc
import signal
import sys
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from itertools import cycle
from multiprocessing import connection, get_context, resource_tracker
from types import MappingProxyType, ModuleType
from typing import Any

from .errors import LostWorker

CONTEXT = get_context("spawn")  # safe beside threads, and the same on every system


def _read_only(values: dict[str, Any]) -> MappingProxyType[str, Any]:
    return MappingProxyType(values)


# The properties of materials are read-only mappings, which do not pickle by themselves.
copyreg.pickle(MappingProxyType, lambda mapping: (_read_only, (dict(mapping),)))

Answer = Callable[[Any], Any]


class Worker:
    """A process that answers questions."""

    def __init__(self, make_answer: Callable[[], Answer]) -> None:
        """Start it. `make_answer`, called in the process, returns the function that answers."""
        self.connection, end = CONTEXT.Pipe()
        self.process = CONTEXT.Process(target=_serve, args=(end, make_answer), daemon=True)
        self.process.start()
        end.close()

    def ask(self, question: Any) -> None:
        """Send a question."""
        with suppress(BrokenPipeError, ConnectionResetError):  # a process that was ended is noticed by its answer
            self.connection.send(question)

    def answer(self) -> Any:
        """Return the answer to the last question, or raise its error; LostWorker if the process was ended."""
        try:
            found = self.connection.recv()
        except (EOFError, ConnectionResetError):
            self.process.join()
            raise LostWorker(self.process.exitcode or 0) from None
        if isinstance(found, BaseException):
            raise found
        return found

    def end(self) -> None:
        """End the process at once."""
        self.process.kill()
        self.process.join()
        self.connection.close()


def _serve(questions: "connection.Connection[Any, Any]", make_answer: Callable[[], Answer]) -> None:
    gc.disable()  # a block leaves no cycles, and to look for them takes a microsecond a row
    answer: Answer | None = None
    with suppress(EOFError, BrokenPipeError, ConnectionResetError):
        while True:
            question = questions.recv()
            found: Any
            try:
                answer = answer or make_answer()
                found = answer(question)
            except Exception as error:
                found = error
            questions.send(found)


@contextmanager
def started(count: int, make_answer: Callable[[], Answer]) -> Iterator[list[Worker]]:
    """Start processes, and end them at the end."""
    workers: list[Worker] = []
    try:
        with _interrupts_held(), _main_hidden():
            while len(workers) < count:
                workers.append(Worker(make_answer))
        yield workers
    finally:
        for worker in workers:
            worker.end()


@contextmanager
def _interrupts_held() -> Iterator[None]:
    """Hold interrupts back. Processes started meanwhile never get them: the process that started them ends them."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    resource_tracker.ensure_running()  # it would release the interrupts when it is started with the first process
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def _main_hidden() -> Iterator[None]:
    """Hide the main script. A process would run it again, and nothing of it is needed there."""
    main = sys.modules["__main__"]
    sys.modules["__main__"] = ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = main


def in_order(workers: list[Worker], questions: Iterable[Any]) -> Iterator[tuple[Any, Any]]:
    """Iterate over questions and their answers, in the order of the questions. Each process has one at work."""
    at_work: deque[tuple[Worker, Any]] = deque()
    for worker, question in zip(cycle(workers), questions, strict=False):
        if len(at_work) == len(workers):
            first, asked = at_work.popleft()
            yield asked, first.answer()
        worker.ask(question)
        at_work.append((worker, question))
    for worker, asked in at_work:
        yield asked, worker.answer()


def as_ready(workers: list[Worker], questions: Iterable[Any]) -> Iterator[tuple[Any, Any]]:
    """Iterate over questions and their answers, each as soon as it is there."""
    left = iter(questions)
    at_work: dict[object, tuple[Worker, Any]] = {}  # by the connection
    free = [*workers]
    while True:
        for worker, question in zip(free, left, strict=False):
            worker.ask(question)
            at_work[worker.connection] = (worker, question)
        if not at_work:
            return
        free = []
        for ready in connection.wait([worker.connection for worker, _ in at_work.values()]):
            worker, question = at_work.pop(ready)
            free.append(worker)
            yield question, worker.answer()
