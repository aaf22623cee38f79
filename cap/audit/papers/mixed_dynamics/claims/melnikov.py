"""Section 6: the Melnikov function, its integrals, and what is concluded."""

from fractions import Fraction

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import differs, identity, symbols
from cap.audit.means.balls import between, precisely
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.melnikov import SECH, SECH_SQUARED_COS, SECH_TANH_COS, SECH_TANH_SIN
from cap.audit.means.need import need
from cap.audit.verdict import (
    Verdict,
    confirmed,
    corrected,
    refuted,
    uncheckable,
    vacuous,
)
from cap.sets import interval
from cap.sets.interval import Ball

FREQUENCIES = Fraction(1, 2), Fraction(1), Fraction(3)


@claim("thm:melnikov", Kind.FORMULA, stated="∫ sech u tanh u sin ξu du = πξ/sinh(πξ/2)")
def sine_transform() -> Verdict:
    """∫ sech u tanh u sin(ξu) du = πξ/sinh(πξ/2)."""
    shown = []
    with precisely():
        for q in FREQUENCIES:
            xi = interval.ball(q)
            value, of_square = SECH_TANH_SIN.by_quadrature(xi), SECH_SQUARED_COS.closed(xi)
            need(value.overlaps(SECH_TANH_SIN.closed(xi)), "it is not πξ/cosh(πξ/2)")
            need(not value.overlaps(of_square), "it may be πξ/sinh(πξ/2)")
            need(SECH_SQUARED_COS.by_quadrature(xi).overlaps(of_square), "nor that of sech²")
            shown.append(between(value, 8))
    xi, u = symbols("xi u")
    identity("by parts", sp.diff(sp.sech(u), u) + sp.sech(u) * sp.tanh(u))
    identity(
        "ξ ∫ sech cos", xi * sp.pi * sp.sech(sp.pi * xi / 2), sp.pi * xi / sp.cosh(sp.pi * xi / 2)
    )
    return corrected(
        "πξ/cosh(πξ/2); πξ/sinh(πξ/2) is the integral of sech² u cos ξu",
        f"Rigorous quadrature at ξ = 1/2, 1, 3: {', '.join(shown)}. By parts it is ξ times the "
        "integral of sech u cos ξu, which is π sech(πξ/2).",
    )


@claim("thm:melnikov", Kind.FORMULA, stated="∫ sech u tanh u cos ξu du = πξ/sinh(πξ/2)")
def cosine_transform() -> Verdict:
    """∫ sech u tanh u cos(ξu) du = πξ/sinh(πξ/2), up to sign conventions."""
    u, xi = symbols("u xi")
    integrand = sp.sech(u) * sp.tanh(u) * sp.cos(xi * u)
    identity("the integrand is odd", integrand.subs(u, -u), -integrand)
    shown = []
    with precisely():
        for q in FREQUENCIES:
            xi = interval.ball(q)
            cosine, as_stated = SECH_TANH_COS.by_quadrature(xi), SECH_SQUARED_COS.closed(xi)
            need(cosine.contains(0), "the integral is not 0")
            need(not cosine.overlaps(as_stated), "it may be as stated")
            shown.append(between(as_stated, 4))
    return refuted(
        "it is 0: the integrand is odd. No sign convention turns 0 into the stated value, "
        f"{', '.join(shown)} at ξ = 1/2, 1, 3",
        "Parity by sympy; rigorous quadrature encloses 0.",
    )


@claim("thm:melnikov", Kind.STEP, stated="the sine integral vanishes by symmetry")
def vanishing_integral() -> Verdict:
    """The Poisson bracket is odd in s, so the sine integral vanishes and the cosine integral
    stays.
    """
    u, xi = symbols("u xi")
    bracket = sp.sech(u) * sp.tanh(u)
    identity("the bracket is odd", bracket.subs(u, -u), -bracket)
    product = bracket * sp.sin(xi * u)
    identity("odd times odd is even", product.subs(u, -u), product)
    with precisely():
        cosine, sine = (each.by_quadrature(Ball(1)) for each in (SECH_TANH_COS, SECH_TANH_SIN))
        need(cosine.contains(0), "the cosine integral does not vanish")
        need(sine > 1, "the sine integral may vanish")
        words = between(sine, 6)
    return refuted(
        "the other way round: odd times cosine integrates to 0, odd times sine does not. On the "
        "paper's own terms M(t₀) = A' sin ωt₀ + B",
        f"Parity by sympy; at ξ = 1 the sine integral is in {words}.",
    )


@claim("thm:melnikov", Kind.STEP, stated="{H₀, V_osc} = κ₀ F sech(λ* s) tanh(λ* s), odd")
def oddness_of_the_bracket() -> Verdict:
    """The bracket of H₀ with an even potential is odd along the homoclinic, of the form
    κ₀ F sech tanh.
    """
    s = symbols("s")
    angle = 2 * sp.atan(sp.sinh(s))
    half = angle / 2
    along = 2 * sp.tan(half) / (1 + sp.tan(half) ** 2)  # sin φ along the separatrix
    difference = sp.simplify(along - 2 * sp.tanh(s) * sp.sech(s)).rewrite(sp.exp)
    identity("sin φ = 2 sech s tanh s", sp.simplify(difference))
    velocity = sp.sech(s)
    bracket = velocity * 2 * sp.tanh(s) * sp.sech(s)  # I-part times ∂(cos φ)/∂φ, up to constants
    need(differs(bracket, sp.sech(s) * sp.tanh(s)), "the bracket has the stated form")
    return uncheckable(
        "V_osc is not given as a function of (I, φ), nor κ₀. For a potential cos φ the bracket "
        "along the separatrix is a multiple of sech² s tanh s, not of sech s tanh s: odd, as said",
        "sin φ = 2 sech s tanh s on φ = 2 arctan sinh s, times the momentum sech s, by sympy.",
    )


@claim("thm:melnikov", Kind.WORDS, stated="simple poles at iπ/2 + iπk")
def order_of_the_poles() -> Verdict:
    """The integrand sech u tanh u cos ξu has simple poles at u = iπ/2 + iπk."""
    w, xi = sp.symbols("w xi")
    pole = sp.I * sp.pi / 2
    integrand = sp.sinh(w + pole) / sp.cosh(w + pole) ** 2 * sp.cos(xi * (w + pole))
    leading = sp.limit(sp.simplify(integrand * w**2), w, 0)
    need(leading != 0, "the pole is simple")
    return corrected(
        "double poles: sech and tanh have a pole each there; the residue needs a derivative, which "
        "is where the factor ξ comes from",
        f"w² times the integrand at iπ/2 + w tends to {sp.sstr(sp.simplify(leading))}.",
    )


@claim("eq:Melnikov-B", Kind.FORMULA, stated="J₀ = ∫ sech(λ* s) ds = π/λ*")
def integral_of_sech() -> Verdict:
    """J₀ = ∫ sech(λ* s) ds = π/λ*."""
    with precisely():
        value = SECH.by_quadrature(Ball(1))
        need(value.overlaps(SECH.closed(Ball(1))), "the integral of sech is not π")
        words = between(value, 10)
    u = symbols("u")
    identity("an antiderivative", sp.diff(2 * sp.atan(sp.tanh(u / 2)), u), sp.sech(u))
    return confirmed("π/λ*", f"Rigorous quadrature: {words}; antiderivative by sympy.")


@claim("eq:Melnikov-B", Kind.FORMULA, stated="B = -(2f/R) J₀")
def friction_integral() -> Verdict:
    """The autonomous friction part of the Hamiltonian contributes B = -(2f/R) J₀ to the Melnikov
    function.
    """
    action, phi = sp.symbols("I phi", real=True)
    H, V = (sp.Function(name)(action, phi) for name in ("H", "V"))
    velocity = sp.diff(H, action), -sp.diff(H, phi)  # of φ and of I
    along = sp.diff(V, phi) * velocity[0] + sp.diff(V, action) * velocity[1]
    bracket = sp.diff(H, action) * sp.diff(V, phi) - sp.diff(H, phi) * sp.diff(V, action)
    identity("{H₀, V} is dV/ds along the flow of H₀", bracket, along)
    return refuted(
        "B = 0: {H₀, V} is the derivative of V along the unperturbed orbit, so its integral over a "
        "homoclinic loop is V(saddle) - V(saddle) = 0. On the cover friction is conservative",
        "Symbolic identity for any H₀ and V that do not depend on time.",
        proof="melnikov.md#an-autonomous-perturbation-has-no-melnikov-function",
    )


@claim("eq:A-explicit", Kind.CONSISTENCY, stated="argument πω/(2λ*)")
def argument_of_the_amplitude() -> Verdict:
    """A = (2πF/R) (ω/λ*)/sinh(πω/(2λ*)) α_M follows from the integral with ξ = ω/λ*²."""
    w, lam = symbols("omega lambda")
    xi = w / lam**2
    assembled = sp.pi * xi / sp.sinh(sp.pi * xi / 2) / lam
    stated = (w / lam) / sp.sinh(sp.pi * w / (2 * lam))
    ratio = sp.simplify(assembled / stated)
    need(differs(ratio.subs(w, 1), sp.pi), "the ratio is constant")
    slow = sp.limit(ratio.subs(w, 1), lam, 0, "+")
    need(slow == 0, "the ratio stays bounded", limit=slow)
    return refuted(
        "with ξ = ω/λ*² the integral is (πω/λ*³)/sinh(πω/(2λ*²)): the argument of sinh is another, "
        "and no bounded α_M makes up for it, as the quotient of the two tends to 0 with λ*. (One "
        "of the λ* comes from counting the slow time twice, slow.separatrix-angle.)",
        "Quotient and limit by sympy.",
    )


@claim("eq:Melnikov-A", Kind.CONSISTENCY, stated="α_M(μ) positive and bounded, A explicit")
def hidden_factor() -> Verdict:
    """A and B are explicitly identified, with α_M a positive bounded function."""
    return uncheckable(
        "α_M 'collects the Birkhoff prefactors κ₀ and a normalization factor', none of which is "
        "given: that it is positive and bounded is neither shown nor checkable",
        "No formula for κ₀, α₀, β₀ or the coordinates is given anywhere.",
    )


@claim("thm:melnikov", Kind.THEOREM, stated="|A| > |B| for some μ in (0, μ₀)")
def amplitudes() -> Verdict:
    """For each small μ with |A| > |B| the function has transverse zeros."""
    w, lam, F, f, bound = symbols("omega lambda F f bound")
    A = 2 * sp.pi * F * (w / lam) / sp.sinh(sp.pi * w / (2 * lam)) * bound
    B = 2 * f * sp.pi / lam
    ratio = sp.simplify(A / B)
    identity("the quotient", ratio, F * w * bound / (f * sp.sinh(sp.pi * w / (2 * lam))))
    limit = sp.limit(ratio.subs({w: 1, F: 1, f: 1, bound: 1}), lam, 0, "+")
    need(limit == 0, "the quotient does not vanish", limit=limit)
    return vacuous(
        "with these A and B and α_M bounded, |A|/|B| = (F/f) ω α_M/sinh(πω/(2λ*)) tends to 0, "
        "exponentially in 1/λ*, as μ -> 0: the condition fails for all small μ, where the theorem "
        "is stated",
        "Limit by sympy, λ* -> 0 with μ.",
    )


@claim("rem:melnikov-existence", Kind.STEP, stated="the regime |A| > |B| is non-trivial in ω")
def regime_in_frequency() -> Verdict:
    """As |A|/|B| varies with ω, the regime |A| > |B| is non-trivial."""
    w, lam = symbols("omega lambda")
    factor = w / sp.sinh(sp.pi * w / (2 * lam))
    most = sp.limit(factor, w, 0, "+")
    identity("the largest value, at ω = 0", most, 2 * lam / sp.pi)
    x = symbols("x")
    slope = sp.diff(x / sp.sinh(x), x) * sp.sinh(x) ** 2
    identity("x/sinh x decreases", slope, sp.sinh(x) - x * sp.cosh(x))
    return refuted(
        "it is not shown to be non-empty: ω/sinh(πω/(2λ*)) is at most 2λ*/π, so |A| > |B| needs "
        "α_M λ* > πf/(2F), which fails for all ω when λ* is small",
        "x/sinh x decreases from 1: sinh x - x cosh x < 0, as tanh x < x. Openness alone says "
        "nothing.",
    )


@claim("thm:melnikov", Kind.STEP, stated="zeros iff |A| >= |B|, transverse iff |A| > |B|")
def zeros_of_the_function() -> Verdict:
    """A cos ωt₀ + B has zeros iff |A| >= |B|, and simple ones iff |A| > |B|."""
    A, B, w, t = sp.symbols("A B omega t", real=True)
    M = A * sp.cos(w * t) + B
    slope = sp.diff(M, t)
    identity(
        "M'² at a zero", slope**2 - w**2 * (A**2 - B**2) - (-(w**2) * (M - B) ** 2 + w**2 * B**2)
    )
    return confirmed("true: at a zero M'² = ω²(A² - B²)", "M'² = ω²(A² - (M - B)²), by sympy.")
