"""The recipe for a force curve in the manual, against the truth of a curve that the program did not make."""

import doctest
import re
import shutil
from pathlib import Path
from typing import Any

import numpy
import pytest

from jkroll import infer, solve
from jkroll.model.unsolved import Unseparated
from jkroll.write.manual import page
from relative import approx
from tools import lennard_jones as made

CURVE = Path(__file__).parents[1] / "data" / "force_curve.csv"
RECIPE = page("measurements").partition("## A force curve")[2].partition("## ")[0]


@pytest.fixture
def recipe() -> dict[str, Any]:
    """Return the names of the recipe once it was run, with their values."""
    shutil.copy(CURVE, "curve.csv")
    block = re.findall(r"```python\n(.*?)```", RECIPE, re.DOTALL)[0]
    names: dict[str, Any] = {}
    for example in doctest.DocTestParser().get_examples(block):
        exec(example.source, names)
    return names


def test_what_was_put_in_is_found_as_well_as_the_page_says(recipe: dict[str, Any]) -> None:
    fits, force_by, approach, force = (recipe[name] for name in ("fits", "force_by", "approach", "force"))
    gamma = {law: 1e-3 * fit[0] / made.GAMMA for law, fit in fits.items()}
    assert gamma == approx({"jkr": 1.11, "maugis": 1.06}, abs=0.005)
    for law, fit in fits.items():
        assert 1e9 * fit[1] == approx(made.YOUNGS_MODULUS, rel=0.01)
        assert 1e-9 * fit[2] == approx(made.ZERO - made.SPACING, abs=0.02e-9)
        left = 1e-9 * force_by(law)(approach, *fit) - force
        assert left.std() == approx(made.NOISE, rel=0.2)
        thirds = [abs(part.mean()) for part in numpy.array_split(left, 3)]
        assert max(thirds) < 2 * made.NOISE / len(left) ** 0.5  # no trend
    assert (
        abs(force_by("jkr")(approach, *fits["jkr"]) - force_by("maugis")(approach, *fits["maugis"])).max()
        < 1e9 * made.NOISE
    )
    recipe["sphere"]["atomic_spacing"] = "2 angstrom"
    fit, _ = recipe["curve_fit"](force_by("maugis"), approach, 1e9 * force, fits["maugis"])
    assert 1e-3 * fit[0] / made.GAMMA == approx(1.10, abs=0.005)


@pytest.mark.slow
def test_the_curve_is_that_of_its_generator() -> None:
    approach, force = numpy.array([*made.force_curve()]).T
    stored = numpy.loadtxt(CURVE, delimiter=",", skiprows=1, unpack=True)
    assert approach == approx(stored[0], abs=1e-12)
    assert force == approx(stored[1], abs=1e-10)


@pytest.mark.parametrize("law", ["jkr", "maugis", "dmt"])
def test_a_curve_has_two_numbers_in_it(law: str) -> None:
    """They are γR and E²R, on which μ depends as well."""
    sphere: dict[str, Any] = {"radius": 1e-6, "surface_energy": 0.04, "youngs_modulus": 6e9}
    other: dict[str, Any] = {"radius": 4e-6, "surface_energy": 0.01, "youngs_modulus": 3e9}
    approach = numpy.linspace(0, 5e-9, 50)
    given: dict[str, Any] = {"radius2": "plane", "poisson_ratio": 0.3, "approach_at_load": approach, "model": law}
    assert solve("load", **other, **given) == approx(solve("load", **sphere, **given), rel=1e-12)


@pytest.mark.parametrize("force", ["adhesive_force", "pull_off_force_dmt"])
def test_forces_alone_leave_the_modulus_open(force: str) -> None:
    sphere: dict[str, Any] = {"radius": 1e-6, "radius2": "plane", "poisson_ratio": 0.3}
    with pytest.raises(Unseparated, match="they leave E1 open"):
        infer(["gamma", "young"], measured={"pull_off_force": 2.6e-7, force: 2.6e-7}, **sphere)
