"""Force curves from tables: columns of lengths and forces, headed as for `batch`, become arrays in SI units."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain
from typing import Any, NamedTuple

import numpy

from ..errors import BadRequest, BadRow, BadTable, JkrollError
from ..fitting.branches import LOADING, PAUSE, QUANTITIES, UNLOADING, ForceCurve
from ..materials.library import Materials
from ..model.rows import Numbers
from ..quantities.nomenclature import header as head_of
from ..text import first_of, listed, quoted
from .cells import Column, has_no_value
from .dataframes import Memory, data_of
from .files import Input, input_format
from .header import Header, check_has_names, option_of, typed, understood
from .layouts import is_comment
from .opened import opened
from .reading import unit_in
from .table import Asked, Records

# The columns that can give the x of a curve and its force, both in order of preference.
_X = {quantity: kind for kind, quantity in QUANTITIES.items()}
_FORCES = ("load", "lever_force", "lever_deflection")
_DEFLECTION = "lever_deflection"
# The quantities whose columns a curve reads, as `--measured` of `batch` names them.
MEASURED = "contact_radius_at_load,approach_at_load,lever_travel,lever_force,lever_deflection,lever_stiffness"
_SAME = 0.01  # relative range of a column below which all its numbers are the same, except for rounding
_INDICES = ("k", "K")  # headers that, without a unit, number the rows
_BRANCH, _TIME = "branch", "time"
# Columns that label the points, by the pattern of their headers.
_LABELS = {_BRANCH: r"(?i)branch|segment|direction", _TIME: r"(?i)(time|t)\s*([\[(].*)?"}
_VOLTS = r"([\[(/_.\d]|\s|^)\s*([mµμu]?V|(milli)?[vV]olts?)\s*[\])]?$"  # at the end of a header or a cell
# The branch that a word in a column of branches names.
_BRANCHES = {
    **dict.fromkeys("loading load approach approaching extend extension trace advance closing in".split(), LOADING),
    **dict.fromkeys("unloading unload retract retraction withdraw retrace opening out".split(), UNLOADING),
    **dict.fromkeys("pause dwell hold holding".split(), PAUSE),
}


class CurveTable(NamedTuple):
    """The columns of a table that a curve needs, with the attributes that file formats expect of a table."""

    names: tuple[str, ...]  # the headers
    columns: Header  # x, the force, and then inputs that the options must not contradict
    asked: Asked
    positions: Mapping[str, int]
    labels: Mapping[str, int]  # the positions of the columns of branch and time
    added: tuple[str, ...] = ()

    @property
    def pair(self) -> Sequence[Column]:
        """The columns of x and the force."""
        return self.columns.inputs[:2]

    def reading(self, *remarks: str) -> str:
        """Return the sentence that says how the table is read, with remarks."""
        texts = ["" if position == self.labels.get(_BRANCH) else text for position, text in enumerate(self.names)]
        return self.columns._replace(texts=(*texts,), inputs=(*self.pair,)).reading(*remarks)


class ReadCurve(NamedTuple):
    """A curve, the sentence that says how its table is read, and the inputs that columns give.

    `stated`: inputs with the same number in all rows, each with the header of its column.
    """

    curve: ForceCurve
    reading: str
    stated: Mapping[str, tuple[str, float]]


def read_curve(
    path: str, known: Materials, stiffness: float | None, columns: tuple[str, ...] = (), form: str = "", mark: str = ""
) -> ReadCurve:
    """Return the curve in a file, with the sentence that says how the file is read. Raises BadTable.

    `stiffness`: the lever stiffness; `columns`, `form`, `mark`: the values of --column, --format and --delimiter.
    """
    asked = Asked({}, known, columns=columns, measured=MEASURED, pass_rest=True)
    file = Input(path)
    with file.file:
        lines, blocks = opened(file, input_format(path, "-", form, mark), asked)
        table = _table(lines.names, lines.sample, lines.stated, asked)
        line, rows = lines.lines, []
        for block in blocks:
            records = lines.read(block, table)
            try:
                rows.append(_rows(table, records))
            except BadRow as error:
                row, reason = error.args
                raise BadRow(line + 1 + row, reason) from None
            line += records.size
    branches = [f"branches from {lines.names[table.labels[_BRANCH]]}"] if _BRANCH in table.labels else []
    return ReadCurve(_curve(table, rows, stiffness), table.reading(*branches, *lines.remarks), _stated(table, rows))


def curve_of_columns(columns: Any, known: Materials, stiffness: float | None) -> ReadCurve:
    """Return the curve in a Python table, with the sentence on how the table is read. Raises BadTable."""
    asked = Asked({}, known, measured=MEASURED, pass_rest=True)
    memory = Memory(data_of(columns), asked)
    table = _table(memory.names, memory.sample, {}, asked)
    try:
        rows = _rows(table, memory.read(range(memory.size), table))
    except BadRow as error:
        row, reason = error.args
        raise BadRequest(f"row {row}, counted from 0: {reason}") from None
    return ReadCurve(_curve(table, [rows], stiffness), table.reading(), _stated(table, [rows]))


def _table(
    names: Sequence[str], sample: Sequence[Sequence[str]], stated: Mapping[str, str], asked: Asked
) -> CurveTable:
    """Return the columns of a curve in a table. Raises BadTable if x or the force is missing or in volts."""
    indices = {name: "" for name in map(typed, names) if name in _INDICES}
    header = understood(names, sample, {**indices, **stated}, (), asked.measured, pass_rest=True)
    found = {column.name: column for column in header.inputs}
    x_name = next((name for name in _X if name in found), "")
    force_name = next((name for name in _FORCES if name in found), "")
    if not x_name or not force_name:
        raise _lacking("force" if x_name else "contact radius, approach or travel", x_name, header)
    pair = found.pop(x_name), found.pop(force_name)
    others = [column for name, column in found.items() if name not in _X]
    columns = header._replace(inputs=(*pair, *others), materials=())
    in_volts = _on_volts([names[column.position] for column in pair])
    if in_volts:
        raise BadTable(f"header: {in_volts}")
    labels: dict[str, int] = {}
    for label, pattern in _LABELS.items():
        for position, text in enumerate(names):
            if re.fullmatch(pattern, text.strip()) and typed(text) not in stated:
                labels[label] = position
                break
    return CurveTable(tuple(names), columns, asked, {**columns.positions, **labels}, labels)


def _on_volts(texts: Iterable[str]) -> str:
    """Return the problem and the remedy for the first text in volts, a header or a cell; "" without one.

    A header in volts is a problem even if `--column` states another unit.
    """
    for text in texts:
        if re.search(_VOLTS, text.strip()):
            remedy = "multiply its numbers by the sensitivity (nm/V), and write the new unit into the header"
            return f"{quoted(typed(text))} is in volts: {remedy}"
    return ""


def _lacking(missing: str, x_name: str, header: Header) -> BadTable:
    """Return the error for a table without a force or without x.

    The error names an unused column in volts, or else options by which the user can choose a column.
    """
    check_has_names(header)
    names = ["approach_at_load", "lever_travel"]
    if missing == "force":  # contact radii are measured on a lens under a known load, other curves with a lever
        force = "load" if x_name == "contact_radius_at_load" else "lever_force"
        names = [force, "lever_deflection"]
    used = {*header.positions.values()}
    options = []
    for position, text in enumerate(header.texts):
        if position not in used:
            for name in names:
                unit = unit_in(text, name)
                if unit:
                    options.append(option_of(text, head_of(name, unit)))
    problem = f"header: no column has the {missing} of the curve"
    in_volts = _on_volts(text for position, text in enumerate(header.texts) if position not in used)
    if in_volts:
        return BadTable(f"{problem}; {in_volts}")
    if not options:
        problem += f" (the table has {first_of([*map(typed, header.texts)])})" if header.texts else ""
        options = [option_of("HEADER", head_of(name, "UNIT")) for name in names]
    return BadTable(f"{problem}; write {listed(options, 'or')}")


class _Rows(NamedTuple):
    """A block of a table: its numbers by the names of their columns, and the cells of its labels."""

    numbers: Mapping[str, Numbers]
    labels: Mapping[str, Sequence[bytes]]


def _rows(table: CurveTable, records: Records) -> _Rows:
    """Return the rows of a block. Raises BadRow for the first row with too many or too few cells, or with a bad number.

    A bad number is a filled cell in the column of x or the force that has no value. The line in the error is counted
    from 0 in the block. Lines with comments become rows without numbers.
    """
    numbers = {column.name: column.numbers(records.cells) for column in table.columns.inputs}
    problems = dict(records.odd)
    for column in table.pair:
        for row in numbers[column.name].odd:
            problem = _problem_in(column, records, row)
            if problem is not None:
                problems.setdefault(row, problem)
    for row in sorted(problems):
        line = records.before[row]
        if not (isinstance(line, bytes) and is_comment(line.decode(errors="replace"))):
            raise BadRow(records.starts[row], str(problems[row]))
    for of_column in numbers.values():
        of_column.values[[*problems]] = numpy.nan
    return _Rows(numbers, {label: records.cells[label] for label in table.labels})


def _problem_in(column: Column, records: Records, row: int) -> JkrollError | None:
    """Return the error of a value that is not a number; None for an empty cell or a mark for a missing value."""
    text = column.joined(*(records.cells[name][row].decode(errors="replace") for name in column.positions))
    if has_no_value(text):
        return None
    try:
        column.value(text)
    except JkrollError as error:
        in_volts = _on_volts([text])
        return BadTable(f"{column.name}: {in_volts}") if in_volts else error
    return None


def _curve(table: CurveTable, rows: list[_Rows], stiffness: float | None) -> ForceCurve:
    """Return the curve in blocks of a table. Raises BadTable for a travel or a deflection without a stiffness."""
    x_name, force_name = (column.name for column in table.pair)
    if x_name == "lever_travel" and stiffness is None:
        raise BadTable(
            "a travel includes the bending of the lever: give the lever's stiffness with --spring, as in 3.01N/m"
        )
    if force_name == "lever_deflection" and stiffness is None:
        raise BadTable(
            "a deflection becomes a force only with the lever's stiffness: give it with --spring, as in 3.01N/m"
        )
    z, z_error = _joined([block.numbers[x_name] for block in rows])
    force, force_error = _joined([block.numbers[force_name] for block in rows])
    is_deflection = force_name == "lever_deflection"
    if is_deflection and stiffness is not None:
        force = force * stiffness
        force_error = None if force_error is None else force_error * stiffness
    are_points = numpy.isfinite(z) & numpy.isfinite(force)
    branch = _branch_of(table, rows, are_points) if _BRANCH in table.labels else None
    time = _time_of(rows, are_points) if _TIME in table.labels else None
    ratio = None
    if not is_deflection and _DEFLECTION in table.positions:
        ratio = _slope(_joined([block.numbers[_DEFLECTION] for block in rows])[0], force)
    return ForceCurve(_X[x_name], z, force, z_error, force_error, branch, time, is_deflection, ratio)


def _slope(x: Any, y: Any) -> float | None:
    """Return the size of the slope of the best line through points; None if x is constant."""
    is_known = numpy.isfinite(x) & numpy.isfinite(y)
    x, y = x[is_known], y[is_known]
    if not len(x) or numpy.ptp(x) == 0:
        return None
    x = x - x.mean()
    return float(abs(x @ y) / (x @ x))


def _stated(table: CurveTable, rows: list[_Rows]) -> dict[str, tuple[str, float]]:
    """Return the inputs with the same number in all rows, each with the header of its column."""
    stated = {}
    for column in table.columns.inputs[2:]:
        values, _ = _joined([block.numbers[column.name] for block in rows])
        values = values[numpy.isfinite(values)]
        if len(values) and numpy.ptp(values) <= _SAME * abs(values).max():
            stated[column.name] = table.names[column.position], float(numpy.median(values))
    return stated


def _joined(blocks: list[Numbers]) -> tuple[Any, Any]:
    """Return the SI numbers of a column and their errors; None in place of the errors if no number has one.

    An error is half the width of an uncertainty. A cell without a number is nan; an error that is missing or zero is
    replaced by the median of the others.
    """
    values, errors = [], []
    for numbers in blocks:
        error = numpy.full(len(numbers.values), numpy.nan)
        for row, uncertain in numbers.uncertain.items():
            error[row] = (uncertain.high - uncertain.low) / 2
        values.append(numbers.values)
        errors.append(error)
    joined = numpy.concatenate(values) if values else numpy.empty(0)
    bars = numpy.concatenate(errors) if errors else numpy.empty(0)
    known = numpy.isfinite(bars) & (bars > 0)
    if not known.any():
        return joined, None
    return joined, numpy.where(known, bars, numpy.median(bars[known]))


def _branch_of(table: CurveTable, rows: list[_Rows], are_points: Any) -> Any:
    """Return the branch of each row, from the word in its cell. Raises BadTable if a point has no known word.

    Numbers are refused, since instruments differ: 1 may be the retraction, the approach or a pause.
    """
    cells = [cell.decode(errors="replace").strip() for cell in _cells(rows, _BRANCH)]
    branches = [_BRANCHES.get(cell.casefold()) for cell in cells]
    for cell, branch, is_point in zip(cells, branches, are_points, strict=True):
        if is_point and branch is None:
            head = typed(table.names[table.labels[_BRANCH]])
            known = "loading and unloading, approach and retract, pause"
            remedy = f"write these words, or --column {quoted(f'{head}=')} to divide the curve where it turns"
            raise BadTable(f"branch: {quoted(cell)} is not one of: {known}; {remedy}")
    return numpy.array(branches, dtype=object)


def _time_of(rows: list[_Rows], are_points: Any) -> Any:
    """Return the time of each row, in the unit of the column; None if the cell of a point is not a number."""
    times = numpy.full(len(are_points), numpy.nan)
    try:
        for row, cell in enumerate(_cells(rows, _TIME)):
            if are_points[row]:
                times[row] = float(cell)
    except ValueError:
        return None
    return times


def _cells(rows: list[_Rows], label: str) -> Iterator[bytes]:
    """Iterate over the cells of a label."""
    return chain.from_iterable(block.labels[label] for block in rows)
