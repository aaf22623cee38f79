"""Compiled: a guard along a flight, and where it first comes to zero.

h(d) = a_0 + a_1 d + a_2 d^2/2 + sum over j of p_j Re R_j + q_j Im R_j, with R_j = R(z_j d) of
`cap.floats.models.spectrum`.  A guard is the tuple a of these 3 + 2J numbers; ``rates`` is that of
all Re z_j, Im z_j, and along(a, rates, d) gives h, h', h'' at d.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from typing import Any, cast

from numba import njit

Tuple = tuple[float, ...]
Function = Callable[..., Any]
Turn = tuple[float, float]
Ends = tuple[float, float, bool]
Lowest = tuple[float, float, Turn]
ROUNDS, SHORTEST, CLOSE = 100, 1e-12, 2e-16
C3, C4, C5, C6, C7, C8, C9, C10, C11, C12 = (1 / math.factorial(k) for k in range(3, 13))
C13, C14 = C12 / 13, C12 / 13 / 14
SOON, FLAT = 1e-6, 1e-14
SHORT = 0.5  # of an angle: there cosines cancel
EARLY, LATE = 0.75, 1.25  # of the time in which a parabola falls: where to look first


@njit(error_model="numpy", nogil=True)
def imaginary(_: float, y: float) -> tuple[float, float]:
    """Return R(i y), its parts with full relative precision."""
    q = y * y
    if q < 0.25:
        even = q * q * (C4 - q * (C6 - q * (C8 - q * (C10 - q * C12))))
        return even, -y * q * (C3 - q * (C5 - q * (C7 - q * (C9 - q * C11))))
    return math.cos(y) - 1 + q / 2, math.sin(y) - y


@njit(error_model="numpy", nogil=True)
def real(x: float, _: float) -> tuple[float, float]:
    """Return R(x) with full relative precision, and 0."""
    if abs(x) >= 0.5:
        return math.expm1(x) - x - x * x / 2, 0.0
    low = C3 + x * (C4 + x * (C5 + x * (C6 + x * (C7 + x * C8))))
    q = x * x * x
    return q * (low + q * q * (C9 + x * (C10 + x * (C11 + x * (C12 + x * (C13 + x * C14)))))), 0.0


@njit(error_model="numpy", nogil=True)
def remainder(x: float, y: float) -> tuple[float, float]:
    """Return R(x + i y), its parts with full relative precision."""
    if x * x + y * y < 0.25:
        a, b = 1.0, 0.0
        for k in range(16, 3, -1):
            a, b = 1 + (x * a - y * b) / k, (x * b + y * a) / k
        a, b = x * a - y * b, x * b + y * a
        a, b = x * a - y * b, x * b + y * a
        return (x * a - y * b) / 6, (x * b + y * a) / 6
    e = math.exp(x)
    return e * math.cos(y) - 1 - x - (x * x - y * y) / 2, e * math.sin(y) - y - x * y


@njit(error_model="numpy", nogil=True)
def steepest(a: Tuple, rates: Tuple, D: float) -> float:
    """Return a bound of |h'''| on [0, D]."""
    total = 0.0
    for j in range(len(rates) // 2):
        re, im = rates[2 * j], rates[2 * j + 1]
        size = math.sqrt(re * re + im * im)
        growth = math.exp(re * D) if re > 0 else 1.0
        total += (abs(a[3 + 2 * j]) + abs(a[4 + 2 * j])) * size * size * size * growth
    return total


@njit(error_model="numpy", nogil=True)
def parabola(h: float, h1: float, h2: float) -> float:
    """Return when h + h1 d + h2 d^2/2 >= 0 next falls to zero at d > 0, inf if it does not."""
    q = h1 * h1 - 2 * h * h2
    if not q > 0:
        return math.inf
    if h1 < 0:
        return 2 * h / (-h1 + math.sqrt(q))
    return (h1 + math.sqrt(q)) / -h2 if h2 < 0 else math.inf


@njit(error_model="numpy", nogil=True)
def positive(h: float, h1: float, h2: float, third: float, s: float) -> bool:
    """Return whether h > 0 on (0, s], if |h'''| <= third: by a cubic in Bernstein's form."""
    if h + h1 * s / 3 < 0 or h + 2 * h1 * s / 3 + h2 * s * s / 6 < 0:
        return False
    return h + h1 * s + h2 * s * s / 2 - third * s * s * s / 6 > 0


@njit(error_model="numpy", nogil=True)
def falling(h1: float, h2: float, third: float, s: float) -> bool:
    """Return whether h' < 0 on [0, s], if |h'''| <= third."""
    return h1 < 0 and h1 + h2 * s / 2 < 0 and h1 + h2 * s + third * s * s / 2 < 0


@njit(error_model="numpy", nogil=True)
def below(h: float, h1: float, h2: float, third: float, s: float) -> bool:
    """Return whether h < 0 at s, if |h'''| <= third."""
    return h + s * (h1 + s * (h2 / 2 + s * third / 6)) < 0


def _named(function: Function, along: Function) -> Function:
    """Compile a function for guards of one kind, under a name that no other kind has.

    What is compiled finds other compiled code by name.  Code that is kept, of one kind, would find
    that of another kind which was compiled before it in the process.
    """
    function.__qualname__ = f"{function.__name__}_{along.__module__}_{along.__name__}"
    return cast(Function, njit(function, error_model="numpy", nogil=True))


@lru_cache
def root_of(along: Function, value: Function) -> Function:
    """Return the function `root` for guards of one kind.

    value(a, rates, d, turn) is h at d; ``turn`` is the cosine and the sine of the angle by which
    the clock has turned, NaN where they are not known.
    """

    def root(a: Tuple, rates: Tuple, ends: Ends, d: float, turn: Turn) -> float:
        """Return the zero in [low, high] before which h > 0, by parabolas; d is a guess.

        ``ends`` are low, high, and whether it is known that h <= 0 at high, whose ``turn`` is
        given; if not, there may be no zero, inf.
        """
        low, high, known = ends
        inside = low < d < high
        for _ in range(ROUNDS):
            if not inside:
                if not known and value(a, rates, high, turn) > 0:
                    return math.inf
                known, d = True, low + (high - low) / 2
                if high - low <= CLOSE * d:
                    break
            h, h1, h2 = along(a, rates, d)
            if h > 0:
                low = d
            else:
                high, known = d, True
            q = h1 * h1 - 2 * h * h2
            step = 2 * h / (-h1 + math.sqrt(q)) if h1 < 0 and q > 0 else math.inf
            inside = low <= d + step <= high
            if inside:
                d += step
                if abs(step) ** 3 <= 1e-15 * d or abs(step) <= CLOSE * d:
                    break
        return d

    return _named(root, along)


@lru_cache
def first_of(along: Function, value: Function) -> Function:
    """Return the function `first` for guards of one kind."""
    root = root_of(along, value)

    def first(a: Tuple, rates: Tuple, D: float, turn: Turn) -> float:
        """Return the first time in [0, D] at which h comes to zero, inf if there is none.

        On each piece h > 0, or h' < 0, by Taylor's formula with a bound of h''' (Lemma B of
        `cap.system.lemmas`).  A guard that is zero at first, or less by rounding, comes to zero at
        once if it falls there.
        """
        h, h1, h2 = max(a[0], 0.0), a[1], a[2]
        if a[0] <= 0 and (h1 < 0 or (h1 == 0 and h2 < 0)):
            return 0.0
        third = steepest(a, rates, D)
        fall = parabola(h, h1, h2)
        late = min(LATE * fall, D)
        if h2 + third * late < 0 and below(h, h1, h2, third, late):
            return float(root(a, rates, (0.0, late, True), fall, turn))  # concave there: one zero
        t, step = 0.0, min(D, max(EARLY * fall, SHORTEST))
        while t < D:
            length, falls = min(step, D - t), False
            while length > SHORTEST and not positive(h, h1, h2, third, length):
                falls = falling(h1, h2, third, length)
                if falls:
                    break
                length *= 0.5
            end = min(t + length, D)
            if falls and below(h, h1, h2, third, end - t):
                return float(root(a, rates, (t, end, True), t + parabola(h, h1, h2), turn))
            if end >= D and not falls:
                return math.inf
            n, n1, n2 = along(a, rates, end)
            if n <= 0 and (falls or n1 < 0):
                return (
                    root(a, rates, (t, end, True), t + parabola(h, h1, h2), turn) if falls else end
                )
            t, h, h1, h2, step = end, n, n1, n2, 2.5 * length
        return math.inf

    return _named(first, along)


@lru_cache
def decreasing_of(along: Function, value: Function) -> Function:
    """Return the function `decreasing` for guards of one kind (Lemma M of `cap.system.lemmas`)."""
    root = root_of(along, value)

    def decreasing(a: Tuple, rates: Tuple, D: float, turn: Turn) -> float:
        """Return when h comes to zero in [0, D], if it decreases there; inf if it does not."""
        if a[0] <= 0 and (a[1] < 0 or (a[1] == 0 and a[2] < 0)):
            return 0.0
        return float(root(a, rates, (0.0, D, False), parabola(a[0], a[1], a[2]), turn))

    return _named(decreasing, along)


@lru_cache
def clocked_of(along: Function, value: Function) -> Function:
    """Return the function `clocked` for guards of one kind (Lemma C of `cap.system.lemmas`)."""
    root = root_of(along, value)

    def clocked(a: Tuple, rates: Tuple, D: float, turn: Turn, lowest: Lowest) -> float:
        """Return when h comes to zero in [0, D], inf if it does not.

        h is least at the time ``lowest[0]`` > 0, and periods ``lowest[1]`` later, where the turn is
        ``lowest[2]``; between them it rises, then falls, or it falls, as after the last one.
        """
        if a[0] <= 0 and (a[1] < 0 or (a[1] == 0 and a[2] < 0)):
            return 0.0
        low, fall = 0.0, parabola(a[0], a[1], a[2])
        least, period, there = lowest
        while least < D:
            if value(a, rates, least, there) <= 0:
                return float(root(a, rates, (low, least, True), fall, there))
            low, fall, least = least, math.inf, least + period
        return float(root(a, rates, (low, D, False), fall, turn))

    return _named(clocked, along)


@njit(error_model="numpy", nogil=True)
def turned(y: float, turn: Turn) -> tuple[float, float]:
    """Return R(i y), if the turn is the cosine of y and the sine, or is not known."""
    if y < SHORT or not abs(turn[0]) <= 2:
        return imaginary(0.0, y)
    return turn[0] - 1 + y * y / 2, turn[1] - y


@njit(error_model="numpy", nogil=True)
def captures(u: float, up: float, down: float, e: float, size: float) -> bool:
    """Return whether infinitely many hits accumulate at once after one that is left at the speed u.

    h'' is -up while h grows, -down while it falls.  They do if they end within `SOON`, or if h
    stays below the rounding errors of its terms, whose ``size`` is given.
    """
    still = u * u < FLAT * up * size
    if not (up > 0 and down > 0 and u >= 0 and (u < SOON * up or still)):
        return False  # u/up is less than what is left
    root = math.sqrt(down / up)
    ratio, left = e * root, u * (1 + 1 / root) / up
    return ratio < 1 and (left < SOON * (1 - ratio) or still)
