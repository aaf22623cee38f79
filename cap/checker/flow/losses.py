"""The mechanics with losses, from the data of its model (``friction``): e and mu are any numbers.

They may also be known in intervals.

*Flights.*  ``course`` gives x(t) and v(t) in each mode as polynomials: for the direction s = +-1,
x'' = F cos wt - s f - mu x'.  Any polynomial in the state, as a guard, and its derivative in time,
its Lie derivative, is known along a flight with them.  That p' = e^(mu t) (s F cos wt - f) is Lemma
C of ``lemmas`` (``one_mass``).

*Exponentials.*  What a flight has of them, with lambda = -mu: phi_k(-mu d), and 1/(w^2 + mu^2).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from cap.checker.flow.laws import laws
from cap.checker.flow.mechanics import Box, Ends, Flight, Formula, Mechanics, Moment
from cap.checker.kernel.exponential import phi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred, RealJet, lift
from cap.checker.kernel.rejection import need
from cap.checker.kernel.series import composed, reciprocal
from cap.checker.system.course import GROWTH, INVERSE
from cap.checker.system.evaluation import evaluate
from cap.checker.system.model import COS, SIN
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

    def constants(self, p: Parameters) -> None:
        """Set the constants, as the model has them."""
        self.parameters = self._parameters(p)
        self.laws = laws(p, tuple(self.parameters))
        mass = self.laws.mass
        self.omega, self.F = self.number(self.laws.model.omega), self.number(mass.F)
        self.friction, self.e, self.mu = (self.known(q) for q in (mass.f, mass.e, mass.mu))
        self.f = self.friction.value
        self.walls = {s: self.known(wall).value for s, wall in mass.walls.items()}

    def _minima(self, ratio: Fraction, periods: int) -> dict[int, list[Moment]]:  # noqa: ARG002
        """Return the moments of the local minima of p, with f/F as the model has it."""
        f, F = self.laws.mass.f, self.laws.mass.F
        need(not f.variables, "the friction is a parameter")
        return super()._minima(f.number / F, periods)

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

    def known(self, q: Polynomial) -> Centred:
        """Return a number, or a polynomial in parameters."""
        return self.of(q, {}) if q.variables else self.constant(self.number(q.number))

    def of(self, q: Polynomial, values: Mapping[str, Centred]) -> Centred:
        """Return a polynomial in these values and in parameters."""
        given = {**values, **self.parameters}
        return lift(lambda *jets: evaluate(q, dict(zip(given, jets, strict=True))), *given.values())

    # flights

    def course(self, s: int) -> tuple[Formula, Formula]:
        """Return the formulas of x and v on the flights of a direction."""
        return self.along(s, variable("x")), self.along(s, variable("v"))

    def along(self, s: int, g: Polynomial) -> Formula:
        """Return the formula of a polynomial in the state on the flights of a direction."""
        powers, names = self.laws.along(s, g), ("x", "v", "start", *self.parameters, "t", COS, SIN)

        def formula(arc: Sequence[RealJet], when: Sequence[RealJet]) -> RealJet:
            values = dict(zip(names, (*arc, *when), strict=True))
            return self.after(values["t"] - values["start"], powers, values)

        return formula

    def after(
        self, d: RealJet, powers: Sequence[Polynomial], values: Mapping[str, RealJet]
    ) -> RealJet:
        """Return the sum of polynomials times powers of d, by Horner's rule."""
        known, names = dict(values), {name for q in powers for name in q.variables}
        for k, name in enumerate(GROWTH):
            if name in names:
                z = -(evaluate(self.laws.mass.mu, values) * d)
                known[name] = composed([phi(k, z.constant, n) for n in range(d.order + 1)], z)
        *lower, total = (evaluate(q, known) for q in powers)
        for q in reversed(lower):
            total = d * total + q
        return total

    def flight(self, s: int, start: Moment, x: Centred, v: Centred) -> Flight:
        """Return the flight of direction s that starts at a moment from (x, v)."""
        given = {"x": x, "v": v, COS: start.cos, SIN: start.sin}
        rest_x, rest_v = (self.of(q, given) for q in self.laws.rests[s].values())
        arc = (rest_x, rest_v, start.t, *self.parameters.values())
        return Flight(s, arc, start, self.minima[s])
