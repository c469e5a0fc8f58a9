"""What limits the model, as numbers."""

from __future__ import annotations

from .dimensions import Energy, Force, Length, Number, Stress, SurfaceEnergy
from .elementary import cbrt, pi


def tabor_parameter(
    *, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, contact_modulus: Stress, atomic_spacing: Length
) -> Number:
    """Return the elastic stretch of the neck over the range of the surface forces: large for JKR, small for DMT.

        μ = (4Rγ²/(E*²z0³))^(1/3) = (Rw²/(E*²z0³))^(1/3)

    work_of_adhesion  [J/m²]  > 0
    reduced_radius    [m]     > 0
    contact_modulus   [Pa]    > 0
    atomic_spacing    [m]     > 0

    Returns:  [1]; a float for floats, an array for arrays, which broadcast.
    Source:   Tabor; text below Eq (1) on Muller, Yushenko and Derjaguin.
    Valid:    JKR above about 5, DMT below about 0.1, between them neither is exact.
    Accuracy: 2.5 ulp.

    >>> mu = tabor_parameter(
    ...     work_of_adhesion=0.05, reduced_radius=50e-9, contact_modulus=27.804e9, atomic_spacing=0.4e-9)
    >>> round(mu, 2)
    0.14
    """
    return cbrt((work_of_adhesion / contact_modulus / atomic_spacing) ** 2 * (reduced_radius / atomic_spacing))


def displacement_limit(*, contact_radius: Length, load_factor: Number) -> Length:
    """Return the displacement of the contact circle beyond which the model has no meaning: the leading edge would interpenetrate.

        a0/(3√â)

    contact_radius  [m]  > 0
    load_factor     [1]  > 0

    Returns:  [m]; a float for floats, an array for arrays, which broadcast.
    Source:   Stress intensity at the edge of the exact shifted circle, ∝ 1 − 3(ξ/a0)√â cos φ.
    Valid:    Circular contact.
    Accuracy: 2 ulp above a0 and x.

    >>> displacement_limit(contact_radius=3.0, load_factor=1.0)
    1.0
    """
    return contact_radius / cbrt(27 * load_factor)


def displacement_ratio(*, yield_displacement: Length, displacement_limit: Length) -> Number:
    """Displacement over its limit: above 1 the rolling moment has no meaning.

        3ξ√â/a0

    yield_displacement  [m]  > 0
    displacement_limit  [m]  > 0

    Returns:  [1]; a float for floats, an array for arrays, which broadcast.
    Source:   As the limit.
    Valid:    Always.
    Accuracy: 0.5 ulp above the limit.

    >>> displacement_ratio(yield_displacement=1.0, displacement_limit=2.0)
    0.5
    """
    return yield_displacement / displacement_limit


def contact_radius_in_spacings(*, contact_radius_at_load: Length, atomic_spacing: Length) -> Number:
    """Return the contact radius over the atomic spacing: elasticity needs many atoms in the contact.

        a/z0

    contact_radius_at_load  [m]  > 0
    atomic_spacing          [m]  > 0

    Returns:  [1]; a float for floats, an array for arrays, which broadcast.
    Source:   Text below Eq (27): "as these sizes the theory of elasticity is not longer applicable".
    Valid:    Elasticity holds well above 1.
    Accuracy: 0.5 ulp above a.

    >>> contact_radius_in_spacings(contact_radius_at_load=4e-9, atomic_spacing=0.5e-9)
    8.0
    """
    return contact_radius_at_load / atomic_spacing


def approach_in_spacings(*, approach: Length, atomic_spacing: Length) -> Number:
    """Return the approach without load over the atomic spacing: contact forces alone need a neck longer than their range.

        δ0/z0

    approach        [m]  > 0
    atomic_spacing  [m]  > 0

    Returns:  [1]; a float for floats, an array for arrays, which broadcast.
    Source:   Text above Fig. 1 on the assumptions of JKRS.
    Valid:    Another form of the Tabor parameter.
    Accuracy: 0.5 ulp above δ0.

    >>> approach_in_spacings(approach=4e-9, atomic_spacing=0.5e-9)
    8.0
    """
    return approach / atomic_spacing


def yield_energy(*, work_of_adhesion: SurfaceEnergy, yield_displacement: Length, load_factor: Number) -> Energy:
    """Return the energy to roll a contact to its yield displacement: with less, it springs back.

        M²/(2k) = 2P_c â^(3/2) ξ²/R = 3πw â^(3/2) ξ², which is 6πγξ² without load

    work_of_adhesion    [J/m²]  > 0
    yield_displacement  [m]     > 0
    load_factor         [1]     > 0

    Returns:  [J]; a float for floats, an array for arrays, which broadcast.
    Source:   Eqs (25) and (39).
    Valid:    As Eq (25).
    Accuracy: 3 ulp.

    >>> f"{yield_energy(work_of_adhesion=0.05, yield_displacement=2e-10, load_factor=1.0):.4e}"
    '1.8850e-20'
    """
    return 3 * pi * work_of_adhesion * load_factor * yield_displacement**2


def energy_over_yield(
    *, energy: Energy, work_of_adhesion: SurfaceEnergy, load_factor: Number, yield_displacement: Length
) -> Number:
    """Return the energy of sphere 1 over that which makes the contact yield: below 1 it does not roll.

        W0/(3πw â^(3/2) ξ²)

    energy              [J]     > 0
    work_of_adhesion    [J/m²]  > 0
    load_factor         [1]     > 0
    yield_displacement  [m]     > 0

    Returns:  [1]; a float for floats, an array for arrays, which broadcast.
    Source:   As the yield energy.
    Valid:    Always.
    Accuracy: 4 ulp above W0, w and x.

    >>> ratio = energy_over_yield(energy=18.849555921538759, work_of_adhesion=1.0, load_factor=1.0, yield_displacement=1.0)
    >>> round(ratio, 12)
    2.0
    """
    return energy / (3 * pi * work_of_adhesion * load_factor * yield_displacement**2)


def load_over_pull_off(*, load: Force, pull_off_force: Force) -> Number:
    """Return the load over the pull-off force: −1 at pull-off; the paper thinks of loads up to 1.

        P/P_c

    load            [N]  any; tension is negative
    pull_off_force  [N]  > 0

    Returns:  [1]; a float for floats, an array for arrays, which broadcast.
    Source:   Text above Eq (26).
    Valid:    P/P_c ≥ −1.
    Accuracy: 0.5 ulp above P_c.

    >>> load_over_pull_off(load=-1.0, pull_off_force=2.0)
    -0.5
    """
    return load / pull_off_force
