"""Force curves for tests of the fit, computed from formulas that the fit does not use."""

from math import pi
from typing import Any

import numpy
from numpy import cbrt, sqrt

from jkroll.fitting.branches import LOADING, UNLOADING


def jkr_state(x: Any, w: Any, modulus: Any, radius: Any) -> Any:
    """Return approach and load of JKR's paraboloid at x = (a/a0)^(3/2), from Eqs (5) and (6) of the paper."""
    unloaded = cbrt(9 * pi * w * radius**2 / (2 * modulus))
    force = 1.5 * pi * w * radius
    approach = force / (modulus * unloaded)
    return approach * (3 * x ** (4 / 3) - 2 * cbrt(x)), 4 * force * (x * x - x)


def jkr_force(z: Any, w: Any, modulus: Any, radius: Any, stiffness: Any, *, has_contact_below: bool = True) -> Any:
    """Return the force of a lever at travels `z` from the contact point, from a table of states; 0 without contact.

    `has_contact_below`: True if the contact lasts below the contact point until the lever jumps off, as in unloading.
    """
    x = numpy.geomspace(1 / 6, 500, 20_000)
    approach, load = jkr_state(x, w, modulus, radius)
    travel = approach + load / stiffness
    last = int(numpy.argmin(travel))
    force = numpy.interp(z, travel[last:], load[last:])
    return numpy.where(z < (travel[last] if has_contact_below else 0.0), 0.0, force)


def dmt_force(z: Any, w: Any, modulus: Any, radius: Any, stiffness: Any) -> Any:
    """Return the force of a lever by DMT; 0 without contact."""
    approach = numpy.linspace(0, 3 * max(z.max(), 1e-12), 20_000)
    load = 4 / 3 * modulus * sqrt(radius) * approach**1.5 - 2 * pi * w * radius
    travel = approach + load / stiffness
    return numpy.where(z < travel[0], 0.0, numpy.interp(z, travel, load))


def ramp(low: Any, high: Any, count: Any, name: Any) -> Any:
    """Return the travels of a branch in order of time."""
    return numpy.linspace(low, high, count)[:: -1 if name == UNLOADING else 1]


def jkr_curve(
    opening: float = 0.06,
    closing: float = 0.047,
    modulus: float = 1.75e6,
    radius: float = 7.5e-6,
    stiffness: float = 3.01,
    point: float = 2e-7,
    baseline: float = 1e-8,
    count: int = 750,
    low: float = -2.5e-6,
    high: float = 1.2e-6,
    branches: Any = (LOADING, UNLOADING),
) -> Any:
    """Return travel and force of a lever; `opening` and `closing` are the w of the unloading and the loading branch."""
    travels, forces = [], []
    for name in branches:
        z = ramp(low, high, count, name)
        w = opening if name == UNLOADING else closing
        force = jkr_force(z - point, w, modulus, radius, stiffness, has_contact_below=name == UNLOADING)
        travels.append(z)
        forces.append(force + baseline)
    return numpy.concatenate(travels), numpy.concatenate(forces)


def soft_lever_curve() -> Any:
    """Return travel and force of a lever softer than the contact, without adhesion hysteresis and without noise."""
    return jkr_curve(
        opening=0.045, closing=0.045, modulus=2.667e6, radius=5e-6, stiffness=0.6, point=0.7e-6, baseline=0.0,
        count=250, low=-4e-6, high=1.5e-6,
    )  # fmt: skip


def autoregression(seed: Any, count: Any, scale: Any, phi: Any) -> Any:
    """Return noise of standard deviation scale/√(1 − φ²), in which neighbours have the correlation φ."""
    steps = numpy.random.default_rng(seed).normal(0, scale, count)
    noise = numpy.empty(count)
    noise[0] = steps[0] / sqrt(1 - phi * phi)
    for index in range(1, count):
        noise[index] = phi * noise[index - 1] + steps[index]
    return noise
