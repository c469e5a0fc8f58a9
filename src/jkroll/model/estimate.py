"""The best range of each result, and the rule that gives it.

A result has the value that the law in use gives. Its best range may come from a better law, from measurements, or from
the likely values of an assumed input; if the laws agree, the range spans their values. Otherwise both ends are the
value, or those of its uncertainty. In each row, the first rule that applies gives the range.
"""

from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from functools import cache, partial
from math import inf, nan
from typing import Any, NamedTuple

from ..errors import JkrollError, NoResult
from ..physics.elementary import at_least, at_most, is_anywhere, where
from ..quantities.laws import BETWEEN, LAWS, RESULTS_BY_LENNARD_JONES
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, XI
from ..quantities.values import ends_of
from .accepted import LEAST, MOST
from .frame import Frame, Variant, itself
from .limits import CONTACT_EXCEEDS_SPHERE, ENDS, JUMP, LAW_MATTERS, SOFT
from .measured import (
    MOST_SEEN,
    VISCOUS_TIME,
    assumes_displacement,
    at_full_hysteresis,
    rolling,
    what_rolled,
    what_stuck,
)
from .other_law import at_half_spacing, farthest
from .reasons import MissingInput, reason
from .results import Results
from .uncertainty import ErrorBar, error_bars

# --- Rules ------------------------------------------------------------------------------------------------------------

(
    NONE, DEFINITION, MEASURED, SEEN, SCALED, XI_UNKNOWN, FRICTION_ASSUMED, SPACING_ASSUMED, ADHESION_ONLY, BOUNDS,
    LAW_ONLY, KELVIN, GAP, BETTER_LAW, LAW_IN_USE, ANY_LAW,
) = range(16)  # fmt: skip
_GIVEN = {law: number for number, law in enumerate(LAWS, ANY_LAW + 1)}  # the rule for each given law
WORDS = (
    "–", "definition", "measured", f"1–{MOST_SEEN} × JKR", "scaled", "ξ unknown", "τ assumed", "z0 assumed",
    "adhesion only", "JKR to DMT", "JKR only", "Kelvin", "roughness", "Maugis", "JKR", "any law",
    *(law.short for law in LAWS.values()),
)  # fmt: skip
BEST_BY = "_best_by"
BEST_KEYS = ("_best_low", "_best_high", BEST_BY)  # the suffixes of a quantity's name in the keys of its best range

_LAWS_THEMSELVES = ("pull_off_force_dmt", *RESULTS_BY_LENNARD_JONES)
_OF_WATER = ("meniscus_force", "kelvin_radius", "threshold_humidity")
_STICKING = {"sticking_speed": 1, "sticking_energy": 2}  # powers of the speed
_OF_COLLISIONS = ("restitution", "lost_energy")
# Quantities measured in a collision. A further loss changes them like a larger value of an input in _ACT_LIKE_LOSSES,
# so the inferred value of this input is an upper bound.
_SHIFTED_BY_LOSSES = frozenset({"restitution", "sticking_speed"})
_ACT_LIKE_LOSSES = ("surface_energy", "work_of_adhesion", "hamaker", "viscous_time")
_AS_PULL_OFF = ("pull_off_force", "bond_number")  # in proportion to the pull-off force
_BREAKING = ("disruption_energy", "disruption_speed")  # conventions, but they follow from `pull_off_work`
# For each result, proportional to b^p: the power p, the quantity b, and the quantity that is b by Lennard-Jones' law.
# If the contact opens without a jump, `pull_off_work` is the depth of the well, `well_energy`.
_BY_LENNARD_JONES = {
    **dict.fromkeys(_AS_PULL_OFF, (1.0, "pull_off_force", "pull_off_force_lennard_jones")),
    "well_energy": (1.0, "well_energy", "well_energy_lennard_jones"),
    "pull_off_work": (1.0, "pull_off_work", "well_energy_lennard_jones"),
    "pull_off_work_at_dead_load": (
        1.0, "pull_off_work_at_dead_load", "dead_load_work_lennard_jones"
    ),
    "disruption_energy": (1.0, "pull_off_work", "well_energy_lennard_jones"),
    "disruption_speed": (0.5, "pull_off_work", "well_energy_lennard_jones"),
}  # fmt: skip
FRICTION_FACTOR = 3.0  # the assumed shear strength may be too low or too high by this factor
_SAME = 1e-9  # relative difference of two ends that counts as rounding
_EXCEEDS_SPHERE = reason(ENDS[CONTACT_EXCEEDS_SPHERE.codes[1.0]])


class Estimate(NamedTuple):
    """The range of a result (numbers or arrays), and the rule that gives it, as an index into WORDS.

    An end is nan where the range is open, or where there is no range.
    """

    low: Any
    high: Any
    by: Any


Ends = tuple[Any, Any]  # the lower and the upper end of a range, nan where the range is open
Rule = tuple[Any, Any, Any, int]  # the rows to which it applies, the two ends there, its index in WORDS


def _first(rules: Iterable[Rule]) -> Estimate:
    """Return the range by the first rule that applies, row by row; the last rule applies to all rows."""
    *others, (_, low, high, by) = rules
    first = Estimate(low, high, by)
    for applies, low, high, by in reversed(others):
        first = Estimate(where(applies, low, first.low), where(applies, high, first.high), where(applies, by, first.by))
    return first


def estimates(results: Results, names: Iterable[str]) -> dict[str, Estimate]:
    """Return the estimates of results, by name; results that are empty in every row are left out."""
    ranges = Ranges(results)
    return {name: ranges.estimate(name) for name in names if name in ranges.names}


class Ranges:
    """The ranges of results by laws and measurements; each variant of the frame is computed once."""

    def __init__(self, results: Results) -> None:
        self.results, self.frame = results, results.frame
        self.names = [name for name, column in results.computed.items() if not column.is_empty]
        self._kept: dict[Variant, Mapping[str, tuple[Any, Any, Any]]] = {}  # what `_ends` returns

    @classmethod
    def of(cls, frame: Frame, *names: str) -> "Ranges":
        """Return the ranges of quantities of a frame."""
        return cls(Results(frame, frame.columns(names)))

    def estimate(self, name: str) -> Estimate:
        """Return the estimate of a result that has a number in some row.

        Its rule is NONE where the result has no value, where both ends of the range are open, or where the contact is
        wider than the smaller sphere.
        """
        low, high, by = _first(self._rules(name))
        has_end = (low <= inf) | (high <= inf)  # false for nan
        exceeds_sphere = self.results.meant[name].reasons == _EXCEEDS_SPHERE
        has_none: Any = where(has_end, (self.results.computed[name].reasons != 0) | exceeds_sphere, True)
        return Estimate(where(has_none, nan, low), where(has_none, nan, high), where(has_none, NONE, by))

    def _rules(self, name: str) -> Iterator[Rule]:
        """Iterate over the rules that may apply to a result, with their ranges; the last one applies to all rows."""
        own = self.hull(name, itself)  # the ends by the law in use
        is_rolling = bool(rolling([name]))
        is_convention = NOMENCLATURE[name].reference and name not in (*_STICKING, *_OF_COLLISIONS, *_BREAKING)
        if name in _LAWS_THEMSELVES:
            yield True, nan, nan, NONE
        elif name in _OF_WATER:
            yield self._of_water(name, own)
        elif is_convention and not is_rolling:
            yield True, *own, DEFINITION
        elif self._is_from_losses(name):
            yield True, nan, own[1], ADHESION_ONLY
        elif self.frame.stated_model is not None:
            yield from self._of_one_law(name, own, _GIVEN[self.frame.stated_model])
        elif is_rolling and assumes_displacement(self.frame):
            yield from self._of_rolling(name)
        elif self._is_of_any_law(name):
            yield from self._of_one_law(name, own, ANY_LAW)
        else:
            if name in _STICKING:
                yield from self._of_sticking(name, own)
            if name == "restitution":
                yield from self._of_restitution()
            if name == "lost_energy":
                yield self.has_no_jump, nan, own[1], ADHESION_ONLY
            if name in _BREAKING:
                yield self._tabor_parameter >= JUMP, *own, DEFINITION
            yield from self._of_attraction(name, own)

    def _is_of_any_law(self, name: str) -> bool:
        """Return whether a result follows from the same formulas under the law in use and under Maugis' law."""
        other = _between(self.frame)
        is_computed = name not in self.results.described.unknowns and not other.missing([name])
        return is_computed and other.formulas_to(name) == self.frame.formulas_to(name)

    def _is_from_losses(self, name: str) -> bool:
        """Return whether a result is an input that was inferred from a collision as if it caused every loss."""
        is_unknown = name in _ACT_LIKE_LOSSES and name in self.results.described.unknowns
        return is_unknown and not _SHIFTED_BY_LOSSES.isdisjoint(self.results.judged)

    def _of_one_law(self, name: str, own: Ends, rule: int) -> Iterator[Rule]:
        """Iterate over the rules for a result of one law: an assumed spacing if it widens the range, then the law."""
        if self.frame.assumes_spacing:
            low, high = self.hull(name, itself, at_half_spacing)
            is_wider = (own[0] - low > _SAME * abs(own[0])) | (high - own[1] > _SAME * abs(own[1]))
            yield is_wider, low, high, SPACING_ASSUMED
        yield True, *own, rule

    def _of_attraction(self, name: str, own: Ends) -> Iterator[Rule]:
        """Iterate over the rules for results that depend on the law of attraction."""
        if name not in self._ends(_between):
            if name in _AS_PULL_OFF:  # the contact modulus is missing
                yield True, own[0], own[1] * self._dmt_over_jkr, BOUNDS
            if "shear_strength" in self.frame.formulas_to(name):
                yield True, *self.hull(name, *_FRICTIONS), FRICTION_ASSUMED
            yield True, *own, LAW_ONLY
            return
        columns = [law(self.results.described).column(name) for law in _BETTER]
        yield columns[0].reasons != 0, *own, LAW_ONLY
        low, high = self.by_better_law(name)
        low_of_all, high_of_all = self.hull(name, itself, *_BETTER)
        by_others = [column.or_zero() for column in columns]
        if name in _BY_LENNARD_JONES:
            by_lennard_jones, most = self._by_lennard_jones(name)
            by_others.append(by_lennard_jones)
            high, high_of_all = at_least(high, most), at_least(high_of_all, most)
        value = self.results.computed[name].or_zero()
        yield farthest((other, value) for other in by_others) > LAW_MATTERS, low, high, BETTER_LAW
        yield True, low_of_all, high_of_all, LAW_IN_USE

    def _of_water(self, name: str, own: Ends) -> Rule:
        """Return the rule for condensed water: a force lies between its first-order value and an upper bound.

        With a gap, any force up to the first-order force is possible. For a small meniscus, both ends are the
        first-order force, since the exact force is within half a percent of it.
        """
        if name != "meniscus_force":
            return True, *own, KELVIN
        if "roughness_gap" in self.frame.given:
            return True, nan, own[1], GAP
        size = self.frame["meniscus_size"]
        return True, own[0], own[1] * where(size > 0.05, 1 + 2 * size * size, 1.0), KELVIN

    def _of_sticking(self, name: str, own: Ends) -> Iterator[Rule]:
        """Iterate over the rules that measurements give for the largest speed, or energy, at which spheres stick."""
        if VISCOUS_TIME in self.frame.stated:
            return
        power, stuck = _STICKING[name], what_stuck(self.frame)
        speed = self.frame.numbers("sticking_speed").get("sticking_speed")
        if stuck is not None and speed is not None:
            value = self.results.computed[name].values
            can_be_scaled = stuck.can_be_scaled(self.frame) & self._is_hard
            for applies, (low, high) in (
                (stuck.is_near(self.frame), stuck.ends(self.frame)),
                (can_be_scaled, stuck.in_proportion(self.frame)),
            ):
                yield applies, value * (low / speed) ** power, value * (high / speed) ** power, MEASURED
        yield self._is_hard, own[0], MOST_SEEN**power * own[1], SEEN

    def _of_restitution(self) -> Iterator[Rule]:
        """Iterate over the rules for the coefficient of restitution, which any further loss lowers.

        It is 0 below the range of the sticking speed, if this range is by measurements.
        """
        of_speed = self
        if "sticking_speed" not in self.names:  # a question about e alone needs the range of the speed, too
            of_speed = Ranges.of(self.results.described, "sticking_speed")
        if "sticking_speed" in of_speed.names:
            speeds = of_speed.estimate("sticking_speed")
            for rule in (MEASURED, SEEN):
                yield (speeds.by == rule) & (self.frame["speed"] < speeds.low), 0.0, 0.0, rule
        is_ended = self.results.ended.get("restitution", False)
        least, most = (where(is_ended, nan, end) for end in (0.0, 1.0))
        yield self.has_no_jump, least, most, ADHESION_ONLY
        if VISCOUS_TIME not in self.frame.stated:
            yield self._is_hard, least, self.hull("restitution", itself, *_BETTER)[1], ADHESION_ONLY

    def _of_rolling(self, name: str) -> Iterator[Rule]:
        """Iterate over the rules for a rolling quantity with an assumed ξ: scaled measurements, then limits of ξ.

        If the solid has the surface energy of the measurements, the range by the second rule covers them as well.
        """
        rolled = what_rolled(self.frame)
        least, most, is_known = nan, nan, False
        if rolled is not None:
            variants = (then(law, displaced) for law in (itself, *_BETTER) for displaced in rolled.variants)
            least, most = self.hull(name, *variants)
            is_known = rolled.has_energy(self.frame)
            yield rolled.can_be_scaled(self.frame), least, most, SCALED
        laws = _BETTER if name in self._ends(_between) else (itself,)
        at_an_atom = self.hull(name, *laws)
        low, high = self.at_full_hysteresis(name, *laws)
        loses_all = self.hull("hysteresis_ratio", *laws)[1] >= 1  # the assumed ξ loses all of w, or more
        at_twice_xi = (then(law, _at_twice_xi) for law in laws)
        rises_with_xi = self._most(name, *at_twice_xi) > self._most(name, *laws)
        low = where(rises_with_xi, where(loses_all, nan, at_an_atom[0]), low)
        high = where(rises_with_xi, high, where(loses_all, nan, at_an_atom[1]))
        low, high = where(is_known & (least < low), least, low), where(is_known & (most > high), most, high)
        yield True, low, high, XI_UNKNOWN

    def at_full_hysteresis(self, name: str, *laws: Variant) -> Ends:
        """Return the ends of a result if all of the work of adhesion is lost, by `laws` or else by the better law."""
        variants = (then(law, at_full_hysteresis) for law in laws or _BETTER)
        return self.hull(name, *variants, needs="hysteresis_ratio")

    def of_laws(self, name: str, by: int) -> list[Ends]:
        """Return the ends of a result for a rule, by the law in use and by Maugis' law at z0 and z0/2.

        With a given z0, the last two are the same.
        """
        displacements: tuple[Variant, ...] = (itself,)
        if by == XI_UNKNOWN:
            displacements = (itself, at_full_hysteresis)
        elif by == SCALED:
            rolled = what_rolled(self.frame)
            displacements = rolled.variants if rolled is not None else displacements
        return [self.hull(name, *(then(law, displaced) for displaced in displacements)) for law in (itself, *_BETTER)]

    # --- Other laws and measurements ---

    def by_better_law(self, name: str) -> Ends:
        """Return the ends of a result by Maugis' law at the atomic spacing z0, and at z0/2 if z0 is assumed."""
        return self.hull(name, *_BETTER)

    def hull(self, name: str, *variants: Variant, needs: str = "") -> Ends:
        """Return the least and the largest value of a result over variants of the frame, uncertainties included.

        An end is open in rows where the value of some variant lies beyond it but has no meaning. If `needs` names a
        quantity, a variant counts only in rows where it has a value of this quantity, too.
        """
        low: Any = inf
        high: Any = -inf
        without_meaning = []
        for ends in map(self._ends, variants):
            if name not in ends or (needs and needs not in ends):
                continue
            least, most, is_ended = ends[name]
            has_value: Any = where(is_ended, False, most - least >= 0)
            if needs:
                has_value = where(ends[needs][1] >= 0, has_value, False)
            low, high = at_most(low, where(has_value, least, inf)), at_least(high, where(has_value, most, -inf))
            if is_anywhere(is_ended):
                without_meaning.append((where(is_ended, least, inf), where(is_ended, most, -inf)))
        for least, most in without_meaning:
            is_lower = least + _SAME * abs(low) < low
            is_higher = most - _SAME * abs(high) > high
            low, high = where(is_lower, inf, low), where(is_higher, -inf, high)
        return where(low < inf, low, nan), where(high > -inf, high, nan)

    def _most(self, name: str, *variants: Variant) -> Any:
        """Return the largest value of a result over variants of the frame, whether or not it has a meaning."""
        most: Any = -inf
        for ends in map(self._ends, variants):
            if name in ends:
                most = at_least(most, ends[name][1])
        return most

    def _ends(self, variant: Variant) -> Mapping[str, tuple[Any, Any, Any]]:
        """Return the ends of results in a variant of the frame, see `_ends_by`; none if the variant does not exist."""
        if variant not in self._kept:
            self._kept[variant] = {}
            with suppress(MissingInput, NoResult):
                names = dict.fromkeys((*self.names, XI, "hysteresis_ratio"))
                for name in self.names:
                    names |= dict.fromkeys(_BY_LENNARD_JONES.get(name, ())[1:])
                self._kept[variant] = _ends_by(variant, self.results.described, names)
        return self._kept[variant]

    @property
    def _tabor_parameter(self) -> Any:
        """The Tabor parameter, infinite if it is unknown."""
        return self.frame.numbers("tabor_parameter").get("tabor_parameter", INFINITY)

    @property
    def _is_hard(self) -> Any:
        """The rows whose solids are too stiff to flatten their roughness; those without a modulus are left out."""
        return self.frame.numbers("contact_modulus").get("contact_modulus", 0.0) >= SOFT

    @property
    def has_no_jump(self) -> Any:
        """The rows in which the contact forms and opens without a jump, at all likely atomic spacings."""
        return self._tabor_parameter * (2 if self.frame.assumes_spacing else 1) < JUMP

    @property
    def _dmt_over_jkr(self) -> Any:
        """The pull-off force of rigid spheres over that of soft ones."""
        return self.frame["pull_off_force_dmt"] / self.frame["pull_off_force"]

    def _by_lennard_jones(self, name: str) -> tuple[Any, Any]:
        """Return a result by Lennard-Jones' law, and its upper end.

        For energies and speeds, this law applies only to contacts without a jump. Elsewhere the result is that of the
        law in use, and its upper end is −∞.
        """
        power, *bases = _BY_LENNARD_JONES[name]
        own, base, base_by_law = (self.frame.column(each).values for each in (name, *bases))
        own_most, base_most, base_most_by_law = (self.hull(each, itself)[1] for each in (name, *bases))
        by_law, most = base_by_law, base_most_by_law
        if name not in bases:
            by_law, most = own * (base_by_law / base) ** power, own_most * (base_most_by_law / base_most) ** power
        applies = True if name in _AS_PULL_OFF else self._tabor_parameter < JUMP
        return where(applies, by_law, own), where(applies, most, -inf)


def _ends_by(variant: Variant, frame: Frame, names: Iterable[str]) -> dict[str, tuple[Any, Any, Any]]:
    """Return the ends of quantities in a variant of a frame, with the rows in which a limit makes them meaningless.

    The ends are those of the uncertainty; without one, both are the value. If uncertainties cannot be computed, an
    error is raised for a frame of several rows, and a single row gets no uncertainty.
    """
    other = variant(frame)
    columns, bars = other.columns(other.possible(names)), dict[str, ErrorBar]()
    if frame.uncertainties:
        try:
            bars = error_bars(frame, columns, variant)
        except JkrollError:
            if frame.shape:  # the error may concern one row only; the caller then computes each row alone
                raise
    ended, ends = Results(other, columns).ended, {}
    for name, column in columns.items():
        if not column.is_empty:
            ends[name] = (*_with_bar(column.values, bars.get(name)), ended.get(name, False))
    return ends


def _with_bar(value: Any, bar: ErrorBar | None) -> Ends:
    """Return the ends of an uncertainty; the value twice in rows without one."""
    if bar is None or not bar.sides:
        return value, value
    low, high = ends_of(bar.of(value))
    has_bar = high - low >= 0
    return where(has_bar, low, value), where(has_bar, high, value)


def _between(frame: Frame) -> Frame:
    """Return the frame under the law that holds between JKR and DMT."""
    return frame if frame.law.name == BETWEEN else frame.by_law_at_spacing


def _between_at_half(frame: Frame) -> Frame:
    """Return the frame under the law between JKR and DMT, at half the atomic spacing unless the spacing was given."""
    return at_half_spacing(_between(frame)) if frame.assumes_spacing else _between(frame)


def _at_twice_xi(frame: Frame) -> Frame:
    """Return the frame with twice the displacement."""
    return frame.replace(**{XI: 2 * frame[XI]})


def _with_friction(factor: float, frame: Frame) -> Frame:
    """Return the frame with its shear strength multiplied by a factor, within the range that a frame accepts."""
    strength = frame["shear_strength"] * factor
    return frame.replace(shear_strength=at_most(at_least(strength, LEAST), MOST))


_BETTER = (_between, _between_at_half)
_FRICTIONS = (partial(_with_friction, 1 / FRICTION_FACTOR), partial(_with_friction, FRICTION_FACTOR))


@cache
def then(first: Variant, second: Variant) -> Variant:
    """Return the composition of two variants; the same pair gives the same function."""
    return lambda frame: second(first(frame))
