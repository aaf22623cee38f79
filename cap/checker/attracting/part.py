"""What each kind of what attracts has: the form of its claim, a proof, and what follows from it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from typing import Any, ClassVar

from cap.checker.folded.basins import Basins
from cap.checker.folded.units import Units
from cap.checker.kernel.citation import Citation
from cap.checker.kernel.shapes import Enclosure
from cap.checker.kernel.theorem import Theorem


class Part(ABC):
    """What a certificate claims to attract, of one kind.

    ``CLAIM`` is the shape of the claim, ``HINTS`` that of its own hints, ``CITES`` what it cites.
    """

    CLAIM: ClassVar[Any]
    HINTS: ClassVar[Any] = None
    CITES: ClassVar[tuple[Citation, ...]] = ()

    def __init__(self, theorem: Theorem, claim: Any) -> None:
        self.theorem, self.claim, self.scale = theorem, claim, Units(theorem.p)

    @classmethod
    def limit(cls, hints: dict[str, Any], claim: Any) -> None:  # noqa: ARG003
        """Reject what would take too long to check; by default nothing."""
        return

    @abstractmethod
    def prove(self, known: Basins) -> None:
        """Prove the claim, or reject; ``known`` is what is claimed of the basins of all kinds."""

    def basins(self) -> Basins:
        """Return states that are attracted."""
        return Basins()

    def kept(self) -> list[Enclosure]:
        """Return intervals of places: what is released there, is attracted."""
        return []

    def words(self) -> Iterator[str]:
        """Give what attracts, in words."""
        yield from ()
