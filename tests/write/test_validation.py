"""The table of `jkroll guide validation` agrees with the measurements."""

import math
from pathlib import Path

from jkroll import solve
from relative import approx
from tools.measurements import PAGE, comparisons, measurements_table

COMPARED = comparisons()


def test_the_page_has_the_table_of_the_measurements() -> None:
    """`python tests/tools/measurements.py` renews the table in the page."""
    assert measurements_table() in PAGE.read_text(encoding="utf-8")


def test_measurements_that_disagree_most_come_first() -> None:
    sizes = [abs(math.log(one.measured / one.computed)) for one in COMPARED]
    assert sizes == sorted(sizes, reverse=True)


def test_computed_numbers_are_those_of_the_formulas() -> None:
    """By hand: P_c = 3πγR1 on a plane, F_roll = 6πγξ, w = 2√(γ1γ2), powers of the radius; for water ice, `solve`."""
    found = {(one.row.solids, one.row.given.get("radius"), one.row.quantity): one for one in COMPARED}
    smooth = found["SiO2 on smooth glass, dry", "2.5 um", "pull_off_force"]
    assert smooth.computed == approx(3 * math.pi * 0.025 * 2.5e-6)
    assert smooth.measured == 314e-9
    assert found["SiO2", "0.95 um", "yield_force"].computed == approx(6 * math.pi * 0.025 * 2e-10)
    assert found["silver on aluminium", "10 nm", "sticking_speed"].computed == approx(50 ** (5 / 6))
    assert found["polystyrene on polyurethane", "6 um", "contact_radius"].computed == approx(2 ** (2 / 3))
    silica = found["vitreous silica, closing cracks", None, "work_of_adhesion"]
    assert {silica.computed, silica.measured} == {0.4, 0.15}
    tips = [one.computed for one in COMPARED if one.row.solids == "fused quartz on steel"]
    assert tips == approx([2 * math.sqrt(0.025 * 3), 2 * math.sqrt(0.025 * 0.0305)])
    mica = found["mica on mica, dry", "1 cm", "pull_off_force"]
    assert mica.computed == approx(3 * math.pi * 0.15 * 0.01)
    speed = solve("sticking_speed", material="ice-warm", radius=1e-6, radius2=math.inf)
    assert found["water ice, below 210 K", "1 um", "sticking_speed"].computed == approx(speed)


def test_silica_has_sticking_speeds_at_the_two_measured_sizes() -> None:
    """The JKR speed is √(2U/m) with U = 0.7722405 P_cδ0."""
    speeds = {one.row.given["radius"]: one for one in COMPARED if one.row.solids == "silica"}
    assert {radius: one.measured for radius, one in speeds.items()} == {"0.6 um": 1.2, "0.25 um": 1.9}
    assert speeds["0.6 um"].computed == approx(0.150207, rel=1e-5)
    assert speeds["0.25 um"].computed == approx(0.311554, rel=1e-5)
    assert speeds["0.6 um"].ratio == approx(7.98898, rel=1e-5)


def test_the_readme_names_the_page_before_the_section_install() -> None:
    text = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
    assert "`jkroll guide validation`" in text.partition("## Install")[0]
