"""Exact polynomials: their algebra against sympy, and what they refuse."""

import subprocess
import sys
from fractions import Fraction

import pytest
import sympy
from support import only, seeded

from cap.errors import BadInput
from cap.system.polynomial import ONE, ZERO, Polynomial, Quotient, over, variables

NAMES = "x v cos"
x, v, cos, pi = variables(f"{NAMES} pi")
SYMBOLS = dict(zip(NAMES.split(), sympy.symbols(NAMES), strict=True))


def symbolic(q):
    """Return a polynomial or quotient as an expression of sympy."""
    if isinstance(q, Quotient):
        return symbolic(q.numerator) / symbolic(q.denominator)
    return q.evaluated(SYMBOLS, lambda c: sympy.Rational(c.numerator, c.denominator), sympy.pi)


def drawn(random):
    """Return a random polynomial with a few terms."""
    total = ZERO
    for _ in range(random.randint(0, 4)):
        c = Fraction(random.randint(-9, 9), random.randint(1, 9))
        powers = [q ** random.randint(0, 2) for q in (x, v, cos, pi)]
        total += c * powers[0] * powers[1] * powers[2] * powers[3]
    return total


@pytest.mark.parametrize("seed", range(20))
def test_algebra(seed):
    """Sums, products, derivatives, substitutions: the same as those of sympy."""
    random = seeded(seed)
    p, q = drawn(random), drawn(random)
    a, b = symbolic(p), symbolic(q)
    pairs = [
        (p + q, a + b),
        (p - q, a - b),
        (p * q, a * b),
        (2 - p, 2 - a),
        (p / (3 * pi * pi), a / (3 * sympy.pi**2)),
        (p.derivative("x"), sympy.diff(a, SYMBOLS["x"])),
        (p.substituted({"x": q}), a.subs(SYMBOLS["x"], b)),
        (p.without("x"), a.subs(SYMBOLS["x"], 0)),
    ]
    for ours, theirs in pairs:
        assert sympy.expand(symbolic(ours) - theirs) == 0
    assert Polynomial.of(a) == p  # sympy's expressions are read, pi included


@pytest.mark.parametrize("seed", only(range(20), *range(4)))
def test_quotients(seed):
    """Their algebra is that of sympy."""
    random = seeded(seed)
    p, q, r, s = (drawn(random) + 1 for _ in range(4))
    if q and s and r:
        left, right = over(p, q), over(r, s)
        a, b = symbolic(p) / symbolic(q), symbolic(r) / symbolic(s)
        for ours, theirs in [
            (left + right, a + b),
            (left - right, a - b),
            (left * right, a * b),
            (left / right, a / b),
            (p * left, symbolic(p) * a),
        ]:
            assert sympy.simplify(symbolic(ours) - theirs) == 0


def test_how_it_is_shown():
    """With the signs of its coefficients."""
    y, v = variables("y v")
    shown = {y - Fraction(6, 5) * v: "y - 6/5 v", -(y**3): "-y^3", -1 - v * v: "-1 - v^2"}
    for polynomial, text in {**shown, y - y: "0", 3 + y: "y + 3"}.items():
        assert repr(polynomial) == text


def test_common_factors_go():
    """A monomial that divides all terms leaves a quotient, and numbers leave the denominator."""
    assert over(x * v * pi, 2 * v) == Quotient(x * pi / 2, ONE)
    assert over(x * v, x * x + x * cos) == Quotient(v, x + cos)
    assert over(ZERO, x + v) == Quotient(ZERO, ONE)


def test_quotient_of_sympy():
    """A rational function of sympy is read."""
    s, t = SYMBOLS["x"], SYMBOLS["v"]
    value = s / (1 + t**2) + 1 / s
    assert sympy.simplify(symbolic(Quotient.of(value)) - value) == 0


@pytest.mark.parametrize(
    "value", [0.4, "x", None, Quotient(x, v), sympy.sin(sympy.Symbol("x")), sympy.Float("0.4")]
)
def test_only_exact_polynomials(value):
    """Doubles, strings, quotients and functions are refused."""
    with pytest.raises(BadInput, match=r"^not an? (exact )?polynomial.*") as refusal:
        Polynomial.of(value)
    assert "\n" not in str(refusal.value)


def test_names_of_symbols():
    """Two symbols of one name would be one variable; that of pi is the number's."""
    for other in (sympy.pi, sympy.Symbol("pi", positive=True)):
        with pytest.raises(BadInput, match="one name"):
            Polynomial.of(sympy.Symbol("pi") * other)


def test_division_by_a_polynomial():
    """It makes a quotient, with which one goes on; division by a number makes a polynomial."""
    assert v / (2 * pi) == v * (2 * pi) ** -1 == v * pi**-1 / 2
    assert isinstance(v / (2 * pi), Polynomial)
    for ours, numerator, denominator in (
        (v / (1 + x), v, 1 + x),
        (1 / (1 + x), ONE, 1 + x),
        (v - 1 / x, v * x - 1, x),
        (1 - v / x, x - v, x),
        (x / (x / v), v, ONE),
        (2 / (x / v), 2 * v, x),
        (v / (1 + pi), v, 1 + pi),
    ):
        assert ours.numerator * denominator == numerator * ours.denominator


@pytest.mark.parametrize("bottom", [x, 1 + pi, ZERO])
def test_reciprocals_of_numbers_only(bottom):
    """Only a rational times a power of pi has a reciprocal that is a polynomial."""
    with pytest.raises(BadInput, match="cannot divide"):
        bottom**-1


def test_whole_powers():
    """A root is no polynomial."""
    with pytest.raises(BadInput, match="whole power"):
        x ** Fraction(1, 2)


def test_zero_denominator():
    """It is refused."""
    with pytest.raises(BadInput, match="zero"):
        over(x, ZERO)
    with pytest.raises(BadInput, match="zero"):
        x / 0


def test_sympy_is_not_loaded():
    """A model needs none of it."""
    code = "import sys, cap.system.masses, cap.system.form, cap.system.flight, cap.system.lemmas;"
    code += "from cap.system.friction import friction; friction(); print('sympy' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"
