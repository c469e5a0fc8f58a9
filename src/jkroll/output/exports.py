"""Contacts as input of other programs: LAMMPS, LIGGGHTS, DustCollider and DustSimulation, in SI or cgs units.

LAMMPS has them as `granular` with rolling resistance, in SI units, and takes γ = w/2. Only E* of the elastic constants
enters its normal force: they are written as E = 2E*, ν = 0, which also mixes as E* does. Its rolling friction is a
spring F = k ξ with the cap μ|P + 2P_po|, and the torque FR; k does not depend on the load. The caps of sliding and
twisting are such, too: a force, and a moment where μ is a length. A plane is a wall, whose coefficients mean the same.
The skin of its neighbor lists is 1 mm in SI units if none is given, and with grains of 100 nm it refuses that. Comments
are ASCII, as LAMMPS warns of other characters.

LIGGGHTS has the pull-off force of JKR with Hertz' contact, in SI units, for two spheres or a sphere and a wall.
DustCollider takes the material of grains in SI units, and their radii elsewhere.
DustSimulation takes a material and a radius in cgs units, for identical spheres; its thresholds are those of this
program.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from math import pi
from typing import NamedTuple

from ..errors import BadRequest
from ..physics.motion import ALL_STICK
from ..quantities.formatting import Format, amount, significant
from ..quantities.laws import DEFAULT_LAW
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, PROPERTIES, STATE, STATE_OR_LOAD, of_sphere
from ..scene.failures import OF_IDENTICAL_SPHERES, TWO_RIGID_BODIES, Failure, MissingInput
from ..scene.scene import Scene

SKIN = 0.2  # of the neighbor lists, in radii of the smaller sphere
LEAST_SKIN = 0.4  # in δ0: as far as spheres in contact may be apart where the tension is largest
NO_SLIP = 1e9  # a coefficient of friction with which nothing slips, where a law does not say at which force it does

QUANTITIES = ("yield_moment", "pull_off_force", "rolling_stiffness", "tangential_stiffness", "time_step")
THRESHOLDS = ("sliding_force", "twisting_stiffness", "twisting_moment")  # of JKR

# Comments of an input of LAMMPS: of every law, and of each.
_REMARKS = """\
# Legend, SI units. {law}: 2E* [Pa], damping 0, Poisson's ratio 0, gamma per surface [J/m^2].
# tangential mindlin_rescale: 8G* [Pa], damping 0, coefficient of friction [1]{friction}.
# Without _rescale, the spring of sliding gives energy to spheres that collide.
# rolling sds: stiffness [N/m], damping 0, coefficient M/(R(P + 2P_c)) [1], M the moment at which it rolls.
# E = 2E*, nu = 0: only E* enters the normal force. The tangential constant is 8G*, Mindlin's for these solids.
# neighbor: the skin [m] is a fifth of the smallest radius, and at least 0.4 delta0. With less, LAMMPS 22Jul2025 without
# its updates lets JKR contacts go before the pull-off force. These lines were run with 22Jul2025 update 4.
# The time step is a twentieth of the period of sliding with rotation, stable up to 40 contacts a sphere, at this P.
# A harder impact is stiffer: for its time step give its largest force as --load.
# Damping is left out. No damping coeff_restitution here: with adhesion it gives nan (LAMMPS issue 4180).
"""
_REMARKS_ON = {
    "jkr": """\
# twisting sds: stiffness [N m], damping 0, coefficient M_twist/(P + 2P_c) [m]. timestep in s.
# LAMMPS lets go at the pull-off force, 3 pi gamma R; jkroll's curve goes on to where fixed grips let go. So a
# collision loses 0.3814 P_c delta0 in LAMMPS, for 0.7722 here: its grains stick only below 0.7028 v_stick.
# LAMMPS has one stiffness of rolling and twisting for all loads, and thresholds linear in P: jkroll's at the P above.
# It slides at pi a^2 tau, twists at (2/3) pi a^3 tau, tau = {shear_strength:.6g} Pa{place}; a contact may peel before.
# The friction is adhesion's at the P above, and LAMMPS multiplies it with every load: where contacts are pushed
# harder, give their --load, or write your solid's coefficient of friction.
""",
    "dmt": """\
# P_c is 4 pi gamma R here. timestep in s.
# The force is (4/3) E* sqrt(R delta^3) - 4 pi gamma R while the spheres touch; jkroll's JKR has another contact radius.
# The rolling moment is 4 pi gamma R xi at any load; LAMMPS has a yield force linear in P, right at the P above.
# The contact does not slip: for the 1e9, write your coefficient of friction. Twisting is left out.
""",
}
_REMARKS_LIGGGHTS = """\
# m1: Pa, of each type; m2: 1; m3: k in J/m^3, of the types 1 1, or 1 1, 1 2, 2 1, 2 2. Lengths in m, forces in N.
# coefficientRestitution and coefficientFriction are yours to give; there is no resistance to rolling or twisting.
# k holds for these radii: it goes as R^(-1/3). With cohesion sjkr, two spheres take twice this k, and a wall this.
# Only the pull-off is JKR's: without overlap there is no force; contact radius, stiffness and overlap are others.
"""


def lammps_input(scene: Scene) -> Iterator[str]:
    """Iterate over the lines of an input: coefficients of pairs of types or a wall, a time step, what they stand on."""
    thresholds = (*THRESHOLDS, "shear_strength") if scene.law.is_default else ()
    names = (*QUANTITIES, *thresholds, "contact_shear_modulus", "density", "density2")
    whole = {name: scene[name] for name in names}
    model = scene.law.name
    work, lag, load = scene["work_of_adhesion"], scene["yield_displacement"], scene["load"]
    grains = _grains(scene)
    pairs = {f"pair_coeff {grain} {grain} {{}}": pair for grain, pair in grains.items()}
    bodies, place = "two spheres", ""
    if _is_at_wall(scene):
        bodies, place = "a sphere and a plane", " at the wall, which is put at z = 0"
        pairs["fix wall all wall/gran granular {} zplane 0 NULL"] = scene
    elif not scene.is_identical:
        place = " for types 1 and 2"
        pairs["pair_coeff 1 2 {}"] = scene
    yield f"# Contact of {bodies} by jkroll: {model.upper()}, gamma = w/2"
    yield f"# w = {work:.12g} J/m^2, xi = {lag:.12g} m, P = {load:.12g} N{place}"
    if len(pairs) > 1:
        at_rest = "Like spheres touch without load. " if load else ""
        yield f"# {at_rest}The time step is the shortest of all pairs."
    yield "# units si"
    for grain, pair in grains.items():
        yield f"# set type {grain} diameter {2 * pair['radius']:.12g} density {pair['density']:.12g}"
    yield "comm_modify vel yes"
    yield f"neighbor {_skin(scene, pairs.values()):.12g} bin"
    yield "pair_style granular"
    steps = []
    for command, pair in pairs.items():
        try:
            yield command.format(_coefficients(pair))
            steps.append(pair["time_step"])
        except MissingInput as error:
            yield f"# {command.partition(' {')[0]} {error.reason()}"
        except Failure as error:
            if error.kind != TWO_RIGID_BODIES:
                raise
            yield f"# {command.partition(' {')[0]}: {error}"
    yield f"timestep {min(steps):.12g}"
    yield from _rayleigh(grains.values())
    friction = " F_slide/(P + 2P_c)" if scene.law.is_default else ""
    yield from _REMARKS.format(law=model, friction=friction).splitlines()
    yield from _REMARKS_ON[model].format(**whole, place=place).splitlines()


def _rayleigh(grains: Iterable[Scene]) -> Iterator[str]:
    """Iterate over the comment on the other time step in use, a fifth of the shortest Rayleigh time."""
    times = [time for grain in grains for time in grain.numbers("rayleigh_time").values()]
    if times:
        yield (
            f"# A fifth of the Rayleigh time, which needs no load, is {min(times) / 5:.3g} s: take the shorter of the "
            "two where grains collide."
        )


def _skin(scene: Scene, pairs: Iterable[Scene]) -> float:
    """Return how far beyond touching the neighbor lists reach, in m."""
    smallest = min(scene["radius"], scene.values.get("radius2", INFINITY))
    approaches = (approach for pair in pairs for approach in pair.numbers("approach").values())
    return float(max(SKIN * smallest, *(LEAST_SKIN * approach for approach in approaches)))


def _is_at_wall(scene: Scene) -> bool:
    return bool(scene.values.get("radius2") == INFINITY)


def _grains(scene: Scene) -> dict[int, Scene]:
    """Return the pair of two grains of each type, by its number: of a sphere and a plane, there is one type."""
    if scene.is_identical:
        return {1: scene}
    return {sphere: pair_of(scene, sphere) for sphere in ((1,) if _is_at_wall(scene) else (1, 2))}


def pair_of(scene: Scene, sphere: int) -> Scene:
    """Return the pair of two spheres like sphere 1, or like sphere 2, without load."""
    stated = {name: value for name, value in scene.stated_of_1.items() if name not in STATE_OR_LOAD}
    of_2 = {of_sphere(1, name): value for name, value in scene.stated.items() if NOMENCLATURE[name].sphere == 2}
    if sphere == 1:
        return Scene(stated, scene.material, model=scene.law.name)
    if scene.material2 is not None:
        stated = {name: value for name, value in stated.items() if name not in PROPERTIES}
    return Scene({**stated, **of_2}, scene.material2 or scene.material, model=scene.law.name)


def _coefficients(pair: Scene) -> str:
    """Return the words and numbers that describe a contact in `pair_coeff` and `fix wall/gran`."""
    slip = pair["sliding_friction_coefficient"] if pair.law.is_default else NO_SLIP
    numbers: dict[str, tuple[float, ...]] = {
        pair.law.name: (2 * pair["contact_modulus"], 0, 0, pair["work_of_adhesion"] / 2),
        "tangential mindlin_rescale": (8 * pair["contact_shear_modulus"], 0, slip),
        "rolling sds": (pair["rolling_spring_constant"], 0, pair["rolling_friction_coefficient"]),
    }
    if pair.law.is_default:
        numbers["twisting sds"] = (pair["twisting_stiffness"], 0, pair["twisting_friction_coefficient"])
    return " ".join(" ".join((word, *(f"{number:.12g}" for number in values))) for word, values in numbers.items())


# --- DustSimulation and LIGGGHTS --------------------------------------------------------------------------------------

_DAMPING = ("1e-06", "1.25e-11")
_ABOUT_DUST_SIMULATION = (
    "the lines are version, name, R1 [cm], density [g/cm³], γ per surface [mJ/m²], Poisson's ratio, Young's modulus "
    "[dyn/cm²], ξ [cm], damping factor, viscous time [s], and the modifiers of rolling, sliding and twisting; "
    f"damping factor {_DAMPING[0]} and viscous time {_DAMPING[1]} s are those of the code's own Silicate.mat, whose "
    "grains have 0.6 µm; rolling, sliding and twisting modifiers are 1"
)


def _refuse_for_dust(scene: Scene, program: str, strength: str) -> None:
    """Raise the reason why a program for dust cannot have a scene; `strength`: its words for a given shear strength."""
    _refuse_state(scene, program)
    if not scene.is_identical:
        raise Failure(OF_IDENTICAL_SPHERES)
    if "shear_strength" in scene.given:
        raise BadRequest(f"export: {program} {strength}")
    if scene["poisson_ratio"] == 0:
        raise BadRequest(f"export: {program} divides by Poisson's ratio, which is 0 here")


def dust_simulation_material(scene: Scene) -> Iterator[str]:
    """Iterate over the lines of a material file of Lumajord/DustSimulation, in cgs units, with modifiers of 1."""
    scene.plans("pull_off_force", "contact_modulus", "density", "yield_displacement")
    _refuse_for_dust(scene, "dust-simulation", "has the shear strength G/4π², and takes no other")
    numbers = (
        100 * scene["radius"],
        scene["density"] / 1000,
        1000 * scene["work_of_adhesion"] / 2,
        scene["poisson_ratio"],
        10 * scene["youngs_modulus"],
        100 * scene["yield_displacement"],
    )
    yield "MATERIAL_FILE_VERSION_1_4"
    yield scene.material.name if scene.material else "jkroll"
    yield from (f"{number:.12g}" for number in numbers)
    yield from (*_DAMPING, "1", "1", "1")


def _about_dust_simulation(scene: Scene) -> Iterator[str]:
    """Iterate over the notes on a material file: its lines, and which grains stick at every speed."""
    yield _ABOUT_DUST_SIMULATION
    ratio = scene.replace(viscous_time=float(_DAMPING[1]))["viscosity_number"]
    largest = amount("radius", scene["radius"] * (ratio / ALL_STICK) ** (6 / 7), Format(digits=3))
    sticks = f"with this viscous time all grains below {largest} stick at every speed"
    number = f"their T* = (T_vis/ν²)√(E*a0/m) is above {ALL_STICK:.4f}; here it is {significant(ratio, 3)}"
    yield f"viscous damping: {sticks}: {number}; the viscous time is fitted to measured sticking at a size: fit yours"


def dust_collider_material(scene: Scene) -> Iterator[str]:
    """Iterate over the lines of a material in a command file of Paulemaule/DustCollider, in SI units."""
    scene.plans("pull_off_force", "contact_modulus", "density", "yield_displacement")
    _refuse_for_dust(scene, "dust-collider", "has a shear strength of its own, and takes no other")
    gamma = scene["work_of_adhesion"] / 2
    numbers = (gamma, *(scene[name] for name in ("youngs_modulus", "poisson_ratio", "density", "yield_displacement")))
    name = scene.material.name if scene.material else "jkroll"
    yield f'<material id = "1"> "{name}"{_words(iter(numbers))} 0'
    yield "# gamma [J/m^2], Young's modulus [Pa], Poisson's ratio, density [kg/m^3], xi [m], viscous time [s]."
    yield "# The viscous time is yours to write: 0 is no damping. It is fitted to measured sticking at a size."


def liggghts_input(scene: Scene) -> Iterator[str]:
    """Iterate over the lines of an input of LIGGGHTS: Hertz' force less kA with the pull-off force of JKR."""
    scene.plans("pull_off_force", "contact_modulus", "density")
    _refuse_state(scene, "liggghts")
    elastic = ("youngs_modulus", "poisson_ratio")
    spheres = (1,) if scene.is_identical else (1, 2)
    solids = [tuple(scene[of_sphere(sphere, name)] for name in elastic) for sphere in spheres]
    if any(modulus == INFINITY for modulus, _ in solids):
        raise BadRequest("export: liggghts needs a finite Young's modulus of each body")
    grains = _grains(scene)
    pairs = [scene] if scene.is_identical else [grains[1], scene, scene, grains.get(2, scene)]
    yield f"# Contact by jkroll: Hertz less k A, with the pull-off force of JKR, {scene['pull_off_force']:.12g} N"
    yield "# units si" + ("; type 2 is the wall" if _is_at_wall(scene) else "")
    yield "fix m1 all property/global youngsModulus peratomtype" + _words(modulus for modulus, _ in solids)
    yield "fix m2 all property/global poissonsRatio peratomtype" + _words(ratio for _, ratio in solids)
    densities = _words(map(_energy_density, pairs))
    yield f"fix m3 all property/global cohesionEnergyDensity peratomtypepair {len(solids)}{densities}"
    yield "pair_style gran model hertz tangential history cohesion sjkr2"
    yield "pair_coeff * *"
    if steps := [step for pair in pairs for step in pair.numbers("time_step").values()]:
        yield (
            f"# timestep {min(steps):.12g}: a twentieth of the period of sliding with rotation of a JKR contact "
            "without load, in s."
        )
    yield from _rayleigh(grains.values())
    yield from _REMARKS_LIGGGHTS.splitlines()


def _words(numbers: Iterator[float]) -> str:
    return "".join(f" {number:.12g}" for number in numbers)


def _energy_density(pair: Scene) -> float:
    """Return k in J/m³: with A = cδ the least force is −(kc)³/(12E*²R); c is 4πR for two spheres and 2πR1 at a wall."""
    modulus, radius, force = pair["contact_modulus"], pair["reduced_radius"], pair["pull_off_force"]
    area = 2 * pi * radius * (1 if _is_at_wall(pair) else 2)
    return float((12 * modulus**2 * radius * force) ** (1 / 3) / area)


def _refuse_state(scene: Scene, program: str) -> None:
    """Raise BadRequest for a load or an approach: a file is for all of them."""
    if not STATE.isdisjoint(scene.stated) or scene.values["load"]:
        raise BadRequest(f"export: {program} finds the load by itself; give none")


# --- The registry -----------------------------------------------------------------------------------------------------


class Program(NamedTuple):
    """A program that takes contacts: its title, how its input is written, the quantities in it, and the laws it has."""

    title: str
    lines: Callable[[Scene], Iterator[str]]
    quantities: tuple[str, ...]
    models: tuple[str, ...] = (DEFAULT_LAW,)
    about: Callable[[Scene], Iterator[str]] | None = None  # notes on an input that has no comments


PROGRAMS: Mapping[str, Program] = {
    "lammps": Program("LAMMPS", lammps_input, (*QUANTITIES, *THRESHOLDS), tuple(_REMARKS_ON)),
    "liggghts": Program("LIGGGHTS", liggghts_input, ("pull_off_force",)),
    "dust-collider": Program("DustCollider", dust_collider_material, ("pull_off_force", "yield_moment")),
    "dust-simulation": Program(
        "DustSimulation", dust_simulation_material, (*QUANTITIES, *THRESHOLDS), about=_about_dust_simulation
    ),
}
