"""The theorem about a periodic orbit of the system that the certificate holds, by its contacts.

The parameters are the system: modes with linear fields, guards that are positive in their modes,
resets (``given``).  A *contact* is a guard of the mode that comes to zero, L h < 0.  For an orbit
between contacts nothing else is assumed than the equations of its mode.

1. *Existence.*  K(box) lies in the interior of the box of the times and states just before the
   contacts: F has exactly one zero there (``contacts``).
   This lies in K(box).
2. *Nothing else happens.*  On each leg, all guards of the mode are positive between the contacts,
   and L h < 0 where the next one comes to zero (``quiet``: Lemma B for guards with cuts, M for the
   others); a guard that vanishes at the start of a leg does so by an identity of polynomials.  So
   the zero of F is a periodic orbit.
3. *Claims.*  Times and states of the contacts, the elementary symmetric functions of the
   multipliers, and from these how many multipliers lie outside the unit circle (``stability``).
   An orbit without any attracts: near it motions have the same contacts, as all other modes that a
   guard names are ``closed``.
4. *Basin.*  Motions that come to the first contact in an ellipsoid around the orbit have its
   contacts, and come nearer in each round (``ellipsoid``): 2 holds for all whose contacts are in
   boxes around the orbit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any, ClassVar

from cap.checker.kernel.citation import NEUMAIER, Citation, cite
from cap.checker.kernel.integers import Integer
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.named import Named, name
from cap.checker.kernel.optional import Maybe
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many, Quantity, Table, Whole, Word, region
from cap.checker.kernel.theorem import BITS
from cap.checker.system import ellipsoid
from cap.checker.system.conserved import product_of_two
from cap.checker.system.contacts import (
    Ends,
    Equations,
    Matrix,
    Round,
    krawczyk,
    leg_maps,
    return_map,
    symmetric,
)
from cap.checker.system.given import GUARDS, STATES, told
from cap.checker.system.legs import Leg
from cap.checker.system.own import OwnSystem
from cap.checker.system.passage import Contact, Step
from cap.checker.system.quiet import (
    ends_positive,
    falls,
    stays_positive,
    vanishing,
    watched,
)
from cap.checker.system.stability import kind_of_two, outside

CONTACTS, CUTS, PERIODS = 64, 1000, 1000
MOST_BITS, WORK = 1024, 1 << 23  # of bits x variables x pieces
UNKNOWNS = CONTACTS * (STATES + 1)

Cuts = Mapping[str, Sequence[Fraction]]


# fmt: off
ORBIT_HINTS: Table = (
    BITS,
    Field("centre", Many(Many(number, 2, STATES + 1), 1, CONTACTS), "", "m",
          "time and state near those of each contact, in the box"),
    Field("preconditioner", Many(Many(Integer(40), 2, UNKNOWNS), 2, UNKNOWNS), "", "C",
          "near F'(m)^-1, in units 2^-48"),
    Field("cuts", Many(Named(Many(number, 0, CUTS), GUARDS), 1, CONTACTS), "", "",
          "for the leg after each contact, by guard of its mode, the cuts of Lemma B"),
)
ORBIT: Table = (
    Field("contacts", Many({"mode": name, "guard": name, "to": name}, 1, CONTACTS), "", "",
          "the guards that come to zero in one round, in order, and the modes that follow"),
    Field("periods", Whole(1, PERIODS), "", "p", "the periods of the clock in one round"),
    Field("box", Many(Many(region, 2, STATES + 1), 1, CONTACTS), "", "",
          "of the times and states just before the contacts: a set that contains exactly one "
          "zero of F"),
    Field("times", Many(Quantity(), 1, CONTACTS), "time", "t_k", "of the contacts"),
    Field("states", Many(Many(Quantity(), 1, STATES), 1, CONTACTS), "state", "q_k",
          "just before the contacts"),
    Field("symmetric", Many(Quantity(), 1, STATES), "multipliers", "e_j",
          "elementary symmetric functions of the multipliers: their sum, ..., their product"),
)
KRAWCZYK = cite("Krawczyk", NEUMAIER,
     ("smooth", "F is real analytic on the box: guards are polynomials, resets rational "
      "functions, flights exponentials", "box"),
     ("inclusion", "K(box) lies in the interior of the box", "box"))
# fmt: on


class Contacts(OwnSystem):
    """A periodic orbit with these contacts."""

    # fmt: off
    HINTS: ClassVar[Table] = (
        *ORBIT_HINTS,
        Field("reach", Maybe(Many(Many(number, 2, STATES + 1), 1, CONTACTS)), "", "r",
              "how far from those of the orbit time and state at each contact may be in the basin"),
    )
    CLAIMS: ClassVar[Table] = (
        *ORBIT,
        Field("unstable", Maybe(Whole(0, STATES)), "", "",
              "how many multipliers lie outside the circle of this radius; none lies on it"),
        Field("radius", Maybe(number), "", "r", "of this circle around 0, if it is not 1"),
        Field("kind", Maybe(Word(("elliptic",))), "", "",
              "two multipliers on the unit circle, not real: their product is 1 by an identity"),
        Field("basin",
              Maybe({"matrix": Many(Many(number, 1, STATES + 1), 1, STATES + 1),
                     "contraction": number}), "", "",
              "W, by rows, and kappa < 1: with z = (t, q) before the first contact (without a "
              "clock: q) and z* that of the orbit, |W (z - z*)| becomes at most kappa times "
              "that in a round, if it was at most 1"),
    )
    CITES: ClassVar[tuple[Citation, ...]] = (KRAWCZYK,)
    # fmt: on
    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Reject what is not the same number of contacts everywhere, and too much work."""
        need(hints["bits"] <= MOST_BITS, f"more than {MOST_BITS} bits")
        count, size = len(claims["contacts"]), len(hints["preconditioner"])
        for where, table in (("hints", hints), ("claims", claims)):
            for key in ("centre", "cuts", "reach", "box", "times", "states"):
                listed = key not in table or len(table[key]) == count
                need(listed, f"{where}.{key} is not a list of {count}")
        need(("reach" in hints) == ("basin" in claims), "hints.reach is not that of a basin")
        unknowns = [len(row) for row in (*hints["centre"], *hints.get("reach", ()), *claims["box"])]
        square = all(len(row) == size for row in hints["preconditioner"])
        need(square and len({*unknowns}) == 1, "the unknowns are not as many everywhere")
        rows = count * unknowns[0]
        need(size == rows, f"hints.preconditioner has not {rows} rows")
        pieces = sum(len(cuts) + 1 for leg in hints["cuts"] for cuts in leg.values())
        work = hints["bits"] * (unknowns[0] + 2) * pieces
        need(work <= WORK, "bits x variables x pieces of legs are more than 2^23")

    def prove(self) -> None:
        """Prove the theorem."""
        zero, steps = self.located()
        box, near = self.basin(zero) if "basin" in self.claims else (zero, steps)
        self.nothing_else(box, near, self.hints["cuts"])
        multipliers = self.seen(zero, steps)
        if "kind" in self.claims:
            self.elliptic(multipliers)
        self.count(multipliers)
        if self.claims.get("unstable") == 0 and "radius" not in self.claims:
            self.no_choice(box, near)
        self.step("times, states and multipliers are those claimed")

    def located(self) -> tuple[list[Interval], list[Step]]:
        """Prove that F has one zero in the box; return what encloses it, and its steps."""
        contacts = [Contact(**contact) for contact in self.claims["contacts"]]
        self.orbit = Round(self.p, contacts, self.claims["periods"])
        self.orbit.confirm()
        self.equations = Equations(self.orbit, self.hints["bits"])
        once = not self.equations.autonomous or self.claims["periods"] == 1
        need(once, "claims.periods is not 1, but the system has no clock")
        same = len(self.hints["preconditioner"]) == self.equations.size
        need(same, f"there are not {self.equations.size} unknowns")
        zero = self.zero()
        return zero, self.equations.steps(zero)

    def seen(self, zero: list[Interval], steps: list[Step]) -> list[Interval]:
        """Compare the times, states and multipliers with the claims; return these."""
        step = self.equations.n + 1
        each = [zero[k : k + step] for k in range(0, len(zero), step)]
        self.confirm(times=[z[0] for z in each], states=[z[1:] for z in each])
        multipliers = symmetric(self.derivative(steps), self.equations.n)
        self.confirm(symmetric=multipliers)
        return multipliers

    def elliptic(self, multipliers: list[Interval]) -> None:
        """Prove that two multipliers, not real, lie on the unit circle."""
        one = product_of_two(self.p, self.orbit.contacts) == 1
        need(one and not self.p.autonomous, "the product of the multipliers is not found to be 1")
        two = multipliers[0].magnitude().is_before(multipliers[0].integer(2))
        need(two, "the sum of the multipliers may be 2 or more in size")

    def basin(self, zero: list[Interval]) -> tuple[list[Interval], list[Step]]:
        """Prove that the basin is contracted; return boxes of its contacts, with their steps."""
        W, kappa = self.claims["basin"]["matrix"], self.claims["basin"]["contraction"]
        alone, n = self.equations.autonomous, self.equations.n
        ellipsoid.confirm(W, kappa, self.hints["reach"], n if alone else n + 1)
        attracts = self.claims.get("unstable") == 0 and "radius" not in self.claims
        need(attracts, "claims.basin is not that of an orbit that attracts")
        reach = [r for place in self.hints["reach"] for r in place]
        sides = [Interval.enclosing(-r, r, x.bits) for x, r in zip(zero, reach, strict=True)]
        box = [x + side for x, side in zip(zero, sides, strict=True)]
        steps = self.equations.steps(box)
        parts = leg_maps(steps, n)
        ellipsoid.contracts(parts, W, kappa, self.hints["reach"], autonomous=alone)
        self.step("the basin is contracted, its contacts lie in boxes around those of the orbit")
        return box, steps

    def derivative(self, steps: list[Step]) -> Matrix:
        """Return that of the return map, with the multipliers as eigenvalues, and a 0."""
        D = return_map(steps, self.equations.n)
        return [row[1:] for row in D[1:]] if self.equations.autonomous else D

    def count(self, multipliers: list[Interval]) -> None:
        """Prove what is claimed of how many multipliers lie outside a circle."""
        radius, given = self.claims.get("radius", Fraction(1)), "unstable" in self.claims
        need(given or "radius" not in self.claims, "claims.radius is one of nothing")
        need(1 <= radius <= 2, "claims.radius is not between 1 and 2")
        scaled = [x * (1 / radius ** (k + 1)) for k, x in enumerate(multipliers)]
        certain = not given or outside(scaled) == self.claims["unstable"]
        need(certain, "claims.unstable is not certain to be the number of these multipliers")

    def zero(self) -> list[Interval]:
        """Prove that F has exactly one zero in the box; return K(S), which contains it."""
        box: list[Ends] = [side[:2] for sides in self.claims["box"] for side in sides]
        centre = [c for place in self.hints["centre"] for c in place]
        C = self.hints["preconditioner"]
        zero = krawczyk(self.equations, box, centre, C)
        self.step("K(box) lies in the interior of the box: exactly one zero of F, in K(box)")
        return zero

    def nothing_else(self, zero: list[Interval], steps: list[Step], cuts: Sequence[Cuts]) -> None:
        """Prove that the zeros are orbits: no guard vanishes but at the contacts."""
        for k in range(len(self.orbit.contacts)):
            self.leg(zero, steps[k], k, cuts[k])
        self.step("on each leg all guards of its mode are positive between the contacts")

    def leg(
        self,
        zero: list[Interval],
        step: Step,
        k: int,
        cuts: Cuts,
        windows: Mapping[str, Interval] | None = None,
        lost: int | None = None,
    ) -> None:
        """Prove that nothing else happens between a contact and the next one.

        In the window of a guard nothing is proved of it.  Where a contact is lost, L h <= 0 before
        it and L h >= 0 after it are given.
        """
        mode, zeros = self.orbit.flown(k), self.orbit.zeros(k)
        guards = watched(self.p, mode)
        start, end = self.equations.start(zero, k), self.equations.end(zero, k)
        need(start.is_before(end), f"leg {k + 1}: the contacts are not in order")
        need(cuts.keys() <= guards.keys(), f"leg {k + 1}: cuts of a guard that its mode has not")
        need(windows is None or windows.keys() <= cuts.keys(), "no cuts of a guard with a window")
        after = dict(zip(self.p.state, step.after, strict=True))
        flights = Leg(self.p, mode, start, after)
        for key, h in guards.items():
            ends = self.zeros(k, key, zeros[key], lost)
            if key in cuts:
                stays_positive(flights, h, end, cuts[key], ends, (windows or {}).get(key))
            else:
                others = tuple(guards[other] for other in cuts)
                need(falls(h, others), f"leg {k + 1}: no cuts, and no Lemma M, for {key}")
                ends_positive(flights, h, end, ends)

    def zeros(self, k: int, key: str, first: int, lost: int | None) -> tuple[int, int]:
        """Return how many of h, L h of a guard vanish at the ends of a leg.

        Where L h has its sign by another reason it counts as if it were zero.
        """
        last = int(key == self.orbit.following(k).guard)
        if lost is None:
            return first, last
        is_begin = k == lost and key == self.orbit.contacts[k].guard
        is_end = last and (k + 1) % len(self.orbit.contacts) == lost
        return 2 if is_begin else first, 2 if is_end else last

    def words(self) -> str:
        """Return the theorem in one line."""
        return f"{self.told_orbit()}{self.stability()}"

    def told_orbit(self) -> str:
        """Return the orbit in words."""
        claims = self.claims
        contacts = ", ".join(
            f"'{c['guard']}' of '{c['mode']}' at t in {t}"
            + f" with ({', '.join(self.p.state)}) in "
            f"({', '.join(map(str, q))}), then '{c['to']}'"
            for c, t, q in zip(claims["contacts"], claims["times"], claims["states"], strict=True)
        )
        sums = ", ".join(map(str, claims["symmetric"]))
        box = "; ".join(" x ".join(map(str, sides)) for sides in claims["box"])
        period, numbers = f"{claims['periods']} x 2 pi/omega", f"{len(self.p.state)} multipliers"
        if self.p.autonomous:
            period = f"in {claims['times'][0]} (times count from its first contact on)"
            numbers = f"{len(self.p.state) - 1} multipliers and of 0"
        alone = "but for shifts in time it is" if self.p.autonomous else "it is"
        return (
            f"the system with the {told(self.p)}; has an orbit of period {period} with these "
            f"contacts in one round, at each of which the guard falls through 0, and no others: "
            f"{contacts} (values just before a contact); {alone} the only one with these contacts "
            f"whose (t, {', '.join(self.p.state)}) at them lie in {box}; the elementary symmetric "
            f"functions of its {numbers} (sum, ..., product) are in {sums}"
        )

    def stability(self) -> str:
        """Return what is claimed of the multipliers in words."""
        count, n = self.claims.get("unstable"), len(self.p.state)
        if "kind" in self.claims:
            return ", their product is 1 exactly and they lie on the unit circle; it is elliptic"
        if count is None:
            return ""
        if "radius" in self.claims:
            return f", {count} of the {n} outside the circle of radius {self.claims['radius']}"
        sums = self.claims["symmetric"]
        named = n == 2 and not self.p.autonomous
        kind = kind_of_two(sums[0], sums[1], count) if named else ""
        attracts = "; it attracts" if not count else ""
        if "basin" in self.claims:
            attracts += self.attracted()
        return f", {count} of the {n} outside the unit circle and none on it{kind}{attracts}"

    def attracted(self) -> str:
        """Return the basin in words."""
        first, basin = self.claims["contacts"][0], self.claims["basin"]
        names = (*self.p.state,) if self.p.autonomous else ("t", *self.p.state)
        rows = ", ".join(f"({', '.join(map(str, row))})" for row in basin["matrix"])
        later = "" if self.p.autonomous else ", t less the periods that have passed,"
        return (
            f": with z = ({', '.join(names)}) just before the first contact and z* that of the "
            f"orbit, all motions that come to '{first['guard']}' of '{first['mode']}' with "
            f"|W (z - z*)| at most 1, W = ({rows}), have its contacts, and no others, from then "
            f"on; in each round{later} |W (z - z*)| becomes at most {basin['contraction']} times "
            f"what it was"
        )

    def no_choice(self, zero: list[Interval], steps: list[Step]) -> None:
        """Prove that motions near the orbit go on in the same modes."""
        starts = [self.equations.start(zero, k) for k in range(len(steps))]
        closed = all(map(self.closed, steps, starts, range(len(steps))))
        need(closed, "another mode may be open after a contact: the orbit may not attract")

    def closed(self, step: Step, start: Interval, k: int) -> bool:
        """Return whether after a contact no other mode is open to motions near the orbit.

        In each, a guard is negative, or vanishes after this contact and falls.
        """
        contact = self.orbit.contacts[k]
        after = dict(zip(self.p.state, step.after, strict=True))
        for mode in (m for m in self.orbit.guard(k).to if m != contact.to):
            flights = Leg(self.p, mode, start, after)
            guards = watched(self.p, mode)
            zeros = vanishing(self.p, contact.mode, contact.guard, mode)
            signs = [h.rate if zeros[g] else h.h for g, h in guards.items()]
            if not any((-flights.begun(g)).is_positive() for g in signs):
                return False
        return True


THEOREM = Contacts
