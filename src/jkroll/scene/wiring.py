"""Which formulas lead to a quantity, and in which order: a formula's parameters name what it needs.

What belongs to sphere 2 (`mass2`) comes from the same formula as for sphere 1 (`mass`), and an input of sphere 2 that was
not given is that of sphere 1, unless sphere 2 has a material of its own that should have had it.
"""

from collections.abc import Collection, Iterable, Mapping
from functools import cache
from typing import Any, NamedTuple

from ..physics import FORMULAS
from ..quantities.errors import UnknownQuantity
from ..quantities.nomenclature import NOMENCLATURE, PROPERTIES
from .errors import MissingInput

# Where a quantity can be had in another way: the names of which one is known, and the formula that then serves.
# The state of the contact follows from the load unless the approach, or x itself, is given.
STATE = frozenset({"approach_at_load", "load_factor"})
_ROUTES = {
    "load_margin": (STATE, "load_margin_of_factor"),
    "load": (STATE, "load_at_factor"),
    "load_factor": (frozenset({"approach_at_load"}), "load_factor_at_approach"),
    "energy": (frozenset({"speed"}), "kinetic_energy"),
}
# Where neither an energy nor a speed is given, its ratio to P_cδ0 serves.
_ENERGY = frozenset({"energy", "speed"})
_ROUTES_WITHOUT = {
    "energy": (_ENERGY, "energy_at_energy_ratio"),
    "n_roll": (_ENERGY, "n_roll_at_energy_ratio"),
    "n_roll_energy_balance": (_ENERGY, "n_roll_energy_balance_at_energy_ratio"),
}


class Step(NamedTuple):
    """One formula to run: the name of its result, the formula, and the names of its arguments."""

    name: str
    formula: Any
    arguments: tuple[tuple[str, str], ...]  # (parameter, name of the value)


# The input from which an implied value follows, to be echoed in its place.
_STATED_BY = {"load_margin": "load", "radius_ratio": "radius2", "mass2": "radius2", "moment_of_inertia2": "radius2"}


class Plan(NamedTuple):
    """The steps that lead to the wanted quantities, and the inputs they start from, in the order of the nomenclature."""

    steps: tuple[Step, ...]
    inputs: tuple[str, ...]
    stated: tuple[str, ...]  # the same as a user states them
    found: Mapping[str, str]  # wanted name → the name under which its value is known


@cache
def plan(wanted: tuple[str, ...], known: frozenset[str], own_material2: bool) -> Plan:
    """Order the formulas so that each runs after those whose results it takes."""
    steps: dict[str, Step] = {}
    inputs: set[str] = set()
    missing: list[str] = []
    instead: list[str] = []

    def source(name: str) -> str:
        """The name under which a value is known or computed."""
        base = name.removesuffix("2")
        if name in known:
            return name
        if name in _ROUTES and known & _ROUTES[name][0]:
            return _ROUTES[name][1]
        if name in _ROUTES_WITHOUT and not known & _ROUTES_WITHOUT[name][0]:
            return _ROUTES_WITHOUT[name][1]
        if base != name and base not in FORMULAS and not (own_material2 and base in PROPERTIES):
            return base
        return name

    def visit(asked: str) -> str:
        name = source(asked)
        if name in known:
            inputs.add(name)
        elif name not in steps:
            base = name if name in FORMULAS else name.removesuffix("2")
            if name not in NOMENCLATURE:
                raise UnknownQuantity(name)
            if base not in FORMULAS:
                missing.append(name)
                return name
            before = len(missing)
            suffix = name[len(base) :]
            arguments = tuple((parameter, visit(parameter + suffix)) for parameter in parameters_of(FORMULAS[base]))
            if suffix and not any(source.endswith("2") for _, source in arguments):
                return visit(base)  # in this, sphere 2 is sphere 1
            if len(missing) > before and (NOMENCLATURE[asked].option or asked in _ROUTES_WITHOUT):
                instead.append("energy" if asked in _ROUTES_WITHOUT else asked)
            steps.setdefault(name, Step(name, FORMULAS[base], arguments))
        return name

    found: dict[str, str] = {}
    for name in wanted:
        found[name] = visit(name)
        if missing:
            raise MissingInput(name, tuple(dict.fromkeys(missing)), tuple(dict.fromkeys(instead)))
    stated = {_STATED_BY.get(name, name) for name in inputs} & known
    return Plan(tuple(steps.values()), _in_order(inputs), _in_order(stated), found)


def _in_order(names: Collection[str]) -> tuple[str, ...]:
    """Names in the order of the nomenclature."""
    return tuple(name for name in NOMENCLATURE if name in names)


def depends_on(names: Iterable[str]) -> frozenset[str]:
    """Every name on which quantities can depend, whatever is given."""
    found: set[str] = set()
    pending = list(names)
    while pending:
        name = pending.pop()
        if name not in found:
            found.add(name)
            routes = [name, *(table[name][1] for table in (_ROUTES, _ROUTES_WITHOUT) if name in table)]
            for route in routes:
                base = route if route in FORMULAS else route.removesuffix("2")
                pending += (
                    [parameter + route[len(base) :] for parameter in parameters_of(FORMULAS[base])]
                    if base in FORMULAS
                    else []
                )
    return frozenset(found)


def parameters_of(formula: Any) -> tuple[str, ...]:
    """Names of a formula's parameters."""
    code = formula.__code__
    return tuple(code.co_varnames[: code.co_argcount + code.co_kwonlyargcount])
