"""Plans: the formulas needed for a quantity, in order of evaluation. A formula's parameters name its inputs.

If several formulas give a quantity, the law of attraction and the given inputs decide (see `quantities.laws`).

A quantity of sphere 2 (`mass2`) has the same formula as for sphere 1 (`mass`). An input of sphere 2 that is not given
equals that of sphere 1. If sphere 2 has its own material, this material should provide the inputs in `OF_A_SOLID`.
"""

from collections.abc import Collection, Mapping
from functools import cache, lru_cache
from types import MappingProxyType
from typing import Any

from ..physics import FORMULAS
from ..quantities.laws import DEFAULT_LAW, Routes, law_of, routes, routes_anywhere
from ..quantities.nomenclature import CONVERTED, NOMENCLATURE, UnknownQuantity, computed_as, of_sphere

# Every input that each sphere has, except the radius. A sphere 2 of another material takes none of them from sphere 1.
OF_A_SOLID = frozenset(
    name
    for name, quantity in NOMENCLATURE.items()
    if quantity.sphere == 1 and quantity.option and computed_as(name) != "radius"
)
_POSITIONS = {name: position for position, name in enumerate(NOMENCLATURE)}
KEPT = 5_000  # plans kept in memory; a set of inputs has a few hundred


class Plan:
    """A quantity's formula with the names of its arguments; without a formula, a value that is known or missing."""

    def __init__(
        self,
        name: str,  # the name of the value
        formula: Any = None,
        plans: Mapping[str, "Plan"] = MappingProxyType({}),  # of the arguments, by parameter
        missing: frozenset[str] = frozenset(),  # inputs that are not known
        lacking: frozenset[str] = frozenset(),  # quantities that the law of attraction does not have
    ) -> None:
        self.name, self.formula = name, formula
        self.plans = [*plans.values()]  # of its arguments
        self.arguments = {parameter: plan.name for parameter, plan in plans.items()}
        self.missing, self.lacking = missing, lacking
        self.steps: dict[str, Plan] = {}  # all intermediate values in order of evaluation, this one last
        for plan in plans.values():
            self.missing |= plan.missing
            self.lacking |= plan.lacking
            self.steps |= plan.steps
        self.steps[name] = self
        self.is_possible = not (self.missing or self.lacking)  # the known values determine the quantity


@lru_cache(maxsize=KEPT)
def plan_for(wanted: str, known: frozenset[str], own_material2: bool, model: str = DEFAULT_LAW) -> Plan:
    """Return the plan of a quantity under a law of attraction, for the names of the known values.

    Raises UnknownQuantity for a name outside the nomenclature, and for one whose values are words (`material`).
    """
    name = _source(wanted, known, own_material2, routes(model, known))
    if name is not None and name in known:
        return Plan(name)
    if name is None or _mixes_laws(name, known, own_material2, model):
        return Plan(wanted, lacking=frozenset({wanted}))
    if name not in NOMENCLATURE or NOMENCLATURE[name].is_word:
        raise UnknownQuantity(name)
    if formula_of(name) is None:
        return Plan(name, missing=frozenset({name}))
    plans = {parameter: plan_for(argument, known, own_material2, model) for parameter, argument in arguments_of(name)}
    if NOMENCLATURE[name].sphere == 2 and not any(NOMENCLATURE[plan.name].sphere == 2 for plan in plans.values()):
        return plan_for(of_sphere(1, name), known, own_material2, model)  # here sphere 2 is like sphere 1
    return Plan(name, formula_of(name), plans)


@lru_cache(maxsize=KEPT)
def taken_by(names: tuple[str, ...], *plan_key: Any) -> frozenset[str]:
    """Return these names, and those of all arguments in their plans; `plan_key`: further arguments of `plan_for`."""
    plans = [plan_for(name, *plan_key) for name in names]
    return frozenset(names).union(*(step.arguments for plan in plans for step in plan.steps.values()))


def _source(name: str, known: frozenset[str], own_material2: bool, by_law: Routes) -> str | None:
    """Return the name under which a value is known or computed; None if the law does not have it."""
    if name in known:
        return name
    if name in by_law:
        return by_law[name]
    of_first = of_sphere(1, name)
    has_own = formula_of(name) is not None or (own_material2 and of_first in OF_A_SOLID)
    return name if has_own else of_first


def _mixes_laws(name: str, known: frozenset[str], own_material2: bool, model: str) -> bool:
    """Return whether a formula of another law would use values that the two laws compute differently."""
    owner = law_of(name)
    if owner is None or owner == model:
        return False
    ours, theirs = routes(model, known), routes(owner, known)
    taken = taken_by((name,), known, own_material2, owner) - known
    return any(ours.get(argument, argument) != theirs.get(argument, argument) for argument in taken)


@cache
def formula_of(name: str) -> Any:
    """Return the formula of a quantity, for sphere 2 that of sphere 1; None for an input."""
    return FORMULAS.get(of_sphere(1, name))


@cache
def arguments_of(name: str) -> tuple[tuple[str, str], ...]:
    """Return the parameters of a quantity's formula, each with the name of its value.

    A quantity of sphere 2 takes the values of sphere 2.
    """
    parameters, is_of_2 = parameters_of(formula_of(name)), NOMENCLATURE[name].sphere == 2
    return tuple((parameter, of_sphere(2, parameter) if is_of_2 else parameter) for parameter in parameters)


def in_order(names: Collection[str]) -> tuple[str, ...]:
    """Return names in the order of the nomenclature."""
    return tuple(sorted(_POSITIONS.keys() & names, key=_POSITIONS.__getitem__))


@cache
def depends_on(names: tuple[str, ...], models: tuple[str, ...] = (DEFAULT_LAW,)) -> frozenset[str]:
    """Return these names, and every name on which they can depend under these laws, whatever the inputs.

    Inputs that are converted to one of these are included.
    """
    routes_to = routes_anywhere(models)
    reached: set[str] = set()
    pending = [*names]
    while pending:
        name = pending.pop()
        if name not in reached:
            reached.add(name)
            for source in (name, *routes_to.get(name, ())):
                if formula_of(source) is not None:
                    pending += [argument for _, argument in arguments_of(source)]
    return frozenset(reached).union(name for name, other in CONVERTED.items() if other in reached)


def parameters_of(formula: Any) -> tuple[str, ...]:
    """Return the names of a formula's parameters."""
    code = getattr(formula, "__wrapped__", formula).__code__
    return tuple(code.co_varnames[: code.co_argcount + code.co_kwonlyargcount])
