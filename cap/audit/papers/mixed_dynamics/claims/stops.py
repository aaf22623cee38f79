"""Section 2.2: what happens where the velocity vanishes (Lemma 2.3), and at a wall (Lemma 2.4)."""

from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.papers.mixed_dynamics.means.orbits import States
from cap.audit.steps import Words


def four_tangency_times() -> None:
    a = sp.Symbol("a", positive=True)
    named = [a, -a, 2 * sp.pi + a, 2 * sp.pi - a]
    classes = {
        sp.simplify(phase - 2 * sp.pi * shift)
        for phase, shift in zip(named, (0, 0, 1, 1), strict=True)
    }
    need(classes == {a, -a}, "the phases named are not two modulo 2π")


def no_stop_at_a_tangency() -> Words:
    box = States("0.53", "-1.47", "0.01")
    orbits = box.follow(1)
    need(orbits.has("stick") and orbits.has("release"), "not all orbits stick", w=orbits.words)
    return {"box": box, "shown": orbits.shown()}
