"""The errors of a fit, by noise, by the calibration of the instrument and by the model, and its remarks."""

from pathlib import Path
from typing import Any

import numpy
import pytest
from numpy import pi

from curves import autoregression, jkr_curve, jkr_force, ramp, soft_lever_curve
from jkroll import fit
from jkroll.fitting.baseline import Baseline, baseline_of
from jkroll.fitting.branches import (
    APPROACH,
    LOADING,
    PAUSE,
    RADIUS,
    TRAVEL,
    UNLOADING,
    ForceCurve,
    branches_of,
)
from jkroll.fitting.error_budget import Minima
from jkroll.fitting.fit import fit_curve
from jkroll.fitting.force_curves import PROFILES, Contact, Grip, curve_law, state_at
from jkroll.fitting.goodness import goodness_of
from jkroll.fitting.measurement import FittedBranch, Measurement, release_rate
from jkroll.fitting.minimum import Noise, Setting, minimum, noise_of, residuals
from jkroll.fitting.result import Known
from jkroll.report.fitted import row_of_result
from relative import approx

PROBE = Known(radius=7.5e-6, stiffness=3.01)
OPENING, CLOSING, MODULUS = "work_of_adhesion_opening", "work_of_adhesion_closing", "contact_modulus"


def maugis_curve(w: float, modulus: float, radius: float, stiffness: float) -> ForceCurve:
    """Return a curve by Maugis' law at a spacing of 4 Å, with little noise."""
    setting = Setting(curve_law("maugis", "paraboloid"), radius, 4e-10, Grip(stiffness))
    z = ramp(-20e-9, 20e-9, 300, UNLOADING)
    contact = Contact(w, modulus, radius, 4e-10)
    q, _, last = state_at(setting.law, z, contact, setting.grip)
    force = numpy.where(z < last, 0, setting.law.values(q, contact)[0].load)
    return ForceCurve(TRAVEL, z, force + numpy.random.default_rng(1).normal(0, 1e-11, len(z)))


# --- Calibration ------------------------------------------------------------------------------------------------------


def test_w_and_modulus_from_a_deflection_are_proportional_to_the_stiffness() -> None:
    """The force is kd, and the deflection d is a known part of the travel, so w and E* are proportional to k."""
    z, force = jkr_curve(count=250)
    known = PROBE._replace(stiffness_error=0.05)
    errors = fit_curve(ForceCurve(TRAVEL, z, force, is_deflection=True), known).errors
    assert errors[OPENING].calibration == approx(0.05 * 0.06, rel=5e-3)
    assert errors[CLOSING].calibration == approx(0.05 * 0.047, rel=5e-3)
    assert errors[MODULUS].calibration == approx(0.05 * 1.75e6, rel=5e-3)
    of_force = fit_curve(ForceCurve(TRAVEL, z, force), known).errors[OPENING].calibration
    assert of_force is not None
    assert of_force < 0.3 * 0.05 * 0.06


def test_the_calibration_error_is_absent_if_radius_and_stiffness_have_no_errors() -> None:
    z, force = jkr_curve(branches=(UNLOADING,), baseline=0.0)
    held = force != 0
    errors = fit_curve(ForceCurve(TRAVEL, z[held], force[held]), PROBE).errors
    assert {error.calibration for error in errors.values()} == {None}
    assert all(error.statistical is not None and error.model is not None for error in errors.values())


def soft_lever() -> ForceCurve:
    """Return a noisy curve without adhesion hysteresis; its fitted E* depends strongly on the lever's stiffness."""
    z, force = soft_lever_curve()
    return ForceCurve(TRAVEL, z, force + numpy.random.default_rng(3).normal(0, 1.5e-9, len(z)))


def test_the_error_from_the_spring_is_the_larger_change_of_a_result_at_both_ends_of_its_stiffness() -> None:
    """E* and the hysteresis are not linear in k: a lever that is too soft gives a hysteresis that is not there."""
    curve, known = soft_lever(), Known(radius=5e-6, stiffness=0.6, stiffness_error=0.1)
    here = fit_curve(curve, known)
    ends = [fit_curve(curve, Known(radius=5e-6, stiffness=0.6 * factor)).values for factor in (0.9, 1.1)]
    for name in (OPENING, CLOSING, MODULUS, "adhesion_hysteresis"):
        move = max(abs(there[name] - here.values[name]) for there in ends)
        assert here.errors[name].calibration == approx(move, rel=1e-6)
    hysteresis, modulus = (here.errors[name].calibration for name in ("adhesion_hysteresis", MODULUS))
    assert hysteresis is not None
    assert modulus is not None
    assert hysteresis > 0.01
    assert modulus > 2 * here.values[MODULUS]


def test_the_error_of_the_modulus_is_infinite_if_a_softer_spring_gives_a_rigid_contact() -> None:
    fit = fit_curve(soft_lever(), Known(radius=5e-6, stiffness=0.6, stiffness_error=0.25))
    assert fit.errors[MODULUS].calibration == numpy.inf
    assert "E* by +∞ or -82%" in fit.remarks["lever-decides"]
    assert row_of_result(fit, MODULUS)[2].endswith(" ± ∞")


def test_a_spring_without_an_error_has_a_remark_on_its_influence() -> None:
    remark = fit_curve(soft_lever(), Known(radius=5e-6, stiffness=0.6)).remarks["lever-decides"]
    assert remark.startswith("a spring 5% softer or stiffer moves E* by +81% or -41%, and Δw by up to 6.3 mJ/m²")
    assert remark.endswith(": give the spring's error, as in --spring 0.6±0.03N/m")
    z, force = jkr_curve(stiffness=300.0)
    stiff = fit_curve(
        ForceCurve(TRAVEL, z, force + autoregression(1, len(z), 3e-9, 0.0)), PROBE._replace(stiffness=300)
    )
    assert "lever-decides" not in stiff.remarks


def test_w_of_a_noisier_branch_has_a_larger_error() -> None:
    """Noise makes the baseline uncertain, and all loads of a branch shift with it; E* and z_c stay."""
    z, force = jkr_curve(count=250)
    noise = numpy.random.default_rng(4).normal(0, 3e-9, len(z))
    uneven = numpy.where(numpy.arange(len(z)) < len(z) // 2, 10 * noise, noise)  # loading is ten times as noisy
    errors = fit_curve(ForceCurve(TRAVEL, z, force + uneven), PROBE).errors
    opening, closing = (errors[name].statistical for name in (OPENING, CLOSING))
    assert opening is not None
    assert closing is not None
    assert closing > 3 * opening


def noisy_baselines(phi: float, *, tilt: bool) -> list[Baseline]:
    """Return the baselines of an unloading branch under 200 samples of noise, correlated by `phi`."""
    z, force = jkr_curve(count=400)
    baselines = []
    for seed in range(200):
        curve = ForceCurve(TRAVEL, z, force + autoregression(seed, len(z), 3e-9, phi))
        baseline = branches_of(curve, 3.01, tilt=tilt).by_name[UNLOADING].baseline
        assert baseline is not None
        baselines.append(baseline)
    return baselines


@pytest.mark.parametrize("phi", [0.0, 0.7])
def test_the_error_of_a_baseline_agrees_with_its_scatter(phi: Any) -> None:
    baselines = noisy_baselines(phi, tilt=False)
    scatter = numpy.std([baseline.force for baseline in baselines])
    assert numpy.median([baseline.error for baseline in baselines]) == approx(scatter, rel=0.12)


def test_the_error_of_the_slope_of_a_baseline_agrees_with_its_scatter() -> None:
    baselines = noisy_baselines(0.0, tilt=True)
    scatter = numpy.std([baseline.slope for baseline in baselines])
    assert numpy.median([baseline.slope_error for baseline in baselines]) == approx(scatter, rel=0.12)


def sloping(force: Any, z: Any, slope: float) -> ForceCurve:
    """Return a curve with noise on a sloping baseline."""
    noise = numpy.random.default_rng(7).normal(0, 3e-9, len(z))
    return ForceCurve(TRAVEL, z, force + slope * z + noise)


@pytest.mark.parametrize("last", [-0.6e-6, pytest.param(-2.5e-6, marks=pytest.mark.slow)])  # before, after jump-off
def test_a_sloping_baseline_has_a_remark_until_a_line_is_subtracted(last: float) -> None:
    z, force = jkr_curve(count=500)
    is_kept = (numpy.arange(len(z)) < 500) | (z > last)
    z, force = z[is_kept], force[is_kept]
    curve = sloping(force, z, 8e-3)
    fit = fit_curve(curve, PROBE)
    assert "--baseline tilt" in fit.remarks["baseline-slopes"]
    tilted = fit_curve(curve, PROBE._replace(tilt=True))
    assert {"baseline-slopes", "baseline-moves"}.isdisjoint(tilted.remarks)
    assert tilted.values[OPENING] == approx(0.06, rel=5e-3)
    assert "baseline-slopes" not in fit_curve(sloping(force, z, 0.0), PROBE).remarks
    assert "baseline-slopes" not in fit_curve(ForceCurve(TRAVEL, z, force), PROBE).remarks  # no noise, no slope


def test_the_slope_of_a_baseline_does_not_count_as_noise() -> None:
    z, force = jkr_curve(count=500)
    good = fit_curve(sloping(force, z, 8e-3), PROBE).goodness
    assert good["rms_over_noise"] == approx(1.0, rel=0.5)


def test_a_moving_baseline_has_a_remark_that_names_no_option() -> None:
    z, force = jkr_curve(count=500)
    force = force + numpy.where(numpy.arange(len(z)) < 500, 3e-8, 0.0)
    for tilt in (False, True):
        remarks = fit_curve(sloping(force, z, 0.0), PROBE._replace(tilt=tilt)).remarks
        assert remarks["baseline-moves"].startswith("the baseline moves by -29.")
        assert "--baseline" not in remarks["baseline-moves"]


# --- Model ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("w", "modulus", "radius", "stiffness"),
    [(0.02, 1e9, 5e-8, 4.0), pytest.param(0.02, 1e10, 5e-8, 40.0, marks=pytest.mark.slow)],
)
def test_below_a_tabor_parameter_of_5_the_model_error_includes_the_difference_from_maugis(
    w: float, modulus: float, radius: float, stiffness: float
) -> None:
    curve = maugis_curve(w, modulus, radius, stiffness)
    fit = fit_curve(curve, Known(radius=radius, stiffness=stiffness))
    by_maugis = fit_curve(curve, Known(radius=radius, stiffness=stiffness, law="maugis"))
    assert by_maugis.values[OPENING] == approx(w, rel=5e-3)
    assert fit.law_that_holds == "maugis"
    model = fit.errors[OPENING].model
    assert model is not None
    assert model >= 0.98 * abs(fit.values[OPENING] - by_maugis.values[OPENING]) > 0.05 * w
    assert abs(fit.values[OPENING] - w) < fit.errors[OPENING].total


def test_thinned_noise_agrees_with_the_noise_of_thinned_residuals() -> None:
    values = autoregression(8, 30_000, 2.0, 0.8)
    whole, thinned = noise_of(values, 0).thinned(3), noise_of(values[::3], 0)
    assert whole.phi == approx(thinned.phi, abs=0.02)
    assert whole.scale == approx(thinned.scale, rel=0.02)


def test_a_fit_with_a_sphere_also_gives_the_laws_of_a_paraboloid() -> None:
    z, force = jkr_curve(count=250)
    fit = fit_curve(ForceCurve(TRAVEL, z, force), PROBE._replace(profile="sphere"))
    assert set(fit.by_law) == {"jkr, sphere", "jkr", "maugis", "dmt"}
    assert fit.by_law["jkr, sphere"][OPENING] == fit.values[OPENING]
    of_paraboloid = fit_curve(ForceCurve(TRAVEL, z, force), PROBE).values[OPENING]
    assert fit.by_law["jkr"][OPENING] == approx(of_paraboloid, rel=5e-3)
    assert fit.values[OPENING] > 1.01 * of_paraboloid


@pytest.mark.parametrize("law", ["dmt", pytest.param("maugis", marks=pytest.mark.slow)])
def test_the_error_from_the_shape_of_the_sphere_does_not_depend_on_the_law(law: str) -> None:
    """JKR gives the effect of the shape on every law."""
    z, force = jkr_curve(count=250)
    curve = ForceCurve(TRAVEL, z, force + autoregression(1, len(z), 3e-9, 0.0))
    fit, by_jkr = fit_curve(curve, PROBE._replace(law=law)), fit_curve(curve, PROBE)
    move = by_jkr.by_law["jkr, sphere"][OPENING] - by_jkr.values[OPENING]
    model = fit.errors[OPENING].model
    assert model is not None
    assert model > 0.95 * move > 0.015 * by_jkr.values[OPENING]
    if law == "maugis":
        assert model == approx(by_jkr.errors[OPENING].model, rel=0.01)
        assert "profile-matters" in fit.remarks


# --- Without adhesion -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("profile", ["paraboloid", "sphere"])
def test_without_adhesion_the_fit_uses_the_profile_and_the_error_of_the_radius(profile: str) -> None:
    """For a paraboloid, E* is proportional to R^(−1/2)."""
    a = numpy.linspace(0, 2.5e-6, 4000)
    depth, _, _, load = PROFILES[profile].without_adhesion(a, 5e-6)
    z = ramp(-1e-6, 1.2e-6, 600, LOADING)
    force = numpy.interp(z, depth, 1e6 * load, left=0) + numpy.random.default_rng(6).normal(0, 1e-10, len(z))
    fit = fit_curve(ForceCurve(APPROACH, z, force), Known(radius=5e-6, radius_error=0.01, profile=profile))
    assert fit.values[MODULUS] == approx(1e6, rel=1e-3)
    assert "no-adhesion" in fit.remarks
    if profile == "paraboloid":
        assert fit.errors[MODULUS].calibration == approx(0.005e6, rel=0.02)
        assert "profile-matters" in fit.remarks
    else:
        by_paraboloid = fit_curve(ForceCurve(APPROACH, z, force), Known(radius=5e-6))
        assert by_paraboloid.values[MODULUS] < 0.98e6


def test_exact_zeros_are_not_taken_for_saturation() -> None:
    z = ramp(-1e-6, 1e-6, 400, LOADING)
    force = 4 / 3 * 1e6 * 5e-6**0.5 * numpy.maximum(z, 0) ** 1.5
    fit = fit_curve(ForceCurve(APPROACH, z, force), Known(radius=5e-6))
    assert {"saturated", "no-baseline"}.isdisjoint(fit.remarks)
    cut = fit_curve(ForceCurve(APPROACH, z, numpy.minimum(force, 0.6 * force.max())), Known(radius=5e-6))
    assert "saturated" in cut.remarks


# --- Goodness and remarks ---------------------------------------------------------------------------------------------


def test_the_misfit_counts_points_past_the_jump() -> None:
    """The contact point is 30 nm off, so that the jump of the model comes before the last points."""
    z, force = jkr_curve(branches=(UNLOADING,), baseline=0.0)
    measurement = Measurement(TRAVEL, PROBE, branches_of(ForceCurve(TRAVEL, z, force), 3.01))
    branch = measurement.branches.by_name[UNLOADING]
    points, unknowns = branch.in_contact, numpy.array([numpy.log(0.06), numpy.log(1.75e6), 2.3e-7])
    found = minimum(points, measurement.setting, unknowns, noise=Noise())
    found = found._replace(residuals=residuals(points, unknowns, measurement.setting))
    good = goodness_of(Minima(measurement, measurement.setting, FittedBranch(branch, points, found, (0, 1, 2))), 2e-6)
    shifted = jkr_force(points.z - 2.3e-7, 0.06, 1.75e6, 7.5e-6, 3.01)
    past = (shifted == 0).sum()
    shifted = numpy.where(shifted == 0, shifted.min(), shifted)  # the load of the last state
    assert good["points_past_jump"] == past > 5
    assert good["rms"] == approx(numpy.sqrt(numpy.mean((points.force - shifted) ** 2)), rel=0.02)


def test_a_contact_almost_as_wide_as_the_sphere_has_a_remark() -> None:
    w, modulus, radius = 0.045, 2e4, 1e-4
    a = numpy.linspace(0.95, 0.3, 40) * radius
    load = 4 / 3 * modulus * a**3 / radius - numpy.sqrt(8 * pi * w * modulus * a**3)
    assert "wide-contact" in fit_curve(ForceCurve(RADIUS, a, load), Known(radius=radius)).remarks
    narrow = fit_curve(ForceCurve(RADIUS, a[20:], load[20:]), Known(radius=radius))
    assert "wide-contact" not in narrow.remarks


def test_points_without_a_contact_radius_have_no_release_rate() -> None:
    """No contact with adhesion has a larger load than Hertz' contact at the same approach."""
    z, force = jkr_curve(branches=(UNLOADING,), baseline=0.0)
    curve = ForceCurve(TRAVEL, z, force)
    measurement = Measurement(TRAVEL, PROBE, branches_of(curve, 3.01))
    points = measurement.branches.by_name[UNLOADING].in_contact
    unknowns = numpy.array([numpy.log(0.06), numpy.log(1.75e6), 2e-7])
    rate, radius = release_rate(measurement, points._replace(force=points.force + 1e-5), unknowns)
    assert numpy.isnan(rate).all()
    assert numpy.isnan(radius).all()
    assert release_rate(measurement, points, unknowns)[0] == approx(0.06 + 0 * points.z, rel=1e-3)


def test_points_of_a_pause_are_left_out_and_gaps_in_time_have_a_remark() -> None:
    z, force = jkr_curve()
    unloading = PROBE._replace(branch="unload")
    top = int(numpy.argmax(z)) + 1
    names = numpy.array([LOADING] * top + [PAUSE] * 50 + [UNLOADING] * (len(z) - top), dtype=object)
    z, force = (numpy.concatenate([column[:top], numpy.full(50, column[top]), column[top:]]) for column in (z, force))
    time = numpy.arange(len(names), dtype=float)
    fit = fit_curve(ForceCurve(TRAVEL, z, force, branch=names, time=time), unloading)
    assert fit.values[OPENING] == approx(0.06, rel=1e-3)
    assert fit.remarks["pause"].startswith("50 points")
    assert "time-gaps" not in fit.remarks
    time[1400:] += 100.0
    time[300:] += 50.0
    time[350:] += 50.0
    fit = fit_curve(ForceCurve(TRAVEL, z, force, branch=names, time=time), unloading)
    assert fit.remarks["time-gaps"] == (
        "loading: the time has 2 gaps, the longest of 51 usual steps; unloading: the time has 1 gap of 101 usual "
        "steps: points may be missing"
    )


@pytest.mark.parametrize("tilt", [False, True])
def test_a_baseline_without_noise_has_the_least_standard_deviation_around_line_and_level(tilt: bool) -> None:
    baseline = baseline_of(numpy.linspace(0, 1e-6, 20), numpy.zeros(20), 1e-15, tilt=tilt)
    assert (baseline.noise, baseline.scatter) == (1e-15, 1e-15)
    assert baseline.error > 0


# --- A measured curve -------------------------------------------------------------------------------------------------


def jkr_of_lever(z: Any, adhesion: float, modulus: float, point: float, stiffness: float) -> tuple[Any, Any, float]:
    """Return force, dF/dz and the travel at which a lever jumps off, for R = 1, by the formulas of JKR (1971)."""
    unloaded = (9 * pi * adhesion / (2 * modulus)) ** (1 / 3)
    a = numpy.geomspace(0.2 * unloaded, 30 * unloaded, 20_001)
    approach = a**2 - numpy.sqrt(2 * pi * adhesion * a / modulus)
    load = 4 / 3 * modulus * a**3 - numpy.sqrt(8 * pi * adhesion * modulus * a**3)
    travel = point + approach + load / stiffness
    last = int(numpy.argmin(travel))
    travel, load = travel[last:], load[last:]
    slope = numpy.gradient(load, travel)
    return numpy.interp(z, travel, load), numpy.interp(z, travel, slope), float(travel[0])


def test_scipy_finds_the_same_fit_of_a_measured_afm_curve() -> None:
    """Both fits use the same points, with errors of force and travel that are equal as forces: kσ_z = σ_F."""
    optimize = pytest.importorskip("scipy.optimize")
    path = Path(__file__).parents[1] / "data" / "afm_retract.csv"
    fitted, stiffness = fit(str(path), spring="0.31451 N/m"), 0.31451
    _, most = fitted.fitted_loads[UNLOADING]
    is_fitted = fitted.points["force"] <= most
    z, force = (fitted.points[name][is_fitted] for name in ("z", "force"))
    noise = 1e-10

    def misfits(unknowns: Any) -> Any:
        adhesion, modulus = (float(each) for each in numpy.exp(unknowns[:2]))
        model, slope, jump = jkr_of_lever(z, adhesion, modulus, 1e-7 * unknowns[2], stiffness)
        inside = (force - model) / numpy.hypot(noise, slope * noise / stiffness)
        return numpy.where(z < jump, (z - jump) * stiffness / noise, inside)

    found = optimize.least_squares(misfits, [numpy.log(4e-9), numpy.log(250), -4.5], xtol=1e-12, ftol=1e-12).x
    assert is_fitted.sum() == fitted.goodness["points"] > 100
    assert fitted.values[OPENING] == approx(numpy.exp(found[0]), rel=5e-3)
    assert fitted.values[MODULUS] == approx(numpy.exp(found[1]), rel=5e-3)
    assert fitted.values["contact_point"] == approx(1e-7 * found[2], rel=5e-3)
