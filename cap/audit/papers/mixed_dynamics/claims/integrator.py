"""Sections 10.1 and A.1: the closed form of a flight, events, and what a scan may miss."""

from cap.audit.means.need import need
from cap.parameters import PAPER
from cap.sets import interval

CELLS = 256  # of the time from the start of a flight to the next minimum of sin ωt


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
