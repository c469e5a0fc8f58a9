"""The doors of the program: the ways to ask for the same rows, and the answer of each."""

import csv
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack
from functools import partial
from itertools import product
from pathlib import Path
from typing import Any, NamedTuple
from unittest.mock import patch

import numpy as np

import jkroll.model.rows
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
SURE = 2.0  # largest difference in ulp that is allowed without κ
STEP = 2.0**-45  # relative step of an input, small enough to find κ close to pull-off
AT_END = 2.0**-43  # relative distance from the end of a contact at which rounding decides whether there is a state
FILES = ("csv", "tsv", "ndjson", "parquet")

Scenes = Sequence[Frame | None]  # of rows; None for a row without a scene


class Refused(Exception):
    """Error raised when a door refuses all rows together, or the only row."""


class Rows(NamedTuple):
    """The answer of a door: for each row its values without gaps, its doubts as bits, the reasons for gaps, its status.

    Rows that were computed as arrays have the reasons of the first row with the same gaps.
    """

    keys: Sequence[str]  # of the columns
    values: Sequence[Mapping[str, float]]
    doubts: Sequence[int]
    reasons: Sequence[Mapping[str, JkrollError]]
    status: Sequence[str]


def rows_of(every: Sequence[Columns]) -> Rows:
    """Return the rows of several blocks of columns."""
    found = Rows(every[0].wanted.keys, [], [], [], [])
    rules = {key for key in found.keys if key.endswith("_best_by")}
    values, doubts, reasons, status = [], [], [], []
    for columns in every:
        numbers = {key: np.asarray(columns.column(key), dtype=float).tolist() for key in found.keys}
        for row in range(len(columns)):
            of_row = {key: own[row] for key, own in numbers.items() if not math.isnan(own[row])}
            values.append({key: number for key, number in of_row.items() if key not in rules or number != NONE})
            doubts.append(int(columns.doubts[row]))
            gap = columns.gap_of(row)
            reasons.append({} if gap is None else dict(_by_key(gap.reasons)))
            status.append("" if gap is None else gap.phrase)
    return Rows(found.keys, values, doubts, reasons, status)


def _by_key(reasons: Mapping[str, JkrollError]) -> Iterator[tuple[str, JkrollError]]:
    """Iterate over reasons by key; for a value without an uncertainty, the key is that of one side."""
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
    each = rows_of([of_single_row(wanted, wanted.results(scene)) for scene in sweep.frames()])
    return rows._replace(reasons=each.reasons)


def printed(run: Run, ask: Ask, form: str, *more: str, by_arrays: bool) -> tuple[Ran, list[dict[str, Any]]]:
    """Return the output of a call, and its cells by header; `form`: an option as `--json`, or the suffix of a file."""
    path = Path(f"out.{form}")
    path.unlink(missing_ok=True)
    with computed(by_arrays=by_arrays):
        ran = answered(run, *ask.words(*(["-o", str(path)] if form in FILES else [form]), *more))
    if form == "parquet" and path.exists():
        import pyarrow.parquet

        return ran, pyarrow.parquet.read_table(path).to_pylist()
    text = ran.out if form not in FILES else path.read_text(encoding="utf-8") if path.exists() else ""
    if ran.code == 2 or not text:
        raise Refused(ran.err)
    if form == "--json":
        found = strict_json(text)
        return ran, found if isinstance(found, list) else [found]
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

    def observed(wanted: Wanted, block: Block) -> Columns:
        arrays.append(evaluated(wanted, block))
        for place in range(block.size):
            alone = Columns(wanted, 1, few=True)
            floats.append(alone)
            put_single_rows(alone, partial(_at, block, place), [0])
            scenes.append(_scene_of(block, place))
        return arrays[-1]

    def of_sample(columns: Any, rows: Any, *others: Any, **options: Any) -> Any:
        return Table(columns, rows[:sample], *others, **options)

    with ExitStack() as stack:
        stack.enter_context(patch.object(jkroll.tables.run, "evaluated", observed))
        stack.enter_context(patch.object(jkroll.tables.run, "Table", of_sample))
        ran = answered(run, "batch", "in.csv", "-o", "out.csv", "--jobs", "1", *sheet.options)
    if ran.code == 2:
        raise Refused(ran.err)
    with open("out.csv", encoding="utf-8", newline="") as file:
        return Converted(rows_of(arrays), [*csv.DictReader(file)], rows_of(floats), scenes)


def _at(block: Block, place: int, _: int) -> Frame:
    scene: Frame = block.frame_of(place)
    return scene


def _scene_of(block: Block, place: int) -> Frame | None:
    """Return the scene of a row in a block; None for a row without a scene."""
    try:
        scene: Frame = block.frame_of(place)
        return scene
    except JkrollError:
        return None


# --- What may differ --------------------------------------------------------------------------------------------------


def agree(scene: Frame, name: str, one: float, other: float) -> bool:
    """Return whether two values of a quantity agree within its accuracy."""
    if abs(one - other) <= _rounding(scene, name):
        return True
    off = abs(one - other) / ULP / (max(abs(one), abs(other)) or 1)
    return off <= SURE or off <= STATED * (1 + _condition(scene, name, one))


def _rounding(scene: Frame, name: str) -> float:
    """Return the rounding error allowed for forces and lengths, whose terms may cancel; 0 for other quantities."""
    whole = {"N": "pull_off_force", "m": "approach"}.get(NOMENCLATURE[name].unit, "")
    return STATED * ULP * float(scene.numbers(whole).get(whole, 0.0)) if whole else 0.0


def _condition(scene: Frame, name: str, value: float) -> float:
    """Return κ: the factor from relative errors of the inputs to that of a quantity; infinite where a contact ends."""
    inputs = {source: scene.given[source] for source in scene.inputs_of(name) if source in scene.given}
    return sum(_growth(scene, name, value, *one) for one in inputs.items() if one[1] and math.isfinite(one[1]))


def _growth(scene: Frame, name: str, value: float, source: str, given: float) -> float:
    changes = []
    for factor in (1 + STEP, 1 - STEP):
        try:
            changes.append(abs(scene.replace(**{source: given * factor})[name] - value) / (abs(value) or 1) / STEP)
        except JkrollError:
            continue
    return max(changes, default=math.inf)


def sides_agree(scene: Frame, name: str, one: float | None, other: float | None) -> bool:
    """Return whether two numbers for one side of an uncertainty agree.

    None, for inputs without influence, agrees with an error bar of 0 and with an end at the value, up to rounding.
    """
    error = 4 * max((_error(each, name) for each in _ends(scene, name)), default=0.0) + _rounding(scene, name)
    value = outcomes(scene, (name,))[name]
    numbers = [number for number in (one, other) if number is not None]
    if len(numbers) == 2:
        return abs(numbers[0] - numbers[1]) <= error
    return abs(numbers[0]) <= error or (isinstance(value, float) and abs(numbers[0] - value) <= error)


def _error(scene: Frame, name: str) -> float:
    value = outcomes(scene, (name,))[name]
    return abs(value) * STATED * ULP * (1 + _condition(scene, name, value)) if isinstance(value, float) else 0.0


def _ends(scene: Frame, *names: str) -> Iterator[Frame]:
    """Iterate over the scene, and over scenes at the ends of its uncertain inputs, moved alone and all together."""
    yield scene
    sources = sources_of(scene, scene.inputs_of(*names)).entering
    for source in sources:
        yield from (scene.replace(**dict.fromkeys(source.names, end)) for end in (source.given.low, source.given.high))
    for corner in product(*((source.given.low, source.given.high) for source in sources)):
        ends = zip(sources, corner, strict=True)
        yield scene.replace(**{each: end for source, end in ends for each in source.names})


def bits_agree(scene: Frame, names: Sequence[str], one: int, other: int) -> bool:
    """Return whether doubts agree, except for limits whose number is at a threshold within its accuracy."""
    unlike = one ^ other
    return not unlike & NOT_JUDGED and all(
        _is_at_threshold(limit, scene, names) for limit in LIMITS if unlike & limit.bits
    )


def _is_at_threshold(limit: Limit, scene: Frame, names: Sequence[str]) -> bool:
    """Return whether the number that a limit judges, or the factor between two laws, is at a threshold."""
    if limit.factor is not None:
        factor = limit.factor(scene, scene.columns(names))
        laws = scene, scene.by_law
        error = STATED * ULP * sum(1 + _condition(law, *item) for law in laws for item in law.numbers(*names).items())
        return any(abs(factor - threshold) <= error * threshold for threshold in limit.codes)
    value = outcomes(scene, (limit.name,))[limit.name]
    if isinstance(value, JkrollError):
        return False
    return any(agree(scene, limit.name, value, threshold) for threshold in limit.codes)


def is_at_its_end(scene: Frame) -> bool:
    """Return whether the state is so close to the end of the contact that rounding may decide whether it exists."""
    states = {name: middle(scene.stated[name]) for name in ("load", "approach_at_load") if name in scene.stated}
    for name, value in states.items():
        step = AT_END * abs(value) or LEAST
        for wanted in ("contact_radius_at_load", "load_at_factor", "edge_ratio", "load_maugis"):
            around = [scene.replace(**{name: each}) for each in (value - step, value + step)]
            found = [outcomes(each, (wanted,))[wanted] for each in around]
            if len({isinstance(outcome, Failure) and not outcome.cause.has_contact for outcome in found}) > 1:
                return True
    return False


def differences(one: Rows, other: Rows, scenes: Scenes | None = None) -> Iterator[str]:
    """Iterate over the differences of two doors in common columns; given scenes, only those beyond accuracy."""
    if len(one.values) != len(other.values):
        yield f"{len(one.values)} and {len(other.values)} rows"
        return
    both = [key for key in one.keys if key in other.keys]
    sides = [key for key in dict.fromkeys((*one.keys, *other.keys)) if key not in both and side_of(key) in both]
    for row in range(len(one.values)):
        scene = scenes[row] if scenes is not None else None
        found = [*_in_rows(one, other, row, [*both, *sides], scene)]
        if found and not (scene is not None and is_at_its_end(scene)):
            yield from (f"row {row}: {text}" for text in found)


def _in_rows(one: Rows, other: Rows, row: int, keys: Sequence[str], scene: Frame | None) -> Iterator[str]:
    values, others = one.values[row], other.values[row]
    for key in keys:
        if not _same(scene, key, values.get(key), others.get(key)):
            yield f"{key} = {values.get(key)!r} and {others.get(key)!r}"
    bits, other_bits = one.doubts[row], other.doubts[row]
    is_judged = {*one.keys} == {*other.keys} and bits != other_bits
    names = [key for key in one.keys if key in NOMENCLATURE]
    if is_judged and not (scene is not None and bits_agree(scene, names, bits, other_bits)):
        yield f"doubts {bits:b} and {other_bits:b}"
    if {*one.keys} == {*other.keys} and one.status[row] != other.status[row]:
        yield f"{one.status[row]!r} and {other.status[row]!r}"


def _same(scene: Frame | None, key: str, one: float | None, other: float | None) -> bool:
    if one == other or scene is None:
        return one == other
    if side_of(key):
        return sides_agree(scene, side_of(key), one, other)
    if key == "load_maugis_best_by" and STATE_OR_LOAD.isdisjoint(scene.stated):
        return True  # without a load, rounding alone decides whether the atomic spacing widens the range of this load
    if one is None or other is None or key.endswith("_best_by"):
        return False
    name = best_of(key)
    if name and len({*map(type, scene.uncertainties.values())}) > 1:
        return True  # whether ± or ranges count depends on the inputs that the whole row uses
    return any(agree(each, name or key, one, other) for each in (_ends_of_best(scene) if name else [scene]))


def _ends_of_best(scene: Frame) -> Iterator[Frame]:
    """Iterate over scenes at the ends of uncertain inputs, by the law in use and by the better law at two spacings."""
    for each in _ends(scene, *scene.possible(["pull_off_force", "yield_force"])):
        yield from (each, each.by_law_at_spacing, at_half_spacing(each.by_law_at_spacing))
