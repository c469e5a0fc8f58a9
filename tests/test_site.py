"""The built site in headless Chromium, without a network: pictures, links, the copy button, and every run button.

Build the site first (see CONTRIBUTING): a site that is older than its sources is refused. In the sdist, which has no
`.docs`, these tests are skipped. Where CI is set, a missing browser or site is a failure.
"""

import re
import runpy
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urldefrag
from zipfile import ZipFile

import pytest

from browser import Browser, browser, hosts_asked, served
from built_site import DOCS, MARKS, ROOT, SITE, axe, site_in_browser
from jkroll import __version__
from jkroll.write.manual import page, topics
from terminal import script, without_colours
from transcripts import commands, rounded, write_shown_file

pytestmark = MARKS
GALLERY = [
    *(f"figure {number}" for number in "2 3a 3b 3c 3d 6a 6b 8 9 laws geometry".split()),
    "map pull-off quartz --x radius=1nm:1mm --y gamma=1mJ/m2:10J/m2 --mark quartz@100nm",
    "map frequencies quartz,iron --x radius=10nm:1um --mark quartz@100nm",
    "contact quartz 100nm --curve",
]
BLOCK_OR_ROW = re.compile(r"^```console\n.*?^```|^\|[^\n]*\|$", re.DOTALL | re.MULTILINE)
IN_CELL = re.compile(r"\| `(jkroll (?!guide)[^`|]+)` (?=\|)")


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Browser, str]]:
    with site_in_browser(tmp_path_factory.mktemp("profile")) as window:
        yield window


@pytest.mark.parametrize(
    "page",
    [
        "<img src=https://example.invalid/a.png>",
        "<script>new Worker(URL.createObjectURL(new Blob(['fetch(\"https://example.invalid/\")'])))</script>",
        "<iframe sandbox=allow-scripts srcdoc='<img src=https://example.invalid/a.png>'></iframe>",
    ],
    ids=["picture", "worker", "frame without an origin"],
)
def test_a_request_to_another_host_is_seen(tmp_path: Path, page: str) -> None:
    (tmp_path / "index.html").write_text(f"<!doctype html><title>asks</title>{page}")
    log = tmp_path / "requests.json"
    with served(tmp_path) as address, browser(tmp_path) as window:
        window.open(address)
        window.wait("document.readyState === 'complete'")
        while "example.invalid" not in log.read_text(encoding="utf-8"):
            window.script("return 0")  # the browser writes the log as it works
    assert hosts_asked(tmp_path) == {"127.0.0.1", "example.invalid"}


def runnable(topic: str) -> list[tuple[str, str]]:
    """Return the commands in the transcripts and tables of a page, in their order, each with its part of the page.

    A command that needs a file is left out unless its transcript begins with this file.
    """
    if topic == "gallery":
        return [(line, "") for line in GALLERY]
    text = (ROOT / "README.md").read_text(encoding="utf-8") if topic == "start" else page(topic)
    parts = [part.removeprefix("```console\n") for part in BLOCK_OR_ROW.findall(text)]
    lines = [(line, part) for part in parts for line in (commands(part) or IN_CELL.findall(part))]
    asked = [(line.removeprefix("jkroll "), part) for line, part in lines if line.startswith("jkroll ")]
    return [
        (line, part)
        for line, part in asked
        if part.startswith("$ cat ") or not (line.startswith(("batch ", "fit ")) or " -o " in line)
    ]


def test_every_picture_is_shown_and_every_link_has_a_target(site: tuple[Browser, str]) -> None:
    window, address = site
    pictures, broken, places, links = 0, [], {}, {}
    for path in sorted(SITE.rglob("*.html")):
        shown = address + path.relative_to(SITE).as_posix().removesuffix("index.html")
        window.open(shown)
        window.wait("document.readyState === 'complete'")
        found = window.script("""
            const pictures = [...document.images];
            await Promise.all(pictures.map((picture) => picture.decode().catch(() => {})));
            return {
              pictures: pictures.map((picture) => [picture.src, picture.naturalWidth]),
              count: pictures.filter((picture) => picture.closest("article")).length,
              files: performance.getEntriesByType("resource").map((file) => [file.name, file.responseStatus]),
              frames: [...document.querySelectorAll("iframe")].map((frame) => frame.src),
              links: [...document.links].map((link) => link.href),
              places: [...document.querySelectorAll("[id]")].map((element) => element.id),
            }""")
        pictures += found["count"]
        broken += [(shown, source) for source, width in found["pictures"] if not width]
        # If a page is left before its icon has arrived, Chromium asks for favicon.ico, which no page names.
        missing = [file for file, status in found["files"] if status >= 400 and not file.endswith("/favicon.ico")]
        broken += [(shown, file) for file in missing]
        places[shown] = {"", *found["places"]}
        links[shown] = {*found["links"], *found["frames"]}
    assert pictures == len(GALLERY) + 2  # one in the README, and one in the page on pictures
    for shown, targets in links.items():
        for target, place in {urldefrag(each) for each in targets if each.startswith(address)}:
            reached = window.script("return fetch(arguments[0]).then((answer) => answer.ok)", target)
            if not reached or (target in places and place not in places[target]):
                broken.append((shown, f"{target}#{place}"))
    assert broken == []


@pytest.mark.parametrize("topic", ["start", "gallery", *topics()])
def test_every_run_button_answers_as_the_program_does(
    site: tuple[Browser, str], topic: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    window, address = site
    monkeypatch.chdir(tmp_path)
    window.open(f"{address}{topic}/")
    if runnable(topic):
        window.wait("document.querySelector('.run button')")
    titles = window.script("return [...document.querySelectorAll('.run button')].map((button) => button.title)")
    assert titles == [f"jkroll {line}" for line, _ in runnable(topic)]
    for place, (line, part) in enumerate(runnable(topic)):
        write_shown_file(part)
        window.script("document.querySelectorAll('.run button')[arguments[0]].click()", place)
        window.wait("document.querySelector('pre.ran[aria-busy=false]')")
        text, code = window.script("""
            const box = document.querySelector("pre.ran");
            box.remove();
            return [box.textContent, Number(box.dataset.code)]""")
        printed, ended = script(line)
        assert (rounded(text), code) == (rounded(without_colours(printed)), ended), line


def test_only_the_commands_of_a_transcript_are_copied(site: tuple[Browser, str]) -> None:
    window, address = site
    window.open(address + "start/")
    window.click(".language-console .md-code__button")
    assert window.clipboard() == "jkroll pull-off quartz 100nm"
    window.click(".language-sh .md-code__button")
    assert window.clipboard() == (
        "python3 -m venv .venv && .venv/bin/pip install --quiet . && .venv/bin/jkroll report quartz 100nm"
    )
    window.click(".language-python .md-code__button")
    assert window.clipboard().splitlines() == [
        "import jkroll",
        'jkroll.solve("pull_off_force", material="quartz", radius="100 nm")',
        'jkroll.solve("yield_force_ratio", material="iron", radius=[1e-9, 1e-8])',
        'f"{jkroll.formulas.pull_off_force(work_of_adhesion=0.05, reduced_radius=50e-9):.4e}"',
    ]
    window.open(address + "tables/")
    window.click(".language-console .md-code__button")
    assert window.clipboard().splitlines() == [
        "cat grains.csv",
        "jkroll batch grains.csv -o forces.csv --quantities pull_off_force,contact_radius_at_load",
        "cat forces.csv",
    ]


@pytest.mark.parametrize(
    "path", ["", "start/", "prompt/", "models/", "all-quantities/", "equations/", "get/", "contact-angle/"]
)
def test_axe_finds_nothing_on_wide_and_narrow_light_and_dark_pages(
    site: tuple[Browser, str], path: str, tmp_path: Path
) -> None:
    window, address = site
    script_of_axe = axe(tmp_path)
    for width, height in ((1280, 800), (390, 844)):
        window.open(address + path, width, height)
        for scheme in (0, 1):
            window.script(
                """
                document.head.append(Object.assign(document.createElement("style"),
                  {textContent: "*, *::before, *::after { transition: none !important; }"}));
                document.querySelectorAll(".md-option")[arguments[0]]?.click();
                if (document.documentElement.scrollWidth > innerWidth) throw new Error("wider than its window");
                """,
                scheme,
            )
            window.script(script_of_axe)
            found = window.script("""
                const tags = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"];
                const { violations } = await axe.run(document, { runOnly: tags });
                return violations.map(({ id, nodes }) => [id, nodes.map(({ target }) => target.join(" "))]);""")
            assert found == [], (width, scheme)


@pytest.mark.parametrize(
    ("words", "place"),
    [
        ("--load", "all-quantities/#load"),
        ("γ", "all-quantities/#surface_energy"),
        ("gamma", "all-quantities/#surface_energy"),
        ("--xi", "all-quantities/#yield_displacement"),
        ("humidity", "all-quantities/#humidity"),
        ("contact angles", "contact-angle/"),
        ("contact angle", "contact-angle/"),
        ("fixed grips", "words/#fixed-grips"),
        ("rolling friction", "all-quantities/#rolling_friction_coefficient"),
        ("pull-off force", "words/#pull-off"),
        ("sticking speed", "words/#sticking-speed"),
        ("work of adhesion", "all-quantities/#work_of_adhesion"),
        ("best range", "answers/#the-best-range"),
    ],
)
def test_the_search_leads_first_to_a_definition(site: tuple[Browser, str], words: str, place: str) -> None:
    window, address = site
    window.open(address + "tables/")
    window.wait("document.querySelector('.md-search-result__meta').textContent.startsWith('Type')")
    window.click(".md-search__input")
    for letter in words:
        window.type(letter)
    last = words.rpartition(" ")[2].strip("-")  # a result's address has the words by which it was found
    results = "[...document.querySelectorAll('.md-search-result__item:first-child a')]"
    window.wait(f"{results}.some((link) => decodeURI(link.search).includes('{last}'))")
    window.type("Enter")
    window.wait("location.pathname !== '/tables/'", 10)
    assert window.script("return location.href.split('?')[0] + location.hash") == address + place


def test_every_page_has_a_content_policy_and_a_description() -> None:
    for path in SITE.rglob("*.html"):
        html = path.read_text(encoding="utf-8")
        assert '<meta http-equiv="Content-Security-Policy" content="default-src \'self\';' in html, path
        assert "unsafe-eval'" not in html.replace("'wasm-unsafe-eval'", "")
        assert '<meta name="description" content="' in html, path
    pages = (SITE / "llms.txt").read_text(encoding="utf-8")
    for topic in topics():
        assert f"]({topic}.md): " in pages
        assert (SITE / f"{topic}.md").read_text(encoding="utf-8").startswith("# ")


@pytest.mark.parametrize(
    ("topic", "link"),
    [
        ("models", '<a href="../all-quantities/#yield_force_fixed_load"><code>yield_force_fixed_load</code></a>'),
        ("models", '<a href="../all-quantities/#yield_displacement"><code class="option">--xi</code></a>'),
        ("tables", '<a href="../all-quantities/#radius"><code>radius</code></a>'),
        ("all-quantities", '<a href="#yield_force"><code>yield_force</code></a></td>'),
        ("all-quantities", '<a href="../commands/#pull-off">pull-off</a>'),
    ],
)
def test_the_name_of_a_quantity_is_a_link_to_its_definition(topic: str, link: str) -> None:
    assert link in (SITE / topic / "index.html").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("formula", "written"),
    [
        ("P_c = 3πγR", "<msub><mi>P</mi><mi>c</mi></msub> = <mn>3</mn><mi>π</mi><mi>γ</mi><mi>R</mi>"),
        ("M/(2cRw)", "<mfrac><mi>M</mi><mn>2</mn><mi>c</mi><mi>R</mi><mi>w</mi></mfrac>"),
        ("F_aR/2π ξ", "<mfrac><msub><mi>F</mi><mi>a</mi></msub><mi>R</mi> <mn>2</mn><mi>π</mi></mfrac><mi>ξ</mi>"),
        ("√(k/m)", "<msqrt><mfrac><mi>k</mi><mi>m</mi></mfrac></msqrt>"),
        ("E*²", "<msup><mi>E</mi>&#42;<mn>2</mn></msup>"),
        ("(a0)^(1/3)", "<msup>(<msub><mi>a</mi><mn>0</mn></msub>)<mn>1/3</mn></msup>"),
        ("R1^(2/3)", "<msubsup><mi>R</mi><mn>1</mn><mn>2/3</mn></msubsup>"),
        ("a0, which is a in JKR", "<msub><mi>a</mi><mn>0</mn></msub>, which is <mi>a</mi> in JKR"),
    ],
)
def test_a_formula_is_typeset_with_indices_roots_and_fractions(formula: str, written: str) -> None:
    typeset = runpy.run_path(str(DOCS / "typeset.py"))["mathml"](formula)
    assert re.sub(r"</?(?:math|mrow|mo|mtext)\b[^>]*>|&nbsp;|\s", "", typeset) == re.sub(r"\s", "", written)


@pytest.mark.parametrize(
    ("sentence", "formulas"),
    [
        ("w is 2√(γ1γ2), which is 2γ for like ones", ["w", "2√(γ1γ2)", "2γ"]),
        ("The fraction (2/5)a²/R² is 0.1 % at w = 3·10⁻⁵ E*R.", ["(2/5)a²/R²", "w", "E*R"]),
        ("1/R = 1/R1 + 1/R2: half (μ is small)", ["1/R = 1/R1 + 1/R2", "μ"]),
        ("of 25 mJ/m², 3 N/m or 1e-30 J/m³ at z0 = 4 Å", ["z0 = 4"]),
        ("`P_c`, [w of E*](paper.md#E1), E*, --z0* and a word, SiO2, 3a, 8e36, J. Phys. D: I", ["E*"]),
        ("| μ R\\|P\\| | nothing at P = 0 |", ["μ", "R|P|", "P = 0"]),
        ("`T* = √(E*a0/m)` decides, `γ` and `mJ/m²` are words of a table", ["T* = √(E*a0/m)"]),
        ("## P_c and E*", []),
    ],
)
def test_formulas_of_a_sentence_are_typeset(
    sentence: str, formulas: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(str(DOCS))
    prose, typeset = (runpy.run_path(str(DOCS / name)) for name in ("prose.py", "typeset.py"))
    written = re.findall("<math.*?</math>", prose["with_formulas"](sentence))
    assert written == [typeset["mathml"](each, is_inline=True) for each in formulas]


def test_the_equations_have_the_numbers_of_the_paper(site: tuple[Browser, str]) -> None:
    window, address = site
    window.open(address + "all-quantities/#pull_off_force")
    assert window.script("""
        const equation = document.querySelector("#pull_off_force ~ .equation");
        return [equation.querySelector("math").textContent, equation.querySelector("span").textContent]
        """) == ["Pc=3πγR=(32)πwR", "(1)"]
    window.open(address + "equations/")
    rows = window.script(
        "return [...document.querySelectorAll('tbody tr')].map((row) => row.innerText.split('\\t')[0])"
    )
    assert {"1", "5", "6", "25", "48"} <= {*rows}
    fraction, letter = window.script(
        "return ['mfrac', 'mi'].map((each) => document.querySelector(each).getBoundingClientRect().height)"
    )
    assert fraction > 1.5 * letter > 0


def test_the_page_get_offers_the_wheel_of_this_version() -> None:
    wheel = f"jkroll-{__version__}-py3-none-any.whl"
    html = (SITE / "get" / "index.html").read_text(encoding="utf-8")
    assert f'href="../prompt/python/{wheel}"' in html
    with ZipFile(SITE / "prompt" / "python" / wheel) as content:
        assert f"Version: {__version__}" in content.read(f"jkroll-{__version__}.dist-info/METADATA").decode()
    for words in ("jkroll: adhesive contact of two elastic spheres", "MIT License", "source code"):
        assert words in html
    # No package index has jkroll, but an installed version can take its extras.
    for path in SITE.rglob("*.html"):
        assert not re.search(r"pip install '?jkroll(?![-[])", path.read_text(encoding="utf-8")), path


def test_a_link_of_the_prompt_leaves_its_frame(site: tuple[Browser, str]) -> None:
    window, address = site
    window.open(address + "try/")
    window.wait("document.querySelector('iframe').contentDocument?.querySelector('#keys a')")
    window.script("document.querySelector('iframe').contentDocument.querySelector('#keys a').click()")
    window.wait("location.pathname === '/start/' && document.readyState === 'complete'", 10)
    assert window.script("return location.hash") == "#thirty-seconds-to-the-first-number"
    assert window.script("return document.querySelector('iframe')") is None
