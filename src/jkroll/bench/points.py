"""The points at which the benchmark measures: ordinary contacts, and those where digits are easily lost."""

from collections.abc import Mapping
from typing import Any

import numpy

from ..physics.contact import pull_off_force
from ..physics.jkr import FOLD_APPROACH
from ..physics.pair import reduced_radius

Arrays = Mapping[str, Any]
_SEED = 1997


def ordinary(count: int) -> Arrays:
    """Return grains of 10 nm to 100 µm under loads from −0.8 to 2 P_c, or at approaches from −0.8 to 3 δ0."""
    powers, uniform = _draws(count)
    radius = powers(-8, -4)
    points = {
        "radius": radius,
        "radius2": radius * powers(-1, 1),
        "work_of_adhesion": powers(-2, 0.3),
        "contact_modulus": powers(9, 11.5),
        "density": powers(3, 4),
        "yield_displacement": powers(-10, -9.3),
        "gravity": powers(-3, 1),
        "approach_at_load": uniform(-0.8, 3),
    }
    return {**_at_loads(points, uniform(-0.8, 2)), "atomic_spacing": powers(-10, -9)}


def hard(count: int) -> Arrays:
    """Return contacts near pull-off, the fold and δ = 0, at tiny and huge loads, with radii up to 1e15 times apart."""
    powers, uniform = _draws(count)
    points = {
        "radius": powers(-12, 3),
        "radius2": powers(-12, 3),
        "work_of_adhesion": powers(-6, 2),
        "contact_modulus": powers(4, 13),
        "density": powers(1, 5),
        "yield_displacement": powers(-12, -6),
        "gravity": powers(-3, 3),
    }
    sign = numpy.sign(uniform(-1, 1))
    kind = numpy.arange(count) % 4
    approaches = [FOLD_APPROACH + powers(-14, -1), sign * powers(-18, -2), powers(0, 6), powers(6, 60)]
    loads = [powers(-15, -2) - 1, -8 / 9 * (1 + sign * powers(-15, -2)), sign * powers(-18, -2), powers(0, 9)]
    points["approach_at_load"] = numpy.choose(kind, approaches)
    found = _at_loads(points, numpy.choose(kind, loads))
    strain = points["work_of_adhesion"] / points["contact_modulus"]
    reduced = reduced_radius(radius=points["radius"], radius2=points["radius2"])
    return {**found, "atomic_spacing": numpy.cbrt(reduced * strain * strain) / powers(-4, 4)}  # μ from 1e-4 to 1e4


def scenes(count: int) -> Arrays:
    """Return scenes in which everything differs, as `jkroll.solve` takes them."""
    points = ordinary(count)
    return {
        **{name: points[name] for name in ("radius", "radius2", "density", "load")},
        "surface_energy": points["work_of_adhesion"] / 2,
        "youngs_modulus": points["contact_modulus"],
        "poisson_ratio": 0.1 + 0.3 * (points["approach_at_load"] * 1000 % 1),
    }


def each(points: Arrays) -> list[dict[str, float]]:
    """Return the points as dictionaries of floats."""
    return [dict(zip(points, row, strict=True)) for row in zip(*(v.tolist() for v in points.values()), strict=True)]


def _draws(count: int) -> tuple[Any, Any]:
    """Return functions that draw numbers of any magnitude between two powers of ten, and between two numbers."""
    random = numpy.random.default_rng(_SEED)

    def powers(low: float, high: float) -> Any:
        return 10 ** random.uniform(low, high, count)

    def uniform(low: float, high: float) -> Any:
        return random.uniform(low, high, count)

    return powers, uniform


def _at_loads(points: dict[str, Any], ratio: Any) -> Arrays:
    """Return points with the pull-off force, as it is rounded, and a load that is a multiple of it."""
    reduced = reduced_radius(radius=points["radius"], radius2=points["radius2"])
    force = pull_off_force(work_of_adhesion=points["work_of_adhesion"], reduced_radius=reduced)
    load = numpy.maximum(ratio * force, -force)
    return {**points, "pull_off_force": force, "load": load, "approach": numpy.ones_like(load)}
