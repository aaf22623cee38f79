"""Jets of Φ in impact coordinates, and the first Birkhoff coefficient in real arithmetic."""

import json
from fractions import Fraction
from pathlib import Path

import pytest
from support import holds, inside, rounds, seeded, value_at, width
from test_normal_form import ANGLES, composed, shears, twist_map

from cap.certificate import writer as certificate
from cap.errors import NotProved
from cap.floats.search.cycles import near
from cap.maps import normal_form
from cap.maps.fixed_point import Start
from cap.maps.twist import Complex, regular_twist
from cap.one_one.closed_form import asymmetric, symmetric
from cap.one_one.transport import period_jet
from cap.parameters import Parameters
from cap.proofs import elliptic
from cap.proofs.fixed_point import Setting
from cap.sets import bisection, interval, matrix
from cap.sets.interval import Ball
from cap.sets.taylor_model import Domain

STORED = Path(__file__).parents[2] / "certificates"
BITS = 300


def ball(q):
    """Return a ball that contains a rational."""
    return interval.ball(Fraction(q))


def lower_left(jets):
    """Return the sign of the entry c of the Jacobian."""
    return 1 if jets[1][1, 0] > 0 else -1


def trace_of(jets):
    """Return the trace of the Jacobian."""
    return jets[0][1, 0] + jets[1][0, 1]


def elliptic_orbits(count, seed):
    """Give random elliptic orbits of all three kinds: at δ, at -δ, symmetric."""
    random, found = seeded(seed), 0
    while found < rounds(count):
        rho = Fraction(random.randint(80, 290), 100)
        delta = Fraction(random.randint(1, 600), 1000) * random.choice([1, -1])
        alpha = ball(Fraction(random.randint(1, 636), 1000))
        orbits = [asymmetric(ball(delta), ball(rho)), symmetric(alpha, ball(rho), 1)]
        for orbit in orbits:
            positive = all(u > 0 for u in orbit.speeds)
            if positive and -2 < orbit.trace() < 2 and abs(orbit.trace() + 1) > 1e-3:
                found += 1
                yield orbit


def test_the_jets_preserve_area():
    """The Jacobian determinant of the polynomials is 1, all terms of degree 1 to 4 vanish."""
    with interval.workprec(BITS):
        for orbit in elliptic_orbits(6, 1):
            E, t = period_jet(orbit, 5)
            jacobian = E.derivative(0) * t.derivative(1) - E.derivative(1) * t.derivative(0)
            for exponent, value in zip(
                jacobian.space.exponents, jacobian.coefficients, strict=True
            ):
                assert holds(value, 0 if any(exponent) else 1, 0)
                assert value.rad() < 1e-40


def test_the_jets_have_the_trace_of_the_closed_form():
    """And they fix the hit, in the entry (0, 0)."""
    with interval.workprec(BITS):
        for orbit in elliptic_orbits(10, 2):
            jets = period_jet(orbit, 1)
            defect = trace_of(jets) - orbit.trace()
            assert defect.contains(0)
            assert defect.rad() < 1e-60
            u1, _ = orbit.speeds
            assert (jets[0][0, 0] - u1 * u1 / 2).contains(0)
            assert Ball(jets[1][0, 0]).contains(0)


def test_jets_of_lower_order_are_truncations():
    """Newton's iteration gives the same coefficients whatever the order it stops at."""
    with interval.workprec(BITS):
        for orbit in elliptic_orbits(3, 3):
            full = period_jet(orbit, 5)
            for order in (1, 2, 3, 4):
                for one, other in zip(period_jet(orbit, order), full, strict=True):
                    pairs = zip(one.coefficients, other.truncated(order).coefficients, strict=True)
                    for a, b in pairs:
                        assert Ball(a - b).contains(0)
                        assert Ball(a - b).rad() < 1e-50


def test_against_the_normal_form_on_jets_of_impacts():
    """(1 + trace) τ_1, with the right sign, is that of `cap.maps.normal_form`."""
    with interval.workprec(BITS):
        for orbit in elliptic_orbits(40, 4):
            jets = period_jet(orbit, 3)
            found = regular_twist(*jets, lower_left(jets))
            (tau,) = normal_form.twists(*jets)
            defect = found - (1 + trace_of(jets)) * tau
            assert defect.contains(0)
            assert defect.rad() < 1e-30 * (1 + abs(tau))


@pytest.mark.parametrize("angle", ANGLES)
def test_known_twists_come_back(angle):
    """Of twist maps conjugated by area-preserving maps, with both signs of Θ."""
    random = seeded(str(angle))
    with interval.workprec(BITS):
        for linear in [False, True] * rounds(3):
            tau = Fraction(random.randint(-20, 20), 7)
            there, back = shears(random, 3, linear)
            jets = composed(there, composed(twist_map(3, angle, [tau]), back))
            trace = Fraction(2 * angle[0], angle[2])
            found = regular_twist(*jets, lower_left(jets))
            assert holds(found, (1 + trace) * tau)
            assert width(found) < 1e-50


def test_the_mirror_image_has_the_same_twist():
    """δ and -δ; and the left hit is no other than the right hit of the mirror image."""
    with interval.workprec(BITS):
        for orbit in elliptic_orbits(10, 5):
            if not orbit.delta > 0 and not orbit.delta < 0:
                continue
            values = []
            for delta in (orbit.delta, -orbit.delta):
                jets = period_jet(asymmetric(delta, orbit.rho), 3)
                values.append(regular_twist(*jets, lower_left(jets)))
            assert (values[0] - values[1]).contains(0)
            assert (values[0] - values[1]).rad() < 1e-30 * (1 + abs(values[0]))


def test_no_pole_at_the_resonance_of_order_three():
    """Across trace = -1 it is finite and continuous, where the normal form is refused."""
    rho = ball(2)
    with interval.workprec(BITS):

        def above(delta):
            return asymmetric(ball(delta), rho).trace() + 1

        low, high = bisection.crossing(above, Fraction(1, 10), Fraction(45, 100), 80)
        jets = period_jet(asymmetric(interval.hull(ball(low), ball(high)), rho), 3)
        found = regular_twist(*jets, lower_left(jets))
        assert found.is_finite()
        assert width(found) < 1e-50
        with pytest.raises(NotProved, match="resonance"):
            normal_form.twists(*jets)
        # what is left there is |c02|², with the sign of Θ
        assert found > 0 if lower_left(jets) > 0 else found < 0


@pytest.mark.parametrize("trace", [2, -2, 3, Ball(2, 1e-9), Ball("nan")])
def test_indeterminate_where_it_is_not_elliptic(trace):
    """|trace| not certainly below 2."""
    with interval.workprec(BITS):
        orbit = asymmetric(ball("1/3"), ball(2))
        E, t = period_jet(orbit, 3)
        E.coefficients[E.space.index[1, 0]] = trace - t[0, 1]
        assert not regular_twist(E, t, 1).is_finite()


def test_over_taylor_models():
    """On a cell of δ the model contains the value at each of its points, and is sharp."""
    random, rho, reach = seeded(6), ball(2), Fraction(1, 10**4)
    with interval.workprec(200):
        for centre in (Fraction(1, 10), Fraction(1, 3), Fraction(9, 20)):
            (delta,) = Domain([ball(reach)], 10).variables((ball(centre),))
            jets = period_jet(asymmetric(delta, rho), 3)
            sign = 1 if jets[1][1, 0].bound() > 0 else -1
            model = regular_twist(*jets, sign)
            assert model.remainder.rad() < 1e-9
            for _ in range(rounds(4)):
                h = inside(random, 0, reach)
                point = period_jet(asymmetric(ball(centre + h), rho), 3)
                value = regular_twist(*point, sign)
                assert holds(value_at(model, [h]), interval.midpoint(value))


@pytest.mark.parametrize("side", [1, -1])
def test_the_stored_certificates(side):
    """At f = 2/5, both orbits: trace, rotation angle with its sign, and twist."""
    stored = json.loads(
        (STORED / ("elliptic.json" if side > 0 else "elliptic-2.json")).read_text("utf-8")
    )
    claims = stored["claims"]
    with interval.workprec(BITS):

        def above(delta):
            return asymmetric(ball(delta), ball(2)).alpha - ball("2/5")

        ends = bisection.crossing(above, Fraction(0), Fraction(45, 100), 70)
        orbit = asymmetric(side * interval.hull(*map(ball, ends)), ball(2))
        jets = period_jet(orbit, 3)
        values = {
            "twist": regular_twist(*jets, lower_left(jets)) / (1 + trace_of(jets)),
            "trace": trace_of(jets),
            "rotation_angle": normal_form.ellipticity(*jets).theta,
        }
        for name, value in values.items():
            low, high = map(Fraction, claims[name])
            assert low <= interval.midpoint(value) <= high
            assert width(value) < 1e-40


def test_units_of_the_twist():
    """τ_1 of the theorem elliptic is that of scaled units times ω³/F², the unit of 1/area."""
    F, omega, rho = Fraction(2), Fraction(3), Fraction(2)
    R = rho * F / omega**2
    p = Parameters(F, omega, F * 2 / 5, Fraction(1), 1 + R)
    scale = float(R / 2)
    cycle = near(p, 1 + scale * 1.1002798898, scale * 3 * 0.5419433068)
    assert -2 < matrix.trace(cycle.path.monodromy) < 2
    proof = elliptic.prove(Setting(p, Start(cycle.x, cycle.v, cycle.events), 12))
    low, high = map(Fraction, proof(Fraction(1, 2))["claims"]["twist"])
    (one, other) = map(
        Fraction, json.loads((STORED / "elliptic.json").read_text("utf-8"))["claims"]["twist"]
    )
    unit = omega**3 / F**2
    assert low <= other * unit
    assert one * unit <= high
    assert certificate.Units.of(p).area * unit == rho**2


def test_complex_numbers():
    """Products, conjugates and norms, against Python's."""
    random = seeded(7)
    for _ in range(rounds(20)):
        z, w, v = (Complex(*(random.randint(-9, 9) for _ in range(2))) for _ in range(3))
        product = complex(*z) * complex(*w) * complex(*v)
        assert complex(*z.times(w, v)) == product
        assert complex(*z.conjugate()) == complex(*z).conjugate()
        assert z.norm() == (complex(*z) * complex(*z).conjugate()).real
