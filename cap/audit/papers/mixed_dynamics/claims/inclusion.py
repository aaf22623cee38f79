"""Section 2.1: what a solution is.  (F1) to (F3) let pass more than they should."""

from fractions import Fraction

from cap.audit.means.balls import pair
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.steps import Words
from cap.sets import interval


def rest_at_a_wall() -> Words:
    found = stored("capture.json").claims
    release = found["release_time"]
    with interval.workprec(60):
        force = -interval.ball(Fraction(2)).cos()
        need(force > interval.ball(Fraction(2, 5)), "no force pulls from the wall at t = 2")
    box = found["box"]
    return {"x": box["x"], "v": box["v"], "release": pair(release, 6)}
