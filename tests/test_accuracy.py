"""How far results and formulas are from the exact value, in units of the last place (ulp)."""

import inspect
import math
import re
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from random import Random
from typing import Any

import numpy as np
import pytest

from jkroll import FORMULAS, solve
from reference import EQUATIONS, Exact, exact, exact_results, mpf, scale, ulp_error

pytestmark = pytest.mark.filterwarnings("error")  # of numpy, too

Values = dict[str, Any]  # SI numbers by name, and `solve` takes texts too

BOUND = 4.0  # ulp, of a result without load
SCENES = 2000
MANY_SCENES = 20_000
INPUTS = ("radius", "surface_energy", "youngs_modulus", "poisson_ratio", "density", "speed")
RESULTS = tuple(exact_results(dict.fromkeys(INPUTS, 0.5)))


# --- Scenes ---------------------------------------------------------------------------------------------------------


def log_uniform(random: Random, low: float, high: float) -> float:
    """A number of any magnitude between two."""
    return math.exp(random.uniform(math.log(low), math.log(high)))


def any_sphere(random: Random) -> Values:
    """A sphere of any size and material."""
    return {
        "radius": log_uniform(random, 1e-12, 1e3),
        "surface_energy": log_uniform(random, 1e-9, 1e3),
        "youngs_modulus": log_uniform(random, 1e2, 1e14),
        "poisson_ratio": random.choice([random.uniform(-1, 0.5), 0.5, log_uniform(random, 1e-9, 1) - 1]),
        "density": log_uniform(random, 1, 1e5),
    }


def any_scene(random: Random) -> Values:
    """Two spheres or a sphere on a plane, one perhaps rigid, with or without a load, an energy, a speed."""
    scene = any_sphere(random)
    kind = random.choice(["identical", "unequal", "similar", "plane", "rigid", "rigid plane"])
    if kind != "identical":
        similar = {name: value * random.uniform(0.5, 2) for name, value in scene.items() if name != "poisson_ratio"}
        other = any_sphere(random) | (similar if kind == "similar" else {})
        scene |= {name + "2": value for name, value in other.items()}
    if "plane" in kind:
        scene["radius2"] = math.inf
    if "rigid" in kind:
        scene |= random.choice([{"youngs_modulus2": math.inf}, {"poisson_ratio2": -1.0}])
    scene["yield_displacement"] = log_uniform(random, 1e-13, 1e-3)
    scene["gravity"] = log_uniform(random, 1e-3, 1e3)
    if random.random() < 0.5:
        ratios = [random.uniform(-0.9, 1), log_uniform(random, 1e-18, 1e6), -log_uniform(random, 1e-18, 0.9)]
        scene["load"] = random.choice(ratios) * float(exact_results(scene)["pull_off_force"])
    match random.choice(["adhesion", "ratio", "energy", "speed"]):
        case "ratio":
            scene["energy_ratio"] = log_uniform(random, 1e-6, 1e6)
        case "energy":
            scene["energy"] = log_uniform(random, 1e-30, 1e3)
        case "speed":
            scene["speed"] = log_uniform(random, 1e-9, 1e6)
    return scene


@cache
def scenes(count: int) -> Sequence[Values]:
    """The same scenes every time."""
    random = Random(1995)
    return [any_scene(random) for _ in range(count)]


@cache
def exact_scenes(count: int) -> Sequence[Mapping[str, Exact]]:
    """The finite results of each scene: on a plane, some are infinite."""
    return [
        {name: value for name, value in exact_results(scene).items() if abs(value) < math.inf}
        for scene in scenes(count)
    ]


@cache
def conditions(count: int) -> Sequence[Values]:
    """How many times its own relative error that of P/P_c appears in each result."""
    step = mpf(10) ** -40
    moved = [exact_results({**scene, "load": mpf(scene.get("load", 0)) * (1 + step)}) for scene in scenes(count)]
    return [
        {name: float(abs(after[name] / value - 1) / step) if value else 0.0 for name, value in before.items()}
        for before, after in zip(exact_scenes(count), moved, strict=True)
    ]


# --- Results --------------------------------------------------------------------------------------------------------


@cache
def solved_scenes(count: int) -> Sequence[Mapping[str, float]]:
    """What `solve` makes of each scene."""
    return [solve(wanted, **scene) for scene, wanted in zip(scenes(count), exact_scenes(count), strict=True)]


def check(name: str, count: int) -> None:
    """Compare one result of all scenes. A load adds the bound again, times what P/P_c, as inexact, passes on."""
    errors = [
        ulp_error(value[name], want[name]) / (1 + condition[name]) if name in want else 0.0
        for value, want, condition in zip(solved_scenes(count), exact_scenes(count), conditions(count), strict=True)
    ]
    worst = max(range(count), key=errors.__getitem__)
    assert errors[worst] <= BOUND, f"{errors[worst]:.2f} ulp at {scenes(count)[worst]}"


@pytest.mark.parametrize("name", RESULTS)
def test_result_is_accurate(name: str) -> None:
    check(name, SCENES)


@pytest.mark.slow
@pytest.mark.parametrize("name", RESULTS)
def test_result_of_many_scenes_is_accurate(name: str) -> None:
    check(name, MANY_SCENES)


# --- Arrays ---------------------------------------------------------------------------------------------------------


@cache
def solved_as_arrays(count: int, length: int) -> Sequence[Values]:
    """What `solve` makes of the scenes as arrays of some length, of all scenes in which the same names are given."""
    alike = defaultdict(list)
    for index, scene in enumerate(scenes(count)):
        alike[frozenset(scene)].append(index)
    solved: list[Values] = [{}] * count
    for names, indices in alike.items():
        wanted = [name for name in RESULTS if name != "kinetic_energy" or "speed" in names]
        for start in range(0, len(indices), length):
            some = indices[start : start + length]
            given: Values = {name: np.array([scenes(count)[index][name] for index in some]) for name in names}
            columns = solve(wanted, **given)
            for row, index in enumerate(some):
                solved[index] = {name: float(np.broadcast_to(columns[name], len(some))[row]) for name in wanted}
    return solved


@pytest.mark.parametrize("length", [1, SCENES])
@pytest.mark.parametrize("name", RESULTS)
def test_array_agrees_with_float_to_1_ulp(name: str, length: int) -> None:
    differences = [
        ulp_error(other[name], value[name]) if name in value else 0.0
        for value, other in zip(solved_scenes(SCENES), solved_as_arrays(SCENES, length), strict=True)
    ]
    worst = max(range(SCENES), key=differences.__getitem__)
    assert differences[worst] <= 1, f"{differences[worst]:.0f} ulp at {scenes(SCENES)[worst]}"


# --- Formulas -------------------------------------------------------------------------------------------------------


@cache
def parameter_values(count: int) -> Sequence[Values]:
    """Values of every parameter of every formula, of magnitudes that go together, each taken as exact."""
    random = Random(1997)
    return [
        dict(any_values(random, scene, results))
        for scene, results in zip(scenes(count), map(exact_results, scenes(count)), strict=True)
    ]


def any_values(random: Random, scene: Values, results: Mapping[str, Exact]) -> Iterator[tuple[str, Any]]:
    """One set, from a scene and its results."""
    for name in INPUTS[:-1]:
        yield name + "2", scene.get(name + "2", scene[name])
    for name, value in results.items():
        yield name, float(value) * random.uniform(1, 2)
    for name, low, high in (
        ("energy", 1e-30, 1e3),
        ("energy_ratio", 1e-6, 1e6),
        ("speed", 1e-9, 1e6),
        ("angular_speed", 1e-9, 1e12),
        ("angle", 1e-12, 1),
        ("displacement", 1e-15, 1e-3),
        ("number", 1, 1e9),
    ):
        yield name, log_uniform(random, low, high)
    near_1 = 1 + random.choice([-1, 1]) * log_uniform(random, 1e-15, 0.5)
    yield "contact_radius_ratio", random.choice([near_1, log_uniform(random, 1e-6, 1e6)])
    radius = float(results["contact_radius_at_load"])
    yield "contact_radius_at_load", radius
    yield "distance", radius * random.choice([random.random(), 1 - log_uniform(random, 1e-15, 1)])
    yield "half_circle_radius", radius * random.uniform(0, 2)
    force = float(results["pull_off_force"])
    yield "pull_off_force", force
    yield from scene.items()
    yield "load", force * (log_uniform(random, 1e-15, 1e6) - 1)
    if random.random() < 0.5:  # where the approach passes through zero
        yield "load_margin", near_1 / 3


def test_every_formula_has_its_equation() -> None:
    assert EQUATIONS.keys() == FORMULAS.keys()


@pytest.mark.parametrize("name", FORMULAS)
def test_formula_is_as_accurate_as_it_says(name: str) -> None:
    formula = FORMULAS[name]
    stated = re.search(r"Accuracy: (?:(?P<exact>[Ee]xact)|(?P<ulp>[\d.]+) ulp)", formula.__doc__ or "")
    assert stated, "no number of ulp"
    bound = 0.0 if stated["exact"] else float(stated["ulp"])
    parameters = inspect.signature(formula).parameters
    argument_sets = [{parameter: values[parameter] for parameter in parameters} for values in parameter_values(SCENES)]
    errors = [
        ulp_error(formula(**arguments), exact(name, arguments), of=scale(name, arguments))
        for arguments in argument_sets
    ]
    worst = max(range(SCENES), key=errors.__getitem__)
    assert errors[worst] <= bound, f"{errors[worst]:.2f} ulp, {bound} stated, at {argument_sets[worst]}"
