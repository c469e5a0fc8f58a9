"""The wheel: built, installed apart from this checkout, and run from an empty directory."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


@pytest.mark.slow
def test_an_installed_wheel_answers_from_an_empty_directory(tmp_path: Path) -> None:
    pip = [sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check"]
    subprocess.run([*pip, "wheel", "--no-deps", "--wheel-dir", str(tmp_path / "wheel"), str(ROOT)], check=True)
    (wheel,) = (tmp_path / "wheel").glob("jkroll-*.whl")
    subprocess.run([*pip, "install", "--no-deps", "--target", str(tmp_path / "site"), str(wheel)], check=True)
    empty = tmp_path / "empty"
    empty.mkdir()
    environment = {**os.environ, "PYTHONPATH": str(tmp_path / "site"), "XDG_CONFIG_HOME": str(empty)}

    def run(*words: str) -> str:
        command = [sys.executable, "-m", "jkroll", *words]
        return subprocess.run(command, check=True, cwd=empty, env=environment, capture_output=True, text=True).stdout

    where = subprocess.run(
        [sys.executable, "-c", "import jkroll; print(jkroll.__file__)"],
        check=True, cwd=empty, env=environment, capture_output=True, text=True,
    )  # fmt: skip
    assert where.stdout.strip() == str(tmp_path / "site/jkroll/__init__.py")
    for command in (
        "pull-off",
        "yield-force",
        "r-min",
        "n-grav",
        "frequencies",
        "n-roll",
        "contact",
        "moment",
        "report",
    ):
        data = json.loads(run(command, "quartz", "100nm", "--json"))
        assert all(result["value"] is not None for result in data["results"])
    assert "kendall-1987" in run("materials", "quartz", "--cite")
    shipped = (
        "import sys; from jkroll.cli.process import main; assert main(['pull-off', 'quartz', '100nm']) == 0; "
        "assert 'jkroll.materials.shipped' in sys.modules; assert 'tomllib' not in sys.modules; "
        "import tomllib; from jkroll.materials import library, shipped; file = open(library.SHIPPED, 'rb'); "
        "assert tomllib.load(file) == shipped.DATA"
    )
    subprocess.run([sys.executable, "-c", shipped], check=True, cwd=empty, env=environment, stdout=subprocess.DEVNULL)
    assert list(empty.iterdir()) == []
