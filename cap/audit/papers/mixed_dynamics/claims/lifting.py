"""Section 3.2: Proposition 3.2, the lift of never-stopping orbits and its converse."""

from fractions import Fraction

from cap.audit.means.algebra import identity, symbols
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need


def wave(q: Fraction) -> Fraction:
    """Return the triangular wave W of eq:Wq."""
    rest = q % 2
    return rest if rest < 1 else 2 - rest


def lift_is_unique() -> None:
    half, other = Fraction(1, 2), Fraction(3, 2)
    need(wave(half) == wave(other), "they are not in the same fibre")
    step = Fraction(1, 10)
    need(wave(half + step) > wave(half), "q growing from 1/2 does not move right")
    need(wave(other + step) < wave(other), "q growing from 3/2 does not move left")


def converse() -> None:
    t, F, w, a = symbols("t F omega a")  # f = F cos a; p vanishes at ωt = -a, on a branch W' = 1
    s = sp.Symbol("s", real=True)
    p = sp.integrate(F * sp.cos(w * t) - F * sp.cos(a), (t, -a / w, -a / w + s))
    series = [sp.simplify(sp.diff(p, s, k).subs(s, 0)) for k in range(3)]
    need(series[0] == 0 and series[1] == 0, "p does not touch zero")
    identity("p = F ω sin(a) s²/2 + ..", series[2], F * w * sp.sin(a))


def signs_at_a_crossing() -> None:
    h = Fraction(1, 10)
    slopes = {
        k: (wave(Fraction(k)) - wave(k - h), wave(k + h) - wave(Fraction(k))) for k in range(4)
    }
    true = all((a / h, b / h) == ((-1) ** (k - 1), (-1) ** k) for k, (a, b) in slopes.items())
    stated = all((a / h, b / h) == ((-1) ** k, (-1) ** (k + 1)) for k, (a, b) in slopes.items())
    need(true and not stated, "the signs are others")


def walls_of_the_cover() -> None:
    need(all(wave(Fraction(k)) == k % 2 for k in range(-3, 4)), "a wall is elsewhere")
