"""Lemmas of `cap.proofs.symplectic`: the derivatives of flights, hits and collisions, in symbols.

The masses m_i, i = 1, .., N, have the velocities v_i, the friction forces f_i and the accelerations
a_i = (c_i - f_i s_i)/m_i, where c_i is the force that acts on i at the moment of the event and s_i
the sign of v_i.  At an event v becomes C v and s becomes s⁺; c does not jump.  In the order (x, v)
the derivative of the event is its *saltation matrix*: neighbouring orbits have it later by τ, and

    S = ∂G + (∂G/∂τ) τ',      τ' = -g'/(∂g/∂τ)      by the implicit function theorem,

where g is the gap that closes, and G leads the deviation (δx, δv) at the time of the event of the
orbit itself to its event with a⁻, through C, and back in time by τ with a⁺.  Forces are frozen at
the event, because their change during τ changes G at the second order only.
"""

from typing import Any, NamedTuple

import sympy as sp

from cap.proofs.identities import identity, need
from cap.proofs.symbolic import Lemma

MASSES = 3  # the two that collide, and one more: of any others each enters by itself, like it


class Masses(NamedTuple):
    """Symbols: masses, friction forces, forces, velocities before, signs before and after."""

    m: tuple[Any, ...]
    f: tuple[Any, ...]
    c: tuple[Any, ...]
    v: tuple[Any, ...]
    before: tuple[Any, ...]
    after: tuple[Any, ...]

    @classmethod
    def symbols(cls, n: int) -> "Masses":
        """Return symbols for everything; a mass that takes no part has the same sign after."""
        m, f = (sp.symbols(f"{name}1:{n + 1}", positive=True) for name in "mf")
        c, v, s, p = (sp.symbols(f"{name}1:{n + 1}", real=True) for name in "cvsp")
        return cls(m, f, c, v, s, (*p[:2], *s[2:]))

    def acceleration(self, signs: tuple[Any, ...]) -> Any:
        """Return the vector of the a_i for these signs."""
        rows = zip(self.m, self.f, self.c, signs, strict=True)
        return sp.Matrix([(c - f * s) / m for m, f, c, s in rows])

    @property
    def collision(self) -> Any:
        """Return C of a collision of 1 and 2: 1 - 2 M⁻¹ n nᵀ/(nᵀ M⁻¹ n), n = (1, -1, 0, ..)."""
        n, inverse = self.normal, sp.diag(*self.m).inv()
        scale = (n.T * inverse * n)[0]
        return (sp.eye(len(n)) - 2 * inverse * n * n.T / scale).applyfunc(sp.cancel)

    @property
    def normal(self) -> Any:
        """Return n = (1, -1, 0, ..)."""
        return sp.Matrix([1, -1, *[0] * (len(self.m) - 2)])

    @property
    def form(self) -> Any:
        """Return the matrix J_M of Σ m_i dv_i ∧ dx_i: the form of (u, w) is uᵀ J_M w."""
        M = sp.diag(*self.m)
        zero = sp.zeros(len(self.m))
        return sp.Matrix(sp.BlockMatrix([[zero, -M], [M, zero]]))

    @property
    def jump(self) -> Any:
        """Return Σ f_i (s_i⁺ - s_i⁻)."""
        rows = zip(self.f, self.before, self.after, strict=True)
        return sum(f * (p - s) for f, s, p in rows)


def saltation(masses: Masses, C: Any, normal: Any) -> Any:
    """Return S for the event at which the gap, along ``normal``, closes and v becomes C v."""
    n = len(masses.m)
    x, u = sp.Matrix(sp.symbols(f"x1:{n + 1}")), sp.Matrix(sp.symbols(f"u1:{n + 1}"))
    tau, deviation = sp.Symbol("tau"), sp.Matrix([*x, *u])
    a, b = masses.acceleration(masses.before), masses.acceleration(masses.after)
    start = sp.Matrix(masses.v) + u
    place, speed = x + start * tau + a * tau**2 / 2, start + a * tau
    out = C * speed
    G = sp.Matrix([*(place - out * tau + b * tau**2 / 2), *(out - b * tau)])
    gap = normal.T * place
    at = dict.fromkeys((*deviation, tau), 0)
    slope = -gap.jacobian(deviation).subs(at) / gap.diff(tau).subs(at)[0]
    return (G.jacobian(deviation).subs(at) + G.diff(tau).subs(at) * slope).applyfunc(sp.cancel)


def defect(masses: Masses, S: Any) -> Any:
    """Return Sᵀ J_M S - J_M."""
    return (S.T * masses.form * S - masses.form).applyfunc(sp.cancel)


def flights() -> Lemma:
    """*Statement.* A flight preserves the form and the volume: its derivative is a shear."""
    p, d = Masses.symbols(MASSES), sp.Symbol("d")
    one, zero = sp.eye(MASSES), sp.zeros(MASSES)
    shear = sp.Matrix(sp.BlockMatrix([[one, d * one], [zero, one]]))
    return Lemma(
        "A flight of the duration d has the derivative S = ((1, d), (0, 1)): S^T J_M S = J_M.",
        (
            identity("S^T J_M S = J_M", defect(p, shear), sp.zeros(2 * MASSES)),
            identity("det S = 1", shear.det(), 1),
        ),
    )


def hits() -> Lemma:
    """*Statement.* A hit of a wall by mass 1 preserves the form, whatever its friction does."""
    p = Masses.symbols(MASSES)
    p = p._replace(after=(p.after[0], *p.before[1:]))
    mirror = sp.diag(-1, *[1] * (MASSES - 1))
    S = saltation(p, mirror, sp.Matrix([1, *[0] * (MASSES - 1)]))
    return Lemma(
        "An elastic hit of a wall has S = ((C, 0), (K, C)), C = diag(-1, 1, ..), which preserves "
        "the form for any jump of the friction.",
        (
            *_blocks(S, mirror),
            identity("S^T J_M S = J_M", defect(p, S), sp.zeros(2 * MASSES)),
        ),
    )


def volume() -> Lemma:
    """*Statement.* det S = 1 at every collision, whatever the signs do."""
    p = Masses.symbols(MASSES)
    S = saltation(p, p.collision, p.normal)
    v, K = sp.Matrix(p.v), S[MASSES:, :MASSES]
    jump = p.acceleration(p.after) - p.collision * p.acceleration(p.before)
    closing = (p.normal.T * v)[0]
    return Lemma(
        "A collision has S = ((C, 0), (K, C)), K = (a+ - C a-) n^T/(n^T v-): det S = 1 always.",
        (
            *_blocks(S, p.collision),
            identity("its lower left block is K", K, jump * p.normal.T / closing),
        ),
    )


def _blocks(S: Any, C: Any) -> tuple[str, ...]:
    n = MASSES
    return (
        identity("its upper left block is C", S[:n, :n], C),
        identity("its lower right block is C", S[n:, n:], C),
        identity("its upper right block is 0", S[:n, n:], sp.zeros(n)),
        identity("det C = -1, so det S = (det C)^2 = 1", C.det(), -1),
    )


def symplectic() -> Lemma:
    """*Statement.* S^T J_M S - J_M has the entries ±Σ f_i Δs_i/(v_1 - v_2) and no others."""
    p = Masses.symbols(MASSES)
    found = defect(p, saltation(p, p.collision, p.normal))
    rate = p.jump / (p.v[0] - p.v[1])
    stated = sp.zeros(2 * MASSES)
    stated[1, 0], stated[0, 1] = rate, -rate
    return Lemma(
        "S^T J_M S = J_M at a collision if and only if sum f_i (s_i+ - s_i-) = 0.",
        (identity("S^T J_M S - J_M = -sum f_i (s_i+ - s_i-)/(v1 - v2) dx1^dx2", found, stated),),
    )


def exact_defect() -> Lemma:
    """*Statement.* Φ*Ω - Ω = -Σ_k (Σ_i f_i Δs_i)_k dx_k ∧ dt_k, (x_k, t_k) the k-th collision.

    By Lemmas 1, 2 and 4 each event adds its defect, pulled back by the events before it; of a
    collision it is as stated, since dt = -(dx_1 - dx_2)/(v_1 - v_2) and dx = dx_1 + v_1 dt.
    The action ∫ Σ p dx - H dt says the same: H = Σ p²/2m - Σ c_i x_i + Σ f_i s_i x_i jumps by
    x_k Σ f_i Δs_i, and Σ p dx not at all, so Φ*λ - λ - dS = -Σ_k x_k (Σ f_i Δs_i)_k dt_k.
    """
    p, x = Masses.symbols(2), sp.Symbol("x")
    dt = -p.normal / (p.v[0] - p.v[1])
    dx = sp.Matrix([1, 0]) + p.v[0] * dt
    after = p.collision * sp.Matrix(p.v)
    momentum = [m * (b - a) for m, a, b in zip(p.m, p.v, after, strict=True)]
    energy = [m * (b**2 - a**2) / 2 for m, a, b in zip(p.m, p.v, after, strict=True)]
    friction = [f * (b - a) * x for f, a, b in zip(p.f, p.before, p.after, strict=True)]
    wedge = dx * dt.T - dt * dx.T  # its entry (j, k) is the form of the unit vectors j and k
    flat = sp.Matrix([[0, 1], [-1, 0]]) / (p.v[0] - p.v[1])
    return Lemma(
        "The defect of the form along an orbit is -sum_k (sum_i f_i (s_i+ - s_i-))_k dx_k^dt_k.",
        (
            identity("dx_k^dt_k = dx1^dx2/(v1 - v2)", wedge, flat),
            identity("sum p dx does not jump along dx1 = dx2", sum(momentum)),
            identity("H jumps by x_k sum f_i (s_i+ - s_i-)", sum(energy + friction), p.jump * x),
        ),
    )


def signs() -> Lemma:
    """*Statement.* The condition admits: signs kept; and, only for f_1 = f_2, s_1 + s_2 kept."""
    f1, f2 = sp.symbols("f1 f2", positive=True)
    told = []
    for d1 in (-2, 0, 2):
        for d2 in (-2, 0, 2):
            jump = f1 * d1 + f2 * d2
            if d1 == d2 == 0:
                continue
            if d1 == -d2:
                told.append(identity(f"jumps ({d1}, {d2}): {d1} (f1 - f2)", jump, d1 * (f1 - f2)))
            else:
                told.append(need(jump.is_zero is False, f"jumps ({d1}, {d2}): never 0"))
    return Lemma(
        "For f1 != f2 a symplectic collision keeps both signs; for f1 = f2 it keeps s1 + s2.",
        tuple(told),
    )
