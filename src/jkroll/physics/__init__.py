"""The formulas of Dominik & Tielens: plain functions of SI numbers, floats or arrays.

A formula's name and its parameters' names are names of the nomenclature: that is all the wiring there is. Parameters
are passed by name, because three radii, two energies per area (γ and w = 2γ) and five forces are easily exchanged.
"""

from collections.abc import Callable, Mapping
from typing import Any

from . import chain, collision, contact, conventions, jkr, moment_models, pair, pressure, rolling, validity, vibration

FORMULAS: Mapping[str, Callable[..., Any]] = {
    name: function
    for module in (
        pair,
        contact,
        pressure,
        jkr,
        rolling,
        moment_models,
        chain,
        vibration,
        collision,
        conventions,
        validity,
    )
    for name, function in vars(module).items()
    if getattr(function, "__module__", None) == module.__name__ and not name.startswith("_")
}
