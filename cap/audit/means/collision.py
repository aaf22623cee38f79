"""A binary collision of two particles with friction: its derivative, symbolically.

Particle i has the mass m_i, the friction force f_i, and the acceleration (c - f_i s_i)/m_i with c =
F cos ωt and the sign s_i of its velocity; C is the collision matrix.  In the order (x_1, x_2, v_1,
v_2)

    S = ((C, 0), (K, C)),   K = (a⁺ - C a⁻) nᵀ/(nᵀ v⁻),   n = (1, -1),

because positions and velocities follow C, and the collision time depends on nᵀx: `derivative`
derives it from two neighbouring orbits.
"""

from typing import Any, NamedTuple

from cap.audit.means.algebra import reals, symbols
from cap.audit.means.lazy import sympy as sp


class Collision(NamedTuple):
    """The symbols of a collision: masses, friction forces, velocities before, signs, F cos ωt."""

    m: tuple[Any, Any]
    f: tuple[Any, Any]
    v: tuple[Any, Any]
    before: tuple[Any, Any]
    after: tuple[Any, Any]
    c: Any

    @property
    def matrix(self) -> Any:
        """C of eq:Ncollision."""
        m1, m2 = self.m
        return sp.Matrix([[m1 - m2, 2 * m2], [2 * m1, m2 - m1]]) / (m1 + m2)

    def acceleration(self, signs: tuple[Any, Any]) -> Any:
        """The accelerations for these signs of the velocities."""
        triples = zip(self.m, self.f, signs, strict=True)
        return sp.Matrix([(self.c - f * s) / m for m, f, s in triples])

    def derivative(self) -> Any:
        """S, from two orbits whose deviation before the collision is δ, at first order."""
        names = "dx1 dx2 dv1 dv2"
        deviation = reals(names)
        small = sp.Symbol("small")
        dx, dv = sp.Matrix(deviation[:2]), sp.Matrix(deviation[2:])
        v = sp.Matrix(self.v)
        gap, closing = small * (dx[0] - dx[1]), self.v[0] - self.v[1]
        delay = -gap / closing  # of the perturbed collision, at first order
        before, after = self.acceleration(self.before), self.acceleration(self.after)
        C = self.matrix
        speed = C * (v + small * dv + before * delay)
        place = small * dx + v * delay  # where both are at their collision, less x_*
        x = place - C * v * delay
        u = speed - after * delay - C * v
        image = [sp.diff(each, small).subs(small, 0) for each in (*x, *u)]
        return sp.Matrix([[sp.simplify(sp.diff(row, q)) for q in deviation] for row in image])

    def form(self) -> Any:
        """The matrix of Σ m_i dv_i ∧ dx_i."""
        M = sp.diag(*self.m)
        zero = sp.zeros(2)
        return sp.Matrix(sp.BlockMatrix([[zero, -M], [M, zero]]))


def collision() -> Collision:
    """Return a collision with symbols for everything."""
    m, f = symbols("m1 m2"), symbols("f1 f2")
    v, s, sigma = reals("v1 v2"), reals("s1 s2"), reals("r1 r2")
    return Collision(m, f, v, s, sigma, sp.Symbol("c", real=True))


def standard_form() -> Any:
    """Return the matrix of Σ dv_i ∧ dx_i."""
    one, zero = sp.eye(2), sp.zeros(2)
    return sp.Matrix(sp.BlockMatrix([[zero, -one], [one, zero]]))
