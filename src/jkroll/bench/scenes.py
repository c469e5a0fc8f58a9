"""The points at which the benchmark measures: ordinary contacts, and those where digits are easily lost."""

from collections.abc import Callable, Mapping
from typing import Any

from ..physics.contact import pull_off_force
from ..physics.jkr import FOLD_APPROACH
from ..physics.pair import reduced_radius

Arrays = Mapping[str, Any]
_SEED = 1997


def ordinary(count: int) -> Arrays:
    """Grains of 10 nm to 100 µm under loads from −0.8 to 2 P_c, or at approaches from −0.8 to 3 δ0."""
    spread = _generator()
    radius = spread(-8, -4, count)
    points = {
        "radius": radius,
        "radius2": radius * spread(-1, 1, count),
        "work_of_adhesion": spread(-2, 0.3, count),
        "contact_modulus": spread(9, 11.5, count),
        "density": spread(3, 4, count),
        "yield_displacement": spread(-10, -9.3, count),
        "gravity": spread(-3, 1, count),
        "approach_at_load": 3.8 * spread.uniform(count) - 0.8,
    }
    return _at_loads(points, 2.8 * spread.uniform(count) - 0.8)


def hard(count: int) -> Arrays:
    """Loads near −P_c, near −(8/9)P_c, tiny and huge; approaches near the fold, tiny and huge; radii 1e15 times apart."""
    import numpy

    spread = _generator()
    points = {
        "radius": spread(-12, 3, count),
        "radius2": spread(-12, 3, count),
        "work_of_adhesion": spread(-6, 2, count),
        "contact_modulus": spread(4, 13, count),
        "density": spread(1, 5, count),
        "yield_displacement": spread(-12, -6, count),
        "gravity": spread(-3, 3, count),
    }
    sign = numpy.where(spread.uniform(count) < 0.5, -1.0, 1.0)
    kind = numpy.arange(count) % 4
    points["approach_at_load"] = numpy.choose(
        kind,
        [
            FOLD_APPROACH + spread(-14, -1, count),
            sign * spread(-18, -2, count),
            spread(0, 6, count),
            spread(6, 60, count),
        ],
    )
    return _at_loads(
        points,
        numpy.choose(
            kind,
            [
                spread(-15, -2, count) - 1,
                -8 / 9 * (1 + sign * spread(-15, -2, count)),
                sign * spread(-18, -2, count),
                spread(0, 9, count),
            ],
        ),
    )


class _generator:  # noqa: N801
    """Numbers of any magnitude between two powers of ten; the same ones every time."""

    def __init__(self) -> None:
        import numpy

        self.random = numpy.random.default_rng(_SEED)

    def __call__(self, low: float, high: float, count: int) -> Any:
        return 10 ** self.random.uniform(low, high, count)

    def uniform(self, count: int) -> Any:
        """Numbers between 0 and 1."""
        return self.random.uniform(size=count)


def _at_loads(points: dict[str, Any], ratio: Any) -> Arrays:
    """Points with the pull-off force, as it is rounded, and a load that is a multiple of it."""
    import numpy

    reduced = reduced_radius(radius=points["radius"], radius2=points["radius2"])
    force = pull_off_force(work_of_adhesion=points["work_of_adhesion"], reduced_radius=reduced)
    load = numpy.maximum(ratio * force, -force)
    return {**points, "pull_off_force": force, "load": load, "approach": numpy.ones_like(load)}


def point_maker(points: Arrays) -> Callable[[int], dict[str, float]]:
    """One of the points, by its place, as floats."""
    return lambda place: {name: float(values[place]) for name, values in points.items()}
