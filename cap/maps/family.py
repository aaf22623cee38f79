"""Fixed points of Φ over rectangles of parameters: existence and uniqueness for all at once.

If Krawczyk's operator for a point m of the box Z,

    K = m - C (Φ(m, p) - m) + (1 - C (Φ'(Z, p) - 1)) (Z - m),

lies in the interior of Z for all parameters p of a rectangle, then for each p exactly one fixed
point lies in Z, and it lies in K.  C then is regular and so is Φ' - 1 everywhere: the fixed point
is as smooth a function of p as Φ is, by the implicit function theorem.  Φ(m, p) is a Taylor model
in p, so K is hardly larger than what the fixed points fill.
"""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from cap.errors import NotProved
from cap.flow.event import TAYLOR_MODELS
from cap.flow.model import Constants
from cap.flow.strobe import Orbit, of_constants
from cap.flow.windows import Itinerary, find_windows
from cap.maps.krawczyk import Preconditioner, operator
from cap.sets import interval
from cap.sets.interval import Box
from cap.sets.taylor_model import Domain, TaylorModel

Pair = tuple[Fraction, Fraction]
ORDER = 2
REACHES = tuple(Fraction(n, 4) for n in (12, 8, 6, 5))  # in times of the defect


@dataclass(frozen=True)
class Cell:
    """For each p of the ``rectangle`` one fixed point lies in the box m ± ``reach``.

    It lies in ``image``; m is the centre of ``hint``.  All orbits from the box have the events of
    ``expected``, in its windows; ``orbit`` encloses them.
    """

    rectangle: tuple[Pair, Pair]
    hint: Preconditioner
    reach: Pair
    image: Box
    expected: Itinerary
    orbit: Orbit[TaylorModel]


class Problem:
    """Φ for all parameters of a rectangle.

    ``constants`` maps Taylor models of the two parameters to those of the model; ``events`` are
    expected, with windows near.  None of the hints needs trust.
    """

    def __init__(
        self,
        constants: Callable[[Any, Any], Constants[Any]],
        rectangle: tuple[Pair, Pair],
        hint: Preconditioner,
        events: Itinerary,
    ) -> None:
        self.constants, self.rectangle = constants, rectangle
        self.hint, self.events = hint, events

    def _orbit(self, reach: Pair) -> tuple[Itinerary, Orbit[TaylorModel]]:
        """Prove the events of all orbits from m ± ``reach``."""
        halves = [interval.ball((b - a) / 2) for a, b in self.rectangle]
        middle = [interval.ball((a + b) / 2) for a, b in self.rectangle]
        domain = Domain([*map(interval.ball, reach), *halves], ORDER)
        x, v, p, q = domain.variables([*self.hint.point, *middle])
        osc = of_constants(self.constants(p, q))
        return find_windows(osc, (x, v), self.events, TAYLOR_MODELS)

    def prove(self) -> Cell:
        """Prove that one fixed point lies in a box, for all parameters.

        Of the boxes tried the largest is taken that succeeds: so neighbouring cells overlap.
        Raises `NotProved` if none does.
        """
        _, orbit = self._orbit((Fraction(0), Fraction(0)))
        m, bound = self.hint.point, TAYLOR_MODELS.bound
        still = operator(self.hint, orbit.end, orbit.monodromy, m, bound)  # m - C (Φ(m) - m)
        for times in REACHES:
            reach = _times(times, m, still)
            try:
                cell = self._over(reach, orbit.end)
            except NotProved:
                continue
            if self.hint.contains(cell.image, reach):
                return cell
        raise NotProved("family", "no box is mapped into itself by Krawczyk's operator")

    def _over(self, reach: Pair, image: tuple[TaylorModel, TaylorModel]) -> Cell:
        """Return the cell with this reach, whose ``image`` is K; nothing is proved of it yet."""
        expected, orbit = self._orbit(reach)
        box = self.hint.box(reach)
        K = operator(self.hint, image, orbit.monodromy, box, TAYLOR_MODELS.bound)
        return Cell(self.rectangle, self.hint, reach, K, expected, orbit)


def _times(factor: Fraction, centre: Box, box: Box) -> Pair:
    """Return decimal half-widths ``factor`` times those of a box around m, or somewhat more."""
    x, v = (
        factor * max(*map(abs, interval.ends(side - m)))
        for side, m in zip(box, centre, strict=True)
    )
    return _rounded(x), _rounded(v)


def _rounded(size: Fraction) -> Fraction:
    places = max(3, 3 - interval.decade(size)) if size else 12
    return Fraction(size * 10**places // 1 + 1, 10**places)


def agree(one: Cell, other: Cell, part: Fraction = Fraction(1)) -> None:
    """Prove that the fixed points of two cells are the same for common parameters.

    That of one cell lies in its image; where this lies in the other's box, it is the only one.
    With a ``part`` of the box below 1 a looser arithmetic can follow.
    """
    if not (_lies_in(one, other, part) or _lies_in(other, one, part)):
        raise NotProved("family", "the fixed points of two cells may differ")


def _lies_in(one: Cell, other: Cell, part: Fraction) -> bool:
    """Return whether the image of one cell is certain to lie in this part of the other's box."""
    x, v = other.reach
    return other.hint.contains(one.image, (part * x, part * v))
