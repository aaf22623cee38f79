"""The theorem about two masses: a periodic orbit that turns and sticks, and attracts.

1. *Existence.*  K(box) lies in the interior of the box of the unknowns of all events (``stops``):
   there is exactly one zero of their equations in it.  The same for a small box S: it is in K(S).
2. *The orbit.*  With events in K(S) they are what their words say, transversal, in order, nothing
   else happens (``passage``): the zero is an orbit of period nT; and another orbit of this period,
   with these events in the box, would be a zero, too.
3. *Attraction.*  Near its state P at t = 0 all orbits have these events, as what was proved are
   strict inequalities; their times depend differentiably on the state, or not at all: so Phi, the
   map over nT, is continuously differentiable there.  A power of Phi'(P), scaled, has row sums
   below 1: so its eigenvalues are below 1 in size, and P attracts all states near it.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any, ClassVar

from cap.checker.kernel.citation import NEUMAIER, cite
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many, Quantity, Table, Whole, Word, bound, region
from cap.checker.kernel.theorem import BITS
from cap.checker.particles.existence import SIZE, Ends, Equations
from cap.checker.particles.mechanics import NORMALS, Mechanics
from cap.checker.particles.passage import derivative, follows, row_sums
from cap.checker.particles.stops import WORDS, events, flight, legs, of_events, place, velocity
from cap.checker.particles.zero import ZeroOfEvents

LEAST, MOST = 2, 32  # events
MAX_PERIODS, MAX_POWER = 8, 64


def listed(shape: Any) -> Many:
    """Return the shape of what is given for each event."""
    return Many(shape, LEAST, MOST)


class ParticlesSink(ZeroOfEvents):
    """An attracting periodic orbit of two masses."""

    LISTED = ("box", "event_times")
    # fmt: off
    HINTS: ClassVar[Table] = (
        BITS,
        Field("centre", listed([number] * SIZE), "", "c", "the unknowns of each event, in the box"),
        Field("radius", number, "", "",
              "S = c +- radius times the units of the unknowns: 1/omega, R, R omega"),
        Field("preconditioner", Many(Many(number, SIZE * LEAST, SIZE * MOST),
                                     SIZE * LEAST, SIZE * MOST), "", "C",
              "near the inverse of G'(c), rows"),
    )
    CLAIMS: ClassVar[Table] = (
        Field("period", Whole(1, MAX_PERIODS), "", "n", "the orbit has the period nT"),
        Field("itinerary", listed(Word(WORDS)), "", "",
              "all events in (0, nT), in their order; a number is that of the mass"),
        Field("box", listed([region] * SIZE), "", "",
              "exactly one orbit of period nT with this itinerary has its events in this box: of a "
              "contact the time, the free coordinate, both velocities just before; of a turn, "
              "stick or release the time, both coordinates, the velocity of the other mass"),
        Field("x", [Quantity("R")] * 2, "x", "x", "x_1, x_2 at t = 0"),
        Field("v", [Quantity("R omega")] * 2, "v", "v", "v_1, v_2 at t = 0"),
        Field("event_times", listed(Quantity("omega^-1")), "itinerary", "t_k",
              "increasing, in (0, nT)"),
        Field("power", Whole(1, MAX_POWER), "", "p", "a power of Phi'(P), Phi the map over nT"),
        Field("contraction", bound, "", r"\kappa", "below 1: a bound of the sums of the absolute "
              "values in each row of that power, in the coordinates x/R, v/(R omega)"),
    )
    CITES = (
        cite(
            "Krawczyk",
            NEUMAIER,
            ("smooth", "the defect G of the flights and rests is analytic in the unknowns of the "
             "events", "box"),
            ("inclusion", "K(box) lies in the interior of the box", "box"),
        ),
    )
    # fmt: on

    def prove(self) -> None:
        """Prove the theorem."""
        M = Mechanics(self.p, self.hints["bits"])
        found = events(M, self.claims["itinerary"], self.zero(M))
        n = self.claims["period"]
        follows(M, found, n)
        last, end = legs(M, found, n)[-1][0], M.instant(M.number(0))
        g = flight(M, last)
        end = end._replace(t=M.period * n)
        self.confirm(
            x=[place(M, i, g, end) for i in (0, 1)],
            v=[velocity(M, i, g, end) for i in (0, 1)],
            event_times=[event.at.t for event in found],
        )
        self.step("the events are what their words say, and nothing else happens")
        self.in_order("event_times", n, "event")
        sums = row_sums(M, derivative(M, found, n), self.claims["power"])
        kappa = self.claims["contraction"]
        need(sums.upper <= kappa, "the power of the derivative may be larger than claimed")
        need(kappa < 1, "the contraction is not below 1")
        self.step("a power of the derivative contracts: the orbit attracts")

    @property
    def box(self) -> list[Ends]:
        """The box claimed."""
        return [z[:2] for event in self.claims["box"] for z in event]

    def equations(self, M: Mechanics) -> Equations:
        """Return the equations of the events."""
        return of_events(M, self.claims["itinerary"], self.claims["period"])

    def units_of(self, word: str) -> tuple[Fraction, ...]:
        """Return the units of the unknowns of an event."""
        speed = self.R * self.omega
        return 1 / self.omega, self.R, speed if word in NORMALS else self.R, speed

    def words(self) -> str:
        """Return the theorem in one line."""
        masses, words = self.p.masses, ", ".join(self.claims["itinerary"])
        return self.told(_SINK, m=masses, words=words)


_SINK = (
    "m_i x_i'' = F cos(omega t) - f sgn x_i', i = 1, 2, with m_1 = {m[0]}, m_2 = {m[1]}, F = {F}, "
    "omega = {omega}, f = {f}, {l} <= x_1 <= x_2 <= {r}, elastic walls and elastic collisions: "
    "with T = 2 pi/omega there is one and only one orbit of period {period} T that has in [0, "
    "{period} T) exactly these events, in this order: {words}, and has them in the box of the "
    "certificate; at t = 0 x_1 in {x[0]}, x_2 in {x[1]}, v_1 in {v[0]}, v_2 in {v[1]}; it attracts "
    "all orbits that begin near enough to this state: in the coordinates x/R, v/(R omega) the "
    "power {power} of the derivative of the map over {period} T has row sums of at most "
    "{contraction}"
)

THEOREM = ParticlesSink
