"""The worth of the assumed yield displacement: how far results would follow the rolling forces that were measured."""

from collections.abc import Collection, Mapping, Sequence
from math import log
from typing import NamedTuple

from ..materials.library import Displacement
from ..quantities.formatting import amount, significant
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, XI
from ..quantities.values import Interval
from ..scene.scene import DEFAULTS, IN_ITS_PLACE, Scene
from ..scene.wiring import depends_on
from ..text import first_of
from .results import Note

# Rolling forces on pairs of SiO2 spheres (Heim et al. 1999, Blum & Wurm 2000, Gundlach et al. 2011), and the pairs.
FORCES = (0.85e-9, 1.21e-9)
SOLID = "SiO2"
PAIR = {"radius": 0.95e-6, "surface_energy": 0.025, "youngs_modulus": 54e9, "poisson_ratio": 0.17}
SCALED = (1e-7, 3e-6)  # radii, of an identical pair, to which the measured displacement is scaled
ABOVE = "polystyrene has 42 nm at 5 µm, ice 0.19 mm at 1 mm"  # Sümer & Sitti; Musiolik & Wurm 2019
_AT_PAIR = 0.2  # in ln R: there the range is that of the pairs
LARGE = log(2)  # the size from which the range of ξ itself is told
MAX_SYMBOLS = 3  # of quantities, and of groups of them, in the note


class Worth(NamedTuple):
    """The range of ξ that measured forces stand for, at the pairs that were measured and at those of a scene."""

    at_pair: tuple[float, float]
    here: tuple[float, float] | None  # None where no measurement is near enough
    factors: Mapping[str, tuple[float, float]]  # of results, if ξ is that of the ends of the range
    radius: float  # of the identical pair with the same reduced radius

    @property
    def size(self) -> float:
        """The size of the doubt, as the logarithm of a factor."""
        if self.here is None:
            return INFINITY
        return max((abs(log(factor)) for ends in self.factors.values() for factor in ends), default=0.0)

    def note(self, headline: Collection[str]) -> Note:
        """Return the note on it for the results that a command is named after, or else for all: short where it is little."""
        shown = {name: ends for name, ends in self.factors.items() if name in headline} or self.factors
        if self.here is None:
            return Note("displacement", f"{_papers()}; no measurement supports it here: {ABOVE}", size=self.size)
        factors = ", ".join(_worded(shown))
        if self.size < LARGE:
            return Note("displacement", f"{_papers()}; by forces on {SOLID} {factors}", size=self.size)
        text = f"{_papers()}; forces on {SOLID} of 1 µm mean {_range(self.at_pair)}"
        if abs(log(self.radius / PAIR["radius"])) > _AT_PAIR:
            text += f", {_range(self.here)} here by our scalings, R^(2/3) to R"
        return Note("displacement", f"{text}: {factors}", size=self.size)


def worth(scene: Scene, names: Sequence[str]) -> Worth | None:
    """Return what ξ is worth for quantities of a scene; None where it is not assumed, enters none, or the spheres are small."""
    if not scene.given.keys().isdisjoint(IN_ITS_PLACE):
        return None
    following = [name for name in names if name != XI and XI in depends_on([name], [scene.law.name])]
    radius = 2 * scene.numbers("reduced_radius").get("reduced_radius", 0.0)
    if not following or radius < SCALED[0]:
        return None
    at_pair = _at_pair(scene)
    if radius > SCALED[1]:
        return Worth(at_pair, None, {}, radius)
    found = Displacement(Interval(sum(at_pair) / 2, *at_pair), PAIR["radius"]).at(radius)
    here = found.low, found.high
    values = scene.numbers(*following)
    low, high = (scene.replace(**{XI: end}).numbers(*following) for end in here)
    factors = {
        name: (low[name] / value, high[name] / value)
        for name, value in values.items()
        if value and low.get(name) and high.get(name)
    }
    return Worth(at_pair, here, factors, radius)


def _at_pair(scene: Scene) -> tuple[float, float]:
    """Return the displacements for which the measured forces stand: with the γ in use where that is of the same solid, and by its law."""
    solid = scene.material
    is_same = solid is not None and SOLID in solid.aliases and scene.material2 in (None, solid)
    own = scene.numbers("work_of_adhesion", "contact_modulus") if is_same else {}
    given = {"radius": PAIR["radius"], **own} if len(own) == 2 else PAIR
    spacing = {"atomic_spacing": scene.values["atomic_spacing"]} if "atomic_spacing" in scene.values else {}
    pair = Scene({**given, **spacing, XI: DEFAULTS[XI]}, model=scene.law.name)
    low, high = (DEFAULTS[XI] * (force / pair["yield_force"]) for force in FORCES)
    return low, high


def note_of_rows(scene: Scene) -> Note:
    """Return the note where ξ is assumed for rows of a kind, of which the scene is one."""
    text = f"{_papers()}; forces on {SOLID} of 1 µm mean {_range(_at_pair(scene))}, and it grows with the sphere"
    return Note("displacement", text)


def _papers() -> str:
    return f"ξ = {amount(XI, DEFAULTS[XI])} ({NOMENCLATURE[XI].option}) is the paper's"


def _worded(factors: Mapping[str, tuple[float, float]]) -> list[str]:
    """Return factors as texts, "Q × 9–13", those of quantities that have the same together."""
    groups: dict[str, list[str]] = {}
    for name, ends in factors.items():
        groups.setdefault(_factor(ends), []).append(NOMENCLATURE[name].symbol)
    texts = [f"{first_of(symbols, MAX_SYMBOLS)} {factor}" for factor, symbols in groups.items()]
    return texts[:MAX_SYMBOLS]


def _factor(ends: tuple[float, float]) -> str:
    """Return a range of factors as text; one that falls as a quotient."""
    low, high = sorted(ends)
    if high < 1:
        return f"/ {_number(1 / high)}–{_number(1 / low)}"
    return f"× {_number(low)}–{_number(high)}"


def _range(ends: tuple[float, float]) -> str:
    low, high = (_number(1e9 * end) for end in ends)
    return f"{low}–{high} nm"


def _number(value: float) -> str:
    """Return a number with two digits, or without decimals; a large one with a power of ten."""
    return f"{value:.0f}" if 100 <= value < 1e6 else significant(value, 2)
