"""What the assumed yield displacement is worth, and hysteresis of adhesion as a part of the work of adhesion."""

import json
import random
from math import log, pi, sqrt

import pytest

from harness import Run
from jkroll.answers.displacement import FORCES, PAIR, SCALED, worth
from jkroll.answers.results import Note
from jkroll.materials.library import known_materials
from jkroll.quantities.values import value_of
from jkroll.scene.scene import Scene
from relative import approx
from tools.measurements import MEASUREMENTS


def of(material: str, radius: float, **given: float) -> Scene:
    return Scene({"radius": radius, **given}, known_materials()[material])


def test_the_forces_are_those_that_are_compared() -> None:
    rows = [row for row in MEASUREMENTS if row.quantity == "yield_force" and row.solids == "SiO2"]
    assert {row.given["radius"] for row in rows} == {"0.95 um"}
    found = [value_of(row.measured, "yield_force") for row in rows]
    middles = [one if isinstance(one, float) else one.value for one in found]
    assert approx((min(middles), max(middles))) == FORCES


def test_at_the_pairs_that_were_measured_the_displacement_gives_their_forces() -> None:
    for material in ("quartz", "silica-dry", "silica-humid"):
        scene = of(material, PAIR["radius"])
        found = worth(scene, ["yield_force"])
        assert found is not None
        assert found.here is not None
        assert found.here == approx([force / (6 * pi * scene["surface_energy"]) for force in FORCES])
        assert [ratio * scene["yield_force"] for ratio in found.factors["yield_force"]] == approx(FORCES)


def test_another_solid_takes_over_the_displacement_and_not_the_force() -> None:
    found = worth(of("ice-warm", PAIR["radius"]), ["yield_force"])
    assert found is not None
    assert found.at_pair == approx([force / (6 * pi * PAIR["surface_energy"]) for force in FORCES])


@pytest.mark.parametrize("model", ["jkr", "maugis"])
def test_each_quantity_follows_by_its_own_power(model: str) -> None:
    names = ["yield_force", "n_grav", "r_min", "n_roll", "pull_off_force"]
    scene = of("quartz", 3e-7).replace(model=model)
    found = worth(scene, names)
    assert found is not None
    assert found.here is not None
    low, high = (end / 2e-10 for end in found.here)
    powers = {"yield_force": 1.0, "n_grav": 0.5, "r_min": -1.0, "n_roll": -1.0}
    assert found.factors == {name: approx((low**power, high**power)) for name, power in powers.items()}


def test_between_two_scalings() -> None:
    random.seed(1)
    for _ in range(20):
        radius = random.uniform(*SCALED)
        found = worth(of("quartz", radius), ["yield_force"])
        assert found is not None
        assert found.here is not None
        one, other = radius / PAIR["radius"], (radius / PAIR["radius"]) ** (2 / 3)
        assert found.here[0] == approx(found.at_pair[0] * min(one, other))
        assert found.here[1] == approx(found.at_pair[1] * max(one, other))
        assert found.size == approx(max(abs(log(ratio)) for ratio in found.factors["yield_force"]))


def test_a_sphere_on_a_plane_counts_by_the_reduced_radius() -> None:
    on_plane = worth(of("quartz", 2e-7, radius2=float("inf")), ["yield_force"])
    pair = worth(of("quartz", 4e-7), ["yield_force"])
    assert on_plane is not None
    assert pair is not None
    assert on_plane.here == approx(pair.here)


def test_where_nothing_is_said_of_it() -> None:
    assert worth(of("quartz", 5e-8), ["yield_force"]) is None  # small spheres
    assert worth(of("quartz", 1e-6), ["pull_off_force", "yield_displacement"]) is None
    assert worth(of("quartz", 1e-6, yield_displacement=2e-10), ["yield_force"]) is None
    assert worth(of("quartz", 1e-6, hysteresis_fraction=0.4), ["yield_force"]) is None
    above = worth(of("quartz", 4e-6), ["yield_force"])
    assert above is not None
    assert above.here is None


def words(scene: Scene, *names: str) -> Note:
    found = worth(scene, names)
    assert found is not None
    return found.note(names)


def test_words() -> None:
    large = words(of("quartz", 0.95e-6), "yield_force", "r_min", "n_grav")
    assert large.text == (
        "ξ = 200 pm (--xi) is the paper's; forces on SiO2 of 1 µm mean 1.8–2.6 nm: Q × 9–13, R_min / 9–13, N_grav × 3–3.6"
    )
    assert large.kind == "displacement"
    assert words(of("quartz", 1e-7), "yield_force").text.endswith(
        "1.8–2.6 nm, 0.19–0.57 nm here by our scalings, R^(2/3) to R: Q × 0.95–2.9"
    )
    assert "no measurement supports it here: polystyrene has 42 nm at 5 µm" in words(of("quartz", 1e-5), "r_min").text
    small = words(of("silica-dry", PAIR["radius"]), "yield_force")
    assert small._replace(size=None) == Note(
        "displacement", "ξ = 200 pm (--xi) is the paper's; by forces on SiO2 Q × 1.1–1.6"
    )


def test_it_is_said_at_the_prompt_in_explanations_and_in_json(run: Run) -> None:
    lead = "note: ξ = 200 pm (--xi) is the paper's; forces on SiO2 of 1 µm mean 1.8–2.6 nm"
    assert run("yield-force quartz 0.95um").err.startswith(lead)
    assert lead in run("yield-force quartz 0.95um --explain").out
    assert run("yield-force quartz,iron 0.95um --csv").err.count(lead) == 1
    found = json.loads(run("yield-force quartz 0.95um --json").out)
    assert any(text.startswith(lead.removeprefix("note: ")) for text in found["notes"])
    assert found["displacement"]["over_assumed"]["yield_force"] == approx(
        [force / 94.2478e-12 for force in FORCES], rel=1e-5
    )
    assert "displacement" not in json.loads(run("pull-off quartz 0.95um --json").out)


# --- Hysteresis as a part ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("model", ["jkr", "maugis"])
def test_a_part_of_the_work_of_adhesion(model: str) -> None:
    scene = of("quartz", 1e-6).replace(model=model)
    names = ("yield_moment", "yield_displacement")
    of_part = scene.replace(hysteresis_fraction=0.4).numbers(*names)
    assert of_part == approx(scene.replace(adhesion_hysteresis=0.02).numbers(*names))
    assert scene.replace(yield_displacement=of_part["yield_displacement"])["hysteresis_ratio"] == approx(0.4)


def test_the_option_takes_both_and_says_what_they_stand_for(run: Run) -> None:
    energy = run("n-grav quartz 1um --adhesion-hysteresis 20mJ/m2")
    for text in ("--adhesion-hysteresis 40%", "--adhesion-hysteresis 0.4e2%", "--hysteresis-fraction 0.4"):
        part = run(f"n-grav quartz 1um {text}")
        assert part.code == 0
        assert float(part.out.split()[1]) == approx(float(energy.out.split()[1]))
        assert "this Δw stands for ξ = 786.164 pm" in part.err
    assert "this ξ stands for an adhesion hysteresis of 40 % of w" in run("n-grav quartz 1um --xi 0.786164nm").err
    assert run("n-grav quartz 1um --adhesion-hysteresis 20mJ/m2±10%").code == 0
    assert run("n-grav quartz 1um --adhesion-hysteresis 0.0001lbf/in±20%").code == 0
    assert run("n-grav quartz 1um --adhesion-hysteresis 120%").code == 2
    assert run("n-grav quartz 1um --adhesion-hysteresis 40% --xi 1nm").code == 2
    assert sqrt(0.4 / 0.1) == approx(
        float(part.out.split()[1]) / float(run("n-grav quartz 1um --adhesion-hysteresis 10%").out.split()[1])
    )
