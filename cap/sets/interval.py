"""Balls: the one module that knows python-flint.

A ball is a set of reals.  Every operation returns a ball that contains the exact results for
all points of its operands.  A comparison such as ``x > 0`` is True only when it holds for all
points; False means "not certain", never "no".  A ball that is not finite compares False to
everything, so tests written as ``if not x > 0: raise NotProved`` are safe.

Precision is scoped: build every ball inside ``with workprec(bits)``.
"""

import re
from collections.abc import Iterable, Sequence
from contextlib import AbstractContextManager
from fractions import Fraction
from math import floor, log2, log10
from typing import Any

import flint
from flint import acb, acb_mat, acb_poly, arb, arb_mat, ctx, fmpq, fmpq_mat

from cap.errors import NotProved

FLINT: str = flint.__version__
Ball = arb
ComplexBall = acb
ComplexPolynomial = acb_poly  # multiplies fast, and keeps small coefficients sharp
Box = tuple[arb, arb]
Matrix = arb_mat  # its products are closer, and for n > 2 faster, than sums of balls
ComplexMatrix = acb_mat
Exact = fmpq  # a rational: balls are made of it five times as fast as of a `Fraction`
workprec = ctx.workprec

LARGEST = 2**20  # exponent of what becomes a fraction
HUGE = arb((1, LARGEST))
ZERO, ONE = arb(0), arb(1)
_STATED = re.compile(r"-?\d+(\.\d+|/\d+)?", re.ASCII)


def guarded() -> AbstractContextManager[object]:
    """Return a context with eleven bits more, so that one orbit loses no bit of the precision here.

    From 53 bits that makes 64, which cost no more: one machine word.
    """
    return ctx.workprec(ctx.prec + 11)


def working_bits() -> int:
    """Return the working precision."""
    return int(ctx.prec)


def exact(value: Fraction | int) -> fmpq:
    """Return the rational ``value``, ready to become balls at any precision."""
    return fmpq(value.numerator, value.denominator)


def ball(value: Fraction | int | Exact) -> arb:
    """Return a ball that contains the rational ``value``."""
    return arb(value if isinstance(value, fmpq) else exact(value))


def around(centre: Fraction | Exact, radius: Fraction) -> arb:
    """Return a ball that contains [centre - radius, centre + radius]."""
    return arb(0, ball(radius)) + ball(centre)


def pi() -> arb:
    """Return an enclosure of π at the current precision."""
    return arb.pi()


def rounding() -> arb:
    """Return a number somewhat larger than the relative rounding error of one operation."""
    return arb((1, 10 - ctx.prec))


def point(x: arb) -> arb:
    """Return the midpoint of ``x`` as an exact ball."""
    return x.mid()


def symmetric(x: arb) -> arb:
    """Return the ball [-|x|, |x|] of all numbers at most as large as ``x``."""
    return arb(0, x.abs_upper())


def rational(x: arb) -> Fraction:
    """Return the exact value of a ball of radius zero.

    Raises `NotProved` if it is beyond 2^±`LARGEST`: a fraction would take that many digits.
    """
    _, exponent = x.man_exp()
    if abs(exponent) > LARGEST:
        raise NotProved("evaluation", "a number is too large or too small to write", {"value": x})
    q = x.fmpq()
    return Fraction(int(q.p), int(q.q))


def nearest(x: arb, places: int) -> Fraction:
    """Return a multiple of 10^-places nearest to a ball of radius zero; see `rational`."""
    if places < 0:
        return round(rational(x), places)
    m, e = map(int, x.man_exp())
    if abs(e) > LARGEST:
        raise NotProved("evaluation", "a number is too large or too small to write", {"value": x})
    scaled, bits = m * 10**places << max(e, 0), max(-e, 0)
    return Fraction((2 * scaled + (1 << bits)) >> bits + 1, 10**places)


def integers(first: arb, last: arb) -> range:
    """Return all integers between a point of ``first`` and one of ``last``.

    Raises `NotProved` if an end is not finite, or too large for its floor at the precision here.
    """
    return range(-_floor(-first.lower()), _floor(last.upper()) + 1)


def _floor(x: arb) -> int:
    """Return the largest integer at most the ball of radius zero."""
    floor = x.floor().unique_fmpz() if abs(x) < HUGE else None
    if floor is None:
        raise NotProved("evaluation", "a number is too large to count to", {"value": x})
    return int(floor)


def ends(x: arb) -> tuple[Fraction, Fraction]:
    """Return the exact lower and upper end of a finite ball; see `rational`."""
    if not x.is_finite():
        raise NotProved("evaluation", "an enclosure is not finite", {"value": x})
    mid, rad = rational(x.mid()), rational(x.rad())
    return mid - rad, mid + rad


def midpoint(x: arb) -> Fraction:
    """Return the exact middle of a finite ball: a hint, nothing is proved with it."""
    lower, upper = ends(x)
    return (lower + upper) / 2


def subset_interior(x: arb, y: arb) -> bool:
    """Return True only if the ball ``x`` lies in the interior of the ball ``y``."""
    return bool(x.is_finite() and y.is_finite() and y.contains_interior(x))


def subset(x: arb, y: arb) -> bool:
    """Return True only if the ball ``x`` lies in the ball ``y``."""
    return bool(x.is_finite() and y.is_finite() and y.contains(x))


def intersection(x: arb, y: arb) -> arb:
    """Return a ball that contains the common points of ``x`` and ``y``, of which there are some."""
    return x.intersection(y)


def hull(x: arb, y: arb) -> arb:
    """Return a ball that contains both ``x`` and ``y``."""
    return x.union(y)


def total(terms: Iterable[arb]) -> arb:
    """Return the sum of balls."""
    return sum(terms, ZERO)


def matrix(rows: Sequence[Sequence[arb | float]]) -> Matrix:
    """Return a matrix of balls, or of integers or doubles."""
    return arb_mat(rows)


def column(entries: Sequence[arb]) -> Matrix:
    """Return a column of balls."""
    return arb_mat(len(entries), 1, entries)


def row(entries: Sequence[arb]) -> Matrix:
    """Return a row of balls."""
    return arb_mat(1, len(entries), entries)


def identity(size: int) -> Matrix:
    """Return the matrix 1."""
    return arb_mat(size, size, [int(i == j) for i in range(size) for j in range(size)])


def complex_matrix(real: Matrix) -> ComplexMatrix:
    """Return the matrix of complex balls with these real ones."""
    return acb_mat(real)


def eigenvalues(rows: Sequence[Sequence[Fraction]]) -> list[ComplexBall]:
    """Return enclosures of the eigenvalues of a square matrix that are not 0, each once.

    They are isolated from each other, and real ones are real.
    """
    entries = [exact(q) for row in rows for q in row]
    roots: Any = fmpq_mat(len(rows), len(rows), entries).charpoly().numer().complex_roots()
    return [acb(z) for z, _ in roots if z != 0]


def spectrum(rows: Sequence[Sequence[Fraction]]) -> list[ComplexBall] | None:
    """Return enclosures of all eigenvalues of a square matrix, each once; real ones are real.

    None if it has no basis of eigenvectors: then its minimal polynomial has a multiple root.
    """
    entries = [exact(q) for row in rows for q in row]
    roots: Any = fmpq_mat(len(rows), len(rows), entries).minpoly().numer().complex_roots()
    return [acb(z) for z, _ in roots] if all(times == 1 for _, times in roots) else None


def lower(x: arb) -> arb:
    """Return a ball of radius zero that is a lower bound of ``x``."""
    return arb(x.lower())


def upper(x: arb) -> arb:
    """Return a ball of radius zero that is an upper bound of ``x``."""
    return arb(x.upper())


def least(x: arb, y: arb) -> arb:
    """Return a ball that contains the smaller of any two points of ``x`` and ``y``."""
    return x.min(y)


def outward(x: arb, places: int) -> tuple[str, str]:
    """Return the nearest multiples (lower, upper) of 10^-places that enclose ``x``, as decimals."""
    lower, upper = multiples(x, places)
    return fixed(lower, places), fixed(upper, places)


def multiples(x: arb, places: int) -> tuple[int, int]:
    """Return the nearest integers (lower, upper) whose multiples of 10^-places enclose ``x``."""
    return multiples_of(binary_ends(x), places)


def multiples_of(ends: tuple[int, int, int], places: int) -> tuple[int, int]:
    """Return the nearest integers of `multiples`, for ends as those of `binary_ends`."""
    lower, upper, bits = ends
    up, down = 10 ** max(places, 0), 10 ** max(-places, 0) << bits
    return lower * up // down, -(-upper * up // down)


def binary_ends(x: arb) -> tuple[int, int, int]:
    """Return a, b and n with the ends a/2^n and b/2^n of a finite ball; see `rational`."""
    if not x.is_finite():
        raise NotProved("evaluation", "an enclosure is not finite", {"value": x})
    parts = [(int(m), int(e)) for m, e in (x.mid().man_exp(), x.rad().man_exp())]
    if any(abs(e) > LARGEST for _, e in parts):
        raise NotProved("evaluation", "a number is too large or too small to write", {"value": x})
    bits = max(0, *(-e for _, e in parts))
    mid, rad = (m << e + bits for m, e in parts)
    return mid - rad, mid + rad, bits


def fixed(n: int, places: int) -> str:
    """Return n 10^-places as a decimal string."""
    n, places = (n, places) if places >= 0 else (n * 10**-places, 0)
    digits, sign = str(abs(n)).zfill(places + 1), "-" if n < 0 else ""
    return sign + (f"{digits[:-places]}.{digits[-places:]}" if places else digits)


def decimal(value: Fraction, places: int) -> str:
    """Return ``value``, a multiple of 10^-places, as an exact decimal string."""
    n, rest = divmod(value.numerator * 10**places, value.denominator)
    if rest:
        raise ValueError(f"{value} has more than {places} decimal places")
    return fixed(n, places)


def decade(value: Fraction) -> int:
    """Return the largest integer d with 10^d <= value, give or take one; value > 0."""
    return floor(log10(value.numerator) - log10(value.denominator))


def stated(text: str) -> Fraction:
    """Return the number that `decimal`, or the ``str`` of a fraction, states.

    Raises `ValueError` for any other text: an exponent might take all memory.
    """
    if not _STATED.fullmatch(text):
        raise ValueError(f"not a decimal, nor a fraction: {text[:40]!r}")
    return Fraction(text)


def exact_decimal(value: Fraction) -> str:
    """Return ``value`` exactly; the caller guarantees that it is a finite decimal."""
    twos = (value.denominator & -value.denominator).bit_length() - 1
    fives = int((value.denominator >> twos).bit_length() / log2(5))
    return decimal(value, max(twos, fives))


def short(value: Fraction) -> Fraction:
    """Return the largest decimal of two significant digits at most ``value`` > 0."""
    scale = Fraction(1)
    while value * scale < 10:
        scale *= 10
    while value * scale >= 100:
        scale /= 10
    return Fraction(value * scale // 1) / scale
