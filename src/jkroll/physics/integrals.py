"""The integrals behind the pressures and the moments: Eqs 79-88.

W1(s) = √(a² − s²) is the shape of the Hertz pressure on a strip, and 1/W1 that of a flat punch; W2(r) = √(1 − r²/a²)
and 1/W2 are those on a circle. PV∫ is the Cauchy principal value, by which a pressure tilts the surface beneath it.
"""

from .dimensions import Area, Length, Number, Volume
from .elementary import pi


def hertz_moment_transform(*, position: Length, contact_half_width: Length) -> Area:
    """Finite Hilbert transform of s√(a² − s²), at a position from the centre of the strip.

        PV∫ s W1(s)/(x − s) ds = π(x² − a²/2), from −a to a

    Source:   Eq (81).
    Valid:    |x| < a.
    Accuracy: 2.5 ulp of the larger term.

    >>> round(hertz_moment_transform(position=1.0, contact_half_width=2.0), 6)
    -3.141593
    """
    return pi * (position * position - contact_half_width * contact_half_width / 2)


def hertz_transform(*, position: Length) -> Length:
    """Finite Hilbert transform of √(a² − s²), at a position from the centre of the strip.

        PV∫ W1(s)/(x − s) ds = πx, from −a to a

    Source:   Eq (82).
    Valid:    |x| < a, whatever a is.
    Accuracy: 1 ulp.

    >>> round(hertz_transform(position=1.0), 6)
    3.141593
    """
    return pi * position


def punch_integral() -> Number:
    """Integral of 1/√(a² − x²) over the strip.

        ∫ dx/W1(x) = π, from −a to a

    Source:   Eq (83).
    Valid:    Any a > 0.
    Accuracy: 0.5 ulp.

    >>> round(punch_integral(), 6)
    3.141593
    """
    return pi


def hertz_integral(*, contact_half_width: Length) -> Area:
    """Integral of √(a² − x²) over the strip.

        ∫ W1(x) dx = πa²/2, from −a to a

    Source:   Eq (84).
    Valid:    Any a > 0.
    Accuracy: 2 ulp.

    >>> round(hertz_integral(contact_half_width=2.0), 6)
    6.283185
    """
    return pi / 2 * contact_half_width * contact_half_width


def hertz_half_strip_integral(*, half_strip_width: Length) -> Volume:
    """First moment of √(a² − x²) over half of the strip.

        ∫ x W1(x) dx = a³/3, from 0 to a

    Source:   Eq (85), for Eq (76), where a is 𝒜.
    Valid:    Any a > 0.
    Accuracy: 2 ulp.

    >>> hertz_half_strip_integral(half_strip_width=3.0)
    9.0
    """
    return half_strip_width * half_strip_width * half_strip_width / 3


def punch_half_strip_integral(*, half_strip_width: Length) -> Length:
    """First moment of 1/√(a² − x²) over half of the strip.

        ∫ x dx/W1(x) = a, from 0 to a

    Source:   Eq (86), for Eq (76), where a is 𝒜.
    Valid:    Any a > 0.
    Accuracy: Exact.

    >>> punch_half_strip_integral(half_strip_width=3.0)
    3.0
    """
    return half_strip_width


def hertz_half_circle_integral(*, half_circle_radius: Length) -> Volume:
    """Second moment of √(1 − r²/a²) along a radius of the circle.

        ∫ r² W2(r) dr = πa³/16, from 0 to a

    Source:   Eq (87), for Eq (22), where a is 𝒜.
    Valid:    Any a > 0.
    Accuracy: 2.5 ulp.

    >>> round(hertz_half_circle_integral(half_circle_radius=2.0), 6)
    1.570796
    """
    return pi / 16 * half_circle_radius * half_circle_radius * half_circle_radius


def punch_half_circle_integral(*, half_circle_radius: Length) -> Volume:
    """Second moment of 1/√(1 − r²/a²) along a radius of the circle.

        ∫ r² dr/W2(r) = πa³/4, from 0 to a

    Source:   Eq (88), for Eq (22), where a is 𝒜.
    Valid:    Any a > 0.
    Accuracy: 2.5 ulp.

    >>> round(punch_half_circle_integral(half_circle_radius=2.0), 6)
    6.283185
    """
    return pi / 4 * half_circle_radius * half_circle_radius * half_circle_radius
