"""Newton's method for invariant curves, in Fourier models whose errors are left out.

What it returns is a hint: `cap.tori.invariant_curve` proves, with errors, what is beside it.
"""

from fractions import Fraction

from cap.sets.fourier import FourierModel
from cap.sets.interval import ComplexBall
from cap.tori import flights
from cap.tori.half_period import HalfPeriods, Hit
from cap.tori.invariant_curve import Curve, Map, Rotation, Vector, det, error_of


def solved(u: FourierModel, rotation: Rotation) -> FourierModel:
    """Return w of mean 0 with w⁺ - w = u - <u>."""
    degree = u.circle.degree
    divisors = (factor - 1 for factor in rotation.factors)
    modes = zip(u.circle.modes(degree), divisors, strict=True)
    return u.centre().times([1 / d if k else ComplexBall(0) for k, d in modes])


def improved(mapped: Map, curve: Curve, frame: Vector, rotation: Rotation) -> Curve:
    """Return the curve after one step; the frame is near det(K', N) = 1."""
    image = mapped(curve.x, curve.v)
    E = error_of(image, curve, rotation)
    L, ahead = curve.tangent, rotation.both(frame)
    T = det(image.tangent(frame), ahead)
    eta = det(E, ahead), det(rotation.both(L), E)
    swing = solved(eta[1], rotation)
    shift = -(eta[0] + T * swing).mean / T.mean
    xi = swing + shift
    along = solved(eta[0] + T * xi, rotation)
    x, v = (u + a * along + b * xi for u, a, b in zip((curve.x, curve.v), L, frame, strict=True))
    return Curve(shortened(x), shortened(v), curve.turns)


def levelled(mapped: Map, curve: Curve, frame: Vector, rotation: Rotation) -> Vector:
    """Return a frame for which T = det(D𝓕 N, N⁺) is nearly constant: N + βK', β⁺ - β = T - <T>."""
    T = det(mapped(curve.x, curve.v).tangent(frame), rotation.both(frame))
    beta, L = solved(T, rotation), curve.tangent
    return shortened(frame[0] + beta * L[0]), shortened(frame[1] + beta * L[1])


def shortened(u: FourierModel, part: Fraction = Fraction(3, 4)) -> FourierModel:
    """Return points for the coefficients of a real function, those above part of the degree 0."""
    n = u.circle.degree
    kept = u.coefficients[n : n + int(n * part) + 1]
    return u.circle.real([ComplexBall(c.real.mid(), c.imag.mid()) for c in kept])


def followed(mapped: HalfPeriods, curve: Curve, steps: int = 1) -> HalfPeriods:
    """Return the map with its hits improved for a curve."""
    hits = list[Hit]()
    x, v = curve.x, curve.v
    for hit in mapped.hits:
        better = hit
        for _ in range(steps):
            t, _, cos, inverse = better
            value = flights.beyond(mapped.alpha, mapped.a, (x, v), t, cos)
            better = Hit.near(shortened(t - inverse * value, Fraction(1)), inverse)
        hits.append(better)
        x, v = (shortened(u, Fraction(1)) for u in mapped.passage(better, x, v)[:2])
    return HalfPeriods(mapped.alpha, mapped.a, tuple(hits))
