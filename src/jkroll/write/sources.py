"""The derivation of a number for `--explain`, from the docstrings of its formulas, and its sources for `--cite`.

`--cite` writes BibTeX entries; with `--tex`, it writes a paragraph that cites them, for a paper's Methods section.
"""

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from math import log
from typing import Any, TextIO

from .. import __version__
from ..errors import BadRequest
from ..materials.library import data_of
from ..model.accepted import takes
from ..model.estimate import NONE, WORDS
from ..model.frame import Frame
from ..model.other_law import has_other_formulas
from ..model.plan import Plan
from ..physics.accuracy import accuracy_of
from ..quantities.formatting import Format, amount, symbol_of
from ..quantities.laws import BETWEEN
from ..quantities.markup import as_latex, symbol
from ..quantities.nomenclature import CONVERTED, INFINITY, NOMENCLATURE
from ..report.answer import Result
from ..report.best_ranges import made_of, range_in_words
from ..report.report import Report, every_line
from ..text import listed, say, say_wrapped

_SECTIONS = ("Source", "Valid")
_NO_POWER = 1e-4  # a smaller exponent is a rounding error
_LESS = 1 - 1e-5  # factor on an input, to find its power; the inverse is taken if the smaller input is invalid
_INDENT = 12  # indent of the text of a fact
_STEP_INDENT = 27  # indent of the remark next to the value of an input or a step


def docstring_fields(formula: Any) -> dict[str, str]:
    """Return the parts of a formula's docstring: "summary", "formula", "Source" and "Valid".

    >>> from jkroll.physics.rolling import r_min
    >>> docstring_fields(r_min)["formula"]
    'R_min = R1R2/ξ, which is R1²/ξ for identical spheres'
    """
    from inspect import cleandoc

    text = cleandoc(formula.__doc__ or "").partition(">>>")[0].rstrip()
    paragraphs = text.split("\n\n")
    start = 0
    while not paragraphs[start].startswith(" "):
        start += 1
    fields = {"summary": " ".join(paragraphs[:start]), "formula": paragraphs[start]}
    fields |= re.findall(rf"^({'|'.join(_SECTIONS)}):(.*(?:\n +.*)*)", text, re.MULTILINE)
    return {field: " ".join(words.split()) for field, words in fields.items()}


def write_explanation(answers: Iterable[Report], out: TextIO, form: Format) -> None:
    """Write for each result its formula, inputs, steps, value, source, validity and accuracy; then all notes."""
    if not write_explanation.__doc__:
        raise BadRequest("--explain is worded from docstrings, which python -OO drops")
    for number, answer in enumerate(answers):
        if number:
            say("", out)
        for result in answer.results_to_explain:
            for line in _explanation(result, answer, form):
                say_wrapped(line, out, _STEP_INDENT if line.startswith("    ") else _INDENT)
        for line in every_line(answer):
            say_wrapped(line, out)


def _explanation(result: Result, answer: Report, form: Format) -> list[str]:
    """Return the lines that explain a result: its formula, inputs, steps and facts."""
    quantity, frame = NOMENCLATURE[result.name], answer.frame
    title = f"{result.name} — {quantity.sentence}"
    if result.source:
        title += f", {result.source}"
    if result.measure is None:
        return [title, f"  {result.reason}", ""]
    lines, facts = [title], [*_facts(result, answer, form)]
    steps = [step for step in frame.plan(result.name).steps.values() if step.formula is not None]
    if steps:
        *earlier, last = steps
        fields = docstring_fields(last.formula)
        lines += [f"  {fields['formula']}", "  given"]
        for name in frame.inputs_of(result.name):
            lines += _value_lines(name, frame, form, _meaning(name, frame))
        if earlier:
            lines.append("  steps")
        for step in earlier:
            lines += _value_lines(step.name, frame, form, _formula_of(step))
        facts.append(("power law", _power_law(result.name, frame)))
        for section in _SECTIONS:
            facts.append((section.lower(), fields.get(section, "")))
        facts.append(("accuracy", f"{accuracy_of(last.formula.__name__)} above its arguments"))
        if quantity.definition and not result.law:
            reference = f" ({quantity.reference})" if quantity.reference else ""
            facts.append(("as", f"{quantity.definition}{reference}"))
        facts.append(("note", quantity.note))
    lines += [f"  {head:9} {text}" for head, text in facts if text]
    return [*lines, ""]


def _facts(result: Result, answer: Report, form: Format) -> Iterator[tuple[str, str]]:
    """Iterate over the facts about a value: its uncertainty, its errors, its values by law and its best range."""
    assert result.measure is not None
    assert result.value is not None
    yield "result", f"{NOMENCLATURE[result.name].symbol} = {amount(result.name, result.measure, form)}"
    if result.bar is not None:
        shares = [f"{NOMENCLATURE[name].symbol} {share:.0%}" for name, share in result.bar.shares.items()]
        yield "shares", ", ".join(shares)
    if result.error:
        yield "error", f"{100 * result.error:.2g} % off the exact moment of this contact"
    if result.growth is not None and answer.condition is None:
        error = f"a relative error of the measured value is multiplied by κ = {result.growth:.3g}"
        yield "inferred", f"so that the formula below gives the measured value; {error}"
    elif result.growth is not None:
        errors = f"relative errors of the measured values are multiplied by at most {result.growth:.3g}"
        yield "inferred", f"with the other input, so that both have their measured values; {errors}"
    values = [f"{amount(result.name, value, form)} ({law})" for law, value in result.by_law.items()]
    yield "by law", ", ".join(values)
    best = answer.estimates.get(result.name)
    if best is not None and best.by != NONE:
        yield "best", f"{range_in_words(result.name, best, answer.form)} ({WORDS[best.by]})"
        yield "why", answer.why(best.by)
        yield "made of", made_of(result.name, answer)


def _value_lines(name: str, frame: Frame, form: Format, remark: str) -> list[str]:
    """Return the symbol and value of an input or a step, with a remark after it, or below a long value."""
    measure = frame.uncertainties.get(name) or frame[name]
    value = f"    {NOMENCLATURE[name].symbol} = {amount(name, measure, form)}"
    if len(value) >= _STEP_INDENT:
        return [value, " " * _STEP_INDENT + remark]
    return [f"{value:{_STEP_INDENT}}{remark}"]


def _power_law(name: str, frame: Frame) -> str:
    """Return the local power law of a quantity in its inputs: "R1^0.667 γ1^0.333 E1^-0.333".

    The text is empty if the quantity loses its value or changes its sign with an input; the power is then unknown.
    """
    texts = []
    moduli = {each: frame.stated[each] for each in CONVERTED.values() if each in frame.stated}  # fixed while ν changes
    for given in frame.inputs_of(name):
        value = frame[given]
        if 0 < abs(value) < INFINITY:
            factor = _LESS if takes(given, value * _LESS) else 1 / _LESS
            moved = frame.replace(**{**moduli, given: value * factor}).numbers(name).get(name, 0.0)
            if not moved * frame[name] > 0:
                return ""
            power = log(moved / frame[name]) / log(factor)
            if abs(power) > _NO_POWER:
                texts.append(f"{symbol_of(given)}^{power:.3g}")
    return " ".join(texts)


def _formula_of(step: Plan) -> str:
    """Return the formula of a step; for a quantity of sphere 2 its symbols have the index 2."""
    formula = docstring_fields(step.formula)["formula"]
    if NOMENCLATURE[step.name].sphere == 2:
        return re.sub(r"(?<=[^\W\d])1(?![0-9])", "2", formula)
    return formula


def _meaning(name: str, frame: Frame) -> str:
    """Return the meaning of an input in words, with its material and source, or with "assumed" if it was not given."""
    sentence = NOMENCLATURE[name].sentence
    for material, _ in frame.data_used([name]):
        return f"{sentence} ({material.name}, {material.title})"
    return sentence if name in frame.given else f"{sentence} (assumed)"


# --- Citations --------------------------------------------------------------------------------------------------------


Entry = Mapping[str, str]  # a BibTeX entry: its key, its type and its fields


@cache
def references() -> Mapping[str, Entry]:
    """Return the BibTeX entries by name: this program, the paper, each law, and the authors or code of a convention."""
    entries = {**data_of(os.path.join(os.path.dirname(__file__), "references.toml"))}
    entries["program"] = {**entries["program"], "howpublished": f"Computer program, version {__version__}"}
    return entries


class Cited:
    """The equations of the paper that an answer uses, and the references of its law, conventions and data."""

    def __init__(self, answer: Report) -> None:
        self.names = [result.name for result in answer.results_to_explain if result.value is not None]
        formulas = answer.frame.formulas_to(*self.names)
        self.equations = {NOMENCLATURE[name].equation for name in formulas} - {""}
        known = references()
        self.law: list[Entry] = []
        by_maugis = answer.frame.replace(model=BETWEEN)  # without other formulas, the results hold under any law
        if any(has_other_formulas(by_maugis, name) for name in by_maugis.possible(self.names)):
            self.law.append(known[answer.frame.law.name])
        self.conventions: list[Entry] = []
        for name in self.names:
            reference = NOMENCLATURE[name].reference
            self.conventions += [entry for authors, entry in known.items() if authors in reference]
        self.data: list[Entry] = []
        for material, name in answer.frame.data_used(answer.inputs):
            self.data += material.sources_of(name)


def _with_cited(answers: Iterable[Report]) -> Iterator[tuple[Report, Cited]]:
    """Iterate over the answers with results, each with its citations."""
    for answer in answers:
        cited = Cited(answer)
        if cited.names:
            yield answer, cited


def _cited_by_all(answers: Iterable[Report]) -> tuple[set[str], list[Entry]]:
    """Return the equations that answers use, and the references of their laws, data and conventions, each once."""
    equations: set[str] = set()
    entries: dict[str, Entry] = {}
    for _, cited in _with_cited(answers):
        equations |= cited.equations
        for entry in (*cited.law, *cited.data, *cited.conventions):
            entries[entry["key"]] = entry
    return equations, [*entries.values()]


def write_citations(answers: Iterable[Report], out: TextIO) -> None:
    """Write the BibTeX entries of this program, of the paper with the equations used, of laws, data and conventions."""
    equations, others = _cited_by_all(answers)
    program, paper, *_ = references().values()
    if equations:
        paper = {**paper, "note": cited_equations(equations)}
    for entry in (program, paper, *others):
        say(bibtex(entry), out)


def citations_in_words(answers: Iterable[Report]) -> str:
    """Return the sources for a caption: this program, the paper with the equations used, laws, data, conventions."""
    equations, others = _cited_by_all(answers)
    _, paper, *_ = references().values()
    sources = [*map(_author_and_year, (paper, *others))]
    if equations:
        sources[0] = f"{cited_equations(equations)} of {sources[0]}"
    return f"By jkroll {__version__}, after {'; '.join(sources)}."


def _author_and_year(entry: Entry) -> str:
    """Return an entry as a citation in running text.

    >>> _author_and_year({"author": "Dominik, C. and Tielens, A. G. G. M.", "year": "1995"})
    'Dominik & Tielens 1995'
    """
    authors = [author.partition(",")[0].strip("{}") for author in entry.get("author", "").split(" and ")]
    names = " & ".join(authors) if len(authors) < 3 else f"{authors[0]} et al."
    return f"{names or entry.get('title', '')} {entry.get('year', '')}".strip()


def cited_equations(equations: Iterable[str]) -> str:
    """Return the numbers of equations in brackets, as a citation.

    >>> cited_equations({"10", "2"})
    'Eqs. (2), (10)'
    """
    numbers = [f"({number})" for number in sorted(equations, key=int)]
    return f"{'Eq.' if len(numbers) == 1 else 'Eqs.'} {', '.join(numbers)}"


def bibtex(entry: Entry) -> str:
    """Return an entry in BibTeX's form.

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


def write_methods(answers: Iterable[Report], out: TextIO) -> None:
    """Write a paragraph for each answer: the quantities, the equations and the values used."""
    for number, (answer, cited) in enumerate(_with_cited(answers)):
        if number:
            say_wrapped("", out)
        say_wrapped(f"{_computed(answer, cited)} {_values(answer)}", out, 0)


def _computed(answer: Report, cited: Cited) -> str:
    """Return the sentence with the program, the equations, the laws and conventions, and the quantities."""
    program, paper, *_ = references().values()
    sources = [f"Dominik \\& Tielens{cite_command([paper])}"]
    if cited.equations:
        sources[0] = f"{cited_equations(cited.equations).replace('. ', '.~', 1)} of {sources[0]}"
    if cited.law:
        sources.append(f"the {answer.frame.law.title} theory{cite_command(cited.law)}")
    if cited.conventions:
        sources.append(f"the conventions of{cite_command(cited.conventions)}")
    names = [name for name in answer.question.headline if name in cited.names] or cited.names
    quantities = as_latex("; ".join([f"{NOMENCLATURE[name].sentence} ({symbol(name)})" for name in names]))
    with_program = f"With jkroll {__version__}{cite_command([program])}"
    sentence = f"after {listed(sources)}, we computed for elastic spheres in adhesive contact: {quantities}."
    return f"{with_program}, {sentence}"


def _values(answer: Report) -> str:
    """Return the sentence with the inputs, their sources, and the word "assumed" for those that were not given."""
    omitted = {"model"}
    if "energy_ratio" in answer.inputs:
        omitted.add("energy")  # the energy follows from the ratio
    texts = []
    for name, value in answer.input_measures.items():
        if name in omitted:
            continue
        quantity = NOMENCLATURE[name]
        prefix = "" if quantity.is_word else f"{symbol(name)} = "
        meaning = quantity.sentence
        if name in answer.assumed:
            meaning += "; assumed"
        data: list[Entry] = []
        for material, of_material in answer.frame.data_used([name]):
            data += material.sources_of(of_material)
        texts.append(as_latex(f"{prefix}{amount(name, value)} ({meaning})") + cite_command(data))
    return f"Values used: {', '.join(texts)}."


def cite_command(entries: Iterable[Entry]) -> str:
    """Return the command that cites entries; an empty text if there are no entries."""
    keys = ",".join(dict.fromkeys(entry["key"] for entry in entries))
    return f"~\\cite{{{keys}}}" if keys else ""
