"""Materials files as a whole; the library reads a material when it is asked for."""

from os import PathLike

from jkroll.materials.library import Material, _material, entries_of, path_of


def read(path: str | PathLike[str]) -> list[Material]:
    """Read and check a materials file; MaterialsFileError says what is wrong with it."""
    return [_material(entry) for entry in entries_of(path_of(path))]
