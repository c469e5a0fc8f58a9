"""The explorer of the built site, in headless Chromium and without a network: its numbers are those of the program."""

import re
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from browser import Browser, browser, served
from built_site import MARKS, SITE, site_in_browser
from terminal import script, without_colours

pytestmark = MARKS
RESULTS = "pull_off_force yield_force r_min n_grav vertical_frequency rolling_frequency n_roll".split()


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Browser, str]]:
    with site_in_browser(tmp_path_factory.mktemp("profile")) as window:
        yield window


def opened(site: tuple[Browser, str], query: str = "", **size: int) -> Browser:
    """Open the explorer, and wait until Python has answered for the inputs of its form."""
    window, address = site
    window.open(address + query, **size)
    window.wait("document.querySelector('#status')?.textContent.startsWith('live')")
    settle(window)
    return window


def settle(window: Browser) -> None:
    """Wait until the numbers on the page are those for the inputs in the form."""
    window.wait("""(() => {
        const shown = JSON.parse(document.querySelector('#explorer').dataset.answered);
        const boxes = [...document.querySelectorAll('#inputs :is(select, input:not([type]))')];
        return boxes.every((box) => box.value.trim() === (shown[box.id] ?? ''));
    })()""")


def texts(window: Browser) -> dict[str, tuple[str, str, str]]:
    """Return the best range, the line below it, and the words of each result that is shown."""
    found: dict[str, Any] = window.script("""
        return Object.fromEntries([...document.querySelectorAll('[data-result]')].map((output) => [
          output.dataset.result,
          [output.querySelector('b').textContent, output.querySelector('small').textContent, output.title]]))""")
    return found


@pytest.mark.parametrize(
    "query",
    [
        "",
        "?material=iron&radius=1um&load=-1uN",
        "?material=&radius=3um&radius2=plane&gamma=30mJ/m2&young=2GPa&poisson=0.4&density=1.2g/cm3&xi=1nm",
        "?material=silica-humid&material2=iron&radius=20um&model=maugis",
        "?radius=1nm&xi=2nm",
    ],
)
def test_the_numbers_of_the_explorer_are_those_of_the_command_below(site: tuple[Browser, str], query: str) -> None:
    window = opened(site, query)
    command, found = window.script("return document.querySelector('#shell').textContent"), texts(window)
    printed, code = script(command.removeprefix("jkroll "), columns=100)
    assert code == 0
    lines = without_colours(printed).splitlines()
    checked = 0
    for best, below, words in found.values():
        rows = [re.split(r"\s{2,}", line) for line in lines if line.startswith(f"{words}  ")]
        if not rows:  # the command states in a note why there is no such result
            assert best == "–"
            continue
        ((_, _, *cells),) = rows
        numbers = [cell for cell in cells if cell != "–"]
        shown = f"{best} {below}".replace("(", "").replace(")", "")
        assert all(number in shown for number in numbers[:-1]), (words, cells, best, below)
        checked += bool(numbers[:-1])
    assert checked >= 3


def test_the_page_has_numbers_before_any_script_runs() -> None:
    html = (SITE / "index.html").read_text(encoding="utf-8")
    printed = without_colours(script("report quartz 100nm --speed 20cm/s", columns=100)[0])
    for name in RESULTS:
        ((words, best),) = re.findall(rf'data-result="{name}" title="([^"]*)">.*?<b>([^<]*)</b>', html)
        (line,) = (line for line in printed.splitlines() if line.startswith(f"{words}  "))
        assert best.split(" n")[0].split(" p")[0].split(" µ")[0].split(" M")[0] in line


def test_the_keyboard_moves_a_slider_and_the_back_button_undoes_this(site: tuple[Browser, str]) -> None:
    window = opened(site)
    before = texts(window)
    window.script("document.querySelector('#speed').focus()")
    window.type("Tab")
    assert window.script("return document.activeElement.dataset.of") == "speed"
    window.script("document.querySelector('[data-of=radius]').focus()")
    window.type("ArrowRight")
    settle(window)
    assert window.script("return document.querySelector('#radius').value") == "105nm"
    assert "radius=105nm" in window.script("return location.search")
    assert texts(window)["pull_off_force"] != before["pull_off_force"]
    window.script("history.back()")
    window.wait("location.search === ''")
    settle(window)
    assert texts(window) == before


def test_an_invalid_input_is_explained_and_its_box_is_marked(site: tuple[Browser, str]) -> None:
    window = opened(site, "?radius=3")
    window.wait("document.querySelector('#wrong').textContent")
    wrong = window.script("return document.querySelector('#wrong').textContent")
    assert wrong == "radius: '3' has no unit; expected a length such as 100nm"
    assert window.script("return document.querySelector('[aria-invalid]').id") == "radius"


def test_buttons_copy_the_command_the_call_and_the_link(site: tuple[Browser, str]) -> None:
    window = opened(site, "?radius=1um")
    for what, name, text in [
        ("shell", "command", "jkroll report quartz 1um --speed=20cm/s"),
        (
            "python",
            "call",
            'import jkroll\nprint(jkroll.answer("report", material="quartz", radius="1um", speed="20cm/s"))',
        ),
        ("link", "link", f"{site[1]}?radius=1um"),
    ]:
        window.click(f"[data-copy={what}]")
        window.wait(f"document.querySelector('#status').textContent === '{name} copied'")
        assert window.clipboard() == text


def test_the_page_fits_a_narrow_screen(site: tuple[Browser, str]) -> None:
    window = opened(site, width=390, height=844)
    assert window.script("return document.documentElement.scrollWidth <= document.documentElement.clientWidth")


@pytest.mark.parametrize("missing", ["prompt/worker.js", "prompt/explore.py", "prompt/pyodide/pyodide.asm.wasm"])
def test_a_missing_file_is_named(tmp_path: Path, missing: str) -> None:
    copy, profile = tmp_path / "site", tmp_path / "profile"
    shutil.copytree(SITE, copy)
    (copy / missing).unlink()
    with served(copy) as address, browser(profile) as window:
        window.open(address)
        window.wait("document.querySelector('#state').classList.contains('error')", 10)
        said = window.script("return document.querySelector('#status').textContent")
    assert said.startswith("Python could not be started: ")
    assert missing in said
    assert said.endswith("The numbers are those of the first contact")
