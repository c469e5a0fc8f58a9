"""`--cite`: BibTeX of the paper and of the material data."""

from collections.abc import Collection, Iterable, Mapping
from typing import TextIO

from ..answers.answer import Answer
from ..errors import JkrollError
from ..quantities.formatting import Format
from ..quantities.laws import LAWS
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.scene import Scene
from ..text import say

PAPER = """@article{dominik-tielens-1995,
  author  = {Dominik, C. and Tielens, A. G. G. M.},
  title   = {Resistance to rolling in the adhesive contact of two elastic spheres},
  journal = {Philosophical Magazine A},
  volume  = {72},
  number  = {3},
  pages   = {783--803},
  year    = {1995},
  doi     = {10.1080/01418619508243800},
  note    = {%s}
}"""

# The references of conventions, by how the nomenclature names them.
_CONVENTIONS: Mapping[str, Mapping[str, str]] = {
    "Thornton & Ning 1998": {
        "key": "thornton-ning-1998",
        "type": "article",
        "author": "Thornton, C. and Ning, Z.",
        "journal": "Powder Technology",
        "volume": "99",
        "pages": "154--162",
        "year": "1998",
        "doi": "10.1016/S0032-5910(98)00099-0",
    },
    "Paszun & Dominik 2008": {
        "key": "paszun-dominik-2008",
        "type": "article",
        "author": "Paszun and Dominik",
        "journal": "Astronomy & Astrophysics",
        "volume": "484",
        "pages": "859--868",
        "year": "2008",
        "doi": "10.1051/0004-6361:20079262",
    },
    "Wada et al. 2007": {
        "key": "wada-2007",
        "type": "article",
        "author": "Wada and Tanaka and Suyama and Kimura and Yamamoto",
        "journal": "The Astrophysical Journal",
        "volume": "661",
        "pages": "320",
        "year": "2007",
        "doi": "10.1086/514332",
    },
    **{
        repository: {
            "key": repository.replace("/", "-").lower(),
            "type": "misc",
            "url": f"https://github.com/{repository}",
        }
        for repository in ("Lumajord/DustSimulation", "pencil-code/pencil-code", "StephaneMichoulier/Pamdeas")
    },
}


def write_citations(pairs: Iterable[tuple[Scene, Answer]], out: TextIO, _: Format) -> None:
    """Write BibTeX entries of the paper, with the equations used, and of the material data used."""
    equations: set[str] = set()
    references: dict[str, Mapping[str, str]] = {}
    failure: JkrollError | None = None
    for scene, answer in pairs:
        failure = failure or answer.failure
        known = [result.name for result in answer.results if result.value is not None]
        equations |= {NOMENCLATURE[step.name].equation for name in known for step in scene.plan(name).steps}
        laws = [LAWS[one.law.name].reference for one in answer.results if one.law]
        entries = [*laws, *material_references(scene, answer.inputs), *_of_conventions(known)]
        references |= {str(entry["key"]): entry for entry in entries}
    numbers = sorted(filter(None, equations), key=int)
    if failure is not None and not numbers:
        raise failure
    say(PAPER % (("Eq. " if len(numbers) == 1 else "Eqs. ") + ", ".join(f"({number})" for number in numbers)), out)
    for entry in references.values():
        say(bibtex(entry), out)


def material_references(scene: Scene, inputs: Collection[str]) -> list[Mapping[str, str]]:
    """Return the references of the materials whose data are among the inputs."""
    return [entry for material, _ in scene.data_used(inputs) for entry in material.references]


def _of_conventions(names: Iterable[str]) -> list[Mapping[str, str]]:
    """Return the references that the nomenclature names for quantities by convention."""
    return [entry for name in names for words, entry in _CONVENTIONS.items() if words in NOMENCLATURE[name].reference]


def bibtex(entry: Mapping[str, str]) -> str:
    """Return a BibTeX entry.

    >>> print(bibtex({"key": "book", "type": "misc", "title": "A Book"}))
    @misc{book,
      title = {A Book}
    }
    """
    fields = {name: text for name, text in entry.items() if name not in ("key", "type")}
    width = max(map(len, fields), default=0)
    lines = [f"  {name:{width}} = {{{text}}}" for name, text in fields.items()]
    return f"@{entry.get('type', 'misc')}{{{entry['key']},\n" + ",\n".join(lines) + "\n}"
