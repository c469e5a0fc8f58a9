"""`--cite`: BibTeX of the paper and of the material data."""

from collections.abc import Collection, Iterable, Mapping
from typing import TextIO

from ..answers.answer import Answer
from ..errors import JkrollError
from ..quantities.formatting import Format
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


LAWS = {
    "maugis": {
        "key": "maugis-1992",
        "type": "article",
        "author": "Maugis, D.",
        "title": "Adhesion of spheres: the {JKR-DMT} transition using a {Dugdale} model",
        "journal": "Journal of Colloid and Interface Science",
        "volume": "150",
        "number": "1",
        "pages": "243--269",
        "year": "1992",
        "doi": "10.1016/0021-9797(92)90285-T",
    },
    "dmt": {
        "key": "derjaguin-muller-toporov-1975",
        "type": "article",
        "author": "Derjaguin, B. V. and Muller, V. M. and Toporov, Yu. P.",
        "title": "Effect of contact deformations on the adhesion of particles",
        "journal": "Journal of Colloid and Interface Science",
        "volume": "53",
        "number": "2",
        "pages": "314--326",
        "year": "1975",
        "doi": "10.1016/0021-9797(75)90018-1",
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
        references |= {
            str(LAWS[name]["key"]): LAWS[name] for name in {one.model for one in answer.results} & LAWS.keys()
        }
        references |= {str(entry["key"]): entry for entry in material_references(scene, answer.inputs)}
    numbers = sorted(filter(None, equations), key=int)
    if failure is not None and not numbers:
        raise failure
    say(PAPER % (("Eq. " if len(numbers) == 1 else "Eqs. ") + ", ".join(f"({number})" for number in numbers)), out)
    for entry in references.values():
        say(bibtex(entry), out)


def material_references(scene: Scene, inputs: Collection[str]) -> list[Mapping[str, str]]:
    """Return the references of the materials whose data are among the inputs."""
    return [entry for material, _ in scene.data_used(inputs) for entry in material.references]


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
