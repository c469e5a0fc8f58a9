"""The formulas that lead to a quantity, in their order: a formula's parameters name what it needs.

Where a quantity can be had by several formulas, the law of attraction and what is given decide (`laws`).

What belongs to sphere 2 (`mass2`) comes from the same formula as for sphere 1 (`mass`), and an input of sphere 2 that
was not given is that of sphere 1, unless sphere 2 has a material of its own that should have had it.
"""

from collections.abc import Callable, Collection, Iterable, Mapping
from functools import cache
from typing import Any, NamedTuple

from ..physics import FORMULAS
from ..quantities.errors import UnknownQuantity
from ..quantities.laws import DEFAULT_LAW, Routes, law_of, routes, routes_anywhere
from ..quantities.nomenclature import NOMENCLATURE, OF_THE_PAIR, of_sphere

# What another material of sphere 2 does not take over from sphere 1: all that each sphere has, but for the radius.
OF_A_SOLID = frozenset(name for name, quantity in NOMENCLATURE.items() if quantity.sphere == 1 and quantity.option)


class Step(NamedTuple):
    """One formula to run: the name of its result, the formula, and the names of its arguments."""

    name: str
    formula: Any
    arguments: tuple[tuple[str, str], ...]  # (parameter, name of the value)


class _Path:
    """The way to one quantity: the steps so far, and what is missing for it."""

    def __init__(
        self, known: frozenset[str], own_material2: bool, by_law: Routes, model: str, steps: dict[str, Step]
    ) -> None:
        self.known, self.own_material2, self.by_law, self.model, self.steps = known, own_material2, by_law, model, steps
        self.inputs: set[str] = set()
        self.missing: list[str] = []
        self.instead: list[str] = []
        self.lacking: list[str] = []

    def visit(self, wanted: str) -> str:
        """Add the steps that lead to a quantity, and return the name under which its value is known."""
        name = self._source(wanted)
        if name is None or (name not in self.known and _mixes_laws(name, self.model, self.known)):
            self.lacking.append(wanted)
            return wanted
        if name in self.known:
            self.inputs.add(name)
        elif name not in NOMENCLATURE or NOMENCLATURE[name].is_word:
            raise UnknownQuantity(name)
        elif name in self.steps:
            return name
        elif formula_of(name) is None:
            self.missing.append(name)
        else:
            return self._add(name, wanted)
        return name

    def _add(self, name: str, wanted: str) -> str:
        """Add the formula of a quantity after those of its arguments."""
        before = len(self.missing)
        arguments = tuple((parameter, self.visit(argument)) for parameter, argument in arguments_of(name))
        if NOMENCLATURE[name].sphere == 2 and not any(NOMENCLATURE[source].sphere == 2 for _, source in arguments):
            return self.visit(of_sphere(1, name))  # in this, sphere 2 is like sphere 1
        if len(self.missing) > before and NOMENCLATURE[wanted].option and wanted not in OF_THE_PAIR:
            self.instead.append(wanted)
        self.steps.setdefault(name, Step(name, formula_of(name), arguments))
        return name

    def _source(self, name: str) -> str | None:
        """Return the name under which a value is known or computed; None for what the law does not have."""
        if name in self.known:
            return name
        if name in self.by_law:
            return self.by_law[name]
        of_1 = of_sphere(1, name)
        has_own = formula_of(name) is not None or (self.own_material2 and of_1 in OF_A_SOLID)
        return name if has_own else of_1


class Missing(NamedTuple):
    """The inputs that a quantity needs, in the nomenclature's order."""

    names: tuple[str, ...]
    instead: tuple[str, ...]  # quantities that may be given in place of them
    lacking: tuple[str, ...]  # quantities that the law of attraction does not have


class Plan(NamedTuple):
    """The steps that lead to the wanted quantities, and the inputs they start from, in the nomenclature's order."""

    steps: tuple[Step, ...]
    inputs: tuple[str, ...]
    sources: Mapping[str, str]  # wanted name → the name under which its value is known
    missing: Mapping[str, Missing]  # the wanted names to which no formulas lead
    taken: frozenset[str] = frozenset()  # the parameters of all formulas


@cache
def plan_for(wanted: tuple[str, ...], known: frozenset[str], own_material2: bool, model: str = DEFAULT_LAW) -> Plan:
    """Order the formulas of a law so that each runs after those whose results it takes."""
    by_law = routes(model, known)
    steps: dict[str, Step] = {}
    inputs: set[str] = set()
    sources: dict[str, str] = {}
    missing: dict[str, Missing] = {}
    for name in wanted:
        path = _Path(known, own_material2, by_law, model, dict(steps))
        source = path.visit(name)
        if path.missing or path.lacking:
            missing[name] = Missing(*map(in_order, (path.missing, path.instead, path.lacking)))
        else:
            sources[name] = source
            steps = path.steps
            inputs |= path.inputs
    taken = frozenset(parameter for step in steps.values() for parameter, _ in step.arguments)
    return Plan(tuple(steps.values()), in_order(inputs), sources, missing, taken)


@cache
def _mixes_laws(name: str, model: str, known: frozenset[str]) -> bool:
    """Return whether another law's formula would take what these two have by different ones: a contact of neither."""
    owner = law_of(name)
    if owner is None or owner == model:
        return False
    ours, theirs = routes(model, known), routes(owner, known)
    taken = _reached(parameters_of(formula_of(name)), lambda each: () if each in known else (theirs.get(each, each),))
    return any(ours.get(each, each) != theirs.get(each, each) for each in taken - known)


@cache
def formula_of(name: str) -> Any:
    """Return the formula of a quantity, which for sphere 2 is that of sphere 1; None for an input."""
    return FORMULAS.get(of_sphere(1, name))


@cache
def arguments_of(name: str) -> tuple[tuple[str, str], ...]:
    """Return the parameters of a quantity's formula, each with the name of its value.

    This is the value of sphere 2 for a quantity of sphere 2.
    """
    parameters, is_of_2 = parameters_of(formula_of(name)), NOMENCLATURE[name].sphere == 2
    return tuple((parameter, of_sphere(2, parameter) if is_of_2 else parameter) for parameter in parameters)


def in_order(names: Collection[str]) -> tuple[str, ...]:
    """Return names in the order of the nomenclature."""
    return tuple(name for name in NOMENCLATURE if name in names)


def depends_on(names: Iterable[str], models: Collection[str] = (DEFAULT_LAW,)) -> frozenset[str]:
    """Return every name on which quantities can depend under some laws, whatever is given."""
    return _dependence(tuple(names), tuple(models))


@cache
def _dependence(names: tuple[str, ...], models: tuple[str, ...]) -> frozenset[str]:
    routes_to = routes_anywhere(models)
    return _reached(names, lambda name: (name, *routes_to.get(name, ())))


def _reached(names: Iterable[str], formulas: Callable[[str], Iterable[str | None]]) -> frozenset[str]:
    """Return names, and all that their formulas take, and the formulas of these; `formulas`: those of a name."""
    reached: set[str] = set()
    pending = [*names]
    while pending:
        name = pending.pop()
        if name not in reached:
            reached.add(name)
            known = (formula for formula in formulas(name) if formula is not None and formula_of(formula) is not None)
            pending += [argument for formula in known for _, argument in arguments_of(formula)]
    return frozenset(reached)


def parameters_of(formula: Any) -> tuple[str, ...]:
    """Return the names of a formula's parameters."""
    code = getattr(formula, "__wrapped__", formula).__code__
    return tuple(code.co_varnames[: code.co_argcount + code.co_kwonlyargcount])
