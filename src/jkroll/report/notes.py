"""Notes on an answer or on rows: assumptions, doubts, missing inputs; and the lines that show them."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from math import sqrt
from typing import TYPE_CHECKING, Literal, NamedTuple, get_args

from ..errors import JkrollError
from ..model.frame import DEFAULTS, Frame
from ..model.limits import ENDING, ENDING_MEANING, LIMITS, MEANINGS, Doubt, doubts, touched
from ..model.measured import SIO2, rolling, solid_of_pair
from ..model.plan import depends_on
from ..model.reasons import grouped
from ..model.uncertainty import Sources, sources_of_results
from ..quantities.formatting import Format, amount, first_symbols, significant, symbol_among, symbol_of
from ..quantities.laws import BETWEEN
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, STATE_OR_LOAD, XI, computed_as
from ..text import first_of, listed

if TYPE_CHECKING:
    from ..model.rows import Tally
    from ..quantities.values import Interval, Uncertain

# A "warning" is about a number without a meaning; a "lead" answers the question; "against" and "data" come from the
# source of a material, and the first speaks against its value; a "caveat" may change what a reader does; a "remark"
# matters less; "assumed" is written above results; "more" is shown by --explain alone. Notes of one severity keep the
# order in which they are made.
Severity = Literal["warning", "lead", "against", "caveat", "remark", "data", "assumed", "more"]
ABOVE: tuple[Severity, ...] = ("assumed", "warning", "lead", "against", "data")  # the results on a terminal
_SEVERITIES = get_args(Severity)


class Note(NamedTuple):
    """A sentence about an answer."""

    severity: Severity
    text: str

    @property
    def line(self) -> str:
        """The sentence as a line of output."""
        return f"{'warning' if self.severity == 'warning' else 'note'}: {self.text}"


_RULES = {  # formulas for quantities that could have been given
    "contacts": "as many contacts as grains in each, n_c = N",
    "shear_strength": "τ = G/4π²",
    "work_of_adhesion": "w = 2√(γ1γ2)",
}
_DEFAULTS = {"load": "no load", "contact_angle": "θ_c = 0, water that wets"}
FRICTION = Note("remark", "sliding and twisting are known to an order of magnitude: τ = G/4π² (--shear-strength)")
_UNLIKE = 3.0  # ratio of two surface energies above which their geometric mean is too high
_MAX_NOTES = 1  # below results, in addition to the warning
_MAX_LENGTH = 154  # largest length of a note: two lines of a terminal
_MAX_CODES = 4  # of doubts that are listed by name


# --- Inputs -----------------------------------------------------------------------------------------------------------


def entering(frame: Frame, names: Sequence[str], *, judges: bool = True) -> tuple[set[str], list[str]]:
    """Return the inputs that enter some quantities, and the given inputs that change neither these nor a limit.

    A load that enters only limits counts as idle: the user expected more of it. `judges`: True to judge all limits,
    False for those that end meaning only.
    """
    limits = touched(frame, frame.possible(names), LIMITS if judges else ENDING)
    every = [*names, *(limit.name for limit in limits)]
    own, used = ({*frame.inputs_of(*frame.possible(each))} for each in (names, every))
    needed = used - (STATE_OR_LOAD - own) | depends_on((*frame.missing(every),), (frame.law.name,))
    idle = [name for name in frame.described if needed.isdisjoint((name, computed_as(name)))]
    return own, idle


def assumed(frame: Frame, inputs: Collection[str], names: Sequence[str], *, has_values: bool) -> dict[str, str]:
    """Return the assumptions for some quantities by name, each with the option that sets it.

    `has_values`: True if the frame is a single row, so that an assumed rule gives one value.
    """
    steps = frame.formulas_to(*names)
    texts = {name: rule for name, rule in _RULES.items() if name in steps}
    if "hamaker" in inputs:
        texts["work_of_adhesion"] = "w = A/12πD0²"
    elif "surface_energy2" not in inputs:
        texts.pop("work_of_adhesion", None)
    for name, value in frame.numbers(*texts).items() if has_values else ():
        texts[name] += f" = {amount(name, value, Format(digits=4))}"
    for name, value in DEFAULTS.items():
        if name in inputs and name not in frame.given:
            speed = _speed_of(frame) if name == "energy_ratio" and has_values else ""
            of_turns = "n_roll at " if name == "energy_ratio" and len(names) > 1 else ""
            texts[name] = _DEFAULTS.get(name, f"{of_turns}{symbol_of(name)} = {amount(name, value)}{speed}")
    return {name: f"{text} ({NOMENCLATURE[name].option})" for name, text in texts.items()}


def _speed_of(frame: Frame) -> str:
    """Return the speed of sphere 1 at the energy of the frame, as a text; empty if its mass is unknown."""
    known = frame.numbers("energy", "mass")
    if len(known) < 2:
        return ""
    return f", v = {amount('speed', sqrt(2 * known['energy'] / known['mass']), Format(digits=2))}"


def about_assumed(texts: Mapping[str, str]) -> list[Note]:
    """Return the note on assumptions, if there are any."""
    return [Note("assumed", f"assumed: {', '.join(texts.values())}")] if texts else []


def about_given(frame: Frame, names: Sequence[str], inputs: Collection[str]) -> Iterator[Note]:
    """Iterate over notes on the given values; `inputs`: the inputs of the quantities."""
    if "shear_strength" in frame.formulas_to(*names):
        yield FRICTION
    energies = [frame[name] for name in ("surface_energy", "surface_energy2") if name in inputs]
    if len(energies) == 2 and max(energies) > _UNLIKE * min(energies):
        bounds = "w = 2√(γ1γ2) is an upper estimate for solids so unlike, 4/(1/γ1 + 1/γ2) a lower one"
        yield Note("caveat", f"{bounds}: --work-of-adhesion")
    yield from about_data(frame, inputs)


def about_data(frame: Frame, inputs: Collection[str]) -> Iterator[Note]:
    """Iterate over the materials' notes on properties that are used; the frame may have arrays."""
    for name, (material, of_solid) in frame.data.items():
        radii = material.note_radii.get(of_solid)
        is_used = name in inputs and of_solid in material.notes
        if is_used and (radii is None or _has_radius_in(radii, frame, NOMENCLATURE[name].sphere)):
            severity: Severity = "against" if of_solid in material.origins else "data"
            sizes = f" (R = {amount('radius', radii)})" if radii is not None else ""
            yield Note(severity, f"{symbol_among(of_solid, ())} of {material.name}{sizes}: {material.notes[of_solid]}")


def _has_radius_in(radii: "Interval", frame: Frame, sphere: int) -> bool:
    """Return whether a sphere has a radius in a range, in at least one row; for a plane, the other sphere counts."""
    radius = frame.given.get("radius")
    if radius is None:
        return False
    radius2 = frame.given.get("radius2", radius)
    is_in, is_in2 = ((radii.low <= each) & (each <= radii.high) for each in (radius, radius2))
    found = is_in2 | (radius2 == INFINITY) & is_in if sphere == 2 else is_in
    return found if isinstance(found, bool) else found.any()


def about_idle(names: Sequence[str]) -> list[Note]:
    """Return the note on inputs that change nothing, if there are any."""
    options = [NOMENCLATURE[name].option or name for name in names]
    return [Note("caveat", f"{listed(options)} change{'' if options[1:] else 's'} no result here")] if names else []


def about_middles(uncertain: "Mapping[str, Uncertain]") -> list[Note]:
    """Return the note on uncertain inputs of a picture or an export, which use the middle of each."""
    middles = ", ".join(f"{symbol_of(name)} = {amount(name, value)}" for name, value in uncertain.items())
    return [Note("remark", f"computed with the middle of {middles}")] if middles else []


# --- Values -----------------------------------------------------------------------------------------------------------


def about_values(frame: Frame, names: Collection[str]) -> Iterator[Note]:
    """Iterate over notes on values: measured energies, unequal spheres in a chain, the assumed ξ."""
    is_silica = solid_of_pair(frame) == SIO2
    if is_silica and "break_energy_dust_simulation" in names:
        measured = "for spheres of 1.9 µm diameter, Blum & Wurm 2000 (Icarus 143, 138) use a measured 1.3e-15 J"
        yield Note("more", f"E_break of {SIO2}: {measured}")
    if "n_grav" in names and not frame.is_identical:
        chain = Frame(frame.stated_of_1, frame.material, model=frame.stated_model).numbers("n_grav").values()
        other = "".join(f"; the next, between spheres 1, yields at {carried + 1:.4g}" for carried in chain)
        yield Note("caveat", f"N_grav is what the first contact, on body 2, carries{other}")
    if frame.law.name == BETWEEN and "contact_radius_at_load" in names and frame["contact_radius_at_load"] == 0:
        yield Note("remark", "a = 0: the spheres are bound without touching")
    if rolling(names):
        values = frame.numbers(XI, "hysteresis_ratio", "displacement_ratio")
        if (ratio := values.get("hysteresis_ratio", 1.0)) < 1 and XI in values:
            lost = f"{significant(100 * ratio, 2)} % of w must be lost where the contact opens and closes"
            yield Note("more", f"to roll at ξ = {amount(XI, values[XI])}, {lost}")


# --- Missing inputs ---------------------------------------------------------------------------------------------------


def about_limits(every: Iterable[Doubt]) -> list[Note]:
    """Return notes on limits that could not be judged, grouped by the missing inputs; each limit shows one code."""
    errors = {next(iter(doubt.limit.codes.values())): doubt.error for doubt in every if doubt.error is not None}
    texts = (f"not checked: {first_of(codes, _MAX_CODES)}: {reason}" for codes, reason in grouped(errors))
    return [Note("more", text) for text in texts]


def about_missing(errors: Mapping[str, JkrollError]) -> list[Note]:
    """Return a note for each reason why values are missing, with the symbols of the quantities."""
    return [Note("caveat", f"{first_symbols(names)}: {reason}") for names, reason in grouped(errors)]


def about_left_out(*every: Sources | None) -> list[Note]:
    """Return the note on inputs that uncertainties leave out, since ± and ranges cannot be combined."""
    left_out = (source for sources in every if sources is not None for source in sources.left_out)
    symbols = dict.fromkeys(symbol_of(source.names[0]) for source in left_out)
    text = f"error bars leave out {', '.join(symbols)}: ± and ranges do not go together"
    return [Note("caveat", text)] if symbols else []


# --- Rows -------------------------------------------------------------------------------------------------------------


Group = tuple[Frame, Sequence[str]]  # rows with the same inputs: their frame, and the quantities shown


def about_rows(tally: "Tally", reported: int, where: str) -> Iterator[Note]:
    """Iterate over notes on rows: how many have no meaning or are in doubt, and why cells are empty.

    `reported`: the bits of the doubts to report; `where`: the page of the guide to refer to.
    """
    severities: tuple[tuple[Severity, str, int, int], ...] = (
        ("warning", "numbers have no meaning", reported & ENDING_MEANING, 2),  # few codes, since each is explained
        ("remark", "doubts", reported & ~ENDING_MEANING, _MAX_CODES),
    )
    for severity, lead, bits, most in severities:
        counts = tally.counted(bits)
        texts = [f"{code} {rows}" + (f" ({MEANINGS[code]})" if code in MEANINGS else "") for code, rows in counts]
        if texts:
            rows = f"{tally.with_doubts(bits)} of {tally.rows} rows"
            yield Note(severity, f"{lead} in {rows} ({where}): {first_of(texts, most)}")
    for number, first, words in tally.gaps.values():
        others = f", likewise {number - 1} more" if number > 1 else ""
        yield Note("caveat", f"{words}: row {first}{others}")


def lines_on_codes(codes: Iterable[str]) -> Iterator[str]:
    """Iterate over a line for each limit with codes in a table: its codes and what they mean."""
    shown = {*codes}
    for limit in LIMITS:
        of_limit = [code for code in limit.codes.values() if code in shown]
        if of_limit and not limit.ends_meaning:  # a warning explains the others
            yield f"{', '.join(of_limit)}: {limit.consequence.partition(';')[0]}"


def assumed_in(groups: Iterable[Group], *, judges: bool = True) -> dict[str, str]:
    """Return the assumptions of all groups by name, each with the option that sets it; `judges`: see `entering`."""
    texts: dict[str, str] = {}
    for frame, names in groups:
        inputs, _ = entering(frame, names, judges=judges)
        texts |= assumed(frame, inputs, frame.possible(names), has_values=False)
    return texts


def idle_in(groups: Iterable[Group], *, judges: bool = True) -> list[str]:
    """Return the inputs that change no result in any group; `judges`: see `entering`."""
    first, *others = (entering(frame, names, judges=judges)[1] for frame, names in groups)
    return [name for name in first if all(name in idle for idle in others)]


def notes_on_rows(groups: Sequence[Group], tally: "Tally", reported: int) -> list[Note]:
    """Return the notes on counted rows and on the inputs of their groups.

    `reported`: the bits of the doubts to report.
    """
    every = [*about_rows(tally, reported, "jkroll guide doubts")]
    for frame, names in groups:
        possible = frame.possible(names)
        with suppress(JkrollError):  # each row gives the reason itself
            every += about_left_out(sources_of_results(frame, possible) if frame.uncertainties else None)
        every += about_given(frame, possible, frame.inputs_of(*possible))
        every += about_limits(doubts(frame, frame.columns(possible)))
    return [*dict.fromkeys(every), *about_idle(idle_in(groups)), *about_assumed(assumed_in(groups))]


def notes_below(groups: Sequence[Group], tally: "Tally", reported: int, *, is_table: bool) -> list[Note]:
    """Return the notes below counted rows; the lines of a table explain its codes already.

    `reported`: the bits of the doubts to report.
    """
    return notes_on_rows(groups, tally, reported & ENDING_MEANING if is_table else reported)


# --- Lines ------------------------------------------------------------------------------------------------------------


def lines_above(notes: Sequence[Note]) -> list[str]:
    """Return the lines above the results on a terminal: warnings, answers to the question, notes of materials."""
    texts = _texts_by_severity(notes)
    return [*_warning(texts["warning"]), *texts["lead"], *map(_first_clauses, (*texts["against"], *texts["data"]))]


def lines_of(notes: Sequence[Note], *, has_head: bool = False, quiet: bool = False) -> list[str]:
    """Return the lines below an answer or rows, ending with a hint if there is more; warnings alone if `quiet`.

    They are the assumptions (unless a header has them), the warnings, the first answering sentence and the first of
    the other notes. Below a table with a header, the notes of materials follow. If `quiet`, they are the warnings.
    """
    texts = _texts_by_severity(notes)
    lines = _warning(texts["warning"])
    if quiet:
        return lines
    leads, data, others = texts["lead"], texts["data"], [*texts["against"], *texts["caveat"], *texts["remark"]]
    first = [*others[:_MAX_NOTES], *data] if has_head else [*others, *data][:_MAX_NOTES]
    shown = [_first_clauses(f"note: {text}") for text in (*leads[:_MAX_NOTES], *first)]
    has_more = shown != [f"note: {text}" for text in (*leads, *others, *data)] or texts["more"]
    return [*([] if has_head else texts["assumed"]), *lines, *shown, *(["more: --explain"] if has_more else [])]


def _texts_by_severity(notes: Sequence[Note]) -> dict[str, list[str]]:
    return {severity: [note.text for note in notes if note.severity == severity] for severity in _SEVERITIES}


def _warning(texts: Sequence[str]) -> list[str]:
    return [f"warning: {'; '.join(texts)}"] if texts else []


def _first_clauses(text: str) -> str:
    """Return as many clauses of a text as fit into two lines, but at least one."""
    while len(text) > _MAX_LENGTH and "; " in text:
        text = text.rpartition("; ")[0]
    return text


def by_severity(notes: Iterable[Note]) -> list[Note]:
    """Return the notes, the most important first."""
    return sorted(notes, key=lambda note: _SEVERITIES.index(note.severity))
