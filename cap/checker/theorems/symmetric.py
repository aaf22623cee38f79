"""The theorem about symmetric (1,1) orbits: all of them, from the closed forms of ``impact``.

A symmetric orbit has sin phi = -c with c > 0 ("plus") or c < 0 ("minus"), W > 0, and a least speed
> 0: then it is genuine.  If f > 2F/pi there is none; f = 2F/pi is impossible as pi is irrational.

*The paper's equation* is about orbits that turn once between hits.  In the units of ``impact``

    Psi(theta) = pi sin theta - 2 - rho + alpha (pi^2/2 - theta (pi - theta)) = 0.

Psi is symmetric about pi/2, and for theta < pi/2, as cos theta >= 1 - 2 theta/pi and alpha < 1,

    Psi' = pi cos theta - alpha (pi - 2 theta) >= (1 - alpha)(pi - 2 theta) > 0.

So in (0, pi) there are two roots, theta and pi - theta, if Psi(0) < 0 < Psi(pi/2), and none if
Psi(0) >= 0 or Psi(pi/2) < 0.  A root is enclosed by Newton's operator m - Psi(m)/Psi'(X): if it
lies in X, it contains the only root in X [Moore].  At a root the paper's formula gives

    v(T/2-) = -(F/omega) sin theta - (f/omega)(pi - theta) < 0    for every theta in (0, pi),

while its ansatz needs v > 0 on (tau, T/2): no root in (0, pi) belongs to a solution.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from cap.checker.flow.fixed_point import Proof
from cap.checker.kernel.elementary import cos_sin
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.reading import Enclosure
from cap.checker.kernel.rejection import need
from cap.checker.one_one import closed_form as impact


class Scaled(Proof):
    """A theorem on (1,1) orbits: units and constants."""

    @property
    def rho(self) -> Interval:
        """R omega^2/F."""
        return self.number(self.R * self.omega**2 / self.p.F)

    def state(self, name: str, claims: dict[str, Any], orbit: impact.Symmetric) -> None:
        """Compare the claims about a symmetric orbit at t = 0 and at its hits."""
        R, omega = self.R, self.omega
        (gap, u), t_1 = orbit.start, orbit.t_1
        speed, length = self.number(self.p.F / omega), self.number(self.p.F / omega**2)
        times = [t * self.number(1 / omega) for t in (t_1, t_1 + self.pi())]
        self.compare(f"{name}x", claims["x"], self.number(self.p.r) - gap * length, R)
        self.compare(f"{name}v", claims["v"], u * speed, R * omega)
        self.compare(f"{name}hit_times", claims["hit_times"], times, 1 / omega)
        self.speeds(name, claims, orbit)

    def speeds(self, name: str, claims: dict[str, Any], orbit: impact.Symmetric) -> None:
        """Compare the claims about the speeds."""
        speed = self.number(self.p.F / self.omega)
        unit = self.R * self.omega
        self.compare(f"{name}hit_speed", claims["hit_speed"], orbit.hit_speed * speed, unit)
        self.compare(f"{name}least_speed", claims["least_speed"], orbit.slowest * speed, unit)


class SymmetricOrbits(Scaled):
    """All symmetric (1,1) orbits at given parameters."""

    def prove(self) -> None:
        """Prove the theorem."""
        limit = self.pi().integer(2) / self.pi()
        below = self.alpha.is_before(limit)
        need(below or limit.is_before(self.alpha), "f may be 2F/pi")
        for name, sign in (("plus", 1), ("minus", -1)):
            self.branch(name, sign, exists=below)
        self.bifurcations(limit)
        self.paper()

    @property
    def alpha(self) -> Interval:
        """f/F."""
        return self.number(self.p.f / self.p.F)

    def branch(self, name: str, sign: int, *, exists: bool) -> None:
        """Prove what is claimed about the orbit with this sign of c."""
        claims, where = self.claims["branches"][name], f"branches.{name}."
        orbit = impact.Symmetric.of(self.alpha, self.rho, sign) if exists else None
        if orbit is None or (-orbit.hit_speed).is_positive():
            need(claims is None, f"{where} a hit speed is not positive: there is no orbit")
            self.step(f"there is no orbit '{name}'")
            return
        need(orbit.hit_speed.is_positive(), f"{where} the sign of the hit speed is not decided")
        need(claims is not None, f"{where} the formula gives an orbit")
        if claims["genuine"] == "no":
            self.speeds(where, claims, orbit)
            need(claims["least_speed"].upper < 0, f"{where}least_speed is not negative")
            self.step(f"the orbit '{name}' of the formula is not genuine")
            return
        self.state(where, claims, orbit)
        half = -orbit.k + 2
        self.compare(f"{where}half_trace", claims["half_trace"], half, Fraction(1))
        self.compare(f"{where}trace", claims["trace"], half.square() - 2, Fraction(1))
        need(claims["least_speed"].lower > 0, f"{where}least_speed is not positive")
        self.kind(where, claims)
        self.step(f"the orbit '{name}' is genuine: {claims['type']}")

    def kind(self, where: str, claims: dict[str, Any]) -> None:
        """Check that the trace claimed has the type claimed."""
        trace = claims["trace"]
        if claims["type"] == "elliptic":
            need(trace.lower > -2 and trace.upper < 2, f"{where}trace is not in (-2, 2)")
        else:
            outside = trace.lower > 2 or trace.upper < -2
            need(outside, f"{where}trace does not exclude [-2, 2]")

    def bifurcations(self, limit: Interval) -> None:
        """Compare the values of f at which the type changes."""
        F = self.number(self.p.F)
        self.confirm("saddle_center", F * limit, self.p.F)
        for name, c in (
            ("pitchfork", impact.birth(self.rho)),
            ("minus_identity", impact.half_turn(self.rho)),
        ):
            claim = self.claims[name]
            need((c is None) == (claim is None), f"{name} exists, or not, against the claim")
            if c is not None:
                self.confirm(name, F * impact.friction(c), self.p.F)
        self.step("the values of f at which the symmetric orbits change contain what is computed")

    def paper(self) -> None:
        """Prove that the roots claimed of the paper's equation are all, and that none is valid."""
        roots, none = self.claims["paper_roots"], self.number(Fraction(0))
        low, high = self.psi(none), self.psi(self.pi() / 2)
        decided = not high.contains_zero() and not low.contains_zero()
        need(decided, "the number of roots of the paper's equation is not decided")
        expected = 2 if high.is_positive() and not low.is_positive() else 0
        need(len(roots) == expected, f"the paper's equation has {expected} roots")
        for n, claim in enumerate(roots):
            theta = self.root(n, claim["theta"])
            sin = cos_sin(theta)[1]
            late = sin + self.alpha * (self.pi() - theta)
            velocity = -late * self.number(self.p.F / self.omega)
            where, unit = f"paper_roots[{n}]", self.R * self.omega
            self.compare(f"{where}.theta", claim["theta"], theta, Fraction(1))
            self.compare(f"{where}.velocity", claim["velocity"], velocity, unit)
            need(claim["velocity"].upper < 0, f"{where}.velocity is not negative")
        self.step(f"the paper's equation has {expected} roots, and none gives a solution")

    def root(self, n: int, claim: Enclosure) -> Interval:
        """Return an enclosure of the n-th root, n = 0 or 1."""
        X, half = Interval.enclosing(claim.lower, claim.upper, self.hints["bits"]), self.pi() / 2
        whole = self.pi()
        inside = X.is_positive() and X.is_before(half) if n == 0 else half.is_before(X)
        need(inside and X.is_before(whole), f"paper_roots[{n}].theta is not in its half of (0, pi)")
        image = self.newton(X)
        lies = image.lies_in(claim.lower, claim.upper)
        need(lies, f"paper_roots[{n}].theta does not contain the enclosure computed")
        return self.newton(image).intersection(image)

    def newton(self, X: Interval) -> Interval:
        """Return Newton's operator of Psi."""
        m, whole = X.midpoint(), self.pi()
        slope = whole * cos_sin(X)[0] - self.alpha * (whole - X * 2)
        return m - self.psi(m) / slope

    def psi(self, theta: Interval) -> Interval:
        """Return Psi(theta)."""
        whole = self.pi()
        friction = self.alpha * (whole.square() / 2 - theta * (whole - theta))
        return whole * cos_sin(theta)[1] - 2 - self.rho + friction
