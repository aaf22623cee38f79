"""Invariant curves around a cylinder: what the theorems `map_curve` and `ball_curve` share.

The curve is found in doubles, and made sharp in balls, by Newton's method.
"""

from collections.abc import Callable
from fractions import Fraction
from typing import Any, NamedTuple, Protocol, Self

from cap.certificate.writer import bound
from cap.errors import NotProved
from cap.floats.candidates import spanning
from cap.runner import Runner
from cap.sets import interval
from cap.sets.fourier import Circle, FourierModel
from cap.sets.interval import Ball
from cap.tori.approximate import model, rounded
from cap.tori.between import extent
from cap.tori.invariant_curve import (
    Curve,
    Found,
    Image,
    Map,
    Rotation,
    Vector,
    error_of,
    invariant_curve,
    measured,
    norm,
)
from cap.tori.newton import improved, levelled, shortened
from cap.tori.rotation import Quadratic
from cap.tori.scale import Scale

ROUGH = 20  # decimal places of the frame
REACHES = tuple(Fraction(1, n) for n in (8, 64, 1000, 10_000))
STEPS, GAIN = 12, Ball((1, -3))
TRIES, LEAST = 3, 16  # with more and more modes, at least so many
DIGITS = 12
PLACES = 8  # decimals of bounds
LOOSE, LOOSE_BOUND = Ball("1e-20"), Ball("1e-9")


class Following(Protocol):
    """A map of functions near a curve, with hints for it."""

    def __call__(self, x: FourierModel, y: FourierModel) -> Image:
        """Return the image of the curves in the models."""

    def along(self, curve: Curve) -> Self:
        """Return the map with its hints improved for a curve."""

    def written(self, places: int) -> tuple[dict[str, Any], Self]:
        """Return the hints as the format has them, and the map with these."""


class Sought(NamedTuple):
    """The curve sought: its rotation number, ``whole`` turns and α, in doubles, as it falls."""

    alpha: Quadratic
    whole: int
    found: spanning.Curve
    decay: float


class Proved(NamedTuple):
    """Claims and hints of what is proved, and bounds of y on the curve."""

    claims: dict[str, Any]
    hints: dict[str, Any]
    low: Ball
    high: Ball


def proved(
    sought: Sought, mapped: Callable[[Circle], Following], runner: Runner
) -> tuple[Proved, Scale]:
    """Prove that there is an invariant curve; raise `NotProved`."""
    failed = NotProved("curve", "there is no number of modes to try")
    for attempt in range(TRIES):
        scale = Scale.of(sought.decay, attempt, least=LEAST)
        try:
            with interval.workprec(scale.bits):
                return _proved(sought, mapped, scale, runner), scale
        except NotProved as reason:
            failed = reason
    raise failed


def _proved(
    sought: Sought, mapped: Callable[[Circle], Following], scale: Scale, runner: Runner
) -> Proved:
    q, circle = sought.alpha, Circle(scale.degree, scale.rho)
    gamma = interval.short(q.diophantine())
    omega = 2 * interval.pi() * (q.value() + sought.whole)
    turn = Rotation.of(circle, omega, interval.ball(gamma))
    runner.tell(f"alpha = {q}: {scale.degree} modes", None)
    x, y = (model(circle, row[: circle.degree + 1].tolist()) for row in sought.found)
    curve, following = sharpened(mapped(circle), Curve(x, y, 1), turn, runner)
    frame = levelled(following, curve, normal(curve), turn)
    (x, x_words), (y, y_words) = (rounded(u, scale.places) for u in (curve.x, curve.v))
    (a, a_words), (b, b_words) = (rounded(u, ROUGH) for u in frame)
    curve = Curve(x, y, 1)
    words, following = following.along(curve).written(scale.places)
    reach, near = lemma_1_curve(following, curve, (a, b), turn)
    low, high = extent(curve.v)
    exact = interval.exact_decimal
    claims = {
        "rotation_number": {"head": [*map(str, q.head)], "period": [*map(str, q.period)]},
        "diophantine": exact(gamma),
        "curve": {"first": x_words, "second": y_words},
        "distance": bound(near.distance),
    }
    hints = {
        "places": str(scale.places),
        "degree": str(scale.degree),
        "rho": str(scale.rho),
        "reach": str(reach),
        "frame": {"first": a_words, "second": b_words},
        **words,
    }
    return Proved(claims, hints, low - near.distance, high + near.distance)


def bounds(low: Ball, high: Ball) -> list[str]:
    """Return the ends with a few decimals, rounded outwards, and a little more."""
    return [*interval.outward(interval.hull(low - LOOSE_BOUND, high + LOOSE_BOUND), PLACES)]


def lemma_1_curve(
    mapped: Map, curve: Curve, frame: Vector, turn: Rotation
) -> tuple[Fraction, Found]:
    """*Statement.* There is an invariant curve near K, with the rotation number.

    *Computed.* The image of K, that of all functions within r of K, the inequalities; the largest r
    of a few with which they succeed.
    """
    failed = NotProved("invariant curve", "there is no reach to try")
    for reach in REACHES:
        try:
            found = invariant_curve(measured(mapped, curve, frame, turn, interval.ball(reach)))
        except NotProved as reason:
            failed = reason
            continue
        distance, slope = 2 * found.distance + LOOSE, 2 * found.slope + LOOSE
        return reach, found._replace(distance=distance, slope=slope)
    raise failed


def sharpened(
    following: Following, curve: Curve, turn: Rotation, runner: Runner
) -> tuple[Curve, Following]:
    """Return the curve after Newton's method, as long as it gains, and the map along it."""
    last = None
    for step in range(STEPS):
        following = following.along(curve)
        defect = norm(error_of(following(curve.x, curve.v), curve, turn))
        runner.tell(f"Newton's method: a defect of {defect.str(3, radius=False)}", None)
        if not defect.is_finite():
            raise NotProved("search", "Newton's method does not converge", {"defect": defect})
        if step > 1 and last is not None and not defect < GAIN * last:
            break
        last = defect
        curve = improved(following, curve, normal(curve), turn)
    return curve, following.along(curve)


def normal(curve: Curve) -> Vector:
    """Return a frame near J K'/|K'|², from values on a grid in floats: a hint."""
    circle, n = curve.x.circle, curve.x.circle.degree
    rows = [[complex(c.mid()) for c in u.coefficients[n:]] for u in curve.tangent]
    a, b = (shortened(model(circle, row)) for row in spanning.normal(rows))
    return a, b
