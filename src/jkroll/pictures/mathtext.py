"""Symbols in plain text typeset as mathematics, in matplotlib's mathtext markup.

Captions and labels are written once, in plain text ("P_c = 3πγR"), and drawn in a terminal as they are. On a page, the words of
them that consist of symbols of the nomenclature are set in italics with subscripts and superscripts.
"""

import re
from functools import cache
from textwrap import wrap

from ..quantities.nomenclature import NOMENCLATURE

_ATOM = r"[A-Za-zΑ-Ωα-ω](?:_[A-Za-z]+|_[α-ω]|_?\d)?\*?"  # a letter with its subscript: P_c, R1, δ_α, E*
_MORE_ATOMS = ("π", "C", "â", "p", "y")  # occur in texts, but are no quantities
_SUPERSCRIPTS = "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"
_PLAIN_DIGITS = str.maketrans(_SUPERSCRIPTS, "-0123456789")
_OPERATORS = frozenset("=<>+−-")
_MARKUP = {"â": r"\hat{a}", "·": r"{\cdot}", "⟨": r"\langle ", "⟩": r"\rangle ", "−": "-", "π": r"\mathrm{π}"}
_WORD = re.compile(r"(?P<before>[(\[]*)(?P<core>.*?)(?P<after>[.,:;)\]]*)")
_NUMBER = re.compile(rf"[-−]?\d[\d.·e{_SUPERSCRIPTS}-]*")
_FLOAT = re.compile(r"([-−]?[\d.]+)e([-+]\d+)")


def typeset(text: str) -> str:
    r"""Return a text with its symbols in mathtext and with true minus signs.

    >>> typeset("P_c at R1²/ξ = -5 N")
    '$P_{\\mathrm{c}}$ at $R_{1}^{2}/ξ$ = −5 N'
    """
    return " ".join(_typeset_words(text.split(" ")))


def typeset_lines(text: str, width: int) -> list[str]:
    """Return a text as lines of at most `width` characters, typeset.

    Lines are broken before typesetting, because markup is longer than what it shows; none between a number and its unit,
    or its symbol: "P = 0 N" stays together.
    """
    unbroken = re.sub(
        r"(?<=\d) (?=[^\W\d])| (?=\[)| (?=[=<>] [-−\d])|(?<= [=<>]) (?=[-−\d])", "\N{NO-BREAK SPACE}", text
    )
    lines = [line.split() for line in wrap(unbroken, width, break_long_words=False, break_on_hyphens=False)]
    words = iter(_typeset_words(text.split()))
    return [" ".join(next(words) for _ in line) for line in lines]


def _typeset_words(words: list[str]) -> list[str]:
    """Return the words with those typeset that are symbols, formulas or numbers."""
    typed = []
    for number, word in enumerate(words):
        before, core, after = _parts(word)
        following = words[number + 1] if number + 1 < len(words) else "["
        is_variable = len(core) == 1 and core.isalpha() and _is_variable(words[:number], after, following)
        typed.append(before + _typeset_core(core, is_variable=is_variable) + after)
    return typed


def _parts(word: str) -> tuple[str, str, str]:
    """Return the opening brackets, the middle and the punctuation of a word."""
    match = _WORD.fullmatch(word)
    if match is None:
        return "", word, ""
    before, core, after = match.groups()
    is_open = after.startswith(")") and core.count("(") > core.count(")")
    return (before, core + ")", after[1:]) if is_open else (before, core, after)


def _is_variable(previous: list[str], after: str, following: str) -> bool:
    """Return True if a single letter is a variable, not an article or a unit, by the words around it."""
    is_unit = after.startswith("]") or any(_NUMBER.fullmatch(word) for word in previous[-2:])  # "5 m", "5 N m"
    is_in_formula = following in _OPERATORS or not _OPERATORS.isdisjoint(previous[-1:])
    return is_in_formula or (not is_unit and (bool(after) or following.startswith("[")))


def _typeset_core(core: str, *, is_variable: bool) -> str:
    """Return one word without its punctuation in mathtext if it is mathematics."""
    if number := _FLOAT.fullmatch(core):
        mantissa, exponent = number[1].replace("−", "-"), int(number[2])
        return rf"${mantissa}{{\cdot}}10^{{{exponent}}}$"
    tokens = _token().findall(core)
    is_mathematics = is_variable or core in _symbols() or any(map(_is_mathematics, tokens))
    if "".join(tokens) != core or not is_mathematics:
        return re.sub(r"(?<![\w.])-(?=[\d.])", "−", core).replace("$", r"\$")
    return f"${''.join(map(_markup, tokens))}$"


@cache
def _symbols() -> frozenset[str]:
    """Return the symbols of quantities that are longer than a letter."""
    return frozenset(entry.symbol for entry in NOMENCLATURE.values() if entry.unit and len(entry.symbol) > 1)


@cache
def _token() -> re.Pattern[str]:
    """Return the pattern of a token of a formula: a power of ten, a number, a known symbol, an exponent or an operator."""
    symbols = {atom for entry in NOMENCLATURE.values() if entry.unit for atom in re.findall(_ATOM, entry.symbol)} | {
        *_MORE_ATOMS
    }
    known = "|".join(re.escape(symbol) for symbol in sorted(symbols, key=len, reverse=True))
    return re.compile(rf"10[{_SUPERSCRIPTS}]+|\d+(?:\.\d+)?|{known}|[{_SUPERSCRIPTS}]+|\^\([^)]*\)|[-+−/·=<>()⟨⟩√]")


def _is_mathematics(token: str) -> bool:
    """Return True for a token that occurs only in mathematics: a Greek letter, a symbol with a subscript, a power of ten."""
    is_symbol = token[0].isalpha() and (len(token) > 1 or not token.isascii())
    is_power_of_ten = token.startswith("10") and token[-1] in _SUPERSCRIPTS
    return is_symbol or is_power_of_ten or token == "⟨"


def _markup(token: str) -> str:
    """Return one token in mathtext."""
    if token in _MARKUP:
        return _MARKUP[token]
    if token.startswith("^("):
        return f"^{{{token[2:-1]}}}"
    if token[-1] in _SUPERSCRIPTS:
        plain = token.rstrip(_SUPERSCRIPTS)
        return f"{plain}^{{{token[len(plain) :].translate(_PLAIN_DIGITS)}}}"
    if not token[0].isalpha():
        return token
    star = "^{*}" if token.endswith("*") else ""
    subscript = token[1:].strip("_*")
    if len(subscript) > 1 or (subscript.isascii() and subscript.isalpha()):
        subscript = rf"\mathrm{{{subscript}}}"
    return token[0] + (f"_{{{subscript}}}" if subscript else "") + star
