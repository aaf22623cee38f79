"""The first Birkhoff coefficient in real arithmetic, over any scalar: for ranges of parameters.

Let the jets (X, V) of an area-preserving map have the Jacobian ((a, b), (c, d)) at the fixed
point, λ = e^{iΘ} with 2 cos Θ = a + d and sin Θ of the sign of c, as in `cap.maps.normal_form`.  In
ζ = X + wV, w = (λ - a)/c,

    λ̄ ζ∘Φ = ζ + c20 ζ² + c11 ζζ̄ + c02 ζ̄² + ... + c21 ζ²ζ̄ + ...,

and z = ζ/sqrt(Im w) is the coordinate of `cap.maps.normal_form`.  Area is preserved, so c11 = -2
c̄20, and

    τ_1 = Im w (Im c21 + 3 |c20|² sin Θ/(cos Θ - 1) + |c02|² sin 3Θ/(cos 3Θ - 1))

(Moeckel, Generic bifurcations of the twist coefficient, 1990).  With T = a + d the last quotient
is sin Θ (T - 1)/((T/2 - 1)(T + 1)): so (1 + T) τ_1 has no pole at the resonance of order three.
"""

from typing import Any, NamedTuple

from cap.sets.elementary import sqrt
from cap.sets.jet import Jet


class Complex(NamedTuple):
    """A complex number over any scalar."""

    re: Any
    im: Any

    def conjugate(self) -> "Complex":
        """Return the conjugate."""
        return Complex(self.re, -self.im)

    def times(self, *others: "Complex") -> "Complex":
        """Return the product."""
        a, b = self
        for c, d in others:
            a, b = a * c - b * d, a * d + b * c
        return Complex(a, b)

    def norm(self) -> Any:
        """Return the square of the modulus."""
        return self.re * self.re + self.im * self.im


def _sum(*terms: tuple[int, Complex]) -> Complex:
    return Complex(sum(n * z.re for n, z in terms), sum(n * z.im for n, z in terms))


def regular_twist(x: Jet, v: Jet, sign: int) -> Any:
    """Return (1 + trace) τ_1 for jets of order three; ``sign`` is that of the entry c.

    Assumes that the map preserves area and fixes the point, and |trace| < 2.
    """
    a, c, T = x[1, 0], v[1, 0], x[1, 0] + v[0, 1]
    cos = T / 2
    sin = sqrt(1 - cos * cos) * sign
    w = Complex((cos - a) / c, sin / c)
    beta = Complex(c * 0, -c / (2 * sin))  # v = β ζ + β̄ ζ̄,  x = α ζ + ᾱ ζ̄
    alpha = Complex(1 + w.im * beta.im, -w.re * beta.im)
    bar_a, bar_b = alpha.conjugate(), beta.conjugate()
    turned = Complex(cos, -sin)

    def term(i: int, j: int) -> Complex:
        """Return the coefficient of x^i v^j in λ̄ (X + wV)."""
        return turned.times(Complex(x[i, j] + w.re * v[i, j], w.im * v[i, j]))

    def quadratic(p: Complex, q: Complex) -> Complex:
        return _sum(
            (1, term(2, 0).times(p, p)), (1, term(1, 1).times(p, q)), (1, term(0, 2).times(q, q))
        )

    c20, c02 = quadratic(alpha, beta), quadratic(bar_a, bar_b)
    c21 = _sum(
        (3, term(3, 0).times(alpha, alpha, bar_a)),
        (1, term(2, 1).times(alpha, alpha, bar_b)),
        (2, term(2, 1).times(alpha, bar_a, beta)),
        (1, term(1, 2).times(bar_a, beta, beta)),
        (2, term(1, 2).times(alpha, beta, bar_b)),
        (3, term(0, 3).times(beta, beta, bar_b)),
    )
    down = cos - 1
    return w.im * (
        (T + 1) * (c21.im + 3 * c20.norm() * sin / down) + c02.norm() * sin * (T - 1) / down
    )
