"""The runner of `fit`: it fits the curves in files and writes an answer, rows or a picture."""

import glob
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy

from ..errors import ROWS_FAILED, BadRequest, JkrollError
from ..fitting.result import RESULTS, Fit, Known
from ..materials.library import Materials
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.values import value_of
from ..report.fitted import WORDS, in_words, is_sure, line_on_known, sentences, warnings
from ..tables.files import output_format
from ..tables.fitted import fit_of_file, known_of
from ..text import ascii_text, ending, listed, quoted, say, say_wrapped
from ..write.fitted import (
    curve_columns,
    heads_of,
    json_of,
    row_of,
    write_fit,
    write_fit_citations,
    write_fit_methods,
    write_json,
)
from ..write.output_file import text_output
from ..write.writers import WRITERS, write_columns
from .call import CITE, CSV, FILE, JSON, MARKDOWN, TABLE, Call

_SUMMARY = ("work_of_adhesion_opening", "work_of_adhesion_closing", "adhesion_hysteresis", "contact_modulus")
_RADII = ("radius", "diameter", "reduced_radius")
_NECESSARY = ("work_of_adhesion_opening", "contact_modulus")  # results that the next command needs
_LARGEST_ERROR = 0.45  # largest relative error of a result offered as an input; an input with 0.5 or more is refused


class FileFit(NamedTuple):
    """The fit of a file and a sentence on how the file was read, or an error."""

    fitted: Fit | None
    reading: str
    error: JkrollError | None


def run_fit(call: Call) -> int:
    """Fit the curves in files; return the exit code."""
    from .draw import check_picture

    paths = _paths(call)
    given = {name: value_of(text, name) for name, text in call.inputs.items() if name not in ("model", "profile")}
    words = {
        "model": call.inputs.get("model"), "profile": call.inputs.get("profile"), "branch": call.branch,
        "range": call.range, "baseline": call.baseline,
    }  # fmt: skip
    known = known_of(words, call.spring, given)
    fit_file = partial(
        _fit_file, known=known, materials=call.materials, columns=call.columns, form=call.format, mark=call.delimiter
    )
    if call.names_picture and len(paths) > 1:
        raise BadRequest(f"a picture shows one curve; {len(paths)} files were given")
    check_picture(call, call.target if call.names_picture else None)
    form = "" if call.names_picture else _form_of_rows(call)
    if len(paths) == 1:
        return _write_single(call, paths[0], fit_file(paths[0]), form)
    if call.curve:
        raise BadRequest("--curve writes the points of one file")
    if call.output is CITE:
        raise BadRequest(f"--cite takes one curve; {len(paths)} files were given")
    return _write_rows(call, paths, [*_outcomes(call, fit_file, paths)], known, form)


def _fit_file(path: str, known: Known, materials: Materials, columns: tuple[str, ...], form: str, mark: str) -> FileFit:
    """Return the fit of a file, or its error. `columns`, `form`, `mark`: see `read_curve`."""
    try:
        fitted, reading = fit_of_file(path, known, materials, columns, form, mark)
    except JkrollError as error:
        return FileFit(None, "", error.with_traceback(None))
    return FileFit(fitted, reading, None)


def _form_of_rows(call: Call) -> str:
    """Return the format of rows: that of the output file, or the one that an option chooses; by default CSV.

    Raises BadRequest for an output file that is not text, or is compressed.
    """
    if call.output is not FILE or call.target is None:
        return "md" if call.output is MARKDOWN else "csv"
    form = output_format(call.target, "csv", quiet=call.quiet)
    if form.name not in WRITERS or form.compression:
        raise BadRequest(f"-o: a fit is not written as {ending(call.target)}; name the file 'fit.csv'")
    return form.name


def _paths(call: Call) -> list[str]:
    """Return the files that words and patterns name; raise BadRequest for no file, or for standard input."""
    words = [word for word in (call.subject, *call.words) if word]
    if not words:
        raise BadRequest("fit needs a curve, such as curve.csv; jkroll guide fit has an example")
    paths: list[str] = []
    for word in words:
        matching = [word]
        if glob.has_magic(word) and not os.path.exists(word):
            matching = sorted(glob.glob(word))
        if not matching:
            raise BadRequest(f"{quoted(word)}: no such file")
        paths += matching
    if "-" in paths:
        raise BadRequest("fit reads files: save the curve first")
    return paths


# --- One file ---------------------------------------------------------------------------------------------------------


def _write_single(call: Call, path: str, outcome: FileFit, form: str) -> int:
    """Write the fit of one file in the chosen form; return the exit code. `form`: the format of rows."""
    fitted = outcome.fitted
    if fitted is None:
        assert outcome.error is not None
        raise outcome.error
    if not call.quiet:
        say_wrapped(outcome.reading, sys.stderr)
    following = following_command(call, fitted)
    if call.names_picture:
        return _draw(call, path, fitted)
    output = call.output
    with text_output(call.target or "-") as out:
        if output is CITE:
            (write_fit_methods if call.tex else write_fit_citations)(fitted, out)
        elif output is JSON:
            write_json([json_of(fitted, path, outcome.reading, following, curve=call.curve)], out)
        elif call.curve and output is TABLE:
            from ..pictures.fitted import picture_of_fit
            from ..pictures.picture_as_text import write_picture

            drawn = picture_of_fit(fitted, os.path.basename(path), ())
            write_picture(drawn._replace(remarks=(*warnings(fitted), *sentences(fitted))), out)
        elif call.curve:
            heads, columns = curve_columns(fitted)
            write_columns(heads, columns, form, out)
        elif output in (CSV, MARKDOWN, FILE):
            row = row_of(path, fitted)
            write_columns(heads_of(is_scaled=fitted.is_scaled), [[cell] for cell in row], form, out)
        else:
            lines = [*_on_following(fitted, following)]
            write_fit(fitted, out, heading=_heading(call, path, fitted), following=lines)
    return 0


def _heading(call: Call, path: str, fitted: Fit) -> str:
    """Return the line above a fit: the file and the known data."""
    on_radius = ""
    if {"radius2", "diameter2", "reduced_radius"}.isdisjoint(call.inputs):
        on_radius = " of two equal spheres (--radius2 plane for a flat)"
    known = line_on_known(fitted, on_radius=on_radius, stiffness=call.spring or "")
    return f"{os.path.basename(path)}: {known}"


def following_command(call: Call, fitted: Fit) -> str:
    """Return the command that continues from a fit to rolling; empty without a radius, or if w or E* is uncertain.

    If the fitted law does not hold, the command fits again by the better law.
    """
    if fitted.better_law:
        return call.line_with(model=fitted.better_law, profile=None)
    radii = [name for name in _RADII if name in call.inputs]
    are_known = all(_is_known(fitted, name) for name in _NECESSARY)
    if not are_known or not radii or fitted.is_scaled or not is_sure(fitted):
        return ""
    words = ["jkroll yield-force"]
    if "radius" in call.inputs:
        words.append(call.inputs["radius"])
    words += _as_typed(call, ("diameter", "reduced_radius", "radius2", "diameter2"))
    words.append(f"--work-of-adhesion {_typed(fitted, 'work_of_adhesion_opening')}")
    words.append(f"--contact-modulus {_typed(fitted, 'contact_modulus')}")
    words += _as_typed(call, ("model", "atomic_spacing"))
    if _is_known(fitted, "adhesion_hysteresis"):
        words.append(f"--adhesion-hysteresis {_typed(fitted, 'adhesion_hysteresis')}")
    return " ".join(words)


def _as_typed(call: Call, names: Sequence[str]) -> list[str]:
    """Return those of these inputs that were given, as options with their values as typed."""
    return [f"{NOMENCLATURE[name].option} {call.inputs[name]}" for name in names if name in call.inputs]


def _is_known(fitted: Fit, name: str) -> bool:
    """Return whether the error of a result is small enough for the result to be an input of the next command."""
    return name in fitted.values and fitted.errors[name].total < _LARGEST_ERROR * fitted.values[name]


def _on_following(fitted: Fit, following: str) -> Iterator[str]:
    """Iterate over the lines on the next command: the results whose errors keep them out of it, and the command."""
    names = [name for name in (*_NECESSARY, "adhesion_hysteresis") if name in fitted.values]
    uncertain = [WORDS[name][1] for name in names if not _is_known(fitted, name)]
    if uncertain and is_sure(fitted) and not (fitted.is_scaled or fitted.better_law):
        start = "left out of the next command" if following else "no command follows"
        yield f"{start}: an error above {_LARGEST_ERROR:.0%} ({listed(uncertain)})"
    if following:
        yield f"then: {following}"


def _typed(fitted: Fit, name: str) -> str:
    """Return a result with its error as typed on a command line."""
    return ascii_text(in_words(fitted, name)).replace(" ", "").replace("^", "").replace("+/-", "±")


def _draw(call: Call, path: str, fitted: Fit) -> int:
    """Draw the fit into a file; return the exit code."""
    from ..pictures.fitted import caption_of_fit, picture_of_fit
    from .draw import draw_into

    assert call.target is not None
    draw_into(call.target, picture_of_fit(fitted, os.path.basename(path), caption_of_fit(fitted)), call)
    return 0


# --- Many files -------------------------------------------------------------------------------------------------------


def _outcomes(call: Call, fit_file: Callable[[str], FileFit], paths: Sequence[str]) -> Iterator[FileFit]:
    """Iterate over the fits of files, in several processes with --jobs, and with a line of progress on a terminal."""
    outcomes: Iterator[FileFit] = map(fit_file, paths)
    if (call.jobs or 1) > 1:
        from ..tables.workers import answers

        outcomes = answers(min(call.jobs, len(paths)), fit_file, paths)
    if not sys.stderr.isatty() or call.quiet:
        return outcomes
    from ..tables.progress import with_progress

    return with_progress(outcomes, lambda _: 1, lambda done, _: f"{done} of {len(paths)} files")


def _write_rows(call: Call, paths: Sequence[str], outcomes: Sequence[FileFit], known: Known, form: str) -> int:
    """Write a row or a JSON object for each file, and a summary on stderr; return the exit code."""
    rows = []
    for path, outcome in zip(paths, outcomes, strict=True):
        reason = "" if outcome.error is None else outcome.error.phrase or str(outcome.error)
        rows.append(row_of(path, outcome.fitted, reason))
    fits = [outcome.fitted for outcome in outcomes if outcome.fitted is not None]
    with text_output(call.target or "-") as out:
        if call.output is JSON:
            write_json([*map(_json_of_outcome, paths, outcomes)], out)
        else:
            heads = heads_of(is_scaled=known.radius is None)
            write_columns(heads, [*map(list, zip(*rows, strict=True))], form, out)
    for path, outcome in zip(paths, outcomes, strict=True):
        if outcome.error is not None:
            say_wrapped(f"jkroll: {quoted(path)}: {outcome.error}", sys.stderr)
    if not call.quiet:
        for line in _summary(fits, len(paths)):
            say_wrapped(line, sys.stderr)
    failed = len(paths) - len(fits)
    if failed:
        say(f"jkroll: {failed} of {len(paths)} files failed; column status has the reasons", sys.stderr)
    return ROWS_FAILED if failed else 0


def _json_of_outcome(path: str, outcome: FileFit) -> dict[str, Any]:
    """Return the JSON object of the fit of a file, or of its error."""
    if outcome.fitted is None:
        return {"inputs": {"file": path}, "results": [], "reason": str(outcome.error)}
    return json_of(outcome.fitted, path, outcome.reading, "", curve=False)


def _summary(fits: Sequence[Fit], files: int) -> Iterator[str]:
    """Iterate over sentences on the results of many curves: median, quartiles, mean and scatter."""
    from ..report.scatter import scatter_in_words

    for name in _SUMMARY:
        values = numpy.array([fit.values[name] for fit in fits if name in fit.values])
        if len(values) < 2 or any(fit.is_scaled for fit in fits):
            continue
        yield f"note: {name}: {len(values)} of {files} files; {scatter_in_words(RESULTS[name], values)}"
