"""Layouts of text tables: cells between blanks, comments, dumps of LAMMPS, row names of R, and rows of units.

A dump has several items above the names of its columns, which are without units. Other programs write comments, and
the last of these may be the header. R writes no name above its row names.
"""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import takewhile
from typing import NamedTuple

from ..errors import BadTable
from ..quantities.units import is_in_table
from ..quantities.values import unit_of
from ..text import quoted
from .cells import PLUS_MINUS
from .header import typed
from .reading import UNREAD, Reading, normalized, reading_of
from .unit_spellings import unit_for
from .words import MATERIALS

BYTES = "latin-1"  # a character for each byte, since the csv module reads characters
SAMPLE = 200  # lines or rows that decide how a table is read
_COMMENT = re.compile(r"\A(?:[ \t]*#+ *|sep=)", re.IGNORECASE)  # the mark of a line above the header
_MARK = re.compile(rb"^[ \t]*(#+)[ \t]+", re.MULTILINE)  # the mark of a comment

# --- Blanks as separators ---------------------------------------------------------------------------------------------

# Few tables need this pattern and others below, so they are compiled on first use.
# A cell, in order of preference: in quotes, where \" (the default of R) or "" stands for a quote; in quotes, where a
# backslash stands for itself; without quotes.
_CELL = rb'"(?:[^"\\]++|\\.|"")*+"(?!\S)|"[^"]*+"(?!\S)|[^\s"]\S*'


def with_tabs(blocks: Iterable[bytes]) -> Iterator[bytes]:
    """Iterate over the blocks, with the blanks between cells replaced by tabs. Raises BadTable."""
    line = 0
    for block in blocks:
        yield tabbed(block, line)
        line += block.count(b"\n")


def tabbed(block: bytes, line: int = 0) -> bytes:
    """Return a block, with the blanks between cells replaced by tabs.

    Raises BadTable for a quote that is not closed in its line. `line`: the number of lines above the block.
    """
    lines = _MARK.sub(rb"\1", block).split(b"\n")
    if b'"' not in block:
        return b"\n".join(b"\t".join(text.split()) for text in lines)
    return b"\n".join(b"\t".join(_cells(text, number)) for number, text in enumerate(lines, line + 1))


def _cells(line: bytes, number: int) -> list[bytes]:
    """Return the cells of a line with their quotes. `number`: the number of the line. Raises BadTable."""
    if b'"' not in line or line.startswith(b"#"):
        return line.split()
    cells = re.findall(_CELL, line)
    if b"".join(b"".join(cells).split()) != b"".join(line.split()):
        raise BadTable(
            f"line {number}: a quote is not closed in {quoted(line.decode(errors='replace').strip())}. Between blanks, "
            "text in quotes ends in its line: write tabs between the columns, and --format tsv"
        )
    return [*map(_with_double_quotes, cells)]


def _with_double_quotes(cell: bytes) -> bytes:
    r"""Return a cell with "" in place of \". The last quote closes the cell, even after a backslash."""
    return cell[:-1].replace(rb"\"", b'""') + b'"' if cell.startswith(b'"') else cell


# --- Dumps of LAMMPS --------------------------------------------------------------------------------------------------

_DUMP = rb"ITEM: (TIMESTEP|TIME|UNITS|ATOMS|ENTRIES)\b"
_NO_COLUMNS = rb"ITEM: (TIMESTEP|TIME|UNITS|NUMBER|BOX|DIMENSION|GRID SIZE)\b"
_COLUMNS = rb"ITEM: \S+\s*"


def is_dump(block: bytes) -> bool:
    """Return whether a text begins like a dump of LAMMPS or LIGGGHTS."""
    return block.startswith(b"ITEM: ") and re.match(_DUMP, block) is not None


def as_table(blocks: Iterable[bytes], path: str, compression: str) -> Iterator[bytes]:
    """Iterate over the blocks of a dump as those of a table: items become comments, the names of columns the header.

    `path`, `compression`: of the file, for messages. Raises BadTable for several time steps, or a wrong number of rows.
    """
    rows, above, line = 0, 0, 0  # rows so far, lines above the first row, lines above the block
    count, number = 0, 0  # the stated number of rows, and the line that states it
    for block in blocks:
        lines = block.split(b"\n")
        if not line:
            position = _line_of_columns(lines)
            above = position + 1
            count, number = _stated_rows(lines[:position])
            items = [b"# " + item for item in lines[:position]]
            lines[:above] = [*items, re.sub(_COLUMNS, b"", lines[position], count=1)]
        below = lines[max(above - line, 0) :]
        for position, text in enumerate(below, max(line, above) + 1):
            if text.startswith(b"ITEM: "):
                raise BadTable(_several_steps(position, text, path, compression))
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
    """Return the number of rows that the items of a dump state, and the line that states it; 0 and 0 if none does."""
    for position, line in enumerate(items[:-1], 1):
        if line.startswith(b"ITEM: NUMBER OF") and items[position].strip().isdigit():
            return int(items[position]), position + 1
    return 0, 0


def _several_steps(number: int, line: bytes, path: str, compression: str) -> str:
    """Return the error message for a dump with a second time step, from the line that begins it."""
    item = line.decode(errors="replace").strip()
    item = item if item == "ITEM: TIMESTEP" else f"{item}$"
    program = {"gzip": "zcat", "zstd": "zstdcat"}.get(compression, "")
    source = f"{program} {quoted(path)} | csplit -z -" if program else f"csplit -z {quoted(path)}"
    return (
        f"line {number} begins a second time step, but a table can have only one. Write {source} '/{item}/' '{{*}}', "
        "and then jkroll batch 'xx*' -o DIRECTORY/"
    )


# --- Above the header -------------------------------------------------------------------------------------------------


def header_position(lines: Sequence[str], separator: str, is_read: Callable[[str], bool]) -> int:
    """Return the number of lines above the header: comments, and a line such as `sep=;`, which names a separator.

    The first line below the comments is the header if it has a column to read; otherwise, the last comment with such a
    column is. If no line has a column to read, the last comment can still be the header: there must be blanks or tabs
    between the cells, and the line below must have a number for each cell of the comment.
    """
    count = len([*takewhile(_COMMENT.match, lines[:SAMPLE])])
    rows = []
    for line in lines[: count + 1]:
        text = text_of(bare(line)).strip()
        rows.append([cell.strip('"') for cell in text.split(separator)])
    for position in (count, *reversed(range(count))):
        if position < len(rows) and any(map(is_read, rows[position])):
            return position
    numbers = rows[count] if separator == "\t" and 0 < count < len(rows) else []
    are_numbers = bool(numbers) and all(map(_NUMBER.match, numbers)) and len(numbers) == len(rows[count - 1])
    return count - 1 if are_numbers else count


def text_of(cell: str) -> str:
    """Return the text of a cell that was read with a character for each byte."""
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
    """A row below the header, with a character for each byte: its cells, its text, and the number of its first line."""

    cells: Sequence[str]
    line: str
    number: int

    @property
    def last(self) -> int:
        """The number of the last line of the row; a cell in quotes may have several lines."""
        return self.number - 1 + self.line.count("\n") + (not self.line.endswith("\n"))

    def without_mark(self) -> "Row":
        """Return the row without the mark of lines above the header."""
        return Row([bare(self.cells[0]), *self.cells[1:]], bare(self.line), self.number) if self.cells else self


def unnamed_column(names: Sequence[str], rows: Sequence[Row], word: str, is_read: Callable[[str], bool]) -> str:
    """Return FIRST or LAST for a column without a name in the header; "" in other cases.

    `rows`: the first rows, none with as many cells as there are names; `word`: the name of the separator.

    R writes no name above the row names, which are in quotes, unlike numbers. Other programs end each row with a
    separator. Raises BadTable if all rows have the same wrong number of cells for another reason.
    """
    sizes, width = {len(row.cells) for row in rows}, len(names)
    if len(sizes) != 1:
        return ""
    size, number = sizes.pop(), rows[0].number
    if size == width + 1:
        if not any(row.cells[-1].strip() for row in rows):
            return LAST
        if _are_row_names(rows):
            return FIRST
    if size > width and not any(map(is_read, names)) and any(is_read(text_of(cell)) for cell in rows[0].cells):
        title = quoted(" ".join(names))
        raise BadTable(f"header: {title} is not a header, but line {number} may be: write # before all lines above it")
    remedy = remedy_of_size(size, width, word)
    if size == width + 1:
        remedy = "name each column in the header; R does with write.table(..., col.names = NA)"
    elif size < width and word == "blank":
        remedy = 'write a name with a blank in quotes, as in "radius [nm]"'
    raise BadTable(f"header: it has {in_cells(width)}, but each row, from line {number} on, has {size}: {remedy}")


def _are_row_names(rows: Sequence[Row]) -> bool:
    """Return whether the first cells of rows are row names: in quotes and all different, next to numbers."""
    has_numbers = False
    for row in rows:
        if not row.line.lstrip(" ").startswith('"'):
            return False
        has_numbers |= re.search(r"\d", re.sub(r'"[^"]*"', "", row.line)) is not None
    return has_numbers and len({row.cells[0] for row in rows}) == len(rows)


def in_cells(size: int) -> str:
    """Return a number of cells as a phrase: 1 cell, 2 cells."""
    return f"{size} {'cell' if size == 1 else 'cells'}"


def remedy_of_size(size: int, width: int, word: str) -> str:
    """Return the remedy for a row of `size` cells below a header of `width`. `word`: the name of the separator."""
    if size > width:
        return f"write text with a {word} in quotes"
    return 'write "" for an empty cell' if word == "blank" else f"write a {word} for each empty cell"


# --- Rows of units ----------------------------------------------------------------------------------------------------

_NUMBER = re.compile(r"\s*[-+−]?[\d.,]")  # the beginning of a number
_IN_BRACKETS = r"\[([^\[\]]*)\]|\(([^()]*)\)"
_NO_UNIT = ("", "-", "--", "–", "—")
# The first cells of the rows that Origin writes below its header.
_REMARKS = {"comment", "comments", "f(x)", "long name", "parameters", "sampling interval", "sparklines"}


class Headers(NamedTuple):
    """The headers of columns and the meanings given by `--column`, both with the units from the row of units."""

    names: tuple[str, ...]
    stated: Mapping[str, str]


class _Heading(NamedTuple):
    """The meaning of a header together with the cell below it, which may be part of a row of units."""

    name: str  # the header, with the unit if the cell adds it
    role: str  # the role of the cell below
    meaning: str = ""  # the meaning that `--column` gives, if the cell adds the unit


_A_UNIT, _ANOTHER_UNIT, _OTHER_TEXT, _NO_ROW_OF_UNITS = "unit", "another unit than the header", "text", "anything else"


def with_units(names: Sequence[str], row: Row, stated: Mapping[str, str], measured: str) -> Headers | None:
    """Return headers with the units in a row below; None if the row is not clearly a row of units.

    A row of units has no numbers, and its cells in columns to read are units or empty. `stated`: the meanings that
    `--column` gives headers; `measured`: see `reading_of`.

    Raises BadTable if a header and the row state different units.
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


def _below(name: str, text: str, stated: Mapping[str, str], measured: str) -> _Heading:
    """Return the meaning of a header together with the cell below it."""
    unit = _without_brackets(text)
    mark = PLUS_MINUS.match(unit)
    if mark and not normalized(name):
        name, unit = "±", unit[mark.end() :]  # as in ± nm
    if unit in _NO_UNIT:
        return _Heading(name, _OTHER_TEXT)
    whole = f"{name.strip()} [{unit}]"
    if typed(name) not in stated and typed(whole) in stated:  # as an earlier message suggested
        name = whole
    is_stated, meaning = typed(name) in stated, stated.get(typed(name), name)
    reading, with_unit = reading_of(meaning, measured), reading_of(f"{meaning} [{unit}]", measured)
    if unit == "1" and not with_unit.unit_text:
        return _Heading(name, _NO_ROW_OF_UNITS)
    if reading.unit_text:
        role = _role_of_unit(unit, reading) or _NO_ROW_OF_UNITS
        if is_stated:
            role = _OTHER_TEXT if role == _NO_ROW_OF_UNITS else _A_UNIT
        return _Heading(name, role)
    if meaning.strip() and with_unit.unit_text:
        return _Heading(name, _A_UNIT, f"{meaning} [{unit}]") if is_stated else _Heading(whole, _A_UNIT)
    if _is_read(reading):
        return _Heading(name, _NO_ROW_OF_UNITS)
    if normalized(name) and is_in_table(unit) and not re.search(r"[\[(]", name) and not is_stated:
        name = whole  # another quantity, with its unit
    return _Heading(name, _OTHER_TEXT)


def _is_number(cell: str) -> bool:
    """Return whether a cell begins with a number, other than a lone 1, which may be the unit of a ratio."""
    unit = _without_brackets(cell)
    return unit != "1" and unit not in _NO_UNIT and _NUMBER.match(unit) is not None


def _role_of_unit(text: str, reading: Reading) -> str:
    """Return the role of a cell below a header with a unit; "" if the cell is not a unit of the header's quantity."""
    if text == reading.unit_text:
        return _A_UNIT
    unit = unit_for(text, reading.name) if reading.name else ""
    if not unit:
        return ""
    texts = {unit, reading.unit_text}
    if texts.isdisjoint(("1", "-")):
        is_same = unit_of(unit, reading.name) == unit_of(reading.unit_text, reading.name)
    else:
        is_same = texts == {"1", "-"}
    return _A_UNIT if is_same else _ANOTHER_UNIT


def _is_read(reading: Reading) -> bool:
    """Return whether a header without a unit is that of a column of numbers to read."""
    is_number = reading.is_input and not reading.is_symbol and reading.name not in MATERIALS
    return is_number or reading.part not in ("", UNREAD)


def _without_brackets(cell: str) -> str:
    """Return a cell without the brackets around it."""
    text = cell.strip()
    found = re.fullmatch(_IN_BRACKETS, text) if text.startswith(("[", "(")) else None
    return (found[1] or found[2] or "").strip() if found else text


def is_remark(row: Row, names: Sequence[str]) -> bool:
    """Return whether a row below the header is empty, or labelled as a comment and without numbers."""
    label, *others = (cell.strip() for cell in row.cells)
    is_labelled = label.casefold().rstrip(":=") in _REMARKS and not any(map(_NUMBER.match, others))
    return len(row.cells) == len(names) and (is_labelled or not any([label, *others]))
