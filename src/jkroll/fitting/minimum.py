"""Fit one branch of a force curve by least squares: residuals, their minimum, noise and the covariance.

The unknowns are ln w, ln E* and, if x is an approach or a travel, the contact point z_c. A point has the position z and
the force F, with standard deviations σ_x and σ_F. The model's state at x = z − z_c (or at the contact radius x = z) has
the load P, the variable q and the slopes X = dx/dq and T = dP/dq. The residual is

    r = X(F − P)/√(X²σ_F² + T²σ_x²)

This residual stays finite where the contact is lost, although dP/dx = T/X diverges there. A point beyond the last
state of the model has r = (x − x_last)/σ_x.

Noise is white, or autoregressive of first order, r_i = φr_(i−1) + e_i. Residuals are whitened, and φ is corrected for
the bias that the fit of smooth functions causes (Kendall). The residuals themselves give the scale of e. If fewer than
20 points are independent, the residuals are a misfit of the model; the fit takes them as white, and multiplies the
covariance by the correlation time. Residuals beyond 3 standard deviations have Huber's weights.
"""

from collections.abc import Sequence
from typing import NamedTuple, Self

import numpy
from numpy import exp, inf, log, sqrt

from .force_curves import Array, Contact, CurveLaw, Grip, state_at

ADHESION, MODULUS, POINT = range(3)  # the indices of ln w, ln E* and z_c among the unknowns

_HUBER = 3.0  # standard deviations
_FEW = 30  # with fewer points, noise is taken as white
_CUTS = 30  # most rounds of clipping at 3 standard deviations
_MOST_PHI = 0.999  # largest |φ|
_ROUNDS = 5  # most rounds, each with a minimum and its noise
_SAME_PHI = 0.01  # the rounds end at smaller changes of φ and smaller relative changes of the noise
FEW_INDEPENDENT = 20.0  # independent points, n/τ; with fewer, residuals count as a misfit of the model
_STEPS = 100  # most steps of the minimiser
_SAME = 1e-6  # relative decrease of the cost at which the minimiser stops
_FIRST_DAMPING, _LEAST_DAMPING, _MOST_DAMPING = 1e-3, 1e-12, 1e10
_SINGULAR = 1e13  # condition number above which a scaled matrix counts as singular
_LONGEST = 4.0  # the longest step of ln w and ln E*, a factor of 55


class Points(NamedTuple):
    """The measured points of a branch in order of time: z (or contact radius), force, and their standard deviations.

    Only the ratio of the two deviations matters: the fit estimates their scale.
    """

    z: Array
    force: Array
    force_error: Array
    z_error: Array

    def chosen(self, which: Array) -> Self:
        """Return the points at some indices, or where a mask is True."""
        return self._replace(**{name: column[which] for name, column in self._asdict().items()})

    def thinned(self, step: int) -> Self:
        """Return every `step`-th point."""
        return self.chosen(slice(None, None, step)) if step > 1 else self


class Setting(NamedTuple):
    """The fixed part of a fit: the law, radius and spacing of the contact, and the grip."""

    law: CurveLaw
    reduced_radius: float
    atomic_spacing: float
    grip: Grip

    def contact(self, unknowns: Array) -> Contact:
        """Return the contact with these values of the unknowns."""
        w, modulus = (float(exp(unknowns[index])) for index in (ADHESION, MODULUS))
        return Contact(w, modulus, self.reduced_radius, self.atomic_spacing)

    @property
    def free(self) -> tuple[int, ...]:
        """The indices of the unknowns that a fit can move: that of z_c only if x is an approach or a travel."""
        return (ADHESION, MODULUS) if self.grip.is_radius else (ADHESION, MODULUS, POINT)


class Residuals(NamedTuple):
    """Residuals, the derivatives of the model by ln w, ln E* and z_c in the same units, and the fitted states."""

    values: Array
    derivatives: Array
    loads: Array
    radii: Array  # fitted contact radii
    is_beyond: Array  # True for points beyond the last state of the model


def residuals(points: Points, unknowns: Array, setting: Setting) -> Residuals:
    """Return the residuals of points, with the derivatives of the model, which are minus those of the residuals.

    By an unknown θ, ∂P/∂θ at fixed x = P_θ − (T/X)x_θ; the indices are derivatives at fixed q.
    """
    contact, grip = setting.contact(unknowns), setting.grip
    x = points.z - (0.0 if grip.is_radius else unknowns[POINT])
    q, last, x_last = state_at(setting.law, x, contact, grip)
    values, slopes, *partials = setting.law.states(q, contact)
    x_slope, load_slope = grip.x(slopes), slopes.load
    size = numpy.hypot(x_slope * points.force_error, load_slope * points.z_error)
    size = numpy.where(size > 0, size, 1.0)
    columns = [x_slope * partial.load - load_slope * grip.x(partial) for partial in partials]
    columns.append(-load_slope if not grip.is_radius else 0 * x)
    is_beyond = x < x_last
    derivatives = numpy.stack(columns, 1) / size[:, None]
    result = x_slope * (points.force - values.load) / size
    if is_beyond.any():
        _, _, *at_last = setting.law.states(numpy.float64(last), contact)
        of_last = numpy.array([*(float(grip.x(partial)) for partial in at_last), 1.0])
        result = numpy.where(is_beyond, (x - x_last) / points.z_error, result)
        derivatives = numpy.where(is_beyond[:, None], of_last / points.z_error[:, None], derivatives)
    return Residuals(result, derivatives, values.load, values.radius, is_beyond)


# --- Noise ------------------------------------------------------------------------------------------------------------


class Noise(NamedTuple):
    """The noise of residuals: φ of the autoregression, and the standard deviation of its innovations."""

    phi: float = 0.0
    scale: float = 1.0

    def whitened(self, rows: Array) -> Array:
        """Return residuals, or rows of their derivatives, made independent with unit variance."""
        first = rows[:1] * sqrt(1 - self.phi**2)
        return numpy.concatenate([first, rows[1:] - self.phi * rows[:-1]]) / self.scale

    def thinned(self, step: int) -> Self:
        """Return the noise of every `step`-th point: less correlated, of the same size."""
        phi = abs(self.phi) ** step * (1 if self.phi >= 0 or step % 2 == 0 else -1)
        return self._replace(phi=phi, scale=self.scale * float(sqrt((1 - phi**2) / (1 - self.phi**2))))

    @property
    def correlation_time(self) -> float:
        """The number of points per independent point, τ = (1 + φ)/(1 − φ)."""
        return (1 + self.phi) / (1 - self.phi)


def noise_of(values: Array, unknowns: int) -> Noise:
    """Return the noise in the residuals of a fit with this number of unknowns.

    Source:   Kendall's bias of φ, with one term for each smooth regressor.
    """
    size = len(values)
    limit = _HUBER * _spread(values, unknowns)
    kept = numpy.clip(values, -limit, limit)
    square = float(kept @ kept)
    if size < _FEW or square == 0:
        return Noise(0.0, _spread(values, unknowns))
    phi = float(kept[1:] @ kept[:-1]) / square
    phi = max(-_MOST_PHI, min(phi + (unknowns + (unknowns + 2) * phi) / size, _MOST_PHI))
    return Noise(phi, _spread(Noise(phi).whitened(values), unknowns))


def robust_deviation(differences: Array) -> float:
    """Return the standard deviation of normal differences with mean 0, from the median of their sizes."""
    return 1.4826 * float(numpy.median(abs(differences)))


def _spread(values: Array, unknowns: int) -> float:
    """Return the standard deviation of residuals, clipped at 3 standard deviations."""
    freedom = max(len(values) - unknowns, 1)
    spread = float(sqrt(values @ values / freedom))
    for _ in range(_CUTS):
        kept = numpy.clip(values, -_HUBER * spread, _HUBER * spread)
        previous, spread = spread, float(sqrt(kept @ kept / freedom))
        if spread > 0.999 * previous:
            break
    return max(spread, 1e-9)  # computed curves have no noise


# --- The minimum ------------------------------------------------------------------------------------------------------


class Minimum(NamedTuple):
    """A minimum: the unknowns, the covariance of the free unknowns, the noise, and the residuals."""

    unknowns: Array
    covariance: Array
    noise: Noise
    residuals: Residuals
    cost: float  # the sum of Huber's loss of the whitened residuals
    weights: Array  # of Huber's loss
    correlation_time: float = 1.0  # of the residuals, in points


def minimum(
    points: Points,
    setting: Setting,
    start: Array,
    free: Sequence[int] | None = None,
    noise: Noise | None = None,
    *,
    rounds: int = _ROUNDS,
) -> Minimum:
    """Return the minimum that is reached from a start. The residuals give the noise unless `noise` is given.

    `free`: the indices of the unknowns to move, by default all of the setting. `rounds`: most rounds, each of which
    finds the minimum and then the noise; the first round assumes white noise.
    """
    chosen = [*(setting.free if free is None else free)]
    unknowns = numpy.array(start, float)

    def white_noise() -> Noise:
        return Noise(0.0, _spread(residuals(points, unknowns, setting).values, len(chosen)))

    assumed = white_noise() if noise is None else noise
    for _ in range(rounds):
        at_end = _descended(points, setting, unknowns, chosen, assumed)
        unknowns = at_end.unknowns
        if noise is not None:
            break
        previous, assumed = assumed, noise_of(at_end.residuals.values, len(chosen))
        if abs(assumed.phi - previous.phi) < _SAME_PHI and abs(assumed.scale / previous.scale - 1) < _SAME_PHI:
            break
    tau = noise_of(at_end.residuals.values, len(chosen)).correlation_time
    count = len(points.z)
    if noise is None and rounds > 1 and count < FEW_INDEPENDENT * tau:  # a misfit of the model, not noise
        at_end = _descended(points, setting, unknowns, chosen, white_noise())
        at_end = at_end._replace(covariance=at_end.covariance * min(tau, count / len(chosen)))
    return at_end._replace(correlation_time=tau)


class _System(NamedTuple):
    """The least-squares system at some unknowns: residuals, their normal equations, Huber's weights and the cost."""

    residuals: Residuals
    matrix: Array
    target: Array
    weights: Array
    cost: float


def _descended(points: Points, setting: Setting, start: Array, free: Sequence[int], noise: Noise) -> Minimum:
    """Return the minimum for a given noise, by Levenberg's and Marquardt's method."""

    def system_at(unknowns: Array) -> _System:
        found = residuals(points, unknowns, setting)
        values, rows = noise.whitened(found.values), noise.whitened(found.derivatives[:, [*free]])
        size = abs(values)
        weights = numpy.where(size > _HUBER, _HUBER / numpy.maximum(size, _HUBER), 1.0)
        cost = float(numpy.where(size > _HUBER, _HUBER * (size - _HUBER / 2), values * values / 2).sum())
        weighted = rows * weights[:, None]
        return _System(found, weighted.T @ rows, weighted.T @ values, weights, cost)

    unknowns, damping = start, _FIRST_DAMPING
    system = system_at(unknowns)
    for _ in range(_STEPS):
        matrix, target = system.matrix, system.target
        scale = numpy.diag(matrix).copy()
        scale[scale <= 0] = 1.0
        step = _solved(matrix + damping * numpy.diag(scale), target)
        longest = max((abs(step[index]) for index, name in enumerate(free) if name != POINT), default=0.0)
        if longest > _LONGEST:
            step = step * (_LONGEST / longest)
        if float(target @ step) <= _SAME * system.cost:
            break
        new = unknowns.copy()
        new[[*free]] += step
        with numpy.errstate(over="ignore", invalid="ignore"):
            new_system = system_at(new)
        decrease = system.cost - new_system.cost
        if decrease >= 0:
            is_done = decrease <= _SAME * system.cost
            unknowns, damping, system = new, max(damping / 10, _LEAST_DAMPING), new_system
            if is_done:
                break
        else:
            damping *= 10
            if damping > _MOST_DAMPING:
                break
    return Minimum(unknowns, _inverse(system.matrix), noise, system.residuals, system.cost, system.weights)


def _solved(matrix: Array, target: Array) -> Array:
    """Return the solution of a linear system, by least squares if it is singular."""
    try:
        return numpy.linalg.solve(matrix, target)
    except numpy.linalg.LinAlgError:
        return numpy.linalg.lstsq(matrix, target, rcond=None)[0]


def _inverse(matrix: Array) -> Array:
    """Return the inverse of a symmetric matrix, scaled first; infinities if it is nearly singular."""
    scale = sqrt(numpy.diag(matrix))
    if not (scale > 0).all():
        return numpy.full_like(matrix, inf)
    scaled = matrix / numpy.outer(scale, scale)
    if numpy.linalg.cond(scaled) > _SINGULAR:
        return numpy.full_like(matrix, inf)
    return numpy.linalg.inv(scaled) / numpy.outer(scale, scale)


# --- Starts -----------------------------------------------------------------------------------------------------------


def with_point(points: Points, setting: Setting, w: float, modulus: float) -> Array:
    """Return the unknowns for w and E*, with z_c estimated from points; 0 for contact radii.

    Each point gives z − x, where x is the position at which the law has the force of the point; z_c is the median.
    """
    unknowns = numpy.array([log(w), log(modulus), 0.0])
    if setting.grip.is_radius:
        return unknowns
    contact, grip = setting.contact(unknowns), setting.grip
    reach = float(points.z.max() - points.z.min())
    _, _, x_last = state_at(setting.law, numpy.zeros(1), contact, grip)
    x = x_last + numpy.linspace(0, 1, 200) ** 2 * 2 * reach + 1e-12 * reach
    q, *_ = state_at(setting.law, x, contact, grip)
    loads = setting.law.values(q, contact)[0].load
    # Past the fold of fixed grips the load falls before it rises, and `interp` needs rising loads.
    rising = numpy.maximum.accumulate(loads) if loads[-1] > loads[0] else loads
    which = points.force >= loads[0]
    chosen = points.chosen(which) if which.any() else points
    unknowns[POINT] = float(numpy.median(chosen.z - numpy.interp(chosen.force, rising, x)))
    return unknowns


def best_of(starts: Sequence[Array], points: Points, setting: Setting, free: Sequence[int] | None = None) -> Minimum:
    """Return the minimum from the best of some starts: the start with the least spread of residuals after one round.

    Raises ValueError if no minimum is finite.
    """
    found = []
    for start in starts:
        reached = minimum(points, setting, start, free, rounds=1)
        if numpy.isfinite(reached.unknowns).all() and numpy.isfinite(reached.cost):
            found.append(reached)
    if not found:
        raise ValueError("no minimum")
    best = min(found, key=lambda reached: _spread(reached.residuals.values, len(reached.covariance)))
    return minimum(points, setting, best.unknowns, free)
