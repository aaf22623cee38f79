"""A mass between walls that may lose speed: all its parameters, and what it is in words."""

from __future__ import annotations

from typing import Any, ClassVar

from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.system.walls import BetweenWalls, Parameters

WITH_LOSSES: dict[str, Any] = dict.fromkeys(Parameters._fields, number)
SYSTEM = (
    "x'' = F cos(omega t) - f sgn x' - mu x' with F = {F}, omega = {omega}, f = {f}, mu = {mu} and "
    "walls at l = {l} and r = {r}, where v becomes -e v with e = {e}: "
)


class WithLosses(BetweenWalls):
    """A theorem about a mass that may lose speed."""

    PARAMETERS: ClassVar[dict[str, Any]] = WITH_LOSSES

    @classmethod
    def parameters(cls, given: dict[str, Any]) -> Any:
        """Return the parameters."""
        p = super().parameters(given)
        need(0 < p.e <= 1, "0 < e <= 1 does not hold")
        need(p.mu >= 0, "mu >= 0 does not hold")
        return p
