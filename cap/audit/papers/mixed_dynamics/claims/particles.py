"""Section 9: particles, collisions, signs, and the symplectic form."""

from fractions import Fraction
from itertools import pairwise
from typing import Any

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import differs, identity, reals, same, symbols
from cap.audit.means.balls import precisely
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.verdict import Verdict, confirmed, corrected, imprecise, refuted, vacuous
from cap.sets import interval

EMPTY = "particles.md#no-trajectory-is-sign-preserving-for-ever"


def collision() -> Any:
    """Return the symbols of two masses that collide, as in theorem symplectic."""
    from cap.proofs.symplectic_events import Masses  # noqa: PLC0415 (sympy, where it is needed)

    return Masses.symbols(2)


def derivative(k: Any) -> Any:
    """Return S of the collision, of which the theorem derives everything."""
    from cap.proofs.symplectic_events import saltation  # noqa: PLC0415

    return saltation(k, k.collision, k.normal)


@claim("lem:collision-algebra", Kind.THEOREM, stated="involution; momentum and energy preserved")
def collision_algebra() -> Verdict:
    """The collision map is a linear involution that preserves momentum and kinetic energy,
    exchanges velocities for equal masses, and has four non-zero entries for unequal ones.
    """
    k = collision()
    C, (m1, m2) = k.collision, k.m
    need(same(C * C, sp.eye(2)), "it is no involution")
    v = sp.Matrix(k.v)
    momentum, mass = sp.Matrix([[m1, m2]]), sp.diag(m1, m2)
    identity("momentum", (momentum * (C * v - v))[0])
    identity("energy", ((C * v).T * mass * (C * v) - v.T * mass * v)[0])
    swap = C.subs(m2, m1)
    need(same(swap, sp.Matrix([[0, 1], [1, 0]])), "equal masses do not exchange velocities")
    zeros = [sp.solve(entry, m1) for entry in C]
    need(zeros == [[m2], [], [], [m2]], "an entry vanishes for unequal masses", zeros=zeros)
    return confirmed("all of it", "By sympy; the entries m₁ - m₂ vanish for equal masses only.")


@claim("lem:massweight", Kind.THEOREM, stated="an orthogonal reflection in (η_i, η_(i+1))")
def mass_weighted_collision() -> Verdict:
    """In ξ = sqrt(m) x, η = sqrt(m) x' the collision is the orthogonal reflection in the hyperplane
    ξ_i/sqrt(m_i) = ξ_(i+1)/sqrt(m_(i+1)), and the kinetic energy is Euclidean.
    """
    k = collision()
    root = sp.diag(*(sp.sqrt(m) for m in k.m))
    Q = (root * k.collision * root.inv()).applyfunc(sp.simplify)
    need(same(Q * Q.T, sp.eye(2)), "it is not orthogonal")
    identity("its determinant", Q.det(), -1)
    normal = sp.Matrix([1 / sp.sqrt(k.m[0]), -1 / sp.sqrt(k.m[1])])
    need(same(Q * normal, -normal), "it does not reverse the normal")
    return confirmed("as stated", "By sympy: orthogonal, determinant -1, normal reversed.")


@claim("ssec:multi-model", Kind.STEP, stated="the lift needs the signs to be preserved")
def condition_at_a_collision() -> Verdict:
    """For the construction to apply the signs of both velocities must be preserved at each
    collision.
    """
    k = collision()
    S, J = derivative(k), k.form
    defect = (S.T * J * S - J).applyfunc(sp.simplify)
    (f1, f2), (s1, s2), (r1, r2) = k.f, k.before, k.after
    jump = f1 * (r1 - s1) + f2 * (r2 - s2)
    identity("the defect", defect[1, 0], jump / (k.v[0] - k.v[1]))
    rest = defect.copy()
    rest[1, 0] = rest[0, 1] = 0
    need(same(rest, sp.zeros(4)), "there are other defects")
    head_on = jump.subs({s1: 1, r1: -1, s2: -1, r2: 1})
    identity("head-on, both reversed", head_on, 2 * (f2 - f1))
    return corrected(
        "the condition is Σ f_i (s_i⁺ - s_i⁻) = 0 at each collision: signs kept, or, for equal "
        "friction forces, both reversed head-on. A single reversal is not symplectic",
        "Sᵀ J S - J for the derivative S of a collision, from two neighbouring orbits, J that of "
        "Σ m_i dv_i ∧ dx_i: its only entries are ± Σ f_i Δs_i/(v₁ - v₂), by sympy.",
    )


@claim("def:signpres", Kind.THEOREM, stated="the maximal forward-invariant subset Ω_NS^(N)")
def never_stopping_set_is_empty() -> Verdict:
    """Ω_NS^(N), the set that Section 9 is about, has elements for N >= 2."""
    k = collision()
    (m1, m2), (v1, v2) = k.m, k.v
    closing = symbols("closing")
    change = (k.collision * sp.Matrix([v1, v2]))[0] - v1
    identity("a collision slows the left one", change, -2 * m2 * (v1 - v2) / (m1 + m2))
    need(change.subs(v1, v2 + closing).simplify().is_negative is True, "it speeds it up")
    t, F, f, w, m = symbols("t F f omega m")
    drift = sp.integrate((F * sp.cos(w * t) - f) / m, (t, 0, 2 * sp.pi / w))
    identity("a particle that moves right loses in each period", drift, -2 * sp.pi * f / (w * m))
    return vacuous(
        "for N >= 2 and f > 0 it is empty. A particle that never changes its sign "
        "slows down for ever under friction; what turns particles round, head-on collisions in "
        "which both signs change, is what the definition forbids",
        "Momentum of a block of particles that move away from its right neighbour: signs of the "
        "changes by collisions and by friction, by sympy; the argument in four steps.",
        proof=EMPTY,
    )


@claim("thm:multiparticle", Kind.THEOREM, stated="Φ^(N) on Ω_NS^(N) is exact symplectic")
def symplecticity() -> Verdict:
    """Φ^(N) restricted to Ω_NS^(N) is exact symplectic."""
    drift_is_negative()
    return vacuous(
        "Ω_NS^(N) is empty for N >= 2 (particles.never-stopping-set-is-empty). With the condition "
        "Σ f_i Δs_i = 0 at collisions in place of Definition 9.2, Φ^(N) preserves Σ m_i dv_i ∧ "
        "dx_i on the open set of states whose first period satisfies it, without simultaneous "
        "events",
        "The sign of the drift by sympy; symplecticity: particles.condition-at-a-collision.",
        proof=EMPTY,
    )


def drift_is_negative() -> None:
    """Raise `NotProved` unless friction takes momentum from whoever moves right for a period."""
    t, F, f, w = symbols("t F f omega")
    drift = sp.integrate(F * sp.cos(w * t) - f, (t, 0, 2 * sp.pi / w))
    need(sp.simplify(drift).is_negative is True, "the drift is not negative")


@claim("thm:multiparticle", Kind.FORMULA, stated="ω_N = Σ dv_i ∧ dx_i")
def invariant_form() -> Verdict:
    """The form that is preserved is the standard form Σ dv_i ∧ dx_i."""
    k = collision()
    kept = {k.after[0]: k.before[0], k.after[1]: k.before[1]}  # signs are preserved
    S = derivative(k).subs(kept)
    weighted, plain = k.form, k.form.subs(dict.fromkeys(k.m, 1))
    need(same(S.T * weighted * S, weighted), "the weighted form is not preserved")
    defect = (S.T * plain * S - plain).applyfunc(sp.simplify)
    need(differs(defect[2, 0], sp.S.Zero), "the standard form is preserved")
    return corrected(
        "Σ m_i dv_i ∧ dx_i; the standard form is preserved for equal masses only",
        "Sᵀ J S = J for the weighted form and not for the other, S the derivative of a collision "
        "that keeps the signs, by sympy.",
    )


@claim("thm:multiparticle", Kind.STEP, stated="the m_i cancels: Σ dv_i ∧ dx_i = Σ dη_i ∧ dξ_i")
def weights() -> Verdict:
    """(i) Σ dv_i ∧ dx_i pulls back to Σ dη_i ∧ dξ_i, since the m_i cancels."""
    m = symbols("m")
    factor = sp.sqrt(m) * sp.sqrt(m)
    identity("dη ∧ dξ", factor, m)
    need(differs(factor, sp.Integer(1)), "the factor is 1")
    return refuted(
        "dη_i ∧ dξ_i = m_i dv_i ∧ dx_i: nothing cancels", "ξ = sqrt(m) x, η = sqrt(m) x'."
    )


@claim("thm:multiparticle", Kind.THEOREM, stated="Leb(Φ^(N)(A)) = Leb(A)")
def volume() -> Verdict:
    """Φ^(N) preserves the Lebesgue measure."""
    S = derivative(collision())
    identity("the determinant", S.det(), 1)
    return confirmed(
        "true as long as no velocity vanishes, whatever happens to the signs at collisions: the "
        "derivative of a collision has determinant 1",
        "det S = (det C)² = 1, by sympy, for all signs. (On Ω_NS^(N), which is empty, too.)",
    )


@claim("thm:multiparticle", Kind.STEP, stated="N + 1 faces")
def faces_of_the_polytope() -> Verdict:
    """(ii) The polytope of configurations has N + 1 faces: two walls, N - 1 collisions."""
    for n in range(2, 7):
        corners = [tuple(1 if j >= i else 0 for j in range(n)) for i in range(n + 1)]
        constraints = [lambda x: x[0] - 0, *_gaps(n), lambda x: 1 - x[-1]]
        tight = [[g(corner) == 0 for corner in corners] for g in constraints]
        need(all(sum(row) == n for row in tight), "a face has another number of corners")
        need(len(constraints) == n + 1, "the number of faces is another")
    return confirmed(
        "a simplex: N + 1 faces, of N corners each",
        "Corners and faces enumerated for N = 2, .., 6.",
    )


def _gaps(n: int) -> list[Any]:
    return [lambda x, i=i: x[i + 1] - x[i] for i in range(n - 1)]


@claim("thm:multiparticle", Kind.STEP, stated="an affine Coxeter group, P_N a fundamental domain")
def tessellation() -> Verdict:
    """(ii) The reflections generate an affine Coxeter group of which the polytope is a fundamental
    domain.
    """
    m1, m2 = symbols("m1 m2")
    wall, diagonal = sp.Matrix([1, 0]), sp.Matrix([1 / sp.sqrt(m1), -1 / sp.sqrt(m2)])
    cosine = (wall.T * diagonal)[0] / sp.sqrt((diagonal.T * diagonal)[0])
    identity("cos² of the angle of two mirrors", cosine**2, m2 / (m1 + m2))
    with precisely():
        angle = interval.ball(Fraction(9, 10)).sqrt().atan()  # tan² = m₁/m₂ or m₂/m₁
        quotient = interval.pi() / angle
        need(4 < quotient < 5, "π over the angle may be an integer", quotient=quotient)
    return refuted(
        "for N = 2 the polytope is a right triangle with the angles arctan sqrt(m₂/m₁) and its "
        "complement; its reflections tile the plane for m₂/m₁ in {1, 3, 1/3} only, and not for "
        "0.9: π over the angle lies between 4 and 5",
        "Angle of the normals by sympy, for m₂/m₁ = 0.9 in balls. No tessellation is needed: "
        "flights, hits and collisions compose.",
        proof="particles.md#triangles-that-tile-the-plane",
    )


@claim("thm:multiparticle", Kind.NUMBER, stated="type Ã_(N-1)")
def type_of_the_group() -> Verdict:
    """(ii) The group is of type Ã_(N-1)."""
    normals = [sp.Matrix([1, 0]), sp.Matrix([1, -1]) / sp.sqrt(2), sp.Matrix([0, 1])]
    cosines = [(a.T * b)[0] for a, b in pairwise(normals)]
    need(all(same(c**2, sp.Rational(1, 2)) for c in cosines), "the angles are not π/4")
    return corrected(
        "at equal masses, where there is one, it is of type C̃_N: N + 1 mirrors in R^N, with "
        "angles π/4 at the walls. Ã_(N-1) has N mirrors, and acts on R^(N-1)",
        "For N = 2 the three mirrors make the angles π/4, π/4, π/2: C̃₂.",
        proof="particles.md#triangles-that-tile-the-plane",
    )


@claim("eq:HN-lift", Kind.FORMULA, stated="H_N gives eq:Nparticle on flights")
def lifted_hamiltonian() -> Verdict:
    """The Hamilton equations of H_N are eq:Nparticle on each flight."""
    xi, eta, c, sigma = reals("xi eta c sigma")
    m, f = symbols("m f")
    H = eta**2 / 2 - c * xi / sp.sqrt(m) + f * sigma * xi / sp.sqrt(m)
    acceleration = -sp.diff(H, xi) / sp.sqrt(m)  # x'' = ξ''/sqrt(m)
    identity("m x'' = c - f σ", m * acceleration, c - f * sigma)
    return confirmed("true", "Differentiated by sympy, one particle at a time.")


@claim("eq:HN-lift", Kind.STEP, stated="the Hamiltonian is invariant under the reflections")
def invariance_of_the_hamiltonian() -> Verdict:
    """(ii) The orthogonality of the reflections preserves the Hamiltonian."""
    k = collision()
    x = sp.Matrix(reals("x1 x2"))
    (f1, f2), (s1, s2) = k.f, k.before
    # in mass-weighted coordinates positions are reflected as velocities are: x -> C x
    potential = -k.c[0] * (x[0] + x[1]) + f1 * s1 * x[0] + f2 * s2 * x[1]
    reflected = k.collision * x
    moved = potential.subs({x[0]: reflected[0], x[1]: reflected[1]}, simultaneous=True)
    change = sp.simplify(moved - potential)
    need(differs(change.subs({s1: 1, s2: 1}), sp.S.Zero), "the Hamiltonian is invariant")
    return refuted(
        "neither the forcing term nor the friction term is invariant: Σ x_i is not preserved by "
        "the reflection for unequal masses, and Σ σ_i x_i is not for fixed signs",
        "The potential at a point and at its mirror image, by sympy.",
    )


@claim("thm:multiparticle", Kind.STEP, stated="transitions are orthogonal, hence symplectic")
def transitions() -> Verdict:
    """(iii) At a collision the transition is an orthogonal reflection of (ξ, η), hence
    symplectic.
    """
    k = collision()
    S = derivative(k)
    need(
        differs(S[2, 0].subs(dict.fromkeys(k.before, 1) | dict.fromkeys(k.after, -1)), sp.S.Zero),
        "K = 0",
    )
    flipped = S.subs({k.before[0]: 1, k.before[1]: 1, k.after[0]: -1, k.after[1]: 1})
    J = k.form
    defect = (flipped.T * J * flipped - J).applyfunc(sp.simplify)
    need(differs(defect[1, 0], sp.S.Zero), "one flipped sign is symplectic")
    return refuted(
        "the derivative of a collision is ((C, 0), (K, C)) with K != 0, because the time of the "
        "collision depends on the state. The argument would also prove that a collision that flips "
        "one sign is symplectic, which it is not",
        "From two neighbouring orbits, by sympy (cap.proofs.symplectic_events).",
    )


@claim("thm:multiparticle", Kind.STEP, stated="orthogonal maps preserve Σ η_i dξ_i")
def canonical_one_form() -> Verdict:
    """(iii) The reflections preserve the form Σ η_i dξ_i, so generating functions fit together."""
    k = collision()
    root = sp.diag(*(sp.sqrt(m) for m in k.m))
    Q = (root * k.collision * root.inv()).applyfunc(sp.simplify)
    eta, dxi = sp.Matrix(reals("e1 e2")), sp.Matrix(reals("d1 d2"))
    identity("(Qη)·(Qdξ)", ((Q * eta).T * (Q * dxi) - eta.T * dxi)[0])
    return imprecise(
        "true of the linear maps; but the events happen at times that depend on the state, and H "
        "jumps by x* Σ f_i Δs_i there: Φ*λ - λ = dS - Σ (Σ f_i Δs_i) x* dt* over the collisions, "
        "exact only if the jumps of signs cancel",
        "By sympy, and the action ∫ (Σ p dx - H dt).",
        proof="particles.md#when-a-collision-is-symplectic",
    )
