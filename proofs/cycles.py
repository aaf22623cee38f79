"""Cycles of releases that attract: intervals around them that the release map contracts.

See `cap.checker.attracting.cycles` for what is shown, in doubles, as by the checker: the intervals
are the largest of some for which it succeeds.
"""

import math
from collections.abc import Iterator
from fractions import Fraction

from cap.certificate.writer import Pair
from cap.checker.attracting.cycles import contract
from cap.checker.folded.motion import Releases
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.shapes import Enclosure
from cap.checker.theorems.mixed import Mixed
from cap.floats.candidates import Release, releasing_again
from cap.parameters import Parameters
from cap.sets import interval

LARGEST, SIZES = Fraction(1, 20), 24  # of R, and how often it is halved
FLAT = 1e-3  # where the derivative is less, images may be so much of an interval
DIGITS = 12  # of the ends, compared with R

Intervals = list[Enclosure]


def contracted(p: Parameters, theorem: Mixed) -> list[list[Pair]]:
    """Return the cycles of intervals found for which the proof succeeds, apart from ``kept``."""
    found = list[list[Pair]]()
    taken = theorem.kept()
    for cycle in releasing_again(p):
        if intervals := largest(p, theorem, cycle):
            inner = [theorem.scale.distances(each).inner for each in intervals]
            if all(b < c or d < a for a, b in inner for c, d in taken):
                taken += inner
                found.append([list(each.text) for each in intervals])
    return found


def largest(p: Parameters, theorem: Mixed, cycle: list[Release]) -> Intervals:
    """Return the largest intervals around a cycle found that are contracted, if there are any."""
    y, basins = Releases(theorem.p), theorem.basins()
    for n in range(SIZES):
        intervals = list(around(p, cycle, p.R * LARGEST / 2**n))
        try:
            contract(y, basins, [theorem.scale.distances(each) for each in intervals])
        except Rejected:
            continue
        return intervals
    return []


def around(p: Parameters, cycle: list[Release], size: Fraction) -> Iterator[Enclosure]:
    """Give intervals around a cycle: the first of half this length, each longer than its image."""
    places = max(0, DIGITS - interval.decade(LARGEST * p.R))
    slopes = [max(abs(release.slope), FLAT) for release in cycle]
    more = math.prod(slopes) ** (-0.5 / len(cycle))  # the last image is in the first
    for release, slope in zip(cycle, slopes, strict=True):
        ends = (Fraction(release.x) + side * size for side in (-1, 1))
        text = tuple(interval.decimal(round(end, places), places) for end in ends)
        yield Enclosure(Fraction(text[0]), Fraction(text[1]), (text[0], text[1]))
        size *= Fraction(slope * more)
