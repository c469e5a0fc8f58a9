"""The contact of two spheres, or of a sphere and a plane, as input of LAMMPS: `granular` with rolling resistance, in SI units.

LAMMPS takes γ = w/2. Only E* of the elastic constants enters its normal force, so that they are written as E = 2E*, ν = 0,
which also mixes as E* does. Its rolling friction is a spring F = k ξ with the cap μ|P + 2P_po|, and the torque FR; k does not depend
on the load. A plane is a wall, whose coefficients mean the same. Comments are ASCII, as LAMMPS warns of other characters.
"""

from collections.abc import Iterator, Mapping

from ..errors import JkrollError
from ..quantities.nomenclature import INFINITY, PROPERTIES, STATE
from ..scene.errors import MissingInput
from ..scene.scene import Scene

NO_SLIP = 1e9  # a coefficient of friction with which nothing slips

QUANTITIES = ("yield_moment", "pull_off_force", "rolling_stiffness", "tangential_stiffness", "time_step")

_REMARKS = (
    "# E = 2E*, nu = 0: only E* enters the normal force. The tangential constant is 8G*, Mindlin's for these solids.",
    "# The time step is a twentieth of the period of sliding with rotation; it is stable up to 40 contacts a sphere.",
    "# The contact does not slip: for the 1e9, write your coefficient of friction. Damping and twisting are left out.",
)
_REMARKS_ON = {
    "jkr": (
        "# LAMMPS lets go at the pull-off force, 3 pi gamma R; jkroll's curve goes on to the fold, where fixed grips let go.",
        "# LAMMPS has one rolling stiffness for all loads, and a yield force linear in P; they are jkroll's at the P above.",
    ),
    "dmt": (
        "# The force is (4/3) E* sqrt(R delta^3) - 4 pi gamma R while the spheres touch; jkroll's JKR has another contact radius.",
        "# The rolling moment is 4 pi gamma R xi at any load; LAMMPS has a yield force linear in P, which is right at the P above.",
    ),
}
_STATE = STATE | {"load"}
MODELS = tuple(_REMARKS_ON)


def lammps_input(scene: Scene) -> Iterator[str]:
    """Iterate over the lines of an input: coefficients of each pair of types or of a wall, a time step, and what they stand on."""
    whole = scene.evaluate((*QUANTITIES, "contact_shear_modulus", "density", "density2"))
    for value in whole.values():
        if isinstance(value, JkrollError):
            raise value
    model = scene.law.name
    work, lag, load = scene["work_of_adhesion"], scene["yield_displacement"], scene["load"]
    suffixes: tuple[str, ...] = ("", "2")
    if scene.values.get("radius2") == INFINITY:
        bodies, place, suffixes = "a sphere and a plane", " at the wall, which is put at z = 0", ("",)
        pairs = {"pair_coeff 1 1 {}": _pair_of(scene, ""), "fix wall all wall/gran granular {} zplane 0 NULL": scene}
    elif scene.is_identical:
        bodies, place, suffixes = "two spheres", "", ("",)
        pairs = {"pair_coeff 1 1 {}": scene}
    else:
        bodies, place = "two spheres", " for types 1 and 2"
        pairs = {
            "pair_coeff 1 1 {}": _pair_of(scene, ""),
            "pair_coeff 2 2 {}": _pair_of(scene, "2"),
            "pair_coeff 1 2 {}": scene,
        }
    yield f"# Contact of {bodies} by jkroll: {model.upper()}, gamma = w/2"
    yield f"# w = {work:.12g} J/m^2, xi = {lag:.12g} m, P = {load:.12g} N{place}"
    yield "# units si"
    for sphere, suffix in enumerate(suffixes, 1):
        radius = scene.values.get("radius" + suffix, scene.values["radius"])
        yield f"# set type {sphere} diameter {2 * radius:.12g} density {scene['density' + suffix]:.12g}"
    yield "pair_style granular"
    steps = []
    for command, pair in pairs.items():
        try:
            yield command.format(_coefficients(pair))
            steps.append(pair["time_step"])
        except MissingInput as error:
            yield f"# {command.partition(' {')[0]} needs {error.needs()}"
    yield f"timestep {min(steps):.12g}"
    yield from _REMARKS
    yield from _REMARKS_ON[model]


def _pair_of(scene: Scene, suffix: str) -> Scene:
    """Return the pair of two spheres like sphere 1, or like sphere 2, without load."""
    stated = {name: value for name, value in scene.stated.items() if not name.endswith("2") and name not in _STATE}
    own = {name.removesuffix("2"): value for name, value in scene.stated.items() if name.endswith("2")}
    if scene.material2 is not None:
        stated.pop("work_of_adhesion", None)  # of the two materials
    if not suffix:
        return Scene(stated, scene.material, model=scene.law.name)
    if scene.material2 is not None:
        stated = {name: value for name, value in stated.items() if name not in PROPERTIES}
    return Scene({**stated, **own}, scene.material2 or scene.material, model=scene.law.name)


def _coefficients(pair: Scene) -> str:
    """Return the words and numbers that describe a contact in `pair_coeff` and `fix wall/gran`."""
    radius, load = pair["reduced_radius"], pair["load"]
    cap = pair["yield_moment"] / (radius * (load + 2 * pair["pull_off_force"]))
    numbers: Mapping[str, tuple[float, ...]] = {
        pair.law.name: (2 * pair["contact_modulus"], 0, 0, pair["work_of_adhesion"] / 2),
        "tangential mindlin": (8 * pair["contact_shear_modulus"], 0, NO_SLIP),
        "rolling sds": (pair["rolling_stiffness"] / radius**2, 0, cap),
    }
    return " ".join(" ".join((word, *(f"{number:.12g}" for number in values))) for word, values in numbers.items())
