"""Formulas of the nomenclature, such as `P_c = 3πγR`, as MathML with indices and fractions, which browsers draw.

As in the nomenclature, adjacent letters are a product, and a slash divides the part of the product before it by the
part after it, up to a space: `M/2cRw` is M/(2cRw), and `(1/2π)√(k/m)` is a fraction times a root.
"""

import re
from html import escape

_FUNCTIONS = "arccot|arctanh|artanh|tanh|min|max|exp|ln|sin|cos"
# Words of fewer than four letters; longer ones need no list.
_SHORT = "is|in|if|of|at|as|no|nm|JKR|Eq|the|for|and|its|has|a(?= [a-z]{4})"
_SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺", "0123456789−+")
_TOKEN = re.compile(
    rf"(?P<space>\s+)|(?P<function>{_FUNCTIONS})|(?P<word>(?:(?:{_SHORT})(?![\w*])|[A-Za-z]{{4,}}[\w-]*|D&T|`[^`]*`))"
    r"|(?P<letter>[A-Za-zΑ-Ωα-ωâÛδ∞])(?:_(?P<foot>[a-z]+|[A-Z]+\d?|\d+|[α-ω])|(?P<index>\d+))?(?P<star>\*?′?)"
    r"|(?P<number>[\d.]*\d|[½⅔¼])|\^(?P<power>[-−]?[\d.]+|[A-Z]+|[a-z])|(?P<raised>[⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺]+)|(?P<sign>.)"
)
_OF_MARKDOWN = str.maketrans({"*": "&#42;", "|": "&#124;"})  # signs that Markdown would take for its own marks
_CLOSING = {"(": ")", "[": "]", "{": "}", "⟨": "⟩"}
_BETWEEN = "+−-=≈<>≤≥≪≫±,;:∫"
_SIGNS = {*"√/·|×⟨⟩()[]{}", *_BETWEEN}


def mathml(formula: str, *, is_block: bool = False, is_inline: bool = False) -> str:
    """Return a formula, with the words in it, as a MathML element.

    `is_block`: True for a formula on its own line; `is_inline`: True in a sentence, where fractions keep the slash.
    """
    row = _Reader([*_TOKEN.finditer(formula)], has_slashes=is_inline).row("").translate(_OF_MARKDOWN)
    look = " display=block" if is_block else ""
    return f'<math displaystyle="{str(not is_inline).lower()}"{look}>{row}</math>'


def is_formula(text: str) -> bool:
    """Return whether all of a text can be read as a formula, without a word in it."""
    tokens = [*_TOKEN.finditer(text.replace("^(", "("))]
    return not any(token["word"] or (token["sign"] and token[0] not in _SIGNS) for token in tokens)


class _Reader:
    """A reader of the tokens of a formula."""

    def __init__(self, tokens: list[re.Match[str]], *, has_slashes: bool) -> None:
        self.tokens, self.place, self.has_slashes = tokens, 0, has_slashes

    def next_text(self) -> str:
        """Return the next token, or an empty text at the end."""
        return self.tokens[self.place][0] if self.place < len(self.tokens) else ""

    def row(self, end: str) -> str:
        """Return the part up to a closing bracket, as terms and the signs between them."""
        parts = []
        while (text := self.next_text()) and text != end:
            token = self.tokens[self.place]
            if token["word"]:
                before = "&nbsp;" if self.place else ""
                parts.append(f"<mtext>{before}{escape(text.strip('`'))}</mtext>")
            elif text in _BETWEEN:
                parts.append(f"<mo>{escape(text)}</mo>")
            elif text.isspace():
                after_word = self.place and self.tokens[self.place - 1]["word"]
                parts.append("<mtext>&nbsp;</mtext>" if after_word else "")
            else:
                parts.append(self.product(end))
                continue
            self.place += 1
        return _grouped(parts)

    def product(self, end: str) -> str:
        """Return a product of adjacent factors, with its fractions."""
        factors: list[str] = []
        while (
            (text := self.next_text()) and text != end and text not in _BETWEEN and not self.tokens[self.place]["word"]
        ):
            if text == "/" and self.has_slashes:
                factors.append('<mo lspace="0" rspace="0">/</mo>')
                self.place += 1
            elif text == "/":
                self.place += 1 + self.tokens[self.place + 1][0].isspace()
                below = []
                while self._is_factor(end):
                    below.append(self.factor())
                factors = [f"<mfrac>{_bare(factors)}{_bare(below)}</mfrac>"]
            elif text.isspace():
                self.place += 1
            elif self._is_factor(end):
                factors.append(self.factor())
            else:
                factors.append(f"<mo>{escape(text)}</mo>")
                self.place += 1
        return _grouped(factors)

    def _is_factor(self, end: str) -> bool:
        text = self.next_text()
        if not text or text == end or text.isspace() or self.tokens[self.place]["word"]:
            return False
        return text not in _BETWEEN and text not in "/·|′%" and text not in _CLOSING.values()

    def factor(self) -> str:
        """Return a number, a letter, a root, a function or a bracket, with its exponent."""
        token = self.tokens[self.place]
        self.place += 1
        if token[0] == "√":
            return self._raised(f"<msqrt>{_bare([self.factor()])}</msqrt>", "")
        if token[0] in _CLOSING:
            inner = self.row(_CLOSING[token[0]])
            closing = self.next_text()
            self.place += 1
            return self._raised(f"<mrow><mo>{token[0]}</mo>{inner}<mo>{closing}</mo></mrow>", "")
        if token["function"]:
            return self._raised(f"<mi>{token[0]}</mi>", "")
        if not token["letter"]:
            return self._raised(f"<mn>{escape(token[0])}</mn>", "")
        letter = f"<mi>{token['letter']}</mi>"
        if token["index"]:
            letter = f"<msub>{letter}<mn>{token['index']}</mn></msub>"
        elif token["foot"]:
            tag = "mtext" if len(token["foot"]) > 1 else "mi"
            letter = f"<msub>{letter}<{tag}>{token['foot']}</{tag}></msub>"
        return self._raised(letter, "".join(f"<mo>{sign}</mo>" for sign in token["star"]))

    def _raised(self, base: str, star: str) -> str:
        """Return a factor with the star and the exponent that follow it."""
        power = ""
        if self.place < len(self.tokens):
            token = self.tokens[self.place]
            if token["power"] or token["raised"]:
                power = f"<mn>{token['power'] or token['raised'].translate(_SUPERSCRIPTS)}</mn>"
                self.place += 1
            elif token[0] == "^":  # as in ^(1/3), which stays on one line: a fraction would be too small
                closing = next(n for n in range(self.place, len(self.tokens)) if self.tokens[n][0] == ")")
                exponent = "".join(inner[0] for inner in self.tokens[self.place + 2 : closing])
                power = f"<mn>{exponent}</mn>"
                self.place = closing + 1
        if not (star or power):
            return base
        above = f"<mrow>{star}{power}</mrow>"
        if base.startswith("<msub>"):
            return f"<msubsup>{base[len('<msub>') : -len('</msub>')]}{above}</msubsup>"
        return f"<msup>{base}{above}</msup>"


def _grouped(parts: list[str]) -> str:
    return f"<mrow>{''.join(parts)}</mrow>"


def _bare(factors: list[str]) -> str:
    """Return factors as a group; a single factor loses its brackets, which a fraction or a root makes superfluous."""
    if len(factors) == 1 and (match := re.fullmatch(r"<mrow><mo>[(\[]</mo>(.*)<mo>[)\]]</mo></mrow>", factors[0])):
        return match[1]
    return _grouped(factors)
