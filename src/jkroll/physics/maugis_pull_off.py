"""The law of attraction between JKR and DMT, and the forces and moments that follow: pull-off and rolling."""

from . import dugdale
from .dimensions import Force, Length, Number, Stress, SurfaceEnergy
from .elementary import pi

TRANSITION_OVER_TABOR = 1.1570116348507993  # (32/(9√3))·(9/(16π))^(1/3)


def transition_parameter(*, tabor_parameter: Number) -> Number:
    """Maugis' parameter of the transition between JKR (large) and DMT (small).

        λ = 2σ0/(πwK²/R)^(1/3) = (32/(9√3))(9/16π)^(1/3) μ, with K = 4E*/3

    Source:   Maugis 1992, for the peak stress of the 3-9 law.
    Valid:    Always.
    Accuracy: 1 ulp above μ.

    >>> round(transition_parameter(tabor_parameter=1.0), 7)
    1.1570116
    """
    return TRANSITION_OVER_TABOR * tabor_parameter


def cohesive_stress(*, work_of_adhesion: SurfaceEnergy, atomic_spacing: Length) -> Stress:
    """Largest stress with which two surfaces attract.

        σ0 = 16w/(9√3 z0)

    Source:   The peak of the 3-9 law that the Lennard-Jones potential gives for two half-spaces.
    Valid:    Its range, w/σ0 = 0.974 z0, follows from it.
    Accuracy: 2 ulp.

    >>> round(cohesive_stress(work_of_adhesion=9.0, atomic_spacing=16.0), 7)
    0.5773503
    """
    return 1.0264004785593346 * (work_of_adhesion / atomic_spacing)


def pull_off_force_maugis(
    *, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, transition_parameter: Number
) -> Force:
    """Force that separates two spheres, between (3/2)πwR for soft, large ones and 2πwR for hard, small ones.

        P_c = 2σ0(aT + c²θ) − 4E*a³/(3R) at the edge ratio of pull-off

    Source:   Maugis 1992.
    Valid:    Always; a Lennard-Jones pair lets go up to 6 % later.
    Accuracy: 6 ulp.

    >>> round(pull_off_force_maugis(work_of_adhesion=1 / pi, reduced_radius=1.0, transition_parameter=1.0), 7)
    1.6007349
    """
    at = dugdale.shape(dugdale.pull_off_ratio(transition_parameter))
    least = dugdale.load(transition_parameter, at, dugdale.span(transition_parameter, at))
    return -pi * work_of_adhesion * reduced_radius * least


def pull_off_force_lennard_jones(
    *, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, tabor_parameter: Number
) -> Force:
    """Force that separates two spheres that attract by the 3-9 law of the Lennard-Jones potential.

        P_c = πwR(3/2 + ½/(1 + 1.95 μ^1.4))

    Source:   Fit to numerical solutions of the elastic half-space; tests/tools/lennard_jones.py makes them.
    Valid:    Within 0.3 % for 0.01 ≤ μ ≤ 2.
    Accuracy: As the fit.

    >>> round(pull_off_force_lennard_jones(work_of_adhesion=1 / pi, reduced_radius=1.0, tabor_parameter=1.0), 4)
    1.6695
    """
    return pi * work_of_adhesion * reduced_radius * (1.5 + 0.5 / (1 + 1.95 * tabor_parameter**1.4))


def adhesive_force_maugis(*, edge_ratio: Number, zone_span: Length, cohesive_stress: Stress) -> Force:
    """Hertz' load at the contact radius less the load: the rolling moment per displacement of the ring of attraction.

        F_a = 4E*a³/(3R) − P = 2σ0(aT + c²θ), θ = arctan(1/v)

    Source:   Maugis 1992.
    Valid:    In contact or apart.
    Accuracy: 4 ulp above v and T.

    >>> adhesive_force_maugis(edge_ratio=0.0, zone_span=1.0, cohesive_stress=1 / pi)
    1.0
    """
    return 2 * cohesive_stress * zone_span * zone_span * dugdale.shape(edge_ratio).g3


def contact_displacement(
    *,
    zone_span: Length,
    reduced_radius: Length,
    contact_modulus: Stress,
    cohesive_stress: Stress,
    yield_displacement: Length,
) -> Length:
    """Displacement of the contact circle when its ring of attraction lags behind by ξ: ξ in JKR, 0 in DMT.

        ξ_contact = ξ/(1 + E*T/(σ0R))

    Source:   First order in ξ.
    Valid:    ξ ≪ a.
    Accuracy: 3 ulp above T.

    >>> contact_displacement(zone_span=1.0, reduced_radius=1.0, contact_modulus=1.0, cohesive_stress=1.0,
    ...                      yield_displacement=2.0)
    1.0
    """
    return yield_displacement / (1 + contact_modulus / cohesive_stress * (zone_span / reduced_radius))
