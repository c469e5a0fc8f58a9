"""Adhesive contact of two elastic spheres: pull-off, rolling, chains, vibrations.

>>> import jkroll
>>> f"{jkroll.solve('pull_off_force', material='quartz', radius=1e-7):.4e} N"
'1.1781e-08 N'
"""

TYPE_CHECKING = False  # as type checkers know it; the module typing costs more than all of this
if TYPE_CHECKING:
    from typing import Any

    from .errors import JkrollError
    from .materials.library import Material, Materials, known_materials
    from .output.answered import answer
    from .quantities.nomenclature import NOMENCLATURE, Quantity
    from .quantities.values import Interval, Measured
    from .rows.infer import infer
    from .scene.solver import FORMULAS, solve

__version__ = "0.3.0"
__all__ = [
    "FORMULAS",
    "NOMENCLATURE",
    "Interval",
    "JkrollError",
    "Material",
    "Materials",
    "Measured",
    "Quantity",
    "answer",
    "infer",
    "known_materials",
    "solve",
]

# The modules are imported when a name is first used, so that a command line pays only for what it needs.
_HOMES = {
    "FORMULAS": "scene.solver",
    "Interval": "quantities.values",
    "JkrollError": "errors",
    "Material": "materials.library",
    "Materials": "materials.library",
    "Measured": "quantities.values",
    "NOMENCLATURE": "quantities.nomenclature",
    "Quantity": "quantities.nomenclature",
    "answer": "output.answered",
    "infer": "rows.infer",
    "known_materials": "materials.library",
    "solve": "scene.solver",
}


def __getattr__(name: str) -> "Any":
    """Return a public name, or a formula of `FORMULAS` by its own name: `jkroll.pull_off_force`."""
    from importlib import import_module

    if name in _HOMES:
        value = getattr(import_module(f".{_HOMES[name]}", __name__), name)
    elif name.startswith("_") or (value := import_module(".scene.solver", __name__).FORMULAS.get(name)) is None:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return [*__all__, *__getattr__("FORMULAS")]
