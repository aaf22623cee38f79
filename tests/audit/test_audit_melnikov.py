"""The integrals of Section 6: closed forms against quadrature, at random frequencies."""

from fractions import Fraction

import mpmath
import pytest

from cap.audit.papers.mixed_dynamics.means.melnikov import INTEGRALS, integrals
from cap.errors import NotProved
from cap.sets import interval

FREQUENCIES = Fraction(1, 3), Fraction(7, 4), Fraction(503, 100)


@pytest.mark.parametrize("name", INTEGRALS)
def test_closed_forms_are_those_of_the_quadrature(name):
    """Both are narrow and overlap; a value a little beside the closed form is not enclosed."""
    integral = INTEGRALS[name]
    with interval.workprec(100):
        for q in FREQUENCIES:
            xi = interval.ball(q)
            value, closed = integral.by_quadrature(xi), integral.closed(xi)
            assert value.overlaps(closed)
            assert value.rad() < 1e-20
            assert closed.rad() < 1e-25
            assert not value.overlaps(closed + interval.ball(Fraction(1, 10**15)))


def test_no_integrand_is_larger_than_its_bound():
    """At many points of the line each is at most its weight times exp(-|u|)."""
    with interval.workprec(100):
        for integral in INTEGRALS.values():
            for n in range(-60, 61):
                u = interval.ComplexBall(interval.ball(Fraction(n, 4)))
                size = abs(integral.integrand(u, interval.ball(FREQUENCIES[0])))
                assert not size > integral.weight * (-abs(u)).exp()


def test_the_paper_s_formula_is_another():
    """∫ sech u tanh u sin ξu du is πξ/cosh(πξ/2), as mpmath has it, and not πξ/sinh(πξ/2)."""
    expected = mpmath.quad(lambda u: mpmath.sech(u) * mpmath.tanh(u) * mpmath.sin(u), [-30, 0, 30])
    with interval.workprec(100):
        sine, square = INTEGRALS["sech tanh sin"], INTEGRALS["sech^2 cos"]
        assert abs(float(sine.closed(interval.ONE)) - expected) < 1e-12
        assert not sine.closed(interval.ONE).overlaps(square.closed(interval.ONE))


def test_a_wrong_closed_form_is_noticed(monkeypatch):
    """The integral is not returned then."""
    wrong = INTEGRALS["sech"]._replace(closed=lambda _xi: interval.ONE)
    monkeypatch.setitem(INTEGRALS, "sech", wrong)
    with interval.workprec(100), pytest.raises(NotProved, match="the closed form is another"):
        integrals("sech", [Fraction(1)])
