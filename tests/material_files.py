"""Materials files as a whole."""

from os import PathLike

from jkroll.materials.library import Material, materials_in, path_of


def read(path: str | PathLike[str]) -> list[Material]:
    """Return the materials of a file; raise MaterialsFileError for the first thing that is wrong with it."""
    materials = materials_in(path_of(path))
    for material in materials:
        if material.mistake is not None:
            raise material.mistake
    return materials
