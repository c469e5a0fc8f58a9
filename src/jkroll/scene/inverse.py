"""The inverse problem: the value of an input at which a quantity has its measured value.

The input is scanned over a stated range. Turning points and the ends of what the physics allows divide the scan into
monotone pieces, and each piece that brackets the measured value is bisected down to two neighbouring doubles. So every
solution in the range is found, and nothing is extrapolated.
"""

from collections.abc import Callable, Generator, Iterable, Mapping, Sequence
from itertools import pairwise
from math import inf, isnan, log, log10, nan
from typing import Any, NamedTuple, TypeVar

from ..errors import JkrollError, NoResult
from ..materials.library import Material
from ..quantities.errors import nearest
from ..quantities.formatting import DIGITS, Format, amount
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES, named, of_sphere
from ..quantities.values import is_uncertain
from ..text import listed, quoted
from .failures import MAX_DIGITS
from .scene import EXCLUSIVE, Scene

Values = Mapping[str, float]  # by name


class Observed(NamedTuple):
    """A scene that lacks inputs, and the measured values of as many of its quantities; all may be arrays."""

    scene: Scene
    measured: Mapping[str, Any]

    @classmethod
    def of(
        cls, quantities: Sequence[str], given: Mapping[str, Any], *spheres: Material | None, model: str | None
    ) -> "Observed":
        """Return what was observed, given the inputs and, among them, the measured values of quantities."""
        others = {name: value for name, value in given.items() if name not in quantities}
        return cls(Scene(others, *spheres, model=model), {name: given[name] for name in quantities})

    @property
    def values(self) -> dict[str, Any]:
        """The measured values without their uncertainties."""
        return {name: one.value if is_uncertain(one) else one for name, one in self.measured.items()}

    @property
    def is_uncertain(self) -> bool:
        """True if a measured value, or something in the scene, has an uncertainty."""
        return any(map(is_uncertain, self.measured.values())) or self.scene.is_uncertain

    def changed(self, changed: Mapping[str, Any]) -> "Observed":
        """Return the same with other values of some inputs and measured quantities, without uncertainties."""
        others = {name: value for name, value in changed.items() if name not in self.measured}
        return Observed(
            self.scene.replace(**others),
            {**self.values, **{name: changed[name] for name in self.measured if name in changed}},
        )

    def used(self, names: Sequence[str], values: Mapping[str, Any] | None = None) -> list[str]:
        """Return the inputs but for `names`, which are inferred, on which the measured quantities depend.

        `values`: of those that are inferred, where they are known.
        """
        inferred = {each for name in names for each in names_in(self.scene, name)}
        filled = self._filled(names, values)
        return [name for name in filled.inputs_used([*self.measured], [*self.measured]) if name not in inferred]

    def echo(self, names: Sequence[str], values: Mapping[str, Any] | None = None) -> dict[str, Any]:
        """Return these inputs as they were understood, and the measured values."""
        return {**self._filled(names, values).echo(self.used(names, values)), **self.values}

    def _filled(self, names: Sequence[str], values: Mapping[str, Any] | None) -> Scene:
        """Return the scene with all inputs."""
        return with_placeholders(self.scene, names) if values is None else with_inputs(self.scene, values)


# --- Functions of one variable ----------------------------------------------------------------------------------------

_GOLDEN = 0.6180339887498949  # of an interval, the part that a step of the golden-section search keeps
_SEARCHES = 45  # steps of it: they leave 4e-10 of an interval, and all digits of a value that is flat there
_HALVINGS = 200  # more than lead from any interval to neighbouring doubles
# Parts of the way from an end to the next place of a scan, between which a function may turn.
_NEAR_END = (1e-6, 1e-4, 1e-2, 0.1, 0.3)
_JUMP = 1e-6  # part of the values around it that a change of sign may leave, if it is a crossing and no jump
_DIGITS = 1e-14  # of a value: a difference as small as this comes from rounding, and is no jump
_AS_SHOWN = 1e-3  # relative difference of a quantity at a place as it is shown
STEP = 1e-6  # relative, of the differences that give a slope

Found = TypeVar("Found")
Search = Generator[float, Any, Found]  # yields a place, and is sent the value there, which is nan where there is none


class Piece(NamedTuple):
    """The places and values of a part of a scan."""

    places: list[float]
    values: list[float]


def found_by(search: Search[Found], function: Callable[[float], float]) -> Found:
    """Return what a search finds on a function."""
    try:
        place = next(search)
        while True:
            place = search.send(function(place))
    except StopIteration as end:
        return end.value  # type: ignore[no-any-return]


def found_by_all(
    searches: Mapping[int, Search[Found]], function: Callable[[list[int], list[float]], Sequence[float]]
) -> dict[int, Found | NoResult]:
    """Return what searches find, or the NoResult that ends one, by number. `function` takes numbers, and a place for each."""
    found: dict[int, Found | NoResult] = {}
    running = [*searches.items()]
    values: Sequence[float | None] = [None] * len(running)  # none is sent to a search at its beginning
    while running:
        waiting, places = [], []
        for one, value in zip(running, values, strict=True):
            number, search = one
            try:
                places.append(search.send(value))
            except StopIteration as end:
                found[number] = end.value
            except NoResult as error:
                found[number] = error
            else:
                waiting.append(one)
        running = waiting
        values = function([number for number, _ in running], places) if running else []
    return found


# --- The places at which a function has a value -----------------------------------------------------------------------


def pieces_of(places: Sequence[float], values: Sequence[float]) -> Search[list[Piece]]:
    """Return the stretches of a scan on which there are values, each extended to its very ends."""
    is_gap = [*map(isnan, values)]
    cuts = [0, *(at for at, (before, after) in enumerate(pairwise(is_gap), 1) if before != after), len(values)]
    pieces = []
    for start, stop in pairwise(cuts):
        if is_gap[start]:
            continue
        points = dict(zip(places[start:stop], values[start:stop], strict=True))
        if start > 0:
            points |= yield from _to_end(places[start], places[start - 1])
        if stop < len(values):
            points |= yield from _to_end(places[stop - 1], places[stop])
        pieces.append(Piece(*map(list, zip(*sorted(points.items()), strict=True))))
    return pieces


def _to_end(inside: float, outside: float) -> Search[dict[float, float]]:
    """Return places and values from one that has a value to the last that has, on the way to one that has none."""
    end = yield from _end(inside, outside)
    found = {}
    for part in (0.0, *_NEAR_END):
        place = end + part * (inside - end)
        found[place] = yield place
    return found


def _end(
    inside: float, outside: float, is_inside: Callable[[float], bool] = lambda value: not isnan(value)
) -> Search[float]:
    """Return the last place inside on the way to one outside; inside there is a value, or one of some kind."""
    for _ in range(_HALVINGS):
        middle = (inside + outside) / 2
        if middle in (inside, outside):
            break
        if is_inside((yield middle)):
            inside = middle
        else:
            outside = middle
    return inside


def with_turning_points(piece: Piece, level: float) -> Search[Piece]:
    """Return a piece with the turning points at which a function may pass a level and come back."""
    places, values = piece
    turns: dict[float, float] = {}
    for at, (before, value, after) in enumerate(zip(values, values[1:], values[2:], strict=False), 1):
        if before < value > after and value <= level:
            turn = yield from highest_between(places[at - 1], places[at + 1])
        elif before > value < after and value >= level:
            turn = yield from highest_between(places[at - 1], places[at + 1], sign=-1.0)
        else:
            continue
        turns[turn] = yield turn
    if not turns:
        return piece
    points = sorted((dict(zip(places, values, strict=True)) | turns).items())
    return Piece([place for place, _ in points], [value for _, value in points])


def crossings(piece: Piece, level: float) -> Search[list[float]]:
    """Return the places at which a function has a value, on a piece that is divided at its turning points."""
    places, values = piece
    found = [places[at] for at, value in enumerate(values) if value == level]
    for at, (before, after) in enumerate(pairwise(values)):
        if before < level < after or before > level > after:
            place = yield from _bisected(places[at], places[at + 1], level, rises=before < level)
            leaves = max(_JUMP * max(abs(before - level), abs(after - level)), _DIGITS * abs(level))
            if abs((yield place) - level) <= leaves:
                found.append(place)
    return found


def _bisected(left: float, right: float, level: float, *, rises: bool) -> Search[float]:
    """Return the double at which a function passes a level."""
    for _ in range(_HALVINGS):
        middle = (left + right) / 2
        value = yield middle
        if value == level or middle in (left, right):
            return middle
        if (value < level) == rises:
            left = middle
        else:
            right = middle
    return middle


# --- Other methods ----------------------------------------------------------------------------------------------------


def highest_between(left: float, right: float, *, sign: float = 1.0) -> Search[float]:
    """Return where a function with one maximum between two points is highest, by golden-section search; with sign −1, lowest."""
    low, high = right - _GOLDEN * (right - left), left + _GOLDEN * (right - left)
    at_low, at_high = sign * (yield low), sign * (yield high)
    for _ in range(_SEARCHES):
        if at_low > at_high:
            right, high, at_high = high, low, at_low
            low = right - _GOLDEN * (right - left)
            at_low = sign * (yield low)
        else:
            left, low, at_low = low, high, at_high
            high = left + _GOLDEN * (right - left)
            at_high = sign * (yield high)
    return (left + right) / 2


def logarithmic_slope(outcome: Callable[[float], float], value: float) -> float:
    """Return d ln(outcome)/d ln(value) by central differences, or one-sided ones where the outcomes end.

    It is infinite where the outcome is zero, and nan where there is no outcome on either side.
    """
    points = []
    for factor in (1 / (1 + STEP), 1.0, 1 + STEP):
        try:
            points.append((log(factor), outcome(value * factor)))
        except JkrollError:
            continue
    if len(points) < 2:
        return nan
    (first, low), (last, high) = points[0], points[-1]
    middle = outcome(value)
    return (high - low) / (last - first) / middle if middle else inf


# --- Inverse ----------------------------------------------------------------------------------------------------------

# The inputs that can be inferred, with the sizes among which they are looked for. A load may have either sign.
SIZES = {
    "surface_energy": (1e-6, 1e3),
    "work_of_adhesion": (1e-6, 1e3),
    "hamaker": (1e-24, 1e-12),
    "yield_displacement": (1e-15, 1e-3),
    "adhesion_hysteresis": (1e-9, 1e3),
    "youngs_modulus": (1.0, 1e15),
    "shear_strength": (1.0, 1e15),
    "radius": (1e-12, 1e3),
    "load": (1e-15, 1e3),
}
PER_DECADE = 8  # points of the scan
_SCANNED = 1 << 14  # values of a quantity that are computed at once in a scan
_TOGETHER = 1 << 11  # values that are inferred side by side
_BISECTION = 60  # values that a bisection computes, from one point of the scan to the next
_ROUNDING = 1e-12  # of a quantity: a spread over the scan as small as this comes from rounding, and not from the input


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
        self.name, self.quantity, self.phrase = name, quantity, "no dependence"

    def reason(self) -> str:
        """Return what does not depend on what."""
        return f"{self.quantity} does not depend on it here"


class Undetermined(NoResult):
    """Error raised where the measured quantity has its value on a stretch on which it does not depend on the input."""

    def __init__(self, name: str, measured: Values, span: tuple[float, float]) -> None:
        """`span`: values of the input between which all give the measured value."""
        super().__init__(name, dict(measured), span)
        self.name, self.measured, self.span, self.phrase = name, measured, span, "any value gives it"

    def reason(self) -> str:
        """Return the values that give the measured one."""
        low, high = (amount(self.name, value) for value in self.span)
        return f"every value from {low} to {high} gives {equal(self.measured)}"


class NoSolution(NoResult):
    """Error raised where no values of the inputs give the measured values."""

    def __init__(self, names: Sequence[str], measured: Values, quantity: str, span: tuple[float, float]) -> None:
        """`measured`: as far as the search came; `span`: of the quantity at which it ended."""
        super().__init__(tuple(names), dict(measured), quantity, span)
        self.name, self.names, self.measured = ",".join(names), tuple(names), measured
        self.quantity, self.span, self.phrase = quantity, span, "no value gives it"

    def reason(self) -> str:
        """Return the values that the quantity can have."""
        what = "value" if len(self.names) == 1 else "pair of values"
        low, high = (amount(self.quantity, value) for value in self.span)
        others = {name: value for name, value in self.measured.items() if name != self.quantity}
        lies = f"where {equal(others)}, {self.quantity} lies" if others else "it lies"
        return (
            f"no {what} gives {equal(self.measured)}; {lies} between {low} and {high} for {sizes_in_words(self.names)}"
        )


class SeveralSolutions(NoResult):
    """Error raised where several values of the inputs give the measured values."""

    def __init__(self, names: Sequence[str], measured: Values, found: Sequence[Values], digits: int = DIGITS) -> None:
        """`digits`: that the values need, if they are to be typed."""
        super().__init__(tuple(names), dict(measured), tuple(found), digits)
        self.name, self.names, self.measured, self.found = ",".join(names), tuple(names), measured, tuple(found)
        self.digits, self.phrase = digits, "several values give it"

    def reason(self) -> str:
        """Return all of them."""
        form = Format(digits=self.digits)
        texts = [", ".join(amount(*item, form) for item in one.items()) for one in self.found]
        words = listed(texts) if len(self.names) == 1 else f"the pairs {', '.join(f'({text})' for text in texts)}"
        return f"{words} all give {equal(self.measured)}"


def sizes_in_words(names: Iterable[str]) -> str:
    """Return the values of inputs among which solutions are looked for."""
    spans = []
    for name in names:
        least, most = (amount(name, size) for size in SIZES[name])
        sign = " of either sign" if name == "load" else ""
        spans.append(f"{NOMENCLATURE[name].symbol} = {least} to {most}{sign}")
    return listed(spans)


def equal(values: Values) -> str:
    """Return what quantities are equal to, in words."""
    return listed(f"{name} = {amount(name, value)}" for name, value in values.items())


class Solution(NamedTuple):
    """The values of one input or two, and what proves them."""

    values: Values
    condition: float  # of the logarithms of the measured values as functions of those of the inputs
    growths: Mapping[str, float]  # by input, the largest factor by which relative errors of measured values enter it
    scene: Scene  # with these values in it
    forward: Values  # the measured quantities in this scene


def solution(name: str, quantity: str, measured: float, scene: Scene) -> Solution:
    """Return the one value of an input at which a quantity of a scene has its measured value.

    The scene has everything but this input; a value that a material has of it is replaced.
    Raises AlreadyGiven, CannotInfer, MissingInput, NoDependence, Undetermined, NoSolution or SeveralSolutions.
    """
    check_one(name, quantity, scene)

    def outcome(value: float) -> float:
        """Return the quantity, nan where the physics has no result."""
        try:
            return float(with_inputs(scene, {name: value})[quantity])
        except NoResult:
            return nan

    places = grid(name)
    pieces = found_by(_pieces(name, quantity, places, [*map(outcome, places)]), outcome)
    if not pieces:
        raise failure(name, quantity, scene)
    value = found_by(_value(name, quantity, measured, pieces), outcome)
    found = with_inputs(scene, {name: value})
    condition = _condition(name, quantity, value, scene)
    return Solution({name: value}, condition, {name: condition}, found, {quantity: float(found[quantity])})


def solutions(name: str, quantity: str, measured: Any, scene: Scene) -> list[float | NoResult | None]:
    """Return the same values for an array of measured ones and the elements of a scene, or why there is none.

    It is None where the quantity has no value for any value of the input; `failure` says why. Raises the errors that no
    value could mend.
    """
    check_one(name, quantity, scene)
    found: list[float | NoResult | None] = []
    for start in range(0, len(measured), _TOGETHER):
        part = slice(start, start + _TOGETHER)
        found += _side_by_side(name, quantity, measured[part], _elements(scene, part))
    return found


def _side_by_side(name: str, quantity: str, measured: Any, scene: Scene) -> list[float | NoResult | None]:
    """Return the values of an input, or why there is none, by searches that ask for the quantity together."""
    import numpy

    def outcomes(rows: list[int], values: Any) -> Any:
        """Return the quantity in some rows, nan where the physics has no result. `values`: of the input, a row along the last axis."""
        found = with_inputs(_elements(scene, rows), {name: numpy.array(values)}).evaluate((quantity,))[quantity]
        shape = (*numpy.shape(values)[:-1], len(rows))
        return numpy.broadcast_to(nan if isinstance(found, NoResult) else found, shape)

    def outcome(rows: list[int], values: list[float]) -> list[float]:
        found: list[float] = outcomes(rows, values).tolist()
        return found

    places = grid(name)
    is_one = all(isinstance(value, float | int) for value in scene.given.values())  # scene for all measured values
    rows = [0] if is_one else [*range(len(measured))]
    step = _SCANNED // len(places)
    parts = [rows[start : start + step] for start in range(0, len(rows), step)]
    scans = [scan for part in parts for scan in outcomes(part, [[place] for place in places]).T.tolist()]
    pieces = found_by_all({row: _pieces(name, quantity, places, scan) for row, scan in enumerate(scans)}, outcome)
    found: list[float | NoResult | None] = [None] * len(measured)
    searches = {}
    for row, level in enumerate(measured.tolist()):
        own = pieces[0 if is_one else row]
        if isinstance(own, NoResult):
            found[row] = own
        elif own:
            searches[row] = _value(name, quantity, level, own)
    for row, value in found_by_all(searches, outcome).items():
        found[row] = value
    return found


def _elements(scene: Scene, places: Any) -> Scene:
    """Return the scene of some elements of its arrays."""
    return scene.replace(**{name: value[places] for name, value in scene.arrays.items()})


def input_named(word: str) -> str:
    """Return the input that a word stands for; raise CannotInfer if it cannot be inferred."""
    if (name := named(word)) not in SIZES:
        raise CannotInfer(word)
    return name


def with_inputs(scene: Scene, values: Mapping[str, Any]) -> Scene:
    """Return a scene with values of inputs, or arrays of them."""
    return scene.replace(**{each: value for name, value in values.items() for each in names_in(scene, name)})


def with_placeholders(scene: Scene, names: Iterable[str]) -> Scene:
    """Return a scene with placeholders, the largest values, for inputs that are not known yet."""
    return with_inputs(scene, {name: SIZES[name][1] for name in names})


def names_in(scene: Scene, name: str) -> tuple[str, ...]:
    """Return the names of an input that is inferred: those of both spheres if one material was named for both."""
    is_shared = scene.material2 is not None and scene.material is not None and scene.material2.key == scene.material.key
    name2 = of_sphere(2, name)
    return (name, name2) if is_shared and name in PROPERTIES and name2 not in scene.stated else (name,)


def check_one(name: str, quantity: str, scene: Scene) -> None:
    """Raise the error of an input that cannot be inferred from this quantity, whatever its value is."""
    if name not in SIZES:
        raise CannotInfer(name)
    check_given(name, quantity, scene)
    if name == quantity or name not in with_placeholders(scene, [name]).inputs_of(quantity):
        raise NoDependence(name, quantity)


def check_given(name: str, quantity: str, scene: Scene) -> None:
    """Raise AlreadyGiven if a scene has an input that is to be inferred, or the measured quantity, or what these follow from."""
    followed = {one for names in EXCLUSIVE if name in names for one in names} | {name, quantity}
    for stated in scene.stated:
        if stated in followed:
            raise AlreadyGiven(quantity if stated == quantity else name, stated)


def grid(name: str) -> list[float]:
    """Return the values of an input that are scanned, in rising order."""
    least, most = SIZES[name]
    count = round(log10(most / least) * PER_DECADE)
    sizes = [least * 10 ** (step / PER_DECADE) for step in range(count)] + [most]
    return [*(-size for size in reversed(sizes)), 0.0, *sizes] if name == "load" else sizes


def computed(name: str) -> int:
    """Return how often a quantity is computed to infer an input."""
    return len(grid(name)) + _BISECTION


def failure(name: str, quantity: str, scene: Scene) -> JkrollError:
    """Return the reason why a quantity has no value for any value of the input."""
    outcome = with_placeholders(scene, [name]).evaluate((quantity,))[quantity]
    return outcome if isinstance(outcome, JkrollError) else NoDependence(name, quantity)


def _pieces(name: str, quantity: str, places: Sequence[float], scan: Sequence[float]) -> Search[list[Piece]]:
    """Return the parts of a scan on which the quantity has values, unless these are all the same; NoDependence then."""
    pieces = yield from pieces_of(places, scan)
    values = [value for piece in pieces for value in piece.values]
    if values and max(values) - min(values) <= _ROUNDING * max(map(abs, values)):
        raise NoDependence(name, quantity)
    return pieces


def _value(name: str, quantity: str, measured: float, pieces: Sequence[Piece]) -> Search[float]:
    """Return the one value of an input at which a quantity has its measured value; raise Undetermined, NoSolution or SeveralSolutions."""

    def is_alike(value: float) -> bool:
        return abs(value - measured) <= _ROUNDING * abs(measured)

    for places, values in pieces:
        alike = [at for at, value in enumerate(values) if is_alike(value)]
        if len(alike) > PER_DECADE and places[alike[-1]] >= 10 * places[alike[0]] > 0:
            low = yield from _end(places[alike[0]], places[max(alike[0] - 1, 0)], is_alike)
            high = yield from _end(places[alike[-1]], places[min(alike[-1] + 1, len(places) - 1)], is_alike)
            raise Undetermined(name, {quantity: measured}, (low, high))
    found, outcomes = yield from _all_values(measured, pieces)
    if not found:
        raise NoSolution([name], {quantity: measured}, quantity, (min(outcomes), max(outcomes)))
    if len(found) > 1:
        digits = DIGITS
        for value in found:
            digits = yield from _digits(value, measured, digits)
        raise SeveralSolutions([name], {quantity: measured}, [{name: value} for value in found], digits)
    return found[0]


def _digits(place: float, level: float, least: int) -> Search[int]:
    """Return with how many digits, at least so many, a function still has its level at a place: next to pull-off it takes more."""
    for digits in range(least, MAX_DIGITS):
        value = yield float(f"{place:.{digits}g}")
        if abs(value - level) <= _AS_SHOWN * abs(level):
            return digits
    return MAX_DIGITS


def _all_values(measured: float, pieces: Sequence[Piece]) -> Search[tuple[list[float], list[float]]]:
    """Return the places at which a quantity has its measured value, in rising order, and the values that it has on all pieces."""
    found: set[float] = set()
    outcomes: list[float] = []
    for piece in pieces:
        divided = yield from with_turning_points(piece, measured)
        outcomes += divided.values
        found.update((yield from crossings(divided, measured)))
    if not found:
        for piece in pieces:
            for level in (inf, -inf):  # above and below all turning points
                outcomes += (yield from with_turning_points(piece, level)).values
    return sorted(found), outcomes


def roots(name: str, quantity: str, measured: float, scan: Sequence[float]) -> Search[tuple[list[float], list[float]]]:
    """Return all values of an input at which a quantity has its measured value, and what the quantity can be. `scan`: on the grid."""
    pieces = yield from _pieces(name, quantity, grid(name), scan)
    return (yield from _all_values(measured, pieces))


def _condition(name: str, quantity: str, value: float, scene: Scene) -> float:
    """Return |d ln input / d ln quantity| to six digits."""
    slope = logarithmic_slope(lambda beside: float(with_inputs(scene, {name: beside})[quantity]), value)
    return float(f"{abs(1 / slope):.6g}") if slope else inf
