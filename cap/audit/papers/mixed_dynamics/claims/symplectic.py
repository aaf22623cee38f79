"""Section 3.2: Theorem 3.3 and its proof."""

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import differs, identity, reals, same, symbols
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.verdict import Verdict, confirmed, corrected, imprecise


@claim("thm:symplectic", Kind.THEOREM, stated="Φ: Ω_NS -> Ω_NS is exact symplectic")
def symplectic() -> Verdict:
    """Φ restricted to Ω_NS is symplectic for dv ∧ dx."""
    d, k = reals("d k")
    J = sp.Matrix([[0, 1], [-1, 0]])
    flight, hit = sp.Matrix([[1, d], [0, 1]]), sp.Matrix([[-1, 0], [k, -1]])
    for name, M in (("flight", flight), ("hit", hit)):
        need(same(M.T * J * M, J), f"a {name} does not preserve dv ∧ dx")
    return imprecise(
        "Φ is analytic, injective and preserves dv ∧ dx on the open set of states whose orbits do "
        "not stop in [0, T] and hit no wall at 0 or T. Ω_NS itself need not be open "
        "(smoothness.interior-of-the-set), so a differential form on it means little; inside "
        "invariant curves all is well",
        "Mᵀ J M = J for the factors of Φ', symbolically: flights ((1, d), (0, 1)) and hits ((-1, "
        "0), (k, -1)), k = 2F cos ωt/v.",
        proof="lift.md#where-the-map-is-symplectic",
    )


@claim("thm:symplectic", Kind.FORMULA, stated="dv ∧ dx = R² dp ∧ dq")
def form_on_a_branch() -> Verdict:
    """Step 1: on each branch dv ∧ dx = R² dp ∧ dq, and v dx = R² p dq."""
    R, sigma, p, q, shift = reals("R sigma p q shift")
    x, v = R * sigma * (q - shift), R * sigma * p
    jacobian = sp.Matrix([[sp.diff(v, p), sp.diff(v, q)], [sp.diff(x, p), sp.diff(x, q)]])
    identity("dv ∧ dx", jacobian.det().subs(sigma**2, 1), R**2)
    identity("v dx", (v * sp.diff(x, q)).subs(sigma**2, 1), R**2 * p)
    return confirmed("both, as σ² = 1", "Jacobian determinant by sympy.")


@claim("thm:symplectic", Kind.STEP, stated="the transition is the identity in the lift")
def branch_transitions() -> Verdict:
    """Step 2: across a wall hit the form is preserved because the transition is the identity."""
    k, p, jump, R = reals("k p jump R")
    lifted = sp.Matrix([[1, 0], [jump / p, 1]])
    need(same(lifted.det(), sp.Integer(1)), "the crossing has another determinant")
    before, after = sp.diag(R, R), sp.diag(-R, -R)  # (q, p) -> (x, v) on W' = 1 and on W' = -1
    base = sp.simplify(after * lifted * before.inv())
    identity("it is the saltation matrix of the hit", base[1, 0], -jump / p)
    need(same(base, sp.Matrix([[-1, 0], [-jump / p, -1]])), "it is another matrix")
    need(differs(base[1, 0], sp.Integer(0)), "the transition may be the identity")
    return corrected(
        "its derivative is the shear ((1, 0), (Δp'/p, 1)), not the identity, as the crossing time "
        "depends on the state; it has determinant 1, so the conclusion holds",
        f"In (x, v) it is the saltation matrix ((-1, 0), (k, -1)), {k} = -Δp'/p = 2F cos ωt/v at "
        "r. See cover.transition-is-the-identity for why the argument proves too much.",
    )


@claim("thm:symplectic", Kind.STEP, stated="smooth generating functions on each chamber")
def generating_function() -> Verdict:
    """Step 3: (Φ̃^T)*(p dq) - p dq = dS̃ on the lift, S̃ put together from chambers."""
    a, t = reals("a t")
    q, p = sp.Function("q")(a, t), sp.Function("p")(a, t)
    H = sp.Function("H")
    Q, P = reals("Q P")
    H_q, H_p = (sp.diff(H(Q, P, t), z).subs({Q: q, P: p}) for z in (Q, P))
    rate = sp.diff(p, t) * sp.diff(q, a) + p * sp.diff(q, a, t)  # of p ∂q/∂a in time
    rate = rate.subs(sp.diff(p, t), -H_q)
    action = sp.diff(p, a) * H_p + p * sp.diff(q, a, t) - H_q * sp.diff(q, a) - H_p * sp.diff(p, a)
    identity("d(p ∂q/∂a)/dt = ∂L/∂a, L = p q' - H", rate, action)
    return imprecise(
        "S̃ = ∫ (p q' - H) dt along the orbit, which crosses chambers: it is one function, smooth "
        "where Φ̃^T is, since H is continuous at the integers; no time-T map stays in one chamber",
        "d(p ∂q/∂a)/dt = ∂(p q' - H)/∂a along solutions of Hamilton's equations, for any H.",
    )


@claim("thm:symplectic", Kind.STEP, stated="S = R² S̃ is well defined on Ω_NS")
def exactness_descends() -> Verdict:
    """Step 3: S = R² S̃ is well defined on the base, so Φ*λ - λ = dS with λ = v dx."""
    q, p = reals("q p")
    f, R, c, T = symbols("f R c T")
    W = sp.Function("W")
    H = p**2 / 2 - c / R * W(q) + f / R * q
    shift = sp.expand((H.subs(q, q + 2) - H).subs(W(q + 2), W(q)))
    identity("H(q + 2) - H(q)", shift, 2 * f / R)
    flux = -(R**2) * shift * T
    identity("the flux", flux, -2 * f * R * T)
    need(flux.is_negative is True, "the flux may vanish")
    return corrected(
        "not on the set of states that do not stop in [0, T]: that contains the annulus of large "
        "speeds, and around it ∮(Φ*λ - λ) = -2fRT. On Ω_NS it holds, because no closed curve in it "
        "goes around the annulus (areas would fall by 2fRT in each period), and in every disk",
        "The lift is unique up to q -> q + 2, under which H grows by 2f/R and S̃ falls by 2fT/R "
        f"(flux {sp.sstr(flux)}, by sympy).",
        proof="lift.md#exactness-and-flux",
    )


@claim("thm:symplectic", Kind.FORMULA, stated="dλ = ω for λ = v dx")
def primitive() -> Verdict:
    """λ = v dx has dλ = dv ∧ dx, and is the same on both sides of a reflection."""
    x, v = reals("x v")
    identity("the coefficient of dv ∧ dx", sp.diff(v, v) - sp.diff(sp.Integer(0), x), 1)
    p, dq = reals("p dq")
    identity("p dq under (q, p) -> (-q, -p)", (-p) * (-dq), p * dq)
    return confirmed("d(v dx) = dv ∧ dx, and (-v) d(-x) = v dx", "Symbolic identities.")


@claim("eq:areapres", Kind.THEOREM, stated="Leb(Φ(A)) = Leb(A)")
def areas_are_equal() -> Verdict:
    """Leb(Φ(A)) = Leb(A) for measurable A in Ω_NS on which Φ is a local diffeomorphism."""
    d, k = reals("d k")
    flight, hit = sp.Matrix([[1, d], [0, 1]]), sp.Matrix([[-1, 0], [k, -1]])
    need(same((hit * flight).det(), sp.Integer(1)), "the determinant is not 1")
    return confirmed(
        "true; that Φ is a local diffeomorphism is not enough, it is also injective on Ω_NS",
        "Determinant 1 of the factors, and two never-stopping orbits that meet at T agree before, "
        "as flights and elastic hits can be run backwards.",
        proof="lift.md#where-the-map-is-symplectic",
    )


@claim("thm:symplectic", Kind.STEP, stated="symplectic in dimension two iff |det Φ'| = 1")
def determinant_and_orientation() -> Verdict:
    """Step 4: in two dimensions symplectic is equivalent to |det Φ'| = 1."""
    J, mirror = sp.Matrix([[0, 1], [-1, 0]]), sp.diag(1, -1)
    need(same(sp.Abs(mirror.det()), sp.Integer(1)), "diag(1, -1) has another determinant")
    need(same(mirror.T * J * mirror, -J), "diag(1, -1) does not reverse the form")
    return corrected(
        "it is equivalent to det Φ' = 1: diag(1, -1) has |det| = 1 and reverses the form",
        "diag(1, -1)ᵀ J diag(1, -1) = -J. For Φ the determinant is 1, as that of each factor is.",
    )
