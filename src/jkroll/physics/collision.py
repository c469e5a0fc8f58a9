"""Rolling of a sphere over a fixed one after a collision, Eqs 45-49, and the loss of a head-on collision."""

from __future__ import annotations

from .dimensions import (
    AngularSpeed,
    Energy,
    Inertia,
    Mass,
    Moment,
    Number,
    Speed,
)
from .elementary import at_least, at_most, pi, sqrt


def energy(*, energy_ratio: Number, adhesion_energy: Energy) -> Energy:
    """Return the energy of sphere 1 from its ratio to P_cδ0, which is given where neither an energy nor a speed is.

        W0 = (W0/P_cδ0) P_cδ0

    Source:   Text below Eq (48).
    """
    return energy_ratio * adhesion_energy


def kinetic_energy(*, mass: Mass, speed: Speed) -> Energy:
    """Return the energy of sphere 1 as it arrives.

        W0 = m1v²/2

    speed  [m/s]  any

    Source:   Caption of Fig. 7.
    Valid:    A sphere that does not spin, moving along the surface of the fixed one.
    """
    return mass * speed**2 / 2


def initial_angular_speed(*, energy: Energy, moment_of_inertia: Inertia) -> AngularSpeed:
    """Return the angular speed of sphere 1 once it rolls without slip with all of its energy.

        ω(0) = √((4/7)W0/I1)

    Source:   Eq (46).
    Valid:    A homogeneous sphere; no energy lost to sliding.
    """
    return sqrt(4 / 7 * energy / moment_of_inertia)


def n_roll(*, energy: Energy, mean_rolling_moment: Moment) -> Number:
    """Return the number of full turns that sphere 1 rolls over a fixed body 2 where the contact slides freely.

        n = W0/(7π⟨M⟩) = W0/(14π P_c â^(3/2) ξ)

    Source:   Eq (48), and Eq (49), which is Eq (48) at W0 = P_cδ0.
    Valid:    A sphere that spins in place: Eq (47) leaves out the friction at the contact, which brakes the centre and
              sustains the spin, so that 2/7 of the energy is dissipated and the rest slides away.
    """
    return energy / (7 * pi * mean_rolling_moment)


def n_roll_energy_balance(*, energy: Energy, mean_rolling_moment: Moment) -> Number:
    """Return the number of full turns that sphere 1 rolls over a fixed body 2 without slip from the start.

        n = W0/(2π⟨M⟩), which is 7/2 of Eq (48)

    Source:   Caption of Fig. 7: "until all energy is dissipated".
    Valid:    No slip at any time; W0 is the energy of the translation and of the spin.
    """
    return energy / (2 * pi * mean_rolling_moment)


def n_roll_after_impact(*, energy: Energy, mean_rolling_moment: Moment) -> Number:
    """Return the number of full turns of a sphere that arrives along the surface without spin, then rolls without slip.

        n = (5/7)W0/(2π⟨M⟩), which is 5/2 of Eq (48)

    Source:   The angular momentum about the contact is kept while friction spins the sphere up: 5/7 of W0 remain.
    Valid:    A tangential impact on a fixed body 2, short beside the rolling; no slip after it.
    """
    return energy / (14 / 5 * pi * mean_rolling_moment)


# --- Head-on collisions -----------------------------------------------------------------------------------------------


def restitution(*, speed: Speed, sticking_speed: Speed) -> Number:
    """Return the speed after a head-on collision over that before it: 0 for spheres that stick.

        e = √(1 − U_stick/W) = √(1 − (v_stick/v)²), W = ½mv²

    Source:   Energy: they lose U_stick at any speed. Thornton & Ning 1998 have this loss.
    Valid:    An upper bound where the law is right: every other loss lowers e. Speeds well below √(E/ρ). With viscous
              damping, whose loss grows with the speed, a bound too.

    >>> restitution(speed=5.0, sticking_speed=3.0)
    0.8
    >>> restitution(speed=2.0, sticking_speed=3.0)
    0.0
    """
    excess = at_least(speed - sticking_speed, 0.0)
    return sqrt(excess / speed * ((speed + sticking_speed) / speed))


def lost_energy(*, speed: Speed, sticking_speed: Speed, reduced_mass: Mass) -> Energy:
    """Return the relative energy that a head-on collision takes: all of ½mv² from spheres that stick.

        W_lost = ½m min(v, v_stick)², which is U_stick from v_stick on

    Source:   Energy, as `restitution`.
    Valid:    A lower bound where the law is right.
    """
    slower = at_most(speed, sticking_speed)
    return reduced_mass * slower * slower / 2
