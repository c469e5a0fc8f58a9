"""The answers of a frame in the form that tests need."""

from collections.abc import Iterable, Mapping, Sequence
from functools import reduce
from operator import or_
from typing import Any

from jkroll.model import limits, other_law
from jkroll.model.frame import Frame
from jkroll.model.inverse import Inverse
from jkroll.model.search import Solution


def outcomes(scene: Frame, names: Iterable[str]) -> dict[str, Any]:
    """Return the value of each quantity, or the error that states why no row has a value."""
    columns = scene.columns(names)
    return {
        name: scene.error(name, column.reasons) if column.is_empty else column.values
        for name, column in columns.items()
    }


def doubts(scene: Frame, names: Iterable[str], judged: Iterable[limits.Limit] = limits.LIMITS) -> list[limits.Doubt]:
    """Return the doubts about quantities, one for each limit that concerns them."""
    return limits.doubts(scene, scene.columns(names), judged)


def factor_of_law(scene: Frame, names: Iterable[str]) -> Any:
    """Return the largest factor between quantities and their values under Maugis' law."""
    return other_law.factor_of_law(scene, scene.columns(names))


def bits(scene: Frame, names: Sequence[str]) -> Any:
    """Return the codes of the exceeded limits of quantities as bits, for every row."""
    return reduce(or_, (doubt.bits for doubt in doubts(scene, names)), 0)


def solved(unknowns: Sequence[str], measured: Mapping[str, Any], known: Frame) -> Solution:
    """Return the solution for unknowns; raise the reason if no row has one."""
    inverse = Inverse(unknowns, measured, known)
    for name in inverse.unknowns:
        inverse[name]
    return inverse.solution
