"""The prompt of the manual's site, in headless Chromium and without a network: its answers are those of the script.

From the sdist, which has no `.docs`, these tests are left out. Where CI is set, a missing browser is a failure.
"""

import os
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from browser import CHROMIUM, DRIVER, Browser, browser, served
from terminal import on_terminal

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
TERMINAL = {"COLUMNS": "80", "LINES": "40", "TERM": "xterm-256color", "FORCE_COLOR": "1"}


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
    """Return the text, with its colours, and the exit code of a line."""
    window.script("document.getElementById('line').value = arguments[0]; document.forms[0].requestSubmit()", line)
    window.wait(f"document.getElementById('answer').dataset.line === {line!r}")
    window.wait("document.getElementById('answer').getAttribute('aria-busy') === 'false'")
    found: dict[str, Any] = window.script(
        "const a = document.getElementById('answer');"
        "return {text: a.raw, shown: a.textContent, code: Number(a.dataset.code)}"
    )
    return found


def script(line: str) -> tuple[str, int]:
    """Return what the script prints on a terminal of 80 columns, and its exit code."""
    code, shown = on_terminal([sys.executable, "-m", "jkroll", *shlex.split(line)], **TERMINAL)
    return shown.replace("\r\n", "\n"), code


def without_colours(text: str) -> str:
    """Return a text without the codes of colours."""
    return re.sub(r"\x1b\[[\d;]*m", "", text)


@pytest.mark.parametrize("line", LINES)
def test_an_answer_is_that_of_the_script(page: tuple[Browser, str], line: str) -> None:
    window = page[0] if page[0].script("return Boolean(document.body?.dataset.ready)") else opened(page)
    found, (printed, code) = answer(window, line), script(line)
    assert without_colours(found["text"]) == without_colours(printed)
    assert found["shown"] == without_colours(printed)
    assert found["code"] == code


def test_what_needs_files_says_what_to_install(page: tuple[Browser, str]) -> None:
    window = opened(page)
    for line in ("batch grains.csv", "pull-off quartz 1nm:1um:9 -o a.csv"):
        found = answer(window, line)
        assert found["code"] == 1
        assert "pip install jkroll" in found["text"]


def test_what_needs_numpy_says_so_without_a_network(page: tuple[Browser, str]) -> None:
    found = answer(opened(page), "pull-off quartz 1nm:1um:5000 --csv")
    assert found["code"] == 1
    assert "numpy" in found["text"]
    assert "pip install jkroll" in found["text"]


def test_history_and_completion_by_the_keyboard(page: tuple[Browser, str]) -> None:
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


def test_a_link_carries_the_line(page: tuple[Browser, str]) -> None:
    window = opened(page, "?c=r-min%20200nm")
    assert window.script("return document.getElementById('answer').dataset.line") == "r-min 200nm"
    answer(window, "r-min 300nm")
    assert window.script("return location.search") == "?c=r-min%20300nm"


def test_a_narrow_screen_shows_all_of_the_page(page: tuple[Browser, str]) -> None:
    """The answer scrolls by itself; the page does not."""
    window = opened(page, "?c=contact%20quartz%20100nm", width=390, height=800)
    assert window.script("return document.documentElement.scrollWidth <= document.documentElement.clientWidth")
    assert window.script("const pre = document.getElementById('answer'); return pre.scrollWidth > pre.clientWidth")


def test_the_page_is_small() -> None:
    """At most 400 lines of HTML, CSS and JavaScript, and no framework."""
    files = [path for path in (DOCS / "prompt").iterdir() if path.suffix in (".html", ".css", ".js")]
    assert sum(len(path.read_text(encoding="utf-8").splitlines()) for path in files) <= 400
