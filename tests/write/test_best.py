"""Best ranges in tables, lists, lines, files and explanations: where they stand, and when they are left out."""

import csv
import re
from itertools import product
from typing import Any

import pytest

from harness import Run
from jkroll import answer, solve
from jkroll.model.estimate import WORDS
from jkroll.quantities.formatting import significant
from jkroll.report.best_ranges import lines_on_rules
from relative import approx

QUARTZ: dict[str, Any] = {"material": "quartz", "radius": 1e-7}


def cells(run: Run, words: str, symbol: str) -> list[str]:
    """Return the cells of the table row with a symbol, beginning with the symbol."""
    (line,) = [line for line in run(words, terminal=True).out.splitlines() if f" {symbol} " in line]
    return re.split(r"\s{2,}", line[line.index(f"{symbol} ") :].strip())


def test_a_table_has_the_best_range_before_the_value_by_jkr(run: Run) -> None:
    """SiO2 spheres of 0.95 µm rolled at 0.69 to 1.57 nN. Scaled to 100 nm as R and R^(2/3), this gives 73 and 350 pN.

    By every law, the angle ξ/R is 4 mrad for ξ = 2 Å and R = 50 nm.
    """
    assert approx([72.6, 350.0], rel=1e-3) == [0.69e3 * 1 / 9.5, 1.57e3 * (1 / 9.5) ** (2 / 3)]
    assert cells(run, "yield-force quartz 100nm", "Q") == ["Q", "73–350", "scaled", "94.25", "pN"]
    assert cells(run, "yield-force quartz 100nm --xi 2angstrom", "δ_α") == ["δ_α", "4.000", "any law", "4.000", "mrad"]
    heads = re.split(r"\s{2,}", run("yield-force quartz 100nm", terminal=True).out.partition("\n─")[0].splitlines()[-1])
    assert heads == ["quantity", "symbol", "best range", "by", "JKR", "unit"]


@pytest.mark.parametrize(
    "words",
    ["frequencies iron {}", "yield-force quartz {} --model dmt", "report quartz {} --quantities F_cδ_c"],
)
def test_best_ranges_given_by_the_law_in_use_or_a_definition_are_left_out(run: Run, words: str) -> None:
    for sizes in ("1mm", "1mm,2mm"):
        assert "best" not in run(words.format(sizes), terminal=True).out


def test_lists_have_the_best_range_of_the_headline_unless_they_compare_laws(run: Run) -> None:
    least = solve("pull_off_force", model="maugis", **QUARTZ, atomic_spacing=2e-10)
    most = solve("pull_off_force_lennard_jones", **QUARTZ, atomic_spacing=4e-10)
    out = run("pull-off quartz 100nm,200nm --quantities P_c", terminal=True).out
    row = next(line for line in out.splitlines() if line.split()[:1] == ["100"])
    assert row.split()[1:3] == [f"{significant(least * 1e9, 2)}–{significant(most * 1e9, 2)}", "Maugis"]
    out = run("pull-off quartz 100nm --model jkr,maugis", terminal=True).out
    assert "\nof these laws, maugis is the better one; best ranges: leave out --model\n" in out
    assert "best P_c" not in out
    out = run("yield-force quartz 2nm 1um", terminal=True).out  # the force at 2 nm has no meaning
    assert re.search(r"^best Q \[pN\] +– +710–1700$", out, re.MULTILINE)
    assert re.search(r"^by +– +scaled$", out, re.MULTILINE)


def test_files_and_lines_have_best_ranges_only_with_the_option_best(run: Run) -> None:
    best = answer("pull-off", **QUARTZ).best["pull_off_force"]
    heads = ["pull_off_force_best_low [N]", "pull_off_force_best_high [N]", "pull_off_force_best_by"]
    assert not any(head in run("pull-off quartz 100nm --csv").out for head in heads)
    (row,) = csv.DictReader(run("pull-off quartz 100nm --csv --best").out.splitlines())
    assert [row[head] for head in heads[2:]] == [best.by]
    assert [float(row[head]) for head in heads[:2]] == [best.low, best.high]
    assert [*row].index(heads[0]) == [*row].index("pull_off_force [N]") + 1
    lines = run("pull-off quartz 100nm --best").out.splitlines()
    assert [line.split()[0] for line in lines[1:4]] == [head.split()[0] for head in heads]
    assert "_best_" not in run("pull-off quartz 100nm").out
    for words in ("pull-off quartz 100nm --bare", "contact quartz 100nm --curve --csv"):
        assert run(f"{words} --best").code == 2


@pytest.mark.parametrize("option", ["", "--best"])
def test_a_row_without_a_value_by_the_law_in_use_fails_with_and_without_best(run: Run, option: str) -> None:
    """A hysteresis of adhesion determines ξ by Maugis' law, but not by DMT."""
    words = "yield-force quartz 100nm,200nm --hysteresis-fraction 0.9 --model dmt --csv"
    ran = run(f"{words} {option}")
    assert (ran.code, ran.out.count("not in DMT")) == (1, 2)
    assert "2 of 2 rows failed" in ran.err


def test_a_best_range_in_a_list_includes_the_range_of_an_input(run: Run) -> None:
    """Each end of the range is the value by one law at an end of the input."""
    (row, _) = csv.DictReader(
        run("pull-off", "quartz", "100nm,1um", "--gamma", "20 to 30 mJ/m2", "--csv", "--best").out.splitlines()
    )
    given = {**QUARTZ, "surface_energy": 0.02, "atomic_spacing": 2e-10}
    assert float(row["pull_off_force_best_low [N]"]) == approx(solve("pull_off_force", model="maugis", **given))
    given = {**QUARTZ, "surface_energy": 0.03}
    assert float(row["pull_off_force_best_high [N]"]) == approx(solve("pull_off_force_lennard_jones", **given))


def test_a_list_as_text_whose_law_is_off_names_the_option_of_best_ranges(run: Run) -> None:
    hint = "(jkroll guide doubts; best ranges: --best): law-off"
    for line, is_off in (
        ("energies quartz 50nm,100nm --csv", True),
        ("energies quartz 50nm,100nm --csv --best", False),
        ("pull-off quartz 50nm,100nm --model jkr", False),
        ("pull-off pdms 50um,100um", False),
    ):
        assert (hint in run(line).err) is is_off


@pytest.mark.parametrize(
    ("line", "lead"),
    [
        (
            "impact lactose-crystalline 50um --poisson 0.3 --speed 0.5m/s --yield-strength 60MPa",
            (
                "the spheres may or may not yield; if they do, e is an upper bound: the peak pressure is 76–120 MPa; "
                "yielding starts below the surface at 96.77 MPa"
            ),
        ),
        ("impact quartz 1um --speed 0.45±0.1m/s", "at 450 ± 100 mm/s the spheres may stick or bounce"),
        ("impact quartz 1um --speed 0.2±0.05m/s", "at 200 ± 50 mm/s the spheres stick"),
        ("n-roll quartz 1um --speed 2.2cm/s", "the sphere may or may not roll: it has 2.636e-18 J"),
        ("n-roll quartz 1um --speed 1.2±0.5cm/s", "the sphere may or may not roll: it has (0.27–1.6)e-18 J"),
        ("contact quartz 100nm --load -10±1nN", "real ones may have parted, as they hold 0.12–9.4 nN"),
        ("contact quartz 100nm --load -11nN", "real ones have parted, as they hold 0.12–9.4 nN"),
        ("resistances quartz 1um", "it slides or peels off at"),
        ("resistances quartz 1um --shear-strength 100MPa", "it slides at"),
        ("resistances quartz 1um --shear-strength 20GPa", "it peels off at"),
        ("resistances quartz 1um --shear-strength 330±60MPa", "it slides or peels off at"),
    ],
)
def test_leads_compare_the_whole_ranges_of_two_numbers(run: Run, line: str, lead: str) -> None:
    assert lead in " ".join(run(line, terminal=True).out.split())


@pytest.mark.parametrize(
    ("line", "lead", "cell"),
    [
        ("n-grav polystyrene-glassy 10um --xi 42nm --density 1.062g/cm3", "at one end: 27.61 ± 0.66;", "27.61 ± 0.66"),
        ("contact lactose-crystalline 20um --poisson 0.3 --load 1uN", "a radius of 348 +38/-28 nm", "348 +38/-28"),
        ("frequencies pdms 10um", "vibrate with 180–240 kHz along their centres", "180–240"),
        ("r-min quartz 1um --xi 2angstrom", "R_min is 5.000 mm", "5.000"),
        ("yield-force quartz 100nm --model dmt", "a push of 31.42 pN at its centre", "31.42"),
    ],
)
def test_leads_have_the_digits_and_uncertainties_of_the_table(run: Run, line: str, lead: str, cell: str) -> None:
    out = run(line, terminal=True).out
    assert lead in " ".join(out.split())
    assert re.search(rf" {re.escape(cell)}( |$)", out[out.index("───") :], re.MULTILINE)


def test_explanations_have_the_values_that_make_up_a_best_range(run: Run) -> None:
    """The line has the forces by JKR, and by Maugis' law at two atomic spacings."""
    said = run("pull-off quartz 100nm --explain").out
    (line,) = re.findall(r"^  made of +(.*)", said, re.MULTILINE)
    for words, model, spacing in (
        ("JKR", "jkr", 4e-10),
        ("Maugis at 4 Å", "maugis", 4e-10),
        ("at 2 Å", "maugis", 2e-10),
    ):
        force = solve("pull_off_force", model=model, **QUARTZ, atomic_spacing=spacing)
        assert f"{words} {significant(force * 1e9, 4, zeros=True)} nN" in line


def test_explanations_have_the_power_law_of_a_result(run: Run) -> None:
    """f_z goes as γ^(1/6) E^(1/3) R^(-7/6) ρ^(-1/2). The powers of δ under a load are not simple fractions."""
    said = run("frequencies quartz 100nm --quantities f_z --explain").out
    assert "  power law R1^-1.17 γ1^0.167 E1^0.333 ν1^0.0198 ρ1^-0.5\n" in said
    # N is at the lower end of its range here.
    assert " N^-0.5\n" in run("aggregates quartz 100nm --monomers 2 --filling-factor 0.2 --explain").out
    under_load = run("contact quartz 100nm --load -5nN --quantities δ --explain").out
    powers = dict(word.split("^") for word in re.findall(r"power law (.*)", under_load)[0].split())
    ends = [solve("approach_at_load", **QUARTZ, load=load) for load in (-5.001e-9, -4.999e-9)]
    assert float(powers["P"]) == approx(2500 * (ends[0] - ends[1]) / ends[0], rel=0.01)


REASONED = (
    "report {}", "impact {} --speed 1m/s", "energies {}", "resistances {}", "pull-off {} --humidity 60%",
    "pull-off {} --humidity 60% --roughness 2nm",
)  # fmt: skip
# Each kind of reason occurs for one of these, in its longest form.
LONGEST = (
    "quartz 2nm", "quartz 100nm", "quartz 20um", "silica-dry 100nm", "ice-warm 1um", "ice-warm 20um",
    "polystyrene 20um", "mica 2nm",
)  # fmt: skip
MATERIALS = ("quartz", "silica-dry", "iron", "ice-warm", "polystyrene", "mica")
EVERY = tuple(f"{material} {size}" for material, size in product(MATERIALS, ("2nm", "100nm", "1um", "20um")))


@pytest.mark.parametrize(
    ("words", "spheres"),
    [
        *product(REASONED, [LONGEST]),
        *(pytest.param(words, EVERY, marks=pytest.mark.slow) for words in REASONED),
        pytest.param("infer gamma {} --measured v_stick=1m/s", EVERY, marks=pytest.mark.slow),
    ],
)
def test_each_rule_has_a_reason_of_one_line(run: Run, words: str, spheres: tuple[str, ...]) -> None:
    """The rule `surface` is an exception: its reason has fractions for three sorts of spheres."""
    rules = "|".join(map(re.escape, WORDS[1:]))
    for pair in spheres:
        _, _, below = run(words.format(pair), terminal=True).out.partition("───\n")
        assert not re.findall(rf"^(?:{rules}): .*\n  .*", below, re.MULTILINE), pair


def test_reasons_of_a_list_have_one_line() -> None:
    texts = [*lines_on_rules(range(len(WORDS)))]
    assert len(texts) > 10
    assert [text for text in texts if len(text) > 80] == []
