"""Notes on an answer or on rows, such as assumptions, doubts and missing inputs, and the lines that show them."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from math import sqrt
from typing import TYPE_CHECKING, Literal, NamedTuple, get_args

from ..errors import JkrollError
from ..model.frame import Frame
from ..model.limits import ENDING, ENDING_MEANING, LAW, LIMITS, MEANINGS, Doubt, concerning, doubts
from ..model.measured import SIO2, rolling, solid_of_pair
from ..model.plan import depends_on
from ..model.reasons import MissingInput, grouped
from ..physics.elementary import is_anywhere
from ..quantities.formatting import Format, amount, first_symbols, significant, symbol_among, symbol_of
from ..quantities.laws import BETWEEN
from ..quantities.nomenclature import DEFAULTS, INFINITY, NOMENCLATURE, STATE_OR_LOAD, XI, computed_as
from ..text import first_of, listed

if TYPE_CHECKING:
    from ..model.tally import Tally
    from ..quantities.values import Interval, Uncertain

# The severities, the most important first. Notes of one severity keep the order in which they are made.
Severity = Literal[
    "warning",  # a number has no meaning
    "lead",  # the answer to the question
    "gap",  # the reason for a missing result that was asked for by name, or for an empty cell of a list
    "against",  # a material's note that casts doubt on one of its values
    "caveat",  # a limitation that may change a decision
    "remark",  # a limitation of less importance
    "data",  # any other note of a material
    "assumed",  # the assumptions
    "more",  # shown only by --explain
]
ABOVE: tuple[Severity, ...] = ("assumed", "warning", "lead", "against", "data")  # shown above a table on a terminal
_SEVERITIES = get_args(Severity)


class Note(NamedTuple):
    """A sentence about an answer or about rows, and its severity."""

    severity: Severity
    text: str

    @property
    def line(self) -> str:
        """The sentence as a line of output."""
        return f"{'warning' if self.severity == 'warning' else 'note'}: {self.text}"


_FORMULAS = {  # assumed formulas, by the input that each replaces
    "contacts": "an aggregate has as many contacts as grains, n_c = N",
    "shear_strength": "τ = G/4π²",
    "work_of_adhesion": "w = 2√(γ1γ2)",
}
_DEFAULTS_IN_WORDS = {"load": "no load", "contact_angle": "θ_c = 0, water that wets"}
FRICTION = Note(
    "remark", "sliding and twisting are known only within an order of magnitude: τ = G/4π² (--shear-strength)"
)
_UNLIKE = 3.0  # ratio of two surface energies above which their geometric mean is too high
_MAX_NOTES = 1  # answering sentences shown below results; as many other notes are shown
_MAX_LENGTH = 154  # characters of a note: two lines of a terminal
_MAX_CODES = 4  # codes of doubts in a note
MORE = "more: --explain"  # the last line, if there is more
_MOST_IN_WORDS = 2  # largest number of quantities that a note names in words; it gives the symbols of more quantities


# --- Inputs -----------------------------------------------------------------------------------------------------------


def entering(frame: Frame, names: Sequence[str], *, judges: bool = True) -> tuple[set[str], list[str]]:
    """Return the inputs of some quantities, and the given inputs that change neither a quantity nor a limit.

    An input that a missing quantity needs is not idle. A load or state that changes only limits is idle, because the
    user expected it to change a result.
    `judges`: True to count all limits, False to count only those that make a result meaningless.
    """
    limits = concerning(frame, frame.possible(names), LIMITS if judges else ENDING)
    judged = [*names, *(limit.name for limit in limits)]
    inputs = {*frame.inputs_of(*frame.possible(names))}
    of_limits_only = {*frame.inputs_of(*frame.possible(judged))} - inputs
    needed = inputs | (of_limits_only - STATE_OR_LOAD) | depends_on(tuple(frame.missing(judged)), (frame.law.name,))
    idle = [name for name in frame.described if needed.isdisjoint((name, computed_as(name)))]
    return inputs, idle


def assumed(frame: Frame, inputs: Collection[str], names: Sequence[str], *, has_values: bool) -> dict[str, str]:
    """Return the assumptions for some quantities by name, each with the option that replaces it.

    `has_values`: True if the frame is a single row, so that an assumed formula gives one value.
    """
    steps = frame.formulas_to(*names)
    texts = {name: formula for name, formula in _FORMULAS.items() if name in steps}
    if "hamaker" in inputs:
        texts["work_of_adhesion"] = "w = A/12πD0²"
    elif "surface_energy2" not in inputs:
        texts.pop("work_of_adhesion", None)
    if has_values:
        for name, value in frame.numbers(*texts).items():
            texts[name] += f" = {amount(name, value, Format(digits=4))}"
    for name, value in DEFAULTS.items():
        if name not in inputs or name in frame.given:
            continue
        texts[name] = _DEFAULTS_IN_WORDS.get(name, f"{symbol_of(name)} = {amount(name, value)}")
        if name == "energy_ratio" and len(names) > 1:
            texts[name] = f"n_roll at {texts[name]}"
        if name == "energy_ratio" and has_values:
            texts[name] += _speed_of(frame)
    return {name: f"{text} ({NOMENCLATURE[name].option})" for name, text in texts.items()}


def _speed_of(frame: Frame) -> str:
    """Return the speed of sphere 1 at the frame's energy, as a text; empty if the mass is unknown."""
    known = frame.numbers("energy", "mass")
    if len(known) < 2:
        return ""
    return f", v = {amount('speed', sqrt(2 * known['energy'] / known['mass']), Format(digits=2))}"


def about_assumed(texts: Mapping[str, str]) -> Iterator[Note]:
    """Iterate over at most one note: the assumptions."""
    if texts:
        yield Note("assumed", f"assumed: {', '.join(texts.values())}")


def about_given(frame: Frame, names: Sequence[str], inputs: Collection[str]) -> Iterator[Note]:
    """Iterate over notes on inputs: an assumed shear strength, unlike surface energies, and data of materials."""
    if "shear_strength" in frame.formulas_to(*names):
        yield FRICTION
    energies = [frame[name] for name in ("surface_energy", "surface_energy2") if name in inputs]
    if len(energies) == 2 and max(energies) > _UNLIKE * min(energies):
        bounds = "w = 2√(γ1γ2) is an upper estimate for solids so unlike, 4/(1/γ1 + 1/γ2) a lower one"
        yield Note("caveat", f"{bounds}: --work-of-adhesion")
    yield from about_data(frame, inputs)


def about_data(frame: Frame, inputs: Collection[str]) -> Iterator[Note]:
    """Iterate over the materials' notes on the properties among the inputs; the frame may have many rows."""
    for name, (material, of_solid) in frame.data.items():
        if name not in inputs or of_solid not in material.notes:
            continue
        subject = f"{symbol_among(of_solid, ())} of {material.name}"
        radii = material.note_radii.get(of_solid)
        if radii is not None:
            if not _has_radius_in(radii, frame, NOMENCLATURE[name].sphere):
                continue
            subject += f" (R = {amount('radius', radii)})"
        severity: Severity = "against" if of_solid in material.origins else "data"
        yield Note(severity, f"{subject}: {material.notes[of_solid]}")


def _has_radius_in(radii: "Interval", frame: Frame, sphere: int) -> bool:
    """Return whether a sphere has a radius in a range, in at least one row; for a plane, the other sphere counts."""
    radius = frame.given.get("radius")
    if radius is None:
        return False
    is_in = (radii.low <= radius) & (radius <= radii.high)
    if sphere == 2:
        radius2 = frame.given.get("radius2", radius)
        is_in = (radii.low <= radius2) & (radius2 <= radii.high) | (radius2 == INFINITY) & is_in
    return is_anywhere(is_in)


def about_idle(names: Sequence[str]) -> Iterator[Note]:
    """Iterate over at most one note: the inputs that change no result."""
    options = [NOMENCLATURE[name].option or name for name in names]
    if options:
        verb = "change" if options[1:] else "changes"
        yield Note("caveat", f"{listed(options)} {verb} no result here")


def about_middles(uncertain: "Mapping[str, Uncertain]") -> Iterator[Note]:
    """Iterate over at most one note: the uncertain inputs, of which a picture or an export uses the middle."""
    if uncertain:
        middles = ", ".join(f"{symbol_of(name)} = {amount(name, value)}" for name, value in uncertain.items())
        yield Note("remark", f"computed with the middle of {middles}")


# --- Values -----------------------------------------------------------------------------------------------------------


def about_values(frame: Frame, names: Collection[str]) -> Iterator[Note]:
    """Iterate over notes on the values of quantities.

    Their subjects are a measured breaking energy, chains of unlike spheres, spheres bound without touching, and the
    part of w that rolling at ξ must lose.
    """
    if "break_energy_dust_simulation" in names and solid_of_pair(frame) == SIO2:
        measured = "for spheres of 1.9 µm diameter, Blum & Wurm 2000 (Icarus 143, 138) use a measured 1.3e-15 J"
        yield Note("more", f"E_break of {SIO2}: {measured}")
    if "n_grav" in names and not frame.is_identical:
        text = "N_grav counts the spheres held by the first contact, which is with body 2"
        of_sphere_1 = Frame(frame.stated_of_1, frame.material, model=frame.stated_model)
        for carried in of_sphere_1.numbers("n_grav").values():
            text += f"; the next contact, of two spheres 1, yields in a chain of {carried + 1:.4g} spheres"
        yield Note("caveat", text)
    if frame.law.name == BETWEEN and "contact_radius_at_load" in names and frame["contact_radius_at_load"] == 0:
        yield Note("remark", "a = 0: the spheres are bound without touching")
    if rolling(names):
        values = frame.numbers(XI, "hysteresis_ratio")
        lost = values.get("hysteresis_ratio", 1.0)
        if lost < 1 and XI in values:
            condition = f"{significant(100 * lost, 2)} % of w must be lost where the contact opens and closes"
            yield Note("more", f"to roll at ξ = {amount(XI, values[XI])}, {condition}")


# --- Unjudged limits and missing values -------------------------------------------------------------------------------


def about_unjudged(every: Iterable[Doubt]) -> Iterator[Note]:
    """Iterate over notes on limits that were not judged, one for all limits that lack the same inputs.

    The first code of a limit stands for the limit.
    """
    errors: dict[str, JkrollError] = {}
    for doubt in every:
        if doubt.error is not None:
            code = next(iter(doubt.limit.codes.values()))
            errors[code] = doubt.error
    for codes, reason in grouped(errors):
        yield Note("more", f"not checked: {first_of(codes, _MAX_CODES)}: {reason}")


def about_missing(errors: Mapping[str, JkrollError], named: Collection[str] = ()) -> Iterator[Note]:
    """Iterate over notes with the reasons for missing values, each after its quantities.

    `named`: the quantities that were asked for by name.
    """
    for names, reason in grouped(errors):
        lacks_input = isinstance(errors[names[0]], MissingInput)
        severity: Severity = "remark" if lacks_input else "caveat"
        if not {*named}.isdisjoint(names):
            severity = "gap"
        subjects = first_symbols(names)
        if lacks_input and len(names) <= _MOST_IN_WORDS:  # the table has no row with their symbols
            subjects = listed(NOMENCLATURE[name].sentence for name in names)
        yield Note(severity, f"{subjects}: {reason}")


# --- Rows -------------------------------------------------------------------------------------------------------------


Noted = tuple[Frame, Sequence[str]]  # the frame of rows with the same inputs, and the quantities to judge in notes


def about_rows(tally: "Tally", reported: int, where: str, hint: str = "") -> Iterator[Note]:
    """Iterate over notes on rows: how many have results without a meaning or in doubt, and why cells are empty.

    `reported`: the bits of the doubts to report; `where`: the column with the codes, or the page that explains
    them; `hint`: a text after `where`, for results in doubt only.
    """
    about_meaning = _about_codes(tally, reported & ENDING_MEANING, "numbers have no meaning", where, most=2)
    about_doubts = _about_codes(tally, reported & ~ENDING_MEANING, "doubts", where + hint, most=_MAX_CODES)
    yield from (Note("warning", text) for text in about_meaning)
    yield from (Note("remark", text) for text in about_doubts)
    for number, first, words in tally.gaps.values():
        others = "" if number == 1 else f" and {number - 1} other{'s' if number > 2 else ''}"
        yield Note("gap", f"{words}: row {first}{others}")


def _about_codes(tally: "Tally", bits: int, subject: str, where: str, *, most: int) -> Iterator[str]:
    """Iterate over at most one sentence: some codes, each with its number of rows and any explanation in MEANINGS."""
    texts = []
    for code, rows in tally.counted(bits):
        meaning = f" ({MEANINGS[code]})" if code in MEANINGS else ""
        texts.append(f"{code} {rows}{meaning}")
    if texts:
        yield f"{subject} in {tally.with_doubts(bits)} of {tally.rows} rows ({where}): {first_of(texts, most)}"


def lines_on_codes(codes: Iterable[str]) -> Iterator[str]:
    """Iterate over lines that explain the codes in a table, one for each limit.

    Codes of limits that make results meaningless are left out, because a warning explains them.
    """
    in_table = {*codes}
    for limit in LIMITS:
        of_limit = [code for code in limit.codes.values() if code in in_table]
        if of_limit and not limit.ends_meaning:
            yield f"{', '.join(of_limit)}: {limit.consequence.partition(';')[0]}"


def assumed_in(groups: Iterable[Noted], *, judges: bool = True) -> dict[str, str]:
    """Return the assumptions of all groups by name, each with the option that replaces it; `judges`: see `entering`."""
    texts: dict[str, str] = {}
    for frame, names in groups:
        inputs, _ = entering(frame, names, judges=judges)
        texts |= assumed(frame, inputs, frame.possible(names), has_values=False)
    return texts


def idle_in(groups: Iterable[Noted], *, judges: bool = True) -> list[str]:
    """Return the inputs that change no result in any group; `judges`: see `entering`."""
    first, *others = (entering(frame, names, judges=judges)[1] for frame, names in groups)
    idle_everywhere = {*first}.intersection(*others)
    return [name for name in first if name in idle_everywhere]


def notes_below(groups: Sequence[Noted], tally: "Tally", reported: int, *, is_table: bool) -> list[Note]:
    """Return the notes to print below rows: on the counts of rows, and on the inputs of their groups.

    `reported`: the bits of the doubts to report. `is_table`: True below a table, whose other lines explain the codes of
    doubts; only doubts that make a result meaningless are then reported.
    """
    if is_table:
        reported &= ENDING_MEANING
    is_off = tally.with_doubts(reported & LAW.bits) and not any(frame.stated_model for frame, _ in groups)
    hint = "; best ranges: --best" if is_off else ""
    every = [*about_rows(tally, reported, "jkroll guide doubts", hint)]
    for frame, names in groups:
        possible = frame.possible(names)
        every += about_given(frame, possible, frame.inputs_of(*possible))
        every += about_unjudged(doubts(frame, frame.columns(possible)))
    return [*dict.fromkeys(every), *about_idle(idle_in(groups)), *about_assumed(assumed_in(groups))]


# --- Lines ------------------------------------------------------------------------------------------------------------


def lines_above(notes: Sequence[Note]) -> list[str]:
    """Return the lines above the results on a terminal: the warning, answers to the question, notes of materials."""
    texts = _texts_by_severity(notes)
    of_materials = [_first_clauses(text) for text in (*texts["against"], *texts["data"])]
    return [*_warning(texts["warning"]), *texts["lead"], *of_materials]


def lines_of(
    notes: Sequence[Note], *, has_head: bool = False, has_more: bool = False, quiet: bool = False
) -> list[str]:
    """Return the lines below an answer or rows, ending with a hint if there is more; the warning alone if `quiet`.

    The lines are the assumptions, the warning, the first answering sentence and the first of the other notes.
    `has_head`: True below a table whose header has the assumptions; the lines then also have all notes of severity
    "data". `has_more`: True if there is more to explain than the notes.
    """
    texts = _texts_by_severity(notes)
    warning = _warning(texts["warning"])
    if quiet:
        return warning
    answers, data = texts["lead"], texts["data"]
    others = [*texts["gap"], *texts["against"], *texts["caveat"], *texts["remark"]]
    if has_head:
        assumptions, others_shown = [], [*others[:_MAX_NOTES], *data]
    else:
        assumptions, others_shown = texts["assumed"], [*others, *data][:_MAX_NOTES]
    every = [f"note: {text}" for text in (*answers, *others, *data)]
    shown = [_first_clauses(f"note: {text}") for text in (*answers[:_MAX_NOTES], *others_shown)]
    lines = [*assumptions, *warning, *shown]
    if shown != every or texts["more"] or has_more:
        lines.append(MORE)
    return lines


def _texts_by_severity(notes: Sequence[Note]) -> dict[str, list[str]]:
    texts: dict[str, list[str]] = {severity: [] for severity in _SEVERITIES}
    for note in notes:
        texts[note.severity].append(note.text)
    return texts


def _warning(texts: Sequence[str]) -> list[str]:
    """Return one line with all warnings, if there are any."""
    if not texts:
        return []
    return [f"warning: {'; '.join(texts)}"]


def _first_clauses(text: str) -> str:
    """Return as many leading clauses of a text as fit into two lines, but at least one clause."""
    while len(text) > _MAX_LENGTH and "; " in text:
        text = text.rpartition("; ")[0]
    return text


def by_severity(notes: Iterable[Note]) -> list[Note]:
    """Return the notes, the most important first."""
    return sorted(notes, key=lambda note: _SEVERITIES.index(note.severity))
