"""The numbers that a scene gives: results that doubles hold with all digits, and zeros where the physics has them."""

from typing import Any

from ..quantities.nomenclature import INFINITY

SMALLEST = 2.2250738585072014e-308  # of the doubles that have all their digits
MAY_BE_ZERO = frozenset(
    {
        "load_margin",
        "load_margin_of_factor",
        "load_margin_at_approach",
        "load_at_factor",
        "stiffness",
        "vertical_frequency",
        "approach_at_load",
        "radius_ratio",
        "load_factor_at_load_unstable",
        "load_factor_at_approach_unstable",
        "load_maugis",
        "stiffness_maugis",
        "approach_maugis",
        "edge_ratio_at_approach",
        "edge_ratio_at_fold",
        "contact_radius_maugis",
        "contact_radius_in_spacings",
        "load_dmt",
        "contact_radius_dmt",
        "contact_radius_dmt_at_approach",
        "stiffness_dmt",
        "approach_dmt",
    }
)  # at P = 0, at P = -P_c, or at P = -(8/9)P_c; the radius where nothing touches


def is_plausible(name: str, value: float) -> bool:
    """Return whether a result is one that doubles hold with all digits, or the zero that it may be."""
    return SMALLEST <= abs(value) < INFINITY or (value == 0 and name in MAY_BE_ZERO)


def with_nan(name: str, values: Any) -> Any:
    """Return an array with nan in place of the elements that are no answer."""
    import numpy

    size = abs(values)
    if size.size and size.min() >= SMALLEST and size.max() < INFINITY:
        return values
    may_be = (size == 0) & (name in MAY_BE_ZERO)
    return numpy.where((size >= SMALLEST) & (size < INFINITY) | may_be, values, numpy.nan)
