"""Values with an uncertainty: accepted texts, refused texts, and how values are written."""

import copy
import math
import pickle
from decimal import Decimal
from typing import Any, NamedTuple

import numpy
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from jkroll.errors import JkrollError
from jkroll.model.containers import Reader
from jkroll.quantities.formatting import Format, ShownUnit, amount
from jkroll.quantities.values import (
    Interval,
    Measured,
    QuantityError,
    has_uncertainty,
    parse_quantity,
    unit_of,
    value_of,
)
from relative import approx

SPELLINGS = """25±5 mJ/m2; 25 ± 5 mJ/m2; 25+-5mJ/m2; 25 +/- 5 mJ/m2; 25+−5 mJ/m2; 25(5)mJ/m2; 25mJ/m2±20%;
25 mJ/m2 ± 5 mJ/m2; 25 mJ/m2 ± 5 erg/cm2; (25±5) mJ/m2; (25 +/- 5) mJ·m⁻²; (2.50+/-0.50)e-2 J/m2; 25e-3±5e-3 J/m2;
25(5)e-3 J/m2; 25 +5/-5 mJ/m2"""


@pytest.mark.parametrize("text", [text.strip() for text in SPELLINGS.split(";")])
def test_one_uncertainty_in_many_spellings(text: str) -> None:
    assert has_uncertainty(text)
    assert value_of(text, "surface_energy") == Measured(0.025, 0.005, 0.005)


@pytest.mark.parametrize(
    ("text", "name", "value"),
    [
        ("5.00(1) nm", "radius", Measured(5e-9, 1e-11, 1e-11)),
        ("25 +6/-4 mJ/m2", "surface_energy", Measured(0.025, 0.004, 0.006)),
        ("-5±20 nN", "load", Measured(-5e-9, 2e-8, 2e-8)),
        ("-5 nN ± 10%", "load", Measured(-5e-9, 5e-10, 5e-10)),
        ("0.17±10%", "poisson_ratio", Measured(0.17, 0.017, 0.017)),
        ("(17±1) %", "poisson_ratio", Measured(0.17, 0.01, 0.01)),
        ("20 to 30 mJ/m2", "surface_energy", Interval(0.025, 0.02, 0.03)),
        ("20mJ/m2 to 30mJ/m2", "surface_energy", Interval(0.025, 0.02, 0.03)),
        ("20 erg/cm2 to 30 mN/m", "surface_energy", Interval(0.025, 0.02, 0.03)),
        ("0.1 to 0.2", "poisson_ratio", Interval(0.15, 0.1, 0.2)),
        ("-1 to 1 nN", "load", Interval(0.0, -1e-9, 1e-9)),
        ("25±0 mJ/m2", "surface_energy", 0.025),
        ("25 mJ/m2", "surface_energy", 0.025),
        ("+1e+3 nm", "radius", 1e-6),
        ("plane", "radius2", float("inf")),
        ("∞", "radius2", float("inf")),
    ],
)
def test_texts_are_read_as_uncertain_values(text: str, name: str, value: object) -> None:
    assert value_of(text, name) == value


REFUSED = {
    "(2.5e1±5)e-3 J/m2": "has two powers of ten; write one, as in (25±5)e-3 J/m2",
    "3.4(9) mJ/m2": "can be read as 3.4±0.9 or as 3.4e9; write the one that is meant",
    "5.4(10) mJ/m2": "can be read as 5.4±1.0 or as 5.4e10; write the one that is meant",
    "25±15 mJ/m2": "has an uncertainty of half the value or more; give a range: FROM to TO",
    "25 +1/-12.5 mJ/m2": "has an uncertainty of half the value or more; give a range: FROM to TO",
    "25±20% mJ/m2": "has a % that can be read in two ways; write 25 mJ/m2 ± 20%, or (17±1) %",
    "25±5±1 mJ/m2": "has an uncertainty in an unknown form; write it as in 25±5 mJ/m2 or 20 to 30 mJ/m2",
    "25 mJ/(m^2)": "has brackets in its unit; leave them out, as in mJ/m2",
    "1.2.3(4) mJ/m2": "has an uncertainty in an unknown form; write it as in 25±5 mJ/m2 or 20 to 30 mJ/m2",
    "25(5.0) mJ/m2": "has an uncertainty in an unknown form; write it as in 25±5 mJ/m2 or 20 to 30 mJ/m2",
    "25 mJ/m2 ± 5": "has an uncertainty without a unit; expected a surface energy such as 25mJ/m2",
    "25±5": "has no unit; expected a surface energy such as 25mJ/m2",
    "25±5 mJ": "is an energy; expected a surface energy such as 25mJ/m2",
    "25 mJ/m2 ± 5 nm": "is a length; expected a surface energy such as 25mJ/m2",
    "25±5 mj/m2": "has an unknown unit 'mj'; expected a surface energy such as 25mJ/m2",
    "25±-5 mJ/m2": "has a negative uncertainty; expected a surface energy such as 25mJ/m2",
    "-25±5 mJ/m2": "must be positive; expected a surface energy such as 25mJ/m2",
    "30 to 20 mJ/m2": "does not rise: write the smaller value first; expected a surface energy such as 25mJ/m2",
    "0 to 20 mJ/m2": "must be positive at both ends; expected a surface energy such as 25mJ/m2",
    "1e900 to 2e900 J/m2": "is too large for a double; expected a surface energy such as 25mJ/m2",
    "20 to 30": "has no unit; expected a surface energy such as 25mJ/m2",
    "±": "has an uncertainty in an unknown form; write it as in 25±5 mJ/m2 or 20 to 30 mJ/m2",
}


@pytest.mark.parametrize("text", REFUSED)
def test_wrong_texts_are_refused_with_a_message(text: str) -> None:
    with pytest.raises(QuantityError) as error:
        value_of(text, "surface_energy")
    assert str(error.value) == f"surface_energy: '{text}' {REFUSED[text]}"


def test_an_uncertain_poisson_ratio_must_be_possible_at_both_ends() -> None:
    with pytest.raises(QuantityError, match="at both ends"):
        value_of("0.49±0.05", "poisson_ratio")
    with pytest.raises(QuantityError, match="% that can be read in two ways"):
        value_of("17%±1%", "poisson_ratio")


@pytest.mark.parametrize("text", ["25±5 mJ/m2", "25(5) mJ/m2", "25+-5 mJ/m2", "25 mJ/m2 ± 20%", "20 to 30 mJ/m2"])
def test_an_uncertainty_is_refused_where_a_single_number_is_needed(text: str) -> None:
    with pytest.raises(QuantityError, match="has an uncertainty: give the value alone"):
        parse_quantity(text, "surface_energy")


DECIMALS = st.decimals(min_value=Decimal("1e-9"), max_value=Decimal("1e9"), allow_nan=False, places=12)


@example(Decimal("0.1"), Decimal("0.1000000000001"), "nm")
@given(DECIMALS, DECIMALS, st.sampled_from(["nm", "um", "ft"]))
def test_every_number_is_rounded_once(value: Decimal, other: Decimal, unit: str) -> None:
    factor = Decimal({"nm": "1e-9", "um": "1e-6", "ft": "0.3048"}[unit])
    smaller, larger = sorted((value, other))
    low, high = float(smaller * factor), float(larger * factor)
    if 3 * smaller < larger:  # an uncertainty of half the value or more is refused
        assert value_of(f"({larger}±{smaller}) {unit}", "radius") == Measured(high, low, low)
    if low < high:
        interval = value_of(f"{smaller} to {larger} {unit}", "radius")
        assert isinstance(interval, Interval)
        assert interval.sides == {"low": low, "high": high}
        assert interval.value == approx((low + high) / 2, rel=1e-14)


@given(
    st.text(alphabet="0123456789.eE+-±()/% nmto", max_size=30)
    | st.text(max_size=90)
    | st.from_regex(r"[-+]?\d{1,5}(\.\d+)?(e-?\d{1,4})? ?([a-zA-Z]{1,8}[\^*/ ]{0,2}-?\d{0,3}){0,9}", fullmatch=True)
)
def test_any_text_gives_a_value_or_a_quantity_error(text: str) -> None:
    try:
        found = value_of(text, "radius")
    except QuantityError as error:
        assert "\n" not in str(error)
        return
    if isinstance(found, float):
        assert found > 0
    else:
        assert 0 < found.low <= found.value <= found.high


class Ufloat(NamedTuple):
    """A number with the attributes of a number of the package `uncertainties`."""

    nominal_value: float
    std_dev: float


def test_a_number_of_the_package_uncertainties_is_read() -> None:
    assert Reader().in_si({"gamma": Ufloat(0.025, 0.005)}) == {"surface_energy": Measured(0.025, 0.005, 0.005)}
    assert Reader().in_si({"gamma": Ufloat(0.025, 0.0)}) == {"surface_energy": 0.025}
    with pytest.raises(QuantityError, match="half the value"):
        Reader().in_si({"gamma": Ufloat(0.025, 0.02)})


@pytest.mark.parametrize("sides", [{"minus": 0.005}, {"plus": 0.005}, {"minus": 0.005, "plus": 0.005}])
def test_a_single_uncertainty_applies_to_both_sides(sides: dict[str, float]) -> None:
    found = Measured(0.025, **sides)
    assert (found.minus, found.plus) == (0.005, 0.005)
    assert found == Measured(0.025, 0.005)


@pytest.mark.parametrize(
    ("kind", "values", "words"),
    [
        (Measured, (0.025,), "the uncertainty is missing"),
        (Measured, (0.025, -0.005), "-0.005 is a negative uncertainty"),
        (Measured, (0.025, 0.004, -0.005), "-0.005 is a negative uncertainty"),
        (Measured, (0.025, math.nan), "'nan' is not a number"),
        (Measured, ("25 mJ/m2", "5 mJ/m2"), "'25 mJ/m2' is not a number in SI units"),
        (Measured, (numpy.ones(2), 0.1), "is not a number"),
        (Interval, (0.025, 0.03, 0.02), "0.025 does not lie in the range from 0.03 to 0.02"),
        (Interval, (0.05, 0.02, 0.03), "0.05 does not lie in the range from 0.02 to 0.03"),
        (Interval, (numpy.float64(0.05), 0, 0.03), "Interval: 0.05 does not lie in the range from 0.0 to 0.03"),
        (Interval, (0.025, None, 0.03), "'None' is not a number"),
        (Interval, (10**400, 0, 1), "is not a number"),
    ],
)
def test_invalid_uncertain_values_are_refused(kind: type[Any], values: tuple[Any, ...], words: str) -> None:
    with pytest.raises(JkrollError, match=words):
        kind(*values)


@pytest.mark.parametrize("value", [Measured(0.025, 0.004, 0.006), Interval(0.025, 0.02, 0.03)])
def test_an_uncertain_value_is_copied_and_pickled(value: Measured | Interval) -> None:
    for again in (pickle.loads(pickle.dumps(value)), copy.copy(value), copy.deepcopy(value)):
        assert again == value
        assert type(again) is type(value)


@pytest.mark.parametrize("value", [Measured(0.025, 0.005, 0.005), Interval(0.025, 0.02, 0.03)])
def test_numpy_makes_no_array_of_numbers_from_an_uncertain_value(value: Measured | Interval) -> None:
    assert numpy.asarray(value).dtype.kind not in "fiu"


@pytest.mark.parametrize(
    ("text", "name", "written"),
    [
        ("25±5 mJ/m2", "surface_energy", "25.0 ± 5.0 mJ/m²"),
        ("25 +6/-4 mJ/m2", "surface_energy", "25.0 +6.0/-4.0 mJ/m²"),
        ("25 +5/-4.9 mJ/m2", "surface_energy", "25.0 +5.0/-4.9 mJ/m²"),
        ("25 +5/-0 mJ/m2", "surface_energy", "25.0 +5.0/-0.0 mJ/m²"),
        ("20 to 30 mJ/m2", "surface_energy", "20 to 30 mJ/m²"),
        ("19.25 to 19.3 g/cm3", "density", "19250 to 19300 kg/m³"),
        ("2.2±0.5 g/cm3", "density", "2200 ± 500 kg/m³"),
        ("54±0.123 GPa", "youngs_modulus", "54.00 ± 0.12 GPa"),
        ("100±9.96 nm", "radius", "100 ± 10 nm"),
        ("-5±20 nN", "load", "-5 ± 20 nN"),
        ("0.17±0.01", "poisson_ratio", "0.170 ± 0.010"),
        ("0.3 to 0.4", "poisson_ratio", "0.3 to 0.4"),
        ("(1±0.1)e-5 m/s2", "gravity", "(1.00 ± 0.10)e-5 m/s²"),
    ],
)
def test_uncertain_values_are_written_and_read_back(text: str, name: str, written: str) -> None:
    found = value_of(text, name)
    assert isinstance(found, Measured | Interval)
    assert amount(name, found) == written
    again = value_of(written, name)
    assert isinstance(again, Measured | Interval)
    assert again.value == approx(found.value, rel=1e-3)


def test_a_range_too_narrow_for_its_digits_is_written_as_a_number() -> None:
    assert amount("surface_energy", Interval(0.025, 0.025, 0.0250000001)) == "25 mJ/m²"


def test_an_uncertain_value_is_written_in_a_chosen_unit() -> None:
    form = Format({"radius": ShownUnit("um", unit_of("um", "radius"))})
    assert amount("radius", Measured(1e-7, 1e-8, 1e-8), form) == "0.100 ± 0.010 um"
