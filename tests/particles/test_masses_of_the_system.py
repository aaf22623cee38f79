"""The checker's mechanics of two masses follows from the model as data.

The checker's own functions are run on symbols, and compared with what the model of
`cap.system.masses` says: its fields, guards, resets and Lie derivatives.  Equalities are exact.
"""

from __future__ import annotations

from fractions import Fraction
from types import SimpleNamespace

import pytest
import sympy

from cap.checker.particles import family, mechanics, monodromy, orbit, passage, stops
from cap.parameters import Parameters
from cap.system.lemmas import Falls, lemmas
from cap.system.masses import masses, second_mass
from cap.system.polynomial import ZERO, Quotient

P = Parameters(*map(Fraction, ("3/2", 2, "91/200", -1, "6/5")))
M = Fraction(1), Fraction(9, 10)
M_2 = M[1]
STATE = ("x1", "x2", "v1", "v2")
T, A = sympy.symbols("t a")
Z = sympy.symbols(" ".join(STATE))
MOVING = [(1, 1), (1, -1), (-1, 1), (-1, -1)]
CONTACTS = ("hit l", "hit r", "meet 1 2")


class Symbol:
    """A scalar of the checker that is a formula."""

    def __init__(self, formula, bits=0):
        self.formula, self.bits = sympy.sympify(formula), bits

    def __add__(self, other):
        return Symbol(self.formula + plain(other))

    def __sub__(self, other):
        return Symbol(self.formula - plain(other))

    def __mul__(self, other):
        return Symbol(self.formula * plain(other))

    def __truediv__(self, other):
        return Symbol(self.formula / plain(other))

    def __neg__(self):
        return Symbol(-self.formula)

    def square(self):
        """Return the square."""
        return Symbol(self.formula**2)

    def integer(self, n):
        """Return an integer."""
        return Symbol(n)


def plain(q):
    """Return a formula."""
    if isinstance(q, Symbol):
        return q.formula
    return sympy.Rational(q.numerator, q.denominator) if isinstance(q, Fraction) else q


def number(_self, q):
    """Return a rational as a formula."""
    return Symbol(plain(q if isinstance(q, Symbol) else Fraction(q)))


@pytest.fixture(params=[1, 3], ids=["the model", "the model with other friction"])
def of(request, monkeypatch):
    """Return the checker's mechanics in symbols, and the model; or one with another friction."""
    monkeypatch.setattr(mechanics, "pi", lambda _bits: Symbol(sympy.pi))
    monkeypatch.setattr(mechanics, "arccos", lambda q: Symbol(sympy.acos(plain(q))))
    monkeypatch.setattr(mechanics.Mechanics, "number", number)
    p = mechanics.MassParameters(P.F, P.omega, P.f, P.l, P.r, masses=M)
    model = masses(Parameters(P.F, P.omega, P.f * request.param, P.l, P.r), M)
    return SimpleNamespace(M=mechanics.Mechanics(p, 64), model=model, same=request.param == 1)


def instant(t):
    """Return a time with its cosine and sine."""
    return mechanics.Instant(Symbol(t), Symbol(sympy.cos(2 * t)), Symbol(sympy.sin(2 * t)))


def formula(q, t=T):
    """Return a rational function of the model as a formula, at a time."""
    top, bottom = (
        sum(
            (plain(c) * sympy.prod([named(z, t) ** n for z, n in monomial]))
            for monomial, c in part.terms.items()
        )
        for part in (Quotient.of(q).numerator, Quotient.of(q).denominator)
    )
    return top / bottom


def named(name, t):
    """Return a variable of the model."""
    clock = {"cos": sympy.cos(2 * t), "sin": sympy.sin(2 * t)}
    return clock.get(name) or sympy.Symbol(name)


def mode(signs):
    """Return the name of a mode."""
    return "".join("-0+"[s + 1] for s in signs)


def equal(a, b):
    """Return whether two formulas, or lists of them, are the same."""
    pairs = zip(sympy.flatten([a]), sympy.flatten([b]), strict=True)
    return all(sympy.simplify(plain(x) - plain(y)) == 0 for x, y in pairs)


def field(of, signs, t=T):
    """Return the field of the model."""
    return [formula(of.model.modes[mode(signs)].field[z], t) for z in STATE]


@pytest.mark.parametrize("signs", MOVING, ids=mode)
def test_flights_of_the_checker(of, signs):
    """They begin where they should, and have the model's field as their derivative in time."""
    start, x, v = instant(A), tuple(map(Symbol, Z[:2])), tuple(map(Symbol, Z[2:]))
    flight, at = mechanics.Flight(signs, start, x, v), instant(T)
    z = [of.M.place(i, flight, at).formula for i in (0, 1)]
    z += [of.M.velocity(i, flight, at).formula for i in (0, 1)]
    assert equal([q.subs(T, A) for q in z], list(Z))
    assert equal([q.diff(T) for q in z[:2]], z[2:])
    assert equal([q.diff(T) for q in z[2:]], field(of, signs)[2:]) == of.same
    accelerations = [of.M.acceleration(i, s, at) for i, s in enumerate(signs)]
    assert equal(accelerations, field(of, signs)[2:]) == of.same


def guarded(of, word):
    """Return a mode in which a contact may happen, the guard's formula, and the reset's."""
    name = next(m for m, q in of.model.modes.items() if word in q.guards and "0" not in m)
    reset = of.model.reset(name, word)
    return name, of.model.guard(name, word).value, [formula(reset[z]) for z in STATE]


@pytest.mark.parametrize("word", CONTACTS)
def test_contacts_of_the_checker(of, word):
    """Velocities after it, and the speed of approach: -L h."""
    name, h, reset = guarded(of, word)
    v = tuple(map(Symbol, Z[2:]))
    assert equal(list(of.M.after(word, v)), reset[2:])
    contact = mechanics.Contact(word, instant(T), Symbol(Z[0]), v)
    assert equal(orbit.approach(of.M, contact), -formula(of.model.lie(name, h)))


def jumped(of, h, before, after, reset):
    """Return the saltation matrix DR + (f+ - DR f-) grad h/L h."""
    R, z = sympy.Matrix(reset), sympy.Matrix(Z)
    DR, coming = R.jacobian(z), sympy.Matrix(field(of, before))
    leaving = sympy.Matrix(field(of, after)).subs(dict(zip(Z, R, strict=True)), simultaneous=True)
    slope, rate = sympy.Matrix([formula(h)]).jacobian(z), formula(of.model.lie(mode(before), h))
    return DR + (leaving - DR * coming) * slope / rate


@pytest.mark.parametrize("word", CONTACTS)
def test_saltation_of_the_checker(of, word, monkeypatch):
    """It is that of the model, for signs before and after that a contact can have."""
    name, h, reset = guarded(of, word)
    before = tuple("-0+".index(s) - 1 for s in name)
    for after in [s for s in MOVING if mode(s) in of.model.guard(name, word).to]:
        signs = iter(before)
        monkeypatch.setattr(monodromy, "sign", lambda _v, signs=signs: next(signs))
        flight = SimpleNamespace(signs=after)
        monkeypatch.setattr(of.M, "flight", lambda _c, flight=flight: flight, raising=False)
        contact = mechanics.Contact(word, instant(T), Symbol(Z[0]), tuple(map(Symbol, Z[2:])))
        S = monodromy.saltation(of.M, contact)
        expected = jumped(of, h, before, after, reset)
        S = sympy.Matrix([[plain(c) for c in row] for row in S])
        # at a wall, and where s_1 + s_2 is kept with equal signs, friction drops out
        assert equal(S, expected) or not of.same
        if word == "meet 1 2" and sum(after) != sum(before):
            assert equal(S, expected) == of.same


def test_the_second_mass_as_a_parameter():
    """With k = 1/q and so on it is the model of two numbers, but for how a bounce is written."""
    m, q = M
    numbers = {"k": 1 / q, "a": 2 * q / (m + q), "b": 2 * m / (m + q), "c": (q - m) / (m + q)}
    found, model = second_mass(P, m).at(numbers), masses(P, M)
    assert found.state == model.state
    for name, mode in model.modes.items():
        assert found.modes[name].field == mode.field
        assert found.modes[name].guards.keys() == mode.guards.keys()
        for guard, h in mode.guards.items():
            other = found.guard(name, guard)
            assert (other.value, other.to) == (h.value, h.to)
            zero = {f"v{i + 1}": ZERO for i in range(2) if name[i] == "0"}
            for z, new in model.reset(name, guard).items():
                q = found.reset(name, guard)[z]
                assert q.denominator == new.denominator == 1
                assert q.numerator.substituted(zero) == new.numerator.substituted(zero)


def test_the_rule_of_a_family(of):
    """The checker's C and its derivative, for a second mass that is not a number."""
    q = sympy.Symbol("q")
    M = family.Family.__new__(family.Family)
    M.p, M.m, M.bits = of.M.p, [Symbol(1), Symbol(q)], 0
    M.alpha = -(M.m[0] * 2 / (M.m[0] + M.m[1])) + 2
    C = sympy.Matrix([[plain(c) for c in row] for row in M.rule("meet 1 2")])
    assert equal(C.subs(q, plain(M_2)), [plain(c) for row in of.M.rule("meet 1 2") for c in row])
    v = tuple(map(Symbol, Z[2:]))
    contact = mechanics.Contact("meet 1 2", instant(T), Symbol(Z[0]), v)
    push = sympy.Matrix([plain(M.push(contact))] * 2)
    assert equal((C * sympy.Matrix(Z[2:])).diff(q), push)


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("word", ["turn", "stick"])
def test_jumps_at_stops(of, word, side):
    """The velocity is 0; what the other mass does, does not matter."""
    before, after = (side, 1), (-side if word == "turn" else 0, 1)
    h = of.model.guard(mode(before), "stop 1").value
    reset = [formula(of.model.reset(mode(before), "stop 1")[z]) for z in STATE]
    expected = jumped(of, h, before, after, reset).subs(Z[2], 0)
    v = Symbol(0), Symbol(Z[3])
    event = stops.Occurrence(f"{word} 1", instant(T), tuple(map(Symbol, Z[:2])), v, before, after)
    found = sympy.Matrix([[plain(c) for c in row] for row in passage.jump(of.M, event)])
    assert equal(found, expected) == (of.same or word == "stick")


def test_why_nothing_else_happens(of):
    """Lie derivatives: of walls and gaps stops, of stops and of bent gaps known times."""
    for signs in MOVING:
        found = lemmas(of.model, mode(signs))
        for name, guard in of.model.modes[mode(signs)].guards.items():
            if name.startswith("hit") or (name == "meet 1 2" and signs == (1, -1)):
                stopped = {"hit l": [1], "hit r": [2], "meet 1 2": [1, 2]}[name]
                others = {f"stop {i}": Fraction(1) for i in stopped}
                assert found[name] == Falls(others)
            elif name.startswith("stop"):
                i = int(name[-1]) - 1
                assert _clock(of, signs, guard.value, 1) == critical(signs[i], P.f / P.F) / M[i]
            else:
                bend = critical(signs[0], P.f / P.F) * signs[0] * (1 / M[1] - 1 / M[0])
                assert _clock(of, signs, guard.value, 2) == bend
        if signs == (-1, 1):
            assert "meet 1 2" not in of.model.modes[mode(signs)].guards


def critical(s, ratio):
    """Return s (F cos wt - s f) with the checker's critical times."""
    return Force(s * P.F, -ratio * P.F)


class Force(tuple):
    """a cos wt + c as (a, c)."""

    def __new__(cls, a, c):
        """Return the pair."""
        return super().__new__(cls, (a, c))

    def __mul__(self, q):
        return Force(self[0] * q, self[1] * q)

    def __truediv__(self, q):
        return self * (1 / q)


def _clock(of, signs, h, order):
    """Return the first or second Lie derivative as a cos wt + c, f put back if it is another."""
    for _ in range(order):
        h = of.model.lie(mode(signs), h)
    a, c = (h.terms.get(m, Fraction(0)) for m in ((("cos", 1),), ()))
    assert set(h.terms) <= {(("cos", 1),), ()}
    return Force(a, c if of.same else c / 3)
