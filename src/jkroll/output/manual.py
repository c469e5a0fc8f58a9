"""The manual: pages of Markdown, set by rich on a terminal, and as they are in a pipe."""

import os
from typing import TextIO

from ..errors import JkrollError
from ..text import closest, fitting, quoted, say

_FOLDER = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "guide")
_ENDING = ".md"


class UnknownTopic(JkrollError):
    """Error raised for a topic on which the manual has no page."""

    def __init__(self, topic: str) -> None:
        super().__init__(topic)
        self.topic = topic

    def __str__(self) -> str:
        guess = closest(self.topic, topics())
        meant = f"did you mean {guess}? " if guess else ""
        return f"guide: there is no page {quoted(self.topic, 40)}; {meant}there are {', '.join(topics())}"


def topics() -> tuple[str, ...]:
    """Return the topics of the manual."""
    names = sorted(os.listdir(_FOLDER))
    return tuple(name.removesuffix(_ENDING) for name in names if name.endswith(_ENDING))


def page(topic: str) -> str:
    """Return the page of a topic as Markdown, or raise UnknownTopic."""
    if topic not in topics():
        raise UnknownTopic(topic)
    with open(os.path.join(_FOLDER, topic + _ENDING), encoding="utf-8") as file:
        return file.read()


def write_page(topic: str, out: TextIO) -> None:
    """Write the page of a topic."""
    text = page(topic)
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
