"""Doubts about an answer: scenes that may stand in place of its own, and the limits of the model in one table."""

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from functools import cache, cached_property, reduce
from math import exp, inf, nan
from operator import attrgetter, ge, gt, le, lt, or_
from typing import TYPE_CHECKING, Any, Literal

from ..errors import JkrollError
from ..materials.library import Displacement, Material
from ..physics.elementary import NUMBER, at_least, at_most, ln, quotient, where
from ..quantities.formatting import Format, amount
from ..quantities.laws import BETWEEN, DEFAULT_LAW, other_law
from ..quantities.nomenclature import INFINITY, NOMENCLATURE, STATE_OR_LOAD, XI
from ..quantities.values import Interval, ends_of, middle
from .failures import MissingInput, NotInLaw
from .scene import DEFAULTS, IN_ITS_PLACE, LEAST, Scene, takes
from .wiring import depends_on, plan_for, taken_by

if TYPE_CHECKING:
    from .uncertainty import Propagated, Sources


class Evaluation:
    """The outcomes of a scene with their inputs, error bars and doubts, each computed when something shows it.

    Rows and answers are ways to show it. Of a scene of arrays all are arrays, with nan where an element has no value.
    """

    def __init__(self, scene: Any, outcomes: Mapping[str, Any]) -> None:
        """`outcomes`: values, or the errors that say why there are none, by quantity."""
        self.scene, self.outcomes = scene, outcomes
        self.values = {name: value for name, value in outcomes.items() if not isinstance(value, JkrollError)}
        self.errors = {name: error for name, error in outcomes.items() if name not in self.values}

    def inputs_of(self, names: Sequence[str]) -> dict[str, Any]:
        """Return the inputs on which quantities depend, as they were understood, with their error bars."""
        inputs: dict[str, Any] = self.scene.echo(self.scene.inputs_used(names))
        if self.sources is not None:
            inputs |= {name: given for name, given in self.sources.given.items() if name in inputs}
        return inputs

    @cached_property
    def sources(self) -> "Sources | None":
        """The sources of uncertainty that enter; None if there are none.

        Raises a JkrollError for sources that do not go together.
        """
        if not self.scene.uncertainties:
            return None
        from .uncertainty import sources_of_results

        return sources_of_results(self.scene, [*self.outcomes])

    @cached_property
    def bars(self) -> "Mapping[str, Propagated | JkrollError]":
        """The error bars of values that have some, or the errors that say why they have none."""
        if self.sources is None or not self.values:
            return {}
        from .uncertainty import uncertainties

        return uncertainties(self.scene, [*self.values], sources=self.sources)

    @cached_property
    def validity(self) -> "Sequence[Doubt]":
        """The limits of the model, judged for the values, or with the reason why not."""
        return doubts(self.scene, [*self.values])


# --- By the other law -------------------------------------------------------------------------------------------------


def at_half_spacing(scene: Scene) -> Scene:
    """Return a scene whose atomic spacing is half as large, or the least that a scene takes."""
    return scene.replace(atomic_spacing=at_least(scene["atomic_spacing"] / 2, LEAST))


def by_law_at_spacing(scene: Scene, names: Iterable[str]) -> Scene:
    """Return the scene under the other law, with its atomic spacing stated where that decides on some quantities."""
    rests = any(map(scene.by_law.may_rest_on_spacing, names))
    return scene.by_law.replace(atomic_spacing=scene.by_law["atomic_spacing"]) if rests else scene.by_law


def rolling(names: Iterable[str]) -> list[str]:
    """Return those of some quantities that follow from the yield displacement, under every law the same."""
    return [name for name in names if name != XI and XI in depends_on((name,))]


def is_at_displacement(scene: Scene) -> bool:
    """Return whether equal inputs are equal displacements, and not equal hystereses."""
    return scene.given.keys().isdisjoint(IN_ITS_PLACE[1:])


def at_other_reading(scene: Scene, other: Scene) -> Scene | None:
    """Return a scene under another law with the other of equal displacement and hysteresis, or None."""
    ours, theirs = scene.numbers(XI, "hysteresis_ratio"), other.numbers("hysteresis_ratio")
    if len(ours) < 2 or not theirs:
        return None
    displacement, without_contact = ours[XI], DEFAULTS[XI]
    if is_at_displacement(scene):
        displacement = displacement * (ours["hysteresis_ratio"] / theirs["hysteresis_ratio"])
        without_contact = ours[XI]
    displacement = where(takes(XI, displacement), displacement, without_contact)
    return other.replace(**{**dict.fromkeys(IN_ITS_PLACE), XI: displacement})


def has_other_formulas(scene: Scene, name: str, law: str = DEFAULT_LAW) -> bool:
    """Return whether a law has a quantity by other formulas than a scene, or does not have it."""
    return scene.plan(name).steps.keys() != plan_for(name, *scene.kind[:2], law).steps.keys()


def moved_by_law(scene: Scene, names: Iterable[str]) -> list[str]:
    """Return those of some quantities that the other law has by formulas of its own, or alone."""
    other = scene.by_law
    return [name for name in other.possible(names) if has_other_formulas(scene, name, other.law.name)]


def factor_of_law(scene: Scene, names: Collection[str]) -> Any:
    """Return how far the answers to these names are from those under the law that holds, as the factor of the farthest.

    A rolling quantity is compared at equal displacement and at equal hysteresis, a pull-off force with Lennard-Jones'
    law, too. The factor is infinite where only the law in use has an answer, or answers differ in sign.
    """
    if scene.law.name == BETWEEN:
        return 1.0
    ours = scene.numbers(*moved_by_law(scene, names))
    other = by_law_at_spacing(scene, ours)
    compared = [*other.evaluate([*ours]).items()]
    rolled = rolling(ours)
    if rolled and (reading := at_other_reading(scene, other)) is not None:
        compared += reading.evaluate(rolled).items()
    if "pull_off_force" in ours:
        fit = scene.evaluate(["pull_off_force_lennard_jones"])
        compared += (("pull_off_force", value) for value in fit.values())
    return farthest((theirs, ours[name]) for name, theirs in compared)


def farthest(answers: Iterable[tuple[Any, Any]]) -> Any:
    """Return the factor between two answers, or its inverse if larger, of those that are farthest apart; 1 without any.

    It is infinite where the first answer does not exist, or signs differ, and 1 where the second is none or 0.
    """
    ratios: list[Any] = [1.0]
    ratios += (quotient(0.0 if isinstance(theirs, JkrollError) else theirs, ours, 1.0) for theirs, ours in answers)
    least, most = reduce(at_most, ratios), reduce(at_least, ratios)
    is_positive = least > 0
    return where(is_positive, at_least(most, 1 / where(is_positive, least, 1.0)), INFINITY)


# --- By measured forces -----------------------------------------------------------------------------------------------

SIO2, POLYSTYRENE = "SiO2", "polystyrene"
# Rolling forces on pairs of SiO2 spheres, and these pairs: Heim et al. 1999, Blum & Wurm 2000, Gundlach et al. 2011.
FORCES = 0.85e-9, 1.21e-9
ROLLED = {"radius": 0.95e-6, "surface_energy": 0.025, "youngs_modulus": 54e9, "poisson_ratio": 0.17}
_OF_POLYSTYRENE = Displacement(Interval(42e-9, 42e-9, 42e-9), 1e-5)  # spheres of 5 µm on a plane: Sümer & Sitti
# The radii of identical pairs to which it is scaled, and the surface energies that these spheres may have.
_NEAR = {SIO2: ((1e-7, 3e-6), (0.02, 0.025)), POLYSTYRENE: ((3e-6, 1e-4), (0.0, INFINITY))}


def measured_solid(material: Material) -> str:
    """Return the solid on which rolling was measured, if a material is of it.

    The spheres of SiO2 had the surface energy of humid silica. That of ice was itself scaled from rolling forces.
    """
    if SIO2 in material.aliases:
        return SIO2
    return POLYSTYRENE if material.name in (POLYSTYRENE, "polystyrene-glassy") else ""


def assumes_displacement(scene: Scene) -> bool:
    """Return whether the paper's displacement is assumed where rolling begins, under a law by which forces mean one."""
    return XI in scene.values and scene.given.keys().isdisjoint(IN_ITS_PLACE) and not scene.plan("yield_force").lacking


def solid_of_pair(scene: Scene) -> str:
    """Return the solid on which rolling was measured, if both spheres are of it."""
    solid = scene.material
    measured = measured_solid(solid) if solid is not None else ""  # none of several, whose properties are arrays
    return measured if scene.material2 in (None, solid) else ""


def rolled_solid(scene: Scene) -> str:
    """Return the solid on which rolling was measured, if both spheres are of it, whatever their size, and ξ assumed."""
    solid = solid_of_pair(scene)
    return solid if solid and assumes_displacement(scene) else ""


def is_like_rolled(scene: Scene) -> Any:
    """Return whether spheres have the solid, size and γ of those that were rolled, by element for arrays."""
    solid = rolled_solid(scene)
    if not solid:
        return False
    known = scene.numbers("work_of_adhesion", "reduced_radius")
    (least, most), (low, high) = _NEAR[solid]
    radius, energy = 2 * known.get("reduced_radius", 0.0), known.get("work_of_adhesion", 0.0) / 2
    return (least <= radius) & (radius <= most) & (low <= energy) & (energy <= high)


def displacements_where_measured(scene: Scene) -> tuple[float, float]:
    """Return the displacements that forces on SiO2 mean, with the work of adhesion, modulus and law in use."""
    ours = scene.numbers("work_of_adhesion", "contact_modulus") if rolled_solid(scene) == SIO2 else {}
    given = {"radius": ROLLED["radius"], **ours} if len(ours) == 2 else ROLLED
    spacing = {"atomic_spacing": scene.values["atomic_spacing"]} if "atomic_spacing" in scene.values else {}
    pair = Scene({**given, **spacing, XI: DEFAULTS[XI]}, model=scene.law.name)
    low, high = (DEFAULTS[XI] * (force / pair["yield_force"]) for force in FORCES)
    return low, high


def measured_displacement(scene: Scene) -> Interval:
    """Return the displacement that forces on the solid of a scene mean, scaled to its radii."""
    displacement = _OF_POLYSTYRENE
    if rolled_solid(scene) == SIO2:
        low, high = displacements_where_measured(scene)
        displacement = Displacement(Interval.of((low + high) / 2, low=low, high=high), ROLLED["radius"])
    return displacement.scaled(2 * scene["reduced_radius"])


def at_least_measured(scene: Scene) -> Scene:
    """Return the scene with the least displacement that forces on the same solid mean."""
    return scene.replace(**{XI: measured_displacement(scene).low})


def at_most_measured(scene: Scene) -> Scene:
    """Return the scene with the largest displacement that forces on the same solid mean."""
    return scene.replace(**{XI: measured_displacement(scene).high})


def at_full_hysteresis(scene: Scene) -> Scene:
    """Return the scene with the displacement at which all of the work of adhesion is lost."""
    return scene.replace(**{XI: scene[XI] / scene["hysteresis_ratio"]})


def factor_of_data(scene: Scene, names: Collection[str]) -> Any:  # noqa: ARG001
    """Return how far the assumed ξ is from what forces on the same solid mean, as the larger factor; 1 without any."""
    factor = farthest((end, scene[XI]) for end in ends_of(measured_displacement(scene)))
    return where(is_like_rolled(scene), factor, 1.0)


# --- What may stand in place of results -------------------------------------------------------------------------------

DATA = "data"  # the kind of an alternative by measured forces; one by another law has the law's name


def names_with_alternatives(scenes: Sequence[Scene], names: Sequence[str]) -> dict[str, list[str]]:
    """Return the quantities that have alternatives, by kind: the name of the other law, and DATA.

    `scenes`: of each kind of rows. Where they are under several laws, the other law is the one that holds between them.
    """
    others = {other_law(scene.law.name) for scene in scenes}
    law = others.pop() if len(others) == 1 else BETWEEN
    moved = {name for scene in scenes for name in moved_by_law(scene, names)}
    rolled = {name for scene in scenes if assumes_displacement(scene) for name in rolling(names)}
    return {law: [name for name in names if name in moved], DATA: [name for name in names if name in rolled]}


def alternatives_of(scene: Scene, names_of: Mapping[str, Sequence[str]]) -> dict[str, dict[str, Any]]:
    """Return by kind and quantity what may stand in place of results, with error bars if the scene is uncertain.

    `names_of`: the quantities of each kind. None stands for one that has no value. A kind that a scene does not have is
    left out.
    """
    law, values = other_law(scene.law.name), {}
    if moved := names_of.get(law):
        values[law] = with_bars(scene, moved, attrgetter("by_law"))
    rolled = names_of.get(DATA)
    if rolled and (is_near := is_like_rolled(scene)) is not False:
        deciding = "yield_force", "reduced_radius"  # at the pair that was measured, and here
        lows, highs = (with_bars(scene, rolled, end, deciding) for end in (at_least_measured, at_most_measured))
        values[DATA] = {name: _between(lows[name], highs[name], is_near) for name in rolled}
    return values


def with_bars(
    scene: Scene, names: Sequence[str], alternative: Callable[[Scene], Scene], deciding: Sequence[str] = ()
) -> dict[str, Any]:
    """Return quantities of what is made of a scene, with their error bars. Sources that do not go together give none.

    `deciding`: the quantities of the scene that decide on inputs of the other one, whose sources enter, too. Raises a
    JkrollError for a scene of arrays of which some elements have no error bars.
    """
    values = dict.fromkeys(names) | alternative(scene).numbers(*names)
    if not scene.uncertainties:
        return values
    from .uncertainty import Propagated, sources_of_results, uncertainties

    try:
        sources = sources_of_results(scene, [*names, *deciding]) if deciding else None
        bars = uncertainties(scene, names, alternative, sources)
    except JkrollError:
        if scene.shape:
            raise
        return values
    return values | {name: bar.uncertainty for name, bar in bars.items() if isinstance(bar, Propagated)}


def _between(first: Any, second: Any, is_near: Any) -> Any:
    """Return the range of two values with their error bars, where it is that of spheres like those that were rolled.

    Two values that are the same are one.
    """
    if first is None or second is None:
        return None
    ends = (*ends_of(first), *ends_of(second))
    low, high = reduce(at_most, ends), reduce(at_least, ends)
    value = where(is_near, (middle(first) + middle(second)) / 2, nan)
    return value if isinstance(low, NUMBER) and low == high else Interval.of(value, low=low, high=high)


# --- Limits -----------------------------------------------------------------------------------------------------------

_COMPARISONS = {"<": lt, "<=": le, ">": gt, ">=": ge}


class Limit:
    """A number that limits the model, the quantities whose use it touches, and what follows beyond it.

    A value is in doubt where it is, for example, "<" a threshold. Several thresholds of one number stand in the order
    in which a value meets them, each with the code of the doubt.
    """

    def __init__(
        self,
        name: str,
        touches: frozenset[str],
        sign: Literal["<", "<=", ">", ">="],
        codes: Mapping[float, str],  # by threshold
        consequence: str,  # for a number beyond the threshold
        applies: Callable[[Scene, Collection[str]], bool] | None = None,  # to some answers of a scene; None: to all
        ends_meaning: bool = False,  # a number that is said to be in doubt has no meaning
        conclusion: str = "",  # the name of what follows, if it is not that of the number
        # What is judged in place of the number: of laws and data the factor between answers.
        factor: Callable[[Scene, Collection[str]], Any] | None = None,
    ) -> None:
        self.name, self.touches, self.sign, self.codes = name, touches, sign, codes
        self.consequence, self.applies, self.ends_meaning = consequence, applies, ends_meaning
        self.conclusion, self.factor = conclusion, factor
        self.threshold = next(iter(codes))  # the first one

    def is_beyond(self, number: Any, threshold: float) -> Any:
        """Return whether a number, or each element of an array, is in doubt by a threshold."""
        return _COMPARISONS[self.sign](number, threshold)

    def excess(self, number: Any) -> Any:
        """Return how far numbers are beyond the first threshold: ln of their ratio, or the distance from 0."""
        size = ln(number / self.threshold) if self.threshold else number
        return size if self.sign.startswith(">") else -size

    @property
    def bits(self) -> int:
        """All codes as bits."""
        return sum(BITS[code] for code in self.codes.values())


class Doubt:
    """A limit that was judged: its number, and what is judged, which is another where the limit has a factor.

    Both are numbers, or arrays for a scene of arrays.
    """

    def __init__(self, limit: Limit, value: Any, judged: Any, error: MissingInput | None = None) -> None:
        """`error`: why it could not be judged."""
        self.limit, self.value, self.judged, self.error = limit, value, judged, error

    @property
    def excess(self) -> Any:
        """The distance beyond the first threshold, as the logarithm of a factor."""
        return self.limit.excess(self.judged)

    @property
    def is_exceeded(self) -> bool:
        """True if the number is in doubt."""
        return bool(self.limit.is_beyond(self.judged, self.limit.threshold))

    @property
    def code(self) -> str:
        """The code of the last threshold that is passed; empty where the limit holds, UNCHECKED if not judged."""
        return codes(self.bits)

    @property
    def factor(self) -> float | None:
        """The number over the first threshold, below 1 where the limit holds; None if infinite or over 0."""
        return exp(self.excess) if self.limit.threshold and self.excess < inf else None

    @property
    def text(self) -> str:
        """The consequence of the number for an answer, with it: "contact radius below 3 atoms (a/z0 = 2.15)"."""
        if not self.is_exceeded:
            return "within the limit"
        number = amount(self.limit.name, self.value, Format(digits=3))
        return f"{self.limit.consequence} ({NOMENCLATURE[self.limit.name].symbol} = {number})"

    @property
    def bits(self) -> Any:
        """The code as a bit: a whole number, or an array."""
        if self.error is not None:
            return NOT_JUDGED
        bits: Any = 0
        for threshold, code in self.limit.codes.items():
            bits = where(self.limit.is_beyond(self.judged, threshold), BITS.get(code, 0), bits)
        return bits


# What rests on the law and on elasticity; in DMT, at an approach, the radius rests on no work of adhesion, nor does
# Q/P_c without load.
_ELASTICITY = frozenset({"work_of_adhesion", "contact_radius_at_load", "yield_force_ratio"})
_DISPLACEMENT = frozenset({"yield_displacement"})
JUMP = 0.7  # Tabor parameter below which no jump was found of a contact of Lennard-Jones' 3-9 law at fixed grips
_TURNS = frozenset({"n_roll", "n_roll_energy_balance", "n_roll_after_impact"})
IMPACT = frozenset({"energy", "energy_ratio", "speed"})
_PULLED = frozenset({"pull_off_force", "bond_number"})

LAW_MATTERS = 1.05  # factor between the answers of two laws


def _energy_over_sticking(scene: Scene, _: Collection[str]) -> Any:
    """Return an energy over the largest that sticks; with a viscous time, over that of the speed that this leads to."""
    if "viscous_time" not in scene.stated:
        return scene["energy_over_sticking"]
    known = scene.numbers("energy", "reduced_mass", "sticking_speed")
    speed = known.get("sticking_speed", inf)  # without a value, they stick at every speed
    return 2 * known["energy"] / known["reduced_mass"] / speed / speed


LAW = Limit(
    "tabor_parameter", _ELASTICITY, ">",
    {LAW_MATTERS: "law-off-5%", 1.25: "law-off-25%", 2.0: "law-off-2x"},
    "another law differs",
    factor=factor_of_law,
)  # fmt: skip
# The law of attraction; then what takes the meaning of an answer away; then what makes it inexact.
LIMITS = (
    LAW,
    Limit(
        "load_margin", frozenset({"load_factor"}), "<=", {0.0: "beyond-pull-off"},
        "only fixed grips hold this state",
        lambda scene, _: not STATE_OR_LOAD.isdisjoint(scene.stated),
        ends_meaning=True,
    ),
    Limit(
        "displacement_ratio", _DISPLACEMENT, ">=", {1.0: "xi-over-limit"},
        "ξ is too large for the formula",
        ends_meaning=True,
    ),
    Limit(
        "displacement_over_contact_radius", _DISPLACEMENT, ">", {1.0: "xi-over-contact"},
        "ξ is larger than the contact",
        ends_meaning=True,
    ),
    Limit(
        "rolling_over_sliding", frozenset({"yield_force"}), ">=", {1.0: "slides-first"},
        "the contact slides or peels off before it rolls",
        ends_meaning=True,
    ),
    Limit(
        "yield_force_fixed_load", frozenset({"yield_force_fixed_load"}), ">", {1.0: "rolls-by-itself"},
        "a load that keeps its direction rolls sphere 1 by itself: Q_P is the force that holds it back",
        factor=lambda scene, _: 1 - scene["yield_force_fixed_load"] / scene["yield_force"],  # turning over resisting
    ),
    Limit(
        "peeling_over_sliding", frozenset({"sliding_force"}), "<", {1.0: "peels-before-sliding"},
        "the contact peels off before it slides, if it is brittle",
    ),
    Limit(
        "yield_angle", frozenset({"yield_angle", "r_min"}), ">", {1.0: "large-angle"},
        "angles are small in the model",
    ),
    Limit(
        "r_min_over_radius", frozenset({"r_min"}), "<", {1.0: "bend-below-sphere"},
        "no chain bends within one of its spheres",
        ends_meaning=True,
    ),
    Limit(
        "n_grav", frozenset({"n_grav"}), "<", {1.0: "no-chain"},
        "held out level, even one sphere rolls down; it falls off where Bo is below 1",
        ends_meaning=True,
    ),
    *(
        Limit(
            "energy_over_yield", frozenset({turns}), "<=", {least: code},
            f"{energy} of the energy cannot begin rolling, {turned} has no meaning",
            ends_meaning=True,
        )
        for turns, turned, least, code, energy in (
            ("n_roll", "n_roll", 7 / 2, "does-not-roll-sliding", "2/7"),
            ("n_roll_after_impact", "n_imp", 7 / 5, "does-not-roll-after-impact", "5/7"),
            ("n_roll_energy_balance", "n_bal", 1.0, "does-not-roll", "all"),
        )
    ),
    Limit(
        "energy_over_sticking", _TURNS, ">", {1.0: "bounces"},
        "at this energy elastic spheres bounce off a held body 2: turns have no meaning; v_stick, e: of a free pair",
        lambda scene, _: not IMPACT.isdisjoint(scene.stated) and (
            "viscous_time" not in scene.stated or bool(scene.possible(["sticking_speed"]))
        ),
        ends_meaning=True,
        factor=_energy_over_sticking,
    ),
    Limit(
        "hysteresis_ratio", frozenset({"yield_moment", "yield_force"}), ">", {1.0: "moment-unexplained"},
        "adhesion hysteresis cannot supply this moment; viscous, plastic or capillary loss could",
    ),
    Limit(
        "tabor_parameter", frozenset({"sticking_energy", "sticking_speed"}), "<", {JUMP: "sticking-unsure"},
        "the contact forms and opens smoothly; adhesion alone loses almost no energy, other losses decide what sticks",
        conclusion="has_jump",
    ),
    Limit(
        "viscosity_number", frozenset({"viscous_time"}), ">", {0.0: "fitted-elsewhere"},
        "the viscous time was fitted at one size, and v_stick holds there alone; the speeds measured on silica mean "
        "23 ps for 0.6 µm and 7 ps for 0.25 µm, if γ is 25 mJ/m², and the damping is for T* well below 1",
    ),
    Limit(
        "radius", _PULLED, ">=", {1e-6: "rough-matters"},
        "rough spheres had 1/2 to 1/100 of this",
        lambda _, names: not _PULLED.isdisjoint(names),
        factor=lambda scene, _: at_most(scene["radius"], scene["radius2"]),
    ),
    Limit(
        "filling_factor", frozenset({"tensile_strength"}), ">", {1.0: "filling-out-of-range"},
        "the formula of P_tens was fitted to filling factors of 0.01 to 0.5",
        factor=lambda scene, _: at_least(scene["filling_factor"] / 0.5, 0.01 / scene["filling_factor"]),
    ),
    Limit(
        "contact_radius_in_spacings", _ELASTICITY, "<", {3.0: "few-atoms"},
        "contact radius below 3 atoms",
    ),
    Limit(
        "hertz_pressure_over_modulus", _ELASTICITY, ">", {0.1: "may-yield"},
        "more pressure than even a solid without flaws bears; no plasticity is modelled",
    ),
    Limit(
        "profile_error", _ELASTICITY, ">", {0.01: "wide-contact"},
        "contact too wide for the formulas; their shape of a sphere is off by e_h at its edge",
    ),
)  # fmt: skip

# Of an answer about one pair alone, without a code: rows of several solids are judged together, and have no name.
ASSUMED_DISPLACEMENT = Limit(
    XI, _DISPLACEMENT, ">", {1.0: ""},
    "ξ is assumed, and forces measured on the same solid mean another",
    lambda scene, _: bool(rolled_solid(scene)) and not scene.missing(["reduced_radius"]),
    factor=factor_of_data,
)  # fmt: skip

# In columns a doubt is a bit: one for each code, in their order, and a last one for limits that could not be judged.
UNCHECKED = "unchecked"
CODES = tuple(code for limit in LIMITS for code in limit.codes.values())
BITS = {code: 1 << place for place, code in enumerate((*CODES, UNCHECKED))}
ENDING_MEANING = sum(limit.bits for limit in LIMITS if limit.ends_meaning)
NOT_JUDGED = BITS[UNCHECKED]
# What is said beside codes: of those that take the meaning away, and of what was not judged.
MEANINGS = {
    code: limit.consequence.partition(";")[0] for limit in LIMITS if limit.ends_meaning for code in limit.codes.values()
}
MEANINGS[UNCHECKED] = "a limit needs an input that is not given"
EVERY_DOUBT = sum(BITS.values())


def doubts(scene: Scene, names: Collection[str], limits: Iterable[Limit] = LIMITS) -> list[Doubt]:
    """Return the limits of the answers to these names, judged or with the reason why not.

    Those whose numbers law or contact do not have are left out.
    """
    concerned = touched(scene, names, limits)
    values = scene.evaluate([limit.name for limit in concerned])
    every = []
    for limit in concerned:
        value = values[limit.name]
        if isinstance(value, MissingInput) and not isinstance(value, NotInLaw):
            every.append(Doubt(limit, nan, nan, value))
        elif not isinstance(value, JkrollError):
            factor = value if limit.factor is None else where(value == value, limit.factor(scene, names), nan)  # noqa: PLR0124
            every.append(Doubt(limit, value, factor))
    return every


def touched(scene: Scene, names: Collection[str], limits: Iterable[Limit] = LIMITS) -> list[Limit]:
    """Return the limits that concern the answers to these names."""
    used = taken_by(tuple(names), *scene.kind)
    concerned = (limit for limit in limits if not limit.touches.isdisjoint(used))
    return [limit for limit in concerned if limit.applies is None or limit.applies(scene, names)]


def bits_of(several: Iterable[Doubt]) -> Any:
    """Return the codes of doubts as bits: a whole number, or an array for a scene of arrays."""
    return reduce(or_, (doubt.bits for doubt in several), 0)


@cache  # many rows have the same doubts
def codes(bits: int) -> str:
    """Return the codes that bits stand for, the last of which is UNCHECKED, as a text."""
    return " ".join(code for code, bit in BITS.items() if bits & bit)
