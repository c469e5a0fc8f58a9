"""Runner of `infer`: from measured values back to one input or two."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from ..answers.inferred import Inferred
from ..answers.questions import quantity_named
from ..errors import BadRequest
from ..materials.library import Material
from ..quantities.values import Spread, spreads_of
from ..rows.columns import Wanted
from ..rows.inferred import Unknowns
from ..rows.sweep import Sweep
from ..scene.inverse import SIZES, Problem, already_given, input_named
from ..scene.scene import Scene
from ..text import quoted
from .commands import Call
from .question import checked_format, write_asked
from .request import form_of, is_table, request_of

MAX_PAIRS = 1_000  # scenes in which two inputs are looked for, which takes up to seconds in each


class _Inverse:
    """What `infer` asks of the rows of a sweep: their unknowns."""

    most = 10_000  # each takes milliseconds
    most_in_table = 500

    def __init__(self, unknowns: Sequence[str], quantities: Sequence[str]) -> None:
        self.names, self.headline, self.quantities = unknowns, unknowns, quantities

    def row(self, given: Mapping[str, Any], *spheres: Material | None, model: str | None) -> Problem:
        """Return a row of inputs among which are the measured values."""
        return Problem.of(self.names, self.quantities, given, *spheres, model=model)

    def answer(self, row: Any) -> Inferred:
        """Return the answer for a row."""
        return Inferred(row)

    def wanted(self, sweep: Sweep) -> Wanted:
        """Return the columns of the rows."""
        return Unknowns.of(self.names, self.quantities, sweep.kinds)

    def with_alternatives(self, wanted: Wanted, sweep: Sweep, *, is_table: bool) -> Wanted:  # noqa: ARG002
        """Return the same columns: each value is one of its own law."""
        return wanted

    def bare(self, *, doubts: bool) -> Wanted:
        """Return the columns of the values alone."""
        return Unknowns(self.names, self.quantities, doubts=doubts)

    def kinds(self, sweep: Sweep, wanted: Wanted) -> Iterable[tuple[Scene, Sequence[str]]]:  # noqa: ARG002
        """Return a scene of each kind of rows, with the measured quantities."""
        return [(problem.filled(), self.quantities) for problem in sweep.kinds]


def run_infer(call: Call) -> int:
    """Find inputs for every scene and measured value; return the exit code."""
    if not call.words:
        raise BadRequest(f"infer needs an input: one of {', '.join(SIZES)}")
    names = _names(call.words[0])
    if call.alternatives:
        raise BadRequest("infer writes no --alternatives; --json has the values by each law")
    if tables := [word for word in call.words[1:] if is_table(word)]:
        if len(names) > 1:
            raise BadRequest(
                "infer reads no tables, and batch infers one input only; write the rows as lists (1nm,2nm) or ranges (1nm:1um:5)"
            )
        quantity = (call.measured[0] if call.measured else "QUANTITY").partition("=")[0]
        line = f"jkroll batch {tables[0]} --infer {call.words[0]} --measured {quantity}"
        raise BadRequest(f"infer reads no tables; write {line}")
    measured = _measured(call.measured, names)
    kind = checked_format(call)
    form = form_of(call, names)
    request = request_of(call._replace(words=call.words[1:]))
    for quantity in measured:
        if quantity in request.spreads:
            raise already_given(quantity, quantity)
    inverse = _Inverse(names, [*measured])
    sweep = Sweep(request.pairs, {**request.spreads, **measured}, request.models, inverse.row)
    if len(names) > 1 and len(sweep) > MAX_PAIRS:
        raise BadRequest(f"{len(sweep)} scenes are more than {MAX_PAIRS}, in which two inputs are looked for")
    return write_asked(inverse, sweep, kind, form, call)


def _names(text: str) -> list[str]:
    """Read the inputs that are sought."""
    words = text.split(",")
    names = [*map(input_named, words)]
    if len(names) > 2:
        raise BadRequest(f"infer finds one input or two, not {len(names)}")
    if len(set(names)) < len(names):
        raise BadRequest(f"{quoted(text)} names one input twice")
    return names


def _measured(texts: Sequence[str], names: Sequence[str]) -> dict[str, list[Spread]]:
    """Read the measured quantities and their values: as many as inputs are sought."""
    example = "--measured pull_off_force=300nN" + " --measured stiffness=1kN/m" * (len(names) - 1)
    if not texts:
        raise BadRequest(f"infer needs what was measured: {example}")
    measured: dict[str, list[Spread]] = {}
    for text in texts:
        word, has_value, value = text.partition("=")
        if not has_value:
            raise BadRequest("--measured: write a quantity and its value, such as pull_off_force=300nN")
        quantity = quantity_named(word)
        if quantity in measured:
            raise BadRequest(f"--measured: {quantity} is given twice; several values have commas")
        measured[quantity] = spreads_of(value, quantity)
    if len(measured) != len(names):
        wanted = (
            "an input needs one measured quantity" if len(names) == 1 else "two inputs need two measured quantities"
        )
        raise BadRequest(f"{wanted}, and {len(measured)} {'is' if len(measured) == 1 else 'are'} given: {example}")
    return measured
