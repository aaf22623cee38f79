"""Section 6: the slow Hamiltonian of Proposition 6.1 and its separatrix, on their own terms."""

from typing import Any, NamedTuple

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import differs, formula, identity, same, symbols
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.verdict import Verdict, confirmed, corrected, imprecise, refuted, vacuous


class Slow(NamedTuple):
    """H₀ = ω₀ I + μ^(1/2) (α₀ I² - β₀ cos φ), and its symbols."""

    H: Any
    action: Any
    phi: Any
    omega0: Any
    alpha: Any
    beta: Any
    mu: Any


def slow_hamiltonian() -> Slow:
    """Return H₀ of Proposition 6.1."""
    action, phi = sp.symbols("I phi", real=True)
    omega0, alpha, beta, mu = symbols("omega0 alpha beta mu")
    H = omega0 * action + sp.sqrt(mu) * (alpha * action**2 - beta * sp.cos(phi))
    return Slow(H, action, phi, omega0, alpha, beta, mu)


def equilibrium(h: Slow) -> Any:
    """Return the action of the equilibria."""
    return sp.solve(sp.diff(h.H, h.action), h.action)[0]


def hessian(h: Slow, phi: Any) -> Any:
    """Return the determinant of the Hessian at an equilibrium."""
    second = sp.Matrix([[sp.diff(h.H, a, b) for b in (h.action, h.phi)] for a in (h.action, h.phi)])
    return sp.simplify(second.det().subs(h.phi, phi))


@claim("prop:slow-Ham", Kind.FORMULA, stated="I = -ω₀/(2 μ^(1/2) α₀), saddle at π, center at 0")
def equilibria() -> Verdict:
    """H₀ has a saddle at (-ω₀/(2μ^(1/2)α₀), π) and a center at (-ω₀/(2μ^(1/2)α₀), 0)."""
    h = slow_hamiltonian()
    identity("the action", equilibrium(h), -h.omega0 / (2 * sp.sqrt(h.mu) * h.alpha))
    need(hessian(h, sp.pi).is_negative is True, "φ = π is no saddle")
    need(hessian(h, sp.S.Zero).is_positive is True, "φ = 0 is no center")
    return confirmed("as stated, for this H₀", "Gradient and Hessian by sympy.")


@claim("eq:lambda-star", Kind.FORMULA, stated="λ* = μ^(1/4) (4α₀β₀)^(1/2)")
def saddle_eigenvalue() -> Verdict:
    """The eigenvalue at the saddle of H₀ is λ* = μ^(1/4) (4α₀β₀)^(1/2) (1 + O(μ^(1/2)))."""
    h = slow_hamiltonian()
    squared = sp.simplify(-hessian(h, sp.pi))
    identity("λ² is 2α₀β₀μ", squared, 2 * h.alpha * h.beta * h.mu)
    return formula(
        sp.sqrt(squared),
        h.mu ** sp.Rational(1, 4) * sp.sqrt(4 * h.alpha * h.beta),
        "λ² = -det Hess H₀ at (I, π), by sympy.",
        "λ* = μ^(1/2) (2α₀β₀)^(1/2), exactly",
    )


@claim("eq:Hamiltonian-IF", Kind.CONSISTENCY, stated="coordinates on a neighbourhood, |R| bounded")
def equilibria_leave() -> Verdict:
    """The coordinates are valid on a fixed neighbourhood of the colliding orbit, and the remainder
    is bounded on bounded sets.
    """
    h = slow_hamiltonian()
    need(sp.limit(equilibrium(h), h.mu, 0, "+") == -sp.oo, "the equilibria stay bounded")
    return vacuous(
        "the saddle and the center of H₀ lie at I = -ω₀/(2α₀ μ^(1/2)), which tends to -∞ as μ -> "
        "0: they leave every neighbourhood and every bounded set on which the formula is claimed",
        "Limit by sympy.",
    )


@claim("prop:slow-Ham", Kind.CONSISTENCY, stated="saddle and center collide at μ = 0")
def equilibria_do_not_collide() -> Verdict:
    """H₀ describes two fixed points that collide as μ -> 0."""
    h = slow_hamiltonian()
    places = sp.solve(sp.diff(h.H, h.phi), h.phi)
    need(places == [0, sp.pi], "the equilibria are elsewhere, or move with μ")
    x, y, mu = sp.symbols("x y mu", real=True)
    fold = y**2 / 2 + x**3 / 3 - mu * x
    roots = sp.solve(sp.diff(fold, x), x)
    need(all(same(root**2, mu) for root in roots), "the fold has other equilibria")
    return refuted(
        "they are π apart in φ for every μ. Near a saddle-center the slow Hamiltonian is cubic, "
        "y²/2 + x³/3 - μx up to scaling: equilibria at ±μ^(1/2), eigenvalue of order μ^(1/4), a "
        "separatrix with profile sech², and no pendulum",
        "Critical points by sympy.",
        proof="melnikov.md#the-slow-hamiltonian-of-a-fold",
    )


@claim("prop:slow-Ham", Kind.STEP, stated="Φ₀(p, q) = (p + q, q + a(p; μ))")
def normal_form_map() -> Verdict:
    """Step 1: the symplectic normal form of the Jordan block is (p, q) -> (p + q, q + a(p; μ) +
    ..).
    """
    p, q = sp.symbols("p q", real=True)
    a = sp.Function("a")
    image = sp.Matrix([p + q, q + a(p)])
    det = image.jacobian([p, q]).det()
    identity("its determinant", det, 1 - sp.diff(a(p), p))
    true = sp.Matrix([p + q + a(p), q + a(p)]).jacobian([p, q]).det()
    identity("the determinant of the corrected map", true, 1)
    need(differs(det.subs(sp.diff(a(p), p), symbols("slope")), sp.Integer(1)), "it preserves area")
    return corrected(
        "(p, q) -> (p + q', q'), q' = q + a(p; μ): the map as stated has the determinant 1 - a'(p)",
        "Jacobian determinants by sympy.",
    )


@claim("prop:slow-Ham", Kind.WORDS, stated="saddle and center, joined by a homoclinic loop")
def homoclinic_loop() -> Verdict:
    """The saddle and the center are joined by a homoclinic loop."""
    h = slow_hamiltonian()
    level = [h.H.subs({h.phi: phi, h.action: equilibrium(h)}) for phi in (sp.pi, 0)]
    gap = sp.simplify(level[0] - level[1])
    identity("the energies differ", gap, 2 * sp.sqrt(h.mu) * h.beta)
    need(gap.is_positive is True, "the energies are the same")
    return imprecise(
        "separatrices join the saddle to itself and surround the center; saddle and center have "
        "different energies, 2μ^(1/2)β₀ apart",
        "H₀ at both equilibria by sympy.",
    )


@claim("prop:slow-Ham", Kind.CONSISTENCY, stated="action-angle coordinates (I, φ)")
def action_angle() -> Verdict:
    """(I, φ) are action-angle variables of the slow Hamiltonian (Liouville-Arnold)."""
    h = slow_hamiltonian()
    slope = sp.diff(h.H, h.phi)
    need(differs(slope.subs(h.phi, sp.pi / 3), sp.S.Zero), "H₀ does not depend on φ")
    return refuted(
        "in action-angle variables the Hamiltonian is a function of the action alone; H₀ depends "
        "on φ, and a neighbourhood of a saddle has no action-angle variables",
        "∂H₀/∂φ = μ^(1/2) β₀ sin φ.",
    )


@claim("prop:slow-Ham", Kind.CONSISTENCY, stated="β₀ = c²/(4α₀), c of eq:saddle-asymp")
def exponents() -> Verdict:
    """Step 4: β₀ = c²/(4α₀), c from the multipliers 1 ± c μ^(1/2), ensures λ* =
    μ^(1/4)(4α₀β₀)^(1/2).
    """
    mu, c = symbols("mu c")
    stated = mu ** sp.Rational(1, 4) * c  # λ* with 4α₀β₀ = c²
    multiplier = c * sp.sqrt(mu)
    ratio = sp.limit(multiplier / stated, mu, 0, "+")
    need(ratio == 0, "the exponents agree")
    return refuted(
        "with 4α₀β₀ = c² formula eq:lambda-star gives λ* = c μ^(1/4), while the multipliers 1 ± c "
        "μ^(1/2) of eq:saddle-asymp grow like exp(±c μ^(1/2)): two different powers of μ",
        "The ratio of the two tends to 0 with μ, by sympy. (True at a fold: μ^(1/4), see "
        "fold.multipliers-of-a-fold.)",
    )


@claim("prop:slow-Ham", Kind.CONSISTENCY, stated="ω₀ > 0 constant, rotation rate of the branch")
def rotation_rate() -> Verdict:
    """Step 4: ω₀ = c̃ is the linearised rotation rate as μ -> 0."""
    mu, c = symbols("mu c")
    need(sp.limit(c * sp.sqrt(mu), mu, 0) == 0, "the rate does not vanish")
    h = slow_hamiltonian()
    frequency = sp.sqrt(hessian(h, sp.S.Zero))
    need(h.omega0 not in frequency.free_symbols, "the frequency depends on ω₀")
    return refuted(
        "the rotation rate tends to 0 with μ, a coefficient of it is no rate; and the frequency of "
        "H₀ at its center, (2α₀β₀μ)^(1/2), does not contain ω₀ at all",
        "Hessian of H₀ by sympy.",
    )


@claim("eq:varphi-tanh", Kind.FORMULA, stated="φ = π - 2 arctan(sinh(λ* s))")
def separatrix_angle() -> Verdict:
    """On the separatrix φ = π - 2 arctan(sinh(λ* s)), in slow time s."""
    s, lam = symbols("s lambda")
    stated = sp.pi - 2 * sp.atan(sp.sinh(lam * s))
    ends = [sp.limit(stated, s, end) for end in (sp.oo, -sp.oo)]
    need(sp.simplify(ends[0]) == 0, "it ends elsewhere")
    true = 2 * sp.atan(sp.sinh(lam * s))
    for angle, sign in ((true, -1), (stated, 1)):  # φ'' = ∓λ² sin φ
        sine = 2 * sp.tan(angle / 2) / (1 + sp.tan(angle / 2) ** 2)
        residue = sp.simplify((sp.diff(angle, s, 2) - sign * lam**2 * sine).rewrite(sp.exp))
        need(residue == 0, "the differential equation is another", sign=sign)
    return corrected(
        "φ = 2 arctan(sinh(λ* t)), in the time t of H₀, from -π to π. The stated one runs from 2π "
        "to 0, from the center to the center, and solves φ'' = +λ² sin φ; and it has λ* twice, as "
        "s is λ* t already",
        "φ'' = -λ² sin φ, λ² = 2α₀β₀μ, follows from H₀; both profiles substituted, by sympy.",
    )


@claim("eq:varphi-tanh", Kind.FORMULA, stated="I - I_sad = -2μ^(1/2) α₀ sech(λ* s)")
def separatrix_action() -> Verdict:
    """On the separatrix I - I_sad = -2μ^(1/2) α₀ sech(λ* s)."""
    t, alpha, beta, mu = symbols("t alpha beta mu")
    lam = sp.sqrt(2 * alpha * beta * mu)
    phi = 2 * sp.atan(sp.sinh(lam * t))
    action = sp.diff(phi, t) / (2 * sp.sqrt(mu) * alpha)  # φ' = 2μ^(1/2) α₀ (I - I_sad)
    true = sp.sqrt(2 * beta / alpha) * sp.sech(lam * t)
    identity("I - I_sad", sp.simplify((action - true).rewrite(sp.exp)))
    return formula(
        sp.sqrt(2 * beta / alpha),
        2 * sp.sqrt(mu) * alpha,
        "φ' = ∂H₀/∂I along φ = 2 arctan(sinh(λ t)), by sympy; the sign is that of φ'.",
        "amplitude ±(2β₀/α₀)^(1/2), which does not depend on μ",
    )


@claim("lem:tanh-profile", Kind.NUMBER, stated="energy level zero")
def separatrix_energy() -> Verdict:
    """The separatrix is at the energy level zero."""
    h = slow_hamiltonian()
    level = sp.simplify(h.H.subs({h.phi: sp.pi, h.action: equilibrium(h)}))
    return formula(
        level,
        sp.S.Zero,
        "H₀ at the saddle, by sympy. After removal of a constant the pendulum has μ^(1/2)β₀ there.",
        "μ^(1/2) β₀ - ω₀²/(4α₀ μ^(1/2))",
    )


@claim("def:melnikov", Kind.CONSISTENCY, stated="parametrised so that φ(0) = π/2")
def parametrisation() -> Verdict:
    """The homoclinic of Lemma 6.2 is parametrised so that φ(0) = π/2."""
    s, lam = symbols("s lambda")
    stated = (sp.pi - 2 * sp.atan(sp.sinh(lam * s))).subs(s, 0)
    true = (2 * sp.atan(sp.sinh(lam * s))).subs(s, 0)
    need(stated == sp.pi and true == 0, "other values at 0")
    return refuted(
        "eq:varphi-tanh has φ(0) = π, the separatrix of H₀ in the symmetric parametrisation φ(0) = "
        "0; with φ(0) = π/2 the symmetry s -> -s that the proof uses is lost",
        "Both profiles at 0.",
    )


@claim("thm:melnikov", Kind.STEP, stated="φ(-s) = 2π - φ(s), I(-s) = I(s)")
def symmetry_of_the_profile() -> Verdict:
    """φ(-s) = 2π - φ(s), so sin φ is odd, and I is even."""
    s, lam = symbols("s lambda")
    stated = sp.pi - 2 * sp.atan(sp.sinh(lam * s))
    identity("φ(-s) + φ(s)", stated + stated.subs(s, -s), 2 * sp.pi)
    identity("sech is even", sp.sech(-lam * s), sp.sech(lam * s))
    return confirmed("true of eq:varphi-tanh; for the separatrix, φ(-s) = -φ(s)", "By sympy.")
