"""The theorem about an elliptic point: a fixed point of a non-sticking orbit, with |trace| < 2, no
resonance of order at most four, and a twist that is not zero.

*The remainder.*  On a square D around K(S), in the box and reaching rho to each side, Lagrange's
form bounds what the Taylor polynomial of degree N leaves on the disk of radius rho by the sum over
i + j = n = N + 1 of

    max |c_ij(D)| max |dx^i dv^j|,      max |dx^i dv^j| = rho^n sqrt(i^i j^j / n^n).
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from cap.checker.flow.itinerary import Passage
from cap.checker.kernel.citation import cite
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred
from cap.checker.kernel.optional import First, Maybe
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Quantity, Word, bound
from cap.checker.kernel.twist_theorem import MOSER
from cap.checker.maps import normal_form
from cap.checker.maps.fixed_point import Point
from cap.checker.maps.non_sticking import KRAWCZYK, NonSticking
from cap.checker.maps.resonances import ROTATION, confirm_rotation, confirm_twist, rotation

ORDERS = ("3", "5", "7", "9")


def powers(order: int) -> list[tuple[int, int]]:
    """Return the powers i, j of the monomials dx^i dv^j of degree at least 2."""
    return [(i, n - i) for n in range(2, order + 1) for i in range(n + 1)]


def coefficients(k: int) -> dict[str, Any]:
    """Return the shape of the Taylor coefficients of a component of Phi in units R omega^k."""
    units = {f"{i},{j}": f"R^{1 - i - j} omega^{k - j}" for i, j in powers(9)}
    return {name: Maybe(Quantity(unit)) for name, unit in units.items()}


class Elliptic(NonSticking):
    """The fixed point is elliptic, without low resonance, with twist."""

    # fmt: off
    HINTS = (
        *NonSticking.HINTS,
        Field("order", Word(ORDERS), "", "N", "the odd order to which Phi is expanded"),
    )
    CLAIMS = (
        *NonSticking.CLAIMS,
        *ROTATION,
        Field("taylor", {"x": coefficients(0), "v": coefficients(1)}, "", "",
              "of dx^i dv^j in that component of Phi(P* + (dx, dv)), 2 <= i + j <= order"),
        Field("twist", Quantity("R^-2 omega^-1"), "tau_1 per |z|^2", r"\tau_1",
              "with its sign relative to the signed Theta; not 0"),
        Field("twist_action", Quantity("R^-2 omega^-1"), "tau_1 per action I", r"2\tau_1",
              "2 tau_1, per action |z|^2/2"),
        Field("higher_twists", First([Quantity(f"R^{-2 * k} omega^{-k}") for k in (2, 3, 4)]),
              "tau_(k+1), k =", r"\tau_{k+1}",
              "tau_2, tau_3, ..: (order - 3)/2 of them"),
        Field("remainder", {"degree": Word(ORDERS), "radius": number, "x": bound, "v": bound},
              "", "", "on the disk |(dx, dv)| <= radius, which lies in the box, each component of "
              "Phi differs from its Taylor polynomial of this degree by at most so much"),
    )
    CITES = (
        KRAWCZYK,
        cite(
            *MOSER,
            ("H1", "the orbit has finitely many hits, all transverse, no turning and no sticking",
             "hit_times, hit_speeds, least_speed"),
            ("H2", "Phi is exact symplectic near the fixed point: flights and hits preserve dx^dv, "
             "and a disk is simply connected", "box"),
            ("H3", "Phi is real analytic near the fixed point: the hit times are, by the implicit "
             "function theorem", "hit_speeds"),
            ("H4", "the eigenvalues of the Jacobian are exp(+-i Theta), 0 < |Theta| < pi", "trace"),
            ("H5", "no resonance of order at most four", "rotation_number, resonance_distances"),
            ("H6", "the first Birkhoff twist coefficient does not vanish", "twist"),
        ),
    )
    # fmt: on

    def conclude(self, fixed_point: Point, orbit: Passage) -> None:  # noqa: ARG002
        """Prove ellipticity, the absence of low resonances, the twist, and the remainder."""
        N = int(self.hints["order"])
        image = self.near(fixed_point, fixed_point, N)
        x, v = image.x.box, image.v.box
        frame = normal_form.elliptic_frame(image.jacobian)
        self.confirm(**rotation(frame, self.pi()))
        self.confirm(taylor={z: taylor(w, N) for z, w in (("x", image.x), ("v", image.v))})
        self.step("the Taylor coefficients of Phi at P* contain what is computed")
        tau, *higher = normal_form.twists(normal_form.in_complex_coordinate(x, v, frame))
        self.confirm(twist=tau, twist_action=tau * 2, higher_twists=higher)
        self.step("the normal form exists, preserves area, and has the twists claimed")
        trace = self.claims["trace"]
        need(trace.lower > -2 and trace.upper < 2, "the trace is not in (-2, 2)")
        confirm_rotation(self.claims)
        self.step("P* is elliptic, without resonance of order at most four")
        confirm_twist(self.claims)
        self.step("the first twist is not zero")
        self.remainder(fixed_point, N)

    def remainder(self, fixed_point: Point, N: int) -> None:
        """Prove the bound of what the Taylor polynomial of degree N leaves on the disk."""
        claim, n = self.claims["remainder"], N + 1
        need(claim["degree"] == self.hints["order"], "the degree of the remainder is not the order")
        rho = claim["radius"]
        need(rho > 0, "the radius of the remainder is not positive")
        square = [z + Interval.enclosing(-rho, rho, self.hints["bits"]) for z in fixed_point]
        need(self.is_in_the_box(square), "the disk of the remainder is not in the box")
        image = self.near(square, fixed_point, n)
        for name, component in (("x", image.x), ("v", image.v)):
            most = self.lagrange(component, n).upper * rho**n
            need(most <= claim[name], f"the remainder of {name} may be larger than claimed")
        self.step(f"on the disk, Phi is as close to its Taylor polynomial of degree {N} as claimed")

    def lagrange(self, component: Centred, n: int) -> Interval:
        """Return the sum of max |c_ij| sqrt(i^i j^j / n^n) over i + j = n."""
        total = self.number(0)
        for i in range(n + 1):
            weight = self.number(Fraction(i**i * (n - i) ** (n - i), n**n)).sqrt()
            total = total + component[i, n - i].magnitude() * weight
        return total

    def words(self) -> str:
        """Return the theorem in one line."""
        return self.statement(
            "the fixed point is elliptic with trace in {trace}, and has no resonance of order at "
            f"most four: {normal_form.told_form()}, with Theta in {{rotation_angle}}, the rotation "
            "number |Theta|/(2 pi) in {rotation_number}, and tau_1 in {twist}, that is, in "
            "{twist_action} per action |z|^2/2; so tau_1 is not zero: hence (Moser) the fixed "
            "point is stable, and every neighbourhood of it contains invariant closed curves "
            "around it"
        )


def taylor(component: Centred, order: int) -> dict[str, Interval]:
    """Return the Taylor coefficients of a component of Phi at P*."""
    return {f"{i},{j}": component[i, j] for i, j in powers(order)}


THEOREM = Elliptic
