"""Runners of a few lines: `export`, `infer`, `batch`, `materials`, `quantities`, `guide`, `verify` and `bench`.

Each imports by itself what it hands a call to, so that a call pays for its own only.
"""

import os
import sys
from collections.abc import Sequence

from ..answers.questions import EVERYTHING, quantities_named, quantity_named
from ..errors import BadRequest
from ..materials.library import UnknownMaterial
from ..quantities.laws import BETWEEN
from ..quantities.nomenclature import UnknownQuantity
from ..quantities.values import Spread, spreads_of
from ..text import ascii_text, closest, listed, quoted, say, say_wrapped, wrapped
from .call import Call

WIDTH_OF_EXPORT = 120  # of a comment


def run_export(call: Call) -> int:
    """Write the contact of one pair as the input of a program; return the exit code."""
    from ..answers.answer import Answer
    from ..answers.notes import about_middles, every_line
    from ..answers.questions import Question
    from ..output.exports import PROGRAMS

    said = call.subject.casefold()
    program = next((each for name, each in PROGRAMS.items() if said in (name, each.title.casefold())), None)
    if program is None:
        guess = closest(said, PROGRAMS) or next(iter(PROGRAMS))
        raise BadRequest(f"export: which program, {', '.join(PROGRAMS)}? Write jkroll export {guess} quartz 100nm")
    if (count := len(call.sweep)) != 1:
        raise BadRequest(f"export takes one pair of spheres, not {count}")
    scene = next(call.sweep.scenes())
    if (model := scene.law.name) not in program.models:
        raise BadRequest(f"--model: {program.title} has {listed(program.models)}, not {quoted(model)}")
    sys.stdout.write(program.text(scene))
    if call.quiet:
        return 0
    lacking = scene.missing(program.quantities)
    names = tuple(name for name in program.quantities if name not in lacking)
    answer = Answer(Question(names, names), scene)
    notes = [*(f"note: {note.text}" for note in about_middles(answer.uncertain)), *every_line(answer)]
    notes = [line.replace(f": --model {BETWEEN}", "") for line in notes]  # a law that no program has
    if program.about:
        for line in (*(f"note: {text}" for text in program.about(scene)), *notes):
            say_wrapped(line, sys.stderr)
    else:
        for line in notes:
            say("\n".join(f"# {part}" for part in wrapped(ascii_text(line), WIDTH_OF_EXPORT, 2)), sys.stdout)
    return 0


def run_infer(call: Call) -> int:
    """Find inputs for every scene and measured value; return the exit code."""
    from ..answers.inferred import Inferred
    from ..answers.questions import Question
    from ..rows.infer import Problems
    from ..scene.inverse import SIZES, already_given, inputs_named
    from .question import check_format, write

    if not call.subject:
        raise BadRequest(f"infer needs an input: one of {', '.join(SIZES)}")
    names = inputs_named(call.subject.split(","))
    if call.alternatives:
        raise BadRequest("infer writes no --alternatives; --json has the values by each law")
    for word in filter(os.path.isfile, call.words):
        raise BadRequest(f"infer reads no tables; jkroll batch {word} --infer INPUT --measured QUANTITY does")
    measured = _measured(call.measured, names)
    check_format(call)
    form = call.form(names)
    for quantity in measured:
        if quantity in call.spreads:
            raise already_given(quantity)
    problems = Problems(names, measured, call.sweep)
    return write(call, problems, Question(tuple(names), tuple(names)), form, Inferred)


def _measured(texts: Sequence[str], names: Sequence[str]) -> dict[str, list[Spread]]:
    """Read the measured quantities and their values: as many as inputs are sought."""
    measured: dict[str, list[Spread]] = {}
    for text in texts:
        word, has_value, value = text.partition("=")
        if not has_value:
            raise BadRequest("--measured: write a quantity and its value, such as pull_off_force=300nN")
        quantity = quantity_named(word)
        measured[quantity] = spreads_of(value, quantity)
    if not len(texts) == len(measured) == len(names):
        example = "--measured pull_off_force=300nN" + " --measured stiffness=1kN/m" * (len(names) - 1)
        wanted = f"infer needs a measured quantity for each input, {len(names)} in all: {example}"
        raise BadRequest(f"{wanted}; several values of one have commas")
    return measured


def run_batch(call: Call) -> int:
    """Convert a table of scenes; return the exit code."""
    from ..batch.run import Job, run
    from ..rows.table import Asked

    if not call.subject:
        raise BadRequest("batch needs a table, such as grains.csv, or - for standard input")
    if call.settings.keys() >= {"format", "delimiter"}:
        raise BadRequest("--format and --delimiter exclude each other")
    for name, value in {"quantities": call.quantities, **call.settings}.items():
        if isinstance(value, str) and not value.strip():
            raise BadRequest(f"--{name} is empty")
    infer, measured = _unknown_and_measured(call)
    explicit, offered = quantities_named(call.quantities) if call.quantities else ([], EVERYTHING)
    of_rows = {name: value for name, value in call.settings.items() if name in Asked._fields}
    of_files = {name: value for name, value in call.settings.items() if name not in of_rows}
    asked = Asked(
        call.inputs,
        call.materials,
        explicit,
        offered,
        infer=infer,
        measured=measured,
        doubt=not call.no_doubt,
        alternatives=call.alternatives,
        **of_rows,
    )
    return run(call.subject, Job(asked, target=call.target or "-", quiet=call.quiet, **of_files))


def _unknown_and_measured(call: Call) -> tuple[str, str]:
    """Return the names of the input that is sought and of the quantity that was measured; empty texts if none is."""
    if not call.infer and not call.measured:
        return "", ""
    if not call.infer or "," in call.infer or len(call.measured) != 1:
        example = "--infer gamma --measured pull_off_force"
        raise BadRequest(f"batch infers one input from one quantity, as in {example}; jkroll infer finds two")
    for option, value in (("quantities", call.quantities), ("alternatives", call.alternatives)):
        if value:
            raise BadRequest(f"--infer and --{option} exclude each other")
    from ..scene.inverse import inputs_named

    return inputs_named([call.infer])[0], quantity_named(call.measured[0])


def run_materials(call: Call) -> int:
    """List the materials, or those that have some words, or show some in full; return the exit code."""
    from ..output.catalogue import write_materials

    kind, materials = call.kind, call.materials
    text = " ".join(call.words)
    lists_all = text.casefold() in ("", "all")
    try:
        named = [] if lists_all else [materials[word] for word in text.split(",")]
        chosen = named or [*materials.materials.values()]
    except UnknownMaterial:
        from ..output.manual import materials_with

        named, chosen = [], materials_with(call.words, materials.materials.values())
        if not chosen:
            raise
    write_materials(chosen, sys.stdout, kind, named=bool(named))
    sys.stdout.flush()
    mistakes = materials.mistakes if lists_all else []
    for mistake in mistakes:
        say_wrapped(f"jkroll: {mistake}", sys.stderr)
    return mistakes[0].exit_code if mistakes else 0


def run_quantities(call: Call) -> int:
    """List quantities, those that have some words, or one in full; return the exit code."""
    from ..output.catalogue import write_quantities
    from ..output.manual import Hits, hits_of, quantities_named, write_hits

    kind = call.kind
    names = quantities_named(call.words)
    hits = Hits([], names, []) if names else hits_of(call.words, call.materials.materials.values())
    if hits.quantities:
        write_quantities(hits.quantities, sys.stdout, kind)
    elif any(hits) and kind in ("table", "plain"):
        write_hits(call.words, hits, sys.stdout)
    else:
        raise UnknownQuantity(" ".join(call.words))
    if kind == "table" and hits.quantities and hits.sections:
        say_wrapped(f"in the manual: jkroll guide {' '.join(call.words)}", sys.stdout)
    return 0


def run_guide(call: Call) -> int:
    """Show a page of the manual, list its topics, or show what has some words; return the exit code."""
    from ..output.manual import hits_of, page, topics, write_hits, write_text, write_topics

    topic = " ".join(call.words)
    if not call.words:
        write_topics(sys.stdout)
    elif topic in topics():
        write_text(page(topic), sys.stdout)
    else:
        write_hits(call.words, hits_of(call.words, call.materials.materials.values()), sys.stdout)
    return 0


def run_verify(_: Call) -> int:
    """Say where the audit of the paper went; the command itself goes with 1.0."""
    say_wrapped("The audit of the paper is `jkroll guide paper` now; the tests recompute it.", sys.stdout)
    return 0


def run_bench(call: Call) -> int:
    """Measure speed against error; return the exit code.

    Whatever prevents a plot is reported before anything is measured.
    """
    from .map import check_picture, draw_into

    check_picture(call, call.plot, "--plot")
    from ..bench.report import FULL, QUICK, picture_of, write_bench

    rows = write_bench(sys.stdout, call.kind, QUICK if call.quick else FULL)
    if call.plot is not None:
        draw_into(call.plot, picture_of(rows), call)
    return 0
