"""`jkroll.answer`: the answer of a command as an object, for one scene or for each combination of lists."""

from collections.abc import ItemsView, Iterable, Iterator, KeysView, Mapping, Sequence
from functools import cached_property
from importlib import import_module
from itertools import chain, product
from math import nan
from typing import TYPE_CHECKING, Any, overload

from ..errors import BadRequest
from ..materials.library import Material, Materials
from ..model.accepted import check_range
from ..model.containers import Reader, warn_of_metres
from ..model.estimate import WORDS, Estimate
from ..model.frame import Frame
from ..model.labels import axes_of
from ..model.rows import Columns, Wanted, as_list
from ..model.solver import Solids, is_list, materials_of, words_in
from ..model.sweep import Sweep
from ..model.tally import Tally
from ..physics.elementary import NUMBER
from ..quantities.formatting import AS_USUAL, Format, amount, symbol_of
from ..quantities.laws import law_given, laws_given
from ..quantities.nomenclature import CONVERTED, NOMENCLATURE, named
from ..quantities.numeric import Numeric
from ..quantities.shown import Part, Shown, as_text
from ..quantities.spreads import Spread
from ..quantities.values import QuantityError, Uncertain, middle
from ..report.answer import Result
from ..report.questions import QUESTIONS, Question, columns_in_table, question_about
from ..report.report import Report
from ..text import listed, quoted
from ..write.answered import as_object
from ..write.notebook import parts_of_answer, parts_of_answers
from ..write.table import Row, in_width, rows_in_words
from ..write.writers import Lists, written

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy import float64
    from numpy.typing import NDArray

    from ..model.limits import Doubt
    from .drawn import Drawn

    Single = float | str | Uncertain | Numeric
    Several = Single | Sequence[Single] | NDArray[float64]


# --- One scene --------------------------------------------------------------------------------------------------------


class Exceeded:
    """A limit of the model that the answer exceeds; `str` gives its sentence.

    `name` and `value` are those of the quantity that the limit concerns. `limit` is the first threshold. It applies to
    the value or, for some limits, to another number: for the limit of a law, to the factor between its answer and a
    better one; for the limit on radii, to the smaller radius. `factor` is the factor by which that number is beyond
    the threshold; None if it is infinite, or if the threshold is 0. `ends` names the results that become meaningless.
    """

    def __init__(self, text: str, doubt: "Doubt", ends: tuple[str, ...]) -> None:
        self.text, self.code, self.name, self.value = text, doubt.code, doubt.limit.name, doubt.value
        self.limit, self.factor, self.ends = doubt.limit.threshold, doubt.factor, ends

    def __repr__(self) -> str:
        return f"<{self.code}: {self.text}>"

    def __str__(self) -> str:
        return self.text


class Answered(Shown):
    """The answer to a question about one scene.

    `values` holds the results by name, `inputs` the inputs that were given or used, `doubts` the limits of the model
    that are exceeded, `best` the best ranges of the results, `surfaces` the pull-off forces of real surfaces, and
    `notes` all other notes. `as_dict()` returns the object that `--json` prints. Iteration gives the names of the
    results, as in a dict.
    """

    def __init__(self, answer: Report) -> None:
        self._answer = answer

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the question and the frame; everything else is computed again."""
        return _answered, (self._answer.question, self._answer.described)

    @cached_property
    def values(self) -> Mapping[str, Result]:
        """The results by name, in SI units."""
        for result in self._answer.results:
            result.best = self.best.get(result.name)
        return {result.name: result for result in self._answer.results}

    @cached_property
    def inputs(self) -> Mapping[str, float | str | Uncertain]:
        """The inputs that were given or used, in SI units, with their uncertainties."""
        return self._answer.input_measures

    @cached_property
    def inputs_in_words(self) -> Mapping[str, str]:
        """The inputs as texts with units, rounded as in a terminal."""
        return {name: amount(name, value) for name, value in self.inputs.items()}

    @cached_property
    def doubts(self) -> tuple[Exceeded, ...]:
        """The limits of the model that are exceeded, the most important first."""
        answer = self._answer
        return tuple(Exceeded(answer.about(doubt), doubt, answer.ended_by(doubt)) for doubt in answer.exceeded)

    @cached_property
    def best(self) -> Mapping[str, Estimate]:
        """The best ranges of the results, by name: `low` and `high`, nan where open, and `by`, the rule."""
        return {name: estimate._replace(by=WORDS[estimate.by]) for name, estimate in self._answer.estimates.items()}

    @cached_property
    def surfaces(self) -> Mapping[str, tuple[float, float]]:
        """The least and the largest pull-off force on each kind of real surface, in N; empty for other questions."""
        return self._answer.surfaces_of("pull_off_force")

    @cached_property
    def why(self) -> Mapping[str, str]:
        """The explanation of each rule for best ranges, by name: which effects its ranges include and leave out."""
        return {WORDS[by]: self._answer.why(by) for by, reasons in self._answer.whys.items() if reasons}

    @cached_property
    def rows(self) -> Mapping[str, Row]:
        """The rows of a terminal's table, by name, each with its best range as text and the rule for it."""
        return rows_in_words(self._answer, AS_USUAL)

    @cached_property
    def notes(self) -> tuple[str, ...]:
        """The other notes: assumptions, remarks on the source of material data, contradictions between results."""
        return tuple(note.text for note in self._answer.notes)

    def as_dict(self) -> dict[str, Any]:
        """Return the object that the command prints with `--json`."""
        return as_object(self._answer, AS_USUAL)

    def to_dict(self) -> dict[str, float | None]:
        """Return the numbers in SI units, by name; None for a result without a value."""
        return {name: result.value for name, result in self.values.items()}

    def to_pandas(self) -> Any:
        """Return a DataFrame with a row for each result: its value in SI units and its best range."""
        rows = []
        for name, result in self.values.items():
            low, high, by = self.best.get(name, (nan, nan, None))
            row = {"symbol": NOMENCLATURE[name].symbol, "value": result.value, "unit": result.unit}
            rows.append({**row, "best_low": low, "best_high": high, "best_by": by, "reason": result.reason or None})
        return import_module("pandas").DataFrame(rows, index=[*self])

    @property
    def drawn(self) -> "Drawn":
        """The force against the approach, as in `jkroll contact --curve`, with a mark at a given load or state."""
        from .drawn import curve_with_state

        return curve_with_state(self._answer.frame)

    def plot(self, ax: "Axes | None" = None, style: str = "paper") -> Any:
        """Draw the contact on matplotlib axes, or on those of a new figure; return them. Needs the extra `plot`."""
        return self.drawn.plot(ax, style)

    def keys(self) -> KeysView[str]:
        """Return the names of the results."""
        return self.values.keys()

    def items(self) -> ItemsView[str, Result]:
        """Return the names with the results."""
        return self.values.items()

    def __iter__(self) -> Iterator[str]:
        return iter(self.values)

    def __len__(self) -> int:
        return len(self.values)

    def __contains__(self, name: object) -> bool:
        return named(str(name), self.values) in self.values

    def __getitem__(self, name: str) -> Result:
        """Return the result with a name or symbol."""
        known = named(str(name), self.values)
        if known not in self.values:
            raise BadRequest(f"{quoted(str(name))} is not in this answer, which has {listed(self.values)}")
        return self.values[known]

    def __repr__(self) -> str:
        shown = {name: "no value" if result.value is None else result for name, result in self.values.items()}
        texts = (f"{NOMENCLATURE[name].symbol} = {result}" for name, result in shown.items())
        return f"<Answered: {', '.join(texts)}>"

    def _parts(self) -> Iterable[Part]:
        return parts_of_answer(self._answer)


def _answered(question: Question, frame: Frame) -> Answered:
    """Return the answer to a question about a frame."""
    return Answered(Report(question, frame))


# --- Several scenes ---------------------------------------------------------------------------------------------------


class Answers(Shown):
    """The answers to a question about several scenes: all combinations of lists, as a command forms them.

    Iteration gives the answers. `answers[0]` is the first one, `answers["P_c"]` an array of values in SI units.
    `print` shows the same table as the command, and so does a notebook.
    """

    def __init__(self, question: Question, sweep: Sweep) -> None:
        self._question, self._sweep = question, sweep

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the question and the scenes; everything else is computed again."""
        return Answers, (self._question, self._sweep)

    def __len__(self) -> int:
        return len(self._sweep)

    def __iter__(self) -> Iterator[Answered]:
        return (self[position] for position in range(len(self)))

    @overload
    def __getitem__(self, item: int) -> Answered: ...
    @overload
    def __getitem__(self, item: str) -> "NDArray[float64]": ...
    def __getitem__(self, item: int | str) -> "Answered | NDArray[float64]":
        """Return the answer at a position, or the values of a quantity in SI units, with nan for a missing value."""
        if isinstance(item, str):
            import numpy

            wanted, blocks = self._all
            name = named(item, wanted.names)
            if name not in wanted.names:
                raise BadRequest(f"{quoted(item)} is not in these answers, which have {listed(wanted.names)}")
            return numpy.concatenate([columns.column(name) for columns in blocks])
        if not -len(self) <= item < len(self):
            raise IndexError(f"there are {len(self)} answers")
        return Answered(Report(self._question, self._sweep.row(item % len(self))))

    @cached_property
    def _all(self) -> tuple[Wanted, Sequence[Columns]]:
        """The wanted columns, which are all quantities with their best ranges, and the values in blocks of rows."""
        wanted = self._sweep.wanted(self._question.quantities, self._question.named)
        wanted = wanted.with_best(wanted.names)
        return wanted, [*self._sweep.columns(wanted)]

    def to_dict(self) -> dict[str, list[Any]]:
        """Return the columns of `--csv --best` by their headers, such as "radius [m]", in SI units."""
        heads, *blocks = written(Lists(), *self._all, AS_USUAL)
        columns = zip(heads, *blocks, strict=True)
        return {head: [*chain.from_iterable(map(as_list, parts))] for head, *parts in columns}

    def to_pandas(self) -> Any:
        """Return a DataFrame with a row for each answer and the columns of `to_dict`."""
        return import_module("pandas").DataFrame(self.to_dict())

    @property
    def drawn(self) -> "Drawn":
        """A picture of the first quantity over the input with the most values, as `jkroll map` draws it.

        If no input has several values, it shows the force curve by each law. Raises BadRequest for several pairs of
        materials without such an input.
        """
        from .drawn import lines_over_input

        return lines_over_input(self._question.headline[0], self._sweep)

    def plot(self, ax: "Axes | None" = None, style: str = "paper") -> Any:
        """Draw the answers on matplotlib axes, or on those of a new figure; return them. Needs the extra `plot`."""
        return self.drawn.plot(ax, style)

    # --- The table ----------------------------------------------------------------------------------------------------

    @cached_property
    def _in_table(self) -> Wanted:
        """The wanted columns of the table."""
        return columns_in_table(self._question, self._sweep)

    @cached_property
    def _blocks(self) -> Sequence[Columns]:
        """The values of the table, in blocks of rows."""
        return [*self._sweep.columns(self._in_table)]

    @cached_property
    def _tally(self) -> Tally:
        """The counts of rows, and of those without a result, with empty cells or with doubts."""
        tally = Tally()
        for columns in self._blocks:
            tally = tally.plus(Tally.of(columns, symbol_of))
        return tally

    @cached_property
    def _groups(self) -> Sequence[tuple[Frame, Sequence[str]]]:
        """A frame for each group of rows with the same inputs, and the quantities that the group shows."""
        return [*self._sweep.noted(self._in_table)]

    @property
    def _form(self) -> Format:
        """The number format, which names the given inputs, without their texts, as each may have several values."""
        typed: dict[str, str] = {}
        for name in self._sweep.spreads:
            typed[name] = ""
            typed.setdefault(CONVERTED.get(name, name), "")
        return Format(typed=typed)

    def __repr__(self) -> str:
        symbols = (NOMENCLATURE[name].symbol for name in self._question.headline)
        return f"<Answers: {listed(symbols)} of {len(self)} scenes>"

    def __str__(self) -> str:
        return as_text(part if isinstance(part, str) else in_width(*part) for part in self._parts())

    def _parts(self) -> Iterable[Part]:
        return parts_of_answers(self._groups, self._blocks, self._in_table, self._tally, self._form)


# --- The question -----------------------------------------------------------------------------------------------------


@overload
def answer(  # type: ignore[overload-overlap]  # single values also match the next overload
    wanted: str | Iterable[str],
    /,
    *,
    material: str | Material | None = None,
    material2: str | Material | None = None,
    materials: Materials | None = None,
    model: str | None = None,
    profile: str | None = None,
    **given: "Single",
) -> Answered: ...
@overload
def answer(
    wanted: str | Iterable[str],
    /,
    *,
    material: Solids = None,
    material2: Solids = None,
    materials: Materials | None = None,
    model: str | Sequence[str] | None = None,
    profile: str | None = None,
    **given: "Several",
) -> Answers: ...
@overload
def answer(wanted: str | Iterable[str], /, **scene: Any) -> Any: ...
def answer(
    wanted: str | Iterable[str],
    /,
    *,
    material: Solids = None,
    material2: Solids = None,
    materials: Materials | None = None,
    model: str | Sequence[str] | None = None,
    profile: str | None = None,
    **given: Any,
) -> Any:
    """Answer a question about one scene, or about each combination of lists, with best ranges, doubts and notes.

    Parameters
    ----------
    wanted
        A command, such as "pull-off" or "report", or names of quantities, as for `solve`.
    material, material2, materials, model, profile, **given
        The scene, as in `solve`. Lists of materials, laws and values stand for several scenes: all their combinations,
        as in the command, not element by element. `jkroll.table` answers a table row by row. A radius or diameter of
        a metre or more, given as a number without a unit, gives a warning: 100 means 100 m.

    Returns
    -------
    For one scene, an object with `values` by name, `inputs`, `doubts`, `notes` and `as_dict()`. For lists, `Answers`:
    iteration gives one such object for each scene, and `print` shows a table; it has `to_pandas()` and `to_dict()`. All
    numbers are in SI units.

    Raises
    ------
    BadRequest, MissingInput, UnknownMaterial, UnknownQuantity, QuantityError
        An input is wrong, or a necessary one is missing, or there are too many scenes.
    NoResult
        There is no contact, or no result at all. If only some results lack a value, each of them has a `reason`.

    >>> answered = answer("pull-off", material="quartz", radius="100 nm")
    >>> str(answered["pull_off_force"]), answered["P_c"].unit
    ('11.781 nN', 'N')
    >>> low, high, by = answered.best["pull_off_force"]
    >>> round(low, 10), round(high, 10), by
    (1.42e-08, 1.53e-08, 'Maugis')
    >>> several = answer("pull-off", material=["quartz", "iron"], radius=["100 nm", "1 um"])
    >>> [str(each["P_c"]) for each in several]
    ['11.781 nN', '117.81 nN', '1.41372 µN', '14.1372 µN']
    """
    words: dict[str, Any] = {"material": material, "material2": material2, "model": model}
    values = _values(given)
    is_single = not any(map(is_list, words.values())) and not any(map(_is_several, given.values()))
    question = _question(wanted)
    if is_single:
        one = {name: value for name, (value,) in values.items()}
        pair = materials_of(words["material"], words["material2"], materials)
        report = Report(question, Frame(one, *pair, model=law_given(words["model"], profile)))
        if report.failure is not None and report.has_no_headline:
            raise report.failure
        return Answered(report)
    _refuse_rows({**words, **given})
    solids, solids2, models = (_listed(name, word) for name, word in words.items())
    materials1 = [materials_of(solid, None, materials)[0] for solid in solids]
    materials2 = [materials_of(None, solid, materials)[1] for solid in solids2]
    laws = laws_given(models, profile)
    spreads = {name: _spreads(name, numbers) for name, numbers in values.items()}
    sweep = Sweep([*product(materials1, materials2)], spreads, laws)
    count = len(sweep)
    if count > sweep.sizes.most_in_table:
        raise BadRequest(f"{count} scenes are more than {sweep.sizes.most_in_table}; jkroll.solve takes any number")
    answers = Answers(question, sweep)
    if answers._tally.failed == count:
        failure = answers[0]._answer.failure
        if failure is not None:
            raise failure
    return answers


def _question(wanted: str | Iterable[str]) -> Question:
    """Return the question of a command, or a question about quantities."""
    if isinstance(wanted, str) and wanted in QUESTIONS:
        return QUESTIONS[wanted]
    return question_about(",".join(words_in(wanted)))


def _is_several(value: Any) -> bool:
    return isinstance(value, list | tuple) or getattr(value, "ndim", 0) > 0


def _values(given: Mapping[str, Any]) -> dict[str, list[Any]]:
    """Return the values of inputs in SI units, by name, in the order of the nomenclature. Raises QuantityError."""
    lists = {word: [*value] if isinstance(value, list | tuple) else [value] for word, value in given.items()}
    for word, items in lists.items():
        if not items:
            raise QuantityError(word, "[]", "is an empty list")
        if isinstance(items[0], list | tuple):
            raise QuantityError(word, str(items), "is a list of lists", "give a list of values")
    reader, firsts = Reader(), {word: items[0] for word, items in lists.items()}
    read = reader.in_si(firsts)  # in the order of the words
    values: dict[str, list[Any]] = {}
    for (name, first), (_, *others) in zip(read.items(), lists.values(), strict=True):
        values[name] = []
        for value in [first, *(reader.number(name, other) for other in others)]:
            if getattr(value, "ndim", 0) > 1:
                raise QuantityError(name, "an array", "has more than one dimension", "give a list of values")
            values[name] += value.tolist() if hasattr(value, "tolist") else [value]
    warn_of_metres(_largest_numbers(lists))
    return {name: values[name] for name in NOMENCLATURE if name in values}


def _largest_numbers(lists: Mapping[str, Iterable[Any]]) -> dict[str, float]:
    """Return the largest number without a unit in each list that has such numbers."""
    largest = {}
    for word, values in lists.items():
        numbers = [value for value in values if isinstance(value, NUMBER)]
        if numbers:
            largest[word] = max(numbers)
    return largest


def _spreads(name: str, values: Iterable[Any]) -> list[Spread]:
    """Return the values of an input as spreads. Raises QuantityError for a value outside its range."""
    spreads = []
    for value in values:
        check_range(name, middle(value))
        spreads.append(Spread.of(value))
    return spreads


def _listed(name: str, words: Any) -> list[Any]:
    """Return the words of a list, or one word as a list. Raises QuantityError for an empty list."""
    several = [*words] if is_list(words) else [words]
    if not several:
        raise QuantityError(name, "[]", "is an empty list")
    return several


def _refuse_rows(given: Mapping[str, Any]) -> None:
    """Raise BadRequest for several columns of a table: their rows belong together, but lists are combined."""
    columns = [name for name, value in given.items() if value is not None and axes_of(value)]
    if len(columns) > 1:
        problem = f"{listed(columns)} are columns, whose rows belong together, but answer combines lists"
        raise BadRequest(f"{problem}: jkroll.table answers a table row by row")
