"""Records behave as named tuples do."""

import copy
import pickle
from typing import Any, NamedTuple

import numpy
import pytest

from jkroll.record import Record


class Own(Record):
    """A record."""

    first: Any
    second: int = 2


class Named(NamedTuple):
    """The named tuple that it stands for."""

    first: Any
    second: int = 2


@pytest.mark.parametrize("kind", [Own, Named])
def test_fields_are_given_by_place_and_by_name(kind: Any) -> None:
    record = kind(1)
    first, second = record
    assert (first, second) == record == kind(first=1) == kind(second=2, first=1) == (1, 2)
    assert (record.first, record.second) == (1, 2)
    assert record._replace(second=5) == (1, 5) == kind._make([1, 5])
    assert record._asdict() == {"first": 1, "second": 2}
    assert repr(record) == f"{kind.__name__}(first=1, second=2)"
    assert hash(record) == hash((1, 2))
    assert kind._fields == ("first", "second")
    for again in (pickle.loads(pickle.dumps(record)), copy.copy(record), copy.deepcopy(record)):
        assert again == record
        assert type(again) is kind
    with pytest.raises(AttributeError):
        record.first = 2


@pytest.mark.parametrize("kind", [Own, Named])
@pytest.mark.parametrize(("values", "named"), [((), {}), ((1, 2, 3), {}), ((1,), {"third": 3}), ((1,), {"first": 2})])
def test_what_are_no_fields_is_refused(kind: Any, values: tuple[int, ...], named: dict[str, int]) -> None:
    with pytest.raises(TypeError):
        kind(*values, **named)


def test_a_field_may_be_an_array() -> None:
    values = numpy.ones(3)
    assert Own(first=values).first is values
