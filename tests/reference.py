"""The exact value of each result: the paper's equations in 120-digit arithmetic, in their plainest form.

Inputs are doubles and count as exact. No equation is rearranged to save digits. The worst cancellation, in the rolling
of spheres whose radii differ by a factor of 1e15, leaves 76 digits. This module takes only the defaults of inputs from
`jkroll`.
"""

# ruff: noqa: N803  (the paper's symbols)

import math
from collections.abc import Callable, Mapping
from functools import cache
from types import MappingProxyType

import law_reference
from jkroll.quantities.nomenclature import DEFAULTS
from maugis_reference import Exact, cbrt, digits, mpf, pi, sqrt

FOLD = -cbrt(mpf(9) / 16)  # δ̂, where dδ/dâ = 0

# Bounds of the errors in ulp·(1 + κ): of the largest error, of the median over all results, and of the median for each
# name. The first and the last arise from the rounding of moduli and of a contact radius, which products and third
# powers multiply.
BOUND, MEDIAN, MEDIAN_OF_A_NAME = 15.0, 0.55, 1.5


def ulp_error(value: float, exact: Exact, of: Exact = None) -> float:
    """Return the distance of a double from the exact value, in ulp of the nearest double (or of another number)."""
    nearest = float(exact)
    if not math.isfinite(value) or not math.isfinite(nearest):
        return 0.0 if value == nearest else math.inf
    unit = math.ulp(nearest if of is None else float(of))
    return abs((value - nearest) / unit - float(exact - nearest) / unit)


@cache
def root(approach_ratio: Exact) -> Exact:
    """Return √â at an approach: 3y⁴ − 2y = δ̂ is convex, so that Newton's steps from above do not pass its root."""
    if approach_ratio < FOLD:
        raise ValueError("no contact")
    y = 1 + sqrt(sqrt(abs(approach_ratio)))
    step = mpf(1)
    while abs(step) > abs(y) * mpf(10) ** (-digits.dps // 2):  # the last step squares this
        step = (3 * y**4 - 2 * y - approach_ratio) / (12 * y**3 - 2)
        y -= step
    return y


def exact_results(given: Mapping[str, float]) -> dict[str, Exact]:
    """Return every result for one scene, each from its equation and the exact values of earlier results.

    Sphere 2 takes missing inputs from sphere 1, and its radius may be infinite. The contact is in the state at a load
    or, if `approach_at_load` is given, at an approach.
    """
    values = values_in(given)
    names = {*EQUATIONS, *OF_A_SCENE, "load"} - {*law_reference.EQUATIONS, *AT_AN_APPROACH.values(), *NO_RESULTS}
    names |= {"adhesive_force", *values.routes.values()}
    results = {name: values.get_exact(name) for name in sorted(names - given.keys())}
    if abs(values["load_margin"]) < 1e-7:  # rounding of the load may put it at pull-off
        del results["rolling_over_sliding"]
    if values["load"] / values["pull_off_force"] < 1e-12:  # the load at an approach is 0 but for rounding
        del results["rolling_resistance_coefficient"]
    return {name: value for name, value in results.items() if value is not None}


def values_in(given: Mapping[str, float]) -> "Values":
    """Return the values of a scene: the given values, and others as they are needed."""
    known = {name: mpf(value) for name, value in {**DEFAULTS, **given}.items()}
    values = Values({name + "2": value for name, value in known.items()} | known)
    if "approach_at_load" in known:
        del values["load"]
        values.routes = AT_AN_APPROACH
    if "speed" in known and "energy" not in known:
        values["energy"] = values["kinetic_energy"]
    return values


class Values(dict[str, Exact]):
    """The values of a scene: the given values, and values from equations as they are needed."""

    routes: Mapping[str, str] = MappingProxyType({})  # the chosen equations of quantities that have several

    def __missing__(self, name: str) -> Exact:
        equation = OF_A_SCENE.get(name) or EQUATIONS[self.routes.get(name, name)]
        self[name] = value = equation(*(self[parameter] for parameter in parameters(equation)))
        return value

    def get_exact(self, name: str) -> Exact | None:
        """Return a value; None if the scene lacks an input, or the equation has no real value."""
        try:
            value = self[name]
        except (KeyError, ValueError, ZeroDivisionError):
            return None
        return value if isinstance(value, digits.mpf) else None


def released(y: Exact, y2: Exact) -> Exact:
    """Return the energy that the contact releases from √â = y to y2, in P_cδ0: −∫ P̂ (dδ̂/dy) dy by Eqs (5) and (6)."""
    return _potential(y) - _potential(y2)


def _potential(y: Exact) -> Exact:
    """Return ∫ 4(y⁶ − y³)(12y³ − 2) dy."""
    return 24 * y**10 / 5 - 8 * y**7 + 2 * y**4


FOLD_ROOT, PULL_OFF_ROOT, JUMP_IN_ROOT = 1 / cbrt(mpf(6)), 1 / cbrt(mpf(2)), cbrt(mpf(2) / 3)  # √â of states
ENERGIES = {  # in P_cδ0
    "well_energy": released(mpf(0), mpf(1)),
    "pull_off_work": released(FOLD_ROOT, mpf(1)),
    "pull_off_work_at_dead_load": released(PULL_OFF_ROOT, mpf(1)),
    "sticking_energy": released(FOLD_ROOT, JUMP_IN_ROOT),
}


def conditions(given: Mapping[str, float], results: Mapping[str, Exact]) -> dict[str, float]:
    """Return κ of each result: the factor from a relative error of another number to that of the result.

    The other number is the given load or approach; for the speeds at which a solid yields, a pressure; and for the
    restitution, v_stick.
    """
    state = "approach_at_load" if "approach_at_load" in given else "load"
    found = dict.fromkeys(results, 0.0)
    if given.get(state):
        step = mpf(10) ** -40
        moved = exact_results({**given, state: mpf(given[state]) * (1 + step)})
        found = {name: _ratio(moved[name] - value, step * value) for name, value in results.items()}
    for name, pressure in (("yield_speed", "first_yield_pressure"), ("plastic_speed", "plastic_pressure")):
        if results.get(name):  # near the pressure of a touch, the error is that of both pressures
            over_touch, energy = results[pressure] / results["touch_pressure"], results["adhesion_energy"]
            step = mpf(10) ** -40
            moved = _speed_to(over_touch * (1 + step), results["reduced_mass"], energy)
            found[name] = 2 * _ratio(moved - results[name], step * results[name])
    if results.get("restitution"):  # near v_stick, the error is that of v_stick
        found["restitution"] = float(1 / results["restitution"] ** 2 - 1)
    return found


def _ratio(value: Exact, other: Exact) -> float:
    return float(abs(value / other)) if other and abs(other) < math.inf else 0.0


def exact(formula: str, arguments: Mapping[str, float]) -> Exact:
    """Return the exact value of a formula at exact arguments; other quantities follow from their equations."""
    return _evaluate(EQUATIONS[formula], arguments)


def scale(formula: str, arguments: Mapping[str, float]) -> Exact:
    """Return the reference for a formula's relative error: its value or, if terms may cancel, the largest term."""
    return abs(_evaluate(TERMS[formula], arguments) if formula in TERMS else exact(formula, arguments))


def formula_error(formula: str, arguments: Mapping[str, float], value: float) -> float:
    """Return the error of a formula's value in ulp·(1 + κ), or in ulp of the variable that MEASURED has for it."""
    if formula in OF_A_RATIO:
        arguments = {"approach_at_load": arguments["approach_at_load"] / arguments["approach"], "approach": 1.0}
    if formula in MEASURED:
        variable_of = MEASURED[formula]
        wanted = variable_of(exact(formula, arguments))
        return float(abs(variable_of(mpf(value)) - wanted)) / math.ulp(float(wanted))
    error = ulp_error(value, exact(formula, arguments), of=scale(formula, arguments))
    return error / (1 + condition(formula, arguments))


def condition(formula: str, arguments: Mapping[str, float]) -> float:
    """Return κ: the factor from relative errors of the arguments in CONDITIONED to that of a formula's value."""
    value, step = exact(formula, arguments), mpf(10) ** -20
    names = law_reference.CONDITIONED.get(formula, ())
    moved = (exact(formula, {**arguments, name: mpf(arguments[name]) * (1 + step)}) for name in names)
    return sum(_ratio(each - value, step * value) for each in moved)


def _evaluate(equation: Callable[..., Exact], arguments: Mapping[str, float]) -> Exact:
    values = Values({name: mpf(value) for name, value in arguments.items()})
    return equation(*(values[name] for name in parameters(equation)))


@cache
def parameters(equation: Callable[..., Exact]) -> list[str]:
    """Return the names of the quantities that an equation takes, by symbol or by name."""
    return [SYMBOLS.get(symbol, symbol) for symbol in equation.__code__.co_varnames[: equation.__code__.co_argcount]]


@cache
def inputs_of(name: str) -> frozenset[str]:
    """Return the inputs on which a quantity depends; for an input, itself."""
    reached: set[str] = set()
    pending = [name]
    while pending:
        each = pending.pop()
        if each not in reached:
            reached.add(each)
            pending += parameters(OF_A_SCENE.get(each) or EQUATIONS[each]) if _has_equation(each) else ()
    return frozenset(each for each in reached if not _has_equation(each))


def _has_equation(name: str) -> bool:
    return name in OF_A_SCENE or name in EQUATIONS


SYMBOLS = {
    **law_reference.SYMBOLS,
    "R1": "radius", "R2": "radius2", "R": "reduced_radius", "q": "radius_ratio",
    "gamma1": "surface_energy", "gamma2": "surface_energy2", "w": "work_of_adhesion",
    "E1": "youngs_modulus", "E2": "youngs_modulus2", "E": "contact_modulus",
    "E_over_gamma": "modulus_over_energy", "nu1": "poisson_ratio", "nu2": "poisson_ratio2", "rho1": "density",
    "rho2": "density2",
    "g": "gravity",
    "m1": "mass", "m2": "mass2", "m": "reduced_mass", "m_eff": "rolling_mass",
    "I1": "moment_of_inertia", "I2": "moment_of_inertia2", "I": "reduced_moment_of_inertia",
    "P": "load", "P_c": "pull_off_force", "a0": "contact_radius", "delta0": "approach",
    "s": "load_margin", "x": "load_factor", "a": "contact_radius_at_load", "delta": "approach_at_load",
    "a_pull": "contact_radius_at_pull_off", "a_fold": "contact_radius_at_fold",
    "r": "distance", "p_H": "hertz_pressure", "p_B": "boussinesq_pressure",
    "K": "stiffness", "k": "rolling_stiffness", "xi": "yield_displacement", "M": "yield_moment",
    "mean_M": "mean_rolling_moment", "A": "half_circle_radius",
    "W0": "energy", "W": "energy_ratio", "v": "speed", "v_s": "sticking_speed",
    "sigma_y": "yield_strength", "p_max": "impact_pressure", "p_touch": "touch_pressure",
    "p_y": "first_yield_pressure", "p_pl": "plastic_pressure",
    "R_min": "r_min", "U_stick": "sticking_energy", "W_adhesion": "adhesion_energy", "W_yield": "yield_energy",
    "z0": "atomic_spacing", "limit": "displacement_limit",
    "tau": "shear_strength", "F_slide": "sliding_force", "s_slide": "sliding_displacement", "k_t": "twisting_stiffness",
    "M_twist": "twisting_moment", "phi_twist": "twisting_angle", "T_peel": "peeling_force", "a_peel": "peeling_radius",
    "T_over_slide": "peeling_over_sliding", "T_first": "sliding_or_peeling_force",
    "n": "monomers", "n_c": "contacts", "phi": "filling_factor", "E_roll": "roll_energy_quarter_turn",
    "E_roll_half": "roll_energy_half_turn",
    "E_break": "pull_off_work", "E_break_rule": "break_energy_dust_simulation", "E_restr": "restructuring_energy",
    "E_restr_1": "restructuring_energy_ormel", "E_disr": "disruption_energy",
    "E_disr_rule": "disruption_energy_dust_simulation",
    "A1": "hamaker", "A2": "hamaker2", "D0": "cutoff",
    "G": "contact_shear_modulus", "k_s": "tangential_stiffness", "f": "sliding_frequency", "f_R1": "rayleigh_frequency",
    "f_R2": "rayleigh_frequency2", "W_fold": "fold_energy",
    "M_0": "unloaded_moment", "theta": "rolling_angle", "E_stick_1": "sticking_energy_paszun_dominik",
    "E_stick_2": "sticking_energy_pencil_code",
    "X": "position_in_strip", "X_c": "position_in_circle", "b": "contact_half_width",
    "C": "load_constant",
    "R_c": "cylinder_radius", "E_strain": "plane_strain_modulus", "n_roll": "n_roll",
}  # fmt: skip


def _wave_speed(density: Exact, modulus: Exact, ratio: Exact) -> Exact:
    """Return the speed of a Rayleigh wave; 0 in a rigid sphere, which has no wave."""
    if modulus == math.inf:
        return mpf(0)
    return (mpf(0.8766) + mpf(0.1631) * ratio) * sqrt(modulus / (2 * (1 + ratio)) / density)


def _pressing(P: Exact) -> Exact:
    """Return a load that presses; raise ValueError for others, which have no coefficient."""
    if P <= 0:
        raise ValueError("no load that presses")
    return P


def _held(s: Exact) -> Exact:
    """Return the load margin √(1 + P/P_c) if it is not negative; raise ValueError for states beyond pull-off."""
    if s < 0:
        raise ValueError
    return s


def _sliding_or_peeling(T_peel: Exact, T_over_slide: Exact, s: Exact) -> Exact:
    """Return the force T = T_peel sin φ that reaches the strength of the remaining area; T_peel if no force does."""
    if T_over_slide <= 1:
        return T_peel

    def excess(angle: Exact) -> Exact:
        """Return how far T exceeds the strength of the remaining area, over that of the area at peeling."""
        left = (1 + s**2 + 2 * s * digits.cos(angle)) / (1 + s**2)
        return T_over_slide * digits.sin(angle) - cbrt(left) ** 2

    return T_peel * digits.sin(
        digits.findroot(excess, (mpf(0), pi / 2), solver="illinois", tol=mpf(10) ** -70, verify=False)
    )


def _root_below(start: Exact, function: Callable[[Exact], Exact], slope: Callable[[Exact], Exact]) -> Exact:
    """Return the root of a convex function by Newton's steps from a start beyond it."""
    root, step = start, mpf(1)
    while abs(step) > abs(root) * mpf(10) ** (-digits.dps // 2):  # the last step squares this
        step = function(root) / slope(root)
        root -= step
    return root


def _gained(y: Exact) -> Exact:
    """Return the energy from first touch to √â = y, in P_cδ0."""
    return -released(JUMP_IN_ROOT, y)


def _pressure_in_units(y: Exact) -> Exact:
    """Return the pressure at the centre of a contact with √â = y, in P_c/(πa0²)."""
    return 6 * y**2 - 2 / y


@cache
def _at_peak(energy: Exact) -> Exact:
    """Return √â at the peak of an impact with an energy, in P_cδ0."""
    start = mpf("1.08") + min(energy, (energy / 4) ** mpf("0.1"))
    return _root_below(start, lambda y: _gained(y) - energy, lambda y: 4 * (y**6 - y**3) * (12 * y**3 - 2))


def _speed_to(over_touch: Exact, m: Exact, W_adhesion: Exact) -> Exact:
    """Return the speed at which the peak pressure is a multiple, above 1, of the pressure of a touch."""
    if over_touch <= 1:
        raise ValueError
    ratio = over_touch * _pressure_in_units(_at_peak(mpf(0)))
    y = _root_below(sqrt(ratio) + 1, lambda y: 6 * y**3 - ratio * y - 2, lambda y: 18 * y**2 - ratio)
    return sqrt(2 * W_adhesion * _gained(y) / m)


def _yields_at(sigma_y: Exact, nu: Exact) -> Exact:
    """Return the peak pressure at which von Mises' stress on the axis of Hertz' contact equals the yield strength."""
    return sigma_y / _largest_stress(nu)


def _largest_stress(nu: Exact) -> Exact:
    """Return the largest von Mises stress over the peak pressure; 15 digits of its depth give 30 of the stress."""
    ratio = 1 + float(nu)
    low, high = 1e-9, 1.0
    for _ in range(60):
        z = (low + high) / 2
        is_before = ratio * (math.atan(1 / z) - z / (1 + z * z)) > 3 * z / (1 + z * z) ** 2
        low, high = (z, high) if is_before else (low, z)
    depth = mpf(low)
    return 3 / (2 * (1 + depth**2)) - (1 + nu) * (1 - depth * digits.atan(1 / depth))


def _shifted_pressure(X_c: Exact, a: Exact, E: Exact, R: Exact, xi: Exact, p_H: Exact, p_B: Exact) -> list[Exact]:
    """Return the pressures of Hertz, of a flat punch and of a tilted one."""
    profile = sqrt(1 - (X_c / a) ** 2)
    return [p_H * profile, p_B / profile, 2 * E * xi / (pi * R) * X_c / a / profile]


def _half_circle_pressure(r: Exact, A: Exact, delta: Exact, E: Exact, R: Exact) -> list[Exact]:
    """Return the terms of Eq (15), with p_H of Eq (8)."""
    profile, hertz = sqrt(1 - (r / A) ** 2), 2 * A * E / (pi * R)
    return [hertz * profile, E * delta / (pi * A) / profile, -hertz / 2 / profile]


# The equation of each formula.
EQUATIONS: Mapping[str, Callable[..., Exact]] = {
    # the pair
    "work_of_adhesion": lambda gamma1, gamma2: 2 * sqrt(gamma1 * gamma2),
    "diameter": lambda R1: 2 * R1,
    "radius_ratio": lambda R1, R2: R1 / R2,
    "reduced_radius": lambda R1, R2: 1 / (1 / R1 + 1 / R2),
    "contact_modulus": lambda E1, nu1, E2, nu2: 1 / ((1 - nu1**2) / E1 + (1 - nu2**2) / E2),
    "modulus_over_energy": lambda E, w: E / (w / 2),
    "contact_modulus_of_ratio": lambda E_over_gamma, w: E_over_gamma * w / 2,
    "mass": lambda R1, rho1: 4 * pi / 3 * R1**3 * rho1,
    "reduced_mass": lambda m1, m2: 1 / (1 / m1 + 1 / m2),
    "moment_of_inertia": lambda m1, R1: 2 * m1 * R1**2 / 5,
    "reduced_moment_of_inertia": lambda I1, I2: 1 / (1 / I1 + 1 / I2),
    "rolling_mass": lambda m1, m2, q: 14 / (25 / (m1 + m2) + 10 * (1 / m1 + q**2 / m2) / (1 + q) ** 2),
    # the contact
    "pull_off_force": lambda w, R: 3 * pi * w / 2 * R,
    "pull_off_force_dmt": lambda w, R: 4 * pi * w / 2 * R,
    "pull_off_force_ratio": lambda P_c, w, R: P_c / (pi * w * R),
    "contact_radius": lambda w, R, E: cbrt(9 * pi * w / 2 * R**2 / E),
    "approach": lambda w, R, E: cbrt(3 * pi**2 * (w / 2) ** 2 * R / E**2),
    "load_margin": lambda P, P_c: sqrt(1 + P / P_c),
    "load_factor": lambda s: (1 + s) / 2,
    "contact_radius_at_load": lambda a0, x: a0 * cbrt(x**2),
    "approach_at_load": lambda delta0, x: delta0 * (3 * cbrt(x) ** 4 - 2 * cbrt(x)),
    "contact_area": lambda a: pi * a**2,
    "contact_area_at_pull_off": lambda a_pull: pi * a_pull**2,
    "contact_area_at_fold": lambda a_fold: pi * a_fold**2,
    "contact_radius_at_pull_off": lambda a0: a0 * PULL_OFF_ROOT**2,
    "contact_radius_at_fold": lambda a0: a0 * FOLD_ROOT**2,
    "approach_at_pull_off": lambda delta0: delta0 * (3 * PULL_OFF_ROOT**4 - 2 * PULL_OFF_ROOT),
    "approach_at_fold": lambda delta0: delta0 * (3 * FOLD_ROOT**4 - 2 * FOLD_ROOT),
    "load_ratio": lambda P, P_c: P / P_c,
    "contact_radius_ratio": lambda a, a0: a / a0,
    "approach_ratio": lambda delta, delta0: delta / delta0,
    "stiffness": lambda E, a, s: 6 * E * a * s / (2 + 3 * s),
    "hertz_pressure": lambda a, E, R: 2 * a * E / (pi * R),
    "boussinesq_pressure": lambda p_H, x: -p_H / (3 * x),
    "pressure": lambda r, a, p_H, p_B: p_H * sqrt(1 - (r / a) ** 2) + p_B / sqrt(1 - (r / a) ** 2),
    "boussinesq_pressure_at_approach": lambda delta, a, E, p_H: E * delta / (pi * a) - p_H / 2,
    # the contact at any state
    "load_margin_of_factor": lambda x: 2 * x - 1,
    "load_at_factor": lambda P_c, x: 4 * P_c * (x**2 - x),
    "load_factor_at_approach": lambda delta, delta0: root(delta / delta0) ** 3,
    "load_margin_at_approach": lambda delta, delta0: 2 * root(delta / delta0) ** 3 - 1,
    "well_energy": lambda W_adhesion: ENERGIES["well_energy"] * W_adhesion,
    "pull_off_work": lambda W_adhesion: ENERGIES["pull_off_work"] * W_adhesion,
    "pull_off_work_at_dead_load": lambda W_adhesion: ENERGIES["pull_off_work_at_dead_load"] * W_adhesion,
    "sticking_energy": lambda W_adhesion: ENERGIES["sticking_energy"] * W_adhesion,
    # rolling
    "yield_moment": lambda F_a, xi: F_a * xi,
    "unloaded_moment": lambda P_c, xi: 4 * P_c * xi,
    "fixed_approach_moment": lambda M, E, a, xi, R: M + E * a * xi**3 / R,
    "rolling_stiffness": lambda F_a, R: F_a * R,
    "rolling_spring_constant": lambda k, R: k / R**2,
    "rolling_friction_coefficient": lambda M, R, P, P_c: M / R / (P + 2 * P_c),
    "rolling_resistance_coefficient": lambda M, R, P: M / R / _pressing(P),
    "yield_force": lambda w, x, xi, q: 6 * pi * w * x * xi / (1 + q),
    "yield_force_fixed_load": lambda M, R1, P, xi, R2: M / R1 - P * xi / R2,
    "yield_force_ratio": lambda x, xi, R1: 4 * x * xi / R1,
    "contact_displacement": lambda x, xi: (x > 0) * xi,
    "yield_angle": lambda xi, R: xi / R,
    "mean_rolling_moment": lambda M: M / 2,
    "mean_rolling_force": lambda mean_M, R1: mean_M / R1,
    "half_circles_moment": lambda M, E, a, xi, R: M + 2 * E * a * xi**3 / R,
    # chains
    "r_min": lambda R1, R2, xi: R1 * R2 / xi,
    "gravity_moment": lambda n, m1, g, R1: m1 * g * R1 * n**2,
    "n_grav": lambda M, m1, g, R1: sqrt(M / (m1 * g * R1)),
    "bond_number": lambda P_c, m1, g: P_c / (m1 * g),
    # vibrations
    "vertical_frequency": lambda K, m: sqrt(K / m) / (2 * pi),
    "rolling_frequency": lambda k, I: sqrt(k / I) / (2 * pi),  # noqa: E741
    "rolling_frequency_as_printed": lambda w, R1, rho1: 3 / (2 * pi) * sqrt(w / 2 / (5 * R1**3 * rho1)),
    "rolling_frequency_no_slip": lambda w, x, m_eff: sqrt(6 * pi * w * x / m_eff) / (2 * pi),
    # collisions
    "adhesion_energy": lambda w, R, E: 3 * pi * w * R / 2 * cbrt(3 * pi**2 * w**2 * R / (4 * E**2)),
    "energy": lambda W, W_adhesion: W * W_adhesion,
    "kinetic_energy": lambda m1, v: m1 * v**2 / 2,
    "initial_angular_speed": lambda W0, I1: sqrt(4 * W0 / (7 * I1)),
    "n_roll": lambda W0, mean_M: W0 / (7 * pi * mean_M),
    "n_roll_energy_balance": lambda W0, mean_M: W0 / (2 * pi * mean_M),
    "n_roll_after_impact": lambda W0, mean_M: 5 * W0 / 7 / (2 * pi * mean_M),
    "restitution": lambda v, v_s: sqrt(max(1 - (v_s / v) ** 2, mpf(0))),
    "lost_energy": lambda v, v_s, m: m * min(v, v_s) ** 2 / 2,
    # impacts
    "impact_pressure": lambda v, m, W_adhesion, P_c, a0: (
        P_c / (pi * a0**2) * _pressure_in_units(_at_peak(m * v**2 / 2 / W_adhesion))
    ),
    "touch_pressure": lambda P_c, a0: P_c / (pi * a0**2) * _pressure_in_units(_at_peak(mpf(0))),
    "first_yield_pressure": lambda sigma_y, nu1, nu2: _yields_at(sigma_y, min(nu1, nu2)),
    "plastic_pressure": lambda sigma_y: (2 + pi) * sigma_y / sqrt(mpf(3)),
    "yield_speed": lambda p_y, p_touch, m, W_adhesion: _speed_to(p_y / p_touch, m, W_adhesion),
    "plastic_speed": lambda p_pl, p_touch, m, W_adhesion: _speed_to(p_pl / p_touch, m, W_adhesion),
    "impact_pressure_over_modulus": lambda p_max, E: p_max / E,
    "impact_over_yield": lambda p_max, p_y: p_max / p_y,
    "speed_over_sound": lambda v, E1, E2, rho1, rho2: v / min(sqrt(E1 / rho1), sqrt(E2 / rho2)),
    # sliding
    "shear_modulus": lambda E1, nu1: E1 / (2 * (1 + nu1)),
    "contact_shear_modulus": lambda E1, nu1, E2, nu2: (
        1 / (2 * (2 - nu1) * (1 + nu1) / E1 + 2 * (2 - nu2) * (1 + nu2) / E2)
    ),
    "tangential_stiffness": lambda G, a: 8 * G * a,
    "sliding_frequency": lambda k_s, m: sqrt(7 * k_s / (2 * m)) / (2 * pi),
    "time_step": lambda f, f_R1, f_R2: 1 / max(20 * f, 5 * f_R1, 5 * f_R2),
    "rayleigh_time": lambda R1, rho1, E1, nu1: pi * R1 / _wave_speed(rho1, E1, nu1),
    "rayleigh_frequency": lambda R1, rho1, E1, nu1: _wave_speed(rho1, E1, nu1) / (pi * R1),
    # sliding and twisting, where the strength is reached
    "shear_strength": lambda E1, nu1, E2, nu2: 1 / max((1 + nu1) / E1, (1 + nu2) / E2) / (8 * pi**2),
    "sliding_force": lambda tau, a: pi * a**2 * tau,
    "sliding_displacement": lambda F_slide, k_s: F_slide / k_s,
    "sliding_energy": lambda F_slide, s_slide: F_slide * s_slide / 2,
    "twisting_stiffness": lambda E1, nu1, E2, nu2, a: 16 * a**3 / 3 / (2 * (1 + nu1) / E1 + 2 * (1 + nu2) / E2),
    "twisting_moment": lambda tau, a: 2 * pi * a**3 * tau / 3,
    "twisting_angle": lambda M_twist, k_t: M_twist / k_t,
    "twisting_energy": lambda M_twist, phi_twist: M_twist * phi_twist / 2,
    "twisting_frequency": lambda k_t, I: sqrt(k_t / I) / (2 * pi),  # noqa: E741
    "sliding_friction_coefficient": lambda F_slide, P, P_c: F_slide / (P + 2 * P_c),
    "twisting_friction_coefficient": lambda M_twist, P, P_c: M_twist / (P + 2 * P_c),
    "peeling_force": lambda P_c, s, G, E: 4 * P_c * _held(s) * sqrt(G / E),
    "peeling_radius": lambda w, R, E, s: cbrt(9 * pi * w * R**2 / (2 * E) * (1 + _held(s) ** 2) / 4),
    "sliding_or_peeling_force": lambda T_peel, T_over_slide, s: _sliding_or_peeling(T_peel, T_over_slide, _held(s)),
    "rolling_over_sliding": lambda Q, T_first: Q / T_first,
    "peeling_over_sliding": lambda T_peel, tau, a_peel: T_peel / (pi * a_peel**2 * tau),
    # aggregates
    "contacts": lambda n: n,
    "restructuring_energy": lambda E_roll: 5 * E_roll,
    "restructuring_speed": lambda E_restr, n, m1: sqrt(4 * E_restr / (n * m1)),
    "restructuring_speed_ormel": lambda E_restr_1, n, m1: sqrt(4 * E_restr_1 / (n * m1)),
    "disruption_energy": lambda E_break, n_c: 20 * n_c * E_break,
    "disruption_energy_dust_simulation": lambda E_break_rule, n_c: 20 * n_c * E_break_rule,
    "disruption_speed": lambda E_disr, n, m1: sqrt(4 * E_disr / (n * m1)),
    "disruption_speed_dust_simulation": lambda E_disr_rule, n, m1: sqrt(4 * E_disr_rule / (n * m1)),
    "compressive_strength": lambda E_roll_half, R1, phi: E_roll_half / R1**3 / (1 / phi - 1 / mpf("0.74")) ** 3,
    "tensile_strength": lambda w, R1, phi: mpf("0.6") * phi ** mpf("1.8") * w / 2 / R1,
    # conventions
    "fold_energy": lambda W_adhesion: cbrt(mpf(9) / 16) * W_adhesion,
    "break_energy_dust_simulation": lambda W_fold: mpf("1.8") * W_fold,
    "roll_energy": lambda M_0, theta: M_0 * theta,
    "roll_energy_quarter_turn": lambda M_0: M_0 * pi / 2,
    "roll_energy_half_turn": lambda M_0: M_0 * pi,
    "sticking_energy_paszun_dominik": lambda W_adhesion: 8 * pi / 3 * mpf("1.07") ** 2 / cbrt(81 * pi**5) * W_adhesion,
    "sticking_energy_pencil_code": lambda W_adhesion: mpf("19.2") / cbrt(81 * pi**5) * W_adhesion,
    "sticking_speed": lambda U_stick, m: sqrt(2 * U_stick / m),
    "sticking_speed_paszun_dominik": lambda E_stick_1, m: sqrt(2 * E_stick_1 / m),
    "sticking_speed_pencil_code": lambda E_stick_2, m: sqrt(2 * E_stick_2 / m),
    # validity
    "tabor_parameter": lambda w, R, E, z0: cbrt(R * w**2 / (E**2 * z0**3)),
    "displacement_limit": lambda a0, x: a0 / (3 * cbrt(x)),
    "displacement_ratio": lambda xi, limit: xi / limit,
    "contact_radius_in_spacings": lambda a, z0: a / z0,
    "hertz_pressure_over_modulus": lambda p_H, E: p_H / E,
    "profile_error": lambda a, R1, R2: a**2 * (1 / R1**3 + 1 / R2**3) / (4 * (1 / R1 + 1 / R2)),
    "displacement_over_contact_radius": lambda xi, a: xi / a,
    "r_min_over_radius": lambda R_min, R1: R_min / R1,
    "yield_energy": lambda w, xi, x: 3 * pi * w * x * xi**2,
    "energy_over_yield": lambda W0, W_yield: W0 / W_yield,
    "energy_over_sticking": lambda W0, U_stick: W0 / U_stick,
    "speed_over_sticking": lambda v, v_s: v / v_s,
    "flight_ratio": lambda W0, R1, R2, P_c: 2 * W0 / ((R1 + R2) * P_c),
    "contact_over_sphere": lambda a0, a, R1, R2: max(a0, a) / min(R1, R2),
    # the strip of Appendix A, corrected as the docstrings of jkroll.physics.cylinder state
    "asymmetric_pressure": lambda X, b, xi, R_c, E_strain, C: (
        E_strain / (2 * R_c) * (sqrt(b**2 - X**2) + (C - b**2 / 2 + xi * X) / sqrt(b**2 - X**2))
    ),
    "load_per_length": lambda R_c, E_strain, C: pi * E_strain / (2 * R_c) * C,
    "strip_moment": lambda b, xi, R_c, E_strain: pi * b**2 * E_strain / (4 * R_c) * xi,
    "contact_point_moment": lambda b, xi, R_c, E_strain, C: pi / 4 * E_strain / R_c * xi * (b**2 - 2 * C),
    "half_strips_moment": lambda b, xi, R_c, E_strain, C: (
        E_strain / (2 * R_c) * ((-((b - xi) ** 3) / 6 + C * (b - xi)) - (-((b + xi) ** 3) / 6 + C * (b + xi)))
    ),
    # the shifted circle of the figures
    "exact_pressure": lambda X_c, a, E, R, xi, p_H, p_B: sum(_shifted_pressure(X_c, a, E, R, xi, p_H, p_B)),
    "half_circle_pressure": lambda r, A, delta, E, R: sum(_half_circle_pressure(r, A, delta, E, R)),
    "unloaded_half_width": lambda w, R_c, E_strain: cbrt(32 * w * R_c**2 / (pi * E_strain)),
    **law_reference.EQUATIONS,
}

# Equations of quantities without a formula: those of sphere 2, and those that equal another quantity by definition.
OF_A_SCENE: Mapping[str, Callable[..., Exact]] = {
    "diameter2": lambda R2: 2 * R2,
    "shear_modulus2": lambda E2, nu2: E2 / (2 * (1 + nu2)),
    "mass2": lambda R2, rho2: 4 * pi / 3 * R2**3 * rho2,
    "rayleigh_frequency2": lambda R2, rho2, E2, nu2: _wave_speed(rho2, E2, nu2) / (pi * R2),
    "moment_of_inertia2": lambda m2, R2: 2 * m2 * R2**2 / 5,
    "restructuring_energy_ormel": lambda E_roll: E_roll,
}
# The equations of quantities whose usual equation needs a load.
AT_AN_APPROACH = {
    "load": "load_at_factor", "load_margin": "load_margin_of_factor", "load_factor": "load_factor_at_approach",
}  # fmt: skip
NO_RESULTS = ("boussinesq_pressure_at_approach", "initial_angular_speed")  # formulas that no plan uses

# Formulas whose accuracy is stated for the rounded ratio of two arguments.
OF_A_RATIO = ("load_factor_at_approach", "load_margin_at_approach")

# The variable in which a formula's accuracy is stated, as a function of the formula's value.
MEASURED: Mapping[str, Callable[[Exact], Exact]] = {"load_factor_at_approach": cbrt}

# The largest term of each formula whose terms may cancel.
TERMS: Mapping[str, Callable[..., Exact]] = {
    "approach_at_load": lambda delta0, x: delta0 * cbrt(x) * max(3 * x, 2),
    "load_margin_of_factor": lambda x: 2 * x,
    "load_margin_at_approach": lambda delta, delta0: 2 * root(delta / delta0) ** 3,
    "pressure": lambda r, a, p_H, p_B: max(p_H * sqrt(1 - (r / a) ** 2), abs(p_B) / sqrt(1 - (r / a) ** 2)),
    "boussinesq_pressure_at_approach": lambda delta, a, E, p_H: max(E * abs(delta) / (pi * a), p_H / 2),
    "yield_force_fixed_load": lambda M, R1, P, xi, R2: max(M / R1, abs(P * xi / R2)),
    "asymmetric_pressure": lambda X, b, xi, R_c, E_strain, C: (
        E_strain / (2 * R_c) * max(b**2 - X**2, abs(C), b**2 / 2, abs(xi * X)) / sqrt(b**2 - X**2)
    ),
    "contact_point_moment": lambda b, xi, R_c, E_strain, C: pi / 4 * E_strain / R_c * xi * max(b**2, 2 * abs(C)),
    "half_strips_moment": lambda b, xi, R_c, E_strain, C: E_strain / (2 * R_c) * xi * max(b**2, 2 * abs(C), xi**2 / 3),
    "exact_pressure": lambda X_c, a, E, R, xi, p_H, p_B: max(map(abs, _shifted_pressure(X_c, a, E, R, xi, p_H, p_B))),
    "half_circle_pressure": lambda r, A, delta, E, R: max(map(abs, _half_circle_pressure(r, A, delta, E, R))),
    **law_reference.TERMS,
}
