"""`jkroll export lammps`: the lines that it writes. test_lammps_export.py runs them."""

import math
import re
from typing import Any

import pytest

from harness import Run
from jkroll import solve

NUMBER = r"([-+.e\d]+)"
COEFFICIENTS = re.compile(
    rf"pair_coeff (\d \d) (jkr|dmt) {NUMBER} 0 0 {NUMBER} tangential mindlin {NUMBER} 0 {NUMBER} rolling sds {NUMBER} 0 {NUMBER}"
)


def coefficients(text: str) -> dict[str, tuple[float, ...]]:
    """Return the numbers of each pair of types."""
    return {types: tuple(map(float, numbers)) for types, _, *numbers in COEFFICIENTS.findall(text)}


def test_numbers_are_those_of_the_formulas(run: Run) -> None:
    """E = 2E*, γ, 8G*, k_roll = 4P_c/R and μ_roll = 2ξ/R, which both are independent of the elastic constants."""
    [(modulus, gamma, tangential, slip, rolling, cap)] = coefficients(run("export lammps quartz 100nm").out).values()
    assert modulus == pytest.approx(54e9 / (1 - 0.17**2), rel=1e-11)
    assert gamma == 0.025
    assert tangential == pytest.approx(4 * 54e9 / (2 * 1.17) / 1.83, rel=1e-11)
    assert slip == 1e9
    assert rolling == pytest.approx(4 * solve("pull_off_force", material="quartz", radius=1e-7) / 5e-8, rel=1e-11)
    assert cap == pytest.approx(2 * 2e-10 / 5e-8, rel=1e-11)


def test_dmt(run: Run) -> None:
    """The moment is P_DMT ξ at any load, and LAMMPS' yield force μ(P + 2P_DMT)."""
    pull_off = solve("pull_off_force_dmt", material="quartz", radius=1e-7)
    for load in (0.0, 5e-9):
        text = run(f"export lammps quartz 100nm --model dmt --load {load}N").out
        assert "pair_coeff 1 1 dmt " in text
        [(*_, rolling, cap)] = coefficients(text).values()
        assert rolling == pytest.approx(pull_off / 5e-8, rel=1e-11)
        assert cap == pytest.approx(pull_off * 2e-10 / 5e-8 / (load + 2 * pull_off), rel=1e-11)


def test_the_state_of_a_dmt_contact_is_that_of_dmt(run: Run) -> None:
    """An approach means the load of DMT, and DMT holds more tension than JKR."""
    load = solve("load", material="quartz", radius=1e-7, approach_at_load=2e-11, model="dmt")
    by_approach = run("export lammps quartz 100nm --model dmt --approach 0.02nm").out
    assert f"P = {load:.12g} N" in by_approach
    assert coefficients(by_approach) == coefficients(run(f"export lammps quartz 100nm --model dmt --load {load}N").out)
    assert run("export lammps quartz 100nm --model dmt --load -13nN").code == 0


def test_unequal_spheres_have_three_pairs_of_types(run: Run) -> None:
    text = run("export lammps quartz 100nm --radius2 300nm --material2 iron --load -1nN").out
    assert "\n# set type 2 diameter 6e-07 density 7700\n" in text
    pairs = coefficients(text)
    assert [*pairs] == ["1 1", "2 2", "1 2"]
    assert pairs["1 1"] == coefficients(run("export lammps quartz 100nm").out)["1 1"]
    assert pairs["2 2"] == coefficients(run("export lammps iron 300nm").out)["1 1"]
    steps = [
        float(re.findall(r"timestep (\S+)", run(f"export lammps {grain}").out)[0])
        for grain in ("quartz 100nm", "iron 300nm")
    ]
    assert float(re.findall(r"timestep (\S+)", text)[0]) <= min(steps)


def test_a_work_of_adhesion_is_that_of_the_two_materials(run: Run) -> None:
    text = run("export lammps quartz 100nm --material2 iron --work-of-adhesion 50mJ/m2").out
    assert [numbers[1] for numbers in coefficients(text).values()] == [0.025, 3.0, 0.025]
    text = run("export lammps quartz 100nm --radius2 1um --work-of-adhesion 80mJ/m2").out
    assert {numbers[1] for numbers in coefficients(text).values()} == {0.04}


def test_a_plane_is_a_wall(run: Run) -> None:
    text = run("export lammps quartz 1um --radius2 plane --material2 iron --load 10nN").out
    assert "zplane 0 NULL\n" in text
    of_wall = text.replace("fix wall all wall/gran granular", "pair_coeff 0 0")
    modulus, gamma, _, _, rolling, cap = coefficients(of_wall)["0 0"]
    scene: dict[str, Any] = {
        "material": "quartz",
        "material2": "iron",
        "radius": 1e-6,
        "radius2": math.inf,
        "load": 1e-8,
    }
    assert modulus == pytest.approx(2 * solve("contact_modulus", **scene), rel=1e-11)
    assert gamma == pytest.approx(math.sqrt(0.025 * 3.0), rel=1e-11)
    assert rolling == pytest.approx(solve("rolling_stiffness", **scene) / 1e-12, rel=1e-11)
    held = 1e-8 + 2 * solve("pull_off_force", **scene)
    assert cap == pytest.approx(solve("yield_moment", **scene) / (1e-6 * held), rel=1e-11)
    alone = run("export lammps quartz 1um").out
    assert coefficients(text) == coefficients(alone)  # of the spheres among each other


def test_a_pair_that_lacks_an_input_is_left_out(run: Run) -> None:
    """Of γ1 and γ2 nothing is said, so that only the coefficients of unlike spheres are known."""
    words = (
        "export lammps 100nm --young 54GPa --poisson 0.17 --density 2g/cm3 --material2 iron --work-of-adhesion 50mJ/m2"
    )
    ran = run(words)
    assert ran.code == 0
    assert "# pair_coeff 1 1 needs surface energy per surface; give --gamma 25mJ/m2" in ran.out
    assert [*coefficients(ran.out)] == ["2 2", "1 2"]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("", "export: which program? write jkroll export lammps quartz 100nm"),
        ("yade quartz 100nm", "export: 'yade' is not among the programs: lammps"),
        ("lammps quartz,iron 100nm", "export takes one pair of spheres, not 2"),
        ("lammps quartz 100nm --model maugis", "--model: LAMMPS has jkr and dmt, not 'maugis'"),
        (
            "lammps 100nm --gamma 25mJ/m2 --young 54GPa --poisson 0.17",
            "time_step needs mass density; give --density 1g/cm3",
        ),
    ],
)
def test_mistakes(run: Run, words: str, message: str) -> None:
    ran = run(*"export".split(), *words.split())
    assert (ran.code, ran.out, ran.err) == (2, "", f"jkroll: {message}\n")
