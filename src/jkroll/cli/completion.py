"""Completers: the candidates for a word or an option value that is begun."""

from collections.abc import Callable, Iterable, Mapping
from functools import partial

from ..errors import JkrollError
from ..materials.library import Materials, known_materials
from ..materials.places import materials_files
from ..quantities.nomenclature import NOMENCLATURE, OPTION_WORDS

Completer = Callable[[str], list[str]]

_UNITS = {
    "m": ("nm", "um", "mm", "m", "angstrom"),
    "N": ("nN", "uN", "mN", "N", "dyn"),
    "J": ("J", "eV", "erg"),
    "Pa": ("GPa", "MPa", "Pa"),
    "J/m^2": ("mJ/m2", "J/m2", "erg/cm2", "mN/m"),
    "kg/m^3": ("g/cm3", "kg/m3"),
    "m/s": ("cm/s", "m/s", "km/s"),
    "m/s^2": ("m/s2", "standard_gravity"),
}


def completer_of_words(command: str) -> Completer | None:
    """Return the completer for the words of a command; None if they are files, which the shell completes."""
    return _OF_COMMAND.get(command, complete_words)


def completer_of_option(name: str) -> Completer | None:
    """Return the completer for the value of an option, or None."""
    if name in _OF_OPTION:
        return _OF_OPTION[name]
    return partial(complete_input, name) if name in NOMENCLATURE else None


def is_safe(candidate: str) -> bool:
    """Return whether every shell reads a candidate as a plain word, so that nothing of it can be run."""
    return all(character.isalnum() or character in "_-−.+,@=:/" for character in candidate)


def complete_words(incomplete: str) -> list[str]:
    """Return materials for a word that begins with a letter, radii for one that begins with a digit.

    An alias is offered where no name fits.
    """
    if incomplete[:1].isdigit():
        return _with_units(incomplete, "m")
    head, comma, word = incomplete.rpartition(",")
    materials = _materials()
    fitting = _beginning([*materials.names, "all"], word) or _beginning(materials.aliases, word)
    return [head + comma + name for name in fitting]


def _materials() -> Materials:
    """Return the known materials; only the shipped ones while a user's file is broken, which a later call reports."""
    try:
        return known_materials(*materials_files(None))
    except JkrollError:
        return known_materials()


def _beginning(names: Iterable[str], word: str) -> list[str]:
    return [name for name in names if name.casefold().startswith(word.casefold())]


def _results() -> list[str]:
    """Return the quantities that a formula gives, without variants and without what is only an input."""
    return [
        name
        for name, quantity in NOMENCLATURE.items()
        if quantity.unit and not quantity.variant_of and (quantity.equation or not quantity.range)
    ]


def complete_map(incomplete: str) -> list[str]:
    """Return quantities to draw; for a word that is begun, materials and radii too."""
    quantities = _beginning(_results(), incomplete.replace("-", "_"))
    return [*quantities, *complete_words(incomplete)] if incomplete else quantities


def complete_infer(incomplete: str) -> list[str]:
    """Return inputs that can be inferred; for a word that is begun, materials and radii too."""
    from ..scene.inverse import SIZES

    words = [*SIZES, *(word for word, name in OPTION_WORDS.items() if name in SIZES)]
    inputs = _beginning(words, incomplete.replace("-", "_"))
    return [*inputs, *complete_words(incomplete)] if incomplete else inputs


def complete_measured(incomplete: str) -> list[str]:
    """Return quantities that can be measured, each with the sign before its value."""
    return _beginning((f"{name}=" for name in _results()), incomplete)


def complete_figure(incomplete: str) -> list[str]:
    """Return the figures that can be drawn."""
    from .draw import FIGURE_NAMES

    return [name for name in FIGURE_NAMES if name.startswith(incomplete)]


def complete_topic(incomplete: str) -> list[str]:
    """Return the pages of the manual."""
    from ..output.manual import topics

    return _beginning(topics(), incomplete)


def complete_quantity(incomplete: str) -> list[str]:
    """Return the names of quantities."""
    return _beginning(NOMENCLATURE, incomplete.replace("-", "_"))


def complete_list(incomplete: str) -> list[str]:
    """Return the quantities that may follow in a list with commas."""
    head, comma, word = incomplete.rpartition(",")
    return [head + comma + name for name in _beginning(_results(), word.replace("-", "_"))]


def complete_model(incomplete: str) -> list[str]:
    """Return the laws of attraction."""
    from ..quantities.laws import LAWS

    return _beginning(LAWS, incomplete)


def complete_axis(incomplete: str) -> list[str]:
    """Return quantities for an axis, each with the sign before its range."""
    return [f"{name}=" for name in NOMENCLATURE if NOMENCLATURE[name].range and f"{name}=".startswith(incomplete)]


def complete_mark(incomplete: str) -> list[str]:
    """Return materials, and radii after an @."""
    head, at, radius = incomplete.rpartition("@")
    if at:
        return [f"{head}@{text}" for text in _with_units(radius, "m")]
    return [f"{name}@" for name in complete_words(incomplete) if name.rpartition(",")[2] != "all"]


def complete_input(name: str, incomplete: str) -> list[str]:
    """Return a value of an input in each unit of its dimension; its example if nothing is typed yet."""
    quantity = NOMENCLATURE[name]
    return _with_units(incomplete, quantity.unit) if incomplete else [quantity.example]


def _with_units(incomplete: str, unit: str) -> list[str]:
    digits = len(incomplete) - len(incomplete.lstrip("0123456789.-+−"))
    number = incomplete[:digits]
    return [number + candidate for candidate in _UNITS.get(unit, ()) if (number + candidate).startswith(incomplete)]


_OF_COMMAND: Mapping[str, Completer | None] = {
    "map": complete_map,
    "infer": complete_infer,
    "figure": complete_figure,
    "guide": complete_topic,
    "quantities": complete_quantity,
    "batch": None,
}
_OF_OPTION: Mapping[str, Completer] = {
    "x": complete_axis,
    "y": complete_axis,
    "mark": complete_mark,
    "measured": complete_measured,
    "quantities": complete_list,
    "model": complete_model,
    "material": complete_words,
    "material2": complete_words,
}
