"""Lemma B: a guard stays positive on a leg, for given cuts; on a damped spring before a wall."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from typing import NamedTuple

import pytest
from mpmath import mp
from support import number, rational, rounds, seeded

from cap.checker.kernel.rejection import Rejected
from cap.checker.system import quiet
from cap.checker.system.friction import LEFT, REST, RIGHT, STOP, WALL
from cap.checker.system.legs import Leg, matrix
from cap.checker.system.legs import rational as plain
from cap.checker.system.model import COS, SIN, Guard, Mode, Model
from cap.checker.system.polynomial import ZERO, Polynomial, variable
from cap.checker.system.quiet import Watched
from checker.oscillator import oscillator
from checker.parts import Interval
from checker.springs import FLY, flown, spring, springy

BITS, THIN = 96, Fraction(1, 2**60)
X, V, C, S = map(variable, ("x", "v", COS, SIN))


def around(q, far=THIN):
    """Return an interval around a number."""
    return Interval.enclosing(Fraction(q) - far, Fraction(q) + far, BITS)


def leg(model, start, *state, far=THIN, mode=FLY):
    """Return the flights from near a state."""
    values = dict(zip(model.state, (around(q, far) for q in state), strict=True))
    return Leg(model, mode, around(start, far), values)


def stays_positive(flights, h, end, cuts, zeros=(0, 0)):
    """Prove it of a polynomial."""
    watched = Watched.of(flights.model, flights.mode, h)
    quiet.stays_positive(flights, watched, end, cuts, zeros)


def zeros_after(model, mode, h, event):
    """Return how many of h, L h vanish."""
    return quiet.zeros_after(Watched.of(model, mode, h), event)


def evenly(a, b, n):
    """Return n - 1 cuts between two times."""
    return [a + (b - a) * Fraction(k, n) for k in range(1, n)]


# flights


@pytest.mark.parametrize("damping", ["0", "1/20", "2"])
@pytest.mark.parametrize(("stiffness", "omega"), [(1, "27/10"), (0, "3/2"), (4, "2"), (-1, "1")])
def test_flights(damping, stiffness, omega):
    """Springs, none, resonance, an unstable one: at random times, before the start as well."""
    rng, model = seeded(11), spring(damping=damping, stiffness=stiffness, omega=omega)
    M = springy(damping=damping, stiffness=stiffness, omega=omega)
    assert plain(matrix(model, FLY), FLY) == M
    for _ in range(rounds(6)):
        start, x, v, t = (Fraction(rng.randint(-200, 200), 100) for _ in range(4))
        flights = leg(model, start, x, v, far=0)
        found = flights.state(around(t, 0))
        with mp.workdps(50):
            truth = flown(M, [number(x), number(v)], omega, number(start), number(t))
        for z, value in zip(model.state, truth, strict=True):
            assert found[z].lower <= rational(value) <= found[z].upper
            assert found[z].upper - found[z].lower < Fraction(1, 10**20)
        g = X * V - C * S + 2
        with mp.workdps(50):
            angle = number(Fraction(omega)) * number(t)
            product = truth[0] * truth[1] - mp.cos(angle) * mp.sin(angle) + 2
            assert abs(rational(product) - flights.over(g, around(t, 0)).lower) < 10**-18


def test_sets_of_flights():
    """All starts, states and times of intervals."""
    rng, model = seeded(12), spring()
    M, far = springy(), Fraction(1, 50)
    flights = leg(model, "1/3", "1/5", "-1/2", far=far)
    t = Interval.enclosing(Fraction(1), Fraction(11, 10), BITS)
    found = flights.state(t)
    for _ in range(rounds(30)):
        a, b, c = (rng.choice([-1, 1, Fraction(rng.randint(-9, 9), 10)]) * far for _ in range(3))
        now = Fraction(rng.randint(100, 110), 100)
        state = Fraction(1, 5) + b, Fraction(-1, 2) + c
        with mp.workdps(40):
            truth = flown(M, map(number, state), "27/10", number(Fraction(1, 3) + a), number(now))
            for z, value in zip(model.state, truth, strict=True):
                assert found[z].lower <= rational(value) <= found[z].upper


def test_a_field_with_all_parts():
    """A constant, the cosine and the sine, in each row: the matrix, and a flight."""
    field = {"x": V * 2 + C * 3 - S * 5 + 7, "v": X * -1 - C + S * 4 - Fraction(1, 2)}
    model = Model(("x", "v"), Fraction(3, 2), {FLY: Mode(field, {})})
    rows = [0, 2, 3, -5, 7], [-1, 0, -1, 4, "-1/2"], [0, 0, 0, "-3/2", 0], [0, 0, "3/2", 0, 0]
    M = [[Fraction(q) for q in row] for row in (*rows, [0] * 5)]
    assert plain(matrix(model, FLY), FLY) == M
    found = leg(model, "1/2", 1, -2, far=0).state(around(2, 0))
    with mp.workdps(50):
        truth = flown(M, [1, -2], "3/2", number(Fraction(1, 2)), 2)
    for z, value in zip(model.state, truth, strict=True):
        assert found[z].lower <= rational(value) <= found[z].upper


@pytest.mark.parametrize("field", [{"x": X * V}, {"x": V, "v": C * X}, {"x": V * variable("mu")}])
def test_what_is_not_linear(field):
    """A product of variables, a force that varies with the place, a parameter."""
    model = Model(("x", "v"), Fraction(1), {FLY: Mode({"x": ZERO, "v": ZERO} | field, {})})
    with pytest.raises(Rejected, match="is not linear"):
        matrix(model, FLY)


# the lemma


def dip():
    """Return flights over a wall that dips, its height, and the time and height of the dip."""
    model = spring(wall="2", damping="0", omega="1", force=0)
    return leg(model, 0, 0, 1), 2 - X  # x = sin t


def test_a_dip():
    """1 + a - sin t: positive for a > 0, with cuts that are near enough around the dip."""
    flights, _ = dip()
    end, cuts = around(3), evenly(Fraction(0), Fraction(3), 24)
    stays_positive(flights, X * -1 + Fraction(11, 10), end, cuts)
    for less in ("1", "999/1000", "1/2"):
        with pytest.raises(Rejected, match="may vanish near"):
            stays_positive(flights, X * -1 + Fraction(less), end, cuts)
    wide = [t for t in cuts if not Fraction(6, 5) < t < Fraction(19, 10)]
    with pytest.raises(Rejected, match=r"may vanish near 1\.5"):
        stays_positive(flights, X * -1 + Fraction(1001, 1000), end, wide)


def test_every_piece_counts():
    """A guard that is negative only in one piece, each in turn, at both ends of it."""
    flights, _ = dip()
    end, cuts = around(Fraction(3, 2)), evenly(Fraction(0), Fraction(3, 2), 8)
    for k in range(17):
        time = Fraction(3 * k, 32)
        with mp.workdps(30):
            place = rational(mp.sin(number(time)))
        square = (X - place) * (X - place)  # 0 at this time alone
        with pytest.raises(Rejected, match="may vanish near"):
            stays_positive(flights, square - Fraction(1, 10**9), end, cuts)
    stays_positive(flights, X * X + Fraction(1, 10**9) + 1, end, cuts)


def test_cuts_in_order():
    """They increase, after the start and before the end; then the pieces cover the leg."""
    flights, h = dip()
    cuts = evenly(Fraction(0), Fraction(3), 8)
    stays_positive(flights, h, around(3), cuts)
    for bad in (
        cuts[::-1],
        [*cuts[:2], cuts[1], *cuts[2:]],
        [-1, *cuts],
        [*cuts, 4],
        [cuts[0]] * 2,
    ):
        with pytest.raises(Rejected, match="not in order"):
            stays_positive(flights, h, around(3), bad)


def test_a_vague_start_and_end():
    """The first and the last piece reach as far as a start or an end may be."""
    model = spring(wall="2", damping="0", omega="1", force=0)
    vague = leg(model, 0, 0, 1, far=Fraction(1, 100))
    wide, cuts = Fraction(1, 100), evenly(Fraction(0), Fraction(1), 16)
    h = X + Fraction(1, 20)
    stays_positive(vague, h, around(1, wide), cuts)
    with pytest.raises(Rejected, match="may vanish near"):
        stays_positive(vague, X + Fraction(1, 200), around(1, wide), cuts)
    down = 1 - X * Fraction("1.18")  # sin 1.01 < 1/1.18 < sin 1.02
    stays_positive(vague, down + Fraction(1, 25), around(1, wide), cuts)
    with pytest.raises(Rejected, match="may vanish near"):
        stays_positive(vague, down, around(1, Fraction(1, 50)), cuts)


class Asked(NamedTuple):
    """Flights on which all is positive: what one asks of them is noted."""

    model: Model
    mode: str
    start: Interval
    asked: list

    def over(self, g, t):
        """Return 1."""
        self.asked.append((g, t.lower, t.upper))
        return t.integer(1)

    def begun(self, g):
        """Return 1, noted as asked at the start."""
        return self.over(g, self.start)


@pytest.mark.parametrize("zeros", [(0, 0), (1, 0), (0, 2), (2, 2)])
def test_the_pieces_cover_the_leg(zeros):
    """From the least start to the greatest end, each with the rate that is needed there."""
    model, ends = spring(), [Fraction(q) for q in ("-1/4", "1/2", "2", "13/4")]
    rates = [X]
    for _ in range(2):
        rates.append(model.lie(FLY, rates[-1]))
    flights = Asked(model, FLY, Interval.enclosing(ends[0], Fraction(1, 4), BITS), [])
    end = Interval.enclosing(Fraction(3), ends[-1], BITS)
    stays_positive(flights, X, end, ends[1:-1], zeros)
    bends = [(a, b) for g, a, b in flights.asked if g == rates[2]]
    assert bends == list(pairwise(ends))  # the curvature on every piece
    heights = {a for g, a, b in flights.asked if g == X and a == b}
    slopes = {(a, b) for g, a, b in flights.asked if g == rates[1]}
    assert {ends[1], ends[2]} <= heights
    assert ((flights.start.lower, flights.start.upper) in slopes) == (zeros[0] == 1)
    assert (ends[0] in heights) == (zeros[0] == 0)


@pytest.mark.parametrize(
    ("h", "zeros", "why"),
    [
        (X, (1, 0), None),
        (X, (0, 0), "may vanish near"),
        (X * -1, (1, 0), "just after the start"),
        (1 - variable(COS), (2, 0), None),
        (1 - variable(COS), (1, 0), "just after the start"),
        (variable(COS) - 1, (2, 0), "just after the start"),
    ],
)
def test_zeros_at_the_start(h, zeros, why):
    """x = sin t and 1 - cos t from t = 0 on."""
    model = spring(wall="2", damping="0", omega="1", force=0)
    flights = Leg(model, FLY, around(0, 0), {"x": around(0, 0), "v": around(1, 0)})
    end, cuts = around(2), evenly(Fraction(0), Fraction(2), 16)
    if why is None:
        stays_positive(flights, h, end, cuts, zeros)
    else:
        with pytest.raises(Rejected, match=why):
            stays_positive(flights, h, end, cuts, zeros)


@pytest.mark.parametrize(
    ("h", "zeros", "why"),
    [
        (X * -1, (0, 1), None),
        (X * -1, (0, 0), "may vanish near"),
        (X, (0, 1), "before the end|may vanish near"),
        (1 - variable(COS), (0, 2), None),
        (1 - variable(COS), (0, 1), "before the end|may vanish near"),
        (variable(COS) - 1, (0, 2), "before the end|may vanish near"),
        (X, (1, 1), "just after the start"),
        (X * (X + 3) * -1, (0, 1), None),
    ],
)
def test_zeros_at_the_end(h, zeros, why):
    """x = sin t and 1 - cos t until t = 0."""
    model = spring(wall="2", damping="0", omega="1", force=0)
    with mp.workdps(40):
        state = [rational(q) for q in (-mp.sin(2), mp.cos(2))]
    flights = leg(model, -2, *state)
    end, cuts = around(0), evenly(Fraction(-2), Fraction(0), 16)
    if why is None:
        stays_positive(flights, h, end, cuts, zeros)
    else:
        with pytest.raises(Rejected, match=why):
            stays_positive(flights, h, end, cuts, zeros)


def test_both_ends():
    """From hit to hit: x = sin t from 0 to pi; with one cut, not with none."""
    model = spring(wall="2", damping="0", omega="1", force=0)
    flights = leg(model, 0, 0, 1)
    end = around("3.14159265358979323846")
    stays_positive(flights, X, end, evenly(Fraction(0), Fraction(3), 8), (1, 1))
    with pytest.raises(Rejected, match="both ends of a piece"):
        stays_positive(flights, X, end, [], (1, 1))
    short = leg(model, 0, 0, 1)
    stays_positive(short, X + 1, around(Fraction(1, 10)), [])


def test_an_orbit_of_the_spring():
    """From a hit to the next one, found in mpmath: its guard is quiet between; a lower wall not."""
    model = spring()
    h, hit = model.modes[FLY].guards[WALL].value, model.modes[FLY].guards[WALL]
    M, start, v = springy(), Fraction(3, 10), Fraction(-3, 2)

    def height(t):
        state = flown(M, [number(Fraction(1, 10)), number(v)], "27/10", number(start), t)
        return number(Fraction(1, 10)) - state[0]

    with mp.workdps(40):
        end = rational(mp.findroot(height, (mp.mpf("1.5"), mp.mpf("3.4")), solver="anderson"))
        heights = [height(number(start + (end - start) * k / 40)) for k in range(1, 40)]
        assert min(heights) > 0
    flights = leg(model, start, "1/10", v)
    first = zeros_after(model, FLY, h, hit)
    assert first == 1
    cuts = evenly(start, end, 64)
    stays_positive(flights, h, around(end), cuts, (first, 1))
    with pytest.raises(Rejected):
        stays_positive(flights, h, around(end + Fraction(1, 100)), cuts)
    deep = rational(max(heights)) * Fraction(99, 100)
    stays_positive(flights, deep * Fraction(10, 9) - h, around(end), cuts)
    with pytest.raises(Rejected, match="may vanish near"):
        stays_positive(flights, deep - h, around(end), cuts)


# identities


def test_substitution():
    """A polynomial in polynomials."""
    h = X * X * V * 2 + V * C - 3
    assert h.substituted({"x": V + 1, "v": C}) == (V + 1) * (V + 1) * C * 2 + C * C - 3
    assert h.substituted({}) == h
    assert ZERO.substituted({"x": V}) == ZERO


def test_what_vanishes_after_an_event():
    """After a hit the guard of this wall, after a stop that of the stop; a rest, an impact pair."""
    model = oscillator()
    right, left = model.modes[RIGHT].guards, model.modes[LEFT].guards
    assert zeros_after(model, LEFT, left[STOP].value, right[STOP]) == 1
    assert zeros_after(model, LEFT, left[STOP].value, right[WALL]) == 0
    assert zeros_after(model, LEFT, left[WALL].value, right[WALL]) == 0
    assert zeros_after(model, LEFT, right[WALL].value, right[WALL]) == 1
    assert zeros_after(model, LEFT, left[WALL].value, left[WALL]) == 1
    rest = model.modes[REST].guards
    assert zeros_after(model, RIGHT, right[STOP].value, rest[RIGHT]) == 0
    released = Guard(rest[RIGHT].value, {"v": ZERO}, (RIGHT,))
    assert zeros_after(model, RIGHT, right[STOP].value, released) == 2
    other = Guard(rest[LEFT].value, {"v": ZERO}, (RIGHT,))
    assert zeros_after(model, RIGHT, right[STOP].value, other) == 1
    assert zeros_after(model, RIGHT, right[STOP].value, Guard(released.value, {}, (RIGHT,))) == 0


def test_multiples():
    """A constant factor, of either sign; not a factor for some terms alone."""
    model, guard = spring(), Guard(X + V * 2 - 1, {}, (FLY,))
    for factor in (1, -1, Fraction(-2, 3)):
        assert zeros_after(model, FLY, guard.value * factor, guard) >= 1
    for h in (X + V * 2, X + V - 1, X * 2 + V * 2 - 1, Polynomial.of(1), C, guard.value * X):
        assert zeros_after(model, FLY, h, guard) == 0
