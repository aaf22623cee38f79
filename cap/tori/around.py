"""What an invariant curve C near a trigonometric polynomial K surrounds.

C differs from K by at most ``distance`` in each component, and C' from K' by ``slope``, in norms
that bound the values at real θ.
"""

from fractions import Fraction

from cap.errors import NotProved
from cap.sets import interval, matrix
from cap.sets.interval import Ball, Box, ComplexBall
from cap.sets.matrix import Matrix
from cap.tori.invariant_curve import Curve, Found, Vector, norm

Axes = Matrix[Fraction]


def in_axes(curve: Curve, at: Box, axes: Axes) -> Vector:
    """Return M⁻¹(K - at)."""
    (p, q), (r, s) = inverse(axes)
    x, v = curve.x - at[0], curve.v - at[1]
    return x * p + v * q, x * r + v * s


def inverse(axes: Axes) -> Matrix[Ball]:
    """Return M⁻¹."""
    (a, b), (c, d) = axes
    D = matrix.determinant(axes)
    if not D:
        raise NotProved("region", "its axes are parallel", {})
    p, q, r, s = (interval.ball(entry / D) for entry in (d, -b, -c, a))
    return (p, q), (r, s)


def stretch(axes: Axes) -> Ball:
    """Return the norm of M⁻¹: of the maximum of components."""
    rows = inverse(axes)
    first, second = (abs(p) + abs(q) for p, q in rows)
    return first.max(second)


def half_width(curve: Curve, middle: Box, axes: Axes, reach: Ball) -> Fraction:
    """Return h such that real curves within ``reach`` of K lie in middle + M [-h, h]²."""
    far = stretch(axes) * reach
    most = interval.ZERO
    for y in in_axes(curve, middle, axes):
        most = most.max(abs(y.mean) + y.swing + y.error + far)
    _, above = interval.ends(most)
    return Fraction(int(above * 1000) + 1, 1000) if above > Fraction(1, 100) else above * 101 / 100


def winding(curve: Curve, centre: Box, axes: Axes, distance: Ball) -> int:
    """Return 1 or -1: how often C winds around the centre, counted counterclockwise.

    Verifies that in the axes, as a complex number, one of the terms exp(±iθ) of K is larger than
    all others together with what C differs from K; and that K has a first harmonic larger than
    ``distance``, so C has no double points.
    """
    y = in_axes(curve, centre, axes)
    terms = [a + ComplexBall(0, 1) * b for a, b in zip(*(u.coefficients for u in y), strict=True)]
    n = curve.x.circle.degree
    whole = interval.total(abs(c) for c in terms)
    error = y[0].error + y[1].error + 2 * stretch(axes) * distance
    for s in (1, -1):
        if 2 * abs(terms[n + s]) > whole + error and embedded(curve, distance):
            return s if matrix.determinant(axes) > 0 else -s
    sets = {"first": terms[n + 1], "minus first": terms[n - 1], "all": whole}
    raise NotProved("Lemma 3", "the curve may not wind around P*", sets)


def embedded(curve: Curve, distance: Ball) -> bool:
    """Return whether a component has a first harmonic larger than the distance."""
    n = curve.x.circle.degree
    first = (u.coefficients[n + 1] for u in (curve.x, curve.v))
    return any(bool(abs(c) > distance) for c in first)


def area(curve: Curve, found: Found) -> Ball:
    """Return the area inside C.

    That inside K is 2π |Σ Re(ik v_k conj x_k)|, and by integration by parts the integral of det(C,
    C')/2 differs by at most 2π distance (2|K'| + slope).
    """
    x, v = curve.x, curve.v
    total = interval.ZERO
    for k, a, b in zip(
        x.circle.modes(x.circle.degree), x.coefficients, v.coefficients, strict=True
    ):
        total = total + (ComplexBall(0, k) * b * a.conjugate()).real
    error = found.distance * (2 * norm(curve.tangent) + found.slope)
    result: Ball = 2 * interval.pi() * (abs(total) + interval.symmetric(error))
    if not result > 0:
        raise NotProved("Lemma 4", "the area may vanish", {"area": result})
    return result
