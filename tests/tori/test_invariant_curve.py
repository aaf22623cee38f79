"""The a-posteriori theorem: curves of the area-preserving Hénon map, and what is none."""

import math
from fractions import Fraction

import numpy as np
import pytest

from cap.errors import NotProved
from cap.sets import interval
from cap.sets.fourier import Circle
from cap.sets.interval import Ball, ComplexBall
from cap.tori.invariant_curve import Curve, Image, Rotation, invariant_curve, measured
from cap.tori.newton import improved, shortened
from cap.tori.rotation import Quadratic

COS = Fraction(24, 100)
BITS = 200


def henon(x, v):
    """Turn (x, v - x²) by arccos 0.24: analytic, injective, det = 1."""
    c = interval.ball(COS)
    s = (1 - c * c).sqrt()
    w = v - x * x
    return Image(
        c * x - s * w,
        s * x + c * w,
        lambda z: (c * z[0] - s * (z[1] - 2 * x * z[0]), s * z[0] + c * (z[1] - 2 * x * z[0])),
    )


def orbit_curve(alpha, start, modes=48, count=20_000):
    """Return Fourier coefficients of an orbit, averaged with weights."""
    c, s = float(COS), math.sqrt(1 - float(COS) ** 2)
    z = [start]
    for _ in range(count - 1):
        x, v = z[-1]
        z.append((c * x - s * (v - x * x), s * x + c * (v - x * x)))
    t = (np.arange(count) + 1) / (count + 1)
    w = np.exp(-1 / (t * (1 - t)))
    phases = (alpha * np.arange(count)) % 1
    rows = [(w / w.sum() * np.exp(-2j * np.pi * k * phases)) @ np.array(z) for k in range(modes)]
    return np.array(rows).T


def frame_of(circle, curve):
    """Return JK'/|K'|² on a grid."""
    k = np.arange(len(curve[0]))
    size = 1024
    x, v = (np.fft.irfft(np.pad(1j * k * row, (0, size // 2 + 1 - len(k))) * size) for row in curve)
    both = -v / (x * x + v * v), x / (x * x + v * v)
    rows = [np.fft.rfft(u)[:90] / size for u in both]
    return tuple(shortened(real(circle, row)) for row in rows)


def real(circle, row):
    """Return the model of a real function with these coefficients."""
    return circle.real([ComplexBall(z.real, z.imag) for z in row])


@pytest.fixture(scope="module")
def found():
    """A curve with the rotation number [0;4,1,3,3,(1)], and what belongs to it."""
    with interval.workprec(BITS):
        circle, q = Circle(120, Fraction(3, 20)), Quadratic((4, 1, 3, 3), (1,))
        gamma = interval.ball(q.diophantine())
        rotation = Rotation.of(circle, 2 * interval.pi() * q.value(), gamma)
        rows = orbit_curve(float(q.value()), (0.2226298783, 0.0))
        curve = Curve(*(shortened(real(circle, row)) for row in rows))
        frame = frame_of(circle, rows)
        for _ in range(4):
            curve = improved(henon, curve, frame, rotation)
        return circle, curve, frame, rotation


@pytest.mark.usefixtures("working")
def test_a_curve_is_proved(found):
    """There is an invariant curve within 1e-40."""
    _, curve, frame, rotation = found
    proved = invariant_curve(measured(henon, curve, frame, rotation, Ball("0.03")))
    assert proved.distance < Ball("1e-36")
    assert proved.contraction < Ball("1e-25")


@pytest.fixture
def working():
    """The precision."""
    with interval.workprec(BITS):
        yield


@pytest.mark.usefixtures("working")
@pytest.mark.parametrize("head", [(4, 1, 3, 4), (4, 1, 3, 3, 1, 1, 1, 1, 2)])
def test_another_rotation_number(found, head):
    """Beside this curve there is none with another rotation number, however near."""
    circle, curve, frame, _ = found
    q = Quadratic(head, (1,))
    gamma = interval.ball(q.diophantine())
    other = Rotation.of(circle, 2 * interval.pi() * q.value(), gamma)
    with pytest.raises(NotProved, match="y0"):
        invariant_curve(measured(henon, curve, frame, other, Ball("0.03")))


@pytest.mark.usefixtures("working")
def test_a_curve_that_is_moved(found):
    """Moved by 1e-12 in a harmonic it is too far from the invariant one; by 1e-18 it is not."""
    circle, curve, frame, rotation = found

    def moved(by):
        extra = circle.real([ComplexBall(0), ComplexBall(0), ComplexBall(by)])
        return Curve(curve.x + extra, curve.v)

    with pytest.raises(NotProved, match="y0"):
        invariant_curve(measured(henon, moved(1e-12), frame, rotation, Ball("0.03")))
    near = invariant_curve(measured(henon, moved(1e-18), frame, rotation, Ball("0.03")))
    assert near.distance > Ball("1e-18")


@pytest.mark.usefixtures("working")
def test_each_hypothesis_is_needed(found):
    """Each size, made too large or too small, is refused."""
    _, curve, frame, rotation = found
    good = measured(henon, curve, frame, rotation, Ball("0.03"))
    for change in (
        {"defect": Ball(1)},
        {"skew": Ball("0.6")},
        {"mean_twist": Ball(0)},
        {"mean_twist": Ball(-1)},
        {"spread": Ball("1e80")},
        {"reach": Ball("1e-60")},
        {"rho": Ball("1e-40")},
        {"small": Ball("1e60")},
        {"defect": Ball("nan")},
    ):
        with pytest.raises(NotProved):
            invariant_curve(good._replace(**change))


def test_a_rotation_number_is_far_from_rationals():
    """γ is a lower bound of k dist(kα, Z), and for [0;3,(1)] it is α, attained at k = 1."""
    with interval.workprec(100):
        for q in (Quadratic((3,), (1,)), Quadratic((1, 2), (3, 1)), Quadratic((4, 1, 7), (1,))):
            alpha, gamma = q.value(), interval.ball(q.diophantine())
            for k in range(1, 2000):
                assert k * min(abs(k * alpha - round(k * float(alpha))), Ball(1)) > gamma * Ball(
                    "0.9999999"
                )
        q = Quadratic((3,), (1,))
        golden = (5 - Ball(5).sqrt()) / 10
        assert golden.overlaps(q.value())
        assert abs(interval.ball(q.diophantine()) - golden) < Ball("1e-12")
        assert str(q) == "[0;3,(1)]"
