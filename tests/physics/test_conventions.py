"""Energies and speeds by convention, with the factors printed with them; modes of sliding, and the time step."""

import math
import re
from typing import Any

import numpy as np
import pytest

from harness import Run
from jkroll import FORMULAS, NOMENCLATURE, solve
from jkroll.errors import JkrollError
from jkroll.report.questions import QUESTIONS
from jkroll.write.sources import docstring_fields
from relative import approx

GRAIN: dict[str, Any] = {
    "surface_energy": 0.025, "youngs_modulus": 54e9, "poisson_ratio": 0.17, "density": 2600.0, "radius": 1e-7
}  # fmt: skip
PAIR: dict[str, Any] = {**GRAIN, "radius2": 3e-7, "surface_energy2": 3.0, "youngs_modulus2": 2e11, "density2": 7700.0}


MODULUS, RADIUS = 54e9 / (2 * (1 - 0.17**2)), 5e-8  # E* and R of two such grains
A0 = (9 * math.pi * 0.025 * RADIUS**2 / MODULUS) ** (1 / 3)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        # 3πγR times a0²/(2·6^(1/3)R), as in Lumajord/DustSimulation
        ("fold_energy", 3 * math.pi * 0.025 * RADIUS * 0.5 * A0**2 / (RADIUS * 6 ** (1 / 3))),
        ("sticking_speed_paszun_dominik", 1.07 * (0.025 / RADIUS) ** (5 / 6) / (MODULUS ** (1 / 3) * 2600.0**0.5)),
        # twice 9.6; the coefficient of the speed above is √(2·9.6·3/(16π)) = 1.07, which lacks this factor of 2
        ("sticking_energy_pencil_code", 2 * 9.6 * 0.025 ** (5 / 3) * RADIUS ** (4 / 3) / MODULUS ** (2 / 3)),
        # with the reduced radius, and with the radius of a grain
        ("roll_energy_quarter_turn", 6 * math.pi**2 * 0.025 * RADIUS * 2e-10),
        ("roll_energy_half_turn", 6 * math.pi**2 * 0.025 * 1e-7 * 2e-10),
    ],
)
def test_an_energy_or_a_speed_is_that_of_its_authors(name: str, value: float) -> None:
    assert math.isclose(solve(name, **GRAIN), value, rel_tol=1e-14)


FACTOR = re.compile(r"(\d+\.\d+|6/5) (P_cδ0|F_cδ_c)")


@pytest.mark.parametrize("name", [name for name in NOMENCLATURE if FACTOR.search(NOMENCLATURE[name].definition)])
def test_factors_in_definitions_are_those_of_the_values(name: str) -> None:
    """A factor before P_cδ0 or F_cδ_c is the value over this energy, rounded to the printed places."""
    units = {"P_cδ0": solve("adhesion_energy", **PAIR), "F_cδ_c": solve("fold_energy", **PAIR)}
    value = solve(name, **PAIR)
    for factor, unit in FACTOR.findall(NOMENCLATURE[name].definition):
        if factor == "6/5":
            assert math.isclose(value / units[unit], 1.2, rel_tol=1e-14)
        else:
            places = len(factor.partition(".")[2])
            assert f"{value / units[unit]:.{places}f}" == factor


def test_thornton_and_ning_print_the_exact_sticking_energy() -> None:
    """Their Γ is w, P_c = 3/2 πΓR, α_f = 3/4 (π²Γ²R/E*²)^(1/3) and W_s = 7.09 (Γ⁵R⁴/E*²)^(1/3).

    Their sticking speed V_s has 14.18 = 2·7.09.
    """
    names = ["work_of_adhesion", "reduced_radius", "contact_modulus", "reduced_mass", "fold_energy"]
    w, radius, modulus, mass, fold_energy = solve(names, **PAIR).values()
    pull_off, fold = 1.5 * math.pi * w * radius, 0.75 * (math.pi**2 * w**2 * radius / modulus**2) ** (1 / 3)
    assert math.isclose(fold_energy, pull_off * fold, rel_tol=1e-14)
    energy = solve("sticking_energy", **PAIR)
    assert math.isclose(energy, 7.09 * (w**5 * radius**4 / modulus**2) ** (1 / 3), rel_tol=5e-4)
    speed = math.sqrt(14.18 / mass) * (w**5 * radius**4 / modulus**2) ** (1 / 6)
    assert math.isclose(solve("sticking_speed", **PAIR), speed, rel_tol=5e-4)


@pytest.mark.parametrize("scene", [GRAIN, PAIR])
def test_rolling_energy_is_the_moment_times_the_angle(scene: dict[str, Any]) -> None:
    names = ["unloaded_moment", "roll_energy_quarter_turn", "roll_energy_half_turn"]
    moment, quarter, half = solve(names, **scene).values()
    assert math.isclose(solve("roll_energy", rolling_angle="90 deg", **scene), quarter, rel_tol=1e-14)
    assert math.isclose(solve("roll_energy", rolling_angle="180 deg", **scene), half, rel_tol=1e-14)
    assert math.isclose(half, math.pi * moment, rel_tol=1e-14)
    with pytest.raises(JkrollError, match="needs turn of sphere 1"):
        solve("roll_energy", **scene)


def test_every_energy_speed_and_strength_has_a_definition_and_a_source() -> None:
    for name in (*QUESTIONS["energies"].quantities, *QUESTIONS["aggregates"].quantities):
        if name.endswith("lennard_jones"):  # defined by a fit
            continue
        quantity = NOMENCLATURE[name]
        fields = docstring_fields(FORMULAS[name]) if name in FORMULAS else {}
        assert quantity.definition or fields.get("Source"), name
        assert quantity.equation or quantity.reference or fields.get("Source"), name


# --- Sliding ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("radius2", [1e-7, 3e-7, math.inf])
def test_sliding_frequency_is_an_eigenvalue(radius2: float) -> None:
    """Two spheres have the motions x1, x2, θ1, θ2, and their spring has the energy k_s (x1 − R1θ1 − x2 − R2θ2)²/2."""
    scene = {**PAIR, "radius2": radius2}
    stiffness, mass, mass2 = solve(["tangential_stiffness", "mass", "mass2"], **scene).values()
    spheres = np.array([(1.0, 1e-7, mass), (-1.0, radius2, mass2)])  # direction, radius, mass
    signs, radii, masses = spheres[np.isfinite(spheres).all(axis=1)].T  # a plane does not move
    direction = np.concatenate([signs, -radii])
    inertia = np.concatenate([masses, 0.4 * masses * radii**2])
    matrix = stiffness * np.outer(direction, direction) / np.sqrt(np.outer(inertia, inertia))
    highest = math.sqrt(float(np.linalg.eigvalsh(matrix)[-1])) / (2 * math.pi)
    assert math.isclose(solve("sliding_frequency", **scene), highest, rel_tol=1e-12)


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


@pytest.mark.parametrize(
    ("scene", "step"),
    [
        # 1/(20 f_slide), t_R/5
        ({"radius": 1e-8}, 1.8816679933550200e-12),  # 1.88, 2.33 ps
        ({"radius": 1e-7}, 2.3321264448659369e-11),  # 27.6, 23.3 ps
        ({"radius": 1e-7, "youngs_modulus": 54e7}, 1.2819654804729837e-10),  # 128, 233 ps
        ({"radius": 1e-7, "radius2": 5e-8}, 1.1660632224329685e-11),  # t_R of the smaller sphere
        ({"radius": 5e-8, "radius2": 1e-7}, 1.1660632224329685e-11),
        ({"radius": 1e-7, "radius2": math.inf}, 2.3321264448659369e-11),  # t_R of the sphere
    ],
)
def test_the_time_step_is_the_shorter_of_two_rules(scene: dict[str, Any], step: float) -> None:
    """The rules are a twentieth of the period of sliding with rotation, and a fifth of the Rayleigh time."""
    assert solve("time_step", material="quartz", **scene) == approx(step, rel=1e-10)
    several = solve("time_step", material="quartz", **{**scene, "radius": np.array([scene["radius"], 1e-5])})
    assert several[0] == approx(step, rel=1e-10)


def test_for_a_rigid_sphere_the_contact_sets_the_time_step() -> None:
    scene = {**GRAIN, "youngs_modulus": math.inf, "youngs_modulus2": 3e3, "poisson_ratio2": 0.5, "radius2": math.inf}
    frequency, step = solve(["sliding_frequency", "time_step"], **scene).values()
    assert step == approx(1 / (20 * frequency), rel=1e-14)


def test_the_time_step_is_stable_for_many_contacts() -> None:
    """In a close-packed lattice a grain has 12 contacts; the step is below Verlet's limit, 2/ω of the fastest mode."""
    for radius in (1e-9, 1e-7, 1e-5):
        slide, step = solve(["sliding_frequency", "time_step"], **{**GRAIN, "radius": radius}).values()
        for contacts in (12, 40):
            assert step < 2 / (math.sqrt(contacts) * 2 * math.pi * slide)


def test_an_explanation_states_the_measured_energy_of_a_convention(run: Run) -> None:
    assert "E_break of SiO2: for spheres of 1.9 µm diameter" in run("energies quartz 100nm --explain").out


@pytest.mark.parametrize("grain", ["iron 1um", "polystyrene 1um", "quartz 1um --material2 iron"])
def test_measurements_on_silica_are_not_mentioned_for_other_solids(run: Run, grain: str) -> None:
    assert "SiO2" not in run(f"energies {grain} --explain --quantities v_stick,E_break").out
