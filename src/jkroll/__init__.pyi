"""The public names. Made by tests/tools/make_stub.py."""

from . import formulas as formulas
from .errors import JkrollError as JkrollError
from .materials.library import Material as Material
from .materials.library import Materials as Materials
from .materials.library import known_materials as known_materials
from .model.infer import infer as infer
from .model.solver import FORMULAS as FORMULAS
from .model.solver import solve as solve
from .pictures.answers import answer as answer
from .pictures.drawn import curve as curve
from .pictures.drawn import figure as figure
from .pictures.drawn import map as map
from .pictures.fitted import fit as fit
from .quantities.quantity import Quantity as Quantity
from .quantities.values import Interval as Interval
from .quantities.values import Measured as Measured
from .tables.tabled import table as table
from .write.nomenclature import NOMENCLATURE as NOMENCLATURE

__version__: str
