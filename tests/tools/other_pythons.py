"""Run tests under every other CPython of this machine, and command lines with the lowest permitted requirements.

    python tests/tools/other_pythons.py

Other CPythons are those on PATH or in ~/.pyenv/versions whose version differs from the one that runs this script.
Each gets its own environment outside of the checkout. Prints the versions that ran, and ends with 1 at the first
failure.
"""

import os
import re
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

CHECKOUT = Path(__file__).resolve().parents[2]
PROJECT = tomllib.loads((CHECKOUT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
TESTS = ("tests/physics", "tests/model", "tests/write", "tests/quantities")
CORPUS = ("tests/tools/run_command_lines.py", "check", "60")
# A program that fails under a shim without a Python behind it, and under a Python that cannot make environments.
ASK = "import sys, ensurepip, venv; print(sys.implementation.name, *sys.version_info[:2])"

Version = tuple[int, ...]


def lowest_python() -> Version:
    """Return the lowest version of Python that the project permits."""
    return tuple(map(int, PROJECT["requires-python"].removeprefix(">=").split(".")))


def lowest_requirements() -> list[str]:
    """Return the requirements of the project, each pinned to the lowest version that it permits."""
    return [re.sub(r">=([\d.]+).*", r"==\1", text) for text in PROJECT["dependencies"]]


def pythons() -> dict[Version, str]:
    """Return the CPythons that work and are permitted, by version: this one, or the first that is found."""
    found: dict[Version, str] = {sys.version_info[:2]: sys.executable}
    folders = [*map(Path, os.get_exec_path()), *sorted(Path.home().glob(".pyenv/versions/*/bin"))]
    for path in [path for folder in folders for path in sorted(folder.glob("python3*"))]:
        if re.fullmatch(r"python3(\.\d+)?", path.name):
            name, *version = subprocess.run([path, "-c", ASK], capture_output=True, text=True).stdout.split() or [""]
            if name == "cpython" and (numbers := tuple(map(int, version))) >= lowest_python():
                found.setdefault(numbers, str(path))
    return dict(sorted(found.items()))


def environment(python: str, folder: str, *requirements: str) -> str:
    """Make a virtual environment with requirements; return its Python."""
    subprocess.run([python, "-m", "venv", folder], check=True)
    inside = f"{folder}/bin/python"
    subprocess.run([inside, "-m", "pip", "install", "--quiet", *requirements], cwd=CHECKOUT, check=True)
    return inside


def main() -> int:
    """Run the tests and the command lines; return 1 if something fails."""
    found = pythons()
    lowest = lowest_requirements()
    try:
        for version, path in found.items():
            title = f"Python {'.'.join(map(str, version))}, {path}"
            with tempfile.TemporaryDirectory() as folder:
                if version != sys.version_info[:2]:
                    python = environment(path, f"{folder}/newest", ".[test]")
                    print(f"{title}: {', '.join(TESTS)} and the corpus", flush=True)
                    subprocess.run(
                        [python, "-m", "pytest", "-q", "-p", "no:cacheprovider", *TESTS], cwd=CHECKOUT, check=True
                    )
                    subprocess.run([python, *CORPUS], cwd=CHECKOUT, check=True)
                if version == lowest_python():
                    python = environment(path, f"{folder}/lowest", ".", *lowest)
                    print(f"{title}, {', '.join(lowest)}: the corpus", flush=True)
                    subprocess.run([python, *CORPUS], cwd=CHECKOUT, check=True)
    except subprocess.CalledProcessError as error:
        print(error)
        return 1
    if lowest_python() not in found:
        print(f"no Python {PROJECT['requires-python']} in its lowest version: {', '.join(lowest)} not tried")
    return 0


if __name__ == "__main__":
    sys.exit(main())
