"""Theorem (map_curve).  Let g be a map (x, y) -> (x + b y' + c, y'), y' = y + q(x), of the cylinder
(x mod 2π, y), q a polynomial in cos x and sin x with mean 0, b != 0.  Let α be a quadratic
irrational.  If the lemmas succeed, then

 (i)   there is an invariant analytic curve around the cylinder, near an explicit trigonometric
       polynomial, on which g is conjugate to the rotation by α turns;
 (ii)  on it y lies between explicit bounds: so no orbit goes from below the first to above the
       second, or back.

Proof.  docs/invariant-curve-proof.md, with `cap.tori.kicked`; `cap.proofs.cylinder`.
"""

from math import pi
from typing import Any

from cap.floats.candidates import spanning
from cap.proofs.certified import certified
from cap.proofs.cylinder import DIGITS, Sought, bounds, proved
from cap.proofs.map_horseshoe import as_parameters
from cap.runner import Runner
from cap.sets import interval
from cap.system.planar import Map
from cap.tori.kicked import Kicked
from cap.tori.rotation import Quadratic


def prove(given: Map, q: Quadratic, runner: Runner) -> dict[str, Any]:
    """Return a certificate, which the checker accepts; raise `NotProved`."""
    at = Kicked.of(given)
    terms = [(float(k), m, n) for k, m, n in at.terms()]
    runner.tell(f"a curve with the rotation number {q} is looked for", None)
    kicked = spanning.Kicked(float(at.b), float(at.c), terms)
    sought = Sought(q, 0, *spanning.found(kicked, 2 * pi * float(q.value())))
    found, scale = proved(sought, at.over, runner)
    with interval.workprec(scale.bits):
        content = {**found.claims, "bounds": bounds(found.low, found.high)}, found.hints
    about = as_parameters(given)
    return certified("map_curve", about, content, runner, digits=DIGITS, bits=scale.bits)
