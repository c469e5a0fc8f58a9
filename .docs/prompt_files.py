"""Write the prompt into a folder: the page, Pyodide with numpy, and wheels of this program and of packages for tables.

    python .docs/prompt_files.py FOLDER

Serve the folder (python -m http.server -d FOLDER) and open its address. Needs npm and pip.
"""

import hashlib
import json
import shutil
import subprocess
import sys
import tarfile
import tempfile
import urllib.request
import zipfile
from pathlib import Path

HERE = Path(__file__).parent
# Python for the browser, pinned by its hash, so that the page runs no other code.
PYODIDE, PYODIDE_SHA256 = "314.0.3", "d7f7d24f8db486c7eda7280f3b0f7517524c8e43e8b086c6ee6ae8016658b484"
PYODIDE_FILES = ("pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm", "python_stdlib.zip", "pyodide-lock.json")
# Pyodide's release has the wheel of numpy; if it cannot be reached, the file is taken from a package that carries it.
RELEASE = f"https://cdn.jsdelivr.net/pyodide/v{PYODIDE}/full"
CARRIER, CARRIER_FOLDER = "open-webui==0.12.4", "open_webui/frontend/pyodide"


def put_prompt(folder: Path) -> None:
    """Write the prompt into a folder."""
    shutil.copytree(HERE / "prompt", folder, dirs_exist_ok=True)
    wheels, python = folder / "python", folder / "pyodide"
    for subfolder in (wheels, python):
        shutil.rmtree(subfolder, ignore_errors=True)
        subfolder.mkdir()
    pip = [sys.executable, "-m", "pip", "--quiet"]
    subprocess.run([*pip, "wheel", "--no-deps", "--wheel-dir", wheels, HERE.parent], check=True)
    pins = HERE / "prompt-requirements.txt"
    subprocess.run([*pip, "download", "--no-deps", "--require-hashes", "-r", pins, "-d", wheels], check=True)
    packed = subprocess.run(
        ["npm", "pack", "--silent", f"pyodide@{PYODIDE}"], cwd=python, check=True, capture_output=True, text=True
    )
    archive = python / packed.stdout.strip()
    check(archive.name, archive.read_bytes(), PYODIDE_SHA256)
    with tarfile.open(archive) as content:
        for name in PYODIDE_FILES:
            member = content.extractfile(f"package/{name}")
            assert member is not None
            (python / name).write_bytes(member.read())
    archive.unlink()
    put_list(folder)
    put_numpy(python)


def put_list(folder: Path) -> None:
    """Write the list of the wheels, with the number of bytes that are loaded before the first answer.

    Numpy and the wheels for tables are loaded later.
    """
    wheels = folder / "python"
    own, *tables = sorted((path.name for path in wheels.glob("*.whl")), key=lambda name: not name.startswith("jkroll"))
    first = [wheels / own, *folder.glob("*.py"), *(folder / "pyodide" / name for name in PYODIDE_FILES)]
    size = sum(path.stat().st_size for path in first)
    (wheels / "index.json").write_text(json.dumps({"own": own, "tables": tables, "bytes": size}))


def put_numpy(python: Path) -> None:
    """Write the wheel of numpy, as named in Pyodide's list of packages, into Pyodide's folder."""
    packages = json.loads((python / "pyodide-lock.json").read_text(encoding="utf-8"))["packages"]
    name, sha256 = packages["numpy"]["file_name"], packages["numpy"]["sha256"]
    try:
        with urllib.request.urlopen(f"{RELEASE}/{name}", timeout=20) as answer:
            wheel = answer.read()
    except OSError:
        wheel = carried(name)
    check(name, wheel, sha256)
    (python / name).write_bytes(wheel)


def carried(name: str) -> bytes:
    """Return a file of Pyodide's release from the package that carries it."""
    with tempfile.TemporaryDirectory() as folder:
        pip = [sys.executable, "-m", "pip", "--quiet", "download", "--no-deps", "--only-binary=:all:"]
        subprocess.run([*pip, "--python-version=3.12", CARRIER, "-d", folder], check=True)
        with zipfile.ZipFile(next(Path(folder).glob("*.whl"))) as carrier:
            return carrier.read(f"{CARRIER_FOLDER}/{name}")


def check(name: str, content: bytes, sha256: str) -> None:
    """Stop unless a file has the pinned hash."""
    if hashlib.sha256(content).hexdigest() != sha256:
        raise SystemExit(f"{name} is not the file that was pinned")


if __name__ == "__main__":
    put_prompt(Path(sys.argv[1]))
