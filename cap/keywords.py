"""The keywords of the Python interface, with their types: a type checker finds what is mistyped."""

from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path
from typing import TypedDict

Exact = str | int | Fraction
"""An exact number: "0.4" is 2/5.  A float is refused: it is the binary double next to it."""


class System(TypedDict, total=False):
    """The parameters of the oscillator; those left out are the paper's."""

    F: Exact | None
    omega: Exact | None
    f: Exact | None
    l: Exact | None
    r: Exact | None
    e: Exact | None
    mu: Exact | None


class Options(System, total=False):
    """Those of a theorem: what `cap.prove THEOREM --help` lists, without hyphens.

    ``lowest`` and ``highest`` are a range of f (``--from``, ``--to``).
    """

    epsilon: Exact | None
    orbit: Sequence[float | Exact] | None
    digits: int | str | None
    lowest: Exact | None
    highest: Exact | None
    period: int | str | None
    order: int | str | None
    masses: str | Sequence[Exact] | None
    proportional: bool | str | None
    jobs: int | str | None
    journal: str | Path | None
    flights: int | str | None
    periods: int | str | None
    degree: int | str | None
    speed: Exact | None
    undecided: Exact | None
    points: int | str | None
    count: int | str | None
    rotation: str | None
    largest: bool | None
    effort: int | str | None
    sets: str | None
