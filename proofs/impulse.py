"""Theorem (impulse).  Let f > 2F/π, δ = f - 2F/π, and consider any motion of

    x'' = F cos ωt - f sgn x' - μ x',   l < x < r,   v -> -e v at the walls,   0 < e <= 1, μ >= 0.

Let h = sqrt(π² - 4) - 2 arccos(2/π) = 0.661...

 (i)   From every state (x, v), at every time, the mass comes to rest within any time longer than
       D + B |v|, where B = 1/δ and D = (2h/π) F/(ωδ): its velocity is zero on an interval of time.
 (ii)  So there is no motion whose velocity never vanishes: Ω_NS is empty.
 (iii) The bound 2F/π is sharp: for f = 2F/π, e = 1, μ = 0 and walls farther apart than hF/ω² there
       is a motion of period T = 2π/ω whose velocity never vanishes, with one hit of each wall per
       period.  For such walls 2F/π is the largest f at which Ω_NS is not empty.

Proof of (i), by the momentum of the lift: u = |v| hardly knows the walls.  Let Z be the set of the
times in [t, t + τ] at which v = 0.  Elsewhere u' = s F cos ωt - f - μu <= F |cos ωt| - f, s the
sign of v, and at a hit u does not grow; without a zero of v the walls are hit alternately, so not
infinitely often.  Consider the intervals of which [t, t + τ] without Z consists, and the integral
of F |cos ωt| - f over each.  Between two times of Z u goes from 0 to 0, so there it is not
negative; nor is it on the last interval, from 0 to some u >= 0.  On the first, where u begins with
|v|, it is at least -|v|.  If Z has the measure 0, the sum of all is (Lemma 2)

    -|v| <= ∫ (F |cos ωt| - f) dt <= (2h/π) F/ω - δτ,      over [t, t + τ]:    τ <= D + B |v|.

So for longer τ the measure of Z is positive.  At a time of Z the mass stays at rest for a while if
|F cos ωt| < f, or if it is at a wall and the force presses it there.  If not, either |F cos ωt| =
f, or v is not 0 just after: such times of Z are countably many.  So Z contains an interval.

Proof of (iii).  For |ωt| <= π/2 let v = Rω/π + (F/ω) H(ωt), H(θ) = sin θ - 2θ/π, R = r - l.  Then
v' = F cos ωt - 2F/π, and v leads from l to r, since H is odd.  H(±π/2) = 0: so after an elastic hit
the mirror image, x -> l + r - x and t -> t + T/2, follows, and after that the motion itself.  As H
>= -h/π (Lemma 2), v > 0 if R > hF/ω².
"""

from fractions import Fraction
from typing import Any

from cap.errors import BadInput, NotProved, TooFewDigits
from cap.floats import candidates
from cap.proofs.fixed_point import Proof, Setting, bits, settled
from cap.sets import interval
from cap.sets.interval import Ball

SUMMARY = "for f > 2F/pi every motion comes to rest, within an explicit time; 2F/pi is sharp"
GROUP = "states"
SEARCH = candidates.every_motion


def prove(setting: Setting) -> Proof:
    """Prove the theorem; there is no box whose size is left to choose."""
    p, pair = setting.parameters, setting.rounding.loosely
    with interval.workprec(setting.bits):
        margin, h = lemma_1_margin(setting), lemma_2_excess()
        F, omega = interval.ball(p.F), interval.ball(p.omega)
        units, delay = setting.units, 2 * h / interval.pi() * F / (omega * margin)
        claims = {
            "margin": pair(margin, units.force),
            "delay": pair(delay, units.time),
            "delay_per_speed": pair(1 / margin, 1 / units.force),
            "gap": pair(h * F / omega**2, p.F / p.omega**2),
        }
    if not Fraction(claims["margin"][0]) > 0:
        raise NotProved("Lemma 1", "the digits claimed do not tell f from 2F/pi: claim more")
    return settled("impulse", setting, p.strings(), (claims, _hints(setting)))


def lemma_1_margin(setting: Setting) -> Ball:
    """*Statement.* δ = f - 2F/π is positive; `BadInput` if it is negative."""
    p = setting.parameters
    alpha, bound = interval.ball(p.f / p.F), 2 / interval.pi()
    if alpha < bound:
        raise BadInput(f"the theorem impulse is about f/F > 2/pi = 0.636619..: f/F = {p.f / p.F}")
    if not alpha > bound:
        sets = {"f/F": alpha, "2/pi": bound}
        raise TooFewDigits("Lemma 1", "f is too near to 2F/pi: claim more digits", sets)
    return (alpha - bound) * interval.ball(p.F)


def lemma_2_excess() -> Ball:
    """*Statement.* |H| <= h/π, H(θ) = ∫ (|cos| - 2/π) from 0 to θ; so ∫ over [θ, θ'] <= 2h/π.

    *Computed.* The mean of |cos| is 2/π, so H has the period π; it is odd, and sin θ - 2θ/π for
    |θ| <= π/2, where H' = 0 at cos θ = 2/π: its extremes are ±h/π.
    """
    pi = interval.pi()
    return (pi * pi - 4).sqrt() - 2 * (2 / pi).acos()


def _hints(setting: Setting) -> dict[str, Any]:
    """Return the precision at which the checker, whose rounding is absolute, has all digits."""
    p = setting.parameters
    least = min(p.F, 1 / p.F, 1 / p.omega, p.F / p.omega**2)
    places = max(0, -interval.decade(least))
    return {"bits": str(setting.checker_bits + bits(places))}
