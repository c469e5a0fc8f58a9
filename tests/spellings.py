"""Headers as people and programs write them: all words and symbols of inputs, with units in many notations, mangled."""

import re
from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple
from unicodedata import normalize

from jkroll.quantities.nomenclature import NOMENCLATURE, OPTION_WORDS
from jkroll.quantities.synonyms import CERTAIN_SYNONYMS
from jkroll.quantities.units import dimension_of
from jkroll.tables.words import INPUTS, NO_HEADERS

# Units for each SI unit of an input, with their factors.
UNITS: Mapping[str, list[tuple[str, float]]] = {
    "m": [("nm", 1e-9), ("µm", 1e-6), ("Å", 1e-10)],
    "J/m^2": [("mJ/m2", 1e-3), ("J/m²", 1.0), ("mJ m-2", 1e-3)],
    "Pa": [("GPa", 1e9), ("MPa", 1e6)],
    "kg/m^3": [("kg/m3", 1.0), ("g/cm³", 1e3), ("kg m-3", 1.0)],
    "J": [("zJ", 1e-21), ("eV", 1.602176634e-19), ("aJ", 1e-18)],
    "N": [("nN", 1e-9), ("µN", 1e-6), ("pN", 1e-12)],
    "m/s": [("m/s", 1.0), ("cm/s", 1e-2)],
    "m/s^2": [("m/s2", 1.0), ("m s-2", 1.0)],
    "rad": [("rad", 1.0)],
}
NOTATIONS = (
    "{word} [{unit}]", "{word}[{unit}]", "{word} ({unit})", "{word}({unit})", "{word} {{{unit}}}", "{word} <{unit}>",
    "{word}, {unit}", "{word},{unit}", "{word}/{unit}", "{word} / {unit}", "{word} / ({unit})", "{word} / [{unit}]",
    "{word} in {unit}", "{word}: {unit}", "{word}:{unit}", "{word}; {unit}", "{word} | {unit}", "{word} (in {unit})",
    "{word}_{unit}", "{word}-{unit}", "{word} {unit}", "{word}.{unit}", "{word}_in_{unit}", "{word}__{unit}",
    "{word}_({unit})", "{word} - {unit}",
)  # fmt: skip
_MARKS = re.compile(r"[\[(<,/:;|]|\{\{|\sin\s")  # marks by which a notation separates a unit
_LOSSY = ("R", "MATLAB", "MATLAB, joined", "SQL, small", "SQL, capital", "janitor")  # manglings that lose these marks


def _plain(text: str) -> str:
    """Return a text with µ, superscripts and Å as spelled by a program that knows only plain letters."""
    return normalize("NFKC", text.replace("µ", "u").replace("Å", "angstrom")).replace("−", "-")


def _by_matlab(text: str) -> str:
    joined = re.sub(r"\s+([a-z])", lambda found: found[1].upper(), _plain(text))
    return re.sub(r"[^A-Za-z0-9]", "_", joined.replace(" ", ""))


def _by_janitor(text: str) -> str:
    parted = re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", _plain(text).replace("'", ""))
    return re.sub(r"[^a-z0-9]+", "_", parted.lower()).strip("_")


_FULL_WIDTH = {code: code + 0xFEE0 for code in range(0x21, 0x7F)}
_CURLY = str.maketrans({"'": "\u2019", " ": "\u00a0"})
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_POWER = re.compile(r"(?:(?<=\bm)|(?<=cm)|(?<=\bs))(-?\d)")

MANGLINGS: Mapping[str, Callable[[str], str]] = {
    "as it is": str,
    "R": lambda text: re.sub(r"[^\w.]|_", ".", text),
    "MATLAB": lambda text: re.sub(r"[^A-Za-z0-9]", "_", _plain(text)),
    "MATLAB, joined": _by_matlab,
    "SQL, small": lambda text: re.sub(r"[^a-z0-9]+", "_", _plain(text).lower()),
    "SQL, capital": lambda text: re.sub(r"[^A-Z0-9]+", "_", _plain(text).upper()).strip("_"),
    "janitor": _by_janitor,
    "NFD": lambda text: normalize("NFD", text),
    "full width": lambda text: text.translate(_FULL_WIDTH),
    "curly": lambda text: text.translate(_CURLY),
    "superscripts": lambda text: _POWER.sub(lambda power: power[0].translate(_RAISED), text),
    "carets": lambda text: _POWER.sub(r"^\1", text),
    "dots": lambda text: re.sub(r"(?<=[a-zJ]) (?=[ms]-?\d)", ".", text),
    "quotes": lambda text: f' "{text}" ',
}


class Spelling(NamedTuple):
    """A header, and what it means."""

    text: str
    name: str  # of the input
    factor: float  # of the unit
    may_pass: bool  # True for a bare symbol, which a table may pass through instead of reading it as the input
    how: str  # a key of MANGLINGS


def words_of(name: str) -> Iterator[tuple[str, bool]]:
    """Iterate over the words and symbols of an input, each with whether it is a symbol."""
    option = next((word for word, meant in OPTION_WORDS.items() if meant == name and word not in NO_HEADERS), name)
    first, *others = name.split("_")
    camel = first + "".join(map(str.title, others))
    synonyms = (word.replace("_", " ") for word in CERTAIN_SYNONYMS.get(name, ()))
    for word in dict.fromkeys((name, name.replace("_", " ").title(), option, *synonyms, camel)):
        yield word, False
        if f"{name}2" in NOMENCLATURE:
            yield f"{word}1", False
    symbol = NOMENCLATURE[name].symbol
    if any(dimension_of(NOMENCLATURE[name].unit)):
        yield from ((spelt, True) for spelt in dict.fromkeys((symbol, symbol.removesuffix("1"))))


def spellings() -> Iterator[Spelling]:
    """Iterate over all headers, each once."""
    seen: set[str] = set()
    for name in INPUTS:
        units = UNITS.get(NOMENCLATURE[name].unit, [])  # a ratio has no units
        for index, (word, is_symbol) in enumerate(words_of(name) if units else ()):
            unit, factor = units[index % len(units)]
            for notation in NOTATIONS:
                for how, mangled in MANGLINGS.items():
                    text = mangled(notation.format(word=word, unit=unit))
                    is_other = "*" in word and how in _LOSSY
                    if text not in seen and not is_other:  # without its star E* is E
                        seen.add(text)
                        has_mark = how not in _LOSSY and _MARKS.search(notation) is not None
                        yield Spelling(text, name, factor, is_symbol and not has_mark, how)
