"""Theorem (homoclinic).  Let P* be a saddle of Φ as in the theorem saddle, for the system

    x'' = F cos ωt - f sgn x',   l < x < r,   elastic walls,   T = 2π/ω.

If the lemmas below succeed, then

 (i)   the unstable and the stable curve of P* cross transversely at a point q in each of some
       explicit boxes, q not P*, at an angle that is enclosed; orbits from q never stop, forwards
       and backwards in time, and tend to P*;
 (ii)  hence (Smale-Birkhoff) some iterate of Φ has a horseshoe: a compact hyperbolic invariant set
       of states from which orbits never stop, on which it is conjugate to the full shift on two
       symbols.

Lemma 3 (`cap.proofs.saddle`) proves that P* is a saddle, Lemma 4 where its curves are near it,
Lemma 5 that they cross.  Which iterate it is, the theorem does not say.
"""

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from typing import Any

from cap.certificate.writer import Pair, window
from cap.errors import NotProved
from cap.floats import candidates
from cap.floats.candidates import Excursion, Saddle
from cap.maps.cones import Cones, cones, directions
from cap.maps.homoclinic import Crossing, Shooter
from cap.maps.stability import real_multipliers
from cap.option import Option, count
from cap.proofs.certified import Content
from cap.proofs.fixed_point import Around, Located, Proof, Setting, proof_of
from cap.proofs.orbit import HITS, need_hits
from cap.proofs.saddle import lemma_3_hyperbolicity
from cap.sets import interval, matrix
from cap.sets.interval import Ball
from cap.sets.matrix import Matrix

SUMMARY = "a saddle's unstable and stable curves cross transversely: homoclinic points, chaos"
GROUP = "orbit"
POINTS = Option(
    "points",
    count(1, 8),
    "homoclinic points, at most (default 2)",
    "N",
    default=2,
)
OPTIONS = (POINTS,)
SMALLER = 8  # rectangles tried around P*, each a tenth of the one before
SEARCH = candidates.saddles


def prove(setting: Setting) -> Proof:
    """Prove the theorem up to the size of its box; return the rest of the proof.

    Raises `NotProved` with the step that failed and the sets at which it did.
    """
    need_hits("homoclinic", setting)
    return proof_of("homoclinic", with_room(setting), HITS, conclusion)


def with_room(setting: Setting) -> Setting:
    """Return the setting with more guard digits: P* must be known as well as the start of an orbit.

    That is within r⁵, nearly, where r is about 10^-(digits/3 + 5).
    """
    return replace(setting, guard=setting.guard + setting.digits + 10)


def conclusion(orbit: Located) -> Callable[[Around], Content]:
    """Prove what the theorem says of P*; return claims and hints."""
    setting = orbit.setting
    multipliers = lemma_3_hyperbolicity(setting, orbit.point)
    near = lemma_4_curves(orbit)
    crossings = lemma_5_crossings(orbit, near)
    claims = {"multipliers": multipliers, "points": [_claims(setting, c) for c in crossings]}
    hints = {
        "frame": [[interval.exact_decimal(q) for q in row] for row in near.frame],
        "reach": interval.exact_decimal(near.reach),
        "slope": interval.exact_decimal(near.slope),
        "orbits": [_hints(c) for c in crossings],
    }
    return lambda _around: (claims, hints)


def lemma_4_curves(orbit: Located) -> Cones:
    """*Statement.* Near P* its unstable and stable curve are graphs, with slopes of at most L.

    *Computed.* Φ' over a rectangle around P*, in the frame of its eigenvectors, of which so many
    digits are taken that L becomes small.  A rectangle that is too large is divided by ten.
    """
    setting = orbit.setting
    first, frame = (setting.digits + 15) // 3, _rounded(_frame(orbit), setting)
    for tenths in range(first, first + SMALLER):
        try:
            return cones(orbit.osc, orbit.point, frame, Fraction(1, 10**tenths))
        except NotProved:
            continue
    return cones(orbit.osc, orbit.point, frame, Fraction(1, 10 ** (first + SMALLER)))


def _frame(orbit: Located) -> Matrix[Ball]:
    """Return the eigenvectors of Φ' at P*, of length 1 in natural units."""
    monodromy = orbit.point.orbit.monodromy
    multipliers = real_multipliers(matrix.trace(monodromy), Ball(1))
    return directions(monodromy, multipliers, orbit.setting.scale)


def _rounded(frame: Matrix[Ball], setting: Setting) -> Matrix[Fraction]:
    """Return a frame of decimals."""
    digits = setting.digits + 15
    (a, b), (c, d) = (
        [round(interval.midpoint(q), digits - interval.decade(unit)) for q in row]
        for row, unit in zip(frame, setting.scale, strict=True)
    )
    return (a, b), (c, d)


def lemma_5_crossings(orbit: Located, near: Cones) -> list[Crossing]:
    """*Statement.* The curves cross transversely at a point in each of some boxes.

    *Computed.* The image of a short piece of the unstable curve under Φⁿ, which crosses the stable
    one near P*, and the tangents there.
    """
    setting, wanted = orbit.setting, orbit.setting.of(POINTS)
    outer = real_multipliers(matrix.trace(orbit.point.orbit.monodromy), Ball(1))[0]
    saddle = Saddle.of(orbit.point.box, near.frame, outer)
    found = candidates.excursions(setting.parameters, saddle, 4 * wanted)
    shooter, proved = Shooter(orbit.osc, setting.parameters, near), list[Crossing]()
    failed: NotProved | None = None
    places = 2 * setting.digits + 40
    for number, guess in enumerate(found, 1):
        setting.progress(f"homoclinic point {number} of {len(found)}")
        try:
            crossing = shooter.crossing(*_started(guess, outer, near), places)
        except NotProved as reason:
            failed = reason
            continue
        if not any(map(crossing.meets, proved)):
            proved.append(crossing)
        if len(proved) == wanted:
            break
    if proved:
        return proved
    none = NotProved("Lemma 5", "no homoclinic point was found", {"P*": orbit.point.box})
    raise failed or none


def _started(guess: Excursion, outer: Ball, near: Cones) -> tuple[Fraction, int]:
    """Return the same orbit from so near P* that what w is there does not matter at its end.

    With c = L/r, the size of second derivatives, w(p) is at most c r p, and it moves P at the end
    by c p times this, times the factor 1/(pr) by which all has grown: by c² p, which must be small
    beside L r = c r².  The steps back are linear ones.
    """
    p, n = interval.ball(Fraction(guess.start)), guess.periods
    limit = interval.ball(near.reach**2 * min(Fraction(1), near.reach / near.slope) / 64)
    while not abs(p) < limit:
        p, n = interval.point(p / outer), n + 1
    return interval.rational(p), n


def _claims(setting: Setting, found: Crossing) -> dict[str, Pair]:
    """Return the claims on a point, rounded outwards, with room for a looser arithmetic."""
    units, (x, v) = setting.units, found.box

    def pair(q: Ball, unit: Fraction = Fraction(1)) -> Pair:
        return setting.rounding.pair(q + 8 * interval.symmetric(q - interval.point(q)), unit)

    return {"x": pair(x, units.length), "v": pair(v, units.speed), "angle": pair(found.angle)}


def _hints(found: Crossing) -> dict[str, Any]:
    """Return what the checker needs and does not trust."""
    return {
        "start": [interval.exact_decimal(end) for end in found.start],
        "hit_times": [[window(hit.window) for hit in period] for period in found.hits],
        "periods": str(found.periods),
    }
