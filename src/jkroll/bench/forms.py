"""The forms of which the benchmark's other ways are made: as printed, as the textbook has them, by table, by quadrature."""

# ruff: noqa: N803, N806  (the paper's symbols)

from collections.abc import Callable
from typing import Any

from ..physics.elementary import pi, sqrt
from ..physics.jkr import FOLD_APPROACH

Way = Callable[..., Any]  # of inputs by the paper's symbols
_NODES = 10_000  # of the tables


def reduced(R1: Any, R2: Any) -> Any:
    """Reduced radius, or mass, as the text below Eq 1 has it."""
    return R1 * R2 / (R1 + R2)


def margin(P: Any, P_c: Any) -> Any:
    """The margin s = √(1 + P/P_c), which loses its digits at pull-off."""
    return sqrt(1 + P / P_c)


def stable_margin(P: Any, P_c: Any) -> Any:
    """The margin s = √((P + P_c)/P_c), which does not."""
    return sqrt((P + P_c) / P_c)


def factor(P: Any, P_c: Any) -> Any:
    """The factor x = (1 + s)/2."""
    return (1 + margin(P, P_c)) / 2


def stable_factor(P: Any, P_c: Any) -> Any:
    """The factor x = (1 + s)/2 without that loss."""
    return (1 + stable_margin(P, P_c)) / 2


def force(R1: Any, R2: Any, w: Any) -> Any:
    """Eq 1."""
    return 3 * pi * w / 2 * reduced(R1, R2)


def radius(R1: Any, R2: Any, w: Any, E: Any) -> Any:
    """Eq 2 by a power."""
    return (9 * pi * w / 2 * reduced(R1, R2) ** 2 / E) ** (1 / 3)


def radius_by_cbrt(R1: Any, R2: Any, w: Any, E: Any) -> Any:
    """Eq 2 by the library's cube root."""
    return library_cbrt(9 * pi * w / 2 * reduced(R1, R2) ** 2 / E)


def library_cbrt(value: Any) -> Any:
    """Cube root as numpy's library has it."""
    import numpy

    return numpy.cbrt(value)


def approach(R1: Any, R2: Any, w: Any, E: Any) -> Any:
    """Eq 3, a0²/(3R), by a power."""
    return radius(R1, R2, w, E) ** 2 / (3 * reduced(R1, R2))


def approach_by_cbrt(R1: Any, R2: Any, w: Any, E: Any) -> Any:
    """Eq 3, a0²/(3R), by the library's cube root."""
    return radius_by_cbrt(R1, R2, w, E) ** 2 / (3 * reduced(R1, R2))


def mass(R: Any, rho: Any) -> Any:
    """Mass of a sphere."""
    return 4 / 3 * pi * R**3 * rho


def inertia(R: Any, rho: Any) -> Any:
    """Moment of inertia of a sphere."""
    return 2 / 5 * mass(R, rho) * R**2


def log_root(value: Any) -> Any:
    """Cube root by logarithms."""
    import numpy

    return numpy.exp(numpy.log(value) / 3)


def slope(a_: Any) -> Any:
    """Slope of P(δ) through those of P(â) and δ(â)."""
    return (12 * a_**2 - 6 * sqrt(a_)) / (6 * a_ - 1 / sqrt(a_))


# --- The approach inverted --------------------------------------------------------------------------------------------


def by_newton(delta: Any, delta0: Any) -> Any:
    """Newton's method on 3y⁴ − 2y = δ/δ0."""
    import numpy

    ratio = delta / delta0
    y = 1 + numpy.sqrt(numpy.sqrt(abs(ratio)))
    for _ in range(60):
        step = (3 * y**4 - 2 * y - ratio) / (12 * y**3 - 2)
        y = y - step
        if not numpy.any(abs(step) > 1e-15 * abs(y)):
            break
    return y**3


def by_radicals(delta: Any, delta0: Any) -> Any:
    """Ferrari's resolvent as the textbook has it."""
    ratio = delta / delta0
    root = sqrt(4 / 81 + (4 * ratio / 9) ** 3)
    zeta = library_cbrt(2 / 9 + root) + library_cbrt(2 / 9 - root)
    return ((sqrt(zeta) + sqrt(4 / (3 * sqrt(zeta)) - zeta)) / 2) ** 3


def by_vieta(delta: Any, delta0: Any) -> Any:
    """The same without its cancellation: the second cube root from the product of the two."""
    import numpy

    ratio = delta / delta0
    A = library_cbrt(2 / 9 + sqrt(4 / 81 + (4 * ratio / 9) ** 3))
    B = -4 * ratio / (9 * A)
    zeta = numpy.where(ratio <= 0, A + B, 4 / 9 / (A * A - A * B + B * B))
    sigma = sqrt(zeta)
    return ((sigma + sqrt(4 / (3 * sigma) - zeta)) / 2) ** 3


def by_table(delta: Any, delta0: Any) -> Any:
    """Between equidistant approaches from the fold to 3 δ0; flat beyond."""
    import numpy

    if "plain" not in _TABLES:
        y = numpy.linspace(6 ** (-1 / 3), 1.26, 20 * _NODES)
        nodes = numpy.linspace(FOLD_APPROACH, 3, _NODES)
        _TABLES["plain"] = nodes, numpy.interp(nodes, 3 * y**4 - 2 * y, y**3)
    return numpy.interp(delta / delta0, *_TABLES["plain"])


def by_root_table(delta: Any, delta0: Any) -> Any:
    """Between nodes in √(δ̂ − δ̂_fold), in which the state is smooth."""
    import numpy

    if "root" not in _TABLES:
        eta = numpy.linspace(0, 1.3, _NODES)
        _TABLES["root"] = eta * numpy.sqrt((3 + eta * (2 + eta / 2)) / 6 ** (1 / 3)), (1 + eta) ** 3 / 6
    return numpy.interp(numpy.sqrt(delta / delta0 - FOLD_APPROACH), *_TABLES["root"])


_TABLES: dict[str, tuple[Any, Any]] = {}


# --- The moment integrated --------------------------------------------------------------------------------------------


def half_circle(A: Any, delta: Any, E: Any, R: Any) -> Any:
    """Eq 23."""
    return E * A**2 * delta / 2 - E / (4 * R) * A**4


def half_circles(R1: Any, R2: Any, w: Any, E: Any, xi: Any, P: Any, P_c: Any) -> Any:
    """Eq 19, not linearised: its own terms in ξ³ count as errors of Eq 25, which is exact."""
    a_ = stable_factor(P, P_c) ** (2 / 3)
    a, delta = radius(R1, R2, w, E) * a_, approach(R1, R2, w, E) * (3 * a_**2 - 2 * sqrt(a_))
    return half_circle(a - xi, delta, E, reduced(R1, R2)) - half_circle(a + xi, delta, E, reduced(R1, R2))


def linearised(R1: Any, R2: Any, w: Any, E: Any, xi: Any, P: Any, P_c: Any) -> Any:
    """Eq 24."""
    a_ = stable_factor(P, P_c) ** (2 / 3)
    a, delta = radius(R1, R2, w, E) * a_, approach(R1, R2, w, E) * (3 * a_**2 - 2 * sqrt(a_))
    return 2 * xi * E * a * (a**2 / reduced(R1, R2) - delta)


def quadrature(points: int, *, in_angle: bool) -> Way:
    """Eq 17 over the tilted pressure of the shifted circle, by Gauss-Legendre in r/a or in its arc sine; less ξP."""

    def way(R1: Any, R2: Any, w: Any, E: Any, xi: Any, P: Any, P_c: Any) -> Any:
        import numpy

        a = radius_by_cbrt(R1, R2, w, E) * library_cbrt(stable_factor(P, P_c) ** 2)
        tilt = 2 * E * xi / reduced(R1, R2)  # of the pressure, over π; X²/√(1 − r²/a²) is left of the integrand
        total = 0.0
        for node, weight in zip(*map(numpy.ndarray.tolist, numpy.polynomial.legendre.leggauss(points)), strict=True):
            if in_angle:
                angle = pi / 4 * (1 + node)
                total = total + weight * pi / 4 * numpy.sin(angle) ** 3 * a**3
            else:
                r = a * ((1 + node) / 2)
                total = total + weight / 2 * r**3 / numpy.sqrt(1 - (r / a) ** 2)
        return tilt * total - xi * P

    return way
