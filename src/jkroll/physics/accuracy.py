"""The accuracy of every formula: its error in units of the last place, above what those of its arguments make of it.

The tests hold each formula to it, by floats and by arrays, against references of 50 to 120 digits.
"""

USUAL = "3 ulp"
# The formulas whose accuracy is another. "Of the larger term": the error is measured against that, as terms may cancel.
OTHERS = {
    # any_law
    "unloaded_moment_of_radius": "4 ulp",
    "pull_off_force_lennard_jones": "3 ulp of the fit",
    "pull_off_force_rough": "4 ulp",
    "profile_error": "6 ulp",
    # contact
    "reduced_radius": "1.5 ulp; exact for identical spheres and on a plane",
    "mass": "3.5 ulp",
    "rolling_mass": "5 ulp",
    "load_margin": "1.5 ulp, for the two forces as they are given",
    "approach_at_load": "4 ulp of the larger term",
    "stiffness": "3 ulp for s ≥ 0; beyond, 2 + 3s cancels towards the fold",
    "pressure": "4 ulp of the larger term",
    "boussinesq_pressure_at_approach": "2.5 ulp of the larger term",
    # conventions
    "compressive_strength": "8 ulp",
    "tensile_strength": "4 ulp",
    # cylinder
    "symmetric_pressure": "7 ulp of the largest term",
    "asymmetric_pressure": "7 ulp of the largest term",
    "strip_moment": "3.5 ulp",
    "contact_point_moment": "6 ulp of the larger term",
    "half_strips_moment": "6 ulp of the largest term",
    # dmt
    "contact_radius_dmt": "2 ulp, times 1 plus its condition in the load",
    "load_dmt": "4 ulp of the larger term",
    # jkr
    "load_margin_of_factor": "1 ulp of 2x",
    # Also at the fold, where the state itself is ill-conditioned.
    "load_factor_at_approach": "2 ulp, for the ratio δ̂ as it is rounded",
    "load_margin_at_approach": "4 ulp of the larger term, for the ratio δ̂ as it is rounded",
    "adhesion_energy": "4 ulp",
    # maugis
    "edge_ratio_at_load": "8 ulp, times 1 plus its condition in the load and λ",
    "edge_ratio_at_approach": "8 ulp, times 1 plus its condition in the approach and λ",
    "zone_span": "6 ulp",
    "zone_span_at_approach": "6 ulp; without contact, times 1 plus its condition in the approach and λ",
    "approach_maugis": "4 ulp of the larger term",
    "approach_maugis_at_load": "5 ulp of the larger term",
    "load_maugis": "8 ulp of the larger term",
    "stiffness_maugis": "6 ulp, times 1 plus its condition in v, T and σ0",
    "adhesive_force_maugis": "4 ulp",
    "unloaded_edge_ratio": "4 ulp",
    "unloaded_radius_maugis": "6 ulp",
    "unloaded_approach_maugis": "12 ulp",
    "edge_ratio_at_pull_off": "6 ulp",
    "pull_off_force_maugis": "8 ulp",
    "contact_radius_at_pull_off_maugis": "6 ulp",
    "contact_radius_at_fold_maugis": "6 ulp",
    "approach_at_pull_off_maugis": "8 ulp of the larger term",
    "edge_ratio_at_fold": "4 ulp, times 1 plus its condition in λ",
    "fold_approach_maugis": "8 ulp",
    "state_energy_maugis": "10 ulp of its largest term",
    "well_energy_maugis": "18 ulp",
    "pull_off_work_maugis": "15 ulp",
    "pull_off_work_at_dead_load_maugis": "15 ulp",
    "sticking_energy_maugis": "10 ulp; for λ > 0.655, of the energy of the well",
    # motion
    "rayleigh_time": "4 ulp",
    "viscosity_number": "3.5 ulp",
    "sticking_speed_viscous": "12 ulp of the fit, which is within 1e-10, times 1 plus its condition in T*",
    # rolling
    "yield_force": "3.5 ulp",
    "yield_force_fixed_load": "2 ulp of the larger term",
    # shifted
    "exact_pressure": "6 ulp of the largest term",
    "half_circle_pressure": "8 ulp of the largest term",
    # tangential
    "shear_strength": "3.5 ulp",
    "twisting_stiffness": "4 ulp",
    "twisting_moment": "3.5 ulp",
}


def accuracy_of(formula: str) -> str:
    """Return the accuracy of the formula with a name: "3 ulp", "7 ulp of the largest term"."""
    return OTHERS.get(formula, USUAL)
