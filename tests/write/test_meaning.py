"""Numbers without a meaning: only `solve` and outputs without room for a reason show them."""

import csv
import json
import math
import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pytest

import jkroll
from harness import Run
from jkroll.quantities.nomenclature import NOMENCLATURE

GEL = "15um --radius2 plane --work-of-adhesion 71mJ/m2 --young rigid --young2 3kPa --poisson2 0.5"
WIDE, FLIES = "the contact is wider than the smaller sphere", "too fast to roll around body 2: it flies off"
SLOW, SHORT = (
    "a contact that slides freely rolls with 2/7 of the energy, too little to start rolling",
    "not even one sphere can be held out level: it rolls down, or falls off if Bo is below 1",
)
SONIC = "faster than sound in the solid: no static contact describes that"
XI = "ξ is too large for the formula"
# Each entry has a call with two values of an input, the results without a meaning at the second value (None for all
# results), and the code and the phrase of their reason.
CALLS: dict[str, tuple[tuple[str, str, str], set[str] | None, str, str]] = {
    "a sphere that does not begin to roll": (
        ("n-roll quartz 100nm", "--speed", "12cm/s,10cm/s"), {"n_roll"}, "does-not-roll-sliding", SLOW,
    ),
    "a sphere that flies off": (("n-roll quartz 1um", "--speed", "4.65m/s,4.66m/s"), None, "flies-off", FLIES),
    "an impact faster than sound, √(E/ρ) = 4557 m/s": (
        ("impact quartz 1um", "--speed", "4.55km/s,4.56km/s"),
        {"restitution", "lost_energy", "impact_pressure"},
        "faster-than-sound",
        SONIC,
    ),
    "a contact wider than its sphere": (
        (f"contact {GEL}".replace("--young2 3kPa ", ""), "--young2", "1MPa,3kPa"), None, "contact-exceeds-sphere", WIDE,
    ),
    "the pull-off force of a contact wider than its sphere": (
        (f"pull-off {GEL}".replace("--young2 3kPa ", ""), "--young2", "1MPa,3kPa"),
        None,
        "contact-exceeds-sphere",
        WIDE,
    ),
    "a chain that does not hold even one sphere": (("n-grav quartz", "", "1um,1mm"), {"n_grav"}, "no-chain", SHORT),
    "a displacement beyond its limit": (("yield-force quartz", "", "100nm,2nm"), None, "xi-over-limit", XI),
}  # fmt: skip


def words_of(call: tuple[str, str, str], *, last: bool = False) -> str:
    """Return the words of a call with a list of values, or with the last value only."""
    words, option, values = call
    return f"{words} {option} {values.split(',')[-1] if last else values}"


def shown_at_the_last_value(run: Run, call: tuple[str, str, str]) -> set[str]:
    """Return the names of the results that a call shows at its last value."""
    return {one["name"] for one in json.loads(run(f"{words_of(call, last=True)} --json").out)["results"]}


def heads_of(row: Iterable[str]) -> dict[str, str]:
    """Return the headers of quantities in a row, by the name of the quantity."""
    return {head.partition(" ")[0]: head for head in row if head.partition(" ")[0] in NOMENCLATURE}


@pytest.mark.parametrize("name", CALLS)
def test_tables_and_files_have_the_reason_instead_of_a_number_without_a_meaning(run: Run, name: str) -> None:
    call, ended, code, phrase = CALLS[name]
    rows = [*csv.DictReader(run(f"{words_of(call)} --csv").out.splitlines())]
    heads, shown = heads_of(rows[0]), shown_at_the_last_value(run, call)
    ended = shown if ended is None else ended
    # A list as CSV: the first row has the values, the last row has gaps and the reason.
    assert all(rows[0][heads[quantity]] for quantity in ended)
    assert {quantity for quantity in shown if not rows[1][heads[quantity]]} == ended
    assert phrase in rows[1]["status"].split("; ")
    assert code in rows[1]["doubt"].split()
    for words in (words_of(call), words_of(call, last=True)):  # a list, and a single pair
        one = run(f"{words} --csv")
        assert (one.code, "failed" in one.err) == (0, False)
        *_, last_row = csv.DictReader(one.out.splitlines())
        assert last_row == {head: rows[1][head] for head in last_row}
        # JSON
        every = json.loads(run(f"{words} --json").out)
        found = every[-1] if isinstance(every, list) else every
        results = {result["name"]: result for result in found["results"]}
        assert {quantity for quantity, result in results.items() if result["value"] is None} == ended
        assert all(results[quantity]["reason"] == phrase for quantity in ended)
        for quantity in ended:  # by another law or displacement, an end of a best range may have a meaning
            best = results[quantity].get("best", {})
            ends = {best.get("low"), best.get("high")}
            assert ends == {None} or name in {"a sphere that does not begin to roll", "a sphere that flies off"}
        # A terminal
        table = run(words, terminal=True)
        assert table.code == 0
        assert phrase in " ".join((table.out + table.err).split())
    for line in run(words_of(call, last=True), terminal=True).out.splitlines():
        cells = [(NOMENCLATURE[quantity].sentence, NOMENCLATURE[quantity].symbol) for quantity in ended]
        if any(sentence in line and f" {symbol} " in line for sentence, symbol in cells):
            assert " –" in line
            assert not re.search(r"\d{3}", line.rpartition(" –")[2]), line
    # A file with rows
    assert run(f"{words_of(call)} -o out.ndjson").code == 0
    *_, last = map(json.loads, Path("out.ndjson").read_text(encoding="utf-8").splitlines())
    assert all(last[heads[quantity]] is None for quantity in ended)
    assert phrase in last["status"]


@pytest.mark.parametrize("name", CALLS)
def test_bare_numbers_and_plain_lines_keep_a_number_without_a_meaning_and_warn(run: Run, name: str) -> None:
    call, ended, _, phrase = CALLS[name]
    ended = shown_at_the_last_value(run, call) if ended is None else ended
    bare, plain = run(f"{words_of(call, last=True)} --bare"), run(words_of(call, last=True))
    assert (bare.code, plain.code) == (0, 0)
    assert re.search(rf"warning: (by JKR, )?(n_roll: )?{re.escape(phrase)}", plain.err)
    assert "warning: " in bare.err
    assert "-" not in bare.out.split()
    assert ended <= {line.split()[0] for line in plain.out.splitlines()}


@pytest.mark.parametrize("name", CALLS)
def test_a_table_has_the_same_empty_cells_as_a_list_with_and_without_doubts(run: Run, name: str) -> None:
    (words, option, values), ended, _, phrase = CALLS[name]
    command, *inputs = words.split()
    *_, of_list = csv.DictReader(run(f"{words} {option} {values} --csv").out.splitlines())
    material = ["--material", inputs.pop(0)] if inputs[0] == "quartz" else []
    heads = [{"--speed": "speed", "--young2": "youngs_modulus2", "": "radius"}[option]]
    lines = [[value] for value in values.split(",")]
    if option:
        heads, lines = ["radius", *heads], [[inputs[0], *line] for line in lines]
        del inputs[0]
    Path("in.csv").write_text("\n".join(map(",".join, [heads, *lines])), encoding="utf-8")
    for more in ([], ["--no-doubt"]):
        ran = run("batch", "in.csv", "-o", "out.csv", *material, *inputs, "--quantities", command, *more)
        assert ran.code == 0, ran.err
        assert phrase in " ".join(ran.err.split())
        *_, of_table = csv.DictReader(Path("out.csv").read_text(encoding="utf-8").splitlines())
        assert ("doubt" in of_table) is not bool(more)
        results = [head for head in of_table if head in of_list and head.partition(" ")[0] in shown_by(run, command)]
        empty = {head.partition(" ")[0] for head in results if not of_table[head]}
        assert empty == {head.partition(" ")[0] for head in results if not of_list[head]}
        assert empty if ended is None else empty == ended


def shown_by(run: Run, command: str) -> set[str]:
    """Return the names of the quantities that a command shows."""
    given = "--speed 10m/s" if command == "n-roll" else ""
    return {one["name"] for one in json.loads(run(f"{command} quartz 1um {given} --json").out)["results"]}


def test_a_quartz_sphere_of_1_um_flies_off_at_4_65_m_per_s() -> None:
    """With m v²/(R1 + R2) = P_c, v² = 1.1781e-7 N · 2 µm/1.0891e-14 kg = 21.635 m²/s²."""
    speed = math.sqrt(1.5 * math.pi * 0.05 * 0.5e-6 * 2e-6 / (4 / 3 * math.pi * 1e-18 * 2600))
    assert round(speed, 2) == 4.65
    ratio = jkroll.solve("flight_ratio", material="quartz", radius=1e-6, speed=speed)
    assert math.isclose(ratio, 1, rel_tol=1e-12)
    assert jkroll.solve("flight_ratio", material="quartz", radius=1e-6, radius2=math.inf, speed=1e3) == 0  # on a plane
    for radius2, more in ((1e-6, 1.0), (3e-6, 1.5 * 4 / 2)):  # P_c ~ R, which is 0.75 µm instead of 0.5 µm
        found = jkroll.solve("flight_ratio", material="quartz", radius=1e-6, radius2=radius2, speed=speed)
        assert math.isclose(found, 1 / more, rel_tol=1e-12)


def test_a_speed_along_the_surface_is_not_judged_like_a_head_on_impact(run: Run) -> None:
    """Quartz spheres of 1 µm stick up to 0.087 m/s.

    At 1 m/s they bounce in a head-on impact, but roll along a surface.
    """
    rolled = json.loads(run("n-roll quartz 1um --speed 1m/s --json").out)
    assert [round(one["value"], 2) for one in rolled["results"]] == [13.14, 5.25, 18.39]
    assert not {"bounces", "flies-off"} & {one["code"] for one in rolled["validity"]}
    assert "bounce" not in run("n-roll quartz 1um --speed 1m/s").err
    hit = json.loads(run("impact quartz 1um --speed 1m/s --json").out)
    assert [one["name"] for one in hit["results"]] == [
        "restitution",
        "sticking_speed",
        "lost_energy",
        "impact_pressure",
    ]
    assert "bounces" in {one["code"] for one in hit["validity"]}
    # A free pair of 100 nm sticks up to 595.6 mm/s, by the energy of relative motion: mv²/4, half that of one sphere.
    for speed, is_above in (("0.59m/s", False), ("0.60m/s", True)):
        found = json.loads(run(f"impact quartz 100nm --speed {speed} --json").out)
        assert ("bounces" in {one["code"] for one in found["validity"]}) is is_above
        assert (found["results"][0]["value"] > 0) is is_above


def test_limits_that_depend_on_the_atomic_spacing_are_not_judged_without_it(run: Run) -> None:
    """By Maugis' law U_stick of small, hard spheres depends on z0, and so does each limit on a speed."""
    row = run("impact quartz 100nm,1m --speed 1m/s --model maugis --csv")
    small, large = csv.DictReader(row.out.splitlines())
    assert ("unchecked" in small["doubt"].split(), small["status"]) == (True, "needs atomic_spacing")
    assert ("unchecked" in large["doubt"].split(), "bounces" in large["doubt"].split()) == (False, True)
    objects = json.loads(run("impact quartz 100nm,1m --speed 1m/s --model maugis --json").out)
    assert any(text.startswith("not checked: bounces: depends on z0") for text in objects[0]["notes"])
    for name in ("energy_over_sticking", "speed_over_sticking"):
        with pytest.raises(jkroll.JkrollError, match="depends on z0"):
            jkroll.solve(name, material="quartz", radius=1e-7, speed=1.0, model="maugis")


def test_answer_has_the_reason_and_solve_the_number_without_a_meaning() -> None:
    """n_roll = W0/(14πP_cξ), with W0 = ½ · 1.0891e-17 kg · 0.01 m²/s² and P_c = 11.781 nN."""
    given: dict[str, Any] = {"material": "quartz", "radius": 1e-7, "speed": 0.1}
    found = jkroll.answer("n-roll", **given)
    assert (found["n_roll"].value, found["n_roll"].reason) == (None, SLOW)
    assert str(found["n_roll"]) == f"no value: {SLOW}"
    assert f"{found['n_imp'].value:.4g}" == "0.001314"
    assert found.best["n_roll"].by == "–"  # nor does the sphere roll with any measured rolling force
    assert f"{jkroll.solve('n_roll', **given):.5g}" == "0.00052546"


def test_a_contact_wider_than_its_sphere_is_the_first_warning_and_leaves_no_result(run: Run) -> None:
    """By hand a0 = (9π · 0.071 · 15e-6²/(2 · 4000))^(1/3) = 38.36 µm, 2.5575 radii."""
    said = run(f"report {GEL} --density 1g/cm3").err
    warning, *others = [line for line in said.splitlines() if line.startswith(("warning: ", "note: "))]
    assert warning.startswith(f"warning: {WIDE}; the surface tension of the solid matters then")
    assert "(a/R_small = 2.56)" in warning
    assert not any(re.search(r"\d (N|m|µm|nN|J)\b", line) for line in others)  # no note quotes a number
    assert f"warning: {WIDE}" in run(f"report {GEL} --density 1g/cm3 --quiet").err
    found = jkroll.answer("report", radius="15um", radius2="plane", work_of_adhesion="71mJ/m2", youngs_modulus="rigid",
        youngs_modulus2="3kPa", poisson_ratio2=0.5, density="1g/cm3")  # fmt: skip
    assert {result.value for result in found.values.values()} == {None}
    assert found.doubts[0].code == "contact-exceeds-sphere"
    assert round(found.doubts[0].value, 3) == 2.558
    assert run(f"export lammps {GEL} --density 1g/cm3 --density2 1g/cm3").out.count(f"# warning: {WIDE}") == 1


def test_no_law_holds_for_a_contact_wider_than_its_sphere(run: Run) -> None:
    out = run(f"report {GEL} --quantities tabor_parameter", terminal=True).out
    assert f"\nwarning: {WIDE}" in out.replace("\n  ", " ")
    assert "holds here" not in out
    assert "JKR holds here" in run(f"report {GEL.replace('3kPa', '1MPa')} --quantities μ", terminal=True).out


def test_a_load_widens_a_contact_beyond_its_sphere(run: Run) -> None:
    """Without load a0 is 11.7 µm. Even without adhesion, 1.2 µN presses a sphere of 15 µm to a = R (Hertz)."""
    soft = "15um --radius2 plane --work-of-adhesion 2mJ/m2 --young rigid --young2 3kPa --poisson2 0.5"
    few, many = csv.DictReader(run(f"contact {soft} --load 0N,2uN --csv").out.splitlines())
    assert math.isclose(float(few["contact_radius_at_load [m]"]), 11.67e-6, rel_tol=1e-3)
    assert (many["contact_radius_at_load [m]"], many["status"]) == ("", WIDE)
    curve = run(f"contact {soft} --curve --load 0N:2uN --csv")
    radii = [row["contact_radius_at_load [m]"] for row in csv.DictReader(curve.out.splitlines())]
    assert curve.code == 0
    assert radii[0]
    assert not radii[-1]
    assert max(float(radius) for radius in radii if radius) <= 15e-6
    assert WIDE in " ".join(curve.err.split())


def test_a_value_inferred_from_a_contact_wider_than_its_sphere_is_left_out(run: Run) -> None:
    """A pull-off force of 5 µN gives w = 71 mJ/m² for a sphere of 15 µm, and a contact wider than the sphere."""
    measured = "--measured pull_off_force=5.0187uN"
    words = f"infer work_of_adhesion 15um --radius2 plane --young rigid --young2 3kPa --poisson2 0.5 {measured}"
    [result] = json.loads(run(f"{words} --json").out)["results"]
    assert (result["value"], result["reason"]) == (None, WIDE)
    [row] = csv.DictReader(run(f"{words} --csv").out.splitlines())
    assert (row["work_of_adhesion [J/m^2]"], row["status"]) == ("", WIDE)
    assert run(f"{words} --bare").out.startswith("0.0710")
    Path("in.csv").write_text("radius,pull_off_force\n15um,5.0187uN\n15um,5e-9 N\n", encoding="utf-8")
    options = "--radius2 plane --young rigid --young2 3kPa --poisson2 0.5 --infer work_of_adhesion"
    assert run(f"batch in.csv -o out.csv {options} --measured pull_off_force").code == 0
    first, second = csv.DictReader(Path("out.csv").read_text(encoding="utf-8").splitlines())
    assert (first["work_of_adhesion [J/m^2]"], first["status"]) == ("", WIDE)
    assert math.isclose(float(second["work_of_adhesion [J/m^2]"]), 5e-9 / (1.5 * math.pi * 15e-6), rel_tol=1e-6)


def test_a_result_for_identical_spheres_has_no_value_for_unequal_ones(run: Run) -> None:
    words = "frequencies quartz 100nm --radius2 200nm --quantities rolling_frequency_as_printed,vertical_frequency"
    printed, vertical = json.loads(run(f"{words} --json").out)["results"]
    assert (printed["value"], printed["reason"]) == (None, "defined for identical spheres only")
    assert vertical["value"] > 0
    [row] = csv.DictReader(run(f"{words} --csv").out.splitlines())
    assert (row["rolling_frequency_as_printed [Hz]"], row["status"]) == ("", "sphere 2 differs")
    assert run(f"{words} --csv").code == 0


# --- Doubts that leave numbers their meaning --------------------------------------------------------------------------


def test_a_state_beyond_pull_off_has_results_if_fixed_grips_hold_it(run: Run) -> None:
    """With y = √(a/a0), δ = −0.5δ0 means 3y⁴ − 2y = −0.5: y = 0.7657… or 0.2564…, below 0.7937…, y at pull-off."""
    found = json.loads(run("contact quartz 100nm --approach -53.1pm --quantities contact_radius_at_load --json").out)
    assert found["results"][0]["value"] > 0
    said = run("contact quartz 100nm --approach -60pm").err
    assert "note: only fixed grips hold this state" in said
    assert "warning" not in said


@pytest.mark.parametrize(
    ("words", "code"),
    [
        ("contact pdms 1um", "large-strain"),
        ("contact 10um --gamma 30mJ/m2 --young 100kPa --poisson 0.49", "large-strain"),
        ("contact 10um --gamma 30mJ/m2 --young 300kPa --poisson 0.45", "may-yield"),
        ("contact 1um --radius2 plane --gamma 20mJ/m2 --young 70GPa --poisson 0.2 --young2 2MPa --poisson2 0.5",
         "large-strain"),  # the strain is that of the softer body
        ("contact iron 100nm", "may-yield"),
    ],
)  # fmt: skip
def test_rubber_may_strain_beyond_linear_elasticity_and_other_solids_may_yield(run: Run, words: str, code: str) -> None:
    limits = json.loads(run(f"{words} --quantities p_H --json").out)["validity"]
    assert [limit["code"] for limit in limits if limit["name"].startswith("hertz")] == [code]
    explained = run(f"{words} --quantities p_H --explain").out
    assert ("strains too large for linear elasticity" in explained) is (code == "large-strain")
    assert ("a flawless solid" in explained) is (code == "may-yield")


def test_doubts_about_the_headline_precede_other_doubts(run: Run) -> None:
    """2a/(πR) = 2 · 16.61/(π · 50) = 0.2115, which is p_H/E*, exceeds 0.1.

    The other doubts exceed their limits by more, but do not concern the headline.
    """
    lines = run("contact quartz 100nm --load 3uN").err.splitlines()
    note = [line for line in lines if line.startswith("note: ")][-1]  # after the note on the best range
    assert note.startswith("note: the pressure exceeds even the strength of a flawless solid: numbers are rough")
    assert "(p_H/E* = 0.212, limit 0.1)" in note
    pressed, *others = jkroll.answer("contact", material="quartz", radius=1e-7, load=3e-6).doubts
    assert [doubt.code for doubt in (pressed, *others)] == ["may-yield", "law-off-2x", "sticking-unsure"]
    assert all((doubt.factor or 0) > (pressed.factor or 0) for doubt in others)


@pytest.mark.parametrize(
    ("words", "is_rough"),
    [
        ("pull-off quartz 10um", True),
        ("pull-off polystyrene 10um", True),
        ("pull-off iron 10um --material2 mica", True),  # mica is smooth, but iron is rough
        ("pull-off mica 10um", False),
        ("pull-off mica 10um --radius2 plane", False),
        ("pull-off pdms 10um", False),
        ("pull-off 10um --gamma 30mJ/m2 --young 20kPa --poisson 0.5", False),
        ("pull-off quartz 10um --radius2 plane --material2 pdms --work-of-adhesion 80mJ/m2", False),
        ("pull-off 10um --gamma 30mJ/m2", True),  # nothing is known of the solid
    ],
)
def test_forces_on_real_surfaces_are_reported_for_hard_rough_solids(run: Run, words: str, *, is_rough: bool) -> None:
    answer = run(f"{words} --quantities P_c --json").out
    assert bool(re.search("real surfaces hold|real spheres hold", answer)) is is_rough
    [row] = csv.DictReader(run(f"{words} --csv").out.splitlines())
    assert ("rough-matters" in row["doubt"].split()) is is_rough


def test_each_row_is_judged_rough_by_its_own_solid(run: Run) -> None:
    Path("in.csv").write_text("material,radius\nquartz,10um\nmica,10um\npdms,10um\n", encoding="utf-8")
    assert run("batch in.csv -o out.csv --quantities pull_off_force").code == 0
    rows = list(csv.DictReader(Path("out.csv").read_text(encoding="utf-8").splitlines()))
    assert ["rough-matters" in row["doubt"].split() for row in rows] == [True, False, False]


@pytest.mark.parametrize(
    ("line", "warning"),
    [
        (
            "report lactose-crystalline 20um --poisson 0.3",
            "warning: by JKR with ξ = 200 pm, not even one sphere can be held out level",
        ),
        ("n-grav quartz 1mm", "warning: not even one sphere can be held out level"),
        ("yield-force quartz 3nm", "warning: by JKR, ξ is too large for the formula"),
        ("n-roll quartz 1um --speed 4.66m/s", "warning: by JKR, too fast to roll around body 2"),
    ],
)
def test_a_warning_names_the_law_and_xi_if_the_best_range_has_a_meaning(run: Run, line: str, warning: str) -> None:
    assert warning in run(line).err


@pytest.mark.parametrize("words", ["quartz 100nm --gamma 1mJ/m2", "quartz 1um --gamma 1mJ/m2", "quartz 1um"])
def test_real_spheres_hold_less_than_smooth_ones(run: Run, words: str) -> None:
    """Real spheres hold the fractions of JKR's force that silica of about 25 mJ/m² held, also at another γ."""
    lines = run(f"pull-off {words}", terminal=True).out.splitlines()
    ranges = [re.findall(r"P_c +([\d.]+)–([\d.]+)", line) for line in lines]
    *real, smooth = [(float(low), float(high)) for found in ranges for low, high in found]
    assert real
    assert max(high for _, high in real) < smooth[0]


def test_a_bend_depends_on_the_surface_energy_although_rolling_forces_were_measured(run: Run) -> None:
    """Only the answer of `yield-force` says that its best range does not follow from the given γ."""
    said = "measured rolling forces, not from your γ"
    assert said in run("yield-force quartz 1um --gamma 24mJ/m2", terminal=True).out
    assert said not in run("r-min quartz 100nm --gamma 24mJ/m2", terminal=True).out
    assert said not in run("aggregates quartz 100nm --gamma 24mJ/m2", terminal=True).out


@pytest.mark.parametrize("option", ["", "--model jkr"])
def test_the_force_on_real_spheres_includes_the_uncertainty_of_the_surface_energy(run: Run, option: str) -> None:
    """JKR's force (3/2)π · 50 mJ/m² · 5 µm = 1.18 µN for γ = 25 mJ/m², 1.65 µN for 35 mJ/m²; times 1/100 and 4/5."""
    note = "note: real spheres hold 0.012–1.3 µN if like SiO2"
    assert note in run(f"pull-off 10um --gamma 30±5mJ/m2 --young 54GPa --poisson 0.17 {option}").err
