"""The frame under another law of attraction, to compare with the law in use, and the factor between their results."""

from collections.abc import Iterable, Mapping
from functools import reduce
from typing import Any

from ..physics.elementary import at_least, at_most, quotient, where
from ..quantities.laws import BETWEEN, DEFAULT_LAW, PARABOLOID
from ..quantities.nomenclature import INFINITY
from .accepted import LEAST
from .column import Column
from .frame import Frame, once_a_frame
from .plan import plan_for


@once_a_frame
def at_half_spacing(frame: Frame) -> Frame:
    """Return a frame with half the atomic spacing, but not below the least that a frame accepts."""
    return frame.replace(atomic_spacing=at_least(frame["atomic_spacing"] / 2, LEAST))


def least_spacing(frame: Frame) -> Any:
    """Return the least likely atomic spacing: half the assumed one, or the given one."""
    return frame["atomic_spacing"] / (2 if frame.assumes_spacing else 1)


def by_law_at_spacing(frame: Frame, names: Iterable[str]) -> Frame:
    """Return the frame under the other law, with its atomic spacing stated if some quantities depend on it."""
    rests = any(map(frame.by_law.may_rest_on_spacing, names))
    return frame.by_law_at_spacing if rests else frame.by_law


def has_other_formulas(frame: Frame, name: str, law: str = DEFAULT_LAW) -> bool:
    """Return whether a law and the frame have different formulas for a quantity, or only one of them has a formula."""
    known, own_material2, _ = frame.plan_key
    return frame.plan(name).steps.keys() != plan_for(name, known, own_material2, law).steps.keys()


def moved_by_law(frame: Frame, names: Iterable[str]) -> list[str]:
    """Return the quantities for which the other law has different formulas, or is the only law with a formula."""
    other = frame.by_law
    return [name for name in other.possible(names) if has_other_formulas(frame, name, other.law.name)]


def factor_of_law(frame: Frame, columns: Mapping[str, Column]) -> Any:
    """Return the largest factor between the results by the law in use and by Maugis' law; 1 if the latter is in use.

    A pull-off force is also compared with Lennard-Jones' law. The factor is infinite if only the law in use has a
    result, or if signs differ.
    """
    if frame.law.name == BETWEEN:
        return 1.0
    if frame.law.profile != PARABOLOID:  # the law is judged for a paraboloid
        frame = frame.under(DEFAULT_LAW)
        columns = frame.columns(columns)
    ours = {name: columns[name].values for name in moved_by_law(frame, columns) if not columns[name].is_empty}
    other = by_law_at_spacing(frame, ours)
    compared = [*other.columns(ours).items()]
    if "pull_off_force" in ours:
        compared.append(("pull_off_force", frame.column("pull_off_force_lennard_jones")))
    return farthest((theirs.or_zero(), ours[name]) for name, theirs in compared)


def farthest(answers: Iterable[tuple[Any, Any]]) -> Any:
    """Return the largest factor (or inverse factor) between two answers, over all pairs; 1 if there are none.

    The factor of a pair is infinite if its first answer is 0 or the signs differ, and 1 if the second is missing or 0.
    """
    ratios: list[Any] = [1.0]
    ratios += (quotient(theirs, ours, 1.0) for theirs, ours in answers)
    least, most = reduce(at_most, ratios), reduce(at_least, ratios)
    is_positive = least > 0
    return where(is_positive, at_least(most, 1 / where(is_positive, least, 1.0)), INFINITY)
