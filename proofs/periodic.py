"""Theorem (periodic).  Let the stroboscopic map Φ of

    x'' = F cos ωt - f sgn x' - μ x',   l < x < r,   v -> -e v at the walls,   T = 2π/ω,

be given at rational parameters, and let an nT-periodic orbit be guessed, with its events: hits,
turnings, sticks, captures, releases.  If the lemmas below succeed, then

 (i)   Φⁿ has exactly one fixed point P* in an explicit box; all orbits from the box have the same
       events, a capture counted as one that stands for infinitely many hits and turns; Φⁿ is
       analytic there;
 (ii)  det (Φⁿ)'(P*) is e² for each hit, times exp(-μnT), times (|F cos ωt| - f)/(|F cos ωt| + f)
       for each turning, and 0 if there is a stick or a capture;
 (iii) the multipliers, and with them the type of P*, are as claimed: elliptic, sink, superstable,
       saddle or flip saddle;
 (iv)  if P* is a sink, an explicit ellipse around it is mapped into itself, and the orbits from
       there converge to that of P*.

Lemmas 1 and 2 (`proofs.fixed_point`) give (i), Lemma 3 gives (ii) and (iii), Lemma 4 gives (iv).
"""

from fractions import Fraction
from typing import Any

from cap.certificate import writer as certificate
from cap.errors import NotProved
from cap.flow.event import Expected
from cap.flow.model import Oscillator
from cap.flow.strobe import Orbit, oscillator
from cap.maps import basin
from cap.maps.basin import Basin
from cap.maps.fixed_point import FixedPoint, Itinerary, Neighbourhood
from cap.maps.stability import SINKS, Multiplier, multipliers, stability
from cap.sets import interval, matrix
from cap.sets.interval import Ball
from proofs.fixed_point import (
    Proof,
    Setting,
    assembled,
    largest_reach,
    lemma_1_fixed_point,
    lemma_2_uniqueness,
)


def prove(setting: Setting) -> Proof:
    """Prove the theorem up to the size of its box; return the rest of the proof.

    Raises `NotProved` with the step that failed and the sets at which it did.
    """
    orbit = Prepared(setting)
    strings = setting.parameters.strings()
    return lambda part: assembled("periodic", setting, strings, orbit.proved(part))


class Prepared:
    """Lemmas 1 and 3, proved; Lemmas 2 and 4 are left, with the size of their sets."""

    def __init__(self, setting: Setting) -> None:
        self.setting = setting
        with interval.workprec(setting.bits):
            self.osc = oscillator(setting.parameters)
            self.point = lemma_1_fixed_point(self.osc, setting)
            self.numbers = {
                **orbit_claims(self.osc, setting, self.point),
                **lemma_3_type(self.osc, setting, self.point),
            }
            self.reach = largest_reach(self.osc, setting, self.point)
            if self.numbers["type"] in SINKS:
                known = events_of(self.point.orbit)
                self.ellipse = basin.largest(self.osc, self.point, known, self.reach)

    def proved(self, part: Fraction) -> tuple[dict[str, Any], dict[str, Any]]:
        """Return the claims and the hints, for a part of the largest sets found."""
        setting, osc, point = self.setting, self.osc, self.point
        with interval.workprec(setting.bits):
            reach = self.reach[0] * part, self.reach[1] * part
            around, box = lemma_2_uniqueness(osc, point, reach)
            claims = {
                "period": str(point.periods),
                "itinerary": [event.word for event in point.orbit.events],
                "box": box,
                **self.numbers,
                "event_times": event_times(setting, point.orbit, around.expected),
            }
            if claims["type"] in SINKS:
                found = basin.scaled(osc, point, around.expected, self.ellipse, part)
                claims["basin"] = lemma_4_basin(found, point, box)
            return claims, hints_of(setting, point, around)


def orbit_claims(osc: Oscillator[Any], setting: Setting, point: FixedPoint) -> dict[str, Any]:
    """Return the claims on P* and its orbit, rounded outwards."""
    units, pair, orbit = setting.units, setting.rounding.pair, point.orbit
    return {
        "x": pair(point.box[0], units.length),
        "v": pair(point.box[1], units.speed),
        "event_times": event_times(setting, orbit, events_of(orbit)),
        "hit_speeds": [pair(abs(hit.velocity), units.speed) for hit in orbit.hits],
        "turning_factors": [pair(factor) for factor in turning_factors(osc, orbit)],
        "jacobian": setting.rounding.matrix(orbit.monodromy, units),
    }


def events_of(orbit: Orbit[Ball]) -> Itinerary:
    """Return the events of P* with the times proved for windows."""
    return tuple(Expected(event.word, event.time) for event in orbit.events)


def event_times(
    setting: Setting, orbit: Orbit[Ball], expected: Itinerary
) -> list[certificate.Pair]:
    """Return when the events of P* happen; of a capture the window ``expected`` of its lemma.

    That of the whole box is what a looser arithmetic finds room in.
    """
    return [
        certificate.window(near.window)
        if near.word.startswith("capture")
        else setting.rounding.pair(event.time, setting.units.time)
        for event, near in zip(orbit.events, expected, strict=True)
    ]


def turning_factors(osc: Oscillator[Any], orbit: Orbit[Ball]) -> list[Ball]:
    """Return (|F cos ωt| - f)/(|F cos ωt| + f) at each turning."""
    sides = {"turn right": -1, "turn left": 1}  # the sign of the velocity before
    return [
        osc.turning_factor(sides[event.word], event.cos)
        for event in orbit.events
        if event.word in sides
    ]


def determinant(osc: Oscillator[Any], setting: Setting, point: FixedPoint) -> Ball:
    """Return det (Φⁿ)'(P*) as a product over the events; its radius is 0 if it is exactly 0 or 1.

    Flights contribute exp(-μd) each, hits e², turnings their factors, sticks and captures 0.
    """
    orbit = point.orbit
    if any(event.word.split()[0] in ("stick", "capture") for event in orbit.events):
        return Ball(0)
    product = Ball(1)
    for factor in turning_factors(osc, orbit):
        product = product * factor
    if setting.parameters.e != 1:
        product = product * interval.ball(setting.parameters.e ** (2 * len(orbit.hits)))
    return product * (-osc.mu * point.periods * osc.T).exp() if osc.viscous else product


def lemma_3_type(osc: Oscillator[Any], setting: Setting, point: FixedPoint) -> dict[str, Any]:
    """*Statement.* The determinant is the product above, and the type of P* is as returned.

    *Computed.* Where the determinant is exactly 1, |trace| < 2 means elliptic; otherwise both
    multipliers lie inside the unit circle if and only if |trace| < 1 + det and det < 1.
    """
    trace, det = matrix.trace(point.orbit.monodromy), determinant(osc, setting, point)
    pair = setting.rounding.pair

    def shown(multiplier: Multiplier) -> Any:
        if isinstance(multiplier, tuple):
            return {"re": pair(multiplier[0]), "im": pair(multiplier[1])}
        return pair(multiplier)

    exact = next(([str(n)] * 2 for n in (0, 1) if det == n), None)  # else the checker rounds
    return {
        "trace": pair(trace),
        "determinant": exact or pair(det + interval.symmetric(det) * interval.rounding()),
        "multipliers": [shown(multiplier) for multiplier in multipliers(trace, det)],
        "type": stability(trace, det),
    }


def lemma_4_basin(found: Basin, point: FixedPoint, box: dict[str, list[str]]) -> dict[str, Any]:
    """*Statement.* |W(Φⁿ(z) - P*)| <= κ |W(z - P*)|, κ < 1, for |W(z - P*)| <= 1, inside the box.

    *Computed.* (Φⁿ)' over the rectangle around the ellipse, as a Taylor model; the mean of W (Φⁿ)'
    W⁻¹ from P* to any point is bounded as a whole and has a norm of at most κ.  The largest ellipse
    of one shape is looked for, and a part of it claimed, with κ nearer to 1.
    """
    for name, where, reach in zip("xv", point.box, found.reach(), strict=True):
        (low, high), (a, b) = map(Fraction, box[name]), interval.ends(where)
        if not low < a - reach < b + reach < high:
            raise NotProved("Lemma 4", "the ellipse may leave the box", {name: where})
    return {
        "matrix": [[interval.exact_decimal(q) for q in row] for row in found.matrix],
        "contraction": interval.exact_decimal(found.contraction),
    }


def hints_of(setting: Setting, point: FixedPoint, around: Neighbourhood) -> dict[str, Any]:
    """Return what the checker needs and does not trust."""
    return {
        "bits": str(setting.checker_bits),
        "centre": [interval.exact_decimal(value) for value in point.hint.centre],
        "radius": interval.exact_decimal(point.reach[0] / setting.units.length),
        "preconditioner": [
            [interval.exact_decimal(value) for value in row] for row in point.hint.matrix
        ],
        "events": [certificate.window(event.window) for event in around.expected],
    }
