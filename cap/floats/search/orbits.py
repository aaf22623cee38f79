"""The search for periodic orbits that all commands share.

Three kinds of seeds: hit times, for the orbits that never stop (`cap.floats.search.periodic`);
states all over the plane, some of them after a transient (`cap.floats.search.newton`); and the
mirror images of what is found.  Isolated orbits are listed one by one, families as families.

The orbits found steer the prover.  That one is found is no proof that it exists, and that none is
found is no proof that there is none.  Orbits at rest at a wall at t = 0 are not searched for: they
are no interior fixed points of Φⁿ.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from cap.errors import BadInput
from cap.floats.search import periodic
from cap.floats.search.cycles import SAME, Cycle, State, StroboscopicMap
from cap.floats.search.family import Family, families
from cap.floats.search.periodic import Guess
from cap.parameters import Parameters

HITS = range(2, periodic.MOST_HITS + 1, 2)  # per period, of orbits that never stop


@dataclass(frozen=True)
class Orbits:
    """The isolated orbits found of least period n T, ascending in x, then v; and the families.

    ``never_stopping``: those of e = 1, μ = 0 whose velocity never vanishes, as guesses.
    """

    isolated: tuple[Cycle, ...]
    families: tuple[Family, ...]
    never_stopping: tuple[Guess, ...]


def from_hit_times(p: Parameters) -> Iterator[list[Guess]]:
    """Give the orbits found that never stop, those with the fewest hits first.  No e, no μ."""
    for hits in HITS:
        yield periodic.orbits(p, hits)


def search(
    p: Parameters, periods: int = 1, tell: Callable[[float], None] = lambda _part: None
) -> Orbits:
    """Return the orbits found of least period ``periods`` T.  ``tell`` hears which part is done.

    Raises `BadInput` if nothing was found because the orbits have too many events.
    """
    found = _Found(StroboscopicMap(p, periods))
    if p.conserves and periods == 1:
        for guess in (guess for guesses in from_hit_times(p) for guess in guesses):
            found.include(Cycle.of_guess(p, guess), guess)
    try:
        found.from_seeds(tell)
    except BadInput:
        if not found.cycles:
            raise
    found.add_mirror_images()
    return found.orbits()


class _Found:
    """The orbits found so far, and the guesses of those that never stop."""

    def __init__(self, strobe: StroboscopicMap) -> None:
        self.strobe = strobe
        self.cycles: list[Cycle] = []
        self.guesses: list[Guess | None] = []

    def include(self, cycle: Cycle, guess: Guess | None = None) -> None:
        """Add an orbit, if it is isolated, new, and of no smaller period.

        An orbit without a hit is one of a family.
        """
        if "hit" not in cycle.kinds or not (guess or self.strobe.is_primitive(cycle)):
            return
        distances = (self.strobe.size((cycle.x - c.x, cycle.v - c.v)) for c in self.cycles)
        if all(distance >= SAME for distance in distances):
            self.cycles.append(cycle)
            self.guesses.append(guess)

    def from_state(self, z: State | None) -> None:
        """Add the orbit to which Newton's method leads from z."""
        cycle = self.strobe.newton(z) if z else None
        if cycle:
            self.include(cycle)

    def from_seeds(self, tell: Callable[[float], None]) -> None:
        """Add those that Newton's method reaches from all over the plane."""
        from cap.floats.search.newton import fixed_points  # noqa: PLC0415 (the compiled engine)

        for x, v in fixed_points(self.strobe.p, self.strobe.periods, tell).tolist():
            self.from_state((x, v))

    def add_mirror_images(self) -> None:
        """Add the mirror images of all, and of those that this adds."""
        for cycle in self.cycles:
            self.from_state(self.strobe.mirrored(cycle))

    def orbits(self) -> Orbits:
        """Return them in order."""
        p, n = self.strobe.p, self.strobe.periods
        pairs = sorted(zip(self.cycles, self.guesses, strict=True), key=lambda c: (c[0].x, c[0].v))
        never = [each for each in pairs if p.conserves and n == 1 and each[0].kinds == {"hit"}]
        return Orbits(
            tuple(cycle for cycle, _ in pairs),
            families(p) if n == 1 else (),
            tuple(guess or _guess(p, cycle) for cycle, guess in never),
        )


def _guess(p: Parameters, cycle: Cycle) -> Guess:
    words = cycle.path.words
    return periodic.through(p, [t for _, t in cycle.events], right_first=words[0] == "hit r")
