"""What every theorem has: parameters, tables of hints and claims, citations, a proof, a sentence.

A certificate contributes numbers, never conditions: what must be shown follows from the parameters
and the name of the theorem.  *A claim* contains the enclosure computed here, and a ``Quantity`` is
as narrow as the digits that are claimed.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any, ClassVar, NamedTuple

from cap.checker.kernel.arctangent import pi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Enclosure, Field, Table, Whole

MAX_BITS = 4096
BITS = Field("bits", Whole(64, MAX_BITS), "", "", "precision: numbers are multiples of 2^-bits")


class Certificate(NamedTuple):
    """What a certificate says; ``claims`` and ``hints`` have the shapes of its theorem's tables."""

    theorem: str
    parameters: Any
    digits: int
    claims: dict[str, Any]
    hints: dict[str, Any]


class Theorem(ABC):
    """A theorem, for one certificate.  Each step of its proof is reported, or rejects.

    ``PARAMETERS`` are their shapes; what a theorem is about, a subclass in ``system`` says: it
    reads the parameters, and gives the ``units`` of claims as numbers.
    """

    PARAMETERS: ClassVar[dict[str, Any]]
    HINTS: ClassVar[Table]
    CLAIMS: ClassVar[Table]
    CITES: ClassVar[tuple[dict[str, Any], ...]] = ()
    PARTS: ClassVar[dict[str, str]] = {}  # modules that are loaded only where so much is claimed
    jobs: int = 1  # processes that a long proof may use

    @classmethod
    def cited(cls, claims: Mapping[str, Any]) -> list[dict[str, Any]]:  # noqa: ARG003
        """Return what is cited where so much is claimed; by default all."""
        return list(cls.CITES)

    def __init__(self, certificate: Certificate, step: Callable[[str], None]) -> None:
        self.certificate, self.step = certificate, step
        self.tell: Callable[[str, float], None] = lambda _words, _part: None  # how far a proof is
        self.p, self.claims = certificate.parameters, certificate.claims
        self.hints = certificate.hints

    units: Mapping[str, Fraction]

    @classmethod
    @abstractmethod
    def parameters(cls, given: dict[str, Any]) -> Any:
        """Return the parameters of the system; those of no such system reject."""

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:  # noqa: ARG003
        """Reject what would take too long to check; by default nothing."""
        return

    @abstractmethod
    def prove(self) -> None:
        """Prove the theorem, or reject."""

    @abstractmethod
    def words(self) -> str:
        """Return the theorem in one line."""

    def told(self, sentence: str, **more: object) -> str:
        """Return a sentence with the numbers claimed, exactly as they are claimed."""
        return sentence.format_map(self.p._asdict() | self.claims | more)

    def number(self, q: Fraction | int) -> Interval:
        """Return an enclosure of a rational number at the precision of the certificate."""
        return Interval.enclosing(q, q, self.hints["bits"])

    def pi(self) -> Interval:
        """Return an enclosure of pi."""
        return pi(self.hints["bits"])

    def unit(self, unit: str) -> Fraction:
        """Return a unit as a number."""
        value, powers = Fraction(1), (word.partition("^") for word in unit.split())
        for name, _, power in powers:
            value *= self.units[name] ** int(power or 1)
        return value

    def confirm(self, **computed: Any) -> None:
        """Compare claims with what is computed."""
        for name, value in computed.items():
            self.compare(name, self.claims[name], value)

    def compare(self, name: str, claim: Any, computed: Any) -> None:
        """Check that every enclosure claimed contains the one computed, and is narrow enough."""
        if isinstance(claim, Enclosure):
            contained = computed.lies_in(claim.lower, claim.upper)
            need(contained, f"{name} does not contain the enclosure computed")
            self.narrow(name, claim)
        elif isinstance(claim, list):
            need(len(claim) == len(computed), f"{name} is not a list of {len(computed)}")
            for n, parts in enumerate(zip(claim, computed, strict=True)):
                self.compare(f"{name}[{n}]", *parts)
        else:
            need(claim.keys() == computed.keys(), f"{name} has missing or unknown fields")
            for key, part in claim.items():
                self.compare(f"{name}.{key}", part, computed[key])

    def narrow(self, name: str, claim: Enclosure) -> None:
        """Check that an enclosure is as narrow as the digits that are claimed."""
        if claim.unit is not None:
            size = max(abs(claim.lower), abs(claim.upper), self.unit(claim.unit))
            narrow = (claim.upper - claim.lower) * 10**self.certificate.digits <= size
            need(narrow, f"{name} is wider than its digits allow")
