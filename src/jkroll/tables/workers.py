"""Worker processes. Each worker receives questions over its own pipe and sends back answers or errors.

A worker ends as soon as its parent process does. Workers share no lock, so each may be killed at any moment.
"""

import gc
import os
import signal
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from itertools import cycle
from multiprocessing import get_context, parent_process, resource_tracker
from threading import Thread
from typing import Any

from ..errors import JkrollError
from ..write.output_file import SIGNALS

Answer = Callable[[Any], Any]


class LostWorker(JkrollError):
    """Error raised when a worker is lost or cannot be started."""

    exit_code = 1


def _serve(questions: Any, answer: Answer) -> None:
    """Answer the questions from a pipe until it is closed."""
    _mask("SIG_UNBLOCK", {*SIGNALS} - {signal.SIGINT})
    Thread(target=_end_with_parent, daemon=True).start()
    gc.disable()  # a block leaves no cycles, and the search for them takes a microsecond for each row
    with suppress(EOFError, ConnectionError):
        while True:
            questions.send(_outcome(answer, questions.recv()))  # no variable keeps a block until the next one
    os._exit(0)  # an orderly shutdown of the interpreter would take longer than most tables


def _outcome(answer: Answer, question: Any) -> Any:
    """Return the answer to a question, or its error."""
    try:
        return answer(question)
    except Exception as error:
        return error


def _end_with_parent() -> None:
    """End this process when its parent has ended, since nobody waits for answers any more."""
    parent = parent_process()
    if parent is not None:
        parent.join()
        os.kill(os.getpid(), signal.SIGTERM)  # the handler removes a temporary file


def _mask(how: str, numbers: Iterable[int]) -> None:
    """Block or unblock signals, also in processes started later. A blocked signal waits. On Windows, do nothing."""
    if hasattr(signal, "pthread_sigmask"):
        resource_tracker.ensure_running()  # starting it unblocks some signals
        signal.pthread_sigmask(getattr(signal, how), numbers)


def answers(count: int, answer: Answer, questions: Iterable[Any]) -> Iterator[Any]:
    """Iterate over the answers of workers in the order of the questions. Raises LostWorker, or the error of a worker.

    Workers ignore interrupts, and end with the iteration.
    """
    context = get_context("spawn")  # safe with threads, and the same on every system
    processes = dict[Any, Any]()  # by pipe
    asked = deque[Any]()  # pipes with an open question
    try:
        _mask("SIG_BLOCK", SIGNALS)  # a process interrupted while it starts would print a traceback
        try:
            for _ in range(count):
                pipe, end = context.Pipe()
                process = context.Process(target=_serve, args=(end, answer), daemon=True)
                process.start()
                end.close()
                processes[pipe] = process
        except OSError as error:
            raise LostWorker(f"processes cannot be started: {error.strerror}; --jobs 1 starts none") from None
        finally:
            _mask("SIG_UNBLOCK", SIGNALS)
        for pipe, question in zip(cycle([*processes]), questions, strict=False):
            if len(asked) == count:
                yield _answer(asked.popleft())
            pipe.send(question)
            asked.append(pipe)
        while asked:
            yield _answer(asked.popleft())
    except (EOFError, ConnectionError):
        raise LostWorker("a worker process was ended from outside; its table was not written") from None
    finally:
        for process in processes.values():
            process.terminate()
        for process in processes.values():
            process.join()  # a terminated process removes its temporary files


def _answer(pipe: Any) -> Any:
    """Return the next answer from a pipe. Raises the answer if it is an error."""
    answer = pipe.recv()
    if isinstance(answer, Exception):
        raise answer
    return answer
