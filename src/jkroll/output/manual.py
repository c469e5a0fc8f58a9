"""The manual: pages of Markdown, set by rich on a terminal; and the search of it, the quantities and the materials."""

import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import ClassVar, NamedTuple, TextIO

from ..errors import BadRequest
from ..materials.library import Material
from ..quantities.nomenclature import NOMENCLATURE, named, with_symbol
from ..quantities.synonyms import QUANTITY_SYNONYMS
from ..text import LETTERS, closest, first_of, quoted, say, say_wrapped, terminal_width

_FOLDER = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "guide")
_ENDING = ".md"

# Words of the field by which a section is sought, besides those of its heading.
FIELD_TERMS: Mapping[tuple[str, str], str] = {
    ("dem", "Other programs, and damping"): "dissipation viscous coefficient of restitution",
    ("dem", "What other codes call γ"): "cohesion energy density",
    ("energies", "Energies by convention"): "E_break E_roll stickiness sticking bouncing rebound restitution",
    ("energies", "Aggregates"): "agglomerates clusters fractal",
    ("measurements", "Rough and humid"): (
        "roughness asperities capillary meniscus humidity moisture water liquid wetting contact angle"
    ),
    ("models", "Limits"): "doubts codes",
    ("models", "Between JKR and DMT"): "tabor parameter maugis law",
    ("models", "Sliding, twisting, peeling"): "friction detachment resuspension",
    ("tables", "Sweeps"): "mixture of sizes pairs and a wall lists ranges",
    ("validation", "Measurements"): "stickiness sticking bouncing rebound coefficient of restitution detachment",
}

MAX_NAMED = 6  # quantities and materials in a list of what was found
MAX_TEXT = 100  # columns of running text
HISTORY = "changes"  # the page of what was, which is sought by its name alone


class Section(NamedTuple):
    """A section of a page: what stands under a heading of the second rank, or before the first of them."""

    page: str
    heading: str
    text: str  # Markdown, with the heading

    @property
    def title(self) -> str:
        """The words by which it is sought: page, heading and the terms of the field."""
        return f"{self.page} {self.heading} {FIELD_TERMS.get((self.page, self.heading), '')}"

    @property
    def prose(self) -> str:
        """The text without what programs print."""
        return re.sub(r"^```.*?^```", "", self.text, flags=re.DOTALL | re.MULTILINE)


def topics() -> tuple[str, ...]:
    """Return the topics of the manual."""
    names = sorted(os.listdir(_FOLDER))
    return tuple(name.removesuffix(_ENDING) for name in names if name.endswith(_ENDING))


def page(topic: str) -> str:
    """Return the page of a topic as Markdown."""
    with open(os.path.join(_FOLDER, topic + _ENDING), encoding="utf-8") as file:
        return file.read()


def sections() -> list[Section]:
    """Return the sections of all pages."""
    pieces = ((topic, piece) for topic in topics() for piece in re.split(r"^(?=## )", page(topic), flags=re.MULTILINE))
    return [Section(topic, piece.partition("\n")[0].lstrip("# "), piece) for topic, piece in pieces]


def write_text(text: str, out: TextIO) -> None:
    """Write Markdown: in a pipe as it is, on a terminal in lines that are comfortable to read."""
    if not out.isatty():
        out.write(text)
        return
    from rich.console import Console
    from rich.markdown import CodeBlock, Markdown
    from rich.text import Text

    class Lines(CodeBlock):
        """A code block whose lines are left as they are, for the terminal to break where they are too long."""

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


class Hits(NamedTuple):
    """Sections, quantities and materials that have all words that are sought, each as the beginning of a word."""

    sections: Sequence[Section]
    quantities: Sequence[str]
    materials: Sequence[str]


def hits_of(words: Sequence[str], materials: Iterable[Material]) -> Hits:
    """Return what has all of some words: of the sections those that have them in their titles, if there are any."""
    begun = words_of(words)
    if not begun:
        return Hits([], [], [])
    every = [section for section in sections() if section.page != HISTORY or HISTORY in begun]
    titled = [section for section in every if has_words(section.title, begun)]
    return Hits(
        titled or [section for section in every if has_words(f"{section.title} {section.prose}", begun)],
        _quantities_with(words),
        [material.name for material in materials_with(words, materials)],
    )


def materials_with(words: Sequence[str], materials: Iterable[Material]) -> list[Material]:
    """Return the materials that have all of some words in their names, states or sets."""
    begun = words_of(words)
    return [
        material
        for material in materials
        if begun and has_words(" ".join((material.name, *material.aliases, material.state, material.title)), begun)
    ]


def quantities_meant(words: Sequence[str]) -> list[str]:
    """Return the quantities that words stand for: all without words, one by name or symbol, or a list with commas."""
    if not words:
        return list(NOMENCLATURE)
    several = [named(word.strip()) for word in " ".join(words).split(",")]
    if len(several) > 1 and NOMENCLATURE.keys() >= {*several}:
        return [*dict.fromkeys(several)]
    text = "_".join(" ".join(words).split())
    return [named(text)] if named(text) in NOMENCLATURE else with_symbol(text)


def _quantities_with(words: Sequence[str]) -> list[str]:
    """Return the quantity that others call so, those with the words in their names, and those with them in meaning.

    Variants stand last, and only where their quantity is not found.
    """
    begun = words_of(words)
    names = [name for name in NOMENCLATURE if has_words(f"{_called(name)} {NOMENCLATURE[name].sentence}", begun)]
    names.sort(key=lambda name: (bool(NOMENCLATURE[name].variant_of), not has_words(_called(name), begun)))
    meant = QUANTITY_SYNONYMS.get("_".join(" ".join(words).split()).casefold())
    return without_variants([*dict.fromkeys([meant, *names] if meant else names)])


def without_variants(names: Sequence[str]) -> list[str]:
    """Return names without the variants of quantities that are among them."""
    return [name for name in names if NOMENCLATURE[name].variant_of not in names]


def _called(name: str) -> str:
    """Return the name, symbol and option of a quantity."""
    return f"{name} {NOMENCLATURE[name].symbol} {NOMENCLATURE[name].option}"


def words_of(texts: Iterable[str]) -> set[str]:
    """Return the words of texts, in lower case and without underscores and signs."""
    return set(re.findall(r"[^\W_]+", " ".join(texts).casefold()))


def has_words(text: str, begun: Iterable[str]) -> bool:
    """Return whether each of some texts begins a word of a text; the name of a Greek letter is the letter, too."""
    words = words_of([text])
    return all(any(word.startswith((piece, LETTERS.get(piece, piece))) for word in words) for piece in begun)


def write_hits(words: Sequence[str], hits: Hits, out: TextIO) -> None:
    """Write the section that was found, or a list of several, and the names of quantities and materials."""
    text = " ".join(words)
    if not any(hits):
        guess = closest(text, topics())
        meant = f"did you mean {guess}? " if guess else ""
        raise BadRequest(f"guide: nothing has the words {quoted(text, 40)}; {meant}jkroll guide lists the pages")
    if len(hits.sections) == 1:
        [section] = hits.sections
        write_text(section.text, out)
        say(f"from the page {section.page}: jkroll guide {section.page}", out)
    elif hits.sections:
        for section in hits.sections:
            say(f"{section.page:{max(map(len, topics()))}}  {section.heading}", out)
        say("jkroll guide PAGE shows a page; with words of a heading behind PAGE, a section", out)
    if hits.quantities:
        say(f"quantities: {first_of(hits.quantities, MAX_NAMED)}: jkroll quantities {text}", out)
    if hits.materials:
        say_wrapped(
            f"materials: {first_of(hits.materials, MAX_NAMED)}: jkroll materials {','.join(hits.materials)}", out
        )
