"""Section 3.1 and 3.2: the triangular wave, the lifted Hamiltonian, the lift of orbits."""

from typing import Any

from cap.audit.means.algebra import identity, symbols
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need


def branches(q: Any) -> tuple[Any, Any]:
    """Return W on [0, 1) and on [1, 2), as in eq:Wq."""
    return q, 2 - q


def hamilton_equations() -> None:
    q, p, t = sp.symbols("q p t", real=True)
    F, f, R, w = symbols("F f R omega")
    W = sp.Function("W")(q)
    H = p**2 / 2 - F / R * sp.cos(w * t) * W + f / R * q
    identity("q' = p", sp.diff(H, p), p)
    derived = -sp.diff(H, q)
    stated = F / R * sp.cos(w * t) * sp.diff(W, q) - f / R
    identity("p'", derived, stated)


def divergence() -> None:
    q, p, t = sp.symbols("q p t", real=True)
    H = sp.Function("H")(q, p, t)
    identity("div X_H", sp.diff(H, p, q) - sp.diff(H, q, p))


def dihedral_group() -> None:
    q, w = sp.symbols("q w", real=True)
    up, down = branches(q)
    identity("-q, moved by 2, is on the other branch: W(2 - q) = W(q)", down.subs(q, 2 - q), up)
    fibre = [root for branch in (up, down) for root in sp.solve(branch - w, q)]
    need(len(fibre) == 2, "W takes a value more than twice in a period")
    identity("the two are images by the reflection at 1", fibre[0] + fibre[1], 2)
