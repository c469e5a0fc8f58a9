"""Errors about a scene: inputs that are missing or exclude each other, and contacts that do not exist."""

from collections.abc import Sequence

from ..errors import JkrollError, NoResult
from ..quantities.formatting import Format, amount
from ..quantities.nomenclature import NOMENCLATURE


class MissingInput(JkrollError):
    """Error raised when a quantity cannot be computed from what was given."""

    def __init__(self, wanted: str, missing: Sequence[str], instead: Sequence[str] = (), lacking: str = "") -> None:
        super().__init__(wanted, tuple(missing), tuple(instead), lacking)
        self.wanted, self.missing, self.instead, self.lacking = wanted, tuple(missing), tuple(instead), lacking

    def __str__(self) -> str:
        return f"{self.wanted} {self.reason()}"

    def reason(self) -> str:
        """Return why there is no value, without the name of the quantity."""
        return f"needs {self.needs()}"

    def reason_of_several(self) -> str:
        """Return why several quantities have no value, without their names."""
        return f"need {self.needs()}"

    def needs(self) -> str:
        """Return the missing inputs, the materials that do not have them, and how they are given."""
        words = " and ".join(NOMENCLATURE[name].sentence for name in self.missing)
        options = " ".join(_as_typed(name) for name in self.missing if NOMENCLATURE[name].option)
        radii = [
            f"a radius such as {NOMENCLATURE[name].example}" for name in self.missing if not NOMENCLATURE[name].option
        ]
        give = " and ".join([options, *radii] if options else radii)
        instead = "".join(f" or {_as_typed(name)}" for name in self.instead)
        return f"{words}{self.lacking and '; ' + self.lacking}; give {give}{instead}"


class NotInLaw(MissingInput):
    """Error raised for a quantity that a law of attraction does not have."""

    def __init__(self, wanted: str, lacking: Sequence[str], law: str) -> None:
        JkrollError.__init__(self, wanted, tuple(lacking), law)
        self.wanted, self.missing, self.instead, self.lacking = wanted, (), (), ""
        self.absent, self.law = tuple(lacking), law

    def __str__(self) -> str:
        return f"{self.wanted}: {self.reason()}"

    def reason(self) -> str:
        """Return which quantity the law does not have: this one, or one that it follows from."""
        return self._of_the_law() or super().reason()

    def reason_of_several(self) -> str:
        """Return the same for several quantities."""
        return self._of_the_law() or super().reason_of_several()

    def _of_the_law(self) -> str:
        return f"not in {self.law}; give --model jkr" if self.absent == (self.wanted,) else ""

    def needs(self) -> str:
        """Return the quantity that the law does not have."""
        words = " and ".join(NOMENCLATURE[name].sentence for name in self.absent)
        return f"{words}, which {self.law} does not have; give --model jkr"


def _as_typed(name: str) -> str:
    return f"{NOMENCLATURE[name].option} {NOMENCLATURE[name].example}"


def _told_apart(name: str, value: float, limit: float) -> tuple[str, str]:
    """Return two values as results are shown, or with as many digits more as tell them apart."""
    for digits in (None, *range(7, 18)):
        form = Format(digits=digits)
        texts = amount(name, value, form), amount(name, limit, form)
        if texts[0] != texts[1]:
            break
    return texts


class Contradiction(JkrollError):
    """Error raised for inputs of which one follows from the other."""

    def __init__(self, names: Sequence[str]) -> None:
        super().__init__(tuple(names))
        self.names = tuple(names)

    def __str__(self) -> str:
        return f"{' and '.join(self.names)} exclude each other: one follows from the other"


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

    name = "load"

    def __init__(self, load: float, pull_off_force: float, by_maugis: float = 0.0) -> None:
        super().__init__(load, pull_off_force, by_maugis)
        self.load, self.pull_off_force, self.by_maugis = load, pull_off_force, by_maugis

    def reason(self) -> str:
        """Return which loads this contact holds."""
        load, held = _told_apart("load", self.load, -self.pull_off_force)
        text = f"{load} is beyond pull-off; this contact holds down to {held}"
        if not self.by_maugis:
            return text
        return f"{text}; by Maugis' law it holds down to {amount('load', -self.by_maugis)} (--model maugis)"


class BeyondFold(NoContact):
    """Error raised at an approach at which even fixed grips have let go."""

    name = "approach_at_load"

    def __init__(self, approach: float, least: float) -> None:
        super().__init__(approach, least)
        self.approach, self.least = approach, least

    def reason(self) -> str:
        """Return which approaches this contact holds."""
        approach, least = _told_apart("approach_at_load", self.approach, self.least)
        return f"{approach} is beyond the fold; fixed grips hold this contact down to {least}"


class TooMuchHysteresis(NoResult):
    """Error raised for an adhesion hysteresis above the work of adhesion."""

    name = "adhesion_hysteresis"

    def __init__(self, hysteresis: float, work: float) -> None:
        super().__init__(hysteresis, work)
        self.hysteresis, self.work = hysteresis, work

    def reason(self) -> str:
        """Return how large the hysteresis may be."""
        hysteresis, work = _told_apart("adhesion_hysteresis", self.hysteresis, self.work)
        return f"{hysteresis} is above the work of adhesion, {work}, of which it is a part"


class TwoRigidBodies(NoResult):
    """Error raised where both bodies are rigid: JKR's contact has no area then."""

    name = "contact_modulus"

    def reason(self) -> str:
        """Return what a contact area needs."""
        return "both bodies are rigid; a contact area needs one that yields"


class NoChain(NoResult):
    """Error raised for a chain that has a plane in it."""

    name = "r_min"

    def reason(self) -> str:
        """Return what a chain needs."""
        return "sphere 2 is a plane; a chain needs two spheres"


class NoVibration(NoResult):
    """Error raised between pull-off and the fold, where free spheres are not held together."""

    name = "vertical_frequency"

    def reason(self) -> str:
        """Return why nothing vibrates."""
        return "beyond pull-off only fixed grips hold the contact; free spheres fly apart"


class NoFiniteValue(NoResult):
    """Error raised for a result outside the range of doubles, or without limit."""

    def __init__(self, name: str, value: float) -> None:
        super().__init__(name, value)
        self.name, self.value = name, value

    def reason(self) -> str:
        """Return on which side of the range of doubles the result lies."""
        return "no finite value for these inputs" if abs(self.value) > 1 else "no value that a double can hold"


class NoUnstableState(NoResult):
    """Error raised for a load or an approach that has one state only, the stable one."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.name = name

    def reason(self) -> str:
        """Return where there is an unstable state."""
        return "only a tension, or an approach below 0, has a second, unstable state"


def reason_of(name: str, error: MissingInput | NoResult) -> str:
    """Return why a quantity has no value, without its name."""
    if isinstance(error, MissingInput) or error.name == name:
        return error.reason()
    return str(error)
