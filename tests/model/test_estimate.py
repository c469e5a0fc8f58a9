"""The best range of a number: each rule against values that anyone can compute."""

from collections.abc import Mapping
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
    """Return estimates, with the words of their rules."""
    solid = None if material is None else known_materials()[material]
    frame = Frame(given, solid, model=model)
    found = estimates(Results(frame, frame.columns(names.split())), names.split())
    return {name: estimate._replace(by=WORDS[estimate.by]) for name, estimate in found.items()}


def by_maugis(name: str, **given: Any) -> list[float]:
    """Return a quantity by Maugis' law at the atomic spacing, and at half of it."""
    return [solve(name, model="maugis", atomic_spacing=spacing, **given) for spacing in SPACINGS]


QUARTZ: Mapping[str, Any] = {"material": "quartz", "radius": 1e-7}


def test_a_pull_off_force_is_from_maugis_to_lennard_jones() -> None:
    force = best("pull_off_force", **QUARTZ)["pull_off_force"]
    least = min(by_maugis("pull_off_force", **QUARTZ))
    assert force == (approx(least), approx(solve("pull_off_force_lennard_jones", **QUARTZ)), "Maugis")


def test_where_laws_are_within_5_percent_both_are_the_range() -> None:
    frequency = best("vertical_frequency", **QUARTZ)["vertical_frequency"]
    values = [solve("vertical_frequency", **QUARTZ), *by_maugis("vertical_frequency", **QUARTZ)]
    assert frequency == (approx(min(values)), approx(max(values)), "JKR")


def test_an_error_bar_is_in_the_range_and_moves_no_law() -> None:
    """At 1 mm of iron all laws agree within 5 %, however uncertain γ is; at 100 nm each end follows its own law."""
    gamma = value_of("20 to 30 mJ/m2", "surface_energy")
    small: dict[str, Any] = {"radius": 1e-7, "youngs_modulus": 54e9, "poisson_ratio": 0.17}
    low, high, by = best("pull_off_force", surface_energy=gamma, **small)["pull_off_force"]
    least = solve("pull_off_force", model="maugis", atomic_spacing=2e-10, surface_energy=0.02, **small)
    most = solve("pull_off_force_lennard_jones", surface_energy=0.03, **small)
    assert (low, high, by) == (approx(least), approx(most), "Maugis")
    of_iron = best("pull_off_force", "iron", radius=1e-3, surface_energy=value_of("1 to 2 J/m2", "surface_energy"))
    assert of_iron["pull_off_force"].by == "JKR"
    # R_min = R1R2/ξ and δ_α = ξ/R do not depend on a law; a solid with a range of ξ may lack a modulus.
    for name in ("r_min", "yield_angle"):
        displacement = value_of("1 to 3 nm", "yield_displacement")
        assert best(name, radius=1e-7, surface_energy=0.025, yield_displacement=displacement)[name].by == "any law"


@pytest.mark.parametrize("radius", [1e-7, 0.95e-6, 2e-6])
def test_forces_that_rolled_are_scaled_as_the_radius_or_its_power(radius: float) -> None:
    force = best("yield_force", "quartz", radius=radius)["yield_force"]
    scale = radius / 0.95e-6
    both = scale, scale ** (2 / 3)
    assert force == (approx(0.69e-9 * min(both), rel=1e-9), approx(1.57e-9 * max(both), rel=1e-9), "scaled")


def test_what_follows_from_a_displacement_has_that_of_every_law() -> None:
    """ξ is proportional to the force, with another factor for each law."""
    low, high, by = best("r_min", **QUARTZ)["r_min"]
    every = {**QUARTZ, "yield_displacement": 2e-10}
    forces = [solve("yield_force", **every), *by_maugis("yield_force", **every)]
    ends = (0.69e-9 * 1e-7 / 0.95e-6, 1.57e-9 * (1e-7 / 0.95e-6) ** (2 / 3))
    displacements = [max(2e-10 * end / force, 2e-10) for force in forces for end in ends]  # one atom at least
    bends = [1e-7**2 / displacement for displacement in displacements]
    assert (low, high, by) == (approx(min(bends), rel=1e-9), approx(max(bends), rel=1e-9), "scaled")


def test_an_unknown_displacement_is_from_an_atom_to_all_of_the_work() -> None:
    given: dict[str, Any] = {"material": "silica-dry", "radius": 2.5e-7}
    force = best("yield_force", **given)["yield_force"]
    at_an_atom = by_maugis("yield_force", yield_displacement=2e-10, **given)
    ratios = by_maugis("hysteresis_ratio", yield_displacement=2e-10, **given)
    at_most = [value / ratio for value, ratio in zip(at_an_atom, ratios, strict=True)]
    assert force == (approx(min(at_an_atom)), approx(max(at_most)), "ξ unknown")


def test_without_a_contact_one_end_is_open() -> None:
    assert best("r_min", radius=1e-7)["r_min"] == (approx(nan, nan_ok=True), approx(5e-5), "ξ unknown")


def test_adhesion_alone_sets_one_end_or_none() -> None:
    given: dict[str, Any] = {"material": "quartz", "radius": 1e-8, "speed": 20.0}
    found = best("restitution lost_energy", **given)
    assert {estimate.by for estimate in found.values()} == {"adhesion only"}
    assert found["restitution"][:2] == (0.0, 1.0)
    assert isnan(found["lost_energy"].low)
    assert found["lost_energy"].high == approx(solve("lost_energy", **given))


def test_small_hard_spheres_stick_at_1_to_10_times_the_speed_of_jkr_with_a_jump_or_without() -> None:
    """Energies are proportional to the square of the speed. Below the least of these speeds no energy is left."""
    for solid in ("quartz", "silica-dry"):
        given: dict[str, Any] = {"material": solid, "radius": 9e-8}
        found = best("sticking_speed sticking_energy restitution", **given, speed=0.5)
        speed, energy = solve("sticking_speed", **given), solve("sticking_energy", **given)
        assert found["sticking_speed"] == (approx(speed), approx(10 * speed), "measured")
        assert found["sticking_energy"] == (approx(energy), approx(100 * energy), "measured")
        assert found["restitution"] == (0.0, 0.0, "measured")
    of_rubber = best("sticking_speed", "pdms", radius=1e-5)["sticking_speed"]
    assert of_rubber.by == "JKR"


def test_other_losses_lower_what_a_jump_leaves() -> None:
    found = best("restitution", "silica-dry", radius=1e-7, speed=5.0)["restitution"]
    given: dict[str, Any] = {"material": "silica-dry", "radius": 1e-7, "speed": 5.0}
    most = max(solve("restitution", **given), *by_maugis("restitution", **given))
    assert found == (0.0, approx(most), "adhesion only")


def test_a_chain_that_a_displacement_ends_has_the_other_end() -> None:
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
def test_energies_to_separate_are_from_maugis_to_lennard_jones_in_smooth_contacts(
    name: str, by_lennard_jones: str
) -> None:
    low, high, by = best(name, **QUARTZ)[name]
    most = solve(by_lennard_jones, **QUARTZ)
    assert (low, high, by) == (approx(min(by_maugis(name, **QUARTZ))), approx(most), "Maugis")
    assert low > solve(name, **QUARTZ)


def test_energies_with_a_jump_are_by_maugis_alone() -> None:
    """The Tabor parameter of a millimetre of quartz is 2.9."""
    big = {**QUARTZ, "radius": 1e-3}
    energy, ends = best("pull_off_work", **big)["pull_off_work"], by_maugis("pull_off_work", **big)
    own = solve("pull_off_work", **big)
    assert energy == (approx(min(own, *ends)), approx(max(own, *ends)), "JKR")


def test_aggregates_break_up_as_their_contacts_do() -> None:
    """The energy of Wada's fit is proportional to the work to part two spheres, and the speed to its root."""
    crowd = {**QUARTZ, "density": 2600.0, "monomers": 1000.0}
    parted = best("pull_off_work", **crowd)["pull_off_work"].high / solve("pull_off_work", **crowd)
    for name, power in (("disruption_energy", 1), ("disruption_speed", 0.5)):
        assert best(name, **crowd)[name].high / solve(name, **crowd) == approx(parted**power)


def test_without_a_modulus_a_pull_off_force_is_from_jkr_to_dmt() -> None:
    """3πγR and 4πγR, R = R1/2."""
    force = best("pull_off_force", radius=1e-7, surface_energy=0.025)["pull_off_force"]
    assert force == (approx(3 * pi * 0.025 * 0.5e-7), approx(4 * pi * 0.025 * 0.5e-7), "JKR to DMT")


@pytest.mark.parametrize(("radius", "speed"), [(0.25e-6, 1.909), (0.6e-6, 1.2)])
@pytest.mark.parametrize("solid", ["quartz", "silica-dry", "silica-humid"])
def test_silica_sticks_to_a_plane_as_it_was_measured(solid: str, radius: float, speed: float) -> None:
    found = best("sticking_speed", solid, radius=radius, radius2=inf)["sticking_speed"]
    assert found == (approx(0.7 * speed, rel=1e-3), approx(1.3 * speed, rel=1e-3), "measured")


@pytest.mark.parametrize("other", [{"radius": 0.2e-6}, {"radius": 0.7e-6}, {"radius2": 0.5e-6}])
def test_speeds_that_stuck_are_carried_in_proportion_to_the_law(other: dict[str, Any]) -> None:
    """The speed by JKR has the same ratio to the speeds of spheres of 0.25 and 0.6 µm on a plane."""
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


@pytest.mark.parametrize("other", [{"radius": 4e-8}, {"viscous_time": 1e-12}, {"material": "polystyrene"}])
def test_what_stuck_otherwise_was_not_measured(other: Mapping[str, Any]) -> None:
    """Hard spheres were seen to stick at 1 to 10 times the speed by JKR, unless another loss is given."""
    given = {"material": "quartz", "radius": 0.5e-6, "radius2": inf, **other}
    speed, found = solve("sticking_speed", **given), best("sticking_speed", **given)["sticking_speed"]
    assert (found.by == "measured") == ("viscous_time" not in other)
    if found.by == "measured":
        assert found[:2] == (approx(speed), approx(10 * speed))


@pytest.mark.parametrize(
    ("model", "spacing", "word"),
    [("jkr", {}, "JKR"), ("maugis", {"atomic_spacing": 3e-10}, "Maugis"), ("dmt", {}, "DMT")],
)
def test_a_law_that_is_given_decides(model: str, spacing: dict[str, Any], word: str) -> None:
    force = solve("pull_off_force", model=model, **spacing, **QUARTZ)
    estimate = best("pull_off_force", model=model, **spacing, **QUARTZ)["pull_off_force"]
    assert estimate == (approx(force), approx(force), word)


def test_a_law_that_is_given_leaves_the_atomic_spacing_open() -> None:
    estimate = best("pull_off_force", model="maugis", **QUARTZ)["pull_off_force"]
    ends = by_maugis("pull_off_force", **QUARTZ)
    assert estimate == (approx(min(ends)), approx(max(ends)), "z0 assumed")


def test_an_atomic_spacing_that_is_given_is_the_only_one() -> None:
    estimate = best("pull_off_force", atomic_spacing=3e-10, **QUARTZ)["pull_off_force"]
    least = solve("pull_off_force", model="maugis", atomic_spacing=3e-10, **QUARTZ)
    most = solve("pull_off_force_lennard_jones", atomic_spacing=3e-10, **QUARTZ)
    assert estimate == (approx(least), approx(most), "Maugis")


def test_what_every_law_computes_alike_is_of_any_law() -> None:
    """The Rayleigh time has no law; the Tabor parameter has the atomic spacing, which is known to a factor of two."""
    found = best("rayleigh_time tabor_parameter", **QUARTZ)
    assert found["rayleigh_time"] == (*2 * (approx(solve("rayleigh_time", **QUARTZ)),), "any law")
    tabor = solve("tabor_parameter", **QUARTZ)
    assert found["tabor_parameter"] == (approx(tabor), approx(2 * tabor), "z0 assumed")


def test_conventions_are_exact_and_laws_have_none() -> None:
    found = best("fold_energy sticking_speed_pencil_code pull_off_force_dmt", **QUARTZ)
    assert found["fold_energy"] == (*2 * (approx(solve("fold_energy", **QUARTZ)),), "definition")
    assert found["sticking_speed_pencil_code"].by == "definition"
    assert found["pull_off_force_dmt"].by == "–"


def test_many_rows_have_the_ranges_of_each() -> None:
    radii = numpy.geomspace(1e-9, 1e-3, 60)
    names = "pull_off_force yield_force r_min sticking_speed pull_off_work rolling_frequency contact_radius_at_load"
    solid = known_materials()["quartz"]
    frame = Frame({"radius": radii}, solid)
    every = estimates(Results(frame, frame.shown(names.split(), names.split())), names.split())
    for row, radius in enumerate(radii.tolist()):
        single = Frame({"radius": radius}, solid)
        found = estimates(Results(single, single.shown(names.split(), names.split())), names.split())
        for name in names.split():
            of_row = [numpy.broadcast_to(part, radii.shape)[row] for part in every[name]]
            expected = found.get(name, Estimate(nan, nan, 0))
            assert of_row == [approx(part, rel=1e-12, nan_ok=True) for part in expected], (name, radius)


def test_friction_that_is_assumed_is_known_to_an_order_of_magnitude() -> None:
    """Forces are proportional to τ, energies to τ². A contact that peels off before it slides does so at any τ."""
    names = ("sliding_force", "sliding_energy", "sliding_or_peeling_force", "peeling_force")
    found = best(" ".join(names), **QUARTZ)
    strength = solve("shear_strength", **QUARTZ)
    for name in names[:3]:
        ends = [solve(name, shear_strength=strength * factor, **QUARTZ) for factor in (1 / 3, 3)]
        assert found[name] == (approx(ends[0]), approx(ends[1]), "τ assumed")
    assert found["sliding_force"].high == approx(9 * found["sliding_force"].low)
    assert found["peeling_force"].by == "JKR only"
    given = best("sliding_force", shear_strength=strength, **QUARTZ)["sliding_force"]
    assert given == (approx(given.low), approx(given.low), "JKR only")
