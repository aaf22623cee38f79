"""Flights of a mode whose field is linear, with any rational numbers: springs and dampers, too.

With the clock in the state, y = (z, cos wt, sin wt, 1), the field A z + b + c cos wt + s sin wt of
the mode is y' = M y with the matrix

        A  c  s  b
    M = 0  0 -w  0      and so      y(t) = exp(M (t - t_0)) y(t_0)
        0  w  0  0
        0  0  0  0

for every A: there is no case of resonance.  Beyond its ends a flight is continued by this formula.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from cap.checker.kernel.elementary import cos_sin
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Jet
from cap.checker.kernel.rejection import need
from cap.checker.system.evaluation import evaluate
from cap.checker.system.exponential import Exponential
from cap.checker.system.model import CLOCK, Model
from cap.checker.system.polynomial import Polynomial


def matrix(model: Model, mode: str) -> list[list[Fraction]]:
    """Return M; a field that is not linear, or has parameters, rejects."""
    field, w, names = model.modes[mode].field, model.omega, (*model.state, *CLOCK)
    none = Fraction(0)
    rows = list[list[Fraction]]()
    for z in model.state:
        constants = [*(field[z].derivative(y) for y in names), field[z].without(names)]
        need(all(q.terms.keys() <= {()} for q in constants), f"the mode {mode} is not linear")
        rows.append([q.number for q in constants])
    zeros = [none] * len(model.state)
    return [*rows, [*zeros, none, -w, none], [*zeros, w, none, none], [none] * len(rows[0])]


class Leg:
    """The flights in a mode from a box of states, each from a time in an interval on.

    exp(M d) may be ``known``, with what other legs of the mode have computed of it.
    """

    def __init__(
        self,
        model: Model,
        mode: str,
        start: Interval,
        state: Mapping[str, Interval],
        known: Exponential | None = None,
    ) -> None:
        self.model, self.mode, self.start = model, mode, start
        self.exponential = known or Exponential(matrix(model, mode), start.bits)
        begin = [state[z] for z in model.state]
        self.begin = [*begin, *self._clock(start), start.integer(1)]

    def _clock(self, t: Interval) -> tuple[Interval, Interval]:
        """Return cos wt and sin wt."""
        return cos_sin(t * Interval.enclosing(self.model.omega, self.model.omega, t.bits))

    def state(self, t: Interval) -> dict[str, Interval]:
        """Return the state at all times of an interval, for all of the flights."""
        return {z: self._variable(z, t) for z in self.model.state}

    def _variable(self, z: str, t: Interval) -> Interval:
        """Return one of its variables."""
        row = self.exponential.over(self.model.state.index(z), t - self.start)[0]
        return sum((a * y for a, y in zip(row, self.begin, strict=True)), t.integer(0))

    def over(self, g: Polynomial, t: Interval) -> Interval:
        """Return a polynomial in the state at all times of an interval, for all of the flights."""
        values = dict(zip(CLOCK, self._clock(t), strict=True))
        values |= {z: self._variable(z, t) for z in self.model.state if z in g.variables}
        jets = {name: Jet(0, {(): q}) for name, q in values.items()}
        return evaluate(g, jets).constant
