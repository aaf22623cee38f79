"""The contacts of an orbit in doubles, as a guess from which `cap.orbits.periodic` proves it."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from cap.errors import BadInput
from cap.floats.models.engine import Engine
from cap.floats.models.spectrum import Exponential, Floats, evaluated, number
from cap.orbits.itinerary import Contact, Itinerary
from cap.system.polynomial import COS, SIN

MOST = 64  # contacts of a round
ROUGH = 1e-4  # times of contacts that are followed once more
LOST = "the orbit is lost, or begins where a guard of its mode is negative"
LONG = 200  # periods of 2 pi/omega after which an orbit has settled


def contacts(
    engine: Engine, state: Sequence[float], mode: str | None = None, periods: int = 1
) -> tuple[Itinerary, list[float]]:
    """Return the itinerary of an orbit from t = 0, and time and state just before each contact.

    The orbit should close after the periods, up to what Newton's iteration mends.  Raises
    `BadInput` if it is lost, has no contact or more than `MOST`, is captured, or begins in another
    mode than it ends in.
    """
    modes, start = None if mode is None else [mode], np.array([state], float)
    if mode in engine.modes and not engine.inside(start)[engine.modes.index(mode), 0]:
        raise BadInput(LOST)  # far outside it is followed by very short steps
    ends = engine.follow(start, modes, periods=periods, log=MOST + 1)
    words = [engine.words[int(line[2])] for line in ends.log]
    if ends.flags[0]:
        raise BadInput(LOST)
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
    before_each = _arrivals(engine, found, times, starts)
    guess = [x for t, q in zip(times[1:], before_each, strict=True) for x in (float(t), *q)]
    return Itinerary(engine.system, found, periods), guess


def meets(engine: Engine, itinerary: Itinerary, guess: Sequence[float]) -> bool:
    """Return whether floats that begin after the first contact meet the others, and it again.

    Equations of contacts may have solutions on which a guard is negative between them.
    """
    system, (first, *others) = itinerary.system, itinerary.contacts
    table = np.array(guess).reshape(len(others) + 1, -1)
    period = 2 * np.pi / float(number(system.omega))
    phase = 2 * np.pi * table[0, 0] / period
    values = {**dict(zip(system.state, table[0, 1:], strict=True)), COS: np.cos(phase)}
    values[SIN] = np.sin(phase)
    reset = system.reset(first.mode, first.guard)
    state = [
        evaluated(reset[z].numerator, values) / evaluated(reset[z].denominator, values)
        for z in system.state
    ]
    last = table[0, 0] if system.autonomous else itinerary.periods * period
    times = np.array([*(table[1:, 0] - (0 if system.autonomous else table[0, 0])), last])
    rounds = int(last / period) + 1
    log = engine.follow([state], [first.to], periods=rounds, phase=phase, log=MOST + 1).log
    told = [(engine.words[int(line[2])], engine.modes[int(line[3])]) for line in log[: len(times)]]
    same = told == [(each.guard, each.to) for each in (*others, first)]
    return same and bool(np.abs(log[: len(times), 1] - times).max() < ROUGH)


def cycle(
    engine: Engine, state: Sequence[float], mode: str | None = None
) -> tuple[Itinerary, list[float]]:
    """Return the same of what an orbit of a system without a clock comes to after a long time.

    The time of the first contact is the period, those of the others count from it on.
    """
    modes = None if mode is None else [mode]
    ends = engine.follow([state], modes, periods=LONG, log=LONG * MOST)
    log = ends.log[-2 * MOST :]
    if ends.flags[0] or len(log) < 3:
        raise BadInput("the orbit is lost, begins outside its mode, or has few contacts")
    if len(engine.words) - 1 in log[:, 2]:
        raise BadInput("infinitely many contacts accumulate: no list of contacts proves the orbit")
    count = _round(log)
    if not count:
        raise BadInput("the orbit does not come back to a contact")
    log = log[-count - 1 :]
    names = [(engine.modes[int(line[3])], engine.words[int(line[2])]) for line in log]
    found = [Contact(a, word, b) for (a, _), (b, word) in pairwise(names)]
    times = list(log[:, 1] - log[0, 1])
    arrivals = _arrivals(engine, found, times, list(log[:, 4:]))
    rows = [[float(t), *q] for t, q in zip(times[1:], arrivals, strict=True)]
    contacts_, rows = [found[-1], *found[:-1]], [rows[-1], *rows[:-1]]
    return Itinerary(engine.system, contacts_), [x for row in rows for x in row]


def _round(log: Floats) -> int:
    """Return after how many events the last one came again, nearly; 0 if it did not."""
    last = log[-1]
    for count in range(1, min(MOST, len(log) - 1) + 1):
        other = log[-1 - count]
        same = (other[2:4] == last[2:4]).all()
        if same and np.abs(other[4:] - last[4:]).max() < 1e-5 * (1 + np.abs(last[4:]).max()):
            return count
    return 0


def _arrivals(
    engine: Engine, found: Sequence[Contact], times: Sequence[float], starts: Sequence[Floats]
) -> list[list[float]]:
    """Return the state just before each contact, from that after the one before."""
    flights = dict(zip(engine.modes, engine.exponentials, strict=True))
    omega, arrivals = float(number(engine.system.omega)), list[list[float]]()
    for contact, start, (a, b) in zip(found, starts, pairwise(times), strict=False):
        y = np.array([*start, np.cos(omega * a), np.sin(omega * a), 1.0])
        arrived = _flown(flights[contact.mode], y, b - a)[: len(start)]
        arrivals.append([float(x) for x in arrived])
    return arrivals


def _flown(E: Exponential, y: Floats, d: float) -> Floats:
    """Return exp(M d) y."""
    total = E.first * d + E.second * d**2 / 2
    x = E.rates * d
    for r, re, im in zip(np.exp(x) - 1 - x - x * x / 2, E.real, E.imaginary, strict=True):
        total = total + re * r.real + im * r.imag
    return np.asarray(y + total @ y)
