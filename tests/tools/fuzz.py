"""Search for an input that violates an invariant of tests/invariants.py, guided by coverage.

    python tests/tools/fuzz.py quantity -max_total_time=600

The targets are quantity, unit, materials and words. Options after the target are passed to libFuzzer, which writes a
violation to the current directory as crash-*. Inputs that reach new code go to a temporary folder, jkroll-fuzz/TARGET;
`python tests/tools/fuzz.py TARGET --keep` copies the small ones to tests/corpus, which a test replays. Inputs of
the target materials are printed, to be copied into an entry of tests/corpus/material_files.toml. Fuzzing needs
`pip install jkroll[fuzz]`.
"""

import json
import shutil
import sys
import tempfile
from pathlib import Path

import atheris  # type: ignore[import-untyped,import-not-found,unused-ignore]

sys.path.insert(0, str(Path(__file__).parents[1]))
with atheris.instrument_imports(include=["jkroll", "tomllib"]):
    import tomllib  # noqa: F401

    from invariants import CORPUS, TARGETS, isolate, kept
    from jkroll.quantities import values


MAX_KEPT = 100  # bytes


def main() -> None:
    """Fuzz the target that the command line names, or keep the inputs that were found."""
    target, *options = sys.argv[1:] or ["none"]
    if target not in TARGETS:
        sys.exit(f"{__doc__}\nno target {target!r}: {', '.join(TARGETS)}")
    found = Path(tempfile.gettempdir()) / "jkroll-fuzz" / target
    found.mkdir(parents=True, exist_ok=True)
    if options == ["--keep"]:
        for path in found.iterdir():
            if path.stat().st_size > MAX_KEPT:
                continue
            if target == "materials":
                print(f"  {json.dumps(path.read_text(encoding='utf-8', errors='replace'))},")
            else:
                shutil.copy(path, CORPUS / target)
        return
    values.unit_of("nautical_mile", "radius")  # starts pint now, so that no input seems slow
    with tempfile.TemporaryDirectory() as directory:
        seeds = Path(directory, "seeds")
        seeds.mkdir()
        for number, data in enumerate(kept(target)):
            (seeds / str(number)).write_bytes(data)
        crashes = f"-artifact_prefix={Path.cwd()}/"  # since `isolate` changes the directory
        isolate(directory)
        atheris.Setup([sys.argv[0], crashes, *options, str(found), str(seeds)], TARGETS[target])
        atheris.Fuzz()


if __name__ == "__main__":
    main()
