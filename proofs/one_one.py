"""The closed form of the (1,1) orbits, derived by machine: of the T-periodic orbits whose velocity
never vanishes and that hit each wall once per period.

`cap.one_one.closed_form` states it.  Here the flights are integrated, and that each step of the
derivation is an identity is left to a computer algebra system.  Units: time 1/ω, length F/ω², speed
F/ω.
"""

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from cap.certificate.writer import Pair
from cap.errors import NotProved
from cap.one_one.closed_form import Orbit, asymmetric, birth, friction
from cap.proofs.fixed_point import Setting
from cap.sets import bisection, interval
from cap.sets.interval import Ball


def lemma_1_closed_form() -> None:
    """*Statement.* The formulas of `cap.one_one.closed_form` hold.

    *Computed.* Each of the `identities` simplifies to 0.
    """
    import sympy as sp  # noqa: PLC0415 (it takes a third of a second)

    for name, difference in identities():
        if sp.simplify(sp.expand(sp.expand_trig(difference))) != 0:
            raise NotProved("Lemma 1", f"this identity was not confirmed: {name}")


def identities() -> Iterator[tuple[str, Any]]:
    """Give the steps of the derivation: a sentence, and an expression that is 0 if it is true."""
    yield from _flights()
    yield from _linear_part()
    yield from _symmetric_orbit()
    yield from _asymmetric_orbits()
    yield from _least_speed()


def _flights() -> Iterator[tuple[str, Any]]:
    """The three equations for δ, φ and W."""
    import sympy as sp  # noqa: PLC0415

    t, delta, phi, W, alpha = sp.symbols("t delta phi W alpha", real=True)
    t1, t2 = phi + sp.pi / 2 - delta, phi + 3 * sp.pi / 2 + delta
    left = W + alpha * delta - (sp.sin(t) - sp.sin(t1)) - alpha * (t - t1)
    u2 = left.subs(t, t2)
    right = u2 + sp.sin(t) - sp.sin(t2) - alpha * (t - t2)
    yield "u' = -cos t - α after the right hit", sp.diff(left, t) + sp.cos(t) + alpha
    yield "u' = cos t - α after the left hit", sp.diff(right, t) - sp.cos(t) + alpha
    change = right.subs(t, t1 + 2 * sp.pi) - left.subs(t, t1)
    yield (
        "over a period u changes by 4 cos φ cos δ - 2πα",
        change - (4 * sp.cos(phi) * sp.cos(delta) - 2 * sp.pi * alpha),
    )
    periodic = {alpha: 2 * sp.cos(phi) * sp.cos(delta) / sp.pi}
    yield "the speed at the left hit is W - αδ", (u2 - W + alpha * delta).subs(periodic)
    first = sp.integrate(sp.expand(left), (t, t1, t2)).subs(periodic)
    second = sp.integrate(sp.expand(right), (t, t2, t1 + 2 * sp.pi)).subs(periodic)
    yield (
        "the distances differ by 4 Wδ + 2π sin φ sin δ",
        first - second - (4 * W * delta + 2 * sp.pi * sp.sin(phi) * sp.sin(delta)),
    )
    arc = sp.cos(delta) + delta * sp.sin(delta)
    yield (
        "the distances add up to 2πW + 4 sin φ (cos δ + δ sin δ)",
        first + second - (2 * sp.pi * W + 4 * sp.sin(phi) * arc),
    )


def _linear_part() -> Iterator[tuple[str, Any]]:
    """The traces of Φ' and of the half-period map."""
    import sympy as sp  # noqa: PLC0415

    k1, k2, delta, S, rho = sp.symbols("k1 k2 delta S rho", real=True)

    def flight(duration: Any) -> Any:
        return sp.Matrix([[1, duration], [0, 1]])

    def hit(kappa: Any) -> Any:
        """The saltation of an elastic hit: -1 times a shear, with κ = 2 F cos ωt/v, up to sign."""
        return -sp.Matrix([[1, 0], [-kappa, 1]])

    d1, d2 = sp.pi + 2 * delta, sp.pi - 2 * delta
    product = hit(k2) * flight(d1) * hit(k1) * flight(d2)
    claimed = 2 - 2 * sp.pi * (k1 + k2) + k1 * k2 * (sp.pi**2 - 4 * delta**2)
    yield "the trace of Φ' is 2 - 2π(κ1 + κ2) + κ1 κ2 (π² - 4δ²)", product.trace() - claimed
    kappa = 2 * S / ((rho + 2 * S) / sp.pi)
    half = -hit(kappa) * flight(sp.pi)  # the reflection is -1
    k = 2 * sp.pi**2 * S / (rho + 2 * S)
    yield "the half-period map of the symmetric orbit has the trace 2 - k", half.trace() - (2 - k)
    same = {k1: kappa, k2: kappa, delta: 0}
    yield "Φ' has the trace (2 - k)² - 2", claimed.subs(same) - ((2 - k) ** 2 - 2)


def _symmetric_orbit() -> Iterator[tuple[str, Any]]:
    """Where it bifurcates."""
    import sympy as sp  # noqa: PLC0415

    S, rho, nu = sp.symbols("S rho nu", positive=True)
    k = 2 * sp.pi**2 * S / (rho + 2 * S)
    yield "k = 4 where S = 2ρ/(π² - 4)", k.subs(S, 2 * rho / (sp.pi**2 - 4)) - 4
    yield "k = 2 where S = ρ/(π² - 2)", k.subs(S, rho / (sp.pi**2 - 2)) - 2
    yield "k increases with S", sp.diff(k, S) - 2 * sp.pi**2 * rho / (rho + 2 * S) ** 2
    alpha = 2 / sp.pi - nu
    square = 1 - (sp.pi * alpha / 2) ** 2
    yield "S² = πν - (πν/2)², ν = 2/π - α", square - (sp.pi * nu - (sp.pi * nu / 2) ** 2)
    trace = (2 - k) ** 2 - 2
    yield "trace Φ' = 2 - 8π² S/ρ + O(S²)", sp.diff(trace, S).subs(S, 0) + 8 * sp.pi**2 / rho


def _least_speed() -> Iterator[tuple[str, Any]]:
    """Sine and cosine of the hit times, and u at its local minima; S = sin σ, α = sin β."""
    import sympy as sp  # noqa: PLC0415

    t, delta, sigma, beta, W = sp.symbols("t delta sigma beta W", real=True)
    S, C, alpha = sp.sin(sigma), sp.cos(sigma), sp.sin(beta)
    sin, cos = sp.sin(delta), sp.cos(delta)
    t1, t2 = -sigma + sp.pi / 2 - delta, -sigma + 3 * sp.pi / 2 + delta
    yield "sin t1", sp.sin(t1) - (C * cos - S * sin)
    yield "cos t1", sp.cos(t1) - (S * cos + C * sin)
    yield "sin t2", sp.sin(t2) + (C * cos + S * sin)
    yield "cos t2", sp.cos(t2) - (C * sin - S * cos)
    left = W + alpha * delta - (sp.sin(t) - sp.sin(t1)) - alpha * (t - t1)
    right = W - alpha * delta + sp.sin(t) - sp.sin(t2) - alpha * (t - t2)
    for name, u, hit, side in (("right", left, t1, 1), ("left", right, t2, -1)):
        delay = beta + sigma + side * delta
        yield f"after the {name} hit u' = 0", sp.diff(u, t).subs(t, hit + delay)
        value = u.subs(t, hit) + side * sp.sin(hit) - sp.cos(beta) - alpha * delay
        yield f"after the {name} hit u there", u.subs(t, hit + delay) - value


def _asymmetric_orbits() -> Iterator[tuple[str, Any]]:
    """The equations for S and W, and the derivative of G."""
    import sympy as sp  # noqa: PLC0415

    delta, S = sp.symbols("delta S", positive=True)
    G = sp.pi**2 / 2 * sp.sin(delta) / delta - 2 * sp.cos(delta) - 2 * delta * sp.sin(delta)
    W = sp.pi / 2 * S * sp.sin(delta) / delta
    arc = sp.cos(delta) + delta * sp.sin(delta)
    yield "πW - 2S (cos δ + δ sin δ) = S G", sp.pi * W - 2 * S * arc - S * G
    slope = sp.pi**2 / 2 * (delta * sp.cos(delta) - sp.sin(delta)) / delta**2
    yield "the derivative of G", sp.diff(G, delta) - slope + 2 * delta * sp.cos(delta)
    bracket = delta * sp.cos(delta) - sp.sin(delta)
    yield "δ cos δ - sin δ decreases from 0", sp.diff(bracket, delta) + delta * sp.sin(delta)
    yield "G(π/2) = 0", G.subs(delta, sp.pi / 2)


def asymmetry(alpha: Ball, rho: Ball, places: int) -> tuple[Fraction, Fraction]:
    """Return δ between which α(δ) passes ``alpha``, neighbouring multiples of 10^-places.

    At the second there may be no orbit, if ``alpha`` is near 0.  Raises `NotProved` if a sign is
    not certain, also where S may be 1.
    """

    def above(delta: Fraction) -> Ball:
        orbit = asymmetric(interval.ball(delta), rho)
        return Ball(-1) if orbit.S > 1 else orbit.alpha - alpha

    return bisection.crossing(above, Fraction(0), Fraction(157, 100), places)


def pair_at(
    alpha: Ball, rho: Ball, places: int, step: str
) -> tuple[tuple[Fraction, Fraction], Orbit] | None:
    """Return δ of the asymmetric orbits between two decimals, and the one of δ > 0.

    None above their birth; raises `NotProved` with the ``step`` if they may be born here.
    """
    S = birth(rho)
    if S > 1 or alpha > friction(S):
        return None
    if not alpha < friction(S):
        raise NotProved(step, "a pair may be born at these parameters", {"f/F": alpha})
    ends = asymmetry(alpha, rho, places)
    return ends, asymmetric(interval.hull(*map(interval.ball, ends)), rho)


class Scale:
    """From scaled units to those of the parameters, and to claims."""

    def __init__(self, setting: Setting) -> None:
        p = setting.parameters
        self.setting, self.p = setting, p
        self.rho = interval.ball(p.R * p.omega**2 / p.F)
        self.omega, self.F = interval.ball(p.omega), interval.ball(p.F)

    def time(self, t: Ball) -> Pair:
        """Return the claim on a time."""
        return self._pair(t / self.omega, self.setting.units.time)

    def speed(self, u: Ball) -> Pair:
        """Return the claim on a speed."""
        return self._pair(u * self.F / self.omega, self.setting.units.speed)

    def length(self, x: Ball) -> Pair:
        """Return the claim on a place, which is in the units of the parameters already."""
        return self._pair(x, self.setting.units.length)

    def force(self, alpha: Ball) -> Pair:
        """Return the claim on a force, αF."""
        return self._pair(alpha * self.F, self.setting.units.force)

    def per_force(self, x: Ball) -> Pair:
        """Return the claim on a derivative by α, as one by f."""
        return self._pair(x / self.F, 1 / self.setting.units.force)

    def number(self, x: Ball) -> Pair:
        """Return the claim on a number without unit."""
        return self._pair(x, Fraction(1))

    def state(self, orbit: Orbit) -> dict[str, Any]:
        """Return the claims on a symmetric orbit: the state at t = 0, hit times, hit speed."""
        t1, (way, v0) = orbit.right_hit(), orbit.start()
        x0 = interval.ball(self.p.r) - way * self.F / self.omega**2
        return {
            "x": self.length(x0),
            "v": self.speed(v0),
            "hit_times": [self.time(t1), self.time(t1 + interval.pi())],
            "hit_speed": self.speed(orbit.mean_speed),
        }

    def _pair(self, x: Ball, unit: Fraction) -> Pair:
        return self.setting.rounding.loosely(x, unit)
