"""Rows of the inverse problem: the value of an input at which each scene has its measured value of a quantity, or of two inputs."""

from collections.abc import Callable, Collection, Iterable, Sequence
from functools import partial
from math import nan
from typing import TYPE_CHECKING, Any, Self

from ..errors import JkrollError, NoResult
from ..quantities.nomenclature import PROPERTIES
from ..quantities.values import is_uncertain
from ..scene.failures import MissingInput
from ..scene.inverse import SIZES, Observed, computed, failure, solutions, with_inputs, with_placeholders
from ..scene.limits import bits_of, doubts
from ..scene.scene import Scene
from ..scene.unknowns import check, solved
from ..scene.wiring import in_order
from .columns import (
    Columns,
    LeftOut,
    NotShown,
    Row,
    Wanted,
    fill_sides,
    left_out,
    put_row,
    repeated,
)
from .reasons import ROW, UNCERTAINTY

if TYPE_CHECKING:
    from ..scene.uncertainty import Sources


class Sought(Wanted):
    """Inputs that are inferred from as many measured quantities. Rows are computed one by one."""

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
    def of(cls, names: Sequence[str], quantities: Sequence[str], kinds: Iterable[Observed]) -> Self:
        """Return what is wanted of rows of some kinds. Raises the error of the inputs, or MissingInput if no kind allows to infer them."""
        plain = cls(names, quantities)
        inputs: set[str] = set()
        sides: set[str] = set()
        errors: list[MissingInput | None] = []
        for one in kinds:
            errors.append(None)
            try:
                check(names, quantities, one.scene)
                sources = plain.sources_in(one)
                sides |= set() if sources is None else sources.sides
            except MissingInput as error:
                errors[-1] = error
            except NoResult:
                pass
            inputs |= one.echo(names).keys()
        if errors[0] is not None and all(errors):
            raise errors[0]
        return cls(names, quantities, inputs=in_order(inputs), sides=sides)

    def with_sides(self, sides: Collection[str]) -> Self:
        """Return the same inputs with columns for some sides of their uncertainties."""
        return type(self)(self.names, self.quantities, inputs=self.inputs, sides=sides, doubts=self.doubts)

    def sources_in(self, scene: Observed) -> "Sources | None":
        """Return the sources of uncertainty of the inputs; None if there is no uncertainty."""
        if not scene.is_uncertain:
            return None
        from ..scene.uncertainty import inferred_sources

        return inferred_sources(self.names, scene)

    def lacks(self, scene: Observed) -> bool:
        """Return whether a scene lacks an input without which the quantities have no value."""
        return bool(with_placeholders(scene.scene, self.names).missing(self.quantities))

    def work(self, scene: Observed) -> int:  # noqa: ARG002
        """Return the cost of a row that is computed by itself: none, as arrays cannot compute it."""
        return 0

    def row(self, scene: Observed) -> Row:
        """Return the row of measured numbers."""
        gaps = [nan] * len(self.keys)
        try:
            found = solved(self.names, scene)
        except MissingInput as error:
            return Row(scene.echo(self.names), gaps, 0, dict.fromkeys(self.names, error))
        except NoResult as error:
            of_whole = self.names if len(self.names) == 1 else (ROW,)
            return Row(scene.echo(self.names) | self._uncertain(scene), gaps, 0, dict.fromkeys(of_whole, error))
        inputs = scene.echo(self.names, found.values) | self._uncertain(scene)
        numbers = dict(found.values)
        reasons: dict[str, JkrollError] = {}
        if (remark := self._left_out(scene)) is not None:
            reasons = {UNCERTAINTY: remark}
        elif self.known_sides and scene.is_uncertain:
            from ..scene.uncertainty import inferred_uncertainties

            fill_sides(self, inferred_uncertainties(found.values, scene)[0], numbers, reasons)
        bits = bits_of(doubts(found.scene, self.quantities)) if self.doubts else 0
        return Row(inputs, [numbers.get(key, nan) for key in self.keys], bits, reasons)

    def _left_out(self, scene: Observed) -> LeftOut | None:
        """Return the remark on uncertainties for which there are no columns, if there are some. Raises NotShown if a cell has one."""
        if not self.uncertainties or (sources := self.sources_in(scene)) is None:
            return None
        stated = [name for name, one in scene.measured.items() if is_uncertain(one)]
        return left_out(self, scene.scene, sources, stated=stated)

    def _uncertain(self, scene: Observed) -> dict[str, Any]:
        """Return the inputs, and the measured values, from which the uncertainty comes."""
        sources = self.sources_in(scene) if self.known_sides else None
        return {} if sources is None else sources.given


class SoughtOne(Sought):
    """An input that is inferred from a measured quantity. Rows may be arrays."""

    @property
    def name(self) -> str:
        """The input."""
        return self.names[0]

    @property
    def quantity(self) -> str:
        """The measured quantity."""
        return self.quantities[0]

    def work(self, scene: Observed) -> int:
        """Return the cost of a row that is computed by itself, counted in formulas."""
        filled = with_inputs(scene.scene, {self.name: 1.0})
        steps = len(filled.plan(self.quantity).steps) if not filled.missing([self.quantity]) else 1
        return computed(self.name) * steps

    def columns(
        self,
        scene: Observed,
        size: int,
        one: Callable[[int], Any],
    ) -> Columns:
        """Return the columns of arrays of measured values; `one` returns a row by itself."""
        import numpy

        if self._left_out(scene) is not None or self._may_be_of_both(scene.scene):
            raise NotShown  # each row by itself says what it leaves out, and of which spheres the input is
        measured = numpy.broadcast_to(scene.values[self.quantity], size)
        found = solutions(self.name, self.quantity, measured, scene.scene)
        values = numpy.array([each if isinstance(each, float) else nan for each in found])
        failed = numpy.isnan(values)
        some = {self.name: numpy.where(failed, SIZES[self.name][1], values)}
        inputs = scene.echo(self.names, some) | self._uncertain(scene)
        bits = numpy.zeros(size, dtype=numpy.int64)
        if self.doubts:
            bits[...] = bits_of(doubts(with_inputs(scene.scene, some), self.quantities))
            bits[failed] = 0
        numbers = numpy.full((len(self.keys), size), nan)
        numbers[0] = values
        columns = Columns(self, {name: repeated(inputs.get(name), size) for name in self.inputs}, numbers, bits)
        for row in numpy.flatnonzero(failed).tolist():
            own = found[row]
            error = own if isinstance(own, NoResult) else failure(self.name, self.quantity, one(row).scene)
            columns.tell([row], {self.name: error}, is_empty=True)
        if self.known_sides and scene.is_uncertain:
            self._add_sides(columns, scene, one)
        return columns

    def _may_be_of_both(self, scene: Scene) -> bool:
        """Return whether the input is that of both spheres in some rows: the materials of many rows together have no name."""
        both = (scene.material, scene.material2)
        return self.name in PROPERTIES and None not in both and not all(one.name for one in both if one is not None)

    def _add_sides(self, columns: Columns, scene: Observed, one: Callable[[int], Any]) -> None:
        """Add the columns of the uncertainty; rows in which it needs a search are computed by themselves."""
        import numpy

        from ..scene.uncertainty import inferred_uncertainty_of_elements

        found = inferred_uncertainty_of_elements(self.name, columns.column(self.name), scene)
        for row in numpy.flatnonzero(columns.put_sides(found)).tolist():
            put_row(columns, row, partial(one, row))
