"""The DMT contact: Hertz' contact, pressed together by a constant attraction 2πwR outside of the contact circle."""

from __future__ import annotations

from .dimensions import Force, Length, Stiffness, Stress, SurfaceEnergy
from .elementary import cbrt, cube, pi, sqrt, within


def contact_radius_dmt(
    *, load: Force, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, contact_modulus: Stress
) -> Length:
    """Return the radius of the contact circle under a load, in DMT.

        a = (3R(P + 2πwR)/(4E*))^(1/3)

    Source:   Derjaguin, Muller & Toporov 1975.
    Valid:    Small, hard spheres; P ≥ −2πwR. Below, a float raises ValueError and an array holds NaN.
    """
    pressed = load + 2 * pi * work_of_adhesion * reduced_radius
    return cbrt(3 / 4 * reduced_radius * within(pressed >= 0, pressed) / contact_modulus)


def contact_radius_dmt_at_approach(*, approach_at_load: Length, reduced_radius: Length) -> Length:
    """Return the radius of the contact circle at an approach, in DMT.

        a = √(Rδ)

    Source:   Hertz; Derjaguin, Muller & Toporov 1975.
    Valid:    δ ≥ 0. Below, a float raises ValueError and an array holds NaN.
    """
    return sqrt(within(approach_at_load >= 0, approach_at_load) * reduced_radius)


def unloaded_radius_dmt(*, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, contact_modulus: Stress) -> Length:
    """Return the radius of the contact circle without load, in DMT.

        a0 = (3πwR²/(2E*))^(1/3)

    Source:   Derjaguin, Muller & Toporov 1975.
    Valid:    Small, hard spheres.
    """
    return cbrt(3 / 2 * pi * work_of_adhesion * reduced_radius**2 / contact_modulus)


def unloaded_approach_dmt(
    *, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, contact_modulus: Stress
) -> Length:
    """Return the approach of the centres without load, in DMT.

        δ0 = a0²/R

    Source:   Derjaguin, Muller & Toporov 1975.
    Valid:    Small, hard spheres.
    """
    return cbrt(9 / 4 * pi**2 * work_of_adhesion**2 * reduced_radius / contact_modulus**2)


def approach_dmt(*, contact_radius_at_load: Length, reduced_radius: Length) -> Length:
    """Return the approach of the centres at a radius of the contact circle, in DMT.

        δ = a²/R

    Source:   Hertz; Derjaguin, Muller & Toporov 1975.
    Valid:    a ≪ R.
    """
    return contact_radius_at_load * contact_radius_at_load / reduced_radius


def load_dmt(
    *, contact_radius_at_load: Length, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, contact_modulus: Stress
) -> Force:
    """Return the load that holds a contact circle, in DMT.

        P = 4E*a³/(3R) − 2πwR

    Source:   Derjaguin, Muller & Toporov 1975.
    Valid:    a ≪ R.
    """
    hertz = 4 / 3 * contact_modulus * cube(contact_radius_at_load) / reduced_radius
    return hertz - 2 * pi * work_of_adhesion * reduced_radius


def stiffness_dmt(*, contact_radius_at_load: Length, contact_modulus: Stress) -> Stiffness:
    """Return the normal stiffness of the contact, in DMT.

        dP/dδ = 2E*a

    Source:   Hertz; Derjaguin, Muller & Toporov 1975.
    Valid:    a ≪ R.
    """
    return 2 * contact_modulus * contact_radius_at_load


def adhesive_force_dmt(*, load: Force, work_of_adhesion: SurfaceEnergy, reduced_radius: Length) -> Force:
    """Return Hertz' load at the contact radius minus the load, in DMT: the pull-off force, at every load.

        F_a = 2πwR

    Source:   Derjaguin, Muller & Toporov 1975.
    Valid:    P ≥ −2πwR. Below, a float raises ValueError and an array holds NaN.
    """
    attraction = 2 * pi * work_of_adhesion * reduced_radius
    return within(load + attraction >= 0, attraction)


def contact_displacement_dmt(*, contact_radius_at_load: Length) -> Length:
    """Return the displacement of the contact circle in DMT: 0, as a circle without attraction at its edge cannot lag.

        ξ_contact = 0

    Source:   The limit of Maugis' law for λ → 0; M = F_aξ comes from the attraction outside of the circle alone.
    Valid:    In contact.
    """
    return 0 * contact_radius_at_load
