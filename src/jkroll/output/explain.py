"""`--explain` and `--cite`: how a number comes about and what to cite for it, worded from the formulas' docstrings."""

import re
from collections.abc import Collection, Iterable, Mapping
from fractions import Fraction
from math import isfinite, log
from typing import Any, TextIO

from ..answers.answer import Answer, Result
from ..errors import JkrollError
from ..quantities.formatting import Format, amount, in_words
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.scene import Scene
from ..scene.wiring import Step
from ..text import say

PAPER = """@article{dominik-tielens-1995,
  author  = {Dominik, C. and Tielens, A. G. G. M.},
  title   = {Resistance to rolling in the adhesive contact of two elastic spheres},
  journal = {Philosophical Magazine A},
  volume  = {72},
  number  = {3},
  pages   = {783--803},
  year    = {1995},
  doi     = {10.1080/01418619508243800},
  note    = {%s}
}"""


def docstring_fields(formula: Any) -> dict[str, str]:
    """The parts of a formula's docstring: "summary", "formula", and "Source", "Valid", "Accuracy".

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
        if colon and head in ("Source", "Valid", "Accuracy"):
            key, stripped = head, rest.strip()
        elif key == "summary" and line.startswith(" " * 8):
            key = "formula"
        elif key == "formula" and not stripped:
            key = "remark"
        if stripped:
            fields[key] = f"{fields.get(key, '')} {stripped}".strip()
    return fields


def write_explanation(pairs: Iterable[tuple[Scene, Answer]], out: TextIO, form: Format) -> None:
    """For each result: formula, numbers put in, steps, result, equation, validity, accuracy and power law."""
    if not docstring_fields(power_law)["summary"]:
        raise NoDocstrings
    for number, (scene, result) in enumerate((scene, result) for scene, answer in pairs for result in answer.results):
        if number:
            say("", out)
        _explain(result, scene, out, form)


def _explain(result: Result, scene: Scene, out: TextIO, form: Format) -> None:
    quantity = NOMENCLATURE[result.name]
    say(f"{result.name} — {quantity.sentence}, Eq {quantity.equation}", out)
    if result.value is None:
        say(f"  {result.reason}", out)
        return
    steps = scene.plan(result.name).steps
    fields = docstring_fields(steps[-1].formula)
    lines = [f"  {fields['formula']}", "  given"]
    for name in scene.inputs_of(result.name):
        value = f"{NOMENCLATURE[name].symbol} = {amount(name, in_words(name, scene.values[name]), form)}"
        lines.append(f"    {value:22} {NOMENCLATURE[name].sentence}{_origin(name, scene)}")
    if len(steps) > 1:
        lines.append("  steps")
    for step in steps[:-1]:
        formula = _of_its_sphere(step, docstring_fields(step.formula)["formula"])
        value = f"{NOMENCLATURE[step.name].symbol} = {amount(step.name, in_words(step.name, scene.values[step.name]), form)}"
        lines.append(f"    {value:22} {formula}")
    lines.append(f"  result    {quantity.symbol} = {amount(result.name, result.value, form)}")
    lines += [f"  {key.lower():9} {fields[key]}" for key in ("Source", "Valid", "Accuracy")]
    lines.append(f"  power law {power_law(scene, result.name)}")
    if quantity.note:
        lines.append(f"  note      {quantity.note}")
    for line in lines:
        say(line, out)


class NoDocstrings(JkrollError):
    """Python was told to drop them."""

    def __str__(self) -> str:
        return "--explain is worded from docstrings, which python -OO drops"


def _of_its_sphere(step: Step, formula: str) -> str:
    """A formula written for sphere 1, for the sphere it was used for."""
    is_of_sphere_2 = step.name.endswith("2") and step.name != step.formula.__name__
    return re.sub(r"(?<=[^\W\d])1(?![0-9])", "2", formula) if is_of_sphere_2 else formula


def _origin(name: str, scene: Scene) -> str:
    """Where an input comes from: a material's file, unless it was stated."""
    of_sphere_2 = name.endswith("2")
    for material, of_material in scene.data_used([name]):
        if of_material == name.removesuffix("2") and (material is scene.material2 or not of_sphere_2):
            return f" ({material.name}, {material.title})"
    return "" if name in scene.given else " (assumed)"


def power_law(scene: Scene, name: str, step: float = 1e-4) -> str:
    """The exponents with which a quantity depends on each of its inputs here, by central differences.

    An exponent that is a simple fraction is shown as one.
    """
    exponents = []
    for given in scene.inputs_of(name):
        value = scene.values[given]
        if not isinstance(value, float) or not isfinite(value) or value == 0:
            continue
        exponent = _log_derivative(scene, name, given, value, step)
        if exponent:
            symbol = NOMENCLATURE[given].symbol
            exponents.append(
                symbol
                if exponent == "1"
                else f"{symbol}^{exponent}"
                if "/" not in exponent
                else f"{symbol}^({exponent})"
            )
    return " ".join(exponents) or "none"


def _log_derivative(scene: Scene, name: str, given: str, value: float, step: float) -> str:
    """Exponent d ln(name)/d ln(given) as text; empty where it is zero, "?" where it cannot be had."""
    logs = []
    for factor in (1 / (1 + step), 1.0, 1 + step):
        try:
            logs.append(
                (
                    log(factor),
                    log(abs(Scene({**scene.stated, given: value * factor}, scene.material, scene.material2)[name])),
                )
            )
        except (JkrollError, ValueError):
            continue
    if len(logs) < 2:
        return "?"
    exponent = (logs[-1][1] - logs[0][1]) / (logs[-1][0] - logs[0][0])
    simple = Fraction(exponent).limit_denominator(12)
    if abs(exponent - simple) < 1e-6:
        return str(simple) if simple else ""
    return f"{exponent:.3g}"


def write_citations(pairs: Iterable[tuple[Scene, Answer]], out: TextIO, _: Format) -> None:
    """BibTeX of the paper, with the equations used, and of the material data used."""
    equations: dict[str, None] = {}
    references: dict[str, Mapping[str, str]] = {}
    failure: JkrollError | None = None
    for scene, answer in pairs:
        failure = failure or answer.failure
        known = [result.name for result in answer.results if result.value is not None]
        equations |= {equation: None for name in known for equation in _equations(scene, name)}
        references |= {str(entry["key"]): entry for entry in material_references(scene, answer.inputs)}
    if failure is not None and not equations:
        raise failure
    order = sorted(equations, key=int)
    say(PAPER % (("Eq. " if len(order) == 1 else "Eqs. ") + ", ".join(f"({equation})" for equation in order)), out)
    for entry in references.values():
        say(bibtex(entry), out)


def _equations(scene: Scene, name: str) -> list[str]:
    return [NOMENCLATURE[step.name].equation for step in scene.plan(name).steps if NOMENCLATURE[step.name].equation]


def material_references(scene: Scene, inputs: Collection[str]) -> list[Mapping[str, str]]:
    """The references of the materials whose data are among the inputs."""
    return [entry for material, _ in scene.data_used(inputs) for entry in material.references]


def bibtex(entry: Mapping[str, str]) -> str:
    """One BibTeX entry.

    >>> print(bibtex({"key": "book", "type": "misc", "title": "A Book"}))
    @misc{book,
      title = {A Book}
    }
    """
    fields = {name: text for name, text in entry.items() if name not in ("key", "type")}
    width = max(map(len, fields), default=0)
    lines = [f"  {name:{width}} = {{{text}}}" for name, text in fields.items()]
    return f"@{entry.get('type', 'misc')}{{{entry['key']},\n" + ",\n".join(lines) + "\n}"
