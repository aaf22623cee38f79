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

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from cap.certificate.writer import Pair, bound
from cap.errors import BadInput, NotProved
from cap.floats import candidates
from cap.floats.candidates import tori
from cap.proofs.certified import Content
from cap.proofs.fixed_point import Proof, Setting, settled
from cap.proofs.rotation_choice import LARGEST, ROTATION, Sought, chosen, together
from cap.sets import interval, matrix
from cap.sets.fourier import Circle
from cap.sets.interval import Ball, Box
from cap.sets.matrix import Matrix
from cap.tori import between
from cap.tori.approximate import Approximate, Doubles, doubles, rounded, sharpened, start
from cap.tori.around import area, half_width, winding
from cap.tori.half_period import HalfPeriods, Hit
from cap.tori.invariant_curve import Curve, Found, Rotation, invariant_curve, measured
from cap.tori.rotation import Quadratic
from cap.tori.states import Motion, States, covering

SUMMARY = "an explicit invariant curve around an elliptic orbit: what is inside never stops"
GROUP = "orbit"
SEARCH = candidates.with_islands
OPTIONS = (ROTATION, LARGEST)
CHECK = together

ROUGH = 20  # decimal places of the frame and of inverse speeds
GRIDS = (4, 8, 16, 32, 64, 128, 256)
REACHES = tuple(Fraction(1, n) for n in (300, 1000, 10_000, 100_000, 1_000_000))
LOOSE = Ball("1e-20")
TRIES = 4  # with more and more modes
MODES = 4096
PER_SECOND = 1500  # digits of functions, for half a period
STEPS_OF_CURVE = ("invariant curve", "search", "reciprocal", "frame", "implicit equation", "sine")


@dataclass(frozen=True)
class Place:
    """Where the island is: in floats, and f/F and a exactly."""

    centre: tori.Centre
    laws: tuple[Fraction, Fraction]

    @cached_property
    def last(self) -> float:
        """The radius of the last orbit found that goes on."""
        return tori.last_radius(self.centre)


class Centre(NamedTuple):
    """P*, proved, and the trace of the derivative there."""

    place: Place
    point: Box
    trace: Ball


@dataclass(frozen=True)
class Scale:
    """How functions are computed: modes, ρ, decimal places, working precision."""

    degree: int
    rho: Fraction
    places: int

    @property
    def bits(self) -> int:
        """The working precision."""
        return self.places * 10 // 3 + 32

    @classmethod
    def of(cls, decay: float, digits: int, attempt: int) -> "Scale":
        """Return what suits coefficients that fall like exp(-decay k): the strip is a fifth."""
        rho = decay / 5
        degree = min(round(95 / (decay - rho) * 1.3**attempt), MODES)
        places = max(40 + round(rho * degree / 2.3), digits + 16)
        return cls(degree, Fraction(max(1, round(rho * 10**5)), 10**5), places)


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


def located(setting: Setting) -> Place:
    """Return where the island is; half a period suffices if the orbit is its own image."""
    p, guess = setting.parameters, setting.start
    if not guess.v > 0:
        raise BadInput("the theorem island is about orbits with v > 0 at t = 0")
    laws = p.f / p.F, p.R * p.omega**2 / p.F / 2
    return Place(tori.of_orbit(p, guess.x, guess.v), laws)


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
    scales = {Scale.of(decay, setting.digits, attempt): None for attempt in range(TRIES)}
    failed = NotProved("curve", "there is no number of modes to try")
    for scale in scales:
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
    half = half_width(at.curve, _balls(middle), axes, interval.ball(reach))
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


def loosened(found: Found) -> Found:
    """Return larger bounds, so that the checker, whose rounding errors are larger, agrees."""
    distance, slope = 2 * found.distance + LOOSE, 2 * found.slope + LOOSE
    return found._replace(distance=distance, slope=slope)


def state(setting: Setting, P: Box) -> dict[str, Pair]:
    """Return the claims on P*."""
    p, pair, units = setting.parameters, setting.rounding.loosely, setting.units
    length, speed = (interval.ball(p.F / p.omega**k) for k in (2, 1))
    x = interval.ball((p.l + p.r) / 2) + P[0] * length
    return {"x": pair(x, units.length), "v": pair(P[1] * speed, units.speed)}


def _area(setting: Setting, curve: Curve, found: Found) -> Pair:
    """Return the claim on the area."""
    p = setting.parameters
    return _short(area(curve, found) * interval.ball(p.F**2 / p.omega**3))


def _short(x: Ball) -> Pair:
    """Return an enclosure with few digits more than are certain."""
    lower, upper = interval.ends(x)
    return [*interval.outward(x, 2 - interval.decade(upper - lower))]


def _balls(z: tuple[Fraction, Fraction]) -> Box:
    return interval.ball(z[0]), interval.ball(z[1])


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


def centred(
    motion: Motion, place: Place, digits: int
) -> tuple[tuple[Fraction, Fraction], Matrix[Fraction]]:
    """Return decimals: P* by Newton's method, and the axes of the region."""
    x, v = (interval.ball(Fraction(float(c))) for c in place.centre.point)
    for _ in range(6):
        image, D = derivative(motion, place.centre.halves, (x, v), Ball("1e-12"))
        C = matrix.inverse(matrix.minus_identity(D))
        dx, dv = matrix.apply(C, (image[0] - x, image[1] - v))
        x, v = (interval.point(z) for z in (x - dx, v - dv))
    unit = 10 ** (digits + 8)
    middle = tuple(Fraction(round(interval.rational(z) * unit), unit) for z in (x, v))
    rows = [
        tuple(Fraction(round(float(e) * 10**4), 10**4) for e in row) for row in place.centre.frame
    ]
    return (middle[0], middle[1]), ((rows[0][0], rows[0][1]), (rows[1][0], rows[1][1]))


def derivative(motion: Motion, halves: int, at: Box, r: Ball) -> tuple[Box, Matrix[Ball]]:
    """Return G of a state, and DG over all states within r."""
    z = States(at, ((r, Ball(0)), (Ball(0), r)))
    for _ in range(halves):
        z = motion.after(z)
    (a, b), (c, d) = z.B
    return z.middle, ((a / r, b / r), (c / r, d / r))


def lemma_1_centre(
    motion: Motion, halves: int, middle: tuple[Fraction, Fraction], digits: int
) -> tuple[Box, Ball, dict[str, Any]]:
    """*Statement.* G, that is σ or σσ = Φ, has a fixed point P* in a small square.

    *Computed.* Krawczyk's inclusion.  Return P*, the trace of DG there, and hints.
    """
    radius = Fraction(1, 10 ** (digits + 4))
    m, r = _balls(middle), interval.ball(radius)
    image, D = derivative(motion, halves, m, r)
    C = matrix.inverse(matrix.minus_identity(D))
    trace = matrix.trace(D)
    rough = [[Fraction(round(interval.midpoint(e) * 10**8), 10**8) for e in row] for row in C]
    (p, q), (s, t) = ((interval.ball(e) for e in row) for row in rough)
    D = matrix.minus_identity(D)
    defect = matrix.apply(((p, q), (s, t)), (image[0] - m[0], image[1] - m[1]))
    left = matrix.product(((p, q), (s, t)), D)
    found = []
    for i in (0, 1):
        row = [(1 if i == j else 0) - left[i][j] for j in (0, 1)]
        K = m[i] - defect[i] + interval.symmetric(r * row[0]) + interval.symmetric(r * row[1])
        if not interval.subset_interior(K, m[i] + interval.symmetric(r)):
            raise NotProved("Lemma 1", "Krawczyk's operator leaves the square", {"K": K})
        found.append(K)
    exact = interval.exact_decimal
    hints = {"radius": exact(radius), "preconditioner": [[exact(e) for e in row] for row in rough]}
    return (found[0], found[1]), trace, hints


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
