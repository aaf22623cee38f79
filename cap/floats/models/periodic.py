"""Periodic orbits of any system in doubles: what a search meets, as guesses for a proof.

States are drawn at random, on many scales.  What they are attracted to, and those that come back
nearest to themselves, are followed once more; Newton's iteration on the contacts of that orbit
(`cap.orbits.equations`) leads to orbits that close.  Nothing that is found is all that there is.

Proofs about one's own systems import no other module of the float mode.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput, NotProved
from cap.floats.models.contacts import contacts, cycle, meets
from cap.floats.models.engine import Engine, Integers
from cap.floats.models.spectrum import Floats
from cap.orbits.equations import Equations
from cap.orbits.itinerary import Itinerary
from cap.orbits.leg import Kinds
from cap.orbits.numbers import Floats as Doubles
from cap.orbits.periodic import Prover
from cap.system.model import System

SEEDS, SETTLED, SETTLING, NEAREST = 4000, 400, 300, 120
FAR = 1e6  # of what runs away
TRIED = 12  # states of a system without a clock
SAME = 1e-6  # times and states of one orbit
PERIODS = range(1, 33)  # after which what attracts may close

Tell = Callable[[str, float | None], None]


class Closed(NamedTuple):
    """An orbit that closes up to rounding: its contacts, times and states there, multipliers.

    ``falling``: the largest rate of a guard at its contact, which is near 0 at a graze.
    """

    itinerary: Itinerary
    guess: list[float]
    multipliers: NDArray[np.complex128]
    falling: float

    @property
    def attracts(self) -> bool:
        """Whether all multipliers are inside the unit circle."""
        return bool(np.abs(self.multipliers).max() < 1 - SAME)

    @property
    def neutral(self) -> bool:
        """Whether a multiplier is 1 up to rounding: a fold, or one of a family of orbits."""
        return bool(np.abs(self.multipliers - 1).min() < SAME)

    @property
    def elliptic(self) -> bool:
        """Whether the multipliers are two on the unit circle up to rounding, not real."""
        z = self.multipliers
        return z.size == 2 and bool(z.imag.all() and np.abs(np.abs(z) - 1).max() < SAME)

    def shown(self) -> str:
        """Return it in a line."""
        first = self.itinerary.contacts[0]
        counts = Counter(contact.guard for contact in self.itinerary.contacts)
        places = zip(self.itinerary.system.state, self.guess[1:], strict=False)
        state = ", ".join(f"{z} = {q:.6g}" for z, q in places)
        real = [f"{x.real:.4g}" for x in self.multipliers if not x.imag]
        pairs = [f"{x.real:.4g} +- {x.imag:.4g} i" for x in self.multipliers if x.imag > 0]
        values = ", ".join([*real, *pairs])
        words = ", ".join(f"{n} x {guard}" for guard, n in counts.items())
        time = f"the period {self.guess[0]:.6g}" if self.itinerary.system.autonomous else ""
        time = time or f"t = {self.guess[0]:.6g}"
        return f"{words}; {first.guard} at {time}, {state}; multipliers {values}"


@dataclass
class Met:
    """What a search has met: orbits that close, and what became of states after a long time.

    Of so many states that were ``settled``, some were ``captured``, which means that infinitely
    many contacts accumulated in a period; the others that close by themselves do so after
    ``periods``, here those that were not asked for.  Orbits that are ``neutral`` are apart.
    """

    orbits: list[Closed] = field(default_factory=list)
    periods: Counter[int] = field(default_factory=Counter)
    settled: int = 0
    captured: int = 0
    neutral: list[Closed] = field(default_factory=list)


def search(system: System, periods: int, tell: Tell) -> Met:
    """Return the orbits of a period that are met, those that attract first."""
    tell("compiling the system", None)
    engine = Engine(system)
    seeds, modes = _seeds(engine)
    met, kinds, alone = Met(), Kinds(system), system.autonomous
    tell("following random states", None)
    if alone:
        tried = zip(seeds[:TRIED], modes, strict=False)
        starts = [(state, engine.modes[mode]) for state, mode in tried]
    else:
        starts = list(_starts(engine, seeds, modes, periods, met))
    for k, (state, mode) in enumerate(starts):
        tell("searching", k / len(starts))
        try:
            z = state.tolist()
            guess = cycle(engine, z, mode) if alone else contacts(engine, z, mode, periods)
            found = closed(*guess, kinds)
            if found.falling < -SAME and meets(engine, found.itinerary, found.guess):
                _add(met, found)
        except (BadInput, NotProved):  # it is captured, meets nothing, or leads nowhere
            continue
    met.orbits.sort(key=lambda orbit: (not orbit.attracts, len(orbit.guess)))
    return met


def followed(system: System, periods: int) -> Iterator[tuple[Itinerary, list[float]]]:
    """Give orbits that close nearly, as they are followed: their contacts, times and states there.

    They are not corrected: where orbits are a family Newton's iteration is singular.
    """
    engine = Engine(system)
    seeds, modes = _seeds(engine)
    for start, where in _starts(engine, seeds, modes, periods, Met()):
        with suppress(BadInput, NotProved):
            yield contacts(engine, start.tolist(), where, periods)


def near(system: System, state: list[float], mode: str | None, periods: int) -> Closed:
    """Return the orbit to which Newton's iteration leads from a state at t = 0."""
    engine = Engine(system)
    if system.autonomous:
        return closed(*cycle(engine, state, mode), Kinds(system))
    return closed(*contacts(engine, state, mode, periods), Kinds(system))


def closed(itinerary: Itinerary, guess: list[float], kinds: Kinds) -> Closed:
    """Return the orbit with an itinerary near a guess, its first contact in the first period.

    Raises `NotProved` if Newton's iteration finds none.
    """
    equations = Equations(itinerary, kinds)
    found = Prover(equations).newton(guess)
    period = Doubles(itinerary.system).period
    times = np.array(found[:: equations.n + 1])
    if equations.autonomous:
        last, begins = times[0], np.array([0.0, *times[1:]])
    else:
        times -= np.floor(found[0] / period) * period
        last, begins = times[0] + itinerary.periods * period, times
    if not (np.diff([*begins, last]) > 0).all():
        raise NotProved("Newton", "the contacts are not in order", {"t": list(times)})
    found[:: equations.n + 1] = times.tolist()
    return Closed(itinerary, found, *_multipliers(equations, found))


def _multipliers(equations: Equations, z: list[float]) -> tuple[NDArray[np.complex128], float]:
    """Return the multipliers, the eigenvalues of a round but for one 0; the largest rate."""
    blocks = equations.blocks(z, Doubles(equations.itinerary.system))
    total, falling = np.eye(equations.n + 1), -np.inf
    for block, following in zip(blocks, [*blocks[1:], blocks[0]], strict=True):
        rows, guard = np.array(block.rows, float), np.array(following.guard, float)
        by, last = rows[:, :-1], rows[:, -1]
        rate = float(guard[0] + guard[1:] @ last)
        time, falling = -(guard[1:] @ by) / rate, max(falling, rate)
        total = np.vstack([time, by + np.outer(last, time)]) @ total
    values = np.linalg.eigvals(total[1:, 1:] if equations.autonomous else total)
    return np.sort_complex(np.delete(values, np.argmin(np.abs(values))))[::-1], falling


def _seeds(engine: Engine) -> tuple[Floats, Integers]:
    """Return random states, and the mode of each: one in which nothing rests."""
    random = np.random.default_rng(1)
    n = len(engine.system.state)
    states = random.normal(size=(SEEDS, n)) * 2.0 ** random.uniform(-3, 3, size=(SEEDS, 1))
    inside = engine.inside(states) & engine.free[:, np.newaxis]
    kept = inside.any(axis=0)
    if not kept.any():
        raise BadInput("no random state lies in a mode: give a state with --orbit")
    return states[kept], np.argmax(inside[:, kept], axis=0)


def _starts(
    engine: Engine, seeds: Floats, modes: Integers, periods: int, met: Met
) -> Iterator[tuple[Floats, str]]:
    """Give the states from which to begin: where orbits settle, and what comes back nearest."""
    some = slice(None, None, max(1, len(seeds) // SETTLED))
    ends = engine.follow(seeds[some], modes[some], periods=SETTLING)
    well = (ends.flags == 0) & (np.abs(ends.states) < FAR).all(axis=1)
    settled, where = ends.states[well], ends.modes[well]
    yield from _attracted(engine, settled, where, periods, met)
    cloud, places = np.vstack([seeds, settled]), np.concatenate([modes, where])
    back = engine.follow(cloud, places, periods=periods)
    distance = np.abs(back.states - cloud).max(axis=1) / (1 + np.abs(cloud).max(axis=1))
    captured = back.counts[:, -1] > 0
    distance[(back.flags != 0) | (back.modes != places) | captured] = np.inf
    near = np.argsort(distance)[: np.isfinite(distance).sum()]
    far = near[distance[near] >= SAME]  # not what attracts, nor one of a continuum: saddles
    for k in dict.fromkeys([*near[:NEAREST].tolist(), *far[:NEAREST].tolist()]):
        yield cloud[k], engine.modes[places[k]]


def _attracted(
    engine: Engine, settled: Floats, where: Integers, periods: int, met: Met
) -> Iterator[tuple[Floats, str]]:
    """Give the different ends that close after the periods; note what the others do."""
    at, here = settled, where
    least, captured = np.zeros(len(settled), dtype=int), np.zeros(len(settled), dtype=bool)
    for n in PERIODS if len(settled) else ():
        ends = engine.follow(at, here, periods=1)
        at, here, captured = ends.states, ends.modes, captured | (ends.counts[:, -1] > 0)
        closes = (np.abs(at - settled).max(axis=1) < SAME) & (here == where)
        least[(least == 0) & closes] = n
    met.settled, met.captured = len(settled), int(captured.sum())
    met.periods.update(int(n) for n in least[~captured] if n and n != periods)
    wanted = np.flatnonzero((least == periods) & ~captured)
    _, first, counts = np.unique(
        settled[wanted].round(5), axis=0, return_index=True, return_counts=True
    )
    often = np.sort(np.argsort(-counts, kind="stable")[:NEAREST])  # not each of a continuum
    for k in wanted[first[often]]:
        yield settled[k], engine.modes[where[k]]


def _add(met: Met, orbit: Closed) -> None:
    """Note an orbit, unless it is known, or has a smaller period."""
    n = orbit.itinerary.periods
    shorter = any(_repeats(orbit, k) for k in range(2, n + 1) if n % k == 0)
    listed = met.neutral if orbit.neutral else met.orbits
    if not shorter and not any(_same(orbit, known) for known in listed):
        listed.append(orbit)


def _table(orbit: Closed) -> Floats:
    """Return times and states, a row for each contact."""
    return np.array(orbit.guess).reshape(len(orbit.itinerary.contacts), -1)


def _repeats(orbit: Closed, parts: int) -> bool:
    """Return whether an orbit is a shorter one, so many times."""
    count = len(orbit.itinerary.contacts)
    return count % parts == 0 and _follows(orbit, orbit, count // parts)


def _same(one: Closed, other: Closed) -> bool:
    """Return whether two orbits are one, whichever contact comes first."""
    count = len(one.itinerary.contacts)
    equal = len(other.itinerary.contacts) == count
    return equal and any(_follows(one, other, shift) for shift in range(count))


def _follows(one: Closed, other: Closed, shift: int) -> bool:
    """Return whether the other orbit, from a contact on, is this one some periods later."""
    listed = list(other.itinerary.contacts)
    if list(one.itinerary.contacts) != [*listed[shift:], *listed[:shift]]:
        return False
    period = Doubles(one.itinerary.system).period
    ours, theirs = _table(one), np.roll(_table(other), -shift, axis=0)
    if one.itinerary.system.autonomous:
        size = 1 + np.abs(ours).max()
        return bool(np.abs(ours - theirs)[:, 1:].max() < SAME * size)
    theirs[len(theirs) - shift :, 0] += one.itinerary.periods * period
    theirs[:, 0] -= round((theirs[0, 0] - ours[0, 0]) / period) * period
    return bool(np.abs(ours - theirs).max() < SAME * (1 + np.abs(ours).max()))
