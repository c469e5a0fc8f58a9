"""Errors about the values and the names of quantities."""

from collections.abc import Collection, Sequence

from ..errors import JkrollError
from ..text import closest, listed, quoted
from .nomenclature import NOMENCLATURE, OPTION_WORDS, with_symbol
from .units import NO_UNIT, NO_UNIT_OF_BAR, dimension_of, kind_of


class QuantityError(JkrollError):
    """Error raised when a text or a number is not a value of the quantity that it was given for."""

    def __init__(self, name: str, value: object, reason: str, remedy: str = "", place: Sequence[int] = ()) -> None:
        """`reason` follows the value; `remedy` says what to type instead, by default an example of the quantity.

        `place`: the index of a number in an array.
        """
        super().__init__(name, value, reason, remedy, tuple(place))
        self.name, self.value, self.reason, self.remedy, self.place = name, value, reason, remedy, tuple(place)
        self.phrase = f"bad {name}"

    @property
    def is_bare(self) -> bool:
        """True for a number without a unit where one is needed."""
        return self.reason in (NO_UNIT, NO_UNIT_OF_BAR)

    def problem(self) -> str:
        """Return what is wrong and, of a text, what to type instead, without the name and the value."""
        remedy = self.remedy or (f"expected {expectation(self.name)}" if isinstance(self.value, str) else "")
        return f"{self.reason}; {remedy}" if remedy else self.reason

    def __str__(self) -> str:
        value = quoted(self.value) if isinstance(self.value, str) else repr(self.value)
        where = f" at index {', '.join(map(str, self.place))}" if self.place else ""
        return f"{self.name}: {value}{where} {self.problem()}"


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


# Words of others by the quantity that they mean. Behind ? stand those that are likely to mean it: no header is read by
# them.
_WORDS_OF_OTHERS = {
    "approach_at_load": "? indentation overlap penetration",
    "contact_modulus": "e_star reduced_modulus reduced_youngs_modulus effective_youngs_modulus",
    "density": "mass_density",
    "disruption_speed": "fragmentation_speed fragmentation_velocity fragmentation v_frag",
    "energy": "impact_energy collision_energy",
    "filling_factor": "? porosity",
    "gravity": "gravitational_acceleration",
    "hamaker": "hamaker_constant",
    "load": "applied_load normal_load",
    "poisson_ratio": "poissons poissons_ratio poisson_number",
    "pull_off_force": "? adhesion adhesion_force f f_ad force",
    "radius": "? diameter",
    "reduced_radius": "effective_radius",
    "roll_energy": "rolling_energy",
    "sliding_force": "friction_force static_friction",
    "speed": "velocity impact_velocity impact_speed collision_velocity collision_speed",
    "sticking_speed": "stickiness sticking_velocity",
    "stiffness": "spring_constant",
    "surface_energy": "surface_free_energy ? surface_tension",
    "tangential_stiffness": "sliding_stiffness",
    "twisting_moment": "torsion",
    "twisting_stiffness": "torsional_stiffness",
    "work_of_adhesion": "w_adh adhesion_work delta_gamma ? cohesion",
    "yield_angle": "critical_angle critical_rolling_angle",
    "yield_displacement": "critical_rolling_displacement rolling_displacement ? critical_displacement",
    "yield_force": "friction rolling_force rolling_friction rolling_friction_force",
    "yield_moment": "rolling_resistance rolling_torque torque",
    "youngs_modulus": "young_modulus youngs elastic_modulus elasticity_modulus modulus_of_elasticity e_modulus e_modul"
        " ? elasticity modulus",
}  # fmt: skip
SYNONYMS = {name: words.partition("?")[0].split() for name, words in _WORDS_OF_OTHERS.items()}
QUANTITY_SYNONYMS = {word: name for name, words in _WORDS_OF_OTHERS.items() for word in words.replace("?", "").split()}

# from here on, a word may be meant for another: "moment" for "yield_moment", but not "restitution" for "friction"
ALIKE = 0.65


def nearest(word: str, names: Collection[str] = NOMENCLATURE) -> str | None:
    """Return the quantity among `names` that a word is likely to mean; None if there is none.

    It is the one with this symbol, with or without the index of sphere 1, the one that others call so, the one whose
    name begins with the word, or else the one whose name or option resembles it most.
    """
    meanings = {term: meant for term, meant in {**OPTION_WORDS, **QUANTITY_SYNONYMS}.items() if meant in names}
    meanings |= {name: name for name in names}
    name = word.strip().lstrip("-").replace("-", "_").replace(" ", "_").casefold()
    letters = name.replace("_", "")
    begun = (each for each in names if letters and each.replace("_", "").startswith(letters))
    meant = next(iter(with_symbol(word, names)), None) or meanings.get(name) or next(begun, None)
    return meant or meanings.get(closest(name, meanings, ALIKE) or "")


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
