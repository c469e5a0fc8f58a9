"""What `jkroll map` is asked for, as a map or as curves."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from .answer import about_data, assumptions
from .axes import Axis, described
from .charts import Curve, Panel, Picture, axis_around
from .commands import COMMANDS
from .errors import MalformedQuantity, NoResult, UnknownQuantity, quoted
from .formatting import amount, pretty
from .maps import (
    Map,
    Mark,
    Progress,
    Setting,
    along,
    bounds_of,
    coordinate,
    equation_of,
    evaluate,
    has_values,
    inputs_at,
    is_wide,
    material_marks,
    regions,
)
from .materials import Materials
from .nomenclature import INFINITY, NOMENCLATURE, word_for_infinity
from .request import BadRequest, Request
from .scene import Scene
from .spread import spreads_of
from .units import parse_quantity
from .wiring import PROPERTIES, depends_on

MOST_POINTS = 25_000_000
MOST_CURVES = 12


def axis_of(text: str, option: str) -> Axis:
    """The axis that a text gives: `NAME=FROM:TO`, with a count and `:lin` or `:log` if wanted.

    >>> axis_of("radius=1nm:1mm", "--x")
    Axis(name='radius', low=1e-09, high=0.001, is_log=True, size=0)
    """
    word, has_range, values = text.partition("=")
    if not has_range:
        raise BadRequest(f"{option}: write a quantity and its range, such as radius=1nm:1mm")
    name = quantity_named(word)
    if NOMENCLATURE[name].unit == "":
        raise BadRequest(f"{option}: {name} has no range")
    first, colon, rest = values.partition(":")
    last, *how = rest.split(":")
    if not colon or len(how) > 2 or "," in values:
        raise MalformedQuantity(name, values, "is not a range; write FROM:TO, with :lin for equal steps")
    has_count = bool(how) and how[0] not in ("lin", "log")
    count, scale = how[0] if has_count else "2", how[has_count:]
    spread = spreads_of(":".join([first, last, count, *scale]), name)[0]
    if not spread.low < spread.high:
        raise MalformedQuantity(name, values, "does not rise")
    return Axis(name, spread.low, spread.high, spread.is_log, spread.size if has_count else 0)


def quantity_named(word: str) -> str:
    """The name of a quantity, for its name with _ or -, its option, or the command that is named after it.

    >>> quantity_named("radius"), quantity_named("gamma"), quantity_named("pull-off")
    ('radius', 'surface_energy', 'pull_off_force')
    """
    name = word.strip().replace("-", "_").lstrip("_")
    by_option = {quantity.option[2:]: known for known, quantity in NOMENCLATURE.items() if quantity.option}
    known = name if name in NOMENCLATURE else by_option.get(word.strip().lstrip("-"))
    if known is None and word in COMMANDS:
        known = COMMANDS[word].headline[0]
    if known is None:
        raise UnknownQuantity(word)
    return known


class NothingToDraw(NoResult):
    """A map or curves without a single value."""

    def __init__(self, quantity: str) -> None:
        super().__init__(quantity)
        self.quantity = quantity

    def __str__(self) -> str:
        return f"{self.quantity} has no value anywhere on these axes"


class Asked(NamedTuple):
    """A map, or curves, as they were asked for."""

    quantity: str
    x: Axis
    y: Axis | None
    settings: tuple[tuple[str, Setting], ...]  # with what tells them apart
    marks: tuple[str, ...]
    materials: Materials


def asked(words: Sequence[str], options: Mapping[str, str], files: Sequence[str]) -> Asked:
    """What a command line asks for: a quantity, materials and radii, axes, marks, and inputs that are held."""
    if not words:
        raise BadRequest("map needs a quantity, such as pull_off_force")
    quantity = quantity_named(words[0])
    if NOMENCLATURE[quantity].unit == "":
        raise BadRequest(f"{quantity} has no values")
    held = {name: text for name, text in options.items() if name not in ("x", "y", "mark")}
    if "x" not in options:
        raise BadRequest("map needs an axis: --x radius=1nm:1mm")
    axes = [axis_of(options[key], f"--{key}") for key in ("x", "y") if key in options]
    request = Request(words[1:], held, files)
    within = depends_on([quantity])
    for axis in axes:
        if axis.name in request.options:
            raise BadRequest(f"{axis.name} is on an axis; it cannot have one value too")
        if axis.name == quantity:
            raise BadRequest(f"{quantity} is what is drawn; it is no axis")
        if axis.name not in within:
            raise BadRequest(f"{quantity} does not depend on {axis.name}")
    if len({axis.name for axis in axes}) < len(axes):
        raise BadRequest(f"both axes are {axes[0].name}")
    if request.count > (1 if len(axes) > 1 else MOST_CURVES):
        most = f"{MOST_CURVES} curves" if len(axes) == 1 else "one map"
        raise BadRequest(f"{request.count} scenes are more than {most}")
    settings = tuple(
        (_distinction(scene, request), Setting(scene.stated, scene.material, scene.material2, request.materials))
        for scene in request.scenes()
    )
    y = axes[1] if len(axes) > 1 else None
    return Asked(quantity, axes[0], y, settings, marks_of(options), request.materials)


def _distinction(scene: Scene, request: Request) -> str:
    """What tells a scene from the others of its request: materials and values of which several were given."""
    parts = [one.name for one in (scene.material, scene.material2) if one is not None]
    several = [name for name, text in request.options.items() if "," in text or ":" in text]
    parts += [f"{NOMENCLATURE[name].symbol} = {pretty(amount(name, scene.stated[name]))}" for name in several]
    return ", ".join(parts)


def marks_of(options: Mapping[str, str]) -> tuple[str, ...]:
    """The marks that were asked for."""
    return tuple(filter(None, options.get("mark", "").split(",")))


def mark_at(text: str, materials: Materials, setting: Setting, x: Axis, y: Axis) -> Mark:
    """The place of `MATERIAL@RADIUS`, `MATERIAL` or `@RADIUS` on a map."""
    name, _, radius = text.partition("@")
    material = materials[name] if name else None
    values = {"radius": parse_quantity(radius, "radius")} if radius else {}
    scene = setting.scene(values, material)
    mark = Mark(text, coordinate(x, scene), coordinate(y, scene))
    if mark.x is None and mark.y is None:
        raise BadRequest(f"--mark {quoted(text)} is nowhere on {x.name} and {y.name} as they are drawn")
    return mark


def sized(axis: Axis, size: int) -> Axis:
    """An axis with a number of values, unless it was given one."""
    return axis if axis.size else axis._replace(size=size)


def map_of(wish: Asked, size: tuple[int, int], progress: Progress | None = None) -> tuple[Map, tuple[str, ...]]:
    """The map that was asked for, of so many points unless told, and notes on it."""
    assert wish.y is not None
    x, y = sized(wish.x, size[0]), sized(wish.y, size[1])
    if x.size * y.size > MOST_POINTS:
        raise BadRequest(f"{x.size} x {y.size} points are more than {MOST_POINTS}")
    setting = wish.settings[0][1]
    middle = {**_one_of(x), **_one_of(y)}
    scene, told, notes = about(wish.quantity, setting, middle)
    values = evaluate(setting, wish.quantity, x, y, progress)
    if not has_values(values):
        raise NothingToDraw(wish.quantity)
    marks = [mark_at(text, wish.materials, setting, x, y) for text in wish.marks]
    if setting.material is None and {x.name, y.name} & {*PROPERTIES}:
        marks = [*material_marks(wish.materials, x, y), *marks]
    found = regions(setting, bounds_of(scene, wish.quantity), x, y)
    is_log = is_wide(values)
    title = described(wish.quantity, "")
    return Map(
        wish.quantity,
        x,
        y,
        values,
        is_log,
        False,
        tuple(found),
        tuple(marks),
        title,
        _caption(wish.quantity, scene, told),
    ), notes


def curves_of(wish: Asked, size: int) -> tuple[Picture, tuple[str, ...]]:
    """The curves that were asked for, and notes on them."""
    x = sized(wish.x, size)
    curves: list[Curve] = []
    notes: dict[str, None] = {}
    shared: list[str] = []
    for number, (text, setting) in enumerate(wish.settings):
        scene, told, noted = about(wish.quantity, setting, _one_of(x))
        notes |= dict.fromkeys(noted)
        shared = [part for part in told if part in shared or not number]
        curves.append(Curve(text, x.values(), along(setting, wish.quantity, x), number))
    if not any(has_values(curve.y) for curve in curves):
        raise NothingToDraw(wish.quantity)
    y = axis_around(wish.quantity, [curve.y for curve in curves])
    points = [mark_at(text, wish.materials, wish.settings[0][1], x, y) for text in wish.marks]
    panel = Panel(x, y, tuple(curves), tuple(points))
    return Picture("", (panel,), _caption(wish.quantity, scene, shared)), tuple(notes)


def _caption(quantity: str, scene: Scene, told: Sequence[str]) -> tuple[str, ...]:
    """What is shown, by which equation, and what is held."""
    entry, number = NOMENCLATURE[quantity], equation_of(quantity, scene)
    equation = f", Eq ({number})" if number else ""
    shown = f"{entry.sentence[0].upper()}{entry.sentence[1:]} {entry.symbol}{equation}."
    return (shown, held(told)) if told else (shown,)


def held(told: Sequence[str]) -> str:
    """What is the same all over a picture."""
    return f"Held: {', '.join(told)}."


def _one_of(axis: Axis) -> dict[str, float]:
    """One value of an axis, to ask what it takes and what it assumes."""
    return inputs_at(axis.name, axis.high)


def about(
    quantity: str, setting: Setting, values: Mapping[str, float]
) -> tuple[Scene, tuple[str, ...], tuple[str, ...]]:
    """A scene of a map, what is the same all over it, and the notes on it; MissingInput if something is missing."""
    scene = setting.scene(values)
    inputs = scene.inputs_of(quantity)
    shown = [material.name if not number else f"material2 = {material.name}"
             for number, material in enumerate((scene.material, scene.material2)) if material is not None]  # fmt: skip
    for name in inputs:
        if name not in values:
            value = scene.values[name]
            text = amount(name, word_for_infinity(name) or value if value == INFINITY else value)
            shown.append(f"{NOMENCLATURE[name].symbol} = {pretty(text)}")
    note = NOMENCLATURE[quantity].note
    notes = [*assumptions(scene, inputs, [quantity]), *about_data(scene, inputs)]
    return scene, tuple(shown), (*notes, f"{quantity}: {note}") if note else tuple(notes)
