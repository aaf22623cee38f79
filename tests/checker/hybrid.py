"""A test tool: the flow with hits, turns, sticks and captures, apart from prover and checker.

Written with h = (1 - exp(-mu d))/mu; its derivative is a product of saltation matrices.  Event
times are found by bisection on pieces on which v exp(mu t) is monotone, then by Newton's method.
Nothing here is rigorous.
"""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

import mpmath

NAMES = ("F", "omega", "f", "l", "r", "e", "mu")


class Event(NamedTuple):
    """An event: its word, its time, the speed before it and the forcing."""

    word: str
    t: object
    speed: object
    force: object


class Flow:
    """The flow from t = 0 in the arithmetic of a context of mpmath (``mp``, ``fp``)."""

    def __init__(self, parameters, context=mpmath.mp):
        self.c = c = context
        values = {"e": "1", "mu": "0"} | parameters
        for name in NAMES:
            q = Fraction(values[name])
            setattr(self, name, c.mpf(q.numerator) / q.denominator)
        self.T = 2 * c.pi / self.omega
        self.tiny = c.mpf(10) ** (-c.dps // 2)

    def force(self, t):
        """Return F cos wt."""
        return self.F * self.c.cos(self.omega * t)

    def particular(self, t):
        """Return x_p and v_p."""
        c, w, mu = self.c, self.omega, self.mu
        P, cos, sin = self.F / (mu**2 + w**2), c.cos(w * t), c.sin(w * t)
        return P * (mu / w * sin - cos), P * (mu * cos + w * sin)

    def decay(self, d):
        """Return exp(-mu d), its integral, and the integral of that."""
        c, mu = self.c, self.mu
        if mu == 0:
            return c.mpf(1), d, d * d / 2
        h = -c.expm1(-mu * d) / mu
        return c.exp(-mu * d), h, (d - h) / mu

    def state(self, start, s, t):
        """Return x and v at the time t of the flight from start = (t0, x0, v0)."""
        t0, x0, v0 = start
        (a, b), (A, B), (D, h, k) = self.particular(t), self.particular(t0), self.decay(t - t0)
        x = a + x0 - A + (v0 - B) * h - s * self.f * k
        return x, b + (v0 - B) * D - s * self.f * h

    def phases(self, s, after, until):
        """Return the times in (after, until) at which F cos wt = s f, increasing."""
        c, theta = self.c, self.c.acos(s * self.f / self.F)
        first = int(c.floor(after / self.T)) - 1
        last = int(c.ceil(until / self.T)) + 1
        times = [
            (2 * c.pi * k + sign * theta) / self.omega
            for k in range(first, last + 1)
            for sign in (-1, 1)
        ]
        return [t for t in times if after + self.tiny < t < until]

    def root(self, g, slope, a, b):
        """Return the zero of g in [a, b], where g(a) < 0 <= g(b)."""
        for _ in range(45):
            m = (a + b) / 2
            a, b = (m, b) if g(m) < 0 else (a, m)
        t = (a + b) / 2
        for _ in range(6):
            t = t - g(t) / slope(t) if slope(t) else t
        return t

    def next_event(self, start, s, until):
        """Return the kind and time of the end of a flight: "hit", "stop" or "end"."""
        a, wall = start[0], self.r if s > 0 else self.l
        for b in [*self.phases(s, a, until), until]:
            end, kind = b, None
            if s * self.state(start, s, b)[1] < 0:
                end = self.root(
                    lambda t: -s * self.state(start, s, t)[1],
                    lambda t: (
                        -s * (self.force(t) - s * self.f - self.mu * self.state(start, s, t)[1])
                    ),
                    a,
                    b,
                )
                kind = "stop"
            if s * (self.state(start, s, end)[0] - wall) > 0:
                t = self.root(
                    lambda t: s * (self.state(start, s, t)[0] - wall),
                    lambda t: s * self.state(start, s, t)[1],
                    a,
                    end,
                )
                return "hit", t
            if kind:
                return kind, end
            a = b
        return "end", until

    def run(self, x, v, periods=1, capture_below=None):
        """Return the events, the final state, and the derivative of the map, as a matrix.

        A capture is recorded when the mass is at a wall, pressed to it, slower than the bound.
        """
        c = self.c
        t, s, until, events = c.mpf(0), 1 if v > 0 else -1, self.T * periods, []
        J = c.matrix([[1, 0], [0, 1]])
        while True:
            start = (t, x, v)
            kind, t = self.next_event(start, s, until)
            D, h, _ = self.decay(t - start[0])
            J = c.matrix([[1, h], [0, D]]) * J
            x, v = self.state(start, s, t)
            a = self.force(t)
            if kind == "end":
                return events, (x, v), J
            if kind == "hit":
                events.append(Event(f"hit {'r' if s > 0 else 'l'}", t, abs(v), a))
                kick = ((1 + self.e) * a + (1 - self.e) * s * self.f) / v
                J = c.matrix([[-self.e, 0], [kick, -self.e]]) * J
                x, v, wall, s = (self.r if s > 0 else self.l), -self.e * v, s, -s
                if capture_below and abs(v) < capture_below and wall * a > self.f:
                    events.append(Event(f"capture {'r' if wall > 0 else 'l'}", t, abs(v), a))
                    side, J = -wall, J * 0
                else:
                    continue
            elif abs(a) > self.f:
                side = 1 if a > 0 else -1
                events.append(Event(f"turn {'right' if a > 0 else 'left'}", t, None, a))
                J = c.matrix([[1, 0], [0, (abs(a) - self.f) / (abs(a) + self.f)]]) * J
                s, v = side, c.mpf(0)
                continue
            else:
                events.append(Event("stick", t, None, a))
                side, J = None, c.matrix([[1, 0], [0, 0]]) * J
            t, s = self.released(t, side)
            if t > until:
                return events, (x, c.mpf(0)), J
            v = c.mpf(0)
            events.append(Event(f"release {'right' if s > 0 else 'left'}", t, None, s * self.f))

    def released(self, t, side):
        """Return time and direction of the first release after t, to the side if it is given."""
        return min(
            (b, s)
            for s in ((side,) if side else (1, -1))
            for b in self.phases(s, t, t + 2 * self.T)
            if -s * self.c.sin(self.omega * b) > 0
        )
