"""Theorem (contacts_family).  Let a system be given as data (`cap.system.model`), with a clock of
rational frequency, and contacts at quarters of a period of the clock, with a guess of the states
just before them.  If the lemmas below succeed, then for every c in an explicit interval

 (i)   the system has a periodic orbit with these contacts at these times, whose states there are
       linear in c, with explicit rational coefficients;
 (ii)  nothing else happens on it: between its contacts all guards of its mode are positive, each
       guard that comes to zero falls through it, and after it no other mode is open;
 (iii) one of its multipliers is 1, and the product of all lies in an explicit interval.

Proof.  `cap.orbits.family` (i), by exact algebra: flights are sums of cos and sin whose angles are
quarters of turns.  The interval is cut into parts; `cap.orbits.quiet` and `cap.orbits.choice` (ii)
for all orbits of a part at once, `cap.orbits.equations` (iii).
"""

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from cap.errors import NotProved
from cap.maps.zero import Box
from cap.orbits.cells import wider
from cap.orbits.choice import without_choice
from cap.orbits.equations import Equations, derivative
from cap.orbits.family import Family, family, quarters
from cap.orbits.itinerary import Itinerary
from cap.orbits.periodic import Prover, symmetric
from cap.proofs import contacts
from cap.proofs.certified import assembled
from cap.proofs.contacts import Cuts
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.interval import exact_decimal as _decimal

BITS, PLACES, SHOWN = 96, 9, 4  # decimals of c, and of the product
FIRST, GROWTH = 1 / 100, 1.5  # of the size of c: a first part; how parts grow
SHORT, MOST = 1e-6, 200  # of the size of c: the shortest part; parts to one side
CLEAR = 1 / 50  # the largest radius of the product on a part

Tell = Callable[[str, float | None], None]


class Part(NamedTuple):
    """An interval of c, for all of which nothing else happens; the product of the multipliers."""

    ends: tuple[Fraction, Fraction]
    legs: Cuts
    product: Ball


def prove(
    itinerary: Itinerary, guess: Sequence[float], tell: Tell = lambda _words, _part: None
) -> dict[str, Any]:
    """Return a certificate of the family through an orbit near a guess."""
    parameters, n = contacts.as_parameters(itinerary.system), len(itinerary.system.state)
    if itinerary.system.autonomous:
        raise NotProved("family", "the system has no clock: an orbit may be moved in time")
    found = family(itinerary, quarters(itinerary, guess[:: n + 1]))
    free = next(i for i, z in enumerate(found.states[0]) if z[1])
    with interval.workprec(BITS):
        parts = Parts(found, tell).around(Fraction(f"{guess[1 + free]:.6g}"))
        hints = {
            "bits": str(BITS),
            "frequencies": [str(nu) for nu in found.frequencies],
            "parts": [_decimal(part.ends[0]) for part in parts[1:]],
            "cuts": [],
        }
        content = claims(found, parts), hints
        certificate = assembled("contacts_family", parameters, PLACES, content, BITS)
        tell("checking", None)
        cuts, count = [leg for part in parts for leg in part.legs], len(itinerary.contacts)
        return contacts.checked(certificate, cuts, contacts.grouped(count))


def claims(found: Family, parts: Sequence[Part]) -> dict[str, Any]:
    """Return what is claimed of a family."""
    bounds = [interval.outward(wider(part.product), SHOWN) for part in parts]
    low, high = min(Fraction(a) for a, _ in bounds), max(Fraction(b) for _, b in bounds)
    return {
        "contacts": [contact._asdict() for contact in found.itinerary.contacts],
        "periods": str(found.itinerary.periods),
        "quarters": [str(j) for j in found.quarters],
        "states": [[[str(a), str(b)] for a, b in q] for q in found.states],
        "range": [_decimal(parts[0].ends[0]), _decimal(parts[-1].ends[1])],
        "product": [_decimal(low), _decimal(high)],
    }


class Parts:
    """Finds parts of the interval of c, from one c on."""

    def __init__(self, found: Family, tell: Tell) -> None:
        self.family, self.tell = found, tell
        self.prover = Prover(Equations(found.itinerary), pieces=True)

    def around(self, c: Fraction) -> list[Part]:
        """Return parts around c, in order, to where the shortest one is not proved."""
        below, above = (self._from(c, side) for side in (-1, 1))
        found = [*reversed(below), *above]
        if not found:
            self.part((c - Fraction(SHORT), c))  # raises `NotProved` with the reason
        return found

    def _from(self, c: Fraction, side: int) -> list[Part]:
        """Return parts to one side of c."""
        found, size = list[Part](), 1 + abs(float(c))
        long = FIRST * size
        while len(found) < MOST and long > SHORT * size:
            self.tell("following the family", None)
            end = round(c + side * Fraction(long), PLACES)
            try:
                found.append(self.part((min(c, end), max(c, end))))
            except NotProved:
                long /= 2
                continue
            c, long = end, long * GROWTH
        return found

    def part(self, ends: tuple[Fraction, Fraction]) -> Part:
        """Prove that nothing else happens on the orbits of a part; raise `NotProved`."""
        box, prover = self.box(ends), self.prover
        reasons = prover.reasons(box)
        without_choice(prover, box)
        D = derivative(prover.equations.blocks(box, prover.balls))
        product = symmetric(D, autonomous=False)[-1]
        if not product.rad() < CLEAR:
            raise NotProved("family", "the product of the multipliers is not clear on a part")
        return Part(ends, contacts.legs(prover, box, reasons), product)

    def box(self, ends: tuple[Fraction, Fraction]) -> Box:
        """Return the times and states of all orbits of a part."""
        quarter, found = self.prover.balls.period / 4, list[Ball]()
        low, high = (self.family.at(c) for c in ends)
        for j, p, q in zip(self.family.quarters, low, high, strict=True):
            found.append(quarter * j)
            found += [
                interval.hull(interval.ball(x), interval.ball(y)) for x, y in zip(p, q, strict=True)
            ]
        return tuple(found)
