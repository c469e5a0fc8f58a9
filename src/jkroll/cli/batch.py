"""Runner of `batch`."""

from ..answers.questions import quantity_named
from ..batch.command import run
from ..batch.settings import Settings
from ..errors import BadRequest
from ..quantities.nomenclature import named
from ..scene.inverse import SIZES, CannotInfer
from .commands import Call
from .request import materials_of


def run_batch(call: Call) -> int:
    """Convert a table of scenes; return the exit code."""
    if not call.words:
        raise BadRequest("batch needs a table, such as grains.csv, or - for standard input")
    if call.settings.keys() >= {"format", "delimiter"}:
        raise BadRequest("--format and --delimiter exclude each other")
    infer, measured = _inverse(call)
    same = {name: getattr(call, name) for name in Settings._fields if name in Call._fields}
    own = {"target": call.target or "-", "doubt": not call.no_doubt, "infer": infer, "measured": measured}
    settings = Settings(**{**same, **own}, **call.settings)
    return run(call.words[0], settings, call.inputs, materials_of(call.materials))


def _inverse(call: Call) -> tuple[str, str]:
    """Return the names of the input that is sought and of the quantity that was measured; empty texts if none is."""
    if not call.infer and not call.measured:
        return "", ""
    if "," in call.infer or len(call.measured) > 1:
        raise BadRequest("batch infers one input; jkroll infer finds two, for lists and ranges too")
    if not call.infer or not call.measured or "=" in call.measured[0]:
        raise BadRequest(
            "--infer INPUT and --measured QUANTITY go together, as in --infer gamma --measured pull_off_force"
        )
    if call.quantities:
        raise BadRequest("--infer and --quantities exclude each other")
    name = named(call.infer)
    if name not in SIZES:
        raise CannotInfer(call.infer)
    return name, quantity_named(call.measured[0])
