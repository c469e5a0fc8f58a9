"""Runners of a few lines: `contact`, `batch`, `materials`, `quantities`, `guide`, `verify` and `bench`.

Each imports by itself what it hands a call to, so that a call pays for its own only.
"""

import sys
from itertools import islice

from ..answers.questions import quantity_named
from ..errors import BadRequest
from ..output import notes as note_lines
from ..output.records import in_units
from ..quantities.nomenclature import named
from ..rows.columns import Columns
from ..text import say_wrapped
from .commands import Call
from .question import (
    MAX_TABLE,
    check_count,
    checked,
    exit_code,
    format_name,
    run_question,
    write_answers,
    write_columns,
)
from .request import curve_request, materials_of

CURVE_BLOCK = 500  # rows of force curves that are computed before they are written


def run_contact(call: Call) -> int:
    """Answer the question of the command, or write or draw the force curve; return the exit code."""
    is_drawn = call.curve and call.target is not None
    if is_drawn or call.width is not None or call.style is not None or call.uncaptioned or call.panel:
        from .map import draw_contact

        return draw_contact(call)
    return _write_curve(call) if call.curve else run_question(call)


def _write_curve(call: Call) -> int:
    """Write the force curve of every scene; return the exit code."""
    from ..answers.curve import curve, states, wanted_of_curve

    _, kind, form = checked(call)
    if kind in ("explain", "cite"):
        raise BadRequest(f"--curve and --{kind} exclude each other")
    request, loads = curve_request(call)
    check_count(request.count, "curve")
    samples = [*curve(request.sweep.kinds, loads)]
    if (failure := samples[0].failure) is not None and all(one.failure is not None for one in samples):
        raise failure
    answers = curve(request.scenes(), loads)
    if kind == "json":
        count = sum(len(states(scene, loads)) for scene in request.scenes())
        return write_answers(answers, count, kind, form, sys.stdout, quiet=call.quiet)
    wanted = wanted_of_curve(samples, is_bare=kind == "bare")
    size = MAX_TABLE if kind == "table" else CURVE_BLOCK
    blocks = iter(lambda: [one.row(wanted) for one in islice(answers, size)], [])
    notes = note_lines.OfRows()
    columns = (in_units(Columns.of_rows(wanted, rows), form) for rows in blocks)
    write_columns(wanted, notes.watch(columns), kind, form, call)
    return exit_code(notes, notes.count)


def run_batch(call: Call) -> int:
    """Convert a table of scenes; return the exit code."""
    from ..batch.command import run
    from ..batch.settings import Settings

    if not call.words:
        raise BadRequest("batch needs a table, such as grains.csv, or - for standard input")
    if call.settings.keys() >= {"format", "delimiter"}:
        raise BadRequest("--format and --delimiter exclude each other")
    infer, measured = _inverse(call)
    same = {name: getattr(call, name) for name in Settings._fields if name in Call._fields}
    own = {"target": call.target or "-", "doubt": not call.no_doubt, "infer": infer, "measured": measured}
    settings = Settings(**{**same, **own}, **call.settings)
    return run(call.words[0], settings, call.inputs, materials_of(call.materials))


def _inverse(call: Call) -> tuple[str, str]:
    """Return the names of the input that is sought and of the quantity that was measured; empty texts if none is."""
    if not call.infer and not call.measured:
        return "", ""
    if "," in call.infer or len(call.measured) > 1:
        raise BadRequest("batch infers one input; jkroll infer finds two, for lists and ranges too")
    if not call.infer or not call.measured or "=" in call.measured[0]:
        raise BadRequest(
            "--infer INPUT and --measured QUANTITY go together, as in --infer gamma --measured pull_off_force"
        )
    if call.quantities:
        raise BadRequest("--infer and --quantities exclude each other")
    from ..scene.inverse import SIZES, CannotInfer

    name = named(call.infer)
    if name not in SIZES:
        raise CannotInfer(call.infer)
    return name, quantity_named(call.measured[0])


def run_materials(call: Call) -> int:
    """List the materials, or show one in full; return the exit code."""
    from ..output.catalogue import write_materials

    kind = format_name(call)
    materials = materials_of(call.materials)
    lists_all = not call.words or call.words[0].casefold() == "all"
    chosen = [*materials.materials.values()] if lists_all else [materials[word] for word in call.words[0].split(",")]
    write_materials(chosen, sys.stdout, kind, whole=not lists_all and len(chosen) == 1)
    sys.stdout.flush()
    for clash in () if call.quiet or not lists_all else dict.fromkeys(map(str, materials.clashes.values())):
        say_wrapped(f"note: {clash}", sys.stderr)
    mistakes = [*materials.mistakes.values()] if lists_all else []
    for mistake in mistakes:
        say_wrapped(f"jkroll: {mistake}", sys.stderr)
    return mistakes[0].exit_code if mistakes else 0


def run_quantities(call: Call) -> int:
    """List quantities, those that have some words, or one in full; return the exit code."""
    from ..output.catalogue import quantities_found, write_quantities

    write_quantities(quantities_found(call.words), sys.stdout, format_name(call))
    return 0


def run_guide(call: Call) -> int:
    """Show a page of the manual, or list its topics; return the exit code."""
    from ..output.manual import write_page, write_topics

    if call.words:
        write_page(call.words[0], sys.stdout)
    else:
        write_topics(sys.stdout)
    return 0


def run_verify(call: Call) -> int:
    """Compute the audit of the paper; return 1 if a verdict is not the expected one."""
    from ..audit.verify import write_verification

    return write_verification(sys.stdout, format_name(call))


def run_bench(call: Call) -> int:
    """Measure speed against error; return the exit code. Whatever prevents a plot is reported before anything is measured."""
    from .map import check_picture, inches_of

    check_picture(call, call.plot, "--plot", numbers="--csv > FILE")
    from ..bench.report import Plot, write_bench

    plot = Plot(call.plot, inches_of(call.width), call.style or "paper", not call.uncaptioned) if call.plot else None
    return write_bench(sys.stdout, format_name(call), quick=call.quick, plot=plot)
