"""Lists of materials and laws, and units of other packages, in `solve`; a warning on radii of metres in `answer`."""

from typing import Any

import numpy
import pint
import pytest

import jkroll
from jkroll.quantities.nomenclature import NOMENCLATURE
from relative import approx

Quantity: Any = pint.application_registry.Quantity
SOLIDS, RADII, LAWS = ["quartz", "iron", "quartz"], [1e-7, 2e-7, 3e-7], ["jkr", "dmt", "maugis"]


def row_by_row(wanted: str, **lists: Any) -> list[Any]:
    return [jkroll.solve(wanted, **dict(zip(lists, row, strict=True))) for row in zip(*lists.values(), strict=True)]


@pytest.mark.parametrize("wanted", ["P_c", "a0", "n_grav", "yield_force"])
def test_each_element_has_its_material_and_its_law(wanted: str) -> None:
    found = jkroll.solve(wanted, material=SOLIDS, radius=RADII, model=LAWS)
    assert found.tolist() == approx(row_by_row(wanted, material=SOLIDS, radius=RADII, model=LAWS), rel=1e-15)


def test_lists_broadcast_with_arrays() -> None:
    found = jkroll.solve("P_c", material=["quartz", "iron"], radius=numpy.array(RADII)[:, None])
    assert found.shape == (3, 2)
    for row, radius in enumerate(RADII):
        for column, solid in enumerate(["quartz", "iron"]):
            assert found[row, column] == jkroll.solve("P_c", material=solid, radius=radius)


def test_lists_of_material_objects_and_of_names_form_pairs() -> None:
    solids = [jkroll.known_materials()[name] for name in SOLIDS]
    found = jkroll.solve(["P_c", "w"], material=solids, material2=[*SOLIDS[1:], SOLIDS[0]], radius=1e-7)
    others = row_by_row("P_c", material=SOLIDS, material2=[*SOLIDS[1:], SOLIDS[0]], radius=[1e-7] * 3)
    assert found["pull_off_force"].tolist() == approx(others, rel=1e-15)
    assert found["work_of_adhesion"].shape == (3,)


def test_elements_without_a_result_are_nan() -> None:
    found = jkroll.solve("contact_radius_at_load", material=["quartz", "iron"], radius=1e-7, load=-1e-7)
    assert numpy.isnan(found).tolist() == [True, False]


def test_lists_of_materials_are_refused_with_a_reason() -> None:
    with pytest.raises(jkroll.JkrollError, match="do not broadcast: material"):
        jkroll.solve("P_c", material=SOLIDS, radius=[1e-7, 2e-7])
    with pytest.raises(jkroll.JkrollError, match="for a single scene only"):
        jkroll.solve("P_c", material=SOLIDS, radius=1e-7, gamma="25±5 mJ/m2")
    with pytest.raises(jkroll.JkrollError, match="no material 'quarz'"):
        jkroll.solve("P_c", material=["iron", "quarz"], radius=1e-7)


def test_columns_of_pandas_are_aligned_by_their_index() -> None:
    pandas = pytest.importorskip("pandas")
    data = pandas.DataFrame({"material": SOLIDS, "radius": RADII})
    assert jkroll.solve("P_c", **data).tolist() == row_by_row("P_c", material=SOLIDS, radius=RADII)
    turned = jkroll.solve("P_c", material=data["material"], radius=data["radius"][::-1])
    assert turned.to_dict() == jkroll.solve("P_c", **data).to_dict()


def test_results_have_the_labels_of_pandas() -> None:
    pandas = pytest.importorskip("pandas")
    data = pandas.DataFrame({"material": SOLIDS, "radius": RADII}, index=["a", "b", "c"])
    for forces in (jkroll.solve("P_c", **data), jkroll.solve("P_c", material="quartz", radius=data["radius"])):
        assert forces.index.equals(data.index)
        assert forces.name == "pull_off_force"
        assert forces["a"] == jkroll.solve("P_c", material="quartz", radius=1e-7)
    again = jkroll.solve("contact_radius_at_load", material="quartz", radius=data["radius"], load=-forces / 2)
    assert again.index.equals(data.index)
    same_for_all_radii = jkroll.solve("yield_force", material="quartz", radius=data["radius"])
    assert isinstance(same_for_all_radii, float)


def test_results_have_the_dimensions_of_xarray() -> None:
    xarray = pytest.importorskip("xarray")
    radii = xarray.DataArray([RADII, RADII], dims=("row", "size"), coords={"size": ["a", "b", "c"]}, name="radius")
    forces = jkroll.solve("P_c", material="quartz", radius=radii)
    assert forces.name == "pull_off_force"
    assert forces.sel(size="b").values.tolist() == [jkroll.solve("P_c", material="quartz", radius=2e-7)] * 2
    assert jkroll.solve("a", material="quartz", radius=radii, load=-forces / 2).dims == ("row", "size")


def test_results_are_returned_as_quantities_of_pint() -> None:
    bare = jkroll.solve("P_c", material="quartz", radius=1e-7)
    found = jkroll.solve("P_c", material="quartz", radius=1e-7, units="pint")
    assert found == Quantity(bare, "N")
    both = jkroll.solve(["P_c", "n_grav"], material=SOLIDS, radius=Quantity(100, "nm"))
    assert both["pull_off_force"].check("[force]")
    assert both["n_grav"].dimensionless


def test_quantities_of_astropy_are_accepted_and_returned() -> None:
    units = pytest.importorskip("astropy.units")
    found = jkroll.solve("P_c", gamma=25 * units.mJ / units.m**2, radius=[100, 200] * units.nm)
    forces = [jkroll.solve("P_c", gamma=0.025, radius=radius) for radius in (1e-7, 2e-7)]
    assert found.to_value("N").tolist() == approx(forces)
    assert jkroll.solve("n_grav", material="quartz", radius=1e-7, units="astropy").unit == units.dimensionless_unscaled
    force = jkroll.formulas.pull_off_force(work_of_adhesion=50 * units.mJ / units.m**2, reduced_radius=5e-8)
    assert isinstance(force, units.Quantity)
    assert force.unit == units.N
    with pytest.raises(jkroll.JkrollError, match="has the wrong dimension; give a value in m"):
        jkroll.solve("P_c", material="quartz", radius=1 * units.kg)


def test_astropy_knows_every_unit() -> None:
    units = pytest.importorskip("astropy.units")
    for unit in {quantity.unit for quantity in NOMENCLATURE.values()}:
        units.Unit(unit)


def test_units_of_another_package_are_refused() -> None:
    with pytest.raises(jkroll.JkrollError, match="'unyt' is not known; write pint or astropy"):
        jkroll.solve("P_c", material="quartz", radius=1e-7, units="unyt")


@pytest.mark.parametrize(("word", "number"), [("radius", 100), ("diameter", 1.0)])
def test_a_bare_radius_of_a_metre_has_a_warning(word: str, number: float) -> None:
    answer: Any = jkroll.answer
    with pytest.warns(UserWarning, match=f'{word}={number} is a sphere of {number:g} m.*write {word}="{number} nm"'):
        answer("P_c", gamma=0.025, **{word: number})
    answer("P_c", gamma=0.025, **{word: f"{number} m"})  # meant in metres
    jkroll.answer("P_c", gamma=0.025, radius=1e-7, radius2=1e3)  # sphere 2 may be a nearly flat lens
