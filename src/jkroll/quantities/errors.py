"""Errors about the values of quantities."""

from collections.abc import Collection, Sequence

from ..errors import JkrollError
from ..text import closest, listed, quoted
from .nomenclature import NOMENCLATURE, OPTION_WORDS, with_symbol
from .units import dimension_of, kind_of


class QuantityError(JkrollError):
    """Error raised when a text is not a value of the quantity that it was given for."""

    def __init__(self, name: str, text: str, reason: str, remedy: str = "") -> None:
        """`reason` follows the quoted text; `remedy` says what to type instead, by default an example of the quantity."""
        super().__init__(name, text, reason, remedy)
        self.name, self.text, self.reason, self.remedy = name, text, reason, remedy
        self.phrase = f"bad {name}"

    def problem(self) -> str:
        """Return what is wrong and what to type instead, without the name and the text."""
        return f"{self.reason}; {self.remedy or f'expected {expectation(self.name)}'}"

    def __str__(self) -> str:
        return f"{self.name}: {quoted(self.text)} {self.problem()}"


class BareNumber(QuantityError):
    """Error raised when a number has no unit where one is needed."""


class UnknownQuantity(JkrollError):
    """Error raised for a word that does not stand for one quantity."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.name = name

    def __str__(self) -> str:
        if self.name in NOMENCLATURE:
            return f"{quoted(self.name)} stands for a word, not a number; jkroll quantities lists the quantities"
        if several := with_symbol(self.name):
            return f"{quoted(self.name)} is the symbol of {listed(several)}; write the name that is meant"
        guess = nearest(self.name)
        meant = f"did you mean {guess}? " if guess else ""
        return f"{quoted(self.name)} is not a quantity; {meant}jkroll quantities lists them"


# Words of others, and the quantity that they are likely to mean.
QUANTITY_SYNONYMS = {
    "adhesion": "pull_off_force",
    "adhesion_force": "pull_off_force",
    "cohesion": "work_of_adhesion",
    "critical_angle": "yield_angle",
    "critical_displacement": "yield_displacement",
    "critical_rolling_angle": "yield_angle",
    "critical_rolling_displacement": "yield_displacement",
    "diameter": "radius",
    "elastic_modulus": "youngs_modulus",
    "elasticity": "youngs_modulus",
    "f": "pull_off_force",
    "f_ad": "pull_off_force",
    "force": "pull_off_force",
    "fragmentation_speed": "disruption_speed",
    "fragmentation_velocity": "disruption_speed",
    "fragmentation": "disruption_speed",
    "friction": "yield_force",
    "friction_force": "sliding_force",
    "impact_speed": "speed",
    "impact_velocity": "speed",
    "indentation": "approach_at_load",
    "modulus": "youngs_modulus",
    "overlap": "approach_at_load",
    "penetration": "approach_at_load",
    "porosity": "filling_factor",
    "rolling_energy": "roll_energy",
    "rolling_force": "yield_force",
    "rolling_friction": "yield_force",
    "rolling_friction_force": "yield_force",
    "rolling_resistance": "yield_moment",
    "rolling_torque": "yield_moment",
    "sliding_stiffness": "tangential_stiffness",
    "spring_constant": "stiffness",
    "static_friction": "sliding_force",
    "stickiness": "sticking_speed",
    "sticking_velocity": "sticking_speed",
    "surface_tension": "surface_energy",
    "torque": "yield_moment",
    "torsion": "twisting_moment",
    "torsional_stiffness": "twisting_stiffness",
    "v_frag": "disruption_speed",
    "velocity": "speed",
}


ALIKE = 0.65  # from here on, a word may be meant for another: "moment" for "yield_moment", but not "restitution" for "friction"


def nearest(word: str, names: Collection[str] = NOMENCLATURE) -> str | None:
    """Return the quantity among `names` that a word is likely to mean; None if there is none.

    It is the one with this symbol, with or without the index of sphere 1, the one that others call so, the one whose
    name begins with the word, or else the one whose name or option resembles it most.
    """
    meanings = {one: meant for one, meant in {**OPTION_WORDS, **QUANTITY_SYNONYMS}.items() if meant in names}
    meanings |= {name: name for name in names}
    name = word.strip().lstrip("-").replace("-", "_").replace(" ", "_").casefold()
    letters = name.replace("_", "")
    begun = (one for one in names if letters and one.replace("_", "").startswith(letters))
    meant = next(iter(with_symbol(word, names)), None) or meanings.get(name) or next(begun, None)
    return meant or meanings.get(closest(name, meanings, ALIKE) or "")


class OutOfRange(JkrollError):
    """Error raised when a number given to the core lies outside the range of its quantity."""

    def __init__(self, name: str, value: object, words: str, place: Sequence[int] = ()) -> None:
        """`place`: the index of the number in an array."""
        super().__init__(name, value, words, tuple(place))
        self.name, self.value, self.words, self.place, self.phrase = name, value, words, tuple(place), f"bad {name}"

    def __str__(self) -> str:
        where = f" at index {', '.join(map(str, self.place))}" if self.place else ""
        return f"{self.name}: {self.value!r}{where} {self.words}"


def expectation(name: str) -> str:
    """Return the kind of value that a quantity takes, with an example or with its unit.

    >>> expectation("radius2"), expectation("stiffness")
    ('a length such as 1um, or plane', 'a value in N/m')
    """
    quantity = NOMENCLATURE[name]
    if quantity.example:
        kind = f"{kind_of(dimension_of(quantity.unit))} such as {quantity.example}"
    elif quantity.unit == "1":
        kind = "a number"
    else:
        kind = f"a value in {quantity.unit}"
    return kind + (f", or {quantity.infinity}" if quantity.infinity else "")
