"""The words of headers as data: those that mean an input, those that may mean one, those that mean something else."""

import re
from collections.abc import Mapping, Sequence
from functools import cache
from typing import NamedTuple

from ..quantities.nomenclature import NOMENCLATURE, OPTION_WORDS
from ..quantities.units import SUPERSCRIPTS, BadUnit, dimension_of, is_in_table, parse_unit
from ..text import ascii_text

MATERIALS = ("material", "material2")
INPUTS = ("radius", *(name for name, quantity in NOMENCLATURE.items() if quantity.option and quantity.unit))
SYNONYMS: Mapping[str, Sequence[str]] = {
    "youngs_modulus": ("young modulus", "youngs", "elastic modulus", "elasticity modulus", "modulus of elasticity",
        "E modulus"),
    "poisson_ratio": ("poissons", "poissons ratio", "poisson number"),
    "contact_modulus": ("E_star", "reduced modulus", "reduced Young's modulus", "effective Young's modulus"),
    "reduced_radius": ("effective radius",),
    "surface_energy": ("surface free energy",),
    "work_of_adhesion": ("W_adh", "adhesion work", "delta gamma"),
    "yield_displacement": ("critical rolling displacement", "rolling displacement"),
    "hamaker": ("Hamaker constant",),
    "density": ("mass density",),
    "load": ("applied load", "normal load"),
    "speed": ("velocity", "impact velocity", "impact speed", "collision velocity", "collision speed"),
    "energy": ("impact energy", "collision energy"),
    "gravity": ("gravitational acceleration",),
}  # fmt: skip
SYMBOLS_TOO = {
    "E": "energy",
    "Er": "contact_modulus",
    "W": "work_of_adhesion",
    "SFE": "surface_energy",
}  # what symbols mean besides
RATIOS = ("poisson_ratio", "poisson_ratio2")  # the only ratios whose symbols have no other common meaning


class Doubt(NamedTuple):
    """The input that a word or a symbol may mean, why it is not read, and the names that it may stand for."""

    name: str = ""
    problem: str = ""
    meant: tuple[str, ...] = ()


SIZE = "a radius is half of a diameter or a size, and r may be a distance"
_FORCE = Doubt("load", "it may be a load, or a force that was measured", ("load",))
_DOUBTS = {
    **dict.fromkeys("r d D diam dia diameter diameters durchmesser size".split(), Doubt("radius", SIZE)),
    "R": Doubt("radius", "", ("radius", "reduced_radius")),  # which of them, sphere 2 says
    "surfacetension": Doubt("surface_energy", "it may be the tension of a liquid", ("surface_energy",)),
    "modulus": Doubt("youngs_modulus", "it may be another modulus", ("youngs_modulus",)),
    "effectivemodulus": Doubt("youngs_modulus", "it may be another modulus", ("youngs_modulus",)),
    **dict.fromkeys(("normalforce", "appliedforce", "preload", "Fn", "FN"), _FORCE),
    "adhesionenergy": Doubt("work_of_adhesion", "it may be that of a pair", ("work_of_adhesion", "surface_energy")),
    "hysteresis": Doubt("adhesion_hysteresis", "it may be another hysteresis", ("adhesion_hysteresis",)),
}
DOUBTFUL = _DOUBTS | {
    f"{word}{sphere}": doubt._replace(
        name=doubt.name + sphere.strip("1"), meant=tuple(name + sphere.strip("1") for name in doubt.meant)
    )
    for word, doubt in _DOUBTS.items()
    if f"{doubt.name}2" in NOMENCLATURE and word != "R"
    for sphere in ("1", "2")
}

# Words that other quantities share, as in speed of sound and contact angle: they are inputs alone or with a unit.
SHARED = (
    *"energy speed velocity angle approach contacts monomers gravity cutoff xi z0 modulus surfacetension".split(),
)
# Beside a word they make it another quantity.
OTHERS = {*"atomic ionic covalent metallic vdw bohr gyration current dislocation yield failure ultimate".split()}
# Behind a word they make it a label or a count: material_id, load case.
LABELS = {*"""id ids no nr num number name names type types class classes case cases code codes key group category kind
    family label tag index step count counts cell rank source ref reference url doi note notes comment comments desc
    description quality flag status unit units method model formula cost price date color colour grade out
    ratio""".split()}  # fmt: skip
INDICES = ("in", "bar")  # in no brackets they may mean inside and mean
PARTS = {
    **dict.fromkeys("± +/- +- err error std stdev sd sem se unc uncertainty".split(), "both"),
    "minus": "minus",
    "plus": "plus",
    **dict.fromkeys("min low lower".split(), "low"),
    **dict.fromkeys("max high upper".split(), "high"),
}

_WORD = re.compile(r"[^\W\d_][\w\s.'-]*")


def key(word: str) -> str:
    """Return the letters and digits of a word in small letters; "" for what is no word.

    >>> key("Young's modulus"), key("youngs_modulus"), key("γ"), key("2 gamma")
    ('youngsmodulus', 'youngsmodulus', 'gamma', '')
    """
    plain = word if word.isascii() else ascii_text(word)
    return re.sub(r"[\W_]+", "", plain).casefold() if _WORD.fullmatch(plain) else ""


def symbol_of(word: str) -> str:
    """Return a symbol with Greek letters spelt out; one that is spelt with a capital, such as Rho, is the same."""
    spelt = ascii_text(word).replace(" ", "").replace("_", "")
    return spelt.lower() if spelt.rstrip("12") in ("Gamma", "Nu", "Rho", "Xi", "Tau", "Theta") else spelt


@cache
def meanings() -> dict[str, str]:
    """Return what words mean, by their keys: an input, with 1 or 2 for the sphere, or "" for another quantity."""
    of_inputs = {**{name: name for name in (*INPUTS, *MATERIALS)}, **OPTION_WORDS}
    of_inputs |= {word: name for name, others in SYNONYMS.items() for word in others}
    known = {key(name): "" for name in NOMENCLATURE}
    for word, name in of_inputs.items():
        if name in INPUTS or name in MATERIALS:
            known[key(word)] = name
            if f"{name}2" in NOMENCLATURE:
                known |= {f"{key(word)}1": name, f"{key(word)}2": f"{name}2"}
    return known | {word: doubt.name for word, doubt in DOUBTFUL.items() if len(word) > 2}


@cache
def symbols() -> dict[str, list[str]]:
    """Return the inputs by their symbols, with Greek letters spelt out, with the index of sphere 1 or without it."""
    names: dict[str, list[str]] = {}
    for name in INPUTS:
        if name in RATIOS or any(dimension_of(NOMENCLATURE[name].unit)):
            symbol = symbol_of(NOMENCLATURE[name].symbol)
            for spelt in {symbol, symbol.removesuffix("1")}:
                names.setdefault(spelt, []).append(name)
    for spelt, name in SYMBOLS_TOO.items():
        names.setdefault(spelt, []).append(name)
    return names | {spelt: [doubt.name] for spelt, doubt in DOUBTFUL.items() if len(spelt) <= 2}


@cache
def slips() -> dict[str, str]:
    """Return the words of inputs by all spellings that lack one letter, or none.

    Two words differ by a slip of the pen, a letter or the order of two, if they have such a spelling in common.
    """
    known = [word for word, name in meanings().items() if name and len(word) > 3 and word not in DOUBTFUL]
    longest_first = sorted(known, key=len, reverse=True)  # so that gamma is not a slip in gamma2
    return {spelt: word for word in longest_first for spelt in lacking_a_letter(word)}


def lacking_a_letter(word: str) -> list[str]:
    """Return a word, and its spellings that lack one letter.

    >>> lacking_a_letter("load")
    ['load', 'oad', 'lad', 'lod', 'loa']
    """
    return [word, *(word[:place] + word[place + 1 :] for place in range(len(word)))]


# --- Units ------------------------------------------------------------------------------------------------------------

_COMMON = """m cm mm um nm pm Pa kPa MPa GPa N mN uN nN pN J mJ aJ fJ zJ eV J/m2 mJ/m2 erg/cm2 N/m mN/m dyn/cm kg/m3
    g/cm3 g/cc m/s cm/s mm/s um/s km/s km/h m/s2 cm/s2""".split()


@cache
def units_by_letters() -> dict[str, list[str]]:
    """Return common units by their letters and digits, as they are and in small letters."""
    units = {"Gpa": ["GPa"], "Mpa": ["MPa"], "Kpa": ["kPa"]}
    for unit in _COMMON:
        for letters in dict.fromkeys((squeezed(unit), squeezed(unit).casefold())):
            units.setdefault(letters, []).append(unit)
    return units | {"mn": [], "mj": []}  # milli or mega?


def squeezed(text: str) -> str:
    """Return the letters and digits of a unit.

    >>> squeezed("mJ.m-2"), squeezed("kg_per_m³")
    ('mJm2', 'kgm3')
    """
    plain = text.translate(SUPERSCRIPTS).replace("µ", "u").replace("μ", "u")
    return re.sub(r"[\W_]+|(?<![^\W_])per(?![^\W_])", "", plain)


def fits(unit_text: str, name: str) -> bool:
    """Return whether a text is a unit of a quantity; - and 1 are those of a ratio."""
    unit = NOMENCLATURE[name].unit
    if unit == "1" and unit_text in ("1", "-"):
        return True
    try:
        return bool(unit and unit_text) and parse_unit(unit_text).dimension == dimension_of(unit)
    except BadUnit:
        return False


def unit_for(text: str, name: str, *, is_explicit: bool = False) -> str:
    """Return the unit of a quantity that a text means, as it is or as programs write a common one; else "".

    What is in no brackets is looked for in the shipped table alone: to load pint takes as long as many rows. Programs
    change capitals there, so that MN may be mN.
    """
    letters, by_letters, is_known = squeezed(text), units_by_letters(), is_in_table(text)
    small = letters.casefold()
    is_clear = is_known and (letters in by_letters or small not in by_letters)
    units = [text] if is_explicit or is_clear or text in ("1", "-") else []
    if not (is_explicit and is_known):
        units += by_letters.get(letters, [])
        units += by_letters.get(small, []) if text.islower() or text.isupper() else []
    return next((unit for unit in units if fits(unit, name)), "")


def with_unit(name: str, unit_text: str = "UNIT") -> str:
    """Return the header of an input, with its unit, or the place of it, if it needs one."""
    return f"{name} [{unit_text}]" if name not in MATERIALS and any(dimension_of(NOMENCLATURE[name].unit)) else name
