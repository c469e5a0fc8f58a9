"""The report of a fitted force curve: results with their errors as texts, and sentences about them."""

from collections.abc import Iterator, Sequence
from math import floor, isfinite, log10

from ..model.fit_branches import LOADING
from ..model.fit_result import RESULTS, Fit
from ..quantities.formatting import Format, amount, bar_digits, significant, with_unit
from ..quantities.laws import LAWS
from ..quantities.nomenclature import NOMENCLATURE

WORDS = {
    "work_of_adhesion_opening": ("adhesion on opening", "w_open"),
    "work_of_adhesion_closing": ("adhesion on closing", "w_close"),
    "adhesion_hysteresis": ("adhesion hysteresis", "Δw"),
    "hysteresis_fraction": ("hysteresis over w", "Δw/w"),
    "contact_modulus": ("contact modulus", "E*"),
    "contact_point": ("contact point", "z_c"),
    "pull_off_force_fitted": ("pull-off, fitted", "P_c"),
    "pull_off_force_measured": ("pull-off, measured", "P_min"),
}
HEADS = ("quantity", "symbol", "fit", "unit", "noise", "calibration", "model")
_ABSENT = "–"
_SCALED = {"J/m^2": "J/m", "Pa": "Pa m^0.5"}  # units of wR and E*√R
_WITHOUT_RADIUS = {"work_of_adhesion_opening": "wR_open", "work_of_adhesion_closing": "wR_close",
    "adhesion_hysteresis": "ΔwR", "contact_modulus": "E*√R"}  # fmt: skip


def unit_of_result(fitted: Fit, name: str) -> str:
    """Return the SI unit of a result; without a radius, that of wR or E*√R."""
    return unit_without_radius(name) if fitted.is_scaled else NOMENCLATURE[RESULTS[name]].unit


def unit_without_radius(name: str) -> str:
    """Return the SI unit of a result that is fitted without a radius."""
    unit = NOMENCLATURE[RESULTS[name]].unit
    return _SCALED.get(unit, unit)


def sentence_of(name: str) -> str:
    """Return the name of a result in a sentence."""
    return WORDS[name][0].replace("adhesion on", "work of adhesion on")


def line_on_known(fitted: Fit, *, on_radius: str = "", stiffness: str = "") -> str:
    """Return the line above a fit: what was fitted, and what is known. `stiffness`: of the lever, as typed."""
    known = fitted.known
    law = LAWS[known.law].short if fitted.largest_adhesion is None else "Hertz"
    texts = [f"{fitted.kind} and force, by {law}"]
    if known.radius is not None:
        texts.append(f"R = {amount('reduced_radius', known.radius)}{on_radius}")
    if fitted.kind == "travel":
        texts.append(f"k = {stiffness or amount('lever_stiffness', known.stiffness)}")
    texts.append(f"{known.profile}, {int(fitted.goodness['points'])} points")
    return ", ".join(texts)


def rows_of_results(fitted: Fit) -> list[list[str]]:
    """Return the rows of the table of results, its header first."""
    return [[*HEADS], *(row_of_result(fitted, name) for name in RESULTS if name in fitted.values)]


# --- Results ----------------------------------------------------------------------------------------------------------


def row_of_result(fitted: Fit, name: str) -> list[str]:
    """Return the cells of a result under `HEADS`; a dash stands for an error that was not computed."""
    words, symbol = WORDS[name]
    symbol = _WITHOUT_RADIUS.get(name, symbol) if fitted.is_scaled else symbol
    errors = fitted.errors.get(name)
    if errors is None:
        (text, *_), unit = _cells(fitted, name, [fitted.values[name]])
        return [words, symbol, text, unit, "", "", ""]
    (text, *parts, total), unit = _cells(fitted, name, [fitted.values[name], *errors, errors.total])
    return [words, symbol, text if total == _ABSENT else f"{text} ± {total}", unit, *parts]


def in_words(fitted: Fit, name: str) -> str:
    """Return a result with its unit and total error, for a sentence."""
    errors = fitted.errors.get(name)
    is_known = errors is not None and isfinite(errors.total)
    texts, unit = _cells(fitted, name, [fitted.values[name], *([errors.total] if errors and is_known else [])])
    return with_unit(" ± ".join(texts), unit)


def _cells(fitted: Fit, name: str, numbers: Sequence[float | None]) -> tuple[list[str], str]:
    """Return a value and its errors as texts, and their unit; errors have two digits, the value ends where they do."""
    quantity, first = RESULTS[name], numbers[0] or 0.0
    if fitted.is_scaled and unit_of_result(fitted, name) != NOMENCLATURE[quantity].unit:
        power = 3 * floor(log10(abs(first)) / 3) if first else 0
        power = 0 if power in (0, 3) else power
        unit, factor = f"1e{power} {unit_of_result(fitted, name)}".removeprefix("1e0 "), 10.0**-power
    else:
        sizes = (abs(number) for number in (first, numbers[-1]) if number is not None and isfinite(number))
        unit, scale = Format().common_unit(quantity, [max(sizes)])
        factor = scale[1] / scale[0]
    errors = [None if number is None or not isfinite(number) else number * factor for number in numbers[1:]]
    total = errors[-1] if errors else None
    texts = [_ABSENT if error is None else significant(error, 2, zeros=True) for error in errors]
    return [_rounded(first * factor, total or 0.0), *texts], unit


def _rounded(value: float, error: float) -> str:
    """Return a value rounded to the second digit of its error, which may exceed it."""
    if error <= abs(value):
        return bar_digits(value, error)
    return f"{value:.{max(1 - floor(log10(error)), 0)}f}"


# --- Sentences --------------------------------------------------------------------------------------------------------


def sentences(fitted: Fit) -> Iterator[str]:
    """Iterate over the sentences below the table of a fit."""
    good = fitted.goodness
    if fitted.largest_adhesion is not None:
        limit = f"{fitted.largest_adhesion:.2g} J/m for wR"
        if not fitted.is_scaled:
            limit = amount("work_of_adhesion", fitted.largest_adhesion, Format(digits=2))
        yield f"w: below {limit}, by the noise"
    if is_sure(fitted) and (other := fitted.other_modulus) is not None:
        name, modulus = other
        yield f"{NOMENCLATURE[name].symbol} = {amount(name, modulus, Format(digits=3))} of the other body"
    if "tabor_parameter" in good:
        yield from _about_laws(fitted)
    if "unloaded_contact_over_radius" in good:
        widths = [significant(good[name], 2) for name in ("unloaded_contact_over_radius", "contact_over_radius")]
        yield f"without load a0/R = {widths[0]}; the widest contact has a/R = {widths[1]}"
    yield from _about_errors(fitted)
    yield _about_misfit(fitted)
    if fitted.baselines:
        yield _about_baselines(fitted)
    for code, text in fitted.remarks.items():
        yield f"{code}: {text}"


def is_sure(fitted: Fit) -> bool:
    """Return whether w and E* can be trusted: the curve is that of one contact and determines E*."""
    return {"poor-fit", "modulus-undetermined"}.isdisjoint(fitted.remarks)


def _about_laws(fitted: Fit) -> Iterator[str]:
    """Iterate over sentences with w by each law, starting with the law that holds."""
    name = next((name for name in RESULTS if name in fitted.values), "")
    best, profile = fitted.law_that_holds, fitted.known.profile
    order = sorted(fitted.by_law, key=lambda law: (law.partition(",")[0] != best, profile not in law, law))
    texts = []
    for key in order:
        law, _, variant = key.partition(", ")
        words = {"": "", "sphere": " for a sphere", "z0/2": " at z0/2"}[variant]
        number = amount("work_of_adhesion", fitted.by_law[key][name], Format(digits=3))
        texts.append(f"{LAWS[law].short}{words} {number}")
    tabor = significant(fitted.goodness["tabor_parameter"], 2)
    advice = "" if best == fitted.known.law else f": take --model {best}"
    yield f"w by law, the one that holds first: {', '.join(texts)} (Tabor parameter {tabor}; JKR needs 5{advice})"
    if profile == "sphere":
        yield "only JKR is known for a sphere: the other laws are fitted for a paraboloid"


def _about_errors(fitted: Fit) -> Iterator[str]:
    """Iterate over at most one sentence: the main error of E*, if it is not noise."""
    errors = fitted.errors["contact_modulus"]
    parts = {"the instrument (R, k)": errors.calibration or 0.0, "the model": errors.model or 0.0}
    largest = max(parts, key=lambda part: parts[part])
    if errors.statistical is not None and isfinite(errors.statistical) and parts[largest] > errors.statistical:
        yield f"most of the error of E* comes from {largest}, not from noise"


def _about_misfit(fitted: Fit) -> str:
    """Return the sentence on the misfit and the number of points."""
    good = fitted.goodness
    share = f", {good['rms_over_pull_off']:.1%} of P_c" if "rms_over_pull_off" in good else ""
    text = f"misfit {amount('pull_off_force', good['rms'], Format(digits=2))} rms{share}"
    if fitted.kind != "contact radius":
        text += f", {good['rms_over_noise']:.2g} times the noise"
    independent = good["independent_points"]
    alike = f"{independent:.0f} of them independent" if independent >= 1.5 else "all of one trend"
    points = f"{good['points']:.0f} points, {alike}"
    past = f", {good['points_past_jump']:.0f} past the fitted jump-off" if good["points_past_jump"] else ""
    return f"{text}; {points}{past}"


def _about_baselines(fitted: Fit) -> str:
    """Return the sentence on the baselines."""
    texts = []
    for name, base in fitted.baselines.items():
        unit, scale = Format().common_unit("load", [max(abs(base["force"]), base["error"])])
        value, error = (base[part] * scale[1] / scale[0] for part in ("force", "error"))
        where = "before the contact" if name == LOADING else "behind the contact"
        texts.append(f"{_rounded(value, error)} ± {significant(error, 2, zeros=True)} {unit} {where}")
    return f"baseline: {', '.join(texts)}"
