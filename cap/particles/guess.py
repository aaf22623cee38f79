"""An orbit of several masses in floats, from which a proof starts."""

from dataclasses import dataclass
from fractions import Fraction


@dataclass(frozen=True)
class Guess:
    """An orbit in floats: masses, and of each event its word, time, positions, velocities before.

    Its period is ``periods`` T; ``further`` are others of its family.  It needs no trust.
    """

    masses: tuple[Fraction, ...]
    events: tuple[tuple[str, float, tuple[float, ...], tuple[float, ...]], ...]
    further: tuple["Guess", ...] = ()
    periods: int = 1
