"""The sources of a number: `--explain` words its derivation from the formulas' docstrings, `--cite` writes BibTeX.

With `--tex` it writes a paragraph for the Methods section of a paper, which cites these entries.
"""

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from math import inf, isfinite
from typing import Any, TextIO

from .. import __version__
from ..answers.advice import readings_of
from ..answers.answer import Answer, Result
from ..answers.notes import every_line
from ..errors import BadRequest, JkrollError
from ..materials.library import data_of
from ..physics.accuracy import accuracy_of
from ..quantities.formatting import Format, amount
from ..quantities.laws import BETWEEN, LAWS, other_law
from ..quantities.markup import as_latex, symbol
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.alternatives import uses_law
from ..scene.scene import Scene
from ..scene.wiring import Plan, steps_to
from ..text import listed, say, say_wrapped

_SECTIONS = ("Source", "Valid")
_INDENT = 12  # of the texts, and of those beside the values of inputs and steps
_STEP_INDENT = 27
_STEP = 1e-6  # relative, of the differences that give an exponent
_LARGEST_DENOMINATOR = 12  # of an exponent shown as a fraction


def docstring_fields(formula: Any) -> dict[str, str]:
    """Return the parts of a formula's docstring: "summary", "formula", "Source" and "Valid".

    >>> from jkroll.physics.rolling import r_min
    >>> docstring_fields(r_min)["formula"]
    'R_min = R1R2/ξ, which is R1²/ξ for identical spheres'
    """
    from inspect import cleandoc

    text = cleandoc(formula.__doc__ or "").partition(">>>")[0].rstrip()
    paragraphs = text.split("\n\n")
    # A formula that stands alone below the summary sets the margin itself.
    place = next((n for n, paragraph in enumerate(paragraphs) if paragraph.startswith(" ")), len(paragraphs) - 1)
    fields = {"summary": " ".join(paragraphs[:place]), "formula": paragraphs[place]}
    fields |= re.findall(rf"^({'|'.join(_SECTIONS)}):(.*(?:\n +.*)*)", text, re.MULTILINE)
    return {field: " ".join(words.split()) for field, words in fields.items()}


def write_explanation(answers: Iterable[Answer], out: TextIO, form: Format) -> None:
    """Write for each result its formula, inputs, steps, value, source, validity, accuracy and power law."""
    if not power_law.__doc__:
        raise BadRequest("--explain is worded from docstrings, which python -OO drops")
    for place, answer in enumerate(answers):
        if place:
            say("", out)
        for result in answer.results:
            for line in [*_explanation(result, answer.scene, form), *_readings(result, answer, form), ""]:
                say_wrapped(line, out, _STEP_INDENT if line.startswith("    ") else _INDENT)
        for line in every_line(answer):
            say_wrapped(line, out)


def _explanation(result: Result, scene: Scene, form: Format) -> list[str]:
    """Return the lines that explain one result."""
    quantity = NOMENCLATURE[result.name]
    title = f"{result.name} — {quantity.sentence}" + (f", {result.source}" if result.source else "")
    if result.value is None:
        return [title, f"  {result.reason}"]
    steps = [*steps_to(scene.plans(result.name)).values()]
    if not steps:
        return [title, *_found(result, form)]
    fields = docstring_fields(steps[-1].formula)
    lines = [title, f"  {fields['formula']}", "  given"]
    lines += [_line(name, scene, form, _meaning(name, scene)) for name in scene.inputs_of(result.name)]
    if len(steps) > 1:
        lines.append("  steps")
    lines += [_line(step.name, scene, form, _formula_of(step)) for step in steps[:-1]]
    lines += _found(result, form)
    lines += [f"  {key.lower():9} {fields[key]}" for key in _SECTIONS if key in fields]
    lines.append(f"  accuracy  {accuracy_of(steps[-1].formula.__name__)} above its arguments")
    lines.append(f"  power law {power_law(scene, result.name)}")
    if quantity.definition and not result.law:
        lines.append(f"  as        {quantity.definition}" + (f" ({quantity.reference})" if quantity.reference else ""))
    if quantity.note:
        lines.append(f"  note      {quantity.note}")
    return lines


def _readings(result: Result, answer: Answer, form: Format) -> list[str]:
    """Return the line with a rolling quantity under the other law, in both readings."""
    numbers = answer.laws.get(result.name, {})
    readings = [numbers.get(key) for key in readings_of(answer.scene.law.name)]
    if result.value is None or None in readings:
        return []
    at_displacement, at_hysteresis = (amount(result.name, ratio * result.value, form) for ratio in readings if ratio)
    other = LAWS[other_law(answer.scene.law.name)].title
    return [f"  by law    {at_displacement} at equal ξ, {at_hysteresis} at equal hysteresis ({other})"]


def _found(result: Result, form: Format) -> list[str]:
    """Return the lines with the value of a result, the shares of its uncertainty, and what an inferred one has."""
    bar, measure = result.propagated, result.measure
    assert measure is not None
    lines = [f"  result    {NOMENCLATURE[result.name].symbol} = {amount(result.name, measure, form)}"]
    if bar is not None:
        shares = ", ".join(f"{NOMENCLATURE[name].symbol} {share:.0%}" for name, share in bar.shares.items())
        lines.append(f"  shares    {shares}")
    if result.error:
        lines.append(f"  error     {100 * result.error:.2g} % off the exact moment of this contact")
    if result.condition is not None:
        error = f"a relative error of it enters times κ = {result.condition:.3g}"
        lines.append(f"  inferred  so that the formula below gives the measured value; {error}")
    if result.growth is not None:
        errors = f"relative errors of these enter times {result.growth:.3g} at most"
        lines.append(f"  inferred  with the other input, so that both have their measured values; {errors}")
    if result.by_law:
        others = ", ".join(f"{amount(result.name, value, form)} ({law})" for law, value in result.by_law.items())
        lines.append(f"  by law    {others}")
    return lines


def _line(name: str, scene: Scene, form: Format, remark: str) -> str:
    """Return a line with the symbol and value of an input or a step, and a remark beside it."""
    measure = scene.uncertainties.get(name) or scene.values[name]
    value = f"{NOMENCLATURE[name].symbol} = {amount(name, measure, form)}"
    return f"    {value:22} {remark}"


def _formula_of(step: Plan) -> str:
    """Return the formula of a step, with the indices of sphere 2 if it was evaluated for sphere 2."""
    formula = docstring_fields(step.formula)["formula"]
    is_of_sphere_2 = NOMENCLATURE[step.name].sphere == 2
    return re.sub(r"(?<=[^\W\d])1(?![0-9])", "2", formula) if is_of_sphere_2 else formula


def _meaning(name: str, scene: Scene) -> str:
    """Return the meaning of an input, with the material and file it comes from, or that it was assumed."""
    sentence = NOMENCLATURE[name].sentence
    for material, _ in scene.data_used([name]):
        return f"{sentence} ({material.name}, {material.title})"
    return sentence if name in scene.given else f"{sentence} (assumed)"


def power_law(scene: Scene, name: str) -> str:
    """Return the exponents of a quantity in each of its inputs at this scene, by central differences."""
    powers = [_power(scene, name, given) for given in scene.inputs_of(name)]
    return " ".join(filter(None, powers)) or "none"


def _power(scene: Scene, name: str, given: str) -> str:
    """Return an input to the power with which a quantity depends on it, as text; empty if it does not.

    It is "?" where the quantity is 0, or has no other value on either side.
    """
    value, base = scene.values[given], NOMENCLATURE[given].symbol
    if not isinstance(value, float) or not isfinite(value) or value == 0:
        return ""
    points = []
    for factor in (1 - _STEP, 1, 1 + _STEP):
        with suppress(JkrollError):  # a range ends here
            points.append((factor, scene.replace(**{given: value * factor})[name]))
    (first, low), (last, high) = points[0], points[-1]
    change = scene[name] * (last - first)
    exponent = (high - low) / change if change else inf
    text = _fraction_or_number(exponent) if isfinite(exponent) else "?"
    if text in ("0", "1"):
        return base if text == "1" else ""
    return f"{base}^({text})" if "/" in text else f"{base}^{text}"


def _fraction_or_number(exponent: float) -> str:
    """Return an exponent as a simple fraction where it is one, else as three digits."""
    from fractions import Fraction

    fraction = Fraction(exponent).limit_denominator(_LARGEST_DENOMINATOR)
    return str(fraction) if abs(exponent - fraction) < 1e-6 else f"{exponent:.3g}"


# --- Citations --------------------------------------------------------------------------------------------------------

PAPER: Mapping[str, str] = {
    "key": "dominik-tielens-1995",
    "type": "article",
    "author": "Dominik, C. and Tielens, A. G. G. M.",
    "title": "Resistance to rolling in the adhesive contact of two elastic spheres",
    "journal": "Philosophical Magazine A",
    "volume": "72",
    "number": "3",
    "pages": "783--803",
    "year": "1995",
    "doi": "10.1080/01418619508243800",
}

# This program: author and year are those of its LICENSE.
PROGRAM: Mapping[str, str] = {
    "key": "jkroll",
    "type": "misc",
    "author": "{The jkroll developers}",
    "title": "jkroll: adhesive contact of two elastic spheres",
    "howpublished": f"Computer program, version {__version__}",
    "year": "2026",
    "note": "MIT licence",
}


class Sources:
    """The foundations of an answer's results: equations of the paper, references of the law, conventions and data."""

    def __init__(self, answer: Answer) -> None:
        self.names = [result.name for result in answer.results if result.value is not None]
        formulas = answer.scene.formulas_to(*self.names)
        self.equations = {equation for name in formulas if (equation := NOMENCLATURE[name].equation)}
        between = answer.scene.replace(model=BETWEEN)
        rests_on_law = any(uses_law(between, name) for name in between.possible(self.names))
        self.law = [answer.scene.law.reference] if rests_on_law else []
        conventions = data_of(os.path.join(os.path.dirname(__file__), "references.toml")).items()
        references = [NOMENCLATURE[name].reference for name in self.names]
        self.conventions = [entry for of_name in references for words, entry in conventions if words in of_name]
        used = answer.scene.data_used(answer.inputs)
        self.data = [entry for material, name in used for entry in material.sources_of(name)]


def _with_sources(answers: Iterable[Answer]) -> Iterator[tuple[Answer, Sources]]:
    """Iterate over the answers that have results, with their sources."""
    for answer in answers:
        if (sources := Sources(answer)).names:
            yield answer, sources


def write_citations(answers: Iterable[Answer], out: TextIO) -> None:
    """Write BibTeX entries of this program, of the paper, with the equations used, and of the laws and data used."""
    equations: set[str] = set()
    references: dict[str, Mapping[str, str]] = {}
    for _, sources in _with_sources(answers):
        equations |= sources.equations
        references |= {entry["key"]: entry for entry in (*sources.law, *sources.data, *sources.conventions)}
    say(bibtex(PROGRAM), out)
    say(bibtex({**PAPER, "note": cited_equations(equations)} if equations else PAPER), out)
    for entry in references.values():
        say(bibtex(entry), out)


def cited_equations(equations: Iterable[str]) -> str:
    """Return equations of the paper by their numbers.

    >>> cited_equations({"10", "2"})
    'Eqs. (2), (10)'
    """
    numbers = sorted(equations, key=int)
    return f"{'Eq.' if len(numbers) == 1 else 'Eqs.'} {', '.join(f'({number})' for number in numbers)}"


def bibtex(entry: Mapping[str, str]) -> str:
    """Return a BibTeX entry.

    >>> print(bibtex({"key": "book", "type": "misc", "title": "A Book"}))
    @misc{book,
      title = {A Book}
    }
    """
    fields = {name: text for name, text in entry.items() if name not in ("key", "type")}
    width = max(map(len, fields), default=0)
    lines = [f"  {name:{width}} = {{{text}}}" for name, text in fields.items()]
    return f"@{entry.get('type', 'misc')}{{{entry['key']},\n" + ",\n".join(lines) + "\n}"


# --- Methods ----------------------------------------------------------------------------------------------------------


def write_methods(answers: Iterable[Answer], out: TextIO) -> None:
    """Write a paragraph for each answer: what was computed, by which equations, and from which values."""
    for place, (answer, sources) in enumerate(_with_sources(answers)):
        if place:
            say_wrapped("", out)
        say_wrapped(f"{_computed(answer, sources)} {_values(answer)}", out, 0)


def _computed(answer: Answer, sources: Sources) -> str:
    """Return the sentence with the program, the equations, the laws and conventions, and the quantities."""
    paper = f"Dominik \\& Tielens{_cite([PAPER])}"
    ways = [f"{cited_equations(sources.equations).replace('. ', '.~', 1)} of {paper}" if sources.equations else paper]
    ways += [f"the {answer.scene.law.title} theory{_cite(sources.law)}"] if sources.law else []
    ways += [f"the conventions of{_cite(sources.conventions)}"] if sources.conventions else []
    names = [name for name in answer.question.headline if name in sources.names] or sources.names
    quantities = as_latex("; ".join(f"{NOMENCLATURE[name].sentence} ({symbol(name)})" for name in names))
    program = f"jkroll {__version__}{_cite([PROGRAM])}"
    return f"With {program}, after {listed(ways)}, we computed for elastic spheres in adhesive contact: {quantities}."


def _values(answer: Answer) -> str:
    """Return the sentence with the inputs, where their data come from, and which of them were assumed."""
    omitted = {"model", "energy"} if "energy_ratio" in answer.inputs else {"model"}  # the energy follows from its ratio
    texts = []
    for name, value in answer.measures.items():
        if name in omitted:
            continue
        quantity = NOMENCLATURE[name]
        stands = "" if quantity.is_word else f"{symbol(name)} = "
        meaning = quantity.sentence + ("; assumed" if name in answer.assumed else "")
        data = [
            entry
            for material, of_material in answer.scene.data_used([name])
            for entry in material.sources_of(of_material)
        ]
        texts.append(as_latex(f"{stands}{amount(name, value)} ({meaning})") + _cite(data))
    return f"Values used: {', '.join(texts)}."


def _cite(entries: Iterable[Mapping[str, str]]) -> str:
    """Return the command that cites entries; nothing without any."""
    keys = ",".join(dict.fromkeys(entry["key"] for entry in entries))
    return f"~\\cite{{{keys}}}" if keys else ""
