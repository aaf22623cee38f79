"""A family of periodic orbits of a model over a parameter: Newton's method on it, and its tangent.

The unknowns are the state q at t = 0 and the parameter p, with F(q, p) = 0 for the state after the
periods less q.  Derivatives by q are products of saltation matrices, those by p are differences.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.floats.models.closing import Start, logged, product
from cap.floats.models.engine import Ends
from cap.floats.models.legs import Legs
from cap.floats.models.spectrum import Floats
from cap.floats.models.subject import Subject

NEAR, ROUNDS, STEP = 1e-10, 12, 1e-6  # of Newton's iteration; of differences by the parameter
KEPT = 8  # models at values of the parameter


@dataclass(frozen=True)
class Station:
    """An orbit on the branch: y = (q, p) in units, its tangent, multipliers, events, dF/dy.

    ``nearest``: of an event to the ends of the time, as a part of it.
    """

    y: Floats
    tangent: Floats
    multipliers: NDArray[np.complex128]
    crossing: float
    words: tuple[int, ...]
    slopes: Floats
    nearest: float

    @property
    def flip(self) -> float:
        """The product of 1 + multiplier."""
        return float(np.prod(1 + self.multipliers).real)

    @property
    def circle(self) -> float:
        """1 less the modulus of a complex pair, of the one nearest to 1; 1 if there is none."""
        pairs = 1 - np.abs(self.multipliers[self.multipliers.imag > 0])
        return float(pairs[np.argmin(np.abs(pairs))]) if len(pairs) else 1.0


@dataclass(frozen=True)
class Family:
    """Orbits of a period of ``count`` T over a parameter; ``unit`` (n + 1,) of y."""

    subject: Subject
    parameter: str
    count: int
    mode: int
    unit: Floats
    made: dict[float, Subject] = field(default_factory=dict)

    def at(self, value: float) -> Subject:
        """Return the model with a value of the parameter."""
        if value not in self.made:
            while len(self.made) > KEPT:
                self.made.pop(next(iter(self.made)))
            self.made[value] = self.subject.at(self.parameter, Fraction(value))
        return self.made[value]

    def returned(self, q: Floats, value: float, counts: NDArray[np.int64] | None = None) -> Floats:
        """Return the state after the periods.

        It is nan if the orbit is lost, ends in another mode, or has not as many events as
        ``counts`` says: then one of them is before t = 0, or after the end.
        """
        ends = self.at(value).engine.follow(q[None], np.array([self.mode]), periods=self.count)
        fine = not ends.flags[0] and ends.modes[0] == self.mode
        fine = fine and (counts is None or np.array_equal(ends.counts[0], counts))
        return ends.states[0] if fine else np.full(len(q), np.nan)

    def slopes(self, y: Floats) -> tuple[Floats, Floats, Ends]:
        """Return dF/dy (n, n + 1) in units, the derivative by the state, and the orbit's end."""
        *_, value = y * self.unit
        q, subject = (y * self.unit)[:-1], self.at(value)
        start = Start(q, self.mode)
        ends = logged(subject.engine, start.states, start.modes, self.count)
        legs = Legs.of(subject.engine, start.states, start.modes, ends, self.count * subject.period)
        D, d = product(legs.derivatives()), STEP * self.unit[-1]
        below, here, above = (
            self.returned(q, at, ends.counts[0]) for at in (value - d, value, value + d)
        )
        by = (above - below) / (2 * d)
        for side in (above - here, here - below):  # an event leaves the periods on the other side
            by = np.where(np.isnan(by), side / d, by)
        J = np.column_stack([(D - np.eye(len(q))) * self.unit[:-1], by * self.unit[-1]])
        return J, D, ends

    def corrected(self, y: Floats, tangent: Floats, near: Station) -> Station | None:
        """Return the orbit near y in the plane across the tangent; None if there is none.

        The slopes are those of an orbit ``near``, so that an iteration follows one orbit.
        """
        try:
            J = near.slopes
            guess, last = y, np.inf
            for _ in range(ROUNDS):
                q, value = (guess * self.unit)[:-1], float((guess * self.unit)[-1])
                gap = self.returned(q, value) - q
                right = np.append(-gap, -tangent @ (guess - y))
                step = np.linalg.solve(np.vstack([J, tangent]), right)
                size = float(np.abs(step).max())
                if not size < 2 * last:
                    return None
                guess, last = guess + step, size
                if size < NEAR:
                    return self.station(guess, tangent)
        except (BadInput, np.linalg.LinAlgError):
            return None
        return None

    def station(self, y: Floats, before: Floats) -> Station:
        """Return what is told of an orbit; its tangent points as the one before."""
        J, D, ends = self.slopes(y)
        if not np.isfinite(J).all():
            raise BadInput("the orbit is lost nearby")
        tangent = np.linalg.svd(J)[2][-1]
        tangent = tangent if tangent @ before > 0 else -tangent
        values = np.linalg.eigvals(D).astype(np.complex128)
        order = np.argsort(-np.abs(values), kind="stable")
        crossing = float(np.linalg.det(np.vstack([J, tangent])))
        words = tuple(ends.log[:, 2].astype(int).tolist())
        part = ends.log[:, 1] / (self.count * self.at(float((y * self.unit)[-1])).period)
        nearest = float(np.minimum(part, 1 - part).min()) if len(part) else 1.0
        return Station(y, tangent, values[order], crossing, words, J, nearest)
