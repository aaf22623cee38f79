"""What can be said of a claim: the verdict, how strong its evidence is, and what it rests on."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum


class Outcome(StrEnum):
    """The verdicts."""

    CONFIRMED = "confirmed"
    CORRECTED = "corrected"  # what is meant holds with another value or hypothesis, which is given
    REFUTED = "refuted"
    IMPRECISE = "imprecise"
    VACUOUS = "vacuous"  # true or not, it is about nothing
    OPEN = "open"
    UNCHECKABLE = "not checkable as stated"
    UNDECIDED = "undecided"  # a step that decides it failed here: never recorded


UNDECIDABLE = Outcome.OPEN, Outcome.UNCHECKABLE


class Strength(StrEnum):
    """How strong the evidence is."""

    PROVED = "proved"  # in balls, symbolically, or exhaustively, here and now
    CERTIFIED = "certified"  # by a stored certificate that the checker accepts
    BY_ARGUMENT = "by argument"  # by a written proof; what a machine can check of it, it checked
    READ = "by reading"  # the text alone shows it
    NUMERICAL = "numerical"
    NONE = "not decided"  # of what is open, or cannot be checked


@dataclass(frozen=True, kw_only=True)
class Verdict:
    """What was decided: ``found`` is true, as far as ``strength`` says; ``evidence`` is how.

    Where a function decides, the strength follows from what it did: see `cap.audit.decide`.

    ``proof`` is the section of a written proof, ``certificate`` the name of a stored certificate.
    """

    outcome: Outcome
    found: str = ""
    evidence: str = ""
    strength: Strength = Strength.PROVED
    proof: str = ""
    certificate: str = ""


def verdict(fields: Mapping[str, str]) -> Verdict:
    """Return the verdict that was written with these fields; `ValueError` or others for no such."""
    words = dict(fields)
    outcome, strength = Outcome(words.pop("outcome")), Strength(words.pop("strength"))
    return Verdict(outcome=outcome, strength=strength, **words)
