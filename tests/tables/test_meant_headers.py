"""Headers in words that the program may not know: none is read as what it does not mean."""

import pytest

from meant_headers import MISREAD, READ, groups_of, meant_headers, outcome


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_no_header_is_misread(seed: int) -> None:
    outcomes = {header: outcome(header) for header in meant_headers(seed, 1000)}
    assert [header for header, found in outcomes.items() if found == MISREAD] == []
    assert [*outcomes.values()].count(READ) > 0.05 * len(outcomes)


def test_they_are_the_same_for_a_seed_and_all_differ() -> None:
    headers = meant_headers(1)
    assert headers == meant_headers(1)
    assert len({header.text for header in headers}) == len(headers) == 12_000
    groups = groups_of(headers)
    assert len(groups["inputs"]) > 5_000 < len(groups["none"])
    assert len(groups["plain"]) > 500 < len(groups["sphere 2"])
