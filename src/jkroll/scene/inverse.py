"""The inverse problem: values of one input or two, the unknowns, at which quantities have their measured values.

Here stands what it is: the inputs that can be unknown, the problem, its solution, and why it may have none. `scans`
solves it for one unknown, `pairs` for two, and `unknowns` calls them.
"""

from collections.abc import Iterable, Mapping, Sequence
from itertools import product
from math import inf
from types import MappingProxyType
from typing import Any, NamedTuple

from ..errors import JkrollError, NoResult
from ..materials.library import Material
from ..quantities.errors import nearest
from ..quantities.formatting import amount
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES, named, of_sphere
from ..quantities.values import is_uncertain
from ..text import listed, quoted
from .failures import Contradiction, MissingInput
from .scene import EXCLUSIVE, Scene

Values = Mapping[str, float]  # by name

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
WIDEST = (1e-30, 1e30)  # the sizes that are scanned where no value is found among those
PER_DECADE = 8  # values of a scan
MAX_CONDITION = 1e8  # beyond which rounding leaves the differences that the condition number is made of too few digits


# --- Errors -----------------------------------------------------------------------------------------------------------


class CannotInfer(JkrollError):
    """Error raised for a word that does not stand for an input that can be inferred."""


class AlreadyGiven(JkrollError):
    """Error raised where an unknown, or the measured quantity, is given as an input, too."""


class OnlyGiven(JkrollError):
    """Error raised where what was measured is an input that no formula gives."""


def no_unknown(word: str) -> CannotInfer:
    """Return the error of a word that does not stand for an input that can be inferred."""
    guess = None if word in NOMENCLATURE else nearest(word, SIZES)
    meant = f"did you mean {guess}? " if guess else ""
    return CannotInfer(f"{quoted(word)} cannot be inferred; {meant}{', '.join(SIZES)} can")


def already_given(name: str, stated: str) -> AlreadyGiven:
    """Return the error of a name that is asked for, where it, or an input from which it follows, is stated."""
    if name == stated:
        return AlreadyGiven(f"{name} is given and asked for; leave one of the two out")
    return AlreadyGiven(f"{name} is asked for, and {stated} is given: one follows from the other")


class Unsolved(NoResult):
    """Error raised where no one value of the unknowns gives the measured values. The kinds of it say why."""

    def __init__(
        self, unknowns: Iterable[str], text: str, values: Sequence[Values] = (), span: tuple[float, float] = (inf, -inf)
    ) -> None:
        """`values`: all that give the measured ones; `span`: of the measured quantity, or of the unknown."""
        self.name = ",".join(unknowns)
        super().__init__([self.name], text, values, span)
        self.text, self.values, self.span = text, tuple(values), span

    def reason(self) -> str:
        """Return why there is no one value."""
        return self.text


class NoDependence(Unsolved):
    """Error raised where the measured quantity does not depend on the unknown."""

    phrase = "no dependence"


class Undetermined(Unsolved):
    """Error raised where the measured quantity has its value on a stretch on which it does not depend on the unknown."""

    phrase = "any value gives it"


class NoSolution(Unsolved):
    """Error raised where no values of the unknowns give the measured values."""

    phrase = "no value gives it"


class SeveralSolutions(Unsolved):
    """Error raised where several values of the unknowns give the measured values."""

    phrase = "several values give it"


class Unseparated(Unsolved):
    """Error raised where two quantities do not separate two unknowns."""

    phrase = "not separated"


def independent(unknown: str, quantity: str) -> NoDependence:
    """Return the error of a quantity that does not depend on the unknown."""
    return NoDependence([unknown], f"{quantity} does not depend on it here")


def unseparated(problem: "Problem", remark: str, condition: float = inf) -> Unseparated:
    """Return the error of two quantities with a condition number that is too large; `remark` says what is left open."""
    size = f"κ = {condition:.2g} is above 1e8" if condition < inf else "κ is above 1e8"
    remedy = "measure another quantity, or give one of the two"
    return Unseparated(problem.unknowns, f"{listed(problem.measured)} cannot give both: {remark} ({size}); {remedy}")


def unsolved(
    problem: "Problem", quantity: str, span: tuple[float, float], held: Values = MappingProxyType({})
) -> NoSolution:
    """Return the error of a measured value that no values give; `span`: of the quantity, where others are held."""
    what = "value" if len(problem.unknowns) == 1 else "pair of values"
    low, high = (amount(quantity, value) for value in span)
    lies = f"where {equal(held)}, {quantity} lies" if held else "it lies"
    given = equal({name: float(level) for name, level in problem.levels.items() if name == quantity or name in held})
    text = f"no {what} gives {given}; {lies} between {low} and {high} for {sizes_in_words(problem.unknowns)}"
    return NoSolution(problem.unknowns, text, span=span)


def sizes_in_words(unknowns: Iterable[str]) -> str:
    """Return the values of inputs among which solutions are looked for."""
    spans = []
    for name in unknowns:
        least, most = (amount(name, size) for size in SIZES[name])
        sign = " of either sign" if name == "load" else ""
        spans.append(f"{NOMENCLATURE[name].symbol} = {least} to {most}{sign}")
    return listed(spans)


def equal(values: Values) -> str:
    """Return what quantities are equal to, in words."""
    return listed(f"{name} = {amount(name, value)}" for name, value in values.items())


# --- Problems and solutions -------------------------------------------------------------------------------------------


class Problem(NamedTuple):
    """A scene that lacks the unknowns, and the measured values of as many of its quantities; all may be arrays.

    A value that a material has of an unknown is replaced.
    """

    unknowns: tuple[str, ...]
    measured: Mapping[str, Any]
    scene: Scene

    @classmethod
    def of(
        cls,
        unknowns: Sequence[str],
        quantities: Sequence[str],
        given: Mapping[str, Any],
        *spheres: Material | None,
        model: str | None,
    ) -> "Problem":
        """Return the problem, given the inputs and, among them, the measured values of quantities."""
        others = {name: value for name, value in given.items() if name not in quantities}
        return cls(tuple(unknowns), {name: given[name] for name in quantities}, Scene(others, *spheres, model=model))

    @property
    def levels(self) -> dict[str, Any]:
        """The measured values without their uncertainties."""
        return {name: value.value if is_uncertain(value) else value for name, value in self.measured.items()}

    @property
    def is_uncertain(self) -> bool:
        """True if a measured value, or something in the scene, has an uncertainty."""
        return any(map(is_uncertain, self.measured.values())) or self.scene.is_uncertain

    @property
    def of_arrays(self) -> bool:
        """True if the scene has arrays, whatever the measured values are."""
        return bool(self.scene.arrays)

    def with_values(self, values: Mapping[str, Any]) -> Scene:
        """Return the scene with values of unknowns, or arrays of them."""
        return self.scene.replace(**{each: value for name, value in values.items() for each in self.names_of(name)})

    def filled(self) -> Scene:
        """Return the scene with placeholders for the unknowns, the largest values."""
        return self.with_values({name: SIZES[name][1] for name in self.unknowns})

    def names_of(self, unknown: str) -> tuple[str, ...]:
        """Return the names of an unknown in the scene: those of both spheres if one material was named for both."""
        one, two = self.scene.material, self.scene.material2
        is_shared = one is not None and two is not None and one.key == two.key and unknown in PROPERTIES
        twin = of_sphere(2, unknown)
        return (unknown, twin) if is_shared and twin not in self.scene.stated else (unknown,)

    def replace(self, changed: Mapping[str, Any]) -> "Problem":
        """Return the problem with other values of some inputs and measured quantities, without uncertainties."""
        middles = {name: given.value for name, given in self.scene.uncertain.items()}
        others = {name: value for name, value in changed.items() if name not in self.measured}
        levels = {name: changed.get(name, level) for name, level in self.levels.items()}
        return self._replace(measured=levels, scene=self.scene.replace(**{**middles, **others}))

    def rows(self, rows: Any) -> "Problem":
        """Return the problem of some elements of the arrays."""
        levels = {name: level[rows] if getattr(level, "shape", ()) else level for name, level in self.levels.items()}
        arrays = {name: value[rows] for name, value in self.scene.arrays.items()}
        return self._replace(measured=levels, scene=self.scene.replace(**arrays) if arrays else self.scene)

    def used(self, values: Mapping[str, Any] | None = None) -> list[str]:
        """Return the other inputs on which the measured quantities depend. `values`: of the unknowns, if they are known."""
        scene = self.filled() if values is None else self.with_values(values)
        own = {each for name in self.unknowns for each in self.names_of(name)}
        return [name for name in scene.inputs_used([*self.measured], [*self.measured]) if name not in own]

    def echo(self, values: Mapping[str, Any] | None = None) -> dict[str, Any]:
        """Return these inputs as they were understood, and the measured values."""
        scene = self.filled() if values is None else self.with_values(values)
        return {**scene.echo(self.used(values)), **self.levels}

    def check(self) -> None:
        """Raise the error of a problem that has no solution whatever the measured values are."""
        for name in self.unknowns:
            if name not in SIZES:
                raise no_unknown(name)
        if len(self.unknowns) > 1 and any({*self.unknowns} <= {*names} for names in EXCLUSIVE):
            raise Contradiction(self.unknowns)
        for name, quantity in product(self.unknowns, self.measured):
            self._check_given(name, quantity)
        scene = self.filled()
        depends = {quantity: {*self.unknowns}.intersection(scene.inputs_of(quantity)) for quantity in self.measured}
        if len(self.unknowns) == 1:
            ((name,), (quantity,)) = self.unknowns, self.measured
            if name == quantity or not depends[quantity]:
                raise independent(name, quantity)
            return
        for quantity, names in depends.items():
            if not names:
                raise unseparated(self, f"{quantity} depends on neither")
        for name in self.unknowns:
            if not any(name in names for names in depends.values()):
                raise unseparated(self, f"they leave {NOMENCLATURE[name].symbol} open")

    def _check_given(self, unknown: str, quantity: str) -> None:
        """Raise AlreadyGiven if the scene has the unknown, the measured quantity, or what these follow from."""
        followed = {name for names in EXCLUSIVE if unknown in names for name in names} | {unknown, quantity}
        for stated in self.scene.stated:
            if stated in followed:
                raise already_given(quantity if stated == quantity else unknown, stated)
        try:
            self.scene.plan(quantity)
        except MissingInput as error:
            if quantity in error.missing:
                option = NOMENCLATURE[quantity].option or quantity
                remedy = f"give it as {option}, and ask for {unknown} without infer"
                raise OnlyGiven(f"{quantity} is an input, and no formula gives it; {remedy}") from error

    def failure(self) -> JkrollError:
        """Return the reason why a measured quantity has no value for any values of the unknowns."""
        for outcome in self.filled().evaluate([*self.measured]).values():
            if isinstance(outcome, JkrollError):
                return outcome
        return independent(self.unknowns[0], next(iter(self.measured)))


class Solution(NamedTuple):
    """The values of the unknowns of a problem: numbers, or arrays with nan in the rows that have none for a reason."""

    problem: Problem
    values: Mapping[str, Any]  # by unknown
    condition: Any  # of the logarithms of the measured values as functions of those of the unknowns
    growths: Mapping[str, Any]  # by unknown, the largest factor by which relative errors of measured values enter it
    failures: Mapping[int, JkrollError] = MappingProxyType({})  # by row

    @property
    def scene(self) -> Scene:
        """The scene with these values in it."""
        return self.problem.with_values(self.values)

    @property
    def forward(self) -> Values:
        """The measured quantities in this scene."""
        return self.scene.numbers(*self.problem.measured)


def input_named(word: str) -> str:
    """Return the input that a word stands for; raise CannotInfer if it cannot be inferred."""
    if (name := named(word)) not in SIZES:
        raise no_unknown(word)
    return name
