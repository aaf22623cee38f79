"""The tape: formulas hold what they say, each operation once, with exact constants."""

from fractions import Fraction

import pytest
from support import seeded

from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.jet import Jet
from cap.system.source import Function
from cap.system.tape import Tape, gradients, is_zero, needed

NAMES = "a", "b", "c"


def formula(random, *inputs):
    """Return a random formula of numbers of any kind, the same for the same seed."""
    known = list(inputs)
    for _ in range(25):
        x, y = random.choice(known), random.choice(known)
        q = Fraction(random.randint(-3, 3), random.randint(1, 3))
        kind = random.randrange(6)
        known.append(
            x + y
            if kind == 0
            else x - y
            if kind == 1
            else y * x / 4
            if kind == 2
            else x / (y * y + 1)
            if kind == 3
            else -x
            if kind == 4
            else x * q - y + q
        )
    return known[-1] + known[-2]


def test_formulas_have_their_exact_values():
    """What the simplified tape computes over rationals is what the formula says."""
    for seed in range(60):
        tape, values = Tape(), [Fraction(1, 2), Fraction(-3, 5), Fraction(2)]
        inputs = [tape.input(name) for name in NAMES]
        out = formula(seeded(seed), *inputs)
        exact = Function(NAMES, [out]).bound(lambda n: n.rational)(*values)[0]
        assert exact == evaluated(out, dict(zip(NAMES, values, strict=True)))
        assert exact == formula(seeded(seed), *values)


def evaluated(term, values):
    """Return the value of a term, operation by operation."""
    kind, _, name = term.operation
    parts = [evaluated(part, values) for part in term.operands]
    if term.number:
        return kind.rational
    if not parts:
        return values[name]
    if kind == "neg":
        return -parts[0]
    a, b = parts
    return {"+": a + b, "-": a - b, "*": a * b}[kind] if kind != "/" else a / b


def test_gradients_are_those_of_jets():
    """The derivatives written on the tape equal those of jets over rationals."""
    for seed in range(40):
        tape, values = Tape(), [Fraction(1, 2), Fraction(-3, 5), Fraction(2)]
        inputs = [tape.input(name) for name in NAMES]
        out = formula(seeded(seed), *inputs)
        [gradient] = gradients([out], {name: {name: tape.number(1)} for name in NAMES})
        slopes = [gradient.get(name, tape.number(0)) for name in NAMES]
        found = Function(NAMES, slopes).bound(lambda n: n.rational)(*values)
        jet = Function(NAMES, [out]).bound(lambda n: n.rational)(*Jet.variables(values, 1))[0]
        assert list(found) == (jet.coefficients[1:] if isinstance(jet, Jet) else [0, 0, 0])


def test_the_chain_rule_for_inputs():
    """An input that depends on a variable, as the clock on time: d cos = -2 sin dt."""
    tape = Tape()
    c, s, t = map(tape.input, ("c", "s", "t"))
    by = {"c": {"t": -2 * s}, "s": {"t": 2 * c}, "t": {"t": tape.number(1)}}
    [gradient] = gradients([c * c + s * s + t * t], by)
    assert list(gradient) == ["t"]
    assert Function(("c", "s", "t"), [gradient["t"]]).floats()(0.6, 0.8, 3.0) == (6.0,)


def test_each_operation_is_written_once():
    """Equal terms are one term, also if the operands are exchanged; 0 and 1 leave no operation."""
    tape = Tape()
    a, b = tape.input("a"), tape.input("b")
    assert (a + b).place == (b + a).place
    assert (a * b).place == (b * a).place
    assert (a - b).place == (-(b - a)).place
    assert (a * 1 + 0 * b).place == a.place
    assert (a / 2 * 4).place == (2 * a).place
    assert is_zero(a - a)
    assert is_zero(0 * a / b)
    assert len(needed([(a * b + a) * (a * b + a)])) == 5


def test_powers_of_pi_are_exact():
    """pi a - a pi is zero, and pi/pi is one."""
    tape = Tape()
    a, pi = tape.input("a"), tape.number(1, 1)
    assert is_zero(pi * a - a * pi)
    assert (a * pi / pi).place == a.place
    assert (pi + pi).number == (2, 1)
    with interval.workprec(200):
        [value] = Function(("a",), [a * (pi * pi - 2)]).balls()(Ball(1))
        assert value.overlaps(Ball.pi() ** 2 - 2)
        assert value.rad() < 1e-55


def test_constants_follow_the_precision():
    """A function of balls is as precise as the precision at which it was asked for."""
    tape = Tape()
    function = Function(("a",), [tape.input("a") * Fraction(1, 3)])
    with interval.workprec(53):
        rough = function.balls()(Ball(1))[0]
    with interval.workprec(300):
        sharp = function.balls()(Ball(1))[0]
    assert sharp.rad() < 1e-80 < rough.rad()
    assert rough.contains(sharp)


def test_a_name_must_be_one():
    """A source is made of names, so nothing else is taken for one."""
    for name in ("a b", "1", "lambda", "a)"):
        with pytest.raises(ValueError, match="not a name"):
            Tape().input(name)
