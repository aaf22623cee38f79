"""Which states of a model come to rest soon, by the sweep of the theorem `contact_basin`.

It applies to one guard h with -h'' = P(t) = m + c cos wt + d sin wt.  Hits accumulate where P > 0,
and what rests is released where P falls to 0: at one phase of the clock, as P does so once a period
or never, and in one state, that with h = h' = 0.  So from then on all motions that have come to
rest are the same, but for a number of whole periods: they end on one attractor.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from cap.areas.resting.asked import Rectangle, driven, numbers, variables
from cap.areas.resting.fates import RESTS, fates
from cap.areas.resting.pull import table
from cap.errors import BadInput
from cap.floats.models.spectrum import Floats
from cap.floats.models.subject import Subject
from cap.orbits.wall import Wall, wall
from cap.sets import interval
from cap.sets.compiled import PROBE, require_ieee

PERIODS, BITS = 16, 128  # soon: within so many periods of the clock


def resting(subject: Subject, states: Floats) -> tuple[NDArray[np.bool_], list[str]]:
    """Return which states (N, 2) at t = 0 are seen to come to rest soon, up to rounding; words.

    Where the sweep does not apply these are none, and the words say why.
    """
    found = np.zeros(len(states), dtype=bool)
    try:
        place = wall(subject.system)
        driven(place)
    except BadInput as reason:
        return found, [f"each state is followed, for {reason}"]
    until = Fraction(round(PERIODS * subject.period))
    engine = subject.engine
    here = engine.begun(states) == engine.modes.index(place.falling)
    found[here] = _rest(place, states[here], until)
    if not found.any():
        return found, [f"each state is followed: none is seen to rest before t = {until}"]
    box = " ".join(f"{q:.6g}" for z in states.T for q in (z.min(), z.max()))
    command = f"python -m cap.prove basin {subject.words()} --box {box} --until {until}"
    return found, [
        f"{found.sum()} states are seen to come to rest before t = {until}: as motions from rest "
        "are one, one of them is followed",
        f"to prove a share of the area that does: {command}",
    ]


def _rest(place: Wall, states: Floats, until: Fraction) -> NDArray[np.bool_]:
    """Return which states of the mode of the wall rest before a time."""
    low = states.min(axis=0)
    width = states.max(axis=0) - low
    width[width == 0] = 1
    pairs = zip(place.system.state, low, low + width, strict=True)
    box = {z: (Fraction(a), Fraction(b)) for z, a, b in pairs}
    with interval.workprec(BITS):
        pull, sides = numbers(place, driven(place), Rectangle(Fraction(0), until, box))
    order = place.system.state
    columns = [order.index(z) for q in (place.h, place.rate) for z in variables(place, q)]
    x, y = ((states - low) / width).T[columns]
    found = np.empty(len(states), dtype=np.int8)
    cells = np.stack([x, x, y, y], axis=1)
    require_ieee(fates(pull, table(pull), PROBE, sides, cells, found))
    return np.asarray(found == RESTS)
