"""What was given → what is asked: a scene evaluates the formulas that its questions need, and says what is missing.

What a scene assumes is stated here, once: sphere 2 is like sphere 1 in everything that is not said of it, and the names
in DEFAULTS have values if nothing else is said.
"""

from collections.abc import Callable, Collection, Iterable, Mapping
from functools import cached_property
from typing import Any

from ..materials.library import Material
from ..physics.jkr import FOLD_APPROACH
from ..quantities.errors import OutOfRange, UnknownQuantity
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, PROPERTIES, RANGES
from .errors import (
    BeyondFold,
    BeyondPullOff,
    Contradiction,
    MissingInput,
    NoChain,
    NoFiniteValue,
    NoVibration,
    TwoRigidBodies,
)
from .wiring import STATE, Plan, Step, plan

DEFAULTS = {
    "yield_displacement": 2e-10,
    "load": 0.0,
    "gravity": 9.80665,
    "energy_ratio": 1.0,
    "atomic_spacing": 4e-10,
}
_DEFAULTS_OF_A_STATE = {name: value for name, value in DEFAULTS.items() if name != "load"}

# Inputs of which one follows from the other.
EXCLUSIVE = (
    ("energy", "energy_ratio", "speed"),
    ("surface_energy", "work_of_adhesion"),
    ("surface_energy2", "work_of_adhesion"),
    ("load", "approach_at_load", "load_factor"),
)
_MAY_CONTRADICT = frozenset(name for names in EXCLUSIVE for name in names)


class Scene:
    """Two spheres, as far as they were described, and everything that follows.

    >>> scene = Scene({"surface_energy": 0.025, "radius": 1e-7})
    >>> f"{scene['pull_off_force']:.4e}"
    '1.1781e-08'
    """

    def __init__(
        self, given: Mapping[str, Any], material: Material | None = None, material2: Material | None = None
    ) -> None:
        """Take SI values by name, over those of the materials of sphere 1 and, if it has one of its own, of sphere 2."""
        for names in () if _MAY_CONTRADICT.isdisjoint(given) else EXCLUSIVE:
            if len(both := [name for name in names if name in given]) > 1:
                raise Contradiction(both)
        for name, value in given.items():
            check_range(name, value)
        self.material, self.material2 = material, material2
        own = dict(material.properties) if material is not None else {}
        own2 = {name + "2": value for name, value in material2.properties.items()} if material2 is not None else {}
        self.stated = dict(given)
        self.given = {**own, **own2, **given}
        self.values = {**_assumed(self.given), **_implied(self.given), **self.given}
        self._known = frozenset(self.values)

    @property
    def is_identical(self) -> bool:
        """Whether nothing was said that makes sphere 2 differ from sphere 1."""
        own = {name.removesuffix("2"): value for name, value in self.given.items() if name.endswith("2")}
        lacking = self.material2 is not None and any(name in self.given and name not in own for name in PROPERTIES)
        return not lacking and all(
            value is self.given.get(name) or value == self.given.get(name) for name, value in own.items()
        )

    def data_used(self, inputs: Collection[str]) -> list[tuple[Material, str]]:
        """The materials and those of their properties that are among the inputs and were not stated otherwise."""
        spheres = ((self.material, ""), (self.material2, "2"))
        return [
            (material, name)
            for material, suffix in spheres
            if material is not None
            for name in material.properties
            if name + suffix in inputs and name + suffix not in self.stated
        ]

    def plan(self, *wanted: str) -> Plan:
        """The formulas that lead to the wanted quantities; MissingInput if the scene does not allow one."""
        try:
            return plan(wanted, self._known, self.material2 is not None)
        except MissingInput as error:
            raise MissingInput(error.wanted, error.missing, error.instead, self._lacking(error.missing)) from None

    def _lacking(self, missing: Iterable[str]) -> str:
        """Which materials should have had the missing properties and do not."""
        materials = {True: self.material2 or self.material, False: self.material}
        without = [materials[name.endswith("2")] for name in missing if name.removesuffix("2") in PROPERTIES]
        return ", ".join(
            dict.fromkeys(f"{material.name} has none in {material.title}" for material in without if material)
        )

    def inputs_of(self, *wanted: str) -> tuple[str, ...]:
        """The inputs that the wanted quantities depend on, in the order of the nomenclature."""
        return self.plan(*wanted).stated

    def __getitem__(self, name: str) -> Any:
        """The value of a quantity. Raises MissingInput, or NoResult where the physics has no answer."""
        plan, values = self.plan(name), self.values
        found = plan.found[name]
        if found not in values and self._is_extreme:
            self._widely(plan)
        for step in plan.steps:
            if step.name not in values:
                values[step.name] = _checked(step.name, self._run(step, values))
        return values[found] if found in self._known else _checked(found, values[found])

    @cached_property
    def _is_extreme(self) -> bool:
        """Whether all inputs are numbers, and one of them so large or small that formulas might leave the doubles."""
        if any(not isinstance(value, float) for value in self.values.values()):
            return False
        return is_extreme(self.values, self._known)

    def _widely(self, plan: Plan) -> None:
        """Run the formulas with numbers of any magnitude, so that only what a user sees need be a double."""
        from ..physics.wide import Wide

        wide: dict[str, Any] = {name: Wide(self.values[name]) for name in plan.inputs}
        for step in plan.steps:
            wide[step.name] = Wide.of(self._run(step, wide))
            value = float(wide[step.name])
            self.values[step.name] = value or (_UNDERFLOW if wide[step.name] else 0.0)

    def _run(self, step: Step, values: Mapping[str, Any]) -> Any:
        """The result of a formula."""
        arguments = {parameter: values[name] for parameter, name in step.arguments}
        guard = _GUARDS.get(step.name)
        if guard is not None:
            guard(**{parameter: self.values[name] for parameter, name in step.arguments})
        try:
            return step.formula(**arguments)
        except (OverflowError, ZeroDivisionError, ValueError):
            return INFINITY


# Products as high as w⁵R⁴/E² and ρR⁵ occur on the way; from such inputs within these limits, they are doubles.
_EXTREMES = frozenset(
    (
        "radius",
        "surface_energy",
        "youngs_modulus",
        "density",
        "radius2",
        "surface_energy2",
        "youngs_modulus2",
        "density2",
    )
) | {"work_of_adhesion", "reduced_radius", "contact_modulus", "yield_displacement", "gravity", "speed"}
_SMALL, _LARGE = 2.0**-90, 2.0**90


def is_extreme(values: Mapping[str, Any], names: Collection[str]) -> bool:
    """Whether an input among these, or an element of one, is so large or small that formulas might leave the doubles."""
    return not all(_is_ordinary(values[name]) for name in _EXTREMES.intersection(names))


def _is_ordinary(value: Any) -> bool:
    """Whether formulas cannot leave the doubles because of an input, or of an array of them."""
    if isinstance(value, float):
        return _SMALL < value < _LARGE or value == INFINITY
    import numpy

    if value.size and value.min() > _SMALL and value.max() < _LARGE:
        return True
    return bool(((value > _SMALL) & ((value < _LARGE) | numpy.isinf(value))).all())


def _checked(name: str, value: Any) -> Any:
    """A value, unless it is a number that is no answer: NoFiniteValue."""
    if isinstance(value, float) and not is_plausible(name, value):
        raise NoFiniteValue(name, value)
    return value


def check_range(name: str, value: Any) -> None:
    """Refuse a number that the quantity cannot have: OutOfRange."""
    quantity = NOMENCLATURE.get(name)
    if quantity is None:
        raise UnknownQuantity(name)
    limits = RANGES.get(quantity.range)
    if limits is None:
        return
    if isinstance(value, (float, int)):
        if not limits.admits(value):
            raise OutOfRange(name, value, limits.words)
        return
    import numpy

    array = numpy.asarray(value)
    above = array >= limits.low if limits.low_allowed else array > limits.low
    below = array <= limits.high if limits.high_allowed else array < limits.high
    if not (above & below).all():
        raise OutOfRange(name, array[~(above & below)].flat[0].item(), limits.words)


def is_plausible(name: str, value: float) -> bool:
    """Whether a result is one that doubles hold with all digits, or the zero that it may be."""
    if value == 0:
        return name in MAY_BE_ZERO
    return SMALLEST <= abs(value) < INFINITY


_UNDERFLOW = 5e-324  # in place of what is smaller, and like it no answer
SMALLEST = 2.2250738585072014e-308  # of the doubles that have all their digits
MAY_BE_ZERO = frozenset(
    {
        "load_margin",
        "load_margin_of_factor",
        "load_at_factor",
        "load_over_pull_off",
        "stiffness",
        "vertical_frequency",
        "approach_at_load",
        "radius_ratio",
        "load_factor_at_approach_unstable",
    }
)  # at P = 0, at P = -P_c, or at P = -(8/9)P_c


def _assumed(given: Mapping[str, Any]) -> Mapping[str, float]:
    """The defaults, without a load where something else says in which state the contact is."""
    return DEFAULTS if STATE.isdisjoint(given) else _DEFAULTS_OF_A_STATE


def _implied(given: Mapping[str, Any]) -> dict[str, Any]:
    """What follows from what was not said, or from a plane: values that then need nothing else."""
    implied: dict[str, Any] = {}
    if "radius2" not in given:
        implied["radius_ratio"] = 1.0
    elif isinstance(given["radius2"], float) and given["radius2"] == INFINITY:
        implied |= {"radius_ratio": 0.0, "mass2": INFINITY, "moment_of_inertia2": INFINITY}
    load = given.get("load", 0.0)
    if isinstance(load, (float, int)) and load == 0 and STATE.isdisjoint(given):
        implied["load_margin"] = 1.0
    return implied


def _guard_load_margin(*, load: Any, pull_off_force: Any) -> None:
    if isinstance(load, (float, int)) and isinstance(pull_off_force, float) and load < -pull_off_force:
        raise BeyondPullOff(load, pull_off_force)


def _guard_contact_modulus(
    *, youngs_modulus: Any, poisson_ratio: Any, youngs_modulus2: Any, poisson_ratio2: Any
) -> None:
    def rigid(modulus: Any, ratio: Any) -> bool:
        return any(isinstance(value, float) and value == limit for value, limit in ((modulus, INFINITY), (ratio, -1)))

    if rigid(youngs_modulus, poisson_ratio) and rigid(youngs_modulus2, poisson_ratio2):
        raise TwoRigidBodies


def _guard_fold(*, approach_at_load: Any, approach: Any) -> None:
    if (
        isinstance(approach_at_load, float)
        and isinstance(approach, float)
        and approach_at_load < FOLD_APPROACH * approach
    ):
        raise BeyondFold(approach_at_load, FOLD_APPROACH * approach)


def _guard_vertical_frequency(*, stiffness: Any, **_: Any) -> None:
    if isinstance(stiffness, float) and stiffness < 0:
        raise NoVibration


def _guard_r_min(*, radius2: Any, **_: Any) -> None:
    if isinstance(radius2, float) and radius2 == INFINITY:
        raise NoChain


_GUARDS: Mapping[str, Callable[..., None]] = {
    "load_margin": _guard_load_margin,
    "contact_modulus": _guard_contact_modulus,
    "r_min": _guard_r_min,
    "vertical_frequency": _guard_vertical_frequency,
    "load_factor_at_approach": _guard_fold,
}
