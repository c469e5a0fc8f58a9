"""The baseline of a curve, its force out of contact: a level or a sloping line, its noise, and remarks on baselines."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy
from numpy import pi, sqrt

from .force_curves import Array
from .minimum import Noise, noise_of, robust_deviation

_MOST_PHI = 0.99  # largest correlation of neighbours in the baseline
_SURE = 4.0  # standard errors; a slope of more is not due to chance
_SMALL_SHARE = 0.1  # share of the noise below which an error of the baseline does not matter


class Baseline(NamedTuple):
    """The force out of contact as a line over z: a level, or a sloping line.

    A line is always fitted; the baseline is this line or a level. `noise` is the standard deviation around the line,
    `scatter` that around the baseline. `steepness` is the slope of the line, also if the baseline is a level.
    """

    force: float  # at the middle of the line
    slope: float
    error: float  # standard error of the force
    noise: float
    scatter: float
    z: float = 0.0  # the position of the middle
    slope_error: float = 0.0
    length: float = 0.0  # of the points out of contact
    steepness: float = 0.0
    steepness_error: float = 0.0

    def at(self, z: Array) -> Array:
        """Return the baseline at positions z."""
        return self.force + self.slope * (z - self.z)

    def error_at(self, z: float) -> float:
        """Return the standard error of the baseline at a position z."""
        return float(numpy.hypot(self.error, self.slope_error * (z - self.z)))

    @property
    def is_steep(self) -> bool:
        """True if the force out of contact changes over z by more than 4 standard errors and 0.4 times the noise."""
        least = max(self.steepness_error * self.length, _SMALL_SHARE * self.noise)
        return abs(self.steepness) * self.length > _SURE * least


def baseline_of(z: Array, force: Array, floor: float, *, tilt: bool) -> Baseline:
    """Return the baseline of points out of contact: their median, or a line if `tilt`.

    `floor`: the least standard deviation of the force, around the line and around the baseline.
    """
    middle, length = float(numpy.mean(z)), float(numpy.ptp(z))
    steepness = float(numpy.polyfit(z - middle, force, 1)[0]) if length > 0 else 0.0
    rest = force - steepness * (z - middle)
    size, phi = _scatter(rest, floor), _correlation(rest, 2)
    steepness_error = size * sqrt(Noise(phi).correlation_time) / float(numpy.linalg.norm(z - middle)) if length else 0.0
    line = Baseline(
        float(numpy.median(rest)), steepness, size * _error_of_median(phi, len(force)), size, size, middle,
        steepness_error, length, steepness, steepness_error,
    )  # fmt: skip
    if tilt:
        return line
    scatter = _scatter(force, floor)
    error = scatter * _error_of_median(_correlation(force, 1), len(force))
    return line._replace(force=float(numpy.median(force)), slope=0.0, slope_error=0.0, error=error, scatter=scatter)


def _scatter(values: Array, floor: float) -> float:
    """Return a robust estimate of the standard deviation of values, at least `floor`."""
    return max(robust_deviation(values - numpy.median(values)), floor)


def _correlation(values: Array, unknowns: int) -> float:
    """Return the correlation of neighbours, from 0 to 0.99, among residuals of a fit with this number of unknowns."""
    return max(0.0, min(noise_of(values - numpy.median(values), unknowns).phi, _MOST_PHI))


def _error_of_median(phi: float, count: int) -> float:
    """Return the standard error of a median in units of the standard deviation, for normal noise of correlation φ.

        n var = Σ arcsin ρ_k = π/2 + 2Σ(1 − k/n) arcsin φ^k

    Source:   Sheppard's formula for the signs of two normal variables. White noise has √(π/2n).
    """
    lags = numpy.arange(1, count)
    return float(sqrt((pi / 2 + 2 * ((1 - lags / count) * numpy.arcsin(phi**lags)).sum()) / count))


def remark_on_baselines(baselines: Mapping[str, Baseline | None], remarks: dict[str, str], *, tilt: bool) -> None:
    """Add a remark if levels are fitted to sloping baselines, or if the baselines before and after contact differ."""
    known = {name: baseline for name, baseline in baselines.items() if baseline is not None}
    steep = [name for name, baseline in known.items() if baseline.is_steep]
    if steep and not tilt:
        name = max(steep, key=lambda name: abs(known[name].steepness) * known[name].length)
        length, change = known[name].length, known[name].steepness * known[name].length
        remarks["baseline-slopes"] = (
            f"{name}: the force out of contact changes by {change * 1e9:.3g} nN over {length * 1e6:.3g} µm: "
            "--baseline tilt subtracts a line instead of the median"
        )
        return  # sloping baselines have different levels even if nothing moved
    if len(known) < 2:
        return
    one, other = known.values()
    z = (one.z + other.z) / 2
    difference = float(other.at(z) - one.at(z))
    if abs(difference) > 3 * max(numpy.hypot(one.error_at(z), other.error_at(z)), _SMALL_SHARE * one.noise):
        remarks["baseline-moves"] = (
            f"the baseline moves by {difference * 1e9:.3g} nN between loading and unloading: each branch has its own"
        )
