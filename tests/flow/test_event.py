"""The single events of a flight, and that nothing happens between them."""

from fractions import Fraction

import pytest
from flows import BITS, OILY, moment
from support import between, decimal_fraction, holds, rounds, seeded

from cap.errors import NotProved
from cap.flow.event import BALLS, Expected, NoCertainEvent, flies, hit_time, rest_time, slow_numbers
from cap.flow.model import Constants
from cap.flow.strobe import of_constants, oscillator
from cap.parameters import PAPER
from cap.sets import interval
from cap.sets.interval import Ball

BOTH = pytest.mark.parametrize("p", [PAPER, OILY], ids=["dry", "viscous"])


@BOTH
@pytest.mark.parametrize("s", [1, -1])
def test_a_rest_is_enclosed(p, s):
    """Flown back from a moment of rest, v vanishes there again: in windows of any width."""
    with interval.workprec(BITS):
        osc = oscillator(p)
        for rest in (Fraction(1, 2) if s < 0 else Fraction(7, 2), Fraction(-6), Fraction(30)):
            at = moment(osc, rest)
            if not s * osc.forcing(at) < osc.f:
                continue
            flight = osc.launch(s, at, interval.ball(Fraction(1, 3)), Ball(0))
            for left, right in ((1, 1), (10, 3), (3, 10), (10**6, 10**6)):
                window = between(rest - Fraction(1, 10 * left), rest + Fraction(1, 10 * right))
                found = rest_time(osc, flight, Expected("stick", window), BALLS, 1)
                assert holds(found.t, rest)
                assert found.t.rad() < 1e-9
            for shift in (Fraction(1, 20), -Fraction(1, 20)):
                away = Expected("stick", interval.around(rest + shift, Fraction(1, 100)))
                with pytest.raises(NotProved) as caught:
                    rest_time(osc, flight, away, BALLS, 3)
                assert caught.value.step == "event 3"
                assert not isinstance(caught.value, NoCertainEvent) or caught.value.number == 3


@BOTH
@pytest.mark.parametrize("s", [1, -1])
def test_a_hit_is_enclosed(p, s):
    """Flown back from the wall, it is met again, also after several periods."""
    with interval.workprec(BITS):
        osc = oscillator(p)
        for speed, back in (
            (Fraction(3), "1/2"),
            (Fraction(1, 100), "1/1000"),
            (Fraction(20), "20"),
        ):
            hit = moment(osc, Fraction(2))
            flight = osc.launch(s, hit, osc.wall(s), s * interval.ball(speed))
            start = moment(osc, 2 - Fraction(back))
            state = osc.position(flight, start), osc.velocity(flight, start)
            flight = osc.launch(s, start, *state)
            width = Fraction(back) / 10
            window = interval.around(2 + width / 3, width / 2)
            found = hit_time(osc, flight, Expected("hit", window), BALLS, 1)
            assert holds(found.t, 2)
            assert found.t.rad() < 1e-15


def test_slow_moments_are_all_numbered():
    """All moments of the interval are among those of the numbers, and hardly any others."""
    random = seeded(1)
    with interval.workprec(BITS):
        osc = oscillator(PAPER)
        for _ in range(rounds(200)):
            a, d = 50 * decimal_fraction(random), abs(20 * decimal_fraction(random))
            r = Fraction(1, random.choice([1, 10, 10**6, 10**12]))
            s = random.choice([1, -1])
            numbers = slow_numbers(osc, s, interval.around(a, r), interval.around(a + d, r))
            inside = [
                k
                for k in range(-40, 40)
                if a - r <= interval.midpoint(osc.slow(s, k).t) <= a + d + r
            ]
            assert set(inside) <= set(numbers)
            assert len(numbers) <= len(inside) + 4
        for bad in (Ball("nan"), Ball(0, "inf"), Ball(0, 20)):
            for times in ((bad, Ball(1)), (Ball(1), bad)):
                with pytest.raises(NotProved, match="too uncertain"):
                    slow_numbers(osc, 1, *times)


@BOTH
@pytest.mark.parametrize("s", [1, -1])
def test_a_flight_from_a_release(p, s):
    """Only the moment of the release itself is left out, not the next, nor another."""
    with interval.workprec(BITS):
        osc = oscillator(p)
        for k in (-3, 0, 5):
            slow = osc.slow(s, k)
            flight = osc.launch(s, slow, Ball(0), Ball(0))
            soon, late = slow.t + Ball(1) / 10, slow.t + osc.T + Ball(1) / 10
            assert flies(osc, flight, (slow.t, soon), BALLS.bound, k) is None
            for released in (None, k + 1, k - 1):
                with pytest.raises(NotProved, match="may vanish"):
                    flies(osc, flight, (slow.t, soon), BALLS.bound, released)
            with pytest.raises(NotProved, match="may vanish"):  # f T is more than the forcing gives
                flies(osc, flight, (slow.t, late), BALLS.bound, k)


@pytest.mark.parametrize("periods", [1, 2, 5, 12])
@pytest.mark.parametrize("s", [1, -1])
def test_a_flight_of_several_periods(s, periods):
    """The last minimum decides: f T less speed after each period; against the closed form."""
    with interval.workprec(BITS):
        osc = oscillator(PAPER)
        start = moment(osc, Fraction(1, 10))
        times = start.t, start.t + periods * osc.T
        slow = osc.slow(s, periods - 1 + (osc.slow(s, 0).t < start.t))
        at_rest = osc.launch(s, start, Ball(0), Ball(0))
        needed = -s * osc.velocity(at_rest, slow)  # the start velocity with which v touches 0
        for more in (Fraction(1, 10**20), Fraction(0), Fraction(-1, 10**20)):
            flight = osc.launch(s, start, Ball(0), s * (needed + interval.ball(more)))
            if more > 0:
                least = flies(osc, flight, times, BALLS.bound)
                assert holds(least, more, Fraction(1, 10**40))
            else:
                with pytest.raises(NotProved, match="may vanish") as caught:
                    flies(osc, flight, times, BALLS.bound)
                assert caught.value.sets["when"].overlaps(slow.t)


def test_uncertain_frequencies():
    """ω known to 1e-3 only: slow moments of each frequency in it are found, 30 periods on."""
    constants = Constants.of(PAPER, interval.ball)._replace(
        omega=interval.around(Fraction(1), Fraction(1, 1000))
    )
    with interval.workprec(BITS):
        thick = of_constants(constants)
        for omega in (Fraction(999, 1000), Fraction(1), Fraction(1001, 1000)):
            thin = of_constants(constants._replace(omega=interval.ball(omega)))
            for k in range(27, 33):
                t = thin.slow(1, k).t
                near = t - Ball(1) / 100, t + Ball(1) / 100
                numbers = slow_numbers(thick, 1, *near)
                assert k in numbers
                assert thick.slow(1, k).t.overlaps(t)
