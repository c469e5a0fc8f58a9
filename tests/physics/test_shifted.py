"""The shifted contact: the strip without load meets Griffith's criterion, and Figs 2 and 9 follow the formulas."""

import math
import re

import numpy as np

from jkroll import known_materials, solve
from jkroll.physics import shifted
from jkroll.physics.cylinder import asymmetric_pressure
from jkroll.pictures.figures import figure_2, figure_9
from jkroll.quantities.markup import plain
from relative import approx


def test_the_strip_without_load_meets_griffiths_criterion() -> None:
    """K²/(2E′) = w, with K = √(2πd) times the tension at a small distance d from the rim."""
    given = {"cylinder_radius": 2e-8, "plane_strain_modulus": 5.5e10}
    a = shifted.unloaded_half_width(work_of_adhesion=0.05, **given)
    distance = 1e-8 * a
    symmetric = {"contact_half_width": a, "yield_displacement": 0.0, "load_constant": 0.0}
    tension = -asymmetric_pressure(position_in_strip=a - distance, **symmetric, **given)
    assert 2 * math.pi * distance * tension**2 / (2 * given["plane_strain_modulus"]) == approx(0.05, rel=1e-6)


def test_fig_2_is_two_half_circles_on_a_shifted_one() -> None:
    view, along = figure_2(known_materials()).panels
    circle, behind, ahead = view.curves
    a = solve("contact_radius", material="quartz", radius=2e-8)
    np.testing.assert_allclose(np.hypot(circle.x + 2e-10, circle.y), a, rtol=1e-12)
    np.testing.assert_allclose(np.hypot(behind.x, behind.y), a + 2e-10, rtol=1e-12)
    np.testing.assert_allclose(np.hypot(ahead.x, ahead.y), a - 2e-10, rtol=1e-12)
    assert behind.x.max() < 1e-20 < ahead.x.max()
    exact, half_behind, half_ahead, centred = along.curves
    assert half_behind.y[np.argmax(half_behind.x)] > half_ahead.y[np.argmin(half_ahead.x)]  # a jump between the halves
    assert exact.x.min() == approx(-a - 2e-10, rel=1e-4)
    assert np.nanmax(centred.y) == approx(
        sum(solve(["hertz_pressure", "boussinesq_pressure"], material="quartz", radius=2e-8).values()), rel=1e-4
    )


def test_fig_9_says_how_far_the_half_strips_are_off() -> None:
    drawn = figure_9(known_materials())
    remarks = plain(" ".join(drawn.remarks))
    ratio = re.search(r"lower by a factor of (\d\.\d+)", remarks)
    assert ratio
    a = float(next(re.finditer(r"a = ([\d.]+) nm", remarks))[1]) * 1e-9
    assert float(ratio[1]) == approx(math.pi / 2 / (1 + (2e-10 / a) ** 2 / 3), abs=1e-3)
