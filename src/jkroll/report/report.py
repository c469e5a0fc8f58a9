"""The report of one frame: its answer with warnings and notes, in the order in which a reader needs them."""

from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from math import erfc, hypot, sqrt

from ..errors import JkrollError
from ..model.estimate import (
    ADHESION_ONLY,
    FRICTION_ASSUMED,
    MEASURED,
    NONE,
    SEEN,
    WORDS,
    Estimate,
    Ranges,
)
from ..model.frame import Frame
from ..model.limits import (
    LAW,
    PEELS_FIRST,
    ROUGH_MATTERS,
    STICKING_UNSURE,
    WIDE_CONTACT,
    Doubt,
    Limit,
    concerning,
    may_be_rough,
)
from ..model.measured import rolling
from ..model.uncertainty import Sources, error_bars
from ..quantities.formatting import amount, significant, symbol_among
from ..quantities.laws import DEFAULT_LAW, JKR_OF_SPHERE
from ..quantities.nomenclature import XI
from ..text import first_of
from .answer import Answer
from .best_ranges import held_on_surfaces, order, range_in_words, reasons_for
from .inferred import about_inferred, about_limit
from .leads import leads
from .notes import (
    ABOVE,
    FRICTION,
    Note,
    Severity,
    about_assumed,
    about_given,
    about_idle,
    about_missing,
    about_unjudged,
    about_values,
    by_severity,
)

_MOST = 4  # results in a note
_LOST = 0.01  # least fraction of uncertain values beyond pull-off that a note reports


class Report(Answer):
    """The answer to the question of a command, with its warnings and notes."""

    @cached_property
    def whys(self) -> Mapping[int, list[str]]:
        """The reasons for best ranges, by rule; below a table stands only the first reason of each rule."""
        return {by: [*reasons_for(by, self)] for by in self.rules}

    def why(self, by: int) -> str:
        """Return all reasons for the best ranges by a rule; empty if there are none."""
        return "; ".join(self.whys[by])

    @property
    def has_more_reasons(self) -> bool:
        """True if some rule has more reasons than the first, which stands below a table."""
        return any(len(reasons) > 1 for reasons in self.whys.values())

    def lines_on_ranges(self, names: Iterable[str]) -> Iterator[str]:
        """Iterate over a line for each rule that gives one of these results a range and has a reason."""
        for by in dict.fromkeys(self.estimates[name].by for name in names if name in self.estimates):
            for reason in self.whys[by][:1]:
                yield f"{WORDS[by]}: {reason}"

    def notes_on_ranges(self) -> Iterator[Note]:
        """Iterate over a note for each rule that gives a range to take and has a reason, for output without a table."""
        texts: dict[int, list[str]] = {}
        for name, estimate in self._estimates_to_take.items():
            text = f"{symbol_among(name, self.inputs)}: {range_in_words(name, estimate, self.form)}"
            texts.setdefault(estimate.by, []).append(text)
        for by, of_rule in texts.items():
            for reason in self.whys[by][:1]:
                yield Note("lead", f"best range of {first_of(of_rule, _MOST)} ({WORDS[by]}); {reason}")

    @property
    def best_ranges(self) -> str:
        """The best ranges to take, as a text of one line."""
        texts = []
        for name, estimate in self._estimates_to_take.items():
            text = f"{symbol_among(name, self.inputs)} {range_in_words(name, estimate, self.form)}"
            texts.append(f"{text} ({WORDS[estimate.by]})")
        return ", ".join(texts)

    @property
    def _estimates_to_take(self) -> Mapping[str, Estimate]:
        return {name: self.estimates[name] for name in self.question.taken(self.estimates)}

    @cached_property
    def notes(self) -> tuple[Note, ...]:
        """The sentences about the answer, except doubts; none if inference failed."""
        if self.described.unknowns and self.failure is not None:
            return ()
        inputs, idle = self._entering
        every = (
            *about_inferred(self),
            *leads(self),
            *about_assumed(self.assumed),
            *about_missing({**self._lacking_in_table, **self.open_bars()}, self.question.named),
            *about_given(self.frame, self._possible, inputs),
            *about_idle(idle),
            *about_values(self.frame, self._valued),
            *self._about_pull(),
            *about_unjudged(self.validity),
            *_about_lost_contacts(self),
        )
        notes = dict.fromkeys(every)
        if FRICTION_ASSUMED in self.rules:  # a best range from τ/3 to 3τ says the same
            notes.pop(FRICTION, None)
        return tuple(notes)

    def doubts(self, *, has_leads: bool = False) -> list[Note]:
        """Return a note for each limit in `exceeded`, except the limit of the law.

        Best ranges show how far the law is off, unless the law was stated.
        `has_leads`: True if the sentences that answer the question are shown, too.
        """
        notes = []
        for doubt in self.exceeded:
            if doubt.limit is LAW:
                continue
            severity: Severity = "more"
            text = self._subject_of(doubt.limit) + self.about(doubt)
            if has_leads and self._is_in_leads(doubt):
                severity = "caveat"
            elif doubt.limit.ends_meaning:
                severity, text = "warning", self._by_law_alone(doubt) + text
            elif doubt.limit.is_shown and not self._is_in_ranges(doubt):
                severity = "caveat"
            notes.append(Note(severity, text))
        return notes

    def _by_law_alone(self, doubt: Doubt) -> str:
        """Return the prefix of a warning: the law, and ξ if the limit depends on it, since best ranges have a meaning.

        The prefix is empty without meaningless results, or if one of them has no best range.
        """
        ended = self.ended_by(doubt)
        if not ended or any(self.estimates[name].by == NONE for name in ended):
            return ""
        depends_on_xi = rolling([doubt.limit.name]) and XI not in doubt.limit.touches
        with_xi = f" with ξ = {amount(XI, self.frame[XI])}" if depends_on_xi else ""
        return f"by {self.frame.law.short}{with_xi}, "

    def _is_in_leads(self, doubt: Doubt) -> bool:
        """Return whether a lead already has the consequence of a limit: the energy is too little for rolling."""
        return doubt.limit.name == "energy_over_yield" and self.question.headline == ("n_roll",)

    def _is_in_ranges(self, doubt: Doubt) -> bool:
        """Return whether the best ranges already include the consequence of a limit."""
        if doubt.code == PEELS_FIRST:
            return "sliding_or_peeling_force" in self.estimates
        return doubt.code == STICKING_UNSURE and not {ADHESION_ONLY, MEASURED, SEEN}.isdisjoint(self.rules)

    def _subject_of(self, limit: Limit) -> str:
        """Return the prefix of a limit's sentence: the symbol of a meaningless result, if the limit touches no other.

        The prefix is empty if the limit is on that result, since the sentence then names it.
        """
        if len(limit.touches) != 1:
            return ""
        (name,) = limit.touches
        if name not in self.ended or name == limit.name:
            return ""
        return f"{symbol_among(name, self.inputs)}: "

    def ended_by(self, doubt: Doubt) -> tuple[str, ...]:
        """Return the names of the results that a limit makes meaningless."""
        if not (doubt.is_exceeded and doubt.limit.ends_meaning):
            return ()
        judged = self.described.judged
        return tuple(name for name in self.ended if concerning(self.frame, judged([name]), [doubt.limit]))

    def about(self, doubt: Doubt) -> str:
        """Return the sentence on a limit: its consequence for the results, or for inferred values."""
        if doubt.code == WIDE_CONTACT:
            return _of_a_sphere(self.frame) or doubt.text
        if self.described.unknowns:
            return about_limit(doubt, self)
        return held_on_surfaces(self) if doubt.code == ROUGH_MATTERS else doubt.text

    @property
    def every_sentence(self) -> list[Note]:
        """All sentences about the answer."""
        return [*self.notes, *self.doubts(has_leads=True)]

    @property
    def sentences(self) -> list[Note]:
        """The sentences about the answer, without the doubt that a lead, or rows of the table for surfaces, repeat."""
        repeated = held_on_surfaces(self) if self.shows_surfaces else None
        return [note for note in self.every_sentence if note.severity in ABOVE or note.text != repeated]

    @property
    def sentences_below(self) -> list[Note]:
        """The sentences below a table."""
        return [note for note in self.sentences if note.severity not in ABOVE]

    def _about_pull(self) -> Iterator[Note]:
        """Iterate over at most one note: the pull on the contact may be more than rough spheres hold."""
        if "load" not in self.frame.stated:
            return
        load = Ranges.of(self.frame, "load").estimate("load")
        pull = Estimate(-load.high, -load.low, load.by)
        has_force = not self.frame.missing(["pull_off_force_dmt"])
        if not (pull.high > 0 and has_force and may_be_rough(self.frame)):
            return
        if not any(pull.high > low for low, _ in self.held.values()):
            return
        smooth = Ranges.of(self.frame, *self.frame.possible(["pull_off_force"]))
        verdict = "rough spheres may have parted at this pull"
        for name in smooth.names:
            force = smooth.estimate(name)
            at = "" if name in self.question.headline else f" (they part at {range_in_words(name, force, self.form)})"
            pulls_off = order(pull, force)
            if pulls_off < 0:
                verdict = f"smooth spheres hold this pull{at}"
            elif pulls_off == 0:
                verdict = f"even smooth spheres may have parted at this pull{at}"
        may_hold = any(pull.low <= high for _, high in self.held.values())
        parted = f"real ones {'may have' if may_hold else 'have'} parted, as they hold"
        yield Note("lead", f"{verdict}; {held_on_surfaces(self, parted)}")

    @property
    def _lacking_in_table(self) -> Mapping[str, JkrollError]:
        return {name: error for name, error in self.lacking.items() if name in self.names_in_table}

    @property
    def _valued(self) -> list[str]:
        """The judged quantities that have a value; a meaningless one counts only if all values are kept."""
        columns = self.judged if self.keeps_all else self.judged_meant
        return [name for name, column in columns.items() if not column.is_empty]


# --- Sentences --------------------------------------------------------------------------------------------------------


def _of_a_sphere(frame: Frame) -> str:
    """Return the sentence on the pull-off force of a true sphere and of a paraboloid; empty if they are unknown."""
    of_sphere = frame.under(JKR_OF_SPHERE).numbers("pull_off_force").get("pull_off_force", 0.0)
    of_paraboloid = frame.under(DEFAULT_LAW).numbers("pull_off_force").get("pull_off_force", 0.0)
    if not of_sphere:
        return ""
    less = f"{significant(100 * (1 - of_sphere / of_paraboloid), 2)} %"
    difference = f"for a true sphere P_c is {less} smaller, so w inferred from P_c is {less} too low (--profile sphere)"
    return f"contact too wide for a paraboloid: {difference}"


def _about_lost_contacts(answer: Answer) -> Iterator[Note]:
    """Iterate over at most one note: the load is beyond pull-off at 1 % or more of normally distributed values."""
    if answer.sources is None or "load" not in answer.described.inputs_used([*answer.computed]):
        return
    forces = answer.frame.numbers("load", "pull_off_force")
    if len(forces) < 2 or answer.open_bars():
        return
    bars = error_bars(answer.frame, forces, sources=Sources(answer.sources.standard)).values()
    spread = hypot(*(bar.sides["minus"] for bar in bars if "minus" in bar.sides))
    if not spread:
        return
    margin = forces["load"] + forces["pull_off_force"]
    lost = erfc(margin / (sqrt(2) * spread)) / 2
    if lost >= _LOST:
        text = f"at {100 * lost:.2g} % of the uncertain values the load is beyond pull-off"
        yield Note("caveat", f"error bars are only for contacts that hold: {text}")


def every_line(report: Report) -> list[str]:
    """Return the sentences of a report as lines, the most important first."""
    return [note.line for note in by_severity(report.sentences)]
