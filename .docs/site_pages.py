"""The parts of the site besides the pages of the manual: generated pages, a gallery, and the prompt."""

import io
import json
import re
import sys
import tempfile
import tomllib
from collections.abc import Iterator
from contextlib import redirect_stdout
from html import escape
from pathlib import Path
from typing import Any

from markdown import Extension, Markdown
from mkdocs.structure.files import File, Files

from jkroll import __version__
from jkroll.cli.process import main
from jkroll.materials.library import known_materials
from jkroll.text import capital

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE), str(HERE / "prompt")]
from explorer_page import explorer  # noqa: E402
from page_meta import described, with_card, with_policy  # noqa: E402
from prompt_files import put_prompt  # noqa: E402
from prose import with_formulas  # noqa: E402
from python_pages import notebook, reference  # noqa: E402
from quantity_pages import equations, quantities, with_links  # noqa: E402

CHECKOUT = HERE.parent
PYTHON = CHECKOUT / "src" / "jkroll" / "guide" / "python.md"
FIGURES = ("2", "3a", "3b", "3c", "3d", "6a", "6b", "8", "9", "laws", "geometry")
MAPS = {
    "Pull-off force of quartz": "map pull-off quartz --x radius=1nm:1mm --y gamma=1mJ/m2:10J/m2 --mark quartz@100nm",
    "Frequencies": "map frequencies quartz,iron --x radius=10nm:1um --mark quartz@100nm",
    "A contact under load": "contact quartz 100nm --curve",
}
# The weights of pages in the search, which by default prefers the beginnings of pages.
BOOSTS = {
    "words": 4,
    "all-quantities": 3,
    "contact-angle": 2,
    "equations": 0.3,
    "accuracy": 0.3,
    "reference": 0.3,
    "changes": 0.1,
}
GALLERY = {f"Figure {number}": f"figure {number}" for number in FIGURES} | MAPS  # command lines by title


class InLines(Extension):
    """Keep MathML in lines of text; Python-Markdown would make each formula a block."""

    def extendMarkdown(self, md: Markdown) -> None:  # noqa: N802
        """Remove MathML from the elements that are blocks."""
        md.block_level_elements.remove("math")


def on_config(config: Any) -> Any:
    """Let formulas stand in lines of text."""
    config.markdown_extensions.append(InLines())
    return config


def on_files(files: Files, config: Any) -> Files:
    """Add the generated pages and the pictures, so that mkdocs checks the links to them."""
    content: dict[str, str | bytes] = {
        "index.md": explore(),
        "start.md": start(),
        "get.md": get(),
        "try.md": "# Try it\n\n<iframe class=prompt src=../prompt/ title='a prompt that runs jkroll'></iframe>\n",
        "all-quantities.md": quantities(),
        "equations.md": equations(),
        "all-materials.md": materials(),
        "reference.md": reference(),
        "python.ipynb": json.dumps(notebook(PYTHON.read_text(encoding="utf-8"))),
        "favicon.svg": (HERE / "favicon.svg").read_bytes(),
        "gallery.md": gallery(),
        **{name: (HERE / name).read_text(encoding="utf-8") for name in ("run.js", "run.css")},
        **{name: (HERE / "explorer" / name).read_text(encoding="utf-8") for name in ("explorer.js", "explorer.css")},
        "gallery/contact.svg": (CHECKOUT / "tests" / "data" / "contact.svg").read_bytes(),
        **dict(pictures()),
    }
    for path, text in content.items():
        files.append(File.generated(config, path, content=text))
    return files


def explore() -> str:
    """Return the first page: a line of introduction, and the explorer."""
    head = "---\nhide: [navigation, toc]\n---\n\n# Two elastic spheres touch and stick\n\n"
    words = (
        "See what pulls them apart, rolls them and shakes them, each with its best range and the reason for it. "
        "Drag a slider, or [read how to start](start.md).\n\n"
    )
    files = '<link rel="stylesheet" href="explorer.css"><script type="module" src="explorer.js"></script>\n\n'
    return head + words + files + explorer()


def start() -> str:
    """Return the README, with its links adapted to the site."""
    text = (CHECKOUT / "README.md").read_text(encoding="utf-8")
    text = text.replace("](tests/data/contact.svg)", "](gallery/contact.svg)")
    text = re.sub(r"\]\(src/jkroll/guide/?([^)]*)\)", lambda match: f"]({match[1] or 'commands.md'})", text)
    return re.sub(r"\[([^]]*)\]\(\.github/[^)]*\)", r"\1", text)


def get() -> str:
    """Return the page on how to get the program: installation, repository, citation, licence."""
    project = tomllib.loads((CHECKOUT / "pyproject.toml").read_text(encoding="utf-8"))
    address = project["tool"]["hatch"]["metadata"]["hooks"]["custom"]["address"]
    wheel = f"jkroll-{__version__}-py3-none-any.whl"
    source = (
        f"The source code is at [{address}]({address}), and so is the place for questions and wrong numbers."
        if address
        else "The source code has no public address yet; the file above has all of the program, as plain Python."
    )
    parts = {
        "Install": f"You need Python {project['project']['requires-python'].removeprefix('>=')} or later and "
        f'<a href="../prompt/python/{wheel}">{wheel}</a>, which runs on this site, too. In the folder of this file:\n\n'
        f"```sh\npython3 -m venv .venv\n.venv/bin/pip install ./{wheel}\n.venv/bin/jkroll report quartz 100nm\n```\n\n"
        f"`'./{wheel}[plot]'` adds pictures in files. To install from the source code, see "
        "[the start](start.md#thirty-seconds-to-the-first-number); [the prompt](try.md) needs no installation.",
        "The repository": source,
        "Cite": "Cite the program and the sources of what you used: each command prints them with `--cite`.\n\n"
        f"```bibtex\n{printed('pull-off quartz 100nm --cite')}```",
        "Licence": f"```text\n{(CHECKOUT / 'LICENSE').read_text(encoding='utf-8')}```",
    }
    return "# Get it\n\n" + "\n\n".join(f"## {title}\n\n{text}" for title, text in parts.items()) + "\n"


def materials() -> str:
    """Return the sheets of all materials."""
    sheets = (f"## {name}\n\n```text\n{printed(f'materials {name}')}```\n" for name in known_materials().materials)
    return "# All materials\n\n" + "\n".join(sheets)


def on_page_markdown(markdown: str, page: Any, config: Any, files: Files) -> str:  # noqa: ARG001
    """Describe a page by its first paragraph; make links of `jkroll guide X` and of quantities; typeset formulas."""
    page.meta.setdefault("description", escape(described(markdown)))
    name = Path(page.file.src_uri).stem
    page.meta["search"] = {"boost": BOOSTS.get(name, 1)}
    markdown = with_headings(markdown) if name == "words" else markdown
    known = {path.stem for path in (CHECKOUT / "src" / "jkroll" / "guide").glob("*.md")}

    def linked(match: re.Match[str]) -> str:
        return f"[{match[0]}]({match[1]}.md)" if match[1] in known else match[0]

    parts = re.split(r"(^```.*?^```\s*?$)", markdown, flags=re.MULTILINE | re.DOTALL)  # blocks of code stay unchanged
    for place, part in enumerate(parts):
        if not part.startswith("```"):
            prose = re.sub(r"(?<!\[)`jkroll guide ([a-z-]+)`(?!\])", linked, with_links(part))
            parts[place] = "\n".join(map(with_formulas, prose.split("\n")))
    return "".join(parts)


def on_page_content(html: str, page: Any, config: Any, files: Files) -> str:  # noqa: ARG001
    """Keep each option on one line, which could otherwise break after a hyphen."""
    return re.sub(r"<code>(--[^<]{1,28})</code>", r'<code class="option">\1</code>', html)


def with_headings(markdown: str) -> str:
    """Return the page of words with a heading for each word, so that the search finds it and links can lead to it."""

    def headed(item: re.Match[str]) -> str:
        return f"### {item[1].replace('**', '')}\n\n{capital(item[2])}\n"

    one_a_line = re.sub(r"\. (?=\*\*)", ".\n- ", re.sub(r"\n  (?=\S)", " ", markdown))
    return re.sub(r"^- (\*\*.*?): (.*)$", headed, one_a_line, flags=re.MULTILINE)


def on_post_page(output: str, page: Any, config: Any) -> str:  # noqa: ARG001
    """Put the title, the description and the policy of a page into its head."""
    return with_policy(with_card(output, page))


def on_post_template(output_content: str, template_name: str, config: Any) -> str:  # noqa: ARG001
    """Put the policy into the page for missing addresses, too."""
    return with_policy(output_content) if template_name.endswith(".html") else output_content


def gallery() -> str:
    """Return a page of the figures of the paper and some maps, each below the command that draws it."""
    shown = (
        f"## {title}\n\n```console\n$ jkroll {line}\n```\n\n[![{title}](gallery/{number}.svg)](gallery/{number}.svg)\n"
        for number, (title, line) in enumerate(GALLERY.items())
    )
    return "# Gallery\n\nThe figures of the paper as this program draws them, and maps.\n\n" + "\n".join(shown)


def pictures() -> Iterator[tuple[str, bytes]]:
    """Draw the pictures of the gallery; iterate over the path and the content of each."""
    with tempfile.TemporaryDirectory() as folder:
        picture = Path(folder, "picture.svg")
        for number, line in enumerate(GALLERY.values()):
            printed(f"{line} --quiet -o {picture}")
            yield f"gallery/{number}.svg", picture.read_bytes()


def printed(line: str) -> str:
    """Return the output of a command in a pipe."""
    stream = io.StringIO()
    with redirect_stdout(stream):
        if main(line.split()):
            raise SystemExit(f"jkroll {line} failed")
    return stream.getvalue()


def on_post_build(config: Any) -> None:
    """Add the prompt to the site, and for language models the manual as Markdown with a list of its pages."""
    site = Path(config["site_dir"])
    put_prompt(site / "prompt")
    lines = ["# jkroll", "", f"> {config['site_description']}", "", "## Manual", ""]
    for path in sorted((CHECKOUT / "src" / "jkroll" / "guide").glob("*.md")):
        text = path.read_text(encoding="utf-8")
        (site / path.name).write_text(text, encoding="utf-8")
        title = text.partition("\n")[0].removeprefix("# ")
        lines.append(f"- [{title}]({path.name}): {described(text)}")
    (site / "llms.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")
