"""What measured forces mean in place of the assumed yield displacement, and hysteresis of adhesion as a part of w."""

import json
import random
from math import pi, sqrt
from typing import Any

import pytest
from jkroll.model.alternatives import FORCES, ROLLED, at_least_measured, at_most_measured, is_like_rolled, rolled_solid

from frames import doubts
from harness import Run
from jkroll.answers.answer import Answer
from jkroll.answers.notes import about_displacement
from jkroll.answers.questions import question_about
from jkroll.materials.library import known_materials
from jkroll.model.frame import Frame
from jkroll.model.limits import ASSUMED_DISPLACEMENT
from jkroll.quantities.values import ends_of, value_of
from relative import approx
from tools.measurements import MEASUREMENTS

SIZES = (1e-7, 3e-6)


def of(material: str, radius: Any, **given: Any) -> Frame:
    return Frame({"radius": radius, **given}, known_materials()[material])


def test_the_forces_are_those_that_are_compared() -> None:
    rows = [row for row in MEASUREMENTS if row.quantity == "yield_force" and row.solids == "SiO2"]
    assert {row.given["radius"] for row in rows} == {"0.95 um"}
    found = [value_of(row.measured, "yield_force") for row in rows]
    middles = [one if isinstance(one, float) else one.value for one in found]
    assert approx((min(middles), max(middles))) == FORCES


def ends(scene: Frame, name: str) -> tuple[float, float]:
    """Return the ends of a range by measured forces."""
    return ends_of(Answer(question_about(name), scene).others["data"][name])


@pytest.mark.parametrize("model", ["jkr", "maugis"])
@pytest.mark.parametrize("material", ["quartz", "silica-humid"])
def test_at_the_spheres_that_were_rolled_stand_their_forces(material: str, model: str) -> None:
    """With any γ: a displacement follows from the force and from γ, so that the force has no error bar from γ."""
    scene = of(material, ROLLED["radius"]).replace(model=model)
    assert rolled_solid(scene) == "SiO2"
    assert ends(scene, "yield_force") == approx(FORCES)
    assert ends(
        of("quartz", ROLLED["radius"], surface_energy=value_of("22±3 mJ/m2", "surface_energy")), "yield_force"
    ) == approx(FORCES)


def test_the_displacement_is_that_of_the_force() -> None:
    scene = of("quartz", ROLLED["radius"])
    found = [end(scene)["yield_displacement"] for end in (at_least_measured, at_most_measured)]
    assert found == approx([force / (6 * pi * 0.025) for force in FORCES])


@pytest.mark.parametrize("model", ["jkr", "maugis"])
def test_each_quantity_follows_by_its_own_power(model: str) -> None:
    scene = of("quartz", 3e-7).replace(model=model)
    low, high = (end(scene)["yield_displacement"] / 2e-10 for end in (at_least_measured, at_most_measured))
    powers = {"yield_force": 1.0, "n_grav": 0.5, "r_min": -1.0, "n_roll": -1.0}
    for name, power in powers.items():
        assert ends(scene, name) == approx(sorted(scene[name] * end**power for end in (low, high)))
    assert "pull_off_force" not in Answer(question_about("pull_off_force,yield_force"), scene).others["data"]


def test_between_two_scalings(run: Run) -> None:
    random.seed(1)
    here = [end(of("quartz", ROLLED["radius"]))["yield_displacement"] for end in (at_least_measured, at_most_measured)]
    for _ in range(20):
        radius = random.uniform(*SIZES)
        scene = of("quartz", radius)
        ratios = [radius / ROLLED["radius"], (radius / ROLLED["radius"]) ** (2 / 3)]
        assert at_least_measured(scene)["yield_displacement"] == approx(here[0] * min(ratios))
        assert at_most_measured(scene)["yield_displacement"] == approx(here[1] * max(ratios))
    radii = [value_of(text, "radius") for text in ("0.1 to 1 um", "0.1um", "1um")]
    wide, *both = (ends(of("quartz", radius), "yield_force") for radius in radii)
    assert wide == approx((both[0][0], both[1][1]))
    assert "P_c = 7.3–72 nN by" in run("pull-off", "quartz", "50 to 500nm").err


def test_a_sphere_on_a_plane_counts_by_the_reduced_radius() -> None:
    on_plane, pair = of("quartz", 2e-7, radius2=float("inf")), of("quartz", 4e-7)
    assert at_most_measured(on_plane)["yield_displacement"] == approx(at_most_measured(pair)["yield_displacement"])


def test_polystyrene_has_its_own() -> None:
    scene = of("polystyrene", 5e-6, radius2=float("inf"))
    assert rolled_solid(scene) == "polystyrene"
    assert ends(scene, "yield_force") == approx([scene["yield_force"] * 42e-9 / 2e-10] * 2)


@pytest.mark.parametrize(
    ("material", "radius", "given"),
    [
        ("quartz", 5e-8, {}),  # small spheres
        ("quartz", 4e-6, {}),
        ("ice-warm", 1e-6, {}),  # whose γ was scaled from rolling forces
        ("silica-dry", 1e-6, {}),  # whose γ is not that of the spheres that were rolled
        ("quartz", 1e-6, {"surface_energy": 0.05}),
        ("quartz", 1e-6, {"work_of_adhesion": 0.1}),
        ("quartz", 1e-6, {"yield_displacement": 2e-10}),
        ("quartz", 1e-6, {"hysteresis_fraction": 0.4}),
    ],
)
def test_where_nothing_of_the_solid_was_measured(material: str, radius: float, given: dict[str, float]) -> None:
    assert not is_like_rolled(of(material, radius, **given))


def words(scene: Frame, *names: str) -> str:
    found = [doubt for doubt in doubts(scene, names, [ASSUMED_DISPLACEMENT]) if doubt.is_exceeded]
    return Answer(question_about(",".join(names)), scene).about(found[0]) if found else about_displacement(scene, "")


def test_words() -> None:
    assert words(of("quartz", ROLLED["radius"]), "yield_force") == (
        "Q = 850–1200 pN by forces on SiO2 of 1 µm; adhesion alone gives Q = 900 pN at most; ξ is assumed (--xi)"
    )
    assert words(of("quartz", ROLLED["radius"]), "r_min").endswith("gives R_min = 480 µm at least; ξ is assumed (--xi)")
    scaled = words(of("quartz", 1e-7), "yield_force")
    assert "Q = 89–270 pN by forces on SiO2 of 1 µm (850–1200 pN), scaled to this size" in scaled
    assert words(of("ice-warm", 1e-6), "r_min") == "ξ is assumed (--xi): no ξ of ice-warm was measured"
    for radius in (5e-8, 1e-5):
        assert words(of("quartz", radius), "r_min") == (
            "ξ is assumed (--xi): no ξ of quartz was measured at this size and γ"
        )
    assert words(Frame({"radius": 1e-7}), "r_min").startswith(
        "ξ is assumed (--xi): forces on SiO2 of 1 µm mean 1.8–2.6 nm"
    )
    assert doubts(of("quartz", 1e-6), ["pull_off_force"], [ASSUMED_DISPLACEMENT]) == []


def test_it_is_said_at_the_prompt_in_explanations_and_in_json(run: Run) -> None:
    lead = "note: Q = 850–1200 pN by forces on SiO2 of 1 µm; adhesion alone gives Q = 900 pN at most"
    assert lead in run("yield-force quartz 0.95um").err
    assert lead in run("yield-force quartz 0.95um --explain").out
    assert "; adhesion alone gives n_roll = 0.0057 at least\n" in run("n-roll quartz 100nm").err
    assert run("yield-force quartz,iron 0.95um --csv").err.count("forces on SiO2 of 1 µm mean 1.8–2.6 nm") == 1
    listed = run("yield-force polystyrene 5um,10um --csv").err
    assert "polystyrene has 42 nm at 5 µm" in listed
    assert "SiO2" not in listed
    inferred = run("infer gamma silica-humid 1um --measured Q=1.2nN").err  # of spheres of 20 to 25 mJ/m²
    assert "no ξ of silica-humid was measured at this size and γ" in inferred
    found = json.loads(run("yield-force quartz 0.95um --json").out)
    (assumed,) = [one for one in found["validity"] if one["name"] == "yield_displacement"]
    assert assumed["text"].startswith(lead.removeprefix("note: "))
    assert assumed["factor"] == approx(FORCES[1] / 94.2478e-12, rel=1e-5)
    assert found["displacement"]["values"]["yield_force"] == approx(FORCES)
    over = found["displacement"]["over_assumed"]["yield_force"]
    assert over == approx([force / 94.2478e-12 for force in FORCES], rel=1e-5)
    assert found["displacement"]["here"] == approx(found["displacement"]["at_pair"])
    assert "displacement" in json.loads(run("yield-force ice-warm 1um --json").out)
    assert "displacement" not in json.loads(run("pull-off quartz 0.95um --json").out)


# --- Hysteresis as a part ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("model", ["jkr", "maugis"])
def test_a_part_of_the_work_of_adhesion(model: str) -> None:
    scene = of("quartz", 1e-6).replace(model=model)
    names = ("yield_moment", "yield_displacement")
    of_part = scene.replace(hysteresis_fraction=0.4).numbers(*names)
    assert of_part == approx(scene.replace(adhesion_hysteresis=0.02).numbers(*names))
    assert scene.replace(yield_displacement=of_part["yield_displacement"])["hysteresis_ratio"] == approx(0.4)


def test_hysteresis_is_an_energy_or_a_part_of_w_and_says_what_it_stands_for(run: Run) -> None:
    energy = run("n-grav quartz 1um --adhesion-hysteresis 20mJ/m2")
    for text in ("--hysteresis-fraction 40%", "--hysteresis-fraction 0.4"):
        part = run(f"n-grav quartz 1um {text}")
        assert part.code == 0
        assert float(part.out.split()[1]) == approx(float(energy.out.split()[1]))
        assert "to roll at ξ = 786.164 pm, 40 % of w must be lost" in run(f"n-grav quartz 1um {text} --explain").out
    said = run("n-grav quartz 1um --xi 0.786164nm --explain").out
    assert "to roll at ξ = 786.164 pm, 40 % of w must be lost where the contact opens and closes" in said
    assert run("n-grav quartz 1um --adhesion-hysteresis 20mJ/m2±10%").code == 0
    assert run("n-grav quartz 1um --adhesion-hysteresis 0.0001lbf/in±20%").code == 0
    assert run("n-grav quartz 1um --hysteresis-fraction 120%").code == 2
    assert run("n-grav quartz 1um --hysteresis-fraction 40% --xi 1nm").code == 2
    assert sqrt(0.4 / 0.1) == approx(
        float(part.out.split()[1]) / float(run("n-grav quartz 1um --hysteresis-fraction 10%").out.split()[1])
    )
