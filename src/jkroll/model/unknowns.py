"""The inputs that can be unknown, and the errors of problems without a unique solution."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from ..errors import BadRequest, NoResult
from ..quantities.formatting import DIGITS, Format, amount
from ..quantities.nomenclature import NOMENCLATURE, named
from ..text import listed, quoted
from .reasons import MAX_DIGITS, Cause, register

if TYPE_CHECKING:
    from .search import Problem

# The inputs that can be unknown, with the range of sizes to search first. A load may have either sign.
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


# --- Problems without a unique solution -------------------------------------------------------------------------------


class Unsolved(NoResult):
    """Error raised unless exactly one value of the unknowns gives the measured values; subclasses state the reason."""

    cause: Cause  # for reasons in columns

    def __init_subclass__(cls) -> None:
        """Register the cause of a subclass."""
        cls.cause = register(Cause(cls.phrase, cls.phrase))

    def __init__(self, problem: "Problem", text: str, span: Sequence[float] = ()) -> None:
        """`span`: the extent of the measured quantity, or of the unknown."""
        self.problem, self.text, self.span, self.name = problem, text, span, ",".join(problem.unknowns)

    def explanation(self) -> str:
        """Return the reason in words."""
        return self.text


class NoDependence(Unsolved):
    """Error raised if a measured quantity depends on none of the unknowns."""

    phrase = "no dependence"


class Undetermined(Unsolved):
    """Error raised if all values of the unknown within a range give the measured value."""

    phrase = "any value gives it"


class NoSolution(Unsolved):
    """Error raised if no values of the unknowns give the measured values."""

    phrase = "no value gives it"

    def __init__(self, problem: "Problem", spans: Sequence[Sequence[float]]) -> None:
        """`spans`: the least and the largest value of each measured quantity."""
        none, lie = ("no value", "it lies") if len(problem.unknowns) == 1 else ("no pair of values", "they lie")
        texts = []
        for name, (low, high) in zip(problem.levels, spans, strict=True):
            texts.append(f"between {amount(name, low)} and {amount(name, high)}")
        between = listed(texts)
        sizes = sizes_in_words(problem.unknowns)
        super().__init__(problem, f"{none} gives {equations(problem.levels)}; {lie} {between} for {sizes}", spans[0])


class SeveralSolutions(Unsolved):
    """Error raised if several `values` of the unknowns give the measured values."""

    phrase = "several values give it"

    def __init__(self, problem: "Problem", values: Sequence[Mapping[str, float]]) -> None:
        super().__init__(problem, "")
        self.values = tuple(values)

    def explanation(self) -> str:
        """Return all values, with enough digits to type them again; near pull-off, many digits are needed."""
        digits = DIGITS
        while digits < MAX_DIGITS and not all(self.problem.is_met(values, digits) for values in self.values):
            digits += 1
        form = Format(digits=digits)
        texts = []
        for values in self.values:
            texts.append(", ".join(amount(name, value, form) for name, value in values.items()))
        all_of_them = "all" if len(texts) > 2 else "both"
        if len(self.problem.unknowns) == 1:
            return f"{listed(texts)} {all_of_them} give {equations(self.problem.levels)}"
        pairs = listed(f"({text})" for text in texts)
        return f"the pairs {pairs} {all_of_them} give {equations(self.problem.levels)}"


class Unseparated(Unsolved):
    """Error raised if two quantities do not separate two unknowns."""

    phrase = "not separated"


# --- Words ------------------------------------------------------------------------------------------------------------


def inputs_named(words: Sequence[str]) -> list[str]:
    """Return the inputs for one or two words; raise BadRequest if they cannot be inferred together."""
    names = [named(word) for word in words]
    for word, name in zip(words, names, strict=True):
        if name not in SIZES:
            problem = f"{quoted(word)} cannot be inferred; {', '.join(SIZES)} can"
            if name in NOMENCLATURE and NOMENCLATURE[name].sphere == 2:
                problem = f"{quoted(word)}: only inputs of sphere 1, or w of the pair, can be inferred"
            raise BadRequest(problem)
    if len(names) not in (1, 2) or len({*names}) < len(names):
        raise BadRequest(f"{quoted(','.join(words))}: one input can be inferred, or two that differ")
    return names


def already_given(name: str) -> BadRequest:
    """Return the error for a name that is given, and also measured or to be inferred."""
    return BadRequest(f"{name} is given, and also measured or to be inferred; leave out one")


def sizes_in_words(unknowns: Iterable[str]) -> str:
    """Return the range of values of inputs in which solutions are sought first, in words."""
    texts = []
    for name in unknowns:
        symbol = "|P|" if name == "load" else NOMENCLATURE[name].symbol
        low, high = SIZES[name]
        texts.append(f"{symbol} = {amount(name, low)} to {amount(name, high)}")
    return listed(texts)


def equations(values: Mapping[str, float], word_of: Callable[[str], str] = str) -> str:
    """Return equations of quantities and values in words; `word_of` returns the word for a quantity."""
    return listed(f"{word_of(name)} = {amount(name, float(value))}" for name, value in values.items())
