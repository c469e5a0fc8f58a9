"""Uncertainties: compared with sampling and power laws, at turning points, and of inputs that vary together."""

import csv
import io
import json
import math
import re
from collections.abc import Mapping
from pathlib import Path
from random import Random
from types import SimpleNamespace
from typing import Any

import numpy
import pint
import pytest
from numpy import cbrt

from harness import Run
from jkroll import Interval, Material, Materials, Measured, infer, known_materials, solve
from jkroll.errors import BadRequest
from jkroll.model.frame import Frame
from jkroll.model.uncertainty import error_bars
from jkroll.quantities.values import QuantityError, Uncertain, value_of
from relative import approx
from scenes import QUARTZ


def combined(
    name: str, given: Mapping[str, float], uncertain: Mapping[str, Uncertain], *materials: Material
) -> SimpleNamespace:
    """Return a quantity with its uncertainty, and the shares of its sources."""
    scene = Frame({**given, **uncertain}, *materials)
    bar = error_bars(scene, [name])[name]
    return SimpleNamespace(uncertainty=bar.of(scene[name]), shares=bar.shares)


def assert_spans(span: Uncertain, values: Any, *, inner: float = 0.01, outer: float = 0.0) -> None:
    """Check the ends of a range: short of the extreme values by `inner` of its width at most, or beyond by `outer`."""
    width = span.high - span.low
    assert max(values) - inner * width <= span.high <= max(values) + (outer + 1e-12) * width
    assert min(values) - (outer + 1e-12) * width <= span.low <= min(values) + inner * width


def relative(value: float, part: float) -> Measured:
    """Return a value with a relative uncertainty."""
    return Measured(value, part * value, part * value)


@pytest.mark.parametrize(
    ("name", "exponents"),
    [
        ("pull_off_force", {"radius": 1, "surface_energy": 1}),
        ("contact_radius", {"radius": 2 / 3, "surface_energy": 1 / 3, "youngs_modulus": -1 / 3}),
        ("approach", {"radius": 1 / 3, "surface_energy": 2 / 3, "youngs_modulus": -2 / 3}),
        ("sticking_energy", {"radius": 4 / 3, "surface_energy": 5 / 3, "youngs_modulus": -2 / 3}),
        ("rolling_frequency", {"radius": -3 / 2, "surface_energy": 1 / 2, "density": -1 / 2}),
        ("yield_moment", {"radius": 1, "surface_energy": 1, "yield_displacement": 1}),
    ],
)
def test_small_uncertainties_follow_the_power_law(name: str, exponents: dict[str, float]) -> None:
    given = {**QUARTZ, "yield_displacement": 2e-10}
    sources = [source for source in given if source != "poisson_ratio"]
    parts = {source: 1e-4 * number for number, source in enumerate(sources, 1)}
    result = combined(name, given, {source: relative(given[source], part) for source, part in parts.items()})
    squares = {source: (exponent * parts[source]) ** 2 for source, exponent in exponents.items()}
    expected = math.sqrt(sum(squares.values())) * result.uncertainty.value
    assert isinstance(result.uncertainty, Measured)
    assert result.uncertainty.plus == result.uncertainty.minus == approx(expected, rel=1e-3)
    for source, square in squares.items():
        assert result.shares[source] == approx(square / sum(squares.values()), rel=1e-2)
    assert sum(result.shares.values()) == approx(1, rel=1e-12)


def test_unequal_sides_of_an_uncertainty_are_given_separately() -> None:
    result = combined("sticking_energy", QUARTZ, {"surface_energy": relative(0.025, 0.3)}).uncertainty
    assert isinstance(result, Measured)
    assert result.plus == approx((1.3 ** (5 / 3) - 1) * result.value, rel=1e-12)
    assert result.minus == approx((1 - 0.7 ** (5 / 3)) * result.value, rel=1e-12)


def test_the_lower_side_may_be_the_longer_one() -> None:
    """Near pull-off, √(1 + P/P_c) falls by more than it rises."""
    force = solve("pull_off_force", **QUARTZ)
    result = combined("load_margin", QUARTZ, {"load": Measured(-0.75 * force, 0.2 * force, 0.2 * force)}).uncertainty
    assert isinstance(result, Measured)
    assert result.minus == approx(0.5 - math.sqrt(0.05), rel=1e-12)
    assert result.plus == approx(math.sqrt(0.45) - 0.5, rel=1e-12)


@pytest.mark.parametrize(
    ("name", "minus", "plus"), [("contact_modulus", 0, 1 / 0.99 - 1), ("approach", 1 - 0.99 ** (2 / 3), 0)]
)
def test_a_side_is_zero_if_both_ends_change_the_result_in_one_direction(name: str, minus: float, plus: float) -> None:
    """1 − ν² is largest at ν = 0."""
    result = combined(name, {**QUARTZ, "poisson_ratio": 0.0}, {"poisson_ratio": Measured(0.0, 0.1, 0.1)}).uncertainty
    assert isinstance(result, Measured)
    assert result.minus == approx(minus * result.value, rel=1e-9)
    assert result.plus == approx(plus * result.value, rel=1e-9)


def test_quadrature_agrees_with_sampling() -> None:
    random = Random(7)
    uncertain = {"radius": relative(1e-7, 0.05), "surface_energy": relative(0.025, 0.08)}
    result = combined("well_energy", QUARTZ, uncertain).uncertainty
    drawn = {}
    for name, source in uncertain.items():
        drawn[name] = [random.gauss(source.value, source.plus) for _ in range(40_000)]
    samples = sorted(solve("well_energy", **{**QUARTZ, **drawn}))
    assert isinstance(result, Measured)
    assert result.high == approx(samples[round(0.8413 * len(samples))], rel=0.01)
    assert result.low == approx(samples[round(0.1587 * len(samples))], rel=0.01)


@pytest.mark.parametrize(
    ("name", "given", "ranges"),
    [
        ("rolling_frequency", QUARTZ, {"radius2": Interval(2.2e-7, 1.2e-7, 3.2e-7)}),  # Eq (40) as a function of R2
        ("rolling_frequency", QUARTZ, {"radius2": Interval(1.5e-7, 1e-7, 4e-7), "density": Interval(2e3, 1e3, 3e3)}),
        ("approach_at_load", {**QUARTZ, "load": 5e-8}, {"radius": Interval(5e-7, 1e-7, 2e-6)}),
        ("contact_modulus", QUARTZ, {"poisson_ratio": Interval(0.05, -0.2, 0.3)}),
    ],
)
def test_turning_points_inside_a_range_are_included(
    name: str, given: dict[str, float], ranges: dict[str, Interval]
) -> None:
    result = combined(name, given, ranges).uncertainty
    assert isinstance(result, Interval)
    random = Random(3)
    drawn = {}
    for source, span in ranges.items():
        drawn[source] = [random.uniform(span.low, span.high) for _ in range(20_000)]
    scene: dict[str, Any] = {**given, **drawn}
    assert_spans(result, solve(name, **scene), outer=0.02)


def test_a_range_of_loads_around_0_is_not_taken_for_no_load() -> None:
    """Without load, the rolling force does not depend on the radius; under a load it does, by Eqs (5) and (26)."""
    ranges = {"load": Interval(0.0, -4e-9, 4e-9), "radius": Interval(1.2e-7, 8e-8, 1.6e-7)}

    def force(load: float, radius: float) -> float:
        pull_off = 3 * math.pi * 0.05 * radius / 2 / 2
        factor = (1 + math.sqrt(1 + load / pull_off)) / 2
        return 6 * math.pi * 0.025 * 2e-10 * factor

    result = combined("yield_force", QUARTZ, ranges).uncertainty
    ends = sorted(force(load, 8e-8) for load in (-4e-9, 4e-9))
    assert [result.low, result.high] == approx(ends, rel=1e-12)
    scene: dict[str, Any] = {name: value for name, value in QUARTZ.items() if name != "yield_displacement"} | ranges
    displacement = infer("xi", measured={"yield_force": 9e-11}, **scene)
    assert [displacement.high, displacement.low] == approx([2e-10 * 9e-11 / end for end in ends], rel=1e-12)


@pytest.mark.parametrize(
    ("name", "spans", "extreme"),
    [
        ("sliding_force", [(1e9, 2e9), (1.1e9, 9e9)], 2e9),
        ("sliding_force", [(1e9, 2e9), (1e9, 9e9)], 2e9),
        ("sliding_displacement", [(930e6, 1030e6), (520e6, 970e6)], 930e6),
        ("sliding_displacement", [(2e9, 10e9), (1e9, 9e9)], 2e9),
        ("sliding_displacement", [(0.3e9, 30e9), (2e9, 2.1e9)], 2e9),
        ("sliding_force", [(1e7, 1e12), (1e9, 1.1e9)], 1.1e9),
    ],
)
def test_the_ridge_of_a_quantity_that_the_weaker_body_sets_is_found(
    name: str, spans: list[tuple[float, float]], extreme: float
) -> None:
    """The quantity is largest where E1 = E2; on either side of this ridge, another body is the weaker one."""
    given: dict[str, Any] = {"radius": 1e-6, "surface_energy": 0.05, "poisson_ratio": 0.2}
    moduli = ("youngs_modulus", "youngs_modulus2")
    ranges: dict[str, Any] = {each: Interval(sum(span) / 2, *span) for each, span in zip(moduli, spans, strict=True)}
    known = solve(name, **{**given, **dict.fromkeys(moduli, extreme)})
    result = solve(name, **given, **ranges)
    assert known - 0.02 * (known - result.low) <= result.high <= known * (1 + 1e-12)


@pytest.mark.parametrize("name", ["twisting_energy", "sliding_displacement", "peeling_over_sliding", "sliding_force"])
@pytest.mark.parametrize("count", [2, pytest.param(3, marks=pytest.mark.slow)])
def test_ranges_agree_with_those_of_a_dense_grid(name: str, count: int) -> None:
    """The weaker body has the smaller E/(1 + ν); within these ranges, either body can be weaker."""
    given: dict[str, Any] = {"radius": 1e-6, "surface_energy": 0.05, "surface_energy2": 0.08, "poisson_ratio2": 0.2}
    given |= {"youngs_modulus2": 4e9}
    spans = {"youngs_modulus": (1.9e9, 4.8e9), "poisson_ratio": (0.03, 0.46), "youngs_modulus2": (2.2e9, 5e9)}
    ranges = {each: Interval(sum(span) / 2, *span) for each, span in [*spans.items()][:count]}
    result = solve(name, **{**given, **ranges})
    axes = [numpy.linspace(span.low, span.high, 201 if count == 2 else 41) for span in ranges.values()]
    grid = dict(zip(ranges, numpy.meshgrid(*axes), strict=True))
    values = solve(name, **{**given, **grid})
    assert_spans(result, values.ravel(), outer=0.03)


def test_an_input_copied_to_sphere_2_varies_with_that_of_sphere_1() -> None:
    surface = {"surface_energy": relative(0.025, 0.1)}
    assert combined("pull_off_force", QUARTZ, surface).uncertainty.high == approx(1.1 * 1.1780972450961723e-8)
    both = {**surface, "surface_energy2": relative(0.025, 0.1)}
    result = combined("pull_off_force", {**QUARTZ, "surface_energy2": 0.025}, both).uncertainty
    assert isinstance(result, Measured)
    assert result.plus / result.value == approx(0.1 / math.sqrt(2), rel=0.01)


def test_both_spheres_of_one_material_vary_together() -> None:
    material = known_materials()["quartz"]._replace(uncertainties={"surface_energy": relative(0.025, 0.1)})
    once = combined("pull_off_force", {"radius": 1e-7}, {}, material)
    twice = combined("pull_off_force", {"radius": 1e-7}, {}, material, material)
    assert once.uncertainty.high == approx(twice.uncertainty.high, rel=1e-15)
    apart = combined("pull_off_force", {"radius": 1e-7}, {}, material, material._replace(name="another"))
    assert apart.uncertainty.high < once.uncertainty.high
    stated = Frame({"radius": 1e-7, "surface_energy": 0.03}, material)
    assert error_bars(stated, ["pull_off_force"]) == {}


def test_too_many_ranges_are_refused() -> None:
    more = {"radius2": 1e-7, "youngs_modulus2": 1e10, "surface_energy2": 0.02, "density2": 1e3, "load": 1e-9}
    many = {name: Interval(value, 0.9 * value, 1.1 * value) for name, value in {**QUARTZ, **more}.items()}
    with pytest.raises(BadRequest, match="go together"):
        combined("vertical_frequency", {**QUARTZ, **more}, many)


def test_ranges_and_standard_uncertainties_together_give_a_range() -> None:
    """The force is proportional to γR: it ends at half and twice the radius, each extended by 10 % for γ."""
    mixed: dict[str, Uncertain] = {"radius": Interval(1e-7, 5e-8, 2e-7), "surface_energy": relative(0.025, 0.1)}
    result = combined("pull_off_force", QUARTZ, mixed)
    assert isinstance(result.uncertainty, Interval)
    ends = result.uncertainty.low / result.uncertainty.value, result.uncertainty.high / result.uncertainty.value
    assert ends == approx((0.5 * 0.9, 2 * 1.1))
    assert list(result.shares) == ["radius", "surface_energy"]


def test_standard_uncertainties_add_in_quadrature_at_each_corner_of_the_ranges() -> None:
    """Errors of 3 % and 4 % of the force make 5 %: F ∝ (γ1 γ2)^(1/2) R at both ends of R."""
    mixed: dict[str, Uncertain] = {
        "radius": Interval(1e-7, 0.9e-7, 1.2e-7),
        "surface_energy": relative(0.025, 0.06),
        "surface_energy2": relative(0.03, 0.08),
    }
    result = combined("pull_off_force", QUARTZ, mixed)
    assert result.uncertainty.low / result.uncertainty.value == approx(0.9 * 0.95, rel=2e-4)
    assert result.uncertainty.high / result.uncertainty.value == approx(1.2 * 1.05, rel=2e-4)


def test_a_standard_uncertainty_does_not_narrow_the_range_of_a_quantity_with_a_ridge() -> None:
    """The softer body sets the shear strength, so the force is largest inside the box, where both are alike."""
    given: dict[str, Any] = {"radius": 1e-6, "poisson_ratio": 0.2, "poisson_ratio2": 0.2}
    moduli = {"youngs_modulus": "1 to 10 GPa", "youngs_modulus2": "1 to 30 GPa"}
    exact = solve("sliding_force", **given, **moduli, surface_energy=0.025)
    uncertain = solve("sliding_force", **given, **moduli, surface_energy="25±0.01 mJ/m2")
    assert exact.high > 1.25 * solve(
        "sliding_force", **given, surface_energy=0.025, youngs_modulus=1e10, youngs_modulus2=3e10
    )
    assert uncertain.high == approx(exact.high, rel=0.03)
    assert uncertain.low == approx(exact.low, rel=1e-3)


def test_shares_of_both_kinds_are_those_of_the_widths() -> None:
    """γ changes the force by 40 % from end to end, and the radius by 20 %."""
    mixed: dict[str, Uncertain] = {"radius": Interval(1e-7, 9e-8, 1.1e-7), "surface_energy": relative(0.025, 0.2)}
    assert combined("pull_off_force", QUARTZ, mixed).shares == approx({"surface_energy": 2 / 3, "radius": 1 / 3})


def test_both_kinds_of_uncertainty_of_a_material_enter_a_result() -> None:
    """The contact radius is proportional to (γ/E)^(1/3)."""
    both: dict[str, Uncertain] = {"surface_energy": relative(0.025, 0.1), "youngs_modulus": Interval(54e9, 50e9, 60e9)}
    material = known_materials()["quartz"]._replace(uncertainties=both)
    bar = error_bars(Frame({"radius": 1e-7}, material), ["contact_radius"])["contact_radius"]
    value = Frame({"radius": 1e-7}, material)["contact_radius"]
    for_gamma = (cbrt(1.1) - cbrt(0.9)) / 2
    assert bar.sides["low"] / value == approx(cbrt(54 / 60) * (1 - for_gamma))
    assert bar.sides["high"] / value == approx(cbrt(54 / 50) * (1 + for_gamma))
    assert list(bar.shares) == ["surface_energy", "youngs_modulus"]


def test_a_note_explains_a_missing_uncertainty_where_an_end_has_no_value(run: Run) -> None:
    answer = json.loads(run("contact", "quartz", "100nm", "--load", "-10±2nN", "--json").out)
    results = {result["name"]: result for result in answer["results"]}
    assert "uncertainty" not in results["approach_at_load"]
    assert any(
        "a, δ" in note and "no uncertainty" in note and "breaks this contact" in note for note in answer["notes"]
    )


@pytest.mark.parametrize(("load", "gamma"), [("-10±1nN", "25mJ/m2"), ("-9nN", "25±4mJ/m2"), ("-9±0.8nN", "25±3mJ/m2")])
def test_the_share_of_random_values_without_a_contact_is_reported(run: Run, load: str, gamma: str) -> None:
    """At the ends of each uncertainty alone there is a contact, but for 4 to 7 % of random values there is none."""
    words = ["contact", "quartz", "100nm", "--load", load, "--gamma", gamma]
    random = Random(f"{load} {gamma}")

    def draw(name: str, text: str) -> list[float]:
        value = value_of(text, name)
        middle, spread = (value, 0.0) if isinstance(value, float) else (value.value, value.high - value.value)
        return [random.gauss(middle, spread) for _ in range(20_000)]

    drawn: dict[str, Any] = {"load": draw("load", load), "surface_energy": draw("surface_energy", gamma)}
    radii = solve("contact_radius_at_load", material="quartz", radius=1e-7, **drawn)
    part = numpy.isnan(radii).mean()
    notes = json.loads(run(*words, "--json").out)["notes"]
    (note,) = [note for note in notes if "beyond pull-off" in note]
    assert float(note.partition(" % ")[0].split()[-1]) == approx(100 * part, rel=0.2)
    farther = [words[0], "quartz", "100nm", "--load", "-5±1nN", "--json"]
    assert not any("beyond pull-off" in note for note in json.loads(run(*farther).out)["notes"])


def test_formats_other_than_bare_give_the_uncertainty_of_a_result(run: Run) -> None:
    words = ["pull-off", "quartz", "100nm", "--gamma", "25±5mJ/m2", "--quiet"]
    answer = json.loads(run(*words, "--json").out)
    result = answer["results"][0]
    assert result["uncertainty"] == {"kind": "standard", "minus": 2.356194490192344e-09, "plus": 2.356194490192344e-09}
    assert answer["uncertainties"] == {"surface_energy": {"kind": "standard", "minus": 0.005, "plus": 0.005}}
    (row,) = csv.DictReader(io.StringIO(run(*words, "--csv").out))
    assert row["pull_off_force_plus [N]"] == row["pull_off_force_minus [N]"] == "2.356194490192344e-9"
    assert run(*words, "--bare").out == "1.1780972450961723e-8\n"
    table = run(*words, terminal=True).out
    # Maugis' 14.2 nN at half the atomic spacing minus 18 %; Lennard-Jones' 15.3 nN, proportional to γ, plus 20 %.
    assert re.search(r" 12–18 +Maugis +11\.78 +nN", table)
    assert "γ = 25 ± 5 mJ/m²" in table
    assert "  shares    γ1 100%\n" in run(*words, "--explain").out
    rows = [*csv.DictReader(io.StringIO(run("pull-off", "quartz", "100nm,100±5nm", "--csv").out))]
    assert [row["pull_off_force_plus [N]"] for row in rows] == ["", "5.890486225480867e-10"]
    spans = run("pull-off", "quartz", "80 to 120 nm", "--quiet", "--to", "nN", "--digits", "3").out.splitlines()[:3]
    assert spans == ["pull_off_force 11.8 nN", "pull_off_force_low 9.42 nN", "pull_off_force_high 14.1 nN"]


def test_solve_and_infer_return_uncertain_values() -> None:
    assert isinstance(solve("pull_off_force", material="quartz", radius=Measured(1e-7, 5e-9, 5e-9)), Measured)
    spans = solve(["r_min", "n_grav"], material="quartz", radius="80 to 120 nm", yield_displacement=2e-10)
    assert spans["r_min"].high == approx(1.2e-7**2 / 2e-10)
    assert isinstance(infer("xi", measured={"r_min": "50±5 um"}, radius=1e-7), Measured)


def test_lists_of_uncertain_values_are_refused() -> None:
    for energies in (["25±5 mJ/m2", "30 mJ/m2"], [Measured(0.025, 0.005, 0.005)]):
        with pytest.raises(QuantityError, match="holds uncertain values, and arrays have no uncertainty"):
            solve("pull_off_force", surface_energy=energies, radius="100 nm")


@pytest.mark.parametrize("low", [-0.3, -0.01, -0.002, -1e-4])
def test_a_turning_point_next_to_an_end_of_a_range_is_found(low: float) -> None:
    """E* is least at ν = 0, however near 0 is to an end of the range."""
    given: dict[str, Any] = {"youngs_modulus": 1e9, "poisson_ratio": Interval((low + 0.4) / 2, low, 0.4)}
    assert_spans(solve("contact_modulus", **given), [0.5e9, 0.5e9 / (1 - 0.4**2)])


@pytest.mark.parametrize("gamma", ["25±5 mJ/m2", "20 to 30 mJ/m2"])
def test_a_change_by_rounding_is_not_an_uncertainty(gamma: str) -> None:
    assert isinstance(solve("energy_over_sticking", **{**QUARTZ, "surface_energy": gamma}), float)


@pytest.mark.parametrize("radius", ["0.8 to 1.2 um", "1 um ± 20%"])
def test_a_material_s_displacement_has_its_range_at_each_radius(tmp_path: Path, radius: str) -> None:
    """The force is proportional to ξ, which grows as R^(2/3) or as R: the least and the largest ξ grow as R."""
    path = tmp_path / "mine.toml"
    path.write_text(
        '[materials.bead]\nsurface_energy = "25 mJ/m2"\nyield_displacement = { value = "2 nm", radius = "1 um" }\n'
    )
    bead: dict[str, Any] = {"material": "bead", "materials": Materials(path)}
    force = solve("yield_force", radius=radius, **bead)
    assert (force.low / force.value, force.high / force.value) == approx((0.8, 1.2))
    assert solve("r_min", radius="0.8 to 1.2 um", yield_displacement=2e-9, **bead).low == approx(320e-6, rel=1e-9)


def test_a_radius_inferred_from_a_rolling_force_has_the_error_bar_of_the_force(tmp_path: Path) -> None:
    """The range of the material's ξ depends on the radius, which is unknown, so ξ has its middle value."""
    path = tmp_path / "mine.toml"
    path.write_text(
        '[materials.bead]\nsurface_energy = "25 mJ/m2"\nyield_displacement = { value = "3 to 5 nm", radius = "2 um" }\n'
    )
    bead: dict[str, Any] = {"material": "bead", "materials": Materials(path)}
    force = solve("yield_force", radius=1e-6, **bead)
    radius = infer("radius", measured={"yield_force": Measured(force, 0.1 * force)}, **bead)
    assert radius.value == approx(1e-6)
    assert radius.plus == approx(1.1**1.2 * 1e-6 - 1e-6, rel=0.05)


@pytest.mark.parametrize("size", [1e29, 1e-29])
def test_shares_are_right_even_if_squares_of_changes_are_beyond_the_range_of_doubles(size: float) -> None:
    scene = Frame({"radius": Measured(size, 0.1 * size), "density": Measured(size, 0.5 * size)})
    inertia = error_bars(scene, ["moment_of_inertia"])["moment_of_inertia"]
    assert inertia.shares == approx({"radius": 0.5, "density": 0.5}, rel=0.05)


def test_bare_numbers_of_a_force_curve_have_no_error_bars(run: Run) -> None:
    rows = run("contact quartz 100±5nm --curve --bare --quiet").out.splitlines()
    assert {row.count("\t") for row in rows} == {1}


# --- Measurements of pint ---------------------------------------------------------------------------------------------


def test_measurements_of_pint_are_read_in_any_unit() -> None:
    pytest.importorskip("uncertainties")
    units: Any = pint.application_registry
    energy = units.Measurement(25, 5, "mJ/m^2")
    force = solve("pull_off_force", surface_energy=energy, radius="100 nm")
    assert force == solve("pull_off_force", surface_energy=units.Quantity(25, "mJ/m^2").plus_minus(5), radius="100 nm")
    for other in ("25±5 mJ/m2", units.Measurement(25, 5, "erg/cm^2")):
        found = solve("pull_off_force", surface_energy=other, radius="100 nm")
        assert [found.value, *found.sides.values()] == approx([force.value, *force.sides.values()], rel=1e-15)
    assert force.plus == approx(3 * math.pi * 0.005 * 50e-9)
    both = solve("pull_off_force", surface_energy=energy, radius=units.Measurement(100, 10, "nm"))
    assert both.plus == approx(both.value * math.hypot(0.2, 0.1))
    given: dict[str, Any] = {"radius": "2 um", "radius2": "plane"}
    found = infer("gamma", measured={"pull_off_force": units.Measurement(300, 20, "nN")}, **given)
    again = infer("gamma", measured={"pull_off_force": "300±20 nN"}, **given)
    assert [found.value, *found.sides.values()] == approx([again.value, *again.sides.values()], rel=1e-14)


@pytest.mark.filterwarnings("ignore:This function will be removed:DeprecationWarning")  # from pint, in its texts
@pytest.mark.parametrize(
    ("uncertainty", "unit", "reason"),
    [(5, "N", "has the wrong dimension"), (15, "mJ/m^2", "has an uncertainty of half the value or more")],
)
def test_measurements_of_pint_with_a_wrong_unit_or_a_large_error_are_refused(
    uncertainty: float, unit: str, reason: str
) -> None:
    pytest.importorskip("uncertainties")
    units: Any = pint.application_registry
    energy = units.Measurement(25, uncertainty, unit)
    with pytest.raises(QuantityError, match=reason):
        solve("pull_off_force", surface_energy=energy, radius="100 nm")
