"""Section 8: persistence of never-stopping orbits with inelastic walls and viscosity."""

from fractions import Fraction

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import differs, formula, identity, reals, same, symbols
from cap.audit.means.balls import above, between, pair
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.orbits import at
from cap.audit.means.stored import stored
from cap.audit.papers.mixed_dynamics.claims.saltation import hit
from cap.audit.verdict import Verdict, confirmed, corrected, imprecise, refuted
from cap.flow.propagation import at_time_zero, propagate
from cap.sets import interval
from cap.sets.interval import Ball


@claim("ssec:persist-model", Kind.STEP, stated="well-posed by the same argument as Theorem 2.5")
def well_posedness_with_losses() -> Verdict:
    """Well-posedness for restitution e and viscosity μ follows by the same argument."""
    found = stored("capture-3.json")
    e, mu, ratio = found.parameters["e"], found.parameters["mu"], found.claims["ratio"]
    need(e < 1 and mu > 0 and ratio < 1, "there are no losses")
    return refuted(
        f"the argument fails in the same way: hits accumulate; at (F, ω, f, e, μ) = (2, 3, 1, {e}, "
        f"{mu}) before t = {above(found.claims['accumulation_time'])}, for an open set of states. "
        "With a contact law the statement holds",
        "Stored certificate.",
        certificate="capture-3.json",
        proof="setup.md#the-contact-law",
    )


@claim("ssec:persist-model", Kind.INEQUALITY, stated="|x'| <= |x'(0)| e^(-μt) e + (F + f)/μ")
def speed_bound() -> Verdict:
    """At impact times |x'(t)| <= |x'(0)| exp(-μt) e + (F + f)/μ, for (ε, μ) in [0, 1) × [0, ∞)."""
    p = at(e="1/2", mu="1")
    with interval.workprec(100):
        end = interval.ball(Fraction(1, 100))
        x, v = propagate(p, at_time_zero(Ball(0), Ball(100)), end).state
        need(0 < 1 - x < v / 1000, "the wall is not just ahead", x=x)
        at_the_wall = v - 1000 * (1 - x) / v  # it loses at most F + f + 100μ < 1000 per time
        bound = 50 * (-end).exp() + interval.ball(p.F + p.f)  # for all later times
        need(at_the_wall > bound, "the bound holds", v=at_the_wall, bound=bound)
        words = between(v, 2), between(bound, 2)
    return corrected(
        "at the first impact nothing has lost the factor e yet: from v = 100 in the middle, e = "
        f"1/2, μ = 1, F = ω = 1, R = 2, |x'| is in {words[0]} at t = 1/100, just before r, the "
        f"bound in {words[1]}; and for μ = 0 it is not defined. True: |x'(t)| <= |x'(0)| exp(-μt) "
        "+ (F - f)/μ, and <= |x'(0)| + (F - f) t",
        "The flight followed in balls; |v|' <= F - f - μ|v| for the true bound.",
    )


@claim("prop:persist-orbit", Kind.FORMULA, stated="det(Φ'₀ - 1) = 2 - tr Φ'₀")
def determinant_of_the_difference() -> Verdict:
    """det(Φ'₀ - I) = 1 - tr Φ'₀ + 1 = 2 - tr Φ'₀, positive for an elliptic orbit."""
    a, b, c, d = reals("a b c d")
    M = sp.Matrix([[a, b], [c, d]])
    difference = (M - sp.eye(2)).det() - (M.det() - M.trace() + 1)
    identity("det(M - 1) = det M - tr M + 1", difference)
    theta = sp.Symbol("theta", real=True)
    identity("2 - 2cos θ", 2 - 2 * sp.cos(theta), 4 * sp.sin(theta / 2) ** 2)
    return confirmed("as stated, with det Φ'₀ = 1", "By sympy; 2 - 2cos θ* = 4 sin²(θ*/2) > 0.")


@claim("prop:persist-orbit", Kind.THEOREM, stated="a C^∞ family P(ε, μ) near (0, 0)")
def persistence_of_the_orbit() -> Verdict:
    """A never-stopping T-periodic orbit without eigenvalue 1 persists for small ε and μ,
    smoothly.
    """
    claims = stored("persistence.json").claims
    epsilon, mu = claims["range"]["epsilon"], claims["range"]["mu"]
    return confirmed(
        "true, real analytically; at the paper's parameters P* persists for all ε in [0, "
        f"{epsilon[-1]}], μ in [0, {mu[-1]}]",
        "Implicit function theorem; the explicit rectangle is certified, on "
        f"{len(claims['range']['boxes'])} cells.",
        certificate="persistence.json",
    )


@claim("thm:persistence", Kind.FORMULA, stated="α = -((1+e) F cos ωt* + (1-e) f)/v₋")
def inelastic_entry() -> Verdict:
    """Step 1: the saltation matrix of an inelastic hit has the entry
    α = -((1+e) F cos ωt* + (1-e) f)/v₋.
    """
    e = symbols("e")
    M, u, c, f = hit(1, e)
    need(same(M[0, :], sp.Matrix([[-e, 0]])) and same(M[1, 1], -e), "another matrix")
    left, *_ = hit(-1, e)
    identity("at the left wall", left[1, 0], ((1 + e) * c - (1 - e) * f) / (-u))
    return formula(
        M[1, 0],
        -((1 + e) * c + (1 - e) * f) / u,
        "From first principles (cap.audit.means.linear), at both walls.",
        "+((1+e) F cos ωt* + (1-e) f sgn v₋)/v₋",
    )


@claim("thm:persistence", Kind.STEP, stated="field limits without the viscous term")
def viscosity_at_a_hit() -> Verdict:
    """Step 1 computes the saltation with the field of μ = 0; with viscosity it is the same."""
    e, mu, u, f = symbols("e mu u f")
    c = sp.Symbol("c", real=True)
    before, after = sp.Matrix([u, c - f - mu * u]), sp.Matrix([-e * u, c + f + mu * e * u])
    H = sp.diag(1, -e)
    M = H + (after - H * before) * sp.Matrix([[1, 0]]) / u
    need(mu not in sp.simplify(M).free_symbols, "viscosity enters")
    return confirmed(
        "true: μ v cancels, as it changes with the velocity by the factor -e", "By sympy."
    )


@claim("eq:wall-det", Kind.FORMULA, stated="det = e² = (1 - ε)²")
def inelastic_determinant() -> Verdict:
    """The saltation matrix of an inelastic hit has determinant e² = (1 - ε)²."""
    e = symbols("e")
    need(same(hit(1, e)[0].det(), e**2), "the determinant is another")
    return confirmed("e²", "From first principles.")


@claim("thm:persistence", Kind.FORMULA, stated="((1, (1 - e^(-μΔt))/μ), (0, e^(-μΔt)))")
def viscous_flight() -> Verdict:
    """Step 2: the fundamental matrix of a viscous flight, of determinant exp(-μΔt)."""
    mu, d = symbols("mu d")
    M = sp.Matrix([[1, (1 - sp.exp(-mu * d)) / mu], [0, sp.exp(-mu * d)]])
    A = sp.Matrix([[0, 1], [0, -mu]])
    need(same(sp.diff(M, d), A * M), "it does not solve the variational equation")
    need(same(M.subs(d, 0), sp.eye(2)), "it is not 1 at the start")
    identity("its determinant", M.det(), sp.exp(-mu * d))
    return confirmed("as stated", "Variational equation and initial value by sympy.")


@claim("eq:persist-det", Kind.FORMULA, stated="det = e^(-μT) (1-ε)^(2n*) = 1 - μT - 2n*ε + ..")
def determinant_with_losses() -> Verdict:
    """det Φ'(P(ε, μ)) = exp(-μT)(1 - ε)^(2n*) = 1 - μT - 2n*ε + O((ε + μ)²)."""
    eps, mu, T, n = symbols("epsilon mu T n")
    det = sp.exp(-mu * T) * (1 - eps) ** (2 * n)
    zero = {eps: 0, mu: 0}
    identity("at 0", det.subs(zero), 1)
    identity("by ε", sp.diff(det, eps).subs(zero), -2 * n)
    identity("by μ", sp.diff(det, mu).subs(zero), -T)
    claims = stored("persistence.json").claims
    return confirmed(
        "true, and the first form is exact; at (ε, μ) = (1/1000, 1/1000) of the certificate it is "
        f"in {pair(claims['determinant'], 10)}",
        "Product of the determinants of hits and flights; expanded by sympy.",
        certificate="persistence.json",
    )


@claim("thm:persistence", Kind.DEFINITION, stated="ρ := 1 - 2n*ε - μT + O((ε + μ)²)")
def definition_of_rho() -> Verdict:
    """ρ(ε, μ) is defined as 1 - 2n*ε - μT + O((ε + μ)²)."""
    eps, mu, T, n = symbols("epsilon mu T n")
    rho = sp.exp(-mu * T) * (1 - eps) ** (2 * n)
    second = sp.diff(rho, eps, 2).subs({eps: 0, mu: 0})
    need(differs(second, sp.S.Zero), "there is no term of second order")
    return imprecise(
        "a definition by an O is none; exactly, ρ = exp(-μT)(1 - ε)^(2n*)",
        "It has terms of second order: 2n*(2n* - 1) ε²/2 for instance, by sympy.",
    )


@claim("eq:persist-eigenvalues", Kind.FORMULA, stated="λ± = e^(±iθ*) sqrt ρ (1 + O(ε + μ))")
def eigenvalues() -> Verdict:
    """λ±(ε, μ) = exp(±iθ*) sqrt ρ (1 + O(ε + μ)), hence |λ±| < 1."""
    eps, n = symbols("epsilon n")
    root = (1 - eps) ** n  # sqrt ρ at μ = 0
    first = sp.limit((root - 1) / eps, eps, 0)
    identity("sqrt ρ is 1 + O(ε) itself", first, -n)
    return imprecise(
        "true, but sqrt ρ = 1 + O(ε + μ) is swallowed by the factor, so |λ±| < 1 does not follow "
        "from it. What holds, and gives it: |λ±|² = det = ρ exactly, and arg λ± = ±θ* + O(ε + μ)",
        "Expanded by sympy. The proof derives |λ±|² = ρ.",
    )


@claim("eq:eig-quadr", Kind.FORMULA, stated="discriminant 4cos² θ* - 4 = -4 sin² θ* < 0")
def discriminant() -> Verdict:
    """At (0, 0) the discriminant is -4 sin² θ*, so for small (ε, μ) the eigenvalues are
    conjugate.
    """
    theta = sp.Symbol("theta", real=True)
    identity("the discriminant", (2 * sp.cos(theta)) ** 2 - 4, -4 * sp.sin(theta) ** 2)
    t, d = reals("t d")
    root = (t + sp.sqrt(t**2 - 4 * d)) / 2
    identity("it is an eigenvalue", root**2 - t * root + d)
    return confirmed("as stated", "By sympy.")


@claim(
    "thm:persistence", Kind.THEOREM, stated="|λ±| < 1, asymptotically stable, on [0, ε₀]×[0, μ₀]"
)
def asymptotic_stability() -> Verdict:
    """For all (ε, μ) != (0, 0) in the rectangle of Proposition 8.1, P(ε, μ) is asymptotically
    stable.
    """
    claims = stored("persistence.json").claims
    epsilon, mu = claims["range"]["epsilon"], claims["range"]["mu"]
    need(epsilon[0] == 0 and mu[0] == 0, "the rectangle does not begin at 0")
    return corrected(
        "for small ε, μ: the rectangle on which the orbit persists may have to shrink, until the "
        "eigenvalues stay complex. At the paper's parameters it is certified for all 0 <= ε <= "
        f"{epsilon[-1]}, 0 <= μ <= {mu[-1]} but (0, 0), by |trace| < 1 + determinant",
        "Stored certificate (Jury's criterion on cells of (ε, μ)).",
        certificate="persistence.json",
    )


@claim("ssec:intro-mixed", Kind.FORMULA, stated="contraction rate ρ")
def contraction_rate() -> Verdict:
    """ρ(ε, μ) = 1 - 2n*ε - μT is the contraction rate of the orbit's linearisation."""
    eps, mu, T, n = symbols("epsilon mu T n")
    rho = sp.exp(-mu * T) * (1 - eps) ** (2 * n)
    rate = sp.sqrt(rho)
    zero = {eps: 0, mu: 0}
    identity("by ε", sp.diff(rate, eps).subs(zero), -n)
    identity("by μ", sp.diff(rate, mu).subs(zero), -T / 2)
    return imprecise(
        "of areas; distances shrink by sqrt ρ = 1 - n*ε - μT/2 + .. per period",
        "|λ±|² = ρ, expanded by sympy.",
    )


@claim("ssec:intro-mixed", Kind.WORDS, stated="a quantitative threshold for the disappearance")
def threshold() -> Verdict:
    """ρ(ε, μ) identifies a quantitative threshold for the disappearance of mixed dynamics."""
    eps, mu, T, n = symbols("epsilon mu T n")
    exponent = -mu * T + 2 * n * sp.log(1 - eps)
    smallest = sp.limit(exponent.subs(mu, 0) / eps, eps, 0, "+")
    identity("log ρ is -2n*ε + ..", smallest, -2 * n)
    need(sp.diff(exponent, mu).is_negative is True, "ρ does not fall with μ")
    return refuted(
        "there is no threshold: ρ < 1 for every (ε, μ) != (0, 0), so area is conserved at (0, 0) "
        "only. ρ is the rate at which a period contracts areas there",
        "log ρ = 2n* log(1 - ε) - μT < 0.",
    )
