"""Lie derivatives, matrices, resets, and parameters of a system."""

from dataclasses import replace
from fractions import Fraction

import pytest
import sympy
from models import ball, parabola, spring, v, x, y

from cap.errors import BadInput
from cap.parameters import PAPER
from cap.system.friction import NAMES, friction, oscillator
from cap.system.masses import masses
from cap.system.model import Bounce, Guard, Mode, System
from cap.system.polynomial import ONE, ZERO, Polynomial, variable, variables

TIME = sympy.Symbol("t")
SYSTEMS = [
    friction(),
    oscillator(replace(PAPER, mu=Fraction(1, 10), e=Fraction(4, 5))),
    masses(PAPER, (Fraction(1), Fraction(9, 10))),
    ball(),
    parabola(),
    spring(),
]


def symbolic(q, values):
    """Return a polynomial with expressions of sympy in place of its variables."""
    return q.evaluated(values, lambda c: sympy.Rational(c.numerator, c.denominator), sympy.pi)


@pytest.mark.parametrize("system", SYSTEMS)
def test_lie_derivatives(system):
    """L h is dh/dt where z' = field: compared with sympy's chain rule, in all modes."""
    omega = symbolic(system.omega, {name: sympy.Symbol(name) for name in NAMES})
    values = {name: sympy.Symbol(name) for name in system.parameters}
    values |= {z: sympy.Function(z)(TIME) for z in system.state}
    values |= {"cos": sympy.cos(omega * TIME), "sin": sympy.sin(omega * TIME)}
    for name, mode in system.modes.items():
        rates = {values[z].diff(TIME): symbolic(q, values) for z, q in mode.field.items()}
        for guard in mode.guards.values():
            ours = symbolic(system.lie(name, guard.value), values)
            theirs = sympy.diff(symbolic(guard.value, values), TIME).subs(rates)
            assert sympy.expand(ours - theirs) == 0


@pytest.mark.parametrize("system", SYSTEMS)
def test_matrix(system):
    """M y is the field, and the clock's rates."""
    y_ = [*map(variable, (*system.state, "cos", "sin")), ONE]
    for name, mode in system.modes.items():
        product = [
            sum((a * z for a, z in zip(r, y_, strict=True)), ZERO) for r in system.matrix(name)
        ]
        clock = [-system.omega * variable("sin"), system.omega * variable("cos"), ZERO]
        assert product == [*(mode.field[z] for z in system.state), *clock]


def test_elastic_contacts_keep_energy_and_momentum():
    """And separate the masses: the bounce in the metric of the masses."""
    m = (Fraction(1), Fraction(9, 10), Fraction(7, 3))
    system = masses(PAPER, m)
    before = [variable(f"v{i}") for i in (1, 2, 3)]
    for mode, contact, i in (
        ("+-0", "meet 1 2", 0),
        ("0+-", "meet 2 3", 1),
        ("+++", "meet 2 3", 1),
    ):
        after = [system.reset(mode, contact)[f"v{k}"].numerator for k in (1, 2, 3)]
        if mode == "+++":
            assert after[i + 1] - after[i] == before[i] - before[i + 1]
        for power in (1, 2):
            old = sum((k * u**power for k, u in zip(m, before, strict=True)), ZERO)
            new = sum((k * u**power for k, u in zip(m, after, strict=True)), ZERO)
            rest = {f"v{k + 1}": ZERO for k, s in enumerate(mode) if s == "0"}
            assert (old - new).substituted(rest) == 0


@pytest.mark.parametrize("system", [ball(e=Fraction(4, 5)), parabola(e=Fraction(4, 5))])
def test_bounce_reverses_the_approach(system):
    """L h becomes -e L h at h = 0, and what is tangential stays."""
    [name] = [n for n, g in system.modes["fly"].guards.items() if isinstance(g.reset, Bounce)]
    h = system.guard("fly", name).value
    values = {z: sympy.Symbol(z) for z in (*system.state, "cos", "sin")}
    after = {
        values[z]: symbolic(q.numerator, values) / symbolic(q.denominator, values)
        for z, q in system.reset("fly", name).items()
    }
    rate = symbolic(system.lie("fly", h), values)
    new = rate.subs(after, simultaneous=True)
    assert sympy.simplify(new + sympy.Rational(4, 5) * rate) == 0


def test_parabola_as_published():
    """The reset of Church and Fortin's table, as the prototype states it by hand."""
    a, e, E = Fraction(2), Fraction(4, 5), Fraction(1)
    w, cos, pi = variables("w cos pi")
    n = 2 * a * x
    approach = w - n * v - 2 * E * pi * cos
    after = parabola(a, e, E).reset("fly", "table")
    one = 1 + n * n
    assert after["v"].numerator * one == (v * one + (1 + e) * approach * n) * after["v"].denominator
    assert after["w"].numerator * one == (w * one - (1 + e) * approach) * after["w"].denominator


def test_walls_of_friction_are_bounces():
    """On x = r, the reset (r, -e v) is that of a bounce with restitution e."""
    system = oscillator(replace(PAPER, e=Fraction(3, 4)))
    wall = system.guard("right", "wall")
    guards = {
        **system.modes["right"].guards,
        "wall": replace(wall, reset=Bounce(Polynomial.of(Fraction(3, 4)))),
    }
    bounced = replace(
        system, modes={**system.modes, "right": Mode(system.modes["right"].field, guards)}
    )
    for z, q in bounced.reset("right", "wall").items():
        at_wall = q.numerator.substituted({"x": ONE})
        assert system.reset("right", "wall")[z].numerator.substituted({"x": ONE}) == at_wall


def test_numbers_for_parameters():
    """Friction at numbers is the oscillator; some may stay open; others are refused."""
    assert friction().at({"f": Fraction(2, 5)}).parameters == tuple(n for n in NAMES if n != "f")
    closed = oscillator(PAPER)
    assert closed.parameters == ()
    assert closed.modes["left"].field["v"] == variable("cos") + Fraction(2, 5)
    with pytest.raises(BadInput, match="no parameter g"):
        friction().at({"g": Fraction(1)})


def test_bounce_at_numbers():
    """A restitution that is a parameter may become a number."""
    e = variable("e")
    fly = Mode({"y": v, "v": -ONE}, {"hit": Guard(y, ("fly",), Bounce(e))})
    system = System(("y", "v"), ONE, {"fly": fly}, ("e",))
    assert system.reset("fly", "hit")["v"].numerator == -e * v
    assert system.at({"e": Fraction(1, 2)}).reset("fly", "hit")["v"].numerator == v / -2


def test_a_rest_after_chatter():
    """Where a guard names no resting mode, who asks for it is told so."""
    assert friction().rest("right", "wall") == "held right"
    with pytest.raises(BadInput, match="names no resting mode"):
        spring().rest("fly", "stop")


def test_nothing_hits_a_wall_it_leaves():
    """The guards of two masses: contacts that can close, stops of what moves, releases."""
    system = masses(PAPER, (Fraction(1), Fraction(2)))
    assert set(system.modes["-+"].guards) == {"hit l", "hit r", "stop 1", "stop 2"}
    assert set(system.modes["+0"].guards) == {"meet 1 2", "stop 1", "release 2 r", "release 2 l"}
    assert "meet 1 2" not in system.modes["00"].guards
    assert len(system.modes) == 9


@pytest.mark.parametrize("m", [(), (0,), (1, -1), (1,) * 6])
def test_masses_refused(m):
    """No masses, masses that are not positive, too many."""
    with pytest.raises(BadInput, match="masses"):
        masses(PAPER, tuple(map(Fraction, m)))


def test_masses_lose_nothing():
    """Walls that are not elastic are not of this model."""
    with pytest.raises(BadInput, match="elastic"):
        masses(replace(PAPER, e=Fraction(1, 2)), (Fraction(1),))
