"""Words with which users name quantities."""

from pathlib import Path
from typing import Any

import pytest

import jkroll
from harness import Run
from jkroll.quantities.nomenclature import NOMENCLATURE, UnknownQuantity, named, nearest, of_sphere, with_symbol
from jkroll.text import ascii_text
from relative import approx

WITH_SYMBOL = [name for name, quantity in NOMENCLATURE.items() if quantity.symbol and not quantity.variant_of]


def test_a_symbol_leads_to_its_quantity() -> None:
    for name in WITH_SYMBOL:
        symbol = NOMENCLATURE[name].symbol
        for word in (symbol, ascii_text(symbol)):
            found = with_symbol(word)
            assert name in found
            assert named(word) == (name if len(found) == 1 else word)


@pytest.mark.parametrize(
    ("word", "name"),
    [
        ("R_MIN", "r_min"),
        ("Pull-Off-Force", "pull_off_force"),
        ("--work-of-adhesion", "work_of_adhesion"),
        ("p_C", "pull_off_force"),
        ("Pc", "pull_off_force"),
        ("Eroll", "roll_energy"),
        ("P_cdelta0", "adhesion_energy"),
        ("dP/ddelta", "stiffness"),
        ("\u00b5", "tabor_parameter"),  # the micro sign
        ("γ", "surface_energy"),
        ("R", "reduced_radius"),
        ("r1", "radius"),
        ("delta", "approach_at_load"),
        ("v", "v"),  # the symbol of two quantities
        ("quartz", "quartz"),
    ],
)
def test_words_lead_to_the_names_of_quantities(word: str, name: str) -> None:
    assert named(word) == name


@pytest.mark.parametrize(
    ("word", "meant"),
    [
        ("E", "youngs_modulus"),
        ("P_c", "pull_off_force"),
        ("R", "reduced_radius"),
        ("rolling_force", "yield_force"),
        ("Rolling-Friction", "yield_force"),
        ("adhesion force", "pull_off_force"),
        ("pulloff", "pull_off_force"),
        ("n_rol", "n_roll"),
        ("gama", "surface_energy"),
        ("xyzzy", None),
    ],
)
def test_a_word_leads_to_the_quantity_that_it_most_likely_means(word: str, meant: str | None) -> None:
    assert nearest(word) == meant


def test_a_symbol_of_several_quantities_is_not_guessed() -> None:
    with pytest.raises(UnknownQuantity, match="'v' is the symbol of speed and edge_ratio; write the name"):
        jkroll.solve("v", material="quartz", radius=1e-7)


def test_symbols_are_accepted_wherever_a_quantity_is_named(run: Run) -> None:
    assert jkroll.solve("P_c", material="quartz", radius=1e-7) == jkroll.solve(
        "pull_off_force", material="quartz", radius=1e-7
    )
    by_symbols = run("report quartz 100nm --csv --quantities P_c,a0,delta0,R-min")
    assert by_symbols == run("report quartz 100nm --csv --quantities pull_off_force,contact_radius,approach,r_min")
    by_symbols = run("infer γ 2um --measured P_c=300nN --csv")
    assert by_symbols == run("infer gamma 2um --measured pull_off_force=300nN --csv")
    by_symbols = run("map P_c quartz --x R1=1nm:1um:3 --data -")
    assert by_symbols == run("map pull_off_force quartz --x radius=1nm:1um:3 --data -")


def test_a_symbol_without_a_unit_is_not_read_in_a_header(run: Run, tmp_path: Path) -> None:
    """A symbol in a header is an input only with a unit, in the header or in the cells."""
    table, results = tmp_path / "grains.csv", tmp_path / "results.csv"
    table.write_text("E,radius\n5,100nm\n")
    assert run("batch", str(table), "-o", str(results), "--quantities", "R_min").code == 0
    assert results.read_text().startswith("E,radius,r_min [m],")


def test_search_lists_a_quantity_before_others_that_mention_it(run: Run) -> None:
    def names(words: str) -> list[str]:
        lines = run(f"quantities {words} --csv").out.splitlines()[1:]
        return [line.partition(",")[0] for line in lines]

    assert names("E_roll") == ["roll_energy"]
    assert names("v") == ["speed", "edge_ratio"]
    assert names("pull off")[0] == "pull_off_force"
    assert "pull_off_force_maugis" not in names("pull off")
    assert "pull_off_force_maugis" in names("maugis")
    assert names("roll").index("rolling_mass") < names("roll").index("yield_force")
    assert names("surface tension") == ["surface_energy"]
    assert run("quantities", "surface tension") == run("quantities surface tension")
    assert names("critical rolling displacement") == ["yield_displacement"]
    assert "variants      pull_off_force_maugis" in run("quantities P_c").out
    assert "'++' has no word to search for" in run("quantities ++").err


def test_an_input_named_like_an_option_is_the_quantity_of_the_option() -> None:
    """The input `approach` is δ at the load; the result of this name is δ0."""
    contact: dict[str, Any] = {"material": "quartz", "radius": 1e-7}
    assert jkroll.solve("load", approach=-5e-11, **contact) == jkroll.solve("load", approach_at_load=-5e-11, **contact)
    assert jkroll.solve("approach", **contact) == approx(1.0618e-10, rel=1e-4)


def test_quantities_separated_by_a_comma_are_listed(run: Run) -> None:
    names = [line.split()[0] for line in run("quantities P_c,Q").out.splitlines()]
    assert names[1:] == ["pull_off_force", "yield_force"]


def test_quantities_of_the_two_spheres_are_each_other_s_twins() -> None:
    of_spheres = {name: quantity for name, quantity in NOMENCLATURE.items() if quantity.sphere}
    assert {"material", "radius2", "mass2", "hamaker"} <= of_spheres.keys()
    for name, quantity in of_spheres.items():
        twin = NOMENCLATURE[quantity.twin]
        assert (twin.twin, twin.sphere + quantity.sphere) == (name, 3)
        assert [of_sphere(sphere, name) for sphere in (quantity.sphere, twin.sphere)] == [name, quantity.twin]
