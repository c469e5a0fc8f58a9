"""A result, and a note about an answer."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Literal, NamedTuple

from ..quantities.nomenclature import NOMENCLATURE

if TYPE_CHECKING:
    from ..scene.uncertainty import Propagated
else:
    Propagated = object  # a quoted type would start Python's compiler, which costs a call a millisecond


class OtherLaw(NamedTuple):
    """The law of attraction other than JKR by which a quantity was computed."""

    name: str
    equation: str  # of the paper, or the source of the law
    jkr: float | None  # the value of JKR, to stand beside it


class Result(NamedTuple):
    """A quantity in SI units, or the reason why it has no value.

    `error` is the relative error of a model of the moment, `condition` the factor by which an inferred value multiplies the
    relative error of a measured one.
    """

    name: str
    value: float | None
    reason: str = ""
    error: float | None = None
    condition: float | None = None
    by_law: Mapping[str, float] = MappingProxyType({})  # of an inferred value: what it would be under the other laws
    propagated: Propagated | None = None  # its uncertainty, if an input has one
    law: OtherLaw | None = None

    @property
    def equation(self) -> str:
        """The equation that gives the quantity, or the source of its law."""
        return self.law.equation if self.law else NOMENCLATURE[self.name].equation

    def sides(self) -> dict[str, float]:
        """Return the numbers of the uncertainty by name: minus and plus, or low and high; none if there is no uncertainty."""
        return self.propagated.uncertainty.sides if self.propagated is not None else {}


# Of notes, the most important first.
Kind = Literal["material", "missing", "doubt", "result", "model", "assumption", "unchecked", "data"]


class Note(NamedTuple):
    """A sentence about an answer."""

    kind: Kind
    text: str
    matter: str = ""  # the same for all scenes that have such a note; by default the text
    brief: str = ""  # of a doubt: the number and the limit that it exceeds
