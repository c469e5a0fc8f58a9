"""The shifted contact as it is drawn: each formula against what it must add up to."""

import math
import re

import numpy as np

from jkroll import known_materials, solve
from jkroll.physics import shifted
from jkroll.physics.cylinder import symmetric_pressure
from jkroll.pictures.figures import figure_2, figure_9
from jkroll.quantities.markup import plain
from relative import approx


def test_the_exact_pressure_bears_the_load_and_the_moment_of_eq_25() -> None:
    """Summed over the circle, by Gauss and Chebyshev: nothing at its rim is lost."""
    names = ["contact_radius_at_load", "contact_modulus", "reduced_radius", "hertz_pressure", "boussinesq_pressure"]
    state = solve([*names, "yield_moment"], material="quartz", radius=1e-7, load=3e-9)
    shift, a = 2e-10, state["contact_radius_at_load"]
    angles = (np.arange(400) + 0.5) * math.pi / 400
    directions = (np.arange(64) + 0.5) * 2 * math.pi / 64
    radii = a * np.sin(angles / 2)[:, None]  # r dr = (a²/2) sin cos dangle, which meets the rim softly
    across = radii * np.cos(directions)[None, :]
    parts = {
        name: state[name] for name in ("contact_modulus", "reduced_radius", "hertz_pressure", "boussinesq_pressure")
    }
    along = np.linspace(-a, a, 9)[1:-1]
    even = np.asarray(
        shifted.exact_pressure(position_in_circle=along, contact_radius_at_load=a, yield_displacement=shift, **parts)
    )
    depth = np.sqrt(1 - (along / a) ** 2)
    odd = (even - even[::-1]) / 2  # the tilt alone
    tilt = 2 * state["contact_modulus"] * shift / (math.pi * state["reduced_radius"])
    np.testing.assert_allclose(odd, tilt * along / a / depth, rtol=1e-9)
    root = np.sqrt(1 - (radii / a) ** 2)
    pressures = state["hertz_pressure"] * root + (state["boussinesq_pressure"] + tilt * across / a) / root
    weights = (math.pi / 400) * (2 * math.pi / 64) * a * a * np.sin(angles / 2) * np.cos(angles / 2) / 2
    load = float((pressures * weights[:, None]).sum())
    about_contact_point = float(((across - shift) * pressures * weights[:, None]).sum())
    assert load == approx(3e-9, rel=1e-4)
    assert about_contact_point == approx(state["yield_moment"], rel=1e-4)


def test_the_strip_without_load_meets_griffiths_criterion() -> None:
    """K²/(2E′) = w, with K = √(2πd) times the tension at a small distance d from the rim."""
    given = {"cylinder_radius": 2e-8, "plane_strain_modulus": 5.5e10}
    a = shifted.unloaded_half_width(work_of_adhesion=0.05, **given)
    distance = 1e-8 * a
    tension = -symmetric_pressure(position=a - distance, contact_half_width=a, load_constant=0.0, **given)
    assert 2 * math.pi * distance * tension**2 / (2 * given["plane_strain_modulus"]) == approx(0.05, rel=1e-6)


def test_fig_2_is_two_half_circles_on_a_shifted_one() -> None:
    view, along = figure_2(known_materials(), ()).panels
    circle, behind, ahead = view.curves
    a = solve("contact_radius", material="quartz", radius=2e-8)
    np.testing.assert_allclose(np.hypot(circle.x + 2e-10, circle.y), a, rtol=1e-12)
    np.testing.assert_allclose(np.hypot(behind.x, behind.y), a + 2e-10, rtol=1e-12)
    np.testing.assert_allclose(np.hypot(ahead.x, ahead.y), a - 2e-10, rtol=1e-12)
    assert behind.x.max() < 1e-20 < ahead.x.max()
    exact, half_behind, half_ahead, centred = along.curves
    assert half_behind.y[np.argmax(half_behind.x)] > half_ahead.y[np.argmin(half_ahead.x)]  # not continuous
    assert exact.x.min() == approx(-a - 2e-10, rel=1e-4)
    assert np.nanmax(centred.y) == approx(
        sum(solve(["hertz_pressure", "boussinesq_pressure"], material="quartz", radius=2e-8).values()), rel=1e-4
    )


def test_fig_9_says_how_far_the_half_strips_are_off() -> None:
    drawn = figure_9(known_materials(), ())
    remarks = plain(" ".join(drawn.remarks))
    ratio = re.search(r"lower by (\d\.\d+)", remarks)
    assert ratio
    a = float(next(re.finditer(r"a = ([\d.]+) nm", remarks))[1]) * 1e-9
    assert float(ratio[1]) == approx(math.pi / 2 / (1 + (2e-10 / a) ** 2 / 3), abs=1e-3)
