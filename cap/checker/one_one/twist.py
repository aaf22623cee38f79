"""The first twist of a pair: the map over a period in impact coordinates, to third order.

*The map.*  Units and names are those of ``closed_form``.  A hit is given by E = u^2/2 and t; just
before the right wall dx^dv = -u dt^du = dE^dt: (E, t) preserve area and orientation.  A flight
from (t, u) lasts the time d for which

    H(d) = (u - s sin t) d - s (cos(t + d) - cos t) - alpha d^2/2 - rho = 0,

and ends with H'(d) = u + s (sin(t + d) - sin t) - alpha d.  On the orbit, d = pi + 2 delta and then
pi - 2 delta are exact, so the deviation eta of d has no constant term.  With u_e the speed at the
end, eta -> eta - H/u_e changes an error of eta by the factor 1 - H'/u_e, which has no constant
term: each step gains a degree, three steps make the jet of third order exact.

*The twist.*  In coordinates (X, Y) that preserve area let Phi' = ((a, b), (c, d)), cos Theta = (a +
d)/2, sin Theta of the sign of c, e = e^(i Theta), and z = X + wY, w = (e - a)/c: then z o Phi' = e
z (the coefficient of Y is b + wd = ew by e^2 - (a + d) e + 1 = 0).  Write, with z^- the conjugate,

    z o Phi = e (z + c_20 z^2 + c_11 z z^- + c_02 z^-^2 + ... + c_21 z^2 z^- + ...).

Phi preserves area: at first order Re(2 c_20 z + c_11 z^-) = 0, hence c_11 = -2 c_20^-.  Let z =
h(w) = w + A w^2 + B w w^- + D w^-^2 + ... bring Phi into N(w) = e w (1 + i tau |w|^2 + ...) + other
terms of degree at least three.  Phi o h = h o N gives at second order A = c_20/(e - 1), B =
c_11/(e^- - 1), D = c_02/(e^-^3 - 1), and at w^2 w^-

    i tau = c_21 + 2 B c_20 + (A + B^-) c_11 + 2 D^- c_02.

1/(e^(ix) - 1) = -1/2 - (i/2) cot(x/2), so the imaginary part is

    tau = Im c_21 + 3 |c_20|^2 g(Theta) + |c_02|^2 g(3 Theta),
    g(x) = -cot(x/2) = sin x/(cos x - 1)

[Moeckel].  The area of z is q = Im w = sin Theta/c times that of (X, Y): in coordinates that
preserve area the twist is tau_1 = q tau.  With T = 2 cos Theta = trace, sin 3 Theta = sin Theta
(T^2 - 1) and cos 3 Theta - 1 = (T/2 - 1)(T + 1)^2, so

    N = (1 + T) tau_1 = q ((1 + T)(Im c_21 + 3 |c_20|^2 sin Theta/(T/2 - 1))
                           + |c_02|^2 sin Theta (T - 1)/(T/2 - 1))

has no pole where e^3 = 1.  For 0 < |Theta| < pi and e^3 != 1, N != 0 means tau_1 != 0.

*In real parts*: with xi = X + pY, eta = qY, w = p + iq, the map has real coefficients.  If its
terms of degree 2 and 3 are A xi^2 + B xi eta + D eta^2 and A xi^3 + B xi^2 eta + C xi eta^2 + D
eta^3, A = A_1 + i A_2 and so on, then xi = (z + z^-)/2 and eta = (z - z^-)/(2i) give

    e c_20 = (A - D - iB)/4,    e c_02 = (A - D + iB)/4,    e c_21 = (3A - iB + C - 3iD)/8.
"""

from __future__ import annotations

from typing import Generic, NamedTuple

from cap.checker.kernel.jet import Jet
from cap.checker.kernel.rejection import need
from cap.checker.kernel.series import K, divided, nilpotent, square_root
from cap.checker.kernel.substitution import substituted
from cap.checker.one_one.pairs import Pair, Pairs
from cap.checker.system.flight import place, velocity

_ORDER = 3


class Hit(NamedTuple, Generic[K]):
    """A hit on the orbit: cosine and sine of its time, and the speed."""

    cos: K
    sin: K
    u: K


def period_map(pairs: Pairs[K], pair: Pair[K]) -> tuple[Jet[K], Jet[K]]:
    """Return E and t at the next hit of the right wall as jets in the deviations of E and t."""
    right, left = (
        Hit(cos.constant, sin.constant, u.constant)
        for (cos, sin), u in zip(pair.hits, pair.speeds, strict=True)
    )
    one, delta, alpha = right.u.integer(1), pair.delta.constant, pair.alpha.constant
    u = square_root(Jet(_ORDER, {(0, 0): right.u * right.u, (1, 0): one * 2}))
    t = Jet(_ORDER, {(0, 1): one})
    t, u = flight((t, u), (right, left), -1, pairs.pi + delta * 2, alpha)
    t, u = flight((t, u), (left, right), 1, pairs.pi - delta * 2, alpha)
    return divided(u * u, 2), t


def flight(
    start: tuple[Jet[K], Jet[K]], hits: tuple[Hit[K], Hit[K]], s: int, d: K, alpha: K
) -> tuple[Jet[K], Jet[K]]:
    """Return the deviation of the time and the speed at the end from those at the start."""
    (t, u), (first, last) = start, hits
    cos, sin = turned(first, t)
    base, long = u - sin * s, Jet[K](_ORDER, {(0, 0): d})
    for _ in range(_ORDER):
        way = place(cos * s, base, long, alpha / 2, turned(last, t + nilpotent(long))[0] * s)
        long = long - nilpotent(way) * (d.integer(1) / last.u)
    t = t + nilpotent(long)
    return t, velocity(base, long, alpha, turned(last, t)[1] * s)


def turned(hit: Hit[K], t: Jet[K]) -> tuple[Jet[K], Jet[K]]:
    """Return cosine and sine, a time t without constant term after the hit."""
    square, one = t * t, hit.cos.integer(1)
    cos, sin = Jet(_ORDER, {(0, 0): one}) - divided(square, 2), t - divided(square * t, 6)
    return cos * hit.cos - sin * hit.sin, cos * hit.sin + sin * hit.cos


def regularised_twist(pairs: Pairs[K], pair: Pair[K]) -> K:
    """Return N for elliptic orbits of which the lower left entry c of Phi' is not zero."""
    E, t = period_map(pairs, pair)
    trace, a, c = pair.trace.constant, E.coefficients[1, 0], t.coefficients[1, 0]
    cos, values = trace / 2, pairs.values(c)
    need(not values.contains_zero(), "the lower left entry of the Jacobian may be zero")
    sin = (-(cos * cos) + 1).sqrt() * (1 if values.is_positive() else -1)
    stretch = c / sin  # 1/q
    (x_2, x_3), (y_2, y_3) = rotating(E, t, (cos - a) / sin, stretch)
    c_20 = (x_2[0] - x_2[2] + y_2[1]) / 4, (y_2[0] - y_2[2] - x_2[1]) / 4
    c_02 = (x_2[0] - x_2[2] - y_2[1]) / 4, (y_2[0] - y_2[2] + x_2[1]) / 4
    re_21 = (x_3[0] * 3 + y_3[1] + x_3[2] + y_3[3] * 3) / 8
    im_21 = (y_3[0] * 3 - x_3[1] + y_3[2] - x_3[3] * 3) / 8
    regular = (trace + 1) * (cos * im_21 - sin * re_21 + norm(c_20) * sin / (cos - 1) * 3)
    return (regular + norm(c_02) * sin * (trace - 1) / (cos - 1)) / stretch


def rotating(X: Jet[K], Y: Jet[K], lean: K, stretch: K) -> list[list[list[K]]]:
    """Return the terms of degree 2 and of degree 3 of xi and of eta after a period.

    Y = eta/q and X = xi - (p/q) eta: the arguments are p/q and 1/q.
    """
    one = stretch.integer(1)
    x = Jet(_ORDER, {(1, 0): one, (0, 1): -lean})
    y = Jet(_ORDER, {(0, 1): stretch})
    X, Y = (substituted(nilpotent(Z), (x, y)) for Z in (X, Y))
    rows = X + Y * (lean / stretch), Y * (one / stretch)
    return [[[Z.coefficients[n - j, j] for j in range(n + 1)] for n in (2, 3)] for Z in rows]


def norm(z: tuple[K, K]) -> K:
    """Return |z|^2."""
    return z[0] * z[0] + z[1] * z[1]
