"""A paragraph for the Methods section of a paper, in LaTeX, which cites the entries that `--cite` writes."""

from collections.abc import Iterable, Mapping
from typing import TextIO

from .. import __version__
from ..answers.answer import Answer
from ..errors import JkrollError
from ..quantities.formatting import amount
from ..quantities.markup import as_latex, symbol
from ..quantities.nomenclature import NOMENCLATURE
from ..text import listed, say_wrapped
from .sources import PAPER, PROGRAM, Sources, cited_equations


def write_methods(answers: Iterable[Answer], out: TextIO) -> None:
    """Write a paragraph for each answer: what was computed, by which equations, and from which values.

    Raises the failure of the first answer if no answer has a result.
    """
    failure: JkrollError | None = None
    is_first = True
    for answer in answers:
        failure = failure or answer.failure
        sources = Sources(answer)
        if sources.names:
            if not is_first:
                say_wrapped("", out)
            is_first = False
            say_wrapped(f"{_computed(answer, sources)} {_values(answer)}", out, 0)
    if is_first and failure is not None:
        raise failure


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
