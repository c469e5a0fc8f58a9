"""From what is given to what is asked: a scene evaluates the formulas that its questions need, and says what is missing.

The assumptions of a scene are stated here, once: sphere 2 is like sphere 1 in everything that is not said of it, and the
names in DEFAULTS have values if nothing else is said.
"""

from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import reduce
from operator import and_
from typing import TYPE_CHECKING, Any

from ..errors import JkrollError
from ..materials.library import Material
from ..quantities.laws import DEFAULT_LAW, Law, law_named
from ..quantities.nomenclature import INFINITY, PROPERTIES, STATE
from ..quantities.parsing import is_uncertain
from .errors import Contradiction, MissingInput, NoFiniteValue, NotInLaw, TwoRigidBodies
from .failures import failure_of
from .inputs import is_ordinary
from .results import SMALLEST, is_zero, with_nan
from .wiring import NO_PLAN, Missing, Plan, Step, in_order, plan

if TYPE_CHECKING:
    from ..quantities.uncertain import Uncertain

DEFAULTS = {
    "yield_displacement": 2e-10,
    "load": 0.0,
    "gravity": 9.80665,
    "energy_ratio": 1.0,
    "atomic_spacing": 4e-10,
}
_SAYS = {"load": STATE, "yield_displacement": ("adhesion_hysteresis",)}  # what says the same as a default

# The values of inputs from which more follows than from others: a plane, a rigid body, no load.
FOLLOWS: Mapping[str, tuple[float, Mapping[str, float]]] = {
    "radius2": (INFINITY, {"radius_ratio": 0.0, "mass2": INFINITY, "moment_of_inertia2": INFINITY}),
    "youngs_modulus": (INFINITY, {"poisson_ratio": 0.0}),  # without strain, it does not matter
    "youngs_modulus2": (INFINITY, {"poisson_ratio2": 0.0}),
    "load": (0.0, {"load_margin": 1.0}),
}

# Inputs of which one follows from the other.
EXCLUSIVE = (
    ("energy", "energy_ratio", "speed"),
    ("surface_energy", "work_of_adhesion"),
    ("surface_energy2", "work_of_adhesion"),
    ("load", "approach_at_load", "load_factor", "edge_ratio"),
    ("yield_displacement", "adhesion_hysteresis"),
    ("contact_modulus", "modulus_over_energy"),
)
_MAY_CONTRADICT = frozenset(name for names in EXCLUSIVE for name in names)

# What rests on a contact area, and has none where both bodies are rigid; everything else of JKR follows from these.
_OF_JKR = ("contact_modulus", "pull_off_force", "load_factor", "rolling_frequency_as_printed")


class Scene:
    """Two spheres, as far as they were described, and everything that follows.

    >>> scene = Scene({"surface_energy": 0.025, "radius": 1e-7})
    >>> f"{scene['pull_off_force']:.4e}"
    '1.1781e-08'
    >>> scene.replace(radius=2e-7)["reduced_radius"]
    1e-07
    """

    def __init__(
        self,
        given: Mapping[str, Any],
        material: Material | None = None,
        material2: Material | None = None,
        *,
        model: str | None = None,
    ) -> None:
        """Take SI values by name, over those of the materials of sphere 1 and, if it has one of its own, of sphere 2.

        `model` is the law of attraction; None stands for the paper's, JKR. The scene computes with the middle of a value that
        has an uncertainty; `scene.uncertainty` computes with the rest.
        """
        self.stated_model = model
        self.law = law_named(DEFAULT_LAW if model is None else model)
        for names in () if _MAY_CONTRADICT.isdisjoint(given) else EXCLUSIVE:
            if len(both := [name for name in names if name in given]) > 1:
                raise Contradiction(both)
        self.material, self.material2 = material, material2
        self.uncertain: dict[str, Uncertain] = {name: one for name, one in given.items() if is_uncertain(one)}
        own = dict(material.properties) if material is not None else {}
        own2 = {name + "2": value for name, value in material2.properties.items()} if material2 is not None else {}
        self.stated = {**given, **{name: one.value for name, one in self.uncertain.items()}}
        self.given = {**own, **own2, **self.stated}
        checked = [is_ordinary(name, value) for name, value in self.given.items()]
        self._is_ordinary = all(checked)
        self.values = _assumed(self.given)
        self._implied = _implied(self.given, self.law)
        for values in self._implied.values():
            self.values |= values
        self.values |= self.given
        self._rigid = _both_rigid(self.given, own_material2=material2 is not None)
        is_rigid = isinstance(self._rigid, bool) and self._rigid
        self._failures: dict[str, JkrollError] = dict.fromkeys(_OF_JKR, TwoRigidBodies()) if is_rigid else {}
        self._plan = NO_PLAN
        self.known = frozenset(self.values)

    def replace(self, **values: Any) -> "Scene":
        """Return the scene in which some inputs have other values, of the same materials and without uncertainties."""
        return Scene({**self.stated, **values}, self.material, self.material2, model=self.stated_model)

    def under(self, model: str) -> "Scene":
        """Return the scene under another law of attraction, without uncertainties."""
        return Scene(self.stated, self.material, self.material2, model=model)

    @property
    def is_uncertain(self) -> bool:
        """True if an input, or a property of a material, has an uncertainty."""
        materials = (self.material, self.material2)
        return bool(self.uncertain) or any(one.uncertainties for one in materials if one is not None)

    def uncertainty_of(self, name: str) -> "Uncertain | None":
        """Return the uncertainty of an input, whether it was stated or is that of a material; None if it has none."""
        for material, of_material in self.data_used([name]):
            if name in (of_material, of_material + "2") and of_material in material.uncertainties:
                return material.uncertainties[of_material]
        return self.uncertain.get(name)

    @property
    def is_identical(self) -> Any:
        """True if nothing was said that makes sphere 2 differ from sphere 1, element by element for arrays."""
        own = {name.removesuffix("2"): value for name, value in self.given.items() if name.endswith("2")}
        lacking = self.material2 is not None and any(name in self.given and name not in own for name in PROPERTIES)
        return reduce(and_, (value == self.given.get(name) for name, value in own.items()), not lacking)

    def data_used(self, inputs: Collection[str]) -> list[tuple[Material, str]]:
        """Return the materials and those of their properties that are among the inputs and were not stated otherwise."""
        spheres = ((self.material, ""), (self.material2, "2"))
        return [
            (material, name)
            for material, suffix in spheres
            if material is not None
            for name in material.properties
            if name + suffix in inputs and name + suffix not in self.stated
        ]

    # --- Plans --------------------------------------------------------------------------------------------------------

    def plan(self, *wanted: str) -> Plan:
        """Return the formulas that lead to the wanted quantities; raise MissingInput if the scene does not allow one."""
        found = self._planned(wanted).part(wanted)
        for name, missing in found.missing.items():
            raise self._missing_input(name, missing)
        return found

    def _planned(self, wanted: Sequence[str]) -> Plan:
        """Return the plan of this scene, which grows by these quantities if it does not have them."""
        if not self._plan.knows(wanted):
            names = (*self._plan.found, *self._plan.missing, *wanted)
            self._plan = plan(names, self.known, self.material2 is not None, self.law.name)
        return self._plan

    def inputs_of(self, *wanted: str) -> tuple[str, ...]:
        """Return the inputs that the wanted quantities depend on, in the order of the nomenclature."""
        source_of = {
            name: source for source, values in self._implied.items() for name in values.keys() - self.given.keys()
        }
        used = {source_of.get(name, name) for name in self.plan(*wanted).inputs}
        return in_order(used & (self.given.keys() | DEFAULTS.keys()))

    def _missing_input(self, name: str, missing: Missing) -> MissingInput:
        """Return the error of a quantity that needs more inputs, with the materials that should have had them."""
        if missing.lacking:
            return NotInLaw(name, missing.lacking, self.law.title)
        materials = {True: self.material2 or self.material, False: self.material}
        without = [materials[each.endswith("2")] for each in missing.names if each.removesuffix("2") in PROPERTIES]
        lacking = dict.fromkeys(f"{material.name} has none in {material.title}" for material in without if material)
        return MissingInput(name, missing.names, missing.instead, ", ".join(lacking))

    # --- Values -------------------------------------------------------------------------------------------------------

    def __getitem__(self, name: str) -> Any:
        """Return the value of a quantity. Raises MissingInput, or NoResult where the physics has no answer."""
        value = self.evaluate((name,))[name]
        if isinstance(value, JkrollError):
            raise value
        return value

    def evaluate(self, names: Sequence[str]) -> dict[str, Any]:
        """Return the value of each quantity, or the MissingInput or NoResult that says why there is none.

        One plan leads to all of them, and serves every later question about some of them. An element of an array that
        has no answer is nan.
        """
        found = self._planned(names)
        steps: Iterable[Step] = found.steps
        if not self._is_ordinary:
            from .watched import watched

            steps = [step._replace(formula=watched(step.formula)) for step in steps]
        if self.has_rigid_elements:
            steps = [self._without_rigid(step) if step.name in _OF_JKR else step for step in steps]
        self._run(steps)
        return {name: self._outcome(name, found) for name in names}

    def numbers(self, *names: str) -> dict[str, Any]:
        """Return the values of quantities, without those that have none."""
        return {name: value for name, value in self.evaluate(names).items() if not isinstance(value, JkrollError)}

    @property
    def has_rigid_elements(self) -> bool:
        """True if both bodies are rigid in some elements of the arrays that were given."""
        return not isinstance(self._rigid, bool) and bool(self._rigid.any())

    def _without_rigid(self, step: Step) -> Step:
        """Return a step whose results are nan where both bodies are rigid."""
        import numpy

        return step._replace(formula=lambda **given: numpy.where(self._rigid, numpy.nan, step.formula(**given)))

    def _run(self, steps: Iterable[Step]) -> None:
        """Evaluate formulas one after the other, and note those that fail."""
        values, failures = self.values, self._failures
        for name, formula, arguments in steps:
            if name in values or name in failures:
                continue
            try:
                value = formula(**{parameter: values[source] for parameter, source in arguments})
            except KeyError:  # an argument that failed
                failures[name] = next(failures[source] for _, source in arguments if source in failures)
                continue
            except (ArithmeticError, ValueError):
                value = INFINITY
            if isinstance(value, float) and not SMALLEST <= abs(value) < INFINITY and not is_zero(name, value):
                given = {parameter: values[source] for parameter, source in arguments}
                failures[name] = failure_of(name, given) or NoFiniteValue(name, value)
            else:
                values[name] = value

    def _outcome(self, name: str, found: Plan) -> Any:
        """Return what became of a quantity once the steps of its plan were run."""
        if name in found.missing:
            return self._missing_input(name, found.missing[name])
        source = found.found[name]
        if source in self._failures:
            return self._failures[source]
        value = self.values[source]
        return value if isinstance(value, float | int) or source in self.known else with_nan(source, value)


def _assumed(given: Mapping[str, Any]) -> dict[str, Any]:
    """Return the defaults of what nothing else says."""
    return {name: value for name, value in DEFAULTS.items() if given.keys().isdisjoint(_SAYS.get(name, ()))}


def _both_rigid(given: Mapping[str, Any], *, own_material2: bool) -> Any:
    """Return whether both bodies were given as rigid, element by element for arrays."""
    if "contact_modulus" in given:
        return False
    modulus, ratio = given.get("youngs_modulus"), given.get("poisson_ratio")
    of_sphere_2 = (None, None) if own_material2 else (modulus, ratio)
    modulus2 = given.get("youngs_modulus2", of_sphere_2[0])
    ratio2 = given.get("poisson_ratio2", of_sphere_2[1])
    return ((modulus == INFINITY) | (ratio == -1)) & ((modulus2 == INFINITY) | (ratio2 == -1))


def _implied(given: Mapping[str, Any], law: Law) -> dict[str, Mapping[str, float]]:
    """Return by each input the values that follow from it, or from its absence, and then need nothing else."""
    known = {**DEFAULTS, **given}
    implied = {name: follows for name, (value, follows) in FOLLOWS.items() if _is_number(known.get(name), value)}
    if "radius2" not in given:
        implied["radius2"] = {"radius_ratio": 1.0}
    if "poisson_ratio2" not in given:
        implied.pop("youngs_modulus", None)  # sphere 2, which yields, would take the ratio over
    if not STATE.isdisjoint(given) or not law.has("load_margin"):
        implied.pop("load", None)
    return implied


def _is_number(value: Any, number: float) -> bool:
    """Return whether a value is this number; an array is none."""
    return isinstance(value, float | int) and value == number
