"""The columns of uncertainties in a table, with the inputs to which they belong.

`reading` recognizes the header of an uncertainty; this module finds its owner among the other columns.
"""

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import product

from ..model.frame import EXCLUSIVE
from . import error_words, words
from .cells import is_number
from .reading import NO_FACTOR, SPREAD, UNREAD, Reading, normalized, reading_of, stems_of, unit_in
from .unit_spellings import fits
from .words import MATERIALS, headed

ENDS = ("low", "high")  # the parts of a range


def with_owners(readings: Sequence[Reading], given: Collection[str]) -> Iterator[Reading]:
    """Iterate over readings, those of uncertainties with the inputs to which they belong.

    `given`: the inputs given by options.
    """
    values = _values_in(readings)
    left, is_adjacent = Reading(), False  # the last column that may have an uncertainty
    for reading in readings:
        if not reading.part:
            is_adjacent = not _has_no_uncertainty(reading)
            left = reading if is_adjacent else left
        if reading.part and not (reading.name or reading.of):
            owners, is_certain = _owners(reading, left, readings, values, is_adjacent=is_adjacent)
            yield _of_value(_of_one_of(owners, reading, values, is_certain=is_certain), values, given)
        elif reading.part or (reading.of and not reading.is_input):
            yield _of_value(reading, values, given)
        elif other := _uncertain_instead(reading, values):
            yield Reading(other, part=UNREAD, problem=SPREAD.format(other), text=reading.text, cell=reading.cell)
        else:
            yield reading


def _values_in(readings: Sequence[Reading]) -> dict[str, Reading]:
    """Return the column of each input's value; for a range without a value, the last of its two end columns."""
    values = {reading.name: reading for reading in readings if reading.is_input and not reading.part}
    ends: dict[str, Reading] = {}
    for reading in readings:
        if reading.is_input and reading.part in ENDS and values.keys().isdisjoint(reading.names):
            ends[reading.name] = reading
    return ends | values


# --- Headers without a name -------------------------------------------------------------------------------------------


def _has_no_uncertainty(reading: Reading) -> bool:
    """Return whether a column has no uncertainty: counts, names of materials, and other texts."""
    tokens = words.tokens_of(reading.text)
    is_count = bool(tokens) and error_words.COUNTS.issuperset(tokens)
    is_text = reading.cell[:1].isalpha()
    return reading.name in MATERIALS or (not reading.is_input and (is_count or is_text))


def _owners(
    reading: Reading, left: Reading, readings: Sequence[Reading], values: Mapping[str, Reading], *, is_adjacent: bool
) -> tuple[Sequence[str], bool]:
    """Return the inputs to which an uncertainty without a name may belong, and whether that is certain.

    It belongs to the column on its left or, if the units differ, to the only column with its unit. `left`: the next
    column on the left that may have an uncertainty; `is_adjacent`: True if no other column stands between.
    """
    unit = reading.unit_text
    is_bare = unit in ("", "%")
    if reading.part == UNREAD and not is_number(reading.cell or "0"):
        return [], False
    if left.is_input and (is_bare or fits(unit, left.name)):
        return [left.name], is_adjacent or not is_bare
    if reading.part == UNREAD or (normalized(left.text) and not left.is_input):
        return [], False  # σ [MPa] may be a stress, and ± may belong to a column that is not read
    if is_bare:
        return [*values][:1], False  # no column on the left may have it
    owners = [name for name in values if fits(unit, name)]
    others = [other.text for other in readings if not other.part and not other.is_input]
    is_of_others = any(unit_in(text, name) for text, name in product(others, owners))
    return owners, len(owners) == 1 and not is_of_others


def _of_one_of(owners: Sequence[str], reading: Reading, values: Mapping[str, Reading], *, is_certain: bool) -> Reading:
    """Return the reading of an uncertainty with its owner, or with a problem if the owner is not certain."""
    if is_certain or not owners:
        return reading._replace(name=owners[0] if owners else "")
    problem = reading.problem or SPREAD
    meant = [_error_column(name, reading.unit_text, values) for name in owners] if reading.coverage == 1 else []
    return reading._replace(name=owners[0], part=UNREAD, problem=problem, meant=meant)


# --- Headers with a name ----------------------------------------------------------------------------------------------


def _of_value(reading: Reading, values: Mapping[str, Reading], given: Collection[str]) -> Reading:
    """Return the reading of an uncertainty, with the input to which it belongs.

    If a symbol may mean several inputs and only one of them has a column, it means that one. A header that repeats one
    given by `--column`, with a suffix, is refused. Without a column of the value, an unread uncertainty has the meaning
    that `otherwise` states.
    """
    name, part = reading.name, reading.part
    if name not in {*values, *given} and not reading.is_stated:
        others = [each for each in reading.names if each in values]
        name = others[0] if len(others) == 1 else name
        stems = stems_of(reading.of)
        for value in values.values():
            if value.is_stated and not stems.isdisjoint(stems_of(value.text)):
                name, part = value.name, UNREAD
    if reading.is_relative and name in values and values[name].unit_text == "%":
        part = UNREAD  # 5 % of 40 %, or 40 ± 5 %
    if part != UNREAD:
        return reading._replace(name=name)
    if name not in {*values, *given}:
        return (reading.otherwise or Reading())._replace(text=reading.text, cell=reading.cell)
    meant = reading.meant
    if reading.problem == NO_FACTOR and name in values:
        meant = [f"{_error_column(name, '', values)} (k=K)"]
    return reading._replace(name=name, part=part, problem=(reading.problem or SPREAD).format(name), meant=meant)


def _error_column(name: str, unit_text: str, values: Mapping[str, Reading]) -> str:
    """Return the header for the uncertainty of an input, in a unit or, by default, that of its values."""
    return headed(name, unit_text or values[name].unit_text or "UNIT").replace(name, f"{name}_err", 1)


def _uncertain_instead(reading: Reading, values: Mapping[str, Reading]) -> str:
    """Return the input whose uncertainty a header such as Δγ gives; "" if there is none.

    Δγ is first read as w. In a table with a column of γ, which excludes w, it is an uncertainty of γ.
    """
    text = normalized(reading.text)
    rest = re.sub(error_words.DIFFERENCE, "", text)
    is_difference = rest != text and reading.is_input and not reading.is_stated
    name = reading_of(rest).name if is_difference else ""
    is_other = name in values and name != reading.name  # "iameter" is read as a diameter, so its d is no difference
    excludes = is_other and any({name, reading.name} <= {*names} for names in EXCLUSIVE)
    return name if excludes else ""
