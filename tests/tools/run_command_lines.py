"""Run many command lines in one process: random ones, or those of tests/corpus/command_lines.txt.

    python tests/tools/run_command_lines.py random 1000000 [SEED]
    python tests/tools/run_command_lines.py check [COUNT]
    python tests/tools/run_command_lines.py compare CHECKOUT [CHECKOUT]
    python tests/tools/run_command_lines.py outputs [COUNT]

`random` checks the invariants of generated lines: see `check_call` of tests/invariants.py. `check` runs the corpus, or
COUNT lines spread over it, and checks that each line ends with its exit code and without a traceback, and that `--json`
prints JSON. `compare` runs the corpus in two checkouts, each in its own process, and prints the differences in exit
codes, streams and written files; the second checkout defaults to this one. These three modes end with exit code 1 if a
line is wrong or differs. `outputs` renews tests/corpus/outputs.txt for the lines in it, or for about COUNT lines spread
over the corpus; read the file before you commit it.
"""

import os
import pickle
import subprocess
import sys
import tempfile
import time
from argparse import ArgumentParser, RawDescriptionHelpFormatter
from collections import Counter
from collections.abc import Iterator
from difflib import unified_diff
from pathlib import Path
from random import Random

sys.path.insert(0, str(Path(__file__).parents[1]))

from corpus_lines import Outcome, among_input_files, faults, lines, run, spread, write_outputs

CHECKOUT = Path(__file__).resolve().parents[2]
LONGEST = 40  # most printed lines of a difference
WIDEST = 1000  # characters of a line


def run_random(count: int, seed: int) -> int:
    """Run random command lines; return 1 if one broke an invariant."""
    import command_lines
    from invariants import check_call, isolate

    source = Random(seed)
    codes: Counter[int] = Counter()
    failures = 0
    start = time.process_time()
    with tempfile.TemporaryDirectory() as directory:
        isolate(directory)
        for _ in range(count):
            words = command_lines.command_line(source)
            try:
                codes[check_call(words)] += 1
            except Exception as error:
                failures += 1
                print(f"{words!r}: {type(error).__name__}: {error}", flush=True)
    print(f"{count} command lines in {time.process_time() - start:.0f} s of CPU: {dict(codes)}, {failures} failures")
    return int(failures > 0)


def check(count: int | None) -> int:
    """Run lines of the corpus; return 1 if one of them is wrong."""
    chosen = lines() if count is None else spread(lines(), count)
    runnable = [line for line in chosen if line.can_run]
    wrong = 0
    with among_input_files():
        for line in runnable:
            if found := faults(line, run(line)):
                wrong += 1
                print(f"{line.code} {line.typed}\n  " + "\n  ".join(found), flush=True)
    left_out = f", {len(chosen) - len(runnable)} skipped, without their library" if runnable != chosen else ""
    print(f"{len(runnable)} command lines of the corpus, {wrong} wrong{left_out}")
    return int(wrong > 0)


def record(path: str) -> int:
    """Run the corpus and write its outcomes to a file, for `compare`."""
    with among_input_files():
        outcomes = [run(line) for line in lines() if line.can_run]
    Path(path).write_bytes(pickle.dumps(outcomes))
    return 0


def compare(old: Path, new: Path) -> int:
    """Run the corpus in two checkouts, and print what differs; return 1 if something does."""
    with tempfile.TemporaryDirectory() as directory:
        paths = [Path(directory, name) for name in ("old", "new")]
        processes = [_recording(checkout, path) for checkout, path in zip((old, new), paths, strict=True)]
        codes = [process.wait() for process in processes]
        if any(codes):
            return 1
        of_old, of_new = (pickle.loads(path.read_bytes()) for path in paths)
    differ = 0
    chosen = [line for line in lines() if line.can_run]
    for line, before, after in zip(chosen, of_old, of_new, strict=True):
        if before != after:
            differ += 1
            print(f"\n{line.typed}")
            for text in _differences(before, after):
                print(f"  {text}")
    print(f"{differ} of {len(chosen)} command lines differ")
    return int(differ > 0)


def _recording(checkout: Path, path: Path) -> "subprocess.Popen[bytes]":
    """Start a process that runs the corpus in a checkout."""
    source = checkout.resolve() / "src"
    if not (source / "jkroll").is_dir():
        sys.exit(f"{checkout} is not a checkout of jkroll")
    command = [sys.executable, __file__, "record", str(path)]
    return subprocess.Popen(command, env=os.environ | {"PYTHONPATH": str(source), "PYTHONHASHSEED": "0"})


def _differences(before: Outcome, after: Outcome) -> Iterator[str]:
    """Iterate over lines that describe the differences of two outcomes."""
    if before.code != after.code:
        yield f"exit code {before.code}, now {after.code}"
    yield from _texts("stdout", before.out, after.out)
    yield from _texts("stderr", before.err, after.err)
    for name in sorted({*before.files, *after.files}):
        old, new = before.files.get(name), after.files.get(name)
        if old is None or new is None:
            yield f"{name} is {'new' if old is None else 'no longer written'}"
            continue
        try:
            yield from _texts(name, old.decode(), new.decode())
        except UnicodeDecodeError:
            if old != new:
                yield f"{name}: {len(old)} bytes before, {len(new)} different bytes now"


def _texts(name: str, before: str, after: str) -> Iterator[str]:
    """Iterate over the lines in which two texts differ, the first LONGEST of them."""
    found = [*unified_diff(before.splitlines(keepends=True), after.splitlines(keepends=True), name, name, n=0)]
    for text in found[:LONGEST]:
        yield text.removesuffix("\n")[:WIDEST]
    if len(found) > LONGEST:
        yield f"... and {len(found) - LONGEST} more lines"


def main() -> int:
    """Run the mode that the command line names."""
    parser = ArgumentParser(description=__doc__, formatter_class=RawDescriptionHelpFormatter)
    modes = parser.add_subparsers(dest="mode", required=True)
    mode = modes.add_parser("random")
    mode.add_argument("count", type=int)
    mode.add_argument("seed", type=int, nargs="?", default=1)
    mode = modes.add_parser("check")
    mode.add_argument("count", type=int, nargs="?")
    mode = modes.add_parser("compare")
    mode.add_argument("old", type=Path)
    mode.add_argument("new", type=Path, nargs="?", default=CHECKOUT)
    mode = modes.add_parser("outputs")
    mode.add_argument("count", type=int, nargs="?")
    modes.add_parser("record").add_argument("path")
    given = parser.parse_args()
    if given.mode == "random":
        return run_random(given.count, given.seed)
    if given.mode == "check":
        return check(given.count)
    if given.mode == "outputs":
        print(f"{write_outputs(given.count)} outputs")
        return 0
    if given.mode == "record":
        return record(given.path)
    return compare(given.old, given.new)


if __name__ == "__main__":
    sys.exit(main())
