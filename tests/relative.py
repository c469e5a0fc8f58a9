"""Equality of numbers by their relative difference alone.

Results are SI values, and many are smaller than 1e-12. Pytest also allows an absolute difference, which would hide
their errors.
"""

from typing import Any

import pytest


def approx(expected: Any, rel: float = 1e-6, abs: float = 0.0, *, nan_ok: bool = False) -> Any:
    """Return an object that equals a number, or numbers, up to a relative difference.

    `abs`: an absolute difference that is also allowed.
    """
    return pytest.approx(expected, rel=rel, abs=abs, nan_ok=nan_ok)  # noqa: TID251
