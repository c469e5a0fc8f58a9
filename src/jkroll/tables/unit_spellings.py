"""The units of headers, in the spellings of other programs: without signs, in other capitals, or spelt out.

A spelling that values may have, too, belongs in `quantities.units` instead.
"""

import re
from collections.abc import Mapping
from functools import cache, partial

from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.units import PREFIXES, SUPERSCRIPTS, BadUnit, dimension_of, is_in_table
from ..quantities.values import unit_meant
from .words import NEUTRAL

_COMMON = """m cm mm um nm pm Pa kPa MPa GPa N mN uN nN pN J mJ aJ fJ zJ eV J/m2 mJ/m2 erg/cm2 N/m mN/m dyn/cm kg/m3
    g/cm3 g/cc g/mL kg/l N/mm2 kN/mm2 dyn/cm2 m/s cm/s mm/s um/s km/s km/h m/s2 cm/s2""".split()
# Rare units. A column with one of them may be an input, but not every spelling is read.
_RARE = """angstrom angstroms ang micron microns nanometer micrometer nanometre micrometre GN/m2 MN/m2 kN/m2 N/m2
    dyne/cm dyne/cm2 psi gigapascal megapascal joule nJ pJ keV meV erg newton nanonewton dyn dyne nanoN kg/dm3 t/m3
    kg/cum m/sec mps us ns ps sec mikrometer mikrometern mikron g/ccm gccm kg/cbm mJ/qm m/sek""".split()
_MEANT_BY = {
    "ang": "angstrom",
    **dict.fromkeys("mikrometer mikrometern mikron".split(), "um"),
    **dict.fromkeys("m/sec mps m/sek".split(), "m/s"),
    "nanoN": "nN",
    **dict.fromkeys("kg/cum kg/cbm".split(), "kg/m3"),
    **dict.fromkeys("g/ccm gccm".split(), "g/cm3"),
    "mJ/qm": "mJ/m2",
    "sec": "s",
}
# Units of technical systems, and units that lack a power, by the SI unit that they mean after the name of an input.
TECHNICAL_UNITS: Mapping[str, frozenset[str]] = {
    "Pa": frozenset("kg/mm2 kg/cm2 kg/m2 t/cm2 t/mm2 kgf/mm2 kgf/cm2 kp/mm2 kp/cm2".split()),
    "kg/m^3": frozenset("g/cm g/cm2 kg/m kg/m2".split()),
    "J": frozenset("kT kBT kbT k_BT k_B T".split()),
}


@cache
def units_by_letters() -> dict[str, list[str]]:
    """Return the common units by their letters and digits, as written and in lower case."""
    units = {"Gpa": ["GPa"], "Mpa": ["MPa"], "Kpa": ["kPa"], "mps": ["m/s"], "mum": ["um"]}
    for unit in _COMMON:
        letters = unit.replace("/", "")
        reciprocal = f"{letters}1" if "/" in unit and not letters[-1].isdigit() else letters  # m.s-1
        for spelt in {letters, letters.casefold(), reciprocal}:
            units.setdefault(spelt, []).append(unit)
    return units | {"mn": [], "mj": [], "pj": []}  # not units: they may be milli or mega, pico or peta


def squeezed(text: str) -> str:
    """Return the letters and digits of a unit. The sign of an uncertainty stays, since no unit has one.

    >>> squeezed("mJ.m-2"), squeezed("kg_per_m³")
    ('mJm2', 'kgm3')
    """
    plain = text.translate(SUPERSCRIPTS).replace("µ", "u").replace("μ", "u")
    return re.sub(r"(?<=\w)[\s./*^·⋅∙•(){}–−-]+|_+|(?<![^\W_])per(?![^\W_])", "", plain)


def fits(unit_text: str, name: str) -> bool:
    """Return whether a text is a unit of a quantity; - and 1 are units of a ratio."""
    unit = NOMENCLATURE[name].unit
    if unit == "1" and unit_text in ("1", "-"):
        return True
    if not unit or not unit_text:
        return False
    needed = dimension_of(unit)
    try:
        *_, dimension = unit_meant(unit_text, needed)
    except BadUnit:
        return False
    return dimension == needed


def unit_for(text: str, name: str, *, is_explicit: bool = False) -> str:
    """Return the unit of a quantity that a text means, also in the spellings of other programs; "" if it means none.

    `is_explicit`: True if brackets or another mark show that the text is a unit. Otherwise, only the shipped table is
    searched, since loading pint takes as long as reading many rows; and the text may differ from the unit in capitals,
    so MPA can mean MPa.
    """
    if text in _COMMON:
        return text if fits(text, name) else ""  # nm is not N/m
    letters, by_letters, is_known = squeezed(text), units_by_letters(), is_in_table(text)
    small, is_of_one_case = letters.casefold(), text.islower() or text.isupper()
    is_clear = is_known and (letters in by_letters or small not in by_letters)
    units = [text] if is_explicit or is_clear or text in ("1", "-") else []
    if not (is_explicit and is_known):
        others = [*by_letters.get(letters, [])]
        if is_of_one_case:
            others += by_letters.get(small, [])
        units += [unit for unit in others if not (is_explicit and "/" in unit and text.isalnum())]  # Nm is not N/m
    parted = re.match(r"([^\W\d_])[\W_]+\w", text)
    if parted:
        is_symbol = parted[1].casefold() == NOMENCLATURE[name].symbol.rstrip("12").casefold()  # P / N is not pN
        may_be_parted = partial(_may_be_parted, is_of_one_case=is_of_one_case)
        units = [unit for unit in units if unit == text or (not is_symbol and may_be_parted(unit))]
    for unit in units:
        if fits(unit, name):
            return unit
    return ""


def _may_be_parted(unit: str, *, is_of_one_case: bool) -> bool:
    """Return whether a gap may stand after the first letter of a unit: m_j is mJ, but c_m is not cm.

    `is_of_one_case`: True if the text with the gap has only small or only capital letters.
    """
    second = unit[1:2]
    return not second.isalpha() or (second.isupper() and is_of_one_case)


_IN_ANY_CASE = str.maketrans("µμΜÅå", "uuuaa")
_Parts = tuple[tuple[str, str], ...]  # the parts of a unit: letters with powers, "" for the power 1


def _in_small_letters(unit: str) -> str:
    return unit.translate(SUPERSCRIPTS).translate(_IN_ANY_CASE).casefold().replace("per", "/")  # mJperm2


def _parts_of(unit: str) -> _Parts:
    """Return the letters of a unit in lower case, each with the digits after it; signs are left out."""
    parts: list[tuple[str, str]] = re.findall(r"([a-z]+)[^a-z\d]*(\d*)", _in_small_letters(unit))
    return tuple((letters, power.removeprefix("1")) for letters, power in parts)


def _joined(parts: _Parts) -> _Parts:
    return (("".join(letters for letters, _ in parts), parts[-1][1] if parts else ""),)


@cache
def _units_by_parts() -> dict[_Parts, list[str]]:
    """Return the common and rare units by their parts.

    A unit is also listed with "lost" as its last power and, if it has a last power, with all its letters joined.
    """
    units: dict[_Parts, list[str]] = {(("a", ""),): ["angstrom"]}
    for unit in (*_COMMON, *_RARE):
        parts = _parts_of(unit)
        spelt = {parts, (*parts[:-1], (parts[-1][0], "lost"))}
        if parts[-1][1]:
            spelt.add(_joined(parts))
        for spelling in spelt:
            units.setdefault(spelling, []).append(_MEANT_BY.get(unit, unit))
    return units


def may_be_unit(text: str, name: str) -> bool:
    """Return whether a text may be a unit of a quantity, written with other capitals or without signs.

    >>> [may_be_unit(text, "density") for text in ("kg?m??", "g_cm_", "KgM3", "kg", "kgm")]
    [True, True, True, False, False]
    """
    if re.search(r"[^\W\d_a-z]", _in_small_letters(text)):
        return False  # it is the end of a word
    parts = _parts_of(text)
    spellings = [parts]
    if not any(power for _, power in parts):
        spellings.append(_joined(parts))
    if parts[1:] and not (text[-1].isalnum() or parts[-1][1]):
        spellings.append((*parts[:-1], (parts[-1][0], "lost")))
    units: list[str] = []
    for spelling in spellings:
        units += _units_by_parts().get(spelling, [])
    return any(fits(unit, name) for unit in units)


def is_like_unit(token: str) -> bool:
    """Return whether a word in lower case may be the beginning of a unit, a prefix, or a neutral word such as wall."""
    return token in NEUTRAL or token in PREFIXES or any(unit.startswith(token) for unit in units_by_letters())
