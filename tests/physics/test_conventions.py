"""Energies and speeds by convention: the factors that are printed beside them, from the curve of JKR itself."""

import math
import re
from typing import Any

import numpy as np
import pytest

import jkroll
from harness import Run
from jkroll import NOMENCLATURE, solve
from jkroll.answers.questions import QUESTIONS
from jkroll.errors import JkrollError
from relative import approx

GRAIN: dict[str, Any] = {
    "surface_energy": 0.025, "youngs_modulus": 54e9, "poisson_ratio": 0.17, "density": 2600.0, "radius": 1e-7
}  # fmt: skip
PAIR: dict[str, Any] = {**GRAIN, "radius2": 3e-7, "surface_energy2": 3.0, "youngs_modulus2": 2e11, "density2": 7700.0}


def work(start: float, end: float) -> float:
    """Return the work from a contact radius to another, in P_cδ0: the trapezoidal rule on Eqs 5 and 6 as printed."""
    a = np.linspace(start, end, 400_001)
    load, approach = 4 * (a**3 - a**1.5), 3 * a**2 - 2 * np.sqrt(a)
    return float(np.sum((load[1:] + load[:-1]) / 2 * np.diff(approach)))


FOLD, PULL_OFF, JUMP_IN = (1 / 6) ** (2 / 3), (1 / 4) ** (1 / 3), (2 / 3) ** (2 / 3)  # â
INTEGRALS = {
    "well_energy": -work(0.0, 1.0),
    "pull_off_work": work(1.0, FOLD),
    "pull_off_work_at_dead_load": work(1.0, PULL_OFF),
    "sticking_energy": work(JUMP_IN, FOLD),
}


@pytest.mark.parametrize("name", INTEGRALS)
def test_energies_are_areas_under_the_curve(name: str) -> None:
    unit, energy = solve(["adhesion_energy", name], **PAIR).values()
    assert math.isclose(energy / unit, INTEGRALS[name], rel_tol=1e-7)


FACTOR = re.compile(r"(\d+\.\d+|6/5) (P_cδ0|F_cδ_c)")


@pytest.mark.parametrize("name", [name for name in NOMENCLATURE if FACTOR.search(NOMENCLATURE[name].definition)])
def test_factors_are_those_of_the_values(name: str) -> None:
    """Each factor that a definition prints is the value in that unit, to half a unit of its last place."""
    units = {"P_cδ0": solve("adhesion_energy", **PAIR), "F_cδ_c": solve("fold_energy", **PAIR)}
    value = solve(name, **PAIR)
    for factor, unit in FACTOR.findall(NOMENCLATURE[name].definition):
        if factor == "6/5":
            assert math.isclose(value / units[unit], 1.2, rel_tol=1e-14)
        else:
            places = len(factor.partition(".")[2])
            assert f"{value / units[unit]:.{places}f}" == factor


def test_f_c_delta_c_is_the_product_that_codes_compute() -> None:
    """From a0 = (9πγR²/E*)^(1/3), F_c = 3πγR and δ_c = a0²/(2·6^(1/3)R), as they stand in Lumajord/DustSimulation."""
    radius, modulus = 5e-8, 54e9 / (2 * (1 - 0.17**2))
    a0 = (9 * math.pi * 0.025 * radius**2 / modulus) ** (1 / 3)
    delta_c = 0.5 * a0 * a0 / (radius * 6 ** (1 / 3))
    assert math.isclose(solve("fold_energy", **GRAIN), 3 * math.pi * 0.025 * radius * delta_c, rel_tol=1e-14)


def test_thornton_and_ning_print_the_exact_sticking_energy() -> None:
    """Γ is w, P_c = 3/2 πΓR, α_f = 3/4 (π²Γ²R/E*²)^(1/3), W_s = 7.09 (Γ⁵R⁴/E*²)^(1/3), and 14.18 = 2·7.09 in V_s."""
    names = ["work_of_adhesion", "reduced_radius", "contact_modulus", "reduced_mass", "fold_energy"]
    w, radius, modulus, mass, fold_energy = solve(names, **PAIR).values()
    pull_off, fold = 1.5 * math.pi * w * radius, 0.75 * (math.pi**2 * w**2 * radius / modulus**2) ** (1 / 3)
    assert math.isclose(fold_energy, pull_off * fold, rel_tol=1e-14)
    energy = solve("sticking_energy", **PAIR)
    assert math.isclose(energy, 7.09 * (w**5 * radius**4 / modulus**2) ** (1 / 3), rel_tol=5e-4)
    speed = math.sqrt(14.18 / mass) * (w**5 * radius**4 / modulus**2) ** (1 / 6)
    assert math.isclose(solve("sticking_speed", **PAIR), speed, rel_tol=5e-4)


def test_paszun_and_dominik_for_equal_spheres() -> None:
    modulus, radius = 54e9 / (2 * (1 - 0.17**2)), 5e-8
    speed = 1.07 * (0.025 / radius) ** (5 / 6) / (modulus ** (1 / 3) * 2600.0**0.5)
    assert math.isclose(solve("sticking_speed_paszun_dominik", **GRAIN), speed, rel_tol=1e-14)


def test_the_pencil_code_has_twice_9_6() -> None:
    """With one of the two factors 2 in √(2·2·9.6 …), its speed would be 1.0705 where Paszun & Dominik have 1.07."""
    modulus = 54e9 / (2 * (1 - 0.17**2))
    energy, speed = solve(["sticking_energy_pencil_code", "sticking_speed_pencil_code"], **GRAIN).values()
    assert math.isclose(energy, 2 * 9.6 * 0.025 ** (5 / 3) * 5e-8 ** (4 / 3) / modulus ** (2 / 3), rel_tol=1e-14)
    factor = speed / math.sqrt(2) / ((0.025 / 5e-8) ** (5 / 6) / (modulus ** (1 / 3) * 2600.0**0.5))
    assert math.isclose(factor, 1.0705, rel_tol=5e-5)


@pytest.mark.parametrize("scene", [GRAIN, PAIR])
def test_rolling_energy_is_the_moment_times_the_angle(scene: dict[str, Any]) -> None:
    names = ["unloaded_moment", "roll_energy_quarter_turn", "roll_energy_half_turn"]
    moment, quarter, half = solve(names, **scene).values()
    assert math.isclose(solve("roll_energy", rolling_angle="90 deg", **scene), quarter, rel_tol=1e-14)
    assert math.isclose(solve("roll_energy", rolling_angle="180 deg", **scene), half, rel_tol=1e-14)
    assert math.isclose(half, math.pi * moment, rel_tol=1e-14)
    with pytest.raises(JkrollError, match="needs turn of sphere 1"):
        solve("roll_energy", **scene)


def test_rolling_energies_as_codes_have_them() -> None:
    """6π²γRξ with the reduced radius, and 6π²γr0ξ with the radius of a grain."""
    quarter, half = solve(["roll_energy_quarter_turn", "roll_energy_half_turn"], **GRAIN).values()
    assert math.isclose(quarter, 6 * math.pi**2 * 0.025 * 5e-8 * 2e-10, rel_tol=1e-14)
    assert math.isclose(half, 6 * math.pi**2 * 0.025 * 1e-7 * 2e-10, rel_tol=1e-14)


def test_every_row_has_a_definition_and_a_source() -> None:
    for name in (*QUESTIONS["energies"].quantities, *QUESTIONS["aggregates"].quantities):
        quantity = NOMENCLATURE[name]
        assert quantity.definition, name
        assert quantity.equation or quantity.reference, name


# --- Sliding ----------------------------------------------------------------------------------------------------------


def test_shear_modulus_of_identical_solids() -> None:
    """8G* is 4G/(2 − ν), and over E* it is 4(1 − ν)/(2 − ν)."""
    modulus, shear = solve(["contact_modulus", "contact_shear_modulus"], **GRAIN).values()
    assert math.isclose(8 * shear, 4 * 54e9 / (2 * 1.17) / 1.83, rel_tol=1e-14)
    assert math.isclose(8 * shear / modulus, 4 * 0.83 / 1.83, rel_tol=1e-14)


def test_one_rigid_body() -> None:
    shear = jkroll.contact_shear_modulus(
        youngs_modulus=2.0, poisson_ratio=0.0, youngs_modulus2=math.inf, poisson_ratio2=0.3
    )
    assert shear == 0.5


@pytest.mark.parametrize("radius2", [1e-7, 3e-7, math.inf])
def test_sliding_frequency_is_an_eigenvalue(radius2: float) -> None:
    """Of two spheres with the motions x1, x2, θ1, θ2 and the spring k_s (x1 − R1θ1 − x2 − R2θ2)²/2."""
    scene = {**PAIR, "radius2": radius2}
    stiffness, mass, mass2 = solve(["tangential_stiffness", "mass", "mass2"], **scene).values()
    radii, masses = [1e-7, radius2], [mass, mass2]
    moving = [place for place in (0, 1) if math.isfinite(radii[place])]
    direction = np.array([*((1.0, -1.0)[place] for place in moving), *(-radii[place] for place in moving)])
    inertia = np.array(
        [*(masses[place] for place in moving), *(0.4 * masses[place] * radii[place] ** 2 for place in moving)]
    )
    matrix = stiffness * np.outer(direction, direction) / np.sqrt(np.outer(inertia, inertia))
    highest = math.sqrt(float(np.linalg.eigvalsh(matrix)[-1])) / (2 * math.pi)
    assert math.isclose(solve("sliding_frequency", **scene), highest, rel_tol=1e-12)
    assert math.isclose(solve("time_step", **scene), 1 / highest / 20, rel_tol=1e-12)


@pytest.mark.parametrize("poisson", [-0.9, 0.0, 0.17, 0.5])
@pytest.mark.parametrize("ratio", [-0.9, 0.0, 100.0])
def test_sliding_is_the_fastest_mode(poisson: float, ratio: float) -> None:
    scene = {**PAIR, "poisson_ratio": poisson, "poisson_ratio2": poisson}
    load = ratio * solve("pull_off_force", **scene)
    slide, *others = solve(
        ["sliding_frequency", "vertical_frequency", "rolling_frequency", "rolling_frequency_no_slip"],
        load=load,
        **scene,
    ).values()
    assert slide > 1.4 * max(others)


def test_the_time_step_is_stable_for_many_contacts() -> None:
    """Grains of a close-packed lattice have 12 contacts: its fastest mode stays below Verlet's limit of 2/ω."""
    slide, step = solve(["sliding_frequency", "time_step"], **GRAIN).values()
    for contacts in (12, 40):
        assert step < 2 / (math.sqrt(contacts) * 2 * math.pi * slide)


def test_speeds_are_told_to_be_low_with_values(run: Run) -> None:
    said = run("energies iron 100nm --explain").out.replace("\n ", "")
    found = re.search(r"gives ([\d.]+) m/s, of silica-dry ([\d.]+) m/s", said)
    assert found
    for number, material in zip(found.groups(), ("quartz", "silica-dry"), strict=True):
        speed = solve("sticking_speed", material=material, radius=2.5e-7, radius2=float("inf"))
        assert float(number) == approx(speed, rel=0.03)
