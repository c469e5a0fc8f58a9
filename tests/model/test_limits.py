"""Limits of the model: the side of a threshold where a number is in doubt, the results concerned, and the sentences."""

import json
import math
from typing import Any

import numpy as np
import pytest

from frames import bits, doubts, factor_of_law, outcomes
from harness import Run
from jkroll import NOMENCLATURE, solve
from jkroll.materials.library import known_materials
from jkroll.model.frame import Frame
from jkroll.model.limits import BITS, LIMITS, Doubt, Limit, codes
from jkroll.model.plan import depends_on
from jkroll.model.reasons import TWO_RIGID_BODIES, Failure
from jkroll.report.questions import QUESTIONS
from relative import approx
from scenes import OTHER, QUARTZ


def verdicts(*names: str, **given: Any) -> dict[str, str]:
    """Return the codes of the limits judged for some quantities, by the number that each limit judges.

    Of several limits on one number, only the last has its code.
    """
    return {doubt.limit.name: doubt.code for doubt in doubts(Frame({**QUARTZ, **given}), names)}


THRESHOLDS = [(limit, threshold) for limit in LIMITS for threshold in limit.codes]


@pytest.mark.parametrize(("limit", "threshold"), THRESHOLDS)
def test_the_code_changes_at_a_threshold(limit: Limit, threshold: float) -> None:
    below, above = (float(np.nextafter(threshold, end)) for end in (-np.inf, np.inf))
    beyond, before = (below, above) if limit.sign.startswith("<") else (above, below)
    code = limit.codes[threshold]
    doubt = Doubt(limit, beyond, beyond)
    assert (doubt.is_exceeded, doubt.code) == (True, code)
    assert limit.consequence in doubt.text
    assert Doubt(limit, before, before).code != code
    assert (Doubt(limit, threshold, threshold).code == code) == limit.sign.endswith("=")
    expected = {below: below == beyond, threshold: limit.sign.endswith("="), above: above == beyond}
    numbers = np.array([*expected, np.nan])
    is_beyond = Doubt(limit, numbers, numbers).bits >= BITS[code]
    assert is_beyond.tolist() == [*expected.values(), False]


def test_an_excess_is_the_logarithm_of_a_factor() -> None:
    of_small = doubts(Frame({**QUARTZ, "radius": 1e-9}), ["pull_off_force"])
    (few,) = [doubt for doubt in of_small if doubt.code == "few-atoms"]
    assert few.excess == approx(np.log(3 / few.value))
    assert few.factor == approx(3 / few.value)
    (law,) = [doubt for doubt in doubts(Frame(QUARTZ), ["pull_off_force"]) if doubt.code.startswith("law")]
    jkr, maugis = (solve("pull_off_force", model=model, atomic_spacing=4e-10, **QUARTZ) for model in ("jkr", "maugis"))
    lennard_jones = solve("pull_off_force_lennard_jones", **QUARTZ)
    assert law.factor == approx(max(maugis, lennard_jones) / jkr / 1.05)


def test_a_limit_that_is_not_exceeded_has_a_value_too() -> None:
    every = doubts(Frame(QUARTZ), ["pull_off_force"])
    (few,) = [doubt for doubt in every if doubt.limit.name == "contact_radius_in_spacings"]
    assert (few.text, few.factor) == ("within the limit", approx(3 / few.value))
    assert few.value == approx(9.98, rel=1e-3)


def test_every_limit_concerns_a_result_that_a_command_shows() -> None:
    shown = depends_on(tuple(name for question in QUESTIONS.values() for name in question.quantities))
    for limit in LIMITS:
        assert limit.name in NOMENCLATURE
        assert limit.touches & shown
        assert limit.touches <= NOMENCLATURE.keys()


@pytest.mark.parametrize(
    ("name", "given", "code"),
    [
        ("pull_off_force", {"youngs_modulus": 1e6}, "wide-contact"),
        ("pull_off_force", {"radius": 5e-9}, "few-atoms"),
        ("n_grav", {"radius": 1e-3}, "no-chain"),
        ("r_min", {"radius": 1e-10}, "bend-below-sphere"),
        ("yield_force_fixed_load", {"load": 1e-7}, "rolls-by-itself"),
        ("yield_angle", {"radius": 3e-10}, "large-angle"),
        ("yield_moment", {"radius": 1e-9, "yield_displacement": 1e-9}, "xi-over-contact"),
        ("yield_moment", {"radius": 3e-9}, "xi-over-limit"),
        ("yield_force", {"radius": 5e-10}, "slides-first"),
        ("n_roll", {"energy": 6e-20}, "does-not-roll-sliding"),
        ("n_roll_after_impact", {"energy": 2e-20}, "does-not-roll-after-impact"),
        ("n_roll_energy_balance", {"energy": 1e-20}, "does-not-roll"),
        ("contact_radius", {"radius": 1e-8}, "may-yield"),
        ("pull_off_force", {"radius": 1e-6}, "rough-matters"),
        ("bond_number", {"radius": 1e-4}, "rough-matters"),
        ("n_roll", {"speed": 50.0}, "flies-off"),
        ("n_roll_after_impact", {"speed": 50.0}, "flies-off"),
        ("n_roll_energy_balance", {"energy": 1.2e-15}, "flies-off"),  # P_c(R1 + R2)/2 is 1.178e-15 J
        ("restitution", {"speed": 0.6}, "bounces"),  # v_stick is 0.596 m/s
        ("sticking_speed", {"speed": 0.6}, "bounces"),
        ("contact_radius", {"youngs_modulus": 1e5, "poisson_ratio": 0.49}, "large-strain"),
        ("contact_radius", {"youngs_modulus": 1e5, "poisson_ratio": 0.48}, "may-yield"),
        ("contact_radius_at_load", {"approach_at_load": -6e-11}, "beyond-pull-off"),
    ],
)
def test_a_contact_beyond_a_limit_has_its_code(name: str, given: dict[str, Any], code: str) -> None:
    assert code in verdicts(name, **given).values()
    assert code in codes(bits(Frame({**QUARTZ, **given}), [name])).split()


def test_doubts_about_roughness_do_not_depend_on_the_order_of_the_spheres() -> None:
    """The smaller sphere decides; a plane does not count."""
    for radius, radius2, is_in_doubt in (
        (1e-6, 1e-7, False),
        (1e-7, 1e-6, False),
        (1e-6, 2e-6, True),
        (2e-6, 1e-6, True),
        (1e-6, math.inf, True),
        (1e-7, math.inf, False),
    ):
        found = verdicts("pull_off_force", radius=radius, radius2=radius2).values()
        assert ("rough-matters" in found) is is_in_doubt


def test_spheres_with_a_viscous_time_bounce_above_the_sticking_speed_with_damping() -> None:
    """The doubt agrees with the sticking speed, in columns as well, and above T* = 0.68, where all spheres stick."""
    times, speeds = np.array([1e-13, 1e-12, 1e-11, 1e-10]), np.array([1.0, 30.0, 1.0, 1.0])
    bounces = []
    for time, speed in zip(times.tolist(), speeds.tolist(), strict=True):
        given = {"radius": 1e-6, "viscous_time": time, "speed": speed}
        bounces.append("bounces" in verdicts("restitution", **given).values())
        limit = dict.fromkeys(["sticking_speed"], math.inf) | Frame({**QUARTZ, **given}).numbers("sticking_speed")
        assert bounces[-1] is (speed > limit["sticking_speed"])
    assert {*bounces} == {True, False}
    scene = Frame({**QUARTZ, "radius": 1e-6, "viscous_time": times, "speed": speeds})
    assert [*(bits(scene, ["restitution"]) & BITS["bounces"] > 0)] == bounces


def test_a_sphere_does_not_roll_if_its_energy_for_rolling_is_below_the_yield_energy() -> None:
    """The paper says of spheres: "do not roll at all, if they are smaller than about 10 nm".

    By Eqs (1) and (3), (2/7)P_cδ0 is 6πγξ² for quartz spheres of radius 11 nm.
    """
    gamma, modulus, shift = 0.025, 54e9 / (2 * (1 - 0.17**2)), 2e-10
    for share, names in ((2 / 7, ["n_roll"]), (5 / 7, ["n_roll_after_impact"]), (1.0, ["n_roll_energy_balance"])):
        reduced = (2 * shift**2 / share) ** 0.75 * (modulus**2 / (3 * np.pi**2 * gamma**2)) ** 0.25
        for radius, is_in_doubt in ((0.999 * 2 * reduced, True), (1.001 * 2 * reduced, False)):
            found = verdicts(*names, radius=radius).values()
            assert any(code.startswith("does-not-roll") for code in found) is is_in_doubt
        if share < 0.5:
            assert 2 * reduced == approx(11e-9, rel=0.01)


def test_iron_spheres_of_100_nm_may_yield() -> None:
    """Their p_H = 2aE*/πR is 17.8 GPa or 0.16 E*; for quartz, p_H is 0.05 E*."""
    for material, ratio, is_in_doubt in (("iron", 0.16, True), ("quartz", 0.051, False)):
        scene = Frame({"radius": 1e-7}, known_materials()[material])
        assert scene["hertz_pressure"] / scene["contact_modulus"] == approx(ratio, rel=0.02)
        assert ("may-yield" in codes(bits(scene, ["contact_radius"])).split()) is is_in_doubt


def test_limits_are_not_judged_for_results_that_they_do_not_concern() -> None:
    for turns in ("n_roll", "n_roll_after_impact"):  # here the speed is along the surface
        assert "speed_over_sticking" not in verdicts(turns, speed=1.0)
    assert "load_margin" not in verdicts("yield_force")
    assert "profile_error" not in verdicts("r_min")


def test_a_load_of_exactly_the_pull_off_force_is_not_stable() -> None:
    force = solve("pull_off_force", **QUARTZ)
    assert verdicts("yield_force", load=-force)["load_margin"] == "beyond-pull-off"
    for load in (-0.999 * force, 100 * force):
        assert verdicts("yield_force", load=load)["load_margin"] == ""


def test_a_ratio_of_forces_has_the_doubts_of_its_contact() -> None:
    """The doubts are the same without load, although the ratio is then 4ξ/R1 whatever the contact is."""
    soft = {"radius": 3e-10, "surface_energy": 0.025, "youngs_modulus": 5e9, "poisson_ratio": 0.2}
    of_loads = [codes(bits(Frame({**soft, "load": load}), ["yield_force_ratio"])).split() for load in (0.0, 1e-18)]
    assert {"few-atoms", "wide-contact"} <= {*of_loads[0]} == {*of_loads[1]}


def test_the_error_of_the_paraboloid_is_the_next_term_of_the_profile() -> None:
    """r²/2R + r⁴/8 (R1⁻³ + R2⁻³) compared with two circles; for equal spheres the error is 1 % at a = 0.2 R1."""
    for radius2 in (1e-7, 4e-8, 1e-5):
        scene = {**QUARTZ, "radius2": radius2, "youngs_modulus": 54e10}
        error, a, reduced = solve(["profile_error", "contact_radius_at_load", "reduced_radius"], **scene).values()
        depth = sum(radius - np.sqrt(np.longdouble(radius) ** 2 - a**2) for radius in (1e-7, radius2))
        assert float(depth / (a**2 / (2 * reduced)) - 1) == approx(error, rel=0.02)


# --- Two rigid bodies -------------------------------------------------------------------------------------------------

RIGID: list[dict[str, Any]] = [
    {"youngs_modulus": np.inf},
    {**OTHER, "youngs_modulus": np.inf, "youngs_modulus2": np.inf},
]


@pytest.mark.parametrize("given", RIGID)
def test_two_rigid_bodies_have_no_jkr_contact(given: dict[str, Any]) -> None:
    scene = Frame({**QUARTZ, **given})
    for name, value in outcomes(scene, QUESTIONS["report"].quantities).items():
        if name in ("pull_off_force_dmt", "r_min", "yield_angle"):
            assert value > 0
        elif name not in ("load", "n_roll_after_impact", "yield_force_fixed_load"):
            assert isinstance(value, Failure), name
            assert value.cause == TWO_RIGID_BODIES


def test_one_rigid_body_or_an_unknown_modulus_is_not_refused() -> None:
    assert solve("pull_off_force", radius=1e-7, surface_energy=0.025) > 0
    assert solve("pull_off_force", **QUARTZ, youngs_modulus2=np.inf) > 0
    assert solve("pull_off_force", radius=1e-7, surface_energy=0.025, youngs_modulus2=np.inf) > 0
    assert solve("yield_moment", **{**QUARTZ, "youngs_modulus": np.inf}, contact_modulus=1e9) > 0


def test_no_wave_runs_around_a_rigid_sphere(run: Run) -> None:
    result = json.loads(run("frequencies quartz 100nm --young rigid --young2 1GPa --json").out)["results"][-1]
    assert (result["name"], result["value"]) == ("rayleigh_time", None)
    assert result["reason"] == "sphere 1 is rigid, and no wave runs around it"
    moduli = np.array([np.inf, 54e9])
    times = solve("rayleigh_time", radius=1e-7, density=2600.0, poisson_ratio=0.17, youngs_modulus=moduli)
    assert np.isnan(times).tolist() == [True, False]


# --- Answers ----------------------------------------------------------------------------------------------------------


def test_a_note_lists_the_limits_that_could_not_be_judged(run: Run) -> None:
    said = run("pull-off gold 100nm --explain").out
    lacking = "need Young's modulus and Poisson's ratio; gold has none in Table 1 of D&T"
    assert f"note: not checked: contact-exceeds-sphere, law-off-5%, few-atoms, may-yield and 1 more: {lacking}" in said
    assert "z0 = " not in said  # no limit was judged with z0
    assert "not checked" not in run("pull-off quartz 100nm --explain").out


def test_turns_after_an_impact_follow_from_angular_momentum() -> None:
    """The angular momentum about the contact, mvR, is conserved: (I + mR²)ω = mvR; ⟨M⟩ dissipates ½(I + mR²)ω²."""
    names = ["mass", "moment_of_inertia", "mean_rolling_moment", "n_roll_after_impact"]
    mass, inertia, moment, turns = solve(names, speed=0.1, **QUARTZ).values()
    total = inertia + mass * 1e-14
    spin = mass * 0.1 * 1e-7 / total
    assert turns == approx(total * spin**2 / 2 / (2 * np.pi * moment), rel=1e-12)


def test_a_load_of_fixed_direction_changes_the_rolling_force(run: Run) -> None:
    """The force is M/R1 − Pξ/R2, and M/R1 on a plane. It is shown if a load or a state is given."""
    names = ["yield_force", "yield_force_fixed_load"]
    turning, fixed = solve(names, load=-1e-9, **QUARTZ).values()
    assert fixed - turning == approx(1e-9 * 2e-10 / 1e-7, rel=1e-9)
    turning, fixed = solve(names, load=-1e-9, radius2=np.inf, **QUARTZ).values()
    assert fixed == approx(turning, rel=1e-14)
    assert "yield_force_fixed_load" in run("yield-force quartz 100nm --load 1nN").out
    assert "yield_force_fixed_load" not in run("yield-force quartz 100nm").out


def test_a_sphere_rolls_by_itself_beyond_eight_pull_off_forces(run: Run) -> None:
    """For identical spheres, Q_P = 2P_cξ(1 + s)/R1 − Pξ/R1 is 0 at P = 8P_c, where s = 3."""
    force = 3 * math.pi * 0.025 * 5e-8
    for times, code in ((7.999, ""), (8.001, "rolls-by-itself")):
        assert verdicts("yield_force_fixed_load", load=times * force)["yield_force_fixed_load"] == code
    of_a_plane = {"load": 1e-6, "radius2": math.inf}
    assert verdicts("yield_force_fixed_load", **of_a_plane)["yield_force_fixed_load"] == ""
    iron = json.loads(run("yield-force iron 1um --load 1mN --json").out)["validity"]
    [verdict] = [verdict for verdict in iron if verdict["code"] == "rolls-by-itself"]
    assert verdict["value"] == approx(-1.464502e-7, rel=1e-6)
    ran = run("yield-force iron 1um --load 1mN").err
    assert "a load of fixed direction is enough to roll sphere 1" in " ".join(ran.split())


def test_strengths_outside_the_fitted_filling_factors_are_doubtful(run: Run) -> None:
    for factor, code in ((0.0099, "filling-out-of-range"), (0.01, ""), (0.5, ""), (0.51, "filling-out-of-range")):
        assert verdicts("tensile_strength", filling_factor=factor)["filling_factor"] == code
    for factor, code in ((0.1, ""), (0.101, "slides-and-twists")):
        assert verdicts("compressive_strength", filling_factor=factor)["filling_factor"] == code
    ran = run("aggregates quartz 100nm --filling-factor 0.7 --quantities tensile_strength").err
    assert "fitted to filling factors of 0.01 to 0.5 (φ = 0.7)" in " ".join(ran.split())


def test_a_note_of_n_grav_on_another_body_says_where_the_contact_between_the_spheres_yields(run: Run) -> None:
    said = "N_grav counts the spheres held by the first contact, which is with body 2"
    of_materials = "n-grav quartz 100nm --material2 iron --work-of-adhesion 1J/m2"
    for words in ("n-grav quartz 100nm --radius2 plane", "n-grav quartz 100nm --radius2 1nm", of_materials):
        assert f"{said}; the next contact, of two spheres 1, yields in a chain of 940.4 spheres" in run(words).err
    of_pair = "--work-of-adhesion 50mJ/m2 --density 2g/cm3 --radius2 1um"
    assert f"{said}; the next" in run(f"n-grav 100nm {of_pair}").err


# --- The law of adhesion ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "given", "code"),
    [
        # 3.7 % by Maugis, 8.7 % by Lennard-Jones
        ("pull_off_force", {"material": "iron", "radius": 1e-7}, "law-off-5%"),
        ("pull_off_force", {"material": "quartz", "radius": 1e-7}, "law-off-25%"),
        ("pull_off_force", {"material": "quartz", "radius": 1e-7, "model": "dmt"}, ""),
        ("pull_off_force", {"material": "quartz", "radius": 1e-4, "model": "dmt"}, "law-off-25%"),
        ("pull_off_force", {"material": "quartz", "radius": 1e-7, "model": "maugis"}, ""),
        ("yield_force", {"material": "quartz", "radius": 1e-7}, "law-off-2x"),  # 57 % smaller at equal ξ
        ("r_min", {"material": "quartz", "radius": 1e-7}, ""),  # R_min depends on no law of adhesion
        ("n_grav", {"material": "polystyrene", "radius": 1e-4}, ""),
    ],
)
def test_the_law_of_adhesion_is_judged_by_its_effect_on_each_result(
    name: str, given: dict[str, Any], code: str
) -> None:
    model = given.pop("model", "jkr")
    scene = Frame({"radius": given["radius"]}, known_materials()[given["material"]], model=model)
    of_law = [doubt for doubt in codes(bits(scene, [name])).split() if doubt.startswith("law")]
    assert of_law == ([code] if code else [])


def test_a_contact_that_exists_only_under_dmt_is_doubtful() -> None:
    """A DMT contact bears this load; a Maugis contact does not."""
    force = solve("pull_off_force", **QUARTZ, model="dmt")
    held = {**QUARTZ, "radius": 1e-4, "load": -0.9 * 1e3 * force}
    scene = Frame(held, model="dmt")
    assert "law-off-2x" in codes(bits(scene, ["approach_at_load"])).split()


@pytest.mark.parametrize(
    ("model", "name", "value", "other", "names"),
    [
        ("jkr", "load", -3 * np.pi * 0.025 * 5e-8, 0.0, ("stiffness", "vertical_frequency")),  # at pull-off
        ("dmt", "load", -2 * np.pi * 0.05 * 5e-8, 0.0, ("stiffness", "contact_radius_at_load")),  # at pull-off
        ("dmt", "approach_at_load", 0.0, 1e-10, ("stiffness", "contact_radius_at_load")),  # at first touch
    ],
)
def test_a_result_of_zero_is_not_compared_with_that_of_another_law(
    model: str, name: str, value: float, other: float, names: tuple[str, ...]
) -> None:
    zero, both = (Frame({**QUARTZ, name: given}, model=model) for given in (value, np.array([value, other])))
    for result in names:
        assert zero[result] == both[result][0] == 0
        assert factor_of_law(zero, [result]) == factor_of_law(both, [result])[0] == 1
        assert factor_of_law(both, [result])[1] != 1


def test_a_dmt_contact_at_an_approach_is_doubtful_although_it_does_not_depend_on_w() -> None:
    """Its radius √(Rδ) does not depend on the work of adhesion, and Maugis' contact is far wider."""
    scenes = [Frame({**QUARTZ, "approach_at_load": given}, model="dmt") for given in (1e-11, np.array([1e-11, 1e-12]))]
    for name, first in (("contact_radius_at_load", "law-off-2x few-atoms"), ("stiffness", "law-off-25% few-atoms")):
        one, both = (bits(scene, [name]) for scene in scenes)
        assert codes(one) == codes(int(both[0])) == first
        assert codes(int(both[1])) == "law-off-2x few-atoms"


def test_the_other_law_has_the_spacing_that_follows_from_the_cutoff() -> None:
    """The frame computes the spacing from the cutoff, and the other law uses this spacing."""
    given: dict[str, Any] = {"radius": 1e-7, "hamaker": 6.5e-20, "cutoff": 2e-10}
    other = Frame(given, known_materials()["quartz"]).by_law
    assert other["pull_off_force"] == solve("pull_off_force", material="quartz", model="maugis", **given)


@pytest.mark.parametrize(("contacts", "is_possible"), [(998, False), (999, True), (6000, True), (6001, False)])
def test_an_aggregate_of_a_thousand_grains_has_999_to_6000_contacts(contacts: float, is_possible: bool) -> None:
    found = verdicts("disruption_energy", monomers=1000.0, contacts=contacts).values()
    assert ("contacts-out-of-range" in found) is not is_possible


def test_a_doubt_comes_before_missing_inputs_and_partial_error_bars(run: Run) -> None:
    """Without --explain only some notes are shown, and a doubt is among them."""
    aggregate = run("aggregates quartz 100nm --monomers 1000 --contacts 1", terminal=True)
    assert "note: a connected aggregate of N grains has at least N - 1 contacts" in aggregate.err
    assert "the impact pressure exceeds" in run("impact ice-warm 500nm --speed 10m/s", terminal=True).err


def test_contacts_alone_are_not_judged(run: Run) -> None:
    ran = run("aggregates graphite 100nm --contacts 7", terminal=True)
    assert (ran.code, "connected aggregate" in ran.err) == (0, False)
