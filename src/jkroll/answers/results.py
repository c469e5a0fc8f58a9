"""A result, and a note about an answer."""

from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Literal, NamedTuple, get_args

from ..quantities.formatting import amount
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.alternatives import at_half_spacing
from ..scene.scene import Scene

if TYPE_CHECKING:
    from ..quantities.values import Uncertain
    from ..scene.uncertainty import Propagated
else:
    Propagated = object  # a quoted type would start Python's compiler, which costs a call a millisecond


class Result:
    """A quantity in SI units, or the reason why it has no value; a text of it is rounded, as on a terminal.

    `error` is the relative error of a model of the moment, `condition` the factor by which an inferred value multiplies
    the relative error of a measured one, `growth` the largest factor by which those of two measured values enter it.
    """

    def __init__(
        self,
        name: str,
        value: float | None,
        reason: str = "",
        error: float | None = None,
        condition: float | None = None,
        growth: float | None = None,
        by_law: Mapping[str, float] = MappingProxyType({}),  # of an inferred value: what it is under the other laws
        propagated: Propagated | None = None,  # its uncertainty, if an input has one
        law: str = "",  # of attraction, if it is not JKR and gives the quantity in its own way or not at all
        of_law: str = "",  # the equation of the paper by which it does, or its source
    ) -> None:
        self.name, self.value, self.reason, self.error, self.condition = name, value, reason, error, condition
        self.growth, self.by_law, self.propagated, self.law, self.of_law = growth, by_law, propagated, law, of_law

    def __str__(self) -> str:
        return f"no value: {self.reason}" if self.measure is None else amount(self.name, self.measure)

    @property
    def unit(self) -> str:
        """The SI unit."""
        return NOMENCLATURE[self.name].unit

    @property
    def equation(self) -> str:
        """The equation that gives the quantity, or the source of its law."""
        return self.of_law if self.law else NOMENCLATURE[self.name].equation

    @property
    def source(self) -> str:
        """The equation as a text: "Eq 6", or the source of the law."""
        return f"Eq {self.equation}" if self.equation.isdigit() else self.equation

    @property
    def uncertain(self) -> "Uncertain | None":
        """The value with its error bar, if an input has one."""
        return self.propagated.uncertainty if self.propagated is not None else None

    @property
    def measure(self) -> "float | Uncertain | None":
        """The value, with its error bar if it has one."""
        return self.value if self.uncertain is None else self.uncertain


# Of notes, the most important first.
Kind = Literal["warning", "missing", "caveat", "displacement", "result", "model", "rows", "assumed", "open", "data"]


class Note(NamedTuple):
    """A sentence about an answer."""

    kind: Kind  # a warning is of a number without a meaning, "rows" counts those in doubt, "open" is what is not known
    text: str

    @property
    def line(self) -> str:
        """The sentence as a line by itself."""
        return f"{'warning' if self.kind == 'warning' else 'note'}: {self.text}"


def by_importance(notes: Iterable[Note]) -> list[Note]:
    """Return notes, the most important kind first."""
    return sorted(notes, key=lambda note: _KINDS.index(note.kind))


_KINDS = get_args(Kind)


def equation_of(scene: Scene, name: str) -> str:
    """Return the equation by which a law has a quantity: that of the paper, or the source of the law."""
    return NOMENCLATURE[scene.plan(name).name].equation or scene.law.source


def over_spacing(name: str, scene: Scene) -> str:
    """Return why a quantity that rests on the atomic spacing has no one value."""
    ends = [scene.replace(atomic_spacing=scene["atomic_spacing"]), at_half_spacing(scene)]
    texts = [f"{amount(name, end[name])} at z0 = {amount('atomic_spacing', end['atomic_spacing'])}" for end in ends]
    return f"from {' to '.join(texts)}; give --z0"


# --- Models of the rolling moment -------------------------------------------------------------------------------------

_MOMENTS = ("yield_moment", "unloaded_moment", "half_circles_moment", "fixed_approach_moment")


def model_error(name: str, scene: Scene) -> float | None:
    """Return the relative error of a model; None for the exact one, for other quantities, and where one has no value.

    At a fixed load Eq (25) is exact; at a fixed approach, there is a term in ξ³ more.
    """
    exact_model = "fixed_approach_moment" if "approach_at_load" in scene.stated else "yield_moment"
    if name not in _MOMENTS or name == exact_model:
        return None
    values = scene.numbers(name, exact_model)
    if len(values) < 2:
        return None
    return float(abs(values[name] - values[exact_model]) / values[exact_model])
