"""Python containers as inputs: units are read; unlike labels, correlated values and odd objects are refused."""

import array
import datetime
import math
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from types import SimpleNamespace
from typing import Any

import numpy
import pint
import pytest

import jkroll

Quantity: Any = pint.application_registry.Quantity
RADII = Quantity(numpy.array([100.0, 200.0]), "nm")
FORCES = jkroll.solve("pull_off_force", material="quartz", radius=numpy.array([1e-7, 2e-7]))


class Labelled(SimpleNamespace):
    """An array like those of xarray: data, dimensions, attributes. Conversion to numpy drops the unit of the data."""

    data: Any

    def __init__(self, data: Any, **attributes: str) -> None:
        super().__init__(data=data, dims=("grain",), dtype=numpy.dtype(float), attrs=attributes)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Any:
        return numpy.asarray(getattr(self.data, "magnitude", self.data), dtype)


def forces(radius: Any) -> Any:
    return jkroll.solve("pull_off_force", material="quartz", radius=radius)


def in_newtons(found: Any) -> Any:
    return found.m_as("N")


@pytest.mark.parametrize(
    "radii",
    [
        Labelled(RADII),
        Labelled(Labelled(RADII)),
        [Labelled(RADII[0]), RADII[1]],
        (Labelled(RADII[0]), Labelled(Quantity(numpy.array(0.2), "um"))),
    ],
)
def test_unit_inside_a_labelled_array_is_read(radii: Any) -> None:
    assert numpy.allclose(in_newtons(forces(radii)), FORCES, rtol=1e-14)


def test_scalar_inside_a_labelled_array_is_read() -> None:
    assert numpy.allclose(in_newtons(forces(Labelled(Quantity(numpy.array(100.0), "nm")))), FORCES[0], rtol=1e-14)


def test_labelled_array_of_si_numbers_is_read() -> None:
    assert numpy.array_equal(forces(Labelled(numpy.array([1e-7, 2e-7]), long_name="radius")), FORCES)


def test_formula_reads_the_unit_inside_a_labelled_array() -> None:
    force = jkroll.FORMULAS["pull_off_force"](
        work_of_adhesion=Quantity(0.05, "J/m^2"), reduced_radius=Labelled(RADII / 2)
    )
    assert numpy.allclose(in_newtons(force), FORCES, rtol=1e-14)


@pytest.mark.parametrize("word", ["unit", "units", "Units", "UNITS"])
@pytest.mark.parametrize("is_listed", [False, True])
def test_unit_among_attributes_is_read(word: str, is_listed: bool) -> None:
    radius = Labelled(numpy.array([100.0]), **{word: "nm"})
    assert forces([radius] if is_listed else radius).item() == FORCES[0]


def test_unit_of_another_package_inside_a_labelled_array_is_refused() -> None:
    quantity = SimpleNamespace(unit="nm", value=numpy.array([100.0]))
    with pytest.raises(jkroll.JkrollError, match="only those of pint and astropy are read"):
        forces(Labelled(quantity))


@pytest.mark.parametrize("words", [{"units": "nm"}, {"unit": "nm"}, {"dims": ()}])
def test_uncertain_value_with_a_unit_is_refused(words: dict[str, Any]) -> None:
    """float() of an array of unyt or xarray gives the number without the unit."""

    class Array(SimpleNamespace):
        def __float__(self) -> float:
            return 100.0

    with pytest.raises(jkroll.JkrollError, match="is not a number in SI units"):
        jkroll.Measured(Array(**words), 1e-9)  # type: ignore[arg-type]


# --- Labels -----------------------------------------------------------------------------------------------------------


class Index:
    """Labels, like an Index of pandas."""

    def __init__(self, *labels: object) -> None:
        self.labels = labels

    def equals(self, other: object) -> bool:
        """Return whether other labels are the same."""
        return isinstance(other, Index) and other.labels == self.labels


class Series:
    """Numbers with labels, like a Series of pandas."""

    dtype = numpy.dtype(float)

    def __init__(self, numbers: list[float], *labels: object) -> None:
        self.numbers, self.index = numbers, Index(*labels)
        self.axes = [self.index]

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Any:
        return numpy.asarray(self.numbers, dtype)


def labelled(numbers: list[float], dimension: str, *labels: object) -> Labelled:
    """Return numbers with labels, like an array of xarray."""
    found = Labelled(numpy.array(numbers))
    found.dims, found.indexes = (dimension,), {dimension: Index(*labels)} if labels else {}
    return found


DOORS: dict[str, Callable[[Any, Any], Any]] = {
    "solve": lambda energy, radius: jkroll.solve("pull_off_force", gamma=energy, radius=radius),
    "formula": lambda energy, radius: jkroll.formulas.pull_off_force(work_of_adhesion=energy, reduced_radius=radius),
    "infer": lambda force, radius: jkroll.infer("gamma", measured={"pull_off_force": force}, radius=radius),
}
ENERGIES, SIZES = [0.025, 0.05], [1e-7, 2e-7]
UNLIKE = {
    "other labels": (Series(ENERGIES, "a", "b"), Series(SIZES, "a", "c"), "indexes"),
    "another order": (Series(ENERGIES, "b", "a"), Series(SIZES, "a", "b"), "indexes"),
    "more labels": (Series([*ENERGIES, 1.0], "a", "b", "c"), Series(SIZES, "a", "b"), "indexes"),
    "other dimensions": (labelled(ENERGIES, "y"), labelled(SIZES, "x"), "dimensions"),
    "other coordinates": (labelled(ENERGIES, "x", 1, 2), labelled(SIZES, "x", 2, 3), "indexes"),
    "coordinates of one array only": (labelled(ENERGIES, "x", 1, 2), labelled(SIZES, "x"), "indexes"),
    "in lists": ([Series(ENERGIES, "a", "b")], [Series(SIZES, "b", "a")], "indexes"),
}


@pytest.mark.parametrize("door", DOORS)
@pytest.mark.parametrize("case", UNLIKE)
def test_arrays_with_different_labels_are_refused(case: str, door: str) -> None:
    """Combined by position, two such arrays would pair values of different grains."""
    first, second, unlike = UNLIKE[case]
    words = rf"\w+ and \w+ have different {unlike}: align them first, or give numpy arrays"
    with pytest.raises(jkroll.JkrollError, match=words):
        DOORS[door](first, second)


def test_arrays_with_equal_labels_or_none_are_combined_by_position() -> None:
    exact = [3 * math.pi * 0.025 * 50e-9, 3 * math.pi * 0.05 * 100e-9]
    for first, second in (
        (Series(ENERGIES, "a", "b"), Series(SIZES, "a", "b")),
        (labelled(ENERGIES, "x", 1, 2), labelled(SIZES, "x", 1, 2)),
        (Series(ENERGIES, "a", "b"), numpy.array(SIZES)),
    ):
        assert numpy.allclose(DOORS["solve"](first, second), exact, rtol=1e-14)


# --- Correlations -----------------------------------------------------------------------------------------------------


def test_correlated_inputs_are_refused() -> None:
    """The error of P_c is 2.356e-9 N, a fifth of P_c; independent inputs would give 1.67e-9 N."""
    uncertainties = pytest.importorskip("uncertainties")
    energy = uncertainties.ufloat(0.025, 0.005)
    words = (
        r"surface_energy and surface_energy2 are correlated, and inputs must be independent; write uncertainties.wrap"
    )
    for other in (energy, 2 * energy, Quantity(energy * 1e3, "mJ/m^2")):
        for call in (jkroll.solve, jkroll.answer):
            with pytest.raises(jkroll.JkrollError, match=words):
                call("pull_off_force", gamma=energy, gamma2=other, radius=1e-7)
    with pytest.raises(jkroll.JkrollError, match="pull_off_force and radius are correlated"):
        jkroll.infer("gamma", measured={"pull_off_force": energy * 1e-6}, radius=energy * 1e-6)
    advised = uncertainties.wrap(lambda x: jkroll.solve("pull_off_force", gamma=x, gamma2=x, radius=1e-7))(energy)
    assert math.isclose(advised.std_dev, 0.2 * 3 * math.pi * 0.025 * 50e-9, rel_tol=1e-6)


def test_independent_inputs_are_accepted() -> None:
    """A change of one γ by 10 % changes w by 5 %, and both changes add in quadrature."""
    uncertainties = pytest.importorskip("uncertainties")
    first, second = (uncertainties.ufloat(0.025, 0.0025) for _ in range(2))
    force = jkroll.solve("pull_off_force", gamma=first + second - second, gamma2=second, radius=1e-7)
    assert math.isclose(force.plus, 3 * math.pi * 0.025 * 50e-9 * 0.05 * math.sqrt(2), rel_tol=1e-2)


# --- Formulas ---------------------------------------------------------------------------------------------------------


def test_formula_converts_quantities_and_numbers_in_si_units() -> None:
    """The force is (3/2)πwR for w = 50 mJ/m² and R = 75 nm; 75 was once read as metres, and the force was in nm."""
    exact = 3 * math.pi / 2 * 0.05 * 75e-9
    for energy, radius in (
        (0.05, Quantity(75, "nm")),
        (Quantity(50, "mJ/m^2"), 75e-9),
        (Quantity(50.0, "erg/cm^2"), Quantity(0.075, "um")),
        (Quantity(numpy.uint8(50), "mJ/m^2"), Quantity(numpy.float16(75), "nm")),
    ):
        force: Any = jkroll.formulas.pull_off_force(work_of_adhesion=energy, reduced_radius=radius)
        assert math.isclose(in_newtons(force), exact, rel_tol=1e-14)
        assert str(force.units) == "newton"  # as in results of solve


def test_formula_converts_parameters_outside_the_nomenclature() -> None:
    lengths: dict[str, Any] = {"distance": Quantity(3, "nm"), "contact_radius_at_load": Quantity(0.005, "um")}
    found: Any = jkroll.formulas.pressure(**lengths, hertz_pressure=Quantity(1.0, "GPa"), boussinesq_pressure=-1e6)
    assert math.isclose(found.m_as("Pa"), 0.8e9 - 1e6 / 0.8, rel_tol=1e-14)  # √(1 − (r/a)²) = 0.8


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (
            {"reduced_radius": Quantity(75, "kg")},
            "reduced_radius: '75 kilogram' has the wrong dimension; give a value in m",
        ),
        ({"reduced_radius": Quantity(75)}, "has the wrong dimension"),
        ({"reduced_radius": Quantity(20, "degC")}, "has the wrong dimension"),
        ({"reduced_radius": Quantity([75.0, 80.0], "nm"), "work_of_adhesion": [0.1] * 3}, "do not broadcast"),
        ({"reduced_radius": jkroll.Measured(1e-7, 1e-8)}, "is not a number; give a number in SI units"),
        ({"radius": 1e-7}, "pull_off_force takes work_of_adhesion and reduced_radius, each by its name"),
        ({}, "pull_off_force takes work_of_adhesion and reduced_radius, each by its name"),
    ],
)
def test_formula_refuses_wrong_arguments_with_a_reason(given: dict[str, Any], words: str) -> None:
    with pytest.raises(jkroll.JkrollError, match=words):
        jkroll.formulas.pull_off_force(**{"work_of_adhesion": 0.05, **given})


def test_formula_gives_the_reason_outside_its_domain() -> None:
    """The error is also a ValueError, as the formulas promise."""
    wrong: list[tuple[Callable[..., Any], dict[str, Any], str]] = [
        (
            jkroll.formulas.load_margin,
            {"load": Quantity(-12, "nN"), "pull_off_force": 1e-8},
            "-12 nN breaks this contact",
        ),
        (jkroll.formulas.load_margin, {"load": -math.inf, "pull_off_force": 1e-8}, "no value that a double can hold"),
        (jkroll.formulas.radius_ratio, {"radius": 1.0, "radius2": 0.0}, "no value that a double can hold"),
        (jkroll.formulas.contact_area, {"contact_radius_at_load": 1e200}, "no value that a double can hold"),
        (
            jkroll.formulas.tensile_strength,
            {"work_of_adhesion": 1.0, "radius": 1.0, "filling_factor": -0.5},
            "no value",
        ),
    ]
    for formula, given, words in wrong:
        with pytest.raises(jkroll.JkrollError, match=words) as caught:
            formula(**given)
        assert isinstance(caught.value, ValueError)


# --- Odd containers ---------------------------------------------------------------------------------------------------


class Raises:
    """A container that numpy cannot read."""

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Any:
        raise RuntimeError("not on this device")


NUMBERS: dict[str, Any] = {  # each is 100 nm
    "a number of 80 bits": numpy.longdouble(1e-7),
    "an array without axes": numpy.array(1e-7),
    "in nested lists": [[1e-7]],
    "from the standard library": array.array("d", [1e-7]),
    "without a masked cell": numpy.ma.array([1e-7], mask=[False]),
    "in a Quantity of 16 bits": Quantity(numpy.array([100], numpy.float16), "nm"),
    "in a Quantity of bytes": Quantity(numpy.array([100], numpy.uint8), "nm"),
    "in a Quantity without axes": Quantity(numpy.array(100.0), "nm"),
}
ODD: dict[str, Any] = {
    "none": None,
    "a Boolean": numpy.bool_(True),
    "Booleans": [True],
    "complex": 1e-7 + 0j,
    "Decimal": Decimal("1e-7"),
    "Fraction": Fraction(1, 10**7),
    "bytes": b"1e-7",
    "a bytearray": bytearray(b"1"),
    "a memoryview": memoryview(b"1"),
    "a dict": {0: 1e-7},
    "a set": {1e-7},
    "an object": object(),
    "ragged": [[1e-7], [1e-7, 2e-7]],
    "a huge integer": [10**400],
    "objects": numpy.array([1e-7], dtype=object),
    "texts": numpy.array(["100 nm"]),
    "records": numpy.zeros(2, dtype=[("radius", float)]),
    "masked": numpy.ma.array([1e-7, 2e-7], mask=[False, True]),
    "a masked cell": numpy.ma.masked,
    "a date": datetime.date(2024, 1, 1),
    "dates": numpy.array(["2024-01-01"], dtype="M8[D]"),
    "a duration": numpy.timedelta64(5, "ns"),
    "a container that raises an error": Raises(),
    "a type": float,
    "a unit": pint.application_registry.nm,
    "a Quantity without a dimension": Quantity(1e-7),
    "a temperature": Quantity(20, "degC"),
    "a level in decibels": Quantity(3, "dB"),
    "a masked Quantity": Quantity(numpy.ma.array([100.0, 200.0], mask=[False, True]), "nm"),
    "a Quantity of objects": Quantity(numpy.array([100.0], dtype=object), "nm"),
    "a Quantity of texts": Quantity(numpy.array(["a"]), "nm"),
    "a Quantity of a Decimal": Quantity(Decimal(100), "nm"),
    "a dtype with units": SimpleNamespace(dtype=SimpleNamespace(units="nm")),
}
# Calls of the package with an object as one argument, by this argument.
AT: dict[str, Callable[[Any], Any]] = {
    "solve": forces,
    "answer": lambda odd: jkroll.answer("pull-off", material="quartz", radius=odd),
    "infer": lambda odd: jkroll.infer("gamma", measured={"pull_off_force": 3e-7}, radius=odd),
    "measured": lambda odd: jkroll.infer("gamma", measured={"pull_off_force": odd}, radius=1e-7),
    "formula": lambda odd: jkroll.formulas.pull_off_force(work_of_adhesion=0.05, reduced_radius=odd),
    "derivation": lambda odd: jkroll.formulas.initial_angular_speed(energy=1.0, moment_of_inertia=odd),
    "property": lambda odd: jkroll.solve(
        "pull_off_force",
        material=jkroll.known_materials()["quartz"]._replace(properties={"surface_energy": odd}),
        radius=1e-7,
    ),
    "position": lambda odd: jkroll.formulas.pressure(
        distance=odd, contact_radius_at_load=1.0, hertz_pressure=1.0, boussinesq_pressure=-0.1
    ),
    "wanted": lambda odd: jkroll.solve(odd, material="quartz", radius=1e-7),
    "asked": lambda odd: jkroll.answer(odd, material="quartz", radius=1e-7),
    "unknown": lambda odd: jkroll.infer(odd, measured={"pull_off_force": 3e-7}, radius=1e-7),
    "all measured": lambda odd: jkroll.infer("gamma", measured=odd, radius=1e-7),
    "material": lambda odd: jkroll.solve("pull_off_force", material=odd, radius=1e-7, gamma=0.1),
    "model": lambda odd: jkroll.solve("pull_off_force", material="quartz", model=odd, radius=1e-7),
    "element": lambda odd: jkroll.answer("pull-off", material="quartz", radius=1e-7)[odd],
    "path": jkroll.Materials,
    "value": lambda odd: jkroll.Measured(odd, 1e-9),
}
# Values that an entry point accepts on purpose: no material, no law, or a number that float() converts.
TAKEN = {("material", "none"), ("model", "none"), ("value", "Decimal"), ("value", "Fraction")}


@pytest.mark.parametrize("number", NUMBERS)
def test_every_kind_of_number_is_read_as_100_nm(number: str) -> None:
    found = forces(NUMBERS[number])
    assert numpy.allclose(getattr(found, "magnitude", found), FORCES[0], rtol=1e-14)


@pytest.mark.filterwarnings("ignore:Warning. converting a masked element:UserWarning")  # from numpy
@pytest.mark.parametrize("door", AT)
def test_odd_objects_are_refused_with_a_message(door: str) -> None:
    for name, odd in ODD.items():
        if (door, name) not in TAKEN:
            with pytest.raises(jkroll.JkrollError, match=r"\w{3}"):
                print(door, name, AT[door](odd))


# --- The packages themselves ------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_arrays_of_xarray_are_read_with_their_units() -> None:
    """Arrays, variables, elements and lists of elements are read; a unit stated twice and a Dataset are refused."""
    xarray = pytest.importorskip("xarray")
    array = xarray.DataArray(RADII)
    for radii in (array, array.variable, [array[0], array[1]], [array.variable[0], RADII[1]]):
        assert numpy.allclose(in_newtons(forces(radii)), FORCES, rtol=1e-14)
    assert numpy.allclose(in_newtons(forces(array[0])), FORCES[0], rtol=1e-14)
    assert numpy.array_equal(forces(xarray.DataArray([1e-7, 2e-7])), FORCES)
    assert forces(xarray.DataArray([100.0], attrs={"Units": "nm"}).variable)[0] == FORCES[0]
    with pytest.raises(jkroll.JkrollError, match="is an attribute of an array whose numbers have a unit"):
        forces(array.assign_attrs(units="nm"))
    with pytest.raises(jkroll.JkrollError, match="is not a number"):
        forces(xarray.Dataset({"data": array}))


def test_arrays_of_dask_are_read_with_their_units() -> None:
    array = pytest.importorskip("dask.array")
    inside = array.from_array(RADII, asarray=False)
    outside = Quantity(array.from_array(numpy.array([100.0, 200.0]), chunks=1), "nm")
    for radii in (inside, outside, Labelled(inside), Labelled(outside)):
        assert numpy.allclose(in_newtons(forces(radii)), FORCES, rtol=1e-14)


def test_series_of_pandas_are_read_and_unlike_labels_are_refused() -> None:
    pandas = pytest.importorskip("pandas")
    radii = pandas.Series([1e-7, 2e-7])
    assert numpy.array_equal(forces(radii), FORCES)
    with pytest.raises(jkroll.JkrollError, match="different dimensions: align them first"):
        DOORS["solve"](pandas.DataFrame([ENERGIES]), radii)
    for twice in (pandas.Series(ENERGIES, index=[1, 1]), pandas.Series([*ENERGIES, 1.0], index=[0, 1, 1])):
        with pytest.raises(jkroll.JkrollError, match="different indexes: align them first"):
            DOORS["solve"](twice, radii)
