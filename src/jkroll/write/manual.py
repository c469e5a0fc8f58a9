"""The pages of the manual, formatted by rich on a terminal, and the search in pages, quantities and materials."""

import os
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from itertools import groupby
from typing import ClassVar, NamedTuple, TextIO

from ..errors import BadRequest
from ..materials.library import Material
from ..quantities.nomenclature import NOMENCLATURE, named, with_symbol
from ..quantities.synonyms import QUANTITY_OF_SYNONYM, WORDS_OF_OTHERS, Words
from ..text import closest, quoted, say, say_wrapped, terminal_width, wrapped
from .search import Field, Search, words_in, words_sought

_FOLDER = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "guide")
_ENDING = ".md"
_IMAGE = re.compile(r"!\[[^]]*\]\([^)]*\)\n\n")  # images are shown on the site only

# Further terms of the field by which a search finds a section, by page and heading.
FIELD_TERMS: Mapping[tuple[str, str], str] = {
    ("contact-angle", "γ from contact angles"): "wetting wettability contact angle owens wendt surface tension",
    ("contact-angle", "An example by Owens and Wendt"): "contact angle wetting",
    ("dem", "DEM"): "lammps",
    ("dem", "Other programs, and damping"): "dissipation viscous coefficient of restitution",
    ("dem", "What other codes call γ"): "cohesion energy density",
    ("energies", "Energies by convention"): "E_break E_roll stickiness sticking bouncing rebound restitution",
    ("energies", "Aggregates"): "agglomerates clusters fractal",
    ("measurements", "Rough and humid"): "roughness asperities capillary meniscus humidity moisture water liquid",
    ("models", "Limits"): "doubts codes",
    ("models", "Between JKR and DMT"): "tabor parameter maugis law",
    ("models", "Sliding, twisting, peeling"): "friction detachment resuspension",
    ("tables", "Tables"): "read csv file spreadsheet",
    ("tables", "Sweeps"): "mixture of sizes pairs and a wall lists ranges",
    ("validation", "Measurements"): "stickiness sticking bouncing rebound coefficient of restitution detachment",
}

SECTIONS = {"doubts": ("models", "Limits")}  # sections by a short name, to which notes refer
HISTORY = "changes"  # the page of past changes; only a search with this word looks there
MAX_TEXT = 100  # width of running text
MAX_LINES = 12  # if two passages have more lines on a terminal, only the first is shown
LEAST_SHOWN, LEAST_NAMED = 0.7, 0.5  # least score, relative to the best, of a passage shown and of a page named
MAX_ELSEWHERE = 3  # number of pages, or of materials, named below a passage
LIKELY = 0.75  # least similarity of a known word that is suggested for an unknown one


class Section(NamedTuple):
    """A section of a page: a heading of the second rank with its text, or the title of the page and its first text."""

    page: str
    heading: str
    text: str  # Markdown, with the heading


class Passage(NamedTuple):
    """A paragraph, an item of a list, or a row of a table."""

    section: Section
    text: str  # Markdown
    head: str  # the header of the table; empty for text
    is_first: bool  # True in the first block of a section, which answers the heading


def topics() -> tuple[str, ...]:
    """Return the topics of the manual, which are the names of its pages."""
    names = sorted(os.listdir(_FOLDER))
    return tuple(name.removesuffix(_ENDING) for name in names if name.endswith(_ENDING))


def page(topic: str) -> str:
    """Return the page of a topic as Markdown, without images."""
    with open(os.path.join(_FOLDER, topic + _ENDING), encoding="utf-8") as file:
        return _IMAGE.sub("", file.read())


def sections() -> list[Section]:
    """Return the sections of all pages, in their order."""
    every = []
    for topic in topics():
        for piece in re.split(r"^(?=## )", page(topic), flags=re.MULTILINE):
            heading, _, _ = piece.partition("\n")
            every.append(Section(topic, heading.lstrip("# "), piece))
    return every


def write_text(text: str, out: TextIO) -> None:
    """Write Markdown: unchanged in a pipe, formatted with a readable line length on a terminal."""
    if not out.isatty():
        out.write(text)
        return
    from rich.console import Console
    from rich.markdown import CodeBlock, Markdown
    from rich.text import Text

    class Lines(CodeBlock):
        """A code block with unchanged lines; the terminal wraps long ones."""

        def __rich_console__(self, *_: object) -> Iterator[Text]:
            yield Text(str(self.text).rstrip(), style="cyan", no_wrap=True, overflow="ignore")

    class Page(Markdown):
        elements: ClassVar = {**Markdown.elements, "fence": Lines, "code_block": Lines}

    width = min(terminal_width(), MAX_TEXT)
    console = Console(file=out, width=width, highlight=False, markup=False, emoji=False)
    console.print(Page(text, hyperlinks=False), crop=False, soft_wrap=False)


def write_topics(out: TextIO) -> None:
    """Write the topics, each with the title of its page."""
    names = topics()
    width = max(map(len, names))
    for topic in names:
        title = page(topic).partition("\n")[0].removeprefix("# ")
        say(f"{topic:{width}}  {title}", out)


# --- Search -----------------------------------------------------------------------------------------------------------


def passages() -> Iterator[Passage]:
    """Iterate over the passages of all pages; blocks of code are left out."""
    for section in sections():
        _, _, body = section.text.partition("\n")
        prose = re.sub(r"^```.*?^```", "", body, flags=re.DOTALL | re.MULTILINE).strip()
        for number, block in enumerate(re.split(r"\n\s*\n|\n(?=- |\d+\. )", prose)):
            if block.startswith("|"):
                head, line, *rows = block.split("\n")
                for row in rows:
                    yield Passage(section, row, f"{head}\n{line}\n", number == 0)
            elif block:  # without the sentence that introduces an example
                text = re.sub(r"(?<=\. )[^.]*:$", "", block).strip().removesuffix(":")
                yield Passage(section, text, "", number == 0)


def section_meant(text: str) -> Section | None:
    """Return the section that a text names, by its short name or by its page and words of its heading.

    The result is None if no section fits, or if several do.
    """
    page, _, words = text.partition(" ")
    of_heading = {*words_in(words)}
    meant = []
    for section in sections():
        has_words = section.page == page and of_heading and of_heading <= {*words_in(section.heading)}
        if has_words or (section.page, section.heading) == SECTIONS.get(text):
            meant.append(section)
    return meant[0] if len(meant) == 1 else None


class Hits(NamedTuple):
    """The results of a search, the best first."""

    passages: Sequence[Passage]  # at most two, with similar scores; none if only a quantity or a material matches
    pages: Sequence[str]  # pages of passages with at least LEAST_NAMED of the best score
    quantities: Sequence[str]
    materials: Sequence[str]


def hits_of(text: str, materials: Iterable[Material]) -> Hits:
    """Return the results of a search; raise BadRequest for a text without words, or for a word that occurs nowhere."""
    words = words_sought(text)
    if not words:
        raise BadRequest(f"{quoted(text, 40)} has no word to search for; {_LISTS}")
    searched = [passage for passage in passages() if passage.section.page != HISTORY or HISTORY in words]
    of_manual = Search(searched, _fields_of_passage)
    of_quantities = Search(NOMENCLATURE, _fields_of_quantity)
    of_materials = Search(materials, _fields_of_material)
    searches = of_manual, of_quantities, of_materials
    for word in words:
        if not any(search.knows(word) for search in searches):
            raise _unknown_word(word, {*topics()}.union(*(search.vocabulary for search in searches)))
    ranked = of_manual.ranked(words)
    best = [match.thing for match in ranked[:2] if match.score >= LEAST_SHOWN * ranked[0].score]
    pages = [match.thing.section.page for match in ranked if match.score >= LEAST_NAMED * ranked[0].score]
    return Hits(
        best,
        [*dict.fromkeys(pages)],
        _with_synonym(text, of_quantities.with_all(words)),
        [material.name for material in of_materials.with_all(words)],
    )


_LISTS = "jkroll guide lists the pages, jkroll quantities the quantities"


def _unknown_word(word: str, known: Iterable[str]) -> BadRequest:
    """Return the error for a word that occurs in no page, quantity or material."""
    guess = closest(word, sorted(known), LIKELY)
    remedy = f"did you mean {guess}?" if guess else "leave it out, or"
    return BadRequest(f"nothing has the word {quoted(word, 40)}; {remedy} {_LISTS}")


def materials_with(text: str, materials: Iterable[Material]) -> list[Material]:
    """Return the materials with all words of a text in their names, states or sets, in the order given."""
    every = [*materials]
    matching = {*Search(every, _fields_of_material).with_all(words_sought(text))}
    return [material for material in every if material in matching]


def quantities_meant(words: Sequence[str]) -> list[str]:
    """Return the quantities of a comma-separated list, or those with the words as their name or symbol.

    Without words, all quantities are returned.
    """
    if not words:
        return list(NOMENCLATURE)
    several = [named(word.strip()) for word in " ".join(words).split(",")]
    if len(several) > 1 and NOMENCLATURE.keys() >= {*several}:
        return [*dict.fromkeys(several)]
    text = "_".join(" ".join(words).split())
    return [named(text)] if named(text) in NOMENCLATURE else with_symbol(text)


def _with_synonym(text: str, names: Sequence[str]) -> list[str]:
    """Return the names found, preceded by the quantity of which the text is a synonym.

    Variants come last, and are left out if their quantity is found.
    """
    quantities = [name for name in names if not NOMENCLATURE[name].variant_of]
    variants = [name for name in names if NOMENCLATURE[name].variant_of]
    meant = QUANTITY_OF_SYNONYM.get("_".join(text.split()).casefold())
    if meant:
        quantities.insert(0, meant)
    return without_variants([*dict.fromkeys([*quantities, *variants])])


def without_variants(names: Collection[str]) -> list[str]:
    """Return the names except variants of quantities that are also among them."""
    return [name for name in names if NOMENCLATURE[name].variant_of not in names]


def _fields_of_passage(passage: Passage) -> list[Field]:
    page, heading, _ = passage.section
    bold = " ".join(re.findall(r"\*\*(.+?)\*\*", passage.text))
    of_heading = 3.0 if passage.is_first else 1.5
    terms = FIELD_TERMS.get((page, heading), "")
    return [(3.0, bold), (of_heading, f"{page} {heading}"), (1.5, terms), (1.0, passage.text)]


def _fields_of_quantity(name: str) -> list[Field]:
    quantity, others = NOMENCLATURE[name], WORDS_OF_OTHERS.get(name, Words())
    called = f"{name} {quantity.symbol} {quantity.option}"
    return [(3.0, called), (1.0, quantity.sentence), (1.0, f"{others.certain} {others.likely}")]


def _fields_of_material(material: Material) -> list[Field]:
    return [(3.0, " ".join((material.name, *material.aliases))), (1.0, f"{material.state} {material.title}")]


def _source_of(passage: Passage) -> tuple[Section, str]:
    """Return the section of a passage and the header of its table."""
    return passage.section, passage.head


def write_hits(text: str, hits: Hits, out: TextIO) -> None:
    """Write the best passages, the second only if both are short, and a line on other places with the words."""
    lines = sum(len(wrapped(passage.text, terminal_width())) for passage in hits.passages)
    shown = hits.passages if lines <= MAX_LINES else hits.passages[:1]
    for (section, head), group in groupby(shown, key=_source_of):
        write_text(head + "\n".join([passage.text for passage in group]) + "\n", out)
        of_section = f", {section.heading}" if section.text.startswith("## ") else ""
        say_wrapped(f"from the page {section.page}{of_section}: jkroll guide {section.page}", out)
    shown_pages = {passage.section.page for passage in shown}
    others = [page for page in hits.pages if page not in shown_pages]
    elsewhere = [f"jkroll guide {page}" for page in others[:MAX_ELSEWHERE]]
    if hits.quantities:
        elsewhere.append(f"jkroll quantities {' '.join(words_sought(text))}")
    if hits.materials:
        elsewhere.append(f"jkroll materials {','.join(hits.materials[:MAX_ELSEWHERE])}")
    if elsewhere:
        say_wrapped(f"{'also' if shown else 'see'}: {', '.join(elsewhere)}", out)
