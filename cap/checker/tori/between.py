"""Periodic orbits between an elliptic fixed point P* and an invariant curve C around it.

G keeps the open disk D inside C and P*, det DG = 1, and is conjugate on C to the rotation by
alpha.  Angles at P* are measured in axes in which one term exp(it theta) of C - P*, t = 1 or -1, is
larger than all others together (if these axes reverse the plane, s and t are both -1 times those of
the plane; st is the same).

*Near P** G turns directions as DG(P*) does: |trace| < 2, so it has no real eigenvector, det(w, DG
w) has one sign s for all w, and DG is conjugate to a rotation by s 2 pi a, a = arccos(trace/2)/(2
pi) in (0, 1/2).  Let F be the lift of G to the angles that changes them near P* by amounts in s (0,
pi).

*On a segment* from P* to a point of C let s det(w, DG w) > 0 at all its points, w its direction.
Integrated, s det(w, G(z) - P*) > 0 for all its points z: so F changes their angles, too, by amounts
in s (0, pi); at the end by d, say.

*On C*, from the end of the segment, the angle along C changes by t 2 pi alpha + b if the parameter
grows by 2 pi alpha; |b| < pi, since C - P* = (the term) (1 + less than 1).  F changes it by d,
which differs from that by a multiple of 2 pi: so F has on C the rotation number s c with c = st
alpha mod 1 and 2 pi c = s (d - b) in (-pi, 2 pi).  If the part of st alpha in [0, 1) is less than
1/2, then c is this part: no other number in (-1/2, 1) differs from it by an integer.

So seen in the sense of C, modulo 1, the rotation number at P* is

    a if st = 1 and alpha < 1/2,        1 - a if st = -1 and alpha > 1/2,

when that of C is alpha; otherwise nothing is claimed.  For each p/q between both, in lowest terms,
docs/invariant-curve-proof.md has two periodic orbits, from Franks' theorem.
"""

from __future__ import annotations

from fractions import Fraction

from cap.checker.kernel.arctangent import arccos, pi
from cap.checker.kernel.fourier import Function
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.tori.half_period import Motion, States
from cap.checker.tori.values import values

PLACES = 16  # where a segment may end: at multiples of 2 pi/16
Point = tuple[Interval, Interval]


def value(u: Function, place: int, error: int, bits: int) -> Interval:
    """Return an enclosure of the values at 2 pi place/16 of all real functions within an error."""
    return values(u, [place], PLACES, error, bits)[0]


def sense(motion: Motion, halves: int, ends: tuple[Point, Point], count: int) -> int:
    """Return s: on the segment between the ends det(w, DG w) is positive (1), or negative (-1).

    It is cut into ``count`` pieces; DG w, times the half-width, is the first column of a state.
    """
    (x, v), (X, V) = ends
    w = X - x, V - v
    half = w[0] / (2 * count), w[1] / (2 * count)
    zero, signs = x.integer(0), set[int]()
    for n in range(count):
        middle = x + half[0] * (2 * n + 1), v + half[1] * (2 * n + 1)
        z = States(*middle, ((half[0], zero), (half[1], zero)))
        for _ in range(halves):
            z = motion.after(z)
        turned = w[0] * z.B[1][0] - w[1] * z.B[0][0]
        need(not turned.contains_zero(), "on the segment G may turn a point by 0 or pi")
        signs.add(1 if turned.is_positive() else -1)
    need(len(signs) == 1, "on the segment G turns both ways")
    return signs.pop()


def at_centre(trace: Interval, same: bool, alpha: Interval) -> Interval:
    """Return the rotation number at P*; ``same`` is whether st = 1."""
    half = alpha.integer(1) / 2
    a = arccos(trace / 2) / (pi(trace.bits) * 2)
    if same:
        need(alpha.is_before(half), "the curve may turn by more than P*, or the other way")
        return a
    need(half.is_before(alpha), "the curve may turn by more than P*, or the other way")
    return -a + 1


def simplest(low: Fraction, high: Fraction) -> Fraction:
    """Return the fraction with the least denominator in [low, high], 0 < low < high."""
    whole = -(-low // 1)
    if whole <= high:
        return Fraction(whole)
    return whole - 1 + 1 / simplest(1 / (high - whole + 1), 1 / (low - whole + 1))
