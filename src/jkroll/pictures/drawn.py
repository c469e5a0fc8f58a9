"""Pictures in Python: `jkroll.curve`, `jkroll.map`, `jkroll.figure` and the pictures of answers."""

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy

from ..errors import BadRequest, missing_extra
from ..materials.library import Material, Materials, known_materials
from ..model.containers import Reader
from ..model.frame import Frame
from ..model.solver import materials_of, refuse_arrays
from ..model.sweep import Sweep
from ..quantities.formatting import amount
from ..quantities.laws import DEFAULT_LAW, law_given, laws_given
from ..quantities.markup import plain, symbol
from ..quantities.nomenclature import STATE_OR_LOAD
from ..quantities.values import QuantityError
from ..report.curve import Loads, loads_of
from ..report.questions import quantity_named
from ..text import as_arguments, listed, quoted
from .contact_curves import PANELS, curves_of_contact
from .figures import check_figure, figure_named
from .maps import MAX_CURVES, SIDE, MapRequest, axis_of, check_axes, distinction, picture_of
from .picture import STYLES, Axis, Mark, Picture, evaluate

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


class Drawn:
    """A picture: its lines as arrays in SI units, its caption and notes; `plot` draws it, and notebooks show it."""

    def __init__(self, picture: Picture, notes: Iterable[str] = ()) -> None:
        self._picture = picture
        self.notes = tuple(as_arguments(plain(note)) for note in notes)

    @property
    def lines(self) -> dict[str, tuple[Any, Any]]:
        """The x and y of each line, by label; nan separates the parts of a line.

        The label begins with the title of the panel if there are several panels.
        """
        panels, lines = self._picture.panels, dict[str, tuple[Any, Any]]()
        for panel in panels:
            for curve in panel.curves:
                label = plain(f"{panel.title}: {curve.text}" if panels[1:] else curve.text)
                x, y = curve.x, curve.y
                if label in lines:
                    first_x, first_y = lines[label]
                    x = numpy.concatenate([first_x, [numpy.nan], x])
                    y = numpy.concatenate([first_y, [numpy.nan], y])
                lines[label] = x, y
        return lines

    @property
    def field(self) -> tuple[Any, Any, Any] | None:
        """The x, y and values of a map, with a row for each y; None for lines."""
        (panel, *_) = self._picture.panels
        if panel.field is None:
            return None
        x, y = (axis._replace(size=axis.size or SIDE) for axis in (panel.x, panel.y))
        return x.values(), y.values(), evaluate(panel.field.frame, panel.field.quantity, x, y)

    @property
    def points(self) -> dict[str, tuple[float | None, float | None]]:
        """The x and y of each mark, by label; a mark on one axis has None for the other."""
        points: dict[str, tuple[float | None, float | None]] = {}
        for panel in self._picture.panels:
            points |= {plain(mark.text): (mark.x, mark.y) for mark in panel.marks}
        return points

    @property
    def caption(self) -> str:
        """The caption, followed by exceeded limits of the model, materials left out, and remarks."""
        return plain(" ".join([*self._picture.caption, *self._picture.doubts, *self._picture.remarks]))

    def plot(self, ax: "Axes | Sequence[Axes] | None" = None, style: str = "paper") -> Any:
        """Draw on matplotlib axes, one for each panel, or on those of a new figure; return them.

        `style`: "paper" or "dark".
        """
        if ax is None:
            first, *others = self.figure(style).axes[: len(self._picture.panels)]
            return [first, *others] if others else first
        _check_style(style)
        with missing_extra("plot"):
            from .page import draw_on
        given, panels = [*ax] if isinstance(ax, Iterable) else [ax], self._picture.panels
        if len(given) != len(panels):
            raise BadRequest(f"ax: the picture has {len(panels)} panels, and {len(given)} axes were given")
        for panel, axes in zip(panels, given, strict=True):
            draw_on(axes, panel, STYLES[style])
        return ax

    def figure(self, style: str = "paper", *, caption: bool = False) -> "Figure":
        """Return the page as a matplotlib figure, to save it: figure.savefig("a.pdf").

        `caption`: True for titles and a caption, as on the command's page.
        """
        _check_style(style)
        with missing_extra("plot"):
            from .page import figure_of, settings
        with settings(STYLES[style]):
            return figure_of(self._picture, None, STYLES[style], has_caption=caption)

    def _repr_png_(self) -> tuple[bytes, dict[str, int]]:
        """Return the PNG for notebooks, and half its width in pixels, at which letters match the surrounding text."""
        with missing_extra("plot"):
            from .page import draw
        content = draw(self._picture, "png", None, "paper", has_caption=True)
        width_in_pixels = int.from_bytes(content[16:20])  # where the header of a PNG has the width
        return content, {"width": width_in_pixels // 2}

    def __repr__(self) -> str:
        return f"<Drawn: {listed([*self.lines] or [plain(self._picture.title)])}>"


def _check_style(style: str) -> None:
    if style not in STYLES:
        raise BadRequest(f"style: {quoted(style)} is not a style; choose one of {listed(STYLES)}")


def _inputs_of_one_contact(given: Mapping[str, Any]) -> dict[str, Any]:
    """Return inputs in SI units. Raises QuantityError, also for an array."""
    described = Reader().in_si(given)
    refuse_arrays(described, "describes more than one contact", "a picture needs one value of each input")
    return described


def curve(
    *,
    material: str | Material | None = None,
    material2: str | Material | None = None,
    materials: Materials | None = None,
    model: str | Sequence[str] | None = None,
    profile: str | None = None,
    load: str | tuple[float, float] | None = None,
    panel: str | None = "force",
    **given: Any,
) -> Drawn:
    """Return the curve of a contact, as `jkroll contact --curve` draws it.

    Parameters
    ----------
    material, material2, materials, profile, **given
        The contact, as in `solve`, but without arrays or lists.
    model
        The law, or several laws to compare.
    load
        The loads at the ends of the curve, as "-5nN:20nN" or a pair of numbers in N.
    panel
        "force" against approach, "pressure", or "moment"; None for all three.

    Returns
    -------
    `Drawn`: `lines` as arrays in SI units, `points`, `caption`, `notes`; `plot(ax)`, `figure()`.

    Raises
    ------
    BadRequest, MissingInput, NoResult, QuantityError, UnknownMaterial
        An argument is wrong or missing, or the loads are beyond pull-off.

    >>> drawn = curve(material="quartz", radius="100 nm")
    >>> approach, force = drawn.lines["stable"]
    >>> f"{force.min():.4g} N"
    '-1.178e-08 N'
    """
    if panel is not None and panel not in PANELS:
        raise BadRequest(f"panel: {quoted(panel)} is not a panel; choose one of {listed(PANELS)}")
    described = _inputs_of_one_contact(given)
    solids = materials_of(material, material2, materials)
    models = [model] if model is None or isinstance(model, str) else [*model]
    if not models:
        raise QuantityError("model", "[]", "is an empty list")
    frames = [Frame(described, *solids, model=law) for law in laws_given(models, profile)]
    return Drawn(*curves_of_contact(frames, _loads(load), panel))


def _loads(load: str | tuple[float, float] | None) -> Loads | None:
    """Return the loads at the ends of a curve; None without `load`. Raises BadRequest and QuantityError."""
    if isinstance(load, str):
        return loads_of(load)
    if not load:
        return None
    low, high = load
    if not low < high:
        raise BadRequest("load: write the lower end first, as in (-5e-9, 20e-9)")
    return Loads(float(low), float(high))


def map(
    quantity: str,
    /,
    *,
    x: str,
    y: str | None = None,
    material: str | Material | None = None,
    material2: str | Material | None = None,
    materials: Materials | None = None,
    model: str | None = None,
    profile: str | None = None,
    marks: Sequence[str] = (),
    **given: Any,
) -> Drawn:
    """Return a quantity over one input as a line, or over two inputs as a map, as `jkroll map` draws it.

    Parameters
    ----------
    quantity
        A name or symbol, or a command, which stands for its main quantity.
    x, y
        An input and its range, as "radius=1nm:1mm"; append ":lin" for equal steps, ":50" for the number of values.
    material, material2, materials, model, profile, **given
        The inputs that are the same everywhere, as in `solve`, but without arrays or lists.
    marks
        Grains to mark, as "quartz@100nm".

    Returns
    -------
    `Drawn`: `field` or `lines` as arrays in SI units, `points`, `caption`, `notes`; `plot(ax)`, `figure()`.

    Raises
    ------
    BadRequest, MissingInput, NoResult, QuantityError, UnknownMaterial, UnknownQuantity
        An argument is wrong or missing, or there is no value anywhere.

    >>> radii, energies, forces = map("P_c", x="radius=10nm:1um:3", y="gamma=10mJ/m2:1J/m2:2").field
    >>> forces.shape, f"{forces[0, 0]:.4g} N"
    ((2, 3), '4.712e-10 N')
    """
    described = _inputs_of_one_contact(given)
    law, name = law_given(model, profile), quantity_named(quantity)
    across = axis_of(x, "x")
    up = axis_of(y, "y") if y is not None else None
    check_axes(name, [across] if up is None else [across, up], described, (law or DEFAULT_LAW,))
    frame = Frame(described, *materials_of(material, material2, materials), model=law)
    return Drawn(*picture_of(MapRequest(name, across, up, (("", frame),), marks, materials or known_materials())))


def figure(
    name: str, /, *, marks: Sequence[str] = (), materials: Materials | None = None, as_printed: bool = False
) -> Drawn:
    """Return a figure of the paper, as `jkroll figure` draws it.

    Parameters
    ----------
    name
        "2", "3a" to "3d", "6a", "6b", "8", "9", "laws", or "geometry", a sketch without values.
    marks
        Grains to mark, as "quartz@100nm".
    materials
        The library in which materials are looked up.
    as_printed
        True to draw also the curves as printed in the paper; for figure "6b" only.

    Returns
    -------
    `Drawn`: `field` or `lines` as arrays in SI units, `points`, `caption`, `notes`; `plot(ax)`, `figure()`.

    Raises
    ------
    BadRequest, UnknownMaterial
        There is no such figure, or an argument is wrong or does not apply to the figure.

    >>> figure("laws").lines["JKR"][1].tolist()
    [1.5, 1.5]
    """
    check_figure(name, {"marks": marks, "as_printed": as_printed})
    return Drawn(figure_named(name, materials or known_materials(), marks, as_printed=as_printed))


# --- The pictures of answers ------------------------------------------------------------------------------------------


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

    If no input has several values, the picture has the force curve of the contact by each law. Raises BadRequest for
    several pairs of materials without such an input, and for more lines than can be told apart.
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
    return Drawn(*picture_of(MapRequest(quantity, x, None, tuple(frames), (), known_materials())))
