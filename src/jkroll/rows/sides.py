"""The columns of an uncertainty: how their headers say what they are of, and which of them make one with a column of values."""

import re
from collections.abc import Collection, Mapping
from typing import NamedTuple

from ..errors import BadTable
from ..text import quoted
from .cells import Column, Side
from .words import PARTS

_RANGE = ("low", "high")
# Patterns, each made when a header is first held against it: most tables need none.
_OF_PART = rf"(?i)(.*?)(?:[\s_.]*(±|\+/?-)|[\s_.]+({'|'.join(filter(str.isalpha, PARTS))}))(?=$|[\s_.,/(\[])(.*)"
_ERROR = "|".join(["σ", "sigma", *(word for word, part in PARTS.items() if part == "both" and word.isalpha())])
_PART_BEFORE = (  # as in u(R) [nm], or as in σ_E [GPa] and error of radius
    rf"(?i)(?:u|{_ERROR})\s*\(([^()]+)\)(.*)|(?:±\s*|(?:{_ERROR})(?:\s+of)?[\s_]+)([^\s_].*)"
)
_ALONE = (  # "error" without a unit may be that of anything
    r"(?i)(?:±|\+/?-|(?:standard|std?)[\s_.]*dev(?:iation)?|std|sd|sem|unc|uncertainty|err(?:or)?(?=\s*[\[(]))"
    r"\.?\s*(?:[\[(](.*)[\])])?"
)
_SHARE = r"(?i)[\s_.,/]*[\[(]?(?:%|percent|pct)[\])]?"  # of the value


class PartOf(NamedTuple):
    """The header of a part of an uncertainty, as that of its value and the part."""

    value: str
    part: str  # "both" sides, "minus", "plus", or the "low" or "high" end of a range
    is_share: bool


def part_of(text: str) -> PartOf | None:
    """Return what a header says of an uncertainty; None if it says nothing of one.

    >>> part_of("radius_err [nm]"), part_of("u(E) (%)"), part_of("radius [nm]")
    (PartOf(value='radius [nm]', part='both', is_share=False), PartOf(value='E', part='both', is_share=True), None)
    """
    plain = re.sub(_SHARE, "", text)
    if before := re.fullmatch(_PART_BEFORE, plain):
        return PartOf(before[1] + before[2] if before[1] else before[3], "both", plain != text)
    if behind := re.fullmatch(_OF_PART, plain):
        return PartOf(behind[1] + behind[4], PARTS[(behind[2] or behind[3]).lower()], plain != text)
    return None


def unit_alone(text: str) -> str | None:
    """Return the unit, or "", of a header that is ± or SD alone: the uncertainty of the column at its left; None for others.

    >>> unit_alone("± [nm]"), unit_alone("+/-"), unit_alone("radius ±"), unit_alone("SD (nm)"), unit_alone("error")
    ('nm', '', None, 'nm', None)
    """
    alone = re.fullmatch(_ALONE, text)
    if alone is None:
        return None
    return "%" if re.fullmatch(_SHARE, alone[1] or "") else alone[1] or ""


def with_sides(
    base: Column | None, parts: Mapping[str, Column], texts: Mapping[int, str], stated: Collection[str]
) -> Column | None:
    """Return the column of an input with those of its uncertainty; None if they make none and pass through. Raises BadTable.

    `base` is the column of its values, `texts` are headers by place, `stated` those that options name.
    """
    name = next(iter(parts.values())).name
    kinds = [kind for kind in (("both",), ("minus", "plus")) if base and parts.keys() >= {*kind}]
    if not base and parts.keys() >= {*_RANGE}:
        kinds, base = [_RANGE], parts["low" if parts["low"].unit_text else "high"]._replace(place=parts["low"].place)
    used = [part for kind in kinds for part in kind]
    left = [texts[column.place] for part, column in parts.items() if part not in used]
    if len(kinds) > 1:
        first, second = (quoted(texts[parts[part].place]) for part in used[:2])
        raise BadTable(f"header: {first} and {second} are both uncertainties of {name}; one must go")
    if left and (any(text.strip() in stated for text in left) or (not base and parts.keys() & {*_RANGE})):
        raise BadTable(
            f"header: {quoted(left[0])} alone is no uncertainty of {name}: values have a column of ± beside them, or two, "
            "of minus and plus; a range has low and high alone"
        )
    if not base or not kinds:
        return None
    sides = []
    for part in used:
        place, unit_text = parts[part].place, parts[part].unit_text
        if part != "both" and unit_text not in ("", base.unit_text):
            other = f", {base.unit_text}" if base.unit_text else "; that has none"
            raise BadTable(f"header: {quoted(texts[place])}: its unit must be that of the other column{other}")
        sides.append(Side(part, place, "" if unit_text == base.unit_text else unit_text))
    return base._replace(sides=tuple(sides))
