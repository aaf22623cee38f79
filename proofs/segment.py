"""Theorem (segment).  Let f > 0.  Consider the T-periodic orbits of

    x'' = F cos ωt - f sgn x' - μ x',   l < x < r,   T = 2π/ω,

that touch no wall (so it does not matter what the walls do).

 (i)   Their velocity is one function v*, v*(t + T/2) = -v*(t).  It turns, without sticking, if and
       only if c = F cos ωt0 > f, where ωt0 = -arcsin(f h/((1 + D) A)) - arctan(μ/ω), D =
       exp(-μT/2), h = (1 - D)/μ, A = F/sqrt(ω² + μ²); then it turns right at t0 and left at t0 +
       T/2.  For μ = 0 this is sin ωt0 = -πf/(2F), f/F < 2/sqrt(4 + π²), and the stroke is 2c/ω².
 (ii)  If it turns and its stroke is less than R, there is one orbit for each x(0) in an open
       interval (left, right): a segment of fixed points of Φ, (x, v*(0)), which are not isolated.
       The multipliers are 1 and exp(-μT) ((c - f)/(c + f))².
 (iii) Let D(U) = a1 U + a2 U² with a1, a2 of `drift`.  The orbits from (x, v*(0) + u), |u| < d,
       left < x, x + D(u) < right for u >= 0, left < x - D(-u), x < right for u <= 0, touch no wall
       and tend to orbits of the segment.

Proof.  Two solutions of v' = F cos ωt - μv - f sgn v come no farther apart, and v* passes through
zero, so there is one periodic one, and the flight from t0 in closed form is half of it: (i), (ii).
Where v* and v = v* + u have opposite signs |u|' <= -2f.  As |v*|' <= F - f after its turns, and >=
-(F + f) - μ|v*| before them, each passage of v through zero beside v* multiplies |u| by at most κ =
(F - f)/(F + f); sum the series.  The module cap.checker.theorems.segment has all details.

If c <= f the orbits that touch no wall stick: this theorem does not speak of them.
"""

from fractions import Fraction
from typing import Any, NamedTuple

from cap.certificate.writer import Pair
from cap.errors import BadInput, NotProved, TooFewDigits
from cap.floats import candidates
from cap.flow.model import Oscillator
from cap.flow.strobe import oscillator
from cap.parameters import Parameters
from cap.proofs.fixed_point import Proof, Setting, settled
from cap.sets import interval
from cap.sets.interval import Ball

SUMMARY = "T-periodic orbits that touch no wall: a segment of them, and an open set it attracts"
GROUP = "family"
SEARCH = candidates.closed_form
PLACES = 8  # of the numbers that describe the basin


class Velocity(NamedTuple):
    """The periodic velocity: t0, c, v*(0), the way from t0 to 0, and the stroke."""

    start: Ball
    force: Ball
    v: Ball
    below: Ball
    stroke: Ball


def prove(setting: Setting) -> Proof:
    """Prove the theorem; there is no box whose size is left to choose."""
    if not setting.parameters.f:
        raise BadInput("the theorem segment needs friction: f > 0")
    with interval.workprec(setting.bits):
        osc = oscillator(setting.parameters)
        velocity = lemma_1_velocity(osc, setting.parameters)
        claims = lemma_2_segment(osc, setting, velocity)
        claims |= lemma_3_basin(osc, setting, velocity, claims)
    hints = {"bits": str(setting.checker_bits)}
    strings = setting.parameters.strings()
    return settled("segment", setting, strings, (claims, hints))


def lemma_1_velocity(osc: Oscillator[Ball], p: Parameters) -> Velocity:
    """*Statement.* v* turns twice in a period and never sticks.  *Computed.* c - f > 0.

    Raises `BadInput` if it sticks.
    """
    half = osc.T / 2
    decay, h = (osc.relax(osc.mu, half)[:2]) if osc.viscous else (Ball(1), half)
    size = (osc.omega * osc.omega + osc.mu * osc.mu).sqrt()
    sine = osc.f * h * size / ((1 + decay) * osc.F)
    if not sine < 1:
        raise _none(p, certain=bool(sine > 1))
    start = -(sine.asin() + (osc.mu / osc.omega).atan()) / osc.omega
    at = osc.moment(start)
    force = osc.forcing(at)
    if not force > osc.f:
        raise _none(p, certain=bool(force < osc.f))
    flight, now = osc.launch(1, at, Ball(0), Ball(0)), osc.moment(Ball(0))
    stroke = osc.position(flight, osc.moment(start + half))
    return Velocity(start, force, osc.velocity(flight, now), osc.position(flight, now), stroke)


def _none(p: Parameters, *, certain: bool) -> BadInput | NotProved:
    """Return what is said where v* sticks, or may stick."""
    ratio = p.f / p.F
    if not certain:
        reason = "whether T-periodic orbits that touch no wall turn or stick is undecided"
        return NotProved("Lemma 1", reason, {"f/F": ratio})
    if p.mu:
        return BadInput("at these parameters the T-periodic orbits that touch no wall stick")
    return BadInput(
        "T-periodic orbits that touch no wall stick unless f/F < 2/sqrt(4 + pi^2) = 0.537029..: "
        f"f/F = {ratio}"
    )


def lemma_2_segment(osc: Oscillator[Ball], setting: Setting, found: Velocity) -> dict[str, Any]:
    """*Statement.* The segment, the turns, the multipliers.  *Computed.* The stroke is below R.

    Raises `BadInput` if it is above R.
    """
    pair, units = setting.rounding.pair, setting.units
    left, right = osc.l + found.below, osc.r - (found.stroke - found.below)
    if found.stroke > osc.r - osc.l:
        raise BadInput(
            "all T-periodic orbits touch a wall: without walls their stroke is "
            f"{float(found.stroke):.10g}, and r - l = {setting.parameters.R}"
        )
    if not left < right:
        sets = {"stroke": found.stroke, "R": osc.r - osc.l}
        raise NotProved("Lemma 2", "the stroke of an orbit without hits may not fit", sets)
    factor = (found.force - osc.f) / (found.force + osc.f)
    multiplier = factor * factor * (-osc.mu * osc.T).exp()
    return {
        "left": pair(left, units.length),
        "right": pair(right, units.length),
        "v": pair(found.v, units.speed),
        "stroke": pair(found.stroke, units.length),
        "turning_times": [pair(found.start + osc.T * n / 2, units.time) for n in (1, 2)],
        "multipliers": [["1", "1"], pair(multiplier)],
    }


def lemma_3_basin(
    osc: Oscillator[Ball], setting: Setting, found: Velocity, claims: dict[str, Any]
) -> dict[str, Any]:
    """*Statement.* The open set of (iii), with its area.

    *Computed.* D(d) <= right - left.
    """
    length = interval.ball(Fraction(claims["right"][0]) - Fraction(claims["left"][1]))
    if not length > 0:
        raise TooFewDigits("Lemma 3", "the length of the segment is not certain", {"at": length})
    drift = drift_of(osc, claims["turning_times"][0])
    speed = drift.speed(length)
    (a, b), U = drift.balls, interval.ball(speed)
    L = osc.r - osc.l - found.stroke
    area = 2 * (L * U - a * U**2 / 2 - b * U**3 / 3)
    return {
        "basin": {"speed": interval.exact_decimal(speed), "drift": drift.strings},
        "basin_area": setting.rounding.pair(area, setting.units.area),
    }


class Drift(NamedTuple):
    """Numbers a, b of few digits: D(U) <= a U + b U² for U < d, if d is below the ``bounds``."""

    first: Fraction
    second: Fraction
    bounds: tuple[Ball, Ball]

    @property
    def strings(self) -> list[str]:
        """Return a and b, exactly."""
        return [interval.exact_decimal(q) for q in (self.first, self.second)]

    @property
    def balls(self) -> tuple[Ball, Ball]:
        """Return enclosures of a and b."""
        return interval.ball(self.first), interval.ball(self.second)

    def speed(self, room: Ball) -> Fraction:
        """Return a number d of few digits, below the bounds, for which D(d) is below ``room``."""
        a, b = self.balls
        largest = 2 * room / (a + (a * a + 4 * b * room).sqrt())
        return _below(min(interval.ends(bound)[0] for bound in (*self.bounds, largest)))


def drift_of(osc: Oscillator[Ball], turn_left: Pair) -> Drift:
    """Return the bound D of (iii): d <= T (F + f)²/(4F), d <= t1 (F + f), t1 the turn left.

    It holds for all t1 of the enclosure claimed.
    """
    turn, T = interval.hull(*(interval.ball(Fraction(end)) for end in turn_left)), osc.T
    kappa = (osc.F - osc.f) / (osc.F + osc.f)
    first = _above(turn + T * (osc.F - osc.f) / (4 * osc.f))
    second = _above(osc.f / ((osc.F + osc.f) ** 2 * (1 - kappa**4)))
    bounds = T * (osc.F + osc.f) ** 2 / (4 * osc.F), turn * (osc.F + osc.f)
    return Drift(first, second, bounds)


def _above(x: Ball) -> Fraction:
    """Return a number of few digits above a positive ball."""
    lower, upper = interval.ends(x)
    return upper + _last_place(lower) - upper % _last_place(lower)


def _below(q: Fraction) -> Fraction:
    """Return a number of few digits below a positive one."""
    return q - q % _last_place(q) - _last_place(q)


def _last_place(q: Fraction) -> Fraction:
    """Return the place of the last digit kept."""
    return Fraction(10) ** (interval.decade(q) - PLACES)
