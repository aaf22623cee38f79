"""Theorem (contact_basin).  Let a system be given as data (`cap.system.model`), with a guard h of a
mode D whose events, the hits, make h' to -e h', 0 < e <= 1, and which names a mode of rest; D has
no other guard, h depends on one variable of the state, h' on the other, and -h'' = m + c cos wt + d
sin wt.  If the lemmas succeed, then of the states of an explicit rectangle at a time t_0, by area,

 (i)  at least an explicit part comes to rest before T: infinitely many hits accumulate before;
 (ii) at least an explicit part does not: it is in D with h > 0 at T, after finitely many hits.

Proof.  The rectangle is cut in cells, halves of halves (`cap.areas.resting`).  In outward-rounded
doubles all motions of a cell are followed from hit to hit: their states are in the image of its
middle and a product of derivatives, mean values; each hit has a window of times in which h' < 0.
(i): near the wall the lemma of `cap.orbits.capture` applies.  (ii): h > 0 until T.
"""

import math
from fractions import Fraction
from typing import Any, NamedTuple

from cap.areas.resting.fates import Sides
from cap.areas.resting.pull import Pull
from cap.areas.resting.sweep import DEEPEST, Swept, sweep
from cap.errors import BadInput, NotProved
from cap.orbits.capture import Boxes, clock, value
from cap.orbits.wall import Wall
from cap.proofs.certified import certified
from cap.proofs.contact_capture import shown
from cap.proofs.contacts import as_parameters
from cap.runner import Runner, Tell
from cap.sets import doubles, interval
from cap.sets.doubles import Interval
from cap.sets.interval import Ball
from cap.system.exponential import number
from cap.system.polynomial import COS, SIN, Polynomial

BITS, CHECKED = 128, 128
PLACES = 6  # decimals of the shares that are claimed
CELLS = 10_000  # about so many, if nothing is said


class Rectangle(NamedTuple):
    """The states ``box`` at the time ``start``, and the time until which they are followed."""

    start: Fraction
    until: Fraction
    box: Boxes


def prove(
    place: Wall, asked: Rectangle, cells: int = CELLS, runner: Runner | None = None
) -> dict[str, Any]:
    """Return a certificate, which the independent checker accepts.

    Its cells are followed by the processes of ``runner``, after a sweep in this one.

    Raises `BadInput` if the system is not of this kind, `NotProved` if no cell has a fate.
    """
    runner = runner or Runner()
    with interval.workprec(BITS):
        pull = driven(place)
        swept = lemma_1_fates(*numbers(place, pull, asked), cells, runner.tell)
    if not (swept.rests or swept.flies):
        raise NotProved("cells", "of no cell it is certain that it rests, or that it does not")
    return _checked(place, asked, swept, runner)


def driven(place: Wall) -> Polynomial:
    """Return -h''; `BadInput` says why the theorem does not apply."""
    system = place.system
    mode = system.modes[place.falling]
    pull = -system.lie(place.falling, place.rate)
    slopes = [pull.derivative(z) for z in (COS, SIN)]
    sides = [[z for z in system.state if q.derivative(z)] for q in (place.h, place.rate)]
    held = [q.multiple_of(pull) for q in place.rested().values()] if pull else [None]
    for fails, reason in (
        (len(system.state) != 2, f"the state has {len(system.state)} variables, not two"),
        (len(mode.guards) != 1, f"{place.falling} has other guards than {place.guard}"),
        (mode.guards[place.guard].to != (place.falling,), "a hit leads to another mode"),
        (any(len(names) != 1 for names in sides), "h or h' depends on both variables"),
        (not all(map(system.is_constant, slopes)), "-h'' has a product of cos and sin"),
        (bool(pull.variables & {*system.state}), "-h'' depends on the state: flights are not "
         "polynomial in time, but for the clock"),
        (any(k is None or k <= 0 for k in held), f"a guard of {place.rest} is not a multiple of "
         "-h''"),
    ):  # fmt: skip
        if fails:
            raise BadInput(f"no share of a rectangle is proved of this model: {reason}")
    return pull


def lemma_1_fates(p: Pull, sides: Sides, cells: int, tell: Tell) -> Swept:
    """*Statement.* (i), (ii).

    *Computed.* Cells in compiled doubles, halved where no fate is certain.
    """
    return sweep(p, sides, cells, tell)


def numbers(place: Wall, pull: Polynomial, asked: Rectangle) -> tuple[Pull, Sides]:
    """Return the pull from the start on, and the sides of the rectangle, in doubles."""
    known = clock(place.system, interval.ball(asked.start))
    c, d = (value(pull.derivative(z), {}) for z in (COS, SIN))
    omega = number(place.system.omega)
    early, late = _beside(asked.until - asked.start)
    p = Pull(
        _double(value(pull.without(COS, SIN), {})),
        _double(c * known[COS] + d * known[SIN]),
        _double(d * known[COS] - c * known[SIN]),
        _double(omega),
        _double(1 / omega),
        doubles.enclosing(place.e),
        early,
        late,
    )
    sides: list[Interval] = []
    for q in (place.h, place.rate):
        (z,) = (z for z in place.system.state if q.derivative(z))
        a, b = asked.box[z]
        slope = value(q.derivative(z), {})
        base = slope * interval.ball(a) + value(q.without(z), known)
        sides += [_double(base), _double(slope * interval.ball(b - a))]
    return p, Sides(*sides)


def _beside(q: Fraction) -> tuple[float, float]:
    """Return a double that is not above a number, and one that is not below."""
    x = float(q)
    low = x if Fraction(x) <= q else math.nextafter(x, -math.inf)
    return low, x if Fraction(x) >= q else math.nextafter(x, math.inf)


def _double(x: Ball) -> Interval:
    """Return an interval of doubles that contains a ball."""
    a, b = interval.ends(x)
    middle = doubles.enclosing((a + b) / 2)
    return doubles.widened(middle, doubles.upper(doubles.enclosing(b - a)))


def _checked(place: Wall, asked: Rectangle, swept: Swept, runner: Runner) -> dict[str, Any]:
    """Return the certificate, if the checker accepts it."""
    claims = {
        "start": shown(asked.start),
        "until": shown(asked.until),
        "mode": place.falling,
        "guard": place.guard,
        "restitution": shown(place.e),
        "box": {z: [*map(shown, ends)] for z, ends in asked.box.items()},
        "resting": _share(swept.rests),
        "flying": _share(swept.flies),
    }
    parameters = as_parameters(place.system, rests=True)
    content = claims, {"bits": str(CHECKED), "tree": swept.tree}
    return certified("contact_basin", parameters, content, runner, digits=PLACES, bits=BITS)


def _share(units: int) -> str:
    """Return a share, rounded down."""
    return shown(Fraction(units * 10**PLACES >> DEEPEST, 10**PLACES))
