"""Write tests/hard_cases.toml: inputs at which double precision loses digits, with results to 60 digits.

    PYTHONPATH=tests python tests/tools/make_hard_cases.py > tests/hard_cases.toml

Nothing of `jkroll` is used, so that the results are those of the equations.
"""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

from reference import BOUND, FOLD, Exact, conditions, digits, exact, exact_results, mpf, root, scale

Inputs = Mapping[str, float]

HEADER = """\
# Inputs at which double precision loses digits. Made by
#
#   PYTHONPATH=tests python tests/tools/make_hard_cases.py > tests/hard_cases.toml
#
# The inputs of a case are doubles, taken as exact; its results have 60 digits and are met to
#
#   within  ulp (4 unless said: more where the inputs are passed on enlarged) of
#   of      another number than the result, where that is a difference: then the larger term
#   via     a function of the result, where only that is well-conditioned: the square of s = √(1 + P/P_c), which a rounding
#           of P_c moves by an ulp of 1, the cube root of x, and the approach in which x lies
"""


class Result(NamedTuple):
    """What is expected under a name."""

    name: str
    value: Exact
    within: float = BOUND
    of: Exact = None
    via: str = ""


def main() -> None:
    """Print the file."""
    print(HEADER)
    for about, inputs, results in all_cases():
        print(f'[[case]]\nabout = "{about}"')
        print("given = {", ", ".join(f"{name} = {value!r}" for name, value in inputs.items()), "}")
        for result in results:
            print(f"result.{result.name} = {{ {', '.join(entries(result))} }}")
        print()


def entries(result: Result) -> Iterator[str]:
    """A result in TOML."""
    value = digits.chop(result.value, (result.of or 0) * mpf(10) ** -100)
    yield f'is = "{digits.nstr(value, 60, min_fixed=0, max_fixed=0)}"'
    if result.within != BOUND:
        yield f"within = {result.within:.4g}"
    if result.of is not None and float(result.of) != abs(float(result.value)):
        yield f"of = {float(result.of)!r}"
    if result.via:
        yield f'via = "{result.via}"'


def all_cases() -> Iterator[tuple[str, Inputs, Iterable[Result]]]:
    """Every case: what it is about, its inputs, its results."""
    yield from cases_of_states()
    yield from cases_of_formulas()
    for about, scene in scenes():
        yield about, scene, results_of(scene)
    for scene in (QUARTZ, QUARTZ | OTHER):
        yield from ill_conditioned(scene)


def cases_of_states() -> Iterator[tuple[str, Inputs, Iterable[Result]]]:
    """The contact near pull-off, at any load, near P̂ = -8/9, near the fold and at any approach."""
    for load in loads_near_pull_off(PULL_OFF):
        yield "P -> -P_c", CONTACT | {"load": load}, at_load(CONTACT | {"load": load})
    for ratio in powers(10, range(0, 293, 20)) + powers(10, range(-300, 0, 20)):
        for sign in (1, -1) if ratio < 1 else (1,):
            inputs = CONTACT | {"load": sign * ratio * PULL_OFF}
            yield f"P/P_c = {sign * ratio:g}", inputs, at_load(inputs)
    for load in around(-8.0, powers(2, range(0, 50, 7))):
        inputs = CONTACT | {"pull_off_force": 9.0, "load": load}
        yield "P/P_c = -8/9", inputs, at_load(inputs)
    for ratio in APPROACHES:
        inputs = CONTACT | {"approach_at_load": ratio, "approach": 1.0}
        yield f"approach {ratio:.6g}", inputs, at_approach(inputs)


def cases_of_formulas() -> Iterator[tuple[str, Inputs, Iterable[Result]]]:
    """Single formulas where two of their terms cancel."""
    for near_1 in around(1.0, powers(2, range(0, 53, 4))):
        inputs = {"contact_radius_ratio": near_1}
        yield "a/a0 = 1", inputs, [formula(name, inputs) for name in ("load_ratio", "approach_ratio")]
        inputs = {"load_factor": near_1, "pull_off_force": PULL_OFF}
        yield "x = 1", inputs, [formula("load_at_factor", inputs)]
    for nu in (*around(-1.0, [1, 2, 1e6, 1e12]), *around(0.5, [1, 2, 1e6]), *around(-0.5, [1, 2, 1e6]), 1e-9, 0.0):
        if -1 < nu <= 0.5:
            inputs = {"youngs_modulus": 1e9, "poisson_ratio": nu, "youngs_modulus2": math.inf, "poisson_ratio2": 0.3}
            yield "1 - nu^2", inputs, [formula("contact_modulus", inputs)]


def ill_conditioned(scene: Inputs) -> Iterator[tuple[str, Inputs, Iterable[Result]]]:
    """A scene near pull-off and near the fold, where the rounding of P_c and of δ0 is passed on enlarged."""
    alone = exact_results(scene)
    for load in loads_near_pull_off(float(alone["pull_off_force"]))[3:]:
        inputs = {**scene, "load": load}
        margin = exact_results(inputs)["load_margin"]
        yield "P -> -P_c of a scene", inputs, [Result("load_margin", margin**2, of=1, via="square")]
    for distance in (1e-14, 1e-12, 1e-9, 1e-6, 1e-3):
        inputs = {**scene, "approach_at_load": float(alone["approach"]) * (float(FOLD) + distance)}
        ratio = inputs["approach_at_load"] / alone["approach"]
        yield "the fold of a scene", inputs, [Result("load_factor_at_approach", ratio, via="approach ratio")]


# --- The contact, of given P, P_c, w, R, E* ---------------------------------------------------------------------------

PULL_OFF = 1.1780972450961724e-08
CONTACT = {
    "work_of_adhesion": 0.05, "reduced_radius": 5e-8, "contact_modulus": 2.78e10, "pull_off_force": PULL_OFF,
    "yield_displacement": 2e-10, "radius_ratio": 1.0, "reduced_mass": 1e-17, "rolling_mass": 3e-17,
}  # fmt: skip
FOLLOWS_FROM_STATE = (
    "contact_radius_at_load", "stiffness", "hertz_pressure", "boussinesq_pressure", "yield_moment", "rolling_stiffness",
    "yield_force", "vertical_frequency", "rolling_frequency_no_slip", "displacement_limit",
)  # fmt: skip
APPROACHES = (
    *(float(FOLD) + step * 2.0**-53 for step in (1, 2, 3, 10, 1e3, 1e6, 1e9, 1e12, 1e15)),
    *(sign * 10.0**-power for power in (1, 2, 5, 10, 20, 50, 100) for sign in (-1, 1)),
    -0.5503212081491046, -0.5503212081491045, 0.8254818122236567, 0.8254818122236568,  # excess = 0.5, 3
    *(1 + step * 2.0**-52 for step in (-1e6, -1, 0, 1, 1e6)),
    *(10.0**power for power in (1, 3, 10, 30, 100, 200)),
)  # fmt: skip


def powers(base: float, exponents: Iterable[int]) -> list[float]:
    """Powers of a number."""
    return [float(base) ** exponent for exponent in exponents]


def around(value: float, steps: Sequence[float]) -> list[float]:
    """A double and those that are so many steps from it on either side."""
    return [value + sign * step * math.ulp(value) for step in (0, *steps) for sign in (-1, 1)][1:]


def loads_near_pull_off(force: float) -> list[float]:
    """Tensions from the next to the pull-off force down to half of it."""
    return [-force + step * math.ulp(force) for step in (1, 2, 3, 10, *powers(10, range(2, 16)))]


def formula(name: str, inputs: Inputs) -> Result:
    """A result that is measured as its formula is."""
    return Result(name, exact(name, inputs), of=scale(name, inputs))


def at_load(inputs: Inputs) -> Iterator[Result]:
    """The state at a load, and what follows from it."""
    yield from (formula(name, inputs) for name in ("load_margin", "load_factor", "load_over_pull_off"))
    if inputs["load"] < 0:
        yield Result("load_factor_at_load_unstable", exact("load_factor_at_load_unstable", inputs))
    yield from (Result(name, exact(name, inputs)) for name in FOLLOWS_FROM_STATE)
    x = exact("load_factor", inputs)
    larger = exact("approach", inputs) * max(3 * digits.cbrt(x) ** 4, 2 * digits.cbrt(x))
    yield Result("approach_at_load", exact("approach_at_load", inputs), of=larger)


def at_approach(inputs: Inputs) -> Iterator[Result]:
    """The states at an approach, and what follows from the stable one."""
    ratio = mpf(inputs["approach_at_load"]) / inputs["approach"]
    x = root(ratio) ** 3
    yield Result("load_factor_at_approach", digits.cbrt(x), via="cube root")
    if ratio <= 0:
        yield Result("load_factor_at_approach_unstable", root(ratio, stable=False), via="cube root")
    yield Result("load_margin_of_factor", 2 * x - 1, of=2 * x)
    yield Result(
        "load_at_factor", exact("load_at_factor", {**inputs, "load_factor": x}), of=4 * PULL_OFF * max(x, x * x)
    )
    state = {**inputs, "load_factor": x, "load_margin": 2 * x - 1}
    for name in FOLLOWS_FROM_STATE:
        if name not in ("stiffness", "vertical_frequency"):  # which vanish at pull-off, and are infinite at the fold
            yield Result(name, exact(name, state))


# --- Scenes of any size and material ----------------------------------------------------------------------------------

QUARTZ = {"radius": 1e-7, "surface_energy": 0.025, "youngs_modulus": 54e9, "poisson_ratio": 0.17, "density": 2600.0}
OTHER = {
    "radius2": 3.7e-6, "surface_energy2": 3.0, "youngs_modulus2": 210e9, "poisson_ratio2": 0.27, "density2": 7700.0,
}  # fmt: skip
RANGES: Mapping[str, Sequence[float]] = {
    "radius": (1e-12, 1e-9, 1e3), "radius2": (1e-12, 1e3, math.inf), "surface_energy": (1e-9, 1e3),
    "surface_energy2": (1e-9, 1e3), "youngs_modulus": (1e2, 1e14), "youngs_modulus2": (1e2, 1e14, math.inf),
    "poisson_ratio": (-1.0, -1 + 2.0**-53, -0.5, 0.0, 0.5), "poisson_ratio2": (-1 + 2.0**-53, 0.5),
    "density": (1.0, 1e5), "yield_displacement": (1e-13, 1e-3), "gravity": (1e-3, 1e3),
}  # fmt: skip


def scenes() -> Iterator[tuple[str, Inputs]]:
    """Each input at the ends of its range, radii up to 1e15 apart, and level chains of any number."""
    for name, values in RANGES.items():
        for value in values:
            yield f"{name} = {value!r}", {**QUARTZ, **OTHER, name: value}
    for radius, radius2 in ((1e-12, 1e3), (1e3, 1e-12), (1e-12, 1e-12), (1e3, 1e3), (1e3, math.inf)):
        for load in (0.0, 0.7, -0.7):
            scene = {**QUARTZ, **OTHER, "radius": radius, "radius2": radius2}
            force = load * float(exact_results(scene)["pull_off_force"])
            yield f"R1 = {radius!r}, R2 = {radius2!r}, P/P_c = {load}", {**scene, "load": force}
    soft = {
        **QUARTZ,
        "surface_energy": 1e3,
        "yield_displacement": 1e-3,
        "density": 1.0,
        "radius": 1e-9,
        "gravity": 1e-3,
    }
    hard = {
        **QUARTZ,
        "surface_energy": 1e-9,
        "yield_displacement": 1e-13,
        "density": 1e5,
        "radius": 1e3,
        "gravity": 1e3,
    }
    yield "N_grav far above 1e12", soft
    yield "N_grav far below 1", hard


def results_of(scene: Inputs) -> Iterator[Result]:
    """All results of a scene, of the paper's quantities."""
    results = exact_results(scene)
    condition = conditions(scene, results)
    for name, value in results.items():
        if 0 < abs(value) < math.inf:
            yield Result(name, value, within=BOUND * (1 + condition[name]))


if __name__ == "__main__":
    main()
