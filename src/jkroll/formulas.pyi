"""The formulas by name. Made by tests/tools/make_stub.py."""

from .physics.any_law import *
from .physics.contact import *
from .physics.conventions import *
from .physics.dmt import *
from .physics.impact import *
from .physics.jkr import *
from .physics.maugis import *
from .physics.meniscus import *
from .physics.motion import *
from .physics.rolling import *
from .physics.sphere import *
from .physics.tangential import *
