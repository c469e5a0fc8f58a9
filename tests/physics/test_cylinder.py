"""The strip contact of Appendix A: each formula against the integral that it solves."""

# ruff: noqa: N803, N806  (the paper's symbols)

import inspect
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import MPContext  # type: ignore[import-untyped]

from jkroll.physics import cylinder
from scenes import strip_contacts

Values = Mapping[str, Any]
Exact = Any  # an mpf; mpmath declares no types
Function = Callable[[Exact], Exact]

FORMULAS: Mapping[str, Callable[..., Any]] = {
    name: function
    for name, function in vars(cylinder).items()
    if getattr(function, "__module__", None) == cylinder.__name__
}

digits = MPContext()
digits.dps = 50
mpf, pi = digits.mpf, +digits.pi


def of(name: str, values: Values, **changed: Any) -> Any:
    """A formula at those of the values that it needs, some of them changed."""
    given_values = {**values, **changed}
    return FORMULAS[name](**{name: given_values[name] for name in inspect.signature(FORMULAS[name]).parameters})


# --- The integrals, taken numerically ---------------------------------------------------------------------------------

# With 50 digits; only the π of a formula remains a double.
SOME: Sequence[Values] = [{name: mpf(value) for name, value in values.items()} for values in strip_contacts(4)]


def integral(function: Function, half_width: Exact, start: int = -1) -> Exact:
    """Integral over the strip, or from start = 0 over half of it; s = a sin φ takes the root off the edges."""
    return digits.quad(
        lambda phi: function(half_width * digits.sin(phi)) * half_width * digits.cos(phi),
        [start * pi / 2, pi / 2],
        method="gauss-legendre",
        maxdegree=5,
    )


def principal_value(function: Function, x: Exact, half_width: Exact) -> Exact:
    """PV∫ f(s)/(x − s) ds over the strip: f(x) taken off leaves no singularity, and f(x) itself gives a logarithm."""
    at_x = function(x)
    rest = integral(lambda s: (function(s) - at_x) / (x - s), half_width)
    return rest + at_x * digits.log((half_width + x) / (half_width - x))


def near(value: Any, other: Any, scale: Any = 0) -> bool:
    """Equal but for a few roundings of a double, of them or of something larger."""
    return bool(abs(value - other) <= 2e-15 * max(abs(value), abs(other), abs(scale)))


@pytest.mark.parametrize("values", SOME)
@pytest.mark.parametrize("shifted", [False, True])
def test_pressures_satisfy_eq_51(values: Values, shifted: bool) -> None:
    """PV∫ p(s)/(x − s) ds = −(πE′/2) du/dx with u = δ − x²/(2R), in a symmetric strip and in one that lags by ξ."""
    a, xi = values["contact_half_width"], values["yield_displacement"]
    name, place = ("asymmetric_pressure", "position_in_strip") if shifted else ("symmetric_pressure", "position")
    for X in (-a / 2, a / 7, 0.9 * a):
        tilt = principal_value(lambda s: of(name, values, **{place: s}), X, a)
        x = X - xi if shifted else X
        wanted = pi / 2 * values["plane_strain_modulus"] * x / values["cylinder_radius"]
        assert near(tilt, wanted, values["plane_strain_modulus"] * a / values["cylinder_radius"])


@pytest.mark.parametrize("values", SOME)
def test_pressures_carry_the_load_and_the_moments(values: Values) -> None:
    """Eqs 57, 66 and 69: the load does not depend on ξ, and a symmetric strip has no moment."""
    a, xi = values["contact_half_width"], values["yield_displacement"]

    def symmetric(x: Exact) -> Exact:
        return of("symmetric_pressure", values, position=x)

    def asymmetric(X: Exact) -> Exact:
        return of("asymmetric_pressure", values, position_in_strip=X)

    load = of("load_per_length", values)
    assert near(integral(symmetric, a), load)
    assert near(integral(asymmetric, a), load)
    assert near(integral(lambda x: x * symmetric(x), a), 0, a * load)
    assert near(integral(lambda X: X * asymmetric(X), a), of("strip_moment", values))
    about_contact_point = integral(lambda X: (X - xi) * asymmetric(X), a)
    assert near(about_contact_point, of("contact_point_moment", values))
    assert near(about_contact_point, of("strip_moment", values) - xi * load, xi * load)  # Eq 69


@pytest.mark.parametrize("values", SOME)
def test_two_half_strips_have_the_load_and_the_moment_of_eqs_71_to_77(values: Values) -> None:
    a, xi = values["contact_half_width"], values["yield_displacement"]

    def half(width: Exact, power: int) -> Exact:
        return integral(
            lambda x: x**power * of("symmetric_pressure", values, position=x, contact_half_width=width), width, start=0
        )

    assert near(half(a + xi, 0) + half(a - xi, 0), of("load_per_length", values))
    assert near(half(a - xi, 1) - half(a + xi, 1), of("half_strips_moment", values))


# --- Relations --------------------------------------------------------------------------------------------------------

any_contact = st.fixed_dictionaries(
    {
        "contact_half_width": st.floats(0.01, 0.1),
        "yield_displacement": st.floats(1e-9, 0.009),
        "cylinder_radius": st.floats(1, 100),
        "plane_strain_modulus": st.floats(1e6, 1e12),
        "load_constant": st.floats(-0.01, 4e-5),  # below a²/2
    }
)
inside = st.floats(-0.999, 0.999)


@given(any_contact, inside)
def test_without_shift_the_asymmetric_pressure_is_the_symmetric_one(values: Values, place: float) -> None:
    x = place * values["contact_half_width"]
    symmetric = of("symmetric_pressure", values, position=x)
    assert of("asymmetric_pressure", values, position_in_strip=x, yield_displacement=0.0) == symmetric
    assert of("symmetric_pressure", values, position=-x) == symmetric


@given(any_contact, inside)
def test_rolling_the_other_way_mirrors_the_pressure(values: Values, place: float) -> None:
    X, xi = place * values["contact_half_width"], values["yield_displacement"]
    there = of("asymmetric_pressure", values, position_in_strip=X)
    assert of("asymmetric_pressure", values, position_in_strip=-X, yield_displacement=-xi) == there


@given(any_contact)
def test_load_and_its_constant_are_inverse(values: Values) -> None:
    load = of("load_per_length", values)
    assert near(of("load_constant", values, load_per_length=load), values["load_constant"], 1e-290)


@given(any_contact)
def test_moment_about_the_contact_point_is_eq_69(values: Values) -> None:
    shift = values["yield_displacement"] * of("load_per_length", values)
    moment = of("contact_point_moment", values)
    assert near(moment, of("strip_moment", values) - shift, shift)


@given(any_contact)
def test_two_half_strips_tend_to_2_over_pi_of_the_exact_moment(values: Values) -> None:
    """(70)/(78) = π/2, where (77) = (78) + E′ξ³/(6R)."""
    xi, R = values["yield_displacement"], values["cylinder_radius"]
    exact, two = of("contact_point_moment", values), of("half_strips_moment", values)
    assert near(two, 2 / math.pi * exact + values["plane_strain_modulus"] * xi**3 / (6 * R))
    small = {**values, "yield_displacement": 1e-9 * xi}
    assert near(of("half_strips_moment", small), 2 / math.pi * of("contact_point_moment", small))


@given(any_contact)
def test_without_adhesion_nothing_resists_and_the_contact_is_that_of_hertz(values: Values) -> None:
    a, R, E = (values[name] for name in ("contact_half_width", "cylinder_radius", "plane_strain_modulus"))
    hertz = {**values, "load_constant": a * a / 2}
    assert of("contact_point_moment", hertz) == 0
    assert near(of("load_per_length", hertz), math.pi * E * a * a / (4 * R))
    assert near(of("symmetric_pressure", hertz, position=0.0), E * a / (2 * R))


@given(any_contact, st.floats(0.1, 2))
def test_the_leading_edge_is_pressed_where_the_shift_is_too_large(values: Values, share: float) -> None:
    """Up to ξ = a/2 − C/a the edge X = a is pulled; beyond, the pressure there is positive and without bound."""
    a = values["contact_half_width"]
    limit = a / 2 - values["load_constant"] / a
    pressure = of("asymmetric_pressure", values, position_in_strip=a * (1 - 1e-12), yield_displacement=share * limit)
    assert abs(share - 1) < 1e-4 or (pressure > 0) == (share > 1)


# --- Dimensions -------------------------------------------------------------------------------------------------------
