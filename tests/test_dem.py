"""Results for simulations of grains: resistances, turns, chains, aggregates, and the recipes of `guide dem`."""

import math
import re
from fractions import Fraction

import pytest

from harness import Run
from jkroll import JkrollError, solve
from jkroll.write.manual import page
from relative import approx
from scenes import QUARTZ


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("quartz 100nm", "slides or peels off at 9.4–22 nN"),
        ("quartz 1um", "slides or peels off at 180–220 nN"),
        ("quartz 1um --shear-strength 10MPa", "if it cannot roll, it slides at"),
        ("quartz 100nm --xi 1nm", "a pushed sphere rolls first"),
        # πa0²τ with a0 = 3.991 nm · 10^(2/3); measured SiO2 rolled at 0.7 nN or more
        ("quartz 1um --shear-strength 0.4MPa", "since it slides at 430 pN"),
        ("quartz 100nm --shear-strength 584.5MPa", "at 22 nN"),  # the whole area slides at 29.2 nN
        ("steel-304 1mm --load 5kN", "its adhesion alone peels off at 1.3–1.8 N"),  # the load still holds it
    ],
)
def test_resistances_say_whether_a_contact_rolls_slides_or_peels_first(run: Run, words: str, said: str) -> None:
    assert said in " ".join(run(f"resistances {words}", terminal=True).out.split())


def test_the_turns_after_an_impact_are_the_first_row_for_a_given_speed(run: Run) -> None:
    """A sphere with a given speed does not spin yet, and each row names the motion that it assumes."""
    ran = run("n-roll quartz 1um --speed 5cm/s")
    names = [line.split()[0] for line in ran.out.splitlines()]
    assert names == ["n_roll_after_impact", "n_roll", "n_roll_energy_balance"]
    shown = run("n-roll quartz 1um --speed 5cm/s", terminal=True).out
    rows = ("turns after hitting a body", "turns while it slides", "turns without slip")
    positions = [shown.index(f"\n{row} ") for row in rows]
    assert positions == sorted(positions)
    assert "body held" not in run("n-roll quartz 1um --energy 1aJ", terminal=True).out


def test_the_gravity_moment_of_n_grav_spheres_is_the_yield_moment(run: Run) -> None:
    """Eq 29 at the number of Eq 30 is the moment at which the first contact rolls."""
    spheres, moment = solve(["n_grav", "yield_moment"], **QUARTZ, radius2=3e-7).values()
    assert solve("gravity_moment", monomers=spheres, **QUARTZ, radius2=3e-7) == approx(moment, rel=1e-14)
    assert "gravity_moment" in run("n-grav quartz 100nm --monomers 500").out
    assert "gravity_moment" not in run("n-grav quartz 100nm").out


@pytest.mark.parametrize("model", ["jkr", "maugis", "dmt"])
@pytest.mark.parametrize("radius", [100, 101, 102, 105, 107])
def test_the_load_that_a_message_gives_can_be_typed(run: Run, radius: int, model: str) -> None:
    """A rounded pull-off force may lie beyond pull-off; the load in the message must not."""
    scene = f"contact quartz {radius}nm --model {model}"
    refused = run(f"{scene} --load=-20nN")
    assert refused.code
    held = re.findall(r"the hardest pull that it holds is (-[.\d]+) nN", refused.err)[0]
    assert run(f"{scene} --load={held}nN").code == 0
    assert float(held) == approx(
        -1e9 * solve("pull_off_force", **QUARTZ | {"radius": radius * 1e-9}, model=model), rel=5e-4
    )
    let_go = re.findall(r"a stiff machine holds them up to (-[.\d]+) pm", run(f"{scene} --approach=-1nm").err)
    assert all(run(f"{scene} --approach={approach}pm").code == 0 for approach in let_go)
    assert let_go or model == "dmt"


@pytest.mark.parametrize("model", ["jkr", "maugis", "dmt"])
def test_ratios_of_a_state_are_known_without_load_and_at_pull_off(run: Run, model: str) -> None:
    """Without load, the ratios are 0, 1 and 1. At pull-off the load ratio is -1; Eqs 5 and 6 give the others in JKR."""
    least = -solve("pull_off_force", model=model, **QUARTZ)
    names = ["load_ratio", "contact_radius_ratio", "approach_ratio"]
    assert [*solve(names, model=model, **QUARTZ).values()] == approx([0, 1, 1], rel=1e-12)
    at_pull_off = solve(names, model=model, load=least, **QUARTZ)
    assert at_pull_off["load_ratio"] == approx(-1, rel=1e-12)
    if model == "jkr":
        assert at_pull_off["contact_radius_ratio"] == approx(2 ** (-2 / 3), rel=1e-7)
        assert at_pull_off["approach_ratio"] == approx(-(2 ** (-4 / 3)), rel=1e-7)
    assert "load_ratio" in run(f"contact quartz 100nm --load -5nN --model {model}").out
    assert "load_ratio" not in run(f"contact quartz 100nm --model {model}").out


def test_a_contact_that_slides_before_it_rolls_is_not_said_to_break_first(run: Run) -> None:
    """The contact slides at 25 pN, and would roll at 94 pN."""
    said = run("resistances quartz 0.5nm --explain").out
    assert "slides or peels off before it rolls" in said
    assert "breaks before it rolls" not in said


def test_explanations_name_missing_inputs_of_an_aggregate(run: Run) -> None:
    ran = run("aggregates quartz 100nm")
    assert ran.code == 0
    explained = run("aggregates quartz 100nm --explain").out
    assert "give --monomers 1000" in explained
    assert "give --filling-factor 0.1" in explained
    assert "n_c = N = 10 (--contacts)" in run("aggregates quartz 100nm --monomers 10 --explain").out
    assert "(--contacts)" not in run("aggregates quartz 100nm --monomers 10 --contacts 12 --explain").out


@pytest.mark.parametrize(
    ("words", "message"),
    [("--radius2 1um", "identical"), ("--filling-factor 0.74", "--filling-factor"), ("--monomers 0", "monomers")],
)
def test_invalid_inputs_of_an_aggregate_are_refused(run: Run, words: str, message: str) -> None:
    refused = run(f"aggregates quartz 100nm --monomers 10 {words}")
    assert refused.code
    assert message in refused.err


def test_sources_of_aggregates_are_cited(run: Run) -> None:
    cited = run("aggregates quartz 100nm --monomers 10 --filling-factor 0.1 --cite").out
    for key in ("dominik-tielens-1997", "ormel-2007", "wada-2007", "tatsuuma-2023", "tatsuuma-2019"):
        assert f"{{{key},\n" in cited


@pytest.mark.parametrize(
    ("power", "step", "slide", "slide_at_strength", "kept"),
    [
        (0.0, -1 / 3, 1 / 3, -2 / 3, "pull_off_force"),
        (2 / 5, -2 / 5, 3 / 5, -2 / 5, "sticking_energy"),
        (1.0, -1 / 2, 1.0, 0.0, "tabor_parameter"),
    ],
)
def test_softer_grains_keep_a_quantity_and_the_yield_moment(
    power: float, step: float, slide: float, slide_at_strength: float, kept: str
) -> None:
    """The recipes of `guide dem`: with E·q, γ·q^power and ξ·q^−power, a quantity and the yield moment stay the same.

    `step`, `slide`, `slide_at_strength`: the powers of q by which the time step, the force that slides, and this force
    at a fixed shear strength change.
    """
    q, xi = 0.01, 2e-10
    names = [kept, "yield_moment", "sliding_frequency", "sliding_force"]
    before = solve(names, **QUARTZ, xi=xi)
    softer = {**QUARTZ, "youngs_modulus": q * 54e9, "surface_energy": 0.025 * q**power, "xi": xi * q**-power}
    after = solve(names, **softer)
    for name in (kept, "yield_moment"):
        assert math.isclose(after[name], before[name], rel_tol=1e-12)
    assert math.isclose(before["sliding_frequency"] / after["sliding_frequency"], q**step, rel_tol=1e-12)
    assert math.isclose(after["sliding_force"] / before["sliding_force"], q**slide, rel_tol=1e-12)
    held, held_softer = (solve("sliding_force", **scene, shear_strength=1e8) for scene in (QUARTZ, softer))
    assert math.isclose(held_softer / held, q**slide_at_strength, rel_tol=1e-12)
    factor = f"q^({Fraction(slide).limit_denominator(9)})" if slide % 1 else "q"
    assert f"× {factor} |" in page("dem")


def test_the_time_step_follows_sliding_below_36_nm_and_rayleigh_waves_above() -> None:
    """For quartz, the step is 1/20 of the period of sliding below the radius on the page, and a fifth of t_R above."""
    assert "the shorter of the two below R1 = 36 nm" in page("dem")
    for radius, is_by_sliding in ((35e-9, True), (37e-9, False)):
        scene = {**QUARTZ, "radius": radius}
        step, slide, rayleigh = solve(["time_step", "sliding_frequency", "rayleigh_time"], **scene).values()
        assert step == approx(1 / (20 * slide) if is_by_sliding else rayleigh / 5, rel=1e-14)


@pytest.mark.parametrize("model", ["jkr", "dmt"])
def test_the_rolling_resistance_coefficient_times_load_and_radius_is_the_moment(model: str) -> None:
    """In JKR the coefficient is 2ξ/(R(s - 1)); only a load that presses has a coefficient."""
    name = "rolling_resistance_coefficient"
    for load in (1e-12, 1e-8, 1e-4):
        coefficient, moment, radius = solve(
            [name, "yield_moment", "reduced_radius"], load=load, model=model, **QUARTZ
        ).values()
        assert coefficient * radius * load == approx(moment, rel=1e-14)
        if model == "jkr":
            margin = solve("load_margin", load=load, **QUARTZ)
            assert coefficient == approx(4e-10 / (radius * (margin - 1)), rel=1e-9)
    for load in (0.0, -1e-9):
        with pytest.raises(JkrollError, match=r"give --load 5nN"):
            solve(name, load=load, model=model, **QUARTZ)


def test_the_manual_has_the_energy_that_a_collision_loses_in_lammps() -> None:
    """The loss is the work from touch to the largest tension in JKR, in P_cδ0; z³ = 6â^1.5 goes from 4 to 3."""
    from scipy.integrate import quad  # type: ignore[import-untyped]

    lost = -quad(lambda z: z**3 * (z**3 - 6) / 9 * 2 * 6 ** (-1 / 3) * (z**3 - 1), 3 ** (1 / 3), 4 ** (1 / 3))[0]
    at_the_fold = solve("sticking_energy", **QUARTZ) / solve("adhesion_energy", **QUARTZ)
    for number in (lost, at_the_fold, math.sqrt(lost / at_the_fold)):
        assert f"{number:.4f}" in page("dem")


def test_the_manual_has_the_work_of_adhesion_of_two_solids_in_lethe() -> None:
    """Instead of w = 2√(γ1γ2), Lethe has γ1 + γ2 − 2(√γ1 − √γ2)²."""
    one, other = 0.02, 0.4
    assert round(1e3 * (one + other - 2 * (math.sqrt(one) - math.sqrt(other)) ** 2)) == -62
    assert round(1e3 * solve("work_of_adhesion", surface_energy=one, surface_energy2=other)) == 179
    assert "−62 mJ/m²" in page("dem")
    assert "179 mJ/m²" in page("dem")
