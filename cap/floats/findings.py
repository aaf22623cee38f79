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
class Findings(ABC):
    """The data of one picture.  ``complete`` is False if it was interrupted: the rest is nan."""

    parameters: Parameters
    complete: bool = True

    def given(self) -> dict[str, str]:
        """Return what is given exactly, for the head of a table."""
        return self.parameters.strings()

    @abstractmethod
    def columns(self) -> Mapping[str, ArrayLike]:
        """Return the columns of a table; they broadcast to one shape."""

    @abstractmethod
    def lines(self) -> list[str]:
        """Return its numbers in words."""
