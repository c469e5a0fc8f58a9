"""A check: what the paper prints beside what follows from its premises, and the verdict that the two numbers give."""

from collections.abc import Callable
from typing import Literal, NamedTuple

Verdict = Literal["holds", "sign", "misprint", "wrong", "approximate"]
Terms = float | tuple[float, ...]

ROUNDING = 1e-9  # how far two routes to one number may differ


class Check(NamedTuple):
    """A claim of the paper. It is evaluated where nothing is special, so that only what is equal agrees.

    Its numbers are one, or several: the terms of a sum, the ends of a range, or cases.
    """

    equation: str  # numbers of equations, or the place in the prose
    claim: str
    expected: Verdict
    reason: str
    printed: Callable[[], Terms]
    follows: Callable[[], Terms]
    restated: Callable[[], Terms] | None = None  # the same thing where the paper itself says it again
    within: float = ROUNDING  # relative, what the printed digits or the order of a series admit
    hedge: float = 1.0  # the factor that an "about" or a "≈" of the paper admits

    def row(self) -> "Row":
        """Compute both sides and compare them."""
        printed, follows = _terms(self.printed()), _terms(self.follows())
        worst = max(range(len(follows)), key=lambda place: _difference(printed[place], follows[place]))
        return Row(
            self.equation,
            self.claim,
            printed[worst],
            follows[worst],
            _difference(printed[worst], follows[worst]),
            self._verdict(printed, follows),
            self.expected,
            self.reason,
        )

    def _verdict(self, printed: tuple[float, ...], follows: tuple[float, ...]) -> Verdict:
        if _agree(printed, follows, self.within):
            return "holds"
        if _agree(tuple(map(abs, printed)), tuple(map(abs, follows)), self.within):
            return "sign"
        if self.restated is not None and _agree(_terms(self.restated()), follows, self.within):
            return "misprint"
        if all(1 <= self.hedge * one / other <= self.hedge**2 for one, other in zip(printed, follows, strict=True)):
            return "approximate"
        return "wrong"


class Row(NamedTuple):
    """The outcome of a check; of several numbers, those that differ most."""

    equation: str
    claim: str
    printed: float
    follows: float
    difference: float  # relative to what follows
    verdict: Verdict
    expected: Verdict
    reason: str


def _terms(value: Terms) -> tuple[float, ...]:
    return value if isinstance(value, tuple) else (value,)


def _difference(printed: float, follows: float) -> float:
    return abs(printed - follows) / abs(follows)


def _agree(printed: tuple[float, ...], follows: tuple[float, ...], within: float) -> bool:
    return all(_difference(one, other) <= within for one, other in zip(printed, follows, strict=True))
