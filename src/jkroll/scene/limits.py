"""The limits of the model: one table of numbers and thresholds, which serves answers, maps and tables alike."""

import operator
from collections.abc import Collection, Iterator, Mapping
from functools import cache
from itertools import accumulate
from math import log, nan
from typing import Any, Literal, NamedTuple

from ..errors import JkrollError
from ..physics.elementary import where
from ..quantities.laws import BETWEEN, LAWS
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, STATE_OR_LOAD
from .effects import Effect, effects, largest
from .failures import MissingInput, NotInLaw
from .scene import Scene


class Doubt(NamedTuple):
    """A threshold, the state of a number beyond it, and what that means for an answer."""

    threshold: float
    condition: str
    consequence: str


class Limit(NamedTuple):
    """A number that limits the model, the quantities whose use it touches, and the words for either side.

    A value is in doubt where it is, for example, "<" a threshold. Several doubts of one number stand in the order in
    which a value meets them. The law of attraction is judged by its effect on the answers, beside which the number is
    told.
    """

    name: str
    touches: frozenset[str]
    sign: Literal["<", "<=", ">", ">="]
    doubts: tuple[Doubt, ...]
    fine: str
    stated: frozenset[str] = frozenset()  # inputs; unless one of them was stated, the limit is not judged
    laws: tuple[str, ...] = ()  # of attraction, under which alone the limit is judged
    conclusion: str = ""  # the name of what follows, if it is not that of the number
    by_effect: bool = False  # judged by the factor between answers under the law in use and under the one that holds
    is_error: bool = False  # the number is a relative error

    def level(self, value: Any) -> Any:
        """Return how many doubts a number, or each element of an array, meets: the last of them is the one to be told.

        It is 0 where the limit holds, and for nan.
        """
        compare = _COMPARISONS[self.sign]
        return sum(1 * compare(value, doubt.threshold) for doubt in self.doubts)

    def code(self, doubt: Doubt) -> str:
        """Return a short text for a doubt: "a/z0<3", "law>5%"."""
        if self.by_effect:
            return f"law>{100 * (doubt.threshold - 1):.0f}%" if doubt.threshold < 2 else f"law>×{doubt.threshold:g}"
        return f"{NOMENCLATURE[self.name].symbol}{self.sign}{doubt.threshold:g}"

    def judge(self, value: float, factor: float) -> "Verdict":
        """Return what follows from a value, in words; `factor`: between answers under the two laws."""
        level = self.level(factor if self.by_effect else value)
        if not level:
            return Verdict(self.name, value, True, self.fine, "", self.conclusion)
        doubt = self.doubts[level - 1]
        text = f"{doubt.condition}: {doubt.consequence}"
        return Verdict(self.name, value, False, text, self.code(doubt), self.conclusion, size=self._size(value, factor))

    def _size(self, value: float, factor: float) -> float:
        """Return how far a doubt reaches, as the logarithm of a factor: between the laws, or of a number over its first threshold."""
        if self.by_effect:
            return log(factor)
        over = 1 + value if self.is_error else abs(value / self.doubts[0].threshold) if self.doubts[0].threshold else 0
        return abs(log(over)) if 0 < over < INFINITY else INFINITY


class Verdict(NamedTuple):
    """A number that limits the model, and what follows from it for an answer."""

    name: str
    value: float
    holds: bool
    text: str
    code: str  # of the doubt; empty where the limit holds
    conclusion: str = ""  # the name of what follows, if it is not that of the number
    sentence: str = ""  # that says all of it, in place of the number and the text
    size: float = 0.0  # of a doubt: the logarithm of a factor


class Judgement(NamedTuple):
    """The verdicts of one scene, and the effects of the law."""

    verdicts: tuple[Verdict, ...]
    effects: Mapping[str, Effect]


_COMPARISONS = {"<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge}
# What rests on the law and on elasticity; in DMT, at an approach, the radius rests on no work of adhesion, nor does Q/P_c without load.
_ELASTICITY = frozenset({"work_of_adhesion", "contact_radius_at_load", "yield_force_ratio"})
_DISPLACEMENT = frozenset({"yield_displacement"})
_MOMENT = frozenset({"yield_moment", "yield_force"})
_STICKING = frozenset({"sticking_energy", "sticking_speed"})
JUMP = 0.7  # Tabor parameter below which no jump was found of a contact of Lennard-Jones' 3-9 law at fixed grips
_TURNS = frozenset({"n_roll", "n_roll_energy_balance", "n_roll_after_impact"})
IMPACT = frozenset({"energy", "energy_ratio", "speed"})

_EFFECTS = {1.05: "5 %", 1.25: "25 %", 2.0: "a factor of 2"}  # of the law of attraction, as factors
LEAST_EFFECT = min(_EFFECTS)

# The law of attraction; then what takes the meaning of an answer away; then what makes it inexact.
LIMITS = (
    Limit(
        "tabor_parameter", _ELASTICITY, ">",
        tuple(
            Doubt(factor, f"off by more than {text}", f"by {LAWS[BETWEEN].title} or Lennard-Jones a result differs by more than {text}")
            for factor, text in _EFFECTS.items()
        ),
        f"within {_EFFECTS[LEAST_EFFECT]} of {LAWS[BETWEEN].title}",
        laws=tuple(law for law in LAWS if law != BETWEEN),
        by_effect=True,
    ),
    Limit("tabor_parameter", _ELASTICITY, ">", (), f"{LAWS[BETWEEN].title} covers all from DMT to JKR", laws=(BETWEEN,)),
    Limit(
        "load_margin", frozenset({"load_factor"}), "<=",
        (Doubt(0.0, "at or beyond pull-off", "only fixed grips hold this state"),),
        "stable at its load",
        STATE_OR_LOAD,
    ),
    Limit(
        "displacement_ratio", _DISPLACEMENT, ">=",
        (Doubt(1.0, "above 1", "the shifted circle is impossible; the moment holds all the same while M/2cRw < 1"),),
        "below 1: the shifted contact is possible",
    ),
    Limit(
        "displacement_over_contact_radius", _DISPLACEMENT, ">",
        (Doubt(1.0, "above 1", "the contact would lose its apex"),),
        "below 1: the contact keeps its apex",
    ),
    Limit(
        "yield_force_ratio", frozenset({"yield_force"}), ">=",
        (Doubt(1.0, "above 1", "the contact breaks before it rolls"),),
        "below 1: it rolls before it breaks",
    ),
    Limit(
        "peeling_over_sliding", frozenset({"sliding_force"}), "<",
        (Doubt(1.0, "below 1", "the contact peels off before it slides, if it is brittle"),),
        "above 1: it slides before it peels off",
    ),
    Limit(
        "yield_angle", frozenset({"yield_angle", "r_min"}), ">",
        (Doubt(1.0, "above 1 rad", "angles are small in the model"),),
        "below 1 rad: a small angle",
    ),
    Limit(
        "r_min_over_radius", frozenset({"r_min"}), "<",
        (Doubt(1.0, "below 1", "no chain bends within one of its spheres"),),
        "above 1: a chain can bend so far",
    ),
    Limit(
        "n_grav", frozenset({"n_grav"}), "<",
        (Doubt(1.0, "below 1", "held out level, even one sphere rolls down; it falls off where Bo is below 1"),),
        "above 1: a sphere stands out level",
    ),
    Limit(
        "energy_over_yield", _TURNS, "<=",
        (Doubt(1.0, "below 1", "the contact springs back and does not roll"),),
        "above 1: it rolls",
    ),
    Limit(
        "energy_over_sticking", _TURNS, ">",
        (Doubt(1.0, "above 1", "after a head-on impact the spheres do not stick"),),
        "below 1: the spheres stick",
        IMPACT,
    ),
    Limit(
        "hysteresis_ratio", _MOMENT, ">",
        (
            Doubt(
                1.0, "above 1",
                "the moment exceeds what adhesion hysteresis can supply (2cRw); viscous, plastic or capillary loss could",
            ),
        ),
        "below 1: adhesion hysteresis can supply it",
    ),
    Limit(
        "tabor_parameter", _STICKING, "<",
        (
            Doubt(
                JUMP, f"below {JUMP:g}",
                "a Lennard-Jones (3–9) contact makes and breaks without a jump, and adhesion alone loses nothing; μ goes as 1/z0 (--z0)",
            ),
        ),
        "contacts jump together and apart",
        conclusion="has_jump",
    ),
    Limit(
        "contact_radius_in_spacings", _ELASTICITY, "<",
        (Doubt(3.0, "few atoms in the contact", "elasticity is in doubt"),),
        "many atoms in the contact",
    ),
    Limit(
        "profile_error", _ELASTICITY, ">",
        (Doubt(0.01, "above 1 %", "the contact is so wide that a sphere is no paraboloid"),),
        "below 1 %: in the contact, spheres are paraboloids",
        is_error=True,
    ),
)  # fmt: skip

# A doubt is a bit until it is worded: one for each doubt of each limit, in their order, and a last one for limits that could not
# be judged.
DOUBTS = tuple((limit, doubt) for limit in LIMITS for doubt in limit.doubts)
_FIRST = tuple(accumulate((len(limit.doubts) for limit in LIMITS), initial=0))  # the bit of the first doubt of each
NOT_JUDGED = 1 << len(DOUBTS)


class Told(NamedTuple):
    """A doubt in words that fit any scene: its code, and what it means."""

    code: str
    consequence: str


TOLD = tuple(Told(limit.code(doubt), doubt.consequence.partition(";")[0]) for limit, doubt in DOUBTS)


def judged(scene: Scene, names: Collection[str]) -> Judgement:
    """Return what limits the answers to these names, as far as the scene allows to judge it."""
    verdicts: list[Verdict] = []
    of_law: Mapping[str, Effect] = {}
    for limit, _, value in _touching(scene, names):
        if not isinstance(value, JkrollError):
            of_law = effects(scene, names) if limit.by_effect else of_law
            verdicts.append(limit.judge(value, largest(of_law)))
    return Judgement(tuple(verdicts), of_law)


def not_judged(scene: Scene, names: Collection[str]) -> dict[str, list[str]]:
    """Return the limits of the answers to these names that could not be judged, by the inputs that they need."""
    missing: dict[str, list[str]] = {}
    for limit, _, value in _touching(scene, names):
        if isinstance(value, MissingInput):
            missing.setdefault(value.needs(), []).append(limit.name)
    return missing


def doubts(scene: Scene, names: Collection[str]) -> Any:
    """Return the doubts about the answers to these names as bits: a whole number, or an array for a scene of arrays."""
    found: Any = 0
    for limit, first, value in _touching(scene, names):
        if not isinstance(value, JkrollError):
            level = limit.level(_effect_where(value, scene, names) if limit.by_effect else value)
            found = found | (1 << level >> 1) << first  # no bit at level 0, else that of the last doubt that is met
        elif isinstance(value, MissingInput):
            found = found | NOT_JUDGED
    return found


def _effect_where(number: Any, scene: Scene, names: Collection[str]) -> Any:
    """Return the largest effect of the law where there is a number beside which it is told, and nan elsewhere."""
    return where(number == number, largest(effects(scene, names)), nan)  # noqa: PLR0124


def possible_doubts(scene: Scene, names: Collection[str]) -> int:
    """Return the bits of all doubts that the answers to these names can have, whatever the numbers are."""
    found = 0
    for limit, first, value in _touching(scene, names):
        if not isinstance(value, JkrollError):
            found |= (1 << len(limit.doubts)) - 1 << first
        elif isinstance(value, MissingInput):
            found |= NOT_JUDGED
    return found


def told(bits: int) -> list[Told]:
    """Return the doubts that bits stand for."""
    return [one for place, one in enumerate(TOLD) if bits >> place & 1]


def bits_of(names: Collection[str]) -> int:
    """Return the bits of all doubts about some numbers, but for those from which something else is concluded."""
    return sum(1 << place for place, (limit, _) in enumerate(DOUBTS) if limit.name in names and not limit.conclusion)


@cache  # many rows have the same doubts
def codes(bits: int) -> str:
    """Return the codes of the doubts that bits stand for, and "?" if there are limits that could not be judged."""
    return " ".join([*(one.code for one in told(bits)), *(["?"] if bits & NOT_JUDGED else [])])


def sentence(verdict: Verdict) -> str:
    """Return a verdict with its number: "a/z0 = 2.15, few atoms in the contact: elasticity is in doubt"."""
    return verdict.sentence or f"{NOMENCLATURE[verdict.name].symbol} = {verdict.value:.3g}, {verdict.text}"


def against_limit(verdict: Verdict) -> str:
    """Return a doubt as a number and the limit that it exceeds: "a/z0 = 0.21 (<3)"."""
    symbol = NOMENCLATURE[verdict.name].symbol
    return f"{symbol} = {verdict.value:.3g} ({verdict.code.removeprefix(symbol)})"


def limits_of(scene: Scene, names: Collection[str]) -> list[Limit]:
    """Return the limits that concern the answers to these names; raise MissingInput if the scene does not allow one."""
    return [limit for limit, _ in _touched(scene, names)]


def _touched(scene: Scene, names: Collection[str]) -> list[tuple[Limit, int]]:
    """Return these limits, each with the bit of its first doubt."""
    used = scene.plan(*names).taken.union(names)
    return [
        (limit, first)
        for limit, first in zip(LIMITS, _FIRST[:-1], strict=True)
        if limit.touches & used
        and (not limit.laws or scene.law.name in limit.laws)
        and (not limit.stated or limit.stated & scene.stated.keys())
    ]


def _touching(scene: Scene, names: Collection[str]) -> Iterator[tuple[Limit, int, Any]]:
    """Iterate over these limits, as far as the law has them, with the bit of the first doubt of each, and its number or why it has none."""
    touched = _touched(scene, names)
    values = scene.evaluate([limit.name for limit, _ in touched])
    for limit, first in touched:
        if not isinstance(values[limit.name], NotInLaw):
            yield limit, first, values[limit.name]
