"""The report of a fitted force curve: its results and their errors as texts, and sentences about the fit."""

from collections.abc import Iterator, Sequence
from math import floor, isfinite, isnan, log10, nan

from ..fitting.branches import LOADING, RADIUS, TRAVEL
from ..fitting.goodness import LAW_OFF
from ..fitting.result import HALF_SPACING, LEAST_TABOR, RESULTS, Fit, law_and_variant
from ..quantities.formatting import RESULT_DIGITS, Format, amount, rounded_at_error, significant, with_unit
from ..quantities.laws import LAWS, PARABOLOID, SPHERE
from ..quantities.nomenclature import NOMENCLATURE

# The name in words and the symbol of each result.
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
_ROUNDING = 1e-4  # share of the total below which a part of an error is shown as 0
_ABSENT, _UNBOUNDED = "–", "∞"
_SCALED = {"J/m^2": "J/m", "Pa": "Pa m^0.5"}  # units of wR and E*√R, by those of w and E*
# The symbols of results that are fitted without a radius.
_WITHOUT_RADIUS = {"work_of_adhesion_opening": "wR_open", "work_of_adhesion_closing": "wR_close",
    "adhesion_hysteresis": "ΔwR", "contact_modulus": "E*√R"}  # fmt: skip
_VARIANTS = {PARABOLOID: "", SPHERE: " for a sphere", HALF_SPACING: " at z0/2"}  # variants of a law, in words


def unit_of_result(fitted: Fit, name: str) -> str:
    """Return the SI unit of a result; without a radius, the unit of wR or E*√R."""
    return unit_without_radius(name) if fitted.is_scaled else NOMENCLATURE[RESULTS[name]].unit


def unit_without_radius(name: str) -> str:
    """Return the SI unit of a result that was fitted without a radius."""
    unit = NOMENCLATURE[RESULTS[name]].unit
    return _SCALED.get(unit, unit)


def name_in_sentence(name: str) -> str:
    """Return the name of a result for a sentence."""
    return WORDS[name][0].replace("adhesion on", "work of adhesion on")


def symbol_of_result(fitted: Fit, name: str) -> str:
    """Return the symbol of a result; without a radius, that of wR or E*√R."""
    symbol = WORDS[name][1]
    return _WITHOUT_RADIUS.get(name, symbol) if fitted.is_scaled else symbol


def line_on_known(fitted: Fit, *, on_radius: str = "", stiffness: str = "") -> str:
    """Return the line above a fit: the kind of data, the law, the known inputs and the number of points.

    `on_radius`: the text after the radius; `stiffness`: the stiffness of the lever, as typed.
    """
    known = fitted.known
    texts = [f"{fitted.kind} and force, by {fitted.theory}"]
    if known.radius is not None:
        texts.append(f"R = {amount('reduced_radius', known.radius)}{on_radius}")
    if fitted.kind == TRAVEL:
        texts.append(f"k = {stiffness or amount('lever_stiffness', known.stiffness)}")
    texts.append(f"{known.profile}, {int(fitted.goodness['points'])} points")
    return ", ".join(texts)


def rows_of_results(fitted: Fit) -> list[list[str]]:
    """Return the rows of the table of results, its header first."""
    return [[*HEADS], *(row_of_result(fitted, name) for name in RESULTS if name in fitted.values)]


# --- Results ----------------------------------------------------------------------------------------------------------


def row_of_result(fitted: Fit, name: str) -> list[str]:
    """Return the cells of a result under `HEADS`.

    A dash stands for a part of the error that was not computed; a result without any errors has empty cells.
    """
    words, symbol = WORDS[name][0], symbol_of_result(fitted, name)
    errors = fitted.errors.get(name)
    if errors is None:
        (text,), unit = _cells(fitted, name, [])
        return [words, symbol, text, unit, "", "", ""]
    (text, *parts, total), unit = _cells(fitted, name, [*errors, errors.total])
    if total != _ABSENT:
        text = f"{text} ± {total}"
    return [words, symbol, text, unit, *parts]


def in_words(fitted: Fit, name: str) -> str:
    """Return a result with its unit for a sentence, and with its total error if that is finite."""
    errors = fitted.errors.get(name)
    if errors is None or not isfinite(errors.total):
        texts, unit = _cells(fitted, name, [])
    else:
        texts, unit = _cells(fitted, name, [errors.total])
    return with_unit(" ± ".join(texts), unit)


def _cells(fitted: Fit, name: str, errors: Sequence[float | None]) -> tuple[list[str], str]:
    """Return the texts of a result and its errors, and their unit.

    Errors have two digits. The last error is the total, and the result is rounded at the second digit of the total.
    """
    value = fitted.values[name]
    known = [nan if error is None else error for error in errors]
    total = known[-1] if known and isfinite(known[-1]) else 0.0
    unit, factor = _unit_of(fitted, name, value, total)
    known = [0.0 if error < _ROUNDING * total else error for error in known]
    texts = [_error_in_words(error * factor) for error in known]
    return [_rounded(value * factor, total * factor), *texts], unit


def _error_in_words(error: float) -> str:
    """Return an error with two digits; a dash stands for nan, an error that was not computed."""
    if isfinite(error):
        return significant(error, 2, zeros=True) if error else "0"
    return _ABSENT if isnan(error) else _UNBOUNDED


def _unit_of(fitted: Fit, name: str, value: float, error: float) -> tuple[str, float]:
    """Return the unit that suits a result and its error, and the factor to this unit from SI units."""
    unit = unit_of_result(fitted, name)
    if unit == NOMENCLATURE[RESULTS[name]].unit:
        shown = Format().common_unit(RESULTS[name], [max(abs(value), error)])
        return shown.text, shown.convert(1.0)
    power = 3 * floor(log10(abs(value)) / 3) if value else 0
    if power in (0, 3):
        return unit, 1.0
    return f"1e{power} {unit}", 10.0**-power


def _rounded(value: float, error: float) -> str:
    """Return a value rounded at the second digit of its error; to four digits if the error is 0."""
    return rounded_at_error([value], error)[0] if error else significant(value, RESULT_DIGITS)


# --- Sentences --------------------------------------------------------------------------------------------------------


def sentences(fitted: Fit) -> Iterator[str]:
    """Iterate over the sentences below the table of a fit: its findings, and its other remarks with their codes."""
    yield from findings(fitted)
    for code, text in fitted.remarks.items():
        if code != LAW_OFF:
            yield f"{code}: {text}"


def warnings(fitted: Fit) -> Iterator[str]:
    """Iterate over the sentences above the table of a fit: what to do if the fitted law does not hold."""
    if LAW_OFF in fitted.remarks:
        yield f"{LAW_OFF}: {fitted.remarks[LAW_OFF]}"


def findings(fitted: Fit) -> Iterator[str]:
    """Iterate over the sentences on the results of a fit, without its remarks."""
    good = fitted.goodness
    if fitted.largest_adhesion is not None:
        limit = f"{fitted.largest_adhesion:.2g} J/m for wR"
        if not fitted.is_scaled:
            limit = amount("work_of_adhesion", fitted.largest_adhesion, Format(digits=2))
        yield f"w is below {limit}; the noise hides a smaller one"
    if is_sure(fitted) and fitted.other_modulus is not None:
        name, modulus = fitted.other_modulus
        yield f"{NOMENCLATURE[name].symbol} = {amount(name, modulus, Format(digits=3))} for the other body"
    if "tabor_parameter" in good:
        yield from _about_laws(fitted)
    if "unloaded_contact_over_radius" in good:
        unloaded = significant(good["unloaded_contact_over_radius"], 2)
        widest = significant(good["contact_over_radius"], 2)
        yield f"without load a0/R = {unloaded}; the widest contact has a/R = {widest}"
    yield from _about_errors(fitted)
    yield _about_misfit(fitted)
    if fitted.baselines:
        yield _about_baselines(fitted)


def is_sure(fitted: Fit) -> bool:
    """Return whether w and E* can be trusted: forces, branches and fit are good, and the curve determines E*."""
    doubts = {"spring-differs", "negative-hysteresis", "poor-fit", "modulus-undetermined"}
    return doubts.isdisjoint(fitted.remarks)


def _about_laws(fitted: Fit) -> Iterator[str]:
    """Iterate over the sentence with w by each law, beginning with the law that holds, and one on a true sphere."""
    name = next((name for name in RESULTS if name in fitted.values), "")
    best, profile = fitted.law_that_holds, fitted.known.profile

    def rank(key: str) -> tuple[bool, bool, str]:
        law, variant = law_and_variant(key)
        return law != best, variant != profile, key

    texts = []
    for key in sorted(fitted.by_law, key=rank):
        law, variant = law_and_variant(key)
        number = amount("work_of_adhesion", fitted.by_law[key][name], Format(digits=3))
        texts.append(f"{LAWS[law].short}{_VARIANTS[variant]} {number}")
    tabor = significant(fitted.goodness["tabor_parameter"], 2)
    yield f"w by law, the best one first: {', '.join(texts)} (Tabor parameter {tabor}; JKR needs {LEAST_TABOR:.0f})"
    if profile == SPHERE:
        yield "only JKR is known for a sphere: the other laws are fitted for a paraboloid"


def _about_errors(fitted: Fit) -> Iterator[str]:
    """Iterate over at most one sentence: the main source of the error of E*, unless it is noise.

    There is no sentence if the remark "lever-decides" already names the spring as the source.
    """
    if "lever-decides" in fitted.remarks:
        return
    errors = fitted.errors["contact_modulus"]
    parts = {"the instrument (R, k)": errors.calibration or 0.0, "the model": errors.model or 0.0}
    largest = max(parts, key=lambda part: parts[part])
    if errors.statistical is not None and isfinite(errors.statistical) and parts[largest] > errors.statistical:
        yield f"most of the error of E* comes from {largest}, not from noise"


def _about_misfit(fitted: Fit) -> str:
    """Return the sentence on the misfit and the number of points."""
    good = fitted.goodness
    text = f"misfit {amount('pull_off_force', good['rms'], Format(digits=2))} rms"
    if "rms_over_pull_off" in good:
        text += f", {good['rms_over_pull_off']:.1%} of P_c"
    if fitted.kind != RADIUS:
        text += f", {significant(good['rms_over_noise'], 2)} times the noise"
    text += f"; {good['points']:.0f} points"
    if good["independent_points"] >= 1.5:
        text += f", {good['independent_points']:.0f} of them independent"
    else:
        text += ", whose residuals follow one trend"
    if good["points_past_jump"]:
        text += f", {good['points_past_jump']:.0f} past the fitted jump-off"
    return text


def _about_baselines(fitted: Fit) -> str:
    """Return the sentence on the baselines."""
    texts = []
    for name, base in fitted.baselines.items():
        unit = Format().common_unit("load", [max(abs(base["force"]), base["error"])])
        value, error = unit.convert(base["force"]), unit.convert(base["error"])
        where = "before the contact" if name == LOADING else "after the contact"
        texts.append(f"{_rounded(value, error)} ± {significant(error, 2, zeros=True)} {unit.text} {where}")
    return f"baseline: {', '.join(texts)}"
