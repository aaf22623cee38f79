"""Section 9: particles, collisions, signs, and the symplectic form."""

from typing import Any

from cap.audit.means.algebra import differs, identity, reals, same, symbols
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need


def collision() -> Any:
    """Return the symbols of two masses that collide, as in theorem symplectic."""
    from cap.proofs.symplectic_events import Masses  # noqa: PLC0415 (sympy, where it is needed)

    return Masses.symbols(2)


def derivative(k: Any) -> Any:
    """Return S of the collision, of which the theorem derives everything."""
    from cap.proofs.symplectic_events import saltation  # noqa: PLC0415

    return saltation(k, k.collision, k.normal)


def collision_algebra() -> None:
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


def mass_weighted_collision() -> None:
    k = collision()
    root = sp.diag(*(sp.sqrt(m) for m in k.m))
    Q = (root * k.collision * root.inv()).applyfunc(sp.simplify)
    need(same(Q * Q.T, sp.eye(2)), "it is not orthogonal")
    identity("its determinant", Q.det(), -1)
    normal = sp.Matrix([1 / sp.sqrt(k.m[0]), -1 / sp.sqrt(k.m[1])])
    need(same(Q * normal, -normal), "it does not reverse the normal")


def condition_at_a_collision() -> None:
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


def never_stopping_set_is_empty() -> None:
    k = collision()
    (m1, m2), (v1, v2) = k.m, k.v
    closing = symbols("closing")
    change = (k.collision * sp.Matrix([v1, v2]))[0] - v1
    identity("a collision slows the left one", change, -2 * m2 * (v1 - v2) / (m1 + m2))
    need(change.subs(v1, v2 + closing).simplify().is_negative is True, "it speeds it up")
    t, F, f, w, m = symbols("t F f omega m")
    drift = sp.integrate((F * sp.cos(w * t) - f) / m, (t, 0, 2 * sp.pi / w))
    identity("a particle that moves right loses in each period", drift, -2 * sp.pi * f / (w * m))


def invariant_form() -> None:
    k = collision()
    kept = {k.after[0]: k.before[0], k.after[1]: k.before[1]}  # signs are preserved
    S = derivative(k).subs(kept)
    weighted, plain = k.form, k.form.subs(dict.fromkeys(k.m, 1))
    need(same(S.T * weighted * S, weighted), "the weighted form is not preserved")
    defect = (S.T * plain * S - plain).applyfunc(sp.simplify)
    need(differs(defect[2, 0], sp.S.Zero), "the standard form is preserved")


def volume() -> None:
    S = derivative(collision())
    identity("the determinant", S.det(), 1)


def faces_of_the_polytope() -> None:
    for n in range(2, 7):
        corners = [tuple(1 if j >= i else 0 for j in range(n)) for i in range(n + 1)]
        constraints = [lambda x: x[0] - 0, *_gaps(n), lambda x: 1 - x[-1]]
        tight = [[g(corner) == 0 for corner in corners] for g in constraints]
        need(all(sum(row) == n for row in tight), "a face has another number of corners")
        need(len(constraints) == n + 1, "the number of faces is another")


def _gaps(n: int) -> list[Any]:
    return [lambda x, i=i: x[i + 1] - x[i] for i in range(n - 1)]


def invariance_of_the_hamiltonian() -> None:
    k = collision()
    x = sp.Matrix(reals("x1 x2"))
    (f1, f2), (s1, s2) = k.f, k.before
    # in mass-weighted coordinates positions are reflected as velocities are: x -> C x
    potential = -k.c[0] * (x[0] + x[1]) + f1 * s1 * x[0] + f2 * s2 * x[1]
    reflected = k.collision * x
    moved = potential.subs({x[0]: reflected[0], x[1]: reflected[1]}, simultaneous=True)
    change = sp.simplify(moved - potential)
    need(differs(change.subs({s1: 1, s2: 1}), sp.S.Zero), "the Hamiltonian is invariant")


def transitions() -> None:
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


def canonical_one_form() -> None:
    k = collision()
    root = sp.diag(*(sp.sqrt(m) for m in k.m))
    Q = (root * k.collision * root.inv()).applyfunc(sp.simplify)
    eta, dxi = sp.Matrix(reals("e1 e2")), sp.Matrix(reals("d1 d2"))
    identity("(Qη)·(Qdξ)", ((Q * eta).T * (Q * dxi) - eta.T * dxi)[0])
