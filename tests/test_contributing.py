"""The page for contributors: a copy of the source with the changes on the page must answer as the page shows.

`python tests/test_contributing.py` renews the output in the page; read it before you commit it.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from itertools import chain
from pathlib import Path

import pytest

from transcripts import TERMINAL, commands, transcripts

ROOT = Path(__file__).resolve().parents[1]
CONTRIBUTING = ROOT / ".github/CONTRIBUTING.md"
PAGE = CONTRIBUTING.read_text(encoding="utf-8")
SECTIONS = {
    title: text for title, text in re.findall(r"^## (.*)\n((?:(?!## ).*\n)*)", PAGE, re.MULTILINE) if "```diff" in text
}
COUNTED = {1: "one place", 2: "two places", 3: "three places"}
# Tests that require something of a new entry, and tests in them to leave out, since they list all laws or materials.
ASK = ("tests/physics/test_accuracy.py", "tests/model/test_laws.py", "tests/materials", "tests/test_architecture.py")
LIST_ALL = ("test_an_inferred_value_is_also_given_by_the_other_laws", "test_shipped_materials_form_five_sets")
TRANSCRIBE = "import sys; from transcripts import transcript; print(''.join(map(transcript, sys.argv[1:])), end='')"


def changes(section: str) -> list[tuple[str, str, str]]:
    """Return the changes in a section: the file, the lines before, and the lines after."""
    found = []
    for block in re.findall(r"```diff\n(.*?)```", section, re.DOTALL):
        for path, hunks in re.findall(r"^\+\+\+ (\S+)\n((?:(?!\+\+\+ ).*\n)*)", block, re.MULTILINE):
            for hunk in hunks.split("@@\n")[1:]:
                lines = hunk.splitlines(keepends=True)
                before = "".join(line[1:] for line in lines if line[0] in " -")
                after = "".join(line[1:] for line in lines if line[0] in " +")
                found.append((path, before, after))
    return found


def copy_with(folder: Path, *sections: str, only: str = "") -> Path:
    """Return a copy of this checkout with the changes of sections; `only`: the folder in which changes are made."""
    copy = folder / "copy"
    for name in ("src", "tests"):
        shutil.copytree(ROOT / name, copy / name, ignore=shutil.ignore_patterns("__pycache__"))
    for name in ("materials.toml", "pyproject.toml", "README.md", "LICENSE", ".github"):
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, copy / name)
        else:
            shutil.copy(ROOT / name, copy / name)
    for path, before, after in chain.from_iterable(changes(SECTIONS[section]) for section in sections):
        if not path.startswith(only):
            continue
        text = (copy / path).read_text(encoding="utf-8")
        assert text.count(before) == 1, f"CONTRIBUTING.md changes lines that {path} does not have once:\n{before}"
        (copy / path).write_text(text.replace(before, after), encoding="utf-8")
    return copy


def environment(copy: Path) -> dict[str, str]:
    """Return the environment in which the copy runs instead of this checkout."""
    return {**os.environ, "PYTHONPATH": os.pathsep.join([str(copy / "src"), str(copy / "tests")])}


def transcript(copy: Path, block: str) -> str:
    """Return a console block of the page with the output of a copy."""
    ran = subprocess.run(
        [sys.executable, "-c", TRANSCRIBE, *commands(block)],
        env=environment(copy), capture_output=True, text=True, encoding="utf-8", check=True,
    )  # fmt: skip
    return ran.stdout


@pytest.mark.parametrize("title", SECTIONS)
def test_the_shown_changes_give_the_shown_output(tmp_path: Path, title: str) -> None:
    copy = copy_with(tmp_path, title)
    places = {path for path, _, _ in changes(SECTIONS[title]) if not path.startswith("tests/")}
    assert title.endswith(f": {COUNTED[len(places)]}")
    for block in transcripts(SECTIONS[title]):
        assert block == transcript(copy, block)


def test_the_page_has_the_list_of_missing_parts_of_a_new_quantity(tmp_path: Path) -> None:
    title = "A quantity: three places"
    copy = copy_with(tmp_path, title, only="src/")
    words = ["tests/tools/missing.py", "contact_circumference"]
    ran = subprocess.run([sys.executable, *words], cwd=copy, env=environment(copy), capture_output=True, text=True)
    assert (ran.returncode, ran.stderr) == (1, "")
    assert f"```\n{ran.stdout}```\n" in SECTIONS[title]


def test_the_page_adds_a_material_a_quantity_an_option_and_a_law() -> None:
    assert [title.partition(":")[0] for title in SECTIONS] == ["A material", "A quantity", "An option", "A law"]


@pytest.mark.slow
def test_the_tests_pass_with_all_changes_at_once(tmp_path: Path) -> None:
    copy = copy_with(tmp_path, *SECTIONS)
    others = " and ".join(f"not {name}" for name in LIST_ALL)
    words = ["-m", "pytest", "-q", "-n", "0", "-k", others, *ASK]
    ran = subprocess.run([sys.executable, *words], cwd=copy, env=environment(copy), capture_output=True, text=True)
    assert ran.returncode == 0, ran.stdout


if __name__ == "__main__":
    os.environ |= TERMINAL
    text = PAGE
    for title, section in SECTIONS.items():
        with tempfile.TemporaryDirectory() as folder:
            copy = copy_with(Path(folder), title)
            for block in transcripts(section):
                text = text.replace(block, transcript(copy, block))
    CONTRIBUTING.write_text(text, encoding="utf-8")
