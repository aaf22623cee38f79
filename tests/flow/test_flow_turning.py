"""An orbit whose velocity touches zero between two hits is never certified as non-sticking."""

from dataclasses import replace
from fractions import Fraction

import mpmath
import pytest
import reference
from attempts import BITS, HAIR, TIMES, attempt, refused
from mpmath import mp, mpf
from support import number, rational

from cap.flow.event import BALLS, TAYLOR_MODELS
from cap.parameters import PAPER, Parameters
from cap.sets import interval

SHIFTED = Parameters(Fraction(2), Fraction(3), Fraction(4, 5), Fraction(-7, 3), Fraction(-1))
FREE = replace(PAPER, f=Fraction(0))

TOUCHING = {  # which flight: parameters, x, v with positive least speed, v with negative
    "the last, to the right": (PAPER, "1/5", "7/10", "3/4"),
    "the second, to the left": (PAPER, "4/5", "29/20", "7/5"),
    "the fourth, to the right": (PAPER, "-1/5", "-2", "-41/20"),
    "the third of four, no friction": (FREE, "-3/10", "4/5", "17/20"),
    "the last, other parameters": (SHIFTED, "-16/15", "43/20", "11/5"),
    "the first, to the left": (replace(PAPER, l=Fraction(-7, 3)), "-1/3", "-7/4", "-17/10"),
    "the second, f = 1/2": (replace(PAPER, f=Fraction(1, 2)), "4/5", "17/10", "33/20"),
}


@pytest.mark.slow
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
