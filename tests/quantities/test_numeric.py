"""Results and uncertain values as numbers; answers and materials as mappings and as DataFrames."""

import copy
import math
import operator
import pickle
from collections.abc import Callable
from typing import Any

import numpy
import pytest

import jkroll
from relative import approx

Operation = Callable[[Any, Any], Any]


@pytest.fixture
def force() -> Any:
    return jkroll.answer("P_c", material="quartz", radius="100 nm")["P_c"]


BARE = 3 * math.pi * 0.025 * 50e-9  # the number of this result: 3πγR, R = R1/2


@pytest.mark.parametrize("operation", [operator.add, operator.sub, operator.mul, operator.truediv, operator.pow])
@pytest.mark.parametrize("other", [2, 0.5, -1.5])
def test_arithmetic_is_that_of_the_number(force: Any, operation: Operation, other: float) -> None:
    assert operation(force, other) == approx(operation(BARE, other), rel=1e-14)
    assert operation(1 + abs(other), force) == approx(operation(1 + abs(other), BARE), rel=1e-14)


def test_a_result_is_compared_rounded_and_formatted_as_its_number(force: Any) -> None:
    assert float(force) == approx(BARE, rel=1e-15)
    assert force < 2e-8 < force * 2
    assert force >= float(force)
    assert max([force, force / 2]) is force
    assert -force == -float(force)
    assert abs(force) == float(force)
    assert round(force, 10) == 1.18e-08
    assert f"{force:.3g} {force}" == "1.18e-08 11.781 nN"
    assert force / force == 1
    assert {force: 1}[copy.copy(force)] == 1
    assert pickle.loads(pickle.dumps(force)) == force


def test_functions_of_numpy_accept_results(force: Any) -> None:
    assert numpy.sqrt(force) == approx(math.sqrt(BARE), rel=1e-14)
    assert (numpy.array([1.0, 2.0]) * force).tolist() == approx([BARE, 2 * BARE], rel=1e-14)
    assert (force * numpy.array([1.0, 2.0])).tolist() == approx([BARE, 2 * BARE], rel=1e-14)
    assert numpy.array([force, force]).dtype == float


def test_a_result_is_converted_to_another_unit(force: Any) -> None:
    assert force.to("nN") == approx(BARE * 1e9, rel=1e-15)
    assert force.to("dyn") == approx(BARE * 1e5, rel=1e-15)
    assert force.unit == "N"
    with pytest.raises(jkroll.JkrollError, match="pull_off_force: 'nm' is a unit of the wrong dimension; it is in N"):
        force.to("nm")


def test_using_a_result_without_a_value_raises_its_reason() -> None:
    found = jkroll.answer("report", gamma=0.025, radius=1e-7)
    radius = found["contact_radius_at_load"]
    for use in (
        float,
        lambda result: result * 2,
        lambda result: result < 1,
        lambda result: result.to("nm"),
        numpy.sqrt,
    ):
        with pytest.raises(jkroll.JkrollError, match="contact_radius_at_load: needs Young's modulus"):
            use(radius)
    assert not radius
    assert radius != 0


def test_a_result_without_a_meaning_points_to_its_best_range() -> None:
    found = jkroll.answer("contact", gamma=0.05, young=1e4, poisson=0.49, radius=1e-5)
    result = next(result for name, result in found.items() if result.value is None and name in found.best)
    with pytest.raises(jkroll.JkrollError, match=r"; \.best has its range"):
        float(result)
    assert result.best == found.best[result.name]


def test_a_result_can_be_an_input_with_the_same_unit() -> None:
    found = jkroll.answer("contact", material="quartz", radius="100 nm")
    force = jkroll.solve("P_c", material="quartz", radius=found["contact_radius"])
    assert force == approx(BARE * float(found["contact_radius"]) / 1e-7, rel=1e-14)
    with pytest.raises(jkroll.JkrollError, match="is a contact_radius, in m; give a value in N"):
        jkroll.solve("contact_radius_at_load", material="quartz", radius=1e-7, load=found["contact_radius"])


def test_an_uncertain_result_keeps_its_uncertainty_in_arithmetic_with_numbers() -> None:
    force = jkroll.answer("P_c", radius="100 nm", gamma="25±5 mJ/m2")["P_c"]
    for changed, factor in ((force * 2, 2), (-3 * force, -3), (force / 4, 0.25), (-force, -1), (force.to("nN"), 1e9)):
        assert isinstance(changed, jkroll.Measured)
        assert (changed.value, changed.plus) == (approx(BARE * factor), approx(BARE * abs(factor) / 5))
    with pytest.raises(jkroll.JkrollError, match="are not assumed to be independent"):
        force * force


def test_arithmetic_with_numbers_carries_the_uncertainty_along() -> None:
    skew, span = jkroll.Measured(2.0, 0.25, 0.5), jkroll.Interval(2.0, 1.0, 4.0)
    assert skew * -2 == jkroll.Measured(-4.0, 1.0, 0.5)
    assert 1 - skew == jkroll.Measured(-1.0, 0.5, 0.25)
    assert skew + 1 == 1 + skew == jkroll.Measured(3.0, 0.25, 0.5)
    assert -span / 2 == jkroll.Interval(-1.0, -2.0, -0.5)
    assert 3 - span == jkroll.Interval(1.0, -1.0, 2.0)
    with pytest.raises(TypeError):
        skew * "2"


def test_a_measured_value_is_converted_to_uncertainties_and_back() -> None:
    gamma = jkroll.Measured(0.025, 0.005)
    assert (gamma.ufloat() ** 2).std_dev == approx(2 * 0.025 * 0.005)
    assert jkroll.solve("P_c", radius=1e-7, gamma=gamma.ufloat()) == jkroll.solve("P_c", radius=1e-7, gamma=gamma)
    with pytest.raises(jkroll.JkrollError, match="differ; a ufloat has one uncertainty"):
        jkroll.Measured(1.0, 0.1, 0.2).ufloat()


def test_an_answer_is_a_mapping_of_its_results() -> None:
    found = jkroll.answer(["P_c", "n_grav"], material="quartz", radius="100 nm")
    assert [*found] == [*found.keys()] == ["pull_off_force", "n_grav"]
    assert len(found) == 2
    assert dict(found) == dict(found.items()) == found.values
    assert "P_c" in found
    assert "a0" not in found
    assert found.to_dict() == jkroll.solve(["P_c", "n_grav"], material="quartz", radius=1e-7)


def test_materials_are_a_mapping() -> None:
    every = jkroll.known_materials()
    assert "QUARTZ" in every
    assert "unobtainium" not in every
    assert [*every] == [name for name, _ in every.items()]
    assert len(every) == len([*every])
    assert every.to_dict()["quartz"]["surface_energy"] == 0.025


def test_answers_and_materials_are_converted_to_data_frames() -> None:
    pytest.importorskip("pandas")
    found = jkroll.answer(["P_c", "n_grav"], material="quartz", radius="100 nm")
    frame = found.to_pandas()
    assert frame.loc["pull_off_force", "value"] == found["P_c"]
    assert frame.loc["pull_off_force", "best_by"] == found.best["pull_off_force"].by
    assert jkroll.known_materials().to_pandas().loc["quartz", "surface_energy [J/m^2]"] == 0.025
