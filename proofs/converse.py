"""Theorem (converse).  Let an elliptic fixed point P* of the stroboscopic map Φ of

    x'' = F cos ωt - f sgn x',   l < x < r,   elastic walls,   T = 2π/ω,   f > 0,

be guessed, whose orbit hits the right wall once in (0, T/2), the left wall once in (T/2, T), and
never stops.  Let N be the set of the states at t = 0 from which the velocity never vanishes,
neither forward nor backward in time.  If the lemmas below succeed, every connected subset of N that
contains P* lies inside a polygon that is given, and whose area is bounded: so do all invariant
disks around P* from which no motion stops.

If the orbit is its own image by the symmetry, Φ is replaced by σ: half a period and the symmetry.

Proof.  Polygons R_1, R_2, ... around P*.  All motions from R_1 stop, forward or backward.  Motions
from R_(j+1) stop, or some Φⁿ brings their state out of R_j.  The connected component N_0 of P* in N
is invariant, so it meets none of them, one after the other: docs/theorems/converse.md.
Units F = ω = 1, places from the middle between the walls, which are at ±a.
"""

import math
from fractions import Fraction

import numpy as np

from cap.areas.rings.half_periods import Floats
from cap.areas.rings.search import COLUMNS, Island, Ring, rings
from cap.errors import BadInput, NotProved
from cap.floats import candidates
from cap.floats.candidates import tori
from cap.proofs.fixed_point import Proof, Setting, settled
from cap.proofs.island_centre import Place, centred, lemma_1_centre, located, state
from cap.proofs.options import JOBS
from cap.sets import interval
from cap.sets.compiled import PROBE, require_ieee, rounds_to_nearest
from cap.tori.states import Motion

SUMMARY = "a polygon around an elliptic orbit: no disk of motions that never stop is larger"
GROUP = "orbit"
SEARCH = candidates.elliptic
OPTIONS = (JOBS,)
FINE = 12  # digits of P* at least, in units of the state
PARTS = range(99, 80, -1)  # in hundredths of the last radius: where a curve is looked for
PERIODS = 8_000
ROUGH = 0.02  # neighbouring points of a curve are at radii that differ by less than this part


def prove(setting: Setting) -> Proof:
    """Find rings; there is no box whose size is left to choose."""
    p = setting.parameters
    strings = p.elastic_strings()
    if not p.f > 0:
        raise BadInput("the theorem converse needs friction: f > 0")
    require_ieee(rounds_to_nearest(PROBE))
    place = located(setting)
    digits = max(setting.digits, FINE)
    bits = digits * 10 // 3 + 96
    with interval.workprec(bits):
        motion = Motion.of(*place.laws)
        middle, _ = centred(motion, place, digits)
        P, _, krawczyk = lemma_1_centre(motion, place.centre.halves, middle, digits)
        claims = {
            "map": "Phi" if place.centre.halves == 2 else "sigma",
            **state(setting, P),
        }
    found = lemma_2_rings(setting, place, middle)
    claims["rings"] = [ring.words for ring in found]
    claims["area"] = _above(found[-1].area * p.F**2 / p.omega**3)
    hints = {
        "bits": str(bits),
        "middle": [interval.exact_decimal(z) for z in middle],
        **krawczyk,
        "flights": [ring.flights for ring in found],
    }
    return settled("converse", setting, strings, (claims, hints))


def lemma_2_rings(setting: Setting, place: Place, middle: tuple[Fraction, Fraction]) -> list[Ring]:
    """*Statement.* All motions from the first ring stop; those from another one stop, or leave the
    ring before.

    *Computed.* Each edge, as a few segments, is carried over so many half periods, in intervals of
    doubles: the middle, the derivative along the segment, and an error.
    """
    setting.progress("a curve on which orbits stay is looked for")
    at = place.centre
    axes = at.frame if np.linalg.det(at.frame) > 0 else at.frame * [1, -1]
    curve = _curve(at) if axes is at.frame else _curve(at)[-np.arange(COLUMNS)]
    island = Island(*place.laws, middle, at.halves, axes, curve)
    return rings(island, setting.runner, setting.progress)


def _curve(at: tori.Centre) -> Floats:
    """Return the radii at equal angles, in the axes of the frame, of a curve near the last one."""
    last = tori.last_radius(at)
    equal = np.arange(COLUMNS) * 2 * math.pi / COLUMNS
    for part in PARTS:
        orbit = at.orbit(part / 100 * last, PERIODS)
        angles, radii = np.arctan2(orbit[:, 1], orbit[:, 0]), np.hypot(*orbit.T)
        along = radii[np.argsort(angles)]
        if (abs(np.diff(along)) < ROUGH * along[1:]).all():
            result: Floats = np.interp(equal, np.sort(angles), along, period=2 * math.pi)
            return result
    raise NotProved("search", "no curve was found on which orbits stay", {"last radius": last})


def _above(area: Fraction) -> str:
    """Return a decimal of five significant digits above a number."""
    places = 4 - math.floor(math.log10(area))
    return interval.fixed(math.ceil(area * Fraction(10) ** places), places)
