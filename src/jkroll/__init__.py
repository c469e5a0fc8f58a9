"""Adhesive contact of two elastic spheres: pull-off, rolling, chains, vibrations.

>>> import jkroll
>>> f"{jkroll.solve('pull_off_force', material='quartz', radius=1e-7):.4e} N"
'1.1781e-08 N'
"""

from typing import Any

from .errors import JkrollError
from .materials import Material, Materials, known_materials
from .nomenclature import NOMENCLATURE, Quantity
from .physics import FORMULAS
from .solver import solve

__version__ = "0.1.0"
__all__ = ["FORMULAS", "NOMENCLATURE", "JkrollError", "Material", "Materials", "Quantity", "known_materials", "solve"]


def __getattr__(name: str) -> Any:
    """Every formula of `FORMULAS` by its own name: `jkroll.pull_off_force`."""
    try:
        return FORMULAS[name]
    except KeyError:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}") from None


def __dir__() -> list[str]:
    return [*__all__, *FORMULAS]
