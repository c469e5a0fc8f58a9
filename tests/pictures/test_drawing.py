"""Pictures in files: contours lie where the formula says, bytes do not change, and nothing else is needed but the extra."""

import re
import subprocess
import sys
from html import unescape
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from harness import Run
from jkroll import known_materials, solve
from jkroll.cli.draw import OF_PAPER
from jkroll.cli.map_request import asked
from jkroll.cli.process import main
from jkroll.pictures.figures import FIGURES, figure
from jkroll.pictures.maps import Map, inputs_at
from jkroll.pictures.plot_request import map_of

pytest.importorskip("matplotlib")
from jkroll.pictures.canvas import LINES
from jkroll.pictures.mathtext import typeset
from jkroll.pictures.page import figure_of
from jkroll.pictures.styles import PAPER, STYLES

SVG_TEXT = re.compile(r"<!-- (.*?) -->", re.DOTALL)  # letters are paths; their text stands beside them


def contours(drawn: Map) -> list[tuple[float, Any]]:
    """The levels of a drawn map, and points on their paths, between the vertices too, in SI units."""
    axes = figure_of(drawn, 4.0, PAPER, has_caption=True).axes[0]
    sets = [one for one in axes.collections if hasattr(one, "levels") and len(one.get_paths()) == len(drawn.levels())]
    found = []
    for level, path in zip(drawn.levels(), sets[0].get_paths(), strict=True):
        ends, codes = np.asarray(path.vertices), np.asarray(path.codes)
        is_drawn = codes[1:] == 2  # a line from the vertex before; others begin anew
        middles = (ends[1:] + ends[:-1])[is_drawn] / 2
        parts = np.concatenate([ends, middles])
        places = []
        for axis, part in ((drawn.x, parts[:, 0]), (drawn.y, parts[:, 1])):
            straight = axis.low + (axis.high - axis.low) * part
            places.append(axis.low * (axis.high / axis.low) ** part if axis.is_log else straight)
        found.append((level.value, np.array(places)))
    return found


@pytest.mark.parametrize("name", FIGURES)
def test_a_contour_of_the_paper_is_its_formula(name: str) -> None:
    drawn = figure(name, known_materials(), OF_PAPER)
    declared = FIGURES[name]
    sampled = 0
    for value, (x, y) in contours(drawn):
        given: dict[str, Any] = {**declared.given, **inputs_at(drawn.x.name, x), "radius": y}
        np.testing.assert_allclose(solve(declared.quantity, **given), value, rtol=1e-9)
        sampled += len(x)
    assert sampled > 100


@pytest.mark.parametrize(
    ("words", "axes", "given"),
    [
        (["contact_radius_at_load", "quartz"], ("radius=50nm:1um", "load=-4nN:50nN:lin"), {"material": "quartz"}),
        (["n-roll", "quartz"], ("radius=10nm:1um", "speed=1cm/s:1m/s"), {"material": "quartz"}),
    ],
)
def test_a_contour_of_a_users_map_is_its_formula(
    words: list[str], axes: tuple[str, str], given: dict[str, Any]
) -> None:
    drawn, _ = map_of(asked(words, {"x": axes[0], "y": axes[1]}, ()), (201, 201))
    spacing = (drawn.levels()[-1].value - drawn.levels()[0].value) / len(drawn.levels())
    for value, (x, y) in contours(drawn):
        values = solve(drawn.quantity, **given, **{drawn.x.name: x, drawn.y.name: y})
        assert abs(values / value - 1).max() < 1e-3 or abs(values - value).max() < 1e-3 * spacing


@pytest.mark.parametrize(
    "kind", ["svg", pytest.param("pdf", marks=pytest.mark.slow), pytest.param("png", marks=pytest.mark.slow)]
)
def test_the_same_bytes_every_time(run: Run, tmp_path: Path, kind: str) -> None:
    """In another process, an hour later, and whatever the user's own matplotlib settings are."""
    words = ["figure", "8", "--mark", "quartz@100nm", "-o"]
    assert run(*words, f"one.{kind}").code == 0
    (tmp_path / "matplotlibrc").write_text("font.size: 20\nlines.linewidth: 9\n", encoding="utf-8")
    code = [sys.executable, "-m", "jkroll", *words, f"two.{kind}"]
    subprocess.run(code, check=True, capture_output=True, cwd=tmp_path, timeout=60)
    assert (tmp_path / f"one.{kind}").read_bytes() == (tmp_path / f"two.{kind}").read_bytes()


@pytest.mark.parametrize("name", [*FIGURES, "2", "9"])
def test_every_figure_is_drawn_and_says_what_it_is(run: Run, tmp_path: Path, name: str) -> None:
    ran = run("figure", name, "-o", "figure.svg", "--width", "85mm", "--style", "dark")
    assert (ran.code, ran.err) == (0, "")
    text = (tmp_path / "figure.svg").read_text(encoding="utf-8")
    assert f'<svg xmlns:xlink="http://www.w3.org/1999/xlink" width="{0.085 / 0.0254 * 72:.5f}'[:-2] in text
    shown = " ".join(SVG_TEXT.findall(text))
    assert {word for line in ran.out.splitlines()[1:] for word in typeset(line).split()} <= {*unescape(shown).split()}
    assert STYLES["dark"].paper in text


def test_a_picture_without_a_caption(run: Run, tmp_path: Path) -> None:
    run("figure 3a -o bare.svg --no-caption")
    assert "Assumed" not in " ".join(SVG_TEXT.findall((tmp_path / "bare.svg").read_text(encoding="utf-8")))


@pytest.mark.parametrize("name", ["6b", "8"])
def test_no_letter_stands_outside_of_a_narrow_page(name: str) -> None:
    """At a journal's column width everything is within the sheet, as the renderer measures it."""
    drawn = figure(name, known_materials(), OF_PAPER, as_printed=True)
    page = figure_of(drawn, 85 / 25.4, PAPER, has_caption=True)
    page.draw_without_rendering()
    box = page.get_tightbbox()
    assert box.x0 > -0.01
    assert box.x1 < 85 / 25.4 + 0.01
    assert box.y0 > -0.01


def test_curves_are_told_apart_in_grey_by_their_dashes(run: Run, tmp_path: Path) -> None:
    run("map pull-off quartz,iron,graphite,gold --x radius=1nm:1um -o curves.svg")
    text = (tmp_path / "curves.svg").read_text(encoding="utf-8")
    lines = set(re.findall(r"fill: none; (?:stroke-dasharray: ([^;]*); )?(?:stroke-dashoffset: 0; )?stroke: #", text))
    assert len(lines) >= 4
    assert len({*LINES}) == len(LINES)


def test_the_curves_of_a_contact(run: Run, tmp_path: Path) -> None:
    ran = run("contact quartz 100nm --curve -o contact.svg --quiet")
    assert (ran.code, ran.err) == (0, "")
    shown = SVG_TEXT.findall((tmp_path / "contact.svg").read_text(encoding="utf-8"))
    assert {"fold", "pull-off", "jump-in", "stable", "unstable", "fixed grips"} <= {*shown}
    models = (typeset(symbol) for symbol in ("M:", "M_0:", "M_half:", "M_int:", "M_δ:"))
    assert all(any(text.startswith(model) for text in shown) for model in models)


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("contact quartz 100nm -o contact.svg", "add --curve"),
        ("contact quartz 100nm --curve --csv -o contact.svg", "-o and --csv exclude each other"),
        ("contact quartz,iron 100nm --curve -o contact.svg", "2 scenes"),
        ("contact quartz 100nm --curve --load 1nN -o contact.svg", "it takes none"),
        ("figure 3a -o nowhere/figure.svg", "cannot write"),
        ("figure 2 --mark quartz@1nm", "takes no --mark"),
        ("figure 3a --as-printed", "for 6b"),
    ],
)
def test_what_cannot_be_drawn(run: Run, tmp_path: Path, line: str, message: str) -> None:
    ran = run(line)
    assert ran.code == (1 if "cannot write" in message else 2)
    assert message in ran.err
    assert len(ran.err.splitlines()) == 1
    assert not list(tmp_path.glob("*.svg"))


def test_a_picture_that_cannot_be_written_leaves_the_old_one(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "figure.svg"
    file.write_text("old", encoding="utf-8")
    monkeypatch.setattr("jkroll.pictures.page.draw", lambda *_, **__: 1 / 0)
    assert run("figure 3a -o figure.svg").code == 1
    assert file.read_text(encoding="utf-8") == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["figure.svg"]


def test_the_absence_of_the_extra_is_one_line(tmp_path: Path) -> None:
    """Without matplotlib the terminal's picture is drawn; a file is refused before anything is computed."""
    code = (
        "import sys; sys.modules['matplotlib'] = None; from jkroll.cli.process import main; "
        "sys.exit(main(['figure', '3a', *sys.argv[1:]]))"
    )
    shown = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, cwd=tmp_path)
    assert shown.returncode == 0
    assert "log P_c [N]" in shown.stdout
    refused = subprocess.run(
        [sys.executable, "-c", code, "-o", "figure.svg"], capture_output=True, text=True, check=False, cwd=tmp_path
    )
    assert refused.returncode == 2
    assert refused.stderr == "jkroll: this needs matplotlib: pip install 'jkroll[plot]'\n"
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_a_million_points_take_less_than_importing_matplotlib() -> None:
    """In CPU time, each in a process of its own, in turns."""
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


# --- The pictures of the README: written anew by `python tests/pictures/test_drawing.py` ---------------------------------------------

README = Path(__file__).parents[2] / "README.md"
KEPT = Path(__file__).parents[1] / "data"
SHOWN = re.findall(r"^jkroll (.*) -o (\S+\.svg)(.*)$", README.read_text(encoding="utf-8"), re.MULTILINE)
_NUMBER = re.compile(r"-?\d+\.?\d*")


def written(words: str, rest: str, file: Path) -> str:
    """The picture of a command of the README."""
    assert main([*words.split(), "-o", str(file), *rest.split()]) == 0
    return file.read_text(encoding="utf-8")


def drawing_of(svg: str) -> list[float]:
    """All coordinates of the paths of an SVG."""
    return [float(number) for path in re.findall(r' d="([^"]*)"', svg) for number in _NUMBER.findall(path)]


@pytest.mark.parametrize(("words", "file", "rest"), SHOWN, ids=[file for _, file, _ in SHOWN])
def test_the_pictures_of_the_readme_are_current(words: str, file: str, rest: str, tmp_path: Path) -> None:
    """The same texts in the same order, and every line within a tenth of a point, whatever version of matplotlib drew it."""
    assert f"](tests/data/{file})" in README.read_text(encoding="utf-8")
    kept, new = (KEPT / file).read_text(encoding="utf-8"), written(words, rest, tmp_path / file)
    assert SVG_TEXT.findall(kept) == SVG_TEXT.findall(new)
    np.testing.assert_allclose(drawing_of(kept), drawing_of(new), atol=0.1)
    assert len(kept) < 150_000


def test_the_readme_shows_two_pictures() -> None:
    assert {file for _, file, _ in SHOWN} == {path.name for path in KEPT.glob("*.svg")}
    assert len(SHOWN) == 2


if __name__ == "__main__":
    for words, file, rest in SHOWN:
        written(words, rest, KEPT / file)
