"""What the theorems on non-sticking T-periodic orbits share: claims, hints, the certificate.

Let Φ be the stroboscopic map of x'' = F cos ωt - f sgn x', l < x < r, with elastic walls.
"""

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from cap.certificate import writer as certificate
from cap.flow.model import Oscillator
from cap.flow.strobe import oscillator
from cap.maps.fixed_point import FixedPoint, Neighbourhood
from cap.sets import interval, matrix
from proofs.fixed_point import (
    Proof,
    Setting,
    assembled,
    largest_reach,
    lemma_1_fixed_point,
    lemma_2_uniqueness,
)


def proof_of(
    theorem: str,
    setting: Setting,
    conclude: Callable[[Oscillator[Any], Setting, FixedPoint, Neighbourhood], dict[str, Any]],
    more_hints: dict[str, str] | None = None,
) -> Proof:
    """Prove Lemma 1; return the rest: Lemma 2 and ``conclude``, which returns claims."""
    with interval.workprec(setting.bits):
        osc = oscillator(setting.parameters)
        point = lemma_1_fixed_point(osc, setting)
        reach = largest_reach(osc, setting, point)

    def certified(part: Fraction) -> dict[str, Any]:
        with interval.workprec(setting.bits):
            around, box = lemma_2_uniqueness(osc, point, (reach[0] * part, reach[1] * part))
            claims = {
                "box": box,
                **orbit_claims(osc, setting, point),
                **conclude(osc, setting, point, around),
            }
            found = claims, {**hints(setting, point, around), **(more_hints or {})}
            strings = setting.parameters.elastic_strings()
            return assembled(theorem, setting, strings, found)

    return certified


def orbit_claims(osc: Oscillator[Any], setting: Setting, point: FixedPoint) -> dict[str, Any]:
    """Return the claims on P* and its orbit, rounded outwards."""
    units, pair, orbit = setting.units, setting.rounding.pair, point.orbit
    return {
        "x": pair(point.box[0], units.length),
        "v": pair(point.box[1], units.speed),
        "hit_times": [pair(hit.time, units.time) for hit in orbit.hits],
        "hit_speeds": [pair(abs(hit.velocity), units.speed) for hit in orbit.hits],
        "hit_forcing": [pair(abs(osc.F * hit.cos) - osc.f, units.force) for hit in orbit.hits],
        "least_speed": pair(orbit.least_speed, units.speed),
        "jacobian": setting.rounding.matrix(orbit.monodromy, units),
        "trace": pair(matrix.trace(orbit.monodromy)),
        "determinant": pair(matrix.determinant(orbit.monodromy)),
    }


def hints(setting: Setting, point: FixedPoint, around: Neighbourhood) -> dict[str, Any]:
    """Return what the checker needs and does not trust."""
    c = point.hint.matrix
    return {
        "bits": str(setting.checker_bits),
        "centre": [interval.exact_decimal(value) for value in point.hint.centre],
        "radius": interval.exact_decimal(point.reach[0] / setting.units.length),
        "preconditioner": [[interval.exact_decimal(value) for value in row] for row in c],
        "hit_times": [certificate.window(event.window) for event in around.expected],
    }
