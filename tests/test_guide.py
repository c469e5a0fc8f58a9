"""The manual: commands print the output that its pages show, words find passages, and claims follow from formulas."""

import csv
import io
import re
import shutil
from pathlib import Path

import pytest

from harness import Run
from jkroll import solve
from jkroll.cli.commands import COMMANDS
from jkroll.write.manual import FIELD_TERMS, page, sections, topics
from relative import approx
from transcripts import copied_once, exit_code, failures, printed, rounded, transcripts

FORCE_CURVE = Path(__file__).parent / "data" / "force_curve.csv"
PAGES = {topic: page(topic) for topic in topics()}


@pytest.mark.parametrize(
    ("topic", "block"),
    [(topic, block) for topic, text in PAGES.items() for block in transcripts(text)],
    ids=lambda text: text.splitlines()[0],
)
def test_a_transcript_has_the_output_of_its_commands(topic: str, block: str) -> None:
    assert rounded(block) == rounded(printed(block)), topic


@pytest.mark.parametrize("command", copied_once(*PAGES.values()))
def test_a_command_in_the_text_works(command: str) -> None:
    assert exit_code(command) == 0


def test_python_examples_have_the_shown_output() -> None:
    shutil.copy(FORCE_CURVE, "curve.csv")
    assert failures("\n".join(PAGES.values())) == ""


def test_the_page_commands_has_a_section_for_every_command() -> None:
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


def test_terms_of_the_field_lead_to_existing_sections() -> None:
    assert {(section.page, section.heading) for section in sections()} >= FIELD_TERMS.keys()


ROUGH = "from the page measurements, Rough and humid: jkroll guide measurements\n"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("guide humidity", "**Humid**: water acts in two ways"),
        ("guide humid", "**Humid**: water acts in two ways"),
        ("guide how humid is it?", "**Humid**: water acts in two ways"),
        ("guide meniscus", "The **meniscus** pulls"),
        ("guide menisci", "The **meniscus** pulls"),
        ("guide water", "Roughness and water are often"),
        ("guide capillary", "capillary forces usually dominate"),
        ("quantities capillary", "capillary forces usually dominate"),  # below the line that no quantity matches
    ],
)
def test_words_find_passages_of_their_section(run: Run, words: str, said: str) -> None:
    ran = run(words)
    assert ran.code == 0
    assert said in ran.out.partition(ROUGH)[0]
    assert ran.out.count("\n- ") <= (2 if words.startswith("quantities") else 1)
    assert "twisting_angle" not in ran.out


@pytest.mark.parametrize("words", ["contact angle", "contact angles", "wetting", "surface energy from contact angles"])
def test_words_about_contact_angles_lead_to_their_page(run: Run, words: str) -> None:
    assert "jkroll guide contact-angle\n" in run("guide", *words.split()).out
    assert run("guide contact-angle").out == PAGES["contact-angle"]
    assert "jkroll guide contact-angle" in run("quantities contact angle").out


@pytest.mark.parametrize(
    ("question", "begins", "place"),
    [
        ("fixed grips", "- **Fixed grips**: a stiff machine", "words, Pressed and pulled"),
        ("what does fixed grips mean", "- **Fixed grips**: a stiff machine", "words, Pressed and pulled"),
        ("grip, fixed", "- **Fixed grips**: a stiff machine", "words, Pressed and pulled"),
        ("what is the tabor parameter", "- **Tabor parameter μ**: how far", "words, Adhesion"),
        ("why is xi 2 angstrom", "- **Critical rolling displacement ξ**: how far", "words, Pushed and turned"),
        ("Why is ξ 2 Å?", "- **Critical rolling displacement ξ**: how far", "words, Pushed and turned"),
        ("few atoms", "| code | meaning |\n|---|---|\n| `few-atoms` | contact radius below", "models, Limits"),
        ("plastic deformation", "- Measured sticking speeds are above", "energies, Aggregates"),
        ("mixture", "Several radii, several materials", "tables, Sweeps"),
        ("time step lammps", "- The time step is the shorter of two.", "dem"),
    ],
)
def test_a_question_is_answered_by_a_passage(run: Run, question: str, begins: str, place: str) -> None:
    out = run("guide", *question.split()).out
    assert out.startswith(begins)
    assert f"\nfrom the page {place}: jkroll guide {place.partition(',')[0]}\n" in out


QUESTIONS = ("humidity", "fixed grips", "error bars", "sticking", "ice", "which law holds", "load", "json", "z0")


@pytest.mark.parametrize("question", QUESTIONS)
def test_an_answer_of_the_manual_is_short_and_is_text_of_its_pages(run: Run, question: str) -> None:
    shown = run("guide", *question.split(), terminal=True).out.splitlines()
    assert max(map(len, shown)) <= 80
    assert len(shown) <= 24  # two passages, with the heads and blank lines of tables
    out = run("guide", *question.split()).out
    also = [line for line in out.splitlines() if line.startswith("also: ")]
    assert len(also) <= 1
    assert all(line.count("jkroll guide ") <= 3 for line in also)
    passages = [line for line in out.partition("\nfrom the page ")[0].splitlines() if not line.startswith("|")]
    assert all(any(line.removesuffix(":") in text for text in PAGES.values()) for line in passages)


def test_words_lead_to_pages_sections_quantities_and_materials(run: Run) -> None:
    assert run("guide changes 0.3.0").out.startswith("## 0.3.0\n")
    assert run("guide dem Damping").out.startswith("## Other programs, and damping\n")
    assert run("guide doubts").out.startswith("## Limits\n")
    assert "guide changes" not in run("guide adhesion hysteresis").out
    assert "guide changes" in run("guide changes diameter").out
    assert "displacement_limit" in run("quantities largest xi").out
    assert run("guide what is the tabor parameter").out.splitlines()[-1].endswith("jkroll quantities tabor parameter")
    assert run("guide quartz").out.endswith("jkroll materials quartz\n")
    assert "jkroll materials silica-humid" in run("quantities silica humid").out


def test_an_unknown_word_is_refused_with_a_remedy(run: Run) -> None:
    for command in ("guide", "quantities"):
        refused = run(f"{command} quartz xyzzy")
        assert refused.code == 2
        assert refused.err.startswith("jkroll: nothing has the word 'xyzzy'; leave it out, or jkroll guide lists")
        assert "the word 'humiddity'; did you mean humidity? " in run(f"{command} humiddity").err
    assert run("quantities capillary --json").code == run("quantities capillary --csv").code == 2


def test_matching_quantities_are_ranked_and_at_most_a_dozen_have_rows(run: Run) -> None:
    names = [row["name"] for row in csv.DictReader(io.StringIO(run("quantities force --csv").out))]
    lines = run("quantities force", terminal=True).out.splitlines()
    shown = [line.split()[0] for line in lines[2 : lines.index("")] if not line.startswith(" ")]
    assert shown == names[:12]
    rest = " ".join(lines[lines.index("") + 1 : -1]).split()
    assert " ".join(rest) == f"and {len(names) - 12} more: {', '.join(names[12:])}"
    assert lines[-1] == "in the manual: jkroll guide force"
    assert run("quantities stickiness --csv").out.splitlines()[1].startswith("sticking_speed,")
    assert names.index("yield_force") < names.index("flight_ratio")  # a match of a name precedes a match of a meaning


def test_a_quantity_names_every_command_that_takes_it(run: Run) -> None:
    shown = " ".join(run("quantities load", terminal=True).out.split())
    assert "option --load -5nN " in shown
    assert "default 0 shown by" in shown
    assert "shown by contact taken by yield-force, " in shown
    listed = re.search(r"taken by (.*?) equation", shown)
    assert listed
    takers = listed[1].split(", ")
    for command in ("pull-off", "yield-force", "n-grav", "contact", "impact", "report", "infer", "map", "export"):
        assert (command in takers) is ("--load" in run(f"{command} --help").out or command in {"infer", "map"})


@pytest.mark.parametrize("name", ["tabor", "tabor-parameter", "tabor_parameter"])
def test_a_quantity_is_found_by_name_or_word(run: Run, name: str) -> None:
    assert run("quantities", name).out.startswith("tabor_parameter: ")


def test_a_list_of_quantities_has_every_name_in_every_format(run: Run) -> None:
    import json

    from jkroll import NOMENCLATURE

    assert [entry["name"] for entry in json.loads(run("quantities --json").out)] == [*NOMENCLATURE]
    assert [row["name"] for row in csv.DictReader(io.StringIO(run("quantities --csv").out))] == [*NOMENCLATURE]
    assert [line.split()[0] for line in run("quantities").out.splitlines()[1:]] == [*NOMENCLATURE]
    refused = run("quantities tabour")
    assert refused.code == 2
    assert "the word 'tabour'; did you mean tabor? " in refused.err


@pytest.mark.parametrize("word", ["gamma", "surface_energy", "surface-energy"])
def test_a_quantity_may_be_named_by_its_option_or_with_hyphens(run: Run, word: str) -> None:
    axis = f"{word}=1mJ/m2:1J/m2:3"
    assert run("map", "pull-off", "100nm", "--x", axis, "--data", "-").out.startswith("curve,surface_energy ")
    assert run("pull-off", "quartz", "100nm", "--quantities", "contact-modulus").out.startswith("contact_modulus ")
    refused = run("pull-off", "100nm", "--gamma", "25mJ/m2", "--quantities", word)
    assert refused.err.startswith("jkroll: --quantities: surface_energy is an input here")


def test_the_claims_of_the_page_paper_follow_from_the_formulas() -> None:
    """At the radii in `guide paper`, the formulas give the values of the claims, within their last digit."""
    text = PAGES["paper"]

    def stated(pattern: str) -> list[tuple[str, str]]:
        """Return the numbers in a sentence, each with its material."""
        [found] = re.findall(pattern, text)
        return list(zip(("iron", "graphite", "polystyrene", "quartz"), found.split(", "), strict=True))

    def computed(name: str, material: str, radius: str) -> float:
        return float(solve(name, material=material, radius=radius))

    for pattern, name in ((r"R1 = ([^;|]*) by Eq 49", "n_roll"), (r"7/2 of it, ([^|]*) \|", "n_roll_energy_balance")):
        for material, radius in stated(pattern):
            assert computed(name, material, radius) == approx(1, rel=0.01)
    for material, radius in stated(r"shrinks, up to R1 = ([^|]*) at τ"):
        force, slide = solve(["pull_off_force", "sliding_or_peeling_force"], material=material, radius=radius).values()
        assert slide == approx(force, rel=2e-3)
    # From πa²τ = P_c with 4E*a³/(3R) = P_c(2 + √(4 − E*/(4G*))), in 30 digits.
    slides_up_to = {"iron": 334.748, "graphite": 212.248, "polystyrene": 219.609, "quartz": 7.62934}
    assert dict(stated(r"shrinks, up to R1 = ([^|]*) at τ")) == {
        material: f"{radius:.3g} nm" for material, radius in slides_up_to.items()
    }
    for material, ratio in stated(r"T_peel = ([^|]*) P_c;"):
        force, peel = solve(["pull_off_force", "peeling_force"], material=material, radius=1e-7).values()
        assert peel / force == approx(float(ratio), rel=5e-3)
    for material, radius in stated(r"50 Å at R1 = ([^|]*), and goes"):
        assert computed("contact_radius", material, radius) == approx(5e-9, rel=0.02)
    for material, frequency in stated(r"([.\d, ]*) GHz at R1 = 100 nm"):
        assert computed("vertical_frequency", material, "100nm") == approx(1e9 * float(frequency), rel=0.02)
    ten, hundred = (computed("vertical_frequency", "quartz", radius) for radius in ("10nm", "100nm"))
    assert round(ten / hundred) == 15


def test_claims_about_contact_angles_and_rolling_in_lethe_follow_from_the_formulas() -> None:
    """The claims on `guide contact-angle` and on rolling by DMT in Lethe.

    `both` gives γ of a basic solid by van Oss, Chaudhury & Good, and by Owens & Wendt.
    """

    def both(dispersive: float, acid: float, base: float) -> tuple[float, float]:
        of_diiodomethane, of_water = (dispersive * 50.8) ** 0.5, (dispersive * 21.8) ** 0.5
        root = of_diiodomethane / 50.8**0.5
        other = (of_water + (acid * 25.5) ** 0.5 + (base * 25.5) ** 0.5 - root * 21.8**0.5) / 51.0**0.5
        return 2 * dispersive + 4 * (acid * base) ** 0.5, 2 * (root**2 + other**2)

    assert both(40, 0, 12) == approx((80, 92), rel=5e-3)
    assert both(34, 1, 40) == approx((93, 122), rel=5e-3)
    text = " ".join(PAGES["contact-angle"].split())
    assert re.search(r"it is 80 mJ/m².* Owens and Wendt gives 92\. For 34, 40 and 1 mJ/m², .* give 93 and 122", text)
    for load in (0.0, 5e-9):
        scene = {"material": "quartz", "radius": 1e-7, "load": load, "model": "dmt"}
        moment, force = solve(["yield_moment", "pull_off_force"], **scene).values()
        assert moment == approx(2e-10 * force, rel=1e-12)  # ξ·4πγR at every load
