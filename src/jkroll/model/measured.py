"""Measurements on solids: forces and displacements where rolling starts, sticking speeds, pull-off on surfaces."""

from collections.abc import Callable, Iterable, Mapping
from functools import cache, partial
from typing import Any, NamedTuple

from ..materials.library import Material
from ..physics.contact import pull_off_force
from ..physics.elementary import at_least, at_most, cbrt, where
from ..quantities.nomenclature import INFINITY, XI
from .accepted import takes
from .frame import ROLLING_ONSET, Frame, Variant
from .plan import depends_on

VISCOUS_TIME = "viscous_time"  # an input that decides the losses if it is given
SIO2, POLYSTYRENE, MICA = "SiO2", "polystyrene", "mica"


def is_smooth(material: Material | None) -> bool:
    """Return whether a material counts as atomically smooth; only mica does."""
    return material is not None and MICA in (material.name, *material.aliases)


def measured_solid(material: Material) -> str:
    """Return the measured solid that a material consists of: SiO2, polystyrene, or an empty name.

    Ice is left out, since its surface energy was itself scaled from rolling forces.
    """
    if SIO2 in material.aliases:
        return SIO2
    return POLYSTYRENE if material.name in (POLYSTYRENE, "polystyrene-glassy") else ""


def solid_of_pair(frame: Frame) -> str:
    """Return the measured solid that both spheres consist of, or an empty name."""
    solid = frame.material
    measured = measured_solid(solid) if solid is not None else ""  # empty if the solids vary by row
    return measured if frame.material2 in (None, solid) else ""


# --- Measured rolling -------------------------------------------------------------------------------------------------


class Rolled(NamedTuple):
    """A measurement for two identical spheres, and the pairs to which it is scaled between R^(2/3) and R."""

    name: str  # the quantity: the force or the displacement that starts rolling
    source: str
    low: float  # the least measured value minus its error
    high: float  # the largest plus its error
    radius: float  # of the measured spheres
    radii: tuple[float, float]  # of the pairs: twice their reduced radii
    energies: tuple[float, float] = (0.0, INFINITY)  # surface energies of the pairs

    def least(self, radius: Any) -> Any:
        """Return the least value for two identical spheres of a radius."""
        return self.low * at_most(*_scales(radius / self.radius))

    def most(self, radius: Any) -> Any:
        """Return the largest value for two identical spheres of a radius."""
        return self.high * at_least(*_scales(radius / self.radius))

    @property
    def variants(self) -> tuple[Variant, Variant]:
        """The functions that set a frame's displacement to the least and to the largest measured value."""
        return _end_of(self, Rolled.least), _end_of(self, Rolled.most)

    def can_be_scaled(self, frame: Frame) -> Any:
        """Return whether the measurement can be scaled to a pair, row by row for arrays."""
        radius = frame.numbers("reduced_radius").get("reduced_radius", 0.0)
        return self.has_size(2 * radius) & self.has_energy(frame)

    def has_energy(self, frame: Frame) -> Any:
        """Return whether a pair has a surface energy for which the measurement counts."""
        low, high = self.energies
        energy = frame.numbers("work_of_adhesion").get("work_of_adhesion", 0.0) / 2
        return (low <= energy) & (energy <= high)

    def has_size(self, radius: Any) -> Any:
        """Return whether the measurement can be scaled to two identical spheres of a radius."""
        least, most = self.radii
        return (least <= radius) & (radius <= most)


def _scales(ratio: Any) -> tuple[Any, Any]:
    """Return two factors for a force or a displacement at another radius: the ratio of radii, and its power 2/3."""
    return ratio, cbrt(ratio) * cbrt(ratio)


@cache
def _end_of(rolled: Rolled, end: Callable[[Rolled, Any], Any]) -> Variant:
    """Return `_rolled_at` for an end of a measurement; the same end gives the same function."""
    return partial(_rolled_at, rolled, end)


def _rolled_at(rolled: Rolled, end: Callable[[Rolled, Any], Any], frame: Frame) -> Frame:
    """Return a frame with the displacement that an end of a measurement implies without load, by the frame's law.

    Scaled to a very different radius, a measurement may imply less than the assumed displacement of about one atom. The
    frame then keeps the assumed one.
    """
    radius = 2 * frame["reduced_radius"]
    measured = end(rolled, radius)
    if rolled.name == XI:
        return _with_displacement(frame, at_least(measured, frame[XI]))
    moment = measured * radius  # the force acts at the centre of a sphere
    return _with_displacement(frame, at_least(frame[XI] * (moment / frame["unloaded_moment"]), frame[XI]))


ROLLED: Mapping[str, Rolled] = {
    # 0.85 ± 0.16 and 1.21 ± 0.36 nN, on spheres with the surface energy of humid silica
    SIO2: Rolled("yield_force", "Heim 1999, Gundlach 2011", 0.69e-9, 1.57e-9, 0.95e-6, (1e-7, 3e-6), (0.02, 0.025)),
    # 42 nm, spheres of radius 5 µm on a plane, which are like two spheres of radius 10 µm
    POLYSTYRENE: Rolled(XI, "Sümer & Sitti 2008", 42e-9, 42e-9, 1e-5, (3e-6, 1e-4)),
    # 11.48 ± 2.38 nN
    "ice-warm": Rolled("yield_force", "Gundlach 2011", 9.10e-9, 13.86e-9, 1.45e-6, (0.5e-6, 5e-6)),
}


def solid_that_rolled(frame: Frame) -> str:
    """Return the solid of both spheres if rolling on it was measured, otherwise an empty name."""
    solid = frame.material
    if solid is None or frame.material2 not in (None, solid):
        return ""
    return solid.name if solid.name in ROLLED else measured_solid(solid)


def what_rolled(frame: Frame) -> Rolled | None:
    """Return the measurement of rolling on the solid of both spheres, for any size; None without one."""
    return ROLLED.get(solid_that_rolled(frame))


# --- Measured sticking ------------------------------------------------------------------------------------------------


class Stuck(NamedTuple):
    """The largest speed at which spheres of some radii stuck to a plane, as a power of the radius.

    For other pairs, this speed is scaled in proportion to the sticking speed by the law in use. It does not count for
    pairs whose properties are outside the ranges in `properties`.
    """

    speed: float
    radius: float
    exponent: float
    error: float  # relative
    radii: tuple[float, float]  # of the measured spheres
    scaled: tuple[float, float]  # twice the reduced radii of the pairs to which the speed is scaled
    properties: Mapping[str, tuple[float, float]]  # the least and the largest value of each

    def at(self, radius: Any) -> Any:
        """Return the largest speed at which spheres of a radius stick."""
        return self.speed * (radius / self.radius) ** self.exponent

    def ends(self, frame: Frame) -> tuple[Any, Any]:
        """Return the least and the largest measured speed at the radius of a frame."""
        speed = self.at(frame["radius"])
        return speed * (1 - self.error), speed * (1 + self.error)

    def in_proportion(self, frame: Frame) -> tuple[Any, Any]:
        """Return the least and the largest speed for a frame, in proportion to the sticking speed by its law."""
        speeds = [
            self.at(radius) / frame.replace(radius=radius, radius2=INFINITY)["sticking_speed"] * frame["sticking_speed"]
            for radius in self.radii
        ]
        return at_most(*speeds) * (1 - self.error), at_least(*speeds) * (1 + self.error)

    def can_be_scaled(self, frame: Frame) -> Any:
        """Return whether the measurement can be scaled to a pair, row by row for arrays."""
        least, most = self.scaled
        radius = 2 * frame["reduced_radius"]
        return (least <= radius) & (radius <= most) & self._is_alike(frame)

    def _is_alike(self, frame: Frame) -> Any:
        """Return whether a pair has the properties of the measured solid, as far as they are known."""
        is_alike: Any = True
        for name, value in frame.numbers(*self.properties).items():
            least, most = self.properties[name]
            is_alike = is_alike & (least <= value) & (value <= most)
        return is_alike

    def is_near(self, frame: Frame) -> Any:
        """Return whether the pair is like the measured ones: a sphere of these radii on a plane, without damping."""
        least, most = self.radii
        is_measured = (least <= frame["radius"]) & (frame["radius"] <= most)
        is_measured = is_measured & (frame["radius2"] == INFINITY) & (VISCOUS_TIME not in frame.stated)
        return is_measured & self._is_alike(frame)


STUCK: Mapping[str, Stuck] = {
    # Poppe, Blum & Henning 2000, second hand: 1.9 m/s at 0.25 µm and 1.2 m/s at 0.6 µm, on a plane of silica
    SIO2: Stuck(
        1.2,
        0.6e-6,
        -0.53,
        0.3,
        (0.25e-6, 0.6e-6),
        scaled=(1e-7, 3e-6),
        # silica in humid air to baked silica, and quartz
        properties={"work_of_adhesion": (0.02, 0.5), "contact_modulus": (1e10, 1e11), "density": (1e3, 5e3)},
    ),
}


def what_stuck(frame: Frame) -> Stuck | None:
    """Return the measurement of sticking on the solid of both bodies, for any size; None without one."""
    return STUCK.get(solid_of_pair(frame))


MOST_SEEN = 10  # largest speed at which hard spheres were seen to stick, in units of the speed by JKR


# --- Measured pull-off ------------------------------------------------------------------------------------------------


class Surface(NamedTuple):
    """The range of the measured fraction of JKR's pull-off force on SiO2, this range in words, and the spheres."""

    low: float
    high: float
    fraction: str
    spheres: str


SURFACES: Mapping[str, Surface] = {
    "smooth glass, dry air": Surface(1 / 4, 1 / 2, "1/4–1/2", "spheres of 5 and 20 µm"),
    "smooth glass, humid air": Surface(1 / 2, 4 / 5, "1/2–4/5", "the same at 67 % humidity"),
    "rough grains, air": Surface(1 / 100, 1 / 10, "1/100–1/10", "grains of tens of µm"),
}
SURFACES_FROM = 1e-6  # radius of the smallest spheres to which these fractions are scaled, in m
ENERGY_ON_SURFACES = 0.025  # surface energy of the JKR force that these fractions refer to, in J/m²
FRACTION_HELD = "1/100 to 4/5 of JKR's force"  # all surfaces together
SIZES_HELD = "5 µm and more"  # the measured spheres


_ENERGIES = frozenset({"surface_energy", "surface_energy2", "work_of_adhesion", "hamaker"})
LIKE_SIO2 = "real spheres, a guess"  # all surfaces together, for pairs on which nothing was measured


def on_surfaces(frame: Frame, ends: tuple[float, float] | None = None) -> Mapping[str, tuple[float, float]]:
    """Return the least and the largest pull-off force on each surface; `ends`: the ends of JKR's force.

    For SiO2, the forces are measured fractions of JKR's force at 25 mJ/m², or at the surface energy that was given. For
    another solid, or a sphere smaller than 1 µm, one range covers all the fractions measured for SiO2.
    """
    radius, energy = frame["reduced_radius"], frame["work_of_adhesion"]
    force = float(pull_off_force(work_of_adhesion=energy, reduced_radius=radius))  # a frame of rigid bodies has none
    low, high = (force, force) if ends is None else ends
    is_silica = solid_of_pair(frame) == SIO2
    if is_silica and not has_given_energy(frame):
        low = high = force * 2 * ENERGY_ON_SURFACES / energy
    forces = {name: (low * surface.low, high * surface.high) for name, surface in SURFACES.items()}
    if is_silica and not is_below_scaled(frame):
        return forces
    lows, highs = zip(*forces.values(), strict=True)
    return {LIKE_SIO2: (min(lows), max(highs))}


def has_given_energy(frame: Frame) -> bool:
    """Return whether the surface energy is a given one, rather than the material's."""
    return not _ENERGIES.isdisjoint(frame.stated)


def is_below_scaled(frame: Frame) -> bool:
    """Return whether the smaller sphere is smaller than those to which the measured fractions are scaled."""
    radii = frame.numbers("radius", "radius2").values()
    return bool(min(radii, default=2 * frame["reduced_radius"]) < SURFACES_FROM)


# --- Quantities that depend on the displacement ----------------------------------------------------------------------


def rolling(names: Iterable[str]) -> list[str]:
    """Return the quantities that depend on the yield displacement, by the formulas of JKR."""
    return [name for name in names if name != XI and XI in depends_on((name,))]


def assumes_displacement(frame: Frame) -> bool:
    """Return whether the paper's displacement is assumed, under a law that relates displacements to forces."""
    return XI in frame.values and frame.given.keys().isdisjoint(ROLLING_ONSET) and not frame.plan("yield_force").lacking


def at_full_hysteresis(frame: Frame) -> Frame:
    """Return the frame with the displacement at which all of the work of adhesion is lost."""
    return _with_displacement(frame, frame[XI] / frame["hysteresis_ratio"])


def _with_displacement(frame: Frame, displacement: Any) -> Frame:
    """Return the frame with this displacement in the rows where it is in the accepted range."""
    return frame.replace(**{XI: where(takes(XI, displacement), displacement, frame[XI])})
