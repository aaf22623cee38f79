"""The existence equation eq:theta-eq of the paper, in units F = ω = 1: α = f/F, ρ = Rω²/F."""

from fractions import Fraction

from cap.audit.papers.mixed_dynamics.means.roots import roots as all_roots
from cap.sets import interval
from cap.sets.interval import Ball

WIDTH = Fraction(1, 10**20)  # of the enclosures, at most


def roots(alpha: Fraction, rho: Fraction) -> list[Ball]:
    """Return enclosures of all roots of Ψ in [0, π], ascending.

    Ψ(θ) = π sin θ - 2 - ρ + απ²/2 - αθ(π - θ), as in eq:Phi-existence divided by F.
    """
    pi, a, gap = interval.pi(), interval.ball(alpha), interval.ball(rho)

    def psi(theta: Ball) -> Ball:
        value: Ball = pi * theta.sin() - 2 - gap + a * (pi * pi / 2 - theta * (pi - theta))
        return value

    def slope(theta: Ball) -> Ball:
        value: Ball = pi * theta.cos() - a * (pi - 2 * theta)
        return value

    return all_roots(psi, slope, Ball(0), pi, WIDTH)
