"""The output of `jkroll export lammps`, run by LAMMPS."""

import math
from typing import Any

import pytest

import jkroll
from harness import Run
from third_party import IRON, QUARTZ, Body, Spheres, bisect, both, frequency, import_lammps

pytestmark = pytest.mark.slow

GRAIN: Body = {**QUARTZ, "radius": 1e-6}
PAIRS = {
    "quartz 1um": (GRAIN, GRAIN),
    "quartz 1um --radius2 3um": (GRAIN, {**GRAIN, "radius": 3e-6}),
    "quartz 1um --radius2 3um --material2 iron": (GRAIN, {**IRON, "radius": 3e-6}),
}

lammps = pytest.fixture(import_lammps, scope="module", name="lammps")


def exported(run: Run, lammps: Any, pair: str, *options: str) -> Spheres:
    """Return the spheres of a pair with the contact that the command prints."""
    ran = run(*f"export lammps {pair}".split(), *options)
    assert ran.code == 0
    assert ran.out.isascii()
    sphere, sphere2 = PAIRS[pair]
    if sphere is sphere2:
        ran = ran._replace(out=ran.out.replace("pair_coeff 1 1", "pair_coeff * *"))
    return Spheres(lammps, sphere, sphere2, contact=ran.out.splitlines())


def load_of(ratio: float, pair: str) -> float:
    """Return a multiple of the pull-off force of a pair."""
    return ratio * float(jkroll.solve("pull_off_force", **both(*PAIRS[pair])))


@pytest.mark.parametrize(("model", "wanted"), [("jkr", "pull_off_force"), ("dmt", "pull_off_force_dmt")])
def test_a_wall_pulls_off_and_rolls_like_a_plane(run: Run, lammps: Any, model: str, wanted: str) -> None:
    """The sphere is pulled off a plane of iron; in DMT the contact ends at zero overlap."""
    printed = run(*f"export lammps quartz 1um --radius2 plane --material2 iron --model {model}".split()).out
    scene = both(GRAIN, {**IRON, "radius": math.inf})
    force, approach = jkroll.solve((wanted, "approach"), **scene).values()
    spheres = Spheres(lammps, GRAIN, GRAIN, contact=printed.replace("pair_coeff 1 1", "pair_coeff * *").splitlines())
    spheres.code.command("set type 2 z -5e-6")

    def drawn(at: float) -> float:
        for overlap in (spheres.touching, at):
            spheres.x[0, 2] = spheres.radius - overlap
            spheres.run(1)
        return float(spheres.f[0, 2])

    least = -approach if model == "jkr" else 0.0
    letting_go = bisect(lambda at: drawn(at) == 0, least, spheres.touching)
    assert math.isclose(-drawn(letting_go), force, rel_tol=1e-5)
    expected = jkroll.solve("load", approach_at_load=approach, model=model, **scene)
    assert math.isclose(drawn(approach), expected, rel_tol=1e-6, abs_tol=1e-6 * force)
    if model == "jkr":  # it rolls by ξ/2, then to 2ξ, without slip
        spheres.code.command("timestep 1e-12")
        spheres.omega[0, 1] = 2e-10 / 100 / 1e-12 / spheres.radius
        spheres.v[0, 0] = spheres.omega[0, 1] * spheres.radius
        moment = jkroll.solve("yield_moment", **scene)
        for steps, part in ((50, 0.5), (150, 1.0)):
            spheres.run(steps)
            assert math.isclose(abs(spheres.torque[0, 1]), part * moment, rel_tol=0.03)


@pytest.mark.parametrize("pair", PAIRS)
def test_lammps_has_the_dmt_force(run: Run, lammps: Any, pair: str) -> None:
    spheres = exported(run, lammps, pair, "--model", "dmt")
    names = ("pull_off_force_dmt", "contact_modulus", "reduced_radius", "approach")
    pull_off, modulus, radius, approach = jkroll.solve(names, **both(*PAIRS[pair])).values()
    for delta in (1e-9 * approach, approach, 10 * approach):
        expected = 4 / 3 * modulus * math.sqrt(radius * delta**3) - pull_off
        assert math.isclose(spheres.force(delta), expected, rel_tol=1e-9)


@pytest.mark.parametrize("pair", PAIRS)
def test_lammps_has_the_vertical_frequency(run: Run, lammps: Any, pair: str) -> None:
    spheres = exported(run, lammps, pair)
    approach, expected = jkroll.solve(("approach", "vertical_frequency"), **both(*PAIRS[pair])).values()
    spheres.force(1.001 * approach)
    spheres.release(1 / expected / 2000)
    samples = []
    for _ in range(200):
        samples.append(spheres.distance() - spheres.radius - spheres.radius2 + approach)
        spheres.run(100)
    assert math.isclose(frequency(samples, 0.05 / expected), expected, rel_tol=1e-5)


@pytest.mark.parametrize("ratio", [0.0, 1.0, -0.5])
def test_lammps_has_the_rolling_frequency(run: Run, lammps: Any, ratio: float) -> None:
    """Identical spheres turn against each other, so that nothing slides; their centres keep their distance."""
    load = load_of(ratio, "quartz 1um")
    spheres = exported(run, lammps, "quartz 1um", f"--load={load}N")
    approach, expected = jkroll.solve(("approach_at_load", "rolling_frequency"), load=load, **GRAIN).values()
    spheres.force(approach)
    spheres.omega[:2, 1] = [1e-6 * expected, -1e-6 * expected]
    spheres.code.command("fix pressing all setforce NULL NULL 0")
    spheres.release(1 / expected / 2000)
    samples = []
    for _ in range(80):
        samples.append(spheres.spin())
        spheres.run(100)
    assert math.isclose(frequency(samples, 0.05 / expected), expected, rel_tol=1e-5)


@pytest.mark.parametrize("model", ["jkr", "dmt"])
@pytest.mark.parametrize("ratio", [0.0, 1.0, -0.5])
@pytest.mark.parametrize("pair", PAIRS)
def test_lammps_has_the_rolling_moment(run: Run, lammps: Any, pair: str, ratio: float, model: str) -> None:
    """The moment is proportional to the displacement of the contact up to the yield displacement, then constant.

    Both spheres turn in place, and their spins move both surfaces alike, so that nothing slides.
    """
    scene, load = both(*PAIRS[pair]), load_of(ratio, pair)
    names = ("approach_at_load", "yield_moment", "pull_off_force_dmt", "reduced_radius", "contact_modulus")
    approach, moment, dmt, radius, modulus = jkroll.solve(names, load=load, **scene).values()
    if model == "dmt":
        approach, moment = ((load + dmt) * 0.75 / modulus / math.sqrt(radius)) ** (2 / 3), dmt * 2e-10
    spheres = exported(run, lammps, pair, f"--load={load}N", "--model", model)
    steps, step = 100, 1e-12
    shift = 2e-10 / steps  # of the contact, per step
    spheres.force(approach)
    spheres.code.command(f"timestep {step}")
    spheres.omega[0, 1] = shift / step / spheres.radius
    spheres.omega[1, 1] = -shift / step / spheres.radius2
    before = abs(spheres.torque[0, 1])
    measured: list[float] = []
    for count in (steps // 2, steps // 2, steps):
        spheres.run(count)
        measured.append(abs(spheres.torque[0, 1]))
    half, full, beyond = measured
    assert before < 1e-9 * moment
    assert math.isclose(half, moment / 2, rel_tol=0.03)  # within a step
    assert math.isclose(full, moment, rel_tol=0.03)
    assert math.isclose(beyond, moment, rel_tol=1e-6)


@pytest.mark.parametrize("ratio", [0.0, 1.0, -0.5])
@pytest.mark.parametrize("pair", PAIRS)
def test_lammps_has_the_resistances_to_sliding_and_twisting(run: Run, lammps: Any, pair: str, ratio: float) -> None:
    """The sideways force, or the moment about the line of centres, is linear up to a threshold, then constant."""
    scene, load = both(*PAIRS[pair]), load_of(ratio, pair)
    names = (
        "approach_at_load", "tangential_stiffness", "sliding_displacement", "sliding_force", "twisting_stiffness",
        "twisting_angle", "twisting_moment",
    )  # fmt: skip
    approach, k_s, shift, force, k_t, angle, moment = jkroll.solve(names, load=load, **scene).values()
    steps, step = 100, 1e-12
    for limit, threshold, stiffness in ((shift, force, k_s), (angle, moment, k_t)):
        spheres = exported(run, lammps, pair, f"--load={load}N")
        spheres.force(approach)
        spheres.code.command(f"timestep {step}")
        slides = limit == shift
        measured: list[float] = []
        if slides:
            spheres.v[0, 0] = limit / steps / step
        else:
            spheres.omega[0, 2] = limit / steps / step
        for count in (steps // 2, 2 * steps):
            spheres.run(count)
            measured.append(abs(float(spheres.f[0, 0] if slides else spheres.torque[0, 2])))
        half, beyond = measured
        assert math.isclose(half, stiffness * limit / 2, rel_tol=0.03)  # within a step
        assert math.isclose(beyond, threshold, rel_tol=1e-6)


def test_the_fastest_mode_is_resolved_by_the_time_step(run: Run, lammps: Any) -> None:
    """Two spheres slide against each other and turn in the same sense.

    Their lever arm is R in jkroll and R − δ0/2 in LAMMPS, so the frequencies differ a little.
    """
    pair = "quartz 1um"
    printed = run(*f"export lammps {pair}".split()).out
    step = float(next(line for line in printed.splitlines() if line.startswith("timestep")).split()[1])
    spheres = exported(run, lammps, pair)
    approach, fastest = jkroll.solve(["approach", "sliding_frequency"], **GRAIN).values()
    assert step <= 1 / (20 * fastest)
    spheres.force(approach)
    speed = 1e-5 * approach / step
    spheres.v[:2, 0] = [speed, -speed]
    spheres.omega[:2, 1] = -2.5 * speed / spheres.radius
    spheres.release(step / 10)
    samples = []
    for _ in range(400):
        samples.append(float(spheres.v[0, 0] - spheres.v[1, 0]))
        spheres.run(20)
    assert math.isclose(frequency(samples, 2 * step), fastest, rel_tol=1e-3)


@pytest.mark.parametrize("model", ["jkr", "dmt"])
def test_collisions_create_no_energy(run: Run, lammps: Any, model: str) -> None:
    """A gas of beads collides again and again from all directions; friction takes energy, and nothing adds any."""
    bead = "silica-humid 50um --gamma 0.2122mJ/m2 --young 725MPa --xi 10nm"
    ran = run(*f"export lammps {bead} --quiet".split(), "--model", model)
    commands = [line for line in ran.out.splitlines() if not line.startswith("#")]
    side, speed = 6e-4, 0.1
    code = lammps.lammps(cmdargs=["-log", "none", "-screen", "none", "-nocite"])
    code.commands_list(
        [
            "units si",
            "atom_style sphere",
            "boundary p p p",
            "comm_modify vel yes",
            f"region box block 0 {side} 0 {side} 0 {side}",
            "create_box 1 box",
            "lattice sc 1.2e-4",
            "create_atoms 1 box",
            "set type 1 diameter 1e-4 density 2203",
            *commands,
            *(f"variable v{axis} atom {speed}*normal(0,1,{seed})" for seed, axis in enumerate("xyz", 1)),
            "velocity all set v_vx v_vy v_vz",
            "fix moving all nve/sphere",
            "compute turning all erotate/sphere",
            "compute moving all ke",
            "thermo_style custom step c_moving c_turning",
        ]
    )
    energies = []
    for _ in range(4):
        code.command("run 15000 post no")
        energies.append(sum(code.extract_compute(name, 0, 0) for name in ("moving", "turning")))
    assert energies == sorted(energies, reverse=True)
    code.close()


# --- The printed lines, unchanged -------------------------------------------------------------------------------------


class Grains:
    """A sphere that touches z = 0 from above, and perhaps a second one from below, in LAMMPS with printed lines."""

    def __init__(self, lammps: Any, printed: str, radii: list[float], overlap: float, density: float = 2600.0) -> None:
        size = 5 * max(radii)
        self.code = lammps.lammps(cmdargs=["-log", "none", "-screen", "none", "-nocite"])
        box = f"region box block -{size} {size} -{size} {size} -{size} {size}"
        self.code.commands_list(
            ["units si", "atom_style sphere", "atom_modify map array sort 0 0", "boundary f f f", box]
        )
        types = len(set(radii))
        self.code.command(f"create_box {types} box")
        heights = [radii[0] - overlap, *(-radius for radius in radii[1:])]
        for kind, height in enumerate(heights, 1):
            self.code.command(f"create_atoms {min(kind, types)} single 0 0 {height}")
        for kind in range(1, types + 1):
            self.code.command(f"set type {kind} diameter {2 * radii[kind - 1]} density {density}")
        self.code.commands_string(printed)

    def tension_when_drawn(self, distance: float, steps: int, step: float) -> float:
        """Pull sphere 1 upwards, and return the largest tension on it.

        The lists of neighbours are rebuilt as in a user's run, since some versions of LAMMPS broke contacts then.
        """
        self.code.commands_list(
            [
                f"timestep {step}",
                "group drawn id 1",
                f"fix drawing drawn move linear 0 0 {distance / steps / step}",
                "run 0",
            ]
        )
        least = 0.0
        for _ in range(steps // 10):
            self.code.command("run 10 pre no post no")
            least = min(least, float(self.code.numpy.extract_atom("f")[0, 2]))
        self.code.close()
        return -least


@pytest.mark.parametrize(
    ("words", "radii"),
    [
        ("quartz 10nm", [1e-8, 1e-8]),
        ("quartz 100nm", [1e-7, 1e-7]),
        ("quartz 10um", [1e-5, 1e-5]),
        ("quartz 1mm", [1e-3, 1e-3]),
        ("quartz 100nm --radius2 1um", [1e-7, 1e-6]),
        ("quartz 100nm --radius2 plane", [1e-7]),
        ("quartz 100nm --young 1MPa", [1e-7, 1e-7]),  # a0 and δ0 are both 1.5 R1
    ],
)
def test_printed_lines_run_unchanged_with_the_right_pull_off_force(
    run: Run, lammps: Any, words: str, radii: list[float]
) -> None:
    """The largest tension on a grain that is pulled away is the pull-off force."""
    printed = run(*f"export lammps {words}".split()).out
    values = run(*f"report {words} --quantities pull_off_force,approach --bare".split()).out
    pull_off, approach = map(float, values.split())
    grains = Grains(lammps, printed, radii, approach / 2)
    tension = grains.tension_when_drawn(1.2 * approach, 2000, 1e-3 * approach)
    assert math.isclose(tension, pull_off, rel_tol=1e-4)


@pytest.mark.parametrize(("speed", "restitution"), [(0.69, 0.0), (0.8, None), (2.0, None)])
def test_a_collision_loses_the_energy_that_the_manual_states(
    run: Run, lammps: Any, speed: float, restitution: float | None
) -> None:
    """LAMMPS lets go at the largest tension, where a collision has lost less than at the fold.

    The speeds are multiples of v_stick.
    """
    printed = run(*"export lammps quartz 1um".split()).out
    names = ("sticking_speed", "sticking_energy", "adhesion_energy", "sliding_frequency")
    sticking, energy, unit, fastest = jkroll.solve(names, **GRAIN).values()
    if restitution is None:
        restitution = math.sqrt(1 - 0.3814 * unit / (energy * speed**2))
    grains = Grains(lammps, printed, [1e-6, 1e-6], -1e-14)
    code = grains.code
    code.commands_list([f"timestep {1 / (2000 * fastest)}", "group upper id 1", "group lower id 2"])
    for group, sign in (("upper", -1), ("lower", 1)):
        code.command(f"velocity {group} set 0 0 {sign * speed * sticking / 2}")
    code.command("fix moving all nve/sphere")
    code.command("run 60000 post no")
    v = code.numpy.extract_atom("v")
    separation = code.numpy.extract_atom("x")[0, 2] - code.numpy.extract_atom("x")[1, 2]
    leaving = float(v[0, 2] - v[1, 2]) / (speed * sticking) if separation > 2.001e-6 else 0.0
    code.close()
    assert math.isclose(leaving, restitution, rel_tol=5e-3, abs_tol=1e-9)  # the time step is finite
