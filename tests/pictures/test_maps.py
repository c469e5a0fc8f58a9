"""Maps and curves as data and in a terminal: they follow the formulas, and agree with the text of the paper."""

import csv
import io
import math
import re
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from harness import Run
from jkroll import known_materials, solve
from jkroll.model.frame import Frame
from jkroll.model.limits import LIMITS
from jkroll.model.plan import depends_on
from jkroll.pictures.figures import paper_map
from jkroll.pictures.picture import Axis, Field, Panel, Picture, axis_around, evaluate, is_flat, over
from jkroll.pictures.picture_as_text import shown_values
from jkroll.quantities.nomenclature import NOMENCLATURE
from jkroll.quantities.values import parse_quantity
from relative import approx


@cache
def paper(name: str) -> Picture:
    """Return a map of the paper."""
    return paper_map(name, known_materials(), as_printed=True)


def panel_of(name: str) -> Panel:
    """Return the panel of a map of the paper."""
    (panel,) = paper(name).panels
    return panel


def field_of(name: str) -> Field:
    """Return the field of a map of the paper."""
    field = panel_of(name).field
    assert field is not None
    return field


@pytest.mark.parametrize(
    ("name", "formula"),
    [
        ("3a", lambda gamma, radius: 3 * math.pi * gamma * radius / 2),
        ("3b", lambda _, radius: 4 * 2e-10 / radius),
        ("3c", lambda _, radius: radius**2 / 2e-10),
        ("3d", lambda gamma, radius: np.sqrt(9 * gamma * 2e-10 / (2 * radius**3 * 2000 * 9.80665))),
        ("6a", lambda gamma, radius: 6.381e8 * (gamma / 0.1) ** (1 / 6) * (1e-7 / radius) ** (7 / 6)),
        ("6b", lambda gamma, radius: 2.5 * 3 / (2 * math.pi) * np.sqrt(gamma / (5 * radius**3 * 2000))),
        ("8", lambda ratio, radius: 3 / (14 * np.cbrt(9 * math.pi)) * ratio ** (-2 / 3) * np.cbrt(radius / 2) / 2e-10),
    ],
)
def test_the_values_of_a_figure_follow_its_equation(name: str, formula: Callable[[Any, Any], Any]) -> None:
    panel, values = panel_of(name), field_of(name).values
    wanted = formula(panel.x.values()[None, :], panel.y.values()[:, None])
    np.testing.assert_allclose(values, np.broadcast_to(wanted, values.shape), rtol=1e-4)


def test_the_printed_rolling_frequency_is_too_low_by_a_factor_of_2_5() -> None:
    panel, field = panel_of("6b"), field_of("6b")
    np.testing.assert_allclose(field.values / evaluate(field.frame, field.printed, panel.x, panel.y), 2.5, rtol=1e-12)


# --- The text of the paper about its figures --------------------------------------------------------------------------


def test_fig_3b_includes_0_8_nm_where_the_yield_force_equals_the_pull_off_force() -> None:
    crossing = solve("yield_force_ratio", radius=0.8e-9)
    assert crossing == approx(1, rel=1e-12)
    assert panel_of("3b").y.low < 0.8e-9
    assert "0.8 nm; the paper has 1 nm" in paper("3b").remarks[-1]


def test_fig_8_shades_the_ratios_that_do_not_roll_at_10_nm_and_none_at_its_largest_radius() -> None:
    def turns(ratio: float, radius: float) -> float:
        return float(solve("n_roll", contact_modulus=ratio, surface_energy=1.0, radius=radius))

    # Eq (48) gives 2πn⟨M⟩ = (2/7)W0, and W_yield = ⟨M⟩ξ/R: these two energies are equal at 2πRn = ξ.
    assert 2 * math.pi * 5e-9 * turns(9.2e11, 1e-8) == approx(2e-10, rel=0.03)
    assert turns(1.5e9, 1e-7) == approx(1, rel=0.03)
    drawn, field = panel_of("8"), field_of("8")
    (shaded,) = (region for region in field.regions if "slides freely" in region.text)
    excess = shaded.excess(over(field.frame, drawn.x, drawn.y))
    row = int(np.argmin(abs(np.log(drawn.y.values() / 1e-8))))
    inside = drawn.x.values()[excess[row] > 0]
    assert inside.min() == approx(9.2e11, rel=0.2)
    assert inside.max() == drawn.x.high
    assert not (excess[-1] > 0).any()


def apart(quantity: str, given: dict[str, Any]) -> float:
    """Return the factor between a quantity by JKR and by Maugis' law."""
    by_maugis = solve(quantity, **given, model="maugis", atomic_spacing=4e-10)
    return float(np.exp(abs(np.log(by_maugis / solve(quantity, **given)))))


def test_marks_are_the_materials_of_table_1_at_their_values() -> None:
    marks = {mark.text: mark.x for mark in panel_of("3a").marks}
    assert marks == {
        name: material.properties["surface_energy"]
        for name, material in known_materials().materials.items()
        if material.title == "Table 1 of D&T"
    }
    ratios = {mark.text: mark.x for mark in panel_of("8").marks}
    assert "gold" not in ratios  # it has no Young's modulus
    assert ratios["quartz"] == approx(54e9 / (2 * (1 - 0.17**2)) / 0.025)


# --- Axes -------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("axis", "most", "wanted"),
    [
        (Axis("radius", 1e-9, 1e-6), 10, [1e-9, 2e-9, 5e-9, 1e-8, 2e-8, 5e-8, 1e-7, 2e-7, 5e-7, 1e-6]),
        (Axis("radius", 1e-9, 1e-6), 7, [1e-9, 3e-9, 1e-8, 3e-8, 1e-7, 3e-7, 1e-6]),
        (Axis("radius", 5e-10, 1e-6), 4, [1e-9, 1e-8, 1e-7, 1e-6]),
        (Axis("radius", 1.42e-9, 1.44e-9), 3, [1.42e-9, 1.43e-9, 1.44e-9]),
        (Axis("radius", 1e-8, 3e-8), 11, [1e-8, 1.2e-8, 1.5e-8, 2e-8, 2.5e-8, 3e-8]),
        (Axis("radius", 1e-20, 1e20), 3, [1e-20, 1, 1e20]),
        (Axis("load", -5e-8, 5e-8, is_log=False), 5, [-4e-8, -2e-8, 0.0, 2e-8, 4e-8]),
        (Axis("load", -5e-8, 5e-8, is_log=False), 13, [count * 1e-8 for count in range(-5, 6)]),
        (Axis("radius", 1e-9, 4e-9, size=3), 5, [1e-9, 2e-9, 4e-9]),
    ],
)
def test_a_table_has_rounded_values_or_the_requested_number_of_points(
    axis: Axis, most: int, wanted: list[float]
) -> None:
    np.testing.assert_allclose(shown_values(axis, most), wanted, rtol=1e-3, atol=1e-20)


def test_the_axis_of_a_flat_curve_does_not_enlarge_rounding_errors() -> None:
    """Q does not depend on R1: its values differ only by rounding."""
    forces = evaluate(Frame({}, known_materials()["quartz"]), "yield_force", Axis("radius", 1e-8, 1e-6, size=1001))
    assert is_flat(forces)
    axis = axis_around("yield_force", [forces], may_be_log=True)
    assert (axis.low, axis.high) == approx((0, 2 * forces[0]), rel=1e-6)


def test_a_caption_has_the_value_of_each_flat_curve(run: Run) -> None:
    out = " ".join(run("map yield-force quartz --x radius=10nm:1um").out.split())
    assert " Q is the same everywhere: 94.25 pN (quartz)." in out
    several = " ".join(run("map yield-force quartz,iron --x radius=10nm:1um").out.split())
    assert " Q is the same everywhere: 94.25 pN (quartz), 11.31 nN (iron)." in several
    assert "the same" not in run("map pull-off quartz --x radius=10nm:1um").out


# --- In a terminal ----------------------------------------------------------------------------------------------------

PICTURES = [
    *(f"figure {name}" for name in ("3a", "3c", "8")),
    "map pull-off --x radius=1nm:1mm --y gamma=1mJ/m2:10J/m2 --mark quartz@100nm",
    "map approach_at_load quartz --x load=-12nN:20nN:lin --y radius=50nm:200nm:lin",
    "map yield-force-ratio quartz,iron --x radius=1nm:1um --mark iron@10nm",
]


@pytest.mark.parametrize("columns", [40, 80, 132])
@pytest.mark.parametrize("line", PICTURES)
def test_a_picture_fits_the_terminal(run: Run, monkeypatch: pytest.MonkeyPatch, line: str, columns: int) -> None:
    monkeypatch.setenv("COLUMNS", str(columns))
    ran = run(line, terminal=True)
    assert ran.code == 0
    assert "\x1b" not in ran.out
    assert max(map(len, ran.out.splitlines())) <= columns


@pytest.mark.parametrize("line", PICTURES)
def test_pictures_are_ascii_or_coloured_as_the_terminal_allows(
    run: Run, monkeypatch: pytest.MonkeyPatch, line: str
) -> None:
    plain = run(line, terminal=True, encoding="ascii")
    assert plain.out.isascii()
    monkeypatch.setenv("TERM", "xterm-256color")
    coloured = run(line, terminal=True)
    papers = [{*re.findall(r"48;5;(\d+)m", row)} for row in coloured.out.splitlines() if "\x1b[" in row]
    assert bool(papers) is (not line.startswith("map") or "--y" in line)
    if line == "figure 3c":  # R_min depends on the radius alone
        assert {*map(len, papers)} == {1}
        assert papers[0] != papers[-1]
    bare = re.sub("\x1b\\[[0-9;]*m", "", coloured.out)
    assert max(map(len, bare.splitlines())) <= 80
    monkeypatch.setenv("NO_COLOR", "1")
    assert "\x1b" not in run(line, terminal=True).out
    monkeypatch.delenv("NO_COLOR")
    assert "\x1b" not in run(line).out  # in a pipe


def test_a_map_is_a_table_of_its_values(run: Run) -> None:
    out = run("map contact-radius quartz --x radius=10nm:1um --y gamma=10mJ/m2:1J/m2 --quiet --plain").out.splitlines()
    assert out[0] == "Unloaded contact radius, a0, Eq (2), by JKR."
    assert out[1].startswith("Fixed: quartz")
    heads = re.split(r"  +", out[3].strip())
    assert heads == ["γ1", "10 nm", "20 nm", "50 nm", "100 nm", "200 nm", "500 nm", "1 µm"]
    rows = [re.split(r"  +", line.strip()) for line in out[4:11]]
    assert (rows[0][0], rows[-1][0]) == ("1 J/m²", "10 mJ/m²")
    values = dict(zip(heads[1:], rows[[row[0] for row in rows].index("20 mJ/m²")][1:], strict=True))
    wanted = solve("contact_radius", material="quartz", radius=5e-8, surface_energy=0.02)
    assert values["50 nm"] == f"{wanted * 1e9:.3g} nm"


def test_curves_are_rows_of_their_values(run: Run) -> None:
    out = run("map pull-off quartz,iron --x radius=1nm:1um:4 --mark quartz@50nm --quiet").out.splitlines()
    table = out.index(next(line for line in out if line.split() == ["R1", "P_c", "best", "range", "by"]))
    assert out[0] == "Pull-off force, P_c, Eq (1), by JKR."
    assert {*out[table + 1]} == {"─"}
    rows = [re.split(r"  +", line.strip()) for line in out[table + 2 : table + 11]]
    radii = {"1 nm": 1e-9, "10 nm": 1e-8, "100 nm": 1e-7, "1 µm": 1e-6}
    assert [row[:2] for row in rows] == [
        *([name, text] for name in ("quartz", "iron") for text in radii),
        ["quartz, 50 nm", "50 nm"],
    ]
    for name, text, force, _, rule in rows[:8]:
        assert rule in ("Maugis", "JKR")
        assert parse_quantity(force, "load") == approx(
            solve("pull_off_force", material=name, radius=radii[text]), rel=1e-3
        )


def test_the_law_of_a_map_stands_above_its_numbers_once(run: Run) -> None:
    """The title is not repeated, limits are below, and a figure of the paper keeps its title."""
    ran = run("map P_c --x radius=100nm:1mm --y gamma=1mJ/m2:1J/m2")
    above, _, below = ran.out.partition("\nDown: ")
    assert above.startswith(
        "Pull-off force, P_c, Eq (1), by JKR.\nDMT's law, for small, hard spheres, gives 4/3 of this force.\n"
    )
    assert ran.out.lower().count("pull-off force, p_c") == 1
    assert "Real surfaces hold less" in below
    mass = run("map mass --x radius=10cm:1m --y density=1g/cm3:10g/cm3").out
    assert mass.startswith("Mass of sphere 1, m1 [kg], Eq (41).\nDown: ")
    assert run("figure 8").out.startswith("Fig. 8: n_roll\nTurns while it slides, n_roll, ")


KEY = re.compile(r"^([x/|^'—]) (\S.*)$", re.MULTILINE)  # a sign and its meaning, below a map
MAPS_WITH_SIGNS = ["figure 3a", "figure 8", "map moment quartz --x xi=0.01nm:1nm --y radius=1nm:1um"]


def test_a_sign_stands_for_one_limit_on_every_map(run: Run) -> None:
    texts: dict[str, set[str]] = {}
    for line in MAPS_WITH_SIGNS:
        keys = KEY.findall(run(line).out)
        assert len(keys) >= 2
        for sign, text in keys:
            texts.setdefault(sign, set()).add(text)
    assert [len(several) for several in texts.values()] == [1] * len(texts)
    assert len(texts) == len(set.union(*texts.values()))


def test_the_key_names_only_limits_and_gaps_on_the_map(run: Run) -> None:
    """Grains with a below 3 z0 do not withstand a pull of 5 nN, so a map of larger pulls has none."""
    line = "map contact-radius-at-load quartz --x radius=10nm:1um --y load=-50nN:{}:lin --quiet"
    beyond, within = (run(line.format(load)).out for load in ("-5nN", "5nN"))
    assert "no value: beyond pull-off" in [text for _, text in KEY.findall(beyond)]
    assert "\nx a/z0 < 3: contact radius below 3 atoms\n" in within
    assert "a/z0" not in beyond


def test_a_limit_exceeded_everywhere_is_a_sentence_without_a_sign(run: Run) -> None:
    out = run("map contact-radius-at-load quartz --x radius=1nm:10nm --y load=-2nN:0nN:lin --quiet").out
    assert "\nEverywhere a/z0 < 3: contact radius below 3 atoms.\n" in out
    assert "x a/z0" not in out


# --- Numbers and refusals ---------------------------------------------------------------------------------------------


def test_data_have_an_empty_cell_for_each_missing_value(run: Run, tmp_path: Path) -> None:
    line = "map approach_at_load quartz --x radius=1nm:1um:4 --y load=-1nN:1nN:3:lin --data"
    file = tmp_path / "out.csv"
    shown = run(f"{line} {file}")
    assert shown.code == 0
    assert shown.out
    text = file.read_text(encoding="utf-8")
    assert run(f"{line} -").out == text
    assert text.startswith("radius [m],load [N],approach_at_load [m]\n")
    rows = list(csv.DictReader(io.StringIO(text)))
    assert len(rows) == 12
    for row in rows:
        scene: dict[str, Any] = {"radius": float(row["radius [m]"]), "load": float(row["load [N]"])}
        cell = row["approach_at_load [m]"]
        is_beyond = scene["load"] < -solve("pull_off_force", material="quartz", radius=scene["radius"])
        assert (cell == "") == is_beyond
        if cell:
            assert math.isclose(float(cell), solve("approach_at_load", material="quartz", **scene), rel_tol=1e-15)


def test_data_have_the_requested_number_of_points(run: Run) -> None:
    """The axes of contours and limits have other numbers of points."""
    out = run("map r_min --x radius=1nm:1um:300 --y xi=1angstrom:1nm:3 --data -").out
    rows = [tuple(map(float, row.values())) for row in csv.DictReader(io.StringIO(out))]
    assert len({*rows}) == 900
    for radius, displacement, bend in rows[::50]:
        assert math.isclose(bend, radius**2 / displacement, rel_tol=1e-12)


def test_a_curve_with_an_uncertain_input_is_computed_and_named_by_its_middle(run: Run) -> None:
    out = run("map pull-off quartz --x radius=1nm:1um:3 --gamma 25±5mJ/m2,30mJ/m2 --data -").out
    assert '\n"quartz, γ1 = 25 mJ/m²",1e-9,1.178' in out


def test_several_materials_are_several_curves(run: Run) -> None:
    rows = list(csv.reader(io.StringIO(run("map pull-off quartz,iron --x radius=1nm:1um:3 --data -").out)))
    assert [row[0] for row in rows[1:]] == ["quartz"] * 3 + ["iron"] * 3
    assert float(rows[5][2]) == solve("pull_off_force", material="iron", radius=float(rows[5][1]))


def test_a_material_that_lacks_a_property_is_left_out_and_the_others_are_drawn(run: Run) -> None:
    ran = run("map frequencies polystyrene,quartz,graphite,gold,iron --x radius=10nm:1um:3 --data -")
    assert ran.code == 0
    assert {row[0] for row in csv.reader(io.StringIO(ran.out))} == {
        "curve",
        "polystyrene",
        "quartz",
        "graphite",
        "iron",
    }
    needs = "normal vibration needs Young's modulus and Poisson's ratio"
    assert f"no curve: gold: {needs}; gold has none" in ran.err


def test_a_caption_states_the_radii_at_which_a_curve_is_doubtful(run: Run) -> None:
    """At the radius up to which the law is inexact, a0 by JKR and by Maugis' law differ by 5 %."""
    said = run("map contact_radius quartz --x radius=10nm:1mm").out
    radius = re.search(r"JKR is off by more than 5 % \(quartz, R1 = 10 nm to (\d+ [nµ]m)\)", said)
    assert radius is not None, said
    given = {"material": "quartz", "radius": parse_quantity(radius[1], "radius")}
    assert apart("contact_radius", given) == approx(1.05, abs=0.002)


def test_a_caption_has_the_values_of_both_laws_where_they_differ_most(run: Run) -> None:
    """The range by Maugis' law has its ends at half and at the full atomic spacing, as in the note on a single pair."""
    out = " ".join(run("map contact_radius quartz --x radius=10nm:50nm").out.split())
    given: dict[str, Any] = {"material": "quartz", "radius": 1e-8, "model": "maugis"}
    ends = sorted(solve("contact_radius", **given, atomic_spacing=spacing) * 1e12 for spacing in (2e-10, 4e-10))
    own = solve("contact_radius", material="quartz", radius=1e-8) * 1e12
    found = re.search(r"off at R1 = 10 nm: a0 = (\d+)–(\d+) pm by Maugis' law, (\d+) pm by JKR\.", out)
    assert found is not None, out
    assert [*map(float, found.groups())] == approx([*ends, own], rel=0.05)
    assert "farthest" not in run("map contact_radius quartz --x radius=10nm:50nm --model jkr,maugis").out
    assert "farthest" not in run("map r_min quartz --x radius=10nm:50nm").out
    is_far_everywhere = "map contact_radius_at_load quartz 100nm --x approach=-0.05nm:1nm --model maugis"
    assert "farthest" not in run(is_far_everywhere).out


def test_a_doubt_about_a_whole_curve_applies_everywhere(run: Run) -> None:
    out = " ".join(run("map contact_radius quartz,iron --x radius=10nm:1um").out.split())
    assert re.search(r" JKR is off by more than 5 % \(quartz, everywhere; iron, R1 = 10 nm to \S+ (nm|µm)\)\.", out)
    assert "Everywhere JKR is off by more than 5 %." in run("map contact_radius quartz,iron --x radius=10nm:50nm").out


def test_a_doubt_may_apply_to_two_separate_ranges_of_a_curve(run: Run) -> None:
    """The approach at pull-off by JKR crosses that by Maugis' law, so JKR holds near the crossing."""
    out = " ".join(run("map approach_at_pull_off quartz --x radius=1nm:1mm").out.split())
    said = re.search(r"than 5 % \(quartz, R1 = 1 nm to (\d+ [nµ]m), (\d+ [nµ]m) to (\d+ [nµ]m)\)", out)
    assert said is not None, out
    sizes = [parse_quantity(text, "radius") for text in said.groups()]
    assert sizes == sorted(sizes)
    radii = [1e-9, math.sqrt(sizes[0] * sizes[1]), math.sqrt(sizes[1] * sizes[2])]
    factors = [
        abs(math.log(apart("approach_at_pull_off", {"material": "quartz", "radius": radius}))) for radius in radii
    ]
    assert [factor > math.log(1.05) for factor in factors] == [True, False, True]


def test_a_doubt_is_stated_only_for_the_part_of_a_curve_that_is_drawn(run: Run) -> None:
    """Grains with a below 3 z0 do not withstand a pull of 5 nN."""
    assert "a/z0" not in run("map contact-radius-at-load quartz --x radius=10nm:1um --load=-5nN").out
    for count, radii in (("", "10 nm to 16 nm"), (":3", "10 nm")):  # a single value is written without a range
        assert f"3 atoms (quartz, R1 = {radii})" in run(f"map contact-radius quartz --x R1=10nm:1um{count}").out


def test_a_material_that_is_left_out_is_named_in_the_caption(run: Run) -> None:
    """The material has no Young's modulus, or its surface energy is beyond the axis."""
    assert run("figure 8").out.count("\nNot shown: gold.\n") == 1
    out = run("map pull-off --x gamma=1mJ/m2:1J/m2 --y radius=1nm:1um").out
    assert "\nNot shown: iron.\n" in out
    assert "Not shown" not in run("figure 3a").out


def test_a_curve_without_values_is_not_drawn_and_gaps_have_their_reason(run: Run) -> None:
    """By Maugis' law, the atomic spacing decides whether small, hard spheres stick."""
    curves = " ".join(run("map v_stick silica-dry --x radius=10nm:10um --model jkr,maugis").out.split())
    assert "No value where v_stick depends on z0; give --z0 4angstrom." in curves
    small = run("map v_stick quartz --x radius=1nm:2nm --model jkr,maugis").err
    nowhere = "sticking_speed: no value anywhere on these axes"
    assert f"no curve: quartz, Maugis–Dugdale: {nowhere}: depends on z0; give --z0 4angstrom\n" in small
    drawn = (
        "map v_stick --x R1=10nm:10um --y gamma=1mJ/m2:1J/m2 --young 7GPa --poisson 0.25 --density 1g/cm3 --model "
        "maugis"
    )
    assert "No value where v_stick depends on z0" in run(drawn).out
    assert "No value" not in run(f"{drawn} --z0 4angstrom").out


def test_the_caption_has_the_value_of_a_marked_grain_of_another_material_with_its_own_inputs(run: Run) -> None:
    """The fixed inputs of the map are the surface energy and Poisson's ratio of quartz."""
    words = "map contact_radius quartz --x radius=10nm:10um --y young=1GPa:1TPa --mark iron@100nm,quartz@1um"
    own = run("contact iron 100nm --bare --quiet --quantities contact_radius").out
    said = " ".join(run(words).out.split())
    assert (
        f"iron, 100 nm has other inputs than those fixed here; iron, 100 nm: a0 = {float(own) * 1e9:.4g} nm; " in said
    )
    assert "quartz, 1 µm: a0 = " in said
    assert "quartz, 1 µm has" not in said


def test_an_axis_may_be_named_by_the_word_of_an_option(run: Run) -> None:
    """`approach` as an option means δ at the load; as a result, it means δ0."""
    words = "quartz 100nm --data - --x"
    by_name = run(f"map load {words} approach_at_load=-0.05nm:1nm:5").out
    assert run(f"map load {words} approach=-0.05nm:1nm:5").out == by_name


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("map", "map needs a quantity"),
        ("map pull_off_forse --x radius=1nm:1um", "did you mean pull_off_force?"),
        ("map pull-off", "map needs an axis"),
        ("map pull-off --x radius", "write a quantity and its range"),
        ("map pull-off --x radius=1nm", "write a quantity and its range"),
        ("map pull-off --x radius=1um:1nm", "does not rise; write FROM:TO with FROM below TO"),
        ("map pull-off --x gamma=1mJ/m2:1J/m2 --y radius=1nm:1nm", "radius: '1nm:1nm' does not rise; write FROM:TO"),
        ("map pull-off --x radius=1nm:1N", "is a force"),
        ("map pull-off --x material=a:b", "stands for a word, not a number"),
        ("map pull-off quartz 100nm --x radius=1nm:1um", "is on an axis"),
        ("map pull-off --x radius=1nm:1um --y radius=1nm:1um", "both axes"),
        ("map pull-off quartz --x density=1g/cm3:2g/cm3", "does not depend on density"),
        ("map pull-off quartz,iron 100nm,1um --x xi=1angstrom:3angstrom", "does not depend on yield_displacement"),
        ("map pull-off quartz,iron --x radius=1nm:1um --y load=0N:1nN:lin", "does not depend on load"),
        ("map yield-force quartz,iron --x xi=1nm:2nm --y load=0N:1nN:lin", "a map shows one pair"),
        ("map frequencies gold --x radius=1nm:1um", "gold has none"),
        ("map pull-off quartz --x radius=1nm:1um --mark quarz@1nm", "did you mean quartz?"),
        (
            "map pull-off quartz --x radius=1nm:1um --mark quartz@1m",
            "is outside the axes of radius and pull_off_force",
        ),
        ("figure 3a --mark iron@5m", "--mark 'iron@5m' is outside the axes of surface_energy and radius"),
        ("map pull-off --x radius=1nm:1um:2001 --y gamma=1mJ/m2:1J/m2", "too many values; an axis has at most 2000"),
        ("map pull-off 1nm:1um:25 --x gamma=1mJ/m2:1J/m2", "25 pairs are more than the 24 curves"),
        ("map pull-off quartz --x radius=1nm:1um -o picture.gif", "does not end in .svg, .pdf or .png"),
        ("contact quartz 100nm --curve --panel force -o curve.csv", "does not end in .svg, .pdf or .png"),
        ("map pull-off quartz --x radius=1nm:1um --width 1nm", "is not between"),
        ("map load --x load=1nN:2nN", "it cannot be an axis"),
        ("map load quartz 100nm --x load=1nN:2nN --y approach=1nm:2nm", "cannot be an axis"),
        ("map pull-off quartz --x radius=1nm:1um --style gaudy", "is not a style"),
        ("figure 3a --style dark", "add -o FILE"),
        ("contact quartz 100nm --curve --width 85mm", "add -o FILE"),
        ("figure", "choose one of 2, 3a"),
        ("figure 1", "is not a figure"),
    ],
)
def test_invalid_maps_are_refused_in_one_line(run: Run, line: str, message: str) -> None:
    ran = run(line)
    assert ran.code == 2
    assert ran.out == ""
    assert len(ran.err.splitlines()) == 1
    assert message in ran.err


def test_a_note_on_the_quantity_begins_with_its_symbol(run: Run) -> None:
    ran = run("map n_roll_energy_balance quartz --x radius=10nm:1um:3 --data -")
    assert "note: n_bal: 7/2 of Eq (48)" in ran.err


def test_a_map_without_any_value_fails(run: Run) -> None:
    for axes in ("--x load=-1uN:-0.5uN:lin", "--x load=-1uN:-0.5uN:lin --y xi=1angstrom:2angstrom"):
        ran = run(f"map yield-force quartz 10nm {axes}")
        assert (ran.code, ran.out) == (1, "")
        assert ran.err.startswith(
            "jkroll: yield_force: no value anywhere on these axes: load: -500 nN breaks this contact"
        )


# Ranges of an axis, by the unit of its quantity.
_EXAMPLES = {
    "m": "1nm:1um", "J/m^2": "1mJ/m2:1J/m2", "Pa": "1GPa:100GPa", "1": "0.1:0.4", "kg/m^3": "1g/cm3:8g/cm3",
    "N": "-5nN:20nN:lin",
    "m/s^2": "1m/s2:10m/s2", "J": "1e-20J:1e-17J", "m/s": "1cm/s:10m/s", "kg": "1e-18kg:1e-15kg", "N/m": "1N/m:100N/m",
}  # fmt: skip


@pytest.mark.slow
def test_any_quantity_over_any_input_is_drawn_or_refused_in_a_line(run: Run) -> None:
    drawn = 0
    for quantity in NOMENCLATURE:
        for name in sorted(depends_on((quantity,))):
            if name not in NOMENCLATURE or NOMENCLATURE[name].unit not in _EXAMPLES:
                continue
            radius = "" if name == "radius" else "100nm"
            for axes in (radius, "--y radius=5nm:1um:20"):
                ran = run(f"map {quantity} quartz {axes} --x {name}={_EXAMPLES[NOMENCLATURE[name].unit]} --quiet")
                assert ran.code in (0, 1, 2)
                assert len(ran.err.splitlines()) == (ran.code != 0)
                drawn += ran.code == 0
    assert drawn > 1000


@pytest.mark.parametrize(
    ("model", "sentence", "regions"),
    [
        ("jkr", "Pull-off force, P_c, Eq (1), under JKR.", ["JKR is off by more than 5 %", "a/z0 < 3"]),
        ("maugis", "Pull-off force, P_c, Maugis 1992, under Maugis–Dugdale.", ["a/z0 < 3"]),
        ("dmt", "Pull-off force, P_c, Eq (1), under DMT.", ["DMT is off by more than 5 %", "a/z0 < 3"]),
    ],
)
def test_a_map_names_its_law_and_is_judged_by_it(run: Run, model: str, sentence: str, regions: list[str]) -> None:
    ran = run(f"map pull-off --x radius=1nm:1mm --y gamma=1mJ/m2:10J/m2 --young 54GPa --poisson 0.17 --model {model}")
    assert sentence in " ".join(ran.out.split())
    assert re.findall(r"a/z0 < 3|\w+ is off by more than 5 %", " ".join(ran.out.split())) == regions
    assert "are not judged" not in ran.out


@pytest.mark.parametrize(
    ("line", "has_load"),
    [
        ("map pull-off quartz --x radius=1nm:1mm", False),
        ("map tabor_parameter quartz --x radius=1nm:1mm --y gamma=1mJ/m2:1J/m2", False),
        ("map pull-off quartz --x radius=1nm:1mm --load 1nN", True),
        ("map contact_radius_at_load quartz --x radius=1nm:1mm", True),
    ],
)
def test_the_caption_has_the_load_if_it_is_given_or_the_quantity_depends_on_it(
    run: Run, line: str, has_load: bool
) -> None:
    ran = run(line)
    assert ("P = " in " ".join(ran.out.split()).partition("Fixed: ")[2].partition(". ")[0]) is has_load
    assert ("assumed: no load" in ran.err) is (has_load and "--load" not in line)


def test_the_caption_of_curves_by_several_laws_has_no_equation(run: Run) -> None:
    ran = run("map pull-off quartz --x radius=1nm:1mm --model maugis,dmt")
    assert "Pull-off force, P_c." in ran.out
    assert re.search(r"DMT is off by more than 5 % \(quartz, DMT, R1 = \S+ nm to 1 mm\)\.", " ".join(ran.out.split()))


@pytest.mark.parametrize(
    ("width", "marks"), [("80", "quartz@100nm,quartz@120nm,quartz@130nm"), ("40", "silica-humid@100nm")]
)
def test_every_mark_is_on_the_screen(run: Run, monkeypatch: pytest.MonkeyPatch, width: str, marks: str) -> None:
    """Below curves, a mark is a row; below a map, it is a value in the caption."""
    monkeypatch.setenv("COLUMNS", width)
    curves = run(f"map pull-off quartz --x radius=10nm:1um --mark {marks}", terminal=True).out
    of_map = run(f"map pull-off quartz --x radius=10nm:1um --y gamma=1mJ/m2:1J/m2 --mark {marks}", terminal=True).out
    for mark in marks.split(","):
        name = mark.replace("@", ", ").replace("nm", " nm")
        assert re.search(rf"^{name} .*N$", curves, re.MULTILINE)
        force = run(f"pull-off {mark.replace('@', ' ')} --bare --quiet").out
        assert f"{name}: P_c = {float(force) * 1e9:.4g} nN" in of_map.replace("\n", " ")


def words_about(code: str) -> str:
    """Return the first words about a doubt in a caption: a law, a condition without its number, or a consequence."""
    if code.startswith("law"):
        return "JKR is off"
    (limit,) = (limit for limit in LIMITS if code in limit.codes.values())
    if limit.number is not None:
        return limit.consequence.partition(";")[0]
    return f"{NOMENCLATURE[limit.name].symbol} {limit.sign[0]}"


def joined(text: str) -> str:
    """Return a text in lower case without spaces and line breaks."""
    return "".join(text.lower().split())


@pytest.mark.parametrize(
    ("words", "axis"),
    [
        ("n-roll quartz 100nm", "energy=1e-21J:1e-14J"),
        ("n-grav quartz", "radius=1um:1m"),
        ("sticking-speed quartz", "radius=1nm:1um"),
        ("yield-force iron", "radius=1nm:1um"),
    ],
)
def test_a_caption_has_every_doubt_of_the_rows_or_none_with_the_option_plain(run: Run, words: str, axis: str) -> None:
    quantity, *scene = words.split()
    name, ends = axis.split("=")
    sweep = f"{ends}:41" if name == "radius" else f"--{name} {ends}:41"
    rows = run(f"report {' '.join(scene)} {sweep} --quantities {quantity.replace('-', '_')} --csv").out
    codes = {code for row in csv.DictReader(io.StringIO(rows)) for code in row["doubt"].split()}
    assert codes
    with_doubts, plain = (
        joined(run(f"map {words} --x {axis} {option}", terminal=True).out) for option in ("", "--plain")
    )
    for code in codes:
        assert joined(words_about(code)) in with_doubts
        assert joined(words_about(code)) not in plain


def test_the_panel_of_moments_says_where_it_ends(run: Run) -> None:
    out = run("contact quartz 100nm --curve --panel moment --xi 3nm", terminal=True).out
    assert "\nmoment up to ξ_max = 1.33 nm\n" in out
    assert "\nξ = " not in out


@pytest.mark.parametrize("words", ["pull-off gold,quartz", "pull-off gold", "pull-off --gamma 25mJ/m2"])
def test_limits_that_are_not_judged_are_reported(run: Run, words: str) -> None:
    said = run(f"map {words} --x radius=100nm:1um", terminal=True).out.replace("\n", " ")
    assert re.search(r" Which law holds, and other limits, are not judged: that needs [^.]*modulus[^.]*\.", said)
    assert "not judged" not in run("map pull-off quartz --x radius=100nm:1um", terminal=True).out


def test_a_limit_judged_by_the_smaller_sphere_is_stated_by_its_consequence_only(run: Run) -> None:
    """Roughness is judged by the smaller sphere, which is the second one here."""
    out = run("map pull-off quartz 10um --x radius2=100nm:1mm").out
    assert re.search(
        r"Real surfaces hold less: SiO2 held 1/100 to 4/5 of JKR's force at 25 mJ/m² \(quartz, R2 = \S+ µm to 1 mm\)",
        " ".join(out.split()),
    )
    assert "R1 > " not in out


def test_a_caption_has_no_names_of_table_columns(run: Run) -> None:
    out = run("map n-roll quartz 10nm --x energy=1e-21J:1e-17J").out
    assert (
        "W0/W_yield < 3.5: a contact that slides freely rolls with 2/7 of the energy, too little to start"
        in " ".join(out.split())
    )
    assert "of n_roll" not in out
