"""Materials: the shipped file, the user's files, and malformed files."""

import copy
import csv
import io
import json
import math
import os
import pickle
import re
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import jkroll
from harness import Run
from jkroll.errors import JkrollError
from jkroll.materials.library import SHIPPED, Material, Materials, MaterialsFileError
from jkroll.model.frame import Frame
from jkroll.model.reasons import MissingInput
from material_files import read
from relative import approx

ICE = """
title = "my measurements"
[materials.ice]
aliases = ["H2O"]
surface_energy = "0.37 J/m2"
density = "1 g/cm3"
"""


def write(path: Path, text: str | bytes) -> Path:
    """Write a file, and create its folder."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return path


def test_a_reference_has_author_title_and_year_or_a_note() -> None:
    references = tomllib.loads(Path(SHIPPED).read_text(encoding="utf-8"))["references"]
    for key, entry in references.items():
        lacking = {"author", "title", "year"} - entry.keys()
        assert not lacking or re.search("not seen|without|neither", entry["note"]), key


def test_the_footnotes_and_references_of_the_paper_are_there() -> None:
    materials = Materials()
    assert "in air" in materials["quartz"].notes["surface_energy"]
    assert "mean of the range" in materials["gold"].notes["surface_energy"]
    assert all(material.references for material in materials.materials.values())
    assert set(materials["gold"].properties) == {"surface_energy", "density"}


def test_there_is_one_copy_of_the_shipped_file() -> None:
    root = Path(__file__).parents[2]
    copies = [path for path in root.rglob("materials.toml") if ".venv" not in path.parts[len(root.parts)]]
    assert copies == [root / "materials.toml"]
    assert Path(SHIPPED).samefile(root / "materials.toml") or "site-packages" in Path(SHIPPED).parts


def test_files_of_option_environment_and_configuration_are_combined(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    option = write(tmp_path / "option.toml", ICE)
    environment = write(tmp_path / "environment.toml", ICE.replace("ice", "frost").replace("H2O", "hoar"))
    write(tmp_path / "configuration/jkroll/materials.toml", ICE.replace("ice", "snow").replace("H2O", "firn"))
    monkeypatch.setenv("JKROLL_MATERIALS", str(environment))
    ran = run("pull-off", "ice,frost,snow,quartz", "1um", "--materials", str(option), "--bare")
    assert ran.code == 0
    values = ran.out.split()
    assert len(values) == 4
    assert values[0] == values[1] == values[2] != values[3]
    assert "overrides" not in ran.err


def test_the_file_of_an_option_overrides_shipped_materials_with_a_note(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    mine = write(tmp_path / "mine.toml", ICE.replace("[materials.ice]", "[materials.Quartz]").replace("H2O", "gold"))
    text = [f"{mine} overrides {word} of Table 1 of D&T" for word in ("gold", "Quartz")]
    said = "".join(f"note: {one}\n" for one in text)
    Path("grains.csv").write_text("material,radius [um]\nquartz,1\n", encoding="utf-8")
    for line in (
        "pull-off quartz 1um --bare",
        "pull-off quartz 1um --csv",
        "pull-off quartz,iron 1um",
        "pull-off quartz 1um --explain",
        "pull-off quartz 1um --json",
        "infer xi quartz 1um --measured yield_force=1nN",
        "batch grains.csv --quantities pull_off_force -o out.csv",
        "materials quartz",
        "export lammps quartz 1um --young 1GPa --poisson 0.3",
        "map pull-off quartz --x radius=1nm:1um",
        "figure 3a --data -",
    ):
        for quiet in ("", "--quiet"):
            ran = run(f"{line} --materials {mine} {quiet}")
            assert ran.code == 0
            assert ran.err.startswith(said)
    force = jkroll.solve("pull_off_force", surface_energy=0.37, radius=1e-6)
    assert float(run(f"pull-off quartz 1um --bare --materials {mine}").out) == force
    monkeypatch.setenv("JKROLL_MATERIALS", str(mine))  # the same file
    assert run(f"pull-off quartz 1um --bare --quiet --materials {mine}").err == said


@pytest.mark.slow
def test_files_of_the_environment_and_the_configuration_change_no_number(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The file of the environment, or of the configuration, only adds materials.

    A name that is also shipped is refused when it is used.
    """
    shipped = Materials()
    words = sorted({*shipped.materials, *shipped.aliases, "ice"})
    before = {word: run("report", word, "1um", "--csv", "--quiet") for word in (*words, "all")}
    entries = ["[materials.Quartz]\naliases = ['mine']", "[materials.opal]\naliases = ['FE', 'silica']"]
    path = write(tmp_path / "own.toml", "".join(f"{entry}\nsurface_energy = '1 J/m2'\n" for entry in entries))
    write(tmp_path / "configuration/jkroll/materials.toml", "[materials.Ice-Warm]\nsurface_energy = '1 J/m2'\n")
    monkeypatch.setenv("JKROLL_MATERIALS", str(path))
    configured = tmp_path / "configuration/jkroll/materials.toml"
    refused = dict.fromkeys(("quartz", "Fe", "silica"), path) | {"ice-warm": configured}
    for word in words:
        after = run("report", word, "1um", "--csv", "--quiet")
        if word in refused:
            (code, out, err), file = after, refused[word]
            assert (code, out) == (2, "")
            assert err.startswith(f"jkroll: material '{word}' is shipped (")
            assert err.endswith(f") and also in {file}; rename it, or pass --materials {file}\n")
        else:
            assert after == before[word]
    assert run("pull-off mine 1um --bare --quiet").out == run("pull-off opal 1um --bare --quiet").out
    rows = run("report all 1um --csv --quiet").out.splitlines()
    assert [row for row in rows if not row.startswith("opal,")] == before["all"].out.splitlines()
    assert run("pull-off opal 1um --bare --quiet").code == 0
    assert run(f"pull-off quartz 1um --bare --quiet --materials {path}").code == 0


def test_a_shipped_name_in_the_environment_is_refused_when_used(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    listed = run("materials --csv")
    path = write(tmp_path / "own.toml", "[materials.quartz]\naliases = ['mine']\ndensity = '1 g/cm3'\n")
    monkeypatch.setenv("JKROLL_MATERIALS", str(path))
    assert run("materials --csv") == listed
    problem = f"material 'quartz' is shipped (Table 1 of D&T) and also in {path}; rename it, or pass --materials {path}"
    assert run("materials quartz") == (2, "", f"jkroll: {problem}\n")


def test_the_environment_overrides_the_configuration_with_a_note(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write(tmp_path / "configuration/jkroll/materials.toml", ICE)
    path = write(tmp_path / "own.toml", ICE.replace("0.37", "0.5").replace("ice", "Ice"))
    monkeypatch.setenv("JKROLL_MATERIALS", str(path))
    ran = run("pull-off ice 1um --bare --quiet")
    assert float(ran.out) == jkroll.solve("pull_off_force", surface_energy=0.5, radius=1e-6)
    assert ran.err == "".join(f"note: {path} overrides {word} of my measurements\n" for word in ("H2O", "Ice"))


def test_the_message_on_a_missing_property_names_the_file(run: Run, tmp_path: Path) -> None:
    path = write(tmp_path / "mine.toml", ICE)
    ran = run("contact", "H2O", "1um", "--materials", str(path))
    assert ran.code == 2
    assert "ice has none in my measurements" in ran.err


RULE = "a name begins with a letter, has no comma and 60 characters at most, and is not all or plane"
BROKEN = {
    "a = ": "is not TOML: Invalid value (at end of document)",
    "[materials.a]\ndensity = true": "a.density is not a text in quotes",
    "[materials.a]\ndensity = 5": "a: density: '5' has no unit; expected a mass density such as 1g/cm3",
    "[materials.a]\ndensity = '-5 g/cm3'": (
        "a: density: '-5 g/cm3' must be positive; expected a mass density such as 1g/cm3"
    ),
    "[materials.a]\npoisson_ratio = 0x" + "f" * 30_000: "a.poisson_ratio has too many digits",
    "[materials.a]\npoisson_ratio = 0x"
    + "f"
    * 300: f"a: poisson_ratio: '{str(16**300 - 1)[:80]}' is longer than 80 characters; expected a number such as 0.3",
    "[materials.a]\ndensity = nan": (
        "a: density: 'nan' does not begin with a number; expected a mass density such as 1g/cm3"
    ),
    "[materials.a]\ndensty = '1 g/cm3'": "'a.densty' is an unknown key; did you mean density?",
    "[materials.a]\ngamma = '25 mJ/m2'": "'a.gamma' is an unknown key; did you mean surface_energy?",
    "[materials]\na = 3": "materials.a is not a table",
    "[material.a]": "'material' is an unknown key; did you mean materials?",
    "[materials.'100nm']": f"'100nm' cannot name a material; {RULE}",
    "[materials.a]\naliases = ['x,y']": f"'x,y' cannot name a material; {RULE}",
    "[materials.a]\naliases = 'x'": "a.aliases is not a list",
    '[materials."a\\u001b[31m"]': f"'a?[31m' cannot name a material; {RULE}",
    '[materials."a\\u202eb"]': f"'a?b' cannot name a material; {RULE}",
    "[materials.a]\nreferences = ['x']": "'a' cites 'x', which is not in [references]",
    "[materials.ice]\n[materials.Ice]": "'Ice' names both 'ice' and 'Ice'; upper and lower case are the same",
    "[materials.'a ']": f"'a ' cannot name a material; {RULE}",
    "[materials.a]\ndensity = { value = '1 g/cm3', methd = 'x' }": (
        "'a.density.methd' is an unknown key; did you mean method?"
    ),
    "[materials.a]\ndensity = { method = 'x' }": "a.density has no value",
    "[materials.a]\ndensity = { value = '1 g/cm3', reference = 'x' }": ("'a' cites 'x', which is not in [references]"),
    "[materials.a]\ndensity = '3.4(9) g/cm3'": (
        "a: density: '3.4(9) g/cm3' can be read as 3.4±0.9 or as 3.4e9; write the one that is meant"
    ),
    "[materials.a]\nnotes = { x = 'y' }": "'a.notes.x' is an unknown key",
    "[materials.a.notes]\ndensity = { note = 'y', radius = '1 um' }": (
        "'a.notes.density.radius' is an unknown key; did you mean radii?"
    ),
    "[materials.a.notes]\ndensity = { radii = '1 to 2 um' }": "a.notes.density has no note",
    "[materials.a.notes]\ndensity = { note = 3 }": "a.notes.density is not a text in quotes",
    "[materials.a.notes]\ndensity = { note = 'y', radii = '1 um' }": (
        "a.notes.density.radii is not a range; write one such as '0.5 to 5 um'"
    ),
    "[materials.a.notes]\ndensity = { note = 'y', radii = '1 to 2 kg' }": (
        "a: radius: '1 to 2 kg' is a mass; expected a length such as 100nm"
    ),
    "title = 3": "title is not a text in quotes",
    b"\xff\xfe": "is not text in UTF-8: save it with this encoding",
    "x = '" + "y" * 200_001 + "'": "is larger than 64 kB",
}


@pytest.mark.parametrize("text", BROKEN, ids=lambda text: repr(text[:30]))
def test_a_mistake_in_a_file_is_reported(run: Run, tmp_path: Path, text: str | bytes) -> None:
    path = write(tmp_path / "broken.toml", text)
    ran = run("materials", "--materials", str(path))
    assert ran.code == 2
    assert not re.search(r"^a\b", ran.out, re.MULTILINE)
    assert ran.err == f"jkroll: materials file '{path}': {BROKEN[text]}\n"


def test_a_mistake_in_one_material_does_not_stop_the_others(run: Run, tmp_path: Path) -> None:
    path = write(
        tmp_path / "mine.toml",
        "[materials.good]\nsurface_energy = '30 mJ/m2'\n[materials.bad]\nsurface_energy = '30 mN'\n",
    )
    (tmp_path / "grains.csv").write_text("material,radius [nm]\ngood,100\nbad,100\n")
    mistake = (
        f"materials file '{path}': bad: surface_energy: '30 mN' is a force; expected a surface energy such as 25mJ/m2"
    )
    options = ("--materials", str(path))
    listed = run("materials", *options)
    assert (listed.code, listed.err) == (2, f"jkroll: {mistake}\n")
    assert "\ngood\t0.03\t" in listed.out
    assert run("pull-off", "good", "100nm", *options).code == 0
    assert run("pull-off", "bad", "100nm", *options).err == f"jkroll: {mistake}\n"
    swept = run("pull-off", "all", "100nm", "--gamma", "25mJ/m2", "--bare", *options)
    assert swept.code == 0
    assert f"note: left out: {mistake}\n" in swept.err
    words = ("--quantities", "pull_off_force", "-o", str(tmp_path / "out.csv"))
    assert run("batch", str(tmp_path / "grains.csv"), *words, *options).code == 1
    assert (tmp_path / "out.csv").read_text(encoding="utf-8").splitlines()[1:] == [
        "good,100,1.4137166941154068e-8,unchecked,",
        "bad,100,,,bad materials file",
    ]


def test_an_alias_may_take_over_the_name_of_a_shipped_material_which_remains(tmp_path: Path) -> None:
    path = write(tmp_path / "mine.toml", "[materials.steel]\naliases = ['iron']\ndensity = '8 g/cm3'\n")
    materials = Materials([path])
    assert materials["iron"].name == "steel"
    assert materials.materials["iron"].properties["density"] == 7700.0


def test_a_material_that_takes_over_a_name_takes_over_its_aliases(tmp_path: Path) -> None:
    path = write(tmp_path / "mine.toml", "[materials.POLYSTYRENE]\ndensity = '1 g/cm3'\n")
    assert jkroll.Materials([path])["PS"].name == jkroll.Materials([path])["polystyrene"].name == "POLYSTYRENE"


def test_a_shared_alias_includes_the_material_that_took_over_a_name(tmp_path: Path) -> None:
    path = write(tmp_path / "mine.toml", "title = 'mine'\n[materials.Silica-humid]\nsurface_energy = '30 mJ/m2'\n")
    materials = Materials([path])
    with pytest.raises(
        JkrollError, match=r"names several materials; write quartz .* or Silica-humid \(30 mJ/m², mine\)"
    ):
        materials["SiO2"]


def test_a_mistake_is_reported_only_when_its_material_is_used(run: Run, tmp_path: Path) -> None:
    path = write(tmp_path / "mine.toml", ICE + "[materials.wood]\naliases = ['oak']\ndensity = '-5 g/cm3'\n")
    words = ("1um", "--materials", str(path), "--bare")
    assert run("pull-off", "ice", *words).code == run("pull-off", "quartz", *words).code == 0
    problem = "wood: density: '-5 g/cm3' must be positive; expected a mass density such as 1g/cm3"
    message = f"jkroll: materials file '{path}': {problem}\n"
    for material in ("wood", "Oak", "ice,wood"):
        assert run("pull-off", material, *words).err == message
    Path("grains.csv").write_text("radius [nm],material\n100,ice\n", encoding="utf-8")
    assert run("batch", "grains.csv", "-o", "out.csv", "--materials", str(path)).code == 0


@settings(max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.binary(max_size=300) | st.text(alphabet="[]materials.a=\"'\n{}1 gcm/,", max_size=200).map(str.encode))
def test_any_content_is_read_or_raises_a_materials_file_error(tmp_path: Path, content: bytes) -> None:
    path = write(tmp_path / "any.toml", content)
    try:
        read(path)
    except MaterialsFileError as error:
        assert "\n" not in str(error)


@pytest.mark.parametrize("made", [str, Path, os.fsencode, lambda path: [path], lambda path: iter([str(path)])])
def test_a_user_s_file_may_be_a_path_or_one_of_several(made: Callable[[Path], Any]) -> None:
    path = write(Path("mine.toml"), ICE)
    assert Materials(made(path))["H2O"].name == "ice"


@pytest.mark.parametrize("paths", [3, None, [3], [["mine.toml"]], {"mine.toml": 1}.values()])
def test_objects_other_than_paths_are_refused(paths: Any) -> None:
    with pytest.raises(MaterialsFileError, match=r"is not a path; write Materials\(\"mine.toml\"\)"):
        Materials(paths)


def test_a_file_may_be_a_pipe(run: Run) -> None:
    reader, writer = os.pipe()
    os.write(writer, ICE.encode())
    os.close(writer)
    assert run(f"pull-off ice 1um --bare --quiet --materials /dev/fd/{reader}").code == 0
    os.close(reader)


@pytest.mark.parametrize("word", [3, None, b"quartz", ("quartz",)])
def test_objects_other_than_names_are_unknown_materials(word: Any) -> None:
    with pytest.raises(JkrollError, match="no material"):
        Materials()[word]


@pytest.mark.parametrize("name", ["quartz", "ice-warm"])
def test_a_material_is_pickled_copied_and_hashed(name: str) -> None:
    material = Materials()[name]
    copies: list[Any] = [pickle.loads(pickle.dumps(material)), copy.copy(material), copy.deepcopy(material)]
    for again in copies:
        assert again == material
        assert {again: name}[material] == name
        with pytest.raises(TypeError):
            again.properties["density"] = 1.0
    known = Materials(write(Path("mine.toml"), ICE))
    assert pickle.loads(pickle.dumps(known)).materials == copy.deepcopy(known).materials == known.materials


def test_properties_set_by_hand_are_checked() -> None:
    mine = Materials()["quartz"]._replace(properties={"surface_energy": 0.05}, uncertainties={})
    assert jkroll.solve("work_of_adhesion", material=mine) == 0.1
    for properties, words in (
        ({"surface_energy": "x"}, "surface_energy: 'x' does not begin with a number"),
        ({"surface_energy": "25±5 mJ/m2"}, "surface_energy: .* is not a single number"),
        ({"surface_energy": None}, "surface_energy: 'None' is not a number"),
        ({"hardness": 1.0}, "'hardness' is not a quantity"),
        ({"load": 1e-9}, "load: '1e-09' is not a property of a material"),
        (3, "material2: .* is not the name of one material"),
    ):
        other: Any = mine._replace(properties=properties)  # type: ignore[arg-type]
        with pytest.raises(JkrollError, match=words):
            jkroll.solve("work_of_adhesion", material=mine, material2=other)


# --- A material's own yield displacement ------------------------------------------------------------------------------

OWN = """
[materials.own]
surface_energy = "25 mJ/m2"
youngs_modulus = "54 GPa"
poisson_ratio = 0.17
density = "2.6 g/cm3"
yield_displacement = { value = "1.8 to 2.6 nm", radius = "0.95 um", method = "rolling forces", reference = "forces" }

[materials.single]
surface_energy = "25 mJ/m2"
yield_displacement = { value = "2 nm", radius = "0.95 um" }

[materials.erring]
surface_energy = "25 mJ/m2"
yield_displacement = { value = "2.2±0.3 nm", radius = "0.95 um" }

[references.forces]
title = "Rolling forces"
"""


@pytest.fixture
def own(tmp_path: Path) -> str:
    """Write a file with materials that have a yield displacement, and return its option."""
    path = tmp_path / "own.toml"
    path.write_text(OWN)
    return f"--materials {path}"


def forces_of(run: Run, words: str) -> tuple[float, float, float]:
    """Return the yield force of a command, with the ends of its range."""
    result = json.loads(run(f"yield-force {words} --json").out)["results"][0]
    uncertainty = result["uncertainty"]
    return result["value"], uncertainty["low"], uncertainty["high"]


def test_a_displacement_is_unchanged_at_the_radius_of_its_measurement(run: Run, own: str) -> None:
    _, low, high = forces_of(run, f"own 0.95um {own}")
    for displacement, force in (("1.8nm", low), ("2.6nm", high)):
        assert float(run(f"yield-force quartz 0.95um --xi {displacement} --quantities Q --bare").out) == approx(force)
    assert json.loads(run(f"yield-force single 0.95um {own} --json").out)["inputs"]["yield_displacement"] == 2e-9
    assert forces_of(run, f"erring 0.95um {own}") == approx(
        [6 * math.pi * 0.025 * one * 1e-9 for one in (2.2, 1.9, 2.5)]
    )


@pytest.mark.parametrize(
    ("radii", "radius", "part"),
    [
        ("100nm", 1e-7, 1 / 2),
        ("5um", 5e-6, 1 / 2),
        ("100nm --radius2 plane", 1e-7, 1),
        ("100nm --radius2 300nm", 1e-7, 3 / 4),
    ],
)
def test_a_displacement_at_another_radius_lies_between_two_scalings(
    run: Run, own: str, radii: str, radius: float, part: float
) -> None:
    scale = 2 * part * radius / 0.95e-6
    powers = scale, scale ** (2 / 3)
    least, most = (12 * math.pi * 0.025 * part * one for one in (1.8e-9 * min(powers), 2.6e-9 * max(powers)))
    assert forces_of(run, f"own {radii} {own}")[1:] == approx((least, most))
    assert "assumed ξ" not in run(f"yield-force own {radii} {own} --explain").out


def test_options_override_a_material_s_displacement(run: Run, own: str) -> None:
    for words in ("--xi 1nm", "--hysteresis-fraction 40%", "--adhesion-hysteresis 20mJ/m2"):
        assert run(f"yield-force own 100nm {words} {own}").out == run(f"yield-force quartz 100nm {words}").out


def test_two_solids_have_no_common_displacement(run: Run, own: str) -> None:
    alone = ("--young2 1GPa", "--gamma2 1mJ/m2 --radius2 plane", "--hamaker 6e-20J --hamaker2 2e-19J")
    pairs = ("--material2 quartz", "--material2 single", *alone)
    for words in ("quartz 100nm --material2 own", *(f"own 100nm {words}" for words in pairs)):
        ran = run(f"yield-force {words} {own}")
        assert (ran.code, ran.out) == (2, "")
        assert "needs critical rolling displacement; give --xi 2angstrom" in ran.err
        assert not run(f"pull-off {words} {own}").code
        assert not run(f"yield-force {words} --xi 1nm {own}").code
    assert forces_of(run, f"own 100nm --material2 own {own}") == forces_of(run, f"own 100nm {own}")
    assert "needs radius of sphere 1" in run(f"yield-force own {own}").err


def test_tables_lists_and_python_use_a_material_s_displacement(run: Run, own: str, tmp_path: Path) -> None:
    names = "yield_force,yield_force_low,yield_force_high"
    table = tmp_path / "grains.csv"
    table.write_text("material,radius [nm]\nown,100\nquartz,100\nown,950\nsingle,30\n")
    assert not run(f"batch {table} --quantities yield_force {own} --quiet -o {tmp_path}/out.csv").code
    rows = [*csv.DictReader(io.StringIO((tmp_path / "out.csv").read_text()))]
    cells = [[row[f"{name} [N]"] for name in names.split(",")] for row in rows]
    assert cells[1][1:] == ["", ""]
    for words, found in (("own 100nm", cells[0]), ("own 950nm", cells[2]), ("single 30nm", cells[3])):
        assert [*map(float, found)] == [*forces_of(run, f"{words} {own}")]
    listed = [*csv.DictReader(io.StringIO(run(f"yield-force own 100nm,950nm {own} --csv --quiet").out))]
    assert [[row[f"{name} [N]"] for name in names.split(",")] for row in listed] == [cells[0], cells[2]]
    path = own.split()[1]
    value, low, high = forces_of(run, f"own 100nm {own}")
    assert jkroll.solve("yield_force", radius=1e-7, material=Materials(path)["own"]) == value
    answered = jkroll.answer("yield_force", radius=1e-7, material="own", materials=Materials(path))["yield_force"]
    assert answered.uncertain is not None
    assert answered.uncertain.sides == {"low": low, "high": high}


def test_a_changed_property_keeps_the_solid_and_its_displacement(own: str) -> None:
    material = Materials(own.split()[1])["single"]
    scene = Frame({"radius": 1e-6}, material, material)
    other = scene.replace(surface_energy=0.1, surface_energy2=0.1)
    assert other["yield_displacement"] == scene["yield_displacement"]
    assert other["work_of_adhesion"] == 0.2
    assert scene.data.keys() - other.data.keys() == {"surface_energy", "surface_energy2"}
    with pytest.raises(MissingInput):
        Frame({"radius": 1e-6, "surface_energy2": 0.1}, material, material)["yield_displacement"]


def test_the_range_of_a_force_covers_an_uncertain_radius_and_the_displacement(run: Run, own: str) -> None:
    """The ends are those of ξ at the middle radius, extended by the change of the force with the radius."""
    ends = [forces_of(run, f"own {radius} {own}") for radius in ("90nm", "100nm", "110nm")]
    (_, low_below, high_below), (_, low, high), (_, low_above, high_above) = ends
    _, least, most = forces_of(run, f"own 100±10nm {own}")
    assert least == approx(low - (low_above - low_below) / 2)
    assert most == approx(high + (high_above - high_below) / 2)
    inferred = run(
        f"infer radius own --measured yield_force={forces_of(run, f'own 110nm {own}')[0]!r}N {own} --bare --quiet"
    ).out
    assert float(inferred) == approx(110e-9)


def test_a_material_s_displacement_is_shown(run: Run, own: str) -> None:
    assert "yield_displacement 1.8 to 2.6 nm, spheres of 950 nm" in run(f"materials own {own}", terminal=True).out
    entry = json.loads(run(f"materials own --json {own}").out)
    assert entry["yield_displacement"] == {"radius": 0.95e-6, "value": 2.2e-9, "low": 1.8e-9, "high": 2.6e-9}
    assert "Rolling forces" in run(f"yield-force own 100nm --cite {own}").out


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ('"2 nm"', "own.yield_displacement has no radius"),
        ('{ value = "2 nm" }', "own.yield_displacement has no radius"),
        ('{ value = "2 nm", radius = "1 to 2 um" }', "the radius of the spheres must be a single value"),
        ('{ value = "2 nm", radius = "-1 um" }', "must be positive"),
        ('{ radius = "1 um" }', "own.yield_displacement has no value"),
        ('{ value = "2 nm", radius = "1 um", size = "x" }', "yield_displacement.size' is an unknown key"),
        ('{ value = "2 N", radius = "1 um" }', "own: yield_displacement: '2 N' is a force"),
    ],
)
def test_a_mistake_in_a_displacement_is_reported(run: Run, tmp_path: Path, text: str, problem: str) -> None:
    path = tmp_path / "own.toml"
    path.write_text(f'[materials.own]\nsurface_energy = "1 mJ/m2"\nyield_displacement = {text}\n')
    ran = run(f"yield-force own 100nm --materials {path}")
    assert ran.code == 2
    assert problem in ran.err


# --- Shipped materials outside the paper ------------------------------------------------------------------------------

# The note of a material without γ gives a similar value, or a measured one of another kind.
NEAR = re.compile(r"[1-9][0-9.]* mJ/m2").search
OUTSIDE_THE_PAPER = [material for material in Materials().materials.values() if material.title != "Table 1 of D&T"]


def test_shipped_materials_form_five_sets() -> None:
    first = [material.name for material in Materials().materials.values() if material.title == "Table 1 of D&T"]
    assert first == ["polystyrene", "quartz", "graphite", "gold", "iron"]
    sets = {material.title for material in OUTSIDE_THE_PAPER}
    assert sets == {"minerals and glasses", "polymers and organics", "metals", "ices"}


@pytest.mark.parametrize("material", OUTSIDE_THE_PAPER, ids=lambda material: material.name)
def test_each_value_of_the_other_sets_has_its_origin(material: Material) -> None:
    """Each material has a state, and each property an origin.

    An origin has a method and a reference; without an uncertainty, the method says so. The origin of γ has a law.
    """
    assert material.state
    keys = {entry["key"] for entry in material.references}
    for name in material.properties:
        origin = material.origins[name]
        assert origin["method"]
        assert origin["reference"] in keys
        assert ("no uncertainty stated" in origin["method"]) == (name not in material.uncertainties)
    if "surface_energy" in material.properties:
        assert material.origins["surface_energy"]["law"]
    else:
        assert NEAR(material.notes["surface_energy"])
    texts = [
        material.state,
        *material.notes.values(),
        *(text for origin in material.origins.values() for text in origin.values()),
    ]
    assert not any(text.endswith("...") for text in texts)


def test_the_error_of_warm_ice_follows_from_its_two_forces() -> None:
    """The rolling forces are 114.8 ± 23.8 for ice and 12.1 ± 3.6 for SiO2, in units of 0.1 nN."""
    share = ((23.8 / 114.8) ** 2 + (3.6 / 12.1) ** 2) ** 0.5
    assert Materials()["ice-warm"].uncertainties["surface_energy"].high == approx(0.19 * (1 + share), rel=1e-3)


def test_a_name_of_several_materials_is_refused_with_their_values(run: Run, tmp_path: Path) -> None:
    of_silica = (
        "quartz (25 mJ/m², in air), "
        "silica-dry (200 mJ/m², amorphous, baked or in vacuum: no water) or "
        "silica-humid (20 to 25 mJ/m², amorphous, in humid air: water adsorbed)"
    )
    for word in ("SiO2", "silica", "SILICA"):
        message = f"'{word}' names several materials; write {of_silica}"
        for line in (
            f"pull-off {word} 1um",
            f"materials {word}",
            f"pull-off iron,{word} 1um",
            f"figure 3a --mark {word}",
        ):
            assert run(line) == (2, "", f"jkroll: {message}\n")
        with pytest.raises(JkrollError) as refused:
            jkroll.solve("pull_off_force", material="iron", material2=word, radius=1e-6)
        assert str(refused.value) == message
    path = write(
        tmp_path / "mine.toml",
        "[materials.ours]\naliases = ['wood']\ndensity = '1 g/cm3'\n[materials.theirs]\naliases = ['Wood']\n",
    )
    with pytest.raises(JkrollError, match="'wood' names several materials; write ours or theirs"):
        Materials(path)["wood"]


def test_a_table_reports_a_shared_name_once(run: Run) -> None:
    rows = "".join(f"{name},{radius}\n" for radius in range(1, 50) for name in ("SiO2", "quartz", "ice"))
    Path("grains.csv").write_text("material,radius [um]\n" + rows, encoding="utf-8")
    ran = run("batch grains.csv --quantities pull_off_force -o out.csv")
    of_names = [line for line in ran.err.splitlines() if "names several materials" in line]
    assert [line.split()[1] for line in of_names] == ["'SiO2'", "'ice'"]
    assert ran.err.splitlines()[-1] == "jkroll: 98 of 147 rows failed; column status has the reasons"
    assert Path("out.csv").read_text(encoding="utf-8").count("unclear material") == 98
    assert "names several materials" not in run("batch grains.csv --quantities pull_off_force -o out.csv --quiet").err


def test_the_list_fits_a_screen_and_shows_the_sets_and_states(run: Run) -> None:
    out = run("materials", terminal=True).out
    lines = out.splitlines()
    assert max(map(len, lines)) <= 80
    assert len(lines) <= 58
    positions = [
        out.index(f"\n{title}") for title in ("Table 1 of D&T", "minerals and glasses", "polymers", "metals", "ices")
    ]
    assert positions == sorted(positions)
    assert re.search(r"ice-warm +190 ± 69 +water ice above about 200 K\s", out)
    assert re.search(r"without γ +– +glass-borosilicate, alumina, calcite,\s", out)
    listed = {material.name for material in Materials().materials.values() if "surface_energy" in material.properties}
    assert {*re.findall(r"^  (\S+) ", out, re.MULTILINE)} == {*listed, "without"}
    rows = {row["material"]: row for row in csv.DictReader(io.StringIO(run("materials --csv").out))}
    assert (rows["quartz"]["source"], rows["quartz"]["state"]) == ("Table 1 of D&T", "")
    assert rows["ice-warm"]["source"] == "ices"


@pytest.mark.parametrize(
    ("words", "names"),
    [
        ("humid", {"silica-humid", "glass-soda-lime-air", "lactose-crystalline", "lactose-amorphous"}),
        ("METALS tungsten", {"tungsten-oxide", "tungsten-clean"}),
        ("spray dried", {"lactose-amorphous"}),
        ("silicone rub", {"pdms"}),
    ],
)
def test_materials_are_found_by_words(run: Run, words: str, names: set[str]) -> None:
    assert {found["name"] for found in json.loads(run(f"materials {words} --json").out)} == names
    table = run(f"materials {words}", terminal=True).out
    assert {name for name in Materials().materials if f"  {name} " in table} == names


def test_a_name_takes_precedence_over_a_search(run: Run) -> None:
    assert json.loads(run("materials silicone rubber --json").out)["name"] == "pdms"
    assert "did you mean quartz?" in run("materials quarz").err
    assert "'steel' names several materials; write steel-304 (20 to 41 mJ/m², stainless, " in run("materials steel").err


def test_no_short_name_means_a_clean_or_cleaved_surface_or_a_guess(run: Run) -> None:
    for material in OUTSIDE_THE_PAPER:
        note = material.notes.get("surface_energy", "")
        if note.startswith(("not for contact", "a guess for contact")):
            for word in material.aliases:
                assert "names several materials" in run("pull-off", word, "1um").err


def test_a_material_without_surface_energy_asks_for_one_and_gives_similar_values(run: Run) -> None:
    ran = run("pull-off alumina 10um")
    assert ran.code == 2
    assert "; alumina: none was found by a force; contact angles on anodic layers give 31 to 49 mJ/m2" in ran.err
    assert "give, for example, --gamma 25mJ/m2" in ran.err
    given = run("pull-off alumina 10um --gamma 50mJ/m2 --bare")
    assert given.code == 0
    assert "none was found" not in given.err
    assert "note            surface energy per surface: none was found" in run("materials alumina", terminal=True).out


CRACKED = (
    "[materials.mine]\nsurface_energy = { value = '30 mJ/m2', method = 'guess' }\n[materials.mine.notes]\n"
    "surface_energy = { note = 'cracked grains stick more', radii = '0.5 to 5 um' }\n"
)


@pytest.mark.parametrize(
    ("words", "is_noted"),
    [
        ("mine 0.49um", False),
        ("mine 0.5um", True),
        ("mine 5um", True),
        ("mine 5.1um", False),
        ("mine --diameter 1um", True),
        ("mine --diameter 11um", False),
        ("mine 1um --gamma 20mJ/m2", False),  # the result does not depend on the material's γ
        ("quartz 1um --material2 mine", True),
        ("quartz 1um --material2 mine --radius2 10um", False),
        ("quartz 1um --material2 mine --radius2 plane", True),
        ("quartz 10um --material2 mine --radius2 plane", False),
        ("mine 1um --radius2 10um", True),
        ("mine 0.1um,1um,10um", True),
        ("mine 0.1um,10um", False),
        ("mine 1nm:1mm:7", True),
        ("mine 1mm:1nm:7", True),
        ("mine 1nm:1mm:4", False),  # its radii include 100 nm and 10 µm, but none in between
        ("mine 1nm:100nm:3", False),
        ("mine 0.1um --radius2 1um,2um", False),
        ("mine --diameter 0.1um,4um", True),
    ],
)
def test_a_note_is_shown_only_for_the_radii_that_it_concerns(
    run: Run, tmp_path: Path, words: str, is_noted: bool
) -> None:
    path = write(tmp_path / "mine.toml", CRACKED)
    has_several_rows = "," in words or ":" in words
    ran = run(f"pull-off {words} --materials {path}{'' if has_several_rows else ' --explain'}")
    out = ran.err if has_several_rows else ran.out
    assert ("γ of mine (R = 0.5 to 5 µm): cracked grains stick more" in out) is is_noted


def test_sheets_maps_and_python_show_a_note_on_some_radii(run: Run, tmp_path: Path) -> None:
    path = write(tmp_path / "mine.toml", CRACKED)
    note = "(R = 0.5 to 5 µm): cracked grains stick more"
    shown = run(f"materials mine --materials {path}", terminal=True).out
    assert f"note surface energy per surface {note}" in " ".join(shown.split())
    found = json.loads(run(f"materials mine --json --materials {path}").out)
    assert found["notes"] == {"surface_energy": "cracked grains stick more"}
    assert found["note_radii"] == {"surface_energy": {"kind": "range", "low": 5e-7, "high": 5e-6}}
    for axis, is_noted in (("1nm:1mm", True), ("1nm:10nm", False)):
        drawn = run(f"map pull-off mine --x radius={axis} --data - --materials {path}")
        assert (note in drawn.err) is is_noted
    for radius, is_noted in (("1um", True), ("10nm", False)):
        found = jkroll.answer("pull_off_force", material="mine", radius=radius, materials=Materials(path))
        assert any(note in each for each in found.notes) is is_noted


def test_a_note_says_that_grains_of_a_micrometre_conflict_with_the_value_of_cold_ice(run: Run) -> None:
    """Grains had radii of 1.5 µm in Gundlach & Blum 2015, and of a millimetre in the source, Musiolik & Wurm 2019."""
    noted = {radius: "in conflict" in run(f"pull-off ice-cold {radius}").err for radius in ("10nm", "1.5um", "1.1mm")}
    assert noted == {"10nm": False, "1.5um": True, "1.1mm": False}


def stiffnesses(upper: str) -> Any:
    """Return a 6 × 6 matrix from its entries other than 0, as in `11=166 12=64`."""
    matrix = numpy.zeros((6, 6))
    for entry in upper.split():
        row, column = int(entry[0]) - 1, int(entry[1]) - 1
        matrix[row, column] = matrix[column, row] = float(entry[3:])
    return matrix


@pytest.mark.parametrize(
    ("name", "entries"),
    {
        # Gammon et al. (1983) at -16 °C; 66 is (11 - 12)/2
        "ice-warm": "11=13.929 22=13.929 33=15.010 12=7.082 13=5.765 23=5.765 44=3.014 55=3.014 66=3.4235",
        "silicon-oxide": "11=166 22=166 33=166 12=64 13=64 23=64 44=80 55=80 66=80",
        "mica": (
            "11=181.0 22=178.4 33=58.6 44=16.5 55=19.5 66=72.0 23=21.2 13=25.6 12=48.8 15=-14.2 25=1.1 35=1.0 46=-5.2"
        ),
    }.items(),
)
def test_moduli_of_crystals_are_their_reuss_and_voigt_averages(name: str, entries: str) -> None:
    """The stiffnesses are those of the sources [GPa]; the averages are in Hill, Proc Phys Soc A 65, 349, 1952."""
    stiff = stiffnesses(entries)
    compliant = numpy.linalg.inv(stiff)
    bulk = {"high": stiff[:3, :3].sum() / 9, "low": 1 / compliant[:3, :3].sum()}
    shear = {
        "high": (1.5 * numpy.trace(stiff[:3, :3]) - 0.5 * stiff[:3, :3].sum() + 3 * numpy.trace(stiff[3:, 3:])) / 15,
        "low": 15
        / (6 * numpy.trace(compliant[:3, :3]) - 2 * compliant[:3, :3].sum() + 3 * numpy.trace(compliant[3:, 3:])),
    }
    found = Materials()[name].uncertainties
    for end, other in (("low", "high"), ("high", "low")):
        modulus = 9 * bulk[end] * shear[end] / (3 * bulk[end] + shear[end])
        assert getattr(found["youngs_modulus"], end) == approx(modulus * 1e9, rel=5e-3)
        ratio = (3 * bulk[end] - 2 * shear[end]) / (6 * bulk[end] + 2 * shear[end])
        assert getattr(found["poisson_ratio"], other) == approx(ratio, rel=5e-3)


def test_derived_surface_energies_follow_from_their_sources() -> None:
    found = {
        name: Materials()[name].uncertainties["surface_energy"] for name in ("mica", "tungsten-oxide", "steel-304")
    }
    mica, tungsten, steel = (found[name].sides for name in found)
    assert [mica["low"], mica["high"]] == approx([force / (3 * math.pi) for force in (1.2, 1.6)], rel=0.03)  # F/R [N/m]
    assert found["tungsten-oxide"].value == approx(37e-20 / (24 * math.pi * 1.65e-10**2), rel=5e-3)
    assert tungsten["minus"] == approx(3.5 / 37 * found["tungsten-oxide"].value, rel=0.01)
    assert steel["low"] == approx(0.042**2 / (4 * 0.022), rel=0.03)  # w² = 4γ1γ2
    assert Materials()["glass"].properties["surface_energy"] == 0.15 / 2


def test_a_material_is_shown_with_all_its_data(run: Run) -> None:
    sheet = run("materials ice-warm", terminal=True).out
    assert "state           water ice above about 200 K\n" in sheet
    assert "surface_energy  190 ± 69 mJ/m²\n  method        critical rolling force" in sheet
    assert "  reference     gundlach-2011\n" in sheet
    assert "surface_energy 0.19 J/m^2\nsurface_energy_minus 0.069 J/m^2\n" in run("materials ice-warm").out
    found = json.loads(run("materials ice-warm --json").out)
    assert found["uncertainties"]["surface_energy"] == {"kind": "standard", "minus": 0.069, "plus": 0.069}
    assert found["uncertainties"]["density"] == {"kind": "range", "low": 917.0, "high": 934.0}
    assert found["origins"]["surface_energy"]["reference"] == "gundlach-2011"
    assert "@article{gundlach-2011,\n" in run("materials ice-warm --cite").out


def test_a_rigid_material_is_rigid_in_every_form(run: Run, tmp_path: Path) -> None:
    (tmp_path / "hard.toml").write_text('[materials.hard]\nyoungs_modulus = "rigid"\n', encoding="utf-8")
    words = f"materials hard --materials {tmp_path / 'hard.toml'}"
    assert json.loads(run(f"{words} --json").out)["youngs_modulus"] == "rigid"
    assert "\nyoungs_modulus rigid\n" in run(words).out
    assert ",rigid," in run(f"{words} --csv").out
    of_several = run(f"materials hard,quartz --materials {tmp_path / 'hard.toml'}", terminal=True)
    assert re.search(r"^hard +– +rigid ", of_several.out, re.MULTILINE)
    assert ">rigid</td>" in Materials(tmp_path / "hard.toml")._repr_html_()


def test_output_to_a_pipe_has_the_sides_and_the_origin_of_each_property(run: Run) -> None:
    lines = dict(line.split(" ", 1) for line in run("materials", "ice-warm").out.splitlines())
    material = Materials().materials["ice-warm"]
    for name, origin in material.origins.items():
        uncertain = material.uncertainties[name]
        sides = [float(text.split()[0]) for key, text in lines.items() if key.startswith(f"{name}_")]
        assert sorted(sides) == sorted(uncertain.sides.values())
        assert {key.partition(".")[2]: text for key, text in lines.items() if key.startswith(f"{name}.")} == origin
