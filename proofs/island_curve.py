"""The invariant curve of `cap.proofs.island`: approximated in floats and balls, then proved.

What is approximated is written as polynomials with decimals for coefficients; of these an invariant
curve nearby is proved, with its distance.
"""

from fractions import Fraction
from typing import Any

import numpy as np

from cap.errors import NotProved
from cap.floats.candidates import tori
from cap.proofs.fixed_point import Setting
from cap.proofs.island_centre import Place
from cap.sets import interval
from cap.sets.fourier import Circle
from cap.sets.interval import Ball
from cap.tori.approximate import Approximate, Doubles, doubles, rounded, sharpened, start
from cap.tori.half_period import HalfPeriods, Hit
from cap.tori.invariant_curve import Curve, Found, Rotation, invariant_curve, measured
from cap.tori.rotation import Quadratic
from cap.tori.scale import Scale

ROUGH = 20  # decimal places of the frame and of inverse speeds
LOOSE = Ball("1e-20")


def approximate(
    setting: Setting, place: Place, q: tuple[Quadratic, Fraction], scale: Scale, rows: Any
) -> Approximate:
    """Find the curve; nothing is proved."""
    circle = Circle(scale.degree, scale.rho)
    omega, gamma = 2 * interval.pi() * q[0].value(), interval.ball(q[1])
    rotation = Rotation.of(circle, omega, gamma)
    laws = interval.ball(place.laws[0]), interval.ball(place.laws[1])

    def again(curve: Curve) -> Doubles:
        return _doubles(tori.torus(place.centre, np.array(doubles(curve)), scale.degree))

    first = start(circle, _doubles(tori.torus(place.centre, rows, scale.degree)), laws, rotation)
    return sharpened(first, again, setting.progress)


def _doubles(torus: tori.Torus) -> Doubles:
    return Doubles(torus.curve.tolist(), torus.frame.tolist(), [h.tolist() for h in torus.hits])


def written(at: Approximate, places: int) -> tuple[dict[str, Any], Approximate]:
    """Return all polynomials with decimals for coefficients, and as the certificate has them."""
    (x, x_words), (v, v_words) = (rounded(u, places) for u in (at.curve.x, at.curve.v))
    (a, a_words), (b, b_words) = (rounded(u, ROUGH) for u in at.frame)
    hits, hit_words = list[Hit](), []
    for hit in at.map.hits:
        (t, t_words), (w, w_words) = rounded(hit.time, places), rounded(hit.inverse, ROUGH)
        hits.append(Hit.near(t, w))
        hit_words.append({"time": t_words, "inverse": w_words})
    mapped = HalfPeriods(at.map.alpha, at.map.a, tuple(hits))
    words = {
        "curve": {"x": x_words, "v": v_words},
        "frame": {"x": a_words, "v": b_words},
        "hits": hit_words,
    }
    return words, Approximate(Curve(x, v), (a, b), mapped, at.rotation)


def lemma_2_curve(at: Approximate, reaches: list[Fraction]) -> tuple[Fraction, Found]:
    """*Statement.* There is an invariant curve near K, with the rotation number.

    *Computed.* The image of K, that of all functions within r of K, the inequalities; the largest r
    of a few with which they succeed.
    """
    failed = NotProved("invariant curve", "there is no reach to try")
    for reach in reaches:
        try:
            sizes = measured(at.map, at.curve, at.frame, at.rotation, interval.ball(reach))
            return reach, invariant_curve(sizes)
        except NotProved as reason:
            failed = reason
    raise failed


def loosened(found: Found) -> Found:
    """Return larger bounds, so that the checker, whose rounding errors are larger, agrees."""
    distance, slope = 2 * found.distance + LOOSE, 2 * found.slope + LOOSE
    return found._replace(distance=distance, slope=slope)
