"""Pairs of unknowns compared with a dense scan, which is refined where both quantities cross their measured values."""

import math
from random import Random
from typing import Any

import numpy
import pytest

from frames import outcomes
from jkroll.errors import JkrollError
from jkroll.model.frame import Frame
from jkroll.model.inverse import Inverse
from jkroll.model.unknowns import SIZES, NoDependence, NoSolution, SeveralSolutions, Unseparated
from jkroll.quantities.laws import MODELS
from scenes import log_uniform

PER_DECADE = 10  # values of the dense scan; its cells end at other values than those of the program
PARTS = 5  # number of parts into which each side of a cell is divided
ROUNDS = 12  # number of divisions, after which a cell is 4e-9 times as wide
MANY = 3000  # most cells in which both quantities cross their values; more cells form a curve, not points
SPANS = {
    "surface_energy": (1e-3, 1.0), "youngs_modulus": (1e6, 1e12), "radius": (1e-8, 1e-3),
    "yield_displacement": (1e-11, 1e-8)
}  # fmt: skip
QUANTITIES = (
    "pull_off_force", "contact_radius", "contact_radius_at_load", "approach", "approach_at_load", "stiffness",
    "hertz_pressure",
    "tangential_stiffness", "sliding_force", "yield_force", "yield_moment", "vertical_frequency", "rolling_frequency",
    "tabor_parameter", "well_energy", "sticking_energy", "sticking_speed", "r_min", "n_grav",
)  # fmt: skip


def sides(scene: Frame, names: tuple[str, ...], measured: dict[str, float], points: Any) -> Any:
    """Return, for each quantity, 1 above its measured value, −1 below it, 0 at it, and nan where it has no value."""
    quantities = outcomes(scene.replace(**dict(zip(names, points, strict=True))), [*measured])
    rows = []
    for name, level in measured.items():
        value = quantities[name]
        side = numpy.nan if isinstance(value, JkrollError) else numpy.sign(value - level)
        rows.append(numpy.broadcast_to(side, points.shape[1:]))
    return numpy.array(rows)


def scanned(names: tuple[str, ...], measured: dict[str, float], scene: Frame) -> list[tuple[float, ...]] | None:
    """Return the pairs that a dense scan finds, some of them several times; None if it finds a curve."""
    axes = []
    for name in names:
        least, most = SIZES[name]
        sizes = numpy.geomspace(least, most, round(PER_DECADE * math.log10(most / least)) + 3)
        axes.append(numpy.concatenate([-sizes[::-1], sizes]) if name == "load" else sizes)
    low = numpy.array([axis.ravel() for axis in numpy.meshgrid(*(axis[:-1] for axis in axes), indexing="ij")])
    high = numpy.array([axis.ravel() for axis in numpy.meshgrid(*(axis[1:] for axis in axes), indexing="ij")])
    parts = numpy.arange(PARTS) / PARTS
    for _ in range(ROUNDS):
        corners = [numpy.array([x, y]) for x in (low[0], high[0]) for y in (low[1], high[1])]
        signs = numpy.array([sides(scene, names, measured, corner) for corner in corners])
        passes = (signs.min(axis=0) < signs.max(axis=0)).all(axis=0)
        low, high = low[:, passes], high[:, passes]
        if not low.size:
            return []
        if low.shape[1] > MANY:
            return None
        width = (high - low)[:, :, None, None]
        grid = numpy.array(numpy.meshgrid(parts, parts, indexing="ij"))[:, None]
        low = low[:, :, None, None] + width * grid
        high = (low + width / PARTS).reshape(2, -1)
        low = low.reshape(2, -1)
    return [tuple(pair) for pair in ((low + high) / 2).T.tolist()]


def is_near(one: tuple[float, ...], other: tuple[float, ...]) -> bool:
    """Return whether two pairs are the same within the resolution of the scan."""
    return all(math.isclose(a, b, rel_tol=1e-4, abs_tol=1e-14) for a, b in zip(one, other, strict=True))


def solved(names: tuple[str, ...], measured: dict[str, float], scene: Frame) -> list[tuple[float, ...]] | None:
    """Return the pairs that the program finds; None if it refuses quantities that do not determine both unknowns."""
    try:
        inverse = Inverse(names, measured, scene)
        return [tuple(inverse[name] for name in names)]
    except SeveralSolutions as error:
        return [tuple(pair.values()) for pair in error.values]
    except NoSolution:
        return []
    except (NoDependence, Unseparated):
        return None


def compared(random: Random) -> str:
    """Return the outcome of a random problem.

    Fails if the program misses a pair that the scan finds, names a pair that is not a solution, or gives another answer
    if the measured quantities change places.
    """
    given: dict[str, Any] = {name: log_uniform(random, *span) for name, span in SPANS.items()}
    given |= {"radius2": math.inf, "poisson_ratio": 0.2, "density": 2e3, "shear_strength": 1e7, "atomic_spacing": 4e-10}
    law = random.choice([*MODELS])
    given["load"] = random.uniform(-0.9, 3) * Frame(given, model=law)["pull_off_force"]
    names = tuple(random.sample([*SPANS, "load"], 2))
    if random.random() < 0.3:
        given["radius2"] = log_uniform(random, 1e-8, 1e-3)
    values = Frame(given, model=law).numbers(*random.sample(QUANTITIES, 2))
    measured = {name: float(value) for name, value in values.items()}
    if len(measured) < 2:
        return "not in this law"
    scene = Frame({name: value for name, value in given.items() if name not in names}, model=law)
    pairs = solved(names, measured, scene)
    backwards = solved(names, dict(reversed(measured.items())), scene)
    problem = (law, names, measured, given)
    assert (pairs is None) == (backwards is None), problem
    if pairs is None or backwards is None:
        return "unseparated"
    assert len(pairs) == len(backwards), problem
    assert all(is_near(*both) for both in zip(pairs, backwards, strict=True)), problem
    for pair in pairs:
        forward = scene.replace(**dict(zip(names, pair, strict=True))).numbers(*measured)
        assert all(math.isclose(forward[name], level, rel_tol=1e-11) for name, level in measured.items()), (
            problem,
            pair,
        )
    expected = scanned(names, measured, scene)
    for pair in expected or [tuple(given[name] for name in names)]:  # without pairs by the scan, only the known one
        assert any(is_near(pair, other) for other in pairs), (problem, pairs, pair)
    return "several" if len(pairs) > 1 else "one"


@pytest.mark.parametrize(("count", "seed"), [(10, "few"), pytest.param(800, "many", marks=pytest.mark.slow)])
def test_pairs_are_those_of_a_dense_scan_whichever_quantity_comes_first(count: int, seed: str) -> None:
    random = Random(seed)
    results = [compared(random) for _ in range(count)]
    assert results.count("one") > count / 3
    if count > 100:
        assert results.count("several") > 4
