"""The exponential of a mode's matrix in doubles, without cancellation for short flights.

Let x^k times a polynomial with simple roots z annihilate M, k <= 3, and let P_z be the projectors
onto the eigenspaces.  Then

    exp(M d) = 1 + M d + M^2 d^2/2 + sum over z of P_z R(z d),   R(x) = exp(x) - 1 - x - x^2/2,

and P_z = (M/z)^k times the product of (M - o)/(z - o) over the other roots o.  Of a pair of complex
roots one is kept, with twice its projector: the real part of the sum is meant.  Sums in balls of
`BITS` bits are rounded to doubles at the end.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import reduce
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.sets import interval
from cap.sets.interval import Ball, ComplexBall, ComplexMatrix
from cap.system import exponential as enclosures
from cap.system.model import System
from cap.system.polynomial import Polynomial

Floats = NDArray[np.float64]
BITS, LONGEST = 140, 3
TINY = 1e-25


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

    def flown(self, y: Floats, d: Floats) -> Floats:
        """Return exp(M d) y (K, Z) at times (K,)."""
        x = np.multiply.outer(d, self.rates)
        R = np.exp(x) - 1 - x - x * x / 2
        path = y + np.outer(d, self.first @ y) + np.outer(d * d / 2, self.second @ y)
        return np.asarray(path + R.real @ (self.real @ y) + R.imag @ (self.imaginary @ y))


def exponential(system: System, mode: str) -> Exponential:
    """Return the exponential of y' = M y; refuse resonance, and matrices of other kinds."""
    with interval.workprec(BITS):
        M = interval.complex_matrix(enclosures.enclosed(system.matrix(mode)))
        clock = ComplexBall(0, enclosures.number(system.omega))
        roots = [*state_roots(system, mode), clock, -clock]
        distinct = [z for n, z in enumerate(roots) if all(abs(z - o) > TINY for o in roots[:n])]
        one = interval.complex_matrix(interval.identity(M.nrows()))
        rest = reduce(lambda P, z: P * (M - one * z), distinct, one)
        length = 0
        while not all(abs(u) < TINY for u in rest.entries()):
            rest, length = rest * M, length + 1
            if length > LONGEST:
                raise BadInput(
                    f"floats do not follow the mode {mode}: resonance with the clock, or a "
                    "repeated rate (M is not the sum of a diagonalisable and a short nilpotent one)"
                )
        kept = [z for z in distinct if not z.imag < 0]
        parts = [_projector(M, z, distinct, length) for z in kept]
        size = (len(kept), M.nrows(), M.nrows())
        real = np.array([_floats(P.real.entries()) for P in parts])
        imaginary = np.array([_floats((-P.imag).entries()) for P in parts])
        first, second = (_floats(P.real.entries()).reshape(size[1:]) for P in (M, M * M))
        rates = np.array([complex(z) for z in kept], dtype=complex)
        return Exponential(first, second, rates, real.reshape(size), imaginary.reshape(size))


def _projector(
    M: ComplexMatrix, z: ComplexBall, roots: Sequence[ComplexBall], length: int
) -> ComplexMatrix:
    """Return the projector of one of a pair, twice; of a real rate, once."""
    one = interval.complex_matrix(interval.identity(M.nrows()))
    P = one * (1 if z.imag == 0 else 2)
    for other in roots:
        if other is not z:
            P = P * (M - one * other) / (z - other)
    for _ in range(length):
        P = P * M / z
    return P


def number(q: Polynomial) -> Ball:
    """Return a ball that contains an exact number, much shorter than the spacing of doubles."""
    with interval.workprec(BITS):
        return enclosures.number(q)


def evaluated(q: Polynomial, values: Mapping[str, Any]) -> Any:
    """Return the value of a polynomial in doubles, or arrays of them."""
    return q.evaluated(values, float, np.pi)


def state_roots(system: System, mode: str) -> list[ComplexBall]:
    """Return the eigenvalues of the state's matrix that are not 0, each once."""
    field = system.modes[mode].field
    A = [[field[z].derivative(y) for y in system.state] for z in system.state]
    if any(set(q.terms) - {()} for row in A for q in row):
        raise BadInput(f"floats do not follow the mode {mode}: its matrix is not rational")
    numbers = [[q.terms.get((), Fraction(0)) for q in row] for row in A]
    with interval.workprec(BITS):
        roots = [_clean(z) for z in interval.eigenvalues(numbers)]
    return sorted(roots, key=lambda z: (abs(float(z.imag)), float(z.real)))


def _clean(z: ComplexBall) -> ComplexBall:
    """Return a root without the rounding errors in a part that is 0."""
    parts = (0 if abs(part) < TINY * abs(z) else part for part in (z.real, z.imag))
    return ComplexBall(*parts)


def _floats(entries: Sequence[Ball]) -> Floats:
    """Return balls in doubles; what is 0 up to `TINY` is 0."""
    return np.array([float(u) if abs(u) > TINY else 0.0 for u in entries])
