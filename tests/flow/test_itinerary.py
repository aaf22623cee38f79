"""The orbit in floats: its events against small steps, its derivative, its balances."""

import math
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import pytest
from flows import MIXED, OILY, SOFT
from support import rounds, seeded

from cap.errors import BadInput
from cap.flow.itinerary import MOST_EVENTS, itinerary, oscillator, root
from cap.parameters import PAPER, Parameters

NAMES = pytest.mark.parametrize("name", MIXED)
WORDS = {
    "turns": "turn left, turn right",
    "stick": "turn right, stick, release left, hit l",
    "stick after a hit": "hit r, hit l, stick, release right, hit r",
    "heavy": "turn right, stick, release left, stick, release right, stick, release left",
    "soft": "hit r, hit l, turn left, hit l, stick, release right",
    "capture r": "hit r, turn right, hit r, capture r, release left, turn right",
    "capture l": "hit l, turn left, hit l, capture l, release right, turn left",
    "capture after a stick": "stick, release right, hit r, capture r, release left, turn right",
    "all but hits of l": "turn left, stick, release right, hit r, capture r, release left, "
    "turn right",
    "viscous": "turn right, stick, release left, hit l, turn left, stick, release right",
    "narrow": "hit r, turn right, stick, release left, hit l, turn left",
    "brisk": "hit l, hit r, hit l, hit r, hit l, hit r",
    "long after": "hit r, hit l, stick, release right",
    "long before": "hit l, capture l, release right",
}


def given(name):
    """Return (parameters, x, v, start, end) in floats."""
    p, *numbers = MIXED[name]
    return p, *(float(Fraction(q)) for q in numbers)


def small_steps(p, x, v, start, end, steps=60_000):
    """Return (x, v) by small steps: friction takes at most the velocity, a wall puts back."""
    F, omega, f, l, r, e, mu = (float(q) for q in (p.F, p.omega, p.f, p.l, p.r, p.e, p.mu))
    h = (end - start) / steps
    for k in range(steps):
        v += h * (F * math.cos(omega * (start + (k + 0.5) * h)) - mu * v)
        v = math.copysign(max(abs(v) - h * f, 0.0), v)
        x += h * v
        if (x > r and v > 0) or (x < l and v < 0):
            x, v = (r if x > r else l), -e * v
    return x, v


@NAMES
def test_words_and_end_against_small_steps(name):
    """The itinerary as known; the end as by tiny steps that know no events."""
    p, x, v, start, end = given(name)
    path = itinerary(p, x, v, end, start=start)
    assert ", ".join(path.words) == WORDS[name]
    assert path.end == pytest.approx(small_steps(p, x, v, start, end), abs=2e-3)
    times = [start, *(event.time for event in path.events), end]
    assert times == sorted(times)


@NAMES
def test_words_on_the_way(name):
    """Up to any time the events are those of the whole orbit that come before."""
    p, x, v, start, end = given(name)
    whole = itinerary(p, x, v, end, start=start).events
    for k, event in enumerate(whole):
        stop = event.time + 1e-4
        cut = itinerary(p, x, v, stop, start=start)
        assert [e.word for e in cut.events] == [e.word for e in whole[: k + 1]]
        assert cut.events[-1].time == pytest.approx(event.time, abs=1e-11)
        resting = event.word.startswith(("stick", "capture"))
        assert (cut.end[1] == 0) == resting
        assert cut.wall == {"capture r": 1, "capture l": -1}.get(event.word, 0)


@NAMES
@pytest.mark.parametrize("later", [1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7])
def test_ends_just_after_an_event(name, later):
    """A turning or a release is not followed by turnings that only rounding sees."""
    p, x, v, start, end = given(name)
    events = itinerary(p, x, v, end, start=start).events
    for k, event in enumerate(events):
        cut = itinerary(p, x, v, event.time + later, start=start)
        assert [e.word for e in cut.events] == [e.word for e in events[: k + 1]]
        if event.word.startswith(("turn", "release")):
            assert cut.end[1] * (1 if event.word.endswith("right") else -1) >= 0


@NAMES
def test_monodromy_against_divided_differences(name):
    """To five digits, through every kind of event."""
    p, x, v, start, end = given(name)
    path, h = itinerary(p, x, v, end, start=start), 1e-7
    for j, (dx, dv) in enumerate(((h, 0.0), (0.0, h))):
        ahead = itinerary(p, x + dx, v + dv, end, start=start)
        behind = itinerary(p, x - dx, v - dv, end, start=start)
        assert ahead.words == behind.words == path.words
        for i in (0, 1):
            quotient = (ahead.end[i] - behind.end[i]) / (2 * h)
            assert path.monodromy[i][j] == pytest.approx(quotient, rel=1e-5, abs=1e-5)


def flights(p, path, start, state):
    """Give (sign, time, x, v at the start; time, x, v at the end) of each flight between events."""
    t, (x, v) = start, state
    for event in path.events:
        verb, _, side = event.word.partition(" ")
        if verb not in ("release", "capture"):
            yield t, x, v, event.time, event.x, event.velocity
        t, x, v = event.time, event.x, -float(p.e) * event.velocity if verb == "hit" else 0.0
        del side


@NAMES
def test_impulse_and_energy(name):
    """On each flight m Δv = ∫F cos ωt - s f d - μ Δx, and Δv²/2 is the work of all three."""
    p, x, v, start, end = given(name)
    path = itinerary(p, x, v, end, start=start)
    F, w, f, mu, o = float(p.F), float(p.omega), float(p.f), float(p.mu), oscillator(p)
    for t, x0, v0, end_time, x1, v1 in flights(p, path, start, (x, v)):
        if any(e.word.startswith("capture") and e.time == t for e in path.events):
            continue  # the rest at a wall
        s, d = math.copysign(1, x1 - x0), end_time - t
        pull = F / w * (math.sin(w * end_time) - math.sin(w * t))
        assert v1 - v0 == pytest.approx(pull - s * f * d - mu * (x1 - x0), abs=1e-9)
        flight, steps = o.launch(int(s), o.moment(t), x0, v0), 400
        work = lost = 0.0
        for k in range(steps + 1):
            at = o.moment(t + d * k / steps)
            speed = o.velocity(flight, at)
            weight = d / steps / 3 * (1 if k in (0, steps) else 4 if k % 2 else 2)
            work, lost = work + weight * o.forcing(at) * speed, lost + weight * mu * speed**2
            assert s * speed > -1e-9
        gained = (v1**2 - v0**2) / 2
        assert gained == pytest.approx(work - f * abs(x1 - x0) - lost, abs=1e-7)


@pytest.mark.parametrize("p", [PAPER, SOFT, OILY])
def test_what_a_wall_takes(p):
    """A hit leaves e times the speed; nothing else does anything at a wall."""
    random = seeded(1)
    for _ in range(rounds(20)):
        x, v = random.uniform(-0.9, 0.9), random.uniform(-3, 3)
        path = itinerary(p, x, v, 3.0)
        for event in path.events:
            if event.word.startswith("hit"):
                after = itinerary(p, x, v, event.time + 1e-9)
                if not after.wall:
                    assert after.end[1] == pytest.approx(-float(p.e) * event.velocity, abs=1e-8)
            else:
                assert event.velocity == 0


def test_random_orbits_of_random_oscillators_against_small_steps():
    """Ends agree as far as the orbit is not too sensitive; f = 0, near F, e < 1, μ > 0."""
    random, compared = seeded(2), 0
    for _ in range(rounds(25)):
        F, w = Fraction(random.randint(5, 30), 10), Fraction(random.randint(5, 30), 10)
        f = F * Fraction(random.choice([1, 20, 60, 95]), 100)
        e, mu = random.choice([("1", "0"), ("9/10", "0"), ("1/2", "2"), ("1", "1/10")])
        R = F / w**2 * random.randint(1, 6)
        p = Parameters(F, w, f, Fraction(-1), R - 1, Fraction(e), Fraction(mu))
        T = 2 * math.pi / float(w)
        x, v = random.uniform(-1, float(R) - 1), random.uniform(-1.5, 1.5) * float(F / w)
        start = random.uniform(-2, 2) * T
        path = itinerary(p, x, v, start + T, start=start)
        size = max(1, *(abs(c) for row in path.monodromy for c in row))
        if size < 5 and len(path.events) < 12:
            steps = small_steps(p, x, v, start, start + T)
            units = float(R), float(F / w)
            for a, b, unit in zip(path.end, steps, units, strict=True):
                assert a == pytest.approx(b, abs=3e-3 * size * unit)
            compared += 1
    assert compared >= rounds(10)


@pytest.mark.parametrize(
    ("x", "v", "wall"),
    [
        *((1.0, -0.5, 0), (-2.0, 0.5, 0), (math.nan, 0.5, 0), (0.0, math.inf, 0)),
        *((1.0, 0.5, 1), (-1.0, -0.5, -1), (0.0, 1e6, 0)),
    ],
)
def test_states_that_are_none(x, v, wall):
    """Beyond or unsaid at a wall, into a wall, not finite, too fast: refused in one line."""
    with pytest.raises(BadInput) as caught:
        itinerary(PAPER, x, v, 7.0, wall=wall)
    assert "\n" not in str(caught.value)
    assert MOST_EVENTS > 100


@pytest.mark.parametrize("f", [Fraction(0), Fraction(1, 10**17)])
def test_elastic_walls_without_friction(f):
    """No hits accumulate: the ratio of speeds is one."""
    path = itinerary(replace(PAPER, f=f), 0.5, 1.0, 3.0)
    assert path.words[0] == "hit r"
    assert not any(word.startswith("capture") for word in path.words)


@pytest.mark.parametrize("early", [1e-12, 1e-13, 0.0])
def test_a_rest_just_before_its_release(early):
    """It is released, at once or a moment later, not after half a period."""
    release = 2 * math.pi - math.acos(0.4)
    path = itinerary(PAPER, 0.0, 0.0, release + 3, start=release - early)
    assert path.end[0] > 0.5


@pytest.mark.parametrize(("x", "wall"), [(0.0, 0), (1.0, 1)])
def test_monodromy_of_a_start_at_rest(x, wall):
    """A small velocity would stick: rank one inside, zero at a wall that holds the mass."""
    start = 1.4 if not wall else 0.0
    (_, b), (_, d) = itinerary(PAPER, x, 0.0, 1.5, start=start, wall=wall).monodromy
    assert b == d == 0


def test_flights_do_not_end_where_they_begin():
    """Neither a turn nor a release is met twice, and the wall that was left is not hit."""
    for name in MIXED:
        p, x, v, start, end = given(name)
        events = itinerary(p, x, v, end, start=start).events
        for a, b in pairwise(events):
            assert b.time > a.time + 1e-9


def test_root_where_it_begins_at_zero():
    """A function that is 0 at the left end and rises has its zero there."""
    assert root(lambda t: (t, 1.0), 0.0, 1.0) == pytest.approx(0, abs=1e-15)
