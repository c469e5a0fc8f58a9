"""Layouts of tables of lines: how many cells a row has."""


def in_cells(size: int) -> str:
    """Return a number of cells in words."""
    return f"{size} {'cell' if size == 1 else 'cells'}"


def remedy_of_size(size: int, width: int, word: str) -> str:
    """Return what to do with a row of so many cells below a header of `width`. `word`: for the separator."""
    if size > width:
        return f"write text with a {word} in quotes"
    return 'write "" for an empty cell' if word == "blank" else f"write a {word} for each empty cell"
