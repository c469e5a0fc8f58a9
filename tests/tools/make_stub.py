"""Write the stubs that tell editors and mypy the public names and formulas: python tests/tools/make_stub.py."""

from inspect import unwrap
from pathlib import Path

import jkroll

SOURCE = Path(__file__).parents[2] / "src/jkroll"


def stubs() -> dict[Path, str]:
    """Return the texts of the stubs: imports of each public name, and of all names in the modules of formulas."""
    homes = {name: vars(jkroll)["_HOMES"][name] for name in vars(jkroll)["__all__"] if name != "formulas"}
    order = sorted(homes, key=lambda name: (homes[name], not name.isupper(), not name[0].isupper(), name))
    public = [f"from .{homes[name]} import {name} as {name}" for name in order]
    modules = sorted({unwrap(formula).__module__.removeprefix("jkroll.") for formula in jkroll.FORMULAS.values()})
    formulas = [f"from .{module} import *" for module in modules]
    return {
        SOURCE / "__init__.pyi": _stub(
            "The public names.", "from . import formulas as formulas", *public, "", "__version__: str"
        ),
        SOURCE / "formulas.pyi": _stub("The formulas by name.", *formulas),
    }


def _stub(title: str, *lines: str) -> str:
    return "\n".join([f'"""{title} Made by tests/tools/make_stub.py."""', "", *lines, ""])


if __name__ == "__main__":
    for path, text in stubs().items():
        path.write_text(text, encoding="utf-8")
