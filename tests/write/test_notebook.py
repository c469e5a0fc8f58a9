"""Answers, materials, quantities and fits in a notebook: the words of the terminal, as text, HTML and LaTeX."""

import re
import shutil
import subprocess
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest

import jkroll
from harness import Run

QUESTIONS = [
    ("pull-off quartz 100nm", "pull-off", {"material": "quartz", "radius": 1e-7}),
    ("contact ice-cold 1um --load 2nN", "contact", {"material": "ice-cold", "radius": "1 um", "load": "2nN"}),
    ("report iron 100nm --radius2 plane", "report", {"material": "iron", "radius": "100nm", "radius2": "plane"}),
    ("energies quartz 100nm", "energies", {"material": "quartz", "radius": "100nm"}),
]
LISTS: list[tuple[str, str, dict[str, Any]]] = [
    (
        "pull-off quartz,silica-dry,iron 100nm",
        "pull-off",
        {"material": ["quartz", "silica-dry", "iron"], "radius": 1e-7},
    ),
    (
        "contact quartz,iron 100nm,1um --load -20nN --model jkr,maugis",
        "contact",
        {"material": ("quartz", "iron"), "radius": ["100nm", 1e-6], "load": "-20nN", "model": ["jkr", "maugis"]},
    ),
    ("report 1um --gamma 25±5mJ/m2,30mJ/m2", "report", {"radius": "1um", "gamma": ["25±5mJ/m2", 0.03]}),
]


class Cells(HTMLParser):
    """A reader of the texts of cells and paragraphs, in their order."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.texts: list[str] = []
        self.feed(text)
        assert not self.tags

    def handle_starttag(self, tag: str, attrs: Any) -> None:  # noqa: ARG002
        """Open a tag and begin its text."""
        self.tags.append(tag)
        if tag in ("td", "th", "p"):
            self.texts.append("")

    def handle_endtag(self, tag: str) -> None:
        """Close a tag, which must be the last one opened."""
        assert self.tags.pop() == tag

    def handle_data(self, data: str) -> None:
        """Add to the text of the open tag."""
        if self.tags[-1] in ("td", "th", "p"):
            self.texts[-1] += data


def words_of(text: str) -> list[str]:
    """Return the words of a text without horizontal rules, and with options written as arguments."""
    text = text.replace("more: --explain", "more: .why, .notes and .doubts").replace(
        ".doubts of each answer", ".doubts"
    )
    text = re.sub(r"--([a-z0-9-]+)", lambda option: option[1].replace("-", "_"), text)
    return re.sub("─+", " ", text).split()


@pytest.mark.parametrize(("words", "wanted", "scene"), QUESTIONS)
def test_print_and_html_have_the_words_of_the_terminal(run: Run, words: str, wanted: str, scene: Any) -> None:
    ran, found = run(*words.split(), terminal=True), jkroll.answer(wanted, **scene)
    assert words_of(str(found)) == words_of(ran.out + ran.err)
    shown = Cells(found._repr_html_())
    assert sorted(" ".join(shown.texts).split()) == sorted(words_of(ran.out + ran.err))
    assert "best range" in shown.texts


@pytest.mark.parametrize(("words", "wanted", "scene"), LISTS)
def test_lists_have_the_words_of_the_terminal(run: Run, words: str, wanted: str, scene: Any) -> None:
    ran, found = run(*words.split(), terminal=True), jkroll.answer(wanted, **scene)
    notes = re.sub(r"jkroll: .*\n", "", ran.err)  # Python has no line on the number of failed rows
    assert words_of(str(found)) == words_of(ran.out + notes)


def test_a_list_is_one_html_table_however_wide() -> None:
    found = jkroll.answer("contact", material=["quartz", "iron"], radius=["100nm", "1um"])
    html = found._repr_html_()
    assert html.count("<table>") == 1
    rows = [Cells(row).texts for row in html.splitlines() if row.startswith("<tr>")]
    assert rows[0][:3] == ["material", "R1 [nm]", "γ [mJ/m²]"]
    assert [row[0] for row in rows[1:]] == ["quartz", "quartz", "iron", "iron"]
    bundle = found._repr_mimebundle_(include=None, exclude=None)
    assert (bundle["text/plain"], bundle["text/html"]) == (str(found), html)
    assert bundle["text/latex"].count(r"\hline") == 1


def test_a_notebook_gets_text_html_and_latex() -> None:
    found = jkroll.answer("pull-off", material="quartz", radius=1e-7)
    bundle = found._repr_mimebundle_(include=None, exclude=None)
    assert bundle["text/plain"] == str(found)
    assert bundle["text/html"] == found._repr_html_()
    assert r"pull-off force, limit & $P_{\mathrm{c}}$ & 14–15 & Maugis & 11.78 & nN \\" in bundle["text/latex"]


def test_material_names_of_users_are_escaped_in_html() -> None:
    solid = jkroll.known_materials()["quartz"]._replace(name="<b>&")
    html = jkroll.answer("pull-off", material=solid, radius=1e-7)._repr_html_()
    assert "&lt;b&gt;&amp;" in html
    assert "<b>" not in html


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="needs LaTeX")
def test_latex_typesets_an_answer(tmp_path: Path) -> None:
    body = jkroll.answer("report", material="quartz", radius=1e-7)._repr_mimebundle_()["text/latex"]
    page = rf"\documentclass{{article}}\begin{{document}}{body}\end{{document}}"
    (tmp_path / "a.tex").write_text(page, encoding="utf-8")
    subprocess.run(["pdflatex", "-halt-on-error", "a.tex"], cwd=tmp_path, check=True, capture_output=True)


def test_materials_are_an_html_table(run: Run) -> None:
    known = jkroll.known_materials()
    shown = Cells(known._repr_html_())
    assert shown.texts[:4] == ["material", "γ [mJ/m²]", "E [GPa]", "ν"]
    assert [*known] == shown.texts[len(shown.texts) // (1 + len(known)) :: 7]
    two = Cells(jkroll.Materials()._repr_html_()).texts
    for line in run("materials", "quartz,ice-warm", terminal=True).out.splitlines()[2:4]:
        name, *cells = re.split("  +", line)
        assert two[two.index(name) : two.index(name) + 5] == [name, *cells]


@pytest.mark.parametrize("name", ["quartz", "ice-cold", "silicon-oxide"])
def test_a_material_has_the_words_of_the_terminal(run: Run, name: str) -> None:
    bundle = jkroll.known_materials()[name]._repr_mimebundle_()
    title, *texts = Cells(bundle["text/html"]).texts
    assert words_of(" ".join([title, *texts[2:]])) == words_of(run("materials", name, terminal=True).out)
    assert bundle["text/latex"].count(r"\\") == len(texts) / 2


def test_the_nomenclature_has_the_words_of_the_terminal(run: Run) -> None:
    known = jkroll.NOMENCLATURE
    assert words_of(str(known)) == words_of(run("quantities", terminal=True).out)
    assert sorted(" ".join(Cells(known._repr_html_()).texts).split()) == sorted(words_of(str(known)))
    assert (known["radius"].unit, "radius" in known, len(known)) == ("m", True, len([*known]))
    assert repr(known) == f"<Nomenclature: {len(known)} quantities>"


def test_a_fit_has_the_words_of_the_terminal(run: Run) -> None:
    data = str(Path(__file__).parents[1] / "data" / "afm_retract.csv")
    ran = run("fit", data, *"--radius 7.5um --radius2 plane --spring".split(), "3.01 N/m", terminal=True)
    fitted = jkroll.fit(data, radius="7.5um", radius2="plane", spring="3.01N/m")
    text, _, _ = ran.out.removeprefix("afm_retract.csv: ").partition("\nthen: ")
    assert words_of(str(fitted)) == words_of(text)
    assert sorted(" ".join(Cells(fitted._repr_html_()).texts).split()) == sorted(words_of(str(fitted)))
    assert r"\begin{tabular}" in fitted._repr_mimebundle_()["text/latex"]
    assert repr(fitted).startswith("<FittedCurve: work_of_adhesion_opening = ")
