"""Quantities that Maugis' law alone has."""

from collections.abc import Mapping

from .quantity import Quantity

OF_MAUGIS: Mapping[str, Quantity] = {
    "transition_parameter": Quantity("λ", "1", "Maugis' parameter of the transition between JKR and DMT"),
    "cohesive_stress": Quantity("σ0", "Pa", "largest stress with which two surfaces attract"),
    "edge_ratio": Quantity("v", "1", "contact radius over the span of the ring of attraction", range="positive"),
    "edge_ratio_at_load": Quantity("v", "1", "edge ratio at the load"),
    "edge_ratio_at_approach": Quantity("v", "1", "edge ratio at the approach", may_be_zero=True),
    "edge_ratio_at_pull_off": Quantity("v_c", "1", "edge ratio at pull-off"),
    "edge_ratio_at_fold": Quantity("v_fold", "1", "edge ratio where fixed grips let go", may_be_zero=True),
    "zone_span": Quantity("T", "m", "span of the ring of attraction"),
    "zone_span_at_approach": Quantity("T", "m", "span of the ring of attraction at the approach"),
    "zone_radius": Quantity("c", "m", "radius of the zone of attraction"),
    "contact_displacement": Quantity("ξ_contact", "m", "displacement of the contact circle"),
    "fold_approach_maugis": Quantity("δ_fold", "m", "least approach that fixed grips hold"),
    "state_energy_maugis": Quantity("Φ", "J", "energy of the state"),
}
