"""The inputs that can be unknown, and the errors of problems in which no one value of them gives the measured ones."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from ..errors import BadRequest, NoResult
from ..quantities.formatting import DIGITS, Format, amount
from ..quantities.nomenclature import NOMENCLATURE, named
from ..text import listed, quoted
from .reasons import MAX_DIGITS, Cause, register

if TYPE_CHECKING:
    from .search import Problem

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

    cause: Cause  # of the reason, whose words are those of the error

    def __init_subclass__(cls) -> None:
        """Let each kind of error have reasons in columns."""
        cls.cause = register(Cause(cls.phrase, cls.phrase))

    def __init__(self, problem: "Problem", text: str, span: Sequence[float] = ()) -> None:
        """`span`: of the measured quantity, or of the unknown."""
        self.problem, self.text, self.span, self.name = problem, text, span, ",".join(problem.unknowns)

    def explanation(self) -> str:
        """Return why there is no one value."""
        return self.text


class NoDependence(Unsolved):
    """Error raised where a measured quantity depends on none of the unknowns."""

    phrase = "no dependence"


class Undetermined(Unsolved):
    """Error raised where all values of the unknown on a stretch give the measured one."""

    phrase = "any value gives it"


class NoSolution(Unsolved):
    """Error raised where no values of the unknowns give the measured values."""

    phrase = "no value gives it"

    def __init__(self, problem: "Problem", spans: Sequence[Sequence[float]]) -> None:
        """`spans`: the least and the largest value of each measured quantity."""
        none, lie = ("no value", "it lies") if len(problem.unknowns) == 1 else ("no pair of values", "they lie")
        ends = zip(problem.levels, spans, strict=True)
        between = listed(f"between {amount(name, low)} and {amount(name, high)}" for name, (low, high) in ends)
        sizes = sizes_in_words(problem.unknowns)
        super().__init__(problem, f"{none} gives {equal(problem.levels)}; {lie} {between} for {sizes}", spans[0])


class SeveralSolutions(Unsolved):
    """Error raised where several values of the unknowns, which are its `values`, give the measured values."""

    phrase = "several values give it"

    def __init__(self, problem: "Problem", values: Sequence[Mapping[str, float]]) -> None:
        super().__init__(problem, "")
        self.values = tuple(values)

    def explanation(self) -> str:
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
    symbols = {name: "|P|" if name == "load" else NOMENCLATURE[name].symbol for name in unknowns}
    spans = {name: " to ".join(amount(name, size) for size in SIZES[name]) for name in unknowns}
    return listed(f"{symbols[name]} = {sizes}" for name, sizes in spans.items())


def equal(values: Mapping[str, float], word_of: Callable[[str], str] = str) -> str:
    """Return what quantities are equal to, in words; `word_of` returns the word of a quantity, by default its name."""
    return listed(f"{word_of(name)} = {amount(name, float(value))}" for name, value in values.items())
