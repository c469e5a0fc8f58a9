"""Contacts as input for other programs: LAMMPS, LIGGGHTS, DustCollider and DustSimulation, in SI or cgs units.

In LAMMPS, contacts have the pair_style `granular`. Its rolling friction is a spring: the force is kξ, but at most
μ|P + 2P_c|, and the torque is R times the force. Here k is the stiffness, ξ the rolling displacement, μ the coefficient
of friction, P the load, P_c the pull-off force and R the reduced radius. Sliding and twisting have similar limits.
Comments are ASCII, because LAMMPS warns about other signs.
"""

from collections.abc import Callable, Iterable, Mapping
from math import pi
from typing import NamedTuple

from ..errors import BadRequest, JkrollError
from ..model.frame import Frame
from ..model.reasons import OF_IDENTICAL_SPHERES, Failure, explanation_of
from ..physics.motion import STICKS_FROM
from ..physics.tangential import sliding_friction_coefficient
from ..quantities.formatting import Format, amount, significant
from ..quantities.laws import DEFAULT_LAW, DMT, JKR
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, PROPERTIES, STATE, STATE_OR_LOAD, of_sphere
from ..text import ascii_text, wrapped

SKIN = 0.2  # skin of the neighbor lists, in units of the smaller radius
LEAST_SKIN = 0.4  # least skin, over the approach without load; LAMMPS breaks a contact before its gap is as wide
WIDTH = 78  # of comments, after "# "
NO_SLIP = 1e9  # a coefficient of friction that prevents slip, for laws without a sliding force

OF_ANY_LAW = ("yield_moment", "pull_off_force", "rolling_stiffness", "tangential_stiffness", "time_step")
OF_JKR = ("sliding_force", "twisting_stiffness", "twisting_moment")
_IN_COMMENTS = ("work_of_adhesion", "yield_displacement", "load")

# --- LAMMPS -----------------------------------------------------------------------------------------------------------

_LAMMPS = """\
# Contact of {bodies} by jkroll: {title}, gamma = w/2
# w = {work_of_adhesion:.12g} J/m^2, xi = {yield_displacement:.12g} m, P = {load:.12g} N{place}
{of_collisions}{of_pairs}# units si
{types}
comm_modify vel yes
neighbor {skin:.12g} bin
pair_style granular
{coefficients}
timestep {step:.12g}
# SI units. {law}: 2E* [Pa], damping, Poisson's ratio (0, as only E* enters), gamma per surface [J/m^2].
# tangential mindlin_rescale: 8G* [Pa], damping, coefficient of friction [1].
# rolling sds: stiffness [N/m], damping, coefficient M/(R(P + 2P_c)) [1], M the moment at which it rolls, R the \
reduced radius.
# Damping is 0 (coeff_restitution gives nan with adhesion): write your own, or only adhesion and friction take energy. \
timestep [s] and thresholds are for the P above: \
where collisions press harder, give their largest force as --load. Each line is explained in jkroll guide dem
"""
_EARLY = 0.7028  # sticking speed of LAMMPS' JKR contact, which breaks early, over that of JKR
_OF_COLLISIONS = """\
# LAMMPS drops a contact at the largest pull, where fixed grips would hold it on: its grains stick only below \
{slow:.3g} m/s{place}, {early} of JKR's v_stick.
"""
_COMMENTS_ON = {  # by law
    JKR: """\
# twisting sds: stiffness [N m], damping, coefficient M_twist/(P + 2P_c) [m].
# Friction is F_slide/(P + 2P_c), with tau = {shear_strength:.6g} Pa{place}; if a brittle contact peels off first, \
write T_first/(P + 2P_c) = {peels:.6g}. Both are due to adhesion at the P above: for harder pushes write the \
coefficient of your solid.
""",
    DMT: """\
# P_c is 4 pi gamma R here. The rolling moment is 4 pi gamma R xi at any load; the one in LAMMPS equals it at the P \
above only.
# The contact does not slip: for the 1e9, write your coefficient of friction. Twisting is left out.
""",
}


def lammps_input(frame: Frame) -> str:
    """Return input for LAMMPS: the coefficients of each pair of types and of any wall, the time step, and comments."""
    is_jkr = frame.law.is_default
    names = [*OF_ANY_LAW]
    if is_jkr:
        names += [*OF_JKR, "shear_strength"]
    names += ["contact_shear_modulus", "density", "density2", *_IN_COMMENTS]
    values = {name: frame[name] for name in names}
    like_pairs = _like_pairs(frame)
    pairs = {f"pair_coeff {grain} {grain} {{}}": pair for grain, pair in like_pairs.items()}
    bodies, place = "two spheres", ""
    if _is_at_wall(frame):
        bodies, place = "a sphere and a plane", " at the wall, which is put at z = 0"
        pairs["fix wall all wall/gran granular {} zplane 0 NULL"] = frame
    elif not frame.is_identical:
        place = " for types 1 and 2"
        pairs["pair_coeff 1 2 {}"] = frame
    coefficients, steps = [], []
    for command, pair in pairs.items():
        try:
            coefficients.append(command.format(_coefficients(pair)))
            steps.append(pair["time_step"])
        except JkrollError as error:  # a pair of like spheres may be rigid, or lack an input
            coefficients.append(f"# {command.partition(' {')[0]}: {explanation_of('', error)}")
    at_rest = "Like spheres touch without load. " if values["load"] else ""
    types = []
    for grain, pair in like_pairs.items():
        types.append(f"# set type {grain} diameter {2 * pair['radius']:.12g} density {pair['density']:.12g}")
    return (_LAMMPS + _COMMENTS_ON[frame.law.name]).format(
        **values,
        law=frame.law.name,
        title=frame.law.name.upper(),
        bodies=bodies,
        place=place,
        of_collisions=_on_collisions(frame, place) if is_jkr else "",
        of_pairs=f"# {at_rest}The time step is the shortest of all pairs.\n" if len(pairs) > 1 else "",
        types="\n".join(types),
        skin=_skin(frame, pairs.values()),
        coefficients="\n".join(coefficients),
        step=min(steps),
        peels=_peeling_coefficient(frame) if is_jkr else 0.0,
    )


def _on_collisions(frame: Frame, place: str) -> str:
    """Return the comment on the speed below which grains stick in LAMMPS. `place`: the pair, if there are several."""
    return _OF_COLLISIONS.format(early=_EARLY, slow=_EARLY * frame["sticking_speed"], place=place.partition(",")[0])


def _peeling_coefficient(frame: Frame) -> float:
    """Return the coefficient of friction of a contact that may peel off before it slides."""
    force, load, pull_off_force = (frame[name] for name in ("sliding_or_peeling_force", "load", "pull_off_force"))
    return float(sliding_friction_coefficient(sliding_force=force, load=load, pull_off_force=pull_off_force))


def _skin(frame: Frame, pairs: Iterable[Frame]) -> float:
    """Return the skin of the neighbor lists, in m: pairs with a smaller gap are listed."""
    skin = SKIN * min(frame["radius"], frame.values.get("radius2", INFINITY))
    for pair in pairs:
        for approach in pair.numbers("approach").values():
            skin = max(skin, LEAST_SKIN * approach)
    return float(skin)


def _is_at_wall(frame: Frame) -> bool:
    return bool(frame.values.get("radius2") == INFINITY)


def _like_pairs(frame: Frame) -> dict[int, Frame]:
    """Return a pair of like spheres for each type, by the number of the type; a wall has no such pair."""
    if frame.is_identical:
        return {1: frame}
    types = (1,) if _is_at_wall(frame) else (1, 2)
    return {sphere: pair_of(frame, sphere) for sphere in types}


def pair_of(frame: Frame, sphere: int) -> Frame:
    """Return a pair of two spheres like sphere 1, or like sphere 2, without load."""
    stated = {name: value for name, value in frame.stated_of_1.items() if name not in STATE_OR_LOAD}
    of_2 = {of_sphere(1, name): value for name, value in frame.stated.items() if NOMENCLATURE[name].sphere == 2}
    if sphere == 1:
        return Frame(stated, frame.material, model=frame.law.name)
    if frame.material2 is not None:
        stated = {name: value for name, value in stated.items() if name not in PROPERTIES}
    return Frame({**stated, **of_2}, frame.material2 or frame.material, model=frame.law.name)


def _coefficients(pair: Frame) -> str:
    """Return the coefficients of a contact as words and numbers, for `pair_coeff` and `fix wall/gran`."""
    slip = pair["sliding_friction_coefficient"] if pair.law.is_default else NO_SLIP
    numbers: dict[str, tuple[float, ...]] = {
        pair.law.name: (2 * pair["contact_modulus"], 0, 0, pair["work_of_adhesion"] / 2),
        "tangential mindlin_rescale": (8 * pair["contact_shear_modulus"], 0, slip),
        "rolling sds": (pair["rolling_spring_constant"], 0, pair["rolling_friction_coefficient"]),
    }
    if pair.law.is_default:
        numbers["twisting sds"] = (pair["twisting_stiffness"], 0, pair["twisting_friction_coefficient"])
    return " ".join([word + _spaced(values) for word, values in numbers.items()])


# --- LIGGGHTS ---------------------------------------------------------------------------------------------------------

_LIGGGHTS = """\
# Contact by jkroll: Hertz minus k A, with the pull-off force of JKR, {force:.12g} N
# units si{wall}
fix m1 all property/global youngsModulus peratomtype{moduli}
fix m2 all property/global poissonsRatio peratomtype{ratios}
fix m3 all property/global cohesionEnergyDensity peratomtypepair {types}{densities}
pair_style gran model hertz tangential history cohesion sjkr2
pair_coeff * *
{steps}\
# m1: Pa, of each type; m2: 1; m3: k in J/m^3, of the types 1 1, or 1 1, 1 2, 2 1, 2 2. Lengths in m, forces in N.
# coefficientRestitution and coefficientFriction are yours to give; there is no resistance to rolling or twisting.
# k holds for these radii: it is proportional to R^(-1/3). With cohesion sjkr, two spheres need twice this k, and a \
wall this k.
# Only the pull-off is JKR's: without overlap there is no force; contact radius, stiffness and overlap differ from it.
"""
_TWO_RULES = """\
# timestep {:.12g}: in s, the shorter of a twentieth of the period of sliding with rotation of a JKR contact \
without load, and a fifth of the Rayleigh time.
"""


def liggghts_input(frame: Frame) -> str:
    """Return input for LIGGGHTS: Hertz' force minus kA, with the pull-off force of JKR."""
    frame.plans("pull_off_force", "contact_modulus", "density")
    _refuse_state(frame, "liggghts")
    spheres = (1,) if frame.is_identical else (1, 2)
    moduli = [frame[of_sphere(sphere, "youngs_modulus")] for sphere in spheres]
    ratios = [frame[of_sphere(sphere, "poisson_ratio")] for sphere in spheres]
    if INFINITY in moduli:
        raise BadRequest("export: liggghts needs a finite Young's modulus of each body")
    pairs = [frame]
    if not frame.is_identical:
        like_pairs = _like_pairs(frame)
        pairs = [like_pairs[1], frame, frame, like_pairs.get(2, frame)]  # no wall meets itself
    steps: list[float] = []
    for pair in pairs:
        steps += pair.numbers("time_step").values()
    return _LIGGGHTS.format(
        force=frame["pull_off_force"],
        wall="; type 2 is the wall" if _is_at_wall(frame) else "",
        moduli=_spaced(moduli),
        ratios=_spaced(ratios),
        types=len(moduli),
        densities=_spaced(map(_energy_density, pairs)),
        steps=_TWO_RULES.format(min(steps)) if steps else "",
    )


def _spaced(numbers: Iterable[float]) -> str:
    """Return numbers as a text, with a blank before each."""
    return "".join(f" {number:.12g}" for number in numbers)


def _energy_density(pair: Frame) -> float:
    """Return the cohesion energy density k of a pair, in J/m³.

    With the contact area A = cδ at the overlap δ, the least force is −(kc)³/(12E*²R); c is 4πR for two spheres and 2πR1
    at a wall.
    """
    modulus, radius, force = pair["contact_modulus"], pair["reduced_radius"], pair["pull_off_force"]
    area = (2 if _is_at_wall(pair) else 4) * pi * radius  # A/δ = c
    return float((12 * modulus**2 * radius * force) ** (1 / 3) / area)


def _refuse_state(frame: Frame, program: str) -> None:
    """Raise BadRequest for a load other than 0, an approach or another state, since the program computes the state."""
    if not STATE.isdisjoint(frame.stated) or frame.values["load"]:
        raise BadRequest(f"export: {program} finds the load by itself; give none")


# --- DustSimulation and DustCollider ----------------------------------------------------------------------------------

_DAMPING = "1e-06", "1.25e-11"
_ABOUT_DUST_SIMULATION = (
    "the lines are version, name, R1 [cm], density [g/cm³], γ per surface [mJ/m²], Poisson's ratio, Young's modulus "
    "[dyn/cm²], ξ [cm], damping factor, viscous time [s], and the modifiers of rolling, sliding and twisting; "
    f"damping factor {_DAMPING[0]} and viscous time {_DAMPING[1]} s are those of the code's own Silicate.mat, whose "
    "grains have R1 = 0.6 µm; rolling, sliding and twisting modifiers are 1"
)
_DUST_COLLIDER = """\
<material id = "1"> "{}"{} 0
# gamma [J/m^2], Young's modulus [Pa], Poisson's ratio, density [kg/m^3], xi [m], viscous time [s].
# The viscous time is yours to write: 0 is no damping. It is fitted to measured sticking at a size.
"""


def _grain(frame: Frame, program: str) -> tuple[str, list[float]]:
    """Return the name of the material and its γ, E, ν, density and ξ in SI units.

    Raises an error if the program cannot represent the frame.
    """
    frame.plans("pull_off_force", "contact_modulus", "density", "yield_displacement")
    _refuse_state(frame, program)
    if not frame.is_identical:
        raise Failure(OF_IDENTICAL_SPHERES)
    if "shear_strength" in frame.given:
        raise BadRequest(f"export: {program} has a shear strength of its own, and takes no other")
    if frame["poisson_ratio"] == 0:
        raise BadRequest(f"export: {program} divides by Poisson's ratio, which is 0 here")
    names = ("youngs_modulus", "poisson_ratio", "density", "yield_displacement")
    name = frame.material.name if frame.material else "jkroll"
    return name, [frame["work_of_adhesion"] / 2, *(frame[quantity] for quantity in names)]


def dust_simulation_material(frame: Frame) -> str:
    """Return the material file of Lumajord/DustSimulation, in cgs units, with modifiers of 1."""
    name, (gamma, modulus, ratio, density, lag) = _grain(frame, "dust-simulation")
    numbers = _spaced((100 * frame["radius"], density / 1000, 1000 * gamma, ratio, 10 * modulus, 100 * lag))
    return "\n".join(("MATERIAL_FILE_VERSION_1_4", name, *numbers.split(), *_DAMPING, "1", "1", "1", ""))


def _about_dust_simulation(frame: Frame) -> tuple[str, str]:
    """Return the notes on a material file: on its lines, and on the size of grains that stick at every speed."""
    # T* is proportional to R^(-7/6).
    ratio = frame.replace(viscous_time=float(_DAMPING[1]))["viscosity_number"]
    largest = amount("radius", frame["radius"] * (ratio / STICKS_FROM) ** (6 / 7), Format(digits=3))
    sticks = f"with this viscous time all grains below {largest} stick at every speed"
    number = f"their T* = (T_vis/ν²)√(E*a0/m) is above {STICKS_FROM:.4f}; here it is {significant(ratio, 3)}"
    fitted = "the viscous time is fitted to measured sticking at a size: fit yours"
    return _ABOUT_DUST_SIMULATION, f"viscous damping: {sticks}: {number}; {fitted}"


def dust_collider_material(frame: Frame) -> str:
    """Return a material of a command file of Paulemaule/DustCollider, in SI units."""
    name, grain = _grain(frame, "dust-collider")
    return _DUST_COLLIDER.format(name, _spaced(grain))


# --- The registry -----------------------------------------------------------------------------------------------------


class Program(NamedTuple):
    """A program for which `jkroll export` writes input."""

    title: str
    text: Callable[[Frame], str]  # returns the input
    quantities: tuple[str, ...]  # the results to which the notes refer
    models: tuple[str, ...] = (DEFAULT_LAW,)
    about: Callable[[Frame], Iterable[str]] | None = None  # returns notes, for an input that cannot have comments
    to_write: str = ""  # what the user must still write into the input, under the default law


PROGRAMS: Mapping[str, Program] = {
    "lammps": Program(
        "LAMMPS",
        lammps_input,
        (*OF_ANY_LAW, *OF_JKR),
        tuple(_COMMENTS_ON),
        to_write="damping (now 0) and friction (now that of adhesion)",
    ),
    "liggghts": Program("LIGGGHTS", liggghts_input, ("pull_off_force",)),
    "dust-collider": Program(
        "DustCollider", dust_collider_material, ("pull_off_force", "yield_moment"), to_write="viscous time (now 0)"
    ),
    "dust-simulation": Program(
        "DustSimulation", dust_simulation_material, (*OF_ANY_LAW, *OF_JKR), about=_about_dust_simulation
    ),
}


# --- Comments ---------------------------------------------------------------------------------------------------------


def with_wrapped_comments(text: str) -> str:
    """Return the input of a program with its comments wrapped."""
    lines = []
    for line in text.splitlines():
        lines.append(comment_of(line.removeprefix("# ")) if line.startswith("# ") else line)
    return "\n".join([*lines, ""])


def comment_of(text: str) -> str:
    """Return a text as a comment in the input of a program, wrapped."""
    return "\n".join(f"# {line}" for line in wrapped(ascii_text(text), WIDTH, 2))
