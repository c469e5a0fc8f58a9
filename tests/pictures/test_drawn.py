"""`jkroll.map`, `curve` and `figure`: the numbers of the commands' pictures, and pictures on a user's axes."""

import csv
from functools import cache
from pathlib import Path
from typing import Any, cast

import numpy
import pytest

import jkroll
from harness import Run
from jkroll.pictures.drawn import Drawn
from relative import approx

pytest.importorskip("matplotlib")


def of_command(run: Run, *words: str) -> list[dict[str, str]]:
    """Return the rows that a command writes with `--data`."""
    assert run(*words, "--data", "a.csv").code == 0
    with Path("a.csv").open(encoding="utf-8") as file:
        return [*csv.DictReader(file)]


def test_a_map_has_the_numbers_of_the_command(run: Run) -> None:
    axes: Any = {"x": "radius=10nm:1um:3", "y": "young=1GPa:100GPa:4"}
    rows = of_command(run, "map", "contact_radius", "quartz", *(f"--{side}={text}" for side, text in axes.items()))
    drawn = jkroll.map("contact_radius", material="quartz", **axes)
    assert drawn.field is not None
    x, y, values = drawn.field
    assert [float(row["contact_radius [m]"]) for row in rows] == approx(values.ravel().tolist(), rel=1e-9)
    assert [float(row["radius [m]"]) for row in rows[:3]] == approx(x.tolist(), rel=1e-9)
    assert [float(row["youngs_modulus [Pa]"]) for row in rows[::3]] == approx(y.tolist(), rel=1e-9)


def test_a_line_has_the_numbers_of_solve() -> None:
    ((_, (radii, forces)),) = jkroll.map("P_c", x="radius=10nm:1um:5", material="iron", model="dmt").lines.items()
    assert forces.tolist() == jkroll.solve("P_c", material="iron", model="dmt", radius=radii).tolist()


def test_a_figure_has_the_numbers_of_the_command(run: Run) -> None:
    rows, lines = of_command(run, "figure", "laws"), jkroll.figure("laws").lines
    head_of_x, head_of_y = [*rows[0]][1:]
    for label, (x, y) in lines.items():
        assert [float(row[head_of_x]) for row in rows if row["curve"] == label] == approx(x.tolist(), rel=1e-9)
        assert [float(row[head_of_y]) for row in rows if row["curve"] == label] == approx(y.tolist(), rel=1e-9)


@pytest.mark.parametrize("model", ["jkr", "dmt"])
def test_approaches_of_a_curve_are_those_of_solve_at_its_loads(model: str) -> None:
    drawn = jkroll.curve(material="quartz", radius="100 nm", model=model, load=(-5e-9, 20e-9))
    approaches, loads = drawn.lines["stable"]
    assert [loads.min(), loads.max()] == approx([-5e-9, 20e-9], rel=1e-12)
    solved = jkroll.solve("approach_at_load", material="quartz", radius=1e-7, model=model, load=loads[1:-1])
    assert solved.tolist() == approx(approaches[1:-1].tolist(), rel=1e-9)  # the ends are interpolated


def test_each_of_several_laws_is_one_line_with_gaps_between_branches() -> None:
    lines = jkroll.curve(material="quartz", radius="100 nm", model=["jkr", "maugis"]).lines
    single = jkroll.curve(material="quartz", radius="100 nm").lines.values()
    x, y = lines["JKR"]
    assert numpy.isnan(x).tolist() == numpy.isnan(y).tolist()
    assert numpy.isnan(x).sum() == len(single) - 1
    assert numpy.nanmin(y) == min(float(forces.min()) for _, forces in single)
    assert "Maugis–Dugdale" in lines


def test_the_stable_branch_ends_at_the_pull_off_force() -> None:
    drawn = jkroll.curve(material="quartz", radius="100 nm")
    force = jkroll.solve("P_c", material="quartz", radius=1e-7)
    assert drawn.lines["stable"][1].min() == approx(-force, rel=1e-12)
    assert drawn.points["pull-off"][1] == approx(-force, rel=1e-12)
    assert "quartz" in drawn.caption


@pytest.mark.parametrize(
    ("name", "panels"),
    [("2", 2), ("3a", 1), *(pytest.param(name, 1, marks=pytest.mark.slow) for name in ("6b", "laws"))],
)
def test_a_figure_is_drawn_on_axes_of_a_user(name: str, panels: int) -> None:
    from matplotlib.figure import Figure

    axes = Figure(figsize=(5 * panels, 4)).subplots(1, panels)
    assert jkroll.figure(name).plot(axes) is axes
    for one in numpy.ravel(axes):
        assert one.get_xlabel()
        assert one.has_data()


def test_a_notebook_shows_a_picture() -> None:
    content, shown = jkroll.figure("laws")._repr_png_()
    assert content.startswith(b"\x89PNG")
    assert 300 < shown["width"] < 1200


def test_without_axes_plot_makes_a_new_figure() -> None:
    axes = jkroll.curve(material="quartz", radius="100 nm").plot()
    assert len(axes.lines) >= 3
    assert len(jkroll.curve(material="quartz", radius="100 nm", panel=None).plot()) == 3


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: jkroll.figure("4"), "is not a figure; choose one of 2, 3a"),
        (lambda: jkroll.figure("2", marks=["quartz"]), "figure 2 takes no marks"),
        (lambda: jkroll.figure("3a", as_printed=True), "figure 3a takes no as_printed"),
        (lambda: jkroll.curve(material="quartz", radius=1e-7, panel="forces"), "choose one of force, pressure"),
        (lambda: jkroll.curve(material="quartz", radius=1e-7, load=(1e-9, -1e-9)), "the lower end first"),
        (lambda: jkroll.curve(material="quartz", radius=1e-7, model=["jkr", "JKR"], panel=None), "are one law"),
        (lambda: jkroll.curve(material="quartz", radius=1e-7, model=[]), "is an empty list"),
        (lambda: jkroll.curve(material="quartz", radius=[1e-7, 2e-7]), "describes more than one contact"),
        (lambda: jkroll.curve(material="quartz", radius=1e-7).plot(style="pink"), "is not a style"),
        (lambda: jkroll.map("P_c", x="radius=1nm:1um", radius=1e-7), "leave out its single value"),
        (lambda: jkroll.map("P_c", x="density=1g/cm3:2g/cm3"), "pull_off_force does not depend on density"),
        (lambda: jkroll.map("P_c", x="radius"), "x: write a quantity and its range"),
        (lambda: jkroll.figure("laws").plot(cast("Any", [1, 2])), "has 1 panels, and 2 axes were given"),
    ],
)
def test_invalid_calls_for_pictures_are_refused(call: Any, words: str) -> None:
    with pytest.raises(jkroll.JkrollError) as caught:
        call()
    assert words in str(caught.value)


@cache
def fitted_probe() -> Any:
    """Return the fit of a curve with noise and both branches."""
    path = Path(__file__).parents[1] / "data/probe.csv"
    return jkroll.fit(path, radius="7.5 um", radius2="plane", spring="3.01±0.1N/m", poisson_ratio2=0.5)


def test_the_caption_of_a_fit_has_sentences_with_typeset_symbols_and_no_options() -> None:
    from jkroll.pictures.fitted import caption_of_fit

    sentences = caption_of_fit(fitted_probe())
    assert sentences[0] == "Travel and force, by JKR, ⟦R⟧ = 7.5 µm, ⟦k⟧ = 3.01 N/m, paraboloid, 15 points."
    assert sentences[1].startswith("Work of adhesion on opening, ⟦w_open⟧ = 61.7 ± 1.7 mJ/m²; work of adhesion on ")
    assert all(sentence[0] in "⟦15" or sentence[0].isupper() for sentence in sentences)
    text = " ".join(sentences)
    assert "⟦a0/R⟧ = " in text
    assert " a sphere is no paraboloid." in text
    assert not any(sign in text for sign in ("--", "profile-matters", "few-independent", "2%"))


def test_measured_points_and_the_fitted_line_look_different() -> None:
    from matplotlib.figure import Figure

    first, *_ = fitted_probe().plot(Figure(figsize=(15, 4)).subplots(1, 3))
    looks = {line.get_label(): (line.get_linestyle(), line.get_marker(), line.get_color()) for line in first.lines}
    assert [*looks] == ["unloading, measured", "unloading, fitted", "loading, measured", "loading, fitted"]
    assert [style == "None" for style, _, _ in looks.values()] == [True, False, True, False]
    assert len({*looks.values()}) == 4
    legend = first.get_legend()
    assert [text.get_text() for text in legend.get_texts()] == [*looks]


def test_a_caption_fits_the_page() -> None:
    """Lines are broken by the mean width of a letter; with capitals and digits, they must be shortened."""
    wide = "JKR MAUGIS 558 mJ/m² " * 30
    drawn = jkroll.figure("laws")
    page = Drawn(drawn._picture._replace(caption=(wide,))).figure(caption=True)
    box = page.texts[-1].get_window_extent()
    assert 0.8 * page.get_figwidth() * page.dpi < box.x1 < page.get_figwidth() * page.dpi
