"""The formulas of the quantities, by name: functions of SI numbers, arrays, and Quantities of pint and astropy.

>>> from jkroll.formulas import pull_off_force
>>> f"{pull_off_force(work_of_adhesion=0.05, reduced_radius=50e-9):.4e} N"
'1.1781e-08 N'
"""

from collections.abc import Callable
from importlib import import_module
from typing import Any


def __getattr__(name: str) -> Callable[..., Any]:
    """Return a formula by its name. The first formula that is used imports the modules of physics."""
    formula = None if name.startswith("_") else import_module(".model.solver", __package__).FORMULAS.get(name)
    if formula is None:
        raise AttributeError(f"jkroll.formulas has no {name}; dir(jkroll.formulas) lists the formulas")
    globals()[name] = formula
    return formula  # type: ignore[no-any-return]


def __dir__() -> list[str]:
    return sorted(import_module(".model.solver", __package__).FORMULAS)
