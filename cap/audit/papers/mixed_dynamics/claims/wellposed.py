"""Section 2.3: the proof of Theorem 2.5, step by step.

What it misses is that a wall can hold the mass: bounces accumulate (`cap.flow.capture`).
"""

from fractions import Fraction

from cap.audit.means.algebra import symbols
from cap.audit.means.balls import above, between
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.papers.mixed_dynamics.means.orbits import before_a_stop, until
from cap.audit.steps import Words
from cap.parameters import PAPER
from cap.sets import interval
from cap.sets.interval import Ball

CAPTURE = "capture.json"
SMALL = Fraction(1, 100), Fraction(1, 10**4), Fraction(1, 10**6)


def accumulation() -> str:
    """Return the capture at the paper's parameters in words, certified."""
    claims = stored(CAPTURE).claims
    need(claims["itinerary"][0] == "capture r", "the capture is not the first event")
    need(claims["ratio"] < 1, "the ratio of successive speeds may be 1")
    box = claims["box"]
    return (
        f"every orbit from the interior of {box['x']} × {box['v']} at t = 0 hits the right wall "
        f"infinitely often before t = {above(claims['accumulation_time'])}"
    )


def accumulates() -> Words:
    return {"accumulation": accumulation()}


def rests_last() -> Words:
    lengths = []
    with interval.workprec(100):
        for excess in SMALL:
            orbit = until(before_a_stop(excess - PAPER.f), interval.ball(Fraction(5, 2)))
            need(orbit.words == ("hit l", "stick", "release left"), "no rest", w=orbit.words)
            lengths.append(orbit.times[2] - orbit.times[1])
        bounds = [2 * interval.ball(q) for q in SMALL]
        need(all(0 < a < b for a, b in zip(lengths, bounds, strict=True)), "longer rests")
    return {"lengths": ", ".join(between(each, 10) for each in lengths)}


def remainder_after_turning() -> None:
    F, f, w, d = symbols("F f omega d")
    true, stated = F * w * d**2 / 2, (F * w + f) * d**2 / 2
    need(sp.simplify(stated - true).is_positive is True, "the stated bound may be too small")
    unit = symbols("k")  # with time in units 1/k as long, ω becomes ω/k, forces become F/k²
    degrees = {
        sp.degree(sp.expand(term * unit**3), unit) for term in (F * w / unit**3, f / unit**2)
    }
    need(len(degrees) == 2, "both terms scale alike")


def turns_are_robust() -> Words:
    with interval.workprec(100):
        for excess in SMALL:
            orbit = until(before_a_stop(-PAPER.f - excess), interval.ball(Fraction(5, 2)))
            need(orbit.words == ("hit l", "turn left"), "no turn", w=orbit.words)
            over = -orbit.times[1].cos() - interval.ball(PAPER.f)
            need(0 < over < 2 * interval.ball(excess), "the excess is larger", over=over)
    return {"small": ", ".join(str(2 * float(q)) for q in SMALL)}


def velocity_jump(distance: Fraction) -> Ball:
    """Return how far apart velocities are at the time 11/10 at which an orbit hits r with speed 1.

    They are those of the orbits that were this distance to its left and right at t = 0.
    """
    f, end = interval.ball(PAPER.f), interval.ball(Fraction(11, 10))
    v = 1 - end.sin() + f * end
    x = interval.ball(PAPER.r) - v * end - (1 - end.cos()) + f * end * end / 2
    early, late = (until((x + s * interval.ball(distance), v), end) for s in (1, -1))
    need((early.words, late.words) == (("hit r",), ()), "the orbits do the same")
    jump: Ball = late.state[1] - early.state[1]
    return jump


def continuous_dependence() -> Words:
    with interval.workprec(120):
        jumps = [velocity_jump(distance) for distance in SMALL]
        need(all(10 * jump > 19 for jump in jumps), "the velocities are near", j=jumps)
    return {"small": ", ".join(str(2 * float(q)) for q in SMALL)}


def uniform_inter_event_time() -> Words:
    found = accumulation()
    with interval.workprec(60):
        need(Fraction(stored(CAPTURE).claims["box"]["v"].upper) < 1, "the speeds are large")
    return {"found": found}
