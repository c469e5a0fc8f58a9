"""Pictures of answers: the force curve of one contact, and a quantity over an input with several values."""

from ..errors import BadRequest
from ..materials.library import known_materials
from ..model.frame import Frame
from ..model.sweep import Sweep
from ..quantities.formatting import amount
from ..quantities.laws import DEFAULT_LAW
from ..quantities.markup import symbol
from ..quantities.nomenclature import STATE_OR_LOAD
from .drawn import Drawn
from .figures import curves_of_contact
from .picture import Axis, Mark
from .request import MAX_CURVES, PlotRequest, check_axes, distinction, picture_of


def curve_with_state(frame: Frame) -> Drawn:
    """Return the force curve of a contact, with a mark at the stated load or state, if it lies in the panel."""
    picture, notes = curves_of_contact([_unloaded(frame)], None, "force")
    state = frame.numbers("approach_at_load", "load") if STATE_OR_LOAD & frame.stated.keys() else {}
    if len(state) == 2:
        (panel,) = picture.panels
        mark = Mark(f"{symbol('load')} = {amount('load', state['load'])}", *state.values())
        if panel.x.has(mark.x) and panel.y.has(mark.y):
            picture = picture._replace(panels=(panel._replace(marks=(*panel.marks, mark)),))
    return Drawn(picture, notes)


def _unloaded(frame: Frame) -> Frame:
    """Return a frame without its load or state."""
    stated = {name: value for name, value in frame.stated.items() if name not in STATE_OR_LOAD}
    return Frame(stated, frame.material, frame.material2, model=frame.stated_model)


def lines_over_input(quantity: str, sweep: Sweep) -> Drawn:
    """Return a picture of a quantity over the input with the most values, with a line for each combination of the rest.

    If no input has several values, the laws of one contact are compared by their force curves.
    """
    counts = {}
    for name, spreads in sweep.spreads.items():
        count = len({spread.low for spread in spreads})
        if count > 1:
            counts[name] = count
    if not counts and len(sweep.pairs) == 1:
        return Drawn(*curves_of_contact([_unloaded(frame) for frame in sweep.frames()], None, "force"))
    if not counts:
        remedy = 'give several values of one, such as radius=["10 nm", "1 um"], or plot one answer'
        raise BadRequest(f"no input has several values to draw over: {remedy}")
    name = max(counts, key=counts.__getitem__)
    values = [spread.low for spread in sweep.spreads[name]]
    low, high = min(values), max(values)
    x = Axis(name, low, high, is_log=low > 0)
    others = {other: spreads for other, spreads in sweep.spreads.items() if other != name}
    check_axes(quantity, [x], others, tuple(model or DEFAULT_LAW for model in sweep.models))
    rest = Sweep(sweep.pairs, others, sweep.models)
    if len(rest) > MAX_CURVES:
        raise BadRequest(f"{len(rest)} lines are more than the {MAX_CURVES} that can be told apart")
    several = [other for other in counts if other != name]
    frames = []
    for frame in rest.frames():
        frames.append((distinction(frame, several, sweep.models), frame))
    return Drawn(*picture_of(PlotRequest(quantity, x, None, tuple(frames), (), known_materials())))
