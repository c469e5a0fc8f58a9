"""Words that users have for quantities, as names, words of options and symbols, and the error about those that mean none."""

from collections.abc import Collection

from ..text import ascii_text
from .nomenclature import NOMENCLATURE, canonical


def named(word: str, names: Collection[str] = NOMENCLATURE) -> str:
    """Return the quantity among `names` that a word stands for: a name or the word of an option, in any case, or a symbol.

    A word that stands for nothing, or is the symbol of several quantities, is returned as it is.

    >>> named("R-min"), named("gamma"), named("P_c"), named("Pc"), named("delta0"), named("E"), named("v")
    ('r_min', 'surface_energy', 'pull_off_force', 'pull_off_force', 'approach', 'youngs_modulus', 'v')
    """
    for spelt in (word, word.casefold()):
        if (name := canonical(spelt)) in names:
            return name
    found = with_symbol(word, names)
    return found[0] if len(found) == 1 else word


def with_symbol(word: str, names: Collection[str] = NOMENCLATURE) -> list[str]:
    """Return the quantities among `names` that have a symbol.

    The symbol is looked for as it is printed; if no quantity has it, in any case, with Greek letters spelt out, and without the
    underscores and spaces. The index of sphere 1 may be left out. A variant of a quantity has the same symbol and is not looked
    for.
    """
    symbols = {name: NOMENCLATURE[name].symbol for name in names if not NOMENCLATURE[name].variant_of}
    for alike in (str, _spelt):
        for index in ("", "1"):
            wanted = alike(word.strip()) + index
            if found := [name for name, symbol in symbols.items() if symbol and alike(symbol) == wanted]:
                return found
    return []


def _spelt(symbol: str) -> str:
    return ascii_text(symbol.casefold()).replace("_", "").replace(" ", "")
