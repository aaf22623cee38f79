"""What an exploration found: numbers and arrays, a table of them, and what they say in words."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cap.parameters import Parameters

Floats = NDArray[np.float64]
State = tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class Data(ABC):
    """The data of one picture.  ``complete`` is False if it was interrupted: the rest is nan."""

    complete: bool = True

    @abstractmethod
    def given(self) -> dict[str, str]:
        """Return what is given exactly, and does not vary, for the head of a table."""

    @abstractmethod
    def columns(self) -> Mapping[str, ArrayLike]:
        """Return the columns of a table; they broadcast to one shape."""

    @abstractmethod
    def lines(self) -> list[str]:
        """Return its numbers in words."""


@dataclass(frozen=True, kw_only=True)
class Findings(Data):
    """What was found of the oscillator with these parameters."""

    parameters: Parameters

    def varying(self) -> Mapping[str, Floats]:
        """Return the values of the parameters that vary; only the others are `parameters`."""
        return {}

    def given(self) -> dict[str, str]:
        """Return what is given exactly, and does not vary, for the head of a table."""
        p, varying = self.parameters, self.varying()
        if "R" not in varying:
            return {name: q for name, q in p.strings().items() if name not in varying}
        fixed = {name: q for name, q in p.strings().items() if name not in {*varying, "l", "r"}}
        return fixed | {"(l + r)/2": str((p.l + p.r) / 2)}
