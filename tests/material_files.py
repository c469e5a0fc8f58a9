"""Materials files as a whole."""

from os import PathLike

from jkroll.materials.library import Material, materials_in, path_of
from jkroll.materials.library import read as read_material


def read(path: str | PathLike[str]) -> list[Material]:
    """Return the materials of a file; raise MaterialsFileError for the first thing that is wrong with it."""
    materials = [*map(read_material, materials_in(path_of(path)))]
    for material in materials:
        if material.mistake is not None:
            raise material.mistake
    return materials
