"""The doors of the program: the ways to ask for the same rows, and the answer of each."""

import csv
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, suppress
from functools import partial
from itertools import product
from pathlib import Path
from typing import Any, NamedTuple
from unittest.mock import patch

import numpy as np

import jkroll.tables.run
from frames import outcomes
from harness import Ran, Run
from jkroll.cli.call import Call
from jkroll.cli.process import action_of
from jkroll.cli.runners import question_of
from jkroll.errors import JkrollError
from jkroll.model.accepted import LEAST
from jkroll.model.estimate import NONE
from jkroll.model.frame import Frame
from jkroll.model.limits import LIMITS, NOT_JUDGED, Limit
from jkroll.model.other_law import at_half_spacing
from jkroll.model.reasons import Failure, NoErrorBar
from jkroll.model.rows import SIDES, Block, Columns, Wanted, evaluated, of_single_row, put_single_rows
from jkroll.model.uncertainty import sources_of
from jkroll.quantities.nomenclature import NOMENCLATURE, STATE_OR_LOAD
from jkroll.quantities.values import middle
from jkroll.report.questions import QUESTIONS
from jkroll.tables.table import Table
from questions import Ask, Sheet
from tuning import computed

ULP = 2.0**-52
# Largest difference of two evaluations in ulp·(1 + κ), with κ of `_condition`. `guide accuracy` states an error of 15
# for a result, and of 40 by Maugis' law; the errors of two evaluations may add up.
STATED = 80.0
SURE = 2.0  # largest difference in ulp for which κ is not computed
STEP = 2.0**-45  # relative step of an input, small enough to find κ close to pull-off
AT_END = 2.0**-43  # relative distance from the end of a contact within which rounding decides whether a state exists
FILES = ("csv", "tsv", "ndjson", "parquet")  # suffixes

Scenes = Sequence[Frame | None]  # of rows; None for a row without a scene


class Refused(Exception):
    """Error raised when a door refuses all rows together, or the only row."""


class Rows(NamedTuple):
    """The answer of a door, row by row.

    If the rows were computed as arrays, rows with the same gaps all have the reasons of the first of them.
    """

    keys: Sequence[str]  # of the columns
    values: Sequence[Mapping[str, float]]  # by key, without the empty cells
    doubts: Sequence[int]  # as bits
    reasons: Sequence[Mapping[str, JkrollError]]  # for the empty cells, by key
    status: Sequence[str]


def rows_of(blocks: Sequence[Columns]) -> Rows:
    """Return the rows of several blocks of columns."""
    keys = blocks[0].wanted.keys
    values, doubts, reasons, status = [], [], [], []
    for columns in blocks:
        numbers = {key: np.asarray(columns.column(key), dtype=float).tolist() for key in keys}
        for row in range(len(columns)):
            values.append({key: numbers[key][row] for key in keys if not _is_empty(key, numbers[key][row])})
            doubts.append(int(columns.doubts[row]))
            gap = columns.gap_of(row)
            reasons.append({} if gap is None else dict(_by_key(gap.reasons)))
            status.append("" if gap is None else gap.phrase)
    return Rows(keys, values, doubts, reasons, status)


def _is_empty(key: str, number: float) -> bool:
    """Return whether a number stands for an empty cell: nan or, in a column of rules, NONE."""
    return math.isnan(number) or (key.endswith("_best_by") and number == NONE)


def _by_key(reasons: Mapping[str, JkrollError]) -> Iterator[tuple[str, JkrollError]]:
    """Iterate over reasons by key; the reason for a missing uncertainty has the key of its first side."""
    for name, error in reasons.items():
        yield f"{name}_{SIDES[0]}" if isinstance(error, NoErrorBar) else name, error


def side_of(key: str) -> str:
    """Return the quantity of a column with one side of its uncertainty; an empty text for other columns."""
    name, _, side = key.rpartition("_")
    return name if key not in NOMENCLATURE and side in SIDES and not best_of(key) else ""


def best_of(key: str) -> str:
    """Return the quantity of a column with a part of its best range; an empty text for other columns."""
    name, part, _ = key.partition("_best_")
    return name if part else ""


# --- Doors ------------------------------------------------------------------------------------------------------------


def call_of(words: Sequence[str]) -> Call:
    """Return the call that the words of a command line express."""
    action: Any = action_of(words)
    call: Call = action.args[0]
    return call


def scenes_of(ask: Ask) -> list[Frame]:
    """Return the scenes of a question that is asked as a list."""
    return [*call_of(ask.words()).sweep.frames()]


def of_list(ask: Ask, *, by_arrays: bool, best: bool = False) -> Rows:
    """Return the rows of a question that is asked as a list. `best`: with the best ranges of the results."""
    call = call_of(ask.words())
    sweep, question = call.sweep, question_of(call, QUESTIONS[call.command])
    with computed(by_arrays=by_arrays):
        wanted = sweep.wanted(question.quantities, question.named)
        if best:
            wanted = wanted.with_best(wanted.names)
        rows = rows_of([*sweep.columns(wanted)])
    if by_arrays:
        return rows
    singles = rows_of([of_single_row(wanted, wanted.results(scene)) for scene in sweep.frames()])
    return rows._replace(reasons=singles.reasons)


def printed(run: Run, ask: Ask, form: str, *more: str, by_arrays: bool) -> tuple[Ran, list[dict[str, Any]]]:
    """Return the output of a call, and each row: its cells by header or, in JSON, its object.

    `form`: `--csv` or `--json`, or the suffix of a file.
    """
    path = Path(f"out.{form}")
    path.unlink(missing_ok=True)
    with computed(by_arrays=by_arrays):
        ran = answered(run, *ask.words(*(["-o", str(path)] if form in FILES else [form]), *more))
    if form == "parquet" and path.exists():
        import pyarrow.parquet

        return ran, pyarrow.parquet.read_table(path).to_pylist()
    text = ran.out
    if form in FILES:
        text = path.read_text(encoding="utf-8") if path.exists() else ""
    if ran.code == 2 or not text:
        raise Refused(ran.err)
    if form == "--json":
        objects = strict_json(text)
        return ran, objects if isinstance(objects, list) else [objects]
    if form == "ndjson":
        return ran, [*map(strict_json, text.splitlines())]
    return ran, [*csv.DictReader(text.splitlines(), delimiter="\t" if form == "tsv" else ",")]


def answered(run: Run, *words: str) -> Ran:
    """Run a command line that may fail, but not with an unexpected error."""
    ran = run(*words)
    assert "this is a bug in jkroll" not in ran.err, f"{words}: {ran.err}"
    return ran


def strict_json(text: str) -> Any:
    """Return the value of a JSON text. Raises ValueError for numbers that JSON does not have."""

    def refuse(name: str) -> float:
        raise ValueError(f"{name} is not JSON")

    return json.loads(text, parse_constant=refuse)


class Converted(NamedTuple):
    """The rows of a table as computed and as written, the same rows computed as floats, and the scenes."""

    rows: Rows
    cells: list[dict[str, str]]
    by_floats: Rows
    scenes: Scenes


def of_table(run: Run, sheet: Sheet, *, sample: int = 200) -> Converted:
    """Return the rows of a table; `sample`: the number of first rows that decide the meaning of columns."""
    Path("in.csv").write_text(sheet.text(), encoding="utf-8")
    arrays: list[Columns] = []
    floats: list[Columns] = []
    scenes: list[Frame | None] = []

    def evaluated_twice(wanted: Wanted, block: Block) -> Columns:
        arrays.append(evaluated(wanted, block))
        for row in range(block.size):
            single = Columns(wanted, 1, few=True)
            put_single_rows(single, partial(_frame_at, block, row), [0])
            floats.append(single)
            scenes.append(_scene_of(block, row))
        return arrays[-1]

    def table_of_sample(columns: Any, rows: Any, *others: Any, **options: Any) -> Any:
        return Table(columns, rows[:sample], *others, **options)

    with ExitStack() as stack:
        stack.enter_context(patch.object(jkroll.tables.run, "evaluated", evaluated_twice))
        stack.enter_context(patch.object(jkroll.tables.run, "Table", table_of_sample))
        ran = answered(run, "batch", "in.csv", "-o", "out.csv", "--jobs", "1", *sheet.options)
    if ran.code == 2:
        raise Refused(ran.err)
    with open("out.csv", encoding="utf-8", newline="") as file:
        return Converted(rows_of(arrays), [*csv.DictReader(file)], rows_of(floats), scenes)


def _frame_at(block: Block, row: int, _: int = 0) -> Frame:
    """Return the scene of a row in a block; `_`: its index among the single rows to put, which is always 0."""
    frame: Frame = block.frame_of(row)
    return frame


def _scene_of(block: Block, row: int) -> Frame | None:
    """Return the scene of a row in a block; None for a row without a scene."""
    try:
        return _frame_at(block, row)
    except JkrollError:
        return None


# --- What may differ --------------------------------------------------------------------------------------------------


def agree(scene: Frame, name: str, one: float, other: float) -> bool:
    """Return whether two values of a quantity agree within its accuracy."""
    difference = abs(one - other)
    if difference <= _rounding(scene, name):
        return True
    ulps = difference / ULP / max(abs(one), abs(other))
    return ulps <= SURE or ulps <= STATED * (1 + _condition(scene, name, one))


def _rounding(scene: Frame, name: str) -> float:
    """Return the rounding error allowed for forces and lengths, whose terms may cancel; 0 for other quantities."""
    term = {"N": "pull_off_force", "m": "approach"}.get(NOMENCLATURE[name].unit, "")
    return STATED * ULP * float(scene.numbers(term).get(term, 0.0)) if term else 0.0


def _condition(scene: Frame, name: str, value: float) -> float:
    """Return κ: the sum over the inputs of the factor from the relative error of an input to that of a quantity."""
    condition = 0.0
    for source in scene.inputs_of(name):
        given = scene.given.get(source, 0.0)
        if given and math.isfinite(given):
            condition += _growth(scene, name, value, source, given)
    return condition


def _growth(scene: Frame, name: str, value: float, source: str, given: float) -> float:
    """Return the factor for one input, the larger of a step up and a step down; infinite if both have no value."""
    growths = []
    for factor in (1 + STEP, 1 - STEP):
        with suppress(JkrollError):
            change = scene.replace(**{source: given * factor})[name] - value
            growths.append(abs(change) / (abs(value) or 1.0) / STEP)
    return max(growths, default=math.inf)


def sides_agree(scene: Frame, name: str, one: float | None, other: float | None) -> bool:
    """Return whether two numbers for one side of an uncertainty agree.

    None, for inputs without influence, agrees with an error bar of 0 and with an end at the value, up to rounding.
    """
    errors = [_allowed_error(at_end, name) for at_end in _ends(scene, name)]
    error = 4 * max(errors) + _rounding(scene, name)  # with a margin, since several values make a side
    if one is not None and other is not None:
        return abs(one - other) <= error
    side = one if one is not None else other
    value = outcomes(scene, (name,))[name]
    return side is None or abs(side) <= error or (isinstance(value, float) and abs(side - value) <= error)


def _allowed_error(scene: Frame, name: str) -> float:
    """Return the largest allowed difference of two evaluations of a quantity; 0 if it has no value."""
    value = outcomes(scene, (name,))[name]
    return abs(value) * STATED * ULP * (1 + _condition(scene, name, value)) if isinstance(value, float) else 0.0


def _ends(scene: Frame, *names: str) -> Iterator[Frame]:
    """Iterate over the scene, and over scenes at the ends of its uncertain inputs, moved alone and all together."""
    yield scene
    sources = sources_of(scene, scene.inputs_of(*names)).entering
    for source in sources:
        for end in (source.given.low, source.given.high):
            yield scene.replace(**dict.fromkeys(source.names, end))
    for corner in product(*((source.given.low, source.given.high) for source in sources)):
        moved: dict[str, float] = {}
        for source, end in zip(sources, corner, strict=True):
            moved |= dict.fromkeys(source.names, end)
        yield scene.replace(**moved)


def bits_agree(scene: Frame, names: Sequence[str], one: int, other: int) -> bool:
    """Return whether doubts agree, except for limits whose number is at a threshold within its accuracy."""
    differing = one ^ other
    if differing & NOT_JUDGED:
        return False
    return all(_is_at_threshold(limit, scene, names) for limit in LIMITS if differing & limit.bits)


def _is_at_threshold(limit: Limit, scene: Frame, names: Sequence[str]) -> bool:
    """Return whether the number that a limit judges is at one of its thresholds, within its accuracy."""
    if limit.number is not None:
        number, error = limit.number(scene, scene.columns(names)), 0.0
        for by_law in (scene, scene.by_law):
            for name, value in by_law.numbers(*names).items():
                error += STATED * ULP * (1 + _condition(by_law, name, value))
        return any(abs(number - threshold) <= error * threshold for threshold in limit.codes)
    value = outcomes(scene, (limit.name,))[limit.name]
    if isinstance(value, JkrollError):
        return False
    return any(agree(scene, limit.name, value, threshold) for threshold in limit.codes)


def is_at_its_end(scene: Frame) -> bool:
    """Return whether the state is so close to the end of the contact that rounding may decide whether it exists."""
    states = {name: middle(scene.stated[name]) for name in ("load", "approach_at_load") if name in scene.stated}
    for name, value in states.items():
        step = AT_END * abs(value) or LEAST
        below, above = scene.replace(**{name: value - step}), scene.replace(**{name: value + step})
        for quantity in ("contact_radius_at_load", "load_at_factor", "edge_ratio", "load_maugis"):
            if _has_no_contact(below, quantity) != _has_no_contact(above, quantity):
                return True
    return False


def _has_no_contact(scene: Frame, name: str) -> bool:
    """Return whether a quantity has no value because there is no contact."""
    outcome = outcomes(scene, (name,))[name]
    return isinstance(outcome, Failure) and not outcome.cause.has_contact


def differences(one: Rows, other: Rows, scenes: Scenes | None = None) -> Iterator[str]:
    """Iterate over the differences of two doors in common columns; given scenes, only those beyond accuracy."""
    if len(one.values) != len(other.values):
        yield f"{len(one.values)} and {len(other.values)} rows"
        return
    shared = [key for key in one.keys if key in other.keys]
    sides = [key for key in dict.fromkeys((*one.keys, *other.keys)) if key not in shared and side_of(key) in shared]
    for row in range(len(one.values)):
        scene = scenes[row] if scenes is not None else None
        texts = [*_in_rows(one, other, row, [*shared, *sides], scene)]
        if texts and not (scene is not None and is_at_its_end(scene)):
            yield from (f"row {row}: {text}" for text in texts)


def _in_rows(one: Rows, other: Rows, row: int, keys: Sequence[str], scene: Frame | None) -> Iterator[str]:
    """Iterate over the differences of two doors in one row; given its scene, only over those beyond accuracy."""
    values, others = one.values[row], other.values[row]
    for key in keys:
        if not _is_same(scene, key, values.get(key), others.get(key)):
            yield f"{key} = {values.get(key)!r} and {others.get(key)!r}"
    if {*one.keys} != {*other.keys}:
        return  # doubts and status concern all columns of a row
    bits, other_bits = one.doubts[row], other.doubts[row]
    names = [key for key in one.keys if key in NOMENCLATURE]
    if bits != other_bits and not (scene is not None and bits_agree(scene, names, bits, other_bits)):
        yield f"doubts {bits:b} and {other_bits:b}"
    if one.status[row] != other.status[row]:
        yield f"{one.status[row]!r} and {other.status[row]!r}"


def _is_same(scene: Frame | None, key: str, one: float | None, other: float | None) -> bool:
    """Return whether two cells of a column are the same; given their scene, within the accuracy."""
    if one == other or scene is None:
        return one == other
    if side_of(key):
        return sides_agree(scene, side_of(key), one, other)
    if best_of(key):
        return _is_same_best(scene, key, one, other)
    return one is not None and other is not None and agree(scene, key, one, other)


def _is_same_best(scene: Frame, key: str, one: float | None, other: float | None) -> bool:
    """Return whether two cells with the same part of a best range are the same within the accuracy."""
    if key == "load_maugis_best_by" and STATE_OR_LOAD.isdisjoint(scene.stated):
        return True  # without a load, rounding alone decides whether the atomic spacing widens the range of this load
    if one is None or other is None or key.endswith("_best_by"):
        return False
    if len({*map(type, scene.uncertainties.values())}) > 1:
        return True  # whether ± or ranges count depends on the inputs that the whole row uses
    return any(agree(at_end, best_of(key), one, other) for at_end in _ends_of_best(scene))


def _ends_of_best(scene: Frame) -> Iterator[Frame]:
    """Iterate over scenes at the ends of uncertain inputs, by the law in use and by the better law at two spacings."""
    for at_end in _ends(scene, *scene.possible(["pull_off_force", "yield_force"])):
        yield from (at_end, at_end.by_law_at_spacing, at_half_spacing(at_end.by_law_at_spacing))
