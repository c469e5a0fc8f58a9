"""Laws of attraction from JKR to DMT, and the formulas of each law.

A law consists of tables of routes, from the name of a quantity to the formula that gives it: "pull_off_force" leads to
"pull_off_force_maugis" under Maugis' law. A plan follows the routes wherever a name occurs, so quantities that depend
on others (`n_grav` on the moment, `vertical_frequency` on the stiffness) need no route of their own. None marks a
quantity that the law does not have. A name without a route has the formula of the same name. A formula to which only
one law has a route belongs to that law. Another law refuses the formula if it needs values that the two laws compute
differently.

The profile of body 1 is also part of a law: JKR's law of a paraboloid and JKR's law of a true sphere are two `Law`s,
and the profile selects one.

A new law needs a `Law` here, its formulas in `physics`, and its reference in `write/references.toml`. If its force
curve has several states at a load, `set_by` is an input that tells them apart, and `report.curve` must name them. If it
lacks quantities, `model.reasons` must give the reasons. The nomenclature takes the names of the law's formulas from the
routes.
"""

from collections.abc import Collection, Mapping, Sequence
from functools import cache
from itertools import chain

from ..errors import BadRequest
from ..text import closest, listed, quoted

Routes = Mapping[str, str | None]

PARABOLOID, SPHERE = PROFILES = ("paraboloid", "sphere")  # shapes of body 1

# The names of states of a force curve: single states, and the branches between them.
FOLD, PULL_OFF, JUMP_IN, EQUILIBRIUM = "fold", "pull-off", "jump-in", "equilibrium"
STABLE, FIXED_GRIPS, UNSTABLE, WITHOUT_CONTACT = "stable", "fixed grips", "unstable", "without contact"
HELD_BY_LOAD = frozenset({STABLE, PULL_OFF, JUMP_IN, EQUILIBRIUM})  # states that need no grips


class Law:
    """A law of attraction. The key of a table of routes is the input with which the table applies, or `ALWAYS`."""

    def __init__(
        self,
        name: str,
        title: str,
        source: str,  # the reference of results without an equation in the paper
        tables: Mapping[str, Routes],
        omits: frozenset[str] = frozenset(),  # quantities not shown under this law
        by_spacing: frozenset[str] = frozenset(),  # formulas that the atomic spacing decides if Maugis' λ < 1
        profile: str = PARABOLOID,
        set_by: str = "load",  # the input that sets a state of the force curve
    ) -> None:
        self.name, self.title, self.source, self.profile, self.set_by = name, title, source, profile, set_by
        self.tables, self.omits, self.by_spacing = tables, omits, by_spacing

    @property
    def short(self) -> str:
        """The title without a second author: "Maugis" for Maugis–Dugdale."""
        return self.title.partition("–")[0]

    @property
    def words(self) -> Mapping[str, str]:
        """The name and the value of the input that selects the law."""
        return {"model": self.name} if self.profile == PARABOLOID else {"profile": self.profile}

    @property
    def is_default(self) -> bool:
        """True for the paper's law."""
        return self.name == DEFAULT_LAW


ALWAYS = ""  # the key of a table that needs no input
RESULTS_BY_LENNARD_JONES = (
    "pull_off_force_lennard_jones", "well_energy_lennard_jones", "dead_load_work_lennard_jones"
)  # fmt: skip
_OF_EVERY_LAW: Mapping[str, Routes] = {
    ALWAYS: {
        "edge_ratio": "edge_ratio_at_load",  # Maugis' edge ratio exists under any law
        "restructuring_energy_ormel": "roll_energy_quarter_turn",
    },
    "speed": {"energy": "kinetic_energy"},
    "modulus_over_energy": {"contact_modulus": "contact_modulus_of_ratio"},
    "adhesion_hysteresis": {"yield_displacement": "yield_displacement_at_hysteresis"},
    "hysteresis_fraction": {
        "adhesion_hysteresis": "adhesion_hysteresis_of_fraction",
        "yield_displacement": "yield_displacement_at_hysteresis",
    },
    "hamaker": {"work_of_adhesion": "work_of_adhesion_of_hamaker", "atomic_spacing": "atomic_spacing_of_cutoff"},
    "hamaker2": {"work_of_adhesion": "work_of_adhesion_of_hamaker"},
    "approach_at_load": {
        "edge_ratio": "edge_ratio_at_approach",
        "zone_span": "zone_span_at_approach",
        "approach_maugis_at_load": "approach_maugis",  # the formula at a load would use JKR's load under JKR
    },
}

_JKR = Law(
    name="jkr",
    title="JKR",
    source="",
    tables={
        ALWAYS: {"zone_radius": "contact_radius_at_load"},
        "viscous_time": {"sticking_speed": "sticking_speed_viscous"},
        "load_factor": {"load": "load_at_factor", "load_margin": "load_margin_of_factor"},
        "load_margin": {"load": "load_at_factor"},
        "approach_at_load": {
            "load": "load_at_factor",
            "load_factor": "load_factor_at_approach",
            "load_margin": "load_margin_at_approach",
        },
    },
    omits=frozenset(RESULTS_BY_LENNARD_JONES),
    set_by="load_factor",
)

_PEAK_OF_JKR = ("impact_pressure", "touch_pressure", "yield_speed", "plastic_speed")  # computed from JKR's energies

# Routes of Maugis' law and of DMT: to formulas that use the law's own force and radius, and None for quantities that
# are given in JKR only.
_OUTSIDE_JKR: Routes = {
    "unloaded_moment": "unloaded_moment_of_radius",
    "yield_force": "yield_force_of_moment",
    "yield_force_ratio": "yield_force_ratio_of_forces",
    "rolling_frequency_no_slip": "rolling_frequency_no_slip_of_stiffness",
    "yield_energy": "yield_energy_of_moment",
    "boussinesq_pressure": None,
    "half_circles_moment": None,
    "fixed_approach_moment": None,
    "displacement_limit": None,
    "viscosity_number": None,
    **dict.fromkeys(_PEAK_OF_JKR),
    # the area that slides may be the contact or the zone of attraction, which is 6 times as large for 100 nm of quartz
    "sliding_force": None,
    "sliding_displacement": None,
    "sliding_energy": None,
    "twisting_moment": None,
    "twisting_angle": None,
    "twisting_energy": None,
    "peeling_force": None,
    "peeling_radius": None,
    "load_factor": None,
    "load_margin": None,
}

_MAUGIS = Law(
    name="maugis",
    title="Maugis–Dugdale",
    source="Maugis 1992",
    tables={
        ALWAYS: {
            **_OUTSIDE_JKR,
            "pull_off_force": "pull_off_force_maugis",
            "contact_radius": "unloaded_radius_maugis",
            "approach": "unloaded_approach_maugis",
            "contact_radius_at_load": "contact_radius_maugis",
            "approach_at_load": "approach_maugis",
            "contact_radius_at_pull_off": "contact_radius_at_pull_off_maugis",
            "approach_at_pull_off": "approach_at_pull_off_maugis",
            "contact_radius_at_fold": "contact_radius_at_fold_maugis",
            "approach_at_fold": "fold_approach_maugis",
            "stiffness": "stiffness_maugis",
            "adhesive_force": "adhesive_force_maugis",
            "contact_displacement": "contact_displacement_maugis",
            "well_energy": "well_energy_maugis",
            "pull_off_work": "pull_off_work_maugis",
            "pull_off_work_at_dead_load": "pull_off_work_at_dead_load_maugis",
            "sticking_energy": "sticking_energy_maugis",
            "fold_energy": "fold_energy_maugis",
        },
        "viscous_time": {"sticking_speed": None},  # the damping was computed for JKR's force curve
        "load": {"approach_at_load": "approach_maugis_at_load"},
        "edge_ratio": {"load": "load_maugis"},
        "approach_at_load": {"load": "load_maugis"},
    },
    omits=frozenset({"rolling_frequency_as_printed", *_PEAK_OF_JKR}),
    by_spacing=frozenset({"sticking_energy_maugis"}),
    set_by="edge_ratio",
)

_DMT = Law(
    name="dmt",
    title="DMT",
    source="Derjaguin, Muller & Toporov 1975",
    tables={
        ALWAYS: {
            **_OUTSIDE_JKR,
            "pull_off_force": "pull_off_force_dmt",
            "contact_radius": "unloaded_radius_dmt",
            "approach": "unloaded_approach_dmt",
            "contact_radius_at_load": "contact_radius_dmt",
            "approach_at_load": "approach_dmt",
            "contact_radius_at_pull_off": None,  # the contact shrinks to a point, at δ = 0
            "approach_at_pull_off": None,
            "contact_radius_at_fold": None,
            "approach_at_fold": None,
            "stiffness": "stiffness_dmt",
            "adhesive_force": "adhesive_force_dmt",
            "contact_displacement": "contact_displacement_dmt",
            "zone_radius": None,
            "well_energy": None,
            "pull_off_work": None,
            "pull_off_work_at_dead_load": None,
            "sticking_energy": None,
            "fold_energy": None,
        },
        "approach_at_load": {"load": "load_dmt", "contact_radius_at_load": "contact_radius_dmt_at_approach"},
    },
    omits=frozenset({"rolling_frequency_as_printed", *RESULTS_BY_LENNARD_JONES, "pull_off_force_dmt", *_PEAK_OF_JKR}),
    set_by="approach_at_load",
)

# JKR's law for a rigid sphere of true shape on a soft plane. It gives the contact, but no quantity that depends on
# JKR's energies or adhesive force.
_OF_SPHERE = Law(
    name="jkr-sphere",
    title="JKR, sphere",
    source="Sneddon's sphere, as in code AFM-analysis/nanite",
    tables={
        ALWAYS: {
            **dict.fromkeys(_OUTSIDE_JKR),
            "pull_off_force": "pull_off_force_sphere",
            "contact_radius": "unloaded_radius_sphere",
            "approach": "unloaded_approach_sphere",
            "contact_artanh": "artanh_at_load",
            "contact_radius_at_load": "contact_radius_sphere",
            "approach_at_load": "approach_sphere",
            "contact_radius_at_pull_off": "contact_radius_at_pull_off_sphere",
            "approach_at_pull_off": "approach_at_pull_off_sphere",
            "contact_radius_at_fold": "contact_radius_at_fold_sphere",
            "approach_at_fold": "approach_at_fold_sphere",
            "stiffness": "stiffness_sphere",
            "contact_over_sphere": "contact_over_sphere_of_ratio",
            "hertz_pressure_over_modulus": "strain_of_contact",
            "hertz_pressure": None,
            "profile_error": None,
            "adhesive_force": None,
            "well_energy": None,
            "pull_off_work": None,
            "pull_off_work_at_dead_load": None,
            "sticking_energy": None,
            "fold_energy": None,
            "zone_radius": None,
        },
        "approach_at_load": {"load": "load_sphere", "contact_artanh": "artanh_at_approach"},
    },
    omits=frozenset({*RESULTS_BY_LENNARD_JONES, "pull_off_force_dmt", "pull_off_force_rough"}),
    profile=SPHERE,
)

LAWS: Mapping[str, Law] = {law.name: law for law in (_JKR, _MAUGIS, _DMT, _OF_SPHERE)}
JKR, MAUGIS, DMT, JKR_OF_SPHERE = _JKR.name, _MAUGIS.name, _DMT.name, _OF_SPHERE.name
MODELS = tuple(name for name, law in LAWS.items() if law.profile == PARABOLOID)  # the values of --model
DEFAULT_LAW = JKR
BETWEEN = MAUGIS  # the law for contacts between JKR and DMT


def other_law(name: str) -> str:
    """Return the law to compare with: Maugis' law or, if that is in use, JKR."""
    return DEFAULT_LAW if name == BETWEEN else BETWEEN


def law_given(model: str | None, profile: str | None = None) -> str | None:
    """Return the name of the law for a model and a profile, typed in any case; None for the default.

    Raises BadRequest for unknown words, and for a true sphere under a law other than JKR.
    """
    name = None if model is None else _one_of(MODELS, "model", model)
    if profile is None or _one_of(PROFILES, "profile", profile) == PARABOLOID:
        return name
    if name not in (None, DEFAULT_LAW):
        raise BadRequest(f"profile {SPHERE}: only JKR has it; leave out model {name}, or take the profile {PARABOLOID}")
    return JKR_OF_SPHERE


def laws_given(models: Sequence[str | None], profile: str | None = None) -> list[str | None]:
    """Return the names of the laws for several models, see `law_given`. Raises BadRequest if two are one law."""
    laws = [law_given(name, profile) for name in models]
    if len({*laws}) < len(laws):
        raise BadRequest(f"model: {listed(map(str, models))} are one law; give each law once")
    return laws


def _one_of(words: Collection[str], option: str, word: str) -> str:
    """Return a word in lower case; raise BadRequest if the option does not accept it."""
    if not isinstance(word, str) or word.casefold() not in words:
        guess = closest(str(word), words)
        meant = f"; did you mean {guess}?" if guess else ""
        raise BadRequest(f"{option}: {quoted(str(word), 40)} is not one of {', '.join(words)}{meant}")
    return word.casefold()


def tables_of(law: Law) -> list[tuple[str, Routes]]:
    """Return all tables of routes of a law with their keys; later tables override earlier ones."""
    return [*_OF_EVERY_LAW.items(), *law.tables.items()]


@cache
def routes(model: str, known: frozenset[str]) -> Routes:
    """Return the routes of a law that apply with these known inputs."""
    formulas: dict[str, str | None] = {}
    for key, table in tables_of(LAWS[model]):
        if key == ALWAYS or key in known:
            formulas |= table
    return formulas


@cache
def routes_anywhere(models: tuple[str, ...] = tuple(LAWS)) -> Mapping[str, list[str]]:
    """Return the formulas of some laws for each quantity, whatever inputs are known."""
    formulas: dict[str, list[str]] = {}
    for model in models:
        for _, table in tables_of(LAWS[model]):
            for name, route in table.items():
                if route is not None:
                    formulas.setdefault(name, []).append(route)
    return formulas


@cache
def law_of(formula: str) -> str | None:
    """Return the law of a formula to which only one law has a route; None for other formulas."""
    laws = [model for model in LAWS if formula in {*chain.from_iterable(routes_anywhere((model,)).values())}]
    return laws[0] if len(laws) == 1 else None


@cache
def has_formula_for_sphere(name: str) -> bool:
    """Return whether a quantity has its own formula for a sphere of true shape."""
    return _OF_SPHERE.tables[ALWAYS].get(name) is not None


@cache
def varies_by_law(name: str) -> bool:
    """Return whether some law has its own formula for a quantity, or does not have the quantity."""
    return any(name in law.tables[ALWAYS] for law in LAWS.values())
