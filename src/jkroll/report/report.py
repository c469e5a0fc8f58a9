"""The report of one frame: its answer with warnings and notes, in the order in which a reader needs them."""

from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from math import erfc, hypot, sqrt

from ..model.estimate import ADHESION_ONLY, FRICTION_ASSUMED, MEASURED, NONE, WORDS
from ..model.frame import Frame
from ..model.limits import LAW, ROUGH_MATTERS, STICKING_UNSURE, WIDE_CONTACT, Doubt, may_be_rough, touched
from ..model.measured import on_surfaces
from ..model.uncertainty import error_bars
from ..quantities.formatting import significant, symbol_among
from ..quantities.laws import DEFAULT_LAW, JKR_OF_SPHERE
from ..text import first_of
from .answer import Answer
from .inferred import about_limit, proofs
from .leads import leads
from .notes import (
    ABOVE,
    FRICTION,
    Note,
    Severity,
    about_assumed,
    about_given,
    about_idle,
    about_left_out,
    about_limits,
    about_missing,
    about_values,
    by_severity,
)
from .ranges import held_on_surfaces, range_in_words, why

_MOST = 4  # results in a note
_LOST = 0.01  # a note reports lost contacts above this fraction of the uncertain values


class Report(Answer):
    """The answer to the question of a command, with its warnings and notes."""

    @cached_property
    def whys(self) -> Mapping[int, str]:
        """The reasons for best ranges, by rule."""
        return {by: why(by, self) for by in dict.fromkeys(estimate.by for estimate in self.estimates.values())}

    def lines_on_ranges(self, names: Iterable[str]) -> Iterator[str]:
        """Iterate over a line for each rule that gives a range, in the order of the results."""
        for by in dict.fromkeys(self.estimates[name].by for name in names if name in self.estimates):
            if text := self.whys[by]:
                yield f"{WORDS[by]}: {text}"

    def notes_on_ranges(self) -> Iterator[Note]:
        """Iterate over a note for each rule that gives the headline a range, for reports without a table."""
        texts: dict[int, list[str]] = {}
        for name, estimate in self.estimates.items():
            if name in self.question.headline:
                text = f"{symbol_among(name, self.inputs)}: {range_in_words(name, estimate)}"
                texts.setdefault(estimate.by, []).append(text)
        for by, of_rule in texts.items():
            if text := self.whys[by]:
                yield Note("lead", f"best range of {first_of(of_rule, _MOST)} ({WORDS[by]}); {text}")

    @property
    def best_ranges(self) -> str:
        """The best ranges of results of the headline in one line."""
        texts = (
            f"{symbol_among(name, self.inputs)} {range_in_words(name, estimate)} ({WORDS[estimate.by]})"
            for name, estimate in self.estimates.items()
            if name in self.question.headline
        )
        return ", ".join(texts)

    @cached_property
    def notes(self) -> tuple[Note, ...]:
        """The sentences about the answer, except doubts."""
        if self.described.unknowns and self.failure is not None:
            return ()
        inputs, idle = self._entering
        every = (
            *leads(self),
            *proofs(self),
            *about_assumed(self.assumed),
            *about_missing({**self.lacking, **self.open_bars()}),
            *about_left_out(self.sources),
            *about_given(self.frame, self._possible, inputs),
            *about_idle(idle),
            *about_values(self.frame, self._valued),
            *self._about_pull(),
            *about_limits(self.validity),
            *_about_lost_contacts(self),
        )
        is_in_range = any(estimate.by == FRICTION_ASSUMED for estimate in self.estimates.values())
        return tuple(note for note in dict.fromkeys(every) if not (is_in_range and note is FRICTION))

    def doubts(self) -> list[Note]:
        """Return a note for each exceeded limit of the model, in the order of `exceeded`."""
        notes = []
        for doubt in self.exceeded:
            if doubt.limit is LAW:
                continue  # the best ranges show it
            severity: Severity = "caveat" if doubt.limit.is_shown and not self._is_in_ranges(doubt) else "more"
            text = self._whose(doubt) + self.about(doubt)
            if doubt.limit.ends_meaning:
                severity, text = "warning", text + self._by_law_alone
            notes.append(Note(severity, text))
        return notes

    @cached_property
    def _by_law_alone(self) -> str:
        """The suffix of a warning if results without meaning still have best ranges: only the law fails."""
        has_ranges = all(self.estimates[name].by != NONE for name in self.ended)
        return f", by plain {self.frame.law.short}" if has_ranges else ""

    def _is_in_ranges(self, doubt: Doubt) -> bool:
        """Return whether the best ranges already include what a limit means."""
        rules = {estimate.by for estimate in self.estimates.values()}
        return doubt.code == STICKING_UNSURE and not rules.isdisjoint((ADHESION_ONLY, MEASURED))

    def _whose(self, doubt: Doubt) -> str:
        """Return the symbol of the only result whose meaning a limit ends, unless the sentence names it."""
        names = [name for name in doubt.limit.touches if name in self.ended]
        alone = len(doubt.limit.touches) == 1 and names and doubt.limit.name not in names
        return f"{symbol_among(names[0], self.inputs)}: " if alone else ""

    def ended_by(self, doubt: Doubt) -> tuple[str, ...]:
        """Return the names of the results whose meaning a limit ends."""
        judged = self.described.judged
        limits = [doubt.limit] if doubt.is_exceeded and doubt.limit.ends_meaning else []
        return tuple(name for name in self.ended if touched(self.frame, judged([name]), limits))

    def about(self, doubt: Doubt) -> str:
        """Return what a limit means for the results, or for the unknowns."""
        if doubt.code == WIDE_CONTACT:
            return _of_a_sphere(self.frame) or doubt.text
        if self.described.unknowns:
            return about_limit(doubt, self)
        return held_on_surfaces(self.frame) if doubt.code == ROUGH_MATTERS else doubt.text

    @property
    def sentences(self) -> list[Note]:
        """All sentences about the answer."""
        return [*self.notes, *self.doubts()]

    @property
    def sentences_below(self) -> list[Note]:
        """The sentences below a table."""
        above = {held_on_surfaces(self.frame)} if self.shows_surfaces or self.is_on_pull_off else set()
        return [note for note in self.sentences if note.severity not in ABOVE and note.text not in above]

    def _about_pull(self) -> Iterator[Note]:
        """Iterate over a note if the contact is pulled harder than rough spheres hold."""
        pull = -self.frame.values["load"] if "load" in self.frame.stated else 0.0
        has_force = bool(self.frame.under(DEFAULT_LAW).numbers("pull_off_force"))
        is_rough = pull > 0 and has_force and bool(may_be_rough(self.frame))
        if is_rough and any(pull > low for low, _ in on_surfaces(self.frame).values()):
            yield Note("lead", f"at this pull they may have parted: {held_on_surfaces(self.frame)}")

    @property
    def _valued(self) -> list[str]:
        """The judged quantities that have a value."""
        columns = self.judged if self.keeps_all else self.judged_meant
        return [name for name, column in columns.items() if not column.is_empty]


# --- Sentences --------------------------------------------------------------------------------------------------------


def _of_a_sphere(frame: Frame) -> str:
    """Return the difference between a true sphere and a paraboloid, where it is known."""
    forces = (each.numbers("pull_off_force") for each in (frame.under(JKR_OF_SPHERE), frame.under(DEFAULT_LAW)))
    of_sphere, of_paraboloid = (values.get("pull_off_force", 0.0) for values in forces)
    if not of_sphere:
        return ""
    less = f"{significant(100 * (1 - of_sphere / of_paraboloid), 2)} %"
    far = f"of a sphere P_c is {less} smaller, w from it {less} too low (--profile sphere)"
    return f"contact too wide for a paraboloid: {far}"


def _about_lost_contacts(answer: Answer) -> Iterator[Note]:
    """Iterate over a note if part of the uncertain values, taken as normally distributed, is beyond pull-off."""
    has_spread = answer.sources is not None and "load" in answer.described.inputs_used([*answer.computed])
    forces = answer.frame.numbers("load", "pull_off_force") if has_spread else {}
    if len(forces) < 2 or answer.open_bars():
        return
    bars = error_bars(answer.frame, forces, sources=answer.sources).values()
    spread = hypot(*(bar.sides["minus"] for bar in bars if "minus" in bar.sides))
    part = erfc(sum(forces.values()) / (sqrt(2) * spread)) / 2 if spread else 0.0
    if part >= _LOST:
        text = f"at {100 * part:.2g} % of the uncertain values the load is beyond pull-off"
        yield Note("caveat", f"error bars are of contacts that hold: {text}")


def every_line(report: Report) -> list[str]:
    """Return all notes of a report as lines, the most important first, for a file without the answer."""
    return [note.line for note in by_severity(report.sentences)]
