"""What a search for the orbits of a theorem is asked for, and what it finds."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, NamedTuple

from cap.errors import BadInput
from cap.maps.fixed_point import Start
from cap.parameters import Parameters
from cap.particles.guess import Guess


@dataclass(frozen=True)
class Request:
    """The theorem (a ``kind`` of orbits), the parameters, and what was said about the orbit.

    ``options`` are those of the theorem that are given, by name.  ``progress`` is told, in
    a few words, how far a long search is.
    """

    kind: str
    parameters: Parameters
    orbit: tuple[float, float] | None = None
    every: bool = False
    options: Mapping[str, Any] = field(default_factory=dict)
    progress: Callable[[str], None] = field(default=lambda _: None, compare=False)

    @property
    def periods(self) -> int:
        """The n of the period nT that is asked for."""
        return int(self.options.get("period", 1))

    @property
    def masses(self) -> tuple[Fraction, ...]:
        """The masses, if there are several."""
        return tuple(self.options.get("masses", ()))

    def no_orbit(self, why: str) -> None:
        """Raise `BadInput`, which says why, if an orbit or every one is asked for."""
        if self.orbit or self.every:
            raise BadInput(f"{why}: leave out --orbit and --all")


class Candidate(NamedTuple):
    """A guess, and how it is shown.

    Of several masses the guess is ``particles``, and ``start`` the state of the first.
    """

    start: Start
    shown: str
    particles: Guess | None = None

    @property
    def guess(self) -> Start | Guess:
        """What a proof starts from."""
        return self.particles or self.start


class Found(NamedTuple):
    """What a search found, in words, and the candidates that are to be proved."""

    lines: list[str]
    candidates: list[Candidate]


class Release(NamedTuple):
    """A release to the right: its place x, and the derivative of the release map there."""

    x: float
    slope: float


class Turning(NamedTuple):
    """A state at t = 0 of a cycle of the period ``periods`` T, with the rows of its derivative.

    Or one of its image by (x, v, t) -> (l + r - x, -v, t + T/2).
    """

    x: float
    v: float
    periods: int
    monodromy: tuple[tuple[float, float], tuple[float, float]]


Search = Callable[[Request], Found]
