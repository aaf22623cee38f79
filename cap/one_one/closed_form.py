"""The (1,1) orbits in closed form: T-periodic, with a velocity that never vanishes and one hit of
each wall per period.  (Others hit each wall once, too, but turn or stick.)

Units: time 1/ω, length F/ω², speed F/ω.  Then α = f/F and ρ = Rω²/F are all that matters.  Such an
orbit hits the right wall at t1 and the left wall at t2, and its speed u = |v| obeys

    u' = -cos t - α  on [t1, t2],      u' = cos t - α  on [t2, t1 + 2π],

is continuous, periodic, and has the integral ρ over both.  Write t1 = φ + π/2 - δ, t2 = φ + 3π/2 +
δ with |δ| < π/2, and W for the mean of the speeds at the hits, u(t1) = W + αδ and u(t2) = W - αδ.
Then that u is periodic, and the difference and the sum of the two integrals, are

    2 cos φ cos δ = πα,   Wδ = -(π/2) sin φ sin δ,   πW + 2 sin φ (cos δ + δ sin δ) = ρ,

so cos φ > 0, and with S = -sin φ the orbits are

    symmetric:   δ = 0,   S = ±sqrt(1 - (πα/2)²),   W = (ρ + 2S)/π;
    asymmetric:  δ != 0,  S = ρ/G(δ),  G = (π²/2) sin δ/δ - 2 cos δ - 2δ sin δ,
                 α = (2/π) cos δ sqrt(1 - S²),   W = (π/2) S sin δ/δ,

provided that u > 0.  (`cap.proofs.one_one` derives this by machine.)  Now G(0) = π²/2 - 2,
G(π/2) = 0 and

    G' = (π²/2)(δ cos δ - sin δ)/δ² - 2δ cos δ < 0   on (0, π/2),

so for ρ < π²/2 - 2 the function α(δ) is analytic and decreases strictly, from α(0), where the
orbit is symmetric, to 0, where S = 1; for ρ >= π²/2 - 2 there is none.  So for each α at most one
pair ±δ of asymmetric orbits exists.  (x, v, t) -> (l + r - x, -v, t + π) maps one to the other.

On the first flight u' changes from - to + only at π/2 + arcsin α, on the second only at 3π/2 +
arcsin α. These lie arcsin α + arcsin S ± δ after the hits, and if that is on the flight u is least
there.

In (t, E), E = u²/2, at a hit, whose area is that of (x, v), the derivatives of flights and hits
give

    trace Φ' = 2 - 2π(κ1 + κ2) + κ1 κ2 (π² - 4δ²),   κ1 = 2 cos t1/u(t1),  κ2 = -2 cos t2/u(t2).
"""

from dataclasses import dataclass, replace
from typing import Any

from cap.errors import NotProved
from cap.flow.flight import place, velocity
from cap.sets import interval
from cap.sets.elementary import asin, sinc, sqrt
from cap.sets.interval import Ball, pi


@dataclass(frozen=True)
class Orbit:
    """The values of δ, α, ρ, S, cos φ and W, of one scalar type.

    They define an orbit if u > 0 on both flights: see `least_speed`.
    """

    delta: Any
    alpha: Any
    rho: Any
    S: Any
    cos_phi: Any
    mean_speed: Any

    @property
    def speeds(self) -> tuple[Any, Any]:
        """The speeds at the right hit and at the left hit."""
        half = self.alpha * self.delta
        return self.mean_speed + half, self.mean_speed - half

    @property
    def phases(self) -> tuple[tuple[Any, Any], tuple[Any, Any]]:
        """(sin t1, cos t1) and (sin t2, cos t2)."""
        sin, cos = self.delta.sin_cos()
        a, b, c, d = self.cos_phi * cos, self.S * sin, self.S * cos, self.cos_phi * sin
        return (a - b, c + d), (-a - b, d - c)

    @property
    def durations(self) -> tuple[Any, Any]:
        """The durations of the flights after the right hit and after the left hit."""
        return pi() + 2 * self.delta, pi() - 2 * self.delta

    def trace(self) -> Any:
        """Return the trace of Φ'."""
        (u1, u2), ((_, cos1), (_, cos2)) = self.speeds, self.phases
        k1, k2 = 2 * cos1 / u1, -2 * cos2 / u2
        d1, d2 = self.durations
        return 2 - 2 * pi() * (k1 + k2) + k1 * k2 * (d1 * d2)

    def delays(self) -> tuple[Any, Any]:
        """Return how long after the two hits u has its local minimum, if it is on the flight."""
        middle = asin(self.alpha) + asin(self.S)
        return middle + self.delta, middle - self.delta

    def slowest(self) -> tuple[Any, Any]:
        """Return u at the local minima of the flights after the right hit and the left hit."""
        (u1, u2), ((sin1, _), (sin2, _)) = self.speeds, self.phases
        delay1, delay2 = self.delays()
        lost = sqrt(1 - self.alpha * self.alpha)
        first = velocity(u1 + sin1, delay1, self.alpha, -lost)
        return first, velocity(u2 - sin2, delay2, self.alpha, -lost)

    def least_speed(self) -> Ball:
        """Return the least of u, over balls: at a hit, or at a local minimum on a flight."""
        least: Ball = interval.least(*self.speeds)
        flights = zip(self.delays(), self.durations, self.slowest(), strict=True)
        for delay, duration, speed in flights:
            if 0 < delay < duration:
                least = interval.least(least, speed)
            elif not (delay < 0 or delay > duration):
                raise NotProved("least speed", "it may be that at a hit", {"delay": delay})
        return least

    def right_hit(self) -> Ball:
        """Return t1 in (-π/2 - δ, π - δ), over balls."""
        t1: Ball = pi() / 2 - self.delta - Ball.atan2(self.S, self.cos_phi)
        return t1

    def start(self) -> tuple[Ball, Ball]:
        """Return the distance from the right wall, and the velocity, at t = 0.

        Assumes t1 > 0 unless t1 < 0: the mass is on its way to the wall, or back from there.
        """
        t1, (sin, cos), u1 = self.right_hit(), self.phases[0], self.speeds[0]
        s = -1 if t1 < 0 else 1
        V, friction = s * u1 - sin, s * self.alpha
        return -place(cos, V, -t1, friction / 2, 1), velocity(V, -t1, friction, 0)

    def mirrored(self) -> "Orbit":
        """Return the mirror image."""
        return replace(self, delta=-self.delta)


def symmetric(alpha: Ball, rho: Ball, sign: int) -> Orbit:
    """Return the symmetric orbit with this sign of S = ±sqrt(1 - (πα/2)²); 0 <= πα/2 <= 1."""
    cos_phi = pi() * alpha / 2
    S = sign * (1 - cos_phi * cos_phi).sqrt()
    return Orbit(Ball(0), alpha, rho, S, cos_phi, (rho + 2 * S) / pi())


def friction(S: Ball) -> Ball:
    """Return α of the symmetric orbits with this S or -S."""
    return 2 / pi() * (1 - S * S).sqrt()


def birth(rho: Ball) -> Ball:
    """Return S where δ = 0 on the curve of asymmetric orbits; above 1 there is none."""
    return 2 * rho / (pi() ** 2 - 4)


def asymmetric(delta: Any, rho: Ball) -> Orbit:
    """Return the asymmetric orbit at δ, a ball or Taylor model or jet; indeterminate if S > 1."""
    sin, cos = delta.sin_cos()
    ratio = sinc(delta)
    S = rho / (pi() * pi() / 2 * ratio - 2 * cos - 2 * (delta * sin))
    cos_phi = sqrt(1 - S * S)
    return Orbit(delta, 2 / pi() * (cos_phi * cos), rho, S, cos_phi, pi() / 2 * (S * ratio))
