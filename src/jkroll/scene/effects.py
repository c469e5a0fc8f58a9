"""Distances of answers under a law of attraction from those under the law that holds between JKR and DMT."""

from collections.abc import Collection, Mapping, Sequence
from functools import reduce
from typing import Any, NamedTuple

from ..errors import JkrollError
from ..physics.elementary import at_least, at_most, quotient, where
from ..quantities.laws import BETWEEN, DEFAULT_LAW, routed_apart
from ..quantities.nomenclature import INFINITY, XI
from .scene import DEFAULTS, IN_ITS_PLACE, LEAST, MOST, Scene
from .wiring import depends_on


class Effect(NamedTuple):
    """An answer under the law that holds, over that under the law in use: numbers, or arrays.

    It is 0, or nan in an array, where only the law in use has an answer.

    `readings`: of a rolling quantity, the ratio at equal displacement and at equal hysteresis of adhesion.
    `lennard_jones`: of a pull-off force, the ratio by the fit for Lennard-Jones' law.
    """

    ratio: Any  # with equal inputs
    readings: tuple[Any, Any] | None = None
    lennard_jones: Any = None

    @property
    def ratios(self) -> tuple[Any, ...]:
        """All of them."""
        own = self.readings or (self.ratio,)
        return own if self.lennard_jones is None else (*own, self.lennard_jones)

    @property
    def factor(self) -> Any:
        """The distance of the answers by the farthest of these, as a factor of at least 1."""
        return _apart(self.ratios)


def largest(found: Mapping[str, Effect]) -> Any:
    """Return the largest factor of some effects; 1 if there are none."""
    ratios = [ratio for effect in found.values() for ratio in effect.ratios]
    return _apart(ratios) if ratios else 1.0


def _apart(ratios: Sequence[Any]) -> Any:
    """Return the one of some ratios that is farthest from 1, or its inverse if that is larger; infinite where answers differ in sign."""
    least, most = reduce(at_most, ratios), reduce(at_least, ratios)
    is_positive = least > 0
    return where(is_positive, at_least(most, 1 / where(is_positive, least, 1.0)), INFINITY)


def effects(scene: Scene, names: Collection[str]) -> dict[str, Effect]:
    """Return by quantity how far its value is from that under Maugis' law, for those that rest on the law of attraction."""
    if scene.law.name == BETWEEN:
        return {}
    between = between_of(scene)
    missing = between.missing([*names])
    own = scene.numbers(*(name for name in names if name not in missing and uses_law(between, name)))
    theirs = between.evaluate([*own])
    rolling = [name for name in own if XI in depends_on([name], [BETWEEN])]
    beside = _other_reading(scene, between) if rolling else None
    at_other = beside.evaluate(rolling) if beside is not None else {}
    found = {}
    for name, value in own.items():
        ratio = _ratio(theirs[name], value)
        readings = None
        if name in at_other:
            other = _ratio(at_other[name], value)
            readings = (ratio, other) if _is_at_displacement(scene) else (other, ratio)
        found[name] = Effect(ratio, readings)
    if "pull_off_force" in found:
        fit = scene.evaluate(["pull_off_force_lennard_jones"])["pull_off_force_lennard_jones"]
        found["pull_off_force"] = found["pull_off_force"]._replace(lennard_jones=_ratio(fit, own["pull_off_force"]))
    return found


def between_of(scene: Scene) -> Scene:
    """Return a scene under the law that holds, with the atomic spacing that was given or is assumed."""
    return scene.replace(model=BETWEEN, atomic_spacing=scene["atomic_spacing"])


def _is_at_displacement(scene: Scene) -> bool:
    """Return whether equal inputs are equal displacements, and not equal hystereses."""
    return scene.given.keys().isdisjoint(IN_ITS_PLACE[1:])


def _other_reading(scene: Scene, between: Scene) -> Scene | None:
    """Return a scene between the laws with the other of equal displacement and equal hysteresis; None without a contact."""
    needed = ("adhesive_force", "zone_radius")
    own, theirs = scene.numbers(XI, *needed), between.numbers(*needed)
    if len(own) <= len(needed) or len(theirs) < len(needed):
        return None
    is_at_displacement = _is_at_displacement(scene)
    displacement = own[XI]
    if is_at_displacement:
        forces, radii = (own[name] / theirs[name] for name in needed)
        displacement = displacement * forces / radii
    is_known = (displacement >= LEAST) & (displacement <= MOST)
    where_none = own[XI] if is_at_displacement else DEFAULTS[XI]  # where there is no contact
    displacement = where(is_known, displacement, where_none)
    return between.replace(**{**dict.fromkeys(IN_ITS_PLACE), XI: displacement})


def _ratio(theirs: Any, own: Any) -> Any:
    """Return the ratio of two answers: 0, or nan in an array, where only the second exists, 1 where that has none or is nought."""
    return quotient(0.0 if isinstance(theirs, JkrollError) else theirs, own, 1.0)


def uses_law(scene: Scene, name: str) -> bool:
    """Return whether a quantity of a scene rests on a formula that JKR does not have."""
    plan, apart = scene.plan(name), routed_apart(scene.law.name, DEFAULT_LAW, scene.known)
    return plan.found[name] in apart or any(source in apart for step in plan.steps for _, source in step.arguments)
