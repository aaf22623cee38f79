"""Theorem (cascade).  Let G be the release map of `cap.proofs.attractor`, as a function of f, too,
and p the least period of cycles that are seen to attract for f of a range.  If the lemmas succeed,
then at each of the values f_1, f_2, ... enclosed

 (i)   G has a cycle of the least period P = p 2^(k-1) with the multiplier -1;
 (ii)  the multiplier passes -1 there, as f varies, with a derivative that is not zero;
 (iii) near it a cycle of the period 2P branches off, on the side where the multiplier is below -1,
       and attracts.

The ratios of successive differences of the f_k are enclosed.  They may be compared with the
constant of Feigenbaum, 4.669..., to which they converge for families of unimodal maps with full
cascades; that is not claimed here, nor that the cycle at f_(k+1) is the one that branches off at
f_k.

Proof.  (i) by Krawczyk's operator for G^P(x) = x, (G^P)'(x) = -1 in the unknowns x and θ =
arccos(f/F); derivatives by jets in both, and the chain rule.  (ii), (iii) by the theorem on period
doubling: the derivative of the multiplier, and D²G^P ²/2 + D³G^P/3 > 0.
"""

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from typing import Any, NamedTuple

from cap.certificate.writer import window
from cap.errors import NotProved
from cap.floats import candidates
from cap.parameters import Parameters
from cap.proofs.certified import Content
from cap.proofs.fixed_point import Proof, Setting, settled
from cap.proofs.options import RANGE_OF_F, whole_range_of_f
from cap.release import doubling
from cap.release.cycle import foreseen_cycle
from cap.release.doubling import Doubling
from cap.release.family import phase
from cap.release.passage import words
from cap.release.trap import critical_points, value
from cap.sets import interval
from cap.sets.interval import Ball

SUMMARY = "where cycles double their period as f varies over a range, and the ratios"
GROUP = "releases"
SEARCH = candidates.range_of_f
OPTIONS = RANGE_OF_F
CHECK = whole_range_of_f

NUMBER = 6  # of doublings
LOOKS = 24  # values of f at which cycles are looked for
LONGEST = 12  # period of the first cycle
FEIGENBAUM = 4.67  # it steers, as does the next number: of the logistic family
FIRST_STEP = 0.449  # f_2 - f_1 in units of 1/(derivative of the multiplier by f)
QUICK = 500  # iterates
WIDER = Fraction(1, 500)  # windows, in times 1/ω


def prove(setting: Setting) -> Proof:
    """Prove the theorem; there is no size left to choose."""
    p = setting.parameters
    with interval.workprec(setting.bits):
        first = seen(setting)
        found = list[Doubling]()
        guess = first
        for k in range(NUMBER):
            setting.progress(f"period doubling {k + 1} of {NUMBER}")
            found.append(lemma_1_doubling(setting, guess))
            if k + 1 < NUMBER:
                guess = following(p, first, found)
        content = certified(setting, first, found)
    strings = p.strings()
    del strings["f"]
    return settled("cascade", setting, strings, content)


class Guess(NamedTuple):
    """A cycle near one with the multiplier -1, in floats: f, a place, its period."""

    f: float
    x: float
    period: int


def seen(setting: Setting) -> Guess:
    """Return an attracting cycle in the range of f, of the least period, near its doubling."""
    low, high = whole_range_of_f(setting.options, setting.parameters)
    cycles = list[tuple[int, float, Guess]]()
    for k in range(LOOKS):
        f = low + (high - low) * Fraction(2 * k + 1, 2 * LOOKS)
        setting.progress(f"looking for cycles: f = {float(f):.6g}")
        p = replace(setting.parameters, f=f)
        for c in critical_points(p)[:1]:
            cycle = foreseen_cycle(p, c, QUICK, LONGEST)
            if 0 < len(cycle) <= LONGEST:
                guess = Guess(float(f), nearest(cycle, c), len(cycle))
                cycles.append((len(cycle), multiplier(p, cycle), guess))
    if not cycles:
        where = f"at {LOOKS} values of f between {float(low):.6g} and {float(high):.6g}"
        raise NotProved(
            "search", f"no cycle of a period up to {LONGEST} is seen to attract {where}"
        )
    return min(cycles)[2]


def nearest(cycle: tuple[float, ...], c: float) -> float:
    """Return the point of a cycle that is nearest to the critical point."""
    return min(cycle, key=lambda x: abs(x - c))


def multiplier(p: Parameters, cycle: tuple[float, ...]) -> float:
    """Return the product of the slopes along a cycle, in floats."""
    product = 1.0
    for x in cycle:
        here = value(p, x)
        product *= here.slope if here else 0.0
    return product


def following(p: Parameters, first: Guess, found: list[Doubling]) -> Guess:
    """Return a guess of the next doubling."""
    f = [float((each.box[1].cos() * interval.ball(p.F)).mid()) for each in found]
    theta = found[0].box[1]
    speed = float((found[0].orbit.speed / (-interval.ball(p.F) * theta.sin())).mid())
    step = (f[-1] - f[-2]) / FEIGENBAUM if len(f) > 1 else -FIRST_STEP / speed
    period = first.period << len(found)
    for part in (0.9, 0.7, 0.5, 0.3, 0.2, 0.1, 0.05):
        at = replace(p, f=Fraction(f[-1] + part * step))
        x = float(found[-1].box[0].mid())
        cycle = foreseen_cycle(at, x, 30 * period, period)
        if len(cycle) == period:
            return Guess(float(at.f), nearest(cycle, x), period)
    raise NotProved("search", f"no cycle of period {period} is seen", {"f": f})


def lemma_1_doubling(setting: Setting, guess: Guess) -> Doubling:
    """*Statement.* Near the guess there is a cycle with the multiplier -1, and it doubles.

    *Computed.* `cap.release.doubling.proved`; the signs of the derivative of the multiplier and of
    the cubic coefficient.
    """
    p = setting.parameters
    theta = interval.point(phase(p, Fraction(guess.f)))
    tolerance = Ball(10) ** -(setting.precise + 8)
    x, theta = doubling.refined(p, Ball(guess.x), theta, guess.period, tolerance)
    reach = Fraction(1, 10**setting.precise)
    found = doubling.proved(p, x, theta, guess.period, reach)
    if not ((found.orbit.speed > 0 or found.orbit.speed < 0) and found.orbit.cubic > 0):
        sets = {"speed": found.orbit.speed, "cubic": found.orbit.cubic}
        raise NotProved("Lemma 1", "the doubled cycle may not attract, or not be there", sets)
    return found


def certified(setting: Setting, first: Guess, found: list[Doubling]) -> Content:
    """Return claims and hints."""
    p, pair = setting.parameters, setting.rounding.pair
    directions = {"up" if each.orbit.speed > 0 else "down" for each in found}
    itineraries = {words(events) for each in found for events in each.orbit.events}
    if len(directions) > 1 or len(itineraries) > 1:
        raise NotProved("Lemma 1", "the cycles have several itineraries, or directions")
    (direction,), (itinerary,) = directions, itineraries
    f = [each.box[1].cos() * interval.ball(p.F) for each in found]
    differences = [b - a for a, b in pairwise(f)]
    claims = {
        "itinerary": list(itinerary),
        "half_periods": str(found[0].orbit.half_periods),
        "period": str(first.period),
        "direction": direction,
        "parameters": [pair(q, p.F) for q in f],
        "places": [pair(each.box[0], p.R) for each in found],
        "ratios": [pair(a / b) for a, b in pairwise(differences)],
    }
    return claims, {
        "bits": str(setting.bits),
        "cycles": [_hint(setting, each) for each in found],
    }


def _hint(setting: Setting, found: Doubling) -> dict[str, Any]:
    exact = interval.exact_decimal
    wider = interval.around(Fraction(0), WIDER / setting.parameters.omega)
    return {
        "centre": [exact(q) for q in found.hint.centre],
        "reach": [exact(q) for q in found.reach],
        "inverse": [[exact(q) for q in row] for row in found.hint.matrix],
        "events": [
            [window(event.window + wider) for event in events] for events in found.orbit.events
        ],
    }
