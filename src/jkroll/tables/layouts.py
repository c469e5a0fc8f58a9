"""Layouts of tables made of lines: comments above the header, dumps of LAMMPS, row names of R, and rows of units.

A dump has a few items above its columns, and no units. Other programs write comments, and the last comment may be the
header. R writes no name above its row names.
"""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import takewhile
from typing import NamedTuple

from ..errors import BadTable
from ..quantities.units import is_in_table
from ..quantities.values import unit_of
from ..text import quoted
from .header import typed
from .reading import UNREAD, Reading, reading_of
from .words import MATERIALS, unit_for

BYTES = "latin-1"  # one character for each byte, since the csv module reads characters
SAMPLE = 200  # lines or rows that decide how a table is read
_COMMENT = re.compile(r"\A(?:[ \t]*#+ *|sep=)", re.IGNORECASE)  # the mark of a line above the header
_MARK = re.compile(rb"^[ \t]*(#+)[ \t]+", re.MULTILINE)  # the mark of a comment

# --- Blanks as separators ---------------------------------------------------------------------------------------------

# Patterns that few tables need are compiled on first use.
# A cell in quotes, with a quote as \" (the default of R) or ""; in quotes with other backslashes; without quotes.
_CELL = rb'"(?:[^"\\]++|\\.|"")*+"(?!\S)|"[^"]*+"(?!\S)|[^\s"]\S*'


def between_tabs(blocks: Iterable[bytes]) -> Iterator[bytes]:
    """Iterate over blocks with tabs instead of blanks. Raises BadTable."""
    line = 0
    for block in blocks:
        yield tabbed(block, line)
        line += block.count(b"\n")


def tabbed(block: bytes, line: int = 0) -> bytes:
    """Return a block with tabs instead of blanks. Raises BadTable for a quote that is not closed in its line.

    `line`: the number of lines above the block.
    """
    lines = _MARK.sub(rb"\1", block).split(b"\n")
    if b'"' not in block:
        return b"\n".join(b"\t".join(each.split()) for each in lines)
    return b"\n".join(b"\t".join(_cells(each, line + position)) for position, each in enumerate(lines, 1))


def _cells(line: bytes, number: int) -> list[bytes]:
    """Return the cells of a line, which keep their quotes. `number`: of the line, from 1. Raises BadTable."""
    if b'"' not in line or line.startswith(b"#"):
        return line.split()
    cells = re.findall(_CELL, line)
    if b"".join(b"".join(cells).split()) != b"".join(line.split()):
        raise BadTable(
            f"line {number}: a quote is not closed in {quoted(line.decode(errors='replace').strip())}. Between blanks, "
            "text in quotes ends in its line: write tabs between the columns, and --format tsv"
        )
    return [cell[:-1].replace(rb"\"", b'""') + b'"' if cell.startswith(b'"') else cell for cell in cells]


# --- Dumps of LAMMPS --------------------------------------------------------------------------------------------------

_DUMP = rb"ITEM: (TIMESTEP|TIME|UNITS|ATOMS|ENTRIES)\b"
_NO_COLUMNS = rb"ITEM: (TIMESTEP|TIME|UNITS|NUMBER|BOX|DIMENSION|GRID SIZE)\b"
_COLUMNS = rb"ITEM: \S+\s*"


def is_dump(block: bytes) -> bool:
    """Return whether a text begins like a dump of LAMMPS or LIGGGHTS."""
    return block.startswith(b"ITEM: ") and re.match(_DUMP, block) is not None


def as_table(blocks: Iterable[bytes], path: str, compression: str) -> Iterator[bytes]:
    """Iterate over the blocks of a dump, with its items as comments and its columns as header.

    `path`, `compression`: of its file. Raises BadTable for several time steps, or a wrong number of rows.
    """
    rows, above, line = 0, 0, 0  # rows so far, lines above the first row, lines above the block
    count, number = 0, 0  # the stated number of rows, and the line with it
    for block in blocks:
        lines = block.split(b"\n")
        if not line:
            position = _line_of_columns(lines)
            above = position + 1
            count, number = _stated_rows(lines[:position])
            lines[:above] = [
                *(b"# " + each for each in lines[:position]),
                re.sub(_COLUMNS, b"", lines[position], count=1),
            ]
        below = lines[max(above - line, 0) :]
        for step, each in enumerate(below):
            if each.startswith(b"ITEM: "):
                raise BadTable(_several_steps(max(line, above) + step + 1, each, path, compression))
        rows += sum(map(bool, map(bytes.strip, below)))
        line += len(lines) - 1
        yield b"\n".join(lines)
    if number and rows != count:
        problem = "the end of the dump is missing" if rows < count else "there are extra lines"
        raise BadTable(
            f"line {number} says {count} rows, and there are {rows}: {problem}. Write {rows} there to read them"
        )


def _line_of_columns(lines: Sequence[bytes]) -> int:
    """Return the index of the line that names the columns of a dump. Raises BadTable."""
    for position, line in enumerate(lines[:SAMPLE]):
        if line.startswith(b"ITEM: ") and not re.match(_NO_COLUMNS, line):
            return position
    raise BadTable("the dump has no line such as ITEM: ATOMS id radius: its end is missing")


def _stated_rows(items: Sequence[bytes]) -> tuple[int, int]:
    """Return the number of rows that the items of a dump state, and its line; 0 and 0 without one."""
    for position, line in enumerate(items[:-1], 1):
        if line.startswith(b"ITEM: NUMBER OF") and items[position].strip().isdigit():
            return int(items[position]), position + 1
    return 0, 0


def _several_steps(number: int, line: bytes, path: str, compression: str) -> str:
    """Return the error message for a dump with a second time step."""
    item = line.decode(errors="replace").strip()
    item = item if item == "ITEM: TIMESTEP" else f"{item}$"
    program = {"gzip": "zcat", "zstd": "zstdcat"}.get(compression, "")
    source = f"{program} {quoted(path)} | csplit -z -" if program else f"csplit -z {quoted(path)}"
    return (
        f"line {number} begins a second time step, and a table has one. Write {source} '/{item}/' '{{*}}', and then "
        "jkroll batch 'xx*' -o DIRECTORY/"
    )


# --- Above the header -------------------------------------------------------------------------------------------------


def header_position(lines: Sequence[str], separator: str, is_read: Callable[[str], bool]) -> int:
    """Return the number of lines above the header: comments, and the separator as spreadsheets write it in sep=;.

    The last of these lines that contains columns to read is the header, unless the line below them all does. Between
    blanks or tabs, the last comment is the header if the line below has the same number of numbers.
    """
    count = len([*takewhile(_COMMENT.match, lines[:SAMPLE])])
    texts = [text_of(bare(line)).strip() for line in lines[: count + 1]]
    rows = [[cell.strip('"') for cell in text.split(separator)] for text in texts]
    for position in (count, *reversed(range(count))):
        if position < len(rows) and any(map(is_read, rows[position])):
            return position
    numbers = rows[count] if separator == "\t" and 0 < count < len(rows) else []
    are_numbers = bool(numbers) and all(map(_NUMBER.match, numbers)) and len(numbers) == len(rows[count - 1])
    return count - 1 if are_numbers else count


def text_of(cell: str) -> str:
    """Return a cell as text, decoded from one character for each byte."""
    return cell.encode(BYTES).decode("utf-8", "replace")


def is_comment(line: str) -> bool:
    """Return whether a line has the mark of lines above the header."""
    return _COMMENT.match(line) is not None


def bare(line: str) -> str:
    """Return a line without the mark of lines above the header."""
    return _COMMENT.sub("", line)


# --- Headers with an unnamed column -----------------------------------------------------------------------------------

FIRST, LAST = "the first column has row names", "the last column has no header and is empty"


class Row(NamedTuple):
    """A row below a header: its cells and its line, with one character for each byte, and the number of the line."""

    cells: Sequence[str]
    line: str
    number: int

    @property
    def last(self) -> int:
        """The number of its last line; a cell in quotes may span several."""
        return self.number - 1 + self.line.count("\n") + (not self.line.endswith("\n"))

    def without_mark(self) -> "Row":
        """Return the row without the mark of lines above the header."""
        return Row([bare(self.cells[0]), *self.cells[1:]], bare(self.line), self.number) if self.cells else self


def unnamed_column(names: Sequence[str], rows: Sequence[Row], word: str, is_read: Callable[[str], bool]) -> str:
    """Return which column has no name in the header, FIRST or LAST; an empty text if all have one.

    `rows`: the first rows, none with as many cells as there are names; `word`: the name of the separator. R writes no
    name above row names, which it quotes, unlike numbers. Lines may end with a separator. Raises BadTable if all rows
    have another common number of cells.
    """
    sizes, width = {len(row.cells) for row in rows}, len(names)
    if len(sizes) != 1:
        return ""
    size, number = sizes.pop(), rows[0].number
    if size == width + 1:
        if not any(row.cells[-1].strip() for row in rows):
            return LAST
        of_rows = {row.cells[0] for row in rows}
        are_quoted = all(row.line.lstrip(" ").startswith('"') for row in rows)
        has_numbers = any(re.search(r"\d", re.sub(r'"[^"]*"', "", row.line)) for row in rows)
        if are_quoted and has_numbers and len(of_rows) == len(rows):
            return FIRST
    if size > width and not any(map(is_read, names)) and any(is_read(text_of(cell)) for cell in rows[0].cells):
        title = quoted(" ".join(names))
        raise BadTable(f"header: {title} is not a header, but line {number} may be: write # before all lines above it")
    remedy = remedy_of_size(size, width, word)
    if size == width + 1:
        remedy = "name each column in the header; R does with write.table(..., col.names = NA)"
    elif size < width and word == "blank":
        remedy = 'write a name with a blank in quotes, as in "radius [nm]"'
    raise BadTable(f"header: it has {in_cells(width)}, and each row below, from line {number} on, has {size}: {remedy}")


def in_cells(size: int) -> str:
    """Return a number of cells in words."""
    return f"{size} {'cell' if size == 1 else 'cells'}"


def remedy_of_size(size: int, width: int, word: str) -> str:
    """Return what to do with a row of `size` cells below a header of `width`. `word`: the name of the separator."""
    if size > width:
        return f"write text with a {word} in quotes"
    return 'write "" for an empty cell' if word == "blank" else f"write a {word} for each empty cell"


# --- Rows of units ----------------------------------------------------------------------------------------------------

_NUMBER = re.compile(r"\s*[-+−]?[\d.,]")  # the beginning of a number
_IN_BRACKETS = r"\[([^\[\]]*)\]|\(([^()]*)\)"
_NO_UNIT = ("", "-", "--", "–", "—")
# The first cells of rows that Origin writes below its header.
_REMARKS = {"comment", "comments", "f(x)", "long name", "parameters", "sampling interval", "sparklines"}


class Headers(NamedTuple):
    """The headers of columns with the units of a row below, and the meanings of `--column` with these units."""

    names: tuple[str, ...]
    stated: Mapping[str, str]


class _Cell(NamedTuple):
    """A header and the cell below it, which may belong to a row of units."""

    name: str  # including the unit
    role: str
    meaning: str = ""  # the meaning of a stated column, with the unit in the cell


_A_UNIT, _ANOTHER_UNIT, _NEITHER, _NO_ROW_OF_UNITS = "unit", "another unit than the header", "text", "anything else"


def with_units(names: Sequence[str], row: Row, stated: Mapping[str, str], measured: str) -> Headers | None:
    """Return headers with the units in a row below; None if it is not clearly a row of units.

    A row of units has no numbers, only units of columns to read, or empty cells. `stated`, `measured`: see
    `meaning_of`. Raises BadTable if a header has another unit.
    """
    below = [*map(text_of, row.cells)]
    if len(below) != len(names) or any(map(_is_number, below)):  # as in most tables
        return None
    cells = [_below(name, text, stated, measured) for name, text in zip(names, below, strict=True)]
    roles = {cell.role for cell in cells}
    if _NO_ROW_OF_UNITS in roles or roles.isdisjoint((_A_UNIT, _ANOTHER_UNIT)):
        return None
    for name, text, cell in zip(names, below, cells, strict=True):
        if cell.role == _ANOTHER_UNIT:
            problem = f"{quoted(name)} is above {quoted(text.strip())} in the row of units, line {row.number}"
            raise BadTable(f"header: {problem}: make the two agree, or delete the row")
    meanings = {typed(cell.name): cell.meaning for cell in cells if cell.meaning}
    return Headers(tuple(cell.name for cell in cells), {**stated, **meanings})


def _below(name: str, text: str, stated: Mapping[str, str], measured: str) -> _Cell:
    """Return a header and the cell below it, which may be its unit."""
    unit = _without_brackets(text)
    if unit in _NO_UNIT:
        return _Cell(name, _NEITHER)
    whole = f"{name.strip()} [{unit}]"
    if typed(name) not in stated and typed(whole) in stated:  # as an earlier message suggested
        name = whole
    is_stated, meaning = typed(name) in stated, stated.get(typed(name), name)
    own, with_unit = reading_of(meaning, measured), reading_of(f"{meaning} [{unit}]", measured)
    if unit == "1" and not with_unit.unit_text:
        role = _NO_ROW_OF_UNITS
    elif own.unit_text:
        is_same = _is_unit(unit, own)
        roles = {True: _A_UNIT, False: _ANOTHER_UNIT, None: _NO_ROW_OF_UNITS}
        if is_stated:
            roles = {True: _A_UNIT, False: _A_UNIT, None: _NEITHER}
        role = roles[is_same]
    elif meaning.strip() and with_unit.unit_text:
        return _Cell(name, _A_UNIT, f"{meaning} [{unit}]") if is_stated else _Cell(whole, _A_UNIT)
    else:
        role = _NO_ROW_OF_UNITS if _is_read(own) else _NEITHER
        is_of_other = role == _NEITHER and name.strip() and is_in_table(unit) and not re.search(r"[\[(]", name)
        name = whole if is_of_other and not is_stated else name
    return _Cell(name, role)


def _is_number(cell: str) -> bool:
    """Return whether a cell begins with a number; 1 may be the unit of a ratio."""
    unit = _without_brackets(cell)
    return unit != "1" and unit not in _NO_UNIT and _NUMBER.match(unit) is not None


def _is_unit(text: str, reading: Reading) -> bool | None:
    """Return whether a text is the same unit as in a header; None if it is not a unit of its quantity."""
    if text == reading.unit_text:
        return True
    unit = unit_for(text, reading.name) if reading.name else ""
    if not unit:
        return None
    texts = {unit, reading.unit_text}
    return texts == {"1", "-"} or (
        texts.isdisjoint(("1", "-")) and len({unit_of(text, reading.name) for text in texts}) == 1
    )


def _is_read(reading: Reading) -> bool:
    """Return whether a header without a unit belongs to a column of numbers to read."""
    is_number = reading.is_input and not reading.is_symbol and reading.name not in MATERIALS
    return is_number or reading.part not in ("", UNREAD)


def _without_brackets(cell: str) -> str:
    """Return a cell without enclosing brackets."""
    text = cell.strip()
    found = re.fullmatch(_IN_BRACKETS, text) if text.startswith(("[", "(")) else None
    return (found[1] or found[2] or "").strip() if found else text


def is_remark(row: Row, names: Sequence[str]) -> bool:
    """Return whether a row below the header is a comment: empty, or labelled as one and without numbers."""
    label, *others = (cell.strip() for cell in row.cells)
    is_labelled = label.casefold().rstrip(":=") in _REMARKS and not any(map(_NUMBER.match, others))
    return len(row.cells) == len(names) and (is_labelled or not any([label, *others]))
