"""Theorem (symmetric).  Let 0 < f < F, ρ = Rω²/F, and consider the T-periodic orbits of

    x'' = F cos ωt - f sgn x',   l < x < r,   elastic walls,   T = 2π/ω,

whose velocity never vanishes, that hit each wall once per period, and that satisfy x(t + T/2) =
l + r - x(t).

 (i)   There are at most two, S = ±sqrt(1 - (πα/2)²), α = f/F, called plus and minus; none for α >
       2/π.  The right wall is hit at the time t1 in (0, T/2) with sin ωt1 = πα/2, cos ωt1 = S,
       with the speed U = (F/ω)(ρ + 2S)/π, the left wall half a period later.  It is an orbit if
       and only if its least speed is positive, which is U if β = arcsin α + arcsin S <= 0, and
       otherwise U - (F/ω)(sqrt(1 - α²) - πα/2 + αβ).
 (ii)  The half-period map σ, σ² = Φ, has at its fixed point the trace 2 - k, k = 2π²S/(ρ + 2S),
       and Φ has (2 - k)² - 2.  So minus, where k < 0, is a saddle.  Plus is elliptic where k < 4
       but for k = 2, a saddle where k > 4.
 (iii) The formulas meet at f = 2F/π, for all ρ; they are orbits there if ρ > 0.66135.  With ν =
       2/π - α, S² = πν - (πν/2)² and trace Φ' = 2 ∓ 8π² sqrt(πν)/ρ + O(ν): a non-degenerate
       saddle-center.  With c = 2π sqrt(2/ρ) π^(1/4) the multipliers are 1 ± cν^(1/4) + O(ν^(1/2))
       for minus, and exp(±icν^(1/4)) up to O(ν^(1/2)) for plus.
 (iv)  k = 4 for S = 2ρ/(π² - 4), if ρ < (π² - 4)/2: σ' has the double multiplier -1 there, and if
       the least speed is positive (ρ > 0.70407) asymmetric orbits branch off (theorem pitchfork).
       k = 2 for S = ρ/(π² - 2), if ρ < π² - 2: σ' has the multipliers ±i, and Φ' = -1.
 (v)   In (0, π) the equation eq:theta-eq of the paper has no root, or θ and π - θ, or π/2.  No
       root is a solution of the system.

Proof of (i) to (iv): `cap.one_one.closed_form`, derived in `cap.proofs.one_one`; the trace of an
area preserving half-period map is in (-2, 2) if 0 < k < 4.  The existence claim of (i): the speed
has one local minimum on each flight, and by symmetry they are equal.

Proof of (v).  The paper's orbit leaves the right wall at t = 0, moves left, turns at τ = θ/ω, and
"x' > 0 on (τ, T/2)", until it hits the left wall at T/2.  But whoever moves to the right arrives
at no left wall: x(T/2) = l and x' > 0 before give x < l before.  And so it is with the formulas:
eq:xpiece2 has, for every θ in (0, π),

    x'(T/2) = -(F/ω) sin θ - (f/ω)(π - θ) < 0,

so x' changes its sign on (τ, T/2), where the formula has the friction of x' > 0 throughout.  (Nor
is the reflection elastic unless θ = π/2: by the symmetry it needs x'(T/2-) = x'(0+) = -(F/ω) sin θ
- (f/ω) θ; and at θ = π/2 there is no turning, as |F cos θ| < f.)  So Theorem symmetric of the
paper describes no orbit, and its Proposition two-solutions and Theorem saddlecenter count and
continue none.

Number of roots: Ψ(θ) = Fπ sin θ - 2F - Rω² + fπ²/2 - fθ(π - θ) has Ψ(π - θ) = Ψ(θ), and on (0,
π/2) Ψ' = Fπ cos θ - f(π - 2θ) > 0, since cos θ > 1 - 2θ/π there and f < F.
"""

from fractions import Fraction
from typing import Any

from cap.certificate import NONE
from cap.errors import NotProved
from cap.floats import candidates
from cap.one_one.closed_form import Orbit, birth, friction, symmetric
from cap.proofs.fixed_point import Proof, Setting, settled
from cap.proofs.one_one import Scale, lemma_1_closed_form
from cap.sets import bisection, interval
from cap.sets.interval import Ball

SUMMARY = "symmetric orbits that never turn, one hit of each wall per period; where they bifurcate"
GROUP = "family"
SEARCH = candidates.closed_form

SIGNS = {"plus": 1, "minus": -1}


def prove(setting: Setting) -> Proof:
    """Prove the theorem; there is no box whose size is left to choose."""
    lemma_1_closed_form()
    with interval.workprec(setting.bits):
        scale = Scale(setting)
        claims = {
            "branches": {name: lemma_2_orbit(scale, name, sign) for name, sign in SIGNS.items()},
            **lemma_3_bifurcations(scale),
            "paper_roots": lemma_4_paper(scale),
        }
    hints = {"bits": str(setting.checker_bits)}
    parameters = setting.parameters.elastic_strings()
    return settled("symmetric", setting, parameters, (claims, hints))


def lemma_2_orbit(scale: Scale, name: str, sign: int) -> dict[str, Any] | str:
    """*Statement.* The symmetric orbit of this sign exists, with these numbers; or it does not.

    *Computed.* The formulas, and the sign of the least speed.
    """
    p = scale.p
    alpha = interval.ball(p.f / p.F)
    bound = 2 / interval.pi()
    if alpha > bound:
        return NONE
    if not alpha < bound:
        raise NotProved("Lemma 2", "f may be 2F/pi", {"f/F": alpha})
    orbit = symmetric(alpha, scale.rho, sign)
    if orbit.mean_speed < 0:
        return NONE
    least = orbit.least_speed()
    claims: dict[str, Any] = {
        "hit_speed": scale.speed(orbit.mean_speed),
        "least_speed": scale.speed(least),
    }
    if least < 0:
        return {"genuine": "no", **claims}
    if not least > 0:
        raise NotProved("Lemma 2", f"the least speed of {name} may vanish", {"speed": least})
    half = 2 - k_of(orbit)
    trace = half * half - 2
    return {
        "genuine": "yes",
        **scale.state(orbit),
        **claims,
        "half_trace": scale.number(half),
        "trace": scale.number(trace),
        "type": type_of(half),
    }


def k_of(orbit: Orbit) -> Ball:
    """Return k = 2π²S/(ρ + 2S)."""
    k: Ball = 2 * interval.pi() ** 2 * orbit.S / (orbit.rho + 2 * orbit.S)
    return k


def type_of(half: Ball) -> str:
    """Return the type from the trace of the half-period map."""
    if 0 < abs(half) < 2:
        return "elliptic"
    if half > 2 or half < -2:
        return "saddle"
    raise NotProved("Lemma 2", "the orbit may be parabolic", {"trace of the half map": half})


def lemma_3_bifurcations(scale: Scale) -> dict[str, Any]:
    """*Statement.* The values of f at which the orbits meet, and at which k = 4 and k = 2."""
    return {
        "saddle_center": scale.force(2 / interval.pi()),
        "pitchfork": _critical(scale, birth(scale.rho)),
        "minus_identity": _critical(scale, scale.rho / (interval.pi() ** 2 - 2)),
    }


def _critical(scale: Scale, S: Ball) -> Any:
    """Return the claim on f = (2F/π) sqrt(1 - S²), or that there is none, if S > 1."""
    if S > 1:
        return NONE
    if not S < 1:
        raise NotProved("Lemma 3", "a bifurcation may lie at f = 0", {"S": S})
    return scale.force(friction(S))


def lemma_4_paper(scale: Scale) -> list[dict[str, Any]]:
    """*Statement.* The roots of the paper's equation, and x'(T/2-) there, which is negative.

    *Computed.* Ψ increases on (0, π/2): signs at the ends of a short interval enclose its root.
    """
    pi, alpha = interval.pi(), interval.ball(scale.p.f / scale.p.F)

    def psi(theta: Ball) -> Ball:
        return pi * theta.sin() - 2 - scale.rho + alpha * (pi * pi / 2 - theta * (pi - theta))

    if psi(pi / 2) < 0 or psi(Ball(0)) >= 0:
        return []
    ends = bisection.crossing(
        lambda q: -psi(interval.ball(q)), Fraction(0), Fraction(157, 100), scale.setting.precise
    )
    theta = interval.hull(*map(interval.ball, ends))
    return [
        {
            "theta": scale.number(root),
            "velocity": scale.speed(-root.sin() - alpha * (pi - root)),
        }
        for root in (theta, pi - theta)
    ]
