"""The contacts of an orbit in doubles, as a guess from which `cap.orbits.periodic` proves it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cap.errors import BadInput
from cap.floats.models.engine import Engine
from cap.floats.models.spectrum import Exponential, Floats, number
from cap.orbits.itinerary import Contact, Itinerary

MOST = 64  # contacts of a round


def contacts(
    engine: Engine, state: Sequence[float], mode: str | None = None, periods: int = 1
) -> tuple[Itinerary, list[float]]:
    """Return the itinerary of an orbit from t = 0, and time and state just before each contact.

    The orbit should close after the periods, up to what Newton's iteration mends.  Raises
    `BadInput` if it is lost, has no contact or more than `MOST`, is captured, or begins in another
    mode than it ends in.
    """
    modes = None if mode is None else [mode]
    ends = engine.follow([state], modes, periods=periods, log=MOST + 1)
    words = [engine.words[int(line[2])] for line in ends.log]
    if ends.flags[0]:
        raise BadInput("the orbit is lost, or begins outside its mode: see the flags of its end")
    if not 0 < len(words) <= MOST:
        raise BadInput(f"the orbit has {len(words) or 'no'} contacts: from 1 to {MOST} are proved")
    if engine.words[-1] in words:
        raise BadInput("infinitely many contacts accumulate: no list of contacts proves the orbit")
    after = [engine.modes[int(line[3])] for line in ends.log]
    before = [after[-1], *after[:-1]]  # it closes
    if mode not in (None, before[0]):
        raise BadInput(f"the orbit begins in the mode {mode} and ends in {before[0]}")
    found = [Contact(*names) for names in zip(before, words, after, strict=True)]
    times = [0.0, *ends.log[:, 1]]
    starts = [np.array(state, float), *ends.log[:, 4:]]
    flights = dict(zip(engine.modes, engine.exponentials, strict=True))
    omega, guess = float(number(engine.system.omega)), list[float]()
    for k, contact in enumerate(found):
        y = [*starts[k], np.cos(omega * times[k]), np.sin(omega * times[k]), 1.0]
        arrived = _flown(flights[contact.mode], np.array(y), times[k + 1] - times[k])[: len(state)]
        guess += [float(times[k + 1]), *map(float, arrived)]
    return Itinerary(engine.system, found, periods), guess


def _flown(E: Exponential, y: Floats, d: float) -> Floats:
    """Return exp(M d) y."""
    total = E.first * d + E.second * d**2 / 2
    x = E.rates * d
    for r, re, im in zip(np.exp(x) - 1 - x - x * x / 2, E.real, E.imaginary, strict=True):
        total = total + re * r.real + im * r.imag
    return np.asarray(y + total @ y)
