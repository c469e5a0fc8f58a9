"""The texts of a header: the input that each stands for, with its unit.

A name, the word of an option or a symbol stands alone or with a unit behind it: `radius [nm]`, `R2 (nm)`, `Load/nN`,
`E_GPa`, `radius in nm`. Of a symbol that several quantities have, the unit decides. One more word makes it a part of
the input's uncertainty: `gamma_err [mJ/m2]`, `E_min (GPa)`, `u(R) [nm]`.
"""

import re
from collections.abc import Iterable, Iterator
from functools import cache, lru_cache
from typing import NamedTuple

from ..quantities.errors import QUANTITY_SYNONYMS
from ..quantities.nomenclature import NOMENCLATURE, OPTION_WORDS
from ..quantities.units import BadUnit, dimension_of, parse_unit, similar_unit
from ..text import MAX_WORD, ascii_text, closest

MATERIALS = ("material", "material2")
INPUTS = ("radius", *(name for name, quantity in NOMENCLATURE.items() if quantity.option and quantity.unit))
ALIKE = 0.85  # how similar a header is to the name of an input to be taken for a mistake
_ALIKE_WITH_UNIT = 0.75  # the same of one that has a unit of this input
_IN_FULL = ("", "_uncertainty")  # what stands behind the name of an input where no letter is spared
_SHORT = 3  # letters of a name which half of all words resemble
_BRACKETS = re.compile(r"([^\[\]]*?)\s*\[([^\[\]]*)\]")
_PARENTHESES = re.compile(r"([^()]*?)\s*\(([^()]*)\)?")
_CUT = re.compile(r"\s*[,/]\s*|\s+in\s+|_")  # between a name and a unit that stands in no brackets
_SPELT_OUT = ("pico", "nano", "micro", "milli", "kilo", "mega", "giga")
_WORDS = re.compile(r"[a-z]+[12]?")
_BLANKS = re.compile(r"\s+in\s+|[\s(_/,:\[]+|$")  # between a name and what may be a unit
_PHRASES = {"young_modulus": "youngs_modulus", "e_modulus": "youngs_modulus", "poissons_ratio": "poisson_ratio"}
_SYNONYMS = {word: QUANTITY_SYNONYMS[word] for word in ("elastic_modulus", "velocity", "surface_tension")}
_LENGTHS, _PRESSURES = "m", "Pa"
_DIAMETER = (_LENGTHS, "a diameter? A radius is half of it.")
_CONTACT_MODULUS = (_PRESSURES, "the modulus of a contact? --young and --poisson are those of the materials.")
_LAW = "the law is an option: --model dmt."
NO_INPUTS = (
    _LAW,
    _DIAMETER[1],
    _CONTACT_MODULUS[1],
)  # a choice of an input does not help: numbers or columns must change
_UNCLEAR = {
    "r": (_LENGTHS, "a radius, or a distance?"),
    **dict.fromkeys(("d", "D", "diameter", "diam", "dia"), _DIAMETER),
    **dict.fromkeys(("E*", "E_star", "E_r"), _CONTACT_MODULUS),
    **{
        f"{kind}{of}_modulus": _CONTACT_MODULUS
        for kind in ("reduced", "effective")
        for of in ("", "_young", "_youngs", "_elastic")
    },
    **dict.fromkeys(("model", "law"), ("", _LAW)),
}
_SIZES = re.compile(r"(?<![^\W_])(?:diam(?:eters?)?|dia|durchmesser|ø)(?![^\W_])", re.IGNORECASE)
_NO_UNITS = ("in", "bar")  # behind an underscore they may mean inside and mean
_PARTS = {
    **dict.fromkeys(("±", "+/-", "err", "error", "std", "stdev", "sd", "sem", "se", "unc", "uncertainty"), "both"),
    "minus": "minus",
    "plus": "plus",
    **dict.fromkeys(("min", "low", "lower"), "low"),
    **dict.fromkeys(("max", "high", "upper"), "high"),
}
_LONGEST_UNIT = 24  # letters of a unit that is compared with others
_PER_CENT = ("%", "percent", "pct")
_OF_PART = re.compile(
    rf"(.*?)(?:[\s_]*(±|\+/-)|[\s_]+({'|'.join(filter(str.isalpha, _PARTS))}))(?=$|[\s_,/(\[])(.*)", re.IGNORECASE
)
_ERROR = "|".join(["σ", "sigma", *(word for word, part in _PARTS.items() if part == "both" and word.isalpha())])
_PART_BEFORE = re.compile(  # as in u(R) [nm], or as in σ_E [GPa] and error of radius
    rf"(?:u|{_ERROR})\s*\(([^()]+)\)(.*)|(?:{_ERROR})(?:\s+of)?[\s_]+([^\s_].*)", re.IGNORECASE
)
_ALONE = re.compile(r"(?:±|\+/?-)\s*(?:\[([^\[\]]*)\]|\(([^()]*)\)|(.*))")
_ERRORS_ALONE = ("std", "stdev", "stddev", "st_dev", "std_dev", "standard_deviation", "sd", "sem", "unc", "uncertainty")
_RATIOS = ("poisson_ratio", "poisson_ratio2")  # the only ratios whose symbols have no other common meaning
_OF_DIRECTIONS = re.compile(r"(G|nu|ν)_?(12|13|23|xy|xz|yz)(?![^\W_])", re.IGNORECASE)
_SUBSCRIPTS = str.maketrans("₀₁₂", "012")
_IN_BRACKETS = re.compile(r"[\[\](),;]")  # what divides the words of a header, of which one may be a unit


class Reading(NamedTuple):
    """The meaning of a header: an input with the text of its unit; or, without a name, a column that passes through."""

    name: str = ""
    unit_text: str | None = None
    part: str = ""  # of the input's uncertainty: "both" sides, "minus", "plus", or the "low" or "high" end of a range
    is_symbol: bool = False  # without a unit: an input only if its cells have units
    is_alike: bool = False  # passes through, but looks like a quantity
    problem: str = ""  # why the header is refused
    meant: str = ""  # the header that was probably meant, or the name alone of an input whose unit is not known


@lru_cache(maxsize=1000)
def reading_of(text: str) -> Reading:
    """Return the meaning of a header.

    >>> reading_of("R2 (nm)")[:2], reading_of("E [J]")[:2], reading_of("surface_energy_mJ_m2")[:2]
    (('radius2', 'nm'), ('energy', 'J'), ('surface_energy', 'mJ/m2'))
    """
    text = text.strip().removeprefix("# ").translate(_SUBSCRIPTS)  # as numpy begins a line of names
    if name := _named(text):
        return Reading(name)
    if text in _UNCLEAR:
        return Reading(problem=_UNCLEAR[text][1])
    if names := _symbols().get(_symbol(text)):
        return Reading(names[0], is_symbol=names[0] not in _RATIOS)
    return _with_unit(text) or _part(text) or _mistaken(text) or Reading(is_alike=_looks_like_a_quantity(text))


def unit_alone(text: str) -> str | None:
    """Return the unit, or "", of a header that is ± or SD alone: the uncertainty of the column at its left; None for others.

    >>> unit_alone("± [nm]"), unit_alone("+/-"), unit_alone("radius ±"), unit_alone("SD (nm)"), unit_alone("error")
    ('nm', '', None, 'nm', None)
    """
    if (found := _ALONE.fullmatch(text.strip(), 0, MAX_WORD)) is not None:
        return next((unit for unit in found.groups() if unit), "")
    word, unit_text = _divided(text.strip())
    word = _plain(word.replace(".", ""))  # an error without a unit may be of anything
    return unit_text if word in _ERRORS_ALONE or (word in ("err", "error") and unit_text) else None


def is_of_directions(text: str) -> bool:
    """Return whether a header is that of an elastic constant which only a body with directions has: ν12, G_xy.

    >>> is_of_directions("nu12"), is_of_directions("G12_Pa"), is_of_directions("G1")
    (True, True, False)
    """
    return bool(_OF_DIRECTIONS.match(text.strip()))


def measured_reading(text: str, quantity: str) -> Reading | None:
    """Return the meaning of a header as that of a measured quantity, or of a part of its uncertainty; None if it is another.

    >>> measured_reading("P_c (nN)", "pull_off_force")[:2], measured_reading("pull_off_force_err [nN]", "pull_off_force")[:3]
    (('pull_off_force', 'nN'), ('pull_off_force', 'nN', 'both'))
    """
    text = text.strip()
    if _is_quantity(text, quantity):
        return Reading(quantity)
    found = _BRACKETS.fullmatch(text) or _PARENTHESES.fullmatch(text)
    for word, unit_text in [(found[1], found[2])] if found else [(word, rest) for word, _, rest in _cuts(text)]:
        if _is_quantity(word.strip(), quantity) and (found or fits(unit_text, quantity)):
            return Reading(quantity, unit_text.strip())
    part = _parted(text)
    reading = measured_reading(part.word + part.rest, quantity) if part else None
    return reading._replace(part=part.name) if part and reading else None


def _is_quantity(word: str, quantity: str) -> bool:
    return _plain(word) == quantity or _symbol(word) == _symbol(NOMENCLATURE[quantity].symbol)


def _with_unit(text: str) -> Reading | None:
    """Return the meaning of a header that has a unit; None if it is no input."""
    found = _BRACKETS.fullmatch(text) or _PARENTHESES.fullmatch(text)
    if found is None:
        return next(filter(None, (_behind(*cut) for cut in _cuts(text))), None)
    word, unit_text = found[1].strip(), found[2].strip()
    word = word.removesuffix(",").removesuffix("_").removesuffix("/").rstrip()
    name = _named(word)
    if name in MATERIALS or (name and (text.endswith("]") or fits(unit_text, name))):
        return Reading(name, unit_text)
    return None if name else _unclear(word, unit_text) or _of_symbol(word, unit_text)


class _Part(NamedTuple):
    """A header taken apart: what has an uncertainty, the part of it as `Reading` has it, and what stands behind."""

    word: str
    name: str
    rest: str

    @property
    def is_share(self) -> bool:
        """True for a part of the value, in %."""
        return self.rest.strip(" _,/()[]").lower() in _PER_CENT


def _parted(text: str) -> _Part | None:
    """Take a header apart that has a word of an uncertainty; None if it has none."""
    if (before := _PART_BEFORE.fullmatch(text, 0, MAX_WORD)) is not None:
        text = f"{before[3]} ±" if before[3] else f"{before[1]} ±{before[2]}"
    found = _OF_PART.fullmatch(text, 0, MAX_WORD)
    return found and _Part(found[1], _PARTS[(found[2] or found[3]).lower()], found[4])


def _part(text: str) -> Reading | None:
    """Return the meaning of a header that has a part of an input's uncertainty; None if it has none."""
    part = _parted(text)
    if part is None:
        return None
    is_share = part.is_share
    reading = (
        reading_of(part.word)._replace(unit_text="%", is_symbol=False)
        if is_share
        else reading_of(part.word + part.rest)
    )
    if reading.part or not reading.name or reading.name in MATERIALS:
        return None
    return reading._replace(part=part.name)


def uncertainty_beside(text: str, head: str, name: str) -> Reading | None:
    """Return the meaning of a header that is another with a word of an uncertainty, where that one means an input; None if it is none.

    >>> uncertainty_beside("F_err [nN]", "F [nN]", "load")[:3], uncertainty_beside("F2_err [nN]", "F [nN]", "load")
    (('load', 'nN', 'both'), None)
    """
    part = _parted(text.strip())
    if part is None or part.name != "both" or _plain(_divided(part.word)[0]) != _plain(_divided(head)[0]):
        return None
    return Reading(name, "%" if part.is_share else unit_in_header(text, name), part.name)


def _divided(text: str) -> tuple[str, str]:
    """Return a word and the unit in brackets behind it, or ""."""
    found = _BRACKETS.fullmatch(text) or _PARENTHESES.fullmatch(text)
    return (found[1], found[2].strip()) if found else (text, "")


def _cuts(text: str) -> Iterator[tuple[str, str, str]]:
    """Iterate over words, what stands between, and what may be units."""
    for cut in _CUT.finditer(text, 0, MAX_WORD):
        if rest := text[cut.end() :].strip():
            yield text[: cut.start()].strip(), cut[0].strip(), rest


def _behind(word: str, mark: str, rest: str) -> Reading | None:
    """Return the meaning of a word with a unit behind a mark; None if it is no input."""
    name = _named(word)
    for unit_text in _units_behind(mark, rest):
        if name and fits(unit_text, name):
            return Reading(name, unit_text)
        is_index = mark == "_" and len(unit_text) == 1  # as in R_m
        found = None if name or is_index else _unclear(word, unit_text) or _of_symbol(word, unit_text)
        if found and (found.name or found.problem or found.meant):
            return found
    return None


def unit_in_header(text: str, name: str) -> str | None:
    """Return the unit of a quantity that stands in a header, whatever else does; None if there is none.

    >>> unit_in_header("Kraft [nN]", "load"), unit_in_header("F_nN", "load"), unit_in_header("Kraft [nm]", "load")
    ('nN', 'nN', None)
    """
    cuts = [(mark, rest) for _, mark, rest in _cuts(text)]
    units = (unit_text for mark, rest in cuts for unit_text in _units_behind(mark, rest))
    in_brackets = map(str.strip, _IN_BRACKETS.split(text)[1:])
    return next((unit_text for unit_text in (*in_brackets, *units) if fits(unit_text, name)), None)


def may_be_diameter(text: str) -> bool:
    """Return whether a header has the word diameter and a unit of length in it: "particle diameter [um]"."""
    return bool(_SIZES.search(text, 0, MAX_WORD) and unit_in_header(text, "radius"))


def may_be_input(text: str) -> str:
    """Return the header of the input that is named among other words, with its unit; "" if there is none, or it is a result's.

    >>> may_be_input("grain radius (um)"), may_be_input("applied load, nN"), may_be_input("contact_radius [nm]")
    ('radius [um]', 'load [nN]', '')
    """
    words = f"_{'_'.join(_WORDS.findall(text[:MAX_WORD].casefold()))}_"
    if any(f"_{prefix}_" in words for prefix in _SPELT_OUT):  # the unit is not what it seems, as in load_micro_N
        return ""
    results = [name for name in NOMENCLATURE if f"_{name}_" in words and name not in INPUTS]
    for word, name in {**_names(), **_SYNONYMS}.items():
        is_named = f"_{word}_" in words and not any(word in result.split("_") for result in results)
        unit_text = unit_in_header(text, name) if is_named and name not in MATERIALS else None
        if unit_text and unit_text != word:  # gravity is a unit, too
            return f"{name} [{unit_text}]"
    return ""


def _units_behind(mark: str, rest: str) -> Iterator[str]:
    """Iterate over the units that a text behind a mark may mean."""
    if mark != "_":
        yield rest[1:-1].strip() if rest.startswith("(") and rest.endswith(")") else rest
    elif rest not in _NO_UNITS:
        yield from _spellings(rest)


def _spellings(rest: str) -> Iterator[str]:
    """Iterate over the units that a text with underscores may spell: kg_m3, mJ_per_m2.

    >>> [*_spellings("kg_m3")]
    ['kg m3', 'kg/m3']
    """
    yield rest.replace("_per_", "/").replace("_", " ")
    before, mark, after = rest.rpartition("_")
    if mark and "per" not in before:
        yield f"{before.replace('_', ' ')}/{after}"


def _unclear(word: str, unit_text: str) -> Reading | None:
    """Return the refusal of a word that may mean several quantities, if its unit is that of an input; else None."""
    unit, problem = _UNCLEAR.get(word, _UNCLEAR.get(_plain(word) if len(word) > 1 else "", ("", "")))
    return Reading(problem=problem) if unit and _has_dimension(unit_text, unit) else None


def _of_symbol(word: str, unit_text: str) -> Reading | None:
    """Return the meaning of a symbol with a unit, which decides on the quantity; None if the word is no symbol."""
    names = _symbols().get(_symbol(word))
    if names is None:
        return None
    for name in names:
        if fits(unit_text, name):
            return Reading(name, unit_text)
    meant = (f"{name} [{similar}]" for name in names if (similar := _miswritten(unit_text, name)))
    return Reading(meant=next(meant, ""), is_alike=True)


def _mistaken(text: str) -> Reading | None:
    """Return the refusal of a header that was probably meant to be an input; None if it was not."""
    for cut in _BLANKS.finditer(text, 0, MAX_WORD):  # no name of an input is as long
        word = text[: cut.start()]
        name = _named(word)
        other = "" if name else _SYNONYMS.get(_plain(word), "")
        meant = name or other
        rest = text[cut.end() :].rstrip(")] ")
        unit_text = next((one for one in _spellings(rest) if fits(one, meant)), "") if meant and rest else ""
        if unit_text:
            return Reading(meant=f"{meant} [{unit_text}]")
        if similar := _miswritten(rest, meant) if meant else "":
            return Reading(meant=f"{meant} [{similar}]")
        if meant and (other or cut.end() == len(text) or not {*cut[0]}.isdisjoint("([/")):
            words = map(str.strip, _IN_BRACKETS.split(text))
            unit_text = next((one for one in words if fits(one, meant)), "")
            return Reading(meant=f"{meant} [{unit_text}]" if unit_text else meant)
        if _plain(word) in _UNCLEAR and len(word) > 1 and (cut.end() == len(text) or _has_dimension(rest, _LENGTHS)):
            return Reading(problem=_UNCLEAR[_plain(word)][1])
    return _slip(text)


def _slip(text: str) -> Reading | None:
    """Return the refusal of a header with a slip of the pen in the name of an input; None if it has none.

    A unit leaves few inputs, so that less of the name must be right: gama [mJ/m2], laod_nN.
    """
    brackets = _BRACKETS.fullmatch(text)
    name = _plain(brackets[1] if brackets else text)
    if name in NOMENCLATURE:  # a result
        return None
    found = brackets or _PARENTHESES.fullmatch(text)
    cuts = [(found[1], "", found[2])] if found else [*_cuts(text)]
    parts = [(_plain(word), unit_text) for word, mark, rest in cuts for unit_text in _units_behind(mark, rest.strip())]
    named = {f"{word}{part}": (one, part) for word, one in _names().items() if len(word) > _SHORT for part in _IN_FULL}
    for word, unit_text in parts:
        near = [one for one in _near(word, named, _ALIKE_WITH_UNIT) if abs(len(one) - len(word)) <= 1]
        guess = closest(word, near, _ALIKE_WITH_UNIT) if near else None
        if guess and fits(unit_text, named[guess][0]):  # asked last: what is no unit is looked for in pint
            return Reading(meant=f"{''.join(named[guess])} [{unit_text}]")
    words = (*INPUTS, *MATERIALS, *(word for word in OPTION_WORDS if word in _names()))
    near = _near(name, words, ALIKE)
    meant = _names().get(closest(name, near, ALIKE) or "") if near else None
    return Reading(meant=f"{meant} [{brackets[2]}]" if brackets else meant) if meant else None


def _near(word: str, names: Iterable[str], least: float) -> list[str]:
    """Return the names that may be as similar to a word, of the same sphere.

    One with other letters or another length is not compared: that takes long.
    """
    if len(word) > MAX_WORD:
        return []
    letters, sphere = {*word}, _sphere(word)
    near = []
    for name in names:
        if _sphere(name) != sphere:
            continue
        in_common = least * (len(word) + len(name)) / 2  # at least, for similar words
        if in_common <= min(len(word), len(name)) and len(letters.difference(name)) <= len(word) - in_common:
            near.append(name)
    return near


def _sphere(word: str) -> str:
    """Return the sphere of which a name is, by the digits in it: "2", "" for sphere 1, or "12" for both."""
    digits = "".join(filter(str.isdigit, word))
    return digits if digits == "12" else "2" * digits.endswith("2")


def _miswritten(unit_text: str, name: str) -> str:
    """Return the unit of a quantity that is spelt so but for capitals, as in gpa; "" if there is none."""
    if not unit_text.isalpha() or len(unit_text) > _LONGEST_UNIT:
        return ""
    similar = similar_unit(unit_text, frozenset([dimension_of(NOMENCLATURE[name].unit)]))
    return similar if similar and similar.casefold() == unit_text.casefold() else ""


def _looks_like_a_quantity(text: str) -> bool:
    """Return whether a header has something in brackets, is a name of the nomenclature, or has the word of an input in it."""
    words = {*_plain(text[:MAX_WORD]).replace("(", "_").replace("[", "_").split("_")}
    is_named = text in NOMENCLATURE or _symbol(text.partition("_")[0]) in _all_symbols()
    return is_named or text.endswith((")", "]")) or not words.isdisjoint(_input_words())


@cache
def _all_symbols() -> frozenset[str]:
    return frozenset({*_symbols(), *(_symbol(NOMENCLATURE[name].symbol) for name in INPUTS)})


@cache
def _input_words() -> frozenset[str]:
    names = (*INPUTS, *MATERIALS, *OPTION_WORDS, *_SYNONYMS, "diameter", "force")
    return frozenset(word for name in names for word in name.split("_") if word not in ("of", "ratio", "to"))


def _named(word: str) -> str:
    """Return the input for which a name or the word of an option stands, in any case; "" if there is none."""
    return _names().get(_plain(word.lstrip("-")), "") if len(word) <= MAX_WORD else ""


@cache
def _names() -> dict[str, str]:
    words = {name: name for name in (*INPUTS, *MATERIALS)}
    words |= {word: name for word, name in OPTION_WORDS.items() if name in words} | _PHRASES
    for word, name in [*words.items()]:
        if f"{name}2" in words:
            words |= {f"{word}1": name, f"{word}_1": name, f"{word}_2": f"{name}2", f"{word}2": f"{name}2"}
    return words


@cache
def _symbols() -> dict[str, list[str]]:
    """Return the inputs by their symbols, with Greek letters spelt out, and the index of sphere 1 or without it."""
    found: dict[str, list[str]] = {}
    for name in INPUTS:
        symbol = _symbol(NOMENCLATURE[name].symbol)
        if any(dimension_of(NOMENCLATURE[name].unit)) or name in _RATIOS:
            for one in dict.fromkeys((symbol, re.sub(r"(\d)$", r"_\1", symbol), symbol.removesuffix("1"))):
                found.setdefault(one, []).append(name)
    found["E"].append("energy")
    return found


def _symbol(word: str) -> str:
    """Return a symbol with Greek letters spelt out; one that is spelt with a capital, such as Rho, is the same."""
    spelt = ascii_text(word).replace(" ", "") if len(word) <= MAX_WORD else word
    return spelt.lower() if spelt.rstrip("_12") in ("Gamma", "Nu", "Rho", "Xi", "Tau", "Theta") else spelt


def _plain(text: str) -> str:
    return re.sub(r"[-\s]+", "_", text.strip().casefold().replace("'", "").replace("’", ""))


def fits(unit_text: str, name: str) -> bool:
    """Return whether a text is a unit of a quantity; - and 1 are those of a ratio."""
    unit = NOMENCLATURE[name].unit
    return bool(unit) and ((unit == "1" and unit_text in ("1", "-")) or _has_dimension(unit_text, unit))


def _has_dimension(unit_text: str, unit: str) -> bool:
    try:
        return bool(unit_text) and parse_unit(unit_text).dimension == dimension_of(unit)
    except BadUnit:
        return False
