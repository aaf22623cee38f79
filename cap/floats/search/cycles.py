"""Periodic orbits with any itinerary, in floats: Newton's method for Φⁿ from one state.

The orbits steer the prover.  That Newton's method converges is no proof that an orbit exists.
`cap.floats.search.orbits` looks for all of them.
"""

import math
from dataclasses import dataclass

from cap.errors import BadInput, NotProved
from cap.floats.search.periodic import Guess
from cap.flow.itinerary import Happening, Path, itinerary
from cap.maps.stability import stability
from cap.parameters import Parameters
from cap.sets import matrix
from cap.sets.interval import Ball
from cap.sets.matrix import Matrix

SAME = 1e-7  # orbits whose states at t = 0 differ by less, in units of R and Rω, are one orbit
MOST_STEPS = 40  # of Newton's method
LONGEST = 0.2  # step, in units of R and Rω
CLOSE = 1e-9  # the last step and the residual, in the same units, of an orbit that is accepted

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

    @classmethod
    def of_guess(cls, p: Parameters, guess: Guess) -> "Cycle":
        """Return an orbit that never stops; its hit times say more than its state in doubles."""
        hits = [
            Happening("hit r", t, float(p.r), v) if v > 0 else Happening("hit l", t, float(p.l), v)
            for t, v in guess.hits
        ]
        path = Path(tuple(hits), (guess.x, guess.v), guess.monodromy, 0)
        return cls(guess.x, guess.v, 1, path, frictionless=p.f == 0)

    @property
    def events(self) -> tuple[tuple[str, float], ...]:
        """The words of its events and their times."""
        return tuple((event.word, event.time) for event in self.path.events)

    @property
    def kinds(self) -> frozenset[str]:
        """What happens: of "hit", "turn", "stick", "release" and "capture"."""
        return frozenset(word.split()[0] for word in self.path.words)

    @property
    def stops(self) -> bool:
        """Whether it comes to rest, so that one multiplier is 0."""
        return bool(self.kinds & {"stick", "capture"})

    @property
    def trace(self) -> float:
        """The trace of the monodromy matrix."""
        return matrix.trace(self.path.monodromy)

    @property
    def determinant(self) -> float:
        """Its determinant: 0 if the orbit sticks or is captured."""
        return 0.0 if self.stops else matrix.determinant(self.path.monodromy)

    def kind(self, *, conserves: bool) -> str:
        """The type as in `cap.maps.stability`, as far as floats can tell; else ``degenerate``."""
        det = Ball(self.determinant)
        if self.stops:
            det = Ball(0)
        elif conserves and self.kinds <= ({"hit", "turn"} if self.frictionless else {"hit"}):
            det = Ball(1)
        try:
            return stability(Ball(self.trace), det)
        except NotProved:
            return "degenerate"


class StroboscopicMap:
    """The map Φⁿ of one oscillator in floats, n = ``periods``, and Newton's method for it."""

    def __init__(self, p: Parameters, periods: int = 1) -> None:
        self.p, self.periods = p, periods
        self.T = 2 * math.pi / float(p.omega)
        self.scale = float(p.R), float(p.R * p.omega)

    def path(self, z: State, periods: int | None = None) -> Path:
        """Return the orbit of z over n periods, or over ``periods``."""
        return itinerary(self.p, *z, end=(periods or self.periods) * self.T)

    def defect(self, path: Path, z: State) -> State:
        """Return Φⁿ(z) - z."""
        return path.end[0] - z[0], path.end[1] - z[1]

    def size(self, step: State) -> float:
        """Return the size of a difference of states in natural units."""
        return max(abs(d) / unit for d, unit in zip(step, self.scale, strict=True))

    def newton(self, z: State) -> Cycle | None:
        """Return the periodic orbit to which damped Newton's method leads from z, or None.

        It goes on as long as the steps become shorter, up to rounding.
        """
        found, shortest = None, CLOSE
        for _ in range(MOST_STEPS):
            try:
                path = self.path(z)
                step = self._step(path.monodromy, self.defect(path, z))
            except (BadInput, ZeroDivisionError):
                break
            length = self.size(step)
            if length < shortest and self.size(self.defect(path, z)) < CLOSE:
                found, shortest = (z, path), length
            elif found or not length < 1e6:
                break
            damping = min(1.0, LONGEST / length) if length else 0.0
            z = z[0] - damping * step[0], z[1] - damping * step[1]
        if found is None or found[1].wall or found[0][1] == 0:
            return None
        (x, v), path = found
        return Cycle(x, v, self.periods, path, frictionless=self.p.f == 0)

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
    found = StroboscopicMap(p, periods).newton((x, v))
    if found is None:
        raise BadInput(
            f"no periodic orbit found from ({x!r}, {v!r}): Newton's method for the state at t = 0 "
            "does not converge, or leads to a mass at rest at t = 0"
        )
    return found
