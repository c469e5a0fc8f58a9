"""`jkroll.NOMENCLATURE`: the quantities by name, shown in a notebook as `jkroll quantities` lists them."""

from collections.abc import Iterator, Mapping

from ..quantities import nomenclature
from ..quantities.quantity import Quantity
from ..quantities.shown import Part, Shown
from ..text import text_columns
from .catalogue import groups_of_quantities, quantity_table


class Nomenclature(Shown, Mapping[str, Quantity]):
    """The quantities by name: symbol, unit, sentence, equation."""

    def __getitem__(self, name: str) -> Quantity:
        return nomenclature.NOMENCLATURE[name]

    def __iter__(self) -> Iterator[str]:
        return iter(nomenclature.NOMENCLATURE)

    def __len__(self) -> int:
        return len(nomenclature.NOMENCLATURE)

    def __repr__(self) -> str:
        return f"<Nomenclature: {len(self)} quantities>"

    def _parts(self) -> Iterator[Part]:
        for title, members in groups_of_quantities().items():
            yield text_columns(quantity_table(title, members), words=3), []


NOMENCLATURE = Nomenclature()
