"""Rows that are computed together, as they stand in a list, in a table, or in arrays."""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .cells import Indices, Numbers

BAD = -1  # the kind of a row, or of a cell, of which arrays make no scene


class Block(ABC):
    """Rows that are computed together."""

    def __init__(self, size: int, numbers: "Mapping[str, Numbers]", kinds: "Sequence[Indices]") -> None:
        """`numbers`: by input; `kinds`: rows with other whole numbers have other scenes, BAD have none."""
        self.size, self.numbers, self.kinds = size, numbers, kinds

    @abstractmethod
    def scene(self, given: Mapping[str, Any], rows: "Indices") -> Any:
        """Return the scene of rows that are alike. Raises a JkrollError where each is a scene by itself."""

    @abstractmethod
    def scene_of(self, row: int) -> Any:
        """Return the scene of a row by itself. Raises the error of what is wrong with it."""
