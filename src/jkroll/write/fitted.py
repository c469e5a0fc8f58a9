"""The fit of a force curve as text, JSON, BibTeX, a Methods paragraph, and a row of a table."""

from collections.abc import Iterator, Mapping, Sequence
from math import isfinite
from typing import Any, TextIO

from .. import __version__
from ..fitting.branches import TRAVEL
from ..fitting.result import RESULTS, Fit
from ..quantities.formatting import Format, amount
from ..quantities.laws import JKR_OF_SPHERE, LAWS, SPHERE
from ..quantities.markup import as_latex
from ..quantities.nomenclature import NOMENCLATURE, bracketed
from ..quantities.shown import Part
from ..quantities.values import Measured
from ..report.fitted import (
    HEADS,
    WORDS,
    in_words,
    line_on_known,
    name_in_sentence,
    rows_of_results,
    sentences,
    unit_of_result,
    unit_without_radius,
    warnings,
)
from ..text import as_arguments, json_text, listed, say, say_wrapped, text_columns, write_table
from .sources import bibtex, cite_command, references

FILE, LIMIT, REASON = "file", "largest_work_of_adhesion", "status"


def write_fit(fitted: Fit, out: TextIO, *, heading: str, following: Sequence[str]) -> None:
    """Write a fit as a table, with sentences around it. `following`: the lines on the command to run next."""
    for line in (*warnings(fitted), heading):
        say_wrapped(line, out)
    write_table(text_columns(rows_of_results(fitted), words=len(HEADS)), [], out)
    for line in (*sentences(fitted), *following):
        say_wrapped(line, out)


def parts_of_fit(fitted: Fit) -> list[Part]:
    """Return the lines and the table of a fit for a notebook, in which arguments replace options."""
    columns = text_columns(rows_of_results(fitted), words=len(HEADS))
    above = map(as_arguments, warnings(fitted))
    return [*above, line_on_known(fitted), (columns, []), *map(as_arguments, sentences(fitted))]


# --- JSON -------------------------------------------------------------------------------------------------------------


def json_of(fitted: Fit, path: str, reading: str, following: str, *, curve: bool) -> dict[str, Any]:
    """Return a fit as a JSON object, in SI units. `curve`: True to include the points."""
    results = []
    for name in RESULTS:
        if name not in fitted.values:
            continue
        entry: dict[str, Any] = {"name": name, "symbol": WORDS[name][1], "value": _finite(fitted.values[name]),
            "unit": unit_of_result(fitted, name)}  # fmt: skip
        errors = fitted.errors.get(name)
        if errors is not None:
            entry["errors"] = {**_all_finite(errors._asdict()), "total": _finite(errors.total)}
        results.append(entry)
    other = fitted.other_modulus
    answer: dict[str, Any] = {
        "inputs": {"file": path, "read": reading, **_inputs(fitted)},
        "results": results,
        "covariance": {"names": [*fitted.names], "matrix": [*map(_column, fitted.covariance)]},
        "by_law": {law: _all_finite(values) for law, values in fitted.by_law.items()},
        "law_that_holds": fitted.law_that_holds,
        LIMIT: fitted.largest_adhesion,
        "other_body": None if other is None else dict([other]),
        "fitted_loads": {branch: [*map(_finite, ends)] for branch, ends in fitted.fitted_loads.items()},
        "baselines": {name: _all_finite(base) for name, base in fitted.baselines.items()},
        "goodness": _all_finite(fitted.goodness),
        "notes": [{"code": code, "text": text} for code, text in fitted.remarks.items()],
        "next": following or None,
        "version": __version__,
    }
    if curve:
        answer["curve"] = {name: _column(column) for name, column in fitted.points.items()}
    return answer


def _inputs(fitted: Fit) -> dict[str, Any]:
    """Return the radius and the stiffness with their standard deviations, the spacing and the options of a fit."""
    known = fitted.known
    inputs: dict[str, Any] = {
        "reduced_radius": known.radius,
        "reduced_radius_err": None,
        "lever_stiffness": _finite(known.stiffness),
        "lever_stiffness_err": None,
        "atomic_spacing": known.spacing,
        "model": known.law,
        "profile": known.profile,
        "branch": known.branch,
        "range": None,
        "baseline": "tilt" if known.tilt else "median",
    }
    if known.radius is not None:
        inputs["reduced_radius_err"] = known.radius * known.radius_error or None
    if isfinite(known.stiffness):
        inputs["lever_stiffness_err"] = known.stiffness * known.stiffness_error or None
    if known.range is not None:
        unit = "1" if known.range.is_share else "N"
        inputs["range"] = {"low": known.range.low, "high": known.range.high, "unit": unit}
    return inputs


def _all_finite(values: Mapping[str, float | None]) -> dict[str, float | None]:
    """Return values by name, with None for those that are infinite or nan."""
    return {name: _finite(value) for name, value in values.items()}


def _finite(value: float | None) -> float | None:
    return float(value) if value is not None and isfinite(value) else None


def _column(column: Any) -> list[Any]:
    """Return an array as a list, with None for numbers that are infinite or nan."""
    return [*map(_cell, column.tolist())]


def _cell(cell: Any) -> Any:
    return cell if isinstance(cell, str) else _finite(cell)


def write_json(answers: Sequence[Mapping[str, Any]], out: TextIO) -> None:
    """Write the JSON object of one fit, or an array of the objects of several fits."""
    if len(answers) == 1:
        say(json_text(answers[0], out), out)
    else:
        say(json_text([*answers], out), out)


# --- Sources ----------------------------------------------------------------------------------------------------------


def write_fit_citations(fitted: Fit, out: TextIO) -> None:
    """Write the BibTeX entries of this program and of the law and profile of a fit."""
    for entry in (references()["program"], *_laws_cited(fitted)):
        say(bibtex(entry), out)


def write_fit_methods(fitted: Fit, out: TextIO) -> None:
    """Write a paragraph for a Methods section: the data, the method and the results."""
    say_wrapped(" ".join(_methods(fitted)), out, 0)


def _laws_cited(fitted: Fit) -> list[Mapping[str, str]]:
    """Return the references of the law of a fit, except Hertz' law, and of the profile of a true sphere."""
    known, cited = references(), []
    if fitted.largest_adhesion is None:
        cited.append(known[fitted.known.law])
    if fitted.known.profile == SPHERE:
        cited.append(known[JKR_OF_SPHERE])
    return cited


def _methods(fitted: Fit) -> Iterator[str]:
    """Iterate over the sentences of a Methods section."""
    known = fitted.known
    theory = "Hertz' theory"
    if fitted.largest_adhesion is None:
        theory = f"the {LAWS[known.law].title} theory"
    shape = "a rigid sphere" if known.profile == SPHERE else "a paraboloid"
    if known.radius is not None:
        radius = amount("reduced_radius", _with_error(known.radius, known.radius_error))
        shape += as_latex(f" of radius {radius}")
    program, of_law = cite_command([references()["program"]]), cite_command(_laws_cited(fitted))
    yield (
        f"With jkroll {__version__}{program} we fitted the {fitted.kind} and the force of the curve by {theory} for "
        f"{shape}{of_law}."
    )
    if isfinite(known.stiffness) and fitted.kind == TRAVEL:
        stiffness = amount("lever_stiffness", _with_error(known.stiffness, known.stiffness_error))
        yield as_latex(f"The lever has a stiffness of {stiffness}.")
    form = Format(digits=3)
    branches = []
    for name, (low, high) in fitted.fitted_loads.items():
        branches.append(f"{name}, at loads of {amount('load', low, form)} to {amount('load', high, form)}")
    first, *others = branches
    yield as_latex(f"Least squares gave all results from one branch ({first}).")
    if others:
        shared = "with the modulus and contact point of the first"
        yield as_latex(f"The other branch gave a work of adhesion of its own ({others[0]}), {shared}.")
    if fitted.baselines:
        line = "a line" if known.tilt else "the median"
        yield f"The zero of the force is {line} of the force out of contact."
    else:
        yield "The force was not shifted."
    huber = "those beyond three standard deviations have Huber's weights"
    if "few-independent" in fitted.remarks:
        yield f"Residuals were taken as white, and {huber}."
        yield "Variances were multiplied by the correlation time of the residuals, as few points are independent."
    else:
        yield f"Residuals were whitened as an autoregression of first order, and {huber}."
    results = [f"{name_in_sentence(name)} {in_words(fitted, name)}" for name in RESULTS if name in fitted.errors]
    yield as_latex(f"Results: {listed(results)}.")
    yield "Errors are standard deviations: of noise, of the calibration (radius, stiffness) and of the model."


def _with_error(value: float, relative: float) -> float | Measured:
    return Measured(value, value * relative) if relative else value


# --- Rows -------------------------------------------------------------------------------------------------------------


def heads_of(*, is_scaled: bool) -> list[str]:
    """Return the header of the table with a row for each file. `is_scaled`: True if no radius is given."""
    units = {}
    for name, quantity in RESULTS.items():
        units[name] = bracketed(unit_without_radius(name) if is_scaled else NOMENCLATURE[quantity].unit)
    heads = [FILE]
    for name, unit in units.items():
        heads.append(f"{name}{unit}")
        if not name.startswith("pull_off"):
            heads.append(f"{name}_err{unit}")
    return [*heads, f"{LIMIT}{units['work_of_adhesion_opening']}", "codes", REASON]


def row_of(path: str, fitted: Fit | None, reason: str = "") -> list[Any]:
    """Return the row of a file, with None for missing results. `reason`: why there is no fit."""
    if fitted is None:
        empty = [None] * (len(heads_of(is_scaled=False)) - 2)  # all columns but the file and the reason
        return [path, *empty, reason or None]
    row: list[Any] = [path]
    for name in RESULTS:
        row.append(_finite(fitted.values.get(name)))
        if not name.startswith("pull_off"):
            errors = fitted.errors.get(name)
            row.append(None if errors is None else _finite(errors.total))
    return [*row, fitted.largest_adhesion, " ".join(fitted.remarks) or None, reason or None]


def curve_columns(fitted: Fit) -> tuple[list[str], list[Any]]:
    """Return the header and the columns of the points of a fit."""
    return [*fitted.curve], [_column(column) for column in fitted.curve.values()]
