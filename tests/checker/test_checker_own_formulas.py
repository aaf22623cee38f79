"""Flights that the checker has written out follow from the model: its own code, over symbols."""

from __future__ import annotations

from fractions import Fraction
from math import factorial

import pytest
import sympy
from mpmath import mp, mpf

from cap.checker.flow import free, launches, mechanics
from cap.checker.flow.free import Free
from cap.checker.flow.one_mass import MODES
from cap.checker.strips import arc, ceiling
from cap.checker.system.course import course, response
from cap.checker.system.flight import place, velocity
from cap.checker.system.friction import RIGHT
from cap.checker.system.model import COS, SIN
from cap.checker.system.polynomial import variable
from cap.checker.system.walls import Parameters
from checker.oscillator import oscillator

t, T, u, f, R, s = sympy.symbols("t T u f R s", positive=True)


class Scalar:
    """A number of sympy or mpmath with the operations of the checker's intervals."""

    def __init__(self, value):
        self.value = value

    def __add__(self, other):
        return Scalar(self.value + of(other))

    def __sub__(self, other):
        return Scalar(self.value - of(other))

    def __mul__(self, other):
        return Scalar(self.value * of(other))

    def __truediv__(self, other):
        return Scalar(self.value / of(other))

    def __neg__(self):
        return Scalar(-self.value)

    def square(self):
        """Return the square."""
        return Scalar(self.value**2)

    def sqrt(self):
        """Return the square root, in mpmath."""
        return Scalar(mp.sqrt(self.value))

    def is_positive(self):
        """Return whether it is positive."""
        return bool(self.value > 0)


def of(q):
    """Return the value of a scalar; a half exactly."""
    return q.value if isinstance(q, Scalar) else sympy.nsimplify(q) if isinstance(q, float) else q


def both(angle):
    """Return cosine and sine."""
    return tuple(Scalar(g(of(angle))) for g in (sympy.cos, sympy.sin))


def value(q, known, rational):
    """Return the value of a polynomial; ``rational`` makes its coefficients."""
    terms = ((rational(c), [known[name] for name in m]) for m, c in q.terms.items())
    return sum((c * sympy.prod(factors) for c, factors in terms), 0)


def from_the_model(model, z, start, times, functions, mode=RIGHT):
    """Return x or v on the flight in a mode, from a state ``start`` at the first time, at the
    second one: by ``course``, and the response."""
    rational, cos, sin, exp = functions
    w = rational(model.omega)
    clock = [{COS: cos(w * time), SIN: sin(w * time)} for time in times]
    forced = {y: response(model, mode, y) for y in "xv"}
    known = {y: start[y] - value(forced[y], clock[0], rational) for y in "xv"} | {"f": f}
    terms, rate = course(model, mode, variable(z))
    d, k = times[1] - times[0], len(terms) - 1
    powers, lam = [d**n / factorial(n) for n in range(k + 1)], value(rate, {}, rational)
    if lam:  # d^k phi_k(lam d) is what e^(lam d) has beyond its first k terms
        powers[k] = (exp(lam * d) - sum(lam**n * powers[n] for n in range(k))) / lam**k
    total = sum(value(q, known, rational) * power for q, power in zip(terms, powers, strict=True))
    return total + value(forced[z], clock[1], rational)


SYMBOLS = sympy.Rational, sympy.cos, sympy.sin, sympy.exp
UNITS = oscillator(F=Fraction(1), f=variable("f"), mu=Fraction(0))
X, W = (from_the_model(UNITS, z, {"x": 0, "v": u}, (t, T), SYMBOLS) for z in "xv")


def same(found, truth):
    """Return whether two expressions are equal."""
    return sympy.simplify(sympy.expand(of(found) - truth)) == 0


# flights without losses


@pytest.mark.parametrize("s", MODES)
def test_flights(s):
    """Of ``flight``: from any state, to both sides; f and s f are the halves and wholes there."""
    F, w, state = Fraction(3, 2), Fraction(2, 3), dict(zip("xv", sympy.symbols("x v"), strict=True))
    (cos, sin), (last_cos, last_sin) = (both(sympy.Rational(w) * q) for q in (t, T))
    swing, sway = sympy.Rational(F / w), sympy.Rational(F / w**2)
    X, V = Scalar(state["x"]) + cos * sway, Scalar(state["v"]) - sin * swing
    model = oscillator(omega=w, F=F, f=variable("f"), mu=Fraction(0))
    x, v = (from_the_model(model, z, state, (t, T), SYMBOLS, MODES[s]) for z in "xv")
    d, f_s = Scalar(T - t), Scalar(s * f)
    assert same(place(X, V, d, f_s / 2, last_cos * sway), x)
    assert same(velocity(V, d, f_s, last_sin * swing), v)


@pytest.mark.parametrize("s", MODES)
def test_flights_without_losses(monkeypatch, s):
    """Of ``mechanics``: place and speed on a flight from any state, to both sides."""
    monkeypatch.setattr(mechanics, "lift", lambda formula, *q: formula(*q))
    F, w, state = Fraction(3, 2), Fraction(2, 3), dict(zip("xv", sympy.symbols("x v"), strict=True))
    M = mechanics.Mechanics.__new__(mechanics.Mechanics)
    M.f, M.swing, M.sway = (Scalar(q) for q in (f, sympy.Rational(F / w), sympy.Rational(F / w**2)))
    start, end = (mechanics.Moment(Scalar(q), *both(sympy.Rational(w) * q)) for q in (t, T))
    M.minima = {s: []}
    flight = M.flight(s, start, *map(Scalar, state.values()))
    model = oscillator(omega=w, F=F, f=variable("f"), mu=Fraction(0))
    x, v = (from_the_model(model, z, state, (t, T), SYMBOLS, MODES[s]) for z in "xv")
    assert same(M.place(flight, end), x)
    assert same(M.speed(flight, end), v * s)


# launches in intervals


def launch():
    """Return a launch, with its derivatives in t and u."""
    one, zero, at = Scalar(sympy.S(1)), Scalar(sympy.S(0)), launches.Phase(Scalar(t), *both(t))
    return launches.Launches(
        at, Scalar(u), (one, zero), (zero, one), (zero, zero), at, Scalar(u), True
    )


def test_ways_and_speeds(monkeypatch):
    """Of ``launches``: y and w, and their derivatives in the launch."""
    monkeypatch.setattr(launches, "within", lambda _, row: row[0] - row[0])
    gap = launches.Gap.__new__(launches.Gap)
    gap.alpha, gap.half, at = Scalar(f), Scalar(f / 2), launches.Phase(Scalar(T), *both(T))
    for q in launches.way(gap, launch(), at):
        assert same(q, X)
    for q in launches.speed(gap, launch(), at):
        assert same(q, W)
    for row, truth in (
        (launches.way_slopes(gap, launch(), Scalar(T)), X),
        (launches.speed_slopes(gap, launch()), W),
    ):
        for q, variable_ in zip(row, (t, u), strict=True):
            assert same(q, sympy.diff(truth, variable_))


# launches in doubles


@pytest.fixture
def flown(monkeypatch):
    """Return the launches of an arc t(s), u(s) at one s, and x and v at a fixed time T."""
    monkeypatch.setattr(arc, "cos_sin", both)
    time, fast = sympy.Function("t")(s), sympy.Function("u")(s)
    at = arc.Point(Scalar(time), *both(time), *(Scalar(sympy.diff(fast, s, n)) for n in range(3)))
    own = arc.Launches.__new__(arc.Launches)
    own.near, own.all, own.dt, own.f = at, at, Scalar(sympy.diff(time, s)), Scalar(f)
    on_arc = {t: time, u: fast}
    return own, X.subs(on_arc), W.subs(on_arc), sympy.diff(time, s, 2)


def test_arcs(flown):
    """Of ``arc``: x and v at a time, with two derivatives along an arc, on which t'' = 0."""
    own, x, v, straight = flown
    for found, truth in ((own.place(Scalar(T)), x), (own.velocity(Scalar(T)), v)):
        for n, q in enumerate(found):
            assert same(of(q).subs(straight, 0), sympy.diff(truth, s, n).subs(straight, 0))


def test_the_slope_of_a_hit(flown):
    """N = V T', by the implicit function theorem."""
    own, x, _, _ = flown
    assert same(arc.numerator(own, own.near, Scalar(T)), -sympy.diff(x, s))


def test_flights_by_their_times(monkeypatch):
    """Of ``ceiling``: with the speed u found the way is R, and V is the speed then."""
    monkeypatch.setattr(ceiling, "cos_sin", both)
    own = ceiling.Flights.__new__(ceiling.Flights)
    own.f, own.R = Scalar(f), Scalar(R)
    found = own.of(Scalar(t), Scalar(T - t))
    assert same(found.T, T)
    assert same(Scalar(X.subs(u, of(found.u))), R)
    assert same(Scalar(W.subs(u, of(found.u))), of(found.V))
    assert same(found.sum, of(found.V) + of(found.u))
    assert same(found.difference, of(found.V) - of(found.u))


# the velocity of a mass that touches nothing


class Real(Free):
    """The theorems' closed form in numbers of mpmath."""

    HINTS = CLAIMS = ()

    def __init__(self, p):
        self.p, self.step = p, lambda _: None

    def number(self, q):
        """Return a rational number."""
        return Scalar(real(Fraction(q)))

    def pi(self):
        """Return pi."""
        return Scalar(+mp.pi)

    def arcsin(self, q):
        """Return the arcsine."""
        return Scalar(mp.asin(q.value))

    def prove(self):
        """Prove nothing."""

    def words(self):
        """Say nothing."""


def real(q):
    """Return a rational number in mpmath."""
    return mpf(q.numerator) / q.denominator


def phi(n, z):
    """Return the integral that defines it."""
    if n == 0:
        return Scalar(mp.exp(z.value))
    return Scalar(
        mp.quad(lambda y: (1 - y) ** (n - 1) * mp.exp(z.value * y), [0, 1]) / factorial(n - 1)
    )


@pytest.mark.parametrize("mu", ["0", "1/7", "1/3"])
@pytest.mark.parametrize(("F", "omega"), [("1", "1"), ("3/2", "2/3")])
def test_the_free_velocity(monkeypatch, F, omega, mu):
    """Of ``free``: from rest at t_0 the flight of the model rests again half a period later.

    Its velocity at 0, the way until then and the stroke are those of the closed form.
    """
    monkeypatch.setattr(free, "phi", phi)
    monkeypatch.setattr(
        free, "cos_sin", lambda y: tuple(Scalar(g(y.value)) for g in (mp.cos, mp.sin))
    )
    F, omega, mu = map(Fraction, (F, omega, mu))
    model = oscillator(F=F, omega=omega, mu=mu)
    with mp.workdps(40):
        p = Parameters(F, omega, Fraction(2, 5), Fraction(-5), Fraction(5), Fraction(1), mu)
        found = Real(p).velocity()
        begin = -found.y.value / real(omega)
        half, rest = begin + mp.pi / real(omega), {"x": mpf(0), "v": mpf(0)}

        def at(z, end):
            return from_the_model(model, z, rest, (begin, end), (real, mp.cos, mp.sin, mp.exp))

        for one, two in (
            (at("v", half), 0),
            (at("v", mpf(0)), found.v.value),
            (at("x", mpf(0)), found.below.value),
            (at("x", half), found.stroke.value),
            (real(F) * mp.cos(real(omega) * begin), found.force.value),
        ):
            assert abs(one - two) < mpf(10) ** -35
