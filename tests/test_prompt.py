"""The prompt of the manual's site, in headless Chromium and without a network: its answers are those of the program.

In the sdist, which has no `.docs`, these tests are skipped. Where CI is set, a missing browser is a failure.
"""

import os
import re
import runpy
import subprocess
import sys
from collections.abc import Iterator
from math import inf, nan
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy
import orjson
import pytest

from browser import CHROMIUM, DRIVER, Browser, browser, served
from doors import call_of
from jkroll.cli.draw import map_request
from jkroll.pictures.maps import picture_of
from jkroll.pictures.picture import Axis, Curve, Mark, Panel, Picture
from terminal import script, without_colours
from transcripts import CURVE, TABLE, rounded

DOCS = Path(__file__).parents[1] / ".docs"
IS_CI = bool(os.environ.get("CI"))
pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not DOCS.exists(), reason="the sdist has no .docs"),
    pytest.mark.skipif(not (CHROMIUM and DRIVER) and not IS_CI, reason="needs chromium and chromedriver"),
]

LINES = (
    "pull-off quartz 100nm",
    "yield-force quartz 100nm --xi 0.2nm",
    "r-min 100nm",
    "n-grav quartz 100nm --gravity 1.62m/s2",
    "frequencies quartz 100nm",
    "n-roll quartz 100nm --speed 10cm/s",
    "quantities P_c --json",
    "pull-off quartz,iron 10nm,1um",
    "materials quartz",
    "guide promises",
    "resistances quartz 100nm --explain",
    "pull-off quarz 100nm",
)


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Browser, str]]:
    """A browser, and the address of the prompt in it."""
    folder = tmp_path_factory.mktemp("prompt")
    subprocess.run([sys.executable, DOCS / "prompt_files.py", folder], check=True)
    with served(folder) as address, browser(tmp_path_factory.mktemp("profile")) as window:
        yield window, address


def opened(page: tuple[Browser, str], query: str = "", **size: int) -> Browser:
    """Open the prompt, and wait until it has answered its first line."""
    window, address = page
    window.open(address + query, **size)
    window.wait("document.body.dataset.ready")
    return window


def answer(window: Browser, line: str) -> dict[str, Any]:
    """Return the answer to a line: its text with colours, the text as shown, and the exit code."""
    window.script("document.getElementById('line').value = arguments[0]; document.forms[0].requestSubmit()", line)
    window.wait(f"document.getElementById('answer').dataset.line === {line!r}")
    window.wait("document.getElementById('answer').getAttribute('aria-busy') === 'false'")
    found: dict[str, Any] = window.script(
        "const a = document.getElementById('answer');"
        "return {text: a.raw, shown: a.textContent, code: Number(a.dataset.code)}"
    )
    return found


@pytest.mark.parametrize("line", LINES)
def test_an_answer_is_that_of_the_program_on_a_terminal(page: tuple[Browser, str], line: str) -> None:
    window = page[0] if page[0].script("return Boolean(document.body?.dataset.ready)") else opened(page)
    found, (printed, code) = answer(window, line), script(line)
    assert without_colours(found["text"]) == without_colours(printed)
    assert found["shown"] == without_colours(printed)
    assert found["code"] == code


@pytest.mark.parametrize("line", ["pull-off quartz 1nm:1um:5000 --csv", "map r-min --x radius=1nm:1um"])
def test_an_answer_that_needs_numpy_is_that_of_the_program(page: tuple[Browser, str], line: str) -> None:
    """The first of these lines loads numpy, which the new profile of the browser does not have in its cache."""
    found, (printed, code) = answer(opened(page), line), script(line)
    assert rounded(found["shown"]) == rounded(without_colours(printed))
    assert found["code"] == code == 0


def test_numbers_of_a_large_sweep_are_spelled_as_by_orjson() -> None:
    """The module of the prompt that replaces orjson writes and reads the same bytes."""
    there = runpy.run_path(str(DOCS / "prompt" / "orjson.py"))
    values = [0.0, -0.0, 1.0, 100.0, 1e-5, 4.999999999999999e-05, 1e-7, 5e-324, -1e15, 0.1]
    for each in (numpy.array(values), numpy.array([values, values]), numpy.array([1.0, nan, -inf]), values, [1, None]):
        text = orjson.dumps(each, option=orjson.OPT_SERIALIZE_NUMPY)
        assert there["dumps"](each, option=there["OPT_SERIALIZE_NUMPY"]) == text
        assert there["loads"](text) == orjson.loads(text)


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ("contact quartz 100nm --curve -o a.pdf", "this line needs matplotlib"),
        ("pull-off quartz 1parsec", "this line needs pint"),
    ],
)
def test_a_line_that_needs_a_missing_library_points_to_the_manual(
    page: tuple[Browser, str], line: str, reason: str
) -> None:
    found = answer(opened(page), line)
    said = "which this page lacks;\nthe manual, linked below, says how to install jkroll"
    assert (found["code"], found["shown"]) == (1, f"jkroll: {reason}, {said}\n")


def drop_table(window: Browser) -> None:
    """Drop a table of grains on the page."""
    window.script(
        """
        const carried = new DataTransfer();
        carried.items.add(new File([arguments[0]], "grains.csv"));
        document.body.dispatchEvent(new DragEvent("drop", {dataTransfer: carried, bubbles: true, cancelable: true}));
        """,
        TABLE,
    )
    window.wait("document.getElementById('status').textContent.startsWith('grains.csv is here')")


def test_a_dropped_table_is_read_and_the_results_can_be_saved(
    page: tuple[Browser, str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    window = opened(page)
    drop_table(window)
    window.script("const line = document.getElementById('line'); line.value = 'batch g'; line.focus()")
    window.type("Tab")
    window.wait("document.getElementById('line').value === 'batch grains.csv '")
    found = answer(window, "batch grains.csv -o forces.csv")
    saved, expected = tmp_path / "saved", tmp_path / "expected"
    expected.mkdir()
    monkeypatch.chdir(expected)
    Path("grains.csv").write_text(TABLE, encoding="utf-8")
    printed, code = script("batch grains.csv -o forces.csv")
    assert (found["code"], found["shown"]) == (code, without_colours(printed))
    window.save_downloads(saved)
    window.click("#written a")
    while not (saved / "forces.csv").exists():
        window.wait("true")
    in_page, in_process = ((folder / "forces.csv").read_text(encoding="utf-8") for folder in (saved, expected))
    assert rounded(in_page) == rounded(in_process)  # the last digits depend on the processor


def test_a_dropped_table_remains_after_a_line_is_stopped(page: tuple[Browser, str]) -> None:
    window = opened(page)
    drop_table(window)
    window.script("document.getElementById('line').value = 'pull-off quartz 1nm:1um:9000000 --csv'")
    window.click("form button")
    window.click("form button")
    window.wait("document.getElementById('answer').textContent === 'stopped\\n'")
    assert answer(window, "batch grains.csv -o forces.csv")["code"] == 0


def test_a_curve_chosen_by_the_keyboard_is_fitted(
    page: tuple[Browser, str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    line = "fit curve.csv --radius 7.5um --radius2 plane --spring 3.01N/m --digits 2 --quiet"
    monkeypatch.chdir(tmp_path)
    Path("curve.csv").write_bytes(CURVE.read_bytes())
    window = opened(page)
    window.script("document.getElementById('file').focus()")
    window.type(str(tmp_path / "curve.csv"))
    window.wait("document.getElementById('status').textContent.startsWith('curve.csv is here')")
    found, (printed, code) = answer(window, line), script(line)
    assert (found["code"], found["shown"]) == (code, without_colours(printed))


@pytest.mark.parametrize(
    ("line", "title"),
    [
        (
            "contact quartz 100nm --curve -o a.svg",
            "force, Eqs (5) and (6); pressure, Eq (12); moment up to ξ_max = 1.33 nm",
        ),
        ("map pull-off quartz --x radius=1nm:1mm --y gamma=1mJ/m2:10J/m2 -o a.svg", "pull-off force, P_c"),
        ("figure geometry -o a.svg", "Symbols"),
    ],
)
def test_a_picture_is_shown_below_its_line(
    page: tuple[Browser, str], line: str, title: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("matplotlib", reason="jkroll draws with matplotlib on the terminal")
    monkeypatch.chdir(tmp_path)
    window = opened(page)
    found, (printed, code) = answer(window, line), script(line)
    assert (found["code"], found["shown"]) == (code, without_colours(printed))
    shown = window.script("""
        const picture = document.querySelector("#written img");
        await picture.decode();
        return [picture.alt, picture.naturalWidth > 0]""")
    assert shown == [title, True]


def test_a_picture_is_drawn_without_matplotlib() -> None:
    there = runpy.run_path(str(DOCS / "prompt" / "page.py"))
    line = Curve("line", numpy.array([0.0, 1e-8]), numpy.array([1e-9, 1e-3]))
    axes = Axis("load", 0.0, 1e-8, is_log=False), Axis("radius", 1e-9, 1e-3)
    panel = Panel(*axes, (line,), (Mark("⟦P_c⟧ here", 5e-9, 1e-6),))
    svg = there["draw"](Picture("", (panel,), ("Fixed: nothing.",)), "svg", None, "paper").decode()
    texts = ElementTree.fromstring(svg).iter("{http://www.w3.org/2000/svg}text")
    assert 'd="M0.0,250.0L330.0,0.0"' in svg
    assert 'cx="165.0" cy="125.0"' in svg
    assert ["".join(text.itertext()).replace("\u200b", "") for text in texts] == [
        *("0", "5", "10", "load (a pull is negative), P [nN]"),
        *("1 nm", "100 nm", "10 µm", "1 mm", "radius of sphere 1, R1"),
        *("Pc here", "line", "Fixed: nothing."),
    ]
    (contour,) = there["_lines"](numpy.array([[0.0, 1.0], [0.0, 1.0], [0.0, 2.0]]), 0.5)
    assert contour.tolist() == [[0.5, 0.0], [0.5, 1.0], [0.25, 2.0]]


def test_a_map_has_hatches_best_ranges_and_the_edge_of_a_part_without_values() -> None:
    words = "map contact-radius-at-load quartz --x radius=10nm:1um --y load=-50nN:50nN --mark quartz@100nm"
    picture, _ = picture_of(map_request(call_of(words.split())))
    svg: str = runpy.run_path(str(DOCS / "prompt" / "page.py"))["draw"](picture, "svg", None, "paper").decode()
    found = ElementTree.fromstring(svg).iter("{http://www.w3.org/2000/svg}text")
    texts = [re.sub("\u200b", "", "".join(text.itertext())).replace("\u00a0", " ") for text in found]
    (dots,) = re.findall('<pattern id="(.*?)"', svg)
    assert svg.count(f'fill="url(#{dots})"') == 2  # the region, and its key in the legend
    contours = [text for text in texts if text in {str(radius) for radius in range(2, 20, 2)}]
    assert len(contours) == svg.count('fill="#ffffff" opacity="0.55"') == 9  # each has the band of a best range
    keys = texts[texts.index("quartz, 100 nm") + 1 :]
    assert keys[:4] == [
        "a/z0 < 3: contact radius below 3 atoms",
        "pH/E* > 0.1: the pressure exceeds even the strength of",
        "a flawless solid: numbers are rough",
        "eh > 0.01: contact too wide for the formulas",
    ]
    assert keys[4:7] == [
        "contours: JKR; bands: where they may lie (best ranges by",
        "the rule “Maugis”)",
        "no value: beyond pull-off",
    ]


def test_no_text_of_the_prompt_says_that_jkroll_is_on_a_package_index() -> None:
    texts = [path.read_text(encoding="utf-8") for path in (DOCS / "prompt").iterdir() if path.is_file()]
    assert not [text for text in texts if "pip install" in text]


def test_the_keyboard_completes_words_and_recalls_lines(page: tuple[Browser, str]) -> None:
    window = opened(page)
    window.script("const line = document.getElementById('line'); line.value = ''; line.focus()")
    window.type("r-m")
    window.type("Tab")
    window.wait("document.getElementById('line').value === 'r-min '")
    window.type("100nm")
    window.type("Enter")
    window.wait("document.getElementById('answer').dataset.line === 'r-min 100nm'")
    window.script("document.getElementById('line').value = ''")
    window.type("pull-off sil")
    window.type("Tab")
    window.wait("!document.getElementById('choices').hidden")
    assert window.script("return document.querySelector('[aria-selected=true]').textContent") == "silica-dry"
    window.type("ArrowDown")
    window.type("Enter")
    assert window.script("return document.getElementById('line').value") == "pull-off silica-humid "
    window.type("100nm")
    window.type("Enter")
    window.wait("document.getElementById('answer').dataset.line === 'pull-off silica-humid 100nm'")
    window.type("ArrowUp")
    window.type("ArrowUp")
    assert window.script("return document.getElementById('line').value") == "r-min 100nm"


def test_a_link_carries_a_line_that_waits_for_a_click(page: tuple[Browser, str]) -> None:
    window = opened(page, "?c=r-min%20200nm")
    assert window.script("return document.getElementById('line').value") == "r-min 200nm"
    assert window.script("return document.getElementById('answer').textContent") == ""
    window.click("form button")
    window.wait("document.getElementById('answer').dataset.line === 'r-min 200nm'")
    answer(window, "r-min 300nm")
    assert window.script("return location.search") == "?c=r-min%20300nm"


def test_the_page_fits_a_narrow_screen(page: tuple[Browser, str]) -> None:
    """The answer scrolls within the page; the page does not scroll."""
    window = opened(page, "?c=contact%20quartz%20100nm", width=390, height=800)
    answer(window, "contact quartz 100nm")
    assert window.script("return document.documentElement.scrollWidth <= document.documentElement.clientWidth")
    assert window.script("const pre = document.getElementById('answer'); return pre.scrollWidth > pre.clientWidth")


def test_the_page_is_small() -> None:
    """The page has at most 450 lines of HTML, CSS and JavaScript."""
    files = [path for path in (DOCS / "prompt").iterdir() if path.suffix in (".html", ".css", ".js")]
    assert sum(len(path.read_text(encoding="utf-8").splitlines()) for path in files) <= 450
