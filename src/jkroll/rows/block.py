"""Rows that are computed together, as they stand in a list, in a table, or in arrays."""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .cells import Indices, Numbers


class Block(ABC):
    """Rows that are computed together."""

    def __init__(
        self,
        size: int,
        numbers: "Mapping[str, Numbers]",
        kinds: "Sequence[Indices]" = (),
        odd: Mapping[int, str] = MappingProxyType({}),
    ) -> None:
        """`numbers`: by the name of the input; `kinds`: rows with other whole numbers have other scenes.

        `odd`: records that are no rows, and why.
        """
        self.size, self.numbers, self.kinds, self.odd = size, numbers, kinds, odd

    @abstractmethod
    def scene(self, given: Mapping[str, Any], rows: "Indices") -> Any:
        """Return the scene of rows that are alike. Raises a JkrollError where each is a scene by itself."""

    @abstractmethod
    def scene_of(self, row: int) -> Any:
        """Return the scene of a row by itself. Raises the error of what is wrong with it."""
