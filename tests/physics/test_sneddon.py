"""A true rigid sphere on a half-space: the dimensionless functions compared with 50-digit values and with limits."""

import math
from collections.abc import Callable
from random import Random
from typing import Any

import numpy as np
import pytest
from mpmath import MPContext  # type: ignore[import-untyped]

from jkroll.physics import sneddon
from relative import approx
from scenes import log_uniform

digits = MPContext()
digits.dps = 50
mpf, pi, sqrt = digits.mpf, digits.pi, digits.sqrt
Exact = Any  # an mpf; mpmath declares no types

# artanh x, δ_H/R, its two derivatives and P_H/(E*R²) as functions of x = a/R, as in the literature.
PROFILE: dict[Callable[..., Any], Callable[[Exact], Exact]] = {
    sneddon.artanh_of_contact: digits.atanh,
    sneddon.indentation: lambda x: x * digits.atanh(x),
    sneddon.indentation_slope: lambda x: digits.atanh(x) + x / (1 - x**2),
    sneddon.indentation_curvature: lambda x: 2 / (1 - x**2) + 2 * x**2 / (1 - x**2) ** 2,
    sneddon.load_without_adhesion: lambda x: (1 + x**2) / 2 * digits.log((1 + x) / (1 - x)) - x,
}
# g and c of the sum gδ + cP that a machine holds constant.
MACHINES = {"fixed grips": (1.0, 0.0), "dead load": (0.0, 1.0), "lever": (1.0, 3.7)}


def approach(x: Exact, ratio: Exact) -> Exact:
    """Return δ/R at x = a/R; the ratio is w/(E*R)."""
    return x * digits.atanh(x) - sqrt(2 * pi * ratio * x)


def load(x: Exact, ratio: Exact) -> Exact:
    """Return P/(E*R²) at x = a/R; the ratio is w/(E*R)."""
    return PROFILE[sneddon.load_without_adhesion](x) - 2 * x * sqrt(2 * pi * ratio * x)


def held(x: Exact, ratio: Exact, machine: str) -> Exact:
    """Return the quantity that a machine holds."""
    grips, dead_load = MACHINES[machine]
    return grips * approach(x, ratio) + dead_load * load(x, ratio)


def contacts(count: int, seed: int) -> list[float]:
    """Return values of a/R: small, any, near 0.3, where the series ends, and near 1."""
    random = Random(seed)
    ranges = ((1e-9, 1e-3), (1e-3, 0.9), (0.299, 0.301), (0.9, 1 - 1e-9))
    near = [1 - log_uniform(random, 1e-15, 1e-3) for _ in range(count)]
    return [log_uniform(random, *random.choice(ranges)) for _ in range(count)] + near


@pytest.mark.parametrize("function", PROFILE, ids=lambda function: function.__name__)
def test_profile_is_that_of_the_literature(function: Callable[..., Any]) -> None:
    for x in contacts(100, seed=1965):
        artanh = sneddon.artanh_of_contact(x, 1.0)
        value = artanh if function is sneddon.artanh_of_contact else function(artanh)
        assert value == approx(float(PROFILE[function](mpf(x))), rel=1e-14), x


def test_load_and_approach_are_those_of_the_energy_release_rate() -> None:
    """By Griffith, (P_H − P)² = 8πwE*a³ and 2E*a(δ_H − δ) = P_H − P."""
    for x in (0.01, 0.29, 0.31, 0.7, 0.999):
        artanh, ratio = sneddon.artanh_of_contact(x, 1.0), 0.02
        pulled = sneddon.load_without_adhesion(artanh) - sneddon.load(ratio, artanh)
        assert pulled**2 == approx(8 * math.pi * ratio * x**3, rel=1e-13)
        assert 2 * x * (sneddon.indentation(artanh) - sneddon.approach(ratio, artanh)) == approx(pulled, rel=1e-13)


@pytest.mark.parametrize("machine", MACHINES)
def test_last_state_has_the_least_value_that_the_machine_can_hold(machine: str) -> None:
    """The value is the least gδ + cP over all contacts, where its derivative is 0 in 50 digits."""
    random = Random(1971)
    for _ in range(20):
        ratio = log_uniform(random, 1e-12, 10)
        artanh = sneddon.last_state(ratio, *MACHINES[machine])

        def slope(each: Exact, ratio: float = ratio) -> Exact:
            return digits.diff(lambda each: held(digits.tanh(each), mpf(ratio), machine), each)

        exact = digits.findroot(slope, (mpf(artanh) * 0.999, mpf(artanh) * 1.001), tol=1e-70, verify=False)
        assert artanh == approx(float(exact), rel=1e-14), ratio


@pytest.mark.parametrize("machine", MACHINES)
def test_state_has_the_value_that_the_machine_holds(machine: str) -> None:
    random = Random(1985)
    for _ in range(20):
        ratio = log_uniform(random, 1e-12, 10)
        last = sneddon.last_state(ratio, *MACHINES[machine])
        least = float(held(digits.tanh(mpf(last)), mpf(ratio), machine))
        for wanted in (0.0, 0.5 * least, -least * log_uniform(random, 1e-9, 1e3)):
            artanh = sneddon.state_at(wanted, ratio, last, *MACHINES[machine])
            exact = digits.findroot(
                lambda each, ratio=ratio, wanted=wanted: held(digits.tanh(each), mpf(ratio), machine) - mpf(wanted),
                (mpf(artanh) * (1 - mpf(10) ** -9), mpf(artanh) * (1 + mpf(10) ** -9)), tol=1e-80, verify=False,
            )  # fmt: skip
            assert artanh == approx(float(exact), rel=1e-13), (ratio, wanted)
            assert artanh > last


def test_arrays_have_the_states_of_their_elements() -> None:
    ratios = np.geomspace(1e-9, 1.0, 7)
    last = sneddon.last_state(ratios, 0.0, 1.0)
    states = sneddon.state_at(0.0, ratios, last, 0.0, 1.0)
    for ratio, at, state in zip(*(map(float, np.asarray(each)) for each in (ratios, last, states)), strict=True):
        assert at == approx(sneddon.last_state(ratio, 0.0, 1.0), rel=1e-15)
        assert state == approx(sneddon.state_at(0.0, ratio, at, 0.0, 1.0), rel=1e-15)


def test_there_is_no_state_beyond_the_last_one() -> None:
    last = sneddon.last_state(0.01, 0.0, 1.0)
    pull_off = -sneddon.load(0.01, last)
    with pytest.raises(ValueError, match="outside"):
        sneddon.state_at(-1.01 * pull_off, 0.01, last, 0.0, 1.0)
    states = sneddon.state_at(np.array([-1.01, -0.99]) * pull_off, 0.01, last, 0.0, 1.0)
    assert np.isnan(states).tolist() == [True, False]


# --- Limits -----------------------------------------------------------------------------------------------------------


def test_small_contact_is_that_of_a_paraboloid() -> None:
    """P_pull = (3/2)πwR(1 − (2/5)y + (59/315)y² − 0.08183y³), and a(P=0) = a0(1 − (4/15)z + (94/1575)z²).

    Here y = (9πκ/8)^(2/3), z = (9πκ/2)^(2/3), and κ = w/(E*R).
    """
    for ratio in (1e-12, 1e-9, 1e-6):
        y, z = (9 / 8 * math.pi * ratio) ** (2 / 3), (9 / 2 * math.pi * ratio) ** (2 / 3)
        last = sneddon.last_state(ratio, 0.0, 1.0)
        force = -sneddon.load(ratio, last) / (1.5 * math.pi * ratio)
        radius = math.tanh(sneddon.state_at(0.0, ratio, last, 0.0, 1.0)) / math.sqrt(z)
        assert force == approx(1 - 0.4 * y + 59 / 315 * y**2 - 0.08183 * y**3, rel=1e-13)
        assert radius == approx(1 - 4 / 15 * z + 94 / 1575 * z**2, rel=1e-9)
        assert math.tanh(sneddon.last_state(ratio, 1.0, 0.0)) == approx((math.pi * ratio / 8) ** (1 / 3), rel=z)


def test_wide_contact_tends_to_the_radius_of_the_sphere() -> None:
    """Near a = R: with y = R − a, L = ½ ln(2R/y), δ_H = RL, δ_H′ = R/(2y), P_H = E*R²(2L − 1) to first order."""
    for y in (1e-6, 1e-9, 1e-12):
        artanh = sneddon.artanh_of_contact(1 - y, 1.0)
        y = 1 - (1 - y)  # the rounded value
        assert artanh == approx(math.log(2 / y) / 2, rel=y)
        assert sneddon.indentation(artanh) == approx(artanh, rel=2 * y)
        assert sneddon.load_without_adhesion(artanh) == approx(2 * artanh - 1, rel=2 * y)
        assert sneddon.indentation_slope(artanh) == approx(0.5 / y, rel=40 * y)
    for ratio in (1e9, 1e15):  # stronger adhesion widens the last contact, but no contact covers the sphere
        assert sneddon.last_state(ratio, 0.0, 1.0) == approx(math.log(72 * math.pi * ratio) / 4, rel=1e-3)


# By column: w/(E*R), a0/R, and the ratios of a sphere to its paraboloid in δ(P=0), P_pull, a_pull, δ_fold, P_fold.
OVER_PARABOLOID = (
    (1e-6, 0.02418, 0.99981, 0.99991, 0.99990, 0.99999, 0.99997),
    (1e-4, 0.11186, 0.9958, 0.99801, 0.9978, 0.99987, 0.9993),
    (1e-2, 0.4855, 0.9141, 0.95900, 0.9548, 0.9973, 0.9850),
    (0.1, 0.8351, 0.6710, 0.83824, 0.8263, 0.9876, 0.9340),
)


@pytest.mark.parametrize(("ratio", "a0", "delta0", "force", "pull", "delta_fold", "force_fold"), OVER_PARABOLOID)
def test_ratios_of_a_sphere_to_its_paraboloid(
    ratio: float, a0: float, delta0: float, force: float, pull: float, delta_fold: float, force_fold: float
) -> None:
    paraboloid = (9 / 2 * math.pi * ratio) ** (1 / 3)
    approach0, pull_off = paraboloid**2 / 3, 1.5 * math.pi * ratio
    last, fold = sneddon.last_state(ratio, 0.0, 1.0), sneddon.last_state(ratio, 1.0, 0.0)
    unloaded = sneddon.state_at(0.0, ratio, last, 0.0, 1.0)
    assert math.tanh(unloaded) == approx(a0, rel=2e-4)
    assert sneddon.approach(ratio, unloaded) / approach0 == approx(delta0, rel=1e-4)
    assert -sneddon.load(ratio, last) / pull_off == approx(force, rel=1e-5)
    assert math.tanh(last) / paraboloid * 4 ** (1 / 3) == approx(pull, rel=1e-4)
    assert sneddon.approach(ratio, fold) / approach0 / -((9 / 16) ** (1 / 3)) == approx(delta_fold, rel=1e-4)
    assert sneddon.load(ratio, fold) / pull_off / (-5 / 9) == approx(force_fold, rel=1e-4)
