"""The fit of force curves returns the inputs of a computed curve, with errors as large as the scatter."""

from typing import Any

import numpy
import pytest
from numpy import exp, log, pi

from curves import autoregression, dmt_force, jkr_curve, jkr_state, ramp
from jkroll.fitting.branches import APPROACH, LOADING, RADIUS, TRAVEL, UNLOADING, BadCurve, ForceCurve, LoadRange
from jkroll.fitting.fit import fit_curve
from jkroll.fitting.force_curves import Contact, Grip, curve_law, state_at
from jkroll.fitting.minimum import Points, Setting, minimum, residuals, with_point
from jkroll.fitting.result import Known
from jkroll.physics import sneddon
from relative import approx

PROBE = Known(radius=7.5e-6, stiffness=3.01)
TRUE = {"work_of_adhesion_opening": 0.06, "work_of_adhesion_closing": 0.047, "contact_modulus": 1.75e6}


def deviations(fit: Any) -> Any:
    """Return the deviations of the fitted values from the true ones, over their statistical errors."""
    return [(fit.values[name] - value) / fit.errors[name].statistical for name, value in TRUE.items()]


@pytest.mark.parametrize(("sign", "baseline"), [(1, 0.0), (-1, 1e-8), (1, -2e-7)])
def test_a_curve_without_noise_gives_back_its_inputs(sign: Any, baseline: Any) -> None:
    z, force = jkr_curve(baseline=baseline)
    fit = fit_curve(ForceCurve(TRAVEL, sign * z, force), PROBE)
    assert fit.values["work_of_adhesion_opening"] == approx(0.06, rel=1e-4)
    assert fit.values["work_of_adhesion_closing"] == approx(0.047, rel=1e-4)
    assert fit.values["contact_modulus"] == approx(1.75e6, rel=3e-4)
    assert fit.values["contact_point"] == approx(sign * 2e-7, rel=1e-3)
    assert fit.values["adhesion_hysteresis"] == approx(0.013, rel=1e-3)
    assert fit.values["hysteresis_fraction"] == approx(0.013 / 0.06, rel=1e-3)


def test_a_curve_with_positive_tension_is_reversed() -> None:
    z, force = jkr_curve()
    fit = fit_curve(ForceCurve(TRAVEL, z, -force), PROBE)
    assert fit.values["work_of_adhesion_opening"] == approx(0.06, rel=1e-4)
    assert "force-reversed" in fit.remarks


@pytest.mark.parametrize("sign", [1, pytest.param(-1, marks=pytest.mark.slow)])
@pytest.mark.parametrize(
    ("low", "high", "stiffness", "branches"),
    [
        (-0.7e-6, 1.2e-6, 3.01, (LOADING, UNLOADING)),  # the curve ends before the jump-off
        (-0.7e-6, 1.2e-6, 3.01, (UNLOADING,)),
        (-6e-6, 0.3e-6, 3.01, (LOADING, UNLOADING)),  # in tension throughout
        (-0.3e-6, 4e-6, 30.0, (UNLOADING,)),
    ],
)
def test_positive_tension_is_recognized_in_incomplete_curves(
    low: Any, high: Any, stiffness: Any, branches: Any, sign: Any
) -> None:
    z, force = jkr_curve(low=low, high=high, stiffness=stiffness, branches=branches, count=300, baseline=0.0)
    noise = numpy.random.default_rng(1).normal(0, 3e-9, len(z))
    known = Known(radius=7.5e-6, stiffness=stiffness)
    for measured, is_reversed in ((force + noise, False), (-force - noise, True)):
        fit = fit_curve(ForceCurve(TRAVEL, sign * z, measured), known)
        assert fit.values["work_of_adhesion_opening"] == approx(0.06, rel=1e-2)
        assert ("force-reversed" in fit.remarks) == is_reversed


@pytest.mark.parametrize("seed", [1, *(pytest.param(seed, marks=pytest.mark.slow) for seed in (0, *range(2, 10)))])
def test_curves_of_random_sizes_and_stiffnesses_give_back_w_and_the_modulus(seed: Any) -> None:
    rng = numpy.random.default_rng(seed)
    radius, w = 10 ** rng.uniform(-7, -3), 10 ** rng.uniform(-2.3, -0.7)
    modulus = w / radius * 10 ** rng.uniform(2, 4)
    unloaded = (9 * pi * w * radius**2 / 2 / modulus) ** (1 / 3)
    force = 1.5 * pi * w * radius
    stiffness = modulus * unloaded * 10 ** rng.uniform(-0.5, 1)
    reach = force / (modulus * unloaded) + force / stiffness
    z, loads = jkr_curve(
        w, 0.8 * w, modulus, radius, stiffness, point=0.3 * reach, baseline=0.1 * force, count=300, low=-4 * reach,
        high=2 * reach,
    )  # fmt: skip
    fit = fit_curve(ForceCurve(TRAVEL, z, loads), Known(radius=radius, stiffness=stiffness))
    assert fit.values["work_of_adhesion_opening"] == approx(w, rel=1e-3)
    assert fit.values["contact_modulus"] == approx(modulus, rel=3e-3)


def test_a_curve_over_the_approach_needs_no_lever() -> None:
    x = numpy.geomspace(1 / 6, 3, 300)[::-1]
    approach, load = jkr_state(x, 0.06, 1.75e6, 7.5e-6)
    away = numpy.linspace(approach[-1] - 1e-8, 2 * approach[-1], 100)
    approach, load = numpy.concatenate([approach, away]), numpy.concatenate([load, 0 * away])
    fit = fit_curve(ForceCurve(APPROACH, approach + 1e-7, load), Known(radius=7.5e-6))
    assert fit.values["work_of_adhesion_opening"] == approx(0.06, rel=1e-3)
    assert fit.values["contact_modulus"] == approx(1.75e6, rel=3e-3)


def test_contact_radii_need_no_contact_point() -> None:
    x = numpy.linspace(0.55, 3, 40)[::-1]
    w, modulus, radius = 0.045, 2e6, 1e-3
    _, load = jkr_state(x, w, modulus, radius)
    a = (9 * pi * w * radius**2 / (2 * modulus)) ** (1 / 3) * x ** (2 / 3)
    fit = fit_curve(ForceCurve(RADIUS, a, load), Known(radius=radius))
    assert fit.values["work_of_adhesion_opening"] == approx(w, rel=1e-6)
    assert fit.values["contact_modulus"] == approx(modulus, rel=1e-6)
    assert "contact_point" not in fit.values
    a, load = numpy.append(a, [0.0, 0.0]), numpy.append(load, [0.0, 0.0])
    remark = fit_curve(ForceCurve(RADIUS, a, load), Known(radius=radius)).remarks["gaps"]
    assert remark == "2 of 42 points have no positive radius or no load and are left out"


def test_contact_radii_with_a_resting_edge_are_left_out_of_the_fit() -> None:
    """Unloading begins at the largest radius; the edge rests until the release of energy has risen to w of opening."""
    modulus, radius, first = 2e6, 1e-3, 1e-4
    scatter = numpy.random.default_rng(1).normal(0, 1e-7, 79)

    def load(a: Any, w: float) -> Any:
        return 4 / 3 * modulus * a**3 / radius - numpy.sqrt(8 * pi * w * modulus * a**3)

    there, back = numpy.linspace(6e-5, first, 30), numpy.linspace(first, 4.5e-5, 40)
    resting = numpy.linspace(load(first, 0.02), load(first, 0.045), 10)[1:]
    a = numpy.concatenate([there, numpy.full(9, first), back])
    loads = numpy.concatenate([load(there, 0.02), resting, load(back, 0.045)])
    fit = fit_curve(ForceCurve(RADIUS, a + scatter, loads), Known(radius=radius))
    assert fit.values["work_of_adhesion_opening"] == approx(0.045, rel=5e-3)
    assert fit.values["work_of_adhesion_closing"] == approx(0.02, rel=2e-2)
    assert fit.values["contact_modulus"] == approx(modulus, rel=1e-2)


def test_contact_radii_give_w_without_tension() -> None:
    """All loads are compressive, 5 to 300 times the pull-off force."""
    a = numpy.linspace(3e-4, 1e-4, 40)
    load = 4 / 3 * 2e6 * a**3 / 1e-3 - numpy.sqrt(8 * pi * 0.045 * 2e6 * a**3)
    fit = fit_curve(ForceCurve(RADIUS, a, load), Known(radius=1e-3))
    assert load.min() > 0
    assert fit.values["work_of_adhesion_opening"] == approx(0.045, rel=1e-6)
    assert {"no-adhesion", "few-below-zero"}.isdisjoint(fit.remarks)
    with pytest.raises(BadCurve, match="give --radius"):
        fit_curve(ForceCurve(RADIUS, a, load), Known())


def test_a_named_branch_may_be_sorted_by_travel() -> None:
    z, force = jkr_curve(count=250)
    top = int(numpy.argmax(z))
    names = numpy.where(numpy.arange(len(z)) < top, LOADING, UNLOADING).astype(object)
    order = numpy.concatenate([numpy.arange(top), numpy.arange(top, len(z))[::-1]])
    fit = fit_curve(ForceCurve(TRAVEL, z[order], force[order], branch=names[order]), PROBE)
    assert fit.values["work_of_adhesion_opening"] == approx(0.06, rel=1e-4)
    assert fit.values["work_of_adhesion_closing"] == approx(0.047, rel=1e-4)


def test_a_single_branch_is_fitted_as_the_branch_that_the_user_names() -> None:
    z, force = jkr_curve(count=250)
    back = slice(int(numpy.argmax(z)) + 1, None)
    alone = ForceCurve(TRAVEL, z[back][::-1], force[back][::-1])
    assert "one-branch" in fit_curve(alone, PROBE).remarks
    fit = fit_curve(alone, PROBE._replace(branch="unload"))
    assert fit.values["work_of_adhesion_opening"] == approx(0.06, rel=1e-4)


def test_covariances_with_the_contact_point_change_sign_with_the_travel() -> None:
    z, force = jkr_curve(count=250)
    force = force + numpy.random.default_rng(3).normal(0, 1e-9, len(z))
    one, other = (fit_curve(ForceCurve(TRAVEL, sign * z, force), PROBE).covariance for sign in (1, -1))
    assert one[1, 2] == approx(-other[1, 2], rel=1e-3)


def test_without_a_radius_the_fit_gives_products_with_the_radius() -> None:
    z, force = jkr_curve(branches=(UNLOADING,))
    fit = fit_curve(ForceCurve(TRAVEL, z, force), Known(stiffness=3.01))
    assert fit.values["work_of_adhesion_opening"] == approx(0.06 * 7.5e-6, rel=1e-3)
    assert fit.values["contact_modulus"] == approx(1.75e6 * 7.5e-6**0.5, rel=3e-3)
    assert fit.remarks["radius-free"].endswith("w is wR and E* is E*√R, for a paraboloid by JKR")
    by_dmt = fit_curve(ForceCurve(TRAVEL, z, force), Known(stiffness=3.01, law="dmt"))
    assert by_dmt.remarks["radius-free"].endswith(" by DMT")


def test_a_curve_by_dmt_gives_back_its_inputs() -> None:
    z = ramp(-4e-9, 6e-9, 200, UNLOADING)
    force = dmt_force(z, 0.02, 1e10, 5e-8, 40.0) + autoregression(1, len(z), 1e-12, 0.0)
    fit = fit_curve(ForceCurve(TRAVEL, z, force), Known(radius=5e-8, stiffness=40.0, law="dmt"))
    assert fit.values["work_of_adhesion_opening"] == approx(0.02, rel=1e-3)
    assert fit.values["contact_modulus"] == approx(1e10, rel=3e-3)
    assert fit.law_that_holds == "maugis"


def test_maugis_law_gives_back_the_inputs_of_a_jkr_curve() -> None:
    z, force = jkr_curve(branches=(UNLOADING,), count=150)
    fit = fit_curve(ForceCurve(TRAVEL, z, force + autoregression(1, len(z), 3e-10, 0.0)), PROBE._replace(law="maugis"))
    assert fit.values["work_of_adhesion_opening"] == approx(0.06, rel=1e-3)
    assert fit.values["contact_modulus"] == approx(1.75e6, rel=3e-3)


@pytest.mark.parametrize("name", ["jkr", "dmt", "maugis"])
@pytest.mark.parametrize("grip", [Grip(3.0), Grip(), Grip(is_radius=True)], ids=["lever", "grips", "radius"])
def test_derivatives_agree_with_finite_differences(name: Any, grip: Any) -> None:
    setting = Setting(curve_law(name, "paraboloid"), 1e-6, 4e-10, grip)
    contact = Contact(0.03, 1e7, 1e-6, 4e-10)
    last = setting.law.last(contact, grip)
    low = float(grip.x(setting.law.values(last, contact)[0]))
    reach = 1e-7 if not grip.is_radius else 3e-7
    z = low + numpy.linspace(-0.1 if not grip.is_radius else 0.3, 1, 12) * reach
    points = Points(z, numpy.linspace(-1, 3, 12) * 1e-7, numpy.full(12, 1e-9), numpy.full(12, 3e-10))
    unknowns = numpy.array([log(0.03), log(1e7), 0.0])
    here = residuals(points, unknowns, setting)
    slopes = setting.law.values(state_at(setting.law, z, contact, grip)[0], contact)[1]
    weights = grip.x(slopes)[2:] / numpy.hypot(grip.x(slopes) * 1e-9, slopes.load * 3e-10)[2:]
    for index, step in enumerate((1e-4, 1e-4, 1e-12)[: len(setting.free)]):
        ends = []
        for side in (-1, 1):
            other = unknowns.copy()
            other[index] += side * step
            ends.append(residuals(points, other, setting).loads)
        expected = weights * ((ends[1] - ends[0]) / (2 * step))[2:]
        assert not here.is_beyond[2:].any()
        assert numpy.allclose(here.derivatives[2:, index], expected, rtol=1e-4, atol=1e-4 * abs(expected).max())


@pytest.mark.parametrize("factor", [0.1, 0.2, 5.0, 10.0])
@pytest.mark.parametrize("wrong", ["w", "modulus"])
def test_the_minimum_is_found_from_a_start_that_is_off_by_a_factor_of_up_to_10(factor: Any, wrong: Any) -> None:
    z, force = jkr_curve(branches=(UNLOADING,), baseline=0.0, count=300)
    held = force != 0
    points = Points(z[held], force[held], numpy.full(held.sum(), 3e-9), numpy.full(held.sum(), 1e-9))
    setting = Setting(curve_law("jkr", "paraboloid"), 7.5e-6, 4e-10, Grip(3.01))
    start = with_point(
        points, setting, 0.06 * (factor if wrong == "w" else 1), 1.75e6 * (factor if wrong == "modulus" else 1)
    )
    found = minimum(points, setting, start)
    assert exp(found.unknowns[0]) == approx(0.06, rel=1e-3)
    assert exp(found.unknowns[1]) == approx(1.75e6, rel=3e-3)


def test_scipy_finds_the_same_minimum() -> None:
    optimize = pytest.importorskip("scipy.optimize")
    z, force = jkr_curve(branches=(UNLOADING,), baseline=0.0, count=300)
    force = force + numpy.random.default_rng(5).normal(0, 3e-9, len(force))
    held = z > -4e-7
    points = Points(z[held], force[held], numpy.full(held.sum(), 3e-9), numpy.full(held.sum(), 1e-9))
    setting = Setting(curve_law("jkr", "paraboloid"), 7.5e-6, 4e-10, Grip(3.01))
    own = minimum(points, setting, numpy.array([log(0.05), log(2e6), 1.5e-7]), rounds=1)

    def scaled(unknowns: Any) -> Any:
        return residuals(points, unknowns * [1, 1, 1e-7], setting).values / own.noise.scale

    theirs = optimize.least_squares(scaled, [log(0.05), log(2e6), 1.5], loss="linear", xtol=1e-14, ftol=1e-14)
    errors = numpy.sqrt(numpy.diag(own.covariance))
    assert numpy.abs((theirs.x * [1, 1, 1e-7] - own.unknowns) / errors).max() < 0.2


@pytest.mark.slow
@pytest.mark.parametrize("phi", [0.0, 0.8])
def test_about_two_thirds_of_the_fits_lie_within_the_statistical_error(phi: Any) -> None:
    known = PROBE._replace(range=LoadRange(-1.0, 0.3, True))
    z, force = jkr_curve()
    found = [
        deviations(fit_curve(ForceCurve(TRAVEL, z, force + autoregression(seed, len(z), 3e-9, phi)), known))
        for seed in range(300)
    ]
    inside = (abs(numpy.array(found)) < 1).mean(axis=0)
    assert (inside > 0.6).all()
    assert (inside < 0.75).all()


def test_the_calibration_error_is_the_change_that_a_wrong_radius_or_spring_causes() -> None:
    z, force = jkr_curve(branches=(UNLOADING,), count=250)
    curve = ForceCurve(TRAVEL, z, force + autoregression(1, len(z), 1e-9, 0.0))
    errors = fit_curve(curve, PROBE._replace(radius_error=0.01)).errors
    assert errors["work_of_adhesion_opening"].calibration == approx(0.01 * 0.06, rel=0.05)
    by_spring = fit_curve(curve, PROBE._replace(stiffness_error=0.05))
    moved = fit_curve(curve, PROBE._replace(stiffness=3.01 * 1.05, range=LoadRange(-1.0, 1.0, True)))
    move = moved.values["contact_modulus"] - 1.75e6
    assert by_spring.errors["contact_modulus"].calibration == approx(abs(move), rel=0.4)
    assert "lever-decides" in by_spring.remarks


def test_errors_add_in_quadrature() -> None:
    z, force = jkr_curve(count=250)
    fit = fit_curve(
        ForceCurve(TRAVEL, z, force + autoregression(3, len(z), 3e-9, 0.5)), PROBE._replace(radius_error=0.01)
    )
    for errors in fit.errors.values():
        assert None not in errors
        assert errors.total == approx(numpy.linalg.norm([error or 0.0 for error in errors]))
    opening, closing = (fit.names.index(f"work_of_adhesion_{way}") for way in ("opening", "closing"))
    covariance = fit.covariance
    variance = covariance[opening, opening] + covariance[closing, closing] - 2 * covariance[opening, closing]
    assert fit.errors["adhesion_hysteresis"].statistical == approx(variance**0.5)


def test_a_curve_without_adhesion_gives_an_upper_limit_of_w() -> None:
    z = ramp(-1e-6, 1e-6, 500, LOADING)
    force = 4 / 3 * 1e6 * 5e-6**0.5 * numpy.maximum(z, 0) ** 1.5
    force = force + numpy.random.default_rng(2).normal(0, 1e-10, len(z))
    fit = fit_curve(ForceCurve(APPROACH, z, force), Known(radius=5e-6))
    assert "no-adhesion" in fit.remarks
    assert fit.values["contact_modulus"] == approx(1e6, rel=0.02)
    assert fit.largest_adhesion is not None
    assert 0 < fit.largest_adhesion < 1e-3
    assert "work_of_adhesion_opening" not in fit.values


@pytest.mark.parametrize(
    ("z", "force", "phrase"),
    [
        ([1, 2, 3], [1, 2, 3], "too few points"),
        ([numpy.nan] * 20, [1.0] * 20, "too few points"),
        (numpy.linspace(0, 1, 50), [1.0] * 50, "no curve"),
        ([1.0] * 50, numpy.linspace(0, 1, 50), "no curve"),
    ],
)
def test_data_without_a_curve_are_refused(z: Any, force: Any, phrase: Any) -> None:
    with pytest.raises(BadCurve) as refused:
        fit_curve(ForceCurve(TRAVEL, numpy.array(z, float), numpy.array(force, float)), PROBE)
    assert refused.value.phrase == phrase


def test_the_fit_withstands_gaps_and_outliers() -> None:
    z, force = jkr_curve()
    rng = numpy.random.default_rng(11)
    force = force + rng.normal(0, 3e-9, len(force))
    force[rng.choice(len(force), 20, replace=False)] += 3e-7
    force[rng.choice(len(force), 50, replace=False)] = numpy.nan
    fit = fit_curve(ForceCurve(TRAVEL, z, force), PROBE)
    assert fit.values["work_of_adhesion_opening"] == approx(0.06, rel=0.005)
    assert fit.values["contact_modulus"] == approx(1.75e6, rel=0.03)
    assert fit.remarks["gaps"].startswith("50 of 1500 points")


def test_a_sphere_is_distinguished_from_a_paraboloid() -> None:
    setting = Setting(curve_law("jkr", "sphere"), 7.5e-6, 4e-10, Grip(3.01))
    z = ramp(-2.5e-6, 1.2e-6, 250, UNLOADING)
    contact = Contact(0.06, 1.0e6, 7.5e-6, 4e-10)
    q, _, last = state_at(setting.law, z, contact, setting.grip)
    force = numpy.where(z < last, 0.0, setting.law.values(q, contact)[0].load)
    force += autoregression(1, len(z), 1e-9, 0.0)
    by_sphere = fit_curve(ForceCurve(TRAVEL, z, force), PROBE._replace(profile="sphere"))
    assert by_sphere.values["work_of_adhesion_opening"] == approx(0.06, rel=1e-3)
    assert by_sphere.values["contact_modulus"] == approx(1.0e6, rel=3e-3)
    by_paraboloid = fit_curve(ForceCurve(TRAVEL, z, force), PROBE)
    assert 0.01 < 1 - by_paraboloid.values["work_of_adhesion_opening"] / 0.06 < 0.05  # too low
    assert "profile-matters" in by_paraboloid.remarks


@pytest.mark.parametrize("stiffness", [0.3, 3.0, 300.0, numpy.inf])
def test_states_of_a_sphere_agree_with_physics_sneddon(stiffness: float) -> None:
    """`physics.sneddon` computes the states in dimensionless form, with another variable."""
    radius, w, modulus = 7.5e-6, 0.06, 1e6
    setting = Setting(curve_law("jkr", "sphere"), radius, 4e-10, Grip(stiffness))
    contact = Contact(w, modulus, radius, 4e-10)
    ratio, compliance = w / (modulus * radius), modulus * radius / stiffness
    last = sneddon.last_state(ratio, 1.0, compliance)
    assert setting.law.last(contact, setting.grip) == approx(radius * numpy.tanh(last), rel=1e-7)
    x_last = sneddon.approach(ratio, last) + compliance * sneddon.load(ratio, last)
    x = (x_last + numpy.linspace(0.01, 1, 20)) * radius
    found = state_at(setting.law, x, contact, setting.grip)[0]
    expected = sneddon.state_at(x / radius, ratio, last, 1.0, compliance)
    assert found == approx(radius * numpy.tanh(expected), rel=1e-9)


# --- Ranges and points left out ---------------------------------------------------------------------------------------


def test_a_range_without_tension_gives_w_with_a_large_error_or_is_refused_with_advice() -> None:
    z, force = jkr_curve(count=500)
    curve = ForceCurve(TRAVEL, z, force + autoregression(1, len(z), 3e-9, 0.0))
    pressed = fit_curve(curve, PROBE._replace(range=LoadRange(0.05, 1.0, True)))
    name = "work_of_adhesion_opening"
    assert abs(pressed.values[name] - 0.06) < 3 * pressed.errors[name].total > 0.06
    assert "few-below-zero" in pressed.remarks
    with pytest.raises(BadCurve, match="need points in tension, as in --range -100%:30%"):
        fit_curve(curve, PROBE._replace(range=LoadRange(0.9, 1.0, True)))


def test_the_points_of_a_short_branch_are_counted_and_the_largest_load_is_fitted() -> None:
    """A table of contact radii under rising load ends at its largest load."""
    a = numpy.linspace(0.2e-3, 0.6e-3, 15)
    load = 4 * 1.3e6 * a**3 / 0.03 - numpy.sqrt(8 * pi * 0.044 * 1.3e6 * a**3)
    rising = fit_curve(ForceCurve(RADIUS, a, load), Known(radius=0.01))
    assert rising.goodness["points"] == 15
    assert "branch-left-out" not in rising.remarks
    a, load = (numpy.append(column, column[[-1, -2, -3]]) for column in (a, load))
    turned = fit_curve(ForceCurve(RADIUS, a, load), Known(radius=0.01))
    assert turned.remarks["branch-left-out"] == "3 points are left out at one end of the curve, since a branch needs 5"


def test_a_branch_that_never_touches_is_left_out() -> None:
    """Loading ends before the contact point at 0.2 µm, and unloading is held in tension beyond it."""
    z, force = jkr_curve(count=250, high=0.199e-6)
    fit = fit_curve(ForceCurve(TRAVEL, z, force + autoregression(1, len(z), 3e-9, 0.0)), PROBE)
    assert fit.remarks["branch-left-out"] == "loading: fewer than 5 points are in contact; the branch is left out"
    assert fit.values["work_of_adhesion_opening"] == approx(0.06, rel=5e-3)
    assert "work_of_adhesion_closing" not in fit.values
