"""The inputs that can be unknown, where their values are looked for, and why measured quantities may give none.

The problem itself and its solver are in `unknowns`.
"""

from collections.abc import Iterable, Mapping, Sequence
from math import inf
from typing import Any

from ..errors import BadRequest, NoResult
from ..quantities.formatting import DIGITS, Format, amount
from ..quantities.nomenclature import NOMENCLATURE, named
from ..text import listed, quoted
from .failures import MAX_DIGITS

# The inputs that can be unknown, with the sizes among which they are looked for first. A load may have either sign.
SIZES = {
    "surface_energy": (1e-6, 1e3),
    "work_of_adhesion": (1e-6, 1e3),
    "hamaker": (1e-24, 1e-12),
    "yield_displacement": (1e-15, 1e-3),
    "adhesion_hysteresis": (1e-9, 1e3),
    "youngs_modulus": (1.0, 1e15),
    "shear_strength": (1.0, 1e15),
    "viscous_time": (1e-18, 1.0),
    "radius": (1e-12, 1e3),
    "load": (1e-15, 1e3),
}


# --- Why there is no one solution -------------------------------------------------------------------------------------


class Unsolved(NoResult):
    """Error raised where no one value of the unknowns gives the measured values. The kinds of it say why."""

    def __init__(self, problem: Any, text: str = "", span: Sequence[float] = ()) -> None:
        """`span`: of the measured quantity, or of the unknown."""
        # Its `args` stay those of its kind, by which another process makes it again.
        self.problem, self.text, self.span, self.name = problem, text, span, ",".join(problem.unknowns)

    def reason(self) -> str:
        """Return why there is no one value."""
        return self.text


class NoDependence(Unsolved):
    """Error raised where a measured quantity depends on none of the unknowns."""

    phrase = "no dependence"

    def __init__(self, problem: Any, quantity: str) -> None:
        unknowns = "it" if len(problem.unknowns) == 1 else "either"
        super().__init__(problem, f"{quantity} does not depend on {unknowns} here")


class Undetermined(Unsolved):
    """Error raised where all values of the unknown on a stretch give the measured one."""

    phrase = "any value gives it"

    def __init__(self, problem: Any, stretch: Sequence[float]) -> None:
        """`stretch`: the first and the last of these values."""
        (unknown,) = problem.unknowns
        first, last = (amount(unknown, end) for end in stretch)
        super().__init__(problem, f"every value from {first} to {last} gives {equal(problem.levels)}", stretch)


class NoSolution(Unsolved):
    """Error raised where no values of the unknowns give the measured values."""

    phrase = "no value gives it"

    def __init__(self, problem: Any, spans: Sequence[Sequence[float]]) -> None:
        """`spans`: the least and the largest value of each measured quantity."""
        none, lie = ("no value", "it lies") if len(problem.unknowns) == 1 else ("no pair of values", "they lie")
        ends = zip(problem.levels, spans, strict=True)
        between = listed(f"between {amount(name, low)} and {amount(name, high)}" for name, (low, high) in ends)
        sizes = sizes_in_words(problem.unknowns)
        super().__init__(problem, f"{none} gives {equal(problem.levels)}; {lie} {between} for {sizes}", spans[0])


class SeveralSolutions(Unsolved):
    """Error raised where several values of the unknowns give the measured values."""

    phrase = "several values give it"

    def __init__(self, problem: Any, values: Sequence[Mapping[str, float]]) -> None:
        """`values`: all that give the measured ones."""
        super().__init__(problem)
        self.values = tuple(values)

    def reason(self) -> str:
        """Return all values, with as many digits as typing them back takes: next to pull-off that is more."""
        digits = DIGITS
        while digits < MAX_DIGITS and not all(self.problem.is_met(values, digits) for values in self.values):
            digits += 1
        form, several = Format(digits=digits), len(self.problem.unknowns) > 1
        texts = [", ".join(amount(name, value, form) for name, value in values.items()) for values in self.values]
        told = f"the pairs {listed(f'({text})' for text in texts)}" if several else listed(texts)
        return f"{told} {'all' if len(texts) > 2 else 'both'} give {equal(self.problem.levels)}"


class Unseparated(Unsolved):
    """Error raised where two quantities do not separate two unknowns."""

    phrase = "not separated"

    def __init__(self, problem: Any, remark: str, condition: float = inf) -> None:
        """`remark`: what is left open; `condition`: the number that is too large, if it is one."""
        size = f"κ = {condition:.2g} is above 1e8" if condition < inf else "κ is above 1e8"
        remedy = "measure another quantity, or give one of the two"
        super().__init__(problem, f"{listed(problem.measured)} cannot give both: {remark} ({size}); {remedy}")


# --- Words ------------------------------------------------------------------------------------------------------------


def inputs_named(words: Sequence[str]) -> list[str]:
    """Return the inputs that one word or two stand for; raise BadRequest if they cannot be inferred together."""
    names = [named(word) for word in words]
    for word, name in zip(words, names, strict=True):
        if name not in SIZES:
            raise BadRequest(f"{quoted(word)} cannot be inferred; {', '.join(SIZES)} can")
    if len(names) not in (1, 2) or len({*names}) < len(names):
        raise BadRequest(f"{quoted(','.join(words))}: one input can be inferred, or two that differ")
    return names


def already_given(name: str) -> BadRequest:
    """Return the error of a name that is asked for, or was measured, and is stated besides."""
    return BadRequest(f"{name} is given and asked for; leave one of the two out")


def sizes_in_words(unknowns: Iterable[str]) -> str:
    """Return the values of inputs among which solutions are looked for."""
    spans = []
    for name in unknowns:
        least, most = (amount(name, size) for size in SIZES[name])
        sign = " of either sign" if name == "load" else ""
        spans.append(f"{NOMENCLATURE[name].symbol} = {least} to {most}{sign}")
    return listed(spans)


def equal(values: Mapping[str, float]) -> str:
    """Return what quantities are equal to, in words."""
    return listed(f"{name} = {amount(name, float(value))}" for name, value in values.items())
