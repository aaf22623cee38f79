"""The data of a picture of orbits in time: a row for each."""

from dataclasses import dataclass
from typing import NamedTuple

from cap.floats.diagnostics.trajectory import Trajectory
from cap.floats.findings import Floats


class Row(NamedTuple):
    """An orbit, what to write above it; a portrait (else its phase plane), what to write there."""

    orbit: Trajectory
    title: str
    portrait: Floats | None = None
    words: str = ""


@dataclass(frozen=True)
class Rows:
    """Some rows, what to write above them, and which parameters are left out there."""

    rows: tuple[Row, ...]
    heading: str
    but: tuple[str, ...] = ()
    forcing: bool = True
