"""Inferred values by the law that holds and by the law in use, compared with those of the material."""

import csv
import json
import math
import re
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from harness import Run
from jkroll import solve
from relative import approx

FORCE, RADIUS = 300e-9, 2e-6
ON_PLANE = "infer gamma quartz 2um --radius2 plane --measured"
BY_JKR, BY_DMT = FORCE / (3 * math.pi * RADIUS), FORCE / (4 * math.pi * RADIUS)  # P_c = 3/2 πwR and 2πwR, w = 2γ
SPACINGS = (4e-10, 2e-10)
QUARTZ: dict[str, Any] = {"material": "quartz", "radius": RADIUS, "radius2": math.inf, "model": "maugis"}


def bisected(forward: Callable[[float], float], level: float, low: float, high: float) -> float:
    """Return the argument at which an increasing function reaches a level."""
    for _ in range(60):
        middle = math.sqrt(low * high)
        low, high = (middle, high) if forward(middle) < level else (low, middle)
    return low


@cache
def by_maugis(force: float, spacing: float) -> float:
    """Return the surface energy that gives quartz on a plane a pull-off force, by Maugis' law at an atomic spacing."""

    def pulled(energy: float) -> float:
        return float(solve("pull_off_force", surface_energy=energy, atomic_spacing=spacing, **QUARTZ))

    return bisected(pulled, force, 1e-4, 10.0)


def rows(run: Run, words: str) -> list[list[str]]:
    """Return the rows of a table, beginning with the symbol and the law."""
    lines = run(f"{words} --quiet", terminal=True).out.splitlines()
    start = next(number for number, line in enumerate(lines) if line.startswith("──"))
    found = ([cell.strip() for cell in line.split("  ") if cell.strip()] for line in lines[start + 1 :])
    return [cells[1:] for cells in found if len(cells) > 3]


def test_the_first_row_is_the_range_by_the_law_that_holds_at_both_atomic_spacings(run: Run) -> None:
    energies = sorted(1e3 * by_maugis(FORCE, spacing) for spacing in SPACINGS)
    assert 1e3 * BY_DMT < energies[0] < energies[1] < 1e3 * BY_JKR
    range_of_both = "–".join(f"{energy:.0f}" for energy in energies)
    assert rows(run, f"{ON_PLANE} P_c=300nN") == [
        ["γ", "Maugis (best)", range_of_both, "25", "mJ/m²"],
        ["γ", "JKR", f"{1e3 * BY_JKR:.2f}", "25", "mJ/m²"],
    ]


def test_an_uncertain_force_widens_the_range_by_the_law_that_holds(run: Run) -> None:
    ends = by_maugis(FORCE, SPACINGS[0]), by_maugis(FORCE, SPACINGS[1])
    (result,) = json.loads(run(f"{ON_PLANE} P_c=300±20nN --json").out)["results"]
    best = result["best"]
    assert best["by"] == "Maugis"
    assert "over z0 (--z0) and the errors" in best["why"]
    # Inferred energies are nearly proportional to the force.
    assert best["low"] == approx(min(ends) * 280 / 300, rel=0.01)
    assert best["high"] == approx(max(ends) * 320 / 300, rel=0.01)
    assert result["value"] == approx(BY_JKR)


def test_there_is_one_row_if_the_law_in_use_holds(run: Run) -> None:
    """γ follows from P_c = 3πγR with the reduced radius of two equal spheres, 50 µm."""
    energy = 1e3 * 20e-6 / (3 * math.pi * 50e-6)
    assert rows(run, "infer gamma pdms 100um --measured P_c=20uN") == [["γ", "JKR", f"{energy:.2f}", "20.1", "mJ/m²"]]


@pytest.mark.parametrize(("model", "head", "energy"), [("jkr", "JKR", BY_JKR), ("dmt", "DMT", BY_DMT)])
def test_a_given_law_is_the_only_law_of_the_table(run: Run, model: str, head: str, energy: float) -> None:
    found = rows(run, f"{ON_PLANE} P_c=300nN --model {model}")
    assert found == [["γ", head, f"{1e3 * energy:.2f}", "25", "mJ/m²"]]


def test_two_unknowns_have_a_block_of_rows_for_each_law(run: Run) -> None:
    found = rows(run, f"{ON_PLANE.replace('gamma', 'gamma,young')} P_c=300nN --measured stiffness=1kN/m")
    assert [row[:2] for row in found] == [
        ["γ", "Maugis (best)"],
        ["E", "Maugis (best)"],
        ["γ", "JKR"],
        ["E", "JKR"],
    ]
    assert [row[3] for row in found] == ["25", "54", "25", "54"]
    assert found[2][2] == f"{1e3 * BY_JKR:.2f}"  # the pull-off force of JKR does not depend on a modulus


def test_the_answer_has_a_range_for_each_of_two_unknowns(run: Run) -> None:
    """By JKR E is 34.8 GPa, by Maugis' law up to 35.1 GPa: the range covers both."""
    words = f"{ON_PLANE.replace('gamma', 'gamma,young')} P_c=300nN --measured stiffness=1kN/m"
    assert [row[2] for row in rows(run, words)][1::2] == ["35.0–35.1", "34.82"]
    said = " ".join(run(words, terminal=True).out.split())
    assert "the measurement implies γ = 14–15 mJ/m² and E = 34.8–35.1 GPa;" in said


def test_a_note_says_why_a_law_has_no_solution(run: Run) -> None:
    words = "infer young quartz 1um --measured yield_force=100pN --hysteresis-fraction 40%"
    assert [row[:-2] for row in rows(run, words)] == [["E", "Maugis", "–"], ["E", "JKR", "2746"]]
    said = " ".join(run(words, terminal=True).out.split())
    assert "JKR only: by Maugis' law no value gives yield_force = 100 pN; it lies between" in said
    assert "E is 51 times quartz's (54 GPa)" in " ".join(run(f"{words} --explain").out.split())  # 2746/54


def test_a_value_without_a_meaning_is_not_compared_with_the_library(run: Run) -> None:
    """γ = P_c/3πR is 2.1 J/m², 100 times that of PDMS; the contact is then wider than the sphere."""
    ran = run("infer gamma pdms 5um --radius2 plane --measured P_c=100uN", terminal=True)
    assert (ran.code, "contact is wider than the smaller sphere" in ran.out) == (0, True)
    assert "times pdms's" not in ran.out


def test_without_a_material_there_is_no_column_of_its_values(run: Run) -> None:
    words = "infer w --young 54GPa --poisson 0.17 2um --radius2 plane --measured P_c=300nN"
    assert all("has" not in line.split() for line in run(words, terminal=True).out.splitlines())
    assert [row[-1] for row in rows(run, words)] == ["mJ/m²"] * 2
    assert [len(row) for row in rows(run, words)] == [4, 4]


@pytest.mark.parametrize(
    ("words", "factor", "note"),
    [
        (
            "gamma quartz",
            1 / 32,
            r"γ is 1/([\d.]+) to 1/([\d.]+) of quartz's \(25 mJ/m²\): probably rough or wet surfaces, for",
        ),
        (
            "w quartz",
            1 / 32,
            r"w is 1/([\d.]+) to 1/([\d.]+) of quartz's \(50 mJ/m²\): probably rough or wet surfaces, for",
        ),
        (
            "w quartz --material2 mica",
            1 / 6,
            r"w is 1/([\d.]+) to 1/([\d.]+) of quartz and mica's \(122 mJ/m²\): probably rough or wet",
        ),
        ("gamma quartz", 8.0, r"γ is ([\d.]+) times quartz's \(25 mJ/m²\): probably rough or wet surfaces,"),
        ("gamma quartz", 1 / 4, ""),
        ("gamma quartz", 4.9, ""),
        ("young quartz", 1 / 32, ""),
    ],
)
def test_a_note_reports_energies_far_from_those_of_the_materials(
    run: Run, words: str, factor: float, note: str
) -> None:
    """P_c = 3/2 πwR by JKR, up to 2πwR by other laws; w = 2√(γ1γ2), and γ of mica is 0.15 J/m²."""
    work = 2 * math.sqrt(0.025 * (0.15 if "mica" in words else 0.025))
    measured = f"P_c={1.5 * math.pi * factor * work * RADIUS}N"
    if "young" in words:  # a0³ = 9πwR²/(2E*), and E* = E/(2(1 - ν²))
        modulus = factor * 54e9 / 2 / (1 - 0.17**2)
        measured = f"contact_radius={(9 * math.pi * work * RADIUS**2 / 2 / modulus) ** (1 / 3)}m"
    said = " ".join(run(f"infer {words} 2um --radius2 plane --measured {measured}", terminal=True).out.split())
    if not note:
        assert "rough or wet" not in said
        return
    found = re.search(note, said)
    assert found
    times = float(found[1]) if factor > 1 else 1 / float(found[1])
    assert 0.74 * factor <= times <= 1.01 * factor


def test_a_table_has_the_best_range_of_an_inferred_value(run: Run) -> None:
    Path("in.csv").write_text("radius,P_c\n2um,300nN\n1um,-1nN\n")
    run("batch in.csv -o out.csv --infer gamma --measured P_c --radius2 plane --material quartz --best --quiet")
    first, last = csv.DictReader(Path("out.csv").read_text(encoding="utf-8").splitlines())
    keys = [f"surface_energy_best_{end} [J/m^2]" for end in ("low", "high")]
    energies = sorted(by_maugis(FORCE, spacing) for spacing in SPACINGS)
    assert [float(first[key]) for key in keys] == approx(energies, rel=1e-9)
    assert [last[key] for key in keys] == ["", ""]


@pytest.mark.parametrize("radii", ["2um", "2um,3um", "2um:3um:12"])
def test_lists_and_sweeps_have_the_best_range_of_an_inferred_value(run: Run, radii: str) -> None:
    ran = run(f"infer gamma quartz {radii} --radius2 plane --measured P_c=300nN --csv --best --quiet")
    first = next(iter(csv.DictReader(ran.out.splitlines())))
    energies = sorted(by_maugis(FORCE, spacing) for spacing in SPACINGS)
    ends = [float(first[f"surface_energy_best_{end} [J/m^2]"]) for end in ("low", "high")]
    assert ends == approx(energies, rel=1e-9)
    assert first["surface_energy_best_by"] == "Maugis"


@pytest.mark.parametrize(
    ("words", "solid"),
    [
        ("pull-off quartz 100nm", "R1 = 100 nm on a plane of quartz"),
        ("pull-off quartz 100nm --material2 mica", "R1 = 100 nm on a plane of mica"),
        ("pull-off 100nm --gamma 25mJ/m2", "R1 = 100 nm on a plane of the same solid"),
        ("pull-off 100nm --gamma 25mJ/m2 --gamma2 50mJ/m2", "R1 = 100 nm on a plane, γ1"),
        ("pull-off 100nm --work-of-adhesion 50mJ/m2 --contact-modulus 1MPa", "R1 = 100 nm on a plane, w"),
        ("pull-off quartz,mica 100nm", "R1 = 100 nm on a plane of the same solid"),
        ("pull-off quartz 100nm --material2 mica,gold", "R1 = 100 nm on a plane"),
    ],
)
def test_the_head_names_the_solid_of_the_plane_if_there_is_only_one(run: Run, words: str, solid: str) -> None:
    head = " ".join(run(f"{words} --radius2 plane", terminal=True).out.split())
    assert solid in head
    assert ("plane of" in head) == ("plane of" in solid)
