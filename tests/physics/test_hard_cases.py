"""Inputs at which double precision loses digits: hard_cases.toml, and the seams between two forms of a function."""

import inspect
import math
import tomllib
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from test_accuracy import FEWER_SCENES, OUTSIDE, parameter_values

from jkroll import FORMULAS, solve
from jkroll.physics.elementary import Sum, cbrt, product
from jkroll.physics.jkr import load_factor_at_approach, load_factor_at_approach_unstable
from reference import BOUND, FOLD, Exact, digits, mpf

Values = Mapping[str, Any]

PATH = Path(__file__).with_name("hard_cases.toml")
VIA: Mapping[str, Callable[[Exact], Exact]] = {
    "": lambda value: value,
    "square": lambda value: value**2,
    "cube root": digits.cbrt,
    "approach ratio": lambda x: 3 * digits.cbrt(x) ** 4 - 2 * digits.cbrt(x),
}


class Hard(NamedTuple):
    """A result of a case, as hard_cases.toml has it."""

    about: str
    given: Values
    name: str
    expected: Values

    def error(self, value: float) -> float:
        """How far a value is from the expected one, in units of what is allowed."""
        exact, function = mpf(self.expected["is"]), VIA[self.expected.get("via", "")]
        unit = math.ulp(self.expected.get("of", float(exact))) * self.expected.get("within", BOUND)
        return float(abs(function(mpf(value)) - exact)) / unit if math.isfinite(value) else math.inf


@cache
def hard_cases() -> tuple[Hard, ...]:
    return tuple(
        Hard(case["about"], case["given"], name, expected)
        for case in tomllib.loads(PATH.read_text(encoding="utf-8"))["case"]
        for name, expected in case["result"].items()
    )


NAMES = sorted({hard.name for hard in hard_cases()})


def evaluate(name: str, given: Values) -> Any:
    """A formula of exactly these parameters, or else what `solve` makes of them."""
    formula = FORMULAS.get(name)
    if formula and inspect.signature(formula).parameters.keys() == given.keys():
        return formula(**given)
    return solve(name, **given)


def worst(errors: Iterator[tuple[float, Hard]]) -> str:
    """The worst case that is not met, if there is one."""
    error, hard = max(errors, key=lambda each: each[0])
    return f"{hard.name} is off by {error:.3g} times what is allowed at {hard.given}" if error > 1 else ""


@pytest.mark.parametrize("name", NAMES)
def test_scalars(name: str) -> None:
    assert not worst((hard.error(evaluate(name, hard.given)), hard) for hard in hard_cases() if hard.name == name)


@pytest.mark.parametrize("name", NAMES)
def test_arrays(name: str) -> None:
    assert not worst(errors_of_arrays(name))


def errors_of_arrays(name: str) -> Iterator[tuple[float, Hard]]:
    """The errors of all cases in which the same is given, evaluated as one array."""
    alike = defaultdict(list)
    for hard in hard_cases():
        if hard.name == name:
            alike[frozenset(hard.given)].append(hard)
    for names, some in alike.items():
        with np.errstate(all="ignore"):
            values = evaluate(name, {each: np.array([hard.given[each] for hard in some]) for each in names})
        yield from (
            (hard.error(float(value)), hard)
            for hard, value in zip(some, np.broadcast_to(values, len(some)), strict=True)
        )


# --- Neighbouring doubles ---------------------------------------------------------------------------------------------


def neighbours(value: float, count: int) -> Any:
    """So many consecutive doubles around one."""
    step = np.arange(-(count // 2), count - count // 2)
    return np.sort((np.array(value).view(np.int64) + step).view(np.float64))


def state(approach_ratio: Any) -> Any:
    return load_factor_at_approach(approach_at_load=approach_ratio, approach=1.0)


def unstable_state(approach_ratio: Any) -> Any:
    return load_factor_at_approach_unstable(approach_at_load=approach_ratio, approach=1.0)


def compliance(poisson_ratio: Any) -> Any:
    return product(Sum(1.0, poisson_ratio), Sum(1.0, -poisson_ratio))


SEAMS: Mapping[str, tuple[Callable[[Any], Any], float, int]] = {  # a function, a place, 1 if it rises there
    "stable state, fold": (state, float(FOLD), 1),
    "stable state, excess 3": (state, 3 / 6 ** (1 / 3) + float(FOLD), 1),
    "stable state, equilibrium": (state, 1.0, 1),
    "unstable state, fold": (unstable_state, float(FOLD), -1),
    "unstable state, excess 1/2": (unstable_state, 0.5 / 6 ** (1 / 3) + float(FOLD), -1),
    "1 - nu^2 at 1/2": (compliance, 0.5, -1),
    "1 - nu^2 at -1/2": (compliance, -0.5, 1),
    "1 - nu^2 at 1": (compliance, 1.0, -1),
    "cbrt at 1": (cbrt, 1.0, 1),
    "cbrt at 8": (cbrt, 8.0, 1),
    "cbrt of 1e-300": (cbrt, 1e-300, 1),
}


@pytest.mark.parametrize("count", [100_000, pytest.param(1_000_000, marks=pytest.mark.slow)])
@pytest.mark.parametrize("seam", SEAMS)
def test_monotone_over_neighbouring_doubles(seam: str, count: int) -> None:
    function, place, sign = SEAMS[seam]
    values = sign * function(neighbours(place, count))
    back = np.diff(values[np.isfinite(values)])
    where = int(np.argmin(back))
    assert back[where] >= 0, (
        f"{(back < 0).sum()} steps back, the largest of {-back[where] / np.spacing(abs(values[-1]))} ulp"
    )


# --- Floats and arrays ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", FORMULAS)
def test_a_float_and_an_array_of_one_agree_to_1_ulp(name: str) -> None:
    formula = FORMULAS[name]
    for values in parameter_values(FEWER_SCENES):
        if name in OUTSIDE and OUTSIDE[name](values):
            continue
        arguments = {parameter: values[parameter] for parameter in inspect.signature(formula).parameters}
        alone = formula(**arguments)
        [together] = formula(**{parameter: np.array([value]) for parameter, value in arguments.items()})
        assert together == alone or abs(together - alone) <= math.ulp(alone), arguments
