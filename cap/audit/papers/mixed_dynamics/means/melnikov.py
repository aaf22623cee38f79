"""The integrals of Section 6 over the line: in closed form, and by quadrature in balls.

    ∫ sech u du             = π
    ∫ sech u cos ξu du      = π sech(πξ/2)
    ∫ sech u tanh u sin ξu  = πξ sech(πξ/2)
    ∫ sech u tanh u cos ξu  = 0
    ∫ sech² u cos ξu du     = πξ / sinh(πξ/2),   ξ not 0

*Proof.*  sech(u + iπ) = -sech u, and sech has in 0 < Im u < π the pole iπ/2 alone, with the residue
-i.  So ∫ sech u e^(iξu) du (1 + e^(-πξ)) = 2πi (-i) e^(-πξ/2), the second line; ξ = 0 is the first.
By parts, with (sech)' = -sech tanh, the third is ξ times the second.  The fourth integrand is odd.
(tanh)' = sech², so by parts the last is ξ ∫ tanh u sin ξu du, as a limit of means; directly: the
double pole of sech² at iπ/2 has the part -1/(u - iπ/2)², sech² has the period iπ, so ∫ sech² u
e^(iξu) du (1 - e^(-πξ)) = 2πi (-iξ) e^(-πξ/2).  QED
"""

from collections.abc import Callable
from fractions import Fraction
from typing import NamedTuple

from cap.audit.means.need import need
from cap.sets import interval
from cap.sets.interval import Ball, ComplexBall

REACH = 80  # of the part that is integrated; the rest is bounded


def over_the_line(integrand: Callable[[ComplexBall], ComplexBall], weight: int) -> Ball:
    """Enclose the integral of a function with |g(u)| <= ``weight`` exp(-|u|) over the reals.

    The caller guarantees this bound, and that the function is meromorphic: a region with a pole
    in it gives an enclosure that is not finite, so whether it is holomorphic need not be asked.
    """
    reach = Ball(REACH)
    part = ComplexBall.integral(lambda u, _analytic: integrand(u), -reach, reach)
    need(part.is_finite(), "the quadrature failed", value=part)
    rest = 2 * weight * (-reach).exp()
    whole: Ball = part.real + interval.symmetric(rest)
    return whole


class Integral(NamedTuple):
    """An integral that depends on ξ: its integrand at (u, ξ), and its closed form.

    On the line the integrand is at most ``weight`` exp(-|u|).
    """

    integrand: Callable[[ComplexBall, Ball], ComplexBall]
    weight: int
    closed: Callable[[Ball], Ball]

    def by_quadrature(self, xi: Ball) -> Ball:
        """Enclose it by quadrature."""
        return over_the_line(lambda u: self.integrand(u, xi), self.weight)


def integrals(name: str, frequencies: list[Fraction]) -> list[Ball]:
    """Return an integral by quadrature, where it overlaps its closed form, at some ξ."""
    own, found = INTEGRALS[name], []
    for xi in map(interval.ball, frequencies):
        found.append(own.by_quadrature(xi))
        need(found[-1].overlaps(own.closed(xi)), f"{name}: the closed form is another", xi=xi)
    return found


def _half(xi: Ball) -> Ball:
    return interval.pi() * xi / 2


def _sech(u: ComplexBall) -> ComplexBall:
    return 1 / u.cosh()


def _sech_tanh(u: ComplexBall) -> ComplexBall:
    """Return sech u tanh u, on the line at most 2 exp(-|u|) in size."""
    inverse = 1 / u.cosh()
    value: ComplexBall = inverse * inverse * u.sinh()
    return value


INTEGRALS = {
    "sech": Integral(lambda u, _xi: _sech(u), 2, lambda _xi: interval.pi()),
    "sech tanh sin": Integral(
        lambda u, xi: _sech_tanh(u) * (u * xi).sin(), 2, lambda xi: 2 * _half(xi) / _half(xi).cosh()
    ),
    "sech tanh cos": Integral(
        lambda u, xi: _sech_tanh(u) * (u * xi).cos(), 2, lambda _xi: interval.ZERO
    ),
    "sech^2 cos": Integral(
        lambda u, xi: (u * xi).cos() / (u.cosh() * u.cosh()),
        4,
        lambda xi: 2 * _half(xi) / _half(xi).sinh(),
    ),
}
