"""One call of the command line, from what was typed to what is printed."""

import sys
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple, TextIO

from .answer import Command, answer
from .materials import known_materials
from .report import WRITERS, say
from .request import BadRequest, Request, format_of, materials_files

MAX_NOTES = 20
ROWS_FAILED = 1


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
    configuration: Path = Path()

    def format_name(self, out: TextIO) -> str:
        """The one format that was asked for, else what suits where the output goes."""
        chosen = [name for name in ("bare", "json", "csv", "explain", "cite") if getattr(self, name)]
        if len(chosen) > 1:
            raise BadRequest(f"--{chosen[0]} and --{chosen[1]} exclude each other")
        return chosen[0] if chosen else "table" if out.isatty() else "plain"


def run_command(command: Command, words: Sequence[str] | None, options: Mapping[str, str], output: Output) -> int:
    """Answer a command for every scene that was described; return the exit code."""
    out = sys.stdout
    kind = output.format_name(out)
    form = format_of(output.to, output.digits, command.quantities)
    request = Request(words or [], options, materials_files(output.materials, output.configuration))
    scenes = list(request.scenes())
    answers = [answer(command, scene) for scene in scenes]
    failures = [one.failure for one in answers if one.failure is not None]
    if len(answers) == 1 and failures and all(answers[0].value(name) is None for name in command.headline):
        raise failures[0]
    if kind in ("explain", "cite"):
        from .explain import write_citations, write_explanation

        if kind == "cite":
            write_citations(answers, scenes, out)
        else:
            for place, (one, scene) in enumerate(zip(answers, scenes, strict=True)):
                if place:
                    say("\n", out)
                write_explanation(one, scene, out, form)
    else:
        WRITERS[kind](answers, out, form, command)
    out.flush()
    if not output.quiet and kind not in ("json", "explain", "cite"):
        _note([note for one in answers for note in one.notes])
    if failures:
        say(
            f"jkroll: {failures[0] if len(answers) == 1 else f'{len(failures)} of {len(answers)} rows failed'}",
            sys.stderr,
        )
        return ROWS_FAILED
    return 0


def _note(notes: Iterable[str]) -> None:
    """Print each note once on stderr."""
    different = list(dict.fromkeys(notes))
    for note in different[:MAX_NOTES]:
        say(f"note: {note}", sys.stderr)
    if len(different) > MAX_NOTES:
        say(f"note: and {len(different) - MAX_NOTES} more", sys.stderr)


def run_materials(name: str | None, output: Output) -> int:
    """List the materials, or show one whole; return the exit code."""
    from .catalogue import write_materials

    out = sys.stdout
    kind = output.format_name(out)
    materials = known_materials(*materials_files(output.materials, output.configuration))
    chosen = list(materials.materials.values()) if name in (None, "all") else [materials[name]]
    write_materials(chosen, out, kind, whole=name not in (None, "all"))
    if not output.quiet:
        _note(f"{material.name}: {text}" for material in chosen for text in material.shadows)
    return 0
