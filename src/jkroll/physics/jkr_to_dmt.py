"""From JKR to DMT: the parameter of the transition, the strength of attraction, and a fit of the pull-off force."""

from __future__ import annotations

from .dimensions import Force, Length, Number, Stress, SurfaceEnergy
from .elementary import pi

TRANSITION_OVER_TABOR = 1.1570116348507993  # (32/(9√3))·(9/(16π))^(1/3)


def transition_parameter(*, tabor_parameter: Number) -> Number:
    """Return Maugis' parameter of the transition between JKR (large) and DMT (small).

        λ = 2σ0/(πwK²/R)^(1/3) = (32/(9√3))(9/16π)^(1/3) μ, with K = 4E*/3

    tabor_parameter  [1]  > 0

    Returns:  [1]; a float for floats, an array for arrays, which broadcast.
    Source:   Maugis 1992, for the peak stress of the 3-9 law.
    Valid:    Always.
    Accuracy: 1 ulp above μ.

    >>> round(transition_parameter(tabor_parameter=1.0), 7)
    1.1570116
    """
    return TRANSITION_OVER_TABOR * tabor_parameter


def cohesive_stress(*, work_of_adhesion: SurfaceEnergy, atomic_spacing: Length) -> Stress:
    """Return the largest stress with which two surfaces attract.

        σ0 = 16w/(9√3 z0)

    work_of_adhesion  [J/m²]  > 0
    atomic_spacing    [m]     > 0

    Returns:  [Pa]; a float for floats, an array for arrays, which broadcast.
    Source:   The peak of the 3-9 law that the Lennard-Jones potential gives for two half-spaces.
    Valid:    Its range, w/σ0 = 0.974 z0, follows from it.
    Accuracy: 2 ulp.

    >>> round(cohesive_stress(work_of_adhesion=9.0, atomic_spacing=16.0), 7)
    0.5773503
    """
    return 1.0264004785593346 * (work_of_adhesion / atomic_spacing)


def pull_off_force_lennard_jones(
    *, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, tabor_parameter: Number
) -> Force:
    """Return the force that separates two spheres that attract by the 3-9 law of the Lennard-Jones potential.

        P_c = πwR(3/2 + ½/(1 + 1.95 μ^1.4))

    work_of_adhesion  [J/m²]  > 0
    reduced_radius    [m]     > 0
    tabor_parameter   [1]     > 0

    Returns:  [N]; a float for floats, an array for arrays, which broadcast.
    Source:   Fit to numerical solutions of the elastic half-space; tests/tools/lennard_jones.py makes them.
    Valid:    Within 0.3 % for 0.01 ≤ μ ≤ 2.
    Accuracy: As the fit.

    >>> round(pull_off_force_lennard_jones(work_of_adhesion=1 / pi, reduced_radius=1.0, tabor_parameter=1.0), 4)
    1.6695
    """
    return pi * work_of_adhesion * reduced_radius * (1.5 + 0.5 / (1 + 1.95 * tabor_parameter**1.4))
