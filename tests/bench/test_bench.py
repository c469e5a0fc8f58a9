"""The benchmark reproduces the known errors of each way to compute a quantity; the times are not checked."""

import csv
import io
import json
import math
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from harness import Run, Stream
from jkroll import physics
from jkroll.bench.report import (
    DECIMALS,
    DEFAULT,
    HEADS,
    OTHER_WAYS,
    PROMISE,
    PROMISE_OF_MAUGIS,
    QUANTITIES,
    QUICK,
    REGIONS,
    Row,
    as_rows,
    exact,
    measure,
    picture_of_bench,
    regions,
    write_bench,
)
from reference import BOUND, conditions, exact_results
from relative import approx

OF_MAUGIS = "contact_radius_maugis"
SMALL = QUICK._replace(points=24, elements=1000, repeats=1)


@cache
def rows() -> dict[tuple[str, str], Row]:
    """Return the rows of a small benchmark."""
    return {(row.quantity, row.way): row for row in measure(SMALL)}


def test_every_quantity_has_other_ways() -> None:
    assert all(OTHER_WAYS.values())


@pytest.mark.parametrize("quantity", QUANTITIES)
@pytest.mark.parametrize("way", [DEFAULT, "jkroll, floats"])
def test_jkroll_keeps_the_promised_accuracy_in_every_region(quantity: str, way: str) -> None:
    row = rows()[quantity, way]
    assert row.worst <= (PROMISE_OF_MAUGIS if quantity == OF_MAUGIS else PROMISE)


def test_the_promised_accuracy_is_that_in_the_guide() -> None:
    guide = " ".join((Path(physics.__file__).parents[1] / "guide" / "accuracy.md").read_text(encoding="utf-8").split())
    assert f"within {PROMISE} ulp times 1 + κ" in guide
    assert f"Maugis' law it is within {PROMISE_OF_MAUGIS} ulp times 1 + κ" in guide
    assert PROMISE == BOUND


def test_quantities_that_depend_on_the_load_are_not_computed_at_the_fold() -> None:
    for (quantity, _), row in rows().items():
        is_of_load = {"P", "P_c"} & {*getattr(DECIMALS, quantity).__code__.co_varnames}
        assert set(row.errors) == {region for region in REGIONS if region != "fold" or not is_of_load}


def test_the_fit_to_maugis_law_has_its_known_error() -> None:
    """The contact radius of Carpick, Ogletree & Salmeron is within 3 %."""
    assert 0.005 < rows()["contact_radius_maugis", "COS 1999"].errors["ordinary"][1] * 2.0**-53 < 0.03


def test_a_table_of_states_has_its_known_error() -> None:
    row = rows()["load_factor_at_approach", "table of 10⁴ nodes"]
    assert row.worst >= 1e9
    assert row.worst > row.errors["ordinary"][1]


def test_the_closed_form_of_other_programs_fails_for_large_approaches() -> None:
    """Parteli et al. solve the quartic exactly, but their solution has a difference that is lost to rounding."""
    errors = rows()["load_factor_at_approach", "Parteli et al. 2014"].errors
    assert max(errors[region][1] for region in REGIONS if region != "extreme") < PROMISE
    assert errors["extreme"][1] == math.inf


def test_conditions_computed_with_decimals_and_with_mpmath_agree() -> None:
    """The package computes the condition κ with respect to the load with decimals, and the tests with mpmath."""
    names = ("contact_radius_at_load", "stiffness", "yield_moment")
    for point in as_rows(regions(10)["ordinary"]):
        given = {
            **{name: point[name] for name in ("radius", "radius2", "yield_displacement", "load")},
            "density": 1.0,
            "surface_energy": point["work_of_adhesion"] / 2,
            "youngs_modulus": 2 * point["contact_modulus"],
            "poisson_ratio": 0.0,
        }
        wanted = conditions(given, exact_results(given))
        for quantity in names:
            assert exact(quantity, point)[1] == approx(wanted[quantity], rel=1e-6)


@pytest.fixture
def _small(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let `bench --quick` compute few points, and print on a wide terminal."""
    monkeypatch.setattr("jkroll.bench.report.QUICK", SMALL._replace(points=20))
    monkeypatch.setenv("COLUMNS", "200")


@pytest.mark.usefixtures("_small")
@pytest.mark.parametrize(
    "kind", ["table", *(pytest.param(kind, marks=pytest.mark.slow) for kind in ("json", "plain", "csv"))]
)
def test_all_formats_are_written(kind: str) -> None:
    out = Stream()
    write_bench(out, kind, SMALL._replace(points=20))
    text = out.text()
    if kind == "json":
        assert {tuple(row) for row in json.loads(text)} == {HEADS}
    elif kind == "csv":
        assert {len(line) for line in csv.reader(io.StringIO(text))} == {len(HEADS)}
    elif kind == "plain":
        assert text.startswith("\t".join(HEADS) + "\n")
        assert {line.count("\t") for line in text.splitlines()} == {len(HEADS) - 1}
    else:
        assert f"numpy {np.__version__}" in text.splitlines()[0]
        assert "\nas printed " in text


def test_a_plot_has_a_point_and_the_name_of_every_way() -> None:
    panels = picture_of_bench([*rows().values()]).panels
    for quantity, panel in zip(QUANTITIES, panels, strict=True):
        *ways, promise = panel.curves
        assert {curve.text for curve in ways} == {way for name, way in rows() if name == quantity}
        assert {*promise.y.tolist()} == {PROMISE_OF_MAUGIS if quantity == OF_MAUGIS else PROMISE}
        for curve in ways:
            row, x, y = rows()[quantity, curve.text], curve.x.item(), curve.y.item()
            assert x == approx(row.cost * 1e-9)
            assert y == (row.worst if 0.1 < row.worst < 2**53 else approx(2**53))
            assert panel.x.has(x)
            assert panel.y.has(y)


@pytest.mark.slow
@pytest.mark.usefixtures("_small")
def test_an_old_plot_is_replaced_only_by_a_complete_plot(run: Run, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    file = tmp_path / "bench.svg"
    file.write_bytes(b"before")
    with file.open("rb") as old:
        assert run("bench", "--quick", "--plot", str(file)).code == 0
        assert old.read() == b"before"  # the file was replaced only when the new one was complete
    assert file.stat().st_size > 1000
    assert not list(tmp_path.glob(".*"))


def test_a_plot_with_an_unknown_extension_is_refused_before_the_measurement(run: Run) -> None:
    problem = "--plot: 'bench.txt' does not end in .svg, .pdf or .png"
    assert run("bench --plot bench.txt").err == f"jkroll: {problem}\n"


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        ("--style dark --width 85mm", "--width and --style apply to files; add --plot FILE"),
        ("--plot b.svg --style pink", "--style: 'pink' is not a style; choose one of paper and dark"),
        ("--plot b.svg --width 1mm", "--width: '1mm' is not between 70mm and 1m"),
    ],
)
def test_wrong_options_of_a_plot_are_refused_before_the_measurement(run: Run, words: str, problem: str) -> None:
    assert run(f"bench {words}").err == f"jkroll: {problem}\n"
