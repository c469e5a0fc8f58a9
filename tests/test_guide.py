"""The manual: every command in it must print what stands there, and every command of the program has a page."""

import io
import re
import shutil
from pathlib import Path

import pytest

from harness import Run
from jkroll import solve
from jkroll.cli.commands import COMMANDS
from jkroll.output.manual import FIELD_TERMS, page, sections, topics
from relative import approx
from transcripts import copied_once, exit_code, failures, printed, rounded, transcripts

FORCE_CURVE = Path(__file__).parent / "data" / "force_curve.csv"
PAGES = {topic: page(topic) for topic in topics()}


@pytest.mark.parametrize(
    ("topic", "block"),
    [(topic, block) for topic, text in PAGES.items() for block in transcripts(text)],
    ids=lambda text: text.splitlines()[0],
)
def test_transcript(topic: str, block: str) -> None:
    assert rounded(block) == rounded(printed(block)), topic


@pytest.mark.parametrize("command", copied_once(*PAGES.values()))
def test_a_command_in_the_text_works(command: str) -> None:
    assert exit_code(command) == 0


def test_python_examples() -> None:
    shutil.copy(FORCE_CURVE, "curve.csv")
    assert failures("\n".join(PAGES.values())) == ""


def test_every_command_is_shown() -> None:
    assert re.findall(r"^## (\S+)$", PAGES["commands"], re.MULTILINE) == [*COMMANDS]


@pytest.mark.parametrize("topic", PAGES)
def test_a_page_is_markdown_in_a_pipe_and_text_on_a_terminal(run: Run, topic: str) -> None:
    assert run("guide", topic).out == PAGES[topic]
    assert PAGES[topic].startswith("# ")
    of_programs = {line.rstrip() for line in PAGES[topic].splitlines()}
    shown = [line.rstrip() for line in run("guide", topic, terminal=True).out.splitlines()]
    assert all(len(line) <= 80 for line in shown if line not in of_programs)


def test_topics_are_listed_and_guessed(run: Run) -> None:
    assert [line.split()[0] for line in run("guide").out.splitlines()] == [*PAGES]
    refused = run("guide unitts")
    assert refused.code == 2
    assert "did you mean units?" in refused.err


def test_the_terms_of_the_field_belong_to_sections() -> None:
    assert {(section.page, section.heading) for section in sections()} >= FIELD_TERMS.keys()


@pytest.mark.parametrize("command", ["guide", "quantities"])
@pytest.mark.parametrize("words", ["humidity", "contact angle", "roughness", "capillary", "meniscus", "water"])
def test_a_term_of_the_field_finds_its_section(run: Run, command: str, words: str) -> None:
    ran = run(f"{command} {words}")
    assert ran.out.startswith("## Rough and humid\n")
    assert "\nfrom the page measurements: jkroll guide measurements\n" in ran.out
    assert "twisting_angle" not in ran.out


def test_all_words_are_sought_in_manual_quantities_and_materials(run: Run) -> None:
    lines = run("guide restitution").out.splitlines()
    assert "energies      Energies by convention" in lines
    assert "changes" not in run("guide adhesion hysteresis").out
    assert run("guide changes 0.3.0").out.startswith("## 0.3.0\n")
    assert "displacement_limit" in run("guide largest xi").out
    assert run("guide mixture").out.startswith("## Sweeps\n")
    assert run("guide dem Damping").out.startswith("## Other programs, and damping\n")
    assert "\nquantities: tabor_parameter: jkroll quantities tabor\n" in run("guide tabor").out
    assert run("guide quartz").out.endswith("\nmaterials: quartz: jkroll materials quartz\n")
    assert run("quantities stickiness").out.startswith("sticking_speed: ")
    assert "jkroll materials silica-humid" in run("quantities silica humid").out
    assert run("guide quartz xyzzy").code == run("quantities humidity --json").code == 2


@pytest.mark.parametrize("name", ["tabor", "tabor-parameter", "tabor_parameter"])
def test_a_quantity_is_found_by_name_or_word(run: Run, name: str) -> None:
    assert run("quantities", name).out.startswith("tabor_parameter: ")


def test_a_list_of_quantities_has_every_name_in_every_format(run: Run) -> None:
    import csv
    import json

    from jkroll import NOMENCLATURE

    assert [entry["name"] for entry in json.loads(run("quantities --json").out)] == [*NOMENCLATURE]
    assert [row["name"] for row in csv.DictReader(io.StringIO(run("quantities --csv").out))] == [*NOMENCLATURE]
    assert [line.split()[0] for line in run("quantities").out.splitlines()[1:]] == [*NOMENCLATURE]
    refused = run("quantities tabour")
    assert refused.code == 2
    assert "jkroll quantities lists them" in refused.err


@pytest.mark.parametrize("word", ["gamma", "surface_energy", "surface-energy"])
def test_the_word_of_an_option_is_the_name(run: Run, word: str) -> None:
    axis = f"{word}=1mJ/m2:1J/m2:3"
    assert run("map", "pull-off", "100nm", "--x", axis, "--data", "-").out.startswith("curve,surface_energy ")
    assert run("pull-off", "quartz", "100nm", "--quantities", "contact-modulus").out.startswith("contact_modulus ")
    refused = run("pull-off", "100nm", "--gamma", "25mJ/m2", "--quantities", word)
    assert refused.err.startswith("jkroll: --quantities: surface_energy is an input here; leave it out")


def test_claims_of_the_text() -> None:
    """The radii of `guide paper` are those at which the formulas give what the claims have, within their last digit."""
    text = PAGES["paper"]

    def stated(pattern: str) -> list[tuple[str, str]]:
        """Return the numbers that a sentence has, each with its material."""
        [found] = re.findall(pattern, text)
        return list(zip(("iron", "graphite", "polystyrene", "quartz"), found.split(", "), strict=True))

    def near(name: str, material: str, radius: str) -> float:
        return float(solve(name, material=material, radius=radius))

    for pattern, name in ((r"R1 = ([^;|]*) by Eq 49", "n_roll"), (r"7/2 of it, ([^|]*) \|", "n_roll_energy_balance")):
        for material, radius in stated(pattern):
            assert near(name, material, radius) == approx(1, rel=0.01)
    for material, radius in stated(r"shrinks, up to R1 = ([^|]*) at τ"):
        force, slide = solve(["pull_off_force", "sliding_or_peeling_force"], material=material, radius=radius).values()
        assert slide == approx(force, rel=2e-3)
    # By πa²τ = P_c with 4E*a³/(3R) = P_c(2 + √(4 − E*/(4G*))), in 30 digits.
    slides_up_to = {"iron": 334.748, "graphite": 212.248, "polystyrene": 219.609, "quartz": 7.62934}
    assert dict(stated(r"shrinks, up to R1 = ([^|]*) at τ")) == {
        material: f"{radius:.3g} nm" for material, radius in slides_up_to.items()
    }
    for material, ratio in stated(r"T_peel = ([^|]*) P_c;"):
        force, peel = solve(["pull_off_force", "peeling_force"], material=material, radius=1e-7).values()
        assert peel / force == approx(float(ratio), rel=5e-3)
    for material, radius in stated(r"50 Å at R1 = ([^|]*), and goes"):
        assert near("contact_radius", material, radius) == approx(5e-9, rel=0.02)
    for material, frequency in stated(r"([.\d, ]*) GHz at R1 = 100 nm"):
        assert near("vertical_frequency", material, "100nm") == approx(1e9 * float(frequency), rel=0.02)
    ten, hundred = (near("vertical_frequency", "quartz", radius) for radius in ("10nm", "100nm"))
    assert round(ten / hundred) == 15
