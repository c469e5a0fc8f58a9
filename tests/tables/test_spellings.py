"""Each spelling of an input in a header is read correctly or refused; only some bare symbols may pass through."""

from collections import Counter
from collections.abc import Iterable
from random import Random

import pytest

from jkroll.errors import BadTable
from jkroll.tables.header import understood
from relative import approx
from spellings import MANGLINGS, Spelling, spellings


def outcome(spelling: Spelling) -> str:
    """Return what happens to a spelling: it is read correctly, misread, refused or passed through."""
    given = ("radius2",) if spelling.name != "reduced_radius" else ()  # R is then the radius of sphere 1
    try:
        header = understood([spelling.text], [["3"]], given=given)
    except BadTable:
        return "refused"
    if not header.inputs:
        return "passed" if spelling.may_pass else "passed, though it may be an input"
    (column,) = header.inputs
    is_right = column.name == spelling.name and column.value("3") == approx(3 * spelling.factor, rel=1e-14)
    return "read" if is_right else f"read as {column.name} = {column.value('3')}"


def are_read_rightly_or_refused(some: Iterable[Spelling]) -> None:
    """Check that no spelling is misread or wrongly passed, and that more than 30 % are read with each mangling."""
    outcomes = {spelling: outcome(spelling) for spelling in some}
    wrong = {each.text: found for each, found in outcomes.items() if found not in ("read", "refused", "passed")}
    assert not wrong
    counts = Counter((spelling.how, found) for spelling, found in outcomes.items())
    for how in MANGLINGS:
        assert counts[how, "read"] > 0.3 * sum(counts[how, found] for found in ("read", "refused", "passed")), how


def test_a_sample_of_spellings_is_read_rightly_or_refused() -> None:
    are_read_rightly_or_refused(Random(1).sample([*spellings()], 1500))


@pytest.mark.slow
def test_every_spelling_is_read_rightly_or_refused() -> None:
    every = [*spellings()]
    assert len(every) > 30_000
    assert len(MANGLINGS) >= 12
    are_read_rightly_or_refused(every)
