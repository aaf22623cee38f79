"""A system as data: polynomials, Lie derivatives, and closed forms of flights."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy
from support import seeded

from cap.checker.flow.one_mass import MODES
from cap.checker.kernel.rejection import Rejected
from cap.checker.system.course import ELAPSED, GROWTH, INVERSE, course, flight, response
from cap.checker.system.friction import LEFT, REST, RIGHT
from cap.checker.system.model import COS, SIN, Mode, Model
from cap.checker.system.polynomial import ONE, ZERO, Polynomial, variable
from checker.oscillator import oscillator

X, V, C, S = map(variable, ("x", "v", COS, SIN))
NAMES = "x", "v", "cos", "sin", "mu"
w, t, d = sympy.symbols("w t d", positive=True)


def symbolic(q):
    """Return a polynomial for sympy."""
    terms = q.terms.items()
    return sum((sympy.Rational(c) * sympy.prod(map(sympy.Symbol, m)) for m, c in terms), sympy.S(0))


def is_zero(expression):
    """Return whether an expression vanishes identically."""
    return sympy.simplify(expression) == 0


def some_polynomial(rng):
    """Return a random polynomial, now and then a constant."""
    terms = [rng.choices(NAMES, k=rng.randint(0, 3)) for _ in range(rng.randint(1, 4))]
    number = [Fraction(rng.randint(-3, 3), rng.randint(1, 3)) for _ in terms]
    return Polynomial({tuple(sorted(m)): c for m, c in zip(terms, number, strict=True)})


# polynomials


def test_the_algebra_of_polynomials():
    """Sums, products, derivatives, and terms left out are those of sympy."""
    rng = seeded(29)
    for _ in range(60):
        p, q = some_polynomial(rng), some_polynomial(rng)
        a, b = symbolic(p), symbolic(q)
        for found, truth in (
            (p + q, a + b),
            (p - q, a - b),
            (-p, -a),
            (p * q, a * b),
            (2 - p, 2 - a),
            (p * Fraction(2, 3) + 1, a * sympy.Rational(2, 3) + 1),
            *((p.derivative(z), sympy.diff(a, sympy.Symbol(z))) for z in NAMES),
            (p.without(["x", "v"]), a.subs({"x": 0, "v": 0})),
        ):
            assert sympy.expand(symbolic(found) - truth) == 0
        a_x = [sympy.diff(a, "x", n).subs("x", 0) / sympy.factorial(n) for n in range(4)]
        found = [*map(symbolic, p.coefficients("x")), 0, 0, 0]
        assert not any(sympy.expand(c - truth) for c, truth in zip(found, a_x, strict=False))
        swapped = symbolic(p.substituted({"x": variable("v") * 2, "v": q}))
        names = {"x": 2 * sympy.Symbol("v"), "v": b}
        assert sympy.expand(swapped - a.subs(names, simultaneous=True)) == 0
        assert p.variables == {str(z) for z in sympy.expand(a).free_symbols}
        assert (p == q) == (sympy.expand(a - b) == 0)
        assert p + q - q == p
        assert hash(p + q - q) == hash(p)
        assert sympy.expand(a.subs(dict.fromkeys(NAMES, 0)) - p.number) == 0


def test_lie_derivatives():
    """They are the derivatives in time along solutions, by the chain rule."""
    rng, model = seeded(30), oscillator(omega=Fraction(3, 2))
    for _ in range(30):
        h, mode = some_polynomial(rng), rng.choice([RIGHT, LEFT, REST])
        x, v = (sympy.Function(z)(t) for z in "xv")
        angle = sympy.Rational(3, 2) * t
        moving = {"x": x, "v": v, "cos": sympy.cos(angle), "sin": sympy.sin(angle)}
        field = {z: symbolic(q).subs(moving) for z, q in model.modes[mode].field.items()}
        rate = sympy.diff(symbolic(h).subs(moving), t)
        rate = rate.subs({sympy.diff(moving[z], t): q for z, q in field.items()})
        assert sympy.expand(symbolic(model.lie(mode, h)).subs(moving) - rate) == 0


# flights


VISCOSITIES = Fraction(0), Fraction(1, 7), variable("mu")
OMEGA = Fraction(3, 2)


def viscosity(mu):
    """Return a viscosity for sympy; one that is a parameter is positive."""
    return symbolic(Polynomial.of(mu)).subs("mu", sympy.Symbol("mu", positive=True))


def unfolded(q, mu):
    """Return a polynomial of ``course`` for sympy, with what its names stand for."""
    m = viscosity(mu)
    names = {name: integrals(k, -m * d) for k, name in enumerate(GROWTH)}
    names |= {INVERSE: 1 / (sympy.Rational(OMEGA) ** 2 + m**2), ELAPSED: d, "mu": m}
    return symbolic(q).subs({sympy.Symbol(name): value for name, value in names.items()})


def parts(model, mode, mu):
    """Return U and V of the responses of x and v in a mode, for sympy."""
    found = [response(model, mode, z) for z in "xv"]
    return [[unfolded(q.derivative(z), mu) for q in found] for z in (COS, SIN)]


def integrals(k, z):
    """Return phi_k of the checker, in closed form."""
    if z == 0:
        return sympy.Rational(1, sympy.factorial(k))
    head = sum(z**n / sympy.factorial(n) for n in range(k))
    return (sympy.exp(z) - head) / z**k


def followed(model, mode, z, mu):
    """Return x or v less its response after the time d, for sympy."""
    return unfolded(flight(model, mode, z) - response(model, mode, z), mu)


@pytest.mark.parametrize("mu", VISCOSITIES)
@pytest.mark.parametrize("s", [1, -1])
def test_courses_and_responses_solve_the_equation(s, mu):
    """Symbolically: their sum has the derivative of the field, and begins at x, v."""
    model = oscillator(OMEGA, mu=mu)
    U, V = parts(model, MODES[s], mu)
    angle = sympy.Rational(OMEGA) * (t + d)
    forced = [u * sympy.cos(angle) + v * sympy.sin(angle) for u, v in zip(U, V, strict=True)]
    rests = [followed(model, MODES[s], z, mu) for z in "xv"]
    x, v = (rest + q for rest, q in zip(rests, forced, strict=True))
    assert [sympy.limit(q, d, 0) for q in rests] == list(sympy.symbols("x v"))
    force = 2 * sympy.cos(angle) - s * sympy.Rational(2, 5) - viscosity(mu) * v
    assert is_zero(sympy.diff(x, d) - v)
    assert is_zero(sympy.diff(v, d) - force)


@pytest.mark.parametrize("mu", VISCOSITIES)
@pytest.mark.parametrize("s", [1, -1])
def test_they_are_the_closed_forms_of_the_oscillator(s, mu):
    """With P = F/(mu^2 + w^2), x_p = P ((mu/w) sin wt - cos wt), v_p = P (mu cos wt + w sin wt),
    x less x_p is X + A d - C k(d), v less v_p is A - C h(d), C = mu A + s f; h, k as below."""
    model, m, omega = oscillator(OMEGA, mu=mu), viscosity(mu), sympy.Rational(OMEGA)
    P = 2 / (m**2 + omega**2)
    U, V = parts(model, MODES[s], mu)
    for found, truth in zip((*U, *V), (-P, P * m, P * m / omega, P * omega), strict=True):
        assert is_zero(found - truth)
    x, A = sympy.symbols("x v")
    damping = m * A + s * sympy.Rational(2, 5)
    h, k = d, d**2 / 2
    if m != 0:
        h = (1 - sympy.exp(-m * d)) / m
        k = (d - h) / m
    assert is_zero(followed(model, MODES[s], "x", mu) - (x + A * d - damping * k))
    assert is_zero(followed(model, MODES[s], "v", mu) - (A - damping * h))


def bare(omega=Fraction(1), **field):
    """Return a model of one mode without guards."""
    return Model(tuple(field), omega, {"mode": Mode(field, {})})


def test_other_courses():
    """A rate of growth; two of them; a cubic. A spring, or a product, is not of a known form."""
    a = variable("a")
    grown = course(bare(x=X * a), "mode", X)
    assert grown == ((X,), a)
    cubic = course(bare(x=V, v=variable("u"), u=ONE), "mode", X)
    assert cubic == ((X, V, variable("u"), ONE), ZERO)
    for field in ({"x": V, "v": -X}, {"x": V, "v": X * V}, {"x": X * X}):
        with pytest.raises(Rejected, match="not of a known form"):
            course(bare(**field), "mode", X)


def test_cubic_flights():
    """Four variables, of which each drives the one before: x is a cubic and its response."""
    model = bare(OMEGA, x=V, v=variable("u"), u=1 + C)
    x = flight(model, "mode", "x")
    over = Fraction(1) / OMEGA
    D = variable(ELAPSED)
    cubic = X + V * D + variable("u") * D * D * Fraction(1, 2) + D * D * D * Fraction(1, 6)
    assert x == cubic - S * over**3


def test_other_responses():
    """Only of linear fields, and where no variable drives one that comes after it."""
    for field in (V * X, V * C, C * C, C * S, V * V * V, X * X + C, C - X):
        with pytest.raises(Rejected, match="not linear"):
            response(bare(x=V, v=field), "mode", "v")
    with pytest.raises(Rejected, match="not of a known form"):
        flight(bare(x=V, v=C - X), "mode", "x")
    grown = response(bare(Fraction(2), x=X + 5 * C), "mode", "x")
    assert grown == S * 2 - C
