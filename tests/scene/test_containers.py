"""Arrays of xarray, dask and pandas as inputs: a unit that one of them holds is read, or refused, and never dropped."""

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
    """What xarray has around an array: `data`, names of dimensions, attributes; numpy drops the unit of the data."""

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


def test_scalar_inside_a_labelled_array() -> None:
    assert numpy.allclose(in_newtons(forces(Labelled(Quantity(numpy.array(100.0), "nm")))), FORCES[0], rtol=1e-14)


def test_labelled_array_of_si_numbers() -> None:
    assert numpy.array_equal(forces(Labelled(numpy.array([1e-7, 2e-7]), long_name="radius")), FORCES)


def test_formula_reads_the_unit_inside_a_labelled_array() -> None:
    force = jkroll.FORMULAS["pull_off_force"](
        work_of_adhesion=Quantity(0.05, "J/m^2"), reduced_radius=Labelled(RADII / 2)
    )
    assert numpy.allclose(in_newtons(force), FORCES, rtol=1e-14)


@pytest.mark.parametrize("word", ["unit", "units", "Units", "UNITS"])
@pytest.mark.parametrize("is_listed", [False, True])
def test_unit_among_attributes_is_refused(word: str, is_listed: bool) -> None:
    radius = Labelled(numpy.array([100.0]), **{word: "nm"})
    with pytest.raises(jkroll.JkrollError, match=f"radius: '{word} = nm' is an attribute"):
        forces([radius] if is_listed else radius)


def test_unit_of_another_package_inside_a_labelled_array_is_refused() -> None:
    of_astropy = SimpleNamespace(unit="nm", value=numpy.array([100.0]))
    with pytest.raises(jkroll.JkrollError, match="only those of pint are read"):
        forces(Labelled(of_astropy))


@pytest.mark.parametrize("words", [{"units": "nm"}, {"unit": "nm"}, {"dims": ()}])
def test_uncertain_value_with_a_unit_is_refused(words: dict[str, Any]) -> None:
    """float() of an array of unyt, or of xarray, is its number without the unit."""

    class Array(SimpleNamespace):
        def __float__(self) -> float:
            return 100.0

    with pytest.raises(jkroll.JkrollError, match="is not a number in SI units"):
        jkroll.Measured(Array(**words), 1e-9)  # type: ignore[arg-type]


# --- The packages themselves ------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_xarray() -> None:
    """Read with its unit: an array, its variable, one element, a list of them, and pieces of dask."""
    xarray = pytest.importorskip("xarray")
    array = xarray.DataArray(RADII)
    for radii in (array, array.variable, [array[0], array[1]], [array.variable[0], RADII[1]]):
        assert numpy.allclose(in_newtons(forces(radii)), FORCES, rtol=1e-14)
    assert numpy.allclose(in_newtons(forces(array[0])), FORCES[0], rtol=1e-14)
    assert numpy.array_equal(forces(xarray.DataArray([1e-7, 2e-7])), FORCES)
    with pytest.raises(jkroll.JkrollError, match="is an attribute"):
        forces(xarray.DataArray([100.0], attrs={"Units": "nm"}).variable)
    with pytest.raises(jkroll.JkrollError, match="is not a number"):
        forces(xarray.Dataset({"data": array}))


def test_dask() -> None:
    array = pytest.importorskip("dask.array")
    inside = array.from_array(RADII, asarray=False)
    outside = Quantity(array.from_array(numpy.array([100.0, 200.0]), chunks=1), "nm")
    for radii in (inside, outside, Labelled(inside), Labelled(outside)):
        assert numpy.allclose(in_newtons(forces(radii)), FORCES, rtol=1e-14)


def test_pandas() -> None:
    pandas = pytest.importorskip("pandas")
    radii = pandas.Series([1e-7, 2e-7])
    assert numpy.array_equal(forces(radii), FORCES)
    radii.attrs["Units"] = "nm"
    with pytest.raises(jkroll.JkrollError, match="is an attribute"):
        forces(radii)
