"""The theorem about a family of periodic orbits of the system that the certificate holds.

The parameters are the system, with a clock of rational frequency (``contacts``).  Contacts are at
quarters of a period of the clock; the states just before them are linear in a number c.

1. *Existence.*  For every c the contacts are a zero of F, by identities (``family``).
2. *Nothing else happens*: the range of c is cut into parts.  For all c in a part each leg is quiet,
   as in ``contacts``, and after each contact all other modes that its guard names are closed.  So
   for every c in the range the zero is a periodic orbit; two c give two
   states at the time of the first contact, as each state is a function of the one before, and not
   all are constant in c.
3. *Multipliers.*  The return map to the first guard, in (t, q), takes each orbit's (t_0, q_0(c)) to
   itself p periods later: its derivative takes (0, dq_0/dc) to itself.  This is not zero: else no
   state would depend on c, as each state is a function of the one before.  So 1 is a multiplier.
   The product of all n multipliers is the n-th elementary symmetric function (``contacts``); of two
   it is the other one.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from typing import Any, ClassVar

from cap.checker.kernel.citation import Citation
from cap.checker.kernel.decimals import decimal
from cap.checker.kernel.integers import Integer
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.named import Named, name
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many, Table, Whole
from cap.checker.kernel.theorem import BITS
from cap.checker.system import family
from cap.checker.system.contacts import Equations, Round, return_map
from cap.checker.system.curve import minors
from cap.checker.system.family import Linear
from cap.checker.system.given import GUARDS, STATES, told
from cap.checker.system.passage import Contact
from cap.checker.theorems.contacts import CONTACTS, CUTS, MOST_BITS, PERIODS, Contacts

PARTS, FREQUENCIES, WORK = 1000, 8, 1 << 24
_LEGS = Many(Named(Many(number, 0, CUTS), GUARDS), 1, CONTACTS)


class ContactsFamily(Contacts):
    """A line of periodic orbits with these contacts."""

    # fmt: off
    HINTS: ClassVar[Table] = (
        BITS,
        Field("frequencies", Many(number, 1, FREQUENCIES), "", "nu_i",
              "those of the flights between contacts, that of the clock among them"),
        Field("parts", Many(number, 0, PARTS), "", "", "where the range of c is cut"),
        Field("cuts", Many(_LEGS, 1, PARTS + 1), "", "", "of each part, as those of an orbit"),
    )
    CLAIMS: ClassVar[Table] = (
        Field("contacts", Many({"mode": name, "guard": name, "to": name}, 1, CONTACTS), "", "",
              "the guards that come to zero in one round, in order, and the modes that follow"),
        Field("periods", Whole(1, PERIODS), "", "p", "the periods of the clock in one round"),
        Field("quarters", Many(Integer(6), 1, CONTACTS), "", "j_k",
              "the times of the contacts, in quarters of a period of the clock"),
        Field("states", Many(Many([number, number], 1, STATES), 1, CONTACTS), "", "q_k",
              "just before the contacts: of each variable a and b, it is a + b c"),
        Field("range", [number, number], "", "c", "each c from the one to the other is an orbit"),
        Field("product", [number, number], "", "e_n",
              "bounds of the product of the multipliers, one of which is 1, for each c in the "
              "range"),
    )
    CITES: ClassVar[tuple[Citation, ...]] = ()
    # fmt: on
    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Reject what is not the same number everywhere, and too much work."""
        need(hints["bits"] <= MOST_BITS, f"more than {MOST_BITS} bits")
        count = len(claims["contacts"])
        for key in ("quarters", "states"):
            need(len(claims[key]) == count, f"claims.{key} is not a list of {count}")
        parts = len(hints["parts"]) + 1
        need(len(hints["cuts"]) == parts, f"hints.cuts is not a list of {parts}")
        need(all(len(legs) == count for legs in hints["cuts"]), "a part has not a leg a contact")
        pieces = sum(len(at) + 1 for legs in hints["cuts"] for leg in legs for at in leg.values())
        work = hints["bits"] * (len(claims["states"][0]) + 2) * pieces
        need(work <= WORK, "bits x variables x pieces of legs are more than 2^24")

    def prove(self) -> None:
        """Prove the theorem."""
        contacts, n = [Contact(**c) for c in self.claims["contacts"]], len(self.p.state)
        need("c" not in self.p.state, "a variable of the state has the name of the number c")
        need(all(len(q) == n for q in self.claims["states"]), f"a state has not {n} variables")
        self.orbit = Round(self.p, contacts, self.claims["periods"])
        self.orbit.confirm()
        quarters, frequencies = self.claims["quarters"], self.hints["frequencies"]
        family.confirm(self.orbit, quarters, self.lines, frequencies)
        self.step("for every c the contacts are a zero of F, by identities of polynomials in c")
        self.equations = Equations(self.orbit, self.hints["bits"])
        low, high = self.claims["range"]
        ends = [low, *self.hints["parts"], high]
        need(all(a < b for a, b in pairwise(ends)), "the parts of the range are not in order")
        for k, part in enumerate(pairwise(ends)):
            self.part(k, part)
        self.step("for each c in the range, all guards are positive between the contacts")
        self.step("after each contact no other mode is open; the product is that claimed")

    @property
    def lines(self) -> list[list[Linear]]:
        """The states just before the contacts."""
        return [[Linear(*z) for z in q] for q in self.claims["states"]]

    def part(self, k: int, ends: tuple[Fraction, Fraction]) -> None:
        """Prove that nothing else happens for all c in a part of the range."""
        zero = self.box(ends)
        steps = self.equations.steps(zero)
        for j, cuts in enumerate(self.hints["cuts"][k]):
            self.leg(zero, steps[j], j, cuts)
        self.no_choice(zero, steps)
        D = return_map(steps, self.equations.n)
        product, (low, high) = minors(D, self.equations.n), self.claims["product"]
        need(product.lies_in(low, high), "claims.product does not contain the product computed")

    def box(self, ends: tuple[Fraction, Fraction]) -> list[Interval]:
        """Return the times and states of all orbits with c between two numbers."""
        bits, quarter, found = self.equations.bits, self.equations.period / 4, list[Interval]()
        for j, state in zip(self.claims["quarters"], self.lines, strict=True):
            found.append(quarter * j)
            for z in state:
                values = sorted(z.a + z.b * c for c in ends)
                found.append(Interval.enclosing(values[0], values[1], bits))
        return found

    def words(self) -> str:
        """Return the theorem in one line."""
        claims, names = self.claims, ", ".join(self.p.state)
        contacts = ", ".join(
            f"'{c['guard']}' of '{c['mode']}' at t = {_time(j)} with ({names}) = "
            f"({', '.join(map(_told, q))}), then '{c['to']}'"
            for c, j, q in zip(claims["contacts"], claims["quarters"], self.lines, strict=True)
        )
        low, high = map(decimal, claims["range"])
        return (
            f"the system with the {told(self.p)}; for every c from {low} to {high} it has an orbit "
            f"of period {claims['periods']} x 2 pi/omega with these contacts in one round, at each "
            f"of which the guard falls through 0, and no others: {contacts} (values just before a "
            f"contact); different c have different states at the first of these times; after "
            f"each contact no other mode is open; one of their {len(self.p.state)} multipliers is "
            f"1, {self.others()}"
        )

    def others(self) -> str:
        """Return what is claimed of the other multipliers."""
        low, high = self.claims["product"]
        between = f"[{decimal(low)}, {decimal(high)}]"
        if len(self.p.state) != 2:
            return f"the product of all is in {between}"
        inside = low > -1 and high < 1
        return f"the other is in {between}{', inside the unit circle' * inside}"


def _time(quarters: int) -> str:
    """Return a time."""
    if not quarters:
        return "0"
    q = Fraction(quarters, 4)
    return "2 pi/omega" if q == 1 else f"{q} x 2 pi/omega"


def _told(z: Linear) -> str:
    """Return a + b c for people."""
    if not z.b:
        return decimal(z.a)
    size = "" if abs(z.b) == 1 else f"{decimal(abs(z.b))} "
    if not z.a:
        return f"{'-' * (z.b < 0)}{size}c"
    rest = f"{'-' if z.a < 0 else '+'} {decimal(abs(z.a))}"
    return f"{'-' * (z.b < 0)}{size}c {rest}"


THEOREM = ContactsFamily
