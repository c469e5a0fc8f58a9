"""What a mistyped word was probably meant to be. Read only when there is an error to word."""

from collections.abc import Iterable
from difflib import get_close_matches

MAX_WORD = 80  # a longer one is no slip of a finger, and comparing it takes long


def closest(word: str, known: Iterable[str], cutoff: float = 0.6) -> str | None:
    """The known word that differs from this one only by case, else the most similar one.

    >>> closest("Quartz", ["quartz", "iron"]), closest("quarz", ["quartz", "iron"]), closest("x", ["quartz"])
    ('quartz', 'quartz', None)
    """
    if len(word) > MAX_WORD:
        return None
    words = list(known)
    same = [candidate for candidate in words if candidate.casefold() == word.casefold()]
    return next(iter(same or get_close_matches(word, words, n=1, cutoff=cutoff)), None)


def unit_like(word: str, name: str) -> str | None:
    """The unit that a mistyped one for this quantity probably is, one of the quantity's own dimension if possible.

    >>> unit_like("Gpa", "youngs_modulus")
    'GPa'
    """
    from .nomenclature import NOMENCLATURE
    from .unit_table import PLAIN, PREFIXABLE, PREFIXES
    from .units import dimension_of

    wanted = dimension_of(NOMENCLATURE[name].unit) if name in NOMENCLATURE else None
    everything = {unit: dimension for unit, (_, _, dimension) in {**PREFIXABLE, **PLAIN}.items()}
    everything |= {
        prefix + unit: dimension
        for unit, (_, _, dimension) in PREFIXABLE.items()
        for prefix in PREFIXES
        if (len(prefix) > 2) == (len(unit) > 3)
    }
    fitting = [unit for unit, dimension in everything.items() if dimension == wanted]
    return closest(word, fitting, 0.5) or closest(word, everything, 0.5)
