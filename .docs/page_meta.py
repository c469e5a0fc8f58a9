"""The heads of the site's pages: a title and a description, and a policy against requests to other hosts."""

import re
from base64 import b64encode
from hashlib import sha256
from html import escape, unescape
from typing import Any

_NOT_PROSE = ("```", *"#<|-!>")  # how code, headings, HTML, tables, lists, pictures and quotations begin
_INLINE = re.compile(r"<script(?![^>]*(?:\bsrc=|application/json))[^>]*>(.*?)</script>", re.DOTALL)


def with_policy(html: str) -> str:
    """Return a page with a content security policy that allows its own files and, by their hashes, inline scripts."""
    digests = {b64encode(sha256(script.encode()).digest()).decode() for script in _INLINE.findall(html)}
    scripts = " ".join(["'self'", "'wasm-unsafe-eval'", *(f"'sha256-{digest}'" for digest in sorted(digests))])
    policy = (
        f"default-src 'self'; script-src {scripts}; style-src 'self' 'unsafe-inline'; img-src 'self' data:; "
        "object-src 'none'; base-uri 'self'"
    )
    tag = f'<meta http-equiv="Content-Security-Policy" content="{policy}">'
    return html.replace('<meta charset="utf-8">', f'<meta charset="utf-8">\n      {tag}', 1)


def with_card(html: str, page: Any) -> str:
    """Return a page with the title and the description that other sites show with a link to it."""
    title = escape(f"{page.title} – jkroll")
    texts = {"og:title": title, "og:description": page.meta["description"], "og:type": "article"}
    tags = "".join(f'<meta property="{name}" content="{text}">' for name, text in texts.items())
    return html.replace("</head>", f"{tags}</head>", 1)


def described(text: str) -> str:
    """Return the first paragraph of a page, without its marks, as a description of at most 160 characters."""
    blocks = (block.strip() for block in re.split(r"\n\s*\n", text))
    first = next((block for block in blocks if block and not block.startswith(_NOT_PROSE)), "")
    unmarked = re.sub(r"\[([^]]*)\]\([^)]*\)|[`*]|</?[a-z][^>]*>", r"\1", first)
    plain = unescape(re.sub(r"\s+", " ", unmarked))
    return plain if len(plain) <= 160 else plain[:157].rpartition(" ")[0] + " …"
