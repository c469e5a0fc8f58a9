"""The arithmetic of `jkroll.solve` for the usual quantities, written out by hand: what it could cost at best."""

from collections.abc import Mapping
from math import cbrt, pi, sqrt
from typing import Any

_PI = 4175892906503776358826876457663557747, 2**120  # to 36 digits


class Constant(float):
    """The double next to a number, and what the number has besides.

    >>> two_fifths = Constant(2, 5)
    >>> two_fifths, two_fifths.rest
    (0.4, -2.2204460492503132e-17)
    """

    rest: float

    def __new__(cls, numerator: int, denominator: int = 1, power: int = 0) -> "Constant":
        """Of a fraction, times a power of π."""
        above, below = numerator * _PI[0] ** power, denominator * _PI[1] ** power
        constant = super().__new__(cls, above / below)
        rounded, scale = constant.as_integer_ratio()
        constant.rest = (above * scale - rounded * below) / (below * scale)
        return constant


WANTED = (
    "pull_off_force", "contact_radius", "approach", "yield_force", "yield_force_ratio", "yield_moment", "yield_angle",
    "r_min", "n_grav", "vertical_frequency", "rolling_frequency", "n_roll",
)  # fmt: skip
XI, G = 2e-10, 9.80665
_SCRATCH = 22
_THREE_HALVES_PI, _SIX_PI, _FOUR_THIRDS_PI = (Constant(*ratio, 1) for ratio in ((3, 2), (6, 1), (4, 3)))
_TWO_FIFTHS, _THREE_QUARTERS_PI_SQUARED = Constant(2, 5), Constant(3, 4, 2)


class BareArrays:
    """Bare numpy: outputs and scratch allocated beforehand, each operation into one of them, nothing checked."""

    def __init__(self, size: int) -> None:
        import numpy

        self.out = {name: numpy.empty(size) for name in WANTED}
        self.scratch = [numpy.empty(size) for _ in range(_SCRATCH)]

    def run(self, given: Mapping[str, Any]) -> Mapping[str, Any]:  # noqa: PLR0915
        """Fill the outputs."""
        import numpy as np

        R1, R2, rho, P = (given[name] for name in ("radius", "radius2", "density", "load"))  # noqa: N806
        out = self.out
        w, R, E, s, x, c, a, m1, m2, i1, i2, t, u, v = self.scratch[:14]  # noqa: N806
        # the pair
        np.multiply(given["surface_energy"], 2, out=w)
        self._product((R1, R2), R, over=(self._sum(R1, R2, u, v),))
        nu = given["poisson_ratio"]
        less, more = self._sum(1.0, np.negative(nu, out=t), a, c), self._sum(1.0, nu, u, v)
        self._product((more, less), E, over=(given["youngs_modulus"],))
        np.multiply(E, 2, out=E)
        np.divide(1, E, out=E)
        # the contact
        P_c = self._product((_THREE_HALVES_PI, w, R), out["pull_off_force"])  # noqa: N806
        np.divide(w, E, out=c)
        np.multiply(c, 9 / 2 * pi, out=t)
        np.multiply(t, R, out=t)
        np.multiply(t, R, out=t)
        self._cbrt(t, out["contact_radius"])
        self._product((_THREE_QUARTERS_PI_SQUARED, c, c, R), t)
        self._cbrt(t, out["approach"])
        np.add(P, P_c, out=s)
        np.divide(s, P_c, out=s)
        np.sqrt(s, out=s)
        np.add(1, s, out=x)
        np.divide(x, 2, out=x)
        # rolling and chains
        Q = self._product((_SIX_PI, w, x, XI), out["yield_force"])  # noqa: N806
        np.divide(R1, R2, out=t)
        np.add(1, t, out=t)
        np.divide(Q, t, out=Q)
        np.divide(XI, R1, out=t)
        np.multiply(x, 4, out=u)
        np.multiply(u, t, out=out["yield_force_ratio"])
        M = np.multiply(P_c, 4, out=out["yield_moment"])  # noqa: N806
        np.multiply(M, x, out=M)
        np.multiply(M, XI, out=M)
        np.divide(XI, R, out=out["yield_angle"])
        np.divide(R2, XI, out=t)
        np.multiply(R1, t, out=out["r_min"])
        # masses, and what vibrates
        for radius, mass, inertia in ((R1, m1, i1), (R2, m2, i2)):
            self._product((_FOUR_THIRDS_PI, rho, radius, radius, radius), mass)
            self._product((_TWO_FIFTHS, mass, radius, radius), inertia)
        N = self._product((M,), out["n_grav"], over=(m1, G, R1))  # noqa: N806
        np.sqrt(N, out=N)
        self._product((_SIX_PI, w, x, R, R), t)
        self._frequency(t, i1, i2, out["rolling_frequency"])
        np.multiply(R, x, out=u)
        np.multiply(c, 9 / 2 * pi, out=t)
        np.multiply(t, u, out=t)
        np.multiply(t, u, out=t)
        self._cbrt(t, a)
        np.multiply(s, 3, out=t)
        self._product((6.0, s, E, a), E, over=(self._sum(2.0, t, u, v),))
        self._frequency(E, m1, m2, out["vertical_frequency"])
        np.multiply(c, 3 / (10976 * pi), out=t)
        np.multiply(t, c, out=t)
        np.multiply(t, R, out=t)
        self._cbrt(t, u)
        self._product((1.0, u), out["n_roll"], over=(XI, x))
        return out

    @staticmethod
    def _head(value: Any, bits: int, out: Any) -> Any:
        import numpy as np

        if not isinstance(value, np.ndarray):
            wide = (2.0 ** (53 - bits) + 1) * value
            return wide - (wide - value)
        dropped = 53 - bits
        whole = out.view(np.int64)
        np.add(value.view(np.int64), 1 << (dropped - 1), out=whole)
        np.bitwise_and(whole, -(1 << dropped), out=whole)
        return out

    def _sum(self, one: Any, two: Any, total: Any, lost: Any) -> tuple[Any, Any]:
        """A sum and what rounding takes from it."""
        import numpy as np

        t = self.scratch[14]
        np.add(one, two, out=total)
        np.subtract(total, one, out=lost)
        np.subtract(total, lost, out=t)
        np.subtract(one, t, out=t)
        np.subtract(two, lost, out=lost)
        np.add(t, lost, out=lost)
        return total, lost

    def _parts(self, factors: tuple[Any, ...], bits: int, exact: Any, rest: Any) -> tuple[Any, Any]:
        """The product of the leading bits of factors, and what the whole has besides."""
        import numpy as np

        head, less, t = self.scratch[15:18]
        e: Any = None
        r: Any = None
        for factor in factors:
            value, lost = factor if isinstance(factor, tuple) else (factor, getattr(factor, "rest", None))
            is_array = isinstance(value, np.ndarray)
            first = e is None
            h = self._head(value, bits, exact if first else head)
            lower = np.subtract(value, h, out=(rest if first else less) if is_array else None)
            if lost is not None:
                lower = np.add(lower, lost, out=(rest if first else less) if is_array else None)
            if first:
                e, r = h, lower
                continue
            into = (t, exact, rest) if is_array or isinstance(e, np.ndarray) else (None, None, None)
            missing = np.multiply(e, lower, out=into[0])
            r = np.add(np.multiply(r, value, out=into[2]), missing, out=into[2])
            e = np.multiply(e, h, out=into[1])
        return e, r

    def _product(self, factors: tuple[Any, ...], out: Any, over: tuple[Any, ...] = ()) -> Any:
        import numpy as np

        exact, rest, divisor, divisor_rest = self.scratch[18:22]
        bits = 53 // max(len(factors), len(over) + 1)
        self._parts(factors, bits, exact, rest)
        if not over:
            return np.add(exact, rest, out=out)
        self._parts(over, bits, divisor, divisor_rest)
        head, whole = self.scratch[15:17]
        np.add(divisor, divisor_rest, out=whole)
        np.add(exact, rest, out=out)
        np.divide(out, whole, out=out)
        self._head(out, bits, head)
        np.multiply(head, divisor, out=divisor)
        np.subtract(exact, divisor, out=exact)
        np.multiply(head, divisor_rest, out=divisor_rest)
        np.subtract(rest, divisor_rest, out=rest)
        np.add(exact, rest, out=exact)
        np.divide(exact, whole, out=exact)
        return np.add(exact, head, out=out)

    def _cbrt(self, value: Any, out: Any) -> None:
        """Cube root with its last digit, of `value`, which is lost."""
        import numpy as np

        head, u, v = self.scratch[15:18]
        np.cbrt(value, out=out)
        self._head(out, 17, head)
        np.multiply(head, head, out=u)
        np.add(out, head, out=v)
        np.multiply(v, out, out=v)
        np.add(v, u, out=v)
        np.multiply(u, head, out=u)
        np.subtract(value, u, out=value)
        np.divide(value, v, out=value)
        np.add(head, value, out=out)

    def _frequency(self, stiffness: Any, one: Any, two: Any, out: Any) -> None:
        """(1/2π)√(k/m) of the mass, or the moment of inertia, of two bodies."""
        import numpy as np

        np.divide(one, two, out=out)
        np.add(1, out, out=out)
        np.divide(one, out, out=out)
        np.multiply(out, 4 * (pi * pi), out=out)
        np.divide(stiffness, out, out=out)
        np.sqrt(out, out=out)


def bare_numbers(given: Mapping[str, float]) -> dict[str, float]:
    """Bare `math` for one scene."""
    R1, R2, rho, P = (given[name] for name in ("radius", "radius2", "density", "load"))  # noqa: N806
    w = 2 * sqrt(given["surface_energy"] * given["surface_energy"])
    R = R1 * R2 / (R1 + R2)  # noqa: N806
    compliance = (1 - given["poisson_ratio"]) * (1 + given["poisson_ratio"]) / given["youngs_modulus"]
    E = 1 / (compliance + compliance)  # noqa: N806
    P_c = 3 / 2 * pi * w * R  # noqa: N806
    s = sqrt((P + P_c) / P_c)
    x = (1 + s) / 2
    M = 4 * P_c * x * XI  # noqa: N806
    m1, m2 = 4 * pi / 3 * R1**3 * rho, 4 * pi / 3 * R2**3 * rho
    i1, i2 = 2 / 5 * m1 * R1**2, 2 / 5 * m2 * R2**2
    a = cbrt(9 / 2 * pi * (w / E) * (R * x) ** 2)
    return {
        "pull_off_force": P_c,
        "contact_radius": cbrt(9 / 2 * pi * (w / E) * R**2),
        "approach": cbrt(3 / 4 * pi**2 * (w / E) ** 2 * R),
        "yield_force": M / R1,
        "yield_force_ratio": 4 * x * XI / R1,
        "yield_moment": M,
        "yield_angle": XI / R,
        "r_min": R1 * R2 / XI,
        "n_grav": sqrt(M / (m1 * G * R1)),
        "vertical_frequency": sqrt(6 * s / (2 + 3 * s) * E * a / (m1 * m2 / (m1 + m2))) / (2 * pi),
        "rolling_frequency": sqrt(4 * P_c * x * R / (i1 * i2 / (i1 + i2))) / (2 * pi),
        "n_roll": cbrt(3 / (10976 * pi) * (w / E) ** 2 * R) / (XI * x),
    }
