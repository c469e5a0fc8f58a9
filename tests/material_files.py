"""Read a whole materials file for the tests."""

import os

from jkroll.materials.library import Material, MaterialsFileError, materials_in


def read(path: str | os.PathLike[str]) -> list[Material]:
    """Return the materials of a file; raise MaterialsFileError for the first fault in it."""
    materials = materials_in(os.fspath(path))
    for material in materials:
        if material.problem:
            raise MaterialsFileError(material.path, material.problem)
    return materials
