"""The certified flow of a box of states over any time, with widths that grow like its true image.

A set of states is kept as m + C r_0 + Q r (Lohner 1987; a doubleton): m is a point, r_0 the box of
initial deviations, C a point matrix, nearly the derivative at m, and Q r the errors, in a frame Q
that is turned along with the set so that they are not wrapped again and again.  One step from time
t_k to t_(k+1) with the flow φ proves, over a box Z around the set, the events and φ'(Z); then

    φ(z) in φ(m) + φ'(Z) (z - m),      φ'(Z) = A + Δ, A the midpoint,

by the mean value theorem, so the new set has C' = A C and the errors A Q r + Δ (z - m) + rounding.
The steps end in the middle of flights or rests, where no event is near.
"""

from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from typing import Any

from cap.errors import NotProved
from cap.flow.event import BALLS, TAYLOR_MODELS, Expected
from cap.flow.itinerary import Happening, itinerary
from cap.flow.model import Moment, Oscillator
from cap.flow.orbit import Orbit, State, placed
from cap.flow.strobe import follow, oscillator
from cap.flow.windows import Itinerary, windows_for
from cap.parameters import Parameters
from cap.sets import interval, matrix
from cap.sets.interval import Ball, Box
from cap.sets.matrix import Matrix
from cap.sets.taylor_model import Domain, TaylorModel

ORDER = 2  # of the Taylor models for one step
LONGEST = 100_000  # periods


@dataclass(frozen=True)
class Happened:
    """An event that all orbits have: its word and an enclosure of its time."""

    word: str
    time: Ball


@dataclass(frozen=True)
class Image:
    """What is proved of all orbits from a box until the end.

    The ``events`` in their order; the ``state`` (x, v) at the end; the ``monodromy``, its
    derivative at every initial state, along the box: by what does not vary in it, a velocity that
    is exactly 0 or a place that is a wall, it is 0 (`cap.flow.orbit.Orbit`).  ``wall`` is 1 or -1
    if all rest at r or l at the end, else 0.
    """

    events: tuple[Happened, ...]
    state: Box
    monodromy: Matrix[Ball]
    wall: int


def propagate(p: Parameters, start: State[Ball], end: Ball) -> Image:
    """Follow all orbits from a box of states to the time ``end``.

    Raises `NotProved` with the event that is undecided: not all orbits may have the same events, or
    the set has become too large to decide.
    """
    osc = oscillator(p)
    doubleton, events, until = _Doubleton(osc, start), list[Happened](), None
    if not end - doubleton.time < LONGEST * osc.T:
        sets = {"time": doubleton.time, "end": end}
        raise NotProved("propagation", f"the end may be more than {LONGEST} periods away", sets)
    while until is not end:
        if not doubleton.time < end:
            sets = {"time": doubleton.time, "end": end}
            raise NotProved("propagation", "the end may not be after all that comes before", sets)
        expected, until = _plan(p, osc, doubleton, end)
        events += doubleton.advance(osc, expected, until)
    state, (row, other) = doubleton.box(), doubleton.monodromy()
    if not all(q.is_finite() for q in (*state, *row, *other)):
        raise NotProved("propagation", "the set has become too large", {"state": state})
    return Image(tuple(events), state, (row, other), doubleton.wall)


def _plan(
    p: Parameters, osc: Oscillator[Any], doubleton: "_Doubleton", end: Ball
) -> tuple[Itinerary, Ball]:
    """Return the events of the next step, found in floats, and its end: hints for the proof.

    The step lasts about a period; it ends in the middle of the longest time without an event in its
    second half, or at the end.  Times in floats are counted from a whole number of periods.
    """
    begin = _periods(osc, doubleton.time) * osc.T
    now, last = float((doubleton.time - begin).mid()), float((end - begin).mid())
    horizon = min(last, now + float(osc.T.mid()))
    events = _foreseen(p, osc, doubleton, (now, horizon))
    until = end
    if horizon < last:
        knots = [(now + horizon) / 2, *(e.time for e in events), horizon]
        knots = sorted(t for t in knots if t >= (now + horizon) / 2)
        _, middle = max((b - a, (a + b) / 2) for a, b in pairwise(knots))
        until = interval.point(begin + middle)
        events = tuple(e for e in events if e.time < middle)
    return tuple(Expected(e.word, interval.point(begin + e.time)) for e in events), until


def _foreseen(
    p: Parameters, osc: Oscillator[Any], doubleton: "_Doubleton", times: tuple[float, float]
) -> tuple[Happening, ...]:
    """Return the events between two times, in floats; x is counted from the left wall."""
    x, v = doubleton.box()
    state, near = (float((x - osc.l).mid()), float(v.mid())), replace(p, l=Fraction(0), r=p.R)
    try:
        return itinerary(near, *state, times[1], start=times[0], wall=doubleton.wall).events
    except (ValueError, ArithmeticError) as error:
        reason = f"floats, which give hints, cannot follow the orbit: {error}"
        raise NotProved("propagation", reason, {"x": x, "v": v}) from None


def _periods(osc: Oscillator[Any], time: Ball) -> int:
    """Return about how many periods have passed at a time: a hint."""
    turns = time / osc.T
    if not turns.rad() < 1:
        raise NotProved("propagation", "the time is too uncertain", {"time": time})
    return round(interval.midpoint(turns))


class _Errors:
    """The set of vectors Q r: r a box, Q a matrix that is nearly a rotation."""

    def __init__(self) -> None:
        self.frame: Matrix[Ball] = (Ball(1), Ball(0)), (Ball(0), Ball(1))
        self.box: Box = (Ball(0), Ball(0))

    def values(self) -> Box:
        """Return a box that contains the set."""
        return matrix.apply(self.frame, self.box)

    def advance(self, A: Matrix[Ball], more: Box) -> None:
        """Replace the set by A Q r + ``more``, in the frame that its longest side then has."""
        moved = matrix.product(A, self.frame)
        sizes = [interval.upper(abs(side)) for side in self.box]
        columns = [(row[0], row[1]) for row in zip(*moved, strict=True)]
        longest = 0 if not _length(columns[0], sizes[0]) < _length(columns[1], sizes[1]) else 1
        frame = _rotation(columns[longest])
        inverse = matrix.inverse(frame)
        turned = matrix.apply(matrix.product(inverse, moved), self.box)
        added = matrix.apply(inverse, more)
        self.frame, self.box = frame, (turned[0] + added[0], turned[1] + added[1])


def _length(column: Box, size: Ball) -> float:
    return float(((abs(column[0]) + abs(column[1])) * size).mid())


def _rotation(column: Box) -> Matrix[Ball]:
    """Return nearly the rotation that takes (1, 0) to the direction of the column; exact floats."""
    c, s = (float(q.mid()) for q in column)
    length = (c * c + s * s) ** 0.5
    if not (s and length):  # an axis stays an axis exactly: so a rest keeps the velocity 0
        return (Ball(1), Ball(0)), (Ball(0), Ball(1))
    c, s = c / length, s / length
    return (Ball(c), Ball(-s)), (Ball(s), Ball(c))


class _Doubleton:
    """The set m + C r_0 + Q r of states at a time, with the derivative in the initial state."""

    def __init__(self, osc: Oscillator[Any], start: State[Ball]) -> None:
        self.time, self.wall, self.at = start.at.t, start.wall, start.at
        _, x, v, _ = placed(osc, start, BALLS.bound)
        self.centre: Box = (interval.point(x), interval.point(v))
        self.initial: Box = (x - self.centre[0], v - self.centre[1])
        self.linear: Matrix[Ball] = (Ball(1), Ball(0)), (Ball(0), Ball(1))
        self.errors = _Errors()
        self.columns = _Errors(), _Errors()

    def deviation(self) -> Box:
        """Return a box that contains C r_0 + Q r."""
        main, rest = matrix.apply(self.linear, self.initial), self.errors.values()
        return main[0] + rest[0], main[1] + rest[1]

    def box(self) -> Box:
        """Return a box that contains the set."""
        x, v = self.deviation()
        return self.centre[0] + x, self.centre[1] + v

    def monodromy(self) -> Matrix[Ball]:
        """Return an enclosure of the derivative in the initial state."""
        (a, b), (c, d) = self.linear
        (p, r), (q, s) = (errors.values() for errors in self.columns)
        return (a + p, b + q), (c + r, d + s)

    def advance(self, osc: Oscillator[Any], expected: Itinerary, until: Ball) -> list[Happened]:
        """Take one step; return the events in it."""
        end = osc.moment(until)
        deviation = self.deviation()
        x, v = Domain(deviation, ORDER).variables(self.centre)
        state = State(self.at, _constant(x, deviation[0]), _constant(v, deviation[1]), self.wall)

        def attempt(events: Itinerary) -> Orbit[TaylorModel]:
            return follow(osc, state, events, end, TAYLOR_MODELS)

        windows, orbit = windows_for(attempt, expected, TAYLOR_MODELS.bound)
        (a, b), (c, d) = (tuple(map(TAYLOR_MODELS.bound, row)) for row in orbit.monodromy)
        start = State(self.at, *self.centre, self.wall)
        with interval.guarded():
            image = follow(osc, start, windows, end, BALLS).end
        self._moved(image, ((a, b), (c, d)), deviation)
        self.time, self.at = until, end
        self.wall = _wall_at_rest(orbit, self.wall)
        return [Happened(e.word, TAYLOR_MODELS.bound(e.time)) for e in orbit.events]

    def _moved(self, image: Box, slope: Matrix[Ball], deviation: Box) -> None:
        """Replace the set by its image, from φ(m), φ'(Z) and a box around z - m."""
        A = _map(interval.point, slope)
        change = _map(lambda q: q - interval.point(q), slope)
        product = matrix.product(A, self.linear)
        linear = _map(interval.point, product)
        lost = matrix.apply(_map(lambda q: q - interval.point(q), product), self.initial)
        bent = matrix.apply(change, deviation)
        centre = interval.point(image[0]), interval.point(image[1])
        more = (
            image[0] - centre[0] + lost[0] + bent[0],
            image[1] - centre[1] + lost[1] + bent[1],
        )
        self.errors.advance(A, more)
        for k, errors in enumerate(self.columns):
            old, values = (self.linear[0][k], self.linear[1][k]), errors.values()
            bent = matrix.apply(change, (old[0] + values[0], old[1] + values[1]))
            rest = product[0][k] - linear[0][k], product[1][k] - linear[1][k]
            errors.advance(A, (bent[0] + rest[0], bent[1] + rest[1]))
        self.centre, self.linear = centre, linear


def _constant(model: TaylorModel, deviation: Ball) -> Any:
    """Return the ball of a coordinate that is the same for all states: an exact 0 stays one."""
    return model.polynomial.coefficients[0] if deviation.is_zero() else model


def _map(f: Any, m: Matrix[Ball]) -> Matrix[Ball]:
    (a, b), (c, d) = m
    return (f(a), f(b)), (f(c), f(d))


def _wall_at_rest(orbit: Orbit[TaylorModel], before: int) -> int:
    """Return 1 or -1 if the orbits rest at r or l at their end, else 0."""
    if not orbit.events:
        return before if orbit.s == 0 else 0
    verb, _, side = orbit.events[-1].word.partition(" ")
    return {"r": 1, "l": -1}[side] if verb == "capture" else 0


def at_time_zero(x: Ball, v: Ball) -> State[Ball]:
    """Return a box of states at t = 0."""
    return State(Moment(Ball(0), Ball(0), Ball(1)), x, v)


def after_periods(p: Parameters, x: Ball, v: Ball, periods: int) -> Image:
    """Return what is proved of all orbits from a box at t = 0 until ``periods`` T."""
    return propagate(p, at_time_zero(x, v), periods * oscillator(p).T)
