"""The Birkhoff normal form gives known twists back, and refuses what it must refuse."""

import math
from fractions import Fraction

import pytest
from support import holds, rounds, seeded, width

from cap.errors import NotProved
from cap.maps import normal_form
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.jet import Jet, Space

BITS = 300
ANGLES = [(3, 4, 5), (4, -3, 5), (-5, 12, 13), (-12, -5, 13), (60, 11, 61), (-11, -60, 61)]


def polynomial(order, terms):
    """Return the jet over balls with these terms."""
    space = Space(2, order)
    return Jet(space, [interval.ball(Fraction(terms.get(e, 0))) for e in space.exponents])


def composed(outer, inner):
    """Return outer ∘ inner, two pairs of jets that vanish at the origin, term by term."""
    space = inner[0].space
    powers = [[polynomial(space.order, {(0, 0): 1})] for _ in inner]
    for factor, table in zip(inner, powers, strict=True):
        for _ in range(space.order):
            table.append(table[-1] * factor)
    products = [powers[0][i] * powers[1][j] for i, j in space.exponents]
    result = []
    for jet in outer:
        total = polynomial(space.order, {})
        for term, coefficient in zip(products, jet.coefficients, strict=True):
            total = total + term * coefficient
        result.append(total)
    return tuple(result)


def twist_map(order, angle, taus):
    """Return the jets of z -> z exp(i(Θ + τ_1 |z|² + ...)), z = x + iv, e^{iΘ} = (c + is)/h."""
    c, s, h = angle
    square = polynomial(order, {(2, 0): 1, (0, 2): 1})
    turn, power = polynomial(order, {}), square
    for tau in taus:
        turn, power = turn + power * interval.ball(tau), power * square
    cos, sin = polynomial(order, {(0, 0): 1}), polynomial(order, {})
    term = polynomial(order, {(0, 0): 1})
    for k in range(1, order + 1):
        term = term * turn / k
        signed = term * (-1) ** (k // 2)
        cos, sin = (cos, sin + signed) if k % 2 else (cos + signed, sin)
    cos, sin = (cos * c - sin * s) / h, (sin * c + cos * s) / h
    x, v = polynomial(order, {(1, 0): 1}), polynomial(order, {(0, 1): 1})
    return x * cos - v * sin, x * sin + v * cos


def shears(random, order, linear):
    """Return a random composition of polynomial shears, which preserve area, and its inverse."""
    there = back = (polynomial(order, {(1, 0): 1}), polynomial(order, {(0, 1): 1}))
    for n in range(4):
        first = 1 if linear else 2
        pick = {d: Fraction(random.randint(-3, 3), 2) for d in range(first, order + 1)}
        for sign in (1, -1):
            terms = {((d, 0) if n % 2 else (0, d)): sign * c for d, c in pick.items()}
            moved = polynomial(order, terms)
            x, v = polynomial(order, {(1, 0): 1}), polynomial(order, {(0, 1): 1})
            shear = (x, v + moved) if n % 2 else (x + moved, v)
            if sign > 0:
                there = composed(shear, there)
            else:
                back = composed(back, shear)
    return there, back


def random_taus(random, order):
    """Return random rational twists, as many as the order has."""
    return [Fraction(random.randint(-20, 20), 7) for _ in range((order - 1) // 2)]


@pytest.mark.parametrize("order", [3, 5, 7])
@pytest.mark.parametrize("angle", ANGLES)
def test_known_twists_come_back(order, angle):
    """A twist map conjugated by area-preserving maps keeps Θ, with its sign, and τ_1, τ_2, τ_3."""
    random = seeded(f"{order} {angle}")
    with interval.workprec(BITS):
        for linear in [False, True] * rounds(1 if order > 3 else 3):
            taus = random_taus(random, order)
            there, back = shears(random, order, linear)
            model = twist_map(order, angle, taus)
            x, v = composed(there, composed(model, back))
            found = normal_form.ellipticity(x, v)
            assert float(found.theta) == pytest.approx(math.atan2(angle[1], angle[0]))
            assert width(found.theta) < 1e-80
            twists = normal_form.twists(x, v)
            assert len(twists) == len(taus)
            for enclosure, tau in zip(twists, taus, strict=True):
                assert holds(enclosure, tau)
                assert width(enclosure) < 1e-50


@pytest.mark.parametrize("angle", ANGLES[:3])
def test_orientation_reversal_changes_all_signs(angle):
    """(x, v) -> (x, -v) reverses the area form, Θ and every τ; (x, v) -> (-x, -v) nothing."""
    random, order = seeded(1), 5
    taus = random_taus(random, order)
    there, back = shears(random, order, linear=True)
    model = composed(there, composed(twist_map(order, angle, taus), back))
    one = polynomial(order, {(1, 0): 1}), polynomial(order, {(0, 1): 1})
    with interval.workprec(BITS):
        for mirror, sign in (
            ((one[0], -one[1]), -1),
            ((-one[0], one[1]), -1),
            ((-one[0], -one[1]), 1),
        ):
            x, v = composed(mirror, composed(model, mirror))
            theta = normal_form.ellipticity(x, v).theta
            assert float(theta) == pytest.approx(sign * math.atan2(angle[1], angle[0]))
            for enclosure, tau in zip(normal_form.twists(x, v), taus, strict=True):
                assert holds(enclosure, sign * tau)


def test_scaling_the_coordinates_scales_the_twists():
    """In coordinates λ times larger τ_k is λ^{-2k} times as large: τ_k is per |w|^{2k}."""
    random, order, scale = seeded(2), 5, Fraction(3)
    with interval.workprec(BITS):
        taus = random_taus(random, order)
        there, back = shears(random, order, linear=False)
        model = composed(there, composed(twist_map(order, ANGLES[0], taus), back))
        grow = polynomial(order, {(1, 0): scale}), polynomial(order, {(0, 1): scale})
        shrink = polynomial(order, {(1, 0): 1 / scale}), polynomial(order, {(0, 1): 1 / scale})
        x, v = composed(grow, composed(model, shrink))
        for k, enclosure in enumerate(normal_form.twists(x, v), start=1):
            assert holds(enclosure, taus[k - 1] / scale ** (2 * k))


def resonant(p, q, order):
    """Return a map with e^{iΘ} = e^{2πip/q}, by balls, and a quadratic part."""
    sin, cos = (2 * interval.pi() * p / q).sin_cos()
    x, v = Jet.variables((Ball(0), Ball(0)), order)
    bent = v + x * x
    return x * cos - bent * sin, x * sin + bent * cos


@pytest.mark.parametrize(("p", "q"), [(1, 3), (-1, 3), (1, 4), (-1, 4), (1, 5), (2, 5), (1, 6)])
@pytest.mark.parametrize("order", [3, 5, 7])
def test_resonances_are_refused(p, q, order):
    """e^{ikΘ} = 1 for a k up to order + 1: a divisor contains zero, at any precision."""
    for bits in (53, 200):
        with interval.workprec(bits):
            jets = resonant(p, q, order)
            if q <= order + 1:
                with pytest.raises(NotProved, match="resonance"):
                    normal_form.twists(*jets)
            else:
                assert all(tau.is_finite() for tau in normal_form.twists(*jets))


@pytest.mark.parametrize("trace", [2, -2, 3, -3, Fraction(21, 10), 1000])
def test_parabolic_and_hyperbolic_maps_are_refused(trace):
    """|trace| = 2 exactly, and more."""
    x, v = Jet.variables((Ball(0), Ball(0)), 3)
    for a in (Fraction(trace) / 2, Fraction(trace), Fraction(1)):
        d = trace - a
        b = interval.ball(a * d - 1)
        jets = x * interval.ball(a) + v * b, x + v * interval.ball(d)
        for call in (normal_form.ellipticity, normal_form.twists):
            with pytest.raises(NotProved, match="trace"):
                call(*jets)


def test_undecided_linear_parts_are_refused():
    """A trace ball that touches 2 or -2; a lower left entry that may vanish; NaN."""
    x, v = Jet.variables((Ball(0), Ball(0)), 3)
    for trace in (Ball(2, 1e-9), Ball(-2, 1e-9), Ball(0, 3), Ball("nan"), Ball("inf")):
        with pytest.raises(NotProved, match="trace"):
            normal_form.ellipticity(x * trace - v, x)
    for c in (Ball(0), Ball(0, 1e-9), Ball("nan")):
        image = x / 2 - v, v / 2
        image[1].coefficients[image[1].space.index[1, 0]] = c
        with pytest.raises(NotProved, match="lower left"):
            normal_form.ellipticity(*image)


@pytest.mark.parametrize("order", [3, 5])
def test_maps_that_do_not_preserve_area_are_refused(order):
    """A contraction or expansion in the resonant terms: their real parts do not contain zero."""
    with interval.workprec(BITS):
        base = twist_map(order, ANGLES[0], [1, 2][: (order - 1) // 2])
        for degree in range(3, order + 1, 2):
            for rate in (Fraction(1, 10**6), Fraction(-3)):
                square = polynomial(order, {(2, 0): 1, (0, 2): 1})
                factor = polynomial(order, {(0, 0): 1})
                bump = polynomial(order, {(0, 0): rate})
                for _ in range((degree - 1) // 2):
                    bump = bump * square
                jets = tuple(jet * (factor + bump) for jet in base)
                with pytest.raises(NotProved, match="area"):
                    normal_form.twists(*jets)


@pytest.mark.parametrize("position", range(10))
def test_indeterminate_coefficients_are_refused(position):
    """One NaN anywhere above the constant gives no twist."""
    with interval.workprec(BITS):
        for k in (0, 1):
            jets = twist_map(3, ANGLES[0], [1])
            if position:
                jets[k].coefficients[position] = Ball("nan")
                with pytest.raises(NotProved):
                    normal_form.twists(*jets)


def test_the_coordinate():
    """z = p δx + q δv turns by e^{iΘ}, preserves area, and Im(p q) = 1."""
    random = seeded(3)
    with interval.workprec(BITS):
        for angle in ANGLES:
            there, back = shears(random, 1, linear=True)
            x, v = composed(there, composed(twist_map(1, angle, []), back))
            found = normal_form.ellipticity(x, v)
            a, b, c, d = x[1, 0], x[0, 1], v[1, 0], v[0, 1]
            for value in (
                found.p * a + found.q * c - found.multiplier * found.p,
                found.p * b + found.q * d - found.multiplier * found.q,
                found.p * found.q.imag - 1,
            ):
                assert interval.ComplexBall(value).contains(0)
                assert interval.ComplexBall(value).rad() < 1e-60
            assert found.p > 0
            turns = normal_form.rotation_number(found)
            assert float(turns) == pytest.approx(abs(math.atan2(angle[1], angle[0])) / 2 / math.pi)
