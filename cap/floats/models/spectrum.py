"""The exponential of a mode's matrix in doubles, without cancellation for short flights.

Let x^k times a polynomial with simple roots z annihilate M, k <= 3, and let P_z be the projectors
onto the eigenspaces.  Then

    exp(M d) = 1 + M d + M^2 d^2/2 + sum over z of P_z R(z d),   R(x) = exp(x) - 1 - x - x^2/2,

and P_z = (M/z)^k times the product of (M - o)/(z - o) over the other roots o.  Of a pair of complex
roots one is kept, with twice its projector: the real part of the sum is meant.  Sums of 40 digits
are rounded to doubles at the end.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import reduce
from typing import Any, NamedTuple

import mpmath
import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.system.model import System
from cap.system.polynomial import Polynomial

Floats = NDArray[np.float64]
DIGITS, LONGEST = 40, 3
TINY = mpmath.mpf(10) ** -25


class Exponential(NamedTuple):
    """M, M^2; the rates z (J,); real parts, and negative imaginary parts, of P_z (J, Z, Z)."""

    first: Floats
    second: Floats
    rates: NDArray[np.complex128]
    real: Floats
    imaginary: Floats

    def rows(self, h: Floats) -> Floats:
        """Return the rows h, h M, h M^2, h Re P_1, - h Im P_1, ... (3 + 2J, Z) of a guard h.y."""
        parts = [h, h @ self.first, h @ self.second]
        for re, im in zip(self.real, self.imaginary, strict=True):
            parts += [h @ re, h @ im]
        return np.array(parts)


def exponential(system: System, mode: str) -> Exponential:
    """Return the exponential of y' = M y; refuse resonance, and matrices of other kinds."""
    with mpmath.workdps(DIGITS):
        M = matrix(system, mode)
        roots = [*state_roots(system, mode), *_clock_roots(system)]
        distinct = [z for n, z in enumerate(roots) if all(abs(z - o) > TINY for o in roots[:n])]
        one = mpmath.eye(M.rows)
        rest = reduce(lambda P, z: P * (M - z * one), distinct, one)
        length = 0
        while mpmath.mnorm(rest, mpmath.inf) > TINY:
            rest, length = rest * M, length + 1
            if length > LONGEST:
                raise BadInput(
                    f"floats do not follow the mode {mode}: resonance with the clock, or a "
                    "repeated rate (M is not the sum of a diagonalisable and a short nilpotent one)"
                )
        kept = [z for z in distinct if mpmath.im(z) >= 0]
        parts = [_projector(M, z, distinct, length) for z in kept]
        size = (len(kept), M.rows, M.rows)
        real = np.array([_floats(P.apply(mpmath.re)) for P in parts]).reshape(size)
        imaginary = np.array([_floats(P.apply(lambda u: -mpmath.im(u))) for P in parts])
        rates = np.array([complex(z) for z in kept], dtype=complex)
        return Exponential(_floats(M), _floats(M * M), rates, real, imaginary.reshape(size))


def _projector(M: Any, z: Any, roots: Sequence[Any], length: int) -> Any:
    """Return the projector of one of a pair, twice; of a real rate, once."""
    P = mpmath.eye(M.rows) * (2 if mpmath.im(z) else 1)
    for other in roots:
        if other != z:
            P = P * (M - other * mpmath.eye(M.rows)) / (z - other)
    for _ in range(length):
        P = P * M / z
    return P


def matrix(system: System, mode: str) -> Any:
    """Return M (Z, Z), y = (state, cos, sin, 1), with 40 digits."""
    return mpmath.matrix([[number(q) for q in row] for row in system.matrix(mode)])


def number(q: Any) -> Any:
    """Return the value of an exact number."""
    value = q.evaluated({}, lambda c: mpmath.mpf(c.numerator) / c.denominator, mpmath.pi)
    return mpmath.mpf(value)


def evaluated(q: Polynomial, values: Mapping[str, Any]) -> Any:
    """Return the value of a polynomial in doubles, or arrays of them."""
    return q.evaluated(values, float, np.pi)


def _clock_roots(system: System) -> list[Any]:
    """Return i w and - i w."""
    w = number(system.omega)
    return [mpmath.mpc(0, w), mpmath.mpc(0, -w)]


def state_roots(system: System, mode: str) -> list[Any]:
    """Return the eigenvalues of the state's matrix that are not 0, each once."""
    field = system.modes[mode].field
    A = [[field[z].derivative(y) for y in system.state] for z in system.state]
    if any(set(q.terms) - {()} for row in A for q in row):
        raise BadInput(f"floats do not follow the mode {mode}: its matrix is not rational")
    numbers = [[q.terms.get((), Fraction(0)) for q in row] for row in A]
    coefficients = _squarefree(_without_zeros(_characteristic(numbers)))
    if len(coefficients) == 1:
        return []
    exact = [mpmath.mpf(c.numerator) / c.denominator for c in coefficients]
    roots = mpmath.polyroots(exact, maxsteps=500, extraprec=400)
    return [_clean(mpmath.mpc(z)) for z in roots]


def _clean(z: Any) -> Any:
    """Return a root without the rounding errors in a part that is 0."""
    real, imaginary = (0 if abs(part) < TINY * abs(z) else part for part in (z.real, z.imag))
    return mpmath.mpc(real, imaginary)


def _characteristic(A: list[list[Fraction]]) -> list[Fraction]:
    """Return the coefficients of det(x - A), the first is 1 (Faddeev and Leverrier)."""
    n = len(A)
    found, B = [Fraction(1)], [[Fraction(0)] * n for _ in range(n)]
    for k in range(1, n + 1):
        for i in range(n):
            B[i][i] += found[-1]
        B = [
            [
                sum(a * b for a, b in zip(row, column, strict=True))
                for column in zip(*B, strict=True)
            ]
            for row in A
        ]
        found.append(-sum((B[i][i] for i in range(n)), Fraction(0)) / k)
    return found


def _without_zeros(p: list[Fraction]) -> list[Fraction]:
    """Return p without its factors x."""
    while len(p) > 1 and not p[-1]:
        p = p[:-1]
    return p


def _squarefree(p: list[Fraction]) -> list[Fraction]:
    """Return the polynomial with the same roots, each once."""
    degree = len(p) - 1
    slope = [c * (degree - k) for k, c in enumerate(p[:-1])]
    common, rest = p, slope
    while any(rest):
        common, rest = rest, _divided(common, rest)[1]
    return _divided(p, common)[0]


def _divided(p: list[Fraction], q: list[Fraction]) -> tuple[list[Fraction], list[Fraction]]:
    """Return the quotient and the remainder, which has no leading zeros."""
    quotient, rest = [], list(p)
    while len(rest) >= len(q):
        c = rest[0] / q[0]
        quotient.append(c)
        rest = [
            a - c * b
            for a, b in zip(rest, [*q, *[Fraction(0)] * (len(rest) - len(q))], strict=True)
        ][1:]
    while rest and not rest[0]:
        rest = rest[1:]
    return quotient, rest


def _floats(M: Any) -> Floats:
    """Return a matrix in doubles; what is 0 up to the 40 digits is 0."""
    entries = [[float(u) if abs(u) > TINY else 0.0 for u in M[i, :]] for i in range(M.rows)]
    return np.array(entries)
