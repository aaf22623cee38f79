"""Sections 10.1 and A.1: the closed form of a flight, events, and what a scan may miss."""

from fractions import Fraction

from cap.audit.means.balls import below
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.steps import Words
from cap.parameters import PAPER
from cap.sets import interval

CELLS = 256  # of the time from the start of a flight to the next minimum of sin ωt
DOUBLE = Fraction(1, 2**53)  # the relative error of one operation on doubles


def error_of_the_integrator() -> Words:
    outer = max(stored("saddle.json").claims["multipliers"], key=lambda each: abs(each.upper))
    growth = abs(outer.lower)
    need(growth > 2, "errors do not grow much at the saddle", growth=float(growth))
    error, periods = DOUBLE, 0
    while error < Fraction(1, 10):
        error, periods = error * growth, periods + 1
    return {"outer": below(outer, 3), "periods": periods}


def an_event_within_a_period() -> None:
    with interval.workprec(80):
        pi, f, R = interval.pi(), interval.ball(PAPER.f), interval.ball(PAPER.R)
        step = 2 * pi / CELLS
        for k in range(CELLS):
            delta = interval.hull(k * step, (k + 1) * step)
            most = interval.lower(1 + f * delta), interval.lower(2 * pi * f + delta.cos())
            way = [2 * pi * (each - pi * f) for each in most]  # m > each of the two
            need(any(each > R for each in way), "a flight may last a period", at=float(delta.mid()))
        need(2 * pi * (10 - 1 - pi * f) > 48, "the way is shorter")  # m >= 10 - 1, v > 0
