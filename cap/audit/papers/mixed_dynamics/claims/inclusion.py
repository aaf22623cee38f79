"""Section 2.1: what a solution is.  (F1) to (F3) let pass more than they should."""

from fractions import Fraction

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import enclosure, identity, same, symbols
from cap.audit.means.balls import pair
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.verdict import Verdict, confirmed, corrected, vacuous
from cap.sets import interval


@claim("eq:Ffield", Kind.DEFINITION, stated="{v} × [F cos ωt - f, F cos ωt + f] at v = 0")
def convexified_field() -> Verdict:
    """At v = 0 the Filippov field is {v} × [F cos ωt - f, F cos ωt + f]."""
    a, f, v, s = sp.symbols("a f v s", real=True)
    limits = [a - f * sp.limit(sp.sign(v), v, 0, side) for side in "+-"]
    hull = s * limits[0] + (1 - s) * limits[1]
    identity("one end", hull.subs(s, 1), a - f)
    identity("the other end", hull.subs(s, 0), a + f)
    return confirmed(
        "the convex hull of the one-sided limits at v = 0", "One-sided limits by sympy."
    )


@claim("def:Filippov-solution", Kind.DEFINITION, stated="x absolutely continuous")
def kicks_are_solutions() -> Verdict:
    """A solution is an absolutely continuous x with (x', x'') in the Filippov field for almost
    every t, and with elastic reflection at the walls.
    """
    t, F, f, w = sp.symbols("t F f omega", positive=True)
    speed = [2 + F / w * sp.sin(w * t) - f * t, 3 + F / w * sp.sin(w * t) - f * t]
    for v in speed:  # before and after a kick of 1 in the middle of a flight
        identity("the equation holds on both sides", sp.diff(v, t), F * sp.cos(w * t) - f)
    need(same(speed[1] - speed[0], sp.Integer(1)), "the kick is not 1")
    return corrected(
        "x' must be absolutely continuous between hits: as it stands, every x whose velocity jumps "
        "at will inside (l, r) is a solution, and uniqueness fails for every initial datum",
        "x with x' = 2 + (F/ω) sin ωt - ft until some time and 1 more after it, far from the "
        "walls, is Lipschitz, and satisfies (F1) except at that time, (F2) and (F3) trivially.",
    )


@claim("F3", Kind.DEFINITION, stated="x ≡ l on [a, b] implies x' ≡ 0 there")
def sticking_to_a_wall() -> Verdict:
    """(F3) excludes that a trajectory adheres to a wall at non-zero velocity."""
    t, l = sp.symbols("t l", real=True)
    need(same(sp.diff(l + 0 * t, t), sp.Integer(0)), "a constant has a derivative")
    return vacuous(
        "(F3) is a tautology: a constant function has the derivative 0",
        "What is missing is a law for a mass at rest at a wall: see inclusion.rest-at-a-wall.",
    )


@claim("thm:wellposed", Kind.THEOREM, stated="the solution is unique")
def rest_at_a_wall() -> Verdict:
    """For every initial datum the solution in the sense of (F1) to (F3) is unique."""
    t, F, f, w = sp.symbols("t F f omega", positive=True)
    # At r, at rest, when cos ωt = -1: leave, or stay.  τ = t - π/ω.
    v = sp.integrate(F * sp.cos(w * t + sp.pi) + f, (t, 0, t))
    identity("who leaves obeys the equation for v < 0", sp.diff(v, t), -F * sp.cos(w * t) + f)
    need(same(sp.diff(v, t).subs(t, 0), f - F), "the acceleration is not f - F")
    found = stored("capture.json").claims
    release = found["release_time"]
    with interval.workprec(60):
        force = -enclosure(sp.cos(t), {t: Fraction(2)})
        need(force > interval.ball(Fraction(2, 5)), "no force pulls from the wall at t = 2")
    box = found["box"]
    return corrected(
        f"all orbits from the interior of {box['x']} × {box['v']} come to rest at r, where (F1) to "
        "(F3) demand nothing: to stay for ever, or to leave at any time with F cos ωt < -f, are "
        "solutions. With a contact law (at r: rest while F cos ωt >= -f, and no longer) it is "
        "unique",
        f"Certified capture, released at a time in {pair(release, 6)}; (F1) speaks of x in "
        "(l, r) only, (F2) of x' != 0 only, (F3) of nothing.",
        certificate="capture.json",
        proof="setup.md#the-contact-law",
    )


@claim("thm:wellposed", Kind.THEOREM, stated="a solution exists for every initial datum")
def outward_data() -> Verdict:
    """For every (x₀, v₀) in X there is a solution with (x(0), x'(0+)) = (x₀, v₀)."""
    v0, b, t = symbols("v0 b t")
    x = v0 * t - b * t**2 / 2  # x - r is at least this, |x''| <= b
    identity("x - r is positive until 2 v₀/b", sp.factor(x), t * (2 * v0 - b * t) / 2)
    return corrected(
        "for x₀ = r and v₀ > 0 there is none: x would exceed r at once. (r, v₀) must be left out "
        "of X, or be identified with (r, -v₀)",
        "x(t) - r >= v₀ t - (F + f) t²/2 > 0 for 0 < t < 2 v₀/(F + f).",
    )


@claim("rem:sticking", Kind.THEOREM, stated="x'' = 0 is the selection that stays on v = 0")
def sliding_selection() -> Verdict:
    """For |F cos ωt| < f rest is the only selection that keeps v = 0; for |F cos ωt| > f there is
    none.
    """
    a, f, share = sp.symbols("a f share", real=True)
    value = a - f + 2 * f * share  # share in [0, 1] runs through the set
    rest = sp.solve(value, share)[0]
    identity("0 is taken at the share (f - a)/2f", rest, (f - a) / (2 * f))
    inside = sp.simplify(rest * (1 - rest) * 4 * f**2 - (f**2 - a**2))
    need(inside == 0, "0 < share < 1 is not the same as |a| < f")
    return confirmed(
        "0 lies in [a - f, a + f], a = F cos ωt, if and only if |a| <= f",
        "The share at which 0 is taken is in [0, 1] exactly for a² <= f², by sympy.",
    )
