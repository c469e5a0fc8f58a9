"""All claims of the paper, in the paper's order, and the table of those that do not hold, for `jkroll guide paper`.

    python tests/audit/claims.py

renews the table in the page.
"""

import sys
from pathlib import Path

if __package__ in (None, ""):
    sys.path.insert(0, str(Path(__file__).parents[1]))
from audit.checks import Check
from audit.moment import cylinder, moment
from audit.pair import collisions, statics, vibrations

PAGE = Path(__file__).parents[2] / "src" / "jkroll" / "guide" / "paper.md"
HEAD = "| Eq | claim | printed | follows | printed over follows | verdict | from |\n|---|---|---|---|---|---|---|\n"


def claims() -> tuple[Check, ...]:
    """Return the checks of all claims of the paper, in the paper's order."""
    return (*moment(), *statics(), *vibrations(), *collisions(), *cylinder())


def table() -> str:
    """Return the claims that do not hold as a table in Markdown, each with its numbers at the values of the audit."""
    checks = [(check, *check.numbers) for check in claims() if check.verdict != "holds"]
    cells = (
        (check.equation, check.claim.replace("|", "\\|"), f"{printed:.4g}", f"{follows:.4g}",
         f"{printed / follows:.3g}", check.verdict, check.reason)
        for check, printed, follows in checks
    )  # fmt: skip
    return HEAD + "".join(f"| {' | '.join(line)} |\n" for line in cells)


def with_table(page: str) -> str:
    """Return a page with its table replaced."""
    before, _, rest = page.partition(HEAD)
    after = rest.partition("\n\n")[2]
    return f"{before}{table()}\n{after}"


if __name__ == "__main__":
    PAGE.write_text(with_table(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
