"""Files of what was explored: pictures, and tables of their data.  Written whole or not at all."""

import csv
import io
from collections.abc import Callable
from pathlib import Path
from typing import IO, TYPE_CHECKING

import numpy as np

from cap.command.output import writable, writing
from cap.errors import BadInput
from cap.explore.arrays import arrays
from cap.files import replacing
from cap.floats.findings import Data
from cap.words import quoted

if TYPE_CHECKING:
    from matplotlib.figure import Figure

IMAGES = ("png", "pdf", "svg")
DATA = ("csv", "npz")
ROWS = 100_000  # of a table in text, at a time


def kind(path: Path) -> str:
    """Return what is to be written to ``path``, by its suffix; `BadInput` if it cannot be."""
    suffix = path.suffix[1:].lower()
    if suffix not in IMAGES + DATA:
        known = ", ".join("." + name for name in IMAGES + DATA)
        raise BadInput(f"cannot tell what to write to {quoted(path)}: end it in one of {known}")
    writable(path)
    return suffix


def write(findings: Data, path: Path, draw: Callable[[], "Figure"]) -> None:
    """Write findings to ``path``; ``draw`` is called if that is an image."""
    suffix = kind(path)
    with writing(path), replacing(path) as file:
        if suffix == "npz":
            np.savez_compressed(file, **arrays(findings))  # type: ignore[arg-type]
        elif suffix == "csv":
            _table(findings, file)
        else:
            save(draw(), suffix, file)


def _table(findings: Data, file: IO[bytes]) -> None:
    """Write the columns, after the parameters as a comment; numbers are read back exactly."""
    columns = findings.columns()
    arrays = np.broadcast_arrays(*(np.asarray(column) for column in columns.values()))
    text = io.TextIOWrapper(file, encoding="utf-8", newline="", write_through=True)
    parameters = ", ".join(f"{k} = {q}" for k, q in findings.given().items())
    text.write(f"# {parameters}{'' if findings.complete else '; interrupted'}\n")
    writer = csv.writer(text)
    writer.writerow(columns)
    for k in range(0, arrays[0].size, ROWS):
        rows = (array.flat[k : k + ROWS].tolist() for array in arrays)
        writer.writerows(zip(*rows, strict=True))
    text.detach()


def image(path: Path) -> str:
    """Return what picture is to be written to ``path``; `BadInput` if it cannot be."""
    suffix = kind(path)
    if suffix not in IMAGES:
        raise BadInput(f"no picture: {quoted(path)}")
    return suffix


def save(figure: "Figure", suffix: str, file: IO[bytes]) -> None:
    """Write a figure, the same bytes every time."""
    import matplotlib as mpl  # noqa: PLC0415 (only who draws waits for it)

    stamp = {"png": {"Software": None}, "pdf": {"CreationDate": None}, "svg": {"Date": None}}
    with mpl.rc_context({"svg.hashsalt": "cap", "pdf.fonttype": 42}):
        figure.savefig(file, format=suffix, metadata=stamp[suffix])
