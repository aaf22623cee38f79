"""Parameters, with a number of hits, at which the float search is tested."""

from dataclasses import replace
from fractions import Fraction

from cap.parameters import PAPER, Parameters

FRICTIONS = [Fraction(3, 10), Fraction(2, 5), Fraction(9, 20), Fraction(1, 2), Fraction(3, 5)]
SHIFTED = Parameters(Fraction(2), Fraction(3), Fraction(4, 5), Fraction(-7), Fraction(-59, 9))
CASES = [
    *((replace(PAPER, f=f), 2) for f in FRICTIONS),
    (SHIFTED, 2),
    (replace(PAPER, f=Fraction(1, 1000)), 6),
    (Parameters(Fraction(1), Fraction(1), Fraction(0), Fraction(0), Fraction(4)), 4),
]
