"""Named states of a Maugis contact: without load, at pull-off, and where fixed grips let go."""

from __future__ import annotations

from . import dugdale, dugdale_roots
from .dimensions import Force, Length, Number, Stress, SurfaceEnergy
from .elementary import pi


def unloaded_radius_maugis(
    *,
    work_of_adhesion: SurfaceEnergy,
    reduced_radius: Length,
    contact_modulus: Stress,
    transition_parameter: Number,
) -> Length:
    """Return the radius of the contact circle without load.

        a0 = (3R·2σ0T²G3/(4E*))^(1/3), where P = 0

    work_of_adhesion      [J/m²]  > 0
    reduced_radius        [m]     > 0
    contact_modulus       [Pa]    > 0
    transition_parameter  [1]     > 0

    Returns:  [m]; a float for floats, an array for arrays, which broadcast.
    Source:   Maugis 1992, by Newton's method.
    Valid:    a0 ≪ R.
    Accuracy: 4 ulp, times 1 plus its condition in λ.

    >>> from math import pi
    >>> unit = {"work_of_adhesion": 1 / pi, "reduced_radius": 1.0, "contact_modulus": 0.75}
    >>> round(unloaded_radius_maugis(transition_parameter=1.0, **unit), 7)
    1.6360905
    """
    at = dugdale.shape(dugdale_roots.ratio_at_load(transition_parameter, 0.0))
    unit = dugdale.length_unit(work_of_adhesion, reduced_radius, contact_modulus)
    return dugdale.unloaded_radius(transition_parameter, at, dugdale.span(transition_parameter, at)) * unit


def unloaded_approach_maugis(
    *,
    work_of_adhesion: SurfaceEnergy,
    reduced_radius: Length,
    contact_modulus: Stress,
    transition_parameter: Number,
) -> Length:
    """Return the approach of the centres without load.

        δ0 = (σ0T/E*)(3G3/(2v) − 2)

    work_of_adhesion      [J/m²]  > 0
    reduced_radius        [m]     > 0
    contact_modulus       [Pa]    > 0
    transition_parameter  [1]     > 0

    Returns:  [m]; a float for floats, an array for arrays, which broadcast.
    Source:   Maugis 1992, by Newton's method.
    Valid:    a0 ≪ R.
    Accuracy: 6 ulp, times 1 plus its condition in λ.

    >>> from math import pi
    >>> unit = {"work_of_adhesion": 1 / pi, "reduced_radius": 1.0, "contact_modulus": 0.75}
    >>> round(unloaded_approach_maugis(transition_parameter=1.0, **unit), 7)
    1.1298939
    """
    at = dugdale.shape(dugdale_roots.ratio_at_load(transition_parameter, 0.0))
    unit = dugdale.length_unit(work_of_adhesion, reduced_radius, contact_modulus)
    span = dugdale.span(transition_parameter, at)
    return dugdale.unloaded_approach(transition_parameter, at, span) * unit * (unit / reduced_radius)


def edge_ratio_at_pull_off(*, transition_parameter: Number) -> Number:
    """Return the edge ratio where the tension is largest, and a contact under a constant load breaks.

        q = vG3/D, q = 4λ/(3T)

    transition_parameter  [1]  > 0

    Returns:  [1]; a float for floats, an array for arrays, which broadcast.
    Source:   Maugis 1992; in closed form at a given v.
    Valid:    Always.
    Accuracy: 4 ulp.

    >>> round(edge_ratio_at_pull_off(transition_parameter=1.0), 7)
    0.9262053
    """
    return dugdale_roots.pull_off_ratio(transition_parameter)


def pull_off_force_maugis(
    *, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, transition_parameter: Number
) -> Force:
    """Return the force that separates two spheres, between (3/2)πwR for soft, large ones and 2πwR for hard, small ones.

        P_c = 2σ0(aT + c²θ) − 4E*a³/(3R) at the edge ratio of pull-off

    work_of_adhesion      [J/m²]  > 0
    reduced_radius        [m]     > 0
    transition_parameter  [1]     > 0

    Returns:  [N]; a float for floats, an array for arrays, which broadcast.
    Source:   Maugis 1992.
    Valid:    Always; a Lennard-Jones pair lets go up to 6 % later.
    Accuracy: 6 ulp.

    >>> round(pull_off_force_maugis(work_of_adhesion=1 / pi, reduced_radius=1.0, transition_parameter=1.0), 7)
    1.6007349
    """
    _, tension = dugdale_roots.pull_off(transition_parameter)
    return pi * work_of_adhesion * reduced_radius * tension


def edge_ratio_at_fold(*, transition_parameter: Number) -> Number:
    """Return the edge ratio where fixed grips let go; 0 where they hold on to spheres that attract without contact.

        q = G3/h, q = 4λ/(3T), if λ > (9π/(16(π − 1)))^(1/3) = 0.938

    transition_parameter  [1]  > 0

    Returns:  [1]; a float for floats, an array for arrays, which broadcast.
    Source:   Maugis 1992; Johnson & Greenwood 1997; in closed form at a given v.
    Valid:    Always.
    Accuracy: 4 ulp, times 1 plus its condition in λ.

    >>> edge_ratio_at_fold(transition_parameter=0.9)
    0.0
    """
    return dugdale_roots.fold_ratio(transition_parameter)


def fold_approach_maugis(
    *,
    work_of_adhesion: SurfaceEnergy,
    reduced_radius: Length,
    contact_modulus: Stress,
    transition_parameter: Number,
) -> Length:
    """Return the least approach at which fixed grips hold the spheres, in contact or apart.

        δ at q = G3/h, q = 4λ/(3T); −b²/2 − 2/(πλ), b = 8λ/3π, in the units of `dugdale`, if λ < 0.938

    work_of_adhesion      [J/m²]  > 0
    reduced_radius        [m]     > 0
    contact_modulus       [Pa]    > 0
    transition_parameter  [1]     > 0

    Returns:  [m]; a float for floats, an array for arrays, which broadcast.
    Source:   Maugis 1992; Johnson & Greenwood 1997.
    Valid:    Always.
    Accuracy: 10 ulp.

    >>> from math import pi
    >>> unit = {"work_of_adhesion": 1 / pi, "reduced_radius": 1.0, "contact_modulus": 0.75}
    >>> round(fold_approach_maugis(transition_parameter=1e-3, **unit), 4)
    -636.6198
    """
    unit = dugdale.length_unit(work_of_adhesion, reduced_radius, contact_modulus)
    return dugdale_roots.lowest_approach(transition_parameter) * unit * (unit / reduced_radius)
