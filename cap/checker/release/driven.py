"""The mechanics for a whole interval of f: f = F cos theta, and theta is a variable of the jets.

So f/F, and the times (2 pi k - theta)/w and (2 pi k + pi - theta)/w at which p has its local minima
and a mass at rest is released (``mechanics``), are simple functions of a variable, and what
depends on f by several ways is enclosed in mean value form.  The last variable is theta, which must
lie in (0, pi/2): with -theta for theta, at these times p would have its maxima.

*Events.*  Every formula of ``mechanics``, ``hits`` and ``stops`` holds for each value of the
variables separately; conditions are tested with enclosures over the box, of f as well.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from cap.checker.flow.events import LossyMap
from cap.checker.flow.losses import Lossy
from cap.checker.flow.mechanics import Box, Ends, Moment
from cap.checker.kernel.arctangent import arccos, pi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred, cos_sin_jet, lift
from cap.checker.kernel.rejection import need
from cap.checker.release.halts import HALTS, halt
from cap.checker.system.walls import Parameters


def phases(p: Parameters, f: Ends, bits: int) -> Interval:
    """Return an enclosure of theta for all f of an interval."""
    return arccos(Interval.enclosing(f[0] / p.F, f[1] / p.F, bits))


class Driven(Lossy):
    """The mechanics with theta for the last variable; the f of the parameters is not used."""

    def varying(self, p: Parameters) -> dict[str, Centred]:
        """Return f as a function of theta."""
        self.theta = self.variables[-1]
        theta, F = self.theta.value, self.number(p.F)
        acute = theta.is_positive() and theta.is_before(pi(self.bits) / 2)
        need(acute, "theta is not between 0 and pi/2: 0 < f < F may not hold")
        pairs = [cos_sin_jet(jet) for jet in (self.theta.centre, self.theta.box)]
        self.cosine, self.sine = (self.centred(*jets) for jets in zip(*pairs, strict=True))
        return {"f": lift(lambda cos: cos * F, self.cosine)}

    def _minima(self, ratio: Fraction, periods: int) -> dict[int, list[Moment]]:  # noqa: ARG002
        """Return the moments in [0, horizon] at which p has its local minima, for each sign s."""
        half_turn = pi(self.bits)

        def minimum(k: int, s: int) -> Moment:
            turns = self.constant(half_turn * k)
            unit = half_turn.integer(1) / self.omega
            t = lift(lambda q, theta: (q - theta) * unit, turns, self.theta)
            signed = (self.cosine, s), (self.sine, -s)
            cos, sin = (lift(lambda q, n=n: q * n, z) for z, n in signed)
            return Moment(t, cos, sin)

        rising = [minimum(2 * k, 1) for k in range(1, periods + 1)]
        return {1: rising, -1: [minimum(2 * k + 1, -1) for k in range(periods)]}


@dataclass(frozen=True)
class DrivenMap(LossyMap):
    """The flow for a whole interval of f; of stops near a release arc's end, ``halts`` tells."""

    def mechanics(self, box: Box, m: Box, order: int) -> Driven:
        """Return the mechanics over a box, of which theta is the last side."""
        return Driven(self.p, box, m, order, self.periods)

    def event(self, M: Any, before: list[Any], now: Any, word: str, window: Ends) -> Any:
        """Prove the next event, and return it with the state after it."""
        if word in HALTS:
            return halt(M, now, word, window)
        return super().event(M, before, now, word, window)
