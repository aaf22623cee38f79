"""Birkhoff normal form of order 3 of a symplectic map with two degrees of freedom.

Ω = Σ m_i dv_i ∧ dx_i, coordinates (x_1, x_2, v_1, v_2), D the derivative at the fixed point.

*Multipliers.*  As D preserves Ω, its characteristic polynomial is palindromic: with a = trace D and
b = (a² - trace D²)/2 the reduced traces z = λ + 1/λ are the zeros of z² - a z + b - 2.  A pair is
on the unit circle, and simple, if z is in (-2, 2) and the other one is another real number.

*Coordinates.*  e = (D - λ̄)(D² - z'D + 1)c is an eigenvector to λ, z' the other reduced trace, for
any c, unless it vanishes.  Ω(e, ē)/i is real; of λ and λ̄ that one is taken for which it is
positive; its angle is 2πθ, θ in (0, 1).  With Ω(e_j, ē_j) = i the w_j = Ω(., ē_j)/i are coordinates
with Ω = i Σ dw_j ∧ dw̄_j = Σ dI_j ∧ dφ_j, where w_j = sqrt(I_j) exp(iφ_j).

*Normal form.*  Let K = Λ + K_2 + K_3 + .. be the map in (w, w̄).  If no Λ^m = λ_j with |m| = 2, then
φ = K_2/(Λ^m - λ_j), term by term, removes K_2: (1 + φ)⁻¹ K (1 + φ) = Λ + N_3 + .., with N_3 = the
terms of degree 3 of K (1 + φ).  Without resonances of order 4 all of N_3 can be removed but

    w_j -> λ_j w_j (1 + i Σ_k B_jk |w_k|²),

the *twist matrix* B: real and symmetric, as the map is symplectic.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from cap.errors import NotProved
from cap.maps.normal_form import substitute
from cap.sets import interval
from cap.sets.interval import Ball, ComplexBall
from cap.sets.jet import Jet

Rows = Sequence[Sequence[Ball]]
Vector = list[ComplexBall]
Matrix = tuple[tuple[Ball, Ball], tuple[Ball, Ball]]


@dataclass(frozen=True)
class Frame:
    """The multipliers λ_j with their eigenvectors e_j, Ω(e_j, ē_j) = i, of ``masses``."""

    masses: tuple[Ball, ...]
    multipliers: tuple[ComplexBall, ...]
    vectors: tuple[Vector, ...]

    def coordinate(self, j: int, u: Sequence[Jet]) -> Jet:
        """Return w_j of the vector u of jets."""
        n, bar = len(self.masses), [q.conjugate() for q in self.vectors[j]]
        total = u[0] * 0
        for i, m in enumerate(self.masses):
            total = total + (u[n + i] * bar[i] - u[i] * bar[n + i]) * (m / ComplexBall(0, 1))
        return total


def reduced_traces(D: Rows) -> tuple[Ball, Ball]:
    """Return z_1 > z_2, proved real and different, of a symplectic 4 x 4 matrix."""
    size = range(len(D))
    a = interval.total(D[i][i] for i in size)
    square = interval.total(D[i][j] * D[j][i] for i in size for j in size)
    b = (a * a - square) / 2
    discriminant = a * a - 4 * b + 8
    if not discriminant > 0:
        sets = {"discriminant": discriminant}
        raise NotProved("multipliers", "the two pairs may be double, or no pairs at all", sets)
    root = discriminant.sqrt()
    return (a + root) / 2, (a - root) / 2


def form(masses: Sequence[Ball], u: Vector, w: Vector) -> ComplexBall:
    """Return Ω(u, w)."""
    n = len(masses)
    terms = (m * (u[n + i] * w[i] - u[i] * w[n + i]) for i, m in enumerate(masses))
    return sum(terms, ComplexBall(0))


def eigenvector(
    D: Rows, masses: Sequence[Ball], z: Ball, other: Ball
) -> tuple[ComplexBall, Vector]:
    """Return λ and e with Ω(e, ē) = i, for a pair with reduced trace ``z``; Im λ is not 0.

    Raises `NotProved` unless z is certainly in (-2, 2) and Ω(e, ē) of one sign.
    """
    if not -2 < z < 2:
        raise NotProved("multipliers", "a pair may leave the unit circle", {"z": z})
    upper = ComplexBall(z / 2, (1 - z * z / 4).sqrt())
    tried = [_vector(D, upper, other, i) for i in range(len(D))]
    sizes = [(form(masses, e, _bar(e)) / ComplexBall(0, 1)).real for e in tried]
    best = max(range(len(D)), key=lambda i: float(abs(sizes[i]).lower()))
    e, kappa = tried[best], sizes[best]
    if not (kappa > 0 or kappa < 0):
        raise NotProved("multipliers", "a Krein sign is undecided", {"Omega(e, conj e)/i": kappa})
    if not kappa > 0:
        upper, e = upper.conjugate(), _bar(e)
    scale = 1 / abs(kappa).sqrt()
    return upper, [q * scale for q in e]


def _vector(D: Rows, multiplier: ComplexBall, other: Ball, index: int) -> Vector:
    """Return (D - λ̄)(D² - z'D + 1) c, c the unit vector with this index."""
    c = [Ball(int(i == index)) for i in range(len(D))]
    first = _times(D, c)
    second = _times(D, first)
    u = [s - other * f + k for s, f, k in zip(second, first, c, strict=True)]
    bar = multiplier.conjugate()
    return [ComplexBall(p) - bar * q for p, q in zip(_times(D, u), u, strict=True)]


def _times(D: Rows, u: Sequence[Ball]) -> list[Ball]:
    return [interval.total(a * b for a, b in zip(row, u, strict=True)) for row in D]


def _bar(u: Vector) -> Vector:
    return [q.conjugate() for q in u]


def frame(D: Rows, masses: Sequence[Ball], z: tuple[Ball, Ball]) -> Frame:
    """Return the frame of a D whose two pairs are on the unit circle, and simple."""
    found = [eigenvector(D, masses, z[j], z[1 - j]) for j in range(2)]
    return Frame(tuple(masses), tuple(q[0] for q in found), tuple(q[1] for q in found))


def angle(z: Ball, *, above: bool) -> Ball:
    """Return θ in (0, 1), of the multiplier exp(2πiθ) of the pair, above the real axis or below."""
    theta = (z / 2).acos() / (2 * interval.pi())
    return theta if above else 1 - theta


def twist_matrix(jets: Sequence[Jet], frame: Frame) -> Matrix:
    """Return B, from the jets of order 3 of the map at its fixed point.

    The caller knows that there is no resonance of order 4.  Verifies that there is none of order 3,
    and that B may be real and symmetric.
    """
    maps = in_coordinates(jets, frame)
    changes = _changes(maps, frame)
    B = [[_entry(substitute(maps[j], changes), j, k, frame) for k in range(2)] for j in range(2)]
    (a, b), (c, d) = B
    if not b.overlaps(c):
        raise NotProved("normal form", "the twist matrix is not symmetric", {"12": b, "21": c})
    off = interval.intersection(b, c)
    return (a, off), (off, d)


def in_coordinates(jets: Sequence[Jet], frame: Frame) -> list[Jet]:
    """Return the jets of w_1, w_2 and of their conjugates after the map, in (w, w̄)."""
    n = len(frame.vectors)
    w = Jet.variables([ComplexBall(0)] * (2 * n), jets[0].space.order)
    u = []
    for i in range(2 * n):
        total = w[0] * 0
        for j, e in enumerate(frame.vectors):
            total = total + w[j] * e[i] + w[n + j] * e[i].conjugate()
        u.append(total)
    image = [substitute(jet, u) for jet in jets]
    first = [frame.coordinate(j, image) for j in range(n)]
    return first + [conjugate(q, n) for q in first]


def conjugate(f: Jet, n: int) -> Jet:
    """Return the jet in (w, w̄) of the complex conjugate."""
    swapped = (f[exponent[n:] + exponent[:n]] for exponent in f.space.exponents)
    return Jet(f.space, [ComplexBall(q).conjugate() for q in swapped])


def _changes(maps: Sequence[Jet], frame: Frame) -> list[Jet]:
    """Return the jets of (w, w̄) + φ."""
    n, space = len(frame.vectors), maps[0].space
    bars = [q.conjugate() for q in frame.multipliers]
    spectrum = [*frame.multipliers, *bars]
    changes = []
    for j in range(n):
        psi = list(Jet.variables([ComplexBall(0)] * (2 * n), space.order)[j].coefficients)
        for i, exponent in enumerate(space.exponents):
            if sum(exponent) == 2:
                psi[i] = maps[j].coefficients[i] / divisor(spectrum, exponent, j)
        changes.append(Jet(space, psi))
    return changes + [conjugate(q, n) for q in changes]


def divisor(spectrum: list[ComplexBall], exponent: tuple[int, ...], j: int) -> ComplexBall:
    """Return Λ^m - λ_j, proved not zero; ``spectrum`` is λ_1, .., and the conjugates."""
    product = ComplexBall(1)
    for multiplier, power in zip(spectrum, exponent, strict=True):
        product = product * multiplier**power
    divisor = product - spectrum[j]
    if divisor.contains(0):
        sets = {"divisor": divisor}
        raise NotProved("normal form", f"there may be a resonance at {exponent}", sets)
    return divisor


def _entry(f: Jet, j: int, k: int, frame: Frame) -> Ball:
    """Return B_jk: the coefficient of w_j |w_k|² in a map is i λ_j B_jk."""
    n = len(frame.vectors)
    exponent = [0] * (2 * n)
    for i in (j, k, n + k):
        exponent[i] += 1
    value = f[tuple(exponent)] / (frame.multipliers[j] * ComplexBall(0, 1))
    if not value.imag.contains(0):
        raise NotProved("normal form", "the twist matrix is not real", {"B": value})
    return Ball(value.real)
