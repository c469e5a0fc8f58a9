"""The claims of the paper, in its order, each beside what follows from its premises.

Nothing here uses the formulas of `jkroll.physics`: what follows is integrated, differentiated and solved anew.
"""

from .check import Check, Row, Verdict

__all__ = ["Check", "Row", "Verdict", "claims"]


def claims() -> tuple[Check, ...]:
    """Evaluate every claim of the paper and what follows in its place."""
    from .collisions import collisions
    from .cylinder import cylinder
    from .moment import moment
    from .statics import statics
    from .vibrations import vibrations

    return (*moment(), *statics(), *vibrations(), *collisions(), *cylinder())
