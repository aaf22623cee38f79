"""Multipliers along a curve of periodic orbits, and what happens at points of it.

*Multipliers.*  From their elementary symmetric functions e_j over all of a cell: how many are
outside the unit circle, if none is on it (``stability``).  Or, for two: on a cell along p the
derivative of F by the others is not singular, so 1 is no multiplier; if 1 + e_1 + e_2 does not
vanish, -1 is none; and if |e_2| is not 1, a pair that is not real is not on the circle.  So none is
on it, and the number outside is the same on all of the cell: that on a cell next to it, with which
it has an orbit in common.

*Points.*  A short cell on one of the cells, at the ends of which a function has opposite signs, so
that it is 0 between them; ``outside``, if it is given, counts multipliers at both ends.

- *flip*: the product of all 1 + multiplier, 1 + e_1 + e_2 + ...: one is -1;
- *pair*: the counts differ by two, and neither 1 + e_1 + ... nor 1 - e_1 + e_2 - ... vanishes on
  the short cell, so that 1 and -1 are no multipliers there.  Those that are real, or inside or
  outside the circle, cannot change the count without one on the circle: two that are not real are
  on it for some orbit between;
- *fold*: along an unknown that is not p, dp/ds changes its sign: p has an extremum between, and
  where dp/ds = 0 the derivative of F by the other unknowns is singular, so that 1 is a multiplier.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.system.curve import Cell, Curve
from cap.checker.system.stability import outside


def counts(cells: Sequence[Cell], e: Sequence[list[Interval]]) -> list[int | None]:
    """Return how many multipliers are outside the unit circle, by cell; none is on it, or None.

    The numbers are known of some cells, and are those of cells next to them.
    """
    known = [outside(each) for each in e]
    for order in (range(1, len(e)), range(len(e) - 2, -1, -1)):
        for k in order:
            if known[k] is None and _is_steady(cells[k], e[k]):
                known[k] = known[k - order.step]
    return known


def _is_steady(cell: Cell, e: list[Interval]) -> bool:
    """Return whether on a cell along p of two multipliers none is on the circle, by the lemma."""
    along_p = cell.line.along == len(cell.error) - 1
    if not along_p or len(e) != 2 or _product(e, 1).contains_zero():
        return False
    one, size = e[1].integer(1), e[1].magnitude()
    return size.is_before(one) or one.is_before(size)


def happens(k: int, point: dict[str, Any], fine: Curve, short: Cell) -> None:
    """Prove what is claimed of one point."""
    steps = [fine.steps(short.at(s)) for s in short.line.ends]
    e = [fine.multipliers(step) for step in steps]
    counted = "outside" not in point or [outside(each) for each in e] == point["outside"]
    need(counted, f"point {k}: not so many multipliers are certain to be outside at its ends")
    kind, along = point["kind"], short.line.along
    if kind == "pair":
        need("outside" in point, f"point {k}: nothing is counted at its ends")
        before, after = point["outside"]
        need(abs(before - after) == 2, f"point {k}: the counts do not differ by two")
        over = fine.multipliers(fine.steps(short.box))
        real = any(_product(over, sign).contains_zero() for sign in (1, -1))
        need(not real, f"point {k}: a multiplier may be 1 or -1")
        return
    if kind == "fold":
        need(along < fine.size, f"point {k}: along the parameter there is no fold")
        a, b = (fine.rate(step, along) for step in steps)
    else:
        a, b = (_product(each, 1) for each in e)
    differ = (a.is_positive() and (-b).is_positive()) or ((-a).is_positive() and b.is_positive())
    need(differ, f"point {k}: the signs at its ends are not certain to differ")


def _product(e: list[Interval], sign: int) -> Interval:
    """Return the product of all 1 + sign x multiplier."""
    total = e[0].integer(1)
    for k, x in enumerate(e, 1):
        total = total + x * sign**k
    return total
