"""Existence of the elliptic orbit from hints: by contacts from the model, and by the special flow.

    python benchmarks/existence.py [ROUNDS]

Both prove that one orbit lies within 1e-9 of the hints, that nothing else happens, and enclose the
trace and the rotation number over that box; the least of many short rounds, by turns, in one run.
"peer" is `cap.maps.fixed_point.existence`.
"""

import sys
from fractions import Fraction

from bench_elliptic import TIMES, Hints
from ratios import ratio

from cap.orbits.equations import Equations, derivative
from cap.orbits.itinerary import Contact, Itinerary
from cap.orbits.periodic import Prover
from cap.parameters import PAPER
from cap.sets import interval
from cap.system.friction import oscillator

HITS = [Contact("right", "wall", "left"), Contact("left", "wall", "right")]
GUESS = [TIMES[0], 1.0, 0.9931, TIMES[1], -1.0, -1.28298]
REACH = (Fraction(1, 10**9),) * len(GUESS)


class Contacts:
    """The hints of the proof by contacts."""

    def __init__(self):
        self.prover = Prover(Equations(Itinerary(oscillator(PAPER), HITS)))
        with interval.workprec(240):
            self.hint = self.prover.prove(GUESS, 25).hint

    def existence(self):
        """Return the trace and the rotation number."""
        _, blocks, _ = self.prover.existence(self.hint, REACH)
        trace = derivative(blocks).trace()
        return trace, (trace / 2).acos() / (2 * interval.pi())


if __name__ == "__main__":
    for bits in (53, 200):
        with interval.workprec(bits):
            ours, special = Contacts(), Hints()
            print(ours.existence(), special.existence()[1])
            times = ratio(ours.existence, special.existence, int([*sys.argv, "300"][1]))
            print(f"{bits:4} bits   {times}")
