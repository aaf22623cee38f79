"""The paper's equation for orbits that turn once between hits: all its roots, and none is an orbit.

In the units of ``closed_form`` it is

    Psi(theta) = pi sin theta - 2 - rho + alpha (pi^2/2 - theta (pi - theta)) = 0.

Psi is symmetric about pi/2, and for theta < pi/2, as cos theta >= 1 - 2 theta/pi and alpha < 1,

    Psi' = pi cos theta - alpha (pi - 2 theta) >= (1 - alpha)(pi - 2 theta) > 0.

So in (0, pi) there are two roots, theta and pi - theta, if Psi(0) < 0 < Psi(pi/2), and none if
Psi(0) >= 0 or Psi(pi/2) < 0.  An interval X in (0, pi/2) contains the first one if Psi < 0 at its
lower and Psi > 0 at its upper end; then it lies in m - Psi(m)/Psi'(X) for m in X, by the mean value
theorem.  At a root the paper's formula gives

    v(T/2-) = -(F/omega) sin theta - (f/omega)(pi - theta) < 0    for every theta in (0, pi),

while its ansatz needs v > 0 on (tau, T/2): no root in (0, pi) belongs to a solution.
"""

from __future__ import annotations

from collections.abc import Iterable

from cap.checker.kernel.elementary import cos_sin
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Enclosure, Many, Quantity
from cap.checker.one_one.scaled import Scaled


class PaperEquation:
    """What a theorem claims about the roots."""

    CLAIM = Many({"theta": Quantity(), "velocity": Quantity("R omega")}, 0, 2)

    def __init__(self, theorem: Scaled) -> None:
        self.theorem, self.roots = theorem, theorem.claims["paper_roots"]
        self.alpha, self.pi = theorem.alpha, theorem.pi()

    def prove(self) -> None:
        """Prove that the roots claimed are all, and that none is valid."""
        low, high = self.psi(self.pi.integer(0)), self.psi(self.pi / 2)
        decided = not high.contains_zero() and not low.contains_zero()
        need(decided, "the number of roots of the paper's equation is not decided")
        expected = 2 if high.is_positive() and not low.is_positive() else 0
        need(len(self.roots) == expected, f"the paper's equation has {expected} roots")
        if self.roots:
            first = self.root(self.roots[0]["theta"])
            both = first, self.pi - first
            found = [{"theta": t, "velocity": self.velocity(t)} for t in both]
            self.theorem.confirm(paper_roots=found)
        self.theorem.step(f"the paper's equation has {expected} roots, and none gives a solution")

    def velocity(self, theta: Interval) -> Interval:
        """Return v(T/2-) by the paper's formula."""
        speed = cos_sin(theta)[1] + self.alpha * (self.pi - theta)
        return -speed * self.theorem.number(self.theorem.p.F / self.theorem.omega)

    def root(self, claim: Enclosure) -> Interval:
        """Return an enclosure of the root in (0, pi/2), which must lie in the claim."""
        where = "paper_roots[0].theta"
        X = Interval.enclosing(claim.lower, claim.upper, self.pi.bits)
        inside = X.is_positive() and X.is_before(self.pi / 2)
        need(inside, f"{where} is not in its half of (0, pi)")
        low, high = (self.psi(self.theorem.number(q)) for q in (claim.lower, claim.upper))
        need((-low).is_positive() and high.is_positive(), f"{where} may not contain the root")
        for _ in range(2):
            m, slope = X.midpoint(), self.pi * cos_sin(X)[0] - self.alpha * (self.pi - X * 2)
            X = X.intersection(m - self.psi(m) / slope)
        return X

    def psi(self, theta: Interval) -> Interval:
        """Return Psi(theta)."""
        friction = self.alpha * (self.pi.square() / 2 - theta * (self.pi - theta))
        return self.pi * cos_sin(theta)[1] - 2 - self.theorem.rho + friction

    def words(self) -> Iterable[str]:
        """Yield what is said of the roots."""
        yield _ROOTS if self.roots else _NO_ROOTS
        for root in self.roots:
            yield "; theta in {theta}, v in {velocity}".format_map(root)


_ROOTS = (
    "; the paper's equation of theta for orbits with one turn between hits has in (0, pi) exactly "
    "the two roots below, where its formula has the velocity v before the hit of l at T/2, against "
    "its premise v > 0: so neither is an orbit"
)
_NO_ROOTS = (
    "; the paper's equation of theta for orbits with one turn between hits has no root in (0, pi)"
)

PART = PaperEquation
