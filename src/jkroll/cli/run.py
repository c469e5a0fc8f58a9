"""One call of the command line, from what was typed to what is printed."""

import os
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple, TextIO

from ..answers.answer import Answer, Note, answer, in_units
from ..answers.questions import Command
from ..errors import BadRequest, JkrollError, MissingExtra
from ..materials.library import known_materials
from ..materials.places import materials_files
from ..output.layout import layout
from ..output.writers import WRITERS
from ..quantities.formatting import Format
from ..text import quoted, say
from .request import Request, format_of

MAX_NOTES = 20
ROWS_FAILED = 1
PICTURES = ("svg", "pdf", "png")
MANY = 20_000  # rows from which on a sweep is streamed by blocks


class Output(NamedTuple):
    """How a call is to answer."""

    to: str | None = None
    digits: int | None = None
    bare: bool = False
    json: bool = False
    csv: bool = False
    explain: bool = False
    cite: bool = False
    materials: str | None = None
    quiet: bool = False
    curve: bool = False
    target: str | None = None
    resume: bool = False

    def format_name(self, out: TextIO) -> str:
        """The one format that was asked for, else what suits where the output goes."""
        chosen = [name for name in ("bare", "json", "csv", "explain", "cite") if getattr(self, name)]
        if len(chosen) > 1:
            raise BadRequest(f"--{chosen[0]} and --{chosen[1]} exclude each other")
        return chosen[0] if chosen else "table" if out.isatty() else "plain"


class Tally:
    """What is to be said at the end about the answers that went by."""

    def __init__(self) -> None:
        """Nothing went by yet."""
        self.notes: dict[Note, None] = {}
        self.failures: list[JkrollError] = []
        self.failed = 0

    def watch(self, answers: Iterable[Answer]) -> Iterator[Answer]:
        """Pass answers on."""
        for one in answers:
            if len(self.notes) <= MAX_NOTES:
                self.notes |= dict.fromkeys([*one.notes, *one.doubts()])
            if one.failure is not None:
                self.failed += 1
                self.failures = self.failures or [one.failure]
            yield one


def run_command(command: Command, words: Sequence[str] | None, options: Mapping[str, str], output: Output) -> int:
    """Answer a command for every scene that was described; return the exit code."""
    out = sys.stdout
    kind = output.format_name(out)
    if output.resume and output.target is None:
        raise BadRequest("--resume needs a file to go on with: -o FILE")
    form = format_of(output.to, output.digits, command.quantities)
    request = Request(words or [], options, materials_files(output.materials))
    if output.materials is not None:
        request.materials  # noqa: B018  a file that was named is read, whether it is needed or not
    if output.curve:
        return _run_curve(request, kind, form)
    samples = [in_units(answer(command, scene), form) for scene in request.samples()] if request.count > 1 else []
    if output.target is not None or (kind == "csv" and request.count > MANY):
        return _run_stream(command, request, samples, kind, output)
    request.check_count()
    tally = Tally()
    if kind in ("explain", "cite"):
        from ..output.citations import write_citations
        from ..output.explain import write_explanation

        write = write_citations if kind == "cite" else write_explanation
        write(
            ((scene, one) for scene in request.scenes() for one in tally.watch([answer(command, scene)])),
            out,
            form,
        )
    else:
        answers = tally.watch(in_units(answer(command, scene), form) for scene in request.scenes())
        if request.count == 1:
            answers = iter([_unless_failed(next(answers), command)])
        WRITERS[kind](answers, out, form, layout(command, samples, request.count))
    out.flush()
    if not output.quiet and kind not in ("json", "explain", "cite"):
        has_doubts = kind == "table" and request.count == 1  # the table of one scene shows them
        _note(note.text for note in tally.notes if not (has_doubts and note.kind == "doubt"))
    return _say_failures(tally, request.count)


def no_picture(flag: str, path: str) -> BadRequest:
    """The refusal of a name that does not end as a picture's does."""
    return BadRequest(f"{flag}: {quoted(path)} does not end in .{', .'.join(PICTURES[:-1])} or .{PICTURES[-1]}")


def _ending(path: str) -> str:
    return os.path.splitext(path)[1][1:].casefold()


def _run_stream(command: Command, request: Request, samples: list[Answer], kind: str, output: Output) -> int:
    """Write a sweep of any length to a file, or as CSV to a pipe; return the exit code."""
    from ..batch.axes import Axis
    from ..batch.settings import Settings
    from ..batch.sweep import Sweep, stream

    if output.target and _ending(output.target) in PICTURES:
        raise BadRequest(f"-o: {quoted(output.target)} is a picture; add --curve to contact, or see jkroll map --help")
    if output.to or output.digits or kind not in ("csv", "plain", "table"):
        raise BadRequest("a long sweep is written in SI units with all digits: -o and long ranges take --csv alone")
    samples = samples or [answer(command, scene) for scene in request.samples()]
    axes = [Axis(name, spreads) for name, spreads in request.spreads.items()]
    sweep = Sweep(request.pairs, axes, layout(command, samples, request.count), request.materials)
    tally = stream(sweep, Settings(target=output.target or "-", resume=output.resume, quiet=output.quiet))
    if not output.quiet:
        ends = Tally()
        list(ends.watch(samples))
        _note(note.text for note in ends.notes)
    if tally.failed:
        say(f"jkroll: {tally.failed} of {tally.rows} rows failed", sys.stderr)
        return ROWS_FAILED
    return 0


def _run_curve(request: Request, kind: str, form: Format) -> int:
    """Write the force curve of every scene; return the exit code."""
    from ..answers.curve import CURVE, curve, states

    if kind in ("explain", "cite"):
        raise BadRequest(f"--curve and --{kind} exclude each other")
    if {"load", "approach_at_load"} & request.options.keys():
        raise BadRequest("--curve goes through all loads and approaches; it takes none")
    tally = Tally()
    samples = [row for _, row in curve(iter(request.samples()))]
    if samples[0].failure is not None and all(row.failure is not None for row in samples):
        raise samples[0].failure
    shape = layout(CURVE, samples, request.count * len(states()))
    WRITERS[kind](tally.watch(in_units(row, form) for _, row in curve(request.scenes())), sys.stdout, form, shape)
    sys.stdout.flush()
    return _say_failures(tally, request.count * len(states()))


def _say_failures(tally: Tally, count: int) -> int:
    """Say how many rows failed, if any did, and return the exit code."""
    if not tally.failed:
        return 0
    say(f"jkroll: {tally.failures[0] if count == 1 else f'{tally.failed} of {count} rows failed'}", sys.stderr)
    return ROWS_FAILED


def _unless_failed(one: Answer, command: Command) -> Answer:
    """The answer of a single scene, unless it has nothing of what the command is named after."""
    if one.failure is not None and all(one.value(name) is None for name in command.headline):
        raise one.failure
    return one


def _note(notes: Iterable[str]) -> None:
    """Print each note once on stderr."""
    different = list(dict.fromkeys(notes))
    for note in different[:MAX_NOTES]:
        say(f"note: {note}", sys.stderr)
    if len(different) > MAX_NOTES:
        say("note: and more", sys.stderr)


def run_materials(name: str | None, output: Output) -> int:
    """List the materials, or show one whole; return the exit code."""
    from ..output.catalogue import write_materials

    out = sys.stdout
    kind = output.format_name(out)
    materials = known_materials(*materials_files(output.materials))
    chosen = list(materials.materials.values()) if name in (None, "all") else [materials[name]]
    write_materials(chosen, out, kind, whole=name not in (None, "all"))
    if not output.quiet:
        _note(f"{material.name}: {text}" for material in chosen for text in material.shadows)
    return 0


def run_verify(output: Output) -> int:
    """Compute the audit of the paper; return 1 if a verdict is not the expected one."""
    from ..audit.verify import write_verification

    code = write_verification(sys.stdout, output.format_name(sys.stdout))
    sys.stdout.flush()
    return code


def run_bench(output: Output, *, quick: bool = False, plot: str | None = None) -> int:
    """Measure speed against error; return the exit code."""
    from ..bench.report import write_bench

    if plot is not None and _ending(plot) not in PICTURES:
        raise no_picture("--plot", plot)
    try:
        code = write_bench(sys.stdout, output.format_name(sys.stdout), quick=quick, plot=plot)
    except ModuleNotFoundError as error:
        raise MissingExtra(error.name or "", "plot" if plot else "bench") from None
    sys.stdout.flush()
    return code


def run_batch(path: str | None, output: Output, given: Mapping[str, Any]) -> int:
    """Convert a table of scenes; return the exit code."""
    from ..batch.command import run

    names = ("materials", "resume", "quiet")
    settings = {"target": output.target or "-", **{name: getattr(output, name) for name in names}}
    return run(path, {**given, **settings})
