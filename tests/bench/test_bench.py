"""The benchmark tells what is known of the ways to each quantity; seconds are not asserted."""

import csv
import io
import json
import math
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from harness import Run, Stream
from jkroll import solve
from jkroll.bench.bare import WANTED, BareArrays, bare_numbers
from jkroll.bench.measure import DEFAULT, QUICK, Row, compare, measure, with_front
from jkroll.bench.reference import exact, references
from jkroll.bench.report import HEADS, RATIO_HEADS, off_front, plot_bench, write_bench
from jkroll.bench.scenes import hard, ordinary, point_maker
from jkroll.bench.ways import OTHER_WAYS, QUANTITIES
from reference import exact_results, ulp_error

SMALL = QUICK._replace(points=100, elements=1000, numbers=5, repeats=1, scenes=1000)


@cache
def rows() -> dict[tuple[str, str], Row]:
    """A small benchmark."""
    return {(row.quantity, row.way): row for row in measure(SMALL)}


def test_every_quantity_has_other_ways_and_a_reference() -> None:
    assert set(OTHER_WAYS) == set(references()) == set(QUANTITIES)
    assert all((quantity, DEFAULT) in rows() and len(OTHER_WAYS[quantity]) for quantity in QUANTITIES)


@pytest.mark.parametrize("quantity", QUANTITIES)
@pytest.mark.parametrize("way", [DEFAULT, "jkroll, floats", "jkroll, pint arrays"])
def test_the_default_keeps_the_digits(quantity: str, way: str) -> None:
    row = rows()[quantity, way]
    assert row.worst < 5
    assert row.worst_hard < 5


@pytest.mark.parametrize(
    ("quantity", "way", "lost"),
    [
        ("yield_moment", "s = √(1+P/P_c)", 1e5),
        ("stiffness", "s = √(1+P/P_c)", 1e6),
        ("stiffness", "slopes of P(â) and δ(â)", 1e6),
        ("approach_at_load", "8+9P/P_c", 1e6),
        ("load_factor_at_approach", "closed form, radicals", math.inf),
        ("load_factor_at_approach", "Newton on the quartic", 1e4),
        ("load_factor_at_approach", "closed form, Vieta", 1e4),
        ("yield_moment", "half-circles, Eq 19", 1e12),
    ],
)
def test_what_is_known_to_lose_digits_loses_them(quantity: str, way: str, lost: float) -> None:
    row = rows()[quantity, way]
    assert row.worst_hard >= lost
    assert row.worst_hard > row.worst


def test_quadrature_converges_in_the_angle_and_hardly_in_the_radius() -> None:
    in_radius, more, in_angle = (
        rows()["yield_moment", way].median for way in ("Gauss 8 in r", "Gauss 64 in r", "Gauss 8 in angle")
    )
    assert in_radius > more > in_radius / 100
    assert in_angle < 1e-9 * more
    assert rows()["yield_moment", "Gauss 16 in angle"].median < 10


def test_single_precision_keeps_half_of_the_digits() -> None:
    assert 2.0**26 < rows()["yield_moment", "jkroll, float32"].median < 2.0**30


def test_the_load_margin_as_printed_loses_a_million_ulp_at_pull_off() -> None:
    for quantity in ("stiffness", "yield_moment", "yield_force", "n_grav", "n_roll"):
        worst = max(row.worst_hard for (name, way), row in rows().items() if name == quantity and way in _PRINTED)
        assert worst > 1e5, quantity
    assert rows()["stiffness", "s = √(1+P/P_c)"].worst_hard > 1e6


_PRINTED = ("s = √(1+P/P_c)", "M/R1, s = √(1+P/P_c)", "Eq 30, s = √(1+P/P_c)", "Eq 49 as printed")


@pytest.mark.parametrize("points", [ordinary(40), hard(40)], ids=["ordinary", "hard"])
def test_two_references_agree(points: dict[str, np.ndarray]) -> None:
    """That of the package and that of the tests, which take the load in different terms."""
    for place in range(40):
        point = point_maker(points)(place)
        given = {
            "radius": point["radius"],
            "radius2": point["radius2"],
            "surface_energy": point["work_of_adhesion"] / 2,
            "youngs_modulus": 2 * point["contact_modulus"],
            "poisson_ratio": 0.0,
            "density": point["density"],
            "yield_displacement": point["yield_displacement"],
            "gravity": point["gravity"],
        }
        unloaded = {**point, "load": 0.0}
        wanted = exact_results(given)
        for quantity in QUANTITIES:
            if quantity != "load_factor_at_approach":
                ((nearest, _),) = exact(quantity, [unloaded])
                assert ulp_error(nearest, wanted[quantity]) <= 0.5 + 1e-9


def test_by_hand_means_the_same_arithmetic() -> None:
    points = ordinary(50)
    given = {
        "radius": points["radius"],
        "radius2": points["radius2"],
        "density": points["density"],
        "surface_energy": points["work_of_adhesion"] / 2,
        "youngs_modulus": points["contact_modulus"],
        "poisson_ratio": np.full(50, 0.2),
        "load": points["load"] / 2,
    }
    wanted = solve(WANTED, **given)
    for name, values in BareArrays(50).run(given).items():
        np.testing.assert_array_equal(values, wanted[name], err_msg=name)
    for name, value in bare_numbers(point_maker(given)(7)).items():
        assert value == pytest.approx(wanted[name][7], rel=1e-14)


def test_the_front_is_made_of_those_that_no_other_beats() -> None:
    def row(way: str, cost: float, error: float) -> Row:
        return Row("r_min", way, cost, 0.0, error, error)

    found = with_front(
        [row(DEFAULT, 10, 2), row("rough", 1, 9), row("slow", 20, 2), row("poor", 10.5, 3), row("exact", 99, 0.5)]
    )
    assert [one.way for one in found if one.on_front] == [DEFAULT, "rough", "exact"]
    assert off_front(found) == []
    beaten = with_front([row(DEFAULT, 10, 2), row("better", 5, 1)])
    assert off_front(beaten) == [
        "r_min: the default is not on the front: 10 ns and 2 ulp against 5 ns and 1 ulp by better"
    ]


def test_memory_is_measured_beyond_the_results() -> None:
    arrays, one = compare(SMALL)
    assert (arrays.scenes, one.scenes) == (1000, 1)
    assert arrays.ratio > 0
    assert arrays.extra_memory > 0


@pytest.fixture
def _small(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("jkroll.bench.report.QUICK", SMALL._replace(points=20))
    monkeypatch.setattr("jkroll.bench.report.measure", lambda size: measure(size, ["r_min", "approach_at_load"]))
    monkeypatch.setenv("COLUMNS", "200")


@pytest.mark.usefixtures("_small")
@pytest.mark.parametrize("kind", ["table", "plain", "csv", "json"])
def test_what_is_written(kind: str) -> None:
    out = Stream()
    assert write_bench(out, kind, quick=True) == 0
    text = out.text()
    if kind == "json":
        whole = json.loads(text)
        assert tuple(whole["ways"][0]) == HEADS
        assert tuple(whole["solve"][0]) == RATIO_HEADS
    elif kind == "csv":
        first, second = text.split("\n\n")
        assert tuple(next(csv.reader(io.StringIO(first)))) == HEADS
        assert tuple(next(csv.reader(io.StringIO(second)))) == RATIO_HEADS
    elif kind == "plain":
        assert text.startswith("\t".join(HEADS) + "\n")
        assert all(line.count("\t") in {len(HEADS) - 1, len(RATIO_HEADS) - 1} for line in text.splitlines())
    else:
        assert "8(P+P_c)+P" in text


@pytest.mark.slow
def test_a_plot(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    file = tmp_path / "bench.svg"
    file.write_bytes(b"before")
    with file.open("rb") as old:
        plot_bench(list(rows().values()), file)
        assert old.read() == b"before"  # it was replaced when it was whole
    assert file.stat().st_size > 1000
    assert not list(tmp_path.glob(".*"))


def test_a_plot_of_no_known_ending_is_refused_before_anything_is_measured(run: Run) -> None:
    problem = "--plot: 'bench.txt' does not end in .svg, .pdf or .png"
    assert run("bench --plot bench.txt").err == f"jkroll: {problem}\n"
