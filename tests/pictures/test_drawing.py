"""Pictures in files: contours follow formulas, texts do not overlap, and the same call gives the same bytes."""

import csv
import itertools
import math
import re
import subprocess
import sys
from functools import cache
from html import unescape
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from doors import call_of
from harness import Run
from jkroll import __version__, known_materials, solve
from jkroll.cli.draw import map_request
from jkroll.cli.process import main
from jkroll.model.estimate import WORDS, Estimate
from jkroll.model.frame import Frame
from jkroll.pictures.contact_curves import curves_of_contact
from jkroll.pictures.figures import PAPER_MAPS, PROFILES, paper_map
from jkroll.pictures.maps import MAX_CURVES, picture_of
from jkroll.pictures.picture import Curve, Field, Panel, Picture, described
from jkroll.quantities.markup import lines, plain, symbol, typeset
from jkroll.quantities.nomenclature import NOMENCLATURE
from jkroll.quantities.values import parse_quantity
from jkroll.report.curve import Loads, loads_of
from jkroll.report.questions import Question
from jkroll.report.report import Report
from jkroll.text import wrapped
from relative import approx

pytest.importorskip("matplotlib")
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.mathtext import MathTextParser
from matplotlib.path import Path as MplPath
from matplotlib.text import Text

from jkroll.pictures.page import draw_on, figure_of, levels_of, line_of, settings
from jkroll.pictures.picture import DARK, PAPER, STYLES, Style

POWERS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
_TEXT = re.compile(r"<text[^>]*>(.*?)</text>", re.DOTALL)
# The maps of the paper; the fast run draws one of them.
PAPER_FIGURES = [pytest.param(name, marks=pytest.mark.slow) if name != "8" else name for name in PAPER_MAPS]


def texts_of(svg: str) -> list[str]:
    """Return the texts of an SVG, without their styles."""
    return [unescape(re.sub(r"<[^>]*>", "", text)) for text in _TEXT.findall(svg)]


def map_drawn(words: list[str]) -> tuple[Picture, Panel, Field]:
    """Return the picture of a map over two axes, with its panel and its field."""
    drawn, _ = picture_of(map_request(call_of(["map", *words])))
    return (drawn, *field_of(drawn))


def field_of(drawn: Picture) -> tuple[Panel, Field]:
    """Return the panel of a map and its field."""
    (panel,) = drawn.panels
    assert panel.field is not None
    return panel, panel.field


def best_at(name: str, material: str, **given: float) -> Estimate:
    """Return the best range of a single answer."""
    answer = Report(Question((name,), (name,)), Frame(given, known_materials()[material]))
    return answer.estimates[name]


def on_axes(words: str) -> Figure:
    """Return a map over two axes on axes of a user, which takes less time than a page."""
    _, panel, _ = map_drawn(words.split())
    figure = Figure()
    draw_on(figure.subplots(), panel, PAPER)
    return figure


@cache
def paper_map_on_page(name: str, width: int = 85) -> tuple[Picture, Figure]:
    """Return a map of the paper, and its page of a width in mm, drawn once for all tests."""
    drawn = paper_map(name, known_materials(), as_printed=True)
    with settings(PAPER):
        return drawn, figure_of(drawn, width / 25.4, PAPER, has_caption=True)


@cache
def user_map(*words: str) -> tuple[Picture, Figure]:
    """Return the map of a command, and its page with a width of 120 mm, drawn once for all tests."""
    drawn, *_ = map_drawn([*words])
    with settings(PAPER):
        return drawn, figure_of(drawn, 120 / 25.4, PAPER, has_caption=True)


def contact_of_quartz() -> Picture:
    """Return the picture of all panels of a contact."""
    return curves_of_contact([Frame({"radius": 1e-7}, known_materials()["quartz"])], None, None)[0]


def lines_of(page: Figure, name: str) -> list[Any]:
    """Return the lines of a drawn map that have the given name in the file, in SI units."""
    drawings: list[Any] = [drawing for drawing in page.axes[0].collections if drawing.get_gid() == name]
    return [np.asarray(path.vertices) for drawing in drawings for path in drawing.get_paths()]


def contours(field: Field, page: Figure) -> list[tuple[float, Any]]:
    """Return each level of a drawn map with points on its lines, in SI units, at and between the vertices.

    The lines are straight on the page, so the points are computed in its pixels.
    """
    (axes,) = page.axes
    points_at = []
    for position, level in enumerate(levels_of(field)):
        points = []
        for line in lines_of(page, f"contour-{position}"):
            for start, end in itertools.pairwise(axes.transData.transform(line)):
                points += [start + (end - start) * share for share in (0, 0.3, 0.7, 1)]
        points_at.append((level, axes.transData.inverted().transform(points).T))
    return points_at


@pytest.mark.parametrize("name", PAPER_FIGURES)
def test_contours_of_the_figures_of_the_paper_follow_the_formula(name: str) -> None:
    drawn, page = paper_map_on_page(name)
    declared, (panel, field) = PAPER_MAPS[name], field_of(drawn)
    sampled = 0
    for value, (x, y) in contours(field, page):
        given: dict[str, Any] = {**declared.given, **panel.x.inputs(x), "radius": y}
        np.testing.assert_allclose(solve(declared.quantity, **given), value, rtol=2e-3)
        sampled += len(x)
    assert sampled >= 20


@pytest.mark.parametrize(
    ("words", "axes", "given"),
    [
        pytest.param(
            ["contact_radius_at_load", "quartz"],
            ("radius=50nm:1um", "load=-4nN:50nN:lin"),
            {"material": "quartz"},
            marks=pytest.mark.slow,
        ),
        (["n-roll", "quartz"], ("radius=10nm:1um", "speed=1cm/s:1m/s"), {"material": "quartz"}),
    ],
)
def test_contours_of_a_users_map_follow_the_formula(
    words: list[str], axes: tuple[str, str], given: dict[str, Any]
) -> None:
    drawn, page = user_map(*words, "--x", axes[0], "--y", axes[1])
    panel, field = field_of(drawn)
    spacing = (levels_of(field)[-1] - levels_of(field)[0]) / len(levels_of(field))
    for value, (x, y) in contours(field, page):
        values = solve(field.quantity, **given, **{panel.x.name: x, panel.y.name: y})
        assert abs(values / value - 1).max() < 1e-3 or abs(values - value).max() < 1e-3 * spacing


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["svg", "pdf", "png"])
def test_a_command_always_writes_the_same_bytes(run: Run, tmp_path: Path, kind: str) -> None:
    """The bytes depend neither on the process nor on the user's settings of matplotlib."""
    words = ["figure", "3a", "--mark", "quartz@100nm", "-o"]
    assert run(*words, f"one.{kind}").code == 0
    (tmp_path / "matplotlibrc").write_text("font.size: 20\nlines.linewidth: 9\n", encoding="utf-8")
    code = [sys.executable, "-m", "jkroll", *words, f"two.{kind}"]
    subprocess.run(code, check=True, capture_output=True, cwd=tmp_path, timeout=60)
    assert (tmp_path / f"one.{kind}").read_bytes() == (tmp_path / f"two.{kind}").read_bytes()


@pytest.mark.parametrize(
    "name",
    ["laws", *(pytest.param(name, marks=pytest.mark.slow) for name in (*PAPER_MAPS, "2", "9"))],
)
def test_every_figure_has_the_description_that_the_command_prints(run: Run, tmp_path: Path, name: str) -> None:
    ran = run("figure", name, "-o", "figure.svg", "--width", "85mm", "--style", "dark")
    assert (ran.code, ran.err) == (0, "")
    text = (tmp_path / "figure.svg").read_text(encoding="utf-8")
    (width,) = re.findall(r'<svg [^>]*width="([\d.]+)pt"', text)
    assert float(width) == approx(85 / 25.4 * 72, rel=1e-5)
    shown = " ".join(texts_of(text))
    words = {word for word in " ".join(ran.out.splitlines()[:2]).split() if re.fullmatch(r"[A-Za-z]{3,}[:,.]?", word)}
    assert words <= {*unescape(shown).split()}
    assert STYLES["dark"].paper in text


@pytest.mark.parametrize("kind", ["png", *(pytest.param(kind, marks=pytest.mark.slow) for kind in ("svg", "pdf"))])
def test_a_file_names_the_program_and_the_command_that_drew_it(run: Run, tmp_path: Path, kind: str) -> None:
    run(f"map pull-off quartz --x radius=10nm:1um --style dark -o out.{kind} --quiet")
    content = (tmp_path / f"out.{kind}").read_bytes()
    call = "jkroll map pull-off quartz --x=radius=10nm:1um --style=dark"
    for text in ("Pull-off force, P_c, Eq", f"jkroll {__version__}", call):
        assert text.encode() in content
    assert b"out." not in content


def test_an_svg_has_its_texts_as_text_in_embedded_fonts(run: Run, tmp_path: Path) -> None:
    """Words are whole, the letters of each text are in order, and the file is small."""
    run("figure 3a -o out.svg --quiet")
    svg = (tmp_path / "out.svg").read_text(encoding="utf-8")
    assert {"surface energy per surface, γ1", "100 mJ/m2", "10 mN", "graphite"} <= {*texts_of(svg)}
    assert "<title>Fig. 3a: P_c</title>" in svg
    assert "<desc>Pull-off force, P_c, Eq (1), by JKR." in svg
    assert f"jkroll {__version__}, jkroll figure 3a" in svg
    assert svg.count("@font-face") == 2
    assert len(svg) < 70_000


@pytest.mark.parametrize(
    ("words", "data"),
    [("pull-off ice-warm", ()), ("yield-force quartz", ()), ("restitution quartz --speed 1m/s", ("speed",))],
)
def test_the_band_of_a_curve_is_the_best_range_at_each_point(words: str, data: tuple[str, ...]) -> None:
    """The rule and its name in the key are those of single answers, with the uncertainties of the material."""
    drawn, _ = picture_of(map_request(call_of(["map", *words.split(), "--x", "radius=10nm:10um:7"])))
    ((curve,),) = (panel.curves for panel in drawn.panels)
    assert curve.band is not None
    material = words.split()[1]
    given: dict[str, Any] = dict.fromkeys(data, 1.0)
    name = drawn.panels[0].y.name
    for position, radius in enumerate(curve.x.tolist()):
        best = best_at(name, material=material, radius=radius, **given)
        ends = [end[position] for end in (curve.band.low, curve.band.high)]
        assert [math.nan if math.isinf(end) else end for end in ends] == approx([best.low, best.high], nan_ok=True)
        assert curve.band.by[position] == best.by
        assert WORDS[best.by].replace("ξ", "⟦ξ⟧") in curve.key


def test_at_the_edge_of_a_band_a_best_range_ends_at_the_value_of_a_contour() -> None:
    """A band is the part of a map where the best range includes the value of its contour."""
    words = "contact-radius-at-load quartz --x radius=50nm:1um --y load=0nN:50nN:lin"
    _, _, field = map_drawn(words.split())
    levels, misses = levels_of(field), []
    for line in lines_of(on_axes(words), "band"):
        radius, load = line[len(line) // 2]
        best = best_at("contact_radius_at_load", material="quartz", radius=radius, load=load)
        misses.append(min(abs(end / level - 1) for end in (best.low, best.high) for level in levels))
    assert len(misses) > 8
    assert max(misses) < 3e-3


# A map with bands of best ranges, and with several limits that are bounded by lines.
IMPACT = "restitution silica-dry --gamma 200±50mJ/m2 --x radius=10nm:100um --y speed=1mm/s:1km/s"


def test_the_edge_of_a_band_is_smooth_at_a_kink_of_the_best_range() -> None:
    """At the largest sticking speed, the upper end of the best range of the restitution rises steeply from 0.

    On the page, this speed is a straight line over the radius.
    """
    _, page = user_map(*IMPACT.split())
    (axes,) = page.axes
    lowest = min(lines_of(page, "band"), key=lambda line: line[:, 1].max())
    x, y = axes.transData.transform(lowest).T
    straight = np.polyval(np.polyfit(x, y, 1), x)
    assert abs(y - straight).max() < 1.5 * page.dpi / 72


def test_a_legend_explains_its_bands_and_has_a_scale_if_contours_are_too_close_for_labels() -> None:
    _, page = user_map(*IMPACT.split())
    assert (
        "thick contours: JKR; bands: where they may lie (best ranges by the rules “1–10 × JKR”, “measured” and "
        "“adhesion only”)" in legend_of(page)
    )
    assert "in the order of these colours: 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9" in legend_of(page)
    _, page = paper_map_on_page("8")
    assert "these colours" not in legend_of(page)


def legend_of(page: Figure) -> str:
    """Return the texts of the first legend of a page, without its line breaks."""
    legend: Any = page.axes[0].get_legend()
    return "; ".join(text.get_text() for text in legend.get_texts()).replace("\n", " ")


def test_the_name_of_a_limit_is_clear_of_the_lines_of_other_limits() -> None:
    drawn, page = user_map(*IMPACT.split())
    _, field = field_of(drawn)
    (axes,) = page.axes
    bounds = {typeset(region.name): region for region in field.regions if not region.hatch}
    boxes = {text.get_text(): text.get_window_extent() for text in axes.texts if text.get_text() in bounds}
    assert len(boxes) >= 3
    for name, box in boxes.items():
        x, y = axes.transData.inverted().transform(box.corners()).T
        for other, region in bounds.items():
            is_beyond = region.excess(field.frame.replace(radius=x, speed=y)) > 0
            assert is_beyond.all() or (other != name and not is_beyond.any())


def test_the_teeth_of_a_line_point_to_where_its_limit_is_exceeded() -> None:
    """Matplotlib draws the teeth on the left of a line, so the limit has to be exceeded there."""
    drawn, page = user_map(*IMPACT.split())
    _, field = field_of(drawn)
    (axes,) = page.axes
    bounds: list[Any] = [one for one in axes.collections if one.get_path_effects()]
    regions = [region for region in field.regions if not region.hatch]
    assert len(bounds) == len(regions) >= 4
    assert "the teeth of a line point to where its limit is exceeded" in legend_of(page)
    for bound, region in zip(bounds, regions, strict=True):
        for path in bound.get_paths():
            ends = axes.transData.transform(path.vertices)
            middle, along = (ends[0] + ends[1]) / 2, ends[1] - ends[0]
            left = middle + 2 * np.array([-along[1], along[0]]) / np.hypot(*along)
            radius, speed = axes.transData.inverted().transform(left)
            assert region.excess(field.frame.replace(radius=radius, speed=speed)) > 0


@pytest.mark.parametrize(
    ("words", "clause"),
    [
        ("P_c pdms --x radius=100nm:1mm --y gamma=1mJ/m2:1J/m2", ""),
        ("v_stick silica-dry --x radius=10nm:100um --y gamma=1mJ/m2:1J/m2", "by the rules “1–10 × JKR” and “measured”"),
    ],
)
def test_a_legend_explains_bands_only_if_they_can_be_seen(words: str, clause: str) -> None:
    """Bands that cover less than a hundredth of a map are not drawn."""
    figure = on_axes(words)
    assert bool(lines_of(figure, "band")) is bool(clause)
    assert ("best range" in legend_of(figure)) is bool(clause)
    assert clause in legend_of(figure)


def test_a_curve_has_no_band_that_is_too_narrow_to_be_seen() -> None:
    drawn, _ = picture_of(map_request(call_of("map P_c pdms --x radius=100um:1mm:20".split())))
    ((curve,),) = (panel.curves for panel in drawn.panels)
    assert (curve.band, curve.key) == (None, "")


def test_the_key_of_a_curve_by_a_stated_law_does_not_name_the_law_twice() -> None:
    line = "map a0 quartz --x radius=10nm:10um --model maugis"
    drawn, _ = picture_of(map_request(call_of(line.split())))
    ((curve,),) = (panel.curves for panel in drawn.panels)
    assert curve.key == "line; band: best range by the rule “⟦z0⟧ assumed”"


def test_symbols_in_the_words_of_a_limit_are_marked() -> None:
    _, field = field_of(paper_map("8", known_materials()))
    assert "⟦ξ/ξ_max > 1⟧: ⟦ξ⟧ is too large for the formula" in [region.text for region in field.regions]


def test_the_line_of_the_limit_on_roughness_is_named_by_its_consequence_not_by_its_code() -> None:
    _, _, field = map_drawn("P_c quartz --x radius=10nm:10um --y gamma=1mJ/m2:1J/m2".split())
    names = [region.name for region in field.regions]
    assert "real surfaces hold less" in names
    assert "rough matters" not in names


def test_a_figure_of_the_paper_has_no_best_ranges() -> None:
    _, page = paper_map_on_page("8")
    assert not lines_of(page, "band")


def test_the_sketch_of_the_manual_is_current_and_has_all_symbols(run: Run, tmp_path: Path) -> None:
    assert run("figure geometry --no-caption -o out.svg").code == 0
    files = tmp_path / "out.svg", PAGE.parent / "geometry.svg"
    new, kept = (file.read_text(encoding="utf-8") for file in files)
    assert texts_of(new) == texts_of(kept)
    assert {"R1", "R2", "a", "δ", "ξ", "P", "Q", "M"} <= {*texts_of(new)}
    np.testing.assert_allclose(drawing_of(new), drawing_of(kept), atol=0.1)


def test_data_of_a_sketch_are_refused(run: Run) -> None:
    assert run("figure geometry --data -").code == 2


def test_with_the_option_cite_a_caption_ends_with_its_sources(run: Run) -> None:
    out = run("map contact-radius quartz --x radius=10nm:1um --cite").out.splitlines()[-1]
    assert "Dominik & Tielens 1995" in out
    assert "Kendall et al. 1987" in out
    assert f"By jkroll {__version__}" in out
    assert "Tielens" not in run("map contact-radius quartz --x radius=10nm:1um").out


def test_the_option_no_caption_leaves_the_caption_out(run: Run, tmp_path: Path) -> None:
    run("contact quartz 100nm --curve --panel force --no-caption -o force.svg --quiet")
    shown = " ".join(texts_of((tmp_path / "force.svg").read_text(encoding="utf-8")))
    assert "Eqs" not in shown
    assert "Fixed" not in shown


@pytest.mark.parametrize(
    ("options", "inputs"),
    [
        pytest.param("", "R1 = 100 nm, γ1 = 25 mJ/m², E1 = 54 GPa, ν1 = 0.17, ξ = 100 pm.", marks=pytest.mark.slow),
        ("--panel force", "R1 = 100 nm, γ1 = 25 mJ/m², E1 = 54 GPa, ν1 = 0.17."),
        pytest.param(
            "--panel moment", "R1 = 100 nm, γ1 = 25 mJ/m², E1 = 54 GPa, ν1 = 0.17, ξ = 100 pm.", marks=pytest.mark.slow
        ),
        pytest.param(
            "--panel force --model dmt", "R1 = 100 nm, γ1 = 25 mJ/m², E1 = 54 GPa, ν1 = 0.17.", marks=pytest.mark.slow
        ),
        pytest.param("--panel moment --model dmt", "R1 = 100 nm, γ1 = 25 mJ/m², ξ = 100 pm.", marks=pytest.mark.slow),
        pytest.param("--panel moment --model jkr,dmt", "R1 = 100 nm, γ1 = 25 mJ/m².", marks=pytest.mark.slow),
        pytest.param(
            "--model maugis",
            "R1 = 100 nm, γ1 = 25 mJ/m², E1 = 54 GPa, ν1 = 0.17, ξ = 100 pm, z0 = 400 pm.",
            marks=pytest.mark.slow,
        ),
        pytest.param(
            "--model jkr,maugis",
            "R1 = 100 nm, γ1 = 25 mJ/m², E1 = 54 GPa, ν1 = 0.17, z0 = 400 pm.",
            marks=pytest.mark.slow,
        ),
    ],
)
def test_a_caption_has_the_inputs_of_the_drawn_panels_and_laws(
    run: Run, tmp_path: Path, options: str, inputs: str
) -> None:
    ran = run(f"contact quartz 100nm --xi 1angstrom --curve -o contact.svg {options}")
    assert ran.out.splitlines()[-1] == f"Fixed: quartz, {inputs}"
    assert ("assumed: z0" in ran.err) is ("z0" in inputs)
    assert "(--xi)" not in ran.err
    shown = texts_of((tmp_path / "contact.svg").read_text(encoding="utf-8"))
    moments = ("M: ", "Mhalf: ", "Mδ: ")  # their subscripts are separate texts of another size
    if options in ("", "--panel force"):
        assert {"fold", "pull-off", "jump-in", "stable", "unstable", "fixed grips"} <= {*shown}
        assert all(any(moment in text for text in shown) for moment in moments) is (not options)


@pytest.mark.slow
def test_each_limit_has_its_own_strokes_of_hatching() -> None:
    """A limit shares no stroke of its hatch with another limit, so no two hatches together look like a third."""
    hatch_of: dict[str, set[str]] = {}
    for name in ("3b", "8"):
        _, page = paper_map_on_page(name)
        legend: Any = page.axes[0].get_legend()
        keys = {str(patch.get_label()): patch.get_hatch() for patch in legend.get_patches() if patch.get_hatch()}
        drawn = {one.get_hatch() for one in page.axes[0].collections if one.get_hatch()}
        assert drawn == {*keys.values()}
        assert len(keys) >= 3
        for text, hatch in keys.items():
            hatch_of.setdefault(" ".join(text.split()), set()).add(hatch)
    assert {len(hatches) for hatches in hatch_of.values()} == {1}
    of_law = [hatch_of.pop(f"JKR is off by more than {least}") for least in ("5 %", "a factor of 2")]
    assert of_law == [{"||"}, {"||||||"}]  # the hatch is denser, by whole multiples, where the law is worse
    hatch_of["JKR"] = of_law[0]
    every: list[str] = []
    for (hatch,) in hatch_of.values():
        every += {*hatch.replace("x", "/\\").replace("+", "-|")}  # these signs are two strokes each
    assert len(every) == len({*every})


@pytest.mark.parametrize("style", [PAPER, DARK])
def test_the_colours_of_a_map_differ_in_grey_and_text_on_them_is_legible(style: Style) -> None:
    greys = [0.299 * red + 0.587 * green + 0.114 * blue for red, green, blue in map(to_rgb, style.scale)]
    steps = np.diff(greys)
    assert (steps < -0.01).all() or (steps > 0.01).all()
    ink = int(style.ink[1:3], 16) / 255
    assert min(abs(ink - grey) for grey in greys) > 0.45


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("⟦P_c = 3πγR⟧ with ⟦R = R1/2⟧", r"$P_{\mathrm{c}}=3\mathrm{π}γR$ with $R=R_{1}/2$"),
        ("⟦E1/(1 − ν1²)⟧ = 10 GPa", "$E_{1}/(1-ν_{1}^{2})$ = 10 GPa"),
        ("⟦E*/γ⟧ above 3·10¹² m⁻¹", r"$E{}^{*}/γ$ above 3·10$^{12}$ m$^{-1}$"),
        ("contact radius at the load, ⟦a⟧", "contact radius at the load, $a$"),
        ("a moment of 1.9 aN m, Eq (25)", "a moment of 1.9 aN m, Eq (25)"),
        ("⟦δ_α⟧ in mJ/m² or kg/m³", "$δ_{α}$ in mJ/m$^{2}$ or kg/m$^{3}$"),
        ("half-circle ⟦a + ξ⟧", "half-circle $a+ξ$"),
        ("-10 at ⟦M_0⟧", r"−10 at $M_{0}$"),
        ("⟦log₁₀⟧ (⟦P_c⟧ / N)", r"$\mathrm{log}_{10}$ ($P_{\mathrm{c}}$ / N)"),
        ("⟦â^(3/2)⟧ of ⟦⟨M⟩⟧", r"$\hat{a}^{3/2}$ of ${\langle}M{\rangle}$"),
        ("my_dust costs $1", r"my_dust costs \$1"),
        ("(5.8 ± 2.0)e-9 J/m on SiO2", "(5.8 ± 2.0)·$10^{-9}$ J/m on SiO$_{2}$"),
    ],
)
def test_marked_mathematics_is_typeset(text: str, wanted: str) -> None:
    assert typeset(text) == wanted
    assert "⟦" not in plain(text)


@pytest.mark.slow
def test_every_symbol_is_typeset_whole_and_can_be_drawn() -> None:
    parser = MathTextParser("path")
    for name, quantity in NOMENCLATURE.items():
        if not quantity.is_word:
            parser.parse(typeset(described(name, quantity.unit)))
            letters = re.sub(r"\\[a-z]+|[^\w]|_", "", typeset(symbol(name)))
            assert letters == re.sub(r"[^\w]|_", "", quantity.symbol.replace("â", "a").translate(POWERS)), name
            before, _, remark = quantity.sentence.partition("; ")
            sentence = f"{before} ({remark})" if remark else before
            assert plain(described(name)) == f"{sentence}, {quantity.symbol}"


def test_malformed_mathematics_in_the_text_of_a_user_is_typeset() -> None:
    for text in ("⟦\\frac{⟧", "a$b$c", "⟦^⟧ ⟦", "{⟦_⟧}"):
        MathTextParser("path").parse(typeset(text))


@pytest.mark.parametrize(
    ("text", "kept"),
    [
        ("rolling moment, ⟦M⟧ [fN m]", "$M$ [fN m]"),
        ("numerical solutions, within 0.3 % for 0.01", "0.3 %"),
        ("it is 5 nN m here", "5 nN m"),
    ],
)
def test_a_unit_stays_on_the_line_of_its_number(text: str, kept: str) -> None:
    for width in range(8, len(text)):
        assert any(kept in line.replace("\N{NO-BREAK SPACE}", " ") for line in lines(text, width)), width
        if "⟦" not in text:
            assert any(kept in line for line in wrapped(text, width)), width


def test_the_title_has_the_unit_if_the_labels_have_none() -> None:
    """A mass takes no prefix, so the numbers on the contours have no unit."""
    drawn, _, field = map_drawn("mass --x radius=10cm:1m --y density=1g/cm3:10g/cm3".split())
    assert {*field.in_words(levels_of(field))[0]} >= {"10", "1000"}
    assert drawn.title.endswith("⟦m1⟧ [kg]")


@pytest.mark.parametrize("model", ["jkr", pytest.param("maugis", marks=pytest.mark.slow)])
def test_the_edge_of_a_gap_lies_where_the_contact_breaks(model: str) -> None:
    """The drawn border of the part without a value is P = -P_c, not a staircase along the points of a mesh."""
    words = f"contact-radius-at-load quartz --x radius=10nm:1um --y load=-20nN:50nN:lin --model {model}"
    _, panel, field = map_drawn(words.split())
    (edge,) = lines_of(on_axes(words), "edge")
    radius, load = edge.T
    assert 20 < len(radius) < 200
    pull_off = solve("pull_off_force", material="quartz", radius=radius, model=model)
    assert abs(load + pull_off).max() < 1e-6 * (panel.y.high - panel.y.low)
    assert field.gaps == ("beyond pull-off",)


def test_a_limit_exceeded_in_part_of_a_map_has_its_name_at_its_line() -> None:
    drawn, page = user_map(*"n-roll quartz --x radius=10nm:1um --y speed=1cm/s:1m/s".split())
    _, field = field_of(drawn)
    (axes,) = page.axes
    (region,) = (region for region in field.regions if region.name == "⟦M/2cRw > 1⟧")
    (label,) = (text for text in axes.texts if text.get_text() == typeset(region.name))
    box = label.get_window_extent()
    x, y = axes.transData.inverted().transform(box.corners()).T
    assert (region.excess(field.frame.replace(radius=x, speed=y)) > 0).all()
    beyond = axes.transData.inverted().transform(box.translated(box.width / 2, 0).corners()).T
    assert (region.excess(field.frame.replace(radius=beyond[0], speed=beyond[1])) < 0).any()
    legend: Any = axes.get_legend()
    assert any("hysteresis cannot" in text.get_text().replace("\n", " ") for text in legend.get_texts())
    assert not any("hysteresis" in doubt for doubt in drawn.doubts)


@pytest.mark.slow
def test_a_map_with_a_part_without_values_is_drawn(run: Run, tmp_path: Path) -> None:
    """Beyond the fold, neither the quantity nor the distances from its limits have a value."""
    run("map load_at_factor quartz --x radius=10nm:1um --y approach_at_load=-0.3nm:1nm:lin -o load.svg --quiet")
    shown = texts_of((tmp_path / "load.svg").read_text(encoding="utf-8"))
    assert any(text.startswith("no value") for text in shown)


def test_the_legend_of_many_curves_overlaps_neither_caption_nor_frame() -> None:
    drawn, _ = picture_of(map_request(call_of("map pull-off 1nm:1um:24 --x gamma=1mJ/m2:1J/m2:5".split())))
    with settings(PAPER):
        page = figure_of(drawn, 85 / 25.4, PAPER, has_caption=True)
    legend: Any = page.axes[0].get_legend()
    assert len(legend.get_texts()) == 24
    assert not page.texts[-1].get_window_extent().overlaps(legend.get_window_extent())
    assert not legend.get_window_extent().overlaps(page.axes[0].get_window_extent())


@pytest.mark.parametrize("name", PAPER_FIGURES)
@pytest.mark.parametrize("width", [85, pytest.param(180, marks=pytest.mark.slow)])
def test_each_contour_has_its_label_on_its_line_and_on_no_other(name: str, width: int) -> None:
    """A label is horizontal and within the frame, on a patch that hides everything beneath it."""
    drawn, page = paper_map_on_page(name, width)
    (axes,) = page.axes
    _, field = field_of(drawn)
    shown = field.in_words(levels_of(field))[0]
    labels = [text for text in axes.texts if text.get_text() in {*map(typeset, shown)}]
    boxes = [text.get_window_extent() for text in labels]
    assert {text.get_rotation() for text in labels} == {0.0}
    frame = axes.get_window_extent().padded(-3 * page.dpi / 72)  # without the margin that the ticks take
    assert all(frame.count_contains(box.corners()) == 4 for box in boxes)
    assert not any(one.overlaps(other) for one, other in itertools.combinations(boxes, 2))
    paths = [
        [MplPath(axes.transData.transform(line)) for line in lines_of(page, f"contour-{position}")]
        for position in range(len(shown))
    ]
    assert len(labels) >= len(shown) - 2  # contours may run into the ticks of the lower and the upper edge
    for text, box in zip(labels, boxes, strict=True):
        crossing = [
            label for label, own in zip(shown, paths, strict=True) if any(path.intersects_bbox(box) for path in own)
        ]
        assert [*map(typeset, crossing)] == [text.get_text()]


@pytest.mark.parametrize(
    "name",
    ["8", *(pytest.param(name, marks=pytest.mark.slow) for name in ("contact", *PAPER_MAPS, *PROFILES) if name != "8")],
)
def test_a_caption_has_at_most_three_lines_in_a_column(name: str) -> None:
    if name in PAPER_MAPS:
        _, page = paper_map_on_page(name)
    else:
        drawn = PROFILES[name](known_materials()) if name in PROFILES else contact_of_quartz()
        with settings(PAPER):
            page = figure_of(drawn, 85 / 25.4, PAPER, has_caption=True)
    caption = page.texts[-1]
    assert 1 <= len(caption.get_text().splitlines()) <= 3


@pytest.mark.slow
def test_a_mark_on_the_edge_is_a_whole_dot() -> None:
    drawn, *_ = map_drawn("pull-off --x radius=100nm:1um --y gamma=1mJ/m2:1J/m2 --mark quartz@100nm".split())
    with settings(PAPER):
        (axes,) = figure_of(drawn, 4.0, PAPER, has_caption=False).axes
    dots = [line for line in axes.lines if line.get_marker() == "o"]
    assert [np.ravel(line.get_xdata()).tolist() for line in dots] == [[1e-7]]
    assert not dots[0].get_clip_on()


@pytest.mark.parametrize("name", ["8", pytest.param("3a", marks=pytest.mark.slow)])
def test_letters_and_their_subscripts_have_a_size_of_at_least_six_points(name: str) -> None:
    _, page = paper_map_on_page(name)
    parser, sizes = MathTextParser("path"), list[float]()
    for text in page.findobj(Text):
        if isinstance(text, Text) and "$" in text.get_text():
            for line in text.get_text().splitlines():
                sizes += [size for _, size, *_ in parser.parse(line, 72, text.get_fontproperties()).glyphs]
    assert len({*sizes}) > 1
    assert min(sizes) >= 6


@pytest.mark.parametrize("name", ["8", pytest.param("6b", marks=pytest.mark.slow)])
def test_no_letter_lies_outside_a_narrow_page(name: str) -> None:
    """Everything lies within the page at the width of a journal's column."""
    _, page = paper_map_on_page(name)
    page.draw_without_rendering()
    box = page.get_tightbbox()
    assert box.x0 > -0.01
    assert box.x1 < 85 / 25.4 + 0.01
    assert box.y0 > -0.01
    assert box.y1 < page.get_figheight() + 0.01


def test_the_largest_number_of_curves_differ_in_colour_or_line_style() -> None:
    looks = [line_of(Curve("", (0, 1), (0, 1), number), number, PAPER) for number in range(MAX_CURVES)]
    assert len({(look["color"], look["linestyle"]) for look in looks}) == MAX_CURVES


@pytest.mark.slow
@pytest.mark.parametrize("width", [85, 180])
def test_a_page_of_curves_has_short_legends_and_well_broken_axis_titles(width: int) -> None:
    """No legend is half as high as its panel, no line of an axis title ends with a comma, and texts avoid the frame."""
    picture = contact_of_quartz()
    with settings(PAPER):
        page = figure_of(picture, width / 25.4, PAPER, has_caption=True)
    assert len(page.axes) == 3
    axes: Any
    for axes in page.axes:
        frame = axes.get_window_extent()
        assert axes.get_legend().get_window_extent().height < 0.5 * frame.height
        assert not re.search(r",\s*$", f"{axes.get_xlabel()}\n{axes.get_ylabel()}", re.MULTILINE)
        assert all(
            frame.count_contains(text.get_window_extent().corners()) == 4 for text in axes.texts if text.get_text()
        )


def test_a_colour_has_one_meaning_in_all_panels_of_a_contact() -> None:
    """The contact without load is on the stable branch; at pull-off it is on the branch of fixed grips."""
    picture = contact_of_quartz()
    force, pressure, moment = ({curve.text: curve.colour for curve in panel.curves} for panel in picture.panels)
    assert pressure == {"⟦P = 0⟧": force["stable"], "pull-off": force["fixed grips"]}
    assert not {*moment.values()} & {*force.values()}


def test_a_law_has_one_colour_in_all_panels_of_a_contact() -> None:
    """Only JKR has the pressure, so the panel of the pressure cannot compare laws."""
    scenes = [Frame({"radius": 1e-7}, known_materials()["quartz"], model=model) for model in ("maugis", "jkr")]
    picture, notes = curves_of_contact(scenes, None, None)
    force, moment = ({curve.text: curve.colour for curve in panel.curves} for panel in picture.panels)
    assert force == moment == {"Maugis–Dugdale": 0, "JKR": 1}
    assert sum("not in Maugis–Dugdale" in note for note in notes) == 1


@pytest.mark.slow
def test_the_curves_of_several_laws_share_the_panels(run: Run, tmp_path: Path) -> None:
    ran = run("contact quartz 100nm --curve --model jkr,maugis,dmt -o laws.svg")
    assert ran.code == 0
    assert ran.err.count("not in DMT") == 1
    shown = texts_of((tmp_path / "laws.svg").read_text(encoding="utf-8"))
    assert all(shown.count(law) == 2 for law in ("JKR", "Maugis–Dugdale", "DMT"))
    on_screen = run("contact quartz 100nm --curve --model jkr,dmt --panel force --load=-20nN:10nN --quiet")
    assert re.split(r"  +", on_screen.out.splitlines()[2].strip()) == ["δ [pm]", "P [nN]"]
    assert {"JKR", "DMT"} <= {line.split()[0] for line in on_screen.out.splitlines()}


@pytest.mark.parametrize(
    ("model", "branches", "states"),
    [
        (None, ["unstable", "fixed grips", "stable"], ["fold", "pull-off", "jump-in", "⟦P = 0⟧"]),
        ("maugis", ["without contact", "fixed grips", "stable"], ["fold", "pull-off", "⟦P = 0⟧"]),
        ("dmt", ["stable"], ["pull-off", "⟦P = 0⟧"]),
    ],
)
def test_the_force_curve_of_one_law_has_its_branches_and_states(
    model: str | None, branches: list[str], states: list[str]
) -> None:
    scene = Frame({"radius": 1e-7}, known_materials()["quartz"], model=model)
    (panel,) = curves_of_contact([scene], None, "force")[0].panels
    curves = panel.curves[::-1]
    assert ([curve.text for curve in curves], [point.text for point in panel.marks]) == (branches, states)
    for before, after in itertools.pairwise(curves):
        assert (before.x[-1], before.y[-1]) == (after.x[0], after.y[0])
    ends = {(x, y) for curve in curves for x, y in zip(curve.x.tolist(), curve.y.tolist(), strict=True)}
    assert {(point.x, point.y) for point in panel.marks} <= ends
    pull_off = panel.marks[states.index("pull-off")]
    assert pull_off.y == min(y for _, y in ends) == approx(-scene["pull_off_force"])


@pytest.mark.parametrize("loads", ["-5nN:10nN", "-5nN:-4.99nN", "1nN:1.001nN"])
def test_curves_of_several_laws_end_at_the_given_loads_and_have_no_chords(loads: str) -> None:
    """Between the unstable and the stable branch the force is beyond the loads, and no curve is drawn there."""
    low, high = loads_of(loads)
    scenes = [Frame({"radius": 1e-7}, known_materials()["quartz"], model=model) for model in ("jkr", "maugis")]
    drawn, _ = curves_of_contact(scenes, Loads(low, high), "force")
    (panel,) = drawn.panels
    laws = {law: [curve for curve in panel.curves if curve.text == law] for law in ("JKR", "Maugis–Dugdale")}
    for curves in laws.values():
        assert {curve.colour for curve in curves} == {curves[0].colour}
        assert (min(curve.y.min() for curve in curves), max(curve.y.max() for curve in curves)) == approx((low, high))
        assert (len(curves) > 1) == (low < 0)
        for curve in curves:
            steps = abs(np.diff(curve.x)) / (panel.x.high - panel.x.low)
            assert max(steps, default=0.0) < 0.1


def test_loads_beyond_pull_off_by_every_law_are_refused(run: Run) -> None:
    ran = run("contact quartz 100nm --curve --model jkr,dmt --panel force --load=-30nN:-20nN")
    assert (ran.code, ran.out) == (1, "")
    assert ran.err == "jkroll: --load: -20 nN breaks this contact: the hardest pull that it holds is -15.70796 nN\n"


def test_a_branch_beyond_the_loads_is_not_in_the_key(run: Run) -> None:
    out = run("contact quartz 100nm --curve --panel force --load=-5nN:10nN --quiet").out
    assert {"stable", "unstable"} <= {line.split()[0] for line in out.splitlines()}
    assert "fixed grips" not in out


@pytest.mark.slow
def test_the_curves_of_the_figure_laws_end_at_dmt_and_jkr(run: Run, tmp_path: Path) -> None:
    ran = run("figure laws --mark quartz@100nm,ice-warm@1um -o laws.svg --data -")
    rows = list(csv.DictReader(ran.out.splitlines()))
    ratios: dict[str, list[float]] = {}
    for row in rows:
        ratios.setdefault(row["curve"], []).append(float(row["pull_off_force_ratio"]))
    assert {*ratios["JKR"]} == {1.5}
    assert {*ratios["DMT"]} == {2.0}
    assert ratios["Maugis–Dugdale"][0] == approx(2, rel=2e-3)
    assert ratios["Maugis–Dugdale"][-1] == approx(1.5, rel=1e-3)
    assert max(float(row["tabor_parameter"]) for row in rows if row["curve"] == "Lennard-Jones") == 2.0
    shown = texts_of((tmp_path / "laws.svg").read_text(encoding="utf-8"))
    assert {"quartz, 100 nm", "ice-warm, 1 µm"} <= {*shown}
    assert "is outside the axes" in run("figure laws --mark quartz").err


@pytest.mark.parametrize("model", ["jkr", "maugis", "dmt"])
@pytest.mark.parametrize(("first", "last"), [("1nN", "2nN"), ("0nN", "5nN"), ("-1nN", "1nN"), ("-1uN", "1uN")])
def test_rows_of_a_curve_cover_the_given_loads(run: Run, model: str, first: str, last: str) -> None:
    """The stable branch has 41 to 44 rows in any range of loads, from the first load (or pull-off) to the last."""
    ran = run(f"contact quartz 100nm --curve --model {model} --load={first}:{last} --csv")
    rows = [*csv.DictReader(ran.out.splitlines())]
    ends = [max(parse_quantity(first, "load"), -solve("pull_off_force", material="quartz", radius=1e-7, model=model))]
    ends.append(parse_quantity(last, "load"))
    held = [row for row in rows if row["state"] not in ("unstable", "fixed grips", "without contact", "fold")]
    loads = [float(row["load [N]"]) for row in held]
    np.testing.assert_allclose([loads[0], loads[-1]], ends, rtol=1e-9, atol=1e-22)
    assert 41 <= len(loads) <= 44
    assert loads == sorted(loads)
    approaches = [float(row["approach_at_load [m]"]) for row in held]
    assert approaches == sorted(approaches)


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("contact quartz 100nm -o contact.svg", "add --curve"),
        ("contact quartz 100nm --curve -o contact.jpg", "a table is not written as jpg; name the file 'contact.csv'"),
        ("pull-off quartz 100nm -o contact.svg", "'contact.svg' is a picture"),
        ("contact quartz 100nm --curve -o contact.xlsx", "a table is not written as xlsx; name the file 'contact.csv'"),
        ("contact quartz 100nm --curve --csv -o contact.svg", "-o and --csv exclude each other"),
        ("contact quartz 100nm --curve -o contact.svg --to nN", "-o and --to exclude each other"),
        ("contact quartz 100nm --curve --panel force --digits 2", "--panel and --digits exclude each other"),
        (
            "contact quartz 100nm --curve --panel force --quantities pull_off_force",
            "--panel and --quantities exclude each other",
        ),
        ("contact quartz,iron 100nm --curve -o contact.svg", "shows one contact; 2"),
        ("contact quartz 100nm --curve --approach 1nm -o contact.svg", "leave --approach out"),
        ("contact quartz 100nm --curve --load 1nN -o contact.svg", "give --load as FROM:TO"),
        ("contact quartz 100nm --curve --load 1nN:-1nN -o contact.svg", "does not rise; write FROM:TO"),
        ("contact quartz 100nm --curve --model dmt --panel pressure -o contact.svg", "not in DMT"),
        ("figure 3a -o svg", "-o: 'svg' does not end in .svg, .pdf or .png"),
        pytest.param(
            "figure 3a -o nowhere/figure.svg", "cannot write 'nowhere/figure.svg': No such", marks=pytest.mark.slow
        ),
        ("figure 3a --data nowhere/figure.csv", "cannot write 'nowhere/figure.csv': No such"),
        ("n-grav quartz 1um -o nowhere/sweep.csv", "cannot write 'nowhere/sweep.csv"),
        ("figure 2 --mark quartz@1nm", "takes no --mark"),
        ("figure laws --as-printed", "takes no --as-printed"),
        ("figure 3a --as-printed", "figure 3a takes no --as-printed"),
        ("contact quartz 100nm --curve --panel tides -o contact.svg", "choose one of force, pressure and moment"),
    ],
)
def test_invalid_calls_for_pictures_are_refused_in_one_line(run: Run, tmp_path: Path, line: str, message: str) -> None:
    ran = run(line)
    assert ran.code == (1 if "cannot write" in message else 2)
    assert message in ran.err
    assert len(ran.err.splitlines()) == 1
    assert not {path.name for path in tmp_path.iterdir()} & {*line.split()}


def test_a_letter_that_the_font_lacks_is_reported(run: Run) -> None:
    Path("own.toml").write_text('[materials."石英"]\nsurface_energy = "25 mJ/m2"\n', encoding="utf-8")
    message = "jkroll: -o: the font of pictures has no '石'; name the material with other letters\n"
    assert run("map pull-off 石英 --materials own.toml --x radius=1nm:1um -o own.svg") == (2, "", message)


def test_a_failure_to_draw_keeps_the_old_file(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "figure.svg"
    file.write_text("old", encoding="utf-8")
    monkeypatch.setattr("jkroll.pictures.page.draw", lambda *_, **__: 1 / 0)
    assert run("figure 3a -o figure.svg").code == 1
    assert file.read_text(encoding="utf-8") == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["figure.svg"]


def test_without_matplotlib_a_picture_file_is_refused_in_one_line(tmp_path: Path) -> None:
    """Without matplotlib, the terminal still shows the picture."""
    code = (
        "import sys; sys.modules['matplotlib'] = None; from jkroll.cli.process import main; "
        "sys.exit(main(['figure', '3a', *sys.argv[1:]]))"
    )
    shown = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, cwd=tmp_path)
    assert shown.returncode == 0
    assert "Fig. 3a: P_c" in shown.stdout
    refused = subprocess.run(
        [sys.executable, "-c", code, "-o", "figure.svg"], capture_output=True, text=True, check=False, cwd=tmp_path
    )
    assert refused.returncode == 2
    assert refused.stderr == "jkroll: this needs matplotlib: pip install 'jkroll[plot]'\n"
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_a_million_points_take_less_time_than_importing_matplotlib() -> None:
    """The CPU times are those of separate processes, run in turn."""
    words = ["contact-radius-at-load", "quartz", "--x", "radius=10nm:1mm:1000", "--y", "load=0nN:1uN:1000:lin"]
    ways = {
        "map": f"from jkroll.cli.process import main; main({['map', *words]!r})",
        "import": "import matplotlib.figure",
    }
    costs: dict[str, list[float]] = {way: [] for way in ways}
    for _ in range(5):
        for way, code in ways.items():
            whole = f"{code}\nimport resource, sys\nprint(sum(resource.getrusage(0)[:2]), file=sys.stderr)"
            ran = subprocess.run([sys.executable, "-c", whole], capture_output=True, text=True, check=True)
            costs[way].append(float(ran.stderr.splitlines()[-1]))
    least = {way: min(times) for way, times in costs.items()}
    assert least["map"] < least["import"]


# --- The pictures of the README and the manual ------------------------------------------------------------------------
# `PYTHONPATH=tests python tests/pictures/test_drawing.py` writes them anew.

README = Path(__file__).parents[2] / "README.md"
KEPT = Path(__file__).parents[1] / "data"
PAGE = Path(__file__).parents[2] / "src/jkroll/guide/pictures.md"  # it contains the command of the README's picture
SHOWN = re.findall(r"^jkroll (.*) -o (contact\.svg)(.*)$", PAGE.read_text(encoding="utf-8"), re.MULTILINE)
_NUMBER = re.compile(r"-?\d+\.?\d*")


def written(words: str, rest: str, file: Path) -> str:
    """Draw the picture of a command of the manual; return its SVG."""
    assert main([*words.split(), "-o", str(file), *rest.split()]) == 0
    return file.read_text(encoding="utf-8")


def drawing_of(svg: str) -> list[float]:
    """Return all coordinates of the paths of an SVG."""
    return [float(number) for path in re.findall(r' d="([^"]*)"', svg) for number in _NUMBER.findall(path)]


@pytest.mark.parametrize(("words", "file", "rest"), SHOWN, ids=[file for _, file, _ in SHOWN])
@pytest.mark.slow
def test_the_pictures_of_the_readme_are_current(words: str, file: str, rest: str, tmp_path: Path) -> None:
    """With every version of matplotlib, texts are the same, and lines agree within a tenth of a point."""
    assert f"](tests/data/{file})" in README.read_text(encoding="utf-8")
    kept, new = (KEPT / file).read_text(encoding="utf-8"), written(words, rest, tmp_path / file)
    assert texts_of(kept) == texts_of(new)
    np.testing.assert_allclose(drawing_of(kept), drawing_of(new), atol=0.1)
    assert len(kept) < 160_000


def test_the_manual_has_a_command_for_every_kept_picture() -> None:
    assert [file for _, file, _ in SHOWN] == [path.name for path in KEPT.glob("*.svg")]


@pytest.mark.slow
def test_labels_of_marks_overlap_neither_each_other_nor_labels_of_contours_nor_the_frame() -> None:
    """A line leads from a label to its dot if another dot is nearer."""
    marks = "quartz@100nm,silica-dry@100nm,iron@1um,gold@10nm,graphite@10um,ice-warm@1um,polystyrene@1um"
    names = re.findall(r"[^,]+, \d+ .m", re.sub(r"@(\d+)(.)m", r", \1 \2m", marks).replace("um", "µm"))
    drawn, panel, _ = map_drawn(f"pull-off --x radius=1nm:1mm --y gamma=1mJ/m2:10J/m2 --mark {marks}".split())
    with settings(PAPER):
        page = figure_of(drawn, 100 / 25.4, PAPER, has_caption=False)
    axes: Any = page.axes[0]
    texts: dict[str, Any] = {text.get_text(): text for text in axes.texts if text.get_text() in names}
    assert {*texts} == {*names}
    boxes = [text.get_window_extent() for text in texts.values()]
    contours = [text.get_window_extent() for text in axes.texts if text.get_text().endswith("N")]
    assert contours
    assert not any(box.padded(2 * page.dpi / 72).overlaps(other) for box in boxes for other in contours)
    assert not any(one.overlaps(other) for one, other in itertools.combinations([*boxes, *contours], 2))
    frame = axes.get_window_extent().padded(1)
    assert all(frame.count_contains(box.corners()) == 4 for box in boxes)
    positions = {mark.text: (mark.x, mark.y) for mark in panel.marks}
    starts = [axes.transData.transform(line.get_xydata()[0]) for line in axes.lines if len(line.get_xydata()) == 2]
    dots = {text: axes.transData.transform(positions[text]) for text in texts}
    for text, box in zip(texts, boxes, strict=True):
        distances = {other: math.hypot(*(np.clip(dot, box.min, box.max) - dot)) for other, dot in dots.items()}
        assert distances[text] == min(distances.values()) or any(np.allclose(start, dots[text]) for start in starts)
    assert len(starts) >= 2


if __name__ == "__main__":
    written("figure geometry", "--no-caption", PAGE.parent / "geometry.svg")
    for words, file, rest in SHOWN:
        written(words, rest, KEPT / file)
