"""Hints: a polynomial of degree 4 that the period map of two masses hardly changes near its orbit.

In the coordinates w of `cap.maps.twist_matrix` let ψ_j = w_j + ψ_j2 + ψ_j3 conjugate the map with
w_j -> λ_j w_j (1 + i Σ_k B_jk |w_k|²), up to terms of order 4.  As B is real, H = |ψ_1|² + |ψ_2|²,
cut at the degree 4, changes by terms of order 5 only.  Balls are replaced by their midpoints: that
H hardly changes the checker proves, on an ellipsoid |w| <= radius.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from cap.errors import NotProved
from cap.maps.normal_form import conjugate_real, substitute
from cap.maps.twist_matrix import Frame, conjugate, divisor, in_coordinates
from cap.sets import interval
from cap.sets.interval import Ball, ComplexBall
from cap.sets.jet import Jet

DEGREE = 4
SHORT = 4  # digits of the axes


@dataclass(frozen=True)
class Ellipsoid:
    """The set of ``centre`` + ``axes`` u, |u| <= 1, with H in u: coefficients by their powers."""

    centre: list[Fraction]
    axes: list[list[Fraction]]
    integral: dict[tuple[int, ...], Fraction]


def integral(jets: Sequence[Jet], frame: Frame) -> Jet:
    """Return H, a jet in (w, w̄), from the jets of order 3 of the map."""
    f = [_middles(q) for q in in_coordinates(jets, frame)]
    n, total = len(frame.vectors), None
    spectrum = [*frame.multipliers, *(q.conjugate() for q in frame.multipliers)]
    for j in range(n):
        psi = _conjugation(f, j, spectrum).extended(DEGREE)
        square = psi * conjugate(psi, n)
        total = square if total is None else total + square
    if total is None:
        raise NotProved("integral", "there is no mass", {})
    return total


def _conjugation(f: Sequence[Jet], j: int, spectrum: list[ComplexBall]) -> Jet:
    """Return ψ_j: at each degree what ψ∘f leaves, divided by Λ^m - λ_j."""
    n, space = len(f) // 2, f[0].space
    psi = Jet.variables([ComplexBall(0)] * (2 * n), space.order)[j]
    for degree in range(2, space.order + 1):
        image = substitute(psi, f)
        for i, m in enumerate(space.exponents):
            resonant = all(m[k] - m[n + k] == int(k == j) for k in range(n))
            if sum(m) == degree and not resonant:
                psi.coefficients[i] = -image.coefficients[i] / divisor(spectrum, m, j)
    return _middles(psi)


def _middles(f: Jet) -> Jet:
    return Jet(f.space, [(ComplexBall(0) + c).mid() for c in f.coefficients])


def ellipsoid(
    H: Jet, frame: Frame, point: Sequence[Ball], radius: Fraction, places: Sequence[int]
) -> Ellipsoid:
    """Return an ellipsoid near |w| <= radius around the point, its axes of a few digits.

    ``places``: the decimals of the centre, and then of the coefficients of H.
    """
    centre = [round(interval.midpoint(q), places[0]) for q in point]
    axes = [[_short(radius * q) for q in row] for row in _axes(frame)]
    u = Jet.variables([Ball(0)] * 4, DEGREE)
    z = list[Jet]()
    for row, c, at in zip(axes, centre, point, strict=True):
        offset = u[0] * 0 + (interval.ball(c) - at)
        z.append(sum((b * interval.ball(a) for a, b in zip(row, u, strict=True)), offset))
    w = [frame.coordinate(j, z) for j in range(2)]
    w += [conjugate_real(q) for q in w]
    scaled = substitute(H, w) * interval.ball(1 / radius**2)
    values = (ComplexBall(0) + c for c in scaled.coefficients)
    rounded = [round(interval.midpoint(c.real), places[1]) for c in values]
    terms = zip(scaled.space.exponents, rounded, strict=True)
    return Ellipsoid(centre, axes, {m: c for m, c in terms if any(m) and c})


def _axes(frame: Frame) -> list[list[Fraction]]:
    """Return rows: w_j = u_(2j) + i u_(2j+1) is at 2 Re(w_j e_j)."""
    columns = []
    for e in frame.vectors:
        columns.append([2 * interval.midpoint(q.real) for q in e])
        columns.append([-2 * interval.midpoint(q.imag) for q in e])
    return [list(row) for row in zip(*columns, strict=True)]


def _short(value: Fraction) -> Fraction:
    return round(value, SHORT - interval.decade(abs(value))) if value else value
