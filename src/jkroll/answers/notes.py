"""Notes about an answer: what was assumed, whose data were used, what a result counts, what is missing."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from ..errors import JkrollError
from ..quantities.formatting import Format, amount, significant, span
from ..quantities.laws import BETWEEN
from ..quantities.nomenclature import NOMENCLATURE, STATE_OR_LOAD, XI, of_sphere
from ..scene.alternatives import assumes_displacement, rolling
from ..scene.failures import NO_END, MissingInput, grouped, without_value
from ..scene.limits import IMPACT, Doubt, doubts, touched
from ..scene.scene import DEFAULTS, OF_AREA, Scene
from ..scene.wiring import depends_on
from ..text import first_of, listed
from .results import Kind, Note, Result

if TYPE_CHECKING:
    from ..quantities.values import Uncertain
    from ..scene.uncertainty import Propagated, Source, Sources

_OF_SPINNING = ("n_roll", "n_roll_energy_balance")  # of a sphere that spins from the start
_SHORT = Format(digits=4)
MAX_NAMES = 3  # of quantities in a note
LOST = 0.01  # part of the values of uncertain inputs from which on a note says that they have no contact
CUTOFFS = (4e-10, 1.65e-10)  # the spacing of solids, and the convention: w at the one that was not given
UNLIKE = 3.0  # ratio of two surface energies from which on a note has their harmonic mean
_STICKING = (
    "speeds are low: SiO2 of 250 nm was measured to stick to a plane up to 1.9 m/s, where γ of quartz gives 0.31 m/s, "
    "of silica-dry 1.7 m/s"
)
_OF_TURNING = ("yield_force", "sliding_force", "sliding_or_peeling_force", "twisting_moment")
# The models of the rolling moment.
MOMENTS = ("yield_moment", "unloaded_moment", "half_circles_moment", "fixed_approach_moment")


def notes_on_rows(scene: Scene, names: Sequence[str]) -> list[Note]:
    """Return the notes that follow from what is given, not from numbers: the same for all rows of a kind."""
    if not (possible := scene.possible(names)):
        return []
    notes: list[Note] = []
    if scene.is_uncertain:
        from ..scene.uncertainty import sources_of_results

        with suppress(JkrollError):  # each row says which kinds do not go together
            bars = about_uncertainties({}, sources_of_results(scene, possible))
            notes += [note._replace(kind="caveat") for note in bars]  # that of some rows
    if rolling(possible, scene.law.name) and assumes_displacement(scene):
        from .alternatives import about_displacement_of_rows

        notes.append(Note("displacement", about_displacement_of_rows(scene)))
    inputs, needed = entering(scene, names)
    return [
        *notes,
        *about_given(scene, possible, inputs, needed),
        *about_conventions(scene, possible),
        *about_limits(doubts(scene, possible)),
    ]


def assumed_of_rows(scene: Scene, names: Sequence[str]) -> dict[str, str]:
    """Return what was assumed for rows of a kind, each with the option that sets it, by name."""
    return assumed(scene, entering(scene, names)[0], scene.possible(names), has_values=False)


def entering(scene: Scene, names: Sequence[str]) -> tuple[set[str], set[str]]:
    """Return the inputs of quantities, and those on which anything depends, or would if more were given.

    The atomic spacing is among the former if it enters a limit, as it enters few answers. A load that enters limits
    alone is not among the latter: it was meant for more.
    """
    possible = scene.possible(names)
    every = [*names, *(limit.name for limit in touched(scene, possible))]
    own, of_limits = {*scene.inputs_of(*possible)}, {*scene.inputs_of(*scene.possible(every))}
    needed = (own | of_limits) - (STATE_OR_LOAD - own) | depends_on(scene.missing(every), [scene.law.name])
    return own | of_limits.intersection(["atomic_spacing"]), needed


def about_given(scene: Scene, names: list[str], inputs: Collection[str], needed: Collection[str]) -> list[Note]:
    """Return the notes that follow from what is given; `inputs` and `needed`: as from `entering`."""
    texts = assumed(scene, inputs, names).values()
    steps = {step.name for step in scene.plan(*names).steps}
    return [
        *([Note("assumed", f"assumed: {', '.join(texts)}")] if texts else []),
        *(Note("result", text) for text in _about_work(scene, inputs, steps)),
        *(Note("assumption", text) for text in _about_shear(scene, steps)),
        *about_idle(scene, needed),
        *about_data(scene, inputs),
    ]


def assumed(scene: Scene, inputs: Collection[str], names: Sequence[str], *, has_values: bool = True) -> dict[str, str]:
    """Return what was assumed for some quantities, by a rule or by a value, each with the option that sets it, by name.

    `has_values`: whether a rule gives the same value in all rows of which the scene is one.
    """
    steps = {step.name for step in scene.plan(*names).steps}
    is_mixed = scene.given.get("surface_energy2", 0) != scene.given.get("surface_energy")
    rules = {}
    if "disruption_energy" in names and "contacts" not in scene.given:
        rules["contacts"] = "as many contacts as grains in each, n_c = N"
    if "shear_strength" in steps:
        rules["shear_strength"] = "τ = G/4π²"
    if "work_of_adhesion" in steps and "surface_energy2" in inputs and is_mixed:
        rules["work_of_adhesion"] = "w = 2√(γ1γ2)"
    values = scene.numbers(*rules.keys() & steps) if has_values else {}
    for name, value in values.items():
        rules[name] += f" = {amount(name, value, _SHORT)}"
    by_rule = {name: f"{rule} ({NOMENCLATURE[name].option})" for name, rule in rules.items()}
    return by_rule | {name: assumed_value(name) for name in DEFAULTS if name in inputs and name not in scene.given}


def assumed_value(name: str) -> str:
    """Return the value of an input that was assumed, with the option that sets it."""
    value = f"{symbol_of(name)} = {amount(name, DEFAULTS[name])}" if DEFAULTS[name] else "no load"
    return f"{value} ({NOMENCLATURE[name].option})"


def _about_work(scene: Scene, inputs: Collection[str], steps: Collection[str]) -> Iterator[str]:
    """Iterate over what a Hamaker constant stands for, also at another cutoff, and the harmonic mean of unlike γ."""
    if "hamaker" in inputs and not scene.missing(["work_of_adhesion"]):
        values = ((name, scene[name]) for name in ("work_of_adhesion", "atomic_spacing"))
        here = ", ".join(f"{symbol_of(name)} = {amount(name, value)}" for name, value in values)
        other = next(cutoff for cutoff in CUTOFFS if cutoff != scene["cutoff"])
        work = amount("work_of_adhesion", scene.replace(cutoff=other)["work_of_adhesion"])
        yield f"{here}; at D0 = {amount('cutoff', other)}, w = {work}"
    energies: list[Any] = [scene.values.get(name) for name in ("surface_energy", "surface_energy2")]
    is_mixed = "work_of_adhesion" in steps and "surface_energy2" in inputs
    if is_mixed and all(isinstance(one, float) for one in energies) and max(energies) > UNLIKE * min(energies):
        work = amount("work_of_adhesion", 4 / sum(1 / energy for energy in energies), _SHORT)
        yield (
            f"by the harmonic mean w = {work}; the geometric one is an upper estimate for solids so unlike: "
            "--work-of-adhesion"
        )


def _about_shear(scene: Scene, steps: Collection[str]) -> Iterator[str]:
    """Iterate over what is assumed of the contact under shear, given the quantities on the way to the results."""
    of_1 = {name: scene.given.get(name) for name in ("youngs_modulus", "poisson_ratio")}
    are_alike = all(scene.given.get(of_sphere(2, name), value) == value for name, value in of_1.items())
    if "shear_strength" in steps:
        softer = "" if are_alike else " of the softer solid, a rule of this program"
        yield f"sliding and twisting are known to an order of magnitude: τ = G/4π²{softer} (--shear-strength)"
    if "contact_shear_modulus" in steps and not are_alike:
        yield "k_s without Dundurs' coupling of unlike solids"


def about_middles(uncertain: "Mapping[str, Uncertain]") -> list[Note]:
    """Return the note where values have uncertainties and the results, of a picture or an export, have none."""
    middles = ", ".join(f"{symbol_of(name)} = {amount(name, value)}" for name, value in uncertain.items())
    return [Note("result", f"computed with the middle of {middles}")] if middles else []


def about_idle(scene: Scene, entering: Collection[str]) -> list[Note]:
    """Return a note on the inputs that were given though no result depends on them; `entering` are those that enter."""
    entering = {*entering, *(OF_AREA if scene.is_rigid else ())}  # which refuses, and so changes something
    idle = [name for name in scene.stated if name not in entering]
    return [Note("caveat", idle_in_words(idle))] if idle else []


def idle_in_words(names: Sequence[str]) -> str:
    """Return the sentence on inputs that change nothing."""
    options = [NOMENCLATURE[name].option or name for name in names]
    return f"{listed(options)} change{'' if options[1:] else 's'} no result here"


def about_data(scene: Scene, inputs: Collection[str]) -> list[Note]:
    """Return notes on the material data that were used, those on shadowed materials first."""
    used = scene.data_used(inputs)
    notes = [Note("material", f"{material.name}: {text}") for material, _ in used for text in material.remarks]
    for material, name in used:
        if name in material.notes:
            # A property whose origin is stated says what is against it.
            kind: Kind = "caveat" if name in material.origins else "data"
            notes.append(Note(kind, f"{symbol_beside(name, ())} of {material.name}: {material.notes[name]}"))
        if name == XI and material.displacement is not None:
            radius = amount("radius", material.displacement.radius)
            text = (
                f"{material.name}: ξ was measured with spheres of {radius}; elsewhere it is the range between our "
                "scalings, R^(2/3) to R"
            )
            notes.append(Note("data", text))
    return [*dict.fromkeys(notes)]


def about_results(results: Sequence[Result], scene: Scene) -> list[Note]:
    """Return notes on the values: why one stands beside a headline, what it counts, how exact its model is."""
    known = [result for result in results if result.value is not None]
    names = [result.name for result in known]
    errors = ", ".join(f"{symbol_of(result.name)} by {100 * result.error:.2g} %" for result in known if result.error)
    return [
        *about_conventions(scene, names),
        *_about_impact(scene, names),
        *_about_contact(scene, names),
        *([Note("model", f"off the exact moment of this contact: {errors}")] if errors else []),
    ]


def _about_impact(scene: Scene, names: Collection[str]) -> Iterator[Note]:
    """Iterate over notes on what happens in a collision."""
    if "sticking_speed" in names and "viscous_time" not in scene.stated:
        yield Note("result", _STICKING)
    if scene.values.get("restitution") == 0 and "restitution" in names:
        speed = amount("sticking_speed", scene["sticking_speed"])
        yield Note("result", f"e = 0: they stick, as v_stick = {speed} is not below v")
    if "n_roll" in names and IMPACT.isdisjoint(scene.stated):
        ratios = scene.numbers("energy_over_sticking").values()  # none in a law without U_stick
        size = "".join(f" is {ratio:.3g} U_stick, the largest energy that sticks" for ratio in ratios)
        yield Note("result", f"W0 = P_cδ0 of JKR{size}")


def _about_contact(scene: Scene, names: Collection[str]) -> Iterator[Note]:
    """Iterate over notes on what a contact is, what gives way first in it, and what the displacement stands for."""
    unlike = [] if scene.is_identical else [name for name in names if NOMENCLATURE[name].of_identical]
    if unlike:
        yield Note("warning", f"{first_symbols(unlike)} has no meaning here: it is of identical spheres alone")
    if "n_grav" in names and not scene.is_identical:
        chain = Scene(scene.stated_of_1, scene.material, model=scene.stated_model).numbers("n_grav").values()
        other = "".join(f"; the next, between spheres 1, yields at {carried + 1:.4g}" for carried in chain)
        yield Note("caveat", f"N_grav is what the first contact, on body 2, carries{other}")
    if {*_OF_TURNING} <= {*names}:
        yield _first_to_yield(scene)
    of_jkr = [name for name in ("sticking_energy_paszun_dominik", "sticking_energy_pencil_code") if name in names]
    if of_jkr and not scene.law.is_default:
        yield Note("result", f"{', '.join(map(symbol_of, of_jkr))}: multiples of P_cδ0 and F_cδ_c of JKR")
    if scene.law.name == BETWEEN and "contact_radius_at_load" in names and scene["contact_radius_at_load"] == 0:
        yield Note("result", "a: the spheres are bound without touching")
    if rolling(names, scene.law.name):
        from .alternatives import about_unmeasured

        if text := about_unmeasured(scene):
            yield Note("displacement", text)
        values = scene.numbers(XI, "hysteresis_ratio")
        if values.get("hysteresis_ratio", 1.0) < 1 and XI in values:
            lost = f"{significant(100 * values['hysteresis_ratio'], 2)} % of w"
            text = f"to roll at ξ = {amount(XI, values[XI])}, {lost} must be lost where the contact opens and closes"
            yield Note("model", text)


def about_conventions(scene: Scene, names: Sequence[str]) -> list[Note]:
    """Return a note for each reason why a quantity stands beside a headline."""
    by_note: dict[str, list[str]] = {}
    for name in names:
        is_implied = scene.is_identical and name == "rolling_frequency_no_slip"
        if NOMENCLATURE[name].note and not is_implied:
            by_note.setdefault(NOMENCLATURE[name].note, []).append(symbol_of(name))
    notes = [Note("model", f"{', '.join(symbols)}: {note}") for note, symbols in by_note.items()]
    spinning = [symbol_of(name) for name in _OF_SPINNING if name in names]
    if spinning and "speed" in scene.stated:
        text = "a sphere that arrives at a speed does not spin yet and turns n_imp times; one that rolls from the start"
        notes.insert(0, Note("caveat", f"{text}, {listed(spinning)}"))
    return notes


def _first_to_yield(scene: Scene) -> Note:
    """Return what yields first where a pair is pushed or turned. A brittle contact shrinks when pushed."""
    names = ("yield_force", "sliding_or_peeling_force", "yield_moment", "twisting_moment", "peeling_over_sliding")
    roll, first, bend, twist, ratio = scene.evaluate(names).values()
    gives_way = "peels off before it slides" if ratio < 1 else "slides before it peels off"
    force = span("sliding_or_peeling_force", first, first)
    rolls = "it rolls first; where it cannot, " if roll < first else ""
    pushed = f"pushed, {rolls}it {gives_way} at {force}, as the contact shrinks"
    return Note("caveat", f"{pushed}; turned, it {'rolls' if bend < twist else 'twists'} first")


def model_error(name: str, scene: Scene) -> float | None:
    """Return the relative error of a model; None for the exact one, for other quantities, and where one has no value.

    At a fixed load Eq (25) is exact; at a fixed approach, there is a term in ξ³ more.
    """
    exact_model = "fixed_approach_moment" if "approach_at_load" in scene.stated else "yield_moment"
    if name not in MOMENTS or name == exact_model:
        return None
    values = scene.numbers(name, exact_model)
    if len(values) < 2:
        return None
    return float(abs(values[name] - values[exact_model]) / values[exact_model])


def about_limits(found: Iterable[Doubt]) -> list[Note]:
    """Return a note for the limits of the model that could not be judged, by the inputs that they need."""
    subjects: dict[str, dict[str, None]] = {}
    for doubt in found:
        if doubt.error is not None:
            subjects.setdefault(doubt.error.options(), {})[doubt.limit.subject] = None
    return [Note("unchecked", f"not checked (give {give}): {', '.join(words)}") for give, words in subjects.items()]


def about_missing(results: Iterable[Result], errors: Mapping[str, JkrollError]) -> list[Note]:
    """Return a note for each reason why values are missing, with the names of all that it concerns."""
    reasons: dict[str, JkrollError] = {}
    for result in results:
        if result.value is None:
            error = errors.get(result.name)
            reasons[result.name] = (
                error if isinstance(error, MissingInput) else without_value(result.name, result.reason)
            )
    return [Note("missing", f"{first_symbols(names)}: {reason}") for names, reason in grouped(reasons)]


def about_uncertainties(found: Mapping[str, "Propagated | JkrollError"], sources: "Sources") -> list[Note]:
    """Return notes on uncertainties that do not exist, and on sources that are left out."""
    failures = {name: one for name, one in found.items() if isinstance(one, JkrollError)}
    notes = [Note("missing", f"{first_symbols(names)}: {NO_END}{reason}") for names, reason in grouped(failures)]
    values = [(source, f" = {amount(source.names[0], source.given)}") for source in sources.left_out]
    return notes + [Note("error bars", text) for text in left_out_in_words(values)]


def about_lost_contacts(scene: Scene, sources: "Sources") -> list[Note]:
    """Return a note where a load is beyond pull-off at a part of the values within the error bars of the inputs."""
    from ..scene.uncertainty import part_beyond_pull_off

    part = part_beyond_pull_off(scene, sources)
    if part < LOST:
        return []
    text = (
        f"error bars are of contacts that hold: at {100 * part:.2g} % of the uncertain values the load is beyond "
        "pull-off"
    )
    return [Note("error bars", text)]


def left_out_in_words(sources: "Iterable[tuple[Source, str]]") -> Iterator[str]:
    """Iterate over sentences on sources that enter no error bar, as others are of another kind, with their texts."""
    found: dict[str, dict[str, None]] = {}
    for source, text in sources:
        reason = "ranges are left out beside ±" if source.given.kind == "range" else "± is left out beside ranges"
        found.setdefault(reason, {})[f"{symbol_of(source.names[0])}{text}"] = None
    for reason, texts in found.items():
        yield f"error bars: {reason}: {', '.join(texts)}"


def first_symbols(names: list[str]) -> str:
    """Return the symbols of the first names of a list, and how many more there are."""
    return first_of([*map(symbol_of, names)], MAX_NAMES)


def symbol_beside(name: str, inputs: Collection[str]) -> str:
    """Return the symbol of a quantity, without the index of sphere 1 where no other value is that of sphere 2."""
    quantity = NOMENCLATURE[name]
    is_of_both = quantity.sphere == 1 and quantity.twin not in inputs and name != "radius"
    return symbol_of(name).removesuffix("1") if is_of_both else symbol_of(name)


def symbol_of(name: str) -> str:
    """Return the symbol of a quantity, or its name if it has none."""
    return NOMENCLATURE[name].symbol or name
