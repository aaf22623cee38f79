"""Nothing false is certified: each hypothesis of `strobe` is broken, and the right step refuses."""

from dataclasses import replace
from fractions import Fraction

import mpmath
import pytest
import reference
from mpmath import mp, mpf
from support import number, rational

from cap import interval
from cap.errors import NotProved
from cap.flow import BALLS, TAYLOR_MODELS, NoCertainHit, oscillator, over, strobe
from cap.interval import Ball
from cap.parameters import PAPER, Parameters
from cap.taylor_model import Domain, TaylorModel

BITS = 200
HAIR = Fraction(1, 10**9)
KINDS = pytest.mark.parametrize("kind", [BALLS, TAYLOR_MODELS], ids=["balls", "Taylor models"])
P_STAR = Fraction("0.1002798898441954"), Fraction("0.5419433067664584")
TIMES = Fraction("1.0991729107"), Fraction("3.5160904414")
SHIFTED = Parameters(Fraction(2), Fraction(3), Fraction(4, 5), Fraction(-7, 3), Fraction(-1))
FREE = replace(PAPER, f=Fraction(0))


def attempt(p, state, times, kind, *, radius=0, width=HAIR):
    """Certify the box of half-width ``radius`` in windows of half-width ``width``."""
    osc = oscillator(p)
    windows = tuple(t if isinstance(t, Ball) else interval.around(t, width) for t in times)
    if kind is BALLS:
        return strobe(
            osc, tuple(interval.around(c, Fraction(radius)) for c in state), windows, kind
        )
    domain = Domain((interval.ball(Fraction(radius)),) * 2, 2)
    state = domain.variables([interval.ball(c) for c in state])
    return strobe(over(osc, TaylorModel), state, windows, kind)


def refused(step, reason, *arguments, **options):
    with interval.workprec(BITS), pytest.raises(NotProved) as caught:
        attempt(*arguments, **options)
    assert (caught.value.step, reason in caught.value.reason) == (step, True), str(caught.value)
    assert caught.value.sets
    return caught.value


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
            failure = refused(f"hit {k + 1}", "no hit is certain", PAPER, P_STAR, times, kind)
            assert isinstance(failure, NoCertainHit)
            assert failure.number == k + 1
    with mpmath.workdps(60), interval.workprec(BITS):
        system = reference.System.of(PAPER)
        exact = rational(reference.flow(system, *map(number, P_STAR)).hits[0])
        for side in (-1, 1):
            edge = interval.around(exact + side * HAIR, HAIR * (1 - Fraction(1, 10**6)))
            with pytest.raises(NoCertainHit):
                attempt(PAPER, P_STAR, (edge, TIMES[1]), kind)


@KINDS
def test_too_few_windows(kind):
    """With one window less the orbit reaches a wall, or turns on paper, before T."""
    refused("flight", "may vanish", PAPER, P_STAR, TIMES[:1], kind)
    refused("end", "reach a wall", PAPER, (Fraction(0), Fraction(3)), (), kind)
    state = Fraction(-11, 5), Fraction(-5, 2)
    with mpmath.workdps(60):
        system = reference.System.of(SHIFTED)
        hits = [rational(t) for t in reference.flow(system, *map(number, state)).hits]
    with interval.workprec(BITS):
        assert len(attempt(SHIFTED, state, hits, kind).hits) == 4
    refused("end", "reach a wall", SHIFTED, state, hits[:-1], kind)


@KINDS
def test_too_many_windows(kind):
    """A third hit: nowhere before T; the next one is after T."""
    for t in (Fraction(4), Fraction(5), Fraction(6), TIMES[1], TIMES[0]):
        refused("hit 3", "", PAPER, P_STAR, (*TIMES, t), kind)
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
                    assert caught.value.step == "hit 1"
                    if not gap:
                        assert "graze" in caught.value.reason


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
    window = interval.between(first - Fraction(1, 10), last + Fraction(1, 10))
    refused("hit 1", "graze", p, state, (window,), kind)
    second = interval.around(last, Fraction(1, 50))
    refused("hit 1", "graze", p, state, (second,), kind)


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
        balls = oscillator(PAPER)
        models = over(balls, TaylorModel)
        domain = Domain((interval.ball(HAIR / 100),) * 2, 2)
        x, v = map(interval.ball, P_STAR)
        windows = tuple(interval.around(t, HAIR) for t in TIMES)
        for state in ((bad, v), (x, bad), (bad, bad)):
            for osc, box, kind in (
                (balls, state, BALLS),
                (models, domain.variables(state), TAYLOR_MODELS),
            ):
                with pytest.raises(NotProved) as caught:
                    strobe(osc, box, windows, kind)
                assert caught.value.step in ("start", "hit 1")
        for n, windows_with_bad in enumerate(((bad, windows[1]), (windows[0], bad)), start=1):
            for osc, box, kind in (
                (balls, (x, v), BALLS),
                (models, domain.variables((x, v)), TAYLOR_MODELS),
            ):
                with pytest.raises(NotProved) as caught:
                    strobe(osc, box, windows_with_bad, kind)
                assert caught.value.step == f"hit {n}"
        wide = Domain((interval.ball(HAIR), bad), 2).variables((x, v))
        with pytest.raises(NotProved):
            strobe(models, wide, windows, TAYLOR_MODELS)


TOUCHING = {  # which flight: parameters, x, v with positive least speed, v with negative
    "the last, to the right": (PAPER, "1/5", "7/10", "3/4"),
    "the second, to the left": (PAPER, "4/5", "29/20", "7/5"),
    "the fourth, to the right": (PAPER, "-1/5", "-2", "-41/20"),
    "the third of four, no friction": (FREE, "-3/10", "4/5", "17/20"),
    "the last, other parameters": (SHIFTED, "-16/15", "43/20", "11/5"),
    "the first, to the left": (replace(PAPER, l=Fraction(-7, 3)), "-1/3", "-7/4", "-17/10"),
    "the second, f = 1/2": (replace(PAPER, f=Fraction(1, 2)), "4/5", "17/10", "33/20"),
}


@pytest.mark.parametrize("flight", TOUCHING)
def test_a_velocity_that_touches_zero_between_hits(flight):
    """Least speed 0, a little less, much less: refused.  A little more: certified."""
    p, x, moving, stopping = TOUCHING[flight]
    with mpmath.workdps(60), interval.workprec(BITS):
        system, x = reference.System.of(p), Fraction(x)
        moving, stopping = Fraction(moving), Fraction(stopping)

        def least(v):
            return reference.flow(system, number(x), v, formal=True).least

        bracket = number(moving), number(stopping)
        v = rational(mp.findroot(least, bracket, solver="anderson", tol=mpf(10) ** -80))
        assert abs(least(number(v))) < mpf(10) ** -30
        toward = 1 if moving > stopping else -1
        for kind in (BALLS, TAYLOR_MODELS):
            for shift, radius, succeeds in [
                (0, 0, False),
                (0, Fraction(1, 10**12), False),
                (0, HAIR, False),
                (Fraction(-1, 10**15), 0, False),
                (Fraction(-1, 10**6), 0, False),
                (Fraction(-1, 10**6), HAIR, False),
                (Fraction(1, 10**15), 0, True),
                (Fraction(1, 10**6), Fraction(1, 10**12), True),
                (Fraction(1, 10**12), HAIR, False),
            ]:
                state = x, v + toward * shift
                hits = reference.flow(system, *map(number, state), formal=True).hits
                times, options = [rational(t) for t in hits], {"radius": radius}
                options["width"] = max(1000 * Fraction(radius), Fraction(1, 10**15))
                if succeeds:
                    orbit = attempt(p, state, times, kind, **options)
                    assert 0 < orbit.least_speed < 1e-4
                else:
                    refused("flight", "may vanish", p, state, times, kind, **options)


def test_the_end_of_the_asymmetric_branch():
    """As f decreases the least speed of the elliptic orbit vanishes, at f about 0.348."""

    def orbit(f):
        system = reference.System(mpf(1), mpf(1), f, mpf(-1), mpf(1))
        x, v, _ = reference.periodic_orbit(system, tuple(number(t) for t in TIMES))
        return x, v, reference.flow(system, x, v, formal=True)

    with mpmath.workdps(60), interval.workprec(BITS):
        f = mp.findroot(lambda f: orbit(f)[2].least, (0.39, 0.37), solver="secant", tol=1e-60)
        assert 0.34 < f < 0.35
        for shift, succeeds in (("1e-8", True), ("0", False), ("-1e-8", False), ("-1e-3", False)):
            value = rational(f) + Fraction(shift)
            x, v, formal = orbit(number(value))
            p, state = replace(PAPER, f=value), (rational(x), rational(v))
            times = [rational(t) for t in formal.hits]
            for kind in (BALLS, TAYLOR_MODELS):
                options = {"radius": Fraction(1, 10**14), "width": Fraction(1, 10**11)}
                if succeeds:
                    assert attempt(p, state, times, kind, **options).least_speed > 0
                else:
                    refused("flight", "may vanish", p, state, times, kind, **options)
