"""Flights of a mode: the differential equation, the formulas by hand, and balls."""

from dataclasses import replace
from fractions import Fraction
from math import factorial

import mpmath
import pytest
import sympy
from models import ball, parabola, spring
from support import holds, seeded

from cap.errors import BadInput
from cap.flow.model import Functions, Moment, Oscillator
from cap.parameters import PAPER
from cap.sets import interval
from cap.system.exponential import enclosed, exponential
from cap.system.flight import Scalars, flights, response
from cap.system.friction import friction, oscillator
from cap.system.masses import masses
from cap.system.model import Mode, System
from cap.system.polynomial import ONE, Polynomial, variables

T0, T = sympy.symbols("t0 t")
MASSES = (Fraction(1), Fraction(9, 10), Fraction(7, 3))


def rational(q):
    """Return an exact number of sympy."""
    return sympy.Rational(q.numerator, q.denominator)


def integral(rate, d, k):
    """Return I_k = e^(rate d) and its integrals from 0, in closed form."""
    z = sympy.sympify(rate)
    series = sum(((z * d) ** j / factorial(j) for j in range(k)), sympy.Integer(0))
    return d**k / sympy.factorial(k) if z == 0 else (sympy.exp(z * d) - series) / z**k


SYMBOLS = Scalars(rational, sympy.pi, integral)


def flown(system, mode, start=None):
    """Return the state at t of the flight from symbols x_0 ... at t_0, and those symbols."""
    found = flights(system, mode)
    values = {name: sympy.Symbol(name, positive=True) for name in system.parameters}
    omega = SYMBOLS.value(system.omega, values)
    z = start or sympy.symbols([f"{name}_0" for name in system.state])
    clock = [(sympy.cos(omega * t), sympy.sin(omega * t)) for t in (T0, T)]
    rest = found.launch(z, clock[0], values, SYMBOLS)
    return found.state_at(rest, T - T0, clock[1], values, SYMBOLS), z, values, clock[1]


MODES = [
    *((friction(), mode) for mode in ("right", "left", "rest")),
    (oscillator(PAPER), "right"),
    (oscillator(replace(PAPER, mu=Fraction(1, 10), omega=Fraction(7, 3))), "left"),
    (masses(PAPER, MASSES), "+-0"),
    (ball(), "fly"),
    (ball(), "rest"),
    (parabola(), "fly"),
]


@pytest.mark.parametrize(("system", "mode"), MODES)
def test_differential_equation(system, mode):
    """The closed form starts where it should, and its derivative is the field: symbolically."""
    state, z, values, clock = flown(system, mode)
    here = dict(zip(system.state, state, strict=True))
    here |= values | dict(zip(("cos", "sin"), clock, strict=True))
    for name, start, moved in zip(system.state, z, state, strict=True):
        assert sympy.simplify(moved.subs(T, T0) - start) == 0
        field = SYMBOLS.value(system.modes[mode].field[name], here)
        assert sympy.simplify(sympy.diff(moved, T) - field) == 0


@pytest.mark.parametrize("mu", [Fraction(0), Fraction(1, 10)])
@pytest.mark.parametrize("s", [1, -1])
def test_formulas_of_one_mass(mu, s):
    """The flight of `cap.flow.model`, evaluated in symbols, is the one from the data."""
    p = replace(PAPER, mu=mu, omega=Fraction(7, 3), f=Fraction(3, 10))

    def relax(m, d):
        return tuple(integral(-m, d, k) for k in range(3))

    def sin_cos(a):
        return sympy.sin(a), sympy.cos(a)

    by_hand = Oscillator.build(
        p, Functions(rational, sympy.pi, sin_cos, sympy.acos, sympy.sqrt, relax)
    )
    state, (x, v), _, _ = flown(oscillator(p), "right" if s > 0 else "left")
    start, end = (Moment(t, *sin_cos(by_hand.omega * t)) for t in (T0, T))
    flight = by_hand.launch(s, start, x, v)
    assert sympy.simplify(by_hand.position(flight, end) - state[0]) == 0
    assert sympy.simplify(by_hand.velocity(flight, end) - state[1]) == 0
    model = oscillator(p)
    for z, rate in (("x", by_hand.velocity(flight, end)), ("v", by_hand.acceleration(flight, end))):
        mode = model.modes["right" if s > 0 else "left"]
        here = dict(zip(("x", "v", "cos", "sin"), (*state, end.cos, end.sin), strict=True))
        assert sympy.simplify(SYMBOLS.value(mode.field[z], here) - rate) == 0


def test_formulas_of_masses():
    """v = v_0 + (F/m)(sin t - sin t_0) - s f d/m and its integral, for each mass that moves."""
    state, z, _, _ = flown(masses(PAPER, MASSES), "+-0")
    d, f = T - T0, rational(PAPER.f)
    for i, s in enumerate((1, -1, 0)):
        push, x, v = abs(s) / rational(MASSES[i]), z[i], z[3 + i]
        drag = s * f * push
        velocity = v + push * (sympy.sin(T) - sympy.sin(T0)) - drag * d
        drift = (v - push * sympy.sin(T0)) * d if s else 0
        position = x + drift - push * (sympy.cos(T) - sympy.cos(T0)) - drag * d**2 / 2
        assert sympy.expand(state[i] - position) == 0
        assert sympy.expand(state[3 + i] - velocity) == 0


def test_viscous_course_is_short():
    """x is x_0 + v_0 h - f k, as by hand, though the chain of derivatives has three terms."""
    course = flights(friction(), "right").courses[0]
    x, v, f, mu = variables("x v f mu")
    assert course.powers[0] == x
    assert not any(course.powers[1:])
    assert course.integrals == {1: v, 2: -f}
    assert course.rate == -mu


def test_springs_have_no_such_form():
    """Two eigenvalues: refused with one line."""
    with pytest.raises(BadInput, match="the mode fly have no closed form"):
        flights(spring(), "fly")


def test_resonance():
    """x'' = -x + cos t has no bounded response."""
    x, v, cos = variables("x v cos")
    system = System(("x", "v"), ONE, {"fly": Mode({"x": v, "v": cos - x})})
    with pytest.raises(BadInput, match="resonance"):
        flights(system, "fly")


def test_response_with_a_vanishing_pivot():
    """At w = 1, x'' = -x - x' + cos t has w^2 + A^2 with a zero in the corner; x = sin t."""
    x, v, cos = variables("x v cos")
    system = System(("x", "v"), ONE, {"fly": Mode({"x": v, "v": cos - x - v})})
    U, V = response(system, "fly")
    assert [q.numerator for q in (*U, *V)] == [0, 1, 1, 0]


@pytest.mark.parametrize("bits", [53, 200])
@pytest.mark.parametrize("radius", [Fraction(0), Fraction(1, 100)])
def test_exponential_of_springs(bits, radius):
    """Random matrices and times: the entries of exp(A t) at 60 digits lie in the balls."""
    random = seeded(bits)
    for _ in range(20):
        n = random.randint(1, 4)
        rows = [[Fraction(random.randint(-30, 30), 10) for _ in range(n)] for _ in range(n)]
        time = Fraction(random.randint(-300, 300), 100)
        with interval.workprec(bits), mpmath.workdps(60):
            exact = [[mpmath.mpf(q.numerator) / q.denominator for q in row] for row in rows]
            A = enclosed([[Polynomial.of(q) for q in row] for row in rows])
            ours = exponential(A, interval.around(time, radius))
            for part in (-1, 0, 1):
                t = time + part * radius * Fraction(999, 1000)
                number = mpmath.mpf(t.numerator) / t.denominator
                true = mpmath.expm(mpmath.matrix(exact) * number)
                for i in range(n):
                    for j in range(n):
                        assert holds(ours[i, j], true[i, j])
            if not radius:
                assert ours[0, 0].rel_accuracy_bits() > bits - 40


def test_whole_spring():
    """exp(M d) with the clock in M is the flight: against the formula of an undamped spring."""
    system = spring(omega=Fraction(2), damping=Fraction(0))
    d = Fraction(7, 10)
    with interval.workprec(100), mpmath.workdps(40):
        moved = exponential(enclosed(system.matrix("fly")), interval.ball(d))
        start = [interval.ball(q) for q in (Fraction(1, 2), Fraction(1, 3), 1, 0, 1)]
        x = interval.total(moved[0, j] * start[j] for j in range(5))
        t = mpmath.mpf(d.numerator) / d.denominator
        free = mpmath.mpf(1) / 2 + mpmath.mpf(1) / 3  # x - response, with the response -cos(2t)/3
        true = free * mpmath.cos(t) + mpmath.sin(t) / 3 - mpmath.cos(2 * t) / 3
        assert holds(x, true)
        assert x.rad() < 1e-25
