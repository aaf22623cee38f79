"""Capture at a wall: infinitely many hits accumulate in finite time, and the mass comes to rest.

It is the lemma of ``chatter`` for h, the guard of the wall in the mode that moves towards it; what
it needs is read from the model.  With s the side of the wall, h = s (wall - x) is the height over
it.  By ``one_mass`` L h = -u in that mode, u = s v; in the other one u' = -u is positive, so L h =
u'; a hit makes v to -e v, so h' to -e h'.  Hence x = wall - s h and v = -s h' on the set B of the
lemma, and L^2 h is a polynomial in x, v, the clock and the parameters that is enclosed over B and
the window, in each of the two modes.  For the oscillator, if b_1 <= b <= b_2 there, b = s F cos wt
the force towards the wall, this is

    r_1 = b_1 + f,    g_1 = b_1 - f - mu q,    g_2 = b_2 - f.

*No rest.*  Where h' = v = 0 and h > 0, the mass moves on to the side s, if q_s < 0 there
(``one_mass``): the guard of its release from a rest to this side, here f - b.  That is looked at
over the window.  By (L + mu) u = -q_s it is L^2 h in the falling mode where v = 0, so that after
the accumulation h = h' = 0 stays as long as q_s < 0.

*No other event.*  The other guards are positive on B, in both modes: that of the other wall.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from cap.checker.flow.hits import HITS, Hit
from cap.checker.flow.losses import Lossy
from cap.checker.flow.mechanics import Ends
from cap.checker.flow.one_mass import MODES
from cap.checker.flow.stops import SIDES, Event, Rest, span
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Jet
from cap.checker.kernel.rejection import Rejected, need
from cap.checker.system.chatter import Chatter, Entry, Pull, States, chatter
from cap.checker.system.evaluation import evaluate
from cap.checker.system.friction import REST, STOP, WALL
from cap.checker.system.model import COS, SIN
from cap.checker.system.polynomial import Polynomial

_MEANING = (
    "; here 'capture' and a wall stand for infinitely many hits of this wall, one turn before each "
    "(but perhaps none before the first, if no event comes before) and nothing else, which "
    "accumulate in finite time, from which on the mass rests at the wall until its release"
)


def captures(itinerary: Sequence[str]) -> str:
    """Return in words what captures among these events stand for; nothing without any."""
    return _MEANING if any(word.startswith("capture") for word in itinerary) else ""


def capture(M: Lossy, before: Event | Hit | None, word: str, window: Ends) -> tuple[Event, Rest]:
    """Prove that hits of the wall on this side, and turns between, accumulate within [t_a, t_d].

    ``before`` is the hit of this wall that the mass leaves, or None: then the mass is in the box at
    the time 0, and the claim is made for orbits from its interior.  On return, the mass rests at
    the wall from the accumulation on at least until t_d, held by a force.
    """
    side, found = SIDES[word.split()[1]], bounces(M, before, word, window)
    begin = M.number(window[0]) if before is None else before.moment.t.value
    last = begin + found.time
    need(last.upper <= window[1], "the hits may not accumulate within their window")
    moment = M.at(Interval(begin.lo, last.hi, M.bits))
    rest = Rest(M.constant(M.walls[side]), M.number(window[1]), M.period, (-side,))
    return Event(word, moment, span(M, window)), rest


def bounces(M: Lossy, before: Event | Hit | None, word: str, window: Ends) -> Chatter:
    """Return what the lemma says of the hits that begin in this window, if it is long enough."""
    near = Near(M, SIDES[word.split()[1]], window)
    held = near.over(M.laws.model.modes[REST].guards[MODES[near.side]].value, near.standing)
    need((-held).is_positive(), "the force may be too weak to hold the mass at the wall")
    entry = _entry(M, before, near.side, window)
    inside = entry.states(near.pull(near.standing))
    found = chatter(entry, inside, near.pull(inside), M.e.value)
    need(near.is_clear(inside), "the other wall may be reached from this one")
    return found


def _entry(M: Lossy, before: Event | Hit | None, side: int, window: Ends) -> Entry:
    """Return how a capture begins."""
    if before is None:
        need(window[0] == 0, "the window of a capture does not begin at 0")
        height = (M.walls[side] - M.variables[0].value) * side
        return Entry(_ends(M.variables[1].value.magnitude())[1], _ends(height)[1])
    if not isinstance(before, Hit) or before.word != HITS[side]:
        raise Rejected("a capture not after its hit")
    late = window[0] > before.moment.t.value.lower
    need(not late, "the window of a capture begins after the hit before it")
    return Entry(_ends(before.speed.value)[1])


class Near:
    """States near a wall during a window, with a guard h that is 0 at the wall."""

    def __init__(self, M: Lossy, side: int, window: Ends) -> None:
        self.M, self.side, self.model = M, side, M.laws.model
        when = M.at(Interval.enclosing(*window, M.bits))
        self.known = {name: q.value for name, q in M.parameters.items()}
        self.known |= {COS: when.cos.value, SIN: when.sin.value}
        self.standing = States(M.number(Fraction(0)), M.number(Fraction(0)))

    def over(self, g: Polynomial, states: States, sign: int = 1) -> Interval:
        """Return an enclosure of g over these states, in which h' has this sign, or is 0."""
        height, speed = (Interval(0, q.hi, q.bits) for q in states)
        place = self.M.walls[self.side] - height * self.side
        known = self.known | {"x": place, "v": speed * (-self.side * sign)}
        jets = {name: Jet(0, {(): q}) for name, q in known.items()}
        return evaluate(g, jets).constant

    def pull(self, states: States) -> Pull:
        """Return the bounds of -L^2 h over these states."""
        h = self.model.modes[MODES[self.side]].guards[WALL].value
        up, down = (-self.over(self._second(h, sign), states, sign) for sign in (1, -1))
        return Pull(Interval(up.lo, up.lo, up.bits), *_ends(down))

    def _second(self, h: Polynomial, sign: int) -> Polynomial:
        """Return L^2 h in the mode in which h rises, or falls."""
        mode = MODES[-self.side * sign]
        return self.model.lie(mode, self.model.lie(mode, h))

    def is_clear(self, states: States) -> bool:
        """Return whether the guards but h, and the stops, are positive over these states."""
        for sign in (1, -1):
            for name, guard in self.model.modes[MODES[-self.side * sign]].guards.items():
                other = name != STOP and not (name == WALL and sign < 0)
                if other and not self.over(guard.value, states, sign).is_positive():
                    return False
        return True


def _ends(x: Interval) -> tuple[Interval, Interval]:
    """Return the lower and the upper end."""
    return Interval(x.lo, x.lo, x.bits), Interval(x.hi, x.hi, x.bits)
