"""The force of a meniscus of condensed water, compared with that of the exact shape: a nodoid, integrated here."""

import math

import numpy as np
import pytest

from harness import Run
from jkroll import solve
from jkroll.physics.meniscus import WATER_TENSION, WIDEST, kelvin_radius, meniscus_force, meniscus_size
from relative import approx

ANGLES = [0.0, 20.0, 40.0, 60.0, 80.0]
GAS_CONSTANT, ROOM = 8.314462618, 298.15  # J/(mol K), K


def nodoid(kelvin: float, contact_angle: float, *, is_pair: bool) -> tuple[float, float]:
    """Return F/(4πRγ_L cosθ) of a meniscus with r_K = `kelvin` R, and its half-filling angle on the sphere.

    A sphere of radius 1 touches a plane or an equal sphere; R is the reduced radius. ψ is the slope of the water's
    surface against the plane, and r sinψ + r²/(2r_K) = F/(2πγ_L) at every height. The surface spans the gap between the
    bodies at the half-filling angle.
    """
    from scipy.integrate import quad  # type: ignore[import-untyped]
    from scipy.optimize import brentq  # type: ignore[import-untyped]

    reduced = 0.5 if is_pair else 1.0
    radius = kelvin * reduced

    def pull(top: float) -> float:
        """Return 2r_K F/(2πγ_L)."""
        return 2 * radius * math.sin(top) * math.sin(top + contact_angle) + math.sin(top) ** 2

    def excess(logarithm: float) -> float:
        top = math.exp(logarithm)
        pulled, first = pull(top), top + contact_angle if is_pair else contact_angle

        def rise(slope: float) -> float:
            down = radius * math.sin(slope)
            root = math.hypot(down, math.sqrt(pulled))
            return down * pulled / (root * (root + down))

        spanned = quad(rise, first, math.pi - top - contact_angle, epsabs=0, epsrel=1e-11)[0]
        return float(math.log(spanned / ((2 if is_pair else 1) * 2 * math.sin(top / 2) ** 2)))

    most = (math.pi / 2 - contact_angle) * (1 if is_pair else 2)
    least = 0.1 * min(most, math.sqrt(radius * math.cos(contact_angle)))
    top = math.exp(brentq(excess, math.log(least), math.log(most * 0.9999), xtol=1e-13))
    return float(pull(top) / (2 * radius) / (2 * reduced * math.cos(contact_angle))), float(top)


def by_first_order(ratio: float, contact_angle: float) -> tuple[float, float]:
    """Return F/(4πRγ_L cosθ) by the program for a ratio r_K/R, and the size q of the meniscus."""
    size = float(meniscus_size(kelvin_radius=ratio, reduced_radius=1.0, contact_angle=contact_angle))
    force = meniscus_force(reduced_radius=1.0, contact_angle=contact_angle, meniscus_size=size)
    return float(force) / (4 * math.pi * WATER_TENSION * math.cos(contact_angle)), size


@pytest.mark.parametrize("is_pair", [False, True])
@pytest.mark.parametrize("degrees", ANGLES)
def test_the_first_order_is_that_of_the_exact_meniscus(degrees: float, is_pair: bool) -> None:
    angle = math.radians(degrees)
    for ratio in (1e-5, 1e-7):
        force, _ = nodoid(ratio, angle, is_pair=is_pair)
        assert 1 - force == approx(by_first_order(ratio, angle)[1], rel=3 * math.sqrt(ratio))


@pytest.mark.parametrize("is_pair", [False, True])
@pytest.mark.parametrize("degrees", ANGLES)
def test_the_exact_meniscus_is_in_the_stated_range(degrees: float, is_pair: bool) -> None:
    angle = math.radians(degrees)
    kappa = float(meniscus_size(kelvin_radius=1.0, reduced_radius=1.0, contact_angle=angle))
    for size in (0.01, 0.03, 0.05, 0.1, 0.2, 0.3, 0.4, WIDEST):
        force, _ = nodoid((size / kappa) ** 2, angle, is_pair=is_pair)
        first = 1 - size
        assert 0.999 * first <= force <= first * (1 + 2 * size**2) * (1 + 1e-3)


def test_the_exact_meniscus_has_the_forces_of_other_integrals() -> None:
    """The forces, at half-filling angles of 0.02 to 0.4, were computed by other integrals of the same shape."""
    from scipy.optimize import brentq

    for degrees, is_pair, forces in (
        (0, False, (0.9961, 0.9901, 0.9800, 0.9593, 0.9162)),
        (40, False, (0.9942, 0.9853, 0.9704, 0.9396, 0.8748)),
        (0, True, (0.9922, 0.9806, 0.9617, 0.9251, 0.8566)),
        (40, True, (0.9884, 0.9710, 0.9420, 0.8844, 0.7699)),
    ):
        for filling, force in zip((0.02, 0.05, 0.1, 0.2, 0.4), forces, strict=True):
            ratio = brentq(
                lambda each, d=degrees, p=is_pair, f=filling: nodoid(each, math.radians(d), is_pair=p)[1] - f,
                filling**2 / 20, filling**2 * 8,
            )  # fmt: skip
            exact, _ = nodoid(ratio, math.radians(degrees), is_pair=is_pair)
            assert exact == approx(force, abs=6e-5)
            first, size = by_first_order(ratio, math.radians(degrees))
            assert 0.999 * first <= force <= 1.001 * first * (1 + 2 * size**2)


@pytest.mark.parametrize(("degrees", "kappa"), [(0, math.pi / 8), (20, 0.4235), (40, 0.509), (60, 0.676)])
def test_the_first_order_depends_on_the_contact_angle(degrees: float, kappa: float) -> None:
    size = meniscus_size(kelvin_radius=1.0, reduced_radius=1.0, contact_angle=math.radians(degrees))
    assert size == approx(kappa, rel=1e-3)


def test_the_constants_are_those_of_water_at_25_degrees() -> None:
    part = 1 - ROOM / 647.096
    tension = 0.2358 * part**1.256 * (1 - 0.625 * part)  # IAPWS R1-76
    assert tension == approx(WATER_TENSION, rel=1e-3)
    volume = 18.015e-3 / 997.05  # molar
    assert kelvin_radius(humidity=1 / math.e) == approx(tension * volume / (GAS_CONSTANT * ROOM), rel=1e-3)


def test_water_fills_a_gap_of_twice_the_kelvin_radius() -> None:
    for degrees in (0.0, 40.0):
        gap = 2 * kelvin_radius(humidity=0.7) * math.cos(math.radians(degrees))
        filled = solve("threshold_humidity", roughness_gap=gap, contact_angle=math.radians(degrees))
        assert filled == approx(0.7, rel=1e-12)
    gaps = np.array([0.5e-9, 1e-9, 2e-9, 5e-9, 10e-9])
    assert solve("threshold_humidity", roughness_gap=gaps) == approx([0.12, 0.35, 0.59, 0.81, 0.90], abs=0.005)


WET = {"material": "quartz", "radius": 1e-6, "radius2": math.inf}


def test_a_small_meniscus_has_the_same_force_at_every_humidity() -> None:
    forces = solve("meniscus_force", **{**WET, "radius": 1.0}, humidity=np.array([0.1, 0.5, 0.9]))
    assert forces == approx(4 * math.pi * WATER_TENSION, rel=1e-4)
    assert solve("meniscus_force", radius=1e-6, humidity=0.5) == approx(  # the same reduced radius
        solve("meniscus_force", radius=5e-7, radius2=math.inf, humidity=0.5), rel=1e-12
    )


@pytest.mark.parametrize(
    ("words", "lead"),
    [
        (
            "quartz 5um --humidity 67%",
            (
                "real surfaces hold 150–290 nN (smooth glass, dry air), 290–470 nN (smooth glass, humid air), "
                "5.9–59 nN (rough grains, air); ideally smooth spheres hold 620–700 nN dry; F_men, 2.2 µN, is the "
                "upper limit with a meniscus; do not add it to P_c"
            ),
        ),
        (
            "quartz 100nm --humidity 67%",
            (
                "real spheres hold 0.12–9.4 nN if like SiO2 of 5 µm and more (not measured at this size); "
                "ideally smooth spheres hold 14–15 nN dry; F_men, 43 nN, is the upper limit with a meniscus"
            ),
        ),
        (
            "pdms 1um --humidity 60%",
            "ideally smooth spheres hold 94.72–94.73 nN dry; F_men, 440 nN, is the upper limit with a meniscus",
        ),
        (
            "quartz 1um,5um --humidity 67%",
            (
                "P_c below is the upper limit, for ideally smooth, dry spheres; F_men is the upper limit with a "
                "meniscus; do not add it to P_c"
            ),
        ),
        ("pdms 1um,5um --humidity 67%", "F_men is the upper limit with a meniscus; do not add it to P_c"),
        (
            "quartz 1um --humidity 30% --roughness 2nm",
            "the dry contact alone pulls: water fills the gap of 2 nm only above 59 % humidity; real surfaces hold",
        ),
        (
            "quartz 1um --humidity 90% --roughness 2nm",
            "water fills the gap of 2 nm only above 59 % humidity; real surfaces hold 29–59 nN",
        ),
    ],
)
def test_an_answer_in_humid_air_has_measured_forces_and_upper_limits(run: Run, words: str, lead: str) -> None:
    shown = " ".join(run(f"pull-off {words}", terminal=True).out.split())
    assert lead in shown
    assert "larger" not in shown
    assert "assumed: θ_c = 0, water that wets (--contact-angle)" in shown


def test_no_meniscus_force_if_the_gap_stays_dry_or_the_meniscus_is_too_wide(run: Run) -> None:
    dry = run("pull-off quartz 1um --humidity 30% --roughness 2nm --csv").out.splitlines()
    assert "no meniscus" in dry[1]
    assert "warning: F_men: no meniscus" in run("pull-off quartz 1um --humidity 30% --roughness 2nm").err
    assert "too wide" in run("pull-off quartz 10nm --humidity 99%", terminal=True).err
    assert "wide-meniscus" in run("pull-off quartz 10nm,1um --humidity 60% --csv").out
    assert "few-molecules" in run("pull-off quartz 1um,2um --humidity 50% --csv").out


@pytest.mark.parametrize(
    ("option", "words"),
    [
        ("--humidity 0", "neither dry nor saturated"),
        ("--humidity 100%", "neither dry nor saturated"),
        ("--humidity 60% --contact-angle 120deg", "90 deg or more draws nothing together"),
        ("--humidity 60% --contact-angle 90deg --roughness 2nm", "fills no gap"),
    ],
)
def test_without_a_meniscus_only_the_dry_force_is_shown(run: Run, option: str, words: str) -> None:
    done = run(f"pull-off quartz 1um {option}", terminal=True)
    assert (done.code, "F_men  " in done.out, "decides" in done.out) == (0, False, False)
    assert words in done.err
    assert "P_c" in done.out


def test_a_humidity_without_percent_is_refused(run: Run) -> None:
    done = run("pull-off quartz 1um --humidity 60")
    assert (done.code, "'60' must lie between 0 and 1 (100 %); expected a number such as 60%" in done.err) == (
        2,
        True,
    )


def test_a_meniscus_needs_no_surface_energy_of_the_solids(run: Run) -> None:
    done = run("pull-off 1um --humidity 60%", terminal=True)
    assert done.code == 0
    assert "≈ 440  Kelvin" in done.out
    assert "decides" not in done.out
    assert "pull-off force: needs surface energy" in done.err
