"""The site's pages for Python: a page of the manual as a Jupyter notebook, and a reference of the public names.

python .docs/python_pages.py python.ipynb reference.md
"""

import inspect
import json
import re
import sys
from collections.abc import Iterable, Iterator
from contextlib import suppress
from doctest import DocTestParser
from functools import cached_property
from importlib import import_module
from itertools import chain
from pathlib import Path
from pkgutil import walk_packages
from types import FunctionType
from typing import Any, NamedTuple

import jkroll
from jkroll.errors import JkrollError
from jkroll.model.containers import units_of
from jkroll.model.estimate import Estimate
from jkroll.model.infer import InferredValues
from jkroll.pictures.answers import Answered, Answers, Exceeded
from jkroll.pictures.drawn import Drawn
from jkroll.pictures.fitted import FittedCurve
from jkroll.report.answer import Result
from jkroll.write.sources import docstring_fields
from jkroll.write.writers import in_markdown, in_row

_EXAMPLES = re.compile(r"^```python\n(.*?)^```\n", re.DOTALL | re.MULTILINE)
_PRINTED = re.compile(r"print\(([\w.]+)\)\n")  # a notebook shows more of the printed object than its text


class Cell(NamedTuple):
    """A cell: code with the output that the page shows below it, or a text."""

    source: str
    shown: str | None = None  # None: the cell is a text


def cells_of(page: str) -> Iterator[Cell]:
    """Iterate over the cells of a page: a cell of code ends where the page shows a value or the example ends."""
    for number, part in enumerate(_EXAMPLES.split(page)):
        if number % 2 == 0:
            yield from [Cell(part.strip())] if part.strip() else []
            continue
        lines: list[str] = []
        for example in DocTestParser().get_examples(part):
            printed = _PRINTED.fullmatch(example.source)
            lines.append(printed[1] if printed else example.source.rstrip("\n"))
            if example.want:
                yield Cell("\n".join(lines), example.want)
                lines = []
        if lines:
            yield Cell("\n".join(lines), "")


def notebook(page: str) -> dict[str, Any]:
    """Return a page as the object of a notebook in which no cell was run."""
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    cells: list[dict[str, Any]] = []
    for number, cell in enumerate(cells_of(page)):
        entry: dict[str, Any] = {"id": f"cell-{number}", "metadata": {}, "source": cell.source}
        if cell.shown is None:
            entry["cell_type"] = "markdown"
        else:
            entry |= {"cell_type": "code", "outputs": [], "execution_count": None}
        cells.append(entry)
    return {"nbformat": 4, "nbformat_minor": 5, "metadata": {"kernelspec": kernel}, "cells": cells}


# --- The reference ----------------------------------------------------------------------------------------------------

RETURNED = (Answered, Result, Answers, Estimate, Exceeded, Drawn, FittedCurve, InferredValues)  # by public functions
_OTHERS = {
    "jkroll.FORMULAS": "the formulas by name.",
    "jkroll.NOMENCLATURE": "what names mean, with units and equations; see [all quantities](all-quantities.md).",
    "jkroll.formulas": "the module of the formulas.",
}
_CODE = re.compile(r"(`[^`]*`)")
_UNDERLINED = re.compile(r"(\w+)\n-+")
_ENTRY = re.compile(r"(\S.*)\n((?: .*(?:\n|$))+)")


def reference() -> str:
    """Return the page of the public names, made from their docstrings: shapes, units, errors and sources."""
    public = {f"jkroll.{name}": getattr(jkroll, name) for name in dir(jkroll)}
    functions = {name: each for name, each in public.items() if inspect.isroutine(inspect.unwrap(each))}
    classes = {name: each for name, each in public.items() if inspect.isclass(each)}
    others = {name: each for name, each in public.items() if name not in functions and name not in classes}
    groups: dict[str, Iterable[str]] = {
        "Functions": chain.from_iterable(_function(name, each) for name, each in functions.items()),
        "Classes": chain.from_iterable(_class(name, each) for name, each in classes.items()),
        "What functions return": chain.from_iterable(_class(each.__name__, each) for each in RETURNED),
        "Other names": [f"- `{name}`: {_OTHERS[name]}" for name in others],
        "Formulas": _formulas(),
        "Errors": _errors(),
    }
    lines = [
        "# Reference of Python",
        "`import jkroll` gives these names; `jkroll guide python` introduces them step by step.",
    ]
    for title, parts in groups.items():
        lines += [f"## {title}", *parts]
    return "\n\n".join(lines) + "\n"


def _function(name: str, function: Any) -> Iterator[str]:
    """Iterate over the paragraphs of a function."""
    yield f"### `{name}`"
    yield f"```python\n{name}({', '.join(_parameters(function))})\n```"
    yield from _paragraphs(inspect.getdoc(function) or "")


def _parameters(function: Any) -> Iterator[str]:
    """Iterate over the parameters of a function as they are written, without their types."""
    kind = None
    for parameter in inspect.signature(function).parameters.values():
        if kind is parameter.POSITIONAL_ONLY is not parameter.kind:
            yield "/"
        if parameter.kind is parameter.KEYWORD_ONLY is not kind and kind is not parameter.VAR_POSITIONAL:
            yield "*"
        kind = parameter.kind
        if parameter.name != "self":
            yield re.sub(r"=<.*>", "=…", str(parameter.replace(annotation=parameter.empty)))
    if kind is inspect.Parameter.POSITIONAL_ONLY and len(inspect.signature(function).parameters) > 1:
        yield "/"


def _class(name: str, kind: type) -> Iterator[str]:
    """Iterate over the paragraphs of a class, the last of them a table of its public attributes and methods."""
    yield f"### `{name}`"
    if name.startswith("jkroll.") and not issubclass(kind, Exception):
        yield f"```python\n{name}({', '.join(_parameters(kind))})\n```"
    yield from _paragraphs(inspect.getdoc(kind) or "")
    rows = []
    own = {attribute for base in kind.__mro__ if base.__module__.startswith("jkroll") for attribute in vars(base)}
    for attribute in sorted(own):
        member = inspect.getattr_static(kind, attribute)
        if attribute.startswith("_") or isinstance(member, type):
            continue
        is_method = isinstance(member, FunctionType | classmethod | staticmethod)
        parameters = f"({', '.join(_parameters(inspect.unwrap(getattr(kind, attribute))))})" if is_method else ""
        has_text = is_method or isinstance(member, property | cached_property)
        first = (inspect.getdoc(member) or "").partition("\n\n")[0] if has_text else ""
        rows.append((f"`.{attribute}{parameters}`", _prose(first)))
    if rows:
        yield "\n".join(["| | |", "|---|---|", *(f"| {head} | {text} |" for head, text in rows)])


def _paragraphs(text: str) -> Iterator[str]:
    """Iterate over the paragraphs of a docstring in Markdown: sections as bold words, and their entries as a list."""
    text, _, examples = text.partition("\n>>> ")
    for block in text.split("\n\n"):
        heading = _UNDERLINED.match(block)
        if heading:
            yield f"**{heading[1]}**"
        paragraph = block[heading.end() :].strip("\n") if heading else block
        entries = _ENTRY.findall(paragraph)
        if entries and "".join("\n".join(entry) for entry in entries).split() == paragraph.split():
            yield "\n".join(f"- `{head}`: {_prose(body)}" for head, body in entries)
        elif paragraph.startswith("    "):
            yield f"```text\n{inspect.cleandoc(paragraph)}\n```"
        elif paragraph.strip():
            yield _prose(paragraph)
    if examples:
        yield f"```python\n>>> {examples}\n```"


def _prose(text: str) -> str:
    """Return a text of a docstring as Markdown in one line, in which code stays as it is."""
    parts = _CODE.split(" ".join(text.split()))
    return "".join(part if part.startswith("`") else in_markdown(part) for part in parts)


def _formulas() -> Iterator[str]:
    """Iterate over the table of the formulas, with the units of their parameters and of their values."""
    yield _prose(
        "`jkroll.formulas` has these functions, and `jkroll.FORMULAS` has them by name. Each takes SI numbers, arrays "
        "of them or Quantities by the names of its parameters, and gives a value of their shape."
    )
    heads = ("formula", "takes", "gives", "equation", "source", "valid")
    lines = ["| " + " | ".join(heads) + " |", "|---" * len(heads) + "|"]
    for name, formula in jkroll.FORMULAS.items():
        units, fields = units_of(formula), docstring_fields(formula)
        taken = [f"{each} [{units[each]}]" for each in inspect.signature(formula).parameters]
        texts = (fields.get(field, "") for field in ("formula", "Source", "Valid"))
        lines.append(f"| `{name}` {in_row([', '.join(taken), units['return'], *texts])} |")
    yield "\n".join(lines)


def _errors() -> Iterator[str]:
    """Iterate over one text, the list of the errors, each indented below its base class."""
    for module in walk_packages(jkroll.__path__, "jkroll."):
        if not module.name.endswith("__main__"):
            with suppress(ModuleNotFoundError):  # without an extra; modules that need one declare no errors
                import_module(module.name)
    lines: list[str] = []

    def add(kind: type, depth: int) -> None:
        first = (inspect.getdoc(kind) or "").partition("\n")[0]
        lines.append(f"{'    ' * depth}- `{kind.__name__}`: {_prose(first)}")
        for each in sorted(kind.__subclasses__(), key=lambda each: each.__name__):
            if not each.__name__.startswith("_"):
                add(each, depth + 1)

    add(JkrollError, 0)
    yield "\n".join(lines)


if __name__ == "__main__":
    notebook_path, reference_path = map(Path, sys.argv[1:])
    page_text = Path(jkroll.__file__).parent.joinpath("guide", "python.md").read_text(encoding="utf-8")
    notebook_path.write_text(json.dumps(notebook(page_text), ensure_ascii=False, indent=1) + "\n", encoding="utf-8")
    reference_path.write_text(reference(), encoding="utf-8")
