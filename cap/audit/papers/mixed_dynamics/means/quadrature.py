"""Integrals of meromorphic functions over the real line, enclosed."""

from collections.abc import Callable

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
