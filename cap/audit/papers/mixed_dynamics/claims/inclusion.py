"""Section 2.1: what a solution is.  (F1) to (F3) let pass more than they should."""

from fractions import Fraction

from cap.audit.means.algebra import enclosure, identity, same
from cap.audit.means.balls import pair
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.steps import Words
from cap.sets import interval


def rest_at_a_wall() -> Words:
    t, F, f, w = sp.symbols("t F f omega", positive=True)
    # At r, at rest, when cos ωt = -1: leave, or stay.  τ = t - π/ω.
    v = sp.integrate(F * sp.cos(w * t + sp.pi) + f, (t, 0, t))
    identity("who leaves obeys the equation for v < 0", sp.diff(v, t), -F * sp.cos(w * t) + f)
    need(same(sp.diff(v, t).subs(t, 0), f - F), "the acceleration is not f - F")
    found = stored("capture.json").claims
    release = found["release_time"]
    with interval.workprec(60):
        force = -enclosure(sp.cos(t), {t: Fraction(2)})
        need(force > interval.ball(Fraction(2, 5)), "no force pulls from the wall at t = 2")
    box = found["box"]
    return {"x": box["x"], "v": box["v"], "release": pair(release, 6)}
