"""The arithmetic of `jkroll.solve` for the usual quantities, written out by hand: what it could cost at best."""

from collections.abc import Mapping
from math import cbrt, pi, sqrt
from typing import Any

WANTED = (
    "pull_off_force", "contact_radius", "approach", "yield_force", "yield_force_ratio", "yield_moment", "yield_angle",
    "r_min", "n_grav", "vertical_frequency", "rolling_frequency", "n_roll",
)  # fmt: skip
XI, G = 2e-10, 9.80665
_SCRATCH = 20


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
        w, R, E, s, x, c, a, m1, m2, i1, i2, t, u = self.scratch[:13]  # noqa: N806
        # the pair
        self._mean(given["surface_energy"], w)
        np.multiply(w, 2, out=w)
        self._parallel(R1, R2, R)
        self._compliance(given["poisson_ratio"], given["youngs_modulus"], t)
        np.divide(1 / 2, t, out=E)
        # the contact
        P_c = self._product((3 / 2 * pi, w, R), out["pull_off_force"])  # noqa: N806
        np.divide(w, E, out=c)
        np.multiply(c, 9 / 2 * pi, out=t)
        np.multiply(t, R, out=t)
        np.multiply(t, R, out=t)
        self._cbrt(t, out["contact_radius"])
        np.multiply(c, 3 / 4 * (pi * pi), out=t)
        np.multiply(t, c, out=t)
        np.multiply(t, R, out=t)
        self._cbrt(t, out["approach"])
        np.add(P, P_c, out=s)
        np.divide(s, P_c, out=s)
        np.sqrt(s, out=s)
        np.add(1, s, out=x)
        np.divide(x, 2, out=x)
        # rolling and chains
        np.divide(R1, R2, out=t)
        np.add(1, t, out=t)
        self._product((6 * pi, w, x, XI), out["yield_force"], over=t)
        np.divide(XI, R1, out=t)
        np.multiply(x, 4, out=u)
        np.multiply(u, t, out=out["yield_force_ratio"])
        np.multiply(P_c, 4, out=t)
        M = self._product((t, x, XI), out["yield_moment"])  # noqa: N806
        np.divide(XI, R, out=out["yield_angle"])
        np.divide(R2, XI, out=t)
        np.multiply(R1, t, out=out["r_min"])
        # masses, and what vibrates
        for radius, mass, inertia in ((R1, m1, i1), (R2, m2, i2)):
            self._product((rho, radius, radius, radius), mass, over=3 / 4 / pi)
            self._product((mass, radius, radius), inertia, over=5 / 2)
        n = np.multiply(m1, G, out=out["n_grav"])
        np.multiply(n, R1, out=n)
        np.divide(M, n, out=n)
        np.sqrt(n, out=n)
        self._parallel(i1, i2, a)
        self._product((6 * pi, w, x, R, R), t)
        self._frequency(t, a, out["rolling_frequency"])
        np.multiply(R, x, out=u)
        np.multiply(c, 9 / 2 * pi, out=t)
        np.multiply(t, u, out=t)
        np.multiply(t, u, out=t)
        self._cbrt(t, a)
        np.multiply(s, 3, out=u)
        np.add(u, 2, out=u)
        self._product((6.0, s, E, a), t, over=u)
        self._parallel(m1, m2, a)
        self._frequency(t, a, out["vertical_frequency"])
        np.multiply(c, 3 / (10976 * pi), out=t)
        np.multiply(t, c, out=t)
        np.multiply(t, R, out=t)
        self._cbrt(t, u)
        np.multiply(x, XI, out=t)
        self._product((1.0, u), out["n_roll"], over=t)
        return out

    @staticmethod
    def _head(value: Any, bits: int, out: Any) -> Any:
        import numpy as np

        dropped = 53 - bits
        whole = out.view(np.int64)
        np.add(value.view(np.int64), 1 << (dropped - 1), out=whole)
        np.bitwise_and(whole, -(1 << dropped), out=whole)
        return out

    def _parts(self, factors: tuple[Any, ...], bits: int, exact: Any, rest: Any) -> None:
        """The product of the leading bits of factors, and what the whole has besides."""
        import numpy as np

        head, less, t = self.scratch[17:20]
        first, *others = sorted(factors, key=lambda factor: not isinstance(factor, np.ndarray))
        self._head(first, bits, exact)
        np.subtract(first, exact, out=rest)
        for factor in others:
            if isinstance(factor, float):
                number = (2.0 ** (53 - bits) + 1) * factor
                number -= number - factor
                np.multiply(exact, factor - number, out=t)
                leading: Any = number
            else:
                leading = self._head(factor, bits, head)
                np.subtract(factor, head, out=less)
                np.multiply(exact, less, out=t)
            np.multiply(rest, factor, out=rest)
            np.add(rest, t, out=rest)
            np.multiply(exact, leading, out=exact)

    def _product(self, factors: tuple[Any, ...], out: Any, over: Any = None) -> Any:
        import numpy as np

        exact, rest, head, t = self.scratch[13:17]
        bits = 53 // max(len(factors), 1 if over is None else 2)
        self._parts(factors, bits, exact, rest)
        np.add(exact, rest, out=out)
        if over is None:
            return out
        np.divide(out, over, out=out)
        self._head(out, bits, head)
        divisor = over if isinstance(over, float) else self._head(over, bits, self.scratch[17])
        if isinstance(over, float):
            wide = (2.0 ** (53 - bits) + 1) * over
            divisor = wide - (wide - over)
        np.multiply(head, divisor, out=t)
        np.subtract(exact, t, out=exact)
        np.subtract(over, divisor, out=t)
        np.multiply(head, t, out=t)
        np.subtract(rest, t, out=rest)
        np.add(exact, rest, out=exact)
        np.divide(exact, over, out=exact)
        return np.add(head, exact, out=out)

    def _mean(self, value: Any, out: Any) -> None:
        """The geometric mean of a value and itself, as if the two were not the same."""
        import numpy as np

        head, less, root, t = self.scratch[13:17]
        np.multiply(value, value, out=out)
        np.sqrt(out, out=out)
        self._head(out, 26, root)
        self._head(value, 26, head)
        np.subtract(value, head, out=less)
        np.multiply(less, value, out=t)
        np.multiply(less, head, out=less)
        np.add(less, t, out=less)
        np.multiply(head, head, out=head)
        np.multiply(root, root, out=t)
        np.subtract(head, t, out=head)
        np.add(head, less, out=head)
        np.add(out, root, out=t)
        np.divide(head, t, out=head)
        np.add(root, head, out=out)

    def _compliance(self, ratio: Any, modulus: Any, out: Any) -> None:
        """(1 − ν²)/E."""
        import numpy as np

        less, more, exact, rest, t, head = self.scratch[6:12]
        np.subtract(1, ratio, out=less)
        np.add(1, ratio, out=more)
        np.subtract(1, more, out=t)
        np.add(t, ratio, out=t)
        np.multiply(less, t, out=t)
        np.subtract(1, less, out=head)
        np.subtract(head, ratio, out=head)
        np.multiply(more, head, out=head)
        np.add(t, head, out=t)
        self._parts((less, more), 26, exact, rest)
        np.add(rest, t, out=rest)
        np.multiply(less, more, out=out)
        np.divide(out, modulus, out=out)
        self._head(out, 26, head)
        self._head(modulus, 26, less)
        np.multiply(head, less, out=t)
        np.subtract(exact, t, out=exact)
        np.subtract(modulus, less, out=less)
        np.multiply(head, less, out=less)
        np.subtract(rest, less, out=rest)
        np.add(exact, rest, out=exact)
        np.divide(exact, modulus, out=exact)
        np.add(head, exact, out=out)

    def _parallel(self, one: Any, two: Any, out: Any) -> None:
        import numpy as np

        small, large, ratio, head, leading, u, v = self.scratch[13:20]
        np.minimum(one, two, out=small)
        np.maximum(one, two, out=large)
        np.divide(small, large, out=ratio)
        np.add(1, ratio, out=u)
        np.divide(small, u, out=out)
        self._head(out, 26, head)
        self._head(ratio, 26, leading)
        self._head(large, 26, u)
        np.multiply(leading, u, out=v)
        np.subtract(small, v, out=v)
        np.subtract(large, u, out=u)
        np.multiply(leading, u, out=u)
        np.subtract(v, u, out=v)
        np.subtract(ratio, leading, out=u)  # the rest of the ratio
        np.multiply(u, large, out=out)
        np.subtract(v, out, out=v)
        np.divide(v, large, out=v)  # what is missing of the ratio
        np.subtract(small, head, out=out)
        np.multiply(head, leading, out=leading)
        np.subtract(out, leading, out=out)
        np.multiply(head, u, out=u)
        np.subtract(out, u, out=out)
        np.multiply(head, v, out=v)
        np.subtract(out, v, out=out)
        np.add(1, ratio, out=ratio)
        np.divide(out, ratio, out=out)
        np.add(head, out, out=out)

    def _cbrt(self, value: Any, out: Any) -> None:
        """Cube root with its last digit, of `value`, which is lost."""
        import numpy as np

        head, u, v = self.scratch[13:16]
        np.cbrt(value, out=out)
        self._head(out, 17, head)
        np.multiply(head, head, out=u)
        np.multiply(u, head, out=v)
        np.subtract(value, v, out=value)
        np.add(out, head, out=v)
        np.multiply(v, out, out=v)
        np.add(v, u, out=v)
        np.divide(value, v, out=value)
        np.add(head, value, out=out)

    @staticmethod
    def _frequency(stiffness: Any, mass: Any, out: Any) -> None:
        import numpy as np

        np.multiply(mass, 4 * (pi * pi), out=out)
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
