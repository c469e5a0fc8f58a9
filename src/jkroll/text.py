"""Text for people and programs: ASCII, JSON, numbers, wrapped lines, similar words, quotes, lists and tables."""

import codecs
import os
import sys
from collections.abc import Collection, Iterable, Sequence
from itertools import compress
from typing import Any, NamedTuple, TextIO

_ASCII = {
    "γ": "gamma", "δ": "delta", "μ": "mu", "ν": "nu", "ρ": "rho", "ξ": "xi", "π": "pi", "ω": "omega", "Ω": "Omega",
    "α": "alpha",
    "Δ": "Delta", "θ": "theta", "κ": "kappa", "λ": "lambda", "σ": "sigma", "Φ": "Phi", "φ": "phi", "τ": "tau", "ü": "u",
    "µ": "u", "√": "sqrt", "∛": "cbrt", "⟨": "<", "⟩": ">", "⁰": "^0", "¹": "^1", "²": "^2", "³": "^3", "⁴": "^4",
    "⁵": "^5", "⁻": "^-", "₁": "_1", "₂": "_2", "₀": "0", "½": "1/2 ", "¼": "1/4 ", "â": "ahat",
    "𝒜": "A", "Å": "angstrom", "\u0302": "hat", "−": "-", "–": "-", "—": "-", "·": "*", "×": "x", "≪": "<<", "≥": ">=",
    "─": "-", "≤": "<=", "±": "+/-", "≈": "~", "→": "->", "∞": "inf", "°": " deg",
}  # fmt: skip

LETTERS = {name: letter for letter, name in _ASCII.items() if len(name) > 1 and name.isalpha()}  # by name


def ascii_text(text: str) -> str:
    """Return a text in ASCII: Greek letters become names, apart from other letters; unknown characters become "?".

    >>> ascii_text("P_c = 3πγR, 50 µm")
    'P_c = 3 pi gamma R, 50 um'
    """
    if text.isascii():
        return text
    pieces = [""]
    for character in text:
        piece = _ASCII.get(character, character)
        is_spelt = len(piece) > 1 and piece.isalpha()
        was_spelt = len(pieces[-1]) > 1 and pieces[-1].isalpha()
        if pieces[-1][-1:].isalnum() and (is_spelt or (was_spelt and character.isalpha())):
            pieces.append(" ")
        pieces.append(piece)
    return "".join(pieces).encode("ascii", "replace").decode()


def composed(text: str) -> str:
    """Return a text with combined accents, and usual letters instead of wide or joined ones; ² and ① are kept.

    >>> composed("1㎚"), composed("A\u030a"), composed("１（ｍ²）"), composed("5①")
    ('1nm', 'Å', '1(m²)', '5①')
    """
    if text.isascii():
        return text
    from unicodedata import category, decomposition, normalize

    letters = normalize("NFC", text)
    composed_letters = []
    for letter in letters:
        is_kept = category(letter) == "No" or decomposition(letter)[:3] in ("<su", "<ci")
        composed_letters.append(letter if is_kept else normalize("NFKC", letter))
    return "".join(composed_letters)


def _replace(error: UnicodeError) -> tuple[str, int]:
    """Return the ASCII text for characters that a stream cannot encode, and the position after them, for `codecs`."""
    assert isinstance(error, UnicodeEncodeError)
    text, start, end = error.object, error.start, error.end
    before, after = text[start - 1 : start], text[end : end + 1]
    if not before.isascii():
        before = ""
    if not after.isascii():
        after = ""
    replaced = ascii_text(before + text[start:end] + after)  # the neighbours decide the spaces around a Greek letter
    return replaced[len(before) : len(replaced) - len(after)], end


codecs.register_error("jkroll-ascii", _replace)


def json_text(value: Any, out: TextIO) -> str:
    """Return a value as JSON; characters outside ASCII are escaped unless the stream is in UTF-8.

    Raises ValueError for a number that is not finite.
    """
    from json import dumps

    is_utf_8 = (out.encoding or "utf-8").lower() == "utf-8"
    return dumps(value, indent=2, ensure_ascii=not is_utf_8, allow_nan=False)


def spelled(number: float) -> str:
    """Return the shortest text of a finite double that reads back exactly, spelled as by orjson.

    >>> spelled(1e-07), spelled(4.999999999999999e-05), spelled(100.0), spelled(1e22)
    ('1e-7', '0.00004999999999999999', '100.0', '1e22')
    """
    text = repr(number)
    if "e" not in text:
        return text
    mantissa, _, exponent = text.partition("e")
    if int(exponent) != -5:
        return f"{mantissa}e{int(exponent)}"
    sign = "-" if number < 0 else ""
    return f"{sign}0.0000{mantissa.removeprefix('-').replace('.', '')}"


def say(text: str, out: TextIO) -> None:
    """Write a line in a single call, so that interrupted output ends with a whole line."""
    out.write(text + "\n")


def say_wrapped(text: str, out: TextIO, indent: int = 2) -> None:
    """Write a sentence as one line; on a terminal it is wrapped, and its later lines are indented."""
    if out.isatty() and len(text) > terminal_width():
        text = "\n".join(wrapped(text, terminal_width(), indent))
    say(text, out)


NO_BREAK_SPACE = "\N{NO-BREAK SPACE}"


def wrapped(text: str, width: int, indent: int = 0) -> list[str]:
    """Return a sentence as wrapped lines, indented from the second on.

    A line never ends where `with_units_joined` puts a no-break space.

    >>> wrapped("load 0 N", 5), wrapped("load P = 0 N", 9, 2)
    (['load', '0 N'], ['load', '  P = 0 N'])
    """
    from textwrap import wrap

    lines = wrap(
        with_units_joined(text), width, subsequent_indent=" " * indent, break_long_words=False, break_on_hyphens=False
    )
    return [line.replace(NO_BREAK_SPACE, " ") for line in lines]


def with_units_joined(text: str) -> str:
    """Return a text with no-break spaces between a number and a word, in N m, around = and ±, and before "(--option)".

    >>> with_units_joined("M [fN m] is 5 fN m, 0.3 % less").replace(NO_BREAK_SPACE, "_")
    'M [fN_m] is 5_fN_m, 0.3_% less'
    """
    import re

    joined = re.sub(r"(?<=\d) (?=[^\W\d]|%)| (?=[=±]|(?:load )?\(--)|(?<= [=±]) ", NO_BREAK_SPACE, text)
    return re.sub(r"(?<=[NJg]) (?=m(?:\b|[²^/]))", NO_BREAK_SPACE, joined)  # N m, kg m²


def width_of(text: str) -> int:
    """Return the width of a text on a terminal: a wide letter counts 2, a combining mark 0.

    >>> width_of("P_c"), width_of("δ\u0302"), width_of("石英")
    (3, 1, 4)
    """
    if text.isascii():
        return len(text)
    from unicodedata import combining, east_asian_width

    width = 0
    for letter in text:
        if not combining(letter):
            width += 2 if east_asian_width(letter) in "WF" else 1
    return width


MAX_SIZE = 1000  # characters; wider tables and pictures might not fit into memory


def terminal_width() -> int:
    """Return the width of the terminal: the variable COLUMNS, or the terminal's own width, or 80; at most MAX_SIZE."""
    stated = os.environ.get("COLUMNS", "")
    try:  # shutil has a function for this, but importing it takes a tenth of the time of a call
        width = int(stated) if stated.isdecimal() else 0
        columns = width or os.get_terminal_size(sys.__stdout__.fileno()).columns  # type: ignore[union-attr]
    except (AttributeError, ValueError, OSError):
        columns = 0
    return min(columns or 80, MAX_SIZE)


MAX_WORD = 80  # characters; a longer word is not a misspelling, and comparing it would take long


def closest(word: str, known: Iterable[str], cutoff: float = 0.6) -> str | None:
    """Return the known word that differs only by case, else the most similar one; None if none is similar.

    >>> closest("Quartz", ["quartz", "iron"]), closest("quarz", ["quartz", "iron"]), closest("x", ["quartz"])
    ('quartz', 'quartz', None)
    """
    if len(word) > MAX_WORD:
        return None
    from difflib import get_close_matches

    words = list(known)
    same = [candidate for candidate in words if candidate.casefold() == word.casefold()]
    if same:  # MPA is closer to MPa than to mPa
        return min(same, key=lambda candidate: sum(map(str.__ne__, candidate, word)))
    similar = get_close_matches(word, words, n=1, cutoff=cutoff)
    return similar[0] if similar else None


MAX_QUOTED = 200


def quoted(text: str, limit: int = MAX_QUOTED) -> str:
    r"""Return a user's text in quotes, shortened and safe to print.

    >>> quoted("a\x1b[31m\u202e")
    "'a?[31m?'"
    """
    return f"'{shown(text, limit)}'"


def shown(text: str, limit: int = MAX_QUOTED) -> str:
    """Return a user's text shortened, with a question mark for each character that is not printable."""
    if len(text) > limit:
        text = text[:limit] + "..."
    if text.isprintable():
        return text
    return "".join(letter if letter.isprintable() else "?" for letter in text)


def for_terminal(text: str) -> str:
    r"""Return lines from a file for a terminal, with a question mark for each character that is not printable.

    Tabs, line ends and blanks of any width are kept; each line ends with a line feed alone.

    >>> for_terminal("a\tb\r\nc\u00a0\x1b[31m\u202e\n")
    'a\tb\nc\xa0?[31m?\n'
    """
    text = text.replace("\r\n", "\n")
    if text.replace("\n", "").replace("\t", "").isprintable():
        return text
    shown_letters = []
    for letter in text:
        is_kept = letter in "\n\t" or letter.isprintable() or _is_blank(letter)
        shown_letters.append(letter if is_kept else "?")
    return "".join(shown_letters)


def _is_blank(letter: str) -> bool:
    from unicodedata import category

    return category(letter) == "Zs"


def capital(text: str) -> str:
    """Return a text with a capital first letter.

    >>> capital("rough spheres"), capital("")
    ('Rough spheres', '')
    """
    return text[:1].upper() + text[1:]


def listed(texts: Iterable[str], word: str = "and") -> str:
    """Return texts as an enumeration: separated by commas, with a word before the last.

    >>> listed(["a"]), listed(["a", "b"]), listed(["a", "b", "c"], "or")
    ('a', 'a and b', 'a, b or c')
    """
    *others, last = texts
    return f"{', '.join(others)} {word} {last}" if others else last


def first_of(texts: Sequence[str], most: int = 3) -> str:
    """Return the first few texts, separated by commas, and the number of the others.

    >>> first_of(["a", "b", "c"]), first_of(["a", "b", "c"], 1)
    ('a, b, c', 'a and 2 more')
    """
    first, others = ", ".join(texts[:most]), len(texts) - most
    return f"{first} and {others} more" if others > 0 else first


def ending(path: str) -> str:
    """Return the extension of a file name, in lower case and without the dot.

    >>> ending("a/Map.SVG"), ending("svg")
    ('svg', '')
    """
    _, point, end = path.rpartition(".")
    return end.casefold() if point else ""


# --- Tables -----------------------------------------------------------------------------------------------------------

_GAP = 2  # blanks between columns
_LEAST_TEXT = 24  # least width of a wrapped text


class TextColumn(NamedTuple):
    """A column of texts."""

    head: str
    cells: Sequence[str]
    is_right: bool = True  # aligned to the right, as numbers are


def html_table(columns: Sequence[TextColumn]) -> str:
    """Return columns as an HTML table, each aligned to the right or to the left.

    >>> html_table([TextColumn("<x>", ["1"])]).splitlines()[1]
    '<tr><th style="text-align:right">&lt;x&gt;</th></tr>'
    """
    from html import escape

    cells = []
    for column in columns:
        style = f'style="text-align:{"right" if column.is_right else "left"}"'
        head = f"<th {style}>{escape(column.head)}</th>"
        cells.append([head, *(f"<td {style}>{escape(text)}</td>" for text in column.cells)])
    rows = [f"<tr>{''.join(row)}</tr>" for row in zip(*cells, strict=True)]
    return "\n".join(["<table>", *rows, "</table>"])


def as_arguments(text: str) -> str:
    """Return a sentence with the names of arguments instead of options.

    >>> as_arguments("assumed: z0 = 400 pm (--z0), E = 1 GPa (--young2)")
    'assumed: z0 = 400 pm (z0), E = 1 GPa (young2)'
    """
    import re

    return re.sub(r"(?<![\w-])--([a-z][a-z0-9-]*)", lambda match: match[1].replace("-", "_"), text)


def write_table(
    leading: Sequence[TextColumn],
    columns: Sequence[TextColumn],
    out: TextIO,
    trailing: Sequence[TextColumn] = (),
    silent: Collection[str] = ("", "–"),
) -> None:
    """Write columns between leading and trailing ones, in as many tables as the width of the terminal requires.

    Tables after the first leave out rows in which all cells of the remaining columns are `silent`. If there are
    trailing columns, each later table with enough room repeats the first of `columns`, for comparison.
    """
    if not columns:
        say("\n".join(_lines(leading, _GAP if fit_terminal(leading) else 1)), out)
    repeated = columns[:1] if trailing else []
    while columns:
        room = terminal_width() + _GAP - _size([*leading, *trailing])
        number = _number_within(room, columns)
        say("\n".join(_lines([*leading, *columns[:number], *trailing])), out)
        columns = columns[number:]
        rows = zip(*(column.cells for column in columns), strict=True)
        kept = [not {*cells} <= {*silent} for cells in rows]
        leading, columns = _with_rows(leading, kept), _with_rows(columns, kept)
        trailing, repeated = _with_rows(trailing, kept), _with_rows(repeated, kept)
        if columns:
            say("", out)
            if fit_terminal([*leading, *repeated, columns[0], *trailing]):
                columns = [*repeated, *columns]


def _number_within(room: int, columns: Iterable[TextColumn]) -> int:
    """Return the number of columns that fit a width; at least 1."""
    number = 0
    for column in columns:
        room -= _size([column])
        if room < 0:
            break
        number += 1
    return max(number, 1)


def _with_rows(columns: Iterable[TextColumn], kept: Sequence[bool]) -> list[TextColumn]:
    """Return columns with some of their rows."""
    return [column._replace(cells=[*compress(column.cells, kept)]) for column in columns]


def write_texts(heads: Sequence[str], rows: Iterable[Sequence[str]], out: TextIO) -> None:
    """Write rows of texts as a table; a row that is wider than the terminal continues below its last column."""
    columns = text_columns([heads, *rows], words=len(heads))
    for line in _lines(columns):
        say_wrapped(line, out, min(_size(columns[:-1]), terminal_width() - _LEAST_TEXT))


def text_columns(rows: Iterable[Sequence[str]], *, words: int) -> list[TextColumn]:
    """Return the columns of rows; the first row has the heads. `words`: the number of leading columns with words."""
    columns = []
    for position, (head, *cells) in enumerate(zip(*rows, strict=True)):
        columns.append(TextColumn(head, cells, is_right=position >= words))
    return columns


def _lines(columns: Iterable[TextColumn], gap: int = _GAP) -> list[str]:
    """Return the lines of a table: heads, a rule and rows. `gap`: the number of blanks between columns."""
    lines = [(" " * gap).join(cells) for cells in zip(*map(padded, columns), strict=True)]
    head, *rows = map(str.rstrip, lines)
    return [head, "─" * min(width_of(lines[0]), terminal_width()), *rows]


def padded(column: TextColumn) -> list[str]:
    """Return the head and the cells of a column, padded to the same width."""
    texts = [column.head, *column.cells]
    width = max(map(width_of, texts))
    cells = []
    for text in texts:
        blanks = " " * (width - width_of(text))
        cells.append(blanks + text if column.is_right else text + blanks)
    return cells


def fit_terminal(columns: Iterable[TextColumn]) -> bool:
    """Return whether a table of these columns fits the width of the terminal."""
    return _size(columns) <= terminal_width() + _GAP


def _size(columns: Iterable[TextColumn]) -> int:
    """Return the width of columns on a terminal, including the blanks after each column."""
    return sum(width_of(padded(column)[0]) + _GAP for column in columns)
