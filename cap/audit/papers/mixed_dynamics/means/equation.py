"""The existence equation eq:theta-eq of the paper, in units F = ω = 1: α = f/F, ρ = Rω²/F."""

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from cap.audit.means.algebra import symbols
from cap.audit.means.balls import roots
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.sets import interval
from cap.sets.interval import Ball


@dataclass(frozen=True)
class Equation:
    """Ψ(θ) = π sin θ - 2 - ρ + απ²/2 - αθ(π - θ), as in eq:Phi-existence divided by F."""

    alpha: Fraction
    rho: Fraction

    def value(self, theta: Ball) -> Ball:
        """Return Ψ(θ)."""
        pi, alpha, rho = interval.pi(), interval.ball(self.alpha), interval.ball(self.rho)
        psi: Ball = pi * theta.sin() - 2 - rho + alpha * (pi * pi / 2 - theta * (pi - theta))
        return psi

    def slope(self, theta: Ball) -> Ball:
        """Return Ψ'(θ)."""
        pi, alpha = interval.pi(), interval.ball(self.alpha)
        slope: Ball = pi * theta.cos() - alpha * (pi - 2 * theta)
        return slope

    def roots(self) -> list[Ball]:
        """Return enclosures of all roots in [0, π], ascending."""
        return roots(self.value, self.slope, Ball(0), interval.pi())

    def both(self) -> tuple[Ball, Ball]:
        """Return sharp enclosures of its roots, ascending, if there are two."""
        found = [self.bisected(root) for root in self.roots()]
        need(len(found) == 2, "there are not two roots", roots=found)
        return found[0], found[1]

    def bisected(self, root: Ball, places: int = 20) -> Ball:
        """Return a sharper enclosure of a root that was isolated."""
        a, b = interval.ends(root)
        rising = self.value(interval.ball(b)) > 0
        while (b - a) * 10**places > 1:
            middle = (a + b) / 2
            above = self.value(interval.ball(middle)) > 0
            a, b = (a, middle) if above == rising else (middle, b)
        return interval.hull(interval.ball(a), interval.ball(b))


def psi() -> tuple[Any, Any, tuple[Any, Any, Any, Any]]:
    """Return Ψ of eq:Phi-existence, θ, and the symbols F, f, R, ω."""
    F, f, R, w = symbols("F f R omega")
    theta = sp.Symbol("theta", real=True)
    value = F * sp.pi * sp.sin(theta) - 2 * F - R * w**2
    return value + f * sp.pi**2 / 2 - f * theta * (sp.pi - theta), theta, (F, f, R, w)
