"""Birkhoff's normal form: against maps whose twists are known, the cubic formula, and iteration."""

from __future__ import annotations

import cmath
import math
from fractions import Fraction

import pytest

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Jet
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.substitution import substituted
from cap.checker.maps.normal_form import (
    Complex,
    elliptic_frame,
    free_coefficient,
    in_complex_coordinate,
    twists,
)

BITS = 256


def thin(q):
    """Return the enclosure of a rational."""
    return Interval.enclosing(Fraction(q), Fraction(q), BITS)


def jet(order, **terms):
    """jet(3, c10=..., c02=...) is the polynomial with these coefficients."""
    return Jet(order, {(int(k[1]), int(k[2])): thin(c) for k, c in terms.items()})


def compose(outer, inner):
    """Return the jets of outer after inner."""
    return tuple(substituted(w, inner) for w in outer)


# An area preserving change of coordinates with the identity as linear part: three shears.
def shears(order, sign=1):
    """Return the composition of three shears, or with sign -1 its inverse."""
    x, v = jet(order, c10=1), jet(order, c01=1)
    a = (x + jet(order, c02=Fraction(sign, 3), c03=Fraction(sign, 5)), v)
    b = (x, v + jet(order, c20=Fraction(-sign, 2), c30=Fraction(sign, 7), c50=sign))
    c = (x + jet(order, c02=Fraction(sign, 4), c03=sign * 2), v)
    return compose(c, compose(b, a)) if sign > 0 else compose(a, compose(b, c))


def linear(order, rows):
    """Return the jets of a linear map."""
    (a, b), (c, d) = rows
    return jet(order, c10=a, c01=b), jet(order, c10=c, c01=d)


def twist_map(order, tau):
    """(X + iV) = z exp(i (Theta + tau_1 |z|^2 + ...)), with e^(i Theta) = (3 + 4i)/5."""
    i, zero, one = Complex(thin(0), thin(1)), Complex(thin(0), thin(0)), Complex(thin(1), thin(0))
    z = Jet(order, {(1, 0): one, (0, 1): i})
    square = Jet(order, {(2, 0): one, (0, 2): one})
    phase, power = Jet(order, {(0, 0): zero}), Jet(order, {(0, 0): one})
    for t in tau:
        power = power * square
        phase = phase + power * (i * Complex(thin(t), thin(0)))
    rotation = term = Jet(order, {(0, 0): one})
    for k in range(1, order + 1):
        term = term * phase * Complex(thin(Fraction(1, k)), thin(0))
        rotation = rotation + term
    w = z * rotation * Complex(thin(Fraction(3, 5)), thin(Fraction(4, 5)))
    return tuple(
        Jet(order, {p: getattr(c, part) for p, c in w.coefficients.items()})
        for part in ("re", "im")
    )


def run(phi):
    """Return the frame and the twists of a map."""
    x, v = phi
    frame = elliptic_frame([[w.coefficients[1, 0], w.coefficients[0, 1]] for w in (x, v)])
    return frame, twists(in_complex_coordinate(x, v, frame))


TAU = (Fraction(2, 7), Fraction(-3, 5), Fraction(11, 3), Fraction(1, 2))
SQUEEZE = ((Fraction(3), Fraction(1)), (Fraction(2), Fraction(1)))  # determinant 1
UNSQUEEZE = ((Fraction(1), Fraction(-1)), (Fraction(-2), Fraction(3)))
FLIP = ((Fraction(1), Fraction(0)), (Fraction(0), Fraction(-1)))  # reverses orientation


@pytest.mark.parametrize("order", [3, 5, 7, 9])
@pytest.mark.parametrize("rows", [None, (SQUEEZE, UNSQUEEZE)])
def test_the_twists_of_a_twist_map_in_other_coordinates(order, rows):
    """Shears and a linear change of coordinates leave the angle and all twists as they are."""
    phi = twist_map(order, TAU)
    phi = compose(shears(order, -1), compose(phi, shears(order)))
    if rows:
        phi = compose(linear(order, rows[0]), compose(phi, linear(order, rows[1])))
    frame, tau = run(phi)
    assert len(tau) == (order - 1) // 2
    for computed, exact in zip(tau, TAU, strict=False):
        assert computed.lower <= exact <= computed.upper
        assert computed.width < 1 << (BITS // 2)
    assert abs(float(frame.angle.lower) - math.atan2(4, 3)) < 1e-15


def test_the_shears_are_inverse():
    """Of the composition with the inverse, each coefficient contains that of the identity."""
    x, v = compose(shears(5, -1), shears(5))
    for w, power in ((x, (1, 0)), (v, (0, 1))):
        for p, c in w.coefficients.items():
            assert c.lower <= (p == power) <= c.upper


def test_orientation_reversal_changes_both_signs():
    """After a reflection the angle and the twist have the opposite sign."""
    phi = compose(linear(3, FLIP), compose(twist_map(3, TAU), linear(3, FLIP)))
    frame, tau = run(phi)
    assert float(frame.angle.upper) == pytest.approx(-math.atan2(4, 3))
    assert tau[0].lower <= -TAU[0] <= tau[0].upper


COS, SIN = Fraction(5, 13), Fraction(12, 13)


def henon(order, cubic=0):
    """The area preserving Henon map, a rotation after a shear."""
    x, v = jet(order, c10=1), jet(order, c01=1, c20=-1, c30=cubic)
    return x * thin(COS) - v * thin(SIN), x * thin(SIN) + v * thin(COS)


def test_the_cubic_formula():
    """i e tau_1 = g_21/2 + ..., the resonant cubic coefficient (Kuznetsov, Wan), in floats."""
    x, v = henon(3, Fraction(1, 3))
    frame, tau = run((x, v))
    f = in_complex_coordinate(x, v, frame)
    g = {p: complex(float(c.re.lower), float(c.im.lower)) for p, c in f.coefficients.items()}
    e, g20, g11, g02, g21 = g[1, 0], 2 * g[2, 0], g[1, 1], 2 * g[0, 2], 2 * g[2, 1]
    resonant = (
        g21 / 2
        + g20 * g11 * (e.conjugate() - 3 + 2 * e) / (2 * (e * e - e) * (e.conjugate() - 1))
        + abs(g11) ** 2 / (1 - e.conjugate())
        + abs(g02) ** 2 / (2 * (e * e - e.conjugate()))
    )
    assert resonant / e == pytest.approx(1j * float(tau[0].lower), abs=1e-12)


def test_the_rotation_number_of_iterates():
    """The mean angle per step of a small orbit is Theta + tau_1 |z|^2 + tau_2 |z|^4 + ..."""
    cos, sin = float(COS), float(SIN)
    frame, tau = run(henon(5))
    for x, terms, tolerance in ((0.01, 1, 1e-7), (0.05, 2, 1e-6)):
        z, total, weight, steps = complex(x, 0), 0.0, 0.0, 20000
        mean_square = 0.0
        for n in range(1, steps):
            p, q = z.real, z.imag - z.real**2
            image = complex(cos * p - sin * q, sin * p + cos * q)
            bump = math.exp(-1 / (n / steps * (1 - n / steps)))  # smooth weights: fast convergence
            total += bump * cmath.phase(image / z)
            mean_square += bump * abs(z) ** 2
            weight += bump
            z = image
        s = mean_square / weight  # |w|^2 up to O(|z|^3), whose mean is O(|z|^4)
        angle = float(frame.angle.lower) + float(tau[0].lower) * s
        assert abs(total / weight - angle) < (tolerance if terms == 1 else 10 * s**2)
        assert abs(total / weight - float(frame.angle.lower)) > 0.1 * abs(float(tau[0].lower)) * s


def test_a_linear_map_does_not_twist():
    """Its jets have no terms of a higher degree, not even zeros."""
    _, tau = run(linear(5, ((1, -1), (Fraction(1, 2), Fraction(1, 2)))))
    assert len(tau) == 2
    for t in tau:
        assert t.contains_zero()
        assert t.magnitude().upper < Fraction(1, 10**50)


@pytest.mark.parametrize(("rows", "order"), [(((-1, -1), (1, 0)), 3), (((0, -1), (1, 0)), 3)])
def test_resonances_of_order_three_and_four_reject(rows, order):
    """e^3 = 1 or e^4 = 1 leaves a zero divisor, already at order 3."""
    x, v = linear(order, rows)
    phi = compose((x, v), (jet(order, c10=1), jet(order, c01=1, c20=1, c30=1)))
    with pytest.raises(Rejected, match="zero"):
        run(phi)


def test_resonance_of_order_six_rejects_at_order_five_only():
    """e^6 = 1 does no harm at order 3, and rejects at order 5."""
    rows = ((1, -1), (1, 0))
    for order in (3, 5):
        phi = compose(linear(order, rows), (jet(order, c10=1), jet(order, c01=1, c20=1, c50=1)))
        if order == 3:
            assert len(run(phi)[1]) == 1
        else:
            with pytest.raises(Rejected, match="zero"):
                run(phi)


def test_a_map_that_does_not_preserve_area_rejects():
    """A rotation plus a cubic term in x alone: the resonant coefficient is not imaginary."""
    x, v = linear(3, ((Fraction(3, 5), Fraction(-4, 5)), (Fraction(4, 5), Fraction(3, 5))))
    with pytest.raises(Rejected, match="imaginary"):
        run((x + jet(3, c30=1), v))


@pytest.mark.parametrize("rows", [((3, 1), (2, 1)), ((1, 1), (0, 1)), ((-3, 1), (-4, 1))])
def test_a_jacobian_that_is_not_elliptic_rejects(rows):
    """Hyperbolic, and parabolic with trace 2 and -2."""
    with pytest.raises(Rejected):
        run(linear(3, rows))


@pytest.mark.parametrize("c", [(-1, 1), (0, 1), (-1, 0)])
def test_a_lower_left_entry_that_may_vanish_rejects(c):
    """Also if zero is an end of its enclosure."""
    rows = [[thin(Fraction(1, 2)), thin(-1)], [Interval(*c, BITS), thin(Fraction(1, 2))]]
    with pytest.raises(Rejected, match="lower left entry"):
        elliptic_frame(rows)


def test_the_coordinate():
    """(p, q) is a left eigenvector of the Jacobian for e^(i Theta), with p > 0 and Im p q = 1."""
    rows = ((Fraction(9, 8), Fraction(-13, 4)), (Fraction(1, 2), Fraction(-5, 9)))
    frame = elliptic_frame([[thin(c) for c in row] for row in rows])
    (a, _), (c, d) = rows
    cos = float((a + d) / 2)
    assert math.cos(float(frame.angle.lower)) == pytest.approx(cos)
    p, q = float(frame.p.lower), complex(*(float(w.lower) for w in frame.q))
    e = cmath.exp(1j * float(frame.angle.lower))
    assert p * float(a) + q * float(c) == pytest.approx(e * p)
    assert (p * q).imag == pytest.approx(1)
    assert p > 0


def test_the_free_coefficient_makes_the_jacobian_determinant_one():
    """For psi = z + a z^2 + b z z^- + c z^-^2 + beta z |z|^2: beta = |c|^2 - |a|^2.

    In |1 + 2 a z + b z^- + 2 beta |z|^2|^2 - |b z + 2 c z^- + beta z^2|^2 the coefficient of |z|^2
    is 4 |a|^2 + |b|^2 + 4 beta - |b|^2 - 4 |c|^2.
    """
    terms = {(1, 0): (1, 0), (2, 0): (3, 1), (1, 1): (2, -5), (0, 2): (1, 7)}
    psi = Jet(3, {power: Complex(thin(re), thin(im)) for power, (re, im) in terms.items()})
    beta = free_coefficient(psi, 1)
    assert beta.lower <= 50 - 10 <= beta.upper
