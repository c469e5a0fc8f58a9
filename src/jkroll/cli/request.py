"""From words and options to scenes: materials and values, with a scene for each element of a list or range."""

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from itertools import chain, islice, product
from math import prod
from typing import TYPE_CHECKING, Any

from ..errors import BadRequest
from ..materials.library import Material, Materials, known_materials
from ..materials.places import materials_files
from ..quantities.laws import law_named
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.ranges import Spread, spreads_of
from ..scene.scene import EXCLUSIVE, Scene
from ..text import quoted
from .options import Call

if TYPE_CHECKING:
    from ..answers.curve import Loads

MAX_SAMPLES = 50
MAX_SCENES = 1_000_000  # answered one by one


class Request:
    """The words and options of one call, read as far as they are needed."""

    def __init__(self, words: Sequence[str], options: Mapping[str, str], files: Sequence[str] = ()) -> None:
        """Sort words into materials and radii.

        `options` are texts by the names of inputs; `files` are of materials, by rising precedence.
        """
        self.options = dict(options)
        self.files = files
        words = _joined(words)
        if "plane" in map(str.casefold, words):
            raise BadRequest("a plane is sphere 2: write --radius2 plane")
        radii = [word for word in words if not _is_material(word)]
        named = [word for word in words if _is_material(word)]
        if len(named) > 1:
            raise BadRequest(
                f"two materials, {quoted(named[0])} and {quoted(named[1])}; a list has commas, a second sphere has --material2"
            )
        self.material_words = named[0] if named else ""
        self.material2_words = self.options.pop("material2", "")
        if options.get("material2") == "":
            raise BadRequest("--material2 is empty")
        models = self.options.pop("model", None)
        self.models = [law_named(name).name for name in models.split(",")] if models is not None else [None]
        if len(set(self.models)) < len(self.models):
            raise BadRequest(f"--model: {quoted(models or '')} names a law more than once")
        if radii:
            self.options["radius"] = ",".join(radii)
        for alternatives in EXCLUSIVE:
            given = [NOMENCLATURE[name].option for name in alternatives if name in options]
            if len(given) > 1:
                raise BadRequest(" and ".join(given) + " exclude each other")

    @cached_property
    def materials(self) -> Materials:
        """The known materials; their files are read at the first access."""
        return known_materials(*self.files)

    @cached_property
    def spreads(self) -> dict[str, list[Spread]]:
        """The values of each input, in the order of the nomenclature."""
        spreads = {name: spreads_of(text, name) for name, text in self.options.items()}
        return {name: spreads[name] for name in NOMENCLATURE if name in spreads}

    @cached_property
    def pairs(self) -> list[tuple[Material | None, Material | None]]:
        """The materials of the two spheres, in all combinations."""
        return list(product(self._materials(self.material_words), self._materials(self.material2_words)))

    @cached_property
    def count(self) -> int:
        """The number of scenes."""
        return len(self.pairs) * len(self.models) * prod(sum(map(len, spreads)) for spreads in self.spreads.values())

    def check_count(self) -> None:
        """Raise BadRequest if there are more scenes than are answered one by one."""
        if self.count > MAX_SCENES:
            raise BadRequest(f"{self.count} scenes are more than {MAX_SCENES}; --csv and -o FILE write any number")

    def scenes(self) -> Iterator[Scene]:
        """Iterate over the scenes, one for each combination of materials and values."""
        values = [[*chain.from_iterable(spreads)] for spreads in self.spreads.values()]
        for pair in self.pairs:
            for row in product(*values):
                for model in self.models:
                    yield Scene(dict(zip(self.spreads, row, strict=True)), *pair, model=model)

    def samples(self) -> list[Scene]:
        """Return scenes of every kind: each pair of materials, both ends of ranges, equal and unequal spheres, error bars."""
        first = {name: spreads[0].low for name, spreads in self.spreads.items()}
        last = {name: spreads[-1].high for name, spreads in self.spreads.items()}
        radii2 = islice(chain.from_iterable(self.spreads.get("radius2", [])), MAX_SAMPLES)
        kinds = [first, last, *({**first, "radius2": radius2} for radius2 in radii2 if isinstance(radius2, float))]
        of_kinds = [[spreads[0].low, *_of_each_kind(spreads)] for spreads in self.spreads.values()]
        kinds += [dict(zip(self.spreads, row, strict=True)) for row in islice(product(*of_kinds), 1, None)]
        return [Scene(values, *pair, model=model) for pair in self.pairs for values in kinds for model in self.models]

    def _materials(self, words: str) -> list[Material | None]:
        if not words:
            return [None]
        if words.casefold() == "all":
            return list(self.materials.materials.values())
        return [self.materials[word] for word in words.split(",")]


def _of_each_kind(spreads: Sequence[Spread]) -> list[Any]:
    """Return an uncertain value of each kind that is among the values of an input."""
    return [*{spread.uncertainty.kind: spread.uncertainty for spread in spreads if spread.uncertainty}.values()]


def request_of(call: Call) -> Request:
    """Return the request of the words and inputs of a call, with the user's materials files."""
    return Request(call.words, call.inputs, materials_files(call.materials))


def curve_request(call: Call) -> "tuple[Request, Loads | None]":
    """Return the scenes of which a force curve is wanted, and its loads if they are given."""
    from ..answers.curve import loads_of

    inputs = dict(call.inputs)
    loads = inputs.pop("load", None)
    if "approach_at_load" in inputs:
        raise BadRequest("--curve goes through all approaches; it takes none")
    return request_of(call._replace(inputs=inputs)), loads_of(loads) if loads is not None else None


def _joined(words: Sequence[str]) -> list[str]:
    """Return the words, joining a number and a unit that follows it after a space."""
    joined: list[str] = []
    for word in words:
        if joined and joined[-1][-1:].isdigit() and not joined[-1].strip("+-−±().0123456789eE") and _is_material(word):
            joined[-1] += f" {word}"
        else:
            joined.append(word)
    return joined


def _is_material(word: str) -> bool:
    return word.casefold() == "all" or (word[:1].isalpha() and word.casefold() != "plane")
