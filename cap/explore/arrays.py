"""What an exploration found as named arrays, for .npz files, and back.

The names are paths, parts joined by a dot:

- an array, a number or a text has the name of its field; so has a list of numbers or texts;
- an exact rational is the text of it, such as ``2/5``;
- a record (a dataclass, a named tuple, a dictionary) is its fields: ``parameters.F``;
- a list of records with the same fields, all of them numbers or texts, is a table: one array for
  each field, ``orbits.x`` with a row for each orbit;
- any other list is its elements, counted from 0: ``found.0.states``;
- None is left out.

`load` gives the records back, as dictionaries and lists, and the parameters exactly.
"""

import zipfile
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.parameters import Parameters, exact
from cap.words import quoted

Array = NDArray[np.generic]
Scalar = np.generic | bool | int | float | str


def arrays(record: Any) -> dict[str, Array]:
    """Return the arrays of a record, by name.  Raises `TypeError` for what is none of the above."""
    return dict(_named("", record))


def load(path: Path | str) -> dict[str, Any]:
    """Return what `arrays` made, from a file: dictionaries, lists, arrays, numbers and texts.

    ``parameters`` are `cap.parameters.Parameters`.  A table is a dictionary of arrays.  Raises
    `BadInput` if the file cannot be read.
    """
    try:
        with zipfile.ZipFile(path) as archive, Path(path).open("rb") as file:
            if archive.testzip() is not None:
                raise BadZipFile
            with np.load(file, allow_pickle=False) as each:
                found = {name: each[name] for name in each.files}
    except (OSError, ValueError, EOFError, BadZipFile) as error:
        why = getattr(error, "strerror", None) or "it is no .npz file, or a damaged one"
        raise BadInput(f"cannot read {quoted(Path(path))}: {why}") from None
    return _decoded({name: value[()] for name, value in found.items()})


def _named(name: str, value: Any) -> Iterator[tuple[str, Array]]:
    """Give the arrays of a value and their names."""
    if value is None:
        return
    if isinstance(value, np.ndarray) and value.dtype != object:
        yield name, value
    elif isinstance(value, Fraction):
        yield name, np.array(str(value))
    elif isinstance(value, Scalar):
        yield name, np.asarray(value)
    elif (record := _record(value)) is not None:
        for key, part in record.items():
            yield from _named(_joined(name, key), part)
    elif isinstance(value, list | tuple):
        yield from _listed(name, value)
    else:
        raise TypeError(f"{name} cannot be written as an array: {type(value).__name__}")


def _listed(name: str, values: list[Any] | tuple[Any, ...]) -> Iterator[tuple[str, Array]]:
    """Give the arrays of a list: of numbers or texts, a table, or element by element."""
    exact_texts = [str(each) if isinstance(each, Fraction) else each for each in values]
    if all(isinstance(each, Scalar) for each in exact_texts):
        yield name, np.array(exact_texts)
        return
    table = [_record(each) for each in values]
    if _is_table(table):
        for key in table[0] or {}:
            yield from _named(_joined(name, key), [row[key] for row in table if row])
        return
    for k, each in enumerate(values):
        yield from _named(_joined(name, str(k)), each)


def _is_table(rows: list[dict[str, Any] | None]) -> bool:
    """Return whether these are records with the same fields, all of them numbers or texts."""
    first = rows[0]
    return first is not None and all(
        row is not None
        and row.keys() == first.keys()
        and all(isinstance(part, Scalar | Fraction) for part in row.values())
        for row in rows
    )


def _record(value: Any) -> dict[str, Any] | None:
    """Return the fields of a record, None if it is none."""
    if is_dataclass(value):
        return {field.name: getattr(value, field.name) for field in fields(value)}
    if isinstance(value, tuple) and hasattr(value, "_asdict"):
        return dict(value._asdict())
    if isinstance(value, Mapping):
        return {str(key): part for key, part in value.items()}
    return None


def _joined(name: str, part: str) -> str:
    return f"{name}.{part}" if name else part


def _decoded(flat: dict[str, Any]) -> dict[str, Any]:
    """Return the tree of what has paths as names."""
    tree: dict[str, Any] = {}
    for path, value in flat.items():
        *above, last = path.split(".")
        branch = tree
        for part in above:
            branch = branch.setdefault(part, {})
        branch[last] = value.item() if isinstance(value, np.generic) else value
    return {key: _grown(key, part) for key, part in tree.items()}


def _grown(name: str, value: Any) -> Any:
    """Return parameters, lists and dictionaries for what has been a dictionary so far."""
    if not isinstance(value, dict):
        return value
    if name == "parameters":
        return Parameters(**{key: exact(text) for key, text in value.items()})
    parts: dict[str, Any] = {key: _grown(key, part) for key, part in value.items()}
    counted = [str(k) for k in range(len(parts))]
    return [parts[key] for key in counted] if set(parts) == set(counted) else parts
