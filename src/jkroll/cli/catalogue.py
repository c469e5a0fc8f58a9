"""Runners of `materials`, `quantities` and `guide`."""

import sys

from ..output.catalogue import quantities_found, write_materials, write_quantities
from ..output.manual import write_page, write_topics
from ..text import say_wrapped
from .commands import Call
from .question import format_name
from .request import materials_of


def run_materials(call: Call) -> int:
    """List the materials, or show one in full; return the exit code."""
    kind = format_name(call)
    materials = materials_of(call.materials)
    lists_all = not call.words or call.words[0].casefold() == "all"
    chosen = [*materials.materials.values()] if lists_all else [materials[word] for word in call.words[0].split(",")]
    write_materials(chosen, sys.stdout, kind, whole=not lists_all and len(chosen) == 1)
    sys.stdout.flush()
    for clash in () if call.quiet or not lists_all else dict.fromkeys(map(str, materials.clashes.values())):
        say_wrapped(f"note: {clash}", sys.stderr)
    mistakes = [*materials.mistakes.values()] if lists_all else []
    for mistake in mistakes:
        say_wrapped(f"jkroll: {mistake}", sys.stderr)
    return mistakes[0].exit_code if mistakes else 0


def run_quantities(call: Call) -> int:
    """List quantities, those that have some words, or one in full; return the exit code."""
    write_quantities(quantities_found(call.words), sys.stdout, format_name(call))
    return 0


def run_guide(call: Call) -> int:
    """Show a page of the manual, or list its topics; return the exit code."""
    if call.words:
        write_page(call.words[0], sys.stdout)
    else:
        write_topics(sys.stdout)
    return 0
