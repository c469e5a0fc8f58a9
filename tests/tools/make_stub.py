"""Write src/jkroll/__init__.pyi, by which editors and mypy know the public names: python tests/tools/make_stub.py."""

from inspect import unwrap
from pathlib import Path

import jkroll

DOCSTRING = "The public names, and the formulas by name. Made by tests/tools/make_stub.py."
STUB = Path(__file__).parents[2] / "src/jkroll/__init__.pyi"


def stub() -> str:
    """Return the text of the stub: the public names, and each formula from its module."""
    homes = {name: vars(jkroll)["_HOMES"][name] for name in vars(jkroll)["__all__"]}
    homes |= {name: unwrap(formula).__module__.removeprefix("jkroll.") for name, formula in jkroll.FORMULAS.items()}
    order = sorted(homes, key=lambda name: (homes[name], not name.isupper(), not name[0].isupper(), name))
    return "\n".join(
        [
            f'"""{DOCSTRING}"""',
            "",
            *(f"from .{homes[name]} import {name} as {name}" for name in order),
            "",
            "__version__: str",
            "",
        ]
    )


if __name__ == "__main__":
    STUB.write_text(stub(), encoding="utf-8")
