"""The fit of a force curve as text, JSON and a row of a table."""

from collections.abc import Mapping, Sequence
from math import isfinite
from typing import Any, TextIO

from .. import __version__
from ..model.fit_result import RESULTS, Fit
from ..quantities.nomenclature import NOMENCLATURE, bracketed
from ..report.fitted import HEADS, WORDS, row_of_result, sentences, unit_of_result, unit_without_radius
from ..text import json_text, say, say_wrapped, write_texts

FILE, LIMIT, REASON = "file", "largest_work_of_adhesion", "status"


def write_fit(fitted: Fit, out: TextIO, *, heading: str, following: str) -> None:
    """Write a fit as a table, with sentences below. `following`: the command that goes on, if there is one."""
    say_wrapped(heading, out)
    write_texts(HEADS, [row_of_result(fitted, name) for name in RESULTS if name in fitted.values], out)
    for line in sentences(fitted):
        say_wrapped(line, out)
    if following:
        say_wrapped(f"then: {following}", out)


# --- JSON -------------------------------------------------------------------------------------------------------------


def json_of(fitted: Fit, path: str, reading: str, following: str, *, curve: bool) -> dict[str, Any]:
    """Return a fit as an object of JSON, in SI units. `curve`: whether it has the points."""
    results = []
    for name in RESULTS:
        if name not in fitted.values:
            continue
        entry: dict[str, Any] = {"name": name, "symbol": WORDS[name][1], "value": _finite(fitted.values[name]),
            "unit": unit_of_result(fitted, name)}  # fmt: skip
        if (errors := fitted.errors.get(name)) is not None:
            parts = {part: _finite(value) for part, value in errors._asdict().items()}
            entry["errors"] = {**parts, "total": _finite(errors.total)}
        results.append(entry)
    matrix = [[_finite(float(cell)) for cell in row] for row in fitted.covariance]
    answer: dict[str, Any] = {
        "inputs": {"file": path, "read": reading, **_inputs(fitted)},
        "results": results,
        "covariance": {"names": [*fitted.names], "matrix": matrix},
        "by_law": {law: {name: _finite(value) for name, value in each.items()} for law, each in fitted.by_law.items()},
        "law_that_holds": fitted.law_that_holds,
        LIMIT: fitted.largest_adhesion,
        "other_body": None if (other := fitted.other_modulus) is None else dict([other]),
        "fitted_loads": {branch: [*map(_finite, ends)] for branch, ends in fitted.fitted_loads.items()},
        "baselines": {name: {part: _finite(each) for part, each in base.items()}
            for name, base in fitted.baselines.items()},
        "goodness": {name: _finite(value) for name, value in fitted.goodness.items()},
        "notes": [{"code": code, "text": text} for code, text in fitted.remarks.items()],
        "next": following or None,
        "version": __version__,
    }  # fmt: skip
    if curve:
        answer["curve"] = {name: _column(column) for name, column in fitted.points.items()}
    return answer


def _inputs(fitted: Fit) -> dict[str, Any]:
    """Return what a fit was given, with standard deviations."""
    known, stiffness = fitted.known, _finite(fitted.known.stiffness)
    asked, unit = known.range, "1" if known.range is not None and known.range.is_share else "N"
    return {
        "reduced_radius": known.radius,
        "reduced_radius_err": None if known.radius is None else known.radius * known.radius_error or None,
        "lever_stiffness": stiffness,
        "lever_stiffness_err": None if stiffness is None else stiffness * known.stiffness_error or None,
        "atomic_spacing": known.spacing,
        "model": known.law,
        "profile": known.profile,
        "branch": known.branch,
        "range": None if asked is None else {"low": asked.low, "high": asked.high, "unit": unit},
        "baseline": "tilt" if known.tilt else "median",
    }


def _finite(value: float | None) -> float | None:
    return float(value) if value is not None and isfinite(value) else None


def _column(column: Any) -> list[Any]:
    return [*map(_cell, column.tolist())]


def _cell(cell: Any) -> Any:
    return cell if isinstance(cell, str) else _finite(cell)


def write_json(answers: Sequence[Mapping[str, Any]], out: TextIO) -> None:
    """Write one object, or an array of several."""
    say(json_text(answers[0] if len(answers) == 1 else [*answers], out), out)


# --- Rows -------------------------------------------------------------------------------------------------------------


def heads_of(*, is_scaled: bool) -> list[str]:
    """Return the headers of a row for each file."""
    heads = [FILE]
    for name, quantity in RESULTS.items():
        unit = bracketed(unit_without_radius(name) if is_scaled else NOMENCLATURE[quantity].unit)
        heads.append(f"{name}{unit}")
        if not name.startswith("pull_off"):
            heads.append(f"{name}_err{unit}")
    limit = unit_without_radius("work_of_adhesion_opening") if is_scaled else NOMENCLATURE["work_of_adhesion"].unit
    return [*heads, f"{LIMIT}{bracketed(limit)}", "codes", REASON]


def row_of(path: str, fitted: Fit | None, reason: str = "") -> list[Any]:
    """Return the row of a file, with empty cells where there is no result."""
    row: list[Any] = [path]
    for name in RESULTS:
        value = fitted.values.get(name) if fitted else None
        row.append(_finite(value))
        if not name.startswith("pull_off"):
            errors = fitted.errors.get(name) if fitted else None
            row.append(_finite(errors.total) if errors else None)
    codes = " ".join(fitted.remarks) if fitted else ""
    return [*row, fitted.largest_adhesion if fitted else None, codes or None, reason or None]


def curve_columns(fitted: Fit) -> tuple[list[str], list[Any]]:
    """Return the headers and the columns of the points of a fit."""
    return [*fitted.curve], [_column(column) for column in fitted.curve.values()]
