"""Words that others use for quantities, by the name of the quantity."""

# Words of others by the quantity that they mean, without accents. Behind ? stand those that are likely to mean it: no
# header is read by them.
_WORDS_OF_OTHERS = {
    "approach_at_load": """? indentation overlap penetration indentation_depth penetration_depth eindringtiefe
        enfoncement""",
    "atomic_spacing": """interatomic_spacing ? interatomic_distance atomic_distance equilibrium_separation
        equilibrium_distance""",
    "contact_modulus": """e_star reduced_modulus reduced_youngs_modulus reduced_young_modulus
        effective_youngs_modulus effective_young_modulus reduced_elastic_modulus reduzierter_modul reduzierter_e_modul
        module_reduit modulo_reducido ? effective_elastic_modulus equivalent_modulus combined_modulus""",
    "contacts": "number_of_contacts",
    "cutoff": "? cutoff_distance cut_off_distance",
    "density": """mass_density material_density true_density dichte massendichte materialdichte reindichte
        masse_volumique densite densidad ? particle_density specific_mass""",
    "diameter": "dia diam diameters durchmesser",
    "disruption_speed": "fragmentation_speed fragmentation_velocity fragmentation v_frag",
    "energy": """impact_energy collision_energy stossenergie aufprallenergie energie_d_impact energia_de_impacto
        ? e_kin""",
    "filling_factor": "volume_filling_factor ? porosity packing_fraction",
    "gravity": """gravitational_acceleration acceleration_of_gravity acceleration_due_to_gravity erdbeschleunigung
        fallbeschleunigung schwerebeschleunigung pesanteur gravedad""",
    "hamaker": "hamaker_constant hamaker_coefficient hamaker_konstante constante_de_hamaker",
    "hysteresis_fraction": "adhesion_hysteresis_fraction relative_adhesion_hysteresis",
    "load": """applied_load normal_load contact_load auflast normallast charge_normale charge_appliquee carga_normal
        carga_aplicada ? preload setpoint normal_force normalkraft""",
    "monomers": "number_of_monomers",
    "poisson_ratio": """poissons poissons_ratio poisson_number poisson_coefficient poissonzahl querkontraktionszahl
        querdehnzahl coefficient_de_poisson coeficiente_de_poisson""",
    "pull_off_force": "? adhesion adhesion_force detachment_force f f_ad force",
    "reduced_radius": "effective_radius reduzierter_radius rayon_reduit radio_reducido",
    "roll_energy": "rolling_energy",
    "shear_modulus": "modulus_of_rigidity rigidity_modulus schubmodul",
    "shear_strength": "interfacial_shear_strength contact_shear_strength",
    "sliding_force": "friction_force static_friction",
    "speed": """velocity impact_velocity impact_speed collision_velocity collision_speed geschwindigkeit
        aufprallgeschwindigkeit stossgeschwindigkeit kollisionsgeschwindigkeit vitesse vitesse_d_impact velocidad
        velocidad_de_impacto ? relative_velocity relative_speed v_rel""",
    "sticking_speed": "stickiness sticking_velocity ? rebound bounce",
    "stiffness": "spring_constant",
    "surface_energy": """surface_free_energy solid_surface_energy specific_surface_energy surface_energy_density
        oberflachenenergie oberflaechenenergie energie_de_surface energia_superficial ? surface_tension""",
    "tangential_stiffness": "sliding_stiffness",
    "twisting_moment": "torsion",
    "twisting_stiffness": "torsional_stiffness",
    "work_of_adhesion": """w_adh adhesion_work thermodynamic_work_of_adhesion delta_gamma adhasionsarbeit
        adhaesionsarbeit haftarbeit travail_d_adhesion trabajo_de_adhesion ? cohesion work_of_cohesion
        work_of_separation interface_energy interfacial_energy fracture_energy energy_release_rate gc""",
    "yield_angle": "critical_angle critical_rolling_angle",
    "yield_displacement": """critical_rolling_displacement critical_rolling_distance critical_roll_displacement
        rolling_displacement xi_crit kritische_rollverschiebung ? critical_displacement""",
    "yield_force": "friction rolling_force rolling_friction rolling_friction_force",
    "yield_moment": "rolling_resistance rolling_torque torque",
    "youngs_modulus": """young_modulus youngs elastic_modulus elasticity_modulus modulus_of_elasticity tensile_modulus
        e_modulus e_modul emod elastizitatsmodul elastizitaetsmodul youngscher_modul module_d_young module_de_young
        module_d_elasticite modulo_de_young modulo_de_elasticidad ? elasticity modulus dmt_modulus
        indentation_modulus""",
}  # fmt: skip
SYNONYMS = {name: words.partition("?")[0].split() for name, words in _WORDS_OF_OTHERS.items()}
QUANTITY_SYNONYMS = {word: name for name, words in _WORDS_OF_OTHERS.items() for word in words.replace("?", "").split()}
