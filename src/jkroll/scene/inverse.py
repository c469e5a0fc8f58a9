"""The inverse problem: the value of an input at which a quantity has its measured value.

The input is scanned over a stated range. Turning points and the ends of what the physics allows divide the scan into monotone
pieces, and each piece that brackets the measured value is bisected down to two neighbouring doubles. So every solution in the
range is found, and nothing is extrapolated.
"""

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from math import inf, isnan, log10, nan
from typing import NamedTuple

from ..errors import JkrollError, NoResult
from ..quantities.errors import nearest
from ..quantities.formatting import amount
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES
from ..text import quoted
from .numerics import highest_between, logarithmic_slope
from .scene import EXCLUSIVE, Scene

# The inputs that can be inferred, with the sizes among which they are looked for. A load may have either sign.
SIZES = {
    "surface_energy": (1e-6, 1e3),
    "work_of_adhesion": (1e-6, 1e3),
    "yield_displacement": (1e-15, 1e-3),
    "adhesion_hysteresis": (1e-9, 1e3),
    "youngs_modulus": (1.0, 1e15),
    "radius": (1e-12, 1e3),
    "load": (1e-15, 1e3),
}
_PER_DECADE = 8  # points of the scan
_HALVINGS = 200  # more than lead from any interval to neighbouring doubles
_JUMP = 1e-6  # part of the values around it that a change of sign may leave, if it is a solution and no jump

Excess = Callable[[float], float]
Point = tuple[float, float]  # a value of the input, and by how much the quantity there exceeds the measured value


class CannotInfer(JkrollError):
    """Error raised for a word that does not stand for an input that can be inferred."""

    def __init__(self, word: str) -> None:
        super().__init__(word)
        self.word = word

    def __str__(self) -> str:
        guess = None if self.word in NOMENCLATURE else nearest(self.word, SIZES)
        meant = f"did you mean {guess}? " if guess else ""
        return f"{quoted(self.word)} cannot be inferred; {meant}{', '.join(SIZES)} can"


class AlreadyGiven(JkrollError):
    """Error raised where the input to be inferred, or the measured quantity, is given as an input, too."""

    def __init__(self, name: str, stated: str) -> None:
        super().__init__(name, stated)
        self.name, self.stated = name, stated

    def __str__(self) -> str:
        if self.name == self.stated:
            return f"{self.name} is given and asked for; leave one of the two out"
        return f"{self.name} is asked for, and {self.stated} is given: one follows from the other"


class NoDependence(NoResult):
    """Error raised where the measured quantity does not depend on the input."""

    def __init__(self, name: str, quantity: str) -> None:
        super().__init__(name, quantity)
        self.name, self.quantity = name, quantity

    def reason(self) -> str:
        """Return what does not depend on what."""
        return f"{self.quantity} does not depend on it here"


class NoSolution(NoResult):
    """Error raised where no value of the input gives the measured value."""

    def __init__(self, name: str, quantity: str, measured: float, span: tuple[float, float]) -> None:
        super().__init__(name, quantity, measured, span)
        self.name, self.quantity, self.measured, self.span = name, quantity, measured, span

    def reason(self) -> str:
        """Return the values that the quantity can have."""
        low, high = (amount(self.quantity, value) for value in self.span)
        least, most = (amount(self.name, size) for size in SIZES[self.name])
        sizes = f"{least} to {most}" + (" of either sign" if self.name == "load" else "")
        return (
            f"no value gives {self.quantity} = {amount(self.quantity, self.measured)}; "
            f"it lies between {low} and {high} for {sizes}"
        )


class SeveralSolutions(NoResult):
    """Error raised where several values of the input give the measured value."""

    def __init__(self, name: str, quantity: str, measured: float, values: Sequence[float]) -> None:
        super().__init__(name, quantity, measured, tuple(values))
        self.name, self.quantity, self.measured, self.values = name, quantity, measured, tuple(values)

    def reason(self) -> str:
        """Return all the values."""
        values = " and ".join(amount(self.name, value) for value in self.values)
        return f"{values} all give {self.quantity} = {amount(self.quantity, self.measured)}"


class Solution(NamedTuple):
    """The value of an input, and what proves it."""

    value: float
    condition: float  # |d ln input / d ln quantity|: the factor by which a relative error of the measured value grows
    scene: Scene  # with this value in it
    forward: float  # the measured quantity in this scene


def solution(name: str, quantity: str, measured: float, scene: Scene) -> Solution:
    """Return the one value of an input at which a quantity of a scene has its measured value.

    The scene has everything but this input; a value that a material has of it is replaced.
    Raises AlreadyGiven, CannotInfer, MissingInput, NoDependence, NoSolution or SeveralSolutions.
    """
    _check(name, quantity, scene)
    values = _solutions(name, quantity, measured, scene)
    if len(values) > 1:
        raise SeveralSolutions(name, quantity, measured, values)
    found = with_input(scene, name, values[0])
    return Solution(values[0], _condition(name, quantity, values[0], scene), found, float(found[quantity]))


def with_input(scene: Scene, name: str, value: float) -> Scene:
    """Return a scene with a value of an input, for both spheres if one material was named for both."""
    is_shared = (
        scene.material2 is not None and scene.material is not None and scene.material2.name == scene.material.name
    )
    names = (name, name + "2") if is_shared and name in PROPERTIES and name + "2" not in scene.stated else (name,)
    return scene.replace(**dict.fromkeys(names, value))


def _check(name: str, quantity: str, scene: Scene) -> None:
    """Raise the error of an input that cannot be inferred from this quantity, whatever its value is."""
    if name not in SIZES:
        raise CannotInfer(name)
    followed = {one for names in EXCLUSIVE if name in names for one in names} | {name, quantity}
    for stated in scene.stated:
        if stated in followed:
            raise AlreadyGiven(quantity if stated == quantity else name, stated)
    if name == quantity or name not in with_input(scene, name, SIZES[name][1]).inputs_of(quantity):
        raise NoDependence(name, quantity)


def _solutions(name: str, quantity: str, measured: float, scene: Scene) -> list[float]:
    """Return all values of an input at which a quantity has its measured value, in rising order; NoSolution for none."""

    def excess(value: float) -> float:
        """Return the quantity less its measured value, nan where the physics has no result."""
        try:
            return float(with_input(scene, name, value)[quantity]) - measured
        except NoResult:
            return nan

    points = [(value, excess(value)) for value in _grid(name)]
    errors = [error for _, error in points if not isnan(error)]
    if not errors:
        raise _failure(name, quantity, scene)
    if min(errors) == max(errors) == 0:
        raise NoDependence(name, quantity)
    pieces = [_with_turning_points(piece, excess) for piece in _pieces(points, excess)]
    found = [value for piece in pieces for value in _zeros(piece, excess)]
    if not found:
        every = [(error, at) for piece in pieces for at, error in piece]
        low, high = (float(with_input(scene, name, at)[quantity]) for _, at in (min(every), max(every)))
        if low == high:
            raise NoDependence(name, quantity)
        raise NoSolution(name, quantity, measured, (low, high))
    return sorted(set(found))


def _grid(name: str) -> list[float]:
    """Return the values of an input that are scanned, in rising order."""
    least, most = SIZES[name]
    count = round(log10(most / least) * _PER_DECADE)
    sizes = [least * 10 ** (step / _PER_DECADE) for step in range(count)] + [most]
    return [*(-size for size in reversed(sizes)), 0.0, *sizes] if name == "load" else sizes


def _failure(name: str, quantity: str, scene: Scene) -> JkrollError:
    """Return the reason why a quantity has no value for any value of the input."""
    outcome = with_input(scene, name, SIZES[name][1]).evaluate((quantity,))[quantity]
    return outcome if isinstance(outcome, JkrollError) else NoDependence(name, quantity)


def _pieces(points: Sequence[Point], excess: Excess) -> Iterator[list[Point]]:
    """Iterate over the stretches of a scan on which there is a result, each extended to its very ends."""
    piece: list[Point] = []
    for (left, left_error), (right, right_error) in pairwise([(nan, nan), *points, (nan, nan)]):
        if isnan(left_error) and not isnan(right_error):
            piece = [] if isnan(left) else [_end(excess, right, left)]
            piece.append((right, right_error))
        elif isnan(right_error) and piece:
            if not isnan(right):
                piece.append(_end(excess, left, right))
            yield piece
            piece = []
        elif piece:
            piece.append((right, right_error))


def _end(excess: Excess, inside: float, outside: float) -> Point:
    """Return the last point with a result on the way from a value that has one to a value that has none."""
    for _ in range(_HALVINGS):
        middle = (inside + outside) / 2
        if middle in (inside, outside):
            break
        if isnan(excess(middle)):
            outside = middle
        else:
            inside = middle
    return inside, excess(inside)


def _with_turning_points(piece: list[Point], excess: Excess) -> list[Point]:
    """Return a piece with the turning points at which the quantity may pass its measured value and come back."""
    turns = [
        _turning_point(left[0], right[0], excess, middle[1])
        for left, middle, right in zip(piece, piece[1:], piece[2:], strict=False)
        if abs(middle[1]) < min(abs(left[1]), abs(right[1])) and (left[1] > 0) == (middle[1] > 0) == (right[1] > 0)
    ]
    return sorted({*piece, *turns})


def _turning_point(left: float, right: float, excess: Excess, sign: float) -> Point:
    """Return the point between two others at which a quantity comes closest to its measured value, or passes it farthest."""
    at = highest_between(left, right, lambda value: -sign * excess(value))
    return at, excess(at)


def _zeros(piece: Sequence[Point], excess: Excess) -> Iterator[float]:
    """Iterate over the values at which a quantity has its measured value, on a piece divided at its turning points."""
    yield from (value for value, error in piece if error == 0)
    for (left, left_error), (right, right_error) in pairwise(piece):
        if left_error < 0 < right_error or right_error < 0 < left_error:
            value = _bisected(left, right, excess, rises=left_error < 0)
            if abs(excess(value)) <= _JUMP * max(abs(left_error), abs(right_error)):
                yield value


def _bisected(left: float, right: float, excess: Excess, *, rises: bool) -> float:
    """Return the double at which a quantity passes its measured value."""
    for _ in range(_HALVINGS):
        middle = (left + right) / 2
        error = excess(middle)
        if error == 0 or middle in (left, right):
            return middle
        if (error < 0) == rises:
            left = middle
        else:
            right = middle
    return middle


def _condition(name: str, quantity: str, value: float, scene: Scene) -> float:
    """Return |d ln input / d ln quantity| to six digits."""
    slope = logarithmic_slope(lambda beside: float(with_input(scene, name, beside)[quantity]), value)
    return float(f"{abs(1 / slope):.6g}") if slope else inf
