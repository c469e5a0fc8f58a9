"""Head-on collisions: restitution, and sticking with viscous damping, compared with the motion on the JKR curve."""

import math
from typing import Any

import numpy as np
import pytest

from harness import Run
from jkroll import infer, solve
from jkroll.model.reasons import Failure, MissingInput
from jkroll.physics.any_law import pull_off_force_rough
from jkroll.physics.motion import FITTED_UP_TO, STICKS_FROM, sticking_speed_viscous
from relative import approx

QUARTZ: dict[str, Any] = {"material": "quartz", "radius": 1e-6}
# The motion in units of δ0 and √(P_cδ0/m). With δ̂ = 3y⁴ − 2y, y = √(a/a0) = z/6^(1/3) and dt = 2·6^(-1/3)(z³ − 1)dσ,
# its equation is polynomial. C is 6^(-1/3).
C = 6 ** (-1 / 3)


def acceleration(z: float, u: float, viscosity: float) -> float:
    """Return du/dσ at a state z and a speed u."""
    return 2 * C * (z**3 - 1) * (-(z**3) * (z**3 - 6) / 9 - 2 * viscosity * C**2 * z**2 * u)


def slowest_that_parts(viscosity: float) -> float:
    """Return the impact speed of grains that come to rest at the fold, from the motion backwards in time."""
    from scipy.integrate import solve_ivp  # type: ignore[import-untyped]

    growth, start = math.sqrt(10 * C / 3), 1e-5

    def backwards(_: float, state: Any) -> list[float]:
        z, u = state
        return [-u, -acceleration(z, u, viscosity)]

    def meets(_: float, state: Any) -> float:
        z, u = state
        beyond = z - 4 ** (1 / 3)
        return float(beyond if u > 0 else math.copysign(1.0, beyond))

    meets.terminal, meets.direction = True, -1  # type: ignore[attr-defined]
    initial = [1 + start, -growth * start]
    found = solve_ivp(backwards, (0, 1e3), initial, "DOP853", events=meets, rtol=1e-13, atol=1e-18)
    return float(found.y_events[0][0][1])


@pytest.mark.parametrize("viscosity", [1e-6, 1e-3, 0.03, 0.1, 0.27, 0.45, 0.6, 0.66, 0.68, FITTED_UP_TO])
def test_sticking_speed_with_damping_agrees_with_the_equation_of_motion(viscosity: float) -> None:
    unit = {"sticking_energy": 1.0, "reduced_mass": 2.0}
    ratio = slowest_that_parts(viscosity) / slowest_that_parts(0.0)
    assert sticking_speed_viscous(viscosity_number=viscosity, **unit) == approx(ratio, rel=1e-9)


def test_sticking_speed_tends_to_that_without_damping() -> None:
    slow, damped = solve("sticking_speed", **QUARTZ), solve("sticking_speed", **QUARTZ, viscous_time=1e-25)
    assert damped == approx(slow, rel=1e-10)
    assert slow == approx(slowest_that_parts(0.0) * math.sqrt(_scale()), rel=1e-9)


def _scale() -> float:
    """Return P_cδ0/m."""
    energy, mass = solve(["adhesion_energy", "reduced_mass"], **QUARTZ).values()
    return float(energy / mass)


@pytest.mark.parametrize("viscosity", [0.0, 0.03, 0.3])
@pytest.mark.parametrize("times", [1.5, 4.0])
def test_restitution_bounds_that_of_the_equation_of_motion(viscosity: float, times: float) -> None:
    least = slowest_that_parts(viscosity)

    def forwards(_: float, state: Any) -> list[float]:
        z, u = state
        return [u, acceleration(z, u, viscosity)]

    def parts(_: float, state: Any) -> float:
        return float(state[0] - 1)

    parts.terminal, parts.direction = True, -1  # type: ignore[attr-defined]
    from scipy.integrate import solve_ivp

    motion = solve_ivp(
        forwards, (0, 1e3), [4 ** (1 / 3), times * least], "DOP853", events=parts, rtol=1e-12, atol=1e-14
    )
    leaves = -float(motion.y_events[0][0][1]) / (times * least)
    speed = times * solve("sticking_speed", **QUARTZ, **_with(viscosity))
    bound = solve("restitution", **QUARTZ, **_with(viscosity), speed=speed)
    if viscosity:
        assert leaves < bound < 1
    else:
        assert bound == approx(leaves, rel=1e-8)


def _with(viscosity: float) -> dict[str, Any]:
    """Return the argument `viscous_time` for a viscosity number; no argument for 0."""
    return {"viscous_time": viscosity / solve("viscosity_number", **QUARTZ, viscous_time=1.0)} if viscosity else {}


def test_spheres_that_stick_lose_all_their_energy() -> None:
    speed = solve("sticking_speed", **QUARTZ)
    speeds = np.array([speed / 2, speed * (1 - 1e-12), 2 * speed])
    bounces, lost = solve(["restitution", "lost_energy"], **QUARTZ, speed=speeds).values()
    assert bounces.tolist()[:2] == [0, 0]
    assert bounces[2] == approx(math.sqrt(3) / 2, rel=1e-12)
    mass, energy = solve(["reduced_mass", "sticking_energy"], **QUARTZ).values()
    assert lost[0] == approx(mass * speeds[0] ** 2 / 2, rel=1e-12)
    assert lost[2] == approx(energy, rel=1e-12)


def test_damping_of_grains_that_always_stick_is_refused() -> None:
    viscous_time = 1.25e-11
    with pytest.raises(Failure, match=r"viscosity_number: T\* = 1.952\d* is above 0.6815: the spheres stick"):
        solve("sticking_speed", material="quartz", radius=1e-7, viscous_time=viscous_time)
    several = solve("sticking_speed", material="quartz", radius=np.array([1e-7, 1e-6]), viscous_time=viscous_time)
    assert np.isnan(several).tolist() == [True, False]
    with pytest.raises(Failure, match="nonzero Poisson's ratios"):
        solve("sticking_speed", **QUARTZ, poisson_ratio=0.0, viscous_time=viscous_time)
    with pytest.raises(MissingInput, match="Maugis–Dugdale"):
        solve("sticking_speed", **QUARTZ, viscous_time=viscous_time, model="maugis")
    assert FITTED_UP_TO < STICKS_FROM


@pytest.mark.parametrize(
    ("radius", "speed", "viscous_time"), [(0.6e-6, 1.2, 2.276811e-11), (0.25e-6, 1.9, 7.048843e-12)]
)
def test_viscous_time_of_a_measured_sticking_speed(radius: float, speed: float, viscous_time: float) -> None:
    """With these times, Runge–Kutta steps from rest at the fold back to the impact give speeds measured for silica."""
    pair: dict[str, Any] = {"material": "quartz", "radius": radius, "radius2": math.inf}
    found = infer("viscous_time", measured={"sticking_speed": speed}, **pair)
    assert found == approx(viscous_time, rel=1e-6)
    assert solve("sticking_speed", **pair, viscous_time=found) == approx(speed, rel=1e-12)


def test_viscous_time_agrees_with_that_of_a_public_code() -> None:
    """Its comments have 31.6 ps for 105.869 cm/s at 0.76 µm: this speed is extrapolated from 0.6 µm by a power law."""
    speed = 1.2 * (0.6 / 0.76) ** 0.53
    assert speed == approx(1.05869, abs=5e-6)
    pair: dict[str, Any] = {
        "material": "quartz",
        "radius": 0.76e-6,
        "radius2": math.inf,
        "density": 2650.0,
    }
    assert infer("viscous_time", measured={"sticking_speed": speed}, **pair) == approx(3.16e-11, rel=0.01)


def test_a_measured_restitution_bounds_the_surface_energy(run: Run) -> None:
    ran = run("infer gamma quartz 1um --speed 1m/s --measured restitution=0.9")
    assert "an upper limit: adhesion is assumed to cause all losses" in " ".join(ran.err.split())
    assert "upper limit" not in run("infer gamma quartz 1um --measured pull_off_force=100nN").err


def test_an_explanation_says_that_the_viscous_time_was_fitted_at_one_size(run: Run) -> None:
    ran = run("impact quartz 1um --speed 1m/s --viscous-time 12.5ps --explain").out
    assert "the viscous time was fitted at one size" in " ".join(ran.split())
    assert "elastic theory's" not in ran


# --- Pressure and yield -----------------------------------------------------------------------------------------------


def test_peak_pressure_is_that_of_hertz_without_adhesion() -> None:
    """p0 = (2E*/π)(15mv²/(16E*R³))^(1/5) if v is well above the sticking speed."""
    speed, mass, modulus = 100.0, *solve(["reduced_mass", "contact_modulus"], **QUARTZ).values()
    hertz = 2 * modulus / math.pi * (15 * mass * speed**2 / (16 * modulus * 0.5e-6**3)) ** 0.2
    assert solve("impact_pressure", **QUARTZ, speed=speed) == approx(hertz, rel=1e-3)
    assert solve("impact_pressure", **QUARTZ, speed=speed) > hertz


def test_peak_pressure_of_a_touch_is_above_that_at_rest() -> None:
    force, radius = solve(["pull_off_force", "contact_radius"], **QUARTZ).values()
    unit = force / (math.pi * radius**2)
    assert solve("touch_pressure", **QUARTZ) == approx(5.082304 * unit, rel=1e-6)
    assert solve("impact_pressure", **QUARTZ, speed=1e-9) == approx(5.082304 * unit, rel=1e-6)


@pytest.mark.parametrize(
    ("ratio", "over_hertz"), [(6.0, 0.600), (8.0, 0.846), (10.0, 0.923), (20.0, 0.991), (50.0, 0.9994)]
)
def test_yield_speed_relative_to_that_without_adhesion(ratio: float, over_hertz: float) -> None:
    """v_y = (πp_y/2E*)^(5/2) √(16E*R³/(15m)) without adhesion."""
    names = ["pull_off_force", "contact_radius", "contact_modulus", "reduced_mass"]
    force, radius, modulus, mass = solve(names, **QUARTZ).values()
    pressure = ratio * force / (math.pi * radius**2)
    strength = pressure / solve("first_yield_pressure", **QUARTZ, yield_strength=1.0)
    hertz = (math.pi * pressure / (2 * modulus)) ** 2.5 * math.sqrt(16 * modulus * 0.5e-6**3 / (15 * mass))
    speed = solve("yield_speed", **QUARTZ, yield_strength=strength)
    assert speed / hertz == approx(over_hertz, abs=6e-4)
    assert solve("impact_pressure", **QUARTZ, speed=speed) == approx(pressure, rel=1e-12)


@pytest.mark.parametrize(("poisson_ratio", "times"), [(0.17, 1.466), (0.3, 1.613), (0.5, 1.877)])
def test_pressure_of_first_yield(poisson_ratio: float, times: float) -> None:
    assert solve("first_yield_pressure", yield_strength=1e9, poisson_ratio=poisson_ratio) == approx(
        times * 1e9, rel=4e-4
    )


def test_contact_that_yields_on_touching_has_no_yield_speed() -> None:
    """Below 5.08 P_c/(πa0²), the root of the formula is a state under tension, not an impact."""
    with pytest.raises(Failure, match=r"first_yield_pressure: 788.7 MPa is below 15.055 GPa, the pressure of adhesion"):
        solve("yield_speed", material="iron", radius=1e-7, yield_strength=5e8)
    speeds = solve("yield_speed", material="quartz", radius=1e-6, yield_strength=np.array([1e8, 3e9]))
    assert np.isnan(speeds).tolist() == [True, False]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("--speed 1m/s", "the impact is elastic if the solids bear 1.2 GPa, its peak pressure (at rest: 530–570 MPa)"),
        (
            "--speed 1m/s --yield-strength 3GPa",
            "stays elastic: the peak pressure is 1.2 GPa; yielding starts below the surface at 4.399 GPa",
        ),
        (
            "--speed 30m/s --yield-strength 3GPa",
            "the spheres yield below the surface, so e is an upper bound: the peak pressure",
        ),
        (
            "--speed 300m/s --yield-strength 3GPa",
            "the spheres yield fully, so e is an upper bound: the peak pressure is 12 GPa",
        ),
        (
            "--speed 1m/s --yield-strength 0.3GPa",
            "the spheres yield fully, even if they touch at zero speed, so e is an",
        ),
        ("--speed 600m/s", "too fast for a static contact"),
        ("--speed 5km/s", "faster than sound in the solid"),
        ("--speed 100m/s --poisson 0.5 --young 1GPa", "the impact strains the solid too far for linear elasticity"),
        ("--speed 100m/s", "the impact pressure exceeds even the strength of a flawless solid"),
    ],
)
def test_an_explanation_says_whether_an_impact_is_elastic_and_static(words: str, said: str, run: Run) -> None:
    ran = run(f"impact quartz 1um {words} --explain")
    assert said in " ".join(ran.out.split())


@pytest.mark.parametrize(("radius", "most"), [(1e-6, 0.0325), (1e-7, 0.08)])
@pytest.mark.parametrize("asperity", [0.2e-9, 1.5e-9, 3.5e-9, 5e-9])
def test_rough_pull_off_is_slightly_above_the_pairwise_sum(asperity: float, radius: float, most: float) -> None:
    """Van der Waals' force of a sphere on a plane, with a hemispherical asperity between them, summed over volumes."""
    gap = 1.65e-10

    def on_point(across: float, height: float) -> float:
        """Return the axial force between the sphere and a ring of the hemisphere, per Hamaker constant."""
        up = asperity + gap + radius - height
        distance = math.hypot(across, up)
        field = 8 * radius**3 * distance / (distance**2 - radius**2) ** 4  # slope of 4/3 R³/(d² − R²)³, its potential
        return field * up / distance * 2 * math.pi * across

    from scipy.integrate import dblquad

    hemisphere, _ = dblquad(on_point, 0, asperity, 0, lambda height: math.sqrt(asperity**2 - height**2), epsrel=1e-6)
    half_space = radius**3 * 2 / 3 / ((asperity + gap) ** 2 * (asperity + gap + 2 * radius) ** 2)
    smooth = radius / (6 * gap**2)
    exact = hemisphere / math.pi + half_space
    form = pull_off_force_rough(pull_off_force_dmt=smooth, reduced_radius=radius, asperity_radius=asperity, cutoff=gap)
    assert exact < form < (1 + most) * exact


def test_a_warning_names_two_means_between_which_w_of_unlike_solids_lies(run: Run) -> None:
    said = run("pull-off 1um --gamma 20mJ/m2 --gamma2 400mJ/m2").err
    assert "w = 2√(γ1γ2) is an upper estimate for solids so unlike, 4/(1/γ1 + 1/γ2) a lower one" in said
    assert "lower one" not in run("pull-off 1um --gamma 20mJ/m2 --gamma2 50mJ/m2").err
