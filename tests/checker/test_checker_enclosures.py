"""Every formula over sets, with few bits, contains what it gives at points with many bits.

So no rounding is left out, no end exchanged, no interval replaced by its midpoint.
"""

from __future__ import annotations

from fractions import Fraction

import pytest
from mpmath import mp, mpf
from support import rounds, seeded

from cap.checker.flow.losses import Lossy as Mechanics
from cap.checker.kernel.jet import raised
from cap.checker.one_one import pairs as pairs_of_orbits
from cap.checker.one_one.closed_form import friction
from cap.checker.one_one.taylor_model import rounded
from checker.parts import (
    Enclosure,
    Interval,
    Jet,
    PaperEquation,
    Parameters,
    Pitchfork,
    Rejected,
    Symmetric,
    SymmetricOrbits,
    birth,
    cosine_of_phase,
    elliptic_frame,
    half_turn,
    in_complex_coordinate,
    over_intervals,
    real,
    regularised_twist,
)

F = Fraction
MANY = 200


def closed_form(alpha, rho):
    """Give all that is computed of both symmetric orbits."""
    for sign in (1, -1):
        orbit = Symmetric.of(alpha, rho, sign)
        yield from (orbit.c, orbit.hit_speed, orbit.t_1, orbit.k, *orbit.start, orbit.slowest)


def values_of_c(rho, c):
    """Give where pairs are born, and what only depends on c."""
    yield from (birth(rho), half_turn(rho), friction(c), cosine_of_phase(c / 2))
    proof = Pitchfork.__new__(Pitchfork)
    proof.hints = {"bits": c.bits}
    yield proof.cubic(c)


def paper_equation(theta, c):
    """Give Psi, and its Newton operator at a point."""
    yield equation(c.bits).psi(theta)


def equation(bits):
    """Return the equation at F = omega = 1, f = 2/5, R = 2."""
    theorem = SymmetricOrbits.__new__(SymmetricOrbits)
    theorem.hints, theorem.claims = {"bits": bits}, {"paper_roots": []}
    theorem.p = Parameters(F(1), F(1), F(2, 5), F(0), F(2))
    theorem.R, theorem.omega = F(2), F(1)
    return PaperEquation(theorem)


def pairs(rho, delta):
    """Give all that is computed of a pair, with two derivatives, and its twist."""
    family = over_intervals(rho)
    pair = family.at(delta, 2)
    for jet in (*pair[:7], *pair.speeds, pair.trace, *(z for hit in pair.hits for z in hit)):
        yield from jet.coefficients.values()
    yield pairs_of_orbits.slowest(pair)
    yield regularised_twist(family, family.at(delta))


def frame(a, b, c):
    """Give the angle, the coordinate and the twists of a map of determinant 1."""
    d = (b * c + 1) / a
    x = Jet(3, {(1, 0): a, (0, 1): b, (2, 0): c, (1, 1): a})
    v = Jet(3, {(1, 0): c, (0, 1): d, (0, 2): b, (1, 2): a})
    found = elliptic_frame([[a, b], [c, d]])
    yield from (found.angle, found.p, *found.q, *found.eigenvalue)
    coordinate = in_complex_coordinate(x, v, found)
    for z in coordinate.coefficients.values():
        yield from z


def slope(q, n):
    """Return the derivative of a quantity in the n-th variable."""
    return q[raised(q.box.origin)[n]]


def flight(x, v, t, e, mu):
    """Give the state, the speed and its least value on flights, and what hits and turns lose."""
    for sets in (None, {"e": ends(e), "mu": ends(mu)}):
        for s in (1, -1):
            M = Mechanics(SYSTEM, [x, v * s], [x.midpoint(), v.midpoint() * s], 2, 1, sets)
            start = M.launch()
            when = M.moment(M.constant(t))
            place, speed = M.place(start, when), M.speed(start, when)
            for q in (place, speed, when.cos, when.sin):
                yield from (q.value, slope(q, 0), slope(q, 1))
            yield M.least_speed(start, when)
            yield from (q.value for q in M.parameters.values())
            later = M.flight(-s, when, place, speed)
            for q in later.arc[:2]:
                yield from (q.value, slope(q, 1))
            yield from (m for minimum in M.minima[s] for m in (q.value for q in minimum))


SYSTEM = Parameters(F(2), F(3, 2), F(2, 5), F(-9), F(9), F(9, 10), F(1, 7))


def ends(x):
    """Return the ends of an interval."""
    return x.lower, x.upper


def matrices(a, b, c, d):
    """Give an upper bound of the norm, and the real zeros of z^2 - (a + d) z + det."""
    trace, det = a + d + 3, a * d
    yield from real(trace, det)
    yield from real(-trace, det)


FORMULAS = {
    closed_form: (["1/10", "1/2"], ["3/2", "3"]),
    values_of_c: (["1", "2"], ["1/2", "9/10"]),
    paper_equation: (["1/10", "3"], ["1/2", "9/10"]),
    pairs: (["19/10", "2"], ["1/10", "4/10"]),
    frame: (["1/2", "1"], ["-1", "-1/2"], ["1/3", "1/2"]),
    flight: (["-1", "1"], ["4", "5"], ["1/2", "3/2"], ["1/2", "9/10"], ["1/10", "1/5"]),
    matrices: (["1/2", "1"], ["1/2", "1"], ["1/2", "1"], ["1/2", "1"]),
}


@pytest.mark.parametrize("formula", FORMULAS)
@pytest.mark.parametrize("bits", [24, 40])
def test_over_sets(formula, bits):
    """The arguments vary in random intervals, also in points."""
    random, done = seeded(bits), 0
    for _ in range(rounds(40)):
        exact, sets = [], []
        for ends in FORMULAS[formula]:
            low, high = map(F, ends)
            q = low + (high - low) * F(random.randint(0, 1000), 1000)
            wide = F(random.choice([0, 0, 1, 10, 100]), 10**4)
            exact.append(Interval.enclosing(q, q, MANY))
            parts = [wide * random.choice([0, 1, 2]) for _ in range(2)]
            sets.append(Interval.enclosing(q - parts[0], q + parts[1], bits))
        try:
            found = list(formula(*sets))
        except Rejected:
            continue
        done += 1
        for n, (value, truth) in enumerate(zip(found, formula(*exact), strict=True)):
            assert value.lower <= truth.lower <= truth.upper <= value.upper, n
    assert done > 5


@pytest.mark.parametrize("bits", [12, 16, 24, 53])
def test_roots_are_in_what_is_returned(bits):
    """The first root of the paper's equation, whatever the precision: Newton's image is a set."""
    with mp.workdps(30):
        root = F(str(mp.findroot(_psi, 1.2)))
    wide = F(1, 20)
    found = equation(bits).root(Enclosure(root - wide, root + wide, ("", "")))
    low, high = (F(end, 2**bits) for end in (found.lo, found.hi))
    assert low < root < high
    assert high - low < F(1, 100) + F(40, 2**bits)


def _psi(theta):
    """Return the paper's Psi at F = omega = 1, f = 2/5, R = 2."""
    return mp.pi * mp.sin(theta) - 4 + mpf("0.4") * (mp.pi**2 / 2 - theta * (mp.pi - theta))


@pytest.mark.parametrize(("c", "nearest"), [(191, 1), (192, 2), (-64, 0), (-65, -1), (127, 1)])
def test_coefficients_are_rounded_to_the_nearest(c, nearest):
    """By hand, in units of 128; the error of a Taylor model counts half a unit for it."""
    assert rounded(c, 7) == nearest
