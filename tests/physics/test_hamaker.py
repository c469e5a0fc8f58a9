"""A Hamaker constant instead of a surface energy."""

import math
from itertools import product
from typing import Any

import numpy as np
import pytest

from jkroll import solve
from jkroll.errors import BadRequest
from jkroll.model.reasons import MissingInput
from scenes import QUARTZ

ELASTIC: dict[str, Any] = {name: value for name, value in QUARTZ.items() if name != "surface_energy"}
SILICA: dict[str, Any] = {**ELASTIC, "hamaker": 6.5e-20}


def test_work_and_spacing_from_the_hamaker_constant_of_silica() -> None:
    """The work is 63.3 mJ/m² and z0 0.143 nm; with a cutoff of 0.4 nm, the work is 10.8 mJ/m²."""
    work, spacing = solve(["work_of_adhesion", "atomic_spacing"], **SILICA).values()
    assert round(1e3 * work, 1) == 63.3
    assert round(1e9 * spacing, 3) == 0.143
    assert round(1e3 * solve("work_of_adhesion", cutoff=4e-10, **SILICA), 1) == 10.8


def test_the_3_9_law_with_this_work_and_spacing_has_the_hamaker_constant() -> None:
    """The integral of σ(h) = (8w/3z0)[(z0/h)³ − (z0/h)⁹] is w, and far away σ is A/(6πh³)."""
    work, spacing = solve(["work_of_adhesion", "atomic_spacing"], **SILICA).values()
    h = np.geomspace(spacing, 1e4 * spacing, 200_001)
    traction = 8 * work / (3 * spacing) * ((spacing / h) ** 3 - (spacing / h) ** 9)
    assert math.isclose(np.trapezoid(traction, h), work, rel_tol=1e-6)
    assert math.isclose(traction[-1] * h[-1] ** 3 * 6 * math.pi, SILICA["hamaker"], rel_tol=1e-12)


def test_other_results_use_the_work_and_spacing_of_the_constant() -> None:
    work, spacing = solve(["work_of_adhesion", "atomic_spacing"], **SILICA).values()
    names = ["pull_off_force", "tabor_parameter", "sticking_energy"]
    for model in ("jkr", "maugis"):
        known = {**ELASTIC, "work_of_adhesion": work, "atomic_spacing": spacing}
        assert solve(names, model=model, **SILICA) == solve(names, model=model, **known)
    assert solve("tabor_parameter", atomic_spacing=4e-10, **SILICA) < solve("tabor_parameter", **SILICA)


def test_the_constant_of_two_solids_is_the_geometric_mean() -> None:
    """A12 = √(A1A2); another material does not take the constant of the first."""
    both = solve("work_of_adhesion", hamaker2=4 * 6.5e-20, **SILICA)
    assert math.isclose(both, 2 * solve("work_of_adhesion", **SILICA), rel_tol=1e-15)
    with pytest.raises(MissingInput, match="Hamaker constant of sphere 2; give --hamaker2"):
        solve("pull_off_force", material2="iron", **SILICA)
    with pytest.raises(MissingInput, match="Hamaker constant; give --hamaker "):
        solve("pull_off_force", hamaker2=1e-19, **ELASTIC)


def test_a_hamaker_constant_excludes_a_given_surface_energy_but_not_a_material_s() -> None:
    for name, constant in product(("surface_energy", "surface_energy2", "work_of_adhesion"), ("hamaker", "hamaker2")):
        with pytest.raises(BadRequest, match=f"{name}.* and {constant} exclude each other"):
            solve("pull_off_force", **{**ELASTIC, name: 0.1, constant: 6.5e-20})
    with pytest.raises(MissingInput, match="Hamaker constant; give --hamaker "):
        solve("pull_off_force", material="quartz", radius=1e-7, hamaker2=1e-19)
    assert solve("work_of_adhesion", material="quartz", hamaker=6.5e-20) == solve("work_of_adhesion", **SILICA)
