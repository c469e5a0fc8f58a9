"""The sentence that says whether an impact stays elastic."""

from ..model.frame import Frame
from ..quantities.formatting import Format, amount

_THREE = Format(digits=3)


def elastic_or_not(frame: Frame) -> str:
    """Return the peak pressure of an impact beside that at rest or, if the yield strength is known, those of yield."""
    peak = _pressure(frame, "impact_pressure")
    if frame.missing(["first_yield_pressure"]):
        rest = _pressure(frame, "hertz_pressure")
        return f"elastic if the solids bear a peak pressure of {peak} (p_H at rest is {rest}): --yield-strength"
    first, full = _pressure(frame, "first_yield_pressure"), _pressure(frame, "plastic_pressure")
    limits = f"peak pressure {peak}; first yield at {first} below the surface, full yield at {full}"
    if frame["impact_pressure"] < frame["first_yield_pressure"]:
        return f"it stays elastic: {limits}"
    how = "fully" if frame["impact_pressure"] >= frame["plastic_pressure"] else "below the surface"
    at_rest = "already where they touch at no speed" if frame["touch_pressure"] >= frame["first_yield_pressure"] else ""
    return f"it yields {how}{at_rest and ', ' + at_rest}, so e is an upper bound: {limits}"


def _pressure(frame: Frame, name: str) -> str:
    return amount(name, frame[name], _THREE)
