"""`jkroll.table`: the results of `batch` for tables in Python."""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import chain
from typing import Any, TypeVar, overload

import numpy

from ..errors import BadRequest, BadRow, JkrollError
from ..materials.library import Material, Materials, known_materials
from ..model.containers import Reader
from ..model.rows import BLOCK
from ..model.solver import materials_of, refuse_arrays, words_in
from ..model.tally import Tally
from ..model.unknowns import inputs_named
from ..report.questions import BY_DEFAULT, quantities_named, quantity_named
from ..text import as_arguments
from .dataframes import Data, Memory, data_of
from .reading import reading_of
from .run import Converter, about, notes_on
from .table import Asked, Table, header_of
from .words import headed as headed_input

DataFrame = TypeVar("DataFrame")


@overload
def table(data: dict[Any, Any], /, quantities: str | Iterable[str] | None = None, **options: Any) -> dict[Any, Any]: ...
@overload
def table(data: DataFrame, /, quantities: str | Iterable[str] | None = None, **options: Any) -> DataFrame: ...
def table(
    data: Any,
    /,
    quantities: str | Iterable[str] | None = None,
    *,
    material: str | Material | None = None,
    material2: str | Material | None = None,
    materials: Materials | None = None,
    model: str | None = None,
    profile: str | None = None,
    columns: Mapping[Any, str] | None = None,
    pass_rest: bool = False,
    infer: str = "",
    measured: str = "",
    best: bool = False,
    doubt: bool = True,
    uncertainty: bool = False,
    strict: bool = False,
    say: Callable[[str], object] | None = None,
    **given: Any,
) -> Any:
    """Return a table with the results of each row as additional columns.

    The table is read as `jkroll batch` reads a file, and the same columns are added.

    Parameters
    ----------
    data
        A DataFrame of pandas or polars, a dict of arrays, a Dataset of xarray, a Table of astropy or of pyarrow. Each
        input is a column with a unit, either in its name ("radius [nm]", "E_GPa") or stated by the library, as in the
        attribute "units" or in a column of pint or astropy. Columns "material" and "material2" have names of materials,
        and a column "gamma_err [mJ/m2]" is an uncertainty. In columns of numbers, nan is an empty cell.
        Columns of texts may have decimal commas. In pandas, an index with a name is a column, too.
    quantities
        Names or symbols of quantities, or commands such as "pull-off". By default, the table gets all quantities that
        its columns allow.
    material, material2, materials, model, profile, **given
        Inputs for all rows, as for `solve`. They fill empty cells.
    columns
        The meaning of columns with other names: {"R2 (nm)": "radius2 [nm]"}, or "" for a column that is not an input.
    pass_rest
        True to pass through columns that are only partly understood. By default they are refused.
    infer, measured
        The input to infer in each row, and the quantity that was measured.
    best, doubt, uncertainty
        True to add columns of best ranges, of doubts, and of uncertainties. Columns of uncertainties are also added if
        the first rows or the arguments have uncertainties.
    strict
        True to raise an error for the first row without a result.
    say
        A function such as `print`, called with each line that `batch` prints: how columns are read, what is assumed,
        and how many rows are in doubt.

    Returns
    -------
    A table of the type of `data`, with its columns and labels, the results in SI units, `doubt` and `status`. Units are
    part of the names, as in "pull_off_force [N]"; in xarray and astropy they are attributes.

    Raises
    ------
    BadTable, BadRequest, QuantityError, UnknownMaterial, UnknownQuantity
        A column that may be an input is not read, or an argument is wrong; with `strict`, a row has no result.

    >>> found = table({"radius [nm]": [100, 200], "material": ["quartz", "iron"]}, "P_c")
    >>> [f"{force:.4e}" for force in found["pull_off_force [N]"]], found["doubt"][0]
    (['1.1781e-08', '2.8274e-06'], 'law-off-25%')
    """
    solids = dict(zip(("material", "material2"), materials_of(material, material2, materials), strict=True))
    described = Reader().in_si(given)
    refuse_arrays(described, "is not one value for all rows", "make it a column of the table")
    words = {"model": model, "profile": profile}
    every_input = {**solids, **words, **described}
    inputs = {name: value for name, value in every_input.items() if value is not None}
    if bool(infer) != bool(measured):
        raise BadRequest('infer and measured go together, as in infer="gamma", measured="pull_off_force"')
    wanted = words_in(quantities) if quantities is not None else []
    explicit, offered = quantities_named(",".join(wanted)) if wanted else ([], BY_DEFAULT)
    try:
        rows = data_of(data)
        asked = Asked(
            inputs,
            materials or known_materials(),
            explicit,
            offered,
            columns=[*_meanings(rows, columns or {})],
            pass_rest=pass_rest,
            infer=inputs_named([infer])[0] if infer else "",
            measured=quantity_named(measured) if measured else "",
            doubt=doubt,
            best=best,
            uncertainty=uncertainty,
        )
        return _tabled(rows, asked, say, strict=strict)
    except JkrollError as error:
        error.args = tuple([_in_python(part) if isinstance(part, str) else part for part in error.args])
        raise


def _meanings(rows: Data, columns: Mapping[Any, str]) -> Iterator[str]:
    """Iterate over the meanings of columns in the form of `--column`, with the units that the library states."""
    heads = {column.name: column for column in rows.columns}
    for name, meaning in columns.items():
        column = heads.get(name)
        if column is None:
            yield f"{name}={meaning}"
            continue
        reading, unit = reading_of(meaning), column.head.removeprefix(str(name)).strip(" []")
        lacks_unit = unit and reading.is_input and not reading.unit_text
        yield f"{column.head}={headed_input(reading.name, unit) if lacks_unit else meaning}"


def _in_python(text: str) -> str:
    """Return a message with the arguments of `table` in place of the options of `batch`.

    >>> _in_python("Write --column 'R2 (nm)=radius2 [nm]', or --column 'R2 (nm)=' to pass it through (--pass-rest)")
    "Write columns={'R2 (nm)': 'radius2 [nm]'}, or columns={'R2 (nm)': ''} to pass it through (pass_rest)"
    """
    text = re.sub(r"--column (['\"])(.*?)=([^=]*?)\1", r"columns={\1\2\1: \1\3\1}", text)
    return as_arguments(text)


def _tabled(rows: Data, asked: Asked, say: Callable[[str], object] | None, *, strict: bool) -> Any:
    """Return the table with its results."""

    def tell(lines: Iterable[str]) -> None:
        if say is not None:
            for line in lines:
                say(_in_python(line))

    source = Memory(rows, asked)
    header = header_of(source, asked)
    tell([header.reading()])
    read = Table(header, source.sample, asked)
    tell(about(read))
    convert, tally = Converter(source, read, "", strict=strict), Tally()
    blocks: list[Sequence[Any]] = []
    for start in range(0, rows.size, BLOCK) or [0]:  # a table without rows has an empty block
        try:
            converted = convert.converted(range(start, min(start + BLOCK, rows.size)))
        except BadRow as error:
            row, reason = error.args
            raise BadRequest(f"row {row}, counted from 0: {reason}") from None
        blocks.append(converted.output)
        tally = tally.plus(converted.tally)
    tell(notes_on(tally, asked))
    columns = zip(read.added, *blocks, strict=True)
    return rows.with_columns({head: _joined(parts) for head, *parts in columns})


def _joined(parts: Sequence[Any]) -> Any:
    """Return the parts of a column joined into one."""
    if all(isinstance(part, list) for part in parts):
        return [*chain.from_iterable(parts)]
    return numpy.concatenate(parts)
