"""A check: a claim of the paper beside what follows from its premises, and the verdict that the two numbers give."""

from typing import Literal, NamedTuple

Verdict = Literal["holds", "sign", "misprint", "wrong", "approximate"]
Terms = float | tuple[float, ...]  # one number, or several: the terms of a sum, the ends of a range, or cases

ROUNDING = 1e-9  # relative difference that two routes to one number may have


class Check(NamedTuple):
    """A claim of the paper, evaluated at values where nothing is special, so that only equal formulas agree."""

    equation: str  # numbers of equations, or the place in the prose
    claim: str
    expected: Verdict
    reason: str
    printed: Terms
    follows: Terms
    restated: Terms | None = None  # the printed claim where the paper states it again
    within: float = ROUNDING  # relative difference admitted by the printed digits or the order of a series
    hedge: float = 1.0  # factor admitted by an "about" or a "≈" of the paper

    @property
    def verdict(self) -> Verdict:
        """The verdict that the numbers give."""
        printed, follows = _terms(self.printed), _terms(self.follows)
        if _agree(printed, follows, self.within):
            return "holds"
        if _agree(tuple(map(abs, printed)), tuple(map(abs, follows)), self.within):
            return "sign"
        if self.restated is not None and _agree(_terms(self.restated), follows, self.within):
            return "misprint"
        if all(1 <= self.hedge * one / other <= self.hedge**2 for one, other in zip(printed, follows, strict=True)):
            return "approximate"
        return "wrong"

    def row(self) -> "Row":
        """Return the outcome, with those of several numbers that differ most."""
        pairs = zip(_terms(self.printed), _terms(self.follows), strict=True)
        printed, follows = max(pairs, key=lambda pair: _difference(*pair))
        difference = _difference(printed, follows)
        return Row(self.equation, self.claim, printed, follows, difference, self.verdict, self.expected, self.reason)


class Row(NamedTuple):
    """The outcome of a check."""

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
