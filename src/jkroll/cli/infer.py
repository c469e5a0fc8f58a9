"""Runner of `infer`: from measured values back to one input or two."""

from collections.abc import Sequence

from ..answers.inferred import Inferred
from ..answers.questions import Question, quantity_named
from ..errors import BadRequest
from ..quantities.values import Spread, spreads_of
from ..rows.infer import Problems
from ..scene.inverse import SIZES, already_given, input_named
from ..text import quoted
from .call import Call, is_table
from .question import check_format, write

MAX_PAIRS = 1_000  # scenes in which two inputs are looked for, which takes up to seconds in each


def run_infer(call: Call) -> int:
    """Find inputs for every scene and measured value; return the exit code."""
    if not call.subject:
        raise BadRequest(f"infer needs an input: one of {', '.join(SIZES)}")
    names = _names(call.subject)
    if call.alternatives:
        raise BadRequest("infer writes no --alternatives; --json has the values by each law")
    for word in filter(is_table, call.words):
        quantity = (call.measured[0] if call.measured else "QUANTITY").partition("=")[0]
        remedy = f"write jkroll batch {word} --infer {call.subject} --measured {quantity}"
        if len(names) > 1:
            remedy = "and batch infers one input only; write the rows as lists (1nm,2nm) or ranges (1nm:1um:5)"
        raise BadRequest(f"infer reads no tables{',' if len(names) > 1 else ';'} {remedy}")
    measured = _measured(call.measured, names)
    check_format(call)
    form = call.form(names)
    for quantity in measured:
        if quantity in call.spreads:
            raise already_given(quantity, quantity)
    problems = Problems(names, measured, call.sweep)
    if len(names) > 1 and len(problems) > MAX_PAIRS:
        raise BadRequest(f"{len(problems)} pairs are more than {MAX_PAIRS}, in which two inputs are looked for")
    return write(call, problems, Question(tuple(names), tuple(names)), form, Inferred)


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
        wanted = ("an input needs one measured quantity", "two inputs need two measured quantities")[len(names) - 1]
        are = "is" if len(measured) == 1 else "are"
        raise BadRequest(f"{wanted}, and {len(measured)} {are} given: {example}")
    return measured
