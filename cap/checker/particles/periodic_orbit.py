"""What theorems about an orbit of two masses share: it exists, nobody stops, Phi is symplectic.

1. *Existence.*  K(box) lies in the interior of the box of the unknowns of all contacts: there is
   exactly one T-periodic orbit on which no mass stops, with this itinerary, and contacts in the
   box (``existence``: if there is a zero of G with what follows, it is such an orbit).
2. *Localisation.*  The same for a small box S in it: the contacts lie in K(S).
3. *The orbit.*  With contacts in K(S) nobody stops, the contacts are transversal and in order,
   nothing else happens, and collisions keep s_1 + s_2 (``orbit``): so the zero of G is the orbit.
4. *The derivative* of the time-T map Phi of (x_1, x_2, v_1, v_2) from t = 0 (``monodromy``).
5. *The conclusion* is drawn from the numbers claimed, which contain the true ones.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from fractions import Fraction
from typing import Any, ClassVar, NamedTuple

from cap.checker.kernel.citation import NEUMAIER, cite
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many, Quantity, Table, Word, region
from cap.checker.kernel.theorem import BITS
from cap.checker.particles.existence import SIZE, Ends, Equations, Matrix, of_contacts
from cap.checker.particles.mechanics import NORMALS, Contact, Mechanics, contacts
from cap.checker.particles.monodromy import monodromy, reduced_traces, symplectic
from cap.checker.particles.orbit import approach, least_speeds
from cap.checker.particles.zero import ZeroOfEvents

LEAST, MOST = 2, 16  # contacts
UNKNOWNS = ("t", "x", "v1", "v2")
KRAWCZYK = cite(
    "Krawczyk",
    NEUMAIER,
    ("smooth", "the defect G of the flights is analytic in the times, free coordinates and "
     "velocities of the contacts", "box"),
    ("inclusion", "K(box) lies in the interior of the box", "box"),
)  # fmt: skip


def listed(shape: Any) -> Many:
    """Return the shape of what is given for each contact."""
    return Many(shape, LEAST, MOST)


def square(one: str, above: str, below: str) -> list[list[Quantity]]:
    """Return the shape of a derivative of (x_1, x_2, v_1, v_2)."""
    top, low = ([Quantity(a)] * 2 + [Quantity(b)] * 2 for a, b in ((one, above), (below, one)))
    return [top, top, low, low]


class Located(NamedTuple):
    """The orbit in intervals: its contacts, D = Phi'(P*), and the reduced traces z_1 > z_2."""

    M: Mechanics
    orbit: list[Contact]
    D: Matrix
    reduced_traces: list[Interval]


class PeriodicOrbit(ZeroOfEvents):
    """A T-periodic orbit of two masses on which no mass stops."""

    LISTED = ("box", "hit_times", "closing_speeds")
    # fmt: off
    HINTS: ClassVar[Table] = (
        BITS,
        Field("centre", listed([number] * SIZE), "", "c",
              "t, xi, v_1, v_2 of each contact, in the box"),
        Field("radius", number, "", "",
              "S = c +- radius (1/omega, R, R omega, R omega) for each contact"),
        Field("preconditioner", Many(Many(number, SIZE * LEAST, SIZE * MOST),
                                     SIZE * LEAST, SIZE * MOST), "", "C",
              "near the inverse of G'(c), rows"),
    )
    CLAIMS: ClassVar[Table] = (
        Field("itinerary", listed(Word(tuple(NORMALS))), "", "",
              "all contacts in (0, T), in their order"),
        Field("box", listed(dict.fromkeys(UNKNOWNS, region)), "", "",
              "exactly one T-periodic orbit with this itinerary, on which no mass stops, has its "
              "contacts in this box: time, coordinate of the mass that is not at a wall (or of "
              "both), velocities just before"),
        Field("x", [Quantity("R")] * 2, "x", "x", "x_1, x_2 at t = 0"),
        Field("v", [Quantity("R omega")] * 2, "v", "v", "v_1, v_2 at t = 0"),
        Field("hit_times", listed(Quantity("omega^-1")), "itinerary", "t_k",
              "of the contacts: hits and collisions, increasing, in (0, T)"),
        Field("closing_speeds", listed(Quantity("R omega")), "closing speed", "u_k",
              "|v_1| at l, |v_2| at r, v_1 - v_2 at a collision, just before; positive"),
        Field("least_speeds", [Quantity("R omega")] * 2, "least speed", r"\min |v_i|",
              "the minimum of |v_i| on the orbit, positive"),
        Field("monodromy", square("", "omega^-1", "omega"), "Phi'", r"D\Phi",
              "rows of the derivative of Phi, in the order x_1, x_2, v_1, v_2"),
        Field("reduced_traces", [Quantity()] * 2, "lambda + 1/lambda", "z_j",
              "z_1 > z_2, lambda + 1/lambda of the two pairs of multipliers"),
    )
    # fmt: on

    def prove(self) -> None:
        """Prove the theorem."""
        M = Mechanics(self.p, self.hints["bits"])
        orbit = contacts(M, self.claims["itinerary"], self.zero(M))
        self.orbit(M, orbit)
        D = monodromy(M, orbit)
        symplectic(M, D)
        self.confirm(monodromy=D)
        self.step("every flight and contact keeps the symplectic form, and so does Phi'")
        z = reduced_traces(D)
        self.confirm(reduced_traces=z)
        high, low = self.claims["reduced_traces"]
        need(low.upper < high.lower, "the reduced traces are not in order")
        self.conclude(Located(M, orbit, D, z))

    @abstractmethod
    def conclude(self, at: Located) -> None:
        """Prove what the theorem says of the multipliers, and of the map near the orbit."""

    @property
    def box(self) -> list[Ends]:
        """The box claimed."""
        return [contact[name][:2] for contact in self.claims["box"] for name in UNKNOWNS]

    def equations(self, M: Mechanics) -> Equations:
        """Return the equations of the contacts."""
        return of_contacts(M, self.claims["itinerary"])

    def units_of(self, word: str) -> tuple[Fraction, ...]:  # noqa: ARG002 (those of all contacts)
        """Return the units of the unknowns of a contact."""
        speed = self.R * self.omega
        return 1 / self.omega, self.R, speed, speed

    def orbit(self, M: Mechanics, orbit: Sequence[Contact]) -> None:
        """Prove that the zero is an orbit on which no mass stops, and compare its claims."""
        self.confirm(
            least_speeds=least_speeds(M, orbit),
            closing_speeds=[approach(M, contact) for contact in orbit],
            hit_times=[contact.at.t for contact in orbit],
        )
        flight, end = M.flight(orbit[-1]), M.later(M.instant(M.number(0)))
        self.confirm(
            x=[M.place(i, flight, end) for i in (0, 1)],
            v=[M.velocity(i, flight, end) for i in (0, 1)],
        )
        self.step("on the orbit nobody stops, and nothing else happens; the claims contain it")
        self.in_order("hit_times", 1, "contact")
        for name in ("closing_speeds", "least_speeds"):
            need(all(u.lower > 0 for u in self.claims[name]), f"{name} are not all positive")

    def told(self, sentence: str, **more: object) -> str:
        """Return a sentence with the numbers claimed."""
        masses, words = self.p.masses, ", ".join(self.claims["itinerary"])
        return super().told(ORBIT + sentence, m=masses, contacts=words, **more)


ORBIT = (
    "m_i x_i'' = F cos(omega t) - f sgn x_i', i = 1, 2, with m_1 = {m[0]}, m_2 = {m[1]}, F = {F}, "
    "omega = {omega}, f = {f}, {l} <= x_1 <= x_2 <= {r}, elastic walls and elastic collisions: "
    "there is one and only one orbit of period T = 2 pi/omega on which no mass ever stops, which "
    "has in [0, T) exactly these contacts, in this order: {contacts}, and has them in the box of "
    "the certificate; at t = 0, P*: x_1 in {x[0]}, x_2 in {x[1]}, v_1 in {v[0]}, v_2 in {v[1]}; "
    "the least speeds are in {least_speeds[0]} and {least_speeds[1]}; s_1 + s_2, s_i the sign of "
    "v_i, is the same before and after every collision, so near P* the time-T map Phi preserves "
    "the form sum m_i dv_i^dx_i; "
)
