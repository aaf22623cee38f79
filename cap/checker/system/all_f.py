"""What theorems about a mass between two walls share that hold for all f: f is no parameter."""

from __future__ import annotations

from fractions import Fraction
from typing import Any, ClassVar

from cap.checker.system.walls import WITHOUT_LOSSES, BetweenWalls


def without_f(parameters: dict[str, Any]) -> dict[str, Any]:
    """Return the shapes of the other parameters."""
    return {name: shape for name, shape in parameters.items() if name != "f"}


class ForAllF(BetweenWalls):
    """A theorem for all f, or for several."""

    PARAMETERS: ClassVar[dict[str, Any]] = without_f(WITHOUT_LOSSES)

    @classmethod
    def parameters(cls, given: dict[str, Any]) -> Any:
        """Return the parameters; f is set to 0, and is not used."""
        return super().parameters({"f": Fraction(0)} | given)


def told(system: str) -> str:
    """Return the words on a system for all f."""
    return system.replace("f = {f}", "0 < f < F")
