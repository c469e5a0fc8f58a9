"""Every number printed in the paper, computed and compared at its printed precision.

The numbers are the records of paper.toml, which states how to write and read them. Numbers that are wrong in the paper
are among them, as strict xfails with their reasons.
"""

import math
import tomllib
from collections.abc import Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

import pytest

from jkroll import FORMULAS, NOMENCLATURE, known_materials, solve
from jkroll.model.plan import parameters_of
from jkroll.model.reasons import MissingInput
from jkroll.quantities.units import parse_unit

EMPTY_CELL = "..."
ROUNDING = 1e-9  # largest relative distance of a formula from the printed one, and distance of an exponent
ARGUMENTS = NOMENCLATURE.keys() | {name for formula in FORMULAS.values() for name in parameters_of(formula)}
NAMES = ARGUMENTS | FORMULAS.keys()

Given = Mapping[str, Any]  # SI numbers, or texts for `solve` to read
Interval = tuple[float, float]


class Record(NamedTuple):
    """One printed number; the head of paper.toml explains the fields."""

    where: str
    wanted: str
    printed: str
    given: Mapping[str, str] = MappingProxyType({})
    within: Sequence[str] = ()
    exponent_of: str = ""
    disagrees: str = ""

    def computed(self) -> float:
        """Return the computed product, or the exponent with which it depends on the input `exponent_of`."""
        given = understood(self.given)
        result = product(self.wanted, given)
        if not self.exponent_of:
            return result
        doubled = {**given, self.exponent_of: 2 * value(self.exponent_of, given)}
        return math.log2(product(self.wanted, doubled) / result)

    def admitted(self) -> Interval:
        """Return the ends of the range of values that agree with the printed number."""
        if self.within:
            low, high = self.within
            return si(low), si(high)
        if self.exponent_of:
            return around(float(Fraction(self.printed)), ROUNDING)
        if is_product(self.printed):
            formula = product(self.printed, understood(self.given))
            return around(formula, ROUNDING * abs(formula))
        return around(si(self.printed), half_a_unit_in_the_last_place(self.printed))


# --- The texts of a record -------------------------------------------------------------------------------------------


def si(text: str) -> float:
    """Return the SI value of a number and a unit."""
    digits, _, unit = text.partition(" ")
    number = Fraction(digits)
    numerator, denominator, _ = parse_unit(unit) if unit not in ("", "1") else (1, 1, ())
    return float(number * numerator / denominator)


def half_a_unit_in_the_last_place(text: str) -> float:
    """Return half a unit in the last printed place, in SI: 0.005 for "0.17", 5e-7 for "50 um"."""
    digits, _, unit = text.partition(" ")
    last_place = int(Decimal(digits).as_tuple().exponent)
    return si(f"5e{last_place - 1} {unit}")


def around(middle: float, margin: float) -> Interval:
    """Return the ends of a margin around a middle."""
    return middle - margin, middle + margin


def is_product(text: str) -> bool:
    """Return whether a text names a quantity or a formula, and so is not a number with a unit."""
    return any(factor.partition("^")[0] in NAMES for factor in text.split())


def product(text: str, given: Given) -> float:
    """Return the SI value of a product such as "4 pi radius^3 / 3"."""
    result = 1.0
    sign = 1
    for factor in text.split():
        if factor == "/":
            sign = -1
        else:
            base, _, power = factor.partition("^")
            result *= value(base, given) ** (sign * float(Fraction(power or 1)))
    return result


def value(name: str, given: Given) -> float:
    """Return the SI value of a quantity, a formula, a parameter of a formula, pi, or a number."""
    if name in NOMENCLATURE:
        return float(solve(name, **{key: given[key] for key in given if key in NOMENCLATURE}))
    if name in FORMULAS:
        formula = FORMULAS[name]
        return float(formula(**{parameter: value(parameter, given) for parameter in parameters_of(formula)}))
    if name in given:
        return float(given[name])
    return math.pi if name == "pi" else float(name)


def understood(texts: Mapping[str, str]) -> Given:
    """Return the given values: texts for `solve`, and SI values for products and for parameters of formulas."""
    given: dict[str, Any] = {}
    for name, text in texts.items():
        if is_product(text):
            given[name] = product(text, given)
        else:
            given[name] = text if name in NOMENCLATURE else si(text)
    return given


# --- The numbers -----------------------------------------------------------------------------------------------------

PAPER: dict[str, Any] = tomllib.loads(Path(__file__).with_name("paper.toml").read_text(encoding="utf-8"))
REFERENCES: Mapping[str, Sequence[str]] = PAPER.pop("references")
RECORDS = [(section, Record(**entry)) for section, entries in PAPER.items() for entry in entries]
EMPTY_CELLS = [record for _, record in RECORDS if record.printed == EMPTY_CELL]


def disagreement(record: Record) -> list[pytest.MarkDecorator]:
    """Return the mark of a wrong number, which the program must not reproduce. Only a failed comparison counts."""
    return [pytest.mark.xfail(strict=True, raises=AssertionError, reason=record.disagrees)] if record.disagrees else []


@pytest.mark.parametrize(
    "record",
    [
        pytest.param(record, id=f"{section}: {record.where}", marks=disagreement(record))
        for section, record in RECORDS
        if record not in EMPTY_CELLS
    ],
)
def test_a_printed_number_is_reproduced(record: Record) -> None:
    low, high = record.admitted()
    assert low <= record.computed() <= high


@pytest.mark.parametrize("record", [pytest.param(record, id=record.where) for record in EMPTY_CELLS])
def test_an_empty_cell_lacks_an_input(record: Record) -> None:
    with pytest.raises(MissingInput):
        record.computed()


@pytest.mark.parametrize("material", REFERENCES)
def test_references_are_those_of_the_paper(material: str) -> None:
    for reference, line in zip(known_materials()[material].references, REFERENCES[material], strict=True):
        if reference["type"] == "article":
            assert line.startswith(reference["author"].partition(",")[0])
            assert line.endswith("{year}. {journal}, {volume}, {pages}.".format_map(reference))
        else:
            assert line == reference["title"]


# --- The records themselves ------------------------------------------------------------------------------------------


def test_every_given_name_is_an_argument_of_solve_or_of_a_formula() -> None:
    assert {name for _, record in RECORDS for name in record.given} <= ARGUMENTS


def test_every_record_has_its_own_place() -> None:
    places = [(section, record.where) for section, record in RECORDS]
    assert len(places) == len(set(places))
