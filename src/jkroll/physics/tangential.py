"""Resistance to sliding and twisting: stiffness, thresholds set by a shear strength, and peeling."""

from __future__ import annotations

from .dimensions import Angle, Energy, Force, Length, Moment, MomentPerAngle, Number, Stiffness, Stress, SurfaceEnergy
from .elementary import at_least, cbrt, cube, pi, sqrt, within

_NEWTON_STEPS = 3
_TINY = 1e-300  # lower bound that avoids a division by 0


def shear_strength(
    *, youngs_modulus: Stress, poisson_ratio: Number, youngs_modulus2: Stress, poisson_ratio2: Number
) -> Stress:
    """Return the shear stress that a contact bears before it slides or twists, if none was measured.

        τ = G/(4π²), G = E/(2(1 + ν)), of the softer solid

    Source:   Lumajord/DustSimulation, whose thresholds of sliding and of twisting both follow from this strength. That
              the softer of unlike solids counts is a rule of this program.
    Valid:    An order of magnitude: 9 to 15 MPa were measured for polystyrene on glass (Sümer & Sitti), where this is
              29 MPa.
    """
    compliances = (1 + poisson_ratio) / youngs_modulus, (1 + poisson_ratio2) / youngs_modulus2
    return 1 / (8 * pi**2 * at_least(*compliances))


def sliding_force(*, shear_strength: Stress, contact_radius_at_load: Length) -> Force:
    """Return the tangential force at which a contact slides.

        F_slide = πa²τ, which is Ga²/(4π) with the default τ

    Source:   Lumajord/DustSimulation, which has no load.
    Valid:    A contact that does not peel before, and that bears its shear strength everywhere.
    """
    return pi * shear_strength * contact_radius_at_load**2


def sliding_displacement(*, sliding_force: Force, tangential_stiffness: Stiffness) -> Length:
    """Return the elastic displacement of the centres along the contact when it begins to slide.

        s = F_slide/k_s, which is (2 − ν)a/(16π) for identical solids with the default τ

    Source:   Lumajord/DustSimulation.
    Valid:    An order of magnitude.
    """
    return sliding_force / tangential_stiffness


def sliding_energy(*, sliding_force: Force, sliding_displacement: Length) -> Energy:
    """Return the elastic energy of a contact that begins to slide.

        F_slide s/2

    Source:   Work of a force that rises linearly.
    """
    return sliding_force * sliding_displacement / 2


def twisting_stiffness(
    *,
    youngs_modulus: Stress,
    poisson_ratio: Number,
    youngs_modulus2: Stress,
    poisson_ratio2: Number,
    contact_radius_at_load: Length,
) -> MomentPerAngle:
    """Return the torsional stiffness: the moment per angle about the line of centres, without slip.

        k_t = (16/3)a³/(1/G1 + 1/G2), G = E/(2(1 + ν))

    Source:   Reissner & Sagoci's (16/3)Ga³ of one half-space, two of them in series.
    Valid:    Small angles: the contact circle sticks. Exact for unlike solids, too.
    """
    compliance = (1 + poisson_ratio) / youngs_modulus + (1 + poisson_ratio2) / youngs_modulus2
    return 8 / 3 * cube(contact_radius_at_load) / compliance


def twisting_moment(*, shear_strength: Stress, contact_radius_at_load: Length) -> Moment:
    """Return the moment about the line of centres at which a contact twists.

        M_twist = (2/3)πa³τ, which is Ga³/(6π) with the default τ

    Source:   Lumajord/DustSimulation, which has no load.
    Valid:    A contact that does not peel before. For nm-thick contacts of ice, larger torques were measured than
              scaled-down models predict (arXiv:1311.1957).
    """
    return 2 / 3 * pi * shear_strength * cube(contact_radius_at_load)


def twisting_angle(*, twisting_moment: Moment, twisting_stiffness: MomentPerAngle) -> Angle:
    """Return the elastic angle of torsion when the contact begins to twist.

        φ = M_twist/k_t, which is 1/(16π) for identical solids with the default τ

    Source:   Lumajord/DustSimulation.
    Valid:    An order of magnitude.
    """
    return twisting_moment / twisting_stiffness


def twisting_energy(*, twisting_moment: Moment, twisting_angle: Angle) -> Energy:
    """Return the elastic energy of a contact that begins to twist.

        M_twist φ/2

    Source:   Work of a moment that rises linearly.
    """
    return twisting_moment * twisting_angle / 2


def peeling_force(
    *, pull_off_force: Force, load_margin: Number, contact_shear_modulus: Stress, contact_modulus: Stress
) -> Force:
    """Return the tangential force at which a contact that does not slide peels off, at a fixed normal load.

        T = 4√(P_c(P + P_c)G*/E*) = 4P_c s√(G*/E*)

    Source:   Griffith: the release rates T²/(32πG*a³) and (P_H − P)²/(8πE*a³), means over the edge, add up to w.
    Valid:    JKR, P ≥ −P_c, and a work of adhesion that does not depend on the direction of loading: measured contacts
              shrink much less under a tangential force. Beyond pull-off, a float raises ValueError and an array holds
              NaN.
    """
    margin = within(load_margin >= 0, load_margin)
    return 4 * pull_off_force * margin * sqrt(contact_shear_modulus / contact_modulus)


def peeling_radius(
    *, work_of_adhesion: SurfaceEnergy, reduced_radius: Length, contact_modulus: Stress, load_margin: Number
) -> Length:
    """Return the radius to which a contact has shrunk when it peels off under a tangential force, at a fixed load.

        a_T = (3R(P + 2P_c)/(4E*))^(1/3) = a0((1 + s²)/4)^(1/3)

    Source:   As the peeling force, at which the two solutions for a coincide.
    Valid:    As the peeling force.
    """
    margin = within(load_margin >= 0, load_margin)
    return cbrt(9 / 8 * pi * work_of_adhesion * reduced_radius**2 * (1 + margin**2) / contact_modulus)


def peeling_over_sliding(*, peeling_force: Force, shear_strength: Stress, peeling_radius: Length) -> Number:
    """Return the peeling force over the force that would slide the contact as it peels: below 1, it peels first.

        T/(πa_T²τ)

    Source:   While T rises, the contact shrinks and T/(πa²τ) grows: it slides first if this ratio reaches 1 before
              the contact peels.
    """
    return peeling_force / (pi * shear_strength * peeling_radius**2)


def sliding_or_peeling_force(*, peeling_force: Force, peeling_over_sliding: Number, load_margin: Number) -> Force:
    """Return the tangential force at which a brittle contact gives way, at a fixed normal load: it slides or peels off.

        T = πa²τ, with 4E*a³/(3R) = P + 2P_c + √(4P_c(P + P_c) − T²E*/(4G*)); T_peel where it peels before

    Source:   Griffith, as the peeling force: the contact shrinks while T rises, until T reaches the strength of the
              area that is left.
    Valid:    As the peeling force. A contact that keeps its area slides at F_slide, which is larger.
    """
    # Let T = T_peel √(1 − c²), 0 ≤ c ≤ 1, and e = 2s/(1 + s²). The area left is then g² times the area at peeling, with
    # g³ = 1 + ec. The unknown t = (g − 1)/e makes the equation rational, and loses no digits where e is small.
    e = 2 * load_margin / (1 + load_margin**2)
    ratio = at_least(peeling_over_sliding, 1.0)
    share, rest = 1 / ratio**2, (ratio - 1) / ratio * ((ratio + 1) / ratio)
    pull = share * e
    h = 2 / 3 * pull
    c = rest / at_least(h + sqrt(h**2 + (1 + e * h / 3) * rest), _TINY)
    t = at_least(c / (3 + 0.85 * e * c), _TINY)
    for _ in range(_NEWTON_STEPS):  # share (g⁴ − 1) + c² = rest
        g = 1 + e * t
        square = g * g
        c = t * (1 + g + square)
        t = t - (pull * t * (1 + g) * (1 + square) + c * c - rest) / (square * (4 * pull * g + 6 * c))
    force, change = peeling_force / ratio, e * t  # (1 + et)² would double the rounding of 1 + et
    return force + force * (change * (2 + change))


def rolling_over_sliding(*, yield_force: Force, sliding_or_peeling_force: Force) -> Number:
    """Return the ratio of the force that starts sphere 1 rolling to the tangential force that slides or peels it.

        Q/T_first

    Source:   Both forces act at the centre of sphere 1. It rolls first if the ratio is below 1.
    """
    return yield_force / sliding_or_peeling_force


# --- Coefficients of friction for LAMMPS ------------------------------------------------------------------------------


def sliding_friction_coefficient(*, sliding_force: Force, load: Force, pull_off_force: Force) -> Number:
    """Return the coefficient of friction with which LAMMPS lets a contact slide at its sliding force.

        μ_slide = F_slide/(P + 2P_c)

    Source:   LAMMPS, pair_style granular, tangential mindlin_rescale: the spring's force is at most μ_slide(P + 2P_c).
    Valid:    At this load; LAMMPS takes one μ_slide for every load.
    """
    return sliding_force / (load + 2 * pull_off_force)


def twisting_friction_coefficient(*, twisting_moment: Moment, load: Force, pull_off_force: Force) -> Length:
    """Return the coefficient of friction, a length, with which LAMMPS lets a contact twist at its twisting moment.

        μ_twist = M_twist/(P + 2P_c)

    Source:   LAMMPS, pair_style granular, twisting sds: the spring's moment is at most μ_twist(P + 2P_c).
    Valid:    At this load; LAMMPS takes one μ_twist for every load.
    """
    return twisting_moment / (load + 2 * pull_off_force)
