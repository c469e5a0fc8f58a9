"""Symbols and formulas in texts: unchanged on a terminal, typeset in pictures and in LaTeX.

The marks ⟦ and ⟧ enclose each symbol or formula, in the notation of the nomenclature: "⟦P_c = 3πγR⟧ with ⟦R = R1/2⟧".
"""

import re
from collections.abc import Callable
from textwrap import wrap

from ..text import LETTERS, NO_BREAK_SPACE, with_units_joined
from .nomenclature import NOMENCLATURE
from .units import SUPERSCRIPTS

_SUPERSCRIPTS = "".join(map(chr, SUPERSCRIPTS))
_FORMULA = re.compile("⟦([^⟦⟧]*)⟧")
# A letter with its subscript and a star, as P_c, R1 and E*; an exponent, as in m² and â^(3/2); a number; an operator.
_TOKEN = re.compile(
    rf"log₁₀|(?P<letter>[A-Za-zΑ-Ωα-ωâ])(?:_(?P<word>[A-Za-z]+|[α-ω])|(?P<index>_?\d+))?(?P<star>\*?)"
    rf"|(?P<exponent>[{_SUPERSCRIPTS}]+)|\^\((?P<power>[^)]*)\)|[\d.]+|[-+−/·=<>≤()⟨⟩√]"
)
# A formula in a sentence: a root; the argument of artanh; a word with a Greek letter or one of the signs _, ^ and *; a
# single letter, perhaps with a digit, but not the article "a".
_IN_SENTENCE = re.compile(
    r"2?√\([^()]*\)|(?<=artanh)\([^()]*\)|(?<!\S)(?:(?=[^\s,]*[_^*α-ω])|(?=[A-Za-z]\d?(?![^\s,]))(?!a ))[^\s,]+"
)
_SIGNS = {
    "·": r"{\cdot}",
    "⟨": r"{\langle}",
    "⟩": r"{\rangle}",
    "−": "-",
    "≤": r"{\leq}",
    "log₁₀": r"\mathrm{log}_{10}",
}
_LETTERS = {"â": r"\hat{a}", "π": r"\mathrm{π}"}
_COMMANDS = {"√": r"{\surd}", "±": r"{\pm}", "µ": r"{\mu}"}  # LaTeX commands in mathematics, by sign
_COMMANDS |= {letter: rf"{{\{name}}}" for name, letter in LETTERS.items() if "Α" <= letter <= "ω"}
_ESCAPED = {  # signs outside formulas, in LaTeX
    **{sign: f"${command}$" for sign, command in _COMMANDS.items()},
    **{sign: f"$^{{{sign.translate(SUPERSCRIPTS)}}}$" for sign in _SUPERSCRIPTS},
    **{sign: rf"\{sign}" for sign in "&%$#_{}"},
    "≈": r"$\approx$",
    "≥": r"$\geq$",
    "≤": r"$\leq$",
    NO_BREAK_SPACE: "~",
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
}
_IN_LATEX_FORMULAS, _IN_LATEX_WORDS = str.maketrans(_COMMANDS), str.maketrans(_ESCAPED)
_POWER_OF_TEN = re.compile(r"(?<=[\d)])e([+-]?\d+)")
_JOINED = re.compile(r" (?=[=<>\[])|(?<=[=<>]) ")  # spaces at which no line is broken, as in "P = 0 N" and "P [nN]"


def symbol(name: str) -> str:
    """Return the symbol of a quantity, marked as a formula unless it is a word.

    >>> symbol("pull_off_force")
    '⟦P_c⟧'
    """
    quantity = NOMENCLATURE[name]
    return quantity.symbol if quantity.is_word else f"⟦{quantity.symbol}⟧"


def marked(sentence: str) -> str:
    """Return a sentence of the nomenclature with marks around its formulas.

    >>> marked("pull-off force over πwR"), marked("w of opening minus closing"), marked("√(1 + P/P_c) at the load")
    ('pull-off force over ⟦πwR⟧', '⟦w⟧ of opening minus closing', '⟦√(1 + P/P_c)⟧ at the load')
    """
    return _IN_SENTENCE.sub(r"⟦\g<0>⟧", sentence)


def plain(text: str) -> str:
    """Return a text without its marks.

    >>> plain("⟦P_c = 3πγR⟧: JKR")
    'P_c = 3πγR: JKR'
    """
    return _FORMULA.sub(r"\1", text)


def typeset(text: str) -> str:
    r"""Return a text with formulas in mathtext, raised exponents, and true minus signs before numbers.

    >>> typeset("⟦P_c⟧ at ⟦R1²/ξ⟧ = -5 m⁻¹"), typeset("1e6 to 1.5e7")
    ('$P_{\\mathrm{c}}$ at $R_{1}^{2}/ξ$ = −5 m$^{-1}$', '$10^{6}$ to 1.5·$10^{7}$')
    """
    return _converted(text, _typeset_words, str)


def _typeset_words(words: str) -> str:
    words = re.sub(r"(?<![\w.])-(?=[\d.])", "−", words).replace("$", r"\$")
    words = words.replace("SiO2", "SiO$_{2}$")
    words = re.sub(r"\b1e(-?\d+)", r"$10^{\1}$", words)
    words = _POWER_OF_TEN.sub(r"·$10^{\1}$", words)
    return re.sub(f"[{_SUPERSCRIPTS}]+", lambda match: f"$^{{{match[0].translate(SUPERSCRIPTS)}}}$", words)


def as_latex(text: str) -> str:
    r"""Return a text for LaTeX, with commands for formulas, Greek letters and exponents, and escaped signs.

    >>> as_latex("radius & ⟦R_c⟧ is 1 µm; ⟦γ⟧ is 2.5e-05 J/m²")
    'radius \\& $R_{\\mathrm{c}}$ is 1~${\\mu}$m; ${\\gamma}$ is 2.5${\\times}10^{-5}$~J/m$^{2}$'
    """
    return _converted(text, _words_in_latex, _formula_in_latex)


def _words_in_latex(words: str) -> str:
    escaped = with_units_joined(words).translate(_IN_LATEX_WORDS)
    return _POWER_OF_TEN.sub(lambda match: rf"${{\times}}10^{{{int(match[1])}}}$", escaped)


def _formula_in_latex(mathtext: str) -> str:
    return mathtext.translate(_IN_LATEX_FORMULAS)


def _converted(text: str, of_words: Callable[[str], str], of_formula: Callable[[str], str]) -> str:
    """Return a text with one function applied to its words, and another to its formulas in mathtext."""
    converted = []
    for number, piece in enumerate(_FORMULA.split(text)):
        if number % 2 == 0:  # words and formulas alternate
            converted.append(of_words(piece))
            continue
        mathtext = "".join(map(_token, _TOKEN.finditer(piece)))
        if mathtext:
            converted.append(f"${of_formula(mathtext)}$")
    return "".join(converted)


def lines(text: str, letters: int) -> list[str]:
    """Return a text as typeset lines of limited length, without breaks within a formula or before a unit."""
    joined = _FORMULA.sub(lambda match: match[0].replace(" ", NO_BREAK_SPACE), with_units_joined(text))
    joined = _JOINED.sub(NO_BREAK_SPACE, joined)
    return [*map(typeset, wrap(joined, letters, break_long_words=False, break_on_hyphens=False))]


def _token(match: re.Match[str]) -> str:
    """Return a token of a formula in mathtext."""
    letter, word, index, star, exponent, power = match.groups()
    if exponent or power:
        return f"^{{{(exponent or power).translate(SUPERSCRIPTS)}}}"
    if not letter:
        return _SIGNS.get(match[0], match[0])
    subscript = word or (index or "").lstrip("_")
    if word and word.isascii():
        subscript = rf"\mathrm{{{word}}}"
    mathtext = _LETTERS.get(letter, letter)
    if subscript:
        mathtext += f"_{{{subscript}}}"
    if star:
        mathtext += "{}^{*}"  # on an empty base, since mathtext puts a gap before a star on a slanted letter
    return mathtext
