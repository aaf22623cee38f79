"""Theorem (pitchfork).  Let ρ = Rω²/F < (π² - 4)/2, let the least speed at f_pf be
positive (it is for ρ > 0.70407), f_pf = (2F/π) sqrt(1 - (2ρ/(π² - 4))²).

 (i)   At f_pf the symmetric orbit plus of theorem symmetric exists, its speed is positive, and the
       half-period map σ has there a double multiplier -1.  Its trace passes -2 with positive slope
       as f grows: the orbit is a saddle for f a little below f_pf and elliptic a little above.
 (ii)  Near it the asymmetric orbits are the zeros δ != 0 of the odd function

           g(δ, α) = Wδ + (π/2) sin φ sin δ = c1(α) δ + c3(α) δ³ + ...,

       φ(δ, α) and W(δ, α) from the other two equations of `cap.one_one.closed_form`, c1 = 0 and
       dc1/dα > 0 at f_pf, and c3 > 0: so they exist for f < f_pf only, one pair ±δ, at
       f = f_pf + curvature δ² + O(δ⁴).
 (iii) Along them trace Φ' = 2 + trace_curvature δ² + O(δ⁴), trace_curvature < 0: they are elliptic
       at birth.

So this is a pitchfork of Φ, breaking the symmetry, a period doubling of σ; the paper calls it a
fold.

*Computed.* Power series in δ at δ = 0, over balls.
"""

from typing import Any

from cap.errors import BadInput, NotProved
from cap.floats import candidates
from cap.one_one.closed_form import Orbit, asymmetric, birth, friction, symmetric
from cap.proofs.fixed_point import Proof, Setting, settled
from cap.proofs.one_one import Scale, lemma_1_closed_form
from cap.sets import interval
from cap.sets.elementary import sqrt
from cap.sets.interval import Ball
from cap.sets.jet import Jet

SUMMARY = "where the pair of asymmetric orbits that never turn, one hit of each wall, is born"
GROUP = "family"
SEARCH = candidates.closed_form


def prove(setting: Setting) -> Proof:
    """Prove the theorem; there is no box whose size is left to choose."""
    lemma_1_closed_form()
    with interval.workprec(setting.bits):
        scale = Scale(setting)
        orbit = lemma_2_parabolic(scale)
        claims = {
            "f": scale.force(orbit.alpha),
            **scale.state(orbit),
            "least_speed": scale.speed(orbit.least_speed()),
            **lemma_3_branching(scale, orbit),
        }
    hints = {"bits": str(setting.checker_bits)}
    return settled("pitchfork", setting, parameters(setting), (claims, hints))


def parameters(setting: Setting) -> dict[str, str]:
    """Return the parameters without f, which the theorem determines."""
    return {k: v for k, v in setting.parameters.elastic_strings().items() if k != "f"}


def lemma_2_parabolic(scale: Scale) -> Orbit:
    """*Statement.* The symmetric orbit with k = 4 exists.

    *Computed.* Its S < 1, and its least speed is positive; `BadInput` if one of them is not.
    """
    S = birth(scale.rho)
    if S > 1:
        raise BadInput(
            "there is no pitchfork: R omega^2/F < 2.9348 is needed, and here it is "
            f"{float(scale.rho):.10g}"
        )
    if not S < 1:
        raise NotProved("Lemma 2", "there may be no pitchfork", {"R omega^2/F": scale.rho})
    alpha = friction(S)
    orbit = symmetric(alpha, scale.rho, 1)
    least = orbit.least_speed()
    if least < 0:
        raise BadInput(
            "there is no pitchfork: R omega^2/F > 0.70407 is needed, that the symmetric orbit does "
            f"not stop there, and here it is {float(scale.rho):.10g}"
        )
    if not least > 0:
        words = "at the pitchfork the symmetric orbit may stop"
        raise NotProved("Lemma 2", words, {"least speed": least})
    return orbit


def lemma_3_branching(scale: Scale, orbit: Orbit) -> dict[str, Any]:
    """*Statement.* The coefficients of g, of f and of the trace, none of which vanishes.

    *Computed.* g from its definition; f and the trace from the closed form.  With S² = 1 - (πα/2)²:
    dS/dα = -π²α/(4S), c1 = (ρ + 2S)/π - πS/2, and k = 2π²S/(ρ + 2S).
    """
    pi, S, rho = interval.pi(), orbit.S, orbit.rho
    slope_S = -pi * pi * orbit.alpha / (4 * S)
    (delta,) = Jet.variables((Ball(0),), 3)
    cubic = bifurcation(delta, orbit.alpha, rho)[(3,)]
    branch = asymmetric(delta, rho)
    numbers = {
        "half_trace_slope": -2 * pi * pi * rho / (rho + 2 * S) ** 2 * slope_S,
        "cubic": cubic,
        "linear_slope": (2 / pi - pi / 2) * slope_S,
        "curvature": branch.alpha[(2,)],
        "trace_curvature": branch.trace()[(2,)],
    }
    negative = ("curvature", "trace_curvature")
    for name, value in numbers.items():
        if not (value < 0 if name in negative else value > 0):
            raise NotProved("Lemma 3", f"the {name} may have the other sign", {name: value})
    claims = {name: scale.number(value) for name, value in numbers.items()}
    claims["half_trace_slope"] = scale.per_force(numbers["half_trace_slope"])
    claims["curvature"] = scale.force(numbers["curvature"])
    return claims


def bifurcation(delta: Jet, alpha: Ball, rho: Ball) -> Jet:
    """Return g(δ, α) = Wδ + (π/2) sin φ sin δ, with 2 cos φ cos δ = πα, sin φ < 0."""
    pi = interval.pi()
    sin, cos = delta.sin_cos()
    cos_phi = pi * alpha / 2 / cos
    S = sqrt(1 - cos_phi * cos_phi)
    W = (rho + 2 * (S * (cos + delta * sin))) / pi
    g: Jet = W * delta - pi / 2 * (S * sin)
    return g
