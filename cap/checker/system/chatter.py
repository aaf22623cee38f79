"""Chatter: infinitely many hits of one guard accumulate in finite time, by a lemma on numbers.

*The lemma.*  From t_0 to t_d follow an orbit, and let h >= 0 be a guard along it, h' and h'' its
derivatives in time: L h and L^2 h of the modes that the orbit is in.  Let r_1, g_1, g_2, H_B, q_B >
0, and suppose that as long as 0 <= h <= H_B and |h'| <= q_B

- h'' <= -r_1 where h' >= 0, and -g_2 <= h'' <= -g_1 where h' <= 0;
- where h > 0, h and h' are continuous, h'' is but for changes of the mode, and there is no rest;
- where h comes to 0 with h' < 0 (a *hit*), h' becomes -e' h' with some e', 0 < e' <= e <= 1;
- no other event happens, but changes of the mode where h' = 0.

Begin with h <= delta, |h'| <= u, but not with h = h' = 0; or with a hit of a speed |h'| <= u.  Put

    H = delta + u^2/(2 r_1),    q^2 = u^2 max(1, g_2/r_1) + 2 g_2 delta,    k = e sqrt(g_2/r_1),
    t_1 = t_0 + u/r_1 + sqrt(2 H/g_1) + (1/r_1 + 1/sqrt(r_1 g_1)) e q/(1 - k),

after a hit H = 0, q = u and t_1 = t_0 + the last term.  If k < 1, t_1 <= t_d, q <= q_B and H,
q^2/(2 r_1) <= H_B, then infinitely many hits happen, which accumulate at a time up to t_1, where h
= h' = 0.  Between two of them, and before the first one where it does not begin with a hit, h' has
one zero, or none before the first one; each speed before a hit is at most k times the one before.

*Proof.*  At first let the orbit not leave the set B of the h, h' above.  Between hits h' decreases,
so h rises, if at all, before it falls.

1. *While h rises*, h + h'^2/(2 r_1) does not increase, for its derivative is h' (1 + h''/r_1).
   From h' = w on it rises for at most w/r_1, as h' decreases at least at the rate r_1.
2. *While h falls*, h'^2 + 2 g_2 h does not increase, for its derivative is 2 h' (h'' + g_2), and
   the fall from a height y ends with a hit after at most sqrt(2 y/g_1), as h'' <= -g_1.  There h' <
   0, for h' decreases on the way; if h = 0 at the beginning, it is a hit with h' < 0.
3. *To the first hit.*  It rises to at most H, within u/r_1; then h'^2 + 2 g_2 h <= 2 g_2 H <= q^2.
   Or it falls at once, with h'^2 + 2 g_2 h <= u^2 + 2 g_2 delta <= q^2.  The fall takes at most
   sqrt(2 H/g_1).  In both cases the hit has a speed of at most q.
4. *From a hit to the next.*  Leaving with w, it rises to at most w^2/(2 r_1), within w/r_1, falls
   for at most w/sqrt(r_1 g_1) and arrives with h'^2 <= g_2 w^2/r_1.  Here w is at most e times the
   speed before the hit, which therefore becomes the next time at most k times as large, and w <= e
   q k^n after n + 1 hits: the times from hit to hit add up to at most the last term of t_1.

*The orbit does not leave B* up to t_d.  By 3 and 4 h + h'^2/(2 r_1) <= max(H, q^2/(2 r_1)) <= H_B
while it rises, as e <= 1, and h'^2 + 2 g_2 h <= q^2 <= q_B^2 while it falls, as k < 1.  Let T be
the last time up to which it is in B.  B is closed, so the bounds hold at T.  If h' > 0 there, h <
H_B; and h' decreases.  If h' <= 0 < h, |h'| < q_B; and h does not increase for a while.  If h = 0,
h' > 0 after a hit, or h' = 0, when the hits have accumulated.  So it is in B for a while longer.

*One at a time.*  If the bounds hold until a time by which the first hit, or the next one, is over,
it happens: by 3 it has a speed of at most q, if H <= H_B and q <= q_B; by 4 one of at most k u
after one of at most u, if (e u)^2/(2 r_1) <= H_B and u, k u <= q_B; here k may be 1 or more.

*After it* h = h' = 0.  There the orbit rests as long as h'' < 0 in the mode in which h falls.
"""

from __future__ import annotations

from typing import NamedTuple

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need


class States(NamedTuple):
    """The states with 0 <= h <= height, |h'| <= speed."""

    height: Interval
    speed: Interval


class Pull(NamedTuple):
    """Bounds r_1 <= -h'' where h rises, and g_1 <= -h'' <= g_2 where it falls."""

    rising: Interval
    least: Interval
    most: Interval


class Entry(NamedTuple):
    """How it begins: |h'| <= speed and h <= height; or, without a height, a hit of such a speed."""

    speed: Interval
    height: Interval | None = None

    def wait(self, pull: Pull) -> Interval:
        """Return the longest time until the first hit."""
        if self.height is None:
            return self.speed.integer(0)
        top = self.height + self.speed.square() / (pull.rising * 2)
        return self.speed / pull.rising + (top * 2 / pull.least).sqrt()

    def states(self, pull: Pull) -> States:
        """Return what is reached where the bounds hold: h <= max(H, q^2/(2 r_1)), |h'| <= q."""
        q, top = self.speed, self.speed.integer(0)
        if self.height is not None:
            grown = self.speed.square() * _at_least_one(pull.most / pull.rising)
            q = (grown + self.height * pull.most * 2).sqrt()
            top = self.height + self.speed.square() / (pull.rising * 2)
        bounce = q.square() / (pull.rising * 2)
        return States(_high(bounce if bounce.hi > top.hi else top), _high(q))


class Chatter(NamedTuple):
    """What follows: at most k times the speed from hit to hit, and all of it within ``time``."""

    ratio: Interval
    time: Interval


def chatter(entry: Entry, inside: States, pull: Pull, e: Interval) -> Chatter:
    """Prove that hits accumulate; the bounds must hold for the states ``inside``.

    So must the other hypotheses, that only h = 0 is met and no rest where h' = 0, until the time
    that is returned, t_1 - t_0, has passed.
    """
    rising, least, most = pull
    one = e.integer(1)
    need(rising.is_positive() and least.is_positive(), "what chatters may be held off")
    ratio = e * (most / rising).sqrt()
    decrease = e.is_positive() and e.hi <= one.hi and ratio.is_before(one)
    need(decrease, "the speeds at the hits may not decrease")
    height, q = entry.states(pull)
    _confirm_kept(States(height, q), inside)
    bounces = (one / rising + one / (rising * least).sqrt()) * e * q / (one - ratio)
    return Chatter(ratio, entry.wait(pull) + bounces)


class Reached(NamedTuple):
    """The next hit: a bound of its speed, and of the time until it; the ratio of the speeds."""

    speed: Interval
    time: Interval
    ratio: Interval


def first_hit(entry: Entry, inside: States, pull: Pull) -> Reached:
    """Prove that there is a first hit, if the bounds hold until the time returned has passed."""
    need(pull.rising.is_positive() and pull.least.is_positive(), "what chatters may be held off")
    reached = entry.states(pull)
    _confirm_kept(reached, inside)
    return Reached(reached.speed, entry.wait(pull), entry.speed.integer(0))


def next_hit(speed: Interval, inside: States, pull: Pull, e: Interval) -> Reached:
    """Prove that after a hit of at most this speed there is another one, under the same bounds."""
    rising, least, most = pull
    need(rising.is_positive() and least.is_positive(), "what chatters may be held off")
    ratio, left = e * (most / rising).sqrt(), e * speed
    again = _high(ratio * speed)
    fastest = again if again.hi > speed.hi else speed
    _confirm_kept(States(_high(left.square() / (rising * 2)), fastest), inside)
    one = e.integer(1)
    time = (one / rising + one / (rising * least).sqrt()) * left
    return Reached(again, time, ratio)


def _confirm_kept(reached: States, inside: States) -> None:
    kept = reached.height.hi <= inside.height.lo and reached.speed.hi <= inside.speed.lo
    need(kept, "what chatters may leave the states that were looked at")


def _at_least_one(x: Interval) -> Interval:
    """Return an enclosure of {max(1, t) : t in x}."""
    one = x.integer(1)
    return Interval(max(one.lo, x.lo), max(one.hi, x.hi), x.bits)


def _high(x: Interval) -> Interval:
    """Return the upper end."""
    return Interval(x.hi, x.hi, x.bits)
