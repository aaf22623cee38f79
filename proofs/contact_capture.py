"""Theorem (contact_capture).  Let a system be given as data (`cap.system.model`), with a guard h
whose events, the hits, make h' to -e h', 0 < e <= 1, and which names a mode of rest.  If the lemmas
succeed, then for every motion that is at an explicit time in an explicit mode and box of states

 (i)   infinitely many hits happen, and until they accumulate nothing else;
 (ii)  they accumulate at a time in an explicit interval, |h'| before each is at most an explicit
       number k < 1 times that before the last one;
 (iii) from then on it is in the mode of rest, with h = h' = 0: for ever, or until an explicit time
       at least, and not so long as another explicit time.

Proof.  (i), (ii): the lemma of `cap.orbits.capture`.  (iii): h' and L h' vanish in the mode of rest
where h = h' = 0, and its guards, restricted to this set, are positive over pieces of time; where
they depend on the clock alone, one period is enough for all times.
"""

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise, product
from typing import Any, NamedTuple

from cap.certificate import writer
from cap.checker.kernel.rejection import Rejected
from cap.checker.verdict import check
from cap.errors import NotProved
from cap.orbits.capture import Boxes, Found, Near, Start, captured, clock
from cap.orbits.wall import Wall
from cap.proofs.contacts import as_parameters
from cap.sets import bisection, interval
from cap.sets.interval import Ball
from cap.system.exponential import number
from cap.system.polynomial import COS, SIN, Polynomial

BITS, CHECKED = 128, 128
PLACES = 10  # decimals of the times of rest and release
DEPTH = 9  # a piece of the time of rest is at least 2^-DEPTH of it
PARTS = [Fraction(k, 4) for k in (2, 1, 3)]  # of a side of the box, where a state is looked for
LARGEST = Fraction(8)  # speed that is tried
PART = Fraction(9, 10)  # of the largest, which is claimed
PHASES = 24  # times of a period at which a box is looked for
GRID = 720  # times of a period at which a release is looked for

Times = list[Fraction]


class Rest(NamedTuple):
    """How long it rests: until ``until``, None for ever, and not until ``released``; and pieces."""

    until: Fraction | None
    released: Fraction | None
    cuts: Times


def prove(place: Wall, time: Fraction, mode: str, box: Boxes) -> dict[str, Any]:
    """Return a certificate, which the independent checker accepts, of all states of a box.

    Raises `NotProved` with the step that failed.
    """
    start = Start(place, time, box)
    with interval.workprec(BITS):
        found = lemma_1_capture(start, time)
        alone = all(q.variables <= {COS, SIN} for q in place.rested().values())
        if alone:
            return _checked(start, mode, found, lemma_2_rest(place, found))
        return _checked(start, mode, *lemma_2_rest_among_others(start, found))


def lemma_1_capture(start: Start, latest: Fraction) -> Found:
    """*Statement.* (i), (ii).

    *Computed.* Bounds of h'' on a set that no motion leaves; until ``latest``, if it is later than
    the accumulation, of the other variables in the mode of rest too.
    """
    return captured(start, latest)


def lemma_2_rest(place: Wall, found: Found) -> Rest:
    """*Statement.* (iii), where the guards of the mode of rest depend on the clock alone.

    *Computed.* These guards on pieces of time.
    """
    since, last = found.time
    held = Held(place, {})
    period = interval.ends(2 * interval.pi() / number(place.system.omega))[1]
    times = [since + period * k / GRID for k in range(GRID + 1)]
    falls = next((pair for pair in pairwise(times) if held.ended(pair[1])), None)
    if falls is None:
        return Rest(None, None, held.cuts(since, since + period))
    key = held.ended(falls[1])[0]
    until, released = bisection.crossing(lambda t: held.at(key, t), *falls, PLACES)
    if until < last:
        sets = {"accumulated": last, "released": until}
        raise NotProved("rest", "it may be released before the hits have accumulated", sets)
    return Rest(until, released, held.cuts(since, until))


def lemma_2_rest_among_others(start: Start, found: Found) -> tuple[Found, Rest]:
    """*Statement.* (iii), without a time of release; *computed* on pieces of time, for the longest
    time found in which the other variables are not seen to go too far.
    """

    def until(more: Fraction) -> tuple[Found, Rest]:
        again = captured(start, found.time[1] + more)
        last = again.time[1] + more
        again = captured(start, last)
        held = Held(start.wall, again.others)
        return again, Rest(last, None, held.cuts(again.time[0], last))

    longer = bisection.largest(until, found.time[1] - start.time, 6)
    return until(Fraction(0) if longer is None else interval.short(longer))


def at_the_wall(
    place: Wall, time: Fraction | None, tell: Callable[[str, float | None], None]
) -> tuple[Fraction, Boxes]:
    """Return a large box at the wall, for a state of two variables, and its time.

    The time is the one given, or that of the largest box found among some in a period.
    """
    if time is not None or place.system.autonomous:
        return time or Fraction(0), largest(place, time or Fraction(0))[1]
    with interval.workprec(BITS):
        period = interval.midpoint(2 * interval.pi() / number(place.system.omega))
    found: list[tuple[Fraction, Fraction, Boxes]] = []
    for k in range(PHASES):
        tell("a box at the wall is looked for", k / PHASES)
        phase = round(period * k / PHASES, 3)
        try:
            size, box = largest(place, phase)
        except NotProved as failure:
            reason = failure
        else:
            found.append((size, phase, box))
    if not found:
        raise reason
    _, phase, box = max(found, key=lambda each: each[0])
    return phase, box


def largest(place: Wall, time: Fraction) -> tuple[Fraction, Boxes]:
    """Return the largest u found, and a box around the states with h <= u²/(2a), |h'| <= u.

    Here a is -h'' where h = h' = 0; u is 0 if there is none.  For a state of two variables.
    """
    with interval.workprec(BITS):
        a = Near(place, (time, time), Fraction(0), Fraction(0), {}).pull().least
        size = bisection.largest(lambda u: captured(_near(place, time, u, a), time), LARGEST, 5)
        if size is None:
            captured(_near(place, time, LARGEST / 2**bisection.HALVINGS, a), time)
            raise NotProved("capture", "no box at the wall is captured")
        return size, _near(place, time, interval.short(size * PART), a).box


def _near(place: Wall, time: Fraction, u: Fraction, a: Ball) -> Start:
    """Return the box at the wall for a speed."""
    speed, height = interval.ball(u), interval.ball(u * u) / (2 * a)
    known = {"(h)": interval.hull(Ball(0), height), "(h')": interval.symmetric(speed)}
    known |= clock(place.system, interval.ball(time))
    box, places = {}, max(0, 3 - interval.decade(u * u if u < 1 else u))
    for z in place.system.state:
        side = place.solved[z].evaluated(known, interval.ball, interval.pi())
        low, high = map(Fraction, interval.outward(side, places))
        box[z] = low, high
    return Start(place, time, box)


class Held:
    """The guards of the mode of rest where h = h' = 0, at times and over pieces of time.

    The other variables lie in a box, if the guards depend on them.
    """

    def __init__(self, place: Wall, others: Boxes) -> None:
        self.place, self.guards = place, place.rested()
        self.others = {z: interval.hull(*map(interval.ball, ends)) for z, ends in others.items()}
        self.rates = {
            key: place.standing(place.system.lie(place.rest, q)) for key, q in self.guards.items()
        }

    def at(self, key: str, t: Fraction) -> Ball:
        """Return a guard at a time."""
        return self._value(self.guards[key], interval.ball(t))

    def _value(self, q: Polynomial, t: Ball) -> Ball:
        known = {**self.others, **clock(self.place.system, t)}
        value: Ball = q.evaluated(known, interval.ball, interval.pi())
        return value

    def ended(self, t: Fraction) -> list[str]:
        """Return the guards that are not positive at a time."""
        return [key for key in self.guards if not self.at(key, t) > 0]

    def cuts(self, a: Fraction, b: Fraction) -> Times:
        """Return times between two, so dense that the guards are seen to be positive."""
        waiting, done = [(a, b, 0)], Times()
        while waiting:
            low, high, depth = waiting.pop()
            if all(self._holds(key, low, high) for key in self.guards):
                done.append(high)
            elif depth < DEPTH:
                middle = (low + high) / 2
                waiting += [(middle, high, depth + 1), (low, middle, depth + 1)]
            else:
                sets = {"between": (low, high)}
                raise NotProved("rest", "a guard of the mode of rest may come to 0", sets)
        return done[:-1]

    def _holds(self, key: str, a: Fraction, b: Fraction) -> bool:
        piece = interval.hull(interval.ball(a), interval.ball(b))
        if self._value(self.guards[key], piece) > 0:
            return True
        rate = self._value(self.rates[key], piece)
        end = b if rate < 0 else a if rate > 0 else None
        return end is not None and bool(self.at(key, end) > 0)


def _checked(start: Start, mode: str, found: Found, rest: Rest) -> dict[str, Any]:
    """Return the certificate, if the checker accepts it."""
    place = start.wall
    claims = {
        "start": _shown(start.time),
        "mode": mode,
        "box": {z: [*map(_shown, ends)] for z, ends in start.box.items()},
        "falling": place.falling,
        "guard": place.guard,
        "rising": place.rising,
        "restitution": _shown(place.e),
        "ratio": writer.bound(found.ratio),
        "accumulation_time": [*map(_shown, found.time)],
        **_of(rest),
    }
    hints = {
        "bits": str(CHECKED),
        "height": _shown(found.height),
        "speed": _shown(found.speed),
        "others": {z: [*map(_shown, ends)] for z, ends in found.others.items()},
        "state": {z: _shown(c) for z, c in _meant(start, mode).items()},
        "cuts": [*map(str, rest.cuts)],
    }
    certificate = {
        "format": writer.FORMAT,
        "theorem": "contact_capture",
        "parameters": as_parameters(place.system, rests=True),
        "digits": str(PLACES),
        "claims": claims,
        "hints": hints,
        "cites": [],
        "provenance": writer.provenance(BITS),
    }
    try:
        check(writer.dumps(certificate).encode(), lambda _step: None)
    except Rejected as reason:
        why = f"the independent checker rejects the certificate: {reason}"
        raise NotProved("checker", why) from None
    return certificate


def _meant(start: Start, mode: str) -> dict[str, Fraction]:
    """Return a state of the box at which all guards of a mode are positive."""
    guards = start.wall.system.modes[mode].guards.values()
    sides = [[a + (b - a) * part for part in PARTS] for a, b in start.box.values()]
    for state in product(*sides):
        at = dict(zip(start.box, state, strict=True))
        point = replace(start, box={z: (c, c) for z, c in at.items()})
        if all(point.at(guard.value) > 0 for guard in guards):
            return at
    raise NotProved(
        "start", f"no state of the box is seen in which all guards of {mode} are positive"
    )


def _of(rest: Rest) -> dict[str, str]:
    """Return the claims about the rest."""
    if rest.until is None:
        return {"for_ever": "yes"}
    released = {} if rest.released is None else {"released_by": _shown(rest.released)}
    return {"rests_until": _shown(rest.until), **released}


def _shown(q: Fraction) -> str:
    """Return a number, as a decimal if it is one."""
    rest = q.denominator
    for prime in (2, 5):
        while rest % prime == 0:
            rest //= prime
    return interval.exact_decimal(q) if rest == 1 else str(q)
