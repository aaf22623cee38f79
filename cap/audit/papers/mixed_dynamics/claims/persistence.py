"""Section 8: persistence of never-stopping orbits with inelastic walls and viscosity."""

from fractions import Fraction

from cap.audit.means.balls import between
from cap.audit.means.need import need
from cap.audit.steps import Words
from cap.flow.propagation import at_time_zero, propagate
from cap.parameters import at
from cap.sets import interval
from cap.sets.interval import Ball


def speed_bound() -> Words:
    p = at(e="1/2", mu="1")
    with interval.workprec(100):
        end = interval.ball(Fraction(1, 100))
        x, v = propagate(p, at_time_zero(Ball(0), Ball(100)), end).state
        need(0 < 1 - x < v / 1000, "the wall is not just ahead", x=x)
        at_the_wall = v - 1000 * (1 - x) / v  # it loses at most F + f + 100μ < 1000 per time
        bound = 50 * (-end).exp() + interval.ball(p.F + p.f)  # for all later times
        need(at_the_wall > bound, "the bound holds", v=at_the_wall, bound=bound)
        words = between(v, 2), between(bound, 2)
    return {"words": words[0], "words_2": words[1]}
