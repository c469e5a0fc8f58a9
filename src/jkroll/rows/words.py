"""The words of headers as data: those that mean an input, those that may mean one, and those that mean another quantity."""

import re
from collections.abc import Mapping, Sequence
from functools import cache
from typing import NamedTuple

from ..quantities.nomenclature import NOMENCLATURE, OPTION_WORDS
from ..quantities.units import SUPERSCRIPTS, dimension_of
from ..text import ascii_text

MATERIALS = ("material", "material2")
INPUTS = ("radius", *(name for name, quantity in NOMENCLATURE.items() if quantity.option and quantity.unit))
SYNONYMS: Mapping[str, Sequence[str]] = {
    "youngs_modulus": ("young modulus", "youngs", "elastic modulus", "elasticity modulus", "modulus of elasticity", "E modulus"),
    "poisson_ratio": ("poissons", "poissons ratio", "poisson number"),
    "contact_modulus": ("E_star", "reduced modulus", "reduced Young's modulus", "effective Young's modulus"),
    "reduced_radius": ("effective radius",),
    "surface_energy": ("surface free energy",),
    "hamaker": ("Hamaker constant",),
    "density": ("mass density",),
    "load": ("applied load", "normal load"),
    "speed": ("velocity", "impact velocity", "impact speed", "collision velocity", "collision speed"),
    "energy": ("impact energy", "collision energy"),
    "gravity": ("gravitational acceleration",),
}  # fmt: skip
SYMBOLS_TOO = {"E": "energy", "Er": "contact_modulus"}  # what symbols mean besides
RATIOS = ("poisson_ratio", "poisson_ratio2")  # the only ratios whose symbols have no other common meaning


class Doubt(NamedTuple):
    """The input that a word or a symbol may mean, and why it is not read."""

    name: str
    problem: str


SIZE = "a radius is half of a diameter or a size, and r may be a distance"
_SYMBOLS_OF_SIZES = ("r", "r1", "r2", "d", "d1", "d2", "D", "D1", "D2", "Ø")
_WORDS_OF_SIZES = ("diam", "dia", "diameter", "diameters", "durchmesser", "size")
DOUBTFUL = {
    **dict.fromkeys((*_SYMBOLS_OF_SIZES, *_WORDS_OF_SIZES), Doubt("radius", SIZE)),
    "surfacetension": Doubt("surface_energy", "it may be the tension of a liquid"),
    **dict.fromkeys(("modulus", "effectivemodulus"), Doubt("youngs_modulus", "it may be another modulus")),
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
    description quality flag status unit units method model formula cost price date color colour grade out ratio""".split()}  # fmt: skip
INDICES = ("in", "bar")  # in no brackets they may mean inside and mean
PARTS = {
    **dict.fromkeys("± +/- +- err error std stdev sd sem se unc uncertainty".split(), "both"),
    "minus": "minus",
    "plus": "plus",
    **dict.fromkeys("min low lower".split(), "low"),
    **dict.fromkeys("max high upper".split(), "high"),
}
COMMON_UNITS = """m cm mm um nm pm Pa kPa MPa GPa N mN uN nN pN J mJ aJ fJ zJ eV J/m2 mJ/m2 erg/cm2 N/m mN/m dyn/cm kg/m3
    g/cm3 g/cc m/s cm/s mm/s um/s km/s km/h m/s2 cm/s2""".split()
TWO_IN_SMALL = ("mn", "mj")  # milli or mega?

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
    """Return what words mean, by their keys: an input, with 1 or 2 for the sphere, or "" for a quantity that is none."""
    of_inputs = {**{name: name for name in (*INPUTS, *MATERIALS)}, **OPTION_WORDS}
    of_inputs |= {word: name for name, others in SYNONYMS.items() for word in others}
    found = {key(word): name for word, name in of_inputs.items() if name in INPUTS or name in MATERIALS}
    found |= {word: doubt.name for word, doubt in DOUBTFUL.items() if word not in _SYMBOLS_OF_SIZES}
    for word, name in [*found.items()]:
        if f"{name}2" in NOMENCLATURE:
            found |= {f"{word}1": name, f"{word}2": f"{name}2"}
    return {key(name): "" for name in NOMENCLATURE} | found


@cache
def symbols() -> dict[str, list[str]]:
    """Return the inputs by their symbols, with Greek letters spelt out, and with the index of sphere 1 or without it."""
    found: dict[str, list[str]] = {}
    for name in INPUTS:
        symbol = symbol_of(NOMENCLATURE[name].symbol)
        for spelt in dict.fromkeys((symbol, symbol.removesuffix("1"))):
            found.setdefault(spelt, []).append(name)
    for spelt, name in SYMBOLS_TOO.items():
        found.setdefault(spelt, []).append(name)
    for spelt, names in found.items():
        found[spelt] = [name for name in names if name in RATIOS or any(dimension_of(NOMENCLATURE[name].unit))]
    return found | {spelt: [DOUBTFUL[spelt].name] for spelt in _SYMBOLS_OF_SIZES}


@cache
def near() -> dict[str, str]:
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


@cache
def common_units() -> dict[str, str]:
    """Return common units by their letters and digits."""
    return {squeezed(unit): unit for unit in COMMON_UNITS} | {"Gpa": "GPa", "Mpa": "MPa", "Kpa": "kPa"}


@cache
def small_units() -> dict[str, str]:
    """Return common units by their letters and digits in small letters, or "" where these may be those of two."""
    return {letters.casefold(): unit for letters, unit in common_units().items()} | dict.fromkeys(TWO_IN_SMALL, "")


def squeezed(text: str) -> str:
    """Return the letters and digits of a unit.

    >>> squeezed("mJ.m-2"), squeezed("kg_per_m³")
    ('mJm2', 'kgm3')
    """
    plain = text.translate(SUPERSCRIPTS).replace("µ", "u").replace("μ", "u")
    return re.sub(r"[\W_]+|(?<![^\W_])per(?![^\W_])", "", plain)
