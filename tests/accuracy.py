"""The accuracy that a formula states, held against exact values."""

import inspect
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from jkroll.physics.accuracy import accuracy_of

Values = Mapping[str, Any]


def stated_accuracy(formula: Callable[..., Any]) -> float:
    """Return the number of ulp that is stated for a formula."""
    return float(accuracy_of(formula.__name__).partition(" ulp")[0])


def check_accuracy(
    formula: Callable[..., Any], scenes: Iterable[Values], error_of: Callable[[Values, float], float]
) -> None:
    """Check that a formula is as accurate as it states, for floats and for arrays.

    `error_of` returns the distance of a value from the exact one at these arguments, in ulp.
    """
    bound = stated_accuracy(formula)
    parameters = inspect.signature(formula).parameters
    scenes = [*scenes]
    absent = {name for values in scenes for name in parameters if name not in values}
    assert not absent, f"neither tests/scenes.py nor test_accuracy.py has values of {absent}"
    arguments = [{name: values[name] for name in parameters} for values in scenes]
    elements = formula(**{name: np.array([given[name] for given in arguments]) for name in parameters})
    for given, element in zip(arguments, elements.tolist(), strict=True):
        for value in {formula(**given), element}:  # one where they agree
            error = error_of(given, value)
            assert error <= bound, f"{error} ulp, {bound} stated in physics/accuracy.py, at {given}"
