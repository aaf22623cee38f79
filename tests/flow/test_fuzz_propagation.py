"""The certified flow of random boxes against an independent simulator, event by event.

`oracle_flow` has no code of `cap`: zeros of the velocity are found by bounds of its derivatives,
in mpmath.  CAP_TEST_MULTIPLIER scales how many boxes are tried; ``pytest -rP`` shows what of them.
"""

from collections import Counter
from fractions import Fraction

import pytest
from mpmath import mp, workdps
from oracle_flow import State as Exact
from oracle_flow import System, orbit
from random_orbits import KINDS, case, parameters
from support import holds, only, rational, rounds, seeded

from cap.errors import NotProved
from cap.flow.propagation import after_periods, propagate
from cap.flow.strobe import State, oscillator
from cap.sets import interval

DIGITS = 60  # of the simulator
MOST = 300  # of its events, for the sake of time
STEP = Fraction(1, 10**25)  # of divided differences
ERROR = Fraction(1, 10**17)  # of the simulator, relative: it sums the hits before a capture


def proved(case):
    """Return what is proved of a case."""
    sides = zip((case.x, case.v), case.radius, case.varies, strict=True)
    x, v = (interval.around(q, r) if free else interval.ball(q) for q, r, free in sides)
    if case.periods:
        return after_periods(case.p, x, v, case.periods)
    at = oscillator(case.p).moment(interval.ball(case.start))
    return propagate(case.p, State(at, x, v, case.wall), interval.ball(case.end))


def simulated(case, state):
    """Return the events and the last state of an orbit; None if the simulator cannot tell."""
    try:
        return orbit(case.p, case.start, *state, case.end, MOST)
    except ArithmeticError:
        return None


def words(events):
    """Return an itinerary without the hits and turnings just before a capture."""
    short = []
    for event in events:
        while event.word.startswith("capture") and short and short[-1].startswith(("hit", "turn")):
            short.pop()
        short.append(event.word)
    return short


def check_events(told, events):
    """Check that an orbit has the events that are told, at such times, and no others."""
    left = iter(events)
    for each in told:
        event = next(left, None)
        while event and each.word.startswith("capture") and event.word.startswith(("hit", "turn")):
            event = next(left, None)
        assert event
        assert event.word == each.word
        assert holds(each.time, event.time, ERROR * (1 + abs(rational(event.time))))
    assert next(left, None) is None


def check_state(case, image, last):
    """Check place and velocity at the end, exactly if all rest at a wall."""
    speed = case.p.R * case.p.omega + case.p.F / case.p.omega
    for side, value, unit in zip(image.state, last, (case.p.R, speed), strict=True):
        assert holds(side, value, ERROR * unit)
    if image.wall:
        assert holds(image.state[0], case.p.r if image.wall > 0 else case.p.l, 0)
        assert image.state[1].is_zero()


def check_derivative(case, image, state, events, last):
    """Check divided differences, where a neighbour has the same events; return of how many.

    After a capture all orbits are one: the derivative is exactly 0.
    """
    compared, units = 0, (case.p.R, case.p.R * case.p.omega)
    for k, (varies, unit) in enumerate(zip(case.varies, units, strict=True)):
        column = [row[k] for row in image.monodromy]
        if not varies or any(event.word.startswith("capture") for event in events):
            assert all(entry.is_zero() for entry in column)
            continue
        step = STEP * unit
        ahead = simulated(case, tuple(q + step * (i == k) for i, q in enumerate(state)))
        if ahead is None or words(ahead[0]) != words(events):
            continue
        compared += 1
        for entry, one, other, size in zip(column, ahead[1], last, units, strict=True):
            slope = rational(one - other) / step
            assert holds(entry, slope, Fraction(1, 10**9) * (size / unit + abs(slope)))
    return compared


def checked(case, random):
    """Check one case; return what became of it, by word."""
    try:
        with interval.workprec(case.bits):
            image = proved(case)
    except NotProved:
        return {"not proved": 1}
    with workdps(DIGITS):
        state = case.state(random)
        found = simulated(case, state)
        if found is None:
            return {"not simulated": 1}
        check_events(image.events, found[0])
        check_state(case, image, found[1])
        compared = check_derivative(case, image, state, *found)
    events = Counter(event.word.split()[0] for event in image.events)
    return {"proved": 1, "columns of derivatives": compared, **events}


@pytest.mark.parametrize("kind", only(KINDS, "at rest", "at rest at a wall"))
def test_random_boxes(kind):
    """Events and their times, the state, the wall at which it rests, the derivative."""
    random, count = seeded(kind), Counter()
    for _ in range(rounds(4)):
        one = case(random, kind, 20 if random.random() < 0.1 else 2)
        try:
            count.update(checked(one, random))
        except AssertionError as failure:
            raise AssertionError(f"{one}\n{failure}") from failure
    print(kind, dict(count))
    assert count["proved"] > count["not proved"]


def test_the_flights_of_the_simulator():
    """They solve the equation of motion, by divided differences of its own formula."""
    random = seeded(3)
    for _ in range(rounds(10)):
        with workdps(40):
            p, s = parameters(random), random.choice([1, -1])
            start = Exact(mp.mpf(random.randint(-50, 50)) / 7, mp.mpf(1) / 3, s * mp.mpf(2), s)
            check_flight(System(p), start)


def check_flight(system, start):
    """Check that x' = v and v' = F cos ωt - s f - μ v, from the state given on."""

    def component(k):
        return lambda t: system.flight(start, t)[k]

    assert component(0)(start.t) == start.x
    assert mp.almosteq(component(1)(start.t), start.v, 1e-35)
    for t in (start.t, start.t + mp.mpf(1) / 9, start.t + 5):
        _, v, a, *_ = system.flight(start, t)
        assert mp.almosteq(mp.diff(component(0), t), v, 1e-12)
        assert mp.almosteq(mp.diff(component(1), t), a, 1e-12)
        force = system.F * mp.cos(system.omega * t) - start.s * system.f - system.mu * v
        assert mp.almosteq(a, force, 1e-30)
