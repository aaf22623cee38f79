"""What an exploration gives: named arrays and numbers, and what they say in words."""

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cap.errors import BadInput
from cap.parameters import PAPER, Parameters

Floats = NDArray[np.float64]
State = tuple[float, float]

VARIABLE = ("F", "omega", "f", "R", "e", "mu")
"""The parameters that may vary; R moves both walls, their middle stays."""


@dataclass(frozen=True, kw_only=True)
class Study(ABC):
    """The data of one picture.  ``complete`` is False if it was interrupted: the rest is nan."""

    parameters: Parameters
    complete: bool = True

    @abstractmethod
    def columns(self) -> Mapping[str, ArrayLike]:
        """Return the columns of a table; they broadcast to one shape."""

    @abstractmethod
    def lines(self) -> list[str]:
        """Return its numbers in words."""


def varied(p: Parameters, name: str, value: float | Fraction) -> Parameters:
    """Return the parameters with one of `VARIABLE` changed to ``value``, exactly."""
    if name not in VARIABLE:
        raise BadInput(f"no such parameter: {name!r} (one of {', '.join(VARIABLE)})")
    exact = Fraction(value)
    if name == "R":
        middle = (p.l + p.r) / 2
        return replace(p, l=middle - exact / 2, r=middle + exact / 2)
    return replace(p, **{name: exact})


def value_of(p: Parameters, name: str) -> float:
    """Return one of `VARIABLE` as a float."""
    if name not in VARIABLE:
        raise BadInput(f"no such parameter: {name!r} (one of {', '.join(VARIABLE)})")
    return float(getattr(p, name))


def described(p: Parameters) -> str:
    """Return the parameters for a line of text; those of losses only if there are any."""
    paper = PAPER.strings()
    strings = {**p.strings(), "R": str(p.R)}
    shown = ["F", "omega", "f", "R"]
    shown += [name for name in ("e", "mu") if strings[name] != paper[name]]
    return ", ".join(f"{name} = {short(strings[name])}" for name in shown)


def short(number: str) -> str:
    """Return an exact number as it is if it is short, else six digits of it."""
    return number if len(number) <= 8 else f"{float(Fraction(number)):.6g}"


def with_error(value: float, error: float) -> str:
    """Return a number with two digits of its error; with six digits if it has none."""
    if not (math.isfinite(value) and error > 0):
        return f"{value:.6g}"
    places = max(0, 1 - math.floor(math.log10(error)))
    return f"{value:.{places}f} +- {error:.{places}f}"
