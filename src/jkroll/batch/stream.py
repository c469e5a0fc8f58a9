"""A table whose records are lines, from a file or a pipe, block by block into another."""

import os
import signal
import sys
from collections.abc import Callable
from contextlib import closing, suppress
from functools import partial

from .. import __version__
from ..errors import BadRequest
from ..quantities.nomenclature import header
from ..text import quoted
from . import ring
from .columns import check_first
from .delimited import DIALECTS
from .errors import BadTable
from .files import check_output, feed, identity_of, opened, size_of
from .formats import compressor, decompressed
from .lines import Converted, LineFormat
from .ndjson import Ndjson
from .output import FileSink, Sink, fingerprint
from .progress import watched
from .settings import Order, Tally, input_format, output_format
from .source import CHUNK, Shared, Source
from .spans import Span
from .task import understood_task

FORMATS: dict[str, LineFormat] = {**DIALECTS, "ndjson": Ndjson()}


def convert(path: str, order: Order, span: Span | None = None) -> Tally:
    """Convert a table of lines, or a part of it."""
    return _Stream(path, order).run(span)


class _Stream:
    """One run over one table."""

    def __init__(self, path: str, order: Order) -> None:
        self.path, self.order, self.settings = path, order, order.settings
        self.shared = Shared()
        self.feeder = 0

    def run(self, span: Span | None) -> Tally:
        """Convert it."""
        form = input_format(self.path, self.settings)
        kind = FORMATS[form.kind]
        compress = compressor(output_format(self.settings, form).compression)
        descriptor = opened(self.path)
        check_output(descriptor, self.settings.target)
        total = 0 if form.compression or span else size_of(descriptor)
        identity = identity_of(descriptor)
        if form.compression:
            compressor(form.compression)  # if a library is missing, it is missed here
            descriptor, self.feeder = feed(descriptor, partial(decompressed, compression=form.compression))
        elif span:
            descriptor, self.feeder = feed(descriptor, span.read)
        try:
            source = Source(descriptor, lambda text, is_end: kind.cut(text, is_end=is_end), self.shared)
            head = kind.head(source.head())
            source.skip(len(head.text))
            table, task = understood_task(head.names, self.order)
            for column in table.inputs:
                check_first(column, [row[column.place] for row in head.sample])
            names = [header(name) for name in task.quantities]
            converter = kind.converter(head, table, task, names, excel_safe=self.settings.excel_safe)

            def converted(text: bytes) -> Converted:
                block = converter.convert(text)
                return block._replace(output=compress(block.output))

            with closing(self._sink()) as sink:
                if not (isinstance(sink, FileSink) and self._goes_on(sink, identity, head.text, source)):
                    sink.head(head.text, compress(converter.head) if converter.head else b"", head.text.count(b"\n"))
                self._convert(source, converted, sink, total)
                sink.finish()
        finally:
            self._stop_feeder()
            os.close(descriptor)
        return Tally(self.shared["rows"], self.shared["failed"])

    def _goes_on(self, sink: FileSink, identity: list[int], head: bytes, source: Source) -> bool:
        """Go on from an interrupted run if that is asked for; else begin."""
        parts = fingerprint(self.order.parts([__version__, CHUNK], identity))
        if self.settings.resume and sink.resume(parts, head, source):
            return True
        sink.begin(parts)
        return False

    def _convert(self, source: Source, converted: Callable[[bytes], Converted], sink: Sink, total: int) -> None:
        """Run the processes, with a bar on a terminal."""
        goes_on = isinstance(sink, FileSink)
        with watched(self.shared, total, is_quiet=self.settings.quiet, goes_on=goes_on) as show:
            ring.run(source, converted, sink, self.settings.processes, show)
            if self.feeder:
                _, status = os.waitpid(self.feeder, 0)
                self.feeder = 0
                if status:
                    raise BadTable(f"{quoted(self.path)} is not what its name says, or its end is missing")

    def _stop_feeder(self) -> None:
        if self.feeder:
            with suppress(ProcessLookupError):
                os.kill(self.feeder, signal.SIGKILL)
            os.waitpid(self.feeder, 0)

    def _sink(self) -> Sink:
        """Where the output goes."""
        path = self.settings.target
        if path == "-":
            if self.settings.resume:
                raise BadRequest("--resume needs a file to go on with: -o FILE")
            sys.stdout.flush()
            return Sink(os.dup(sys.stdout.fileno()), self.shared, strict=self.settings.strict)
        if os.path.exists(path) and not os.path.isfile(path):
            if os.path.isdir(path):
                raise BadRequest(f"-o: {quoted(path)} is a directory")
            return Sink(os.open(path, os.O_WRONLY), self.shared, strict=self.settings.strict)
        return FileSink(path, self.shared, strict=self.settings.strict)
