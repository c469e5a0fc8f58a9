"""tests/tools/missing.py lists nothing for complete names, and each part that a test here removes."""

import copy
from collections.abc import Iterator, Mapping
from typing import Any

import pytest

import reference
from jkroll import FORMULAS, NOMENCLATURE
from jkroll.tables.files import FORMATS
from tools import missing as tool
from tools.missing import NOMENCLATURE_FILE, REFERENCE, Lack, missing

EVERY = [*dict.fromkeys((*NOMENCLATURE, *FORMULAS, *FORMATS))]


@pytest.fixture(autouse=True)
def _fresh() -> Iterator[None]:
    yield
    tool._drawn_scenes.cache_clear()


def without(mapping: Mapping[str, Any], *names: str) -> dict[str, Any]:
    """Return a mapping without some names."""
    return {name: value for name, value in mapping.items() if name not in names}


@pytest.mark.parametrize("name", EVERY[::20])
def test_nothing_is_missing_for_a_sample_of_names(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tool, "PAGES", [])
    assert missing(name) == []


@pytest.mark.slow
def test_nothing_is_missing_for_any_name() -> None:
    assert [lack for name in EVERY for lack in missing(name)] == []


def test_a_new_name_lacks_a_row_and_a_formula() -> None:
    assert [lack.file for lack in missing("contact_circumference")] == [NOMENCLATURE_FILE, "src/jkroll/physics"]


def test_a_missing_reference_equation_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    equations = without(reference.EQUATIONS, "contact_area", "well_energy_lennard_jones")
    monkeypatch.setattr(reference, "EQUATIONS", equations)
    assert missing("contact_area") == [Lack(REFERENCE, 'EQUATIONS: "contact_area": lambda a: …,')]
    line = 'EQUATIONS: "well_energy_lennard_jones": lambda w, R, z0, mu: …,'
    assert missing("well_energy_lennard_jones") == [Lack("tests/law_reference.py", line)]


def test_a_missing_row_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tool, "NOMENCLATURE", without(NOMENCLATURE, "contact_area"))
    assert missing("contact_area") == [
        Lack(NOMENCLATURE_FILE, '"contact_area": Quantity("SYMBOL", "m^2", "SENTENCE"),')
    ]


def test_a_missing_row_of_a_parameter_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tool, "NOMENCLATURE", without(NOMENCLATURE, "yield_displacement"))
    line = '"yield_displacement": Quantity("SYMBOL", "m", "SENTENCE", option=…),'
    assert missing("r_min") == [Lack(NOMENCLATURE_FILE, line)]


@pytest.mark.parametrize(
    ("name", "change", "line"),
    [
        ("contact_area", {"unit": "m"}, 'the unit "m^2" of contact_area, which its formula has'),
        ("contact_area", {"symbol": ""}, "a symbol of contact_area"),
        ("gravity", {"example": ""}, 'example="…", in the row of gravity'),
        (
            "gravity",
            {"example": "1 N"},
            "another example: gravity: '1 N' is a force; expected an acceleration such as 1.62m/s2",
        ),
    ],
)
def test_a_faulty_row_is_named(name: str, change: dict[str, str], line: str, monkeypatch: pytest.MonkeyPatch) -> None:
    row = copy.copy(NOMENCLATURE[name])
    vars(row).update(change)
    monkeypatch.setattr(tool, "NOMENCLATURE", {**NOMENCLATURE, name: row})
    assert missing(name) == [Lack(NOMENCLATURE_FILE, line)]


def test_a_missing_formula_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tool, "FORMULAS", without(FORMULAS, "contact_area"))
    monkeypatch.setattr(tool, "formula_of", lambda _: None)
    monkeypatch.setattr(tool, "routes_anywhere", dict)
    assert [lack.file for lack in missing("contact_area")] == ["src/jkroll/physics"]


def test_a_missing_equation_in_a_docstring_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tool, "docstring_fields", lambda _: {"summary": "Return it.", "formula": ""})
    assert [lack.file for lack in missing("contact_area")] == ["src/jkroll/physics/contact.py"]


def test_a_missing_accuracy_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tool, "accuracy_of", lambda _: "0.001 ulp")
    assert [lack.file for lack in missing("contact_area")] == ["src/jkroll/physics/accuracy.py"]


def test_an_outdated_page_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tool, "transcript", lambda command: f"$ {command}\nanother row\n")
    page = "src/jkroll/guide/energies.md"
    assert Lack(page, f"run python tests/transcripts.py {page}") in missing("well_energy")


def test_a_help_that_is_too_long_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tool, "HELP_LINES", 10)
    assert [lack.file for lack in missing("gravity")] == ["src/jkroll/cli/commands.py"]


def test_a_found_table_whose_record_omits_a_new_input_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    record = {"table": "material,Yield Strength (MPa)\n", "reads": {"material": ["iron"]}}
    monkeypatch.setattr(tool, "found_tables", lambda: [("someone/tables", record)])
    line = "yield_strength in `reads` of [[someone/tables]]"
    assert missing("yield_strength") == [Lack("tests/tables/found_tables.toml", line)]


def test_a_synonym_that_has_become_an_option_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tool, "CERTAIN_SYNONYMS", {"pull_off_force": ["adhesion", "gravity"]})
    line = "pull_off_force without gravity, which is an option now"
    assert missing("gravity") == [Lack("src/jkroll/quantities/synonyms.py", line)]


def test_missing_mentions_of_a_format_are_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tool, "FORMATS", {"ods": "ods"})
    files = ["src/jkroll/cli/options.py", "tests/corpus/command_lines.txt", "src/jkroll/guide/tables.md"]
    assert [lack.file for lack in missing("ods")] == files
