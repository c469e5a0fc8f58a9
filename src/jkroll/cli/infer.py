"""Runner of `infer`: from a measured value back to an input."""

from itertools import chain
from typing import TYPE_CHECKING

from ..answers.answer import in_units
from ..answers.inferred import inferred, with_forward
from ..answers.questions import Question, quantity_named
from ..errors import BadRequest
from ..output.layout import layout
from ..quantities.naming import named
from ..quantities.ranges import spreads_of
from ..scene.inverse import SIZES, CannotInfer
from .options import Call
from .question import write_answers, write_sources
from .request import request_of
from .written import format_name, format_of

if TYPE_CHECKING:
    from ..quantities.uncertain import Uncertain

MAX_ANSWERS = 10_000  # which are kept until their columns are known


def run_infer(call: Call) -> int:
    """Find an input for every scene and measured value; return the exit code."""
    if not call.words:
        raise BadRequest(f"infer needs an input: one of {', '.join(SIZES)}")
    name = named(call.words[0])
    if name not in SIZES:
        raise CannotInfer(call.words[0])
    quantity, measured = _measured(call.measured)
    kind = format_name(call)
    form = format_of(call, [name])
    request = request_of(call._replace(words=call.words[1:]))
    count = request.count * len(measured)
    if count > MAX_ANSWERS:
        raise BadRequest(f"{count} values are more than infer finds in one call: {MAX_ANSWERS}")
    pairs = [
        (scene, in_units(inferred(name, quantity, value, scene), form))
        for scene in request.scenes()
        for value in measured
    ]
    if kind in ("explain", "cite"):
        return write_sources((with_forward(one, quantity, scene) for scene, one in pairs), count, kind, form)
    answers = [one for _, one in pairs]
    shape = layout(Question((name,), (name,)), answers, count)
    return write_answers(answers, shape, kind, form, quiet=call.quiet)


def _measured(text: str | None) -> "tuple[str, list[float | Uncertain]]":
    """Read the measured quantity and its values."""
    if text is None:
        raise BadRequest("infer needs what was measured: --measured pull_off_force=300nN")
    word, has_value, value = text.partition("=")
    if not has_value:
        raise BadRequest("--measured: write a quantity and its value, such as pull_off_force=300nN")
    quantity = quantity_named(word)
    spreads = spreads_of(value, quantity)
    if sum(map(len, spreads)) > MAX_ANSWERS:
        raise BadRequest(f"--measured: more than {MAX_ANSWERS} values")
    return quantity, [*chain.from_iterable(spreads)]
