"""Orbits that hit each wall once a period and never stop, at ω = 1 and R = 2."""

from dataclasses import dataclass
from fractions import Fraction

from cap.audit.means.need import need
from cap.one_one.closed_form import symmetric
from cap.parameters import PAPER
from cap.proofs.census import census
from cap.sets import interval
from cap.sets.interval import Ball


@dataclass(frozen=True)
class Orbit:
    """Its name in the census, and its type; speeds are in units of F."""

    name: str
    kind: str
    trace: Ball
    least_speed: Ball


@dataclass(frozen=True)
class Symmetric:
    """The trace of Φ', and of the derivative over half a period; |cos ωt| at both hits."""

    trace: Ball
    half_trace: Ball
    cosine: Ball


def elliptic_orbit(F: Fraction, f: Fraction = PAPER.f) -> Orbit:
    """Return the elliptic one of all these orbits, which is one only or one pair."""
    found = [each for each in census(f / F, PAPER.R / F) if each.kind == "elliptic"]
    need(len(found) == 1, f"there is not one elliptic orbit at F = {F}", found=len(found))
    need(found[0].least_speed > 0, f"at F = {F} the orbit may stop")
    return Orbit(*found[0])


def symmetric_orbit(F: Fraction, f: Fraction = PAPER.f, sign: int = 1) -> Symmetric:
    """Return the symmetric orbit ``plus``, or for the sign -1 ``minus``, from its closed form."""
    orbit = symmetric(interval.ball(f / F), interval.ball(PAPER.R / F), int(sign))
    need(orbit.least_speed() > 0, "the orbit may stop")
    k = 2 * interval.pi() ** 2 * orbit.S / (orbit.rho + 2 * orbit.S)
    first, second = (abs(cosine) for _, cosine in orbit.phases)
    return Symmetric(orbit.trace(), 2 - k, interval.hull(first, second))
