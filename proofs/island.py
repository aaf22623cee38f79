"""Theorem (island).  Let an elliptic fixed point P* of the stroboscopic map Φ of

    x'' = F cos ωt - f sgn x',   l < x < r,   elastic walls,   T = 2π/ω,   f > 0,

be guessed, whose orbit hits the right wall once in (0, T/2), the left wall once in (T/2, T), and
never stops.  Let α be a quadratic irrational.  If the lemmas below succeed, then

 (i)   there is an invariant analytic closed curve around P*, near an explicit trigonometric
       polynomial, on which Φ is conjugate to the rotation by α turns;
 (ii)  the open disk D inside it is invariant, and its area is enclosed;
 (iii) all motions from D have a velocity that never vanishes, for all times, with one hit of
       the right wall in each (nT, nT + T/2), and of the left wall in each (nT + T/2, nT + T);
 (iv)  if so claimed, the image of D by (x, v, t) -> (l + r - x, -v, t + T/2) is disjoint from D;
 (v)   if so claimed: for each fraction p/q, in lowest terms, between α and the rotation number at
       P*, there are at least two periodic orbits of Φ in D of minimal period q (by Franks).

If the orbit is its own image by the symmetry, Φ is replaced by σ: half a period and the symmetry.

Proof.  docs/invariant-curve-proof.md.  Units F = ω = 1, places from the middle between
the walls, which are at ±a.
"""

from fractions import Fraction
from typing import Any, NamedTuple

from cap.certificate.writer import Pair, bound
from cap.errors import BadInput, NotProved
from cap.floats import candidates
from cap.floats.candidates import tori
from cap.proofs.certified import Content
from cap.proofs.fixed_point import Proof, Setting, settled
from cap.proofs.island_centre import Place, balls, centred, lemma_1_centre, located, state
from cap.proofs.island_curve import approximate, lemma_2_curve, loosened, written
from cap.proofs.rotation_choice import LARGEST, ROTATION, Sought, chosen, together
from cap.sets import interval
from cap.sets.interval import Ball, Box
from cap.sets.matrix import Matrix
from cap.tori import between
from cap.tori.approximate import Approximate
from cap.tori.around import area, half_width, winding
from cap.tori.invariant_curve import Curve, Found
from cap.tori.rotation import Quadratic
from cap.tori.scale import Scale
from cap.tori.states import Motion, States, covering

SUMMARY = "an explicit invariant curve around an elliptic orbit: what is inside never stops"
GROUP = "orbit"
SEARCH = candidates.with_islands
OPTIONS = (ROTATION, LARGEST)
CHECK = together

GRIDS = (4, 8, 16, 32, 64, 128, 256)
REACHES = tuple(Fraction(1, n) for n in (300, 1000, 10_000, 100_000, 1_000_000))
MODES = 4096
TRIES = 4  # with more and more modes
PER_SECOND = 1500  # digits of functions, for half a period
STEPS_OF_CURVE = ("invariant curve", "search", "reciprocal", "frame", "implicit equation", "sine")


class Centre(NamedTuple):
    """P*, proved, and the trace of the derivative there."""

    place: Place
    point: Box
    trace: Ball


def prove(setting: Setting) -> Proof:
    """Prove the theorem; there is no box whose size is left to choose."""
    p = setting.parameters
    strings = p.elastic_strings()
    if not p.f > 0:
        raise BadInput("the theorem island needs friction: f > 0")
    place = located(setting)
    failed = NotProved("search", "there is no rotation number to try")
    for sought in chosen(setting, place):
        try:
            content = island(setting, place, sought)
        except NotProved as reason:
            setting.progress(f"alpha = {sought.rotation} is not proved: {reason.step}")
            failed = reason
        else:
            return settled("island", setting, strings, content)
    raise failed


def island(setting: Setting, place: Place, sought: Sought) -> Content:
    """Prove the theorem for one rotation number; return claims and hints."""
    q = sought.rotation
    setting.progress(f"alpha = {q}: orbits with this rotation number are looked for")
    rows = tori.coefficients(place.centre, float(q.value()), sought.ring)
    if not tori.winds(place.centre, rows):
        raise NotProved("Lemma 3", "the curve may not wind around P*", {"rotation number": str(q)})
    reaches = [r for r in REACHES if tori.never_stops(place.centre, rows, float(r))]
    if not reaches:
        raise NotProved("Lemma 1", "motions from around the curve may stop", {"alpha": str(q)})
    decay = tori.decay(rows)
    if 95 / decay > MODES:
        raise NotProved("curve", "its coefficients fall too slowly", {"exponent": decay})
    tries = (Scale.of(decay, n, setting.digits, most=MODES) for n in range(TRIES))
    failed = NotProved("curve", "there is no number of modes to try")
    for scale in dict.fromkeys(tries):
        try:
            with interval.workprec(scale.bits):
                return _content(setting, place, q, scale, (rows, reaches))
        except NotProved as reason:
            if reason.step not in STEPS_OF_CURVE:
                raise
            failed = reason
    raise failed


def _content(
    setting: Setting, place: Place, q: Quadratic, scale: Scale, start: tuple[Any, list[Fraction]]
) -> Content:
    rows, reaches = start
    work = scale.degree * scale.places * place.centre.halves
    setting.progress(f"alpha = {q}: {scale.degree} modes, about {work // PER_SECOND} s")
    gamma = interval.short(q.diophantine())
    at = approximate(setting, place, (q, gamma), scale, rows)
    words, at = written(at, scale.places)
    reach, proved = lemma_2_curve(at, reaches)
    found = loosened(proved)
    motion = Motion.of(*place.laws)
    middle, axes = centred(motion, place, setting.digits)
    P, trace, krawczyk = lemma_1_centre(motion, place.centre.halves, middle, setting.digits)
    half = half_width(at.curve, balls(middle), axes, interval.ball(reach))
    setting.progress("the region around the curve is covered")
    cells, disks = lemma_1_region(place, (middle, axes, half))
    turns = winding(at.curve, P, axes, found.distance)
    orbits, ray = lemma_5_orbits(setting, at, Centre(place, P, trace), (q, turns), found)
    exact = interval.exact_decimal
    claims = {
        "map": "Phi" if place.centre.halves == 2 else "sigma",
        **state(setting, P),
        "rotation_number": {"head": [*map(str, q.head)], "period": [*map(str, q.period)]},
        "diophantine": exact(gamma),
        "curve": words["curve"],
        "distance": bound(found.distance),
        "winding": str(turns),
        "area": _area(setting, at.curve, found),
        "disks": str(disks),
        **orbits,
    }
    hints = {
        "places": str(scale.places),
        "degree": str(scale.degree),
        "rho": str(scale.rho),
        "reach": str(reach),
        "frame": words["frame"],
        "hits": words["hits"],
        "middle": [exact(z) for z in middle],
        **krawczyk,
        "axes": [[exact(z) for z in row] for row in axes],
        "half": exact(half),
        "cells": str(cells),
        **ray,
    }
    return claims, hints


def _area(setting: Setting, curve: Curve, found: Found) -> Pair:
    """Return the claim on the area."""
    p = setting.parameters
    return _short(area(curve, found) * interval.ball(p.F**2 / p.omega**3))


def _short(x: Ball) -> Pair:
    """Return an enclosure with few digits more than are certain."""
    lower, upper = interval.ends(x)
    return [*interval.outward(x, 2 - interval.decade(upper - lower))]


def lemma_5_orbits(
    setting: Setting,
    at: Approximate,
    centre: Centre,
    curve: tuple[Quadratic, int],
    found: Found,
) -> Content:
    """*Statement.* The rotation number at P*, in the sense of the curve's, is another one.

    *Computed.* The sense in which a segment from P* to the curve is turned; the trace at P*.  If
    that does not succeed, no periodic orbits are claimed.
    """
    halves, (q, turns) = centre.place.centre.halves, curve
    motion = Motion.of(*centre.place.laws)

    def after(z: States) -> States:
        for _ in range(halves):
            z = motion.after(z)
        return z

    try:
        ray = between.ray(after, centre.point, at.curve, found.distance)
        alpha, same = q.value(), ray.sense == turns
        number = between.at_centre(centre.trace, same=same, alpha=alpha)
        if not (number < alpha or number > alpha):
            raise NotProved("Lemma 5", "both rotation numbers may be equal", {"at P*": number})
    except NotProved as reason:
        setting.progress(f"no periodic orbits are claimed: {reason}")
        return {}, {}
    claim = {"centre": _short(number + interval.symmetric(2 * number.rad()))}
    return {"orbits": claim}, {"ray": {"place": str(ray.place), "pieces": str(ray.pieces)}}


def lemma_1_region(
    place: Place, region: tuple[tuple[Fraction, Fraction], Matrix[Fraction], Fraction]
) -> tuple[int, int]:
    """*Statement.* From the region motions never stop for half a period, or two, with one hit each.

    *Computed.* On the parallelograms of a grid; return its size, and 2 if the image of the region
    by σ is disjoint from it, and G = σσ.
    """
    failed = NotProved("Lemma 1", "there is no grid to try")
    with interval.workprec(96):
        motion = Motion.of(*place.laws)
        for count in GRIDS:
            try:
                before, after = swept(motion, place.centre.halves, covering(*region, count))
            except NotProved as reason:
                failed = reason
            else:
                apart = before < after or before > after
                return count, 2 if apart and place.centre.halves == 2 else 1
    raise failed


def swept(motion: Motion, halves: int, cells: list[States]) -> tuple[Ball, Ball]:
    """Follow all cells; return what v is at first, and half a period later."""
    before, after = None, None
    for cell in cells:
        z = motion.after(cell)
        if halves == 2:
            motion.after(z)
        v, V = cell.range(1), z.range(1)
        before = v if before is None else interval.hull(before, v)
        after = V if after is None else interval.hull(after, V)
    if before is None or after is None:
        raise NotProved("Lemma 1", "the region is empty")
    return before, after
