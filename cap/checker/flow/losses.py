"""The mechanics with losses: e and mu are any numbers, or known in intervals.

What a flight has of exponentials (``course``), with lambda = -mu: phi_k(-mu d), and 1/(w^2 + mu^2).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from cap.checker.flow.exponential import phi
from cap.checker.flow.mechanics import Box, Ends, Mechanics
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred, RealJet, lift
from cap.checker.kernel.series import composed, reciprocal
from cap.checker.system.course import GROWTH, INVERSE
from cap.checker.system.evaluation import evaluate
from cap.checker.system.polynomial import Polynomial, variable
from cap.checker.system.walls import Parameters


class Lossy(Mechanics):
    """The mechanics with losses.

    ``sets`` are intervals for some of the constants e and mu, in the place of those in the
    parameters: the last variables of the box.
    """

    def __init__(
        self,
        p: Parameters,
        box: Box,
        m: Box,
        order: int,
        periods: int = 1,
        sets: Mapping[str, Ends] | None = None,
    ) -> None:
        self.sets = sets or {}
        more = [Interval.enclosing(*q, box[0].bits) for q in self.sets.values()]
        box, m = [*box, *more], [*m, *(q.midpoint() for q in more)]
        super().__init__(p, box, m, order, periods)

    def _parameters(self, p: Parameters) -> dict[str, Centred]:
        """Return the constants that are no numbers, and where mu is one of them, the inverse."""
        found = self.varying(p)
        if "mu" in found:
            square = variable("mu") * variable("mu") + p.omega**2
            found[INVERSE] = lift(lambda mu: reciprocal(evaluate(square, {"mu": mu})), found["mu"])
        return found

    def varying(self, p: Parameters) -> dict[str, Centred]:  # noqa: ARG002
        """Return the constants that are no numbers: the last variables."""
        last = self.variables[len(self.variables) - len(self.sets) :]
        return dict(zip(self.sets, last, strict=True))

    def after(
        self, d: RealJet, powers: Sequence[Polynomial], values: Mapping[str, RealJet]
    ) -> RealJet:
        """Return the sum of polynomials times powers of d, with the exponentials in them."""
        known, names = dict(values), {name for q in powers for name in q.variables}
        for k, name in enumerate(GROWTH):
            if name in names:
                z = -(evaluate(self.laws.mass.mu, values) * d)
                known[name] = composed([phi(k, z.constant, n) for n in range(d.order + 1)], z)
        return super().after(d, powers, known)
