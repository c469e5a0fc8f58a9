"""Other names of quantities, as in other programs and languages, without accents."""

from typing import NamedTuple


class Words(NamedTuple):
    """Other names of a quantity, separated by blanks."""

    certain: str = ""  # read in the headers of inputs and of measured curves
    likely: str = ""  # names that may also mean something else; they are used in a search and in suggestions


WORDS_OF_OTHERS = {
    "approach_at_load": Words(
        likely="indentation overlap penetration indentation_depth penetration_depth eindringtiefe enfoncement",
    ),
    "atomic_spacing": Words(
        certain="interatomic_spacing",
        likely="interatomic_distance atomic_distance equilibrium_separation equilibrium_distance",
    ),
    "contact_angle": Words(certain="water_contact_angle wetting_angle kontaktwinkel angle_de_contact"),
    "contact_modulus": Words(
        certain="""e_star reduced_modulus reduced_youngs_modulus reduced_young_modulus effective_youngs_modulus
            effective_young_modulus reduced_elastic_modulus reduzierter_modul reduzierter_e_modul module_reduit
            modulo_reducido""",
        likely="effective_elastic_modulus equivalent_modulus combined_modulus",
    ),
    "contact_radius_at_load": Words(certain="contact_radius"),
    "contacts": Words(certain="number_of_contacts"),
    "cutoff": Words(likely="cutoff_distance cut_off_distance"),
    "density": Words(
        certain="""mass_density material_density true_density dichte massendichte materialdichte reindichte
            masse_volumique densite densidad densita""",
        likely="particle_density specific_mass",
    ),
    "diameter": Words(
        certain="""dia diam diameters durchmesser kugeldurchmesser partikeldurchmesser teilchendurchmesser
            korndurchmesser diametre diametro""",
    ),
    "disruption_speed": Words(certain="fragmentation_speed fragmentation_velocity fragmentation v_frag"),
    "energy": Words(
        certain="impact_energy collision_energy stossenergie aufprallenergie energie_d_impact energia_de_impacto",
        likely="e_kin",
    ),
    "filling_factor": Words(certain="volume_filling_factor", likely="porosity packing_fraction"),
    "gravity": Words(
        certain="""gravitational_acceleration acceleration_of_gravity acceleration_due_to_gravity erdbeschleunigung
            fallbeschleunigung schwerebeschleunigung pesanteur gravedad""",
    ),
    "hamaker": Words(certain="hamaker_constant hamaker_coefficient hamaker_konstante constante_de_hamaker"),
    "humidity": Words(certain="relative_humidity luftfeuchte humidite"),
    "hysteresis_fraction": Words(certain="adhesion_hysteresis_fraction relative_adhesion_hysteresis"),
    "lever_deflection": Words(certain="deflection defl"),
    "lever_force": Words(certain="force"),
    "lever_travel": Words(certain="travel piezo z_piezo piezo_position height measured_height z_sensor zsnsr"),
    "load": Words(
        certain="""applied_load normal_load contact_load auflast normallast charge_normale charge_appliquee
            carga_normal carga_aplicada""",
        likely="preload setpoint normal_force normalkraft",
    ),
    "monomers": Words(certain="number_of_monomers"),
    "poisson_ratio": Words(
        certain="""poissons poissons_ratio poisson_number poisson_coefficient poissonzahl querkontraktionszahl
            querdehnzahl coefficient_de_poisson coeficiente_de_poisson coefficiente_di_poisson""",
    ),
    "pull_off_force": Words(likely="adhesion adhesion_force detachment_force f f_ad force"),
    "radius": Words(
        certain="""halbmesser kugelradius partikelradius teilchenradius kornradius spitzenradius rayon radio raggio""",
    ),
    "reduced_radius": Words(certain="effective_radius reduzierter_radius rayon_reduit radio_reducido"),
    "roll_energy": Words(certain="rolling_energy"),
    "shear_modulus": Words(certain="modulus_of_rigidity rigidity_modulus schubmodul"),
    "shear_strength": Words(certain="interfacial_shear_strength contact_shear_strength"),
    "sliding_force": Words(certain="friction_force static_friction"),
    "speed": Words(
        certain="""velocity impact_velocity impact_speed collision_velocity collision_speed geschwindigkeit
            aufprallgeschwindigkeit stossgeschwindigkeit kollisionsgeschwindigkeit vitesse vitesse_d_impact velocidad
            velocidad_de_impacto""",
        likely="relative_velocity relative_speed v_rel",
    ),
    "sticking_speed": Words(certain="stickiness sticking_velocity", likely="rebound bounce"),
    "stiffness": Words(certain="spring_constant"),
    "surface_energy": Words(
        certain="""surface_free_energy solid_surface_energy specific_surface_energy surface_energy_density
            oberflachenenergie oberflaechenenergie energie_de_surface energia_superficial
            energia_superficiale""",
        likely="surface_tension",
    ),
    "tangential_stiffness": Words(certain="sliding_stiffness"),
    "twisting_moment": Words(certain="torsion"),
    "twisting_stiffness": Words(certain="torsional_stiffness"),
    "work_of_adhesion": Words(
        certain="""w_adh adhesion_work thermodynamic_work_of_adhesion delta_gamma adhasionsarbeit adhaesionsarbeit
            haftarbeit travail_d_adhesion trabajo_de_adhesion""",
        likely="""cohesion work_of_cohesion work_of_separation interface_energy interfacial_energy fracture_energy
            energy_release_rate gc""",
    ),
    "yield_angle": Words(certain="critical_angle critical_rolling_angle"),
    "yield_displacement": Words(
        certain="""critical_rolling_displacement critical_rolling_distance critical_roll_displacement
            rolling_displacement xi_crit kritische_rollverschiebung""",
        likely="critical_displacement",
    ),
    "yield_force": Words(certain="friction rolling_force rolling_friction rolling_friction_force"),
    "yield_moment": Words(certain="rolling_resistance rolling_torque torque"),
    "youngs_modulus": Words(
        certain="""young_modulus youngs elastic_modulus elasticity_modulus modulus_of_elasticity tensile_modulus
            e_modulus e_modul emod elastizitatsmodul elastizitaetsmodul youngscher_modul module_d_young
            module_de_young module_d_elasticite modulo_de_young modulo_de_elasticidad modulo_di_young""",
        likely="elasticity modulus dmt_modulus indentation_modulus",
    ),
}

CERTAIN_SYNONYMS = {name: words.certain.split() for name, words in WORDS_OF_OTHERS.items()}
# The quantity of each name, certain or likely; "force", which two quantities have, means the later one.
QUANTITY_OF_SYNONYM = {word: name for name, words in WORDS_OF_OTHERS.items() for word in " ".join(words).split()}
