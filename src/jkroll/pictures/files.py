"""Write pages into files with their metadata; SVG files keep text as text, and embed the letters they use."""

import re
from base64 import b64encode
from collections.abc import Iterable
from functools import cache
from io import BytesIO
from typing import Any, NamedTuple
from xml.sax.saxutils import escape, unescape

from fontTools import subset, ttLib  # type: ignore[import-not-found,unused-ignore,import-untyped]
from matplotlib import font_manager  # type: ignore[import-not-found,unused-ignore]

from .. import __version__
from ..text import NO_BREAK_SPACE

FONT = "STIXGeneral"
_OTHERS = "'STIX Two Text', 'Times New Roman', Times, serif"  # for programs that ignore the embedded font
_PROGRAM = f"jkroll {__version__}"
_TEXT = re.compile(r"<text>\s*((?:<tspan [^>]*>[^<]*</tspan>\s*)+)</text>")
_SPAN = re.compile(r'<tspan x="([^"]*)" y="([^"]*)" style="([^"]*)">([^<]*)</tspan>')
_SIZE = re.compile(r"font-size: ([\d.]+)px")
_FAMILY = re.compile(rf" ?font-family: '{FONT}'")
# Matplotlib's tile of a hatch, of 72 points, if its path has curves (C), as dots have.
_DOTS = re.compile(
    r'(<pattern [^>]*width=")72(" height=")72(">\s*<rect [^>]*/>\s*<path d=")([^"]*C[^"]*)(")', re.DOTALL
)
_LARGEST_GAP = 0.02  # between adjacent letters, over their size
_TILE = 6  # period of the dots of a hatch, in points


class _Run(NamedTuple):
    """Adjacent letters of one style, from `x` to `end`, at the height `y`."""

    x: float
    y: str
    style: str
    text: str
    end: float


class About(NamedTuple):
    """The metadata of a file."""

    title: str
    description: str
    command: str  # the command that drew the picture; empty if Python code drew it

    def fields(self, file_format: str) -> dict[str, Any]:
        """Return the metadata fields of a format, without a date: the same picture gives the same bytes."""
        made_by = ", ".join(filter(None, (_PROGRAM, self.command)))
        if file_format == "svg":
            return {"Title": self.title, "Description": self.description, "Source": made_by, "Creator": _PROGRAM,
                "Date": None}  # fmt: skip
        if file_format == "pdf":
            return {"Title": self.title, "Subject": self.description, "Keywords": made_by, "Creator": _PROGRAM,
                "CreationDate": None}  # fmt: skip
        return {"Title": self.title, "Description": self.description, "Source": made_by, "Software": _PROGRAM}


def content_of(figure: Any, file_format: str, about: About, **layout: Any) -> bytes:
    """Return a matplotlib figure as the content of an SVG, PDF or PNG file."""
    buffer = BytesIO()
    figure.savefig(buffer, format=file_format, metadata=about.fields(file_format), **layout)
    if file_format != "svg":
        return buffer.getvalue()
    return _readable(buffer.getvalue().decode(), about).encode()


def _readable(svg: str, about: About) -> str:
    """Return an SVG with joined letters, a description, an embedded font, and small tiles of hatches."""
    svg = re.sub(r"\s*<!--.*?-->", "", svg, flags=re.DOTALL)
    svg = _TEXT.sub(lambda match: f"<text>{_joined(match[1])}</text>", svg)
    svg = _DOTS.sub(lambda match: f"{match[1]}{_TILE}{match[2]}{_TILE}{match[3]}{_tile(match[4])}{match[5]}", svg)
    fonts = "".join(_face(style, letters) for style, letters in _letters(svg).items())
    rules = f"{fonts}text{{font-family: '{FONT}', {_OTHERS}; white-space: pre}}"
    svg = _FAMILY.sub("", svg).replace('<style type="text/css">', f'<style type="text/css">{rules}', 1)
    described = f"<desc>{escape(about.description)}</desc>\n <metadata>"
    return svg.replace("<metadata>", described, 1).replace(' version="1.1">', ' version="1.1" role="img">', 1)


def _joined(spans: str) -> str:
    """Return the spans of a text with adjacent letters of one style joined into one span."""
    letters = []
    for x_as_text, y, style, text in _SPAN.findall(spans):
        letters.append((float(x_as_text), y, style, unescape(text).replace(NO_BREAK_SPACE, " ")))
    runs: list[_Run] = []
    for x, y, style, text in sorted(letters, key=lambda letter: letter[0]):
        size = float(_SIZE.findall(style)[0])
        end = x + _advance(text, "italic" if "italic" in style else "normal", size)
        last = runs[-1] if runs else None
        if last is not None and (last.y, last.style) == (y, style) and abs(x - last.end) < _LARGEST_GAP * size:
            runs[-1] = last._replace(text=last.text + text, end=end)
        else:
            runs.append(_Run(x, y, style, text, end))
    return "".join(
        f'<tspan x="{run.x:g}" y="{float(run.y):g}" style="{run.style}">{escape(run.text)}</tspan>' for run in runs
    )


def _advance(text: str, style: str, size: float) -> float:
    """Return the width of a text in letters of a style and a size."""
    font: Any = font_manager.get_font(_path_of(style))
    font.set_size(size, 72)
    return float(sum(font.load_char(ord(letter)).linearHoriAdvance / 65536 for letter in text))


@cache
def _path_of(style: Any) -> str:
    return str(font_manager.findfont(font_manager.FontProperties(family=FONT, style=style)))


def _letters(svg: str) -> dict[str, set[str]]:
    """Return the letters that an SVG has in `FONT`, by their style."""
    letters: dict[str, set[str]] = {}
    for style, text in re.findall(r'<t(?:ext|span)[^>]* style="([^"]*)"[^>]*>([^<]+)<', svg):
        if _FAMILY.search(style):
            letters.setdefault("italic" if "italic" in style else "normal", set()).update(unescape(text))
    return dict(sorted(letters.items()))


def _face(style: str, letters: Iterable[str]) -> str:
    """Return a rule of a style sheet that embeds the font, reduced to some letters."""
    options = subset.Options(hinting=False, layout_features=[], notdef_outline=True, name_IDs=[])
    options.drop_tables += ["FFTM", "GDEF", "GPOS", "GSUB"]
    font = ttLib.TTFont(_path_of(style), recalcTimestamp=False)
    reduced = subset.Subsetter(options)
    reduced.populate(unicodes=[*map(ord, letters)])
    reduced.subset(font)
    buffer = BytesIO()
    font.save(buffer)
    source = f"url(data:font/ttf;base64,{b64encode(buffer.getvalue()).decode()})"
    return f"@font-face{{font-family: '{FONT}'; font-style: {style}; src: {source}}}\n"


def _tile(path: str) -> str:
    """Return the dots of a hatch that one tile needs."""
    room = _TILE + 1.0
    near = []
    for dot in re.finditer(r"M ([-\d.]+) ([-\d.]+)[^M]*", path):
        if -1 < float(dot[1]) < room and -1 < float(dot[2]) < room:
            near.append(dot[0])
    return "".join(near)
