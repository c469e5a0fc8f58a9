"""Tables of Python libraries: their columns with units, and tables of the same type with more columns.

The attributes of a table tell which library the table comes from, so no other library is imported.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property, partial
from importlib import import_module
from itertools import product
from math import isnan
from typing import Any, NamedTuple

import numpy

from ..errors import BadTable
from ..model.labels import text_of_unit, unit_stated
from ..model.rows import has_texts
from ..text import quoted, shown
from ..write.writers import Lists
from .cells import Doubles, cells_of
from .decimals import decimal_mark, with_decimal_points
from .layouts import SAMPLE
from .table import Asked, Records

Added = Mapping[str, Any]  # new columns by header: arrays of numbers, or lists of texts with None for an empty cell


class Named(NamedTuple):
    """A column: its name in the library, its header with the unit, and a function that returns its values."""

    name: Any
    head: str
    values: Callable[[], Any]  # as an array of numbers, or as a list


class Data:
    """The columns of a dict of arrays, lists or single values. Subclasses are for the tables of libraries."""

    def __init__(self, data: Any) -> None:
        self.data = data

    @cached_property
    def columns(self) -> list[Named]:
        """The columns in order."""
        columns = []
        for name, column in self._items():
            columns.append(Named(name, headed(name, _unit_of(column)), partial(self._filled, column)))
        return columns

    @cached_property
    def size(self) -> int:
        """The number of rows."""
        sizes = {}
        for name, column in self._items():
            if not _is_single(column):
                sizes[str(name)] = len(column)
        if len({*sizes.values()}) > 1:
            lengths = ", ".join([f"{quoted(name)} {size}" for name, size in sizes.items()])
            raise BadTable(f"the columns have different lengths: {lengths}")
        return next(iter(sizes.values()), 1)

    def use(self, heads: Iterable[str]) -> None:
        """Take the headers of the columns to read. Only the rows of an xarray Dataset depend on them."""

    def with_columns(self, added: Added) -> Any:
        """Return a table of the same type with more columns."""
        return {**self.data, **{head: _array(column) for head, column in added.items()}}

    def _items(self) -> Any:
        return self.data.items()

    def _filled(self, column: Any) -> Any:
        """Return the values of a column, one for each row."""
        values = _magnitude(column)
        if _is_single(values):
            values = numpy.full(self.size, values)
        return cells_in(values)


class _Pandas(Data):
    def _items(self) -> Any:
        """Iterate over the levels of the index and the columns; a level without a name is read only if it has texts."""
        index = self.data.index
        for number, name in enumerate(index.names):
            level, head = index.get_level_values(number), "index" if name is None else name
            is_read = name is not None or level.dtype.kind == "O"
            if is_read and head not in self.data.columns:
                yield head, level
        yield from self.data.items()

    def _filled(self, column: Any) -> Any:
        if hasattr(column.dtype, "units"):  # a column of pint
            column = column.pint.magnitude
        if isinstance(column.dtype, numpy.dtype) and column.dtype.kind in "fiu":
            return cells_in(column.to_numpy())
        return cells_in(column.to_numpy(dtype=object, na_value=None))

    @property
    def size(self) -> int:
        """The number of rows."""
        return len(self.data)

    def with_columns(self, added: Added) -> Any:
        """Return the table with more columns."""
        return self.data.assign(**{head: _array(column) for head, column in added.items()})


class _Polars(Data):
    def _items(self) -> Any:
        if not hasattr(self.data, "get_columns"):
            raise BadTable("a LazyFrame has no rows yet: give table(frame.collect())")
        return ((column.name, column) for column in self.data.get_columns())

    def _filled(self, column: Any) -> Any:
        if column.dtype.is_numeric() and not column.null_count():
            return cells_in(column.to_numpy())
        return cells_in(column.to_list())

    def with_columns(self, added: Added) -> Any:
        """Return the table with more columns."""
        texts = {head: str for head in added if has_texts(head)}
        return self.data.hstack(type(self.data)(added, schema_overrides=texts, nan_to_null=True))


class _Arrow(Data):
    def _items(self) -> Any:
        return zip(self.data.column_names, self.data.columns, strict=True)

    def _filled(self, column: Any) -> Any:
        from .parquet import values_of

        return cells_in(values_of(column))

    def with_columns(self, added: Added) -> Any:
        """Return the table with more columns."""
        from .parquet import Batches

        batch, table = Batches().rows([*added], [*added.values()]), self.data
        for field, column in zip(batch.schema, batch.columns, strict=True):
            table = table.append_column(field, column)
        return table


class _Astropy(Data):
    def _items(self) -> Any:
        return ((name, self.data[name]) for name in self.data.colnames)

    @property
    def size(self) -> int:
        """The number of rows."""
        return len(self.data)

    def with_columns(self, added: Added) -> Any:
        """Return the table with more columns, each with its unit as an attribute."""
        quantity, table = import_module("astropy.units").Quantity, self.data.copy(copy_data=False)
        for head, column in added.items():
            name, unit = name_and_unit(head)
            texts = has_texts(head)
            if not unit:
                table[name] = column
            elif texts:
                table[name] = [text or "" for text in column]
            else:
                table[name] = quantity(column, unit)
        return table


class _Xarray(Data):
    """An xarray Dataset. Its rows are the grid points over all dimensions of the columns to read."""

    dims: tuple[Any, ...] = ()

    def _items(self) -> Any:
        return self.data.variables.items()

    def use(self, heads: Iterable[str]) -> None:
        """Choose the dimensions of the columns to read."""
        wanted = {*heads}
        used: set[Any] = set()
        for column in self.columns:
            if column.head in wanted:
                used.update(self.data.variables[column.name].dims)
        self.dims = tuple(dimension for dimension in self.data.sizes if dimension in used)

    @property
    def shape(self) -> tuple[int, ...]:
        """The number of points along each dimension."""
        return tuple(self.data.sizes[dimension] for dimension in self.dims)

    @property
    def size(self) -> int:
        """The number of points."""
        return int(numpy.prod(self.shape))

    def _filled(self, column: Any) -> Any:
        if not {*column.dims} <= {*self.dims}:
            return [None] * self.size  # the column has dimensions that the rows lack
        own = [dimension for dimension in self.dims if dimension in column.dims]
        column = column.transpose(*own)
        data = numpy.asarray(_magnitude(column.data) if hasattr(column.data, "magnitude") else column.values)
        shape = [size if dimension in own else 1 for dimension, size in zip(self.dims, self.shape, strict=True)]
        return cells_in(numpy.broadcast_to(data.reshape(shape), self.shape).reshape(-1))

    def with_columns(self, added: Added) -> Any:
        """Return the Dataset with more variables, each with its unit as an attribute."""
        variables = {}
        for head, column in added.items():
            name, unit = name_and_unit(head)
            values = [text or "" for text in column] if has_texts(head) else column
            attributes = {"units": unit} if unit else {}
            variables[name] = (self.dims, numpy.asarray(values).reshape(self.shape), attributes)
        return self.data.assign(variables)


_KINDS: Mapping[str, type[Data]] = {
    "data_vars": _Xarray,
    "colnames": _Astropy,
    "iterrows": _Pandas,
    "collect_schema": _Polars,
    "append_column": _Arrow,
}


def data_of(data: Any) -> Data:
    """Return the data of a table, whose library is recognized by an attribute. Raises BadTable for other objects."""
    for attribute, kind in _KINDS.items():
        if hasattr(data, attribute):
            return kind(data)
    if isinstance(data, Mapping):
        return Data(data)
    problem = f"{shown(type(data).__name__)} is not a table"
    raise BadTable(
        f"{problem}; give a DataFrame, a dict of arrays, a Dataset of xarray or a Table of astropy or pyarrow"
    )


# --- Units ------------------------------------------------------------------------------------------------------------


def headed(name: Any, unit: Any) -> str:
    """Return the header of a column: its name, with the unit that the library states.

    >>> headed("radius", "nm"), headed("radius", None), headed("nu", "")
    ('radius [nm]', 'radius', 'nu [1]')
    """
    return str(name) if unit is None else f"{name} [{text_of_unit(unit)}]"


def name_and_unit(head: str) -> tuple[str, str]:
    """Return the name and the unit in a header of a result.

    >>> name_and_unit("pull_off_force [N]"), name_and_unit("n_grav")
    (('pull_off_force', 'N'), ('n_grav', ''))
    """
    name, _, unit = head.partition(" [")
    return name, unit.removesuffix("]")


def _unit_of(column: Any) -> Any:
    """Return the unit that a library states for a column; None if it states none."""
    unit = unit_stated(column)
    if unit is not None:
        return unit
    holders = (column, column.data) if hasattr(column, "dims") else (column,)
    for holder, attribute in product(holders, ("units", "unit")):
        unit = getattr(holder, attribute, None)
        if unit is not None:
            return unit
    return None


def _magnitude(column: Any) -> Any:
    """Return the numbers of a Quantity of pint or astropy; other objects are returned unchanged."""
    if hasattr(column, "magnitude"):
        return column.magnitude
    return column.value if hasattr(column, "to_value") else column


# --- Cells ------------------------------------------------------------------------------------------------------------


def cells_in(values: Any) -> Any:
    """Return values as an array of integers, or of doubles with nan, or as a list with None for missing values."""
    mask = getattr(values, "mask", None)
    array = numpy.asarray(getattr(values, "unmasked", values))
    if array.ndim != 1:
        raise BadTable(f"a column has the shape {array.shape}; it needs a number or a text for each row")
    if mask is not None and numpy.any(mask):
        return [None if is_out else value for value, is_out in zip(array.tolist(), mask.tolist(), strict=True)]
    if array.dtype.kind in "iu":
        return array
    if array.dtype.kind == "f":
        return array.astype(float, copy=False)  # numbers of 32 bits are converted exactly
    return [None if isinstance(value, float) and isnan(value) else value for value in array.tolist()]


def _is_single(column: Any) -> bool:
    """Return whether a column is one value for all rows."""
    return isinstance(column, str) or getattr(column, "ndim", 1) == 0 or not hasattr(column, "__len__")


def _array(column: Any) -> Any:
    return numpy.array(column, dtype=object) if isinstance(column, list) else column


# --- Rows in memory, with the interface of file formats ---------------------------------------------------------------


class Memory:
    """The rows of a Python table, with the interface of the file formats."""

    def __init__(self, rows: Data, asked: Asked) -> None:
        """Read the header, and the cells of the first rows in columns that may be read."""
        self.rows = rows
        self.stated, self.writer = asked.stated, Lists()
        self.names = tuple(column.head for column in rows.columns)
        read = [*filter(asked.is_read, self.names)]
        rows.use(read)
        self.size = rows.size
        self._values: dict[int, Any] = {}  # the values of columns, by position
        first: dict[int, Sequence[str]] = {}  # the first cells of columns to read, by position
        for position, name in enumerate(self.names):
            if name in read:
                first[position] = [cell.decode() for cell in cells_from(self._of(position)[:SAMPLE])]
        self._with_commas = self._take_decimal_commas(first)
        unread = [""] * min(SAMPLE, rows.size)
        columns = [first.get(position, unread) for position in range(len(self.names))]
        self.sample: list[Sequence[str]] = [*zip(*columns, strict=True)]

    def _take_decimal_commas(self, first: dict[int, Sequence[str]]) -> set[int]:
        """Return the positions of the read columns that contain texts, if these have decimal commas; else no positions.

        Commas in the first cells of such columns become points. Doubles among the texts become texts with commas, so
        `read` can treat all cells alike.
        """
        texts = {position for position in first if _include_texts(self._of(position))}
        if decimal_mark([first[position] for position in texts], "") != ",":
            return set()
        for position in texts:
            first[position] = [cell.replace(",", ".") for cell in first[position]]
            self._values[position] = [
                str(value).replace(".", ",") if isinstance(value, float) else value for value in self._of(position)
            ]
        return texts

    def _of(self, position: int) -> Any:
        """Return the values of a column."""
        if position not in self._values:
            self._values[position] = self.rows.columns[position].values()
        return self._values[position]

    def read(self, block: range, table: Any) -> Records:
        """Return a block of rows as records."""
        part, size = slice(block.start, block.stop), len(block)
        cells: dict[str, Sequence[bytes]] = {}
        for name, position in table.columns.positions.items():
            cells[name] = cells_from(self._of(position)[part])
        for name, position in table.labels.items():
            values = self._of(position)
            cells[name] = [b""] * size if _are_doubles(values) else cells_of(values[part])
        records = Records(block, cells, {}, block, size)
        with_commas = {name: cells[name] for name, position in table.positions.items() if position in self._with_commas}
        if not with_commas:
            return records
        texts = with_decimal_points(records._replace(cells=with_commas))
        return texts._replace(cells=cells | {**texts.cells})


def cells_from(values: Any) -> Sequence[bytes]:
    """Return the values of a column as cells."""
    return Doubles(values) if _are_doubles(values) else cells_of(values)


def _include_texts(values: Any) -> bool:
    return isinstance(values, list) and any(isinstance(value, str | bytes) for value in values)


def _are_doubles(values: Any) -> bool:
    return not isinstance(values, list) and values.dtype.kind == "f"
