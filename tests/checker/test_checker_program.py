"""Formulas as lists of operations give what the arithmetic of intervals gives."""

from __future__ import annotations

from fractions import Fraction

import pytest
from support import seeded

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.system.program import Program, Tape

BITS = 40


def formula(x, y, z, two):
    """Use each operation, in places where signs differ, and what is left out."""
    third = x * Fraction(-1, 3) + y * Fraction(0) + z * Fraction(1)
    product = (x - y) * third * two - (-z) * two.integer(1) + x * x * two.integer(0)
    return [product, (product + z) / (y * y + two), x / two, -product, two * two, two + two - two]


def wide(rng):
    """Return an interval of any sign, or one around 0."""
    a, b = sorted(rng.randrange(-(3 << BITS), 3 << BITS) for _ in range(2))
    return Interval(a, b, BITS)


def test_as_the_arithmetic():
    """Ends contain the same values, and are the same but for the order of sums."""
    tape = Tape(BITS)
    x, y, z = tape.inputs(3)
    two = Interval(2 << BITS, 2 << BITS, BITS)
    program = Program(tape.given, formula(x, y, z, tape.constant(two)))
    rng = seeded(1)
    for _ in range(200):
        given = (
            wide(rng),
            Interval(*sorted((5 << BITS, rng.randrange(1, 9 << BITS))), BITS),
            wide(rng),
        )
        for ours, theirs in zip(program.run(given), formula(*given, two), strict=True):
            assert (ours.lo, ours.hi, ours.bits) == (theirs.lo, theirs.hi, BITS)


def test_nothing_is_carried_out_twice():
    """A product that is needed twice is one operation; one that is not needed is none."""
    tape = Tape(BITS)
    x, y = tape.inputs(2)
    assert len(Program([x, y], [x * y + y * x, x * y]).operations) == 2
    assert Program([x, y], [x, x.integer(0) * y]).operations == []


@pytest.mark.parametrize("ends", [(-1, 1), (0, 1), (-1, 0)])
def test_division_by_zero(ends):
    """It rejects; by a negative number it does not."""
    tape = Tape(BITS)
    x, y = tape.inputs(2)
    program, one = Program([x, y], [x / y]), Interval(1 << BITS, 1 << BITS, BITS)
    with pytest.raises(Rejected, match="division by an interval that contains zero"):
        program.run([one, Interval(*ends, BITS)])
    (found,) = program.run([one, -one])
    assert (found.lo, found.hi) == (-1 << BITS, -1 << BITS)


@pytest.mark.parametrize(
    ("c", "ends"), [(-1, (-8, -4)), (Fraction(-1, 2), (-4, -2)), (3, (12, 24))]
)
def test_a_factor(c, ends):
    """A negative one exchanges the ends."""
    (x,) = Tape(2).inputs(1)
    (found,) = Program([x], [x * Fraction(c)]).run([Interval(4, 8, 2)])
    assert (found.lo, found.hi) == ends
