"""Every spelling of every input in a header is read rightly or refused; only a symbol without a mark may pass."""

from collections import Counter

import pytest

from jkroll.errors import BadTable
from jkroll.tables.header import understood
from relative import approx
from spellings import MANGLINGS, Spelling, spellings

SPELLINGS = [*spellings()]


def outcome(spelling: Spelling) -> str:
    given = ("radius2",) if spelling.name != "reduced_radius" else ()  # which says what R is
    try:
        header = understood([spelling.text], [["3"]], given=given)
    except BadTable:
        return "refused"
    if not header.inputs:
        return "passed" if spelling.may_pass else "passed, though it may be an input"
    (column,) = header.inputs
    is_right = column.name == spelling.name and column.value("3") == approx(3 * spelling.factor, rel=1e-14)
    return "read" if is_right else f"read as {column.name} = {column.value('3')}"


@pytest.mark.parametrize("how", MANGLINGS)
def test_a_spelling_is_read_rightly_or_refused(how: str) -> None:
    outcomes = {spelling.text: outcome(spelling) for spelling in SPELLINGS if spelling.how == how}
    assert not {text: found for text, found in outcomes.items() if found not in ("read", "refused", "passed")}
    counts = Counter(outcomes.values())
    assert counts["read"] > 0.3 * len(outcomes), counts


def test_there_are_more_than_thirty_thousand() -> None:
    assert len(SPELLINGS) > 30_000
    assert len(MANGLINGS) >= 12
