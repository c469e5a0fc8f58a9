"""The fit of a force curve as text, JSON and a row of a table."""

from collections.abc import Iterator, Mapping, Sequence
from math import floor, isfinite, log10
from typing import Any, TextIO

from .. import __version__
from ..model.fit_result import RESULTS, Fit
from ..quantities.formatting import Format, amount, bar_digits, significant, with_unit
from ..quantities.laws import LAWS
from ..quantities.nomenclature import NOMENCLATURE, bracketed
from ..text import json_text, say, say_wrapped, write_texts

_WORDS = {
    "work_of_adhesion_opening": ("work of adhesion, opening", "w_open"),
    "work_of_adhesion_closing": ("work of adhesion, closing", "w_close"),
    "adhesion_hysteresis": ("adhesion hysteresis", "Δw"),
    "hysteresis_fraction": ("as a part of w", "Δw/w"),
    "contact_modulus": ("contact modulus", "E*"),
    "contact_point": ("contact point", "z_c"),
    "pull_off_force_fitted": ("pull-off force, fitted", "P_c"),
    "pull_off_force_measured": ("pull-off force, measured", "P_min"),
}
_SCALED = {"J/m^2": "J/m", "Pa": "Pa m^0.5"}  # of wR and E*√R
_WITHOUT_RADIUS = {"work_of_adhesion_opening": "wR_open", "work_of_adhesion_closing": "wR_close",
    "adhesion_hysteresis": "ΔwR", "contact_modulus": "E*√R"}  # fmt: skip
FILE, REASON = "file", "status"


def unit_of_result(fitted: Fit, name: str) -> str:
    """Return the SI unit of a result; without a radius, that of wR or E*√R."""
    unit = NOMENCLATURE[RESULTS[name]].unit
    return _SCALED.get(unit, unit) if fitted.is_scaled else unit


def in_words(fitted: Fit, name: str) -> str:
    """Return a result with its unit and its total error, for a sentence."""
    value, errors = fitted.values[name], fitted.errors.get(name)
    texts, unit = _cells(fitted, name, [value, *([errors.total] if errors else [])])
    return with_unit(" ± ".join(texts), unit)


def _cells(fitted: Fit, name: str, numbers: Sequence[float]) -> tuple[list[str], str]:
    """Return a value and its errors as texts in one unit; errors with two digits, the value to their last place."""
    form = Format()
    quantity = RESULTS[name]
    if fitted.is_scaled and unit_of_result(fitted, name) != NOMENCLATURE[quantity].unit:
        power = 3 * floor(log10(abs(numbers[0])) / 3) if numbers[0] else 0
        power = 0 if power in (0, 3) else power
        unit, factor = f"1e{power} {unit_of_result(fitted, name)}".removeprefix("1e0 "), 10.0**-power
    else:
        shown, scale = form.common_unit(quantity, [abs(numbers[0])])
        unit, factor = shown, scale[1] / scale[0]
    value, *errors = (number * factor for number in numbers)
    total = errors[-1] if errors else 0.0
    texts = [
        bar_digits(value, total),
        *(significant(error, 2, zeros=True) if isfinite(error) else "–" for error in errors),
    ]
    return texts, unit


# --- Text -------------------------------------------------------------------------------------------------------------


def write_fit(fitted: Fit, out: TextIO, *, heading: str, following: str, body: tuple[str, float] | None) -> None:
    """Write a fit as a table, with sentences below. `following`: the command that goes on, if there is one."""
    say_wrapped(heading, out)
    rows = []
    for name in RESULTS:
        if name not in fitted.values:
            continue
        words, symbol = _WORDS[name]
        errors = fitted.errors.get(name)
        parts = [errors.statistical, errors.calibration, errors.model, errors.total] if errors else []
        texts, unit = _cells(fitted, name, [fitted.values[name], *parts])
        symbol = _WITHOUT_RADIUS.get(name, symbol) if fitted.is_scaled else symbol
        cells = [*texts[1:4], texts[0] + (f" ± {texts[4]}" if parts else "")] if parts else ["", "", "", texts[0]]
        rows.append([words, symbol, cells[3], unit, *cells[:3]])
    write_texts(["quantity", "symbol", "fit", "unit", "noise", "R, k", "model"], rows, out)
    for line in sentences(fitted, body):
        say_wrapped(line, out)
    if following:
        say_wrapped(f"then: {following}", out)


def sentences(fitted: Fit, body: tuple[str, float] | None = None) -> Iterator[str]:
    """Iterate over the sentences below a fit."""
    values, good = fitted.values, fitted.goodness
    if fitted.largest_adhesion is not None:
        unit = "work_of_adhesion"
        limit = amount(unit, fitted.largest_adhesion, Format(digits=2))
        yield f"w: below {limit if not fitted.is_scaled else f'{fitted.largest_adhesion:.2g} J/m for wR'}, by the noise"
    if body is not None:
        name, modulus = body
        yield f"{NOMENCLATURE[name].symbol} = {amount(name, modulus, Format(digits=3))} of the other body"
    if "tabor_parameter" in good and not fitted.is_scaled:
        yield from _about_laws(fitted)
    largest = [name for name, errors in fitted.errors.items() if max(errors) > errors.statistical > 0]
    if "contact_modulus" in largest:
        by = max(("calibration", "model"), key=lambda part: getattr(fitted.errors["contact_modulus"], part))
        cause = {"calibration": "the instrument (R, k, baseline)", "model": "the model"}[by]
        yield f"the error of E* is not that of noise: most of it is of {cause}"
    if "rms" in good and "pull_off_force_fitted" in values:
        rms = amount("pull_off_force", good["rms"], Format(digits=2))
        noise = good["rms_over_noise"]
        yield (
            f"misfit {rms} rms, {good['rms_over_pull_off']:.1%} of P_c, {noise:.2g} of the noise; {good['points']:.0f} "
            f"points, {good['independent_points']:.0f} of them independent"
        )
    for code, text in fitted.remarks.items():
        yield f"{code}: {text}"


def _about_laws(fitted: Fit) -> Iterator[str]:
    """Iterate over sentences on w by each law, the one that holds first."""
    name = next((name for name in RESULTS if name in fitted.values), "")
    best = fitted.law_that_holds
    order = sorted(fitted.by_law, key=lambda law: (law.partition(",")[0] != best, law))
    texts = [
        f"{LAWS[law.partition(',')[0]].short}{law[len(law.partition(',')[0]) :]} "
        + amount("work_of_adhesion", fitted.by_law[law][name], Format(digits=3))
        for law in order
    ]
    number = significant(fitted.goodness["tabor_parameter"], 2)
    yield f"w by law, the one that holds first: {', '.join(texts)} (Tabor parameter {number}; JKR needs 5)"


# --- JSON -------------------------------------------------------------------------------------------------------------


def json_of(fitted: Fit, path: str, reading: str, following: str, *, curve: bool) -> dict[str, Any]:
    """Return a fit as an object of JSON, in SI units. `curve`: whether it has the points."""
    known = fitted.known
    inputs = {
        "file": path, "read": reading, "reduced_radius": known.radius, "lever_stiffness": _finite(known.stiffness),
        "model": known.law, "profile": known.profile,
    }  # fmt: skip
    results = []
    for name in RESULTS:
        if name not in fitted.values:
            continue
        errors = fitted.errors.get(name)
        parts = {**{part: _finite(value) for part, value in errors._asdict().items()}} if errors else None
        entry: dict[str, Any] = {"name": name, "symbol": _WORDS[name][1], "value": _finite(fitted.values[name]),
            "unit": unit_of_result(fitted, name)}  # fmt: skip
        if parts is not None and errors is not None:
            entry["errors"] = {**parts, "total": _finite(errors.total)}
        results.append(entry)
    matrix = [[_finite(float(cell)) for cell in row] for row in fitted.covariance]
    answer: dict[str, Any] = {
        "inputs": inputs,
        "results": results,
        "covariance": {"names": [*fitted.names], "matrix": matrix},
        "by_law": {law: {name: _finite(value) for name, value in each.items()} for law, each in fitted.by_law.items()},
        "law_that_holds": fitted.law_that_holds,
        "largest_work_of_adhesion": fitted.largest_adhesion,
        "goodness": {name: _finite(value) for name, value in fitted.goodness.items()},
        "notes": [{"code": code, "text": text} for code, text in fitted.remarks.items()],
        "next": following or None,
        "version": __version__,
    }
    if curve:
        answer["curve"] = {name: _column(column) for name, column in fitted.points.items()}
    return answer


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
        unit = NOMENCLATURE[quantity].unit
        unit = bracketed(_SCALED.get(unit, unit) if is_scaled else unit)
        heads.append(f"{name}{unit}")
        if not name.startswith("pull_off"):
            heads.append(f"{name}_err{unit}")
    return [*heads, "codes", REASON]


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
    return [*row, codes or None, reason or None]


def curve_columns(fitted: Fit) -> tuple[list[str], list[Any]]:
    """Return the headers and the columns of the points of a fit."""
    x = "contact_radius_at_load [m]" if fitted.kind == "contact radius" else "z [m]"
    rate, heads = "J/m" if fitted.is_scaled else "J/m^2", {
        "branch": "branch", "z": x, "force": "load [N]", "model": "load_fitted [N]", "residual": "residual [N]",
        "release_rate": "energy_release_rate", "contact_radius": "contact_radius",
    }  # fmt: skip
    heads["release_rate"] += f" [{rate}]"
    heads["contact_radius"] += " [m^0.5]" if fitted.is_scaled else " [m]"
    columns = [fitted.points[name].tolist() for name in heads]
    return [*heads.values()], [[_cell(cell) for cell in column] for column in columns]
