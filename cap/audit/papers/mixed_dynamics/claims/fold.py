"""Section 4.3: the 'saddle-center' of the roots, Theorem 4.8, against the one that orbits have."""

from fractions import Fraction

from cap.audit.means.balls import between, pair, precisely
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.steps import Words
from cap.one_one.closed_form import symmetric
from cap.sets import interval
from cap.sets.interval import Ball

NEAR = Fraction(63, 100)  # f near 2F/π


def saddle_center_of_orbits() -> Words:
    with precisely():
        found = []
        for sign in (1, -1):
            orbit = symmetric(interval.ball(NEAR), Ball(2), sign)
            need(orbit.least_speed() > 0, "the orbit may stop")
            found.append(orbit.trace())
        need(-2 < found[0] < 2 < found[1], "the types are others")
        words = [between(trace, 5) for trace in found]
    claimed = stored("symmetric.json").claims["saddle_center"]
    return {"claimed": pair(claimed), "words": words[0], "words_2": words[1]}
