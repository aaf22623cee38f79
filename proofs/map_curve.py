"""Theorem (map_curve).  Let g be a map (x, y) -> (x + b y' + c, y'), y' = y + q(x), of the cylinder
(x mod 2π, y), q a polynomial in cos x and sin x with mean 0, b != 0.  Let α be a quadratic
irrational.  If the lemmas succeed, then

 (i)   there is an invariant analytic curve around the cylinder, near an explicit trigonometric
       polynomial, on which g is conjugate to the rotation by α turns;
 (ii)  on it y lies between explicit bounds: so no orbit goes from below the first to above the
       second, or back.

Proof.  docs/invariant-curve-proof.md, with `cap.tori.kicked`.  The curve is found in doubles, and
made sharp in balls, by Newton's method.
"""

from fractions import Fraction
from typing import Any, NamedTuple

from cap.certificate.writer import FORMAT, bound, dumps, provenance
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems import load
from cap.checker.verdict import check
from cap.errors import NotProved
from cap.floats.candidates import spanning
from cap.proofs.map_horseshoe import as_parameters
from cap.runner import Runner
from cap.sets import interval
from cap.sets.fourier import Circle, FourierModel
from cap.sets.interval import Ball, ComplexBall
from cap.system.planar import Map as Formulas
from cap.tori.approximate import rounded
from cap.tori.between import extent
from cap.tori.invariant_curve import (
    Curve,
    Found,
    Map,
    Rotation,
    Vector,
    error_of,
    invariant_curve,
    measured,
    norm,
)
from cap.tori.kicked import Kicked
from cap.tori.newton import improved, levelled, shortened
from cap.tori.rotation import Quadratic

ROUGH = 20  # decimal places of the frame
REACHES = tuple(Fraction(1, n) for n in (8, 64, 1000))
STEPS, GAIN = 12, Ball((1, -3))
TRIES = 3  # with more and more modes
DIGITS = 12
PLACES = 8  # decimals of bounds
LOOSE, LOOSE_BOUND = Ball("1e-20"), Ball("1e-9")


class Scale(NamedTuple):
    """How functions are computed: modes, ρ, decimal places."""

    degree: int
    rho: Fraction
    places: int

    @property
    def bits(self) -> int:
        """The working precision."""
        return self.places * 10 // 3 + 32

    @classmethod
    def of(cls, decay: float, attempt: int) -> "Scale":
        """Return what suits coefficients that fall like exp(-decay k)."""
        rho = decay / 5
        degree = max(16, round(95 / (decay - rho) * 1.3**attempt))
        return cls(
            degree, Fraction(max(1, round(rho * 10**5)), 10**5), 40 + round(rho * degree / 2.3)
        )


def prove(given: Formulas, q: Quadratic, runner: Runner) -> dict[str, Any]:
    """Return a certificate, which the checker accepts; raise `NotProved`."""
    at = Kicked.of(given)
    terms = [(float(k), m, n) for k, m, n in at.terms()]
    runner.tell(f"a curve with the rotation number {q} is looked for", None)
    found, decay = spanning.found(
        spanning.Kicked(float(at.b), float(at.c), terms), float(q.value())
    )
    failed = NotProved("curve", "there is no number of modes to try")
    for attempt in range(TRIES):
        scale = Scale.of(decay, attempt)
        try:
            with interval.workprec(scale.bits):
                content = proved(at, q, scale, found, runner)
        except NotProved as reason:
            failed = reason
            continue
        return checked(given, content, runner)
    raise failed


def proved(
    at: Kicked, q: Quadratic, scale: Scale, found: spanning.Curve, runner: Runner
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Prove the theorem with so many modes; return claims and hints."""
    circle = Circle(scale.degree, scale.rho)
    gamma = interval.short(q.diophantine())
    omega = 2 * interval.pi() * q.value()
    turn = Rotation.of(circle, omega, interval.ball(gamma))
    mapped = at.over(circle)
    runner.tell(f"alpha = {q}: {scale.degree} modes", None)
    curve = sharpened(mapped, start(circle, found), turn, runner)
    frame = levelled(mapped, curve, normal(curve), turn)
    (x, x_words), (y, y_words) = (rounded(u, scale.places) for u in (curve.x, curve.v))
    (a, a_words), (b, b_words) = (rounded(u, ROUGH) for u in frame)
    curve = Curve(x, y, 1)
    reach, near = lemma_1_curve(mapped, curve, (a, b), turn)
    low, high = extent(curve.v)
    exact = interval.exact_decimal
    claims = {
        "rotation_number": {"head": [*map(str, q.head)], "period": [*map(str, q.period)]},
        "diophantine": exact(gamma),
        "curve": {"first": x_words, "second": y_words},
        "distance": bound(near.distance),
        "bounds": _bounds(low - near.distance, high + near.distance),
    }
    hints = {
        "places": str(scale.places),
        "degree": str(scale.degree),
        "rho": str(scale.rho),
        "reach": str(reach),
        "frame": {"first": a_words, "second": b_words},
    }
    return claims, hints


def _bounds(low: Ball, high: Ball) -> list[str]:
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


def start(circle: Circle, found: spanning.Curve) -> Curve:
    """Return what is given in doubles, as models."""
    x, y = (of_modes(circle, row[: circle.degree + 1]) for row in found)
    return Curve(x, y, 1)


def of_modes(circle: Circle, row: Any) -> FourierModel:
    """Return the real function with these coefficients of 0, 1, ..."""
    return circle.real([ComplexBall(float(c.real), float(c.imag)) for c in row])


def sharpened(mapped: Map, curve: Curve, turn: Rotation, runner: Runner) -> Curve:
    """Return the curve after Newton's method, as long as it gains."""
    last = None
    for step in range(STEPS):
        defect = norm(error_of(mapped(curve.x, curve.v), curve, turn))
        runner.tell(f"Newton's method: a defect of {defect.str(3, radius=False)}", None)
        if not defect.is_finite():
            raise NotProved("search", "Newton's method does not converge", {"defect": defect})
        if step > 1 and last is not None and not defect < GAIN * last:
            break
        last = defect
        curve = improved(mapped, curve, normal(curve), turn)
    return curve


def normal(curve: Curve) -> Vector:
    """Return a frame near J K'/|K'|², from values on a grid in floats: a hint."""
    circle, n = curve.x.circle, curve.x.circle.degree
    rows = [[complex(c.mid()) for c in u.coefficients[n:]] for u in curve.tangent]
    a, b = (shortened(of_modes(circle, row)) for row in spanning.normal(rows))
    return a, b


def checked(
    given: Formulas, content: tuple[dict[str, Any], dict[str, Any]], runner: Runner
) -> dict[str, Any]:
    """Return the certificate that the checker accepts, or raise `NotProved`."""
    claims, hints = content
    certificate = {
        "format": FORMAT,
        "theorem": "map_curve",
        "parameters": as_parameters(given),
        "digits": str(DIGITS),
        "claims": claims,
        "hints": hints,
        "cites": load("map_curve").cited(claims),
        "provenance": provenance(int(hints["places"]) * 10 // 3),
    }
    try:
        check(dumps(certificate).encode(), lambda _step: None, runner.jobs, runner.tell)
    except Rejected as reason:
        raise NotProved("checker", f"the independent checker rejects it: {reason}") from None
    return certificate
