"""The inverse problem in rows: columns of the unknowns of a table, and `jkroll.infer` for numbers and arrays."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from contextlib import suppress
from functools import cached_property, reduce
from operator import or_
from typing import Any, overload

from ..errors import BadRequest, NoResult
from ..materials.library import Material, Materials
from ..physics.elementary import where
from ..quantities.nomenclature import PROPERTIES, named
from ..quantities.values import QuantityError, Spread, is_uncertain, middle
from .column import Column
from .containers import Reader
from .frame import Frame
from .inverse import Problem
from .limits import Doubt
from .plan import in_order
from .ranges import check_range
from .reasons import MissingInput
from .results import Results
from .rows import Wanted, sides_in
from .solver import materials_of, with_uncertainties
from .sweep import Sweep
from .unsolved import already_given, inputs_named


class Unknowns(Wanted):
    """Unknowns of rows, each of which is a problem."""

    def results(self, frame: Problem) -> Results:
        """Return the results of a problem, or of several."""
        solids = [solid.name for solid, _ in frame.frame.materials]
        if solids[1:] and not all(solids) and not {*PROPERTIES}.isdisjoint(self.names):
            # Solids of many rows have no name: each row by itself says.
            raise BadRequest("of which spheres an unknown is")
        return Found(frame, frame.columns(self.names), keeps_all=self.keeps_all)


class Found(Results):
    """The unknowns of a problem, whose limits are those of what was measured, in the frame with them."""

    @cached_property
    def forward(self) -> Results:
        """The measured quantities; none where the unknowns have no value."""
        if any(column.is_empty for column in self.computed.values()):
            return Results(self.frame.filled, {})
        solved = self.frame.solved
        return Results(solved, solved.columns(self.frame.measured), keeps_all=self.keeps_all)

    @cached_property
    def meant(self) -> Mapping[str, Column]:
        """The columns without values that have no meaning: all or none of a row, by what was measured."""
        measured = [*self.forward.computed]
        return {name: self.forward.without_meaning(name, column, measured) for name, column in self.computed.items()}

    @property
    def ending(self) -> Sequence[Doubt]:
        """The limits that end the meaning of the measured quantities."""
        return self.forward.ending

    @property
    def validity(self) -> Sequence[Doubt]:
        """The limits of the measured quantities."""
        return self.forward.validity

    @property
    def bits(self) -> Any:
        """The codes of the limits that do not hold as bits, of rows that have values."""
        return self._of_rows(self.forward.bits)

    @property
    def ending_bits(self) -> Any:
        """The codes of the limits that end the meaning of results as bits, of rows that have values."""
        return self._of_rows(self.forward.ending_bits)

    def _of_rows(self, bits: Any) -> Any:
        return where(reduce(or_, (column.reasons == 0 for column in self.computed.values())), bits, 0)


class Problems(Sweep):
    """The rows of the inverse problem: each has measured values among its inputs."""

    most_answers = 10_000  # each takes milliseconds
    most_in_table = 500
    few = 10

    def __init__(self, names: Sequence[str], measured: Mapping[str, Sequence[Spread]], given: Sweep) -> None:
        """`names`: of the unknowns; `measured`: the lists and ranges of the values of each quantity."""
        for name in measured.keys() & given.spreads.keys():
            raise already_given(name)
        super().__init__(given.pairs, {**given.spreads, **measured}, given.models)
        self.names, self.quantities = names, [*measured]

    def frame(self, given: Mapping[str, Any], *spheres: Material | None, model: str | None) -> Problem:
        """Return a row of inputs among which are the measured values."""
        measured = {name: given[name] for name in self.quantities}
        others = {name: value for name, value in given.items() if name not in measured}
        return Problem(tuple(self.names), measured, Frame(others, *spheres, model=model))

    def wanted(self, quantities: Sequence[str], named: Sequence[str], *, keeps_all: bool = False) -> Unknowns:
        """Return the columns of the unknowns. Raises the error of the inputs."""
        for problem in self.kinds:
            with suppress(MissingInput, NoResult):  # each row says why it has no value
                problem.check()
        sides = sides_in((problem, quantities) for problem in self.kinds)
        inputs = {name for problem in self.kinds for name in problem.echo(problem.inputs_used(quantities))}
        return Unknowns(quantities, named=named, inputs=in_order(inputs), sides=sides, keeps_all=keeps_all)

    def headline(self, quantities: Sequence[str], named: Collection[str], *, doubts: bool) -> Unknowns:
        """Return the columns of the unknowns alone, with all numbers."""
        return Unknowns(quantities, named=named, doubts=doubts, keeps_all=True)

    def noted(self, wanted: Wanted) -> Iterable[tuple[Frame, Sequence[str]]]:  # noqa: ARG002
        """Return a frame of each kind of rows, with the measured quantities."""
        return [(problem.filled, self.quantities) for problem in self.kinds]


# --- From Python ------------------------------------------------------------------------------------------------------


class InferredValues(dict[str, Any]):
    """The values of inputs by name, and the condition number of all together."""

    def __init__(self, values: Mapping[str, Any], condition: Any) -> None:
        super().__init__(values)
        self.condition = condition


@overload
def infer(wanted: str, /, *, measured: Mapping[str, Any], **scene: Any) -> Any: ...
@overload
def infer(wanted: Sequence[str], /, *, measured: Mapping[str, Any], **scene: Any) -> InferredValues: ...
def infer(
    wanted: str | Sequence[str],
    /,
    *,
    measured: Mapping[str, Any],
    material: str | Material | None = None,
    material2: str | Material | None = None,
    materials: Materials | None = None,
    model: str | None = None,
    **given: Any,
) -> Any:
    """Return the value of an input at which a quantity has its measured value, or of two inputs by two quantities.

    Parameters
    ----------
    wanted
        An input among `jkroll.model.inverse.SIZES`, or the word of its option. A list of one or two.
    measured
        One quantity of the nomenclature with its value, which is a number, a list, a text and so on as for `solve`. For
        two inputs, two quantities.
    material, material2, materials, model, **given
        The rest of the scene, as `solve` takes it. Values that a material has of the inputs are not used.

    Returns
    -------
    A float in SI units; an array if a value was one; `Measured` or `Interval` if a given or measured value is
    uncertain. For a list, a dict of these by name. Its attribute `condition` is the condition number of the
    logarithms of the measured quantities as functions of those of the inputs.

    Raises
    ------
    BadRequest, MissingInput, QuantityError, UnknownMaterial, UnknownQuantity
        An input is wrong, or one is missing.
    NoDependence, NoSolution, SeveralSolutions; of two inputs Unseparated
        No value gives the measured one, or several do; or the condition number is above 1e8. Arrays hold nan there
        instead.

    >>> round(infer("gamma", measured={"pull_off_force": "300 nN"}, radius="2 um", radius2="plane"), 6)
    0.015915
    >>> measured = {"pull_off_force": "300 nN", "stiffness": "1 kN/m"}
    >>> both = infer(["gamma", "young"], measured=measured, material="quartz", radius="2 um", radius2="plane")
    >>> round(both["surface_energy"], 6), f"{both['youngs_modulus']:.4g}", round(both.condition, 2)
    (0.015915, '3.482e+10', 1.77)
    """
    is_list = isinstance(wanted, list | tuple)
    names = inputs_named([*map(str, wanted)] if is_list else [str(wanted)])
    if not isinstance(measured, Mapping) or len(measured) != len(names):
        lack, example = "is not a quantity and its value for each input", 'write {"pull_off_force": "300 nN"}'
        raise QuantityError("measured", str(measured), lack, example)
    reader = Reader()
    known = reader.in_si(measured, named)
    described = reader.in_si(given)
    for name, value in known.items():
        check_range(name, middle(value))
    frame = Frame(described, *materials_of(material, material2, materials), model=model)
    problem, inputs = Problem(names, known, frame), {**described, **known}
    values = problem.solution.values
    if any(map(is_uncertain, inputs.values())):  # as in `solve`
        values = with_uncertainties(problem, inputs, values)
    return InferredValues(values, problem.solution.condition) if is_list else values[names[0]]
