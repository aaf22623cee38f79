"""The map from one contact of a system to the next, in floats, for compiled code.

A point is the time of a contact, in a period from a cut on, and the free variable of the state just
before it (`cap.system.section`).  Along a flight y = (z, cos wt, sin wt, 1) has y' = M y, and the
guard is g.y: so g exp(M k s), for steps s, and exp(M k s) are tables; in the step in which the
guard comes to zero it is a polynomial, by Taylor's series.  Contacts that follow each other within
one step may be missed: nothing rests on that.
"""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from numba.extending import register_jitable

from cap.errors import BadInput
from cap.floats.coverings.polynomials import evaluated, terms
from cap.floats.findings import Floats
from cap.system.model import System
from cap.system.polynomial import COS, SIN, Polynomial, variable
from cap.system.section import Section

Six = tuple[float, float, float, float, float, float]
SIZE, SQUARE, TERMS, TRIES = 5, 25, 13, 60
PARTS, LONGEST, SHORT = 32, 4, 0.3  # steps of a period; its flights, in periods; |M| times a step
PERIOD, CUT, STEP, MOST, OMEGA, FIXED, TABLES = range(7)  # the places of constants
FORMULAS = 7


def constants(section: Section, middle: float) -> Floats:
    """Return the numbers of `contact_map`; phases are within half a period of a middle."""
    system = section.system
    omega, M = _number(system.omega), _matrix(section)
    period, norm = 2 * math.pi / omega, float(np.abs(M).sum(axis=1).max())
    parts = max(PARTS, math.ceil(period * norm / SHORT))
    names, after = (*system.state, COS, SIN), section.after
    found = list[float]()
    for q in (section.place, after.numerator, after.denominator):
        for part in (q, _by_time(q, system), q.derivative(section.free)):
            found += terms(part, names)
    step, most = period / parts, LONGEST * parts
    fixed = system.state.index(section.fixed)
    head = [period, middle - period / 2, step, most, omega, fixed, FORMULAS + len(found)]
    return np.concatenate([head, found, *_tables(M, _guard(section), step, most)])


def _tables(M: Floats, guard: Floats, step: float, most: int) -> Iterator[Floats]:
    """Give g; the rows M^n/n! and g M^n/n!; the rows exp(M k s) and g exp(M k s)."""
    yield guard
    powers = [np.eye(SIZE)]
    for n in range(1, TERMS):
        powers.append(powers[-1] @ M / n)
    once = sum((P * step**n for n, P in enumerate(powers)), np.zeros((SIZE, SIZE)))
    moved = [np.eye(SIZE)]
    for _ in range(most):
        moved.append(once @ moved[-1])
    for each in (powers, moved):
        yield np.concatenate([P.reshape(-1) for P in each])
        yield np.concatenate([guard @ P for P in each])


def _matrix(section: Section) -> Floats:
    """Return M."""
    return np.array([[_number(q) for q in row] for row in section.system.matrix(section.mode)])


def _guard(section: Section) -> Floats:
    """Return g; refuse a guard that is not linear in the clock."""
    q, names = section.value, (*section.system.state, COS, SIN)
    if q.degree > 1:
        raise BadInput(f"the guard {section.guard} of {section.mode} is not linear in cos and sin")
    return np.array([*(_number(q.derivative(z)) for z in names), _number(q.without(*names))])


def _by_time(q: Polynomial, system: System) -> Polynomial:
    """Return the derivative by the time on which the clock depends."""
    cos, sin = variable(COS), variable(SIN)
    return (q.derivative(SIN) * cos - q.derivative(COS) * sin) * system.omega


def _number(q: Polynomial) -> float:
    return float(q.evaluated({}, float, math.pi))


@register_jitable
def contact_map(y: Floats, t: float, free: float) -> tuple[bool, Six]:
    """Return whether the map is defined, its value, and its derivative row by row."""
    nowhere = False, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    if not y[CUT] < t < y[CUT] + y[PERIOD]:
        return nowhere
    one, n, G = int(y[FIXED]), int(y[MOST]), int(y[TABLES])
    other, P = 1 - one, G + SIZE
    H = P + SQUARE * TERMS
    E = H + SIZE * TERMS
    F = E + SQUARE * (n + 1)
    known, z, tangents = _after(y, t, free, P + SQUARE)
    if not known or not _dot(y, H + SIZE, z) > 0:
        return nowhere
    k = 1
    while k <= n and _dot(y, F + SIZE * k, z) > 0:
        k += 1
    if k == 1 or k > n:
        return nowhere
    z = _times(y, E + SQUARE * (k - 1), z)
    tangents = _times_two(y, E + SQUARE * (k - 1), tangents)
    d = _root(y, H, z)
    z, tangents = _moved(y, P, d, z, tangents)
    speed = _dot(y, H + SIZE, z)
    if not speed < 0:
        return nowhere
    rate, c = _dot(y, P + SQUARE + SIZE * other, z), y[G + one]
    by_t, by_free = -c * tangents[one] / speed, -c * tangents[2 + one] / speed
    end = t + (k - 1) * y[STEP] + d
    end -= math.floor((end - y[CUT]) / y[PERIOD]) * y[PERIOD]
    six = (
        end,
        z[other],
        by_t,
        by_free,
        tangents[other] + rate * by_t,
        tangents[2 + other] + rate * by_free,
    )
    return True, six


@register_jitable
def _after(y: Floats, t: float, free: float, M: int) -> tuple[bool, Any, Any]:
    """Return y just after a contact, and how the state at a later time changes, moved back.

    By t: the derivative of the state less the field; and by the free variable.
    """
    c, s = math.cos(y[OMEGA] * t), math.sin(y[OMEGA] * t)
    first = y[FIXED] == 0
    a, b = (0.0, free) if first else (free, 0.0)
    place, n = evaluated(y, FORMULAS, a, b, c, s)
    place_t, n = evaluated(y, n, a, b, c, s)
    _, n = evaluated(y, n, a, b, c, s)
    top, n = evaluated(y, n, a, b, c, s)
    top_t, n = evaluated(y, n, a, b, c, s)
    top_free, n = evaluated(y, n, a, b, c, s)
    under, n = evaluated(y, n, a, b, c, s)
    under_t, n = evaluated(y, n, a, b, c, s)
    under_free, n = evaluated(y, n, a, b, c, s)
    new = top / under
    new_t, new_free = (top_t - new * under_t) / under, (top_free - new * under_free) / under
    z = (place, new, c, s, 1.0) if first else (new, place, c, s, 1.0)
    f, g = _dot(y, M, z), _dot(y, M + SIZE, z)
    if first:
        return under != 0, z, (place_t - f, new_t - g, 0.0, new_free)
    return under != 0, z, (new_t - f, place_t - g, new_free, 0.0)


@register_jitable
def _dot(y: Floats, n: int, z: Any) -> Any:
    """Return the product with the row at the place n."""
    return y[n] * z[0] + y[n + 1] * z[1] + y[n + 2] * z[2] + y[n + 3] * z[3] + y[n + 4] * z[4]


@register_jitable
def _times(y: Floats, n: int, z: Any) -> Any:
    """Return the product with the matrix at the place n."""
    return (
        _dot(y, n, z),
        _dot(y, n + SIZE, z),
        _dot(y, n + 2 * SIZE, z),
        _dot(y, n + 3 * SIZE, z),
        _dot(y, n + 4 * SIZE, z),
    )


@register_jitable
def _times_two(y: Floats, n: int, v: Any) -> Any:
    """Return the product with two tangents, which do not move the clock."""
    a, b, c, d = y[n], y[n + 1], y[n + SIZE], y[n + SIZE + 1]
    return (
        a * v[0] + b * v[1], c * v[0] + d * v[1],
        a * v[2] + b * v[3], c * v[2] + d * v[3],
    )  # fmt: skip


@register_jitable
def _moved(y: Floats, P: int, t: float, z: Any, v: Any) -> Any:
    """Return y and tangents a part of a step later."""
    y0, y1, y2, y3, y4 = z
    v0, v1, v2, v3 = v
    power = 1.0
    for n in range(1, TERMS):
        power *= t
        a, b, c, d, e = _times(y, P + SQUARE * n, z)
        y0, y1, y2, y3, y4 = (
            y0 + power * a, y1 + power * b, y2 + power * c, y3 + power * d, y4 + power * e,
        )  # fmt: skip
        a, b, c, d = _times_two(y, P + SQUARE * n, v)
        v0, v1, v2, v3 = v0 + power * a, v1 + power * b, v2 + power * c, v3 + power * d
    return (y0, y1, y2, y3, y4), (v0, v1, v2, v3)


@register_jitable
def _root(y: Floats, H: int, z: Any) -> Any:
    """Return after what part of a step the guard comes to zero, by Newton's method in a bracket."""
    row = np.empty(TERMS)
    for n in range(TERMS):
        row[n] = _dot(y, H + SIZE * n, z)
    low, high = 0.0, y[STEP]
    t = 0.5 * high
    for _ in range(TRIES):
        h, speed = row[TERMS - 1], 0.0
        for n in range(TERMS - 2, -1, -1):
            h, speed = h * t + row[n], speed * t + h
        if h > 0:
            low = t
        else:
            high = t
        new = t - h / speed if speed < 0 else low
        if not low < new < high:
            new = 0.5 * (low + high)
        if abs(new - t) < 1e-15 * y[STEP]:
            return new
        t = new
    return t
