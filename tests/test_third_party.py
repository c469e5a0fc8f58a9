"""The numbers of jkroll compared with programs of other authors: LAMMPS, tamaas and Adhesion.

LAMMPS moves two spheres by Newton's laws, time step after time step; tamaas finds the pressure that deforms an elastic
surface in a prescribed way; Adhesion has its own formulas of JKR. Tests of a program that is not installed are
skipped, and fail in CI.
"""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

import jkroll
from jkroll.physics import cylinder
from third_party import (
    IRON,
    QUARTZ,
    Body,
    Spheres,
    both,
    import_jkr,
    import_lammps,
    import_tamaas,
    pressure,
    pressure_at_load,
    rolling_frequencies,
    solid,
    surface,
)

pytestmark = pytest.mark.slow

# The largest relative differences.
FORCE_CURVE = 4e-12  # relative to P_c, or to the load if it is larger
CONTACT_RADIUS = 7e-13
STIFFNESS = 4e-8
NO_SLIP = 1e-5  # about δ0/R1, since the contact of LAMMPS lies δ/2 below the surface; and 1e-6 by slip
ROLLING_TO_REST = 2e-4
MOMENT_OF_CIRCLE = 4e-4
MOMENT_OF_STRIP = 1e-3
TORSION = 4e-4
ADHESIVE_SPHERE = 0.03  # by the finite range of the attraction, and by the periodic images of the sphere
JKR_RELATIONS = 4e-14

GRAIN: Body = {**QUARTZ, "radius": 1e-7}
PAIRS: Mapping[str, tuple[Body, Body]] = {
    "quartz-quartz": (GRAIN, GRAIN),
    "quartz-iron": (GRAIN, {**IRON, "radius": 3e-7}),
}

lammps = pytest.fixture(import_lammps, scope="module", name="lammps")
tamaas = pytest.fixture(import_tamaas, scope="module", name="tamaas")
jkr = pytest.fixture(import_jkr, scope="module", name="jkr")


@pytest.fixture(params=PAIRS)
def pair(request: pytest.FixtureRequest) -> tuple[Body, Body]:
    return PAIRS[request.param]


@pytest.fixture
def scene(pair: tuple[Body, Body]) -> dict[str, Any]:
    return both(*pair)


@pytest.fixture
def spheres(lammps: Any, pair: tuple[Body, Body]) -> Spheres:
    return Spheres(lammps, *pair)


# --- LAMMPS: the contact ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("ratio", [10.0, 1.0, 0.0, -0.3, -8 / 9, -0.95, -0.9999])
def test_lammps_has_the_same_force_curve(spheres: Spheres, scene: Mapping[str, Any], ratio: float) -> None:
    pull_off = jkroll.solve("pull_off_force", **scene)
    approach = jkroll.solve("approach_at_load", load=ratio * pull_off, **scene)
    assert abs(spheres.force(approach) / pull_off - ratio) < FORCE_CURVE * max(1.0, ratio)


@pytest.mark.parametrize("ratio", [1.0, 0.0, -0.5, -0.9])
def test_lammps_has_the_same_contact_radius(
    lammps: Any, pair: tuple[Body, Body], scene: Mapping[str, Any], ratio: float
) -> None:
    """With a coefficient of 1/(m s), viscoelastic damping exerts the force amv; at this speed v, far more than P_c."""
    spheres = Spheres(lammps, *pair, damping=(1.0, "viscoelastic"))
    load = ratio * jkroll.solve("pull_off_force", **scene)
    names = ("approach_at_load", "contact_radius_at_load", "reduced_mass")
    approach, radius, mass = jkroll.solve(names, load=load, **scene).values()
    at_rest = spheres.force(approach)
    spheres.v[0, 2] = -1e20
    assert math.isclose((spheres.force(approach) - at_rest) / (1e20 * mass), radius, rel_tol=CONTACT_RADIUS)


@pytest.mark.parametrize("ratio", [1.0, 0.0, -0.5])
def test_lammps_has_the_same_stiffness(spheres: Spheres, scene: Mapping[str, Any], ratio: float) -> None:
    """The stiffness is found from four forces around the load, with an error of fourth order."""
    load = ratio * jkroll.solve("pull_off_force", **scene)
    approach, stiffness, step = jkroll.solve(("approach_at_load", "stiffness", "approach"), load=load, **scene).values()
    step *= 1e-3
    near, far = (spheres.force(approach + h) - spheres.force(approach - h) for h in (step, 2 * step))
    assert math.isclose((8 * near - far) / (12 * step), stiffness, rel_tol=STIFFNESS)


# --- LAMMPS: vibrations and rolling -----------------------------------------------------------------------------------


LARGE: Body = {**QUARTZ, "radius": 1e-3}  # δ0/R1 is then at most 7e-6
OTHERS: Mapping[str, Body] = {
    "100:60": {**QUARTZ, "radius": 6e-4},
    "2:1": {**QUARTZ, "radius": 5e-4},
    "10:1": {**QUARTZ, "radius": 1e-4},
    "1:3": {**QUARTZ, "radius": 3e-3},
    "2:1 on iron": {**IRON, "radius": 5e-4},
}


@pytest.mark.parametrize("held", [False, True], ids=["free", "held"])
@pytest.mark.parametrize("other", OTHERS)
def test_lammps_has_the_same_rolling_frequency_without_slip(lammps: Any, other: str, held: bool) -> None:
    """Eq (40) does not hold if the centres move."""
    measured, eq_40, no_slip = rolling_frequencies(lammps, LARGE, OTHERS[other], held=held)
    assert math.isclose(measured, no_slip, rel_tol=NO_SLIP)
    assert not math.isclose(measured, eq_40, rel_tol=0.1)


@pytest.mark.parametrize("slips", [False, True], ids=["no slip", "free to slide"])
def test_a_sphere_in_lammps_rests_after_the_same_number_of_turns(lammps: Any, slips: bool) -> None:
    """Eq (48) is for a sphere that is free to slide and spins with 2/7 of W0; without slip, the energy balance holds.

    The friction is the mean rolling moment: μ·2P_c·R = ⟨M⟩. The springs are stiff, so that the contact yields at once,
    and 20 time steps per vertical vibration resolve them. Sphere 2 is held.
    """
    grain: Body = {**QUARTZ, "radius": 1e-5}
    energy = 0.1 * jkroll.solve("adhesion_energy", **grain)
    names = ("pull_off_force", "reduced_radius", "approach", "stiffness", "mean_rolling_moment", "moment_of_inertia")
    pull_off, radius, approach, stiffness, moment, inertia = jkroll.solve(names, **grain).values()
    tangential = "linear_nohistory 0 0" if slips else f"linear_history {stiffness} 0 1e9"
    rolling = f"sds {stiffness / 10} 0 {moment / (2 * pull_off * radius)}"
    spheres = Spheres(lammps, grain, grain, f"tangential {tangential} rolling {rolling}")
    spheres.force(approach)
    initial = jkroll.FORMULAS["initial_angular_speed"](energy=energy, moment_of_inertia=inertia)
    spheres.omega[0, 1], spheres.v[0, 0] = initial, initial * grain["radius"]
    step = 1 / (20 * jkroll.solve("vertical_frequency", **grain))
    spheres.release(step, held=True)

    spins = [initial]
    while spins[-1] > 0:
        assert len(spins) < 10000
        spheres.run(10)
        spins.append(spheres.spin())
    until_last = sum(spins[:-1]) - (spins[0] + spins[-2]) / 2  # by the trapezoidal rule, then a triangle
    turns = 10 * step / (2 * math.pi) * (until_last + spins[-2] / 2 * spins[-2] / (spins[-2] - spins[-1]))

    eq_48, balance = jkroll.solve(("n_roll", "n_roll_energy_balance"), energy=energy, **grain).values()
    assert math.isclose(turns, eq_48 if slips else balance, rel_tol=ROLLING_TO_REST)
    assert not math.isclose(turns, balance if slips else eq_48, rel_tol=0.5)


# --- tamaas -----------------------------------------------------------------------------------------------------------


def disc(a: float, cells: int) -> tuple[Any, Any, Any, float]:
    """Return x and y of cells, whether each cell is in a circle, which has the area πa², and the size of a cell."""
    centres = np.arange(cells) + 0.5 - cells / 2
    x, y = np.meshgrid(centres, centres, indexing="ij")
    inside = x**2 + y**2 <= (cells / 2.2) ** 2
    cell = a * math.sqrt(math.pi / np.count_nonzero(inside))
    return x * cell, y * cell, inside, cell


@pytest.mark.parametrize("ratio", [0.0, 1.0, -0.9])
def test_tamaas_has_the_same_moment_of_a_shifted_circle(tamaas: Any, ratio: float) -> None:
    """Eq (25): in a circle of the contact radius at the load, whose centre lags by ξ, the surface fits the sphere.

    The circle has the area of its cells; the error that this leaves is proportional to the size of the cells.
    """
    xi = 2e-10
    load = ratio * jkroll.solve("pull_off_force", **GRAIN)
    names = ("yield_moment", "contact_radius_at_load", "reduced_radius", "contact_modulus")
    expected, a, radius, modulus = jkroll.solve(names, load=load, yield_displacement=xi, **GRAIN).values()
    moments = []
    for cells in (64, 128):
        x, y, inside, cell = disc(a, cells)
        sphere = -((x - xi) ** 2 + y**2) / (2 * radius)
        displacement = surface(tamaas, modulus, cells * cell, inside.shape)
        found = pressure_at_load(displacement, inside, sphere, load / cell**2)
        moments.append(np.sum((x - xi) * found) * cell**2)
    assert math.isclose(2 * moments[1] - moments[0], expected, rel_tol=MOMENT_OF_CIRCLE)


def test_tamaas_has_the_same_torsional_stiffness(tamaas: Any) -> None:
    """A circle of the surface turns by φ about its centre: u = φ(−y, x), and there is no other displacement.

    The tractions have no divergence. Each component therefore displaces the surface by 1/(2πGr), as a pressure does for
    E* = 2G.
    """
    names = ("twisting_stiffness", "contact_radius_at_load")
    expected, a = jkroll.solve(names, **GRAIN).values()
    shear = QUARTZ["youngs_modulus"] / (2 * (1 + QUARTZ["poisson_ratio"]))
    stiffnesses = []
    for cells in (64, 128):
        _, y, inside, cell = disc(a, cells)
        found = pressure(surface(tamaas, 2 * shear, cells * cell, inside.shape), inside, y)
        stiffnesses.append(2 * np.sum(y * found) * cell**2 / 2)  # both components, for two solids in series
    assert math.isclose(2 * stiffnesses[1] - stiffnesses[0], expected, rel_tol=TORSION)


@pytest.mark.parametrize("load_constant", [0.5, 0.0, -0.7])
def test_tamaas_has_the_same_moments_of_a_shifted_strip(tamaas: Any, load_constant: float) -> None:
    """Eqs (68) and (70), the latter with −2C, in units of a and E′. C = 1/2 is a contact without adhesion.

    The error is proportional to the size of the cells. That of the periodic repetition is (πa/period)²/6 = 1e-4.
    """
    xi, period = 0.05, 128.0
    solids = {"cylinder_radius": 100.0, "plane_strain_modulus": 1.0}
    load = float(cylinder.load_per_length(load_constant=load_constant, **solids))
    moments = []
    for cells in (4096, 8192):
        cell = period / cells
        x = (np.arange(cells) + 0.5 - cells / 2) * cell
        inside, shape = np.abs(x) < 1, -((x - xi) ** 2) / (2 * solids["cylinder_radius"])
        found = pressure_at_load(surface(tamaas, 1.0, period, inside.shape), inside, shape, load / cell)
        moments.append([np.sum(arm * found) * cell for arm in (x, x - xi)])
    about_centre, about_contact_point = 2 * np.array(moments[1]) - np.array(moments[0])
    strip = cylinder.strip_moment(contact_half_width=1.0, yield_displacement=xi, **solids)
    expected = cylinder.contact_point_moment(
        contact_half_width=1.0, yield_displacement=xi, load_constant=load_constant, **solids
    )
    assert math.isclose(about_centre, strip, rel_tol=MOMENT_OF_STRIP)
    assert math.isclose(about_contact_point, expected, rel_tol=MOMENT_OF_STRIP, abs_tol=MOMENT_OF_STRIP * strip)


def test_tamaas_has_the_same_pull_off_force(tamaas: Any) -> None:
    """P_c of JKR is the largest tension at ranges of attraction of 0.8 and 0.4 δ0, extrapolated to a range of 0.

    By DMT, P_c is 4/3 as large. Units are a0 and E*, so that w = 2/(9πR²), and R is 10.
    """
    radius, size, cells = 10.0, 5.0, 96
    work = 2 / (9 * math.pi * radius**2)
    given: dict[str, Any] = {"work_of_adhesion": work, "radius": radius, "radius2": math.inf, "contact_modulus": 1.0}
    pull_off, approach = jkroll.solve(("pull_off_force", "approach"), **given).values()
    x, y = np.meshgrid(*[(np.arange(cells) - cells / 2) * size / cells] * 2, indexing="ij")
    sphere = -(x**2 + y**2) / (2 * radius)
    tensions = []
    for distance in (0.8 * approach, 0.4 * approach):
        model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [size, size], [cells, cells])
        model.E, model.nu = 1.0, 0.0
        attraction = tamaas.ExponentialAdhesionFunctional(sphere)
        attraction.parameters = {"rho": distance, "surface_energy": work}
        gap = tamaas.PolonskyKeerRey.gap
        solver = tamaas.PolonskyKeerRey(model, sphere, 1e-6, gap, gap)
        solver.addFunctionalTerm(attraction)
        forces = []
        for at in np.linspace(-0.45, 0.15, 9):
            solver.solve(-sphere.mean() - at * approach)
            forces.append(model.traction.sum() * (size / cells) ** 2)
        assert 0 < np.argmin(forces) < len(forces) - 1
        tensions.append(-min(forces))
    assert math.isclose(2 * tensions[1] - tensions[0], pull_off, rel_tol=ADHESIVE_SPHERE)


# --- Adhesion ---------------------------------------------------------------------------------------------------------


def test_the_package_adhesion_has_the_same_contact_without_load(jkr: Any, scene: Mapping[str, Any]) -> None:
    """Eqs (2) and (3)."""
    radius, approach = jkroll.solve(("contact_radius", "approach"), **scene).values()
    assert math.isclose(jkr.contact_radius(force=0.0, **solid(scene)), radius, rel_tol=JKR_RELATIONS)
    assert math.isclose(jkr.penetration(force=0.0, **solid(scene)), approach, rel_tol=JKR_RELATIONS)


@pytest.mark.parametrize("ratio", [100.0, 1.0, 0.0, -0.5, -8 / 9, -0.99, -1.0])
def test_the_package_adhesion_has_the_same_contact_under_load(jkr: Any, scene: Mapping[str, Any], ratio: float) -> None:
    """Eqs (5) and (6) at the contact radius; as differences, these may have the rounding errors of P_c and δ0."""
    pull_off, unloaded = jkroll.solve(("pull_off_force", "approach"), **scene).values()
    names = ("contact_radius_at_load", "approach_at_load")
    radius, approach = jkroll.solve(names, load=ratio * pull_off, **scene).values()
    force, penetration = (relation(contact_radius=radius, **solid(scene)) for relation in (jkr.force, jkr.penetration))
    assert abs(force / pull_off - ratio) < JKR_RELATIONS * max(1.0, ratio)
    assert abs(penetration - approach) < JKR_RELATIONS * max(unloaded, approach)


@pytest.mark.parametrize("ratio", [1.0, 0.0, -0.9])
def test_the_package_adhesion_has_the_same_pressure(jkr: Any, scene: Mapping[str, Any], ratio: float) -> None:
    """Eq (12). In Adhesion, tension is positive."""
    load = ratio * jkroll.solve("pull_off_force", **scene)
    names = ("contact_radius_at_load", "hertz_pressure", "boussinesq_pressure")
    parts = jkroll.solve(names, load=load, **scene)
    radius = parts["contact_radius_at_load"]
    distance = np.linspace(0.01, 0.99, 50) * radius
    found = -jkr.stress_distribution(distance, contact_radius=radius, **solid(scene))
    expected = jkroll.FORMULAS["pressure"](distance=distance, **parts)
    assert np.all(np.abs(found - expected) < JKR_RELATIONS * np.maximum(parts["hertz_pressure"], np.abs(expected)))
