"""Aggregates: energies and their speeds, limits of strengths, and the constants of public codes."""

import math
from typing import Any

import pytest

from jkroll import solve
from jkroll.model.reasons import MissingInput
from jkroll.quantities.values import QuantityError
from jkroll.report.questions import QUESTIONS
from maugis_reference import mpf
from reference import ulp_error
from scenes import QUARTZ

AGGREGATE: dict[str, Any] = {**QUARTZ, "monomers": 1000, "filling_factor": 0.1}
SPEEDS = [name for name in QUESTIONS["aggregates"].quantities if "speed" in name]


@pytest.mark.parametrize("name", SPEEDS)
def test_two_aggregates_that_collide_at_a_speed_have_the_corresponding_energy(name: str) -> None:
    """In the frame of their centre of mass, each aggregate has half the speed."""
    speed, energy, mass = solve([name, name.replace("speed", "energy"), "mass"], **AGGREGATE).values()
    assert math.isclose(2 * (1000 * mass / 2 * (speed / 2) ** 2), energy, rel_tol=1e-14)


def test_the_number_of_contacts_is_the_number_of_grains_by_default() -> None:
    for name in ("disruption_energy", "disruption_speed_dust_simulation"):
        assert solve(name, **AGGREGATE) == solve(name, contacts=1000, **AGGREGATE)
    assert solve("disruption_energy", contacts=3, **QUARTZ) < solve("disruption_energy", monomers=4, **QUARTZ)
    with pytest.raises(MissingInput, match="give --monomers 1000"):
        solve("disruption_energy", **QUARTZ)


def test_compressive_strength_grows_as_the_cube_of_a_small_filling_factor() -> None:
    """The strength tends to E_roll φ³/r0³ for loose aggregates, and diverges at the closest packing."""
    half_turn = solve("roll_energy_half_turn", **QUARTZ)
    loose = solve("compressive_strength", filling_factor=1e-6, **QUARTZ)
    assert math.isclose(loose, half_turn * 1e-18 / 1e-21, rel_tol=1e-5)
    assert solve("compressive_strength", filling_factor=0.7399999, **QUARTZ) > 1e18 * loose
    for phi in (0.0, 0.74, 0.8, 1.0):
        with pytest.raises(QuantityError, match=r"must lie between 0 and 0.74"):
            solve("compressive_strength", filling_factor=phi, **QUARTZ)


def test_strengths_agree_with_the_code_phantom() -> None:
    """porosity.f90 has E_roll = 302.456 (γ⁵r0⁴/E²)^(1/3), and a packing of 0.74048 instead of 0.74."""
    gamma, radius, modulus, phi = 0.2, 1e-6, 72e9, 0.1
    eroll = 302.455974078 * (gamma**5 * radius**4 / modulus**2) ** (1 / 3)
    pressure = eroll / ((1 / phi - 1 / 0.74048) * radius) ** 3
    # This is E_roll of Dominik & Tielens for 90 degrees, with 2γ instead of γ, E* = E/2 and ξ = δ_c.
    scene: dict[str, Any] = {"surface_energy": 2 * gamma, "radius": radius, "contact_modulus": modulus / 2}
    fold, pull_off = solve(["fold_energy", "pull_off_force"], **scene).values()
    quarter, half = solve(
        ["roll_energy_quarter_turn", "roll_energy_half_turn"], yield_displacement=fold / pull_off, **scene
    ).values()
    assert math.isclose(quarter, eroll, rel_tol=1e-8)
    own = solve("compressive_strength", yield_displacement=fold / pull_off, filling_factor=phi, **scene)
    assert math.isclose(own / pressure, half / quarter, rel_tol=4e-4)
    tension = solve("tensile_strength", surface_energy=gamma, radius=radius, filling_factor=phi)
    assert math.isclose(tension, 0.6 * phi**1.8 * gamma / radius, rel_tol=1e-14)


@pytest.mark.parametrize("below", [1e-2, 1e-4, 1e-8, 1e-12])
def test_near_the_closest_packing_the_strength_has_full_precision(below: float) -> None:
    """0.74 is not a double, and its rounding matters in a small difference 0.74 − φ."""
    phi = 0.74 - below
    values = solve(["compressive_strength", "roll_energy_half_turn"], **{**AGGREGATE, "filling_factor": phi})
    exact = mpf(values["roll_energy_half_turn"]) / mpf(1e-7) ** 3 / (1 / mpf(phi) - 1 / mpf("0.74")) ** 3
    assert ulp_error(values["compressive_strength"], exact) < 8
