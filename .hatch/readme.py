"""The README for the page of a package index: its links and its pictures become absolute."""

import re


def absolute(text: str, address: str, tag: str) -> str:
    """Return Markdown with its relative links made absolute: they lead to a tag of the repository at an address."""
    text = re.sub(r"!\[([^]]*)\]\((?!https?:)([^)#]+)\)", rf"![\1]({address}/raw/{tag}/\2)", text)
    return re.sub(r"(?<!!)\[([^]]*)\]\((?!https?:|#)([^)]+)\)", rf"[\1]({address}/blob/{tag}/\2)", text)
