"""The data of a release: one version, one author, one title, and addresses that work on a package index."""

import json
import re
import subprocess
import tomllib
from pathlib import Path
from runpy import run_path

import pytest

from jkroll import __version__
from jkroll.write.manual import page

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
PROGRAM = tomllib.loads((ROOT / "src/jkroll/write/references.toml").read_text(encoding="utf-8"))["program"]
ZENODO = json.loads((ROOT / ".zenodo.json").read_text(encoding="utf-8"))


def test_the_newest_changes_are_those_of_this_version() -> None:
    assert re.findall(r"^## (.*)$", page("changes"), re.MULTILINE)[0] == __version__


def test_a_tag_has_the_name_of_the_version() -> None:
    ran = subprocess.run(["git", "tag", "--points-at", "HEAD", "v*"], cwd=ROOT, capture_output=True, text=True)
    assert {*ran.stdout.split()} <= {f"v{__version__}"}


def test_authors_title_year_and_licence_are_the_same_in_all_files() -> None:
    text = (ROOT / "LICENSE").read_text(encoding="utf-8")
    assert re.findall(r"^Copyright \(c\) (\d+) (.*)$", text, re.MULTILINE) == [
        (PROGRAM["year"], PROGRAM["author"].strip("{}"))
    ]
    assert PROJECT["authors"] == ZENODO["creators"] == [{"name": PROGRAM["author"].strip("{}")}]
    assert ZENODO["title"] == PROGRAM["title"]
    assert PROJECT["license"] == ZENODO["license"] == text.split()[0] == PROGRAM["note"].split()[0]
    assert PROJECT["keywords"] == ZENODO["keywords"]


def test_the_classifiers_name_the_pythons_of_the_page_promises() -> None:
    listed = re.findall(r"Python :: (3\.\d+)", " ".join(PROJECT["classifiers"]))
    tried = re.findall(r"^\| CPython ([^|]*?) *\|", page("promises"), re.MULTILINE)
    assert listed == sorted({*re.findall(r"3\.\d+", " ".join(tried))})


@pytest.mark.parametrize(
    ("text", "whole"),
    [
        ("[a](src/b.md) and ![c](d/e.svg)", "[a](A/blob/v1/src/b.md) and ![c](A/raw/v1/d/e.svg)"),
        ("[a](https://b.org) [c](#d)", "[a](https://b.org) [c](#d)"),
    ],
)
def test_links_of_the_readme_are_whole_on_a_package_index(text: str, whole: str) -> None:
    assert run_path(str(ROOT / ".hatch/readme.py"))["absolute"](text, "A", "v1") == whole
