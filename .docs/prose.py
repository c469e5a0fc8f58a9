"""Typeset formulas in the sentences of the manual, found by their signs and by the symbols of the nomenclature.

The pages are also shown in terminals, as plain text, so nothing in them marks a formula. A term is a formula if all of
it can be read as one, and if it has a sign that no word has (`P_c`, `πa²τ`, `E*`) or consists of symbols (`R1`, `w`,
`a/R`).
"""

import re

from typeset import is_formula, mathml

from jkroll.quantities.nomenclature import NOMENCLATURE
from jkroll.quantities.units import is_in_table

# Not prose: code, links, HTML, attributes and addresses.
_OTHER = re.compile(r"(`[^`]*`|\[(?:`[^`]*`|[^]`])*\]\([^)]*\)|<math.*?</math>|<[^>]+>|\{#[^}]*\}|https?://\S+)")
_CODED = re.compile(r"`(.*(?:√|d\w/d).*)`")  # a formula written as code, so that Markdown leaves its stars alone
# A term: letters, numbers, signs without a space, and brackets, up to three deep, with their content.
_IN = r"[^(){}\[\]]"
_BRACKETS = rf"[({{\[](?:{_IN}|[({{\[](?:{_IN}|[({{\[]{_IN}*[)}}\]])*[)}}\]])*[)}}\]]"
_TERM = re.compile(rf"(?<![\w*-])(?:[\w^√·/.½⟨⟩⁺⁻′−]|\*(?!\*)|\\[|_*]|{_BRACKETS})+(?![\w-])")
_GREEK = re.compile("[α-ωΔΦΩ]")  # without the micro sign, which is a different character
_MARK = re.compile(rf"{_GREEK.pattern}|[_*√]|\w\^|[A-Za-z][²³⁵]")
_WORD = re.compile(r"(?<![\w^])(?!d[tv])[a-z]{2,}(?![\w(])")
_COMPOSED = re.compile(r"[A-Za-z][\d(/|]|[/|][A-Za-z]")
_NAME = re.compile(r"[A-Za-z]\d\d|\d[a-z]+\d|\d[a-z]{2}|\d [A-Za-z]")  # the name of a commit, or a number with a unit
_SYMBOLS = {quantity.symbol for quantity in NOMENCLATURE.values() if not quantity.is_word}
_SYMBOLS |= {symbol.rstrip("12") for symbol in _SYMBOLS}
_LETTERS = {symbol[0] for symbol in _SYMBOLS}
# Terms with signs between them; a side that is not a term is a number or a letter.
_SIDE = r"(?:⟦[^⟧]*⟧|(?<![^\s(])−?(?:[\d.]*\d(?:/\d+)?|[A-Za-z])(?![^\s(),;:.]|\.\d))"
_CHAIN = re.compile(rf"{_SIDE}(?: [=≈<>≤≥≪≫+−×] {_SIDE})+|⟦[^⟧]*⟧")


def with_formulas(line: str) -> str:
    """Return a line of Markdown with the formulas in its sentences as MathML; headings and HTML stay unchanged."""
    if line.startswith(("#", "<")):
        return line
    pieces = _OTHER.split(line)
    pieces[::2] = (_CHAIN.sub(_typeset, _TERM.sub(_marked, piece)) for piece in pieces[::2])
    pieces[1::2] = (_CODED.sub(lambda match: mathml(match[1], is_inline=True), piece) for piece in pieces[1::2])
    return "".join(pieces)


def _marked(match: re.Match[str]) -> str:
    """Return a term between marks if it is a formula; mark the terms within a bracket of the prose."""
    term = match[0].rstrip(".")
    if _is_formula(term.replace("\\", "")):
        return f"⟦{term}⟧{match[0][len(term) :]}"
    return term[0] + _TERM.sub(_marked, match[0][1:]) if term[:1] in {*"([{"} else match[0]


def _is_formula(term: str) -> bool:
    is_unit = not _GREEK.search(term) and is_in_table(re.split("[·(]", term.strip("()[]"))[0])
    if term.removeprefix("−") in _SYMBOLS:
        return len(term) > 1 or not (is_unit or term in "aDI")  # D is a journal, too
    if is_unit or not is_formula(term) or _WORD.search(term):
        return False
    if _MARK.search(term):
        return True
    return bool(_COMPOSED.search(term)) and not _NAME.search(term) and {*re.findall("[A-Za-z]", term)} <= _LETTERS


def _typeset(match: re.Match[str]) -> str:
    return mathml(re.sub(r"[⟦⟧\\]", "", match[0]), is_inline=True) if "⟦" in match[0] else match[0]
