"""Arrays of pandas and xarray: units among their attributes, alignment by labels, results with labels."""

import math
from typing import Any

import numpy
import pytest

import jkroll
from relative import approx

pandas: Any = pytest.importorskip("pandas")
xarray: Any = pytest.importorskip("xarray")

ENERGIES = pandas.Series([0.1, 0.2, 0.3], index=["c", "a", "b"])
RADII = pandas.Series([1e-7, 2e-7, 4e-7], index=["a", "b", "d"])


def force(energy: float, radius: float) -> float:
    """Return the pull-off force of equal spheres by hand: (3/2)πwR with w = 2γ and R = R1/2."""
    return 1.5 * math.pi * energy * radius


def test_series_are_aligned_as_in_pandas() -> None:
    """The product by pandas itself shows the labels of the result and their order."""
    found = jkroll.solve("P_c", gamma=ENERGIES, radius=RADII)
    pandas.testing.assert_series_equal(found, 1.5 * math.pi * ENERGIES * RADII, check_names=False)
    assert found.isna().tolist() == [False, False, True, True]
    assert found.name == "pull_off_force"


def test_columns_of_materials_are_aligned() -> None:
    solids = pandas.Series(["iron", "quartz"], index=["b", "a"])
    found = jkroll.solve("P_c", material=solids, radius=RADII)
    assert found["a"] == jkroll.solve("P_c", material="quartz", radius=1e-7)
    assert found["b"] == jkroll.solve("P_c", material="iron", radius=2e-7)
    assert [*found.index] == ["a", "b", "d"]
    assert math.isnan(found["d"])


def test_a_formula_and_a_measured_quantity_are_aligned() -> None:
    formula: Any = jkroll.formulas.pull_off_force(work_of_adhesion=2 * ENERGIES, reduced_radius=RADII / 2)
    pandas.testing.assert_series_equal(formula, jkroll.solve("P_c", gamma=ENERGIES, radius=RADII))
    back: Any = jkroll.infer("gamma", measured={"P_c": formula.dropna()}, radius=RADII)
    assert [*back.index] == ["a", "b", "d"]
    assert numpy.allclose(back[["a", "b"]], [0.2, 0.3], rtol=1e-12)


def test_frames_are_aligned_by_both_axes() -> None:
    energies = pandas.DataFrame([[0.1, 0.2], [0.3, 0.4]], index=[1, 2], columns=["x", "y"])
    radii = pandas.DataFrame([[1e-7, 2e-7], [3e-7, 4e-7]], index=[2, 1], columns=["y", "x"])
    found = jkroll.solve("P_c", gamma=energies, radius=radii)
    pandas.testing.assert_frame_equal(found, 1.5 * math.pi * energies * radii)


def test_arrays_are_aligned_as_in_xarray() -> None:
    energies = xarray.DataArray([0.1, 0.2, 0.3], dims="energy", coords={"energy": [1, 2, 3]})
    radii = xarray.DataArray([[1e-7, 2e-7], [3e-7, 4e-7]], dims=("size", "energy"), coords={"energy": [3, 1]})
    found = jkroll.solve("P_c", gamma=energies, radius=radii)
    xarray.testing.assert_allclose(found, (1.5 * math.pi * energies * radii).rename("pull_off_force"), rtol=1e-14)
    grid = jkroll.solve("P_c", gamma=energies, radius=xarray.DataArray([1e-7, 2e-7], dims="grain"))
    assert (grid.dims, grid.shape) == (("energy", "grain"), (3, 2))
    assert grid.sel(energy=2)[1] == approx(force(0.2, 2e-7))


def test_units_among_attributes_are_read_and_written() -> None:
    radii = xarray.DataArray([100.0, 200.0], dims="grain", attrs={"units": "nm"})
    bare = jkroll.solve("P_c", material="quartz", radius=numpy.array([1e-7, 2e-7]))
    found = jkroll.solve(["P_c", "n_grav"], material="quartz", radius=radii)
    assert found["pull_off_force"].values.tolist() == bare.tolist()
    assert (found["pull_off_force"].attrs, found["n_grav"].attrs) == ({"units": "N"}, {"units": "1"})
    back: Any = jkroll.infer("gamma", measured={"P_c": found["pull_off_force"]}, radius=radii)
    assert numpy.allclose(back, 0.025, rtol=1e-12)
    assert (back.name, back.attrs) == ("surface_energy", {"units": "J/m^2"})
    column = pandas.Series([0.1, 0.2], index=["a", "b"])
    assert jkroll.solve("P_c", material="quartz", radius=column * 1e-6).attrs == {}
    column.attrs["Units"] = "µm"
    forces = jkroll.solve("P_c", material="quartz", radius=column)
    assert (forces.tolist(), forces.attrs) == (approx(bare.tolist(), rel=1e-15), {"units": "N"})
    answers = jkroll.answer("P_c", material="quartz", radius=column)
    assert answers["P_c"].tolist() == forces.tolist()


def test_a_column_of_pint_pandas_is_read() -> None:
    pytest.importorskip("pint_pandas")
    radii = pandas.Series([100.0, 200.0], dtype="pint[nm]", index=["a", "b"])
    found = jkroll.solve("P_c", material="quartz", radius=radii)
    assert found["b"] == jkroll.solve("P_c", material="quartz", radius=2e-7)


@pytest.mark.parametrize(
    ("unit", "words"),
    [
        ("kg", "radius: 'kg' has the wrong dimension; give a value in m"),
        ("nmm", "radius: 'nmm'"),
        ("", "the wrong dimension"),
    ],
)
def test_a_wrong_or_unknown_unit_is_refused(unit: str, words: str) -> None:
    with pytest.raises(jkroll.JkrollError, match=words):
        jkroll.solve("P_c", material="quartz", radius=xarray.DataArray([1.0], attrs={"units": unit}))


def test_arrays_that_xarray_cannot_align_are_refused() -> None:
    energies, radii = xarray.DataArray([0.1, 0.2], dims="x"), xarray.DataArray([1e-7, 2e-7, 3e-7], dims="x")
    with pytest.raises(jkroll.JkrollError, match="do not broadcast"):
        jkroll.solve("P_c", gamma=energies, radius=radii)
    with xarray.set_options(arithmetic_join="exact"), pytest.raises(jkroll.JkrollError, match="different indexes"):
        jkroll.solve("P_c", gamma=energies.assign_coords(x=[1, 2]), radius=energies.assign_coords(x=[2, 3]))
