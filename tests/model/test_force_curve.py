"""The fit of the manual's force curve, compared with the inputs of the tool that made the curve without jkroll."""

from pathlib import Path
from typing import Any

import numpy
import pytest

from jkroll import fit, infer, solve
from jkroll.model.unknowns import Unseparated
from relative import approx
from tools import lennard_jones as made

CURVE = Path(__file__).parents[1] / "data" / "force_curve.csv"
SPHERE: dict[str, Any] = {"radius": "1 um", "radius2": "plane", "poisson_ratio": 0.3}


def fitted_by(law: str, **given: Any) -> Any:
    return fit(str(CURVE), **SPHERE, youngs_modulus2="rigid", model=law, **given)


@pytest.mark.parametrize(("law", "spacing", "ratio"), [("jkr", 4, 1.11), ("maugis", 4, 1.06), ("maugis", 2, 1.10)])
def test_the_fit_recovers_the_inputs_as_accurately_as_the_guide_says(law: str, spacing: float, ratio: float) -> None:
    """The ratios are those of `guide measurements`."""
    fitted = fitted_by(law, atomic_spacing=1e-10 * spacing)
    assert fitted.values["work_of_adhesion_opening"] / 2 / made.GAMMA == approx(ratio, abs=0.008)
    assert fitted.other_modulus[1] == approx(made.YOUNGS_MODULUS, rel=0.01)
    assert fitted.values["contact_point"] == approx(made.ZERO - made.SPACING, abs=0.02e-9)
    assert fitted.goodness["rms"] == approx(made.NOISE, rel=0.2)
    residuals = fitted.curve["residual [N]"]
    means_of_thirds = [abs(third.mean()) for third in numpy.array_split(residuals, 3)]
    assert max(means_of_thirds) < 2 * made.NOISE / len(residuals) ** 0.5  # no trend
    if spacing == 4:  # the spacing of the curve
        total = fitted.errors["work_of_adhesion_opening"].total
        assert abs(fitted.values["work_of_adhesion_opening"] - 2 * made.GAMMA) < 2 * total


@pytest.mark.parametrize("law", ["jkr", "maugis"])
def test_scipy_fits_the_same_values_with_loads_by_solve(law: str) -> None:
    """The loads at the measured approaches are fitted, all with the same weight."""
    optimize = pytest.importorskip("scipy.optimize")
    approach, force = numpy.loadtxt(CURVE, delimiter=",", skiprows=1, unpack=True)

    def force_at(depth: Any, gamma: Any, modulus: Any, zero: Any) -> Any:
        given = {
            **SPHERE,
            "surface_energy": 1e-3 * gamma,
            "youngs_modulus": 1e9 * modulus,
            "youngs_modulus2": numpy.inf,
        }
        return 1e9 * numpy.nan_to_num(solve("load", approach_at_load=depth - 1e-9 * zero, model=law, **given))

    found, covariance = optimize.curve_fit(force_at, approach, 1e9 * force, [27.0, 6.0, 11.9])
    fitted = fitted_by(law)
    own = [500 * fitted.values["work_of_adhesion_opening"], fitted.other_modulus[1] / 1e9]
    errors = numpy.sqrt(numpy.diag(covariance))
    assert (abs(own - found[:2]) < 1.5 * errors[:2]).all()


@pytest.mark.slow
def test_the_stored_curve_is_that_of_its_generator() -> None:
    approach, force = numpy.array([*made.force_curve()]).T
    stored = numpy.loadtxt(CURVE, delimiter=",", skiprows=1, unpack=True)
    assert approach == approx(stored[0], abs=1e-12)
    assert force == approx(stored[1], abs=1e-10)


@pytest.mark.parametrize("law", ["jkr", "maugis", "dmt"])
def test_a_curve_determines_only_two_numbers(law: str) -> None:
    """The numbers are γR and E²R, which also determine μ."""
    sphere: dict[str, Any] = {"radius": 1e-6, "surface_energy": 0.04, "youngs_modulus": 6e9}
    other: dict[str, Any] = {"radius": 4e-6, "surface_energy": 0.01, "youngs_modulus": 3e9}
    approach = numpy.linspace(0, 5e-9, 50)
    given: dict[str, Any] = {"radius2": "plane", "poisson_ratio": 0.3, "approach_at_load": approach, "model": law}
    assert solve("load", **other, **given) == approx(solve("load", **sphere, **given), rel=1e-12)


@pytest.mark.parametrize("force", ["adhesive_force", "pull_off_force_dmt"])
def test_forces_alone_leave_the_modulus_open(force: str) -> None:
    sphere: dict[str, Any] = {"radius": 1e-6, "radius2": "plane", "poisson_ratio": 0.3}
    with pytest.raises(Unseparated, match="they do not determine E1"):
        infer(["gamma", "young"], measured={"pull_off_force": 2.6e-7, force: 2.6e-7}, **sphere)
