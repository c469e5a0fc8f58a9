"""The Python face of an answer: what a command prints, as an object."""

from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Any, NamedTuple

from ..answers.answer import Answer
from ..answers.questions import QUESTIONS, Question, question_about
from ..answers.results import Result
from ..materials.library import Material, Materials
from ..quantities.errors import QuantityError, UnknownQuantity
from ..quantities.formatting import AS_USUAL
from ..quantities.nomenclature import NOMENCLATURE, named
from ..quantities.values import Uncertain, is_uncertain
from ..scene.scene import Scene
from ..scene.solver import in_si, materials_of
from .records import as_object


class Exceeded(NamedTuple):
    """A limit of the model that does not hold; a text of it is the sentence."""

    text: str
    code: str
    name: str  # of the number that limits the model
    value: float  # of that
    limit: float  # the first threshold of what is judged: of a law, of the factor between answers
    factor: float | None  # how many times that is beyond it; None if it is infinite, or the limit 0

    def __str__(self) -> str:
        return self.text


class Answered:
    """The answer to a question about one scene.

    `values` are the results by name, `inputs` what was understood and assumed, `doubts` the limits of the model that do
    not hold, `alternatives` what may stand in place of the values, `notes` the other sentences. `as_dict()` is the
    object of `--json`.
    """

    def __init__(self, found: Answer) -> None:
        self._found = found

    @cached_property
    def values(self) -> Mapping[str, Result]:
        """The results by name, in SI units."""
        return {result.name: result for result in self._found.results}

    @cached_property
    def inputs(self) -> Mapping[str, float | str | Uncertain]:
        """The inputs on which the results depend, in SI units, with their error bars."""
        return self._found.measures

    @cached_property
    def doubts(self) -> tuple[Exceeded, ...]:
        """The limits of the model that do not hold, the one that is exceeded most first."""
        return tuple(
            Exceeded(
                self._found.about(doubt),
                doubt.code,
                doubt.limit.name,
                doubt.value,
                doubt.threshold or 0.0,
                doubt.factor,
            )
            for doubt in self._found.exceeded
        )

    @cached_property
    def alternatives(self) -> Mapping[str, Mapping[str, float | Uncertain | None]]:
        """The values that may stand in place of these: "maugis", by the law that holds, "data", by measured forces."""
        return self._found.alternatives

    @cached_property
    def notes(self) -> tuple[str, ...]:
        """The other sentences: what was assumed, what the material's source says, what contradicts a result."""
        return tuple(note.text for note in self._found.notes)

    def as_dict(self) -> dict[str, Any]:
        """Return the object that the command prints with `--json`."""
        return as_object(self._found, AS_USUAL)

    def __getitem__(self, name: str) -> Result:
        """Return the result of a name, or of a symbol."""
        return self.values[named(name, self.values)]

    def __repr__(self) -> str:
        texts = (
            f"{NOMENCLATURE[name].symbol} = {'no value' if value.value is None else value}"
            for name, value in self.values.items()
        )
        return f"<Answered: {', '.join(texts)}>"

    def __str__(self) -> str:
        values = [f"{name} = {value}" for name, value in self.values.items()]
        doubts = [note.text for note in self._found.doubts()]
        return "\n".join([*values, *doubts, *self.notes])


def answer(
    wanted: str | Iterable[str],
    /,
    *,
    material: str | Material | None = None,
    material2: str | Material | None = None,
    materials: Materials | None = None,
    model: str | None = None,
    **given: Any,
) -> Answered:
    """Answer a question about one scene, with all that is to be said of the numbers.

    Parameters
    ----------
    wanted
        A command, such as "pull-off" or "report", or names of quantities, as for `solve`.
    material, material2, materials, model, **given
        The scene, as `solve` takes it, but for arrays.

    Returns
    -------
    An object with `values` by name, `inputs`, `doubts`, `notes` and `as_dict()`. All numbers are in SI units.

    Raises
    ------
    MissingInput, UnknownMaterial, UnknownQuantity, QuantityError
        An input is wrong, or one is missing without which there is no result.
    NoResult
        There is no contact, or no result at all. A single result without a value has a reason instead.

    >>> found = answer("pull-off", material="quartz", radius="100 nm")
    >>> str(found["pull_off_force"]), found["P_c"].unit
    ('11.781 nN', 'N')
    >>> print(*found.doubts)
    P_c = 14–15 nN by Maugis' law, better here than JKR (Tabor parameter 0.14, z0 = 200–400 pm): --model maugis
    """
    described, _ = in_si(given)
    for name, value in described.items():
        if not (isinstance(value, float) or is_uncertain(value)):
            raise QuantityError(name, "an array", "is more than one scene", "solve takes arrays")
    found = Answer(_question(wanted), Scene(described, *materials_of(material, material2, materials), model=model))
    if found.failure is not None and found.has_no_headline:
        raise found.failure
    return Answered(found)


def _question(wanted: str | Iterable[str]) -> Question:
    """Return the question of a command, or of quantities."""
    if isinstance(wanted, str) and wanted in QUESTIONS:
        return QUESTIONS[wanted]
    if not isinstance(wanted, Iterable):
        raise UnknownQuantity(str(wanted))
    return question_about(wanted if isinstance(wanted, str) else ",".join(map(str, wanted)))
