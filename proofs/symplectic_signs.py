"""Lemmas of `cap.proofs.symplectic`: no motion keeps all signs, and (K1) of the paper never holds.

The written proof is in ``proofs/audit/particles.md``; here are its inequalities.
"""

import sympy as sp

from cap.proofs.identities import identity, need
from cap.proofs.symbolic import Lemma
from cap.proofs.symplectic_events import Masses


def emptiness() -> Lemma:
    """*Statement.* Ω_NS^(N) of the paper is empty, for N >= 2 and friction forces f_i > 0.

    More exactly: no motion on [0, ∞) has locally finitely many events, none simultaneous, no zero
    of a velocity, and at each collision the signs of both velocities kept.

    *Proof.*  v_1 changes its sign at the wall l only, from - to +; signs of interior masses never
    change.  If v_1 > 0 once, then ever after; collisions with 2, which need v_1 > v_2, decrease it,
    and so does a period of flight, by 2πf_1/(ω m_1): v_1 becomes negative, a contradiction.  So v_1
    < 0 for all t, and v_N > 0 by reflection.  Let k be the last of the first masses 1, .., k with
    negative velocities.  Mass 1 never hits l, after which v_1 > 0; k and k + 1 move apart.  So
    collisions among 1, .., k are all their events, and keep their momentum, which on flights grows
    by 2π(f_1 + .. + f_k)/ω per period: it becomes positive, a contradiction.
    """
    p = Masses.symbols(2)
    gap, (m1, m2), (v1, v2) = sp.Symbol("gap", positive=True), p.m, p.v
    after = p.collision * sp.Matrix(p.v)
    change = sp.cancel((after[0] - v1).subs(v1, v2 + gap))
    t, F, f, w = sp.symbols("t F f omega", positive=True)
    turn = (t, 0, 2 * sp.pi / w)
    right, left = (sp.integrate(F * sp.cos(w * t) - s * f, turn) for s in (1, -1))
    return Lemma(
        "N >= 2: no motion without a stop keeps both signs at all its collisions: the set "
        "Omega_NS^(N) of the paper is empty.",
        (
            identity(
                "a collision changes v1 by -2 m2 (v1 - v2)/(m1 + m2)",
                change,
                -2 * m2 * gap / (m1 + m2),
            ),
            need(change.is_negative, "which is negative for v1 > v2"),
            identity("and keeps m1 v1 + m2 v2", m1 * (after[0] - v1) + m2 * (after[1] - v2)),
            identity(
                "moving right, m v changes by -2 pi f/omega per period", right, -2 * sp.pi * f / w
            ),
            identity(
                "moving left, m v changes by 2 pi f/omega per period", left, 2 * sp.pi * f / w
            ),
        ),
    )


def resonances() -> Lemma:
    """*Statement.* (K1) asks of k = (1, 0, .., 0) that θ_0 = 2π be no multiple of 2π."""
    theta = sp.symbols("theta1:4", real=True)
    angles, k = [2 * sp.pi, *theta], [1, 0, 0, 0]
    total = sum(a * b for a, b in zip(k, angles, strict=True))
    return Lemma(
        "(K1) of the paper, with theta_0 = 2 pi among its angles, holds for no orbit.",
        (
            identity(
                "k = (1, 0, .., 0), of order 1 <= 2N + 4: sum k_j theta_j = 2 pi", total, 2 * sp.pi
            ),
        ),
    )
