"""The inverse problem: values of one input or two, the unknowns, at which quantities have their measured values.

Here stand the inputs that can be unknown, the problem, and why it may have no solution; `unknowns` solves it.
"""

from collections.abc import Iterable, Mapping, Sequence
from math import inf
from typing import Any, NamedTuple

from ..errors import BadRequest, JkrollError, NoResult
from ..physics.elementary import NUMBER
from ..quantities.formatting import DIGITS, Format, amount
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES, named, nearest, of_sphere
from ..quantities.values import is_uncertain, middle
from ..text import listed, quoted
from .failures import MAX_DIGITS, MissingInput
from .scene import Scene, check_exclusive

Values = Mapping[str, Any]  # by name; numbers, or an array with a value for each row

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
PER_DECADE = 8  # values of a scan
AS_SHOWN = 1e-3  # relative difference of a quantity at a solution, or at the digits of one, from its measured value


# --- Why there is no one solution -------------------------------------------------------------------------------------


class Unsolved(NoResult):
    """Error raised where no one value of the unknowns gives the measured values. The kinds of it say why."""

    def __init__(self, problem: "Problem", text: str = "", span: tuple[float, float] = (inf, -inf)) -> None:
        """`span`: of the measured quantity, or of the unknown."""
        super().__init__(problem, text, span)
        self.problem, self.text, self.span, self.name = problem, text, span, ",".join(problem.unknowns)

    def reason(self) -> str:
        """Return why there is no one value."""
        return self.text


class NoDependence(Unsolved):
    """Error raised where the measured quantity does not depend on the unknown."""

    phrase = "no dependence"

    def reason(self) -> str:
        """Return that it does not."""
        return f"{listed(self.problem.measured)} does not depend on it here"


class Undetermined(Unsolved):
    """Error raised where all values of the unknown on a stretch give the measured one."""

    phrase = "any value gives it"


class NoSolution(Unsolved):
    """Error raised where no values of the unknowns give the measured values."""

    phrase = "no value gives it"


class SeveralSolutions(Unsolved):
    """Error raised where several values of the unknowns give the measured values."""

    phrase = "several values give it"

    def __init__(self, problem: "Problem", values: Sequence[Mapping[str, float]]) -> None:
        """`values`: all that give the measured ones."""
        super().__init__(problem)
        self.values = tuple(values)

    def reason(self) -> str:
        """Return all values, with as many digits as typing them back takes: next to pull-off that is more."""
        digits = next((digits for digits in range(DIGITS, MAX_DIGITS) if self._may_be_typed(digits)), MAX_DIGITS)
        form, several = Format(digits=digits), len(self.problem.unknowns) > 1
        texts = [", ".join(amount(name, value, form) for name, value in values.items()) for values in self.values]
        pairs = "the pairs " if several else ""
        told = listed([f"({text})" for text in texts] if several else texts)
        return f"{pairs}{told} {'all' if len(texts) > 2 else 'both'} give {equal(self.problem.levels)}"

    def _may_be_typed(self, digits: int) -> bool:
        """Return whether values with so many digits give the measured ones."""
        levels = self.problem.levels
        for values in self.values:
            typed = {name: float(f"{value:.{digits}g}") for name, value in values.items()}
            forward = self.problem.with_values(typed).numbers(*levels)
            if not all(abs(forward.get(name, inf) - level) <= AS_SHOWN * abs(level) for name, level in levels.items()):
                return False
        return True


class Unseparated(Unsolved):
    """Error raised where two quantities do not separate two unknowns."""

    phrase = "not separated"

    def __init__(self, problem: "Problem", remark: str, condition: float = inf) -> None:
        """`remark`: what is left open; `condition`: the number that is too large, if it is one."""
        size = f"κ = {condition:.2g} is above 1e8" if condition < inf else "κ is above 1e8"
        remedy = "measure another quantity, or give one of the two"
        super().__init__(problem, f"{listed(problem.measured)} cannot give both: {remark} ({size}); {remedy}")


def inputs_named(words: Sequence[str]) -> list[str]:
    """Return the inputs that one word or two stand for; raise BadRequest if they cannot be inferred together."""
    names = [named(word) for word in words]
    for word, name in zip(words, names, strict=True):
        if name not in SIZES:
            guess = None if word in NOMENCLATURE else nearest(word, SIZES)
            meant = f"did you mean {guess}? " if guess else ""
            raise BadRequest(f"{quoted(word)} cannot be inferred; {meant}{', '.join(SIZES)} can")
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


# --- Problems ---------------------------------------------------------------------------------------------------------


class Problem(NamedTuple):
    """A scene that lacks the unknowns, and the measured values of as many of its quantities.

    Both may have uncertainties, and may be arrays. A value that a material has of an unknown is replaced.
    """

    unknowns: tuple[str, ...]
    measured: Values  # by quantity
    scene: Scene

    @property
    def levels(self) -> Values:
        """The measured values without their uncertainties."""
        return {name: middle(value) for name, value in self.measured.items()}

    @property
    def size(self) -> int | None:
        """The number of rows; None if all values are numbers."""
        arrays = [
            value for value in (*self.scene.arrays.values(), *self.levels.values()) if not isinstance(value, NUMBER)
        ]
        return max(map(len, arrays), default=None)

    @property
    def is_uncertain(self) -> bool:
        """True if a measured value, or something in the scene, has an uncertainty."""
        return any(map(is_uncertain, self.measured.values())) or self.scene.is_uncertain

    def names_of(self, unknown: str) -> tuple[str, ...]:
        """Return the names of an unknown in the scene: those of both spheres if one material was named for both."""
        first, second = self.scene.material, self.scene.material2
        is_shared = first is not None and second is not None and first.key == second.key and unknown in PROPERTIES
        twin = of_sphere(2, unknown)
        return (unknown, twin) if is_shared and twin not in self.scene.stated else (unknown,)

    def with_values(self, values: Values) -> Scene:
        """Return the scene with values of unknowns, or arrays of them."""
        return self.scene.replace(**{each: value for name, value in values.items() for each in self.names_of(name)})

    def filled(self) -> Scene:
        """Return the scene with placeholders for the unknowns, the largest values."""
        return self.with_values({name: SIZES[name][1] for name in self.unknowns})

    def replace(self, **values: Any) -> "Problem":
        """Return the problem with other values of some inputs and measured quantities."""
        measured = {name: values.pop(name, value) for name, value in self.measured.items()}
        return Problem(self.unknowns, measured, self.scene.replace(**values) if values else self.scene)

    def rows(self, rows: Any) -> "Problem":
        """Return the problem of some elements of the arrays, without uncertainties."""
        middles = {name: value.value for name, value in self.scene.uncertain.items()}
        values = {**middles, **self.scene.arrays, **self.levels}
        of_rows = {name: value[rows] if getattr(value, "shape", ()) else value for name, value in values.items()}
        return self.replace(**of_rows)

    def missing(self, names: Sequence[str]) -> Iterable[str]:
        """Return the unknowns if the scene lacks an input without which the measured quantities have no value."""
        return names if self.filled().missing([*self.measured]) else ()

    def used(self) -> list[str]:
        """Return the other inputs on which the measured quantities depend."""
        unknowns = {each for name in self.unknowns for each in self.names_of(name)}
        inputs = self.filled().inputs_used([*self.measured])
        return [name for name in inputs if name not in unknowns]

    def echo(self) -> dict[str, Any]:
        """Return these inputs as they were understood, and the measured values."""
        return {**self.filled().echo(self.used()), **self.levels}

    def check(self) -> None:
        """Raise the error of a problem that has no solution whatever the measured values are."""
        inputs_named(self.unknowns)
        for name in (*self.unknowns, *self.measured):
            if name in self.scene.stated:
                raise already_given(name)
        check_exclusive({*self.unknowns, *self.scene.stated})
        for quantity in self.measured:
            if self.unknowns == (quantity,) or {*self.unknowns}.isdisjoint(self._inputs_of(quantity)):
                is_one = len(self.unknowns) == 1
                raise NoDependence(self) if is_one else Unseparated(self, f"{quantity} depends on neither")

    def _inputs_of(self, quantity: str) -> Sequence[str]:
        """Return the inputs on which a measured quantity depends, the unknowns among them."""
        try:
            return self.filled().inputs_of(quantity)
        except MissingInput as error:
            if quantity not in error.missing:
                raise
            option = NOMENCLATURE[quantity].option or quantity
            remedy = f"give it as {option}, and ask for {self.unknowns[0]} without infer"
            raise BadRequest(f"{quantity} is an input, and no formula gives it; {remedy}") from error

    def failure(self) -> JkrollError:
        """Return the reason why a measured quantity has no value for any values of the unknowns."""
        outcomes = self.filled().evaluate([*self.measured]).values()
        return next((outcome for outcome in outcomes if isinstance(outcome, JkrollError)), NoDependence(self))
