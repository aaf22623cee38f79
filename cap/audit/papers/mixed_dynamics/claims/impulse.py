"""Section 7: the proof of Proposition 7.3 above the impulse bound."""

from fractions import Fraction

from cap.audit.means.balls import between, precisely
from cap.audit.means.need import need
from cap.audit.papers.mixed_dynamics.means.equation import Equation
from cap.audit.papers.mixed_dynamics.means.orbits import States
from cap.audit.steps import Words
from cap.parameters import at
from cap.sets import interval

ABOVE = Equation(Fraction(13, 20), Fraction(2))  # f = 0.65 > 2/π at the paper's F, ω, R


def exclusion_by_the_proposition() -> Words:
    with precisely():
        need(interval.ball(ABOVE.alpha) > 2 / interval.pi(), "f is below the impulse bound")
        words = " and ".join(between(theta, 5) for theta in ABOVE.both())
    return {"words": words}


def path_length() -> Words:
    wide = at(l="-1000", r="1000", f="13/20")
    orbits = States("-900", "20").follow(1, wide)
    need(orbits.words == (), "it hits a wall", words=orbits.words)
    with interval.workprec(100):
        way = orbits.state[0] + 900
        need(way < 2 * 2000, "the path is as long as stated")
    return {"words": way}
