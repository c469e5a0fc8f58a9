"""The `batch` command: from what was typed to a table with results."""

import errno
import os
import signal
import stat
import sys
from collections.abc import Mapping
from contextlib import suppress
from typing import Any, NamedTuple

from .. import __version__
from ..commands import COMMANDS
from ..errors import MissingInput, UnknownQuantity, quoted
from ..materials import Material, Materials, known_materials
from ..nomenclature import NOMENCLATURE, header
from ..request import BadRequest, materials_files
from ..scene import EXCLUSIVE, Scene
from ..streams import say
from ..units import parse_quantity
from ..wiring import PROPERTIES
from . import ring
from .columns import MATERIALS, STATUS, Header, check_first, understood
from .delimited import DIALECTS, Converter, Dialect
from .errors import BadTable
from .formats import Format, compressor, decompressed, format_of, stated
from .output import FileSink, Sink, fingerprint
from .progress import Bar
from .rows import Task, concerns
from .source import CHUNK, Shared, Source

BOM = b"\xef\xbb\xbf"
UTF_16 = (b"\xff\xfe", b"\xfe\xff")
ROWS_FAILED = 1


class Settings(NamedTuple):
    """What the options say."""

    target: str = "-"
    format: str = ""
    quantities: str = ""
    strict: bool = False
    resume: bool = False
    jobs: int = 0
    excel_safe: bool = False
    materials: str | None = None
    quiet: bool = False


def run(path: str | None, given: Mapping[str, Any]) -> int:
    """Convert a table; return the exit code."""
    if path is None:
        raise BadRequest("batch needs a table, such as grains.csv, or - for what comes in")
    settings = Settings(**{name: value for name, value in given.items() if name in Settings._fields})
    inputs = {name: value for name, value in given.items() if name not in Settings._fields}
    known = known_materials(*materials_files(settings.materials))
    return _Run(path, settings, inputs, known).run()


class _Run:
    """One run over one table."""

    def __init__(self, path: str, settings: Settings, inputs: Mapping[str, str], known: Materials) -> None:
        self.path, self.settings, self.known = path, settings, known
        self.inputs = inputs
        self.format = _format(path, settings)
        self.shared = Shared()
        self.feeder = 0

    def run(self) -> int:
        """Convert it."""
        dialect = DIALECTS[self.format.kind]
        descriptor = _opened(self.path)
        _check_output(descriptor, self.settings)
        total = _size(descriptor) if not self.format.compression else 0
        identity = _identity(descriptor)
        compress = compressor(_output_format(self.settings, self.format).compression)
        if self.format.compression:
            descriptor = self._feed(descriptor)
        source = Source(descriptor, lambda text, is_end: _cut(dialect, text, is_end), self.shared)
        head, line, table = _header(source, dialect)
        task = _task(table, self.inputs, self.settings.quantities, self.known)
        taken = {header(name) for name in task.quantities} | {STATUS}
        for text in table.texts:
            if text.strip() in taken:
                raise BadTable(f"header: there is a column {quoted(text)} already; rename it, or choose --quantities")
        line_end = b"\r\n" if head.endswith(b"\r\n") else b"\n"
        converter = Converter(dialect, table, task, line_end, excel_safe=self.settings.excel_safe)
        first = (BOM if head.startswith(BOM) else b"") + converter.header_line(
            line, [header(name) for name in task.quantities]
        )

        def convert(text: bytes) -> Any:
            converted = converter.convert(text)
            return converted._replace(output=compress(converted.output))

        self._note_passing(table)
        sink = self._sink()
        is_resumed = False
        if isinstance(sink, FileSink):
            parts = {
                "version": __version__,
                "input": identity,
                "options": [
                    self.settings._replace(resume=False, jobs=0, quiet=False, target=""),
                    dict(self.inputs),
                    CHUNK,
                ],
                "materials file": [*map(str, self.known.materials.items())],
            }
            if self.settings.resume:
                is_resumed = sink.resume(fingerprint(parts), head, source)
            if not is_resumed:
                sink.begin(fingerprint(parts))
        if not is_resumed:
            self.shared["written"] = 0
            sink.head(head, compress(first), head.count(b"\n") or 1)
        self._convert(source, convert, sink, total)
        sink.finish()
        return self._end()

    def _convert(self, source: Source, convert: Any, sink: Sink, total: int) -> None:
        """Run the processes, with a bar on a terminal."""
        bar = Bar(sys.stderr, self.shared, total)
        is_watched = sys.stderr.isatty() and not self.settings.quiet
        try:
            ring.run(
                source, convert, sink, self.settings.jobs or os.cpu_count() or 1, bar.show if is_watched else _nothing
            )
            self._check_feeder()
        except KeyboardInterrupt:
            bar.clear()
            if isinstance(sink, FileSink):
                say(f"jkroll: interrupted after {self.shared['rows']} rows; --resume goes on", sys.stderr)
            raise
        finally:
            bar.clear()
            if self.feeder:
                with suppress(ProcessLookupError):
                    os.kill(self.feeder, signal.SIGKILL)
                os.waitpid(self.feeder, 0)

    def _end(self) -> int:
        failed, rows = self.shared["failed"], self.shared["rows"]
        if failed:
            say(f"jkroll: {failed} of {rows} rows failed; column {STATUS} says why", sys.stderr)
            return ROWS_FAILED
        return 0

    def _sink(self) -> Sink:
        """Where the output goes."""
        path = self.settings.target
        if path == "-":
            if self.settings.resume:
                raise BadRequest("--resume needs a file to go on with: -o FILE")
            sys.stdout.flush()
            return Sink(sys.stdout.fileno(), self.shared, strict=self.settings.strict)
        if os.path.exists(path) and not os.path.isfile(path):
            if os.path.isdir(path):
                raise BadRequest(f"-o: {quoted(path)} is a directory")
            return Sink(os.open(path, os.O_WRONLY), self.shared, strict=self.settings.strict)
        return FileSink(path, self.shared, strict=self.settings.strict)

    def _feed(self, descriptor: int) -> int:
        """A pipe from a process that decompresses."""
        end, start = os.pipe()
        sys.stdout.flush()
        self.feeder = os.fork()
        if self.feeder:
            os.close(start)
            return end
        code = 1
        try:
            os.close(end)
            with os.fdopen(descriptor, "rb") as file:
                for piece in decompressed(file, self.format.compression):
                    rest = memoryview(piece)
                    while rest:
                        rest = rest[os.write(start, rest) :]
            code = 0
        finally:
            os._exit(code)

    def _check_feeder(self) -> None:
        if self.feeder:
            _, status = os.waitpid(self.feeder, 0)
            self.feeder = 0
            if status:
                raise BadTable(f"{quoted(self.path)} is not {self.format.compression}, or it is cut off")

    def _note_passing(self, table: Header) -> None:
        if table.passing and not self.settings.quiet:
            names = ", ".join(quoted(text) for text in table.passing)
            say(f"note: {names}: no input; passed through, not used", sys.stderr)


def _nothing() -> None:
    pass


def _format(path: str, settings: Settings) -> Format:
    """The format of the input."""
    if settings.format:
        return stated(settings.format)
    found = format_of(path if path != "-" else settings.target)
    if found is not None:
        return found
    if path == "-":
        return Format("csv")
    raise BadTable(f"{quoted(path)}: its name says no format; give --format csv, tsv, ndjson or parquet")


def _output_format(settings: Settings, of_input: Format) -> Format:
    """The format of the output: as its name says, else that of the input without compression."""
    found = format_of(settings.target)
    if found is None:
        return Format(of_input.kind)
    if found.kind != of_input.kind:
        raise BadTable(f"-o: a table of {of_input.kind} is written as {of_input.kind}, not as {found.kind}")
    return found


def _opened(path: str) -> int:
    """The descriptor of the input."""
    if path == "-":
        return 0
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_CLOEXEC)
        if stat.S_ISDIR(os.fstat(descriptor).st_mode):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    except OSError as error:
        raise BadTable(f"{quoted(path)}: {error.strerror}") from None
    return descriptor


def _size(descriptor: int) -> int:
    about = os.fstat(descriptor)
    return about.st_size if stat.S_ISREG(about.st_mode) else 0


def _identity(descriptor: int) -> list[int]:
    """What tells one input from another before it is read; of a pipe, nothing."""
    about = os.fstat(descriptor)
    return [about.st_size, about.st_mtime_ns] if stat.S_ISREG(about.st_mode) else []


def _check_output(descriptor: int, settings: Settings) -> None:
    """Refuse to write over the input."""
    if settings.target == "-":
        return
    read = os.fstat(descriptor)
    for path in (settings.target, f"{settings.target}.partial", f"{settings.target}.journal"):
        with suppress(OSError):
            if os.path.samestat(read, os.stat(path)) and stat.S_ISREG(read.st_mode):
                raise BadRequest(f"-o: {quoted(path)} is the input; it is not overwritten")


def _cut(dialect: Dialect, text: bytes, is_end: bool) -> int:
    """How many bytes of a text are whole records."""
    if b'"' in text:
        return dialect.records(text, is_end=is_end)[1]
    return len(text) if is_end else text.rfind(b"\n") + 1


def _header(source: Source, dialect: Dialect) -> tuple[bytes, bytes, Header]:
    """The first record of a source, as it stands and without BOM and line end, and what it means."""
    text = source.head()
    if not text.strip():
        raise BadTable("the table is empty: it has no header")
    if text.startswith(UTF_16) or b"\0" in text[:200]:
        raise BadTable("the table is not UTF-8; save it as UTF-8")
    records = dialect.records(text, is_end=True)[0]
    head = records[0]
    source.skip(len(head))
    line = head.removeprefix(BOM)
    cells = dialect.cells(line)
    try:
        names = [cell.decode() for cell in cells or ()]
    except UnicodeDecodeError:
        raise BadTable("header: is not UTF-8; save the table as UTF-8") from None
    if cells is None or not line.strip():
        raise BadTable("header: " + ("is empty" if cells is not None else "has a quote that is not closed"))
    for mark, word in ((";", "semicolons"), ("\t", "tabs"), (",", "commas")):
        if len(names) == 1 and mark in names[0] and not names[0].startswith('"'):
            advice = (
                "--format tsv" if mark == "\t" else "--format csv" if mark == "," else "commas, with decimal points"
            )
            raise BadTable(f"header: {quoted(names[0])} has {word} between its columns; write {advice}")
    table = understood(names)
    sample = [row for row in map(dialect.cells, records[1:200]) if row is not None and len(row) == len(names)]
    for column in table.inputs:
        check_first(column, [row[column.place].decode("utf-8", "replace") for row in sample])
    return head, line.removesuffix(b"\n").removesuffix(b"\r"), table


def _task(table: Header, inputs: Mapping[str, str], wanted: str, known: Materials) -> Task:
    """What is to be computed of each row, as the columns and options allow."""
    spheres = {name: known[inputs[name]] if name in inputs else None for name in MATERIALS}
    fixed = {name: parse_quantity(text, name) for name, text in inputs.items() if name not in MATERIALS}
    scene = _as_known(table, fixed, spheres)
    explicit, offered = _named(wanted or "report")
    for name in explicit:
        if name in table.names or name in fixed:
            raise BadRequest(f"--quantities: {name} is an input here")
        scene.plan(name)
    is_pair = any(name.endswith("2") for name in {*table.names, *inputs})
    besides = {*table.names, "rolling_frequency_as_printed"} if is_pair else table.names
    possible = [name for name in offered if name not in besides and concerns(name, scene) and _is_possible(name, scene)]
    quantities = tuple(dict.fromkeys((*explicit, *possible)))
    if not quantities:
        scene.plan(offered[0])
    return Task(table.inputs, table.materials, quantities, fixed, spheres["material"], spheres["material2"], known)


def _as_known(table: Header, fixed: Mapping[str, float], spheres: Mapping[str, Any]) -> Scene:
    """A scene of which all is known that a row may say; of columns that exclude each other, the first."""
    some = Material("", dict.fromkeys(PROPERTIES, _SOME), (), {}, (), (), "", "")
    given: dict[str, float] = {}
    for column in table.inputs:
        if not any(column.name in names and given.keys() & names for names in EXCLUSIVE):
            given[column.name] = _SOME
    places = dict(table.materials)
    return Scene({**fixed, **given}, *(some if name in places else spheres[name] for name in MATERIALS))


_SOME = 0.25  # a value that any input can have


def _named(text: str) -> tuple[list[str], list[str]]:
    """The quantities of `--quantities`: those that are named, and those that commands show as far as they can."""
    named: list[str] = []
    offered: list[str] = []
    for word in map(str.strip, text.split(",")):
        if word in COMMANDS:
            offered += COMMANDS[word].quantities
        elif word in NOMENCLATURE and NOMENCLATURE[word].unit:
            named.append(word)
        else:
            raise UnknownQuantity(word)
    return named, offered


def _is_possible(name: str, scene: Scene) -> bool:
    try:
        scene.plan(name)
    except MissingInput:
        return False
    return True
