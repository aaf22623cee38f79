"""The theorem about two masses, the second one lighter: where a multiplier is -1, where one stops.

Let q be the second mass, z_1 > z_2 the reduced traces, m the first mass.

1. *A crossing* is an interval [a, b] of masses q with a box.  K(box) lies in its interior for all q
   in it: so there is exactly one zero z(q) of G in the box, and it is analytic in q.  The same in
   small boxes inside for q = a and q = b: they contain z(a) and z(b).
2. *flip*: for all q in [a, b] z(q) is an orbit on which no mass stops, and z_2(a) < -2 < z_2(b),
   while z_1 is in (-2, 2) at both: (z_1 + 2)(z_2 + 2), a polynomial in the entries of Phi', is
   zero for some q, where a double multiplier is -1.
3. *stop*: for all q in [a, b] the contacts of z(q) are transversal and in order, its masses apart,
   and its velocities at contacts of the signs of their flights.  At b they have these signs at all
   critical times, at a one of them has the other sign.  So for the largest q at which the least
   of these velocities, taken with these signs, is 0, the least speed of the orbit is 0.
4. *Between*: nodes from flip to stop, with a zero of G in a small box each, and for the masses of
   the cell between two nodes exactly one zero in a box that contains the small ones of both: so
   all the zeros are one analytic family.  Contacts and velocities at contacts as in 3.  A velocity
   at a critical time that is, or for some q may be, in a flight (``orbit``: a contact may pass it),
   taken with its sign, is w > 0 at the lower node, where its flight is continued if need be; along
   the family it is w + (q - node) times a value of its derivative: positive in the cell, too.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any, NamedTuple

from cap.checker.kernel.citation import NEUMAIER, cite
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many, Quantity, Word
from cap.checker.kernel.theorem import BITS
from cap.checker.particles.existence import (
    SIZE,
    Ends,
    arrivals,
    krawczyk,
    lies_in,
    needs_matrix,
    of_contacts,
)
from cap.checker.particles.family import Family, moved, with_second
from cap.checker.particles.mechanics import NORMALS, Contact, Mechanics, contacts
from cap.checker.particles.monodromy import monodromy, reduced_traces, symplectic
from cap.checker.particles.orbit import (
    admissible,
    apart,
    in_order,
    least_speeds,
    moments,
    speeds,
)
from cap.checker.particles.periodic_orbit import LEAST, MOST, listed
from cap.checker.system.masses import TwoMasses

MOST_NODES, MOST_WORK = 512, 1 << 33
POINT = listed([number] * SIZE)
ROWS = Many(Many(number, SIZE * LEAST, SIZE * MOST), SIZE * LEAST, SIZE * MOST)
CROSSING = {"lower": POINT, "upper": POINT, "preconditioner": ROWS}
Rational = list[Fraction]


def work(bits: int, contacts: int, nodes: int) -> int:
    """Return a measure of the time, with the four ends: two to four nanoseconds for each unit."""
    return (512 + bits) ** 2 * contacts**2 * (nodes + 4)


class Crossing(NamedTuple):
    """All systems of an interval with their zeros, and those of its two ends."""

    family: Family
    orbit: list[Contact]
    ends: list[tuple[Mechanics, list[Contact]]]


class ParticlesLimits(TwoMasses):
    """The second mass at which ellipticity is lost, and the one at which a mass stops."""

    # fmt: off
    HINTS = (
        BITS,
        Field("flip", CROSSING, "", "", "t, xi, v_1, v_2 of each contact at the ends of flip, and "
              "a matrix near the inverse of G'"),
        Field("stop", CROSSING, "", "", "the same of stop"),
        Field("radius", number, "", "", "of the small boxes around them, in (1/omega, R, R omega, "
              "R omega) for each contact"),
        Field("reach", number, "", "", "of the boxes of flip and stop, around the upper ends"),
        Field("middle", ROWS, "", "", "a matrix near the inverse of G' between them"),
        Field("nodes", Many({"mass": number, "centre": POINT}, 0, MOST_NODES), "", "",
              "masses between flip and stop, falling, with the contacts"),
        Field("node_radius", number, "", "", "of the small boxes around them"),
        Field("cell_reach", number, "", "", "of the boxes between two nodes, around their middle, "
              "for a cell as wide as the first mass: for others less in proportion"),
    )
    CLAIMS = (
        Field("itinerary", listed(Word(tuple(NORMALS))), "", "",
              "all contacts in (0, T), in their order"),
        Field("flip", Quantity("m"), "a multiplier is -1 at m_2 =", "m_2",
              "contains a second mass with the multiplier -1; elliptic at its upper end, not at "
              "the lower one"),
        Field("stop", Quantity("m"), "a mass stops at m_2 =", "m_2",
              "contains a second mass with the least speed 0"),
    )
    CITES = (
        cite(
            "Krawczyk",
            NEUMAIER,
            ("smooth", "the defect G of the flights is analytic in the times, free coordinates and "
             "velocities of the contacts, and in the second mass", "flip, stop"),
            ("inclusion", "K lies in the interior of its box, for all masses of flip, of stop, and "
             "of the cells between, at once", "flip, stop"),
        ),
    )
    # fmt: on

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Reject what is not the same number of contacts everywhere."""
        count = len(claims["itinerary"])
        points = [hints[name][end] for name in ("flip", "stop") for end in ("lower", "upper")]
        points += [node["centre"] for node in hints["nodes"]]
        need(all(len(point) == count for point in points), f"a hint is not a list of {count}")
        for rows in (
            *(hints[name]["preconditioner"] for name in ("flip", "stop")),
            hints["middle"],
        ):
            needs_matrix(rows, count, "a hint")
        needed = work(hints["bits"], count, len(hints["nodes"]))
        need(needed <= MOST_WORK, f"bits, contacts and nodes are too much: {needed} > {MOST_WORK}")

    def prove(self) -> None:
        """Prove the theorem."""
        m, (flip, stop) = self.p.masses, (self.claims[name] for name in ("flip", "stop"))
        need(m[0] == m[1], "the masses to begin with are not equal")
        need(stop.lower > 0 and stop.upper < flip.lower, "stop is not below flip")
        for name in ("flip", "stop"):
            self.narrow(name, self.claims[name])
        self.flip(self.crossing("flip"))
        self.stop(self.crossing("stop"))
        self.between()

    @property
    def words_of(self) -> list[str]:
        """The itinerary."""
        return list(self.claims["itinerary"])

    def around(self, centre: Sequence[Fraction], radius: Fraction) -> list[Ends]:
        """Return the box around a point, with a radius in natural units."""
        need(radius > 0, "a radius is not positive")
        units = (1 / self.omega, self.R, self.R * self.omega, self.R * self.omega)
        sizes = [radius * units[k % SIZE] for k in range(len(centre))]
        return [(c - r, c + r) for c, r in zip(centre, sizes, strict=True)]

    def zero(
        self, mass: Fraction, centre: Rational, radius: Fraction, rows: list[Rational]
    ) -> tuple[Mechanics, list[Contact]]:
        """Return the system with this second mass and its zero in a small box, proved."""
        M = Mechanics(with_second(self.p, mass), self.hints["bits"])
        K = krawczyk(M, of_contacts(M, self.words_of), self.around(centre, radius), centre, rows)
        return M, contacts(M, self.words_of, K)

    def crossing(self, name: str) -> Crossing:
        """Prove that there is one zero for each mass of an interval, and localise two of them."""
        claim, hint = self.claims[name], self.hints[name]
        lower, upper = (flat(hint[end]) for end in ("lower", "upper"))
        rows, radius = hint["preconditioner"], self.hints["radius"]
        box = self.around(upper, self.hints["reach"])
        for centre in (lower, upper):
            need(lies_in(self.around(centre, radius), box), "a small box is not in the large one")
        family = Family(self.p, (claim.lower, claim.upper), self.hints["bits"])
        K = krawczyk(family, of_contacts(family, self.words_of), box, upper, rows)
        pairs = ((claim.lower, lower), (claim.upper, upper))
        ends = [self.zero(mass, centre, radius, rows) for mass, centre in pairs]
        self.step(f"for each mass of {name} there is exactly one zero of G in the box")
        return Crossing(family, contacts(family, self.words_of, K), ends)

    def flip(self, found: Crossing) -> None:
        """Prove that a multiplier becomes -1."""
        least_speeds(found.family, found.orbit)
        self.step("for each mass of flip it is an orbit on which no mass stops")
        low = list[Interval]()
        for M, orbit in found.ends:
            D = monodromy(M, orbit)
            symplectic(M, D)
            high, z = reduced_traces(D)
            inside = (high + 2).is_positive() and (-high + 2).is_positive()
            need(inside, "the other pair may not be on the unit circle")
            low.append(z + 2)
        need((-low[0]).is_positive(), "at the lower end of flip z_2 may not be below -2")
        need(low[1].is_positive(), "at the upper end of flip z_2 may not be above -2")
        self.step("at the upper end of flip it is elliptic, at the lower end z_2 < -2 < z_1 < 2")

    def stop(self, found: Crossing) -> None:
        """Prove that the least speed becomes 0."""
        no_other_contacts(found.family, found.orbit)
        self.step("for each mass of stop the contacts are transversal, and there are no others")
        (below, zeros), (above, orbit) = found.ends
        least_speeds(above, orbit)
        inside = speeds(below, zeros, moments(below, zeros, below.critical))
        reversed_ = any((-v).is_positive() for v in inside)
        need(reversed_, "at the lower end of stop no velocity has certainly changed sign")
        self.step("at the upper end of stop no mass stops, at the lower end a velocity is reversed")

    def between(self) -> None:
        """Prove that the zeros from flip to stop are one family."""
        flip, stop, hints = self.claims["flip"], self.claims["stop"], self.hints
        inner = [(node["mass"], flat(node["centre"])) for node in hints["nodes"]]
        first = (flip.lower, flat(hints["flip"]["lower"]))
        last = (stop.upper, flat(hints["stop"]["upper"]))
        nodes = [first, *inner, last]
        small = max(hints["node_radius"], hints["radius"])
        for (upper, a), (lower, b) in pairwise(nodes):
            need(lower < upper, "the masses of the nodes do not fall")
            centre = [(x + y) / 2 for x, y in zip(a, b, strict=True)]
            box = self.around(centre, hints["cell_reach"] * (upper - lower) / self.p.masses[0])
            both = all(lies_in(self.around(c, small), box) for c in (a, b))
            need(both, "the zero at a node may not be in the box of a cell")
            radius = hints["radius"] if lower == stop.upper else hints["node_radius"]
            node = self.zero(lower, b, radius, self.rows(lower))
            self.cell((lower, upper), centre, box, node)
        self.step(f"{len(inner) + 1} cells of masses: the zeros from flip to stop are one family")
        self.step("for each mass between flip and stop it is an orbit on which no mass stops")

    def cell(
        self,
        second: Ends,
        centre: Rational,
        box: Sequence[Ends],
        node: tuple[Mechanics, list[Contact]],
    ) -> None:
        """Prove that there is one zero in the box for each second mass of an interval, an orbit on
        which no mass stops; that at the lower end is the node.
        """
        bits, family = self.hints["bits"], Family(self.p, second, self.hints["bits"])
        value = moved(self.p, second, self.words_of, [family.number(c) for c in centre], bits)
        rows = self.rows((second[0] + second[1]) / 2)
        K = krawczyk(family, of_contacts(family, self.words_of), box, centre, rows, value)
        orbit = contacts(family, self.words_of, K)
        no_other_contacts(family, orbit)
        slow = moments(family, orbit, family.may_be_critical)
        rates = family.speed_rates(orbit, family.rates(orbit, rows), slow)
        width = self.number(second[1] - second[0])
        for w, rate in zip(speeds(*node, slow), rates, strict=True):
            need(w.is_positive(), "a mass may stop at a node")
            need(
                rate.is_positive() or (w + rate * width).is_positive(), "a mass may stop in a cell"
            )

    def rows(self, mass: Fraction) -> list[Rational]:
        """Return what is quadratic in the mass: given at flip, in the middle, and at stop."""
        above, below = self.claims["flip"].lower, self.claims["stop"].upper
        t = (above - mass) / (above - below)
        first, last = (self.hints[name]["preconditioner"] for name in ("flip", "stop"))
        u, v, w = (1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)
        triples = zip(first, self.hints["middle"], last, strict=True)
        return [[u * a + v * b + w * c for a, b, c in zip(*rows, strict=True)] for rows in triples]

    def words(self) -> str:
        """Return the theorem in one line."""
        return self.told(_LIMITS, m=self.p.masses, contacts=", ".join(self.words_of))


def flat(point: Sequence[Rational]) -> Rational:
    """Return the unknowns of all contacts."""
    return [c for contact in point for c in contact]


def no_other_contacts(M: Mechanics, orbit: Sequence[Contact]) -> None:
    """Prove that the contacts are transversal, and the only ones if no mass stops between them."""
    in_order(M, orbit)
    for contact, end in zip(orbit, arrivals(orbit, M), strict=True):
        flight = M.flight(contact)
        admissible(M, contact, flight)
        kept = all((v * s).is_positive() for v, s in zip(end.v, flight.signs, strict=True))
        need(kept, "a velocity may have another sign at the end of a flight")
        apart(M, contact, end)


_LIMITS = (
    "m_i x_i'' = F cos(omega t) - f sgn x_i', i = 1, 2, with m_1 = {m[0]}, F = {F}, omega = "
    "{omega}, f = {f}, {l} <= x_1 <= x_2 <= {r}, elastic walls and elastic collisions, and the "
    "contacts {contacts} in a period T = 2 pi/omega: for each m_2 in {flip} there is exactly one "
    "T-periodic orbit on which no mass stops with these contacts in a box, at the upper end it is "
    "elliptic and at the lower end not, and for some m_2 in between one multiplier is -1; for each "
    "m_2 in {stop} the equations of the flights between these contacts have exactly one solution "
    "in a box, an orbit on which no mass stops at the upper end, and for some m_2 in between the "
    "least speed of the orbit is 0; for each m_2 between the two intervals the equations have a "
    "solution, alone in a box of its own, an orbit on which no mass stops, and these join those of "
    "the two intervals to one family that is analytic in m_2; nothing is claimed of m_2 from the "
    "first interval up to {m[0]}, nor of the multipliers of the orbits for m_2 below that interval"
)

THEOREM = ParticlesLimits
