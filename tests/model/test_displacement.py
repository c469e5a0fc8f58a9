"""Measured rolling forces in place of the assumed yield displacement, and adhesion hysteresis as a fraction of w."""

from math import inf
from typing import Any

import pytest

from harness import Run
from jkroll import solve
from jkroll.materials.library import known_materials
from jkroll.model.estimate import WORDS, Estimate, estimates
from jkroll.model.frame import Frame
from jkroll.model.measured import POLYSTYRENE, ROLLED, SIO2
from jkroll.model.results import Results
from jkroll.quantities.values import ends_of, value_of
from relative import approx
from tools.measurements import MEASUREMENTS


def frame_of(material: str, radius: Any, **given: Any) -> Frame:
    """Return the frame of a sphere of a material."""
    return Frame({"radius": radius, **given}, known_materials()[material])


def best(scene: Frame, name: str) -> Estimate:
    """Return the best range of a quantity, with its rule in words."""
    estimate = estimates(Results(scene, scene.columns([name])), [name])[name]
    return estimate._replace(by=WORDS[estimate.by])


@pytest.mark.parametrize(("solid", "solids"), [(SIO2, "SiO2"), ("ice-warm", "water ice")])
def test_the_stored_rolling_forces_span_the_rows_of_the_validation_table(solid: str, solids: str) -> None:
    rows = [row for row in MEASUREMENTS if row.quantity == "yield_force" and row.solids == solids]
    rolled = ROLLED[solid]
    assert [value_of(row.given["radius"], "radius") for row in rows] == [approx(rolled.radius)] * len(rows)
    ends = [ends_of(value_of(row.measured, "yield_force")) for row in rows]
    assert (rolled.name, rolled.low, rolled.high) == (
        "yield_force",
        approx(min(low for low, _ in ends)),
        approx(max(high for _, high in ends)),
    )


@pytest.mark.parametrize("gamma", ["20 mJ/m2", "25 mJ/m2", "22±2 mJ/m2"])
@pytest.mark.parametrize("material", ["quartz", "silica-humid"])
def test_best_range_at_the_measured_radius_is_the_measured_force(material: str, gamma: str) -> None:
    """The displacement follows from the force and γ, so the force does not depend on γ, and has no error bar from γ."""
    scene = frame_of(material, 0.95e-6, surface_energy=value_of(gamma, "surface_energy"))
    assert best(scene, "yield_force") == (approx(0.69e-9), approx(1.57e-9), "scaled")


def test_best_range_of_warm_ice_is_the_measured_force_at_any_surface_energy() -> None:
    for energy in ({}, {"surface_energy": 0.1}):
        force = best(frame_of("ice-warm", 1.45e-6, **energy), "yield_force")
        assert force == (approx(9.10e-9), approx(13.86e-9), "scaled")


def test_rolling_results_scale_with_a_power_of_the_measured_force() -> None:
    """The power is the same by every law, though the values at the same ξ differ."""
    scene = frame_of("quartz", 3e-7, energy_ratio=10.0)  # enough energy for rolling to begin at both ends
    parts = [end / scene["yield_force"] for end in best(scene, "yield_force")[:2]]
    powers = {"yield_moment": 1.0, "n_grav": 0.5, "n_roll": -1.0, "roll_energy_quarter_turn": 1.0}
    for name, power in powers.items():
        low, high = sorted(scene[name] * part**power for part in parts)
        assert best(scene, name) == (approx(low), approx(high), "scaled"), name
    assert best(scene, "pull_off_force").by == "Maugis"


def test_for_a_range_of_radii_the_ends_are_those_of_the_least_and_the_largest_radius() -> None:
    wide, small, large = (
        best(frame_of("quartz", value_of(text, "radius")), "yield_force") for text in ("0.1 to 1 um", "0.1um", "1um")
    )
    assert wide == (approx(small.low), approx(large.high), "scaled")


def test_a_sphere_on_a_plane_has_the_yield_angle_of_a_pair_with_its_reduced_radius() -> None:
    """Both have the same contact, and so the same ξ/R."""
    on_plane, pair = frame_of("quartz", 2e-7, radius2=inf), frame_of("quartz", 4e-7)
    ours, theirs = best(on_plane, "yield_angle"), best(pair, "yield_angle")
    assert ours == (approx(theirs.low), approx(theirs.high), "scaled")


def test_polystyrene_has_its_own_measured_displacement() -> None:
    """The displacement is the same by each law, and the forces differ."""
    scene = frame_of("polystyrene", 5e-6, radius2=inf)
    (row,) = [row for row in MEASUREMENTS if row.solids == "polystyrene on glass" and row.given["radius"] == "5 um"]
    assert value_of(row.measured, "yield_displacement") == ROLLED[POLYSTYRENE].low == ROLLED[POLYSTYRENE].high == 42e-9
    assert best(scene, "yield_angle") == (approx(42e-9 / 5e-6), approx(42e-9 / 5e-6), "scaled")
    given = {"material": "polystyrene", "radius": 5e-6, "radius2": inf, "yield_displacement": 42e-9}
    laws: list[dict[str, Any]] = [{}, *({"model": "maugis", "atomic_spacing": spacing} for spacing in (4e-10, 2e-10))]
    forces = [solve("yield_force", **given, **law) for law in laws]
    assert best(scene, "yield_force") == (approx(min(forces)), approx(max(forces)), "scaled")


@pytest.mark.parametrize(
    ("material", "radius", "given", "by"),
    [
        ("quartz", 9.9e-8, {}, "ξ unknown"),  # smaller than the sizes to which measured forces apply
        ("quartz", 3.1e-6, {}, "ξ unknown"),
        ("polystyrene", 2.9e-6, {}, "ξ unknown"),
        ("ice-warm", 0.49e-6, {}, "ξ unknown"),
        ("ice-cold", 1.45e-6, {}, "ξ unknown"),
        ("silica-dry", 1e-6, {}, "ξ unknown"),  # its γ differs from that of the measured spheres
        ("quartz", 1e-6, {"surface_energy": 0.05}, "ξ unknown"),
        ("quartz", 1e-6, {"work_of_adhesion": 0.1}, "ξ unknown"),
        ("quartz", 1e-6, {"yield_displacement": 2e-10}, "Maugis"),
        ("quartz", 1e-6, {"hysteresis_fraction": 0.4}, "Maugis"),
        ("quartz", 1e-6, {"model": "jkr"}, "JKR"),
    ],
)
def test_measured_forces_apply_neither_to_other_pairs_nor_with_given_inputs(
    material: str, radius: float, given: dict[str, Any], by: str
) -> None:
    assert best(frame_of(material, radius).replace(**given), "yield_force").by == by


# --- Hysteresis as a fraction -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("model", ["jkr", "maugis"])
def test_a_hysteresis_fraction_gives_the_same_moment_and_displacement_as_its_energy(model: str) -> None:
    scene = frame_of("quartz", 1e-6).replace(model=model)
    names = ("yield_moment", "yield_displacement")
    by_fraction = scene.replace(hysteresis_fraction=0.4).numbers(*names)
    assert by_fraction == approx(scene.replace(adhesion_hysteresis=0.02).numbers(*names))
    assert scene.replace(yield_displacement=by_fraction["yield_displacement"])["hysteresis_ratio"] == approx(0.4)


def test_hysteresis_given_as_an_energy_or_as_a_fraction_of_w_is_explained_as_a_fraction(run: Run) -> None:
    by_energy = run("n-grav quartz 1um --adhesion-hysteresis 20mJ/m2")
    for text in ("--hysteresis-fraction 40%", "--hysteresis-fraction 0.4"):
        by_fraction = run(f"n-grav quartz 1um {text}")
        assert by_fraction.code == 0
        assert float(by_fraction.out.split()[1]) == approx(float(by_energy.out.split()[1]))
        assert "to roll at ξ = 786.164 pm, 40 % of w must be lost" in run(f"n-grav quartz 1um {text} --explain").out
    explained = run("n-grav quartz 1um --xi 0.786164nm --explain").out
    assert "to roll at ξ = 786.164 pm, 40 % of w must be lost where the contact opens and closes" in explained


@pytest.mark.parametrize(
    ("options", "code"),
    [
        ("--adhesion-hysteresis 20mJ/m2±10%", 0),
        ("--adhesion-hysteresis 0.0001lbf/in±20%", 0),
        ("--hysteresis-fraction 120%", 2),
        ("--hysteresis-fraction 40% --xi 1nm", 2),
    ],
)
def test_hysteresis_may_be_uncertain_but_neither_above_w_nor_given_with_xi(run: Run, options: str, code: int) -> None:
    assert run(f"n-grav quartz 1um {options}").code == code


def test_n_grav_is_proportional_to_the_root_of_the_hysteresis(run: Run) -> None:
    numbers = [run(f"n-grav quartz 1um --hysteresis-fraction {text} --bare --quiet").out for text in ("40%", "10%")]
    assert float(numbers[0]) / float(numbers[1]) == approx(2)
