"""Symbolic means: nothing equal is called different, nothing different equal."""

from fractions import Fraction

import mpmath
import pytest
import sympy as sp
from support import holds

from cap.audit.means.algebra import compared, differs, enclosure, same, shown
from cap.audit.verdict import Outcome
from cap.errors import NotProved
from cap.sets import interval

x, y = sp.symbols("x y", positive=True)
EQUAL = [
    ((x + y) ** 2, x**2 + 2 * x * y + y**2),
    (sp.sin(x) ** 2 + sp.cos(x) ** 2, sp.Integer(1)),
    (sp.sqrt(x**2), x),
    (sp.sin(x + sp.pi), -sp.sin(x)),
    (sp.Matrix([[x, 0]]), sp.Matrix([[x, 0]])),
]
DIFFERENT = [
    (x, y),
    (x**2, x**3),
    (sp.cos(x), sp.cos(x) + sp.Rational(1, 10**20)),
    (sp.pi, sp.Rational(355, 113)),
    (2 * x, x),
]


@pytest.mark.parametrize(("left", "right"), EQUAL)
def test_equal(left, right):
    """Identities are confirmed, and never certain to fail."""
    assert same(left, right)
    if not isinstance(left, sp.MatrixBase):
        assert not differs(left, right)


@pytest.mark.parametrize(("left", "right"), DIFFERENT)
def test_different(left, right):
    """A difference is certain, and no identity."""
    assert differs(left, right)
    assert not same(left, right)


def test_points_at_which_expressions_may_be_compared():
    """Integers are integers; what stands for a number that is known is at no other."""
    n = sp.Symbol("n", integer=True)
    assert not differs(sp.sin(sp.pi * n / 2) * sp.cos(sp.pi * n / 2), 0)
    assert differs(n + 1, n)
    known = sp.Dummy("1.5", real=True)
    assert not differs(known, sp.Rational(3, 2))
    with pytest.raises(NotProved, match="undecided"):
        compared(known * x, sp.Rational(3, 2) * x)


def test_formula_gives_the_verdict():
    """Confirmed, corrected, or neither: an expression that cannot be enclosed decides nothing."""
    assert compared(x * (x + 1), x**2 + x) is Outcome.CONFIRMED
    assert compared(-2 * x, 2 * x) is Outcome.CORRECTED
    with pytest.raises(NotProved):
        compared(sp.Function("g")(x), x)
    with pytest.raises(NotProved, match="undecided"):
        compared(sp.sqrt(x - 10**6), sp.sqrt(x - 10**7))  # not real where it is enclosed


@pytest.mark.parametrize(
    "expression",
    [
        sp.sin(x) / (x + 2),
        sp.sqrt(x) * sp.pi,
        x ** sp.Rational(3, 2),
        x**y,
        sp.exp(-x) - sp.log(x),
        sp.acos(x / 10) + sp.asin(x / 10) * sp.atan(y),
        sp.sech(x) * sp.tanh(y) + sp.cosh(x) / sp.sinh(y),
        sp.Abs(-x) * sp.sign(-y),
    ],
)
def test_enclosures_contain_the_value(expression):
    """Against sixty digits of mpmath, and they are narrow."""
    point = {x: Fraction(7, 10), y: Fraction(3, 4)}
    with interval.workprec(100):
        ball = enclosure(expression, point)
        with mpmath.workdps(60):
            numbers = [mpmath.mpf(q.numerator) / q.denominator for q in point.values()]
            value = sp.lambdify((x, y), expression, "mpmath")(*numbers)
            assert holds(ball, value)
        assert ball.rad() < Fraction(1, 10**20).numerator / interval.Ball(10) ** 20


def test_what_cannot_be_enclosed():
    """It is refused, not guessed."""
    with pytest.raises(NotProved, match="no enclosure of gamma"):
        enclosure(sp.gamma(x), {x: Fraction(1, 2)})


def test_expressions_for_people():
    """One line, in the signs of the paper."""
    omega, theta = sp.symbols("omega theta", positive=True)
    assert shown(2 * sp.cos(omega * x) * theta**2) == "2 θ² cos(ω x)"
