"""The best range of each result: where the number lies, and what says so.

A result has the value of the law in use. A law that holds better here, forces that were measured on the same solid, or
that nothing was measured, make a range of it: by the first rule that applies, row by row.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from functools import cache, partial
from math import inf, nan
from typing import Any, NamedTuple

from ..errors import NoResult
from ..physics.elementary import at_least, at_most, cbrt, where
from ..quantities.laws import BETWEEN
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, XI
from .alternatives import (
    POLYSTYRENE,
    SIO2,
    Alternative,
    assumes_displacement,
    at_full_hysteresis,
    at_half_spacing,
    ends_of_alternative,
    farthest,
    measured_solid,
    rolling,
    with_bars,
)
from .frame import Frame
from .limits import JUMP, LAW_MATTERS
from .ranges import takes
from .reasons import MissingInput
from .results import Results

# --- Rules ------------------------------------------------------------------------------------------------------------

NONE, DEFINITION, SCALED, XI_UNKNOWN, ADHESION_ONLY, LAW_ONLY, AT_LEAST, BETTER_LAW, LAW_IN_USE = range(9)
WORDS = ("–", "definition", "scaled", "ξ unknown", "adhesion only", "JKR only", "at least", "Maugis", "JKR")

_LAWS_THEMSELVES = ("pull_off_force_dmt", "pull_off_force_lennard_jones")
_IMPACT = ("restitution", "lost_energy", "sticking_speed", "sticking_energy")  # of which adhesion alone sets an end
_AT_MOST = ("lost_energy", "sticking_energy")
_SEPARATION = ("well_energy", "pull_off_work", "pull_off_work_at_dead_load")
_AS_PULL_OFF = ("pull_off_force", "bond_number")  # in proportion to it


class Estimate(NamedTuple):
    """The range in which a result lies, numbers or arrays, and the rule by which: the position of its word in WORDS.

    An end is nan where the range is open, or where there is none.
    """

    low: Any
    high: Any
    by: Any


Make = Callable[[Frame], Frame]
Rule = tuple[Any, Any, Any, int]  # the rows to which it applies, the ends there, and its number


def _first(rules: Iterable[Rule]) -> Estimate:
    """Return for each row what the first rule says that applies to it; the last one applies to all."""
    *others, (_, low, high, by) = rules
    found = Estimate(low, high, by)
    for applies, *rule in reversed(others):
        found = Estimate(*(where(applies, new, old) for new, old in zip(rule, found, strict=True)))
    return found


def estimates(results: Results, names: Iterable[str]) -> dict[str, Estimate]:
    """Return the estimates of those of some results that have a value in some row."""
    ranges = Ranges(results)
    return {name: ranges.estimate(name) for name in names if name in ranges.names}


class Ranges:
    """The ranges of results that laws and measurements give, each computed once."""

    def __init__(self, results: Results) -> None:
        self.results, self.frame = results, results.frame
        self.names = [name for name, column in results.columns.items() if not column.is_empty]
        self._made: dict[Make, Mapping[str, Alternative]] = {}

    def estimate(self, name: str) -> Estimate:
        """Return the estimate of a result that has a value in some row."""
        return _first(self._rules(name))

    def _rules(self, name: str) -> Iterator[Rule]:
        """Iterate over the rules that may apply to a result, each with its range; the last one applies to all rows."""
        own, is_rolling = self.hull(name, _itself), bool(rolling([name]))
        yield self.results.columns[name].reasons != 0, nan, nan, NONE
        if name in _LAWS_THEMSELVES:
            yield True, nan, nan, NONE
        if NOMENCLATURE[name].reference and not is_rolling and name not in _IMPACT:
            yield True, *own, DEFINITION
        if self.frame.stated_model is not None:
            yield True, *own, LAW_IN_USE
            return
        if is_rolling and assumes_displacement(self.frame):
            yield from self._of_rolling(name)
            return
        if name in _IMPACT:
            yield self._is_smooth, nan, own[1] if name in _AT_MOST else nan, ADHESION_ONLY
        if name not in self._columns(_between):
            yield True, *own, LAW_ONLY
            return
        if name in _SEPARATION:
            yield self._is_smooth, own[0], nan, AT_LEAST
        low, high = self.hull(name, *_BETTER)
        if name in _AS_PULL_OFF:
            high = at_least(high, self._by_lennard_jones(name))
        ours = self.results.columns[name].or_else(0.0)
        yield farthest([(low, ours), (high, ours)]) > LAW_MATTERS, low, high, BETTER_LAW
        yield True, at_most(low, own[0]), at_least(high, own[1]), LAW_IN_USE

    def _of_rolling(self, name: str) -> Iterator[Rule]:
        """Iterate over the rules of a rolling quantity with an assumed ξ: by what was measured, or between its ends."""
        if (rolled := ROLLED.get(solid_that_rolled(self.frame))) is not None:
            ends = (then(law, end) for law in (_itself, *_BETTER) for end in rolled.ends)
            yield rolled.is_near(self.frame), *self.hull(name, *ends), SCALED
        laws = _BETTER if name in self._columns(_between) else (_itself,)
        at_an_atom, further = self.hull(name, *laws), self.hull(name, *(then(law, _at_twice) for law in laws))
        low, high = self.hull(name, *(then(law, at_full_hysteresis) for law in laws))
        is_past = self.hull("hysteresis_ratio", *laws)[1] >= 1  # more is lost at 2 Å than there is
        rises = further[1] > at_an_atom[1]
        low = where(rises, where(is_past, nan, at_an_atom[0]), low)
        high = where(rises, high, where(is_past, nan, at_an_atom[1]))
        yield True, low, high, XI_UNKNOWN

    def at_full_hysteresis(self, name: str) -> tuple[Any, Any]:
        """Return the ends of a result where all of the work of adhesion is lost, by the better law."""
        return self.hull(name, *(then(law, at_full_hysteresis) for law in _BETTER))

    # --- What follows by other laws, and from what was measured ---

    def hull(self, name: str, *makers: Make) -> tuple[Any, Any]:
        """Return the least and the largest value of a result among what is made of the frame, with error bars."""
        found = (self._columns(make).get(name) for make in makers)
        ends = [end for each in found if each is not None for end in ends_of_alternative(each)]
        low: Any = inf
        high: Any = -inf
        for end in ends:
            has_value = end - end == 0
            low, high = at_most(low, where(has_value, end, inf)), at_least(high, where(has_value, end, -inf))
        return where(low < inf, low, nan), where(high > -inf, high, nan)

    def _columns(self, make: Make) -> Mapping[str, Alternative]:
        """Return the results of what is made of the frame, with their error bars, once."""
        if make not in self._made:
            self._made[make] = {}
            with suppress(MissingInput, NoResult):
                possible = make(self.frame).possible([*self.names, "hysteresis_ratio"])
                self._made[make] = with_bars(self.results.described, possible, make)
        return self._made[make]

    @property
    def _is_smooth(self) -> Any:
        """The rows in which the contact forms and opens without a jump, at both atomic spacings."""
        parameter = self.frame.numbers("tabor_parameter").get("tabor_parameter", INFINITY)
        return 2 * parameter < JUMP

    def _by_lennard_jones(self, name: str) -> Any:
        numbers = self.frame.numbers("pull_off_force", "pull_off_force_lennard_jones")
        force = numbers.get("pull_off_force_lennard_jones", nan)
        return self.frame[name] * (force / numbers["pull_off_force"])


def _itself(frame: Frame) -> Frame:
    return frame


def _between(frame: Frame) -> Frame:
    """Return the frame under the law that holds between JKR and DMT."""
    return frame if frame.law.name == BETWEEN else frame.by_law_at_spacing


def _between_at_half(frame: Frame) -> Frame:
    return at_half_spacing(_between(frame))


def _at_twice(frame: Frame) -> Frame:
    """Return the frame with twice the displacement."""
    return frame.replace(**{XI: 2 * frame[XI]})


_BETTER = (_between, _between_at_half)


@cache
def then(first: Make, second: Make) -> Make:
    """Return what makes a frame by one function and another one of it by the second: always the same."""
    return lambda frame: second(first(frame))


# --- What was measured of spheres that rolled -------------------------------------------------------------------------


class Rolled(NamedTuple):
    """What was measured on identical pairs of a radius, and the pairs to which it is scaled: as R^(2/3) or as R."""

    name: str  # of the quantity, the force or the displacement that starts rolling
    low: float
    high: float
    radius: float
    radii: tuple[float, float]
    energies: tuple[float, float] = (0.0, INFINITY)  # surface energies

    @property
    def ends(self) -> tuple[Make, Make]:
        """What makes of a frame the one with the least, and with the largest, displacement that was measured."""
        return _end_of(self, at_most, self.low), _end_of(self, at_least, self.high)

    def is_near(self, frame: Frame) -> Any:
        """Return whether what was measured is scaled to a pair, by element for arrays."""
        known = frame.numbers("work_of_adhesion", "reduced_radius")
        (least, most), (low, high) = self.radii, self.energies
        radius, energy = 2 * known.get("reduced_radius", 0.0), known.get("work_of_adhesion", 0.0) / 2
        return (least <= radius) & (radius <= most) & (low <= energy) & (energy <= high)


@cache
def _end_of(rolled: Rolled, choose: Callable[[Any, Any], Any], measured: float) -> Make:
    return partial(_rolled_at, rolled, choose, measured)


def _rolled_at(rolled: Rolled, choose: Callable[[Any, Any], Any], measured: float, frame: Frame) -> Frame:
    """Return a frame with the displacement that an end of what was measured means, under its law and without load."""
    radius = 2 * frame["reduced_radius"]
    scale = radius / rolled.radius
    displacement = measured * choose(scale, cbrt(scale) * cbrt(scale))
    if rolled.name != XI:  # a force, which acts at the centre of a sphere
        displacement = frame[XI] * (displacement * radius / frame["unloaded_moment"])
    return frame.replace(**{XI: where(takes(XI, displacement), displacement, frame[XI])})


ROLLED: Mapping[str, Rolled] = {
    # Heim et al. 1999 and Blum & Wurm 2000: 0.85 ± 0.16 and 1.21 ± 0.36 nN
    SIO2: Rolled("yield_force", 0.69e-9, 1.57e-9, 0.95e-6, (1e-7, 3e-6), (0.02, 0.025)),
    # Sümer & Sitti 2008: 42 nm, spheres of 5 µm on a plane
    POLYSTYRENE: Rolled(XI, 42e-9, 42e-9, 1e-5, (3e-6, 1e-4)),
    # Gundlach et al. 2011: 11.48 ± 2.38 nN
    "ice-warm": Rolled("yield_force", 9.10e-9, 13.86e-9, 1.45e-6, (0.5e-6, 5e-6)),
}


def solid_that_rolled(frame: Frame) -> str:
    """Return the solid on which rolling was measured, if both spheres are of it."""
    solid = frame.material
    if solid is None or frame.material2 not in (None, solid):
        return ""
    return solid.name if solid.name in ROLLED else measured_solid(solid)
