"""Runners of `materials`, `quantities` and `guide`."""

import sys

from ..materials.library import known_materials
from ..materials.places import materials_files
from ..output.catalogue import write_materials
from ..output.glossary import quantities_found, write_quantities
from ..output.manual import write_page, write_topics
from ..text import say_wrapped
from .options import Call
from .written import format_name


def run_materials(call: Call) -> int:
    """List the materials, or show one in full; return the exit code."""
    kind = format_name(call)
    materials = known_materials(*materials_files(call.materials))
    shows_one = bool(call.words) and call.words[0] != "all"
    chosen = [materials[call.words[0]]] if shows_one else list(materials.materials.values())
    write_materials(chosen, sys.stdout, kind, whole=shows_one)
    for material in () if call.quiet else chosen:
        for text in material.remarks:
            say_wrapped(f"note: {material.name}: {text}", sys.stderr)
    return 0


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
