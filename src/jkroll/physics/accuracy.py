"""The accuracy of every formula: its error in units of the last place (ulp), without the errors of its arguments.

The tests check this accuracy for floats and for arrays, against equations in 120-digit arithmetic.
"""

USUAL = "3 ulp"
# The formulas with another accuracy. "Of the larger term": the error is relative to that term, as terms may cancel. The
# condition in an argument is the factor from a relative error of this argument to that of the result.
_OTHERS = {
    "1 ulp of 2x": "load_margin_of_factor",
    "1.5 ulp, for the two forces as they are given": "load_margin",
    "1.5 ulp; exact for identical spheres and on a plane": "reduced_radius",
    "2 ulp, for the ratio δ̂ as it is rounded": "load_factor_at_approach",
    "2.5 ulp of the larger term": "boussinesq_pressure_at_approach",
    "3 ulp of the fit": "pull_off_force_lennard_jones",
    "5 ulp of the fit": "well_energy_lennard_jones dead_load_work_lennard_jones",
    "3 ulp of the larger term": (
        "yield_force_fixed_load approach_sphere unloaded_approach_sphere approach_at_pull_off_sphere "
        "approach_at_fold_sphere"
    ),
    "3 ulp, times 1 plus its condition in the load": "contact_radius_dmt",
    "3 ulp for s ≥ 0; beyond, 2 + 3s cancels towards the fold": "stiffness",
    "3.5 ulp": "strip_moment viscosity_number mass yield_force shear_strength twisting_moment",
    "4 ulp": (
        "unloaded_moment_of_radius pull_off_force_rough tensile_strength adhesion_energy adhesive_force_maugis "
        "unloaded_edge_ratio rayleigh_time twisting_stiffness first_yield_pressure"
    ),
    "4 ulp of the larger term": "approach_at_load pressure load_dmt approach_maugis",
    "4 ulp, times 1 plus its condition in λ": "edge_ratio_at_fold",
    "4 ulp of the larger term, for the ratio δ̂ as it is rounded": "load_margin_at_approach",
    "5 ulp": "rolling_mass",
    "5 ulp of the larger term": "approach_maugis_at_load",
    "6 ulp": (
        "zone_span unloaded_radius_maugis edge_ratio_at_pull_off contact_radius_at_pull_off_maugis "
        "contact_radius_at_fold_maugis profile_error"
    ),
    "6 ulp of the larger term": "contact_point_moment",
    "6 ulp of the largest term": "half_strips_moment exact_pressure",
    "6 ulp, times 1 plus its condition in v, T and σ0": "stiffness_maugis",
    "6 ulp; without contact, times 1 plus its condition in the approach and λ": "zone_span_at_approach",
    "7 ulp of the largest term": "asymmetric_pressure",
    "3 ulp, times 1 plus its condition in the gap": "threshold_humidity",
    "3 ulp, times 1 plus its condition in the two pressures": "yield_speed plastic_speed",
    "8 ulp": "impact_pressure unloaded_artanh compressive_strength pull_off_force_maugis fold_approach_maugis",
    "8 ulp of the larger term": "load_sphere load_maugis approach_at_pull_off_maugis",
    "8 ulp of the largest term": "half_circle_pressure",
    "8 ulp, times 1 plus its condition in the load and λ": "edge_ratio_at_load",
    "8 ulp, times 1 plus its condition in the approach and λ": "edge_ratio_at_approach",
    "10 ulp of its largest term": "state_energy_maugis",
    "10 ulp; for λ > 0.655, of the energy of the well": "sticking_energy_maugis",
    "12 ulp": "unloaded_approach_maugis",
    "12 ulp of the fit, which is within 1e-10, times 1 plus its condition in T*": "sticking_speed_viscous",
    "8 ulp, times 1 plus its condition in the load and in L at pull-off": "artanh_at_load",
    "8 ulp, times 1 plus its condition in the approach and in L at the fold": "artanh_at_approach",
    "3 ulp, times 1 plus its condition in L and κ": "stiffness_sphere",
    "15 ulp": "pull_off_work_maugis pull_off_force_sphere",
    "18 ulp": "well_energy_maugis",
    "25 ulp": "pull_off_work_at_dead_load_maugis",
}
OTHERS = {formula: accuracy for accuracy, formulas in _OTHERS.items() for formula in formulas.split()}


def accuracy_of(formula: str) -> str:
    """Return the accuracy of a formula, by its name: "3 ulp", "7 ulp of the largest term"."""
    return OTHERS.get(formula, USUAL)
