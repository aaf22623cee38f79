"""Capture at a wall: infinitely many hits accumulate, and the mass comes to rest there.

Let y >= 0 be the distance from a wall, w = y', and b the force towards the wall, F cos ωt at the
right one and -F cos ωt at the left one: above the wall w' = -b - f sgn(w) - μw, and a hit makes -e
w of w < 0.

*Lemma.*  Let b_1 <= b <= b_2 on a time interval [t_a, t_d], b_1 > f, and let the mass be at the
time t of it at the distance y <= δ, |w| <= u, where y > 0 or w > 0.  Put

    H = δ + u²/(2 (b_1 + f)),      q² = u² max(1, (b_2 - f)/(b_1 + f)) + 2 (b_2 - f) δ,
    g = b_1 - f - μq,              k = e sqrt((b_2 - f)/(b_1 + f)).

If H < R, q² < 2 (b_1 + f) R, g > 0, k < 1 and, with D = 1/(b_1 + f) + 1/sqrt((b_1 + f) g),

    t + u/(b_1 + f) + sqrt(2H/g) + D e q/(1 - k) <= t_d,

then infinitely many hits of this wall, and nothing else but one turning between any two of them and
at most one before the first, accumulate at a time in (t, t_d].  From there the mass rests at the
wall until b falls to -f.

*Proof.*  While w > 0, w' <= -(b_1 + f): the mass rises for u/(b_1 + f) at most, and as d(w²/2)/dy
<= -(b_1 + f), not above H < R.  While w < 0, |w|' = b - f - μ|w| <= b_2 - f, so |w| grows in a
fall: |w|² <= u² + 2 (b_2 - f) δ if the mass fell from the start, and at most 2 (b_2 - f) H after a
rise; both are at most q².  As |w|' >= b - f - μq >= g, a fall from H takes sqrt(2H/g) at most.  It
ends with |w| > 0, so the hit is a true one and the mass leaves again, with the speed u_1 <= e q.
The same with δ = 0 for a bounce that begins with the speed u_n > 0: it rises u_n²/(2 (b_1 + f)),
less than R, ends after D u_n at most, with a speed of at most u_n sqrt((b_2 - f)/(b_1 + f)), and
the next one begins with 0 < u_(n+1) <= k u_n.  So D (u_1 + u_2 + ...) <= D e q/(1 - k): the hits
accumulate before t_d, where the height and the speed have the limit 0.

*And then.*  With y = w = 0 and b >= -f the contact law has one solution, rest: the wall or friction
holds.  (A solution that leaves while b > f makes a bounce, of initial speed u_1, say; before it
there were bounces with u_0 >= u_1/k, u_-1 >= u_1/k², ..., so arbitrarily early ones are not slow,
but the velocity at the beginning of the rest is 0.  While |b| <= f, w > 0 would decrease.)  When b
falls to -f, at the first `Oscillator.slow` to the other side, it leaves.
This is where Step 4 of the proof of Theorem wellposed fails: two hits of the *same* wall are not a
distance R apart.
"""

from dataclasses import dataclass
from typing import Any

from cap.errors import NotProved
from cap.flow.model import Oscillator
from cap.sets import interval
from cap.sets.interval import Ball


@dataclass(frozen=True)
class Entry:
    """A mass near a wall: when, at most how far from it (δ) and how fast (u).

    ``leaving``: it has just left the wall, δ = 0; then only the bounces count.
    """

    time: Ball
    distance: Ball
    speed: Ball
    leaving: bool


@dataclass(frozen=True)
class Accumulation:
    """The time at which the hits accumulate, a bound of the ratio k of speeds, the force b."""

    time: Ball
    ratio: Ball
    forcing: Ball


class TooEarly(NotProved):
    """The hits are certain to accumulate only before ``until``, after the end of the window."""

    def __init__(self, until: Ball, end: Ball) -> None:
        self.until = until
        reason = "the hits may not accumulate before the end of the window"
        super().__init__("capture", reason, {"accumulated": until, "end": end})


def accumulation(osc: Oscillator[Any], side: int, entry: Entry, window: Ball) -> Accumulation:
    """Apply the lemma at the wall of this side, until the end t_d of the ``window``.

    Raises `NotProved` if a condition of the lemma is not certain: the mass may be too fast or too
    far from the wall, or t_d too late (b falls) or too early.
    """
    end = interval.upper(window)
    span = interval.hull(entry.time, end)
    if not (entry.time < end and span.rad() < osc.T / 2):
        raise NotProved("capture", "the window is over, or too long", {"window": window})
    force = side * osc.F * (osc.omega * span).cos()
    least, most = interval.lower(force), interval.upper(force)
    press, hold = least + osc.f, least - osc.f
    if not hold > 0:
        sets = {"force": force, "f": osc.f}
        raise NotProved("capture", "the forcing may not press the mass to the wall", sets)
    gain = (most - osc.f) / press
    ratio = osc.e * gain.sqrt()
    u, far = interval.upper(entry.speed), interval.upper(entry.distance)
    larger = gain.max(Ball(1))
    square = u * u / osc.e / osc.e if entry.leaving else u * u * larger + 2 * (most - osc.f) * far
    height, arrival = far + u * u / (2 * press), square.sqrt()
    g = hold - osc.mu * arrival
    if not (g > 0 and ratio < 1):
        raise NotProved("capture", "the bounces may not decrease", {"ratio": ratio, "g": g})
    room = osc.r - osc.l
    if not (height < room and square < 2 * press * room):
        raise NotProved("capture", "the mass may reach the other wall", {"height": height})
    bounce = 1 / press + 1 / (press * g).sqrt()
    first = Ball(0) if entry.leaving else u / press + (2 * height / g).sqrt()
    last = first + bounce * osc.e * arrival / (1 - ratio)
    if not entry.time + last <= end:
        raise TooEarly(interval.upper(entry.time + last), end)
    time = interval.hull(entry.time, entry.time + interval.upper(last))
    return Accumulation(time, interval.upper(ratio), force)
