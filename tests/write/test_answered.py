"""`jkroll.answer` returns the answer of a command as an object."""

import json
import math
import re
from typing import Any

import pytest

import jkroll
from harness import Run
from jkroll.errors import code_of
from jkroll.model import reasons, unknowns
from jkroll.model.limits import ENDS
from jkroll.write.manual import page
from relative import approx

SCENES: list[tuple[str, str | list[str], dict[str, Any]]] = [
    ("pull-off quartz 100nm", "pull-off", {"material": "quartz", "radius": 1e-7}),
    ("report ice-warm 1um --radius2 plane", "report", {"material": "ice-warm", "radius": "1 um", "radius2": math.inf}),
    (
        "contact quartz 100nm --gamma 25±5mJ/m2 --load -1nN --model maugis",
        "contact",
        {"material": "quartz", "radius": "100nm", "gamma": "25±5mJ/m2", "load": -1e-9, "model": "maugis"},
    ),
    ("energies tholin 100nm --poisson 0.3", "energies", {"material": "tholin", "radius": 1e-7, "poisson": 0.3}),
    ("report iron 5nm --quantities P_c,yield_force", ["P_c", "yield_force"], {"material": "iron", "radius": 5e-9}),
]


@pytest.mark.parametrize(("words", "wanted", "scene"), SCENES, ids=lambda value: str(value)[:30])
def test_as_dict_equals_the_json_object_of_the_command(
    run: Run, words: str, wanted: str | list[str], scene: dict[str, Any]
) -> None:
    printed = json.loads(run(*words.split(), "--json").out)
    found = jkroll.answer(wanted, **scene)
    assert json.loads(json.dumps(found.as_dict())) == printed
    results = [(result["name"], result["value"], result["unit"]) for result in printed["results"]]
    assert [(name, result.value, result.unit) for name, result in found.values.items()] == results
    assert [*found.notes] == printed["notes"]
    exceeded = {limit["code"]: limit for limit in printed["validity"] if not limit["holds"]}
    assert sorted(exceeded) == sorted(doubt.code for doubt in found.doubts)
    for doubt in found.doubts:
        limit = exceeded[doubt.code]
        assert (doubt.value, doubt.limit, doubt.factor) == (limit["value"], limit["limit"], limit["factor"])
        assert limit["text"] in str(doubt)


def test_an_answer_has_uncertainties_and_units() -> None:
    found = jkroll.answer("pull_off_force", radius="100 nm", gamma="25±5 mJ/m2")
    value = found["pull_off_force"]
    assert value.uncertain == jkroll.solve("pull_off_force", radius=1e-7, gamma="25±5 mJ/m2")
    assert (str(value), value.unit) == ("11.8 ± 2.4 nN", "N")
    assert found.inputs["surface_energy"] == jkroll.Measured(0.025, 0.005)


def test_rows_have_the_cells_of_the_table_on_a_terminal(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    found = jkroll.answer("report", material="quartz", radius="100nm", speed="20cm/s")
    monkeypatch.setenv("COLUMNS", "100")  # wide enough for two blanks between columns
    printed = run("report", "quartz", "100nm", "--speed", "20cm/s", terminal=True).out.splitlines()
    for row in found.rows.values():
        (line,) = (line for line in printed if line.startswith(f"{row.quantity}  "))
        cells = [cell for cell in re.split(r"\s{2,}", line) if cell]
        unit = cells[5] if cells[5:] else ""
        power = re.sub(r"^1(?=e)", "", unit)
        joint = "" if power != unit else " "
        assert cells[:2] == [row.quantity, row.symbol]
        assert row.value == f"{cells[4]}{joint}{power}".strip()
        assert row.best.replace("(", "").replace(")", "") == f"{cells[2]}{joint}{power}".strip()
        assert (row.by, row.law) == (cells[3], "JKR")
        assert f"{row.by}: " in "\n".join(printed)
        assert found.why[row.by]
    assert found.inputs_in_words["youngs_modulus"] == "54 GPa"


def test_a_doubt_names_the_results_that_it_leaves_without_a_meaning() -> None:
    found = jkroll.answer(["P_c", "yield_force", "r_min"], material="quartz", radius="1 nm", xi="2 nm")
    without = {name for name, result in found.items() if result.value is None}
    assert without == {"yield_force", "r_min"}
    assert without == {name for doubt in found.doubts for name in doubt.ends}
    assert [doubt.code for doubt in found.doubts if doubt.ends] == [
        "xi-over-limit",
        "slides-first",
        "xi-over-contact",
        "bend-below-sphere",
    ]


def test_the_reprs_of_an_answer_and_its_parts_are_one_line() -> None:
    found = jkroll.answer("pull-off", material="quartz", radius="100 nm")
    assert repr(found) == "<Answered: P_c = 11.781 nN, P_DMT = 15.708 nN>"
    assert repr(found["pull_off_force"]) == "<pull_off_force: 11.781 nN>"
    assert repr(jkroll.NOMENCLATURE["pull_off_force"]) == "Quantity('P_c', 'N', 'pull-off force')"
    assert [repr(doubt) for doubt in found.doubts] == [f"<{doubt.code}: {doubt}>" for doubt in found.doubts]
    assert "P_c = 11.8 ± 2.4 nN" in repr(jkroll.answer("pull-off", radius="100 nm", gamma="25±5 mJ/m2"))


def test_a_result_without_a_value_has_a_reason() -> None:
    found = jkroll.answer("report", gamma=0.025, radius=1e-7)
    assert "a = no value, " in repr(found)
    assert found["pull_off_force"].value is not None
    assert found["contact_radius_at_load"].value is None
    assert "Young's modulus" in str(found["contact_radius_at_load"])


def test_answer_refuses_a_missing_radius_a_load_beyond_pull_off_and_an_unknown_question() -> None:
    with pytest.raises(jkroll.JkrollError, match="radius"):
        jkroll.answer("pull-off", material="quartz")
    with pytest.raises(jkroll.JkrollError, match="hardest pull"):
        jkroll.answer("contact", material="quartz", radius=1e-7, load=-1e-6)
    with pytest.raises(jkroll.JkrollError, match="pull-of"):
        jkroll.answer("pull-of", material="quartz", radius=1e-7)


# --- The codes of reasons ---------------------------------------------------------------------------------------------


CAUSES = [cause for cause in (*vars(reasons).values(), *ENDS.values()) if isinstance(cause, reasons.Cause)]
UNSOLVED = unknowns.Unsolved.__subclasses__()


def test_each_reason_has_its_own_code() -> None:
    """Causes that differ only in their explanation share a phrase and a code.

    `guide tables` has all codes except those of limits and that of hidden results.
    """
    phrases = {(cause.phrase or cause.words): cause.code for cause in CAUSES}
    phrases |= {error.phrase: code_of(error.phrase) for error in UNSOLVED}
    assert len({*phrases.values()}) == len(phrases)
    assert all(re.fullmatch("[a-z0-9]+(-[a-z0-9]+)*", code) for code in phrases.values())
    manual = page("tables")
    assert {code for code in phrases.values() if f"`{code}`" not in manual} == {*ENDS, reasons.HIDDEN.code}


@pytest.mark.parametrize(
    ("words", "name", "code"),
    [
        ("contact quartz 100nm --load -50nN", "contact_radius_at_load", "beyond-pull-off"),
        ("contact gold 100nm", "contact_radius", "missing-input"),
        ("contact quartz 100nm --model dmt", "well_energy", "not-in-law"),
        ("contact quartz 100nm --model maugis", "sticking_energy", "needs-atomic-spacing"),
        ("contact 10um --gamma 50mJ/m2 --young 10kPa --poisson 0.49", "stiffness", "contact-exceeds-sphere"),
        ("report quartz 100nm --radius2 plane --quantities mass2,P_c", "mass2", "infinite"),
        ("infer gamma quartz 100nm --measured load=1nN", "surface_energy", "no-dependence"),
        ("infer gamma 100nm --measured contact_radius=1nm", "surface_energy", "missing-input"),
        ("infer xi quartz 100nm --measured n_roll=-1", "yield_displacement", "no-value-gives-it"),
    ],
)
def test_a_result_without_a_value_has_the_code_of_its_reason(run: Run, words: str, name: str, code: str) -> None:
    several = words.replace("100nm", "100nm,200nm").replace("10um", "10um,20um")  # a single pair may be refused
    for answer in json.loads(run(f"{several} --json").out):
        (result,) = [result for result in answer["results"] if result["name"] == name]
        assert (result["value"], result["reason_code"]) == (None, code)
        assert result["reason"]


def test_only_results_without_a_value_have_a_reason_and_its_code() -> None:
    found = jkroll.answer("contact", material="quartz", radius=1e-7, model="dmt")
    assert (found["well_energy"].code, found["contact_radius"].code) == ("not-in-law", "")
    for result in found.as_dict()["results"]:
        assert ("reason" in result) == ("reason_code" in result) == (result["value"] is None)


def test_the_pull_off_forces_of_real_surfaces_are_in_json_and_python(run: Run) -> None:
    """JKR's force is (3/2)π · 50 mJ/m² · 2.5 µm = 589 nN; rough grains hold 1/100 to 1/10 of it."""
    result, *_ = json.loads(run("pull-off quartz 5um --json").out)["results"]
    surfaces = {name: (ends["low"], ends["high"]) for name, ends in result["surfaces"].items()}
    assert [*surfaces] == ["smooth glass, dry air", "smooth glass, humid air", "rough grains, air"]
    assert surfaces["rough grains, air"] == approx((5.89e-9, 58.9e-9), rel=1e-3)
    assert jkroll.answer("pull-off", material="quartz", radius="5 um").surfaces == surfaces
    result, *_ = json.loads(run("pull-off quartz 5um --model dmt --json").out)["results"]
    assert "surfaces" not in result
