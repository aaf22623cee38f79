"""The constants of the folded flow (`.backward`, `.paths`), enclosed."""

from cap.areas.folded.backward import Constants
from cap.boxes.units import BITS, of_ball
from cap.parameters import Parameters
from cap.sets import interval
from cap.sets.doubles import enclosing


def system_of(p: Parameters, *, forwards: bool = False) -> Constants:
    """Return the constants of the flow, backwards or forwards, enclosed.

    Theta is pi - arccos a backwards, and arccos a forwards.
    """
    a, width = p.f / p.F, (p.r - p.l) * p.omega**2 / p.F
    with interval.workprec(BITS):
        ratio = interval.ball(a)
        theta = ratio.acos() if forwards else interval.pi() - ratio.acos()
        sine = ((1 - ratio) * (1 + ratio)).sqrt()
        found = enclosing(a), enclosing(width), of_ball(theta), of_ball(sine)
    return Constants(*(end for q in found for end in (q.mid, q.rad)))
