"""Tables on a terminal, fitted to its width: for one answer, and for a list of pairs."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from math import isnan
from typing import TYPE_CHECKING, Any, NamedTuple, TextIO

from ..model.estimate import (
    BETTER_LAW,
    DEFINITION,
    GAP,
    KELVIN,
    LAW_IN_USE,
    NONE,
    SCALED,
    SPACING_ASSUMED,
    WORDS,
    XI_UNKNOWN,
    Estimate,
)  # fmt: skip
from ..model.limits import codes
from ..model.rows import DOUBT, as_list
from ..quantities.formatting import (
    DIGITS,
    RESULT_DIGITS,
    Format,
    ShownUnit,
    amount,
    in_words,
    symbol_among,
    with_unit,
)
from ..quantities.laws import BETWEEN, DEFAULT_LAW, LAWS
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES, STATE_OR_LOAD, XI, of_sphere
from ..quantities.shown import Part, Table, cell, columns_of
from ..quantities.values import Uncertain, middle, with_sides
from ..report.best_ranges import about_surfaces, lines_on_rules, range_in_unit
from ..report.inferred import about_library, laws_of, library_values, solids_of
from ..report.notes import lines_above, lines_on_codes
from ..text import TextColumn, first_of, fit_terminal, listed, say_wrapped, text_columns, write_table

if TYPE_CHECKING:
    from ..model.rows import Columns
    from ..report.answer import Result
    from ..report.questions import Question
    from ..report.report import Report


# A row keeps the unit of the rows above if its smallest number in that unit lies between _LEAST and _MOST, and its
# largest is at most _LARGEST.
_LEAST, _MOST, _LARGEST = 0.25, 2000, 10000
_ON_SURFACE = "surface"  # the word in the column "by" for a pull-off force of real spheres
_BY_LAW = f" by {LAWS[DEFAULT_LAW].short}"  # suffix of the header of JKR's column, which follows the best range
_OVER_SPACINGS = {SCALED, XI_UNKNOWN, SPACING_ASSUMED, BETTER_LAW}  # rules whose ranges vary the atomic spacing
_CODES = 24  # codes with more characters are shortened in a narrow table
_OF_MATERIALS = {"material": [*PROPERTIES], "material2": [of_sphere(2, name) for name in PROPERTIES]}
_OF_PAIR = {"work_of_adhesion", "contact_modulus"}  # inputs that tell nothing of each solid
# Inputs that follow from others have no column unless they were typed. γ of a material keeps its column.
_FOLLOWING = {"radius2", "energy"}.union(*_OF_MATERIALS.values()) - {"surface_energy"}


# --- Values and inputs ------------------------------------------------------------------------------------------------


def _about_inputs(
    prefix: str,
    inputs: "Mapping[str, float | str | Uncertain]",
    assumed: Mapping[str, str],
    form: Format,
    several: Sequence[str] = (),
) -> Iterator[str]:
    """Iterate over a line with the given inputs after a prefix, and one with the assumptions.

    The properties of a material follow it in brackets. `several`: the inputs that differ between rows.
    """
    not_given = {*assumed, "energy"}.difference(form.typed)  # assumed, or computed from another input
    inputs = {name: value for name, value in inputs.items() if name not in not_given}
    texts = {name: f"{symbol_among(name, inputs)} = {amount(name, value, form)}" for name, value in inputs.items()}
    if "surface_energy" in texts and "surface_energy2" not in texts:
        texts["surface_energy"] += " per surface"
    if {"radius", "radius2"} <= texts.keys() and inputs["radius2"] in (inputs["radius"], "plane"):
        radius = amount("radius", inputs["radius"], form)
        if inputs["radius2"] == "plane":
            texts["radius"] = f"R1 = {radius} on a plane{_of_solid(inputs, several)}"
        else:
            texts["radius"] = f"R1 = R2 = {radius}"
        del texts["radius2"]
    for material, properties in _OF_MATERIALS.items():
        if material not in texts:
            continue
        texts[material] = str(inputs[material])
        if "material" not in inputs:
            texts[material] = f"sphere 2: {inputs[material]}"
        values = []
        for name in properties:
            if name in texts and name not in form.typed:
                values.append(texts.pop(name))
        if values:
            texts[material] += f" ({', '.join(values)})"
    line = ", ".join(filter(None, [prefix, *texts.values()]))
    if line:
        yield line
    if assumed:
        yield f"assumed: {', '.join(assumed.values())}"


def _of_solid(inputs: "Mapping[str, float | str | Uncertain]", several: Sequence[str]) -> str:
    """Return the solid of a plane in words.

    The text is empty if the solid differs between rows, or if only properties of the plane or of the pair are given.
    """
    names = {*inputs, *several}
    of_plane = {name for name in names if NOMENCLATURE[name].sphere == 2} - {"radius2", "diameter2"}
    solid = inputs.get("material2" if "material2" in of_plane else "material")
    if solid is not None:
        return f" of {solid}"
    is_of_pair = not names.isdisjoint(_OF_PAIR) and names.isdisjoint(PROPERTIES)
    return "" if of_plane or is_of_pair else " of the same solid"


class Row(NamedTuple):
    """The texts of a result in the table of an answer; each number has its unit."""

    quantity: str
    symbol: str
    best: str  # "14–15 nN"; "–" without a range
    by: str
    value: str  # "11.78 nN"; "–" without a value
    law: str


# --- Single answers ---------------------------------------------------------------------------------------------------


def frame_table(answer: "Report", out: TextIO, form: Format) -> None:
    """Write an answer as lines and tables."""
    for part in parts_of_frame(answer, form):
        if isinstance(part, str):
            say_wrapped(part, out)
        else:
            write_table(part, [], out)


def parts_of_frame(answer: "Report", form: Format) -> Iterator[str | list[TextColumn]]:
    """Iterate over lines and a table: the inputs of an answer, its results with best ranges, and their reasons."""
    stated = {name: value for name, value in answer.input_measures.items() if name not in answer.assumed}
    yield from _about_inputs("", stated, _assumptions(answer), form)
    yield from lines_above(answer.sentences)
    if answer.described.unknowns:
        yield _of_inferred(answer, form)
        yield from answer.lines_on_ranges(answer.estimates)
        return
    law, rows = answer.frame.law.short, _rows(answer, form)
    if rows:
        yield _of_results(_grouped(rows, answer.question), law, has_ranges=answer.shows_ranges)
        if answer.shows_ranges:
            yield from answer.lines_on_ranges(rows)
    if answer.shows_surfaces:
        yield f"{_ON_SURFACE}: {about_surfaces(answer.frame)}"


def rows_in_words(answer: "Report", form: Format) -> dict[str, Row]:
    """Return the rows of the table of an answer, by the names of their quantities."""
    law, words = answer.frame.law.short, {}
    for name, row in _rows(answer, form).items():
        if name in NOMENCLATURE:  # rows of surfaces have no quantity of their own
            best, value = _in_unit(row.best, row.unit), _in_unit(row.value, row.unit)
            words[name] = Row(row.quantity, row.symbol, best, row.by, value, law)
    return words


def _in_unit(text: str, unit: str) -> str:
    """Return the text of a number with its unit; the dash of an empty cell stays alone."""
    return text if text == "–" else with_unit(text, unit)


def _assumptions(answer: "Report") -> dict[str, str]:
    """Return the assumptions to state above the table of an answer, by name.

    If ranges use other values of ξ, the text says that the assumed ξ applies to the column of the law. The energy ratio
    is left out if no row depends on it, and the atomic spacing if ranges vary it.
    """
    texts, rules = {**answer.assumed}, {*answer.rules}
    if "energy_ratio" not in answer.frame.inputs_of(*answer.frame.possible(answer.names_in_table)):
        texts.pop("energy_ratio", None)
    if rules & _OVER_SPACINGS:
        texts.pop("atomic_spacing", None)
    if XI in texts and not rules.isdisjoint((SCALED, XI_UNKNOWN)):
        text, _, option = texts.pop(XI).rpartition(" ")
        texts[XI] = f"{text}, the shift before rolling, for the column of {answer.frame.law.short} alone {option}"
    return texts


class _Cells(NamedTuple):
    """The cells of a result in the table of an answer; one unit holds for all numbers."""

    quantity: str
    symbol: str
    best: str = ""
    by: str = ""
    value: str = ""
    measure: str = ""  # the value with its uncertainty
    unit: str = ""


_Rows = dict[str, _Cells]  # the cells of results, by name


def _rows(answer: "Report", form: Format) -> _Rows:
    """Return the rows of results, and those of real surfaces.

    Unless it was asked for by name, a result is left out if it repeats another one, or if a note has the reason why it
    has no value.
    """
    rows: _Rows = {}
    names = answer.names_in_table
    shown: set[tuple[Any, str]] = set()
    units: dict[str, ShownUnit] = {}  # the last unit used, by SI unit
    for result in answer.results:
        name, quantity = result.name, NOMENCLATURE[result.name]
        key = result.value, quantity.unit
        is_redundant = name in answer.lacking if result.value is None else key in shown
        if name not in names or (is_redundant and name not in answer.question.named):
            continue
        shown.add(key)
        estimate = answer.estimates.get(name)
        sizes, unit = _sizes(result.measure, estimate), units.get(quantity.unit)
        if unit is None or not _suits(unit, sizes):
            unit = form.common_unit(name, sizes[-1:])
        if sizes[-1]:
            units[quantity.unit] = unit
        best, by = _range(estimate, unit, form)
        has_law = estimate is None or estimate.by not in (KELVIN, GAP)
        value = cell(result.value, unit, form) if has_law else "–"
        measure = cell(result.measure, unit, form)
        symbol = symbol_among(name, answer.inputs)
        rows[name] = _Cells(quantity.sentence, symbol, best, by, value, measure, unit.text)
    return _with_surfaces(rows, answer, form) if answer.shows_surfaces else rows


def _sizes(measure: "float | Uncertain | None", estimate: "Estimate | None") -> list[float]:
    """Return the sorted sizes that determine a row's unit: of its best range, or else of the result."""
    sizes = []
    if estimate is not None:
        sizes = [abs(float(end)) for end in (estimate.low, estimate.high) if not isnan(end)]
    return sorted(sizes) if any(sizes) else [abs(middle(measure or 0.0))]


def _suits(unit: ShownUnit, sizes: Sequence[float]) -> bool:
    """Return whether a row with these sorted sizes keeps the unit of the rows above."""
    return _LEAST <= unit.convert(sizes[0]) < _MOST and unit.convert(sizes[-1]) <= _LARGEST


def _grouped(rows: _Rows, question: "Question") -> list[_Cells]:
    """Return the rows of results: first the rows without a group, then each group below its title."""
    of_group = {name: title for title, names in question.groups.items() for name in names}
    grouped = [row for name, row in rows.items() if name not in of_group]
    for title, names in question.groups.items():
        below = [rows[name] for name in names if name in rows]
        if below:
            grouped += [_Cells(f"{title}:", ""), *below]
    return grouped


def _with_surfaces(rows: _Rows, answer: "Report", form: Format) -> _Rows:
    """Return the rows of results, with a row for each kind of real surface before that of the pull-off force.

    The pull-off force of smooth spheres is then called a limit.
    """
    extended: _Rows = {}
    for name, row in rows.items():
        surfaces = answer.surfaces_of(name)
        if surfaces:
            (_, most), *_ = answer.ranges.of_laws(name, LAW_IN_USE)
            unit = form.common_unit(name, [most])
            for surface, ends in surfaces.items():
                held, _ = _range(Estimate(*ends, SCALED), unit, form)
                extended[surface] = _Cells(surface, row.symbol, held, _ON_SURFACE, "–", "–", unit.text)
            extended[name] = row._replace(quantity=f"{row.quantity}, limit")
        else:
            extended[name] = row
    return extended


def _of_results(rows: Sequence[_Cells], law: str, *, has_ranges: bool) -> list[TextColumn]:
    """Return the columns of rows of results.

    Best ranges include the uncertainties, and the column of the law then has bare values. Without ranges, this column
    shows the uncertainties.
    """
    if has_ranges:
        heads = ["quantity", "symbol", "best range", "by", law, "unit"]
        cells = [[row.quantity, row.symbol, row.best, row.by, row.value, row.unit] for row in rows]
    else:
        heads = ["quantity", "symbol", law, "unit"]
        cells = [[row.quantity, row.symbol, row.measure, row.unit] for row in rows]
    columns = text_columns([heads, *cells], words=2)
    return [column._replace(is_right=column.head in ("best range", law)) for column in columns]


def _range(estimate: "Estimate | None", unit: ShownUnit, form: Format) -> tuple[str, str]:
    """Return the best range of a result and its rule, in words; "–" for an estimate without a range."""
    if estimate is None or not estimate.by > NONE:  # by is nan in a row without this quantity
        return "–", "–"
    return "".join(range_in_unit(estimate, unit, form)), WORDS[int(estimate.by)]


# --- Inferred values --------------------------------------------------------------------------------------------------


def _of_inferred(answer: "Report", form: Format) -> list[TextColumn]:
    """Return the columns of inferred values and of library values, with rows for each law, Maugis' law first.

    The column of the library is left out if the library has none of the values. If a value is far from the library's,
    no law is called the best.
    """
    library = library_values(answer.described)
    best = "" if any(about_library(answer)) else " (best)"
    rows = []
    for law in laws_of(answer):
        is_better = law != answer.frame.law.name
        by = LAWS[law].short + (best if is_better else "")
        for result in answer.results:
            cells = _inferred_cells(result, library.get(result.name), answer, form, is_better=is_better)
            rows.append([NOMENCLATURE[result.name].sentence, symbol_among(result.name, answer.inputs), by, *cells])
    solids: dict[str, None] = {}
    for name in library:
        solids |= dict.fromkeys(solids_of(answer.described, name))
    head_of_library = f"{listed(solids or ['library'])} has"
    heads = ["quantity", "symbol", "law", "inferred", head_of_library, "unit"]
    columns = text_columns([heads, *rows], words=3)
    columns = [column._replace(is_right=column.head in ("inferred", head_of_library)) for column in columns]
    index = heads.index(head_of_library)
    if len(solids) > 1 or not fit_terminal(columns):
        columns[index] = columns[index]._replace(head="library has")
    if not library:
        del columns[index]
    return columns


def _inferred_cells(
    result: "Result", known: "float | Uncertain | None", answer: "Report", form: Format, *, is_better: bool
) -> list[str]:
    """Return the cells of an inferred value: the value, or the range by the better law; the library's; the unit."""
    unit = form.common_unit(result.name, [result.measure if known is None else known])
    inferred = cell(result.measure, unit, form)
    if is_better:
        inferred, _ = _range(Estimate(*answer.ranges.by_better_law(result.name), BETTER_LAW), unit, form)
    of_library = "–"
    if known is not None:
        of_library = Format(form.units, form.digits or RESULT_DIGITS).in_unit(known, unit)
    return [inferred, of_library, unit.text]


# --- Lists ------------------------------------------------------------------------------------------------------------


def sweep_table(columns: "Columns", out: TextIO, form: Format, assumed: Mapping[str, str], lead: str = "") -> None:
    """Write a list as a table with a row for each pair, or with a column for each if only that fits the terminal."""
    for part in parts_of_rows(columns, form, assumed, lead):
        if isinstance(part, str):
            say_wrapped(part, out)
        else:
            write_table(*in_width(*part), out)


def parts_of_rows(columns: "Columns", form: Format, assumed: Mapping[str, str], lead: str = "") -> Iterator[Part]:
    """Iterate over the parts of a list: lines on common inputs and assumptions, a table, and lines that explain it.

    The `lead` stands above the table. The table has a row for each pair; the lines below it give the meaning of rules
    and codes.
    """
    names, inputs = columns.wanted.names, {}
    for name, column in columns.inputs.items():
        inputs[name] = [in_words(name, value) for value in as_list(column)]
    distinct = {name: {*values} - {None} for name, values in inputs.items()}  # None: not an input of the row
    common = {name: next(iter(values)) for name, values in distinct.items() if len(values) == 1}
    several = [name for name in inputs if name not in common]
    models = distinct.get("model", set())
    count = _count(len(columns) // max(len(models), 1), inputs)  # a pair has a row for each law
    if "radius2" in several and "radius2" not in form.typed:
        count += " of equal spheres (R2 = R1)"
    if any(map(columns.wanted.best_of, names)):  # ranges vary the atomic spacing
        assumed = {name: text for name, text in assumed.items() if name != "atomic_spacing"}
        if "atomic_spacing" not in form.typed:
            common.pop("atomic_spacing", None)
    yield from _about_inputs(count, common, assumed, form, several)
    if BETWEEN in models and "model" in several:
        of_parameter = "; μ is the Tabor parameter" if "tabor_parameter" in names else ""
        yield f"of these laws, {BETWEEN} is the better one; best ranges: leave out --model{of_parameter}"
    leading = _input_columns({name: inputs[name] for name in several}, inputs, form)
    results, rules, to_take = _result_columns(columns, form, has_models="model" in several)
    shown = [codes(bits & columns.wanted.reported_doubts) for bits in as_list(columns.doubts)]
    if any(shown):
        results.append(TextColumn(DOUBT, shown, is_right=False))
    if to_take:
        is_compared = any(_BY_LAW in column.head for column in results)
        others = f"; columns{_BY_LAW} are for comparison" if is_compared else ""
        yield f"take {listed([f'best {symbol}' for symbol in to_take])}{others}"
    if lead:
        yield lead
    yield leading, results
    yield from lines_on_rules([int(by) for by in rules if not isnan(by)])
    yield from lines_on_codes(" ".join(shown).split())


def _input_columns(several: Mapping[str, list[Any]], inputs: Collection[str], form: Format) -> list[TextColumn]:
    """Return the columns of the inputs that differ between rows; inputs that follow from others have none."""
    exact, columns = Format(form.units, form.digits or DIGITS), list[TextColumn]()
    following = _FOLLOWING | STATE_OR_LOAD if "state" in inputs else _FOLLOWING
    for name, values in several.items():
        if name in form.typed or name not in following:
            columns += columns_of(name, {symbol_among(name, inputs): values}, exact)
    return columns


def _count(number: int, inputs: Collection[str]) -> str:
    """Return the number of pairs or states, if there are several, and the law of states; it may be empty."""
    count = ""
    if number > 1:
        count = f"{number} states" if "state" in inputs else f"{number} pairs"
    if "state" in inputs and "model" not in inputs:  # the default law gives the states of a force curve
        count += f" by {LAWS[DEFAULT_LAW].short} (--model)"
    return count


def in_width(leading: list[TextColumn], results: list[TextColumn]) -> Table:
    """Return the columns of a list in a form that suits the terminal.

    Codes are shortened if they do not fit, and a pair becomes a column if only that fits.
    """
    if results and results[-1].head == DOUBT and not fit_terminal([*leading, *results]):
        cut = [text if len(text) <= _CODES else first_of(text.split(), 1) for text in results[-1].cells]
        results = [*results[:-1], results[-1]._replace(cells=cut)]
    across = text_columns([(column.head, *column.cells) for column in (*leading, *results)], words=1)
    if fit_terminal(across) and not fit_terminal([*leading, *results]):
        return across[:1], across[1:]
    return leading, results


def _result_columns(
    columns: "Columns", form: Format, *, has_models: bool
) -> tuple[list[TextColumn], list[float], list[str]]:
    """Return the columns of results, the rules of all ranges, and the symbols of the ranges to take."""
    results, rules, to_take = list[TextColumn](), list[float](), list[str]()
    for name in columns.wanted.names:
        if name in columns.inputs:
            continue
        of_quantity, of_rows = _of_quantity(columns, name, form, has_models=has_models)
        results += of_quantity
        rules += of_rows
        if len(of_quantity) > 1:
            to_take.append(symbol_among(name, columns.inputs))
    return results, rules, to_take


def _of_quantity(
    columns: "Columns", name: str, form: Format, *, has_models: bool
) -> tuple[list[TextColumn], list[float]]:
    """Return the columns of a quantity with its best ranges, and the rule of each range.

    `has_models`: True if rows have different laws. A single column then suffices: it has a range where the law of the
    row leaves the atomic spacing open.
    """
    best, rules = _best(columns, name, form)
    head = symbol_among(name, columns.inputs)
    if best and "model" not in columns.inputs and not {by for by in rules if by > NONE} <= {KELVIN, GAP}:
        head += _BY_LAW
    (values,) = columns_of(name, {head: _measures(columns, name)}, form)
    if best and has_models:
        return [_with_ranges(values, best[0], rules)], rules
    return [*best, values], rules


def _best(columns: "Columns", name: str, form: Format) -> tuple[list[TextColumn], list[float]]:
    """Return the columns of the best range of a quantity and of its rule, and the rule of each row.

    The columns are left out if all ranges come from a definition, from the law in use or a given one, or from any law.
    """
    if not columns.wanted.best_of(name):
        return [], []
    lows, highs, rules = (as_list(columns.column(key)) for key in columns.wanted.best_of(name))
    if not any(DEFINITION < by < LAW_IN_USE for by in rules):
        return [], []
    unit = form.common_unit(name, _measures(columns, name))
    ranges, words = [], []
    for low, high, by in zip(lows, highs, rules, strict=True):
        text, word = _range(Estimate(low, high, by), unit, form)
        ranges.append(text)
        words.append(word)
    head = f"best {symbol_among(name, columns.inputs)}"
    if unit.text:
        head += f" [{unit.text}]"
    return [TextColumn(head, ranges), TextColumn("by", words, is_right=False)], rules


def _with_ranges(values: TextColumn, ranges: TextColumn, rules: Sequence[float]) -> TextColumn:
    """Return a column of values, with a range in rows whose law leaves the atomic spacing open."""
    cells = []
    for value, best, by in zip(values.cells, ranges.cells, rules, strict=True):
        cells.append(best if by == SPACING_ASSUMED else value)
    return values._replace(cells=cells)


def _measures(columns: "Columns", name: str) -> list[Any]:
    """Return the values of a quantity with their uncertainties; None for empty cells."""
    keys = columns.wanted.sides_of(name)
    sides = [as_list(columns.column(key)) for key in keys.values()]
    measures = []
    for value, *of_row in zip(as_list(columns.column(name)), *sides, strict=True):
        measures.append(None if isnan(value) else with_sides(value, dict(zip(keys, of_row, strict=True))))
    return measures
