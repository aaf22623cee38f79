"""Appendix, A.4 and A.5: the symmetry and the half-period map, chatter and grazing."""

from fractions import Fraction

from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.papers.mixed_dynamics.means.orbits import until
from cap.audit.steps import Words
from cap.flow.propagation import after_periods
from cap.parameters import PAPER
from cap.sets import interval
from cap.sets.interval import Box

BITS = 100


def _elliptic() -> Box:
    """Return a box around P*, whose orbit never stops."""
    claims = stored("elliptic.json").claims
    need(claims["least_speed"].lower > 0, "the orbit may stop")
    x, v = (interval.hull(interval.ball(e.lower), interval.ball(e.upper))
            for e in (claims["x"], claims["v"]))  # fmt: skip
    return x, v


def _half(state: Box) -> Box:
    """Return the states after half a period from the time 0."""
    return until(state, interval.pi()).state


def _mirrored(state: Box) -> Box:
    return -state[0], -state[1]


def square_of_sigma() -> Words:
    with interval.workprec(BITS):
        start = _elliptic()
        whole = after_periods(PAPER, *start, 1).state
        stated, true = start, start
        for _ in range(2):
            stated = _half(_mirrored(stated))
            true = _mirrored(_half(true))
        gap = abs(stated[0] - whole[0])
        need(gap > interval.ball(Fraction(1, 1000)), "they agree", gap=gap)
        need(all((a - b).contains(0) for a, b in zip(true, whole, strict=True)), "they differ")
    return {"words": gap}


def step_of_the_proof() -> Words:
    with interval.workprec(BITS):
        start = _elliptic()
        claimed = _mirrored(_half(start))  # its value at t = 0
        gap = abs(claimed[0] + start[0])
        need(gap > interval.ball(Fraction(1, 1000)), "they agree", gap=gap)
    return {"words": gap}
