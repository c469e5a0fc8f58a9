"""Materials files as a whole."""

from os import PathLike

from jkroll.materials.library import Material, entries_in, path_of


def read(path: str | PathLike[str]) -> list[Material]:
    """Return the materials of a file; raise MaterialsFileError for the first thing that is wrong with it."""
    return [entry.material for entry in entries_in(path_of(path))]
