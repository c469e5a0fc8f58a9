"""The formulas of Dominik & Tielens, and those of other laws of attraction: plain functions of SI numbers, floats or arrays.

A formula's name and its parameters' names are names of the nomenclature: that is all the wiring there is. Parameters
are passed by name, because three radii, two energies per area (γ and w = 2γ) and five forces are easily exchanged.
"""

from collections.abc import Callable, Mapping
from typing import Any

from . import (
    adhesive_force,
    chain,
    collision,
    contact,
    conventions,
    dmt,
    jkr,
    jkr_to_dmt,
    maugis,
    maugis_contact,
    maugis_energies,
    maugis_states,
    moment_models,
    pair,
    pressure,
    rolling,
    validity,
    vibration,
)


def _formulas(*modules: Any) -> dict[str, Callable[..., Any]]:
    """Return the public functions of modules by name."""
    return {
        name: function
        for module in modules
        for name, function in vars(module).items()
        if getattr(function, "__module__", None) == module.__name__ and not name.startswith("_")
    }


PAPER_FORMULAS: Mapping[str, Callable[..., Any]] = _formulas(
    pair, contact, pressure, jkr, rolling, moment_models, chain, vibration, collision, conventions, validity
)
LAW_FORMULAS: Mapping[str, Callable[..., Any]] = _formulas(
    adhesive_force, dmt, jkr_to_dmt, maugis, maugis_contact, maugis_states, maugis_energies
)
FORMULAS: Mapping[str, Callable[..., Any]] = {**PAPER_FORMULAS, **LAW_FORMULAS}
