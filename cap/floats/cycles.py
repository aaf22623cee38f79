"""Search for periodic orbits with any itinerary, in floats: Newton's method on Φⁿ from many seeds.

The orbits found steer the prover.  That one is found is no proof that it exists, and that none is
found is no proof that there is none.
"""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from cap.errors import BadInput, NotProved
from cap.flow.itinerary import MOST_EVENTS, Path, itinerary
from cap.maps.stability import stability
from cap.parameters import Parameters
from cap.sets import matrix
from cap.sets.interval import Ball
from cap.sets.matrix import Matrix

SAME = 1e-7  # orbits whose states at t = 0 differ by less, in units of R and Rω, are one orbit
MOST_STEPS = 40  # of Newton's method
CLOSE = 1e-9  # the residual, in the same units, of an orbit that is accepted
SEEDS = 24  # positions, and as many velocities
MOST_FOLLOWED = 1_000_000  # events: half a minute
TRANSIENT = 30  # times n periods that a seed is followed before Newton's method, for sinks

State = tuple[float, float]


@dataclass(frozen=True)
class Cycle:
    """A float orbit of period ``periods`` T through (x, v) at t = 0, with its events.

    ``frictionless``: f = 0, so that a turn takes nothing.
    """

    x: float
    v: float
    periods: int
    path: Path
    frictionless: bool = False

    @property
    def events(self) -> tuple[tuple[str, float], ...]:
        """The words of its events and their times."""
        return tuple((event.word, event.time) for event in self.path.events)

    @property
    def trace(self) -> float:
        """The trace of the monodromy matrix."""
        return matrix.trace(self.path.monodromy)

    @property
    def determinant(self) -> float:
        """Its determinant: 0 if the orbit sticks or is captured."""
        stops = any(word.startswith(("stick", "capture")) for word in self.path.words)
        return 0.0 if stops else matrix.determinant(self.path.monodromy)

    def kind(self, *, conserves: bool) -> str:
        """The type as in `cap.maps.stability`, as far as floats can tell; else ``degenerate``."""
        words = {word.split()[0] for word, _ in self.events}
        det = Ball(self.determinant)
        if words & {"stick", "capture"}:
            det = Ball(0)
        elif conserves and words <= ({"hit", "turn"} if self.frictionless else {"hit"}):
            det = Ball(1)
        try:
            return stability(Ball(self.trace), det)
        except NotProved:
            return "degenerate"


class Search:
    """The map Φⁿ of one oscillator in floats, and Newton's method for its fixed points."""

    def __init__(self, p: Parameters, periods: int) -> None:
        self.p, self.periods = p, periods
        self.T = 2 * math.pi / float(p.omega)
        self.scale = float(p.R), float(p.R * p.omega)
        self.followed = 0
        self.ended = 0

    def path(self, z: State, periods: int | None = None) -> Path:
        """Return the orbit of z over n periods; ``followed`` counts events, ``ended`` orbits."""
        try:
            path = itinerary(self.p, *z, end=(periods or self.periods) * self.T)
        except BadInput:
            self.followed += MOST_EVENTS
            raise
        self.followed += len(path.events)
        self.ended += 1
        return path

    def defect(self, path: Path, z: State) -> State:
        """Return Φⁿ(z) - z."""
        return path.end[0] - z[0], path.end[1] - z[1]

    def size(self, step: State) -> float:
        """Return the size of a difference of states in natural units."""
        return max(abs(d) / unit for d, unit in zip(step, self.scale, strict=True))

    def newton(self, z: State) -> Cycle | None:
        """Return the periodic orbit to which damped Newton's method leads from z, or None."""
        for _ in range(MOST_STEPS):
            try:
                path = self.path(z)
                step = self._step(path.monodromy, self.defect(path, z))
            except (BadInput, ZeroDivisionError):
                return None
            large = self.size(step)
            if large < CLOSE and self.size(self.defect(path, z)) < CLOSE:
                if path.wall or z[1] == 0:
                    return None
                return Cycle(*z, self.periods, path, frictionless=self.p.f == 0)
            if not large < 1e6:
                return None
            damping = min(1.0, 0.2 / large)
            z = z[0] - damping * step[0], z[1] - damping * step[1]
        return None

    @staticmethod
    def _step(monodromy: Matrix[float], defect: State) -> State:
        return matrix.apply(matrix.inverse(matrix.minus_identity(monodromy)), defect)

    def mirrored(self, cycle: Cycle) -> State | None:
        """Return the state at t = 0 of the orbit that the symmetry makes of one, None at a wall.

        That is (x, v, t) -> (l + r - x, -v, t + T/2).
        """
        half = itinerary(self.p, cycle.x, cycle.v, end=self.T / 2)
        x, v = half.end
        return None if half.wall else (float(self.p.l + self.p.r) - x, -v)

    def add(self, found: list[Cycle], z: State | None) -> None:
        """Add the orbit to which Newton's method leads from z, if it is new."""
        cycle = self.newton(z) if z else None
        if cycle is None or not self.is_primitive(cycle):
            return
        if all(self.size((cycle.x - c.x, cycle.v - c.v)) >= SAME for c in found):
            found.append(cycle)

    def is_primitive(self, cycle: Cycle) -> bool:
        """Return whether no part of n periods is a period already."""
        z = cycle.x, cycle.v
        parts = (d for d in range(1, self.periods) if self.periods % d == 0)
        return all(self.size(self.defect(self.path(z, d), z)) > SAME for d in parts)


def near(p: Parameters, x: float, v: float, periods: int = 1) -> Cycle:
    """Return the nT-periodic orbit to which Newton's method leads from (x, v), n = ``periods``.

    Raises `BadInput` if none is reached, or (x, v) is no state.
    """
    itinerary(p, x, v, 0.0)
    found = Search(p, periods).newton((x, v))
    if found is None:
        raise BadInput(
            f"no periodic orbit found from ({x!r}, {v!r}): Newton's method for the state at t = 0 "
            "does not converge, or leads to a mass at rest at t = 0"
        )
    return found


def cycles(
    p: Parameters,
    periods: int = 1,
    progress: Callable[[int, int], None] = lambda _starts, _found: None,
) -> list[Cycle]:
    """Return the orbits found of least period ``periods`` T, ascending in x, then v.

    Seeds fill the rectangle of all x and |v| <= 2 F/ω + Rω/2.  Newton's method starts from each,
    and from where it is after a transient, which finds the sinks; compiled, from many more; and
    from the mirror images of the orbits found.  ``progress`` is told the numbers of starts and of
    orbits so far; after `MOST_FOLLOWED` events the search ends, and where no orbit of the first
    `SEEDS` + 1 seeds comes to an end.
    Raises `BadInput` if it has found nothing by then.
    """
    search = Search(p, periods)
    found: list[Cycle] = []
    for number, z in enumerate(_starts(search)):
        progress(number, len(found))
        search.add(found, z)
        if search.followed > MOST_FOLLOWED or (number >= SEEDS and not search.ended):
            break
    if not found and (search.followed > MOST_FOLLOWED or not search.ended):
        raise BadInput(
            f"no periodic orbit was found among the first {search.followed} events: the orbits "
            "have too many of them in a period for a search (a guess can be given with --orbit X V)"
        )
    if search.followed <= MOST_FOLLOWED:
        from cap.floats.newton import fixed_points  # noqa: PLC0415 (the compiled engine)

        for x, v in fixed_points(p, periods).tolist():
            search.add(found, (x, v))
    for cycle in found:  # and those that this adds
        search.add(found, search.mirrored(cycle))
    return sorted(found, key=lambda c: (c.x, c.v))


def _starts(search: Search) -> Iterable[State]:
    """Give the seeds, and some of them after a transient."""
    p = search.p
    l, length = float(p.l), float(p.R)
    fastest = 2 * float(p.F / p.omega) + float(p.R * p.omega) / 2
    for i in range(SEEDS):
        for j in range(SEEDS):
            z = l + length * (i + 0.5) / SEEDS, fastest * (2 * (j + 0.5) / SEEDS - 1)
            yield z
            if i % 6 == j % 6 == 0:
                try:
                    path = search.path(z, TRANSIENT * search.periods)
                except BadInput:
                    continue
                if not path.wall:
                    yield path.end
