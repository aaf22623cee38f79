"""Masses that collide, in symbols, and the polytope of their positions."""

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Collision:
    """Two masses that collide, as in theorem symplectic.

    Masses, friction forces, velocities before, signs before and after; S, the derivative of the
    collision; the matrix of the form Σ m_i dv_i ∧ dx_i; the jump Σ f_i (s_i⁺ - s_i⁻).
    """

    m: Any
    f: Any
    v: Any
    before: Any
    after: Any
    S: Any
    form: Any
    jump: Any


def collision() -> Collision:
    """Return a collision in symbols, of which the theorem derives everything."""
    from cap.proofs.symplectic_events import Masses, saltation  # noqa: PLC0415 (sympy)

    k = Masses.symbols(2)
    S = saltation(k, k.collision, k.normal)
    return Collision(k.m, k.f, k.v, k.before, k.after, S, k.form, k.jump)


def corners_of_faces(masses: int) -> list[int]:
    """Return how many corners each face of 0 <= x_1 <= .. <= x_n <= 1 has."""
    n = int(masses)
    corners = [[0, *(int(j >= i) for j in range(n)), 1] for i in range(n + 1)]
    return [sum(each[k] == each[k + 1] for each in corners) for k in range(n + 1)]
