"""The audit of the paper: every verdict is computed, is as expected, and would change with the paper's text."""

import math
import re
from typing import Any

import pytest

from audit.checks import Check, Terms, Verdict
from audit.claims import PAGE, claims, table
from audit.moment import XI, A, C, E, R, X
from audit.pair import pair, twins
from jkroll import solve
from jkroll.model.plan import parameters_of
from jkroll.physics import cylinder, shifted
from relative import approx

CLAIMS = claims()


def claim(equation: str, expected: Verdict) -> Check:
    """Return the first check of an equation with a verdict."""
    return next(check for check in CLAIMS if (check.equation, check.expected) == (equation, expected))


# --- The verdicts ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("check", CLAIMS, ids=[f"{check.equation}: {check.claim}" for check in CLAIMS])
def test_the_verdict_is_the_expected_one(check: Check) -> None:
    assert check.verdict == check.expected


def test_every_numbered_equation_has_a_check() -> None:
    found: set[int] = set()
    for check in CLAIMS:
        numbers = re.sub(r"Fig.*|Sect.*|Table.*", "", check.equation)
        for first, last in re.findall(r"(\d+)(?:-(\d+))?", numbers):
            found |= set(range(int(first), int(last or first) + 1))
    assert found == set(range(1, 89))


@pytest.mark.parametrize(
    ("equation", "verdict", "ratio"),
    [
        ("2 text", "wrong", 2),
        ("41", "wrong", 0.4),
        ("42", "wrong", 0.4),
        ("47", "wrong", 3.5),
        ("48", "wrong", 2 / 7),
        ("49", "wrong", 2 / 7),
        ("Fig. 7", "wrong", 3.5),
        ("44", "wrong", 1 + 1.3 / 2.9),
        ("48 text", "approximate", 1 / 0.7722405),
        ("28 text", "approximate", 3000 / (500 * math.pi)),
        ("27 text", "approximate", 1.25),
    ],
)
def test_a_printed_number_is_off_by_a_known_factor(equation: str, verdict: Verdict, ratio: float) -> None:
    printed, follows = claim(equation, verdict).numbers
    assert printed / follows == approx(ratio, rel=1e-3)


@pytest.mark.parametrize(
    ("equation", "verdict", "mended", "becomes"),
    [
        ("41", "wrong", 3 / (4 * math.pi) * math.sqrt(5 * twins.gamma / (twins.r1**3 * twins.rho)), "holds"),
        ("48", "wrong", pair.energy / (4 * math.pi * pair.p_c * pair.xi), "holds"),
        ("48", "holds", pair.energy / (4 * math.pi * pair.p_c * pair.xi), "wrong"),
        ("70", "sign", (math.pi / 4 * E / R * XI * A**2, -math.pi / 4 * E / R * XI * 2 * C), "holds"),
        ("70", "sign", (math.pi / 4 * E / R * XI * A**2, math.pi / 4 * E / R * XI * C), "wrong"),
        ("47", "wrong", -2 * pair.p_c * pair.xi / (7 / 5 * pair.m1 * pair.r1**2), "holds"),
        ("44", "wrong", 2 * pair.p_c * pair.xi / pair.r1, "holds"),
        ("34", "sign", -6 / 5 * pair.e * pair.a0 / pair.m, "holds"),
    ],
)
def test_another_form_of_a_claim_changes_the_verdict(
    equation: str, verdict: Verdict, mended: Terms, becomes: Verdict
) -> None:
    assert claim(equation, verdict)._replace(printed=mended).verdict == becomes


# --- The same numbers from the program -------------------------------------------------------------------------------

GIVEN: dict[str, Any] = {
    "radius": pair.r1,
    "radius2": pair.r2,
    "work_of_adhesion": 2 * pair.gamma,
    "contact_modulus": pair.e,
    "density": pair.rho,
    "yield_displacement": pair.xi,
    "energy": pair.energy,
}


@pytest.mark.parametrize(
    ("wanted", "loaded", "follows"),
    [
        ("pull_off_force", False, pair.pull_off),
        ("contact_radius", False, pair.free_radius),
        ("approach_at_load", True, pair.approach_of(pair.a)),
        ("yield_moment", True, pair.moment_at_load),
        ("rolling_mass", False, pair.rolling_mass),
        ("n_roll_energy_balance", False, claim("48", "wrong").numbers[1]),
        ("sticking_energy", False, claim("48 text", "approximate").numbers[1] * pair.p_c * pair.delta0),
        ("rolling_frequency", False, claim("40", "approximate").numbers[0]),
        ("hertz_pressure", True, pair.hertz(pair.a)),
        ("boussinesq_pressure", True, pair.griffith(pair.a)),
        ("half_circles_moment", True, claim("16-20", "holds").numbers[1]),
        ("vertical_frequency", False, claim("35", "holds").numbers[1]),
        ("n_roll", False, claim("48", "holds").numbers[1]),
    ],
)
def test_the_program_computes_the_number_that_follows(wanted: str, loaded: bool, follows: float) -> None:
    assert solve(wanted, load=pair.p if loaded else 0.0, **GIVEN) == approx(follows, rel=1e-9)


STRIP = {
    "contact_half_width": A, "load_constant": C, "cylinder_radius": R,
    "plane_strain_modulus": E, "position_in_strip": X,
}  # fmt: skip


@pytest.mark.parametrize(
    ("name", "equation", "shift"),
    [
        ("asymmetric_pressure", "54-56", 0.0),
        ("load_per_length", "57-59", XI),
        ("asymmetric_pressure", "63, 64", XI),
        ("strip_moment", "66-68", XI),
        ("contact_point_moment", "69", XI),
        ("half_strips_moment", "77", XI),
    ],
)
def test_the_program_computes_the_number_that_follows_for_a_strip(name: str, equation: str, shift: float) -> None:
    formula, given = getattr(cylinder, name), {**STRIP, "yield_displacement": shift}
    value = formula(**{parameter: given[parameter] for parameter in parameters_of(formula)})
    assert value == approx(claim(equation, "holds").numbers[1], rel=1e-9)


@pytest.mark.parametrize("position", [-0.8, 0.0, 0.3])
def test_the_drawn_pressure_dents_the_half_space_to_the_shifted_sphere(position: float) -> None:
    """The audit of Eq 25 shows the same for `shifted_pressure`; an approach larger by ξ²/(2R) keeps the load."""
    value = shifted.exact_pressure(
        position_in_circle=position * pair.a, contact_radius_at_load=pair.a, contact_modulus=pair.e,
        reduced_radius=pair.r, yield_displacement=pair.xi, hertz_pressure=pair.hertz(pair.a),
        boussinesq_pressure=pair.griffith(pair.a),
    )  # fmt: skip
    approach = pair.delta + pair.xi**2 / (2 * pair.r)
    assert value == approx(pair.shifted_pressure(position * pair.a, 0.0, approach), rel=1e-9)


# --- The page ---------------------------------------------------------------------------------------------------------


def test_the_manual_has_the_claims_that_do_not_hold() -> None:
    """If this test fails, `python tests/audit/claims.py` renews the table."""
    assert table() in PAGE.read_text(encoding="utf-8")
