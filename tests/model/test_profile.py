"""The profile of a true sphere: its results, where it is refused, and the notes on a wide contact."""

import json
import math
from typing import Any

import numpy as np
import pytest

from harness import Run
from jkroll import JkrollError, answer, infer, solve
from jkroll.errors import BadRequest
from jkroll.model.reasons import Failure, MissingInput, NotInLaw
from relative import approx

# A rigid sphere on a gel, E* = 2 MPa and w/(E*R) = 0.01.
GEL: dict[str, Any] = {
    "radius": 1e-6, "radius2": math.inf, "youngs_modulus": math.inf, "youngs_modulus2": 1.5e6, "poisson_ratio2": 0.5,
    "work_of_adhesion": 0.02,
}  # fmt: skip
WORDS = "1um --radius2 plane --young rigid --young2 1.5MPa --poisson2 0.5"
PARABOLOID = 1.5 * math.pi * 0.02 * 1e-6  # its pull-off force


# --- Numbers ----------------------------------------------------------------------------------------------------------


def test_a_sphere_has_less_pull_off_force_and_contact_than_a_paraboloid() -> None:
    """At w/(E*R) = 0.01 a sphere has 0.95900 of a paraboloid's pull-off force, and a0 is 0.4855 R, not 0.5209 R."""
    assert solve("pull_off_force", **GEL, profile="sphere") == approx(0.95900 * PARABOLOID, rel=1e-5)
    assert solve("contact_radius", **GEL, profile="sphere") == approx(0.4855e-6, rel=1e-4)
    assert solve("pull_off_force", **GEL) == approx(PARABOLOID, rel=1e-12)
    assert solve("pull_off_force", **GEL, profile="paraboloid") == solve("pull_off_force", **GEL)


@pytest.mark.parametrize("load", [-8e-8, -1e-8, 0.0, 1e-9, 1e-6])
def test_state_at_a_load_is_that_at_its_approach(load: float) -> None:
    names = ["approach_at_load", "contact_radius_at_load", "stiffness"]
    approach, radius, stiffness = solve(names, **GEL, load=load, profile="sphere").values()
    back = solve(["load", "contact_radius_at_load"], **GEL, approach_at_load=approach, profile="sphere")
    assert back["load"] == approx(load, rel=1e-9, abs=1e-20)
    assert back["contact_radius_at_load"] == approx(radius, rel=1e-9)
    steps = [solve("load", **GEL, approach_at_load=approach + step, profile="sphere") for step in (-1e-12, 1e-12)]
    assert stiffness == approx((steps[1] - steps[0]) / 2e-12, rel=1e-5)


def test_work_of_adhesion_inferred_with_a_paraboloid_is_too_low() -> None:
    measured = {"pull_off_force": 0.95900 * PARABOLOID}
    known = {name: value for name, value in GEL.items() if name != "work_of_adhesion"}
    assert infer("w", measured=measured, **known, profile="sphere") == approx(0.02, rel=2e-5)
    assert infer("w", measured=measured, **known) == approx(0.9590 * 0.02, rel=1e-5)


def test_arrays_of_radii_give_the_pull_off_force_of_each_sphere() -> None:
    radii = np.array([1e-6, 1e-4, 1e-2])
    forces = solve("pull_off_force", **{**GEL, "radius": radii}, profile="sphere") / (1.5 * math.pi * 0.02 * radii)
    assert forces.tolist() == approx([0.95900, 0.99801, 0.99991], rel=1e-5)


# --- Where a sphere is refused ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "other",
    [
        {"radius2": 1e-3},  # two spheres
        {"youngs_modulus": 1.4e8, "poisson_ratio": 0.3},  # a soft sphere
        {"poisson_ratio2": 0.44},  # a plane that is compressible
    ],
)
def test_sphere_is_refused_for_two_spheres_soft_spheres_and_compressible_planes(other: dict[str, float]) -> None:
    with pytest.raises(Failure, match=r"rigid sphere \(E1 ≥ 100 E2\) on a plane of ν2 ≥ 0.45"):
        solve("pull_off_force", **{**GEL, **other}, profile="sphere")
    assert solve("pull_off_force", **{**GEL, "poisson_ratio2": 0.45}, profile="sphere") > 0


@pytest.mark.parametrize("model", ["maugis", "dmt"])
def test_sphere_is_refused_under_other_laws(model: str, run: Run) -> None:
    with pytest.raises(BadRequest, match=f"only JKR has it; leave out model {model}"):
        solve("pull_off_force", **GEL, model=model, profile="sphere")
    ran = run(f"pull-off {WORDS} --work-of-adhesion 20mJ/m2 --profile sphere --model {model}")
    assert (ran.code, "only JKR has it" in ran.err) == (2, True)


def test_sphere_needs_the_moduli_that_justify_it() -> None:
    given = {"reduced_radius": 1e-6, "contact_modulus": 2e6, "work_of_adhesion": 0.02}
    with pytest.raises(MissingInput, match="Young's modulus"):
        solve("pull_off_force", **given, profile="sphere")


def test_sphere_has_no_rolling_and_no_energies() -> None:
    for name in ("yield_moment", "n_grav", "well_energy", "sticking_speed", "hertz_pressure", "load_factor"):
        with pytest.raises(NotInLaw, match="give --profile paraboloid"):
            solve(name, **GEL, density=1e3, profile="sphere")


def test_load_beyond_pull_off_is_refused_with_the_pull_off_force_of_the_sphere(run: Run) -> None:
    ran = run(f"contact {WORDS} --work-of-adhesion 20mJ/m2 --profile sphere --load=-91nN")
    assert "the hardest pull that it holds is -90.38 nN" in ran.err


def test_profile_is_paraboloid_or_sphere() -> None:
    with pytest.raises(BadRequest, match="'cone' is not one of paraboloid, sphere"):
        solve("pull_off_force", **GEL, profile="cone")


# --- Texts of answers -------------------------------------------------------------------------------------------------


def test_warning_of_a_wide_contact_states_the_results_of_a_sphere(run: Run) -> None:
    """At w/(E*R) = 0.001, a sphere has 0.99082 of the P_c of a paraboloid."""
    said = "for a true sphere P_c is 0.92 % smaller, so w inferred from P_c is 0.92 % too low"
    assert f"contact too wide for a paraboloid: {said}" in run(f"pull-off {WORDS} --work-of-adhesion 2mJ/m2").err
    assert "w inferred from P_c is 0.91 % too low" in run(f"infer w {WORDS} --measured P_c=9.338nN").err
    assert "paraboloid" not in run(f"pull-off {WORDS} --work-of-adhesion 2mJ/m2 --profile sphere").err
    two = run("pull-off 1um --young 1.5MPa --poisson 0.5 --gamma 2mJ/m2 --explain").out
    assert "the profile that they assume for a sphere is off by e_h" in " ".join(two.split())
    assert "too low" not in two


def test_results_of_a_sphere_have_no_meaning_where_the_contact_exceeds_it() -> None:
    """For both profiles, results lose their meaning where the paraboloid has a0 = R: at w/(E*R) = 2/(9π)."""
    for work, has_meaning in ((0.14, True), (0.142, False)):
        said = answer("pull-off", **{**GEL, "work_of_adhesion": work}, profile="sphere")
        assert ("contact-exceeds-sphere" not in {doubt.code for doubt in said.doubts}) is has_meaning


def test_answers_name_the_profile(run: Run) -> None:
    words = f"pull-off {WORDS} --work-of-adhesion 20mJ/m2 --profile sphere"
    found = json.loads(run(f"{words} --json").out)
    assert found["inputs"]["profile"] == "sphere"
    (force,) = found["results"]
    assert (force["model"], force["profile"], force["best"]["by"]) == ("jkr", "sphere", "JKR, sphere")
    assert run(f"{words} --csv").out.startswith("profile,radius [m],radius2 [m]")
    assert "AFM-analysis/nanite" in run(f"{words} --cite").out


def test_table_takes_the_profile_for_all_rows(run: Run, tmp_path: Any) -> None:
    table = tmp_path / "gels.csv"
    table.write_text("radius [um],w [mJ/m2],poisson_ratio2\n1,20,0.5\n1,20,0.3\n")
    fixed = "--radius2 plane --young rigid --young2 1.5MPa --profile sphere --quantities pull_off_force"
    out = tmp_path / "forces.csv"
    assert "jkroll: 1 of 2 rows failed" in run(f"batch {table} {fixed} -o {out}").err
    head, first, second = out.read_text().splitlines()
    assert head.endswith("profile,pull_off_force [N],doubt,status")
    assert float(first.split(",")[4]) == approx(0.95900 * PARABOLOID, rel=1e-5)
    assert second.split(",")[3:] == ["sphere", "", "", "no rigid sphere on a soft plane"]


def test_a_stated_sphere_sets_the_best_range_as_a_stated_law_does() -> None:
    said = answer("pull-off", **GEL, profile="sphere")
    low, high, by = said.best["pull_off_force"]
    assert low == high == said["pull_off_force"].value
    assert by == "JKR, sphere"
    with pytest.raises(JkrollError):
        answer("r-min", radius=1e-6, yield_displacement=1e-10, profile="sphere")["yield_moment"]
