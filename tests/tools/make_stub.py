"""Write the stubs that tell editors and mypy the public names and formulas: python tests/tools/make_stub.py."""

from collections.abc import Mapping
from inspect import unwrap
from pathlib import Path

import jkroll

SOURCE = Path(__file__).parents[2] / "src/jkroll"


def stubs() -> dict[Path, str]:
    """Return the texts of the stubs: the public names, and each formula from its module."""
    homes = {name: vars(jkroll)["_HOMES"][name] for name in vars(jkroll)["__all__"] if name != "formulas"}
    formulas = {name: unwrap(formula).__module__.removeprefix("jkroll.") for name, formula in jkroll.FORMULAS.items()}
    public = _stub("The public names.", homes, "from . import formulas as formulas", "__version__: str")
    return {SOURCE / "__init__.pyi": public, SOURCE / "formulas.pyi": _stub("The formulas by name.", formulas)}


def _stub(title: str, homes: Mapping[str, str], first: str = "", last: str = "") -> str:
    order = sorted(homes, key=lambda name: (homes[name], not name.isupper(), not name[0].isupper(), name))
    lines = [f'"""{title} Made by tests/tools/make_stub.py."""', "", *filter(None, [first])]
    lines += (f"from .{homes[name]} import {name} as {name}" for name in order)
    return "\n".join([*lines, *(["", last] if last else []), ""])


if __name__ == "__main__":
    for path, text in stubs().items():
        path.write_text(text, encoding="utf-8")
