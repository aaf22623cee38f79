"""Section 3.2: Proposition 3.2, the lift of never-stopping orbits and its converse."""

from fractions import Fraction

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import formula, identity, symbols
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.papers.mixed_dynamics.claims.cover import wave
from cap.audit.verdict import Verdict, confirmed, corrected


@claim("thm:lift", Kind.THEOREM, stated="a lift exists, with p > 0")
def lift_exists() -> Verdict:
    """Every never-stopping orbit has a lift q with q' = p > 0, x = R W(q) + l, solving eq:Heq."""
    t, F, f, R, w = symbols("t F f R omega")
    force = F * sp.cos(w * t)
    for sigma in (1, -1):
        x_second = force - sigma * f  # sgn x' = σ
        identity("q'' = σ x''/R solves eq:Heq", x_second / (R * sigma), force * sigma / R - f / R)
    u = symbols("u")
    after = -u  # the velocity after a hit of r with the speed u
    identity("q' is continuous at a hit", u / R, (-1) * after / R)
    return confirmed("as stated", "Both branches, symbolically; q' = |x'|/R is continuous at hits.")


@claim("thm:lift", Kind.STEP, stated="q ranges over (q₀, q₀ + R R⁻¹ (r - x(t₀)))")
def range_of_the_first_piece() -> Verdict:
    """On the first piece q ranges over (q₀, q₀ + R R⁻¹ (r - x(t₀)))."""
    R, way = symbols("R way")  # way = r - x(t₀)
    return formula(
        way / R,
        R / R * way,
        "q - q₀ = (x - x(t₀))/R at x = r. The next line of the proof has it right; and t₀ is the "
        "start, no hit, or else q₀ would be an even integer.",
        "(q₀, q₀ + (r - x(t₀))/R), which ends at 2k₀ + 1",
    )


@claim("thm:lift", Kind.THEOREM, stated="unique up to the choice of q(0) in π⁻¹(x(0))")
def lift_is_unique() -> Verdict:
    """The lift is unique up to the choice of q(0) in the fibre π⁻¹(x(0))."""
    half, other = Fraction(1, 2), Fraction(3, 2)
    need(wave(half) == wave(other), "they are not in the same fibre")
    step = Fraction(1, 10)
    need(wave(half + step) > wave(half), "q growing from 1/2 does not move right")
    need(wave(other + step) < wave(other), "q growing from 3/2 does not move left")
    return corrected(
        "only half of the fibre will do, q(0) with W'(q(0)) = sgn x'(0): the lift is unique up to "
        "even integers",
        "1/2 and 3/2 lie in one fibre; as q grows W rises from the one and falls from the other. "
        "The proof has the even integers, and then says 'an integer shift'.",
    )


@claim("thm:lift", Kind.THEOREM, stated="any strictly increasing q projects to such an x")
def converse() -> Verdict:
    """If q is any strictly increasing solution of eq:Heq, then R W(q) + l never stops."""
    t, F, w, a = symbols("t F omega a")  # f = F cos a; p vanishes at ωt = -a, on a branch W' = 1
    s = sp.Symbol("s", real=True)
    p = sp.integrate(F * sp.cos(w * t) - F * sp.cos(a), (t, -a / w, -a / w + s))
    series = [sp.simplify(sp.diff(p, s, k).subs(s, 0)) for k in range(3)]
    need(series[0] == 0 and series[1] == 0, "p does not touch zero")
    identity("p = F ω sin(a) s²/2 + ..", series[2], F * w * sp.sin(a))
    return corrected(
        "p > 0 must be asked for: a strictly increasing q may have p = 0 at a time, where x stops",
        "The solution with p = 0 where cos ωt rises through f/F has p = Fω sin(arccos(f/F)) "
        "s²/(2R) > 0 on both sides.",
    )


@claim("thm:lift", Kind.FORMULA, stated="x'(t*+) = R (-1)^(k+1) q', x'(t*-) = R (-1)^k q'")
def signs_at_a_crossing() -> Verdict:
    """At a crossing of q = k the right limit is R (-1)^(k+1) q', the left one R (-1)^k q'."""
    h = Fraction(1, 10)
    slopes = {
        k: (wave(Fraction(k)) - wave(k - h), wave(k + h) - wave(Fraction(k))) for k in range(4)
    }
    true = all((a / h, b / h) == ((-1) ** (k - 1), (-1) ** k) for k, (a, b) in slopes.items())
    stated = all((a / h, b / h) == ((-1) ** k, (-1) ** (k + 1)) for k, (a, b) in slopes.items())
    need(true and not stated, "the signs are others")
    return corrected(
        "the other way round: x'(t*+) = R (-1)^k q', x'(t*-) = R (-1)^(k-1) q'; the conclusion "
        "x'(t*+) = -x'(t*-) stands",
        "Slopes of W on both sides of k = 0, .., 3, exactly.",
    )


@claim("eq:proj-x", Kind.STEP, stated="k odd: x = r; k even: x = l")
def walls_of_the_cover() -> Verdict:
    """q = k is the right wall for odd k, the left wall for even k."""
    need(all(wave(Fraction(k)) == k % 2 for k in range(-3, 4)), "a wall is elsewhere")
    return confirmed("W(k) = 1 for odd k, 0 for even k", "Exact values.")
