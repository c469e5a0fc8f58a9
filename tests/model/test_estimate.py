"""The best range of each result: every rule is checked against values by `solve` or by hand."""

from collections.abc import Mapping
from itertools import product
from math import inf, isnan, nan, pi
from typing import Any

import numpy
import pytest

from jkroll import solve
from jkroll.materials.library import known_materials
from jkroll.model.estimate import WORDS, Estimate, estimates
from jkroll.model.frame import Frame
from jkroll.model.results import Results
from jkroll.quantities.values import value_of
from relative import approx

SPACINGS = (4e-10, 2e-10)


def best(names: str, material: str | None = None, model: str | None = None, **given: Any) -> dict[str, Estimate]:
    """Return estimates, with their rules in words."""
    solid = None if material is None else known_materials()[material]
    frame = Frame(given, solid, model=model)
    found = estimates(Results(frame, frame.columns(names.split())), names.split())
    return {name: estimate._replace(by=WORDS[estimate.by]) for name, estimate in found.items()}


def by_maugis(name: str, **given: Any) -> list[float]:
    """Return a quantity by Maugis' law at the atomic spacing, and at half of it."""
    return [solve(name, model="maugis", atomic_spacing=spacing, **given) for spacing in SPACINGS]


QUARTZ: Mapping[str, Any] = {"material": "quartz", "radius": 1e-7}


def test_pull_off_force_ranges_from_maugis_to_lennard_jones() -> None:
    force = best("pull_off_force", **QUARTZ)["pull_off_force"]
    least = min(by_maugis("pull_off_force", **QUARTZ))
    assert force == (approx(least), approx(solve("pull_off_force_lennard_jones", **QUARTZ)), "Maugis")


def test_range_spans_jkr_and_maugis_if_they_agree_within_5_percent() -> None:
    frequency = best("vertical_frequency", **QUARTZ)["vertical_frequency"]
    values = [solve("vertical_frequency", **QUARTZ), *by_maugis("vertical_frequency", **QUARTZ)]
    assert frequency == (approx(min(values)), approx(max(values)), "JKR")


def test_range_includes_uncertainty_which_does_not_change_the_rule() -> None:
    """For iron spheres of radius 1 mm all laws agree within 5 %, however uncertain γ is.

    For small spheres of radius 100 nm, each end comes from a different law.
    """
    gamma = value_of("20 to 30 mJ/m2", "surface_energy")
    small: dict[str, Any] = {"radius": 1e-7, "youngs_modulus": 54e9, "poisson_ratio": 0.17}
    low, high, by = best("pull_off_force", surface_energy=gamma, **small)["pull_off_force"]
    least = solve("pull_off_force", model="maugis", atomic_spacing=2e-10, surface_energy=0.02, **small)
    most = solve("pull_off_force_lennard_jones", surface_energy=0.03, **small)
    assert (low, high, by) == (approx(least), approx(most), "Maugis")
    of_iron = best("pull_off_force", "iron", radius=1e-3, surface_energy=value_of("1 to 2 J/m2", "surface_energy"))
    assert of_iron["pull_off_force"].by == "JKR"


def test_bends_and_angles_with_a_range_of_xi_have_the_rule_any_law_even_without_a_modulus() -> None:
    """R_min = R1R2/ξ and δ_α = ξ/R do not depend on a law."""
    for name in ("r_min", "yield_angle"):
        displacement = value_of("1 to 3 nm", "yield_displacement")
        assert best(name, radius=1e-7, surface_energy=0.025, yield_displacement=displacement)[name].by == "any law"


@pytest.mark.parametrize("radius", [1e-7, 0.95e-6, 2e-6])
def test_measured_rolling_forces_scale_with_r_or_r_to_the_two_thirds(radius: float) -> None:
    force = best("yield_force", "quartz", radius=radius)["yield_force"]
    scale = radius / 0.95e-6
    both = scale, scale ** (2 / 3)
    assert force == (approx(0.69e-9 * min(both), rel=1e-9), approx(1.57e-9 * max(both), rel=1e-9), "scaled")


def test_r_min_covers_the_displacements_that_all_laws_derive_from_measured_forces() -> None:
    """ξ is proportional to the force, with a different factor for each law."""
    low, high, by = best("r_min", **QUARTZ)["r_min"]
    at_an_atom = {**QUARTZ, "yield_displacement": 2e-10}
    forces = [solve("yield_force", **at_an_atom), *by_maugis("yield_force", **at_an_atom)]
    ends = (0.69e-9 * 1e-7 / 0.95e-6, 1.57e-9 * (1e-7 / 0.95e-6) ** (2 / 3))
    # A displacement is at least 2 Å, that of an atom.
    displacements = [max(2e-10 * end / force, 2e-10) for force, end in product(forces, ends)]
    bends = [1e-7**2 / displacement for displacement in displacements]
    assert (low, high, by) == (approx(min(bends), rel=1e-9), approx(max(bends), rel=1e-9), "scaled")


def test_unknown_xi_ranges_from_one_atom_to_loss_of_all_work_of_adhesion() -> None:
    given: dict[str, Any] = {"material": "silica-dry", "radius": 2.5e-7}
    force = best("yield_force", **given)["yield_force"]
    at_an_atom = by_maugis("yield_force", yield_displacement=2e-10, **given)
    ratios = by_maugis("hysteresis_ratio", yield_displacement=2e-10, **given)
    at_full_loss = [value / ratio for value, ratio in zip(at_an_atom, ratios, strict=True)]
    assert force == (approx(min(at_an_atom)), approx(max(at_full_loss)), "ξ unknown")


def test_r_min_has_only_an_upper_end_if_only_the_radius_is_given() -> None:
    assert best("r_min", radius=1e-7)["r_min"] == (approx(nan, nan_ok=True), approx(5e-5), "ξ unknown")


def test_without_a_jump_lost_energy_has_only_an_upper_end_and_restitution_ranges_from_0_to_1() -> None:
    given: dict[str, Any] = {"material": "quartz", "radius": 1e-8, "speed": 20.0}
    found = best("restitution lost_energy", **given)
    assert {estimate.by for estimate in found.values()} == {"adhesion only"}
    assert found["restitution"][:2] == (0.0, 1.0)
    assert isnan(found["lost_energy"].low)
    assert found["lost_energy"].high == approx(solve("lost_energy", **given))


def test_small_hard_spheres_stick_at_1_to_10_times_the_speed_by_jkr_with_or_without_a_jump() -> None:
    """Energies are proportional to the square of the speed. Spheres slower than the least of these speeds stick."""
    for solid in ("quartz", "silica-dry"):
        given: dict[str, Any] = {"material": solid, "radius": 9e-8}
        found = best("sticking_speed sticking_energy restitution", **given, speed=0.5)
        speed, energy = solve("sticking_speed", **given), solve("sticking_energy", **given)
        assert found["sticking_speed"] == (approx(speed), approx(10 * speed), "1–10 × JKR")
        assert found["sticking_energy"] == (approx(energy), approx(100 * energy), "1–10 × JKR")
        assert found["restitution"] == (0.0, 0.0, "1–10 × JKR")
    of_rubber = best("sticking_speed", "pdms", radius=1e-5)["sticking_speed"]
    assert of_rubber.by == "JKR"


def test_losses_other_than_by_adhesion_may_lower_the_restitution_to_0() -> None:
    found = best("restitution", "silica-dry", radius=1e-7, speed=5.0)["restitution"]
    given: dict[str, Any] = {"material": "silica-dry", "radius": 1e-7, "speed": 5.0}
    most = max(solve("restitution", **given), *by_maugis("restitution", **given))
    assert found == (0.0, approx(most), "adhesion only")


def test_n_grav_has_only_an_upper_end_if_the_least_xi_holds_no_sphere() -> None:
    """At ξ = 2 Å no sphere is held level (N < 1); at the largest ξ some are, as N² is proportional to ξ."""
    given: dict[str, Any] = {"material": "silica-dry", "radius": 3e-5, "yield_displacement": 2e-10}
    assert solve("n_grav", **given) < 1
    numbers = by_maugis("n_grav", **given)
    ratios = by_maugis("hysteresis_ratio", **given)
    most = max(number / ratio**0.5 for number, ratio in zip(numbers, ratios, strict=True))
    found = best("n_grav", "silica-dry", radius=3e-5)["n_grav"]
    assert found == (approx(nan, nan_ok=True), approx(most), "ξ unknown")


@pytest.mark.parametrize(
    ("name", "by_lennard_jones"),
    [
        ("well_energy", "well_energy_lennard_jones"),
        ("pull_off_work", "well_energy_lennard_jones"),
        ("pull_off_work_at_dead_load", "dead_load_work_lennard_jones"),
    ],
)
def test_separation_energies_range_from_maugis_to_lennard_jones_without_a_jump(
    name: str, by_lennard_jones: str
) -> None:
    low, high, by = best(name, **QUARTZ)[name]
    most = solve(by_lennard_jones, **QUARTZ)
    assert (low, high, by) == (approx(min(by_maugis(name, **QUARTZ))), approx(most), "Maugis")
    assert low > solve(name, **QUARTZ)


def test_separation_energies_with_a_jump_leave_out_lennard_jones() -> None:
    """Quartz spheres of radius 1 mm have a Tabor parameter of 2.9."""
    big = {**QUARTZ, "radius": 1e-3}
    energy, ends = best("pull_off_work", **big)["pull_off_work"], by_maugis("pull_off_work", **big)
    own = solve("pull_off_work", **big)
    assert energy == (approx(min(own, *ends)), approx(max(own, *ends)), "JKR")


def test_disruption_of_aggregates_scales_with_the_work_to_part_two_spheres() -> None:
    """The energy of Wada's fit is proportional to the work to part two spheres, the speed to the root of that work."""
    crowd = {**QUARTZ, "density": 2600.0, "monomers": 1000.0}
    parted = best("pull_off_work", **crowd)["pull_off_work"].high / solve("pull_off_work", **crowd)
    for name, power in (("disruption_energy", 1), ("disruption_speed", 0.5)):
        assert best(name, **crowd)[name].high / solve(name, **crowd) == approx(parted**power)


def test_without_a_modulus_the_pull_off_force_ranges_from_jkr_to_dmt() -> None:
    """The ends are 3πγR and 4πγR, with R = R1/2."""
    force = best("pull_off_force", radius=1e-7, surface_energy=0.025)["pull_off_force"]
    assert force == (approx(3 * pi * 0.025 * 0.5e-7), approx(4 * pi * 0.025 * 0.5e-7), "JKR to DMT")


@pytest.mark.parametrize(("radius", "speed"), [(0.25e-6, 1.909), (0.6e-6, 1.2)])
@pytest.mark.parametrize("solid", ["quartz", "silica-dry", "silica-humid"])
def test_sticking_speed_of_silica_on_a_plane_is_the_measured_one(solid: str, radius: float, speed: float) -> None:
    found = best("sticking_speed", solid, radius=radius, radius2=inf)["sticking_speed"]
    assert found == (approx(0.7 * speed, rel=1e-3), approx(1.3 * speed, rel=1e-3), "measured")


@pytest.mark.parametrize("other", [{"radius": 0.2e-6}, {"radius": 0.7e-6}, {"radius2": 0.5e-6}])
def test_measured_sticking_speeds_scale_with_the_speed_by_jkr(other: dict[str, Any]) -> None:
    """The ratio of the estimate to JKR's speed is that measured for spheres of 0.25 and 0.6 µm on a plane."""
    given: dict[str, Any] = {"material": "quartz", "radius": 0.5e-6, "radius2": inf, **other}
    ratios = [
        measured / solve("sticking_speed", material="quartz", radius=radius, radius2=inf)
        for radius, measured in ((0.25e-6, 1.909), (0.6e-6, 1.2))
    ]
    speed = solve("sticking_speed", **given)
    ends = 0.7 * speed * min(ratios), 1.3 * speed * max(ratios)
    found = best("sticking_speed sticking_energy", **given)
    assert found["sticking_speed"] == (approx(ends[0], rel=1e-3), approx(ends[1], rel=1e-3), "measured")
    energies = [solve("sticking_energy", **given) * (end / speed) ** 2 for end in ends]
    assert found["sticking_energy"][:2] == (approx(energies[0], rel=2e-3), approx(energies[1], rel=2e-3))


@pytest.mark.parametrize(
    "other",
    [
        {"radius": 4e-8}, {"material": "polystyrene"},
        {"surface_energy": 2.0}, {"surface_energy": 1e-6}, {"youngs_modulus": 5.4e8}, {"density": 100.0},
    ],
)  # fmt: skip
def test_other_hard_spheres_stick_at_1_to_10_times_the_speed_by_jkr(other: Mapping[str, Any]) -> None:
    """Small hard spheres were seen to stick up to such speeds."""
    given = {"material": "quartz", "radius": 0.5e-6, "radius2": inf, **other}
    speed = solve("sticking_speed", **given)
    assert best("sticking_speed", **given)["sticking_speed"] == (approx(speed), approx(10 * speed), "1–10 × JKR")


def test_with_a_viscous_time_no_measured_sticking_speed_is_used() -> None:
    given: dict[str, Any] = {"material": "quartz", "radius": 0.5e-6, "radius2": inf, "viscous_time": 1e-12}
    speed = solve("sticking_speed", **given)
    assert best("sticking_speed", **given)["sticking_speed"] == (approx(speed), approx(speed), "JKR only")


@pytest.mark.parametrize(
    ("model", "spacing", "word"),
    [("jkr", {}, "JKR"), ("maugis", {"atomic_spacing": 3e-10}, "Maugis"), ("dmt", {}, "DMT")],
)
def test_a_given_law_alone_sets_the_estimate(model: str, spacing: dict[str, Any], word: str) -> None:
    force = solve("pull_off_force", model=model, **spacing, **QUARTZ)
    estimate = best("pull_off_force", model=model, **spacing, **QUARTZ)["pull_off_force"]
    assert estimate == (approx(force), approx(force), word)


def test_under_maugis_law_without_z0_the_range_spans_the_likely_atomic_spacings() -> None:
    estimate = best("pull_off_force", model="maugis", **QUARTZ)["pull_off_force"]
    ends = by_maugis("pull_off_force", **QUARTZ)
    assert estimate == (approx(min(ends)), approx(max(ends)), "z0 assumed")


def test_a_given_atomic_spacing_is_the_only_one_in_the_range() -> None:
    estimate = best("pull_off_force", atomic_spacing=3e-10, **QUARTZ)["pull_off_force"]
    least = solve("pull_off_force", model="maugis", atomic_spacing=3e-10, **QUARTZ)
    most = solve("pull_off_force_lennard_jones", atomic_spacing=3e-10, **QUARTZ)
    assert estimate == (approx(least), approx(most), "Maugis")


def test_results_with_the_same_formula_in_every_law_have_the_rule_any_law() -> None:
    """The Rayleigh time depends on no law of attraction.

    The Tabor parameter depends on the atomic spacing, which is known to a factor of two.
    """
    found = best("rayleigh_time tabor_parameter", **QUARTZ)
    assert found["rayleigh_time"] == (*2 * (approx(solve("rayleigh_time", **QUARTZ)),), "any law")
    tabor = solve("tabor_parameter", **QUARTZ)
    assert found["tabor_parameter"] == (approx(tabor), approx(2 * tabor), "z0 assumed")


def test_conventions_are_exact_and_quantities_of_another_law_have_no_range() -> None:
    found = best("fold_energy sticking_speed_pencil_code pull_off_force_dmt", **QUARTZ)
    assert found["fold_energy"] == (*2 * (approx(solve("fold_energy", **QUARTZ)),), "definition")
    assert found["sticking_speed_pencil_code"].by == "definition"
    assert found["pull_off_force_dmt"].by == "–"


def test_arrays_have_the_ranges_of_single_rows() -> None:
    radii = numpy.geomspace(1e-9, 1e-3, 60)
    names = [
        "pull_off_force", "yield_force", "r_min", "sticking_speed", "pull_off_work", "rolling_frequency",
        "contact_radius_at_load",
    ]  # fmt: skip
    solid = known_materials()["quartz"]
    frame = Frame({"radius": radii}, solid)
    of_arrays = estimates(Results(frame, frame.shown(names, names)), names)
    for row, radius in enumerate(radii.tolist()):
        single = Frame({"radius": radius}, solid)
        of_floats = estimates(Results(single, single.shown(names, names)), names)
        for name in names:
            of_row = [numpy.broadcast_to(part, radii.shape)[row] for part in of_arrays[name]]
            expected = of_floats.get(name, Estimate(nan, nan, 0))
            assert of_row == [approx(part, rel=1e-12, nan_ok=True) for part in expected], (name, radius)


def test_sliding_results_span_a_third_to_three_times_the_assumed_shear_strength() -> None:
    """The sliding force is proportional to τ, and its energy to τ²; the peeling force does not depend on τ."""
    names = ("sliding_force", "sliding_energy", "sliding_or_peeling_force", "peeling_force")
    found = best(" ".join(names), **QUARTZ)
    strength = solve("shear_strength", **QUARTZ)
    for name in names[:3]:
        ends = [solve(name, shear_strength=strength * factor, **QUARTZ) for factor in (1 / 3, 3)]
        assert found[name] == (approx(ends[0]), approx(ends[1]), "τ assumed")
    assert found["sliding_force"].high == approx(9 * found["sliding_force"].low)
    assert found["peeling_force"].by == "JKR only"
    force = solve("sliding_force", shear_strength=strength, **QUARTZ)
    by_given_strength = best("sliding_force", shear_strength=strength, **QUARTZ)["sliding_force"]
    assert by_given_strength == (approx(force), approx(force), "JKR only")
