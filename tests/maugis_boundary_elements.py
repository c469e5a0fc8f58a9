"""Rolling of a paraboloid on an elastic half-space in three dimensions, by boundary elements on a square grid.

Dugdale's constant traction pulls on a disc whose centre lags behind the apex. The conjugate gradients of Polonsky &
Keer (Wear 231, 206, 1999) find the contact pressure at a given load. Love's formula gives the displacement under a
uniform pressure on one square cell; a discrete convolution on a doubled grid sums the cells. Units as in
`maugis_reference`: E* = 3/4, R = 1, πw = 1.
"""

from typing import Any

import numpy

MODULUS = 0.75


def rolling_moment(*, transition: float, load: float, zone_radius: float, lag: float, points: int) -> float:
    """Return the moment about the apex, in units of πwR times the unit of length.

    `zone_radius`: the radius of the disc; `lag`: the distance of its centre behind the apex.
    """
    half = 1.04 * zone_radius
    step = 2 * half / points
    middle = (numpy.arange(points) + 0.5) * step - half
    x, y = numpy.meshgrid(middle, middle, indexing="ij")
    attraction = transition / 2 * _disc(zone_radius, x, y, step)
    height = ((x - lag) ** 2 + y**2) / 2
    kernel = _kernel(points, step)

    def displacement(pressure: Any) -> Any:
        doubled = numpy.fft.rfft2(pressure, s=(2 * points, 2 * points))
        return numpy.fft.irfft2(kernel * doubled)[:points, :points]

    total = (load + attraction.sum() * step * step) / (step * step)
    gap_apart = height - displacement(attraction)
    pressure = numpy.where(x * x + y * y < (0.8 * zone_radius) ** 2, 1.0, 0.0)
    pressure *= total / pressure.sum()
    direction = numpy.zeros_like(pressure)
    norm_before, restart = 1.0, True
    for _ in range(2000):
        gap = gap_apart + displacement(pressure)
        touching = pressure > 0
        gap -= gap[touching].mean()
        norm = (gap[touching] ** 2).sum()
        direction = numpy.where(touching, gap + (0.0 if restart else norm / norm_before) * direction, 0.0)
        norm_before, restart = norm, False
        answer = displacement(direction)
        answer -= answer[touching].mean()
        length = (gap * direction)[touching].sum() / (answer * direction)[touching].sum()
        before = pressure
        pressure = numpy.maximum(pressure - length * direction, 0.0)
        overlapping = (pressure == 0) & (gap < 0)
        if overlapping.any():
            pressure[overlapping] -= length * gap[overlapping]
            restart = True
        pressure *= total / pressure.sum()
        if numpy.abs(pressure - before).sum() < 1e-9 * total:
            break
    else:
        raise AssertionError("the pressure has not settled")
    return float(((pressure - attraction) * (x - lag)).sum() * step * step)


def _disc(radius: float, x: Any, y: Any, step: float) -> Any:
    """Return the fraction of each cell that lies in a circle."""
    fine = (numpy.arange(16) + 0.5) / 16 * step - step / 2
    share = numpy.zeros_like(x)
    for dx in fine:
        for dy in fine:
            share += (x + dx) ** 2 + (y + dy) ** 2 < radius * radius
    return share / 256


def _kernel(points: int, step: float) -> Any:
    """Return the Fourier transform of the displacements by a unit pressure on one cell."""
    index = numpy.fft.fftfreq(2 * points, 1 / (2 * points)) * step
    x, y = numpy.meshgrid(index, index, indexing="ij")
    h = step / 2

    def corner(u: Any, v: Any) -> Any:
        return u * numpy.arcsinh(v / numpy.abs(u)) + v * numpy.arcsinh(u / numpy.abs(v))

    patch = corner(x + h, y + h) - corner(x + h, y - h) - corner(x - h, y + h) + corner(x - h, y - h)
    return numpy.fft.rfft2(patch / (numpy.pi * MODULUS))
