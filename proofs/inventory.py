"""Theorem (inventory).  Let 0 < f < F, α = f/F, ρ = Rω²/F, and Φ the time-T map of

    x'' = F cos ωt - f sgn x',   l < x < r,   elastic walls,   T = 2π/ω.

 (i)   A T-periodic orbit whose velocity never vanishes is never faster than U F/ω, U = u_0 + V with
       V = 4 (sqrt(1 - α²) - α arccos α) and u_0 the lesser of the positive roots of 2πα u² - 2ρ u -
       ρV and 16πα u⁴ - ρ² (4u² + (8 + 12α) u + 8 + 6πα + 12α²); so it hits each wall m times in a
       period, 1 <= m <= πU/ρ.
 (ii)  The fixed points of Φ that belong to such orbits with m = 1 are those listed, with their
       traces: they are among two symmetric ones and a pair, in closed form.
 (iii) Each such orbit with m > 1 leaves a wall somewhere in the boxes of launches that are left
       over, if there are any; so if there are none, the list is complete.

Orbits with m > 1 are not proved to exist: near one, boxes are left over.  Floats find some with m =
3 at small friction (R = 1, F = ω = 1, f = 1/100), where the boxes are too many for a certificate.

T-periodic orbits that touch no wall turn; they are named, as a family, and not counted.

Proof.  (i), (iii): `cap.maps.inventory`, a search over all launches in boxes that are proved empty.
(ii): `cap.one_one.closed_form`.  The family is that of the theorem segment: it exists if and only
if α < 2/sqrt(4 + π²), and the stroke 2 sqrt(1 - (πα/2)²) F/ω² is less than R.
"""

from fractions import Fraction
from typing import Any, cast

from cap.certificate import NONE
from cap.checker.theorems.inventory import MAX_BOXES
from cap.errors import NotProved
from cap.floats import candidates
from cap.maps import inventory
from cap.maps.inventory import Box, Effort, TooMany, Tree
from cap.maps.launch_set import Constants, Window
from cap.one_one.closed_form import Orbit, symmetric
from cap.proofs.fixed_point import Proof, Setting, settled
from cap.proofs.one_one import Scale, pair_at
from cap.sets import interval

SUMMARY = "all T-periodic orbits whose velocity never vanishes: none is left out"
GROUP = "family"
SEARCH = candidates.closed_form

LONGEST = Fraction(62832, 10000)  # more than 2π
DEPTH = 40  # halvings of a box of launches
BITS = 64  # of the search
SMALLEST = Fraction(1, 10**6)  # of sizes


def prove(setting: Setting) -> Proof:
    """Prove the theorem; there is no box whose size is left to choose."""
    limits, found = lemma_1_launches(setting)
    with interval.workprec(setting.bits):
        points, asymmetry_hint = lemma_2_one_hit(setting)
        claims = {
            "fixed_points": points,
            "families": lemma_3_families(setting),
            "undecided": {"boxes": str(len(found.open)), "size": _size(found.open, limits.speed)},
            "highest_speed": interval.exact_decimal(limits.speed),
            "most_hits": str(limits.hits),
        }
    hints = {
        "bits": str(setting.checker_bits),
        "asymmetry": asymmetry_hint,
        "tree": "".join(found.text) or NONE,
        "flights": [_told(windows) for windows in found.flights],
    }
    strings = setting.parameters.elastic_strings()
    return settled("inventory", setting, strings, (claims, hints))


def lemma_1_launches(setting: Setting) -> tuple[inventory.Bounds, Tree]:
    """*Statement.* No orbit with m > 1 launches from a box of the tree that is not left open.

    *Computed.* U, rounded up; the most hits; if these are several of each wall, the tree.
    """
    p = setting.parameters
    with interval.workprec(BITS):
        system = Constants.of(interval.ball(p.f / p.F), interval.ball(p.R * p.omega**2 / p.F))
        limits = inventory.bounds(system)
        if limits.hits < 2:
            return limits, Tree()

        def tell(done: int, waiting: int) -> None:
            setting.progress(f"{done} boxes of launches examined; {waiting} wait")

        sides = interval.ball(LONGEST), interval.ball(limits.speed)
        try:
            return limits, inventory.tree(system, sides, Effort(DEPTH, MAX_BOXES), tell)
        except TooMany:
            words = "more boxes of launches than a certificate may have: f or R is too small"
            sets = {"boxes": MAX_BOXES, "f/F": system.alpha, "hits": limits.hits}
            raise NotProved("Lemma 1", words, sets) from None


def lemma_2_one_hit(setting: Setting) -> tuple[list[dict[str, Any]], Any]:
    """*Statement.* The orbits with one hit of each wall, and no others, have these fixed points.

    *Computed.* The formulas, the signs of the least speeds, δ of the pair between two decimals.
    """
    scale, alpha = Scale(setting), interval.ball(setting.parameters.f / setting.parameters.F)
    points, hint = list[dict[str, Any]](), cast(Any, NONE)
    bound = 2 / interval.pi()
    if not (alpha < bound or alpha > bound):
        raise NotProved("Lemma 2", "f may be 2F/pi", {"f/F": alpha})
    if alpha > bound:
        return points, hint
    for sign in (1, -1):
        orbit = symmetric(alpha, scale.rho, sign)
        if not orbit.mean_speed < 0 and _is_orbit(orbit):
            points.append(point(scale, orbit))
    pair = pair_at(alpha, scale.rho, setting.precise, "Lemma 2")
    if pair is not None:
        ends, orbit = pair
        hint = [interval.exact_decimal(end) for end in ends]
        if _is_orbit(orbit):
            points += [point(scale, orbit), point(scale, orbit.mirrored())]
    return points, hint


def _is_orbit(orbit: Orbit) -> bool:
    """Return whether the least speed is positive."""
    least = orbit.least_speed()
    if not (least > 0 or least < 0):
        raise NotProved("Lemma 2", "the least speed may vanish", {"speed": least})
    return bool(least > 0)


def point(scale: Scale, orbit: Orbit) -> dict[str, Any]:
    """Return the claims on the fixed point of an orbit."""
    t1, (gap, v) = orbit.right_hit(), orbit.start()
    if not (t1 > 0 or t1 < 0):
        raise NotProved("Lemma 2", "a mass may be at the right wall at t = 0", {"t1": t1})
    x = interval.ball(scale.p.r) - gap * scale.F / scale.omega**2
    return {
        "x": scale.length(x),
        "v": scale.speed(v),
        "trace": scale.number(orbit.trace()),
        "hits": "2",
    }


def lemma_3_families(setting: Setting) -> list[str]:
    """*Statement.* T-periodic orbits that touch no wall exist, or do not.

    *Computed.* The force at their turns, and their stroke.
    """
    p = setting.parameters
    alpha, rho = interval.ball(p.f / p.F), interval.ball(p.R * p.omega**2 / p.F)
    limit = 2 / (4 + interval.pi() ** 2).sqrt()
    if alpha > limit:
        return []
    stroke = 2 * (1 - (interval.pi() * alpha / 2) ** 2).sqrt()
    if not (alpha < limit and (stroke < rho or stroke > rho)):
        sets = {"f/F": alpha, "stroke": stroke}
        raise NotProved("Lemma 3", "whether there are orbits that touch no wall is open", sets)
    return ["segment"] if stroke < rho else []


def _size(boxes: list[Box], U: Fraction) -> str:
    """Return the integral of u dt du over boxes, rounded up."""
    total = Fraction(0)
    for box in boxes:
        low, high = (U * Fraction(k, 2**box.u_depth) for k in (box.u, box.u + 1))
        total += LONGEST / 2**box.t_depth * (high * high - low * low) / 2
    return interval.exact_decimal(-(-total // SMALLEST) * SMALLEST)


def _told(windows: list[Window]) -> str:
    """Return the windows of a box as a string: of each a, and b - a, and m - a."""
    return ",".join(" ".join(map(str, _numbers(window))) for window in windows)


def _numbers(window: Window) -> list[int]:
    a, b, m = window
    if b <= a:
        return [a]
    return [a, b - a] if m is None else [a, b - a, m - a]
