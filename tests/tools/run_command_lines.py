"""Run many random command lines in this process, and check the invariants of each.

    python tests/tools/run_command_lines.py 1000000 [SEED]

Each ends with a documented code, a wrong usage prints one line and nothing else, nothing escapes: see `check_call` of
tests/invariants.py. Prints the number of calls by exit code, and every command line that broke an invariant.
"""

import sys
import tempfile
import time
from collections import Counter
from pathlib import Path
from random import Random

sys.path.insert(0, str(Path(__file__).parents[1]))

import command_lines
from invariants import check_call, isolate


def main() -> int:
    """Run the given number of command lines; return 1 if one broke an invariant."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
    source = Random(int(sys.argv[2]) if len(sys.argv) > 2 else 1)
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


if __name__ == "__main__":
    sys.exit(main())
