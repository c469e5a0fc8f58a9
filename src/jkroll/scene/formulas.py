"""The formulas as Python's users call them: integers, lists and arrays of any number type are taken as floats."""

from collections.abc import Callable, Mapping
from functools import wraps
from typing import Any

from ..physics import FORMULAS as PLAIN_FORMULAS
from .solver import as_floats


def _of_numbers(formula: Callable[..., Any]) -> Callable[..., Any]:
    """Return a formula that converts its arguments to floats."""

    @wraps(formula)
    def call(**arguments: Any) -> Any:
        return formula(
            **{
                name: value if isinstance(value, float) or hasattr(value, "m_as") else as_floats(name, value)
                for name, value in arguments.items()
            }
        )

    return call


FORMULAS: Mapping[str, Callable[..., Any]] = {name: _of_numbers(formula) for name, formula in PLAIN_FORMULAS.items()}
