"""Exact values of formulas beyond the paper's, in 120-digit arithmetic: other laws, Sneddon's sphere, water, damping.

The parameters are symbols, which `reference` translates. For Maugis' law, the formulas follow from his own equations;
a contact of radius a in a zone of radius c has T = √(c² − a²) and the edge ratio v = a/T.
"""

# ruff: noqa: N803, N806  (the papers' symbols)

from collections.abc import Callable, Mapping

import maugis_reference as maugis
from maugis_reference import Exact, cbrt, digits, mpf, pi, sqrt

SYMBOLS = {
    "F_a": "adhesive_force", "Q": "yield_force", "c": "zone_radius", "dw": "adhesion_hysteresis",
    "part": "hysteresis_fraction",
    "mu": "tabor_parameter", "lambda_": "transition_parameter", "sigma0": "cohesive_stress",
    "edge": "edge_ratio", "edge0": "unloaded_edge_ratio", "T": "zone_span", "a_M": "unloaded_radius_maugis",
    "P_DMT": "pull_off_force_dmt", "s_a": "asperity_radius",
    "h": "humidity", "theta_c": "contact_angle", "r_K": "kelvin_radius", "q_men": "meniscus_size", "D": "roughness_gap",
    "T_vis": "viscous_time", "T_star": "viscosity_number",
    "l_M": "length_unit_maugis", "d_M": "approach_unit_maugis", "U_M": "energy_unit_maugis",
    "R_i": "indenter_radius", "kappa": "elastoadhesive_ratio", "L": "contact_artanh", "L_0": "unloaded_artanh",
    "L_pull": "artanh_at_pull_off", "L_fold": "artanh_at_fold",
    "fold": "fold_approach_maugis", "edge_c": "edge_ratio_at_pull_off", "edge_fold": "edge_ratio_at_fold",
}  # fmt: skip


RIGID_WELL = mpf(16) / 7 * mpf(2) ** (mpf(1) / 3)  # depth of the well of rigid spheres over πwRz0, by the 3-9 law
KELVIN_LENGTH = mpf(5.248e-10)  # γ_L V_m/(R_g T) of water at 25 °C


def first_order(theta_c: Exact) -> Exact:
    """Return κ of a meniscus between touching bodies, whose force is 4πRγ_L cos θ_c (1 − κ√(r_K/R))."""
    return (pi / 2 - theta_c + digits.sin(2 * theta_c) / 2) / (4 * digits.cos(theta_c) ** mpf(1.5))


def length_unit(w: Exact, R: Exact, E: Exact) -> Exact:
    """Return (πwR²/K)^(1/3), the unit of lengths along the surface."""
    return cbrt(pi * w * R**2 / (4 * E / 3))


def ratio(_a: Exact, t: Exact) -> Exact:
    """Return the edge ratio v = 1/t of a state; 0 without contact."""
    return 1 / t


def span(edge: Exact, lambda_: Exact) -> Exact:
    """Return T of a contact over the unit of length."""
    return maugis.radius_of(1 / edge, lambda_) / edge


def approach_terms(edge: Exact, lambda_: Exact) -> list[Exact]:
    """Return the two terms of the approach of a contact, over the unit of approaches."""
    T = span(edge, lambda_)
    return [(edge * T) ** 2, -4 * lambda_ * T / 3]


def angle(edge: Exact) -> Exact:
    """Return θ = arctan(1/edge)."""
    return digits.atan2(1, edge)


def hertz(edge: Exact, T: Exact, R: Exact, E: Exact) -> Exact:
    return 4 * E * (edge * T) ** 3 / (3 * R)


def attraction(edge: Exact, T: Exact, sigma0: Exact) -> Exact:
    """Return 2σ0(aT + c²θ)."""
    return 2 * sigma0 * T**2 * (edge + (1 + edge**2) * angle(edge))


def work(edge: Exact, T: Exact, R: Exact, E: Exact, sigma0: Exact) -> Exact:
    """Return the w of a state by Maugis' first equation, in SI units."""
    ring = edge + (1 - edge**2) * angle(edge)
    both = angle(edge) - sqrt(1 + edge**2) + edge
    return sigma0 * T**2 / (pi * R) * ring + 4 * sigma0**2 * T / (pi * E) * both


def slope(edge: Exact, T: Exact, R: Exact, E: Exact, sigma0: Exact) -> Exact:
    """Return dP/dδ at constant w.

    In contact, it follows from the gradients of load, approach and w along v and T; without contact, from the
    derivatives of P = −πσ0c² and δ = c²/2R − 4σ0c/(πE) − w/σ0.
    """
    if not edge:
        return -2 * pi * sigma0 * T / (T / R - 4 * sigma0 / (pi * E))
    step = mpf(10) ** (-digits.dps // 3)

    def gradient(of_state: Callable[[Exact, Exact], Exact]) -> tuple[Exact, Exact]:
        of_v = of_state(edge + edge * step, T) - of_state(edge - edge * step, T)
        of_T = of_state(edge, T + T * step) - of_state(edge, T - T * step)
        return of_v, of_T

    load = gradient(lambda edge, T: hertz(edge, T, R, E) - attraction(edge, T, sigma0))
    depth = gradient(lambda edge, T: (edge * T) ** 2 / R - 2 * sigma0 * T / E)
    held = gradient(lambda edge, T: work(edge, T, R, E, sigma0))
    return (load[0] * held[1] - load[1] * held[0]) / (depth[0] * held[1] - depth[1] * held[0])


def state_energy(edge: Exact, T: Exact, l_M: Exact, U_M: Exact, lambda_: Exact) -> list[Exact]:
    """Return the terms of the energy of a state."""
    a, t = edge * T / l_M, T / l_M
    b = 8 * lambda_ / (3 * pi)
    delta = a**2 - 4 * lambda_ * t / 3 if edge else t**2 / 2 - b * t - 2 / (pi * lambda_)
    return [U_M * term for term in maugis.energy_terms(a, t, delta, lambda_)]


def well(edge0: Exact, lambda_: Exact) -> Exact:
    """Return the depth of the energy well over the unit of energies."""
    return -maugis.contact_energy(maugis.radius_of(1 / edge0, lambda_), 1 / edge0, lambda_)


def sticking(lambda_: Exact) -> Exact:
    """Return the sticking energy over the unit of energies."""
    return maugis.fold_energy(lambda_) - maugis.energy_held_at(lambda_, -2 / (pi * lambda_))


# Coefficients of p and q in `slowed`, the lowest power first: the ratio of the speeds is (p(L)/q(L))³.
FITTED = (
    (
        "1 19.915339089884874 140.03302074351527 424.0239945815925 551.1471822473276 284.4669223705491 "
        "66.71381187636696 13.353579642533976 1.2560552655575732 0.13926479838105343 0.00656377003078744"
    ),
    (
        "1 17.904318541991803 108.99628658854968 266.4482631170719 239.30526460774885 56.20860934812392 "
        "9.812847493179728 1.7809773703126632 0.10560236313712765 0.012643948318122239"
    ),
)
ALL_STICK = mpf("0.681745209228707968370096573791593022995682283322922")  # least T* at which spheres always stick


def slowed(T_star: Exact) -> Exact:
    """Return the ratio of the sticking speeds with and without viscous damping, from the fit."""
    L = -digits.log(1 - T_star / ALL_STICK)
    numerator, denominator = FITTED
    return (_polynomial(numerator, L) / _polynomial(denominator, L)) ** 3


def _polynomial(coefficients: str, x: Exact) -> Exact:
    """Return the value of a polynomial, given its coefficients as a text, the lowest power first."""
    return sum(mpf(number) * x**power for power, number in enumerate(coefficients.split()))


def _rigid_on_soft_plane(R1: Exact, R2: Exact, E1: Exact, E2: Exact, nu2: Exact) -> Exact:
    """Return the radius of a sphere; raise ValueError if the theory of its true shape is not valid for the pair."""
    if digits.inf != R2 or E1 < 100 * E2 or nu2 < mpf(0.45):
        raise ValueError
    return R1


def sphere_load(L: Exact, kappa: Exact) -> list[Exact]:
    """Return the terms of the load over E*R² for Sneddon's sphere: P_H, and the negative term of adhesion."""
    x = digits.tanh(L)
    return [(1 + x**2) * L - x, -sqrt(8 * pi * kappa * x**3)]


def sphere_approach(L: Exact, kappa: Exact) -> list[Exact]:
    """Return the terms of the approach over R: δ_H, and the negative term of adhesion."""
    x = digits.tanh(L)
    return [x * L, -sqrt(2 * pi * kappa * x)]


def sphere_stiffness(L: Exact, kappa: Exact) -> Exact:
    """Return dP/dδ over E*R, from the slopes of load and approach along L."""
    load = digits.diff(lambda L: sum(sphere_load(L, kappa)), L)
    approach = digits.diff(lambda L: sum(sphere_approach(L, kappa)), L)
    return load / approach


def _root(function: Callable[[Exact], Exact], low: Exact, high: Exact) -> Exact:
    """Return the L between two bounds where a rising function is 0, by bisection of ln L, then by secants."""
    low, high = digits.log(low), digits.log(high)
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if function(digits.exp(middle)) < 0 else (low, middle)
    ln_L = digits.findroot(lambda ln_L: function(digits.exp(ln_L)), (low, high), tol=mpf(10) ** -150, verify=False)
    return digits.exp(ln_L)


def sphere_last(kappa: Exact, times: int) -> Exact:
    """Return L of the last state, where dδ_H/dx = times·u/(2x), with x = tanh L and u = √(2πκx).

    `times`: 1 with fixed grips, 3 at a dead load.
    """

    def excess(L: Exact) -> Exact:
        x = digits.tanh(L)
        return digits.log((L + x / (1 - x**2)) / (times * sqrt(pi * kappa / (2 * x))))

    return _root(excess, cbrt(kappa) / 10, 3 + cbrt(9 * kappa))


def sphere_state(terms: Callable[[Exact, Exact], list[Exact]], held: Exact, kappa: Exact, last: Exact) -> Exact:
    """Return L of the stable state at a load or an approach `held`; raise ValueError beyond the last state."""
    if held < sum(terms(last, kappa)):
        raise ValueError
    return _root(lambda L: sum(terms(L, kappa)) - held, last, 10 * last + 10 + 2 * held)


EQUATIONS: Mapping[str, Callable[..., Exact]] = {
    # a rigid sphere of true shape
    "indenter_radius": _rigid_on_soft_plane,
    "elastoadhesive_ratio": lambda w, E, R_i: w / (E * R_i),
    "artanh_at_pull_off": lambda kappa: sphere_last(kappa, 3),
    "artanh_at_fold": lambda kappa: sphere_last(kappa, 1),
    "artanh_at_load": lambda P, E, R_i, kappa, L_pull: sphere_state(sphere_load, P / (E * R_i**2), kappa, L_pull),
    "artanh_at_approach": lambda delta, R_i, kappa, L_fold: sphere_state(sphere_approach, delta / R_i, kappa, L_fold),
    "unloaded_artanh": lambda kappa, L_pull: sphere_state(sphere_load, mpf(0), kappa, L_pull),
    "pull_off_force_sphere": lambda L_pull, kappa, R_i, E: -sum(sphere_load(L_pull, kappa)) * E * R_i**2,
    "load_sphere": lambda L, kappa, R_i, E: sum(sphere_load(L, kappa)) * E * R_i**2,
    "contact_radius_sphere": lambda L, R_i: digits.tanh(L) * R_i,
    "unloaded_radius_sphere": lambda L_0, R_i: digits.tanh(L_0) * R_i,
    "contact_radius_at_pull_off_sphere": lambda L_pull, R_i: digits.tanh(L_pull) * R_i,
    "contact_radius_at_fold_sphere": lambda L_fold, R_i: digits.tanh(L_fold) * R_i,
    "approach_sphere": lambda L, kappa, R_i: sum(sphere_approach(L, kappa)) * R_i,
    "unloaded_approach_sphere": lambda L_0, kappa, R_i: sum(sphere_approach(L_0, kappa)) * R_i,
    "approach_at_pull_off_sphere": lambda L_pull, kappa, R_i: sum(sphere_approach(L_pull, kappa)) * R_i,
    "approach_at_fold_sphere": lambda L_fold, kappa, R_i: sum(sphere_approach(L_fold, kappa)) * R_i,
    "stiffness_sphere": lambda L, kappa, R_i, E: sphere_stiffness(L, kappa) * E * R_i,
    "contact_over_sphere_of_ratio": lambda kappa: cbrt(9 * pi * kappa / 2),
    "strain_of_contact": lambda a, R_i: 2 * a / (pi * R_i),
    "work_of_adhesion_of_hamaker": lambda A1, A2, D0: sqrt(A1 * A2) / (12 * pi * D0**2),
    "atomic_spacing_of_cutoff": lambda D0: D0 * sqrt(mpf(3)) / 2,
    # any law
    "adhesive_force": lambda P_c, x: 4 * P_c * x,
    "unloaded_moment_of_radius": lambda a0, E, R, xi: 4 * E * a0**3 * xi / (3 * R),
    "yield_force_of_moment": lambda M, R1: M / R1,
    "yield_force_ratio_of_forces": lambda Q, P_c: Q / P_c,
    "rolling_frequency_no_slip_of_stiffness": lambda k, R, m_eff: sqrt(k / (R**2 * m_eff)) / (2 * pi),
    "yield_energy_of_moment": lambda M, xi, R: M * xi / (2 * R),
    "hysteresis_moment": lambda c, R, dw: 2 * c * R * dw,
    "adhesion_hysteresis_of_fraction": lambda part, w: part * w,
    "yield_displacement_at_hysteresis": lambda c, R, dw, F_a: 2 * c * R * dw / F_a,
    "hysteresis_ratio": lambda M, c, R, w: M / (2 * c * R * w),
    # DMT
    "contact_radius_dmt": lambda P, w, R, E: cbrt(3 * R * (P + 2 * pi * w * R) / (4 * E)),
    "contact_radius_dmt_at_approach": lambda delta, R: sqrt(R * delta),
    "unloaded_radius_dmt": lambda w, R, E: cbrt(3 * pi * w * R**2 / (2 * E)),
    "unloaded_approach_dmt": lambda w, R, E: cbrt(3 * pi * w * R**2 / (2 * E)) ** 2 / R,
    "approach_dmt": lambda a, R: a**2 / R,
    "load_dmt": lambda a, w, R, E: 4 * E * a**3 / (3 * R) - 2 * pi * w * R,
    "stiffness_dmt": lambda a, E: 2 * E * a,
    "adhesive_force_dmt": lambda w, R: 2 * pi * w * R,
    "contact_displacement_dmt": lambda a: 0 * a,
    # from JKR to DMT
    "transition_parameter": lambda mu: 32 / (9 * sqrt(mpf(3))) * cbrt(9 / (16 * pi)) * mu,
    "cohesive_stress": lambda w, z0: 16 * w / (9 * sqrt(mpf(3)) * z0),
    "pull_off_force_lennard_jones": lambda w, R, mu: (
        pi * w * R * (mpf("1.5") + mpf("0.5") / (1 + mpf("1.95") * mu ** mpf("1.4")))
    ),
    "well_energy_lennard_jones": lambda w, R, z0, mu: (
        pi * w * R * z0 * (RIGID_WELL + mpf(3.508) * mu / (1 + mpf(0.3652) * mu ** mpf(-0.5175)))
    ),
    "dead_load_work_lennard_jones": lambda w, R, z0, mu: (
        pi * w * R * z0 * (
            RIGID_WELL - mpf(18) / 7 + mpf(12.894) * mu ** mpf(1.613) / (1 + mpf(3.608) * mu ** mpf(0.924))
        )
    ),
    "pull_off_force_rough": lambda P_DMT, R, s_a, D0: P_DMT * (s_a / (s_a + R) + 1 / (1 + s_a / D0) ** 2),
    # water
    "kelvin_radius": lambda h: KELVIN_LENGTH / digits.log(1 / h),
    "meniscus_size": lambda r_K, R, theta_c: first_order(theta_c) * sqrt(r_K / R),
    "meniscus_force": lambda R, theta_c, q_men: 4 * pi * R * mpf(0.072) * digits.cos(theta_c) * (1 - q_men),
    "threshold_humidity": lambda D, theta_c: digits.exp(-2 * digits.cos(theta_c) * KELVIN_LENGTH / D),
    # viscous damping
    "viscosity_number": lambda T_vis, nu1, nu2, E, a0, m: T_vis / (nu1 * nu2) * sqrt(E * a0 / m),
    "sticking_speed_viscous": lambda U_stick, m, T_star: slowed(T_star) * sqrt(2 * U_stick / m),
    # Maugis' law: units, and states
    "length_unit_maugis": length_unit,
    "approach_unit_maugis": lambda w, R, E: length_unit(w, R, E) ** 2 / R,
    "energy_unit_maugis": lambda w, R, d_M: pi * w * R * d_M,
    "edge_ratio_at_load": lambda P, w, R, lambda_: ratio(*maugis.at_load(lambda_, P / (pi * w * R))),
    "edge_ratio_at_approach": lambda delta, d_M, lambda_: ratio(*maugis.held_at(lambda_, delta / d_M)),
    "zone_span": lambda edge, l_M, lambda_: span(edge, lambda_) * l_M,
    "zone_span_at_approach": lambda edge, delta, l_M, d_M, lambda_: (
        l_M * (span(edge, lambda_) if edge else maugis.zone_apart(lambda_, delta / d_M))
    ),
    "unloaded_edge_ratio": lambda lambda_: ratio(*maugis.at_load(lambda_, mpf(0))),
    "unloaded_radius_maugis": lambda edge0, l_M, lambda_: (
        cbrt(attraction(edge0, span(edge0, lambda_), lambda_ / 2)) * l_M
    ),
    "unloaded_approach_maugis": lambda edge0, a_M, E, sigma0: (
        3 * attraction(edge0, a_M / edge0, sigma0) / (4 * E * a_M) - 2 * sigma0 * a_M / (E * edge0)
    ),
    "edge_ratio_at_pull_off": lambda lambda_: ratio(*maugis.pull_off(lambda_)),
    "pull_off_force_maugis": lambda w, R, lambda_: -maugis.load(*maugis.pull_off(lambda_), lambda_) * pi * w * R,
    "contact_radius_at_pull_off_maugis": lambda edge_c, l_M, lambda_: edge_c * span(edge_c, lambda_) * l_M,
    "contact_radius_at_fold_maugis": lambda edge_fold, l_M, lambda_: (
        edge_fold * span(edge_fold, lambda_) * l_M if edge_fold else mpf(0)
    ),
    "approach_at_pull_off_maugis": lambda edge_c, d_M, lambda_: sum(approach_terms(edge_c, lambda_)) * d_M,
    "edge_ratio_at_fold": lambda lambda_: ratio(*maugis.fold(lambda_)) if maugis.folds_in_contact(lambda_) else mpf(0),
    "fold_approach_maugis": lambda d_M, lambda_: maugis.lowest_approach(lambda_) * d_M,
    # Maugis' law: quantities of a state
    "contact_radius_maugis": lambda edge, T: edge * T,
    "zone_radius": lambda edge, T: T * sqrt(1 + edge**2),
    "approach_maugis": lambda edge, T, R, E, sigma0: (edge * T) ** 2 / R - 2 * sigma0 * T / E,
    "approach_maugis_at_load": lambda P, edge, T, R, E, sigma0: (
        3 * P / (4 * E * edge * T) + sigma0 * T / (2 * E) * (3 * (edge + 1 / edge) * angle(edge) - 1)
        if edge > 1
        else (edge * T) ** 2 / R - 2 * sigma0 * T / E
    ),
    "load_maugis": lambda edge, T, R, E, sigma0: hertz(edge, T, R, E) - attraction(edge, T, sigma0),
    "stiffness_maugis": slope,
    "adhesive_force_maugis": attraction,
    "contact_displacement_maugis": lambda edge, T, R, E, sigma0, xi: (
        xi / (1 + E * T / (sigma0 * R)) if edge else None
    ),
    # Maugis' law: energies
    "state_energy_maugis": lambda edge, T, l_M, U_M, lambda_: sum(state_energy(edge, T, l_M, U_M, lambda_)),
    "well_energy_maugis": lambda edge0, U_M, lambda_: well(edge0, lambda_) * U_M,
    "pull_off_work_maugis": lambda edge0, U_M, lambda_: (maugis.fold_energy(lambda_) + well(edge0, lambda_)) * U_M,
    "pull_off_work_at_dead_load_maugis": lambda edge0, U_M, lambda_: (
        (maugis.contact_energy(*maugis.pull_off(lambda_), lambda_) + well(edge0, lambda_)) * U_M
    ),
    "fold_energy_maugis": lambda P_c, fold: -P_c * fold,
    "sticking_energy_maugis": lambda U_M, lambda_: sticking(lambda_) * U_M,
}  # fmt: skip

# The largest term of each formula whose terms may cancel.
TERMS: Mapping[str, Callable[..., Exact]] = {
    "load_sphere": lambda L, kappa, R_i, E: max(map(abs, sphere_load(L, kappa))) * E * R_i**2,
    "approach_sphere": lambda L, kappa, R_i: max(map(abs, sphere_approach(L, kappa))) * R_i,
    "unloaded_approach_sphere": lambda L_0, kappa, R_i: max(map(abs, sphere_approach(L_0, kappa))) * R_i,
    "approach_at_pull_off_sphere": lambda L_pull, kappa, R_i: max(map(abs, sphere_approach(L_pull, kappa))) * R_i,
    "approach_at_fold_sphere": lambda L_fold, kappa, R_i: max(map(abs, sphere_approach(L_fold, kappa))) * R_i,
    "load_dmt": lambda a, w, R, E: max(4 * E * a**3 / (3 * R), 2 * pi * w * R),
    "approach_maugis": lambda edge, T, R, E, sigma0: max((edge * T) ** 2 / R, 2 * sigma0 * T / E),
    "approach_maugis_at_load": lambda P, edge, T, R, E, sigma0: (
        max(3 * abs(P) / (4 * E * edge * T), sigma0 * T / (2 * E) * 3 * (edge + 1 / edge) * angle(edge))
        if edge > 1
        else max((edge * T) ** 2 / R, 2 * sigma0 * T / E)
    ),
    "approach_at_pull_off_maugis": lambda edge_c, d_M, lambda_: max(map(abs, approach_terms(edge_c, lambda_))) * d_M,
    "load_maugis": lambda edge, T, R, E, sigma0: max(hertz(edge, T, R, E), attraction(edge, T, sigma0)),
    "sticking_energy_maugis": lambda edge0, U_M, lambda_: (
        (well(edge0, lambda_) if lambda_**3 > mpf(9) / 32 else sticking(lambda_)) * U_M
    ),
    "state_energy_maugis": lambda edge, T, l_M, U_M, lambda_: max(map(abs, state_energy(edge, T, l_M, U_M, lambda_))),
}

# The parameters of the condition number of a formula; its error is stated in ulp·(1 + condition number).
CONDITIONED: Mapping[str, tuple[str, ...]] = {
    "contact_radius_dmt": ("load",),
    "threshold_humidity": ("roughness_gap",),
    "artanh_at_load": ("load", "artanh_at_pull_off"),
    "artanh_at_approach": ("approach_at_load", "artanh_at_fold"),
    "stiffness_sphere": ("contact_artanh", "elastoadhesive_ratio"),
    "yield_speed": ("first_yield_pressure", "touch_pressure"),
    "plastic_speed": ("plastic_pressure", "touch_pressure"),
    "sticking_speed_viscous": ("viscosity_number",),
    "edge_ratio_at_load": ("load", "transition_parameter"),
    "edge_ratio_at_approach": ("approach_at_load", "transition_parameter"),
    "zone_span_at_approach": ("approach_at_load", "transition_parameter"),
    "stiffness_maugis": ("edge_ratio", "zone_span", "cohesive_stress"),
    "unloaded_edge_ratio": ("transition_parameter",),
    "edge_ratio_at_fold": ("transition_parameter",),
}
