"""Relations between the formulas: limits, exchange of the spheres, dimensions; and arguments and results in Python."""

import inspect
import math
import pydoc
from types import SimpleNamespace
from typing import Any, assert_type, get_type_hints

import numpy as np
import pint
import pytest
from numpy.typing import NDArray

import jkroll
from jkroll import FORMULAS, NOMENCLATURE, JkrollError, solve
from jkroll.errors import BadRequest
from jkroll.model.reasons import Failure, MissingInput
from jkroll.physics import FORMULAS as PLAIN_FORMULAS
from jkroll.physics import cylinder, dimensions, meniscus
from jkroll.quantities.nomenclature import UnknownQuantity
from jkroll.quantities.units import dimension_of, kind_of
from jkroll.quantities.values import QuantityError
from jkroll.write.sources import docstring_fields

INFINITY = math.inf
QUARTZ: dict[str, Any] = {"surface_energy": 0.025, "youngs_modulus": 54e9, "poisson_ratio": 0.17, "density": 2600.0}


def close(value: float, other: float, ulps: float = 20) -> bool:
    """Return whether numbers are equal up to a few roundings."""
    return abs(value - other) <= ulps * 2.2e-16 * max(abs(value), abs(other))


def test_dmt_has_no_contact_radius_at_pull_off() -> None:
    with pytest.raises(MissingInput, match="contact_radius_at_pull_off: not in DMT; give --model jkr"):
        solve("contact_radius_at_pull_off", **QUARTZ, radius=1e-7, model="dmt")


# --- Two spheres ----------------------------------------------------------------------------------------------------

PAIR: dict[str, Any] = {
    "radius": 1e-7, "radius2": 3e-7, "surface_energy": 0.025, "surface_energy2": 3.0, "youngs_modulus": 54e9,
    "youngs_modulus2": 210e9, "poisson_ratio": 0.17, "poisson_ratio2": 0.27, "density": 2600.0, "density2": 7700.0,
}  # fmt: skip
OF_THE_PAIR = [
    "work_of_adhesion", "reduced_radius", "contact_modulus", "reduced_mass", "reduced_moment_of_inertia",
    "rolling_mass",
    "pull_off_force", "contact_radius", "approach", "yield_moment", "r_min", "vertical_frequency", "rolling_frequency",
    "rolling_frequency_no_slip", "shear_strength", "sliding_force", "sliding_displacement", "sliding_energy",
    "twisting_stiffness", "twisting_moment", "twisting_angle", "twisting_energy", "twisting_frequency",
    "peeling_force", "peeling_radius", "peeling_over_sliding", "sliding_or_peeling_force",
]  # fmt: skip
OF_SPHERE_1 = ["yield_force", "n_grav", "n_roll", "rolling_over_sliding"]


def exchanged(scene: dict[str, Any]) -> dict[str, Any]:
    """Return the scene with spheres 1 and 2 exchanged."""
    return {name.removesuffix("2") if name.endswith("2") else name + "2": value for name, value in scene.items()}


def test_exchange_of_the_spheres_changes_nothing() -> None:
    there, back = (solve(OF_THE_PAIR, **scene) for scene in (PAIR, exchanged(PAIR)))
    assert [name for name in OF_THE_PAIR if not close(there[name], back[name], 9)] == []


def test_a_plane_is_the_limit_of_a_large_sphere() -> None:
    names = [name for name in (*OF_THE_PAIR, *OF_SPHERE_1) if name != "r_min"]
    plane = solve(names, **{**PAIR, "radius2": INFINITY})
    for ratio, tolerance in ((1e6, 1e-5), (1e12, 1e-11)):
        large = solve(names, **{**PAIR, "radius2": ratio * 1e-7})
        assert [name for name in names if not math.isclose(large[name], plane[name], rel_tol=tolerance)] == []


def test_stating_that_sphere_2_is_like_sphere_1_changes_nothing() -> None:
    one: dict[str, Any] = {**QUARTZ, "radius": 1e-7}
    same = one | {name + "2": value for name, value in one.items()}
    for name in (*OF_THE_PAIR, *OF_SPHERE_1):
        assert close(solve(name, **same), solve(name, **one), 3), name


# --- Dimensions -----------------------------------------------------------------------------------------------------

UREG: Any = pint.application_registry


OF_A_STRIP = {name: formula for name, formula in vars(cylinder).items() if inspect.getmodule(formula) is cylinder}


# Values of parameters that a formula accepts only in a part of their range.
IN_DOMAIN = {
    "indenter_radius": {"radius2": INFINITY, "youngs_modulus": INFINITY, "poisson_ratio2": 0.5},
    "unloaded_artanh": {"elastoadhesive_ratio": 0.01, "artanh_at_pull_off": 0.324},
}


@pytest.mark.parametrize("name", [*FORMULAS, *OF_A_STRIP])
def test_a_formula_returns_the_stated_dimension(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Applied to pint Quantities, a formula returns the dimension that its annotation and the nomenclature state."""
    for constant, of_unit in (("WATER_TENSION", "N/m"), ("KELVIN_LENGTH", "m")):
        monkeypatch.setattr(meniscus, constant, UREG.Quantity(vars(meniscus)[constant], of_unit))
    formula = {**PLAIN_FORMULAS, **OF_A_STRIP}[name]
    hints = get_type_hints(formula, localns=vars(dimensions), include_extras=True)
    units = {parameter: hint.__metadata__[0] for parameter, hint in hints.items()}
    wanted = units.pop("return")
    values = {
        parameter: UREG.Quantity(index / 10, unit).to_base_units()
        for index, (parameter, unit) in enumerate(units.items(), 2)
    } | {parameter: UREG.Quantity(value, units[parameter]) for parameter, value in IN_DOMAIN.get(name, {}).items()}
    result = formula(**values)
    assert UREG.Quantity(result).is_compatible_with(UREG.Quantity(1.0, wanted))
    if name in NOMENCLATURE:
        assert NOMENCLATURE[name].unit == wanted
    for parameter, unit in units.items():
        if parameter in NOMENCLATURE:
            assert NOMENCLATURE[parameter].unit == unit


def test_every_formula_is_documented_and_takes_its_parameters_by_name() -> None:
    for name, formula in FORMULAS.items():
        fields = docstring_fields(formula)
        assert all(fields.get(key) for key in ("summary", "formula")), fields
        assert {"Always.", "Definition."}.isdisjoint(fields.values()), name  # a field that says nothing is left out
        parameters = inspect.signature(formula).parameters.values()
        assert all(parameter.kind is parameter.KEYWORD_ONLY for parameter in parameters), name


def test_a_docstring_is_read_with_and_without_its_indentation() -> None:
    """Since Python 3.13, the compiler removes the indentation."""
    for name, formula in FORMULAS.items():
        text = inspect.cleandoc(formula.__doc__ or "")
        dedented, indented = (SimpleNamespace(__doc__=doc) for doc in (text, text.replace("\n", "\n    ")))
        assert docstring_fields(dedented)["formula"], name
        assert docstring_fields(dedented) == docstring_fields(indented), name


def test_every_unit_of_the_nomenclature_can_be_read_and_its_dimension_has_a_name() -> None:
    for quantity in NOMENCLATURE.values():
        assert kind_of(dimension_of(quantity.unit)) != "a quantity of another dimension", quantity.unit


# --- Arguments and results in Python ----------------------------------------------------------------------------------


def test_arrays_broadcast() -> None:
    radius, load = np.array([[1e-8], [1e-7]]), np.array([0.0, 1e-10, -1e-10])
    moment, r_min = solve(["yield_moment", "r_min"], radius=radius, load=load, **QUARTZ).values()
    assert moment.shape == (2, 3)
    assert r_min.shape == (2, 1)
    assert close(moment[1, 2], solve("yield_moment", radius=1e-7, load=-1e-10, **QUARTZ), 2)


def test_lists_are_accepted_and_odd_values_refused() -> None:
    values = solve("pull_off_force", radius=["1 nm", 2e-9, 3e-9], **QUARTZ)
    assert values.tolist() == [solve("pull_off_force", radius=radius, **QUARTZ) for radius in (1e-9, 2e-9, 3e-9)]
    assert isinstance(solve("pull_off_force", radius=np.float64(1e-9), **QUARTZ), float)
    assert np.isnan(solve("yield_force", load=np.array([-1.0]), radius=1e-7, **QUARTZ)).all()
    odd: Any
    for odd in (True, None, {}, b"1e-7", 1j, "x", [[1e-9], [1e-9, 2e-9]], np.array(["a"]), UREG.Quantity(1.0, "kg")):
        with pytest.raises((JkrollError, ValueError)):
            solve("pull_off_force", radius=odd, **QUARTZ)


def test_integers_and_lists_are_read_as_floats() -> None:
    radius = np.array([1, 100, 255], dtype=np.uint8)
    others: dict[str, dict[str, Any]] = {
        "r_min": {"radius2": radius, "yield_displacement": 1},
        "mass": {"density": [2600] * 3},
    }
    for name, other in others.items():
        assert (FORMULAS[name](radius=radius, **other) == FORMULAS[name](radius=radius.astype(float), **other)).all()
    energies = {"surface_energy": radius, "surface_energy2": radius.tolist()}
    assert FORMULAS["work_of_adhesion"](**energies).tolist() == [2.0, 200.0, 510.0]
    assert jkroll.formulas.load_factor(load_margin=1) == 1.0
    for odd in ("1e-7", None, [1, "x"], np.ma.masked_array([1], [True])):
        with pytest.raises(QuantityError):
            FORMULAS["mass"](radius=odd, density=1.0)


def test_unknown_names_are_refused() -> None:
    wrong: Any
    for wrong in (None, [None], ["pull_off_force", "pull_off"], 3):
        with pytest.raises(UnknownQuantity):
            solve(wrong, radius=1e-7, **QUARTZ)
    for wrong in ("material", "model", "state"):
        with pytest.raises(UnknownQuantity, match="stands for a word, not a number"):
            solve(wrong, radius=1e-7, **QUARTZ)
    for wrong in ("mine.toml", ["mine.toml"]):
        with pytest.raises(QuantityError, match=r"write Materials\(\"mine.toml\"\)"):
            solve("pull_off_force", material="quartz", radius=1e-7, materials=wrong)
    for wrong in (["quartz", 3], 1, b"quartz"):
        with pytest.raises(QuantityError):
            solve("pull_off_force", material=wrong, radius=1e-7)
    assert solve([], radius=1e-7) == {}


def test_help_shows_the_formula_and_readable_types() -> None:
    text = pydoc.render_doc(jkroll.formulas.pull_off_force, renderer=pydoc.TextDoc())
    assert "work_of_adhesion: 'SurfaceEnergy'" in text
    assert "P_c = 3πγR" in text
    assert "P ≥ −P_c" in pydoc.render_doc(jkroll.formulas.load_margin, renderer=pydoc.TextDoc())
    assert [name for name, formula in FORMULAS.items() if "Annotated" in str(inspect.signature(formula))] == []


def test_an_approach_beyond_the_fold_is_refused() -> None:
    approach = solve("approach", radius=1e-7, **QUARTZ)
    with pytest.raises(Failure, match="the spheres have parted"):
        solve("load_factor_at_approach", radius=1e-7, approach_at_load=-approach, **QUARTZ)


def test_a_type_checker_sees_a_number_or_an_array() -> None:
    """The check is made by mypy."""
    assert_type(jkroll.formulas.yield_angle(yield_displacement=2e-10, reduced_radius=5e-8), float | NDArray[np.float64])


def test_pint_quantities_are_accepted_and_returned() -> None:
    force = solve("pull_off_force", radius=UREG.Quantity(100.0, "nm"), surface_energy=UREG.Quantity(25.0, "erg/cm^2"))
    assert math.isclose(force.m_as("nN"), 11.780972450961725, rel_tol=1e-14)
    direct = FORMULAS["pull_off_force"](
        work_of_adhesion=UREG.Quantity(50.0, "mJ/m^2"), reduced_radius=UREG.Quantity(50.0, "nm")
    )
    assert math.isclose(direct.m_as("nN"), 11.780972450961725, rel_tol=1e-14)


@pytest.mark.parametrize(
    ("given", "words"),
    [({"youngs_modulus": INFINITY}, "both bodies are rigid"), ({"load": -1.2e-8}, "-12 nN breaks this contact")],
)
def test_impossible_contacts_raise_their_reason(given: dict[str, float], words: str) -> None:
    with pytest.raises(Failure, match=words):
        solve("vertical_frequency", **{**QUARTZ, "radius": 1e-7, **given})


@pytest.mark.parametrize(
    ("scene", "words"),
    [
        ({"radius": [1e-7, math.nan]}, "radius: nan at index 1 must be a number"),
        ({"radius": 1e-7, "load": [[0.0, 0.0], [math.nan, 0.0]]}, "load: nan at index 1, 0 must be a number"),
        ({"radius": np.array([1e-7, 1e300])}, "radius: 1e+300 at index 1 must lie between 1e-30 and 1e30 in SI units"),
    ],
)
def test_a_refused_element_of_an_array_is_named_with_its_index(scene: dict[str, Any], words: str) -> None:
    with pytest.raises(QuantityError) as refused:
        solve("stiffness", **scene, **QUARTZ)
    assert str(refused.value) == words
    with pytest.raises(QuantityError) as refused:
        jkroll.infer("gamma", measured={"pull_off_force": 1e-8}, **scene)
    assert str(refused.value) == words


def test_work_of_adhesion_needs_no_surface_energy_and_overrides_it() -> None:
    assert solve("pull_off_force", radius=1e-7, work_of_adhesion=0.05) == solve(
        "pull_off_force", radius=1e-7, surface_energy=0.025
    )
    assert solve("pull_off_force", radius=1e-7, work_of_adhesion=0.05, material="iron", material2="gold") == solve(
        "pull_off_force", radius=1e-7, surface_energy=0.025
    )


def test_a_given_value_replaces_its_formula() -> None:
    assert solve("load_margin", load_margin=0.5, radius=1e-7, **QUARTZ) == 0.5
    half = solve("yield_force", radius_ratio=3.0, **QUARTZ)
    assert close(half, solve("yield_force", **QUARTZ) / 2)


def test_an_energy_ratio_gives_the_same_results_as_its_energy() -> None:
    scene: dict[str, Any] = {"radius": 1e-7, **QUARTZ}
    energy = solve("adhesion_energy", **scene)
    for name in ("n_roll", "n_roll_energy_balance", "energy_over_yield"):
        assert close(solve(name, energy_ratio=5.0, **scene), solve(name, energy=5 * energy, **scene))


def test_free_spheres_do_not_vibrate_beyond_pull_off() -> None:
    assert solve("vertical_frequency", load_factor=0.5 + 1e-6, radius=1e-7, **QUARTZ) > 0
    approach = solve("approach", radius=1e-7, **QUARTZ)
    for beyond in ({"load_factor": 0.5 - 1e-6}, {"approach_at_load": -0.6 * approach}):
        with pytest.raises(Failure, match="only fixed grips hold"):
            solve("vertical_frequency", **beyond, radius=1e-7, **QUARTZ)


def test_contradictions_and_mismatches_are_refused() -> None:
    with pytest.raises(BadRequest, match="exclude each other"):
        solve("stiffness", radius=1e-7, load=5e-9, approach_at_load=5e-11, **QUARTZ)
    with pytest.raises(BadRequest, match="do not broadcast"):
        solve("reduced_radius", radius=[1e-7, 2e-7], radius2=[1e-7, 2e-7, 3e-7])
    with pytest.raises(QuantityError):
        solve("load", load_factor=-1.0, radius=1e-7, **QUARTZ)
    with pytest.raises(QuantityError):
        solve("pull_off_force", radius=np.ma.masked_array([1e-7, 2e-7], [False, True]), **QUARTZ)


def test_only_needed_inputs_are_required() -> None:
    assert solve("yield_force", surface_energy=0.025) == solve("yield_force", surface_energy=0.025, radius=1e-7)
    assert solve("r_min", radius=1e-7) > 0
    assert solve(
        ["pull_off_force", "yield_force", "r_min", "n_grav", "rolling_frequency"], material="gold", radius=1e-7
    )
    assert solve("n_roll", material="gold", radius=1e-7, energy=1e-18) > 0
    with pytest.raises(MissingInput, match="gold has none in Table 1 of D&T"):
        solve("n_roll", material="gold", radius=1e-7)
