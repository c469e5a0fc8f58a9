"""Reasons for missing values: their causes, and the errors and sentences that state them.

In columns a reason is an integer, 0 for none. It encodes a cause, and the step of the calculation that has no value.
The numbers in the sentence of a reason follow from the arguments of this step in the same row.

The rules at the end of this file state for which arguments a formula has no result.
"""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from functools import cache
from math import pi
from operator import gt, itemgetter, le
from typing import Any

from ..errors import JkrollError, NoResult, code_of
from ..physics import FORMULAS
from ..physics.contact import pull_off_force_dmt
from ..physics.elementary import where
from ..physics.jkr import approach_at_fold
from ..physics.meniscus import WIDEST
from ..physics.motion import FITTED_UP_TO
from ..physics.sphere import approach_at_fold_sphere, pull_off_force_sphere
from ..quantities.formatting import Format, amount
from ..quantities.laws import DEFAULT_LAW, LAWS, PARABOLOID, law_of
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, PROPERTIES, STATE_OR_LOAD
from ..quantities.values import parse_quantity
from ..text import listed

MAX_DIGITS = 17  # enough to distinguish any two doubles
_FEWEST = 4  # fewest digits of the numbers in a reason


class MissingInput(JkrollError):
    """Error raised when a quantity cannot be computed from the given inputs."""

    def __init__(self, wanted: str, missing: Sequence[str], lacking: str = "") -> None:
        """`lacking`: the materials that should provide the missing inputs, in words."""
        super().__init__(wanted, tuple(missing), lacking)
        self.wanted, self.missing, self.lacking = wanted, tuple(missing), lacking
        self.phrase = needs_in_words(self.missing)

    @property
    def code(self) -> str:
        """The code of the reason, the same for all missing inputs."""
        return MISSING.code

    def __str__(self) -> str:
        lacks_itself = self.wanted in self.missing
        return self.explanation() if lacks_itself else f"{NOMENCLATURE[self.wanted].sentence} {self.explanation()}"

    def explanation(self, verb: str = "needs") -> str:
        """Return the missing inputs, the materials that lack them, and the options to give, in words.

        The words follow the names of one or several quantities. `verb`: "need" for several.
        """
        options, radii = [], []
        for name in self.missing:
            quantity = NOMENCLATURE[name]
            if quantity.option:
                options.append(f"{quantity.option} {quantity.example}")
            else:
                radii.append(f"a radius such as {quantity.example}")
        examples = listed(filter(None, [" ".join(options), *radii]))
        give = "give"
        if self.lacking:
            give = f"{self.lacking}; give, for example,"
        elif {*self.missing} <= {*PROPERTIES}:
            give = "name a material, such as quartz, or give"
        of_pair = "; --work-of-adhesion 50mJ/m2 may replace --gamma" if "surface_energy" in self.missing else ""
        return f"{verb} {_in_words(self.missing)}; {give} {examples}{of_pair}"


class NotInLaw(MissingInput):
    """Error raised if a law of attraction lacks a quantity, or an argument of its formula."""

    def __init__(self, wanted: str, absent: Sequence[str], law: str) -> None:
        super().__init__(wanted, ())
        self.args = wanted, tuple(absent), law
        self.absent, self.law, self.phrase = tuple(absent), law, f"not in {law}"

    @property
    def code(self) -> str:
        """The code of the reason, the same for all laws."""
        return NOT_IN_LAW.code

    def __str__(self) -> str:
        return f"{self.wanted}: {self.explanation()}"

    def explanation(self, verb: str = "needs") -> str:
        """Return the quantity that is missing from the law, and the law or profile to give."""
        is_of_profile = any(law.title == self.law and law.profile != PARABOLOID for law in LAWS.values())
        words = {"profile": PARABOLOID} if is_of_profile else LAWS[law_of(self.absent[0]) or DEFAULT_LAW].words
        remedy = "give " + " ".join(f"--{option} {word}" for option, word in words.items())
        if self.absent == (self.wanted,):
            return f"not in {self.law}; {remedy}"
        return f"{verb} {_in_words(self.absent)}, which {self.law} does not have; {remedy}"


def needs_in_words(missing: Collection[str]) -> str:
    """Return the missing inputs by name, in words; an empty text if there are none."""
    return f"needs {listed(missing)}" if missing else ""


def _in_words(names: Iterable[str]) -> str:
    return listed(NOMENCLATURE[name].sentence for name in names)


class Cause:
    """A cause of missing values, in words."""

    def __init__(
        self,
        phrase: str,  # in the status of a row
        words: str,  # in full; {0} is the value of `name` that excludes a result, {1} and {2} are its limits
        name: str = "",  # the quantity whose value excludes a result
        # The comparison with the limit. Loads and approaches at their limit count as beyond it, since rounding may put
        # them there.
        is_beyond: Callable[[Any, Any], Any] = le,
        code: str = "",  # in JSON; the default is the phrase with hyphens
    ) -> None:
        self.phrase, self.words, self.name, self.is_beyond = phrase, words, name, is_beyond
        self.code = code or code_of(phrase)
        self.has_contact = name not in STATE_OR_LOAD  # without a contact, no value of the frame is valid

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and vars(other) == vars(self)  # copies in other processes are equal

    def __hash__(self) -> int:
        return hash(self.words)


class EndOfMeaning(Cause):
    """A cause that makes numbers meaningless; unformatted output and `jkroll.solve` still give the numbers."""


MISSING = Cause("", "an input that the plan names is missing", code="missing-input")
NOT_IN_LAW = Cause("", "the law does not have the quantity, as the plan says", code="not-in-law")
HIDDEN = Cause("", "a quantity of identical spheres, not asked for by name", code="hidden")
BEYOND_PULL_OFF = Cause("beyond pull-off", "{0} breaks this contact: the hardest pull that it holds is {1}", "load")
BEYOND_JKR = Cause(BEYOND_PULL_OFF.phrase, f"{BEYOND_PULL_OFF.words} by JKR, {{2}} at most by Maugis' law", "load")
HELD_BY_MAUGIS = Cause(BEYOND_PULL_OFF.phrase, f"{BEYOND_JKR.words}: --model maugis", "load")
NO_PROFILE = Cause(
    "no rigid sphere on a soft plane",
    "the profile of a sphere is for a rigid sphere (E1 ≥ 100 E2) on a plane of ν2 ≥ 0.45, such as a rubber or a gel; "
    "otherwise terms of order a/R exceed the effect of the sphere's shape, which is of order (a/R)²",
)
BEYOND_FOLD = Cause(
    "beyond the fold",
    "at {0} the spheres have parted; a stiff machine holds them up to {1}",
    "approach_at_load",
)
TWO_RIGID_BODIES = Cause(
    "both bodies are rigid", "both bodies are rigid and have no contact area; --model dmt has their pull-off force"
)
RESTS_ON_SPACING = Cause("needs atomic_spacing", "depends on z0; give --z0 4angstrom")
OF_IDENTICAL_SPHERES = Cause(
    "sphere 2 differs", "sphere 2 differs from sphere 1; the quantity is known for identical spheres only"
)
OF_ANOTHER_PAIR = EndOfMeaning("sphere 2 differs", "defined for identical spheres only")
NOT_HELD = Cause(  # between pull-off and the fold, where free spheres fly apart
    "held by grips alone", "beyond pull-off only fixed grips hold the contact; free spheres fly apart"
)
NOT_PRESSED = Cause("no load that presses", "needs a load that presses the spheres; give --load 5nN")
NO_CHAIN = Cause("sphere 2 is a plane", "sphere 2 is a plane; a chain needs two spheres")
RIGID = Cause("sphere 1 is rigid", "sphere 1 is rigid, and no wave runs around it")
APART = Cause("no contact circle", "the spheres are bound without touching; there is no contact circle")
TOO_MUCH_HYSTERESIS = Cause(
    "hysteresis above work of adhesion",
    "{0} is more than the work of adhesion, {1}: the hysteresis is a part of w",
    "adhesion_hysteresis",
    gt,
)
STICKS_ALWAYS = Cause(
    "sticks at every speed",
    "T* = {0} is above {1}: the spheres stick at every speed that this damping can describe",
    "viscosity_number",
    gt,
)
NO_POISSON_RATIO = Cause(
    "Poisson's ratio not positive",
    "the damping goes as 1/(ν1ν2), which needs nonzero Poisson's ratios of the same sign",
    code="poisson-ratio-not-positive",
)
YIELDS_ON_TOUCH = Cause(
    "yields on touching",
    "{0} is below {1}, the pressure of adhesion alone when a contact forms: the contact yields at every speed",
    "first_yield_pressure",
)
DRY_OR_SATURATED = Cause(
    "dry or saturated air", "a meniscus needs air that is neither dry nor saturated: 0 < RH < 100 %"
)
NO_WETTING = Cause("no wetting", "water with a contact angle of 90 deg or more draws nothing together and fills no gap")
WIDE_MENISCUS = Cause(
    "meniscus too wide",
    "{0} is above {1}: the meniscus is too wide for a force of first order",
    "meniscus_size",
    gt,
)
PLASTIC_ON_TOUCH = Cause("plastic on touching", YIELDS_ON_TOUCH.words, "plastic_pressure")
NO_DOUBLE = Cause("no finite value", "no value that a double can hold")
INFINITE = Cause("infinite", "infinite")  # such as the mass of a plane
NO_STIFFNESS = Cause("", "infinite where fixed grips let go", code="infinite-at-fold")


# The index of a cause is part of a reason; 0 means no reason.
_CAUSES = [None, *(value for value in [*globals().values()] if isinstance(value, Cause))]
_STEPS = ("", *dict.fromkeys((*NOMENCLATURE, *FORMULAS)))


def register(cause: Cause) -> Cause:
    """Add a cause to the list of causes, and return it."""
    _CAUSES.append(cause)
    return cause


@cache
def reason(cause: Cause, step: str = "") -> int:
    """Return the integer that encodes a reason. `step`: the quantity whose formula has no value, if there is one."""
    return _CAUSES.index(cause) * len(_STEPS) + _STEPS.index(step)


def cause_and_step(number: int) -> tuple[Cause | None, str]:
    """Return the cause and the step that the integer of a reason encodes."""
    cause, step = divmod(number, len(_STEPS))
    return _CAUSES[cause], _STEPS[step]


class Failure(NoResult):
    """Error raised for a quantity without a value, with the cause."""

    cause: Cause

    def __init__(self, cause: Cause, name: str = "", numbers: Sequence[float] = ()) -> None:
        """`name`: the quantity without a value; `numbers`: the value of the cause's quantity, and its limits."""
        super().__init__(cause, name, tuple(numbers))
        self.cause, self.name, self.numbers, self.phrase = cause, cause.name or name, tuple(numbers), cause.phrase

    @property
    def code(self) -> str:
        """The code of the cause."""
        return self.cause.code

    def explanation(self) -> str:
        """Return the cause in words with its numbers, with enough digits to distinguish a value from its limit.

        The first limit as shown is not below the exact limit, so a contact still exists at this load or approach.
        """
        if not self.numbers:
            return self.cause.words
        _, exact_limit, *_ = self.numbers
        for digits in range(_FEWEST, MAX_DIGITS + 1):
            value, limit, *others = (amount(self.name, number, Format(digits=digits)) for number in self.numbers)
            if value != limit and parse_quantity(limit, self.name) >= exact_limit:
                break
        return self.cause.words.format(value, limit, *others)


def reason_of(error: JkrollError) -> int:
    """Return the reason for an error."""
    if isinstance(error, MissingInput):
        return reason(NOT_IN_LAW if isinstance(error, NotInLaw) else MISSING)
    assert isinstance(error, NoResult)
    return reason(error.cause, error.args[1] if isinstance(error, Failure) else "")


class NoErrorBar(NoResult):
    """Error raised for a result without an uncertainty: at some value of an input, the result does not exist."""

    phrase = "no error bar"

    def __init__(self, name: str, why: str) -> None:
        super().__init__(name, why)
        self.name, self.why = name, why

    def explanation(self) -> str:
        """Return the reason in words."""
        return f"no uncertainty, as there is no value at some point within an input's uncertainty: {self.why}"


def explanation_of(name: str, error: JkrollError) -> str:
    """Return the reason for a missing value in words, without the name of the quantity.

    An error about another quantity keeps that quantity's name.
    """
    if isinstance(error, MissingInput) or (isinstance(error, NoResult) and name in error.name.split(",")):
        return error.explanation()
    return str(error)


def grouped(errors: Mapping[str, JkrollError]) -> Iterator[tuple[list[str], str]]:
    """Iterate over reasons in words, each with the quantities that it leaves without a value.

    Quantities that lack the same inputs share the shortest of their reasons, which may leave out alternative inputs.
    """
    explanations = {name: explanation_of(name, error) for name, error in errors.items()}
    groups: dict[object, list[str]] = {}
    for name, error in errors.items():
        missing = error.missing if isinstance(error, MissingInput) else ()
        groups.setdefault(missing or explanations[name], []).append(name)
    for names in groups.values():
        shortest = min(names, key=lambda name: len(explanations[name]))
        error = errors[shortest]
        if names[1:] and isinstance(error, MissingInput):
            yield names, error.explanation("need")
        else:
            yield names, explanations[shortest]


# --- Arguments without a result ---------------------------------------------------------------------------------------

Given = Mapping[str, Any]  # the arguments of a formula


def _pull_off_dmt(given: Given) -> Any:
    return -pull_off_force_dmt(work_of_adhesion=given["work_of_adhesion"], reduced_radius=given["reduced_radius"])


def _pull_off_sphere(given: Given) -> Any:
    return -pull_off_force_sphere(
        artanh_at_pull_off=given["artanh_at_pull_off"], elastoadhesive_ratio=given["elastoadhesive_ratio"],
        indenter_radius=given["indenter_radius"], contact_modulus=given["contact_modulus"],
    )  # fmt: skip


def _fold_sphere(given: Given) -> Any:
    return approach_at_fold_sphere(
        artanh_at_fold=given["artanh_at_fold"], elastoadhesive_ratio=given["elastoadhesive_ratio"],
        indenter_radius=given["indenter_radius"],
    )  # fmt: skip


Rule = tuple[Cause, Callable[[Given], Any]]

# Only grips hold a contact between pull-off and the fold; there, its stiffness or its load margin is negative.
_NOT_HELD: Rule = (NOT_HELD, lambda given: (given.get("stiffness", 0) < 0) | (given.get("load_margin", 0) < 0))
_PARTED: Rule = (BEYOND_FOLD, lambda given: approach_at_fold(approach=given["approach"]))

# By formula: the cause, and a function of the arguments that returns the limit of the quantity that the cause names. If
# the cause names no quantity, the function returns whether the cause applies.
RULES: Mapping[str, Rule] = {
    "load_margin": (BEYOND_PULL_OFF, lambda given: -given["pull_off_force"]),
    "edge_ratio_at_load": (BEYOND_PULL_OFF, lambda given: -given["pull_off_force_maugis"]),
    "contact_radius_dmt": (BEYOND_PULL_OFF, _pull_off_dmt),
    "adhesive_force_dmt": (BEYOND_PULL_OFF, _pull_off_dmt),
    "load_factor_at_approach": _PARTED,
    "load_margin_at_approach": _PARTED,
    "edge_ratio_at_approach": (BEYOND_FOLD, itemgetter("fold_approach_maugis")),
    "contact_radius_dmt_at_approach": (BEYOND_FOLD, lambda _: 0.0),
    "yield_displacement_at_hysteresis": (TOO_MUCH_HYSTERESIS, itemgetter("work_of_adhesion")),
    "sticking_speed_viscous": (STICKS_ALWAYS, lambda _: FITTED_UP_TO),
    "yield_speed": (YIELDS_ON_TOUCH, itemgetter("touch_pressure")),
    "plastic_speed": (PLASTIC_ON_TOUCH, itemgetter("touch_pressure")),
    "kelvin_radius": (DRY_OR_SATURATED, lambda given: (given["humidity"] <= 0) | (given["humidity"] >= 1)),
    "meniscus_size": (NO_WETTING, lambda given: given["contact_angle"] >= pi / 2),
    "threshold_humidity": (NO_WETTING, lambda given: given["contact_angle"] >= pi / 2),
    "meniscus_force": (WIDE_MENISCUS, lambda _: WIDEST),
    "artanh_at_load": (BEYOND_PULL_OFF, _pull_off_sphere),
    "artanh_at_approach": (BEYOND_FOLD, _fold_sphere),
    "indenter_radius": (NO_PROFILE, lambda _: True),
    "r_min": (NO_CHAIN, lambda given: given["radius2"] == INFINITY),
    "vertical_frequency": _NOT_HELD,
    "peeling_force": _NOT_HELD,
    "peeling_radius": _NOT_HELD,
    "rolling_resistance_coefficient": (NOT_PRESSED, lambda given: given["load"] <= 0),
    "viscosity_number": (NO_POISSON_RATIO, lambda given: given["poisson_ratio"] * given["poisson_ratio2"] <= 0),
    "rayleigh_time": (RIGID, lambda given: given["youngs_modulus"] == INFINITY),
    "contact_displacement_maugis": (APART, lambda given: given["edge_ratio"] == 0),
}


def reason_for(step: str, given: Given) -> Any:
    """Return the reasons why a step has no result for its arguments, as an integer or an array."""
    no_double = reason(NO_DOUBLE, step)
    if step not in RULES:
        return no_double
    cause, rule = RULES[step]
    applies = cause.is_beyond(given[cause.name], rule(given)) if cause.name else rule(given)
    return where(applies, reason(cause, step), no_double)


def failure_of(number: int, given: Given) -> Failure:
    """Return the error for a reason, with the numbers from the arguments of its step."""
    cause, step = cause_and_step(number)
    assert cause is not None
    if not cause.name:
        return Failure(cause, step)
    _, limit_of = RULES[step]
    return Failure(cause, step, (given[cause.name], limit_of(given)))
