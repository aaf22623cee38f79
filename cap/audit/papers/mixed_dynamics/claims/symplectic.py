"""Section 3.2: Theorem 3.3 and its proof."""

from cap.audit.means.algebra import identity, reals, same
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need


def symplectic() -> None:
    d, k = reals("d k")
    J = sp.Matrix([[0, 1], [-1, 0]])
    flight, hit = sp.Matrix([[1, d], [0, 1]]), sp.Matrix([[-1, 0], [k, -1]])
    for name, M in (("flight", flight), ("hit", hit)):
        need(same(M.T * J * M, J), f"a {name} does not preserve dv ∧ dx")


def generating_function() -> None:
    a, t = reals("a t")
    q, p = sp.Function("q")(a, t), sp.Function("p")(a, t)
    H = sp.Function("H")
    Q, P = reals("Q P")
    H_q, H_p = (sp.diff(H(Q, P, t), z).subs({Q: q, P: p}) for z in (Q, P))
    rate = sp.diff(p, t) * sp.diff(q, a) + p * sp.diff(q, a, t)  # of p ∂q/∂a in time
    rate = rate.subs(sp.diff(p, t), -H_q)
    action = sp.diff(p, a) * H_p + p * sp.diff(q, a, t) - H_q * sp.diff(q, a) - H_p * sp.diff(p, a)
    identity("d(p ∂q/∂a)/dt = ∂L/∂a, L = p q' - H", rate, action)
