"""How far each result and each formula is from the exact value, in units of the last place (ulp)."""

import math
import re
from collections import defaultdict
from collections.abc import Iterator, Sequence
from functools import cache
from random import Random
from typing import Any

import numpy as np
import pytest
from jkroll import FORMULAS, solve
from jkroll.scene import parameters_of
from reference import EQUATIONS, SYMBOLS, Exact, exact, exact_results, mpf, scale, ulp_error

Values = dict[str, float]

BOUND = 4.0  # ulp
SCENES = 2000
ARGUMENTS = 400

RESULTS = tuple(exact_results(dict.fromkeys(
    ("radius", "surface_energy", "youngs_modulus", "poisson_ratio", "density", "speed"), 0.5)))  # fmt: skip


def log_uniform(random: Random, low: float, high: float) -> float:
    """A number of random magnitude."""
    return math.exp(random.uniform(math.log(low), math.log(high)))


def one_sphere(random: Random) -> Values:
    """A sphere of any size and material."""
    return {
        "radius": log_uniform(random, 1e-12, 1e3),
        "surface_energy": log_uniform(random, 1e-9, 1e3),
        "youngs_modulus": log_uniform(random, 1e2, 1e14),
        "poisson_ratio": random.choice([random.uniform(-1, 0.5), 0.5, log_uniform(random, 1e-9, 1) - 1]),
        "density": log_uniform(random, 1, 1e5),
    }


def one_scene(random: Random) -> Values:
    """Two spheres, or a sphere on a plane, with or without a rigid body, load, energy or speed."""
    scene = one_sphere(random)
    kind = random.choice(["identical", "unequal", "similar", "plane", "rigid", "rigid plane"])
    if kind != "identical":
        like = {name: value * random.uniform(0.5, 2) for name, value in scene.items() if name != "poisson_ratio"}
        other = one_sphere(random) | (like if kind == "similar" else {})
        scene |= {name + "2": value for name, value in other.items()}
    if "plane" in kind:
        scene["radius2"] = math.inf
    if "rigid" in kind:
        scene["youngs_modulus2"] = math.inf
    scene["yield_displacement"] = log_uniform(random, 1e-13, 1e-3)
    scene["gravity"] = log_uniform(random, 1e-3, 1e3)
    if random.random() < 0.5:
        pull_off_force = float(exact_results(scene)["pull_off_force"])
        ratios = [random.uniform(-0.9, 1), log_uniform(random, 1e-18, 1e6), -log_uniform(random, 1e-18, 0.9)]
        scene["load"] = random.choice(ratios) * pull_off_force
    energy = random.choice(["adhesion", "energy", "speed"])
    if energy == "energy":
        scene["energy"] = log_uniform(random, 1e-30, 1e3)
    elif energy == "speed":
        scene["speed"] = log_uniform(random, 1e-9, 1e6)
    return scene


@cache
def scenes(count: int) -> Sequence[Values]:
    """The same scenes every time."""
    random = Random(1995)
    return [one_scene(random) for _ in range(count)]


@cache
def exact_scenes(count: int) -> Sequence[dict[str, Exact]]:
    """What each scene gives; not what is infinite on a plane."""
    return [
        {name: value for name, value in exact_results(scene).items() if abs(value) < math.inf}
        for scene in scenes(count)
    ]


@cache
def solved_scenes(count: int) -> Sequence[Values]:
    """What `solve` gives for each scene."""
    return [solve(wanted, **scene) for scene, wanted in zip(scenes(count), exact_scenes(count), strict=True)]


@cache
def conditions(count: int) -> Sequence[Values]:
    """By how many relative units each result moves with one of P/P_c: an error of P_c is passed on so many times."""
    step = mpf(10) ** -40
    moved = [exact_results({**scene, "load": mpf(scene.get("load", 0)) * (1 + step)}) for scene in scenes(count)]
    return [
        {name: float(abs(after[name] / value - 1) / step) for name, value in before.items() if value}
        for before, after in zip(exact_scenes(count), moved, strict=True)
    ]


def check_results(name: str, count: int) -> None:
    """Compare one result of all scenes."""
    for scene, value, condition, want in zip(
        scenes(count), solved_scenes(count), conditions(count), exact_scenes(count), strict=True
    ):
        if name in want:
            error = ulp_error(value[name], want[name]) / max(1.0, condition.get(name, 0.0))
            assert error <= BOUND, f"{error:.2f} ulp at {scene}"


@pytest.mark.parametrize("name", RESULTS)
def test_results_are_exact_to_4_ulp(name: str) -> None:
    check_results(name, SCENES)


@pytest.mark.slow
@pytest.mark.parametrize("name", RESULTS)
def test_results_of_many_scenes_are_exact_to_4_ulp(name: str) -> None:
    check_results(name, 10 * SCENES)
