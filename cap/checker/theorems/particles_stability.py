"""The theorem about two masses: how long motions near an elliptic orbit do not stop.

2-tori do not enclose anything in dimension 4, so no curve bounds these motions.  P* is the state at
t = 0 of the orbit (``periodic_orbit``).  All orbits from a box around the ellipsoid E have the
contacts of P* over one period, and no mass stops; Phi is analytic and injective on the box
(``neighbours``).  A polynomial H is a hint, and the lemma of ``drift`` says how long motions from
the smaller ellipsoid E' stay in E.  Between nT and (n+1)T the motion is one from the box.

Neither the multipliers of P*, nor a twist, nor the symplectic form are used.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Power
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many, Whole, enclosure
from cap.checker.maps.ellipses import Ellipses, fields
from cap.checker.particles.neighbours import Neighbours
from cap.checker.particles.periodic_orbit import KRAWCZYK, LEAST, MOST, Located, PeriodicOrbit

HIGHEST = 6  # order of the jets, and degree of H


class ParticlesStability(PeriodicOrbit):
    """No mass stops for N periods on motions from an ellipsoid around the state of the orbit."""

    # fmt: off
    HINTS = (
        *PeriodicOrbit.HINTS,
        Field("windows", Many(enclosure, LEAST, MOST), "", "",
              "each orbit from the box around E has its k-th contact in the k-th"),
        Field("order", Whole(3, HIGHEST), "", "", "of the jets over this box"),
        Field("powers", Many([Whole(0, HIGHEST)] * 4, 4, 400), "", "",
              "i, j, k, l of u_1^i u_2^j u_3^k u_4^l, for each coefficient of the integral"),
        Field("integral", Many(number, 4, 400), "", "H", "the coefficients"),
    )
    CLAIMS = (
        *PeriodicOrbit.CLAIMS,
        *fields(4, "(x_1, x_2, v_1, v_2)"),
    )
    CITES = (KRAWCZYK,)
    # fmt: on

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound the time; reject what is not the same number of coefficients and powers."""
        super().limit(hints, claims)
        need(len(hints["windows"]) == len(claims["itinerary"]), "not a window for each contact")
        powers = [tuple(p) for p in hints["powers"]]
        need(len(powers) == len(set(powers)) == len(hints["integral"]), "not a coefficient each")
        need(all(0 < sum(p) <= HIGHEST for p in powers), "a power of H is not in 1 .. 6")
        work = len(powers) * hints["bits"] * len(claims["itinerary"])
        need(work <= 1 << 19, "coefficients, bits and contacts are too much")

    def conclude(self, at: Located) -> None:
        """Prove that motions from the inner ellipsoid stay in the outer one."""
        ellipses = Ellipses.of(self.claims)
        ellipses.hold(self.state(at))
        self.step("P* is in the inner ellipsoid")
        c = [self.number(q) for q in ellipses.centre]
        box = ellipses.box(self.hints["bits"])
        near = Neighbours(at.M, box, c, self.hints["order"])
        windows = [(w.lower, w.upper) for w in self.hints["windows"]]
        image = near.over(self.claims["itinerary"], windows)
        self.step("all motions from a box around the outer one have these contacts in a period")
        pairs = zip(self.hints["powers"], self.hints["integral"], strict=True)
        H: dict[Power, Fraction] = {tuple(p): c for p, c in pairs}
        ellipses.last(H, [*near.states, *image])
        self.step("for so many periods H does not grow from the inner to the outer one")

    def state(self, at: Located) -> list[Interval]:
        """Return P*."""
        M = at.M
        flight, end = M.flight(at.orbit[-1]), M.later(M.instant(M.number(0)))
        return [of(i, flight, end) for of in (M.place, M.velocity) for i in (0, 1)]

    def words(self) -> str:
        """Return the theorem in one line."""
        return Ellipses.of(self.claims).words(self.told, _STAY)


_STAY = (
    "let E be the ellipsoid of all c + A u, |u| <= 1, in the coordinates (x_1, x_2, v_1, v_2), "
    "with c = ({c}), and A = ({A}) in rows, and E' the ellipsoid {kappa} times as large around the "
    "same centre: P* is in E', and on every motion that starts in E' at t = 0 no mass stops for "
    "|t| <= {periods} T, and at each multiple of T in this time the state is in E"
)

THEOREM = ParticlesStability
