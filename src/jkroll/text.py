"""Text: what streams can take, what can be shown of a user's text, and what a mistyped word was meant to be."""

import codecs
import os
import sys
from collections.abc import Iterable
from typing import Any, TextIO

_ASCII = {
    "γ": "gamma", "δ": "delta", "μ": "mu", "ν": "nu", "ρ": "rho", "ξ": "xi", "π": "pi", "ω": "omega", "Ω": "Omega", "α": "alpha",
    "µ": "u", "√": "sqrt", "∛": "cbrt", "⟨": "<", "⟩": ">", "⁰": "^0", "¹": "^1", "²": "^2", "³": "^3", "⁴": "^4", "⁵": "^5", "⁻": "^-", "½": "1/2 ", "¼": "1/4 ", "â": "ahat",
    "𝒜": "A", "Å": "angstrom", "\u0302": "hat", "−": "-", "–": "-", "—": "-", "·": "*", "×": "x", "≪": "<<", "≥": ">=",
    "≤": "<=", "≈": "~", "→": "->", "∞": "inf",
}  # fmt: skip


def ascii_text(text: str) -> str:
    """A text in ASCII, Greek letters by their names and apart from what stands beside them.

    >>> ascii_text("P_c = 3πγR, 50 µm")
    'P_c = 3 pi gamma R, 50 um'
    """
    pieces = [""]
    for character in text:
        piece = _ASCII.get(character, character)
        is_spelt = len(piece) > 1 and piece.isalpha()
        was_spelt = len(pieces[-1]) > 1 and pieces[-1].isalpha()
        if pieces[-1][-1:].isalnum() and (is_spelt or (was_spelt and character.isalpha())):
            pieces.append(" ")
        pieces.append(piece)
    return "".join(pieces).encode("ascii", "replace").decode()


def _by_name(error: UnicodeError) -> tuple[str, int]:
    """An error handler for streams: what they cannot write, in ASCII."""
    assert isinstance(error, UnicodeEncodeError)
    return ascii_text(error.object[error.start : error.end]), error.end


codecs.register_error("jkroll-ascii", _by_name)


def fitting(text: str, out: TextIO) -> str:
    """A text as the stream can write it: unchanged, or in ASCII."""
    try:
        text.encode(out.encoding or "utf-8")
    except (UnicodeEncodeError, LookupError):
        return ascii_text(text)
    return text


def json_text(value: Any, out: TextIO) -> str:
    """A value as JSON, with other than ASCII characters only where the stream takes them all."""
    import json

    return json.dumps(value, ensure_ascii=(out.encoding or "utf-8").lower() != "utf-8", indent=2)


def say(text: str, out: TextIO) -> None:
    """Print a line, in one piece: a stream that is cut off, by whatever, ends with a whole line."""
    out.write(fitting(text, out) + "\n")


def columns() -> int:
    """Width of the terminal: what the variable COLUMNS says, else what the terminal does, else 80."""
    stated = os.environ.get("COLUMNS", "")
    if stated.isascii() and stated.isdigit() and int(stated[:9]):
        return int(stated[:9])
    try:
        return os.get_terminal_size(sys.__stdout__.fileno()).columns or 80  # type: ignore[union-attr]
    except (AttributeError, ValueError, OSError):
        return 80


MAX_WORD = 80  # a longer one is no slip of a finger, and comparing it takes long


def closest(word: str, known: Iterable[str], cutoff: float = 0.6) -> str | None:
    """The known word that differs from this one only by case, else the most similar one.

    >>> closest("Quartz", ["quartz", "iron"]), closest("quarz", ["quartz", "iron"]), closest("x", ["quartz"])
    ('quartz', 'quartz', None)
    """
    if len(word) > MAX_WORD:
        return None
    from difflib import get_close_matches

    words = list(known)
    same = [candidate for candidate in words if candidate.casefold() == word.casefold()]
    return next(iter(same or get_close_matches(word, words, n=1, cutoff=cutoff)), None)


MAX_QUOTED = 200


def quoted(text: str, limit: int = MAX_QUOTED) -> str:
    r"""A user's text in quotes, as it can be shown.

    >>> quoted("a\x1b[31m\u202e")
    "'a?[31m?'"
    """
    return f"'{shown(text, limit)}'"


def shown(text: str, limit: int = MAX_QUOTED) -> str:
    """A user's text without the characters that would move the cursor or reverse the line, and not too long."""
    text = text if len(text) <= limit else text[:limit] + "..."
    if text.isprintable():
        return text
    return "".join(character if character.isprintable() else "?" for character in text)
