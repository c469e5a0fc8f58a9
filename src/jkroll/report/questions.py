"""The questions that commands ask of a frame: the headline quantities, and all that are shown."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import chain
from types import MappingProxyType
from typing import TYPE_CHECKING

from ..quantities.nomenclature import NOMENCLATURE, UnknownQuantity, named

if TYPE_CHECKING:
    from ..model.rows import Wanted
    from ..model.sweep import Sweep


class Question:
    """The quantities that answer a question, and how they are shown."""

    def __init__(
        self,
        headline: tuple[str, ...],  # the main results; --bare writes only these
        quantities: tuple[str, ...],  # all quantities shown, in this order
        named: tuple[str, ...] = (),  # asked for by name: always shown
        without_row: tuple[str, ...] = (),  # for programs only: not in the table of an answer
        leads: Sequence[str] = (),  # sentences of the answer; words in braces are filled in by `report.leads`
        groups: Mapping[str, Sequence[str]] = MappingProxyType({}),  # at the end of a table: quantities by title
        if_stated: Mapping[str, tuple[str, ...]] = MappingProxyType({}),  # by quantity: a row needs one of these inputs
        decisive: tuple[str, ...] = (),  # quantities that decide the headline; a reader takes them, too
    ) -> None:
        self.headline, self.quantities, self.named, self.without_row = headline, quantities, named, without_row
        self.leads, self.groups, self.if_stated, self.decisive = leads, groups, if_stated, decisive

    def taken(self, names: Collection[str]) -> list[str]:
        """Return the quantities in `names` that a reader takes: those of the headline, then the decisive ones.

        A better quantity in `names` replaces one that was not asked for by name.
        """
        taken = []
        for name in (*self.headline, *self.decisive):
            better = _BETTER.get(name, name)
            if better in names and name not in self.named:
                taken.append(better)
            elif name in names:
                taken.append(name)
        return taken

    @property
    def with_row(self) -> list[str]:
        """The quantities that a table on a terminal shows."""
        return [name for name in self.quantities if name in self.named or name not in self.without_row]


def _question(
    headline: str,
    quantities: str = "",
    without_row: str = "",
    leads: str = "",
    groups: Mapping[str, str] = MappingProxyType({}),
    decisive: str = "",
) -> Question:
    """Return the question of a command; quantities are separated by blanks, sentences by line breaks.

    By default, its quantities are those of its groups, or else its headline.
    """
    every = (*(quantities or " ".join(groups.values()) or headline).split(),)
    of_titles = {title: names.split() for title, names in groups.items()}
    return Question(
        (*headline.split(),), every,
        without_row=(*without_row.split(),), leads=leads.splitlines(), groups=of_titles, decisive=(*decisive.split(),),
    )  # fmt: skip


# By quantity: the better one. With a speed, `n_roll_after_impact` has a value: the turns after hitting body 2.
_BETTER = {"n_roll": "n_roll_after_impact"}
_QUESTIONS = {
    "pull-off": _question(
        "pull_off_force",
        "pull_off_force pull_off_force_dmt pull_off_force_lennard_jones pull_off_force_rough meniscus_force "
        "kelvin_radius threshold_humidity",
        without_row="pull_off_force_dmt",
    ),
    "yield-force": _question(
        "yield_force",
        "yield_force yield_force_fixed_load yield_force_ratio yield_moment yield_angle yield_displacement",
        leads="a push of {yield_force} at its centre makes a sphere roll",
    ),
    "r-min": _question(
        "r_min", leads="a chain can be bent to the radius R_min before a contact rolls; R_min is {r_min}"
    ),
    "n-grav": _question(
        "n_grav",
        "n_grav gravity_moment bond_number",
        leads="spheres in the longest chain that stays level, held at one end: {n_grav}; in a longer one the first "
        "contact rolls",
    ),
    "frequencies": _question(
        "vertical_frequency rolling_frequency",
        "vertical_frequency rolling_frequency rolling_frequency_as_printed rolling_frequency_no_slip "
        "sliding_frequency twisting_frequency rayleigh_time",
        without_row="rolling_frequency_as_printed",
        leads="free spheres vibrate with {vertical_frequency} along their centres, {rolling_frequency} in rolling, "
        "{sliding_frequency} in sliding and {twisting_frequency} in twisting",
    ),
    "n-roll": _question(
        "n_roll",
        "n_roll_after_impact n_roll n_roll_energy_balance",
        leads="at this speed, take n_imp: after the sphere hits body 2, it makes {n_roll_after_impact} turns, if it "
        "rolls\n"
        "it makes {n_roll_energy_balance} turns if it never slips (n_bal), {n_roll} if it slides freely, by Dominik & "
        "Tielens (n_roll){or_none}",
    ),
    "contact": _question(
        "contact_radius_at_load approach_at_load",
        "contact_radius_at_load approach_at_load contact_radius approach load load_ratio contact_radius_ratio "
        "approach_ratio stiffness hertz_pressure boussinesq_pressure well_energy pull_off_work "
        "pull_off_work_at_dead_load sticking_energy",
        # the energies are those of contacts without load, see `energies`; only JKR gives the pressure of the punch
        without_row="load_ratio contact_radius_ratio approach_ratio boussinesq_pressure well_energy pull_off_work "
        "pull_off_work_at_dead_load sticking_energy",
        leads="the contact has a radius of {contact_radius_at_load} at an approach of {approach_at_load}",
    ),
    "moment": _question(
        "yield_moment",
        "yield_moment yield_displacement unloaded_moment half_circles_moment fixed_approach_moment rolling_stiffness "
        "mean_rolling_moment mean_rolling_force",
        without_row="half_circles_moment fixed_approach_moment",  # other values of the yield moment
        leads="a moment of {yield_moment} starts rolling: the threshold for a simulation\n"
        "it rolls in steps, with half of that as the mean moment, {mean_rolling_moment}",
    ),
}
# The quantities for a table of the user, if none are named.
BY_DEFAULT = tuple(dict.fromkeys(chain.from_iterable(question.quantities for question in _QUESTIONS.values())))
_CONTRARY = ("n_roll_energy_balance", "n_roll_after_impact")  # other numbers of turns, which contradict `n_roll`
_TURNS = ("n_roll", *_CONTRARY)


def _quantities_of_report() -> Iterator[str]:
    """Iterate over the headlines of the questions above, the other numbers of turns, and two further quantities."""
    for question in _QUESTIONS.values():
        shown = {*question.headline, *_CONTRARY}
        yield from (name for name in question.quantities if name in shown)
    yield from ("roll_energy_quarter_turn", "sticking_speed")


_REPORT = Question(
    tuple(chain.from_iterable(question.headline for question in _QUESTIONS.values())),
    tuple(_quantities_of_report()),
    leads=[
        "ideally smooth spheres are pulled apart by {pull_off_force}{real}",
        "a push of {yield_force} starts rolling",
        "the sticking speed is {sticking_speed}",
    ],
    if_stated=dict.fromkeys(_TURNS, ("energy", "energy_ratio", "speed")),
)
QUESTIONS: Mapping[str, Question] = {
    **_QUESTIONS,
    "report": _REPORT,
    # The report takes its headline from the questions above alone: those below have alternative conventions or details.
    "energies": _question(
        "fold_energy pull_off_work break_energy_dust_simulation sticking_energy",
        "fold_energy well_energy pull_off_work break_energy_dust_simulation pull_off_work_at_dead_load "
        "well_energy_lennard_jones dead_load_work_lennard_jones "
        "sticking_energy sticking_energy_paszun_dominik sticking_energy_pencil_code roll_energy "
        "roll_energy_quarter_turn roll_energy_half_turn sticking_speed sticking_speed_paszun_dominik "
        "sticking_speed_pencil_code",
        # `well_energy` is nearly equal to `pull_off_work`; the others are units or conventions of other authors
        without_row="fold_energy well_energy break_energy_dust_simulation sticking_energy_paszun_dominik "
        "sticking_energy_pencil_code sticking_speed_paszun_dominik sticking_speed_pencil_code",
        leads="parting the spheres takes {pull_off_work} with fixed grips, {pull_off_work_at_dead_load} at a dead "
        "load, as with the soft spring of an AFM\n"
        "rolling by a quarter turn takes {roll_energy_quarter_turn}, by Dominik & Tielens 1997\n"
        "the sticking speed is {sticking_speed}",
    ),
    "impact": _question(
        "restitution",
        "restitution sticking_speed viscosity_number lost_energy impact_pressure first_yield_pressure plastic_pressure "
        "yield_speed plastic_speed",
        decisive="sticking_speed",
    ),
    "resistances": _question(
        "yield_force sliding_force twisting_moment",
        without_row="sliding_displacement sliding_energy peeling_force peeling_radius twisting_energy",
        groups={
            "to roll": "rolling_stiffness yield_displacement yield_angle yield_force yield_moment yield_energy",
            "to slide or peel off": "sliding_or_peeling_force tangential_stiffness sliding_displacement sliding_force "
            "sliding_energy peeling_force peeling_radius",
            "to twist": "twisting_stiffness twisting_angle twisting_moment twisting_energy",
        },
    ),
    "aggregates": _question(
        "restructuring_energy disruption_energy",
        "restructuring_energy restructuring_speed restructuring_energy_ormel restructuring_speed_ormel "
        "disruption_energy disruption_speed disruption_energy_dust_simulation disruption_speed_dust_simulation "
        "compressive_strength tensile_strength",
        without_row="restructuring_energy_ormel restructuring_speed_ormel disruption_energy_dust_simulation "
        "disruption_speed_dust_simulation",
        leads="two such aggregates that collide begin to restructure at a relative speed of {restructuring_speed}, "
        "by Dominik & Tielens 1997\n"
        "they begin to break up at a relative speed of {disruption_speed}{if_smooth}, by Wada et al. 2007",
    ),
}


def quantity_named(word: str) -> str:
    """Return the name of a quantity, given its name or a synonym; for a command, the first quantity of its headline.

    >>> quantity_named("radius"), quantity_named("gamma"), quantity_named("pull-off")
    ('radius', 'surface_energy', 'pull_off_force')
    """
    name = named(word)
    if _has_values(name):
        return name
    if word not in QUESTIONS:
        raise UnknownQuantity(word)
    return QUESTIONS[word].headline[0]


def _has_values(name: str) -> bool:
    """Return whether a name belongs to a quantity with values, rather than to a word such as a material."""
    return name in NOMENCLATURE and not NOMENCLATURE[name].is_word


def quantities_named(text: str) -> tuple[list[str], list[str]]:
    """Return the quantities named in a list, and the quantities of the commands in it, which may lack inputs."""
    wanted: list[str] = []
    offered: list[str] = []
    for word in map(str.strip, text.split(",")):
        name = named(word)
        if word in QUESTIONS:
            offered += QUESTIONS[word].quantities
        elif _has_values(name):
            wanted.append(name)
        else:
            raise UnknownQuantity(word)
    return wanted, offered


def question_about(text: str) -> Question:
    """Return the question about the quantities in a list; all of them are its headline."""
    explicit, offered = quantities_named(text)
    names = tuple(dict.fromkeys((*explicit, *offered)))
    return Question(names, names, named=tuple(explicit))


def columns_in_table(question: Question, sweep: "Sweep") -> "Wanted":
    """Return the columns of a table on a terminal, with best ranges of the quantities to take."""
    wanted = sweep.wanted(question.with_row, question.named)
    return wanted.with_best(question.taken(wanted.names))
