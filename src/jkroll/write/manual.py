"""The manual: pages of Markdown, formatted by rich on a terminal; and its search, with quantities and materials."""

import os
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from itertools import groupby
from typing import ClassVar, NamedTuple, TextIO

from ..errors import BadRequest
from ..materials.library import Material
from ..quantities.nomenclature import NOMENCLATURE, named, with_symbol
from ..quantities.synonyms import QUANTITY_SYNONYMS, WORDS_OF_OTHERS, Words
from ..text import closest, quoted, say, say_wrapped, terminal_width, wrapped
from .search import Field, Search, words_in, words_sought

_FOLDER = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "guide")
_ENDING = ".md"
_IMAGE = re.compile(r"!\[[^]]*\]\([^)]*\)\n\n")  # images are shown on the site only

# Terms of the field by which a section is found, in addition to its heading.
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

SECTIONS = {"doubts": ("models", "Limits")}  # sections with a short name, for references in notes
HISTORY = "changes"  # the page of past changes, found by its name only
MAX_TEXT = 100  # columns of running text
MAX_LINES = 12  # of passages found, in lines of a terminal
LEAST_SHOWN, LEAST_NAMED = 0.7, 0.5  # score of another passage relative to the best
MAX_ELSEWHERE = 3  # pages and materials listed
LIKELY = 0.75  # least similarity of a misspelt word


class Section(NamedTuple):
    """A section of a page: a heading of the second rank with its text, or the text before the first heading."""

    page: str
    heading: str
    text: str  # Markdown, with the heading


class Passage(NamedTuple):
    """A paragraph, an item of a list, or a row of a table."""

    section: Section
    text: str  # Markdown
    head: str  # the header of its table
    is_first: bool  # in its section: it answers the heading

    @property
    def fields(self) -> list[Field]:
        """The weighted texts by which it is found: its bold words, those of its section, and its whole text."""
        page, heading, _ = self.section
        bold = " ".join(re.findall(r"\*\*(.+?)\*\*", self.text))
        of_field = FIELD_TERMS.get((page, heading), "")
        return [(3.0, bold), (3.0 if self.is_first else 1.5, f"{page} {heading}"), (1.5, of_field), (1.0, self.text)]


def topics() -> tuple[str, ...]:
    """Return the topics of the manual."""
    names = sorted(os.listdir(_FOLDER))
    return tuple(name.removesuffix(_ENDING) for name in names if name.endswith(_ENDING))


def page(topic: str) -> str:
    """Return the page of a topic as Markdown."""
    with open(os.path.join(_FOLDER, topic + _ENDING), encoding="utf-8") as file:
        return _IMAGE.sub("", file.read())


def sections() -> list[Section]:
    """Return the sections of all pages."""
    every = []
    for topic in topics():
        for piece in re.split(r"^(?=## )", page(topic), flags=re.MULTILINE):
            every.append(Section(topic, piece.partition("\n")[0].lstrip("# "), piece))
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
    """Iterate over the passages of all pages, without the output of programs."""
    for section in sections():
        body = section.text.partition("\n")[2]
        prose = re.sub(r"^```.*?^```", "", body, flags=re.DOTALL | re.MULTILINE).strip()
        for number, block in enumerate(re.split(r"\n\s*\n|\n(?=- |\d+\. )", prose)):
            if block.startswith("|"):
                head, line, *rows = block.split("\n")
                yield from (Passage(section, row, f"{head}\n{line}\n", number == 0) for row in rows)
            elif block:  # without the sentence that introduces an example
                text = re.sub(r"(?<=\. )[^.]*:$", "", block).strip().removesuffix(":")
                yield Passage(section, text, "", number == 0)


def section_meant(text: str) -> Section | None:
    """Return a section by its short name, or the only one of a page with some words in its heading."""
    page, _, words = text.partition(" ")
    sought = {*words_in(words)}
    meant = []
    for section in sections():
        has_words = section.page == page and sought and sought <= {*words_in(section.heading)}
        if has_words or (section.page, section.heading) == SECTIONS.get(text):
            meant.append(section)
    return meant[0] if len(meant) == 1 else None


class Hits(NamedTuple):
    """The results of a search, the best first."""

    passages: Sequence[Passage]  # one, or two of about the same score
    pages: Sequence[str]  # pages with the words
    quantities: Sequence[str]
    materials: Sequence[str]


def hits_of(text: str, materials: Iterable[Material]) -> Hits:
    """Return the results of a search; raise BadRequest for a word that occurs nowhere."""
    words = words_sought(text)
    if not words:
        raise BadRequest(f"{quoted(text, 40)} has no word to search for; {_LISTS}")
    read = (passage for passage in passages() if passage.section.page != HISTORY or HISTORY in words)
    of_manual = Search(read, lambda passage: passage.fields)
    of_quantities = Search(NOMENCLATURE, _fields_of_quantity)
    of_materials = Search(materials, _fields_of_material)
    searches = of_manual, of_quantities, of_materials
    unknown = [word for word in words if not any(search.knows(word) for search in searches)]
    if unknown:
        raise _unknown_word(unknown[0], {*topics()}.union(*(search.vocabulary for search in searches)))
    found = of_manual.ranked(words)
    best = [each.thing for each in found[:2] if each.score >= LEAST_SHOWN * found[0].score]
    named = (each.thing.section.page for each in found if each.score >= LEAST_NAMED * found[0].score)
    return Hits(
        best,
        [*dict.fromkeys(named)],
        _with_synonym(text, [each.thing for each in of_quantities.ranked(words) if each.has_all]),
        [each.thing.name for each in of_materials.ranked(words) if each.has_all],
    )


_LISTS = "jkroll guide lists the pages, jkroll quantities the quantities"


def _unknown_word(word: str, known: Iterable[str]) -> BadRequest:
    """Return the error for a word that occurs in no page, quantity or material."""
    guess = closest(word, sorted(known), LIKELY)
    remedy = f"did you mean {guess}?" if guess else "leave it out, or"
    return BadRequest(f"nothing has the word {quoted(word, 40)}; {remedy} {_LISTS}")


def materials_with(text: str, materials: Iterable[Material]) -> list[Material]:
    """Return the materials with all words of a text in their names, states or sets, in their order."""
    every = [*materials]
    found = {each.thing for each in Search(every, _fields_of_material).ranked(words_sought(text)) if each.has_all}
    return [material for material in every if material in found]


def quantities_meant(words: Sequence[str]) -> list[str]:
    """Return the quantities that words mean: all without words, one by name or symbol, or a comma-separated list."""
    if not words:
        return list(NOMENCLATURE)
    several = [named(word.strip()) for word in " ".join(words).split(",")]
    if len(several) > 1 and NOMENCLATURE.keys() >= {*several}:
        return [*dict.fromkeys(several)]
    text = "_".join(" ".join(words).split())
    return [named(text)] if named(text) in NOMENCLATURE else with_symbol(text)


def _with_synonym(text: str, names: Sequence[str]) -> list[str]:
    """Return the quantity with this synonym, then those found: variants last, or left out with their quantity."""
    meant = QUANTITY_SYNONYMS.get("_".join(text.split()).casefold())
    ordered = sorted(names, key=lambda name: bool(NOMENCLATURE[name].variant_of))
    return without_variants([*dict.fromkeys([meant, *ordered] if meant else ordered)])


def without_variants(names: Collection[str]) -> list[str]:
    """Return names without the variants of quantities that are among them."""
    return [name for name in names if NOMENCLATURE[name].variant_of not in names]


def _fields_of_quantity(name: str) -> list[Field]:
    quantity, others = NOMENCLATURE[name], WORDS_OF_OTHERS.get(name, Words())
    called = f"{name} {quantity.symbol} {quantity.option}"
    return [(3.0, called), (1.0, quantity.sentence), (1.0, f"{others.certain} {others.likely}")]


def _fields_of_material(material: Material) -> list[Field]:
    return [(3.0, " ".join((material.name, *material.aliases))), (1.0, f"{material.state} {material.title}")]


def write_hits(text: str, hits: Hits, out: TextIO) -> None:
    """Write the passages found, the second only if both are short, and other places with the words."""
    lines = sum(len(wrapped(passage.text, terminal_width())) for passage in hits.passages)
    shown = hits.passages if lines <= MAX_LINES else hits.passages[:1]
    for (section, head), group in groupby(shown, key=lambda passage: (passage.section, passage.head)):
        write_text(head + "\n".join(passage.text for passage in group) + "\n", out)
        of_section = f", {section.heading}" if section.text.startswith("## ") else ""
        say_wrapped(f"from the page {section.page}{of_section}: jkroll guide {section.page}", out)
    others = [page for page in hits.pages if page not in {passage.section.page for passage in shown}]
    elsewhere = [f"jkroll guide {page}" for page in others[:MAX_ELSEWHERE]]
    if hits.quantities:
        elsewhere.append(f"jkroll quantities {' '.join(words_sought(text))}")
    if hits.materials:
        elsewhere.append(f"jkroll materials {','.join(hits.materials[:MAX_ELSEWHERE])}")
    if elsewhere:
        say_wrapped(f"{'also' if shown else 'see'}: {', '.join(elsewhere)}", out)
