"""Theorem (sliding).  Let f > 0, two masses m_1, m_2, and consider the T-periodic orbits of

    m_i x_i'' = F cos ωt - f sgn x_i',   l < x_1 < x_2 < r,   T = 2π/ω,

on which they touch neither a wall nor each other (so it does not matter what happens then).

 (i)   m_i x_i' is the velocity v* of `cap.proofs.segment` for both.  It exists if and only if f/F <
       2/sqrt(4 + π²); both masses turn at the same times, and never stick.
 (ii)  There is one orbit for each (x_1, x_2) in an open triangle x_1 > left, x_2 - x_1 > gap, x_2 <
       right, if that is not empty: fixed points of the time-T map, not isolated, with the
       multipliers 1, twice, and ((c - f)/(c + f))², twice, c = F |cos ωt| at the turns.
 (iii) An explicit open set of states around these tends to them.

Proof.  While nothing is touched each momentum obeys the equation of a mass 1, and x_i moves as the
integral of v*, by 1/m_i: the distance x_2 - x_1 as (1/m_2 - 1/m_1) times it.  Momenta beside v*
tend to it, with an integral that `cap.proofs.segment` bounds.  The module
cap.checker.theorems.sliding has all details.
"""

from fractions import Fraction
from typing import Any

from cap.errors import BadInput, NotProved
from cap.floats import candidates
from cap.flow.model import Oscillator
from cap.flow.strobe import oscillator
from cap.proofs.fixed_point import Proof, Setting, settled
from cap.proofs.options import OF_MASSES
from cap.proofs.particle_orbit import system
from cap.proofs.segment import Drift, Velocity, drift_of, lemma_1_velocity
from cap.sets import interval
from cap.sets.interval import Ball

SUMMARY = "they touch nothing: a triangle of T-periodic orbits, an open set it attracts"
GROUP = "masses"
SEARCH = candidates.touching_nothing
OPTIONS = OF_MASSES


def prove(setting: Setting) -> Proof:
    """Prove the theorem; there is no box whose size is left to choose."""
    if not setting.parameters.f:
        raise BadInput("the theorem sliding needs friction: f > 0")
    guess, strings = system("sliding", setting)
    with interval.workprec(setting.bits):
        osc = oscillator(setting.parameters)
        shares = [1 / m for m in guess.masses]
        velocity = lemma_1_velocity(osc, setting.parameters)
        side, claims = lemma_2_triangle(osc, setting, velocity, shares)
        drift = drift_of(osc, claims["turning_times"][0])
        claims |= lemma_3_basin(setting, drift, side, shares)
    hints = {"bits": str(setting.checker_bits)}
    return settled("sliding", setting, strings, (claims, hints))


def lemma_2_triangle(
    osc: Oscillator[Ball], setting: Setting, found: Velocity, shares: list[Fraction]
) -> tuple[Ball, dict[str, Any]]:
    """*Statement.* The triangle, the turns, the multiplier.  *Computed.* Its side L is positive.

    Raises `BadInput` if it is negative.
    """
    pair, units = setting.rounding.pair, setting.units
    above, q = found.stroke - found.below, shares[1] - shares[0]
    gap = interval.ball(abs(q)) * (found.below if q > 0 else above)
    first, second = map(interval.ball, shares)
    left, right = osc.l + first * found.below, osc.r - second * above
    side = right - left - gap
    room = osc.r - osc.l - side
    if side < 0:
        raise BadInput(
            "two masses that slide freely do not fit between the walls: their strokes and the gap "
            f"take {float(room):.10g}, and r - l = {setting.parameters.R}"
        )
    if not side > 0:
        sets = {"least room for strokes and gap": room, "R": osc.r - osc.l}
        raise NotProved("Lemma 2", "two masses that slide freely may not fit", sets)
    factor = (found.force - osc.f) / (found.force + osc.f)
    return side, {
        "v": [pair(found.v * share, units.speed) for share in (first, second)],
        "strokes": [pair(found.stroke * share, units.length) for share in (first, second)],
        "turning_times": [pair(found.start + osc.T * n / 2, units.time) for n in (1, 2)],
        "places": {
            "left": pair(left, units.length),
            "gap": pair(gap, units.length),
            "right": pair(right, units.length),
        },
        "places_area": pair(side * side / 2, units.length**2),
        "multiplier": pair(factor * factor),
    }


def lemma_3_basin(
    setting: Setting, drift: Drift, L: Ball, shares: list[Fraction]
) -> dict[str, Any]:
    """*Statement.* The open set of (iii), with its volume.  *Computed.* D(d) (Σ 1/m_i) <= L."""
    sums = sum(shares), sum(s * s for s in shares), shares[0] * shares[1]
    first, second, product = (interval.ball(Fraction(q)) for q in sums)
    speed = drift.speed(L / first)
    (a, b), d = drift.balls, interval.ball(speed)
    I_1 = a * d**2 / 2 + b * d**3 / 3
    I_2 = a**2 * d**3 / 3 + a * b * d**4 / 2 + b**2 * d**5 / 5
    mean = L**2 * d**2 - 2 * L * d * I_1 * first + d * I_2 * second + 2 * I_1**2 * product
    volume = setting.rounding.pair(2 * product * mean, setting.units.area**2)
    if not Fraction(volume[0]) > 0:
        sets = {"volume": 2 * product * mean}
        raise NotProved("Lemma 3", "the volume of the open set is below the digits claimed", sets)
    return {
        "basin": {"speed": interval.exact_decimal(speed), "drift": drift.strings},
        "basin_volume": volume,
    }
