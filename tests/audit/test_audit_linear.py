"""Derivatives of events from first principles, against divided differences of floats."""

import math

import pytest
import sympy as sp

from cap.audit.papers.mixed_dynamics.means import block
from cap.audit.papers.mixed_dynamics.means.block import Block
from cap.audit.papers.mixed_dynamics.means.linear import hit, turn
from cap.errors import NotProved
from cap.maps.fixed_point import Start
from cap.sets import interval
from cap.sets.interval import Ball

STEP = 1e-6


def pushed(x, v, a, d):
    """Return the state after a time with a constant acceleration."""
    return x + v * d + a * d * d / 2, v + a * d


def through_a_hit(x, v, accelerations, restitution):
    """Return the state at the time 0, of an orbit that hits x = 0 near then, from (x, v) at 0.

    Before the hit it is continued backwards, after it forwards, with constant accelerations.
    """
    before, after = accelerations
    root = math.sqrt(v * v - 2 * before * x)
    d = -2 * x / (v + math.copysign(root, v))
    x, v = pushed(x, v, before, d)
    return pushed(x, -restitution * v, after, -d)


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("restitution", [1.0, 0.7])
def test_hits(side, restitution):
    """Both walls, elastic and not."""
    e = sp.Symbol("e")
    M = hit(side, e)
    u, f, c = (*sp.symbols("u f", positive=True), sp.Symbol("c", real=True))
    values = {u: 1.3, c: 0.45, f: 0.4, e: restitution}
    numbers = [[float(entry.subs(values)) for entry in M[row, :]] for row in (0, 1)]
    accelerations = 0.45 - 0.4 * side, 0.45 + 0.4 * side
    for column, (dx, dv) in enumerate(((STEP, 0), (0, STEP))):
        ends = [
            through_a_hit(s * dx, 1.3 * side + s * dv, accelerations, restitution) for s in (1, -1)
        ]
        for row in (0, 1):
            slope = (ends[0][row] - ends[1][row]) / (2 * STEP)
            assert slope == pytest.approx(numbers[row][column], abs=1e-6)


def test_a_turn():
    """Velocities are multiplied by the quotient of the accelerations, positions kept."""
    before, after = sp.Rational(7, 5), sp.Rational(3, 5)
    M = turn(before, after)
    assert sp.diag(1, after / before) == M


def test_a_block_needs_a_saddle():
    """Around the elliptic orbit nothing is stretched."""
    start = Start.non_sticking(0.1002798898, 0.5419433067, (1.0991729107, 3.5160904414))
    with interval.workprec(block.BITS):
        one, zero = Ball(1), Ball(0)
        around = Block(
            (Ball(start.x), Ball(start.v)),
            ((one, zero), (zero, one)),
            block.Fraction(1, 10**8),
            block.Fraction(2, 10**8),
        )
        with pytest.raises(NotProved):
            around.covers_itself()


@pytest.mark.parametrize("h", ["1/10000000", "1/1000"])
def test_a_block_must_be_small(h):
    """A large one is not squeezed into its height, or its orbits do more than hit walls."""
    size = block.Fraction(h)
    with interval.workprec(block.BITS), pytest.raises(NotProved):
        block.around_the_saddle(size, 2 * size).covers_itself()
