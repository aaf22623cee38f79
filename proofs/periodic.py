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

Lemmas 1 and 2 (`cap.proofs.fixed_point`) give (i), Lemma 3 gives (ii) and (iii), Lemma 4
gives (iv).
"""

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from cap.errors import NotProved
from cap.floats import candidates
from cap.flow.model import Oscillator
from cap.maps import basin
from cap.maps.basin import Basin
from cap.maps.fixed_point import FixedPoint
from cap.maps.stability import SINKS, Multiplier, multipliers, stability
from cap.option import Option, count
from cap.proofs.certified import Content
from cap.proofs.fixed_point import Around, Located, Proof, Setting, proof_of
from cap.proofs.orbit import EVENTS, turning_factors
from cap.sets import interval, matrix
from cap.sets.interval import Ball

SUMMARY = "a periodic orbit with any events, turns and sticks too; its type, the basin of a sink"
GROUP = "orbit"
SEARCH = candidates.cyclic
OPTIONS = (Option("period", count(1, 16), "of period N T (default 1)", "N", default=1, about=True),)


def prove(setting: Setting) -> Proof:
    """Prove the theorem up to the size of its box; return the rest of the proof.

    Raises `NotProved` with the step that failed and the sets at which it did.
    """
    return proof_of("periodic", setting, EVENTS, conclusion)


def conclusion(orbit: Located) -> Callable[[Around], Content]:
    """Prove what the theorem says of P*; return the claims."""
    osc, point = orbit.osc, orbit.point
    claims = lemma_3_type(osc, orbit.setting, point)
    if claims["type"] not in SINKS:
        return lambda _around: (claims, {})
    ellipse = basin.largest(osc, point, point.events, orbit.reach)

    def conclude(around: Around) -> Content:
        found = basin.scaled(osc, point, around.proved.expected, ellipse, around.part)
        return {**claims, "basin": lemma_4_basin(found, point, around.box)}, {}

    return conclude


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
        "determinant": exact or setting.rounding.loosely(det),
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
