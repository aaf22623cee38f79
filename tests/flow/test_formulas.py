"""The straight-line flights of one mass, and its matrices of events: what the data say."""

from dataclasses import replace
from fractions import Fraction

import pytest
import sympy
from support import decimal_fraction, seeded

from cap.flow.formulas import dry
from cap.flow.model import Oscillator
from cap.flow.strobe import oscillator
from cap.parameters import PAPER, Parameters
from cap.sets import interval
from cap.system.friction import friction
from cap.system.lemmas import lemmas

SIGNS = {1: "right", -1: "left"}


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize(("F", "omega"), [(1, 1), (1, None), (None, 1), (None, None)])
def test_formulas_are_exact(seed, F, omega):
    """Over rationals they are equal to the formulas as one writes them."""
    random = seeded(seed)
    F, w = (Fraction(random.randint(2, 99), 7) if q is None else Fraction(q) for q in (F, omega))
    f, x, v, d, sin, cos = (decimal_fraction(random) for _ in range(6))
    formulas = dry({"F": F, "omega": w, "f": f}, Fraction)
    X, V = -F * cos / w**2, F * sin / w
    for s in SIGNS:
        assert formulas[s].rest(x, v, sin, cos) == (x - X, v - V)
        assert formulas[s].position(x, v, d, sin, cos) == (x + v * d - s * f * d * d / 2 + X,)
        assert formulas[s].velocity(x, v, d, sin, cos) == (v - s * f * d + V,)
        assert formulas[s].acceleration(cos) == (F * cos - s * f,)


def test_units_cost_nothing():
    """Where F and omega are exactly 1 no product with them is left; a ball around 1 is not 1."""
    ones = {"F": Fraction(1), "omega": Fraction(1), "f": Fraction(2, 5)}
    cos = Fraction(1, 3)
    assert dry(ones, Fraction)[1].acceleration(cos) == (cos - Fraction(2, 5),)
    with interval.workprec(53):
        thick = {name: interval.around(q, Fraction(1, 100)) for name, q in ones.items()}
        [a] = dry(thick, interval.ball)[1].acceleration(interval.ball(cos))
        assert a.rad() > 0.012  # of F cos and of f


def test_changed_constants_change_the_flights():
    """An oscillator that is made of another has the formulas of its own constants."""
    with interval.workprec(53):
        osc = oscillator(PAPER)
        other = replace(osc, f=interval.ball(Fraction(3, 10)))
        at = osc.moment(interval.ball(0))
        assert osc.acceleration(osc.launch(1, at, at.t, at.t), at).overlaps(
            interval.ball(Fraction(3, 5))
        )
        assert other.acceleration(other.launch(1, at, at.t, at.t), at).overlaps(
            interval.ball(Fraction(7, 10))
        )


def symbols_of(system):
    """Return how to write a polynomial of the system in symbols, and the symbols."""
    names = (*system.state, "cos", "sin", *system.parameters)
    values = {name: sympy.Symbol(name) for name in names}

    def written(q):
        rational = lambda c: sympy.Rational(c.numerator, c.denominator)  # noqa: E731
        return q.evaluated(values, rational, sympy.pi)

    return written, values


def jump(mode, guard, to):
    """Return the saltation matrix of an event of friction on h = 0, from the data alone.

    DR + (field after - DR field before) grad h/(L h).
    """
    system = friction()
    written, z = symbols_of(system)
    state = [z[name] for name in system.state]
    h = system.guard(mode, guard).value
    reset = sympy.Matrix([written(q.numerator) for q in system.reset(mode, guard).values()])
    moved = dict(zip(state, reset, strict=True))
    before, after = (
        sympy.Matrix([written(system.modes[m].field[n]) for n in system.state]) for m in (mode, to)
    )
    D = reset.jacobian(state)
    slope = sympy.Matrix([written(h.derivative(n)) for n in system.state]).T
    leap = (
        (after.subs(moved, simultaneous=True) - D * before) * slope / written(system.lie(mode, h))
    )
    return (D + leap).applyfunc(sympy.simplify), z


@pytest.mark.parametrize("s", SIGNS)
def test_hit(s):
    """`Oscillator.saltation` and `hit` are the saltation matrix of a wall."""
    matrix, z = jump(SIGNS[s], "wall", SIGNS[-s])
    force, e, f = z["F"] * z["cos"], z["e"], z["f"]
    salt = (force + e * force + (1 - e) * s * f) / z["v"]
    assert (matrix - sympy.Matrix([[-e, 0], [salt, -e]])).applyfunc(sympy.simplify).is_zero_matrix
    p = Parameters(*map(Fraction, ("2", "1", "1/2", "-1", "1", "3/4")))
    with interval.workprec(100):
        osc = oscillator(p)
        ours = osc.saltation(s, interval.ball(s * 3), interval.ball(Fraction(1, 3)))
        numbers = {"F": 2, "cos": sympy.Rational(1, 3), "e": sympy.Rational(3, 4)}
        numbers |= {"f": sympy.Rational(1, 2), "v": s * 3}
        true = salt.subs({z[name]: value for name, value in numbers.items()})
        assert ours.contains(interval.ball(Fraction(int(true.p), int(true.q))))


@pytest.mark.parametrize("s", SIGNS)
def test_turn(s):
    """`Oscillator.turning_factor` is the entry of the saltation matrix of a turn, at v = 0."""
    matrix, z = jump(SIGNS[s], "stop", SIGNS[-s])
    force, f = -s * z["F"] * z["cos"], z["f"]
    turned = matrix.subs(z["v"], 0).applyfunc(sympy.simplify)
    expected = sympy.Matrix([[1, 0], [0, (force - f) / (force + f)]])
    assert (turned - expected).applyfunc(sympy.simplify).is_zero_matrix
    with interval.workprec(100):
        osc: Oscillator = oscillator(PAPER)
        ours = osc.turning_factor(s, interval.ball(-s * Fraction(9, 10)))
        assert ours.contains(interval.ball(Fraction(5, 13)))


@pytest.mark.parametrize("s", SIGNS)
def test_slow_moments(s):
    """At `Oscillator.slow` the rate of the stop comes from - to +: (L + mu) h = 0, its rate > 0."""
    lemma = lemmas(friction(), SIGNS[s])["stop"]
    numbers = {"F": Fraction(2), "f": Fraction(1, 2), "mu": Fraction(0), "omega": Fraction(3)}
    system = friction().at(numbers)
    rate = lemmas(system, SIGNS[s])["stop"].value
    assert lemma.rate.derivative("mu") == 1
    p = Parameters(*map(Fraction, ("2", "3", "1/2", "-1", "1")))
    with interval.workprec(100):
        at = oscillator(p).slow(s, 0)
        values = {"cos": at.cos, "sin": at.sin}
        assert rate.evaluated(values, interval.ball).contains(0)
        assert system.lie(SIGNS[s], rate).evaluated(values, interval.ball) > 0
