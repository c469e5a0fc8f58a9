"""Compute an elastic sphere that attracts by the 3-9 law: its pull-off force, energies, and a force curve.

    python tests/tools/lennard_jones.py [μ ...]          # the pull-off force, compared with the program's fit
    python tests/tools/lennard_jones.py energies [μ ...] # the depth of the well, and the work up to pull-off
    python tests/tools/lennard_jones.py curve > tests/data/force_curve.csv

The last command makes a force curve as an instrument measures it, with noise and an unknown zero of the approach.

The gap is h/z0 = H = ρ²/2 − D − μ^(3/2) u(ρ), with ρ = r/√(Rz0), the approach D in units of z0, Tabor's parameter μ,
and the displacement u by which the attraction (8/3)(H^-3 − H^-9) w/z0 closes the gap. The attraction is constant on
rings; the displacement by a ring is that by a disc minus that by a smaller disc (elliptic integrals). Newton's method
finds the state at each of a series of gaps at the centre, and so passes the turning points of D; a parabola through the
three largest tensions gives the pull-off force. The attraction beyond the last ring is added in closed form. Above μ =
2 the gap at the centre no longer falls along the whole curve, so the table ends there.
"""

import sys
from collections.abc import Iterable, Iterator
from typing import Any

import numpy
from scipy.interpolate import CubicSpline  # type: ignore[import-untyped]
from scipy.special import ellipe, ellipk  # type: ignore[import-untyped]

from jkroll.formulas import pull_off_force_lennard_jones

# The pull-off force over πwR.
TABLE = {
    0.01: 1.99897, 0.03: 1.99468, 0.05: 1.98866, 0.1: 1.96896, 0.136: 1.95223, 0.2: 1.92014, 0.3: 1.87019,
    0.5: 1.78748, 0.7: 1.72892, 1.0: 1.67068, 1.5: 1.61486, 2.0: 1.58349,
}  # fmt: skip
# The energies over πwRz0: the depth of the well, and the work from rest to the largest tension. Below μ = 0.698 the
# approach changes in one direction along the whole curve, so the depth is the work of separation with fixed grips.
ENERGIES = {
    0.01: (2.88567, 0.31633), 0.03: (2.90929, 0.34858), 0.05: (2.94093, 0.39226), 0.1: (3.03744, 0.52705),
    0.136: (3.11533, 0.63610), 0.2: (3.26324, 0.83963), 0.3: (3.50893, 1.15878), 0.5: (4.03202, 1.75904),
    0.7: (4.58361, 2.31711), 1.0: (5.44910, 3.11404),
}  # fmt: skip


def fit(tabor: float) -> float:
    """Return the pull-off force over πwR that the program gives."""
    return float(pull_off_force_lennard_jones(work_of_adhesion=1.0, reduced_radius=1 / numpy.pi, tabor_parameter=tabor))


def disc(r: Any, radius: Any) -> Any:
    """Return the displacement that a unit pressure on a disc gives, for E* = 1."""
    inside = r < radius
    k = numpy.where(inside, r, radius) / numpy.where(inside, radius, r)
    k = numpy.minimum(k, 1 - 1e-12)
    first, second = ellipk(k * k), ellipe(k * k)
    return 4 / numpy.pi * numpy.where(inside, radius * second, r * (second - (1 - k * k) * first))


def states(tabor: float, rings: int, gaps: Iterable[float]) -> Iterator[tuple[float, float]]:
    """Iterate over the states at given gaps at the centre: the approach over z0 and the tension over πwR."""
    if tabor > 2:
        raise ValueError("the curve cannot be followed by the gap at the centre above μ = 2")
    scale = max(1.0, tabor**0.5)
    edges = numpy.concatenate(
        [numpy.linspace(0, 6 * scale, 3 * rings // 4), numpy.geomspace(6 * scale, 60 * scale, rings // 4)[1:]]
    )
    middle = (edges[1:] + edges[:-1]) / 2
    # The displacement at the middle of each ring by a unit traction on each ring.
    influence = disc(middle[:, None], edges[None, 1:]) - numpy.where(
        edges[:-1] > 0, disc(middle[:, None], numpy.maximum(edges[None, :-1], 1e-9)), 0
    )
    influence *= tabor**1.5
    areas = edges[1:] ** 2 - edges[:-1] ** 2

    def traction(h: numpy.ndarray) -> tuple[numpy.ndarray, numpy.ndarray]:
        """Return the attraction at a gap, and its derivative."""
        return 8 / 3 * (h**-3 - h**-9), 8 / 3 * (9 * h**-10 - 3 * h**-4)

    def tension(h: numpy.ndarray, d: float) -> float:
        """Return the tension over πwR."""
        far = 8 / 3 * 2 / (2 * (edges[-1] ** 2 / 2 - d) ** 2)
        return float((traction(h)[0] * areas).sum() + far)

    count = len(middle)
    h, d = middle**2 / 2 + 3.0, -3.0
    for gap in gaps:
        h, d = h - (h[0] - gap), d + (h[0] - gap)
        for _ in range(60):
            pull, slope = traction(h)
            jacobian = numpy.eye(count + 1)
            jacobian[:count, :count] += influence * slope
            jacobian[:count, count], jacobian[count, 0], jacobian[count, count] = 1, 1, 0
            change = numpy.linalg.solve(jacobian, numpy.append(h - middle**2 / 2 + d + influence @ pull, h[0] - gap))
            h, d = h - change[:count], d - change[count]
            if abs(change).max() < 1e-11:
                break
        else:
            raise ArithmeticError(f"no solution at a gap of {gap}")
        yield float(d), tension(h, d)


def pull_off(tabor: float, rings: int) -> float:
    """Return the pull-off force over πwR with a number of rings."""
    tensions: list[float] = []
    for _, tension in states(tabor, rings, [*numpy.linspace(3, 1.2, 60), *numpy.linspace(1.19, 0.9, 200)]):
        tensions.append(tension)
        if tension < max(tensions) - 1e-4:
            break
    best = int(numpy.argmax(tensions))
    below, top, above = tensions[best - 1 : best + 2]
    return top - (above - below) ** 2 / (8 * (above - 2 * top + below))


def energies(tabor: float, rings: int) -> tuple[float, float]:
    """Return the depth of the well and the work up to the largest tension over πwRz0, with a number of rings.

    Beyond 30 z0 the tension is that of a rigid sphere, integrated in closed form.
    """
    gaps = [*numpy.geomspace(30, 3, 60)[:-1], *numpy.linspace(3, 1.2, 80)[:-1], *numpy.linspace(1.2, 0.7, 400)]
    found: list[tuple[float, float]] = []
    for state in states(tabor, rings, gaps):
        found.append(state)
        if state[1] < 0:
            break
    (before, pull), (beyond, push) = found[-2:]
    at_rest = before + (beyond - before) * pull / (pull - push)
    approach, tension = numpy.array([*found[:-1], (at_rest, 0.0)]).T
    by_approach, by_tension = (CubicSpline(range(len(each)), each) for each in (approach, tension))
    positions = numpy.linspace(0, len(approach) - 1, 40001)  # along the curve
    power = by_tension(positions) * by_approach(positions, 1)
    largest = int(numpy.argmax(by_tension(positions)))
    well = numpy.trapezoid(power, positions) + 8 / 3 * (1 / gaps[0] - 1 / (28 * gaps[0] ** 7))
    return float(well), float(numpy.trapezoid(power[largest:], positions[largest:]))


# --- A force curve ----------------------------------------------------------------------------------------------------

GAMMA, RADIUS, YOUNGS_MODULUS, POISSON_RATIO = 0.025, 1e-6, 6e9, 0.3  # of a sphere on a rigid plane of its own γ
SPACING = 4e-10  # z0
ZERO, NOISE = 12.3e-9, 3e-9  # of the approach, in m, and of the force, in N


def force_curve(rings: int = 300) -> Iterator[tuple[float, float]]:
    """Iterate over approach and force as the sphere is withdrawn, until it jumps off at the largest tension."""
    modulus, w = YOUNGS_MODULUS / (1 - POISSON_RATIO**2), 2 * GAMMA
    tabor = float(numpy.cbrt(RADIUS * w**2 / (modulus**2 * SPACING**3)))
    gaps = [*numpy.linspace(3, 1.2, 19), *numpy.linspace(1.19, 1.02, 35), *numpy.linspace(1.019, 0.94, 80)]
    found = [*states(tabor, rings, gaps)]
    best = max(range(len(found)), key=lambda index: found[index][1])
    random = numpy.random.default_rng(1995)
    for approach, tension in reversed(found[best:]):
        yield SPACING * approach + ZERO, -numpy.pi * w * RADIUS * tension + NOISE * random.standard_normal()


def main() -> None:
    """Print the force curve, or a row for each μ with the energies or the pull-off force.

    A row has the numbers extrapolated in the number of rings, and those of the table. For the pull-off force, the
    values with two numbers of rings precede, and the relative error of the fit follows.
    """
    if sys.argv[1:] == ["curve"]:
        print("approach [m],force [N]")
        for approach, force in force_curve():
            print(f"{approach:.4e},{force:.3e}")
        return
    if sys.argv[1:2] == ["energies"]:
        for tabor in map(float, sys.argv[2:] or ENERGIES):
            few, many = (numpy.array(energies(tabor, rings)) for rings in (200, 400))
            print(f"{tabor:6g}", *(many + (many - few) / 3).round(5), *ENERGIES.get(tabor, ()))
        return
    for tabor in map(float, sys.argv[1:] or TABLE):
        coarse, fine = pull_off(tabor, 300), pull_off(tabor, 600)
        value = fine + (fine - coarse) / 3
        print(
            f"{tabor:6g} {coarse:.6f} {fine:.6f} {value:.5f} {TABLE.get(tabor, float('nan')):.5f} "
            f"{fit(tabor) / value - 1:+.2%}"
        )


if __name__ == "__main__":
    main()
