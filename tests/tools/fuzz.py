"""Search for an input that violates an invariant of tests/invariants.py, guided by coverage.

    python tests/tools/fuzz.py quantity -max_total_time=600

The targets are quantity, unit, materials and words. The options after the target are libFuzzer's, which writes a
violation to the current directory as crash-*. Inputs that reach new code go to a temporary folder, jkroll-fuzz/TARGET;
`python tests/tools/fuzz.py TARGET --keep` copies the small ones to tests/corpus, which a test replays. Needs `pip
install jkroll[fuzz]`.
"""

import shutil
import sys
import tempfile
from pathlib import Path

import atheris  # type: ignore[import-untyped,import-not-found,unused-ignore]

sys.path.insert(0, str(Path(__file__).parents[1]))
with atheris.instrument_imports(include=["jkroll", "tomllib"]):
    import tomllib  # noqa: F401

    from invariants import CORPUS, TARGETS, isolate
    from jkroll.quantities import values


MAX_KEPT = 100  # bytes


def main() -> None:
    """Fuzz the target that the command line names, or keep the inputs that were found."""
    target, *options = sys.argv[1:] or ["none"]
    if target not in TARGETS:
        sys.exit(f"{__doc__}\nno target {target!r}: {', '.join(TARGETS)}")
    found, kept = Path(tempfile.gettempdir()) / "jkroll-fuzz" / target, CORPUS / target
    found.mkdir(parents=True, exist_ok=True)
    if options == ["--keep"]:
        for path in found.iterdir():
            if path.stat().st_size <= MAX_KEPT:
                shutil.copy(path, kept)
        return
    values.unit_of("nautical_mile", "radius")  # pint starts, which is no input's fault
    with tempfile.TemporaryDirectory() as directory:
        isolate(directory)
        atheris.Setup([sys.argv[0], *options, str(found), str(kept)], TARGETS[target])
        atheris.Fuzz()


if __name__ == "__main__":
    main()
