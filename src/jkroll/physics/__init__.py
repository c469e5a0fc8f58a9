"""The formulas of Dominik & Tielens, and of other laws of attraction: plain functions of SI numbers, floats or arrays.

A formula's name and its parameters' names are names of the nomenclature, but for a few that only derivations use: that
is all the wiring there is. Parameters are passed by name, because three radii, two energies per area (γ and w = 2γ) and
five forces are easily exchanged.

A formula gives a float for floats, and an array for arrays, which broadcast. Its annotations have the units, by their
names in `dimensions`. Its arguments are positive, but for these, where its docstring does not say otherwise:

- loads and approaches have a sign, and tension is negative; so have pressures, positions and `load_constant`;
- `radius2` is infinite for a plane, Young's moduli are for a rigid body, `mass2` and `moment_of_inertia2` if held;
- `radius_ratio` is 0 on a plane, edge ratios and `contact_radius_at_load` are 0 without contact;
- `load_margin` is 0 at pull-off, and negative between pull-off and the fold;
- Poisson's ratios lie between −1 and 1/2, filling factors below 0.74.
"""

from collections.abc import Callable, Iterator, Mapping
from functools import cache
from importlib import import_module
from types import ModuleType
from typing import Any

_NAMES = {  # of the formulas, by their modules
    "pair":
        "work_of_adhesion radius_ratio reduced_radius contact_modulus modulus_over_energy contact_modulus_of_ratio "
        "contact_shear_modulus mass reduced_mass moment_of_inertia reduced_moment_of_inertia rolling_mass",
    "contact":
        "pull_off_force pull_off_force_dmt pull_off_force_ratio contact_radius approach load_margin load_factor "
        "contact_radius_at_load approach_at_load contact_area load_ratio contact_radius_ratio approach_ratio "
        "stiffness tangential_stiffness hertz_pressure boussinesq_pressure pressure boussinesq_pressure_at_approach",
    "jkr":
        "load_margin_of_factor load_at_factor load_factor_at_approach load_margin_at_approach "
        "contact_radius_at_pull_off contact_radius_at_fold approach_at_pull_off approach_at_fold "
        "contact_area_at_pull_off contact_area_at_fold adhesion_energy well_energy pull_off_work "
        "pull_off_work_at_dead_load sticking_energy",
    "rolling":
        "yield_moment rolling_stiffness rolling_spring_constant rolling_friction_coefficient "
        "rolling_resistance_coefficient yield_force yield_force_fixed_load yield_force_ratio yield_angle "
        "mean_rolling_moment mean_rolling_force unloaded_moment half_circles_moment fixed_approach_moment r_min "
        "gravity_moment n_grav bond_number",
    "motion":
        "vertical_frequency rolling_frequency rolling_frequency_as_printed rolling_frequency_no_slip "
        "sliding_frequency twisting_frequency time_step rayleigh_time energy kinetic_energy initial_angular_speed "
        "n_roll n_roll_energy_balance n_roll_after_impact restitution lost_energy viscosity_number "
        "sticking_speed_viscous",
    "conventions":
        "fold_energy break_energy_dust_simulation roll_energy roll_energy_quarter_turn roll_energy_half_turn "
        "sticking_energy_paszun_dominik sticking_energy_pencil_code sticking_speed sticking_speed_paszun_dominik "
        "sticking_speed_pencil_code contacts restructuring_energy restructuring_speed restructuring_speed_ormel "
        "disruption_energy disruption_energy_dust_simulation disruption_speed disruption_speed_dust_simulation "
        "compressive_strength tensile_strength",
    "validity":
        "tabor_parameter displacement_limit displacement_ratio contact_radius_in_spacings hertz_pressure_over_modulus "
        "profile_error displacement_over_contact_radius r_min_over_radius yield_energy energy_over_yield "
        "energy_over_sticking",
    "tangential":
        "shear_strength sliding_force sliding_displacement sliding_energy twisting_stiffness twisting_moment "
        "twisting_angle twisting_energy peeling_force peeling_radius peeling_over_sliding sliding_or_peeling_force "
        "rolling_over_sliding sliding_friction_coefficient twisting_friction_coefficient",
    "any_law":
        "adhesive_force unloaded_moment_of_radius yield_force_of_moment yield_force_ratio_of_forces "
        "rolling_frequency_no_slip_of_stiffness yield_energy_of_moment hysteresis_moment "
        "adhesion_hysteresis_of_fraction yield_displacement_at_hysteresis hysteresis_ratio transition_parameter "
        "cohesive_stress pull_off_force_lennard_jones pull_off_force_rough work_of_adhesion_of_hamaker "
        "atomic_spacing_of_cutoff",
    "dmt":
        "contact_radius_dmt contact_radius_dmt_at_approach unloaded_radius_dmt unloaded_approach_dmt approach_dmt "
        "load_dmt stiffness_dmt adhesive_force_dmt",
    "maugis":
        "edge_ratio_at_load edge_ratio_at_approach zone_span zone_span_at_approach contact_radius_maugis zone_radius "
        "approach_maugis approach_maugis_at_load load_maugis stiffness_maugis adhesive_force_maugis "
        "contact_displacement unloaded_edge_ratio unloaded_radius_maugis unloaded_approach_maugis "
        "edge_ratio_at_pull_off pull_off_force_maugis edge_ratio_at_fold fold_approach_maugis "
        "contact_radius_at_pull_off_maugis contact_radius_at_fold_maugis approach_at_pull_off_maugis",
    "maugis_energies":
        "state_energy_maugis well_energy_maugis pull_off_work_maugis pull_off_work_at_dead_load_maugis "
        "sticking_energy_maugis fold_energy_maugis",
}  # fmt: skip
_HOMES = {name: module for module, names in _NAMES.items() for name in names.split()}


@cache
def _module(name: str) -> ModuleType:
    return import_module(f".{name}", __name__)


class _Formulas(Mapping[str, Callable[..., Any]]):
    """The formulas by name. A module is imported when the first of its formulas is asked for."""

    def __getitem__(self, name: str) -> Callable[..., Any]:
        formula: Callable[..., Any] = getattr(_module(_HOMES[name]), name)
        return formula

    def __iter__(self) -> Iterator[str]:
        return iter(_HOMES)

    def __len__(self) -> int:
        return len(_HOMES)


FORMULAS: Mapping[str, Callable[..., Any]] = _Formulas()
