"""Units: their texts, read as exact multiples of SI units, and the conversion of SI values to other units.

A unit has at most eight names with integer powers. pint never sees a user's text: it is asked only for the meaning of
a single, validated name that is not in the table below. A name that the table shares with pint has the same meaning,
except kmph, which is km/h here. Names that mean different units in different versions of pint are defined in the table,
or refused.
"""

import re
from collections.abc import Collection, Sequence
from functools import cache, lru_cache
from math import gcd
from operator import add
from typing import Any

from ..text import closest, composed, quoted, shown

MAX_TEXT = 80
MAX_TERMS = 8
MAX_NAME = 24
MAX_POWER = 12
MAX_FACTOR = 10**100  # largest factor between a unit and the SI unit, so that doubles hold all results
SIMILAR = 0.5  # least similarity of a suggested unit

Dimension = tuple[int, ...]  # powers of BASE_UNITS
Unit = tuple[int, int, Dimension]  # numerator and denominator of a factor, and the powers of SI base units
Term = tuple[str, int]  # name and power
BASE_UNITS = ("kilogram", "meter", "second", "ampere", "kelvin", "mole", "candela", "radian")

# --- The table --------------------------------------------------------------------------------------------------------

NUMBER: Dimension = (0, 0, 0, 0, 0, 0, 0, 0)
_MASS, _LENGTH, _TIME = (1, 0, 0, 0, 0, 0, 0, 0), (0, 1, 0, 0, 0, 0, 0, 0), (0, 0, 1, 0, 0, 0, 0, 0)
_FORCE, _ENERGY, _PRESSURE = (1, 1, -2, 0, 0, 0, 0, 0), (1, 2, -2, 0, 0, 0, 0, 0), (1, -1, -2, 0, 0, 0, 0, 0)
_SPEED, _ANGLE = (0, 1, -1, 0, 0, 0, 0, 0), (0, 0, 0, 0, 0, 0, 0, 1)
_PI, _ONE = 31415926535897932384626433832795028841971693993751, 10**49  # π = _PI/_ONE

_SYMBOLS = "y z a f p n u m c d da h k M G T P E Z Y".split()
_WORDS = "yocto zepto atto femto pico nano micro milli centi deci deca hecto kilo mega giga tera peta exa zetta yotta"
_POWERS = (*range(-24, -3, 3), -3, -2, -1, 1, 2, *range(3, 25, 3))
PREFIXES = dict(zip(_SYMBOLS + _WORDS.split(), _POWERS * 2, strict=True))  # powers of ten


def _by_name(meanings: dict[str, Unit]) -> dict[str, Unit]:
    """Return the units by single names, from units by all their names, separated by blanks."""
    by_name: dict[str, Unit] = {}
    for names, meaning in meanings.items():
        by_name |= dict.fromkeys(names.split(), meaning)
    return by_name


# Units with or without a prefix
PREFIXABLE = _by_name({
    "m meter meters metre metres": (1, 1, _LENGTH),
    "g gram grams": (1, 1000, _MASS),
    "s sec second seconds": (1, 1, _TIME),
    "N newton newtons": (1, 1, _FORCE),
    "J joule joules": (1, 1, _ENERGY),
    "Pa pascal pascals": (1, 1, _PRESSURE),
    "Hz hertz": (1, 1, (0, 0, -1, 0, 0, 0, 0, 0)),
    "eV electron_volt electronvolt": (1602176634, 10**28, _ENERGY),
    "W watt watts": (1, 1, (1, 2, -3, 0, 0, 0, 0, 0)),
    "bar": (100000, 1, _PRESSURE),
    "dyn dyne dynes": (1, 100000, _FORCE),
    "erg ergs": (1, 10000000, _ENERGY),
    "rad radian radians": (1, 1, _ANGLE),
    "A ampere": (1, 1, (0, 0, 0, 1, 0, 0, 0, 0)),
    "K kelvin": (1, 1, (0, 0, 0, 0, 1, 0, 0, 0)),
    "V volt": (1, 1, (1, 2, -3, -1, 0, 0, 0, 0)),
    "Da": (166053906892, 10**38, _MASS),  # CODATA 2022, like the next two
    "Eh E_h": (43597447222060, 10**31, _ENERGY),
    "Ry": (21798723611030, 10**31, _ENERGY),
})  # fmt: skip
# Units that take no prefix
PLAIN = _by_name({
    "Å angstrom angstroms": (1, 10**10, _LENGTH),
    "micron microns": (1, 10**6, _LENGTH),
    "in inch inches": (254, 10**4, _LENGTH),
    "ft foot feet": (3048, 10**4, _LENGTH),
    "fathom fathoms": (18288, 10**4, _LENGTH),
    "furlong furlongs": (201168, 10**3, _LENGTH),
    "min minute minutes": (60, 1, _TIME),
    "h hr hour hours": (3600, 1, _TIME),
    "day days": (86400, 1, _TIME),
    "yr year years": (31557600, 1, _TIME),
    "deg degree degrees °": (_PI, 180 * _ONE, _ANGLE),
    "lb pound pounds": (45359237, 10**8, _MASS),
    "t tonne tonnes": (1000, 1, _MASS),
    "u amu dalton daltons": (166053906892, 10**38, _MASS),
    "bohr bohrs": (529177210544, 10**22, _LENGTH),
    "hartree hartrees": (43597447222060, 10**31, _ENERGY),
    "rydberg rydbergs": (21798723611030, 10**31, _ENERGY),
    "gf gram_force pond ponds": (980665, 10**8, _FORCE),
    "kgf kilogram_force kilopond kiloponds": (980665, 10**5, _FORCE),
    "lbf": (44482216152605, 10**13, _FORCE),
    "bars": (100000, 1, _PRESSURE),
    "psi": (44482216152605 * 10**8, 10**13 * 254**2, _PRESSURE),
    "atm": (101325, 1, _PRESSURE),
    "torr": (101325, 760, _PRESSURE),
    "mmHg": (133322387415, 10**9, _PRESSURE),
    "cmHg": (133322387415, 10**8, _PRESSURE),
    "Gal": (1, 100, (0, 1, -2, 0, 0, 0, 0, 0)),
    "standard_gravity": (980665, 10**5, (0, 1, -2, 0, 0, 0, 0, 0)),
    "percent %": (1, 100, NUMBER),
    "mph": (1609344, 3600000, _SPEED),
    "kph kmph kmh": (1000, 3600, _SPEED),
    "hbar": (662607015 * _ONE, 2 * 10**42 * _PI, (1, 2, -1, 0, 0, 0, 0, 0)),  # not hectobar
})  # fmt: skip

# --- Texts to units ---------------------------------------------------------------------------------------------------


class BadUnit(Exception):
    """Error raised for a text that is not a unit, or not a number with a unit.

    Its message is a phrase to follow the quoted text: "has no unit".
    """

    def __init__(self, words: str, instead: str = "", unknown: str = "") -> None:
        """`instead`: what to type instead, if known; `unknown`: the unit, if it is a single unknown name."""
        super().__init__(words)
        self._instead, self._unknown = instead, unknown

    def remedy(self, dimensions: Collection[Dimension]) -> str:
        """Return what to type instead, or a similar unit of one of these dimensions; empty if neither is known."""
        guess = similar_unit(self._unknown, frozenset(dimensions)) if self._unknown else None
        return f"did you mean {guess}?" if guess else self._instead


# Characters with the same meaning as a character of the grammar. All others outside the grammar are refused.
_SAME = str.maketrans(
    {"−": "-", "·": "*", "⋅": "*", "×": "*", "∕": "/", "⁄": "/", "μ": "u", "µ": "u"}
    | dict.fromkeys("\t\u00a0\u2009\u200a\u202f\u2002\u2003\u2007\u2008", " ")
)
RAISED = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺", "0123456789-+")
_OF_POWERS = "0123456789-+⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺"

_MICRO_INSIDE = r"[A-Za-zÅ][µμ]"  # mµm once meant the nanometre; as mum, it would be read as a micrometre


def normalized(text: str) -> str:
    """Return a text with uniform signs, spaces and letters; raise BadUnit for a long text or a µ inside a unit."""
    if len(text) > MAX_TEXT:
        raise BadUnit(f"is longer than {MAX_TEXT} characters")
    if ("µ" in text or "μ" in text) and re.search(_MICRO_INSIDE, text):
        raise BadUnit("has a µ that is not the first letter of a unit")
    return composed(text).strip().translate(_SAME)


@lru_cache(maxsize=1000)
def parse_unit(text: str) -> Unit:
    """Return the unit of a text: names with integer powers, joined by `*`, `/` or a space.

    >>> parse_unit("mJ/m2")
    (1, 1000, (1, 0, -2, 0, 0, 0, 0, 0))
    """
    return _product(_terms(normalized(text)))


def is_in_table(text: str) -> bool:
    """Return whether the table has all names of a unit, so that pint is not needed."""
    try:
        return all(_in_table(name) for name, _ in _terms(normalized(text)))
    except BadUnit:
        return False


def dimension_of(unit: str) -> Dimension:
    """Return the dimension of a unit; a number has the unit "1" or none."""
    return NUMBER if unit in ("1", "") else parse_unit(unit)[2]


def kind_of(dimension: Dimension) -> str:
    """Return the name of a dimension, with its article.

    >>> kind_of(dimension_of("N"))
    'a force'
    """
    return _kinds().get(dimension, "a quantity of another dimension")


@cache
def _kinds() -> dict[Dimension, str]:
    kinds = """1: a number; m: a length; kg: a mass; s: a time; K: a temperature; A: an electric current; rad: an angle;
    V: a voltage; m^2: an area; m^3: a volume; m^-1: a reciprocal length; m/s: a speed; m/s^2: an acceleration;
    rad/s: an angular speed; Hz: a frequency; kg/m^3: a mass density; kg m^2: a moment of inertia; N: a force;
    N m/rad: a moment per angle; J: an energy; W: a power; Pa: a pressure; J/m^2: a surface energy"""
    pairs = [pair.split(": ") for pair in kinds.split(";")]
    return {dimension_of(unit.strip()): kind for unit, kind in pairs}


def convert(value: float, unit: Unit) -> float:
    """Return an SI value in another unit, rounded once.

    >>> convert(0.25, parse_unit("mN"))
    250.0
    """
    numerator, denominator = value.as_integer_ratio()
    above, below, _ = unit
    return numerator * below / (denominator * above)


def power_of_ten(exponent: int) -> tuple[int, int]:
    """Return the numerator and the denominator of a power of ten.

    >>> power_of_ten(3), power_of_ten(-2)
    ((1000, 1), (1, 100))
    """
    return 10 ** max(exponent, 0), 10 ** max(-exponent, 0)


def exponent_of(unit: Unit) -> int | None:
    """Return the exponent of a unit that is a power of ten times the SI unit; None for any other unit.

    >>> exponent_of(parse_unit("nm")), exponent_of(parse_unit("ft"))
    (-9, None)
    """
    numerator, denominator, _ = unit
    common = gcd(numerator, denominator)
    above, below = str(numerator // common), str(denominator // common)
    if above.rstrip("0") == below.rstrip("0") == "1":
        return len(above) - len(below)
    return None


@lru_cache(maxsize=1000)  # many cells of a table may have the same mistake
def similar_unit(word: str, dimensions: frozenset[Dimension]) -> str | None:
    """Return the unit of one of these dimensions that a mistyped word probably means; None if no unit is similar.

    >>> similar_unit("Gpa", frozenset([dimension_of("Pa")])), similar_unit("Nm", frozenset([dimension_of("N m")]))
    ('GPa', 'N m')
    """
    for position in range(1, len(word)):  # two units written as one word, but not %%
        first, second = _in_table(word[:position]), _in_table(word[position:])
        if not first or not second or NUMBER in (first[2], second[2]):
            continue
        if tuple(map(add, first[2], second[2])) in dimensions:
            return f"{word[:position]} {word[position:]}"
    known = {**PREFIXABLE, **PLAIN}
    for unit, meaning in PREFIXABLE.items():
        for prefix in PREFIXES:
            if (len(prefix) > 2) == (len(unit) > 3):  # a prefix and a unit are both symbols or both words
                known[prefix + unit] = meaning
    fitting = [unit for unit, (_, _, dimension) in known.items() if dimension in dimensions]
    return closest(word, fitting, SIMILAR)


def _terms(text: str) -> list[Term]:
    """Return the names and powers in the text of a unit."""
    if text.isascii() and text.isalpha():  # most units are a single name
        return [(text, 1)]
    for mark in ("**", "^", "*", "/"):
        text = text.replace(f" {mark}", mark).replace(f"{mark} ", mark)
    above, slash, below = text.replace("**", "^").partition("/")
    if " " in below:
        before, _, after = below.partition(" ")
        before, after = shown(f"{above}/{before}"), shown(after)
        raise BadUnit(f"can be read as {before}*{after} or as {before}/{after}", "write the one that is meant")
    terms: list[Term] = []
    if above and not (above == "1" and slash):
        terms += map(_term, above.replace(" ", "*").split("*"))
    for divisor in below.split("/") if slash else ():
        (name, power), *others = map(_term, divisor.split("*"))
        terms += [(name, -power), *others]
    if len(terms) > MAX_TERMS or any(abs(power) > MAX_POWER for _, power in terms):
        raise BadUnit(f"has more than {MAX_TERMS} units or a power above {MAX_POWER}")
    return terms


def _term(text: str) -> Term:
    """Return a name and its power, which is 1 if not stated: m2, m^2, m²."""
    name = text.rstrip(_OF_POWERS).removesuffix("^")
    stated = text[len(name) :].removeprefix("^") if name != text else "1"
    power = stated.translate(SUPERSCRIPTS)
    is_name = name != "" and all((letter.isascii() and letter.isalpha()) or letter in "Å°%_" for letter in name)
    is_power = power.removeprefix("+" if power.startswith("+") else "-").isdigit() and int(power) != 0
    is_partly_raised = not stated.isascii() and not {*stated}.isdisjoint(power)  # as in m²3
    if not is_name or not is_power or is_partly_raised:
        raise BadUnit("is not a number and a unit")
    return name, int(power)


def _product(terms: Sequence[Term]) -> Unit:
    """Return the product of units to their powers."""
    numerator, denominator, dimension = 1, 1, NUMBER
    for name, power in terms:
        unit = _in_table(name) or lookup(name)
        if unit is None:
            is_whole = terms == [(name, 1)]
            raise BadUnit(f"has an unknown unit {quoted(name)}", unknown=name if is_whole else "")
        above, below, powers = unit
        up, down = (above, below) if power > 0 else (below, above)
        numerator, denominator = numerator * up ** abs(power), denominator * down ** abs(power)
        dimension = tuple(map(add, dimension, [power * exponent for exponent in powers]))
    if max(numerator, denominator) > MAX_FACTOR * min(numerator, denominator):
        raise BadUnit("has a unit outside 1e-100 to 1e100 times the SI unit")
    return numerator, denominator, dimension


def _in_table(name: str) -> Unit | None:
    """Return the meaning of a unit name in the table, with or without a prefix; None for an unknown name."""
    unit = PLAIN.get(name) or PREFIXABLE.get(name)
    if unit is not None:
        return unit
    for length in range(1, len(name)):
        exponent, unit = PREFIXES.get(name[:length]), PREFIXABLE.get(name[length:])
        if exponent is not None and unit is not None:
            numerator, denominator, dimension = unit
            above, below = power_of_ten(exponent)
            return numerator * above, denominator * below, dimension
    return None


# --- Names of pint ----------------------------------------------------------------------------------------------------

_DIGITS = 60
# pint's names of units that differ between its versions 0.24.4 and 0.26.2. The table has some of these units.
_UNLIKE = frozenset(
    """acre acre_foot angstrom_star apothecary_dram atomic_mass_constant atomic_unit_of_current
    atomic_unit_of_electric_field atomic_unit_of_force atomic_unit_of_intensity atomic_unit_of_temperature
    atomic_unit_of_time bohr bohr_magneton cables_length centimeter_Hg chain classical_electron_radius coulomb_constant
    dalton delta_degree_Reaumur dram electron_mass fathom fine_structure_constant force_gram force_kilogram furlong
    hartree impedance_of_free_space league link mercury meter_Hg mil neutron_mass nuclear_magneton planck_current
    proton_mass quarter rod rydberg rydberg_constant square_league square_rod thomson_cross_section
    unified_atomic_mass_unit unit_pole vacuum_permeability vacuum_permittivity x_unit_Cu x_unit_Mo""".split()
)
# Names that most people read in another way than pint, in which they are the astronomical unit, the grain, the short
# ton, units of surveyors and printers, and units named like objects, such as hand and point.
_OTHER_WORDS = frozenset(
    """au ch gr ton tons chain chains hand hands link links perch point points pole poles rod rods bp fur li pp rd sft
    smi th""".split()
)


@cache
def _registry() -> Any:
    """Return pint's default registry with decimals. It caches each factor with the precision of its first use."""
    from decimal import Decimal

    import pint

    return pint.UnitRegistry(non_int_type=Decimal)


@lru_cache(maxsize=1000)
def lookup(name: str) -> Unit | None:
    """Return pint's meaning of a unit name.

    Return None if the name is unknown, too long or excluded, or if its unit has no simple factor.

    Temperatures with an offset, logarithmic units and units that are no product of SI units (a bit) have no simple
    factor to an SI unit. Some meanings are excluded because nobody intends them: a prefix before a speed other than mps
    (kmph is not a kilo-mile per hour), the plural of a symbol (GPas is not a pressure), the yarn count Nm, the px of a
    screen, and words that most people read in another way. Units that depend on the version of pint are also excluded.
    >>> lookup("nm")
    (1, 1000000000, (0, 1, 0, 0, 0, 0, 0, 0))
    """
    if len(name) > MAX_NAME:
        return None
    from decimal import Decimal, localcontext

    with localcontext(prec=_DIGITS):
        exact = _registry()
        candidates = exact.parse_unit_name(name)
        if not candidates:
            return None
        prefix, unit_name, _ = candidates[0]
        symbol = exact.get_symbol(unit_name)
        is_plural_of_symbol = symbol != unit_name and name.endswith(symbol + "s")
        try:
            unit = exact.Unit(prefix + unit_name)
            zero = exact.Quantity(Decimal(0), unit).to_root_units()
            one = exact.Quantity(Decimal(1), unit).to_root_units()
        except Exception:  # logarithmic units fail in their own ways; none has a simple factor
            return None
        powers = {str(base): power for base, power in one.unit_items()}
        kilogram = powers.pop("gram", 0)
        dimension = (kilogram, *(powers.pop(base, 0) for base in BASE_UNITS[1:]))
        if powers or any(power != int(power) for power in dimension) or zero.magnitude != 0 or one.magnitude <= 0:
            return None
        is_misread = is_plural_of_symbol or unit_name in ("number_meter", "css_pixel") or name in _OTHER_WORDS
        if is_misread or unit_name in _UNLIKE or (prefix and dimension == _SPEED and unit_name != "meter_per_second"):
            return None
        factor = Decimal(one.magnitude).scaleb(-3 * int(kilogram))
    return *factor.as_integer_ratio(), tuple(int(power) for power in dimension)
