"""Equality of numbers by their relative difference alone.

Results are SI values, of which many are smaller than 1e-12: the absolute difference that pytest would allow beside the
relative one.
"""

from typing import Any

import pytest


def approx(expected: Any, rel: float = 1e-6, abs: float = 0.0, *, nan_ok: bool = False) -> Any:
    """Return what equals an expected number, or numbers, up to a relative difference.

    `abs`: an absolute one, where it is meant.
    """
    return pytest.approx(expected, rel=rel, abs=abs, nan_ok=nan_ok)  # noqa: TID251
