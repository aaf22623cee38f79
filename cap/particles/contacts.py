"""What theorems say of the contacts of an orbit of N masses, and of the form Σ m_i dv_i ∧ dx_i.

Friction forces are equal.  So a collision preserves the form if it keeps the sum of the signs of
the velocities; flights and hits of elastic walls preserve it.
"""

from collections.abc import Sequence

from cap.errors import NotProved
from cap.maps.zero import Box
from cap.orbits.itinerary import Itinerary
from cap.orbits.periodic import Prover
from cap.particles.guess import Guess
from cap.sets import interval
from cap.sets.interval import Ball

Rows = list[list[Ball]]
SIGNS = {"+": 1, "-": -1, "0": 0}


def never_rest(guess: Guess) -> None:
    """Raise `NotProved` unless all events of a guess are contacts."""
    for word, *_ in guess.events:
        if word.split()[0] not in ("hit", "meet"):
            raise NotProved("itinerary", f"{word!r} is no contact: a mass stops", {})


def signs_are_kept(itinerary: Itinerary) -> None:
    """Prove that no collision changes the sum of the signs of the velocities."""
    for mode, guard, to in itinerary.contacts:
        before, after = (sum(SIGNS[s] for s in name) for name in (mode, to))
        if guard.startswith("meet") and before != after:
            sets = {"before": mode, "after": to}
            raise NotProved("collision", "it changes the sum of the signs of velocities", sets)


def in_one_period(prover: Prover, box: Box) -> None:
    """Prove that all contacts are between 0 and the end of the round."""
    first, last = box[0], box[-1 - len(prover.itinerary.system.state)]
    if not (first > 0 and last < prover.balls.period * prover.itinerary.periods):
        raise NotProved("events", "they may be out of order", {"first": first, "last": last})


def no_other_contacts(prover: Prover, box: Box) -> None:
    """Prove that the contacts are these, in one period, if no mass stops between them."""
    in_one_period(prover, box)
    signs_are_kept(prover.itinerary)
    prover.reasons(box, without=stops(prover))


def speeds_at_contacts(prover: Prover, box: Box) -> None:
    """Prove that all velocities have the signs of their flights at the ends of these."""
    for leg in prover.legs(box):
        for name in stops(prover):
            h = prover.along(leg, name)
            h.positive(h.at(leg.start), leg.start.time)
            h.positive(h.at(leg.end), leg.end.time)


def stops(prover: Prover) -> list[str]:
    """Return the guards of the velocities."""
    return [f"stop {i + 1}" for i in range(len(prover.itinerary.system.state) // 2)]


def directions(prover: Prover, box: Box) -> None:
    """Prove that masses move as their modes say just after all contacts in a box."""
    kinds, vanishing = prover.equations.kinds, prover.itinerary.vanishing
    for leg in prover.legs(box):
        mode, zeros = prover.itinerary.flown(leg.number), vanishing[leg.number]
        for name in prover.itinerary.system.modes[mode].guards:
            if name.startswith("stop") and not zeros[name]:
                v = prover.balls.of(kinds.watch(mode, name).at)(*leg.start.clock, *leg.start.state)
                if not v[0] > 0:
                    sets = {"t": leg.start.time, "v": v[0]}
                    raise NotProved("directions", "a velocity may vanish after a contact", sets)


def closing_speeds(prover: Prover, contacts: Sequence[tuple[Ball, Box]]) -> list[Ball]:
    """Return the rate at which the gap closes at each contact, proved positive."""
    found, of = list[Ball](), prover.balls
    for (mode, guard, _), (t, q) in zip(prover.itinerary.contacts, contacts, strict=True):
        rate = of.of(prover.equations.kinds.watch(mode, guard).rate)(*of.clock(t), *q)[0]
        if not rate < 0:
            sets = {"time": t, "closing speed": -rate}
            raise NotProved("contact", "an event may not be transverse", sets)
        found.append(-rate)
    return found


def least_speeds(prover: Prover, box: Box) -> list[Ball]:
    """Return the least speed of each mass, on an orbit on which none rests or stops."""
    return [prover.least(box, name) for name in stops(prover)]


def symplectic_defect(masses: Sequence[Ball], D: Rows) -> list[Ball]:
    """Return the entries of Dᵀ J D - J above the diagonal, J the form Σ m_i dv_i ∧ dx_i.

    The coordinates are (x_1, .., x_N, v_1, .., v_N).
    """
    n, m = len(masses), masses
    return [
        interval.total(m[k] * (D[n + k][i] * D[k][j] - D[k][i] * D[n + k][j]) for k in range(n))
        - (-m[i] if j == n + i else 0)
        for i in range(2 * n)
        for j in range(i + 1, 2 * n)
    ]
