"""The distance of results and formulas from the exact value, in units of the last place (ulp)."""

import math
import os
import subprocess
import sys
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache
from pathlib import Path
from random import Random
from statistics import median
from typing import Any, NamedTuple

import numpy as np
import pytest

import law_reference
from jkroll import NOMENCLATURE, physics, solve
from jkroll.model.plan import formula_of, parameters_of
from jkroll.physics import any_law, cylinder, dmt, dugdale, maugis, meniscus, shifted, sneddon, sphere
from jkroll.physics.accuracy import accuracy_of
from jkroll.physics.meniscus import WIDEST
from jkroll.physics.motion import FITTED_UP_TO
from reference import (
    BOUND,
    EQUATIONS,
    FOLD,
    MEDIAN,
    MEDIAN_OF_A_NAME,
    SYMBOLS,
    conditions,
    exact_results,
    formula_error,
    inputs_of,
    ulp_error,
)
from scenes import (
    OF_HARD_SCENES,
    Scene,
    hard_approaches,
    hard_loads,
    hard_scenes,
    log_uniform,
    near_example,
    random_scenes,
    strip_contacts,
)

pytestmark = pytest.mark.filterwarnings("error")  # including those of numpy

FORMULAS = {
    **physics.FORMULAS,
    **{
        name: function
        for module in (cylinder, shifted)
        for name, function in vars(module).items()
        if getattr(function, "__module__", None) == module.__name__
    },
}
FEW, FEW_ROOTS, COUNT, MANY = 20, 5, 100, 20_000
HERE = Path(__file__).parent


# --- Results ----------------------------------------------------------------------------------------------------------


class Error(NamedTuple):
    """The error of a result, and the scene in which it occurs."""

    ulp: float  # over 1 + its condition: the larger of the errors of the number and of the element of an array
    of_number: float  # likewise, of the number alone
    scene: Scene


def errors_of(scenes: Iterable[Scene]) -> dict[str, list[Error]]:
    """Return the errors of results, computed scene by scene, and as arrays of all scenes with the same inputs."""
    groups = defaultdict(list)  # by inputs and results
    for scene in scenes:
        exact = {name: value for name, value in exact_results(scene).items() if abs(value) < math.inf}
        groups[frozenset(scene), frozenset(exact)].append((scene, exact, conditions(scene, exact)))
    by_name: dict[str, list[Error]] = {}
    for (given, wanted), group in groups.items():
        arrays: Scene = {name: np.array([scene[name] for scene, _, _ in group]) for name in given}
        columns = solve(wanted, **arrays)
        for row, (scene, exact, condition) in enumerate(group):
            for name, value in solve(wanted, **scene).items():
                element = float(np.broadcast_to(columns[name], len(group))[row])
                errors = [ulp_error(each, exact[name]) / (1 + condition[name]) for each in (value, element)]
                by_name.setdefault(name, []).append(Error(max(errors), errors[0], scene))
    return by_name


@cache
def errors_of_kind(kind: str) -> dict[str, list[Error]]:
    """Return the errors of random scenes, or of every third hard one."""
    return errors_of(random_scenes(FEW, seed=1995) if kind == "random" else [*hard_scenes(float(FOLD))][::3])


def worst(errors: Iterable[Error]) -> Error:
    """Return the largest error."""
    return max(errors, key=lambda error: error.ulp)


# Formulas with parameters from `law_values`; those of other formulas are from `parameter_values`.
LAWS = {module.__name__ for module in (any_law, dmt, maugis, meniscus, sphere)}
LAW_FORMULAS = {
    *(name for name, formula in physics.FORMULAS.items() if formula.__module__ in LAWS),
    "viscosity_number",
    "sticking_speed_viscous",
}
RESULTS = [
    name for name in NOMENCLATURE if (formula := formula_of(name)) is not None and formula.__name__ not in LAW_FORMULAS
]
HARD = [name for name in RESULTS if inputs_of(name) <= OF_HARD_SCENES]
CASES = [*((name, "random") for name in RESULTS), *((name, "hard") for name in HARD)]


@pytest.mark.parametrize(("name", "kind"), CASES)
def test_result_is_within_the_bound(name: str, kind: str) -> None:
    errors = errors_of_kind(kind)
    assert name in errors, f"no {kind} scene of tests/scenes.py leads to {name}: draw its inputs there"
    assert worst(errors[name]).ulp <= BOUND, worst(errors[name])


def test_a_symbol_means_the_same_quantity_in_all_equations() -> None:
    assert all(SYMBOLS[symbol] == name for symbol, name in law_reference.SYMBOLS.items())


def test_the_median_error_of_all_results_is_within_its_bound() -> None:
    errors = errors_of_kind("random")
    assert median(error.of_number for name in RESULTS for error in errors[name]) <= MEDIAN


@pytest.mark.slow
def test_results_of_every_hard_scene_are_within_the_bound() -> None:
    errors = errors_of(hard_scenes(float(FOLD)))
    for name in HARD:
        assert worst(errors[name]).ulp <= BOUND, (name, worst(errors[name]))


@pytest.mark.slow
def test_results_of_fresh_scenes_are_within_the_bounds() -> None:
    """The header of the run states the seed; setting ACCURACY_SEED to this number repeats the scenes."""
    errors = errors_of(random_scenes(MANY, seed=int(os.environ["ACCURACY_SEED"])))
    for name in RESULTS:
        assert worst(errors[name]).ulp <= BOUND, (name, worst(errors[name]))
        typical = median(error.of_number for error in errors[name])
        assert typical <= MEDIAN_OF_A_NAME, (name, typical)
    assert median(error.of_number for name in RESULTS for error in errors[name]) <= MEDIAN


# --- Formulas ---------------------------------------------------------------------------------------------------------


@cache
def parameter_values(count: int) -> list[Scene]:
    """Return values of the parameters of formulas that are not in LAW_FORMULAS, by scene, each taken as exact."""
    random = Random(1997)
    return [dict(_values(random, scene)) for scene in random_scenes(count, seed=1998)]


def test_values_are_the_same_in_every_process() -> None:
    """The order of a set of names differs between processes; the numbers drawn for each name must not."""
    code = "import test_accuracy as test; print(dict(test._values(test.Random(1), *test.random_scenes(1, seed=1))))"
    paths = os.pathsep.join(filter(None, [*map(str, (HERE, HERE.parent)), os.environ.get("PYTHONPATH", "")]))
    environment = os.environ | {"PYTHONHASHSEED": "1", "PYTHONPATH": paths}
    ran = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True)
    assert ran.stdout == f"{dict(_values(Random(1), *random_scenes(1, seed=1)))}\n"


def _values(random: Random, scene: Scene) -> Iterator[tuple[str, Any]]:
    for name in ("radius", "surface_energy", "youngs_modulus", "poisson_ratio", "density"):
        yield name + "2", scene.get(name + "2", scene[name])
    results = {name: float(value) for name, value in exact_results(scene).items()}
    yield from ((name, value * random.uniform(1, 2)) for name, value in results.items())
    for name, low, high in (
        ("energy", 1e-30, 1e3),
        ("energy_ratio", 1e-6, 1e6),
        ("speed", 1e-9, 1e6),
        ("atomic_spacing", 1e-11, 1e-8),
        ("shear_strength", 1e3, 1e12),
        ("impact_pressure", 1e3, 1e12),
        ("contacts", 1, 1e12),
    ):
        yield name, log_uniform(random, low, high)
    radius, force, approach = (results[name] for name in ("contact_radius_at_load", "pull_off_force", "approach"))
    yield "contact_radius_at_load", radius
    distance = radius * random.choice([random.random(), 1 - log_uniform(random, 1e-15, 1)])
    yield "distance", distance
    yield "position_in_circle", random.choice([-1, 1]) * distance
    yield "half_circle_radius", radius * random.uniform(1, 2)
    yield from scene.items()
    yield "approach", approach
    yield "approach_at_load", random.choice([*hard_approaches(approach, float(FOLD))])
    yield "pull_off_force", force
    load = random.choice([*hard_loads(force), *(force * (log_uniform(random, 1e-15, 1e6) - 1) for _ in range(20))])
    yield "load", load
    if load >= -force:
        is_beyond_pull_off = -0.9 * force < load < -1e-6 * force and random.random() < 0.3
        yield "load_margin", (-1 if is_beyond_pull_off else 1) * math.sqrt((load + force) / force)


def _damped(random: Random) -> Iterator[tuple[str, Any]]:
    """Iterate over values of grains with viscous damping or an asperity."""
    for name, low, high in (
        ("viscous_time", 1e-15, 1e-6), ("reduced_mass", 1e-24, 1.0), ("sticking_energy", 1e-27, 1.0),
        ("asperity_radius", 1e-12, 1e-3),
        ("pull_off_force_dmt", 1e-12, 1e3), ("poisson_ratio", 1e-6, 0.5), ("poisson_ratio2", 1e-6, 0.5),
    ):  # fmt: skip
        yield name, log_uniform(random, low, high)
    yield (
        "viscosity_number",
        random.choice([log_uniform(random, 1e-20, FITTED_UP_TO), random.uniform(0, FITTED_UP_TO), FITTED_UP_TO]),
    )


def _wet(random: Random) -> Iterator[tuple[str, Any]]:
    """Iterate over values of a meniscus of water, also near dry and saturated air, and near a contact angle of 90°."""
    yield "humidity", random.choice([random.random(), log_uniform(random, 1e-30, 1), 1 - log_uniform(random, 1e-15, 1)])
    yield "contact_angle", random.choice([0.0, random.uniform(0, 1.57), math.pi / 2 - log_uniform(random, 1e-9, 1)])
    yield "kelvin_radius", log_uniform(random, 1e-11, 1e-5)
    yield "roughness_gap", log_uniform(random, 1e-10, 1e-6)
    yield "meniscus_size", random.choice([random.uniform(0, WIDEST), log_uniform(random, 1e-9, WIDEST), WIDEST])


def _of_sphere(random: Random, modulus: float) -> Iterator[tuple[str, Any]]:
    """Iterate over values of a rigid sphere on a soft plane, of any softness and in any state."""
    radius, ratio = log_uniform(random, 1e-9, 1e3), log_uniform(random, 1e-15, 10)
    last, fold = sneddon.last_state(ratio, 0.0, 1.0), sneddon.last_state(ratio, 1.0, 0.0)
    yield from (("radius2", math.inf), ("youngs_modulus", math.inf), ("youngs_modulus2", modulus))
    yield from (("poisson_ratio2", random.uniform(0.45, 0.5)), ("indenter_radius", radius))
    yield from (("elastoadhesive_ratio", ratio), ("artanh_at_pull_off", last), ("artanh_at_fold", fold))
    yield "unloaded_artanh", sneddon.state_at(0.0, ratio, last, 0.0, 1.0)
    yield "contact_artanh", random.choice([last, fold * (1 + log_uniform(random, 1e-6, 10))])


@cache
def law_values(count: int) -> list[Scene]:
    """Return values of every parameter of LAW_FORMULAS, by scene, each taken as exact."""
    random = Random(1992)
    return [dict(_law_values(random)) for _ in range(count)]


def _law_values(random: Random) -> Iterator[tuple[str, Any]]:
    """Iterate over values of a contact between JKR and DMT, in any state, also near pull-off and the fold."""
    ranges = ((1e-9, 1e3), (1e-12, 1e3), (1e2, 1e14))
    work, radius, modulus = (log_uniform(random, low, high) for low, high in ranges)
    transition = log_uniform(random, *random.choice([(1e-6, 1e6), (0.1, 10)]))
    force, length = math.pi * work * radius, (3 / 4 * math.pi * work * radius**2 / modulus) ** (1 / 3)
    at_pull_off, at_fold = dugdale.pull_off_ratio(transition), dugdale.fold_ratio(transition)
    at = dugdale.Shape(at_pull_off)
    tension = -dugdale.load(transition, at, dugdale.span(transition, at))
    depth = -dugdale.lowest_approach(transition, at_fold)
    nearly = 1 - log_uniform(random, 1e-13, 1)
    beyond = log_uniform(random, 1e-6, 1e6)
    stress = 2 * modulus * length * transition / (3 * radius)
    for name, unit in (
        ("contact_radius", length), ("contact_radius_at_load", length), ("zone_span", length), ("zone_radius", length),
        ("yield_displacement", length), ("atomic_spacing", length), ("radius", radius),
        ("yield_moment", force * length),
        ("yield_force", force), ("pull_off_force", force), ("adhesive_force", force), ("load_factor", 1.0),
        ("rolling_stiffness", force * radius), ("rolling_mass", radius**3), ("adhesion_hysteresis", work / 1e3),
        ("tabor_parameter", transition), ("cohesive_stress", stress),
    ):  # fmt: skip
        yield name, unit * log_uniform(random, 1e-3, 1e3)
    yield from _damped(random)
    yield from _wet(random)
    yield from _of_sphere(random, modulus)
    for name, low, high in (("hamaker", 1e-24, 1e-15), ("hamaker2", 1e-24, 1e-15), ("cutoff", 1e-11, 1e-8)):
        yield name, log_uniform(random, low, high)
    yield "hysteresis_fraction", log_uniform(random, 1e-6, 1)
    yield "work_of_adhesion", work
    yield "reduced_radius", radius
    yield "contact_modulus", modulus
    yield "transition_parameter", transition
    yield "length_unit_maugis", length
    yield "approach_unit_maugis", length**2 / radius
    yield "energy_unit_maugis", force * length**2 / radius
    yield "unloaded_edge_ratio", dugdale.unloaded_ratio(transition)
    yield "edge_ratio_at_pull_off", at_pull_off
    yield "edge_ratio_at_fold", at_fold
    yield "pull_off_force_maugis", tension * force
    yield "fold_approach_maugis", -depth * length**2 / radius
    yield "unloaded_radius_maugis", length * log_uniform(random, 1e-3, 1e3)
    yield "edge_ratio", random.choice([0.0, log_uniform(random, 1e-6, 1e6), log_uniform(random, 0.1, 10)])
    yield "load", random.choice([0.0, -tension * nearly, -log_uniform(random, 1e-9, 1), beyond]) * force
    yield "approach_at_load", random.choice([0.0, -depth * nearly, beyond]) * length**2 / radius


def values_of(name: str, count: int) -> list[Scene]:
    """Return values of a formula's parameters, by scene; inputs that no scene has are drawn near their examples."""
    random = Random(1999)
    inputs = [each for each in parameters_of(FORMULAS[name]) if each in NOMENCLATURE and NOMENCLATURE[each].example]
    return [{each: near_example(each, random) for each in inputs} | values for values in _scenes_of(name, count)]


def _scenes_of(name: str, count: int) -> list[Scene]:
    if FORMULAS[name].__module__ == cylinder.__name__ or name == "unloaded_half_width":
        return strip_contacts(count)
    return law_values(count) if name in LAW_FORMULAS else parameter_values(count)


# The worst of thousands of arguments: each had an error beyond the accuracy that was then stated. The force that slides
# or peels was computed as a square, which doubles a rounding error.
WORST: list[tuple[str, Scene]] = [
    (
        "sliding_or_peeling_force",
        {"peeling_force": force, "peeling_over_sliding": over_sliding, "load_margin": margin},
    )
    for force, over_sliding, margin in (
        (5.53586010193335e-10, 106.7951333920412, 0.3333333333333332),
        (5.87412157386496e-11, 27147237.02667455, 0.5),
        (3.754935088915386e-06, 193.5472880087035, 1.7515345417267123),
    )
] + [
    (
        "yield_force_fixed_load",
        {
            "yield_moment": 2.42939655546983e-22, "radius": 7.558131428530625e-11, "load": -5.190169961490415e-10,
            "yield_displacement": 2.884315197750161e-13, "radius2": 6.357973710121904e-11,
        },
    ),
    (
        "contact_radius_dmt",
        {
            "load": -0.0037961408634774652, "work_of_adhesion": 0.0003301677156294005,
            "reduced_radius": 1.896060693301489, "contact_modulus": 57968489180.257614,
        },
    ),
    (
        "pull_off_work_at_dead_load_maugis",
        {
            "unloaded_edge_ratio": dugdale.unloaded_ratio(11.197136002240875),
            "edge_ratio_at_pull_off": dugdale.pull_off_ratio(11.197136002240875),
            "energy_unit_maugis": 1e-18, "transition_parameter": 11.197136002240875,
        },
    ),
]  # fmt: skip


@pytest.mark.parametrize(("name", "given"), WORST)
def test_formula_is_as_accurate_as_stated_at_the_worst_arguments(name: str, given: Scene) -> None:
    assert formula_error(name, given, float(FORMULAS[name](**given))) <= float(accuracy_of(name).partition(" ulp")[0])


# Arguments for which some formulas have no value, or state no accuracy.
OUTSIDE: Mapping[str, Callable[[Scene], bool]] = {
    "load_margin": lambda values: values["load"] < -values["pull_off_force"],
    "stiffness": lambda values: values["load_margin"] < 0,
    "vertical_frequency": lambda values: values["stiffness"] < 0,
    "rolling_resistance_coefficient": lambda values: values["load"] <= 0,
    "peeling_force": lambda values: values["load_margin"] < 0,
    "peeling_radius": lambda values: values["load_margin"] < 0,
    "yield_speed": lambda values: values["first_yield_pressure"] <= values["touch_pressure"],
    "plastic_speed": lambda values: values["plastic_pressure"] <= values["touch_pressure"],
    "peeling_over_sliding": lambda values: "peeling_force" not in values,
    "sliding_or_peeling_force": lambda values: "peeling_force" not in values or values["load_margin"] < 0,
    "rolling_over_sliding": lambda values: "sliding_or_peeling_force" not in values,
    "contact_radius_dmt_at_approach": lambda values: values["approach_at_load"] < 0,
    "artanh_at_load": lambda values: (
        values["load"]
        < values["contact_modulus"]
        * values["indenter_radius"] ** 2
        * sneddon.load(values["elastoadhesive_ratio"], values["artanh_at_pull_off"])
    ),
    "artanh_at_approach": lambda values: (
        values["approach_at_load"]
        < values["indenter_radius"] * sneddon.approach(values["elastoadhesive_ratio"], values["artanh_at_fold"])
    ),
    "zone_span": lambda values: values["edge_ratio"] == 0,
    "approach_maugis_at_load": lambda values: values["edge_ratio"] == 0,
    "contact_displacement_maugis": lambda values: values["edge_ratio"] == 0,
}


# Formulas of states that are roots of equations; their exact values take longest to compute.
OF_ROOTS = [
    name
    for name in LAW_FORMULAS
    if not {"transition_parameter", "elastoadhesive_ratio"}.isdisjoint(parameters_of(FORMULAS[name]))
]


@pytest.mark.parametrize("name", FORMULAS)
def test_formula_is_as_accurate_as_stated(name: str) -> None:
    check_accuracy_in(name, values_of(name, FEW)[: FEW_ROOTS if name in OF_ROOTS else FEW])


@pytest.mark.slow
@pytest.mark.parametrize("name", FORMULAS)
def test_formula_is_as_accurate_as_stated_in_every_scene(name: str) -> None:
    check_accuracy_in(name, values_of(name, COUNT))


def check_accuracy_in(name: str, values_of_scenes: Iterable[Scene]) -> None:
    """Check the accuracy of a formula in scenes, for floats and for arrays."""
    formula, parameters = FORMULAS[name], parameters_of(FORMULAS[name])
    bound = float(accuracy_of(name).partition(" ulp")[0])
    scenes = [values for values in values_of_scenes if name not in OUTSIDE or not OUTSIDE[name](values)]
    absent = {parameter for values in scenes for parameter in parameters if parameter not in values}
    assert not absent, f"neither tests/scenes.py nor test_accuracy.py has values of {absent}"
    arguments = [{parameter: values[parameter] for parameter in parameters} for values in scenes]
    elements = formula(**{parameter: np.array([given[parameter] for given in arguments]) for parameter in parameters})
    for given, element in zip(arguments, elements.tolist(), strict=True):
        for value in {formula(**given), element}:  # a single value where the two agree
            error = formula_error(name, given, value)
            assert error <= bound, f"{error} ulp, {bound} stated in physics/accuracy.py, at {given}"


# --- Completeness -----------------------------------------------------------------------------------------------------


def test_every_formula_has_its_independent_equation() -> None:
    assert EQUATIONS.keys() == FORMULAS.keys()


def test_every_result_of_the_nomenclature_has_its_exact_value() -> None:
    assert set(RESULTS) <= errors_of_kind("random").keys()
