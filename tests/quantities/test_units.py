"""Text to SI numbers: accepted texts, refused texts, and the messages."""

from fractions import Fraction
from itertools import product
from pathlib import Path

import pint
import pytest

from jkroll.quantities.units import PLAIN, PREFIXABLE, PREFIXES, dimension_of, kind_of, lookup
from jkroll.quantities.values import QuantityError, parse_quantity, unit_of

# Names in the table of units.py that some versions of pint lack, or define with other values.
UNLIKE = frozenset(
    """gf gram_force pond ponds kgf kilogram_force kilopond kiloponds Da dalton daltons u amu bohr bohrs hartree
    hartrees Eh E_h rydberg rydbergs Ry fathom fathoms furlong furlongs electronvolt cmHg mmHg""".split()
)
OTHER_NAMES = {"°": "deg", "%": "percent", "kmph": "kph", "kmh": "kph"}  # pint's names, by those of the table


@pytest.mark.parametrize(
    "text",
    ["100nm", "0.1 µm", "0.1 μm", "0.1um", "1e-7m", "1000Å", "1000 Å", "1000 angstrom", "100\u00a0nm", "+100 nm"],
)
def test_one_length_in_many_spellings_is_one_double(text: str) -> None:
    assert parse_quantity(text, "radius") == 1e-7


@pytest.mark.parametrize(
    ("text", "name", "value"),
    [
        ("25 erg/cm2", "surface_energy", 0.025),
        ("25 mJ/m2", "surface_energy", 0.025),
        ("25mJ m^-2", "surface_energy", 0.025),
        ("25 mJ·m⁻²", "surface_energy", 0.025),
        ("25 mN/m", "surface_energy", 0.025),
        ("2.6 g/cm3", "density", 2600.0),
        ("2.6 g/cm**3", "density", 2600.0),
        ("−3nN", "load", -3e-9),
        ("-3e-4 dyn", "load", -3e-9),
        ("3e4J", "energy", 3e4),
        ("5eV", "energy", 5 * 1.602176634e-19),
        ("1.62 m/s/s", "gravity", 1.62),
        ("1 standard_gravity", "gravity", 9.80665),
        ("1000g", "gravity", 9806.65),
        ("17 %", "poisson_ratio", 0.17),
        ("0.17", "poisson_ratio", 0.17),
        ("rigid", "youngs_modulus", float("inf")),
        ("Plane", "radius2", float("inf")),
        ("1 furlong", "radius", 201.168),
        ("1 bohr", "radius", 5.29177210544e-11),
        ("1 hartree", "energy", 4.3597447222060e-18),
        ("1 mEh", "energy", 4.3597447222060e-21),
        ("1 Ry", "energy", 2.1798723611030e-18),
        ("1 electronvolt", "energy", 1.602176634e-19),
        ("1 kDa", "mass", 1.66053906892e-24),
        ("1 kilopond", "load", 9.80665),
        ("1 kgf", "load", 9.80665),
        ("1 cmHg", "youngs_modulus", 1333.22387415),
        ("1 mmHg", "youngs_modulus", 133.322387415),
        ("36 km/h", "speed", 10.0),
        ("36 kmh", "speed", 10.0),
        ("36 kph", "speed", 10.0),
        ("36 kmph", "speed", 10.0),
        ("36 mph", "speed", 16.09344),
        ("36 knots", "speed", 18.52),
        ("10 fps", "speed", 3.048),
        ("36 cmps", "speed", 0.36),
    ],
)
def test_texts_are_read_as_si_numbers(text: str, name: str, value: float) -> None:
    assert parse_quantity(text, name) == value


TWO_NUMBERS = "has two numbers; write 20 to 30 mJ/m2 for a range; on a command line, 20nm:100nm:9 is a list"
REFUSED = {
    "5mµm": "radius: '5mµm' has a µ that is not the first letter of a unit; expected a length such as 100nm",
    "5 N": "radius: '5 N' is a force; expected a length such as 100nm",
    "100": "radius: '100' has no unit; expected a length such as 100nm",
    "5,5 nm": (
        "radius: '5,5 nm' has a comma: write a decimal point, and no thousands separators; expected a length such as "
        "100nm"
    ),
    "nm": "radius: 'nm' does not begin with a number; expected a length such as 100nm",
    "": "radius: '' does not begin with a number; expected a length such as 100nm",
    "inf": "radius: 'inf' does not begin with a number; expected a length such as 100nm",
    "0nm": "radius: '0nm' must be positive; expected a length such as 100nm",
    "-5 nm": "radius: '-5 nm' must be positive; expected a length such as 100nm",
    "5 nn": "radius: '5 nn' has an unknown unit 'nn'; did you mean nm?",
    "5 NM": "radius: '5 NM' has an unknown unit 'NM'; did you mean nm?",
    "5 m/m m": "radius: '5 m/m m' can be read as m/m*m or as m/m/m; write the one that is meant",
    "1e9999 nm": "radius: '1e9999 nm' has an exponent of more than 3 digits; expected a length such as 100nm",
    "1e400 nm": "radius: '1e400 nm' is too large for a double; expected a length such as 100nm",
    "1e-400 nm": "radius: '1e-400 nm' is too small for a double; expected a length such as 100nm",
    "5.00(1) nm": "radius: '5.00(1) nm' has an uncertainty: give the value alone; expected a length such as 100nm",
    "5 nm = 6 nm": "radius: '5 nm = 6 nm' is not a number and a unit; expected a length such as 100nm",
    "5-6 nm": f"radius: '5-6 nm' {TWO_NUMBERS}",
    "5nm-6nm": f"radius: '5nm-6nm' {TWO_NUMBERS}",
    "5..6 nm": f"radius: '5..6 nm' {TWO_NUMBERS}",
    "1.25d1": "radius: '1.25d1' has d1 directly after the number; write e for a power of ten, as in 1.25e1",
    "1.5D-07": "radius: '1.5D-07' has D-07 directly after the number; write e for a power of ten, as in 1.5e-07",
    "1.5D-07m": "radius: '1.5D-07m' has D-07 directly after the number; write e for a power of ten, as in 1.5e-07",
    "5m1": "radius: '5m1' has m1 directly after the number; write e for a power of ten, or a space before a unit",
    "1x10-7m": (
        "radius: '1x10-7m' has x10 directly after the number; write e for a power of ten, or a space before a unit"
    ),
    "5 nm!": "radius: '5 nm!' is not a number and a unit; expected a length such as 100nm",
    "$5 nm": "radius: '$5 nm' does not begin with a number; expected a length such as 100nm",
    "1e1.5 nm": "radius: '1e1.5 nm' is not a number and a unit; expected a length such as 100nm",
    "5 nm**400": "radius: '5 nm**400' has more than 8 units or a power above 12; expected a length such as 100nm",
    "5 nm nm": "radius: '5 nm nm' is an area; expected a length such as 100nm",
    "5 Nm": "radius: '5 Nm' has an unknown unit 'Nm'; did you mean nm?",
    "20 degC": "radius: '20 degC' has an unknown unit 'degC'; expected a length such as 100nm",
    "١ nm": "radius: '١ nm' does not begin with a number; expected a length such as 100nm",
    "5 \x1b[31m": "radius: '5 ?[31m' is not a number and a unit; expected a length such as 100nm",
    "10**10**10": "radius: '10**10**10' is not a number and a unit; expected a length such as 100nm",
}


@pytest.mark.parametrize("text", REFUSED)
def test_wrong_texts_are_refused_with_a_message(text: str) -> None:
    with pytest.raises(QuantityError) as error:
        parse_quantity(text, "radius")
    assert str(error.value) == REFUSED[text]


@pytest.mark.parametrize("unit", ["kkph", "mmph", "kmkmh", "kknot", "kfps", "mc", "kMPH"])
def test_no_unit_of_speed_but_mps_takes_a_prefix(unit: str) -> None:
    with pytest.raises(QuantityError, match="unknown unit"):
        parse_quantity(f"5 {unit}", "speed")


@pytest.mark.parametrize(
    ("text", "name", "guess"),
    [
        ("5 Gpa", "youngs_modulus", "GPa"),
        ("5 MPA", "youngs_modulus", "MPa"),
        ("5 mNm", "energy", "mN m"),
        ("1.6 gAl", "gravity", "Gal"),
        ("30 %%", "poisson_ratio", "%"),
    ],
)
def test_a_suggested_unit_gives_the_dimension_of_the_quantity(text: str, name: str, guess: str) -> None:
    with pytest.raises(QuantityError) as error:
        parse_quantity(text, name)
    assert str(error.value).endswith(f"; did you mean {guess}?")
    unit = text.split()[1]
    typed = error.value.mistake.split("'")[1]
    assert parse_quantity(f"5 {unit.replace(typed, guess)}", name) > 0


def test_a_long_text_is_refused_and_not_repeated() -> None:
    with pytest.raises(QuantityError) as error:
        parse_quantity("9" * 100_000 + "nm", "radius")
    assert str(error.value).endswith("is longer than 80 characters; expected a length such as 100nm")
    assert len(str(error.value)) < 200


def test_units_of_the_table_agree_with_pint() -> None:
    """The table agrees with pint for each name, and for each name with each prefix, to 48 digits.

    Names that differ between versions of pint are read in the tests above.
    """
    names = [name for name in (*PLAIN, *PREFIXABLE) if name not in UNLIKE]
    names += [prefix + name for prefix, name in product(PREFIXES, PREFIXABLE) if name not in UNLIKE]
    for name in names:
        numerator, denominator, dimension = lookup(OTHER_NAMES.get(name, name)) or (0, 1, ())
        above, below, own_dimension = unit_of(name, "radius")
        error = abs(Fraction(numerator, denominator) / Fraction(above, below) - 1)
        assert error < Fraction(1, 10**48), (name, pint.__version__)
        assert dimension == own_dimension, (name, pint.__version__)


def test_no_unit_of_pint_has_another_number_in_another_version() -> None:
    """Each version of pint gives a unit its number in the list, which was made with pint 0.25.3, or none.

    If a new version fails here, add the changed names to `_UNLIKE` of units.py, and common ones to its table as well.
    """
    lines = (Path(__file__).parents[1] / "data" / "units.txt").read_text(encoding="utf-8").splitlines()
    listed = [line.split() for line in lines if not line.startswith("#")]
    assert len(listed) > 500
    changed = []
    for name, factor, *powers in listed:
        unit = lookup(name)
        if unit is not None and (unit[0] / unit[1], unit[2]) != (float(factor), tuple(map(int, powers))):
            changed.append(name)
    assert changed == [], pint.__version__


@pytest.mark.parametrize(
    "unit",
    ["acre", "league", "rod", "kchain", "ch", "mil", "quarter", "drachm", "mHg", "m_e", "electron_mass"],
)
def test_a_unit_that_depends_on_the_version_of_pint_is_refused(unit: str) -> None:
    with pytest.raises(QuantityError, match="unknown unit"):
        parse_quantity(f"5 {unit}", "radius")


def test_dimensions_are_named() -> None:
    assert kind_of(dimension_of("J/m^2")) == "a surface energy"
    assert kind_of(dimension_of("N m")) == "an energy"
