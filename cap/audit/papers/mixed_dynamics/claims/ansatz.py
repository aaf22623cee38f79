"""Section 4.1: the symmetric ansatz and Theorem 4.2.

The algebra is right; but who turns and then moves right does not arrive at the left wall.
"""

from fractions import Fraction
from typing import Any

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import differs, identity, same, symbols
from cap.audit.means.balls import between, precisely
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.paper_equation import Equation, psi
from cap.audit.means.stored import stored
from cap.audit.verdict import Verdict, confirmed, corrected, imprecise, refuted
from cap.sets import interval
from cap.sets.interval import Ball

HALF = Equation(Fraction(1, 2), Fraction(2))  # f = 1/2 at the paper's F, ω, R


class Pieces:
    """The formulas eq:xpiece1, eq:xpiece2 with the constants eq:ABconst."""

    def __init__(self) -> None:
        F, f, w, r, tau = symbols("F f omega r tau")
        t = sp.Symbol("t", real=True)
        self.F, self.f, self.w, self.r, self.tau, self.t = F, f, w, r, tau, t
        self.A1 = -F / w * sp.sin(w * tau) - f * tau
        self.B1 = r + F / w**2
        self.A2 = -F / w * sp.sin(w * tau) + f * tau
        self.B2 = self.B1 - f * tau**2
        forced = -F / w**2 * sp.cos(w * t)
        self.x1 = forced + f * t**2 / 2 + self.A1 * t + self.B1
        self.x2 = forced - f * t**2 / 2 + self.A2 * t + self.B2

    def at(self, expression: Any, time: Any) -> Any:
        """Return an expression at a time."""
        return expression.subs(self.t, time)


@claim("ssec:periodic-ansatz", Kind.THEOREM, stated="Σ is a symmetry")
def sigma_is_a_symmetry() -> Verdict:
    """Σ: (x, v, t) -> (l + r - x, -v, t + T/2) is a symmetry of the system."""
    t, F, f, w = symbols("t F f omega")
    v, l, r, x = sp.symbols("v l r x", real=True)
    field = F * sp.cos(w * t) - f * sp.sign(v)
    mirrored = field.subs({v: -v, t: t + sp.pi / w}, simultaneous=True)
    identity("the acceleration changes its sign", mirrored, -field)
    identity("the walls are exchanged", (l + r - x).subs(x, l), r)
    return confirmed("as stated", "F cos(ωt + π) = -F cos ωt, and the rest is odd: by sympy.")


@claim("def:symm", Kind.THEOREM, stated="invariant under Σ")
def symmetric_orbits_exist() -> Verdict:
    """There are T-periodic orbits with x(t + T/2) = l + r - x(t)."""
    branches = stored("symmetric.json").claims["branches"]
    need(all(b["genuine"] == "yes" for b in branches.values()), "a branch is no orbit")
    types = {name: str(branch["type"]) for name, branch in branches.items()}
    return confirmed(
        "at the paper's parameters two with one hit of each wall per period, never stopping: both "
        f"saddles there ({', '.join(types)})",
        "Stored certificate.",
        certificate="symmetric.json",
    )


@claim("ssec:periodic-ansatz", Kind.CONSISTENCY, stated="the simplest non-sticking impact pattern")
def pattern_is_non_sticking() -> Verdict:
    """The pattern with a turning point in each half-period is non-sticking."""
    f, a = symbols("f a")
    factor = a / (a + 2 * f)
    det = factor**2
    need(sp.factor(1 - det).is_positive is True, "the determinant may be 1")
    return refuted(
        "by Definition 2.8 an orbit with a turning point is of the type 'turning' and in Ω_dissip: "
        "two turns per period give det Φ' = ((|F cos θ| - f)/(|F cos θ| + f))² < 1, so Theorem 3.3 "
        "says nothing of such an orbit, and none is elliptic",
        "Corollary 3.4 with a = |F cos θ| - f > 0.",
    )


@claim("thm:symmetric", Kind.STEP, stated="x' > 0 on (τ, T/2), and x(T/2) = l")
def ansatz_is_consistent() -> Verdict:
    """The ansatz: from the right wall leftwards, a turn at τ, x' > 0 on (τ, T/2), and x(T/2)
    = l.
    """
    p = Pieces()
    arrival = p.at(sp.diff(p.x2, p.t), sp.pi / p.w)
    identity(
        "the formula's velocity at T/2",
        arrival,
        -p.F / p.w * sp.sin(p.w * p.tau) - p.f * (sp.pi / p.w - p.tau),
    )
    return refuted(
        "moving right one arrives at no left wall: x(T/2) = l and x' > 0 before give x < l before. "
        "Accordingly eq:xpiece2 has x'(T/2) = -(F/ω) sin θ - (f/ω)(π - θ) < 0 for every θ in (0, "
        "π), against the ansatz",
        "Differentiated by sympy; both terms are negative.",
        proof="periodic.md#no-orbit-has-the-pattern",
    )


@claim("thm:symmetric", Kind.THEOREM, stated="bijection with the roots θ")
def bijection() -> Verdict:
    """The symmetric T-periodic orbits of this pattern are in bijection with the roots θ of
    eq:theta-eq with |F cos θ| > f.
    """
    with precisely():
        found = [HALF.bisected(root) for root in HALF.roots()]
        alpha = interval.ball(HALF.alpha)
        transverse = [theta for theta in found if abs(theta.cos()) > alpha]
        need(len(found) == len(transverse) == 2, "there are not two transverse roots")
        arrivals = [-theta.sin() - alpha * (interval.pi() - theta) for theta in found]
        need(all(v < 0 for v in arrivals), "a root arrives moving right")
        words = " and ".join(between(theta, 6) for theta in found)
    roots = stored("symmetric.json").claims["paper_roots"]
    need(all(root["velocity"].upper < 0 for root in roots), "the certificate disagrees")
    return refuted(
        f"at (F, ω, R, f) = (1, 1, 2, 1/2) there are two such roots, θ in {words}, and no such "
        "orbit; nor at any other parameters",
        "All roots in [0, π] by bisection in balls, and the velocity with which the formula "
        "arrives, which is negative for every θ; at f = 2/5 by certificate.",
        certificate="symmetric.json",
        proof="periodic.md#no-orbit-has-the-pattern",
    )


@claim("eq:theta-eq", Kind.FORMULA, stated="Fπ sin θ = 2F + Rω² - fπ²/2 + fθ(π - θ)")
def existence_equation() -> Verdict:
    """The conditions (C1) to (C4) give eq:theta-eq."""
    p = Pieces()
    R = sp.Symbol("R", positive=True)
    theta = p.w * p.tau
    fourth = p.at(p.x2, sp.pi / p.w) - (p.r - R)  # x(T/2) = l
    stated = p.F * sp.pi * sp.sin(theta) - (
        2 * p.F + R * p.w**2 - p.f * sp.pi**2 / 2 + p.f * theta * (sp.pi - theta)
    )
    identity("(C4) is the equation", fourth * p.w**2, -stated)
    return confirmed(
        "as stated: the algebra from (C1) to (C4) is right; it is not the equation of any orbit",
        "x(T/2) - l of eq:xpiece2 times ω², by sympy.",
    )


@claim("eq:ABconst", Kind.FORMULA, stated="A₁, B₁, A₂, B₂")
def constants() -> Verdict:
    """A₁, B₁, A₂ and B₂ follow from (C1), (C2), (C3)."""
    p = Pieces()
    identity("(C1)", p.at(p.x1, 0), p.r)
    for x in (p.x1, p.x2):
        identity("(C2)", p.at(sp.diff(x, p.t), p.tau))
    identity("(C3)", p.at(p.x1, p.tau), p.at(p.x2, p.tau))
    identity("A₂ = A₁ + 2fτ", p.A2, p.A1 + 2 * p.f * p.tau)
    return confirmed("all four", "(C1), (C2) on both sides, and (C3), by sympy.")


@claim("eq:xv-piece1", Kind.FORMULA, stated="x'' = F cos ωt + f on (0, τ)")
def first_piece() -> Verdict:
    """eq:xv-piece1 solves x'' = F cos ωt + f, with the velocity stated."""
    return _piece(Pieces(), 1)


@claim("eq:xv-piece2", Kind.FORMULA, stated="x'' = F cos ωt - f on (τ, T/2)")
def second_piece() -> Verdict:
    """eq:xv-piece2 solves x'' = F cos ωt - f, with the velocity stated."""
    return _piece(Pieces(), -1)


def _piece(p: Pieces, sign: int) -> Verdict:
    x, A = (p.x1, p.A1) if sign > 0 else (p.x2, p.A2)
    identity("x'", sp.diff(x, p.t), p.F / p.w * sp.sin(p.w * p.t) + sign * p.f * p.t + A)
    identity("x''", sp.diff(x, p.t, 2), p.F * sp.cos(p.w * p.t) + sign * p.f)
    return confirmed("both x' and x''", "Differentiated by sympy.")


@claim("C4", Kind.STEP, stated="five unknowns, conditions (C1) to (C4)")
def reflection_at_the_left_wall() -> Verdict:
    """(C1) to (C4), and the extension by symmetry, make it a periodic solution."""
    p = Pieces()
    leave = p.A1  # x'(0+)
    arrive = p.at(sp.diff(p.x2, p.t), sp.pi / p.w)
    # by symmetry x'(T/2+) = -x'(0+); the reflection asks for x'(T/2+) = -x'(T/2-)
    defect = sp.simplify(arrive - leave)
    identity("the defect of the reflection", defect, p.f * (2 * p.tau - sp.pi / p.w))
    need(differs(defect, sp.Integer(0)), "the reflection is always elastic")
    return refuted(
        "the elastic reflection at T/2, x'(T/2-) = x'(0+), is not imposed; it holds for θ = π/2 "
        "only, where |F cos θ| = 0 < f and nothing turns",
        "x'(T/2-) - x'(0+) = (f/ω)(2θ - π), by sympy.",
    )


@claim("thm:symmetric", Kind.STEP, stated="no further zeros of x' on (0, τ)")
def zeros_on_the_first_piece() -> Verdict:
    """(i) x' has no zero on (0, τ), since it begins with A₁ < 0 and x'' changes its sign once."""
    with precisely():
        theta = HALF.bisected(HALF.roots()[1])
        alpha = interval.ball(HALF.alpha)
        before = theta - Ball(1) / 10
        v = before.sin() + alpha * before - theta.sin() - alpha * theta
        need(v > 0, "x' is not positive just before τ", v=v)
        need(theta.cos() + alpha < 0, "x'' is not negative at τ")
        words = between(v, 6)
    return refuted(
        "false for θ > π - arccos(f/F): there x'' < 0 at τ, so x' > 0 just before, and x' vanishes "
        f"earlier. At f = 1/2 the larger root is such: x' in {words} at ωt = θ - 1/10",
        "eq:xv-piece1 evaluated in balls at the larger root of (F, ω, R, f) = (1, 1, 2, 1/2).",
    )


@claim("thm:symmetric", Kind.STEP, stated="the argument on (τ, T/2) is symmetric")
def zeros_on_the_second_piece() -> Verdict:
    """(i) x' has no zero on (τ, T/2) either, by the same argument."""
    p = Pieces()
    arrive = p.at(sp.diff(p.x2, p.t), sp.pi / p.w)
    theta = sp.Symbol("theta", positive=True)
    arrive = arrive.subs(p.tau, theta / p.w)
    identity("x'(T/2)", arrive * p.w, -p.F * sp.sin(theta) - p.f * (sp.pi - theta))
    with precisely():
        theta0 = HALF.bisected(HALF.roots()[0])
        alpha, after = interval.ball(HALF.alpha), interval.ball(Fraction(1, 10))
        later = theta0 + after
        v = later.sin() - alpha * later - theta0.sin() + alpha * theta0
        need(v > 0, "x' is not positive after τ")
    return refuted(
        "x' > 0 just after a turn to the right, and x'(T/2) < 0: it vanishes in between, for every "
        "θ in (0, π)",
        "x'(T/2) by sympy; positive at ωt = θ + 1/10 for the smaller root at f = 1/2, in balls.",
    )


@claim("eq:transverse-cond", Kind.STEP, stated="transverse turning iff |F cos θ| > f")
def transversality() -> Verdict:
    """(ii) The zero of x' at τ is a transverse turning point of the pattern iff |F cos θ| > f."""
    f, a = symbols("f a")
    falling = -(f + a) + f  # x'' before τ, on x' < 0, for F cos θ = -(f + a)
    need(falling.is_negative is True, "x' rises to 0")
    need(same(f + a + f, a + 2 * f), "the other sign fails too")
    return corrected(
        "iff F cos θ > f: the pattern turns from x' < 0 to x' > 0; for F cos θ < -f velocities "
        "x' < 0 fall, and do not reach 0",
        "x'' = F cos ωt + f before τ has the sign of -a for F cos θ = -(f + a).",
    )


@claim("thm:symmetric", Kind.STEP, stated="if it fails the orbit sticks at τ, or touches")
def where_transversality_fails() -> Verdict:
    """Where |F cos θ| <= f the flow would stick at τ, or touch tangentially."""
    c, f, share = sp.symbols("c f share", real=True)
    rest = sp.solve(c - f + 2 * f * share, share)[0]
    identity("rest is admissible for |c| <= f", rest * (1 - rest) * 4 * f**2, f**2 - c**2)
    return confirmed("true", "Lemma 2.3 (b), (c): 0 is in [F cos θ - f, F cos θ + f].")


@claim("rem:gkr-disagreement", Kind.STEP, stated="sin ωτ = πf/(2F) ignores the closure x(T/2) = l")
def simpler_relation() -> Verdict:
    """The relation sin ωτ = πf/(2F) would be obtained if the wall-to-wall closure was ignored."""
    F, f, w, R, U = symbols("F f omega R U")
    t, t1 = sp.symbols("t t1", real=True)
    v = -U + F / w * (sp.sin(w * t) - sp.sin(w * t1)) + f * (t - t1)  # from r at t1, leftwards
    arrive = v.subs(t, t1 + sp.pi / w)
    change = sp.expand_trig(sp.expand(arrive + U))
    identity("u(t₁ + T/2) - u(t₁)", change, (sp.pi * f - 2 * F * sp.sin(w * t1)) / w)
    way = sp.integrate(-v, (t, t1, t1 + sp.pi / w)).subs(f, 2 * F * sp.sin(w * t1) / sp.pi)
    closure = sp.solve(sp.simplify(sp.expand_trig(sp.expand(way))) - R, U)[0]
    identity("U", closure, w / sp.pi * (R + 2 * F * sp.cos(w * t1) / w**2))
    branches = stored("symmetric.json").claims["branches"]
    need(branches["plus"]["genuine"] == "yes", "the plus branch is no orbit")
    return refuted(
        "it is the closure of velocities over half a period of an orbit that does not turn; the "
        "closure x(T/2) = l is met too, and fixes the hit speed U = (ω/π)(R + 2F cos ωt₁/ω²). "
        "These orbits exist",
        "Half a period integrated by sympy: u(t₁ + T/2) = u(t₁) is sin ωt₁ = πf/(2F), the way R "
        "gives U. That they never stop at the paper's parameters is certified.",
        certificate="symmetric.json",
    )


@claim("thm:symmetric", Kind.CONSISTENCY, stated="piecewise-quadratic-plus-cosine on [0, T/2]")
def extension_by_symmetry() -> Verdict:
    """The formulas on [0, T/2] extended by symmetry are a continuous T-periodic function."""
    value, theta, (F, f, R, w) = psi()
    p = Pieces()
    end = p.at(p.x2, sp.pi / p.w) - (p.r - R)
    identity("x(T/2) - l is -Ψ/ω²", (end * p.w**2).subs(p.tau, theta / p.w), -value)
    need({F, f, R, w} <= value.free_symbols, "the equation lacks a parameter")
    return imprecise(
        "continuous, yes, at the roots of Ψ; its velocity violates the reflection law at the walls "
        "(ansatz.reflection-at-the-left-wall)",
        "x(T/2) = l is Ψ(θ) = 0, by sympy; x(T/2 + t) = l + r - x(t).",
    )
