"""Lemma M, what vanishes after a reset that divides, and first derivatives in the checker."""

from __future__ import annotations

from fractions import Fraction

import pytest
from own_systems import certificate

from cap.certificate.writer import dumps
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.slope import Slope
from cap.checker.system.evaluation import Values
from cap.checker.system.legs import Leg, solved
from cap.checker.system.model import Guard, Mode, Model
from cap.checker.system.polynomial import ONE, Polynomial, variable
from cap.checker.system.quiet import Watched, ends_positive, falls, stays_positive, zeros_after
from cap.checker.verdict import check

BITS = 80
X, V, U, C = map(variable, ("x", "v", "u", "cos"))


def thin(q):
    """Return an enclosure of a number."""
    return Interval.enclosing(Fraction(q), Fraction(q), BITS)


def falling():
    """Return x' = v, v' = -1, u' = 1."""
    field = {"x": V, "v": -ONE, "u": ONE}
    return Model(("x", "v", "u"), Fraction(1), {"fly": Mode(field, {})})


def watched(h):
    """Return a guard of this system."""
    return Watched.of(falling(), "fly", h)


def test_what_falls():
    """L(1 - x) = -v: falls while v > 0, or twice that, or with the sum of two; not else."""
    wall, speed, slow, part = map(watched, (1 - X, V, V - U, U))
    assert falls(wall, (speed,))
    assert falls(watched(3 - X * 2), (speed,))
    assert falls(
        wall,
        (
            slow,
            part,
        ),
    )
    assert not falls(wall, (slow,))
    assert not falls(wall, ())
    assert not falls(watched(X - 1), (speed,))
    assert not falls(watched(1 - X - V * Fraction(1, 10**9)), (speed,))
    assert not falls(wall, (watched(V + Fraction(1, 10**9)),))


def test_the_end():
    """It must be positive at the end, unless it is 0 there, and must not be 0 at the start."""
    flights = Leg(falling(), "fly", thin(0), {"x": thin(0), "v": thin(2), "u": thin(0)})
    ends_positive(flights, watched(2 - X), thin(1), (0, 0))
    ends_positive(flights, watched(Fraction(3, 2) - X), thin(1), (0, 1))
    with pytest.raises(Rejected, match="a guard may vanish before the end"):
        ends_positive(flights, watched(Fraction(3, 2) - X), thin(1), (0, 0))
    with pytest.raises(Rejected, match="a guard falls from zero"):
        ends_positive(flights, watched(2 - X), thin(1), (1, 0))


def thrown(force, v):
    """Return flights from x = 0 with a velocity, x'' = force."""
    field = {"x": V, "v": force}
    model = Model(("x", "v"), Fraction(1), {"fly": Mode(field, {})})
    return model, Leg(model, "fly", thin(0), {"x": thin(0), "v": thin(v)})


@pytest.mark.parametrize(
    ("force", "v", "end", "shown"),
    [
        (-ONE, 1, "19/10", True),  # t - t^2/2
        (-ONE, 1, 3, False),
        (-C, "1/10", "31/5", False),  # t/10 + cos t - 1 dips, and is positive at the end
        (-C - 1, "3/2", "8/5", True),  # by concavity alone
        (-C - 1, "3/2", "9/5", False),
    ],
)
def test_what_leaves_zero(force, v, end, shown):
    """On one piece, from x = 0 on; and the same backward in time."""
    model, flights = thrown(force, v)
    watched_ = Watched.of(model, "fly", X)
    if shown:
        stays_positive(flights, watched_, thin(end), [], (1, 0))
    else:
        with pytest.raises(Rejected, match="again just after the start"):
            stays_positive(flights, watched_, thin(end), [], (1, 0))
    end = Fraction(end)
    arrived = flights.state(thin(end))
    back = {"x": arrived["x"], "v": arrived["v"]}
    start = thin(-end)  # the force is even in time: x(-t) is a flight, too
    mirrored = Leg(model, "fly", start, {"x": back["x"], "v": -back["v"]})
    if shown:
        stays_positive(mirrored, watched_, thin(0), [], (0, 1))
    else:
        with pytest.raises(Rejected, match="already before the end"):
            stays_positive(mirrored, watched_, thin(0), [], (0, 1))


def test_no_circle():
    """A guard falls by those that have cuts, and not by one that falls by it."""
    given = certificate("elliptic")
    for leg in given["hints"]["cuts"]:
        assert leg.keys() == {"stop"}
        leg.clear()
    with pytest.raises(Rejected, match="leg 1: no cuts, and no Lemma M, for"):
        check(dumps(given).encode(), lambda _: None)


def test_a_spurious_factor():
    """A guard that has another factor is another guard: its Lie identities are not those."""
    given = certificate("elliptic")
    wall = given["parameters"]["modes"]["right"]["guards"]["wall"]
    wall["value"] = [[c, *names, "v"] for c, *names in wall["value"]]
    with pytest.raises(Rejected):
        check(dumps(given).encode(), lambda _: None)


@pytest.mark.parametrize(
    ("h", "vanishes"),
    [(X, False), (V, True), (V * 2, True), (V - 1, False), (V + X, False), (V + U, False)],
)
def test_zeros_after_a_division(h, vanishes):
    """v becomes (v + 1)/D where v + 1 comes to zero: it is 0 then.  A factor is none that is 1."""
    event = Guard(V + 1, {"v": V + 1}, ("fly",), Polynomial.of(3))
    assert (zeros_after(watched(h), event) > 0) == vanishes
    event = Guard(V + 1, {"v": (V + 1) * (ONE + X * X)}, ("fly",), ONE + X * X)
    assert (zeros_after(watched(h), event) > 0) == vanishes
    event = Guard(V + 1, {"v": V + 1 + X}, ("fly",), ONE + X * X)
    assert zeros_after(watched(h), event) == 0


def test_slopes():
    """Products and quotients have the derivatives that differences show."""

    def f(x, y):
        return (x * y + x + 7) / (y * y + x * Fraction(3))

    def slopes(x, y):
        a, b = Slope(thin(x), {0: thin(1)}), Slope(thin(y), {1: thin(1)})
        return (a * b + a + thin(7)) / (b * b + a * Fraction(3))

    point, h = (Fraction(2, 3), Fraction(-5, 4)), Fraction(1, 10**7)
    found = slopes(*point)
    assert abs(found.value.lower - f(*point)) < Fraction(1, 10**20)
    for i, x in enumerate(found.derivatives(2)):
        ahead, behind = ([q + s * h * (i == k) for k, q in enumerate(point)] for s in (1, -1))
        assert abs(x.lower - (f(*ahead) - f(*behind)) / (2 * h)) < Fraction(1, 10**11)
    assert (slopes(*point) - found).value.contains_zero()


def test_values():
    """Each product of variables once, and no unknown ones."""
    values = Values({"x": thin(2), "v": thin("1/3")}, thin(1))
    assert values.of(X * X * V * 3 - 1).contains_zero() is False
    assert values.of(X * X * V * 3 - 4).contains_zero()
    assert values.of(Polynomial({})).contains_zero()
    with pytest.raises(Rejected, match="variables that are not known"):
        values.of(U * X)


def test_linear_equations():
    """Solved with a pivot that is not the first; None if a pivot may be zero."""
    rows = [[thin(q) for q in row] for row in ((0, 2, 4), (3, 1, 5))]
    x, y = solved(rows)
    assert (x - 1).contains_zero()
    assert (y - 2).contains_zero()
    assert solved([[thin(q) for q in row] for row in ((1, 2, 4), (2, 4, 5))]) is None
