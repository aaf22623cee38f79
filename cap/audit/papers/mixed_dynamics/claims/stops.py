"""Section 2.2: what happens where the velocity vanishes (Lemma 2.3), and at a wall (Lemma 2.4)."""

from cap.audit.means.need import need
from cap.audit.papers.mixed_dynamics.means.orbits import States
from cap.audit.steps import Words


def no_stop_at_a_tangency() -> Words:
    box = States("0.53", "-1.47", "0.01")
    orbits = box.follow(1)
    need(orbits.has("stick") and orbits.has("release"), "not all orbits stick", w=orbits.words)
    return {"box": box, "shown": orbits.shown()}
