"""The lemma of chatter: hits of a guard that accumulate."""

from __future__ import annotations

from fractions import Fraction

import pytest
from mpmath import mp, mpf, sqrt
from support import number, rational, rounds, seeded

from cap.checker.kernel.rejection import Rejected
from cap.checker.system.chatter import Entry, Pull, States, first_hit, next_hit
from checker.parts import Interval, chatter

LITTLE = Fraction(1, 10**30)


def exactly(q):
    """Return a number as an interval of 128 bits."""
    return Interval.enclosing(Fraction(q), Fraction(q), 128)


def pull(*bounds):
    """Return r_1, g_1, g_2."""
    return Pull(*map(exactly, bounds))


def shown(entry, bounds, e, inside=None):
    """Return the ratio and the time, over the states that are reached or over others."""
    return chatter(entry, inside or entry.states(bounds), bounds, exactly(e))


def bounced(rising, falling, e, h, w):
    """Return speeds before the hits and when they accumulate, with constant h'' in both modes."""
    up = max(w, mpf(0))
    t = up / rising
    h = h + up**2 / (2 * rising)
    start = min(w, mpf(0)) ** 2
    q = sqrt(start + 2 * falling * h)
    t += (q - sqrt(start)) / falling
    speeds = [q]
    while q > mpf(10) ** -25:
        w = e * q
        h, t = w**2 / (2 * rising), t + w / rising
        q = sqrt(2 * falling * h)
        t += q / falling
        speeds.append(q)
    return speeds, t


def test_a_ball_on_a_table():
    """Under constant weight the lemma is exact after a hit, and for a ball that is thrown up."""
    g, e, q = Fraction(10), Fraction(3, 4), Fraction(2)
    found = shown(Entry(exactly(q)), pull(g, g, g), e)
    assert abs(found.ratio.upper - e) < LITTLE
    assert 0 <= found.time.upper - 2 * e * q / (g * (1 - e)) < LITTLE
    thrown = shown(Entry(exactly(q), exactly(0)), pull(g, g, g), e)
    assert 0 <= thrown.time.upper - 2 * q / (g * (1 - e)) < LITTLE
    dropped = shown(Entry(exactly(0), exactly(5)), pull(g, g, g), e)
    assert 0 <= dropped.time.upper - (1 + 2 * e * 10 / (g * (1 - e))) < LITTLE


def test_what_is_reached():
    """The highest bounce and the fastest hit, with another weight up than down."""
    up, down = Fraction(8), Fraction(18)
    height, speed = Entry(exactly(2), exactly(1)).states(pull(up, 5, down))
    assert abs(speed.upper**2 - (4 * down / up + 2 * down)) < LITTLE
    assert abs(height.upper - speed.upper**2 / (2 * up)) < LITTLE
    height, speed = Entry(exactly(2), exactly(1)).states(pull(down, 5, up))
    assert abs(speed.upper**2 - (4 + 2 * up)) < LITTLE
    assert abs(height.upper - (1 + 4 / (2 * down))) < LITTLE
    height, speed = Entry(exactly(3)).states(pull(up, 5, down))
    assert (speed.upper, height.upper) == (3, Fraction(9, 16))


def test_orbits():
    """Random bounces with a weight between the bounds: slower, and in less time."""
    rng = seeded(5)
    for _ in range(rounds(40)):
        rising, least, more = (Fraction(rng.randint(5, 30), 10) for _ in range(3))
        most, e = least + more, Fraction(rng.randint(1, 10), 10)
        h, u = (Fraction(rng.randint(1, 30), 10) for _ in range(2))
        entry, bounds = Entry(exactly(u), exactly(h)), pull(rising, least, most)
        if e * e * most >= rising:
            with pytest.raises(Rejected, match="may not decrease"):
                shown(entry, bounds, e)
            continue
        found, states = shown(entry, bounds, e), entry.states(bounds)
        with mp.workdps(40):
            for part in (0, mpf(1) / 3, 1):
                falling = number(least) + number(more) * part
                for w in (-number(u), mpf(0), number(u)):
                    speeds, t = bounced(number(rising), falling, number(e), number(h), w)
                    assert rational(t) <= found.time.upper
                    assert rational(speeds[0]) <= states.speed.upper
                    ratio = number(e) * sqrt(falling / number(rising))
                    assert rational(ratio) <= found.ratio.upper + LITTLE


@pytest.mark.parametrize(
    ("bounds", "e", "why"),
    [
        ((0, 1, 1), 1, "held off"),
        ((1, 0, 1), "1/2", "held off"),
        ((-1, -1, 1), "1/2", "held off"),
        ((1, 1, 1), 1, "may not decrease"),
        ((1, 1, 5), "1/2", "may not decrease"),
        ((4, 1, 1), "11/10", "may not decrease"),
        ((4, 1, 1), 0, "may not decrease"),
        ((4, 1, 1), "-1/2", "may not decrease"),
    ],
)
def test_refused(bounds, e, why):
    """No pull, no loss of speed, more speed, no bounce."""
    entry = Entry(exactly(1), exactly(1))
    with pytest.raises(Rejected, match=why):
        chatter(entry, States(exactly(100), exactly(100)), pull(*bounds), exactly(e))


@pytest.mark.parametrize("bounds", [(-1, -1, -1), (-1, 1, 1), (1, -1, 1), (0, 1, 1), (1, 0, 1)])
def test_no_hit_follows(bounds):
    """Where there may be no pull: neither a first one, nor another one."""
    far, e = States(exactly(100), exactly(100)), exactly(Fraction(1, 2))
    with pytest.raises(Rejected, match="held off"):
        first_hit(Entry(exactly(1)), far, pull(*bounds))
    with pytest.raises(Rejected, match="held off"):
        next_hit(exactly(1), far, pull(*bounds), e)


def test_the_states_that_were_looked_at():
    """Exactly what is reached is enough; a little less height or speed is not."""
    for entry in (Entry(exactly(1)), Entry(exactly(1), exactly(1))):
        bounds = pull(4, 1, 3)
        height, speed = entry.states(bounds)
        shown(entry, bounds, Fraction(1, 2), States(height, speed))
        for less in (
            States(height - exactly(LITTLE), speed),
            States(height, speed - exactly(LITTLE)),
        ):
            with pytest.raises(Rejected, match="may leave"):
                shown(entry, bounds, Fraction(1, 2), less)


def test_bounds_that_are_not_known_exactly():
    """With sets for the pull and e, the upper ends are those of the worst numbers in them."""
    entry, e = (
        Entry(exactly(1), exactly(1)),
        Interval.enclosing(Fraction(1, 4), Fraction(1, 2), 128),
    )
    vague = Pull(*(Interval.enclosing(a, a + 1, 128) for a in (4, 1, 3)))
    found = chatter(entry, entry.states(vague), vague, e)
    worst = shown(entry, pull(4, 1, 4), Fraction(1, 2))
    assert 0 <= found.ratio.upper - worst.ratio.upper < LITTLE
    assert 0 <= found.time.upper - worst.time.upper < LITTLE
