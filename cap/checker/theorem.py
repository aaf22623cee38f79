"""The theorems by name; and of the first two, after the fixed point and its orbit, the conclusion.

*Both* are about one period without losses: mu = 0, e = 1, hits alternately at the two walls.

*Saddle.*  The multipliers are the zeros of e^2 - trace e + 1; for |trace| > 2 the outer one is
(trace +- sqrt(trace^2 - 4))/2 with the sign of the trace, and the inner one is its inverse.

*Elliptic.*  |trace| < 2, no resonance of order at most four, a twist that is not zero.

*The remainder.*  On a square D around K(S), in the box and reaching rho to each side, Lagrange's
form bounds what the Taylor polynomial of degree N leaves on the disk of radius rho by the sum over
i + j = n = N + 1 of

    max |c_ij(D)| max |dx^i dv^j|,      max |dx^i dv^j| = rho^n sqrt(i^i j^j / n^n).
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from itertools import pairwise

from cap.checker.flow.fixed_point import FixedPoint, Point, Proof, contains, ends
from cap.checker.flow.itinerary import Passage, PeriodMap
from cap.checker.flow.normal_form import (
    EllipticFrame,
    elliptic_frame,
    in_complex_coordinate,
    twists,
)
from cap.checker.kernel.certificate import Certificate, read
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred
from cap.checker.kernel.rejection import need
from cap.checker.theorems.branch import Branch
from cap.checker.theorems.capture import Capture
from cap.checker.theorems.impulse import Impulse
from cap.checker.theorems.periodic import Periodic
from cap.checker.theorems.persistence import Persistence
from cap.checker.theorems.pitchfork import Pitchfork
from cap.checker.theorems.symmetric import SymmetricOrbits

RESONANCES = {name: Fraction(name) for name in ("0", "1/4", "1/3", "1/2")}


def check(data: bytes, step: Callable[[str], None]) -> Certificate:
    """Return the certificate if its theorem is proved; otherwise raise an exception.

    Each step is reported in one line when it is done.
    """
    certificate = read(data)
    step(f"the certificate has the form of the theorem '{certificate.theorem}'")
    THEOREMS[certificate.theorem](certificate, step).prove()
    return certificate


class Conservative(FixedPoint):
    """The fixed point of an orbit that hits the walls alternately, without losses."""

    @property
    def phi(self) -> PeriodMap:
        """The map over one period; the first wall is r if v > 0."""
        windows, first = self.hints["hit_times"], int(self.claims["box"]["v"].lower <= 0)
        words = [("hit r", "hit l")[(first + n) % 2] for n in range(len(windows))]
        return PeriodMap(self.p, words, [ends(w) for w in windows])

    def orbit(self, fixed_point: Point, orbit: Passage) -> None:
        """Compare the claims of both theorems about P* with what is computed."""
        R, omega, one = self.R, self.omega, Fraction(1)
        (a, b), (c, d) = ([w[1, 0], w[0, 1]] for w in (orbit.x, orbit.v))
        self.confirm("x", fixed_point[0], R)
        self.confirm("v", fixed_point[1], R * omega)
        self.confirm("hit_times", [h.moment.t.value for h in orbit.hits], 1 / omega)
        self.confirm("hit_speeds", [h.hit_speed for h in orbit.hits], R * omega)
        forces = [h.forcing.magnitude() - self.number(self.p.f) for h in orbit.hits]
        self.confirm("hit_forcing", forces, self.p.F)
        self.confirm("least_speed", orbit.least_speed, R * omega)
        self.confirm("jacobian", [[a, b], [c, d]], [[one, 1 / omega], [omega, one]])
        self.confirm("trace", a + d, one)
        self.confirm("determinant", a * d - b * c, one)
        self.step("the claims about the orbit of P* contain what is computed")
        self.conclusion_of_both()

    def conclusion_of_both(self) -> None:
        """Check what the numbers claimed must satisfy in both theorems."""
        claims, times = self.claims, self.claims["hit_times"]
        need(times[0].lower > 0, "the first hit time is not positive")
        increasing = all(s.upper < t.lower for s, t in pairwise(times))
        need(increasing, "the hit times are not increasing")
        need(times[-1].upper * self.omega < 2 * self.pi().lower, "the last hit is not before T")
        need(all(u.lower > 0 for u in claims["hit_speeds"]), "a hit speed is not positive")
        need(claims["least_speed"].lower > 0, "the least speed is not positive")
        need(contains(claims["determinant"], 1), "the determinant excludes 1")


class Saddle(Conservative):
    """The fixed point is hyperbolic."""

    def conclude(self, fixed_point: Point, orbit: Passage) -> None:  # noqa: ARG002
        """Prove that one multiplier lies outside the unit circle and one inside."""
        trace = orbit.x[1, 0] + orbit.v[0, 1]
        sign = 1 if trace.is_positive() else -1
        outer = (trace + (trace.square() - 4).sqrt() * sign) / 2
        self.confirm("multipliers", [outer, outer.integer(1) / outer], Fraction(1))
        self.hyperbolicity()

    def hyperbolicity(self) -> None:
        """Check what the numbers claimed must satisfy."""
        trace, (outer, inner) = self.claims["trace"], self.claims["multipliers"]
        need(trace.lower > 2 or trace.upper < -2, "the trace does not exclude [-2, 2]")
        outside = outer.lower > 1 or outer.upper < -1
        need(outside, "the outer multiplier may lie in the unit circle")
        inside = inner.lower > -1 and inner.upper < 1
        need(inside, "the inner multiplier may lie outside the unit circle")
        self.step("one multiplier lies outside the unit circle and one inside")


class Elliptic(Conservative):
    """The fixed point is elliptic, without low resonance, with twist."""

    @property
    def orbit_order(self) -> int:  # type: ignore[override]
        """The degree of the Taylor polynomial."""
        return int(self.hints["order"])

    def conclude(self, fixed_point: Point, orbit: Passage) -> None:
        """Prove ellipticity, the absence of low resonances, the twist, and the remainder."""
        x, v = orbit.x.box, orbit.v.box
        frame = elliptic_frame([[w.coefficients[1, 0], w.coefficients[0, 1]] for w in (x, v)])
        self.rotation(frame)
        self.taylor({"x": orbit.x, "v": orbit.v})
        self.twist(twists(in_complex_coordinate(x, v, frame)))
        self.ellipticity()
        self.remainder(fixed_point)

    def rotation(self, frame: EllipticFrame) -> None:
        """Compare the rotation angle and its distances from the resonances."""
        number, one = frame.angle.magnitude() / (self.pi() * 2), Fraction(1)
        self.confirm("rotation_angle", frame.angle, one)
        self.confirm("rotation_number", number, one)
        for name, claim in self.claims["resonance_distances"].items():
            distance = (number - self.number(RESONANCES[name])).magnitude()
            self.compare(f"resonance_distances.{name}", claim, distance, one)

    def taylor(self, components: dict[str, Centred]) -> None:
        """Compare the Taylor coefficients of Phi at P*."""
        for name, unit in (("x", self.R), ("v", self.R * self.omega)):
            for power, claim in self.claims["taylor"][name].items():
                i, j = (int(n) for n in power.split(","))
                scale = unit / self.R**i / (self.R * self.omega) ** j
                self.compare(f"taylor.{name}.{power}", claim, components[name][i, j], scale)
        self.step("the Taylor coefficients of Phi at P* contain what is computed")

    def twist(self, tau: list[Interval]) -> None:
        """Compare the twists."""
        units = [1 / (self.R**2 * self.omega) ** k for k in range(1, len(tau) + 1)]
        self.confirm("twist", tau[0], units[0])
        self.confirm("twist_action", tau[0] * 2, units[0])
        self.confirm("higher_twists", tau[1:], units[1:])
        self.step("the normal form exists, preserves area, and has the twists claimed")

    def ellipticity(self) -> None:
        """Check what the numbers claimed must satisfy."""
        claims, below_pi = self.claims, self.pi().lower
        trace, angle, number = (claims[k] for k in ("trace", "rotation_angle", "rotation_number"))
        need(trace.lower > -2 and trace.upper < 2, "the trace is not in (-2, 2)")
        within = angle.lower > -below_pi and angle.upper < below_pi
        need(within, "the rotation angle is not in (-pi, pi)")
        need(not contains(angle, 0), "the rotation angle does not exclude 0")
        half = Fraction(1, 2)
        need(number.lower > 0 and number.upper < half, "the rotation number is not in (0, 1/2)")
        distances = claims["resonance_distances"].values()
        need(all(d.lower > 0 for d in distances), "a resonance distance is not positive")
        self.step("P* is elliptic, without resonance of order at most four")
        for name in ("twist", "twist_action"):
            need(not contains(claims[name], 0), f"{name} does not exclude 0")
        self.step("the first twist is not zero")

    def remainder(self, fixed_point: Point) -> None:
        """Prove the bound of what the Taylor polynomial leaves on the disk."""
        claim, n = self.claims["remainder"], self.hints["order"] + 1
        rho = claim["radius"]
        need(rho > 0, "the radius of the remainder is not positive")
        square = [z + Interval.enclosing(-rho, rho, self.hints["bits"]) for z in fixed_point]
        for z, name in zip(square, ("x", "v"), strict=True):
            box = self.claims["box"][name]
            need(z.lies_in(box.lower, box.upper), "the disk of the remainder is not in the box")
        image = self.near(square, fixed_point, n)
        for name, component in (("x", image.x), ("v", image.v)):
            bound = self.lagrange(component, n).upper * rho**n
            need(bound <= claim[name], f"the remainder of {name} may be larger than claimed")
        self.step(
            f"on the disk, Phi is as close to its Taylor polynomial of degree {n - 1} as claimed"
        )

    def lagrange(self, component: Centred, n: int) -> Interval:
        """Return the sum of max |c_ij| sqrt(i^i j^j / n^n) over i + j = n."""
        total = self.number(Fraction(0))
        for i in range(n + 1):
            weight = self.number(Fraction(i**i * (n - i) ** (n - i), n**n)).sqrt()
            total = total + component[i, n - i].magnitude() * weight
        return total


THEOREMS: dict[str, Callable[[Certificate, Callable[[str], None]], Proof]] = {
    "saddle": Saddle,
    "elliptic": Elliptic,
    "periodic": Periodic,
    "persistence": Persistence,
    "capture": Capture,
    "symmetric": SymmetricOrbits,
    "pitchfork": Pitchfork,
    "branch": Branch,
    "impulse": Impulse,
}
