"""Symbols and formulas in texts: marked once, then shown as text on a terminal and as TeX in pictures.

Mathematics is enclosed in ⟦ and ⟧, in the notation of the nomenclature: "⟦P_c = 3πγR⟧ with ⟦R = R1/2⟧".
"""

import re
from collections.abc import Callable
from textwrap import wrap

from ..text import LETTERS, NO_BREAK_SPACE, with_units_joined
from .nomenclature import NOMENCLATURE
from .units import SUPERSCRIPTS

_SUPERSCRIPTS = "".join(map(chr, SUPERSCRIPTS))
_FORMULA = re.compile("⟦([^⟦⟧]*)⟧")
# A letter with its subscript and a star, "P_c", "R1", "E*"; an exponent, "m²", "â^(3/2)"; a number; an operator.
_TOKEN = re.compile(
    rf"log₁₀|(?P<letter>[A-Za-zΑ-Ωα-ωâ])(?:_(?P<word>[A-Za-z]+|[α-ω])|(?P<index>_?\d+))?(?P<star>\*?)"
    rf"|(?P<exponent>[{_SUPERSCRIPTS}]+)|\^\((?P<power>[^)]*)\)|[\d.]+|[-+−/·=<>≤()⟨⟩√]"
)
# A formula in a sentence: a root, the argument of artanh, or a word of one letter or with a sign that no other has.
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
_GREEK = {letter: name for name, letter in LETTERS.items() if "Α" <= letter <= "ω"} | {"µ": "mu"}
_COMMANDS = {ord(letter): rf"{{\{name}}}" for letter, name in _GREEK.items()}
_COMMANDS |= {ord("√"): r"{\surd}", ord("±"): r"{\pm}"}
_ESCAPED = {
    **{sign: f"${command}$" for sign, command in _COMMANDS.items()},
    **{ord(sign): f"$^{{{sign.translate(SUPERSCRIPTS)}}}$" for sign in _SUPERSCRIPTS},
    **{ord(sign): rf"\{sign}" for sign in "&%$#_{}"},
    **{ord(sign): f"${command}$" for sign, command in (("≈", r"\approx"), ("≥", r"\geq"), ("≤", r"\leq"))},
    ord(NO_BREAK_SPACE): "~",
    ord("\\"): r"\textbackslash{}",
    ord("~"): r"\textasciitilde{}",
    ord("^"): r"\textasciicircum{}",
}
_POWER_OF_TEN = re.compile(r"(?<=\d)e([+-]?\d+)")
_JOINED = re.compile(r" (?=[=<>\[])|(?<=[=<>]) ")  # spaces where no line may break: "P = 0 N", "P [nN]"


def symbol(name: str) -> str:
    """Return the symbol of a quantity, marked as a formula; for a word unmarked.

    >>> symbol("pull_off_force")
    '⟦P_c⟧'
    """
    quantity = NOMENCLATURE[name]
    return quantity.symbol if quantity.is_word else f"⟦{quantity.symbol}⟧"


def marked(sentence: str) -> str:
    """Return a sentence of the nomenclature with its formulas marked.

    >>> marked("pull-off force over πwR"), marked("w of opening less of closing"), marked("√(1 + P/P_c) at the load")
    ('pull-off force over ⟦πwR⟧', '⟦w⟧ of opening less of closing', '⟦√(1 + P/P_c)⟧ at the load')
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

    def typeset_words(words: str) -> str:
        words = re.sub(r"(?<![\w.])-(?=[\d.])", "−", words).replace("$", r"\$")
        words = re.sub(r"\b1e(-?\d+)", r"$10^{\1}$", words)
        words = _POWER_OF_TEN.sub(r"·$10^{\1}$", words)
        return re.sub(f"[{_SUPERSCRIPTS}]+", lambda match: f"$^{{{match[0].translate(SUPERSCRIPTS)}}}$", words)

    return _converted(text, typeset_words, str)


def as_latex(text: str) -> str:
    r"""Return a text for LaTeX: formulas, Greek letters and exponents as commands, the rest escaped.

    >>> as_latex("radius & ⟦R_c⟧ is 1 µm; ⟦γ⟧ is 2.5e-05 J/m²")
    'radius \\& $R_{\\mathrm{c}}$ is 1~${\\mu}$m; ${\\gamma}$ is 2.5${\\times}10^{-5}$~J/m$^{2}$'
    """

    def escaped_words(words: str) -> str:
        escaped = with_units_joined(words).translate(_ESCAPED)
        return _POWER_OF_TEN.sub(lambda match: rf"${{\times}}10^{{{int(match[1])}}}$", escaped)

    return _converted(text, escaped_words, lambda formula: formula.translate(_COMMANDS))


def _converted(text: str, words: Callable[[str], str], formula: Callable[[str], str]) -> str:
    """Return a text with one function applied to its words, and another to its formulas in mathtext."""
    pieces = _FORMULA.split(text)  # words and formulas alternate
    pieces[::2] = map(words, pieces[::2])
    formulas = ("".join(map(_token, _TOKEN.finditer(piece))) for piece in pieces[1::2])
    pieces[1::2] = (f"${formula(mathtext)}$" if mathtext else "" for mathtext in formulas)
    return "".join(pieces)


def lines(text: str, letters: int) -> list[str]:
    """Return a text as typeset lines of limited length, never broken within a formula or before a unit."""
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
    subscript = rf"\mathrm{{{word}}}" if word and word.isascii() else word or (index or "").lstrip("_")
    indexed = _LETTERS.get(letter, letter) + (f"_{{{subscript}}}" if subscript else "")
    return indexed + ("{}^{*}" if star else "")  # apart from the slanted letter, to avoid a gap
