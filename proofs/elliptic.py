"""Theorem (elliptic).  Let the stroboscopic map Φ of

    x'' = F cos ωt - f sgn x',   l < x < r,   elastic walls,   T = 2π/ω,

be given at rational parameters, and let a non-sticking T-periodic orbit be guessed.  If the lemmas
below succeed, then

 (i)   Φ has exactly one fixed point P* in an explicit box; all orbits from the box are
       non-sticking, with the same sequence of transverse wall hits, so Φ is analytic and preserves
       area there;
 (ii)  P* is elliptic, with enclosed multipliers e^{±iΘ}, and without resonance of order <= 4;
 (iii) in a complex coordinate z with dx∧dv = (i/2) dz∧dz̄ at P*, so that angles from x to v are
       positive, Φ(z) = z exp(i(Θ + τ_1|z|²)) + O(|z|⁴), with the signed angle Θ in (-π, π) and
       the first Birkhoff coefficient τ_1 enclosed; τ_1 is not zero;
 (iv)  hence, by Moser's twist theorem, every neighbourhood of P* contains closed curves around P*,
       invariant under Φ, on which Φ is conjugate to a rotation; they have density one at P*,
       which is stable.

At the paper's parameters this is Theorem CAP-elliptic, and Proposition CAP-KAM without condition.
Lemmas 1 and 2 (`cap.proofs.fixed_point`) give (i), Lemma 3 gives (ii), Lemma 4 gives (iii).
Lemma 5 bounds, on an explicit disk, how far Φ is from its Taylor polynomial.
"""

import math
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

from cap.certificate import writer as certificate
from cap.errors import NotProved
from cap.floats import candidates
from cap.flow.event import TAYLOR_MODELS
from cap.flow.jet_transport import strobe_jet
from cap.flow.model import Oscillator
from cap.flow.strobe import strobe
from cap.maps import normal_form
from cap.maps.fixed_point import FixedPoint, Neighbourhood
from cap.maps.normal_form import Ellipticity
from cap.option import Option, choice
from cap.proofs.certified import Content
from cap.proofs.fixed_point import Around, Located, Proof, Setting, proof_of
from cap.proofs.orbit import HITS, need_hits
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.jet import Jet
from cap.sets.matrix import trace
from cap.sets.taylor_model import Domain, TaylorModel

SUMMARY = "an elliptic T-periodic orbit that never stops: its twist, invariant curves around it"
GROUP = "orbit"
SEARCH = candidates.non_sticking


def _order(words: Sequence[str], name: str) -> int:
    return int(choice("3", "5", "7", "9")(words, name))


ORDER = Option(
    "order",
    _order,
    "odd order of the normal form, 3 to 9 (default 3, or 5 with a resonance of order 5 to 8 near)",
    "N",
)
OPTIONS = (ORDER,)

RESONANCES = {"0": Fraction(0), "1/4": Fraction(1, 4), "1/3": Fraction(1, 3), "1/2": Fraction(1, 2)}


def prove(setting: Setting) -> Proof:
    """Prove the theorem up to the size of its box; return the rest of the proof.

    Raises `NotProved` with the step that failed and the sets at which it did.
    """
    need_hits("elliptic", setting)
    return proof_of("elliptic", setting, HITS, conclusion)


def conclusion(orbit: Located) -> Callable[[Around], Content]:
    """Prove what the theorem says of P*, from the jet of Φ there; return the claims."""
    setting, point = orbit.setting, orbit.point
    order = setting.of(ORDER) or order_near(float(trace(point.orbit.monodromy).mid()))
    jets = strobe_jet(orbit.osc, point.box, point.orbit, order)
    claims = {
        **lemma_3_ellipticity(setting, jets),
        **lemma_4_twist(setting, jets),
        "taylor": taylor_claims(setting, jets),
    }

    def conclude(around: Around) -> Content:
        remainder = lemma_5_remainder(orbit.osc, point, around.proved, jets)
        hints = {"bits": str(setting.checker_bits_to(order)), "order": str(order)}
        return {**claims, "remainder": remainder}, hints

    return conclude


def order_near(trace: float) -> int:
    """Return 5 if the rotation number is within 1/100 of a p/q with 5 <= q <= 8, else 3.

    Near such a resonance the first twist says little at a small distance from the fixed point
    already, so the second one is claimed as well.
    """
    if not abs(trace) < 2:
        return 3
    rotation = math.acos(trace / 2) / (2 * math.pi)
    distances = (abs(rotation - p / q) for q in range(5, 9) for p in range(1, q))
    return 5 if min(distances) < 1 / 100 else 3


def lemma_3_ellipticity(setting: Setting, jets: tuple[Jet, Jet]) -> dict[str, Any]:
    """*Statement.* |trace| < 2, and the rotation number |Θ|/2π is none of 0, 1/4, 1/3, 1/2.

    *Computed.* Θ from the Jacobian, its sign from the orientation, and its distance to
    each p/q with q <= 4; as 0 < |Θ|/2π < 1/2, those in [0, 1/2] suffice.
    """
    linear = normal_form.ellipticity(*jets)
    rotation, distances = without_resonance(linear, "Lemma 3")
    pair = setting.rounding.pair
    return {
        "rotation_angle": pair(linear.theta),
        "rotation_number": pair(rotation),
        "resonance_distances": {name: pair(value) for name, value in distances.items()},
    }


def without_resonance(linear: Ellipticity, step: str) -> tuple[Ball, dict[str, Ball]]:
    """Return the rotation number, and its distances to the resonances; raise with the ``step``."""
    rotation = normal_form.rotation_number(linear)
    distances = {name: abs(rotation - interval.ball(p)) for name, p in RESONANCES.items()}
    for name, distance in distances.items():
        if not distance > 0:
            sets = {"rotation number": rotation}
            raise NotProved(step, f"the rotation number may be {name}", sets)
    return rotation, distances


def lemma_4_twist(setting: Setting, jets: tuple[Jet, Jet]) -> dict[str, Any]:
    """*Statement.* τ_1 lies in an explicit interval without zero.

    *Computed.* The Birkhoff normal form of the jet of Φ at P*.  The real parts of its resonant
    coefficients vanish, because Φ preserves area: their enclosures are checked to contain zero.
    """
    first, *higher = normal_form.twists(*jets)
    if not (first > 0 or first < 0):
        raise NotProved("Lemma 4", "the twist coefficient may vanish", {"tau_1": first})
    pair, unit = setting.rounding.pair, 1 / setting.units.area
    return {
        "twist": pair(first, unit),
        "twist_action": pair(2 * first, unit),
        "higher_twists": [pair(tau, unit**k) for k, tau in enumerate(higher, start=2)],
    }


def taylor_claims(setting: Setting, jets: tuple[Jet, Jet]) -> dict[str, dict[str, list[str]]]:
    """Return the Taylor coefficients of degree two and more of both components of Φ at P*."""
    units, pair = setting.units, setting.rounding.pair
    return {
        name: {
            f"{i},{j}": pair(jet[i, j], unit / units.length**i / units.speed**j)
            for i, j in jet.space.exponents
            if i + j >= 2
        }
        for name, jet, unit in zip("xv", jets, (units.length, units.speed), strict=True)
    }


def lemma_5_remainder(
    osc: Oscillator[Any], point: FixedPoint, around: Neighbourhood, jets: tuple[Jet, Jet]
) -> dict[str, str]:
    """*Statement.* On an explicit disk around P*, inside the box, each component of Φ is within
    an explicit distance of its Taylor polynomial at P*.

    *Computed.* Φ as a Taylor model on a square around the disk, with P* anywhere in its enclosure:
    its remainder, plus what separates its polynomial from the Taylor polynomial.  Twice this is
    claimed, since the checker's bound, in Lagrange's form, is looser.  The disk lies in the
    box, because its radius is a quarter of the box's least half-width.
    """
    radius = interval.short(min(around.reach) / 4)
    domain = Domain((interval.ball(radius), interval.ball(radius)), jets[0].space.order)
    x, v = domain.variables(point.box)
    end = strobe(osc, (x, v), around.expected, TAYLOR_MODELS).end
    bounds = [
        certificate.bound(abs((model - TaylorModel(domain, jet, Ball(0))).bound()) * 2)
        for model, jet in zip(end, jets, strict=True)
    ]
    return {
        "degree": str(jets[0].space.order),
        "radius": interval.exact_decimal(radius),
        "x": bounds[0],
        "v": bounds[1],
    }
