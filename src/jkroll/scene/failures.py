"""The numbers for which the physics gives a formula no result, with the error that says why."""

from collections.abc import Mapping
from typing import Any

from ..errors import NoResult
from ..physics.contact import pull_off_force_dmt
from ..physics.jkr import FOLD_APPROACH
from ..physics.maugis_states import fold_approach_maugis, pull_off_force_maugis
from ..quantities.nomenclature import INFINITY
from .errors import BeyondFold, BeyondPullOff, NoChain, NoUnstableState, NoVibration, TooMuchHysteresis
from .wiring import parameters_of


def failure_of(name: str, given: Mapping[str, Any]) -> NoResult | None:
    """Return why a formula has no result for these numbers, if the physics forbids it."""
    found: NoResult | None = None
    match name:
        case "load_margin":
            found = _beyond_pull_off(given, given["pull_off_force"])
        case "edge_ratio_at_load":
            found = _beyond_pull_off(given, _evaluated(pull_off_force_maugis, given))
        case "contact_radius_dmt" | "adhesive_force_dmt":
            found = _beyond_pull_off(given, _evaluated(pull_off_force_dmt, given))
        case "load_factor_at_approach" | "load_margin_at_approach":
            found = _beyond_fold(given, FOLD_APPROACH * given["approach"])
        case "edge_ratio_at_approach":
            found = _beyond_fold(given, _evaluated(fold_approach_maugis, given))
        case "contact_radius_dmt_at_approach":
            found = _beyond_fold(given, 0.0)
        case "load_factor_at_load_unstable" if given["load"] > 0:
            found = NoUnstableState(name)
        case "load_factor_at_approach_unstable" if given["approach_at_load"] > 0:
            found = NoUnstableState(name)
        case "load_factor_at_approach_unstable":
            found = _beyond_fold(given, FOLD_APPROACH * given["approach"])
        case "r_min" if given["radius2"] == INFINITY:
            found = NoChain()
        case "vertical_frequency" if given["stiffness"] < 0:
            found = NoVibration()
        case "yield_displacement_at_hysteresis" if given["adhesion_hysteresis"] > given["work_of_adhesion"]:
            found = TooMuchHysteresis(given["adhesion_hysteresis"], given["work_of_adhesion"])
    return found


def _beyond_pull_off(given: Mapping[str, Any], force: float) -> BeyondPullOff | None:
    """Return the error of a tension larger than a pull-off force, if the load is one."""
    return BeyondPullOff(given["load"], force) if given["load"] < -force else None


def _beyond_fold(given: Mapping[str, Any], least: float) -> BeyondFold | None:
    """Return the error of an approach at which fixed grips let go, if the approach is one."""
    return BeyondFold(given["approach_at_load"], least) if given["approach_at_load"] <= least else None


def _evaluated(formula: Any, given: Mapping[str, Any]) -> Any:
    """Return the result of a formula whose arguments are among those of another."""
    return formula(**{name: given[name] for name in parameters_of(formula)})
