"""What is expected of an orbit needs no trust: with any words and windows, only the truth is told.

The orbit is that of the simulator; its itinerary is spoilt at random before it is to be certified.
"""

from collections import Counter
from fractions import Fraction

import pytest
from mpmath import workdps
from random_orbits import KINDS, case
from support import only, rational, rounds, seeded
from test_fuzz_propagation import DIGITS, check_events, check_state, simulated

from cap.errors import NotProved
from cap.flow.event import BALLS, TAYLOR_MODELS, Expected
from cap.flow.propagation import Happened, Image
from cap.flow.strobe import State, follow, oscillator
from cap.flow.words import WORDS
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.taylor_model import Domain

WIDTHS = [Fraction(1, 10**n) for n in (9, 7, 5, 3, 1, 0)]  # in units of 1/ω


def itinerary(random, events):
    """Return (word, time) of the events; of hits and turnings before a capture only some."""
    short = []
    for event in events:
        if event.word.startswith("capture"):
            first = len(short)
            while first and short[first - 1][0].startswith(("hit", "turn")):
                first -= 1
            del short[random.randint(first, len(short)) :]
        short.append((event.word, rational(event.time)))
    return short


def spoilt(random, events, unit):
    """Return an itinerary with an event, or two, left out, added, renamed or put elsewhere."""
    events = list(events)
    for _ in range(random.choice([1, 2])):
        k = random.randint(0, len(events))
        word, time = random.choice(sorted(WORDS)), events[min(k, len(events) - 1)][1]
        time += unit * Fraction(random.randint(-100, 100), 50)
        kept = [(word, time)] if random.random() < 0.6 else []
        events[k : k + random.choice([0, 1, 1, 2])] = kept
        if not events:
            break
    return events


def windows(random, events, unit):
    """Return the itinerary with narrow windows that hold the times, or with any."""
    expected, careful = [], random.random() < 0.5
    for word, time in events:
        width = unit * random.choice(WIDTHS[:3] if careful else WIDTHS)
        shift = width * Fraction(random.randint(-60, 60) * (1 if careful else 2), 100)
        expected.append(Expected(word, interval.around(time + shift, width)))
    return expected


def attempt(random, case, state, events):
    """Return what is proved, over balls or Taylor models, of a box around the state."""
    osc, kind = oscillator(case.p), random.choice([BALLS, TAYLOR_MODELS])
    size = random.choice([Fraction(0), Fraction(1, 10**9), Fraction(1, 300)])
    units = case.p.R, case.p.R * case.p.omega
    reach = [size * unit * varies for unit, varies in zip(units, case.varies, strict=True)]
    x, v = (interval.around(q, r) for q, r in zip(state, reach, strict=True))
    if kind is TAYLOR_MODELS:
        domain = Domain([interval.ball(r) for r in reach], 2)
        x, v = domain.variables([interval.ball(q) for q in state])
    start, end = (osc.moment(interval.ball(t)) for t in (case.start, case.end))
    begin = State(start, x, v if case.v else Ball(0), case.wall)
    orbit = follow(osc, begin, windows(random, events, 1 / case.p.omega), end, kind)
    told = tuple(Happened(event.word, kind.bound(event.time)) for event in orbit.events)
    zero = (Ball(0), Ball(0)), (Ball(0), Ball(0))
    return Image(told, (kind.bound(orbit.end[0]), kind.bound(orbit.end[1])), zero, 0)


@pytest.mark.parametrize("kind", only(KINDS, "flying"))
def test_only_the_truth_is_told(kind):
    """Of itineraries as they are, and spoilt ones: events and state are those of the orbit."""
    random, count = seeded(kind), Counter()
    for _ in range(rounds(8)):
        one = case(random, kind, 1)
        with workdps(DIGITS):
            state = one.state(random)
            found = simulated(one, state)
        for _ in range(20 if found and found[0] else 0):
            events = itinerary(random, found[0])
            wrong = random.random() < 0.5
            given = spoilt(random, events, 1 / one.p.omega) if wrong else events
            try:
                with interval.workprec(one.bits):
                    told = attempt(random, one, state, given)
            except NotProved:
                count["refused", wrong] += 1
                continue
            count["proved", wrong] += 1
            check_events(told.events, found[0])
            check_state(one, told, found[1])
    print(kind, dict(count))
    assert count["proved", False]
    assert count["refused", True]
