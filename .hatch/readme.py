"""The README for a page elsewhere, such as that of a package index: its links and its picture have whole addresses."""

import re


def absolute(text: str, address: str, tag: str) -> str:
    """Return Markdown whose relative links lead to a tag of the repository at an address."""
    text = re.sub(r"!\[([^]]*)\]\((?!https?:)([^)#]+)\)", rf"![\1]({address}/raw/{tag}/\2)", text)
    return re.sub(r"(?<!!)\[([^]]*)\]\((?!https?:|#)([^)]+)\)", rf"[\1]({address}/blob/{tag}/\2)", text)
