"""A frame: the inputs of one row or of many, and the quantities that follow from them.

A frame makes two assumptions: sphere 2 is like sphere 1 in every property that is not given for it, and inputs
that are not given have their defaults. `accepted` has the ranges of inputs. Results are doubles of full precision, 0
where the physics gives 0, and infinite for some quantities of a plane, such as its mass.
"""

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from functools import cached_property, lru_cache, partial, reduce, wraps
from itertools import product
from math import nan
from operator import and_
from types import MappingProxyType
from typing import Any, TypeVar

from ..errors import BadRequest, JkrollError
from ..materials.library import Material
from ..physics.contact import reduced_radius
from ..physics.elementary import NUMBER, where
from ..quantities.laws import ALWAYS, DEFAULT_LAW, HELD_BY_LOAD, LAWS, Law, other_law
from ..quantities.nomenclature import CONVERTED, DEFAULTS, INFINITY, NOMENCLATURE, PROPERTIES, STATE, XI, of_sphere
from ..quantities.values import Interval, Uncertain, is_uncertain, middle
from ..text import listed
from .accepted import OF_A_PLANE, SMALLEST, check_range, is_answer
from .column import Column, at_row, broadcast, first_reasons
from .conversions import converted, lacked
from .plan import KEPT, OF_A_SOLID, Plan, depends_on, in_order, plan_for
from .reasons import (
    HIDDEN,
    INFINITE,
    MISSING,
    NOT_IN_LAW,
    RESTS_ON_SPACING,
    TWO_RIGID_BODIES,
    Cause,
    EndOfMeaning,
    Failure,
    MissingInput,
    NotInLaw,
    cause_and_step,
    failure_of,
    reason,
    reason_for,
)

# --- Frames -----------------------------------------------------------------------------------------------------------

ROLLING_ONSET = (XI, "adhesion_hysteresis", "hysteresis_fraction")  # alternative inputs that set where rolling begins
# Special values of inputs (a plane, a rigid body, no load), and the values of other quantities that follow.
FOLLOWS: Mapping[str, tuple[float, Mapping[str, float]]] = {
    "diameter2": (INFINITY, {}),  # converted to a radius
    "radius2": (INFINITY, {"radius_ratio": 0.0, "rayleigh_frequency2": 0.0, **dict.fromkeys(OF_A_PLANE, INFINITY)}),
    "youngs_modulus": (INFINITY, {"poisson_ratio": 0.0}),  # without strain, Poisson's ratio does not matter
    "youngs_modulus2": (INFINITY, {"poisson_ratio2": 0.0}),
    "load": (0.0, {"load_margin": 1.0}),
}

_OF_ONE_LAW = STATE - {"approach_at_load"}  # inputs that exist in one law only

# Inputs that exclude each other, since one follows from the other.
EXCLUSIVE = (
    ("energy", "energy_ratio", "speed"),
    *product(("surface_energy", "surface_energy2"), ("work_of_adhesion",), ("hamaker", "hamaker2")),
    ("load", *sorted(STATE)),
    ROLLING_ONSET,
    ("contact_modulus", "modulus_over_energy"),
    *product(("radius", "diameter", "radius2", "diameter2"), ("reduced_radius",)),
    *((other, name) for name, other in CONVERTED.items()),
)

# Inputs that replace the yield displacement of a solid, or give sphere 2 another solid.
_OTHER_DISPLACEMENT = frozenset((*ROLLING_ONSET, *(of_sphere(2, name) for name in OF_A_SOLID)))

# Quantities that need a contact area. If both bodies are rigid, these and the results computed from them have no value.
_ON_AREA = frozenset({"contact_modulus", "contact_shear_modulus", "shear_strength", "pull_off_force", "load_factor",
    "rolling_frequency_as_printed"})  # fmt: skip


Made = TypeVar("Made")
Variant = Callable[["Frame"], "Frame"]  # returns a frame that differs in its law or its inputs


class Frame:
    """Two spheres, as far as they are described, and all quantities that follow from the description.

    `described` are the inputs by name, and `stated` are the same inputs after conversion. `given` adds the properties
    of the materials, and drops uncertainties. `known` has the names of the inputs in `given`, of defaults, and of
    quantities that a single input implies. `values` holds the known values and all results so far, nan for a missing
    result; `reasons` explains each nan. Both hold arrays, or numbers that apply to all rows.

    >>> frame = Frame({"surface_energy": 0.025, "radius": 1e-7})
    >>> f"{frame['pull_off_force']:.4e}"
    '1.1781e-08'
    >>> frame.replace(radius=2e-7)["reduced_radius"]
    1e-07
    """

    few = 300  # up to this many points of uncertain inputs, floats are faster than importing numpy; two ranges have 256
    unknowns: Sequence[str] = ()  # inputs that are inferred from measured quantities
    solution: Any = None  # the inferred values of the unknowns

    def __init__(
        self,
        given: Mapping[str, Any],
        material: Material | None = None,
        material2: Material | None = None,
        *,
        model: str | None = None,
        moved: Mapping[str, Any] = MappingProxyType({}),
        state: str = "",
    ) -> None:
        """`given`: SI values by name, which override those of the materials.

        `material2`: None if sphere 2 has the material of sphere 1. `model`: the name of a law in `LAWS`; None for JKR,
        the law of the paper. `moved`: values that override those of a material without counting as stated; None removes
        an input. `state`: the name of a state of a force curve. The frame computes with the middle of an uncertain
        value; `model.uncertainty` adds the uncertainties of results. Raises QuantityError, or BadRequest for inputs
        that exclude each other or are correlated, and for arrays that do not broadcast.
        """
        self.law = LAWS[DEFAULT_LAW if model is None else model]
        self.stated_model = None if model is None else self.law.name
        self.state = state
        check_exclusive(given)
        self.material, self.material2, self.moved = material, material2, moved
        # Each material with the number of its sphere; sphere 2 is listed only if it has a material of its own.
        self.materials = [(solid, sphere) for solid, sphere in ((material, 1), (material2, 2)) if solid is not None]
        # By input: the material that provides it, and the name of the material's property.
        self.of_materials: dict[str, tuple[Material, str]] = {}
        for solid, sphere in self.materials:
            self.of_materials |= {of_sphere(sphere, name): (solid, name) for name in solid.properties}
        self.described = {**given}
        self.stated = self.described if CONVERTED.keys().isdisjoint(given) else self._converted()
        for name in self.stated.keys() & CONVERTED.keys():  # a shear modulus without ν leaves E unknown
            self.of_materials.pop(CONVERTED[name], None)
        self.uncertain = {name: value for name, value in self.stated.items() if is_uncertain(value)}
        of_solids = {name: solid.properties[of_solid] for name, (solid, of_solid) in self.of_materials.items()}
        values = {**of_solids, **self.stated, **moved}
        self.given: dict[str, Any] = {name: middle(value) for name, value in values.items() if value is not None}
        self.arrays = {name: value for name, value in self.given.items() if not isinstance(value, NUMBER)}
        self.shape = broadcast(self.arrays)
        for name, value in self.given.items():
            check_range(name, value)
        self.displacement = self._displacement_of_solid()
        if self.displacement is not None:
            self.given[XI] = self.displacement.value
        has_displacement = any(solid.displacement is not None for solid, _ in self.materials)
        self.values = {**_assumed(frozenset(self.given), has_displacement), **self.given}
        self.sources: dict[str, str] = {}  # by implied value: the input from which it follows
        for source, implied in _implied(self.values, self.law, self.uncertain).items():
            self.sources |= dict.fromkeys(implied.keys() - self.values.keys(), source)
            self.values = {**implied, **self.values}
        self.known = frozenset(self.values)
        self.plan_key = (self.known, material2 is not None, self.law.name)  # plans depend only on these
        self.reasons: dict[str, Any] = {}  # reasons of nan values, for results that have any
        self.steps: dict[str, Plan] = {}  # the steps that computed these results
        # Computed arrays and reasons, by step and ids of its arguments, which are kept alive so that no id is reused.
        self._shared: dict[tuple[object, ...], tuple[tuple[Any, Any], Any]] = {}
        self.derived: dict[Any, Any] = {}  # kept results of functions of the frame, by function

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the description; results are computed again."""
        make = partial(Frame, model=self.stated_model, moved=self.moved, state=self.state)
        return make, (self.described, self.material, self.material2)

    def replace(self, **values: Any) -> "Frame":
        """Return the frame with other values of inputs; None removes an input.

        `model` sets the law of attraction, `state` the name of the state. New values of a material's properties count
        as moved, new values of other inputs as stated. A radius replaces a described diameter, and E replaces G. Arrays
        that follow from the same values are reused, which saves a tenth of the time of a table with doubts.
        """
        model, state = values.pop("model", self.stated_model), values.pop("state", self.state)
        of_materials = self.of_materials.keys() & values.keys() - self.stated.keys()
        moved = {**self.moved, **{name: values.pop(name) for name in of_materials}}
        given = {}
        for name, value in {**self.described, **values}.items():
            if value is not None and CONVERTED.get(name) not in values:
                given[name] = value
        frame = Frame(given, self.material, self.material2, model=model, moved=moved, state=state)
        frame._shared = {**self._shared}
        return frame

    @property
    def filled(self) -> "Frame":
        """The frame for making plans, with placeholders for inputs that are not inferred yet."""
        return self

    @property
    def found(self) -> "Frame":
        """The frame in which all inputs have values."""
        return self

    def check(self) -> None:
        """Do nothing; an `Inverse` frame raises an error here if no measured value can have a solution."""

    def judged(self, names: Iterable[str]) -> Sequence[str]:
        """Return the quantities whose limits apply to some results: here the results themselves."""
        return [*names]

    def under(self, law: str) -> "Frame":
        """Return the frame under another law.

        A named state that an input of one law sets is replaced by its load, unless only grips hold it.
        """
        of_one_law = _OF_ONE_LAW & self.stated.keys()
        if self.state in HELD_BY_LOAD and of_one_law:
            return self.replace(model=law, load=self["load"], **dict.fromkeys(of_one_law))
        return self.replace(model=law)

    @cached_property
    def by_law(self) -> "Frame":
        """The frame under the law to compare with: Maugis' law, or JKR if Maugis' law is already in use."""
        return self.under(other_law(self.law.name))

    @cached_property
    def by_law_at_spacing(self) -> "Frame":
        """`by_law` with its atomic spacing stated."""
        return self.by_law.replace(atomic_spacing=self.by_law["atomic_spacing"])

    def _converted(self) -> dict[str, Any]:
        """Check the described inputs, and return them after conversion."""
        values = {name: middle(value) for name, value in self.described.items()}
        for name, value in values.items():
            check_range(name, value)
        broadcast({name: value for name, value in values.items() if not isinstance(value, NUMBER)})
        data = {name: solid.measures[of_solid] for name, (solid, of_solid) in self.of_materials.items()}
        known = {name: value for name, value in {**data, **self.moved}.items() if value is not None}
        return converted(self.described, known, own_material2=self.material2 is not None)

    def _displacement_of_solid(self) -> Interval | None:
        """Return ξ of the solid of both spheres, scaled to their radii; None if unknown, or if an input replaces it."""
        material, radius = self.material, self.given.get("radius")
        if material is None or material.displacement is None or radius is None:
            return None
        is_of_two = self.material2 is not None and self.material2.key != material.key
        if is_of_two or not self.stated.keys().isdisjoint(_OTHER_DISPLACEMENT):
            return None
        reduced = reduced_radius(radius=radius, radius2=self.given.get("radius2", radius))
        return material.displacement.scaled(2 * reduced)

    @cached_property
    def data(self) -> Mapping[str, tuple[Material, str]]:
        """The inputs that come from a material, each with the material and the property."""
        others = self.stated.keys() | self.moved.keys()
        data = {name: of_solid for name, of_solid in self.of_materials.items() if name not in others}
        return data if self.displacement is None or self.material is None else {**data, XI: (self.material, XI)}

    def data_used(self, inputs: Collection[str]) -> list[tuple[Material, str]]:
        """Return the material and the property of each input that comes from a material."""
        return [used for name, used in self.data.items() if name in inputs]

    @cached_property
    def uncertainties(self) -> Mapping[str, Uncertain]:
        """The uncertainties of inputs, stated or from materials."""
        bars = {name: solid.uncertainties.get(of_solid) for name, (solid, of_solid) in self.data.items()}
        bars |= {XI: self.displacement, **self.uncertain}
        return {name: bar for name, bar in bars.items() if bar is not None}

    @cached_property
    def is_rigid(self) -> Any:
        """True if both bodies are rigid and no contact modulus is given; by row for arrays, or False for all rows."""
        modulus = self.given.get("youngs_modulus")
        modulus2 = self.given.get("youngs_modulus2", modulus if self.material2 is None else None)
        is_rigid = (modulus == INFINITY) & (modulus2 == INFINITY) & ("contact_modulus" not in self.given)
        return is_rigid if isinstance(is_rigid, bool) or is_rigid.any() else False

    @cached_property
    def is_identical(self) -> Any:
        """True if no input makes sphere 2 differ from sphere 1; row by row for arrays."""
        of_2 = {of_sphere(1, name): value for name, value in self.given.items() if NOMENCLATURE[name].sphere == 2}
        lacks_some = self.material2 is not None and any(name in self.given and name not in of_2 for name in PROPERTIES)
        return reduce(and_, (value == self.given.get(name) for name, value in of_2.items()), not lacks_some)

    @property
    def stated_of_1(self) -> dict[str, Any]:
        """The stated inputs that apply to two spheres like sphere 1: not those of sphere 2, nor w between materials."""
        stated = {name: value for name, value in self.stated.items() if NOMENCLATURE[name].sphere != 2}
        if self.material2 is not None:
            stated.pop("work_of_adhesion", None)
        return stated

    def shows(self, name: str) -> Any:
        """Return whether a quantity is shown without being asked for by name, row by row for arrays."""
        is_shown = self.shows_to_identical(name)
        return self.is_identical if is_shown and NOMENCLATURE[name].of_identical else is_shown

    def shows_to_identical(self, name: str) -> bool:
        """Return whether a quantity that was not asked for by name would be shown for identical spheres."""
        quantity, stated = NOMENCLATURE[name], self.stated.keys()
        return (
            name not in stated
            and name not in self.law.omits
            and not (quantity.shown_with and stated.isdisjoint(quantity.shown_with))
        )

    # --- Plans --------------------------------------------------------------------------------------------------------

    def plan(self, name: str) -> Plan:
        """Return the plan of a quantity, with `is_possible` False if the inputs do not determine the quantity."""
        return plan_for(name, *self.plan_key)

    def plans(self, *names: str) -> list[Plan]:
        """Return the plans of quantities; raise MissingInput for the first that the inputs do not determine."""
        for name in self.missing(names):
            raise self.missing_input(name)
        return [*map(self.plan, names)]

    def formulas_to(self, *wanted: str) -> frozenset[str]:
        """Return the names of all formulas needed for the wanted quantities."""
        return frozenset().union(*(plan.steps for plan in self.plans(*wanted))) - self.known

    def missing(self, names: Iterable[str]) -> list[str]:
        """Return the quantities that the inputs do not determine."""
        return [name for name in names if not self.plan(name).is_possible]

    def possible(self, names: Iterable[str]) -> list[str]:
        """Return the quantities that the inputs determine."""
        names = [*names]
        missing = {*self.missing(names)}
        return [name for name in names if name not in missing]

    def inputs_of(self, *wanted: str) -> tuple[str, ...]:
        """Return the inputs that the wanted quantities depend on, in the order of the nomenclature."""
        used = set()
        for plan in self.plans(*wanted):
            used |= {self.sources.get(name, name) for name in plan.steps.keys() & self.known}
        if XI in used and self.displacement is not None:
            used |= {"radius", "radius2"}  # they scale the value of the material
        return in_order(used & (self.given.keys() | DEFAULTS.keys()))

    def inputs_used(self, names: Sequence[str]) -> Collection[str]:
        """Return those inputs of the frame that quantities depend on.

        If the inputs determine none of the quantities, these are the given inputs of their formulas by JKR.
        """
        possible = self.possible(names)
        return self.inputs_of(*possible) if possible else depends_on(tuple(names)) & self.given.keys()

    def echo(self, used: Collection[str]) -> dict[str, Any]:
        """Return the inputs that are used or stated, as understood: materials, law, SI values, state.

        A stated input that is not used may still decide doubts and values by other laws, or identify rows of a list.
        """
        used = {*used, *(self.stated.keys() & self.given.keys())}
        echoed: dict[str, Any] = {of_sphere(sphere, "material"): solid.name for solid, sphere in self.materials}
        if self.stated_model is not None:
            echoed |= self.law.words
        for name in NOMENCLATURE:
            if name in used:
                echoed[name] = self.values[name]
            elif name == "radius2" and "radius" in used:
                echoed[name] = self.values.get(name, self.values["radius"])
            elif name == "energy" and "energy_ratio" in used:
                echoed |= self.numbers("energy")
        if self.state:
            echoed["state"] = self.state
        return echoed

    def missing_input(self, name: str) -> MissingInput:
        """Return the error for a quantity that needs more inputs, with the materials that lack them."""
        plan = self.plan(name)
        if plan.lacking:
            return NotInLaw(name, in_order(plan.lacking), self.law.title)
        names = lacked(plan.missing, self.stated)
        if XI in names and "radius" not in self.given:
            names = names - {XI} | {"radius"}  # the radius scales ξ of the solid
        lacking: dict[str, None] = {}
        for missing in in_order(names):
            solid, of_solid = self.material, of_sphere(1, missing)
            if NOMENCLATURE[missing].sphere == 2 and self.material2 is not None:
                solid = self.material2
            if solid is not None and solid.name and of_solid in PROPERTIES:
                lacking[solid.missing_text(of_solid)] = None
        return MissingInput(name, in_order(names), ", ".join(lacking))

    # --- Values and reasons -------------------------------------------------------------------------------------------

    def columns(self, names: Iterable[str]) -> dict[str, Column]:
        """Return the columns of quantities."""
        return {name: self.column(name) for name in names}

    def column(self, name: str) -> Column:
        """Return the column of a quantity; cells that rest on an assumed atomic spacing are emptied."""
        plan = self.plan(name)
        if not plan.is_possible:
            return Column(nan, reason(NOT_IN_LAW if plan.lacking else MISSING))
        if plan.name not in self.values:
            self._compute(plan)
        column = Column(self.values[plan.name], self.reasons.get(plan.name, 0))
        if not self.may_rest_on_spacing(name) or column.is_empty:
            return column
        rests_on_spacing = self.column("transition_parameter").values < 1
        return column.without(rests_on_spacing, reason(RESTS_ON_SPACING, name))

    def shown(self, names: Iterable[str], named: Collection[str]) -> dict[str, Column]:
        """Return the columns of quantities that apply to some row; infinite numbers become empty cells.

        `named`: quantities that were asked for by name; they apply to every row.
        """
        shown = {}
        for name in names:
            is_shown = name in named or self.shows(name)
            if is_shown is False:
                continue
            column = self.column(name)
            is_infinite = name in OF_A_PLANE and abs(column.values) == INFINITY
            shown[name] = column.without(is_infinite, reason(INFINITE, name)).hidden(is_shown)
        return shown

    @property
    def assumes_spacing(self) -> bool:
        """True if the atomic spacing was not given, either directly or by a Hamaker constant."""
        return self.given.keys().isdisjoint(("atomic_spacing", "hamaker"))

    def may_rest_on_spacing(self, name: str) -> bool:
        """Return whether a quantity depends on an assumed atomic spacing if the spheres are small and hard."""
        others = self.law.by_spacing - {name}
        return bool(others) and not others.isdisjoint(self.plan(name).steps) and self.assumes_spacing

    def drop(self, name: str, cause: Cause) -> None:
        """Replace the value of a quantity by a reason."""
        step = self.plan(name)
        self.values[step.name], self.reasons[step.name], self.steps[step.name] = nan, reason(cause, name), step

    def _compute(self, step: Plan) -> None:
        """Compute a step, after its arguments; arrays are reused if the step had the same arguments before."""
        for argument in step.plans:
            if argument.name not in self.values:
                self._compute(argument)
        given = {parameter: self.values[name] for parameter, name in step.arguments.items()}
        reasons = self._inherited(step) if self.reasons or self.is_rigid is not False else 0  # usually there are none
        if isinstance(reasons, int) and reasons:
            values: Any = nan
        elif not self.arrays:  # computing a number is faster than a look-up
            values, reasons = _result_of(step, given, reasons)
        else:
            key = (step.name, *map(id, given.values()), id(self.is_rigid))
            if key not in self._shared:
                import numpy

                with numpy.errstate(all="ignore"):  # elements without a value are nan or an infinity
                    self._shared[key] = _result_of(step, given, reasons), (given, self.is_rigid)
            values, reasons = self._shared[key][0]
        self.values[step.name] = values
        if not isinstance(reasons, int) or reasons:
            self.reasons[step.name], self.steps[step.name] = reasons, step

    def _inherited(self, step: Plan) -> Any:
        """Return the reasons why a step cannot be computed: in each cell, that of the first argument without a value.

        A quantity that needs a contact area also has a reason where both bodies are rigid.
        """
        reasons: Any = 0
        for name in step.arguments.values():
            reasons = first_reasons(reasons, self.reasons.get(name, 0))
        if step.name in _ON_AREA and self.is_rigid is not False:
            reasons = first_reasons(reasons, where(self.is_rigid, reason(TWO_RIGID_BODIES), 0))
        return reasons

    # --- Numbers and errors -------------------------------------------------------------------------------------------

    def __getitem__(self, name: str) -> Any:
        """Return the value of a quantity, nan in rows without one.

        Raises MissingInput, or NoResult if no row has a value.
        """
        column = self.column(name)
        if column.is_empty:
            raise self.error(name, column.reasons)
        return column.values

    def numbers(self, *names: str) -> dict[str, Any]:
        """Return the values of quantities by name, leaving out quantities without any value."""
        return {name: column.values for name, column in self.columns(names).items() if not column.is_empty}

    def error(self, name: str, number: int, row: int = 0) -> JkrollError:
        """Return the reason for an empty cell as an error, with the numbers of its row."""
        cause, step = cause_and_step(number)
        if cause in (None, MISSING, NOT_IN_LAW):
            return self.missing_input(name)
        if not cause.name:
            return Failure(cause, name if isinstance(cause, EndOfMeaning) else step)
        arguments = self.steps[step].arguments.items()
        return failure_of(number, {parameter: at_row(self.values[argument], row) for parameter, argument in arguments})

    def errors(self, columns: Mapping[str, Column], row: int = 0) -> dict[str, JkrollError]:
        """Return, by name, the errors of the columns that have no value in a row; hidden quantities are left out."""
        errors = {}
        for name, column in columns.items():
            number = at_row(column.reasons, row)
            if number not in (0, reason(HIDDEN)):
                errors[name] = self.error(name, number, row)
        return errors


def itself(frame: Frame) -> Frame:
    """Return the frame unchanged."""
    return frame


def once_a_frame(make: Callable[[Frame], Made]) -> Callable[[Frame], Made]:
    """Return a function that computes its result once for each frame."""

    @wraps(make)
    def made(frame: Frame) -> Made:
        if make not in frame.derived:
            frame.derived[make] = make(frame)
        derived: Made = frame.derived[make]
        return derived

    return made


def _result_of(step: Plan, given: Mapping[str, Any], reasons: Any) -> tuple[Any, Any]:
    """Return the values of a formula, and the reasons of cells without a value.

    `reasons`: the reasons of the arguments, which take precedence.
    """
    try:
        values = step.formula(**given)
    except (ArithmeticError, ValueError):  # raised for numbers; arrays get nan or an infinity
        values = INFINITY
    if isinstance(reasons, int) and _are_usual(values):
        return values, 0
    has_answer = is_answer(step.name, values)
    if not _all(has_answer | (reasons != 0)):
        reasons = first_reasons(reasons, where(has_answer, 0, reason_for(step.name, given)))
    return where(reasons == 0, values, nan), reasons


def _are_usual(values: Any) -> bool:
    """Return whether all values are finite, positive doubles of full precision."""
    if isinstance(values, NUMBER):
        return SMALLEST <= values < INFINITY
    return bool(values.size and values.min() >= SMALLEST and values.max() < INFINITY)


def _all(condition: Any) -> bool:
    return condition if isinstance(condition, bool) else bool(condition.all())


def check_exclusive(given: Collection[str], word_of: Callable[[str], str] = str) -> None:
    """Raise BadRequest for inputs that exclude each other. `word_of` returns the user's word for an input."""
    both = _exclusive_among(frozenset(given))
    if both:
        raise BadRequest(f"{listed(map(word_of, both))} exclude each other: one follows from the other")


@lru_cache(maxsize=KEPT)
def _exclusive_among(given: frozenset[str]) -> list[str]:
    """Return the first inputs that exclude each other, or an empty list."""
    for names in EXCLUSIVE:
        both = [name for name in names if name in given]
        if len(both) > 1:
            return both
    return []


@lru_cache(maxsize=KEPT)
def _assumed(given: frozenset[str], has_displacement: bool) -> Mapping[str, float]:
    """Return the defaults that no input replaces. There is no default ξ if a solid has a measured displacement."""
    replaced = set()
    for names in EXCLUSIVE:
        if not given.isdisjoint(names):
            replaced |= {*names}
    if "hamaker" in given:  # which determines w and the atomic spacing
        replaced.add("atomic_spacing")
    if has_displacement:
        replaced.add(XI)
    return {name: value for name, value in DEFAULTS.items() if name not in replaced}


def _implied(values: Mapping[str, Any], law: Law, uncertain: Collection[str]) -> dict[str, Mapping[str, float]]:
    """Return, by input, the values that follow from this input alone, or from its absence.

    Nothing follows from the middle of an uncertain value, since the values around it imply something else.
    """
    implied = {}
    for name, (value, follows) in FOLLOWS.items():
        if name not in uncertain and isinstance(values.get(name), NUMBER) and values[name] == value:
            implied[name] = follows
    if "radius2" not in values:
        implied["radius2"] = {"radius_ratio": 1.0}
    if "poisson_ratio2" not in values:
        implied.pop("youngs_modulus", None)  # a deformable sphere 2 would inherit this ratio
    if law.tables[ALWAYS].get("load_margin", "") is None:
        implied.pop("load", None)
    return implied
