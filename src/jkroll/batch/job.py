"""A run of `batch`: its options, and the table that they make of a header."""

import os
import sys
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from ..answers.questions import EVERYTHING, quantities_named
from ..materials.library import Materials
from ..rows.header import Reading, is_input, stated_meanings, understood
from ..rows.table import Fill, Table, idle_of, table_of
from ..scene.failures import MissingInput
from ..text import say_wrapped

MAX_PROCESSES = 16  # unless --jobs asks for more: one process reads for all of them


class Settings(NamedTuple):
    """The options, without those that describe a scene."""

    target: str = "-"
    format: str = ""
    delimiter: str = ""
    quantities: str = ""
    strict: bool = False
    resume: bool = False  # of many files: whether those that are done stay
    jobs: int = 0
    excel_safe: bool = False
    dask: str = ""
    quiet: bool = False
    columns: tuple[str, ...] = ()  # what headers mean, as `--column` has it
    doubt: bool = True  # whether there is a column of doubts
    alternatives: bool = False  # whether there are columns of the results under the other law
    infer: str = ""  # the input that is sought
    measured: str = ""  # the quantity from which it follows, whose measured values a column has
    uncertainty: bool = False  # whether there are columns of uncertainties, though the first rows have none

    @property
    def processes(self) -> int:
        """Number of processes: `--jobs`, else one for each core that this process may use."""
        return self.jobs or min(_cores(), MAX_PROCESSES)


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class Job(NamedTuple):
    """The options, the inputs that fill the gaps of rows, and the known materials."""

    settings: Settings
    inputs: Mapping[str, str]
    known: Materials

    def meanings(self, names: Sequence[str]) -> Mapping[str, Reading]:
        """Return the meanings that options give to headers."""
        return stated_meanings(self.settings.columns, names, self.settings.measured)

    def reads(self, name: str) -> bool:
        """Return whether a header may be that of an input, or has a meaning by an option."""
        return is_input(name, self.meanings([name]))

    def table(self, names: tuple[str, ...], rows: list[list[str]], preamble: int = 0) -> Table:
        """Return the table with this header; `rows`: the cells of its first rows.

        `preamble`: the number of lines before the header that are passed over.
        """
        settings = self.settings
        fill = Fill.of(self.inputs, self.known, settings.infer, settings.measured)
        columns = understood(names, rows, self.meanings(names), self.inputs)._replace(preamble=preamble)
        asked = quantities_named(settings.quantities) if settings.quantities else ([], EVERYTHING)
        try:
            table = table_of(
                columns,
                rows,
                fill,
                asked,
                doubt=settings.doubt,
                uncertainty=settings.uncertainty,
                alternatives=settings.alternatives,
            )
        except MissingInput:
            if not settings.quiet:
                say_wrapped(columns.reading(), sys.stderr)  # a column may not be understood
            raise
        notes = [f"note: {message}" for message in table.labels.values() if message]  # labels may be meant as materials
        if "radius" not in {*columns.names, *fill.fixed} and not settings.quantities:
            notes.append("note: no column and no option gives a radius; what needs one is left out")
        reading, *others = said_of(table)
        for line in () if settings.quiet else (reading, *notes, *others):
            say_wrapped(line, sys.stderr)
        return table


def said_of(table: Table) -> tuple[str, ...]:
    """Return the lines about a table as a whole.

    They say how it is read, which inputs are assumed, which options change nothing, and what enters no error bar.
    """
    idle = idle_of(table)
    if not (table.assumed or idle or table.left_out):
        return (table.reading,)
    from ..answers.notes import assumed_value, idle_in_words, left_out_in_words

    notes = ["assumed " + ", ".join(map(assumed_value, table.assumed))] if table.assumed else []
    notes += [idle_in_words(idle)] if idle else []
    notes += left_out_in_words((source, "") for source in table.left_out)
    return table.reading, *(f"note: {text}" for text in notes)
