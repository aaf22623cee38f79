"""Capture in a system of one's own: motions of a box, and how long they rest.

The motions are those of the certificate's own system, in floats.
"""

import numpy as np
from matplotlib.figure import Figure

from cap.checker.system.model import COS, SIN, Guard
from cap.checker.theorems.contact_capture import ContactCapture
from cap.floats.findings import Floats
from cap.pictures.style import BLACK, CYCLE, ORANGE, PURPLE
from cap.pictures.theorems.contacts import flight, value
from cap.pictures.theorems.parts import around, box

EVENTS, SAMPLES = 40, 2000  # of a motion that is drawn
TINY = 1e-6  # of the greatest height: a hit below is the last one that is drawn
PARTS = (0.15, 0.5, 0.85)  # of a side of the box, where motions begin
SEEN = 0.15  # of the time until the accumulation is over, shown after it

Piece = tuple[Floats, Floats]


def capture(theorem: ContactCapture, figure: Figure) -> None:
    """Draw heights of motions over the time, with what is proved of all of them, and the box."""
    claims, (first, second) = theorem.claims, theorem.p.state[:2]
    time, sides = figure.subplots(1, 2, width_ratios=[2, 1])
    accumulated = claims["accumulation_time"]
    begin, end = float(claims["start"]), float(accumulated.upper)
    motions = [(state, motion(theorem, state)) for state in starts(theorem)]
    for k, (state, pieces) in enumerate(motions):
        look = {"color": CYCLE[k % len(CYCLE)], "lw": 0.8}
        for n, (t, h) in enumerate(pieces):
            words = "_" if k or n else "motions of the box (floats)"
            time.plot(t, h, label=words, **look)
        sides.plot(*state[:2], ".", color=look["color"], ms=5)
    words = "in here their hits accumulate (proved)"
    time.axvspan(float(accumulated.lower), end, color=PURPLE, alpha=0.15, lw=0, label=words)
    last = end + SEEN * (end - begin)
    if "released_by" in claims:
        release = float(claims["rests_until"])
        last = max(last, release + SEEN * (release - begin))
        time.axvline(
            release, color=ORANGE, lw=1.2, label=f"then released: t = {release:.10g} (proved)"
        )
    time.set(xlim=(begin, last), xlabel="time $t$", ylabel=f"h, the guard {claims['guard']}")
    time.axhline(0, color=BLACK, lw=0.5)
    shown = claims["box"][first], claims["box"][second]
    box(sides, shown, "all of it comes to rest (proved)")
    around(sides, shown, 0.2)
    sides.set(xlabel=first, ylabel=second, title=f"the box at $t = {begin:g}$")
    figure.legend(loc="outside lower center", ncols=2)
    rests = (
        "for ever" if "for_ever" in claims else f"at least until {float(claims['rests_until']):g}"
    )
    rest = theorem.mode_of_rest()
    figure.suptitle(
        f"A box of states comes to rest in '{rest}', {rests}  (the certificate is "
        f"VERIFIED)\nspeeds at hits fall at least by the factor {float(claims['ratio']):g}",
        fontsize=10,
    )


def starts(theorem: ContactCapture) -> list[Floats]:
    """Return states of the box at which the guards of the mode are positive."""
    sides = [theorem.claims["box"][z] for z in theorem.p.state]
    low, high = (
        np.array([float(e) for e in ends]) for ends in zip(*(q[:2] for q in sides), strict=True)
    )
    guards = theorem.p.modes[theorem.claims["mode"]].guards.values()
    t = np.array(float(theorem.claims["start"]))
    parts = [np.array([a, b, *[0.5] * (len(low) - 2)]) for a in PARTS for b in PARTS]
    found = [low + part * (high - low) for part in parts]
    return [z for z in found if all(_at(theorem, g, t, z[None]) > 0 for g in guards)]


def motion(theorem: ContactCapture, state: Floats) -> list[Piece]:
    """Return the times and heights of a motion, flight by flight, until they are small."""
    p, claims = theorem.p, theorem.claims
    wall = p.modes[claims["falling"]].guards[claims["guard"]]
    mode, t, end = claims["mode"], float(claims["start"]), float(claims["accumulation_time"].upper)
    pieces, top = list[Piece](), 0.0
    while len(pieces) < EVENTS and t < end:
        key, times, path = _flown(theorem, mode, (t, end), state)
        h = _at(theorem, wall, times, path)
        pieces.append((times, np.maximum(h, 0)))
        top = max(top, float(h.max()))
        if h.max() < TINY * top or not key:
            break
        guard, t, state = p.modes[mode].guards[key], float(times[-1]), path[-1]
        state = _after(theorem, guard, t, state)
        mode = claims["rising"] if guard is wall else claims["falling"]
    return pieces


def _flown(
    theorem: ContactCapture, mode: str, window: tuple[float, float], state: Floats
) -> tuple[str, Floats, Floats]:
    """Return the guard that comes to zero first, '' if none does, with the flight until then."""
    begin, end, key = *window, ""
    for _ in range(4):  # finer each time
        t = np.linspace(begin, end, SAMPLES)
        path = flight(theorem.p, mode, t[::-1], state)[::-1]
        signs = {k: _at(theorem, g, t, path) for k, g in theorem.p.modes[mode].guards.items()}
        first = {k: int(np.argmax(q[2:] < 0)) + 2 for k, q in signs.items() if (q[2:] < 0).any()}
        if not first:
            return key, t, path
        key = min(first, key=lambda k: first[k])
        end = float(t[first[key]])
    return key, t[: first[key]], path[: first[key]]


def _after(theorem: ContactCapture, guard: Guard, t: float, state: Floats) -> Floats:
    """Return the state after an event."""
    known = _known(theorem, np.array([t]), state[None])
    below = value(guard.divisor, known)
    new = {z: value(q, known) / below for z, q in guard.reset.items()}
    return np.array([float(np.ravel(new.get(z, known[z]))[0]) for z in theorem.p.state])


def _at(theorem: ContactCapture, guard: Guard, t: Floats, path: Floats) -> Floats:
    """Return a guard along a path."""
    return value(guard.value, _known(theorem, t, path))


def _known(theorem: ContactCapture, t: Floats, path: Floats) -> dict[str, Floats]:
    """Return the clock and the state along a path."""
    w = value(theorem.p.frequency, {})
    state = dict(zip(theorem.p.state, path.T, strict=True))
    return {COS: np.cos(w * t), SIN: np.sin(w * t), **state}
