"""Where Coq finds the orbit: hints, to which no sentence of the theorem refers.

Units: time 1/ω.  With δ = (t2 - t1 - π)/2 the orbit is one of `cap.one_one.closed_form`: symmetric,
where δ = 0, or asymmetric, where the friction α(δ) is f/F; then Coq needs decimals on both sides of
δ.  Of the two symmetric orbits one has t1 + t2 < 2π.  The hits of all states of
the box lie in the windows of the certificate; so their δ lies in an interval, too.
"""

from dataclasses import dataclass
from fractions import Fraction

from cap.checker.kernel.certificate import Certificate
from cap.errors import NotProved
from cap.one_one.closed_form import asymmetric
from cap.sets.interval import Ball, around, ball, decade, hull, outward, pi, point, workprec

PLACES = 20  # decimals of δ beyond those of the claims: the third derivatives lose some
GUARD = 30  # bits of Coq's intervals beyond the decimals of δ
BOX_BITS = 32  # on the box: the cells are much wider than rounding errors
BOX_PLACES = 6  # decimals of the range of δ on the box
PIECES = 64  # of that range, on each of which α' has a sign
DEPTH = 10  # how often a cell of the box may be cut into quarters

Pair = tuple[str, str]


@dataclass(frozen=True)
class Hints:
    """Which orbit it is; decimals on both sides of δ; windows of the hits, and of δ, on the box."""

    kind: str
    delta: Pair
    windows: tuple[Pair, Pair]
    box_delta: Pair
    bits: int


def hints(certificate: Certificate) -> Hints:
    """Return the hints; raise `NotProved` where there is no orbit of the closed form."""
    p, digits = certificate.parameters, certificate.digits
    places = digits + PLACES + max(0, -decade(p.omega**2 * (p.r - p.l) / p.F))
    bits = places * 10 // 3 + GUARD
    with workprec(bits + GUARD):
        first, second = (p.omega * t.lower for t in certificate.claims["hit_times"])
        near = (ball(second - first) - pi()) / 2
        alpha, rho = ball(p.f / p.F), ball((p.r - p.l) * p.omega**2 / p.F)
        near += around(Fraction(0), Fraction(10, 10**digits))
        if near.contains(0):
            kind = "Symmetric_plus" if ball(first + second) < 2 * pi() else "Symmetric_minus"
            delta = Ball(0)
        else:
            kind, delta = "Asymmetric", _delta(alpha, rho, near, places)
        right, left = (
            [p.omega * end for end in (w.lower, w.upper)] for w in certificate.hints["hit_times"]
        )
        all_deltas = (hull(ball(left[0] - right[1]), ball(left[1] - right[0])) - pi()) / 2
        windows = (str(right[0]), str(right[1])), (str(left[0]), str(left[1]))
        return Hints(kind, outward(delta, places), windows, outward(all_deltas, BOX_PLACES), bits)


def _delta(alpha: Ball, rho: Ball, near: Ball, places: int) -> Ball:
    """Return a ball that contains the δ in ``near`` with α(δ) = ``alpha``, by bisection."""
    low, high = near.lower(), near.upper()
    sides = [_excess(alpha, rho, end) for end in (low, high)]
    if not sides[0] * sides[1] < 0:
        raise NotProved("orbit", "no asymmetric orbit with one hit of each wall at these hit times")
    while not (high - low) * Ball(10) ** (places + 3) < 1:
        middle = point((low + high) / 2)
        excess = _excess(alpha, rho, middle)
        if excess * sides[0] > 0:
            low = middle
        elif excess * sides[0] < 0:
            high = middle
        else:
            return middle
    return hull(low, high)


def _excess(alpha: Ball, rho: Ball, delta: Ball) -> Ball:
    """Return by how much the friction at δ exceeds alpha."""
    excess: Ball = asymmetric(delta, rho).alpha - alpha
    return excess
