"""Where orbits of N masses end: attractors told apart by their period and their events.

Nothing is proved: seeds are drawn at random, and an orbit on which no mass stopped for some periods
may stop later.
"""

from collections import defaultdict
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cap.errors import BadInput
from cap.floats.findings import Floats
from cap.floats.masses.mass_swarm import KINDS, Ends, Seeds, swarm
from cap.floats.masses.masses import OfMasses, drawn, system_of
from cap.floats.masses.particles import Particles
from cap.floats.models.samples import least
from cap.parameters import Parameters
from cap.runner import Runner

LONGEST = 12  # of the periods that are looked for, in T
CLOSE = 1e-6  # a state that returns, in units of R and Rω
NONE = -1
MOST = 1_000_000  # seeds x periods
NEVER, SLIDING, APERIODIC = "no mass stopped", "sliding, no contact", "aperiodic"
Key = tuple[str, int, tuple[int, ...]]


@dataclass(frozen=True)
class MassAttractor:
    """Where some orbits end: ``period`` in T, 0 if there is none; their states (K, 2N) late.

    ``share`` of the seeds; hits, collisions, turns and sticks per period T.
    """

    kind: str
    period: int
    share: float
    hits: float
    collisions: float
    turns: float
    sticks: float
    states: Floats

    def line(self) -> str:
        """Return it in words."""
        return (
            f"{self.share:7.2%}  {self.kind:<20} hits {self.hits:.4g}, collisions "
            f"{self.collisions:.4g}, turns {self.turns:.4g}, sticks {self.sticks:.4g} per T"
        )


@dataclass(frozen=True, kw_only=True)
class MassAttractors(OfMasses):
    """Seeds (M, 2N), the place ``label`` (M,) of what each ends on in ``found``, -1: lost."""

    seeds: Floats
    label: NDArray[np.int64]
    found: tuple[MassAttractor, ...]

    def columns(self) -> dict[str, ArrayLike]:
        """Return the seeds and where they end."""
        n = self.seeds.shape[1] // 2
        named = {f"{'xv'[k // n]}_{k % n + 1}": self.seeds[:, k] for k in range(2 * n)}
        return {**named, "attractor": self.label}

    def lines(self) -> list[str]:
        """Return where orbits end, the largest share first."""
        head = f"attractors at {self.system} from {len(self.label)} seeds"
        rows = [f"  {k}  {each.line()}" for k, each in enumerate(self.found, 1)]
        lost = int((self.label == NONE).sum())
        return [
            head,
            *rows,
            *([f"  {lost} seeds are lost (contacts accumulate), or not done"] if lost else []),
        ]


def attractors(  # noqa: PLR0913 (the options of the command)
    p: Parameters,
    *,
    masses: tuple[Fraction, ...],
    proportional: bool = False,
    points: int = 12,
    transient: int = 120,
    periods: int = 24,
    runner: Runner | None = None,
) -> MassAttractors:
    """Follow points x points random seeds, and tell apart where they end."""
    runner = runner or Runner()
    seen = max(periods, 2 * LONGEST)
    if points**2 * (transient + seen) > MOST:
        raise BadInput(f"too many periods: {points} x {points} seeds, {transient + seen} each")
    system = system_of(p, masses, proportional)
    seeds = drawn(system, points**2, 3)
    ends = swarm(Seeds(system, transient + seen, seen), seeds, runner, "attractors")
    label, found = sort(system, ends)
    return MassAttractors(
        parameters=p,
        complete=not runner.interrupted,
        masses=masses,
        proportional=proportional,
        seeds=seeds,
        label=label,
        found=found,
    )


def sort(system: Particles, ends: Ends) -> tuple[NDArray[np.int64], tuple[MassAttractor, ...]]:
    """Return the place of each seed's end, and the ends, the largest share first."""
    groups = defaultdict[Key, list[int]](list)
    for k in range(len(ends.states)):
        if np.isfinite(ends.states[k]).all():
            groups[_key(system, ends, k)].append(k)
    label = np.full(len(ends.states), NONE)
    found = []
    for place, key in enumerate(sorted(groups, key=lambda key: (-len(groups[key]), key))):
        label[groups[key]] = place
        found.append(_attractor(ends, key, groups[key]))
    return label, tuple(found)


def _key(system: Particles, ends: Ends, k: int) -> Key:
    """Return what an orbit ends on: its kind, period, and events in a period."""
    if not ends.stopped[k].any():
        return NEVER, 0, ()
    states, p = ends.states[k], system.parameters
    units = np.repeat([float(p.R), float(p.R * p.omega)], states.shape[1] // 2)
    q = least(states / units, LONGEST, CLOSE)
    if not q:
        return APERIODIC, 0, ()
    counts = ends.counts[k, -q:].sum(axis=0)
    kind = f"period {q} T seen" if counts[:2].any() else SLIDING
    return kind, q, tuple(counts.tolist())


def _attractor(ends: Ends, key: Key, orbits: list[int]) -> MassAttractor:
    kind, q, _ = key
    rates = ends.counts[orbits].mean(axis=(0, 1))
    per = dict(zip(KINDS, rates.tolist(), strict=True))
    states = ends.states[orbits][:, -(q or len(ends.states[0])) :]
    return MassAttractor(
        kind, q, len(orbits) / len(ends.states), per["hit"], per["meet"], per["turn"], per["stick"],
        states.reshape(-1, states.shape[-1]),
    )  # fmt: skip
