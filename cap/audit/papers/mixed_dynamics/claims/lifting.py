"""Section 3.2: Proposition 3.2, the lift of never-stopping orbits and its converse."""

from cap.audit.means.algebra import identity, symbols
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need


def converse() -> None:
    t, F, w, a = symbols("t F omega a")  # f = F cos a; p vanishes at ωt = -a, on a branch W' = 1
    s = sp.Symbol("s", real=True)
    p = sp.integrate(F * sp.cos(w * t) - F * sp.cos(a), (t, -a / w, -a / w + s))
    series = [sp.simplify(sp.diff(p, s, k).subs(s, 0)) for k in range(3)]
    need(series[0] == 0 and series[1] == 0, "p does not touch zero")
    identity("p = F ω sin(a) s²/2 + ..", series[2], F * w * sp.sin(a))
