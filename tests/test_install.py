"""A release is built twice with identical bytes, and its wheel answers in an empty environment."""

import json
import os
import subprocess
import sys
import tarfile
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import pytest

from jkroll import __version__

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[1]
COMMANDS = ("pull-off", "yield-force", "r-min", "n-grav", "frequencies", "n-roll", "contact", "moment", "report")
SHIPPED = """
import sys
from jkroll.cli.process import main
assert main(["pull-off", "quartz", "100nm"]) == 0
assert "jkroll.materials.shipped" in sys.modules
assert "tomllib" not in sys.modules
from jkroll.materials import library, shipped
assert library.materials_in(library.SHIPPED) == shipped.MATERIALS
"""


class Built(NamedTuple):
    """The two files of a release."""

    source: Path
    wheel: Path

    def contents(self) -> list[bytes]:
        """Return the bytes of both files."""
        return [path.read_bytes() for path in self]


def environment(folder: Path, *requirements: str) -> Path:
    """Make a virtual environment with requirements; return its folder of programs."""
    subprocess.run([sys.executable, "-m", "venv", str(folder)], check=True)
    pip = [str(folder / "bin/python"), "-m", "pip", "--quiet", "--disable-pip-version-check"]
    subprocess.run([*pip, "install", *requirements], check=True)
    subprocess.run([*pip, "check"], check=True, stdout=subprocess.DEVNULL)
    return folder / "bin"


def build(tools: Path, checkout: Path, target: Path) -> Built:
    """Build the source distribution and the wheel of a checkout."""
    subprocess.run(
        [str(tools / "python"), "-m", "hatchling", "build", "-d", str(target)],
        check=True, cwd=checkout, env={**os.environ, "SOURCE_DATE_EPOCH": "1700000000"}, capture_output=True,
    )  # fmt: skip
    (source,), (wheel,) = target.glob("*.tar.gz"), target.glob("*.whl")
    return Built(source, wheel)


@pytest.fixture(scope="module")
def tools(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An environment with the tools to build a release, as pyproject.toml requires them, and to check it."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    return environment(tmp_path_factory.mktemp("tools"), *project["build-system"]["requires"], "twine")


@pytest.fixture(scope="module")
def built(tools: Path, tmp_path_factory: pytest.TempPathFactory) -> Built:
    """The release that is built from this checkout."""
    return build(tools, ROOT, tmp_path_factory.mktemp("built"))


def test_the_files_of_a_release_are_valid(tools: Path, built: Built) -> None:
    assert [path.name for path in built] == [f"jkroll-{__version__}.tar.gz", f"jkroll-{__version__}-py3-none-any.whl"]
    subprocess.run([str(tools / "twine"), "check", "--strict", *map(str, built)], check=True, capture_output=True)


def test_a_release_built_from_its_own_source_has_identical_bytes(tools: Path, built: Built, tmp_path: Path) -> None:
    with tarfile.open(built.source) as archive:
        archive.extractall(tmp_path, filter="data")
    (unpacked,) = tmp_path.iterdir()
    assert build(tools, unpacked, tmp_path / "again").contents() == built.contents()


def test_an_installed_wheel_answers_from_an_empty_directory(built: Built, tmp_path: Path) -> None:
    programs = environment(tmp_path / "environment", str(built.wheel))
    empty = tmp_path / "empty"
    empty.mkdir()
    variables: Mapping[str, str] = {"PATH": os.environ["PATH"], "HOME": str(empty), "XDG_CONFIG_HOME": str(empty)}

    def run(program: str, *words: str) -> str:
        command = [str(programs / program), *words]
        return subprocess.run(command, check=True, cwd=empty, env=variables, stdout=subprocess.PIPE, text=True).stdout

    assert run("jkroll", "--version") == f"jkroll {__version__}\n"
    where = Path(run("python", "-c", "import jkroll; print(jkroll.__file__)").strip())
    assert (tmp_path / "environment") in where.parents
    for command in COMMANDS:
        data = json.loads(run("jkroll", command, "quartz", "100nm", "--json"))
        assert all(result["value"] is not None for result in data["results"])
    assert "kendall-1987" in run("jkroll", "materials", "quartz", "--cite")
    assert run("jkroll", "guide", "promises").startswith("# ")
    run("python", "-c", SHIPPED)
    assert list(empty.iterdir()) == []
