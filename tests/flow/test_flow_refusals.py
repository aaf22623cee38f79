"""Nothing false is certified: each hypothesis of `strobe` is broken, and the right step refuses."""

from dataclasses import replace
from fractions import Fraction

import mpmath
import pytest
import reference
from attempts import BITS, HAIR, P_STAR, TIMES, attempt, box, hits, refused
from mpmath import mp, mpf
from support import between, number, rational

from cap.errors import NotProved
from cap.flow.event import BALLS, TAYLOR_MODELS, NoCertainEvent, flies
from cap.flow.strobe import oscillator, strobe
from cap.parameters import PAPER, Parameters
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.taylor_model import Domain

KINDS = pytest.mark.parametrize("kind", [BALLS, TAYLOR_MODELS], ids=["balls", "Taylor models"])
SHIFTED = Parameters(Fraction(2), Fraction(3), Fraction(4, 5), Fraction(-7, 3), Fraction(-1))
FREE = replace(PAPER, f=Fraction(0))


@KINDS
def test_the_orbit_itself_is_certified(kind):
    """What the tests below break one by one does hold."""
    with interval.workprec(BITS):
        orbit = attempt(PAPER, P_STAR, TIMES, kind, radius=HAIR / 100)
        assert len(orbit.hits) == 2
        attempt(PAPER, P_STAR, TIMES, kind, radius=HAIR, width=Fraction(1, 1000))


@KINDS
def test_windows_without_a_hit(kind):
    """Before and after each hit, in both places; also where the hit is on the window's edge."""
    for shift in (Fraction(-1, 10), Fraction(1, 10), Fraction(-3, 10**9), Fraction(3, 10**9)):
        for k in (0, 1):
            times = [t + shift * (i == k) for i, t in enumerate(TIMES)]
            failure = refused(f"event {k + 1}", "is certain", PAPER, P_STAR, times, kind)
            assert isinstance(failure, NoCertainEvent)
            assert failure.number == k + 1
    with mpmath.workdps(60), interval.workprec(BITS):
        system = reference.System.of(PAPER)
        exact = rational(reference.flow(system, *map(number, P_STAR)).hits[0])
        for side in (-1, 1):
            edge = interval.around(exact + side * HAIR, HAIR * (1 - Fraction(1, 10**6)))
            with pytest.raises(NoCertainEvent):
                attempt(PAPER, P_STAR, (edge, TIMES[1]), kind)


@KINDS
def test_too_few_windows(kind):
    """With one window less the orbit reaches a wall, or turns on paper, before T."""
    refused("end", "may vanish before", PAPER, P_STAR, TIMES[:1], kind)
    for v in (3, -3):
        refused("end", "reach a wall", PAPER, (Fraction(0), Fraction(v)), (), kind)
    state = Fraction(-11, 5), Fraction(-5, 2)
    with mpmath.workdps(60):
        system = reference.System.of(SHIFTED)
        hits = [rational(t) for t in reference.flow(system, *map(number, state)).hits]
    with interval.workprec(BITS):
        assert len(attempt(SHIFTED, state, hits, kind).hits) == 4
    refused("end", "reach a wall", SHIFTED, state, hits[:-1], kind)


@KINDS
def test_a_wall_that_is_reached_at_the_end(kind):
    """x(T) on a wall, exactly or perhaps: neither with the hit nor without it."""
    with mpmath.workdps(60):
        system = reference.System.of(FREE)
        for v in (Fraction(2), Fraction(-2)):
            far = replace(FREE, l=Fraction(-50), r=Fraction(50))
            end = rational(reference.flow(reference.System.of(far), 0, number(v)).end[0])
            p = replace(far, **{"r" if v > 0 else "l": end})
            for radius in (Fraction(0), HAIR):
                refused("end", "reach a wall", p, (Fraction(0), v), (), kind, radius=radius)
            times = (rational(system.T),)
            with interval.workprec(BITS), pytest.raises(NotProved):
                attempt(p, (Fraction(0), v), times, kind)


@KINDS
def test_too_many_windows(kind):
    """A third hit: nowhere before T; the next one is after T."""
    for t in (Fraction(4), Fraction(5), Fraction(6), TIMES[1], TIMES[0]):
        refused("event 3", "", PAPER, P_STAR, (*TIMES, t), kind)
    with mpmath.workdps(60):
        after = rational(mpf(TIMES[0].numerator) / TIMES[0].denominator + 2 * mp.pi)
    wide = Fraction(1, 10**6)
    refused("flight", "out of order", PAPER, P_STAR, (*TIMES, after), kind, width=wide)


@KINDS
def test_windows_before_the_start(kind):
    """The formal flight crossed the wall ahead in the past, rightwards: that is no hit."""
    p = replace(PAPER, l=Fraction(-5), r=Fraction(1, 10))
    with mpmath.workdps(60):
        flight = reference.Flight(reference.System.of(p), 1, mpf(0), mpf(0), mpf(1) / 10)
        past = rational(mp.findroot(lambda t: flight.position(t) - mpf(1) / 10, -2.6))
        assert past < -2
        assert flight.velocity(number(past)) > 0.01
    refused("flight", "out of order", p, (Fraction(0), Fraction(1, 10)), (past,), kind)


def test_a_middle_outside_the_window():
    """The mean value form needs it inside; from outside, Newton's image may miss the hit."""
    with interval.workprec(BITS):
        for shift in (Fraction(-1, 20), Fraction(1, 20)):
            outside = interval.ball(TIMES[0] + shift)
            kind = BALLS._replace(curve=lambda *_, t=outside: t)
            expected = hits(1, TIMES, Fraction(1, 40))
            with pytest.raises(NoCertainEvent) as caught:
                strobe(oscillator(PAPER), box(P_STAR, BALLS), expected, kind)
            assert caught.value.number == 1


def test_flights_whose_ends_are_in_no_certain_order():
    """Equal, overlapping, touching or reversed times of two events are refused."""
    with interval.workprec(BITS):
        osc = oscillator(PAPER)
        flight = osc.launch(1, osc.moment(Ball(0)), Ball(0), Ball(9))
        one = Ball((1, 0), (1, -2))
        for start, end in [
            (one, one),
            (one, Ball((5, -2), (1, -2))),
            (one, Ball((3, -1), (1, -2))),
            (one, Ball(0)),
            (Ball(1), Ball(1)),
            (Ball("nan"), one),
            (one, Ball("nan")),
        ]:
            with pytest.raises(NotProved, match="out of order"):
                flies(osc, flight, (start, end), BALLS.bound)


@KINDS
def test_a_velocity_that_is_exactly_zero_for_a_moment(kind):
    """Without friction v = 1 + sin t: the ball of the least speed is the point 0."""
    p = replace(FREE, l=Fraction(-20), r=Fraction(20))
    refused("flight", "may vanish", p, (Fraction(0), Fraction(1)), (), kind)
    p = replace(p, F=Fraction(2), l=Fraction(-50), r=Fraction(50))
    refused("flight", "may vanish", p, (Fraction(0), Fraction(2)), (), kind)


@KINDS
def test_swapped_and_repeated_windows(kind):
    """Windows in the wrong order, or one hit twice."""
    for times in (TIMES[::-1], (TIMES[0], TIMES[0]), (TIMES[1], TIMES[1])):
        with interval.workprec(BITS), pytest.raises(NotProved):
            attempt(PAPER, P_STAR, times, kind)


def grazing_parameters(t):
    """Return parameters, state: v = 0 at time ``t`` on the right wall; v > 0 before."""
    f = mpf(2) / 5
    v = f * t - mp.sin(t)
    x = v * t + 1 - mp.cos(t) - f * t * t / 2
    return replace(PAPER, l=Fraction(-9), r=rational(x)), (Fraction(0), rational(v))


@KINDS
@pytest.mark.parametrize("time", ["2.6", "3", "3.3"])
def test_grazing_hits(kind, time):
    """A tangency, exact to 60 digits; walls a little nearer (two crossings) or farther (none)."""
    with mpmath.workdps(60), interval.workprec(BITS):
        p, state = grazing_parameters(mpf(time))
        assert state[1] > Fraction(3, 10)
        for gap in (Fraction(0), Fraction(1, 10**12), Fraction(-1, 10**12), Fraction(1, 10**6)):
            near = replace(p, r=p.r + gap)
            for width in (Fraction(1, 10**12), HAIR, Fraction(1, 100), Fraction(1, 2)):
                for radius in (Fraction(0), HAIR):
                    window = interval.around(Fraction(time), width)
                    with pytest.raises(NotProved) as caught:
                        attempt(near, state, (window,), kind, radius=radius)
                    assert caught.value.step == "event 1"
                    if not gap:
                        assert "may not be transverse in its time" in caught.value.reason


@KINDS
def test_two_crossings_in_one_window(kind):
    """v changes sign within the window: out through the wall and back again, on paper."""
    p = replace(PAPER, l=Fraction(-9))
    state = Fraction(0), Fraction(7, 10)
    with mpmath.workdps(30):
        flight = reference.Flight(reference.System.of(p), 1, mpf(0), mpf(0), mpf(7) / 10)
        over_the_wall = [t / 100 for t in range(500) if flight.position(mpf(t) / 100) > 1]
        assert flight.position(5) < 1
    first, last = (Fraction(round(100 * t), 100) for t in (over_the_wall[0], over_the_wall[-1]))
    window = between(first - Fraction(1, 10), last + Fraction(1, 10))
    refused("event 1", "may not be transverse", p, state, (window,), kind)
    second = interval.around(last, Fraction(1, 50))
    refused("event 1", "may not be transverse", p, state, (second,), kind)


@KINDS
def test_boxes_that_are_no_states(kind):
    """At or across a wall, beyond it, with v = 0 inside or on the edge, or indeterminate."""
    half, one = Fraction(1, 2), Fraction(1)
    for x in (one, -one, 1 - HAIR / 2, HAIR / 2 - 1, Fraction(2), Fraction(-2), 1 - HAIR):
        for v in (half, -half):
            refused("start", "between the walls", PAPER, (x, v), TIMES, kind, radius=HAIR)
    for v in (Fraction(0), HAIR, -HAIR, HAIR / 2):
        refused("start", "velocity", PAPER, (Fraction(0), v), TIMES, kind, radius=HAIR)


@pytest.mark.parametrize("bad", [Ball("nan"), Ball("inf"), Ball(0, "inf")], ids=str)
def test_indeterminate_input(bad):
    """NaN and infinite balls, as states or as windows, over both kinds."""
    with interval.workprec(BITS):
        osc = oscillator(PAPER)
        domain = Domain((interval.ball(HAIR / 100),) * 2, 2)
        x, v = map(interval.ball, P_STAR)
        expected = hits(1, TIMES)
        for state in ((bad, v), (x, bad), (bad, bad)):
            for start, kind in ((state, BALLS), (domain.variables(state), TAYLOR_MODELS)):
                with pytest.raises(NotProved) as caught:
                    strobe(osc, start, expected, kind)
                assert caught.value.step in ("start", "event 1")
        for n, times in enumerate(((bad, TIMES[1]), (TIMES[0], bad)), start=1):
            for start, kind in (((x, v), BALLS), (domain.variables((x, v)), TAYLOR_MODELS)):
                with pytest.raises(NotProved) as caught:
                    strobe(osc, start, hits(1, times), kind)
                assert caught.value.step == f"event {n}"
        wide = Domain((interval.ball(HAIR), bad), 2).variables((x, v))
        with pytest.raises(NotProved):
            strobe(osc, wide, expected, TAYLOR_MODELS)
