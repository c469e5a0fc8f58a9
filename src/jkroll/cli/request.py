"""From words and options to scenes, one for each element of a list or range, and to the format of what is said of them."""

import sys
from collections.abc import Mapping, Sequence
from functools import cached_property
from itertools import product
from typing import TYPE_CHECKING

from ..errors import BadRequest
from ..materials.library import Material, Materials, materials_of_user
from ..quantities.formatting import Format, amount
from ..quantities.laws import law_named
from ..quantities.nomenclature import NOMENCLATURE
from ..quantities.units import BadUnit, Unit, dimension_of, parse_unit
from ..quantities.values import Spread, error_about, spreads_of
from ..rows.sweep import Pair, Sweep
from ..scene.scene import EXCLUSIVE, check_range
from ..text import ending, listed, quoted, say_wrapped
from .commands import Call

if TYPE_CHECKING:
    from ..answers.curve import Loads


class Request:
    """The words and options of one call, read as far as they are needed."""

    def __init__(self, words: Sequence[str], options: Mapping[str, str], file: str | None = None) -> None:
        """Sort words into materials and radii.

        `options` are texts by the names of inputs; `file` is that of `--materials`, which is checked, needed or not.
        """
        self.options = dict(options)
        if file is not None:
            self.materials = known_materials_of(file)
        if "plane" in map(str.casefold, words):
            raise BadRequest("a plane is sphere 2: write --radius2 plane")
        radii = [word for word in words if not _is_material(word)]
        named = [word for word in words if _is_material(word)]
        if len(named) > 1:
            raise BadRequest(
                f"two materials, {quoted(named[0])} and {quoted(named[1])}; for a list write quartz,iron; for sphere 2, --material2 iron"
            )
        self.material_words = named[0] if named else None
        self.material2_words = self.options.pop("material2", None)
        models = self.options.pop("model", None)
        self.models = [law_named(name).name for name in models.split(",")] if models is not None else [None]
        if len(set(self.models)) < len(self.models):
            raise BadRequest(f"--model: {quoted(models or '')} names a law more than once")
        if _is_part(self.options.get("adhesion_hysteresis", "")):
            self.options["hysteresis_fraction"] = self.options.pop("adhesion_hysteresis")
        if radii:
            self.options["radius"] = ",".join(radii)
        for alternatives in EXCLUSIVE:
            given = [
                NOMENCLATURE[name].option or "a radius"
                for name in alternatives
                if name in options or (name == "radius" and radii)
            ]
            if len(given) > 1:
                raise BadRequest(f"{listed(given)} exclude each other")

    @cached_property
    def materials(self) -> Materials:
        """The known materials."""
        return known_materials_of(None)

    @cached_property
    def spreads(self) -> dict[str, list[Spread]]:
        """The values of each input, in the order of the nomenclature; raises OutOfRange for one that the input cannot have."""
        spreads = {name: spreads_of(text, name) for name, text in self.options.items()}
        for name, own in spreads.items():
            for end in (end for spread in own for end in (spread.low, spread.high)):
                check_range(name, end)
        return {name: spreads[name] for name in NOMENCLATURE if name in spreads}

    @cached_property
    def pairs(self) -> list[Pair]:
        """The materials of the two spheres, in all combinations."""
        return list(product(self._materials(self.material_words), self._materials(self.material2_words)))

    @cached_property
    def sweep(self) -> Sweep:
        """The rows: a scene for each combination of materials and values."""
        return Sweep(self.pairs, self.spreads, self.models)

    @cached_property
    def _every_material(self) -> list[Material | None]:
        """The materials that have no mistake; those that have one are told."""
        for mistake in self.materials.mistakes.values():
            say_wrapped(f"note: left out: {mistake}", sys.stderr)
        return [*self.materials.materials.values()]

    def _materials(self, words: str | None) -> list[Material | None]:
        if words is None:
            return [None]
        if words.casefold() == "all":
            return self._every_material
        if (word := next(filter(is_table, words.split(",")), None)) is not None:
            raise BadRequest(f"{quoted(word)} is a table; jkroll batch {word} reads it")
        return [self.materials[word] for word in words.split(",")]


def is_table(word: str) -> bool:
    """Return whether a word is the name of a file that holds a table."""
    if "." not in word:
        return False
    from ..batch.formats import format_of_name

    return format_of_name(word) is not None


def known_materials_of(option: str | None) -> Materials:
    """Return the known materials with those of the user's files, and say which names these take from others."""
    found = materials_of_user(option)
    for text in found.overrides:
        say_wrapped(f"note: {text}", sys.stderr)
    return found


def request_of(call: Call) -> Request:
    """Return the request of the words and inputs of a call, with the user's materials files."""
    return Request(call.words, call.inputs, call.materials)


def curve_request(call: Call) -> "tuple[Request, Loads | None]":
    """Return the scenes of which a force curve is wanted, and its loads if they are given."""
    from ..answers.curve import loads_of

    inputs = dict(call.inputs)
    loads = inputs.pop("load", None)
    if "approach_at_load" in inputs:
        raise BadRequest("--curve goes through all approaches; it takes none")
    request = request_of(call._replace(inputs=inputs))
    if loads is None:
        return request, None
    ends = loads.split(":")
    if len(ends) == 2 and not all(ends):
        pull = amount("load", -request.sweep.kinds[0]["pull_off_force"])
        end = "lower" if not ends[0] else "upper"
        raise BadRequest(
            f"--load: {quoted(loads)} has no {end} end; write both, as in -5nN:20nN (an example); pull-off is at {pull}"
        )
    return request, loads_of(loads)


def _is_part(text: str) -> bool:
    """Return whether an adhesion hysteresis is given as a part of the work of adhesion: 40%, and not 5mJ/m2 ± 20%."""
    number = text.casefold().partition("±")[0].replace("to", "").replace("e", "")
    return text.rstrip().endswith("%") and not any(map(str.isalpha, number))


def _is_material(word: str) -> bool:
    return word.casefold() == "all" or (word[:1].isalpha() and word.casefold() != "plane")


# --- Formats of the output --------------------------------------------------------------------------------------------

FORMATS = ("bare", "json", "csv", "explain", "cite")
PICTURES = ("svg", "pdf", "png")
OTHER_PICTURES = ("jpg", "jpeg", "gif", "tif", "tiff", "eps", "ps", "svgz", "bmp", "webp")  # are not drawn


def format_name(call: Call) -> str:
    """Return the name of the output format: the one that was chosen, else a table on a terminal and plain lines in a pipe.

    A name of the output file that ends in .json chooses JSON.
    """
    chosen = [name for name in FORMATS if getattr(call, name)]
    if len(chosen) > 1:
        raise BadRequest(f"--{chosen[0]} and --{chosen[1]} exclude each other")
    if is_json(call.target):
        if chosen and chosen != ["json"]:
            raise BadRequest(f"-o {quoted(call.target or '')} and --{chosen[0]} exclude each other")
        return "json"
    if chosen:
        return chosen[0]
    return "table" if sys.stdout.isatty() else "plain"


def form_of(call: Call, quantities: Sequence[str]) -> Format:
    """Return the format of results; each unit of `--to` applies to the quantities of its dimension."""
    units: dict[str, tuple[str, Unit]] = {}
    for text in call.to.split(",") if call.to is not None else []:
        try:
            unit = parse_unit(text)
        except BadUnit as error:
            wanted = [dimension_of(NOMENCLATURE[name].unit) for name in quantities]
            raise error_about(
                "--to", text, error, wanted, f"expected a unit such as {NOMENCLATURE[quantities[0]].unit}"
            ) from None
        fitting = [
            name for name in quantities if text.strip() and dimension_of(NOMENCLATURE[name].unit) == unit.dimension
        ]
        if not fitting:
            units_of_results = ", ".join(dict.fromkeys(NOMENCLATURE[name].unit for name in quantities))
            raise BadRequest(f"--to: {quoted(text)} fits none of the results, which are in: {units_of_results}")
        if fitting[0] in units:
            raise BadRequest(
                f"--to: {quoted(units[fitting[0]][0])} and {quoted(text)} are units of one dimension; give one of them"
            )
        units |= dict.fromkeys(fitting, (" ".join(text.split()), unit))
    return Format(units, call.digits)


def is_json(target: str | None) -> bool:
    """Return whether an output file was named whose name says that it is JSON."""
    return target is not None and ending(target) == "json"
