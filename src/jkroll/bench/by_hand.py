"""The usual quantities as a plain program would compute them: the least that `jkroll.solve` could cost."""

from collections.abc import Callable
from math import pi
from typing import Any


def by_hand(
    sqrt: Callable[[Any], Any],
    cbrt: Callable[[Any], Any],
    fmin: Callable[[Any, Any], Any],
    fmax: Callable[[Any, Any], Any],
    *,
    radius: Any,
    radius2: Any,
    surface_energy: Any,
    youngs_modulus: Any,
    poisson_ratio: Any,
    density: Any,
    load: Any,
) -> dict[str, Any]:
    """Return the usual quantities of two spheres of one material: of floats by `math`, or of arrays by numpy."""
    yield_displacement = 2e-10
    work = 2 * sqrt(surface_energy * surface_energy)
    larger = fmax(radius, radius2)
    smaller = fmin(radius, radius2)
    reduced = smaller / (1 + smaller / larger)
    pull_off_force = 3.0 / 2 * pi * work * reduced
    margin = sqrt((load + pull_off_force) / pull_off_force)
    factor = (1 + margin) / 2
    ratio = radius / radius2
    yield_moment = 4 * pull_off_force * factor * yield_displacement
    mass = 4 * pi * (radius * radius * radius) * density / 3
    mass2 = 4 * pi * (radius2 * radius2 * radius2) * density / 3
    compliance = (1 - poisson_ratio * poisson_ratio) / youngs_modulus
    modulus = 1 / (compliance + compliance)
    strain = work / modulus
    stretched = reduced * factor
    contact_radius_at_load = cbrt(9.0 / 2 * pi * strain * stretched * stretched)
    stiffness = 6 * margin / (2 + 3 * margin) * modulus * contact_radius_at_load
    lighter = fmin(mass, mass2)
    heavier = fmax(mass, mass2)
    reduced_mass = lighter / (1 + lighter / heavier)
    rolling_stiffness = 4 * pull_off_force * factor * reduced
    square = radius * radius
    square2 = radius2 * radius2
    inertia = 8 * pi * (square * square * radius) * density / 15
    inertia2 = 8 * pi * (square2 * square2 * radius2) * density / 15
    least = fmin(inertia, inertia2)
    most = fmax(inertia, inertia2)
    reduced_inertia = least / (1 + least / most)
    shrunk = strain * strain * reduced
    return {
        "pull_off_force": pull_off_force,
        "contact_radius": cbrt(9.0 / 2 * pi * strain * reduced * reduced),
        "approach": cbrt(3.0 / 4 * (pi * pi) * shrunk),
        "yield_force": 6 * pi * work * factor * yield_displacement / (1 + ratio),
        "yield_force_ratio": 4 * factor * (yield_displacement / radius),
        "yield_moment": yield_moment,
        "yield_angle": yield_displacement / reduced,
        "r_min": radius * (radius2 / yield_displacement),
        "n_grav": sqrt(yield_moment / (mass * 9.80665 * radius)),
        "vertical_frequency": sqrt(stiffness / (4 * (pi * pi) * reduced_mass)),
        "rolling_frequency": sqrt(rolling_stiffness / (4 * (pi * pi) * reduced_inertia)),
        "n_roll": cbrt(3 / (10976 * pi) * shrunk) / (yield_displacement * factor),
    }
