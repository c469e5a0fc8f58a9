"""The manual: pages of Markdown, set by rich on a terminal, and as they are in a pipe."""

import os
import re
from collections.abc import Mapping
from typing import NamedTuple, TextIO

from ..text import fitting, say

_FOLDER = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "guide")
_ENDING = ".md"

# Words of the field by which a section is sought, besides those of its heading.
FIELD_TERMS: Mapping[tuple[str, str], str] = {
    ("dem", "Other programs, and damping"): "dissipation viscous coefficient of restitution",
    ("dem", "What other codes call γ"): "cohesion energy density",
    ("energies", "Energies by convention"): "E_break E_roll stickiness sticking bouncing coefficient of restitution",
    ("measurements", "Rough and humid"): (
        "roughness asperities capillary meniscus humidity moisture water liquid wetting contact angle"
    ),
    ("models", "Between JKR and DMT"): "tabor parameter maugis law",
    ("tables", "Sweeps"): "mixture of sizes pairs and a wall lists ranges",
    ("validation", "Measurements"): "stickiness sticking bouncing coefficient of restitution",
}


HISTORY = "changes"  # the page of what was, which is found where no other is


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
    """Write Markdown."""
    if out.isatty():
        from .markdown import write_markdown

        write_markdown(text, out)
    else:
        out.write(fitting(text, out))


def write_topics(out: TextIO) -> None:
    """Write the topics, each with the title of its page."""
    names = topics()
    width = max(map(len, names))
    for topic in names:
        title = page(topic).partition("\n")[0].removeprefix("# ")
        say(f"{topic:{width}}  {title}", out)
