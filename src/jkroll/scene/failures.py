"""Errors about a scene: inputs that are missing or exclude each other, and contacts that do not exist.

Below: the numbers for which the physics gives a formula no result, with the error that says why.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from math import isinf
from typing import Any

from ..errors import JkrollError, NoResult
from ..physics.contact import pull_off_force_dmt
from ..physics.jkr import FOLD_APPROACH
from ..physics.viscous import LARGEST
from ..quantities.formatting import DIGITS, Format, amount
from ..quantities.laws import DEFAULT_LAW, law_of
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, PROPERTIES
from ..quantities.values import parse_quantity
from ..text import listed
from .wiring import parameters_of

MAX_DIGITS = 17  # that tell two doubles apart


class MissingInput(JkrollError):
    """Error raised when a quantity cannot be computed from what was given."""

    def __init__(self, wanted: str, missing: Sequence[str], instead: Sequence[str] = (), lacking: str = "") -> None:
        super().__init__(wanted, tuple(missing), tuple(instead), lacking)
        self.wanted, self.missing, self.instead, self.lacking = wanted, tuple(missing), tuple(instead), lacking
        self.phrase = needs_in_words(self.missing)

    def __str__(self) -> str:
        return f"{NOMENCLATURE[self.wanted].sentence} {self.reason()}"

    def reason(self) -> str:
        """Return why there is no value, without the name of the quantity."""
        return f"needs {self.needs()}"

    def reason_of_several(self) -> str:
        """Return why several quantities have no value, without their names."""
        return f"need {self.needs()}"

    def needs(self) -> str:
        """Return the missing inputs, the materials that do not have them, and how they are given."""
        words = listed(NOMENCLATURE[name].sentence for name in self.missing)
        options = " ".join(_as_typed(name) for name in self.missing if NOMENCLATURE[name].option)
        radii = [
            f"a radius such as {NOMENCLATURE[name].example}" for name in self.missing if not NOMENCLATURE[name].option
        ]
        give = listed([options, *radii] if options else radii)
        others = " or ".join(map(_as_typed, self.instead))
        instead = others and (f" or {others}" if len(self.missing) == 1 else f"; {others} may replace some")
        if self.lacking:
            return f"{words}; {self.lacking}; give, for example, {give}{instead}"
        name_one = "name a material, such as quartz, or " if {*self.missing} <= {*PROPERTIES} else ""
        return f"{words}; {name_one}give {give}{instead}"


def needs_in_words(missing: Iterable[str]) -> str:
    """Return which inputs are missing, by their names; an empty text if none is."""
    names = [*missing]
    return f"needs {listed(names)}" if names else ""


class NotInLaw(MissingInput):
    """Error raised for a quantity that a law of attraction does not have."""

    missing: tuple[str, ...] = ()
    instead: tuple[str, ...] = ()
    lacking = ""

    def __init__(self, wanted: str, absent: Sequence[str], law: str) -> None:
        JkrollError.__init__(self, wanted, tuple(absent), law)
        self.wanted, self.absent, self.law = wanted, tuple(absent), law
        self.phrase = f"not in {law}"

    def __str__(self) -> str:
        return f"{self.wanted}: {self.reason()}"

    def reason(self) -> str:
        """Return which quantity the law does not have: this one, or one that it follows from."""
        return self._of_the_law() or super().reason()

    def reason_of_several(self) -> str:
        """Return the same for several quantities."""
        return self._of_the_law() or super().reason_of_several()

    def _of_the_law(self) -> str:
        return f"not in {self.law}; give --model {self._giver}" if self.absent == (self.wanted,) else ""

    @property
    def _giver(self) -> str:
        """The law that has it."""
        return law_of(self.absent[0]) or DEFAULT_LAW

    def needs(self) -> str:
        """Return the quantity that the law does not have."""
        words = listed(NOMENCLATURE[name].sentence for name in self.absent)
        return f"{words}, which {self.law} does not have; give --model {self._giver}"


def _as_typed(name: str) -> str:
    return f"{NOMENCLATURE[name].option} {NOMENCLATURE[name].example}"


def _told_apart(name: str, value: float, limit: float) -> tuple[str, str]:
    """Return two values as results are shown, or with as many digits more as tell them apart."""
    texts = amount(name, value), amount(name, limit)
    digits = DIGITS
    while texts[0] == texts[1] and digits < MAX_DIGITS:
        digits += 1
        form = Format(digits=digits)
        texts = amount(name, value, form), amount(name, limit, form)
    return texts


def _held(name: str, least: float) -> str:
    """Return the least value that a contact holds as it may be typed: with so many digits that rounding does not put it beyond."""
    digits, text = DIGITS, amount(name, least)
    while parse_quantity(text, name) < least and digits < MAX_DIGITS:
        digits += 1
        text = amount(name, least, Format(digits=digits))
    return text


class Contradiction(JkrollError):
    """Error raised for inputs of which one follows from the other."""

    def __init__(self, names: Sequence[str]) -> None:
        super().__init__(tuple(names))
        self.names = tuple(names)

    def __str__(self) -> str:
        return f"{listed(self.names)} exclude each other: one follows from the other"


class GivenTwice(Contradiction):
    """Error raised for words that all stand for one quantity."""

    def __str__(self) -> str:
        return f"{listed(self.names)} are one quantity; give it once"


class ShapeMismatch(JkrollError):
    """Error raised for arrays that do not broadcast."""

    def __init__(self, shapes: Sequence[tuple[str, tuple[int, ...]]]) -> None:
        super().__init__(tuple(shapes))
        self.shapes = tuple(shapes)

    def __str__(self) -> str:
        return "these arrays do not broadcast: " + ", ".join(f"{name} {shape}" for name, shape in self.shapes)


class NoContact(NoResult):
    """Base class of the errors of a contact that does not exist: nothing of the scene is to be trusted."""


class BeyondPullOff(NoContact):
    """Error raised at a tension larger than the pull-off force, where there is no contact."""

    phrase = "beyond pull-off"
    name = "load"

    def __init__(self, load: float, least: float, by_maugis: float = 0.0) -> None:
        super().__init__(load, least, by_maugis)
        self.load, self.least, self.by_maugis = load, least, by_maugis

    def reason(self) -> str:
        """Return which loads this contact holds."""
        load, _ = _told_apart("load", self.load, self.least)
        text = f"{load} breaks this contact, which holds a pull down to {_held('load', self.least)}"
        if not self.by_maugis:
            return text
        return f"{text} ({_held('load', self.by_maugis)} by Maugis' law: --model maugis)"


class BeyondFold(NoContact):
    """Error raised at an approach at which even fixed grips have let go."""

    phrase = "beyond the fold"
    name = "approach_at_load"

    def __init__(self, approach: float, least: float) -> None:
        super().__init__(approach, least)
        self.approach, self.least = approach, least

    def reason(self) -> str:
        """Return which approaches this contact holds."""
        approach, _ = _told_apart("approach_at_load", self.approach, self.least)
        least = _held("approach_at_load", self.least)
        return f"at {approach} the spheres have parted; the farthest that a stiff machine holds them is {least}"


class TooMuchHysteresis(NoResult):
    """Error raised for an adhesion hysteresis above the work of adhesion."""

    phrase = "hysteresis above work of adhesion"
    name = "adhesion_hysteresis"

    def __init__(self, hysteresis: float, work: float) -> None:
        super().__init__(hysteresis, work)
        self.hysteresis, self.work = hysteresis, work

    def reason(self) -> str:
        """Return how large the hysteresis may be."""
        hysteresis, work = _told_apart("adhesion_hysteresis", self.hysteresis, self.work)
        return f"{hysteresis} is above the work of adhesion, {work}, of which it is a part"


class SticksAlways(NoResult):
    """Error raised for a viscous damping so strong that spheres stick at every speed, or next to it."""

    phrase = "sticks at every speed"
    name = "viscosity_number"

    def __init__(self, number: float) -> None:
        super().__init__(number)
        self.number = number

    def reason(self) -> str:
        """Return the viscosity number, and up to which one there is a sticking speed."""
        return f"T* = {self.number:.4g} is above {LARGEST:g}: they stick at every speed that this damping can mean"


class InFixedWords(NoResult):
    """Base class of the errors whose words hold no numbers."""

    words = ""

    def __init__(self, name: str = "") -> None:
        """`name`: the quantity that has no value, unless it is always the same or none in particular."""
        super().__init__(name)
        self.name = name or self.name

    def reason(self) -> str:
        """Return the words of this kind."""
        return self.words


class TwoRigidBodies(InFixedWords):
    """Error raised where both bodies are rigid: JKR's contact has no area then."""

    phrase = "both bodies are rigid"
    words = "both bodies are rigid; a contact area needs one that deforms"


class RestsOnSpacing(InFixedWords):
    """Error raised for a quantity that the atomic spacing decides on, where it was not given."""

    phrase = "needs atomic_spacing"
    words = "rests on {0.symbol}; give {0.option} {0.example}".format(NOMENCLATURE["atomic_spacing"])


class NoChain(InFixedWords):
    """Error raised for a chain that has a plane in it."""

    phrase = "sphere 2 is a plane"
    words = "sphere 2 is a plane; a chain needs two spheres"
    name = "r_min"


class OfIdenticalSpheres(InFixedWords):
    """Error raised where all that is asked for is known of identical spheres only, and sphere 2 differs."""

    phrase = "sphere 2 differs"
    words = "sphere 2 differs from sphere 1; this is known of identical spheres only"


class NotHeld(InFixedWords):
    """Error raised for what only spheres have that hold together by themselves, between pull-off and the fold."""

    phrase = "held by grips alone"
    words = "beyond pull-off only fixed grips hold the contact; free spheres fly apart"


class NotPressed(InFixedWords):
    """Error raised for a coefficient by which the load is multiplied, of a contact that no load presses."""

    phrase = "no load that presses"
    words = "needs a load that presses the spheres; give --load 5nN"
    name = "rolling_resistance_coefficient"


class NoPoissonRatio(InFixedWords):
    """Error raised for a viscous damping over ν1ν2 where that is not positive."""

    phrase = "Poisson's ratio not positive"
    words = "the damping goes as 1/(ν1ν2), which needs Poisson's ratios other than 0 and of one sign"
    name = "viscosity_number"


class Apart(InFixedWords):
    """Error raised for what only a contact circle has, where spheres attract without touching."""

    phrase = "no contact circle"
    words = "the spheres are bound without touching; there is no contact circle"
    name = "contact_displacement"


class NoFiniteValue(NoResult):
    """Error raised for a result outside the range of doubles, or without limit."""

    phrase = "no finite value"

    def __init__(self, name: str, value: float) -> None:
        super().__init__(name, value)
        self.name, self.value = name, value

    def reason(self) -> str:
        """Return on which side of the range of doubles the result lies."""
        return "no finite value for these inputs" if abs(self.value) > 1 else "no value that a double can hold"


class InfiniteValue(InFixedWords):
    """Error raised where a number is to be written and the value is infinite, such as the mass of a plane."""

    phrase = words = "infinite"


NO_END = "no uncertainty, as there is no value at an end of an input: "  # the lead of its reason


class NoUncertainty(NoResult):
    """Error raised for a value whose uncertainty is wanted, and which has none."""

    phrase = "no error bar"

    def __init__(self, name: str, error: JkrollError) -> None:
        super().__init__(name, error)
        self.name, self.error = name, error

    def reason(self) -> str:
        """Return why there is no uncertainty."""
        return NO_END + reason_of(self.name, self.error)


def written_outcome(name: str, outcome: Any) -> Any:
    """Return the outcome of a quantity for a reader of numbers: an infinite value is an InfiniteValue."""
    return InfiniteValue(name) if isinstance(outcome, float) and isinf(outcome) else outcome


def reason_of(name: str, error: JkrollError) -> str:
    """Return why a quantity has no value, without its name."""
    if isinstance(error, MissingInput) or (isinstance(error, NoResult) and error.name == name):
        return error.reason()
    return str(error)


def grouped(errors: Mapping[str, JkrollError]) -> Iterator[tuple[list[str], str]]:
    """Iterate over the quantities that have no value for one reason, and the reason.

    Those that lack the same inputs have one, in the shortest words, though some may be had in another way too.
    """
    reasons = {name: reason_of(name, error) for name, error in errors.items()}
    groups: dict[object, list[str]] = {}
    for name, error in errors.items():
        lacked = error.missing if isinstance(error, MissingInput) else ()
        groups.setdefault(lacked or reasons[name], []).append(name)
    for names in groups.values():
        shortest = min(names, key=lambda name: len(reasons[name]))
        error = errors[shortest]
        yield names, error.reason_of_several() if names[1:] and isinstance(error, MissingInput) else reasons[shortest]


# --- Numbers for which the physics has no result ----------------------------------------------------------------------


def _is_held_by_grips_alone(given: Mapping[str, Any]) -> bool:
    """Return whether a state lies between pull-off and the fold, by its stiffness or by its distance from pull-off."""
    return bool(given.get("stiffness", 0) < 0 or given.get("load_margin", 0) < 0)


def _evaluated(formula: Any, given: Mapping[str, Any]) -> Any:
    """Return the result of a formula whose arguments are among those of another."""
    return formula(**{name: given[name] for name in parameters_of(formula)})


def _of_approach(given: Mapping[str, Any]) -> Any:
    return FOLD_APPROACH * given["approach"]


# The formulas that have a result for a contact only: what it holds, from their arguments.
_LEAST_LOAD: Mapping[str, Callable[[Mapping[str, Any]], Any]] = {
    "load_margin": lambda given: -given["pull_off_force"],
    "edge_ratio_at_load": lambda given: -given["pull_off_force_maugis"],
    "contact_radius_dmt": lambda given: -_evaluated(pull_off_force_dmt, given),
    "adhesive_force_dmt": lambda given: -_evaluated(pull_off_force_dmt, given),
}
_LEAST_APPROACH: Mapping[str, Callable[[Mapping[str, Any]], Any]] = {
    "load_factor_at_approach": _of_approach,
    "load_margin_at_approach": _of_approach,
    "edge_ratio_at_approach": lambda given: given["fold_approach_maugis"],
    "contact_radius_dmt_at_approach": lambda _: 0.0,
}


def failure_of(step: str, given: Mapping[str, Any]) -> NoResult | None:
    """Return why a formula has no result for these numbers, if the physics forbids it.

    The least load or approach itself is one without a contact where rounding puts it beyond the end.
    """
    if step in _LEAST_LOAD and given["load"] <= (least := _LEAST_LOAD[step](given)):
        return BeyondPullOff(given["load"], least)
    if step in _LEAST_APPROACH and given["approach_at_load"] <= (least := _LEAST_APPROACH[step](given)):
        return BeyondFold(given["approach_at_load"], least)
    found: NoResult | None = None
    match step:
        case "r_min" if given["radius2"] == INFINITY:
            found = NoChain()
        case "vertical_frequency" | "peeling_force" | "peeling_radius" if _is_held_by_grips_alone(given):
            found = NotHeld(step)
        case "rolling_resistance_coefficient" if given["load"] <= 0:
            found = NotPressed()
        case "viscosity_number" if given["poisson_ratio"] * given["poisson_ratio2"] <= 0:
            found = NoPoissonRatio()
        case "sticking_speed_viscous" if given["viscosity_number"] > LARGEST:
            found = SticksAlways(given["viscosity_number"])
        case "contact_displacement" if given["edge_ratio"] == 0:
            found = Apart()
        case "yield_displacement_at_hysteresis" if given["adhesion_hysteresis"] > given["work_of_adhesion"]:
            found = TooMuchHysteresis(given["adhesion_hysteresis"], given["work_of_adhesion"])
    return found
