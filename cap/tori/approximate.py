"""An approximate invariant curve, from doubles to many digits: all that it finds are hints."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from cap.errors import NotProved
from cap.sets import interval
from cap.sets.fourier import Circle, FourierModel
from cap.sets.interval import Ball, ComplexBall
from cap.tori.half_period import HalfPeriods, Hit
from cap.tori.invariant_curve import Curve, Rotation, Vector, error_of, norm
from cap.tori.newton import followed, improved, levelled, shortened

Row = Sequence[complex]
STEPS = 12
GAIN = Ball((1, -3))  # a step that gains less is the last


@dataclass(frozen=True)
class Doubles:
    """Coefficients of 0, 1, ... in doubles: a curve, its frame, hits with inverse speeds."""

    curve: Sequence[Row]
    frame: Sequence[Row]
    hits: Sequence[Sequence[Row]]


@dataclass(frozen=True)
class Approximate:
    """A curve, a frame, and the map with the hits along it; polynomials with exact coefficients."""

    curve: Curve
    frame: Vector
    map: HalfPeriods
    rotation: Rotation


def model(circle: Circle, row: Row) -> FourierModel:
    """Return the model of a real function given in doubles."""
    return circle.real([ComplexBall(float(c.real), float(c.imag)) for c in row])


def start(
    circle: Circle, given: Doubles, laws: tuple[Ball, Ball], rotation: Rotation
) -> Approximate:
    """Return what is given in doubles, as models."""
    x, v = (model(circle, row) for row in given.curve)
    a, b = (shortened(model(circle, row)) for row in given.frame)
    hits = (Hit.near(*(model(circle, row) for row in rows)) for rows in given.hits)
    return Approximate(Curve(x, v), (a, b), HalfPeriods(*laws, tuple(hits)), rotation)


def sharpened(
    at: Approximate, again: Callable[[Curve], Doubles], tell: Callable[[str], None]
) -> Approximate:
    """Return the curve after Newton's method, as long as it gains.

    ``again`` computes what belongs to a curve in doubles: the frame is renewed once.
    """
    circle, curve, frame, rotation = at.curve.x.circle, at.curve, at.frame, at.rotation
    mapped, last = followed(at.map, curve, 2), None
    for step in range(STEPS):
        defect = norm(error_of(mapped(curve.x, curve.v), curve, rotation))
        tell(f"Newton's method: a defect of {defect.str(3, radius=False)}")
        if not defect.is_finite():
            raise NotProved("search", "Newton's method does not converge", {"defect": defect})
        if step > 2 and last is not None and not defect < GAIN * last:
            break
        if step == 1:  # what was noise in the frame is gone
            fresh = start(circle, again(curve), (mapped.alpha, mapped.a), rotation)
            frame = levelled(fresh.map, curve, fresh.frame, rotation)
            mapped = fresh.map
        last = defect
        curve = improved(followed(mapped, curve), curve, frame, rotation)
        mapped = followed(mapped, curve)
    return Approximate(curve, frame, followed(mapped, curve), rotation)


def rounded(u: FourierModel, places: int) -> tuple[FourierModel, str]:
    """Return the function with coefficients rounded to decimals, and these as the format has them.

    They are integers in units 10^-places: re im, re im, ... for the modes 0, 1, ...
    """
    circle, unit = u.circle, 10**places
    half = u.coefficients[circle.degree :]
    pairs = [
        tuple(round(interval.rational(part.mid()) * unit) for part in (c.real, c.imag))
        for c in half
    ]
    pairs[0] = pairs[0][0], 0
    while len(pairs) > 1 and pairs[-1] == (0, 0):
        pairs.pop()
    exact = [ComplexBall(*(interval.ball(Fraction(n, unit)) for n in pair)) for pair in pairs]
    return circle.real(exact), ",".join(f"{re} {im}" for re, im in pairs)


def doubles(curve: Curve) -> list[list[complex]]:
    """Return the coefficients of 0, 1, ... in doubles."""
    n = curve.x.circle.degree
    return [
        [complex(float(c.real.mid()), float(c.imag.mid())) for c in u.coefficients[n:]]
        for u in (curve.x, curve.v)
    ]
