"""Section 9: particles, collisions, signs, and the symplectic form."""

from typing import Any

from cap.audit.means.algebra import differs, identity, same
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
