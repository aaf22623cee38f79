"""The theorem about two masses: an orbit on which none stops, elliptic in both planes, with twist.

*The angles.*  Both reduced traces in (-2, 2), and different: four simple multipliers exp(+-2 pi i
theta_j).  The sign is fixed by the form (``monodromy``): theta_j in (0, 1), and the Krein sign is +
if theta_j < 1/2.

*Resonances.*  For integers k, 0 < |k_1| + |k_2| <= 4, the distance of k.theta from the nearest
integer is positive; k and -k have the same.

*The normal form.*  In coordinates w_j = sqrt(I_j) exp(i phi_j), sum dI_j ^ dphi_j = Omega, Phi is
phi -> phi + 2 pi theta + B I + ..., I -> I + ... (``normal_form``), det B not 0.

*KAM.*  Let I = delta^2 J, J in a compact set away from the axes.  Then phi -> phi + 2 pi theta +
delta^2 B J + O(delta^3), J -> J + O(delta^3): an exact symplectic map, analytic, with a twist of
size delta^2.  Of its frequencies, which fill a set of size delta^2, all but a part O(gamma/delta^2)
are Diophantine with the constant gamma; their tori persist if the perturbation is less than a small
constant times gamma^2/delta^2.  Let gamma = C delta^(5/2): if C is large that is C^2 delta^3, more
than the perturbation, and the part lost is O(delta^(1/2)) [Poeschel: O(delta^((l-3)/2)) without
resonances of order up to l; here l = 4, and less is not enough].  So for small delta there are
invariant tori.

*What it does not give.*  2-tori do not separate a space of dimension 4: no neighbourhood of P* is
enclosed, and neither stability nor an island is claimed.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from cap.checker.kernel.citation import cite
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Quantity, Word
from cap.checker.particles.monodromy import Plane, rotation
from cap.checker.particles.normal_form import in_complex_coordinates, third_order, twist_matrix
from cap.checker.particles.periodic_orbit import KRAWCZYK, Located, PeriodicOrbit

HIGHEST = 4  # order of the resonances
RESONANCES = {
    f"{j},{k}": (j, k)
    for j in range(HIGHEST + 1)
    for k in range(j - HIGHEST, HIGHEST - j + 1)
    if j > 0 or k > 0
}
KAM = (
    "KAM: invariant tori near an elliptic fixed point",
    "Poeschel, Integrability of Hamiltonian systems on Cantor sets, Comm. Pure Appl. Math. 35 "
    "(1982) 653-696, for flows; for maps Kuksin and Poeschel, Seminar on Dynamical Systems, "
    "Birkhaeuser, 1994, 96-116, or Shang, J. Dynam. Differential Equations 12 (2000) 357-383",
)


class Particles(PeriodicOrbit):
    """The orbit is elliptic in both planes, without low resonance, and its twist is regular."""

    # fmt: off
    CLAIMS = (
        *PeriodicOrbit.CLAIMS,
        Field("theta", [Quantity()] * 2, "theta", r"\theta_j",
              "in (0, 1): exp(2 pi i theta_j) has the reduced trace z_j, and an eigenvector e with "
              "Omega(e, e^-)/i > 0, Omega = sum m_i dv_i^dx_i"),
        Field("krein_signs", [Word(("+", "-"))] * 2, "", "", "+ if theta_j < 1/2"),
        Field("resonance_distances", dict.fromkeys(RESONANCES, Quantity()), "distance to", "",
              "of k_1 theta_1 + k_2 theta_2 from the nearest integer, positive"),
        Field("twist_matrix", [[Quantity("m^-1 R^-2 omega^-1")] * 2] * 2, "B", "B",
              "phi -> phi + 2 pi theta + B I, symmetric"),
        Field("twist_determinant", Quantity("m^-2 R^-4 omega^-2"), "det B", r"\det B", "not 0"),
    )
    CITES = (
        KRAWCZYK,
        cite(
            *KAM,
            ("H1", "Phi is real analytic near P*: all contacts are transverse, one at a time, and "
             "no velocity vanishes", "closing_speeds, least_speeds"),
            ("H2", "Phi is exact symplectic near P*: the friction forces are equal and s_1 + s_2 "
             "is the same before and after each collision, so flights, hits and collisions keep "
             "sum m_i dv_i^dx_i, and a ball is simply connected", "itinerary, least_speeds"),
            ("H3", "the multipliers are exp(+-2 pi i theta_j), and simple",
             "reduced_traces, theta"),
            ("H4", "no resonance of order at most four", "resonance_distances"),
            ("H5", "the twist is not degenerate: det B is not 0", "twist_determinant"),
        ),
    )
    # fmt: on

    def conclude(self, at: Located) -> None:
        """Prove ellipticity, the absence of low resonances, and the twist."""
        planes = self.rotations(at)
        self.resonances([plane.theta for plane in planes])
        B = twist_matrix(in_complex_coordinates(at.M, third_order(at.M, at.orbit), planes))
        det = B[0][0] * B[1][1] - B[0][1] * B[1][0]
        self.confirm(twist_matrix=B, twist_determinant=det)
        claim, det_claim = self.claims["twist_matrix"], self.claims["twist_determinant"]
        need(claim[0][1] == claim[1][0], "the twist matrix claimed is not symmetric")
        need(not det_claim.lower <= 0 <= det_claim.upper, "twist_determinant does not exclude 0")
        self.step("the normal form exists, with the twist matrix claimed; its determinant is not 0")

    def rotations(self, at: Located) -> list[Plane]:
        """Prove that the multipliers are simple and on the unit circle; compare the angles."""
        (z, other), claims = at.reduced_traces, self.claims
        inside = all(z.lower > -2 and z.upper < 2 for z in claims["reduced_traces"])
        need(inside, "a reduced trace is not in (-2, 2)")
        planes = [rotation(at.M, at.D, *pair) for pair in ((z, other), (other, z))]
        self.confirm(theta=[plane.theta for plane in planes])
        half = Fraction(1, 2)
        for theta, krein in zip(claims["theta"], claims["krein_signs"], strict=True):
            within = (0, half) if krein == "+" else (half, 1)
            need(within[0] < theta.lower and theta.upper < within[1], f"theta is not {krein}")
        self.step("P* is elliptic in both planes, with simple multipliers")
        return planes

    def resonances(self, theta: Sequence[Interval]) -> None:
        """Compare the distances from the resonances."""
        distances = {
            name: from_integers(theta[0] * j + theta[1] * k) for name, (j, k) in RESONANCES.items()
        }
        self.confirm(resonance_distances=distances)
        claimed = self.claims["resonance_distances"].values()
        need(all(d.lower > 0 for d in claimed), "a resonance distance is not positive")
        self.step("there is no resonance of order at most four")

    def words(self) -> str:
        """Return the theorem in one line."""
        return self.told(_TORI)


def from_integers(u: Interval) -> Interval:
    """Return an enclosure of the distances of the points of an interval from the integers.

    The middle is at most 1/2 from an integer n: then no point is nearer to another one than the
    nearest point is to n.
    """
    n = round((u.lower + u.upper) / 2)
    near, half = (u - n).magnitude(), u.integer(1) / 2
    return Interval(near.lo, min(near.hi, half.hi), u.bits)


_TORI = (
    "P* is elliptic in both planes, with the multipliers exp(+-2 pi i theta_j), theta_1 in "
    "{theta[0]}, theta_2 in {theta[1]}, and has no resonance of order at most four: in coordinates "
    "w_j = sqrt(I_j) exp(i phi_j), in which this form is sum dI_j^dphi_j, Phi is phi -> phi + 2 pi "
    "theta + B I + ..., I -> I + ... up to terms of order |w|^4 in w, with B_11 in "
    "{twist_matrix[0][0]}, B_12 = B_21 in {twist_matrix[0][1]}, B_22 in {twist_matrix[1][1]}, and "
    "det B in {twist_determinant}: not 0; hence (KAM) every neighbourhood of P* contains invariant "
    "2-tori of Phi, Lagrangian and with Diophantine rotation vectors, which fill a set of positive "
    "measure, and on their orbits no mass ever stops; as 2-tori do not enclose anything in "
    "dimension 4, this does not say that P* is stable"
)

THEOREM = Particles
