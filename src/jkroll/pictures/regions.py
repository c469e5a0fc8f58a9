"""Regions of maps where the model has no meaning or is not exact."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple

from ..errors import NoResult
from ..quantities.nomenclature import INFINITY, NOMENCLATURE
from ..scene.errors import MissingInput
from ..scene.limits import LIMITS, limits_of
from ..scene.scene import Scene
from .axes import Axis
from .maps import Region, solved

_LIMITS = {limit.name: limit for limit in LIMITS}
COARSE = 200  # points a side that are enough for the smooth border of a region


class Bound(NamedTuple):
    """A number that limits the model: how it is computed, and on which side of which value there is no meaning."""

    names: tuple[str, ...]
    value: Callable[..., Any]
    limit: float
    is_least: bool
    text: str
    kind: str = "hatched"
    beyond: str = ""  # of a border: what holds on its wrong side

    @property
    def broken(self) -> str:
        """The sentence about values beyond the bound."""
        return self.beyond or self.text

    def margin(self, scene: Scene, values: Mapping[str, Any]) -> Any:
        """Return the distance of values from the bound in powers of ten, negative beyond it."""
        import numpy

        ratio = numpy.log10(self.value(**solved(scene, self.names, values)) / self.limit)
        return ratio if self.is_least else -ratio


def bounds() -> tuple[Bound, ...]:
    """Return the bounds of the model: first those beyond which it has no meaning, then the one from which it is exact."""
    return (
        _bound("contact_radius_in_spacings"),
        _bound("displacement_ratio"),
        _bound("tabor_parameter"),
        _border("JKR", _LIMITS["tabor_parameter"].doubts[0].threshold, is_least=True),
    )


def bounds_of(scene: Scene, quantity: str) -> list[Bound]:
    """Return the bounds that concern a quantity of a scene; the Tabor parameter bounds JKR and DMT, not Maugis' law."""
    try:
        touched = {limit.name for limit in limits_of(scene, [quantity])}
    except MissingInput:
        return []
    if scene.law.is_default:
        return [bound for bound in bounds() if bound.names[0] in touched]
    found = [bound for bound in bounds() if bound.names[0] in touched - {"tabor_parameter"}]
    if "tabor_parameter" in touched and scene.law.tabor_below < INFINITY:
        found.append(_border(scene.law.title, scene.law.tabor_below, is_least=False))
    return found


def regions(scene: Scene, bounds: Iterable[Bound], x: Axis, y: Axis) -> list[Region]:
    """Return the regions in which bounds are broken. A bound that lacks an input is left out."""
    import numpy

    x, y = (axis._replace(size=min(axis.size, COARSE)) for axis in (x, y))
    here = {**x.inputs(x.values()[None, :]), **y.inputs(y.values()[:, None])}
    found = []
    for bound in bounds:
        try:
            margin = numpy.broadcast_to(bound.margin(scene, here), (y.size, x.size))
        except (MissingInput, NoResult):
            continue
        if bound.kind == "border" and (margin < 0).all():
            found.append(Region(f"everywhere {bound.broken}", x, y, margin, "everywhere"))
        elif (margin < 0).any():
            found.append(Region(bound.text, x, y, margin, bound.kind))
    return found


def margin_along(scene: Scene, bound: Bound, x: Axis) -> Any:
    """Return the distance from a bound along one axis, negative beyond it."""
    import numpy

    values = x.values()
    return numpy.broadcast_to(bound.margin(scene, x.inputs(values)), values.shape)


def _bound(name: str) -> Bound:
    """Return the outermost doubt of a limit of the model as a bound."""
    limit = _LIMITS[name]
    doubt = limit.doubts[-1]
    is_least = limit.sign.startswith("<")
    text = f"{NOMENCLATURE[name].symbol} {'<' if is_least else '>'} {doubt.threshold:g}: {doubt.consequence}"
    return Bound((name,), _same, doubt.threshold, is_least, text)


def _border(law: str, threshold: float, *, is_least: bool) -> Bound:
    """Return the line beyond which a law of attraction is not exact, as a bound of the Tabor parameter."""
    side, sign = ("larger", "<") if is_least else ("smaller", ">")
    text = f"μ = {threshold:g}: {law} holds where it is {side}"
    beyond = f"μ {sign} {threshold:g}, {law} is not exact"
    return Bound(("tabor_parameter",), _same, threshold, is_least, text, "border", beyond)


def _same(**values: Any) -> Any:
    """Return the only value."""
    (value,) = values.values()
    return value
