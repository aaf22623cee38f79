"""Section 4.4: Φ' along the branch, Table 1, and the approach to the impulse bound."""

from fractions import Fraction

from cap.audit.means.algebra import enclosure, symbols
from cap.audit.means.balls import between, precisely
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.steps import Words
from cap.one_one.closed_form import symmetric
from cap.proofs.census import Member, census
from cap.sets import interval
from cap.sets.interval import Ball

FRICTION, GAP = Fraction(2, 5), Fraction(2)  # f and R of Figure 3, with ω = 1


def elliptic_at(F: Fraction, f: Fraction = FRICTION) -> Member:
    """Return the elliptic orbit with one hit of each wall, which is one only or one pair."""
    found = [each for each in census(f / F, GAP / F) if each.kind == "elliptic"]
    need(len(found) == 1, f"there is not one elliptic orbit at F = {F}", found=len(found))
    return found[0]


def elliptic_orbits(orbits: dict[str, str], *, f: str = str(FRICTION)) -> Words:
    """At each F the elliptic orbit has this name, and never stops; words are on the last."""
    words = {}
    for F, name in orbits.items():
        orbit = elliptic_at(Fraction(F), Fraction(f))
        need(orbit.name == name, f"at F = {F} the orbit is another", name=orbit.name)
        need(orbit.least_speed > 0, f"at F = {F} the orbit may stop")
        words = {"trace": between(orbit.trace, 6), "least_speed": between(orbit.least_speed, 6)}
    return words


def smooth_rotation_number() -> Words:
    F, f, R = symbols("F f R")
    S = 2 * (R / F) / (sp.pi**2 - 4)  # of the pitchfork
    born = sp.solve((sp.pi * f / (2 * F)) ** 2 + S**2 - 1, F)
    point = {f: FRICTION, R: GAP}
    with precisely():
        at = enclosure(born[0], point)
        before, after = (elliptic_at(Fraction(n, 1000)) for n in (928, 926))
        need(Fraction(926, 1000).numerator < 1000 * at < 928, "the pitchfork is elsewhere", at=at)
        need(before.name == "pair" and after.name == "plus", "the orbits are others")
        traces = [between(each.trace, 3) for each in (before, after)]
    return {"words": at, "traces": traces[0], "traces_2": traces[1]}


def resonances_on_the_way() -> None:
    with precisely():
        first, last = (elliptic_at(Fraction(n, 1000)) for n in (1000, 940))
        need(first.trace < 0 < last.trace, "the trace does not pass 0 on the pair")
        half = [_half_trace(Fraction(n, 1000)) for n in (900, 630)]
        need(half[0] < -1 and half[1] > 1, "the half trace does not pass -1, 0 and 1", half=half)


def _half_trace(F: Fraction) -> Ball:
    """Return the trace 2 - k of the half-period map at the symmetric orbit `plus`."""
    orbit = symmetric(interval.ball(FRICTION / F), interval.ball(GAP / F), 1)
    need(orbit.least_speed() > 0, "the orbit may stop")
    k = 2 * interval.pi() ** 2 * orbit.S / (orbit.rho + 2 * orbit.S)
    half: Ball = 2 - k
    return half
