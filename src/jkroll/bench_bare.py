"""The arithmetic of `jkroll.solve` for the usual quantities, written out by hand: what it could cost at best."""

from collections.abc import Mapping
from math import cbrt, pi, sqrt
from typing import Any

WANTED = (
    "pull_off_force", "contact_radius", "approach", "yield_force", "yield_force_ratio", "yield_moment", "yield_angle",
    "r_min", "n_grav", "vertical_frequency", "rolling_frequency", "n_roll",
)  # fmt: skip
XI, G = 2e-10, 9.80665
_SCRATCH = 14


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
        w, R, E, s, x, c, a, m1, m2, i1, i2, t, u, v = self.scratch  # noqa: N806
        # the pair
        np.multiply(given["surface_energy"], given["surface_energy"], out=w)
        np.sqrt(w, out=w)
        np.multiply(w, 2, out=w)
        self._parallel(R1, R2, R, t)
        np.subtract(1, given["poisson_ratio"], out=t)
        np.add(1, given["poisson_ratio"], out=u)
        np.multiply(t, u, out=t)
        np.divide(t, given["youngs_modulus"], out=t)
        np.add(t, t, out=t)
        np.divide(1, t, out=E)
        # the contact
        P_c = np.multiply(w, 3 / 2 * pi, out=out["pull_off_force"])  # noqa: N806
        np.multiply(P_c, R, out=P_c)
        np.divide(w, E, out=c)
        np.multiply(c, 9 / 2 * pi, out=t)
        np.multiply(t, R, out=t)
        np.multiply(t, R, out=t)
        self._cbrt(t, out["contact_radius"], u, v)
        np.multiply(c, 3 / 4 * (pi * pi), out=t)
        np.multiply(t, c, out=t)
        np.multiply(t, R, out=t)
        self._cbrt(t, out["approach"], u, v)
        np.add(P, P_c, out=s)
        np.divide(s, P_c, out=s)
        np.sqrt(s, out=s)
        np.add(1, s, out=x)
        np.divide(x, 2, out=x)
        # rolling and chains
        Q = np.multiply(w, 6 * pi, out=out["yield_force"])  # noqa: N806
        np.multiply(Q, x, out=Q)
        np.multiply(Q, XI, out=Q)
        np.divide(R1, R2, out=t)
        np.add(1, t, out=t)
        np.divide(Q, t, out=Q)
        np.divide(XI, R1, out=t)
        np.multiply(x, 4, out=u)
        np.multiply(u, t, out=out["yield_force_ratio"])
        M = np.multiply(P_c, 4, out=out["yield_moment"])  # noqa: N806
        np.multiply(M, x, out=M)
        np.multiply(M, R, out=v)  # the stiffness in rolling
        np.multiply(M, XI, out=M)
        np.divide(XI, R, out=out["yield_angle"])
        np.divide(R2, XI, out=t)
        np.multiply(R1, t, out=out["r_min"])
        # masses, and what vibrates
        self._mass(R1, rho, m1, i1, t)
        self._mass(R2, rho, m2, i2, t)
        n = np.multiply(m1, G, out=out["n_grav"])
        np.multiply(n, R1, out=n)
        np.divide(M, n, out=n)
        np.sqrt(n, out=n)
        self._parallel(i1, i2, a, t)
        self._frequency(v, a, out["rolling_frequency"])
        np.multiply(R, x, out=u)
        np.multiply(c, 9 / 2 * pi, out=t)
        np.multiply(t, u, out=t)
        np.multiply(t, u, out=t)
        self._cbrt(t, a, u, v)
        np.multiply(s, 6, out=t)
        np.multiply(s, 3, out=u)
        np.add(u, 2, out=u)
        np.divide(t, u, out=t)
        np.multiply(t, E, out=t)
        np.multiply(t, a, out=v)
        self._parallel(m1, m2, a, t)
        self._frequency(v, a, out["vertical_frequency"])
        np.multiply(c, 3 / (10976 * pi), out=t)
        np.multiply(t, c, out=t)
        np.multiply(t, R, out=t)
        n = out["n_roll"]
        self._cbrt(t, n, u, v)
        np.multiply(x, XI, out=t)
        np.divide(n, t, out=n)
        return out

    @staticmethod
    def _parallel(one: Any, two: Any, out: Any, t: Any) -> None:
        import numpy as np

        np.minimum(one, two, out=out)
        np.maximum(one, two, out=t)
        np.divide(out, t, out=t)
        np.add(1, t, out=t)
        np.divide(out, t, out=out)

    @staticmethod
    def _cbrt(value: Any, out: Any, u: Any, v: Any) -> None:
        """Cube root with its last digit, of `value`, which is lost."""
        import numpy as np

        np.cbrt(value, out=out)
        np.multiply(out, 2**36 + 1, out=u)
        np.subtract(u, out, out=v)
        np.subtract(u, v, out=u)  # head
        np.multiply(u, u, out=v)
        np.multiply(v, u, out=v)
        np.subtract(value, v, out=value)
        np.add(out, u, out=v)
        np.multiply(v, out, out=v)
        np.multiply(u, u, out=out)
        np.add(v, out, out=v)
        np.divide(value, v, out=value)
        np.add(u, value, out=out)

    @staticmethod
    def _mass(R: Any, rho: Any, mass: Any, inertia: Any, t: Any) -> None:  # noqa: N803
        import numpy as np

        np.multiply(R, R, out=t)
        np.multiply(t, R, out=mass)
        np.multiply(mass, 4 * pi, out=mass)
        np.multiply(mass, rho, out=mass)
        np.divide(mass, 3, out=mass)
        np.multiply(t, t, out=inertia)
        np.multiply(inertia, R, out=inertia)
        np.multiply(inertia, 8 * pi, out=inertia)
        np.multiply(inertia, rho, out=inertia)
        np.divide(inertia, 15, out=inertia)

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
