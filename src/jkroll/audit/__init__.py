"""The claims of the paper, in its order, each beside what follows from its premises.

Nothing here uses the formulas of `jkroll.physics`: what follows is integrated, differentiated and solved anew.
"""

from .checks import Check, Row, Verdict

__all__ = ["Check", "Row", "Verdict", "claims"]


def claims() -> tuple[Check, ...]:
    """Evaluate every claim of the paper and what follows in its place."""
    from .moment import cylinder, moment
    from .pair import statics
    from .vibrations import collisions, vibrations

    return (*moment(), *statics(), *vibrations(), *collisions(), *cylinder())
