"""Capture at a wall: infinitely many hits accumulate in finite time, and the mass comes to rest.

*The lemma.*  Let b = F cos wt at the right wall, -F cos wt at the left: the force towards the wall;
and b_1 <= b <= b_2 on [t_a, t_d], b_1 > f.  The height y >= 0 of the mass over the wall has

    y'' = -b - f - mu y'    while y' > 0,      y'' = -b + f + mu |y'|    while y' < 0.

At the time t in [t_a, t_b] let y <= delta and |y'| <= u.  Put rise = b_1 + f, fall = b_2 - f, and

    H = delta + u^2/(2 rise),   q^2 = u^2 max(1, fall/rise) + 2 fall delta,   g = b_1 - f - mu q,

    k = e sqrt(fall/rise);  let g > 0, k < 1, H < R and q^2 < 2 rise R, and, before t_d,

    t_b + u/rise + sqrt(2 H/g) + (1/rise + 1/sqrt(rise g)) e q/(1 - k).

Then infinitely many hits of this wall happen, with one turn between any two of them and at most
one before the first; they accumulate at a time up to t_d, from which on the mass rests there.  Up
to t_d nothing else happens.

1. Rising, y'' <= -rise: for at most u/rise, to at most H < R.  No stick: |F cos wt| >= b_1 > f.
2. Falling, y'' >= -fall, so y'^2 grows by at most 2 fall times the descent.  From rest at most H
   high the mass arrives with y'^2 <= 2 fall H = u^2 fall/rise + 2 fall delta; from y' = -u and y <=
   delta, with y'^2 <= u^2 + 2 fall delta: in both cases |y'| <= q.  Therefore y'' <= -g, and the
   fall lasts at most sqrt(2 H/g).
3. The mass leaves with a speed u' <= e q.  As in 1, it rises for at most u'/rise, to at most
   u'^2/(2 rise) < R; it falls for at most u'/sqrt(rise g), and arrives with at most u'
   sqrt(fall/rise), which is k u'/e < u'/e <= q.  So it leaves with at most k u'; speeds and times
   decrease like k^n, and their sum is the last term.  As y'' <= -g while falling, it arrives with
   positive speed if y > 0 or y' /= 0 before: the hits are infinitely many.

*After a hit* at the time t, with the speed at most q before it: begin with 3, u' <= e q.  Then only
g > 0, k < 1, q^2 < 2 rise R and t + (1/rise + 1/sqrt(rise g)) e q/(1 - k) <= t_d are needed.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from cap.checker.flow.hits import SIDES, Event
from cap.checker.flow.mechanics import Ends, Mechanics
from cap.checker.flow.stops import Rest, span
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need

_MEANING = (
    "; here 'capture' and a wall stand for infinitely many hits of this wall, one turn before each "
    "(but perhaps none before the first, if no event comes before) and nothing else, which "
    "accumulate in finite time, from which on the mass rests at the wall until its release"
)


def captures(itinerary: Sequence[str]) -> str:
    """Return in words what captures among these events stand for; nothing without any."""
    return _MEANING if any(word.startswith("capture") for word in itinerary) else ""


def capture(M: Mechanics, before: Event | None, word: str, window: Ends) -> tuple[Event, Rest]:
    """Prove that hits of the wall on this side, and turns between, accumulate within [t_a, t_d].

    ``before`` is the hit of this wall that the mass leaves, or None: then the mass is in the box at
    the time 0, and the claim is made for orbits from its interior.  On return, the mass rests at
    the wall from the accumulation on at least until t_d, held by a force.
    """
    side = SIDES[word.split()[1]]
    towards = span(M, window) * side
    need((towards - M.f).is_positive(), "the force may be too weak to hold the mass at the wall")
    k = ratio(M, towards)
    need(k.is_before(k.integer(1)), "the speeds at the wall may not decrease")
    rise, fall = _low(towards) + M.f, _high(towards) - M.f
    width = M.walls[1] - M.walls[-1]
    if before is None:
        need(window[0] == 0, "the window of a capture does not begin at 0")
        delta = _high((M.walls[side] - M.x.value) * side)
        u = _high(M.v.value.magnitude())
        H = delta + u.square() / (rise * 2)
        need(H.is_before(width), "the other wall may be reached before a capture")
        q = _high((u.square() * _at_least_one(fall / rise) + fall * delta * 2).sqrt())
        t, wait = M.number(window[0]), u / rise + (H * 2 / _weight(M, towards, q)).sqrt()
    else:
        need(before.word == ("hit r" if side > 0 else "hit l"), "a capture not after its hit")
        t, wait = before.moment.t.value, M.number(Fraction(0))
        need(window[0] <= t.lower, "the window of a capture begins after the hit before it")
        q = _high(before.hit_speed)
    need(q.square().is_before(rise * width * 2), "the other wall may be reached from this one")
    g = _weight(M, towards, q)
    one = g.integer(1)
    bounces = (one / rise + one / (rise * g).sqrt()) * M.e.value * q / (one - k)
    last = t + wait + bounces
    need(last.upper <= window[1], "the hits may not accumulate within their window")
    moment = M.moment(M.constant(Interval(t.lo, last.hi, M.bits)))
    rest = Rest(M.constant(M.walls[side]), M.number(window[1]), M.period, (-side,))
    return Event(word, moment, towards * side), rest


def ratio(M: Mechanics, towards: Interval) -> Interval:
    """Return k = e sqrt((b_2 - f)/(b_1 + f)) from the enclosure [b_1, b_2] of b."""
    return M.e.value * ((_high(towards) - M.f) / (_low(towards) + M.f)).sqrt()


def _weight(M: Mechanics, towards: Interval, q: Interval) -> Interval:
    """Return g = b_1 - f - mu q."""
    g = _low(towards) - M.f - M.mu.value * q
    need(g.is_positive(), "the mass may be held off the wall by the viscosity")
    return g


def _at_least_one(x: Interval) -> Interval:
    """Return an enclosure of {max(1, t) : t in x}."""
    one = x.integer(1)
    return Interval(max(one.lo, x.lo), max(one.hi, x.hi), x.bits)


def _low(x: Interval) -> Interval:
    """Return the lower end."""
    return Interval(x.lo, x.lo, x.bits)


def _high(x: Interval) -> Interval:
    """Return the upper end."""
    return Interval(x.hi, x.hi, x.bits)
