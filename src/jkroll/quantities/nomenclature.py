"""The nomenclature: every quantity by name, with its symbol, SI unit, sentence, equation, range and option.

Parsing, help, tables, CSV headers, JSON and error messages all read this table.
"""

import copyreg
from collections.abc import Collection, Mapping
from types import MappingProxyType
from typing import Any

from ..errors import BadRequest, JkrollError
from ..text import ascii_text, closest, listed, quoted
from .laws import MODELS, PROFILES, routes_anywhere
from .quantity import Quantity, Range
from .synonyms import QUANTITY_OF_SYNONYM

INFINITY = float("inf")
POSITIVE = Range(0.0, INFINITY, False, False, "must be positive")
SIZE = Range(0.0, INFINITY, False, False, "must be positive: it is the size of a pull")
UP_TO_INFINITE = Range(0.0, INFINITY, False, True, "must be positive")
POISSON = Range(-1.0, 0.5, False, True, "must lie above -1, and be at most 0.5")
LOOSE = Range(0.0, 0.74, False, False, "must lie between 0 and 0.74, the value of the closest packing")
FRACTION = Range(0.0, 1.0, False, True, "must lie between 0 and 1 (100 %)")
HUMIDITY = Range(0.0, 1.0, True, True, "must lie between 0 and 1 (100 %)")
WETTING = Range(0.0, 3.1415926535897936, True, True, "must lie between 0 and 180deg")  # π, rounded up
SEVERAL = Range(2.0, INFINITY, True, False, "must be at least 2")
ABOVE_MINUS_1 = Range(-1.0, INFINITY, False, False, "must lie above -1")
FINITE = Range(-INFINITY, INFINITY, False, False, "must be finite")


# --- Quantities of Maugis' law, and of a sphere of true shape ---------------------------------------------------------

OF_SPHERE: Mapping[str, Quantity] = {  # for a rigid sphere of true shape on a soft plane
    "indenter_radius": Quantity("R_s", "m", "radius of the rigid sphere"),
    "elastoadhesive_ratio": Quantity("κ", "1", "elasto-adhesive length w/E* over R"),
    "contact_artanh": Quantity("L", "1", "artanh(a/R)"),
    "artanh_at_load": Quantity("L", "1", "artanh(a/R) at the load", variant_of="contact_artanh"),
    "artanh_at_approach": Quantity("L", "1", "artanh(a/R) at the approach", variant_of="contact_artanh"),
    "unloaded_artanh": Quantity("L0", "1", "artanh(a/R) without load"),
    "artanh_at_pull_off": Quantity("L_pull", "1", "artanh(a/R) at pull-off"),
    "artanh_at_fold": Quantity("L_fold", "1", "artanh(a/R) where fixed grips let go"),
    "load_sphere": Quantity("P", "N", "load that holds the contact", may_be_zero=True, variant_of="load"),
}
OF_MAUGIS: Mapping[str, Quantity] = {
    "transition_parameter": Quantity("λ", "1", "Maugis' parameter of the transition between JKR and DMT"),
    "cohesive_stress": Quantity("σ0", "Pa", "largest stress with which two surfaces attract"),
    "length_unit_maugis": Quantity("l_M", "m", "unit of lengths, Maugis"),
    "approach_unit_maugis": Quantity("δ_M", "m", "unit of approaches, Maugis"),
    "energy_unit_maugis": Quantity("U_M", "J", "unit of energies, Maugis"),
    "edge_ratio": Quantity("v", "1", "contact radius over the span of the ring of attraction", range=POSITIVE),
    "edge_ratio_at_load": Quantity("v", "1", "edge ratio at the load", variant_of="edge_ratio"),
    "edge_ratio_at_approach": Quantity("v", "1", "edge ratio at the approach", may_be_zero=True,
        variant_of="edge_ratio"),
    "unloaded_edge_ratio": Quantity("v0", "1", "edge ratio without load"),
    "edge_ratio_at_pull_off": Quantity("v_c", "1", "edge ratio at pull-off"),
    "edge_ratio_at_fold": Quantity("v_fold", "1", "edge ratio where fixed grips let go", may_be_zero=True),
    "zone_span": Quantity("T", "m", "span of the ring of attraction"),
    "zone_span_at_approach": Quantity("T", "m", "span of the ring of attraction at the approach",
        variant_of="zone_span"),
    "zone_radius": Quantity("c", "m", "radius of the zone of attraction"),
    "fold_approach_maugis": Quantity("δ_fold", "m", "least approach that fixed grips hold",
        variant_of="approach_at_fold"),
    "state_energy_maugis": Quantity("Φ", "J", "energy of the state"),
}  # fmt: skip


# --- Columns of measured force curves, which enter no formula ---------------------------------------------------------

OF_CURVES: Mapping[str, Quantity] = {
    "lever_travel": Quantity("z", "m", "travel of the drive that presses and pulls"),
    "lever_force": Quantity("F_lever", "N", "force that a lever measures; a pull is negative"),
    "lever_deflection": Quantity("d_lever", "m", "deflection of a lever; a pull is negative"),
    "lever_stiffness": Quantity("k_lever", "N/m", "stiffness of the lever", range=POSITIVE),
}


# --- Quantities of models of many grains ------------------------------------------------------------------------------

_SPEED = "½(Nm1/2)v² = E"  # for two equal aggregates
_WADA = "Wada et al. 2007"
_E_ROLL = "E_roll is that of 90 degrees, 6π²γRξ"
_OF_BREAK_UP = "of two-dimensional aggregates of equal masses, head-on"

OF_DEM: Mapping[str, Quantity] = {
    "cutoff": Quantity("D0", "m", "cutoff distance of van der Waals' forces", range=POSITIVE, option="--cutoff",
        example="0.165nm", default=1.65e-10),
    "viscous_time": Quantity("T_vis", "s", "viscous time, codes for dust", range=POSITIVE,
        option="--viscous-time", example="12.5ps"),
    "asperity_radius": Quantity("s", "m", "radius of one asperity between the spheres", range=POSITIVE,
        option="--asperity-radius", example="5nm"),
    # sliding and twisting
    "shear_strength": Quantity("τ", "Pa", "shear strength of the contact (friction)", range=POSITIVE,
        option="--shear-strength", example="12MPa"),
    "sliding_force": Quantity("F_slide", "N", "force if it only slides"),
    "sliding_displacement": Quantity("s_slide", "m", "shear where sliding begins"),
    "sliding_energy": Quantity("E_slide", "J", "energy to begin sliding"),
    "peeling_force": Quantity("T_peel", "N", "force if it only peels", may_be_zero=True),
    "peeling_radius": Quantity("a_peel", "m", "contact radius at peeling"),
    "peeling_over_sliding": Quantity("T/F_slide", "1", "peeling force over the force to slide the contact as it peels",
        may_be_zero=True),
    "sliding_or_peeling_force": Quantity("T_first", "N", "force that slides or peels", may_be_zero=True),
    "rolling_over_sliding": Quantity("Q/T_first", "1", "yield force over the force that slides or peels"),
    "twisting_stiffness": Quantity("k_t", "N m/rad", "torsional stiffness", may_be_zero=True),
    "twisting_moment": Quantity("M_twist", "N m", "moment that starts twisting"),
    "twisting_angle": Quantity("φ_twist", "rad", "angle where twisting begins"),
    "twisting_energy": Quantity("E_twist", "J", "energy to begin twisting"),
    "twisting_frequency": Quantity("f_twist", "Hz", "twisting vibration", may_be_zero=True),
    # coefficients of codes: of pair_style granular in LAMMPS, and of rolling resistance in LIGGGHTS and Lethe
    "rolling_spring_constant": Quantity("k_roll", "N/m", "spring constant of rolling in LAMMPS"),
    "rolling_friction_coefficient": Quantity("μ_roll", "1", "coefficient of rolling friction in LAMMPS"),
    "rolling_resistance_coefficient": Quantity("μ_r", "1", "rolling moment over the load and R",
        note="for codes that multiply it by the load; valid at this load only"),
    "sliding_friction_coefficient": Quantity("μ_slide", "1", "coefficient of sliding friction in LAMMPS"),
    "twisting_friction_coefficient": Quantity("μ_twist", "m", "coefficient of twisting friction in LAMMPS, a length"),
    # aggregates
    "monomers": Quantity("N", "1", "number of grains of an aggregate or a chain", range=SEVERAL, option="--monomers",
        example="1000"),
    "contacts": Quantity("n_c", "1", "number of contacts of an aggregate", range=POSITIVE, option="--contacts",
        example="2500"),
    "filling_factor": Quantity("φ", "1", "filling factor of an aggregate", range=LOOSE, option="--filling-factor",
        example="0.1"),
    "restructuring_energy": Quantity("E_restr", "J", "restructuring energy, D&T 97", note=_E_ROLL,
        definition="5E_roll(π/2)", of_identical=True, reference="Dominik & Tielens 1997"),
    "restructuring_speed": Quantity("v_restr", "m/s", "restructuring speed, D&T 97",
        definition="√(4E_restr/(Nm1))", of_identical=True, reference=_SPEED),
    "restructuring_energy_ormel": Quantity("E_restr(1)", "J", "restructuring energy, Ormel", note=_E_ROLL,
        definition="E_roll(π/2)", of_identical=True, reference="Ormel et al. 2007"),
    "restructuring_speed_ormel": Quantity("v_restr(1)", "m/s", "restructuring speed, Ormel",
        definition="√(4E_restr(1)/(Nm1))", of_identical=True, reference=_SPEED),
    "disruption_energy": Quantity("E_disr", "J", "energy to break up, Wada 07", definition="10·2n_c U_grips",
        note=_OF_BREAK_UP, of_identical=True, reference=_WADA),
    "disruption_speed": Quantity("v_disr", "m/s", "speed to break up, Wada 07", definition="√(4E_disr/(Nm1))",
        of_identical=True, reference=_SPEED),
    "disruption_energy_dust_simulation": Quantity("E_disr(1.8)", "J", "energy to break up, E_break",
        definition="10·2n_c·1.8F_cδ_c", note=_OF_BREAK_UP, of_identical=True, reference=_WADA),
    "disruption_speed_dust_simulation": Quantity("v_disr(1.8)", "m/s", "speed to break up, E_break",
        definition="√(4E_disr(1.8)/(Nm1))", of_identical=True, reference=_SPEED),
    "compressive_strength": Quantity("P_comp", "Pa", "compressive strength",
        note="E_roll is that of 180 degrees, 6π²γR1ξ, twice as much", definition="E_roll(π)/R1³ (1/φ − 1/0.74)⁻³",
        of_identical=True, reference="Tatsuuma et al. 2023"),
    "tensile_strength": Quantity("P_tens", "Pa", "tensile strength", definition="0.6φ^1.8 γ/R1",
        note="leaves out the effect of the aggregate's volume on its strength (Kimura et al. 2020)",
        of_identical=True, reference="Tatsuuma et al. 2019"),
}  # fmt: skip


# --- Condensed water between the bodies -------------------------------------------------------------------------------

OF_WATER: Mapping[str, Quantity] = {
    "humidity": Quantity("RH", "1", "relative humidity of the air", range=HUMIDITY, option="--humidity", example="60%",
        may_be_zero=True),
    "contact_angle": Quantity("θ_c", "rad", "contact angle of water", range=WETTING, option="--contact-angle",
        example="20deg", may_be_zero=True, default=0.0,
        note="of the water that condenses at a --humidity; 0 wets fully. How a γ follows from contact angles: "
            "jkroll guide contact-angle"),
    "roughness_gap": Quantity("D_gap", "m", "gap that roughness leaves", range=POSITIVE, option="--roughness",
        example="2nm"),
    "kelvin_radius": Quantity("r_K", "m", "Kelvin radius of water", shown_with=["humidity"]),
    "meniscus_size": Quantity("q", "1", "relative loss of force by the finite size of the meniscus"),
    "meniscus_force": Quantity("F_men", "N", "force of a water meniscus", shown_with=["humidity"]),
    "threshold_humidity": Quantity("RH_gap", "1", "humidity that fills the gap", shown_with=["roughness_gap"]),
}  # fmt: skip


# --- All quantities ---------------------------------------------------------------------------------------------------

# Inputs that set the state of the contact; without them the state follows from the load.
STATE = frozenset({"approach_at_load", "load_factor", "load_margin", "edge_ratio"})
STATE_OR_LOAD = STATE | {"load"}


def _of_both(
    name: str, symbol: str, unit: str, sentence: str, equation: str = "", option: str = "", **more: Any
) -> dict[str, Quantity]:
    """Return a quantity of sphere 1 and its twin of sphere 2, by name."""
    symbol2, sentence2 = symbol.replace("1", "2"), sentence.replace(" of sphere 1", "") + " of sphere 2"
    option2 = option and f"{option}2"
    return {
        name: Quantity(symbol, unit, sentence, equation, option=option, sphere=1, twin=f"{name}2", **more),
        f"{name}2": Quantity(symbol2, unit, sentence2, equation, option=option2, sphere=2, twin=name, **more),
    }


_BOTH_SPHERES = {
    "radius": Quantity("R1", "m", "radius of sphere 1", range=POSITIVE, example="100nm", sphere=1, twin="radius2"),
    "radius2": Quantity("R2", "m", "radius of sphere 2, or plane", range=UP_TO_INFINITE, infinity="plane",
        option="--radius2", example="1um", sphere=2, twin="radius"),
    "diameter": Quantity("D1", "m", "diameter of sphere 1", range=POSITIVE, option="--diameter",
        example="200nm", sphere=1, twin="diameter2"),
    "diameter2": Quantity("D2", "m", "diameter of sphere 2, or plane", range=UP_TO_INFINITE, infinity="plane",
        option="--diameter2", example="2um", sphere=2, twin="diameter"),
    **_of_both("surface_energy", "γ1", "J/m^2", "surface energy per surface", range=POSITIVE, option="--gamma",
        example="25mJ/m2"),
    **_of_both("youngs_modulus", "E1", "Pa", "Young's modulus", range=UP_TO_INFINITE, infinity="rigid",
        option="--young", example="10GPa"),
    **_of_both("shear_modulus", "G1", "Pa", "shear modulus", range=POSITIVE, option="--shear-modulus",
        example="30GPa"),
    **_of_both("poisson_ratio", "ν1", "1", "Poisson's ratio", range=POISSON, option="--poisson", example="0.3"),
    **_of_both("density", "ρ1", "kg/m^3", "mass density", range=POSITIVE, option="--density", example="1g/cm3"),
    **_of_both("hamaker", "A1", "J", "Hamaker constant", range=POSITIVE, option="--hamaker", example="6.5e-20J"),
    **_of_both("mass", "m1", "kg", "mass of sphere 1", "41", range=UP_TO_INFINITE),
    **_of_both("moment_of_inertia", "I1", "kg m^2", "moment of inertia of sphere 1", "39", range=UP_TO_INFINITE),
    **_of_both("rayleigh_frequency", "f_R1", "Hz", "inverse of the Rayleigh time of sphere 1", may_be_zero=True),
}  # fmt: skip

_TRAILING = (
    "for a contact that rolls with the full lag ξ all the way, 4P_cξ in JKR; n_roll has the mean moment, half of it"
)

_QUANTITIES: Mapping[str, Quantity] = {
    # inputs
    "material": Quantity("", "", "material of sphere 1", sphere=1, twin="material2"),
    "model": Quantity("model", "", f"law of attraction: {', '.join(MODELS)}", option="--model", example="maugis"),
    "profile": Quantity("profile", "", f"shape of body 1: {', '.join(PROFILES)}", option="--profile",
        example="sphere"),
    "state": Quantity("state", "", "state on the force curve"),
    "material2": Quantity("", "", "material of sphere 2", option="--material2", example="iron", sphere=2,
        twin="material"),
    **_BOTH_SPHERES,
    "yield_displacement": Quantity("ξ", "m", "critical rolling displacement", range=POSITIVE, option="--xi",
        example="2angstrom", shown_with=["adhesion_hysteresis", "hysteresis_fraction"], default=2e-10),
    "load": Quantity("P", "N", "load; a pull is negative", "5", range=FINITE, option="--load", example="-5nN",
        may_be_zero=True, shown_with=STATE, default=0.0),
    "gravity": Quantity("g", "m/s^2", "gravity", range=POSITIVE, option="--gravity", example="1.62m/s2",
        default=9.80665),
    "energy": Quantity("W0", "J", "impact energy of sphere 1", "48", range=POSITIVE, option="--energy",
        example="1e-18J"),
    "energy_ratio": Quantity("W0/P_cδ0", "1", "W0 over P_cδ0", range=POSITIVE, option="--energy-ratio", example="1",
        default=1.0),
    "speed": Quantity("v", "m/s", "impact speed of sphere 1", range=POSITIVE, option="--speed", example="10cm/s"),
    "yield_strength": Quantity("S_y", "Pa", "yield strength of the weaker solid", range=POSITIVE,
        option="--yield-strength", example="1GPa"),
    # the pair
    "work_of_adhesion": Quantity("w", "J/m^2", "work of adhesion, 2√(γ1γ2)", "1", range=POSITIVE,
        option="--work-of-adhesion", example="50mJ/m2"),
    "radius_ratio": Quantity("R1/R2", "1", "ratio of the radii", "1", may_be_zero=True),
    "reduced_radius": Quantity("R", "m", "reduced radius", "1", range=POSITIVE, option="--reduced-radius",
        example="50nm"),
    "contact_modulus": Quantity("E*", "Pa", "contact modulus", "2", range=POSITIVE, option="--contact-modulus",
        example="30GPa"),
    "contact_shear_modulus": Quantity("G*", "Pa", "contact shear modulus"),
    "reduced_mass": Quantity("m", "kg", "reduced mass", "33", range=POSITIVE),
    "reduced_moment_of_inertia": Quantity("I", "kg m^2", "reduced moment of inertia", "39"),
    "rolling_mass": Quantity("m_eff", "kg", "effective mass of rolling without slip", "40"),
    # the contact
    "pull_off_force": Quantity("P_c", "N", "pull-off force", "1", range=SIZE),
    "pull_off_force_dmt": Quantity("P_DMT", "N", "pull-off force, DMT", "1"),
    "pull_off_force_rough": Quantity("P_rough", "N", "pull-off force, one asperity",
        note="P_DMT with one hard hemisphere on the line of centres, by Rumpf's pairwise sum; s is the radius of the "
            "asperity, not an rms height", shown_with=["asperity_radius"]),
    "contact_radius": Quantity("a0", "m", "unloaded contact radius", "2", range=POSITIVE),
    "approach": Quantity("δ0", "m", "approach without load", "3", range=POSITIVE),
    "pull_off_force_lennard_jones": Quantity("P_LJ", "N", "pull-off force, Lennard-Jones", "",
        note="a fit to numerical solutions, within 0.3 % for 0.01 ≤ μ ≤ 2; beyond, it tends to DMT and JKR"),
    "well_energy_lennard_jones": Quantity("U_LJ", "J", "energy well, Lennard-Jones", "",
        note="a fit to numerical solutions, within 0.2 % for μ ≤ 1; below 0.7 it is the work to part, too"),
    "dead_load_work_lennard_jones": Quantity("U_LJ(load)", "J", "dead load, Lennard-Jones", "",
        note="a fit to numerical solutions, within 0.5 % for μ ≤ 1"),
    "load_margin": Quantity("s", "1", "√(1 + P/P_c)", "5", range=ABOVE_MINUS_1, may_be_zero=True),
    "load_factor": Quantity("x", "1", "â^(3/2), by which the load scales the rolling moment", "5", range=POSITIVE),
    "contact_radius_at_load": Quantity("a", "m", "contact radius", "5", may_be_zero=True),
    "approach_at_load": Quantity("δ", "m", "approach (indentation)", "6", range=FINITE, option="--approach",
        example="0.05nm", may_be_zero=True),
    "contact_area": Quantity("A_c", "m^2", "area of the contact at the load", "5", may_be_zero=True),
    "contact_radius_at_pull_off": Quantity("a_pull", "m", "contact radius at pull-off", "5"),
    "approach_at_pull_off": Quantity("δ_pull", "m", "approach at pull-off", "6"),
    "contact_area_at_pull_off": Quantity("A_pull", "m^2", "area of the contact at pull-off", "5"),
    "contact_radius_at_fold": Quantity("a_fold", "m", "contact radius where fixed grips let go", "6", may_be_zero=True),
    "approach_at_fold": Quantity("δ_fold", "m", "approach where fixed grips let go", "6"),
    "contact_area_at_fold": Quantity("A_fold", "m^2", "contact area where fixed grips let go", "6", may_be_zero=True),
    "load_ratio": Quantity("P/P_c", "1", "load over the pull-off force", "4", range=FINITE, may_be_zero=True,
        shown_with=STATE_OR_LOAD),
    "contact_radius_ratio": Quantity("a/a0", "1", "contact radius over a0", "4", may_be_zero=True,
        shown_with=STATE_OR_LOAD),
    "approach_ratio": Quantity("δ/δ0", "1", "approach over δ0", "4", range=FINITE, may_be_zero=True,
        shown_with=STATE_OR_LOAD),
    "load_at_factor": Quantity("P", "N", "load that holds the contact", "5", may_be_zero=True, variant_of="load"),
    "load_margin_of_factor": Quantity("s", "1", "√(1 + P/P_c)", "5", may_be_zero=True, variant_of="load_margin"),
    "load_margin_at_approach": Quantity("s", "1", "√(1 + P/P_c) at the approach", "6", may_be_zero=True,
        variant_of="load_margin"),
    "load_factor_at_approach": Quantity("x", "1", "â^(3/2) at the approach", "6", variant_of="load_factor"),
    "stiffness": Quantity("dP/dδ", "N/m", "normal stiffness", "34", may_be_zero=True),
    "tangential_stiffness": Quantity("k_s", "N/m", "tangential stiffness", may_be_zero=True),
    "hertz_pressure": Quantity("p_H", "Pa", "Hertz pressure at centre", "8", may_be_zero=True),
    "boussinesq_pressure": Quantity("p_B", "Pa", "pulling part (flat punch)", "9"),
    "well_energy": Quantity("U", "J", "depth of the energy well", "6", definition="6/5 P_cδ0 = 1.4537 F_cδ_c"),
    "pull_off_work": Quantity("U_grips", "J", "work to part, fixed grips", "6",
        definition="1.27338 P_cδ0 = 1.5426 F_cδ_c"),
    "pull_off_work_at_dead_load": Quantity("U_load", "J", "work to part, dead load", "6",
        definition="0.88252 P_cδ0 = 1.0691 F_cδ_c"),
    "sticking_energy": Quantity("U_stick", "J", "largest energy to stick", "48",
        definition="0.77224 P_cδ0 = 0.9355 F_cδ_c", reference="Thornton & Ning 1998, Eq 52"),
    # rolling
    "yield_moment": Quantity("M", "N m", "moment that starts rolling", "25"),
    "unloaded_moment": Quantity("M_0", "N m", "moment without load", "26"),
    "half_circles_moment": Quantity("M_half", "N m", "moment of two half-circles", "19"),
    "fixed_approach_moment": Quantity("M_δ", "N m", "moment at a fixed approach", "25"),
    "rolling_stiffness": Quantity("k", "N m/rad", "rolling moment per angle", "39"),
    "yield_force": Quantity("Q", "N", "force that starts rolling", "26"),
    "yield_force_fixed_load": Quantity("Q_P", "N", "force, load keeps direction", "26",
        note="for a load that keeps its direction; that of Q turns with the line of centres", shown_with=STATE_OR_LOAD),
    "yield_force_ratio": Quantity("Q/P_c", "1", "force over pull-off force", "27"),
    "contact_displacement": Quantity("ξ_contact", "m", "displacement of the contact circle", may_be_zero=True),
    "yield_angle": Quantity("δ_α", "rad", "angle where rolling starts", "28"),
    "mean_rolling_moment": Quantity("⟨M⟩", "N m", "mean moment while rolling", "43"),
    "mean_rolling_force": Quantity("⟨Q⟩", "N", "mean force while rolling", "44"),
    # chains
    "r_min": Quantity("R_min", "m", "tightest bend of a chain", "28"),
    "gravity_moment": Quantity("M_grav", "N m", "moment of a level chain", "29", shown_with=["monomers"]),
    "n_grav": Quantity("N_grav", "1", "spheres in a level chain", "30"),
    "bond_number": Quantity("Bo", "1", "pull-off force over weight"),
    # adhesive force, and hysteresis of adhesion
    "adhesion_hysteresis": Quantity("Δw", "J/m^2", "w of opening minus closing",
        range=POSITIVE, option="--adhesion-hysteresis", example="5mJ/m2"),
    "hysteresis_fraction": Quantity("Δw/w", "1", "adhesion hysteresis as a part of the work of adhesion",
        range=FRACTION, option="--hysteresis-fraction", example="40%"),
    "adhesive_force": Quantity("F_a", "N", "Hertz' load at the contact radius minus the load", "25"),
    "hysteresis_moment": Quantity("M_hyst", "N m", "moment by adhesion hysteresis"),
    "hysteresis_ratio": Quantity("M/2cRw", "1", "moment over the largest moment by adhesion hysteresis"),
    # vibrations
    "vertical_frequency": Quantity("f_z", "Hz", "normal vibration", "35", may_be_zero=True),
    "rolling_frequency": Quantity("f_roll", "Hz", "rolling vibration", "40"),
    "rolling_frequency_as_printed": Quantity("f_roll(41)", "Hz", "rolling frequency as printed", "41",
        note="2.5 times too low: Eq (40) with k² = (5/2)R1² for (2/5)R1²", of_identical=True),
    "rolling_frequency_no_slip": Quantity("f_free", "Hz", "rolling without slip", "40",
        note="unequal spheres that do not slip also move their centres, which Eq (40) leaves out"),
    "sliding_frequency": Quantity("f_slide", "Hz", "sliding vibration", may_be_zero=True),
    "time_step": Quantity("Δt", "s", "time step for a simulation"),
    "rayleigh_time": Quantity("t_R", "s", "Rayleigh time of sphere 1"),
    # validity
    "atomic_spacing": Quantity("z0", "m", "atomic spacing", range=POSITIVE, option="--z0", example="4angstrom",
        default=4e-10),
    "tabor_parameter": Quantity("μ", "1", "Tabor parameter", "1"),
    "displacement_limit": Quantity("ξ_max", "m", "largest meaningful displacement", "25"),
    "displacement_ratio": Quantity("ξ/ξ_max", "1", "displacement over its limit", "25"),
    "contact_radius_in_spacings": Quantity("a/z0", "1", "contact radius over the atomic spacing", "2",
        may_be_zero=True),
    "hertz_pressure_over_modulus": Quantity("p_H/E*", "1", "Hertz part of the pressure over the contact modulus", "8",
        may_be_zero=True),
    "profile_error": Quantity("e_h", "1", "error of the sphere's shape at the contact's edge", may_be_zero=True),
    "contact_over_sphere": Quantity("a/R_small", "1", "contact radius over that of the smaller sphere",
        may_be_zero=True),
    "displacement_over_contact_radius": Quantity("ξ/a", "1", "displacement over the contact radius", "25"),
    "r_min_over_radius": Quantity("R_min/R1", "1", "smallest curvature radius over the radius", "28"),
    "yield_energy": Quantity("W_yield", "J", "energy to begin rolling", "25"),
    "energy_over_yield": Quantity("W0/W_yield", "1", "energy over the yield energy", "25"),
    "energy_over_sticking": Quantity("W0/U_stick", "1", "energy over the largest energy to stick", "48"),
    "flight_ratio": Quantity("m1v²/(R1+R2)P_c", "1", "force to stay on body 2 over the pull-off force",
        may_be_zero=True),
    "impact_pressure_over_modulus": Quantity("p_max/E*", "1", "peak pressure of the impact over the contact modulus"),
    "impact_over_yield": Quantity("p_max/p_y", "1", "peak pressure of the impact over that of first yield"),
    "speed_over_sound": Quantity("v/√(E/ρ)", "1", "speed over the speed of sound in the solid", may_be_zero=True),
    "speed_over_sticking": Quantity("v/v_stick", "1", "speed over the largest speed to stick"),
    # ratios
    "pull_off_force_ratio": Quantity("P_c/πwR", "1", "pull-off force over πwR"),
    "modulus_over_energy": Quantity("E*/γ", "m^-1", "contact modulus over surface energy", "49", range=POSITIVE),
    # collisions
    "adhesion_energy": Quantity("P_cδ0", "J", "characteristic energy of adhesion", "48"),
    "kinetic_energy": Quantity("m1v²/2", "J", "kinetic energy of sphere 1", "45"),
    "n_roll": Quantity("n_roll", "1", "turns while it slides", "48",
        note="the contact slides freely, as in the paper; friction would make it roll further"),
    "n_roll_energy_balance": Quantity("n_bal", "1", "turns without slip", "48",
        note="7/2 of Eq (48), for rolling without slip from the start"),
    "n_roll_after_impact": Quantity("n_imp", "1", "turns after hitting a body", "48",
        note="5/2 of Eq (48), for an arrival without spin that then rolls without slip", shown_with=["speed"]),
    "restitution": Quantity("e", "1", "coefficient of restitution", may_be_zero=True,
        note="upper bound where the law is right: adhesion, and viscous damping if it is given, are the only losses"),
    "lost_energy": Quantity("W_lost", "J", "loss by adhesion alone"),
    "viscosity_number": Quantity("T*", "1", "viscous time over impact time", shown_with=["viscous_time"]),
    "impact_pressure": Quantity("p_max", "Pa", "peak pressure of the impact"),
    "touch_pressure": Quantity("p_touch", "Pa", "peak pressure of a touch at zero speed"),
    "first_yield_pressure": Quantity("p_y", "Pa", "pressure of first yield",
        note="peak pressure at which a point below the surface yields", shown_with=["yield_strength"]),
    "plastic_pressure": Quantity("p_pl", "Pa", "pressure of full yield",
        note="(2 + π)/√3 of the yield strength, about the hardness", shown_with=["yield_strength"]),
    "yield_speed": Quantity("v_y", "m/s", "speed of first yield", shown_with=["yield_strength"]),
    "plastic_speed": Quantity("v_pl", "m/s", "speed of full yield", shown_with=["yield_strength"]),
    # energies and speeds by convention
    "fold_energy": Quantity("F_cδ_c", "J", "unit of energy, Wada 2007", definition="0.82548 P_cδ0",
        reference="code Lumajord/DustSimulation, after Wada et al. 2007"),
    "break_energy_dust_simulation": Quantity("E_break", "J", "energy to break the contact",
        note="more than by JKR: at most 1.5426 F_cδ_c, with fixed grips", definition="1.8 F_cδ_c = 1.4859 P_cδ0",
        reference="code Lumajord/DustSimulation"),
    "rolling_angle": Quantity("θ", "rad", "turn of sphere 1, body 2 held", range=POSITIVE, option="--angle",
        example="90deg"),
    "roll_energy": Quantity("E_roll", "J", "energy to roll by the angle", note=_TRAILING,
        definition="4P_cξ θ = 12πγRξ θ", reference="work of the moment of Eq 26", shown_with=["rolling_angle"]),
    "roll_energy_quarter_turn": Quantity("E_roll(π/2)", "J", "energy to roll by 90°", note=_TRAILING,
        definition="4P_cξ π/2 = 6π²γRξ", reference="code Lumajord/DustSimulation"),
    "roll_energy_half_turn": Quantity("E_roll(π)", "J", "energy to roll by 180°", note=_TRAILING,
        definition="4P_cξ π = 12π²γRξ = 6π²γr0ξ (r0 = 2R)", reference="code StephaneMichoulier/Pamdeas"),
    "sticking_energy_paszun_dominik": Quantity("E_stick(1.07)", "J", "energy to stick, Paszun 08",
        definition="0.3290 P_cδ0 = 0.3985 F_cδ_c",
        reference="Paszun & Dominik 2008, Eq 3, as cited in Lumajord/DustSimulation"),
    "sticking_energy_pencil_code": Quantity("E_stick(19.2)", "J", "energy to stick, Pencil Code",
        definition="2·9.6 γ^(5/3) R^(4/3) / E*^(2/3) = 0.7977 F_cδ_c", reference="code pencil-code/pencil-code"),
    "sticking_speed": Quantity("v_stick", "m/s", "largest speed to stick",
        definition="√(2U_stick/m) = √(14.18/m) (w⁵R⁴/E*²)^(1/6)", reference="Thornton & Ning 1998, Eq 54"),
    "sticking_speed_paszun_dominik": Quantity("v_stick(1.07)", "m/s", "speed to stick, Paszun 08",
        definition="1.07 (γ/R)^(5/6) / (E*^(1/3) ρ^(1/2))",
        reference="Paszun & Dominik 2008, Eq 3, as cited in Lumajord/DustSimulation"),
    "sticking_speed_pencil_code": Quantity("v_stick(19.2)", "m/s", "speed to stick, Pencil Code",
        definition="√(2E_stick(19.2)/m)", reference="code pencil-code/pencil-code"),
    **OF_DEM,
    **OF_WATER,
    **OF_MAUGIS,
    **OF_SPHERE,
    **OF_CURVES,
}  # fmt: skip


def _variants() -> dict[str, Quantity]:
    """Return an entry for each formula that only a route names, as a variant of the quantity of the route."""
    variants = {}
    for name, quantity in _QUANTITIES.items():
        symbol, unit, sentence, may_be_zero = quantity.symbol, quantity.unit, quantity.sentence, quantity.may_be_zero
        for route in routes_anywhere().get(name, ()):
            if route not in _QUANTITIES:
                variants[route] = Quantity(symbol, unit, sentence, may_be_zero=may_be_zero, variant_of=name)
    return variants


def read_only(mapping: Mapping[str, Any]) -> MappingProxyType[str, Any]:
    """Return a read-only view of a mapping, for shared data."""
    return MappingProxyType(mapping)


copyreg.pickle(MappingProxyType, lambda mapping: (read_only, (dict(mapping),)))  # Python cannot pickle this type
NOMENCLATURE: Mapping[str, Quantity] = read_only({**_QUANTITIES, **_variants()})
DEFAULTS = {name: each.default for name, each in NOMENCLATURE.items() if each.default is not None}


def of_sphere(sphere: int, name: str) -> str:
    """Return the same quantity of sphere 1 or 2; a quantity that belongs to neither sphere is returned unchanged.

    >>> of_sphere(2, "density"), of_sphere(1, "density2"), of_sphere(2, "load")
    ('density2', 'density', 'load')
    """
    quantity = NOMENCLATURE.get(name)
    return name if quantity is None or quantity.sphere in (0, sphere) else quantity.twin


# The names of inputs by the words of their options: by "z0" for --z0, by "viscous_time" for --viscous-time.
OPTION_WORDS = {
    quantity.option[2:].replace("-", "_"): name for name, quantity in NOMENCLATURE.items() if quantity.option
}


def as_input(word: str) -> str:
    """Return the name of the input that a word means; "approach" means `--approach`, not the result of that name.

    An unknown word is returned unchanged. Raises BadRequest for R, which is the reduced radius here, but often the
    radius of a sphere.
    >>> as_input("approach"), as_input("radius")
    ('approach_at_load', 'radius')
    """
    name = word.strip().lstrip("-").replace("-", "_")
    if name in ("R", "r"):
        radii = "--radius or --reduced-radius" if word.startswith("-") else "radius or reduced_radius"
        raise BadRequest(f"{name} may be a sphere's radius or the reduced radius: write {radii}")
    return OPTION_WORDS.get(name, name if name in NOMENCLATURE else word)


XI = "yield_displacement"  # ξ, which a material may have in addition to its `PROPERTIES`

# Inputs that are converted to others before formulas use them: R = D/2, E = 2G(1 + ν).
CONVERTED = {
    "diameter": "radius",
    "diameter2": "radius2",
    "shear_modulus": "youngs_modulus",
    "shear_modulus2": "youngs_modulus2",
}


def computed_as(name: str) -> str:
    """Return the input to which an input is converted, or any other name unchanged.

    >>> computed_as("diameter2"), computed_as("load")
    ('radius2', 'load')
    """
    return CONVERTED.get(name, name)


# The properties of a material in a materials file.
PROPERTIES = ("surface_energy", "youngs_modulus", "poisson_ratio", "density")


def bracketed(unit: str) -> str:
    """Return a unit in brackets to follow a name or a symbol; empty for the unit of a bare number or a word."""
    return "" if unit in ("", "1") else f" [{unit}]"


def header(name: str, unit: str | None = None) -> str:
    """Return the column header of a quantity: its name with a unit in brackets, by default the SI unit.

    >>> header("radius"), header("n_grav")
    ('radius [m]', 'n_grav')
    """
    return name + bracketed(NOMENCLATURE[name].unit if unit is None else unit)


# --- Words for quantities ---------------------------------------------------------------------------------------------


def named(word: str, names: Collection[str] = NOMENCLATURE) -> str:
    """Return the quantity among `names` that a word means: a name or an option in any case, or a symbol.

    An unknown word, or a symbol of several quantities, is returned unchanged.
    >>> named("R-min"), named("gamma"), named("P_c"), named("Pc"), named("delta0"), named("E"), named("v")
    ('r_min', 'surface_energy', 'pull_off_force', 'pull_off_force', 'approach', 'youngs_modulus', 'v')
    """
    if word in names:
        return word
    plain = word.strip().lstrip("-").replace("-", "_")
    for spelling in (plain, plain.casefold()):
        for name in (spelling, OPTION_WORDS.get(spelling, "")):
            if name in names:
                return name
    several = with_symbol(word, names)
    return several[0] if len(several) == 1 else word


def with_symbol(word: str, names: Collection[str] = NOMENCLATURE) -> list[str]:
    """Return the quantities among `names` whose symbol is a given word.

    If no symbol is equal to the word, letter case, underscores and spaces are ignored and Greek letters may be spelt
    out. The index of sphere 1 may be left out. Variants are skipped, since they share the symbol of their quantity.
    """
    symbols = {name: NOMENCLATURE[name].symbol for name in names if not NOMENCLATURE[name].variant_of}
    for spelling_of in (str, _plain_spelling):
        for index in ("", "1"):
            wanted = spelling_of(word.strip()) + index
            several = [name for name, symbol in symbols.items() if symbol and spelling_of(symbol) == wanted]
            if several:
                return several
    return []


def _plain_spelling(symbol: str) -> str:
    return ascii_text(symbol.casefold()).replace("_", "").replace(" ", "")


# Least similarity of a mistyped name: "moment" is similar to "yield_moment", but not "restitution" to "friction".
ALIKE = 0.65


def nearest(word: str) -> str | None:
    """Return the quantity that a word probably means; None if no quantity is similar.

    The first rule that finds a quantity decides. The word is the symbol of the quantity, with or without the index of
    sphere 1; or its name, option or synonym; or the beginning of its name; or most similar to its name, option or
    synonym.
    """
    meanings = {**OPTION_WORDS, **QUANTITY_OF_SYNONYM, **{name: name for name in NOMENCLATURE}}
    name = word.strip().lstrip("-").replace("-", "_").replace(" ", "_").casefold()
    of_symbol = with_symbol(word)
    if of_symbol:
        return of_symbol[0]
    if name in meanings:
        return meanings[name]
    letters = name.replace("_", "")
    for full in NOMENCLATURE:
        if letters and full.replace("_", "").startswith(letters):
            return full
    return meanings.get(closest(name, meanings, ALIKE) or "")


class UnknownQuantity(JkrollError):
    """Error raised for a word that does not mean a single quantity with a number as its value."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.name = name

    def __str__(self) -> str:
        if self.name in NOMENCLATURE:
            return f"{quoted(self.name)} stands for a word, not a number; jkroll quantities lists the quantities"
        several = with_symbol(self.name)
        if several:
            return f"{quoted(self.name)} is the symbol of {listed(several)}; write the name that is meant"
        guess = nearest(self.name)
        meant = f"did you mean {guess}? " if guess else ""
        return f"{quoted(self.name)} is not a quantity; {meant}jkroll quantities lists them"
