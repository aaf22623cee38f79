"""Sinks that turn: ellipses around states of a cycle that the flow contracts.

See `cap.checker.attracting.sinks` for what is shown, in doubles, as by the checker: the ellipses
are the largest of some for which it succeeds.  They are discs where the derivative is a rotation
and a contraction, or diagonal.
"""

import math
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import numpy as np

from cap.areas.folded.missing import Floats
from cap.checker.attracting.sinks import MOST_HALVES, MOST_SINKS, sink
from cap.checker.folded.motion import Direction
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems.mixed import Mixed
from cap.floats.candidates import Turning, turning
from cap.parameters import Parameters
from cap.sets import interval

LARGEST, SIZES = 1 / 8, 20  # of R and R omega; how often it is made smaller
SMALLER = 1 / math.sqrt(2)
TIMES = (1, 2, 4)  # the period of the cycle
DIGITS = 6  # of the centre, and of the matrix


def contracted(p: Parameters, theorem: Mixed) -> list[dict[str, Any]]:
    """Return the ellipses found for which the proof succeeds."""
    found = (largest(p, theorem, each) for each in turning(p)[:MOST_SINKS])
    return [claim for claim in found if claim]


def largest(p: Parameters, theorem: Mixed, cycle: Turning) -> dict[str, Any] | None:
    """Return the largest ellipse around a state that is contracted, if there is one."""
    y = Direction(theorem.p, forwards=True)
    for claim in around(p, cycle):
        try:
            sink(theorem.scale, read(claim)).contract(y)
        except Rejected:
            continue
        return claim
    return None


def around(p: Parameters, cycle: Turning) -> Iterator[dict[str, Any]]:
    """Give ellipses around a state, the largest first."""
    unit = np.array([float(p.R), float(p.R * p.omega)])
    sides = along(np.array(cycle.monodromy) / unit[:, None] * unit)
    for n in range(SIZES):
        matrix = np.linalg.inv(sides * LARGEST * SMALLER**n) / unit
        for times in TIMES:
            halves = 2 * cycle.periods * times
            if halves <= MOST_HALVES:
                yield {
                    "x": written(cycle.x),
                    "v": written(cycle.v),
                    "matrix": [[written(a) for a in row] for row in matrix.tolist()],
                    "halves": str(halves),
                }


def along(monodromy: Floats) -> Floats:
    """Return eigenvectors of a real matrix as columns, or their real and imaginary parts."""
    values, vectors = np.linalg.eig(monodromy)
    if values.imag.any():  # of the same size, or it is no rotation in these coordinates
        return np.stack([vectors[:, 0].real, vectors[:, 0].imag], axis=1) * math.sqrt(2)
    return np.asarray(vectors, np.float64)


def written(x: float) -> str:
    """Return a decimal with few digits."""
    places = max(0, DIGITS - interval.decade(abs(Fraction(x)) or Fraction(1)))
    return interval.decimal(round(Fraction(x), places), places)


def read(claim: dict[str, Any]) -> dict[str, Any]:
    """Return what the checker reads."""
    matrix = [[Fraction(a) for a in row] for row in claim["matrix"]]
    x, v = Fraction(claim["x"]), Fraction(claim["v"])
    return {"x": x, "v": v, "matrix": matrix, "halves": int(claim["halves"])}
