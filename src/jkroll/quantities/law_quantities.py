"""Quantities of the laws of attraction beyond the paper: those of Maugis' law, and formulas that give a quantity under some law."""

from collections.abc import Mapping

from .quantity import Quantity

OF_MAUGIS: Mapping[str, Quantity] = {
    "transition_parameter": Quantity("λ", "1", "Maugis' parameter of the transition between JKR and DMT"),
    "cohesive_stress": Quantity("σ0", "Pa", "largest stress with which two surfaces attract"),
    "edge_ratio": Quantity("v", "1", "contact radius over the span of the ring of attraction", range="positive"),
    "edge_ratio_at_load": Quantity("v", "1", "edge ratio at the load", variant_of="edge_ratio"),
    "edge_ratio_at_approach": Quantity(
        "v", "1", "edge ratio at the approach", may_be_zero=True, variant_of="edge_ratio"
    ),
    "edge_ratio_at_pull_off": Quantity("v_c", "1", "edge ratio at pull-off"),
    "edge_ratio_at_fold": Quantity("v_fold", "1", "edge ratio where fixed grips let go", may_be_zero=True),
    "zone_span": Quantity("T", "m", "span of the ring of attraction"),
    "zone_span_at_approach": Quantity(
        "T", "m", "span of the ring of attraction at the approach", variant_of="zone_span"
    ),
    "zone_radius": Quantity("c", "m", "radius of the zone of attraction"),
    "contact_displacement": Quantity("ξ_contact", "m", "displacement of the contact circle"),
    "fold_approach_maugis": Quantity("δ_fold", "m", "least approach that fixed grips hold"),
    "state_energy_maugis": Quantity("Φ", "J", "energy of the state"),
}

# Formulas by which some law has a quantity; it is the same quantity, without an equation of the paper.
BY_A_LAW: Mapping[str, tuple[str, ...]] = {
    "pull_off_force": ("pull_off_force_maugis",),
    "contact_radius": ("unloaded_radius_maugis", "unloaded_radius_dmt"),
    "approach": ("unloaded_approach_maugis", "unloaded_approach_dmt"),
    "contact_radius_at_load": ("contact_radius_maugis", "contact_radius_dmt", "contact_radius_dmt_at_approach"),
    "approach_at_load": ("approach_maugis", "approach_maugis_at_load", "approach_dmt"),
    "load": ("load_maugis", "load_dmt"),
    "stiffness": ("stiffness_maugis", "stiffness_dmt"),
    "adhesive_force": ("adhesive_force_maugis", "adhesive_force_dmt"),
    "well_energy": ("well_energy_maugis",),
    "pull_off_work": ("pull_off_work_maugis",),
    "pull_off_work_at_dead_load": ("pull_off_work_at_dead_load_maugis",),
    "sticking_energy": ("sticking_energy_maugis",),
    "hertz_pressure": ("hertz_pressure_of_radius",),
    "yield_displacement": ("yield_displacement_at_hysteresis",),
    "yield_moment": ("yield_moment_of_force",),
    "unloaded_moment": ("unloaded_moment_of_radius",),
    "rolling_stiffness": ("rolling_stiffness_of_force",),
    "yield_force": ("yield_force_of_moment",),
    "yield_force_ratio": ("yield_force_ratio_of_forces",),
    "rolling_frequency_no_slip": ("rolling_frequency_no_slip_of_stiffness",),
    "yield_energy": ("yield_energy_of_moment",),
}
