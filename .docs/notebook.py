"""A page of the manual as a notebook of Jupyter.

python .docs/notebook.py src/jkroll/guide/python.md python.ipynb
"""

import json
import re
import sys
from collections.abc import Iterator
from doctest import DocTestParser
from pathlib import Path
from typing import Any, NamedTuple

_EXAMPLES = re.compile(r"^```python\n(.*?)^```\n", re.DOTALL | re.MULTILINE)
_PRINTED = re.compile(r"print\(([\w.]+)\)\n")  # of which a notebook shows more than the text


class Cell(NamedTuple):
    """A cell: code with what the page shows below it, or a text."""

    source: str
    shown: str | None = None  # None: of a text


def cells_of(page: str) -> Iterator[Cell]:
    """Iterate over the cells of a page: a cell of code ends where the page shows a value."""
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
    """Return a page as the object of a notebook, in which nothing was run yet."""
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    cells: list[dict[str, Any]] = []
    for number, cell in enumerate(cells_of(page)):
        entry: dict[str, Any] = {"id": f"cell-{number}", "metadata": {}, "source": cell.source}
        is_text = cell.shown is None
        code = {"cell_type": "code", "outputs": [], "execution_count": None}
        cells.append({**entry, **({"cell_type": "markdown"} if is_text else code)})
    return {"nbformat": 4, "nbformat_minor": 5, "metadata": {"kernelspec": kernel}, "cells": cells}


if __name__ == "__main__":
    page_path, notebook_path = map(Path, sys.argv[1:])
    text = json.dumps(notebook(page_path.read_text(encoding="utf-8")), ensure_ascii=False, indent=1)
    notebook_path.write_text(f"{text}\n", encoding="utf-8")
