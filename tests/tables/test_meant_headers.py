"""Headers in words that the program may not know: no header is read with a wrong meaning."""

import pytest

from meant_headers import MISREAD, READ, groups_of, meant_headers, outcome


@pytest.mark.parametrize(("seed", "count"), [(1, 500), pytest.param(2, 12_000, marks=pytest.mark.slow)])
def test_no_header_is_misread(seed: int, count: int) -> None:
    outcomes = {header: outcome(header) for header in meant_headers(seed, count)}
    assert [header for header, found in outcomes.items() if found == MISREAD] == []
    assert [*outcomes.values()].count(READ) > 0.05 * len(outcomes)


def test_the_headers_of_a_seed_are_always_the_same_and_all_differ() -> None:
    headers = meant_headers(1, 1200)
    assert headers == meant_headers(1, 1200)
    assert len({header.text for header in headers}) == len(headers) == 1200
    groups = groups_of(headers)
    assert len(groups["inputs"]) > 400 < len(groups["none"])
    assert len(groups["plain"]) > 40
    assert len(groups["sphere 2"]) > 30
