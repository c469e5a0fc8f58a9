"""What may stand in place of results: those of the other law, and those that measured rolling forces mean."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import reduce
from math import nan
from operator import attrgetter
from typing import Any, NamedTuple

from ..errors import JkrollError
from ..materials.library import Displacement, Material
from ..physics.elementary import NUMBER, at_least, at_most, quotient, where
from ..quantities.laws import BETWEEN, DEFAULT_LAW, other_law
from ..quantities.nomenclature import INFINITY, XI
from ..quantities.values import Interval, ends_of
from .column import Column, first_of
from .frame import DEFAULTS, IN_ITS_PLACE, Frame, once_a_frame
from .plan import depends_on, plan_for
from .ranges import LEAST, takes
from .reasons import HIDDEN, reason
from .uncertainty import ErrorBar, error_bars, sources_of_results

# --- By the other law -------------------------------------------------------------------------------------------------


@once_a_frame
def at_half_spacing(frame: Frame) -> Frame:
    """Return a frame whose atomic spacing is half as large, or the least that a frame takes."""
    return frame.replace(atomic_spacing=at_least(frame["atomic_spacing"] / 2, LEAST))


def by_law_at_spacing(frame: Frame, names: Iterable[str]) -> Frame:
    """Return the frame under the other law, with its atomic spacing stated where that decides on some quantities."""
    rests = any(map(frame.by_law.may_rest_on_spacing, names))
    return frame.by_law_at_spacing if rests else frame.by_law


def rolling(names: Iterable[str]) -> list[str]:
    """Return those of some quantities that follow from the yield displacement, under every law the same."""
    return [name for name in names if name != XI and XI in depends_on((name,))]


def is_at_displacement(frame: Frame) -> bool:
    """Return whether equal inputs are equal displacements, and not equal hystereses."""
    return frame.given.keys().isdisjoint(IN_ITS_PLACE[1:])


def at_other_reading(frame: Frame, other: Frame) -> Frame | None:
    """Return a frame under another law with the other of equal displacement and hysteresis, or None."""
    ours, theirs = frame.numbers(XI, "hysteresis_ratio"), other.numbers("hysteresis_ratio")
    if len(ours) < 2 or not theirs:
        return None
    displacement, without_contact = ours[XI], DEFAULTS[XI]
    if is_at_displacement(frame):
        displacement = displacement * (ours["hysteresis_ratio"] / theirs["hysteresis_ratio"])
        without_contact = ours[XI]
    displacement = where(takes(XI, displacement), displacement, without_contact)
    return other.replace(**{**dict.fromkeys(IN_ITS_PLACE), XI: displacement})


def has_other_formulas(frame: Frame, name: str, law: str = DEFAULT_LAW) -> bool:
    """Return whether a law has a quantity by other formulas than a frame, or does not have it."""
    return frame.plan(name).steps.keys() != plan_for(name, *frame.plan_key[:2], law).steps.keys()


def moved_by_law(frame: Frame, names: Iterable[str]) -> list[str]:
    """Return those of some quantities that the other law has by formulas of its own, or alone."""
    other = frame.by_law
    return [name for name in other.possible(names) if has_other_formulas(frame, name, other.law.name)]


def factor_of_law(frame: Frame, columns: Mapping[str, Column]) -> Any:
    """Return how far results are from those under the law that holds, as the factor of the farthest.

    A rolling quantity is compared at equal displacement and at equal hysteresis, a pull-off force with Lennard-Jones'
    law, too. The factor is infinite where only the law in use has a result, or results differ in sign.
    """
    if frame.law.name == BETWEEN:
        return 1.0
    ours = {name: columns[name].values for name in moved_by_law(frame, columns) if not columns[name].is_empty}
    other = by_law_at_spacing(frame, ours)
    compared = [*other.columns(ours).items()]
    rolled = rolling(ours)
    if rolled and (reading := at_other_reading(frame, other)) is not None:
        compared += reading.columns(rolled).items()
    if "pull_off_force" in ours:
        compared.append(("pull_off_force", frame.column("pull_off_force_lennard_jones")))
    return farthest((theirs.or_else(0.0), ours[name]) for name, theirs in compared)


def farthest(answers: Iterable[tuple[Any, Any]]) -> Any:
    """Return the factor between two answers, or its inverse if larger, of those that are farthest apart; 1 without any.

    It is infinite where the first answer is 0, or signs differ, and 1 where the second is none or 0.
    """
    ratios: list[Any] = [1.0]
    ratios += (quotient(theirs, ours, 1.0) for theirs, ours in answers)
    least, most = reduce(at_most, ratios), reduce(at_least, ratios)
    is_positive = least > 0
    return where(is_positive, at_least(most, 1 / where(is_positive, least, 1.0)), INFINITY)


# --- By measured forces -----------------------------------------------------------------------------------------------

SIO2, POLYSTYRENE, MICA = "SiO2", "polystyrene", "mica"
# Rolling forces on pairs of SiO2 spheres, and these pairs: Heim et al. 1999, Blum & Wurm 2000, Gundlach et al. 2011.
FORCES = 0.85e-9, 1.21e-9
ROLLED = {"radius": 0.95e-6, "surface_energy": 0.025, "youngs_modulus": 54e9, "poisson_ratio": 0.17}
_OF_POLYSTYRENE = Displacement(Interval(42e-9, 42e-9, 42e-9), 1e-5)  # spheres of 5 µm on a plane: Sümer & Sitti
# The radii of identical pairs to which it is scaled, and the surface energies that these spheres may have.
_NEAR = {SIO2: ((1e-7, 3e-6), (0.02, 0.025)), POLYSTYRENE: ((3e-6, 1e-4), (0.0, INFINITY))}


def measured_solid(material: Material) -> str:
    """Return the solid on which rolling was measured, if a material is of it.

    The spheres of SiO2 had the surface energy of humid silica. That of ice was itself scaled from rolling forces.
    """
    if SIO2 in material.aliases:
        return SIO2
    return POLYSTYRENE if material.name in (POLYSTYRENE, "polystyrene-glassy") else ""


def assumes_displacement(frame: Frame) -> bool:
    """Return whether the paper's displacement is assumed where rolling begins, under a law by which forces mean one."""
    return XI in frame.values and frame.given.keys().isdisjoint(IN_ITS_PLACE) and not frame.plan("yield_force").lacking


def is_smooth(material: Material | None) -> bool:
    """Return whether the surfaces of a material are smooth atom by atom: those of mica, which is cleaved."""
    return material is not None and MICA in (material.name, *material.aliases)


def solid_of_pair(frame: Frame) -> str:
    """Return the solid on which rolling was measured, if both spheres are of it."""
    solid = frame.material
    measured = measured_solid(solid) if solid is not None else ""  # none of several, whose properties are arrays
    return measured if frame.material2 in (None, solid) else ""


def rolled_solid(frame: Frame) -> str:
    """Return the solid on which rolling was measured, if both spheres are of it, whatever their size, and ξ assumed."""
    solid = solid_of_pair(frame)
    return solid if solid and assumes_displacement(frame) else ""


def is_like_rolled(frame: Frame) -> Any:
    """Return whether spheres have the solid, size and γ of those that were rolled, by element for arrays."""
    solid = rolled_solid(frame)
    if not solid:
        return False
    known = frame.numbers("work_of_adhesion", "reduced_radius")
    (least, most), (low, high) = _NEAR[solid]
    radius, energy = 2 * known.get("reduced_radius", 0.0), known.get("work_of_adhesion", 0.0) / 2
    return (least <= radius) & (radius <= most) & (low <= energy) & (energy <= high)


@once_a_frame
def displacements_where_measured(frame: Frame) -> tuple[float, float]:
    """Return the displacements that forces on SiO2 mean, with the work of adhesion, modulus and law in use."""
    ours = frame.numbers("work_of_adhesion", "contact_modulus") if rolled_solid(frame) == SIO2 else {}
    given = {"radius": ROLLED["radius"], **ours} if len(ours) == 2 else ROLLED
    spacing = {"atomic_spacing": frame.values["atomic_spacing"]} if "atomic_spacing" in frame.values else {}
    pair = Frame({**given, **spacing, XI: DEFAULTS[XI]}, model=frame.law.name)
    low, high = (DEFAULTS[XI] * (force / pair["yield_force"]) for force in FORCES)
    return low, high


@once_a_frame
def measured_displacement(frame: Frame) -> Interval:
    """Return the displacement that forces on the solid of a frame mean, scaled to its radii."""
    displacement = _OF_POLYSTYRENE
    if rolled_solid(frame) == SIO2:
        low, high = displacements_where_measured(frame)
        displacement = Displacement(Interval.of((low + high) / 2, low=low, high=high), ROLLED["radius"])
    return displacement.scaled(2 * frame["reduced_radius"])


@once_a_frame
def at_least_measured(frame: Frame) -> Frame:
    """Return the frame with the least displacement that forces on the same solid mean."""
    return frame.replace(**{XI: measured_displacement(frame).low})


@once_a_frame
def at_most_measured(frame: Frame) -> Frame:
    """Return the frame with the largest displacement that forces on the same solid mean."""
    return frame.replace(**{XI: measured_displacement(frame).high})


def at_full_hysteresis(frame: Frame) -> Frame:
    """Return the frame with the displacement at which all of the work of adhesion is lost."""
    return frame.replace(**{XI: frame[XI] / frame["hysteresis_ratio"]})


def factor_of_data(frame: Frame, _: Mapping[str, Column]) -> Any:
    """Return how far the assumed ξ is from what forces on the same solid mean, as the larger factor; 1 without any."""
    factor = farthest((end, frame[XI]) for end in ends_of(measured_displacement(frame)))
    return where(is_like_rolled(frame), factor, 1.0)


# --- What may stand in place of results -------------------------------------------------------------------------------

DATA = "data"  # stands for alternatives by measured forces; those by another law have its name


def names_with_alternatives(frames: Sequence[Frame], names: Sequence[str]) -> dict[str, list[str]]:
    """Return the quantities that have alternatives, by the name of the other law, and by DATA.

    `frames`: one of each group of rows. Of several laws, the other one is that which holds between them.
    """
    others = {other_law(frame.law.name) for frame in frames}
    law = others.pop() if len(others) == 1 else BETWEEN
    moved = {name for frame in frames for name in moved_by_law(frame, names)}
    rolled = {name for frame in frames if assumes_displacement(frame) for name in rolling(names)}
    return {law: [name for name in names if name in moved], DATA: [name for name in names if name in rolled]}


class Alternative(NamedTuple):
    """What may stand in place of a result: a column, with its error bar if it has one."""

    column: Column
    bar: ErrorBar | None = None

    def without(self, is_out: Any) -> "Alternative":
        """Return the alternative, where some rows have none."""
        column = self.column.without(is_out, reason(HIDDEN))
        if self.bar is None or column is self.column:
            return Alternative(column, self.bar)
        return Alternative(column, self.bar.without(is_out))

    @property
    def measure(self) -> Any:
        """The value of a single row, with its error bar; None without one."""
        if self.column.is_empty:
            return None
        has_bar = self.bar is not None and self.bar.sides
        return self.bar.of(self.column.values) if self.bar is not None and has_bar else self.column.values


def alternatives_of(frame: Frame, names_of: Mapping[str, Sequence[str]]) -> dict[str, dict[str, Alternative]]:
    """Return what may stand in place of results, by law or DATA and by quantity, with error bars if the frame has some.

    `names_of`: the quantities of each. A law, or data, that a frame does not have is left out.
    """
    law, every = other_law(frame.law.name), {}
    if moved := names_of.get(law):
        every[law] = with_bars(frame, moved, attrgetter("by_law"))
    rolled = names_of.get(DATA)
    if rolled and (is_near := is_like_rolled(frame)) is not False:
        deciding = "yield_force", "reduced_radius"  # at the pair that was measured, and here
        lows, highs = (with_bars(frame, rolled, end, deciding) for end in (at_least_measured, at_most_measured))
        every[DATA] = {name: _between(lows[name], highs[name], is_near) for name in rolled}
    return every


def with_bars(
    frame: Frame, names: Sequence[str], alternative: Callable[[Frame], Frame], deciding: Sequence[str] = ()
) -> dict[str, Alternative]:
    """Return quantities of what is made of a frame, with their error bars. Sources that do not go together give none.

    `deciding`: the quantities of the frame that decide on inputs of the other one, whose sources enter, too. Raises a
    JkrollError for several rows of which some have no error bars.
    """
    columns, bars = alternative(frame).columns(names), dict[str, ErrorBar]()
    if frame.uncertainties:
        try:
            sources = sources_of_results(frame, [*names, *deciding]) if deciding else None
            bars = error_bars(frame, names, alternative, sources)
        except JkrollError:
            if frame.shape:  # of several rows, one may be to blame
                raise
    return {name: Alternative(column, bars.get(name)) for name, column in columns.items()}


def _between(first: Alternative, second: Alternative, is_near: Any) -> Alternative:
    """Return the range of two values with their error bars, in rows of spheres like those that were rolled.

    Two values that are the same are one.
    """
    reasons = first_of(first.column.reasons, second.column.reasons)
    ends = [*ends_of_alternative(first), *ends_of_alternative(second)]
    low, high = reduce(at_most, ends), reduce(at_least, ends)
    value = (first.column.values + second.column.values) / 2
    column = Column(value, reasons).without(where(is_near, False, True), reason(HIDDEN))
    if isinstance(low, NUMBER) and low == high:
        return Alternative(column)
    has_value = column.reasons == 0
    sides = {"low": where(has_value, low, nan), "high": where(has_value, high, nan)}
    return Alternative(column, ErrorBar(Interval, sides))


def ends_of_alternative(alternative: Alternative) -> tuple[Any, Any]:
    """Return the ends of the error bar of an alternative, or twice its value where it has none."""
    value, bar = alternative.column.values, alternative.bar
    if bar is None or not bar.sides:
        return value, value
    low, high = ends_of(bar.of(value))
    has_bar = low == low  # noqa: PLR0124
    return where(has_bar, low, value), where(has_bar, high, value)
