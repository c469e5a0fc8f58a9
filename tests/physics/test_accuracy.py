"""How far results and formulas are from the exact value, in units of the last place (ulp)."""

import inspect
import math
import re
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from itertools import islice, product
from random import Random
from typing import Any, NamedTuple

import numpy as np
import pytest

from jkroll import FORMULAS, solve
from reference import BOUND, EQUATIONS, FOLD, Exact, conditions, exact_results, formula_error, ulp_error

pytestmark = pytest.mark.filterwarnings("error")  # of numpy, too

Values = dict[str, Any]  # SI numbers by name, and `solve` takes texts too

SCENES = 1000
MANY_SCENES = (100_000,)
FEWER_SCENES = 400  # for each formula, and for arrays
INPUTS = ("radius", "surface_energy", "youngs_modulus", "poisson_ratio", "density", "speed")
RESULTS = tuple(
    dict.fromkeys(
        name
        for state in ("load", "approach_at_load")
        for name in exact_results({**dict.fromkeys(INPUTS, 0.5), state: -0.1})
    )
)


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
    """Two spheres or a sphere on a plane, one perhaps rigid, with or without a load or an approach, an energy, a speed."""
    scene = any_sphere(random)
    kind = random.choice(["identical", "unequal", "unequal", "similar", "plane", "rigid", "rigid plane"])
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
    state = random.choice(["none", "load", "approach"])
    if state != "none":
        ratios = [random.uniform(-0.8, 1), log_uniform(random, 1e-18, 1e6), -log_uniform(random, 1e-18, 0.8)]
        name, unit = ("load", "pull_off_force") if state == "load" else ("approach_at_load", "approach")
        scene[name] = random.choice(ratios) * solve(unit, **scene)
    match random.choice(["adhesion", "ratio", "energy", "speed"]):
        case "ratio":
            scene["energy_ratio"] = log_uniform(random, 1e-6, 1e6)
        case "energy":
            scene["energy"] = log_uniform(random, 1e-30, 1e3)
        case "speed":
            scene["speed"] = log_uniform(random, 1e-9, 1e6)
    return scene


def scenes(count: int) -> Iterator[Values]:
    """The same scenes every time."""
    random = Random(1995)
    return (any_scene(random) for _ in range(count))


# --- Results --------------------------------------------------------------------------------------------------------


class Worst(NamedTuple):
    """The largest error of a result and the scene in which it occurs."""

    error: float  # ulp / (1 + condition)
    scene: Values


def finite_results(scene: Values) -> Mapping[str, Exact]:
    """The finite results of a scene: on a plane, some are infinite."""
    return {name: value for name, value in exact_results(scene).items() if abs(value) < math.inf}


class Known(NamedTuple):
    """A scene, its exact results, and how much the rounding of the load counts in each."""

    scene: Values
    exact: Mapping[str, Exact]
    condition: Mapping[str, float]


@cache
def worst_results(count: int) -> Mapping[tuple[str, str], Worst]:
    """The worst of each result over many scenes, solved one by one and as arrays, without keeping many of them."""
    worst = dict.fromkeys(product(("float", "array"), RESULTS), Worst(0.0, {}))
    remaining = scenes(count)
    while some := list(islice(remaining, SCENES)):
        alike = defaultdict(list)
        for scene in some:
            exact = finite_results(scene)
            alike[frozenset(scene), frozenset(exact)].append(Known(scene, exact, conditions(scene, exact)))
        for (given, wanted), same in alike.items():
            arrays: Values = {name: np.array([known.scene[name] for known in same]) for name in given}
            columns = solve(wanted, **arrays)
            for row, (scene, exact, condition) in enumerate(same):
                for name, value in solve(wanted, **scene).items():
                    error = ulp_error(value, exact[name]) / (1 + condition[name])
                    if error > worst["float", name].error:
                        worst["float", name] = Worst(error, scene)
                    element = float(np.broadcast_to(columns[name], len(same))[row])
                    if element != value:
                        error = ulp_error(element, exact[name]) / (1 + condition[name])
                    if error > worst["array", name].error:
                        worst["array", name] = Worst(error, scene)
    return worst


@pytest.mark.parametrize("kind", ["float", "array"])
@pytest.mark.parametrize("name", RESULTS)
def test_result_is_accurate(name: str, kind: str) -> None:
    worst = worst_results(SCENES)[kind, name]
    assert worst.error <= BOUND, worst


@pytest.mark.slow
@pytest.mark.parametrize("count", MANY_SCENES)
@pytest.mark.parametrize("kind", ["float", "array"])
@pytest.mark.parametrize("name", RESULTS)
def test_result_of_many_scenes_is_accurate(name: str, kind: str, count: int) -> None:
    worst = worst_results(count)[kind, name]
    assert worst.error <= BOUND, worst


# --- Arrays ---------------------------------------------------------------------------------------------------------


@cache
def differences(length: int) -> Mapping[str, Worst]:
    """How far results of arrays of some length are from those of floats, over all scenes in which the same is given."""
    alike = defaultdict(list)
    for scene in scenes(FEWER_SCENES):
        alike[frozenset(scene), frozenset(finite_results(scene))].append(scene)
    worst = dict.fromkeys(RESULTS, Worst(0.0, {}))
    for (given, wanted), same in alike.items():
        for start in range(0, len(same), length):
            some = same[start : start + length]
            arrays: Values = {name: np.array([scene[name] for scene in some]) for name in given}
            columns = solve(wanted, **arrays)
            for row, scene in enumerate(some):
                for name, value in solve(wanted, **scene).items():
                    error = ulp_error(float(np.broadcast_to(columns[name], len(some))[row]), value)
                    if error > worst[name].error:
                        worst[name] = Worst(error, scene)
    return worst


@pytest.mark.parametrize("length", [1, FEWER_SCENES])
@pytest.mark.parametrize("name", RESULTS)
def test_array_agrees_with_float_to_1_ulp(name: str, length: int) -> None:
    worst = differences(length)[name]
    assert worst.error <= 1, worst


# --- Formulas -------------------------------------------------------------------------------------------------------


@cache
def parameter_values(count: int) -> Sequence[Values]:
    """Values of every parameter of every formula, of magnitudes that go together, each taken as exact."""
    random = Random(1997)
    return [dict(any_values(random, scene, exact_results(scene))) for scene in scenes(count)]


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
        ("atomic_spacing", 1e-11, 1e-8),
    ):
        yield name, log_uniform(random, low, high)
    near_1 = 1 + random.choice([-1, 1]) * log_uniform(random, 1e-15, 0.5)
    yield "contact_radius_ratio", random.choice([near_1, log_uniform(random, 1e-6, 1e6)])
    radius = float(results["contact_radius_at_load"])
    yield "contact_radius_at_load", radius
    yield "distance", radius * random.choice([random.random(), 1 - log_uniform(random, 1e-15, 1)])
    yield "half_circle_radius", radius * random.uniform(0, 2)
    approach = float(results["approach"])
    yield "approach", approach
    near_fold, near_0 = FOLD + log_uniform(random, 1e-15, 0.8), log_uniform(random, 1e-18, 0.8)
    yield "approach_at_load", approach * float(random.choice([near_fold, -near_0, near_0, log_uniform(random, 1, 1e9)]))
    force = float(results["pull_off_force"])
    yield "pull_off_force", force
    yield from scene.items()
    yield "load", force * (log_uniform(random, 1e-15, 1e6) - 1)
    if random.random() < 0.5:  # where the approach passes through zero
        yield "load_margin", near_1 / 3


# Where some formulas have no value, or state no accuracy.
OUTSIDE: Mapping[str, Callable[[Values], bool]] = {
    "load_factor_at_approach_unstable": lambda values: values["approach_at_load"] > 0,
    "stiffness": lambda values: values["load_margin"] < 0,
    "vertical_frequency": lambda values: values["stiffness"] < 0,
}


def test_every_formula_has_its_equation() -> None:
    assert EQUATIONS.keys() == FORMULAS.keys()


@pytest.mark.parametrize("name", FORMULAS)
def test_formula_is_as_accurate_as_it_says(name: str) -> None:
    formula = FORMULAS[name]
    stated = re.search(r"Accuracy: (?:(?P<exact>[Ee]xact)|(?P<ulp>[\d.]+) ulp)", formula.__doc__ or "")
    assert stated, "no number of ulp"
    bound = 0.0 if stated["exact"] else float(stated["ulp"])
    worst = worst_of_formula(name, FEWER_SCENES)
    assert worst.error <= bound, f"{worst}, {bound} stated"


@cache
def worst_of_formula(name: str, count: int) -> Worst:
    """The largest error of a formula, at arguments taken as exact."""
    parameters = inspect.signature(FORMULAS[name]).parameters
    worst = Worst(0.0, {})
    for values in parameter_values(count):
        if name in OUTSIDE and OUTSIDE[name](values):
            continue
        arguments = {parameter: values[parameter] for parameter in parameters}
        error = formula_error(name, arguments, FORMULAS[name](**arguments))
        worst = max(worst, Worst(error, arguments), key=lambda each: each.error)
    return worst
