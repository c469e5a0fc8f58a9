"""Write the prompt into a folder: the page, Pyodide, and the wheels of this program and of what a table needs.

    python .docs/prompt_files.py FOLDER

Serve the folder (python -m http.server -d FOLDER) and open its address. Needs npm and pip.
"""

import hashlib
import json
import shutil
import subprocess
import sys
import tarfile
from pathlib import Path

HERE = Path(__file__).parent
# Python for the browser, and what a table needs. Pinned: a page that runs what nobody has read is no manual.
PYODIDE, PYODIDE_SHA256 = "pyodide@314.0.7", "66b7949e5a0cba2250b586d7e368bf12fb482800748d182c4618254b685ffaa0"
PYODIDE_FILES = ("pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm", "python_stdlib.zip", "pyodide-lock.json")


def put_prompt(folder: Path) -> None:
    """Write the prompt into a folder."""
    shutil.copytree(HERE / "prompt", folder, dirs_exist_ok=True)
    wheels, python = folder / "python", folder / "pyodide"
    for each in (wheels, python):
        shutil.rmtree(each, ignore_errors=True)
        each.mkdir()
    pip = [sys.executable, "-m", "pip", "--quiet"]
    subprocess.run([*pip, "wheel", "--no-deps", "--wheel-dir", wheels, HERE.parent], check=True)
    pins = HERE / "prompt-requirements.txt"
    subprocess.run([*pip, "download", "--no-deps", "--require-hashes", "-r", pins, "-d", wheels], check=True)
    (wheels / "index.json").write_text(json.dumps(sorted(path.name for path in wheels.glob("*.whl"))))
    packed = subprocess.run(
        ["npm", "pack", "--silent", PYODIDE], cwd=python, check=True, capture_output=True, text=True
    )
    archive = python / packed.stdout.strip()
    if hashlib.sha256(archive.read_bytes()).hexdigest() != PYODIDE_SHA256:
        raise SystemExit(f"{archive} is not the {PYODIDE} that was pinned")
    with tarfile.open(archive) as content:
        for name in PYODIDE_FILES:
            member = content.extractfile(f"package/{name}")
            assert member is not None
            (python / name).write_bytes(member.read())
    archive.unlink()


if __name__ == "__main__":
    put_prompt(Path(sys.argv[1]))
