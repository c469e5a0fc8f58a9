"""Equality of numbers by their relative difference alone.

Results are SI values, many of them smaller than 1e-12; the absolute difference that pytest allows besides the relative
one would hide their errors.
"""

from typing import Any

import pytest


def approx(expected: Any, rel: float = 1e-6, abs: float = 0.0, *, nan_ok: bool = False) -> Any:
    """Return an object that equals a number, or numbers, up to a relative difference.

    `abs`: an absolute difference to allow, too.
    """
    return pytest.approx(expected, rel=rel, abs=abs, nan_ok=nan_ok)  # noqa: TID251
