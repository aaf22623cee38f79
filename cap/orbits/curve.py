"""Curves of periodic orbits: the equations of an orbit with a parameter p that is unknown, too.

The system has p as its last variable, which nothing moves (`cap.system.moving`).  The unknowns w
are the times and states just before the contacts, without p, and at the end p: one more than there
are equations, F(w) = 0.
"""

from collections.abc import Sequence
from typing import Any

from cap.orbits.equations import Block, Equations, Unknowns
from cap.orbits.itinerary import Itinerary
from cap.orbits.leg import Kinds
from cap.orbits.numbers import Numbers


class Curve:
    """F and F' of the orbits with an itinerary, in w."""

    def __init__(self, itinerary: Itinerary, kinds: Kinds | None = None) -> None:
        self.equations = Equations(itinerary, kinds)
        self.step = self.equations.n  # time and state of a contact, without p
        self.size = self.step * len(itinerary.contacts)  # equations; p is the unknown after these
        self.places = self.equations.places_of(self.step)

    def expanded(self, w: Unknowns) -> list[Any]:
        """Return the unknowns of the system in which p is a variable."""
        found: list[Any] = []
        for k in range(0, self.size, self.step):
            found += [*w[k : k + self.step], w[self.size]]
        return found

    def value(self, w: Unknowns, of: Numbers) -> list[Any]:
        """Return F(w)."""
        return self._shortened(self.equations.value(self.expanded(w), of))

    def blocks(self, w: Unknowns, of: Numbers) -> list[Block]:
        """Return the derivatives of each leg, those by p, too."""
        return self.equations.blocks(self.expanded(w), of)

    def both(self, w: Unknowns, of: Numbers) -> tuple[list[Any], list[Block]]:
        """Return F(w), and the derivatives of each leg."""
        value, blocks = self.equations.both(self.expanded(w), of)
        return self._shortened(value), blocks

    def rows(self, blocks: Sequence[Block]) -> list[list[Any]]:
        """Return F' by rows."""
        n, found = self.step, list[list[Any]]()
        for (guard, rows), (here, there, _) in zip(blocks, self.places, strict=True):
            fixed = self.equations.autonomous and not here  # the first contact is at the time 0
            found.append(self._row(here, guard[:n], guard[n]))
            for i, (*by, by_p, by_next) in enumerate(rows[:-1]):
                row = self._row(here, [0, *by[1:]] if fixed else by, by_p)
                row[there] = row[there] + by_next
                row[there + 1 + i] = row[there + 1 + i] - 1
                found.append(row)
        return found

    def _row(self, here: int, by: Sequence[Any], by_p: Any) -> list[Any]:
        """Return a row with the derivatives by the unknowns of a contact, and by p."""
        row: list[Any] = [0] * (self.size + 1)
        row[here : here + self.step] = by
        row[self.size] = by_p
        return row

    def of_round(self, blocks: Sequence[Block]) -> list[Block]:
        """Return the derivatives of each leg at one p."""
        n = self.step
        return [
            Block(guard[:n], [[*row[:n], row[-1]] for row in rows[:-1]]) for guard, rows in blocks
        ]

    def _shortened(self, entries: Sequence[Any]) -> list[Any]:
        """Return what is not of p; of each contact it is the last."""
        width = self.step + 1
        return [x for k, x in enumerate(entries) if (k + 1) % width]
