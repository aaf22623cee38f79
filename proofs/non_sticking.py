"""Lemmas shared by the theorems on non-sticking T-periodic orbits.

Let Φ be the stroboscopic map of x'' = F cos ωt - f sgn x', l < x < r, with elastic walls.
"""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from cap import certificate, fixed_point, interval, matrix
from cap.certificate import Rounding, Units
from cap.errors import NotProved
from cap.fixed_point import FixedPoint, Neighbourhood, Start
from cap.flow import oscillator
from cap.interval import Ball
from cap.model import Oscillator
from cap.parameters import Parameters

KRAWCZYK = {
    "theorem": "Krawczyk",
    "reference": "Neumaier, Interval Methods for Systems of Equations, 1990, Section 5.1",
    "hypotheses": [
        {
            "name": "smooth",
            "statement": "Phi is continuously differentiable on the box: all hits are transverse "
            "and no velocity vanishes",
            "by": ["box"],
        },
        {"name": "inclusion", "statement": "K(box) lies in the interior of the box", "by": ["box"]},
    ],
}


@dataclass(frozen=True)
class Setting:
    """The parameters of a theorem, the guess that it starts from, and how sharp it is to be.

    ``digits`` are claimed, ``guard`` more are computed.  ``order`` is the odd order to which Φ is
    expanded, where it is.  ``margin`` < 1 is the part of the largest neighbourhood found that is
    claimed, so that a looser arithmetic can follow.
    """

    parameters: Parameters
    start: Start
    digits: int
    order: int = 3
    guard: int = 15
    margin: Fraction = Fraction(9, 10)

    @property
    def units(self) -> Units:
        """The natural units."""
        return Units.of(self.parameters)

    @property
    def rounding(self) -> Rounding:
        """How claims are rounded."""
        return Rounding(self.digits)

    @property
    def scale(self) -> tuple[Fraction, Fraction]:
        """The natural units of the state (x, v)."""
        return self.units.length, self.units.speed

    @property
    def precise(self) -> int:
        """Digits of the fixed point that are computed, relative to the natural units."""
        return self.digits + self.guard

    @property
    def bits(self) -> int:
        """Working precision: what cancels are the walls' distance from 0, and F/ω², against R."""
        p = self.parameters
        large = max(abs(p.l), abs(p.r), p.F / p.omega**2) / p.R
        return bits(self.precise + max(0, interval.decade(large))) + 80

    @property
    def checker_bits(self) -> int:
        """Precision for the checker, whose rounding is absolute: the least unit decides."""
        units = self.units
        least = min(*self.scale, units.time, units.force, 1 / units.speed, 1 / units.area)
        orders = max(0, -interval.decade(least)) * self.order
        return self.bits + bits(orders) + 40


def bits(digits: int) -> int:
    """Return how many bits hold as many decimal digits, log2(10) < 10/3 each."""
    return digits * 10 // 3 + 1


def certificate_of(
    theorem: str,
    setting: Setting,
    conclude: Callable[[Oscillator[Ball], Setting, FixedPoint, Neighbourhood], dict[str, Any]],
    cited: dict[str, Any],
    more_hints: dict[str, str] | None = None,
) -> dict[str, Any]:
    """Prove Lemmas 1 and 2 and then ``conclude``, which returns claims; return the certificate.

    ``cited`` is the theorem on paper on which the conclusion rests, besides Krawczyk's.
    """
    with interval.workprec(setting.bits):
        osc = oscillator(setting.parameters)
        point = lemma_1_fixed_point(osc, setting)
        around, box = lemma_2_uniqueness(osc, setting, point)
        claims = {
            "box": box,
            **orbit_claims(osc, setting, point),
            **conclude(osc, setting, point, around),
        }
        return {
            "format": certificate.FORMAT,
            "theorem": theorem,
            "parameters": setting.parameters.strings(),
            "digits": str(setting.digits),
            "claims": claims,
            "hints": {**hints(setting, point, around), **(more_hints or {})},
            "cites": [KRAWCZYK, cited],
        }


def lemma_1_fixed_point(osc: Oscillator[Ball], setting: Setting) -> FixedPoint:
    """*Statement.* Φ has a fixed point P* near the guess; its orbit is non-sticking.

    *Computed.* A tiny rectangle S around a refined guess: the itinerary over S (each hit exists, is
    the only one in its window and transverse, and the velocity vanishes nowhere), Φ' over S by
    flights and saltation matrices, and Krawczyk's inclusion K(S) in the interior of S.
    """
    return fixed_point.prove(osc, setting.start, setting.precise, setting.scale)


def lemma_2_uniqueness(
    osc: Oscillator[Ball], setting: Setting, point: FixedPoint
) -> tuple[Neighbourhood, dict[str, Any]]:
    """*Statement.* P* is the only fixed point in an explicit box, and all orbits from the box
    are non-sticking with the same itinerary.

    *Computed.* As in Lemma 1 over Taylor models, on the largest rectangle that succeeds; the box
    is a part of it.  It contains P*, so the one fixed point of the rectangle is in the box.
    """
    largest = fixed_point.largest_neighbourhood(osc, point, setting.scale)
    reach = largest.reach[0] * setting.margin, largest.reach[1] * setting.margin
    around = fixed_point.neighbourhood(osc, point, reach)
    box = {}
    for name, centre, half, where in zip("xv", point.hint.centre, reach, point.box, strict=True):
        box[name] = _inside(centre, half)
        lower, upper = interval.ends(where)
        if not Fraction(box[name][0]) < lower <= upper < Fraction(box[name][1]):
            raise NotProved("Lemma 2", "P* may leave the box", {name: where, "box": box[name]})
    return around, box


def _inside(centre: Fraction, half: Fraction) -> list[str]:
    """Return short decimals [lower, upper] inside [centre - half, centre + half]."""
    places = max(0, 3 - interval.decade(half))
    scale = 10**places
    lower, upper = -(-(centre - half) * scale // 1), (centre + half) * scale // 1
    return [interval.decimal(Fraction(end, scale), places) for end in (lower, upper)]


def orbit_claims(osc: Oscillator[Ball], setting: Setting, point: FixedPoint) -> dict[str, Any]:
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
        "hit_times": [certificate.window(window) for window in around.windows],
    }
