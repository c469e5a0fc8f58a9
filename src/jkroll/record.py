"""Records: tuples with named fields as `typing.NamedTuple` makes them, at a fifth of its cost at import.

A named tuple starts Python's compiler for each class, and a call of one line has some twenty: a twentieth of its time.
What users make, or what is made in great numbers, stays a `NamedTuple`, whose own `__new__` is faster.
"""

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

__all__ = ["Record"]

if TYPE_CHECKING:  # to which a record is a named tuple
    from typing import NamedTuple as Record
else:
    from collections import _tuplegetter  # which reads a field

    class Record(tuple):
        """Base of records: a subclass has annotated fields, some of them with defaults."""

        def __init_subclass__(cls) -> None:
            cls._fields = tuple(cls.__annotations__)
            cls._field_defaults = {name: vars(cls)[name] for name in cls._fields if name in vars(cls)}
            for place, name in enumerate(cls._fields):
                setattr(cls, name, _tuplegetter(place, None))

        def __new__(cls, *values: Any, **named: Any) -> "Record":
            """Return a record of values by place or by name; raise TypeError for others than its fields."""
            rest = [named.pop(name, cls._field_defaults.get(name, ...)) for name in cls._fields[len(values) :]]
            record = tuple.__new__(cls, (*values, *rest))
            if named or any(value is ... for value in rest) or len(record) > len(cls._fields):
                raise TypeError(f"{cls.__name__} has the fields {', '.join(cls._fields)}")
            return record

        @classmethod
        def _make(cls, values: Iterable[Any]) -> "Record":
            return cls(*values)

        def _replace(self, **named: Any) -> "Record":
            return type(self)(**{**self._asdict(), **named})

        def _asdict(self) -> dict[str, Any]:
            return dict(zip(self._fields, self, strict=True))

        def __getnewargs__(self) -> tuple[Any, ...]:
            return tuple(self)

        def __repr__(self) -> str:
            return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in self._asdict().items())})"
