"""Section 2.3: the proof of Theorem 2.5, step by step.

What it misses is that a wall can hold the mass: bounces accumulate (`cap.flow.capture`).
"""

from fractions import Fraction

from cap.audit.means.balls import between
from cap.audit.means.need import need
from cap.audit.papers.mixed_dynamics.means.orbits import before_a_stop, until
from cap.audit.steps import Words
from cap.parameters import PAPER
from cap.sets import interval
from cap.sets.interval import Ball

SMALL = Fraction(1, 100), Fraction(1, 10**4), Fraction(1, 10**6)


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
