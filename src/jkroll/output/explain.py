"""`--explain`: the derivation of a number, worded from the docstrings of the formulas."""

import re
from collections.abc import Iterable
from fractions import Fraction
from math import isfinite
from typing import Any, TextIO

from ..answers.answer import Answer
from ..answers.result import Result
from ..errors import JkrollError
from ..quantities.formatting import Format, amount, in_words
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.numerics import logarithmic_slope
from ..scene.scene import Scene
from ..scene.wiring import Step
from ..text import say, say_wrapped

_SECTIONS = ("Source", "Valid", "Accuracy")
_INDENT = 12  # of the texts, and of those beside the values of inputs and steps
_STEP_INDENT = 27
_LARGEST_DENOMINATOR = 12  # of an exponent shown as a fraction


class NoDocstrings(JkrollError):
    """Error raised where Python runs without docstrings."""

    def __str__(self) -> str:
        return "--explain is worded from docstrings, which python -OO drops"


def docstring_fields(formula: Any) -> dict[str, str]:
    """Return the parts of a formula's docstring: "summary", "formula", "Source", "Valid" and "Accuracy".

    >>> from jkroll.physics.chain import r_min
    >>> docstring_fields(r_min)["formula"]
    'R_min = R1R2/ξ, which is R1²/ξ for identical spheres'
    """
    text = (formula.__doc__ or "").split(">>>")[0]
    fields = {"summary": "", "formula": ""}
    key = "summary"
    for line in text.splitlines():
        stripped = line.strip()
        head, colon, rest = stripped.partition(":")
        if colon and head in _SECTIONS:
            key, stripped = head, rest.strip()
        elif key == "summary" and line.startswith(" " * 8):
            key = "formula"
        elif key == "formula" and not stripped:
            key = "remark"
        if stripped:
            fields[key] = f"{fields.get(key, '')} {stripped}".strip()
    return fields


def write_explanation(pairs: Iterable[tuple[Scene, Answer]], out: TextIO, form: Format) -> None:
    """Write for each result its formula, inputs, steps, value, source, validity, accuracy and power law."""
    if not docstring_fields(power_law)["summary"]:
        raise NoDocstrings
    for number, (scene, result) in enumerate((scene, result) for scene, answer in pairs for result in answer.results):
        if number:
            say("", out)
        for line in _explanation(result, scene, form):
            say_wrapped(line, out, _STEP_INDENT if line.startswith("    ") else _INDENT)


def _explanation(result: Result, scene: Scene, form: Format) -> list[str]:
    """Return the lines that explain one result."""
    quantity = NOMENCLATURE[result.name]
    source = f"Eq {result.equation}" if result.equation.isdigit() else result.equation
    title = f"{result.name} — {quantity.sentence}" + (f", {source}" if source else "")
    if result.value is None:
        return [title, f"  {result.reason}"]
    steps = scene.plan(result.name).steps
    if not steps:
        return [title, *_found(result, form)]
    fields = docstring_fields(steps[-1].formula)
    lines = [title, f"  {fields['formula']}", "  given"]
    lines += [_line(name, scene, form, _meaning(name, scene)) for name in scene.inputs_of(result.name)]
    if len(steps) > 1:
        lines.append("  steps")
    lines += [_line(step.name, scene, form, _formula_of(step)) for step in steps[:-1]]
    lines += _found(result, form)
    lines += [f"  {key.lower():9} {fields[key]}" for key in _SECTIONS]
    lines.append(f"  power law {power_law(scene, result.name)}")
    if quantity.note:
        lines.append(f"  note      {quantity.note}")
    return lines


def _found(result: Result, form: Format) -> list[str]:
    """Return the lines with the value of a result, the shares of its uncertainty, and what is known of an inferred one."""
    found = result.propagated
    shown = result.value if found is None else found.uncertainty
    assert shown is not None
    lines = [f"  result    {NOMENCLATURE[result.name].symbol} = {amount(result.name, shown, form)}"]
    if found is not None:
        shares = ", ".join(f"{NOMENCLATURE[name].symbol} {share:.0%}" for name, share in found.shares.items())
        lines.append(f"  shares    {shares}")
    if result.condition is not None:
        lines.append(
            "  inferred  by bisection, so that the formula below gives the measured value; "
            f"a relative error of that value enters times κ = {result.condition:.3g}"
        )
    if result.by_law:
        others = ", ".join(f"{amount(result.name, value, form)} ({law})" for law, value in result.by_law.items())
        lines.append(f"  by law    {others}")
    return lines


def _line(name: str, scene: Scene, form: Format, remark: str) -> str:
    """Return a line with the symbol and value of an input or a step, and a remark beside it."""
    shown = scene.uncertainty_of(name) or in_words(name, scene.values[name])
    value = f"{NOMENCLATURE[name].symbol} = {amount(name, shown, form)}"
    return f"    {value:22} {remark}"


def _formula_of(step: Step) -> str:
    """Return the formula of a step, with the indices of sphere 2 if it was evaluated for sphere 2."""
    formula = docstring_fields(step.formula)["formula"]
    is_of_sphere_2 = step.name.endswith("2") and step.name != step.formula.__name__
    return re.sub(r"(?<=[^\W\d])1(?![0-9])", "2", formula) if is_of_sphere_2 else formula


def _meaning(name: str, scene: Scene) -> str:
    """Return the meaning of an input, with the material and file it comes from, or that it was assumed."""
    sentence = NOMENCLATURE[name].sentence
    of_sphere_2 = name.endswith("2")
    for material, of_material in scene.data_used([name]):
        if of_material == name.removesuffix("2") and (material is scene.material2 or not of_sphere_2):
            return f"{sentence} ({material.name}, {material.title})"
    return sentence if name in scene.given else f"{sentence} (assumed)"


def power_law(scene: Scene, name: str) -> str:
    """Return the exponents of a quantity in each of its inputs at this scene, by central differences."""
    powers = [_power(scene, name, given) for given in scene.inputs_of(name)]
    return " ".join(filter(None, powers)) or "none"


def _power(scene: Scene, name: str, given: str) -> str:
    """Return an input to the power with which a quantity depends on it, as text; empty if it does not."""
    value, symbol = scene.values[given], NOMENCLATURE[given].symbol
    if not isinstance(value, float) or not isfinite(value) or value == 0:
        return ""
    exponent = logarithmic_slope(lambda beside: scene.replace(**{given: beside})[name], value)
    text = _fraction_or_number(exponent) if isfinite(exponent) else "?"
    if text == "0":
        return ""
    if text == "1":
        return symbol
    return f"{symbol}^({text})" if "/" in text else f"{symbol}^{text}"


def _fraction_or_number(exponent: float) -> str:
    """Return an exponent as a simple fraction where it is one, else as three digits."""
    fraction = Fraction(exponent).limit_denominator(_LARGEST_DENOMINATOR)
    return str(fraction) if abs(exponent - fraction) < 1e-6 else f"{exponent:.3g}"
