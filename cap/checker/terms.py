"""Terms that stand in more than one sentence, and what they mean.

*The normal form.*  z = p dx + q dv of ``normal_form`` has dx^dv = (i/2) dz^dz^-, so that positive
angles turn from x to v; |z|^2 is twice the action.
"""

from __future__ import annotations

from collections.abc import Sequence

ONE_ONE = "T-periodic, with a velocity that never vanishes and one hit of each wall per period"
NORMAL_FORM = (
    "in a complex coordinate z around it, with dx^dv = (i/2) dz^dz^- there (so that positive "
    "angles turn from x to v), Phi is z -> z exp(i (Theta + tau_1 |z|^2)) + O(|z|^4)"
)
_CAPTURE = (
    "here 'capture' and a wall stand for infinitely many hits of this wall, one turn before each "
    "(but perhaps none before the first, if no event comes before) and nothing else, which "
    "accumulate in finite time, from which on the mass rests at the wall until its release"
)


def captures(itinerary: Sequence[str]) -> str:
    """Return in words what captures among these events stand for; nothing without any."""
    return _CAPTURE if any(word.startswith("capture") for word in itinerary) else ""
