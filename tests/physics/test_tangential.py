"""Sliding, twisting and peeling: the frequency of twisting, and Griffith's criterion by energy differences."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from jkroll import solve
from jkroll.model.reasons import Failure, NotInLaw
from scenes import OTHER, QUARTZ

PAIR: dict[str, Any] = {**QUARTZ, **OTHER}
TANGENTIAL = [
    "shear_strength", "sliding_force", "sliding_displacement", "sliding_energy", "twisting_stiffness",
    "twisting_moment",
    "twisting_angle", "twisting_energy", "twisting_frequency", "peeling_force", "peeling_radius",
    "peeling_over_sliding",
    "sliding_or_peeling_force", "rolling_over_sliding",
]  # fmt: skip

OF_ANY_LAW = ("twisting_stiffness", "twisting_frequency")  # they follow from the contact radius by any law


# --- Twisting ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("radius2", [1e-7, 3e-7, math.inf])
def test_twisting_frequency_is_an_eigenvalue(radius2: float) -> None:
    """Two spheres turn about the line of centres with the spring k_t (θ1 − θ2)²/2; a plane does not move."""
    scene = {**PAIR, "radius2": radius2}
    names = ["twisting_stiffness", "moment_of_inertia", "moment_of_inertia2", "twisting_frequency"]
    stiffness, *inertia, frequency = solve(names, **scene).values()
    moving = [each for each in inertia if math.isfinite(each)]
    direction = np.array([1.0, -1.0][: len(moving)])
    matrix = stiffness * np.outer(direction, direction) / np.sqrt(np.outer(moving, moving))
    highest = math.sqrt(float(np.linalg.eigvalsh(matrix)[-1])) / (2 * math.pi)
    assert math.isclose(frequency, highest, rel_tol=1e-12)


# --- Peeling: energies of the contact at a load and a tangential force, as functions of its radius --------------------


def energy(a: Any, load: float, force: Any, scene: dict[str, float]) -> Any:
    """Return the energy of a contact of radius a under dead loads: of the solids, of both loads and of the surfaces.

    At a fixed radius a and an approach δ, Hertz' contact and a flat punch together have the elastic energy
    E*(δ²a − 2δa³/(3R) + a⁵/(5R²)). Its derivative by δ is the load. The tangential spring is 8G*a.
    """
    radius, modulus, shear = scene["reduced_radius"], scene["contact_modulus"], scene["contact_shear_modulus"]
    approach = load / (2 * modulus * a) + a**2 / (3 * radius)
    elastic = modulus * (approach**2 * a - 2 / 3 * approach * a**3 / radius + a**5 / (5 * radius**2))
    return elastic - load * approach - force**2 / (16 * shear * a) - scene["work_of_adhesion"] * math.pi * a**2


def force_at(a: Any, load: float, scene: dict[str, float]) -> Any:
    """Return the tangential force at which a contact of radius a is in equilibrium: ∂energy/∂a = 0, by differences."""
    step = 1e-4 * a

    def slope(force: float) -> Any:
        near, far = (energy(a + h, load, force, scene) - energy(a - h, load, force, scene) for h in (step, 2 * step))
        return (8 * near - far) / (12 * step)

    unit = scene["pull_off_force"]
    free = slope(0.0)
    return unit * np.sqrt(-free / (slope(unit) - free))


def largest(function: Callable[[Any], Any], low: float, high: float) -> tuple[float, float]:
    """Return the position and the value of a maximum, from a parabola fitted to the points around the largest."""
    x = np.linspace(low, high, 4001)
    y = function(x)
    best = int(np.nanargmax(y))
    curve = np.polyfit(x[best - 20 : best + 21] - x[best], y[best - 20 : best + 21] / y[best], 2)
    shift = -curve[1] / (2 * curve[0])
    return float(x[best] + shift), float(y[best] * np.polyval(curve, shift))


@pytest.mark.parametrize("scene", [QUARTZ, {**QUARTZ, **OTHER}, {**QUARTZ, "radius2": math.inf}])
@pytest.mark.parametrize("ratio", [-0.9, -0.5, 0.0, 2.0])
def test_the_contact_peels_where_no_radius_is_an_equilibrium(scene: dict[str, Any], ratio: float) -> None:
    names = [
        "reduced_radius", "contact_modulus", "contact_shear_modulus", "work_of_adhesion", "pull_off_force",
        "contact_radius_at_load", "peeling_force", "peeling_radius",
    ]  # fmt: skip
    load = ratio * solve("pull_off_force", **scene)
    found = solve(names, load=load, **scene)
    a = found["contact_radius_at_load"]
    with np.errstate(invalid="ignore"):  # nan at a radius without an equilibrium
        at, force = largest(lambda radius: force_at(radius, load, found), 0.3 * a, a)
    assert math.isclose(force, found["peeling_force"], rel_tol=1e-7)
    assert math.isclose(at, found["peeling_radius"], rel_tol=1e-4)


@pytest.mark.parametrize("radius", [1e-9, 1e-7, 1.7e-7])
@pytest.mark.parametrize("ratio", [-0.5, 0.0, 1.0])
def test_a_brittle_contact_slides_where_the_force_reaches_the_strength_of_its_area(radius: float, ratio: float) -> None:
    """Bisection finds the radius at which the force of the equilibria crosses πa²τ."""
    scene: dict[str, Any] = {**QUARTZ, "radius": radius}
    scene["load"] = ratio * solve("pull_off_force", **scene)
    names = [
        "reduced_radius", "contact_modulus", "contact_shear_modulus", "work_of_adhesion", "pull_off_force",
        "peeling_radius",
        "contact_radius_at_load", "shear_strength", "peeling_over_sliding", "sliding_or_peeling_force",
    ]  # fmt: skip
    found = solve(names, **scene)
    low, high = found["peeling_radius"], found["contact_radius_at_load"]
    if found["peeling_over_sliding"] < 1:
        assert found["sliding_or_peeling_force"] == solve("peeling_force", **scene)
        return
    for _ in range(50):
        middle = (low + high) / 2
        is_below = force_at(middle, scene["load"], found) < math.pi * middle**2 * found["shear_strength"]
        low, high = (low, middle) if is_below else (middle, high)
    assert math.isclose(math.pi * low**2 * found["shear_strength"], found["sliding_or_peeling_force"], rel_tol=1e-6)


# --- Missing results --------------------------------------------------------------------------------------------------


def test_beyond_pull_off_nothing_peels_at_a_fixed_load() -> None:
    force, approach = solve(["pull_off_force", "approach"], **QUARTZ).values()
    assert solve("peeling_force", load=-force, **QUARTZ) == 0
    for name in ("peeling_force", "peeling_radius"):
        with pytest.raises(Failure, match="only fixed grips hold"):
            solve(name, approach_at_load=-0.8 * approach, **QUARTZ)
    beyond = solve("peeling_force", approach_at_load=np.array([-0.8, 0.5]) * approach, **QUARTZ)
    assert np.isnan(beyond).tolist() == [True, False]


@pytest.mark.parametrize("model", ["maugis", "dmt"])
@pytest.mark.parametrize("name", [name for name in TANGENTIAL if name not in ("shear_strength", *OF_ANY_LAW)])
def test_other_laws_have_no_sliding_twisting_or_peeling(model: str, name: str) -> None:
    with pytest.raises(NotInLaw, match="give --model jkr"):
        solve(name, model=model, **QUARTZ)


@pytest.mark.parametrize("name", ["shear_strength", "sliding_force", "tangential_stiffness"])
def test_two_rigid_bodies_have_no_tangential_results(name: str) -> None:
    with pytest.raises(Failure, match="both bodies are rigid"):
        solve(name, **{**QUARTZ, "youngs_modulus": math.inf})
