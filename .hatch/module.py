"""The shipped materials as the text of a Python module, for the build hook and for tests of what a wheel imports."""

from jkroll.materials.library import SHIPPED, materials_in

HEAD = '''"""The materials of materials.toml, written when the wheel was built."""

from types import MappingProxyType as mappingproxy

from ..quantities import values
from .library import SHIPPED, Displacement, Material

Interval, Measured = values.Interval.of, values.Measured.of
'''


def text() -> str:
    """Return the text of the module."""
    return f"{HEAD}MATERIALS = {materials_in(SHIPPED)!r}\n".replace(repr(SHIPPED), "SHIPPED")
