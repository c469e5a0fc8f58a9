"""Rows of the inverse problem: the value of an input at which each scene has its measured value of a quantity, or of two inputs."""

from collections.abc import Callable, Collection, Hashable, Iterable, Mapping, Sequence
from functools import partial
from math import nan
from typing import TYPE_CHECKING, Any, NamedTuple

from ..errors import JkrollError, NoResult
from ..materials.library import Material
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.values import is_uncertain
from ..scene.failures import MissingInput
from ..scene.inverse import SIZES, check, computed, failure, names_in, solution, solutions, with_input
from ..scene.limits import doubts
from ..scene.scene import Scene
from ..scene.unknowns import Problem, check_two, largest, with_inputs
from .columns import (
    ROW,
    UNCERTAINTY,
    Columns,
    LeftOut,
    NotShown,
    Row,
    Wanted,
    inputs_used,
    left_out,
    put_one,
    put_sides,
    spread,
)

if TYPE_CHECKING:
    from ..scene.uncertainty import Source


class Observed(NamedTuple):
    """A scene that lacks an input, and the measured value of one of its quantities; both may be arrays."""

    scene: Scene
    measured: Any

    @property
    def value(self) -> Any:
        """The measured value without its uncertainty."""
        return self.measured.value if is_uncertain(self.measured) else self.measured

    @property
    def is_uncertain(self) -> bool:
        """True if the measured value, or something in the scene, has an uncertainty."""
        return is_uncertain(self.measured) or self.scene.is_uncertain


def observed(quantity: str, given: Mapping[str, Any], *spheres: Material | None, model: str | None) -> Observed:
    """Return a row of inputs among which is the measured value of a quantity."""
    others = {name: value for name, value in given.items() if name != quantity}
    return Observed(Scene(others, *spheres, model=model), given[quantity])


class Sought(Wanted):
    """An input that is inferred from a measured quantity."""

    def __init__(
        self,
        name: str,
        quantity: str,
        *,
        inputs: Iterable[str] = (),
        sides: Collection[str] | None = None,
        doubts: bool = True,
    ) -> None:
        """`sides`: of the uncertainty, those that have columns; None where it is not wanted."""
        of_name = None if sides is None else {name: sides}
        super().__init__([name], named=[name], inputs=inputs, sides=of_name, doubts=doubts)
        self.name, self.quantity = name, quantity

    def with_sides(self, sides: Collection[str]) -> "Sought":
        """Return the same input with columns for some sides of its uncertainty."""
        return Sought(self.name, self.quantity, inputs=self.inputs, sides=sides, doubts=self.doubts)

    def sides_in(self, scene: Observed) -> set[str]:
        """Return the sides of the uncertainties that enter the input."""
        return {side for source in self._sources(scene) for side in source.given.sides}

    def lacks(self, scene: Observed) -> bool:
        """Return whether a scene lacks an input without which the quantity has no value."""
        return bool(with_input(scene.scene, self.name, SIZES[self.name][1]).missing([self.quantity]))

    @classmethod
    def of(cls, name: str, quantity: str, kinds: Iterable[Observed]) -> "Sought":
        """Return what is wanted of rows of some kinds. Raises the error of the input, or MissingInput if no kind allows to infer it."""
        plain = cls(name, quantity)
        inputs: set[str] = set()
        sides: set[str] = set()
        errors: list[MissingInput | None] = []
        for one in kinds:
            inputs |= plain._echo(one).keys()
            errors.append(None)
            try:
                check(name, quantity, one.scene)
                sides |= plain.sides_in(one)
            except MissingInput as error:
                errors[-1] = error
            except NoResult:
                continue
        if errors[0] is not None and all(errors):
            raise errors[0]
        return cls(name, quantity, inputs=[each for each in NOMENCLATURE if each in inputs], sides=sides)

    def work(self, scene: Observed) -> int:
        """Return how many formulas take as long as a row by itself."""
        filled = with_input(scene.scene, self.name, 1.0)
        steps = len(filled.plan(self.quantity).steps) if not filled.missing([self.quantity]) else 1
        return computed(self.name) * steps

    def row(self, scene: Observed) -> Row:
        """Return the row of a measured number."""
        gaps = [nan] * len(self.keys)
        try:
            found = solution(self.name, self.quantity, scene.value, scene.scene)
        except MissingInput as error:
            return Row(self._echo(scene), gaps, 0, {self.name: error})
        except NoResult as error:
            return Row(self._echo(scene) | self._uncertain(scene), gaps, 0, {self.name: error})
        numbers = {self.name: found.value}
        reasons: dict[str, JkrollError] = {}
        if (remark := self._left_out(scene)) is not None:
            reasons = {UNCERTAINTY: remark}
        elif self.known_sides and scene.is_uncertain:
            from ..scene.uncertainty import inferred_uncertainty

            bars, _ = inferred_uncertainty(self.name, self.quantity, scene.measured, found, scene.scene)
            put_sides(self, bars, numbers, reasons)
        bits = doubts(found.scene, [self.quantity]) if self.doubts else 0
        return Row(
            self._echo(scene, found.value) | self._uncertain(scene),
            [numbers.get(key, nan) for key in self.keys],
            bits,
            reasons,
        )

    def columns(
        self,
        scene: Observed,
        size: int,
        one: Callable[[int], Any],
        kind: Callable[[int], Hashable],  # noqa: ARG002
    ) -> Columns:
        """Return the columns of arrays of measured values; `one` returns a row by itself."""
        import numpy

        if self._left_out(scene) is not None:
            raise NotShown  # each row by itself says what it leaves out
        found = solutions(self.name, self.quantity, numpy.broadcast_to(scene.value, size), scene.scene)
        values = numpy.array([each if isinstance(each, float) else nan for each in found])
        failed = numpy.isnan(values)
        some = numpy.where(failed, SIZES[self.name][1], values)
        inputs = self._echo(scene, some) | self._uncertain(scene)
        bits = numpy.zeros(size, dtype=numpy.int64)
        if self.doubts:
            bits[...] = doubts(with_input(scene.scene, self.name, some), [self.quantity])
            bits[failed] = 0
        numbers = numpy.full((len(self.keys), size), nan)
        numbers[0] = values
        reasons = {}
        for row in numpy.flatnonzero(failed).tolist():
            own = found[row]
            reasons[row] = {
                self.name: own if isinstance(own, NoResult) else failure(self.name, self.quantity, one(row).scene)
            }
        columns = Columns(self, {name: _column(inputs.get(name), size) for name in self.inputs}, numbers, bits, reasons)
        if self.known_sides and scene.is_uncertain:
            self._add_sides(columns, scene, one)
        return columns

    def _add_sides(self, columns: Columns, scene: Observed, one: Callable[[int], Any]) -> None:
        """Add the columns of the uncertainty; rows in which it needs a search are computed by themselves."""
        import numpy

        from ..scene.uncertainty import inferred_uncertainty_of_elements

        values = columns.column(self.name)
        found = inferred_uncertainty_of_elements(self.name, self.quantity, scene.measured, values, scene.scene)
        for row in numpy.flatnonzero(columns.put_sides(found)).tolist():
            put_one(columns, row, partial(one, row))

    def _left_out(self, scene: Observed) -> LeftOut | None:
        """Return the remark on uncertainties for which there are no columns, if there are some. Raises NotShown if a cell has one."""
        if not self.uncertainties or self.sides_in(scene) <= self.known_sides:
            return None
        from ..scene.uncertainty import inferred_sources

        sources = inferred_sources(self.name, self.quantity, scene.measured, scene.scene)
        return left_out(self, scene.scene, sources, stated=[self.quantity] if is_uncertain(scene.measured) else [])

    def _echo(self, scene: Observed, value: Any = None) -> dict[str, Any]:
        """Return the inputs of a row as they were understood, among them the measured value; `value`: of the input that is inferred."""
        inferred = names_in(scene.scene, self.name)
        filled = with_input(scene.scene, self.name, SIZES[self.name][1] if value is None else value)
        used = [name for name in inputs_used(filled, [self.quantity], [self.quantity]) if name not in inferred]
        return {**filled.echo(used), self.quantity: scene.value}

    def _uncertain(self, scene: Observed) -> dict[str, Any]:
        """Return the inputs, and the measured value, from which the uncertainty comes."""
        return (
            {name: source.given for source in self._sources(scene) for name in source.names} if self.known_sides else {}
        )

    def _sources(self, scene: Observed) -> "Sequence[Source]":
        if not scene.is_uncertain:
            return ()
        from ..scene.uncertainty import inferred_sources

        return inferred_sources(self.name, self.quantity, scene.measured, scene.scene).entering


# --- Two inputs -------------------------------------------------------------------------------------------------------


class ObservedPair(NamedTuple):
    """A scene that lacks two inputs, and the measured values of two of its quantities."""

    scene: Scene
    measured: Mapping[str, Any]

    @property
    def values(self) -> dict[str, float]:
        """The measured values without their uncertainties."""
        return {name: one.value if is_uncertain(one) else one for name, one in self.measured.items()}

    @property
    def is_uncertain(self) -> bool:
        """True if a measured value, or something in the scene, has an uncertainty."""
        return any(map(is_uncertain, self.measured.values())) or self.scene.is_uncertain


def observed_pair(
    quantities: Sequence[str], given: Mapping[str, Any], *spheres: Material | None, model: str | None
) -> ObservedPair:
    """Return a row of inputs among which are the measured values of two quantities."""
    others = {name: value for name, value in given.items() if name not in quantities}
    return ObservedPair(Scene(others, *spheres, model=model), {name: given[name] for name in quantities})


class SoughtPair(Wanted):
    """Two inputs that are inferred from two measured quantities. Rows are computed one by one."""

    def __init__(
        self,
        names: Sequence[str],
        quantities: Sequence[str],
        *,
        inputs: Iterable[str] = (),
        sides: Collection[str] | None = None,
        doubts: bool = True,
    ) -> None:
        """`sides`: of the uncertainties, those that have columns; None where they are not wanted."""
        of_names = None if sides is None else dict.fromkeys(names, sides)
        super().__init__(names, named=names, inputs=inputs, sides=of_names, doubts=doubts)
        self.quantities = tuple(quantities)

    @classmethod
    def of(cls, names: Sequence[str], quantities: Sequence[str], kinds: Iterable[ObservedPair]) -> "SoughtPair":
        """Return what is wanted of rows of some kinds. Raises the error of the inputs, or MissingInput if no kind allows to infer them."""
        plain = cls(names, quantities)
        inputs: set[str] = set()
        sides: set[str] = set()
        errors: list[MissingInput | None] = []
        for one in kinds:
            errors.append(None)
            try:
                check_two(names, quantities, one.scene)
                sides |= {side for source in plain._sources(one) for side in source.given.sides}
            except MissingInput as error:
                errors[-1] = error
            except NoResult:
                pass
            inputs |= plain._echo(one).keys()
        if errors[0] is not None and all(errors):
            raise errors[0]
        return cls(names, quantities, inputs=[each for each in NOMENCLATURE if each in inputs], sides=sides)

    def row(self, scene: ObservedPair) -> Row:
        """Return the row of measured numbers."""
        gaps = [nan] * len(self.keys)
        try:
            found = Problem(self.names, scene.values, scene.scene).solution()
        except MissingInput as error:
            return Row(self._echo(scene), gaps, 0, dict.fromkeys(self.names, error))
        except NoResult as error:
            return Row(self._echo(scene) | self._uncertain(scene), gaps, 0, {ROW: error})
        numbers = dict(found.values)
        reasons: dict[str, JkrollError] = {}
        if self.known_sides and scene.is_uncertain:
            from ..scene.uncertainty import uncertainties_of_two

            put_sides(self, uncertainties_of_two(scene.measured, found, scene.scene)[0], numbers, reasons)
        bits = doubts(found.scene, self.quantities) if self.doubts else 0
        return Row(
            self._echo(scene) | self._uncertain(scene), [numbers.get(key, nan) for key in self.keys], bits, reasons
        )

    def _echo(self, scene: ObservedPair) -> dict[str, Any]:
        """Return the inputs of a row as they were understood, among them the measured values."""
        inferred = {each for name in self.names for each in names_in(scene.scene, name)}
        filled = with_inputs(scene.scene, largest(self.names))
        used = [name for name in inputs_used(filled, self.quantities, self.quantities) if name not in inferred]
        return {**filled.echo(used), **scene.values}

    def _uncertain(self, scene: ObservedPair) -> dict[str, Any]:
        """Return the inputs, and the measured values, from which the uncertainty comes."""
        return (
            {name: source.given for source in self._sources(scene) for name in source.names} if self.known_sides else {}
        )

    def _sources(self, scene: ObservedPair) -> "Sequence[Source]":
        if not scene.is_uncertain:
            return ()
        from ..scene.uncertainty import sources_of_two

        return sources_of_two(self.names, scene.measured, scene.scene).entering


def _column(value: Any, size: int) -> Any:
    """Return a column of inputs, of which each may be uncertain."""
    if not is_uncertain(value):
        return spread(value, size)
    import numpy

    parts = {"value": value.value, **value.sides}
    rows = zip(*(numpy.broadcast_to(part, size).tolist() for part in parts.values()), strict=True)
    return [value._replace(**dict(zip(parts, row, strict=True))) for row in rows]
