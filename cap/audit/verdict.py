"""What can be said of a claim: the verdict, how strong its evidence is, and what it rests on."""

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
    found: str
    evidence: str
    strength: Strength = Strength.PROVED
    proof: str = ""
    certificate: str = ""


def _verdict(outcome: Outcome, found: str, evidence: str, proof: str, certificate: str) -> Verdict:
    """Return a verdict whose strength follows from what it rests on."""
    strength = Strength.PROVED
    if certificate:
        strength = Strength.CERTIFIED
    if proof:
        strength = Strength.BY_ARGUMENT
    return Verdict(
        outcome=outcome,
        found=found,
        evidence=evidence,
        strength=strength,
        proof=proof,
        certificate=certificate,
    )


def confirmed(found: str, evidence: str, *, proof: str = "", certificate: str = "") -> Verdict:
    """Return the verdict that the claim is true."""
    return _verdict(Outcome.CONFIRMED, found, evidence, proof, certificate)


def corrected(found: str, evidence: str, *, proof: str = "", certificate: str = "") -> Verdict:
    """Return the verdict that the claim holds as ``found`` says, not as it stands."""
    return _verdict(Outcome.CORRECTED, found, evidence, proof, certificate)


def refuted(found: str, evidence: str, *, proof: str = "", certificate: str = "") -> Verdict:
    """Return the verdict that the claim is false."""
    return _verdict(Outcome.REFUTED, found, evidence, proof, certificate)


def imprecise(found: str, evidence: str, *, proof: str = "", certificate: str = "") -> Verdict:
    """Return the verdict that the words say less, more, or something else than what holds."""
    return _verdict(Outcome.IMPRECISE, found, evidence, proof, certificate)


def vacuous(found: str, evidence: str, *, proof: str = "", certificate: str = "") -> Verdict:
    """Return the verdict that the claim is about nothing."""
    return _verdict(Outcome.VACUOUS, found, evidence, proof, certificate)


def still_open(found: str, evidence: str, *, numerical: bool = False) -> Verdict:
    """Return the verdict that neither the paper nor this audit proves or refutes the claim."""
    strength = Strength.NUMERICAL if numerical else Strength.NONE
    return Verdict(outcome=Outcome.OPEN, found=found, evidence=evidence, strength=strength)


def uncheckable(found: str, evidence: str) -> Verdict:
    """Return the verdict that the claim does not say enough to be checked."""
    return Verdict(
        outcome=Outcome.UNCHECKABLE, found=found, evidence=evidence, strength=Strength.NONE
    )
