"""The goodness of a fit: misfit, runs of residuals with one sign, a pinned edge, and remarks by code."""

from collections.abc import Iterator, Mapping

import numpy
from numpy import exp, inf, isfinite, sqrt

from ..physics.sphere import INCOMPRESSIBLE
from ..quantities.formatting import Format, amount, significant
from ..quantities.laws import LAWS
from .branches import LEAST_POINTS, LOADING, RADIUS, running_median
from .error_budget import ByResult, Minima
from .measurement import WORK_OF_ADHESION
from .minimum import ADHESION, FEW_INDEPENDENT, robust_deviation
from .result import Errors, Fit, Known, is_on_plane, ratio_of_plane

LAW_OFF = "law-off"  # the code of a law that does not hold
USUAL_ERROR = 0.05  # relative error of a spring, if none is given
_TWO_DIGITS, _THREE_DIGITS = Format(digits=2), Format(digits=3)
_UNLIKE = 1.2  # ratio of two stiffnesses above which they are not those of one spring
_UNDETERMINED = 0.5  # standard deviation of ln E* above which E* is undetermined
_SURE = 2.0  # a hysteresis that is below 0 by more than this number of its errors is not due to chance
_POOR = 0.1  # rms misfit over the pull-off force, above which the curve is not that of a contact
_WIDEST = 0.9  # a/R above which no theory of a half-space applies


def goodness_of(minima: Minima, pull_off: float | None) -> dict[str, float]:
    """Return the measures of goodness by name; points past the jump-off are compared with the load just before it."""
    main, found = minima.main, minima.main.minimum
    misfit = main.points.force - found.residuals.loads
    rms, count = float(sqrt(numpy.mean(misfit**2))), len(main.points.z)
    tau = max(found.correlation_time, 1.0)
    good = {
        "points": float(count), "points_past_jump": float(found.residuals.is_beyond.sum()), "rms": rms,
        "rms_over_noise": rms / minima.measurement.branches.noise, "correlation_time": found.correlation_time,
        "independent_points": count / tau, "longest_run": float(_longest_run(misfit)),
    }  # fmt: skip
    return good if pull_off is None else good | {"rms_over_pull_off": rms / pull_off}


def _longest_run(misfit: numpy.ndarray) -> int:
    """Return the largest number of consecutive residuals with one sign."""
    changes = numpy.nonzero(numpy.diff(numpy.sign(misfit)) != 0)[0]
    ends = numpy.concatenate([[-1], changes, [len(misfit) - 1]])
    return int(numpy.diff(ends).max())


def remarks_on(minima: Minima, result: Fit, by_spring: list[ByResult]) -> Iterator[tuple[str, str]]:
    """Iterate over remarks as codes and sentences.

    `by_spring`: the moves of the results for a softer and a stiffer spring; empty if no spring enters.
    """
    main, good, errors = minima.main, result.goodness, result.errors
    has_adhesion = ADHESION in main.free
    if has_adhesion and main.branch.name == LOADING and result.kind != RADIUS:
        yield "loading-only", "without an unloading branch, w is hardly separated from E*: their errors are correlated"
    yield from _on_noise(good)
    if good.get("rms_over_pull_off", 0.0) > _POOR:
        share = f"{good['rms_over_pull_off']:.0%} of the pull-off force"
        yield "poor-fit", f"the misfit is {share}: this is not the curve of one contact"
    hysteresis = result.values.get("adhesion_hysteresis", 0.0)
    if hysteresis < 0 and -hysteresis > _SURE * errors["adhesion_hysteresis"].total:
        yield (
            "negative-hysteresis",
            (
                "the loading branch needs more work than the unloading one, which no contact does: the branches may be "
                "exchanged; check the order of the points, or the column of branches"
            ),
        )
    if result.better_law:
        yield LAW_OFF, _on_law(result, WORK_OF_ADHESION[main.branch.name])
    modulus = result.values["contact_modulus"]
    if not (errors["contact_modulus"].statistical or 0.0) < _UNDETERMINED * modulus:
        yield (
            "modulus-undetermined",
            "E* is not determined: the contact is stiffer than the lever, or has too few points; use P_c alone",
        )
    if by_spring:
        yield from _on_spring(result, *by_spring)
    if has_adhesion and result.kind != RADIUS and int((main.points.force < 0).sum()) < LEAST_POINTS:
        yield "few-below-zero", f"fewer than {LEAST_POINTS} points are in tension: w is hardly determined"
    if not result.is_scaled and good["contact_over_radius"] > _WIDEST:
        wide = f"the contact radius is above {_WIDEST} of the sphere's"
        yield "wide-contact", f"{wide}: theories of a half-space do not apply"
    if has_adhesion:
        yield from _on_pinned_edge(minima, result.points)


def _on_law(result: Fit, name: str) -> str:
    """Return the sentence on a fitted law that does not hold. `name`: the work of adhesion of the main branch."""
    law, better = LAWS[result.known.law].short, LAWS[result.better_law].short
    share = result.values[name] / result.by_law[result.better_law][name] - 1
    off = f"w by {law} is {abs(share):.0%} {'above' if share > 0 else 'below'} w by {better}"
    tabor = significant(result.goodness["tabor_parameter"], 2)
    return f"{off}, which holds at a Tabor parameter of {tabor}: give --model {result.better_law}"


def _on_noise(good: Mapping[str, float]) -> Iterator[tuple[str, str]]:
    """Iterate over remarks on few or correlated points, and on a trend in the residuals."""
    count, tau = good["points"], good["correlation_time"]
    if good["independent_points"] < FEW_INDEPENDENT:
        cause = f"residuals are correlated over {tau:.0f} points"
        if tau < 2:
            cause = f"{count:.0f} points are few"
        elif tau > count / 2:
            cause = "the misfit is one trend"
        yield "few-independent", f"{cause}: the statistical error is unreliable"
    elif tau > 1 and good["longest_run"] > 0.1 * count + 10:
        run = f"residuals have one sign over {good['longest_run']:.0f} points in a row"
        yield "residual-trend", f"{run}: the model, not the noise, limits the fit"


def _on_spring(result: Fit, softer: ByResult, stiffer: ByResult) -> Iterator[tuple[str, str]]:
    """Yield a remark if the error of the spring moves E* by more than both the statistical and the model error of E*.

    `softer`, `stiffer`: the moves of the results if the spring is softer or stiffer by its error, or by 5 % if no error
    is given; the remark then asks for the error.
    """
    known, errors, modulus = result.known, result.errors["contact_modulus"], result.values["contact_modulus"]
    shares = [move["contact_modulus"] / modulus for move in (softer, stiffer)]
    if not max(map(abs, shares)) * modulus > max(errors.statistical or 0.0, errors.model or 0.0):
        return
    size = known.stiffness_error or USUAL_ERROR
    below, above = (f"{share:+.0%}" if abs(share) < inf else "+∞" for share in shares)
    text = f"a spring {100 * size:.2g}% softer or stiffer moves E* by {below} or {above}"
    hysteresis = max(abs(move.get("adhesion_hysteresis", 0.0)) for move in (softer, stiffer))
    if 0 < hysteresis < inf and not result.is_scaled:
        text += f", and Δw by up to {amount('adhesion_hysteresis', hysteresis, _TWO_DIGITS)}"
    if known.stiffness_error:
        yield "lever-decides", f"{text}: more than the noise and the model do"
    else:
        typed = f"{known.stiffness:.4g}±{known.stiffness * size:.2g}N/m"
        yield "lever-decides", f"{text}: give the spring's error, as in --spring {typed}"


def on_deflection(slope: float | None, stiffness: float) -> Iterator[tuple[str, str]]:
    """Yield a remark if the slope of the force over the deflection is not the stiffness of the spring."""
    if slope is not None and isfinite(stiffness) and not 1 / _UNLIKE <= slope / stiffness <= _UNLIKE:
        there, here = (amount("lever_stiffness", value, _THREE_DIGITS) for value in (slope, stiffness))
        differ = f"force over deflection is {there} in the columns of the table, and the spring has {here}"
        yield "spring-differs", f"{differ}: check the units of both columns, and --spring"


def on_profile(
    values: ByResult, sphere: ByResult, errors: Mapping[str, Errors], width: float, known: Known
) -> Iterator[str]:
    """Yield a sentence if w or E* for a sphere by JKR differs from that for a paraboloid by more than its error.

    `values`: the results for a paraboloid by JKR, whichever law is fitted. The sentence has the options for a fit of
    the sphere, unless such a fit would be refused.
    """
    adhesion = [name for name in WORK_OF_ADHESION.values() if name in values][:1]
    symbols = {**dict.fromkeys(adhesion, "w"), "contact_modulus": "E*"}
    if not any(abs(sphere[name] - values[name]) > errors[name].total for name in symbols):
        return
    moved = ", ".join(f"{symbol} {_percent(sphere[name] / values[name] - 1)}" for name, symbol in symbols.items())
    ratio = ratio_of_plane(known.given)
    how = "for a rigid sphere on a plane that keeps its volume"
    if is_on_plane(known.given) and (ratio is None or ratio >= INCOMPRESSIBLE):
        how = "with --profile sphere"
        if ratio is None:
            how += " --poisson2 0.5"
    yield f"a/R is up to {width:.2f}, where a sphere is no paraboloid: {moved} by JKR {how}"


def _percent(share: float) -> str:
    """Return a change in percent with its sign.

    >>> _percent(0.0231), _percent(-0.0002)
    ('+2.3%', '0.0%')
    """
    text = f"{share:+.1%}"
    return "0.0%" if text[1:] == "0.0%" else text


def _on_pinned_edge(minima: Minima, points: Mapping[str, numpy.ndarray]) -> Iterator[tuple[str, str]]:
    """Yield a remark if the edge is pinned.

    It is pinned if, over some run of points, G changes by more than w/5 and 10 times its noise, but the contact radius
    by less than 1 %.
    """
    is_own = (points["branch"] == minima.main.branch.name) & numpy.isfinite(points["release_rate"])
    if is_own.sum() < LEAST_POINTS:
        return
    rate, radius = (running_median(points[name][is_own]) for name in ("release_rate", "contact_radius"))
    size = max(LEAST_POINTS, len(rate) // 15)
    w = float(exp(minima.main.unknowns[ADHESION]))
    noise = robust_deviation(points["release_rate"][is_own] - rate)
    for start in range(0, len(rate) - size, max(1, size // 2)):
        moved_rate = float(numpy.ptp(rate[start : start + size]))
        moved_radius = float(numpy.ptp(radius[start : start + size]))
        if moved_rate > max(0.2 * w, 10 * noise) and moved_radius < 0.01 * float(radius[start]):
            pinned = float(radius[start]) / minima.measurement.radius
            yield "edge-pinned", f"G changes at constant a/R = {pinned:.2f}: the edge is pinned there"
            return
