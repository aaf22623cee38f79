"""The flow with all its events in mpmath, at the working precision: what the flows are tested with.

Written apart from `cap`: the first zero of the velocity is isolated by bounds of its derivatives
(an interval without a zero, or on which it is monotone), not by known times.  Parameters and states
may be numbers of any kind; they are taken exactly.
"""

from fractions import Fraction
from typing import NamedTuple

from mpmath import mp, mpf


class Event(NamedTuple):
    """An event (words as in certificates/FORMAT.md) and the velocities before and after it."""

    time: mpf
    word: str
    x: mpf
    before: mpf
    after: mpf


class State(NamedTuple):
    """Time, position, velocity, and the sign of the motion (0: at rest)."""

    t: mpf
    x: mpf
    v: mpf
    s: int


def number(value):
    """Return a number at the working precision; a fraction is rounded, a float is exact."""
    if isinstance(value, mpf):
        return value
    value = Fraction(value)
    return mpf(value.numerator) / value.denominator


class System:
    """The oscillator x'' = F cos ωt - f sgn x' - μ x' between the walls l and r, restitution e."""

    def __init__(self, parameters):
        names = ("F", "omega", "f", "l", "r", "e", "mu")
        self.F, self.omega, self.f, self.l, self.r, self.e, self.mu = (
            number(getattr(parameters, name)) for name in names
        )
        self.T = 2 * mp.pi / self.omega
        self.arc, self.P = mp.acos(self.f / self.F), self.F / (self.mu**2 + self.omega**2)
        self.last = None, None

    def wall(self, side):
        """Return the right wall for 1, the left one for -1."""
        return self.r if side > 0 else self.l

    def force(self, t):
        """Return F cos ωt."""
        return self.F * mp.cos(self.omega * t)

    def since_release(self, side, t):
        """Return how long before t the last release to this side could have been, in [0, T)."""
        phase = self.omega * t + self.arc - (0 if side > 0 else mp.pi)
        turns = phase / (2 * mp.pi)
        near = mp.nint(turns)
        if abs(turns - near) < mpf(10) ** (10 - mp.dps):  # a release time up to rounding
            return mpf(0)
        return (turns - mp.floor(turns)) * self.T

    def pushes(self, side, t):
        """Return whether the forcing beats friction towards this side, at t and just after."""
        return self.since_release(side, t) < 2 * self.arc / self.omega

    def flight(self, start, t):
        """Return x and its first four derivatives at t on the flight from a state."""
        F, w, m, P, drag = self.F, self.omega, self.mu, self.P, start.s * self.f
        d, (cos, sin) = t - start.t, mp.cos_sin(w * t)
        cos0, sin0 = self._phase(start.t)
        h, k = self._relaxed(d)
        v0 = start.v - P * (m * cos0 + w * sin0)
        v = P * (m * cos + w * sin) + v0 * (1 - m * h) - drag * h
        x = start.x + P * (m / w * (sin - sin0) - (cos - cos0)) + v0 * h - drag * k
        a = F * cos - drag - m * v
        j = -F * w * sin - m * a
        return x, v, a, j, -F * w**2 * cos - m * j

    def _phase(self, t):
        """Return cosine and sine of ωt, where a flight starts; it is asked for again and again."""
        if self.last[0] != t:
            self.last = t, mp.cos_sin(self.omega * t)
        return self.last[1]

    def _relaxed(self, d):
        """Return (1 - exp(-μd))/μ and (d - that)/μ, without much cancellation."""
        m = self.mu
        if m == 0:
            return d, d**2 / 2
        if m * d < 1:
            return d * mp.hyp1f1(1, 2, -m * d), d**2 / 2 * mp.hyp1f1(1, 3, -m * d)
        h = (1 - mp.exp(-m * d)) / m
        return h, (d - h) / m

    def bounds(self, start, t):
        """Return bounds of |v|, and its first three derivatives, on the flight until t."""
        v = abs(start.v) + (self.F + self.f) * (t - start.t)
        a = self.F + self.f + self.mu * v
        j = self.F * self.omega + self.mu * a
        return v, a, j, self.F * self.omega**2 + self.mu * j


def bisected(g, a, b):
    """Return the zero of a monotone g, which gives value and slope, in [a, b]: guarded Newton."""
    rising = g(b)[0] > g(a)[0]
    t = (a + b) / 2
    for _ in range(4 * mp.prec):
        value, slope = g(t)
        a, b = (a, t) if (value > 0) == rising else (t, b)
        new = t - value / slope if slope else b + 1
        if not a <= new <= b:
            new = (a + b) / 2
        if abs(new - t) <= mpf(2) ** (8 - mp.prec) * (abs(t) + mpf(2) ** -mp.prec):
            return new
        t = new
    return t


def first_zero(g, bounds, a, b, order):
    """Return the first zero of g in (a, b], or None.  ``order`` is its order as a zero at a.

    ``g(t)`` gives g and its derivatives; ``bounds[k]`` bounds the derivative of order k + 1.
    """
    parts = [(a, b)]
    while parts:
        low, high = parts.pop()
        middle, half = (low + high) / 2, (high - low) / 2
        if half < abs(b) * mpf(2) ** (20 - mp.prec) + mpf(10) ** (-2 * mp.dps):
            raise ArithmeticError(f"a double zero near t = {mp.nstr(low, 15)}")
        values, k = g(middle), order if low == a else 0
        if abs(values[k]) > bounds[k] * half:
            continue
        if k == 0 and abs(values[1]) > bounds[1] * half:
            ends = mp.sign(g(low)[0]), mp.sign(g(high)[0])
            if ends[0] != ends[1]:
                return bisected(lambda t: g(t)[:2], low, high)
            continue
        parts += [(middle, high), (low, middle)]
    return None


def orbit(parameters, t0, x, v, t1, most=mp.inf):
    """Return the events in [t0, t1) of the orbit of (x, v) at t0, and its state (x, v) at t1.

    Raises `ArithmeticError` after ``most`` events, and if two zeros of v are hardly two.
    """
    system, t1 = System(parameters), number(t1)
    v = number(v)
    state, events = State(number(t0), number(x), v, int(mp.sign(v))), []
    while state.t < t1:
        step = _rest if state.s == 0 else _fly
        state = step(system, state, t1, events)
        if len(events) > most:
            raise ArithmeticError(f"more than {most} events")
    return events, (state.x, state.v)


def _rest(system, state, t1, events):
    sides = [s for s in (1, -1) if state.x != system.wall(s)]
    t, side = min((_begin(system, s, state.t), -s) for s in sides)
    if t >= t1:
        return state._replace(t=t1)
    word = "release right" if side < 0 else "release left"
    if t > state.t:  # else it was at rest only for the moment of the start
        events.append(Event(t, word, state.x, mpf(0), mpf(0)))
    return state._replace(t=t, s=-side)


def _begin(system, side, t):
    """Return when a mass at rest at t begins to move to this side, if not held by a wall."""
    if system.pushes(side, t):
        return t
    return t + system.T - system.since_release(side, t)


def _fly(system, state, t1, events):
    """Return the state after the next event, or at t1."""
    wall = system.wall(state.s)
    order = 0 if state.v != 0 else 2 if system.since_release(state.s, state.t) == 0 else 1
    velocity = lambda t: system.flight(state, t)[1:]  # noqa: E731
    bounds = system.bounds(state, t1)[1:]
    if state.x == wall:
        return _hit(system, state, events)
    zero = first_zero(velocity, (*bounds, None), state.t, t1, order)
    stop = t1 if zero is None else zero
    x, v, *_ = system.flight(state, stop)
    if state.s * (x - wall) >= 0:
        t = bisected(lambda t: (system.flight(state, t)[0] - wall, velocity(t)[0]), state.t, stop)
        return _hit(system, State(t, wall, velocity(t)[0], state.s), events)
    if zero is None:
        return State(t1, x, v, state.s)
    turns = system.pushes(-state.s, zero)
    word = ("turn right" if state.s < 0 else "turn left") if turns else "stick"
    events.append(Event(zero, word, x, mpf(0), mpf(0)))
    return State(zero, x, mpf(0), -state.s if turns else 0)


def _hit(system, state, events):
    v, s, word = -system.e * state.v, state.s, "r" if state.s > 0 else "l"
    events.append(Event(state.t, f"hit {word}", state.x, state.v, v))
    b, f = s * system.force(state.t), system.f
    if b > f:
        ratio = system.e * mp.sqrt((b - f) / (b + f))
        left = abs(v) * (1 / (b + f) + 1 / mp.sqrt(b * b - f * f)) / (1 - ratio) if ratio < 1 else 1
        # the sum has a relative error of this order, the height of a bounce is of its square
        small = mpf(10) ** (-min(mp.dps, 30) / mpf(3))
        if left * system.omega * max(1, system.F / (b - f)) < small:
            events.append(Event(state.t + left, f"capture {word}", state.x, v, mpf(0)))
            return State(state.t + left, state.x, mpf(0), 0)
    return State(state.t, state.x, v, -s)
