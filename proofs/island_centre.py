"""The elliptic fixed point P* of `cap.proofs.island`: found in floats, proved by Krawczyk.

Units F = ω = 1, places from the middle between the walls, which are at ±a.
"""

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from cap.certificate.writer import Pair
from cap.errors import BadInput, NotProved
from cap.floats.candidates import tori
from cap.proofs.fixed_point import Setting
from cap.sets import interval, matrix
from cap.sets.interval import Ball, Box
from cap.sets.matrix import Matrix
from cap.tori.states import Motion, States


@dataclass(frozen=True)
class Place:
    """Where the island is: in floats, and f/F and a exactly."""

    centre: tori.Centre
    laws: tuple[Fraction, Fraction]

    @cached_property
    def last(self) -> float:
        """The radius of the last orbit found that goes on."""
        return tori.last_radius(self.centre)


def located(setting: Setting) -> Place:
    """Return where the island is; half a period suffices if the orbit is its own image."""
    p, guess = setting.parameters, setting.start
    if not guess.v > 0:
        raise BadInput("the theorem island is about orbits with v > 0 at t = 0")
    laws = p.f / p.F, p.R * p.omega**2 / p.F / 2
    return Place(tori.of_orbit(p, guess.x, guess.v), laws)


def state(setting: Setting, P: Box) -> dict[str, Pair]:
    """Return the claims on P*."""
    p, pair, units = setting.parameters, setting.rounding.loosely, setting.units
    length, speed = (interval.ball(p.F / p.omega**k) for k in (2, 1))
    x = interval.ball((p.l + p.r) / 2) + P[0] * length
    return {"x": pair(x, units.length), "v": pair(P[1] * speed, units.speed)}


def balls(z: tuple[Fraction, Fraction]) -> Box:
    """Return a point as balls."""
    return interval.ball(z[0]), interval.ball(z[1])


def centred(
    motion: Motion, place: Place, digits: int
) -> tuple[tuple[Fraction, Fraction], Matrix[Fraction]]:
    """Return decimals: P* by Newton's method, and the axes of the region."""
    x, v = (interval.ball(Fraction(float(c))) for c in place.centre.point)
    for _ in range(6):
        image, D = derivative(motion, place.centre.halves, (x, v), Ball("1e-12"))
        C = matrix.inverse(matrix.minus_identity(D))
        dx, dv = matrix.apply(C, (image[0] - x, image[1] - v))
        x, v = (interval.point(z) for z in (x - dx, v - dv))
    unit = 10 ** (digits + 8)
    middle = tuple(Fraction(round(interval.rational(z) * unit), unit) for z in (x, v))
    rows = [
        tuple(Fraction(round(float(e) * 10**4), 10**4) for e in row) for row in place.centre.frame
    ]
    return (middle[0], middle[1]), ((rows[0][0], rows[0][1]), (rows[1][0], rows[1][1]))


def derivative(motion: Motion, halves: int, at: Box, r: Ball) -> tuple[Box, Matrix[Ball]]:
    """Return G of a state, and DG over all states within r."""
    z = States(at, ((r, Ball(0)), (Ball(0), r)))
    for _ in range(halves):
        z = motion.after(z)
    (a, b), (c, d) = z.B
    return z.middle, ((a / r, b / r), (c / r, d / r))


def lemma_1_centre(
    motion: Motion, halves: int, middle: tuple[Fraction, Fraction], digits: int
) -> tuple[Box, Ball, dict[str, Any]]:
    """*Statement.* G, that is σ or σσ = Φ, has a fixed point P* in a small square.

    *Computed.* Krawczyk's inclusion.  Return P*, the trace of DG there, and hints.
    """
    radius = Fraction(1, 10 ** (digits + 4))
    m, r = balls(middle), interval.ball(radius)
    image, D = derivative(motion, halves, m, r)
    C = matrix.inverse(matrix.minus_identity(D))
    trace = matrix.trace(D)
    rough = [[Fraction(round(interval.midpoint(e) * 10**8), 10**8) for e in row] for row in C]
    (p, q), (s, t) = ((interval.ball(e) for e in row) for row in rough)
    D = matrix.minus_identity(D)
    defect = matrix.apply(((p, q), (s, t)), (image[0] - m[0], image[1] - m[1]))
    left = matrix.product(((p, q), (s, t)), D)
    found = []
    for i in (0, 1):
        row = [(1 if i == j else 0) - left[i][j] for j in (0, 1)]
        K = m[i] - defect[i] + interval.symmetric(r * row[0]) + interval.symmetric(r * row[1])
        if not interval.subset_interior(K, m[i] + interval.symmetric(r)):
            raise NotProved("Lemma 1", "Krawczyk's operator leaves the square", {"K": K})
        found.append(K)
    exact = interval.exact_decimal
    hints = {"radius": exact(radius), "preconditioner": [[exact(e) for e in row] for row in rough]}
    return (found[0], found[1]), trace, hints
