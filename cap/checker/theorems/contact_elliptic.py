"""The theorem about an elliptic periodic orbit of the system that the certificate holds: its twist.

The parameters are the system, with a clock and a state of two variables (``contacts``).

1. *The orbit* exists, with these contacts and no others: steps 1 to 3 of ``contacts``.
2. *Phi near it.*  The phase s lies between the last contact and the first one of the next round.
   Motions near the orbit have its contacts, as all other modes that a guard names are closed, and
   they cross each guard (``strobe``): so Phi, from the state at s to that p periods later, is
   real analytic near the state of the orbit at s, a fixed point.
3. *Area.*  Flights have no divergence, and the contacts multiply area by numbers whose product is 1
   (``conserved``): Phi preserves it.
4. *Elliptic.*  The sum of the multipliers is in (-2, 2), no resonance of order at most four.
5. *Twist.*  The normal form of the jet of Phi of third order, tau_1 /= 0.  Moser's theorem follows.
"""

from __future__ import annotations

from typing import Any, ClassVar

from cap.checker.kernel.citation import cite
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many, Quantity, Table
from cap.checker.kernel.twist_theorem import MOSER
from cap.checker.maps import normal_form
from cap.checker.maps.resonances import ROTATION, confirm_rotation, confirm_twist, rotation
from cap.checker.system.strobe import Strobe
from cap.checker.theorems.contacts import KRAWCZYK, ORBIT, ORBIT_HINTS, Contacts

ORDER = 3


class ContactElliptic(Contacts):
    """An elliptic orbit with these contacts, without low resonance, with twist."""

    # fmt: off
    HINTS: ClassVar[Table] = ORBIT_HINTS
    CLAIMS: ClassVar[Table] = (
        *ORBIT,
        Field("phase", number, "", "s",
              "a time between the last contact, less p periods, and the first one"),
        Field("point", Many(Quantity(), 2, 2), "state at s", "z^*",
              "of the orbit at the time s: a fixed point of Phi"),
        *ROTATION,
        Field("twist", Quantity(), "tau_1 per |z|^2", r"\tau_1",
              "with its sign relative to the signed Theta; not 0"),
    )
    CITES = (
        KRAWCZYK,
        cite(
            *MOSER,
            ("H1", "motions near the orbit have its contacts and no others: other guards are "
             "positive on its legs, other modes closed, guards are crossed", "times, states"),
            ("H2", "Phi is exact symplectic near the fixed point: the determinant of its "
             "derivative is 1 by identities, and a disk is simply connected", "contacts"),
            ("H3", "Phi is real analytic near the fixed point: the times of contacts are, by the "
             "implicit function theorem", "times, states"),
            ("H4", "the multipliers are exp(+-i Theta), 0 < |Theta| < pi",
             "symmetric, rotation_angle"),
            ("H5", "no resonance of order at most four", "rotation_number, resonance_distances"),
            ("H6", "the first Birkhoff twist coefficient does not vanish", "twist"),
        ),
    )
    # fmt: on

    def prove(self) -> None:
        """Prove the theorem."""
        need(len(self.p.state) == 2, "the state has not two variables")
        zero, steps = self.located()
        self.nothing_else(zero, steps, self.hints["cuts"])
        self.elliptic(self.seen(zero, steps))
        self.step("times, states and multipliers are those claimed; Phi preserves area")
        self.no_choice(zero, steps)
        strobe = Strobe(self.equations, zero, steps, self.number(self.claims["phase"]))
        self.confirm(point=strobe.point)
        self.step("motions near the orbit have its contacts, and Phi is analytic there")
        x, v = strobe.jet(ORDER)
        rows = [[z.coefficients[p] for p in ((1, 0), (0, 1))] for z in (x, v)]
        frame = normal_form.elliptic_frame(rows)
        self.confirm(**rotation(frame, self.pi()))
        confirm_rotation(self.claims)
        self.step("the fixed point is elliptic, without resonance of order at most four")
        (tau,) = normal_form.twists(normal_form.in_complex_coordinate(x, v, frame))
        self.confirm(twist=tau)
        confirm_twist(self.claims)
        self.step("the normal form exists, preserves area, and its twist is not zero")

    def words(self) -> str:
        """Return the theorem in one line."""
        x, v = self.p.state
        claims: dict[str, Any] = self.claims
        point = ", ".join(map(str, claims["point"]))
        return (
            f"{self.told_orbit()}, their product is 1 exactly and they lie on the unit circle; the "
            f"map Phi from the state ({x}, {v}) at t = {claims['phase']} to that "
            f"{claims['periods']} x 2 pi/omega later preserves area near the point of this orbit, "
            f"in ({point}); this fixed point of it is elliptic, and has no resonance of order at "
            f"most four: {normal_form.told_form(x, v)}, with Theta in {claims['rotation_angle']}, "
            f"the rotation number |Theta|/(2 pi) in {claims['rotation_number']}, and tau_1 in "
            f"{claims['twist']}, which is not zero: hence (Moser) the fixed point is stable, and "
            "every neighbourhood of it contains invariant closed curves around it"
        )


THEOREM = ContactElliptic
