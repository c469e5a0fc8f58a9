"""A rigid sphere of true shape on a soft plane, in SI units: JKR with Sneddon's sphere instead of a paraboloid.

One number describes a state: L = artanh(a/R), found at a load or at an approach. `sneddon` has the equations, in
dimensionless form.
"""

from __future__ import annotations

from . import sneddon
from .dimensions import Force, Length, Number, Stiffness, Stress, SurfaceEnergy
from .elementary import cbrt, pi, tanh, within

STIFFER = 100.0  # ratio of the moduli of sphere and plane at and above which the sphere counts as rigid
INCOMPRESSIBLE = 0.45  # Poisson's ratio of the plane at and above which terms of order a/R are small

_GRIPS, _DEAD_LOAD = (1.0, 0.0), (0.0, 1.0)  # the g and c of `sneddon`


def indenter_radius(
    *,
    radius: Length,
    radius2: Length,
    youngs_modulus: Stress,
    youngs_modulus2: Stress,
    poisson_ratio2: Number,
) -> Length:
    """Return the radius of a rigid sphere on a plane that is nearly incompressible, for which its true shape matters.

        R = R1

    Source:   Half-space theory leaves out terms of order a/R, such as the radial displacement at the edge, which goes
              with 1 − 2ν. Where they are large, the shape of the sphere, of order (a/R)², is no improvement.
    Valid:    R2 infinite, E1 ≥ 100 E2 and ν2 ≥ 0.45. Else a float raises ValueError and an array holds NaN.
    """
    is_on_plane = radius / radius2 == 0
    is_rigid = youngs_modulus >= STIFFER * youngs_modulus2
    return within(is_on_plane & is_rigid & (poisson_ratio2 >= INCOMPRESSIBLE), radius)


def elastoadhesive_ratio(
    *, work_of_adhesion: SurfaceEnergy, indenter_radius: Length, contact_modulus: Stress
) -> Number:
    """Return the elasto-adhesive length w/E* over the radius of a sphere on a plane.

        κ = w/(E*R)

    Source:   In units of R and E*R², JKR with a rigid sphere depends on w, E* and R through κ alone.
    """
    return work_of_adhesion / (contact_modulus * indenter_radius)


# --- States -----------------------------------------------------------------------------------------------------------


def artanh_at_pull_off(*, elastoadhesive_ratio: Number) -> Number:
    """Return L of the contact that a constant tension breaks.

        δ_H′ = 3u/(2a), in the symbols of `sneddon`

    Source:   Sneddon's sphere with G = w at the edge.
    """
    return sneddon.last_state(elastoadhesive_ratio, *_DEAD_LOAD)


def artanh_at_fold(*, elastoadhesive_ratio: Number) -> Number:
    """Return L of the contact at which fixed grips let go.

        δ_H′ = u/(2a), in the symbols of `sneddon`

    Source:   Sneddon's sphere with G = w at the edge.
    """
    return sneddon.last_state(elastoadhesive_ratio, *_GRIPS)


def artanh_at_load(
    *,
    load: Force,
    indenter_radius: Length,
    contact_modulus: Stress,
    elastoadhesive_ratio: Number,
    artanh_at_pull_off: Number,
) -> Number:
    """Return L of the stable contact at a load.

        L = artanh(a/R), P = E*R²((1 + x²)L − x) − √(8πwE*a³), x = a/R

    Source:   Sneddon's sphere with G = w at the edge, by Newton's method.
    Valid:    Loads above pull-off. Below, a float raises ValueError and an array holds NaN.
    """
    held = load / (contact_modulus * indenter_radius**2)
    return sneddon.state_at(held, elastoadhesive_ratio, artanh_at_pull_off, *_DEAD_LOAD)


def artanh_at_approach(
    *, approach_at_load: Length, indenter_radius: Length, elastoadhesive_ratio: Number, artanh_at_fold: Number
) -> Number:
    """Return L of the contact that fixed grips hold at an approach.

        L = artanh(a/R), δ = aL − √(2πwa/E*)

    Source:   Sneddon's sphere with G = w at the edge, by Newton's method.
    Valid:    Approaches above the fold. Beyond, a float raises ValueError and an array holds NaN.
    """
    held = approach_at_load / indenter_radius
    return sneddon.state_at(held, elastoadhesive_ratio, artanh_at_fold, *_GRIPS)


def unloaded_artanh(*, elastoadhesive_ratio: Number, artanh_at_pull_off: Number) -> Number:
    """Return L of the contact without load.

        (1 + x²)L − x = x√(8πκx), x = tanh L

    Source:   As `artanh_at_load`, with P = 0.
    """
    return sneddon.state_at(0.0, elastoadhesive_ratio, artanh_at_pull_off, *_DEAD_LOAD)


# --- Forces, radii, approaches and stiffness --------------------------------------------------------------------------


def pull_off_force_sphere(
    *, artanh_at_pull_off: Number, elastoadhesive_ratio: Number, indenter_radius: Length, contact_modulus: Stress
) -> Force:
    """Return the force that pulls a sphere of true shape off.

        P_c = −P(a_pull), which is (3/2)πwR(1 − (2/5)a_pull²/R² + …)

    Source:   Sneddon's sphere with G = w at the edge.
    Valid:    A rigid sphere on a nearly incompressible plane, where JKR holds.
    """
    unit = contact_modulus * indenter_radius**2
    return -sneddon.load(elastoadhesive_ratio, artanh_at_pull_off) * unit


def load_sphere(
    *, contact_artanh: Number, elastoadhesive_ratio: Number, indenter_radius: Length, contact_modulus: Stress
) -> Force:
    """Return the load that holds a contact of a sphere of true shape.

        P = E*R²((1 + x²)L − x) − √(8πwE*a³), x = a/R

    Source:   Sneddon's sphere with G = w at the edge.
    """
    return sneddon.load(elastoadhesive_ratio, contact_artanh) * (contact_modulus * indenter_radius**2)


def contact_radius_sphere(*, contact_artanh: Number, indenter_radius: Length) -> Length:
    """Return the radius of the contact circle in a state.

        a = R tanh L

    Source:   L = artanh(a/R).
    """
    return tanh(contact_artanh) * indenter_radius


def unloaded_radius_sphere(*, unloaded_artanh: Number, indenter_radius: Length) -> Length:
    """Return the radius of the contact circle without load.

        a0 = R tanh L0

    Source:   L = artanh(a/R).
    """
    return tanh(unloaded_artanh) * indenter_radius


def contact_radius_at_pull_off_sphere(*, artanh_at_pull_off: Number, indenter_radius: Length) -> Length:
    """Return the radius of the contact circle at which a constant tension breaks the contact.

        a_pull = R tanh L_pull

    Source:   L = artanh(a/R).
    """
    return tanh(artanh_at_pull_off) * indenter_radius


def contact_radius_at_fold_sphere(*, artanh_at_fold: Number, indenter_radius: Length) -> Length:
    """Return the radius of the contact circle at which fixed grips let go.

        a_fold = R tanh L_fold

    Source:   L = artanh(a/R).
    """
    return tanh(artanh_at_fold) * indenter_radius


def approach_sphere(*, contact_artanh: Number, elastoadhesive_ratio: Number, indenter_radius: Length) -> Length:
    """Return the approach in a state.

        δ = aL − √(2πwa/E*)

    Source:   Sneddon's sphere with G = w at the edge.
    """
    return sneddon.approach(elastoadhesive_ratio, contact_artanh) * indenter_radius


def unloaded_approach_sphere(
    *, unloaded_artanh: Number, elastoadhesive_ratio: Number, indenter_radius: Length
) -> Length:
    """Return the approach without load.

        δ0 = a0L0 − √(2πwa0/E*)

    Source:   Sneddon's sphere with G = w at the edge.
    """
    return sneddon.approach(elastoadhesive_ratio, unloaded_artanh) * indenter_radius


def approach_at_pull_off_sphere(
    *, artanh_at_pull_off: Number, elastoadhesive_ratio: Number, indenter_radius: Length
) -> Length:
    """Return the approach at which a constant tension breaks the contact.

        δ_pull = aL − √(2πwa/E*) at a_pull

    Source:   Sneddon's sphere with G = w at the edge.
    """
    return sneddon.approach(elastoadhesive_ratio, artanh_at_pull_off) * indenter_radius


def approach_at_fold_sphere(*, artanh_at_fold: Number, elastoadhesive_ratio: Number, indenter_radius: Length) -> Length:
    """Return the least approach, at which fixed grips let go.

        δ_fold = aL − √(2πwa/E*) at a_fold

    Source:   Sneddon's sphere with G = w at the edge.
    """
    return sneddon.approach(elastoadhesive_ratio, artanh_at_fold) * indenter_radius


def stiffness_sphere(
    *, contact_artanh: Number, elastoadhesive_ratio: Number, indenter_radius: Length, contact_modulus: Stress
) -> Stiffness:
    """Return the normal stiffness of the contact: 0 at pull-off.

        dP/dδ = 2E*a (δ_H′ − 3u/(2a))/(δ_H′ − u/(2a))

    Source:   Sneddon's sphere with G = w at the edge.
    Valid:    Small vibrations about the load.
    """
    rise = sneddon.load_slope(elastoadhesive_ratio, contact_artanh)
    return rise / sneddon.approach_slope(elastoadhesive_ratio, contact_artanh) * (contact_modulus * indenter_radius)


# --- Numbers that limit the model -------------------------------------------------------------------------------------


def contact_over_sphere_of_ratio(*, elastoadhesive_ratio: Number) -> Number:
    """Return the contact radius that a paraboloid would have without load over the radius of the sphere.

        a0/R = (9πκ/2)^(1/3)

    Source:   Eq (2). The contact of a sphere of true shape is always narrower than the sphere.
    Valid:    Below 1. Above, the surface tension of so soft a plane shapes the contact.
    """
    return cbrt(9 / 2 * pi * elastoadhesive_ratio)


def strain_of_contact(*, contact_radius_at_load: Length, indenter_radius: Length) -> Number:
    """Return the strain of the contact, as the Hertz part of a paraboloid's pressure over the contact modulus.

        2a/(πR)

    Source:   Eq (8).
    """
    return 2 / pi * contact_radius_at_load / indenter_radius
