"""The command line: output on each stream, exit codes, and complete messages."""

import csv
import io
import json
import math
import os
import re
import shlex
import subprocess
import sys
from fractions import Fraction
from itertools import product
from pathlib import Path

import pytest

from doors import strict_json
from harness import Run
from jkroll import NOMENCLATURE, __version__, solve
from jkroll.cli.commands import COMMANDS
from jkroll.model.limits import UNCHECKED
from jkroll.report.questions import QUESTIONS
from relative import approx
from tools.missing import is_too_long

# --- Complete messages ----------------------------------------------------------------------------------------------

GOLD = "gold has none in Table 1 of D&T; give, for example, --young 10GPa --poisson 0.3"
OR_OF_THE_PAIR = "; --work-of-adhesion 50mJ/m2 may replace --gamma"
GIVE = f"give --gamma 25mJ/m2 and a radius such as 100nm{OR_OF_THE_PAIR}"
REFUSED = {
    "pull-off quarz 100nm": "no material 'quarz'; did you mean quartz? jkroll materials lists all",
    "pull-off quartz 100": "radius: '100' has no unit; expected a length such as 100nm",
    "pull-off quartz -5nm": (
        "'-5nm' begins with a hyphen, as options do; a negative value follows the option that takes it: --load -5nN"
    ),
    "contact quartz 100nm --load -5nN --load=-6nN": "--load is given more than once",
    "batch -1.csv -oout.csv": "'-1.csv': No such file or directory",
    "batch grains.csv --output=": "-o: the name of the output file is empty",
    "pull-off quartz 100nm --to nN,pN": "--to: 'nN' and 'pN' are units of one dimension; give one of them",
    "pull-off quartz plane": "plane is for sphere 2: write --radius2 plane",
    "contact iron 1um --material2 rigid": "rigid is for sphere 2: write --young2 rigid",
    "pull-off": f"pull-off needs radius of sphere 1 and surface energy per surface; {GIVE}",
    "pull-off 100nm --gamma 1J/m2 --work-of-adhesion 1J/m2": (
        "--gamma and --work-of-adhesion exclude each other: one follows from the other"
    ),
    "pull-off quartz 100nm --to foo": "--to: 'foo' has an unknown unit 'foo'; expected a unit such as N",
    "pull-off quartz": "pull-off needs radius of sphere 1; give a radius such as 100nm",
    "pull-off 100nm": (
        "pull-off needs surface energy per surface; name a material, such as quartz, or give --gamma 25mJ/m2"
        f"{OR_OF_THE_PAIR}"
    ),
    "contact quartz 100nm --curve --load=:50nN": (
        "--load: ':50nN' has no lower end; write both, as in -5nN:20nN (an example); pull-off is at -11.781 nN"
    ),
    "pull-off quartz 100nm --temperature 300K": (
        "no such option '--temperature'; no formula depends on it, though γ and E of a material do: jkroll materials"
    ),
    "contact quartz 100nm --humidity 50%": (
        "contact takes no '--humidity'; --humidity is an option of pull-off, report, infer and 2 more"
    ),
    "infer gamma quartz 100nm --measured P_c=9nN --measured P_c=8nN": (
        "infer needs a measured quantity for each input, 1 in all: --measured pull_off_force=300nN; separate several "
        "values of one quantity by commas"
    ),
    "n-roll gold 100nm": f"n-roll needs Young's modulus and Poisson's ratio; {GOLD}",
    "pull-off quartz 100nm --model maugus": "--model: 'maugus' is not one of jkr, maugis, dmt; did you mean maugis?",
    "export ligghts quartz 100nm": (
        "export: which program, lammps, liggghts, dust-collider, dust-simulation? "
        "Write jkroll export liggghts quartz 100nm; jkroll guide dem says what other codes call γ"
    ),
    "pull-off quartz 100nm --model jkr,dmt,jkr": "--model: 'jkr,dmt,jkr' names a law more than once",
    "r-min 1e-170m": "radius: 1e-170 must lie between 1e-30 and 1e30 in SI units",
    "pull-off quartz 1:9": "radius: '1:9' is not a range; write FROM:TO:COUNT, as 1nm:1um:7, and :lin for equal steps",
    "yield-force quartz 100nm --load -1nN:1nN:3:log": (
        "--load: '-1nN:1nN:3:log' has an end that is not positive; leave :log out: the steps are equal then"
    ),
    "pull-off quartz iron 100nm": (
        "two materials, 'quartz' and 'iron'; for a list write quartz,iron; for sphere 2, --material2 iron"
    ),
    "n-roll quartz 100nm --energy 1eV --speed 1m/s": (
        "--energy and --speed exclude each other: one follows from the other"
    ),
    "pull-off quartz 100nm --to nm": "--to: 'nm' fits none of the results, which are in: N",
    "pull-off quartz 100nm --json --csv": "--json and --csv exclude each other",
    "pull-off quartz 100nm --csv -o x.tsv.gz": (
        "-o 'x.tsv.gz' and --csv exclude each other; redirect the output: > FILE"
    ),
    "pull-off quartz 100nm --digits ٣": "--digits: '٣' is not a whole number from 1 to 17",
    "contact quartz 100nm --laod 5nN": "no such option '--laod'; did you mean --load?",
    "pull-off 100nm --surface-tension 25mJ/m2": "no such option '--surface-tension'; did you mean --gamma?",
    "pull-off 100nm -gamma 25mJ/m2": "no such option '-gamma'; did you mean --gamma?",
    "pull-off quartz --R 1nm": "R may be a sphere's radius or the reduced radius: write --radius or --reduced-radius",
    "pull-off --gamma 25mJ/m2 -R 100nm": "no such option '-R'; a radius needs no option: jkroll pull-off quartz 100nm",
    "pull-off quartz 100nm --gamma12 3mJ/m2": (
        "no such option '--gamma12'; the interface energy is part of the work of adhesion: "
        "--work-of-adhesion, γ1 + γ2 - γ12"
    ),
    "pull-off quartz 100nm --diameter 200nm": "a radius and --diameter exclude each other: one follows from the other",
    "contact quartz 100nm --young 54GPa --shear-modulus 23GPa": (
        "--young and --shear-modulus exclude each other: one follows from the other"
    ),
    "pull-off quartz --reduced-radius 50nm --diameter2 2um": (
        "--diameter2 and --reduced-radius exclude each other: one follows from the other"
    ),
    "pull-off quartz --diameter=-1um": "--diameter: '-1um' must be positive; expected a length such as 200nm",
    "contact 100nm --gamma 25mJ/m2 --shear-modulus 23GPa": (
        "contact needs Poisson's ratio; name a material, such as quartz, or give --poisson 0.3"
    ),
    "contact quartz 100nm --shear-modulus rigid": (
        "--shear-modulus: 'rigid' does not begin with a number; expected a pressure such as 30GPa"
    ),
    "pull-off quartz 100nm --quantities=": "'' is not a quantity; jkroll quantities lists them",
    "pull-off --\x1b[31m": "no such option '--?[31m'; see jkroll pull-off --help",
    "--bare pull-off quartz 100nm": (
        "jkroll without a command takes no '--bare'; --bare is an option of pull-off, yield-force, r-min and 11 more"
    ),
    "pul-off quartz 100nm": "no such command 'pul-off'; did you mean pull-off?",
    "map pull-off --x radius=1nm:1um --csv": "map takes no '--csv'; --data FILE writes the numbers as CSV",
    "export lammps quartz 100nm -o x": "export takes no '-o'; it writes to standard output: add > FILE",
    "help pul-off": "no such command 'pul-off'; did you mean pull-off?",
    "sticking-speed quartz 1um": (
        "no such command 'sticking-speed'; did you mean the quantity sticking_speed? "
        "jkroll quantities sticking_speed lists the commands that show it"
    ),
    "materials lead": (
        "no material 'lead'. Give its own numbers, as in jkroll pull-off 100nm --gamma 30mJ/m2 (an example), add "
        "it to a file (jkroll guide materials), or write one that jkroll materials lists"
    ),
}
FAILED = {
    "contact quartz 100nm --young rigid": (
        "both bodies are rigid and have no contact area; --model dmt has their pull-off force"
    ),
    "yield-force quartz 100nm --load -20nN": (
        "--load: -20 nN breaks this contact: the hardest pull that it holds is -11.78 nN by JKR, "
        "-15 nN at most by Maugis' law"
    ),
    "yield-force quartz 100nm --load -11.78098nN": (
        "--load: -11.78098 nN breaks this contact: the hardest pull that it holds is -11.78097 nN by JKR, "
        "-15.00375 nN at most by Maugis' law: --model maugis"
    ),
    "r-min 100nm --radius2 plane": "r_min: sphere 2 is a plane; a chain needs two spheres",
}


@pytest.mark.parametrize("line", [*REFUSED, *FAILED])
def test_a_refused_or_failed_line_has_its_message(run: Run, line: str) -> None:
    code, message = (2, REFUSED[line]) if line in REFUSED else (1, FAILED[line])
    assert run(line) == (code, "", f"jkroll: {message}\n")


# --- Formats --------------------------------------------------------------------------------------------------------


def test_plain_lines_have_a_name_a_value_and_a_unit(run: Run) -> None:
    ran = run("yield-force quartz 100nm")
    lines = [line.split(" ", 2) for line in ran.out.splitlines()]
    assert [line[0] for line in lines] == ["yield_force", "yield_force_ratio", "yield_moment", "yield_angle"]
    assert all(float(line[1]) > 0 for line in lines)
    assert [line[2:] for line in lines] == [["N"], [], ["N m"], ["rad"]]
    assert ran.err.startswith("assumed: ξ = 200 pm (--xi), no load (--load)\n")


def test_option_quiet_leaves_out_notes(run: Run) -> None:
    assert run("yield-force quartz 100nm --quiet").err == ""


# Inputs without which some results of these commands have no value.
NEEDED = {
    "aggregates": ("--monomers", "1000", "--filling-factor", "0.1"),
    "impact": ("--speed", "10m/s", "--viscous-time", "1ps"),
}


@pytest.mark.parametrize("name", QUESTIONS)
def test_json_of_every_command_has_inputs_and_finite_results(run: Run, name: str) -> None:
    ran = run(name, "quartz", "100nm", "--json", *NEEDED.get(name, ()))
    data = json.loads(ran.out)
    assert ran.code == 0
    assert ran.err == ""
    assert set(data) == {"inputs", "results", "validity", "notes", "version"}
    assert data["version"] == __version__
    assert data["inputs"].get("radius") == 1e-7
    for result in data["results"]:
        assert {"name", "symbol", "value", "unit", "equation"} <= set(result)
        assert math.isfinite(result["value"])
        assert result["unit"] == NOMENCLATURE[result["name"]].unit


def test_json_has_best_ranges_in_the_requested_unit(run: Run) -> None:
    words = "pull-off quartz 100nm --json --quiet"
    force, limit = json.loads(run(words).out)["results"]
    in_dyn = json.loads(run(f"{words} --to dyn").out)["results"][0]["best"]
    assert [in_dyn[end] for end in ("low", "high")] == approx([force["best"][end] * 1e5 for end in ("low", "high")])
    assert (in_dyn["by"], in_dyn["why"]) == (force["best"]["by"], force["best"]["why"])
    assert in_dyn["why"]
    assert "best" not in limit  # the force by a limiting law has no best range


def test_an_open_end_of_a_best_range_is_null(run: Run) -> None:
    (bend,) = json.loads(run("r-min 100nm --json").out)["results"]
    assert (bend["best"]["low"], bend["best"]["high"]) == (None, bend["value"])
    results = {one["name"]: one for one in json.loads(run("energies quartz 50nm --json").out)["results"]}
    ends = {name: (results[name]["best"]["low"], results[name]["best"]["high"]) for name in results}
    energy = results["sticking_energy"]["value"]
    assert ends["sticking_energy"] == (energy, 100 * energy)
    speed = results["sticking_speed"]["value"]
    assert ends["sticking_speed"] == (speed, 10 * speed)


def test_several_pairs_are_a_json_array(run: Run) -> None:
    data = json.loads(run("pull-off quartz,iron 100nm 1um --json").out)
    assert [(one["inputs"]["material"], one["inputs"]["radius"]) for one in data] == [
        ("quartz", 1e-7), ("quartz", 1e-6), ("iron", 1e-7), ("iron", 1e-6),
    ]  # fmt: skip


def test_json_gives_the_radius_of_a_plane_as_a_word(run: Run) -> None:
    data = json.loads(run("pull-off quartz 100nm --radius2 plane --json").out)
    assert data["inputs"]["radius2"] == "plane"


def test_option_bare_prints_only_the_headline(run: Run) -> None:
    assert run("n-roll quartz 100nm --bare").out == run("n-roll quartz 100nm").out.split()[1] + "\n"
    assert run("frequencies gold 100nm --bare --digits 3").out == "-\t108000000.0\n"
    assert run("contact quartz 100nm --bare --to nN").code == 2
    assert len(run("pull-off quartz 1nm:1um:50 --bare").out.splitlines()) == 50


def test_option_bare_fails_where_the_headline_has_no_value(run: Run) -> None:
    reason = "jkroll: both bodies are rigid and have no contact area; --model dmt has their pull-off force\n"
    assert run("pull-off quartz 100nm --young rigid --bare --quiet") == (1, "", reason)
    assert run("pull-off quartz 100nm --young rigid,54GPa --bare --quiet") == (
        1,
        "-\n1.1780972450961723e-8\n",
        "jkroll: 1 of 2 rows failed\n",
    )


def test_option_to_sets_the_units_and_option_digits_the_digits(run: Run) -> None:
    assert run("pull-off quartz 100nm --to nN --digits 4 --bare").out == "11.78\n"
    newton, dyn = (float(run(f"pull-off quartz 100nm --to {unit} --bare").out) for unit in ("N", "dyn"))
    assert dyn == float(Fraction(newton) * 100_000)
    assert run("report quartz 100nm --to nN,nm --csv").out.splitlines()[0].count("[nN]") == 2
    assert run("yield-force quartz 100nm --to deg").out.splitlines()[3].endswith(" deg")


def test_spellings_of_a_radius_give_the_same_output(run: Run) -> None:
    outputs = {run("pull-off", "quartz", text, "--bare").out for text in ("100nm", "0.1 µm", "1e-7m", "1000Å")}
    assert outputs | {run("pull-off quartz --R1 100nm --bare").out} == {"1.1780972450961723e-8\n"}


def test_results_that_depend_on_the_load_have_no_value_beyond_pull_off(run: Run) -> None:
    ran = run("report quartz 10nm --load -5nN --json")
    data = json.loads(ran.out)
    assert ran.code == 1
    assert ran.err.startswith(
        "jkroll: --load: -5 nN breaks this contact: the hardest pull that it holds is -1.178 nN by JKR, -1.546"
    )
    values = {result["name"]: result["value"] for result in data["results"]}
    assert values["pull_off_force"] > 0
    assert values["r_min"] > 0
    assert values["yield_force"] is values["n_grav"] is values["vertical_frequency"] is None
    assert data["inputs"]["load"] == -5e-9


def test_option_explain_shows_formula_steps_and_value(run: Run) -> None:
    text = run("n-roll quartz 100nm --explain").out
    for piece in (
        "n = W0/(7π⟨M⟩) = W0/(14π P_c â^(3/2) ξ)",
        "R1 = 100 nm",
        "(quartz, Table 1 of D&T)",
        "(assumed)",
        "result    n_roll = 0.0120702",
        "accuracy",
        "valid",
    ):
        assert piece in text
    on_terminal = run("frequencies quartz 100nm --explain", terminal=True).out
    # A long value moves the formula to the next line.
    assert f" N m/rad\n{' ' * 27}k = M/δ_α = F_aR, which" in on_terminal


def test_a_quantity_without_an_equation_in_the_paper_cites_no_equation(run: Run) -> None:
    words = "report 100nm --young 10GPa --poisson 0.3 --cite --quantities"
    assert "(2), (3)}\n}\n@article{johnson" in run(f"{words} contact_radius,approach --gamma 25mJ/m2").out
    assert run(f"{words} contact_shear_modulus").out.endswith("  doi     = {10.1080/01418619508243800}\n}\n")


@pytest.mark.parametrize(
    ("words", "keys"),
    [
        ("r-min quartz 100nm", ""),
        ("pull-off quartz 100nm", "johnson-kendall-roberts-1971 kendall-1987 vademecum"),
        ("pull-off quartz 100nm --model dmt", "derjaguin-muller-toporov-1975 kendall-1987 vademecum"),
        ("pull-off silica-humid 2um --gamma 10mJ/m2 --model maugis", "maugis-1992 fused-silica"),
        ("infer gamma silica-humid 2um --radius2 plane --measured P_c=300nN", "johnson-kendall-roberts-1971"),
        ("infer gamma silica-humid 2um --measured P_c=300nN --model maugis", "maugis-1992 fused-silica"),
    ],
)
def test_only_the_sources_of_a_result_are_cited(run: Run, words: str, keys: str) -> None:
    cited = re.findall(r"@\w+\{(.*),", run(f"{words} --cite").out)
    assert cited == ["jkroll", "dominik-tielens-1995", *keys.split()]


def test_the_citation_of_the_program_agrees_with_its_licence(run: Run) -> None:
    licence = (Path(__file__).parents[2] / "LICENSE").read_text(encoding="utf-8")
    title, _, rights = licence.split("\n")[:3]
    year, holder = rights.removeprefix("Copyright (c) ").split(" ", 1)
    words = "pull-off quartz,iron 100nm --cite"
    assert run(words).out.count("@misc{jkroll,") == 1
    entry = run(words).out.partition("\n}\n")[0]
    fields = {name: text.rstrip(",") for name, text in re.findall(r"^  (\w+) += \{(.*)\}", entry, re.MULTILINE)}
    assert fields.pop("title")
    assert fields == {
        "author": f"{{{holder}}}",
        "year": year,
        "howpublished": f"Computer program, version {__version__}",
        "note": title.replace("License", "licence"),
    }


@pytest.mark.parametrize(
    "words",
    [
        "report quartz 100±5nm --material2 silica-dry --model maugis",
        "aggregates ice-warm 100nm --monomers 1000",
        "infer gamma quartz 2um --radius2 plane --measured pull_off_force=300±20nN",
        "resistances graphite 10um --shear-strength 12MPa --load -5nN",
        "pull-off quartz,iron 100nm,1um",
    ],
)
def test_a_paragraph_for_methods_cites_the_same_sources_as_option_cite(run: Run, words: str) -> None:
    text = run(f"{words} --cite --tex").out
    keys = {key for keys in re.findall(r"~\\cite\{([^}]*)\}", text) for key in keys.split(",")}
    assert keys == set(re.findall(r"@\w+\{(.*),", run(f"{words} --cite").out))
    # Without ASCII formulas, citations, escaped signs and ties.
    plain = re.sub(r"\$[ -#%-~]*?\$|\\cite\{[^}]*\}|\\[&%_#]|~", "", text)
    assert not re.search(r"[\\&%$#_{}^~⟦⟧]", plain)


def test_a_paragraph_for_methods_has_the_values_used(run: Run, tmp_path: Path) -> None:
    text = run("n-grav quartz 100nm --cite --tex").out
    assert r"Eqs.~(1), (5), (25), (30), (41) of Dominik \& Tielens~\cite{dominik-tielens-1995}" in text
    assert r"spheres in a level chain ($N_{\mathrm{grav}}$). Values used: quartz (material of sphere 1)," in text
    assert r"${\gamma}_{1}$~=~25~mJ/m$^{2}$ (surface energy per surface)~\cite{kendall-1987,vademecum}" in text
    assert r"${\xi}$~=~200~pm (critical rolling displacement; assumed)" in text
    lab = tmp_path / "lab.toml"
    lab.write_text("[materials.'a_b & 5%']\nsurface_energy = '2.5e-5 J/m2'\n", encoding="utf-8")
    text = run("pull-off", "a_b & 5%", "1um", "--materials", str(lab), "--cite", "--tex").out
    assert r"a\_b \& 5\% (material of sphere 1)" in text


def test_option_tex_is_refused_without_option_cite(run: Run) -> None:
    assert run("pull-off quartz 100nm --tex").err == "jkroll: --tex goes with --cite\n"


@pytest.mark.parametrize("name", QUESTIONS)
def test_every_command_explains_and_cites_its_results(run: Run, name: str) -> None:
    for radius2 in ("100nm", "plane"):
        words = [name, "quartz", "100nm", "--radius2", radius2]
        expected = 1 if name in ("r-min", "aggregates") and radius2 == "plane" else 0
        ran = run(*words, "--explain")
        assert ran.code == expected
        assert not any(line.endswith((" ", ",", "Eq")) for line in ran.out.splitlines() if " — " in line)
        assert run(*words, "--cite").code == expected
    assert ("kendall-1987" in run(name, "quartz", "100nm", "--cite").out) is (name != "r-min")


def test_materials_are_listed_in_every_format(run: Run) -> None:
    data = json.loads(run("materials --json").out)
    assert [one["name"] for one in data[:5]] == ["polystyrene", "quartz", "graphite", "gold", "iron"]
    assert data[3]["youngs_modulus"] is None
    assert json.loads(run("materials FE --json").out)["density"] == 7700.0
    assert run("materials gold,iron --csv").out.splitlines()[1] == "gold,0.79,,,19300.0,,crc-handbook,Table 1 of D&T"
    assert run("materials gold").out.splitlines()[1] == "surface_energy 0.79 J/m^2"
    assert run("materials quartz --cite").out.startswith("@article{kendall-1987,")


@pytest.mark.parametrize("columns", [20, 80])
@pytest.mark.parametrize("name", ["pull-off", "contact", "energies", "report", "materials"])
def test_a_terminal_cuts_no_number(run: Run, monkeypatch: pytest.MonkeyPatch, name: str, columns: int) -> None:
    monkeypatch.setenv("COLUMNS", str(columns))
    words = ["materials"] if name == "materials" else [name, "quartz,gold", "100nm", "1um", "--quiet"]
    ran = run(*words, terminal=True)
    assert ran.code == (1 if name == "contact" else 0)  # gold has no Young's modulus
    assert "…" not in ran.out


def test_help_fits_a_screen_and_its_example_works(run: Run) -> None:
    for name in (*QUESTIONS, "materials", "map", "figure"):
        text = run(name, "--help").out
        assert not is_too_long(text), name
        assert max(map(len, text.splitlines())) <= 80
        example = text.rstrip().splitlines()[-1].split("jkroll ")[1]
        assert run(example).code == 0
    assert len(run("--help").out.splitlines()) <= 26
    assert run("--version").out == f"jkroll {__version__}\n"


def test_option_debug_shows_where_an_error_comes_from(run: Run) -> None:
    assert "Traceback" in run("pull-off quartz 100 --debug").err
    assert "Traceback" not in run("pull-off quartz 100").err


def test_a_call_without_words_shows_the_help(run: Run) -> None:
    assert run("").out.startswith("Usage: jkroll")


# --- As a process ---------------------------------------------------------------------------------------------------


def jkroll(*words: str, **options: object) -> "subprocess.CompletedProcess[str]":
    """Run the program as the shell does."""
    return subprocess.run(  # type: ignore[call-overload,no-any-return]
        [sys.executable, "-m", "jkroll", *words],
        capture_output=True,
        text=True,
        check=False,
        encoding="utf-8",
        **options,
    )


# --- Extreme and hostile input --------------------------------------------------------------------------------------


def test_ranges_over_many_orders_of_magnitude_have_exact_values(run: Run) -> None:
    middle = json.loads(run("yield-force quartz 1m --load 1e30N:1e-30N:3 --json").out)[1]
    assert middle["inputs"]["load"] == 1.0
    middle = json.loads(run("pull-off quartz 100nm --radius2 1e-20m:1e30m:3 --json").out)[1]
    assert middle["inputs"]["radius2"] == 1e5
    loads = [one["inputs"]["load"] for one in json.loads(run("yield-force quartz 1um --load -3nN:1nN:5 --json").out)]
    assert loads == [-3e-9, -2e-9, -1e-9, 0.0, 1e-9]
    assert run("pull-off quartz 100nm --z0 1e-30m --json").code == 0  # results are also compared at half this z0


def test_a_unit_that_a_double_cannot_express_is_refused(run: Run) -> None:
    for words in ("pull-off quartz 100nm --to", "pull-off quartz 100nm --json --to"):
        ran = run(*words.split(), "N ym12 Ym-12")
        assert (ran.code, ran.out) == (2, "")
        assert "has a unit outside 1e-100 to 1e100 times the SI unit" in ran.err


@pytest.mark.parametrize(
    "grain", ["ice-cold 1um", "quartz 1um --density 2600±100kg/m3", "quartz 1um --density '2000 to 3000kg/m3'"]
)
def test_the_infinite_mass_of_a_plane_has_no_uncertainty(run: Run, grain: str) -> None:
    words = [*shlex.split(f"report {grain}"), "--radius2", "plane", "--quantities", "mass2,moment_of_inertia2,mass"]
    ran = run(*words, "--json")
    assert ran.code == 0
    *infinite, mass = strict_json(ran.out)["results"]
    for one in infinite:
        assert (one["value"], one["reason"]) == (None, "infinite")
        assert not {"uncertainty", "shares"} & one.keys()
    assert mass["shares"] == {"density": 1.0}
    assert "note: m2, I2: infinite\n" in run(*words).err


@pytest.mark.parametrize("unit", ["dB", "m°C", "Np", "dBm", "oct", "GPas", "degF"])
def test_units_that_are_not_a_plain_factor_are_refused(run: Run, unit: str) -> None:
    ran = run("pull-off", "quartz", f"5{unit}")
    assert ran.code == 2
    assert f"unknown unit '{unit}'" in ran.err


def test_control_characters_in_files_and_arguments_are_not_printed(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text('title = "my\\u001b[31m\\u202e title\\nsecond"\n[materials.ice]\nsurface_energy = "1 J/m2"\n')
    for words in (["contact", "ice", "1um"], ["pull-off", "ice", "1um", "--explain"], ["materials"]):
        ran = run(*words, "--materials", str(path), terminal=True)
        assert "my?[31m? title?second" in " ".join((ran.out + ran.err).split())
        assert "\x1b[31m" not in ran.out + ran.err
    assert run("pull-off", "1nm", "--\u202efoo").err.isascii()
    assert "\t" not in run("yield-force", "quartz", "1nm", "--to", "N\tm").out


@pytest.mark.parametrize(
    ("line", "encoding"),
    [
        *product(
            ["--help", "pull-off quartz 1nm:1um:3 --csv --to µN", "pull-off quartz 100nm --explain"],
            ["cp1252", "latin-1", "ascii", "koi8-r"],
        ),
        ("quantities", "ascii"),
        ("report ice-warm 1um --explain", "ascii"),
    ],
)
def test_no_character_is_lost_in_streams_of_other_encodings(run: Run, line: str, encoding: str) -> None:
    ran = run(line, terminal="--explain" in line, encoding=encoding)
    assert ran.code == 0
    assert "?" not in ran.out + ran.err


@pytest.mark.slow
def test_rows_are_not_held_in_memory() -> None:
    program = (
        "import resource, sys; from jkroll.cli.process import main; code = main(sys.argv[1:]); "
        "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, file=sys.stderr); sys.exit(code)"
    )
    peaks = []
    for size in (10, 2000):
        words = [sys.executable, "-c", program, "pull-off", "quartz", f"1nm:1um:{size}", "--json", "--quiet"]
        peaks.append(int(subprocess.run(words, capture_output=True, text=True, check=True).stderr))
    assert peaks[1] < 1.1 * peaks[0]


def test_option_explain_is_refused_if_python_drops_docstrings() -> None:
    words = [sys.executable, "-OO", "-m", "jkroll", "r-min", "100nm", "--explain"]
    ran = subprocess.run(words, capture_output=True, text=True, check=False)
    assert (ran.returncode, ran.stderr) == (2, "jkroll: --explain is worded from docstrings, which python -OO drops\n")


def test_an_empty_request_for_completion_is_ignored() -> None:
    environment = {**os.environ, "_JKROLL_COMPLETE": ""}
    assert jkroll("r-min", "100nm", env=environment).returncode == 0


# --- States of a contact, and limits of the laws ----------------------------------------------------------------------


def test_an_approach_beyond_the_fold_is_refused(run: Run) -> None:
    ran = run("contact quartz 100nm --approach -0.1nm --bare")
    assert ran.code == 1
    assert ran.err.startswith(
        "jkroll: --approach: at -100 pm the spheres have parted; a stiff machine holds them up to -87.6"
    )


def test_a_curve_has_its_named_states(run: Run) -> None:
    rows = list(csv.DictReader(io.StringIO(run("contact quartz 100nm --curve --csv").out)))
    named = {row["state"]: row for row in rows}
    force = float(run("pull-off quartz 100nm --bare").out)
    approach = float(run("contact quartz 100nm --bare").out.split()[1])
    for state, load, delta in (
        ("fold", -5 / 9, -((3 / 4) ** (2 / 3))),
        ("pull-off", -1, -(2 ** (-4 / 3))),
        ("jump-in", -8 / 9, 0),
        ("equilibrium", 0, 1),
    ):
        assert math.isclose(float(named[state]["load [N]"]) / force, load, abs_tol=1e-14)
        assert math.isclose(float(named[state]["approach_at_load [m]"]) / approach, delta, abs_tol=1e-14)
    assert named["fold"]["stiffness [N/m]"] == ""
    assert named["jump-in"]["approach_at_load [m]"] == "0.0"
    approaches = [float(row["approach_at_load [m]"]) for row in rows]
    fold = approaches.index(min(approaches))
    assert approaches[: fold + 1] == sorted(approaches[: fold + 1], reverse=True)
    assert approaches[fold:] == sorted(approaches[fold:])


@pytest.mark.parametrize(("model", "given"), [("jkr", "load_factor"), ("dmt", "approach_at_load [m]")])
def test_each_row_of_a_curve_has_its_own_value_of_the_input_that_sets_the_state(
    run: Run, model: str, given: str
) -> None:
    words = f"contact quartz 100nm --curve --model {model} --quantities pull_off_force"
    values = [row[given] for row in csv.DictReader(io.StringIO(run(f"{words} --csv").out))]
    assert len({*values}) == len(values) > 40
    objects = json.loads(run(f"{words} --json").out)
    assert [one["inputs"][given.partition(" ")[0]] for one in objects] == [*map(float, values)]


@pytest.mark.parametrize("form", ["--csv", "--json", "--bare"])
def test_a_curve_whose_states_have_no_result_is_refused(run: Run, form: str) -> None:
    """Gold has no modulus: of its states, only the load is known, which is an input and not a result."""
    ran = run("contact", "gold", "1um", "--curve", "--model", "dmt", form)
    assert (ran.code, ran.out) == (2, "")
    assert "contact needs Young's modulus and Poisson's ratio" in ran.err
    several = run("contact", "gold", "1um", "--curve", "--model", "jkr,dmt", "--json")
    assert (several.code, several.err) == (1, "jkroll: 1 of 62 rows failed\n")


@pytest.mark.parametrize(
    "words",
    [
        ("quartz", "100±10nm"),
        pytest.param(("quartz", "90 to 110nm"), marks=pytest.mark.slow),
        pytest.param(("quartz", "90 to 110nm", "--model", "maugis"), marks=pytest.mark.slow),
        pytest.param(
            ("quartz", "1um", "--gamma", "25±5mJ/m2", "--radius2", "plane", "--model", "dmt"), marks=pytest.mark.slow
        ),
        ("quartz", "100nm", "--model", "maugis"),
        ("quartz", "5nm", "--model", "dmt"),
        ("iron", "100nm", "--load=1uN:2uN"),
        ("gold", "1um"),
    ],
)
def test_a_curve_has_the_same_numbers_and_doubts_in_csv_and_in_json(run: Run, words: tuple[str, ...]) -> None:
    rows = list(csv.DictReader(io.StringIO(run("contact", *words, "--curve", "--csv").out)))
    objects = json.loads(run("contact", *words, "--curve", "--json").out)
    assert len(rows) == len(objects)
    is_uncertain = False
    for row, one in zip(rows, objects, strict=True):
        assert row["state"] == one["inputs"]["state"]
        assert {*row["doubt"].split()} - {UNCHECKED} == {limit["code"] for limit in one["validity"]} - {None}
        for result in one["results"]:
            name, bars = result["name"], result.get("uncertainty", {"kind": ""})
            is_uncertain |= bool(bars["kind"])
            found = {"": result["value"]} | {f"_{side}": value for side, value in bars.items() if side != "kind"}
            for side, value in found.items():
                cell = row[f"{name}{side} [{result['unit']}]"]
                assert (float(cell) if cell else None) == value
    assert is_uncertain == any(mark in word for word in words for mark in ("±", " to "))
    assert any(row["doubt"] for row in rows)


def test_every_answer_says_how_far_it_can_be_trusted(run: Run) -> None:
    validity = {one["name"]: one for one in json.loads(run("report quartz 100nm --json").out)["validity"]}
    modulus = 54e9 / (2 * (1 - 0.17**2))
    tabor = (4 * 50e-9 * 0.025**2 / (modulus**2 * 4e-10**3)) ** (1 / 3)
    assert math.isclose(validity["tabor_parameter"]["value"], tabor, rel_tol=1e-12)
    assert not validity["tabor_parameter"]["holds"]
    assert validity["displacement_ratio"]["holds"]
    assert validity["energy_over_yield"]["holds"]
    supplied = "adhesion hysteresis cannot supply this moment; at most 2cRw, c the radius of attraction"
    assert supplied in run("yield-force quartz 6nm --explain").out
    doubts = run("yield-force quartz 3nm").err
    assert "warning: by JKR, ξ is too large for the formula" in doubts
    assert "(ξ/ξ_max = 1.56)" in doubts
    assert "(ξ/ξ_max = 1.56)" in run("yield-force quartz 3nm --quiet").err  # --quiet keeps warnings
    assert run("yield-force quartz 3nm --bare --quiet").err == ""
    assert "the contact slides or peels off before it rolls" in run("yield-force quartz 0.5nm").err
    assert "Q/T_first = 3.8" in run("yield-force quartz 0.5nm --explain").out
    assert (
        "n_roll: a contact that slides freely rolls with 2/7 of the energy, too little to start rolling"
        in run("n-roll quartz 10nm --energy 1e-21J").err
    )
    r_min = json.loads(run("r-min 100nm --json").out)
    assert [one["name"] for one in r_min["validity"] if one["holds"]] == ["r_min_over_radius", "yield_angle"]
    not_checked = "not checked: contact-exceeds-sphere, xi-over-limit, xi-over-contact: need surface energy per surface"
    assert any(note.startswith(not_checked) for note in r_min["notes"])


def test_every_best_range_names_its_rule(run: Run) -> None:
    """The rules are laws that differ, laws within 5 % of each other, scaled measured rolling forces, and unknown ξ."""
    results = json.loads(run("report quartz 100nm --json").out)["results"]
    by = {one["name"]: one["best"]["by"] for one in results if "best" in one}
    expected = {"pull_off_force": "Maugis", "yield_force": "scaled", "r_min": "scaled", "vertical_frequency": "JKR"}
    assert by.items() >= expected.items()
    (force, *_) = json.loads(run("yield-force quartz 6nm --json").out)["results"]
    assert force["best"]["by"] == "ξ unknown"
    assert "  best      " in run("yield-force quartz 6nm --explain").out
    assert "(ξ unknown)" in run("yield-force quartz 6nm --explain").out


def test_explanations_of_pairs_are_separated_by_an_empty_line(run: Run) -> None:
    first, second = "Eq 1\n  P_c", "\n\npull_off_force — "
    text = run("pull-off quartz 100nm,1um --explain").out
    assert text.count(first) == 2
    assert text.count(second) == 1
    assert not text.endswith("\n\n")


# --- Notes, lists and inputs as the user sees them --------------------------------------------------------------------


def test_a_note_says_that_only_fixed_grips_hold_a_state_beyond_pull_off(run: Run) -> None:
    assert "only fixed grips hold this state" in run("n-grav quartz 100nm --approach -0.06nm").err


def test_two_spheres_of_one_material_are_identical(run: Run) -> None:
    alone = run("frequencies quartz 100nm --bare --quiet").out
    assert run("frequencies quartz 100nm --material2 quartz --bare --quiet").out == alone
    assert "mixing rule" not in run("pull-off iron 100nm --material2 FE").err


def test_notes_are_few_and_count_their_rows(run: Run) -> None:
    for name in QUESTIONS:
        lines = run(f"{name} quartz 0.5nm").err.splitlines()
        assert len(lines) <= 5, name
        of_notes = [line for line in lines if not line.startswith("warning: ")]
        assert max(map(len, of_notes)) <= 160, name  # at most two lines
    doubts, last = run("pull-off quartz 0.5nm 1nm 5um").err.splitlines()
    assert doubts.startswith("note: doubts in 3 of 3 rows (jkroll guide doubts; best ranges: --best): ")
    assert all(word in doubts for word in ("few-atoms 2", "more"))
    assert last == "more: --explain"


def test_a_sweep_is_one_table_with_units_in_its_header(run: Run) -> None:
    lines = run("yield-force quartz,iron 100nm", terminal=True).out.splitlines()
    assert lines[0].startswith("2 pairs, ")
    table = next(index for index, line in enumerate(lines) if "quartz" in line)
    assert lines[table].split() == ["material", "quartz", "iron"]
    assert lines[1].startswith("assumed: ξ = 200 pm (--xi), no load (--load)")
    assert lines[table + 2].startswith("γ [mJ/m²] ")
    assert any("M [1e-18 N m]" in line for line in lines)
    wide = run("pull-off iron 1nm 1m --quiet", terminal=True).out
    assert re.search(r"^R1 \[nm\] .*^ *1 .* 14\.14 .*^ *1e9 .* 1\.414e10 ", wide, re.MULTILINE | re.DOTALL)


def test_inputs_are_shown_as_typed(run: Run) -> None:
    typed = "yield-force 0.1um --gamma 0.025J/m2 --xi 2angstrom --young 5e10Pa --poisson .17 --load=-500pN"
    head = " ".join(run(typed, terminal=True).out.partition("\nquantity ")[0].split())
    assert head.startswith("R1 = R2 = 0.1 µm, γ = 0.025 J/m² per surface, E = 5e10 Pa, ν = .17, ξ = 2 Å, P = -500 pN ")
    uncertain = run("pull-off 100nm±5% --gamma 25+/-5mJ/m2", terminal=True).out
    assert "R1 = R2 = 100 nm ± 5 %, γ = 25 ± 5 mJ/m² per surface" in uncertain
    measured = run("infer gamma quartz 1um --measured P_c=100(5)nN", terminal=True).out
    assert "P_c = 100(5) nN" in measured
    assert "γ = 0.025 J/m²" in run("pull-off 100nm 1um --gamma 0.025J/m2", terminal=True).out


def test_the_assumptions_above_a_list_give_no_value_that_differs_between_rows(run: Run) -> None:
    of_two = run("pull-off quartz,iron 100nm --material2 gold", terminal=True, together=True).out
    assert "sphere 2: gold (γ2 = 790 mJ/m²), R1 = R2 = 100 nm\nassumed: w = 2√(γ1γ2) (--work-of-adhesion)\n" in of_two
    assert of_two.count("assumed") == 1


def test_a_number_with_few_digits_has_no_exponent(run: Run) -> None:
    assert "ρ = 2600 kg/m³" in run("n-grav quartz 100nm --digits 2", terminal=True).out


def test_a_rigid_body_needs_no_poisson_ratio(run: Run) -> None:
    rigid = "contact 100nm --gamma 25mJ/m2 --young rigid --young2 1GPa --poisson2 0.3"
    assert run(rigid, terminal=True).out.startswith(
        "R1 = R2 = 100 nm, γ = 25 mJ/m² per surface, E1 = rigid, E2 = 1 GPa, ν2 = 0.3"
    )
    assert run(f"{rigid} --bare").out == run(f"{rigid} --poisson 0.4 --bare").out
    assert run("contact 100nm --gamma 25mJ/m2 --young rigid --young2 1GPa").code == 2


def test_a_command_in_option_quantities_adds_no_inputs(run: Run) -> None:
    shown = json.loads(run("report quartz 100nm --load 1nN --quantities pull-off,contact --json").out)["results"]
    names = [result["name"] for result in shown]
    assert names[0] == "pull_off_force"
    assert "approach_at_load" in names
    assert "load" not in names


def test_report_map_and_infer_take_every_input_for_which_a_note_may_ask(run: Run) -> None:
    """`report`, `map` and `infer` take the inputs of every quantity."""
    ran = run("report quartz 100nm --quantities E_roll --angle 90deg --bare --quiet")
    assert float(ran.out) == solve("roll_energy", material="quartz", radius=1e-7, rolling_angle=math.pi / 2)
    assert run("map E_roll quartz --x radius=1nm:1um:3 --angle 90deg --data -").code == 0
    assert run("infer xi quartz 100nm --measured E_roll=15aJ --angle 90deg").code == 0
    takers = COMMANDS["report"].flags()
    for name in QUESTIONS:
        assert {option.name for option in COMMANDS[name].options() if option.name in NOMENCLATURE} <= {
            option.name for option in takers.values()
        }


@pytest.mark.parametrize("radius", ["5nm", "100nm", "10um"])
@pytest.mark.parametrize(
    ("model", "sets", "result"), [("jkr", "load", "δ"), ("maugis", "load", "δ"), ("dmt", "approach", "P")]
)
def test_a_stable_state_of_a_curve_has_the_doubts_of_a_single_contact(
    run: Run, model: str, sets: str, result: str, radius: str
) -> None:
    """A state has the doubts of the contact at its load; a state of DMT has those at its approach."""
    words = f"quartz {radius} --model {model} --csv"
    rows = [*csv.DictReader(run(f"contact {words} --curve").out.splitlines())]
    name, unit = {"load": ("load [N]", "N"), "approach": ("approach_at_load [m]", "m")}[sets]
    stable = [row for row in rows if row["state"] == "stable"]
    for row in stable[1::16]:
        state = f"--{sets}={row[name]}{unit} --quantities {result},contact_radius_at_load,stiffness"
        (single,) = csv.DictReader(run(f"contact {words} {state}").out.splitlines())
        assert row["doubt"] == single["doubt"]


def test_states_beyond_pull_off_have_no_counterpart_under_another_law(run: Run) -> None:
    rules: dict[str, set[str]] = {}
    for answer in json.loads(run("contact quartz 10um --curve --json").out):
        (best,) = (one.get("best") for one in answer["results"] if one["name"] == "stiffness")
        if best is not None:
            rules.setdefault(answer["inputs"]["state"], set()).add(best["by"])
    assert rules["stable"] == {"Maugis", "JKR"}
    assert rules["fixed grips"] == rules["unstable"] == {"JKR only"}


@pytest.mark.slow
def test_the_notes_on_a_curve_are_those_on_its_pull_off_force(run: Run) -> None:
    inexact = "note: best range of P_c: 14–15 nN"
    assert run("pull-off quartz 100nm").err.splitlines()[0].startswith(f"{inexact} (Maugis)")
    for options in ("--csv", "--bare", "-o curve.csv", "-o curve.svg", "--panel force"):
        lines = run(f"contact quartz 100nm --curve {options}").err.splitlines()
        assert any(line.startswith(inexact) for line in lines), options
    assert inexact not in run("contact quartz 100nm --curve --model jkr,maugis -o curve.svg").err
    listed = run("contact quartz 100nm,10um --curve --csv")
    assert any("law-off-25%" in row["doubt"] for row in csv.DictReader(listed.out.splitlines()))


@pytest.mark.parametrize(
    "line", ["pull-off gold 100nm", "pull-off gold,iron 100nm --material2 gold", "r-min 100nm gold"]
)
def test_a_known_material_outranks_a_file_of_the_same_name(run: Run, line: str) -> None:
    expected = run(line)
    for name in ("gold", "iron", "100nm"):
        Path(name).touch()
    assert run(line) == expected
    assert expected.code == 0
    inferred = run("infer gamma gold 100nm --measured pull_off_force=3nN --bare").out
    assert float(inferred) == approx(3e-9 / (3 * math.pi * 0.5e-7))  # P_c = 3πγR with the reduced radius


@pytest.mark.parametrize("name", ["grains.csv", "./grains.csv", "x\x1b[31m.csv"])
def test_a_file_in_place_of_a_material_is_reported_as_a_file(run: Run, name: str) -> None:
    """The message names the file with its control characters replaced."""
    Path(name).touch()
    safe = name.replace("\x1b", "?")
    assert run("pull-off", name, "100nm").err == f"jkroll: '{safe}' is a file; jkroll batch {safe} reads tables\n"
    assert f"jkroll batch {safe} --infer" in run("infer", "gamma", name, "--measured", "pull_off_force=3nN").err


@pytest.mark.parametrize("gap", ["\x0b", "\x1c", "\x85", "\u2028", "\u00a0"])
def test_an_unusual_blank_in_a_value_is_shown_as_a_space(run: Run, gap: str) -> None:
    head = run("pull-off", "quartz", f"100{gap}nm", terminal=True).out.partition("\n")[0]
    assert head == "quartz (γ = 25 mJ/m² per surface), R1 = R2 = 100 nm"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("pull-off olivine 100nm", "no material 'olivine'. Give its own numbers"),  # and not "did you mean tholin?"
        ("pull-off water-ice 100nm", "'water-ice' names several materials; write ice-warm"),
        ("pull-off quartz nan", "radius: 'nan'"),
        ("infer gamma2 quartz 100nm --measured P_c=10nN", "only inputs of sphere 1, or w of the pair, can be inferred"),
        ("infer gamma quartz 100nm --measured P_c=300,320,290nN", "a list has units"),
    ],
)
def test_a_refusal_names_what_can_be_written_instead(run: Run, words: str, said: str) -> None:
    ran = run(words)
    assert (ran.code, said in ran.err) == (2, True)


def test_the_error_for_a_material_at_the_root_of_a_file_shows_its_table(run: Run) -> None:
    Path("mine.toml").write_text('[enstatite]\nsurface_energy = "100 mJ/m2"\n', encoding="utf-8")
    assert "a table such as [materials.enstatite]" in run("pull-off enstatite 100nm --materials mine.toml").err
