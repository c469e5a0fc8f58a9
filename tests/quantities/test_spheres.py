"""Quantities of one of the spheres, each with that of the other."""

import pytest

from jkroll import solve
from jkroll.materials.library import Material
from jkroll.quantities.nomenclature import NOMENCLATURE, of_sphere
from jkroll.quantities.values import QuantityError


def test_a_quantity_of_a_sphere_is_the_twin_of_its_twin() -> None:
    of_spheres = {name: quantity for name, quantity in NOMENCLATURE.items() if quantity.sphere}
    assert {"material", "radius2", "mass2", "hamaker"} <= of_spheres.keys()
    for name, quantity in of_spheres.items():
        twin = NOMENCLATURE[quantity.twin]
        assert (twin.twin, twin.sphere + quantity.sphere) == (name, 3)
        assert [of_sphere(sphere, name) for sphere in (quantity.sphere, twin.sphere)] == [name, quantity.twin]


def test_a_material_made_by_hand_has_properties_of_a_solid() -> None:
    material = Material("own", {"surface_energy": 0.1, "load": 1e-9}, (), {}, (), (), "", "")
    with pytest.raises(QuantityError, match="load: '1e-09' is not a property of a material"):
        solve("yield_force", radius=1e-7, material=material)
