"""Section 6: the slow Hamiltonian of Proposition 6.1 and its separatrix, on their own terms."""

from typing import Any, NamedTuple

from cap.audit.means.algebra import same, symbols
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need


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


def equilibria_do_not_collide() -> None:
    h = slow_hamiltonian()
    places = sp.solve(sp.diff(h.H, h.phi), h.phi)
    need(places == [0, sp.pi], "the equilibria are elsewhere, or move with μ")
    x, y, mu = sp.symbols("x y mu", real=True)
    fold = y**2 / 2 + x**3 / 3 - mu * x
    roots = sp.solve(sp.diff(fold, x), x)
    need(all(same(root**2, mu) for root in roots), "the fold has other equilibria")
