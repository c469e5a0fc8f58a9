"""The claims of the paper, in its order, each beside what follows from its premises.

Nothing here knows the formulas of `jkroll.physics`: what follows is integrated, differentiated and solved anew.
"""

from collections.abc import Sequence

from .check import Check, Row, Verdict
from .collisions import COLLISIONS
from .cylinder import CYLINDER
from .moment import MOMENT
from .statics import STATICS
from .vibrations import VIBRATIONS

CLAIMS: Sequence[Check] = (*MOMENT, *STATICS, *VIBRATIONS, *COLLISIONS, *CYLINDER)

__all__ = ["CLAIMS", "Check", "Row", "Verdict"]
