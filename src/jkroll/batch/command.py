"""The `batch` command: from the options to the exit code."""

import sys
from collections.abc import Mapping

from ..errors import ROWS_FAILED, BadRequest
from ..materials.library import Materials
from ..quantities.formatting import amount
from ..rows.columns import DOUBT, STATUS
from ..rows.reasons import Tally
from ..scene.limits import UNCHECKED
from ..text import first_of, say, say_wrapped
from .job import Job, Settings
from .many import convert_many, is_many
from .run import convert_one

MAX_CODES = 4  # of doubts that are named at the end
MAX_GAPS = 4  # kinds of rows with empty cells that are explained at the end


def run(path: str, settings: Settings, inputs: Mapping[str, str], known: Materials) -> int:
    """Convert a table, or several; return the exit code."""
    job = Job(settings, inputs, known)
    if is_many(path, settings):
        tally, code = convert_many(path, job)
    else:
        if settings.resume or settings.dask:
            flag = "--resume" if settings.resume else "--dask"
            raise BadRequest(f"{flag} is for many files: name them as in 'grains/*.csv', with -o DIRECTORY/")
        tally, code = convert_one(path, job), 0
    if not settings.quiet:
        _say_notes(tally, settings)
    if tally.failed:
        say(f"jkroll: {tally.failed} of {tally.rows} rows failed; column {STATUS} says why", sys.stderr)
    return code or (ROWS_FAILED if tally.failed else 0)


def _say_notes(tally: Tally, settings: Settings) -> None:
    """Say on stderr what was inferred, and how many rows are in doubt, could not be judged, or have empty cells."""
    if tally.inferred:
        say_wrapped(_summary(settings.infer, tally), sys.stderr)
    if tally.doubtful:
        is_one, counts = tally.rows == 1, sorted(tally.codes.items(), key=lambda item: -item[1])
        counted = first_of([code if is_one else f"{code} in {count}" for code, count in counts], MAX_CODES)
        are = "is" if tally.doubtful == 1 else "are"
        some = "the row" if is_one else f"{tally.doubtful} of {tally.rows} rows"
        say_wrapped(f"note: {some} {are} doubtful ({counted}); column {DOUBT} says why", sys.stderr)
    if tally.not_judged:
        some = f"{tally.not_judged} of {tally.rows} rows"
        say_wrapped(
            f"note: {UNCHECKED} in {some}: a limit could not be judged, as it needs an input that is not given",
            sys.stderr,
        )
    for gaps in [*tally.gaps.values()][:MAX_GAPS]:
        say_wrapped(f"note: {gaps.sentence()}", sys.stderr)
    if (more := len(tally.gaps) - MAX_GAPS) > 0:
        say(f"note: column {STATUS} has {more} more kinds of gaps", sys.stderr)


def _summary(name: str, tally: Tally) -> str:
    """Return the sentence on the values of an input that was sought: count, median, quartiles, mean and scatter."""
    import numpy

    values = numpy.concatenate(tally.inferred)
    found = values[~numpy.isnan(values)]
    sentence = f"note: {name}: {len(found)} of {len(values)} rows"
    if len(found) < 2:
        return sentence
    low, median, high = numpy.quantile(found, [0.25, 0.5, 0.75]).tolist()
    middle = f"median {amount(name, median)}, quartiles {amount(name, low)} and {amount(name, high)}"
    mean, scatter = float(found.mean()), float(found.std(ddof=1))
    return f"{sentence}; {middle}; mean {amount(name, mean)}, scatter {amount(name, scatter)}"
