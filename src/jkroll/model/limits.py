"""The limits of the model, and the doubts that they raise about the results of a frame."""

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from functools import cache, cached_property, reduce
from itertools import chain
from math import exp, inf, nan
from operator import ge, gt, le, lt, or_
from typing import Any, Literal

from ..errors import JkrollError
from ..physics.elementary import at_least, at_most, is_anywhere, ln, where
from ..quantities.formatting import Format, amount
from ..quantities.laws import JKR_OF_SPHERE
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, STATE_OR_LOAD
from .column import Column
from .frame import Frame, once_a_frame
from .measured import FRACTION_HELD, SURFACES_FROM, is_smooth
from .other_law import factor_of_law
from .plan import taken_by
from .reasons import MISSING, RESTS_ON_SPACING, EndOfMeaning, Failure, cause_and_step, reason, register

# --- Limits -----------------------------------------------------------------------------------------------------------

_COMPARISONS = {"<": lt, "<=": le, ">": gt, ">=": ge}


class Limit:
    """A number to judge, the quantities that the limit affects directly (`touches`), and the consequence beyond it.

    The limit concerns these quantities, and all results that are computed from them. `sign` is the comparison that puts
    a number in doubt: with "<", a number below a threshold is in doubt. A number may have several thresholds, each with
    its code, in the order in which the number crosses them.
    """

    def __init__(
        self,
        name: str,
        touches: frozenset[str],
        sign: Literal["<", "<=", ">", ">="],
        codes: Mapping[float, str],  # by threshold
        consequence: str,  # in words: the meaning of a number beyond the threshold
        applies: Callable[[Frame, Collection[str]], bool] | None = None,  # whether it applies to results; None: always
        ends_meaning: bool = False,  # results beyond the limit have no meaning
        conclusion: str = "",  # in JSON, the name of the verdict, which is true within the limit
        # Computes the number to judge instead of the named number, such as the factor between the results of two laws.
        number: Callable[[Frame, Mapping[str, Column]], Any] | None = None,
        where: Callable[[Frame], Any] | None = None,  # the rows in which the limit is judged; only for ">" and ">="
        is_shown: bool = True,  # in answers; if False, only in explanations
        has_remedy: Callable[[Frame], bool] | None = None,  # whether the report can name a remedy; answers prefer it
        gives_number: bool = True,  # whether texts give the value of the named quantity, and the threshold
    ) -> None:
        self.name, self.touches, self.sign, self.codes = name, touches, sign, codes
        self.consequence, self.applies, self.ends_meaning = consequence, applies, ends_meaning
        self.conclusion, self.number, self.where, self.is_shown = conclusion, number, where, is_shown
        self.has_remedy, self.gives_number = has_remedy, gives_number
        self.threshold = next(iter(codes))  # the first threshold

    def is_beyond(self, number: Any, threshold: float) -> Any:
        """Return whether a number is beyond a threshold, element by element for arrays."""
        return _COMPARISONS[self.sign](number, threshold)

    def excess(self, number: Any) -> Any:
        """Return the distance beyond the first threshold; it is negative within the limit.

        It is ±ln(number/threshold), or ± the number if the threshold is 0.
        """
        size = ln(number / self.threshold) if self.threshold else number
        return size if self.sign.startswith(">") else -size

    @property
    def needs_threshold(self) -> bool:
        """True if the text must give the first threshold; 0 and 1 are evident, and `number` has no name in the text."""
        return self.number is None and self.threshold not in (0.0, 1.0)

    @property
    def bits(self) -> int:
        """All codes as bits."""
        return sum(BITS[code] for code in self.codes.values())


class Doubt:
    """A judged limit, the value of its quantity, and the number that was compared with the threshold.

    The value and the number may be arrays.
    """

    def __init__(
        self, limit: Limit, value: Any, judged: Any, error: JkrollError | None = None, unjudged: Any = False
    ) -> None:
        """`error`: the reason, if no row could be judged; `unjudged`: the rows that could not be judged."""
        self.limit, self.value, self.judged, self.error, self.unjudged = limit, value, judged, error, unjudged

    @property
    def excess(self) -> Any:
        """The distance of the number beyond the first threshold, see `Limit.excess`."""
        return self.limit.excess(self.judged)

    @property
    def is_exceeded(self) -> bool:
        """True if the number is in doubt."""
        return bool(self.is_beyond)

    @property
    def code(self) -> str:
        """The code of the last threshold that the number crosses; empty within the limit, UNCHECKED if not judged."""
        return codes(self.bits)

    @property
    def factor(self) -> float | None:
        """The factor by which the number is beyond the first threshold, below 1 within the limit.

        None if the factor is infinite or unknown, or if the threshold is 0.
        """
        return exp(self.excess) if self.limit.threshold and self.excess < inf else None

    @property
    def text(self) -> str:
        """The consequence with the number, for an answer: "contact radius below 3 atoms (a/z0 = 2.15, limit 3)".

        It is "within the limit" if the limit is not exceeded. A number that has no meaning itself is left out, and so
        is the number of a limit without `gives_number`.
        """
        if not self.is_exceeded:
            return "within the limit"
        number_has_no_meaning = self.limit.ends_meaning and self.limit.name in self.limit.touches
        if number_has_no_meaning or not self.limit.gives_number:
            return self.limit.consequence
        number = amount(self.limit.name, self.value, Format(digits=3))
        threshold = f", limit {self.limit.threshold:g}" if self.limit.needs_threshold else ""
        return f"{self.limit.consequence} ({NOMENCLATURE[self.limit.name].symbol} = {number}{threshold})"

    @cached_property
    def is_beyond(self) -> Any:
        """The rows beyond the first threshold, or False if there are no such rows, which is usual."""
        is_beyond = self.limit.is_beyond(self.judged, self.limit.threshold)
        return is_beyond if is_anywhere(is_beyond) else False

    @cached_property
    def bits(self) -> Any:
        """The code as a bit: an integer or an array."""
        if self.error is not None:
            return NOT_JUDGED
        (_, code), *others = self.limit.codes.items()
        bits = _bits_where(self.is_beyond, BITS[code], 0)
        if self.is_beyond is not False:
            for threshold, code in others:
                bits = _bits_where(self.limit.is_beyond(self.judged, threshold), BITS[code], bits)
        return _bits_where(self.unjudged, NOT_JUDGED, bits)

    @cached_property
    def ends(self) -> Any:
        """In each row, the reason as an integer if the limit makes results meaningless there, else 0."""
        return where(self.is_beyond, reason(ENDS[next(iter(self.limit.codes.values()))]), 0)


def _bits_where(condition: Any, bits: int, otherwise: Any) -> Any:
    """Return bits in the rows of a condition, as integers of 64 bits; in a browser, numpy's default integer has 32."""
    if isinstance(condition, bool):
        return bits if condition else otherwise
    import numpy

    return numpy.where(condition, numpy.int64(bits), otherwise)


# Every quantity that depends on the law or on elasticity is computed from one of these. The work of adhesion alone
# would miss two of them in DMT: the contact radius at an approach, and Q/P_c without load.
_LAW_OR_ELASTICITY = frozenset({"work_of_adhesion", "contact_radius_at_load", "yield_force_ratio"})
_DISPLACEMENT = frozenset({"yield_displacement"})
JUMP = 0.7  # Tabor parameter below which contacts by Lennard-Jones' 3-9 law have no jump at fixed grips
PEELS_FIRST, STICKING_UNSURE = "peels-before-sliding", "sticking-unsure"
ROUGH_MATTERS = "rough-matters"
GAP_STAYS_DRY = "gap-stays-dry"
FLIES_OFF = "flies-off"
WIDE_CONTACT = "wide-contact"
_PUSHED = frozenset({"yield_force", "yield_force_fixed_load", "yield_force_ratio"})
_TURNS = frozenset({"n_roll", "n_roll_energy_balance", "n_roll_after_impact"})
_PULLED = frozenset({"pull_off_force", "bond_number"})
_IMPACT = frozenset({"restitution", "lost_energy", "impact_pressure"})

LAW_MATTERS = 1.05  # factor between the results of two laws, above which the law matters
SOFT = 1e8  # contact modulus in Pa below which solids (rubbers, gels) flatten their roughness
RUBBERY = 0.49  # lowest Poisson's ratio of solids that stretch rather than yield, such as rubbers


@once_a_frame
def may_be_rough(frame: Frame) -> Any:
    """Return whether roughness can keep two solids apart; it cannot if they are soft, or both smooth, as mica is."""
    if is_smooth(frame.material) and (frame.material2 is None or is_smooth(frame.material2)):
        return False
    return frame.numbers("contact_modulus").get("contact_modulus", INFINITY) >= SOFT


@once_a_frame
def _is_rubbery(frame: Frame) -> Any:
    """Return whether the softer of two bodies keeps its volume, as rubbers and gels do."""
    known = frame.numbers("youngs_modulus", "youngs_modulus2", "poisson_ratio", "poisson_ratio2")
    if len(known) < 4:
        return False
    is_second = known["youngs_modulus2"] < known["youngs_modulus"]
    return where(is_second, known["poisson_ratio2"], known["poisson_ratio"]) >= RUBBERY


@once_a_frame
def may_be_sphere(frame: Frame) -> bool:
    """Return whether the profile of a true sphere applies to the frame."""
    return bool(frame.under(JKR_OF_SPHERE).numbers("indenter_radius"))


def _is_not_rubbery(frame: Frame) -> Any:
    """Return whether the softer of two bodies can yield."""
    return where(_is_rubbery(frame), False, True)


def _miscounted_contacts(frame: Frame, _: Mapping[str, Column]) -> Any:
    """Return the factor by which the number of contacts is below N - 1 or above 6N; at most 1 between them."""
    contacts, grains = frame["contacts"], frame["monomers"]
    return at_least((grains - 1) / contacts, contacts / (6 * grains))


def _has_speed(frame: Frame, names: Collection[str]) -> bool:  # noqa: ARG001
    """Return whether a speed was stated."""
    return "speed" in frame.stated


def _too_slow(name: str, least: float, code: str, energy: str) -> Limit:
    """Return the limit of a number of turns. `least`: the energy that starts rolling, in units of the yield energy."""
    consequence = f"{energy} too little to start rolling"
    of_turns = frozenset({name})
    return Limit("energy_over_yield", of_turns, "<=", {least: code}, consequence, ends_meaning=True, gives_number=False)


# Limits that make results meaningless come first, then the law of attraction, then causes of inexact results.
CONTACT_EXCEEDS_SPHERE = Limit(
    "contact_over_sphere", _LAW_OR_ELASTICITY | _DISPLACEMENT, ">", {1.0: "contact-exceeds-sphere"},
    "the contact is wider than the smaller sphere; the surface tension of the solid matters then",
    ends_meaning=True,
)  # fmt: skip
ENDING = (
    CONTACT_EXCEEDS_SPHERE,
    Limit(
        "displacement_ratio", _DISPLACEMENT, ">=", {1.0: "xi-over-limit"},
        "ξ is too large for the formula",
        ends_meaning=True,
    ),
    Limit(
        "displacement_over_contact_radius", _DISPLACEMENT, ">", {1.0: "xi-over-contact"},
        "ξ is larger than the contact",
        ends_meaning=True,
    ),
    Limit(
        "rolling_over_sliding", _PUSHED, ">=", {1.0: "slides-first"},
        "the contact slides or peels off before it rolls",
        ends_meaning=True,
    ),
    Limit(
        "r_min_over_radius", frozenset({"r_min"}), "<", {1.0: "bend-below-sphere"},
        "no chain bends more sharply than the radius of its spheres",
        ends_meaning=True,
    ),
    Limit(
        "n_grav", frozenset({"n_grav"}), "<", {1.0: "no-chain"},
        "not even one sphere can be held out level: it rolls down, or falls off if Bo is below 1",
        ends_meaning=True,
    ),
    _too_slow("n_roll", 7 / 2, "does-not-roll-sliding", "a contact that slides freely rolls with 2/7 of the energy,"),
    _too_slow("n_roll_after_impact", 7 / 5, "does-not-roll-after-impact", "after impact, 5/7 of the energy is left,"),
    _too_slow("n_roll_energy_balance", 1.0, "does-not-roll", "its energy is"),
    Limit(
        "flight_ratio", _TURNS, ">", {1.0: FLIES_OFF},
        "too fast to roll around body 2: it flies off",
        ends_meaning=True,
    ),
    Limit(
        "threshold_humidity", frozenset({"meniscus_force"}), "<", {1.0: GAP_STAYS_DRY},
        "no meniscus: the gap fills only at a higher humidity",
        lambda frame, _: {"humidity", "roughness_gap"} <= frame.stated.keys(),
        ends_meaning=True,
        number=lambda frame, _: frame["humidity"] / frame["threshold_humidity"],
    ),
    Limit(
        "speed_over_sound", _IMPACT, ">", {1.0: "faster-than-sound"},
        "faster than sound in the solid: no static contact describes that",
        _has_speed,
        ends_meaning=True,
    ),
)  # fmt: skip
LAW = Limit(
    "tabor_parameter", _LAW_OR_ELASTICITY, ">",
    {LAW_MATTERS: "law-off-5%", 1.25: "law-off-25%", 2.0: "law-off-2x"},
    "Maugis' law, the better one, differs by more than this",
    number=factor_of_law,
)  # fmt: skip
INEXACT = (
    LAW,
    Limit(
        "load_margin", frozenset({"load_factor"}), "<=", {0.0: "beyond-pull-off"},
        "only fixed grips hold this state",
        lambda frame, _: not STATE_OR_LOAD.isdisjoint(frame.stated),
    ),
    Limit(
        "yield_force_fixed_load", frozenset({"yield_force_fixed_load"}), ">", {1.0: "rolls-by-itself"},
        "a load of fixed direction is enough to roll sphere 1; Q_P is then the force that holds it back",
        number=lambda frame, _: 1 - frame["yield_force_fixed_load"] / frame["yield_force"],  # driving/resisting force
    ),
    Limit(
        "peeling_over_sliding", frozenset({"sliding_force"}), "<", {1.0: PEELS_FIRST},
        "the contact peels off before it slides, if it is brittle",
    ),
    Limit(
        "yield_angle", frozenset({"yield_angle", "r_min"}), ">", {1.0: "large-angle"},
        "angles are small in the model",
    ),
    Limit(
        "speed_over_sticking", frozenset({"restitution", "sticking_speed"}), ">", {1.0: "bounces"},
        "free spheres that collide head-on bounce if adhesion is the only loss; further losses raise v_stick",
        _has_speed,
        is_shown=False,  # the restitution already shows this
    ),
    Limit(
        "speed_over_sound", _IMPACT, ">", {0.1: "near-sound-speed"},
        "too fast for a static contact: waves in the spheres carry energy away",
        _has_speed,
    ),
    Limit(
        "impact_pressure_over_modulus", _IMPACT, ">", {0.1: "impact-may-yield"},
        "the impact pressure exceeds even the strength of a flawless solid; e is an upper bound",
        lambda frame, _: "speed" in frame.stated and "yield_strength" not in frame.stated,
        where=_is_not_rubbery,
    ),
    Limit(
        "impact_pressure_over_modulus", _IMPACT, ">", {0.1: "impact-large-strain"},
        "the impact strains the solid too far for linear elasticity",
        _has_speed,
        where=_is_rubbery,
    ),
    Limit(
        "impact_over_yield", _IMPACT, ">", {1.0: "impact-yields"},
        "the pressure exceeds that of first yield below the surface; e is an upper bound",
        lambda frame, _: {"speed", "yield_strength"} <= frame.stated.keys(),
    ),
    Limit(
        "hysteresis_ratio", frozenset({"yield_moment", "yield_force"}), ">", {1.0: "moment-unexplained"},
        "adhesion hysteresis cannot supply this moment; at most 2cRw, c the radius of attraction; viscous, plastic or "
        "capillary loss could",
    ),
    Limit(
        "tabor_parameter", frozenset({"sticking_energy", "sticking_speed"}), "<", {JUMP: STICKING_UNSURE},
        "the contact forms and opens smoothly; almost no energy is lost to adhesion, and other losses decide",
        conclusion="has_jump",
    ),
    Limit(
        "viscosity_number", frozenset({"viscous_time", "viscosity_number"}), ">", {0.0: "fitted-elsewhere"},
        "the viscous time was fitted at one size, and v_stick holds only there; the speeds measured on silica imply "
        "23 ps at 0.6 µm and 7 ps at 0.25 µm, if γ is 25 mJ/m², and the formula of the damping is for T* well below 1",
    ),
    Limit(
        "radius", _PULLED, ">=", {SURFACES_FROM: ROUGH_MATTERS},
        f"real surfaces hold less: SiO2 held {FRACTION_HELD} at 25 mJ/m²",
        lambda _, names: not _PULLED.isdisjoint(names),
        number=lambda frame, _: at_most(frame["radius"], frame["radius2"]),
        where=may_be_rough,
    ),
    Limit(
        "contacts", frozenset({"disruption_energy"}), ">", {1.0: "contacts-out-of-range"},
        "a connected aggregate of N grains has at least N - 1 contacts, and at most 6N",
        lambda frame, _: {"contacts", "monomers"} <= frame.stated.keys(),
        number=_miscounted_contacts,
    ),
    Limit(
        "filling_factor", frozenset({"tensile_strength"}), ">", {1.0: "filling-out-of-range"},
        "the formula of P_tens was fitted to filling factors of 0.01 to 0.5",
        number=lambda frame, _: at_least(frame["filling_factor"] / 0.5, 0.01 / frame["filling_factor"]),
    ),
    Limit(
        "filling_factor", frozenset({"compressive_strength"}), ">", {0.1: "slides-and-twists"},
        "in an aggregate this dense, sliding and twisting determine P_comp; its formula assumes rolling",
    ),
    Limit(
        "meniscus_size", frozenset({"meniscus_force"}), ">", {0.1: "wide-meniscus"},
        "the meniscus is not small compared with the bodies; it may pull more, by a fraction of up to 2q²",
    ),
    Limit(
        "kelvin_radius", frozenset({"kelvin_radius"}), "<", {1.0: "few-molecules"},
        "the radius of the meniscus is 3 molecules of water or less, too few for a surface tension",
        number=lambda frame, _: frame["kelvin_radius"] / 1e-9,
    ),
    Limit(
        "contact_radius_in_spacings", _LAW_OR_ELASTICITY, "<", {3.0: "few-atoms"},
        "contact radius below 3 atoms",
    ),
    Limit(
        "hertz_pressure_over_modulus", _LAW_OR_ELASTICITY, ">", {0.1: "may-yield"},
        "the pressure exceeds even the strength of a flawless solid: numbers are rough; no plasticity is modelled",
        where=_is_not_rubbery,
    ),
    Limit(
        "hertz_pressure_over_modulus", _LAW_OR_ELASTICITY, ">", {0.1: "large-strain"},
        "strains too large for linear elasticity",
        where=_is_rubbery,
    ),
    Limit(
        "profile_error", _LAW_OR_ELASTICITY, ">", {0.01: WIDE_CONTACT},
        "contact too wide for the formulas; the profile that they assume for a sphere is off by e_h at the edge",
        has_remedy=may_be_sphere,
    ),
)  # fmt: skip
LIMITS = (*ENDING, *INEXACT)

# In columns, doubts are the bits of an integer: one bit for each code, in order, and a last one for limits that could
# not be judged.
UNCHECKED = "unchecked"
CODES = tuple(chain.from_iterable(limit.codes.values() for limit in LIMITS))
BITS = {code: 1 << position for position, code in enumerate((*CODES, UNCHECKED))}
ENDING_MEANING = sum(limit.bits for limit in ENDING)
NOT_JUDGED = BITS[UNCHECKED]
EVERY_DOUBT = sum(BITS.values())
# Explanations of the codes that make results meaningless; they are also reasons for empty cells.
MEANINGS = {code: limit.consequence.partition(";")[0] for limit in ENDING for code in limit.codes.values()}
ENDS = {code: register(EndOfMeaning(words, words, code=code)) for code, words in MEANINGS.items()}
MEANINGS[UNCHECKED] = "a limit needs an input that is not given"
# Quantities that keep their meaning beyond every limit: w, and the named quantity of each limit, unless a limit other
# than those of the law and of elasticity touches it.
MEANINGFUL_BEYOND_LIMITS = {"work_of_adhesion", *(limit.name for limit in LIMITS)}.difference(
    *(limit.touches for limit in LIMITS if "work_of_adhesion" not in limit.touches)
)


def doubts(frame: Frame, columns: Mapping[str, Column], limits: Iterable[Limit] = LIMITS) -> list[Doubt]:
    """Return the limits of the results in columns, each judged, or with the reason why it was not judged.

    A limit is left out if its number does not exist for the law or the contact.
    """
    to_judge = concerning(frame, columns, limits)
    numbers = frame.columns(limit.name for limit in to_judge)
    judged_limits = []
    for limit in to_judge:
        values, reasons = column = numbers[limit.name]
        if column.is_empty:
            cause, _ = cause_and_step(reasons)
            if cause is MISSING:
                judged_limits.append(Doubt(limit, nan, nan, frame.missing_input(limit.name)))
            elif cause is RESTS_ON_SPACING:
                judged_limits.append(Doubt(limit, nan, nan, Failure(cause, next(iter(limit.codes.values())))))
            continue
        judged = values if limit.number is None else where(reasons == 0, limit.number(frame, columns), nan)
        if limit.where is not None:
            judged = where(limit.where(frame), judged, 0.0)  # 0 is within every such limit
        judged_limits.append(Doubt(limit, values, judged, unjudged=reasons == reason(RESTS_ON_SPACING, limit.name)))
    return judged_limits


def concerning(frame: Frame, names: Collection[str], limits: Iterable[Limit] = LIMITS) -> list[Limit]:
    """Return the limits that concern some results, without limits whose `where` is False."""
    concerned = (limit for limit in limits if concerns(limit, frame, names))
    return [limit for limit in concerned if limit.where is None or limit.where(frame) is not False]


def concerns(limit: Limit, frame: Frame, names: Collection[str]) -> bool:
    """Return whether a limit concerns some results, and applies to them."""
    if limit.touches.isdisjoint(taken_by(tuple(names), *frame.plan_key)):
        return False
    return limit.applies is None or limit.applies(frame, names)


def bits_of(frame: Frame, results: Sequence[tuple[Any, Sequence[str]]], judged_limits: Iterable[Doubt]) -> Any:
    """Return the codes of doubts as bits. A limit counts in the rows in which it concerns one of the results.

    `results`: pairs of rows and the names of the results in these rows.
    """
    bits: Any = 0
    is_in_all_rows = all(rows is True for rows, _ in results)
    for doubt in judged_limits:
        if not isinstance(doubt.bits, int) or doubt.bits:
            rows = True if is_in_all_rows else rows_of(doubt.limit, frame, results)
            bits = bits | where(rows, doubt.bits, 0)
    return bits


def rows_of(limit: Limit, frame: Frame, results: Sequence[tuple[Any, Sequence[str]]]) -> Any:
    """Return the rows in which a limit concerns one of the results; `results`: see `bits_of`."""
    return reduce(or_, (rows for rows, names in results if concerns(limit, frame, names)), False)


@cache  # many rows share their doubts
def codes(bits: int) -> str:
    """Return the codes of bits, separated by spaces, UNCHECKED last."""
    return " ".join(code for code, bit in BITS.items() if bits & bit)
