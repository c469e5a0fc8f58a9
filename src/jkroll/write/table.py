"""Tables on a terminal, fitted to its width: for one answer, and for a list of pairs."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from math import isnan
from typing import TYPE_CHECKING, Any, NamedTuple, TextIO

from ..model.estimate import (
    ANY_LAW,
    BETTER_LAW,
    DEFINITION,
    FRICTION_ASSUMED,
    GAP,
    KELVIN,
    LAW_IN_USE,
    LAW_ONLY,
    NONE,
    SCALED,
    SPACING_ASSUMED,
    WORDS,
    XI_UNKNOWN,
    Estimate,
)  # fmt: skip
from ..model.limits import codes
from ..model.measured import on_surfaces
from ..model.rows import DOUBT, as_list
from ..quantities.formatting import (
    DIGITS,
    RESULT_DIGITS,
    Format,
    amount,
    from_to,
    in_words,
    significant,
    symbol_among,
    with_unit,
)
from ..quantities.laws import BETWEEN, DEFAULT_LAW, LAWS
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES, STATE_OR_LOAD, XI, of_sphere
from ..quantities.shown import Rows, cell, columns_of
from ..quantities.units import Unit, convert
from ..quantities.values import Uncertain, middle, with_sides
from ..report.inferred import laws_of, library_values, solids_of
from ..report.notes import lines_above, lines_on_codes
from ..report.ranges import about_surfaces, lines_on_rules
from ..text import TextColumn, first_of, fit_terminal, listed, say_wrapped, text_columns, write_table

if TYPE_CHECKING:
    from ..model.rows import Columns
    from ..report.questions import Question
    from ..report.report import Report


# A row keeps the unit of the rows above if its least number is from _LEAST to _MOST, its largest at most _LARGEST.
_LEAST, _MOST, _LARGEST = 0.25, 2000, 10000
_SAME = 1e-12  # relative width below which a range is a number
_BEST_RANGE = "best range"
_AS_SILICA = "as SiO2"  # the rule for a pull-off force on a surface
_CODES = 24  # characters of the codes in a cell
_OF_MATERIALS = {"material": [*PROPERTIES], "material2": [of_sphere(2, name) for name in PROPERTIES]}
# Inputs without a column unless they were typed, since they follow from others; γ of a material keeps its column.
_FOLLOWING = {"radius2", "energy"}.union(*_OF_MATERIALS.values()) - {"surface_energy"}


# --- Values and inputs ------------------------------------------------------------------------------------------------


def _about_inputs(
    lead: str,
    inputs: "Mapping[str, float | str | Uncertain]",
    assumed: Mapping[str, str],
    form: Format,
    several: Sequence[str] = (),
) -> Iterator[str]:
    """Iterate over a line with the given inputs after a prefix, and one with the assumptions.

    A material has its values in brackets. `several`: the inputs that differ between rows.
    """
    follows = {*assumed, "energy"}.difference(form.typed)  # from another input
    inputs = {name: value for name, value in inputs.items() if name not in follows}
    texts = {name: f"{symbol_among(name, inputs)} = {amount(name, value, form)}" for name, value in inputs.items()}
    if "surface_energy" in texts and "surface_energy2" not in texts:
        texts["surface_energy"] += " per surface"
    if {"radius", "radius2"} <= texts.keys() and inputs["radius2"] in (inputs["radius"], "plane"):
        radius = amount("radius", inputs["radius"], form)
        on_plane = f"R1 = {radius} on a plane{_of_solid(inputs, several)}"
        texts["radius"] = on_plane if inputs["radius2"] == "plane" else f"R1 = R2 = {radius}"
        del texts["radius2"]
    for material, properties in _OF_MATERIALS.items():
        if material in texts:
            data = [texts.pop(name) for name in properties if name in texts and name not in form.typed]
            solid = inputs[material] if "material" in inputs else f"sphere 2: {inputs[material]}"
            texts[material] = f"{solid} ({', '.join(data)})" if data else str(solid)
    line = ", ".join(filter(None, [lead, *texts.values()]))
    if line:
        yield line
    if assumed:
        yield f"assumed: {', '.join(assumed.values())}"


def _of_solid(inputs: "Mapping[str, float | str | Uncertain]", several: Sequence[str]) -> str:
    """Return the solid of sphere 2 in words, unless it differs between rows or its own properties are given."""
    own = {name for name in (*inputs, *several) if NOMENCLATURE[name].sphere == 2} - {"radius2", "diameter2"}
    solid = inputs.get("material2" if "material2" in own else "material")
    if solid is not None:
        return f" of {solid}"
    return "" if own else " of the same solid"


class Row(NamedTuple):
    """A result as in the table of an answer: its name, best range and rule, and its value by the law in use."""

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
    """Iterate over lines and tables: the inputs of an answer, its results with best ranges, and their reasons.

    Conventions of other codes follow below.
    """
    stated = {name: value for name, value in answer.measures.items() if name not in answer.assumed}
    yield from _about_inputs("", stated, _in_column(answer), form)
    yield from lines_above(answer.sentences)
    if answer.described.unknowns:
        yield _of_inferred(answer, form)
        yield from answer.lines_on_ranges(answer.estimates)
        return
    law = answer.frame.law.short
    physics, conventions = _rows(answer, form)
    if answer.shows_surfaces:
        physics = _with_surfaces(physics, answer, form)
    if physics:
        columns = _of_results(_grouped(physics, answer.question), law)
        yield columns
        if any(column.head == _BEST_RANGE for column in columns):
            yield from answer.lines_on_ranges(physics)
    if answer.shows_surfaces:
        yield f"{_AS_SILICA}: {about_surfaces(answer.frame)}"
    if conventions:
        yield "conventions of other codes and authors, to compare with them"
        yield _of_results([*conventions.values()], law)


def rows_in_words(answer: "Report", form: Format) -> dict[str, Row]:
    """Return the rows of the table of an answer by name; each number has its unit."""
    found: dict[str, Row] = {}
    for rows in _rows(answer, form):
        for name, (quantity, symbol, best, by, value, _, unit) in rows.items():
            texts = (text if text == "–" else with_unit(text, unit) for text in (best, value))
            found[name] = Row(quantity, symbol, next(texts), by, next(texts), answer.frame.law.short)
    return found


def _in_column(answer: "Report") -> dict[str, str]:
    """Return the assumptions of a table by name: ξ as that of the law's column, no spacing if ranges have their own."""
    texts, rules = {**answer.assumed}, {estimate.by for estimate in answer.estimates.values()}
    if "energy_ratio" not in answer.frame.inputs_of(*answer.frame.possible(answer.names_in_table)):
        texts.pop("energy_ratio", None)
    if any(by < LAW_IN_USE and by not in (DEFINITION, FRICTION_ASSUMED, LAW_ONLY) for by in rules):
        texts.pop("atomic_spacing", None)  # ranges use their own
    if XI in texts and not rules.isdisjoint((SCALED, XI_UNKNOWN)):
        text, _, option = texts.pop(XI).rpartition(" ")
        texts[XI] = f"{text} in the column of {answer.frame.law.short} {option}"
    return texts


_Rows = dict[str, list[str]]  # the cells of results, by name


def _rows(answer: "Report", form: Format) -> tuple[_Rows, _Rows]:
    """Return the rows of results, and those of conventions.

    Results that repeat another one are left out, and so are results that lack an input, which a note reports.
    """
    physics: _Rows = {}
    conventions: _Rows = {}
    names = answer.names_in_table
    shown: set[tuple[Any, str]] = set()
    units: dict[str, tuple[str, Unit]] = {}  # by SI unit: the last unit used, kept even for values somewhat below 1
    for result in answer.results:
        name, quantity = result.name, NOMENCLATURE[result.name]
        is_known = name in answer.lacking if result.value is None else (result.value, quantity.unit) in shown
        if name not in names or (is_known and name not in answer.question.named):
            continue
        shown.add((result.value, quantity.unit))
        estimate = answer.estimates.get(name)
        sizes, unit = _sizes(result.measure, estimate), units.get(quantity.unit)
        if not unit or not _LEAST <= convert(sizes[0], unit[1]) < _MOST or convert(sizes[-1], unit[1]) > _LARGEST:
            unit = form.common_unit(name, sizes[-1:])
        if sizes[-1]:
            units[quantity.unit] = unit
        row = [quantity.sentence, symbol_among(name, answer.inputs), *_range(estimate, unit, form)]
        row += [cell(result.value, unit, form), cell(result.measure, unit, form), unit[0]]
        if estimate and estimate.by in (KELVIN, GAP):  # no law of adhesion enters
            row[4] = "–"
        is_convention = estimate and estimate.by == DEFINITION and f"{{{name}}}" not in answer.question.lead
        (conventions if is_convention else physics)[name] = row
    return physics, conventions


def _grouped(rows: _Rows, question: "Question") -> list[list[str]]:
    """Return the rows of results, with a row for the title of each group."""
    titles, title = {}, ""
    for name in question.quantities:
        titles[name] = title = question.groups.get(name, title)
    grouped, shown = [], ""
    for name, row in rows.items():
        title = titles.get(name, shown)
        if title != shown:
            grouped.append([f"{title}:", *["" for _ in row[1:]]])
        grouped.append(row)
        shown = title
    return grouped


def _sizes(measure: "float | Uncertain | None", estimate: "Estimate | None") -> list[float]:
    """Return the sorted sizes that determine a row's unit: of its best range, or else of the result."""
    ends = [] if estimate is None else [float(end) for end in estimate[:2] if not isnan(end)]
    return sorted(map(abs, ends if any(ends) else [middle(measure or 0.0)]))


def _with_surfaces(rows: _Rows, answer: "Report", form: Format) -> _Rows:
    """Return the rows of results, with those of measured pull-off forces below the computed one."""
    found: _Rows = {}
    for name, row in rows.items():
        if name != "pull_off_force":
            found[name] = row
            continue
        found[name] = [f"{row[0]}, smooth", *row[1:]]
        by_law_in_use, *_ = answer.ranges.of_laws(name, LAW_IN_USE)
        unit = form.common_unit(name, by_law_in_use[1:])
        for surface, ends in on_surfaces(answer.frame, by_law_in_use).items():
            shown, _ = _range(Estimate(*ends, SCALED), unit, form)
            found[surface] = [surface, "P_c", shown, _AS_SILICA, "–", "–", unit[0]]
    return found


def _of_results(rows: Sequence[Sequence[str]], law: str) -> list[TextColumn]:
    """Return the columns of rows of results.

    Ranges are left out if all of them are values of the law in use. Otherwise they include the uncertainties, and the
    column of the law does not.
    """
    if {row[3] for row in rows} <= {law, WORDS[DEFINITION], WORDS[ANY_LAW], "–", ""}:
        heads, rows = ["quantity", "symbol", law, "unit"], [[*row[:2], *row[5:]] for row in rows]
    else:
        heads = ["quantity", "symbol", _BEST_RANGE, "by", f"plain {law}", "unit"]
        rows = [[*row[:5], row[6]] for row in rows]
    columns = text_columns([heads, *rows], words=2)
    columns = [column._replace(is_right=column.head not in (*heads[:2], "by", "unit")) for column in columns]
    if not fit_terminal(columns):
        columns = [column._replace(head=column.head.removeprefix("plain ")) for column in columns]
    return columns


def _range(estimate: "Estimate | None", unit: tuple[str, Unit], form: Format) -> list[str]:
    """Return the best range of a result and its rule, in words; an open end is left out."""
    if estimate is None or not estimate.by > NONE:  # nan in a row without this quantity
        return ["–", "–"]
    low, high = (end if isnan(end) else convert(end, unit[1]) for end in estimate[:2])
    digits = form.digits or 2
    if estimate.by in (DEFINITION, LAW_ONLY, KELVIN) and form.digits is None:  # not known to all digits
        return [f"≈ {from_to(low, high)}", WORDS[int(estimate.by)]]
    if abs(high - low) <= _SAME * abs(high):
        text = significant(low, form.digits or RESULT_DIGITS, zeros=form.digits is None and low != 0)
    elif isnan(low) and isnan(high):
        text = "–"
    elif isnan(high):
        text = f"≥ {significant(low, digits + 1)}"
    elif isnan(low):
        text = f"≤ {significant(high, digits)}"
    else:
        text = from_to(low, high, form.digits)
    return [text, WORDS[int(estimate.by)]]


# --- Inferred values --------------------------------------------------------------------------------------------------


def _of_inferred(answer: "Report", form: Format) -> list[TextColumn]:
    """Return the columns of inferred values by each law, starting with the one that holds, and of library values."""
    own, library = answer.frame.law.name, library_values(answer.described)
    exact = Format(form.units, form.digits or RESULT_DIGITS)
    rows = []
    for law in laws_of(answer):
        for result in answer.results:
            name, known = result.name, library.get(result.name)
            unit = form.common_unit(name, [result.measure if known is None else known])
            better = Estimate(*answer.ranges.by_better_law(name), BETTER_LAW)
            inferred = cell(result.measure, unit, form) if law == own else _range(better, unit, form)[0]
            short = f"{LAWS[law].short} (best)" if law != own else LAWS[law].short
            row = [NOMENCLATURE[name].sentence, symbol_among(name, answer.inputs), short, inferred]
            rows.append([*row, "–" if known is None else exact.in_unit(known, unit), unit[0]])
    solids = [*dict.fromkeys(chain.from_iterable(solids_of(answer.described, name) for name in library))]
    heads = ["quantity", "symbol", "law", "inferred", f"{listed(solids or ['library'])} has", "unit"]
    columns = [column._replace(is_right=column.head in heads[3:5]) for column in text_columns([heads, *rows], words=3)]
    if solids[1:] or not fit_terminal(columns):
        columns[4] = columns[4]._replace(head="library has")
    if not library:
        del columns[4]
    return columns


# --- Lists ------------------------------------------------------------------------------------------------------------


def sweep_table(columns: "Columns", out: TextIO, form: Format, assumed: Mapping[str, str], lead: str = "") -> None:
    """Write a list as a table with a row for each pair (see `parts_of_rows`), or with a column if only that fits."""
    for part in parts_of_rows(columns, form, assumed, lead):
        if isinstance(part, str):
            say_wrapped(part, out)
        else:
            write_table(*in_width(*part), out)


def parts_of_rows(columns: "Columns", form: Format, assumed: Mapping[str, str], lead: str = "") -> Iterator[str | Rows]:
    """Iterate over the lines and the table of a list: a row for each pair, then the meaning of words and codes.

    Common inputs and assumptions come first, then the `lead`.
    """
    inputs = {name: [in_words(name, value) for value in as_list(each)] for name, each in columns.inputs.items()}
    distinct = {name: {*values} - {None} for name, values in inputs.items()}  # None: not an input of the row
    common = {name: next(iter(values)) for name, values in distinct.items() if len(values) == 1}
    several = [name for name in inputs if name not in common]
    number = len(columns) // max(len(distinct.get("model", ())), 1)
    count = f"{number} {'states' if 'state' in inputs else 'pairs'}" if number > 1 else ""
    if "state" in inputs and "model" not in inputs:
        count += f" by {LAWS[DEFAULT_LAW].short} (--model)"
    if "radius2" in several and "radius2" not in form.typed:
        count += " of equal spheres (R2 = R1)"
    if any(map(columns.wanted.best_of, columns.wanted.names)):
        assumed = {name: text for name, text in assumed.items() if name != "atomic_spacing"}  # ranges use their own
        common = {name: value for name, value in common.items() if name != "atomic_spacing" or name in form.typed}
    yield from _about_inputs(count, common, assumed, form, several)
    if BETWEEN in distinct.get("model", ()) and "model" in several:
        is_named = "tabor_parameter" in columns.wanted.names
        yield f"take the rows of maugis{'; μ is the Tabor parameter' if is_named else ''}"
    exact, leading = Format(form.units, form.digits or DIGITS), list[TextColumn]()
    following = _FOLLOWING | STATE_OR_LOAD if "state" in inputs else _FOLLOWING
    for name in several:
        if name in form.typed or name not in following:
            leading += columns_of(name, {symbol_among(name, inputs): inputs[name]}, exact)
    results, rules, to_take = _results_of_rows(columns, form, "model" in several)
    shown = [codes(bits & columns.wanted.reported_doubts) for bits in as_list(columns.doubts)]
    if any(shown):
        results.append(TextColumn(DOUBT, shown, is_right=False))
    if lead:
        yield lead
    if to_take:
        yield f"take {listed(to_take)}; plain {LAWS[DEFAULT_LAW].short} is there to compare"
    yield leading, results
    of_codes = lines_on_codes(chain.from_iterable(text.split() for text in shown))
    rules_shown = (int(by) for by in rules if not isnan(by))
    yield from (*lines_on_rules(rules_shown, columns.wanted.names), *of_codes)


def _results_of_rows(
    columns: "Columns", form: Format, has_laws: bool
) -> tuple[list[TextColumn], list[float], list[str]]:
    """Return the columns of results, the rules of their ranges, and the heads of the ranges to take.

    `has_laws`: True if the rows have several laws, so that each row has the range of its own law.
    """
    results, rules, to_take = list[TextColumn](), list[float](), list[str]()
    for name in columns.wanted.names:
        if name in columns.inputs:
            continue
        best, of_rows = _best(columns, name, form)
        head = symbol_among(name, columns.inputs)
        own = f"{head} by {LAWS[DEFAULT_LAW].short}" if best and "model" not in columns.inputs else head
        of_law = columns_of(name, {own: _measures(columns, name)}, form)
        if has_laws and best:
            of_law, best = [_with_ranges(of_law[0], best[0], of_rows)], []
        elif best:
            to_take.append(f"best {head}")
        results += [*best, *of_law]
        rules += of_rows
    return results, rules, to_take


def in_width(leading: list[TextColumn], results: list[TextColumn]) -> Rows:
    """Return the columns of a list in a form that suits the terminal.

    Rows have all codes if these fit, and a pair becomes a column if only that fits.
    """
    if results and results[-1].head == DOUBT and not fit_terminal([*leading, *results]):
        cut = [text if len(text) <= _CODES else first_of(text.split(), 1) for text in results[-1].cells]
        results = [*results[:-1], results[-1]._replace(cells=cut)]
    across = text_columns([(column.head, *column.cells) for column in (*leading, *results)], words=1)
    if fit_terminal(across) and not fit_terminal([*leading, *results]):
        return across[:1], across[1:]
    return leading, results


def _best(columns: "Columns", name: str, form: Format) -> tuple[list[TextColumn], list[float]]:
    """Return the columns of the best range of a quantity and of its rule, and the rules of the rows.

    There are none if every range comes from the law in use or from a definition.
    """
    if not columns.wanted.best_of(name):
        return [], []
    lows, highs, rules = (as_list(columns.column(key)) for key in columns.wanted.best_of(name))
    words = [WORDS[NONE] if isnan(by) else WORDS[int(by)] for by in rules]
    if not any(DEFINITION < by < LAW_IN_USE for by in rules):
        return [], []
    unit = form.common_unit(name, _measures(columns, name))
    ranges = []
    for row in zip(lows, highs, rules, strict=True):
        ranges.append(_range(Estimate(*row), unit, form)[0])
    head = f"best {symbol_among(name, columns.inputs)}" + (f" [{unit[0]}]" if unit[0] else "")
    return [TextColumn(head, ranges), TextColumn("by", words, is_right=False)], rules


def _with_ranges(values: TextColumn, ranges: TextColumn, rules: Sequence[float]) -> TextColumn:
    """Return a column of values, with a range in rows whose law leaves the atomic spacing open."""
    of_rows = zip(values.cells, ranges.cells, rules, strict=True)
    cells = [best if by == SPACING_ASSUMED else value for value, best, by in of_rows]
    return values._replace(cells=cells)


def _measures(columns: "Columns", key: str) -> list[Any]:
    """Return the values of a column of results, with uncertainties if there are any; None for empty cells."""
    keys = columns.wanted.sides_of(key)
    sides = (as_list(columns.column(each)) for each in keys.values())
    measures = []
    for value, *of_row in zip(as_list(columns.column(key)), *sides, strict=True):
        measures.append(None if isnan(value) else with_sides(value, dict(zip(keys, of_row, strict=True))))
    return measures
