"""From the words and options of `map` to a map or curves."""

from ..answers.questions import quantity_named
from ..errors import BadRequest
from ..pictures.axes import Axis
from ..pictures.plot_request import PlotRequest
from ..quantities.errors import QuantityError
from ..quantities.formatting import amount
from ..quantities.laws import DEFAULT_LAW
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.ranges import spreads_of
from ..scene.scene import Scene
from ..scene.wiring import depends_on
from .options import Call
from .request import Request, request_of

MAX_CURVES = 12


def axis_of(text: str, option: str) -> Axis:
    """Return the axis of a text `NAME=FROM:TO`, optionally with `:COUNT` and `:lin` or `:log`.

    >>> axis = axis_of("radius=1nm:1mm", "--x")
    >>> axis.name, axis.low, axis.high, axis.is_log
    ('radius', 1e-09, 0.001, True)
    """
    word, has_range, values = text.partition("=")
    if not has_range:
        raise BadRequest(f"{option}: write a quantity and its range, such as radius=1nm:1mm")
    name = quantity_named(word)
    first, colon, rest = values.partition(":")
    last, *how = rest.split(":")
    if not colon or len(how) > 2 or "," in values:
        raise QuantityError(name, values, "is not a range; write FROM:TO, with :lin for equal steps")
    has_count = bool(how) and how[0] not in ("lin", "log")
    count, scale = how[0] if has_count else "2", how[has_count:]
    spread = spreads_of(":".join([first, last, count, *scale]), name)[0]
    if not spread.low < spread.high:
        raise QuantityError(name, values, "does not rise")
    return Axis(name, spread.low, spread.high, spread.is_log, spread.size if has_count else 0)


def map_request(call: Call) -> PlotRequest:
    """Return what a call asks for: a quantity, axes, scenes to draw, and marks."""
    if not call.words:
        raise BadRequest("map needs a quantity, such as pull_off_force")
    quantity = quantity_named(call.words[0])
    if call.x is None:
        raise BadRequest("map needs an axis: --x radius=1nm:1mm")
    x = axis_of(call.x, "--x")
    y = axis_of(call.y, "--y") if call.y is not None else None
    axes = [x, y] if y is not None else [x]
    request = request_of(call._replace(words=call.words[1:]))
    within = depends_on([quantity], [model or DEFAULT_LAW for model in request.models])
    for axis in axes:
        if axis.name in request.options:
            raise BadRequest(f"{axis.name} is on an axis; it cannot have one value too")
        if axis.name == quantity:
            raise BadRequest(f"{quantity} is the quantity that is drawn; it cannot be an axis too")
        if axis.name not in within:
            raise BadRequest(f"{quantity} does not depend on {axis.name}")
    if len({axis.name for axis in axes}) < len(axes):
        raise BadRequest(f"both axes are {axes[0].name}")
    if request.count > (1 if len(axes) > 1 else MAX_CURVES):
        most = f"{MAX_CURVES} curves" if len(axes) == 1 else "one map"
        raise BadRequest(f"{request.count} scenes are more than {most}")
    scenes = tuple((_distinction(scene, request), scene) for scene in request.scenes())
    return PlotRequest(quantity, x, y, scenes, marks_of(call.mark), request.materials)


def _distinction(scene: Scene, request: Request) -> str:
    """Return the materials of a scene, and those of its values of which several were given."""
    parts = [one.name for one in (scene.material, scene.material2) if one is not None]
    if len(request.models) > 1 and scene.stated_model is not None:
        parts.append(scene.law.title)
    several = [name for name, text in request.options.items() if "," in text or ":" in text]
    parts += [f"{NOMENCLATURE[name].symbol} = {amount(name, scene.stated[name])}" for name in several]
    return ", ".join(parts)


def marks_of(text: str) -> tuple[str, ...]:
    """Return the marks of a list."""
    return tuple(filter(None, text.split(",")))
