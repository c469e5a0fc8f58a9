"""What a frame answers, in the form in which tests ask for it."""

from collections.abc import Iterable, Mapping, Sequence
from functools import reduce
from operator import or_
from typing import Any

from jkroll.model import limits, other_law
from jkroll.model.frame import Frame
from jkroll.model.inverse import Inverse
from jkroll.model.search import Solution


def outcomes(scene: Frame, names: Iterable[str]) -> dict[str, Any]:
    """Return the value of each quantity, or the error that says why no row has one."""
    columns = scene.columns(names)
    return {
        name: scene.error(name, column.reasons) if column.is_empty else column.values
        for name, column in columns.items()
    }


def doubts(scene: Frame, names: Iterable[str], judged: Iterable[limits.Limit] = limits.LIMITS) -> list[limits.Doubt]:
    """Return the limits of quantities, judged."""
    return limits.doubts(scene, scene.columns(names), judged)


def factor_of_law(scene: Frame, names: Iterable[str]) -> Any:
    """Return how far quantities are from those under the law that holds."""
    return other_law.factor_of_law(scene, scene.columns(names))


def bits(scene: Frame, names: Sequence[str]) -> Any:
    """Return the codes of the limits of quantities as bits, of every row."""
    return reduce(or_, (doubt.bits for doubt in doubts(scene, names)), 0)


def solved(unknowns: Sequence[str], measured: Mapping[str, Any], known: Frame) -> Solution:
    """Return what is found of unknowns; raise the reason why no row has any."""
    inverse = Inverse(unknowns, measured, known)
    for name in inverse.unknowns:
        inverse[name]
    return inverse.solution
