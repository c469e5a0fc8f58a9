"""`jkroll bench`: the cost and the error of each way to compute six quantities, as a table or a page of plots.

The ways are those of this package, the equations of the paper, an inversion and a fit in other codes, and a table of
values. The equations are written in their simplest form, for doubles and for decimals of 60 digits, which give the
exact values. Under JKR, they take a load together with the pull-off force, and an approach together with that of the
unloaded contact. Errors are in ulp/(1 + κ), where κ is the condition of a quantity (see `exact`), and ulp the distance
of its value to the next double.
"""

# ruff: noqa: D102, N803, N806  (names of quantities and the paper's symbols)

import math
import platform
from collections.abc import Callable, Iterator, Mapping, Sequence
from decimal import Decimal, localcontext
from functools import cache, partial
from itertools import groupby
from statistics import median
from time import perf_counter_ns
from typing import Any, NamedTuple, TextIO

import numpy
from numpy import cbrt, exp, interp, linspace, pi, sqrt, where

from .. import __version__
from ..model.frame import Frame
from ..physics.any_law import TRANSITION_OVER_TABOR
from ..physics.contact import pull_off_force, reduced_radius
from ..physics.jkr import FOLD_APPROACH
from ..pictures.picture import Axis, Curve, Panel, Picture
from ..quantities.formatting import significant
from ..quantities.nomenclature import NOMENCLATURE
from ..text import say
from ..write.writers import Cell, write_records

SYMBOLS = {
    "R1": "radius", "R2": "radius2", "w": "work_of_adhesion", "E": "contact_modulus",
    "xi": "yield_displacement", "P": "load", "P_c": "pull_off_force",
    "delta": "approach_at_load", "delta0": "approach", "z0": "atomic_spacing",
}  # fmt: skip
DIGITS = 60
_STEP = Decimal("1e-20")  # relative step of an input for a slope; terms in its square are too small to matter

Way = Callable[..., Any]  # a function whose parameters are the paper's symbols
Errors = tuple[float, float]  # the median and the largest error of a way in a region, in ulp/(1 + κ)


def inputs_taken(way: Way) -> tuple[str, ...]:
    """Return the names of the inputs of a way."""
    code = way.__code__
    return tuple(SYMBOLS[symbol] for symbol in code.co_varnames[: code.co_argcount] if symbol in SYMBOLS)


class Equations:
    """The paper's equations, for the type of number that the given roots and π have.

    `tolerance`: an iteration ends when its relative step is smaller; the error is then about the square of the step.
    """

    def __init__(self, sqrt: Way, cbrt: Way, pi: Any, tolerance: Any) -> None:
        self.sqrt, self.cbrt, self.pi, self.tolerance = sqrt, cbrt, pi, tolerance

    def reduced(self, first: Any, second: Any) -> Any:
        return 1 / (1 / first + 1 / second)

    def factor(self, P: Any, P_c: Any) -> Any:
        """Return x = â^(3/2), where â = a/a0: the larger root of P/P_c = 4(x² − x), Eq 5."""
        return (1 + self.sqrt(1 + P / P_c)) / 2

    def stretch(self, P: Any, P_c: Any) -> Any:
        return self.cbrt(self.factor(P, P_c) ** 2)

    def radius(self, R1: Any, R2: Any, w: Any, E: Any) -> Any:
        return self.cbrt(9 * self.pi * (w / 2) * self.reduced(R1, R2) ** 2 / E)

    def approach(self, R1: Any, R2: Any, w: Any, E: Any) -> Any:
        return self.radius(R1, R2, w, E) ** 2 / (3 * self.reduced(R1, R2))

    def pull_off_force(self, R1: Any, R2: Any, w: Any) -> Any:
        return 3 * self.pi * (w / 2) * self.reduced(R1, R2)

    def contact_radius_at_load(self, R1: Any, R2: Any, w: Any, E: Any, P: Any, P_c: Any) -> Any:
        return self.radius(R1, R2, w, E) * self.stretch(P, P_c)

    def stiffness(self, R1: Any, R2: Any, w: Any, E: Any, P: Any, P_c: Any) -> Any:
        """Return dP/dδ: the slope of P(â), Eq 5, divided by the slope of δ(â), Eq 6."""
        a_ = self.stretch(P, P_c)
        slope = (12 * a_**2 - 6 * self.sqrt(a_)) / (6 * a_ - 1 / self.sqrt(a_))
        return self.pull_off_force(R1, R2, w) / self.approach(R1, R2, w, E) * slope

    def load_factor_at_approach(self, delta: Any, delta0: Any) -> Any:
        """Return x = y³ from Eq 6, 3y⁴ − 2y = δ/δ0, solved by Newton's method, which is monotonic from above."""
        ratio = delta / delta0
        y = 1 + self.sqrt(self.sqrt(abs(ratio)))
        for _ in range(200):
            step = (3 * y**4 - 2 * y - ratio) / (12 * y**3 - 2)
            y = y - step
            if not numpy.any(abs(step) > self.tolerance * abs(y)):
                break
        return y**3

    def yield_moment(self, R1: Any, R2: Any, w: Any, xi: Any, P: Any, P_c: Any) -> Any:
        return 4 * self.pull_off_force(R1, R2, w) * self.factor(P, P_c) * xi

    def contact_radius_maugis(self, R1: Any, R2: Any, w: Any, E: Any, z0: Any, P: Any) -> Any:
        """Return the contact radius a at a load, from Maugis' two equations for a and m = c/a.

        They are solved for v = 1/√(m² − 1), where c is the outer radius of the attractive ring. The arguments must be
        decimals.
        """
        R, K = self.reduced(R1, R2), 4 * E / 3
        unit_force = self.pi * w * R
        lambda_ = 2 * 16 * w / (9 * self.sqrt(Decimal(3)) * z0) / self.cbrt(self.pi * w * K**2 / R)

        def state(v: Any) -> tuple[Any, Any]:
            """Return the contact radius and the load at a value of v, in Maugis' units."""
            m = self.sqrt(1 + 1 / v**2)
            t, angle = 1 / v, _arc_tangent(1 / v)
            ring = lambda_ / 2 * (t + (m**2 - 2) * angle)
            both = 4 * lambda_**2 / 3 * (t * angle - m + 1)
            a = 2 / (both + self.sqrt(both**2 + 4 * ring))
            return a, a**3 - lambda_ * a**2 * (t + m**2 * angle)

        given = {"work_of_adhesion": w, "reduced_radius": R, "transition_parameter": lambda_, "load": P}
        near = Frame({name: float(value) for name, value in given.items()})["edge_ratio_at_load"]
        v = _root(lambda v: state(v)[1] - P / unit_force, Decimal(near))
        return state(v)[0] * self.cbrt(unit_force * R / K)


def _arc_tangent(value: Decimal) -> Decimal:
    """Return the arc tangent from its series, with an angle that is halved eight times."""
    for _ in range(8):
        value = value / (1 + (1 + value * value).sqrt())
    total, power, number = value, value, 1
    while abs(power) > abs(total).scaleb(-DIGITS):
        power, number = -power * value * value, number + 2
        total += power / number
    return 2**8 * total


def _root(function: Callable[[Decimal], Decimal], near: Decimal) -> Decimal:
    """Return the root of a function near a value, by the secant method."""
    last, root = near, near * (1 + Decimal("1e-9"))
    value_at_last = function(last)
    while abs(root - last) > abs(root).scaleb(-25):  # the error after the last step is far smaller
        value = function(root)
        last, root, value_at_last = root, root - value * (root - last) / (value - value_at_last), value
    return root


PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494459")
DECIMALS = Equations(Decimal.sqrt, lambda value: value ** (1 / Decimal(3)), PI, Decimal("1e-30"))
DOUBLES = Equations(numpy.sqrt, numpy.cbrt, numpy.pi, 1e-15)


def exact(quantity: str, point: Mapping[str, float]) -> tuple[Decimal, float]:
    """Return a quantity at a point of doubles, computed with 60 digits, and its condition κ.

    κ is the relative error of the quantity per relative error of the load or the approach and, for Maugis, of λ.
    """
    equation = getattr(DECIMALS, quantity)
    names = inputs_taken(equation)

    def value_of(moved: str = "") -> Decimal:
        """Return the quantity, with one of the inputs moved by a step."""
        inputs = {name: Decimal(point[name]) for name in names}
        if moved:
            inputs[moved] *= 1 - _STEP
        value: Decimal = equation(*inputs.values())
        return value

    with localcontext(prec=DIGITS):
        value = value_of()
        varied = {"load", "approach_at_load", "atomic_spacing"}.intersection(names)  # λ is inverse to z0
        slopes = [abs(value_of(name) / value - 1) / _STEP for name in varied] if value else []
    return value, float(sum(slopes))


# --- Ways of doubles --------------------------------------------------------------------------------------------------


def _by_quartic(delta: Any, delta0: Any) -> Any:
    """Return x = (a/a0)^(3/2) from the quartic of the contact radius a, as codes for many particles do.

    Parteli et al., Sci. Rep. 4, 6227 (2014), solve a⁴ − 2Rδa² − 4πw(1−ν²)R²/E a + R²δ² = 0. Here a is in units of a0,
    with a0² = 3Rδ0 and 2πwR²/E* = 4a0³/9.
    """
    ratio = delta / delta0
    c0, c1, c2 = ratio**2 / 9, -4 / 9, -2 * ratio / 3
    p = -(c2**2) / 12 - c0
    q = -(c2**3) / 108 + c0 * c2 / 3 - c1**2 / 8
    u = cbrt(-q / 2 + sqrt(q**2 / 4 + p**3 / 27))
    s = -5 * c2 / 6 + where(p == 0, -cbrt(q), u - p / (3 * u))
    w = sqrt(c2 + 2 * s)
    a_ = (w + sqrt(w**2 - 4 * (c2 + s + c1 / (2 * w)))) / 2
    return a_ * sqrt(a_)


@cache
def _table() -> tuple[Any, Any]:
    """Return 10⁴ equidistant values of δ/δ0 from the fold to 3, and x = (a/a0)^(3/2) at each of them."""
    y = linspace(6 ** (-1 / 3), 1.26, 200_000)
    nodes = linspace(FOLD_APPROACH, 3, 10_000)
    return nodes, interp(nodes, 3 * y**4 - 2 * y, y**3)


def _radius_by_cos(R1: Any, R2: Any, w: Any, E: Any, z0: Any, P: Any) -> Any:
    """Return the contact radius by the fit of Carpick, Ogletree & Salmeron (J. Colloid Interface Sci. 211, 395, 1999).

    The coefficients are those of the code woodem/woo, pkg/dem/Hertz.cpp, which cites Eqs (7), (10), (12a) and (12b) of
    the article.
    """
    R = DOUBLES.reduced(R1, R2)
    transition = TRANSITION_OVER_TABOR * cbrt(R * (w / E) ** 2) / z0
    alpha = (1 - exp(-transition / 0.924)) / 1.02
    power, power_of_radius = 4.04 * transition**1.4, 2.28 * transition**1.3
    pull_off = pi * w * R * (7 / 4 - (power - 1) / (power + 1) / 4)
    unloaded = 1.54 + 0.279 * (power_of_radius - 1) / (power_of_radius + 1)
    spread = (alpha + sqrt(1 + P / pull_off)) / (1 + alpha)
    return unloaded * cbrt(3 / 4 * pi * w * R**2 / E * spread**2)


PRINTED = "as printed"
OTHER_WAYS: Mapping[str, Mapping[str, Way]] = {
    "pull_off_force": {PRINTED: DOUBLES.pull_off_force},
    "contact_radius_at_load": {PRINTED: DOUBLES.contact_radius_at_load},
    "stiffness": {PRINTED: DOUBLES.stiffness},
    "load_factor_at_approach": {
        "Newton on the quartic": DOUBLES.load_factor_at_approach,
        "Parteli et al. 2014": _by_quartic,
        "table of 10⁴ nodes": lambda delta, delta0: interp(delta / delta0, *_table()),
    },
    "contact_radius_maugis": {"COS 1999": _radius_by_cos},
    "yield_moment": {PRINTED: DOUBLES.yield_moment},
}
QUANTITIES = tuple(OTHER_WAYS)


# --- The measurement --------------------------------------------------------------------------------------------------

DEFAULT, FLOATS = "jkroll, arrays", "jkroll, floats"
PROMISE, PROMISE_OF_MAUGIS = 15, 40  # ulp/(1 + κ), as the guide promises


class Size(NamedTuple):
    """The size of a measurement."""

    points: int  # points in each region, to measure errors; the ordinary points also to time floats
    elements: int  # elements of the arrays that are timed
    repeats: int


FULL = Size(points=500, elements=100_000, repeats=5)
QUICK = Size(points=50, elements=20_000, repeats=2)


class Row(NamedTuple):
    """The cost and the errors of one way to compute a quantity."""

    quantity: str
    way: str
    cost: float  # in ns per point
    cube_roots: float  # the cost in units of numpy's time for a cube root
    errors: Mapping[str, Errors]  # by region; a region without points of the quantity is missing

    @property
    def worst(self) -> float:
        """The largest error in all regions."""
        return max(worst for _, worst in self.errors.values())


# --- Points -----------------------------------------------------------------------------------------------------------

Arrays = Mapping[str, Any]
REGIONS = ("ordinary", "pull-off", "fold", "δ = 0", "extreme")
_PULL_OFF_APPROACH = -(2 ** (-4 / 3))  # δ/δ0 at the pull-off force
# Ordinary inputs, and inputs of any size, lie between these powers of ten.
_ORDINARY = {
    "radius": (-8, -4), "radius2": (-8, -4), "work_of_adhesion": (-2, 0.3), "contact_modulus": (9, 11.5),
    "yield_displacement": (-10, -9.3), "atomic_spacing": (-10, -9),
}  # fmt: skip
_ANY = {
    "radius": (-12, 3), "radius2": (-12, 3), "work_of_adhesion": (-6, 2), "contact_modulus": (4, 13),
    "yield_displacement": (-12, -6),
}  # fmt: skip


def regions(count: int) -> Mapping[str, Arrays]:
    """Return points in each region: ordinary, near pull-off, near the fold, near δ = 0, and extreme.

    Ordinary points are grains of 10 nm to 100 µm under loads of −0.8 to 2 P_c, or at approaches of −0.8 to 3 δ0. The
    other points have sizes and properties of many magnitudes. Points near the fold have approaches, but no loads.
    """
    random = numpy.random.default_rng(1997)

    def powers(low: float, high: float) -> Any:
        return 10 ** random.uniform(low, high, count)

    ordinary = {name: powers(*ends) for name, ends in _ORDINARY.items()}
    any_size = {name: powers(*ends) for name, ends in _ANY.items()}
    strain = any_size["work_of_adhesion"] / any_size["contact_modulus"]
    any_size["atomic_spacing"] = numpy.cbrt(_reduced(any_size) * strain * strain) / powers(-4, 4)  # μ from 1e-4 to 1e4

    sign = numpy.sign(random.uniform(-1, 1, count))
    small, tiny = sign * powers(-15, -2), sign * powers(-18, -2)
    is_even = numpy.arange(count) % 2 == 0
    approach = numpy.where(is_even, powers(0, 6), powers(6, 29))
    load = numpy.where(is_even, tiny, powers(0, 9))
    return {
        "ordinary": _at(ordinary, random.uniform(-0.8, 3, count), random.uniform(-0.8, 2, count)),
        "pull-off": _at(any_size, _PULL_OFF_APPROACH * (1 + small), powers(-15, -2) - 1),
        "fold": _at(any_size, FOLD_APPROACH + powers(-14, -1)),
        "δ = 0": _at(any_size, tiny, -8 / 9 * (1 + small)),
        "extreme": _at(any_size, approach, load),
    }


def _reduced(sizes: Arrays) -> Any:
    return reduced_radius(radius=sizes["radius"], radius2=sizes["radius2"])


def _at(sizes: Arrays, approach_ratio: Any, load_ratio: Any = None) -> Arrays:
    """Return points at approaches in multiples of δ0 and, if given, at loads in multiples of the pull-off force."""
    points = {**sizes, "approach_at_load": approach_ratio, "approach": numpy.ones_like(approach_ratio)}
    if load_ratio is None:
        return points
    force = pull_off_force(work_of_adhesion=sizes["work_of_adhesion"], reduced_radius=_reduced(sizes))
    return {**points, "pull_off_force": force, "load": numpy.maximum(load_ratio * force, -force)}


def as_rows(points: Arrays) -> list[dict[str, float]]:
    """Return each point as a dictionary of floats."""
    columns = (column.tolist() for column in points.values())
    return [dict(zip(points, row, strict=True)) for row in zip(*columns, strict=True)]


# --- Errors and times -------------------------------------------------------------------------------------------------


def measure(size: Size, quantities: Sequence[str] = QUANTITIES) -> Iterator[Row]:
    """Measure each way to compute the quantities, and iterate over the rows."""
    points = regions(size.points)
    elements = numpy.linspace(1, 2, size.elements)
    root = _best({"cbrt": lambda: numpy.cbrt(elements)}, size.repeats)["cbrt"] / size.elements
    for quantity in quantities:
        with numpy.errstate(all="ignore"):
            yield from _measure_quantity(quantity, points, size, root)


def _measure_quantity(quantity: str, points: Mapping[str, Arrays], size: Size, root: float) -> Iterator[Row]:
    """Measure each way to compute a quantity from arrays, and the package's way also from floats.

    The package's way is that of `jkroll.solve`. `root`: the time of a cube root, in ns.
    """
    other_ways = OTHER_WAYS[quantity]

    def by_jkroll(inputs: Mapping[str, Any]) -> Any:
        return Frame(inputs)[quantity]

    def by_jkroll_from_floats(arrays: Arrays) -> list[float]:
        return [*map(by_jkroll, as_rows(arrays))]

    names = set(inputs_taken(getattr(DECIMALS, quantity)))
    for way in other_ways.values():
        names.update(inputs_taken(way))
    inputs_of_region = {}
    exacts = {}
    for region, arrays in points.items():
        if names <= arrays.keys():
            inputs_of_region[region] = {name: arrays[name] for name in names}
            exacts[region] = [exact(quantity, point) for point in as_rows(inputs_of_region[region])]
    ways: dict[str, Way] = {DEFAULT: by_jkroll}
    ways |= {name: partial(_by_symbols, way) for name, way in other_ways.items()}
    ways[FLOATS] = by_jkroll_from_floats
    ordinary = inputs_of_region["ordinary"]
    timed = {name: numpy.resize(values, size.elements) for name, values in ordinary.items()}
    timed_rows = as_rows(ordinary)
    runs: dict[str, Callable[[], Any]] = {name: partial(way, timed) for name, way in ways.items()}
    runs[FLOATS] = lambda: [*map(by_jkroll, timed_rows)]
    counts = dict.fromkeys(ways, size.elements) | {FLOATS: len(timed_rows)}
    for name, time in _best(runs, size.repeats).items():
        errors = {region: _error(ways[name](arrays), exacts[region]) for region, arrays in inputs_of_region.items()}
        yield Row(quantity, name, time / counts[name], time / counts[name] / root, errors)


def _by_symbols(way: Way, arrays: Arrays) -> Any:
    """Return the values of a way whose parameters are the paper's symbols."""
    return way(*(arrays[name] for name in inputs_taken(way)))


def _error(values: Any, exacts: Sequence[tuple[Decimal, float]]) -> Errors:
    """Return the median and the largest error of values, in ulp/(1 + κ) of the exact ones; nan has infinite error."""
    ulps = []
    for value, (exactly, condition) in zip(numpy.asarray(values).tolist(), exacts, strict=True):
        if math.isfinite(value):
            ulps.append(float(abs(Decimal(value) - exactly) / Decimal(math.ulp(exactly))) / (1 + condition))
        else:
            ulps.append(math.inf)
    return median(ulps), max(ulps)


def _best(runs: Mapping[str, Callable[[], Any]], repeats: int) -> dict[str, float]:
    """Return the shortest time of each run, in ns. The runs take turns, so that a busy machine slows all of them."""
    best = dict.fromkeys(runs, math.inf)
    for _ in range(2 * repeats):  # the first round also warms up
        for name, run in runs.items():
            start = perf_counter_ns()
            run()
            best[name] = min(best[name], perf_counter_ns() - start)
    return best


# --- The table --------------------------------------------------------------------------------------------------------

HEADS = (
    "quantity", "way", "ns_per_point", "cube_roots",
    "median_ordinary", "worst_ordinary", "median_pull_off", "worst_pull_off", "median_fold", "worst_fold",
    "median_zero_approach", "worst_zero_approach", "median_extreme", "worst_extreme",
)  # fmt: skip
LEGEND = f"""ns      nanoseconds per point
× cbrt  the same, in units of numpy's time for a cube root on this machine
others  median and largest error in ulp/(1 + κ) in a region of points, where κ is the condition number for load,
        approach or λ; the guide promises {PROMISE}, and {PROMISE_OF_MAUGIS} by Maugis
"""


def write_bench(out: TextIO, output: str, size: Size) -> list[Row]:
    """Measure all ways, write them in a format, and return the rows. A `table` has a part for each quantity."""
    if output != "table":
        rows = [*measure(size)]
        write_records(HEADS, map(_in_full, rows), output, out)
        return rows
    say(f"{machine()}\n{LEGEND}", out)
    rows = []
    for quantity, group in groupby(measure(size), lambda row: row.quantity):
        of_quantity = [*group]
        rows += of_quantity
        write_records((quantity, "ns", "× cbrt", *REGIONS), map(_in_short, of_quantity), output, out)
        say("", out)
    return rows


def machine() -> str:
    """Return the processor and the versions that the times depend on."""
    versions = f"Python {platform.python_version()}, numpy {numpy.__version__}, jkroll {__version__}"
    return f"{platform.processor() or platform.machine()}, {versions}"


def _in_full(row: Row) -> list[Cell]:
    """Return the cells of a row in full precision; a cell without a number is None."""
    cells: list[Cell] = []
    for region in REGIONS:
        for error in row.errors.get(region, (math.nan, math.nan)):
            cells.append(error if math.isfinite(error) else None)
    return [row.quantity, row.way, row.cost, row.cube_roots, *cells]


def _in_short(row: Row) -> list[Cell]:
    """Return the cells of a row with two digits, since errors and times are not known more precisely."""
    errors: list[Cell] = []
    for region in REGIONS:
        if region in row.errors:
            errors.append(" ".join(significant(number, 2) for number in row.errors[region]))
        else:
            errors.append(None)
    return [row.way, significant(row.cost, 2), significant(row.cube_roots, 2), *errors]


# --- The page ---------------------------------------------------------------------------------------------------------

# The smallest and the largest error drawn, in ulp; the largest is about as large as the value.
_NEAREST, _ALL_DIGITS = 0.1, 2.0**53


def picture_of_bench(rows: Sequence[Row]) -> Picture:
    """Return the picture of error against cost, with a panel for each quantity."""
    panels = tuple(_panel(name, [*ways]) for name, ways in groupby(rows, lambda row: row.quantity))
    caption = (
        "Each point is a way, with its largest error in all regions, in ulp/(1 + κ).",
        "Dashed: the promise of the guide. Points at 10¹⁶ have no value, or no correct digit.",
        f"{machine()}. Times are for arrays, except those of floats.",
    )
    return Picture("Error against cost of the ways to six quantities", panels, caption)


def _panel(quantity: str, rows: Sequence[Row]) -> Panel:
    """Return the panel of a quantity, with the error that the guide promises."""
    promise, law = (PROMISE_OF_MAUGIS, ", Maugis") if "maugis" in quantity else (PROMISE, "")
    x, y = Axis("time_of_a_point", 1e-10, 1e-2), Axis("error", 0.01, 1e18)
    ways = [
        Curve(row.way, numpy.array([row.cost * 1e-9]), numpy.clip([row.worst], _NEAREST, _ALL_DIGITS), number)
        for number, row in enumerate(rows)
    ]
    line = Curve("promise", numpy.array([x.low, x.high]), numpy.full(2, promise), colour=-1, is_dashed=True)
    return Panel(x, y, (*ways, line), title=NOMENCLATURE[quantity].sentence + law)
