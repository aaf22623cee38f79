"""Records: a few numbers in memory with names, the same for Python and for compiled code.

A subclass lists its fields as annotations: float, int, `Interval`, or another record, which lies
inside.  Compiled code is given the address of a record, and reads and writes the memory there, so a
record may have many fields, and is passed on at no cost.  A field that is a record is not
assigned to but written into, with `assign`.
"""

from collections.abc import Callable
from typing import Any, ClassVar, NamedTuple, TypeVar, get_type_hints

import numpy as np
from numpy.typing import NDArray

from cap.sets.doubles import Interval

R = TypeVar("R", bound="Record")


class Field(NamedTuple):
    """What a field holds, and the number of doubles before it."""

    kind: Any
    place: int


class Record:
    """Fields in an array of doubles, ``memory``, in the order of the annotations."""

    FIELDS: ClassVar[dict[str, Field]] = {}
    SIZE: ClassVar[int] = 0

    def __init_subclass__(cls) -> None:
        """Lay the fields out."""
        place, fields = 0, dict[str, Field]()
        for name, kind in get_type_hints(cls).items():
            if name not in ("FIELDS", "SIZE", "memory"):
                fields[name] = Field(kind, place)
                place += _size(kind)
        cls.FIELDS, cls.SIZE = fields, place

    def __init__(self, memory: NDArray[np.float64] | None = None, **values: Any) -> None:
        """Give names to an array of ``SIZE`` doubles; without one, to a new one of zeros."""
        object.__setattr__(self, "memory", np.zeros(self.SIZE) if memory is None else memory)
        for name, value in values.items():
            setattr(self, name, value)

    @property
    def address(self) -> int:
        """The address of the memory."""
        return int(self.memory.ctypes.data)

    def __getattr__(self, name: str) -> Any:
        """Return the value of a field."""
        kind, place = self._field(name)
        memory = self.memory[place : place + _size(kind)]
        if issubclass(kind, Record):
            return kind(memory)
        if kind is Interval:
            return Interval(*memory.tolist())
        return int(memory.view(np.int64)[0]) if kind is int else float(memory[0])

    def __setattr__(self, name: str, value: Any) -> None:
        """Write the value of a field."""
        kind, place = self._field(name)
        memory = self.memory[place : place + _size(kind)]
        if kind is int:
            memory.view(np.int64)[0] = value
        elif kind is Interval:
            memory[:] = value.mid, value.rad
        elif kind is float:
            memory[0] = value
        else:
            assign(getattr(self, name), value)

    def _field(self, name: str) -> Field:
        try:
            return type(self).FIELDS[name]
        except KeyError:
            raise AttributeError(f"{type(self).__name__} has no field {name!r}") from None

    memory: NDArray[np.float64]


def _size(kind: Any) -> int:
    return kind.SIZE if issubclass(kind, Record) else 2 if kind is Interval else 1


def assign(target: Record, source: Record) -> None:
    """Write the fields of a record of the same kind into a record."""
    target.memory[:] = source.memory


def row_of(kind: type[R]) -> Callable[[NDArray[np.float64], int], R]:
    """Return the function that gives the record whose fields are a row of a table."""

    def row(table: NDArray[np.float64], k: int) -> R:
        return kind(table[k])

    return row
