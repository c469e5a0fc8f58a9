"""Scenes for the tests: random scenes of any size and material, and scenes in which careless formulas lose digits."""

import math
from collections.abc import Iterator
from random import Random
from typing import Any

from jkroll import solve
from jkroll.model.frame import EXCLUSIVE
from jkroll.model.plan import formula_of
from jkroll.quantities.laws import LAWS
from jkroll.quantities.nomenclature import DEFAULTS, NOMENCLATURE
from jkroll.quantities.values import parse_quantity

Scene = dict[str, Any]  # SI numbers by name

QUARTZ: Scene = {
    "radius": 1e-7, "surface_energy": 0.025, "youngs_modulus": 54e9, "poisson_ratio": 0.17, "density": 2600.0
}  # fmt: skip
OTHER: Scene = {
    "radius2": 3.7e-6, "surface_energy2": 3.0, "youngs_modulus2": 210e9, "poisson_ratio2": 0.27, "density2": 7700.0
}  # fmt: skip


def log_uniform(random: Random, low: float, high: float) -> float:
    """Return a number of any magnitude between two numbers."""
    return math.exp(random.uniform(math.log(low), math.log(high)))


def near_example(name: str, random: Random) -> float:
    """Return an input's example times a factor from 0.01 to 100; if this is out of range, the example itself."""
    quantity = NOMENCLATURE[name]
    example = parse_quantity(quantity.example, name)
    value = example * log_uniform(random, 0.01, 100)
    return value if quantity.range.admits(value) else example


def _inputs_of_every_scene() -> list[str]:
    """Return the inputs of a pair that have neither a formula nor a default, exclude no input and change no formula."""
    others = {*DEFAULTS}.union(*EXCLUSIVE, *(law.tables for law in LAWS.values()))
    return [
        name
        for name, quantity in NOMENCLATURE.items()
        if quantity.option and not (quantity.is_word or quantity.sphere or name in others or formula_of(name))
    ]


def any_sphere(random: Random) -> Scene:
    """Return a sphere of any size and material."""
    return {
        "radius": log_uniform(random, 1e-12, 1e3),
        "surface_energy": log_uniform(random, 1e-9, 1e3),
        "youngs_modulus": log_uniform(random, 1e2, 1e14),
        "poisson_ratio": random.choice([random.uniform(-1, 0.5), 0.5, log_uniform(random, 1e-9, 1) - 1]),
        "density": log_uniform(random, 1, 1e5),
    }


def any_scene(random: Random) -> Scene:
    """Return two spheres or a sphere on a plane, where body 2 may be rigid, in any state, with any other inputs."""
    scene = any_sphere(random)
    kind = random.choice(["identical", "unequal", "unequal", "similar", "plane", "rigid", "rigid plane"])
    if kind != "identical":
        similar = {name: value * random.uniform(0.5, 2) for name, value in scene.items() if name != "poisson_ratio"}
        other = any_sphere(random) | (similar if kind == "similar" else {})
        scene |= {name + "2": value for name, value in other.items()}
    if "plane" in kind:
        scene["radius2"] = math.inf
    if "rigid" in kind:
        scene |= {"youngs_modulus2": math.inf}
    scene["yield_displacement"] = log_uniform(random, 1e-13, 1e-3)
    scene["gravity"] = log_uniform(random, 1e-3, 1e3)
    scene["monomers"] = log_uniform(random, 2, 1e12)
    scene["filling_factor"] = log_uniform(random, 1e-4, 0.7)
    scene["yield_strength"] = scene["youngs_modulus"] * log_uniform(random, 1e-6, 1e3)
    match random.choice(["none", "load", "approach"]):
        case "load":
            scene["load"] = _any_ratio(random) * solve("pull_off_force", **scene)
        case "approach":
            scene["approach_at_load"] = _any_ratio(random) * solve("approach", **scene)
    match random.choice(["adhesion", "ratio", "energy", "speed"]):
        case "ratio":
            scene["energy_ratio"] = log_uniform(random, 1e-6, 1e6)
        case "energy":
            scene["energy"] = log_uniform(random, 1e-30, 1e3)
        case "speed":
            scene["speed"] = log_uniform(random, 1e-9, 1e6)
    return {name: near_example(name, random) for name in _inputs_of_every_scene()} | scene


def _any_ratio(random: Random) -> float:
    """Return a random load in units of P_c, or a random approach in units of δ0."""
    return random.choice([random.uniform(-0.8, 1), log_uniform(random, 1e-18, 1e6), -log_uniform(random, 1e-18, 0.8)])


def random_scenes(count: int, seed: int) -> Iterator[Scene]:
    """Iterate over scenes of any kind."""
    random = Random(seed)
    return (any_scene(random) for _ in range(count))


def steps_from(value: float, *counts: float) -> list[float]:
    """Return a double and the doubles that are some steps away on either side."""
    return [value + sign * count * math.ulp(value) for count in (0.0, *counts) for sign in (-1, 1)][1:]


def hard_loads(force: float) -> Iterator[float]:
    """Iterate over loads near −P_c, near −8/9 P_c (where the approach is 0), and of any magnitude."""
    powers = [10.0**power for power in range(2, 16)]
    yield from (-force + count * math.ulp(force) for count in (0, 1, 2, 3, 10, *powers))
    yield from steps_from(-8 * (force / 9), 1, 2, 10, *powers[:-1])
    ratios = [10.0**power for power in range(-24, 25, 4)]
    yield from (ratio * force for ratio in ratios)
    yield from (-ratio * force for ratio in ratios if ratio <= 1)


def hard_approaches(approach: float, fold: float) -> Iterator[float]:
    """Iterate over approaches near the fold, 0 and δ0, and of any magnitude. `fold`: the fold over `approach`, δ0."""
    yield from (approach * (fold + 10.0**power) for power in range(-14, 0))
    border = 3 / 6 ** (1 / 3) + fold  # where `jkr` changes to another start for Newton's method
    for middle in (1.0, border):
        yield from (approach * ratio for ratio in steps_from(middle, 1, 1e3, 1e6, 1e9))
    yield from (approach * 10.0**power for power in range(-24, 25, 4))
    yield from (-approach * 10.0**power for power in range(-24, 0, 4))


ENDS: dict[str, tuple[float, ...]] = {
    "radius": (1e-12, 1e-9, 1e3), "radius2": (1e-12, 1e3, math.inf), "surface_energy": (1e-9, 1e3),
    "surface_energy2": (1e-9, 1e3), "youngs_modulus": (1e2, 1e14), "youngs_modulus2": (1e2, 1e14, math.inf),
    "poisson_ratio": (-1 + 2.0**-53, -0.5, 0.0, 0.5), "poisson_ratio2": (-1 + 2.0**-53, 0.5),
    "density": (1.0, 1e5), "yield_displacement": (1e-13, 1e-3), "gravity": (1e-3, 1e3),
}  # fmt: skip


OF_HARD_SCENES = {*QUARTZ, *OTHER, *ENDS, *DEFAULTS, "load", "approach_at_load"}  # inputs of hard scenes


def hard_scenes(fold: float) -> Iterator[Scene]:
    """Iterate over scenes in hard states, with an input at the end of its range, or with two radii at their ends."""
    for scene in (QUARTZ, QUARTZ | OTHER):
        force, approach = solve(["pull_off_force", "approach"], **scene).values()
        yield from ({**scene, "load": load} for load in hard_loads(force))
        yield from ({**scene, "approach_at_load": hard} for hard in hard_approaches(approach, fold))
    for name, ends in ENDS.items():
        yield from ({**QUARTZ, **OTHER, name: end} for end in ends)
    for radius, radius2 in ((1e-12, 1e3), (1e3, 1e-12), (1e-12, 1e-12), (1e3, math.inf)):
        yield {**QUARTZ, **OTHER, "radius": radius, "radius2": radius2}


def strip_contacts(count: int) -> list[Scene]:
    """Return strip contacts of any size, shift and load, always the same."""
    random = Random(1995)
    return [_strip_contact(random) for _ in range(count)]


def _strip_contact(random: Random) -> Scene:
    radius = log_uniform(random, 1e-9, 1e3)
    half_width = radius * log_uniform(random, 1e-6, 0.3)
    position = random.choice([-1, 1]) * half_width * random.choice([random.random(), 1 - log_uniform(random, 1e-14, 1)])
    shares = [random.uniform(-2, 1), 1 - log_uniform(random, 1e-15, 1), log_uniform(random, 1e-9, 1e9)]
    constant = half_width**2 / 2 * random.choice(shares)
    return {
        "position_in_strip": position, "contact_half_width": half_width, "load_constant": constant,
        "cylinder_radius": radius, "yield_displacement": half_width * log_uniform(random, 1e-9, 1),
        "plane_strain_modulus": log_uniform(random, 1e5, 1e13),
        "work_of_adhesion": log_uniform(random, 1e-6, 1e2),
    }  # fmt: skip
