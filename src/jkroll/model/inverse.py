"""The inverse problem: frames with one or two inputs inferred from as many measured quantities."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import cached_property
from math import nan
from typing import Any

from ..errors import BadRequest, JkrollError, NoResult
from ..physics.elementary import NUMBER, where
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES
from ..quantities.values import is_uncertain, middle
from .column import Column, broadcast
from .frame import Frame, check_exclusive
from .plan import Plan, formula_of, in_order
from .reasons import MissingInput, reason_of
from .search import Problem, Solution, solved
from .unknowns import SIZES, already_given, inputs_named


class Inverse(Frame):
    """A frame in which one or two inputs are unknown, and as many quantities are measured.

    Its columns come from the frame `found`, in which the unknowns have values. The search starts when the first column
    is asked for; until then, placeholders for the unknowns suffice to make plans. A material's value of an unknown
    is not used.
    """

    few = 0  # no points of uncertain inputs are computed with floats, as a search needs arrays

    def __init__(
        self, unknowns: Sequence[str], measured: Mapping[str, Any], known: Frame, near: "Inverse | None" = None
    ) -> None:
        """`measured`: values by quantity, possibly uncertain or arrays; `known`: a frame of the known inputs.

        `near`: a frame whose solution starts Newton's method, for two unknowns in arrays. Raises BadRequest for invalid
        unknowns or quantities.
        """
        self.unknowns, self.measured, self.near = tuple(inputs_named(unknowns)), measured, near
        self.levels = {name: middle(value) for name, value in measured.items()}
        self.problem = Problem(self.unknowns, self.levels, known)
        _check(self.problem)
        filled = self.problem.filled
        materials = filled.material, filled.material2
        super().__init__(
            filled.described, *materials, model=filled.stated_model, moved=filled.moved, state=filled.state
        )
        self.uncertain |= {name: value for name, value in measured.items() if is_uncertain(value)}
        self.arrays |= {name: level for name, level in self.levels.items() if not isinstance(level, NUMBER)}
        self.shape = broadcast(self.arrays)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the description; results are computed again."""
        return Inverse, (self.unknowns, self.measured, self.problem.frame)

    def replace(self, **values: Any) -> "Inverse":
        """Return the frame with other values of inputs and measured quantities."""
        measured = {name: values.pop(name, value) for name, value in self.measured.items()}
        return Inverse(self.unknowns, measured, self.problem.frame.replace(**values), self)

    @property
    def filled(self) -> Frame:
        """The frame with placeholders for the unknowns."""
        return self.problem.filled

    # --- Plans: an unknown follows from the measured quantities, so it has their plans and inputs ---

    def judged(self, names: Iterable[str]) -> list[str]:
        """Return the quantities, with the measured quantities in place of any unknown."""
        judged: dict[str, None] = {}
        for name in names:
            judged |= dict.fromkeys(self.measured if name in self.unknowns else (name,))
        return [*judged]

    def plans(self, *names: str) -> list[Plan]:
        """Return the plans of quantities; for an unknown, those of the measured quantities."""
        return super().plans(*self.judged(names))

    def missing(self, names: Iterable[str]) -> list[str]:
        """Return the quantities that the inputs do not determine."""
        return [name for name in names if super(Inverse, self).missing(self.judged([name]))]

    def inputs_of(self, *wanted: str) -> tuple[str, ...]:
        """Return the inputs that quantities depend on; an unknown also depends on the measured quantities."""
        measured = self.measured.keys() if not {*self.unknowns}.isdisjoint(wanted) else ()
        return in_order({*super().inputs_of(*wanted), *measured} - self.problem.sought.keys())

    def inputs_used(self, names: Sequence[str]) -> Collection[str]:
        """Return those inputs of the frame that quantities depend on, without the unknowns."""
        return {*self.filled.inputs_used(self.judged(names))} - self.problem.sought.keys()

    def missing_input(self, name: str) -> MissingInput:
        """Return the error for a quantity that needs more inputs; for an unknown, the error of a measured quantity."""
        first = next(iter(Frame.missing(self, self.judged([name]))), name)
        return super().missing_input(first)

    def echo(self, used: Collection[str]) -> dict[str, Any]:
        """Return the inputs that are used or stated, as understood, and the measured values."""
        known = self.problem.frame
        return {**known.echo(known.known.intersection(used)), **self.levels}

    # --- The solution ---

    def check(self) -> None:
        """Raise MissingInput or NoDependence if no measured value can have a solution."""
        self.problem.check()

    @cached_property
    def solution(self) -> Solution:
        """The values of the unknowns, with the reasons of rows without a solution.

        Raises BadRequest if two solids vary by row and an unknown is a property, which may then be of one sphere or of
        both.
        """
        solids = [solid.name for solid, _ in self.materials]
        if solids[1:] and not all(solids) and not {*PROPERTIES}.isdisjoint(self.unknowns):
            raise BadRequest("an unknown property needs a material in every row; otherwise its sphere is not known")
        start = self.near.solution.positions if self.near is not None and self.unknowns[1:] else None
        try:
            return solved(self.problem, start)
        except (MissingInput, NoResult) as error:
            return Solution(dict.fromkeys(self.unknowns, nan), reasons=reason_of(error), failure=error)

    @cached_property
    def found(self) -> Frame:
        """The frame in which the unknowns have values, or reasons in rows without a solution."""
        values, reasons = self.solution.values, self.solution.reasons
        filled = {name: where(reasons == 0, value, SIZES[name][1]) for name, value in values.items()}
        frame = self.problem.with_values(filled)
        if not isinstance(reasons, int) or reasons:
            for name, unknown in self.problem.sought.items():
                frame.values[name], frame.reasons[name] = values[unknown], reasons
        return frame

    def column(self, name: str) -> Column:
        """Return the column of a quantity."""
        return self.found.column(name)

    def error(self, name: str, number: int, row: int = 0) -> JkrollError:
        """Return the reason for an empty cell as an error, which may be an error of the search."""
        failure = self.solution.failure or self.solution.failures.get(row)
        return self.found.error(name, number, row) if failure is None else failure


def _check(problem: Problem) -> None:
    """Raise BadRequest for unknowns and quantities that conflict with other inputs, or that no formula gives."""
    known, unknowns = problem.frame, problem.unknowns
    for name in (*unknowns, *problem.levels):
        if name in known.stated or (name in unknowns and name in problem.levels):
            raise already_given(name)
    check_exclusive({*unknowns, *known.stated})
    for quantity in problem.levels:
        if formula_of(quantity) is None and problem.filled.missing([quantity]):
            option = NOMENCLATURE[quantity].option or quantity
            remedy = f"give it as {option}, and ask for {unknowns[0]} without infer"
            raise BadRequest(f"{quantity} is an input, and no formula gives it; {remedy}")
