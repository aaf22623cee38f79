"""What a search for the orbits of a theorem is asked for, and what it finds."""

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from typing import NamedTuple

from cap.errors import BadInput
from cap.maps.fixed_point import Start
from cap.parameters import Parameters
from cap.particles.model import Guess


@dataclass(frozen=True)
class Request:
    """The theorem (a ``kind`` of orbits), the parameters, and what was said about the orbit.

    ``progress`` is told, in a few words, how far a long search is.
    """

    kind: str
    parameters: Parameters
    orbit: tuple[float, float] | None = None
    every: bool = False
    periods: int = 1
    masses: tuple[Fraction, ...] = ()
    progress: Callable[[str], None] = field(default=lambda _: None, compare=False)

    def no_orbit(self, why: str) -> None:
        """Raise `BadInput`, which says why, if an orbit or every one is asked for."""
        if self.orbit or self.every:
            raise BadInput(f"{why}: leave out --orbit and --all")


class Candidate(NamedTuple):
    """A guess, how it is shown, and the default order to which Φ is expanded at it.

    Of several masses the guess is ``particles``, and ``start`` the state of the first.
    """

    start: Start
    shown: str
    order: int = 3
    particles: Guess | None = None


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
