"""Closed forms of flights in the checker follow from the model: its own code, over symbols."""

from types import SimpleNamespace

import pytest
import sympy

from cap.checker.folded import motion
from cap.checker.one_one import closed_form, pairs
from cap.checker.system.friction import LEFT, RIGHT
from checker.test_checker_own_formulas import SYMBOLS, UNITS, Scalar, both, from_the_model, of, same

t, T, u, f, alpha = sympy.symbols("t T u f alpha", positive=True)
A, B, ref = sympy.symbols("A B ref", real=True)
sin, cos = sympy.sin, sympy.cos
RING = SimpleNamespace(
    total=lambda p, q: p + q,
    product=lambda p, q: p * q,
    scaled=lambda p, c, _=0: p * c,
    moved=lambda p, c, _=0: p + c,
    size=lambda _: 0,
)


@pytest.fixture(autouse=True)
def exact(monkeypatch):
    """Square roots are those of sympy."""
    monkeypatch.setattr(Scalar, "sqrt", lambda q: Scalar(sympy.sqrt(of(q))))


def equal(found, truth):
    """Return whether two expressions are equal; halves in doubles are halves."""
    return sympy.simplify(sympy.expand(sympy.nsimplify(found) - truth, trig=True)) == 0


@pytest.mark.parametrize("push", [f, -f])
def test_folded_flights(monkeypatch, push):
    """Of ``folded.motion``: s and p at T are A and B at ref; backwards friction drives.

    And what A or B is, where the mass is at rest, or at the wall.
    """
    monkeypatch.setattr(motion, "cos_sin", lambda q: (cos(q), sin(q)))
    y = motion.Direction.__new__(motion.Direction)
    y.a, y.a_error, y.q = push, 0, RING
    start = {"x": B - cos(ref), "v": A + sin(ref)}
    mode = RIGHT if push == -f else LEFT
    p, s = (from_the_model(UNITS, z, start, (ref, T), SYMBOLS, mode) for z in "xv")
    flight, d = SimpleNamespace(A=A, B=B, ref=ref), T - ref
    for found, truth in (
        (y.speed(A, d, sin(T)), s),
        (y.place(flight, d, cos(T)), p),
        *zip(y.at(flight, T), (p, s), strict=True),
    ):
        assert equal(found, truth)
    assert equal(p.subs(B, y.start(A, d, cos(T))), 0)
    assert equal(s.subs(A, y.from_rest(d, -sin(T))), 0)


def test_closed_form(monkeypatch):
    """Of ``Symmetric``: on the flight that comes to r at t_1, the state at 0; the least speed."""
    monkeypatch.setattr(closed_form, "pi", lambda _: Scalar(sympy.pi))
    c = sympy.sqrt(1 - (sympy.pi * f / 2) ** 2)
    monkeypatch.setattr(closed_form, "arccos", lambda q: Scalar(sympy.acos(of(q))))
    rho = sympy.Symbol("rho", positive=True)
    number = Scalar(rho)
    number.bits = 0
    orbit = closed_form.Symmetric(Scalar(f), number, Scalar(c))
    t_1, speed = sympy.acos(c), of(orbit.hit_speed)
    x, v = (from_the_model(UNITS, z, {"x": 0, "v": speed}, (t_1, 0), SYMBOLS, RIGHT) for z in "xv")
    gap, found = map(of, orbit.start)
    numbers = {f: sympy.Rational(3, 10), rho: 2}
    assert abs(sympy.N((gap + x).subs(numbers), 30)) < 1e-25
    assert abs(sympy.N((found - v).subs(numbers), 30)) < 1e-25
    slow = sympy.pi / 2 + sympy.asin(f)
    least = -from_the_model(UNITS, "v", {"x": 0, "v": -speed}, (t_1, slow), SYMBOLS, LEFT)
    monkeypatch.setattr(Scalar, "is_before", lambda *_: True, raising=False)
    assert abs(sympy.N((of(orbit.slowest) - least).subs(numbers), 30)) < 1e-25


def test_least_speeds_of_pairs(monkeypatch):
    """Of ``slowest``: after the hit of the right wall at phi + pi/2 - delta with u_1."""
    monkeypatch.setattr(pairs, "pi", lambda _: Scalar(sympy.pi))
    monkeypatch.setattr(pairs, "arccos", lambda q: Scalar(sympy.acos(of(q))))
    delta, S, W = sympy.Rational(1, 3), sympy.Rational(2, 5), sympy.Rational(17, 10)
    C = sympy.sqrt(1 - S**2)
    friction = 2 * C * cos(delta) / sympy.pi
    known = {"alpha": friction, "S": S, "W": W, "sin": sin(delta)}
    pair = SimpleNamespace(**{k: SimpleNamespace(constant=Scalar(q)) for k, q in known.items()})
    pair.S.constant.bits = 0
    t_1 = -sympy.asin(S) + sympy.pi / 2 - delta
    start = {"x": 0, "v": -(W + friction * delta)}
    end = sympy.pi / 2 + sympy.asin(friction)
    v = from_the_model(UNITS, "v", start, (t_1, end), SYMBOLS, LEFT).subs(f, friction)
    assert abs(sympy.N(of(pairs.slowest(pair)) + v, 30)) < 1e-25


def test_a_wrong_formula_is_seen():
    """Twice the friction is none of the model's."""
    x = from_the_model(UNITS, "x", {"x": 0, "v": u}, (t, T), SYMBOLS)
    assert same(x, x)
    assert not equal(x.subs(f, 2 * f), x)
    assert both(t)[0].value == cos(t)
